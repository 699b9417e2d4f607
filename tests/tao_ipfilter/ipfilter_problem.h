/* Shared by the tests of TAOIPFILTER: the quadratic program min 1/2 x^T H x - b^T x subject to J x - g >= 0 */
#ifndef IPFILTER_PROBLEM_H
#define IPFILTER_PROBLEM_H

#include <petscamgf.h>

typedef struct {
  Mat H, J;
  Vec b, g;
} QuadraticProgram;

static inline PetscErrorCode ProblemObjectiveAndGradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  QuadraticProgram *q = (QuadraticProgram *)user;
  PetscScalar       xHx, xb;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(q->H, x, g));
  PetscCall(VecDot(x, g, &xHx));
  PetscCall(VecDot(x, q->b, &xb));
  PetscCall(VecAXPY(g, -1.0, q->b));
  *f = 0.5 * PetscRealPart(xHx) - PetscRealPart(xb);
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ProblemConstraints(Tao tao, Vec x, Vec c, void *user)
{
  QuadraticProgram *q = (QuadraticProgram *)user;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(q->J, x, c));
  PetscCall(VecAXPY(c, -1.0, q->g));
  PetscFunctionReturn(0);
}

/* Derivative that does not depend on x: its matrix stays as it is */
static inline PetscErrorCode ProblemConstant(Tao tao, Vec x, Mat A, Mat B, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)x;
  (void)A;
  (void)B;
  (void)user;
  PetscFunctionReturn(0);
}

/* A TAOIPFILTER for the program, with the unknowns x; without constraints where J is NULL */
static inline PetscErrorCode ProblemCreateSolver(QuadraticProgram *q, Vec x, Tao *tao)
{
  PetscFunctionBeginUser;
  PetscCall(TaoCreate(PetscObjectComm((PetscObject)x), tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(*tao, x));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, ProblemObjectiveAndGradient, q));
  PetscCall(TaoSetHessian(*tao, q->H, q->H, ProblemConstant, q));
  if (q->J) {
    Vec c;

    PetscCall(VecDuplicate(q->g, &c));
    PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, ProblemConstraints, q));
    PetscCall(TaoSetJacobianInequalityRoutine(*tao, q->J, q->J, ProblemConstant, q));
    PetscCall(VecDestroy(&c));
  }
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ProblemDestroy(QuadraticProgram *q)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&q->H));
  PetscCall(MatDestroy(&q->J));
  PetscCall(VecDestroy(&q->b));
  PetscCall(VecDestroy(&q->g));
  PetscFunctionReturn(0);
}

/* Prints whether a figure is within its limit, and the figure itself only if it is not */
static inline PetscErrorCode ProblemVerdict(const char what[], PetscReal value, PetscReal limit)
{
  PetscFunctionBeginUser;
  if (value <= limit) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: below %g\n", what, (double)limit));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %g is above %g\n", what, (double)value, (double)limit));
  PetscFunctionReturn(0);
}

#endif
