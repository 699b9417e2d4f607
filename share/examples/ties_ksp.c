/*
   A membrane whose lower edge is tied to its upper one by a penalty of 1e8: KSP with PCAMGF in a program that
   includes nothing of ours.

   The rows of the ties are all that a multigrid method cannot handle. Their unknowns, composed on the matrix under
   "amgf_filter", are solved exactly.

      ties_ksp -dll_append PREFIX/lib/libpetscamgf.so -pc_type amgf

   Output:
      converged: TRUE
      at most 25 iterations: TRUE
      ties hold to 1e-6: TRUE
*/
#include <petscksp.h>

#define N       64 /* nodes a side */
#define PENALTY 1e8

/* The tie of column k: a node of the lower edge is the mean of three of the upper one */
static void GetTie(PetscInt k, PetscInt nodes[4], PetscScalar weights[4])
{
  nodes[0] = k;
  for (PetscInt i = 1; i < 4; i++) nodes[i] = N * (N - 1) + k - 2 + i;
  weights[0] = 1.0;
  weights[1] = weights[3] = -0.25;
  weights[2]              = -0.5;
}

static PetscErrorCode CreateMatrix(Mat *A)
{
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, N * N, N * N, 16, NULL, 16, NULL, A));
  PetscCall(MatGetOwnershipRange(*A, &start, &end));
  for (PetscInt row = start; row < end; row++) {
    const PetscInt i = row / N, j = row % N;

    PetscCall(MatSetValue(*A, row, row, 4.0, ADD_VALUES));
    if (j > 0) PetscCall(MatSetValue(*A, row, row - 1, -1.0, ADD_VALUES));
    if (j < N - 1) PetscCall(MatSetValue(*A, row, row + 1, -1.0, ADD_VALUES));
    if (i > 0) PetscCall(MatSetValue(*A, row, row - N, -1.0, ADD_VALUES));
    if (i < N - 1) PetscCall(MatSetValue(*A, row, row + N, -1.0, ADD_VALUES));
  }
  for (PetscInt k = 1; k < N - 1; k++) {
    PetscInt    nodes[4];
    PetscScalar weights[4], block[16];

    GetTie(k, nodes, weights);
    for (PetscInt i = 0; i < 16; i++) block[i] = PENALTY * weights[i / 4] * weights[i % 4];
    if (start <= k && k < end) PetscCall(MatSetValues(*A, 4, nodes, 4, nodes, block, ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* The unknowns of the ties; any rank may name any of them, as often as it likes */
static PetscErrorCode NameFilter(Mat A)
{
  PetscInt    rows[2 * N];
  PetscMPIInt rank;
  IS          filter;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  for (PetscInt k = 0; k < N; k++) {
    rows[k]     = k;
    rows[N + k] = N * (N - 1) + k;
  }
  PetscCall(ISCreateGeneral(PETSC_COMM_WORLD, rank ? 0 : 2 * N, rows, PETSC_COPY_VALUES, &filter));
  PetscCall(PetscObjectCompose((PetscObject)A, "amgf_filter", (PetscObject)filter));
  PetscCall(ISDestroy(&filter));
  PetscFunctionReturn(0);
}

/* Every tie's two sides are equal, to the accuracy of the penalty */
static PetscErrorCode CheckTies(Vec x, PetscBool *hold)
{
  VecScatter         scatter;
  Vec                all;
  const PetscScalar *u;

  PetscFunctionBeginUser;
  *hold = PETSC_TRUE;
  PetscCall(VecScatterCreateToAll(x, &scatter, &all));
  PetscCall(VecScatterBegin(scatter, x, all, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, x, all, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(all, &u));
  for (PetscInt k = 1; k < N - 1; k++) {
    PetscInt    nodes[4];
    PetscScalar weights[4], jump = 0.0;

    GetTie(k, nodes, weights);
    for (PetscInt i = 0; i < 4; i++) jump += weights[i] * u[nodes[i]];
    if (PetscAbsScalar(jump) > 1e-6) *hold = PETSC_FALSE;
  }
  PetscCall(VecRestoreArrayRead(all, &u));
  PetscCall(VecDestroy(&all));
  PetscCall(VecScatterDestroy(&scatter));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mat                A;
  Vec                x, b;
  KSP                ksp;
  KSPConvergedReason reason;
  PetscInt           its;
  PetscBool          hold;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(CreateMatrix(&A));
  PetscCall(NameFilter(A));
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(VecSet(b, 1e-3));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &ksp));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetTolerances(ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetOperators(ksp, A, A));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(CheckTies(x, &hold));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "converged: %s\nat most 25 iterations: %s\nties hold to 1e-6: %s\n",
    PetscBools[reason > 0], PetscBools[its <= 25], PetscBools[hold]));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}
