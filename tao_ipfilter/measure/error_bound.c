/*
   Error bound of the objective. To first order the error is at most

     sum_j |r_j| l_j + sum_i m_i |lambda_i| |c_i - s_i| + sum_i |y_i| |c_E,i| + sum_i m_i t_i z_i:

   stationarity residual r times lengths l_j of the unknowns, violations times multipliers, and the complementarity gap.
   Each term has the units of the objective, whatever the units of its row, bound or unknown. The last sum grows with
   the number of bounds, as the error does. All terms are compared with the objective.
*/
#include "measureimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

#define IP_BOUND_MULTIPLE 20.0 /* allowed error bound relative to the objective, as a multiple of the tolerance */
#define IP_BOUND_TERMS    1e-6 /* replaces the objective by this fraction of its terms if these cancel */
#define IP_BOUND_FIRST    1e-8 /* replaces the terms by this fraction of their first values if they vanish */
#define IP_BOUND_ROUNDING \
  (100.0 * PETSC_MACHINE_EPSILON) /* residuals below this fraction of the terms count as rounding */

/* sum_j |a_j b_j| */
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

/* sum_j |r_j| l_j, where l_j is the larger of |x_j| and the unknown's own Newton step |r_j| / diagonal_j: an unknown
   that is zero may be far from its solution. diagonal: of the condensed matrix */
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

/* Part of the stationarity residual in the error bound. The diagonal is that of the last condensed matrix; before
   there is one, that of the Hessian. */
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

/* Part of the violation in the error bound */
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

/* Part of the complementarity gap in the error bound: sum m t z */
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

/* Magnitude of the objective's terms: sum_j |x_j (H x)_j| + |x_j g_j| */
PetscErrorCode IPErrorBoundTerms(Tao tao, PetscReal *terms)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     linear;
  Vec           Hx;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Hx));
  PetscCall(MatMult(ip->hess->H, tao->solution, Hx));
  PetscCall(ErrorBoundProduct(Hx, tao->solution, terms));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Hx));
  PetscCall(ErrorBoundProduct(tao->gradient, tao->solution, &linear));
  *terms += linear;
  PetscFunctionReturn(0);
}

/* The same at the start, where all unknowns may be zero: adds the gains of Newton steps of single unknowns, and the
   complementarity gap */
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

/* The objective's magnitude to which residuals are compared; 0 for a constant objective */
PetscErrorCode IPErrorBoundEnergy(Tao tao, PetscReal *energy)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     terms, gradient;

  PetscFunctionBegin;
  PetscCall(IPErrorBoundTerms(tao, &terms));
  if (ip->first->energy < 0.0) PetscCall(ErrorBoundFirst(tao, terms));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  *energy = PetscMax(PetscMax(IP_BOUND_TERMS, IP_BOUND_ROUNDING / (IP_BOUND_MULTIPLE * ip->tol)) * terms,
    IP_BOUND_FIRST * ip->first->energy);
  *energy = PetscMax(*energy, PetscAbsReal(ip->at.f));
  if (ip->first->gradient == 0.0 && gradient == 0.0) *energy = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/* Sets kkt.work and kkt.work_dual: the error bound relative to its allowed size */
PetscErrorCode IPErrorBoundOfResiduals(Tao tao)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal unit = IP_BOUND_MULTIPLE * ip->scale->energy;
  PetscReal       forces, violation, gap;

  PetscFunctionBegin;
  ip->kkt->work = ip->kkt->work_dual = 0.0;
  if (!(ip->scale->energy < PETSC_INFINITY)) PetscFunctionReturn(0);
  PetscCall(ErrorBoundOfForces(tao, &forces));
  PetscCall(ErrorBoundOfViolation(tao, &violation));
  PetscCall(ErrorBoundOfGap(tao, &gap));
  if (forces > 0.0) ip->kkt->work_dual = forces / unit;
  gap = PetscMax(PetscMax(forces, violation), gap);
  if (gap > 0.0) ip->kkt->work = gap / unit;
  PetscFunctionReturn(0);
}

/* Bound of the change of the objective due to relaxed constraints and bounds: sum of their multipliers times their
   relaxations, over the same unit */
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

/* Converts such a relative value to the units of the objective */
PetscReal IPErrorBoundOfWork(const TAO_IPFILTER *ip, PetscReal work)
{
  return work * IP_BOUND_MULTIPLE * ip->scale->energy;
}

/* Whether a complementarity gap is within the tolerance */
PetscBool IPErrorBoundWithin(const TAO_IPFILTER *ip, PetscReal gap)
{
  return (PetscBool)(gap <= IP_BOUND_MULTIPLE * ip->tol * ip->scale->energy);
}

/* Norm of the stationarity residual up to which both measures of the KKT error are at most 1 */
PetscReal IPErrorBoundForceUnit(const TAO_IPFILTER *ip)
{
  return ip->kkt->work_dual > 0.0 ? PetscMin(ip->scale->dual, ip->kkt->dual_norm / ip->kkt->work_dual)
                                  : ip->scale->dual;
}

/* The same at the end of the step dx, with the objective of the quadratic model: at a start of zero the objective's
   terms are no guide */
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

/* Smallest mu that is needed: each product t z is then within a tenth of the tolerance, and their sum within half of
   it */
PetscReal IPErrorBoundLeastMu(const TAO_IPFILTER *ip)
{
  PetscReal weight = 0.0, mu = ip->tol / 10.0 * ip->scale->product;

  for (PetscInt b = 0; b < IP_NPAIRS; b++)
    if (ip->pair[b].n) weight += ip->pair[b].weight;
  if (weight > 0.0 && ip->scale->energy < PETSC_INFINITY)
    mu = PetscMin(mu, 0.5 * IP_BOUND_MULTIPLE * ip->tol * ip->scale->energy / weight);
  return PetscMin(mu, 0.1 * IPAbsoluteTolerance(ip, ip->opt->compl_inf_tol, 1e-4));
}
