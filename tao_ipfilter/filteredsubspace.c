/*
   The filtered subspace method, for min f(x), c_I(x) >= 0 with a quadratic f, linear c_I, and constraints that touch few unknowns W.

   V = span{e_i : i in W} + span(P). In turn: the contact problem is solved exactly on V (reduced.c); the residual r = J^T lambda - grad f
   that is left, zero on W, is made from the caller's own gradient; one application of the preconditioner B of K alone gives the direction
   B r, made zero on W and K-orthonormal to P (basis.c). With a fixed active set this is CG preconditioned by the `fbf` cycle of PCAMGF;
   where the set changes nothing is lost, and P serves the next solve with the same K, whatever its constraints and loads.
*/
#include "ipfilterimpl.h"

PetscErrorCode IPFilteredDestroy(IPFiltered *f)
{
  PetscFunctionBegin;
  PetscCall(IPReducedDestroy(&f->reduced));
  PetscCall(VecDestroy(&f->centre));
  PetscCall(VecDestroy(&f->gradient));
  PetscCall(VecDestroy(&f->c));
  PetscCall(PetscFree2(f->pg, f->y));
  f->on = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Whether the Krylov method's preconditioner is one for K alone: AMG without its filter, or a factorization, which then serves all solves */
static PetscErrorCode FilteredIsServed(Tao tao, PetscBool *amg, PetscBool *factored)
{
  PC pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, amg));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)pc, factored, PCCHOLESKY, PCLU, ""));
  PetscFunctionReturn(0);
}

/* Whether this may be the method's kind of problem; auto: whether it is for certain, and nothing asks for Newton systems, as tolerances of
   a Krylov method do */
static PetscErrorCode FilteredApplies(Tao tao, PetscBool *applies)
{
  TAO_IPFILTER    *ip  = (TAO_IPFILTER *)tao->data;
  const IPOptions *opt = &ip->opt;
  PetscBool        amg, factored;

  PetscFunctionBegin;
  *applies = (PetscBool)(opt->subspace != IP_SUBSPACE_FALSE && ip->mi && !ip->me && !ip->pair[IP_CEILING].n && !ip->pair[IP_LOWER].n && !ip->pair[IP_UPPER].n && !ip->qn.B && !ip->hess.products);
  if (!*applies || opt->subspace == IP_SUBSPACE_TRUE) PetscFunctionReturn(0);
  PetscCall(FilteredIsServed(tao, &amg, &factored));
  *applies = (PetscBool)(factored || (amg && opt->forcing == IP_FORCING_ADAPTIVE));
  if (!ip->filtered.constant || opt->direct_always || opt->measure != IP_KKT_RELATIVE || opt->start != IP_START_WARM) *applies = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Whether the constraints touch few enough unknowns, and some; auto: few against all */
static PetscErrorCode FilteredIsThin(Tao tao, PetscBool *thin)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal fraction = 0.5;
  PetscInt        n, nw;

  PetscFunctionBegin;
  PetscCall(IPRowsTake(tao));
  PetscCall(IPSubspaceUpdate(tao));
  PetscCall(ISGetSize(ip->cond.filter, &nw));
  PetscCall(VecGetSize(tao->solution, &n));
  *thin = (PetscBool)(nw > 0 && (ip->opt.subspace == IP_SUBSPACE_TRUE || nw <= fraction * n));
  PetscFunctionReturn(0);
}

/* The rows that begin as active: where the caller's multipliers outweigh the slacks, or without them where a constraint is violated */
static PetscErrorCode FilteredGuess(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           s, z;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &s));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &z));
  if (ip->given.warm_s) {
    PetscCall(VecCopy(ip->given.warm_s, s));
    PetscCall(VecCopy(ip->given.warm_z, z));
    PetscCall(IPRowScalePair(tao, s, z, PETSC_FALSE));
    PetscCall(VecPointwiseDivide(z, z, ip->stiff.rho));
    PetscCall(VecAXPY(z, -1.0, s));
  } else PetscCall(VecAXPBY(z, -1.0, 0.0, ip->at.c));
  PetscCall(IPReducedGuess(&ip->filtered.reduced, z));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &z));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &s));
  PetscFunctionReturn(0);
}

/* The reduced problem counts from the present point on, with all directions there are */
static PetscErrorCode FilteredCentre(Tao tao, const IPBasis *basis)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = &ip->filtered;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->solution, f->centre));
  PetscCall(VecCopy(tao->gradient, f->gradient));
  PetscCall(VecCopy(ip->at.c, f->c));
  f->f = ip->at.f;
  if (basis->n) PetscCall(VecMDot(f->gradient, basis->n, basis->p, f->pg));
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedCenter(&f->reduced, f->gradient, f->c, f->pg));
  PetscCall(IPReducedAppend(&f->reduced, basis, f->pg));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Values and derivatives at tao->solution */
static PetscErrorCode FilteredEvaluate(Tao tao)
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

/* What rounding makes of f at tao->solution, which may be the difference of much larger terms */
static PetscErrorCode FilteredRounding(Tao tao, PetscReal *rounding)
{
  TAO_IPFILTER   *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal eps = 1e4 * PETSC_MACHINE_EPSILON;
  PetscScalar     terms;
  Vec             Hx;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Hx));
  PetscCall(VecPointwiseMult(Hx, ip->stiff.hdiag, tao->solution));
  PetscCall(VecDot(Hx, tao->solution, &terms));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Hx));
  *rounding = eps * (PetscRealPart(terms) + PetscAbsReal(ip->at.f));
  PetscFunctionReturn(0);
}

/* Whether f rises by 1/2 v^T (grad f + grad f at the centre), as a quadratic one does, and c_I by J v */
static PetscErrorCode FilteredIsQuadratic(Tao tao, Vec v, PetscReal f_centre, Vec c_centre, PetscBool *quadratic)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal tolerance = 1e-6;
  PetscScalar     work[2];
  PetscReal       size[2], error, rounding = 0.0;
  Vec             expected;

  PetscFunctionBegin;
  PetscCall(VecDot(v, ip->filtered.gradient, &work[0]));
  PetscCall(VecDot(v, tao->gradient, &work[1]));
  PetscCall(FilteredRounding(tao, &rounding));
  error      = PetscAbsReal(ip->at.f - f_centre - 0.5 * PetscRealPart(work[0] + work[1]));
  *quadratic = (PetscBool)(error <= tolerance * (PetscAbsScalar(work[0]) + PetscAbsScalar(work[1])) + rounding);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &expected));
  PetscCall(MatMultAdd(ip->jac.inequality, v, c_centre, expected));
  PetscCall(VecNorm(expected, NORM_INFINITY, &size[0]));
  PetscCall(VecNorm(c_centre, NORM_INFINITY, &size[1]));
  PetscCall(VecAXPY(expected, -1.0, ip->at.c));
  PetscCall(VecNorm(expected, NORM_INFINITY, &error));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &expected));
  *quadratic = (PetscBool)(*quadratic && error <= tolerance * (size[0] + size[1]));
  PetscFunctionReturn(0);
}

/* Multipliers force / M, and the slacks that the constraints have */
static PetscErrorCode FilteredSetPairs(Tao tao, Vec force)
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
  for (PetscInt i = 0; i < n; i++) s[i] = PetscRealPart(z[i]) > 0.0 ? 0.0 : PetscMax(PetscRealPart(s[i]), 0.0);
  PetscCall(VecRestoreArray(slack->z, &z));
  PetscCall(VecRestoreArray(slack->t, &s));
  PetscFunctionReturn(0);
}

/* To x = centre + v, with the forces of the constraints there. Back again, and *moved is false, where the problem is not quadratic. */
static PetscErrorCode FilteredMove(Tao tao, Vec v, Vec force, PetscBool *moved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = &ip->filtered;
  Vec           x;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &x));
  PetscCall(VecCopy(tao->solution, x));
  PetscCall(VecWAXPY(tao->solution, 1.0, f->centre, v));
  PetscCall(FilteredEvaluate(tao));
  PetscCall(FilteredIsQuadratic(tao, v, f->f, f->c, moved));
  if (*moved) {
    PetscCall(FilteredSetPairs(tao, force));
    PetscCall(VecAXPY(x, -1.0, tao->solution));
    PetscCall(VecNorm(x, NORM_INFINITY, &ip->dir.norm));
  } else {
    PetscCall(PetscInfo(tao, "The objective is not quadratic, or the constraints are not linear\n"));
    PetscCall(VecCopy(x, tao->solution));
    PetscCall(FilteredEvaluate(tao));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &x));
  PetscFunctionReturn(0);
}

/* Solves the reduced problem and moves to its solution */
static PetscErrorCode FilteredSolveReduced(Tao tao, const IPBasis *basis, PetscBool *solved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = &ip->filtered;
  Vec           v, force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecSet(v, 0.0));
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedSolve(&f->reduced, f->y, v, force, solved));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  if (*solved) {
    ip->rec.nreduced++;
    ip->rec.npivots += f->reduced.nsteps;
    if (basis->n) PetscCall(VecMAXPY(v, basis->n, f->y, basis->p));
    PetscCall(FilteredMove(tao, v, force, solved));
  }
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v));
  PetscFunctionReturn(0);
}

/* d = B r for a residual that is zero on W; *definite is false where B is not */
static PetscErrorCode FilteredApplyPC(Tao tao, PC pc, Vec r, Vec d, PetscBool *definite)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   rd;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterApply, tao, r, d, NULL));
  PetscCall(PCApply(pc, r, d));
  PetscCall(PetscLogEventEnd(TAO_IPFilterApply, tao, r, d, NULL));
  PetscCall(IPFixedZero(tao, d));
  PetscCall(VecDot(r, d, &rd));
  *definite = (PetscBool)(PetscRealPart(rd) > 0.0 && !PetscIsInfOrNanReal(PetscRealPart(rd)));
  ip->rec.napplications++;
  ip->rec.ksp_iterations[ip->rec.nksp - 1]++;
  tao->ksp_its++;
  tao->ksp_tot_its++;
  PetscFunctionReturn(0);
}

/* Makes room: of all but the last directions, the part of their span is kept that W has most to do with and so answers most to other
   constraints and gaps. What the solution has of the rest stays in the centre. */
static PetscErrorCode FilteredMakeRoom(Tao tao, IPBasis *basis)
{
  IPFiltered    *f    = &((TAO_IPFILTER *)tao->data)->filtered;
  const PetscInt last = basis->max / 8, best = basis->max / 2;
  PetscReal     *E;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(basis->max * basis->max, &E));
  PetscCall(IPReducedCoupling(&f->reduced, E));
  PetscCall(IPBasisCompress(basis, best, last, E));
  PetscCall(PetscFree(E));
  PetscCall(IPReducedForget(&f->reduced));
  PetscCall(FilteredCentre(tao, basis));
  PetscFunctionReturn(0);
}

/* Whether K is singular, but for rounding, along what its preconditioner makes of a residual */
static PetscErrorCode FilteredIsSingular(Tao tao, Vec d, PetscBool *singular)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal rounding = 1e-11;
  PetscScalar     energy, size;
  Vec             Kd;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Kd));
  PetscCall(MatMult(ip->hess.H, d, Kd));
  PetscCall(VecDot(d, Kd, &energy));
  PetscCall(VecPointwiseMult(Kd, d, ip->stiff.hdiag));
  PetscCall(VecDot(d, Kd, &size));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Kd));
  *singular = (PetscBool) !(PetscRealPart(energy) > rounding * PetscRealPart(size));
  PetscFunctionReturn(0);
}

/* d = B r, by a B that knows of the constraints where K by itself is singular; of B of K alone that is asked once a solve, and where it fails */
static PetscErrorCode FilteredPrecondition(Tao tao, IPKept *kept, Vec r, Vec d, PetscBool *definite)
{
  TAO_IPFILTER *ip       = (TAO_IPFILTER *)tao->data;
  PetscBool     singular = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(FilteredApplyPC(tao, kept->pc, r, d, definite));
  if (kept->held || (*definite && ip->rec.napplications > 1)) PetscFunctionReturn(0);
  PetscCall(FilteredIsSingular(tao, d, &singular));
  if (!singular) PetscFunctionReturn(0);
  PetscCall(IPKeptHold(tao, kept, definite));
  if (*definite) PetscCall(FilteredApplyPC(tao, kept->pc, r, d, definite));
  PetscFunctionReturn(0);
}

/* A direction from the residual r = -ip->rx, zero on W */
static PetscErrorCode FilteredExtend(Tao tao, IPKept *kept, Vec r, PetscBool *extended)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f     = &ip->filtered;
  IPBasis      *basis = &kept->basis;
  Vec           d;

  PetscFunctionBegin;
  if (basis->n == basis->max) PetscCall(FilteredMakeRoom(tao, basis));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &d));
  PetscCall(FilteredPrecondition(tao, kept, r, d, extended));
  PetscCall(VecISSet(d, ip->cond.filter, 0.0));
  if (*extended) {
    PetscCall(PetscLogEventBegin(TAO_IPFilterAppend, tao, d, NULL, NULL));
    PetscCall(IPBasisAppend(basis, ip->hess.H, d, extended));
    PetscCall(PetscLogEventEnd(TAO_IPFilterAppend, tao, d, NULL, NULL));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &d));
  if (!*extended) PetscFunctionReturn(0);
  PetscCall(VecDot(f->gradient, basis->p[basis->n - 1], &f->pg[basis->n - 1]));
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedAppend(&f->reduced, basis, f->pg));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* -ip->rx without its part on W. *exact is false where the reduced problem has left something that it should have made vanish, by rounding
   or as the problem is not quadratic: that part, the violation of the constraints, or what holds up the rest for long. */
static PetscErrorCode FilteredResidual(Tao tao, Vec r, PetscBool *exact)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt for_long = 8;
  PetscReal      all, off;

  PetscFunctionBegin;
  PetscCall(VecAXPBY(r, -1.0, 0.0, ip->rx));
  PetscCall(VecNorm(r, NORM_2, &all));
  PetscCall(VecISSet(r, ip->cond.filter, 0.0));
  PetscCall(VecNorm(r, NORM_2, &off));
  *exact = (PetscBool)(off > 0.5 * all && PetscMax(ip->kkt.primal, ip->kkt.complementarity) <= PetscMax(ip->tol, ip->kkt.dual));
  if (ip->filtered.nfutile && ip->filtered.nfutile % for_long == 0) *exact = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Whether the KKT error still falls: by half in so many steps */
static PetscBool FilteredProgresses(IPFiltered *f, PetscReal error)
{
  const PetscInt patience = 60;

  f->nfutile++;
  if (error <= 0.5 * f->halved) {
    f->halved  = error;
    f->nfutile = 0;
  }
  return (PetscBool)(f->nfutile <= patience);
}

/* A look at what is still to come, now and then: at the rate so far, for the digits of the KKT error that are left */
static PetscErrorCode FilteredReconsider(Tao tao, IPKept *kept, PetscBool *possible)
{
  TAO_IPFILTER   *ip = (TAO_IPFILTER *)tao->data;
  const PetscInt  n = ip->rec.napplications, every = 8;
  const PetscReal error = IPBothErrors(ip), least = 0.5;
  PetscReal       gained, left;

  PetscFunctionBegin;
  *possible = PETSC_TRUE;
  if (n == 0) ip->filtered.begin = error;
  if (n == 0 || n % every) PetscFunctionReturn(0);
  gained = PetscLog10Real(ip->filtered.begin / error);
  left   = PetscLog10Real(PetscMax(error / ip->tol, 1.0));
  PetscCall(IPKeptReconsider(tao, kept, n * left / PetscMax(gained, least), possible));
  PetscFunctionReturn(0);
}

/* A further direction, or where the last reduced problem was not solved to the end, that problem again from where it led; *done is false
   where neither is possible, or helps */
PetscErrorCode IPFilteredStep(Tao tao, PetscBool *done)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  IPFiltered    *f        = &ip->filtered;
  const PetscInt in_a_row = 3;
  PetscBool      exact    = PETSC_TRUE;
  IPKept        *kept;
  Vec            r;

  PetscFunctionBegin;
  tao->ksp_its        = 0;
  ip->rec.nacceptable = ip->rec.ntiny = 0; /* many small steps are the method's way */
  /* Half of the steps there may be are left to the interior point method */
  *done = (PetscBool)(FilteredProgresses(f, IPBothErrors(ip)) && 2 * tao->niter < tao->max_it);
  PetscCall(IPKeptGet(tao, &kept));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &r));
  PetscCall(FilteredResidual(tao, r, &exact));
  f->ncentred = exact ? 0 : f->ncentred + 1;
  if (f->ncentred > in_a_row) *done = PETSC_FALSE;
  if (*done && exact) PetscCall(FilteredReconsider(tao, kept, done));
  if (*done && exact) PetscCall(FilteredExtend(tao, kept, r, done));
  else if (*done) PetscCall(FilteredCentre(tao, &kept->basis));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &r));
  if (*done) PetscCall(FilteredSolveReduced(tao, &kept->basis, done));
  if (*done) tao->niter++;
  else PetscCall(IPKeptReset(kept));
  PetscFunctionReturn(0);
}

/* What this solve alone has; *possible is false where K_WW is not positive definite */
static PetscErrorCode FilteredSetUp(Tao tao, const IPBasis *basis, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = &ip->filtered;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  PetscCall(IPReducedSetUp(&f->reduced, ip->hess.H, ip->jac.inequality, ip->cond.filter, tao->solution, ip->at.c, basis, possible));
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, tao, NULL, NULL, NULL));
  if (*possible) {
    PetscCall(VecDuplicate(tao->solution, &f->centre));
    PetscCall(VecDuplicate(tao->solution, &f->gradient));
    PetscCall(VecDuplicate(ip->at.c, &f->c));
    PetscCall(PetscMalloc2(basis->max, &f->pg, basis->max, &f->y));
    PetscCall(FilteredGuess(tao));
    PetscCall(FilteredCentre(tao, basis));
  }
  PetscFunctionReturn(0);
}

/* Begins where the method is wanted and the problem is of its kind: at the solution of the first reduced problem */
PetscErrorCode IPFilteredBegin(Tao tao, PetscBool *begun)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPFiltered   *f  = &ip->filtered;
  IPKept       *kept;

  PetscFunctionBegin;
  PetscCall(FilteredApplies(tao, begun));
  if (*begun) PetscCall(FilteredIsThin(tao, begun));
  if (!*begun) {
    if (f->kept) PetscCall(IPKeptGet(tao, &kept));
    if (f->kept) PetscCall(IPKeptReset(kept));
    PetscFunctionReturn(0);
  }
  PetscCall(IPKeptGet(tao, &kept));
  PetscCall(IPKeptUpdate(tao, kept, begun));
  if (*begun) PetscCall(FilteredSetUp(tao, &kept->basis, begun));
  f->nfutile = f->ncentred = 0;
  f->halved                = PETSC_INFINITY;
  ip->mu                   = 0.0;
  if (*begun) PetscCall(FilteredSolveReduced(tao, &kept->basis, begun));
  f->on = *begun;
  if (f->on) PetscCall(IPKrylovRecord(tao, 0));
  else {
    PetscCall(IPKeptReset(kept));
    PetscCall(IPFilteredDestroy(f));
    ip->rec.fallbacks.subspaces++;
  }
  PetscFunctionReturn(0);
}

/* Leaves the method, at the end of a solve or where it does not help; directions are kept, what belongs to the constraints is not */
PetscErrorCode IPFilteredEnd(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPKept       *kept;

  PetscFunctionBegin;
  if (ip->filtered.on) {
    PetscCall(IPKeptGet(tao, &kept));
    kept->napplications = ip->rec.napplications;
  }
  PetscCall(IPFilteredDestroy(&((TAO_IPFILTER *)tao->data)->filtered));
  PetscFunctionReturn(0);
}
