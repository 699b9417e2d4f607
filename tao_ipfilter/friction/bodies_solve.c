/* Solves a system on all unknowns: in the subspace, to which directions are added until the residual is small */
#include "subspace_bodies.h"
#include "tao_ipfilter/solver/record.h"

/* Computes K dx, and the residual that dx leaves in v, which is zero on W, and its 2-norm */
PetscErrorCode BodiesLeft(SubspaceBodies b, Vec v, PetscReal *norm)
{
  PetscFunctionBegin;
  PetscCall(MatMult(b->K, b->dx, b->Kdx));
  PetscCall(VecWAXPY(v, 1.0, b->r, b->Kdx));
  PetscCall(VecScale(v, -1.0));
  PetscCall(IPFixedZero(b->tao, v));
  PetscCall(VecISSet(v, b->W, 0.0));
  PetscCall(VecNorm(v, NORM_2, norm));
  PetscFunctionReturn(0);
}

/* Reduces the number of directions, and keeps those combinations that are coupled to W most. The next solution in the
   subspace adds to dx, which the directions that are left do not contain. left: the residual of dx */
static PetscErrorCode BodiesMakeRoom(SubspaceBodies b, Vec left)
{
  IPBasis       *basis = &b->recycle->basis;
  const PetscInt max   = basis->max;
  PetscReal     *E;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(max * max, &E));
  for (PetscInt j = 0; j < basis->n; j++)
    for (PetscInt i = 0; i < basis->n; i++)
      E[i + j * max] = basis->gram[i + j * max] - 0.5 * (b->schur[i + j * max] + b->schur[j + i * max]);
  PetscCall(IPSubspaceCompress(b->tao, basis, E));
  PetscCall(PetscFree(E));
  PetscCall(VecCopy(b->dx, b->base));
  PetscCall(VecCopy(left, b->rhs));
  PetscCall(VecZeroEntries(b->dw0));
  b->nloads = 0;
  PetscFunctionReturn(0);
}

/* Adds a direction for the residual `left`. *added: false if K is not positive along it, or it depends on the others */
PetscErrorCode BodiesExtend(SubspaceBodies b, Vec left, PetscBool *added)
{
  Vec d;

  PetscFunctionBegin;
  PetscCall(IPSubspaceAllows(b->tao, added));
  if (!*added) PetscFunctionReturn(0);
  if (b->recycle->basis.n == b->recycle->basis.max) PetscCall(BodiesMakeRoom(b, left));
  PetscCall(IPGetWork(b->tao, IP_UNKNOWNS, &d));
  PetscCall(IPSubspacePrecondition(b->tao, b->recycle, left, d, added));
  PetscCall(VecISSet(d, b->W, 0.0));
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, b->tao, d, NULL, NULL));
  if (*added) PetscCall(IPBasisAppend(&b->recycle->basis, b->K, d, added));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, b->tao, d, NULL, NULL));
  PetscCall(IPRestoreWork(b->tao, IP_UNKNOWNS, &d));
  if (*added) ((TAO_IPFILTER *)b->tao->data)->rec->ndirections++;
  PetscFunctionReturn(0);
}

/*
   Finds whether directions cost more than factors of the whole matrix: many were added for one system, although they
   are computed by factors of K. This happens if bodies are slender.
*/
static PetscErrorCode BodiesAreSlow(SubspaceBodies b, PetscInt nadded, PetscBool *slow)
{
  const PetscInt many     = 30;
  PetscBool      factored = PETSC_FALSE;
  PetscInt       n, nw;

  PetscFunctionBegin;
  PetscCall(VecGetSize(b->x, &n));
  PetscCall(ISGetSize(b->W, &nw));
  PetscTryMethod(b->recycle->pc, "PCAMGFGetFactored_C", (PC, PetscBool *), (b->recycle->pc, &factored));
  *slow = (PetscBool)(nadded > many && factored && nw < n);
  PetscFunctionReturn(0);
}

/* Extends W to all unknowns, in this solve and in later ones, and factors the matrix again */
static PetscErrorCode BodiesWiden(SubspaceBodies b, PetscBool *prepared)
{
  IPSubspace *f = IPSubspaceOf(b->tao);
  PetscInt    n;
  PetscReal  *S;

  PetscFunctionBegin;
  PetscCall(PetscInfo(b->tao, "W is extended to all unknowns, since directions are slow\n"));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(IPSubspaceTakeAll(b->tao));
  b->recycle->whole = PETSC_TRUE;
  PetscCall(IPBasisDropOldest(&b->recycle->basis, b->recycle->basis.n));
  PetscCall(IPBasisUpdate(&b->recycle->basis, b->K, PETSC_FALSE, ((TAO_IPFILTER *)b->tao->data)->fixed, f->W));
  PetscCall(BodiesDestroySpace(b));
  PetscCall(BodiesCreateSpace(b, f->W));
  PetscCall(PetscMalloc1(3 * n, &S));
  PetscCall(PetscArraycpy(S, b->factored, 3 * n));
  PetscCall(BodiesFactor(b, S, prepared));
  PetscCall(PetscFree(S));
  PetscFunctionReturn(0);
}

PetscErrorCode BodiesSolve(void *data, const PetscReal s[], PetscReal fraction, PetscReal target, PetscReal du[],
  PetscBool *solved)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  const PetscScalar   *u;
  const PetscReal      part = 0.1; /* error of the coupling, as a part of the error that the directions leave */
  PetscReal            norm, size, first = PETSC_INFINITY, error = 0.0;
  PetscBool            added = PETSC_TRUE, slow = PETSC_FALSE, last;
  PetscInt             n;
  Vec                  left;

  PetscFunctionBegin;
  PetscCall(IPGetWork(b->tao, IP_UNKNOWNS, &left));
  PetscCall(BodiesSpread(b, s, PETSC_FALSE, b->rhs));
  PetscCall(VecAXPY(b->rhs, -1.0, b->r));
  PetscCall(VecZeroEntries(b->base));
  PetscCall(VecISCopy(b->rhs, b->W, SCATTER_REVERSE, b->load));
  PetscCall(MatSolve(b->F, b->load, b->dw0));
  b->nloads = 0;
  PetscCall(VecZeroEntries(b->e));
  for (PetscInt nadded = 0;;) {
    PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    PetscCall(BodiesFactorDirections(b, solved));
    if (*solved) PetscCall(BodiesSolveCoupled(b, error, solved));
    PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    if (!*solved) break;
    PetscCall(BodiesLeft(b, left, &norm));
    PetscCall(BodiesSize(b, left, &size));
    *solved = (PetscBool)!PetscIsInfOrNanReal(size);
    if (!nadded) first = size;
    if (!*solved) break;
    last = (PetscBool)(size <= PetscMax(fraction * first, target) || (fraction > 0.0 && norm <= b->enough) || !added);
    if (last && (error == 0.0 || !b->coupled)) break;
    error = last ? 0.0 : part * size;
    if (last) continue;
    PetscCall(BodiesAreSlow(b, nadded++, &slow));
    if (slow) break;
    PetscCall(BodiesExtend(b, left, &added));
  }
  PetscCall(IPRestoreWork(b->tao, IP_UNKNOWNS, &left));
  if (slow) {
    PetscCall(BodiesWiden(b, solved));
    if (*solved) PetscCall(BodiesSolve(data, s, fraction, target, du, solved));
    PetscFunctionReturn(0);
  }
  *solved = (PetscBool)(*solved && (added || size < first));
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(VecGetArrayRead(b->rows, &u));
  for (PetscInt i = 0; i < n; i++) du[i] = PetscRealPart(u[i]);
  PetscCall(VecRestoreArrayRead(b->rows, &u));
  PetscFunctionReturn(0);
}
