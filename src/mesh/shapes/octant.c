/* The O-grid of an octant: three patches around an optional core */
#include "shapesimpl.h"

typedef struct {
  PetscInt  n[3], layers, ncore, nsurface; /* number of vertices of the core, and of one layer outside of it */
  PetscBool core;
  PetscInt *surface; /* number of each vertex of the core's lattice on the core's outer sides; PETSC_DECIDE inside */
} Octant;

typedef struct {
  const Octant *octant;
  PetscInt      axis; /* axis normal to the patch */
} OctantPatch;

/* Order of the faces; x0, y0, z0 are consecutive, and a ball has no inner face */
enum { OCTANT_OUTER, OCTANT_PLANE, OCTANT_INNER = OCTANT_PLANE + 3 };

const char *const *OctantFaces(const SceneBody *body)
{
  static const char *const shell[] = {"outer", "x0", "y0", "z0", "inner", NULL};
  static const char *const ball[]  = {"surface", "x0", "y0", "z0", NULL};

  return body->shape == SHAPE_BALL ? ball : shell;
}

PetscErrorCode OctantSize(MPI_Comm comm, const SceneBody *body, PetscBool core, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const PetscInt *n = body->cells;
  PetscInt64      surface, patches, inside;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) {
    const char *const what[] = {"along x (patches)", "along y (patches)", "along z (patches)"};
    const PetscInt    sign   = body->octant.signs[d];

    PetscCheck(sign >= -1 && sign <= 1, comm, PETSC_ERR_ARG_OUTOFRANGE,
      "Body \"%s\": the signs of an octant must be 1 or -1, but that along %c is %" PetscInt_FMT, body->name, "xyz"[d],
      sign);
    PetscCall(ShapeCheckCount(comm, body, what[d], n[d]));
    PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], n[d]));
  }
  PetscCall(ShapeCheckCount(comm, body, "across the layers", body->layers));
  PetscCall(ShapeCheckGrading(comm, body, body->octant.layer_grading, body->octant.layer_even, body->layers));
  PetscCall(ShapeCheckTotal(comm, body, ((PetscReal)n[0] + 1) * ((PetscReal)n[1] + 1) * ((PetscReal)n[2] + 1)));
  patches = (PetscInt64)n[0] * n[1] + (PetscInt64)n[1] * n[2] + (PetscInt64)n[2] * n[0];
  surface = patches + n[0] + n[1] + n[2] + 1;
  inside  = (PetscInt64)n[0] * n[1] * n[2];
  PetscCall(ShapeCheckTotal(comm, body, ((PetscReal)body->layers + 1) * (PetscReal)surface + (PetscReal)inside));
  *ncells    = body->layers * patches + (core ? inside : 0);
  *nvertices = core ? inside + surface + body->layers * surface : (body->layers + 1) * surface;
  PetscFunctionReturn(0);
}

static PetscInt OctantVertex(const Octant *o, PetscInt layer, const PetscInt at[3])
{
  const PetscInt lattice = at[0] + (o->n[0] + 1) * (at[1] + (o->n[1] + 1) * at[2]);

  if (!o->core) return layer * o->nsurface + o->surface[lattice];
  return layer ? o->ncore + (layer - 1) * o->nsurface + o->surface[lattice] : lattice;
}

static PetscInt OctantCoreVertex(const void *context, PetscInt i, PetscInt j, PetscInt k)
{
  const PetscInt at[3] = {i, j, k};

  return OctantVertex(((const OctantPatch *)context)->octant, 0, at);
}

/* Vertex number of a patch: layers, then the two other axes in cyclic order, which is right-handed */
static PetscInt OctantPatchVertex(const void *context, PetscInt layer, PetscInt i, PetscInt j)
{
  const OctantPatch *patch = (const OctantPatch *)context;
  PetscInt           at[3];

  at[patch->axis]           = patch->octant->n[patch->axis];
  at[(patch->axis + 1) % 3] = i;
  at[(patch->axis + 2) % 3] = j;
  return OctantVertex(patch->octant, layer, at);
}

static PetscErrorCode OctantNumberSurface(Octant *o)
{
  PetscInt *number;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1((o->n[0] + 1) * (o->n[1] + 1) * (o->n[2] + 1), &o->surface));
  number      = o->surface;
  o->nsurface = 0;
  for (PetscInt k = 0; k <= o->n[2]; ++k) {
    for (PetscInt j = 0; j <= o->n[1]; ++j) {
      for (PetscInt i = 0; i <= o->n[0]; ++i)
        *number++ = (i == o->n[0] || j == o->n[1] || k == o->n[2]) ? o->nsurface++ : PETSC_DECIDE;
    }
  }
  o->ncore = o->core ? (PetscInt)(number - o->surface) : 0;
  PetscFunctionReturn(0);
}

static PetscErrorCode OctantCoordinates(const SceneBody *body, const Octant *o, ShapeGrid *grid)
{
  PetscFunctionBegin;
  for (PetscInt layer = 0; layer <= o->layers; ++layer) {
    const PetscReal m = 1 + ShapeGraded(body->octant.layer_grading, body->octant.layer_even, o->layers, layer);

    for (PetscInt k = 0; k <= o->n[2]; ++k) {
      for (PetscInt j = 0; j <= o->n[1]; ++j) {
        for (PetscInt i = 0; i <= o->n[0]; ++i) {
          const PetscInt at[3]  = {i, j, k};
          const PetscInt inside = o->surface[i + (o->n[0] + 1) * (j + (o->n[1] + 1) * k)] < 0;

          if (inside && (layer || !o->core)) continue;
          for (PetscInt d = 0; d < 3; ++d)
            grid->coordinates[3 * OctantVertex(o, layer, at) + d] =
              m * ShapeGraded(body->grading[d], body->even[d], o->n[d], at[d]);
        }
      }
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode OctantCreate(const SceneBody *body, PetscBool core, ShapeGrid *grid)
{
  Octant      o    = {{body->cells[0], body->cells[1], body->cells[2]}, body->layers, 0, 0, core, NULL};
  PetscInt    sign = 1;
  ShapeBlock  blocks[4];
  OctantPatch patches[3];

  PetscFunctionBegin;
  PetscCall(OctantNumberSurface(&o));
  for (PetscInt d = 0; d < 3; ++d) {
    const PetscInt   s = (d + 1) % 3, t = (d + 2) % 3;
    const ShapeBlock block = {{o.layers, o.n[s], o.n[t]},
      {core ? PETSC_DECIDE : OCTANT_INNER, OCTANT_OUTER, OCTANT_PLANE + s, PETSC_DECIDE, OCTANT_PLANE + t,
        PETSC_DECIDE},
      &patches[d], OctantPatchVertex};

    patches[d].octant = &o;
    patches[d].axis   = d;
    blocks[d]         = block;
    if (body->octant.signs[d] < 0) sign = -sign;
  }
  if (core) {
    const ShapeBlock block = {{o.n[0], o.n[1], o.n[2]},
      {OCTANT_PLANE, PETSC_DECIDE, OCTANT_PLANE + 1, PETSC_DECIDE, OCTANT_PLANE + 2, PETSC_DECIDE}, &patches[0],
      OctantCoreVertex};

    blocks[3] = block;
  }
  PetscCall(ShapeGridCreate(core ? 4 : 3, blocks, o.ncore + (core ? o.layers : o.layers + 1) * o.nsurface,
    sign < 0 ? PETSC_TRUE : PETSC_FALSE, grid));
  PetscCall(OctantCoordinates(body, &o, grid));
  PetscCall(PetscFree(o.surface));
  PetscFunctionReturn(0);
}

void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s)
{
  const PetscReal m = PetscMax(p[0], PetscMax(p[1], p[2]));

  *s = m - 1;
  for (PetscInt d = 0; d < 3; ++d) q[d] = p[d] / m;
}

void OctantDirection(const PetscReal q[3], PetscReal direction[3])
{
  PetscReal norm = 0;

  for (PetscInt d = 0; d < 3; ++d) {
    direction[d] = PetscTanReal(q[d] * PETSC_PI / 4);
    norm += PetscSqr(direction[d]);
  }
  for (PetscInt d = 0; d < 3; ++d) direction[d] /= PetscSqrtReal(norm);
}

void OctantPlace(const SceneBody *body, const PetscReal relative[3], PetscReal x[3])
{
  for (PetscInt d = 0; d < 3; ++d)
    x[d] = body->octant.corner[d] + (body->octant.signs[d] < 0 ? -relative[d] : relative[d]);
}
