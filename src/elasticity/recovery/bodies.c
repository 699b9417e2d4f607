/* Recovers the strains of all bodies, of those together that share no node */
#include "recoveryimpl.h"

/*
   Selects remaining bodies of which no two share a node, and marks them as no longer remaining. A body is selected if
   its number is the smallest at all of its nodes. *more: whether some bodies remain.
*/
static PetscErrorCode ElasticitySelectApart(Elasticity e, PetscSF sf, PetscBool remaining[], PetscBool selected[],
  PetscBool *more)
{
  PetscInt *first, *second;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(e->nnodes, &first, e->nbodies, &second));
  for (PetscInt v = 0; v < e->nnodes; ++v) first[v] = PETSC_MAX_INT;
  PetscCall(PetscArrayzero(second, e->nbodies));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt b = e->cellbody[c];

    for (PetscInt i = e->cellstart[c]; remaining[b] && i < e->cellstart[c + 1]; ++i)
      first[e->cellnodes[i]] = PetscMin(first[e->cellnodes[i]], b);
  }
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_MIN, first));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt b = e->cellbody[c];

    for (PetscInt i = e->cellstart[c]; remaining[b] && i < e->cellstart[c + 1]; ++i) {
      if (first[e->cellnodes[i]] < b) second[b] = 1;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, second, (PetscMPIInt)e->nbodies, MPIU_INT, MPI_MAX,
    PetscObjectComm((PetscObject)e->dm)));
  *more = PETSC_FALSE;
  for (PetscInt b = 0; b < e->nbodies; ++b) {
    selected[b]  = (PetscBool)(remaining[b] && !second[b]);
    remaining[b] = (PetscBool)(remaining[b] && second[b]);
    if (remaining[b]) *more = PETSC_TRUE;
  }
  PetscCall(PetscFree2(first, second));
  PetscFunctionReturn(0);
}

/*
   Selects the next bodies, marks them as no longer remaining, and recovers their strains. *more: whether some bodies
   remain.
*/
static PetscErrorCode ElasticityRecoverNext(Elasticity e, PetscSF sf, const PetscScalar x[], const PetscScalar u[],
  PetscBool remaining[], PetscBool selected[], RecoveredNode recovered[], PetscBool *more)
{
  PetscBool second = (PetscBool)(e->basis[1] || e->basis[3]);

  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &second, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)e->dm)));
  PetscCall(ElasticitySelectApart(e, sf, remaining, selected, more));
  PetscCall(PetscArrayzero(recovered, e->nnodes));
  PetscCall(ElasticityRecover(e, sf, selected, x, u, recovered));
  if (second) PetscCall(ElasticityRecoverOrder2(e, sf, selected, x, u, recovered));
  PetscCall(ElasticityLimitRecovered(e, sf, selected, x, u, recovered));
  PetscFunctionReturn(0);
}

/*
   Collective. Recovers the strains of all bodies at the displacement u. Calls add() for each set of bodies that share
   no node, with the strains at their nodes.
*/
PetscErrorCode ElasticityRecoverBodies(Elasticity e, Vec u, RecoveredAdd add, void *ctx)
{
  Vec                local;
  const PetscScalar *ul, *x;
  PetscSF            sf;
  PetscBool         *remaining, *selected, more = PETSC_TRUE;
  RecoveredNode     *recovered;

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(ElasticityCreateNodeSF(e, &sf));
  PetscCall(PetscMalloc3(e->nbodies, &remaining, e->nbodies, &selected, e->nnodes, &recovered));
  for (PetscInt b = 0; b < e->nbodies; ++b) remaining[b] = PETSC_TRUE;
  while (more) {
    PetscCall(ElasticityRecoverNext(e, sf, x, ul, remaining, selected, recovered, &more));
    PetscCall(add(e, selected, x, ul, recovered, ctx));
  }
  PetscCall(PetscFree3(remaining, selected, recovered));
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}
