static char help[] = "PCAMGF: exact eigenvalues of MA on a small matrix, for stiffness contrasts of many orders, "
                     "against the published bound.\n\
  -single: the AMG rounds to single precision, and need not be worse than the bound by itself\n\n";

#include "amgf_problem.h"

/* The preconditioner as a dense matrix, rounding of its symmetry removed */
static PetscErrorCode PreconditionerToDense(PC pc, Mat A, Mat *M)
{
  Mat      T;
  Vec      x, y;
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, n, n, NULL, M));
  PetscCall(MatCreateVecs(A, &x, NULL));
  for (PetscInt j = 0; j < n; j++) {
    PetscCall(VecSet(x, 0.0));
    PetscCall(VecSetValue(x, j, 1.0, INSERT_VALUES));
    PetscCall(VecAssemblyBegin(x));
    PetscCall(VecAssemblyEnd(x));
    PetscCall(MatDenseGetColumnVecWrite(*M, j, &y));
    PetscCall(PCApply(pc, x, y));
    PetscCall(MatDenseRestoreColumnVecWrite(*M, j, &y));
  }
  PetscCall(MatTranspose(*M, MAT_INITIAL_MATRIX, &T));
  PetscCall(MatAXPY(*M, 1.0, T, SAME_NONZERO_PATTERN));
  PetscCall(MatScale(*M, 0.5));
  PetscCall(MatDestroy(&T));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

/* A = L L^T */
static PetscErrorCode CholeskyFactor(Mat A, Mat *L)
{
  PetscInt     n;
  PetscScalar *l;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(MatConvert(A, MATSEQDENSE, MAT_INITIAL_MATRIX, L));
  PetscCall(MatDenseGetArray(*L, &l));
  for (PetscInt j = 0; j < n; j++) {
    for (PetscInt k = 0; k < j; k++) {
      for (PetscInt i = j; i < n; i++) l[j * n + i] -= l[k * n + i] * l[k * n + j];
    }
    PetscCheck(PetscRealPart(l[j * n + j]) > 0.0, PETSC_COMM_SELF, PETSC_ERR_LIB,
      "A is not positive definite: pivot %" PetscInt_FMT, j);
    l[j * n + j] = PetscSqrtScalar(l[j * n + j]);
    for (PetscInt i = 0; i < j; i++) l[j * n + i] = 0.0;
    for (PetscInt i = j + 1; i < n; i++) l[j * n + i] /= l[j * n + j];
  }
  PetscCall(MatDenseRestoreArray(*L, &l));
  PetscFunctionReturn(0);
}

/* Extreme eigenvalues of M A, which are those of L^T M L; how many are within 1e-5 of 1. PETSc has LAPACK compute
   them. */
static PetscErrorCode Spectrum(Mat A, PC pc, PetscReal *least, PetscReal *largest, PetscInt *ones)
{
  Mat        L, M, ML, S;
  KSP        ksp;
  PC         none;
  PetscInt   n;
  PetscReal *re, *im;

  PetscFunctionBeginUser;
  PetscCall(PreconditionerToDense(pc, A, &M));
  PetscCall(CholeskyFactor(A, &L));
  PetscCall(MatMatMult(M, L, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &ML));
  PetscCall(MatTransposeMatMult(L, ML, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &S));
  PetscCall(KSPCreate(PETSC_COMM_SELF, &ksp));
  PetscCall(KSPSetOperators(ksp, S, S));
  PetscCall(KSPGetPC(ksp, &none));
  PetscCall(PCSetType(none, PCNONE));
  PetscCall(KSPSetPCSide(ksp, PC_LEFT));
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(PetscMalloc2(n, &re, n, &im));
  PetscCall(KSPComputeEigenvaluesExplicitly(ksp, n, re, im));
  PetscCall(PetscSortReal(n, re));
  *least   = re[0];
  *largest = re[n - 1];
  *ones    = 0;
  for (PetscInt i = 0; i < n; i++) *ones += (PetscAbsReal(re[i] - 1.0) < 1e-5);
  PetscCall(PetscFree2(re, im));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&S));
  PetscCall(MatDestroy(&ML));
  PetscCall(MatDestroy(&M));
  PetscCall(MatDestroy(&L));
  PetscFunctionReturn(0);
}

/* PCAMGF of A with the given subspace; without one it is the AMG alone, B */
static PetscErrorCode CreateAMGF(Mat A, IS is, PCAMGFCycle cycle, PC *pc)
{
  PetscFunctionBeginUser;
  PetscCall(PCCreate(PETSC_COMM_SELF, pc));
  PetscCall(PCSetOperators(*pc, A, A));
  PetscCall(PCSetType(*pc, PCAMGF));
  PetscCall(PCAMGFSetFilterOptional(*pc, PETSC_TRUE));
  if (is) PetscCall(PCAMGFSetFilterIS(*pc, is));
  PetscCall(PCAMGFSetCycle(*pc, cycle));
  PetscCall(PCSetFromOptions(*pc));
  PetscCall(PCSetUp(*pc));
  PetscFunctionReturn(0);
}

static PetscErrorCode SpectrumOf(Mat A, Mat buildfrom, IS is, PCAMGFCycle cycle, PetscReal *least, PetscReal *largest,
  PetscInt *ones)
{
  PC pc;

  PetscFunctionBeginUser;
  PetscCall(CreateAMGF(buildfrom, is, cycle, &pc));
  PetscCall(Spectrum(A, pc, least, largest, ones));
  PetscCall(PCDestroy(&pc));
  PetscFunctionReturn(0);
}

/* bfb: 1 is the largest eigenvalue, with the dimension of the subspace as multiplicity at least, and the published
   bound holds */
static PetscErrorCode CheckBFB(Mat A, IS is, PetscReal beta, PetscReal omega, PetscReal tolerance)
{
  PetscReal least, largest;
  PetscInt  ones, nc;

  PetscFunctionBeginUser;
  PetscCall(ISGetSize(is, &nc));
  PetscCall(SpectrumOf(A, A, is, PC_AMGF_BFB, &least, &largest, &ones));
  PetscCall(PetscInfo(NULL, "bfb: condition number %g, bound %g\n", (double)(largest / least),
    (double)(2.0 * (beta + 2.0 + omega) / (2.0 - omega))));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  bfb positive", -least, 0.0));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  bfb largest eigenvalue 1", PetscAbsReal(largest - 1.0), tolerance));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  bfb exact on the subspace", nc, ones));
  PetscCall(
    ReportBound(PETSC_COMM_SELF, "  bfb published bound", largest / least, 2.0 * (beta + 2.0 + omega) / (2.0 - omega)));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  bfb published bound, l1 smoother", largest / least, 2.0 * (beta + 3.0)));
  PetscFunctionReturn(0);
}

/* fbf: exact on the subspace, eigenvalues at most max(1, omega). additive: at most 1 + omega. Both positive for any
   B, also one of the operator without the stiff part */
static PetscErrorCode CheckOthers(Mat A, Mat K, IS is, PetscReal omega)
{
  PetscReal least, largest;
  PetscInt  ones, nc;
  PC        pc;

  PetscFunctionBeginUser;
  PetscCall(ISGetSize(is, &nc));
  PetscCall(SpectrumOf(A, A, is, PC_AMGF_FBF, &least, &largest, &ones));
  PetscCall(PetscInfo(NULL, "fbf: condition number %g\n", (double)(largest / least)));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  fbf positive", -least, 0.0));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  fbf largest eigenvalue", largest, PetscMax(1.0, omega) + 1e-5));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  fbf exact on the subspace", nc, ones));
  PetscCall(SpectrumOf(A, A, is, PC_AMGF_ADDITIVE, &least, &largest, &ones));
  PetscCall(PetscInfo(NULL, "additive: condition number %g\n", (double)(largest / least)));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  additive positive", -least, 0.0));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  additive largest eigenvalue", largest, 1.0 + omega + 1e-5));
  PetscCall(CreateAMGF(K, is, PC_AMGF_FBF, &pc));
  PetscCall(PCAMGFSetAMGLag(pc, -1));
  PetscCall(PCSetOperators(pc, A, A));
  PetscCall(PCSetUp(pc));
  PetscCall(Spectrum(A, pc, &least, &largest, &ones));
  PetscCall(PetscInfo(NULL, "fbf, outdated AMG: condition number %g\n", (double)(largest / least)));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  fbf positive with an outdated AMG", -least, 0.0));
  PetscCall(ReportBound(PETSC_COMM_SELF, "  fbf exact on the subspace with an outdated AMG", nc, ones));
  PetscCall(PCDestroy(&pc));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Problem   problem;
  Mat       A, K;
  IS        is;
  PetscReal least, largest, beta, omega, omega_fbf;
  PetscReal tolerance;
  PetscInt  ones;
  PetscBool single = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(ProblemSetDefaults(&problem));
  problem.n = 9;
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &problem.n, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-single", &single, NULL));
  tolerance = single ? 1e-2 : 1e-5;
  PetscCall(ProblemCreate(PETSC_COMM_SELF, &problem, MATAIJ, PETSC_FALSE, &K));
  PetscCall(SpectrumOf(K, K, NULL, PC_AMGF_BFB, &least, &largest, &ones));
  beta = largest / least;
  PetscCall(PetscInfo(NULL, "beta %g\n", (double)beta));
  for (PetscInt exponent = 0; exponent <= 8; exponent += 2) {
    problem.lowest  = -exponent / 2.0;
    problem.highest = exponent;
    PetscCall(ProblemCreate(PETSC_COMM_SELF, &problem, MATAIJ, PETSC_TRUE, &A));
    PetscCall(ProblemCreateFilterIS(&problem, A, PETSC_COMM_SELF, &is));
    PetscCall(PetscPrintf(PETSC_COMM_SELF, "D from 1e%g to 1e%g\n", (double)problem.lowest, (double)problem.highest));
    PetscCall(SpectrumOf(A, A, NULL, PC_AMGF_BFB, &least, &omega, &ones));
    PetscCall(PetscInfo(NULL, "AMG alone: condition number %g, omega %g\n", (double)(omega / least), (double)omega));
    PetscCall(ReportBound(PETSC_COMM_SELF, "  omega with an l1 smoother", omega, 1.0 + tolerance));
    if (exponent >= 4 && !single)
      PetscCall(ReportBound(PETSC_COMM_SELF, "  AMG alone is beyond the bound", 2.0 * (beta + 3.0), omega / least));
    PetscCall(CheckBFB(A, is, beta, omega, tolerance));
    PetscCall(SpectrumOf(A, A, NULL, PC_AMGF_FBF, &least, &omega_fbf, &ones)); /* bfb may have another AMG */
    PetscCall(CheckOthers(A, K, is, omega_fbf));
    PetscCall(ISDestroy(&is));
    PetscCall(MatDestroy(&A));
  }
  PetscCall(MatDestroy(&K));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      args: -amgf_amg_pc_type hypre

   # more unknowns than PCBLOCKAMG solves for at once
   test:
      suffix: single
      args: -n 12 -single

TEST*/
