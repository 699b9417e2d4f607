/*
   Connectors: springs and dampers between a point of a body and the ground, or a point of another body. The
   displacement of a point is interpolated in the cell that contains it. The energy is quadratic in the offset, which is
   the displacement of the second point relative to the first. The stiffness is added to the matrix of springs between
   unknowns. The force of a damper is proportional to the rate of the offset.
*/
#include "loadsimpl.h"
#include <vector3.h>

/* Computes the 3 x 3 stiffness [force/length] and damping [force time/length] of a connector */
static void ConnectorSetStiffness(const SceneConnector *here, Connector *c)
{
  PetscReal line[3];

  for (int d = 0; d < 3; ++d) line[d] = here->point[1][d] - here->point[0][d];
  (void)VectorScaleToUnit(line);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      c->k[i][j] = here->axial ? here->stiffness * line[i] * line[j] : (i == j) * here->value[i];
      c->d[i][j] = here->damping * (here->axial ? line[i] * line[j] : i == j);
    }
  }
}

/* Computes the entries of the stiffness or damping matrix of a connector, 9 for each pair of nodes, and returns their
   number. If row is NULL, only counts them. */
static PetscInt ConnectorFill(const Connector *c, PetscBool damping, PetscInt row[], PetscInt column[],
  PetscScalar value[])
{
  PetscInt n = 0;

  for (int e = 0; e < 2; ++e) {
    for (int f = 0; f < 2; ++f) {
      for (PetscInt k = 0; k < 9 * c->end[e].n * c->end[f].n; ++k, ++n) {
        const PetscInt a = k / 9 / c->end[f].n, b = k / 9 % c->end[f].n, i = k % 9 / 3, j = k % 3;

        if (!row) continue;
        row[n]    = 3 * c->end[e].node[a] + i;
        column[n] = 3 * c->end[f].node[b] + j;
        value[n]  = (e == f ? 1.0 : -1.0) * (damping ? c->d : c->k)[i][j] * c->end[e].N[a] * c->end[f].N[b];
      }
    }
  }
  return n;
}

/* Collective. Creates the stiffness or the damping matrix of all connectors */
static PetscErrorCode ConnectorsAssemble(const Bodies *bodies, const Springs *springs, PetscBool damping, Mat *A)
{
  const PetscInt m = bodies->scene->nconnectors;
  PetscInt       n = 0, at = 0, nlocal, *row, *column;
  PetscScalar   *value;
  PetscMPIInt    rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(bodies->comm, &rank));
  for (PetscInt c = 0; !rank && c < m; ++c) n += ConnectorFill(&springs->connectors[c], damping, NULL, NULL, NULL);
  PetscCall(PetscMalloc3(n, &row, n, &column, n, &value));
  for (PetscInt c = 0; !rank && c < m; ++c)
    at += ConnectorFill(&springs->connectors[c], damping, row + at, column + at, value + at);
  PetscCall(VecGetLocalSize(bodies->mass, &nlocal));
  PetscCall(MatCreate(bodies->comm, A));
  PetscCall(MatSetSizes(*A, nlocal, nlocal, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*A, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*A, n, row, column));
  PetscCall(MatSetValuesCOO(*A, value, INSERT_VALUES));
  PetscCall(PetscFree3(row, column, value));
  PetscFunctionReturn(0);
}

/* Collective. Adds the stiffness of all connectors to the matrix of springs between unknowns, and creates the damping
   matrix */
PetscErrorCode ConnectorsCreate(const Bodies *bodies, Springs *springs)
{
  PetscBool damped = PETSC_FALSE;
  Mat       A;

  PetscFunctionBegin;
  if (!bodies->scene->nconnectors) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(bodies->scene->nconnectors, &springs->connectors));
  for (PetscInt c = 0; c < bodies->scene->nconnectors; ++c) {
    const SceneConnector *here  = &bodies->scene->connectors[c];
    const SceneEntry     *entry = (const SceneEntry *)here;

    for (PetscInt end = 0; end < (here->to < 0 ? 1 : 2); ++end)
      PetscCall(BodyPointsLocate(bodies->dm, bodies->scene, "connector", 1, &entry, end ? &here->to : &here->body,
        &here->point[end], &springs->connectors[c].end[end]));
    ConnectorSetStiffness(here, &springs->connectors[c]);
    damped = (PetscBool)(damped || here->damping > 0.0);
  }
  if (damped) PetscCall(ConnectorsAssemble(bodies, springs, PETSC_TRUE, &springs->dampers));
  PetscCall(ConnectorsAssemble(bodies, springs, PETSC_FALSE, &A));
  if (springs->between) {
    PetscCall(MatAXPY(springs->between, 1.0, A, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&A));
  } else springs->between = A;
  PetscFunctionReturn(0);
}

/* Collective. Computes the value of a field at the second point of a connector minus that at the first */
static PetscErrorCode ConnectorGetOffset(const Bodies *bodies, const Connector *here, Vec u, PetscReal offset[3])
{
  const PetscScalar *v;
  PetscInt           start, end;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(offset, 3));
  PetscCall(VecGetOwnershipRange(u, &start, &end));
  PetscCall(VecGetArrayRead(u, &v));
  for (int e = 0; e < 2; ++e) {
    for (PetscInt a = 0; a < here->end[e].n; ++a) {
      const PetscInt row = 3 * here->end[e].node[a];

      for (int d = 0; d < 3 && row >= start && row < end; ++d)
        offset[d] += (e ? 1.0 : -1.0) * here->end[e].N[a] * PetscRealPart(v[row - start + d]);
    }
  }
  PetscCall(VecRestoreArrayRead(u, &v));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, offset, 3, MPIU_REAL, MPIU_SUM, bodies->comm));
  PetscFunctionReturn(0);
}

/* Collective. Computes for connector c at the displacement u: the displacement of its second point relative to the
   first [length], and the force of spring and damper on the first point [force]. velocity: NULL in a static analysis */
PetscErrorCode ConnectorMeasure(const Bodies *bodies, const Springs *springs, PetscInt c, Vec u, Vec velocity,
  PetscReal offset[3], PetscReal force[3])
{
  const Connector *here    = &springs->connectors[c];
  PetscReal        rate[3] = {0, 0, 0};

  PetscFunctionBegin;
  PetscCall(ConnectorGetOffset(bodies, here, u, offset));
  if (velocity) PetscCall(ConnectorGetOffset(bodies, here, velocity, rate));
  for (int i = 0; i < 3; ++i) force[i] = VectorDot(here->k[i], offset) + VectorDot(here->d[i], rate);
  PetscFunctionReturn(0);
}
