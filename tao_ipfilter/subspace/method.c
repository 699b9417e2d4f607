/*
   The subspace method for min f(x), c_I(x) >= 0 with quadratic f, linear c_I, and constraints that involve few
   unknowns W. The search space is V = span{e_i : i in W} + span(P). One iteration:
     1. Solve the contact problem exactly in V (reduced.c).
     2. Compute the residual r = J^T lambda - grad f from the caller's gradient. It is zero on W.
     3. Apply the preconditioner B of K once. Set B r to zero on W, make it K-orthonormal to P and append it (basis.c).
   With a fixed active set this is CG preconditioned by the cycle fbf of PCAMGF. If the active set changes, all
   directions remain useful. Later solves with the same K reuse P, for any constraints and loads.
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/*
   Finds whether the Krylov method's preconditioner can be one for K alone: PCAMGF, whose filter is switched off (*amg),
   or a factorization, which is computed once for all solves (*factored)
*/
static PetscErrorCode SubspaceIsServed(Tao tao, PetscBool *amg, PetscBool *factored)
{
  PC pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, amg));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)pc, factored, PCCHOLESKY, PCLU, ""));
  PetscFunctionReturn(0);
}

/*
   Finds whether the method may be used for this problem. With -tao_ipfilter_subspace auto it is used only if the
   problem certainly has the required form and no option concerns Newton systems, e.g. a tolerance of the Krylov method.
*/
static PetscErrorCode SubspaceApplies(Tao tao, PetscBool *applies)
{
  TAO_IPFILTER    *ip  = (TAO_IPFILTER *)tao->data;
  const IPOptions *opt = ip->opt;
  IPSubspace      *f   = IPSubspaceOf(tao);
  PetscBool        amg, factored;

  PetscFunctionBegin;
  f->newton = (PetscBool)(ip->method->linear && !ip->method->constant);
  *applies =
    (PetscBool)((opt->subspace != IP_SUBSPACE_FALSE || IPNeedsMethod(ip)) && ip->mi && !ip->me &&
                !ip->pair[IP_CEILING].n && !ip->pair[IP_LOWER].n && !ip->pair[IP_UPPER].n && !ip->hess->products);
  if (!*applies || opt->subspace == IP_SUBSPACE_TRUE || IPNeedsMethod(ip)) PetscFunctionReturn(0);
  PetscCall(SubspaceIsServed(tao, &amg, &factored));
  *applies = (PetscBool)(factored || (amg && opt->forcing == IP_FORCING_ADAPTIVE));
  if (!ip->method->linear || opt->direct_always || opt->measure != IP_KKT_RELATIVE || opt->start != IP_START_WARM)
    *applies = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Adds the neighbours of the unknowns `filter`, and the neighbours of these as well if W remains small */
static PetscErrorCode SubspaceAddNeighbours(Tao tao, IS filter, IS *W)
{
  const Mat       K        = ((TAO_IPFILTER *)tao->data)->hess->H;
  const PetscReal fraction = 0.1;
  PetscInt        n, all;
  IS              more;

  PetscFunctionBegin;
  PetscCall(IPConstrainedGrow(tao, K, filter, W));
  PetscCall(IPConstrainedGrow(tao, K, *W, &more));
  PetscCall(ISGetSize(more, &n));
  PetscCall(VecGetSize(tao->solution, &all));
  if (n > fraction * all) PetscCall(ISDestroy(&more));
  else {
    PetscCall(ISDestroy(W));
    *W = more;
  }
  PetscFunctionReturn(0);
}

/*
   Chooses W: the unknowns of the constraints, one or two layers of neighbours, and W of earlier solves with the same K.
   With the neighbours, W need not change when the contact area moves, and fewer directions are needed. They are left
   out in Newton's method, where K changes anyway, or if W would have more than `most` unknowns.
*/
static PetscErrorCode SubspaceChooseW(Tao tao, const IPRecycle *recycle, PetscInt most, IS *W)
{
  const TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  const IS            filter = ip->cond->constrained, before = recycle->basis.W;
  PetscBool           same = PETSC_FALSE;
  PetscInt            n    = 1;
  IS                  rest, all;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)filter));
  *W = filter;
  if (IPSubspaceOf(tao)->newton) PetscFunctionReturn(0);
  if (before) PetscCall(IPRecycleIsOf(recycle, ip->hess->H, &same));
  if (same) {
    PetscCall(ISDifference(filter, before, &rest));
    PetscCall(ISGetSize(rest, &n));
    PetscCall(ISDestroy(&rest));
  }
  PetscCall(ISDestroy(W));
  if (!n) {
    PetscCall(PetscObjectReference((PetscObject)before));
    *W = before;
    PetscFunctionReturn(0);
  }
  PetscCall(SubspaceAddNeighbours(tao, filter, W));
  if (same) {
    PetscCall(ISExpand(*W, before, &all));
    PetscCall(ISSort(all));
    PetscCall(ISGetSize(all, &n));
    if (n <= most) PetscCall(ISDestroy(W));
    if (n <= most) *W = all;
    else PetscCall(ISDestroy(&all));
  }
  PetscCall(ISGetSize(*W, &n));
  if (n <= most) PetscFunctionReturn(0);
  PetscCall(ISDestroy(W));
  PetscCall(PetscObjectReference((PetscObject)filter));
  *W = filter;
  PetscFunctionReturn(0);
}

/*
   Finds whether W has all n unknowns. They are few and constraints touch most of them; or there are norm terms, and the
   unknowns are very few, directions were slow, or contacts stick, since the residual that directions leave would decide
   which contacts are held. most: whether constraints touch most unknowns
*/
static PetscErrorCode SubspaceTakesAll(Tao tao, const IPRecycle *recycle, PetscInt n, PetscBool most, PetscBool *all)
{
  const IPTerms *terms   = ((TAO_IPFILTER *)tao->data)->terms;
  PetscReal      largest = 0.0;

  PetscFunctionBegin;
  if (terms->n && terms->coefficient) PetscCall(VecMax(terms->coefficient, NULL, &largest));
  *all = (PetscBool)(n <= IP_WHOLE &&
                     (most || (terms->n && (n <= IP_SMALL || recycle->whole || largest >= PETSC_INFINITY))));
  PetscFunctionReturn(0);
}

/*
   Sets W. *few: whether there are constraints, and they involve few unknowns or are few themselves. What is few is
   decided only with -tao_ipfilter_subspace auto and if another method could solve the problem.
*/
static PetscErrorCode SubspaceTakeW(Tao tao, IPRecycle *recycle, PetscBool *few)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal fraction = 0.5, rows = 0.25;
  const PetscInt  largest = 5000; /* by laws, which need factors for each system */
  PetscInt        n, m, touched, most;
  PetscBool       all = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPRowsTake(tao));
  PetscCall(IPConstrainedUpdate(tao));
  PetscCall(VecGetSize(tao->solution, &n));
  PetscCall(ISGetSize(ip->cond->constrained, &touched));
  PetscCall(VecGetSize(ip->at.c, &m));
  *few = (PetscBool)(touched > 0 && (ip->opt->subspace == IP_SUBSPACE_TRUE || IPNeedsMethod(ip) ||
                                      touched <= fraction * n || (n <= IP_WHOLE && m <= rows * n)));
  PetscCall(ISDestroy(&IPSubspaceOf(tao)->W));
  if (!*few) PetscFunctionReturn(0);
  most = (PetscInt)(fraction * n);
  PetscCall(SubspaceTakesAll(tao, recycle, n, (PetscBool)(touched > most), &all));
  IPSubspaceOf(tao)->by_laws = (PetscBool)(ip->terms->n || (ip->laws && m > IP_DENSE_ROWS));
  if (IPSubspaceOf(tao)->by_laws) most = PetscMin(most, largest);
  if (all) PetscCall(IPSubspaceTakeAll(tao));
  else PetscCall(SubspaceChooseW(tao, recycle, most, &IPSubspaceOf(tao)->W));
  PetscFunctionReturn(0);
}

/* Evaluates objective, constraints and derivatives at tao->solution */
static PetscErrorCode SubspaceEvaluate(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     alone;

  PetscFunctionBegin;
  PetscCall(TaoIsGradientDefined(tao, &alone));
  if (alone) PetscCall(TaoComputeObjective(tao, tao->solution, &ip->at.f));
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->at.c, ip->at.ce));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Estimates the rounding error of f at tao->solution, where f may be a difference of much larger terms */
static PetscErrorCode SubspaceRounding(Tao tao, PetscReal *rounding)
{
  TAO_IPFILTER   *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal eps = 1e4 * PETSC_MACHINE_EPSILON;
  PetscScalar     terms;
  Vec             Hx;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Hx));
  PetscCall(VecPointwiseMult(Hx, ip->stiff->hdiag, tao->solution));
  PetscCall(VecDot(Hx, tao->solution, &terms));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Hx));
  *rounding = eps * (PetscRealPart(terms) + PetscAbsReal(ip->at.f));
  PetscFunctionReturn(0);
}

/*
   Estimates the rounding error of c_I, whose terms may be much larger than their sum. The error matters if the start is
   already the solution, since the values of all closed rows are then almost zero before and after a step.
*/
static PetscErrorCode SubspaceConstraintRounding(Tao tao, PetscReal *rounding)
{
  const PetscReal eps = 1e3 * PETSC_MACHINE_EPSILON;
  PetscReal       row, size;

  PetscFunctionBegin;
  PetscCall(MatNorm(((TAO_IPFILTER *)tao->data)->jac->inequality, NORM_INFINITY, &row));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *rounding = eps * row * size;
  PetscFunctionReturn(0);
}

/*
   Finds whether the problem is quadratic along v: f changes by 1/2 v^T (grad f + grad f at the centre), and c_I by J v
*/
static PetscErrorCode SubspaceIsQuadratic(Tao tao, Vec v, PetscReal f_centre, Vec c_centre, PetscBool *quadratic)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal tolerance = 1e-6;
  PetscScalar     work[2];
  PetscReal       size[2], error, rounding = 0.0;
  Vec             expected;

  PetscFunctionBegin;
  PetscCall(VecDot(v, IPSubspaceOf(tao)->gradient, &work[0]));
  PetscCall(VecDot(v, tao->gradient, &work[1]));
  PetscCall(SubspaceRounding(tao, &rounding));
  error      = PetscAbsReal(ip->at.f - f_centre - 0.5 * PetscRealPart(work[0] + work[1]));
  *quadratic = (PetscBool)(error <= tolerance * (PetscAbsScalar(work[0]) + PetscAbsScalar(work[1])) + rounding);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &expected));
  PetscCall(MatMultAdd(ip->jac->inequality, v, c_centre, expected));
  PetscCall(VecNorm(expected, NORM_INFINITY, &size[0]));
  PetscCall(VecNorm(c_centre, NORM_INFINITY, &size[1]));
  PetscCall(VecAXPY(expected, -1.0, ip->at.c));
  PetscCall(VecNorm(expected, NORM_INFINITY, &error));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &expected));
  PetscCall(SubspaceConstraintRounding(tao, &rounding));
  *quadratic = (PetscBool)(*quadratic && error <= tolerance * (size[0] + size[1]) + rounding);
  PetscFunctionReturn(0);
}

/*
   Moves to x = centre + v and sets the multipliers to `force` / M. If the problem proves not to be quadratic, moves
   back; *moved is then false.
*/
static PetscErrorCode SubspaceMove(Tao tao, Vec v, Vec force, PetscBool *moved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);
  Vec           x;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &x));
  PetscCall(VecCopy(tao->solution, x));
  PetscCall(VecWAXPY(tao->solution, 1.0, f->centre, v));
  PetscCall(SubspaceEvaluate(tao));
  PetscCall(SubspaceIsQuadratic(tao, v, f->f, f->c, moved));
  if (*moved) {
    PetscCall(IPSubspaceSetPairs(tao, force));
    PetscCall(VecAXPY(x, -1.0, tao->solution));
    PetscCall(VecNorm(x, NORM_INFINITY, &ip->dir.norm));
  } else {
    PetscCall(PetscInfo(tao, "The objective is not quadratic, or the constraints are not linear\n"));
    PetscCall(VecCopy(x, tao->solution));
    PetscCall(SubspaceEvaluate(tao));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &x));
  PetscFunctionReturn(0);
}

/* Centres the reduced problem at the present point */
static PetscErrorCode SubspaceCentreHere(Tao tao, const IPBasis *basis)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  IPSubspaceOf(tao)->f = ip->at.f;
  PetscCall(IPSubspaceCentre(tao, basis, tao->solution, tao->gradient, ip->at.c));
  PetscFunctionReturn(0);
}

/* Solves the reduced problem and moves to its solution */
static PetscErrorCode SubspaceSolveReduced(Tao tao, IPRecycle *recycle, PetscBool *solved)
{
  Vec v, force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPSubspaceSolve(tao, &recycle->basis, v, force, solved));
  if (*solved) PetscCall(SubspaceMove(tao, v, force, solved));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v));
  PetscFunctionReturn(0);
}

/* Removes all directions except the given motions, and keeps the present point. New directions are then not limited by
   rounding errors of the others. */
static PetscErrorCode SubspaceRenew(Tao tao, IPRecycle *recycle)
{
  PetscFunctionBegin;
  PetscCall(PetscInfo(tao, "Directions were removed, since the residual depends on them up to rounding\n"));
  PetscCall(IPBasisDropOldest(&recycle->basis, recycle->basis.n));
  PetscCall(IPModesAppend(tao, recycle));
  PetscCall(IPReducedForget(&recycle->reduced, &recycle->basis));
  PetscCall(SubspaceCentreHere(tao, &recycle->basis));
  PetscFunctionReturn(0);
}

/*
   Adds a direction computed from the residual r. If the basis is full, it is compressed first. If the direction depends
   on the present ones, these are removed, at most once in a solve.
*/
static PetscErrorCode SubspaceAddDirection(Tao tao, IPRecycle *recycle, Vec r, PetscBool *added)
{
  PetscFunctionBegin;
  if (recycle->basis.n == recycle->basis.max) {
    PetscCall(IPSubspaceMakeRoom(tao, &recycle->basis));
    PetscCall(SubspaceCentreHere(tao, &recycle->basis));
  }
  PetscCall(IPSubspaceExtend(tao, recycle, r, added));
  if (*added || !recycle->basis.n || IPSubspaceOf(tao)->renewed) PetscFunctionReturn(0);
  IPSubspaceOf(tao)->renewed = PETSC_TRUE;
  PetscCall(SubspaceRenew(tao, recycle));
  PetscCall(IPSubspaceExtend(tao, recycle, r, added));
  PetscFunctionReturn(0);
}

/*
   Computes r = -ip->rx, set to zero on W. *exact: false if the reduced problem was not solved exactly, that is, r was
   not small on W, or the constraints are violated. The cause is rounding, or a problem that is not quadratic.
   Violations that remain after the problem was centred again are ignored: a body that rests on a rigid one does not
   move before there are directions, so that its violations have no scale.
*/
static PetscErrorCode SubspaceResidual(Tao tao, Vec r, PetscBool *exact)
{
  TAO_IPFILTER     *ip       = (TAO_IPFILTER *)tao->data;
  const IPSubspace *f        = IPSubspaceOf(tao);
  const PetscInt    for_long = 8;
  PetscReal         all, off;

  PetscFunctionBegin;
  PetscCall(VecAXPBY(r, -1.0, 0.0, ip->rx));
  PetscCall(VecNorm(r, NORM_2, &all));
  PetscCall(VecISSet(r, f->W, 0.0));
  PetscCall(VecNorm(r, NORM_2, &off));
  *exact = (PetscBool)(off > 0.5 * all && (f->ncentred || PetscMax(ip->kkt->primal, ip->kkt->complementarity) <=
                                                            PetscMax(ip->tol, ip->kkt->dual)));
  if (f->nfutile && f->nfutile % for_long == 0) *exact = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Makes one iteration: adds a direction and solves the reduced problem. If the last reduced problem was not solved
   exactly, it is solved again from the present point without a new direction. *done: false if no progress is possible.
*/
static PetscErrorCode SubspaceStep(Tao tao, PetscBool *done)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  IPSubspace    *f        = IPSubspaceOf(tao);
  const PetscInt in_a_row = 3, patience = 60;
  PetscBool      exact = PETSC_TRUE;
  IPRecycle     *recycle;
  Vec            r;

  PetscFunctionBegin;
  tao->ksp_its         = 0;
  ip->rec->nacceptable = ip->rec->ntiny = 0; /* many small steps are normal for this method */
  PetscCall(IPSubspaceAllows(tao, done));
  *done = (PetscBool)(IPSubspaceProgresses(f, IPBothErrors(ip), patience) && *done);
  PetscCall(IPRecycleGet(tao, &recycle));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &r));
  PetscCall(SubspaceResidual(tao, r, &exact));
  if (*done && exact) PetscCall(SubspaceAddDirection(tao, recycle, r, done));
  f->ncentred = exact ? 0 : f->ncentred + 1;
  if (f->ncentred > in_a_row) *done = PETSC_FALSE;
  if (*done && !exact) PetscCall(SubspaceCentreHere(tao, &recycle->basis));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &r));
  if (*done) PetscCall(SubspaceSolveReduced(tao, recycle, done));
  if (*done) {
    tao->niter++;
    ip->rec->ndirections++;
  } else PetscCall(IPRecycleReset(recycle));
  PetscFunctionReturn(0);
}

/*
   Takes one step of the laws of norm terms, whose systems add directions as they need them. The point does not move
   before the state of each contact is known: later solves would take a point inside the cones for one where all
   contacts are closed.
*/
static PetscErrorCode SubspaceStepTerms(Tao tao, PetscBool *done)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt patience = 60;
  PetscReal      enough   = IP_FORCING_LAST * ip->tol * IPErrorBoundForceUnit(ip), violation;
  PetscBool      moved    = PETSC_TRUE;
  Vec            v, force;

  PetscFunctionBegin;
  tao->ksp_its = 0;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPSubspaceStepLaws(tao, enough, v, force, &violation, done));
  if (violation == PETSC_INFINITY) ip->rec->nacceptable = ip->rec->ntiny = 0; /* the point did not move */
  else {
    moved = IPSubspaceProgresses(IPSubspaceOf(tao), IPBothErrors(ip), patience);
    if (moved) PetscCall(SubspaceMove(tao, v, force, &moved));
  }
  *done = (PetscBool)(*done && moved);
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v));
  if (*done) tao->niter++;
  PetscFunctionReturn(0);
}

/*
   Computes the first point: for a quadratic program the solution of the first reduced problem, otherwise the start with
   its multipliers
*/
static PetscErrorCode SubspaceFirst(Tao tao, IPRecycle *recycle, PetscBool *found)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);

  PetscFunctionBegin;
  f->nfutile = f->ncentred = 0;
  f->halved                = PETSC_INFINITY;
  f->residual              = 0.0;
  ip->mu                   = 0.0;
  if (f->newton || f->by_laws) PetscCall(VecCopy(ip->at.z[IP_SLACK], ip->at.lambda));
  if (!f->newton && f->by_laws) PetscCall(IPSubspaceBeginLaws(tao));
  else if (!f->newton) {
    PetscCall(SubspaceCentreHere(tao, &recycle->basis));
    PetscCall(SubspaceSolveReduced(tao, recycle, found));
  }
  PetscFunctionReturn(0);
}

/* Destroys the data that later solves would reuse */
static PetscErrorCode SubspaceForget(Tao tao)
{
  IPRecycle *recycle;

  PetscFunctionBegin;
  if (!IPSubspaceOf(tao)->recycle) PetscFunctionReturn(0);
  PetscCall(IPRecycleGet(tao, &recycle));
  PetscCall(IPRecycleReset(recycle));
  PetscFunctionReturn(0);
}

/*
   Begins the method if the constraints involve few unknowns. Newton's method also begins where the Hessian is
   indefinite; its first step then shifts the Hessian.
*/
static PetscErrorCode SubspaceBegin(Tao tao, PetscBool *begun)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPSubspace   *f  = IPSubspaceOf(tao);
  IPRecycle    *recycle;

  PetscFunctionBegin;
  f->renewed = PETSC_FALSE;
  PetscCall(IPRecycleGet(tao, &recycle));
  PetscCall(SubspaceTakeW(tao, recycle, begun));
  if (!*begun) {
    PetscCall(SubspaceForget(tao));
    PetscFunctionReturn(0);
  }
  PetscCall(IPRecycleUpdate(tao, recycle, begun));
  if (*begun) PetscCall(IPSubspaceSetUp(tao, recycle, &f->ready));
  *begun = (PetscBool)(*begun && (f->ready || f->newton));
  if (*begun) PetscCall(SubspaceFirst(tao, recycle, begun));
  ip->method->multipliers = (PetscBool)!f->newton;
  if (*begun) PetscCall(IPKrylovRecord(tao, 0));
  else {
    PetscCall(IPRecycleReset(recycle));
    PetscCall(IPSubspaceDestroy(f));
    ip->rec->fallbacks.subspaces++;
  }
  PetscFunctionReturn(0);
}

/*
   Ends the method, at the end of a solve or if it makes no progress. Directions remain for later solves. Those of the
   reduced problem remain as well, for TaoIPFilterSolveActive().
*/
static PetscErrorCode SubspaceEnd(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPRecycle    *recycle;

  PetscFunctionBegin;
  if (ip->method->on) {
    PetscCall(IPRecycleGet(tao, &recycle));
    if (IPSubspaceOf(tao)->reduced) PetscCall(IPReducedScale(&recycle->reduced, ip->rows->inequality));
  }
  PetscCall(IPSubspaceDestroy(IPSubspaceOf(tao)));
  PetscFunctionReturn(0);
}

/* Takes one step: a Newton step if the objective is not quadratic, otherwise one iteration */
static PetscErrorCode SubspaceStepOfKind(Tao tao, PetscBool *done)
{
  PetscFunctionBegin;
  if (IPSubspaceOf(tao)->newton) PetscCall(IPNewtonSubspaceStep(tao, done));
  else if (IPSubspaceOf(tao)->by_laws) PetscCall(SubspaceStepTerms(tao, done));
  else PetscCall(SubspaceStep(tao, done));
  if (*done) ((TAO_IPFILTER *)tao->data)->method->multipliers = PETSC_TRUE;
  PetscFunctionReturn(0);
}

static PetscErrorCode SubspaceCreateData(Tao tao)
{
  IPSubspace *f;

  PetscFunctionBegin;
  PetscCall(PetscNew(&f));
  ((TAO_IPFILTER *)tao->data)->method->data = f;
  PetscFunctionReturn(0);
}

static PetscErrorCode SubspaceDestroyData(Tao tao)
{
  PetscFunctionBegin;
  PetscCall(IPSubspaceDestroy(IPSubspaceOf(tao)));
  PetscCall(PetscContainerDestroy(&IPSubspaceOf(tao)->recycle));
  PetscCall(PetscFree(((TAO_IPFILTER *)tao->data)->method->data));
  PetscFunctionReturn(0);
}

const IPMethodOps IPMethodSubspace = {
  .name    = "subspace",
  .create  = SubspaceCreateData,
  .compose = IPSubspaceCompose,
  .applies = SubspaceApplies,
  .begin   = SubspaceBegin,
  .step    = SubspaceStepOfKind,
  .end     = SubspaceEnd,
  .forget  = SubspaceForget,
  .monitor = IPSubspaceMonitor,
  .destroy = SubspaceDestroyData,
};
