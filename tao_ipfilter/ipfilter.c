/* The Tao type: its manual page and its creation. */
#include "ipfilterimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"
#include "tao_ipfilter/solver/work.h"

/* Creates the Krylov solver: CG with PCAMGF, whose convergence is tested with the norm of the true residual */
static PetscErrorCode CreateKSP(Tao tao)
{
  PC pc;

  PetscFunctionBegin;
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)tao), &tao->ksp));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)tao->ksp, (PetscObject)tao, 1));
  PetscCall(IPOptionsSetPrefix(tao));
  PetscCall(KSPSetType(tao->ksp, KSPCG));
  PetscCall(KSPSetNormType(tao->ksp, KSP_NORM_UNPRECONDITIONED));
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyType(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (tao->ops->convergencetest == TaoIPFilterDefaultConvergenceTest)
    tao->ops->convergencetest = TaoDefaultConvergenceTest;
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_FALSE));
  if (ip->method->ops) PetscCall(ip->method->ops->compose(tao, PETSC_FALSE));
  PetscCall(TaoDestroy_IPFilter(tao));
  PetscFunctionReturn(0);
}

/* The parts of the solver. Each entry names the type of a part and its member in TAO_IPFILTER. */
/* clang-format off */
#define SOLVER_PARTS \
  PART(IPOptions, opt) PART(IPGiven, given) PART(IPWork, work) PART(IPSides, sides) PART(IPRowScale, rows) \
  PART(IPJacobian, jac) PART(IPHessian, hess) PART(IPFirst, first) PART(IPScale, scale) \
  PART(IPStiffness, stiff) PART(IPTerms, terms) PART(IPKKT, kkt) PART(IPCondensed, cond) PART(IPLinear, lin) \
  PART(IPDirect, direct) PART(IPAugmented, aug) PART(IPProximal, prox) PART(IPBarrier, bar) PART(IPShift, shift) \
  PART(IPFilterSet, filter) PART(IPSearch, search) PART(IPWatchdog, watch) PART(IPRelaxation, relax) \
  PART(IPRestoration, restore) PART(IPMethod, method) PART(IPRecord, rec)
/* clang-format on */

/* The solver and its parts in one block of memory, which DestroyType() frees */
typedef struct {
  TAO_IPFILTER solver;
#define PART(type, member) type member;
  SOLVER_PARTS
#undef PART
} SolverMemory;

static PetscErrorCode SolverCreate(Tao tao)
{
  SolverMemory *memory;

  PetscFunctionBegin;
  PetscCall(PetscNew(&memory));
  tao->data = (void *)&memory->solver;
#define PART(type, member) memory->solver.member = &memory->member;
  SOLVER_PARTS
#undef PART
  PetscFunctionReturn(0);
}

/*MC
  TAOIPFILTER - An interior point method with a filter line search, for problems too large to factor:
  min f(x) subject to c_E(x) = 0, c_I(x) >= 0 (or c_l <= c_I(x) <= c_u), and x_l <= x <= x_u

  Options Database Keys:
+ -tao_gatol <1e-8>                                         - KKT error at which the solver has converged, as
                                                              `TaoSetTolerances()` sets it; 0, or less where the error
                                                              is dimensionless: machine precision
. -tao_ipfilter_tol <1e-8>                                  - alias of `-tao_gatol`
. -tao_ipfilter_kkt <relative> (relative,mass)              - dimensionless KKT error, or the absolute mass-weighted one
. -tao_ipfilter_scaling <problem> (problem,none)            - scaling: `problem`: constants adapt to the units of the
                                                             problem; `none`: no scaling
. -tao_ipfilter_monitor                                     - prints one line per iteration, with IPOPT's columns
. -tao_ipfilter_start <warm> (cold,predict,warm)            - initial slacks and multipliers: `cold`: constants;
                                                              `predict`: from a step of the penalized problem; `warm`:
                                                              those of `TaoIPFilterSetWarmStart()`, if given, else as
                                                              `predict`
. -tao_ipfilter_mu_init <1>                                 - cold start: barrier parameter
. -tao_ipfilter_slack_init <1>                              - cold start: slacks; positive
. -tao_ipfilter_dual_init <10>                              - cold start: multipliers of the slacks
. -tao_ipfilter_barrier <mehrotra> (monotone,mehrotra)      - update of the barrier parameter
. -tao_ipfilter_mu_reductions_first <10>                    - monotone: largest number of reductions of mu at the first
                                                              iteration
. -tao_ipfilter_gamma_phi <1e-8>                            - filter: sufficient reduction of the barrier function phi
. -tao_ipfilter_eta_phi <1e-8>                              - Armijo's constant
. -tao_ipfilter_max_soc <4>                                 - largest number of second-order corrections per step
. -tao_ipfilter_delta_max <1e20>                            - largest multiple of M_u that is added to the Hessian
. -tao_ipfilter_forcing <adaptive> (adaptive,fixed)         - Krylov tolerance from the KKT error, or the KSP's own
. -tao_ipfilter_filter_switch <10>                          - `PCAMGF` uses the filter if (J^T D J)_ii exceeds this
                                                              multiple of H_ii for some i; 0: always
. -tao_ipfilter_subspace <auto> (false,true,auto)           - use the subspace method, for linear constraints
                                                              that involve few unknowns
. -tao_ipfilter_subspace_max <0>                            - largest number of its directions, which are stored in
                                                              single precision; 0: 80, or 48 if the objective is not
                                                              quadratic
. -tao_ipfilter_ksp_max_it <10000>                          - largest number of Krylov iterations in a linear solve, and
                                                              of directions of the subspace method in a
                                                              `TaoSolve()`
. -tao_ipfilter_pc_amgf_factor <auto> (false,true,auto)     - subspace method: use a factorization of the
                                                              Hessian instead of the AMG
. -tao_ipfilter_direct                                      - MUMPS on the whole matrix, with inertia correction, from
                                                              the first system on
. -tao_ipfilter_direct_memory <2000>                        - if the Krylov method fails: largest memory of MUMPS for
                                                              the whole matrix, over all ranks [MB]; 0: MUMPS is not
                                                              used
. -tao_ipfilter_ksp_type <cg>, -tao_ipfilter_pc_type <amgf> - solver of the condensed system; convergence is tested with
                                                              the norm of the true residual, unless the type does not
                                                              compute it (`KSPMINRES`, `KSPSYMMLQ`)
. -tao_ipfilter_equality <auto> (auto,augmented,condensed)  - equality constraints: `augmented`: in an augmented system,
                                                              factored by MUMPS; `condensed`: eliminated, with proximal
                                                              updates of the multipliers
. -tao_ipfilter_proximal <1e-5>                             - condensed equality constraints: stiffness of the Hessian
                                                              in their direction, as a fraction of their weights;
                                                              positive
- -tao_ipfilter_augmented_pc_type <cholesky> (cholesky)     - solver of the augmented system, whose inertia only a
                                                              Cholesky factorization gives; the default ordering of
                                                              `MATSOLVERMUMPS` is approximate minimum fill
                                                              (-mat_mumps_icntl_7 2)

  Level: beginner

  Notes:
  Slacks, multipliers and bounds are eliminated from the Newton system. The remaining matrix is A = H + Sigma + J^T D J.
  MUMPS factors systems of up to 500 unknowns, if the types of Krylov method and preconditioner are the defaults and
  `-tao_ipfilter_direct_memory` is not 0. A Krylov method solves all others. The unknowns in nonzero columns of J are
  composed on A as an IS under `PCAMGF_FILTER_KEY`; `PCAMGF` uses them as filter.

  Equality constraints are kept in the symmetric augmented system of A and their Jacobian, which is factored by MUMPS.
  PETSc must have MUMPS. Linearly dependent constraints are regularized by proximal terms, which vanish at the solution.

  Equality constraints with nonzeros in at most a tenth of the unknowns (ties, interface conditions) do not need this
  factorization if the preconditioner is `PCAMGF` and there are at least 1,000 unknowns. Then their rows are condensed
  into A too, with weights W much larger than the stiffness of the Hessian in their direction. Their unknowns are
  filtered, and proximal updates y <- y + W (J_E dx + c_E) of the multipliers make the step exact. Linearly dependent
  constraints are allowed, and the Hessian must be convex only on the null space of the constraints. If the updates do
  not converge, or the Krylov method fails, the augmented system is used for the rest of the solve, unless
  `-tao_ipfilter_direct_memory` is 0; `TaoIPFilterGetFallbacks()` counts that as a system solved by MUMPS.
  `-tao_ipfilter_equality` sets the method, `-tao_view` prints which was used.

  `TaoSetHessian()` must give the Hessian of f + DE^T c_E - DI^T c_I. DE and DI are the multipliers that
  `TaoGetDualVariables()` returns. Without `TaoSetHessian()` the Hessian is computed by finite differences of gradients,
  up to 1,000 unknowns.

  A Hessian of type AIJ, BAIJ, SBAIJ or dense, and Jacobians of type AIJ, are used without conversion. Other assembled
  types, such as `MATNEST` and `MATIS`, are converted to AIJ at every evaluation. If a Hessian or Jacobian routine does
  not change a matrix of a type without conversion, everything that depends on it is reused.

  A Hessian that only supports products, such as `MATSHELL`, can be used with `-tao_ipfilter_pc_type` none, jacobi,
  shell or a type of your own. The preconditioner then gets a `MATSHELL` of the condensed matrix, whose diagonal comes
  from `MATOP_GET_DIAGONAL` or is estimated. With another preconditioner, or with equality constraints that are not
  condensed, the matrix is computed column by column, up to 1,000 unknowns; so are Jacobians that only support products.
  With more unknowns this is an error.

  An error of a library inside the Krylov method or its preconditioner (for example hypre) counts as a failure of that
  solve.

  The true residual b - A d of every solve is checked. If it is too large the solve is continued from the last iterate.
  If the Krylov method fails, these remedies are tried in turn: an AMG of an older matrix is rebuilt; the unknowns of
  the constraints are filtered; their neighbours are filtered too; MUMPS factors the whole matrix, if that needs at most
  `-tao_ipfilter_direct_memory` (its options have the prefix `-tao_ipfilter_direct_`); otherwise the solve ends.
  `TaoIPFilterGetFallbacks()` counts the remedies.

  The subspace method, `-tao_ipfilter_subspace`, is for linear inequalities that involve few unknowns, the set
  W. A quadratic objective is minimized exactly over span{e_i, i in W} + span(P), by an active set method on the first
  rank. The `PC` of the Krylov method for H is applied to the remaining residual, which gives the next direction in P.
  With `-tao_ipfilter_pc_amgf_factor` auto a factorization replaces the AMG there if H is small, see
  `PCAMGFSetFactor()`.

  A nonquadratic objective with such constraints is minimized by Newton's method. This method solves its quadratic
  models to a fraction of the current residual. For each new Hessian the products with the directions are computed
  again. An indefinite Hessian is shifted. A line search on the objective, with a penalty for violated constraints,
  gives the step length. Each Newton step counts as an iteration. A direction counts towards the limit of
  `KSPSetTolerances()`, not that of `TaoSetMaximumIterations()`.

  The directions are reused in all later solves with the same Hessian, for any constraints and loads:
  `TaoIPFilterSetSubspace()`. Convergence is tested as in the interior point method, by the KKT error with the caller's
  gradient. If the method does not converge, the interior point method continues from the best iterate;
  `TaoIPFilterGetFallbacks()` counts that. `auto` uses the method if four conditions hold: the routine of the Jacobian
  does not change its matrix; W has at most half of the unknowns; the `PC` is `PCAMGF` with adaptive forcing, or a
  factorization (then of H, computed once); start and KKT measure have their defaults.

  A trial point at which the objective is infinite or NaN is rejected. With `TaoSetObjective()` and `TaoSetGradient()`
  constraints and derivatives are not evaluated there. If the Hessian is indefinite, a multiple of the identity, or of
  `TaoIPFilterSetPrimalMass()`, is added. `TaoIPFilterGetRegularizations()` returns how often.

  `TaoComputeDualVariables()` gives the multipliers of the bounds, those of upper bounds negative, so that
  grad f + J_E^T DE - J^T DI = DL + DU.

  Bounds on variables only change the diagonal of A. Variables with equal bounds keep that value; their entries of the
  gradient that `TaoGetGradient()` returns are zero. Rows of the inequality constraints may have two bounds,
  `TaoSetInequalityBounds()`: such a row has one slack with two multipliers. A row with equal bounds is an equality
  constraint. Bounds of magnitude 1e19 or more, of variables and of rows, count as infinite and are ignored.

  The KKT error of `-tao_ipfilter_kkt relative` has two measures, which both must be within the tolerance. With
  `-tao_ipfilter_scaling problem` neither depends on the units of lengths, forces, rows or the objective.

  The first measure is the largest of three ratios. They are the norm of the stationarity residual r over that of the
  gradient; the largest violation over the largest constraint value; and the largest product of a slack s or distance t
  and its multiplier, over the product of the largest length and the largest multiplier. If a divisor is zero, it is
  replaced by a small fraction of its initial value, or of the value from the Hessian's diagonal and x. A gradient that
  consists of rounding errors counts as zero.

  The second measure is a bound of the error of the objective f that the residuals cause, relative to f. The bound is
  the largest of three sums: sum_j |r_j| l_j; sum_i m_i |lambda_i| |c_i - s_i| + sum_i |y_i| |c_E,i|; and
  sum_i m_i t_i z_i. The length l_j is |x_j|, or |r_j| over the diagonal entry of A if that is larger. The bound is
  divided by 20 max(|f|, 1e-6 F, 1e-8 F_0), where F = sum_j |x_j (H x)_j| + |x_j g_j| is the magnitude of the terms of
  f, and F_0 is F at the start. In the sums each row, bound and unknown is measured by its own size, so distant bounds
  have no larger weight than near ones. At the default tolerance the error of the objective is about 2e-7. A constant
  added to the objective changes the second measure, not the first.

  With `none` the residuals are absolute.

  If the iterates show that the inequalities have no interior, they are relaxed by a hundredth of the tolerance times
  their size, or by the tolerance if that is not enough. The sentence of `TaoIPFilterGetReason()` states by how much. If
  this changes the objective by more than the tolerance, the result is only acceptable (`TAO_CONVERGED_STEPTOL`). A
  solve that fails returns the point with the smallest violation, or, among the points within the tolerance, the one
  with the smallest KKT error.

  Of `TaoSetTolerances()` only gatol is used. In TAO it is absolute; here it is the limit of the KKT error, which is
  dimensionless with `-tao_ipfilter_kkt relative`. Where `TaoSetConstraintTolerances()` has been called (or
  `-tao_catol`, `-tao_crtol` given), convergence also requires that the largest violation of the constraints is within
  catol, and the largest relative one within crtol; 0: no such limit. `TaoSetConvergenceTest()` replaces
  `TaoIPFilterDefaultConvergenceTest()`. Reasons: `TAO_CONVERGED_GATOL` (KKT error within the tolerance),
  `TAO_CONVERGED_STEPTOL` (only the acceptable tolerance was reached), `TAO_CONVERGED_MINF` (below `-tao_fmin`),
  `TAO_DIVERGED_LS_FAILURE` (no acceptable step; the constraints may be infeasible), `TAO_DIVERGED_USER` (no direction,
  or the objective seems unbounded), `TAO_DIVERGED_NAN` (a value is not a number, at the start, at an iterate or at all
  points that were tried after it), `TAO_DIVERGED_MAXITS`, `TAO_DIVERGED_MAXFCN`; `TaoIPFilterGetReason()` gives a
  sentence.

  Errors: equality constraints that are not condensed need MUMPS, but PETSc has none; a matrix cannot be read; a lower
  bound exceeds an upper one; a mass, a bound or a starting value is not laid out as the unknowns or constraints to
  which it belongs. Scalars must be real.

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
        linear systems", SIAM Journal on Scientific Computing 28, 2006.
- * - C. Graeser and R. Kornhuber, "Multigrid methods for obstacle problems", Journal of Computational Mathematics 27,
        2009: truncated nonsmooth Newton multigrid, the published method most similar to the subspace method.

.seealso: `TaoIPFilterSetSlackMass()`, `TaoIPFilterSetCompliance()`, `TaoIPFilterSetPrimalMass()`,
          `TaoIPFilterSetWarmStart()`, `TaoIPFilterSetNormTerms()`, `TaoIPFilterGetSlack()`,
          `TaoIPFilterGetMultiplier()`, `TaoIPFilterGetKKTError()`, `TaoIPFilterGetReason()`,
          `TaoIPFilterGetFallbacks()`, `TaoIPFilterGetSubspace()`, `TaoIPFilterSetSubspace()`, `PCAMGF`
M*/
PETSC_EXTERN PetscErrorCode TaoCreate_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip;

  PetscFunctionBegin;
  PetscCall(IPLogRegister());
  PetscCall(SolverCreate(tao));
  ip                       = (TAO_IPFILTER *)tao->data;
  tao->ops->setup          = TaoSetUp_IPFilter;
  tao->ops->solve          = TaoSolve_IPFilter;
  tao->ops->view           = TaoView_IPFilter;
  tao->ops->setfromoptions = TaoSetFromOptions_IPFilter;
  tao->ops->destroy        = DestroyType;
  tao->ops->computedual    = IPBoundsMultipliers;
  if (!tao->ops->convergencetest || tao->ops->convergencetest == TaoDefaultConvergenceTest)
    tao->ops->convergencetest = TaoIPFilterDefaultConvergenceTest;
  PetscCall(IPOptionsInitialize(ip->opt));
  PetscCall(IPRegisterMethods(ip));
  if (ip->method->ops) PetscCall(ip->method->ops->create(tao));
  PetscObjectParameterSetDefault(tao, max_it, 3000);
  PetscObjectParameterSetDefault(tao, gatol, 1e-8);
  PetscObjectParameterSetDefault(tao, catol, PETSC_INFINITY);
  PetscObjectParameterSetDefault(tao, crtol, PETSC_INFINITY);
  PetscCall(CreateKSP(tao));
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_TRUE));
  if (ip->method->ops) PetscCall(ip->method->ops->compose(tao, PETSC_TRUE));
  PetscFunctionReturn(0);
}
