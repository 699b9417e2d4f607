/* Rigid body modes of bodies on weak springs, which the optimizer adds to its search space. */
#include "problemimpl.h"
#include <vector3.h>

/*
   Computes the centre of the vertices of each body on weak springs. column[b]: number of its first mode; negative for
   other bodies. *n: number of modes
*/
static PetscErrorCode WeakModesNumber(Simulation sim, PetscInt column[], PetscReal centre[][3], PetscInt *n)
{
  const PetscScalar *k, *x;
  PetscInt           nlocal;
  PetscReal(*sum)[4];

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(sim->scene->nbodies, &sum));
  PetscCall(VecGetLocalSize(sim->springs.weak, &nlocal));
  PetscCall(VecGetArrayRead(sim->springs.weak, &k));
  PetscCall(VecGetArrayRead(sim->places.x, &x));
  for (PetscInt i = 0; i < nlocal; i += 3) {
    PetscReal *body = sum[sim->places.body[i / 3]];

    if (!(PetscRealPart(k[i]) > 0.0)) continue;
    for (PetscInt d = 0; d < 3; ++d) body[d] += PetscRealPart(x[i + d]);
    body[3] += 1.0;
  }
  PetscCall(VecRestoreArrayRead(sim->places.x, &x));
  PetscCall(VecRestoreArrayRead(sim->springs.weak, &k));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, sum, (PetscMPIInt)(4 * sim->scene->nbodies), MPIU_REAL, MPIU_SUM, sim->comm));
  *n = 0;
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b) {
    const PetscBool weak = (PetscBool)(sum[b][3] > 0.0);

    column[b] = weak ? *n : -1;
    if (weak) *n += 6;
    for (PetscInt d = 0; d < 3; ++d) centre[b][d] = weak ? sum[b][d] / sum[b][3] : 0.0;
  }
  PetscCall(PetscFree(sum));
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

static PetscErrorCode WeakModesFill(Simulation sim, const PetscInt column[], PetscReal centre[][3], Mat modes)
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
    for (PetscInt d = 0; d < 3; ++d) arm[d] = PetscRealPart(x[i + d]) - centre[b][d];
    PetscCall(WeakModesSetVertex(modes, start + i, column[b], arm, m + i));
  }
  PetscCall(VecRestoreArrayRead(moves, &m));
  PetscCall(VecRestoreArrayRead(sim->places.x, &x));
  PetscCall(VecDestroy(&moves));
  PetscCall(MatAssemblyBegin(modes, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(modes, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Collective. Passes the rigid body modes of all bodies on weak springs to the optimizer, if there are such bodies. */
PetscErrorCode WeakModesGive(Simulation sim, Tao tao)
{
  PetscInt n, N, nmodes, *column;
  PetscReal(*centre)[3];
  Mat modes;

  PetscFunctionBegin;
  if (!sim->springs.nweak || !sim->quadratic) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(sim->scene->nbodies, &column, sim->scene->nbodies, &centre));
  PetscCall(WeakModesNumber(sim, column, centre, &nmodes));
  PetscCall(VecGetLocalSize(sim->places.x, &n));
  PetscCall(VecGetSize(sim->places.x, &N));
  PetscCall(MatCreateAIJ(sim->comm, n, PETSC_DECIDE, N, nmodes, 6, NULL, 6, NULL, &modes));
  PetscCall(WeakModesFill(sim, column, centre, modes));
  PetscCall(TaoIPFilterSetModes(tao, modes));
  PetscCall(MatDestroy(&modes));
  PetscCall(PetscFree2(column, centre));
  PetscFunctionReturn(0);
}
