/* Quadratic model of the energy about base. It is exact if every body is linear. */
#include "stepimpl.h"

/* f = energy + force^T w + 1/2 w^T K w with w = u - base; p->w and p->Kw keep w and K w */
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
