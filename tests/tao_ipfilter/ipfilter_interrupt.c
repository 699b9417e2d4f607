static char help[] =
  "TaoIPFilterSetInterrupt(): a point on a plane with friction. A function that never interrupts changes nothing; one\n\
that does ends the reduced problem at once, and the solve without a solution.\n\n";

#include "ipfilter_problem.h"

typedef struct {
  PetscInt  ncalls;
  PetscBool stop;
} User;

static PetscErrorCode Interrupt(void *ctx, PetscBool *stop)
{
  User *user = (User *)ctx;

  PetscFunctionBeginUser;
  ++user->ncalls;
  *stop = user->stop;
  PetscFunctionReturn(0);
}

/* A test that ends a solve whose user wants that */
static PetscErrorCode Test(Tao tao, void *ctx)
{
  PetscFunctionBeginUser;
  PetscCall(TaoIPFilterDefaultConvergenceTest(tao, NULL));
  if (((User *)ctx)->stop && ((User *)ctx)->ncalls) PetscCall(TaoSetConvergedReason(tao, TAO_DIVERGED_USER));
  PetscFunctionReturn(0);
}

/* A matrix with a row for each of n of the three unknowns; all rows are on the first rank */
static PetscErrorCode CreateRows(PetscInt n, const PetscInt columns[], Mat *A)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, rank ? 0 : n, rank ? 0 : 3, n, 3, 1, NULL, 1, NULL, A));
  for (PetscInt r = 0; r < n && !rank; ++r) PetscCall(MatSetValue(*A, r, columns[r], 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Create(QuadraticProgram *q, Mat *T, Vec *x)
{
  const PetscInt all[3] = {0, 1, 2}, normal[1] = {2}, tangents[2] = {0, 1};

  PetscFunctionBeginUser;
  PetscCall(CreateRows(3, all, &q->H));
  PetscCall(CreateRows(1, normal, &q->J));
  PetscCall(CreateRows(2, tangents, T));
  PetscCall(MatCreateVecs(q->H, x, &q->b));
  PetscCall(VecSet(*x, 0.0));
  PetscCall(VecSet(q->b, 1.0));
  PetscCall(VecSetValue(q->b, 2, -2.0, INSERT_VALUES)); /* each rank sets the same value */
  PetscCall(VecAssemblyBegin(q->b));
  PetscCall(VecAssemblyEnd(q->b));
  PetscCall(MatCreateVecs(q->J, NULL, &q->g));
  PetscCall(VecSet(q->g, 0.0));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(QuadraticProgram *q, Mat T, Vec x, PetscBool stop)
{
  User               user = {.stop = stop};
  const PetscInt     few  = 20;
  const char        *often;
  TaoConvergedReason reason;
  Vec                t, limit, coefficient;
  Tao                tao;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(T, NULL, &t));
  PetscCall(VecSet(t, 0.0));
  PetscCall(VecDuplicate(q->g, &limit));
  PetscCall(VecSet(limit, PETSC_INFINITY));
  PetscCall(VecDuplicate(q->g, &coefficient));
  PetscCall(VecSet(coefficient, 0.3));
  PetscCall(VecSet(x, 0.0));
  PetscCall(ProblemCreateSolver(q, x, &tao));
  PetscCall(TaoIPFilterSetNormTerms(tao, T, t, limit, coefficient));
  PetscCall(TaoIPFilterSetInterrupt(tao, Interrupt, &user));
  PetscCall(TaoSetConvergenceTest(tao, Test, &user));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCallMPI(MPI_Bcast(&user.ncalls, 1, MPIU_INT, 0, PETSC_COMM_WORLD));
  often = user.ncalls == 0 ? "NEVER" : user.ncalls <= few ? "a few times" : stop ? "MANY TIMES" : "many times";
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: the function is called %s, and the solve %s\n",
    stop ? "interrupted" : "not interrupted", often, reason > 0 ? "converges" : "ends without a solution"));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&t));
  PetscCall(VecDestroy(&limit));
  PetscCall(VecDestroy(&coefficient));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  QuadraticProgram q;
  Mat              T;
  Vec              x;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(Create(&q, &T, &x));
  PetscCall(Run(&q, T, x, PETSC_FALSE));
  PetscCall(Run(&q, T, x, PETSC_TRUE));
  PetscCall(MatDestroy(&T));
  PetscCall(VecDestroy(&x));
  PetscCall(ProblemDestroy(&q));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2}}
      args: -tao_ipfilter_subspace true

TEST*/
