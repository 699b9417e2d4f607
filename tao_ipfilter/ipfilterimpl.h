/*
   TAOIPFILTER: primal-dual interior point with a filter line search.

   The problem is min f(x) subject to c_E(x) = 0, c_I(x) >= 0, x_l <= x <= x_u. With slacks s for c_I and lumped weights
   M = diag(m_i) the Lagrangian is

     L = f(x) + y^T c_E(x) - lambda^T M (c_I(x) - s) - z^T M s - bound terms,

   so that c_I may be a length, z a pressure and m_i an area. The barrier function is f - mu sum_i m_i log s_i.

   Every inequality, slack or bound, is a complementarity pair (t, z) with t z = mu: t is s, x - x_l or x_u - x.
*/
#ifndef IPFILTERIMPL_H
#define IPFILTERIMPL_H

#include <petsc/private/taoimpl.h>
#include "../pc_amgf/petsccompat.h"
#include <petscamgf.h>

#if defined(PETSC_USE_COMPLEX)
  #error "ipfilter needs a PETSc with real scalars: inequalities order numbers"
#endif

typedef enum {
  IP_START_COLD,
  IP_START_PREDICT,
  IP_START_WARM
} IPStart;
typedef enum {
  IP_BARRIER_MONOTONE,
  IP_BARRIER_MEHROTRA
} IPBarrier;
typedef enum {
  IP_KKT_RELATIVE,
  IP_KKT_MASS
} IPKKTMeasure;
typedef enum {
  IP_FORCING_ADAPTIVE,
  IP_FORCING_FIXED
} IPForcing;
typedef enum {
  IP_SCALING_PROBLEM,
  IP_SCALING_NONE
} IPScaling;

/* Blocks of complementarity pairs */
enum {
  IP_SLACK,
  IP_LOWER,
  IP_UPPER,
  IP_NPAIRS
};

/* Pairs (t_i, z_i), t_i z_i -> mu. Where a bound is absent t is PETSC_INFINITY and z is zero. */
typedef struct {
  PetscInt  n;      /* pairs present, over all ranks; the vectors are NULL when there are none */
  PetscReal weight; /* sum of the weights of the pairs present */
  Vec       w;      /* weights m_i */
  Vec       t, z;   /* distance to the boundary and its multiplier */
  Vec       dt, dz; /* direction */
  Vec       target; /* right-hand side of the linearized t z = target: mu, or mu less the second-order term */
  Vec       trial;  /* t at a trial point */
} IPPair;

/* What came of a linear solve */
typedef enum {
  IP_LINEAR_SOLVED,
  IP_LINEAR_INDEFINITE, /* the matrix is not positive definite */
  IP_LINEAR_FAILED      /* the solver has failed, which says nothing about the matrix */
} IPLinearVerdict;

#define IP_TINY_STEP       (10.0 * PETSC_MACHINE_EPSILON) /* of x: rounding makes such steps */
#define IP_LEAST_SLACK     1e-14 /* of the size of the constraints: smaller ones only cost accuracy, and tell that there is no interior */
#define IP_MANY_ITERATIONS 500 /* of a Krylov method, when others of the same problem took few */

/* Magnitudes by which residuals are divided; all 1 in the published measure */
typedef struct {
  PetscReal dual;     /* forces that cancel in the stationarity condition */
  PetscReal length;   /* values of c_I */
  PetscReal equality; /* values of c_E */
  PetscReal pressure; /* multipliers */
  PetscReal product;  /* length x pressure: complementarity and mu */
} IPScale;

/* Residuals of the optimality conditions at the current iterate */
typedef struct {
  PetscReal dual, primal, complementarity; /* divided by the scales, mu = 0 */
  PetscReal centrality;                    /* as complementarity, for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity): decides convergence */
  PetscReal barrier;                       /* max(dual, primal, centrality): decides when mu is reduced */
  PetscReal unscaled;                      /* largest absolute entry of all residuals, mu = 0 */
  PetscReal dual_norm;                     /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du;                /* largest absolute entries of the primal and the dual residual */
} IPKKT;

/* Pairs (theta, phi) that no later iterate may be dominated by */
typedef struct {
  PetscInt   n, max;
  PetscReal *theta, *phi;
} IPFilterSet;

/* The condensed matrix A = H + Sigma + J^T D J + delta M_u and what its assembly reuses */
typedef struct {
  Mat              A;
  Mat              J, DJ, JtDJ;              /* Jacobian as AIJ, D J, J^T D J */
  Vec              shift;                    /* Sigma + delta M_u, the diagonal added to H */
  Vec              hdiag;                    /* diagonal of H, kept while a shift is added to it */
  PetscBool        shifted;                  /* A's diagonal holds a shift */
  PetscObjectState H_state, H_nonzero;       /* of the H that A was assembled from */
  PetscObjectId    H_id, J_id, JtDJ_id;      /* which H, which Jacobian, and which Jacobian the product came from */
  PetscObjectState J_state, J_nonzero;       /* of the caller's Jacobian that J and the filter came from */
  PetscObjectState JtDJ_nonzero;             /* of the caller's Jacobian that the product's pattern came from */
  PetscInt         nrows;                    /* rows of this rank touched by J^T D J */
  PetscInt        *rows;
  IS               filter;                   /* composed on A under PCAMGF_FILTER_KEY */
} IPCondensed;

/* The condensed matrix factored by MUMPS, where the Krylov method fails */
typedef struct {
  Mat      A, F;     /* the matrix as MUMPS takes it, and its factors */
  PetscInt system;   /* which condensed matrix that was, by ip->nsystems */
  PetscInt negative; /* its negative pivots */
} IPDirect;

/* The symmetric system [A J_E^T; J_E -delta_c] that equality constraints lead to, and its factorization */
typedef struct {
  KSP ksp;
  Mat K;
  Mat shift; /* -delta_c I */
  Vec rhs, sol, sol2, correction;
} IPAugmented;

typedef struct {
  /* iterate and direction beside tao->solution and the pairs */
  Vec       c, lambda;          /* c_I and its multipliers (a density: the force is M lambda) */
  Vec       rc;                 /* c_I - s */
  Vec       rx;                 /* grad f - J^T M lambda - bound multipliers */
  Vec       dx, dlambda;
  PetscReal f;
  Vec       ce, y, dy;          /* c_E, its multipliers and their direction; NULL without equality constraints */
  Mat       JE;                 /* their Jacobian as the iteration sees it */
  PetscInt  me;                 /* equality constraints, all ranks */
  Vec       cscale, cescale;    /* scales of the rows of c_I and c_E; NULL: 1 */
  Vec       xtrial, ctrial, cetrial;
  Vec       xbest, sbest, zbest, lambdabest, ybest; /* iterate of smallest KKT error */
  Vec       dxfirst, dyfirst, rcsoc, cesoc;         /* second-order correction: the direction before it, its residuals */
  PetscReal ftrial, fbest;
  Vec       xwork, xwork2, cwork, cwork2, rhs;
  Vec       residual, correction;    /* b - A d of the last linear solve, and what refines d */
  KSP       flexible;                /* for corrections; NULL until one is needed */
  Vec       slack_mass, primal_mass; /* the caller's M_s and M_u; NULL means 1 */
  Vec       warm_s, warm_z;          /* the caller's starting values */
  Vec       stiffness;               /* rho: pressure per length that resists each constraint, from the diagonal of H */
  PetscReal stiffness_mean;          /* harmonic mean of rho, weighted */
  PetscReal jnorm;                   /* largest row sum of |J| at the start */
  Vec       hdiag;                   /* |diagonal of H| at the start */
  IS        fixed;                   /* variables of this rank with equal bounds; NULL if no rank has one */
  PetscInt  mi;                      /* inequality constraints, all ranks */
  PetscReal f0, gradient0, length0, equality0, xsize0; /* objective, norm of its gradient and sizes of c_I, c_E and x at the start */
  PetscReal floor0;                  /* what rounding leaves of the gradient there */

  IPPair      pair[IP_NPAIRS];
  IPCondensed cond;
  IPAugmented aug;
  IPDirect    direct;
  IPFilterSet filter;
  IPScale     scale;
  IPKKT       kkt;

  /* barrier */
  PetscReal mu;
  PetscReal corrector_max;           /* mehrotra: bound of the second-order term */
  PetscBool free_mu;                 /* mehrotra: mu follows the affine step; otherwise Fiacco-McCormick */
  PetscReal error_history[4];        /* KKT errors that the free mode must improve on */
  PetscInt  nerror;
  PetscBool curved;                  /* a step has shown constraints that are not linear, or an objective that is not convex */
  PetscInt  hold;                    /* mehrotra: iterations left in the monotone mode that a failed line search called for */

  /* line search */
  PetscReal theta, phi, theta0, theta_ref, phi_ref;
  PetscReal equality_weight;         /* brings c_E to the units of theta */
  PetscReal rounding;                /* changes of phi below this mean nothing */
  PetscReal alpha_primal, alpha_dual;
  PetscInt  nls;
  char      step_tag;                /* how the step was accepted: f, h, F, H (second-order correction), T */

  /* restoration */
  PetscReal zeta;                    /* weight of the distance from the last point against the violation */
  PetscInt  nrestored;               /* restorations in this solve */
  PetscReal relaxed;                 /* what c_I is raised by, for constraints without an interior */
  PetscReal least_slack;             /* that the last step left */
  PetscInt  nvanished;               /* iterates in a row that have a slack of next to nothing */

  /* regularization */
  PetscReal delta, delta_last, hscale;
  PetscInt  nregularized, nretried;  /* steps taken with a shifted Hessian, and systems solved to find the shift */
  PetscReal delta_largest;           /* largest shift a step was taken with */
  PetscReal delta_c;                 /* regularization of dependent equality constraints */

  /* record */
  PetscInt  niter_ksp, max_ksp, *ksp_iterations; /* Krylov iterations of every linear solve */
  PetscInt  most_ksp;                            /* most of them in a solve that gave a direction */
  PetscInt  ksp_last, linear_limit;              /* iterations of the last solve, and their limit */
  PetscReal linear_target, linear_rhs;           /* ||b - A d|| asked of the last solve, and ||b|| */
  PetscReal linear_residual, backward_error;     /* ||b - A d|| of the last solve, and over the terms it is the difference of */
  PetscBool linear_failed;                       /* no solver gave the last direction, for reasons other than the matrix's inertia */
  char      linear_reason[128];                  /* why the last resort did not help */
  PetscInt  ndirect;                             /* solves in a row that only the last resort could do */
  PetscBool filter_forced;                       /* the filter stays on */
  TaoIPFilterFallbacks fallbacks;
  PetscInt  nsystems, nfiltered;                 /* condensed matrices, and those preconditioned with the filter */
  PetscBool filtered;                            /* the present one is */
  PetscReal best_error;
  PetscInt  ntiny;                               /* steps in a row that are as small as rounding */
  PetscInt  nacceptable;                         /* iterates in a row within the acceptable tolerance */
  KSPConvergedReason ksp_reason;                 /* of the last solve */
  PetscReal dx_norm;
  char      reason[256];

  /* options */
  PetscReal    tol; /* of this solve: tao->gatol */
  PetscReal    acceptable_tol;
  PetscInt     acceptable_it;
  IPStart      start;
  IPBarrier    barrier;
  IPKKTMeasure measure;
  IPForcing    forcing;
  IPScaling    scaling;
  PetscBool    monitor;
  PetscReal    delta_equality, kappa_progress;
  PetscReal    mu0, s0, z0, mu_start, mu_warm, forcing_start;
  PetscReal    kappa_epsilon, kappa_dual, kappa_mu, theta_mu, tau_min, kappa_sigma;
  PetscInt     max_mu_first, max_mu_later;
  PetscReal    gamma_theta, gamma_phi, eta_phi, delta_switch, s_theta, s_phi, gamma_alpha, theta_min_fact, theta_max_fact, obj_max_inc;
  PetscInt     max_soc;
  PetscReal    kappa_soc;
  PetscReal    forcing_max, forcing_reduce, forcing_last;
  PetscReal    kappa_curvature, delta_first, delta_max, delta_grow_first, delta_grow, delta_shrink;
  PetscReal    filter_threshold, filter_switch, row_ratio;
  PetscReal    bound_push, unbounded_factor;
  PetscReal    direct_memory;
  PetscBool    direct_always;
} TAO_IPFILTER;

/* No value of a function there: NaN, or infinite, be it C's infinity or PETSc's large number */
static inline PetscBool IPUndefined(PetscReal value)
{
  return (PetscBool)(PetscIsInfOrNanReal(value) || PetscAbsReal(value) >= PETSC_INFINITY);
}

PETSC_INTERN PetscLogEvent TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve;

/* pairs.c */
PETSC_INTERN PetscErrorCode IPPairCreate(Vec, Vec, IPPair *);
PETSC_INTERN PetscErrorCode IPPairDestroy(IPPair *);
PETSC_INTERN PetscErrorCode IPPairSetTarget(IPPair *, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPPairGetSigma(const IPPair *, Vec);
PETSC_INTERN PetscErrorCode IPPairGetForce(const IPPair *, Vec);
PETSC_INTERN PetscErrorCode IPPairDualDirection(IPPair *);
PETSC_INTERN PetscErrorCode IPPairMaxStep(Vec, Vec, PetscReal, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairLogSum(const IPPair *, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairLogSlope(const IPPair *, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairProducts(const IPPair *, PetscReal, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairStepProducts(const IPPair *, PetscReal, PetscReal, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairSafeguard(IPPair *, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPPairLift(IPPair *, Vec, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPPairMoveTrial(IPPair *, PetscReal);

/* fixed.c */
PETSC_INTERN PetscBool      IPIsFixed(PetscScalar, PetscScalar);
PETSC_INTERN PetscErrorCode IPFixedSetUp(Tao);
PETSC_INTERN PetscErrorCode IPFixedZero(Tao, Vec);
PETSC_INTERN PetscErrorCode IPFixedMatrix(Tao, Mat);

/* scaling.c */
PETSC_INTERN PetscErrorCode IPScalingSetUp(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPScalingReset(Tao);
PETSC_INTERN PetscErrorCode IPScalingJacobian(Tao, Mat, Vec, Mat *);
PETSC_INTERN PetscErrorCode IPScalingPair(Tao, Vec, Vec, PetscBool);
PETSC_INTERN PetscErrorCode IPScalingNorm(Vec, Vec, Vec, PetscReal *);

/* bounds.c */
PETSC_INTERN PetscErrorCode IPBoundsSetUp(Tao);
PETSC_INTERN PetscErrorCode IPBoundsPush(Tao);
PETSC_INTERN PetscErrorCode IPBoundsDistance(Tao, Vec, PetscBool);

/* start.c */
PETSC_INTERN PetscErrorCode IPStartPoint(Tao);
PETSC_INTERN PetscErrorCode IPCentralPair(Vec, Vec, PetscReal, Vec, Vec);

/* evaluate.c */
PETSC_INTERN PetscErrorCode IPEvaluateConstraints(Tao, Vec, Vec, Vec);
PETSC_INTERN PetscErrorCode IPEvaluateDerivatives(Tao);
PETSC_INTERN PetscErrorCode IPSetMultipliers(Tao);
PETSC_INTERN PetscErrorCode IPHessianCreateFD(Tao);

/* kkt.c */
PETSC_INTERN PetscErrorCode IPComputeKKT(Tao);
PETSC_INTERN PetscErrorCode IPComputeScale(Tao);
PETSC_INTERN PetscErrorCode IPCancellation(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPComputeStiffness(Tao);
PETSC_INTERN PetscErrorCode IPStationarity(Tao, Vec, Vec);

/* condense.c */
PETSC_INTERN PetscErrorCode IPCondenseMatrix(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondenseJacobian(Tao);
PETSC_INTERN PetscErrorCode IPCondenseRHS(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPBackSubstitute(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondensedWriteHessian(Tao, PetscBool pattern, PetscBool values);
PETSC_INTERN PetscErrorCode IPCondensedAddProduct(IPCondensed *);
PETSC_INTERN PetscErrorCode IPCondensedDestroy(IPCondensed *);

/* subspace.c */
PETSC_INTERN PetscErrorCode IPSubspaceFind(Tao, IS *);
PETSC_INTERN PetscErrorCode IPSubspaceSwitch(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceGrow(Tao, IS *);

/* linsolve.c */
PETSC_INTERN PetscErrorCode IPLinearSolve(Tao, Vec, Vec, PetscReal, PetscBool *);
PETSC_INTERN PetscErrorCode IPKrylovSolve(Tao, Vec, Vec, IPLinearVerdict *);
PETSC_INTERN PetscErrorCode IPMeasureResidual(Tao, Vec, Vec);
PETSC_INTERN PetscBool      IPLinearReached(const TAO_IPFILTER *, KSPConvergedReason);
PETSC_INTERN PetscErrorCode IPLinearRefine(Tao, Vec, Vec, PetscBool, PetscErrorCode (*)(Tao, Vec, Vec), KSPConvergedReason);

/* fallback.c */
PETSC_INTERN PetscErrorCode IPFallback(Tao, Vec, Vec, IPLinearVerdict *);
PETSC_INTERN PetscErrorCode IPLinearNotANumber(Tao);
PETSC_INTERN PetscBool      IPFallbackHolds(const TAO_IPFILTER *);

/* direct.c */
PETSC_INTERN PetscErrorCode IPDirectSolve(Tao, Vec, Vec, IPLinearVerdict *);
PETSC_INTERN PetscErrorCode IPDirectDestroy(IPDirect *);

/* augmented.c */
PETSC_INTERN PetscErrorCode IPAugmentedSolve(Tao, Vec, Vec, Vec, PetscBool, PetscBool *);
PETSC_INTERN PetscErrorCode IPEstimateMultipliers(Tao);
PETSC_INTERN PetscErrorCode IPAugmentedDestroy(IPAugmented *);

/* regularize.c */
PETSC_INTERN PetscErrorCode IPComputeDirection(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPCorrectDirection(Tao, Vec, Vec, PetscBool *);
PETSC_INTERN PetscErrorCode IPRegularize(Tao, PetscReal, PetscErrorCode (*)(Tao), PetscErrorCode (*)(Tao, PetscBool *), PetscBool *);
PETSC_INTERN PetscErrorCode IPSetTargets(Tao, PetscReal, PetscReal);

/* restore.c */
PETSC_INTERN PetscErrorCode IPRestore(Tao, PetscBool *, PetscBool *);

/* relax.c */
PETSC_INTERN PetscErrorCode IPRelax(Tao);

/* barrier.c */
PETSC_INTERN PetscErrorCode IPBarrierUpdate(Tao);
PETSC_INTERN PetscErrorCode IPBarrierHold(Tao, PetscInt);
PETSC_INTERN PetscErrorCode IPBarrierFromAffine(Tao);
PETSC_INTERN PetscErrorCode IPBarrierAverage(Tao, PetscReal *);

/* filter.c */
PETSC_INTERN PetscErrorCode IPFilterSetReset(IPFilterSet *);
PETSC_INTERN PetscErrorCode IPFilterSetAdd(IPFilterSet *, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPFilterSetAccepts(const IPFilterSet *, PetscReal, PetscReal, PetscBool *);
PETSC_INTERN PetscErrorCode IPFilterSetDestroy(IPFilterSet *);

/* linesearch.c */
PETSC_INTERN PetscErrorCode IPLineSearch(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPFilterAdd(Tao);
PETSC_INTERN PetscErrorCode IPMeasureTrial(Tao, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPFractionToBoundary(Tao, PetscReal, PetscReal *, PetscReal *);

/* monitor.c */
PETSC_INTERN PetscErrorCode IPMonitor(Tao);
PETSC_INTERN PetscErrorCode IPSetReason(Tao, TaoConvergedReason, const char[], ...);

/* ipfilter.c */
PETSC_INTERN PetscErrorCode IPSetUpSizes(Tao);
PETSC_INTERN PetscErrorCode IPNeedVec(Tao, Vec *);

/* driver.c */
PETSC_INTERN PetscErrorCode TaoSolve_IPFilter(Tao);

/* interface.c */
PETSC_INTERN PetscErrorCode TaoIPFilterComposeFunctions(Tao, PetscBool);

#endif
