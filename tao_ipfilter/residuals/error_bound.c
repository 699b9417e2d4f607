/*
   Bounds the error in the objective. To first order the error is at most
     sum_j |r_j| l_j + sum_i m_i |lambda_i| |c_i - s_i| + sum_i |y_i| |c_E,i| + sum_i m_i t_i z_i.
   The first sum is that of the stationarity residuals r times lengths l_j of the unknowns. The next two are violations
   times multipliers; the last is the complementarity gap. Each sum has the unit of the objective, whatever the units of
   rows, bounds and unknowns. The last sum grows with the number of bounds, as the error does. The sums are compared
   with the magnitude of the objective.
*/
#include "residualsimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

#define IP_BOUND_MULTIPLE 20.0 /* allowed error relative to the objective, as a multiple of the tolerance */
#define IP_BOUND_TERMS \
  1e-6                      /* if the terms of the objective cancel, this fraction of their magnitude replaces the
                                  objective */
#define IP_BOUND_FIRST 1e-8 /* if the terms vanish, they are replaced by this fraction of their first magnitude */
#define IP_BOUND_PRESENT \
  1e-22 /* the larger one of both magnitudes times this fraction replaces a smaller objective where the iterate is
           refined */
#define IP_BOUND_ROUNDING \
  (100.0 * PETSC_MACHINE_EPSILON) /* residuals below this fraction of the terms count as rounding errors */

/* Computes sum_j |a_j b_j| */
static PetscErrorCode ErrorBoundProduct(Vec a, Vec b, PetscReal *sum)
{
  const PetscScalar *aa, *ba;
  PetscReal          local = 0.0;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(a, &n));
  PetscCall(VecGetArrayRead(a, &aa));
  PetscCall(VecGetArrayRead(b, &ba));
  for (PetscInt j = 0; j < n; j++) local += PetscAbsScalar(aa[j] * ba[j]);
  PetscCall(VecRestoreArrayRead(b, &ba));
  PetscCall(VecRestoreArrayRead(a, &aa));
  PetscCallMPI(MPI_Allreduce(&local, sum, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)a)));
  PetscFunctionReturn(0);
}

/*
   Computes sum_j |r_j| l_j. The length l_j is the larger one of |x_j| and the Newton step of this unknown alone, |r_j|
   / diagonal_j, since an unknown that is zero may be far from its solution. diagonal: that of the condensed matrix.
*/
static PetscErrorCode ErrorBoundImbalance(Tao tao, Vec diagonal, Vec r, PetscReal *sum)
{
  const Vec          v[4] = {r, tao->solution, diagonal, tao->gradient};
  const PetscScalar *a[4];
  const PetscReal    rounding = 10.0 * PETSC_MACHINE_EPSILON;
  PetscReal          local    = 0.0;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(r, &n));
  for (PetscInt k = 0; k < 4; k++) PetscCall(VecGetArrayRead(v[k], &a[k]));
  for (PetscInt j = 0; j < n; j++) {
    const PetscReal rj = PetscAbsScalar(a[0][j]), d = PetscAbsScalar(a[2][j]), x = PetscAbsScalar(a[1][j]);

    local += rj * (d > 0.0 && rj > rounding * PetscAbsScalar(a[3][j]) ? PetscMax(x, rj / d) : x);
  }
  for (PetscInt k = 0; k < 4; k++) PetscCall(VecRestoreArrayRead(v[k], &a[k]));
  PetscCallMPI(MPI_Allreduce(&local, sum, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/*
   Computes the first sum of the bound, that of the stationarity residual. It uses the diagonal of the last condensed
   matrix or, before the first one is assembled, that of the Hessian.
*/
static PetscErrorCode ErrorBoundOfForces(Tao tao, PetscReal *bound)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           diagonal;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &diagonal));
  if (ip->cond->A && ip->rec->nsystems) PetscCall(MatGetDiagonal(ip->cond->A, diagonal));
  else PetscCall(VecCopy(ip->stiff->hdiag, diagonal));
  PetscCall(ErrorBoundImbalance(tao, diagonal, ip->rx, bound));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &diagonal));
  PetscFunctionReturn(0);
}

/* Computes the second and third sum of the bound, those of the violations */
static PetscErrorCode ErrorBoundOfViolation(Tao tao, PetscReal *bound)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     equality;
  Vec           force;

  PetscFunctionBegin;
  *bound = 0.0;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
    PetscCall(VecPointwiseMult(force, ip->at.lambda, ip->pair[IP_SLACK].w));
    PetscCall(ErrorBoundProduct(force, ip->rc, bound));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  }
  if (ip->me) {
    PetscCall(ErrorBoundProduct(ip->at.y, ip->at.ce, &equality));
    *bound += equality;
  }
  PetscFunctionReturn(0);
}

/* Computes the last sum of the bound, the complementarity gap sum m t z */
static PetscErrorCode ErrorBoundOfGap(Tao tao, PetscReal *bound)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *bound = 0.0;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal sum;

    PetscCall(IPPairProducts(&ip->pair[b], 0.0, NULL, &sum));
    *bound += sum;
  }
  PetscFunctionReturn(0);
}

/* Computes H x. If H is constant, it is the gradient less that at x = 0, which is kept from the first product. */
static PetscErrorCode ErrorBoundHessianTimes(Tao tao, Vec Hx)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  IPHessian      *hess     = ip->hess;
  const PetscBool is_first = (PetscBool)(ip->first->energy < 0.0 || !hess->gradient);

  PetscFunctionBegin;
  if (ip->method->constant && !is_first) PetscCall(VecWAXPY(Hx, -1.0, hess->gradient, tao->gradient));
  else PetscCall(MatMult(hess->H, tao->solution, Hx));
  if (!ip->method->constant || !is_first) PetscFunctionReturn(0);
  if (!hess->gradient) PetscCall(VecDuplicate(Hx, &hess->gradient));
  PetscCall(VecWAXPY(hess->gradient, -1.0, Hx, tao->gradient));
  PetscFunctionReturn(0);
}

/* Computes the magnitude of the objective's terms, sum_j |x_j (H x)_j| + |x_j g_j| */
PetscErrorCode IPErrorBoundTerms(Tao tao, PetscReal *terms)
{
  PetscReal linear;
  Vec       Hx;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Hx));
  PetscCall(ErrorBoundHessianTimes(tao, Hx));
  PetscCall(ErrorBoundProduct(Hx, tao->solution, terms));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Hx));
  PetscCall(ErrorBoundProduct(tao->gradient, tao->solution, &linear));
  *terms += linear;
  PetscFunctionReturn(0);
}

/*
   Computes the magnitude of the objective at the start. All unknowns may be zero there. Therefore the gains of Newton
   steps of single unknowns, and the complementarity gap, are added to the terms.
*/
static PetscErrorCode ErrorBoundFirst(Tao tao, PetscReal terms)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     gain, gap;

  PetscFunctionBegin;
  PetscCall(ErrorBoundImbalance(tao, ip->stiff->hdiag, tao->gradient, &gain));
  PetscCall(ErrorBoundOfGap(tao, &gap));
  ip->first->energy = terms + gain + gap;
  PetscFunctionReturn(0);
}

/*
   Raises the magnitude of an objective that is not quadratic such that the energy of rounding errors is negligible:
   that of the unknowns, and the work of the forces of constraints on the rounding errors of the constraints. Rounding
   errors of unknowns change a force by the sum of a row's entries, and this force moves its unknown by the ratio of
   that sum to the diagonal entry.
*/
static PetscErrorCode ErrorBoundRounding(Tao tao, PetscReal *energy)
{
  const PetscReal row      = 8.0; /* sum of the entries of a row, by the diagonal one: trilinear cells */
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal rounding = ip->given->rounding;
  PetscReal       stiffness, forces = 0.0;

  PetscFunctionBegin;
  if (rounding == 0.0) PetscFunctionReturn(0);
  PetscCall(VecNorm(ip->stiff->hdiag, NORM_1, &stiffness));
  if (ip->mi) PetscCall(ErrorBoundProduct(ip->at.lambda, ip->pair[IP_SLACK].w, &forces));
  *energy = PetscMax(*energy,
    (PetscSqr(row) * stiffness * rounding + forces * ip->first->jacobian) * rounding / (IP_BOUND_MULTIPLE * ip->tol));
  PetscFunctionReturn(0);
}

/*
   Computes the magnitudes of the objective with which residuals are compared, the second one where the iterate is
   refined (convergence.c); PETSC_INFINITY for a constant objective
*/
PetscErrorCode IPErrorBoundEnergy(Tao tao, PetscReal *energy, PetscReal *present)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     terms, gradient;

  PetscFunctionBegin;
  PetscCall(IPErrorBoundTerms(tao, &terms));
  if (ip->first->energy < 0.0) PetscCall(ErrorBoundFirst(tao, terms));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  ip->scale->terms = terms;
  *energy          = PetscMax(PetscMax(IP_BOUND_TERMS, IP_BOUND_ROUNDING / (IP_BOUND_MULTIPLE * ip->tol)) * terms,
             IP_BOUND_FIRST * ip->first->energy);
  *energy          = PetscMax(*energy, PetscAbsReal(ip->at.f));
  PetscCall(ErrorBoundRounding(tao, energy));
  *present = PetscMax(IP_BOUND_PRESENT * PetscMax(terms, ip->first->energy), PetscAbsReal(ip->at.f));
  if (ip->first->gradient == 0.0 && gradient == 0.0) *energy = *present = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/*
   Sets kkt->work_dual, the first sum of the bound, and kkt->work, the largest of the sums. Both are divided by the
   error that is allowed if the tolerance is 1.
*/
PetscErrorCode IPErrorBoundOfResiduals(Tao tao)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal unit = IP_BOUND_MULTIPLE * ip->scale->energy;
  PetscReal       forces, violation, gap;

  PetscFunctionBegin;
  ip->kkt->work = ip->kkt->work_dual = ip->kkt->bound = 0.0;
  if (!(ip->scale->energy < PETSC_INFINITY)) PetscFunctionReturn(0);
  PetscCall(ErrorBoundOfForces(tao, &forces));
  PetscCall(ErrorBoundOfViolation(tao, &violation));
  PetscCall(ErrorBoundOfGap(tao, &gap));
  if (forces > 0.0) ip->kkt->work_dual = forces / unit;
  gap            = PetscMax(PetscMax(forces, violation), gap);
  ip->kkt->bound = gap;
  if (gap > 0.0) ip->kkt->work = gap / unit;
  PetscFunctionReturn(0);
}

/*
   Bounds the change of the objective due to relaxed constraints and bounds: the sum of multipliers times relaxations,
   in the unit of kkt->work
*/
PetscErrorCode IPErrorBoundOfRelaxation(Tao tao, PetscReal *work)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     bound = 0.0;
  Vec           force;

  PetscFunctionBegin;
  *work = 0.0;
  if (!ip->relax->times || !(ip->scale->energy < PETSC_INFINITY)) PetscFunctionReturn(0);
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
    PetscCall(VecPointwiseMult(force, ip->at.lambda, ip->pair[IP_SLACK].w));
    PetscCall(VecNorm(force, NORM_1, &bound));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
    bound *= ip->relax->by;
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    PetscReal sum;

    if (!ip->pair[b].n) continue;
    PetscCall(ErrorBoundProduct(ip->pair[b].w, ip->pair[b].z, &sum));
    bound += ip->relax->unknowns * sum;
  }
  *work = bound / (IP_BOUND_MULTIPLE * ip->scale->energy);
  PetscFunctionReturn(0);
}

/* Converts a value in the unit of kkt->work to the unit of the objective */
PetscReal IPErrorBoundOfWork(const TAO_IPFILTER *ip, PetscReal work)
{
  return work * IP_BOUND_MULTIPLE * ip->scale->energy;
}

/* Returns whether a complementarity gap is within the tolerance */
PetscBool IPErrorBoundWithin(const TAO_IPFILTER *ip, PetscReal gap)
{
  return (PetscBool)(gap <= IP_BOUND_MULTIPLE * ip->tol * ip->scale->energy);
}

/*
   Returns whether the error bound is within the tolerance relative to the present objective, however large the
   objective was at the start
*/
PetscBool IPErrorBoundRefined(const TAO_IPFILTER *ip)
{
  return (PetscBool)(ip->kkt->bound <= IP_BOUND_MULTIPLE * ip->tol * ip->scale->present);
}

/* Returns whether the error bound is within a tolerance relative to the present objective and its terms alone */
PetscBool IPErrorBoundWithinPresent(const TAO_IPFILTER *ip, PetscReal tol)
{
  const PetscReal present = PetscMax(IP_BOUND_PRESENT * ip->scale->terms, PetscAbsReal(ip->at.f));

  return (PetscBool)(!(ip->scale->energy < PETSC_INFINITY) || ip->kkt->bound <= IP_BOUND_MULTIPLE * tol * present);
}

/*
   Returns the unit of forces: a stationarity residual of this norm makes the larger one of kkt->dual and
   kkt->work_dual equal to 1
*/
PetscReal IPErrorBoundForceUnit(const TAO_IPFILTER *ip)
{
  return ip->kkt->work_dual > 0.0 ? PetscMin(ip->scale->dual, ip->kkt->dual_norm / ip->kkt->work_dual)
                                  : ip->scale->dual;
}

/*
   Predicts IPErrorBoundForceUnit() for the end of the step dx, with the objective of the quadratic model. The present
   objective would be too small if the start is x = 0.
*/
PetscErrorCode IPErrorBoundForceUnitAfter(Tao tao, Vec dx, PetscReal *unit)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   slope;
  PetscReal     energy;

  PetscFunctionBegin;
  *unit = IPErrorBoundForceUnit(ip);
  if (!(ip->kkt->work_dual > 0.0) || !(ip->scale->energy < PETSC_INFINITY)) PetscFunctionReturn(0);
  PetscCall(VecDot(tao->gradient, dx, &slope));
  energy = PetscAbsReal(ip->at.f + 0.5 * PetscRealPart(slope));
  if (energy > ip->scale->energy)
    *unit = PetscMin(ip->scale->dual, ip->kkt->dual_norm / ip->kkt->work_dual * energy / ip->scale->energy);
  PetscFunctionReturn(0);
}

/*
   Returns the smallest mu that is needed: each product t z is then within a tenth of the tolerance, and their sum
   within half of it
*/
PetscReal IPErrorBoundLeastMu(const TAO_IPFILTER *ip)
{
  const PetscReal energy = ip->rec->nrefined ? ip->scale->present : ip->scale->energy;
  PetscReal       weight = 0.0, mu = ip->tol / 10.0 * ip->scale->product;

  for (PetscInt b = 0; b < IP_NPAIRS; b++)
    if (ip->pair[b].n) weight += ip->pair[b].weight;
  if (weight > 0.0 && energy < PETSC_INFINITY) mu = PetscMin(mu, 0.5 * IP_BOUND_MULTIPLE * ip->tol * energy / weight);
  return mu;
}
