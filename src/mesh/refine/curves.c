/* The curves of a mesh: quadratic cells of bodies whose mesh file has such cells. Refined vertices lie on their edges
   and facets. */
#include "refineimpl.h"

/* Returns the number of coordinates that describe a quadratic cell with this number of corners */
PetscInt MeshCurveSize(PetscInt ncorners)
{
  return ncorners == 4 ? 30 : 81;
}

/* Collective. Creates the curves of the level 0 mesh from the grids of the bodies */
PetscErrorCode MeshCurvesCreate(DM dm, PetscInt nbodies, const MeshBody meshes[], MeshCurves *curves)
{
  PetscInt  pstart, pend, n, *first;
  PetscBool any = PETSC_FALSE;

  PetscFunctionBegin;
  curves->section = NULL;
  curves->places  = NULL;
  for (PetscInt b = 0; b < nbodies; ++b) any = (PetscBool)(any || meshes[b].quadratic);
  if (!any) PetscFunctionReturn(0);
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &curves->section));
  PetscCall(PetscSectionSetChart(curves->section, pstart, pend));
  PetscCall(PetscMalloc1(nbodies, &first));
  PetscCall(MeshGetFirstCells(nbodies, meshes, first));
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt c = 0; meshes[b].quadratic && c < meshes[b].grid.ncells; ++c)
      PetscCall(PetscSectionSetDof(curves->section, first[b] + c, MeshCurveSize(meshes[b].ncorners)));
  }
  PetscCall(PetscSectionSetUp(curves->section));
  PetscCall(PetscSectionGetStorageSize(curves->section, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &curves->places));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscScalar *x;
    PetscInt     offset;

    if (!meshes[b].quadratic || !meshes[b].grid.ncells) continue;
    PetscCall(PetscSectionGetOffset(curves->section, first[b], &offset));
    PetscCall(VecGetArray(curves->places, &x));
    for (PetscInt i = 0; i < MeshCurveSize(meshes[b].ncorners) * meshes[b].grid.ncells; ++i)
      x[offset + i] = meshes[b].grid.curve[i];
    PetscCall(VecRestoreArray(curves->places, &x));
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCurvesDestroy(MeshCurves *curves)
{
  PetscFunctionBegin;
  PetscCall(PetscSectionDestroy(&curves->section));
  PetscCall(VecDestroy(&curves->places));
  PetscFunctionReturn(0);
}

/* Collective. Distributes the curves with the mesh. sf: migration of the mesh's points */
PetscErrorCode MeshCurvesDistribute(PetscSF sf, DM distributed, MeshCurves *curves)
{
  MeshCurves   there = {NULL, NULL};
  PetscSection section;

  PetscFunctionBegin;
  if (!curves->section) PetscFunctionReturn(0);
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)distributed), &section));
  there.section = section;
  PetscCall(VecCreate(PETSC_COMM_SELF, &there.places));
  PetscCall(DMPlexDistributeField(distributed, sf, curves->section, curves->places, there.section, there.places));
  PetscCall(MeshCurvesDestroy(curves));
  *curves = there;
  PetscFunctionReturn(0);
}

/* Computes the position x of the point xi in a quadratic tetrahedron [length] */
static void CurveEvaluateTetrahedron(const PetscScalar places[], const PetscReal xi[3], PetscReal x[3])
{
  PetscReal N[10], dN[3][MESH_MAX_NODES];

  MeshTetrahedronShape(10, xi, N, dN);
  x[0] = x[1] = x[2] = 0;
  for (PetscInt i = 0; i < 30; ++i) x[i % 3] += N[i / 3] * PetscRealPart(places[i]);
}

/* Computes the position x of the point xi in [0, 1]^3 in a quadratic cell [length] */
static void CurveEvaluate(PetscInt ncorners, const PetscScalar places[], const PetscReal xi[3], PetscReal x[3])
{
  PetscReal n[3][3];

  if (ncorners == 4) {
    CurveEvaluateTetrahedron(places, xi, x);
    return;
  }
  for (PetscInt d = 0; d < 3; ++d) {
    n[d][0] = (1 - xi[d]) * (1 - 2 * xi[d]);
    n[d][1] = 4 * xi[d] * (1 - xi[d]);
    n[d][2] = xi[d] * (2 * xi[d] - 1);
  }
  x[0] = x[1] = x[2] = 0;
  for (PetscInt a = 0; a < 27; ++a) {
    const PetscReal weight = n[0][a % 3] * n[1][a / 3 % 3] * n[2][a / 9];

    for (PetscInt d = 0; d < 3; ++d) x[d] += weight * PetscRealPart(places[3 * a + d]);
  }
}

/* The corners, in the parameters of a cell, of the parts into which refinement divides the cell. They are in the order
   of DMPlex, which is equal for all cells. */
typedef struct {
  PetscInt n;
  PetscReal (*corners)[8][3];
} CurveChildren;

/* Computes the parts of a cell with this number of corners after `levels` refinements, by refining the reference
   cell */
static PetscErrorCode CurveGetChildren(PetscInt levels, PetscInt ncorners, CurveChildren *children)
{
  PetscInt        cell[8], cstart, cend, n;
  PetscReal       x[8][3];
  const PetscInt *order = MeshPlexCorners(ncorners);
  DM              dm;

  PetscFunctionBegin;
  for (PetscInt a = 0; a < ncorners; ++a) {
    cell[order[a]] = a;
    for (PetscInt d = 0; d < 3; ++d) x[a][d] = (PetscReal)(a >> d & 1);
    if (ncorners == 4) MeshTetrahedronPlace(a, x[a]);
  }
  PetscCall(
    DMPlexCreateFromCellListPetsc(PETSC_COMM_SELF, 3, 1, ncorners, ncorners, PETSC_TRUE, cell, 3, &x[0][0], &dm));
  PetscCall(MeshRefine(&dm, levels));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  children->n = cend - cstart;
  PetscCall(PetscMalloc1(children->n, &children->corners));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt vertices[8];

    PetscCall(MeshGetCellCorners(dm, c, &n, vertices));
    PetscCall(MeshGetVertexCoordinates(dm, n, vertices, children->corners[c - cstart]));
  }
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* Computes the parts of a tetrahedron, children[0], and of a hexahedron, children[1]. Both have n parts, so that cell c
   of the refined mesh is part c % n of cell c / n. DMPlex numbers tetrahedra before hexahedra. */
static PetscErrorCode CurveGetAllChildren(PetscInt levels, CurveChildren children[2])
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) PetscCall(CurveGetChildren(levels, 4 + 4 * k, &children[k]));
  PetscFunctionReturn(0);
}

static PetscErrorCode CurveDestroyChildren(CurveChildren children[2])
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) PetscCall(PetscFree(children[k].corners));
  PetscFunctionReturn(0);
}

/* Computes the quadratic nodes of the part of a cell with these corners */
static void CurveCut(PetscInt ncorners, const PetscScalar places[], const PetscReal corners[8][3], PetscScalar part[])
{
  PetscReal xi[MESH_MAX_NODES][3], place[3];

  MeshPlacesSetStraight(ncorners, corners, xi);
  for (PetscInt i = 0; 3 * i < MeshCurveSize(ncorners); ++i) {
    CurveEvaluate(ncorners, places, xi[i], place);
    for (PetscInt d = 0; d < 3; ++d) part[3 * i + d] = place[d];
  }
}

/* Creates curves for the n cells of a refined mesh, without their values. Cell c is a part of cell root[c], or, if root
   is NULL, of cell c / nchildren. */
static PetscErrorCode CurvesCreateParts(const MeshCurves *curves, DM fine, PetscInt n, PetscInt nchildren,
  const PetscInt root[], MeshCurves *parts)
{
  PetscInt end, size;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(fine, NULL, &end));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)fine), &parts->section));
  PetscCall(PetscSectionSetChart(parts->section, 0, end));
  for (PetscInt c = 0; c < n; ++c) {
    PetscCall(PetscSectionGetDof(curves->section, root ? root[c] : c / nchildren, &size));
    PetscCall(PetscSectionSetDof(parts->section, c, size));
  }
  PetscCall(PetscSectionSetUp(parts->section));
  PetscCall(PetscSectionGetStorageSize(parts->section, &size));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, size, &parts->places));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCurvesRefine(PetscInt levels, DM fine, MeshCurves *curves)
{
  MeshCurves         there = {NULL, NULL};
  CurveChildren      children[2];
  PetscInt           nchildren, cend, n;
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBegin;
  if (!curves->section || !levels) PetscFunctionReturn(0);
  PetscCall(CurveGetAllChildren(levels, children));
  nchildren = children[0].n;
  PetscCall(DMPlexGetHeightStratum(fine, 0, NULL, &cend));
  PetscCall(CurvesCreateParts(curves, fine, cend, nchildren, NULL, &there));
  PetscCall(VecGetArrayRead(curves->places, &from));
  PetscCall(VecGetArrayWrite(there.places, &to));
  for (PetscInt c = 0; c < cend; ++c) {
    PetscInt parent, child, ncorners;

    PetscCall(PetscSectionGetDof(there.section, c, &n));
    if (!n) continue;
    ncorners = n == MeshCurveSize(4) ? 4 : 8;
    PetscCall(PetscSectionGetOffset(curves->section, c / nchildren, &parent));
    PetscCall(PetscSectionGetOffset(there.section, c, &child));
    CurveCut(ncorners, from + parent, (const PetscReal(*)[3])children[ncorners / 4 - 1].corners[c % nchildren],
      to + child);
  }
  PetscCall(VecRestoreArrayWrite(there.places, &to));
  PetscCall(VecRestoreArrayRead(curves->places, &from));
  PetscCall(CurveDestroyChildren(children));
  PetscCall(MeshCurvesDestroy(curves));
  *curves = there;
  PetscFunctionReturn(0);
}

/* Computes the corners in [0, 1]^3 of a part of a cell that local refinement has created. place: position of the part
   in the cell, and its level */
static void CurveGetPart(const PetscInt place[4], PetscReal corners[8][3])
{
  for (PetscInt i = 0; i < 24; ++i)
    corners[i / 3][i % 3] = (PetscReal)(place[i % 3] + (i / 3 >> i % 3 & 1)) / (PetscReal)(1 << place[3]);
}

/* Replaces the positions of such a part's corners by those on the curve of its cell. They stay unchanged if the cell
   has no curve. */
PetscErrorCode MeshCurvesPlacePart(const MeshCurves *curves, const MeshHexes *hexes, PetscInt cell,
  PetscReal places[8][3])
{
  PetscInt           n = 0, whole;
  const PetscScalar *from;
  PetscReal          corners[8][3];

  PetscFunctionBegin;
  if (curves->section) PetscCall(PetscSectionGetDof(curves->section, hexes->root[cell], &n));
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscSectionGetOffset(curves->section, hexes->root[cell], &whole));
  PetscCall(VecGetArrayRead(curves->places, &from));
  CurveGetPart(&hexes->place[4 * cell], corners);
  for (PetscInt a = 0; a < 8; ++a) CurveEvaluate(8, from + whole, corners[a], places[a]);
  PetscCall(VecRestoreArrayRead(curves->places, &from));
  PetscFunctionReturn(0);
}

/* Replaces the curves by those of the parts that local refinement has created */
PetscErrorCode MeshCurvesCutOut(const MeshHexes *hexes, DM fine, MeshCurves *curves)
{
  MeshCurves         there = {NULL, NULL};
  PetscInt           n;
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBegin;
  if (!curves->section) PetscFunctionReturn(0);
  PetscCall(CurvesCreateParts(curves, fine, hexes->ncells, 1, hexes->root, &there));
  PetscCall(VecGetArrayRead(curves->places, &from));
  PetscCall(VecGetArrayWrite(there.places, &to));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    PetscInt  whole, part;
    PetscReal corners[8][3];

    PetscCall(PetscSectionGetDof(there.section, c, &n));
    if (!n) continue;
    PetscCall(PetscSectionGetOffset(curves->section, hexes->root[c], &whole));
    PetscCall(PetscSectionGetOffset(there.section, c, &part));
    CurveGetPart(&hexes->place[4 * c], corners);
    CurveCut(8, from + whole, (const PetscReal(*)[3])corners, to + part);
  }
  PetscCall(VecRestoreArrayWrite(there.places, &to));
  PetscCall(VecRestoreArrayRead(curves->places, &from));
  PetscCall(MeshCurvesDestroy(curves));
  *curves = there;
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCurvesApply(const MeshCurves *curves, PetscInt levels, DM fine, PetscBool nodes)
{
  CurveChildren      children[2];
  PetscInt           nchildren, cend, n;
  MeshPlaces         at;
  const PetscScalar *places;
  PetscScalar       *x;

  PetscFunctionBegin;
  if (!curves->section) PetscFunctionReturn(0);
  PetscCall(CurveGetAllChildren(levels, children));
  nchildren = children[0].n;
  PetscCall(DMPlexGetHeightStratum(fine, 0, NULL, &cend));
  PetscCall(MeshGetPlaces(fine, nodes, &at));
  PetscCall(VecGetArrayRead(curves->places, &places));
  PetscCall(VecGetArray(at.x, &x));
  for (PetscInt c = 0; c < cend; ++c) {
    PetscInt  parent, offset, ncorners, points[MESH_MAX_NODES];
    PetscReal xi[MESH_MAX_NODES][3], place[3], (*corners)[3];

    PetscCall(PetscSectionGetDof(curves->section, c / nchildren, &n));
    if (!n) continue;
    ncorners = n == MeshCurveSize(4) ? 4 : 8;
    corners  = children[ncorners / 4 - 1].corners[c % nchildren];
    PetscCall(PetscSectionGetOffset(curves->section, c / nchildren, &parent));
    PetscCall(MeshGetCellPoints(fine, at.section, c, &n, points));
    if (n > ncorners) MeshPlacesSetStraight(ncorners, (const PetscReal(*)[3])corners, xi);
    else PetscCall(PetscArraycpy(xi, corners, n));
    for (PetscInt a = 0; a < n; ++a) {
      PetscCall(PetscSectionGetOffset(at.section, points[a], &offset));
      CurveEvaluate(ncorners, places + parent, xi[a], place);
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscCall(VecRestoreArray(at.x, &x));
  PetscCall(VecRestoreArrayRead(curves->places, &places));
  PetscCall(CurveDestroyChildren(children));
  /* This discards the global coordinates, which are out of date. */
  if (!nodes) PetscCall(DMSetCoordinatesLocal(fine, at.x));
  PetscFunctionReturn(0);
}
