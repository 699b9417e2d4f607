/*
   Newton's method for the contact updates. Let the gap be linearized at x, let u and lambda be the solution with this
   linearization, and let A be the set of its rows under pressure. At u the residuals of the forces and of the gap are
       r = J(u)^T lambda - J(x)^T lambda,  -g_A(u),
     where g includes the depth by which soft pairs yield.
     The next x is u + d, where (d, dlambda) solves
       K d - d(J^T lambda) = r,  dg_A = -g_A(u).
     The differentials d(J^T lambda) and dg_A at u along (d, dlambda) are computed as finite differences of the gap's
     linearization. They contain terms that a linearization omits: the rotation of the normals, the change of the
     overlap areas, and the bending of smooth surfaces.

     GMRES solves the system. Its preconditioner solves K d - J(x)^T dlambda = f, J_A(x) d = c on the subspace,
     for which factors already exist.
*/
#include "contact_updateimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"

#define NEWTON_TOLERANCE 0.1 /* largest relative tolerance of GMRES */
#define NEWTON_SLOW \
  0.05 /* if the last update left a larger fraction of the error, finite differences use exact forces */
#define NEWTON_ITERATIONS 8
#define NEWTON_FORCES \
  0.3 /* the solve that gives the right-hand side may leave forces outside of the subspace
                                   W up to this fraction of the tolerance */
#define NEWTON_LONGEST \
  5.0 /* longest step, as a multiple of the step that it corrects. Longer than 1 where contact updates alone move
          away from the solution */
#define NEWTON_APPLICATIONS 2 /* largest number of applications of the preconditioner of K in this solve */
#define NEWTON_TOO_SMALL \
  5.0 /* if the error of the last update exceeds its tolerance by this factor, the subspace does not
                                contain the solution of Newton's method, and every product adds a direction */

typedef struct {
  StepProblem         *p;
  ContactLinearization at_u;
  Vec                  u, mask;          /* mask: 0 in prescribed rows, 1 in other rows */
  Vec                  lambda;           /* forces of the rows of state->solved->linearization, 0 in rows that are not
                                            followed [force] */
  Vec                  followed;         /* 1 in rows under pressure that exist at u; 0 in the other rows, whose
                                            differentials remain those of the linearization at x */
  Vec                  yield;            /* depth by which soft pairs yield, or NULL [length] */
  Vec                  force, gap;       /* force: J(u)^T lambda [force]; gap: g(u) on the rows of
                                            state->solved->linearization [length] */
  PetscReal            rtol;             /* relative tolerance of GMRES */
  PetscInt             most;             /* largest number of applications of the preconditioner of K in a product */
  PetscReal            size, scale;      /* size: step of the finite differences [length]; scale: divisor that gives
                                            multipliers the unit of a length [force/length] */
  PetscBool            gaps_only;        /* finite differences use the matrix J of the facets for smooth pairs, which
                                            takes less time than the exact one */
  PetscBool            smooth;           /* false if the rows under pressure at the points of a finite difference
                                            differ */
  PetscInt             napplications;    /* number of applications of the preconditioner of K */
  PetscInt             nrows;            /* number of rows under pressure, on all ranks, that exist at u */
  Vec                  d, f, lambdas, c; /* work vectors; d, lambdas: the two parts of an unknown vector; f, c: the
                                            two parts of a right-hand side */
} GapNewton;

/* Linearizes the gap at v. It counts to the phase of contact, and the rest of Newton's method to that of the solve */
static PetscErrorCode NewtonLinearize(GapNewton *s, Vec v, PetscBool gaps_only, ContactLinearization *lin)
{
  Contact contact = s->p->model->contact;

  PetscFunctionBegin;
  PetscCall(PetscLogEventEnd(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscCall(ContactLinearize(contact, v, gaps_only ? CONTACT_GAPS : CONTACT_FORCES, lin));
  PetscCall(PetscLogEventBegin(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*
   Computes forces and gap of a linearization for the rows of state->solved->linearization. at: the linearization;
   lambda: forces of the rows [force]; f: C^T J^T lambda with J of `at` [force]; c: gap of the rows in `at`, 0 in rows
   without pressure or without a row in `at` [length]; *n: number of rows under pressure that `at` contains, on all
   ranks.
*/
static PetscErrorCode NewtonEvaluate(GapNewton *s, ContactLinearization at, Vec lambda, Vec f, Vec c, PetscInt *n)
{
  const PetscScalar *l, *g;
  PetscScalar       *mine, *gap;
  PetscInt          *row;
  Vec                forces;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(ContactHistoryFollowRows(s->p->state->history, s->p->state->solved->linearization, at, &row));
  PetscCall(VecDuplicate(at->g, &forces));
  PetscCall(VecZeroEntries(forces));
  PetscCall(VecZeroEntries(c));
  PetscCall(VecGetArrayRead(lambda, &l));
  PetscCall(VecGetArrayRead(at->g, &g));
  PetscCall(VecGetArray(forces, &mine));
  PetscCall(VecGetArray(c, &gap));
  for (PetscInt r = 0; r < s->p->state->solved->linearization->nlocal; ++r) {
    if (row[r] < 0) continue;
    mine[row[r]] = l[r];
    gap[r]       = g[row[r]];
    ++*n;
  }
  PetscCall(VecRestoreArray(c, &gap));
  PetscCall(VecRestoreArray(forces, &mine));
  PetscCall(VecRestoreArrayRead(at->g, &g));
  PetscCall(VecRestoreArrayRead(lambda, &l));
  PetscCall(PetscFree(row));
  PetscCall(MatMultTranspose(at->J, forces, f));
  PetscCall(TiesGather(&s->p->model->ties, f));
  PetscCall(VecPointwiseMult(f, f, s->mask));
  PetscCall(VecDestroy(&forces));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 1, MPIU_INT, MPI_SUM, s->p->model->comm));
  PetscFunctionReturn(0);
}

/* Sets s->followed and s->nrows, and sets s->lambda to 0 in the other rows */
static PetscErrorCode NewtonFollow(GapNewton *s)
{
  PetscScalar *followed;
  PetscInt    *row;

  PetscFunctionBegin;
  s->nrows = 0;
  PetscCall(ContactHistoryFollowRows(s->p->state->history, s->p->state->solved->linearization, s->at_u, &row));
  PetscCall(VecGetArrayWrite(s->followed, &followed));
  for (PetscInt r = 0; r < s->p->state->solved->linearization->nlocal; ++r) {
    followed[r] = row[r] < 0 ? 0.0 : 1.0;
    s->nrows += row[r] >= 0;
  }
  PetscCall(VecRestoreArrayWrite(s->followed, &followed));
  PetscCall(PetscFree(row));
  PetscCall(VecPointwiseMult(s->lambda, s->lambda, s->followed));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &s->nrows, 1, MPIU_INT, MPI_SUM, s->p->model->comm));
  PetscFunctionReturn(0);
}

/*
   Copies z to s->d and s->lambdas; if `join`, copies s->d and s->lambdas to z. In z the multipliers are divided by
   s->scale.
*/
static PetscErrorCode NewtonSplit(GapNewton *s, Vec z, PetscBool join)
{
  PetscScalar *a, *d, *l;
  PetscInt     n, m;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(s->d, &n));
  PetscCall(VecGetLocalSize(s->lambdas, &m));
  PetscCall(VecGetArray(z, &a));
  PetscCall(VecGetArray(s->d, &d));
  PetscCall(VecGetArray(s->lambdas, &l));
  PetscCall(PetscArraycpy(join ? a : d, join ? d : a, n));
  for (PetscInt i = 0; i < m; ++i) {
    if (join) a[n + i] = l[i] / s->scale;
    else l[i] = a[n + i] * s->scale;
  }
  PetscCall(VecRestoreArray(s->lambdas, &l));
  PetscCall(VecRestoreArray(s->d, &d));
  PetscCall(VecRestoreArray(z, &a));
  PetscFunctionReturn(0);
}

/*
   Sets s->f and s->c to the differentials at u along (s->d, s->lambdas), less the differentials that the linearization
   at x has in this direction.
*/
static PetscErrorCode NewtonDifference(GapNewton *s)
{
  StepProblem         *p = s->p;
  ContactLinearization lin;
  PetscReal            length, step;
  PetscInt             n;
  Vec                  v, lambda, model;

  PetscFunctionBegin;
  PetscCall(VecNorm(s->d, NORM_INFINITY, &length));
  PetscCall(VecZeroEntries(s->f));
  PetscCall(VecZeroEntries(s->c));
  if (length == 0.0) PetscFunctionReturn(0);
  step = s->size / length;
  PetscCall(VecDuplicate(s->d, &v));
  PetscCall(VecDuplicate(s->lambda, &lambda));
  PetscCall(VecDuplicate(s->c, &model));
  PetscCall(VecCopy(s->d, v));
  if (p->model->ties.C) PetscCall(MatMult(p->model->ties.C, s->d, v));
  PetscCall(VecAYPX(v, step, s->u));
  PetscCall(VecWAXPY(lambda, step, s->lambdas, s->lambda));
  PetscCall(NewtonLinearize(s, v, s->gaps_only, &lin));
  PetscCall(InterferenceAdd(p->model, p->state, p->time, 1.0, lin));
  PetscCall(NewtonEvaluate(s, lin, lambda, s->f, s->c, &n));
  PetscCall(ContactLinearizationDestroy(&lin));
  s->smooth = (PetscBool)(s->smooth && n == s->nrows);
  PetscCall(VecAXPBY(s->f, -1.0 / step, 1.0 / step, s->force));
  PetscCall(VecAXPBY(s->c, -1.0 / step, 1.0 / step, s->gap));
  PetscCall(MatMult(p->J, s->d, model));
  PetscCall(VecPointwiseMult(model, model, s->followed));
  PetscCall(VecAXPY(s->c, -1.0, model));
  PetscCall(VecPointwiseMult(lambda, s->lambdas, s->followed));
  PetscCall(MatMultTranspose(p->J, lambda, v));
  PetscCall(VecAXPY(s->f, -1.0, v));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&lambda));
  PetscCall(VecDestroy(&model));
  PetscFunctionReturn(0);
}

/*
   Solves for s->d and s->lambdas with the linearization at x. The right-hand side is s->f, the forces, and s->c, the
   change of the gap. most: largest number of applications of the preconditioner of K; rtol: relative tolerance of
   forces outside of the subspace; *solved: false if there is no solution.
*/
static PetscErrorCode NewtonPrecondition(GapNewton *s, PetscInt most, PetscReal rtol, PetscBool *solved)
{
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(
    TaoIPFilterSolveActive(s->p->state->solved->subspace, s->f, s->c, most, rtol, s->d, s->lambdas, &n, solved));
  s->napplications += n;
  PetscFunctionReturn(0);
}

/*
   Computes y = z + P e, where e contains the differentials along z that the linearization at x omits, and P is the
   preconditioner.
*/
static PetscErrorCode NewtonMult(Mat shell, Vec z, Vec y)
{
  GapNewton *s;
  PetscBool  solved;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(shell, &s));
  PetscCall(VecCopy(z, y));
  PetscCall(NewtonSplit(s, y, PETSC_FALSE));
  PetscCall(NewtonDifference(s));
  PetscCall(VecScale(s->f, -1.0));
  PetscCall(NewtonPrecondition(s, s->most, s->rtol, &solved));
  s->smooth = (PetscBool)(s->smooth && solved);
  PetscCall(NewtonSplit(s, y, PETSC_TRUE));
  PetscCall(VecAXPY(y, 1.0, z));
  PetscFunctionReturn(0);
}

/* Computes f = C^T J(u)^T lambda exactly. For smooth pairs s->force is not exact if s->gaps_only. */
static PetscErrorCode NewtonForce(GapNewton *s, Vec f)
{
  ContactLinearization lin;
  PetscInt             n;

  PetscFunctionBegin;
  if (!s->at_u->gaps_only) {
    PetscCall(VecCopy(s->force, f));
    PetscFunctionReturn(0);
  }
  PetscCall(NewtonLinearize(s, s->u, PETSC_FALSE, &lin));
  PetscCall(NewtonEvaluate(s, lin, s->lambda, f, s->c, &n));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/*
   Computes the preconditioned right-hand side b from the residuals at u, and sets the scale of the multipliers.
   *solved: false if the last solve has no subspace, or if the solve for b failed.
*/
static PetscErrorCode NewtonBegin(GapNewton *s, Vec b, PetscBool *solved)
{
  PetscReal forces, length;
  PetscInt  n;

  PetscFunctionBegin;
  PetscCall(NewtonFollow(s));
  PetscCall(NewtonEvaluate(s, s->at_u, s->lambda, s->force, s->gap, &n));
  PetscCall(NewtonForce(s, s->d));
  if (!s->gaps_only) PetscCall(VecCopy(s->d, s->force));
  PetscCall(MatMultTranspose(s->p->J, s->lambda, s->f));
  PetscCall(VecAYPX(s->f, -1.0, s->d));
  PetscCall(VecZeroEntries(s->c));
  if (s->yield) PetscCall(VecPointwiseMult(s->c, s->yield, s->followed));
  PetscCall(VecAXPBY(s->c, -1.0, -1.0, s->gap));
  PetscCall(NewtonPrecondition(s, NEWTON_APPLICATIONS, NEWTON_FORCES * s->rtol, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(VecNorm(s->lambdas, NORM_2, &forces));
  PetscCall(VecNorm(s->d, NORM_2, &length));
  *solved = (PetscBool)(length > 0.0 && !PetscIsInfOrNanReal(length + forces));
  if (!*solved) PetscFunctionReturn(0);
  s->scale = forces > 0.0 ? forces / length : 1.0;
  PetscCall(NewtonSplit(s, b, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode NewtonCreate(StepProblem *p, const ContactSolution *sol, Vec u, GapNewton *s)
{
  PetscReal size, extent;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &s->mask));
  PetscCall(VecDuplicate(u, &s->force));
  PetscCall(VecDuplicate(u, &s->d));
  PetscCall(VecDuplicate(u, &s->f));
  PetscCall(VecDuplicate(sol->pressure, &s->lambda));
  PetscCall(VecDuplicate(sol->pressure, &s->followed));
  PetscCall(VecDuplicate(sol->pressure, &s->gap));
  PetscCall(VecDuplicate(sol->pressure, &s->lambdas));
  PetscCall(VecDuplicate(sol->pressure, &s->c));
  PetscCall(VecSet(s->mask, 1.0));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, s->mask));
  PetscCall(VecPointwiseMult(s->lambda, sol->pressure, p->state->solved->linearization->mass));
  PetscCall(VecScale(s->lambda, 1.0 / StepProblemShare(p)));
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(p->model->places.x, NORM_INFINITY, &extent));
  s->size = PetscMax(1e-6 * size, PETSC_SQRT_MACHINE_EPSILON * extent);
  PetscFunctionReturn(0);
}

static PetscErrorCode NewtonDestroy(GapNewton *s)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&s->mask));
  PetscCall(VecDestroy(&s->force));
  PetscCall(VecDestroy(&s->d));
  PetscCall(VecDestroy(&s->f));
  PetscCall(VecDestroy(&s->lambda));
  PetscCall(VecDestroy(&s->followed));
  PetscCall(VecDestroy(&s->gap));
  PetscCall(VecDestroy(&s->lambdas));
  PetscCall(VecDestroy(&s->c));
  PetscFunctionReturn(0);
}

/*
   Sets how accurate the method is. The tolerance of GMRES is the rate at which the gap converges, but at most
   NEWTON_TOLERANCE, and no smaller than what reduces the error of the update to the gap tolerance.
*/
static PetscErrorCode NewtonSetAccuracy(GapNewton *s, const StepReport *report)
{
  const PetscReal safe = 0.3, allowed = s->p->state->control->tolerances.gap_change;
  PetscReal       size;

  PetscFunctionBegin;
  PetscCall(VecNorm(s->u, NORM_INFINITY, &size));
  s->gaps_only = s->at_u->gaps_only;
  s->rtol      = NEWTON_TOLERANCE;
  if (report->contact_updates > 1) {
    const PetscReal rate = report->update_error / s->p->gap_change;

    s->gaps_only = (PetscBool)(s->gaps_only && rate <= NEWTON_SLOW);
    s->rtol      = PetscMin(s->rtol, rate);
    s->most      = s->p->by_newton && rate > NEWTON_TOO_SMALL * s->p->newton_rtol;
  }
  s->rtol           = PetscMin(safe, PetscMax(s->rtol, safe * allowed * size / report->update_error));
  s->p->newton_rtol = s->rtol;
  PetscFunctionReturn(0);
}

/*
   Computes next = u + d. *found: false if d is much longer than u - x, the step that d corrects; this happens if a
   motion is resisted only by friction or springs.
*/
static PetscErrorCode NewtonStep(GapNewton *s, Vec z, Vec x, Vec next, PetscBool *found)
{
  const Mat C = s->p->model->ties.C;
  PetscReal length, last;

  PetscFunctionBegin;
  PetscCall(NewtonSplit(s, z, PETSC_FALSE));
  PetscCall(VecWAXPY(next, -1.0, x, s->u));
  PetscCall(VecNorm(next, NORM_INFINITY, &last));
  if (C) PetscCall(MatMult(C, s->d, next));
  else PetscCall(VecCopy(s->d, next));
  PetscCall(VecNorm(next, NORM_INFINITY, &length));
  PetscCall(VecAXPY(next, 1.0, s->u));
  *found = (PetscBool)(length <= NEWTON_LONGEST * last);
  PetscFunctionReturn(0);
}

/*
   Returns whether contact updates make progress. If one does not (the gap has kinks, or a body turns freely), p->rough
   is true until the gap converges fast again. Returns false also if only rows that have slid off are left, and if the
   gap tolerance is near rounding, so that results are reproducible.
*/
static PetscBool NewtonIsNear(StepProblem *p, const StepReport *report)
{
  const PetscReal progress = 1.0, fast = 0.5;

  if (!(report->update_error > 0.0)) return PETSC_FALSE;
  if (p->state->control->tolerances.gap_change < PETSC_SQRT_MACHINE_EPSILON) return PETSC_FALSE;
  if (report->contact_updates == 1) p->rough = PETSC_FALSE;
  else if (report->update_error >= progress * p->gap_change) p->rough = PETSC_TRUE;
  else if (report->update_error < fast * p->gap_change) p->rough = PETSC_FALSE;
  return (PetscBool)!p->rough;
}

/*
   Finds whether the gap of any pair has kinks. This is the case for gaps of nodes over flat facets, where a node
   crosses an edge.
*/
static PetscErrorCode NewtonFindKinks(Model model, PetscBool *kinks)
{
  PetscFunctionBegin;
  *kinks = PETSC_FALSE;
  for (PetscInt k = 0; k < model->scene->npairs; ++k) {
    PetscBool curved;

    PetscCall(ContactIsCurved(model->contact, k, &curved));
    *kinks = (PetscBool)(*kinks || (model->scene->pairs[k].gap == GAP_NODE && !curved));
  }
  PetscFunctionReturn(0);
}

/*
   Computes the next point of linearization, next = u + d, by Newton's method. at_u: gap at u; sol: solution with the
   present linearization, which was made at x. *found: false, and `next` is not set, in the following cases: with
   friction; without a subspace; if a gap has kinks; if rows under pressure appear or disappear near u; after
   an update without progress; or if GMRES does not converge.
*/
PetscErrorCode ContactUpdateNewton(StepProblem *p, const ContactSolution *sol, ContactLinearization at_u, Vec x, Vec u,
  Vec next, StepReport *report, PetscBool *found)
{
  GapNewton s = {.p = p, .at_u = at_u, .u = u, .yield = sol->yield, .smooth = PETSC_TRUE};
  PetscInt  n, m;
  PetscBool kinks;
  Vec       b, z;

  PetscFunctionBegin;
  *found = PETSC_FALSE;
  PetscCall(NewtonFindKinks(p->model, &kinks));
  if (kinks || p->friction.T || !p->state->solved->subspace || !NewtonIsNear(p, report)) PetscFunctionReturn(0);
  PetscCall(PetscLogEventBegin(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscCall(NewtonCreate(p, sol, u, &s));
  PetscCall(NewtonSetAccuracy(&s, report));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecGetLocalSize(s.lambda, &m));
  PetscCall(VecCreateMPI(p->model->comm, n + m, PETSC_DETERMINE, &b));
  PetscCall(VecDuplicate(b, &z));
  PetscCall(NewtonBegin(&s, b, found));
  if (*found) PetscCall(MatrixFreeSolve(b, z, &s, NewtonMult, s.rtol, NEWTON_ITERATIONS, found));
  *found = (PetscBool)(*found && s.smooth);
  if (*found) PetscCall(NewtonStep(&s, z, x, next, found));
  report->amg_applications += s.napplications;
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&z));
  PetscCall(NewtonDestroy(&s));
  PetscCall(PetscLogEventEnd(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
