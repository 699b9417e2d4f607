/* Cells with quadratic edges and facets, of bodies whose mesh file has them: refined vertices lie on these */
#include "meshimpl.h"

#define CURVE_SIZE 81 /* coordinates of 27 places */

PetscErrorCode MeshCurvesCreate(DM dm, PetscInt nbodies, const MeshBody meshes[], MeshCurves *curves)
{
  PetscInt  pstart, pend, first = 0, n;
  PetscBool any = PETSC_FALSE;

  PetscFunctionBegin;
  curves->section = NULL;
  curves->places  = NULL;
  for (PetscInt b = 0; b < nbodies; ++b) any = (PetscBool)(any || meshes[b].quadratic);
  if (!any) PetscFunctionReturn(0);
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &curves->section));
  PetscCall(PetscSectionSetChart(curves->section, pstart, pend));
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt c = 0; meshes[b].quadratic && c < meshes[b].grid.ncells; ++c) PetscCall(PetscSectionSetDof(curves->section, first + c, CURVE_SIZE));
    first += meshes[b].grid.ncells;
  }
  PetscCall(PetscSectionSetUp(curves->section));
  PetscCall(PetscSectionGetStorageSize(curves->section, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &curves->places));
  first = 0;
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscScalar *x;

    if (!meshes[b].quadratic) continue;
    PetscCall(VecGetArray(curves->places, &x));
    for (PetscInt i = 0; i < CURVE_SIZE * meshes[b].grid.ncells; ++i) x[first + i] = meshes[b].grid.curve[i];
    PetscCall(VecRestoreArray(curves->places, &x));
    first += CURVE_SIZE * meshes[b].grid.ncells;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCurvesDestroy(MeshCurves *curves)
{
  PetscFunctionBegin;
  PetscCall(PetscSectionDestroy(&curves->section));
  PetscCall(VecDestroy(&curves->places));
  PetscFunctionReturn(0);
}

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

/* Place of a point of a cell, xi in [0, 1]^3 */
static void CurveEvaluate(const PetscScalar places[], const PetscReal xi[3], PetscReal x[3])
{
  PetscReal n[3][3];

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

/* What refinement makes of one cell, in DMPlex's order, which is that of every cell: corners, 8 a child in tensor order, in [0, 1]^3 */
static PetscErrorCode CurveGetChildren(PetscInt levels, PetscInt *n, PetscReal (**corners)[8][3])
{
  PetscInt  cell[8], cstart, cend;
  PetscReal x[8][3];
  DM        dm;

  PetscFunctionBegin;
  for (PetscInt a = 0; a < 8; ++a) {
    cell[MeshHexTensorOrder[a]] = a;
    for (PetscInt d = 0; d < 3; ++d) x[a][d] = (PetscReal)(a >> d & 1);
  }
  PetscCall(DMPlexCreateFromCellListPetsc(PETSC_COMM_SELF, 3, 1, 8, 8, PETSC_TRUE, cell, 3, &x[0][0], &dm));
  PetscCall(MeshRefine(&dm, levels));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  *n = cend - cstart;
  PetscCall(PetscMalloc1(*n, corners));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt vertices[8];

    PetscCall(MeshGetCellVertices(dm, c, vertices));
    PetscCall(MeshGetVertexCoordinates(dm, 8, vertices, (*corners)[c - cstart]));
  }
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* The curve of a part of a cell with these corners */
static void CurveCut(const PetscScalar places[], const PetscReal corners[8][3], PetscScalar part[])
{
  PetscReal xi[27][3], place[3];

  MeshPlacesSetStraight(corners, xi);
  for (PetscInt i = 0; i < 27; ++i) {
    CurveEvaluate(places, xi[i], place);
    for (PetscInt d = 0; d < 3; ++d) part[3 * i + d] = place[d];
  }
}

PetscErrorCode MeshCurvesRefine(PetscInt levels, DM fine, MeshCurves *curves)
{
  MeshCurves         there = {NULL, NULL};
  PetscInt           nchildren, cend, pend, n;
  const PetscScalar *from;
  PetscScalar       *to;
  PetscReal(*corners)[8][3];

  PetscFunctionBegin;
  if (!curves->section || !levels) PetscFunctionReturn(0);
  PetscCall(CurveGetChildren(levels, &nchildren, &corners));
  PetscCall(DMPlexGetHeightStratum(fine, 0, NULL, &cend));
  PetscCall(DMPlexGetChart(fine, NULL, &pend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)fine), &there.section));
  PetscCall(PetscSectionSetChart(there.section, 0, pend));
  for (PetscInt c = 0; c < cend; ++c) {
    PetscCall(PetscSectionGetDof(curves->section, c / nchildren, &n));
    PetscCall(PetscSectionSetDof(there.section, c, n));
  }
  PetscCall(PetscSectionSetUp(there.section));
  PetscCall(PetscSectionGetStorageSize(there.section, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &there.places));
  PetscCall(VecGetArrayRead(curves->places, &from));
  PetscCall(VecGetArrayWrite(there.places, &to));
  for (PetscInt c = 0; c < cend; ++c) {
    PetscInt parent, child;

    PetscCall(PetscSectionGetDof(there.section, c, &n));
    if (!n) continue;
    PetscCall(PetscSectionGetOffset(curves->section, c / nchildren, &parent));
    PetscCall(PetscSectionGetOffset(there.section, c, &child));
    CurveCut(from + parent, (const PetscReal(*)[3])corners[c % nchildren], to + child);
  }
  PetscCall(VecRestoreArrayWrite(there.places, &to));
  PetscCall(VecRestoreArrayRead(curves->places, &from));
  PetscCall(PetscFree(corners));
  PetscCall(MeshCurvesDestroy(curves));
  *curves = there;
  PetscFunctionReturn(0);
}

/* Those of the parts of cells that local refinement made */
PetscErrorCode MeshCurvesCutOut(const MeshHexes *hexes, DM fine, MeshCurves *curves)
{
  MeshCurves         there = {NULL, NULL};
  PetscInt           pend, n;
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBegin;
  if (!curves->section) PetscFunctionReturn(0);
  PetscCall(DMPlexGetChart(fine, NULL, &pend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)fine), &there.section));
  PetscCall(PetscSectionSetChart(there.section, 0, pend));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    PetscCall(PetscSectionGetDof(curves->section, hexes->root[c], &n));
    PetscCall(PetscSectionSetDof(there.section, c, n));
  }
  PetscCall(PetscSectionSetUp(there.section));
  PetscCall(PetscSectionGetStorageSize(there.section, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &there.places));
  PetscCall(VecGetArrayRead(curves->places, &from));
  PetscCall(VecGetArrayWrite(there.places, &to));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    const PetscInt *place = &hexes->place[4 * c];
    PetscInt        whole, part;
    PetscReal       corners[8][3];

    PetscCall(PetscSectionGetDof(there.section, c, &n));
    if (!n) continue;
    PetscCall(PetscSectionGetOffset(curves->section, hexes->root[c], &whole));
    PetscCall(PetscSectionGetOffset(there.section, c, &part));
    for (PetscInt i = 0; i < 24; ++i) corners[i / 3][i % 3] = (PetscReal)(place[i % 3] + (i / 3 >> i % 3 & 1)) / (PetscReal)(1 << place[3]);
    CurveCut(from + whole, (const PetscReal(*)[3])corners, to + part);
  }
  PetscCall(VecRestoreArrayWrite(there.places, &to));
  PetscCall(VecRestoreArrayRead(curves->places, &from));
  PetscCall(MeshCurvesDestroy(curves));
  *curves = there;
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCurvesApply(const MeshCurves *curves, PetscInt levels, DM fine, PetscBool nodes)
{
  PetscInt           nchildren, cend, n;
  MeshPlaces         at;
  const PetscScalar *places;
  PetscScalar       *x;
  PetscReal(*corners)[8][3];

  PetscFunctionBegin;
  if (!curves->section) PetscFunctionReturn(0);
  PetscCall(CurveGetChildren(levels, &nchildren, &corners));
  PetscCall(DMPlexGetHeightStratum(fine, 0, NULL, &cend));
  PetscCall(MeshGetPlaces(fine, nodes, &at));
  PetscCall(VecGetArrayRead(curves->places, &places));
  PetscCall(VecGetArray(at.x, &x));
  for (PetscInt c = 0; c < cend; ++c) {
    PetscInt  parent, offset, points[MESH_MAX_NODES];
    PetscReal xi[27][3], place[3];

    PetscCall(PetscSectionGetDof(curves->section, c / nchildren, &n));
    if (!n) continue;
    PetscCall(PetscSectionGetOffset(curves->section, c / nchildren, &parent));
    PetscCall(MeshGetCellPoints(fine, at.section, c, &n, points));
    if (n == 27) MeshPlacesSetStraight((const PetscReal(*)[3])corners[c % nchildren], xi);
    else PetscCall(PetscArraycpy(xi, corners[c % nchildren], 8));
    for (PetscInt a = 0; a < n; ++a) {
      PetscCall(PetscSectionGetOffset(at.section, points[a], &offset));
      CurveEvaluate(places + parent, xi[a], place);
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscCall(VecRestoreArray(at.x, &x));
  PetscCall(VecRestoreArrayRead(curves->places, &places));
  PetscCall(PetscFree(corners));
  /* The global coordinates, if they were made, are those from before */
  if (!nodes) PetscCall(DMSetCoordinatesLocal(fine, at.x));
  PetscFunctionReturn(0);
}
