static char help[] = "Obstacle problems on a grid: bounds on all unknowns, or the same as inequality rows.\n\
  -problem NAME    obstacle, torsion, bearing, signorini; all of them without it\n\
  -n N             unknowns in a row\n\
  -rows            the bounds as inequality rows\n\n";

#include <petscdmda.h>
#include "ipfilter_problem.h"
#include "ipfilter_grid.h"

typedef struct {
  DM               da;
  int              problem, n;
  QuadraticProgram q; /* J picks the bounded unknowns */
  Vec              lower, upper;
  PetscReal        constant;
} Grid;

static PetscReal Bound(double value)
{
  return value >= GRID_NONE ? PETSC_INFINITY : (value <= -GRID_NONE ? PETSC_NINFINITY : value);
}

/* K, b and the constant */
static PetscErrorCode AssembleQuadratic(Grid *grid)
{
  const PetscInt di[5] = {0, -1, 1, 0, 0}, dj[5] = {0, 0, 0, -1, 1};
  DMDALocalInfo  info;
  PetscScalar  **b;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(grid->da, &info));
  PetscCall(DMDAVecGetArray(grid->da, grid->q.b, &b));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const MatStencil row = {.i = i, .j = j};
      MatStencil       col[5];
      PetscScalar      values[5];
      double           v[5], load;
      PetscInt         nc = 0;

      GridStencil(grid->problem, grid->n, (int)i, (int)j, v, &load);
      GridBoundaryTerms(grid->problem, grid->n, (int)i, (int)j, v, &load, &grid->constant);
      b[j][i] = load;
      for (PetscInt k = 0; k < 5; k++) {
        if (i + di[k] < 0 || i + di[k] >= info.mx || j + dj[k] < 0 || j + dj[k] >= info.my) continue;
        col[nc]      = (MatStencil){.i = i + di[k], .j = j + dj[k]};
        values[nc++] = v[k];
      }
      PetscCall(MatSetValuesStencil(grid->q.H, 1, &row, nc, col, values, INSERT_VALUES));
    }
  }
  PetscCall(DMDAVecRestoreArray(grid->da, grid->q.b, &b));
  PetscCall(MatAssemblyBegin(grid->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(grid->q.H, MAT_FINAL_ASSEMBLY));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &grid->constant, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode FillGridBounds(Grid *grid)
{
  DMDALocalInfo info;
  PetscScalar **l, **u;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(grid->da, &info));
  PetscCall(DMDAVecGetArray(grid->da, grid->lower, &l));
  PetscCall(DMDAVecGetArray(grid->da, grid->upper, &u));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      double lower, upper;

      GridBounds(grid->problem, grid->n, (int)i, (int)j, &lower, &upper);
      l[j][i] = Bound(lower);
      u[j][i] = Bound(upper);
    }
  }
  PetscCall(DMDAVecRestoreArray(grid->da, grid->upper, &u));
  PetscCall(DMDAVecRestoreArray(grid->da, grid->lower, &l));
  PetscFunctionReturn(0);
}

static PetscErrorCode GridObjectiveAndGradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Grid *grid = (Grid *)user;

  PetscFunctionBeginUser;
  PetscCall(ProblemObjectiveAndGradient(tao, x, f, g, &grid->q));
  *f += grid->constant;
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateGrid(int problem, PetscInt n, Grid *grid)
{
  PetscFunctionBeginUser;
  *grid = (Grid){.problem = problem, .n = (int)n};
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, n, n, PETSC_DECIDE,
    PETSC_DECIDE, 1, 1, NULL, NULL, &grid->da));
  PetscCall(DMSetFromOptions(grid->da));
  PetscCall(DMSetUp(grid->da));
  PetscCall(DMCreateMatrix(grid->da, &grid->q.H));
  PetscCall(MatSetOption(grid->q.H, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(DMCreateGlobalVector(grid->da, &grid->q.b));
  PetscCall(VecDuplicate(grid->q.b, &grid->lower));
  PetscCall(VecDuplicate(grid->q.b, &grid->upper));
  PetscCall(FillGridBounds(grid));
  PetscCall(AssembleQuadratic(grid));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyGrid(Grid *grid)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&grid->q));
  PetscCall(VecDestroy(&grid->lower));
  PetscCall(VecDestroy(&grid->upper));
  PetscCall(DMDestroy(&grid->da));
  PetscFunctionReturn(0);
}

/* J picks the unknowns that have a bound; what it picks of the bounds bounds its rows */
static PetscErrorCode SetRows(Tao tao, Grid *grid)
{
  const PetscScalar *l, *u;
  PetscInt           lo, hi, rstart, count = 0, *bounded;
  Vec                c, rl, ru;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(grid->lower, &lo, &hi));
  PetscCall(PetscMalloc1(hi - lo, &bounded));
  PetscCall(VecGetArrayRead(grid->lower, &l));
  PetscCall(VecGetArrayRead(grid->upper, &u));
  for (PetscInt i = 0; i < hi - lo; i++)
    if (PetscRealPart(l[i]) > PETSC_NINFINITY || PetscRealPart(u[i]) < PETSC_INFINITY) bounded[count++] = i;
  PetscCall(
    MatCreateAIJ(PETSC_COMM_WORLD, count, hi - lo, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 0, NULL, &grid->q.J));
  PetscCall(MatCreateVecs(grid->q.J, NULL, &c));
  PetscCall(VecDuplicate(c, &rl));
  PetscCall(VecDuplicate(c, &ru));
  PetscCall(VecGetOwnershipRange(c, &rstart, NULL));
  for (PetscInt k = 0; k < count; k++) {
    PetscCall(MatSetValue(grid->q.J, rstart + k, lo + bounded[k], 1.0, INSERT_VALUES));
    PetscCall(VecSetValue(rl, rstart + k, l[bounded[k]], INSERT_VALUES));
    PetscCall(VecSetValue(ru, rstart + k, u[bounded[k]], INSERT_VALUES));
  }
  PetscCall(VecRestoreArrayRead(grid->upper, &u));
  PetscCall(VecRestoreArrayRead(grid->lower, &l));
  PetscCall(PetscFree(bounded));
  PetscCall(MatAssemblyBegin(grid->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(grid->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(rl));
  PetscCall(VecAssemblyEnd(rl));
  PetscCall(VecAssemblyBegin(ru));
  PetscCall(VecAssemblyEnd(ru));
  PetscCall(VecDuplicate(c, &grid->q.g));
  PetscCall(VecSet(grid->q.g, 0.0));
  PetscCall(TaoSetInequalityConstraintsRoutine(tao, c, ProblemConstraints, &grid->q));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, grid->q.J, grid->q.J, ProblemConstant, NULL));
  PetscCall(TaoSetInequalityBounds(tao, rl, ru));
  PetscCall(VecDestroy(&c));
  PetscCall(VecDestroy(&rl));
  PetscCall(VecDestroy(&ru));
  PetscFunctionReturn(0);
}

/* A solver of the given type, with hypre as preconditioner where it has one of its own to choose */
static PetscErrorCode CreateGridSolver(Grid *grid, const char type[], PetscBool rows, Vec x, Tao *tao)
{
  KSP ksp;
  PC  pc;

  PetscFunctionBeginUser;
  PetscCall(TaoCreate(PETSC_COMM_WORLD, tao));
  PetscCall(TaoSetType(*tao, type));
  PetscCall(TaoSetSolution(*tao, x));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, GridObjectiveAndGradient, grid));
  PetscCall(TaoSetHessian(*tao, grid->q.H, grid->q.H, ProblemConstant, NULL));
  if (rows) PetscCall(SetRows(*tao, grid));
  else PetscCall(TaoSetVariableBounds(*tao, grid->lower, grid->upper));
  PetscCall(TaoGetKSP(*tao, &ksp));
  if (ksp && !rows) {
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, PCHYPRE));
  }
  PetscFunctionReturn(0);
}

/* Largest violation of the bounds */
static PetscErrorCode Violation(Grid *grid, Vec x, PetscReal *violation)
{
  const Vec bounds[2] = {grid->lower, grid->upper};
  PetscReal most[2];
  Vec       d;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &d));
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(VecWAXPY(d, -1.0, x, bounds[k]));
    if (k) PetscCall(VecScale(d, -1.0));
    PetscCall(VecMax(d, NULL, &most[k]));
  }
  PetscCall(VecDestroy(&d));
  *violation = PetscMax(PetscMax(most[0], most[1]), 0.0);
  PetscFunctionReturn(0);
}

/* Objective and solution against those of PETSc's TAOTRON */
static PetscErrorCode Compare(Grid *grid, const char type[], PetscBool rows)
{
  Tao                tao, tron;
  Vec                x, reference;
  PetscReal          f, best, size, violation;
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(grid->lower, &x));
  PetscCall(VecDuplicate(grid->lower, &reference));
  PetscCall(CreateGridSolver(grid, type, rows, x, &tao));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", grid_names[grid->problem], TaoConvergedReasons[reason]));
  PetscCall(CreateGridSolver(grid, TAOTRON, PETSC_FALSE, reference, &tron));
  PetscCall(TaoSetTolerances(tron, 1e-12, 0.0, 0.0));
  PetscCall(TaoSolve(tron));
  PetscCall(TaoGetSolutionStatus(tron, NULL, &best, NULL, NULL, NULL, NULL));
  PetscCall(VecNorm(reference, NORM_INFINITY, &size));
  PetscCall(VecAXPY(reference, -1.0, x));
  PetscCall(VecNorm(reference, NORM_INFINITY, &violation));
  PetscCall(ProblemVerdict("  objective against TRON's, relative", PetscAbsReal(f - best) / PetscAbsReal(best), 1e-6));
  PetscCall(ProblemVerdict("  difference from TRON's solution, relative", violation / size, 1e-3));
  PetscCall(Violation(grid, x, &violation));
  PetscCall(ProblemVerdict("  violation, relative", violation / size, 1e-8));
  PetscCall(TaoDestroy(&tron));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&reference));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  char      name[64], type[64] = TAOIPFILTER;
  PetscInt  n    = 24;
  PetscBool rows = PETSC_FALSE, one;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &n, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-rows", &rows, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-solver", type, sizeof(type), NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-problem", name, sizeof(name), &one));
  PetscCheck(!one || GridFind(name) >= 0, PETSC_COMM_WORLD, PETSC_ERR_USER, "There is no problem %s", name);
  for (int k = 0; k < GRID_NPROBLEMS; k++) {
    Grid grid;

    if (one && k != GridFind(name)) continue;
    PetscCall(CreateGrid(k, n, &grid));
    PetscCall(Compare(&grid, type, rows));
    PetscCall(DestroyGrid(&grid));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_grid_1.out

      test:
         suffix: bounds
         nsize: {{1 2 3}}

      test:
         suffix: rows
         nsize: {{1 2}}
         args: -rows

      test:
         suffix: monotone
         args: -rows -tao_ipfilter_barrier monotone -tao_ipfilter_subspace false

      test:
         suffix: direct
         nsize: 2
         args: -rows -tao_ipfilter_pc_type cholesky -tao_ipfilter_pc_factor_mat_solver_type mumps

   # the error of the objective does not grow with the number of bounds
   test:
      suffix: many
      args: -problem obstacle -n 90

TEST*/
