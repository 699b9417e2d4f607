/* The stiffness matrix of quadratic load steps: half of it is stored where that will do. */
#include "stepimpl.h"

/* The optimizer copies a constant K into its own matrix, and only multiplies by K; call before the tangent is created */
PetscErrorCode StiffnessSetType(Simulation sim)
{
  PetscMPIInt size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(sim->comm, &size));
  if (sim->scene->npairs && sim->quadratic && size == 1) PetscCall(ElasticitySetMatType(sim->elasticity, MATSBAIJ));
  PetscFunctionReturn(0);
}

/* sim->K itself, or where that has its upper triangle only, a copy of this type with whole rows */
PetscErrorCode StiffnessGetWhole(Simulation sim, MatType type, Mat *K)
{
  MatNullSpace near;
  PetscBool    half;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)sim->K, MATSEQSBAIJ, &half));
  if (half) {
    PetscCall(MatConvert(sim->K, type, MAT_INITIAL_MATRIX, K));
    PetscCall(MatGetNearNullSpace(sim->K, &near));
    PetscCall(MatSetNearNullSpace(*K, near));
  } else {
    PetscCall(PetscObjectReference((PetscObject)sim->K));
    *K = sim->K;
  }
  PetscFunctionReturn(0);
}
