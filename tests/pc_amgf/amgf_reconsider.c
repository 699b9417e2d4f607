static char help[] =
  "PCAMGF replaces an AMG that has been applied often by a factorization whose factors are small.\n\n";

#include <petscamgf.h>

/* Creates the finite-difference matrix of the Laplacian on a grid of nx x ny x nz points */
static PetscErrorCode CreateLaplacian(PetscInt nx, PetscInt ny, PetscInt nz, Mat *A)
{
  const PetscInt n[3] = {nx, ny, nz}, step[3] = {1, nx, nx * ny};

  PetscFunctionBeginUser;
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, nx * ny * nz, nx * ny * nz, 7, NULL, A));
  for (PetscInt row = 0; row < nx * ny * nz; row++) {
    const PetscInt place[3] = {row % nx, row / nx % ny, row / nx / ny};

    PetscCall(MatSetValue(*A, row, row, 6.0, INSERT_VALUES));
    for (PetscInt d = 0; d < 3; d++) {
      if (place[d] > 0) PetscCall(MatSetValue(*A, row, row - step[d], -1.0, INSERT_VALUES));
      if (place[d] + 1 < n[d]) PetscCall(MatSetValue(*A, row, row + step[d], -1.0, INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Applies the preconditioner n times, and prints whether it factors the operator then */
static PetscErrorCode Apply(PC pc, PetscInt n, const char what[])
{
  Mat       A;
  Vec       r, z;
  PetscBool changed, factored;

  PetscFunctionBeginUser;
  PetscCall(PCGetOperators(pc, &A, NULL));
  PetscCall(MatCreateVecs(A, &z, &r));
  PetscCall(VecSet(r, 1.0));
  for (PetscInt k = 0; k < n; k++) PetscCall(PCApply(pc, r, z));
  PetscCall(PCAMGFReconsiderFactor(pc, &changed));
  PetscCall(PCSetUp(pc));
  PetscCall(PCApply(pc, r, z));
  PetscCall(PCAMGFGetFactored(pc, &factored));
  PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s: %s, %s\n", what, changed ? "changed" : "as before",
    factored ? "factorization" : "AMG"));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&z));
  PetscFunctionReturn(0);
}

/* A grid of points: after few and after many applications, and after more */
static PetscErrorCode CheckGrid(PetscInt nx, PetscInt ny, PetscInt nz, PCAMGFFactorUse use, const char what[])
{
  Mat A;
  PC  pc;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s\n", what));
  PetscCall(CreateLaplacian(nx, ny, nz, &A));
  PetscCall(PCCreate(PETSC_COMM_SELF, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCAMGFSetFactor(pc, use));
  PetscCall(PCSetOperators(pc, A, A));
  PetscCall(Apply(pc, 10, "  10 applications"));
  PetscCall(Apply(pc, 60, "  70 applications"));
  PetscCall(Apply(pc, 60, " 130 applications"));
  PetscCall(PCDestroy(&pc));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(CheckGrid(2000, 8, 1, PC_AMGF_FACTOR_AUTO, "strip"));
  PetscCall(CheckGrid(2000, 8, 1, PC_AMGF_FACTOR_FALSE, "strip, never"));
  PetscCall(CheckGrid(26, 26, 26, PC_AMGF_FACTOR_AUTO, "cube"));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   build:
      requires: suitesparse

   test:
      suffix: 1

TEST*/
