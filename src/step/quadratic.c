/* The quadratic model of the energy about the base state; exact where every body is linear. */
#include "stepimpl.h"

/* Objective at u; leaves w = u - base and K w in the problem */
PetscErrorCode QuadraticEnergy(StepProblem *p, Vec u, PetscReal *f)
{
  PetscScalar linear, curvature;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(p->w, -1.0, p->base, u));
  PetscCall(MatMult(p->K, p->w, p->Kw));
  PetscCall(VecDotBegin(p->force, p->w, &linear));
  PetscCall(VecDotBegin(p->Kw, p->w, &curvature));
  PetscCall(VecDotEnd(p->force, p->w, &linear));
  PetscCall(VecDotEnd(p->Kw, p->w, &curvature));
  *f = p->energy + PetscRealPart(linear) + 0.5 * PetscRealPart(curvature);
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticObjectiveAndGradient(Tao tao, Vec u, PetscReal *f, Vec G, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(QuadraticEnergy(p, u, f));
  PetscCall(VecWAXPY(G, 1.0, p->force, p->Kw));
  PetscFunctionReturn(0);
}
