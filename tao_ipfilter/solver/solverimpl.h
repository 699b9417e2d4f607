/*
   The solver TAOIPFILTER: sizes of the problem, iterates and direction. Each part of the solver is declared in its own
   header in this folder. A file includes the headers of the parts that it uses.
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

/* Layouts of work vectors */
typedef enum { IP_UNKNOWNS, IP_INEQUALITIES, IP_EQUALITIES, IP_NSPACES } IPSpace;

/* Parts of the solver. Only the headers named in struct _n_TAO_IPFILTER declare their members. */
typedef struct _n_IPOptions     IPOptions;
typedef struct _n_IPGiven       IPGiven;
typedef struct _n_IPWork        IPWork;
typedef struct _n_IPSides       IPSides;
typedef struct _n_IPRowScale    IPRowScale;
typedef struct _n_IPJacobian    IPJacobian;
typedef struct _n_IPHessian     IPHessian;
typedef struct _n_IPFirst       IPFirst;
typedef struct _n_IPScale       IPScale;
typedef struct _n_IPStiffness   IPStiffness;
typedef struct _n_IPTerms       IPTerms;
typedef struct _n_IPKKT         IPKKT;
typedef struct _n_IPCondensed   IPCondensed;
typedef struct _n_IPLinear      IPLinear;
typedef struct _n_IPDirect      IPDirect;
typedef struct _n_IPAugmented   IPAugmented;
typedef struct _n_IPProximal    IPProximal;
typedef struct _n_IPShift       IPShift;
typedef struct _n_IPBarrier     IPBarrier;
typedef struct _n_IPFilterSet   IPFilterSet;
typedef struct _n_IPSearch      IPSearch;
typedef struct _n_IPWatchdog    IPWatchdog;
typedef struct _n_IPRelaxation  IPRelaxation;
typedef struct _n_IPRestoration IPRestoration;
typedef struct _n_IPMethod      IPMethod;
typedef struct _n_IPRecord      IPRecord;
typedef struct _n_IPRows        IPRows;
typedef struct _n_IPMethodOps   IPMethodOps;

/* Blocks of complementarity pairs */
enum {
  IP_SLACK,
  IP_CEILING, /* upper sides of rows with two bounds */
  IP_LOWER,
  IP_UPPER,
  IP_NPAIRS
};

/*
   Complementarity pairs (t_i, z_i) with t_i z_i -> mu. Where a bound is absent, t_i is PETSC_INFINITY and z_i is zero.
*/
typedef struct {
  PetscInt  n;      /* number of pairs on all ranks; 0: the vectors are NULL */
  PetscReal sign;   /* derivative of t by x or c_I: -1 for upper bounds and upper sides, +1 for the others */
  PetscReal weight; /* sum of the weights of all pairs */
  Vec       w;      /* weights m_i */
  Vec       t, z;   /* distances to the bound; multipliers */
  Vec       dt, dz; /* direction */
  Vec       target; /* right-hand side of the linearized condition t z = target: mu, or mu minus the second-order
                       term */
  Vec       trial;  /* distances t at a trial point */
} IPPair;

/* An iterate. Members that are not needed are NULL. */
typedef struct {
  Vec       x, c, ce;     /* the point; c_I and c_E there */
  Vec       s, lambda, y; /* slacks; multipliers of c_I, as a density: the force is M lambda; multipliers of c_E */
  Vec       z[IP_NPAIRS]; /* multipliers z of the pairs */
  PetscReal f;
} IPIterate;

/*
   A search direction. The pairs hold its components for slacks, distances to bounds and their multipliers, which follow
   from x.
*/
typedef struct {
  Vec       x, lambda, y;
  PetscReal norm; /* largest entry of x */
} IPDirection;

/* Identifies a matrix and its state. A matrix with an equal stamp is unchanged. */
typedef struct {
  PetscObjectId    value_id; /* id of the object that has the values of the matrix, and the state of the values */
  PetscObjectState value_state;
  PetscObjectId    pattern_id; /* id of the object that has the nonzero pattern, and the state of the pattern */
  PetscObjectState pattern_state;
} IPStamp;

/* Returns whether a function value is NaN, infinite, or at least PETSC_INFINITY in magnitude */
static inline PetscBool IPUndefined(PetscReal value)
{
  return (PetscBool)(PetscIsInfOrNanReal(value) || PetscAbsReal(value) >= PETSC_INFINITY);
}

/* Outcome of a linear solve */
typedef enum {
  IP_LINEAR_SOLVED,
  IP_LINEAR_INDEFINITE, /* the matrix is not positive definite */
  IP_LINEAR_FAILED      /* the solver failed, which tells nothing about the matrix */
} IPLinearVerdict;

struct _n_TAO_IPFILTER {
  PetscReal   tol;    /* tolerance of this solve, from tao->gatol */
  PetscInt    mi, me; /* number of inequality and of equality constraints on all ranks; rows with equal bounds count
                         in both */
  IS          fixed;  /* this rank's variables with equal bounds; NULL if no rank has any */
  PetscReal   mu;
  IPPair      pair[IP_NPAIRS];
  IPIterate   at, best, trial; /* at: the present iterate, where at.x is tao->solution and at.s, at.z are vectors of
                                  the pairs; best: the iterate with the smallest KKT error; trial: a trial point */
  IPDirection dir;
  Vec         rx, rc;                     /* residuals: grad f - J^T M lambda + J_E^T y - bound multipliers; c_I - s */
  const struct _n_IPLawsOps    *laws;     /* friction laws of norm terms; NULL: not registered */
  const struct _n_IPContactOps *contacts; /* the same for many terms */

  /* The parts of the solver, with the header in this folder that declares each of them */
  IPOptions     *opt;   /* options.h: parameters that the user sets */
  IPGiven       *given; /* options.h: data that the caller sets */
  IPWork        *work;  /* work.h: work vectors */
  IPSides       *sides; /* rows.h: kinds of the rows of c_I */
  IPRowScale    *rows;  /* rows.h: scales of all rows */
  IPJacobian    *jac;   /* matrices.h: Jacobians and Hessian */
  IPHessian     *hess;
  IPFirst       *first;   /* sizes.h: sizes at the starting point */
  IPScale       *scale;   /* sizes.h: scales of residuals */
  IPStiffness   *stiff;   /* stiffness.h: stiffness of the objective */
  IPTerms       *terms;   /* terms.h: norm terms */
  IPKKT         *kkt;     /* kkt.h: residuals of the optimality conditions */
  IPCondensed   *cond;    /* condensed.h: the condensed matrix */
  IPLinear      *lin;     /* linear.h: linear solves */
  IPDirect      *direct;  /* factors.h: factorization of the condensed matrix */
  IPAugmented   *aug;     /* factors.h: augmented system for equality constraints */
  IPProximal    *prox;    /* factors.h: condensed equality constraints */
  IPBarrier     *bar;     /* barrier.h: choice of mu */
  IPShift       *shift;   /* barrier.h: multiple of M_u that is added to the Hessian */
  IPFilterSet   *filter;  /* search.h: the filter */
  IPSearch      *search;  /* search.h: the line search */
  IPWatchdog    *watch;   /* search.h: the watchdog */
  IPRelaxation  *relax;   /* relaxation.h: relaxation of constraints without an interior */
  IPRestoration *restore; /* relaxation.h: feasibility restoration */
  IPMethod      *method;  /* method.h: alternative to the interior point method */
  IPRecord      *rec;     /* record.h: record of this solve */
};

#endif
