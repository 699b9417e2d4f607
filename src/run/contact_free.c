/* Solves the first load step without contact, with the same mesh and the same AMG, to measure the cost of contact */
#include "runimpl.h"
#include <petsctime.h>
#include "src/state/path.h"

/*
   Gets the stiffness matrix in the optimizer's format: with both triangles if an option names another AMG than that of
   PCAMGF, which needs only one
*/
static PetscErrorCode ContactFreeMatrix(Model model, KSP ksp, Mat *K)
{
  PC          pc, amg;
  const char *prefix;
  PetscBool   amgf, given = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (amgf) {
    PetscCall(PCAMGFGetAMGPC(pc, &amg));
    PetscCall(PCGetOptionsPrefix(amg, &prefix));
    PetscCall(PetscOptionsHasName(NULL, prefix, "-pc_type", &given));
  }
  if (given) PetscCall(PetscObjectTypeCompare((PetscObject)model->K, MATSEQSBAIJ, &given));
  if (given) PetscCall(MatConvert(model->K, MATBAIJ, MAT_INITIAL_MATRIX, K));
  else {
    PetscCall(PetscObjectReference((PetscObject)model->K));
    *K = model->K;
  }
  PetscFunctionReturn(0);
}

/* Creates a solver like the optimizer's, with its options. PCAMGF without a subspace is its AMG alone. */
static PetscErrorCode ContactFreeKSP(Model model, KSP *ksp)
{
  Tao tao;
  Mat K;

  PetscFunctionBegin;
  PetscCall(TaoCreate(model->comm, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoGetKSP(tao, ksp));
  PetscCall(PetscObjectReference((PetscObject)*ksp));
  PetscCall(TaoDestroy(&tao));
  PetscCall(KSPSetFromOptions(*ksp));
  PetscCall(KSPSetNormType(*ksp, KSP_NORM_PRECONDITIONED));
  PetscCall(KSPSetTolerances(*ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 10000));
  PetscCall(ContactFreeMatrix(model, *ksp, &K));
  PetscCall(StiffnessSetModes(model, *ksp, K));
  PetscCall(KSPSetOperators(*ksp, K, K));
  PetscCall(MatDestroy(&K));
  PetscFunctionReturn(0);
}

/*
   Computes the load of the comparison: the first load step's forces due to prescribed displacements, and a uniform
   pressure on the contact faces with an equal norm, so that every body is loaded as by contact
*/
static PetscErrorCode ContactFreeLoad(Model model, State state, Vec load)
{
  ContactLinearization lin;
  Vec                  pressure;
  PetscReal            size, contact;

  PetscFunctionBegin;
  if (!model->contact) PetscFunctionReturn(0);
  PetscCall(ContactLinearize(model->contact, state->path->u, CONTACT_FORCES, &lin));
  PetscCall(VecDuplicate(load, &pressure));
  PetscCall(MatMultTranspose(lin->J, lin->mass, pressure));
  PetscCall(TiesGather(&model->ties, pressure));
  PetscCall(PrescribedSet(&model->prescribed, 0.0, pressure));
  PetscCall(VecNorm(load, NORM_2, &size));
  PetscCall(VecNorm(pressure, NORM_2, &contact));
  if (contact > 0.0) PetscCall(VecAXPY(load, -(size > 0.0 ? size : 1.0) / contact, pressure));
  PetscCall(VecDestroy(&pressure));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/*@C
   SimulationContactFree - Solves the elastic problem of the first load step without contact, for comparison

   A uniform pressure on the contact faces replaces the contact pairs. PCG with the AMG solves the problem to 1e-10 in
   the preconditioned norm. The report gets the number of iterations, the time, the condition number beta, and the bound
   sqrt(2 (beta + 3)/beta) times the iterations for a solve with contact.

   Collective

   Input Parameter:
.  sim - the simulation, before or after any step; its state does not change

   Level: advanced

   Notes:
   beta is the ratio of the extreme Ritz values of CG. Every body must be held without contact. Otherwise the solve does
   not converge, and the number of iterations in the report is 0.

.seealso: `SimulationGetReport()`, `PCAMGF`
@*/
PetscErrorCode SimulationContactFree(Simulation sim)
{
  RunReport         *report = &sim->report;
  StepProblem        problem;
  KSP                ksp;
  KSPConvergedReason reason;
  PetscReal          emax, emin;
  PetscLogDouble     t0, t1;

  PetscFunctionBegin;
  PetscCheck(sim->model->quadratic, sim->model->comm, PETSC_ERR_SUP,
    "The comparison without contact needs a scene whose load steps are quadratic: linear bodies, or model quadratic");
  PetscCall(PetscLogEventBegin(SIM_Comparison, NULL, NULL, NULL, NULL));
  PetscCall(PetscLogStagePush(SIM_ComparisonStage));
  PetscCall(StepProblemCreate(sim, 1.0, &problem));
  PetscCall(ContactFreeLoad(sim->model, sim->state, problem.force));
  PetscCall(ContactFreeKSP(sim->model, &ksp));
  PetscCall(KSPSetComputeSingularValues(ksp, PETSC_TRUE));
  PetscCall(PetscTime(&t0));
  PetscCall(KSPSolve(ksp, problem.force, problem.w));
  PetscCall(PetscTime(&t1));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  if (reason > 0) {
    PetscReal beta;

    PetscCall(KSPComputeExtremeSingularValues(ksp, &emax, &emin));
    beta = emin > 0.0 ? emax / emin : PETSC_INFINITY;
    PetscCall(KSPGetIterationNumber(ksp, &report->contact_free.iterations));
    report->contact_free.condition = beta;
    report->contact_free.bound = PetscSqrtReal(2.0 * (1.0 + 3.0 / beta)) * (PetscReal)report->contact_free.iterations;
    report->contact_free.solve_time = t1 - t0;
  }
  PetscCall(KSPDestroy(&ksp));
  PetscCall(StepProblemDestroy(&problem));
  PetscCall(PetscLogStagePop());
  PetscCall(PetscLogEventEnd(SIM_Comparison, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
