static char help[] =
  "Two elastic blocks, a vector Laplacian each, tied where they meet: every displacement of one block's face is\n\
the mean of four of the other's.\n\n";

#include <petscdmda.h>
#include "ipfilter_problem.h"

/* The blocks are the lower and the upper half of a grid whose middle bond is missing; both far ends are held */
typedef struct {
  DM        grid;
  PetscInt  nx, nz; /* points across, and along both blocks */
  PetscReal stiffer,
    soften; /* stiffness of the upper block, and what its face is pushed away with by springs of less than none */
  PetscInt         times;         /* each tie */
  PetscReal        contradiction; /* gap between the first of a tie and the others */
  QuadraticProgram q;             /* J: the ties */
} Blocks;

/* The bond between the layers k and k + 1, or from the layer before the first and after the last to the held ends; 0:
   none */
static PetscReal Bond(const Blocks *b, PetscInt k)
{
  if (k + 1 == b->nz / 2) return 0.0;
  return k + 1 < b->nz / 2 ? 1.0 : b->stiffer;
}

/* Global number of a point's displacement */
static PetscInt Number(const DMDALocalInfo *info, const PetscInt global[], PetscInt i, PetscInt j, PetscInt k,
  PetscInt component)
{
  return 3 * global[((k - info->gzs) * info->gym + j - info->gys) * info->gxm + i - info->gxs] + component;
}

/* The bonds of one point to its neighbours of a larger or a smaller number, in every component */
static PetscErrorCode AssemblePoint(const Blocks *b, const DMDALocalInfo *info, const PetscInt global[], PetscInt i,
  PetscInt j, PetscInt k)
{
  const PetscInt  di[6] = {-1, 1, 0, 0, 0, 0}, dj[6] = {0, 0, -1, 1, 0, 0}, dk[6] = {0, 0, 0, 0, -1, 1};
  const PetscReal own = 2 * k < b->nz ? 1.0 : b->stiffer;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < 3; c++) {
    const PetscInt row = Number(info, global, i, j, k, c);
    PetscReal      sum = 0.0;

    for (PetscInt d = 0; d < 6; d++) {
      const PetscInt  ni = i + di[d], nj = j + dj[d], nk = k + dk[d];
      const PetscReal bond = dk[d] ? Bond(b, PetscMin(k, nk)) : own;

      if (ni < 0 || nj < 0 || ni >= info->mx || nj >= info->my) continue;
      sum += bond;
      if (nk >= 0 && nk < info->mz && bond > 0.0)
        PetscCall(MatSetValue(b->q.H, row, Number(info, global, ni, nj, nk, c), -bond, INSERT_VALUES));
    }
    PetscCall(MatSetValue(b->q.H, row, row, sum - (2 * k == b->nz ? b->soften : 0.0), INSERT_VALUES));
    PetscCall(VecSetValue(b->q.b, row, 1e-2 * (c + 1) * (1.0 + (PetscReal)i / info->mx), INSERT_VALUES));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode AssembleBlocks(Blocks *b)
{
  DMDALocalInfo          info;
  ISLocalToGlobalMapping map;
  const PetscInt        *global;
  PetscInt               n;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(b->grid, &info));
  PetscCall(DMCreateGlobalVector(b->grid, &b->q.b));
  PetscCall(VecGetLocalSize(b->q.b, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 7, NULL, 3, NULL, &b->q.H));
  PetscCall(MatSetBlockSize(b->q.H, 3));
  PetscCall(DMGetLocalToGlobalMapping(b->grid, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  for (PetscInt k = info.zs; k < info.zs + info.zm; k++)
    for (PetscInt j = info.ys; j < info.ys + info.ym; j++)
      for (PetscInt i = info.xs; i < info.xs + info.xm; i++) PetscCall(AssemblePoint(b, &info, global, i, j, k));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  PetscCall(MatAssemblyBegin(b->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(b->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(b->q.b));
  PetscCall(VecAssemblyEnd(b->q.b));
  PetscFunctionReturn(0);
}

/* The ties of the points of this rank in the upper block's first layer, which stands off the other by a gap */
static PetscErrorCode AssembleTies(Blocks *b)
{
  DMDALocalInfo          info;
  ISLocalToGlobalMapping map;
  const PetscInt        *global, layer = b->nz / 2;
  PetscInt               row, n, points;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(b->grid, &info));
  points = info.zs <= layer && layer < info.zs + info.zm ? info.xm * info.ym : 0;
  PetscCall(VecGetLocalSize(b->q.b, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, 3 * points * b->times, n, PETSC_DETERMINE, PETSC_DETERMINE, 5, NULL, 5, NULL,
    &b->q.J));
  PetscCall(MatCreateVecs(b->q.J, NULL, &b->q.g));
  PetscCall(MatGetOwnershipRange(b->q.J, &row, NULL));
  PetscCall(DMGetLocalToGlobalMapping(b->grid, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  for (PetscInt p = 0; p < points; p++) {
    const PetscInt i = info.xs + p % info.xm, j = info.ys + p / info.xm;

    for (PetscInt l = 0; l < 3 * b->times; l++, row++) {
      const PetscInt c = l / b->times;

      PetscCall(MatSetValue(b->q.J, row, Number(&info, global, i, j, layer, c), 1.0, ADD_VALUES));
      for (PetscInt d = 0; d < 4; d++)
        PetscCall(MatSetValue(b->q.J, row,
          Number(&info, global, PetscMin(i + d % 2, info.mx - 1), PetscMin(j + d / 2, info.my - 1), layer - 1, c),
          -0.25, ADD_VALUES));
      PetscCall(VecSetValue(b->q.g, row, 1e-2 * (c == 2) + (l % b->times ? b->contradiction : 0.0), INSERT_VALUES));
    }
  }
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  PetscCall(MatAssemblyBegin(b->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(b->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(b->q.g));
  PetscCall(VecAssemblyEnd(b->q.g));
  PetscFunctionReturn(0);
}

/* The grid and what is on it, for the parameters that are set */
static PetscErrorCode CreateBlocks(PetscInt nx, PetscInt nz, Blocks *b)
{
  PetscFunctionBeginUser;
  b->nx = nx;
  b->nz = nz;
  PetscCall(DMDACreate3d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_BOX, nx,
    nx, nz, PETSC_DECIDE, PETSC_DECIDE, PETSC_DECIDE, 3, 1, NULL, NULL, NULL, &b->grid));
  PetscCall(DMSetUp(b->grid));
  PetscCall(AssembleBlocks(b));
  PetscCall(AssembleTies(b));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyBlocks(Blocks *b)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&b->q));
  PetscCall(DMDestroy(&b->grid));
  PetscFunctionReturn(0);
}

/* Solves from zero, with or without the ties; applications of the AMG */
static PetscErrorCode SolveBlocks(Blocks *b, PetscBool tied, Vec x, Tao *tao, PetscInt *applications)
{
  QuadraticProgram free   = {.H = b->q.H, .b = b->q.b};
  PCAMGFCounts     counts = {.amg_applies = 0};
  KSP              ksp;
  PC               pc;
  Vec              ce;

  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&free, x, tao));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, ProblemObjectiveAndGradient, &b->q));
  if (tied) {
    PetscCall(VecDuplicate(b->q.g, &ce));
    PetscCall(TaoSetEqualityConstraintsRoutine(*tao, ce, ProblemConstraints, &b->q));
    PetscCall(TaoSetJacobianEqualityRoutine(*tao, b->q.J, b->q.J, ProblemConstant, NULL));
    PetscCall(VecDestroy(&ce));
  }
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(VecSet(x, 0.0));
  PetscCall(TaoSolve(*tao));
  PetscCall(TaoGetKSP(*tao, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCAMGFGetCounts(pc, &counts));
  *applications = counts.amg_applies;
  PetscFunctionReturn(0);
}

/* Largest |J x - g| */
static PetscErrorCode Opening(Blocks *b, Vec x, PetscReal *largest)
{
  Vec r;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(b->q.g, &r));
  PetscCall(MatMult(b->q.J, x, r));
  PetscCall(VecAXPY(r, -1.0, b->q.g));
  PetscCall(VecNorm(r, NORM_INFINITY, largest));
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(0);
}

/* The solution of [H J^T; J 0] (x, y) = (b, g) by LU of the whole */
static PetscErrorCode SolveByLU(Blocks *b, Vec x)
{
  Mat blocks[4] = {b->q.H, NULL, b->q.J, NULL}, nest, K;
  Vec rhs, solution, part;
  IS  rows[2];
  KSP ksp;
  PC  pc;

  PetscFunctionBeginUser;
  PetscCall(MatTranspose(b->q.J, MAT_INITIAL_MATRIX, &blocks[1]));
  PetscCall(MatCreateNest(PETSC_COMM_WORLD, 2, NULL, 2, NULL, blocks, &nest));
  PetscCall(MatNestGetISs(nest, rows, NULL));
  PetscCall(MatConvert(nest, MATAIJ, MAT_INITIAL_MATRIX, &K));
  PetscCall(MatCreateVecs(K, &solution, &rhs));
  PetscCall(VecISCopy(rhs, rows[0], SCATTER_FORWARD, b->q.b));
  PetscCall(VecISCopy(rhs, rows[1], SCATTER_FORWARD, b->q.g));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &ksp));
  PetscCall(KSPSetOperators(ksp, K, K));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCLU));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(KSPSolve(ksp, rhs, solution));
  PetscCall(VecGetSubVector(solution, rows[0], &part));
  PetscCall(VecCopy(part, x));
  PetscCall(VecRestoreSubVector(solution, rows[0], &part));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&rhs));
  PetscCall(VecDestroy(&solution));
  PetscCall(MatDestroy(&blocks[1]));
  PetscCall(MatDestroy(&nest));
  PetscCall(MatDestroy(&K));
  PetscFunctionReturn(0);
}

/* What was done about the ties, by what the solver says of itself */
static PetscErrorCode ReportMethod(Tao tao)
{
  TaoIPFilterFallbacks count;
  PetscInt             shifted;
  KSP                  ksp;
  PC                   pc;
  PCAMGFCounts         counts;

  PetscFunctionBeginUser;
  PetscCall(TaoIPFilterGetFallbacks(tao, &count));
  PetscCall(TaoIPFilterGetRegularizations(tao, &shifted, NULL, NULL));
  PetscCall(TaoGetKSP(tao, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCAMGFGetCounts(pc, &counts));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s, %s, %s\n", counts.filter_applies ? "filtered" : "not filtered",
    count.direct ? "MUMPS on the whole matrix" : "no factorization of the whole matrix",
    shifted ? "a SHIFTED Hessian" : "no shift"));
  PetscFunctionReturn(0);
}

/* Small blocks against LU; the ties are to cost no more than as many applications of the AMG again, of which there
   are 9 */
static PetscErrorCode TestBlocks(const char name[], PetscReal stiffer, PetscReal soften, PetscInt times)
{
  Blocks b        = {.stiffer = stiffer, .soften = soften, .times = 1},
         repeated = {.stiffer = stiffer, .soften = soften, .times = times};
  Vec       x, exact;
  Tao       tao;
  PetscInt  tied, free;
  PetscReal opening, difference, size;

  PetscFunctionBeginUser;
  PetscCall(CreateBlocks(8, 24, &b));
  PetscCall(CreateBlocks(8, 24, &repeated));
  PetscCall(VecDuplicate(b.q.b, &x));
  PetscCall(VecDuplicate(b.q.b, &exact));
  PetscCall(SolveByLU(&b, exact));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", name));
  PetscCall(SolveBlocks(&repeated, PETSC_TRUE, x, &tao, &tied));
  PetscCall(ReportMethod(tao));
  PetscCall(TaoDestroy(&tao));
  PetscCall(Opening(&b, x, &opening));
  PetscCall(VecNorm(exact, NORM_INFINITY, &size));
  PetscCall(VecAXPY(exact, -1.0, x));
  PetscCall(VecNorm(exact, NORM_INFINITY, &difference));
  PetscCall(ProblemVerdict("  ties open by", opening / size, 1e-10));
  PetscCall(ProblemVerdict("  difference from LU", difference / size, 1e-6));
  if (soften == 0.0) {
    PetscCall(SolveBlocks(&b, PETSC_FALSE, x, &tao, &free));
    PetscCall(TaoDestroy(&tao));
    PetscCall(ProblemVerdict("  AMG applications, of those without ties", (PetscReal)tied / free, 2.0));
  }
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&exact));
  PetscCall(DestroyBlocks(&b));
  PetscCall(DestroyBlocks(&repeated));
  PetscFunctionReturn(0);
}

/* With weights far too small the updates of the multipliers do not come to an end: the augmented system takes over */
static PetscErrorCode TestWeak(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_proximal", "1e3"));
  PetscCall(TestBlocks("weights too small", 10.0, 0.0, 1));
  PetscCall(PetscOptionsClearValue(NULL, "-tao_ipfilter_proximal"));
  PetscFunctionReturn(0);
}

/* Ties that contradict each other cannot be met */
static PetscErrorCode TestContradiction(void)
{
  Blocks             b = {.stiffer = 1.0, .times = 2, .contradiction = 0.01};
  Vec                x;
  Tao                tao;
  PetscInt           applications;
  const char        *sentence;
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(CreateBlocks(8, 24, &b));
  PetscCall(VecDuplicate(b.q.b, &x));
  PetscCall(SolveBlocks(&b, PETSC_TRUE, x, &tao, &applications));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "ties that contradict each other: %s, \"%.30s...\"\n",
    TaoConvergedReasons[reason], sentence));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyBlocks(&b));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(TestBlocks("two blocks", 10.0, 0.0, 1));
  PetscCall(TestBlocks("a thousand times as stiff", 1000.0, 0.0, 1));
  PetscCall(TestBlocks("convex on the ties alone", 0.1, 0.05, 1));
  PetscCall(TestBlocks("every tie three times", 10.0, 0.0, 3));
  PetscCall(TestWeak());
  PetscCall(TestContradiction());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}

TEST*/
