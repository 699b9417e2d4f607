static char help[] = "Hessians and Jacobians of every type: the solution is that with AIJ, or one sentence says what is refused.\n\n";

#include "attempt.h"
#include "ipfilter_problem.h"

/* min 1/2 x^T H x - b^T x subject to J x - g >= 0, E x - e = 0 and -1 <= x <= 1 */
typedef struct {
  QuadraticProgram q;
  Mat              E;
  Vec              e;
  PetscBool        fixed; /* x_3 = 1/4, too */
} Program;

/* Number in (0, 1) that depends on i and j alone */
static PetscReal Noise(PetscInt i, PetscInt j)
{
  const PetscReal v = PetscAbsReal(PetscSinReal(12.9898 * (i + 1) + 78.233 * (j + 1))) * 43758.5453;

  return v - PetscFloorReal(v);
}

/* A band of blocks of two, diagonally dominant */
static PetscErrorCode CreateHessian(PetscInt n, Mat *H)
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
    for (PetscInt j = PetscMax(0, i / 2 * 2 - 2); j < PetscMin(n, i / 2 * 2 + 4); j++) PetscCall(MatSetValue(*H, i, j, i == j ? 8.0 : -Noise(PetscMin(i, j), PetscMax(i, j)), INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(*H, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* m rows of two entries far apart, from a place on, and their right-hand side */
static PetscErrorCode CreateRows(PetscInt m, PetscInt place, Vec layout, Mat *J, Vec *g)
{
  PetscInt n, N, lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(layout, &n));
  PetscCall(VecGetSize(layout, &N));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, n, m, N, 2, NULL, 2, NULL, J));
  PetscCall(MatCreateVecs(*J, NULL, g));
  PetscCall(MatGetOwnershipRange(*J, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    for (PetscInt k = 0; k < 2; k++) PetscCall(MatSetValue(*J, i, (place + 2 * i + k * (N / 2)) % N, 0.5 + Noise(i, place + k), INSERT_VALUES));
    PetscCall(VecSetValue(*g, i, 0.1 + 0.2 * Noise(i, 2000 + place), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(*g));
  PetscCall(VecAssemblyEnd(*g));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateProgram(PetscInt n, Program *p)
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

static PetscErrorCode DestroyProgram(Program *p)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&p->q));
  PetscCall(MatDestroy(&p->E));
  PetscCall(VecDestroy(&p->e));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShellMult(Mat S, Vec x, Vec y)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatMult(A, x, y));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShellMultTranspose(Mat S, Vec x, Vec y)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatMultTranspose(A, x, y));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShellGetDiagonal(Mat S, Vec d)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatGetDiagonal(A, d));
  PetscFunctionReturn(0);
}

/* Products with A, and its diagonal if asked for */
static PetscErrorCode CreateShell(Mat A, PetscBool diagonal, Mat *S)
{
  PetscInt m, n, M, N;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(A, &m, &n));
  PetscCall(MatGetSize(A, &M, &N));
  PetscCall(MatCreateShell(PETSC_COMM_WORLD, m, n, M, N, A, S));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT, (void (*)(void))ShellMult));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT_TRANSPOSE, (void (*)(void))ShellMultTranspose));
  if (diagonal) PetscCall(MatShellSetOperation(*S, MATOP_GET_DIAGONAL, (void (*)(void))ShellGetDiagonal));
  PetscFunctionReturn(0);
}

/* Blocks of two halves of each rank's columns, and of its rows where A is square; the last block a shell if asked for */
static PetscErrorCode CreateNest(Mat A, PetscBool shell, Mat *nest)
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
  for (PetscInt k = 0; k < 2 * m; k++) PetscCall(MatCreateSubMatrix(A, rows[k / 2], cols[k % 2], MAT_INITIAL_MATRIX, &blocks[k]));
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
static PetscErrorCode CreateAs(Mat A, const char type[], Mat *B)
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
static PetscErrorCode Divide(PC pc, Vec r, Vec z)
{
  PetscFunctionBeginUser;
  (void)pc;
  PetscCall(VecAXPBY(z, 0.125, 0.0, r));
  PetscFunctionReturn(0);
}

static PetscErrorCode Equation(Tao tao, Vec x, Vec c, void *user)
{
  Program *p = (Program *)user;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(p->E, x, c));
  PetscCall(VecAXPY(c, -1.0, p->e));
  PetscFunctionReturn(0);
}

/* A Tao for the program with the given matrices, without those that are NULL */
static PetscErrorCode CreateTao(Program *p, Mat H, Mat J, Mat E, const char options[], Vec x, Tao *tao)
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
static PetscErrorCode Solve(Program *p, Mat H, Mat J, Mat E, const char options[], Vec x, PetscErrorCode *error, TaoConvergedReason *reason)
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

/* One combination of types against AIJ; no J, no E: without these constraints */
static PetscErrorCode Test(PetscInt n, const char Htype[], const char Jtype[], const char Etype[], const char options[])
{
  Program            p;
  Mat                H, J = NULL, E = NULL;
  Vec                x, exact;
  PetscErrorCode     error;
  TaoConvergedReason reason;
  PetscReal          difference;
  PetscBool          sbaij;

  PetscFunctionBeginUser;
  PetscCall(CreateProgram(n, &p));
  PetscCall(PetscStrcmp(Htype, MATSBAIJ, &sbaij));
  p.fixed = sbaij ? PETSC_FALSE : PETSC_TRUE; /* PETSc does not zero columns of SBAIJ on several ranks */
  PetscCall(VecDuplicate(p.q.b, &x));
  PetscCall(VecDuplicate(p.q.b, &exact));
  PetscCall(CreateAs(p.q.H, Htype, &H));
  if (Jtype) PetscCall(CreateAs(p.q.J, Jtype, &J));
  if (Etype) PetscCall(CreateAs(p.E, Etype, &E));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "H %s, J %s, E %s%s%s: ", Htype, Jtype ? Jtype : "none", Etype ? Etype : "none", options[0] ? ", " : "", options));
  PetscCall(Solve(&p, H, J, E, options, x, &error, &reason));
  PetscCall(AttemptCompareRanks(Htype, error));
  if (error) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", attempt_sentence));
  else {
    PetscCall(Solve(&p, p.q.H, J ? p.q.J : NULL, E ? p.E : NULL, "-tao_ipfilter_direct", exact, &error, &reason));
    PetscCall(VecAXPY(x, -1.0, exact));
    PetscCall(VecNorm(x, NORM_INFINITY, &difference));
    if (difference < 1e-5) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "as with aij\n"));
    else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "OFF BY %g, %s\n", (double)difference, TaoConvergedReasons[reason]));
  }
  PetscCall(MatDestroy(&H));
  PetscCall(MatDestroy(&J));
  PetscCall(MatDestroy(&E));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&exact));
  PetscCall(DestroyProgram(&p));
  PetscFunctionReturn(0);
}

/* The vectors that go with a nest are nests, too */
static PetscErrorCode TestNestedVector(void)
{
  Program            p;
  Mat                H;
  Vec                x, parts[2];
  PetscErrorCode     error;
  TaoConvergedReason reason;
  IS                 rows[2];

  PetscFunctionBeginUser;
  PetscCall(CreateProgram(40, &p));
  PetscCall(CreateNest(p.q.H, PETSC_FALSE, &H));
  PetscCall(MatNestGetISs(H, rows, NULL));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecGetSubVector(p.q.b, rows[k], &parts[k]));
  PetscCall(VecCreateNest(PETSC_COMM_WORLD, 2, rows, parts, &x));
  PetscCall(Solve(&p, H, NULL, NULL, "", x, &error, &reason));
  PetscCall(AttemptCompareRanks("nested vector", error));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "nested vector: %s\n", error ? attempt_sentence : "NOT REFUSED"));
  PetscCall(VecDestroy(&x));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecRestoreSubVector(p.q.b, rows[k], &parts[k]));
  PetscCall(MatDestroy(&H));
  PetscCall(DestroyProgram(&p));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *const hessians[]  = {MATAIJ, MATBAIJ, MATSBAIJ, MATDENSE, "nest", MATIS, MATCONSTANTDIAGONAL, "shell", "shell with diagonal", "nest with a shell", "transpose"};
  const char *const jacobians[] = {MATBAIJ, MATDENSE, "nest", MATIS, "shell", "nest with a shell", "transpose"};
  const char *const products[]  = {"-tao_ipfilter_pc_type none", "-tao_ipfilter_pc_type jacobi", "-tao_ipfilter_pc_type shell"};
  const PetscInt    few = 40, many = 1002;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(hessians); k++) {
    PetscCall(Test(few, hessians[k], NULL, NULL, ""));
    PetscCall(Test(few, hessians[k], MATAIJ, NULL, ""));
    PetscCall(Test(few, hessians[k], MATAIJ, MATAIJ, ""));
    PetscCall(Test(few, hessians[k], MATAIJ, MATAIJ, "-tao_ipfilter_equality condensed"));
  }
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(jacobians); k++) {
    PetscCall(Test(few, MATAIJ, jacobians[k], MATAIJ, ""));
    PetscCall(Test(few, MATAIJ, MATAIJ, jacobians[k], ""));
  }
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(products); k++) {
    PetscCall(Test(many, "shell", MATAIJ, NULL, products[k]));
    PetscCall(Test(many, "shell with diagonal", "nest", NULL, products[k]));
  }
  PetscCall(Test(many, "shell", MATAIJ, NULL, ""));
  PetscCall(Test(many, "shell", MATAIJ, NULL, "-tao_ipfilter_pc_type none -tao_ipfilter_direct"));
  PetscCall(Test(many, "shell", MATAIJ, MATAIJ, "-tao_ipfilter_pc_type none"));
  PetscCall(Test(many, "nest with a shell", MATAIJ, NULL, ""));
  PetscCall(Test(many, MATAIJ, "shell", NULL, ""));
  PetscCall(Test(many, MATAIJ, MATAIJ, "shell", ""));
  PetscCall(TestNestedVector());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}

TEST*/
