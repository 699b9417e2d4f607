/* The Tao type: its page and its creation. */
#include "ipfilterimpl.h"

/* KSPCG with PCAMGF, convergence on the true residual's norm */
static PetscErrorCode CreateKSP(Tao tao)
{
  PC pc;

  PetscFunctionBegin;
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)tao), &tao->ksp));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)tao->ksp, (PetscObject)tao, 1));
  PetscCall(KSPSetOptionsPrefix(tao->ksp, ((PetscObject)tao)->prefix));
  PetscCall(KSPAppendOptionsPrefix(tao->ksp, "tao_ipfilter_"));
  PetscCall(KSPSetType(tao->ksp, KSPCG));
  PetscCall(KSPSetNormType(tao->ksp, KSP_NORM_UNPRECONDITIONED));
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyType(Tao tao)
{
  PetscFunctionBegin;
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_FALSE));
  PetscCall(TaoDestroy_IPFilter(tao));
  PetscFunctionReturn(0);
}

/*MC
  TAOIPFILTER - Interior point with a filter line search, for problems too large to factor:
  min f(x) subject to c_I(x) >= 0 and x_l <= x <= x_u

  Options Database Keys:
+ -tao_gatol <1e-8>                                    - KKT error at which the solver has converged, as `TaoSetTolerances()` sets it; 0: machine precision
. -tao_ipfilter_tol <1e-8>                             - the same
. -tao_ipfilter_start <warm> (cold,predict,warm)       - slacks and multipliers to start from: constants, predicted, or
                                                         those of TaoIPFilterSetWarmStart() where given, else predicted
. -tao_ipfilter_barrier <mehrotra> (monotone,mehrotra) - update of the barrier parameter
. -tao_ipfilter_forcing <adaptive> (adaptive,fixed)    - Krylov tolerance from the KKT error, or the KSP's own
. -tao_ipfilter_kkt <relative> (relative,mass)         - dimensionless KKT error, or the absolute mass-weighted one
. -tao_ipfilter_scaling <problem> (problem,none)       - constants that follow the units, or stand as they are
. -tao_ipfilter_filter_switch <10>                     - `PCAMGF` filters once (J^T D J)_ii exceeds this many times H_ii
                                                         for some i; 0: always
. -tao_ipfilter_direct                                 - MUMPS on the whole matrix, with its inertia, from the start
. -tao_ipfilter_direct_memory <2000>                   - MB over all ranks that MUMPS may take for the whole matrix
                                                         where the Krylov method fails; 0: never
. -tao_ipfilter_monitor                                - a line an iteration
- -tao_ipfilter_ksp_type, -tao_ipfilter_pc_type        - solver of the condensed system, `KSPCG` and `PCAMGF` by default

  Level: beginner

  Notes:
  The Newton system is condensed to A = H + Sigma + J^T D J and solved by a Krylov method. The unknowns that J touches
  are composed on A as an IS under `PCAMGF_FILTER_KEY`, where `PCAMGF` finds them.

  `TaoSetHessian()` must give the Hessian of f - DI^T c_I as an assembled matrix, DI being what `TaoGetDualVariables()`
  returns. A Hessian or Jacobian routine that leaves its matrix alone costs nothing: what depends on it is kept.

  The true residual b - A d of every solve is checked. Where it is too large the solve is continued from the attained
  iterate. Where the Krylov method fails, an AMG kept from an older matrix is rebuilt, then the constraints' unknowns are
  filtered, then their neighbours too, then MUMPS factors the whole matrix within `-tao_ipfilter_direct_memory`
  (its options have the prefix `-tao_ipfilter_direct_`); else the solve ends. `TaoIPFilterGetFallbacks()` counts this.

  An objective that is infinite or NaN at a trial point rejects it; with `TaoSetObjective()` and `TaoSetGradient()` no
  constraint and no derivative is asked for there. Where the Hessian is indefinite a multiple of the identity, or of
  `TaoIPFilterSetPrimalMass()`, is added: `TaoIPFilterGetRegularizations()` tells how often.

  Bounds on variables enter the diagonal of A alone. Variables with equal bounds keep that value; their entries of the
  gradient that `TaoGetGradient()` returns are zero.

  `TaoSetTolerances()` has no effect; convergence is decided by the KKT error alone. Reasons: `TAO_CONVERGED_GATOL`
  (KKT error within the tolerance), `TAO_CONVERGED_STEPTOL` (only within the acceptable tolerance),
  `TAO_DIVERGED_LS_FAILURE` (no acceptable step; the constraints may be infeasible), `TAO_DIVERGED_USER` (linear solver
  failed), `TAO_DIVERGED_NAN`, `TAO_DIVERGED_MAXITS`, `TAO_DIVERGED_MAXFCN`; `TaoIPFilterGetReason()` gives a sentence.

  References:
+ * - A. Waechter and L. T. Biegler, "On the implementation of an interior-point filter line-search algorithm for
        large-scale nonlinear programming", Mathematical Programming 106, 2006.
. * - N.-Y. Chiang and V. M. Zavala, "An inertia-free filter line-search algorithm for large-scale nonlinear
        programming", Computational Optimization and Applications 64, 2016.
- * - J. Nocedal, A. Waechter and R. A. Waltz, "Adaptive barrier update strategies for nonlinear interior methods",
        SIAM Journal on Optimization 19, 2009.

.seealso: `TaoIPFilterSetSlackMass()`, `TaoIPFilterSetWarmStart()`, `TaoIPFilterGetReason()`, `PCAMGF`
M*/
PETSC_EXTERN PetscErrorCode TaoCreate_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip;

  PetscFunctionBegin;
  PetscCall(IPLogRegister());
  PetscCall(PetscNew(&ip));
  tao->data                = (void *)ip;
  tao->ops->setup          = TaoSetUp_IPFilter;
  tao->ops->solve          = TaoSolve_IPFilter;
  tao->ops->view           = TaoView_IPFilter;
  tao->ops->setfromoptions = TaoSetFromOptions_IPFilter;
  tao->ops->destroy        = DestroyType;
  PetscCall(IPOptionsInitialize(&ip->opt));
  PetscObjectParameterSetDefault(tao, max_it, 500);
  PetscObjectParameterSetDefault(tao, gatol, 1e-8);
  PetscCall(CreateKSP(tao));
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_TRUE));
  PetscFunctionReturn(0);
}
