/*
   Data of a TAOIPFILTER: plain structs that all folders know, and the solver itself. Structs that belong to one folder
   only (filtered subspace, friction) are declared there.
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

/* Layouts of work vectors: unknowns, inequality and equality constraints */
typedef enum { IP_UNKNOWNS, IP_INEQUALITIES, IP_EQUALITIES, IP_NSPACES } IPSpace;

/* quasinewton.c: the limited-memory approximation B of the Hessian */
typedef struct {
  Mat              B;                    /* NULL: the Hessian is the caller's or differenced */
  Mat              A;                    /* shell of the condensed matrix with all of B */
  PetscReal        sigma;                /* B = sigma I + a matrix of low rank */
  PetscInt         npairs;               /* number of steps of this solve in B */
  PetscBool        begun;                /* whether B was initialized in this solve */
  Vec              x, gradient;          /* last point, and the objective's gradient there */
  Mat              inequality, equality; /* copies of the caller's Jacobians at the last point */
  PetscObjectState inequality_state, equality_state;
  Vec              sum; /* sum of all damped gradient changes */
} IPQuasiNewton;

/* Work vectors; a function that takes one must return it */
#define IP_MAX_WORK 8
typedef struct {
  Vec       v[IP_NSPACES][IP_MAX_WORK]; /* created on demand */
  PetscBool lent[IP_NSPACES][IP_MAX_WORK];
} IPWork;

/* Blocks of complementarity pairs */
enum {
  IP_SLACK,
  IP_CEILING, /* upper sides of slacks with two sides */
  IP_LOWER,
  IP_UPPER,
  IP_NPAIRS
};

/* Pairs (t_i, z_i), t_i z_i -> mu. Where a bound is absent t is PETSC_INFINITY and z is zero. */
typedef struct {
  PetscInt  n;      /* number of pairs on all ranks; 0: the vectors are NULL */
  PetscReal sign;   /* dt/dx or dt/dc_I: -1 for upper bounds and upper sides, +1 for others */
  PetscReal weight; /* sum of the weights of all pairs */
  Vec       w;      /* weights m_i */
  Vec       t, z;   /* distance to the bound, and its multiplier */
  Vec       dt, dz; /* direction */
  Vec       target; /* right-hand side of the linearized t z = target: mu, or mu minus the second-order term */
  Vec       trial;  /* t at a trial point */
} IPPair;

/* An iterate; members that are not kept are NULL */
typedef struct {
  Vec       x, c, ce;     /* the point, c_I and c_E there */
  Vec       s, lambda, y; /* slacks, multipliers of c_I (a density: the force is M lambda) and of c_E */
  Vec       z[IP_NPAIRS]; /* multipliers z of the pairs */
  PetscReal f;
} IPIterate;

/* A direction. Directions of slacks, of distances to bounds and of the pairs' multipliers are stored in the pairs;
   they follow from x. */
typedef struct {
  Vec       x, lambda, y;
  PetscReal norm; /* largest entry of x */
} IPDirection;

/* Identifies a matrix and its state; equal stamps mean an unchanged matrix */
typedef struct {
  PetscObjectId    value_id; /* which matrix, */
  PetscObjectState value_state;
  PetscObjectId    pattern_id; /* object and state of its nonzero pattern */
  PetscObjectState pattern_state;
} IPStamp;

/* jacobian.c: the constraints' Jacobians used by the iteration: rows scaled, columns of fixed variables zeroed */
typedef struct {
  Mat     inequality, equality;             /* AIJ */
  IPStamp inequality_stamp, equality_stamp; /* stamps of the caller's matrices */
  Mat     converted[2];                     /* conversions to AIJ */
} IPJacobian;

/* sides.c: rows of c_I classified by TaoSetInequalityBounds() */
typedef struct {
  Vec       sign;         /* +1; -1: upper bound only; 0: no inequality; NULL: all +1 */
  Vec       base;         /* the bound that c is measured from; NULL: the lower bound, or 0 */
  Vec       range;        /* upper minus lower bound, or PETSC_INFINITY; NULL: no row has two bounds */
  Vec       width;        /* range, scaled and relaxed */
  PetscReal constant;     /* value of c in rows that are no inequality; 0: not set yet */
  PetscInt  nequal, nall; /* rows with equal bounds, on this rank and on all */
  PetscInt *equal;        /* these rows, numbered from this rank's first */
} IPSides;

/* The Hessian used by the iteration */
typedef struct {
  Mat       H;
  Mat       converted; /* conversion to AIJ, for types that cannot be used directly */
  PetscBool products;  /* only products are available, also of the condensed matrix */
} IPHessian;

/* Row scales of c_I and c_E; NULL: 1 */
typedef struct {
  Vec inequality, equality;
} IPRowScale;

/* Whether a function value is NaN or infinite, or PETSc's large number */
static inline PetscBool IPUndefined(PetscReal value)
{
  return (PetscBool)(PetscIsInfOrNanReal(value) || PetscAbsReal(value) >= PETSC_INFINITY);
}

/* Sizes at the starting point */
typedef struct {
  PetscReal f, gradient;      /* objective, and norm of its gradient */
  PetscReal unit;             /* scale of the objective with scaling by gradients; else 1 */
  PetscReal length, equality; /* sizes of c_I (without rows out of reach) and of c_E */
  PetscReal x;
  PetscReal reach;             /* expected change of the unknowns (reach.c); 0: unknown */
  PetscReal jacobian;          /* largest row sum of |J|, */
  PetscReal equality_jacobian; /* and of |J_E| */
  PetscReal energy;            /* magnitude of the objective's terms */
  PetscReal pressure;          /* equal multiplier of all rows that balances the gradient; 0: unknown */
} IPFirst;

/* Stiffness of the objective at the start, from the diagonal of H */
typedef struct {
  Vec       rho;    /* rho: pressure that changes each constraint by a unit length */
  Vec       reach;  /* expected change of each constraint (reach.c); NULL: unknown */
  PetscReal mean;   /* weighted harmonic mean of rho */
  Vec       hdiag;  /* |diagonal of H|, up to date */
  PetscReal hscale; /* mean of hdiag at the start */
  PetscBool flat;   /* no constraint is resisted by any stiffness */
} IPStiffness;

/* terms.c: norm terms sum_i b_i |T_i x + t_i|, b_i = min(limit_i, coefficient_i x force of inequality constraint i) */
typedef struct {
  PetscInt n;                  /* number of terms on all ranks; 0: none in this solve */
  Mat      given, T;           /* two rows per term; T: without the columns of fixed variables */
  IPStamp  stamp;              /* of T */
  Vec      t;                  /* two entries per term */
  Vec      limit, coefficient; /* one per term; limit NULL: no limits; coefficient NULL: limits only */
  Vec      force, best, last,
    warm;   /* tau at the present point, the best one, the last one; warm: initial tau, NULL: 0. Two entries per term */
  Vec rho;  /* stiffness that resists each term (resistance.c) */
  Vec dead; /* two entries per term: unit vector along which the term cannot move, so that v counts as zero; zeros:
               none */
} IPTerms;

/* Scales of residuals; all 1 in the published measure */
typedef struct {
  PetscReal dual;           /* forces that cancel in the stationarity condition */
  PetscReal length;         /* size of c_I */
  PetscReal equality;       /* size of c_E */
  PetscReal equality_terms; /* terms that cancel in c_E at the present point */
  PetscReal pressure;       /* multipliers, */
  PetscReal balance;        /* terms of an active constraint that balances the objective's gradient; 0: unknown */
  PetscReal product;        /* length x pressure: scale of complementarity and mu */
  PetscReal energy;         /* size of the objective; PETSC_INFINITY if not used by the measure */
} IPScale;

/* Residuals of the optimality conditions at the current iterate */
typedef struct {
  PetscReal dual, primal, complementarity; /* relative to the scales, for mu = 0 */
  PetscReal centrality;                    /* complementarity error for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity): decides convergence together with
                                              work */
  PetscReal work;                          /* error bound in the objective, relative to its allowed size */
  PetscReal work_dual;                     /* part of the stationarity residual in work */
  PetscReal own;       /* largest violation relative to the constraint's own terms (own.c); computed near convergence
                          only */
  PetscReal violation; /* violation of the constraints without slacks, relative to their first size */
  PetscReal unscaled;  /* largest absolute entry of all residuals, for mu = 0 */
  PetscReal dual_norm; /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du, inf_compl; /* largest absolute entries of primal residual, dual residual, and t z */
} IPKKT;

/* rows.c: rows that are condensed: those of c_I, and on each rank below them those of condensed equality constraints
   or of norm terms */
typedef struct {
  Mat     J; /* NULL: none */
  Vec     D; /* their weights */
  IPStamp stamp;
  IPStamp source[2];         /* stamps of the matrices that J was made from */
  Vec     inequality, below; /* weights of the upper and lower rows */
} IPRows;

/* condense.c: the condensed matrix A = H + Sigma + J^T D J + delta M_u, and data to reuse its assembly */
typedef struct {
  IPRows           rows;
  Mat              A;
  Mat              DJ, JtDJ;           /* D J, J^T D J */
  Vec              shift;              /* the diagonal Sigma + delta M_u that is added to H */
  Vec              hdiag;              /* diagonal of H, while a shift is added to it */
  PetscBool        shifted;            /* A's diagonal contains a shift */
  PetscObjectId    H_id;               /* the H from which A was assembled, */
  PetscObjectState H_state, H_nonzero; /* with which values and pattern */
  PetscObjectId    J_id;               /* the Jacobian of the product's pattern, */
  PetscObjectState J_nonzero;          /* with which pattern */
  PetscObjectId    filter_id;          /* the Jacobian of the filter, */
  PetscObjectState filter_state;       /* with which values */
  PetscInt         ntouched;           /* local rows with entries of J^T D J */
  PetscInt        *touched;
  IS               filter; /* composed on A under PCAMGF_FILTER_KEY */
} IPCondensed;

/* Verdict on a linear solve */
typedef enum {
  IP_LINEAR_SOLVED,
  IP_LINEAR_INDEFINITE, /* the matrix is not positive definite */
  IP_LINEAR_FAILED      /* the solver failed; says nothing about the matrix */
} IPLinearVerdict;

/* The current linear system and its last solve */
typedef struct {
  KSP                flexible;       /* flexible CG for corrections; NULL until needed */
  Vec                residual;       /* b - A d */
  PetscReal          target, rhs;    /* requested ||b - A d||; ||b|| */
  PetscReal          norm;           /* ||b - A d||, */
  PetscReal          backward_error; /* and relative to the norm of its terms */
  PetscInt           its, limit;     /* Krylov iterations, and their limit */
  PetscInt           longest;        /* largest number of iterations in a successful solve */
  KSPConvergedReason reason;
  PetscBool          failed;        /* no solver gave a direction, for other reasons than the matrix's inertia */
  char               why[128];      /* why the last remedy failed */
  PetscInt           ndirect;       /* consecutive solves in which only MUMPS succeeded */
  PetscBool          filtered;      /* the filter was used */
  PetscBool          filter_forced; /* the filter stays on */
} IPLinear;

/* direct.c: the condensed matrix factored by MUMPS */
typedef struct {
  Mat              A, F;          /* the matrix in MUMPS's format, and its factors */
  PetscBool        converted;     /* A is a converted copy */
  PetscObjectId    pattern_id;    /* the matrix that was analysed, */
  PetscObjectState pattern_state; /* and state of its pattern */
  PetscReal        memory;        /* predicted memory of the factors, all ranks [1e6 bytes] */
  PetscInt         system;        /* the factored matrix, by its number rec.nsystems */
  PetscInt
    relaxation; /* work space beyond MUMPS's estimate in the last successful factorization [per cent]; 0: none yet */
  PetscInt negative; /* number of negative pivots */
} IPDirect;

/* augmented.c: the symmetric system [A J_E^T; J_E -delta] for equality constraints, and its factorization */
typedef struct {
  KSP       ksp;
  Mat       K;
  Mat       shift;      /* -delta I */
  PetscReal delta;      /* of a restoration step, or regularization of dependent constraints: */
  PetscBool centered;   /* the regularization acts on the change of the multipliers, not on the multipliers */
  PetscInt  relaxation; /* work space beyond MUMPS's estimate [per cent], and */
  PetscReal pivot;      /* relative pivot threshold, in the last successful factorization; 0: none yet */
  Vec       rhs, sol, residual, correction;
} IPAugmented;

/* proximal.c: equality constraints that involve few unknowns: condensed, with proximal updates of their multipliers */
typedef struct {
  PetscBool condensed; /* in this solve, unless it turns out not to work */
  PetscInt  nupdates;  /* updates of the multipliers beyond the first in each solve */
} IPProximal;

/* The multiple delta of M_u added to the Hessian */
typedef struct {
  PetscReal delta, last; /* delta: present; last: of the last step that needed one */
} IPShift;

/* Choice of mu */
typedef struct {
  PetscBool free;          /* mehrotra: mu from the affine step; otherwise Fiacco and McCormick's rule */
  PetscReal corrector_max; /* mehrotra: limit of the second-order term */
  PetscReal first;         /* mean product t z at the start */
  PetscReal errors[4];     /* recent KKT errors, which the free mode must improve on */
  PetscInt  nerrors;
  PetscBool curved; /* a step has shown nonlinear constraints or an objective that is not convex */
  PetscInt  hold;   /* mehrotra: iterations left in the monotone mode after a failed line search */
} IPBarrier;

/* The filter: pairs (theta, phi) that later iterates must improve on */
typedef struct {
  PetscInt   n, max;
  PetscReal *theta, *phi;
} IPFilterSet;

/* Line search: measures of the present iterate, their units, and the last step */
typedef struct {
  PetscReal theta, phi;
  PetscReal theta0;             /* theta at the first iterate; negative: none yet */
  PetscReal theta_ref, phi_ref; /* units */
  PetscReal equality_weight;    /* converts c_E to the units of theta */
  PetscReal rounding;           /* rounding error of phi, */
  PetscReal theta_rounding;     /* and of theta */
  PetscReal alpha, alpha_dual;
  PetscReal before; /* norm of the direction before the last one */
  PetscInt  ntrials;
  PetscBool blocked;              /* the last rejected trial point was rejected by the filter alone */
  PetscInt  nblocked, nunblocked; /* consecutive steps shortened by the filter; number of times it was cleared for
                                     that */
  char      tag;                  /* how the step was accepted: f, h, F, H (second-order correction), R (restoration) */
} IPSearch;

/* relax.c: relaxation of constraints without an interior */
typedef struct {
  PetscReal by;          /* amount added to c_I */
  PetscReal size;        /* size of the constraints; `by` is a fraction of it */
  PetscReal unknowns;    /* amount by which bounds are moved */
  PetscReal told;        /* larger one of `by` and `unknowns`, in the caller's units */
  PetscInt  times;       /* number of relaxations */
  PetscReal least_slack; /* smallest slack after the last step */
  PetscReal least_bound; /* smallest distance from a bound after the last step */
  PetscInt  nvanished;   /* consecutive iterates with a vanishing slack */
} IPRelaxation;

/* Feasibility restoration */
typedef struct {
  PetscReal zeta; /* restore.c: weight of the distance from the last point relative to the violation */
  Vec       D;    /* m/zeta in the violated rows */
} IPRestoration;

/*
   Interface of an alternative to the interior point method, for problems that it applies to, and its data. The driver
   knows nothing else about it; register.c names the implementation.
*/
typedef struct {
  const char *name;
  PetscErrorCode (*create)(Tao);
  PetscErrorCode (*compose)(Tao, PetscBool attach);     /* composes its public functions with the Tao */
  PetscErrorCode (*applies)(Tao, PetscBool *);          /* whether it applies to the problem at the first point */
  PetscErrorCode (*begin)(Tao, PetscBool *begun);       /* moves to its first point */
  PetscErrorCode (*step)(Tao, PetscBool *done);         /* done: false if it makes no more progress */
  PetscErrorCode (*end)(Tao);                           /* ends a solve; data for later solves are kept */
  PetscErrorCode (*forget)(Tao);                        /* that, too */
  PetscErrorCode (*monitor)(Tao, PetscBool *monitored); /* prints an iteration in its own columns */
  PetscErrorCode (*destroy)(Tao);
} IPMethodOps;

typedef struct {
  const IPMethodOps *ops; /* NULL: no alternative method */
  void              *data;
  PetscBool          on;
  PetscBool          linear;      /* the caller's Jacobian routine left its matrix unchanged: constraints are linear, */
  PetscBool          constant;    /* and so did the Hessian routine: a quadratic program */
  PetscBool          multipliers; /* the present multipliers were computed by the method */
} IPMethod;

typedef enum { IP_START_COLD, IP_START_PREDICT, IP_START_WARM } IPStart;
typedef enum { IP_BARRIER_MONOTONE, IP_BARRIER_MEHROTRA } IPBarrierRule;
typedef enum { IP_KKT_RELATIVE, IP_KKT_MASS } IPKKTMeasure;
typedef enum { IP_FORCING_ADAPTIVE, IP_FORCING_FIXED } IPForcing;
typedef enum { IP_SCALING_PROBLEM, IP_SCALING_GRADIENT, IP_SCALING_NONE } IPScaling;
typedef enum { IP_EQUALITY_AUTO, IP_EQUALITY_AUGMENTED, IP_EQUALITY_CONDENSED } IPEqualityMethod;

typedef enum { IP_SUBSPACE_FALSE, IP_SUBSPACE_TRUE, IP_SUBSPACE_AUTO } IPSubspaceUse;

/* Constants. Names follow Waechter and Biegler (2006); most values are IPOPT's */
#define IP_ACCEPTABLE_TOL   1e-6  /* KKT error that is acceptable if no further progress is made, */
#define IP_ACCEPTABLE_IT    15    /* after this many consecutive acceptable iterates */
#define IP_UNBOUNDED_FACTOR 1e10  /* decrease of the objective relative to its first size that counts as unbounded */
#define IP_ROW_RATIO        100.0 /* row scaling: largest gradient at the start, relative to the smallest */
#define IP_GRADIENT_MAX     100.0 /* scaling by gradients: largest entry of all gradients at the start */
#define IP_BOUND_PUSH       1e-2  /* distance of the start from its bounds, relative to their size or distance */
#define IP_PREDICT_MU       0.3   /* predicted start: mu relative to mean length x mean pressure */
#define IP_PREDICT_FORCING  0.1   /* residual of its linear solve, relative to the forces that the rows transmit */
#define IP_WARM_MU          3e-2  /* warm start: smallest mu relative to mean length x mean pressure */
#define IP_KAPPA_EPSILON    10.0  /* monotone: mu falls when the barrier error is below this multiple of mu, */
#define IP_KAPPA_DUAL       0.1   /* and (relative measure) the stationarity error below this; */
#define IP_KAPPA_MU         0.2   /* mu is multiplied by this factor, */
#define IP_THETA_MU         1.5   /* or raised to this power, */
#define IP_MU_REDUCTIONS    1     /* at most this often per iteration after the first */
#define IP_KAPPA_PROGRESS \
  0.9999                          /* Mehrotra: the KKT error must fall below this fraction of the worst of four,
                                      else mu becomes monotone */
#define IP_TAU_MIN          0.99  /* smallest fraction of the step to the boundary */
#define IP_KAPPA_SIGMA      1e10  /* multipliers are kept within this factor of mu / s */
#define IP_GAMMA_THETA      1e-5  /* filter: sufficient reduction of the violation theta */
#define IP_DELTA_SWITCH     1.0   /* switching condition: constant, */
#define IP_S_THETA          1.1   /* exponent of the violation, */
#define IP_S_PHI            2.3   /* exponent of the slope */
#define IP_GAMMA_ALPHA      0.05  /* safety factor for the smallest step */
#define IP_THETA_MIN_FACT   1e-4  /* Armijo's condition is used below this violation, relative to the first */
#define IP_THETA_MAX_FACT   1e4   /* largest accepted violation, relative to the first */
#define IP_OBJ_MAX_INC      1e5   /* largest rise of the barrier function for less violation, relative to its size */
#define IP_KAPPA_SOC        0.99  /* a correction must reduce the violation by this factor to be continued */
#define IP_KAPPA_CURVATURE  1e-11 /* curvature d^T W d required of a direction, relative to d^T d */
#define IP_DELTA_FIRST      1e-4  /* first delta (multiple of M_u), in its unit, */
#define IP_DELTA_GROW_FIRST 100.0 /* its growth until one has worked, */
#define IP_DELTA_GROW       8.0   /* its growth later, */
#define IP_DELTA_SHRINK     (1.0 / 3.0) /* and its decrease from step to step */
#define IP_DELTA_EQUALITY   1e-8 /* regularization of dependent equality constraints, in units of J_E H^-1 J_E^T */
#define IP_FORCING_MAX \
  0.1                         /* adaptive forcing: linear residual while mu falls, relative to the forces in
                                     balance, */
#define IP_FORCING_REDUCE 0.7 /* relative to the last stationarity residual, */
#define IP_FORCING_LAST   0.5 /* and relative to the tolerance in the step that would finish */
#define IP_FILTER_THRESHOLD \
  1e-12 /* columns of J belong to the filter if they have an entry above this fraction of
                                     the largest */

/* Parameters that the user may set; opts.c has the options of the same names */
typedef struct {
  IPStart          start;
  IPBarrierRule    barrier;
  IPKKTMeasure     measure;
  IPForcing        forcing;
  IPScaling        scaling;
  PetscBool        monitor;
  PetscReal        mu0, s0, z0;
  PetscInt         max_mu_first, max_soc;
  PetscReal        gamma_phi, eta_phi, delta_max, filter_switch;
  PetscReal        dual_inf_tol, constr_viol_tol, compl_inf_tol; /* negative: default of the chosen scaling */
  PetscReal        direct_memory;
  PetscBool        direct_always;
  IPSubspaceUse    subspace;
  PetscInt         subspace_max;
  IPEqualityMethod equality;
  PetscReal        proximal;
} IPOptions;

/* Set by the caller through TaoIPFilterSet...(); NULL: not set */
typedef struct {
  Vec      slack_mass, primal_mass; /* M_s and M_u; NULL: 1 */
  Vec      warm_s, warm_z;          /* initial slacks and multipliers, */
  Vec      warm_y;                  /* initial multipliers of the equality constraints, */
  Vec      warm_lower, warm_upper;  /* initial multipliers of the bounds */
  PetscInt solves_to_come;          /* number of solves with the same Hessian, including the next; 0: unknown */
} IPGiven;

/* Record of a TaoSolve() */
typedef struct {
  PetscInt             nksp, max_nksp, *ksp_iterations; /* Krylov iterations of every linear solve */
  PetscInt             nsystems, nfiltered; /* condensed matrices, and those preconditioned with the filter */
  TaoIPFilterFallbacks fallbacks;
  PetscInt             nregularized, nretried; /* steps with a shifted Hessian; systems solved to find the shifts */
  PetscReal            delta_largest;          /* largest shift in a step taken */
  PetscInt             nrestored;              /* restorations */
  PetscInt             nsaddles;               /* stationary points that were not minima */
  PetscInt             ntiny;                  /* consecutive steps as small as rounding */
  PetscInt             nacceptable;            /* consecutive acceptable iterates */
  PetscInt             nstraight;     /* consecutive full steps with a shift along which the objective fell linearly, */
  PetscReal            last_f;        /* objective before the next of these */
  PetscInt             napplications; /* filtered subspace method: applications of the preconditioner, */
  PetscInt             nreduced, npivots; /* reduced problems, and active sets tried in them */
  PetscInt             ndirections;       /* iterations that added a direction, not Newton steps */
  PetscReal            best_error;        /* KKT error of the best iterate, */
  PetscReal            best_violation;    /* and its violation */
  char                 reason[256];
} IPRecord;

/* The solver */
struct _n_TAO_IPFILTER {
  IPOptions     opt;
  PetscReal     tol; /* tolerance of this solve: tao->gatol */
  IPGiven       given;
  IPWork        work;
  PetscInt      mi, me; /* inequality and equality constraints on all ranks; rows with equal bounds count as both */
  IPSides       sides;
  IS            fixed; /* this rank's variables with equal bounds; NULL if no rank has any */
  IPRowScale    rows;
  IPJacobian    jac;
  IPQuasiNewton qn;
  IPHessian     hess;
  IPPair        pair[IP_NPAIRS];
  IPIterate     at, best, trial; /* at.x is tao->solution, at.s and at.z belong to the pairs; best: smallest KKT
                                    error */
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
  const struct _n_IPLawsOps *laws; /* laws of norm terms; NULL: not registered */
  IPRecord                   rec;
};

#define IP_TINY_STEP (10.0 * PETSC_MACHINE_EPSILON) /* relative to x: smaller steps are rounding */
#define IP_LEAST_SLACK \
  1e-14 /* relative to the constraints' size: smaller slacks lose accuracy and indicate that there is no interior */
#define IP_CLOSE 1e-6 /* relative to ||b||: below this residual rounding may stop a Krylov method */
#define IP_MANY_ITERATIONS \
  500 /* iterations of a Krylov method that count as failure if other systems of the problem took few */

#endif
