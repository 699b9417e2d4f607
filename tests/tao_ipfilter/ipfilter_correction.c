static char help[] = "Second-order correction: Maratos's problem, where full Newton steps violate the constraint and "
                     "raise the objective.\n\n";

#include "ipfilter_problem.h"

/* min 2 (|x|^2 - 1) - x_0 subject to |x|^2 - 1 = 0, or >= 0: the minimum is (1, 0), from a point of the circle that
   is not near. The unknowns lie on rank 0. */
typedef struct {
  PetscBool equality;
  PetscInt  evaluations;
} Circle;

/* Both entries on all ranks */
static PetscErrorCode GetPoint(Vec x, PetscReal p[2])
{
  const PetscScalar *a;
  PetscInt           n;
  PetscReal          local[2] = {0.0, 0.0};

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(x, &a));
  for (PetscInt i = 0; i < n; i++) local[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(x, &a));
  PetscCallMPI(MPI_Allreduce(local, p, 2, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode Objective(Tao tao, Vec x, PetscReal *f, void *user)
{
  PetscReal p[2];

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(GetPoint(x, p));
  *f = 2.0 * (PetscSqr(p[0]) + PetscSqr(p[1]) - 1.0) - p[0];
  ((Circle *)user)->evaluations++;
  PetscFunctionReturn(0);
}

static PetscErrorCode Gradient(Tao tao, Vec x, Vec g, void *user)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  (void)user;
  PetscCall(VecCopy(x, g));
  PetscCall(VecScale(g, 4.0));
  PetscCall(VecGetOwnershipRange(g, &lo, &hi));
  if (lo == 0 && hi > 0) PetscCall(VecSetValue(g, 0, -1.0, ADD_VALUES));
  PetscCall(VecAssemblyBegin(g));
  PetscCall(VecAssemblyEnd(g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Constraint(Tao tao, Vec x, Vec c, void *user)
{
  PetscReal p[2];

  PetscFunctionBeginUser;
  (void)tao;
  (void)user;
  PetscCall(GetPoint(x, p));
  PetscCall(VecSet(c, PetscSqr(p[0]) + PetscSqr(p[1]) - 1.0));
  PetscFunctionReturn(0);
}

static PetscErrorCode Jacobian(Tao tao, Vec x, Mat J, Mat Jpre, void *user)
{
  PetscReal p[2];
  PetscInt  lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  (void)Jpre;
  (void)user;
  PetscCall(GetPoint(x, p));
  PetscCall(MatGetOwnershipRange(J, &lo, &hi));
  for (PetscInt j = 0; j < 2 && lo == 0 && hi > 0; j++) PetscCall(MatSetValue(J, 0, j, 2.0 * p[j], INSERT_VALUES));
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* (4 + 2 DE) I or (4 - 2 DI) I */
static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat Hpre, void *user)
{
  Circle     *circle = (Circle *)user;
  Vec         DE, DI;
  PetscScalar y;
  PetscInt    lo, hi;

  PetscFunctionBeginUser;
  (void)x;
  (void)Hpre;
  PetscCall(TaoGetDualVariables(tao, &DE, &DI));
  PetscCall(VecSum(circle->equality ? DE : DI, &y));
  PetscCall(MatGetOwnershipRange(H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++)
    PetscCall(MatSetValue(H, i, i, circle->equality ? 4.0 + 2.0 * y : 4.0 - 2.0 * y, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(PetscBool equality, PetscReal angle, const char corrections[], PetscInt *newton,
  PetscInt *evaluations)
{
  Circle             circle = {equality, 0};
  PetscMPIInt        rank;
  Vec                x, c;
  Mat                H, J;
  Tao                tao;
  PetscReal          p[2];
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_max_soc", corrections));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, rank ? 0 : 2, 2, &x));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, rank ? 0 : 1, 1, &c));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, rank ? 0 : 2, rank ? 0 : 2, 2, 2, 1, NULL, 0, NULL, &H));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, rank ? 0 : 1, rank ? 0 : 2, 1, 2, 2, NULL, 0, NULL, &J));
  if (!rank) {
    PetscCall(VecSetValue(x, 0, PetscCosReal(angle), INSERT_VALUES));
    PetscCall(VecSetValue(x, 1, PetscSinReal(angle), INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(x));
  PetscCall(VecAssemblyEnd(x));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetObjective(tao, Objective, &circle));
  PetscCall(TaoSetGradient(tao, NULL, Gradient, &circle));
  PetscCall(TaoSetHessian(tao, H, H, Hessian, &circle));
  if (equality) {
    PetscCall(TaoSetEqualityConstraintsRoutine(tao, c, Constraint, &circle));
    PetscCall(TaoSetJacobianEqualityRoutine(tao, J, J, Jacobian, &circle));
  } else {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, c, Constraint, &circle));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, J, J, Jacobian, &circle));
  }
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(TaoGetIterationNumber(tao, newton));
  PetscCall(GetPoint(x, p));
  if (reason < 0 || PetscAbsReal(p[0] - 1.0) > 1e-6 || PetscAbsReal(p[1]) > 1e-4)
    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "%s at (%g, %g)\n", TaoConvergedReasons[reason], (double)p[0], (double)p[1]));
  *evaluations = circle.evaluations;
  PetscCall(TaoDestroy(&tao));
  PetscCall(MatDestroy(&H));
  PetscCall(MatDestroy(&J));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscReal angle = 0.8;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-angle", &angle, NULL));
  for (PetscInt k = 0; k < 2; k++) {
    const PetscBool equality  = (PetscBool)(k == 0);
    PetscInt        newton[2] = {0, 0}, evaluations[2] = {0, 0};

    PetscCall(Solve(equality, angle, "0", &newton[0], &evaluations[0]));
    PetscCall(Solve(equality, angle, "4", &newton[1], &evaluations[1]));
    if (newton[1] < newton[0] && evaluations[1] <= evaluations[0] + newton[1])
      PetscCall(
        PetscPrintf(PETSC_COMM_WORLD, "%s: with correction fewer steps\n", equality ? "equality" : "inequality"));
    else
      PetscCall(PetscPrintf(PETSC_COMM_WORLD,
        "%s: %" PetscInt_FMT " steps, %" PetscInt_FMT " evaluations without correction, %" PetscInt_FMT
        " and %" PetscInt_FMT " with it\n",
        equality ? "equality" : "inequality", newton[0], evaluations[0], newton[1], evaluations[1]));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2}}
      args: -tao_ipfilter_pc_type jacobi
      args: -tao_ipfilter_start cold -tao_ipfilter_slack_init 1e-4 -tao_ipfilter_dual_init 1.5 -tao_ipfilter_mu_init 1.5e-4

TEST*/
