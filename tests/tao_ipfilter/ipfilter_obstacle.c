static char help[] = "A membrane over an obstacle: min 1/2 u^T K u - b^T u, u - psi >= 0 where the obstacle is.\n\n";

#include <petscdmda.h>
#include "ipfilter_problem.h"

/* Constraints on part of the unknowns: J picks them. length and energy are the units the problem is stated in: with
   x = length u, f = energy (1/2 u^T K u - b^T u). */
typedef struct {
  QuadraticProgram q;
  PetscReal        length, energy;
} Obstacle;

/* Five-point Laplacian on the unit square with fixed edge, stated in the given units */
static PetscErrorCode AssembleMembrane(DM da, Obstacle *o)
{
  DMDALocalInfo info;
  PetscReal     h, k = o->energy / PetscSqr(o->length);

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(da, &info));
  h = 1.0 / (info.mx - 1);
  PetscCall(DMCreateMatrix(da, &o->q.H));
  PetscCall(DMCreateGlobalVector(da, &o->q.b));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      MatStencil     row = {.i = i, .j = j}, col[5];
      PetscScalar    v[5];
      PetscInt       n     = 0;
      const PetscInt di[4] = {-1, 1, 0, 0}, dj[4] = {0, 0, -1, 1};

      col[n] = row;
      v[n++] = 4.0 * k;
      if (i > 0 && j > 0 && i < info.mx - 1 && j < info.my - 1) {
        for (PetscInt d = 0; d < 4; d++) {
          const PetscInt ni = i + di[d], nj = j + dj[d];

          if (ni == 0 || nj == 0 || ni == info.mx - 1 || nj == info.my - 1) continue;
          col[n] = (MatStencil){.i = ni, .j = nj};
          v[n++] = -k;
        }
      }
      PetscCall(MatSetValuesStencil(o->q.H, 1, &row, n, col, v, INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(o->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(o->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecSet(o->q.b, -2.0 * h * h * o->energy / o->length));
  PetscFunctionReturn(0);
}

/* The obstacle is a cap over the middle of the square, raised by lift: ranks at the edge have no constraint */
static PetscErrorCode CreateObstacle(DM da, PetscReal lift, Obstacle *o)
{
  DMDALocalInfo info;
  AO            ao;
  PetscInt      count = 0, rstart, n, *cols;
  PetscReal    *values;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(da, &info));
  PetscCall(DMDAGetAO(da, &ao));
  PetscCall(PetscMalloc2(info.xm * info.ym, &cols, info.xm * info.ym, &values));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const PetscReal x = (PetscReal)i / (info.mx - 1) - 0.5, y = (PetscReal)j / (info.my - 1) - 0.5,
                      r2 = x * x + y * y;

      if (r2 > PetscSqr(0.3)) continue;
      cols[count]     = i + info.mx * j;
      values[count++] = o->length * (lift - 0.1 + 0.08 * (1.0 - r2 / 0.09));
    }
  }
  PetscCall(AOApplicationToPetsc(ao, count, cols));
  PetscCall(VecGetLocalSize(o->q.b, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, count, n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 1, NULL, &o->q.J));
  PetscCall(MatCreateVecs(o->q.J, NULL, &o->q.g));
  PetscCall(MatGetOwnershipRange(o->q.J, &rstart, NULL));
  for (PetscInt k = 0; k < count; k++) {
    PetscCall(MatSetValue(o->q.J, rstart + k, cols[k], 1.0, INSERT_VALUES));
    PetscCall(VecSetValue(o->q.g, rstart + k, values[k], INSERT_VALUES));
  }
  PetscCall(PetscFree2(cols, values));
  PetscCall(MatAssemblyBegin(o->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(o->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(o->q.g));
  PetscCall(VecAssemblyEnd(o->q.g));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateProblem(PetscInt n, PetscReal lift, PetscReal length, PetscReal energy, DM *da, Obstacle *o)
{
  PetscFunctionBeginUser;
  o->length = length;
  o->energy = energy;
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, n, n, PETSC_DECIDE,
    PETSC_DECIDE, 1, 1, NULL, NULL, da));
  PetscCall(DMSetFromOptions(*da));
  PetscCall(DMSetUp(*da));
  PetscCall(AssembleMembrane(*da, o));
  PetscCall(CreateObstacle(*da, lift, o));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyProblem(DM *da, Obstacle *o)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&o->q));
  PetscCall(DMDestroy(da));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(Obstacle *o, Vec x, Tao *tao)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&o->q, x, tao));
  PetscCall(TaoSetFromOptions(*tao));
  PetscFunctionReturn(0);
}

/* The same obstacle as a bound, solved by PETSc's own TAOTRON */
static PetscErrorCode SolveByTRON(Obstacle *o, Vec x)
{
  Tao tao;
  Vec lower, upper, one;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &lower));
  PetscCall(VecDuplicate(x, &upper));
  PetscCall(VecSet(upper, PETSC_INFINITY));
  PetscCall(VecSet(lower, -1e3 * o->length));
  PetscCall(VecDuplicate(o->q.g, &one));
  PetscCall(VecCopy(o->q.g, one));
  PetscCall(VecShift(one, 1e3 * o->length));
  PetscCall(MatMultTransposeAdd(o->q.J, one, lower, lower));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOTRON));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetVariableBounds(tao, lower, upper));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ProblemObjectiveAndGradient, &o->q));
  PetscCall(TaoSetHessian(tao, o->q.H, o->q.H, ProblemConstant, NULL));
  PetscCall(TaoSetTolerances(tao, 1e-12, 0.0, 0.0));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscCall(VecDestroy(&one));
  PetscFunctionReturn(0);
}

/* Solution against TRON, multipliers against the reaction K u - b, feasibility, complementarity */
static PetscErrorCode Check(Tao tao, Obstacle *o, Vec x)
{
  Vec                reference, reaction, DI, gap;
  PetscReal          f, error, size, force;
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, objective %.9e\n", TaoConvergedReasons[reason], (double)f));
  PetscCall(VecDuplicate(x, &reference));
  PetscCall(VecSet(reference, 0.0));
  PetscCall(SolveByTRON(o, reference));
  PetscCall(VecNorm(reference, NORM_INFINITY, &size));
  PetscCall(VecAXPY(reference, -1.0, x));
  PetscCall(VecNorm(reference, NORM_INFINITY, &error));
  PetscCall(ProblemVerdict("difference from TRON's solution, relative", error / size, 1e-6));
  PetscCall(VecDuplicate(x, &reaction));
  PetscCall(MatMult(o->q.H, x, reaction));
  PetscCall(VecAXPY(reaction, -1.0, o->q.b));
  PetscCall(VecNorm(reaction, NORM_INFINITY, &force));
  PetscCall(TaoGetDualVariables(tao, NULL, &DI));
  PetscCall(MatMultTranspose(o->q.J, DI, reference));
  PetscCall(VecAXPY(reference, -1.0, reaction));
  PetscCall(VecNorm(reference, NORM_INFINITY, &error));
  PetscCall(ProblemVerdict("multipliers against the reaction, relative", error / force, 1e-6));
  PetscCall(VecDuplicate(o->q.g, &gap));
  PetscCall(ProblemConstraints(tao, x, gap, &o->q));
  PetscCall(VecMin(gap, NULL, &error));
  PetscCall(ProblemVerdict("penetration, relative", -error / size, 1e-9));
  PetscCall(VecPointwiseMult(gap, gap, DI));
  PetscCall(VecNorm(gap, NORM_INFINITY, &error));
  PetscCall(ProblemVerdict("gap times multiplier, relative", error / force / size, 1e-6));
  PetscCall(VecDestroy(&reference));
  PetscCall(VecDestroy(&reaction));
  PetscCall(VecDestroy(&gap));
  PetscFunctionReturn(0);
}

static PetscErrorCode CountIterations(Tao tao, PetscInt *newton, PetscInt *krylov)
{
  const PetscInt *its;
  PetscInt        n;

  PetscFunctionBeginUser;
  PetscCall(TaoGetIterationNumber(tao, newton));
  PetscCall(TaoIPFilterGetKSPIterations(tao, &n, &its));
  *krylov = 0;
  for (PetscInt k = 0; k < n; k++) *krylov += its[k];
  PetscFunctionReturn(0);
}

/* A new solve of a slightly raised obstacle from the old solution, with the old slacks and multipliers and with
   predicted ones */
static PetscErrorCode CompareWarmStart(PetscInt n)
{
  DM       da;
  Obstacle o;
  Tao      tao;
  Vec      x, x0, s, z, ws, wz;
  PetscInt newton[2], krylov[2];

  PetscFunctionBeginUser;
  PetscCall(CreateProblem(n, 0.0, 1.0, 1.0, &da, &o));
  PetscCall(VecDuplicate(o.q.b, &x));
  PetscCall(CreateSolver(&o, x, &tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoIPFilterGetSlack(tao, &s));
  PetscCall(TaoIPFilterGetMultiplier(tao, &z));
  PetscCall(VecDuplicate(s, &ws));
  PetscCall(VecDuplicate(z, &wz));
  PetscCall(VecDuplicate(x, &x0));
  PetscCall(VecCopy(x, x0));
  PetscCall(VecCopy(s, ws));
  PetscCall(VecCopy(z, wz));
  PetscCall(VecShift(o.q.g, 1e-4));
  PetscCall(TaoIPFilterSetWarmStart(tao, ws, wz));
  PetscCall(TaoSolve(tao));
  PetscCall(CountIterations(tao, &newton[0], &krylov[0]));
  PetscCall(TaoIPFilterSetWarmStart(tao, NULL, NULL));
  PetscCall(VecCopy(x0, x));
  PetscCall(TaoSolve(tao));
  PetscCall(CountIterations(tao, &newton[1], &krylov[1]));
  if (newton[0] <= newton[1] && 3 * krylov[0] <= 2 * krylov[1])
    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "warm start: no more Newton and at most two thirds of the Krylov iterations\n"));
  else
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
      "warm start: %" PetscInt_FMT " Newton, %" PetscInt_FMT " Krylov iterations; predicted start: %" PetscInt_FMT
      ", %" PetscInt_FMT "\n",
      newton[0], krylov[0], newton[1], krylov[1]));
  PetscCall(VecDestroy(&x0));
  PetscCall(VecDestroy(&ws));
  PetscCall(VecDestroy(&wz));
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyProblem(&da, &o));
  PetscFunctionReturn(0);
}

/* The same problem in other units must take the same iterations, give or take one */
static PetscErrorCode CompareUnits(PetscInt n)
{
  const PetscReal length[3] = {1.0, 1e3, 1e-3}, energy[3] = {1.0, 1e-6, 1e9};
  PetscInt        newton[3], krylov[3];
  PetscReal       f[3];
  PetscBool       same = PETSC_TRUE;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) {
    DM       da;
    Obstacle o;
    Tao      tao;
    Vec      x;

    PetscCall(CreateProblem(n, 0.0, length[k], energy[k], &da, &o));
    PetscCall(VecDuplicate(o.q.b, &x));
    PetscCall(CreateSolver(&o, x, &tao));
    PetscCall(TaoSolve(tao));
    PetscCall(CountIterations(tao, &newton[k], &krylov[k]));
    PetscCall(TaoGetSolutionStatus(tao, NULL, &f[k], NULL, NULL, NULL, NULL));
    if (PetscAbsInt(newton[k] - newton[0]) > 1 || PetscAbsReal(f[k] / energy[k] - f[0]) > 1e-8 * PetscAbsReal(f[0]))
      same = PETSC_FALSE;
    PetscCall(VecDestroy(&x));
    PetscCall(TaoDestroy(&tao));
    PetscCall(DestroyProblem(&da, &o));
  }
  if (same) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "units: the same iterations and objective\n"));
  else
    for (PetscInt k = 0; k < 3; k++)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD,
        "units %g, %g: %" PetscInt_FMT " Newton, %" PetscInt_FMT " Krylov iterations, objective %.10e\n",
        (double)length[k], (double)energy[k], newton[k], krylov[k], (double)(f[k] / energy[k])));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscInt  n       = 41;
  PetscBool compare = PETSC_FALSE;
  DM        da;
  Obstacle  o;
  Tao       tao;
  Vec       x;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &n, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-compare", &compare, NULL));
  if (compare) {
    PetscCall(CompareWarmStart(n));
    PetscCall(CompareUnits(n));
  } else {
    PetscCall(CreateProblem(n, 0.0, 1.0, 1.0, &da, &o));
    PetscCall(VecDuplicate(o.q.b, &x));
    PetscCall(CreateSolver(&o, x, &tao));
    PetscCall(TaoSolve(tao));
    PetscCall(Check(tao, &o, x));
    PetscCall(VecDestroy(&x));
    PetscCall(TaoDestroy(&tao));
    PetscCall(DestroyProblem(&da, &o));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_obstacle_1.out
      args: -tao_ipfilter_tol 1e-10

      test:
         suffix: ranks
         nsize: {{1 2 3}}

      test:
         suffix: monotone
         nsize: 2
         args: -tao_ipfilter_barrier monotone

      test:
         suffix: baij
         nsize: {{1 3}}
         args: -dm_mat_type baij

      test:
         suffix: sbaij
         nsize: {{1 2}}
         args: -dm_mat_type sbaij -tao_ipfilter_pc_type jacobi

      test:
         suffix: direct
         nsize: 2
         args: -tao_ipfilter_pc_type cholesky -tao_ipfilter_pc_factor_mat_solver_type mumps

      test:
         suffix: hypre
         nsize: 2
         args: -tao_ipfilter_pc_type hypre

   test:
      suffix: compare
      nsize: {{1 2}}
      args: -compare -tao_ipfilter_subspace false

TEST*/
