static char help[] =
  "A membrane over the ground, by bounds: the error of its energy does not grow with their number.\n\n";

#include "ipfilter_problem.h"

/* min 1/2 u^T K u - b^T u, u >= 0 on n x n points of the unit square, with K the five point difference and b the load
   sin(3 pi x) h^2, which presses the middle third down: the energy is of one size whatever the number of points, that
   of one bound is not */
typedef struct {
  Mat K;
  Vec b;
} Membrane;

static PetscErrorCode ObjectiveAndGradient(Tao tao, Vec u, PetscReal *f, Vec g, void *user)
{
  const Membrane *membrane = (const Membrane *)user;
  PetscScalar     uKu, bu;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(membrane->K, u, g));
  PetscCall(VecDot(g, u, &uKu));
  PetscCall(VecDot(membrane->b, u, &bu));
  PetscCall(VecAXPY(g, -1.0, membrane->b));
  *f = 0.5 * PetscRealPart(uKu) - PetscRealPart(bu);
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateMembrane(PetscInt n, Membrane *membrane)
{
  const PetscReal h = 1.0 / (n + 1);
  PetscInt        lo, hi;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, n * n, n * n, 5, NULL, 4, NULL, &membrane->K));
  PetscCall(MatCreateVecs(membrane->K, &membrane->b, NULL));
  PetscCall(MatGetOwnershipRange(membrane->K, &lo, &hi));
  for (PetscInt k = lo; k < hi; k++) {
    const PetscInt i = k % n, j = k / n,
                   column[5] = {k, i ? k - 1 : -1, i + 1 < n ? k + 1 : -1, j ? k - n : -1,
                     j + 1 < n ? k + n : -1}; /* negative ones are ignored */
    PetscScalar entry[5]     = {4.0, -1.0, -1.0, -1.0, -1.0};

    PetscCall(MatSetValues(membrane->K, 1, &k, 5, column, entry, INSERT_VALUES));
    PetscCall(VecSetValue(membrane->b, k, h * h * PetscSinReal(3.0 * PETSC_PI * (i + 1) * h), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(membrane->K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(membrane->K, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(membrane->b));
  PetscCall(VecAssemblyEnd(membrane->b));
  PetscFunctionReturn(0);
}

/* The energy at the solution to a tolerance */
static PetscErrorCode SolveMembrane(Membrane *membrane, PetscReal tol, PetscReal *f)
{
  TaoConvergedReason reason;
  Vec                u, lower, upper;
  Tao                tao;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(membrane->b, &u));
  PetscCall(VecDuplicate(membrane->b, &lower));
  PetscCall(VecDuplicate(membrane->b, &upper));
  PetscCall(VecSet(u, 0.0));
  PetscCall(VecSet(lower, 0.0));
  PetscCall(VecSet(upper, 1000.0)); /* far from any u */
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, u));
  PetscCall(TaoSetVariableBounds(tao, lower, upper));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ObjectiveAndGradient, membrane));
  PetscCall(TaoSetHessian(tao, membrane->K, membrane->K, ProblemConstant, NULL));
  PetscCall(TaoSetFromOptions(tao));
  if (tol > 0.0) PetscCall(TaoSetTolerances(tao, tol, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, f, NULL, NULL, NULL, &reason));
  if (reason != TAO_CONVERGED_GATOL)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  tolerance %g: %s\n", (double)tol, TaoConvergedReasons[reason]));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const PetscInt n[] = {10, 30, 90};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(n); k++) {
    PetscReal f = 0.0, exact = 0.0;
    Membrane  membrane;

    PetscCall(CreateMembrane(n[k], &membrane));
    PetscCall(SolveMembrane(&membrane, 0.0, &f));
    PetscCall(SolveMembrane(&membrane, 1e-11, &exact));
    if (PetscAbsReal(f - exact) <= 1e-6 * PetscAbsReal(exact))
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " bounds: the energy is right to 1e-6\n", n[k] * n[k]));
    else
      PetscCall(
        PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " bounds: the energy %.9e differs from %.9e by %.1e of it\n",
          n[k] * n[k], (double)f, (double)exact, (double)PetscAbsReal(f / exact - 1.0)));
    PetscCall(MatDestroy(&membrane.K));
    PetscCall(VecDestroy(&membrane.b));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      args: -tao_ipfilter_pc_type lu -tao_ipfilter_pc_factor_mat_solver_type mumps

TEST*/
