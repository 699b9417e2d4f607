/*
   A membrane that a load presses down onto a flat floor: TAO with TAOIPFILTER, bounds on the unknowns, no
   factorization of the whole matrix.

      minimize 1/2 u'K u - f'u   subject to   u >= floor

      obstacle_tao -dll_append PREFIX/lib/libpetscamgf.so -tao_type ipfilter

   Output:
      converged: TRUE
      below the floor by at most 1e-8: TRUE
      the middle lies on it: TRUE
      a corner does not: TRUE
*/
#include <petsctao.h>
#include <petscdmda.h>

#define FLOOR (-0.02)

typedef struct {
  Mat K;
  Vec f;
} Membrane;

static PetscErrorCode CreateMembrane(DM da, Membrane *membrane)
{
  DMDALocalInfo info;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(da, &info));
  PetscCall(DMCreateMatrix(da, &membrane->K));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const MatStencil row = {.i = i, .j = j};

      PetscCall(MatSetValuesStencil(membrane->K, 1, &row, 1, &row, &(PetscScalar){4.0}, INSERT_VALUES));
      for (PetscInt k = 0; k < 4; k++) {
        const MatStencil col = {.i = i + (k == 0) - (k == 1), .j = j + (k == 2) - (k == 3)};

        if (col.i >= 0 && col.i < info.mx && col.j >= 0 && col.j < info.my)
          PetscCall(MatSetValuesStencil(membrane->K, 1, &row, 1, &col, &(PetscScalar){-1.0}, INSERT_VALUES));
      }
    }
  }
  PetscCall(MatAssemblyBegin(membrane->K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(membrane->K, MAT_FINAL_ASSEMBLY));
  PetscCall(DMCreateGlobalVector(da, &membrane->f));
  PetscCall(VecSet(membrane->f, -1.0 / (info.mx * info.my)));
  PetscFunctionReturn(0);
}

static PetscErrorCode EvaluateEnergy(Tao tao, Vec u, PetscReal *energy, Vec gradient, void *ctx)
{
  const Membrane *membrane = (const Membrane *)ctx;
  PetscScalar     stored, work;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(membrane->K, u, gradient));
  PetscCall(VecDot(gradient, u, &stored));
  PetscCall(VecDot(membrane->f, u, &work));
  PetscCall(VecAXPY(gradient, -1.0, membrane->f));
  *energy = PetscRealPart(0.5 * stored - work);
  PetscFunctionReturn(0);
}

/* Constant: K is there already */
static PetscErrorCode EvaluateHessian(Tao tao, Vec u, Mat H, Mat P, void *ctx)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)u;
  (void)H;
  (void)P;
  (void)ctx;
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM                 da;
  Tao                tao;
  Membrane           membrane;
  Vec                u, lower, upper;
  PetscReal          smallest, largest;
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, 31, 31, PETSC_DECIDE,
    PETSC_DECIDE, 1, 1, NULL, NULL, &da));
  PetscCall(DMSetFromOptions(da));
  PetscCall(DMSetUp(da));
  PetscCall(CreateMembrane(da, &membrane));
  PetscCall(DMCreateGlobalVector(da, &u));
  PetscCall(VecDuplicate(u, &lower));
  PetscCall(VecDuplicate(u, &upper));
  PetscCall(VecSet(lower, FLOOR));
  PetscCall(VecSet(upper, PETSC_INFINITY));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, EvaluateEnergy, &membrane));
  PetscCall(TaoSetHessian(tao, membrane.K, membrane.K, EvaluateHessian, NULL));
  PetscCall(TaoSetVariableBounds(tao, lower, upper));
  PetscCall(TaoSetSolution(tao, u));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(VecMin(u, NULL, &smallest));
  PetscCall(VecMax(u, NULL, &largest));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "converged: %s\nbelow the floor by at most 1e-8: %s\n",
    PetscBools[reason > 0], PetscBools[smallest >= FLOOR - 1e-8]));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "the middle lies on it: %s\na corner does not: %s\n",
    PetscBools[smallest <= FLOOR + 1e-6], PetscBools[largest > 0.5 * FLOOR]));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscCall(VecDestroy(&membrane.f));
  PetscCall(MatDestroy(&membrane.K));
  PetscCall(DMDestroy(&da));
  PetscCall(PetscFinalize());
  return 0;
}
