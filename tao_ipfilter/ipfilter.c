/* The Tao type: creation, set-up, options, view. */
#include "ipfilterimpl.h"

PetscLogEvent TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve;

static PetscBool events_registered = PETSC_FALSE;

static PetscErrorCode EventsFinalize(void)
{
  PetscFunctionBegin;
  events_registered = PETSC_FALSE;
  PetscFunctionReturn(0);
}

static PetscErrorCode EventsRegister(void)
{
  PetscFunctionBegin;
  if (events_registered) PetscFunctionReturn(0);
  PetscCall(PetscLogEventRegister("TaoIPFltStart", TAO_CLASSID, &TAO_IPFilterStart));
  PetscCall(PetscLogEventRegister("TaoIPFltCondens", TAO_CLASSID, &TAO_IPFilterCondense));
  PetscCall(PetscLogEventRegister("TaoIPFltSolve", TAO_CLASSID, &TAO_IPFilterSolve));
  PetscCall(PetscRegisterFinalize(EventsFinalize));
  events_registered = PETSC_TRUE;
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyAll(size_t n, Vec *const v[])
{
  PetscFunctionBegin;
  for (size_t k = 0; k < n; k++) PetscCall(VecDestroy(v[k]));
  PetscFunctionReturn(0);
}

/* Duplicates layout into n vectors, afresh */
static PetscErrorCode DuplicateInto(Vec layout, size_t n, Vec *const v[])
{
  PetscFunctionBegin;
  PetscCall(DestroyAll(n, v));
  for (size_t k = 0; k < n; k++) {
    PetscCall(VecDuplicate(layout, v[k]));
    PetscCall(VecSet(*v[k], 0.0));
  }
  PetscFunctionReturn(0);
}

/* Vectors of the unknowns, of the inequality and of the equality constraints */
#define IP_PRIMAL_VECS(ip)     {&(ip)->rx, &(ip)->dx, &(ip)->xtrial, &(ip)->xbest, &(ip)->xwork, &(ip)->xwork2, &(ip)->rhs, &(ip)->hdiag, &(ip)->residual}
#define IP_SELDOM_VECS(ip)     {&(ip)->dxfirst, &(ip)->correction} /* of the unknowns, made where a run comes to need them */
#define IP_INEQUALITY_VECS(ip) {&(ip)->c, &(ip)->lambda, &(ip)->rc, &(ip)->rcsoc, &(ip)->dlambda, &(ip)->ctrial, &(ip)->cwork, &(ip)->cwork2, &(ip)->stiffness, &(ip)->sbest, &(ip)->zbest, &(ip)->lambdabest}
#define IP_EQUALITY_VECS(ip)   {&(ip)->ce, &(ip)->y, &(ip)->dy, &(ip)->dyfirst, &(ip)->cetrial, &(ip)->cesoc, &(ip)->ybest}

static PetscErrorCode SetUpInequalities(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  Vec          *v[] = IP_INEQUALITY_VECS(ip);
  Vec           c   = tao->constraints_inequality;

  PetscFunctionBegin;
  PetscCheck(!tao->IU, PetscObjectComm((PetscObject)tao), PETSC_ERR_SUP, "TAOIPFILTER takes no upper bounds of inequality constraints: state c_I(x) <= u as u - c_I(x) >= 0");
  PetscCall(VecGetSize(c, &ip->mi));
  PetscCall(IPPairDestroy(&ip->pair[IP_SLACK]));
  PetscCall(VecDestroy(&tao->DI));
  PetscCall(VecDuplicate(c, &tao->DI));
  PetscCall(VecSet(tao->DI, 0.0));
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCheck(tao->jacobian_inequality, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONGSTATE, "Must call TaoSetJacobianInequalityRoutine() before TaoSolve()");
  if (ip->slack_mass) {
    PetscInt n;

    PetscCall(VecGetSize(ip->slack_mass, &n));
    PetscCheck(n == ip->mi, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_SIZ, "Slack mass has %" PetscInt_FMT " entries for %" PetscInt_FMT " constraints", n, ip->mi);
  }
  PetscCall(DuplicateInto(c, PETSC_STATIC_ARRAY_LENGTH(v), v));
  PetscCall(IPPairCreate(c, ip->slack_mass, &ip->pair[IP_SLACK]));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpEqualities(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  Vec          *v[] = IP_EQUALITY_VECS(ip);
  Vec           c   = tao->constraints_equality;

  PetscFunctionBegin;
  PetscCall(VecGetSize(c, &ip->me));
  PetscCall(VecDestroy(&tao->DE));
  PetscCall(VecDuplicate(c, &tao->DE));
  PetscCall(VecSet(tao->DE, 0.0));
  if (!ip->me) PetscFunctionReturn(0);
  PetscCheck(tao->jacobian_equality, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONGSTATE, "Must call TaoSetJacobianEqualityRoutine() before TaoSolve()");
  PetscCall(DuplicateInto(c, PETSC_STATIC_ARRAY_LENGTH(v), v));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoSetUp_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  Vec          *v[] = IP_PRIMAL_VECS(ip), *seldom[] = IP_SELDOM_VECS(ip);

  PetscFunctionBegin;
  PetscCall(DestroyAll(PETSC_STATIC_ARRAY_LENGTH(seldom), seldom));
  if (!tao->gradient) PetscCall(VecDuplicate(tao->solution, &tao->gradient));
  PetscCall(DuplicateInto(tao->solution, PETSC_STATIC_ARRAY_LENGTH(v), v));
  ip->mi = ip->me = 0;
  if (tao->ineq_constrained) PetscCall(SetUpInequalities(tao));
  if (tao->eq_constrained) PetscCall(SetUpEqualities(tao));
  if (!tao->hessian) PetscCall(IPHessianCreateFD(tao));
  PetscFunctionReturn(0);
}

/* Makes *v, one of IP_SELDOM_VECS() */
PetscErrorCode IPNeedVec(Tao tao, Vec *v)
{
  PetscFunctionBegin;
  if (!*v) PetscCall(VecDuplicate(((TAO_IPFILTER *)tao->data)->dx, v));
  PetscFunctionReturn(0);
}

/* Whether v, made in TaoSetUp(), still is laid out as its model; there is none where n is 0 */
static PetscErrorCode SameLayout(Vec v, Vec model, PetscInt n, PetscBool *same)
{
  PetscInt  size = 0, local[2] = {0, 0};
  PetscBool equal;

  PetscFunctionBegin;
  if (model) PetscCall(VecGetSize(model, &size));
  equal = (PetscBool)(size == n);
  if (equal && n) {
    PetscCall(VecGetLocalSize(v, &local[0]));
    PetscCall(VecGetLocalSize(model, &local[1]));
    equal = (PetscBool)(local[0] == local[1]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &equal, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)model)));
  *same = (PetscBool)(*same && equal);
  PetscFunctionReturn(0);
}

/* Sets up again where the caller has replaced the solution or the constraints by others of another size since */
PetscErrorCode IPSetUpSizes(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscBool     same = PETSC_TRUE;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(VecGetSize(ip->rx, &n));
  PetscCall(SameLayout(ip->rx, tao->solution, n, &same));
  if (tao->ineq_constrained) PetscCall(SameLayout(ip->c, tao->constraints_inequality, ip->mi, &same));
  if (tao->eq_constrained) PetscCall(SameLayout(ip->ce, tao->constraints_equality, ip->me, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&tao->gradient));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairDestroy(&ip->pair[b]));
  PetscCall(IPCondensedDestroy(&ip->cond));
  PetscCall(IPAugmentedDestroy(&ip->aug));
  PetscCall(KSPDestroy(&ip->flexible));
  PetscCall(KSPReset(tao->ksp));
  PetscCall(ISDestroy(&ip->fixed));
  PetscCall(MatDestroy(&ip->JE));
  PetscCall(TaoSetUp_IPFilter(tao));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoDestroy_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip      = (TAO_IPFILTER *)tao->data;
  Vec          *vx[]    = IP_PRIMAL_VECS(ip), *vi[] = IP_INEQUALITY_VECS(ip), *ve[] = IP_EQUALITY_VECS(ip), *vs[] = IP_SELDOM_VECS(ip);
  Vec          *given[] = {&ip->slack_mass, &ip->primal_mass, &ip->warm_s, &ip->warm_z};

  PetscFunctionBegin;
  PetscCall(DestroyAll(PETSC_STATIC_ARRAY_LENGTH(vx), vx));
  PetscCall(DestroyAll(PETSC_STATIC_ARRAY_LENGTH(vs), vs));
  PetscCall(DestroyAll(PETSC_STATIC_ARRAY_LENGTH(vi), vi));
  PetscCall(DestroyAll(PETSC_STATIC_ARRAY_LENGTH(ve), ve));
  PetscCall(DestroyAll(PETSC_STATIC_ARRAY_LENGTH(given), given));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairDestroy(&ip->pair[b]));
  PetscCall(IPCondensedDestroy(&ip->cond));
  PetscCall(ISDestroy(&ip->fixed));
  PetscCall(MatDestroy(&ip->JE));
  PetscCall(VecDestroy(&ip->cscale));
  PetscCall(VecDestroy(&ip->cescale));
  PetscCall(IPAugmentedDestroy(&ip->aug));
  PetscCall(IPDirectDestroy(&ip->direct));
  PetscCall(KSPDestroy(&ip->flexible));
  PetscCall(IPFilterSetDestroy(&ip->filter));
  PetscCall(PetscFree(ip->ksp_iterations));
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_FALSE));
  PetscCall(KSPDestroy(&tao->ksp));
  PetscCall(PetscFree(tao->data));
  PetscFunctionReturn(0);
}

static const char *const IPStarts[]      = {"cold", "predict", "warm", "IPStart", "IP_START_", NULL};
static const char *const IPBarriers[]    = {"monotone", "mehrotra", "IPBarrier", "IP_BARRIER_", NULL};
static const char *const IPKKTMeasures[] = {"relative", "mass", "IPKKTMeasure", "IP_KKT_", NULL};
static const char *const IPForcings[]    = {"adaptive", "fixed", "IPForcing", "IP_FORCING_", NULL};
static const char *const IPScalings[]    = {"problem", "none", "IPScaling", "IP_SCALING_", NULL};

/* Constants of the method with IPOPT's defaults (Waechter and Biegler 2006), by option name without its prefix */
typedef struct {
  const char *option, *text;
  size_t      offset;
  PetscReal   value;
} RealOption;

#define IP_REAL(name, member, value, text) \
  { "-tao_ipfilter_" name, text, offsetof(TAO_IPFILTER, member), value }

static const RealOption real_options[] = {
  IP_REAL("acceptable_tol", acceptable_tol, 1e-6, "KKT error accepted when no further progress is made"),
  IP_REAL("mu_init", mu0, 1.0, "cold start: barrier parameter"),
  IP_REAL("slack_init", s0, 1.0, "cold start: slacks"),
  IP_REAL("dual_init", z0, 10.0, "cold start: multipliers of the slacks"),
  IP_REAL("predict_mu", mu_start, 0.3, "predicted start: mu as a fraction of mean length x mean pressure"),
  IP_REAL("warm_mu", mu_warm, 3e-2, "warm start: least mu as a fraction of the mean product length x pressure"),
  IP_REAL("predict_forcing", forcing_start, 0.1, "predicted start: forces out of balance, as a fraction of those the constraints transmit"),
  IP_REAL("kappa_epsilon", kappa_epsilon, 10.0, "mu is reduced once the barrier error is below kappa_epsilon mu"),
  IP_REAL("kappa_dual", kappa_dual, 0.1, "relative measure: imbalance of forces at which mu may be reduced"),
  IP_REAL("kappa_mu", kappa_mu, 0.2, "linear reduction of mu"),
  IP_REAL("theta_mu", theta_mu, 1.5, "superlinear reduction of mu"),
  IP_REAL("tau_min", tau_min, 0.99, "least fraction to the boundary"),
  IP_REAL("kappa_sigma", kappa_sigma, 1e10, "multipliers are kept within this factor of mu/s"),
  IP_REAL("gamma_theta", gamma_theta, 1e-5, "sufficient reduction of the constraint violation"),
  IP_REAL("gamma_phi", gamma_phi, 1e-8, "sufficient reduction of the barrier function"),
  IP_REAL("eta_phi", eta_phi, 1e-8, "Armijo's constant"),
  IP_REAL("delta_switch", delta_switch, 1.0, "constant of the switching condition"),
  IP_REAL("s_theta", s_theta, 1.1, "exponent of the violation in the switching condition"),
  IP_REAL("s_phi", s_phi, 2.3, "exponent of the descent in the switching condition"),
  IP_REAL("gamma_alpha", gamma_alpha, 0.05, "safety factor of the smallest step"),
  IP_REAL("theta_min_fact", theta_min_fact, 1e-4, "violation below which Armijo may decide, as a fraction of the first"),
  IP_REAL("theta_max_fact", theta_max_fact, 1e4, "largest violation accepted, as a multiple of the first"),
  IP_REAL("obj_max_inc", obj_max_inc, 1e5, "largest rise of the barrier function accepted for less violation, against its size"),
  IP_REAL("kappa_soc", kappa_soc, 0.99, "reduction a second-order correction must give to be continued"),
  IP_REAL("forcing_max", forcing_max, 0.1, "adaptive forcing: linear residual as a fraction of the forces in balance, while mu falls"),
  IP_REAL("forcing_reduce", forcing_reduce, 0.7, "adaptive forcing: linear residual as a fraction of the last stationarity residual"),
  IP_REAL("forcing_last", forcing_last, 0.5, "adaptive forcing: as a fraction of the tolerance, in the step that would finish"),
  IP_REAL("kappa_curvature", kappa_curvature, 1e-11, "curvature d^T W d that a direction must have, as a fraction of d^T d"),
  IP_REAL("delta_first", delta_first, 1e-4, "first regularization"),
  IP_REAL("delta_max", delta_max, 1e20, "largest regularization"),
  IP_REAL("delta_grow_first", delta_grow_first, 100.0, "growth of the regularization before one has worked"),
  IP_REAL("delta_grow", delta_grow, 8.0, "growth of the regularization"),
  IP_REAL("delta_shrink", delta_shrink, 1.0 / 3.0, "decrease of the regularization from one step to the next"),
  IP_REAL("delta_equality", delta_equality, 1e-8, "regularization of dependent equality constraints"),
  IP_REAL("kappa_progress", kappa_progress, 0.9999, "mehrotra: reduction of the KKT error against the worst of the last four, or mu turns monotone"),
  IP_REAL("filter_threshold", filter_threshold, 1e-12, "columns of J above this fraction of its largest entry belong to the filter subspace"),
  IP_REAL("filter_switch", filter_switch, 10.0, "the filter is used once (J^T D J)_ii exceeds this many times H_ii for some i; 0: always"),
  IP_REAL("row_ratio", row_ratio, 100.0, "constraints whose gradient exceeds this many times the smallest at the start are scaled down to that; 0: none"),
  IP_REAL("unbounded_factor", unbounded_factor, 1e10, "fall of the objective, against its first size, that counts as unbounded"),
  IP_REAL("direct_memory", direct_memory, 2000, "MB over all ranks that MUMPS may take for the whole matrix where the Krylov method fails; 0: never"),
  IP_REAL("bound_push", bound_push, 1e-2, "distance of the start from its bounds, relative"),
};

static PetscErrorCode TaoSetFromOptions_IPFilter(Tao tao, AMGFOptionItems PetscOptionsObject)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "Interior point with a filter line search");
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(real_options); k++) {
    PetscReal *value = (PetscReal *)((char *)ip + real_options[k].offset);

    PetscCall(PetscOptionsReal(real_options[k].option, real_options[k].text, TAOIPFILTER, *value, value, NULL));
  }
  PetscCall(PetscOptionsReal("-tao_ipfilter_tol", "KKT error at which the solver has converged: -tao_gatol by another name", TAOIPFILTER, tao->gatol, &tao->gatol, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_start", "starting slacks and multipliers", TAOIPFILTER, IPStarts, (PetscEnum)ip->start, (PetscEnum *)&ip->start, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_barrier", "update of the barrier parameter", TAOIPFILTER, IPBarriers, (PetscEnum)ip->barrier, (PetscEnum *)&ip->barrier, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_kkt", "measure of the KKT error", TAOIPFILTER, IPKKTMeasures, (PetscEnum)ip->measure, (PetscEnum *)&ip->measure, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_forcing", "tolerance of the linear solver: from the KKT error, or the KSP's own", TAOIPFILTER, IPForcings, (PetscEnum)ip->forcing, (PetscEnum *)&ip->forcing, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_scaling", "scale-free constants, or constants in the problem's units", TAOIPFILTER, IPScalings, (PetscEnum)ip->scaling, (PetscEnum *)&ip->scaling, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_mu_reductions_first", "most reductions of mu at the first iteration", TAOIPFILTER, ip->max_mu_first, &ip->max_mu_first, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_mu_reductions", "most reductions of mu at later iterations", TAOIPFILTER, ip->max_mu_later, &ip->max_mu_later, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_max_soc", "most second-order corrections a step", TAOIPFILTER, ip->max_soc, &ip->max_soc, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_acceptable_it", "iterates in a row within the acceptable tolerance that end the solve", TAOIPFILTER, ip->acceptable_it, &ip->acceptable_it, NULL));
  PetscCall(PetscOptionsBool("-tao_ipfilter_direct", "MUMPS on the whole matrix, with its inertia, in place of the Krylov method", TAOIPFILTER, ip->direct_always, &ip->direct_always, NULL));
  PetscCall(PetscOptionsBool("-tao_ipfilter_monitor", "print a line an iteration", TAOIPFILTER, ip->monitor, &ip->monitor, NULL));
  PetscOptionsHeadEnd();
  PetscCall(KSPSetFromOptions(tao->ksp));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoView_IPFilter(Tao tao, PetscViewer viewer)
{
  TAO_IPFILTER               *ip = (TAO_IPFILTER *)tao->data;
  const TaoIPFilterFallbacks *f  = &ip->fallbacks;
  PetscBool                   ascii;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "start %s, barrier %s, forcing %s, KKT measure %s\n", IPStarts[ip->start], IPBarriers[ip->barrier], IPForcings[ip->forcing], IPKKTMeasures[ip->measure]));
  PetscCall(PetscViewerASCIIPrintf(viewer, "inequalities %" PetscInt_FMT ", lower bounds %" PetscInt_FMT ", upper bounds %" PetscInt_FMT "\n", ip->mi, ip->pair[IP_LOWER].n, ip->pair[IP_UPPER].n));
  PetscCall(PetscViewerASCIIPrintf(viewer, "KKT error %g (tolerance %g), unscaled %g; mu %g\n", (double)ip->kkt.error, (double)tao->gatol, (double)ip->kkt.unscaled, (double)ip->mu));
  PetscCall(PetscViewerASCIIPrintf(viewer, "condensed systems %" PetscInt_FMT ", of which with the filter %" PetscInt_FMT "\n", ip->nsystems, ip->nfiltered));
  PetscCall(PetscViewerASCIIPrintf(viewer, "linear solves: largest backward error %g; refined %" PetscInt_FMT ", AMG rebuilt %" PetscInt_FMT ", filter tightened %" PetscInt_FMT ", whole matrix by MUMPS %" PetscInt_FMT ", failed %" PetscInt_FMT "\n", (double)f->backward_error, f->refinements, f->amg_rebuilds, f->filters, f->direct, f->failures));
  PetscCall(PetscViewerASCIIPrintf(viewer, "feasibility restorations %" PetscInt_FMT "\n", ip->nrestored));
  PetscCall(PetscViewerASCIIPrintf(viewer, "steps with a shifted Hessian %" PetscInt_FMT ", largest shift %g, systems solved to find the shifts %" PetscInt_FMT "\n", ip->nregularized, (double)ip->delta_largest, ip->nretried));
  if (ip->reason[0]) PetscCall(PetscViewerASCIIPrintf(viewer, "%s\n", ip->reason));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}

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
  PetscCall(EventsRegister());
  PetscCall(PetscNew(&ip));
  tao->data                = (void *)ip;
  tao->ops->setup          = TaoSetUp_IPFilter;
  tao->ops->solve          = TaoSolve_IPFilter;
  tao->ops->view           = TaoView_IPFilter;
  tao->ops->setfromoptions = TaoSetFromOptions_IPFilter;
  tao->ops->destroy        = TaoDestroy_IPFilter;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(real_options); k++) *(PetscReal *)((char *)ip + real_options[k].offset) = real_options[k].value;
  ip->start         = IP_START_WARM;
  ip->barrier       = IP_BARRIER_MEHROTRA;
  ip->max_mu_first  = 10;
  ip->max_mu_later  = 1;
  ip->max_soc       = 4;
  ip->acceptable_it = 15;
  PetscObjectParameterSetDefault(tao, max_it, 500);
  PetscObjectParameterSetDefault(tao, gatol, 1e-8);
  PetscCall(CreateKSP(tao));
  PetscCall(TaoIPFilterComposeFunctions(tao, PETSC_TRUE));
  PetscFunctionReturn(0);
}
