/*
   Computes the search direction: accuracy of the linear solves, the two solves of Mehrotra's rule, and the test of the
   direction's curvature
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Computes the square with which the curvature of d is compared: d^T d times a typical diagonal entry of H, but at most
   d^T |diag(H)| d, so that unknowns of different units count equally. Without scaling it is d^T d.
*/
static PetscErrorCode CurvatureSquare(Tao tao, PetscReal *square)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           d  = ip->dir.x, hd;
  PetscScalar   dd, dhd;

  PetscFunctionBegin;
  PetscCall(VecDot(d, d, &dd));
  *square = PetscRealPart(dd);
  if (ip->opt->scaling == IP_SCALING_NONE) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &hd));
  PetscCall(VecPointwiseMult(hd, ip->stiff->hdiag, d));
  PetscCall(VecDot(hd, d, &dhd));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &hd));
  *square = PetscMin(ip->stiff->hscale * *square, PetscRealPart(dhd));
  PetscFunctionReturn(0);
}

/* Computes curvature = d^T (H + Sigma + delta M_u) d */
static PetscErrorCode CurvatureOfUnknowns(Tao tao, PetscReal *curvature)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           d  = ip->dir.x, Wd;
  PetscScalar   dHd, dSd = 0.0;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Wd));
  PetscCall(MatMult(ip->hess->H, d, Wd));
  PetscCall(VecDot(d, Wd, &dHd));
  if (ip->cond->shifted) {
    PetscCall(VecPointwiseMult(Wd, ip->cond->shift, d));
    PetscCall(VecDot(d, Wd, &dSd));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Wd));
  *curvature = PetscRealPart(dHd) + PetscRealPart(dSd);
  PetscFunctionReturn(0);
}

/*
   Adds the part of the slacks to the curvature along the direction: ds^T D ds + max(lambda+^T M (c - s), 0). ds:
   direction of the slacks; M: scaling of the rows. Without scaling ds^T ds is added to the square of the direction's
   norm.
*/
static PetscErrorCode CurvatureAddSlacks(Tao tao, PetscReal *curvature, PetscReal *square)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  Vec           v, ds2;
  PetscScalar   sDs, ss, force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &v));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &ds2));
  PetscCall(IPSlackSigma(tao, v));
  PetscCall(VecPointwiseMult(ds2, slack->dt, slack->dt));
  PetscCall(VecDot(v, ds2, &sDs));
  PetscCall(VecSum(ds2, &ss));
  PetscCall(VecWAXPY(v, 1.0, ip->at.lambda, ip->dir.lambda));
  PetscCall(VecPointwiseMult(v, v, slack->w));
  PetscCall(VecDot(v, ip->rc, &force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &ds2));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &v));
  *curvature += PetscRealPart(sDs) + PetscMax(PetscRealPart(force), 0.0);
  if (ip->opt->scaling == IP_SCALING_NONE) *square += PetscRealPart(ss);
  PetscFunctionReturn(0);
}

/*
   Adds max(-y+^T c_E, 0) to the curvature: a step towards the equality constraints may have less d^T W d by this amount
*/
static PetscErrorCode CurvatureAddEqualities(Tao tao, PetscReal *curvature)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           y;
  PetscScalar   force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &y));
  PetscCall(VecWAXPY(y, 1.0, ip->at.y, ip->dir.y));
  PetscCall(VecDot(y, ip->at.ce, &force));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &y));
  *curvature += PetscMax(-PetscRealPart(force), 0.0);
  PetscFunctionReturn(0);
}

/*
   Tests whether d^T W d + max(lambda+^T M (c - s), 0) + max(-y+^T c_E, 0) >= kappa d^T d, where W is H + Sigma + delta
   M_u for the unknowns and D for the slacks. The test does not use A, which contains J^T D J: for large D, d^T H d
   would be lost in rounding errors. A step as small as rounding passes. Where the inertia of A is known to be right, a
   curvature above the rounding errors is sufficient.
*/
static PetscErrorCode CurvatureTest(Tao tao, PetscBool *passes)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal rounding  = 50.0 * PETSC_MACHINE_EPSILON;
  const PetscBool proven    = (PetscBool)(ip->direct->F && ip->direct->system == ip->rec->nsystems);
  const PetscReal kappa     = proven ? rounding : IP_KAPPA_CURVATURE;
  PetscReal       curvature = 0.0, square = 0.0, step, size;

  PetscFunctionBegin;
  PetscCall(VecNorm(ip->dir.x, NORM_INFINITY, &step));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *passes = (PetscBool)(step <= IP_TINY_STEP * size);
  if (*passes) PetscFunctionReturn(0);
  PetscCall(CurvatureOfUnknowns(tao, &curvature));
  PetscCall(CurvatureSquare(tao, &square));
  if (ip->mi) PetscCall(CurvatureAddSlacks(tao, &curvature, &square));
  if (ip->me) PetscCall(CurvatureAddEqualities(tao, &curvature));
  *passes = (PetscBool)(curvature >= kappa * square);
  if (!*passes)
    PetscCall(PetscInfo(tao, "Curvature %g of the direction is below %g; regularizing\n", (double)curvature,
      (double)(kappa * square)));
  PetscFunctionReturn(0);
}

/*
   Finds whether all products (t + dt)(z + dz) would be within the tolerance after the full step, and the full step
   leaves a margin to the boundary. Only the force residual can then require another iteration.
*/
static PetscErrorCode DirectionWouldFinish(Tao tao, PetscBool *finish)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  const PetscReal margin  = 0.9;
  PetscReal       largest = 0.0, total = 0.0, primal = 1.0, dual = 1.0;

  PetscFunctionBegin;
  PetscCall(IPFractionToBoundary(tao, IP_SLACK, margin, &primal, &dual));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal product, sum;

    PetscCall(IPPairStepProducts(&ip->pair[b], 1.0, 1.0, &product, &sum));
    largest = PetscMax(largest, product);
    total += sum;
  }
  *finish = (PetscBool)(primal == 1.0 && dual == 1.0 && largest <= ip->tol * ip->scale->product &&
                        IPErrorBoundWithin(ip, total));
  PetscFunctionReturn(0);
}

/*
   Returns the target for ||b - A d||: a few per cent of the forces in balance, but less than the present imbalance, and
   not less than `last`. Without constraints it is also at most a few per cent of ||b||, since the forces may be small
   compared with those at the start.
*/
static PetscReal ForcingTarget(const TAO_IPFILTER *ip, PetscReal last, PetscReal rhs)
{
  PetscReal loose = PetscMin(IP_FORCING_MAX * ip->scale->dual, IP_FORCING_REDUCE * ip->kkt->dual_norm);

  if ((!ip->mi && !ip->me) || ip->rec->nrefined) loose = PetscMin(loose, IP_FORCING_MAX * rhs);
  if (ip->rec->nrefined) return loose;
  return PetscMax(loose, last);
}

/* Solves for dx and for the direction of the equality multipliers with the method of this solve */
static PetscErrorCode DirectionSolveUnknowns(Tao tao, Vec rhs, Vec ce, PetscBool matrix, PetscReal target,
  PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->me) PetscCall(IPEqualitySolve(tao, rhs, ce, ip->dir.x, matrix, target, usable));
  else PetscCall(IPLinearSolve(tao, rhs, ip->dir.x, target, usable));
  PetscFunctionReturn(0);
}

/* Returns whether the direction is computed from the condensed system, not from the augmented one */
static PetscBool DirectionIsCondensed(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!ip->me || ip->prox->condensed);
}

/*
   Computes the direction for the residuals rc and ce and the pairs' targets; dir.x is the initial guess. While mu
   falls, the forces need to be accurate to a few per cent only. If the step would end the solve, it is solved again to
   the accuracy that convergence requires. matrix: whether A is new.
*/
static PetscErrorCode DirectionSolve(Tao tao, Vec rc, Vec ce, PetscBool matrix, PetscBool *usable)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal factor = IP_FORCING_LAST * ip->tol;
  PetscReal       norm, last = factor * IPErrorBoundForceUnit(ip);
  PetscBool       finish = PETSC_FALSE;
  Vec             rhs;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &rhs));
  PetscCall(IPCondenseRHS(tao, rc, rhs));
  PetscCall(VecNorm(rhs, NORM_2, &norm));
  PetscCall(DirectionSolveUnknowns(tao, rhs, ce, matrix, ForcingTarget(ip, last, norm), usable));
  if (*usable) {
    PetscCall(IPBackSubstitute(tao, rc));
    PetscCall(IPErrorBoundForceUnitAfter(tao, ip->dir.x, &last));
    last *= factor;
  }
  if (*usable && DirectionIsCondensed(ip) && ip->opt->forcing == IP_FORCING_ADAPTIVE && ip->lin->norm > last)
    PetscCall(DirectionWouldFinish(tao, &finish));
  if (finish) {
    PetscCall(DirectionSolveUnknowns(tao, rhs, ce, PETSC_FALSE, last, usable));
    if (*usable) PetscCall(IPBackSubstitute(tao, rc));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
  PetscFunctionReturn(0);
}

/* Sets the targets of all pairs */
static PetscErrorCode DirectionSetTargets(Tao tao, PetscReal mu, PetscReal corrector_max)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairSetTarget(&ip->pair[b], mu, corrector_max));
  PetscFunctionReturn(0);
}

/* Prints, with -info, the ratio of the largest to the smallest weight of the inequality rows */
static PetscErrorCode DirectionPrintWeights(Tao tao, Vec D)
{
  PetscBool told;
  PetscReal least, largest;

  PetscFunctionBegin;
  PetscCall(PetscInfoEnabled(TAO_CLASSID, &told));
  if (!told) PetscFunctionReturn(0);
  PetscCall(VecMin(D, NULL, &least));
  PetscCall(VecMax(D, NULL, &largest));
  PetscCall(PetscInfo(tao, "Newton system: largest weight of an inequality row over the smallest, D_max/D_min %g\n",
    (double)(largest / least)));
  PetscFunctionReturn(0);
}

/* Assembles the matrix with the present delta */
PetscErrorCode IPDirectionAssemble(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           D;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &D));
  if (ip->mi) {
    PetscCall(IPSlackSigma(tao, D));
    PetscCall(DirectionPrintWeights(tao, D));
  }
  PetscCall(IPCondenseMatrix(tao, D));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &D));
  PetscFunctionReturn(0);
}

/* Returns whether the problem has complementarity pairs, so that mu matters */
static PetscBool DirectionHasPairs(const TAO_IPFILTER *ip)
{
  return (PetscBool)(ip->pair[IP_SLACK].n || ip->pair[IP_LOWER].n || ip->pair[IP_UPPER].n);
}

/*
   Solves the Newton system. Mehrotra's rule first solves it for mu = 0. That solution determines mu and the
   second-order term, and is the initial guess of the second solve.
*/
static PetscErrorCode DirectionSolveSystem(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscBool     matrix = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->dir.x, 0.0));
  if (ip->me) PetscCall(VecSet(ip->dir.y, 0.0));
  if (ip->bar->free && DirectionHasPairs(ip)) {
    PetscCall(DirectionSetTargets(tao, 0.0, 0.0));
    PetscCall(DirectionSolve(tao, ip->rc, ip->at.ce, PETSC_TRUE, usable));
    if (!*usable) PetscFunctionReturn(0);
    PetscCall(IPBarrierFromAffine(tao));
    matrix = PETSC_FALSE;
  }
  PetscCall(DirectionSetTargets(tao, ip->mu, ip->bar->free ? ip->bar->corrector_max : 0.0));
  PetscCall(DirectionSolve(tao, ip->rc, ip->at.ce, matrix, usable));
  PetscFunctionReturn(0);
}

/* Computes another direction with the same matrix, for the residuals of a second-order correction */
PetscErrorCode IPCorrectDirection(Tao tao, Vec rc, Vec ce, PetscBool *usable)
{
  PetscFunctionBegin;
  PetscCall(DirectionSolve(tao, rc, ce, PETSC_FALSE, usable));
  PetscFunctionReturn(0);
}

/*
   Finds whether the barrier function decreases along the direction. Tested only without constraints, where it must
   decrease: if the matrix is almost singular and its linear solve was ended early, the direction may be one of ascent.
*/
static PetscErrorCode DirectionDescends(Tao tao, PetscBool *descends)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     slope;

  PetscFunctionBegin;
  *descends = PETSC_TRUE;
  if (ip->mi || ip->me || ip->kkt->dual_norm == 0.0) PetscFunctionReturn(0);
  PetscCall(IPMeritSlope(tao, &slope));
  *descends = (PetscBool)(slope <= 0.0);
  PetscFunctionReturn(0);
}

/*
   Computes the Newton direction. *usable: its curvature is sufficient or, with the augmented system, the inertia of the
   matrix is correct.
*/
static PetscErrorCode DirectionSolveNewton(Tao tao, PetscBool *usable)
{
  PetscFunctionBegin;
  PetscCall(DirectionSolveSystem(tao, usable));
  if (*usable) PetscCall(CurvatureTest(tao, usable));
  if (*usable) PetscCall(DirectionDescends(tao, usable));
  PetscFunctionReturn(0);
}

/*
   Computes the direction of the next step. *ok: false if no regularization gives enough curvature, or no solver found
   the direction.
*/
PetscErrorCode IPComputeDirection(Tao tao, PetscBool *ok)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->aug->delta    = 0.0;
  ip->aug->centered = PETSC_FALSE;
  PetscCall(IPRegularize(tao, 0.0, IPDirectionAssemble, DirectionSolveNewton, ok));
  if (*ok) IPRegularized(ip);
  PetscFunctionReturn(0);
}
