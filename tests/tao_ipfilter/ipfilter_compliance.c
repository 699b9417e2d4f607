static char help[] =
  "A string pressed onto supports that yield: constraints with compliance, with and without norm terms.\n\n";

#include "ipfilter_problem.h"

/* A string of n points, held at both ends, with a support below every third point; every second support yields */
typedef struct {
  QuadraticProgram q;
  PetscReal        quartic; /* factor of the sum of x^4 / 4 in the objective */
  Mat              H;       /* Hessian, if it is not constant */
  Vec              mass, compliance;
} String;

static PetscErrorCode Objective(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  const String      *s = (String *)user;
  const PetscScalar *a;
  PetscScalar       *out;
  PetscInt           n;
  PetscReal          sum = 0.0;

  PetscFunctionBeginUser;
  PetscCall(ProblemObjectiveAndGradient(tao, x, f, g, user));
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(x, &a));
  PetscCall(VecGetArray(g, &out));
  for (PetscInt i = 0; i < n; i++) {
    sum += 0.25 * s->quartic * PetscSqr(PetscSqr(PetscRealPart(a[i])));
    out[i] += s->quartic * a[i] * a[i] * a[i];
  }
  PetscCall(VecRestoreArray(g, &out));
  PetscCall(VecRestoreArrayRead(x, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  *f += sum;
  PetscFunctionReturn(0);
}

static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat P, void *user)
{
  const String *s = (String *)user;
  Vec           squares;

  PetscFunctionBeginUser;
  (void)tao, (void)P;
  PetscCall(VecDuplicate(x, &squares));
  PetscCall(VecPointwiseMult(squares, x, x));
  PetscCall(VecScale(squares, 3.0 * s->quartic));
  PetscCall(MatCopy(s->q.H, H, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalSet(H, squares, ADD_VALUES));
  PetscCall(VecDestroy(&squares));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateString(PetscInt n, PetscReal quartic, String *s)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  s->quartic = quartic;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, n, n, 3, NULL, 2, NULL, &s->q.H));
  PetscCall(MatCreateVecs(s->q.H, &s->q.b, NULL));
  PetscCall(MatGetOwnershipRange(s->q.H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    const PetscInt    column[3] = {i - 1, i, i + 1 < n ? i + 1 : -1};
    const PetscScalar entry[3]  = {-1.0, 2.0, -1.0};

    PetscCall(MatSetValues(s->q.H, 1, &i, 3, column, entry, INSERT_VALUES));
    PetscCall(VecSetValue(s->q.b, i, i < n / 2 ? -0.3 : 0.1, INSERT_VALUES)); /* only a part is pressed down */
  }
  PetscCall(MatAssemblyBegin(s->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(s->q.b));
  PetscCall(VecAssemblyEnd(s->q.b));
  PetscCall(MatDuplicate(s->q.H, MAT_COPY_VALUES, &s->H));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, hi - lo, n / 3, n, 1, NULL, 1, NULL, &s->q.J));
  PetscCall(MatCreateVecs(s->q.J, NULL, &s->q.g));
  PetscCall(VecDuplicate(s->q.g, &s->mass));
  PetscCall(VecDuplicate(s->q.g, &s->compliance));
  PetscCall(MatGetOwnershipRange(s->q.J, &lo, &hi));
  for (PetscInt r = lo; r < hi; r++) { /* rows of very different sizes, which the optimizer scales */
    const PetscReal size = r == 2 ? 1e5 : 1.0;

    PetscCall(MatSetValue(s->q.J, r, 3 * r + 1, size, INSERT_VALUES));
    PetscCall(VecSetValue(s->q.g, r, -0.1 * size, INSERT_VALUES));
    PetscCall(VecSetValue(s->mass, r, 1.0 + r % 4, INSERT_VALUES));
    PetscCall(VecSetValue(s->compliance, r, r % 2 ? 0.0 : size * size * (0.1 + r), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(s->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->q.J, MAT_FINAL_ASSEMBLY));
  for (Vec *v = (Vec[]){s->q.g, s->mass, s->compliance, NULL}; *v; v++) {
    PetscCall(VecAssemblyBegin(*v));
    PetscCall(VecAssemblyEnd(*v));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyString(String *s)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&s->q));
  PetscCall(MatDestroy(&s->H));
  PetscCall(VecDestroy(&s->mass));
  PetscCall(VecDestroy(&s->compliance));
  PetscFunctionReturn(0);
}

/* Checks c + C lambda >= 0, lambda >= 0, and that one of them is zero, in the unit of each row. Some row must be soft
   and closed. */
static PetscErrorCode Check(Tao tao, String *s, Vec x, const char name[])
{
  Vec                c, z, v[4];
  const PetscScalar *a[4];
  PetscInt           n, start;
  PetscReal          worst = 0.0, soft = 0.0;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(s->q.g, &c));
  PetscCall(ProblemConstraints(tao, x, c, s));
  PetscCall(TaoIPFilterGetMultiplier(tao, &z));
  v[0] = c, v[1] = z, v[2] = s->compliance, v[3] = s->q.g;
  PetscCall(VecGetOwnershipRange(c, &start, NULL));
  PetscCall(VecGetLocalSize(c, &n));
  for (PetscInt k = 0; k < 4; k++) PetscCall(VecGetArrayRead(v[k], &a[k]));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal size = PetscAbsScalar(a[3][i]), lambda = PetscRealPart(a[1][i]) * size,
                    open = PetscRealPart(a[0][i] + a[2][i] * a[1][i]) / size;

    worst = PetscMax(worst, PetscAbsReal(PetscMin(lambda, open)));
    if (PetscRealPart(a[2][i]) > 0.0) soft = PetscMax(soft, lambda);
  }
  for (PetscInt k = 0; k < 4; k++) PetscCall(VecRestoreArrayRead(v[k], &a[k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &soft, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCall(ProblemVerdict(name, soft > 1e-3 ? worst : PETSC_INFINITY, 1e-8));
  PetscCall(VecDestroy(&c));
  PetscFunctionReturn(0);
}

/* terms: norm terms with Coulomb's law at each support, whose slip are the displacements beside it */
static PetscErrorCode Solve(PetscReal quartic, PetscBool terms, const char name[])
{
  String             s = {.quartic = 0.0};
  Vec                x, t = NULL, coefficient = NULL;
  Mat                T = NULL;
  Tao                tao;
  TaoConvergedReason reason;
  PetscInt           lo, hi, n;

  PetscFunctionBeginUser;
  PetscCall(CreateString(60, quartic, &s));
  PetscCall(VecDuplicate(s.q.b, &x));
  PetscCall(ProblemCreateSolver(&s.q, x, &tao));
  if (quartic > 0.0) {
    PetscCall(TaoSetObjectiveAndGradient(tao, NULL, Objective, &s));
    PetscCall(TaoSetHessian(tao, s.H, s.H, Hessian, &s));
  }
  PetscCall(TaoSetTolerances(tao, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TaoIPFilterSetSlackMass(tao, s.mass));
  PetscCall(TaoIPFilterSetCompliance(tao, s.compliance));
  if (terms) {
    PetscCall(MatGetOwnershipRange(s.q.J, &lo, &hi));
    PetscCall(MatGetLocalSize(s.q.J, NULL, &n));
    PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, 2 * (hi - lo), n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 1, NULL, &T));
    PetscCall(MatCreateVecs(T, NULL, &t));
    PetscCall(VecDuplicate(s.q.g, &coefficient));
    PetscCall(VecSet(coefficient, 0.3));
    for (PetscInt r = lo; r < hi; r++) PetscCall(MatSetValue(T, 2 * r, 3 * r + 2, 1.0, INSERT_VALUES));
    PetscCall(MatAssemblyBegin(T, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(T, MAT_FINAL_ASSEMBLY));
    PetscCall(TaoIPFilterSetNormTerms(tao, T, t, NULL, coefficient));
  }
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  if (reason <= 0) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", name, TaoConvergedReasons[reason]));
  PetscCall(Check(tao, &s, x, name));
  PetscCall(TaoDestroy(&tao));
  PetscCall(MatDestroy(&T));
  PetscCall(VecDestroy(&t));
  PetscCall(VecDestroy(&coefficient));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyString(&s));
  PetscFunctionReturn(0);
}

/* Bounds of the unknowns exclude the subspace method, which compliance requires */
static PetscErrorCode SolveWithBounds(void)
{
  String      s = {.quartic = 0.0};
  Vec         x, lower, upper;
  Tao         tao;
  const char *reason;

  PetscFunctionBeginUser;
  PetscCall(CreateString(60, 0.0, &s));
  PetscCall(VecDuplicate(s.q.b, &x));
  PetscCall(VecDuplicate(x, &lower));
  PetscCall(VecDuplicate(x, &upper));
  PetscCall(VecSet(lower, -10.0));
  PetscCall(VecSet(upper, 10.0));
  PetscCall(ProblemCreateSolver(&s.q, x, &tao));
  PetscCall(TaoSetVariableBounds(tao, lower, upper));
  PetscCall(TaoIPFilterSetCompliance(tao, s.compliance));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoIPFilterGetReason(tao, &reason));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "bounds: %s\n", reason));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyString(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(Solve(0.0, PETSC_FALSE, "quadratic"));
  PetscCall(Solve(10.0, PETSC_FALSE, "not quadratic"));
  PetscCall(Solve(0.0, PETSC_TRUE, "with friction"));
  PetscCall(Solve(10.0, PETSC_TRUE, "not quadratic, with friction"));
  PetscCall(SolveWithBounds());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}

TEST*/
