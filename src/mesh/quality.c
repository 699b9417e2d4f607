/* Are the cells sound? */
#include "meshimpl.h"

/* Derivative along direction d at node a of a tetrahedron */
static void QualityTetrahedronSlope(PetscInt n, PetscReal x[][3], PetscInt a, PetscInt d, PetscReal slope[3])
{
  PetscReal xi[3], N[10], dN[3][MESH_MAX_NODES];

  MeshTetrahedronPlace(a, xi);
  MeshTetrahedronShape(n, xi, N, dN);
  slope[0] = slope[1] = slope[2] = 0;
  for (PetscInt i = 0; i < 3 * n; ++i) slope[i % 3] += dN[d][i / 3] * x[i / 3][i % 3];
}

/* Of a hexahedron: between the two corners, or of the parabola through the three nodes there */
static void QualitySlope(PetscInt n, PetscReal x[][3], PetscInt a, PetscInt d, PetscReal slope[3])
{
  static const PetscReal straight[2] = {-1, 1}, parabola[3][3] = {{-3, 4, -1}, {-1, 0, 1}, {1, -4, 3}};
  static const PetscInt  steps[3] = {1, 3, 9};
  const PetscInt         step = n == 8 ? 1 << d : steps[d], at = n == 8 ? a >> d & 1 : a / step % 3;

  slope[0] = slope[1] = slope[2] = 0;
  for (PetscInt k = 0; k < (n == 8 ? 2 : 3); ++k) {
    const PetscReal weight = n == 8 ? straight[k] : parabola[at][k];

    for (PetscInt i = 0; i < 3; ++i) slope[i] += weight * x[a + (k - at) * step][i];
  }
}

/*
   Slopes at an integration point of order 2, which is a node drawn towards the middle: Gauss points of a hexahedron; of a tetrahedron the rule of degree 5,
   from the middles of edges, from the corners, and from those beyond the middle
*/
static void QualityInnerSlopes(PetscInt n, PetscReal x[][3], PetscInt q, PetscReal e[3][3])
{
  static const PetscInt steps[3]    = {1, 3, 9};
  const PetscBool       tetrahedron = MeshIsTetrahedron(n);
  const PetscReal       drawn       = !tetrahedron ? PetscSqrtReal(0.6) : q < 4  ? 0.62905893
                                                                        : q < 10 ? 0.81798518
                                                                                 : -0.24354368,
                  middle            = tetrahedron ? 0.25 : 0.0;
  PetscReal xi[3], N[MESH_MAX_NODES], dN[3][MESH_MAX_NODES];

  if (tetrahedron) MeshTetrahedronPlace(q < 10 ? q : q - 10, xi);
  else {
    for (PetscInt d = 0; d < 3; ++d) xi[d] = q / steps[d] % 3 - 1;
  }
  for (PetscInt d = 0; d < 3; ++d) xi[d] = middle + drawn * (xi[d] - middle);
  MeshCellShape(n, xi, N, dN);
  for (PetscInt k = 0; k < 3; ++k) {
    for (PetscInt d = 0; d < 3; ++d) {
      e[k][d] = 0;
      for (PetscInt i = 0; i < n; ++i) e[k][d] += dN[k][i] * x[i][d];
    }
  }
}

static PetscReal QualityDeterminant(PetscReal e[3][3])
{
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/* Smallest of the Jacobian's determinants at the nodes and the integration points, in units of the longest slope cubed */
PetscReal MeshCellQuality(PetscInt n, PetscReal x[][3])
{
  PetscReal smallest = PETSC_MAX_REAL, longest = 0, e[3][3];

  for (PetscInt a = 0; a < n; ++a) {
    for (PetscInt k = 0; k < 3; ++k) {
      if (MeshIsTetrahedron(n)) QualityTetrahedronSlope(n, x, a, k, e[k]);
      else QualitySlope(n, x, a, k, e[k]);
      longest = PetscMax(longest, PetscSqrtReal(PetscSqr(e[k][0]) + PetscSqr(e[k][1]) + PetscSqr(e[k][2])));
    }
    smallest = PetscMin(smallest, QualityDeterminant(e));
  }
  for (PetscInt q = 0; MeshOrder(n) == 2 && q < (MeshIsTetrahedron(n) ? 14 : 27); ++q) {
    QualityInnerSlopes(n, x, q, e);
    smallest = PetscMin(smallest, QualityDeterminant(e));
  }
  return longest > 0 ? smallest / (longest * longest * longest) : 0;
}

/* Is a before b along x, or else along y, or else along z? */
static PetscBool QualityIsBefore(const PetscReal a[3], const PetscReal b[3])
{
  for (PetscInt d = 0; d < 3; ++d) {
    if (a[d] != b[d]) return a[d] < b[d] ? PETSC_TRUE : PETSC_FALSE;
  }
  return PETSC_FALSE;
}

/* Raises the first of the bodies that have bad cells, with the place that is before all others; count and place are this rank's */
static PetscErrorCode QualityRaise(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], const PetscInt count[], PetscReal place[][3])
{
  PetscInt *total;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nbodies, &total));
  PetscCallMPI(MPI_Allreduce(count, total, (PetscMPIInt)nbodies, MPIU_INT, MPI_SUM, comm));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscReal   first[3];
    PetscBool   candidate = PETSC_TRUE;
    const char *from      = bodies[b].shape == SHAPE_GMSH ? bodies[b].gmsh.file : "";

    if (!total[b]) continue;
    for (PetscInt d = 0; d < 3; ++d) {
      const PetscReal mine = candidate ? place[b][d] : PETSC_MAX_REAL;

      PetscCallMPI(MPI_Allreduce(&mine, &first[d], 1, MPIU_REAL, MPIU_MIN, comm));
      if (mine > first[d]) candidate = PETSC_FALSE;
    }
    SETERRQ(comm, PETSC_ERR_USER_INPUT, "Body \"%s\"%s%s has %" PetscInt_FMT " inverted or flat cell%s, the first around (%g, %g, %g)", bodies[b].name, *from ? " of " : "", from, total[b], total[b] == 1 ? "" : "s", (double)first[0], (double)first[1], (double)first[2]);
  }
  PetscCall(PetscFree(total));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCheckCells(DM dm, PetscInt nbodies, const SceneBody bodies[], PetscBool mapped)
{
  MeshPlaces         places;
  const PetscScalar *array;
  PetscInt           cstart, cend, *count;
  PetscReal(*place)[3];

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(MeshGetPlaces(dm, mapped, &places));
  PetscCall(PetscCalloc2(nbodies, &count, nbodies, &place));
  for (PetscInt i = 0; i < 3 * nbodies; ++i) place[i / 3][i % 3] = PETSC_MAX_REAL;
  PetscCall(VecGetArrayRead(places.x, &array));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt     b, n, nodes[MESH_MAX_NODES];
    PetscReal    x[MESH_MAX_NODES][3], center[3] = {0, 0, 0};
    const Shape *shape;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[b], &shape));
    if (!mapped && shape && shape->map && bodies[b].curved) continue;
    PetscCall(MeshGetCellPoints(dm, places.section, c, &n, nodes));
    for (PetscInt a = 0; a < n; ++a) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(places.section, nodes[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) x[a][d] = PetscRealPart(array[offset + d]);
    }
    if (MeshCellQuality(n, x) > 1e-12) continue;
    for (PetscInt i = 0; i < 3 * n; ++i) center[i % 3] += x[i / 3][i % 3] / (PetscReal)n;
    if (QualityIsBefore(center, place[b])) PetscCall(PetscArraycpy(place[b], center, 3));
    ++count[b];
  }
  PetscCall(VecRestoreArrayRead(places.x, &array));
  PetscCall(QualityRaise(PetscObjectComm((PetscObject)dm), nbodies, bodies, count, place));
  PetscCall(PetscFree2(count, place));
  PetscFunctionReturn(0);
}
