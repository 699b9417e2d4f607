static char help[] = "What TAOIPFILTER does once: MUMPS's analysis of a pattern, the conversion of a Jacobian.\n\n";

#include "ipfilter_matrices.h"

static PetscInt nproducts; /* with the Jacobian */

/* How often MUMPS has analysed a matrix, and how often it has factored one */
static PetscErrorCode GetCounts(int count[2])
{
  const char *const  names[2] = {"MatCholFctrSym", "MatCholFctrNum"};
  PetscLogEvent      event;
  PetscEventPerfInfo info;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(PetscLogEventGetId(names[k], &event));
    PetscCall(PetscLogEventGetPerfInfo(PETSC_DETERMINE, event, &info));
    count[k] = info.count;
  }
  PetscFunctionReturn(0);
}

/* A solve that factors the whole matrix at every step analyses it once */
static PetscErrorCode TestAnalyses(const char Htype[])
{
  Program            p;
  Mat                H;
  Vec                x;
  PetscErrorCode     error = 0;
  TaoConvergedReason reason;
  int                before[2], after[2];

  PetscFunctionBeginUser;
  PetscCall(CreateProgram(40, &p));
  PetscCall(VecDuplicate(p.q.b, &x));
  PetscCall(CreateAs(p.q.H, Htype, &H));
  PetscCall(GetCounts(before));
  PetscCall(Solve(&p, H, p.q.J, NULL, "-tao_ipfilter_direct", x, &error, &reason));
  PetscCall(AttemptCompareRanks("analyses", error));
  PetscCall(GetCounts(after));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "H %s by MUMPS: %d analysis, %s\n", Htype, after[0] - before[0],
    after[1] - before[1] > 3 ? "many factorizations" : "TOO FEW FACTORIZATIONS TO TELL"));
  PetscCall(VecDestroy(&x));
  PetscCall(MatDestroy(&H));
  PetscCall(DestroyProgram(&p));
  PetscFunctionReturn(0);
}

/* A product with a Jacobian, counted */
static PetscErrorCode CountProduct(Mat S, Vec x, Vec y)
{
  PetscFunctionBeginUser;
  nproducts++;
  PetscCall(ShellMult(S, x, y));
  PetscFunctionReturn(0);
}

static PetscErrorCode CountEvaluation(Tao tao, Vec x, Mat J, Mat P, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)x;
  (void)J;
  (void)P;
  ++*(PetscInt *)user;
  PetscFunctionReturn(0);
}

/* A Jacobian that gives products alone is read by as many as it has columns, once an evaluation, be it that a row of
   it is an equality constraint */
static PetscErrorCode TestConversions(PetscInt n)
{
  Program  p;
  Mat      J;
  Vec      x, lower, upper;
  Tao      tao;
  PetscInt lo, hi, nevaluations = 0;

  PetscFunctionBeginUser;
  PetscCall(CreateProgram(n, &p));
  PetscCall(VecDuplicate(p.q.b, &x));
  PetscCall(CreateShell(p.q.J, PETSC_FALSE, &J));
  PetscCall(MatShellSetOperation(J, MATOP_MULT, (AMGFOperation *)CountProduct));
  PetscCall(CreateTao(&p, p.q.H, J, NULL, "", x, &tao));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, J, J, CountEvaluation, &nevaluations));
  PetscCall(VecDuplicate(p.q.g, &lower));
  PetscCall(VecDuplicate(p.q.g, &upper));
  PetscCall(VecSet(upper, PETSC_INFINITY));
  PetscCall(VecGetOwnershipRange(upper, &lo, &hi));
  if (!lo && hi) PetscCall(VecSetValue(upper, 0, 0.0, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(upper));
  PetscCall(VecAssemblyEnd(upper));
  PetscCall(TaoSetInequalityBounds(tao, lower, upper));
  PetscCall(VecSet(x, 0.0));
  nproducts = 0;
  PetscCall(TaoSolve(tao));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "J shell, a row of equal bounds: %s\n",
    nproducts == n * nevaluations ? "one product a column and evaluation" : "NOT ONE PRODUCT A COLUMN AND EVALUATION"));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscCall(VecDestroy(&x));
  PetscCall(MatDestroy(&J));
  PetscCall(DestroyProgram(&p));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *const hessians[] = {MATAIJ, MATBAIJ, MATSBAIJ};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscLogDefaultBegin());
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(hessians); k++) PetscCall(TestAnalyses(hessians[k]));
  PetscCall(TestConversions(40));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}

TEST*/
