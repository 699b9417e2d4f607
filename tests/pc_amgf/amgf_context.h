/* A matrix of the model problem with CG and PCAMGF, shared by tests of what changes between solves */
#ifndef AMGF_CONTEXT_H
#define AMGF_CONTEXT_H

#include "amgf_problem.h"

typedef struct {
  MPI_Comm comm;
  Problem  problem;
  Mat      A;
  IS       is; /* the constrained unknowns */
  KSP      ksp;
  PC       pc;
  Vec      b, x, y; /* right-hand side, solution, work vector */
} Context;

static inline PetscErrorCode ContextCreate(Context *c, PetscInt n)
{
  PetscFunctionBeginUser;
  c->comm = PETSC_COMM_WORLD;
  PetscCall(ProblemSetDefaults(&c->problem));
  c->problem.n = n;
  PetscCall(ProblemCreate(c->comm, &c->problem, MATAIJ, PETSC_TRUE, &c->A));
  PetscCall(ProblemCreateFilterIS(&c->problem, c->A, c->comm, &c->is));
  PetscCall(MatCreateVecs(c->A, &c->x, &c->b));
  PetscCall(VecDuplicate(c->x, &c->y));
  PetscCall(FillVector(c->b, 0.8));
  PetscCall(ProblemCreateSolver(c->A, c->A, &c->ksp, &c->pc));
  PetscCall(KSPSetTolerances(c->ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 2000));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ContextDestroy(Context *c)
{
  PetscFunctionBeginUser;
  PetscCall(KSPDestroy(&c->ksp));
  PetscCall(VecDestroy(&c->b));
  PetscCall(VecDestroy(&c->x));
  PetscCall(VecDestroy(&c->y));
  PetscCall(ISDestroy(&c->is));
  PetscCall(MatDestroy(&c->A));
  PetscFunctionReturn(0);
}

/* Relative difference of b^T M y and y^T M b, where M is the preconditioner */
static inline PetscErrorCode ContextAsymmetry(Context *c, PetscReal *difference)
{
  Vec         Mb, My;
  PetscScalar bMy, yMb, bMb, yMy;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(c->b, &Mb));
  PetscCall(VecDuplicate(c->b, &My));
  PetscCall(FillVector(c->y, 5.1));
  PetscCall(PCApply(c->pc, c->b, Mb));
  PetscCall(PCApply(c->pc, c->y, My));
  PetscCall(VecDot(c->b, Mb, &bMb));
  PetscCall(VecDot(c->y, My, &yMy));
  PetscCall(VecDot(c->b, My, &bMy));
  PetscCall(VecDot(c->y, Mb, &yMb));
  *difference = PetscAbsScalar(bMy - yMb) / PetscSqrtReal(PetscAbsScalar(bMb * yMy));
  PetscCall(VecDestroy(&Mb));
  PetscCall(VecDestroy(&My));
  PetscFunctionReturn(0);
}

#endif
