/* Shared by the programs that give TAO the problems of ipfilter_nlp.h, or others in such formulas */
#ifndef IPFILTER_FORMULAS_H
#define IPFILTER_FORMULAS_H

#include <petscamgf.h>
#include "ipfilter_expression.h"
#include "ipfilter_nlp.h"

/* Most constraints of one kind */
#ifndef FORMULAS_MAX
  #define FORMULAS_MAX 16
#endif

/* Constraints of one kind; every rank evaluates with the whole x and sets the rows it owns */
typedef struct {
  PetscInt    n, m; /* unknowns, constraints */
  const char *formula[FORMULAS_MAX];
} Constraints;

typedef struct {
  const NLP  *p;
  PetscInt    n;
  Constraints ci, ce;
  PetscInt    npoints;              /* at which the objective or its gradient was asked for */
  PetscReal   last[EXPRESSION_MAX]; /* of them */
} Formulas;

/* The formulas of a list separated by semicolons */
static inline void FormulasSplit(const char *list, PetscInt n, Constraints *c)
{
  c->n = n;
  c->m = 0;
  while (*list) {
    c->formula[c->m++] = list;
    list += strcspn(list, ";");
    if (*list) list++;
  }
}

static inline void FormulasRead(const NLP *p, Formulas *formulas)
{
  *formulas = (Formulas){.p = p};
  for (const char *s = p->start; *s; s++)
    formulas->n += !isspace((unsigned char)s[0]) && (isspace((unsigned char)s[1]) || !s[1]);
  FormulasSplit(p->inequalities, formulas->n, &formulas->ci);
  FormulasSplit(p->equalities, formulas->n, &formulas->ce);
}

/* Vector of the numbers in text, or bound k (0: lower, 1: upper) of each "lower:upper" in it */
static inline PetscErrorCode FormulasVector(MPI_Comm comm, PetscInt n, const char *text, PetscInt k, Vec *v)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(comm, PETSC_DECIDE, n, v));
  PetscCall(VecGetOwnershipRange(*v, &lo, &hi));
  for (PetscInt i = 0; i < n; i++) {
    const char *entry, *end;
    char       *stop;
    PetscReal   value;

    while (isspace((unsigned char)*text)) text++;
    entry = text;
    text = end = entry + strcspn(entry, " ");
    if (k >= 0) {
      const char *colon = *entry ? strchr(entry, ':') : entry;

      if (k) entry = *entry ? colon + 1 : entry;
      else end = colon;
    }
    value = strtod(entry, &stop);
    if (entry == end || stop == entry) value = k == 1 ? PETSC_INFINITY : PETSC_NINFINITY;
    if (i >= lo && i < hi) PetscCall(VecSetValue(*v, i, value, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(*v));
  PetscCall(VecAssemblyEnd(*v));
  PetscFunctionReturn(0);
}

/* All entries of a short vector on every rank */
static inline PetscErrorCode FormulasGather(Vec v, PetscReal a[])
{
  VecScatter         all;
  Vec                whole;
  PetscInt           n;
  const PetscScalar *w;

  PetscFunctionBeginUser;
  PetscCall(VecScatterCreateToAll(v, &all, &whole));
  PetscCall(VecScatterBegin(all, v, whole, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(all, v, whole, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetSize(whole, &n));
  PetscCall(VecGetArrayRead(whole, &w));
  for (PetscInt i = 0; i < n; i++) a[i] = PetscRealPart(w[i]);
  PetscCall(VecRestoreArrayRead(whole, &w));
  PetscCall(VecScatterDestroy(&all));
  PetscCall(VecDestroy(&whole));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode FormulasObjectiveAndGradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Formulas *ctx = (Formulas *)user;
  PetscReal a[EXPRESSION_MAX];
  PetscInt  lo, hi;
  Jet       jet;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(FormulasGather(x, a));
  if (!ctx->npoints || memcmp(a, ctx->last, (size_t)ctx->n * sizeof(*a))) ctx->npoints++;
  memcpy(ctx->last, a, (size_t)ctx->n * sizeof(*a));
  ExpressionEvaluate(ctx->p->objective, a, NULL, &jet);
  *f = jet.v;
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(g, i, jet.g[i], INSERT_VALUES));
  PetscCall(VecAssemblyBegin(g));
  PetscCall(VecAssemblyEnd(g));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode FormulasConstraints(Tao tao, Vec x, Vec c, void *user)
{
  const Constraints *constraints = (const Constraints *)user;
  PetscReal          a[EXPRESSION_MAX];
  PetscInt           lo, hi;
  Jet                jet;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(FormulasGather(x, a));
  PetscCall(VecGetOwnershipRange(c, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    ExpressionEvaluate(constraints->formula[i], a, NULL, &jet);
    PetscCall(VecSetValue(c, i, jet.v, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(c));
  PetscCall(VecAssemblyEnd(c));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode FormulasJacobian(Tao tao, Vec x, Mat J, Mat Jpre, void *user)
{
  const Constraints *constraints = (const Constraints *)user;
  PetscReal          a[EXPRESSION_MAX];
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  (void)Jpre;
  PetscCall(FormulasGather(x, a));
  PetscCall(MatGetOwnershipRange(J, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    Jet jet;

    ExpressionEvaluate(constraints->formula[i], a, NULL, &jet);
    for (PetscInt j = 0; j < constraints->n; j++) PetscCall(MatSetValue(J, i, j, jet.g[j], INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Adds the Hessians of the constraints times their multipliers */
static inline PetscErrorCode FormulasAddConstraints(const Constraints *c, const PetscReal x[], PetscReal sign,
  Vec multipliers, Jet *sum)
{
  PetscReal y[FORMULAS_MAX];

  PetscFunctionBeginUser;
  if (!c->m) PetscFunctionReturn(0);
  PetscCall(FormulasGather(multipliers, y));
  for (PetscInt i = 0; i < c->m; i++) {
    Jet jet;

    ExpressionEvaluate(c->formula[i], x, NULL, &jet);
    JetAdd(sum, sign * y[i], &jet);
  }
  PetscFunctionReturn(0);
}

/* Hessian of f + DE^T c_E - DI^T c_I */
static inline PetscErrorCode FormulasHessian(Tao tao, Vec x, Mat H, Mat Hpre, void *user)
{
  Formulas *ctx = (Formulas *)user;
  Vec       DE, DI;
  PetscReal a[EXPRESSION_MAX];
  PetscInt  lo, hi;
  Jet       sum;

  PetscFunctionBeginUser;
  (void)Hpre;
  PetscCall(TaoGetDualVariables(tao, &DE, &DI));
  PetscCall(FormulasGather(x, a));
  ExpressionEvaluate(ctx->p->objective, a, NULL, &sum);
  PetscCall(FormulasAddConstraints(&ctx->ce, a, 1.0, DE, &sum));
  PetscCall(FormulasAddConstraints(&ctx->ci, a, -1.0, DI, &sum));
  PetscCall(MatGetOwnershipRange(H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++)
    for (PetscInt j = 0; j < ctx->n; j++) PetscCall(MatSetValue(H, i, j, sum.h[i][j], INSERT_VALUES));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Full pattern, rows laid out as r, columns as c: AIJ, or dense where an option says so */
static inline PetscErrorCode FormulasMatrix(Vec r, Vec c, const char option[], Mat *A)
{
  PetscInt  m, n, M, N;
  PetscBool dense = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, option, &dense, NULL));
  PetscCall(VecGetLocalSize(r, &m));
  PetscCall(VecGetLocalSize(c, &n));
  PetscCall(VecGetSize(r, &M));
  PetscCall(VecGetSize(c, &N));
  if (dense) PetscCall(MatCreateDense(PetscObjectComm((PetscObject)r), m, n, M, N, NULL, A));
  else PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)r), m, n, M, N, n, NULL, N - n, NULL, A));
  PetscFunctionReturn(0);
}

/* Violation of a constraint; relative: as the distance that it takes to mend it, where the row's entries are above 1 */
static inline PetscReal FormulasRowViolation(const char *formula, const PetscReal x[], PetscBool equality,
  PetscBool relative)
{
  Jet       jet;
  PetscReal size = 1.0;

  ExpressionEvaluate(formula, x, NULL, &jet);
  if (PetscIsInfOrNanReal(jet.v)) return PETSC_INFINITY;
  for (PetscInt i = 0; i < EXPRESSION_MAX && relative; i++) size = PetscMax(size, PetscAbsReal(jet.g[i]));
  return (equality ? PetscAbsReal(jet.v) : PetscMax(-jet.v, 0.0)) / size;
}

/* A problem with what TAO takes it by */
typedef struct {
  Formulas formulas;
  Tao      tao;
  Vec      x, xl, xu, ci, ce;
  Mat      H, Ji, Je;
} FormulasProblem;

static inline PetscErrorCode FormulasSetRoutines(FormulasProblem *problem)
{
  Formulas *ctx    = &problem->formulas;
  Tao       tao    = problem->tao;
  PetscBool second = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-hessian", &second, NULL));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, FormulasObjectiveAndGradient, ctx));
  if (second) PetscCall(TaoSetHessian(tao, problem->H, problem->H, FormulasHessian, ctx));
  if (ctx->ci.m) {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, problem->ci, FormulasConstraints, &ctx->ci));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, problem->Ji, problem->Ji, FormulasJacobian, &ctx->ci));
  }
  if (ctx->ce.m) {
    PetscCall(TaoSetEqualityConstraintsRoutine(tao, problem->ce, FormulasConstraints, &ctx->ce));
    PetscCall(TaoSetJacobianEqualityRoutine(tao, problem->Je, problem->Je, FormulasJacobian, &ctx->ce));
  }
  PetscFunctionReturn(0);
}

/* The problem before TAOIPFILTER, or the solver that the options name. It points into itself: not to be copied. */
static inline PetscErrorCode FormulasCreate(MPI_Comm comm, const NLP *p, FormulasProblem *problem)
{
  Formulas *formulas = &problem->formulas;

  PetscFunctionBeginUser;
  FormulasRead(p, formulas);
  PetscCall(FormulasVector(comm, formulas->n, p->start, -1, &problem->x));
  PetscCall(FormulasVector(comm, formulas->n, p->bounds, 0, &problem->xl));
  PetscCall(FormulasVector(comm, formulas->n, p->bounds, 1, &problem->xu));
  PetscCall(VecCreateMPI(comm, PETSC_DECIDE, formulas->ci.m, &problem->ci));
  PetscCall(VecCreateMPI(comm, PETSC_DECIDE, formulas->ce.m, &problem->ce));
  PetscCall(FormulasMatrix(problem->x, problem->x, "-dense_hessian", &problem->H));
  PetscCall(FormulasMatrix(problem->ci, problem->x, "-dense_jacobians", &problem->Ji));
  PetscCall(FormulasMatrix(problem->ce, problem->x, "-dense_jacobians", &problem->Je));
  PetscCall(TaoCreate(comm, &problem->tao));
  PetscCall(TaoSetType(problem->tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(problem->tao, problem->x));
  PetscCall(TaoSetVariableBounds(problem->tao, problem->xl, problem->xu));
  PetscCall(FormulasSetRoutines(problem));
  PetscCall(TaoSetFromOptions(problem->tao));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode FormulasDestroy(FormulasProblem *problem)
{
  PetscFunctionBeginUser;
  PetscCall(TaoDestroy(&problem->tao));
  PetscCall(MatDestroy(&problem->H));
  PetscCall(MatDestroy(&problem->Ji));
  PetscCall(MatDestroy(&problem->Je));
  PetscCall(VecDestroy(&problem->x));
  PetscCall(VecDestroy(&problem->xl));
  PetscCall(VecDestroy(&problem->xu));
  PetscCall(VecDestroy(&problem->ci));
  PetscCall(VecDestroy(&problem->ce));
  PetscFunctionReturn(0);
}

/* Largest violation of constraints and bounds, evaluated here; relative: to the rows of the Jacobian, and to the
   bounds, where those are above 1 */
static inline PetscErrorCode FormulasViolation(const FormulasProblem *problem, PetscBool relative, PetscReal *violation)
{
  const Formulas *ctx = &problem->formulas;
  PetscReal       a[EXPRESSION_MAX], l[EXPRESSION_MAX], u[EXPRESSION_MAX];

  PetscFunctionBeginUser;
  *violation = 0.0;
  PetscCall(FormulasGather(problem->xl, l));
  PetscCall(FormulasGather(problem->xu, u));
  PetscCall(FormulasGather(problem->x, a));
  for (PetscInt i = 0; i < ctx->n; i++) {
    const PetscReal size = relative ? PetscMax(1.0, PetscAbsReal(l[i] > a[i] ? l[i] : u[i])) : 1.0;

    *violation = PetscMax(*violation, PetscMax(l[i] - a[i], a[i] - u[i]) / size);
  }
  for (PetscInt i = 0; i < ctx->ce.m; i++)
    *violation = PetscMax(*violation, FormulasRowViolation(ctx->ce.formula[i], a, PETSC_TRUE, relative));
  for (PetscInt i = 0; i < ctx->ci.m; i++)
    *violation = PetscMax(*violation, FormulasRowViolation(ctx->ci.formula[i], a, PETSC_FALSE, relative));
  PetscFunctionReturn(0);
}

#endif
