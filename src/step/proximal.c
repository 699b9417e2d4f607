/*
   Free motions of rigid bodies have no stiffness of their own, and solvers ask for some. They are given a small one
   about a centre, which follows the solutions until no force is left in it: the proximal point method, with 1/2 (x -
   centre)^T held (x - centre) added to the energy. Its rate is that stiffness by that of what holds the bodies.

   Where friction is all that holds an elastic body, or nearly not, and no solution has been found, all bodies are
   given such a stiffness: what is left to decide are small motions.
*/
#include "stepimpl.h"

/* As many centres there may be; of the force that is left, once it ought to fall, more than this part is none that
   contact or springs take up */
static const PetscInt  max_centres = 50, patience = 5;
static const PetscReal stuck = 0.9;

/* force += held (x - centre), with its energy; force may be NULL */
PetscErrorCode ProximalAdd(const StepProblem *p, Vec x, PetscReal *energy, Vec force)
{
  PetscFunctionBegin;
  if (p->centre) PetscCall(CentredAdd(1.0, NULL, p->held, p->centre, x, energy, force));
  PetscFunctionReturn(0);
}

/* The centre goes to x; the quadratic model has its energy and force at base */
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

/* Before the first solve: about the base, where the quadratic model has neither energy nor force of it */
PetscErrorCode ProximalBegin(StepProblem *p)
{
  PetscFunctionBegin;
  if (!p->sim->rigid.n) PetscFunctionReturn(0);
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

/* A tangent has that of rigid bodies by itself */
PetscErrorCode ProximalAddStiffness(const StepProblem *p, Mat K)
{
  PetscFunctionBegin;
  if (p->failed) PetscCall(MatDiagonalSet(K, p->held, ADD_VALUES));
  PetscFunctionReturn(0);
}

/* Once, and with friction only: a solve that has found no solution is to be followed by others, about the base, that
   know small motions alone */
PetscErrorCode ProximalRescue(StepProblem *p, Vec u, StepReport *report, PetscBool *again)
{
  const Bodies    bodies = SimulationBodies(p->sim);
  const PetscReal share  = 1e-4;
  Mat             K;

  PetscFunctionBegin;
  *again = (PetscBool)(!report->converged && p->friction.T && !p->centre && !p->lower && !p->unheld &&
                       !p->sim->interrupted && EnergyIsFinite(p->energy));
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

/* Solves about one centre after another that move on by the same way each: no proof that nothing holds the body */
static PetscErrorCode ProximalReportRigidMotion(StepProblem *p, Vec u, StepReport *report)
{
  Vec way;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &way));
  PetscCall(VecWAXPY(way, -1.0, p->centre, u));
  PetscCall(ReportReason(report, PETSC_FALSE, "no equilibrium was found that friction holds"));
  PetscCall(RigidMotionReport(p->sim, way, "no solve brings it to rest", report));
  PetscCall(VecDestroy(&way));
  p->moves_on = PETSC_TRUE;
  PetscFunctionReturn(0);
}

static PetscErrorCode ProximalReportRigidBodies(StepProblem *p, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE, "a rigid body that forces drive is not held"));
  PetscCall(EquilibriumDiagnose(p->sim, p->time, p->load, report, &p->unheld));
  if (!p->unheld)
    PetscCall(ReportReason(report, PETSC_FALSE, "no equilibrium was found of the rigid bodies that forces drive"));
  PetscFunctionReturn(0);
}

/* Whether a solve that has converged to u is to be followed by another one, about u */
PetscErrorCode ProximalAdvance(StepProblem *p, Vec u, PetscInt ncentres, StepReport *report, PetscBool *again)
{
  const PetscReal tolerance = PetscMax(1e-3 * p->sim->tolerances.optimizer, 1e-12);
  PetscReal       carried, size, energy = 0.0;
  PetscBool       falls;
  Vec             force;

  PetscFunctionBegin;
  *again = PETSC_FALSE;
  if (p->failed && !report->converged && !p->sim->interrupted) PetscCall(ReportReason(report, PETSC_FALSE, p->failed));
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
