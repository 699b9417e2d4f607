static char help[] =
  "PCAMGF: every way to name the subspace gives the same preconditioner; every bad one gives an error.\n\n";

#include "amgf_problem.h"
#include <petsc/private/petscimpl.h>

typedef struct {
  Problem  problem;
  MPI_Comm comm;
  Mat      A;
  IS       is; /* the stiff unknowns */
  Vec      r, z;
} Context;

static PetscErrorCode NewPC(Context *c, Mat A, PC *pc)
{
  PetscFunctionBeginUser;
  PetscCall(PCCreate(c->comm, pc));
  PetscCall(PCSetOperators(*pc, A, A));
  PetscCall(PCSetType(*pc, PCAMGF));
  PetscFunctionReturn(0);
}

/* Applies the preconditioner, compares with the reference, forgets the preconditioner */
static PetscErrorCode Compare(Context *c, const char what[], PC *pc, PetscReal tolerance)
{
  Vec       z;
  PetscReal difference;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(c->z, &z));
  PetscCall(PCApply(*pc, c->r, z));
  PetscCall(RelativeDifference(z, c->z, &difference));
  PetscCall(ReportBound(c->comm, what, difference, tolerance));
  PetscCall(VecDestroy(&z));
  PetscCall(PCDestroy(pc));
  PetscFunctionReturn(0);
}

/* Twice, backwards, and on rank 0 alone, which owns some of the rows only */
static PetscErrorCode SetByCall(Context *c)
{
  PC              pc;
  IS              all, is;
  PetscInt        n, *idx;
  PetscMPIInt     rank;
  const PetscInt *a;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(c->comm, &rank));
  PetscCall(ProblemCreateFilterIS(&c->problem, c->A, PETSC_COMM_SELF, &all));
  PetscCall(ISGetLocalSize(all, &n));
  PetscCall(ISGetIndices(all, &a));
  PetscCall(PetscMalloc1(2 * n, &idx));
  for (PetscInt i = 0; i < 2 * n; i++) idx[i] = a[(2 * n - 1 - i) / 2];
  PetscCall(ISRestoreIndices(all, &a));
  PetscCall(ISCreateGeneral(c->comm, rank ? 0 : 2 * n, idx, PETSC_OWN_POINTER, &is));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterIS(pc, is));
  PetscCall(Compare(c, "repeated entries, all on rank 0", &pc, 1e-11));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterIS(pc, all));
  PetscCall(Compare(c, "all on every rank, sequential IS", &pc, 1e-11));
  PetscCall(ISDestroy(&is));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetByInterpolation(Context *c)
{
  PC  pc;
  Mat P, D;

  PetscFunctionBeginUser;
  PetscCall(ProblemCreateInterpolation(c->A, c->is, 0.0, &P));
  PetscCall(MatConvert(P, MATDENSE, MAT_INITIAL_MATRIX, &D));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterInterpolation(pc, P));
  PetscCall(Compare(c, "interpolation", &pc, 1e-9));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterInterpolation(pc, D));
  PetscCall(Compare(c, "dense interpolation", &pc, 1e-9));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, (PetscObject)P));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(Compare(c, "composed interpolation", &pc, 1e-9));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, NULL));
  PetscCall(MatDestroy(&D));
  PetscCall(MatDestroy(&P));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetByOptions(Context *c)
{
  PC          pc;
  PetscViewer viewer;
  PetscInt    n, expected;
  char        file[PETSC_MAX_PATH_LEN] = "amgf_subspace.is";

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetString(NULL, NULL, "-file", file, sizeof(file), NULL));
  PetscCall(PetscViewerBinaryOpen(c->comm, file, FILE_MODE_WRITE, &viewer));
  PetscCall(ISView(c->is, viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_filter_file", file));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCSetFromOptions(pc));
  PetscCall(Compare(c, "file", &pc, 1e-11));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_filter_file"));
  /* the diagonal of K is 8, of the softest stiff row 8 + 0.25 1e3 */
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_detect", "10"));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCSetFromOptions(pc));
  PetscCall(PCSetUp(pc));
  PetscCall(PCAMGFGetFilterSize(pc, &n));
  PetscCall(ISGetSize(c->is, &expected));
  PetscCall(PetscPrintf(c->comm, "detection finds the stiff unknowns: %s\n", n == expected ? "ok" : "no"));
  PetscCall(Compare(c, "detection", &pc, 1e-11));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_detect"));
  PetscFunctionReturn(0);
}

/* Infinite and undefined diagonal entries count for nothing in the median; the solve ends, and says that it failed */
static PetscErrorCode CheckDetectionOfInfinity(Context *c, PetscScalar entry, const char what[])
{
  KSP                ksp;
  PC                 pc;
  Mat                A;
  Vec                x;
  PetscInt           start;
  KSPConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(MatDuplicate(c->A, MAT_COPY_VALUES, &A));
  PetscCall(MatGetOwnershipRange(A, &start, NULL));
  if (start == 0) PetscCall(MatSetValue(A, 0, 0, entry, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_detect", "10"));
  PetscCall(VecDuplicate(c->r, &x));
  PetscCall(ProblemCreateSolver(A, A, &ksp, &pc));
  PetscCall(PCSetFromOptions(pc));
  PetscCall(KSPSolve(ksp, c->r, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(PetscPrintf(c->comm, "detection with %s diagonal entry: %s\n", what, reason < 0 ? "failed" : "NOT FAILED"));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_detect"));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&x));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

/* Call before composed before file before detection */
static PetscErrorCode CheckPrecedence(Context *c)
{
  PC          pc;
  IS          one;
  PetscInt    n, first, last;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(c->comm, &rank));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, rank ? 0 : 1, 5, 1, &one));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, (PetscObject)one));
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_detect", "10"));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCSetFromOptions(pc));
  PetscCall(PCSetUp(pc));
  PetscCall(PCAMGFGetFilterSize(pc, &first));
  PetscCall(PCAMGFSetFilterIS(pc, c->is));
  PetscCall(PCSetUp(pc));
  PetscCall(PCAMGFGetFilterSize(pc, &last));
  PetscCall(ISGetSize(c->is, &n));
  PetscCall(PetscPrintf(c->comm, "composed before detection: %s\n", first == 1 ? "ok" : "no"));
  PetscCall(PetscPrintf(c->comm, "call before composed: %s\n", last == n ? "ok" : "no"));
  PetscCall(Compare(c, "subspace changed after the set-up", &pc, 1e-11));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_detect"));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, NULL));
  PetscCall(ISDestroy(&one));
  PetscFunctionReturn(0);
}

/* PETSc sets up only once for an operator that stays: what is composed later, or is no longer, is seen at the next
   application */
static PetscErrorCode CheckComposedLater(Context *c)
{
  PC       pc;
  Vec      z;
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(c->z, &z));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCSetUp(pc));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, (PetscObject)c->is));
  PetscCall(Compare(c, "composed after the set-up", &pc, 1e-11));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCApply(pc, c->r, z));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, NULL));
  PetscCall(PCApply(pc, c->r, z));
  PetscCall(PCAMGFGetFilterSize(pc, &n));
  PetscCall(PetscPrintf(c->comm, "taken away after the set-up: %s\n", n == 0 ? "ok" : "no"));
  PetscCall(PCDestroy(&pc));
  PetscCall(VecDestroy(&z));
  PetscFunctionReturn(0);
}

/* Lines of warning from two set-ups, printed by the first rank */
static PetscErrorCode CountWarnings(Context *c, const char name[], PC pc)
{
  FILE *const stream = PETSC_STDERR;
  int         lines  = 0, byte;

  PetscFunctionBeginUser;
  PETSC_STDERR = tmpfile();
  PetscCall(PCSetFromOptions(pc));
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(PCSetUp(pc));
    PetscCall(PetscObjectStateIncrease((PetscObject)c->A));
  }
  rewind(PETSC_STDERR);
  while ((byte = fgetc(PETSC_STDERR)) != EOF) lines += (byte == '\n');
  fclose(PETSC_STDERR);
  PETSC_STDERR = stream;
  PetscCall(PetscPrintf(c->comm, "warnings, %s: %d\n", name, lines));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckWarnings(Context *c)
{
  PC pc;
  IS none;

  PetscFunctionBeginUser;
  PetscCall(ISCreateStride(PETSC_COMM_SELF, 0, 0, 1, &none));
  for (PetscInt i = 0; i < 5; i++) {
    static const char *const names[] = {"no filter", "no filter, which is optional", "switched off",
      "an empty one named", "nothing detected"};

    PetscCall(NewPC(c, c->A, &pc));
    if (i == 1) PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
    if (i == 2) PetscCall(PCAMGFSetFilterActive(pc, PETSC_FALSE));
    if (i == 3) PetscCall(PCAMGFSetFilterIS(pc, none));
    if (i == 4) PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_detect", "1e30"));
    PetscCall(CountWarnings(c, names[i], pc));
    PetscCall(PCDestroy(&pc));
  }
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_detect"));
  PetscCall(ISDestroy(&none));
  PetscFunctionReturn(0);
}

/* Solves with the default AMG: BoomerAMG breaks ties in the order in which a format keeps a row, so its result is the
   same in quality only */
static PetscErrorCode SolveWith(Context *c, Mat A)
{
  KSP                ksp;
  PC                 pc;
  Vec                x;
  KSPConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(c->r, &x));
  PetscCall(ProblemCreateSolver(A, A, &ksp, &pc));
  PetscCall(KSPSetTolerances(ksp, 1e-8, PETSC_DEFAULT, PETSC_DEFAULT, 20));
  PetscCall(KSPSolve(ksp, c->r, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(PetscPrintf(c->comm, "  BoomerAMG: %s\n", reason > 0 ? "ok" : KSPConvergedReasons[reason]));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

static PetscErrorCode NewPCWithJacobi(Context *c, Mat A, PC *pc)
{
  PC amg;

  PetscFunctionBeginUser;
  PetscCall(NewPC(c, A, pc));
  PetscCall(PCAMGFGetAMGPC(*pc, &amg));
  PetscCall(PCSetType(amg, PCJACOBI));
  PetscFunctionReturn(0);
}

/* Other storage of the same operator; the object is composed, as a program without our header would */
static PetscErrorCode CheckFormats(Context *c)
{
  const MatType types[] = {MATAIJ, MATBAIJ, MATSBAIJ};
  PC            pc;
  Vec           boomeramg;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(c->z, &boomeramg));
  PetscCall(VecCopy(c->z, boomeramg));
  PetscCall(NewPCWithJacobi(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterIS(pc, c->is));
  PetscCall(PCApply(pc, c->r, c->z));
  PetscCall(PCDestroy(&pc));
  for (PetscInt t = 0; t < 3; t++) {
    Mat A, P;

    PetscCall(ProblemCreate(c->comm, &c->problem, types[t], PETSC_TRUE, &A));
    PetscCall(PetscObjectCompose((PetscObject)A, PCAMGF_FILTER_KEY, (PetscObject)c->is));
    PetscCall(NewPCWithJacobi(c, A, &pc));
    PetscCall(Compare(c, types[t], &pc, 1e-11));
    PetscCall(SolveWith(c, A));
    PetscCall(ProblemCreateInterpolation(A, c->is, 0.0, &P));
    PetscCall(PetscObjectCompose((PetscObject)A, PCAMGF_FILTER_KEY, (PetscObject)P));
    PetscCall(NewPCWithJacobi(c, A, &pc));
    PetscCall(Compare(c, "  with an interpolation", &pc, 1e-9));
    PetscCall(MatDestroy(&P));
    PetscCall(MatDestroy(&A));
  }
  PetscCall(VecCopy(boomeramg, c->z));
  PetscCall(VecDestroy(&boomeramg));
  PetscFunctionReturn(0);
}

/* Every unknown: the exact inverse. None: the AMG alone. */
static PetscErrorCode CheckExtremes(Context *c)
{
  IS        all, none;
  PC        pc, amg;
  Vec       z, y;
  PetscInt  start, end;
  PetscReal difference;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(c->A, &start, &end));
  PetscCall(ISCreateStride(c->comm, end - start, start, 1, &all));
  PetscCall(ISCreateStride(c->comm, 0, 0, 1, &none));
  PetscCall(VecDuplicate(c->r, &z));
  PetscCall(VecDuplicate(c->r, &y));
  for (PCAMGFCycle cycle = PC_AMGF_BFB; cycle <= PC_AMGF_FBF; cycle++) {
    PetscCall(NewPC(c, c->A, &pc));
    PetscCall(PCAMGFSetCycle(pc, cycle));
    PetscCall(PCAMGFSetFilterIS(pc, all));
    PetscCall(PCApply(pc, c->r, z));
    PetscCall(MatMult(c->A, z, y));
    PetscCall(RelativeDifference(y, c->r, &difference));
    PetscCall(ReportBound(c->comm, "every unknown: exact inverse", difference, 1e-9));
    PetscCall(PCAMGFSetFilterIS(pc, none));
    PetscCall(PCApply(pc, c->r, z));
    PetscCall(PCAMGFGetAMGPC(pc, &amg));
    PetscCall(PCApply(amg, c->r, y));
    PetscCall(RelativeDifference(z, y, &difference));
    PetscCall(ReportBound(c->comm, "no unknown: the AMG alone", difference, 0.0));
    PetscCall(PCDestroy(&pc));
  }
  PetscCall(VecDestroy(&z));
  PetscCall(VecDestroy(&y));
  PetscCall(ISDestroy(&all));
  PetscCall(ISDestroy(&none));
  PetscFunctionReturn(0);
}

static PetscErrorCode ExpectError(Context *c, const char what[], PC *pc, PetscErrorCode expected)
{
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  ierr = PCSetUp(*pc);
  PetscCall(PetscPopErrorHandler());
  if (ierr == expected) PetscCall(PetscPrintf(c->comm, "%s: refused\n", what));
  else PetscCall(PetscPrintf(c->comm, "%s: error %d instead of %d\n", what, (int)ierr, (int)expected));
  PetscCall(PCDestroy(pc));
  PetscFunctionReturn(0);
}

/* An error seen by one rank must end all of them */
static PetscErrorCode CheckErrors(Context *c)
{
  const PetscInt bad[] = {-1, c->problem.n * c->problem.n * c->problem.bs};
  PetscMPIInt    rank, size;
  PC             pc;
  IS             is;
  Mat            P, B;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(c->comm, &rank));
  PetscCallMPI(MPI_Comm_size(c->comm, &size));
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(ISCreateGeneral(c->comm, rank == size - 1 ? 1 : 0, &bad[i], PETSC_COPY_VALUES, &is));
    PetscCall(NewPC(c, c->A, &pc));
    PetscCall(PCAMGFSetFilterIS(pc, is));
    PetscCall(ExpectError(c, i ? "row beyond the last" : "negative row", &pc, PETSC_ERR_ARG_OUTOFRANGE));
    PetscCall(ISDestroy(&is));
  }
  PetscCall(MatCreateAIJ(c->comm, rank + 2, PETSC_DECIDE, PETSC_DETERMINE, 3, 1, NULL, 1, NULL, &P));
  PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCAMGFSetFilterInterpolation(pc, P));
  PetscCall(ExpectError(c, "interpolation of another size", &pc, PETSC_ERR_ARG_SIZ));
  PetscCall(NewPC(c, P, &pc));
  PetscCall(ExpectError(c, "operator not square", &pc, PETSC_ERR_ARG_SIZ));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, (PetscObject)c->r));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(ExpectError(c, "Vec composed as filter", &pc, PETSC_ERR_ARG_WRONG));
  PetscCall(PetscObjectCompose((PetscObject)c->A, PCAMGF_FILTER_KEY, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_filter_file", "no/such/file"));
  PetscCall(NewPC(c, c->A, &pc));
  PetscCall(PCSetFromOptions(pc));
  PetscCall(ExpectError(c, "no such file", &pc, PETSC_ERR_FILE_OPEN));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_filter_file"));
  PetscCall(MatCreateShell(c->comm, 4, 4, PETSC_DETERMINE, PETSC_DETERMINE, NULL, &B));
  PetscCall(MatSetUp(B));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, 1, 0, 1, &is));
  PetscCall(NewPC(c, B, &pc));
  PetscCall(PCAMGFSetFilterIS(pc, is));
  PetscCall(ExpectError(c, "operator without rows to read", &pc, PETSC_ERR_SUP));
  PetscCall(ISDestroy(&is));
  PetscCall(MatDestroy(&B));
  PetscCall(MatDestroy(&P));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Context c;
  PC      pc;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  c.comm = PETSC_COMM_WORLD;
  PetscCall(ProblemSetDefaults(&c.problem));
  c.problem.lowest = 3.0;
  PetscCall(ProblemCreate(c.comm, &c.problem, MATAIJ, PETSC_TRUE, &c.A));
  PetscCall(ProblemCreateFilterIS(&c.problem, c.A, c.comm, &c.is));
  PetscCall(MatCreateVecs(c.A, &c.r, &c.z));
  PetscCall(FillVector(c.r, 1.5));
  PetscCall(NewPC(&c, c.A, &pc));
  PetscCall(PCAMGFSetFilterIS(pc, c.is));
  PetscCall(PCApply(pc, c.r, c.z));
  PetscCall(PCDestroy(&pc));
  PetscCall(SetByCall(&c));
  PetscCall(SetByInterpolation(&c));
  PetscCall(SetByOptions(&c));
  PetscCall(CheckDetectionOfInfinity(&c, INFINITY, "an infinite"));
  PetscCall(CheckDetectionOfInfinity(&c, NAN, "an undefined"));
  PetscCall(CheckPrecedence(&c));
  PetscCall(CheckComposedLater(&c));
  PetscCall(CheckWarnings(&c));
  PetscCall(CheckFormats(&c));
  PetscCall(CheckExtremes(&c));
  PetscCall(CheckErrors(&c));
  PetscCall(VecDestroy(&c.r));
  PetscCall(VecDestroy(&c.z));
  PetscCall(ISDestroy(&c.is));
  PetscCall(MatDestroy(&c.A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3 5}}

TEST*/
