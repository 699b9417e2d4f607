/*
   TAOIPFILTER: primal-dual interior point with a filter line search.

   The problem is min f(x) subject to c_E(x) = 0, c_I(x) >= 0, x_l <= x <= x_u. With slacks s for c_I and lumped weights
   M = diag(m_i) the Lagrangian is

     L = f(x) + y^T c_E(x) - lambda^T M (c_I(x) - s) - z^T M s - bound terms,

   so that c_I may be a length, z a pressure and m_i an area. The barrier function is f - mu sum_i m_i log s_i.

   Every inequality, slack or bound, is a complementarity pair (t, z) with t z = mu: t is s, x - x_l or x_u - x. A row with two bounds,
   0 <= c_I(x) <= range, has one slack with two pairs: t is s and range - s.

   The files, each calling none but those above it in this list:

     problem  log, work, pairs, iterate, fixed, bounds, slack, sides, rowscale, matrices, jacobian, hessian, evaluate, difference, quasinewton
     measure  stiffness, scale, terms, worth, kkt
     system   rows, operator, assemble, subspace, condense
     linear   residual, guard, krylov, direct, linsolve, augmented, proximal, equality
     space    basis, compliance, activeset, termsystem, termfactor, termdense, termsolve, termlaws, termpath, termset, reduced, kept, filteredspace, filteredsubspace
     step     filter, merit, barrier, regularize, direction, linesearch, newtonsubspace, penalty, freestep, warm, start, relax, restore
     driver   reason, degenerate, convergence, monitor, setup, solve
     type     opts, view, api, ipfilter
*/
#ifndef IPFILTERIMPL_H
#define IPFILTERIMPL_H

#include <petsc/private/taoimpl.h>
#include <petsccompat.h>
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
  PetscReal        acceptable_tol;
  PetscInt         acceptable_it;
  IPStart          start;
  IPBarrierRule    barrier;
  IPKKTMeasure     measure;
  IPForcing        forcing;
  IPScaling        scaling;
  PetscBool        monitor;
  PetscReal        delta_equality, kappa_progress;
  PetscReal        mu0, s0, z0, mu_start, mu_warm, forcing_start;
  PetscReal        kappa_epsilon, kappa_dual, kappa_mu, theta_mu, tau_min, kappa_sigma;
  PetscInt         max_mu_first, max_mu_later;
  PetscReal        gamma_theta, gamma_phi, eta_phi, delta_switch, s_theta, s_phi, gamma_alpha, theta_min_fact, theta_max_fact, obj_max_inc;
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

/* Scratch vectors; whoever gets one gives it back */
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

/* A direction. Those of slacks, of the distances to bounds and of the pairs' multipliers stand in the pairs and follow from x. */
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
  PetscReal constant;     /* what rows that are no inequality have for c; 0: not chosen yet */
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

/* Sizes at the starting point */
typedef struct {
  PetscReal f, gradient;      /* objective and norm of its gradient */
  PetscReal unit;             /* of the objective, with scaling by gradients: 1, or what brings them down to the limit */
  PetscReal length, equality; /* of c_I and c_E */
  PetscReal x;
  PetscReal jacobian;          /* largest row sum of |J|, */
  PetscReal equality_jacobian; /* and of |J_E| */
  PetscReal energy;            /* of the terms that make up the objective */
} IPFirst;

/* Stiffness of the objective at the start, from the diagonal of H */
typedef struct {
  Vec       rho;    /* pressure per length that resists each constraint */
  PetscReal mean;   /* harmonic mean of rho, weighted */
  Vec       hdiag;  /* |diagonal of H|, now */
  PetscReal hscale; /* its mean at the start, */
  PetscBool flat;   /* where all of it was zero: nothing resists a constraint */
} IPStiffness;

/* Terms sum_i b_i |T_i x + t_i| beside the objective, b_i = min(limit_i, coefficient_i times the force of inequality constraint i): terms.c */
typedef struct {
  PetscInt n;                       /* of all ranks; 0: none in this solve */
  Mat      given, T;                /* two rows a term; without the columns of fixed variables */
  IPStamp  stamp;                   /* of T */
  Vec      t;                       /* two entries a term */
  Vec      limit, coefficient;      /* one a term; NULL: no limit, or limits alone */
  Vec      force, best, last, warm; /* tau at the present point, at the best one and at the last, two a term; what the first is to be: NULL: 0 */
  Vec      rho;                     /* force per length that resists a term */
  Vec      dead;                    /* of two entries a term: unit vector along which next to nothing gives way, and v counts as none; zeros: there is none */
} IPTerms;

/* Magnitudes by which residuals are divided; all 1 in the published measure */
typedef struct {
  PetscReal dual;     /* forces that cancel in the stationarity condition */
  PetscReal length;   /* values of c_I */
  PetscReal equality; /* values of c_E */
  PetscReal pressure; /* multipliers, */
  PetscReal balance;  /* and those of one active constraint that balances the objective's gradient; 0: not known */
  PetscReal product;  /* length x pressure: complementarity and mu */
  PetscReal energy;   /* the objective; PETSC_INFINITY in the measures that do not ask for it */
} IPScale;

/* Residuals of the optimality conditions at the current iterate */
typedef struct {
  PetscReal dual, primal, complementarity; /* divided by the scales, mu = 0 */
  PetscReal centrality;                    /* as complementarity, for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity): decides convergence, together with */
  PetscReal work;                          /* what the residuals are worth in the objective, over a multiple of its size */
  PetscReal work_dual;                     /* the stationarity residual's share of it */
  PetscReal violation;                     /* of constraints, slacks apart, over their first size */
  PetscReal unscaled;                      /* largest absolute entry of all residuals, mu = 0 */
  PetscReal dual_norm;                     /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du, inf_compl;     /* largest absolute entries of the primal and the dual residual, and of t z */
} IPKKT;

/* The rows that are condensed: those of c_I, and below them on each rank those of c_E where these are condensed, too, or of norm terms */
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
  PetscInt         relaxation;    /* per cent of work space beyond MUMPS's estimate: what the last factorization came to; 0: none yet */
  PetscInt         negative;      /* its negative pivots */
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

/* Equality constraints whose rows touch few unknowns: condensed with the others, their multipliers found by proximal updates */
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
  PetscReal rounding;           /* changes of phi below this mean nothing */
  PetscReal alpha, alpha_dual;
  PetscInt  ntrials;
  PetscBool blocked;              /* whether it was the filter alone that refused the last trial point refused */
  PetscInt  nblocked, nunblocked; /* steps in a row that were shortened so; how often the filter was cleared for that */
  char      tag;                  /* how the step was accepted: f, h, F, H (second-order correction), R (restoration) */
} IPSearch;

/* Relaxation of constraints without an interior */
typedef struct {
  PetscReal by;          /* what c_I is raised by, */
  PetscReal size;        /* the size of the constraints that it is a fraction of, */
  PetscInt  times;       /* and how often it was */
  PetscReal least_slack; /* that the last step left */
  PetscInt  nvanished;   /* iterates in a row that have a slack of next to nothing */
} IPRelaxation;

/* Feasibility restoration */
typedef struct {
  PetscReal zeta; /* weight of the distance from the last point against the violation */
  Vec       D;    /* m/zeta in the violated rows */
} IPRestoration;

/* Directions P of the filtered subspace, zero on the constraints' unknowns W; the oldest first */
typedef struct {
  PetscInt   n, max;
  Vec       *p, *q;         /* p_j, and K p_j; NULL where not yet needed */
  PetscReal *gram, *factor; /* P^T K P, columns of length max, and its Cholesky factor, the lower triangle */
} IPBasis;

/* C = J_W K_WW^-1 J_W^T, on the first rank */
typedef struct {
  PetscInt   m, n;
  Mat        F, J; /* K_WW factored; J_W */
  Vec        b, x; /* of W, without arrays of their own use */
  PetscInt   ncolumns, maxcolumns;
  PetscInt  *column; /* where the column of a row stands; negative: nowhere yet */
  PetscReal *C;      /* the columns */
} IPCompliance;

static inline PetscReal *IPComplianceColumn(const IPCompliance *c, PetscInt row)
{
  return c->C + (size_t)c->column[row] * (size_t)c->m;
}

/* The contact problem with w eliminated, as activeset.c and termlaws.c state it: constraints, and below them two rows a norm term */
typedef struct {
  PetscInt         m, k, kmax;       /* rows; directions, and room for them */
  PetscReal       *JZ, *T, *h, *t;   /* columns of length m and kmax */
  const PetscReal *G;                /* P^T K P */
  PetscReal       *lambda, *gap, *y; /* forces and motions of the rows */
  PetscReal        length;           /* size of the terms of a gap */
} IPReducedSystem;

/* The constraints that are active, and the factors that belong to them */
typedef struct {
  PetscInt   m, n, k; /* constraints; the active ones that something gives way to; directions in V */
  PetscBool *active, factored;
  PetscInt  *rows;
  PetscReal *L, *V, *H, *r;
} IPActiveSet;

/* The system of a Newton step on the laws of constraints and norm terms: termsystem.c */
typedef struct {
  PetscInt      m, k;        /* rows, directions in V */
  Mat           K, FK;       /* K_WW, and its factors */
  Mat           R, RD, G;    /* R, R D and R D R^T */
  Mat           Bv, Bf;      /* what the rows' equations take of v and f */
  Mat           A, F;        /* B_v R D R^T + B_f in the rows' scale, and its factors, */
  Mat           Pv, Pf;      /* and the B_v and B_f that they are of */
  PetscReal    *gives;       /* what rows give way by, by D */
  PetscReal    *scale;       /* force of a row over the root of its energy */
  PetscReal    *V, *ZV, *H;  /* columns of length m; of length kmax; of length k */
  PetscBLASInt *pivots;      /* of H */
  Vec           S;           /* and the scale that A has */
  PetscReal    *f, *v;       /* scratch, of rows */
  Vec           r, z, w, Kw; /* of rows and of W */
  PetscBool     stale;       /* the factors no longer serve */
  PetscReal    *C;           /* C, where GMRES has given up: termdense.c; NULL: it has not */
} IPTermSystem;

/* What is closed and slips of constraints and norm terms: termlaws.c */
typedef struct {
  PetscInt     m, n;                /* constraints and terms */
  PetscReal   *limit, *coefficient; /* of the terms; coefficient negative: none */
  PetscReal   *rho, *slope;         /* force per length of a term; of its bound by the constraint's force, */
  PetscReal   *theta, *way;         /* bound / |b| and b / |b|, where it was linearized */
  PetscReal   *dead;                /* along which nothing gives way, two a term */
  PetscReal    length;              /* size of the terms of a motion */
  PetscBool   *closed, *slips;
  PetscBool   *takes, listed; /* the rows that take part, once they are known */
  PetscInt     na;            /* and their number */
  PetscReal   *F, *Fy;
  IPTermSystem system;
} IPTermSet;

/* The contact problem on the subspace; n and m are zero on all ranks but the first */
typedef struct {
  PetscBool       first;
  PetscInt        n, m, nterms; /* unknowns W, constraints, norm terms */
  VecScatter      to_W, to_rows, to_terms;
  Vec             on_W, on_rows, on_terms;
  IPTermSet       terms;
  IPCompliance    compliance;
  IPReducedSystem system;
  IPActiveSet     set;
  PetscReal      *Q, *g, *x, *z; /* Q_W; gradient and K_WW^-1 g at the centre; scratch */
  PetscInt        nsteps, nactive;
} IPReduced;

/* What a filtered subspace keeps from one solve to the next */
typedef struct {
  PC               pc;            /* the Krylov method's, set up with K alone, */
  PetscBool        held;          /* or with K + J^T D J, for bodies that only the constraints hold */
  PetscBool        changing;      /* K has changed since it was first seen */
  PetscInt         napplications; /* of the preconditioner in the last solve */
  PetscObjectId    K_id;
  PetscObjectState K_state;
  IPBasis          basis;
} IPKept;

/* The filtered subspace method, while it is on */
typedef struct {
  PetscBool      linear;   /* the routine of the Jacobian has left its matrix alone: linear constraints, */
  PetscBool      constant; /* and that of the Hessian too: a quadratic program */
  PetscBool      on;
  PetscBool      newton; /* by Newton's method, as the objective is not quadratic */
  PetscContainer kept;   /* an IPKept */
  IS             W;      /* the unknowns that V has all of: those of the constraints, and their neighbours */
  IPReduced      reduced;
  Vec            centre, gradient, c; /* the point that the reduced problem counts from; grad f, c_I */
  PetscReal      f;                   /* and f there */
  PetscReal     *pg, *y;              /* P^T grad f there; coefficients of the directions */
  PetscInt       ncentred;            /* steps in a row without a new direction */
  PetscInt       nfutile;             /* steps since the KKT error has last been halved, */
  PetscReal      halved;              /* and what it was then */
  PetscReal      begin;               /* KKT error of the first reduced problem's solution */
} IPFiltered;

/* What a TaoSolve() did */
typedef struct {
  PetscInt             nksp, max_nksp, *ksp_iterations; /* Krylov iterations of every linear solve */
  PetscInt             nsystems, nfiltered;             /* condensed matrices, and those preconditioned with the filter */
  TaoIPFilterFallbacks fallbacks;
  PetscInt             nregularized, nretried; /* steps taken with a shifted Hessian, and systems solved to find the shift */
  PetscReal            delta_largest;          /* largest shift a step was taken with */
  PetscInt             nrestored;              /* restorations */
  PetscInt             ntiny;                  /* steps in a row that are as small as rounding */
  PetscInt             nacceptable;            /* iterates in a row within the acceptable tolerance */
  PetscInt             napplications;          /* of the preconditioner in the filtered subspace method, */
  PetscInt             nreduced, npivots;      /* its reduced problems, and the active sets that they took */
  PetscInt             ndirections;            /* iterations that were a direction of it, no step of Newton's */
  PetscReal            best_error;             /* KKT error of the best iterate, */
  PetscReal            best_violation;         /* and its violation */
  char                 reason[256];
} IPRecord;

typedef struct {
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

#define IP_TINY_STEP       (10.0 * PETSC_MACHINE_EPSILON) /* of x: rounding makes such steps */
#define IP_LEAST_SLACK     1e-14                          /* of the size of the constraints: smaller ones only cost accuracy, and tell that there is no interior */
#define IP_CLOSE           1e-6                           /* fraction of ||b|| from which on rounding may be what stops a Krylov method */
#define IP_MANY_ITERATIONS 500                            /* of a Krylov method, when others of the same problem took few */

/* No value of a function there: NaN, or infinite, be it C's infinity or PETSc's large number */
static inline PetscBool IPUndefined(PetscReal value)
{
  return (PetscBool)(PetscIsInfOrNanReal(value) || PetscAbsReal(value) >= PETSC_INFINITY);
}

/* ---- problem ---- */

/* log.c */
PETSC_INTERN PetscLogEvent  TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve, TAO_IPFilterApply, TAO_IPFilterAppend, TAO_IPFilterReduced;
PETSC_INTERN PetscErrorCode IPLogRegister(void);

/* work.c */
PETSC_INTERN PetscErrorCode IPGetWork(Tao, IPSpace, Vec *);
PETSC_INTERN PetscErrorCode IPRestoreWork(Tao, IPSpace, Vec *);
PETSC_INTERN PetscErrorCode IPWorkDestroy(IPWork *);

/* pairs.c */
PETSC_INTERN PetscErrorCode IPPairCreate(Vec, Vec, PetscReal sign, IPPair *);
PETSC_INTERN PetscErrorCode IPPairDestroy(IPPair *);
PETSC_INTERN PetscErrorCode IPPairSetTarget(IPPair *, PetscReal mu, PetscReal corrector_max);
PETSC_INTERN PetscErrorCode IPPairCenter(IPPair *, PetscReal mu);
PETSC_INTERN PetscErrorCode IPPairGetSigma(const IPPair *, Vec);
PETSC_INTERN PetscErrorCode IPPairGetForce(const IPPair *, Vec);
PETSC_INTERN PetscErrorCode IPPairDualDirection(IPPair *);
PETSC_INTERN PetscErrorCode IPPairLogSum(const IPPair *, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairLogSlope(const IPPair *, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairProducts(const IPPair *, PetscReal, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairStepProducts(const IPPair *, PetscReal, PetscReal, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPPairSafeguard(IPPair *, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPPairLift(IPPair *, Vec, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPPairWeightedSquare(Tao, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode IPCentralPair(Vec, Vec, PetscReal, Vec, Vec);
PETSC_INTERN PetscErrorCode IPFractionToBoundary(Tao, PetscInt first, PetscReal tau, PetscReal *primal, PetscReal *dual);

/* iterate.c */
PETSC_INTERN PetscErrorCode IPIterateCreate(Vec x, Vec c, Vec ce, IPIterate *);
PETSC_INTERN PetscErrorCode IPIterateBind(Tao);
PETSC_INTERN PetscErrorCode IPIterateCopyPoint(const IPIterate *, IPIterate *);
PETSC_INTERN PetscErrorCode IPIterateCopy(const IPIterate *, IPIterate *);
PETSC_INTERN PetscErrorCode IPIterateDestroy(IPIterate *);
PETSC_INTERN PetscErrorCode IPDirectionCreate(Vec x, Vec c, Vec ce, IPDirection *);
PETSC_INTERN PetscErrorCode IPDirectionCopy(const IPDirection *, IPDirection *);
PETSC_INTERN PetscErrorCode IPDirectionDestroy(IPDirection *);

/* fixed.c */
PETSC_INTERN PetscBool      IPIsFixed(PetscScalar, PetscScalar);
PETSC_INTERN PetscErrorCode IPFixedSetUp(Tao, PetscBool *changed);
PETSC_INTERN PetscErrorCode IPFixedZero(Tao, Vec);
PETSC_INTERN PetscErrorCode IPFixedMatrix(Tao, Mat);

/* bounds.c */
PETSC_INTERN PetscBool      IPWarmBounds(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPBoundsSetUp(Tao);
PETSC_INTERN PetscErrorCode IPBoundsPush(Tao);
PETSC_INTERN PetscErrorCode IPBoundsDistance(Tao, Vec, PetscBool trial);
PETSC_INTERN PetscErrorCode IPBoundsDirection(Tao);
PETSC_INTERN PetscErrorCode IPBoundsAddForces(Tao, Vec);
PETSC_INTERN PetscErrorCode IPBoundsCenter(Tao);
PETSC_INTERN PetscErrorCode IPBoundsMultipliers(Tao, Vec, Vec);

/* sides.c */
PETSC_INTERN PetscErrorCode IPSidesSetUp(Tao);
PETSC_INTERN PetscErrorCode IPSidesSetUpPairs(Tao);
PETSC_INTERN PetscErrorCode IPSidesUpdateWidth(Tao);
PETSC_INTERN PetscErrorCode IPSidesConstraints(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSidesEquality(Vec own, Vec all, PetscBool back);
PETSC_INTERN PetscErrorCode IPSidesMultipliers(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSidesTakeEquality(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSidesTakePairs(Tao);
PETSC_INTERN PetscErrorCode IPSidesReturnPairs(Tao);
PETSC_INTERN PetscErrorCode IPSidesDestroy(IPSides *);

/* slack.c */
PETSC_INTERN PetscErrorCode IPSlackSigma(Tao, Vec);
PETSC_INTERN PetscErrorCode IPSlackForce(Tao, Vec);
PETSC_INTERN PetscErrorCode IPSlackPressure(Tao, Vec);
PETSC_INTERN PetscErrorCode IPSlackDirection(Tao);
PETSC_INTERN PetscErrorCode IPSlackDistance(Tao, Vec, PetscBool trial);
PETSC_INTERN PetscErrorCode IPSlackViolation(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSlackCentral(Tao, Vec, PetscReal, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSlackKeepInside(Tao, Vec, PetscReal);
PETSC_INTERN PetscErrorCode IPSlackCenterUpper(Tao, PetscReal);

/* rowscale.c */
PETSC_INTERN PetscErrorCode IPRowScaleSetUp(Tao, PetscBool *scaled);
PETSC_INTERN PetscErrorCode IPRowScaleReset(Tao, PetscBool *changed);
PETSC_INTERN PetscErrorCode IPRowScalePair(Tao, Vec, Vec, PetscBool back);
PETSC_INTERN PetscErrorCode IPRowScaleNorm(Tao, IPSpace, Vec, PetscReal *);

/* matrices.c */
PETSC_INTERN PetscErrorCode IPMatrixSamePattern(Mat, Mat, PetscBool *);
PETSC_INTERN PetscErrorCode IPMatrixKeep(Mat *, Mat *);
PETSC_INTERN PetscErrorCode IPMatrixConvert(Mat, Mat *);
PETSC_INTERN PetscErrorCode IPMatricesCheck(Tao, PetscBool *changed);

/* jacobian.c */
PETSC_INTERN PetscErrorCode IPJacobianEquality(Tao);
PETSC_INTERN PetscErrorCode IPJacobianInequality(Tao);
PETSC_INTERN PetscErrorCode IPJacobianDestroy(IPJacobian *);

/* hessian.c */
PETSC_INTERN PetscErrorCode IPHessianEvaluate(Tao);
PETSC_INTERN PetscErrorCode IPHessianDiagonal(Tao, Vec);
PETSC_INTERN PetscErrorCode IPHessianDestroy(IPHessian *);

/* evaluate.c */
PETSC_INTERN PetscErrorCode IPEvaluateConstraints(Tao, Vec, Vec, Vec);
PETSC_INTERN PetscErrorCode IPEvaluateDerivatives(Tao);
PETSC_INTERN PetscErrorCode IPSetMultipliers(Tao);

/* difference.c */
PETSC_INTERN PetscErrorCode IPDifferenceHessian(Tao);

/* quasinewton.c */
PETSC_INTERN PetscErrorCode IPQuasiNewtonSetUp(Tao);
PETSC_INTERN void           IPQuasiNewtonReset(IPQuasiNewton *);
PETSC_INTERN PetscErrorCode IPQuasiNewtonAdd(Tao, Vec, Vec);
PETSC_INTERN Mat            IPQuasiNewtonOperator(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPQuasiNewtonDestroy(IPQuasiNewton *);

/* ---- measure ---- */

/* stiffness.c */
PETSC_INTERN PetscErrorCode IPCompliances(Tao, Mat, Vec);
PETSC_INTERN PetscErrorCode IPComputeStiffness(Tao);
PETSC_INTERN PetscErrorCode IPStiffnessUpdate(Tao);
PETSC_INTERN PetscErrorCode IPStiffnessTerms(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPStiffnessEnergies(Tao, PetscReal *largest, PetscReal *mean);

/* scale.c */
PETSC_INTERN PetscErrorCode IPComputeScale(Tao);
PETSC_INTERN PetscReal      IPAbsoluteTolerance(const TAO_IPFILTER *, PetscReal given, PetscReal by_gradients);

/* terms.c, beside the public functions */
PETSC_INTERN PetscErrorCode IPTermsDestroy(IPTerms *);
PETSC_INTERN PetscErrorCode IPTermsSetUp(Tao);
PETSC_INTERN PetscErrorCode IPTermsValue(Tao, Vec x, Vec);
PETSC_INTERN void           IPTermRemoveDead(const PetscScalar dead[2], PetscScalar v[2]);
PETSC_INTERN PetscErrorCode IPTermsSum(Tao, Vec x, Vec force, PetscReal *);
PETSC_INTERN PetscErrorCode IPTermsSubtractForces(Tao, Vec);
PETSC_INTERN PetscReal      IPTermBound(PetscReal limit, PetscReal coefficient, PetscReal force);
PETSC_INTERN PetscReal      IPTermViolation(const PetscScalar tau[2], const PetscScalar v[2], PetscReal rho, PetscReal bound);
PETSC_INTERN PetscErrorCode IPTermsViolation(Tao, PetscReal *largest);
PETSC_INTERN PetscErrorCode TaoIPFilterSetNormTerms_IPFilter(Tao, Mat, Vec, Vec, Vec);
PETSC_INTERN PetscErrorCode TaoIPFilterSetNormTermForces_IPFilter(Tao, Vec);
PETSC_INTERN PetscErrorCode TaoIPFilterGetNormTermForces_IPFilter(Tao, Vec *);

/* resistance.c */
PETSC_INTERN PetscErrorCode IPTermsResistance(Tao);

/* worth.c */
PETSC_INTERN PetscErrorCode IPWorthTerms(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPWorthEnergy(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPWorthOfResiduals(Tao);
PETSC_INTERN PetscErrorCode IPWorthOfRelaxation(Tao, PetscReal *);
PETSC_INTERN PetscBool      IPWorthWithin(const TAO_IPFILTER *, PetscReal gap);
PETSC_INTERN PetscReal      IPWorthForceUnit(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPWorthForceUnitAfter(Tao, Vec, PetscReal *);
PETSC_INTERN PetscReal      IPWorthLeastMu(const TAO_IPFILTER *);

/* kkt.c */
PETSC_INTERN PetscReal      IPBothErrors(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPComputeKKT(Tao);
PETSC_INTERN PetscErrorCode IPStationarity(Tao, Vec, Vec);

/* ---- system ---- */

/* rows.c */
PETSC_INTERN PetscErrorCode IPRowsTake(Tao);
PETSC_INTERN PetscErrorCode IPRowsUpdate(Tao, Vec);
PETSC_INTERN PetscErrorCode IPRowsDestroy(IPRows *);

/* operator.c */
PETSC_INTERN PetscErrorCode IPOperatorUpdate(Tao);

/* assemble.c */
PETSC_INTERN PetscErrorCode IPCondensedWriteHessian(Tao, PetscBool pattern, PetscBool values);
PETSC_INTERN PetscErrorCode IPCondensedAddProduct(IPCondensed *);

/* subspace.c */
PETSC_INTERN PetscErrorCode IPSubspaceOf(Tao, Mat, IS *);
PETSC_INTERN PetscErrorCode IPSubspaceUpdate(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceSwitch(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceGrow(Tao, Mat, IS, IS *);

/* condense.c */
PETSC_INTERN PetscErrorCode IPCondenseMatrix(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondenseRHS(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPBackSubstitute(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondensedDestroy(IPCondensed *);

/* ---- linear ---- */

/* residual.c */
PETSC_INTERN PetscErrorCode IPResidualMeasure(Tao, Vec, Vec);
PETSC_INTERN PetscBool      IPResidualReached(const TAO_IPFILTER *, KSPConvergedReason);
PETSC_INTERN PetscErrorCode IPResidualRefine(Tao, Vec, Vec, PetscBool, PetscErrorCode (*)(Tao, Vec, Vec), KSPConvergedReason);
PETSC_INTERN PetscErrorCode IPResidualNotANumber(Tao);

/* guard.c */
PETSC_INTERN PetscErrorCode IPGuardedSolve(Tao, KSP, Vec b, Vec x, PetscBool *failed);

/* kspreset.c */
PETSC_INTERN PetscErrorCode IPKSPReset(KSP);

/* krylov.c */
PETSC_INTERN PetscErrorCode IPKrylovRecord(Tao, PetscInt its);
PETSC_INTERN PetscErrorCode IPKrylovSolve(Tao, Vec, Vec, IPLinearVerdict *);

/* direct.c */
PETSC_INTERN PetscErrorCode IPDirectSolve(Tao, Vec, Vec, IPLinearVerdict *);
PETSC_INTERN PetscErrorCode IPDirectDestroy(IPDirect *);

/* linsolve.c */
PETSC_INTERN PetscErrorCode IPLinearSolve(Tao, Vec, Vec, PetscReal target, PetscBool *usable);

/* augmented.c */
PETSC_INTERN PetscErrorCode IPAugmentedSolve(Tao, Vec, Vec, Vec, PetscBool matrix, PetscBool *usable);
PETSC_INTERN PetscErrorCode IPAugmentedMultipliers(Tao);
PETSC_INTERN PetscErrorCode IPAugmentedDestroy(IPAugmented *);

/* proximal.c */
PETSC_INTERN PetscErrorCode IPProximalSolve(Tao, Vec, Vec, Vec, PetscReal target, PetscBool *usable, PetscBool *exact);
PETSC_INTERN PetscErrorCode IPProximalRestore(Tao, Vec, Vec, Vec, PetscBool *usable);

/* equality.c */
PETSC_INTERN PetscErrorCode IPEqualityChoose(Tao);
PETSC_INTERN PetscErrorCode IPEqualitySolve(Tao, Vec, Vec, Vec, PetscBool matrix, PetscReal target, PetscBool *usable);
PETSC_INTERN PetscErrorCode IPEqualityRestore(Tao, Vec, Vec, Vec, PetscBool *usable);
PETSC_INTERN PetscErrorCode IPEqualityMultipliers(Tao);

/* ---- space ---- */

/* basis.c */
PETSC_INTERN PetscErrorCode IPBasisCreate(PetscInt max, IPBasis *);
PETSC_INTERN PetscErrorCode IPBasisDestroy(IPBasis *);
PETSC_INTERN PetscErrorCode IPBasisAppend(IPBasis *, Mat K, Vec, PetscBool *appended);
PETSC_INTERN PetscErrorCode IPBasisCompress(IPBasis *, PetscInt best, PetscInt last, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPBasisMultiply(IPBasis *, Mat K);
PETSC_INTERN PetscErrorCode IPBasisRestrict(IPBasis *, Mat K, IS W);

/* compliance.c */
PETSC_INTERN PetscErrorCode IPComplianceSetUp(IPCompliance *, Mat K, Mat J, PetscBool *factored);
PETSC_INTERN PetscErrorCode IPComplianceDestroy(IPCompliance *);
PETSC_INTERN PetscErrorCode IPComplianceSolve(IPCompliance *, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceMultiply(IPCompliance *, PetscBool transposed, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceColumns(IPCompliance *, PetscInt n, const PetscInt rows[]);

/* activeset.c */
PETSC_INTERN PetscErrorCode IPActiveSetCreate(PetscInt m, IPActiveSet *);
PETSC_INTERN PetscErrorCode IPActiveSetDestroy(IPActiveSet *);
PETSC_INTERN PetscErrorCode IPActiveSetSolve(IPActiveSet *, IPCompliance *, const IPReducedSystem *, PetscInt *steps, PetscBool *solved);

/* termsystem.c */
PETSC_INTERN PetscErrorCode IPTermSystemSetUp(IPTermSystem *, PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R);
PETSC_INTERN PetscErrorCode IPTermSystemDestroy(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemSetRow(IPTermSystem *, PetscInt row, PetscInt n, const PetscInt columns[], const PetscReal by_v[], const PetscReal by_f[], PetscReal scale);
PETSC_INTERN PetscErrorCode IPTermSystemAssemble(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemApplyCompliance(IPTermSystem *, const PetscReal f[], PetscReal v[]);

/* termfactor.c */
PETSC_INTERN PetscErrorCode IPTermFactorPrepare(IPTermSystem *, const IPReducedSystem *, PetscBool *ready);
PETSC_INTERN PetscErrorCode IPTermFactorApply(IPTermSystem *, const PetscReal r[], PetscReal z[]);

/* termdense.c */
PETSC_INTERN PetscBool      IPTermDenseFits(const IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermDenseSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rf[], PetscReal ry[], PetscBool *solved);

/* termsolve.c */
PETSC_INTERN PetscErrorCode IPTermSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rtol, PetscReal rf[], PetscReal ry[], PetscBool *solved);

/* termlaws.c */
PETSC_INTERN PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPTermSet *);
PETSC_INTERN PetscErrorCode IPTermLawsDestroy(IPTermSet *);
PETSC_INTERN PetscInt       IPTermLawsRow(const IPTermSet *, PetscInt term);
PETSC_INTERN PetscReal      IPTermLawsBound(const IPTermSet *, const IPReducedSystem *, PetscInt term);
PETSC_INTERN PetscErrorCode IPTermLawsMove(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN void           IPTermLawsRelieve(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsGiveWay(const IPTermSet *, PetscInt row);
PETSC_INTERN void           IPTermLawsResist(IPTermSet *);
PETSC_INTERN void           IPTermLawsMotion(const IPTermSet *, const IPReducedSystem *, PetscInt term, PetscReal v[2]);
PETSC_INTERN PetscReal      IPTermLawsTrial(const IPTermSet *, const IPReducedSystem *, PetscInt term, PetscReal b[2]);
PETSC_INTERN PetscInt       IPTermLawsOfRow(const IPTermSet *, PetscInt row, PetscInt *component);
PETSC_INTERN PetscErrorCode IPTermLawsResidualOfDirections(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsMerit(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscErrorCode IPTermLawsRenew(IPTermSet *, const IPReducedSystem *);

/* termpath.c */
PETSC_INTERN PetscErrorCode IPTermPathFollow(IPTermSet *, const IPReducedSystem *, PetscInt *steps, PetscBool *followed);

/* termset.c */
PETSC_INTERN PetscErrorCode IPTermSetSolve(IPTermSet *, const IPReducedSystem *, PetscInt *steps, PetscBool *solved);

/* reduced.c */
PETSC_INTERN PetscErrorCode IPReducedSetUp(IPReduced *, Mat K, Mat J, const IPTerms *, IS W, Vec x, Vec c, const IPBasis *, PetscBool *definite);
PETSC_INTERN PetscErrorCode IPReducedDestroy(IPReduced *);
PETSC_INTERN PetscErrorCode IPReducedSetTerms(IPReduced *, const IPTerms *, Vec scale);
PETSC_INTERN PetscErrorCode IPReducedGuess(IPReduced *, Vec guess, Vec force, const IPTerms *);
PETSC_INTERN PetscErrorCode IPReducedCenter(IPReduced *, Vec gradient, Vec c, Vec value, const PetscReal pg[]);
PETSC_INTERN PetscErrorCode IPReducedAppend(IPReduced *, const IPBasis *, const PetscReal pg[]);
PETSC_INTERN PetscErrorCode IPReducedForget(IPReduced *);
PETSC_INTERN PetscErrorCode IPReducedCoupling(const IPReduced *, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPReducedSolve(IPReduced *, PetscReal y[], Vec v, Vec force, Vec terms, PetscBool *solved);

/* kept.c, beside the public functions */
PETSC_INTERN PetscErrorCode IPKeptGet(Tao, IPKept **);
PETSC_INTERN PetscErrorCode IPKeptReset(IPKept *);
PETSC_INTERN PetscErrorCode IPKeptHold(Tao, IPKept *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPKeptReconsider(Tao, IPKept *, PetscReal left, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPKeptUpdate(Tao, IPKept *, PetscBool *possible);
PETSC_INTERN PetscErrorCode TaoIPFilterSetSolvesToCome_IPFilter(Tao, PetscInt);
PETSC_INTERN PetscErrorCode TaoIPFilterGetSubspace_IPFilter(Tao, PetscContainer *);
PETSC_INTERN PetscErrorCode TaoIPFilterSetSubspace_IPFilter(Tao, PetscContainer);

/* filteredspace.c */
PETSC_INTERN PetscErrorCode IPFilteredSetUp(Tao, const IPBasis *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPFilteredDestroy(IPFiltered *);
PETSC_INTERN PetscErrorCode IPFilteredCentre(Tao, const IPBasis *, Vec x, Vec centre, Vec gradient, Vec c);
PETSC_INTERN PetscErrorCode IPFilteredSolve(Tao, const IPBasis *, Vec v, Vec force, PetscBool *solved);
PETSC_INTERN PetscErrorCode IPFilteredSetPairs(Tao, Vec force);
PETSC_INTERN PetscErrorCode IPFilteredMakeRoom(Tao, IPBasis *);
PETSC_INTERN PetscBool      IPFilteredProgresses(IPFiltered *, PetscReal error, PetscInt patience);
PETSC_INTERN PetscErrorCode IPFilteredAllows(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPFilteredExtend(Tao, IPKept *, Vec r, PetscBool *extended);

/* filteredsubspace.c */
PETSC_INTERN PetscErrorCode IPFilteredBegin(Tao, PetscBool *begun);
PETSC_INTERN PetscErrorCode IPFilteredStep(Tao, PetscBool *done);
PETSC_INTERN PetscErrorCode IPFilteredEnd(Tao);

/* ---- step ---- */

/* filter.c */
PETSC_INTERN PetscErrorCode IPFilterSetReset(IPFilterSet *);
PETSC_INTERN PetscErrorCode IPFilterSetAdd(IPFilterSet *, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPFilterSetAccepts(const IPFilterSet *, PetscReal, PetscReal, PetscBool *);
PETSC_INTERN PetscErrorCode IPFilterSetDestroy(IPFilterSet *);

/* merit.c */
PETSC_INTERN PetscErrorCode IPMeritMeasure(Tao);
PETSC_INTERN PetscErrorCode IPMeritMeasureTrial(Tao, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPMeritSlope(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPMeritFilterAdd(Tao);

/* barrier.c */
PETSC_INTERN PetscErrorCode IPBarrierAverage(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPBarrierUpdate(Tao);
PETSC_INTERN PetscErrorCode IPBarrierHold(Tao, PetscInt);
PETSC_INTERN PetscErrorCode IPBarrierFromAffine(Tao);

/* regularize.c */
PETSC_INTERN PetscErrorCode IPRegularizeMore(Tao);
PETSC_INTERN void           IPRegularized(TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPRegularize(Tao, PetscReal, PetscErrorCode (*)(Tao), PetscErrorCode (*)(Tao, PetscBool *), PetscBool *);

/* direction.c */
PETSC_INTERN PetscErrorCode IPComputeDirection(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPCorrectDirection(Tao, Vec, Vec, PetscBool *);

/* linesearch.c */
PETSC_INTERN PetscErrorCode IPLineSearch(Tao, PetscBool *);

/* newtonsubspace.c */
PETSC_INTERN PetscErrorCode IPNewtonSubspaceStep(Tao, PetscBool *done);

/* penalty.c */
PETSC_INTERN PetscErrorCode IPPenaltyPressure(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPPenaltyStep(Tao, PetscBool *);

/* warm.c */
PETSC_INTERN PetscErrorCode IPWarmSetBounds(Tao);
PETSC_INTERN PetscBool      IPWarmEquality(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPWarmSetEquality(Tao);
PETSC_INTERN PetscErrorCode IPWarmMeanProduct(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPWarmCenterBounds(Tao);

/* freestep.c */
PETSC_INTERN PetscErrorCode IPFreeStep(Tao, PetscBool *, PetscReal *);

/* start.c */
PETSC_INTERN PetscErrorCode IPStartPoint(Tao);

/* relax.c */
PETSC_INTERN PetscErrorCode IPRelax(Tao);
PETSC_INTERN PetscErrorCode IPRelaxInstead(Tao, PetscBool *);

/* restore.c */
PETSC_INTERN PetscErrorCode IPRestore(Tao, PetscBool *, PetscBool *);

/* ---- driver ---- */

/* reason.c */
PETSC_INTERN PetscErrorCode IPSetReason(Tao, TaoConvergedReason, const char[], ...) PETSC_ATTRIBUTE_FORMAT(3, 4);

/* degenerate.c */
PETSC_INTERN PetscErrorCode IPDegenerateCancellation(Tao, PetscReal *times);
PETSC_INTERN PetscErrorCode IPDegenerateFritzJohn(Tao, PetscBool *holds);

/* convergence.c */
PETSC_INTERN PetscErrorCode IPTestFirstPoint(Tao);
PETSC_INTERN PetscErrorCode IPTestNumbers(Tao);
PETSC_INTERN PetscBool      IPConstraintsMet(Tao);
PETSC_INTERN PetscErrorCode IPTestConvergence(Tao);
PETSC_INTERN PetscBool      IPAcceptable(const TAO_IPFILTER *);

/* monitor.c */
PETSC_INTERN PetscErrorCode IPMonitor(Tao);

/* setup.c */
PETSC_INTERN PetscErrorCode TaoSetUp_IPFilter(Tao);
PETSC_INTERN PetscErrorCode IPSetUpSizes(Tao);
PETSC_INTERN PetscErrorCode TaoDestroy_IPFilter(Tao);

/* solve.c */
PETSC_INTERN PetscErrorCode TaoSolve_IPFilter(Tao);

/* ---- type ---- */

/* opts.c */
PETSC_INTERN const char *const IPStarts[], *const IPBarrierRules[], *const IPKKTMeasures[], *const IPForcings[], *const IPSubspaceUses[], *const IPEqualityMethods[];
PETSC_INTERN PetscErrorCode IPOptionsInitialize(IPOptions *);
PETSC_INTERN PetscErrorCode TaoSetFromOptions_IPFilter(Tao, AMGFOptionItems);

/* view.c */
PETSC_INTERN PetscErrorCode TaoView_IPFilter(Tao, PetscViewer);

/* api.c */
PETSC_INTERN PetscErrorCode TaoIPFilterComposeFunctions(Tao, PetscBool);

#endif
