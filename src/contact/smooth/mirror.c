/*
   Where a face ends on a plane on which its body is held along the plane's normal, the smooth surface is continued by
   its mirror image. The facets of a ring near such a plane are mirrored, so that normals on the border are means over
   facets on both sides.
*/
#include "smoothimpl.h"
#include "src/mesh/query/queryimpl.h"

/* A surface counts as perpendicular to the plane if the component of the vertex normal along the plane's normal is at
   most this fraction of the facet normal's component, plus MESH_SAME_PLACE for rounding in mesh files. */
#define MIRROR_OBLIQUE 0.2

/* A plane perpendicular to an axis that contains edges of the border, which are held along that axis. All fields are
   real, so that planes can be sent as one array. */
typedef struct {
  /* number of the axis, and coordinate of the plane along the axis [length] */
  PetscReal axis, place;
  PetscReal oblique; /* 1 if the surface is not perpendicular to the plane, on any rank; else 0 */
} MirrorPlane;
#define MIRROR_REALS ((PetscInt)(sizeof(MirrorPlane) / sizeof(PetscReal)))

/* Returns whether a node is held along the axis */
static PetscBool MirrorHolds(const ContactRing *ring, PetscInt node, PetscInt axis)
{
  return (PetscBool)((ring->prescribed[node] >> axis & 1) != 0);
}

/* Returns whether the surface at a corner is not perpendicular to a plane normal to the axis */
static PetscBool MirrorIsOblique(const ContactRing *ring, PetscInt corner, PetscInt axis)
{
  PetscReal x[12], facet[3], n[3];

  for (PetscInt i = 0; i < 12; ++i) x[i] = ring->s.x[3 * ring->s.node[4 * (corner / 4) + i / 3] + i % 3];
  if (!ContactFacetNormal(x, facet)) return PETSC_TRUE;
  MeshCornerNormal(&ring->s, corner, n);
  return (PetscBool)(PetscAbsReal(n[axis]) > MIRROR_OBLIQUE * PetscAbsReal(facet[axis]) + MESH_SAME_PLACE);
}

/* Adds a plane, or updates `oblique` of an existing plane */
static void MirrorAddPlane(MirrorPlane plane, PetscReal tolerance, PetscInt *n, MirrorPlane planes[])
{
  for (PetscInt k = 0; k < *n; ++k) {
    if (planes[k].axis != plane.axis || PetscAbsReal(planes[k].place - plane.place) > tolerance) continue;
    planes[k].oblique = PetscMax(planes[k].oblique, plane.oblique);
    return;
  }
  planes[(*n)++] = plane;
}

/* Finds the planes of the facets that this rank owns. The array must have space for three planes per edge. */
static PetscErrorCode MirrorFindOwn(const ContactRing *ring, PetscInt nown, PetscReal tolerance, PetscInt *n,
  MirrorPlane planes[])
{
  PetscFunctionBegin;
  *n = 0;
  for (PetscInt i = 4 * ring->own; i < 4 * (ring->own + nown); ++i) {
    const PetscInt   next = MeshCornerAfter(&ring->s, i), v = ring->s.node[i], w = ring->s.node[next];
    const PetscReal *x = &ring->s.x[3 * v], *y = &ring->s.x[3 * w];

    if (ring->s.twin[i] >= 0 || MeshCornerIsNone(&ring->s, i)) continue;
    for (PetscInt axis = 0; axis < 3; ++axis) {
      if (!MirrorHolds(ring, v, axis) || !MirrorHolds(ring, w, axis) || PetscAbsReal(y[axis] - x[axis]) > tolerance)
        continue;
      MirrorAddPlane((MirrorPlane){(PetscReal)axis, x[axis],
                       MirrorIsOblique(ring, i, axis) || MirrorIsOblique(ring, next, axis) ? 1.0 : 0.0},
        tolerance, n, planes);
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Finds all planes of the surface, equal on every rank. The caller frees *planes. */
static PetscErrorCode MirrorFindPlanes(MPI_Comm comm, const ContactRing *ring, PetscInt nown, PetscReal tolerance,
  PetscInt *n, MirrorPlane **planes)
{
  PetscInt nall;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(12 * nown, planes));
  PetscCall(MirrorFindOwn(ring, nown, tolerance, &nall, *planes));
  PetscCall(RecordsGather(comm, MIRROR_REALS, &nall, planes));
  *n = 0; /* The planes that remain are stored at the beginning of the same array. */
  for (PetscInt k = 0; k < nall; ++k) MirrorAddPlane((*planes)[k], tolerance, n, *planes);
  PetscFunctionReturn(0);
}

/* Sets on[v] if node v is on the plane and held there, and near[v] if node v is at most two facets away from such a
   node. *any: a real node on the plane, or -1 if there is none */
static PetscErrorCode MirrorMarkNodes(const ContactRing *ring, const MirrorPlane *plane, PetscReal tolerance,
  PetscBool on[], PetscBool near[], PetscInt *any)
{
  const PetscInt axis = (PetscInt)plane->axis;

  PetscFunctionBegin;
  *any = -1;
  for (PetscInt v = 0; v < ring->nnodes; ++v) {
    on[v] = near[v] =
      (PetscBool)(MirrorHolds(ring, v, axis) && PetscAbsReal(ring->s.x[3 * v + axis] - plane->place) <= tolerance);
    if (on[v] && v < ring->nreal) *any = v;
  }
  for (PetscInt layer = 0; layer < 2; ++layer) {
    PetscBool *grown;

    PetscCall(PetscMalloc1(ring->nnodes, &grown));
    PetscCall(PetscArraycpy(grown, near, ring->nnodes));
    for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) {
      for (PetscInt a = 0; near[ring->s.node[i]] && a < 4; ++a) grown[ring->s.node[4 * (i / 4) + a]] = PETSC_TRUE;
    }
    PetscCall(PetscArraycpy(near, grown, ring->nnodes));
    PetscCall(PetscFree(grown));
  }
  PetscFunctionReturn(0);
}

/* Adds the mirror image of node v in the plane that contains the real node `at` */
static PetscErrorCode MirrorAddNode(ContactRing *ring, PetscInt v, PetscInt axis, PetscInt at)
{
  const PetscInt g     = ring->nnodes - ring->nreal;
  ContactImage   image = {v, {-1, -1, -1}};

  PetscFunctionBegin;
  if (v >= ring->nreal) image = ring->image[v - ring->nreal];
  image.plane[axis] = at;
  PetscCall(PetscRealloc((g + 1) * sizeof(ContactImage), &ring->image));
  PetscCall(PetscRealloc((ring->nnodes + 1) * sizeof(PetscInt), &ring->prescribed));
  PetscCall(PetscRealloc(3 * (ring->nnodes + 1) * sizeof(PetscReal), &ring->s.x));
  ring->image[g]                 = image;
  ring->prescribed[ring->nnodes] = ring->prescribed[v];
  ++ring->nnodes;
  ContactRingReflect(ring, ring->nnodes - 1);
  PetscFunctionReturn(0);
}

/* Adds the mirror images of the facets near a plane. Bit c of flips[f] is set if facet f is a mirror image along axis
   c. */
static PetscErrorCode MirrorReflect(ContactRing *ring, const MirrorPlane *plane, PetscReal tolerance, PetscInt **flips)
{
  const PetscInt axis = (PetscInt)plane->axis, nfacets = ring->nfacets, nnodes = ring->nnodes;
  PetscBool     *on, *near;
  PetscInt      *image, at;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(nnodes, &on, nnodes, &near, nnodes, &image));
  PetscCall(MirrorMarkNodes(ring, plane, tolerance, on, near, &at));
  for (PetscInt v = 0; v < nnodes; ++v) image[v] = on[v] ? v : -1;
  for (PetscInt f = 0; at >= 0 && f < nfacets; ++f) {
    PetscInt *node;

    if ((*flips)[f] >> axis & 1) continue;
    node = &ring->s.node[4 * f];
    if (!near[node[0]] || !near[node[1]] || !near[node[2]] || !near[node[3]]) continue;
    PetscCall(PetscRealloc(4 * (ring->nfacets + 1) * sizeof(PetscInt), &ring->s.node));
    PetscCall(PetscRealloc((ring->nfacets + 1) * sizeof(PetscInt), flips));
    node                    = &ring->s.node[4 * f];
    (*flips)[ring->nfacets] = (*flips)[f] | 1 << axis;
    for (PetscInt a = 0; a < 4; ++a) { /* The order is reversed, so that the vertices are counterclockwise seen from
                                          outside. */
      static const PetscInt of_triangle[4] = {0, 2, 1, 1};
      const PetscInt        v              = node[node[2] == node[3] ? of_triangle[a] : (4 - a) % 4];

      if (image[v] < 0) {
        image[v] = ring->nnodes;
        PetscCall(MirrorAddNode(ring, v, axis, at));
      }
      ring->s.node[4 * ring->nfacets + a] = image[v];
    }
    ++ring->nfacets;
  }
  PetscCall(PetscFree3(on, near, image));
  PetscFunctionReturn(0);
}

/* Collective. Adds the mirror images of a ring's facets in all planes to which the surface is perpendicular where it
   ends. Sets no neighbours of the new facets. length: size of the largest facet [length] */
PetscErrorCode ContactRingAddImages(MPI_Comm comm, PetscReal length, PetscInt nown, ContactRing *ring)
{
  const PetscReal tolerance = MESH_SAME_PLACE * length;
  PetscInt        n         = 0, *flips;
  MirrorPlane    *planes;

  PetscFunctionBegin;
  PetscCall(MirrorFindPlanes(comm, ring, nown, tolerance, &n, &planes));
  PetscCall(PetscCalloc1(ring->nfacets, &flips));
  for (PetscInt k = 0; k < n; ++k) {
    if (planes[k].oblique == 0.0) PetscCall(MirrorReflect(ring, &planes[k], tolerance, &flips));
  }
  PetscCall(PetscFree(flips));
  PetscCall(PetscFree(planes));
  PetscFunctionReturn(0);
}
