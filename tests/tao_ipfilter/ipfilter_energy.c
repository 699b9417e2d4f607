static char help[] =
  "A double-well energy with a finite domain, above an obstacle: infinite trial values, indefinite Hessians.\n\n";

#include <petscdmda.h>
#include "ipfilter_problem.h"

/* f = sum h^2 [(1 + u) log(1 + u) + (1 - u) log(1 - u) - theta/2 u^2] + eps^2/2 sum (u_i - u_j)^2 over grid edges
   (Cahn and Hilliard's energy with logarithmic terms), infinite where some |u| >= 1, concave about u = 0 for theta >
   2. An obstacle holds u above 0.98, beyond the well, near the left edge. */
typedef struct {
  DM        da;
  PetscReal theta, eps, h2;
  Mat       J;
  Vec       psi;
  PetscInt  infinite; /* trial points of infinite energy */
  PetscBool outside;  /* something else was asked for at such a point */
} Energy;

static PetscErrorCode InDomain(Vec u, PetscBool *in)
{
  PetscReal size;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  *in = (PetscBool)(size < 1.0);
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckDomain(Energy *e, Vec u)
{
  PetscBool in = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(InDomain(u, &in));
  if (!in) e->outside = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* Sum of the edge differences into g, or, without g, of their squares into f; the local terms of f or g */
static PetscErrorCode Evaluate(Energy *e, Vec u, PetscReal *f, Vec g)
{
  DMDALocalInfo info;
  Vec           local;
  PetscScalar **a, **ga = NULL;
  PetscReal     sum = 0.0;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(e->da, &info));
  PetscCall(DMGetLocalVector(e->da, &local));
  PetscCall(DMGlobalToLocal(e->da, u, INSERT_VALUES, local));
  PetscCall(DMDAVecGetArrayRead(e->da, local, &a));
  if (g) PetscCall(DMDAVecGetArray(e->da, g, &ga));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const PetscInt  di[4] = {1, 0, -1, 0}, dj[4] = {0, 1, 0, -1};
      const PetscReal v     = PetscRealPart(a[j][i]);
      PetscReal       edges = 0.0;

      for (PetscInt k = 0; k < (g ? 4 : 2); k++) {
        if (i + di[k] < 0 || i + di[k] >= info.mx || j + dj[k] < 0 || j + dj[k] >= info.my) continue;
        const PetscReal d = v - PetscRealPart(a[j + dj[k]][i + di[k]]);
        edges += g ? d : 0.5 * d * d;
      }
      if (g) ga[j][i] = e->h2 * (PetscLogReal((1.0 + v) / (1.0 - v)) - e->theta * v) + PetscSqr(e->eps) * edges;
      else
        sum +=
          e->h2 * ((1.0 + v) * PetscLogReal(1.0 + v) + (1.0 - v) * PetscLogReal(1.0 - v) - 0.5 * e->theta * v * v) +
          PetscSqr(e->eps) * edges;
    }
  }
  if (g) PetscCall(DMDAVecRestoreArray(e->da, g, &ga));
  PetscCall(DMDAVecRestoreArrayRead(e->da, local, &a));
  PetscCall(DMRestoreLocalVector(e->da, &local));
  if (f) PetscCallMPI(MPI_Allreduce(&sum, f, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode Objective(Tao tao, Vec u, PetscReal *f, void *user)
{
  Energy   *e  = (Energy *)user;
  PetscBool in = PETSC_FALSE;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(InDomain(u, &in));
  if (in) PetscCall(Evaluate(e, u, f, NULL));
  else {
    *f = PETSC_INFINITY;
    e->infinite++;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Gradient(Tao tao, Vec u, Vec g, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(CheckDomain((Energy *)user, u));
  PetscCall(Evaluate((Energy *)user, u, NULL, g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Hessian(Tao tao, Vec u, Mat H, Mat Hpre, void *user)
{
  Energy       *e = (Energy *)user;
  DMDALocalInfo info;
  PetscScalar **a;

  PetscFunctionBeginUser;
  (void)tao;
  (void)Hpre;
  PetscCall(CheckDomain(e, u));
  PetscCall(DMDAGetLocalInfo(e->da, &info));
  PetscCall(DMDAVecGetArrayRead(e->da, u, &a));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const PetscInt di[4] = {1, 0, -1, 0}, dj[4] = {0, 1, 0, -1};
      MatStencil     row = {.i = i, .j = j}, col[5];
      PetscScalar    v[5];
      PetscInt       n = 1;

      v[0] = e->h2 * (2.0 / (1.0 - PetscSqr(PetscRealPart(a[j][i]))) - e->theta);
      for (PetscInt k = 0; k < 4; k++) {
        if (i + di[k] < 0 || i + di[k] >= info.mx || j + dj[k] < 0 || j + dj[k] >= info.my) continue;
        v[0] += PetscSqr(e->eps);
        v[n]     = -PetscSqr(e->eps);
        col[n++] = (MatStencil){.i = i + di[k], .j = j + dj[k]};
      }
      col[0] = row;
      PetscCall(MatSetValuesStencil(H, 1, &row, n, col, v, INSERT_VALUES));
    }
  }
  PetscCall(DMDAVecRestoreArrayRead(e->da, u, &a));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Constraint(Tao tao, Vec u, Vec c, void *user)
{
  Energy *e = (Energy *)user;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(CheckDomain(e, u));
  PetscCall(MatMult(e->J, u, c));
  PetscCall(VecAXPY(c, -1.0, e->psi));
  PetscFunctionReturn(0);
}

/* u >= 0.98 in the left tenth of the grid, as rows of the ranks that own it */
static PetscErrorCode CreateObstacle(Energy *e, Vec u)
{
  DMDALocalInfo info;
  AO            ao;
  PetscInt      count = 0, n, rstart, *cols;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(e->da, &info));
  PetscCall(DMDAGetAO(e->da, &ao));
  PetscCall(PetscMalloc1(info.xm * info.ym, &cols));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++)
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++)
      if (i < info.mx / 10) cols[count++] = i + info.mx * j;
  PetscCall(AOApplicationToPetsc(ao, count, cols));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, count, n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 1, NULL, &e->J));
  PetscCall(MatCreateVecs(e->J, NULL, &e->psi));
  PetscCall(VecSet(e->psi, 0.98));
  PetscCall(MatGetOwnershipRange(e->J, &rstart, NULL));
  for (PetscInt k = 0; k < count; k++) PetscCall(MatSetValue(e->J, rstart + k, cols[k], 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(e->J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(e->J, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(cols));
  PetscFunctionReturn(0);
}

/* Small and of mixed sign */
static PetscErrorCode FillStart(Energy *e, Vec u)
{
  DMDALocalInfo info;
  PetscScalar **a;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(e->da, &info));
  PetscCall(DMDAVecGetArray(e->da, u, &a));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++)
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++)
      a[j][i] = 0.05 * PetscSinReal(12.0 * i / info.mx) * PetscCosReal(9.0 * j / info.my);
  PetscCall(DMDAVecRestoreArray(e->da, u, &a));
  PetscFunctionReturn(0);
}

/* Whether the matrix of the last condensed system, without shift at the end, has no negative eigenvalue */
static PetscErrorCode PositiveDefinite(Tao tao, PetscBool *positive)
{
  KSP      ksp, factor;
  PC       pc;
  Mat      A, F;
  PetscInt npositive, n;

  PetscFunctionBeginUser;
  PetscCall(TaoGetKSP(tao, &ksp));
  PetscCall(KSPGetOperators(ksp, &A, NULL));
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &factor));
  PetscCall(KSPSetType(factor, KSPPREONLY));
  PetscCall(KSPSetOperators(factor, A, A));
  PetscCall(KSPGetPC(factor, &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(PCFactorSetUpMatSolverType(pc));
  PetscCall(PCFactorGetMatrix(pc, &F));
  PetscCall(MatMumpsSetIcntl(F, 24, 1)); /* the inertia counts null pivots, too */
  PetscCall(KSPSetUp(factor));
  PetscCall(MatGetInertia(F, NULL, NULL, &npositive));
  *positive = (PetscBool)(npositive == n);
  PetscCall(KSPDestroy(&factor));
  PetscFunctionReturn(0);
}

/* grad f - J^T DI against grad f, the sign of DI, penetration */
static PetscErrorCode CheckOptimality(Tao tao, Energy *e, Vec u)
{
  Vec       g, c, DI;
  PetscReal size, residual, least;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &g));
  PetscCall(VecDuplicate(e->psi, &c));
  PetscCall(Evaluate(e, u, NULL, g));
  PetscCall(VecNorm(g, NORM_INFINITY, &size));
  PetscCall(TaoGetDualVariables(tao, NULL, &DI));
  PetscCall(VecScale(g, -1.0));
  PetscCall(MatMultTransposeAdd(e->J, DI, g, g));
  PetscCall(VecNorm(g, NORM_INFINITY, &residual));
  PetscCall(ProblemVerdict("stationarity, relative to the multipliers' forces", residual / size, 1e-6));
  PetscCall(VecMin(DI, NULL, &least));
  PetscCall(ProblemVerdict("negative multipliers", -least, 0.0));
  PetscCall(Constraint(tao, u, c, e));
  PetscCall(VecMin(c, NULL, &least));
  PetscCall(ProblemVerdict("penetration", -least, 1e-8));
  PetscCall(VecDestroy(&g));
  PetscCall(VecDestroy(&c));
  PetscFunctionReturn(0);
}

static PetscErrorCode Report(Tao tao, Energy *e, Vec u)
{
  TaoConvergedReason reason;
  PetscInt           steps, retries;
  PetscReal          largest;
  PetscBool          positive = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(TaoIPFilterGetRegularizations(tao, &steps, &retries, &largest));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", TaoConvergedReasons[reason]));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "trial points of infinite energy: %s\n", e->infinite ? "yes" : "none"));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "constraints or derivatives there: %s\n", e->outside ? "YES" : "none"));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "shifted Hessians: %s\n",
    steps > 0 && retries >= steps && largest > 0.0 ? "yes" : "NONE"));
  PetscCall(PositiveDefinite(tao, &positive));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "last matrix positive definite: %s\n", positive ? "yes" : "NO"));
  PetscCall(CheckOptimality(tao, e, u));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscInt n = 40;
  Energy   e = {NULL, 4.0, 0.1, 0.0, NULL, NULL, 0, PETSC_FALSE};
  Tao      tao;
  Mat      H;
  Vec      u, c;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &n, NULL));
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, n, n, PETSC_DECIDE,
    PETSC_DECIDE, 1, 1, NULL, NULL, &e.da));
  PetscCall(DMSetUp(e.da));
  e.h2 = 1.0 / (n * n);
  PetscCall(DMCreateGlobalVector(e.da, &u));
  PetscCall(DMCreateMatrix(e.da, &H));
  PetscCall(FillStart(&e, u));
  PetscCall(CreateObstacle(&e, u));
  PetscCall(VecDuplicate(e.psi, &c));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, u));
  PetscCall(TaoSetObjective(tao, Objective, &e));
  PetscCall(TaoSetGradient(tao, NULL, Gradient, &e));
  PetscCall(TaoSetHessian(tao, H, H, Hessian, &e));
  PetscCall(TaoSetInequalityConstraintsRoutine(tao, c, Constraint, &e));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, e.J, e.J, ProblemConstant, &e));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(Report(tao, &e, u));
  PetscCall(TaoDestroy(&tao));
  PetscCall(MatDestroy(&H));
  PetscCall(MatDestroy(&e.J));
  PetscCall(VecDestroy(&e.psi));
  PetscCall(VecDestroy(&c));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&e.da));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_energy_1.out

      test:
         suffix: ranks
         nsize: {{1 3 2}}

      test:
         suffix: monotone
         args: -tao_ipfilter_barrier monotone

      test:
         suffix: cold
         args: -tao_ipfilter_start cold -tao_ipfilter_forcing fixed

TEST*/
