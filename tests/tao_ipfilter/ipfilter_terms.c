static char help[] =
  "Norm terms beside the objective: Coulomb's law, Tresca's, a cap on both, and sticking, on a net over a cap,\n\
each law checked row by row; group lasso\n\
against its closed form; the same answer on any number of ranks, and wrong sizes.\n\n";

#include "ipfilter_problem.h"
#include "../lib/attempt.h"

/* A net of n x n points of three coordinates each, that a cap keeps from sinking and a load pulls sideways */
typedef struct {
  QuadraticProgram q;
  Mat              T;
  Vec              t, limit, coefficient;
} Net;

static PetscErrorCode AssembleNet(PetscInt n, PetscReal pull, Net *net)
{
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(
    MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, 3 * n * n, 3 * n * n, 7, NULL, 7, NULL, &net->q.H));
  PetscCall(MatCreateVecs(net->q.H, &net->q.b, NULL));
  PetscCall(MatGetOwnershipRange(net->q.H, &start, &end));
  for (PetscInt r = start; r < end; r++) {
    const PetscInt p = r / 3, c = r % 3, i = p % n, j = p / n,
                   near[4] = {i > 0 ? r - 3 : -1, i < n - 1 ? r + 3 : -1, j > 0 ? r - 3 * n : -1,
                     j < n - 1 ? r + 3 * n : -1};

    PetscCall(MatSetValue(net->q.H, r, r, 4.0, INSERT_VALUES));
    for (PetscInt k = 0; k < 4; k++) PetscCall(MatSetValue(net->q.H, r, near[k], -0.9, INSERT_VALUES));
    for (PetscInt k = 1; k < 3; k++) PetscCall(MatSetValue(net->q.H, r, 3 * p + (c + k) % 3, 0.1, INSERT_VALUES));
    PetscCall(
      VecSetValue(net->q.b, r, c == 0 ? -1.0 : pull * (c == 1 ? 1.0 : 0.3 * (i - j) / (PetscReal)n), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(net->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(net->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(net->q.b));
  PetscCall(VecAssemblyEnd(net->q.b));
  PetscFunctionReturn(0);
}

/* Whether a point whose first row this rank owns is over the cap */
static PetscBool OverCap(PetscInt n, PetscInt r, PetscReal *height)
{
  const PetscReal x = (r / 3 % n + 1.0) / (n + 1.0) - 0.5, y = (r / 3 / n + 1.0) / (n + 1.0) - 0.5, r2 = x * x + y * y;

  *height = -0.3 - 4.0 * r2;
  return (PetscBool)(r % 3 == 0 && r2 < 0.1);
}

static PetscErrorCode AssembleCap(PetscInt n, PetscReal limit, PetscReal coefficient, Net *net)
{
  PetscInt  start, end, nlocal, first, count = 0;
  PetscReal height;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(net->q.H, &start, &end));
  PetscCall(VecGetLocalSize(net->q.b, &nlocal));
  for (PetscInt r = start; r < end; r++) count += OverCap(n, r, &height);
  PetscCall(
    MatCreateAIJ(PETSC_COMM_WORLD, count, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 1, NULL, &net->q.J));
  PetscCall(
    MatCreateAIJ(PETSC_COMM_WORLD, 2 * count, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 1, NULL, &net->T));
  PetscCall(MatCreateVecs(net->q.J, NULL, &net->q.g));
  PetscCall(MatCreateVecs(net->T, NULL, &net->t));
  PetscCall(MatGetOwnershipRange(net->q.J, &first, NULL));
  for (PetscInt r = start; r < end; r++) {
    if (!OverCap(n, r, &height)) continue;
    PetscCall(MatSetValue(net->q.J, first, r, 1.0, INSERT_VALUES));
    for (PetscInt a = 0; a < 2; a++)
      PetscCall(MatSetValue(net->T, 2 * first + a, PetscMin(r + 1 + a, 3 * n * n - 1), 1.0, INSERT_VALUES));
    PetscCall(VecSetValue(net->q.g, first++, height, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(net->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(net->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyBegin(net->T, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(net->T, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(net->q.g));
  PetscCall(VecAssemblyEnd(net->q.g));
  PetscCall(VecSet(net->t, 1e-3));
  PetscCall(VecDuplicate(net->q.g, &net->limit));
  PetscCall(VecDuplicate(net->q.g, &net->coefficient));
  PetscCall(VecSet(net->limit, limit));
  PetscCall(VecSet(net->coefficient, coefficient));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyNet(Net *net)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&net->q));
  PetscCall(MatDestroy(&net->T));
  PetscCall(VecDestroy(&net->t));
  PetscCall(VecDestroy(&net->limit));
  PetscCall(VecDestroy(&net->coefficient));
  PetscFunctionReturn(0);
}

/* What the laws leave: constraint, cone, stick or direction of slip; counts: closed, sticking, slipping */
static PetscErrorCode CheckLaws(Net *net, Vec x, Vec y, Vec tau, PetscReal errors[3], PetscInt counts[3])
{
  const PetscReal    tiny = 1e-8;
  const PetscScalar *a[4];
  Vec                v, c;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(net->t, &v));
  PetscCall(VecDuplicate(net->q.g, &c));
  PetscCall(MatMultAdd(net->T, x, net->t, v));
  PetscCall(MatMult(net->q.J, x, c));
  PetscCall(VecAXPY(c, -1.0, net->q.g));
  PetscCall(VecGetLocalSize(y, &n));
  PetscCall(VecGetArrayRead(y, &a[0]));
  PetscCall(VecGetArrayRead(tau, &a[1]));
  PetscCall(VecGetArrayRead(v, &a[2]));
  PetscCall(VecGetArrayRead(c, &a[3]));
  for (PetscInt k = 0; k < 3; k++) errors[k] = counts[k] = 0;
  for (PetscInt i = 0; i < n; i++) {
    PetscScalar     limit, coefficient;
    PetscInt        row;
    const PetscReal f    = PetscRealPart(a[0][i]),
                    slip = hypot(PetscRealPart(a[2][2 * i]), PetscRealPart(a[2][2 * i + 1])),
                    size = hypot(PetscRealPart(a[1][2 * i]), PetscRealPart(a[1][2 * i + 1]));
    PetscReal bound;

    PetscCall(VecGetOwnershipRange(y, &row, NULL));
    row += i;
    PetscCall(VecGetValues(net->limit, 1, &row, &limit));
    PetscCall(VecGetValues(net->coefficient, 1, &row, &coefficient));
    bound = f > 0.0 ? PetscMin(PetscRealPart(limit),
                        PetscRealPart(coefficient) >= PETSC_INFINITY ? PETSC_INFINITY : PetscRealPart(coefficient) * f)
                    : 0.0;
    errors[0] =
      PetscMax(errors[0], PetscMax(PetscMax(-PetscRealPart(a[3][i]), -f), PetscAbsReal(f * PetscRealPart(a[3][i]))));
    errors[1] = PetscMax(errors[1], size - bound);
    if (slip > tiny) {
      for (PetscInt k = 0; k < 2; k++)
        errors[2] = PetscMax(errors[2], PetscAbsScalar(a[1][2 * i + k] + bound * a[2][2 * i + k] / slip));
    }
    counts[0] += f > tiny;
    counts[1] += f > tiny && slip <= tiny;
    counts[2] += f > tiny && slip > tiny;
  }
  PetscCall(VecRestoreArrayRead(y, &a[0]));
  PetscCall(VecRestoreArrayRead(tau, &a[1]));
  PetscCall(VecRestoreArrayRead(v, &a[2]));
  PetscCall(VecRestoreArrayRead(c, &a[3]));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&c));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, errors, 3, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 3, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode Check(Net *net, Tao tao, Vec x)
{
  PetscReal          errors[3], norm;
  PetscInt           counts[3];
  TaoConvergedReason reason;
  Vec                y, tau, r;

  PetscFunctionBeginUser;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(TaoGetDualVariables(tao, NULL, &y));
  PetscCall(TaoIPFilterGetNormTermForces(tao, &tau));
  PetscCall(VecDuplicate(x, &r));
  PetscCall(MatMult(net->q.H, x, r));
  PetscCall(VecAXPY(r, -1.0, net->q.b));
  PetscCall(VecScale(y, -1.0));
  PetscCall(MatMultTransposeAdd(net->q.J, y, r, r));
  PetscCall(VecScale(y, -1.0));
  PetscCall(VecScale(r, -1.0));
  PetscCall(MatMultTransposeAdd(net->T, tau, r, r));
  PetscCall(VecNorm(r, NORM_2, &norm));
  PetscCall(VecDestroy(&r));
  PetscCall(CheckLaws(net, x, y, tau, errors, counts));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
    "%s, closed %" PetscInt_FMT ", sticking %" PetscInt_FMT ", slipping %" PetscInt_FMT "\n",
    reason > 0 ? "converged" : "not converged", counts[0], counts[1], counts[2]));
  PetscCall(ProblemVerdict("  balance", norm, 1e-7));
  PetscCall(ProblemVerdict("  constraints", errors[0], 1e-8));
  PetscCall(ProblemVerdict("  |tau| beyond the weight", errors[1], 1e-8));
  PetscCall(ProblemVerdict("  direction of slip", errors[2], 1e-7));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(Net *net, Vec x, Tao *tao)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&net->q, x, tao));
  PetscCall(TaoSetTolerances(*tao, 1e-10, 0.0, 0.0));
  PetscCall(TaoIPFilterSetNormTerms(*tao, net->T, net->t, net->limit, net->coefficient));
  PetscCall(TaoSetFromOptions(*tao));
  PetscFunctionReturn(0);
}

/* One law; solved again, it is solved at once */
static PetscErrorCode TestLaw(const char what[], PetscInt n, PetscReal pull, PetscReal limit, PetscReal coefficient)
{
  Net      net = {.T = NULL};
  Vec      x;
  Tao      tao;
  PetscInt its;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", what));
  PetscCall(AssembleNet(n, pull, &net));
  PetscCall(AssembleCap(n, limit, coefficient, &net));
  PetscCall(VecDuplicate(net.q.b, &x));
  PetscCall(CreateSolver(&net, x, &tao));
  PetscCall(TaoSolve(tao));
  PetscCall(Check(&net, tao, x));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetLinearSolveIterations(tao, &its));
  if (its > 3) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  solved again in %" PetscInt_FMT " iterations\n", its));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyNet(&net));
  PetscFunctionReturn(0);
}

/* min 1/2 |x - b|^2 + beta sum |x_g|, x_g = b_g max(0, 1 - beta / |b_g|); at_rest: of x - b, so that the gradient
   without the terms is zero at the start */
static PetscErrorCode TestGroupLasso(const char what[], PetscInt groups, PetscReal beta, PetscBool at_rest)
{
  Net         net = {.T = NULL};
  Vec         x, b;
  Tao         tao;
  PetscInt    start, end;
  PetscReal   error = 0.0;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, groups, &net.limit));
  PetscCall(VecSet(net.limit, beta));
  PetscCall(VecGetOwnershipRange(net.limit, &start, &end));
  PetscCall(MatCreateConstantDiagonal(PETSC_COMM_WORLD, 2 * (end - start), 2 * (end - start), PETSC_DETERMINE,
    PETSC_DETERMINE, 1.0, &net.q.H));
  PetscCall(MatConvert(net.q.H, MATAIJ, MAT_INPLACE_MATRIX, &net.q.H));
  PetscCall(MatDuplicate(net.q.H, MAT_COPY_VALUES, &net.T));
  PetscCall(MatCreateVecs(net.q.H, &net.q.b, &net.t));
  PetscCall(VecZeroEntries(at_rest ? net.q.b : net.t));
  b = at_rest ? net.t : net.q.b;
  for (PetscInt r = 2 * start; r < 2 * end; r++)
    PetscCall(VecSetValue(b, r, sin(1.7 * r) + 0.5 * cos(0.3 * r), INSERT_VALUES));
  PetscCall(VecAssemblyBegin(b));
  PetscCall(VecAssemblyEnd(b));
  PetscCall(
    MatCreateAIJ(PETSC_COMM_WORLD, rank ? 0 : 1, 2 * (end - start), 1, PETSC_DETERMINE, 1, NULL, 1, NULL, &net.q.J));
  if (!rank) PetscCall(MatSetValue(net.q.J, 0, 0, 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(net.q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(net.q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(net.q.J, NULL, &net.q.g));
  PetscCall(VecSet(net.q.g, -100.0));
  PetscCall(VecDuplicate(net.q.b, &x));
  PetscCall(CreateSolver(&net, x, &tao));
  PetscCall(TaoSolve(tao));
  if (at_rest) PetscCall(VecAXPY(x, 1.0, b));
  for (PetscInt g = start; g < end; g++) {
    const PetscInt rows[2] = {2 * g, 2 * g + 1};
    PetscScalar    v[2], a[2];
    PetscReal      shrink;

    PetscCall(VecGetValues(b, 2, rows, v));
    PetscCall(VecGetValues(x, 2, rows, a));
    shrink = PetscMax(0.0, 1.0 - beta / hypot(PetscRealPart(v[0]), PetscRealPart(v[1])));
    for (PetscInt k = 0; k < 2; k++) error = PetscMax(error, PetscAbsScalar(a[k] - shrink * v[k]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  /* The laws hold to 1e-9 of the norm of all unknowns, which is 4.2. Measured: 1e-12 to 1.3e-9 on 1 to 6 ranks */
  PetscCall(ProblemVerdict(what, error, 5e-9));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyNet(&net));
  PetscFunctionReturn(0);
}

/* A limit or a coefficient that is negative */
static PetscErrorCode TestRefused(const char what[], PetscReal limit, PetscReal coefficient)
{
  Net            net = {.T = NULL};
  Vec            x;
  Tao            tao;
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", what));
  PetscCall(AssembleNet(12, 0.4, &net));
  PetscCall(AssembleCap(12, 0.25, 0.3, &net));
  PetscCall(VecSetValue(net.limit, 3, limit, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(net.limit));
  PetscCall(VecAssemblyEnd(net.limit));
  PetscCall(VecSetValue(net.coefficient, 3, coefficient, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(net.coefficient));
  PetscCall(VecAssemblyEnd(net.coefficient));
  PetscCall(VecDuplicate(net.q.b, &x));
  PetscCall(CreateSolver(&net, x, &tao));
  PetscCall(AttemptBegin());
  ierr = TaoSolve(tao);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks(what, ierr));
  PetscCall(AttemptPrint(ierr));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyNet(&net));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const PetscInt n = 12;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(TestLaw("Coulomb 0.3", n, 0.15, PETSC_INFINITY, 0.3));
  PetscCall(TestLaw("Coulomb 1e-6", n, 0.4, PETSC_INFINITY, 1e-6));
  PetscCall(TestLaw("Coulomb 10", n, 0.4, PETSC_INFINITY, 10.0));
  PetscCall(TestLaw("Coulomb 0.6, capped", n, 0.3, 0.25, 0.6));
  PetscCall(TestLaw("Tresca where in contact", n, 0.4, 0.2, PETSC_INFINITY));
  PetscCall(TestLaw("sticking", n, 0.4, PETSC_INFINITY, PETSC_INFINITY));
  PetscCall(TestLaw("frictionless", n, 0.4, PETSC_INFINITY, 0.0));
  PetscCall(TestGroupLasso("group lasso", 40, 0.5, PETSC_FALSE));
  PetscCall(TestGroupLasso("group lasso, from rest", 40, 0.5, PETSC_TRUE));
  PetscCall(TestRefused("negative limit", -1.0, 0.3));
  PetscCall(TestRefused("negative coefficient", 0.25, -0.5));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 5 2 3}}

TEST*/
