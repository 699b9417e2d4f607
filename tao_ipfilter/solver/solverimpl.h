/*
   What a TAOIPFILTER is made of: plain structs that all folders know, in the order of these, and the solver itself.
   What belongs to one folder alone has its struct there: the filtered subspace and the laws of friction.
*/
#ifndef IPFILTER_SOLVERIMPL_H
#define IPFILTER_SOLVERIMPL_H

#include <petsc/private/taoimpl.h>
#include <petsccompat.h>
#include <petscamgf.h>

#if defined(PETSC_USE_COMPLEX)
  #error "ipfilter needs a PETSc with real scalars: inequalities order numbers"
#endif

typedef struct _n_TAO_IPFILTER TAO_IPFILTER;

/* Layouts of scratch vectors: unknowns, inequality and equality constraints */
typedef enum {
  IP_UNKNOWNS,
  IP_INEQUALITIES,
  IP_EQUALITIES,
  IP_NSPACES
} IPSpace;

/* The limited-memory approximation B of the Hessian, where the caller gives none: quasinewton.c */
typedef struct {
  Mat              B;                    /* NULL: the caller's Hessian, or differences */
  Mat              A;                    /* the condensed matrix with all of B */
  PetscReal        sigma;                /* B is this multiple of the identity, and a matrix of low rank */
  PetscInt         npairs;               /* steps of this solve that B has learnt from */
  PetscBool        begun;                /* in this solve */
  Vec              x, gradient;          /* the last point, and the objective's gradient there, */
  Mat              inequality, equality; /* and the caller's Jacobians, */
  PetscObjectState inequality_state, equality_state;
  Vec              sum; /* of all damped changes of the gradient */
} IPQuasiNewton;

/* Scratch vectors; whoever takes one must return it */
#define IP_MAX_WORK 8
typedef struct {
  Vec       v[IP_NSPACES][IP_MAX_WORK]; /* made when first asked for */
  PetscBool lent[IP_NSPACES][IP_MAX_WORK];
} IPWork;

/* Blocks of complementarity pairs */
enum {
  IP_SLACK,
  IP_CEILING, /* upper sides of slacks with two */
  IP_LOWER,
  IP_UPPER,
  IP_NPAIRS
};

/* Pairs (t_i, z_i), t_i z_i -> mu. Where a bound is absent t is PETSC_INFINITY and z is zero. */
typedef struct {
  PetscInt  n;      /* pairs present, over all ranks; the vectors are NULL when there are none */
  PetscReal sign;   /* of t's change with x, or with c_I: -1 for upper bounds and sides, +1 for the others */
  PetscReal weight; /* sum of the weights of the pairs present */
  Vec       w;      /* weights m_i */
  Vec       t, z;   /* distance to the boundary and its multiplier */
  Vec       dt, dz; /* direction */
  Vec       target; /* right-hand side of the linearized t z = target: mu, or mu less the second-order term */
  Vec       trial;  /* t at a trial point */
} IPPair;

/* An iterate, or what of it is known of another point: the members that are not kept are NULL */
typedef struct {
  Vec       x, c, ce;     /* the point, c_I and c_E there */
  Vec       s, lambda, y; /* slacks, multipliers of c_I (a density: the force is M lambda) and of c_E */
  Vec       z[IP_NPAIRS]; /* multipliers of the pairs */
  PetscReal f;
} IPIterate;

/* A direction. Those of slacks, of the distances to bounds and of the pairs' multipliers stand in the pairs and
   follow from x. */
typedef struct {
  Vec       x, lambda, y;
  PetscReal norm; /* largest entry of x */
} IPDirection;

/* Where a matrix came from: two stamps alike have the same */
typedef struct {
  PetscObjectId    value_id; /* which matrix, */
  PetscObjectState value_state;
  PetscObjectId    pattern_id; /* and which pattern */
  PetscObjectState pattern_state;
} IPStamp;

/* The constraints' Jacobians as the iteration sees them: rows scaled, columns of fixed variables zeroed */
typedef struct {
  Mat     inequality, equality;             /* AIJ */
  IPStamp inequality_stamp, equality_stamp; /* of the caller's matrices, or of */
  Mat     converted[2];                     /* what they were converted to */
} IPJacobian;

/* What TaoSetInequalityBounds() makes of the rows of c_I: sides.c */
typedef struct {
  Vec       sign;         /* +1, -1: upper bound alone, 0: no inequality; NULL: all +1 */
  Vec       base;         /* the bound that c is measured from; NULL: IL, or 0 */
  Vec       range;        /* between two bounds, else PETSC_INFINITY; NULL: no row has two */
  Vec       width;        /* the same in the scale of the iteration */
  PetscReal constant;     /* value of c in rows that are no inequality; 0: not chosen yet */
  PetscInt  nequal, nall; /* rows with equal bounds, of this rank and of all */
  PetscInt *equal;        /* which, from this rank's first row */
} IPSides;

/* The Hessian as the iteration sees it */
typedef struct {
  Mat       H;
  Mat       converted; /* to AIJ from a type that is not worked with */
  PetscBool products;  /* it gives products alone, and so does the condensed matrix */
} IPHessian;

/* Scales of the rows of c_I and c_E; NULL: 1 */
typedef struct {
  Vec inequality, equality;
} IPRowScale;

/* No value of a function there: NaN, or infinite, be it C's infinity or PETSc's large number */
static inline PetscBool IPUndefined(PetscReal value)
{
  return (PetscBool)(PetscIsInfOrNanReal(value) || PetscAbsReal(value) >= PETSC_INFINITY);
}

/* Sizes at the starting point */
typedef struct {
  PetscReal f, gradient; /* objective and norm of its gradient */
  PetscReal unit;        /* of the objective, with scaling by gradients: 1, or what brings them down to the limit */
  PetscReal length, equality; /* of c_I, but for rows that are out of reach, and of c_E */
  PetscReal x;
  PetscReal reach;             /* how far unknowns may be expected to move: reach.c; 0: not known */
  PetscReal jacobian;          /* largest row sum of |J|, */
  PetscReal equality_jacobian; /* and of |J_E| */
  PetscReal energy;            /* of the terms that make up the objective */
  PetscReal pressure; /* multiplier of all rows alike that balances the gradient where this is large; 0: not known */
} IPFirst;

/* Stiffness of the objective at the start, from the diagonal of H */
typedef struct {
  Vec       rho;    /* pressure per length that resists each constraint */
  Vec       reach;  /* how far each constraint's value may be expected to change: reach.c; NULL: not known */
  PetscReal mean;   /* harmonic mean of rho, weighted */
  Vec       hdiag;  /* |diagonal of H|, now */
  PetscReal hscale; /* its mean at the start, */
  PetscBool flat;   /* stiffness where nothing resists a constraint */
} IPStiffness;

/* Terms sum_i b_i |T_i x + t_i| beside the objective, b_i = min(limit_i, coefficient_i times the force of inequality
   constraint i): terms.c */
typedef struct {
  PetscInt n;                  /* of all ranks; 0: none in this solve */
  Mat      given, T;           /* two rows a term; without the columns of fixed variables */
  IPStamp  stamp;              /* of T */
  Vec      t;                  /* two entries a term */
  Vec      limit, coefficient; /* one a term; NULL: no limit, or limits alone */
  Vec      force, best, last,
    warm;  /* tau at the present point, at the best one and at the last, two a term; what the first is to be: NULL: 0 */
  Vec rho; /* force per length that resists a term */
  Vec dead; /* of two entries a term: unit vector along which next to nothing gives way, and v counts as none; zeros:
               there is none */
} IPTerms;

/* Sizes by which residuals are divided; all 1 in the published measure */
typedef struct {
  PetscReal dual;           /* forces that cancel in the stationarity condition */
  PetscReal length;         /* values of c_I */
  PetscReal equality;       /* values of c_E */
  PetscReal equality_terms; /* terms that cancel in c_E, now */
  PetscReal pressure;       /* multipliers, */
  PetscReal balance; /* and those of one active constraint that balances the objective's gradient; 0: not known */
  PetscReal product; /* length x pressure: complementarity and mu */
  PetscReal energy;  /* the objective; PETSC_INFINITY in the measures that do not ask for it */
} IPScale;

/* Residuals of the optimality conditions at the current iterate */
typedef struct {
  PetscReal dual, primal, complementarity; /* divided by the scales, mu = 0 */
  PetscReal centrality;                    /* as complementarity, for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity): decides convergence, together with */
  PetscReal work;      /* what the residuals are worth in the objective, over a multiple of its size */
  PetscReal work_dual; /* the stationarity residual's share of it */
  PetscReal own;       /* largest violation over the terms of its own constraint; looked at near the end alone: own.c */
  PetscReal violation; /* of constraints, slacks apart, over their first size */
  PetscReal unscaled;  /* largest absolute entry of all residuals, mu = 0 */
  PetscReal dual_norm; /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du, inf_compl; /* largest absolute entries of the primal and the dual residual, and of t z */
} IPKKT;

/* The rows that are condensed: those of c_I, and below them on each rank those of c_E where these are condensed, too,
   or of norm terms */
typedef struct {
  Mat     J; /* NULL: none */
  Vec     D; /* their weights */
  IPStamp stamp;
  IPStamp source[2];         /* of the matrices that one of both was made from */
  Vec     inequality, below; /* weights of either kind */
} IPRows;

/* The condensed matrix A = H + Sigma + J^T D J + delta M_u and what its assembly reuses */
typedef struct {
  IPRows           rows;
  Mat              A;
  Mat              DJ, JtDJ;           /* D J, J^T D J */
  Vec              shift;              /* Sigma + delta M_u, the diagonal added to H */
  Vec              hdiag;              /* diagonal of H, kept while a shift is added to it */
  PetscBool        shifted;            /* A's diagonal holds a shift */
  PetscObjectId    H_id;               /* which H A was assembled from, */
  PetscObjectState H_state, H_nonzero; /* with which values and pattern */
  PetscObjectId    J_id;               /* which Jacobian the product's pattern came from, */
  PetscObjectState J_nonzero;          /* with which pattern */
  PetscObjectId    filter_id;          /* which Jacobian the filter came from, */
  PetscObjectState filter_state;       /* with which values */
  PetscInt         ntouched;           /* rows of this rank touched by J^T D J */
  PetscInt        *touched;
  IS               filter; /* composed on A under PCAMGF_FILTER_KEY */
} IPCondensed;

/* What came of a linear solve */
typedef enum {
  IP_LINEAR_SOLVED,
  IP_LINEAR_INDEFINITE, /* the matrix is not positive definite */
  IP_LINEAR_FAILED      /* the solver has failed, which says nothing about the matrix */
} IPLinearVerdict;

/* The present linear system and its last solve */
typedef struct {
  KSP                flexible;       /* for corrections; NULL until one is needed */
  Vec                residual;       /* b - A d */
  PetscReal          target, rhs;    /* ||b - A d|| asked for, and ||b|| */
  PetscReal          norm;           /* ||b - A d||, */
  PetscReal          backward_error; /* and over the terms it is the difference of */
  PetscInt           its, limit;     /* Krylov iterations, and their limit */
  PetscInt           longest;        /* largest number of them in a solve that gave a direction */
  KSPConvergedReason reason;
  PetscBool          failed;        /* no solver gave a direction, for reasons other than the matrix's inertia */
  char               why[128];      /* why the last remedy did not help */
  PetscInt           ndirect;       /* solves in a row that only MUMPS could do */
  PetscBool          filtered;      /* preconditioned with the filter */
  PetscBool          filter_forced; /* the filter stays on */
} IPLinear;

/* The condensed matrix factored by MUMPS, where the Krylov method fails */
typedef struct {
  Mat              A, F;          /* the matrix as MUMPS takes it, and its factors */
  PetscBool        converted;     /* A is a copy */
  PetscObjectId    pattern_id;    /* which matrix it analysed, */
  PetscObjectState pattern_state; /* with which pattern, */
  PetscReal        memory;        /* and what the factors take by that, in 1e6 bytes over all ranks */
  PetscInt         system;        /* which condensed matrix was factored, by rec.nsystems */
  PetscInt
    relaxation; /* per cent of work space beyond MUMPS's estimate: what the last factorization came to; 0: none yet */
  PetscInt negative; /* its negative pivots */
} IPDirect;

/* The symmetric system [A J_E^T; J_E -delta] that equality constraints lead to, and its factorization */
typedef struct {
  KSP       ksp;
  Mat       K;
  Mat       shift;      /* -delta I */
  PetscReal delta;      /* of restoration steps, or regularization of dependent constraints: */
  PetscBool centered;   /* about the present multipliers, instead of zero */
  PetscInt  relaxation; /* per cent of work space beyond MUMPS's estimate, and */
  PetscReal pivot;      /* relative threshold of its pivots: what the last factorization came to; 0: none yet */
  Vec       rhs, sol, residual, correction;
} IPAugmented;

/* Equality constraints whose rows touch few unknowns: condensed with the others, their multipliers found by proximal
   updates */
typedef struct {
  PetscBool condensed; /* in this solve, until they turn out not to be fit for it */
  PetscInt  nupdates;  /* of the multipliers beyond the first of each solve */
} IPProximal;

/* The multiple delta of M_u that is added to the Hessian */
typedef struct {
  PetscReal delta, last; /* now, and of the last step that had one */
} IPShift;

/* How mu is chosen */
typedef struct {
  PetscBool free;          /* mehrotra: mu follows the affine step; otherwise Fiacco-McCormick */
  PetscReal corrector_max; /* mehrotra: bound of the second-order term */
  PetscReal first;         /* mean product at the start */
  PetscReal errors[4];     /* KKT errors that the free mode must improve on */
  PetscInt  nerrors;
  PetscBool curved; /* a step has shown constraints that are not linear, or an objective that is not convex */
  PetscInt  hold;   /* mehrotra: iterations left in the monotone mode that a failed line search called for */
} IPBarrier;

/* Pairs (theta, phi) that no later iterate may be dominated by */
typedef struct {
  PetscInt   n, max;
  PetscReal *theta, *phi;
} IPFilterSet;

/* The line search: measures of the present iterate, their units, and the last step */
typedef struct {
  PetscReal theta, phi;
  PetscReal theta0;             /* at the first iterate; negative: none yet */
  PetscReal theta_ref, phi_ref; /* units */
  PetscReal equality_weight;    /* brings c_E to the units of theta */
  PetscReal rounding;           /* changes of phi below this mean nothing, */
  PetscReal theta_rounding;     /* and values of theta */
  PetscReal alpha, alpha_dual;
  PetscReal before; /* norm of the direction before the last one */
  PetscInt  ntrials;
  PetscBool blocked;              /* whether it was the filter alone that refused the last trial point refused */
  PetscInt  nblocked, nunblocked; /* steps in a row that were shortened so; how often the filter was cleared for that */
  char      tag;                  /* how the step was accepted: f, h, F, H (second-order correction), R (restoration) */
} IPSearch;

/* Relaxation of constraints without an interior */
typedef struct {
  PetscReal by;          /* what c_I is raised by, */
  PetscReal size;        /* the size of the constraints that it is a fraction of, */
  PetscReal unknowns;    /* what bounds are moved by, */
  PetscReal told;        /* the larger of both in the caller's units, */
  PetscInt  times;       /* and how often that was */
  PetscReal least_slack; /* that the last step left, */
  PetscReal least_bound; /* and the least distance from a bound */
  PetscInt  nvanished;   /* iterates in a row that have a slack of next to nothing */
} IPRelaxation;

/* Feasibility restoration */
typedef struct {
  PetscReal zeta; /* weight of the distance from the last point against the violation */
  Vec       D;    /* m/zeta in the violated rows */
} IPRestoration;

/*
   Another method than steps of the interior point method, for the problems that it applies to: what it can do, and its
   data. The driver knows no more of it; register.c names the one that there is.
*/
typedef struct {
  const char *name;
  PetscErrorCode (*create)(Tao);
  PetscErrorCode (*compose)(Tao, PetscBool attach);     /* public functions of its own */
  PetscErrorCode (*applies)(Tao, PetscBool *);          /* to the problem at the first point */
  PetscErrorCode (*begin)(Tao, PetscBool *begun);       /* moves to its first point */
  PetscErrorCode (*step)(Tao, PetscBool *done);         /* not done: it leads no further */
  PetscErrorCode (*end)(Tao);                           /* of a solve; what serves later ones is kept */
  PetscErrorCode (*forget)(Tao);                        /* that, too */
  PetscErrorCode (*monitor)(Tao, PetscBool *monitored); /* prints an iteration in columns of its own */
  PetscErrorCode (*destroy)(Tao);
} IPMethodOps;

typedef struct {
  const IPMethodOps *ops; /* NULL: there is none */
  void              *data;
  PetscBool          on;
  PetscBool          linear;      /* the routine of the Jacobian has left its matrix alone: linear constraints, */
  PetscBool          constant;    /* and that of the Hessian too: a quadratic program */
  PetscBool          multipliers; /* those of the present point are its own */
} IPMethod;

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

/* Parameters that the user may set; the names are those of the options in opts.c */
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

/* What the caller set by TaoIPFilterSet...(); NULL: not set */
typedef struct {
  Vec      slack_mass, primal_mass; /* M_s and M_u; NULL: 1 */
  Vec      warm_s, warm_z;          /* starting slacks and multipliers, */
  Vec      warm_y;                  /* multipliers of the equality constraints, */
  Vec      warm_lower, warm_upper;  /* and of the bounds */
  PetscInt solves_to_come;          /* number of solves with the same Hessian, the next one included; 0: unknown */
} IPGiven;

/* What a TaoSolve() did */
typedef struct {
  PetscInt             nksp, max_nksp, *ksp_iterations; /* Krylov iterations of every linear solve */
  PetscInt             nsystems, nfiltered; /* condensed matrices, and those preconditioned with the filter */
  TaoIPFilterFallbacks fallbacks;
  PetscInt  nregularized, nretried; /* steps taken with a shifted Hessian, and systems solved to find the shift */
  PetscReal delta_largest;          /* largest shift a step was taken with */
  PetscInt  nrestored;              /* restorations */
  PetscInt  nsaddles;               /* stationary points that were no minima */
  PetscInt  ntiny;                  /* steps in a row that are as small as rounding */
  PetscInt  nacceptable;            /* iterates in a row within the acceptable tolerance */
  PetscInt  nstraight;              /* successive full steps with a shift along which the objective fell linearly, */
  PetscReal last_f;                 /* and the objective before the next one */
  PetscInt  napplications;          /* applications of the preconditioner in the filtered subspace method, */
  PetscInt  nreduced, npivots;      /* its reduced problems, and the active sets that they took */
  PetscInt  ndirections;            /* iterations that were a direction of the subspace method, not a Newton step */
  PetscReal best_error;             /* KKT error of the best iterate, */
  PetscReal best_violation;         /* and its violation */
  char      reason[256];
} IPRecord;

/* The solver */
struct _n_TAO_IPFILTER {
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
  IPMethod      method;
  const struct _n_IPLawsOps *laws; /* of norm terms; NULL: there are none */
  IPRecord                   rec;
};

#define IP_TINY_STEP (10.0 * PETSC_MACHINE_EPSILON) /* of x: rounding makes such steps */
#define IP_LEAST_SLACK \
  1e-14 /* fraction of the constraints' size: smaller slacks only cost accuracy, and indicate that there is no interior
           */
#define IP_CLOSE 1e-6 /* fraction of ||b|| below which rounding may stop a Krylov method */
#define IP_MANY_ITERATIONS \
  500 /* iterations of a Krylov method above which it counts as failed, if others of the same
                                   problem took few */

#endif
