/* The stiffness matrix takes no more memory than its solver needs: half of it is stored, and without rigid body
   modes, where that will do. */
#include "stepimpl.h"

/* The optimizer copies a constant K into its own matrix, and only multiplies by K; call before the tangent is created
 */
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
  PetscBool half;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)sim->K, MATSEQSBAIJ, &half));
  if (half) PetscCall(MatConvert(sim->K, type, MAT_INITIAL_MATRIX, K));
  else {
    PetscCall(PetscObjectReference((PetscObject)sim->K));
    *K = sim->K;
  }
  PetscFunctionReturn(0);
}

/*
   BoomerAMG copies a near null space and makes no use of it unless it is asked to coarsen node by node. That is the
   user's word: the AMG of a PCAMGF reads its options at the set-up, by which time the matrix must have the modes, and
   PCHYPRE does not tell how it coarsens.
*/
static PetscErrorCode StiffnessUsesModes(KSP ksp, PetscBool *uses)
{
  PC          pc;
  PCType      set;
  const char *prefix;
  char        type[64];
  PetscBool   filtered, hypre, blocked, nodal;

  PetscFunctionBegin;
  *uses = PETSC_TRUE;
  if (!ksp) PetscFunctionReturn(0);
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &filtered));
  if (filtered) PetscCall(PCAMGFGetAMGPC(pc, &pc));
  PetscCall(PCGetType(pc, &set));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PetscStrncpy(type, set ? set : PetscDefined(HAVE_HYPRE) ? PCHYPRE : PCGAMG, sizeof(type)));
  PetscCall(PetscOptionsGetString(NULL, prefix, "-pc_type", type, sizeof(type), NULL));
  PetscCall(PetscStrcmp(type, PCHYPRE, &hypre));
  PetscCall(PetscStrcmp(type, PCBLOCKAMG, &blocked));
  PetscCall(PetscOptionsHasName(NULL, prefix, "-pc_hypre_boomeramg_nodal_coarsen", &nodal));
  *uses = (PetscBool)(!(hypre || blocked) || nodal);
  PetscFunctionReturn(0);
}

/* Rigid body modes for A, sim->K or a matrix made of it, where the solver (NULL: unknown), with its options set, may
   use them */
PetscErrorCode StiffnessSetModes(Simulation sim, KSP ksp, Mat A)
{
  MatNullSpace modes;
  PetscBool    uses;

  PetscFunctionBegin;
  PetscCall(StiffnessUsesModes(ksp, &uses));
  if (!uses) PetscFunctionReturn(0);
  PetscCall(MatGetNearNullSpace(sim->K, &modes));
  if (!modes) PetscCall(ElasticitySetNearNullSpace(sim->elasticity, sim->K));
  PetscCall(MatGetNearNullSpace(sim->K, &modes));
  PetscCall(MatSetNearNullSpace(A, modes));
  PetscFunctionReturn(0);
}
