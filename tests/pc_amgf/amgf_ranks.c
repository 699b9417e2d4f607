static char help[] = "PCAMGF: on however many ranks the filtered system is solved, the preconditioner is the same, and "
                     "so is what becomes of a failure.\n\n";

#include "amgf_problem.h"

typedef struct {
  MPI_Comm comm;
  Problem  problem;
  Mat      A;
  Vec      r, z, reference, adjoint;
} Context;

static PetscErrorCode NewPC(Context *c, PC *pc)
{
  IS is;

  PetscFunctionBeginUser;
  PetscCall(PCCreate(c->comm, pc));
  PetscCall(PCSetOperators(*pc, c->A, c->A));
  PetscCall(PCSetType(*pc, PCAMGF));
  PetscCall(ProblemCreateFilterIS(&c->problem, c->A, c->comm, &is));
  PetscCall(PCAMGFSetFilterIS(*pc, is));
  PetscCall(ISDestroy(&is));
  PetscCall(PCSetFromOptions(*pc));
  PetscFunctionReturn(0);
}

/* By the user's own choice of a solver, which has all ranks */
static PetscErrorCode SetReference(Context *c)
{
  PC pc;

  PetscFunctionBeginUser;
  PetscCall(
    PetscOptionsInsertString(NULL, "-amgf_filter_pc_type cholesky -amgf_filter_pc_factor_mat_solver_type mumps"));
  PetscCall(NewPC(c, &pc));
  PetscCall(PCApply(pc, c->r, c->reference));
  PetscCall(PCApplyTranspose(pc, c->r, c->adjoint));
  PetscCall(PCDestroy(&pc));
  PetscCall(PetscOptionsClearValue(NULL, "-amgf_filter_pc_type"));
  PetscCall(PetscOptionsClearValue(NULL, "-amgf_filter_pc_factor_mat_solver_type"));
  PetscFunctionReturn(0);
}

static PetscErrorCode Compare(Context *c, PC pc, const char what[])
{
  PetscReal difference, transposed;

  PetscFunctionBeginUser;
  PetscCall(PCApply(pc, c->r, c->z));
  PetscCall(RelativeDifference(c->z, c->reference, &difference));
  PetscCall(PCApplyTranspose(pc, c->r, c->z));
  PetscCall(RelativeDifference(c->z, c->adjoint, &transposed));
  PetscCall(ReportBound(c->comm, what, PetscMax(difference, transposed), 1e-9));
  PetscFunctionReturn(0);
}

/* Also with other values, and after a reset */
static PetscErrorCode CheckSame(Context *c)
{
  PC pc;

  PetscFunctionBeginUser;
  PetscCall(ProblemFill(&c->problem, PETSC_TRUE, c->A));
  PetscCall(SetReference(c));
  PetscCall(NewPC(c, &pc));
  PetscCall(Compare(c, pc, "as on all ranks"));
  PetscCall(MatScale(c->A, 3.0));
  PetscCall(SetReference(c));
  PetscCall(PCSetReusePreconditioner(pc, PETSC_FALSE));
  PetscCall(PCAMGFSetAMGLag(pc, 1));
  PetscCall(Compare(c, pc, "with other values"));
  PetscCall(PCReset(pc));
  PetscCall(PCSetOperators(pc, c->A, c->A));
  PetscCall(Compare(c, pc, "after a reset"));
  PetscCall(PCDestroy(&pc));
  PetscFunctionReturn(0);
}

/* Of a matrix with two negative eigenvalues on the filtered unknowns; and where no Cholesky factors tell */
static PetscErrorCode CheckPivots(Context *c)
{
  PetscInt        start, end, n, none;
  const PetscInt *idx;
  IS              is;
  PC              pc;

  PetscFunctionBeginUser;
  PetscCall(ProblemFill(&c->problem, PETSC_TRUE, c->A));
  PetscCall(ProblemCreateFilterIS(&c->problem, c->A, PETSC_COMM_SELF, &is));
  PetscCall(ISGetIndices(is, &idx));
  PetscCall(MatGetOwnershipRange(c->A, &start, &end));
  for (PetscInt k = 0; k < 2; k++) {
    if (idx[k] >= start && idx[k] < end) PetscCall(MatSetValue(c->A, idx[k], idx[k], -1e9, ADD_VALUES));
  }
  PetscCall(ISRestoreIndices(is, &idx));
  PetscCall(ISDestroy(&is));
  PetscCall(MatAssemblyBegin(c->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->A, MAT_FINAL_ASSEMBLY));
  PetscCall(NewPC(c, &pc));
  PetscCall(PCAMGFGetFilterPivots(pc, &none));
  PetscCall(PCSetUp(pc));
  PetscCall(PCAMGFGetFilterPivots(pc, &n));
  PetscCall(PetscPrintf(c->comm, "negative pivots: %" PetscInt_FMT ", before the set-up %" PetscInt_FMT "\n", n, none));
  PetscCall(PCDestroy(&pc));
  PetscFunctionReturn(0);
}

/* A filtered matrix that is singular: all ranks learn of it, and with an error all of them err */
static PetscErrorCode CheckFailure(Context *c)
{
  PetscErrorCode ierr;
  PCFailedReason reason;
  PetscInt       start;
  PC             pc, amg;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(c->A, &start, NULL));
  PetscCall(MatZeroEntries(c->A));
  PetscCall(MatShift(c->A, 1.0));
  if (!start) PetscCall(MatSetValue(c->A, 0, 0, 0.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(c->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->A, MAT_FINAL_ASSEMBLY));
  for (int fails = 0; fails < 2; fails++) {
    PetscCall(NewPC(c, &pc));
    PetscCall(PCAMGFGetAMGPC(pc, &amg));
    PetscCall(PCSetType(amg, PCNONE));
    PetscCall(PCSetErrorIfFailure(pc, fails ? PETSC_TRUE : PETSC_FALSE));
    PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
    ierr = PCSetUp(pc);
    PetscCall(PetscPopErrorHandler());
    PetscCall(PCGetFailedReason(pc, &reason));
    PetscCall(PetscPrintf(c->comm, "singular: %s\n", ierr ? "error" : reason ? "failed" : "not noticed"));
    PetscCall(PCDestroy(&pc));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *const factors[] = {NULL, "1", "2"}; /* on all ranks, and on half of them */
  Context           c;
  PC                pc;
  PetscBool         view = PETSC_FALSE;
  PetscMPIInt       size;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-view", &view, NULL));
  c.comm = PETSC_COMM_WORLD;
  PetscCall(ProblemSetDefaults(&c.problem));
  PetscCall(ProblemCreate(c.comm, &c.problem, MATAIJ, PETSC_TRUE, &c.A));
  PetscCall(MatCreateVecs(c.A, &c.r, &c.z));
  PetscCall(VecDuplicate(c.z, &c.reference));
  PetscCall(VecDuplicate(c.z, &c.adjoint));
  PetscCall(FillVector(c.r, 0.8));
  if (view) {
    PetscCall(NewPC(&c, &pc));
    PetscCall(PCApply(pc, c.r, c.z));
    PetscCall(PCView(pc, PETSC_VIEWER_STDOUT_WORLD));
    PetscCall(PCDestroy(&pc));
  }
  PetscCallMPI(MPI_Comm_size(c.comm, &size));
  for (size_t i = 0; !view && i < PETSC_STATIC_ARRAY_LENGTH(factors); i++) {
    if (factors[i] && size > 1)
      PetscCall(PetscOptionsSetValue(NULL, "-amgf_filter_pc_telescope_reduction_factor", factors[i]));
    PetscCall(CheckSame(&c));
    PetscCall(CheckPivots(&c));
    PetscCall(CheckFailure(&c));
  }
  PetscCall(VecDestroy(&c.r));
  PetscCall(VecDestroy(&c.z));
  PetscCall(VecDestroy(&c.reference));
  PetscCall(VecDestroy(&c.adjoint));
  PetscCall(MatDestroy(&c.A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 5 2 3}}

   test:
      suffix: view
      nsize: 3
      args: -view
      filter: grep -oE "type: telescope|parent_size.*|package used.*"

TEST*/
