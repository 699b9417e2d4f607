/* The O-grid of one octant or of several octants: patches on the sides of an optional core */
#include "shapesimpl.h"

typedef struct {
  PetscInt  n[3], layers;    /* numbers of cells of the core's lattice along the axes, and across the layers */
  PetscInt  ncore, nsurface; /* numbers of vertices of the core, and of one layer outside of it */
  PetscInt  middle[3]; /* index of the plane through the octant's corner: 0, or n/2 if both of its sides are modelled */
  PetscBool core;
  PetscInt *surface; /* number, within a layer, of each vertex of the core's lattice on the core's outer sides;
                        PETSC_DECIDE for vertices inside */
} Octant;

typedef struct {
  const Octant *octant;
  PetscInt      axis; /* axis perpendicular to the patch */
  PetscBool     low;  /* whether the patch is at the lower end of the axis */
} OctantPatch;

/* The first face. The symmetry planes follow; a shell's inner face is the last one. */
enum { OCTANT_OUTER };

/* Returns whether the octants on both sides of the corner along axis d are modelled */
static PetscBool OctantHasBoth(const SceneBody *body, PetscInt d)
{
  return (PetscBool)(body->octant.signs[d] == OCTANT_BOTH);
}

const char *const *OctantFaces(const SceneBody *body)
{
  static const char *const shell[8][6] = {{"outer", "x0", "y0", "z0", "inner", NULL},
    {"outer", "y0", "z0", "inner", NULL}, {"outer", "x0", "z0", "inner", NULL}, {"outer", "z0", "inner", NULL},
    {"outer", "x0", "y0", "inner", NULL}, {"outer", "y0", "inner", NULL}, {"outer", "x0", "inner", NULL},
    {"outer", "inner", NULL}};
  static const char *const ball[8][5]  = {{"surface", "x0", "y0", "z0", NULL}, {"surface", "y0", "z0", NULL},
     {"surface", "x0", "z0", NULL}, {"surface", "z0", NULL}, {"surface", "x0", "y0", NULL}, {"surface", "y0", NULL},
     {"surface", "x0", NULL}, {"surface", NULL}};
  PetscInt                 both        = 0;

  for (PetscInt d = 0; d < 3; ++d) both += OctantHasBoth(body, d) << d;
  return body->shape == SHAPE_BALL ? ball[both] : shell[both];
}

/* Returns the number of the face in the plane perpendicular to an axis, or PETSC_DECIDE if the body continues beyond
   that plane. Axis 3 stands for the inner face of a shell. */
static PetscInt OctantFace(const SceneBody *body, PetscInt axis)
{
  PetscInt face = OCTANT_OUTER + 1;

  if (axis < 3 && OctantHasBoth(body, axis)) return PETSC_DECIDE;
  for (PetscInt d = 0; d < axis; ++d) face += !OctantHasBoth(body, d);
  return face;
}

static Octant OctantSetUp(const SceneBody *body, PetscBool core)
{
  Octant o = {.layers = body->layers, .core = core};

  for (PetscInt d = 0; d < 3; ++d) {
    o.middle[d] = OctantHasBoth(body, d) ? body->cells[d] : 0;
    o.n[d]      = body->cells[d] + o.middle[d];
  }
  return o;
}

/* Returns whether index i of the lattice is at one of the core's outer sides that are perpendicular to axis d */
static PetscBool OctantIsOuter(const Octant *o, PetscInt d, PetscInt i)
{
  return (PetscBool)(i == o->n[d] || (o->middle[d] && i == 0));
}

PetscErrorCode OctantSize(MPI_Comm comm, const SceneBody *body, PetscBool core, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const PetscInt *n     = body->cells;
  PetscInt64      total = 1, inside = 1, cells = 1, patches = 0;
  PetscReal       size = 1;
  Octant          o;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) {
    const char *const what[] = {"along x (patches)", "along y (patches)", "along z (patches)"};
    const PetscInt    sign   = body->octant.signs[d];

    SceneCheck(sign >= -1 && sign <= OCTANT_BOTH, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the signs of an octant must be 1, -1 or, for both sides, %d, but that along %c is %" PetscInt_FMT,
      body->name, OCTANT_BOTH, "xyz"[d], sign);
    PetscCall(ShapeCheckCount(comm, body, what[d], n[d]));
    PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], n[d]));
    size *= (OctantHasBoth(body, d) ? 2 : 1) * (PetscReal)n[d] + 1;
  }
  PetscCall(ShapeCheckCount(comm, body, "across the layers", body->layers));
  PetscCall(ShapeCheckGrading(comm, body, body->octant.layer_grading, body->octant.layer_even, body->layers));
  PetscCall(ShapeCheckTotal(comm, body, size));
  o = OctantSetUp(body, core);
  for (PetscInt d = 0; d < 3; ++d) {
    total *= o.n[d] + 1;
    cells *= o.n[d];
    inside *= o.middle[d] ? o.n[d] - 1 : o.n[d];
    patches += (PetscInt64)(o.middle[d] ? 2 : 1) * o.n[(d + 1) % 3] * o.n[(d + 2) % 3];
  }
  PetscCall(
    ShapeCheckTotal(comm, body, ((PetscReal)body->layers + 1) * (PetscReal)(total - inside) + (PetscReal)inside));
  *ncells    = body->layers * patches + (core ? cells : 0);
  *nvertices = (body->layers + 1) * (total - inside) + (core ? inside : 0);
  PetscFunctionReturn(0);
}

static PetscInt OctantLattice(const Octant *o, const PetscInt at[3])
{
  return at[0] + (o->n[0] + 1) * (at[1] + (o->n[1] + 1) * at[2]);
}

/* Numbers the lattice points on the core's outer sides */
static PetscErrorCode OctantNumberSurface(Octant *o)
{
  PetscInt *number;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1((o->n[0] + 1) * (o->n[1] + 1) * (o->n[2] + 1), &o->surface));
  number      = o->surface;
  o->nsurface = 0;
  for (PetscInt k = 0; k <= o->n[2]; ++k) {
    for (PetscInt j = 0; j <= o->n[1]; ++j) {
      for (PetscInt i = 0; i <= o->n[0]; ++i) {
        const PetscBool outer = (PetscBool)(OctantIsOuter(o, 0, i) || OctantIsOuter(o, 1, j) || OctantIsOuter(o, 2, k));

        *number++ = outer ? o->nsurface++ : PETSC_DECIDE;
      }
    }
  }
  o->ncore = o->core ? (PetscInt)(number - o->surface) : 0;
  PetscFunctionReturn(0);
}

/* Returns the parameter of lattice index i along axis d, from 0 to 1, or from -1 to 1 if both sides are modelled */
static PetscReal OctantParameter(const SceneBody *body, const Octant *o, PetscInt d, PetscInt i)
{
  const PetscReal place = ShapeGraded(body->grading[d], body->even[d], body->cells[d], PetscAbsInt(i - o->middle[d]));

  return i < o->middle[d] ? -place : place;
}

/* The vertex at the lattice point `at` in a layer */
static PetscInt OctantVertex(const SceneBody *body, const Octant *o, PetscInt layer, const PetscInt at[3],
  PetscReal p[3])
{
  const PetscReal m = p ? 1 + ShapeGraded(body->octant.layer_grading, body->octant.layer_even, o->layers, layer) : 0;
  const PetscInt  lattice = OctantLattice(o, at);

  for (PetscInt d = 0; p && d < 3; ++d) p[d] = m * OctantParameter(body, o, d, at[d]);
  if (!o->core) return layer * o->nsurface + o->surface[lattice];
  return layer ? o->ncore + (layer - 1) * o->nsurface + o->surface[lattice] : lattice;
}

static PetscInt OctantCoreVertex(const SceneBody *body, const void *context, PetscInt i, PetscInt j, PetscInt k,
  PetscReal p[3])
{
  const PetscInt at[3] = {i, j, k};

  return OctantVertex(body, ((const OctantPatch *)context)->octant, 0, at, p);
}

/* A patch's vertex. The directions are the layers and the two other axes, in the order that is right-handed. */
static PetscInt OctantPatchVertex(const SceneBody *body, const void *context, PetscInt layer, PetscInt i, PetscInt j,
  PetscReal p[3])
{
  const OctantPatch *patch = (const OctantPatch *)context;
  PetscInt           at[3];

  at[patch->axis]           = patch->low ? 0 : patch->octant->n[patch->axis];
  at[(patch->axis + 1) % 3] = patch->low ? j : i;
  at[(patch->axis + 2) % 3] = patch->low ? i : j;
  return OctantVertex(body, patch->octant, layer, at, p);
}

/* Returns the block of a patch */
static ShapeBlock OctantPatchBlock(const SceneBody *body, const OctantPatch *patch)
{
  const Octant  *o = patch->octant;
  const PetscInt s = (patch->axis + (patch->low ? 2 : 1)) % 3, t = (patch->axis + (patch->low ? 1 : 2)) % 3;

  return (ShapeBlock){{o->layers, o->n[s], o->n[t]},
    {o->core ? PETSC_DECIDE : OctantFace(body, 3), OCTANT_OUTER, OctantFace(body, s), PETSC_DECIDE, OctantFace(body, t),
      PETSC_DECIDE},
    patch, OctantPatchVertex};
}

PetscErrorCode OctantCreate(const SceneBody *body, PetscBool core, ShapeGrid *grid)
{
  Octant      o    = OctantSetUp(body, core);
  PetscInt    sign = 1, n = 0;
  ShapeBlock  blocks[7];
  OctantPatch patches[6];

  PetscFunctionBegin;
  PetscCall(OctantNumberSurface(&o));
  for (PetscInt d = 0; d < 3; ++d) {
    for (PetscInt low = 0; low <= (o.middle[d] ? 1 : 0); ++low, ++n) {
      patches[n] = (OctantPatch){&o, d, (PetscBool)low};
      blocks[n]  = OctantPatchBlock(body, &patches[n]);
    }
    if (body->octant.signs[d] < 0) sign = -sign;
  }
  if (core)
    blocks[n++] = (ShapeBlock){{o.n[0], o.n[1], o.n[2]},
      {OctantFace(body, 0), PETSC_DECIDE, OctantFace(body, 1), PETSC_DECIDE, OctantFace(body, 2), PETSC_DECIDE},
      &patches[0], OctantCoreVertex};
  PetscCall(ShapeGridCreate(body, n, blocks, o.ncore + (core ? o.layers : o.layers + 1) * o.nsurface,
    sign < 0 ? PETSC_TRUE : PETSC_FALSE, grid));
  PetscCall(PetscFree(o.surface));
  PetscFunctionReturn(0);
}

void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s)
{
  const PetscReal m = PetscMax(PetscAbsReal(p[0]), PetscMax(PetscAbsReal(p[1]), PetscAbsReal(p[2])));

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

/* Creates the grid of a shell, which has no core */
PetscErrorCode OctantCreateShell(const SceneBody *body, ShapeGrid *grid)
{
  PetscFunctionBegin;
  PetscCall(OctantCreate(body, PETSC_FALSE, grid));
  PetscFunctionReturn(0);
}
