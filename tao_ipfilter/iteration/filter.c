/*
   The filter: pairs (theta, phi) of constraint violation and barrier function. A later iterate must improve on each
   pair in theta or in phi.
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/search.h"

PetscErrorCode IPFilterSetReset(IPFilterSet *f)
{
  PetscFunctionBegin;
  f->n = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode IPFilterSetDestroy(IPFilterSet *f)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(f->theta));
  PetscCall(PetscFree(f->phi));
  f->n = f->max = 0;
  PetscFunctionReturn(0);
}

/* Adds a pair to the filter, and removes the pairs that are not better in theta or in phi */
PetscErrorCode IPFilterSetAdd(IPFilterSet *f, PetscReal theta, PetscReal phi)
{
  PetscInt kept = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < f->n; i++) {
    if (f->theta[i] >= theta && f->phi[i] >= phi) continue;
    f->theta[kept] = f->theta[i];
    f->phi[kept++] = f->phi[i];
  }
  f->n = kept;
  if (f->n == f->max) {
    f->max = 2 * f->max + 8;
    PetscCall(PetscRealloc(f->max * sizeof(PetscReal), &f->theta));
    PetscCall(PetscRealloc(f->max * sizeof(PetscReal), &f->phi));
  }
  f->theta[f->n] = theta;
  f->phi[f->n++] = phi;
  PetscFunctionReturn(0);
}

PetscErrorCode IPFilterSetAccepts(const IPFilterSet *f, PetscReal theta, PetscReal phi, PetscBool *accepts)
{
  PetscFunctionBegin;
  *accepts = PETSC_TRUE;
  for (PetscInt i = 0; i < f->n; i++)
    if (theta >= f->theta[i] && phi >= f->phi[i]) *accepts = PETSC_FALSE;
  PetscFunctionReturn(0);
}
