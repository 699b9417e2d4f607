static char help[] =
  "PCAMGF on a Hermitian positive definite matrix, complex where PETSc's scalars are: its cycles are Hermitian\n\
and positive, and CG with them finds\n\
what a direct solver finds. -hermitian 0: B is not Hermitian, and only the transposes are looked at\n\n";

#include "amgf_problem.h"

#define NODES 24 /* a side */

/* exp(i angle); 1 without complex numbers */
static PetscScalar Phase(PetscReal angle)
{
#if defined(PETSC_USE_COMPLEX)
  return PetscCMPLX(PetscCosReal(angle), PetscSinReal(angle));
#else
  (void)angle;
  return 1.0;
#endif
}

/* Laplacian in a magnetic field: the phase of an edge along x is that of its height, and no change of gauge makes the
   matrix real */
static PetscErrorCode AddLaplacian(Mat A)
{
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt row = start; row < end; row++) {
    const PetscInt x = row % NODES, y = row / NODES;

    PetscCall(MatSetValue(A, row, row, 4.0, ADD_VALUES));
    if (x > 0) PetscCall(MatSetValue(A, row, row - 1, -Phase(-0.02 * y), ADD_VALUES));
    if (x < NODES - 1) PetscCall(MatSetValue(A, row, row + 1, -Phase(0.02 * y), ADD_VALUES));
    if (y > 0) PetscCall(MatSetValue(A, row, row - NODES, -1.0, ADD_VALUES));
    if (y < NODES - 1) PetscCall(MatSetValue(A, row, row + NODES, -1.0, ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

/* J^H D J ties the lower to the upper edge; D grows over six orders */
static PetscErrorCode AddTies(Mat A)
{
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt k = 0; k < NODES; k++) {
    const PetscInt    cols[2] = {k, NODES * (NODES - 1) + k};
    const PetscScalar vals[2] = {1.0, -Phase(1.0 + k)};
    const PetscReal   d       = PetscPowReal(10.0, 6.0 * k / (NODES - 1));

    for (PetscInt i = 0; i < 2; i++) {
      if (cols[i] < start || cols[i] >= end) continue;
      for (PetscInt j = 0; j < 2; j++)
        PetscCall(MatSetValue(A, cols[i], cols[j], d * PetscConj(vals[i]) * vals[j], ADD_VALUES));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateOperator(MPI_Comm comm, Mat *A)
{
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(comm, PETSC_DECIDE, PETSC_DECIDE, NODES * NODES, NODES * NODES, 6, NULL, 6, NULL, A));
  PetscCall(AddLaplacian(*A));
  PetscCall(AddTies(*A));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
#if defined(PETSC_USE_COMPLEX)
  PetscCall(MatSetOption(*A, MAT_HERMITIAN, PETSC_TRUE));
#endif
  PetscFunctionReturn(0);
}

/* The owned unknowns of both edges */
static PetscErrorCode CreateTied(Mat A, IS *is)
{
  PetscInt start, end, n = 0, idx[2 * NODES];

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt row = start; row < end; row++) {
    if (row < NODES || row >= NODES * (NODES - 1)) idx[n++] = row;
  }
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)A), n, idx, PETSC_COPY_VALUES, is));
  PetscFunctionReturn(0);
}

static PetscErrorCode FillComplex(Vec x, PetscReal seed)
{
  PetscFunctionBeginUser;
  PetscCall(FillVector(x, seed));
#if defined(PETSC_USE_COMPLEX)
  Vec imaginary;

  PetscCall(VecDuplicate(x, &imaginary));
  PetscCall(FillVector(imaginary, seed + 0.7));
  PetscCall(VecAXPY(x, PETSC_i, imaginary));
  PetscCall(VecDestroy(&imaginary));
#endif
  PetscFunctionReturn(0);
}

/* The direct solver gathers the matrix on every rank: PETSc's own LU, whatever PETSc was configured with */
static PetscErrorCode SolveDirectly(Mat A, Vec b, Vec x)
{
  KSP ksp, inner;
  PC  pc;

  PetscFunctionBeginUser;
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)A), &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPSetOperators(ksp, A, A));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCREDUNDANT));
  PetscCall(PCRedundantGetKSP(pc, &inner));
  PetscCall(KSPGetPC(inner, &pc));
  PetscCall(PCSetType(pc, PCLU));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckSolve(KSP ksp, Vec b, Vec exact)
{
  Vec       x;
  PetscReal difference;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(b, &x));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(RelativeDifference(x, exact, &difference));
  PetscCall(ReportBound(PetscObjectComm((PetscObject)ksp), "  the direct solver's solution", difference, 1e-8));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

/* (y, M x) = (M y, x), (x, M x) > 0 */
static PetscErrorCode CheckHermitian(PC pc, Vec x)
{
  MPI_Comm    comm;
  Vec         y, Mx, My;
  PetscScalar a, b, xMx, yMy;
  PetscReal   violation = 0.0, positive = PETSC_MAX_REAL;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectGetComm((PetscObject)pc, &comm));
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecDuplicate(x, &Mx));
  PetscCall(VecDuplicate(x, &My));
  for (PetscInt i = 0; i < 5; i++) {
    PetscCall(FillComplex(x, 0.5 + i));
    PetscCall(FillComplex(y, 20.7 + 3 * i));
    PetscCall(PCApply(pc, x, Mx));
    PetscCall(PCApply(pc, y, My));
    PetscCall(VecDot(Mx, y, &a));
    PetscCall(VecDot(x, My, &b));
    PetscCall(VecDot(Mx, x, &xMx));
    PetscCall(VecDot(My, y, &yMy));
    violation = PetscMax(violation, PetscAbsScalar(a - b) / PetscSqrtReal(PetscAbsScalar(xMx * yMy)));
    positive  = PetscMin(positive, PetscMin(PetscRealPart(xMx), PetscRealPart(yMy)));
  }
  PetscCall(ReportBound(comm, "  Hermitian", violation, 1e-10));
  PetscCall(ReportBound(comm, "  positive", -positive, 0.0));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&Mx));
  PetscCall(VecDestroy(&My));
  PetscFunctionReturn(0);
}

/* x^T M y = (M^T x)^T y, nothing conjugated */
static PetscErrorCode CheckTranspose(PC pc, Vec x)
{
  Vec         y, Mx, My;
  PetscScalar a, b;
  PetscReal   nx, ny, violation = 0.0;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecDuplicate(x, &Mx));
  PetscCall(VecDuplicate(x, &My));
  for (PetscInt i = 0; i < 5; i++) {
    PetscCall(FillComplex(x, 0.5 + i));
    PetscCall(FillComplex(y, 20.7 + 3 * i));
    PetscCall(PCApply(pc, y, My));
    PetscCall(PCApplyTranspose(pc, x, Mx));
    PetscCall(VecTDot(x, My, &a));
    PetscCall(VecTDot(Mx, y, &b));
    PetscCall(VecNorm(x, NORM_2, &nx));
    PetscCall(VecNorm(My, NORM_2, &ny));
    violation = PetscMax(violation, PetscAbsScalar(a - b) / (nx * ny));
  }
  PetscCall(ReportBound(PetscObjectComm((PetscObject)pc), "  transpose", violation, 1e-10));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&Mx));
  PetscCall(VecDestroy(&My));
  PetscFunctionReturn(0);
}

/* P NULL: the unknowns of the IS */
static PetscErrorCode CheckCycle(Mat A, IS is, Mat P, PCAMGFCycle cycle, PetscBool hermitian, Vec b, Vec exact)
{
  KSP ksp;
  PC  pc;
  Vec x;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PetscObjectComm((PetscObject)A), "%s, %s\n", PCAMGFCycles[cycle],
    P ? "range of a matrix" : "unknowns"));
  PetscCall(ProblemCreateSolver(A, A, &ksp, &pc));
  PetscCall(KSPSetTolerances(ksp, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 60));
  PetscCall(KSPSetErrorIfNotConverged(ksp, PETSC_TRUE));
  PetscCall(PCAMGFSetCycle(pc, cycle));
  if (P) PetscCall(PCAMGFSetFilterInterpolation(pc, P));
  else PetscCall(PCAMGFSetFilterIS(pc, is));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(KSPSetUp(ksp));
  PetscCall(VecDuplicate(b, &x));
  if (hermitian) {
    PetscCall(CheckHermitian(pc, x));
    PetscCall(CheckSolve(ksp, b, exact));
  }
  PetscCall(CheckTranspose(pc, x));
  PetscCall(VecDestroy(&x));
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  MPI_Comm  comm;
  Mat       A, P;
  IS        is;
  Vec       b, exact;
  PetscBool hermitian = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  comm = PETSC_COMM_WORLD;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-hermitian", &hermitian, NULL));
  if (hermitian && !PetscDefined(USE_COMPLEX)) /* in double precision, as with complex scalars */
    PetscCall(PetscOptionsSetValue(NULL, "-amgf_amg_pc_type", PCHYPRE));
  PetscCall(CreateOperator(comm, &A));
  PetscCall(CreateTied(A, &is));
  PetscCall(ProblemCreateInterpolation(A, is, 0.25 * Phase(0.8), &P));
  PetscCall(MatCreateVecs(A, &exact, &b));
  PetscCall(FillComplex(b, 3.0));
  PetscCall(SolveDirectly(A, b, exact));
  for (PCAMGFCycle cycle = PC_AMGF_BFB; cycle <= PC_AMGF_ADDITIVE; cycle++) {
    PetscCall(CheckCycle(A, is, NULL, cycle, hermitian, b, exact));
    PetscCall(CheckCycle(A, is, P, cycle, hermitian, b, exact));
  }
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&exact));
  PetscCall(ISDestroy(&is));
  PetscCall(MatDestroy(&P));
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: solves
      nsize: {{1 2}}
      output_file: output/amgf_hermitian_solves.out

   test:
      suffix: transposes
      nsize: {{1 2}}
      args: -hermitian 0 -amgf_amg_pc_type composite -amgf_amg_pc_composite_type multiplicative -amgf_amg_pc_composite_pcs jacobi,bjacobi
      output_file: output/amgf_hermitian_transposes.out

TEST*/
