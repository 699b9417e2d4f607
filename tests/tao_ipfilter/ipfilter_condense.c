static char help[] =
  "The condensed matrix and the Newton direction against their definitions, in all matrix formats.\n\n";

#include "ipfilter_problem.h"

/* A quadratic program with random data; H positive definite with nb block rows of size bs */
typedef struct {
  QuadraticProgram q;
  Vec              mass;
} Data;

/* Number in (0, 1) that depends on i and j alone, so that every number of ranks has the same data */
static PetscReal Noise(PetscInt i, PetscInt j)
{
  const PetscReal v = PetscAbsReal(PetscSinReal(12.9898 * (i + 1) + 78.233 * (j + 1))) * 43758.5453;

  return v - PetscFloorReal(v);
}

/* Symmetric band of blocks, diagonally dominant */
static PetscErrorCode CreateHessian(MatType type, PetscInt nb, PetscInt bs, Mat *H)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(MatCreate(PETSC_COMM_WORLD, H));
  PetscCall(MatSetSizes(*H, PETSC_DECIDE, PETSC_DECIDE, nb * bs, nb * bs));
  PetscCall(MatSetBlockSize(*H, bs));
  PetscCall(MatSetType(*H, type));
  PetscCall(MatSetUp(*H));
  PetscCall(MatSetOption(*H, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatSetOption(*H, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatGetOwnershipRange(*H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    for (PetscInt jb = PetscMax(0, i / bs - 2); jb <= PetscMin(nb - 1, i / bs + 2); jb++) {
      for (PetscInt j = jb * bs; j < (jb + 1) * bs; j++) {
        PetscBool   sbaij;
        PetscScalar v = i == j ? 8.0 * bs : Noise(PetscMin(i, j), PetscMax(i, j));

        PetscCall(PetscObjectTypeCompareAny((PetscObject)*H, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
        if (!sbaij || j >= i) PetscCall(MatSetValue(*H, i, j, v, INSERT_VALUES));
      }
    }
  }
  PetscCall(MatAssemblyBegin(*H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* m rows of three entries far apart, so that J^T J reaches outside H's pattern */
static PetscErrorCode CreateConstraints(PetscInt m, Data *d)
{
  PetscInt n, N, lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(d->q.b, &n));
  PetscCall(VecGetSize(d->q.b, &N));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, n, m, N, 3, NULL, 3, NULL, &d->q.J));
  PetscCall(MatCreateVecs(d->q.J, NULL, &d->q.g));
  PetscCall(VecDuplicate(d->q.g, &d->mass));
  PetscCall(MatGetOwnershipRange(d->q.J, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    for (PetscInt k = 0; k < 3; k++)
      PetscCall(MatSetValue(d->q.J, i, (2 * i + k * (N / 3)) % N, 0.5 + Noise(i, 1000 + k), INSERT_VALUES));
    PetscCall(VecSetValue(d->q.g, i, Noise(i, 2000), INSERT_VALUES));
    PetscCall(VecSetValue(d->mass, i, 0.5 + Noise(i, 3000), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(d->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(d->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(d->q.g));
  PetscCall(VecAssemblyEnd(d->q.g));
  PetscCall(VecAssemblyBegin(d->mass));
  PetscCall(VecAssemblyEnd(d->mass));
  PetscFunctionReturn(0);
}

/* y = (H + J^T D J + Sigma) v with D = m z0/s0 and, with bounds at distance 1 of x = 0, Sigma = 2 mean(m) mu0 */
static PetscErrorCode ApplyDefinition(Data *d, PetscReal z0, PetscBool bounded, Vec v, Vec y)
{
  Vec       jv;
  PetscReal mean;
  PetscInt  m;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(d->q.g, &jv));
  PetscCall(MatMult(d->q.J, v, jv));
  PetscCall(VecPointwiseMult(jv, jv, d->mass));
  PetscCall(VecScale(jv, z0));
  PetscCall(MatMult(d->q.H, v, y));
  PetscCall(MatMultTransposeAdd(d->q.J, jv, y, y));
  PetscCall(VecSum(d->mass, &mean));
  PetscCall(VecGetSize(d->mass, &m));
  if (bounded) PetscCall(VecAXPY(y, 2.0 * mean / m, v));
  PetscCall(VecDestroy(&jv));
  PetscFunctionReturn(0);
}

/* b = -grad f + J^T (M mu0/s0 - D (c - s0)) at x = 0, where the forces of the two bounds cancel; s0 = mu0 = 1 */
static PetscErrorCode RightHandSide(Data *d, PetscReal z0, Vec b)
{
  Vec r;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(d->q.g, &r));
  PetscCall(VecCopy(d->q.g, r));
  PetscCall(VecShift(r, 1.0));
  PetscCall(VecScale(r, z0));
  PetscCall(VecShift(r, 1.0));
  PetscCall(VecPointwiseMult(r, r, d->mass));
  PetscCall(MatMultTransposeAdd(d->q.J, r, d->q.b, b));
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(0);
}

/* Relative differences: A v against its definition, and A d against b for the step d, whose length alpha is free */
static PetscErrorCode Compare(Tao tao, Data *d, PetscReal z0, PetscBool bounded, Vec x, PetscReal *matrix,
  PetscReal *direction)
{
  KSP         ksp;
  Mat         A;
  Vec         v, Av, y;
  PetscReal   size;
  PetscScalar yb, bb;
  PetscInt    lo, hi;

  PetscFunctionBeginUser;
  PetscCall(TaoGetKSP(tao, &ksp));
  PetscCall(KSPGetOperators(ksp, &A, NULL));
  PetscCall(VecDuplicate(x, &v));
  PetscCall(VecDuplicate(x, &Av));
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecGetOwnershipRange(v, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(v, i, Noise(i, 5000) - 0.5, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscCall(MatMult(A, v, Av));
  PetscCall(ApplyDefinition(d, z0, bounded, v, y));
  PetscCall(VecNorm(y, NORM_2, &size));
  PetscCall(VecAXPY(y, -1.0, Av));
  PetscCall(VecNorm(y, NORM_2, matrix));
  *matrix /= size;
  PetscCall(ApplyDefinition(d, z0, bounded, x, y));
  PetscCall(RightHandSide(d, z0, v));
  PetscCall(VecDot(y, v, &yb));
  PetscCall(VecDot(v, v, &bb));
  PetscCall(VecAXPY(y, -yb / bb, v));
  PetscCall(VecNorm(y, NORM_2, direction));
  *direction /= PetscAbsScalar(yb / bb) * PetscSqrtReal(PetscRealPart(bb));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&Av));
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(Data *d, PetscBool bounded, Vec x, Tao *tao)
{
  Vec lower, upper;

  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&d->q, x, tao));
  PetscCall(TaoIPFilterSetSlackMass(*tao, d->mass));
  PetscCall(TaoSetMaximumIterations(*tao, 1));
  if (bounded) {
    PetscCall(VecDuplicate(x, &lower));
    PetscCall(VecDuplicate(x, &upper));
    PetscCall(VecSet(lower, -1.0));
    PetscCall(VecSet(upper, 1.0));
    PetscCall(TaoSetVariableBounds(*tao, lower, upper));
    PetscCall(VecDestroy(&lower));
    PetscCall(VecDestroy(&upper));
  }
  PetscFunctionReturn(0);
}

/* One Newton step from the cold start, for two values of z0: the second assembly rewrites only what J touches */
static PetscErrorCode Test(MatType type, PetscInt bs, PetscBool bounded)
{
  const char *z0[2]  = {"10", "1000"};
  PetscReal   matrix = 0.0, direction = 0.0;
  Data        d;
  Vec         x;
  Tao         tao;

  PetscFunctionBeginUser;
  PetscCall(CreateHessian(type, 24, bs, &d.q.H));
  PetscCall(MatCreateVecs(d.q.H, &x, &d.q.b));
  PetscCall(VecSet(d.q.b, 1.0));
  PetscCall(CreateConstraints(7, &d));
  PetscCall(CreateSolver(&d, bounded, x, &tao));
  for (PetscInt k = 0; k < 2; k++) {
    PetscReal m, s;

    PetscCall(VecSet(x, 0.0));
    PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_dual_init", z0[k]));
    PetscCall(TaoSetFromOptions(tao));
    PetscCall(TaoSolve(tao));
    PetscCall(Compare(tao, &d, k ? 1000.0 : 10.0, bounded, x, &m, &s));
    matrix    = PetscMax(matrix, m);
    direction = PetscMax(direction, s);
  }
  if (matrix < 1e-13 && direction < 1e-9)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, block size %" PetscInt_FMT ", %s: matrix and direction as defined\n",
      type, bs, bounded ? "bounds" : "no bounds"));
  else
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, block size %" PetscInt_FMT ", %s: matrix off by %g, direction by %g\n",
      type, bs, bounded ? "bounds" : "no bounds", (double)matrix, (double)direction));
  PetscCall(TaoDestroy(&tao));
  PetscCall(ProblemDestroy(&d.q));
  PetscCall(VecDestroy(&d.mass));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const MatType  types[]  = {MATAIJ, MATAIJ, MATBAIJ, MATSBAIJ};
  const PetscInt blocks[] = {1, 3, 3, 2};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(types); k++) {
    PetscCall(Test(types[k], blocks[k], PETSC_FALSE));
    PetscCall(Test(types[k], blocks[k], PETSC_TRUE));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}
      args: -tao_ipfilter_start cold -tao_ipfilter_scaling none -tao_ipfilter_barrier monotone -tao_ipfilter_mu_reductions_first 0
      args: -tao_ipfilter_forcing fixed -tao_ipfilter_ksp_rtol 1e-12 -tao_ipfilter_pc_type jacobi

TEST*/
