/* Creates the optimizer of a problem, by which load steps and their starting points are solved. */
#include "problemimpl.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/interrupt.h"
#include "src/state/path.h"

/*
   Marks two options of share/options/pdipm.opts as used. PETSc releases differ in the name of one option. The file
   therefore contains both names, and PETSc would report the name it does not know as unused.
*/
static PetscErrorCode OptimizerKnowBothNames(void)
{
  PetscBool given;

  PetscFunctionBegin;
  PetscCall(PetscOptionsHasName(NULL, NULL, "-tao_pdipm_solve_symmetric_kkt", &given));
  PetscCall(PetscOptionsHasName(NULL, NULL, "-tao_pdipm_symmetric_kkt", &given));
  PetscFunctionReturn(0);
}

/*
   Applies p->tolerance, the tolerance of early contact updates, to the optimizer. This is done only for the subspace
   method, which continues from an inexact solution. An interior point method cannot reuse such a solution.
   ours: true if the optimizer is TAOIPFILTER.
*/
static PetscErrorCode OptimizerSetTolerance(StepProblem *p, PetscBool ours, Tao tao)
{
  const char *const uses[] = {"false", "true", "auto"};
  PetscInt          use;
  PetscBool         given, interior;

  PetscFunctionBegin;
  PetscCall(
    PetscOptionsGetEList(NULL, NULL, "-tao_ipfilter_subspace", uses, PETSC_STATIC_ARRAY_LENGTH(uses), &use, &given));
  interior       = (PetscBool)(!ours || (given && !use && !p->friction.T));
  p->ended_early = (PetscBool)(p->tolerance > p->state->control->tolerances.optimizer && !p->centre && !interior);
  if (p->ended_early) PetscCall(TaoSetTolerances(tao, p->tolerance, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(0);
}

/*
   Tells the optimizer how large the rounding errors of a gap are. They are a trace of the largest motion of the load
   path: a load step that returns to zero has no size of its own. They are at least those of coordinates, except for
   elastic bodies of small strain, which may move by less.
*/
static PetscErrorCode OptimizerSetRounding(Model model, const LoadPath *path, Tao tao)
{
  const PetscReal relative = 4.0 * PETSC_MACHINE_EPSILON, trace = 1e-13;
  PetscReal       place   = 0.0;
  PetscBool       elastic = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < model->scene->nbodies; ++b)
    elastic = (PetscBool)(elastic || model->scene->bodies[b].material.type != MATERIAL_RIGID);
  if (!model->quadratic || !elastic) PetscCall(VecNorm(model->places.x, NORM_INFINITY, &place));
  PetscCall(TaoIPFilterSetRounding(tao, PetscMax(relative * place, trace * path->largest_increment)));
  PetscFunctionReturn(0);
}

/*
   Lets the solver of Newton's systems factor a small matrix, unless an option says otherwise. Without contact this is
   faster than AMG: an arch of 8,000 unknowns takes 0.2 of the time.
*/
static PetscErrorCode OptimizerAllowFactor(KSP ksp)
{
  PC pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCAMGFSetFactor(pc, PC_AMGF_FACTOR_AUTO));
  PetscCall(PCSetFromOptions(pc));
  PetscFunctionReturn(0);
}

/* Creates the optimizer of a problem. *ours: true for TAOIPFILTER; false if -tao_type chose another type. */
PetscErrorCode OptimizerCreate(StepProblem *p, Tao *tao, PetscBool *ours)
{
  Simulation sim = p->sim;
  KSP        ksp;
  Vec        c;

  PetscFunctionBegin;
  PetscCall(TaoCreate(p->model->comm, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  if (p->quadratic) {
    PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, QuadraticObjectiveAndGradient, p));
    PetscCall(TaoSetHessian(*tao, p->K, p->K, StepProblemConstant, p));
  } else {
    PetscCall(TaoSetObjective(*tao, EnergyObjective, p));
    PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, EnergyObjectiveAndGradient, p));
    PetscCall(TaoSetHessian(*tao, p->K, p->K, EnergyHessian, p));
    if (!ModelIsDynamic(p->model)) PetscCall(TaoMonitorSet(*tao, EnergyTestFlow, p, NULL));
  }
  if (p->J) {
    PetscCall(VecDuplicate(p->g, &c));
    PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, StepProblemConstraint, p));
    PetscCall(TaoSetJacobianInequalityRoutine(*tao, p->J, p->J, StepProblemConstant, p));
    PetscCall(VecDestroy(&c));
    PetscCall(TaoIPFilterSetSlackMass(*tao, p->state->solved->linearization->mass));
    PetscCall(TaoIPFilterSetCompliance(*tao, p->soft.compliance));
  }
  PetscCall(TaoIPFilterSetPrimalMass(*tao, p->model->mass));
  PetscCall(TaoSetTolerances(*tao, p->state->control->tolerances.optimizer, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(OptimizerKnowBothNames());
  PetscCall(TaoGetTolerances(*tao, &p->state->control->tolerances.optimizer, NULL, NULL));
  PetscCall(PetscObjectTypeCompare((PetscObject)*tao, TAOIPFILTER, ours));
  PetscCall(OptimizerSetTolerance(p, *ours, *tao));
  if (*ours && p->followed && !p->quadratic && !ModelIsDynamic(p->model))
    PetscCall(TaoMonitorSet(*tao, FollowersTestLimit, p, NULL));
  if (!*ours && !p->lower)
    PetscCall(StepProblemSetBounds(p, PETSC_INFINITY)); /* TAOPDIPM of PETSc 3.18 reads the bounds even if there are
                                                           none */
  if (p->lower) PetscCall(TaoSetVariableBounds(*tao, p->lower, p->upper));
  PetscCall(TaoGetKSP(*tao, &ksp));
  if (!p->J) PetscCall(OptimizerAllowFactor(ksp));
  PetscCall(StiffnessSetModes(p->model, ksp, p->K));
  PetscCall(StiffnessGiveMotions(p->model, p->state, *tao));
  if (*ours && p->state->solved->subspace) PetscCall(TaoIPFilterSetSubspace(*tao, p->state->solved->subspace));
  PetscCheck(*ours || !p->soft.compliance, p->model->comm, PETSC_ERR_SUP,
    "soft contact needs -tao_type ipfilter; other optimizers do not support it");
  PetscCheck(*ours || !p->friction.T, p->model->comm, PETSC_ERR_SUP,
    "friction needs -tao_type ipfilter; other optimizers do not support it");
  PetscCall(OptimizerSetRounding(p->model, p->state->path, *tao));
  PetscCall(TaoIPFilterSetDefinite(*tao, (PetscBool)(p->quadratic && ModelIsDynamic(p->model)))); /* by inertia */
  PetscCall(TaoMonitorSet(*tao, InterruptMonitor, sim, NULL));
  PetscCall(TaoIPFilterSetInterrupt(*tao, InterruptCaught, sim));
  if (p->state->control->observer.optimizer)
    PetscCall(TaoMonitorSet(*tao, p->state->control->observer.optimizer, sim, NULL));
  PetscFunctionReturn(0);
}
