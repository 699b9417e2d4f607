/* Shared by the tests of TAOIPFILTER with matrices of every type */
#ifndef IPFILTER_MATRICES_H
#define IPFILTER_MATRICES_H

#include "../lib/attempt.h"
#include <petsccompat.h>
#include "ipfilter_problem.h"

/* min 1/2 x^T H x - b^T x subject to J x - g >= 0, E x - e = 0 and -1 <= x <= 1 */
typedef struct {
  QuadraticProgram q;
  Mat              E;
  Vec              e;
  PetscBool        fixed; /* x_3 = 1/4, too */
} Program;

/* Number in (0, 1) that depends on i and j alone */
static inline PetscReal Noise(PetscInt i, PetscInt j)
{
  const PetscReal v = PetscAbsReal(PetscSinReal(12.9898 * (i + 1) + 78.233 * (j + 1))) * 43758.5453;

  return v - PetscFloorReal(v);
}

/* A band of blocks of two, diagonally dominant */
static inline PetscErrorCode CreateHessian(PetscInt n, Mat *H)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(MatCreate(PETSC_COMM_WORLD, H));
  PetscCall(MatSetSizes(*H, PETSC_DECIDE, PETSC_DECIDE, n, n));
  PetscCall(MatSetBlockSize(*H, 2));
  PetscCall(MatSetType(*H, MATAIJ));
  PetscCall(MatSetUp(*H));
  PetscCall(MatSetOption(*H, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatGetOwnershipRange(*H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++)
    for (PetscInt j = PetscMax(0, i / 2 * 2 - 2); j < PetscMin(n, i / 2 * 2 + 4); j++)
      PetscCall(MatSetValue(*H, i, j, i == j ? 8.0 : -Noise(PetscMin(i, j), PetscMax(i, j)), INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(*H, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* m rows of two entries far apart, from a place on, and their right-hand side */
static inline PetscErrorCode CreateRows(PetscInt m, PetscInt place, Vec layout, Mat *J, Vec *g)
{
  PetscInt n, N, lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(layout, &n));
  PetscCall(VecGetSize(layout, &N));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, n, m, N, 2, NULL, 2, NULL, J));
  PetscCall(MatCreateVecs(*J, NULL, g));
  PetscCall(MatGetOwnershipRange(*J, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    for (PetscInt k = 0; k < 2; k++)
      PetscCall(MatSetValue(*J, i, (place + 2 * i + k * (N / 2)) % N, 0.5 + Noise(i, place + k), INSERT_VALUES));
    PetscCall(VecSetValue(*g, i, 0.1 + 0.2 * Noise(i, 2000 + place), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(*g));
  PetscCall(VecAssemblyEnd(*g));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode CreateProgram(PetscInt n, Program *p)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  *p = (Program){.fixed = PETSC_FALSE};
  PetscCall(CreateHessian(n, &p->q.H));
  PetscCall(MatCreateVecs(p->q.H, &p->q.b, NULL));
  PetscCall(VecGetOwnershipRange(p->q.b, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(p->q.b, i, 12.0 * (Noise(i, 7) - 0.5), INSERT_VALUES));
  PetscCall(VecAssemblyBegin(p->q.b));
  PetscCall(VecAssemblyEnd(p->q.b));
  PetscCall(CreateRows(5, 0, p->q.b, &p->q.J, &p->q.g));
  PetscCall(CreateRows(4, 11, p->q.b, &p->E, &p->e));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode DestroyProgram(Program *p)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&p->q));
  PetscCall(MatDestroy(&p->E));
  PetscCall(VecDestroy(&p->e));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ShellMult(Mat S, Vec x, Vec y)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatMult(A, x, y));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ShellMultTranspose(Mat S, Vec x, Vec y)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatMultTranspose(A, x, y));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ShellGetDiagonal(Mat S, Vec d)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatGetDiagonal(A, d));
  PetscFunctionReturn(0);
}

/* Products with A, and its diagonal if asked for */
static inline PetscErrorCode CreateShell(Mat A, PetscBool diagonal, Mat *S)
{
  PetscInt m, n, M, N;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(A, &m, &n));
  PetscCall(MatGetSize(A, &M, &N));
  PetscCall(MatCreateShell(PETSC_COMM_WORLD, m, n, M, N, A, S));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT, (AMGFOperation *)ShellMult));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT_TRANSPOSE, (AMGFOperation *)ShellMultTranspose));
  if (diagonal) PetscCall(MatShellSetOperation(*S, MATOP_GET_DIAGONAL, (AMGFOperation *)ShellGetDiagonal));
  PetscFunctionReturn(0);
}

/* Blocks of two halves of each rank's columns, and of its rows where A is square; the last block a shell if asked for
 */
static inline PetscErrorCode CreateNest(Mat A, PetscBool shell, Mat *nest)
{
  IS       rows[2], cols[2];
  Mat      blocks[4], last;
  PetscInt lo, hi, clo, chi, M, N, m;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(A, &M, &N));
  PetscCall(MatGetOwnershipRange(A, &lo, &hi));
  PetscCall(MatGetOwnershipRangeColumn(A, &clo, &chi));
  m = M == N ? 2 : 1;
  for (PetscInt k = 0; k < 2; k++) {
    const PetscInt begin = k ? (clo + chi) / 2 : clo, end = k ? chi : (clo + chi) / 2;

    PetscCall(ISCreateStride(PETSC_COMM_WORLD, end - begin, begin, 1, &cols[k]));
    if (m == 1) PetscCall(ISCreateStride(PETSC_COMM_WORLD, hi - lo, lo, 1, &rows[k]));
    else PetscCall(ISCreateStride(PETSC_COMM_WORLD, end - begin, begin, 1, &rows[k]));
  }
  for (PetscInt k = 0; k < 2 * m; k++)
    PetscCall(MatCreateSubMatrix(A, rows[k / 2], cols[k % 2], MAT_INITIAL_MATRIX, &blocks[k]));
  last = blocks[2 * m - 1];
  if (shell) {
    PetscCall(CreateShell(last, PETSC_FALSE, &blocks[2 * m - 1]));
    PetscCall(PetscObjectCompose((PetscObject)blocks[2 * m - 1], "entries", (PetscObject)last));
    PetscCall(MatDestroy(&last));
  }
  PetscCall(MatCreateNest(PETSC_COMM_WORLD, m, rows, 2, cols, blocks, nest));
  for (PetscInt k = 0; k < 2 * m; k++) PetscCall(MatDestroy(&blocks[k]));
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(ISDestroy(&rows[k]));
    PetscCall(ISDestroy(&cols[k]));
  }
  PetscFunctionReturn(0);
}

/* A as another type, or what is called so here; A becomes a diagonal one for the type that is no more */
static inline PetscErrorCode CreateAs(Mat A, const char type[], Mat *B)
{
  PetscBool shell, diagonal, nest, blocked, transpose, constant;

  PetscFunctionBeginUser;
  PetscCall(PetscStrcmp(type, "shell", &shell));
  PetscCall(PetscStrcmp(type, "shell with diagonal", &diagonal));
  PetscCall(PetscStrcmp(type, "nest", &nest));
  PetscCall(PetscStrcmp(type, "nest with a shell", &blocked));
  PetscCall(PetscStrcmp(type, "transpose", &transpose));
  PetscCall(PetscStrcmp(type, MATCONSTANTDIAGONAL, &constant));
  if (shell || diagonal) PetscCall(CreateShell(A, diagonal, B));
  else if (nest || blocked) PetscCall(CreateNest(A, blocked, B));
  else if (transpose) {
    Mat At;

    PetscCall(MatTranspose(A, MAT_INITIAL_MATRIX, &At));
    PetscCall(MatCreateTranspose(At, B));
    PetscCall(MatDestroy(&At));
  } else if (constant) {
    PetscInt n, N;

    PetscCall(MatZeroEntries(A));
    PetscCall(MatShift(A, 8.0));
    PetscCall(MatGetLocalSize(A, &n, NULL));
    PetscCall(MatGetSize(A, &N, NULL));
    PetscCall(MatCreateConstantDiagonal(PETSC_COMM_WORLD, n, n, N, N, 8.0, B));
  } else PetscCall(MatConvert(A, type, MAT_INITIAL_MATRIX, B));
  PetscFunctionReturn(0);
}

/* A preconditioner of the user's: division by a constant */
static inline PetscErrorCode Divide(PC pc, Vec r, Vec z)
{
  PetscFunctionBeginUser;
  (void)pc;
  PetscCall(VecAXPBY(z, 0.125, 0.0, r));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode Equation(Tao tao, Vec x, Vec c, void *user)
{
  Program *p = (Program *)user;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(p->E, x, c));
  PetscCall(VecAXPY(c, -1.0, p->e));
  PetscFunctionReturn(0);
}

/* A Tao for the program with the given matrices, without those that are NULL */
static inline PetscErrorCode CreateTao(Program *p, Mat H, Mat J, Mat E, const char options[], Vec x, Tao *tao)
{
  QuadraticProgram unconstrained = {.H = H, .b = p->q.b};
  Vec              lower, upper, c;
  PetscOptions     own;
  KSP              ksp;
  PC               pc;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsCreate(&own));
  PetscCall(PetscOptionsInsertString(own, options));
  PetscCall(PetscOptionsPush(own));
  PetscCall(ProblemCreateSolver(&unconstrained, x, tao));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, ProblemObjectiveAndGradient, &p->q));
  if (J) {
    PetscCall(VecDuplicate(p->q.g, &c));
    PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, ProblemConstraints, &p->q));
    PetscCall(TaoSetJacobianInequalityRoutine(*tao, J, J, ProblemConstant, NULL));
    PetscCall(VecDestroy(&c));
  }
  if (E) {
    PetscCall(VecDuplicate(p->e, &c));
    PetscCall(TaoSetEqualityConstraintsRoutine(*tao, c, Equation, p));
    PetscCall(TaoSetJacobianEqualityRoutine(*tao, E, E, ProblemConstant, NULL));
    PetscCall(VecDestroy(&c));
  }
  PetscCall(VecDuplicate(x, &lower));
  PetscCall(VecDuplicate(x, &upper));
  PetscCall(VecSet(lower, -1.0));
  PetscCall(VecSet(upper, 1.0));
  if (p->fixed) {
    PetscInt lo, hi;

    PetscCall(VecGetOwnershipRange(x, &lo, &hi));
    if (lo <= 3 && 3 < hi) {
      PetscCall(VecSetValue(lower, 3, 0.25, INSERT_VALUES));
      PetscCall(VecSetValue(upper, 3, 0.25, INSERT_VALUES));
    }
    PetscCall(VecAssemblyBegin(lower));
    PetscCall(VecAssemblyEnd(lower));
    PetscCall(VecAssemblyBegin(upper));
    PetscCall(VecAssemblyEnd(upper));
  }
  PetscCall(TaoSetVariableBounds(*tao, lower, upper));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(TaoGetKSP(*tao, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCShellSetApply(pc, Divide)); /* of other types nothing comes of it */
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(&own));
  PetscFunctionReturn(0);
}

/* Solves from zero, or says why not */
static inline PetscErrorCode Solve(Program *p, Mat H, Mat J, Mat E, const char options[], Vec x, PetscErrorCode *error,
  TaoConvergedReason *reason)
{
  Tao tao;

  PetscFunctionBeginUser;
  PetscCall(CreateTao(p, H, J, E, options, x, &tao));
  PetscCall(VecSet(x, 0.0));
  PetscCall(AttemptBegin());
  *error = TaoSolve(tao);
  PetscCall(AttemptEnd());
  PetscCall(TaoGetConvergedReason(tao, reason));
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}

#endif
