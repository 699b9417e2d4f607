/*
   The starting point of a solve. If prescribed displacements do not continue the path, they are carried into the bodies
   by a step of Newton's method from the last state. Otherwise they would distort the elements at the prescribed faces,
   so that Newton's method would need many iterations, or a thin element would be inverted.
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
  PetscCall(ContactHistoryRecall(p->state->history, p->state->solved->linearization, scale / StepProblemShare(p), slack,
    pressure, any));
  if (*any) PetscCall(TaoIPFilterSetWarmStart(tao, slack, pressure));
  PetscCall(VecDestroy(&slack));
  PetscCall(VecDestroy(&pressure));
  PetscFunctionReturn(0);
}

/*
   Sets q to the quadratic model of p about the last state u0, in which the prescribed displacements change by e. Its
   objective is force^T w + 1/2 w^T K w with w = u - u0 - e and force = E'(u0) + K e. K e is a difference of gradients,
   since K has no columns of prescribed rows. The caller frees force, Kw, w and friction of q.
*/
static PetscErrorCode StartModel(StepProblem *p, Vec e, StepProblem *q)
{
  PetscReal size, extent, step;
  Vec       u0 = p->state->path->u, moved;

  PetscFunctionBegin;
  *q           = *p;
  q->quadratic = PETSC_TRUE;
  q->energy    = 0.0;
  PetscCall(VecDuplicate(u0, &q->force));
  PetscCall(VecDuplicate(u0, &q->Kw));
  PetscCall(VecDuplicate(u0, &q->w));
  PetscCall(VecDuplicate(u0, &moved));
  PetscCall(VecNorm(e, NORM_INFINITY, &size));
  PetscCall(VecNorm(p->model->places.x, NORM_INFINITY, &extent));
  step = PETSC_SQRT_MACHINE_EPSILON * extent / size;
  PetscCall(VecWAXPY(moved, step, e, u0));
  PetscCall(EnergyGetGradient(p, moved, q->Kw));
  PetscCall(EnergyGetGradient(p, u0, q->force));
  PetscCall(VecAXPBY(q->force, 1.0 / step, 1.0 - 1.0 / step, q->Kw));
  PetscCall(EnergyGetTangent(p, u0, p->K));
  PetscCall(FrictionCopy(&p->friction, &q->friction));
  PetscCall(VecDestroy(&moved));
  PetscFunctionReturn(0);
}

/*
   Computes the merit of u: its energy, plus the work of the contact forces on the gaps that u violates. forces:
   multipliers of the contact rows; not used without contact
*/
static PetscErrorCode StartMerit(StepProblem *p, Vec u, Vec forces, PetscReal *merit)
{
  PetscScalar work = 0.0;
  Vec         gap, none;

  PetscFunctionBegin;
  PetscCall(EnergyObjective(NULL, u, merit, p));
  if (!p->J || !EnergyIsFinite(*merit)) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(p->g, &gap));
  PetscCall(VecDuplicate(p->g, &none));
  PetscCall(VecSet(none, 0.0));
  PetscCall(StepProblemConstraint(NULL, u, gap, p));
  PetscCall(VecPointwiseMin(gap, gap, none));
  PetscCall(VecDot(gap, forces, &work));
  *merit -= PetscRealPart(work);
  PetscCall(VecDestroy(&none));
  PetscCall(VecDestroy(&gap));
  PetscFunctionReturn(0);
}

/* Passes slacks, pressures and friction forces of the solved model to the optimizer as a start */
static PetscErrorCode StartTake(const StepProblem *p, Tao model, Tao tao)
{
  Vec slack, pressure, force;

  PetscFunctionBegin;
  if (!p->J) PetscFunctionReturn(0);
  PetscCall(TaoIPFilterGetSlack(model, &slack));
  PetscCall(TaoIPFilterGetMultiplier(model, &pressure));
  PetscCall(TaoIPFilterSetWarmStart(tao, slack, pressure));
  if (!p->friction.T) PetscFunctionReturn(0);
  PetscCall(TaoIPFilterGetNormTermForces(model, &force));
  PetscCall(TaoIPFilterSetNormTermForces(tao, force));
  PetscFunctionReturn(0);
}

/*
   Replaces the starting point u by the solution of the quadratic model about the last state, if its merit is lower. The
   model has the contact of the load step. It is therefore as definite as the load step itself, and its solution
   violates no gap.
*/
static PetscErrorCode StartCarry(StepProblem *p, Vec e, PetscReal scale, Tao tao, Vec u)
{
  const PetscReal    rtol = 1e-3; /* suffices for a start */
  StepProblem        q;
  TaoConvergedReason reason;
  PetscBool          ours;
  PetscReal          merit, carried;
  Vec                start, forces;
  Tao                model;

  PetscFunctionBegin;
  PetscCall(StartModel(p, e, &q));
  PetscCall(OptimizerCreate(&q, &model, &ours));
  PetscCall(TaoSetTolerances(model, rtol, PETSC_DEFAULT, PETSC_DEFAULT));
  if (p->J) PetscCall(FrictionGive(&q, model, scale));
  PetscCall(VecDuplicate(u, &start));
  PetscCall(VecCopy(p->base, start));
  PetscCall(TaoSetSolution(model, start));
  PetscCall(TaoSolve(model));
  PetscCall(TaoGetConvergedReason(model, &reason));
  if (reason > 0) {
    PetscCall(TaoGetDualVariables(model, NULL, &forces));
    PetscCall(TiesFollow(&p->model->ties, start));
    PetscCall(StartMerit(p, start, forces, &carried));
    PetscCall(StartMerit(p, u, forces, &merit));
    if (carried < merit) {
      PetscCall(VecCopy(start, u));
      PetscCall(StartTake(p, model, tao));
    }
  }
  PetscCall(TaoDestroy(&model));
  PetscCall(VecDestroy(&start));
  PetscCall(VecDestroy(&q.force));
  PetscCall(VecDestroy(&q.Kw));
  PetscCall(VecDestroy(&q.w));
  PetscCall(FrictionDestroy(&q.friction));
  PetscFunctionReturn(0);
}

/* Finds whether prescribed displacements leave the path. *e: their increments, which the caller frees; NULL: no */
static PetscErrorCode StartLeavesPath(StepProblem *p, Vec *e)
{
  PetscBool smooth = ModelIsDynamic(p->model); /* a time step always continues the path */
  PetscReal size   = 0.0;

  PetscFunctionBegin;
  *e = NULL;
  if (!smooth) PetscCall(PathIsSmooth(p->model, p->state, p->time, &smooth));
  if (smooth) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(p->base, e));
  PetscCall(VecWAXPY(*e, -1.0, p->state->path->u, p->base));
  PetscCall(VecNorm(*e, NORM_INFINITY, &size));
  if (size == 0.0) PetscCall(VecDestroy(e));
  PetscFunctionReturn(0);
}

/*
   Sets the starting point u of a nonlinear load step: the extrapolated path, if `moved`, or p->base. If prescribed
   displacements do not continue the path, they are carried into the bodies. *valid: false if an element is inverted at
   the starting point
*/
static PetscErrorCode StartNonlinear(StepProblem *p, PetscBool moved, PetscReal scale, Tao tao, Vec u, PetscBool *valid)
{
  PetscReal f = PETSC_INFINITY;
  Vec       e;

  PetscFunctionBegin;
  if (moved) {
    PetscCall(PathContinue(p->model, p->state, p->time, u));
    PetscCall(EnergyObjective(tao, u, &f, p));
  }
  if (!EnergyIsFinite(f)) PetscCall(VecCopy(p->base, u));
  PetscCall(StartLeavesPath(p, &e));
  if (e) {
    PetscCall(StartCarry(p, e, scale, tao, u));
    f = PETSC_INFINITY; /* the energy at the carried point is not known yet */
  }
  PetscCall(VecDestroy(&e));
  if (!EnergyIsFinite(f)) PetscCall(EnergyObjective(tao, u, &f, p));
  *valid = EnergyIsFinite(f);
  PetscFunctionReturn(0);
}

/* Sets the tied nodes of u to where p->base has them, as the quadratic model does. Their motion follows afterwards. */
PetscErrorCode StepProblemUntie(StepProblem *p, Vec u)
{
  PetscFunctionBegin;
  if (!p->model->ties.C) PetscFunctionReturn(0);
  PetscCall(VecWAXPY(p->w, -1.0, p->base, u));
  PetscCall(TiesSet(&p->model->ties, 0.0, p->w));
  PetscCall(VecWAXPY(u, 1.0, p->base, p->w));
  PetscFunctionReturn(0);
}

/*
   Sets the starting point u. If `resume`, u is unchanged. A new load step starts from the extrapolated path if the last
   load step had contact pressures, otherwise from p->base. *valid: false if an element is inverted there.
*/
PetscErrorCode StepProblemStart(StepProblem *p, PetscBool resume, Tao tao, Vec u, PetscBool *valid)
{
  PetscReal scale = 0.0;
  PetscBool moved = (PetscBool)(resume || ModelIsDynamic(p->model));
  /* with friction there may be several states, of which the one is wanted that continues the last */
  const PetscBool last = (PetscBool)(p->friction.T && p->model->quadratic);

  PetscFunctionBegin;
  *valid = PETSC_TRUE;
  if (p->J && (resume || p->state->control->warm)) {
    if (resume || last) scale = 1.0;
    else PetscCall(PathPressureScale(p->model, p->state, p->time, &scale));
    PetscCall(StartRecallContact(p, scale, tao, &moved));
  }
  if (p->J) PetscCall(FrictionGive(p, tao, moved ? scale : 0.0));
  if (resume && p->quadratic) PetscCall(StepProblemUntie(p, u));
  if (resume) PetscFunctionReturn(0);
  if (!p->J) moved = p->state->control->warm;
  if (!p->model->quadratic) PetscCall(StartNonlinear(p, moved, scale, tao, u, valid));
  else if (moved && !last) {
    PetscCall(PathContinue(p->model, p->state, p->time, u));
    PetscCall(StepProblemUntie(p, u));
  } else PetscCall(VecCopy(p->base, u));
  PetscFunctionReturn(0);
}
