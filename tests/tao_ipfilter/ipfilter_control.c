static char help[] =
  "Distributed control: min 1/2 |y - y_d|^2 + alpha/2 |u|^2 subject to -Laplace y = u + f in the unit square, y\n\
= 0 around it, where asked y <= y_max.\n\n";

#include <petscdmda.h>
#include "ipfilter_problem.h"

/* Unknowns (y, u) at every point, interleaved; J (y, u) - g = 0 */
typedef struct {
  DM               states, unknowns;
  PetscInt         n;
  PetscReal        h, alpha;
  QuadraticProgram q;
} Control;

/* What is wanted: the lowest mode, so that without bounds the solution is a multiple of it */
static PetscReal Mode(PetscReal x, PetscReal y)
{
  return PetscSinReal(PETSC_PI * x) * PetscSinReal(PETSC_PI * y);
}

/* Eigenvalue of the five-point Laplacian for it */
static PetscReal Eigenvalue(PetscReal h)
{
  return 8.0 / PetscSqr(h) * PetscSqr(PetscSinReal(0.5 * PETSC_PI * h));
}

/* The source f; the state wanted is the mode itself */
static const PetscReal source = 3.0;

/* Hessian h^2 diag(1, alpha) and the linear term h^2 (y_d, 0) */
static PetscErrorCode AssembleObjective(Control *c)
{
  DMDALocalInfo  info;
  PetscScalar ***b;
  PetscInt       lo, hi, m;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(c->unknowns, &info));
  PetscCall(DMCreateGlobalVector(c->unknowns, &c->q.b));
  PetscCall(DMDAVecGetArrayDOF(c->unknowns, c->q.b, &b));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      b[j][i][0] = PetscSqr(c->h) * Mode((i + 1) * c->h, (j + 1) * c->h);
      b[j][i][1] = 0.0;
    }
  }
  PetscCall(DMDAVecRestoreArrayDOF(c->unknowns, c->q.b, &b));
  PetscCall(VecGetOwnershipRange(c->q.b, &lo, &hi));
  m = hi - lo;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, m, m, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 0, NULL, &c->q.H));
  for (PetscInt i = lo; i < hi; i++)
    PetscCall(MatSetValue(c->q.H, i, i, PetscSqr(c->h) * ((i - lo) % 2 ? c->alpha : 1.0), INSERT_VALUES));
  PetscCall(MatAssemblyBegin(c->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->q.H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* 4 y - sum of the neighbours - h^2 u = h^2 f */
static PetscErrorCode AssembleEquation(Control *c)
{
  const PetscInt         di[4] = {-1, 1, 0, 0}, dj[4] = {0, 0, -1, 1};
  DMDALocalInfo          info;
  ISLocalToGlobalMapping state;
  const PetscInt        *global;
  PetscInt               m, n;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(c->states, &info));
  PetscCall(DMGetLocalToGlobalMapping(c->states, &state));
  PetscCall(ISLocalToGlobalMappingGetIndices(state, &global));
  PetscCall(VecGetLocalSize(c->q.b, &n));
  m = n / 2;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, m, n, PETSC_DETERMINE, PETSC_DETERMINE, 6, NULL, 4, NULL, &c->q.J));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const PetscInt here = (j - info.gys) * info.gxm + i - info.gxs, row = global[here];

      PetscCall(MatSetValue(c->q.J, row, 2 * row, 4.0, INSERT_VALUES));
      PetscCall(MatSetValue(c->q.J, row, 2 * row + 1, -PetscSqr(c->h), INSERT_VALUES));
      for (PetscInt d = 0; d < 4; d++) {
        const PetscInt ni = i + di[d], nj = j + dj[d];

        if (ni >= 0 && nj >= 0 && ni < info.mx && nj < info.my)
          PetscCall(MatSetValue(c->q.J, row, 2 * global[here + di[d] + dj[d] * info.gxm], -1.0, INSERT_VALUES));
      }
    }
  }
  PetscCall(ISLocalToGlobalMappingRestoreIndices(state, &global));
  PetscCall(MatAssemblyBegin(c->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(c->q.J, NULL, &c->q.g));
  PetscFunctionReturn(0);
}

/* g = h^2 source: a multiple of the mode where the answer is to be one, else a constant */
static PetscErrorCode AssembleSource(Control *c, PetscBool mode)
{
  DMDALocalInfo info;
  PetscScalar **g;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(c->states, &info));
  PetscCall(DMDAVecGetArray(c->states, c->q.g, &g));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++)
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++)
      g[j][i] = PetscSqr(c->h) * source * (mode ? Mode((i + 1) * c->h, (j + 1) * c->h) : 1.0);
  PetscCall(DMDAVecRestoreArray(c->states, c->q.g, &g));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateControl(PetscInt n, PetscReal alpha, Control *c)
{
  PetscFunctionBeginUser;
  *c = (Control){.n = n, .h = 1.0 / (n + 1), .alpha = alpha};
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, n, n, PETSC_DECIDE,
    PETSC_DECIDE, 1, 1, NULL, NULL, &c->states));
  PetscCall(DMSetUp(c->states));
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, n, n, PETSC_DECIDE,
    PETSC_DECIDE, 2, 1, NULL, NULL, &c->unknowns));
  PetscCall(DMSetUp(c->unknowns));
  PetscCall(AssembleObjective(c));
  PetscCall(AssembleEquation(c));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyControl(Control *c)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&c->q));
  PetscCall(DMDestroy(&c->states));
  PetscCall(DMDestroy(&c->unknowns));
  PetscFunctionReturn(0);
}

/* Bounds y <= y_max */
static PetscErrorCode BoundStates(Tao tao, Vec x, PetscReal state_max)
{
  Vec lower, upper;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &lower));
  PetscCall(VecDuplicate(x, &upper));
  PetscCall(VecSet(lower, PETSC_NINFINITY));
  PetscCall(VecSet(upper, PETSC_INFINITY));
  PetscCall(VecStrideSet(upper, 0, state_max));
  PetscCall(TaoSetVariableBounds(tao, lower, upper));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscFunctionReturn(0);
}

/* Solves from zero; the solver keeps what it did */
static PetscErrorCode SolveControl(Control *c, PetscReal state_max, Vec x, Tao *tao)
{
  QuadraticProgram unconstrained = {.H = c->q.H, .b = c->q.b};
  Vec              ce;

  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&unconstrained, x, tao));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, ProblemObjectiveAndGradient, &c->q));
  PetscCall(VecDuplicate(c->q.g, &ce));
  PetscCall(TaoSetEqualityConstraintsRoutine(*tao, ce, ProblemConstraints, &c->q));
  PetscCall(TaoSetJacobianEqualityRoutine(*tao, c->q.J, c->q.J, ProblemConstant, NULL));
  PetscCall(VecDestroy(&ce));
  if (state_max < PETSC_INFINITY) PetscCall(BoundStates(*tao, x, state_max));
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(VecSet(x, 0.0));
  PetscCall(TaoSolve(*tao));
  PetscFunctionReturn(0);
}

/* Without bounds and with sources of the lowest mode the solution is (Y, U) times it, of which y is the largest error
   in units of Y, u in those of U */
static PetscErrorCode ModeErrors(Control *c, Vec x, PetscReal *y, PetscReal *u)
{
  const PetscReal lambda = Eigenvalue(c->h),
                  Y = (1.0 + c->alpha * lambda * source) / (1.0 + c->alpha * PetscSqr(lambda)), U = lambda * Y - source;
  DMDALocalInfo  info;
  PetscScalar ***a;
  PetscReal      error[2] = {0.0, 0.0};

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(c->unknowns, &info));
  PetscCall(DMDAVecGetArrayDOF(c->unknowns, x, &a));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++) {
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++) {
      const PetscReal mode = Mode((i + 1) * c->h, (j + 1) * c->h);

      error[0] = PetscMax(error[0], PetscAbsScalar(a[j][i][0] - Y * mode) / PetscAbsReal(Y));
      error[1] = PetscMax(error[1], PetscAbsScalar(a[j][i][1] - U * mode) / PetscAbsReal(U));
    }
  }
  PetscCall(DMDAVecRestoreArrayDOF(c->unknowns, x, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 2, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  *y = error[0];
  *u = error[1];
  PetscFunctionReturn(0);
}

static PetscErrorCode TestMode(PetscInt n, PetscReal alpha)
{
  Control   c;
  Vec       x;
  Tao       tao;
  PetscReal y = 0.0, u = 0.0;

  PetscFunctionBeginUser;
  PetscCall(CreateControl(n, alpha, &c));
  PetscCall(AssembleSource(&c, PETSC_TRUE));
  PetscCall(VecDuplicate(c.q.b, &x));
  PetscCall(SolveControl(&c, PETSC_INFINITY, x, &tao));
  PetscCall(ModeErrors(&c, x, &y, &u));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "control without bounds, alpha = %g:\n", (double)alpha));
  PetscCall(ProblemVerdict("  error of the state", y, 1e-8));
  PetscCall(ProblemVerdict("  error of the control", u, 1e-7));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyControl(&c));
  PetscFunctionReturn(0);
}

/* The same in the state alone, u = -Laplace y - f being put in: H = h^2 + alpha/h^2 A^T A, b = h^2 y_d + alpha/h^2
   A^T g with A y = 4 y - ... = h^2 (u + f) */
static PetscErrorCode ReduceToStates(Control *c, QuadraticProgram *reduced, PetscReal *constant)
{
  IS          states, rows;
  Mat         A;
  Vec         part;
  PetscInt    lo, hi, stride = 2;
  PetscReal   unit = c->alpha / PetscSqr(c->h);
  PetscScalar gg;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(c->q.b, &lo, &hi));
  PetscCall(ISCreateStride(PETSC_COMM_WORLD, (hi - lo) / stride, lo, stride, &states));
  PetscCall(ISCreateStride(PETSC_COMM_WORLD, (hi - lo) / stride, lo / stride, 1, &rows));
  PetscCall(MatCreateSubMatrix(c->q.J, rows, states, MAT_INITIAL_MATRIX, &A));
  PetscCall(MatTransposeMatMult(A, A, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &reduced->H));
  PetscCall(MatScale(reduced->H, unit));
  PetscCall(MatShift(reduced->H, PetscSqr(c->h)));
  PetscCall(VecDuplicate(c->q.g, &reduced->b));
  PetscCall(VecGetSubVector(c->q.b, states, &part));
  PetscCall(VecCopy(part, reduced->b));
  PetscCall(VecRestoreSubVector(c->q.b, states, &part));
  PetscCall(VecDuplicate(c->q.g, &part));
  PetscCall(MatMultTranspose(A, c->q.g, part));
  PetscCall(VecAXPY(reduced->b, unit, part));
  PetscCall(VecDot(c->q.g, c->q.g, &gg));
  *constant = 0.5 * unit * PetscRealPart(gg);
  PetscCall(VecDestroy(&part));
  PetscCall(MatDestroy(&A));
  PetscCall(ISDestroy(&states));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(0);
}

/* The optimum by PETSc's own TAOTRON, for the states alone */
static PetscErrorCode SolveByTRON(Control *c, PetscReal state_max, PetscReal *f)
{
  QuadraticProgram reduced  = {.H = NULL};
  PetscReal        constant = 0.0;
  Tao              tao;
  Vec              y, lower, upper;

  PetscFunctionBeginUser;
  PetscCall(ReduceToStates(c, &reduced, &constant));
  PetscCall(VecDuplicate(reduced.b, &y));
  PetscCall(VecDuplicate(y, &lower));
  PetscCall(VecDuplicate(y, &upper));
  PetscCall(VecSet(lower, PETSC_NINFINITY));
  PetscCall(VecSet(upper, state_max));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOTRON));
  PetscCall(TaoSetSolution(tao, y));
  PetscCall(TaoSetVariableBounds(tao, lower, upper));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ProblemObjectiveAndGradient, &reduced));
  PetscCall(TaoSetHessian(tao, reduced.H, reduced.H, ProblemConstant, NULL));
  PetscCall(TaoSetTolerances(tao, 1e-12, 0.0, 0.0));
  PetscCall(TaoSetMaximumIterations(tao, 500));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, f, NULL, NULL, NULL, NULL));
  *f += constant;
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscCall(ProblemDestroy(&reduced));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestBounds(PetscInt n, PetscReal alpha, PetscReal state_max)
{
  Control   c;
  Vec       x, r;
  Tao       tao;
  PetscReal f, optimum, violation;

  PetscFunctionBeginUser;
  PetscCall(CreateControl(n, alpha, &c));
  PetscCall(AssembleSource(&c, PETSC_FALSE));
  PetscCall(VecDuplicate(c.q.b, &x));
  PetscCall(SolveControl(&c, state_max, x, &tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, NULL));
  PetscCall(SolveByTRON(&c, state_max, &optimum));
  PetscCall(VecDuplicate(c.q.g, &r));
  PetscCall(MatMult(c.q.J, x, r));
  PetscCall(VecAXPY(r, -1.0, c.q.g));
  PetscCall(VecNorm(r, NORM_INFINITY, &violation));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "control with a bound of the state:\n"));
  PetscCall(ProblemVerdict("  objective against TRON's", PetscAbsReal(f - optimum) / PetscAbsReal(optimum), 1e-6));
  PetscCall(ProblemVerdict("  violation of the equation", violation, 1e-12));
  PetscCall(VecDestroy(&r));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyControl(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(TestMode(32, 1e-2));
  PetscCall(TestMode(32, 1e-6));
  PetscCall(TestBounds(32, 1e-4, 0.05));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}

TEST*/
