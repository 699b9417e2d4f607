/* Bodies with a constant tangent: finds whether all bodies have one, and which bodies need not be assembled again */
#include "elasticityimpl.h"

/*@
  ElasticityIsLinear - Gets whether the tangents of all bodies are independent of the displacement

  Not Collective

  Input Parameter:
. e - the context

  Output Parameter:
. linear - `PETSC_TRUE` if the energy is quadratic in the displacement

  Level: intermediate

.seealso: `ElasticityTangent()`, `ElasticityGetAssemblies()`
@*/
PetscErrorCode ElasticityIsLinear(Elasticity e, PetscBool *linear)
{
  PetscFunctionBegin;
  *linear = PETSC_TRUE;
  for (PetscInt b = 0; b < e->nbodies; ++b) {
    if (!e->bodies[b].material.law->constant) *linear = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

/*
   Sets marks[v] at the nodes of bodies that are assembled again, including nodes whose cells are on another rank only
*/
static PetscErrorCode ElasticityMarkAssembledAgain(Elasticity e, PetscBool marks[])
{
  Vec                local, global;
  PetscScalar       *l;
  const PetscScalar *sum;

  PetscFunctionBegin;
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(DMGetGlobalVector(e->dm, &global));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecZeroEntries(global));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    if (e->bodies[e->cellbody[c]].kept) continue;
    for (PetscInt i = e->cellstart[c]; i < e->cellstart[c + 1]; ++i) l[3 * e->cellnodes[i]] = 1;
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, global));
  PetscCall(DMGlobalToLocal(e->dm, global, INSERT_VALUES, local));
  PetscCall(VecGetArrayRead(local, &sum));
  for (PetscInt v = 0; v < e->nnodes; ++v) marks[v] = (PetscBool)(PetscRealPart(sum[3 * v]) > 0);
  PetscCall(VecRestoreArrayRead(local, &sum));
  PetscCall(DMRestoreGlobalVector(e->dm, &global));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*
   Finds the bodies that need not be assembled again. Their rows must not be set to zero for another body; a body that
   shares nodes with a body that is assembled again is therefore excluded, and this may exclude the next body.
*/
PetscErrorCode ElasticitySetUpKept(Elasticity e)
{
  PetscBool *marks;
  PetscInt   nkept = 0, nlost, *lost;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < e->nbodies; ++b) {
    e->bodies[b].kept = e->bodies[b].material.law->constant;
    if (e->bodies[b].kept) ++nkept;
  }
  if (nkept == e->nbodies) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(e->nnodes, &marks, e->nbodies, &lost));
  do {
    if (!nkept) break;
    PetscCall(ElasticityMarkAssembledAgain(e, marks));
    PetscCall(PetscArrayzero(lost, e->nbodies));
    for (PetscInt c = 0; c < e->ncells; ++c) {
      for (PetscInt i = e->cellstart[c]; i < e->cellstart[c + 1]; ++i) {
        if (marks[e->cellnodes[i]] && e->bodies[e->cellbody[c]].kept) lost[e->cellbody[c]] = 1;
      }
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, lost, (PetscMPIInt)e->nbodies, MPIU_INT, MPI_MAX,
      PetscObjectComm((PetscObject)e->dm)));
    nlost = 0;
    for (PetscInt b = 0; b < e->nbodies; ++b) {
      if (!lost[b]) continue;
      e->bodies[b].kept = PETSC_FALSE;
      ++nlost;
    }
    nkept -= nlost;
  } while (nlost);
  PetscCall(PetscFree2(marks, lost));
  PetscFunctionReturn(0);
}
