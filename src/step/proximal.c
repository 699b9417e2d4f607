/*
   Proximal point method for bodies that are held by contact or friction alone. A rigid body's free motions have no
   stiffness, but the solvers need a positive definite one. Therefore 1/2 (x - centre)^T held (x - centre) is added to
   the energy, with a small diagonal `held`. The centre moves to each solution until this term exerts no force. The
   convergence rate is the ratio of `held` to the stiffness of what holds the bodies.

   The same is done for all bodies if only friction holds an elastic body and the first solve failed.
*/
#include "stepimpl.h"
#include "src/state/control.h"

/* max_centres: limit of solves. After `patience` solves the force of the proximal term must fall below `stuck` times
   its last value; otherwise neither contact nor springs hold the bodies. */
static const PetscInt  max_centres = 50, patience = 5;
static const PetscReal stuck = 0.9;

/* Adds the proximal term at x: its energy, and held (x - centre) to force, which may be NULL */
PetscErrorCode ProximalAdd(const StepProblem *p, Vec x, PetscReal *energy, Vec force)
{
  PetscFunctionBegin;
  if (p->centre) PetscCall(CentredAdd(1.0, NULL, p->held, p->centre, x, energy, force));
  PetscFunctionReturn(0);
}

/* Moves the centre to x and updates energy and force at base of the quadratic model */
static PetscErrorCode ProximalCentre(StepProblem *p, Vec x)
{
  PetscReal before = 0.0, after = 0.0;

  PetscFunctionBegin;
  if (p->force) {
    PetscCall(VecScale(p->force, -1.0));
    PetscCall(ProximalAdd(p, p->base, &before, p->force));
    PetscCall(VecScale(p->force, -1.0));
  }
  PetscCall(VecCopy(x, p->centre));
  if (p->force) PetscCall(ProximalAdd(p, p->base, &after, p->force));
  p->energy += after - before;
  PetscFunctionReturn(0);
}

/* Sets up the proximal term of rigid bodies with the centre at base, where its energy and force are zero */
PetscErrorCode ProximalBegin(StepProblem *p)
{
  PetscFunctionBegin;
  if (!p->sim->rigid.n || SimulationIsDynamic(p->sim)) PetscFunctionReturn(0);
  PetscCall(PetscObjectReference((PetscObject)p->sim->rigid.held));
  p->held = p->sim->rigid.held;
  PetscCall(VecDuplicate(p->base, &p->centre));
  PetscCall(VecCopy(p->base, p->centre));
  PetscFunctionReturn(0);
}

/* The base has changed; about u */
PetscErrorCode ProximalTurn(StepProblem *p, Vec u)
{
  PetscFunctionBegin;
  if (!p->centre) PetscFunctionReturn(0);
  PetscCall(VecCopy(p->base, p->centre));
  PetscCall(ProximalCentre(p, u));
  PetscFunctionReturn(0);
}

PetscErrorCode ProximalEnd(StepProblem *p)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&p->centre));
  PetscCall(VecDestroy(&p->held));
  PetscCall(PetscFree(p->failed));
  PetscFunctionReturn(0);
}

/* Adds `held` to K after a failed solve; for rigid bodies the tangent contains it already */
PetscErrorCode ProximalAddStiffness(const StepProblem *p, Mat K)
{
  PetscFunctionBegin;
  if (p->failed) PetscCall(MatDiagonalSet(K, p->held, ADD_VALUES));
  PetscFunctionReturn(0);
}

/* Prepares a second try after a failed solve with friction: all bodies get a proximal term, centred at base. again:
   try it. Done once per problem. */
PetscErrorCode ProximalRescue(StepProblem *p, Vec u, StepReport *report, PetscBool *again)
{
  const Bodies    bodies = SimulationBodies(p->sim);
  const PetscReal share  = 1e-4;
  Mat             K;

  PetscFunctionBegin;
  *again = (PetscBool)(!report->converged && p->friction.T && !p->centre && !p->lower && !p->unheld && !p->flowing &&
                       !p->sim->control->interrupted && EnergyIsFinite(p->energy) && !SimulationIsDynamic(p->sim));
  if (!*again) PetscFunctionReturn(0);
  PetscCall(PetscStrallocpy(report->reason, &p->failed));
  PetscCall(VecDuplicate(p->base, &p->held));
  PetscCall(SpringsOfSize(&bodies, share, p->held));
  PetscCall(PrescribedSet(&p->sim->prescribed, 0.0, p->held));
  PetscCall(TiesSet(&p->sim->ties, 0.0, p->held));
  if (p->sim->quadratic) {
    PetscCall(MatDuplicate(p->K, MAT_COPY_VALUES, &K));
    PetscCall(ProximalAddStiffness(p, K));
    PetscCall(MatDestroy(&p->K));
    p->K = K;
  }
  PetscCall(VecDuplicate(p->base, &p->centre));
  PetscCall(VecCopy(p->base, p->centre));
  PetscCall(VecCopy(p->base, u));
  PetscFunctionReturn(0);
}

/* Reports a rigid motion that continues at the same rate from solve to solve. This does not prove that nothing holds
   the body. */
static PetscErrorCode ProximalReportRigidMotion(StepProblem *p, Vec u, StepReport *report)
{
  Vec increment;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, p->centre, u));
  PetscCall(ReportReason(report, PETSC_FALSE, "no equilibrium was found in which friction holds the bodies"));
  PetscCall(RigidMotionReport(p->sim, increment, "no solve brings it to rest", report));
  PetscCall(VecDestroy(&increment));
  p->moves_on = PETSC_TRUE;
  PetscFunctionReturn(0);
}

static PetscErrorCode ProximalReportRigidBodies(StepProblem *p, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE, "a rigid body that is driven by forces is not held"));
  PetscCall(EquilibriumDiagnose(p->sim, p->time, p->load, report, &p->unheld));
  if (!p->unheld)
    PetscCall(
      ReportReason(report, PETSC_FALSE, "no equilibrium was found for the rigid bodies that are driven by forces"));
  PetscFunctionReturn(0);
}

/* again: whether another solve must follow with the centre at u, because the proximal term still exerts a force */
PetscErrorCode ProximalAdvance(StepProblem *p, Vec u, PetscInt ncentres, StepReport *report, PetscBool *again)
{
  const PetscReal tolerance = PetscMax(1e-3 * p->sim->control->tolerances.optimizer, 1e-12);
  PetscReal       carried, size, energy = 0.0;
  PetscBool       falls;
  Vec             force;

  PetscFunctionBegin;
  *again = PETSC_FALSE;
  if (p->failed && !report->converged && !p->sim->control->interrupted)
    PetscCall(ReportReason(report, PETSC_FALSE, p->failed));
  if (!p->centre || !report->converged) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, &force));
  PetscCall(ElasticityForce(p->sim->elasticity, u, force));
  PetscCall(VecNorm(force, NORM_2, &size));
  PetscCall(VecZeroEntries(force));
  PetscCall(ProximalAdd(p, u, &energy, force));
  PetscCall(VecNorm(force, NORM_2, &carried));
  PetscCall(VecDestroy(&force));
  if (carried <= tolerance * size) PetscFunctionReturn(0);
  falls      = (PetscBool)(carried < stuck * p->carried);
  *again     = (PetscBool)(ncentres < max_centres && (ncentres <= patience || falls));
  p->carried = carried;
  if (*again) PetscCall(ProximalCentre(p, u));
  else if (!p->failed) PetscCall(ProximalReportRigidBodies(p, report));
  else if (!falls) PetscCall(ProximalReportRigidMotion(p, u, report));
  else PetscCall(ReportReason(report, PETSC_FALSE, p->failed));
  PetscFunctionReturn(0);
}
