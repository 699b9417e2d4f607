static char help[] =
  "PCAMGF: its cycles against PETSc's PCCOMPOSITE of the same parts; symmetry, definiteness and transposes.\n\
  -general: the subspace is the range of a matrix, not a set of unknowns\n\
  -amg <hypre>: the AMG; PCBLOCKAMG is symmetric, and the same twice, to the rounding errors of single precision\n\n";

#include "amgf_problem.h"

/* PCGALERKIN: P (P^T A P)^-1 P^T */
static PetscErrorCode ConfigureSubspaceSolve(PC pc, Mat A, Mat P)
{
  Mat Aw;
  KSP ksp;
  PC  direct;

  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCGALERKIN));
  PetscCall(PCGalerkinSetInterpolation(pc, P));
  PetscCall(PCGalerkinGetKSP(pc, &ksp));
  PetscCall(MatPtAP(A, P, MAT_INITIAL_MATRIX, 2.0, &Aw));
  PetscCall(KSPSetOperators(ksp, Aw, Aw));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &direct));
  PetscCall(PCSetType(direct, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(direct, MATSOLVERMUMPS));
  PetscCall(MatDestroy(&Aw));
  PetscFunctionReturn(0);
}

/* The oracle: BoomerAMG, with the parameters PCAMGF documents, and the subspace solve, put together by PETSc */
static PetscErrorCode CreateComposite(Mat A, Mat P, PCType amg, PCAMGFCycle cycle, PC *pc)
{
  static const char boomeramg[] =
    "-oracle_sub_%d_pc_hypre_boomeramg_coarsen_type HMIS -oracle_sub_%d_pc_hypre_boomeramg_interp_type ext+i "
    "-oracle_sub_%d_pc_hypre_boomeramg_P_max 4 "
    "-oracle_sub_%d_pc_hypre_boomeramg_strong_threshold 0.7 -oracle_sub_%d_pc_hypre_boomeramg_relax_type_down "
    "l1-Gauss-Seidel "
    "-oracle_sub_%d_pc_hypre_boomeramg_relax_type_up backward-l1-Gauss-Seidel";
  const int b = cycle == PC_AMGF_FBF ? 1 : 0;
  char      options[1024];
  PC        part;

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(options, sizeof(options), boomeramg, b, b, b, b, b, b));
  PetscCall(PetscOptionsInsertString(NULL, options));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)A), pc));
  PetscCall(PCSetOptionsPrefix(*pc, "oracle_"));
  PetscCall(PCSetOperators(*pc, A, A));
  PetscCall(PCSetType(*pc, PCCOMPOSITE));
  PetscCall(
    PCCompositeSetType(*pc, cycle == PC_AMGF_ADDITIVE ? PC_COMPOSITE_ADDITIVE : PC_COMPOSITE_SYMMETRIC_MULTIPLICATIVE));
  PetscCall(PCCompositeAddPCType(*pc, b ? PCGALERKIN : amg));
  PetscCall(PCCompositeAddPCType(*pc, b ? amg : PCGALERKIN));
  PetscCall(PCCompositeGetPC(*pc, b, &part));
  PetscCall(PCSetFromOptions(part));
  PetscCall(PCCompositeGetPC(*pc, 1 - b, &part));
  PetscCall(ConfigureSubspaceSolve(part, A, P));
  PetscCall(PCSetUp(*pc));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateAMGF(Mat A, IS is, Mat P, PCAMGFCycle cycle, PC *pc)
{
  PetscFunctionBeginUser;
  PetscCall(PCCreate(PetscObjectComm((PetscObject)A), pc));
  PetscCall(PCSetOperators(*pc, A, A));
  PetscCall(PCSetType(*pc, PCAMGF));
  if (P) PetscCall(PCAMGFSetFilterInterpolation(*pc, P));
  else PetscCall(PCAMGFSetFilterIS(*pc, is));
  PetscCall(PCSetFromOptions(*pc));
  PetscCall(PCAMGFSetCycle(*pc, cycle));
  PetscCall(PCSetUp(*pc));
  PetscFunctionReturn(0);
}

static PetscErrorCode CompareWithOracle(PC pc, PC oracle, Vec x, PetscReal tolerance)
{
  Vec       y, z;
  PetscReal difference, worst = 0.0;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecDuplicate(x, &z));
  for (PetscInt i = 0; i < 5; i++) {
    PetscCall(FillVector(x, 1.0 + i));
    PetscCall(PCApply(pc, x, y));
    PetscCall(PCApply(oracle, x, z));
    PetscCall(RelativeDifference(y, z, &difference));
    worst = PetscMax(worst, difference);
  }
  PetscCall(ReportBound(PetscObjectComm((PetscObject)pc), "  equals PCCOMPOSITE", worst, tolerance));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&z));
  PetscFunctionReturn(0);
}

/* Worst relative violation of (x, M y) = (T x, y) over vectors, T = M or its transpose; least (x, M x)/(|x| |M x|) */
static PetscErrorCode CheckSymmetry(PC pc, Vec x, PetscBool transpose, PetscReal *violation, PetscReal *positive)
{
  Vec         y, Mx, My;
  PetscScalar a, b, c, d;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecDuplicate(x, &Mx));
  PetscCall(VecDuplicate(x, &My));
  *violation = 0.0;
  *positive  = PETSC_MAX_REAL;
  for (PetscInt i = 0; i < 10; i++) {
    PetscCall(FillVector(x, 0.5 + i));
    PetscCall(FillVector(y, 20.7 + 3 * i));
    PetscCall(PCApply(pc, y, My));
    PetscCall(PCApply(pc, x, Mx));
    PetscCall(VecDot(x, Mx, &a));
    PetscCall(VecDot(y, My, &b));
    if (transpose) PetscCall(PCApplyTranspose(pc, x, Mx));
    PetscCall(VecDot(x, My, &c));
    PetscCall(VecDot(Mx, y, &d));
    *violation = PetscMax(*violation, PetscAbsScalar(c - d) / PetscSqrtReal(PetscAbsScalar(a * b)));
    *positive  = PetscMin(*positive, PetscMin(PetscRealPart(a), PetscRealPart(b)));
  }
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&Mx));
  PetscCall(VecDestroy(&My));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Problem   problem;
  Mat       A, P;
  IS        is;
  Vec       x;
  PetscBool general = PETSC_FALSE, oracle = PETSC_TRUE, single;
  PetscReal tolerance;
  char      amg[32] = PCHYPRE;
  MPI_Comm  comm;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  comm = PETSC_COMM_WORLD;
  PetscCall(ProblemSetDefaults(&problem));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-general", &general, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-oracle", &oracle, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-highest", &problem.highest, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-amg", amg, sizeof(amg), NULL));
  if (oracle) PetscCall(PetscOptionsSetValue(NULL, "-amgf_amg_pc_type", amg));
  PetscCall(PetscStrcmp(amg, PCBLOCKAMG, &single));
  tolerance = single ? 1e-6 : 1e-12;
  PetscCall(ProblemCreate(comm, &problem, MATAIJ, PETSC_TRUE, &A));
  PetscCall(ProblemCreateFilterIS(&problem, A, comm, &is));
  PetscCall(ProblemCreateInterpolation(A, is, general ? 0.25 : 0.0, &P));
  PetscCall(MatCreateVecs(A, &x, NULL));
  for (PCAMGFCycle cycle = PC_AMGF_BFB; cycle <= PC_AMGF_ADDITIVE; cycle++) {
    PC        pc, composite;
    PetscReal violation, positive;

    PetscCall(PetscPrintf(comm, "%s\n", PCAMGFCycles[cycle]));
    PetscCall(CreateAMGF(A, is, general ? P : NULL, cycle, &pc));
    if (oracle) {
      PetscCall(CreateComposite(A, P, amg, cycle, &composite));
      PetscCall(CompareWithOracle(pc, composite, x, tolerance));
      PetscCall(PCDestroy(&composite));
      PetscCall(CheckSymmetry(pc, x, PETSC_FALSE, &violation, &positive));
      PetscCall(ReportBound(comm, "  symmetric", violation, tolerance));
      PetscCall(ReportBound(comm, "  positive", -positive, 0.0));
    }
    PetscCall(CheckSymmetry(pc, x, PETSC_TRUE, &violation, &positive));
    PetscCall(ReportBound(comm, "  transpose", violation, tolerance));
    PetscCall(PCDestroy(&pc));
  }
  PetscCall(VecDestroy(&x));
  PetscCall(ISDestroy(&is));
  PetscCall(MatDestroy(&P));
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   # PETSc's PCGALERKIN leaves its functions behind, of which PETSc 3.25 with debugging tells
   test:
      suffix: rows
      filter: grep -v "function name: PCGalerkin"
      nsize: {{1 5 2 3}}
      args: -highest 4 -amg {{hypre blockamg}}
      output_file: output/amgf_cycles_oracle.out

   test:
      suffix: general
      filter: grep -v "function name: PCGalerkin"
      nsize: {{1 3}}
      args: -general -highest 4 -amg {{hypre blockamg}}
      output_file: output/amgf_cycles_oracle.out

   # a B that is not symmetric has a transpose of its own
   test:
      suffix: transpose
      nsize: {{1 3}}
      args: -oracle 0 -general {{0 1}} -amgf_amg_pc_type composite -amgf_amg_pc_composite_type multiplicative -amgf_amg_pc_composite_pcs jacobi,bjacobi
      output_file: output/amgf_cycles_transpose.out

TEST*/
