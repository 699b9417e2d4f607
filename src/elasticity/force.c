/* Computes energy and internal force by loops over the cells, without a matrix */
#include "elasticityimpl.h"

/*@
  ElasticityEnergy - Computes the elastic energy stored by a displacement

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per node [length]

  Output Parameter:
. energy - stored energy of all bodies [force length]

  Level: beginner

  Notes:
  If a cell of a finite strain law is inverted (det F <= 0 at a quadrature point), the energy is `PETSC_INFINITY` on all
  ranks. A line search then shortens its step.

.seealso: `ElasticityForce()`, `ElasticityTangent()`
@*/
PetscErrorCode ElasticityEnergy(Elasticity e, Vec u, PetscReal *energy)
{
  Vec                local;
  const PetscScalar *ul, *x;
  PetscReal          sums[2] = {0, 0}; /* energy; number of inverted cells */

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(ELASTICITY_Force, u, 0, 0, 0));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState cell;
    PetscReal stored;

    ElasticityGetCell(e, c, x, ul, &cell);
    stored = cell.body->element->energy(cell.body->basis, cell.material, cell.X, cell.U);
    if (stored >= PETSC_INFINITY) sums[1] += 1;
    else sums[0] += stored;
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCall(SpringsAddEnergy(e, u, &sums[0]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)e->dm)));
  *energy = sums[1] > 0 ? PETSC_INFINITY : sums[0];
  PetscCall(PetscLogEventEnd(ELASTICITY_Force, u, 0, 0, 0));
  PetscFunctionReturn(0);
}

/*@
  ElasticityForce - Computes the internal force, the derivative of the energy

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per node [length]

  Output Parameter:
. force - dE/du on all rows; on prescribed rows this is the reaction [force]

  Level: beginner

  Notes:
  If the energy is infinite, the rows of the nodes of every inverted cell are at least `PETSC_INFINITY`. The norm of the
  vector is therefore infinite on all ranks.

.seealso: `ElasticityEnergy()`, `ElasticityTangent()`
@*/
PetscErrorCode ElasticityForce(Elasticity e, Vec u, Vec force)
{
  Vec                local, flocal;
  const PetscScalar *ul, *x;
  PetscScalar       *fl;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(ELASTICITY_Force, u, force, 0, 0));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(DMGetLocalVector(e->dm, &flocal));
  PetscCall(VecZeroEntries(flocal));
  PetscCall(VecGetArray(flocal, &fl));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState cell;
    PetscReal F[3][CELL_MAX_NODES];
    PetscBool valid;

    ElasticityGetCell(e, c, x, ul, &cell);
    valid = cell.body->element->force(cell.body->basis, cell.material, cell.X, cell.U, F);
    for (int a = 0; a < cell.n; ++a) {
      for (int i = 0; i < 3; ++i) fl[3 * cell.nodes[a] + i] += valid ? F[i][a] : PETSC_INFINITY;
    }
  }
  PetscCall(VecRestoreArray(flocal, &fl));
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCall(VecZeroEntries(force));
  PetscCall(DMLocalToGlobal(e->dm, flocal, ADD_VALUES, force));
  PetscCall(SpringsAddForce(e, u, force));
  PetscCall(DMRestoreLocalVector(e->dm, &flocal));
  PetscCall(PetscLogEventEnd(ELASTICITY_Force, u, force, 0, 0));
  PetscFunctionReturn(0);
}
