/*
   The starting point of a solve. If prescribed displacements do not continue the path, they are carried into the bodies
   by a linear solve. Otherwise they would distort the elements at the prescribed faces, so that Newton's method would
   need many iterations, or a thin element would be inverted.
*/
#include "problemimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   Passes the pressures of the last solve, times `scale`, and its slacks to the optimizer as a start. *any: true if any
   row had a pressure.
*/
static PetscErrorCode StartRecallContact(StepProblem *p, PetscReal scale, Tao tao, PetscBool *any)
{
  Vec slack, pressure;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(p->g, &slack));
  PetscCall(VecDuplicate(p->g, &pressure));
  PetscCall(ContactHistoryRecall(p->sim->history, p->sim->solved->linearization, scale / StepProblemShare(p), slack,
    pressure, any));
  if (*any) PetscCall(TaoIPFilterSetWarmStart(tao, slack, pressure));
  PetscCall(VecDestroy(&slack));
  PetscCall(VecDestroy(&pressure));
  PetscFunctionReturn(0);
}

/* Computes *df = K e for the tangent K at u, which here includes the columns of prescribed displacements */
static PetscErrorCode StartMultiplyTangent(StepProblem *p, Tao tao, Vec u, Vec e, Vec *df)
{
  PetscReal size, extent, step, f;
  Vec       moved, force;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &moved));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecDuplicate(u, df));
  PetscCall(VecNorm(e, NORM_INFINITY, &size));
  PetscCall(VecNorm(p->sim->places.x, NORM_INFINITY, &extent));
  step = PETSC_SQRT_MACHINE_EPSILON * extent / size;
  PetscCall(VecWAXPY(moved, step, e, u));
  PetscCall(EnergyObjectiveAndGradient(tao, u, &f, force, p));
  PetscCall(EnergyObjectiveAndGradient(tao, moved, &f, *df, p));
  PetscCall(VecAXPY(*df, -1.0, force));
  PetscCall(VecScale(*df, 1.0 / step));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&moved));
  PetscFunctionReturn(0);
}

/* Solves K w = -b for the tangent K in p->K, to a tolerance that suffices for a start */
static PetscErrorCode StartSolve(StepProblem *p, Vec b, Vec w)
{
  const PetscReal rtol = 1e-3;
  const PetscInt  most = 100;
  KSP             ksp;

  PetscFunctionBegin;
  PetscCall(LinearCreateKSP(p->sim, p->K, rtol, &ksp));
  PetscCall(KSPSetTolerances(ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, most)); /* an option of the user does not count */
  PetscCall(KSPSolve(ksp, b, w));
  PetscCall(VecScale(w, -1.0));
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

/*
   Carries the increments e of the prescribed displacements into the bodies: u = u0 + e + w with the last state u0 and
   K w = -K e in the rows that are not prescribed. The tangent K is that at u0, and contact is ignored. *f: energy at u
*/
static PetscErrorCode StartCarry(StepProblem *p, Tao tao, Vec u, PetscReal *f)
{
  Simulation sim = p->sim;
  PetscReal  size;
  Vec        e, w, df;

  PetscFunctionBegin;
  *f = PETSC_INFINITY;
  PetscCall(VecDuplicate(u, &e));
  PetscCall(VecWAXPY(e, -1.0, sim->path->u, p->base));
  PetscCall(VecNorm(e, NORM_INFINITY, &size));
  if (size > 0.0) {
    PetscCall(VecDuplicate(u, &w));
    PetscCall(StartMultiplyTangent(p, tao, sim->path->u, e, &df));
    PetscCall(EnergyHessian(tao, sim->path->u, p->K, p->K, p));
    PetscCall(StartSolve(p, df, w));
    PetscCall(VecWAXPY(u, 1.0, w, p->base));
    PetscCall(TiesFollow(&sim->ties, u));
    PetscCall(EnergyObjective(tao, u, f, p));
    PetscCall(VecDestroy(&df));
    PetscCall(VecDestroy(&w));
  }
  PetscCall(VecDestroy(&e));
  PetscFunctionReturn(0);
}

/*
   Sets the starting point u of a nonlinear load step: the extrapolated path, if `moved`, or p->base. If prescribed
   displacements do not continue the path, they are carried into the bodies if this lowers the energy. *valid: false if
   an element is inverted at the starting point
*/
static PetscErrorCode StartNonlinear(StepProblem *p, PetscBool moved, Tao tao, Vec u, PetscBool *valid)
{
  Simulation sim    = p->sim;
  PetscReal  f      = PETSC_INFINITY, carried;
  PetscBool  smooth = SimulationIsDynamic(sim); /* a time step always continues the path */
  Vec        other;

  PetscFunctionBegin;
  if (moved) {
    PetscCall(PathContinue(sim, p->time, u));
    PetscCall(EnergyObjective(tao, u, &f, p));
  }
  if (!EnergyIsFinite(f)) {
    PetscCall(VecCopy(p->base, u));
    PetscCall(EnergyObjective(tao, u, &f, p));
  }
  if (!smooth) PetscCall(PathIsSmooth(sim, p->time, &smooth));
  if (!smooth) {
    PetscCall(VecDuplicate(u, &other));
    PetscCall(StartCarry(p, tao, other, &carried));
    if (carried < f) PetscCall(VecCopy(other, u));
    f = PetscMin(f, carried);
    PetscCall(VecDestroy(&other));
  }
  *valid = EnergyIsFinite(f);
  PetscFunctionReturn(0);
}

/*
   Sets the starting point u. If `resume`, u is unchanged. A new load step starts from the extrapolated path if the last
   load step had contact pressures, otherwise from p->base. *valid: false if an element is inverted there.
*/
PetscErrorCode StepProblemStart(StepProblem *p, PetscBool resume, Tao tao, Vec u, PetscBool *valid)
{
  Simulation sim   = p->sim;
  PetscReal  scale = 0.0;
  PetscBool  moved = (PetscBool)(resume || SimulationIsDynamic(sim));

  PetscFunctionBegin;
  *valid = PETSC_TRUE;
  if (p->J && (resume || sim->control->warm)) {
    if (resume) scale = 1.0;
    else PetscCall(PathPressureScale(sim, p->time, &scale));
    PetscCall(StartRecallContact(p, scale, tao, &moved));
  }
  if (p->J) PetscCall(FrictionGive(p, tao, moved ? scale : 0.0));
  if (resume) PetscFunctionReturn(0);
  if (!p->J) moved = sim->control->warm;
  if (!sim->quadratic) PetscCall(StartNonlinear(p, moved, tao, u, valid));
  else if (moved) PetscCall(PathContinue(sim, p->time, u));
  else PetscCall(VecCopy(p->base, u));
  PetscFunctionReturn(0);
}
