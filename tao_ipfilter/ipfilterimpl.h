/*
   TAOIPFILTER: primal-dual interior point with a filter line search.

   The problem is min f(x) subject to c_E(x) = 0, c_I(x) >= 0, x_l <= x <= x_u. With slacks s for c_I and lumped weights
   M = diag(m_i) the Lagrangian is

     L = f(x) + y^T c_E(x) - lambda^T M (c_I(x) - s) - z^T M s - bound terms,

   so that c_I may be a length, z a pressure and m_i an area. The barrier function is f - mu sum_i m_i log s_i.

   Every inequality, slack or bound, is a complementarity pair (t, z) with t z = mu: t is s, x - x_l or x_u - x. A row
   with two bounds, 0 <= c_I(x) <= range, has one slack with two pairs: t is s and range - s.

   Of the folders none calls one that stands below it in this list; what is on top of them, the type, is in this one.

     problem  the problem as the iteration sees it: pairs, iterates, bounds, sides, scales of rows, Jacobians, Hessian
     measure  sizes and residuals: stiffness, scales, norm terms, what residuals are worth, the KKT error
     system   the condensed matrix A = H + Sigma + J^T D J + delta M_u and its filter
     linear   linear systems: Krylov methods, MUMPS, equality constraints
     space    the filtered subspace: directions, the reduced problem, its active sets and the laws of norm terms
     step     a step: filter, barrier, direction, line search, restoration
     driver   the iteration: set up, solve, convergence, reasons
*/
#ifndef IPFILTERIMPL_H
#define IPFILTERIMPL_H

#include "tao_ipfilter/driver/driverimpl.h"

typedef enum {
  IP_START_COLD,
  IP_START_PREDICT,
  IP_START_WARM
} IPStart;
typedef enum {
  IP_BARRIER_MONOTONE,
  IP_BARRIER_MEHROTRA
} IPBarrierRule;
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
  IP_SCALING_GRADIENT,
  IP_SCALING_NONE
} IPScaling;
typedef enum {
  IP_EQUALITY_AUTO,
  IP_EQUALITY_AUGMENTED,
  IP_EQUALITY_CONDENSED
} IPEqualityMethod;

typedef enum {
  IP_SUBSPACE_FALSE,
  IP_SUBSPACE_TRUE,
  IP_SUBSPACE_AUTO
} IPSubspaceUse;

/* What the user may choose; the names are those of the options in opts.c */
typedef struct {
  PetscReal     acceptable_tol;
  PetscInt      acceptable_it;
  IPStart       start;
  IPBarrierRule barrier;
  IPKKTMeasure  measure;
  IPForcing     forcing;
  IPScaling     scaling;
  PetscBool     monitor;
  PetscReal     delta_equality, kappa_progress;
  PetscReal     mu0, s0, z0, mu_start, mu_warm, forcing_start;
  PetscReal     kappa_epsilon, kappa_dual, kappa_mu, theta_mu, tau_min, kappa_sigma;
  PetscInt      max_mu_first, max_mu_later;
  PetscReal gamma_theta, gamma_phi, eta_phi, delta_switch, s_theta, s_phi, gamma_alpha, theta_min_fact, theta_max_fact,
    obj_max_inc;
  PetscInt         max_soc;
  PetscReal        kappa_soc;
  PetscReal        forcing_max, forcing_reduce, forcing_last;
  PetscReal        kappa_curvature, delta_first, delta_max, delta_grow_first, delta_grow, delta_shrink;
  PetscReal        filter_threshold, filter_switch, row_ratio, gradient_max;
  PetscReal        dual_inf_tol, constr_viol_tol, compl_inf_tol; /* negative: what the scaling has */
  PetscReal        bound_push, unbounded_factor;
  PetscReal        direct_memory;
  PetscBool        direct_always;
  IPSubspaceUse    subspace;
  PetscInt         subspace_max;
  IPEqualityMethod equality;
  PetscReal        proximal;
} IPOptions;

/* What the caller gave through TaoIPFilterSet...(): NULL where it did not */
typedef struct {
  Vec      slack_mass, primal_mass; /* M_s and M_u; NULL: 1 */
  Vec      warm_s, warm_z;          /* starting slacks and multipliers, */
  Vec      warm_y;                  /* multipliers of the equality constraints, */
  Vec      warm_lower, warm_upper;  /* and of the bounds */
  PetscInt solves_to_come;          /* with the same Hessian, the next one included; 0: not said */
} IPGiven;

/* What a TaoSolve() did */
typedef struct {
  PetscInt             nksp, max_nksp, *ksp_iterations; /* Krylov iterations of every linear solve */
  PetscInt             nsystems, nfiltered; /* condensed matrices, and those preconditioned with the filter */
  TaoIPFilterFallbacks fallbacks;
  PetscInt  nregularized, nretried; /* steps taken with a shifted Hessian, and systems solved to find the shift */
  PetscReal delta_largest;          /* largest shift a step was taken with */
  PetscInt  nrestored;              /* restorations */
  PetscInt  ntiny;                  /* steps in a row that are as small as rounding */
  PetscInt  nacceptable;            /* iterates in a row within the acceptable tolerance */
  PetscInt  nstraight;     /* whole steps in a row with a shift along which the objective fell as a straight line, */
  PetscReal last_f;        /* and the objective before the next one */
  PetscInt  napplications; /* of the preconditioner in the filtered subspace method, */
  PetscInt  nreduced, npivots; /* its reduced problems, and the active sets that they took */
  PetscInt  ndirections;       /* iterations that were a direction of it, no step of Newton's */
  PetscReal best_error;        /* KKT error of the best iterate, */
  PetscReal best_violation;    /* and its violation */
  char      reason[256];
} IPRecord;

typedef struct _n_TAO_IPFILTER {
  IPOptions     opt;
  PetscReal     tol; /* of this solve: tao->gatol */
  IPGiven       given;
  IPWork        work;
  PetscInt      mi, me; /* inequality and equality constraints, all ranks: rows with equal bounds are both */
  IPSides       sides;
  IS            fixed; /* variables of this rank with equal bounds; NULL if no rank has one */
  IPRowScale    rows;
  IPJacobian    jac;
  IPQuasiNewton qn;
  IPHessian     hess;
  IPPair        pair[IP_NPAIRS];
  IPIterate     at, best, trial; /* at.x is tao->solution; at.s and at.z are the pairs'; best: smallest KKT error */
  IPDirection   dir;
  Vec           rx, rc; /* grad f - J^T M lambda + J_E^T y - bound multipliers, and c_I - s */
  IPFirst       first;
  IPStiffness   stiff;
  IPTerms       terms;
  IPScale       scale;
  IPKKT         kkt;
  IPCondensed   cond;
  IPLinear      lin;
  IPDirect      direct;
  IPAugmented   aug;
  IPProximal    prox;
  IPShift       shift;
  PetscReal     mu;
  IPBarrier     bar;
  IPFilterSet   filter;
  IPSearch      search;
  IPRelaxation  relax;
  IPRestoration restore;
  IPFiltered    filtered;
  IPRecord      rec;
} TAO_IPFILTER;

#define IP_TINY_STEP (10.0 * PETSC_MACHINE_EPSILON) /* of x: rounding makes such steps */
#define IP_LEAST_SLACK \
  1e-14 /* of the size of the constraints: smaller ones only cost accuracy, and tell that there is no interior */
#define IP_CLOSE           1e-6 /* fraction of ||b|| from which on rounding may be what stops a Krylov method */
#define IP_MANY_ITERATIONS 500  /* of a Krylov method, when others of the same problem took few */

/* opts.c */
PETSC_INTERN const char *const IPStarts[], *const IPBarrierRules[], *const IPKKTMeasures[],
                                                                      *const IPForcings[], *const IPSubspaceUses[],
                                                                                             *const IPEqualityMethods[];
PETSC_INTERN PetscErrorCode IPOptionsInitialize(IPOptions *);
PETSC_INTERN PetscErrorCode TaoSetFromOptions_IPFilter(Tao, AMGFOptionItems);

/* view.c */
PETSC_INTERN PetscErrorCode TaoView_IPFilter(Tao, PetscViewer);

/* api.c */
PETSC_INTERN PetscErrorCode TaoIPFilterComposeFunctions(Tao, PetscBool);

#endif
