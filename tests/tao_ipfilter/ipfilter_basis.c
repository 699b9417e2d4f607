static char help[] = "The directions of the subspace after many compressions: the Gram matrix and the products "
                     "with K must remain those of the stored directions.\n\n";

#include "../../tao_ipfilter/subspace/products.c"
#include "../../tao_ipfilter/subspace/single_precision.c"
#include "../../tao_ipfilter/subspace/basis.c"

enum { N = 300, ROOM = 12, COMPRESSIONS = 120 };

/* The matrix of a chain of springs, which are stiffer towards its end; -mat_type */
static PetscErrorCode CreateChain(Mat *K)
{
  char     type[64] = MATAIJ;
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, N, N, 3, NULL, 2, NULL, K));
  PetscCall(MatGetOwnershipRange(*K, &start, &end));
  for (PetscInt i = start; i < end; i++) {
    const PetscReal left = 1.0 + i, right = 2.0 + i;

    if (i) PetscCall(MatSetValue(*K, i, i - 1, -left, INSERT_VALUES));
    PetscCall(MatSetValue(*K, i, i, left + right, INSERT_VALUES));
    if (i + 1 < N) PetscCall(MatSetValue(*K, i, i + 1, -right, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*K, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-mat_type", type, sizeof(type), NULL));
  PetscCall(MatSetOption(*K, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetBlockSize(*K, strcmp(type, MATAIJ) ? 3 : 1));
  PetscCall(MatConvert(*K, type, MAT_INPLACE_MATRIX, K));
  PetscFunctionReturn(0);
}

/* Appends smooth directions until the basis is full. Numbers count over all directions. */
static PetscErrorCode Fill(IPBasis *b, Mat K, Vec d, PetscInt *number)
{
  PetscFunctionBeginUser;
  while (b->n < b->max) {
    PetscInt  start, end;
    PetscBool appended;

    PetscCall(VecGetOwnershipRange(d, &start, &end));
    for (PetscInt i = start; i < end; i++)
      PetscCall(VecSetValue(d, i, PetscSinReal(0.7 * *number + 0.01 * i * (1 + *number % 17)), INSERT_VALUES));
    PetscCall(VecAssemblyBegin(d));
    PetscCall(VecAssemblyEnd(d));
    PetscCall(VecISSet(d, b->W, 0.0));
    PetscCall(IPBasisAppend(b, K, d, &appended));
    (*number)++;
  }
  PetscFunctionReturn(0);
}

/* Returns the largest error of the Gram matrix, whose diagonal is 1 */
static PetscErrorCode GramError(IPBasis *b, Mat K, PetscReal *error)
{
  PetscReal s[ROOM];

  PetscFunctionBeginUser;
  *error = 0.0;
  for (PetscInt j = 0; j < b->n; j++) {
    PetscCall(BasisExpand(b, j));
    PetscCall(MatMult(K, b->d, b->Kd));
    PetscCall(IPBasisDots(b, 0, b->n, b->Kd, s));
    for (PetscInt i = 0; i < b->n; i++) *error = PetscMax(*error, PetscAbsReal(s[i] - b->gram[i + j * b->max]));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const PetscReal tolerance = 1e-4;
  IPBasis         b         = {0};
  PetscInt        number    = 0;
  PetscReal       error, worst = 0.0;
  Mat             K;
  Vec             d;
  IS              W;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(CreateChain(&K));
  PetscCall(MatCreateVecs(K, &d, NULL));
  PetscCall(VecGetOwnershipRange(d, &number, NULL));
  PetscCall(ISCreateStride(PETSC_COMM_WORLD, number ? 0 : 5, number, 1, &W));
  number = 0;
  PetscCall(IPBasisCreate(ROOM, d, &b));
  PetscCall(IPBasisUpdate(&b, K, PETSC_TRUE, NULL, W));
  for (PetscInt k = 0; k < COMPRESSIONS; k++) {
    PetscReal E[ROOM * ROOM];

    PetscCall(Fill(&b, K, d, &number));
    /* another K than that of the energies changes which combinations are kept, as Newton's method does */
    PetscCall(MatScale(K, k % 2 ? 0.25 : 4.0));
    PetscCall(IPBasisUpdate(&b, K, PETSC_TRUE, NULL, W));
    for (PetscInt i = 0; i < ROOM * ROOM; i++) E[i] = i % (ROOM + 1) ? 0.0 : 1.0 + i % 7;
    PetscCall(IPBasisCompress(&b, ROOM / 2, 1, E));
    PetscCall(GramError(&b, K, &error));
    worst = PetscMax(worst, error);
  }
  if (worst <= tolerance)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "after %d compressions the Gram matrix is exact\n", COMPRESSIONS));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "the Gram matrix is WRONG by %g\n", (double)worst));
  PetscCall(IPBasisDestroy(&b));
  PetscCall(ISDestroy(&W));
  PetscCall(VecDestroy(&d));
  PetscCall(MatDestroy(&K));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}

   test:
      suffix: blocks
      args: -mat_type {{baij sbaij}}
      output_file: output/ipfilter_basis_1.out

TEST*/
