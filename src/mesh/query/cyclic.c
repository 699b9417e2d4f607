/*
   Cyclic symmetry: finds the image of each node of a cut's second face, that is the node of the first face at the same
   position after a rotation about the axis by the sector's angle.
*/
#include "queryimpl.h"
#include <stdlib.h>
#include <vector3.h>

/* Two positions closer than this count as equal, relative to the size of the faces: coordinates in mesh files may have
   five digits only. Of several nodes that are so close the nearest one counts. */
static const PetscReal cyclic_same = 1e-4;

/* A node of the first face, at its position after the rotation */
typedef struct {
  PetscReal x[3], node; /* node: global number */
} CyclicNode;

typedef struct {
  PetscInt    n;
  CyclicNode *nodes; /* nodes of all ranks, sorted by CyclicOrder() */
} CyclicFace;

static PetscReal CyclicOrder(const PetscReal x[3])
{
  return x[0] + 0.7548776662 * x[1] + 0.5698402910 * x[2]; /* the factors are irregular, so that few nodes of a
                                                              regular mesh have equal sums */
}

static int CyclicCompare(const void *a, const void *b)
{
  const PetscReal p = CyclicOrder(((const CyclicNode *)a)->x), q = CyclicOrder(((const CyclicNode *)b)->x);

  return (p > q) - (p < q);
}

/* Gets the nodes of a face that this rank owns. places: coordinates of all nodes, as a global vector */
static PetscErrorCode CyclicGetNodes(DM dm, Vec places, const char face[], PetscInt *n, CyclicNode **nodes)
{
  IS                 is;
  const PetscInt    *rows;
  const PetscScalar *x;
  PetscInt           rstart;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(dm, face, 0, &is));
  PetscCall(ISGetLocalSize(is, n));
  PetscCall(ISGetIndices(is, &rows));
  PetscCall(PetscMalloc1(*n, nodes));
  PetscCall(VecGetOwnershipRange(places, &rstart, NULL));
  PetscCall(VecGetArrayRead(places, &x));
  for (PetscInt k = 0; k < *n; ++k) {
    (*nodes)[k].node = (PetscReal)(rows[k] / 3);
    for (PetscInt d = 0; d < 3; ++d) (*nodes)[k].x[d] = PetscRealPart(x[rows[k] - rstart + d]);
  }
  PetscCall(VecRestoreArrayRead(places, &x));
  PetscCall(ISRestoreIndices(is, &rows));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Computes the vector from the axis to a point, perpendicular to the axis. axis: unit vector */
static void CyclicArm(const SceneCyclic *cut, const PetscReal axis[3], const PetscReal x[3], PetscReal arm[3])
{
  PetscReal along = 0.0;

  for (PetscInt d = 0; d < 3; ++d) along += (x[d] - cut->center[d]) * axis[d];
  for (PetscInt d = 0; d < 3; ++d) arm[d] = x[d] - cut->center[d] - along * axis[d];
}

/* Computes the mean of the nodes' vectors from the axis, and the largest distance of a node from the axis */
static PetscErrorCode CyclicMean(MPI_Comm comm, const SceneCyclic *cut, const PetscReal axis[3], PetscInt n,
  const CyclicNode nodes[], PetscReal mean[3], PetscReal *size)
{
  PetscReal sums[4] = {0.0, 0.0, 0.0, (PetscReal)n}, arm[3];

  PetscFunctionBegin;
  *size = 0.0;
  for (PetscInt k = 0; k < n; ++k) {
    CyclicArm(cut, axis, nodes[k].x, arm);
    for (PetscInt d = 0; d < 3; ++d) sums[d] += arm[d];
    *size = PetscMax(*size, VectorNorm(arm));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPIU_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 1, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt d = 0; d < 3; ++d) mean[d] = sums[d] / sums[3];
  PetscFunctionReturn(0);
}

/* Computes the rotation turn = R - 1 between the mean positions of both faces. It is an error if 360 degrees is not
   a multiple of its angle. */
static PetscErrorCode CyclicFindTurn(MPI_Comm comm, const SceneCyclic *cut, const PetscReal axis[3], PetscInt n,
  const CyclicNode from[], PetscInt m, const CyclicNode to[], PetscReal turn[3][3], PetscReal *size)
{
  const PetscReal whole = 360.0;
  PetscReal       mean[2][3], cross[3], rotation[3], other, angle, sectors;

  PetscFunctionBegin;
  PetscCall(CyclicMean(comm, cut, axis, n, from, mean[0], size));
  PetscCall(CyclicMean(comm, cut, axis, m, to, mean[1], &other));
  SceneCheck(PetscMin(VectorNorm(mean[0]), VectorNorm(mean[1])) > cyclic_same * *size, comm, PETSC_ERR_USER_INPUT, cut,
    "cyclic symmetry \"%s\": the axis goes through the middle of %s or %s, but each face must be on one side of the "
    "axis",
    cut->name, cut->from, cut->to);
  VectorCross(mean[0], mean[1], cross);
  angle   = PetscAtan2Real(VectorDot(cross, axis), VectorDot(mean[0], mean[1]));
  sectors = whole / (PetscAbsReal(angle) * 180.0 / PETSC_PI);
  SceneCheck(PetscAbsReal(sectors - PetscFloorReal(sectors + 0.5)) < 1e-4 * sectors, comm, PETSC_ERR_USER_INPUT, cut,
    "cyclic symmetry \"%s\": the faces %s and %s are %g degrees apart about the axis, and 360 degrees is not a "
    "multiple of this angle",
    cut->name, cut->from, cut->to, (double)(PetscAbsReal(angle) * 180.0 / PETSC_PI));
  angle = (angle < 0.0 ? -2.0 : 2.0) * PETSC_PI / PetscFloorReal(sectors + 0.5);
  for (PetscInt d = 0; d < 3; ++d) rotation[d] = angle * axis[d];
  MatrixSetTurn(rotation, turn);
  PetscFunctionReturn(0);
}

/* Returns the number of the turned first face's node that is nearest to the position x; PETSC_DECIDE if none is within
   the distance `same` in each coordinate */
static PetscInt CyclicFind(const CyclicFace *face, const PetscReal x[3], PetscReal same)
{
  PetscInt  low = 0, high = face->n, found = PETSC_DECIDE;
  PetscReal least = same;

  while (low < high) {
    const PetscInt middle = (low + high) / 2;

    if (CyclicOrder(face->nodes[middle].x) < CyclicOrder(x) - 3.0 * same) low = middle + 1;
    else high = middle;
  }
  for (; low < face->n && CyclicOrder(face->nodes[low].x) <= CyclicOrder(x) + 3.0 * same; ++low) {
    PetscReal off = 0.0;

    for (PetscInt d = 0; d < 3; ++d) off = PetscMax(off, PetscAbsReal(face->nodes[low].x[d] - x[d]));
    if (off > least) continue;
    least = off;
    found = (PetscInt)face->nodes[low].node;
  }
  return found;
}

/* Finds the images of all nodes. *lost: 1 if a node has no image, otherwise 0 */
static PetscErrorCode CyclicMatch(const SceneCyclic *cut, const PetscReal axis[3], const CyclicFace *face,
  PetscReal same, PetscInt m, const CyclicNode to[], PetscInt nodes[], PetscInt images[], PetscReal *lost)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < m; ++k) {
    PetscReal arm[3];

    CyclicArm(cut, axis, to[k].x, arm);
    nodes[k]  = (PetscInt)to[k].node;
    images[k] = VectorNorm(arm) <= same ? nodes[k] : CyclicFind(face, to[k].x, same);
    if (images[k] < 0) *lost = 1.0;
  }
  PetscFunctionReturn(0);
}

/*@C
  MeshGetCyclicImages - Matches the nodes of the two faces of a cyclic symmetry

  Collective

  Input Parameters:
+ dm  - the mesh
- cut - the two faces and the axis

  Output Parameters:
+ turn   - rotation that moves the first face onto the second one, minus the identity
. n      - number of nodes of the second face that this rank owns
. nodes  - global numbers of these nodes; free with `PetscFree()`
- images - global numbers of the nodes of the first face that are moved onto them; a node on the axis is its own image;
           free with `PetscFree()`

  Level: developer

  Note:
  It is an error if 360 degrees is not a multiple of the angle between the faces, or if the faces have different meshes.

.seealso: `MeshGetFaceDofs()`
@*/
PetscErrorCode MeshGetCyclicImages(DM dm, const SceneCyclic *cut, PetscReal turn[3][3], PetscInt *n, PetscInt *nodes[],
  PetscInt *images[])
{
  MPI_Comm    comm = PetscObjectComm((PetscObject)dm);
  PetscInt    total;
  CyclicNode *to;
  CyclicFace  face;
  PetscReal   axis[3] = {cut->axis[0], cut->axis[1], cut->axis[2]}, size, lost = 0.0;
  Vec         coordinates, places;

  PetscFunctionBegin;
  (void)VectorScaleToUnit(axis);
  PetscCall(DMCreateGlobalVector(dm, &places));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMLocalToGlobal(dm, coordinates, INSERT_VALUES, places));
  PetscCall(CyclicGetNodes(dm, places, cut->from, &face.n, &face.nodes));
  PetscCall(CyclicGetNodes(dm, places, cut->to, n, &to));
  PetscCall(VecDestroy(&places));
  PetscCall(CyclicFindTurn(comm, cut, axis, face.n, face.nodes, *n, to, turn, &size));
  for (PetscInt k = 0; k < face.n; ++k) {
    PetscReal *x = face.nodes[k].x, r[3];

    for (PetscInt d = 0; d < 3; ++d) r[d] = x[d] - cut->center[d];
    for (PetscInt d = 0; d < 3; ++d) x[d] += VectorDot(turn[d], r);
  }
  PetscCall(RecordsGather(comm, 4, &face.n, &face.nodes));
  if (face.n) qsort(face.nodes, (size_t)face.n, sizeof(CyclicNode), CyclicCompare);
  PetscCall(PetscMalloc1(*n, nodes));
  PetscCall(PetscMalloc1(*n, images));
  PetscCall(CyclicMatch(cut, axis, &face, cyclic_same * size, *n, to, *nodes, *images, &lost));
  PetscCallMPI(MPI_Allreduce(n, &total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &lost, 1, MPIU_REAL, MPIU_MAX, comm));
  SceneCheck(lost == 0.0 && total == face.n, comm, PETSC_ERR_USER_INPUT, cut,
    "cyclic symmetry \"%s\": the face %s, turned about the axis, is not the face %s node by node (%" PetscInt_FMT
    " and %" PetscInt_FMT " nodes): both faces must have the same mesh",
    cut->name, cut->from, cut->to, face.n, total);
  PetscCall(PetscFree(face.nodes));
  PetscCall(PetscFree(to));
  PetscFunctionReturn(0);
}
