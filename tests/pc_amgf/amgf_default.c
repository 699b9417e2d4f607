static char help[] = "PCAMGF: the AMG that it takes by itself, in which operators and under which options, and that "
                     "it solves in any units.\n\n";

#include "amgf_problem.h"

typedef struct {
  Problem     problem;
  MatType     type;
  PetscReal   unit; /* the operator is multiplied by it */
  PetscBool   held; /* the first row of each rank is that of a prescribed value, its diagonal entry 1 */
  PetscBool   filtered;
  PCAMGFCycle cycle;
  const char *options;
} Case;

static PetscErrorCode CaseCreateMatrix(const Case *c, Mat *A)
{
  PetscInt start, end;
  Mat      B;

  PetscFunctionBeginUser;
  PetscCall(ProblemCreate(PETSC_COMM_WORLD, &c->problem, MATAIJ, PETSC_TRUE, &B));
  PetscCall(MatScale(B, c->unit));
  PetscCall(MatGetOwnershipRange(B, &start, &end));
  if (c->held) PetscCall(MatZeroRowsColumns(B, start < end ? 1 : 0, &start, 1.0, NULL, NULL));
  PetscCall(MatSetOption(B, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatConvert(B, c->type, MAT_INITIAL_MATRIX, A));
  PetscCall(MatDestroy(&B));
  PetscFunctionReturn(0);
}

/* Iterations to 1e-9, and the AMG's type */
static PetscErrorCode CaseSolve(const Case *c, Mat A, PetscInt *its, char type[], size_t len)
{
  KSP                ksp;
  PC                 pc, amg;
  PCType             taken;
  Vec                x, b;
  IS                 filter;
  KSPConvergedReason reason;

  PetscFunctionBeginUser;
  if (c->options) PetscCall(PetscOptionsInsertString(NULL, c->options));
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(FillVector(b, 0.7));
  PetscCall(ProblemCreateSolver(A, A, &ksp, &pc));
  PetscCall(KSPSetTolerances(ksp, 1e-9, 0.0, PETSC_DEFAULT, 2000));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCAMGFSetCycle(pc, c->cycle));
  PetscCall(ProblemCreateFilterIS(&c->problem, A, PETSC_COMM_WORLD, &filter));
  if (c->filtered) PetscCall(PCAMGFSetFilterIS(pc, filter));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, its));
  PetscCall(PCAMGFGetAMGPC(pc, &amg));
  PetscCall(PCGetType(amg, &taken));
  PetscCall(PetscStrncpy(type, taken, len));
  if (reason < 0) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s\n", KSPConvergedReasons[reason]));
  PetscCall(ISDestroy(&filter));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  if (c->options) PetscCall(PetscOptionsClear(NULL));
  PetscFunctionReturn(0);
}

/* The type, and iterations beside those of BoomerAMG, in these units and in others */
static PetscErrorCode Check(const char what[], Case c)
{
  const PetscReal units[] = {1.0, 1e12, 1e-14};
  PetscInt        its[PETSC_STATIC_ARRAY_LENGTH(units)], theirs;
  PetscMPIInt     size;
  char            type[64], other[64];
  Mat             A;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(units); i++) {
    Case unit = c, hypre = c;

    hypre.options = "-amgf_amg_pc_type hypre";
    if (!c.held) unit.unit = units[i];
    PetscCall(CaseCreateMatrix(&unit, &A));
    PetscCall(CaseSolve(&unit, A, &its[i], type, sizeof(type)));
    if (i) PetscCall(MatDestroy(&A));
    else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", what, type));
    if (i && PetscAbsInt(its[i] - its[0]) > 1 + its[0] / 7)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  times %g: %" PetscInt_FMT " iterations, not %" PetscInt_FMT "\n",
        (double)units[i], its[i], its[0]));
    if (i) continue;
    PetscCall(CaseSolve(&hypre, A, &theirs, other, sizeof(other)));
    PetscCall(MatDestroy(&A));
    if (its[0] > (size > 1 ? 1.33 : 1.1) * theirs + 5)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %" PetscInt_FMT " iterations, %" PetscInt_FMT " by BoomerAMG\n",
        its[0], theirs));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Case      c    = {.type = MATAIJ, .unit = 1.0, .cycle = PC_AMGF_FBF}, stiff, held;
  PetscBool gamg = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(ProblemSetDefaults(&c.problem));
  c.problem.n       = 24;
  c.problem.highest = 2.0;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-gamg", &gamg, NULL));
  if (gamg) {
    /* PETSc's LU of the coarsest operator would shift pivots below an absolute limit */
    c.options = "-amgf_amg_pc_type gamg -amgf_amg_mg_coarse_sub_pc_factor_zeropivot 1e-60";
    PetscCall(Check(c.options, c));
    PetscCall(PetscFinalize());
    return 0;
  }
  PetscCall(Check("aij", c));
  c.type = MATBAIJ;
  PetscCall(Check("baij", c));
  c.type = MATSBAIJ;
  PetscCall(Check("sbaij", c));
  c.type       = MATAIJ;
  c.problem.bs = 1;
  PetscCall(Check("block size 1", c));
  c.problem.bs = 3;
  held         = c;
  held.unit    = 1e12;
  held.held    = PETSC_TRUE;
  PetscCall(Check("prescribed values in other units", held));
  stiff                 = c;
  stiff.problem.highest = 9.7;
  PetscCall(Check("rows 5e9 times as stiff", stiff));
  stiff.filtered = PETSC_TRUE;
  PetscCall(Check("filtered, fbf", stiff));
  stiff.cycle = PC_AMGF_BFB;
  PetscCall(Check("filtered, bfb", stiff));
  stiff.cycle = PC_AMGF_ADDITIVE;
  PetscCall(Check("filtered, additive", stiff));
  c.options = "-amgf_amg_pc_type hypre";
  PetscCall(Check(c.options, c));
  c.options = "-amgf_amg_pc_hypre_boomeramg_relax_type_all symmetric-SOR/Jacobi";
  PetscCall(Check(c.options, c));
  c.options = "-amgf_amg_pc_hypre_boomeramg_strong_threshold 0.5";
  PetscCall(Check(c.options, c));
  c.options   = NULL;
  c.type      = MATDENSE;
  c.problem.n = 8;
  PetscCall(Check("dense", c));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 4 2}}

   # with debugging PETSc 3.18 ends in its own MatCreateGraph() on four ranks: "Some processors inserted others added"
   test:
      suffix: gamg
      requires: !debug
      nsize: {{1 2 4}}
      args: -gamg

TEST*/
