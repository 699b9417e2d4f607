/*
   Newton's method for the contact updates. Let x be where the gap was linearized, u, lambda the solution with the
   linearization at x, and A its rows under pressure. At u the residuals of the forces and of the gap are

     r = J(u)^T lambda - J(x)^T lambda,   -g_A(u),

   and the next x is u + d, where

     K d - d(J^T lambda) = r,   dg_A = -g_A(u).

   The differentials at u along (d, dlambda) are differences of the gap's linearization. They contain what a
   linearization leaves out: the rotation of the normals, the change of the overlaps, the bending of smooth surfaces.
   The system is solved by GMRES. Its preconditioner solves K d - J(x)^T dlambda = f, J_A(x) d = c on the filtered
   subspace, where factors exist already.
*/
#include "stepimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"

#define NEWTON_TOLERANCE    0.1 /* of GMRES at most */
#define NEWTON_ITERATIONS   8
#define NEWTON_FORCES       0.3 /* of that tolerance: forces that the right-hand side's solution may leave off W */
#define NEWTON_APPLICATIONS 2   /* of the preconditioner of K for it */

typedef struct {
  StepProblem         *p;
  ContactLinearization at_u;
  Vec                  u, mask;          /* mask: 0 on prescribed rows, else 1 */
  Vec                  lambda;           /* forces of the rows of sim->solved->linearization [force] */
  Vec                  force, gap;       /* J(u)^T lambda, g(u) on the rows of sim->solved->linearization */
  PetscReal            rtol;             /* of GMRES */
  PetscReal            size, scale;      /* step of the differences [length]; of multipliers [force/length] */
  PetscBool            smooth;           /* false: a difference met rows that come or go */
  PetscInt             napplications;    /* of the preconditioner of K */
  PetscInt             nrows;            /* rows under pressure, of all ranks, that there are at u */
  Vec                  d, f, lambdas, c; /* work */
} GapNewton;

/* f = C^T J^T lambda for forces of the rows of the present linearization, and the gap c of these rows at `at`. Rows
   without pressure have none. n: number of rows with pressure that `at` has, of all ranks */
static PetscErrorCode NewtonEvaluate(GapNewton *s, ContactLinearization at, Vec lambda, Vec f, Vec c, PetscInt *n)
{
  Simulation         sim = s->p->sim;
  const PetscScalar *l, *g;
  PetscScalar       *mine, *gap;
  PetscInt          *row;
  Vec                forces;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(ContactHistoryFollowRows(sim->history, sim->solved->linearization, at, &row));
  PetscCall(VecDuplicate(at->g, &forces));
  PetscCall(VecZeroEntries(forces));
  PetscCall(VecZeroEntries(c));
  PetscCall(VecGetArrayRead(lambda, &l));
  PetscCall(VecGetArrayRead(at->g, &g));
  PetscCall(VecGetArray(forces, &mine));
  PetscCall(VecGetArray(c, &gap));
  for (PetscInt r = 0; r < sim->solved->linearization->nlocal; ++r) {
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
  PetscCall(TiesGather(&sim->ties, f));
  PetscCall(VecPointwiseMult(f, f, s->mask));
  PetscCall(VecDestroy(&forces));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 1, MPIU_INT, MPI_SUM, sim->comm));
  PetscFunctionReturn(0);
}

/* Splits z into s->d and s->lambdas, or the other way round */
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

/* s->f, s->c = differentials at u along s->d, s->lambdas less those of the linearization at x */
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
  if (p->sim->ties.C) PetscCall(MatMult(p->sim->ties.C, s->d, v));
  PetscCall(VecAYPX(v, step, s->u));
  PetscCall(VecWAXPY(lambda, step, s->lambdas, s->lambda));
  PetscCall((s->at_u->gaps_only ? ContactGetGaps : ContactLinearize)(p->sim->contact, v, &lin));
  PetscCall(InterferenceAdd(p->sim, p->time, 1.0, lin));
  PetscCall(NewtonEvaluate(s, lin, lambda, s->f, s->c, &n));
  PetscCall(ContactLinearizationDestroy(&lin));
  s->smooth = (PetscBool)(s->smooth && n == s->nrows);
  PetscCall(VecAXPBY(s->f, -1.0 / step, 1.0 / step, s->force));
  PetscCall(VecAXPBY(s->c, -1.0 / step, 1.0 / step, s->gap));
  PetscCall(MatMult(p->J, s->d, model));
  PetscCall(VecAXPY(s->c, -1.0, model));
  PetscCall(MatMultTranspose(p->J, s->lambdas, v));
  PetscCall(VecAXPY(s->f, -1.0, v));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&lambda));
  PetscCall(VecDestroy(&model));
  PetscFunctionReturn(0);
}

/* Solves for s->d, s->lambdas with the linearization at x: the forces s->f and the change of the gap s->c */
static PetscErrorCode NewtonPrecondition(GapNewton *s, PetscInt most, PetscReal rtol, PetscBool *solved)
{
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(TaoIPFilterSolveActive(s->p->sim->solved->subspace, s->f, s->c, most, rtol, s->d, s->lambdas, &n, solved));
  s->napplications += n;
  PetscFunctionReturn(0);
}

/* y = z + (what the linearization at x leaves out, along z, preconditioned) */
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
  PetscCall(NewtonPrecondition(s, 0, 1.0, &solved));
  s->smooth = (PetscBool)(s->smooth && solved);
  PetscCall(NewtonSplit(s, y, PETSC_TRUE));
  PetscCall(VecAXPY(y, 1.0, z));
  PetscFunctionReturn(0);
}

/* f = C^T J(u)^T lambda. Differences of smooth pairs use J of their facets, which takes less; this is the exact one */
static PetscErrorCode NewtonForce(GapNewton *s, Vec f)
{
  Simulation           sim = s->p->sim;
  ContactLinearization lin;
  PetscInt             n;

  PetscFunctionBegin;
  if (!s->at_u->gaps_only) {
    PetscCall(VecCopy(s->force, f));
    PetscFunctionReturn(0);
  }
  PetscCall(ContactLinearize(sim->contact, s->u, &lin));
  PetscCall(NewtonEvaluate(s, lin, s->lambda, f, s->c, &n));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/* Right-hand side: the residuals at u, preconditioned; sets the scale of the multipliers. solved: false if the last
   solve left no subspace */
static PetscErrorCode NewtonBegin(GapNewton *s, Vec b, PetscBool *solved)
{
  PetscReal forces, length;

  PetscFunctionBegin;
  PetscCall(NewtonEvaluate(s, s->at_u, s->lambda, s->force, s->gap, &s->nrows));
  PetscCall(NewtonForce(s, s->d));
  PetscCall(MatMultTranspose(s->p->J, s->lambda, s->f));
  PetscCall(VecAYPX(s->f, -1.0, s->d));
  PetscCall(VecCopy(s->gap, s->c));
  PetscCall(VecScale(s->c, -1.0));
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
  PetscCall(VecDuplicate(sol->pressure, &s->gap));
  PetscCall(VecDuplicate(sol->pressure, &s->lambdas));
  PetscCall(VecDuplicate(sol->pressure, &s->c));
  PetscCall(VecSet(s->mask, 1.0));
  PetscCall(PrescribedSet(&p->sim->prescribed, 0.0, s->mask));
  PetscCall(VecPointwiseMult(s->lambda, sol->pressure, p->sim->solved->linearization->mass));
  PetscCall(VecScale(s->lambda, 1.0 / StepProblemShare(p)));
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(p->sim->places.x, NORM_INFINITY, &extent));
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
  PetscCall(VecDestroy(&s->gap));
  PetscCall(VecDestroy(&s->lambdas));
  PetscCall(VecDestroy(&s->c));
  PetscFunctionReturn(0);
}

/* Tolerance of GMRES: the rate at which the gap converges, at most NEWTON_TOLERANCE, and not below what ends the
   updates */
static PetscErrorCode NewtonSetTolerance(GapNewton *s, const StepReport *report)
{
  const PetscReal safe = 0.3, allowed = s->p->sim->control->tolerances.gap_change;
  PetscReal       size;

  PetscFunctionBegin;
  PetscCall(VecNorm(s->u, NORM_INFINITY, &size));
  s->rtol = NEWTON_TOLERANCE;
  if (report->contact_updates > 1) s->rtol = PetscMin(s->rtol, report->update_error / s->p->gap_change);
  s->rtol = PetscMin(safe, PetscMax(s->rtol, safe * allowed * size / report->update_error));
  PetscFunctionReturn(0);
}

/* next = u + d. found: false where d is longer than u - x, the step that it corrects, as along motions that little but
   friction or springs holds */
static PetscErrorCode NewtonStep(GapNewton *s, Vec z, Vec x, Vec next, PetscBool *found)
{
  const Mat C = s->p->sim->ties.C;
  PetscReal length, last;

  PetscFunctionBegin;
  PetscCall(NewtonSplit(s, z, PETSC_FALSE));
  PetscCall(VecWAXPY(next, -1.0, x, s->u));
  PetscCall(VecNorm(next, NORM_INFINITY, &last));
  if (C) PetscCall(MatMult(C, s->d, next));
  else PetscCall(VecCopy(s->d, next));
  PetscCall(VecNorm(next, NORM_INFINITY, &length));
  PetscCall(VecAXPY(next, 1.0, s->u));
  *found = (PetscBool)(length <= last);
  PetscFunctionReturn(0);
}

/* Whether updates make progress. If one does not, the gap has kinks, or something turns freely: until the gap converges
   fast again. Not where only rows that have slid off are left, and not where the gap tolerance is near rounding, for
   reproducible results */
static PetscBool NewtonIsNear(StepProblem *p, const StepReport *report)
{
  const PetscReal progress = 0.7, fast = 0.1;

  if (!(report->update_error > 0.0)) return PETSC_FALSE;
  if (p->sim->control->tolerances.gap_change < PETSC_SQRT_MACHINE_EPSILON) return PETSC_FALSE;
  if (report->contact_updates == 1) p->rough = PETSC_FALSE;
  else if (report->update_error >= progress * p->gap_change) p->rough = PETSC_TRUE;
  else if (report->update_error < fast * p->gap_change) p->rough = PETSC_FALSE;
  return (PetscBool)!p->rough;
}

/* Whether the gap of some pair has kinks: that of nodes over facets, where a node crosses an edge */
static PetscErrorCode NewtonFindKinks(Simulation sim, PetscBool *kinks)
{
  PetscFunctionBegin;
  *kinks = PETSC_FALSE;
  for (PetscInt k = 0; k < sim->scene->npairs; ++k) {
    PetscBool curved;

    PetscCall(ContactIsCurved(sim->contact, k, &curved));
    *kinks = (PetscBool)(*kinks || (sim->scene->pairs[k].gap == GAP_NODE && !curved));
  }
  PetscFunctionReturn(0);
}

/* next = u + d. at_u: the gap at u, the solution sol of the present linearization at x. found: false, and next is
   not set, with friction, without the filtered subspace, where rows under pressure come or go
   near u, or after an update without progress */
PetscErrorCode ContactUpdateNewton(StepProblem *p, const ContactSolution *sol, ContactLinearization at_u, Vec x, Vec u,
  Vec next, StepReport *report, PetscBool *found)
{
  GapNewton s = {.p = p, .at_u = at_u, .u = u, .smooth = PETSC_TRUE};
  PetscInt  n, m;
  PetscBool kinks;
  Vec       b, z;

  PetscFunctionBegin;
  *found = PETSC_FALSE;
  PetscCall(NewtonFindKinks(p->sim, &kinks));
  if (kinks || p->friction.T || !p->sim->solved->subspace || !NewtonIsNear(p, report)) PetscFunctionReturn(0);
  PetscCall(NewtonCreate(p, sol, u, &s));
  PetscCall(NewtonSetTolerance(&s, report));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecGetLocalSize(s.lambda, &m));
  PetscCall(VecCreateMPI(p->sim->comm, n + m, PETSC_DETERMINE, &b));
  PetscCall(VecDuplicate(b, &z));
  PetscCall(NewtonBegin(&s, b, found));
  if (*found) PetscCall(MatrixFreeSolve(b, z, &s, NewtonMult, s.rtol, NEWTON_ITERATIONS, found));
  *found = (PetscBool)(*found && s.smooth);
  if (*found) PetscCall(NewtonStep(&s, z, x, next, found));
  report->amg_applications += s.napplications;
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&z));
  PetscCall(NewtonDestroy(&s));
  PetscFunctionReturn(0);
}
