/*
   Chooses the storage of the stiffness matrix: only the upper triangle, and no rigid body modes, if the solver does not
   need more. Gives the optimizer motions that the stiffness hardly resists.
*/
#include "problemimpl.h"

/*
   Chooses symmetric storage if the optimizer only multiplies with a constant K, on one rank. Call this function before
   the tangent is created.
*/
PetscErrorCode StiffnessSetType(Model model)
{
  PetscMPIInt size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(model->comm, &size));
  if (model->scene->npairs && model->quadratic && size == 1)
    PetscCall(ElasticitySetMatType(model->elasticity, MATSBAIJ));
  PetscFunctionReturn(0);
}

/*
   Finds whether the preconditioner may use rigid body modes. BoomerAMG uses a near null space only with nodal
   coarsening, which an option of the user enables. This function looks the option up, because the AMG inside PCAMGF
   reads its options only at set-up, and PCHYPRE has no function that returns the setting.
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

/*
   Attaches rigid body modes to A (model->K or a matrix computed from it) if the solver may use them. ksp: the solver
   after KSPSetFromOptions(); NULL: not known, the modes are attached.
*/
PetscErrorCode StiffnessSetModes(Model model, KSP ksp, Mat A)
{
  MatNullSpace modes;
  PetscBool    uses;

  PetscFunctionBegin;
  PetscCall(StiffnessUsesModes(ksp, &uses));
  if (!uses) PetscFunctionReturn(0);
  PetscCall(MatGetNearNullSpace(model->K, &modes));
  if (!modes) PetscCall(ElasticitySetNearNullSpace(model->elasticity, model->K));
  PetscCall(MatGetNearNullSpace(model->K, &modes));
  PetscCall(MatSetNearNullSpace(A, modes));
  PetscFunctionReturn(0);
}

/* Collective. Passes the free motions to the optimizer's search space if bodies are on weak springs. */
PetscErrorCode StiffnessGiveMotions(Model model, State state, Tao tao)
{
  FreeMotions motions;
  Vec         moves;

  PetscFunctionBegin;
  if (!model->springs.nweak || !model->quadratic) PetscFunctionReturn(0);
  if (!model->springs.modes) {
    PetscCall(FreeMotionsCreate(model, state, &motions));
    PetscCall(VecDuplicate(model->places.x, &moves));
    PetscCall(VecSet(moves, 1.0));
    PetscCall(PrescribedSet(&model->prescribed, 0.0, moves));
    PetscCall(TiesSet(&model->ties, 0.0, moves));
    PetscCall(MatDiagonalScale(motions.Z, moves, NULL));
    PetscCall(VecDestroy(&moves));
    PetscCall(PetscObjectReference((PetscObject)motions.Z));
    model->springs.modes = motions.Z;
    PetscCall(FreeMotionsDestroy(&motions));
  }
  PetscCall(TaoIPFilterSetModes(tao, model->springs.modes));
  PetscFunctionReturn(0);
}
