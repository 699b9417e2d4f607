/* The Tao type: its manual page and its creation. */
#include "ipfilterimpl.h"

/* Creates the Krylov solver: CG with PCAMGF, convergence by the norm of the true residual */
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
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCAMGFSetFactor(pc, PC_AMGF_FACTOR_AUTO));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyType(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (tao->ops->convergencetest == TaoIPFilterDefaultConvergenceTest)
    tao->ops->convergencetest = TaoDefaultConvergenceTest;
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_FALSE));
  if (ip->method.ops) PetscCall(ip->method.ops->compose(tao, PETSC_FALSE));
  PetscCall(TaoDestroy_IPFilter(tao));
  PetscFunctionReturn(0);
}

/*MC
  TAOIPFILTER - Interior point with a filter line search, for problems too large to factor:
  min f(x) subject to c_E(x) = 0, c_I(x) >= 0, or c_l <= c_I(x) <= c_u, and x_l <= x <= x_u

  Options Database Keys:
+ -tao_gatol <1e-8>                                         - KKT error at which the solver has converged, as
                                                              `TaoSetTolerances()` sets it; 0: machine precision
. -tao_ipfilter_tol <1e-8>                                  - the same by another name
. -tao_ipfilter_kkt <relative> (relative,mass)              - dimensionless KKT error, or the absolute mass-weighted one
. -tao_ipfilter_scaling <problem> (problem,gradient,none)   - constants that follow the units, those of IPOPT after a
                                                              scaling
                                                              by the gradients at the start, or those as they stand
. -tao_ipfilter_dual_inf_tol <-1>                           - limit of the stationarity residual's entries at
                                                              convergence, in the caller's units; negative: 1 with
                                                              gradient, else none
. -tao_ipfilter_constr_viol_tol <-1>                        - the same of the constraint violation; negative: 1e-4, or
                                                              none
. -tao_ipfilter_compl_inf_tol <-1>                          - the same of slacks times multipliers; negative: 1e-4, or
                                                              none
. -tao_ipfilter_monitor                                     - a line an iteration, in IPOPT's columns
. -tao_ipfilter_start <warm> (cold,predict,warm)            - slacks and multipliers to start from: constants, predicted
                                                              by a step of the penalized problem, or those of
                                                              `TaoIPFilterSetWarmStart()` where given, else predicted
. -tao_ipfilter_mu_init <1>                                 - cold start: barrier parameter
. -tao_ipfilter_slack_init <1>                              - cold start: slacks
. -tao_ipfilter_dual_init <10>                              - cold start: multipliers of the slacks
. -tao_ipfilter_barrier <mehrotra> (monotone,mehrotra)      - update of the barrier parameter
. -tao_ipfilter_mu_reductions_first <10>                    - monotone: limit of the reductions at the first iteration
. -tao_ipfilter_gamma_phi <1e-8>                            - filter: sufficient reduction of the barrier function phi
. -tao_ipfilter_eta_phi <1e-8>                              - Armijo's constant
. -tao_ipfilter_max_soc <4>                                 - limit of second-order corrections a step
. -tao_ipfilter_delta_max <1e20>                            - largest multiple of M_u that is added to the Hessian
. -tao_ipfilter_forcing <adaptive> (adaptive,fixed)         - Krylov tolerance from the KKT error, or the KSP's own
. -tao_ipfilter_filter_switch <10>                          - `PCAMGF` filters once (J^T D J)_ii exceeds this many times
                                                              H_ii for some i; 0: always
. -tao_ipfilter_subspace <auto> (false,true,auto)           - the filtered subspace method, for linear constraints that
                                                              touch few unknowns
. -tao_ipfilter_subspace_max <0>                            - directions that it keeps, of two vectors each; 0: 80 to
                                                              160, by memory, 48 where the objective is not quadratic
. -tao_ipfilter_ksp_max_it <10000>                          - limit of Krylov iterations in a linear solve, and of all
                                                              directions
                                                              of the filtered subspace method in a `TaoSolve()`
. -tao_ipfilter_pc_amgf_factor <auto> (false,true,auto)     - there, a factorization of the Hessian in place of the AMG
. -tao_ipfilter_direct                                      - MUMPS on the whole matrix, with its inertia, from the
                                                              start
. -tao_ipfilter_direct_memory <2000>                        - MB over all ranks that MUMPS may take for the whole matrix
                                                              where the Krylov method fails; 0: never
. -tao_ipfilter_ksp_type <cg>, -tao_ipfilter_pc_type <amgf> - solver of the condensed system
. -tao_ipfilter_equality <auto> (auto,augmented,condensed)  - equality constraints in an augmented system that MUMPS
                                                              factors, or condensed with proximal updates
. -tao_ipfilter_proximal <1e-5>                             - condensed equality constraints: stiffness that resists
                                                              them, as a fraction of their weights
- -tao_ipfilter_augmented_pc_type <cholesky>                - solver of the augmented system; `MATSOLVERMUMPS` takes
                                                              approximate minimum fill (-mat_mumps_icntl_7 2)

  Level: beginner

  Notes:
  Slacks, multipliers and bounds are eliminated from the Newton system, which leaves A = H + Sigma + J^T D J, solved
  by a Krylov method.
  The unknowns that J touches are composed on A as an IS under `PCAMGF_FILTER_KEY`, where `PCAMGF` finds them.

  Equality constraints go to the symmetric augmented system of A and their Jacobian, which is factored by MUMPS, which
  must be there.
  Constraints that depend on one another are regularized, by proximal terms that leave nothing of them in the solution.

  Equality constraints that touch no more than a tenth of the unknowns, as ties and interface conditions do, need no
  factorization of the whole: where `PCAMGF` preconditions and there are 1,000 unknowns or more, their rows are
  condensed into A with the others, with weights W far above the stiffness that resists them, their unknowns are
  filtered, and proximal updates y <- y + W (J_E dx + c_E) of the multipliers make the step exact. Dependent constraints
  do no harm, and the Hessian need be convex on the constraints alone. Where the updates do not reach the constraints,
  or the Krylov method fails, the augmented system takes over for the rest of the solve, unless
  `-tao_ipfilter_direct_memory` is 0; `TaoIPFilterGetFallbacks()` counts that as a system by MUMPS.
  `-tao_ipfilter_equality` chooses otherwise, `-tao_view` says which was taken.

  `TaoSetHessian()` must give the Hessian of f + DE^T c_E - DI^T c_I, DE and DI being what `TaoGetDualVariables()`
  returns; without it gradients are differenced, up to 1,000 unknowns. Beyond, without equality constraints, a
  `MATLMVMBFGS` learns from the steps of the solve, whose options have the prefix `-tao_ipfilter_`; the matrix that is
  assembled and preconditioned has a multiple of the identity in its place, the Krylov method multiplies with all of it.
  A Hessian of type AIJ, BAIJ, SBAIJ or dense and Jacobians of type AIJ are taken as they are; others that have entries,
  as nests and `MATIS` do, are converted to AIJ at every evaluation. Where a Hessian or Jacobian routine leaves a matrix
  alone that is not converted, that costs nothing: what depends on it is kept. A Hessian that gives products alone, as
  `MATSHELL` does, serves with `-tao_ipfilter_pc_type` none, jacobi, shell or a type of your own, which then gets a
  `MATSHELL` of the condensed matrix; its diagonal is taken from `MATOP_GET_DIAGONAL`, or else estimated. With another
  preconditioner, or with equality constraints that are not condensed, it is read column by column up to 1,000 unknowns,
  as are Jacobians that give products alone; with more unknowns that is an error.

  An error of a library inside the Krylov method or its preconditioner, hypre's say, is a failure of that solve.

  The true residual b - A d of every solve is checked. Where it is too large the solve is continued from the attained
  iterate. Where the Krylov method fails, an AMG kept from an older matrix is rebuilt, then the constraints' unknowns
  are filtered, then their neighbours too, then MUMPS factors the whole matrix within `-tao_ipfilter_direct_memory` (its
  options have the prefix `-tao_ipfilter_direct_`); else the solve ends. `TaoIPFilterGetFallbacks()` counts this.

  With `-tao_ipfilter_subspace` a quadratic objective under linear inequalities that touch few unknowns W is minimized
  over span{e_i, i in W} + span(P), exactly, by an active set method on the first rank; the residual that is left,
  preconditioned by the `PC` of the Krylov method for H alone, is the next direction in P. With
  `-tao_ipfilter_pc_amgf_factor` auto a factorization takes the place of the AMG there once it is estimated to be the
  cheaper for what is to come: `PCAMGFExpect()`, `TaoIPFilterSetSolvesToCome()`; false keeps the AMG. Another objective
  under such constraints is minimized by Newton's method, whose quadratic models are solved so, to a fraction of the
  present residual; products of the directions with the new Hessian are made anew, an indefinite one is shifted, and a
  line search on the objective, penalized where constraints are violated, takes the step. Such a step counts as an
  iteration; a direction counts against the limit of `KSPSetTolerances()`, not that of `TaoSetMaximumIterations()`. The
  directions serve all later solves with the same Hessian, whatever constraints and loads: `TaoIPFilterSetSubspace()`.
  The end is judged as ever, by the KKT error made of the caller's gradient. auto takes it where the routine of the
  Jacobian leaves its matrix alone, W is no more than half of the unknowns, the `PC` is `PCAMGF` with adaptive forcing,
  or a factorization, which is then made of H, once, and nothing but the default is asked of start and measure. Where it
  does not converge the interior point method goes on from the best iterate; `TaoIPFilterGetFallbacks()` counts that.

  An objective that is infinite or NaN at a trial point rejects it; with `TaoSetObjective()` and `TaoSetGradient()` no
  constraint and no derivative is asked for there. Where the Hessian is indefinite a multiple of the identity, or of
  `TaoIPFilterSetPrimalMass()`, is added: `TaoIPFilterGetRegularizations()` tells how often.

  `TaoComputeDualVariables()` gives the multipliers of the bounds, those of upper bounds negative, so that
  grad f + J_E^T DE - J^T DI = DL + DU.

  Bounds on variables enter the diagonal of A alone. Variables with equal bounds keep that value; their entries of the
  gradient that `TaoGetGradient()` returns are zero. Rows of the inequality constraints may have two bounds,
  `TaoSetInequalityBounds()`: such a row has one slack with two multipliers. Where the bounds are equal it is an
  equality constraint; infinite ones are none.

  The KKT error of `-tao_ipfilter_kkt relative` is measured twice, and both must be within the tolerance; with
  `-tao_ipfilter_scaling problem` neither depends on the units of lengths, forces, rows or the objective. First by sizes
  of a kind: the norm of the stationarity residual r over that of the gradient, the largest violation over the largest
  constraint value, the largest product of a slack s or distance t and its multiplier over the largest length times the
  largest multiplier. Where one of these sizes vanishes, a small fraction of its first value, or of what the Hessian's
  diagonal makes of x, takes its place, and a gradient of nothing but rounding is none. Second by what residuals are
  worth in the objective, each of sum_j |r_j| l_j, sum_i m_i |lambda_i| |c_i - s_i| + sum_i |y_i| |c_E,i| and sum_i m_i
  t_i z_i, where l_j is the larger of |x_j| and |r_j| over the diagonal of A, over twenty times |f|; or over twenty
  times 1e-6 of the terms sum_j |x_j (H x)_j| + |x_j g_j| of f, or 1e-8 of those at the start, where f vanishes. In
  these sums no row, bound or unknown is measured by the size of another, a far bound counts no more than a near one,
  and many bounds count as much as the error they make: 2e-7 of the objective at the default tolerance. A number added
  to the objective changes the second measure, not the first.

  With `none` and `gradient` the residuals count as they are, with `gradient` after the objective and each row are
  divided by what brings their gradients at the start down to 100. Absolute limits, in the
  caller's units, hold beside any of these.

  Where the iterates show that inequalities have no interior they are relaxed by a hundredth of the tolerance times
  their size, or by the tolerance if that was not enough, and the sentence says by how much; what that is worth in the
  objective beyond the tolerance makes the result acceptable only. A solve that fails returns the least infeasible of
  its points, and of those within the tolerance the one of the smallest KKT error.

  Of `TaoSetTolerances()` gatol alone counts. TAO means it to be absolute; here it bounds the KKT error, which with
  `-tao_ipfilter_kkt relative` is dimensionless, and `-tao_view` says so. Where `TaoSetConstraintTolerances()` has been
  called (or `-tao_catol`, `-tao_crtol` given), convergence asks for a largest violation of the constraints within
  catol, and a relative one within crtol, besides; 0 is none. `TaoSetConvergenceTest()` replaces
  `TaoIPFilterDefaultConvergenceTest()`. Reasons: `TAO_CONVERGED_GATOL` (KKT error within the tolerance),
  `TAO_CONVERGED_STEPTOL` (only within the acceptable tolerance), `TAO_CONVERGED_MINF` (below `-tao_fmin`),
  `TAO_DIVERGED_LS_FAILURE` (no acceptable step; the constraints may be infeasible), `TAO_DIVERGED_USER` (no direction,
  or the objective seems unbounded), `TAO_DIVERGED_NAN`, `TAO_DIVERGED_MAXITS`, `TAO_DIVERGED_MAXFCN`;
  `TaoIPFilterGetReason()` gives a sentence.

  Errors where a PETSc without MUMPS meets equality constraints that are not condensed, where a matrix cannot be read,
  where a lower bound exceeds an upper one, and where the sizes of the masses do not fit. Scalars must be real.

  References:
+ * - A. Waechter and L. T. Biegler, "On the implementation of an interior-point filter line-search algorithm for
        large-scale nonlinear programming", Mathematical Programming 106, 2006.
. * - N.-Y. Chiang and V. M. Zavala, "An inertia-free filter line-search algorithm for large-scale nonlinear
        programming", Computational Optimization and Applications 64, 2016.
. * - J. Nocedal, A. Waechter and R. A. Waltz, "Adaptive barrier update strategies for nonlinear interior methods",
        SIAM Journal on Optimization 19, 2009.
. * - M. Hintermueller, K. Ito and K. Kunisch, "The primal-dual active set strategy as a semismooth Newton method",
        SIAM Journal on Optimization 13, 2002.
. * - L. F. Portugal, J. J. Judice and L. N. Vicente, "A comparison of block pivoting and interior-point algorithms for
        linear least squares problems with nonnegative variables", Mathematics of Computation 63, 1994.
. * - M. L. Parks, E. de Sturler, G. Mackey, D. D. Johnson and S. Maiti, "Recycling Krylov subspaces for sequences of
      linear
        systems", SIAM Journal on Scientific Computing 28, 2006.
- * - C. Graeser and R. Kornhuber, "Multigrid methods for obstacle problems", Journal of Computational Mathematics 27,
      2009:
        truncated nonsmooth Newton multigrid, the nearest relative of the filtered subspace method.

.seealso: `TaoIPFilterSetSlackMass()`, `TaoIPFilterSetPrimalMass()`, `TaoIPFilterSetWarmStart()`,
          `TaoIPFilterGetSlack()`, `TaoIPFilterGetMultiplier()`,
          `TaoIPFilterGetKKTError()`, `TaoIPFilterGetReason()`, `TaoIPFilterGetSubspace()`, `PCAMGF`
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
  tao->ops->computedual    = IPBoundsMultipliers;
  if (!tao->ops->convergencetest || tao->ops->convergencetest == TaoDefaultConvergenceTest)
    tao->ops->convergencetest = TaoIPFilterDefaultConvergenceTest;
  PetscCall(IPOptionsInitialize(&ip->opt));
  PetscCall(IPRegisterMethods(ip));
  if (ip->method.ops) PetscCall(ip->method.ops->create(tao));
  PetscObjectParameterSetDefault(tao, max_it, 500);
  PetscObjectParameterSetDefault(tao, gatol, 1e-8);
  PetscObjectParameterSetDefault(tao, catol, PETSC_INFINITY);
  PetscObjectParameterSetDefault(tao, crtol, PETSC_INFINITY);
  PetscCall(CreateKSP(tao));
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_TRUE));
  if (ip->method.ops) PetscCall(ip->method.ops->compose(tao, PETSC_TRUE));
  PetscFunctionReturn(0);
}
