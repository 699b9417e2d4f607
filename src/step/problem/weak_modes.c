/* Rigid body modes of bodies on weak springs, which the optimizer adds to its search space. */
#include "problemimpl.h"
#include <vector3.h>

/* Numbers the modes. column[b]: the first mode of body b; negative for bodies without weak springs. *n: their number */
static PetscErrorCode WeakModesNumber(Simulation sim, PetscInt column[], PetscInt *n)
{
  const PetscScalar *k;
  PetscInt           nlocal;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(column, sim->scene->nbodies));
  PetscCall(VecGetLocalSize(sim->springs.weak, &nlocal));
  PetscCall(VecGetArrayRead(sim->springs.weak, &k));
  for (PetscInt i = 0; i < nlocal; i += 3) {
    if (PetscRealPart(k[i]) > 0.0) column[sim->places.body[i / 3]] = 1;
  }
  PetscCall(VecRestoreArrayRead(sim->springs.weak, &k));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, column, (PetscMPIInt)sim->scene->nbodies, MPIU_INT, MPI_MAX, sim->comm));
  *n = 0;
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b) {
    const PetscBool weak = (PetscBool)(column[b] > 0);

    column[b] = weak ? *n : -1;
    if (weak) *n += 6;
  }
  PetscFunctionReturn(0);
}

/*
   Sets the entries of the six modes of a vertex in the rows from `row` on, except in prescribed and tied rows, which
   have moves = 0. arm: from the body's centre to the vertex
*/
static PetscErrorCode WeakModesSetVertex(Mat modes, PetscInt row, PetscInt column, const PetscReal arm[3],
  const PetscScalar moves[3])
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) {
    const PetscReal axis[3] = {c == 0, c == 1, c == 2};
    PetscReal       way[3];

    VectorCross(axis, arm, way);
    for (PetscInt d = 0; d < 3; ++d) {
      if (moves[d] == 0.0) continue;
      if (d == c) PetscCall(MatSetValue(modes, row + d, column + c, 1.0, INSERT_VALUES));
      else PetscCall(MatSetValue(modes, row + d, column + 3 + c, way[d], INSERT_VALUES));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode WeakModesFill(Simulation sim, const PetscInt column[], const PetscReal centre[], Mat modes)
{
  const PetscScalar *x, *m;
  PetscInt           start, end;
  Vec                moves;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->places.x, &moves));
  PetscCall(VecSet(moves, 1.0));
  PetscCall(PrescribedSet(&sim->prescribed, 0.0, moves));
  PetscCall(TiesSet(&sim->ties, 0.0, moves));
  PetscCall(VecGetOwnershipRange(moves, &start, &end));
  PetscCall(VecGetArrayRead(sim->places.x, &x));
  PetscCall(VecGetArrayRead(moves, &m));
  for (PetscInt i = 0; i < end - start; i += 3) {
    const PetscInt b = sim->places.body[i / 3];
    PetscReal      arm[3];

    if (column[b] < 0) continue;
    for (PetscInt d = 0; d < 3; ++d) arm[d] = PetscRealPart(x[i + d]) - centre[3 * b + d];
    PetscCall(WeakModesSetVertex(modes, start + i, column[b], arm, m + i));
  }
  PetscCall(VecRestoreArrayRead(moves, &m));
  PetscCall(VecRestoreArrayRead(sim->places.x, &x));
  PetscCall(VecDestroy(&moves));
  PetscCall(MatAssemblyBegin(modes, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(modes, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Collective. Creates the modes from the undeformed positions: they are the same in all load steps. */
static PetscErrorCode WeakModesCreate(Simulation sim, Mat *modes)
{
  const PetscInt nbodies = sim->scene->nbodies;
  PetscInt       n, N, nmodes, *column;
  PetscReal     *centre;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(nbodies, &column, 3 * nbodies, &centre));
  PetscCall(WeakModesNumber(sim, column, &nmodes));
  PetscCall(VertexPlacesGetCentres(&sim->places, sim->places.x, nbodies, centre));
  PetscCall(VecGetLocalSize(sim->places.x, &n));
  PetscCall(VecGetSize(sim->places.x, &N));
  PetscCall(MatCreateAIJ(sim->comm, n, PETSC_DECIDE, N, nmodes, 6, NULL, 6, NULL, modes));
  PetscCall(WeakModesFill(sim, column, centre, *modes));
  PetscCall(PetscFree2(column, centre));
  PetscFunctionReturn(0);
}

/* Collective. Passes the rigid body modes of all bodies on weak springs to the optimizer, if there are such bodies. */
PetscErrorCode WeakModesGive(Simulation sim, Tao tao)
{
  PetscFunctionBegin;
  if (!sim->springs.nweak || !sim->quadratic) PetscFunctionReturn(0);
  if (!sim->springs.modes) PetscCall(WeakModesCreate(sim, &sim->springs.modes));
  PetscCall(TaoIPFilterSetModes(tao, sim->springs.modes));
  PetscFunctionReturn(0);
}
