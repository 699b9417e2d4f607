static char help[] = "The Cholesky factorizations \"amgf\" and \"amgf_single\" on one rank\n\n";

#include <petscksp.h>
#include <petscamgf.h>

/*
   A membrane of n x n nodes with `block` unknowns each, which are coupled, and `alone` more unknowns without
   neighbours.
   shift: is added to the diagonal
*/
static PetscErrorCode CreateMembrane(PetscInt n, PetscInt block, PetscInt alone, PetscReal shift, Mat *A)
{
  const PetscInt size = n * n * block + alone, step[] = {-1, 1, -n, n};

  PetscFunctionBeginUser;
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, 6 * block, NULL, A));
  if (!alone) PetscCall(MatSetBlockSize(*A, block));
  for (PetscInt node = 0; node < n * n; node++) {
    for (PetscInt c = 0; c < block; c++) {
      const PetscInt row = node * block + c;

      for (PetscInt d = 0; d < block; d++)
        PetscCall(MatSetValue(*A, row, node * block + d, c == d ? 4.5 + shift : 0.2, INSERT_VALUES));
      for (PetscInt k = 0; k < 4; k++) {
        const PetscInt other = node + step[k];

        if (other < 0 || other >= n * n || (k < 2 && other / n != node / n)) continue;
        for (PetscInt d = 0; d < block; d++)
          PetscCall(MatSetValue(*A, row, other * block + d, c == d ? -1.0 : 0.0, INSERT_VALUES));
      }
    }
  }
  for (PetscInt i = size - alone; i < size; i++) PetscCall(MatSetValue(*A, i, i, 2.0 + shift, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Factors A twice, the second time with the same pattern. *positive: whether PETSc is told no error */
static PetscErrorCode Factor(Mat A, MatSolverType type, Mat *F, PetscBool *positive)
{
  MatFactorInfo  info;
  MatFactorError error;

  PetscFunctionBeginUser;
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatGetFactor(A, type, MAT_FACTOR_CHOLESKY, F));
  PetscCall(MatCholeskyFactorSymbolic(*F, A, NULL, &info));
  PetscCall(MatCholeskyFactorNumeric(*F, A, &info));
  PetscCall(MatCholeskyFactorNumeric(*F, A, &info));
  PetscCall(MatFactorGetError(*F, &error));
  *positive = (PetscBool)!error;
  PetscFunctionReturn(0);
}

/* Returns what the pivot is that has ended the factorization F */
static PetscErrorCode SayPivot(Mat A, Mat F, const char **what)
{
  PetscReal pivot;
  PetscInt  row, n;

  PetscFunctionBeginUser;
  PetscCall(MatFactorGetErrorZeroPivot(F, &pivot, &row));
  PetscCall(MatGetSize(A, &n, NULL));
  *what = row < 0 || row >= n ? "NO SUCH ROW" : pivot < 0.0 ? "a pivot is negative" : "NO PIVOT IS NEGATIVE";
  PetscFunctionReturn(0);
}

/* Computes the largest residual of k right-hand sides, solved together, and of one alone, relative to them */
static PetscErrorCode Residual(Mat A, Mat F, PetscInt k, PetscReal *residual)
{
  PetscInt  n;
  PetscReal size, one;
  Mat       B, X, R;
  Vec       b, x;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, n, k, NULL, &B));
  PetscCall(MatSetRandom(B, NULL));
  if (n > 1) PetscCall(MatZeroRows(B, 1, &(PetscInt){0}, 0.0, NULL, NULL));
  PetscCall(MatDuplicate(B, MAT_DO_NOT_COPY_VALUES, &X));
  PetscCall(MatMatSolve(F, B, X));
  PetscCall(MatMatMult(A, X, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &R));
  PetscCall(MatAXPY(R, -1.0, B, SAME_NONZERO_PATTERN));
  PetscCall(MatNorm(R, NORM_FROBENIUS, residual));
  PetscCall(MatNorm(B, NORM_FROBENIUS, &size));
  *residual /= size;
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(MatGetColumnVector(B, b, k - 1));
  PetscCall(MatSolve(F, b, x));
  PetscCall(VecScale(b, -1.0));
  PetscCall(MatMultAdd(A, x, b, b));
  PetscCall(VecNorm(b, NORM_2, &one));
  *residual = PetscMax(*residual, one / size);
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&x));
  PetscCall(MatDestroy(&R));
  PetscCall(MatDestroy(&X));
  PetscCall(MatDestroy(&B));
  PetscFunctionReturn(0);
}

/* Composes coordinates with A: those of the n x n nodes, rolled up to a ring; or all zero */
static PetscErrorCode ComposeCoordinates(Mat A, PetscInt n, PetscBool zero)
{
  PetscScalar *x;
  Vec          coordinates;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &coordinates, NULL));
  PetscCall(VecGetArray(coordinates, &x));
  for (PetscInt i = 0; i < n * n && !zero; i++) {
    const PetscReal angle = 1.5 * PETSC_PI * (PetscReal)(i % n) / (PetscReal)n, radius = 1.0 + (PetscReal)(i / n);

    x[3 * i]     = radius * PetscCosReal(angle);
    x[3 * i + 1] = radius * PetscSinReal(angle);
  }
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscCall(PetscObjectCompose((PetscObject)A, PCAMGF_COORDINATES_KEY, (PetscObject)coordinates));
  PetscCall(VecDestroy(&coordinates));
  PetscFunctionReturn(0);
}

static PetscErrorCode GetOperations(Mat A, PetscReal *flops)
{
  MatFactorInfo info;
  Mat           F;
  PetscReal     entries, memory;
  PetscErrorCode (*costs)(Mat, PetscReal *, PetscReal *, PetscReal *);

  PetscFunctionBeginUser;
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatGetFactor(A, "amgf", MAT_FACTOR_CHOLESKY, &F));
  PetscCall(MatCholeskyFactorSymbolic(F, A, NULL, &info));
  PetscCall(PetscObjectQueryFunction((PetscObject)F, "AMGFCholeskyGetCosts_C", &costs));
  PetscCheck(costs, PETSC_COMM_SELF, PETSC_ERR_SUP, "The factors do not tell their costs");
  PetscCall((*costs)(F, flops, &entries, &memory));
  PetscCall(MatDestroy(&F));
  PetscFunctionReturn(0);
}

/* Tests the order by coordinates: the solutions, and that the factorization takes about as few operations */
static PetscErrorCode TestCoordinates(void)
{
  const PetscInt  n    = 40;
  const PetscReal most = 1.3; /* ratio of the operations to those of the order without coordinates */
  PetscReal       flops[2], residual;
  PetscBool       positive;
  Mat             A, F;

  PetscFunctionBeginUser;
  PetscCall(CreateMembrane(n, 3, 0, 0.0, &A));
  PetscCall(GetOperations(A, &flops[0]));
  for (PetscInt zero = 1; zero >= 0; zero--) {
    PetscCall(ComposeCoordinates(A, n, (PetscBool)zero));
    PetscCall(Factor(A, "amgf", &F, &positive));
    PetscCall(Residual(A, F, 7, &residual));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", zero ? "all nodes at one place" : "coordinates of a ring",
      positive && residual <= 1e-12 ? "solved" : "RESIDUAL TOO LARGE"));
    PetscCall(MatDestroy(&F));
  }
  PetscCall(GetOperations(A, &flops[1]));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "coordinates of a ring: %s operations\n",
    flops[1] <= most * flops[0] ? "about as many" : "TOO MANY"));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

static PetscErrorCode Test(const char name[], PetscInt n, PetscInt block, PetscInt alone, PetscReal shift)
{
  const MatSolverType type[]   = {"amgf", "amgf_single"};
  const PetscReal     bound[]  = {1e-12, 1e-5};
  PetscReal           residual = 0.0;
  PetscBool           positive = PETSC_FALSE;
  Mat                 A, F;

  PetscFunctionBeginUser;
  PetscCall(CreateMembrane(n, block, alone, shift, &A));
  for (PetscInt t = 0; t < 2; t++) {
    const char *pivot = NULL;

    PetscCall(Factor(A, type[t], &F, &positive));
    if (!positive) PetscCall(SayPivot(A, F, &pivot));
    if (positive) PetscCall(Residual(A, F, 7, &residual));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s: %s\n", name, type[t],
      !positive              ? pivot
      : residual <= bound[t] ? "solved"
                             : "RESIDUAL TOO LARGE"));
    if (positive && residual > bound[t]) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %g\n", (double)residual));
    PetscCall(MatDestroy(&F));
  }
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(Test("one unknown", 1, 1, 0, 0.0));
  PetscCall(Test("a membrane", 23, 1, 0, 0.0));
  PetscCall(Test("blocks of 3", 17, 3, 0, 0.0));
  PetscCall(Test("blocks of 3 and unknowns without neighbours", 9, 3, 5, 0.0));
  PetscCall(Test("unknowns without neighbours alone", 0, 1, 11, 0.0));
  PetscCall(Test("an indefinite matrix", 12, 2, 0, -3.0));
  PetscCall(TestCoordinates());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
