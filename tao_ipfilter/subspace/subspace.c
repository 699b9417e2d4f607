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

PetscErrorCode IPSubspaceDestroy(IPSubspace *f)
{
  PetscFunctionBegin;
  if (f->laws) PetscCall(f->lawsops->destroy(&f->laws));
  f->reduced = NULL;
  PetscCall(ISDestroy(&f->W));
  PetscCall(VecDestroy(&f->centre));
  PetscCall(VecDestroy(&f->gradient));
  PetscCall(VecDestroy(&f->c));
  PetscCall(VecDestroy(&f->start_t));
  PetscCall(VecDestroy(&f->start_c));
  PetscCall(VecDestroy(&f->start_values));
  PetscCall(VecDestroy(&f->start_force));
  PetscCall(PetscFree2(f->pg, f->y));
  PetscFunctionReturn(0);
}

/*
   Sets the initial slacks and multipliers: those given by the caller, or those of a penalty as stiff as the objective
*/
static PetscErrorCode SubspaceStartPairs(Tao tao)
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
static PetscErrorCode SubspaceGuess(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  Vec           closer;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &closer));
  PetscCall(VecQuotient_AMGF(closer, slack->z, ip->stiff->rho));
  PetscCall(VecAXPY(closer, -1.0, slack->t));
  PetscCall(IPReducedGuess(IPSubspaceOf(tao)->reduced, closer));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &closer));
  PetscFunctionReturn(0);
}

/* Centres the reduced problem at `centre`, with the gradient and the constraint values there, for all directions */
PetscErrorCode IPSubspaceCentre(Tao tao, const IPBasis *basis, Vec centre, Vec gradient, Vec c)
{
  IPSubspace *f = IPSubspaceOf(tao);

  PetscFunctionBegin;
  PetscCall(VecCopy(centre, f->centre));
  PetscCall(VecCopy(gradient, f->gradient));
  PetscCall(VecCopy(c, f->c));
  PetscCall(IPBasisDots(basis, 0, basis->n, f->gradient, f->pg));
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedCenter(f->reduced, f->gradient, f->c, f->pg));
  PetscCall(IPReducedAppend(f->reduced, basis, f->pg));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*
   Keeps the state of constraints and norm terms at the begin of a solve. Contacts that stick move the offsets of terms;
   each model of Newton's method begins with those of the solve.
*/
static PetscErrorCode SubspaceKeepStart(Tao tao, Vec values, Vec force)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f      = IPSubspaceOf(tao);
  const Vec     now[]  = {ip->terms->t, ip->at.c, values, force};
  Vec *const    kept[] = {&f->start_t, &f->start_c, &f->start_values, &f->start_force};

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(now); k++) {
    PetscCall(VecDuplicate(now[k], kept[k]));
    PetscCall(VecCopy(now[k], *kept[k]));
  }
  PetscFunctionReturn(0);
}

/* Begins the laws at the present point */
PetscErrorCode IPSubspaceBeginLaws(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);
  Vec           values, force;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->solution, f->centre));
  PetscCall(VecCopy(tao->gradient, f->gradient));
  PetscCall(VecCopy(ip->at.c, f->c));
  f->f = ip->at.f;
  if (f->start_t) PetscCall(VecCopy(f->start_t, ip->terms->t));
  PetscCall(VecDuplicate(ip->terms->t, &values));
  PetscCall(IPTermsValue(tao, tao->solution, values));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecPointwiseMult(force, ip->pair[IP_SLACK].z, ip->pair[IP_SLACK].w));
  if (!f->start_t) PetscCall(SubspaceKeepStart(tao, values, force));
  PetscCall(ip->laws->begin(f->laws, f->gradient, f->c, values, force, ip->terms->force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecDestroy(&values));
  PetscFunctionReturn(0);
}

/* Takes a step of the laws. enough: residual [2-norm] that may be left; x: the point relative to the
   begin; force: forces of the constraints */
PetscErrorCode IPSubspaceStepLaws(Tao tao, PetscReal enough, Vec x, Vec force, PetscReal *violation, PetscBool *done)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);

  PetscFunctionBegin;
  PetscCall(ip->laws->step(f->laws, enough, x, force, ip->terms->force, violation, &f->nclosed, done));
  ip->rec->nreduced++;
  ip->rec->npivots++;
  PetscFunctionReturn(0);
}

/* Solves the reduced problem. v: solution relative to the centre; force: forces of the constraints. */
PetscErrorCode IPSubspaceSolve(Tao tao, const IPBasis *basis, Vec v, Vec force, PetscBool *solved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);

  PetscFunctionBegin;
  PetscCall(VecSet(v, 0.0));
  f->reduced->system.rounding = ip->first->jacobian * ip->given->rounding;
  f->reduced->system.soft     = basis->has_modes;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedSolve(f->reduced, f->y, v, force, solved));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  if (!*solved) PetscFunctionReturn(0);
  ip->rec->nreduced++;
  ip->rec->npivots += f->reduced->nsteps;
  PetscCall(IPBasisAdd(basis, f->y, v));
  PetscFunctionReturn(0);
}

/* Estimates the rounding errors of forces: they are differences of terms as large as H_ii x_i. Those of x are given. */
static PetscErrorCode SubspaceForceRounding(Tao tao, PetscReal *rounding)
{
  const TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal     eps = 100.0 * PETSC_MACHINE_EPSILON;
  PetscReal           size, stiffness;
  Vec                 terms;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &terms));
  PetscCall(VecPointwiseMult(terms, ip->stiff->hdiag, tao->solution));
  PetscCall(VecNorm(terms, NORM_INFINITY, &size));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &terms));
  PetscCall(VecNorm(ip->stiff->hdiag, NORM_INFINITY, &stiffness));
  *rounding = PetscMax(eps * size, ip->given->rounding * stiffness);
  PetscFunctionReturn(0);
}

/*
   Sets the multipliers to `force` / M, and the slacks to the constraint values. Forces within rounding errors count as
   zero: later solves would take them for those of closed contacts.
*/
PetscErrorCode IPSubspaceSetPairs(Tao tao, Vec force)
{
  TAO_IPFILTER *ip       = (TAO_IPFILTER *)tao->data;
  IPPair       *slack    = &ip->pair[IP_SLACK];
  PetscReal     rounding = 0.0;
  PetscScalar  *s, *z;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(SubspaceForceRounding(tao, &rounding));
  PetscCall(VecFilter(force, rounding));
  PetscCall(VecQuotient_AMGF(slack->z, force, slack->w));
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
PetscErrorCode IPSubspaceCompress(Tao tao, IPBasis *basis, PetscReal E[])
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
PetscErrorCode IPSubspaceMakeRoom(Tao tao, IPBasis *basis)
{
  IPSubspace *f = IPSubspaceOf(tao);
  PetscReal  *E;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(basis->max * basis->max, &E));
  PetscCall(IPReducedCoupling(f->reduced, basis, E));
  PetscCall(IPSubspaceCompress(tao, basis, E));
  PetscCall(PetscFree(E));
  PetscCall(IPReducedForget(f->reduced, basis));
  PetscFunctionReturn(0);
}

/* Counts a step and returns whether the KKT error was halved within the last `patience` steps */
PetscBool IPSubspaceProgresses(IPSubspace *f, PetscReal error, PetscInt patience)
{
  f->nfutile++;
  if (error <= 0.5 * f->halved) {
    f->halved  = error;
    f->nfutile = 0;
  }
  return (PetscBool)(f->nfutile <= patience);
}

/* Sets W to all unknowns */
PetscErrorCode IPSubspaceTakeAll(Tao tao)
{
  IPSubspace *f = IPSubspaceOf(tao);
  PetscInt    start, end;

  PetscFunctionBegin;
  PetscCall(ISDestroy(&f->W));
  PetscCall(VecGetOwnershipRange(tao->solution, &start, &end));
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)tao), end - start, start, 1, &f->W));
  PetscFunctionReturn(0);
}

/* Finds whether the user wants to end the solve */
PetscErrorCode IPSubspaceInterrupted(Tao tao, PetscBool *stop)
{
  const IPGiven *given = ((TAO_IPFILTER *)tao->data)->given;

  PetscFunctionBegin;
  *stop = PETSC_FALSE;
  if (given->interrupt) PetscCall(given->interrupt(given->interrupt_ctx, stop));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, stop, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/* Finds whether the iteration limit of the Krylov method and the user allow another direction */
PetscErrorCode IPSubspaceAllows(Tao tao, PetscBool *allows)
{
  PetscInt  limit;
  PetscBool stop;

  PetscFunctionBegin;
  PetscCall(IPSubspaceInterrupted(tao, &stop));
  PetscCall(KSPGetTolerances(tao->ksp, NULL, NULL, NULL, &limit));
  *allows = (PetscBool)(!stop && ((TAO_IPFILTER *)tao->data)->rec->napplications < limit);
  PetscFunctionReturn(0);
}

/* Adds a direction computed from the residual r, which is zero on W. The basis must not be full. */
PetscErrorCode IPSubspaceExtend(Tao tao, IPRecycle *recycle, Vec r, PetscBool *extended)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f     = IPSubspaceOf(tao);
  IPBasis      *basis = &recycle->basis;
  Vec           d;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &d));
  PetscCall(IPSubspacePrecondition(tao, recycle, r, d, extended));
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

static PetscErrorCode SubspaceCreate(Tao tao, const IPBasis *basis)
{
  IPSubspace *f = IPSubspaceOf(tao);

  PetscFunctionBegin;
  PetscCall(VecDuplicate(tao->solution, &f->centre));
  PetscCall(VecDuplicate(tao->solution, &f->gradient));
  PetscCall(VecDuplicate(((TAO_IPFILTER *)tao->data)->at.c, &f->c));
  PetscCall(PetscMalloc2(basis->max, &f->pg, basis->max, &f->y));
  PetscCall(SubspaceStartPairs(tao));
  PetscFunctionReturn(0);
}

/* Sets up the reduced problem for a Hessian K */
static PetscErrorCode SubspaceSetUpReduced(Tao tao, const IPBasis *basis, Mat K, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedSetUp(f->reduced, K, ip->jac->inequality, ip->sides->compliance, f->W, f->W, tao->solution,
    ip->at.c, basis, possible));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*
   Sets up the method for the present Hessian. The initially active rows follow from slacks and multipliers. *possible:
   false if K_WW is not positive definite.
*/
PetscErrorCode IPSubspaceSetUp(Tao tao, IPRecycle *recycle, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);

  PetscFunctionBegin;
  if (!f->centre) PetscCall(SubspaceCreate(tao, &recycle->basis));
  *possible = PETSC_TRUE;
  if (f->by_laws) {
    PetscCall(IPReducedRelease(&recycle->reduced));
    PetscCall(IPTermsSetNone(tao));
    if (f->laws) PetscCall(ip->laws->destroy(&f->laws));
    f->lawsops = ip->laws;
    PetscCall(ip->laws->create(tao, recycle, f->W, &f->laws));
    PetscFunctionReturn(0);
  }
  f->reduced = &recycle->reduced;
  PetscCall(SubspaceSetUpReduced(tao, &recycle->basis, ip->hess->H, possible));
  if (*possible) PetscCall(SubspaceGuess(tao));
  PetscFunctionReturn(0);
}
