/*
   Solves contact by the penalty method, for comparison: Newton's method with PCG minimizes
       E(u) - load^T u + 1/2 sum m rho min(c, 0)^2.
     The pressures rho max(-c, 0) leave a penetration of pressure/rho. rho is the factor of -contact_penalty times the
     stiffness of the bodies at the row, 1/(m sum_j J_j^2/K_jj). The Hessian is A = K + J^T D J with D = m rho where c <
     0, and D = 0 elsewhere.
*/
#include "problemimpl.h"
#include <petscsnes.h>
#include <petsctime.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/interrupt.h"
#include "src/state/path.h"

#define PENALTY_MAX_NEWTON 100

typedef struct {
  StepProblem *p;
  Vec          c;         /* linearized gap at the last point at which it was evaluated [length] */
  Vec          stiffness; /* m rho [force/length] */
  Vec          force;     /* m rho max(-c, 0) [force] */
  Mat          K, DJ, JtDJ, A;
  PetscInt     niterations, iterations[PENALTY_MAX_NEWTON]; /* number of PCG iterations in each Newton step */
} Penalty;

/* Computes the contact stiffness of each row, m rho = factor / sum_j J_j^2/K_jj [force/length]. */
static PetscErrorCode PenaltyStiffness(Mat J, Mat K, PetscReal factor, Vec stiffness)
{
  Vec          diagonal;
  Mat          scaled;
  PetscScalar *s;
  PetscInt     rstart, rend;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(K, &diagonal, NULL));
  PetscCall(MatGetDiagonal(K, diagonal));
  PetscCall(VecSqrtAbs(diagonal));
  PetscCall(VecReciprocal(diagonal));
  PetscCall(MatDuplicate(J, MAT_COPY_VALUES, &scaled));
  PetscCall(MatDiagonalScale(scaled, NULL, diagonal));
  PetscCall(MatGetOwnershipRange(J, &rstart, &rend));
  PetscCall(VecGetArrayWrite(stiffness, &s));
  for (PetscInt i = rstart; i < rend; ++i) {
    const PetscScalar *v;
    PetscInt           n;
    PetscReal          flexibility = 0.0;

    PetscCall(MatGetRow(scaled, i, &n, NULL, &v));
    for (PetscInt k = 0; k < n; ++k) flexibility += PetscSqr(PetscRealPart(v[k]));
    PetscCall(MatRestoreRow(scaled, i, &n, NULL, &v));
    s[i - rstart] = flexibility > 0.0 ? factor / flexibility : 0.0;
  }
  PetscCall(VecRestoreArrayWrite(stiffness, &s));
  PetscCall(MatDestroy(&scaled));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(0);
}

/* Computes the linearized gap at u (penalty->c) and the contact forces m rho max(-c, 0) (penalty->force) [force]. */
static PetscErrorCode PenaltyForce(Penalty *penalty, Vec u)
{
  PetscFunctionBegin;
  PetscCall(StepProblemConstraint(NULL, u, penalty->c, penalty->p));
  PetscCall(VecSet(penalty->force, 0.0));
  PetscCall(VecPointwiseMin(penalty->force, penalty->c, penalty->force));
  PetscCall(VecPointwiseMult(penalty->force, penalty->force, penalty->stiffness));
  PetscCall(VecScale(penalty->force, -1.0));
  PetscFunctionReturn(0);
}

static PetscErrorCode PenaltyGradient(SNES snes, Vec u, Vec G, void *ctx)
{
  Penalty  *penalty = (Penalty *)ctx;
  PetscReal f;

  PetscFunctionBegin;
  (void)snes;
  PetscCall(PenaltyForce(penalty, u));
  PetscCall(QuadraticObjectiveAndGradient(NULL, u, &f, G, penalty->p));
  PetscCall(VecScale(penalty->force, -1.0));
  PetscCall(MatMultTransposeAdd(penalty->p->J, penalty->force, G, G));
  PetscFunctionReturn(0);
}

/* Computes J^T D J at u, with D = m rho where c < 0 and D = 0 elsewhere. */
static PetscErrorCode PenaltyProduct(Penalty *penalty, Vec u)
{
  PetscScalar       *d;
  const PetscScalar *stiffness;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(StepProblemConstraint(NULL, u, penalty->c, penalty->p));
  PetscCall(VecCopy(penalty->c, penalty->force));
  PetscCall(VecGetLocalSize(penalty->c, &n));
  PetscCall(VecGetArray(penalty->force, &d));
  PetscCall(VecGetArrayRead(penalty->stiffness, &stiffness));
  for (PetscInt i = 0; i < n; ++i) d[i] = PetscRealPart(d[i]) < 0.0 ? stiffness[i] : 0.0;
  PetscCall(VecRestoreArrayRead(penalty->stiffness, &stiffness));
  PetscCall(VecRestoreArray(penalty->force, &d));
  PetscCall(MatCopy(penalty->p->J, penalty->DJ, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(penalty->DJ, penalty->force, NULL));
  PetscCall(MatTransposeMatMult(penalty->p->J, penalty->DJ, penalty->JtDJ ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX,
    PETSC_DEFAULT, &penalty->JtDJ));
  PetscFunctionReturn(0);
}

static PetscErrorCode PenaltyHessian(SNES snes, Vec u, Mat A, Mat Apre, void *ctx)
{
  Penalty *penalty = (Penalty *)ctx;

  PetscFunctionBegin;
  (void)snes, (void)Apre;
  PetscCall(PenaltyProduct(penalty, u));
  PetscCall(MatZeroEntries(A));
  PetscCall(MatAXPY(A, 1.0, penalty->K, SUBSET_NONZERO_PATTERN));
  PetscCall(MatAXPY(A, 1.0, penalty->JtDJ, SUBSET_NONZERO_PATTERN));
  PetscFunctionReturn(0);
}

/*
   Tests convergence as PETSc's default test does, and also stops if a signal was received. The number of PCG iterations
   is recorded.
*/
static PetscErrorCode PenaltyConverged(SNES snes, PetscInt it, PetscReal xnorm, PetscReal gnorm, PetscReal fnorm,
  SNESConvergedReason *reason, void *ctx)
{
  Penalty  *penalty = (Penalty *)ctx;
  KSP       ksp;
  PetscBool stop;

  PetscFunctionBegin;
  PetscCall(SNESGetKSP(snes, &ksp));
  if (it > 0 && it <= PENALTY_MAX_NEWTON)
    PetscCall(KSPGetIterationNumber(ksp, &penalty->iterations[penalty->niterations++]));
  PetscCall(SNESConvergedDefault(snes, it, xnorm, gnorm, fnorm, reason, NULL));
  PetscCall(InterruptTest(penalty->p->model, penalty->p->state, &stop));
  if (stop && !*reason)
    *reason = SNES_DIVERGED_FUNCTION_NANORINF; /* SNES has no reason for a signal; InterruptReport() reports the
                                                  signal */
  PetscFunctionReturn(0);
}

static PetscErrorCode PenaltyCreate(StepProblem *p, Penalty *penalty)
{
  PetscFunctionBegin;
  PetscCall(PetscMemzero(penalty, sizeof(*penalty)));
  penalty->p = p;
  PetscCall(VecDuplicate(p->g, &penalty->c));
  PetscCall(VecDuplicate(p->g, &penalty->stiffness));
  PetscCall(VecDuplicate(p->g, &penalty->force));
  PetscCall(PenaltyStiffness(p->J, p->K, p->state->control->penalty, penalty->stiffness));
  PetscCall(StiffnessGetWhole(p->model, MATAIJ, &penalty->K));
  PetscCall(MatDuplicate(p->J, MAT_COPY_VALUES, &penalty->DJ));
  PetscCall(PenaltyProduct(penalty, p->base));
  PetscCall(MatDuplicate(penalty->K, MAT_COPY_VALUES, &penalty->A));
  PetscCall(MatAXPY(penalty->A, 1.0, penalty->JtDJ, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatSetOption(penalty->A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode PenaltyDestroy(Penalty *penalty)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&penalty->c));
  PetscCall(VecDestroy(&penalty->stiffness));
  PetscCall(VecDestroy(&penalty->force));
  PetscCall(MatDestroy(&penalty->K));
  PetscCall(MatDestroy(&penalty->DJ));
  PetscCall(MatDestroy(&penalty->JtDJ));
  PetscCall(MatDestroy(&penalty->A));
  PetscFunctionReturn(0);
}

/*
   Creates the solver: Newton's method with full steps and exact linear solves. With it the set of penetrated rows
   settles in a few steps, as in an active set method. With a line search or inexact solves the scene two_block on mesh
   1 needed five to ten times as many steps.
*/
static PetscErrorCode PenaltyCreateSNES(Penalty *penalty, SNES *snes)
{
  SNESLineSearch search;
  KSP            ksp;
  PC             pc;

  PetscFunctionBegin;
  PetscCall(SNESCreate(penalty->p->model->comm, snes));
  PetscCall(SNESSetOptionsPrefix(*snes, "penalty_"));
  PetscCall(SNESSetFunction(*snes, NULL, PenaltyGradient, penalty));
  PetscCall(SNESSetJacobian(*snes, penalty->A, penalty->A, PenaltyHessian, penalty));
  PetscCall(SNESSetTolerances(*snes, 0.0, 1e-8, 0.0, PENALTY_MAX_NEWTON, PETSC_DEFAULT));
  PetscCall(SNESSetConvergenceTest(*snes, PenaltyConverged, penalty, NULL));
  PetscCall(SNESGetLineSearch(*snes, &search));
  PetscCall(SNESLineSearchSetType(search, AMGF_LINESEARCH_NONE));
  PetscCall(SNESGetKSP(*snes, &ksp));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
  PetscCall(KSPSetTolerances(ksp, 1e-3, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(SNESSetFromOptions(*snes));
  PetscCall(StiffnessSetModes(penalty->p->model, ksp, penalty->A));
  PetscFunctionReturn(0);
}

static PetscErrorCode PenaltyReport(Penalty *penalty, SNES snes, Vec u, StepReport *report)
{
  static const PCAMGFCounts none = {0, 0, 0, 0};
  SNESConvergedReason       reason;
  KSP                       ksp;
  Vec                       residual;
  PetscReal                 transmitted;

  PetscFunctionBegin;
  PetscCall(SNESGetConvergedReason(snes, &reason));
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), "%s", SNESConvergedReasons[reason]));
  if (penalty->p->state->control->interrupted) PetscCall(InterruptReport(penalty->p->state, report));
  PetscCall(ReportIterations(report, penalty->niterations, penalty->iterations));
  report->ip_iterations += penalty->niterations;
  report->systems += penalty->niterations;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(ReportPreconditioner(ksp, &none, report));
  PetscCall(SNESGetFunction(snes, &residual, NULL, NULL));
  PetscCall(VecNorm(residual, NORM_2, &report->kkt_error_unscaled));
  PetscCall(PenaltyForce(penalty, u));
  PetscCall(MatMultTranspose(penalty->p->J, penalty->force, penalty->p->w));
  PetscCall(VecNorm(penalty->p->w, NORM_2, &transmitted));
  report->kkt_error = transmitted > 0.0 ? report->kkt_error_unscaled / transmitted : report->kkt_error_unscaled;
  PetscCall(QuadraticEnergy(penalty->p, u, &report->potential));
  PetscFunctionReturn(0);
}

/* Stores gaps and pressures at u, which follow from the contact forces of the penalty method. */
static PetscErrorCode PenaltyKeepContact(Penalty *penalty, ContactSolution *sol)
{
  PetscFunctionBegin;
  PetscCall(ContactSolutionCreate(penalty->c, sol));
  PetscCall(VecCopy(penalty->c, sol->gap));
  PetscCall(VecPointwiseDivide(sol->pressure, penalty->force, penalty->p->state->solved->linearization->mass));
  PetscCall(ContactHistoryStore(penalty->p->state->history, penalty->p->state->solved->linearization, sol, sol->gap,
    penalty->p->model->stiffness));
  PetscFunctionReturn(0);
}

/* Solves the problem of a load step by the penalty method. resume: true if the solve starts from u. */
PetscErrorCode PenaltySolve(StepProblem *p, PetscBool resume, Vec u, StepReport *report, ContactSolution *sol)
{
  Penalty        penalty;
  SNES           snes;
  PetscLogDouble t0, t1;

  PetscFunctionBegin;
  if (!resume && p->state->control->warm) PetscCall(PathContinue(p->model, p->state, p->time, u));
  else if (!resume) PetscCall(VecCopy(p->base, u));
  PetscCall(PetscTime(&t0));
  PetscCall(PenaltyCreate(p, &penalty));
  PetscCall(PenaltyCreateSNES(&penalty, &snes));
  PetscCall(SNESSolve(snes, NULL, u));
  PetscCall(PetscTime(&t1));
  report->solve_time += t1 - t0;
  PetscCall(PenaltyReport(&penalty, snes, u, report));
  if (report->converged) PetscCall(PenaltyKeepContact(&penalty, sol));
  PetscCall(SNESDestroy(&snes));
  PetscCall(PenaltyDestroy(&penalty));
  PetscFunctionReturn(0);
}
