static char help[] =
  "Variables with equal bounds, and bounds on all displacements of an elastic block, beside constraints.\n\n";

#include <petscdmda.h>
#include "ipfilter_problem.h"

/* Trilinear hexahedra of edge h on an n x n x n grid of nodes, E = 1, nu = 0.3. The lower face is held, the upper one
   sheared, by equal bounds: the stiffness itself is singular. */
typedef struct {
  DM               da;
  QuadraticProgram q;
  Vec              lower, upper;
} Block;

/* Row 3 a + i of B^T: how displacement i of node a strains the element (xx yy zz xy yz zx) */
static void StrainRow(const PetscReal grad[3], PetscInt i, PetscReal strain[6])
{
  const PetscInt shear[3][2] = {{0, 1}, {1, 2}, {2, 0}};

  for (PetscInt k = 0; k < 6; k++) strain[k] = 0.0;
  strain[i] = grad[i];
  for (PetscInt k = 0; k < 3; k++) {
    if (shear[k][0] == i) strain[3 + k] += grad[shear[k][1]];
    if (shear[k][1] == i) strain[3 + k] += grad[shear[k][0]];
  }
}

/* Stiffness of an element, nodes in DMDA's order, 2 x 2 x 2 Gauss points */
static void ElementStiffness(PetscReal h, PetscScalar Ke[24 * 24])
{
  const PetscReal lambda = 0.3 / (1.3 * 0.4), mu = 1.0 / 2.6, gauss = 1.0 / PetscSqrtReal(3.0);
  const PetscInt  node[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
     {-1, 1, 1}};

  for (PetscInt k = 0; k < 24 * 24; k++) Ke[k] = 0.0;
  for (PetscInt q = 0; q < 8; q++) {
    PetscReal B[24][6];

    for (PetscInt a = 0; a < 8; a++) {
      PetscReal f[3], grad[3];

      for (PetscInt d = 0; d < 3; d++) f[d] = 1.0 + node[a][d] * gauss * node[q][d];
      for (PetscInt d = 0; d < 3; d++) grad[d] = node[a][d] * f[(d + 1) % 3] * f[(d + 2) % 3] / (4.0 * h);
      for (PetscInt i = 0; i < 3; i++) StrainRow(grad, i, B[3 * a + i]);
    }
    for (PetscInt r = 0; r < 24; r++) {
      for (PetscInt c = 0; c < 24; c++) {
        PetscReal v = lambda * (B[r][0] + B[r][1] + B[r][2]) * (B[c][0] + B[c][1] + B[c][2]);

        for (PetscInt k = 0; k < 6; k++) v += (k < 3 ? 2.0 : 1.0) * mu * B[r][k] * B[c][k];
        Ke[24 * r + c] += v * h * h * h / 8.0;
      }
    }
  }
}

static PetscErrorCode AssembleStiffness(Block *b, PetscReal h)
{
  PetscScalar     Ke[24 * 24];
  PetscInt        ne, nen;
  const PetscInt *elements;

  PetscFunctionBeginUser;
  PetscCall(DMCreateMatrix(b->da, &b->q.H));
  PetscCall(MatSetOption(b->q.H, MAT_SYMMETRIC, PETSC_TRUE));
  ElementStiffness(h, Ke);
  PetscCall(DMDAGetElements(b->da, &ne, &nen, &elements));
  for (PetscInt e = 0; e < ne; e++)
    PetscCall(MatSetValuesBlockedLocal(b->q.H, nen, &elements[nen * e], nen, &elements[nen * e], Ke, ADD_VALUES));
  PetscCall(DMDARestoreElements(b->da, &ne, &nen, &elements));
  PetscCall(MatAssemblyBegin(b->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(b->q.H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Equal bounds on the lower face (0) and for u_x on the upper face (0.1); |u| <= most elsewhere. A downward force on
   the upper face. */
static PetscErrorCode FillBounds(Block *b, PetscReal most)
{
  DMDALocalInfo   info;
  PetscScalar ****l, ****u, ****f;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(b->da, &info));
  PetscCall(DMDAVecGetArrayDOF(b->da, b->lower, &l));
  PetscCall(DMDAVecGetArrayDOF(b->da, b->upper, &u));
  PetscCall(DMDAVecGetArrayDOF(b->da, b->q.b, &f));
  for (PetscInt k = info.zs; k < info.zs + info.zm; k++)
    for (PetscInt j = info.ys; j < info.ys + info.ym; j++)
      for (PetscInt i = info.xs; i < info.xs + info.xm; i++)
        for (PetscInt d = 0; d < 3; d++) {
          const PetscBool top = (PetscBool)(k == info.mz - 1), bottom = (PetscBool)(k == 0);
          const PetscReal fixed = top ? 0.1 : 0.0;

          l[k][j][i][d] = bottom || (top && d == 0) ? fixed : -most;
          u[k][j][i][d] = bottom || (top && d == 0) ? fixed : most;
          f[k][j][i][d] = top && d == 2 ? -0.1 / (info.mx * info.my) : 0.0;
        }
  PetscCall(DMDAVecRestoreArrayDOF(b->da, b->q.b, &f));
  PetscCall(DMDAVecRestoreArrayDOF(b->da, b->upper, &u));
  PetscCall(DMDAVecRestoreArrayDOF(b->da, b->lower, &l));
  PetscFunctionReturn(0);
}

/* u_z + 0.02 >= 0 on the quarter of the upper face next to the origin */
static PetscErrorCode CreateConstraints(Block *b)
{
  DMDALocalInfo info;
  AO            ao;
  PetscInt      count = 0, n, rstart, *cols;

  PetscFunctionBeginUser;
  PetscCall(DMDAGetLocalInfo(b->da, &info));
  PetscCall(DMDAGetAO(b->da, &ao));
  PetscCall(PetscMalloc1(info.xm * info.ym, &cols));
  for (PetscInt j = info.ys; j < info.ys + info.ym; j++)
    for (PetscInt i = info.xs; i < info.xs + info.xm; i++)
      if (info.zs + info.zm == info.mz && 2 * i < info.mx && 2 * j < info.my)
        cols[count++] = i + info.mx * (j + info.my * (info.mz - 1));
  PetscCall(AOApplicationToPetsc(ao, count, cols));
  PetscCall(VecGetLocalSize(b->q.b, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, count, n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 1, NULL, &b->q.J));
  PetscCall(MatGetOwnershipRange(b->q.J, &rstart, NULL));
  for (PetscInt k = 0; k < count; k++) PetscCall(MatSetValue(b->q.J, rstart + k, 3 * cols[k] + 2, 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(b->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(b->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(b->q.J, NULL, &b->q.g));
  PetscCall(VecSet(b->q.g, -0.02));
  PetscCall(PetscFree(cols));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateBlock(PetscInt n, PetscReal most, PetscBool constrained, Block *b)
{
  PetscFunctionBeginUser;
  *b = (Block){.da = NULL};
  PetscCall(DMDACreate3d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_BOX, n, n,
    n, PETSC_DECIDE, PETSC_DECIDE, PETSC_DECIDE, 3, 1, NULL, NULL, NULL, &b->da));
  PetscCall(DMDASetElementType(b->da, DMDA_ELEMENT_Q1));
  PetscCall(DMSetFromOptions(b->da));
  PetscCall(DMSetUp(b->da));
  PetscCall(AssembleStiffness(b, 1.0 / (n - 1)));
  PetscCall(DMCreateGlobalVector(b->da, &b->q.b));
  PetscCall(VecDuplicate(b->q.b, &b->lower));
  PetscCall(VecDuplicate(b->q.b, &b->upper));
  PetscCall(FillBounds(b, most));
  if (constrained) PetscCall(CreateConstraints(b));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyBlock(Block *b)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&b->q));
  PetscCall(VecDestroy(&b->lower));
  PetscCall(VecDestroy(&b->upper));
  PetscCall(DMDestroy(&b->da));
  PetscFunctionReturn(0);
}

/* The same without the fixed variables: their rows and columns eliminated, the rest by MUMPS */
static PetscErrorCode SolveEliminated(Block *b, Vec x)
{
  KSP                ksp;
  PC                 pc;
  Mat                K;
  Vec                rhs;
  const PetscScalar *l, *u;
  PetscScalar       *xa;
  PetscInt           lo, hi, count = 0, *rows;

  PetscFunctionBeginUser;
  PetscCall(MatConvert(b->q.H, MATAIJ, MAT_INITIAL_MATRIX, &K));
  PetscCall(VecDuplicate(b->q.b, &rhs));
  PetscCall(VecCopy(b->q.b, rhs));
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  PetscCall(PetscMalloc1(hi - lo, &rows));
  PetscCall(VecGetArrayRead(b->lower, &l));
  PetscCall(VecGetArrayRead(b->upper, &u));
  PetscCall(VecGetArray(x, &xa));
  for (PetscInt i = lo; i < hi; i++) {
    if (l[i - lo] != u[i - lo]) continue;
    xa[i - lo]    = l[i - lo];
    rows[count++] = i;
  }
  PetscCall(VecRestoreArray(x, &xa));
  PetscCall(VecRestoreArrayRead(b->upper, &u));
  PetscCall(VecRestoreArrayRead(b->lower, &l));
  PetscCall(MatZeroRowsColumns(K, count, rows, 1.0, x, rhs));
  PetscCall(PetscFree(rows));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPSetOperators(ksp, K, K));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(KSPSolve(ksp, rhs, x));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&K));
  PetscCall(VecDestroy(&rhs));
  PetscFunctionReturn(0);
}

/* The constraints, too, as bounds, by PETSc's own TAOTRON, which takes AIJ only */
static PetscErrorCode SolveByTRON(Block *b, Vec x)
{
  Tao                tao;
  Mat                H;
  Vec                lower, raised;
  const PetscScalar *r;
  PetscScalar       *l;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &lower));
  PetscCall(VecDuplicate(x, &raised));
  PetscCall(MatMultTranspose(b->q.J, b->q.g, raised));
  PetscCall(VecCopy(b->lower, lower));
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(raised, &r));
  PetscCall(VecGetArray(lower, &l));
  for (PetscInt i = 0; i < n; i++)
    if (r[i] != 0.0) l[i] = PetscMax(PetscRealPart(l[i]), PetscRealPart(r[i]));
  PetscCall(VecRestoreArray(lower, &l));
  PetscCall(VecRestoreArrayRead(raised, &r));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOTRON));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetVariableBounds(tao, lower, b->upper));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ProblemObjectiveAndGradient, &b->q));
  PetscCall(MatConvert(b->q.H, MATAIJ, MAT_INITIAL_MATRIX, &H));
  PetscCall(TaoSetHessian(tao, H, H, ProblemConstant, NULL));
  PetscCall(TaoSetTolerances(tao, 1e-12, 0.0, 0.0));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&raised));
  PetscCall(MatDestroy(&H));
  PetscFunctionReturn(0);
}

/* The filter holds the unknowns of the constraints and no bounded ones; 0 without constraints */
static PetscErrorCode CheckFilter(Tao tao, Block *b)
{
  KSP       ksp;
  PC        pc;
  PetscBool amgf;
  PetscInt  n, expected = 0, systems, filtered;

  PetscFunctionBeginUser;
  PetscCall(TaoGetKSP(tao, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (b->q.J) PetscCall(MatGetSize(b->q.J, &expected, NULL));
  PetscCall(TaoIPFilterGetFilterUse(tao, &systems, &filtered));
  if (amgf) {
    PetscCall(PCAMGFGetFilterSize(pc, &n));
    if (n != expected || (n > 0) != (filtered > 0) || filtered > systems)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD,
        "filter of %" PetscInt_FMT " unknowns in %" PetscInt_FMT " of %" PetscInt_FMT " systems, for %" PetscInt_FMT
        " constraints\n",
        n, filtered, systems, expected));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Test(PetscInt n, PetscReal most, PetscBool constrained, PetscBool compare)
{
  Block              b;
  Tao                tao;
  Vec                x, reference;
  PetscReal          size, error;
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(CreateBlock(n, most, constrained, &b));
  PetscCall(VecDuplicate(b.q.b, &x));
  PetscCall(ProblemCreateSolver(&b.q, x, &tao));
  PetscCall(TaoSetVariableBounds(tao, b.lower, b.upper));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "%s, %s: %s\n", most < PETSC_INFINITY ? "all bounded" : "free but for the fixed ones",
      constrained ? "constraints" : "no constraints", TaoConvergedReasons[reason]));
  PetscCall(CheckFilter(tao, &b));
  if (compare) {
    PetscCall(VecDuplicate(x, &reference));
    if (most < PETSC_INFINITY) PetscCall(SolveByTRON(&b, reference));
    else PetscCall(SolveEliminated(&b, reference));
    PetscCall(VecNorm(reference, NORM_INFINITY, &size));
    PetscCall(VecAXPY(reference, -1.0, x));
    PetscCall(VecNorm(reference, NORM_INFINITY, &error));
    PetscCall(ProblemVerdict("  difference from the reference, relative", error / size, 1e-6));
    PetscCall(VecDestroy(&reference));
  }
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyBlock(&b));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscInt  n       = 6;
  PetscBool compare = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &n, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-compare", &compare, NULL));
  PetscCall(Test(n, PETSC_INFINITY, PETSC_FALSE, compare));
  PetscCall(Test(n, 0.03, PETSC_TRUE, compare));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_bounds_1.out
      args: -tao_ipfilter_tol 1e-9

      test:
         suffix: aij
         nsize: {{1 2 3}}

      test:
         suffix: baij
         nsize: {{1 3}}
         args: -dm_mat_type baij

      test:
         suffix: jacobi
         nsize: 2
         args: -tao_ipfilter_pc_type jacobi -tao_ipfilter_barrier monotone

TEST*/
