/*
   A membrane pressed against a wall by a penalty of 1e6 wherever it goes beyond: SNES, whose Jacobian has stiff rows
   that come and go.

   Each Jacobian composes its own filter; PCAMGF takes up what it finds there.

      wall_snes -dll_append PREFIX/lib/libpetscamgf.so -pc_type amgf

   Output:
      converged: TRUE
      at most 15 linear iterations per Newton step: TRUE
      beyond the wall by at most 1e-6: TRUE
*/
#include <petscsnes.h>
#include <petscdmda.h>

#define WALL    0.02
#define PENALTY 1e6

static PetscErrorCode FormFunction(DMDALocalInfo *info, PetscScalar **u, PetscScalar **F, void *ctx)
{
  PetscFunctionBeginUser;
  (void)ctx;
  for (PetscInt j = info->ys; j < info->ys + info->ym; j++) {
    for (PetscInt i = info->xs; i < info->xs + info->xm; i++) {
      F[j][i] = 4.0 * u[j][i] - 1.0 / (info->mx * info->my) + PENALTY * PetscMax(PetscRealPart(u[j][i]) - WALL, 0.0);
      if (i > 0) F[j][i] -= u[j][i - 1];
      if (i < info->mx - 1) F[j][i] -= u[j][i + 1];
      if (j > 0) F[j][i] -= u[j - 1][i];
      if (j < info->my - 1) F[j][i] -= u[j + 1][i];
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ComposeFilter(Mat J, Vec stiff)
{
  IS                 filter;
  PetscInt           start, n, k = 0, *rows;
  const PetscScalar *s;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(stiff, &start, NULL));
  PetscCall(VecGetLocalSize(stiff, &n));
  PetscCall(PetscMalloc1(n, &rows));
  PetscCall(VecGetArrayRead(stiff, &s));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(s[i]) > WALL) rows[k++] = start + i;
  }
  PetscCall(VecRestoreArrayRead(stiff, &s));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)J), k, rows, PETSC_OWN_POINTER, &filter));
  PetscCall(PetscObjectCompose((PetscObject)J, "amgf_filter", (PetscObject)filter));
  PetscCall(ISDestroy(&filter));
  PetscFunctionReturn(0);
}

static PetscErrorCode FormJacobian(SNES snes, Vec u, Mat J, Mat P, void *ctx)
{
  DM            da;
  DMDALocalInfo info;
  PetscScalar **x;

  PetscFunctionBeginUser;
  (void)ctx;
  PetscCall(SNESGetDM(snes, &da));
  PetscCall(DMDAGetLocalInfo(da, &info));
  PetscCall(DMDAVecGetArrayRead(da, u, &x));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const MatStencil  row      = {.i = i, .j = j};
      const PetscScalar diagonal = 4.0 + (PetscRealPart(x[j][i]) > WALL ? PENALTY : 0.0);

      PetscCall(MatSetValuesStencil(P, 1, &row, 1, &row, &diagonal, INSERT_VALUES));
      for (PetscInt k = 0; k < 4; k++) {
        const MatStencil col = {.i = i + (k == 0) - (k == 1), .j = j + (k == 2) - (k == 3)};

        if (col.i >= 0 && col.i < info.mx && col.j >= 0 && col.j < info.my)
          PetscCall(MatSetValuesStencil(P, 1, &row, 1, &col, &(PetscScalar){-1.0}, INSERT_VALUES));
      }
    }
  }
  PetscCall(DMDAVecRestoreArrayRead(da, u, &x));
  PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
  PetscCall(ComposeFilter(P, u));
  if (J != P) {
    PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM                  da;
  SNES                snes;
  SNESLineSearch      search;
  Vec                 u;
  Mat                 J;
  PetscInt            newton, linear;
  PetscReal           largest;
  SNESConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, 48, 48, PETSC_DECIDE,
    PETSC_DECIDE, 1, 1, NULL, NULL, &da));
  PetscCall(DMSetUp(da));
  PetscCall(DMDASNESSetFunctionLocal(da, INSERT_VALUES,
    (PetscErrorCode(*)(DMDALocalInfo *, void *, void *, void *))FormFunction, NULL));
  PetscCall(DMCreateMatrix(da, &J));
  PetscCall(DMCreateGlobalVector(da, &u));
  PetscCall(SNESCreate(PETSC_COMM_WORLD, &snes));
  PetscCall(SNESSetDM(snes, da));
  PetscCall(SNESSetJacobian(snes, J, J, FormJacobian, NULL));
  PetscCall(SNESSetTolerances(snes, 1e-9, 0.0, 0.0, 50, PETSC_DEFAULT));
  PetscCall(SNESGetLineSearch(snes, &search));
  /* a primal-dual active set method: full steps. The type was called "basic" before PETSc 3.26 */
  PetscCall(SNESLineSearchSetType(search, PETSC_VERSION_LT(3, 26, 0) ? "basic" : "none"));
  PetscCall(SNESSetDivergenceTolerance(snes, PETSC_MAX_REAL)); /* whatever the first of them leaves */
  PetscCall(SNESSetFromOptions(snes));
  PetscCall(SNESSolve(snes, NULL, u));
  PetscCall(SNESGetConvergedReason(snes, &reason));
  PetscCall(SNESGetIterationNumber(snes, &newton));
  PetscCall(SNESGetLinearSolveIterations(snes, &linear));
  PetscCall(VecMax(u, NULL, &largest));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "converged: %s\nat most 15 linear iterations per Newton step: %s\n",
    PetscBools[reason > 0], PetscBools[newton > 0 && linear <= 15 * newton]));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "beyond the wall by at most 1e-6: %s\n",
    PetscBools[largest > WALL && largest <= WALL + 1e-6]));
  PetscCall(SNESDestroy(&snes));
  PetscCall(MatDestroy(&J));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&da));
  PetscCall(PetscFinalize());
  return 0;
}
