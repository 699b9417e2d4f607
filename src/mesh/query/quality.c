/* Checks of the shape of cells */
#include "queryimpl.h"
#include <vector3.h>
#include <petscdt.h>

/* Gets the Gauss points of hexahedra of order 2, or the quadrature points of tetrahedra of order 2; order 1 needs
   none */
static PetscErrorCode QualityIntegrationPoints(PetscInt n, PetscInt *npoints, PetscReal xi[][3])
{
  PetscReal weight[MESH_MAX_NODES], x[3], w[3];

  PetscFunctionBegin;
  *npoints = 0;
  if (MeshOrder(n) == 1) PetscFunctionReturn(0);
  if (MeshIsTetrahedron(n)) MeshTetrahedronRule(n, npoints, xi, weight);
  else {
    PetscCall(PetscDTGaussQuadrature(3, -1, 1, x, w));
    *npoints = 27;
    for (PetscInt q = 0; q < 27; ++q) {
      xi[q][0] = x[q % 3];
      xi[q][1] = x[q / 3 % 3];
      xi[q][2] = x[q / 9];
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshQualityTableCreate(PetscInt n, MeshQualityTable *table)
{
  const PetscInt width = MeshOrder(n) + 1;
  PetscReal      xi[MESH_QUALITY_PLACES][3], N[MESH_MAX_NODES];
  PetscInt       npoints;

  PetscFunctionBegin;
  for (PetscInt a = 0; a < n; ++a) {
    const PetscInt at[3] = {a % width, a / width % width, a / (width * width)};

    if (MeshIsTetrahedron(n)) MeshTetrahedronPlace(a, xi[a]);
    else {
      for (PetscInt d = 0; d < 3; ++d) xi[a][d] = (PetscReal)(2 * at[d]) / (PetscReal)(width - 1) - 1;
    }
  }
  PetscCall(QualityIntegrationPoints(n, &npoints, xi + n));
  table->nnodes  = n;
  table->nplaces = n + npoints;
  for (PetscInt q = 0; q < table->nplaces; ++q) MeshCellShape(n, xi[q], N, table->dN[q]);
  PetscFunctionReturn(0);
}

/* Returns the smallest Jacobian determinant at the points of the table, divided by the cube of the longest derivative
   at a node. It is dimensionless, and not positive for an inverted or flat cell. */
PetscReal MeshCellQuality(const MeshQualityTable *table, PetscReal x[][3])
{
  PetscReal smallest = PETSC_MAX_REAL, longest = 0;

  for (PetscInt q = 0; q < table->nplaces; ++q) {
    PetscReal e[3][3], C[3][3];

    for (PetscInt k = 0; k < 3; ++k) {
      for (PetscInt d = 0; d < 3; ++d) {
        e[k][d] = 0;
        for (PetscInt a = 0; a < table->nnodes; ++a) e[k][d] += table->dN[q][k][a] * x[a][d];
      }
      if (q < table->nnodes) longest = PetscMax(longest, VectorNorm(e[k]));
    }
    smallest = PetscMin(smallest, MatrixCofactors(e, C));
  }
  return longest > 0 ? smallest / (longest * longest * longest) : 0;
}

/* Returns whether a comes before b in lexicographic order */
static PetscBool QualityIsBefore(const PetscReal a[3], const PetscReal b[3])
{
  for (PetscInt d = 0; d < 3; ++d) {
    if (a[d] != b[d]) return a[d] < b[d] ? PETSC_TRUE : PETSC_FALSE;
  }
  return PETSC_FALSE;
}

/* Collective. Reports the first body with inverted or flat cells. count: number of such cells on this rank; place: the
   lexicographically smallest of their centres on this rank */
static PetscErrorCode QualityRaise(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], const PetscInt count[],
  PetscReal place[][3])
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
    SETERRQ(comm, PETSC_ERR_USER_INPUT,
      "%s"
      "Body \"%s\"%s%s has %" PetscInt_FMT " inverted or flat cell%s, the first around (%g, %g, %g)",
      ScenePlace(&bodies[b]), bodies[b].name, *from ? " of " : "", from, total[b], total[b] == 1 ? "" : "s",
      (double)first[0], (double)first[1], (double)first[2]);
  }
  PetscCall(PetscFree(total));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCheckCells(DM dm, PetscInt nbodies, const SceneBody bodies[], PetscBool mapped)
{
  MeshPlaces         places;
  MeshQualityTable  *tables; /* tables of linear and quadratic hexahedra and tetrahedra, created when they are first
                                needed */
  const PetscScalar *array;
  PetscInt           cstart, cend, *count;
  PetscReal(*place)[3];

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(MeshGetPlaces(dm, mapped, &places));
  PetscCall(PetscCalloc3(nbodies, &count, nbodies, &place, 4, &tables));
  for (PetscInt i = 0; i < 3 * nbodies; ++i) place[i / 3][i % 3] = PETSC_MAX_REAL;
  PetscCall(VecGetArrayRead(places.x, &array));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt          b, n, nodes[MESH_MAX_NODES];
    PetscReal         x[MESH_MAX_NODES][3], center[3] = {0, 0, 0};
    const Shape      *shape;
    MeshQualityTable *table;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[b], &shape));
    if (!mapped && shape && shape->map && bodies[b].curved) continue;
    PetscCall(MeshGetCellPoints(dm, places.section, c, &n, nodes));
    for (PetscInt a = 0; a < n; ++a) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(places.section, nodes[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) x[a][d] = PetscRealPart(array[offset + d]);
    }
    table = &tables[(MeshIsTetrahedron(n) ? 2 : 0) + MeshOrder(n) - 1];
    if (!table->nnodes) PetscCall(MeshQualityTableCreate(n, table));
    if (MeshCellQuality(table, x) > 1e-12) continue;
    for (PetscInt i = 0; i < 3 * n; ++i) center[i % 3] += x[i / 3][i % 3] / (PetscReal)n;
    if (QualityIsBefore(center, place[b])) PetscCall(PetscArraycpy(place[b], center, 3));
    ++count[b];
  }
  PetscCall(VecRestoreArrayRead(places.x, &array));
  PetscCall(QualityRaise(PetscObjectComm((PetscObject)dm), nbodies, bodies, count, place));
  PetscCall(PetscFree3(count, place, tables));
  PetscFunctionReturn(0);
}
