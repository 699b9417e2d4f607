#define _GNU_SOURCE /* RTLD_NEXT */
static char help[] =
  "The subspace method: the interior point method's solution for a fraction of its linear iterations,\n\
on the same solver and on another\n\
one again, with dependent rows, by Newton's method where the objective is not quadratic; the interior point\n\
method where it cannot be.\n\n";

#include "../lib/attempt.h"
#include "ipfilter_problem.h"
#include <dlfcn.h>

/* A membrane of n x n points over a cap, min 1/2 u^T H u - b^T u, g + J u >= 0: what J and H are made of */
typedef struct {
  QuadraticProgram q;
  PetscReal        quartic;   /* of the objective's term quartic/4 sum u^4, which makes the Hessian change */
  PetscReal        stiffness; /* added to H's diagonal: negative makes it indefinite */
  PetscInt         copies;    /* of every row of J */
} Membrane;

static PetscErrorCode AssembleMembrane(PetscInt n, Membrane *m)
{
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, n * n, n * n, 5, NULL, 4, NULL, &m->q.H));
  PetscCall(MatCreateVecs(m->q.H, &m->q.b, NULL));
  PetscCall(MatGetOwnershipRange(m->q.H, &start, &end));
  for (PetscInt r = start; r < end; r++) {
    const PetscInt i = r % n, j = r / n,
                   near[4] = {i > 0 ? r - 1 : -1, i < n - 1 ? r + 1 : -1, j > 0 ? r - n : -1, j < n - 1 ? r + n : -1};

    PetscCall(MatSetValue(m->q.H, r, r, 4.0 + m->stiffness, INSERT_VALUES));
    for (PetscInt k = 0; k < 4; k++) PetscCall(MatSetValue(m->q.H, r, near[k], -1.0, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(m->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(m->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecSet(m->q.b, -2.0 / PetscSqr(n)));
  PetscFunctionReturn(0);
}

/* Every point of the cap and its right neighbour stay above it in the mean; the ranks that own the edge alone have no
   rows */
static PetscErrorCode AssembleCap(PetscInt n, PetscReal lift, Membrane *m)
{
  PetscInt start, end, first, nlocal, count = 0;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&m->q.J));
  PetscCall(VecDestroy(&m->q.g));
  PetscCall(MatGetOwnershipRange(m->q.H, &start, &end));
  PetscCall(VecGetLocalSize(m->q.b, &nlocal));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(
        MatCreateAIJ(PETSC_COMM_WORLD, count, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 2, NULL, 2, NULL, &m->q.J));
      PetscCall(MatCreateVecs(m->q.J, NULL, &m->q.g));
      PetscCall(MatGetOwnershipRange(m->q.J, &first, NULL));
    }
    count = 0;
    for (PetscInt r = start; r < end; r++) {
      const PetscReal x = (r % n + 1.0) / (n + 1.0) - 0.5, y = (r / n + 1.0) / (n + 1.0) - 0.5, r2 = x * x + y * y;

      for (PetscInt copy = 0; copy < m->copies && r2 < 0.06; copy++, count++) {
        if (!pass) continue;
        PetscCall(MatSetValue(m->q.J, first + count, r, 0.5, INSERT_VALUES));
        PetscCall(MatSetValue(m->q.J, first + count, r + 1, 0.5, INSERT_VALUES));
        PetscCall(VecSetValue(m->q.g, first + count, lift - 0.08 - 0.4 * r2, INSERT_VALUES));
      }
    }
  }
  PetscCall(MatAssemblyBegin(m->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(m->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(m->q.g));
  PetscCall(VecAssemblyEnd(m->q.g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Gradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Membrane   *m = (Membrane *)user;
  PetscScalar sum;
  Vec         cube;

  PetscFunctionBeginUser;
  PetscCall(ProblemObjectiveAndGradient(tao, x, f, g, user));
  if (m->quartic == 0.0) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(x, &cube));
  PetscCall(VecPointwiseMult(cube, x, x));
  PetscCall(VecPointwiseMult(cube, cube, x));
  PetscCall(VecAXPY(g, m->quartic, cube));
  PetscCall(VecDot(cube, x, &sum));
  *f += 0.25 * m->quartic * PetscRealPart(sum);
  PetscCall(VecDestroy(&cube));
  PetscFunctionReturn(0);
}

static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat B, void *user)
{
  Membrane *m = (Membrane *)user;
  Vec       square;

  PetscFunctionBeginUser;
  (void)tao;
  (void)B;
  if (m->quartic == 0.0) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(x, &square));
  PetscCall(VecPointwiseMult(square, x, x));
  PetscCall(VecScale(square, 3.0 * m->quartic));
  PetscCall(VecShift(square, 4.0 + m->stiffness));
  PetscCall(MatDiagonalSet(H, square, INSERT_VALUES));
  PetscCall(VecDestroy(&square));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateTao(Membrane *m, Vec x, const char subspace[], Tao *tao)
{
  Mat H = m->q.H; /* the objective's own, which a Hessian that changes must not be written into */

  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&m->q, x, tao));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, Gradient, m));
  if (m->quartic == 0.0) PetscCall(PetscObjectReference((PetscObject)H));
  else PetscCall(MatDuplicate(H, MAT_COPY_VALUES, &H));
  PetscCall(TaoSetHessian(*tao, H, H, Hessian, m));
  PetscCall(MatDestroy(&H));
  PetscCall(TaoSetTolerances(*tao, 1e-10, 0.0, 0.0));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_subspace", subspace));
  PetscCall(TaoSetFromOptions(*tao));
  PetscFunctionReturn(0);
}

/* Solves from zero; the objective, linear iterations in all, and how often the interior point method had to go on */
static PetscErrorCode Solve(Tao tao, PetscReal *f, PetscInt *its, PetscInt *left)
{
  TaoIPFilterFallbacks fallbacks;
  Vec                  x;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolution(tao, &x));
  PetscCall(VecSet(x, 0.0));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, f, NULL, NULL, NULL, NULL));
  PetscCall(TaoGetLinearSolveIterations(tao, its));
  PetscCall(TaoIPFilterGetFallbacks(tao, &fallbacks));
  *left = fallbacks.subspaces;
  PetscFunctionReturn(0);
}

/* Solution and forces of two solvers; the objectives' difference, relative, is of second order */
static PetscErrorCode CompareSolutions(Membrane *m, Tao tao, Tao other, PetscReal objective)
{
  Vec       x, z, y, DI, DY, force;
  PetscReal size, error;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolution(tao, &x));
  PetscCall(TaoGetSolution(other, &z));
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecCopy(z, y));
  PetscCall(VecDuplicate(x, &force));
  PetscCall(ProblemVerdict("  objective, relative", objective, 1e-8));
  PetscCall(VecNorm(y, NORM_INFINITY, &size));
  PetscCall(VecAXPY(y, -1.0, x));
  PetscCall(VecNorm(y, NORM_INFINITY, &error));
  PetscCall(ProblemVerdict("  solution, relative", error / size, 1e-7));
  PetscCall(TaoGetDualVariables(tao, NULL, &DI));
  PetscCall(TaoGetDualVariables(other, NULL, &DY));
  PetscCall(MatMultTranspose(m->q.J, DY, force));
  PetscCall(VecNorm(force, NORM_INFINITY, &size));
  PetscCall(MatMultTranspose(m->q.J, DI, y));
  PetscCall(VecAXPY(force, -1.0, y));
  PetscCall(VecNorm(force, NORM_INFINITY, &error));
  PetscCall(ProblemVerdict("  forces, relative", error / size, 1e-7));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/* A solver against the interior point method: its end and its solution */
static PetscErrorCode Compare(const char what[], Membrane *m, Tao tao, PetscInt *interior)
{
  Vec                x, y;
  Tao                other;
  PetscReal          f, g;
  PetscInt           left;
  TaoConvergedReason reason, expected;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolution(tao, &x));
  PetscCall(VecDuplicate(x, &y));
  PetscCall(CreateTao(m, y, "false", &other));
  PetscCall(Solve(other, &g, interior, &left));
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoGetConvergedReason(other, &expected));
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", what, reason == expected ? "the same end" : TaoConvergedReasons[reason]));
  PetscCall(CompareSolutions(m, tao, other, PetscAbsReal(f - g) / PetscAbsReal(g)));
  PetscCall(TaoDestroy(&other));
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(0);
}

static PetscErrorCode Expect(const char what[], PetscBool holds, PetscInt a, PetscInt b)
{
  PetscFunctionBeginUser;
  if (holds) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s\n", what));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  NOT %s: %" PetscInt_FMT ", %" PetscInt_FMT "\n", what, a, b));
  PetscFunctionReturn(0);
}

/* Another cap on the same solver, and a third on another solver that the directions are handed to */
static PetscErrorCode TestKept(PetscInt n)
{
  Membrane       m = {.copies = 1};
  PetscReal      f;
  PetscInt       its[3], interior, left, lost = 0;
  PetscContainer space;
  Tao            tao, next;
  Vec            x;

  PetscFunctionBeginUser;
  PetscCall(AssembleMembrane(n, &m));
  PetscCall(AssembleCap(n, 0.0, &m));
  PetscCall(VecDuplicate(m.q.b, &x));
  PetscCall(CreateTao(&m, x, "true", &tao));
  PetscCall(Solve(tao, &f, &its[0], &left));
  lost += left;
  PetscCall(Compare("first cap", &m, tao, &interior));
  PetscCall(Expect("at most half of the interior point method's linear iterations", (PetscBool)(2 * its[0] <= interior),
    its[0], interior));
  PetscCall(VecShift(m.q.g, -0.002));
  PetscCall(Solve(tao, &f, &its[1], &left));
  lost += left;
  PetscCall(Compare("second cap, the same solver", &m, tao, &interior));
  PetscCall(Expect("fewer than the first", (PetscBool)(its[1] < its[0]), its[1], its[0]));
  PetscCall(TaoIPFilterGetSubspace(tao, &space));
  PetscCall(PetscObjectReference((PetscObject)space));
  PetscCall(TaoDestroy(&tao));
  PetscCall(AssembleCap(n, -0.004, &m));
  PetscCall(CreateTao(&m, x, "true", &next));
  PetscCall(TaoIPFilterSetSubspace(next, space));
  PetscCall(PetscContainerDestroy(&space));
  PetscCall(Solve(next, &f, &its[2], &left));
  lost += left;
  PetscCall(Compare("third cap, another solver", &m, next, &interior));
  PetscCall(Expect("fewer than the first", (PetscBool)(its[2] < its[0]), its[2], its[0]));
  PetscCall(Expect("never left", (PetscBool)!lost, lost, 0));
  PetscCall(TaoDestroy(&next));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&m.q));
  PetscFunctionReturn(0);
}

/* How the solution and its forces change when the cap rises: H v = J^T lambda, J v = -1 in active rows */
static PetscErrorCode TestActive(PetscInt n)
{
  Membrane       m = {.copies = 1};
  PetscReal      f, all, left, forces;
  PetscInt       its, fallbacks, applications;
  PetscBool      solved;
  PetscContainer space;
  Tao            tao;
  Vec            x, v, force, rise, lambda;

  PetscFunctionBeginUser;
  PetscCall(AssembleMembrane(n, &m));
  PetscCall(AssembleCap(n, 0.0, &m));
  PetscCall(VecDuplicate(m.q.b, &x));
  PetscCall(VecDuplicate(m.q.b, &v));
  PetscCall(VecDuplicate(m.q.b, &force));
  PetscCall(VecDuplicate(m.q.g, &rise));
  PetscCall(VecDuplicate(m.q.g, &lambda));
  PetscCall(CreateTao(&m, x, "true", &tao));
  PetscCall(Solve(tao, &f, &its, &fallbacks));
  PetscCall(TaoIPFilterGetSubspace(tao, &space));
  PetscCall(VecZeroEntries(force));
  PetscCall(VecSet(rise, -1.0));
  PetscCall(TaoIPFilterSolveActive(space, force, rise, 50, 1e-8, v, lambda, &applications, &solved));
  PetscCall(Expect("active rows: solved", solved, applications, 0));
  PetscCall(MatMult(m.q.H, v, x));
  PetscCall(VecNorm(x, NORM_2, &all));
  PetscCall(MatMultTranspose(m.q.J, lambda, force));
  PetscCall(VecAXPY(x, -1.0, force));
  PetscCall(VecNorm(x, NORM_2, &left));
  PetscCall(Expect("forces in balance to 1e-6", (PetscBool)(all > 0.0 && left < 1e-6 * all), applications, 0));
  PetscCall(MatMult(m.q.J, v, rise));
  PetscCall(VecShift(rise, 1.0));
  PetscCall(VecPointwiseMult(rise, rise, lambda));
  PetscCall(VecNorm(lambda, NORM_2, &forces));
  PetscCall(VecNorm(rise, NORM_2, &left));
  PetscCall(Expect("rows with a force follow to 1e-8", (PetscBool)(left < 1e-8 * forces), applications, 0));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&lambda));
  PetscCall(VecDestroy(&rise));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&m.q));
  PetscFunctionReturn(0);
}

/* One solve of a membrane, and whether the interior point method had to go on; negative: it may */
static PetscErrorCode TestOne(const char what[], PetscInt n, Membrane *m, PetscInt leaves)
{
  PetscReal f;
  PetscInt  its, interior, left;
  Tao       tao;
  Vec       x;

  PetscFunctionBeginUser;
  PetscCall(AssembleMembrane(n, m));
  PetscCall(AssembleCap(n, 0.0, m));
  PetscCall(VecDuplicate(m->q.b, &x));
  PetscCall(CreateTao(m, x, "true", &tao));
  PetscCall(Solve(tao, &f, &its, &left));
  PetscCall(Compare(what, m, tao, &interior));
  if (leaves >= 0)
    PetscCall(
      Expect(leaves ? "left for the interior point method" : "never left", (PetscBool)(left == leaves), left, leaves));
  if (m->quartic > 0.0 && m->stiffness == 0.0)
    PetscCall(Expect("at most half of the interior point method's linear iterations", (PetscBool)(2 * its <= interior),
      its, interior));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&m->q));
  PetscFunctionReturn(0);
}

/* A limit of Newton steps is none of directions, which the Krylov method's limit holds for */
static PetscErrorCode TestLimit(const char option[], PetscInt n, PetscInt leaves)
{
  Membrane           m = {.copies = 1};
  PetscReal          f;
  PetscInt           its, left;
  TaoConvergedReason reason;
  Tao                tao;
  Vec                x;

  PetscFunctionBeginUser;
  PetscCall(AssembleMembrane(n, &m));
  PetscCall(AssembleCap(n, 0.0, &m));
  PetscCall(VecDuplicate(m.q.b, &x));
  PetscCall(PetscOptionsSetValue(NULL, option, "4"));
  PetscCall(CreateTao(&m, x, "true", &tao));
  PetscCall(Solve(tao, &f, &its, &left));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s 4: %s\n", option, TaoConvergedReasons[reason]));
  PetscCall(
    Expect(leaves ? "left for the interior point method" : "never left", (PetscBool)(left == leaves), left, leaves));
  PetscCall(PetscOptionsClearValue(NULL, option));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&m.q));
  PetscFunctionReturn(0);
}

static PetscBool factor_fails = PETSC_FALSE;

/* In the place of PETSc's, which the library calls on the first rank alone: fails where it is to */
PetscErrorCode MatFactorGetError(Mat F, MatFactorError *error)
{
  PetscErrorCode (*theirs)(Mat, MatFactorError *);

  PetscFunctionBegin;
  PetscCheck(!factor_fails, PETSC_COMM_SELF, PETSC_ERR_LIB, "The first rank fails by itself");
  *(void **)&theirs = dlsym(RTLD_NEXT, "MatFactorGetError");
  PetscCheck(theirs, PETSC_COMM_SELF, PETSC_ERR_LIB, "No MatFactorGetError()");
  PetscCall((*theirs)(F, error));
  PetscFunctionReturn(0);
}

/* What fails on the first rank, which alone solves the reduced problem, fails on all of them */
static PetscErrorCode TestFirstRank(PetscInt n)
{
  Membrane       m = {.copies = 1};
  PetscErrorCode error;
  PetscMPIInt    failed, all;
  Tao            tao;
  Vec            x;

  PetscFunctionBeginUser;
  PetscCall(AssembleMembrane(n, &m));
  PetscCall(AssembleCap(n, 0.0, &m));
  PetscCall(VecDuplicate(m.q.b, &x));
  PetscCall(CreateTao(&m, x, "true", &tao));
  factor_fails = PETSC_TRUE;
  PetscCall(AttemptBegin());
  error = TaoSolve(tao);
  PetscCall(AttemptEnd());
  factor_fails = PETSC_FALSE;
  failed       = error == PETSC_ERR_LIB;
  PetscCallMPI(MPI_Allreduce(&failed, &all, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "an error of the first rank: %s\n", all ? "one of all ranks" : "NOT OF ALL"));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&m.q));
  PetscFunctionReturn(0);
}

/* Two unknowns with the Hessian (1 2; 2 1), 1 +- x_i >= 0, beside others that no row touches: a saddle of -0.003
   inside, minima of -1.2 and -0.8 at corners. Factors of the two raise no error, and each pivot on the diagonal is
   positive. */
static PetscErrorCode TestConcave(void)
{
  const PetscInt   size = 20;
  QuadraticProgram q    = {.H = NULL};
  PetscReal        f;
  PetscInt         start, end, first;
  Tao              tao;
  Vec              x;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size, size, 2, NULL, 1, NULL, &q.H));
  PetscCall(MatCreateVecs(q.H, &x, &q.b));
  PetscCall(MatGetOwnershipRange(q.H, &start, &end));
  for (PetscInt i = start; i < end; i++) {
    PetscCall(MatSetValue(q.H, i, i, 1.0, INSERT_VALUES));
    if (i < 2) PetscCall(MatSetValue(q.H, i, 1 - i, 2.0, INSERT_VALUES));
    PetscCall(VecSetValue(q.b, i, i ? (i == 1 ? 0.1 : 0.0) : 0.3, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(q.b));
  PetscCall(VecAssemblyEnd(q.b));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, end - start, 4, size, 1, NULL, 1, NULL, &q.J));
  PetscCall(MatCreateVecs(q.J, NULL, &q.g));
  PetscCall(MatGetOwnershipRange(q.J, &first, &end));
  for (PetscInt i = first; i < end; i++) PetscCall(MatSetValue(q.J, i, i / 2, i % 2 ? -1.0 : 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecSet(q.g, -1.0));
  PetscCall(ProblemCreateSolver(&q, x, &tao));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_subspace", "true"));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "a Hessian that is indefinite on the subspace: %s\n",
    f < -0.79 ? "the minimum at a bound" : "no minimum"));
  if (!(f < -0.79)) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  objective %g\n", (double)f));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&q));
  PetscFunctionReturn(0);
}

/* The directions of a solver in one of another size, which discards them, and then in the first one again; an empty
   container */
static PetscErrorCode TestOtherSize(PetscInt n)
{
  Membrane       m[2] = {{.copies = 1}, {.copies = 1}};
  PetscReal      f;
  PetscInt       its, interior, left;
  PetscContainer space;
  PetscErrorCode ierr;
  Tao            tao[2];
  Vec            x[2];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(AssembleMembrane(k ? n / 2 : n, &m[k]));
    PetscCall(AssembleCap(k ? n / 2 : n, 0.0, &m[k]));
    PetscCall(VecDuplicate(m[k].q.b, &x[k]));
    PetscCall(CreateTao(&m[k], x[k], "true", &tao[k]));
    if (k) PetscCall(TaoIPFilterSetSubspace(tao[k], space));
    PetscCall(Solve(tao[k], &f, &its, &left));
    PetscCall(Compare(k ? "a solver of another size" : "a solver", &m[k], tao[k], &interior));
    PetscCall(TaoIPFilterGetSubspace(tao[0], &space));
  }
  PetscCall(Solve(tao[0], &f, &its, &left));
  PetscCall(Compare("the first one again", &m[0], tao[0], &interior));
  PetscCall(PetscContainerCreate(PETSC_COMM_WORLD, &space));
  PetscCall(AttemptBegin());
  ierr = TaoIPFilterSetSubspace(tao[0], space);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks("empty container", ierr));
  PetscCall(AttemptPrint(ierr));
  PetscCall(PetscContainerDestroy(&space));
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(TaoDestroy(&tao[k]));
    PetscCall(VecDestroy(&x[k]));
    PetscCall(ProblemDestroy(&m[k].q));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const PetscInt n         = 24;
  Membrane       dependent = {.copies = 3}, curved = {.copies = 1, .quartic = 0.5},
           indefinite = {.copies = 1, .stiffness = -0.05}, wells = {.copies = 1, .quartic = 0.5, .stiffness = -0.05};
  PetscBool first_rank;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsHasName(NULL, NULL, "-first_rank", &first_rank));
  if (first_rank) {
    PetscCall(TestFirstRank(n));
    PetscCall(PetscFinalize());
    return 0;
  }
  PetscCall(TestKept(n));
  PetscCall(TestOtherSize(n));
  PetscCall(TestActive(n));
  PetscCall(TestOne("every row three times", n, &dependent, 0));
  PetscCall(TestOne("an objective that is not quadratic", n, &curved, 0));
  PetscCall(TestOne("an indefinite Hessian", n, &indefinite, -1));
  PetscCall(TestOne("a Hessian that is indefinite at the start", n, &wells, 0));
  PetscCall(TestConcave());
  PetscCall(TestLimit("-tao_max_it", n, 0));
  PetscCall(TestLimit("-tao_ipfilter_ksp_max_it", n, 1));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 5 2 3}}

   # what an error leaves allocated is no leak
   test:
      suffix: first_rank
      nsize: {{1 3}}
      args: -first_rank -malloc_dump 0

TEST*/
