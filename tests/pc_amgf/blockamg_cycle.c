static char help[] = "PCBLOCKAMG: symmetric and positive definite; CG in any units, of matrices of any format and "
                     "block size, beside hypre's own cycle.\n\n";

#include "amgf_problem.h"
#include <petsc/private/petscimpl.h>

/* Laplacian on a cube of n^3 nodes, Dirichlet outside, times an SPD block of bs x bs, times unit */
static PetscErrorCode CubeCreate(MPI_Comm comm, MatType type, PetscInt n, PetscInt bs, PetscReal unit, Mat *A)
{
  PetscInt    nodes = PETSC_DECIDE, N = n * n * n, start, end;
  PetscMPIInt rank, size;
  PetscBool   sbaij;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (size > 2)
    nodes = rank == 1         ? 0
            : rank < size - 1 ? N / (size - 1)
                              : N - (size - 2) * (N / (size - 1)); /* a rank without rows */
  else PetscCall(PetscSplitOwnership(comm, &nodes, &N));
  PetscCall(MatCreate(comm, A));
  PetscCall(MatSetSizes(*A, nodes * bs, nodes * bs, N * bs, N * bs));
  PetscCall(MatSetBlockSize(*A, bs));
  PetscCall(MatSetType(*A, type));
  PetscCall(MatSetUp(*A));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)*A, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (sbaij) PetscCall(MatSetOption(*A, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  PetscCall(MatSetOption(*A, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatGetOwnershipRange(*A, &start, &end));
  for (PetscInt node = start / bs; node < end / bs; node++) {
    const PetscInt at[3] = {node % n, node / n % n, node / n / n}, step[3] = {1, n, n * n};

    for (PetscInt k = -1; k < 6; k++) {
      const PetscInt other = k < 0 ? node : node + (k % 2 ? 1 : -1) * step[k / 2];
      PetscScalar    block[36];

      if (k >= 0 && (k % 2 ? at[k / 2] == n - 1 : at[k / 2] == 0)) continue;
      for (PetscInt i = 0; i < bs * bs; i++) block[i] = unit * (k < 0 ? 6.0 : -1.0) * (i % (bs + 1) ? 0.1 : 1.0);
      PetscCall(MatSetValuesBlocked(*A, 1, &node, 1, &other, block, INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* A right-hand side in any units, to a true residual of 1e-11 */
static PetscErrorCode Solve(Mat A, PCType type, PetscReal load, KSP *ksp, PetscInt *its)
{
  Vec       x, b, r;
  PetscReal norm, scale;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(VecDuplicate(b, &r));
  PetscCall(FillVector(b, 0.7));
  PetscCall(VecScale(b, load));
  if (!*ksp) {
    PC pc;

    PetscCall(KSPCreate(PetscObjectComm((PetscObject)A), ksp));
    PetscCall(KSPSetType(*ksp, KSPCG));
    PetscCall(KSPSetNormType(*ksp, KSP_NORM_UNPRECONDITIONED));
    PetscCall(KSPSetTolerances(*ksp, 1e-11, 0.0, PETSC_DEFAULT, 500));
    PetscCall(KSPGetPC(*ksp, &pc));
    PetscCall(PCSetType(pc, type));
    PetscCall(KSPSetFromOptions(*ksp));
  }
  PetscCall(KSPSetOperators(*ksp, A, A));
  PetscCall(KSPSolve(*ksp, b, x));
  PetscCall(KSPGetIterationNumber(*ksp, its));
  PetscCall(MatMult(A, x, r));
  PetscCall(VecAXPY(r, -1.0, b));
  PetscCall(VecNorm(r, NORM_2, &norm));
  PetscCall(VecNorm(b, NORM_2, &scale));
  if (!(norm <= 1e-10 * scale))
    PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "    true residual %g\n", (double)(norm / scale)));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(0);
}

/* (x, B y) = (y, B x) to the rounding of floats, (x, B x) > 0, and B (s x) = s B x to the last bit for s a power of 2
 */
static PetscErrorCode CheckSymmetry(KSP ksp, Mat A)
{
  PC          pc;
  Vec         x, y, Bx, By;
  PetscScalar a, b, c, d;
  PetscReal   violation = 0.0, difference;

  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(MatCreateVecs(A, &x, &y));
  PetscCall(MatCreateVecs(A, &Bx, &By));
  for (PetscInt i = 0; i < 5; i++) {
    PetscCall(FillVector(x, 0.5 + i));
    PetscCall(FillVector(y, 20.7 + 3 * i));
    PetscCall(PCApply(pc, x, Bx));
    PetscCall(PCApply(pc, y, By));
    PetscCall(VecDot(x, By, &a));
    PetscCall(VecDot(y, Bx, &b));
    PetscCall(VecDot(x, Bx, &c));
    PetscCall(VecDot(y, By, &d));
    if (!(PetscRealPart(c) > 0.0) || !(PetscRealPart(d) > 0.0))
      PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "    not positive\n"));
    violation = PetscMax(violation, PetscAbsScalar(a - b) / PetscSqrtReal(PetscAbsScalar(c * d)));
  }
  if (!(violation < 1e-6))
    PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "    not symmetric: %g\n", (double)violation));
  PetscCall(VecScale(y, PetscPowReal(2.0, 200)));
  PetscCall(PCApply(pc, y, x));
  PetscCall(VecScale(x, PetscPowReal(2.0, -200)));
  PetscCall(RelativeDifference(x, By, &difference));
  if (difference != 0.0)
    PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "    depends on the scale: %g\n", (double)difference));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&Bx));
  PetscCall(VecDestroy(&By));
  PetscFunctionReturn(0);
}

/* The product that comes with B r: the same B r, and A B r to a hundredth of the residual r - A B r */
static PetscErrorCode CheckProduct(KSP ksp, Mat A)
{
  PC        pc;
  Vec       r, z, product, Az;
  PetscReal difference, left;

  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(MatCreateVecs(A, &r, &z));
  PetscCall(MatCreateVecs(A, &product, &Az));
  PetscCall(FillVector(r, 0.9));
  PetscUseMethod(pc, "PCBlockAMGApplyProduct_C", (PC, Vec, Vec, Vec), (pc, r, z, product));
  PetscCall(PCApply(pc, r, Az));
  PetscCall(RelativeDifference(Az, z, &difference));
  if (difference != 0.0) PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "    another B r with a product\n"));
  PetscCall(MatMult(A, z, Az));
  PetscCall(VecAXPY(product, -1.0, Az));
  PetscCall(VecAXPY(r, -1.0, Az));
  PetscCall(VecNorm(product, NORM_2, &difference));
  PetscCall(VecNorm(r, NORM_2, &left));
  if (!(difference <= 1e-2 * left))
    PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "    product wrong by %g of the residual\n",
      (double)(difference / left)));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&z));
  PetscCall(VecDestroy(&product));
  PetscCall(VecDestroy(&Az));
  PetscFunctionReturn(0);
}

/* Iterations within a tenth, and two more, of hypre's; in parallel within a third */
static PetscErrorCode CheckCounts(MPI_Comm comm, const char what[], PetscInt ours, PetscInt theirs)
{
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (ours > theirs * (size > 1 ? 1.33 : 1.1) + 2)
    PetscCall(PetscPrintf(comm, "    %s: %" PetscInt_FMT " iterations, hypre %" PetscInt_FMT "\n", what, ours, theirs));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckMatrix(MatType type, PetscInt n, PetscInt bs)
{
  const MPI_Comm   comm = PETSC_COMM_WORLD;
  Mat              A;
  KSP              ksp = NULL, hypre = NULL;
  PetscInt         its[2], again;
  PetscObjectState before, after;

  PetscFunctionBeginUser;
  PetscCall(
    PetscPrintf(comm, "%s, block size %" PetscInt_FMT ", %" PetscInt_FMT " unknowns\n", type, bs, n * n * n * bs));
  PetscCall(CubeCreate(comm, type, n, bs, 1.0, &A));
  PetscCall(PetscObjectStateGet((PetscObject)A, &before));
  PetscCall(Solve(A, PCBLOCKAMG, 1.0, &ksp, &its[0]));
  PetscCall(PetscObjectStateGet((PetscObject)A, &after));
  if (after != before)
    PetscCall(
      PetscPrintf(comm, "    the set-up marks the matrix as changed, so that every application sets up again\n"));
  PetscCall(Solve(A, PCHYPRE, 1.0, &hypre, &its[1]));
  PetscCall(CheckCounts(comm, "counts", its[0], its[1]));
  PetscCall(CheckProduct(ksp, A));
  PetscCall(CheckSymmetry(ksp, A));
  /* new values, in other units: set up again */
  for (PetscReal unit = 1e-14; unit < 1e15; unit *= 1e28) {
    PetscCall(MatScale(A, unit == 1e-14 ? unit : 1e28));
    PetscCall(Solve(A, PCBLOCKAMG, 1e-20 / unit, &ksp, &again));
    if (PetscAbsInt(again - its[0]) > 1)
      PetscCall(PetscPrintf(comm, "    times %g: %" PetscInt_FMT " iterations, not %" PetscInt_FMT "\n", (double)unit,
        again, its[0]));
  }
  PetscCall(KSPReset(ksp));
  PetscCall(Solve(A, PCBLOCKAMG, 1.0, &ksp, &again));
  if (PetscAbsInt(again - its[0]) > 1)
    PetscCall(
      PetscPrintf(comm, "    after a reset: %" PetscInt_FMT " iterations, not %" PetscInt_FMT "\n", again, its[0]));
  PetscCall(KSPDestroy(&hypre));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

/*
   Stiff parts in a soft one: of four consecutive edges of the grid in direction x, the last ones from edge number
   `first` on are about a million times as stiff as the others
*/
static PetscErrorCode CheckContrast(MatType type, PetscInt first)
{
  const MPI_Comm comm = PETSC_COMM_WORLD;
  Mat            A;
  KSP            ksp = NULL, hypre = NULL;
  PetscInt       its[2], start, end, n = 8;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(comm, "%s, stiff parts of %" PetscInt_FMT " edges in a soft one\n", type, 4 - first));
  PetscCall(CubeCreate(comm, type, n, 3, 1.0, &A));
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt node = start / 3; node < end / 3; node++) { /* an edge to the next node in x */
    const PetscInt x = node % n, from = 3 * node, to = 3 * (node + 1);

    if (x % 4 < first || x == n - 1) continue;
    for (PetscInt c = 0; c < 3; c++) {
      const PetscReal   stiffness = 1e6 * (1.0 + 0.3 * PetscSinReal((PetscReal)(from + c)));
      const PetscInt    rows[2]   = {from + c, to + c};
      const PetscScalar edge[4]   = {stiffness, -stiffness, -stiffness, stiffness};

      PetscCall(MatSetValues(A, 2, rows, 2, rows, edge, ADD_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscCall(Solve(A, PCBLOCKAMG, 1.0, &ksp, &its[0]));
  PetscCall(Solve(A, PCHYPRE, 1.0, &hypre, &its[1]));
  if (its[0] > 1.6 * its[1]) /* 2 times as many if the stiff entries have 16 bits */
    PetscCall(PetscPrintf(comm, "    %" PetscInt_FMT " iterations, hypre %" PetscInt_FMT "\n", its[0], its[1]));
  PetscCall(CheckSymmetry(ksp, A));
  PetscCall(KSPDestroy(&hypre));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

/*
   Prescribed values on a face, whose rows are those of the identity and whose columns stay: the operator is not
   symmetric. CG keeps the prescribed zeros only if the preconditioner does.
*/
static PetscErrorCode CheckPrescribed(MatType type)
{
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const PetscInt n    = 12;
  Mat            A;
  Vec            x, b;
  PetscInt       its[2], start, end, *rows, nrows = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(comm, "%s, prescribed values\n", type));
  PetscCall(CubeCreate(comm, type, n, 1, 1.0, &A));
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  PetscCall(PetscMalloc1(end - start, &rows));
  for (PetscInt row = start; row < PetscMin(end, n * n); row++) rows[nrows++] = row;
  PetscCall(MatZeroRows(A, nrows, rows, 6.0, NULL, NULL));
  PetscCall(MatCreateVecs(A, &x, &b));
  for (PetscInt k = 0; k < 2; k++) {
    KSP                ksp;
    PC                 pc;
    KSPConvergedReason reason;

    PetscCall(FillVector(b, 0.7));
    for (PetscInt i = 0; i < nrows; i++) PetscCall(VecSetValue(b, rows[i], 0.0, INSERT_VALUES));
    PetscCall(VecAssemblyBegin(b));
    PetscCall(VecAssemblyEnd(b));
    PetscCall(KSPCreate(comm, &ksp));
    PetscCall(KSPSetType(ksp, KSPCG));
    PetscCall(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
    PetscCall(KSPSetTolerances(ksp, 1e-10, 0.0, PETSC_DEFAULT, 500));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, k ? PCHYPRE : PCBLOCKAMG));
    PetscCall(KSPSetOperators(ksp, A, A));
    PetscCall(KSPSolve(ksp, b, x));
    PetscCall(KSPGetConvergedReason(ksp, &reason));
    PetscCall(KSPGetIterationNumber(ksp, &its[k]));
    if (reason < 0) PetscCall(PetscPrintf(comm, "    %s: %s\n", k ? "hypre" : "ours", KSPConvergedReasons[reason]));
    PetscCall(KSPDestroy(&ksp));
  }
  PetscCall(CheckCounts(comm, "prescribed values", its[0], its[1]));
  PetscCall(PetscFree(rows));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

/* What is not positive definite: a row whose diagonal entry is this */
static PetscErrorCode CheckRefusal(PetscScalar entry)
{
  const MPI_Comm     comm = PETSC_COMM_WORLD;
  Mat                A;
  KSP                ksp = NULL;
  PetscInt           its, row = 4 * 4 * 4 * 3 - 2, start, end;
  KSPConvergedReason reason;
  Vec                x, b;

  PetscFunctionBeginUser;
  PetscCall(CubeCreate(comm, MATAIJ, 4, 3, 1.0, &A));
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  if (row >= start && row < end) PetscCall(MatSetValue(A, row, row, entry, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscCall(KSPCreate(comm, &ksp));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetOperators(ksp, A, A));
  PC pc;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCBLOCKAMG));
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(FillVector(b, 0.7));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(
    PetscPrintf(comm, "a diagonal entry of %g: %s\n", (double)PetscRealPart(entry), KSPConvergedReasons[reason]));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const MatType  types[] = {MATAIJ, MATBAIJ, MATSBAIJ};
  const PetscInt sizes[] = {1, 2, 3, 6};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  /* the same hierarchy for hypre's own cycle */
  PetscCall(PetscOptionsInsertString(NULL,
    "-pc_hypre_boomeramg_coarsen_type HMIS -pc_hypre_boomeramg_interp_type ext+i -pc_hypre_boomeramg_P_max 4 "
    "-pc_hypre_boomeramg_strong_threshold 0.25 "
    "-pc_hypre_boomeramg_relax_type_down l1-Gauss-Seidel -pc_hypre_boomeramg_relax_type_up backward-l1-Gauss-Seidel"));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(sizes); i++) PetscCall(CheckMatrix(MATAIJ, 10, sizes[i]));
  for (size_t i = 1; i < PETSC_STATIC_ARRAY_LENGTH(types); i++) PetscCall(CheckMatrix(types[i], 8, 3));
  PetscCall(CheckMatrix(MATAIJ, 2, 1)); /* one level */
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(types); i += 2) {
    PetscCall(CheckContrast(types[i], 3));
    PetscCall(CheckContrast(types[i], 1));
  }
  PetscCall(CheckPrescribed(MATAIJ));
  PetscCall(CheckPrescribed(MATBAIJ));
  PetscCall(CheckRefusal(0.0));
  PetscCall(CheckRefusal(-5.0));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 4 2}}

TEST*/
