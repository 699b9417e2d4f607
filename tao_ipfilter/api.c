/* Public functions of TAOIPFILTER. */
#include "ipfilterimpl.h"
#include "pc_amgf/functions.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"

static PetscErrorCode ReplaceVec(Vec v, Vec *slot)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)v));
  PetscCall(VecDestroy(slot));
  *slot = v;
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyVec(Vec v, Vec *slot)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(slot));
  if (!v) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(v, slot));
  PetscCall(VecCopy(v, *slot));
  PetscFunctionReturn(0);
}

/*
   Checks on all ranks that all weights are positive. mass: diagonal weights, or NULL; what: their name in the message.
*/
static PetscErrorCode CheckPositive(Tao tao, Vec mass, const char what[])
{
  PetscReal least;

  PetscFunctionBegin;
  if (!mass) PetscFunctionReturn(0);
  PetscCall(VecMin(mass, NULL, &least));
  PetscCheck(least > 0.0, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "%s mass must be positive, its smallest entry is %g", what, (double)least);
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetSlackMass_IPFilter(Tao tao, Vec mass)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(CheckPositive(tao, mass, "slack"));
  PetscCall(ReplaceVec(mass, &ip->given->slack_mass));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetCompliance_IPFilter(Tao tao, Vec compliance)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     least = 0.0;

  PetscFunctionBegin;
  if (compliance) PetscCall(VecMin(compliance, NULL, &least));
  PetscCheck(least >= 0.0, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "compliance must not be negative, its smallest entry is %g", (double)least);
  PetscCall(ReplaceVec(compliance, &ip->given->compliance));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetPrimalMass_IPFilter(Tao tao, Vec mass)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(CheckPositive(tao, mass, "primal"));
  PetscCall(ReplaceVec(mass, &ip->given->primal_mass));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetWarmStart_IPFilter(Tao tao, Vec s, Vec z)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCheck(!s == !z, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_INCOMP,
    "give both slacks and multipliers, or neither");
  PetscCall(CopyVec(s, &ip->given->warm_s));
  PetscCall(CopyVec(z, &ip->given->warm_z));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetRounding_IPFilter(Tao tao, PetscReal x)
{
  PetscFunctionBegin;
  PetscCheck(x >= 0.0, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "Rounding errors cannot be negative: %g", (double)x);
  ((TAO_IPFILTER *)tao->data)->given->rounding = x;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetDefinite_IPFilter(Tao tao, PetscBool definite)
{
  PetscFunctionBegin;
  ((TAO_IPFILTER *)tao->data)->given->definite = definite;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetSlack_IPFilter(Tao tao, Vec *s, Vec *z)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (s) *s = ip->pair[IP_SLACK].t;
  if (z) *z = ip->pair[IP_SLACK].z;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetKSPIterations_IPFilter(Tao tao, PetscInt *n, const PetscInt *its[])
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (n) *n = ip->rec->nksp;
  if (its) *its = ip->rec->ksp_iterations;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetKKTError_IPFilter(Tao tao, PetscReal *scaled, PetscReal *unscaled)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (scaled) *scaled = ip->kkt->error;
  if (unscaled) *unscaled = ip->kkt->unscaled;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetReason_IPFilter(Tao tao, const char *reason[])
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *reason = ip->rec->reason;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetFilterUse_IPFilter(Tao tao, PetscInt *systems, PetscInt *filtered)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (systems) *systems = ip->rec->nsystems;
  if (filtered) *filtered = ip->rec->nfiltered;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetRegularizations_IPFilter(Tao tao, PetscInt *steps, PetscInt *retries,
  PetscReal *largest)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (steps) *steps = ip->rec->nregularized;
  if (retries) *retries = ip->rec->nretried;
  if (largest) *largest = ip->rec->delta_largest;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetFallbacks_IPFilter(Tao tao, TaoIPFilterFallbacks *fallbacks)
{
  PetscFunctionBegin;
  *fallbacks = ((TAO_IPFILTER *)tao->data)->rec->fallbacks;
  PetscFunctionReturn(0);
}

static const AMGFFunction functions[] = {
  AMGF_FUNCTION(TaoIPFilterSetSlackMass, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetCompliance, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetPrimalMass, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetWarmStart, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetRounding, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetDefinite, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetSlack, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetKSPIterations, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetKKTError, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetFilterUse, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetRegularizations, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetFallbacks, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetReason, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetNormTerms, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetNormTermForces, IPFilter),
  AMGF_FUNCTION(TaoIPFilterGetNormTermForces, IPFilter),
};

/* Composes the implementations of the public functions with the Tao, or removes them if `attach` is false */
PetscErrorCode TaoIPFilterComposeFunctions(Tao tao, PetscBool attach)
{
  PetscFunctionBegin;
  PetscCall(AMGFComposeFunctions((PetscObject)tao, PETSC_STATIC_ARRAY_LENGTH(functions), functions, attach));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetSlackMass - Sets the lumped weights of the inequality constraints

  Logically Collective

  Input Parameters:
+ tao  - the `TAOIPFILTER`
- mass - positive weights m_i, laid out as the constraint vector of `TaoSetInequalityConstraintsRoutine()`; NULL for 1

  Level: intermediate

  Notes:
  The barrier is mu sum_i m_i log s_i and the Lagrangian f - sum_i m_i lambda_i (c_i - s_i). With the lumped areas of a
  surface as weights, c_i is a length, lambda_i a pressure, and iterations do not depend on the mesh.

  The vector is referenced, not copied: it must not change during `TaoSolve()`. `TaoGetDualVariables()` gives
  m_i lambda_i, the multiplier of the unweighted constraint.

  Errors if an entry is not positive; in `TaoSolve()` if the layout is another.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetPrimalMass()`, `TaoIPFilterGetMultiplier()`
@*/
PetscErrorCode TaoIPFilterSetSlackMass(Tao tao, Vec mass)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  if (mass) PetscValidHeaderSpecific(mass, VEC_CLASSID, 2);
  PetscTryMethod(tao, "TaoIPFilterSetSlackMass_C", (Tao, Vec), (tao, mass));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetCompliance - Lets inequality constraints yield in proportion to their multipliers

  Logically Collective

  Input Parameters:
+ tao        - the `TAOIPFILTER`
- compliance - entries C_i >= 0, laid out as the constraint vector of `TaoSetInequalityConstraintsRoutine()`; NULL for 0

  Level: intermediate

  Notes:
  The conditions are c_i(x) + C_i lambda_i >= 0, lambda_i >= 0 and (c_i(x) + C_i lambda_i) lambda_i = 0. This minimizes
  f(x) + sum_i m_i min(c_i(x), 0)^2 / (2 C_i), with the weights m_i of `TaoIPFilterSetSlackMass()`: a layer of springs
  in the place of each constraint with C_i > 0. Small C_i do not spoil the conditioning, since the method works with
  lambda_i. The second term is not part of the objective that TAO reports.

  Such constraints require the subspace method: no equality constraints, no bounds, and linear inequalities, each with
  one bound. The vector is referenced, not copied: it must not change during `TaoSolve()`.

  Errors if an entry is negative; in `TaoSolve()` if the layout is another. The solve ends with `TAO_DIVERGED_USER` if
  the problem is of another kind.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetSlackMass()`, `TaoIPFilterSetSubspace()`
@*/
PetscErrorCode TaoIPFilterSetCompliance(Tao tao, Vec compliance)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  if (compliance) PetscValidHeaderSpecific(compliance, VEC_CLASSID, 2);
  PetscTryMethod(tao, "TaoIPFilterSetCompliance_C", (Tao, Vec), (tao, compliance));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetPrimalMass - Sets the lumped mass of the unknowns

  Logically Collective

  Input Parameters:
+ tao  - the `TAOIPFILTER`
- mass - positive weights laid out as the solution; NULL for 1

  Level: intermediate

  Notes:
  It weighs the stationarity residual in `-tao_ipfilter_kkt mass`, and regularization adds a multiple of it to the
  Hessian. The vector is referenced, not copied.

  Errors if an entry is not positive; in `TaoSolve()` if the layout is another.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetSlackMass()`
@*/
PetscErrorCode TaoIPFilterSetPrimalMass(Tao tao, Vec mass)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  if (mass) PetscValidHeaderSpecific(mass, VEC_CLASSID, 2);
  PetscTryMethod(tao, "TaoIPFilterSetPrimalMass_C", (Tao, Vec), (tao, mass));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetRounding - Sets the size of the rounding errors of the unknowns

  Logically Collective

  Input Parameters:
+ tao - the `TAOIPFILTER`
- x   - size of the rounding errors; default 0, which means that it is not known

  Level: advanced

  Notes:
  Where unknowns are added to much larger numbers, such as displacements to coordinates, violations of the constraints
  have rounding errors that do not vanish with the unknowns. Violations of this size count as zero, as do forces that
  a change of the unknowns by this size causes. Without it a solution that vanishes is never accurate enough.

.seealso: `TAOIPFILTER`, `TaoSetTolerances()`
@*/
PetscErrorCode TaoIPFilterSetRounding(Tao tao, PetscReal x)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscValidLogicalCollectiveReal(tao, x, 2);
  PetscTryMethod(tao, "TaoIPFilterSetRounding_C", (Tao, PetscReal), (tao, x));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetDefinite - Tells the optimizer that the Hessian is positive definite at each point

  Logically Collective

  Input Parameters:
+ tao      - the `TAOIPFILTER`
- definite - whether it is; default `PETSC_FALSE`, which means that it is not known

  Level: advanced

  Note:
  Without constraints the problem then has a solution. With norm terms (friction), and without forces at the start, the
  optimizer tries this solution first. In dynamics inertia makes the Hessian of linear bodies positive definite.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetNormTerms()`
@*/
PetscErrorCode TaoIPFilterSetDefinite(Tao tao, PetscBool definite)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscValidLogicalCollectiveBool(tao, definite, 2);
  PetscTryMethod(tao, "TaoIPFilterSetDefinite_C", (Tao, PetscBool), (tao, definite));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetWarmStart - Sets slacks and multipliers from which `-tao_ipfilter_start warm` begins

  Logically Collective

  Input Parameters:
+ tao - the `TAOIPFILTER`
. s   - slacks, laid out as the inequality constraints; NULL removes earlier values
- z   - multipliers of the slacks, as `TaoIPFilterGetMultiplier()` returns them, same layout; NULL if s is NULL

  Level: intermediate

  Notes:
  The vectors are copied. They need not be positive: each pair is moved to the central path of its constraint, along
  which s - z/rho does not change; rho is the stiffness of the constraint. The barrier parameter mu is the average of
  s_i z_i, or a fraction of the products s_i z_i expected away from the solution, whichever is larger.

  Errors if only one of `s` and `z` is NULL.

.seealso: `TAOIPFILTER`, `TaoIPFilterGetSlack()`, `TaoIPFilterGetMultiplier()`
@*/
PetscErrorCode TaoIPFilterSetWarmStart(Tao tao, Vec s, Vec z)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  if (s) PetscValidHeaderSpecific(s, VEC_CLASSID, 2);
  if (z) PetscValidHeaderSpecific(z, VEC_CLASSID, 3);
  PetscTryMethod(tao, "TaoIPFilterSetWarmStart_C", (Tao, Vec, Vec), (tao, s, z));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetSlack - Gets the slacks of the inequality constraints

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. s - slacks s > 0 with c_I(x) - s -> 0, laid out as the constraints; owned by `tao`; NULL before `TaoSetUp()`

  Level: intermediate

  Note:
  With `TaoSetInequalityBounds()` a slack is the distance from the lower bound. It is the distance from the upper bound
  if there is no lower one, or if the lower one is more than a million times as large. It is zero for a row without
  bounds or with equal bounds.

.seealso: `TAOIPFILTER`, `TaoIPFilterGetMultiplier()`, `TaoIPFilterSetWarmStart()`
@*/
PetscErrorCode TaoIPFilterGetSlack(Tao tao, Vec *s)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscAssertPointer(s, 2);
  PetscUseMethod(tao, "TaoIPFilterGetSlack_C", (Tao, Vec *, Vec *), (tao, s, NULL));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetMultiplier - Gets the multipliers of the slacks

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. z - multipliers z > 0 with s_i z_i -> mu, per unit of the slack mass (contact: pressure), laid out as the
      constraints; owned by `tao`; NULL before `TaoSetUp()`

  Level: intermediate

  Notes:
  `TaoGetDualVariables()` returns m_i lambda_i instead, with lambda_i -> z_i. If the weights m_i are the areas of a
  surface, this is a force.

  With `TaoSetInequalityBounds()` both z_i and lambda_i of an upper bound are negative. For a row with two bounds,
  z_i is the sum of the multipliers of both. For a row with equal bounds, z_i may have either sign.

.seealso: `TAOIPFILTER`, `TaoIPFilterGetSlack()`, `TaoIPFilterSetWarmStart()`, `TaoGetDualVariables()`
@*/
PetscErrorCode TaoIPFilterGetMultiplier(Tao tao, Vec *z)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscAssertPointer(z, 2);
  PetscUseMethod(tao, "TaoIPFilterGetSlack_C", (Tao, Vec *, Vec *), (tao, NULL, z));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterGetKSPIterations - Gets the Krylov iterations of every linear solve of the last `TaoSolve()`

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameters:
+ n   - number of linear solves, including those of the starting point, predictors and failed regularizations; may be
        NULL
- its - iterations of each solve; owned by `tao`, valid until the next `TaoSolve()`; may be NULL

  Level: intermediate

.seealso: `TAOIPFILTER`, `TaoGetLinearSolveIterations()`
@*/
PetscErrorCode TaoIPFilterGetKSPIterations(Tao tao, PetscInt *n, const PetscInt *its[])
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscUseMethod(tao, "TaoIPFilterGetKSPIterations_C", (Tao, PetscInt *, const PetscInt *[]), (tao, n, its));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetKKTError - Gets the residual of the optimality conditions at the returned point, with mu = 0

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameters:
+ scaled   - the measure that decides convergence: dimensionless, or absolute with `-tao_ipfilter_kkt mass`; may be NULL
- unscaled - largest absolute entry of grad f - J^T M lambda - bound multipliers, c - s and s z, in the problem's
             units; may be NULL

  Level: intermediate

.seealso: `TAOIPFILTER`, `TaoIPFilterGetReason()`
@*/
PetscErrorCode TaoIPFilterGetKKTError(Tao tao, PetscReal *scaled, PetscReal *unscaled)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscUseMethod(tao, "TaoIPFilterGetKKTError_C", (Tao, PetscReal *, PetscReal *), (tao, scaled, unscaled));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterGetReason - Gets a sentence that says why the last `TaoSolve()` stopped

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. reason - the sentence; owned by `tao`, empty before the first solve and after an error

  Level: intermediate

.seealso: `TAOIPFILTER`, `TaoGetConvergedReason()`
@*/
PetscErrorCode TaoIPFilterGetReason(Tao tao, const char *reason[])
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscAssertPointer(reason, 2);
  PetscUseMethod(tao, "TaoIPFilterGetReason_C", (Tao, const char *[]), (tao, reason));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetFilterUse - Gets how many condensed systems of the last `TaoSolve()` were preconditioned with the filter

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameters:
+ systems  - number of condensed matrices A = H + Sigma + J^T D J that were assembled; may be NULL
- filtered - number of these for which `PCAMGF` used the filter; the others were preconditioned by the AMG only; 0 with
             another `PC`; may be NULL

  Options Database Key:
. -tao_ipfilter_filter_switch <10> - the filter is used if (J^T D J)_ii exceeds this multiple of H_ii for some i; 0:
                                     always

  Level: intermediate

.seealso: `TAOIPFILTER`, `PCAMGF`, `PCAMGFSetFilterActive()`, `TaoIPFilterGetKSPIterations()`
@*/
PetscErrorCode TaoIPFilterGetFilterUse(Tao tao, PetscInt *systems, PetscInt *filtered)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscUseMethod(tao, "TaoIPFilterGetFilterUse_C", (Tao, PetscInt *, PetscInt *), (tao, systems, filtered));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetRegularizations - Gets how often a multiple of M_u was added to the Hessian of the last `TaoSolve()`,
  because the condensed matrix was not positive definite

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameters:
+ steps   - number of Newton steps with H + delta M_u, delta > 0; may be NULL
. retries - number of linear solves that failed while delta was searched; may be NULL
- largest - largest delta of a step, in the unit of the Hessian divided by that of M_u; may be NULL

  Level: intermediate

  Notes:
  M_u is the mass of `TaoIPFilterSetPrimalMass()`, or the identity.

  If the objective is the energy of an elastic body, delta > 0 means that the tangent stiffness was not positive
  definite. The body was then at or past a limit or bifurcation point on the way to its equilibrium.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetPrimalMass()`
@*/
PetscErrorCode TaoIPFilterGetRegularizations(Tao tao, PetscInt *steps, PetscInt *retries, PetscReal *largest)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscUseMethod(tao, "TaoIPFilterGetRegularizations_C", (Tao, PetscInt *, PetscInt *, PetscReal *),
    (tao, steps, retries, largest));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetFallbacks - Gets the numbers of remedies (refinements, filters, MUMPS) that the linear solves of the
  last `TaoSolve()` needed

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. fallbacks - counts, and the largest backward error of a direction that was used

  Options Database Key:
. -tao_ipfilter_direct_memory <2000> - largest memory of MUMPS for the whole matrix, over all ranks [MB]; 0: MUMPS is
                                       not used

  Level: intermediate

  Note:
  In a solve without difficulties all counts except those of refinements are zero.

.seealso: `TAOIPFILTER`, `TaoIPFilterFallbacks`, `TaoIPFilterGetReason()`, `PCAMGFSetAMGLag()`,
          `PCAMGFSetFilterActive()`
@*/
PetscErrorCode TaoIPFilterGetFallbacks(Tao tao, TaoIPFilterFallbacks *fallbacks)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscAssertPointer(fallbacks, 2);
  PetscUseMethod(tao, "TaoIPFilterGetFallbacks_C", (Tao, TaoIPFilterFallbacks *), (tao, fallbacks));
  PetscFunctionReturn(0);
}
