/*
   The search space within one solve, used by method.c and newton.c: V = span{e_i : i in W} + span(P), and the contact
   problem in V relative to a centre. A new direction is the preconditioner B of K applied to the residual that the
   solution in V leaves.
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

PetscErrorCode IPFilteredDestroy(IPFiltered *f)
{
  PetscFunctionBegin;
  if (f->contacts) PetscCall(f->contactops->destroy(&f->contacts));
  f->reduced = NULL;
  PetscCall(ISDestroy(&f->W));
  PetscCall(VecDestroy(&f->centre));
  PetscCall(VecDestroy(&f->gradient));
  PetscCall(VecDestroy(&f->c));
  PetscCall(PetscFree2(f->pg, f->y));
  PetscFunctionReturn(0);
}

/*
   Sets the initial slacks and multipliers: those given by the caller, or those of a penalty as stiff as the objective
*/
static PetscErrorCode FilteredStartPairs(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  if (ip->given->warm_s) {
    PetscCall(VecCopy(ip->given->warm_s, slack->t));
    PetscCall(VecCopy(ip->given->warm_z, slack->z));
    PetscCall(IPRowScalePair(tao, slack->t, slack->z, PETSC_FALSE));
  } else {
    PetscCall(VecSet(slack->t, 0.0));
    PetscCall(VecPointwiseMax(slack->t, slack->t, ip->at.c));
    PetscCall(VecWAXPY(slack->z, -1.0, ip->at.c, slack->t));
    PetscCall(VecPointwiseMult(slack->z, slack->z, ip->stiff->rho));
  }
  PetscFunctionReturn(0);
}

/* Chooses the initial active set: rows whose multiplier, divided by their stiffness, exceeds their slack */
static PetscErrorCode FilteredGuess(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  Vec           closer, force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecPointwiseMult(force, slack->z, slack->w));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &closer));
  PetscCall(VecPointwiseDivide(closer, slack->z, ip->stiff->rho));
  PetscCall(VecAXPY(closer, -1.0, slack->t));
  PetscCall(IPReducedGuess(IPFilteredOf(tao)->reduced, closer, force, ip->terms));
  IPFilteredOf(tao)->reduced->system.guessed = (PetscBool)!ip->given->warm_s;
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &closer));
  PetscFunctionReturn(0);
}

/*
   Centres the reduced problem at `centre`, with the gradient and the constraint values there, for all directions. x:
   the point itself, which only norm terms need.
*/
PetscErrorCode IPFilteredCentre(Tao tao, const IPBasis *basis, Vec x, Vec centre, Vec gradient, Vec c)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f     = IPFilteredOf(tao);
  Vec           value = NULL;

  PetscFunctionBegin;
  if (ip->terms->n) PetscCall(VecDuplicate(ip->terms->t, &value));
  if (ip->terms->n) PetscCall(IPTermsValue(tao, x, value));
  PetscCall(VecCopy(centre, f->centre));
  PetscCall(VecCopy(gradient, f->gradient));
  PetscCall(VecCopy(c, f->c));
  PetscCall(IPBasisDots(basis, 0, basis->n, f->gradient, f->pg));
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedCenter(f->reduced, f->gradient, f->c, value, f->pg));
  PetscCall(IPReducedAppend(f->reduced, basis, f->pg));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(VecDestroy(&value));
  PetscFunctionReturn(0);
}

/* Begins the laws of many contacts at the present point */
PetscErrorCode IPFilteredBeginContacts(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = IPFilteredOf(tao);
  Vec           values, force;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->solution, f->centre));
  PetscCall(VecCopy(tao->gradient, f->gradient));
  PetscCall(VecCopy(ip->at.c, f->c));
  f->f = ip->at.f;
  PetscCall(VecDuplicate(ip->terms->t, &values));
  PetscCall(IPTermsValue(tao, tao->solution, values));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecPointwiseMult(force, ip->pair[IP_SLACK].z, ip->pair[IP_SLACK].w));
  PetscCall(ip->contacts->begin(f->contacts, f->gradient, f->c, values, force, ip->terms->force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecDestroy(&values));
  PetscFunctionReturn(0);
}

/* Takes a step of the laws of many contacts. enough: residual [2-norm] that any system may leave; x: the point relative
   to the begin; force: forces of the constraints */
PetscErrorCode IPFilteredStepContacts(Tao tao, PetscReal enough, Vec x, Vec force, PetscReal *violation,
  PetscBool *done)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = IPFilteredOf(tao);

  PetscFunctionBegin;
  PetscCall(ip->contacts->step(f->contacts, enough, x, force, ip->terms->force, violation, &f->nclosed, done));
  ip->rec->nreduced++;
  ip->rec->npivots++;
  PetscFunctionReturn(0);
}

/*
   Finds whether W may be extended to all unknowns, so that no directions are needed. A factorization of the whole K
   must be cheap.
*/
static PetscErrorCode FilteredCanWiden(Tao tao, PetscBool *can)
{
  const PetscInt most = 60000;
  IPRecycle     *recycle;
  PetscInt       n;

  PetscFunctionBegin;
  PetscCall(IPRecycleGet(tao, &recycle));
  PetscCall(VecGetSize(tao->solution, &n));
  *can = (PetscBool)(((TAO_IPFILTER *)tao->data)->terms->n && !recycle->whole && n <= most);
  PetscFunctionReturn(0);
}

/* Solves the reduced problem. v: solution relative to the centre; force: forces of the constraints. */
PetscErrorCode IPFilteredSolve(Tao tao, const IPBasis *basis, Vec v, Vec force, PetscBool *solved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = IPFilteredOf(tao);

  PetscFunctionBegin;
  PetscCall(VecSet(v, 0.0));
  PetscCall(FilteredCanWiden(tao, &f->reduced->simply));
  f->reduced->system.rounding      = ip->first->jacobian * ip->given->rounding;
  f->reduced->system.soft          = basis->has_modes;
  f->reduced->system.interrupt     = ip->given->interrupt;
  f->reduced->system.interrupt_ctx = ip->given->interrupt_ctx;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedSolve(f->reduced, f->y, v, force, ip->terms->n ? ip->terms->force : NULL, solved));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  if (!*solved) PetscFunctionReturn(0);
  f->reduced->system.guessed = PETSC_FALSE;
  if (ip->terms->n) PetscCall(IPReducedChangeTerms(f->reduced, ip->terms));
  ip->rec->nreduced++;
  ip->rec->npivots += f->reduced->nsteps;
  PetscCall(IPBasisAdd(basis, f->y, v));
  PetscFunctionReturn(0);
}

/* Sets the multipliers to `force` / M, and the slacks to the constraint values */
PetscErrorCode IPFilteredSetPairs(Tao tao, Vec force)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  PetscScalar  *s, *z;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(VecPointwiseDivide(slack->z, force, slack->w));
  PetscCall(VecCopy(slack->z, ip->at.lambda));
  PetscCall(VecCopy(ip->at.c, slack->t));
  PetscCall(VecGetLocalSize(slack->t, &n));
  PetscCall(VecGetArray(slack->t, &s));
  PetscCall(VecGetArray(slack->z, &z));
  for (PetscInt i = 0; i < n; i++) {
    s[i] = PetscRealPart(z[i]) > 0.0 ? 0.0 : PetscMax(PetscRealPart(s[i]), 0.0);
    z[i] = PetscMax(PetscRealPart(z[i]), 0.0); /* if lambda is negative, the residual lambda - z is not zero */
  }
  PetscCall(VecRestoreArray(slack->z, &z));
  PetscCall(VecRestoreArray(slack->t, &s));
  PetscFunctionReturn(0);
}

/*
   Reduces the number of directions. The newest remain. The others are replaced by those combinations that are coupled
   to W most, since these are most useful for other constraints and gaps. They contain the given motions. The rounding
   errors of combinations exceed the stiffness of these motions, so that the products with K are then computed again.
   E: Q_W^T A^-1 Q_W for the matrix A on W, in columns of the basis's maximal length; overwritten
*/
PetscErrorCode IPFilteredCompress(Tao tao, IPBasis *basis, PetscReal E[])
{
  PetscInt nmodes, room;

  PetscFunctionBegin;
  PetscCall(IPModesGetNumber(tao, &nmodes));
  room = basis->max - nmodes;
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, tao, NULL, NULL, NULL));
  PetscCall(IPBasisCompress(basis, nmodes + room / 2, room / 8, E));
  if (basis->has_modes) PetscCall(IPBasisMultiply(basis, ((TAO_IPFILTER *)tao->data)->hess->H));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Reduces the number of directions. The reduced problem must afterwards be centred at its solution to remain exact. */
PetscErrorCode IPFilteredMakeRoom(Tao tao, IPBasis *basis)
{
  IPFiltered *f = IPFilteredOf(tao);
  PetscReal  *E;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(basis->max * basis->max, &E));
  PetscCall(IPReducedCoupling(f->reduced, basis, E));
  PetscCall(IPFilteredCompress(tao, basis, E));
  PetscCall(PetscFree(E));
  PetscCall(IPReducedForget(f->reduced, basis));
  PetscFunctionReturn(0);
}

/* Counts a step and returns whether the KKT error was halved within the last `patience` steps */
PetscBool IPFilteredProgresses(IPFiltered *f, PetscReal error, PetscInt patience)
{
  f->nfutile++;
  if (error <= 0.5 * f->halved) {
    f->halved  = error;
    f->nfutile = 0;
  }
  return (PetscBool)(f->nfutile <= patience);
}

/* Finds whether the iteration limit of the Krylov method allows another direction */
PetscErrorCode IPFilteredAllows(Tao tao, PetscBool *allows)
{
  PetscInt limit;

  PetscFunctionBegin;
  PetscCall(KSPGetTolerances(tao->ksp, NULL, NULL, NULL, &limit));
  *allows = (PetscBool)(((TAO_IPFILTER *)tao->data)->rec->napplications < limit);
  PetscFunctionReturn(0);
}

/* Adds a direction computed from the residual r, which is zero on W. The basis must not be full. */
PetscErrorCode IPFilteredExtend(Tao tao, IPRecycle *recycle, Vec r, PetscBool *extended)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f     = IPFilteredOf(tao);
  IPBasis      *basis = &recycle->basis;
  Vec           d;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &d));
  PetscCall(IPFilteredPrecondition(tao, recycle, r, d, extended));
  PetscCall(VecISSet(d, f->W, 0.0));
  if (*extended) {
    PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, tao, d, NULL, NULL));
    PetscCall(IPBasisAppend(basis, ip->hess->H, d, extended));
    PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, tao, d, NULL, NULL));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &d));
  if (!*extended) PetscFunctionReturn(0);
  PetscCall(IPBasisDots(basis, basis->n - 1, 1, f->gradient, &f->pg[basis->n - 1]));
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedAppend(f->reduced, basis, f->pg));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode FilteredCreate(Tao tao, const IPBasis *basis)
{
  IPFiltered *f = IPFilteredOf(tao);

  PetscFunctionBegin;
  PetscCall(VecDuplicate(tao->solution, &f->centre));
  PetscCall(VecDuplicate(tao->solution, &f->gradient));
  PetscCall(VecDuplicate(((TAO_IPFILTER *)tao->data)->at.c, &f->c));
  PetscCall(PetscMalloc2(basis->max, &f->pg, basis->max, &f->y));
  PetscCall(FilteredStartPairs(tao));
  PetscFunctionReturn(0);
}

/* Sets up the reduced problem for a Hessian K */
static PetscErrorCode FilteredSetUpReduced(Tao tao, const IPBasis *basis, Mat K, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = IPFilteredOf(tao);

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedSetUp(f->reduced, ip->laws, K, ip->jac->inequality, ip->terms, f->W, tao->solution, ip->at.c,
    basis, possible));
  if (*possible) PetscCall(IPReducedSetTerms(f->reduced, ip->terms, ip->rows->inequality));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*
   Sets up the reduced problem for K + J^T D J + T^T D_t T. D and D_t are not zero in closed rows, where they are as
   stiff as the bodies. This is needed because a tangent K_WW may be singular or indefinite although contact holds its
   unknowns. The laws subtract the forces of these springs again, so that the solution does not depend on them. They act
   on W only, so that the directions and their products with K remain valid.
*/
static PetscErrorCode FilteredSetUpHeld(Tao tao, const IPBasis *basis, PetscBool *possible)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  const IPPair      *slack = &ip->pair[IP_SLACK];
  const PetscScalar *z, *c;
  PetscScalar       *d, *dt;
  PetscInt           n;
  Vec                D, Dt;
  Mat                A;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(ip->terms->t, &Dt));
  PetscCall(IPRecycleStiffnessOfTerms(tao, Dt));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &D));
  PetscCall(VecPointwiseMult(D, ip->stiff->rho, slack->w));
  PetscCall(VecGetLocalSize(D, &n));
  PetscCall(VecGetArray(D, &d));
  PetscCall(VecGetArray(Dt, &dt));
  PetscCall(VecGetArrayRead(slack->z, &z));
  PetscCall(VecGetArrayRead(ip->at.c, &c));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(z[i]) > 0.0 || PetscRealPart(c[i]) < 0.0) continue;
    d[i] = 0.0;
    if (ip->terms->coefficient) dt[2 * i] = dt[2 * i + 1] = 0.0;
  }
  PetscCall(VecRestoreArrayRead(ip->at.c, &c));
  PetscCall(VecRestoreArrayRead(slack->z, &z));
  PetscCall(VecRestoreArray(Dt, &dt));
  PetscCall(VecRestoreArray(D, &d));
  PetscCall(IPRecycleCondense(tao, D, Dt, &A));
  PetscCall(FilteredSetUpReduced(tao, basis, A, possible));
  if (*possible) PetscCall(IPReducedSetSprings(IPFilteredOf(tao)->reduced, D, Dt));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &D));
  PetscCall(VecDestroy(&Dt));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

/*
   Sets up the method for the present Hessian. The initially active rows follow from slacks and multipliers. *possible:
   false if K_WW is not positive definite.
*/
PetscErrorCode IPFilteredSetUp(Tao tao, IPRecycle *recycle, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = IPFilteredOf(tao);
  PetscBool     held;

  PetscFunctionBegin;
  held = (PetscBool)(f->newton && ip->terms->n);
  if (!f->centre) PetscCall(FilteredCreate(tao, &recycle->basis));
  if (f->many) {
    *possible     = PETSC_TRUE;
    f->contactops = ip->contacts;
    if (f->contacts) PetscCall(ip->contacts->destroy(&f->contacts));
    PetscCall(ip->contacts->create(tao, recycle, f->W, &f->contacts));
    PetscFunctionReturn(0);
  }
  f->reduced = &recycle->reduced;
  *possible  = PETSC_FALSE;
  if (!held || !recycle->whole) PetscCall(FilteredSetUpReduced(tao, &recycle->basis, ip->hess->H, possible));
  if (!*possible && held) PetscCall(FilteredSetUpHeld(tao, &recycle->basis, possible));
  if (*possible) PetscCall(FilteredGuess(tao));
  PetscFunctionReturn(0);
}

/* Sets W to all unknowns that are not fixed */
PetscErrorCode IPFilteredTakeAll(Tao tao, IS *W)
{
  const IS fixed = ((TAO_IPFILTER *)tao->data)->fixed;
  PetscInt start, end;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(tao->solution, &start, &end));
  if (fixed) PetscCall(ISComplement(fixed, start, end, W));
  else PetscCall(ISCreateStride(PetscObjectComm((PetscObject)tao), end - start, start, 1, W));
  PetscFunctionReturn(0);
}

/*
   Extends W to all unknowns. For thin or nearly incompressible bodies the reduced problem with few directions may
   differ much from the full one, and its laws of norm terms may be much harder to satisfy. *possible: false if K is not
   positive definite.
*/
PetscErrorCode IPFilteredWiden(Tao tao, IPRecycle *recycle, PetscBool *possible)
{
  IPFiltered *f = IPFilteredOf(tao);

  PetscFunctionBegin;
  PetscCall(
    PetscInfo(tao, "No solution with friction was found in the subspace: the subspace is extended to all unknowns\n"));
  recycle->whole = PETSC_TRUE;
  recycle->nwidened++;
  PetscCall(ISDestroy(&f->W));
  PetscCall(IPFilteredTakeAll(tao, &f->W));
  PetscCall(IPRecycleUpdate(tao, recycle, possible));
  if (*possible) PetscCall(IPFilteredSetUp(tao, recycle, possible));
  PetscFunctionReturn(0);
}
