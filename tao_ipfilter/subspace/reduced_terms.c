/* Data of the norm terms of the reduced problem */
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/terms.h"

/*
   Sets the limits, coefficients and immovable directions of the norm terms. scale: scales of the rows of c_I; NULL: all
   are 1.
*/
PetscErrorCode IPReducedSetTerms(IPReduced *r, const IPTerms *terms, Vec scale)
{
  const Vec  given[2] = {terms->limit, terms->coefficient};
  IPLawsData data     = {0};
  PetscReal *values[2];
  Vec        scaled;

  PetscFunctionBegin;
  if (!terms->n) PetscFunctionReturn(0);
  if (r->laws) PetscCall(r->lawsops->getdata(r->laws, &data));
  PetscCall(IPReducedFetch(r->to_terms, terms->rigid, r->on_terms, 2 * r->nterms, data.rigid));
  values[0] = data.limit;
  values[1] = data.coefficient;
  for (PetscInt i = 0; i < r->nterms; i++) {
    data.limit[i]       = PETSC_INFINITY;
    data.coefficient[i] = -1.0;
  }
  for (PetscInt k = 0; k < 2; k++) {
    VecScatter scatter;
    Vec        on_first;

    if (!given[k]) continue;
    PetscCall(VecDuplicate(given[k], &scaled));
    PetscCall(VecCopy(given[k], scaled));
    if (k && scale) PetscCall(VecPointwiseMult(scaled, scaled, scale));
    PetscCall(VecScatterCreateToZero(scaled, &scatter, &on_first));
    PetscCall(IPReducedFetch(scatter, scaled, on_first, r->nterms, values[k]));
    PetscCall(VecScatterDestroy(&scatter));
    PetscCall(VecDestroy(&on_first));
    PetscCall(VecDestroy(&scaled));
  }
  PetscFunctionReturn(0);
}

/*
   Sets the stiffness of the springs that K_WW contains: D of the constraints, D_t of the norm terms' rows. The laws
   subtract the springs' forces again, so that the solution does not depend on them.
*/
PetscErrorCode IPReducedSetSprings(IPReduced *r, Vec D, Vec Dt)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  PetscCall(IPReducedAgree(r, PetscMalloc2(s->m, &s->spring, s->m, &s->start)));
  PetscCall(IPReducedFetch(r->to_rows, D, r->on_rows, r->m, s->spring));
  PetscCall(IPReducedFetch(r->to_terms, Dt, r->on_terms, 2 * r->nterms, s->spring + r->m));
  PetscFunctionReturn(0);
}

/* Sets the coefficients to zero of the terms that the laws have released */
static PetscErrorCode ReducedRelease(const IPReduced *r, const PetscReal own[], Vec coefficient)
{
  PetscScalar *a;
  VecScatter   scatter;
  Vec          on_first;

  PetscFunctionBegin;
  if (!coefficient) PetscFunctionReturn(0);
  PetscCall(VecScatterCreateToZero(coefficient, &scatter, &on_first));
  PetscCall(VecScatterBegin(scatter, coefficient, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, coefficient, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArray(on_first, &a));
  for (PetscInt i = 0; r->laws && i < r->nterms; i++) {
    if (own[i] == 0.0) a[i] = 0.0;
  }
  PetscCall(VecRestoreArray(on_first, &a));
  PetscCall(VecScatterBegin(scatter, on_first, coefficient, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(scatter, on_first, coefficient, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&on_first));
  PetscFunctionReturn(0);
}

/* Changes coefficients and references of the norm terms as the laws have done */
PetscErrorCode IPReducedChangeTerms(const IPReduced *r, const IPTerms *terms)
{
  IPLawsData data = {0};
  Vec        shift;

  PetscFunctionBegin;
  if (r->laws) PetscCall(r->lawsops->getdata(r->laws, &data));
  PetscCallMPI(MPI_Bcast(&data.nreleased, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)terms->t)));
  if (!data.nreleased) PetscFunctionReturn(0);
  PetscCall(ReducedRelease(r, data.coefficient, terms->coefficient));
  PetscCall(VecDuplicate(terms->t, &shift));
  PetscCall(IPReducedSpread(r->to_terms, 2 * r->nterms, data.shift, r->on_terms, shift));
  PetscCall(VecAXPY(terms->t, -1.0, shift));
  PetscCall(VecDestroy(&shift));
  if (r->laws) PetscCall(PetscArrayzero(data.shift, 2 * r->nterms));
  PetscFunctionReturn(0);
}
