/*
   The solver TAOIPFILTER: the problem's sizes, the iterate and the direction. Each of its parts is declared in a header
   of its own in this folder; a file includes those of the parts that it works on.
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

/* Parts of the solver; the headers that the solver names declare them */
typedef struct _n_IPOptions     IPOptions;
typedef struct _n_IPGiven       IPGiven;
typedef struct _n_IPWork        IPWork;
typedef struct _n_IPSides       IPSides;
typedef struct _n_IPRowScale    IPRowScale;
typedef struct _n_IPJacobian    IPJacobian;
typedef struct _n_IPHessian     IPHessian;
typedef struct _n_IPQuasiNewton IPQuasiNewton;
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

/* Whether a function value is NaN or infinite, or PETSc's large number */
static inline PetscBool IPUndefined(PetscReal value)
{
  return (PetscBool)(PetscIsInfOrNanReal(value) || PetscAbsReal(value) >= PETSC_INFINITY);
}

/* Verdict on a linear solve */
typedef enum {
  IP_LINEAR_SOLVED,
  IP_LINEAR_INDEFINITE, /* the matrix is not positive definite */
  IP_LINEAR_FAILED      /* the solver failed; says nothing about the matrix */
} IPLinearVerdict;

struct _n_TAO_IPFILTER {
  PetscReal   tol;    /* tolerance of this solve: tao->gatol */
  PetscInt    mi, me; /* inequality and equality constraints on all ranks; rows with equal bounds count as both */
  IS          fixed;  /* this rank's variables with equal bounds; NULL if no rank has any */
  PetscReal   mu;
  IPPair      pair[IP_NPAIRS];
  IPIterate   at, best, trial; /* at.x is tao->solution, at.s and at.z belong to the pairs; best: smallest KKT error */
  IPDirection dir;
  Vec         rx, rc;              /* grad f - J^T M lambda + J_E^T y - bound multipliers, and c_I - s */
  const struct _n_IPLawsOps *laws; /* laws of norm terms; NULL: not registered */

  /* Parts, by the header in this folder that declares them */
  IPOptions     *opt;   /* options.h: what the user sets, */
  IPGiven       *given; /*            and what the caller sets */
  IPWork        *work;  /* work.h: work vectors */
  IPSides       *sides; /* rows.h: kinds of the rows of c_I, */
  IPRowScale    *rows;  /*         and scales of all rows */
  IPJacobian    *jac;   /* matrices.h */
  IPHessian     *hess;
  IPQuasiNewton *qn;      /* quasinewton.h */
  IPFirst       *first;   /* sizes.h: sizes at the starting point, */
  IPScale       *scale;   /*          and scales of residuals */
  IPStiffness   *stiff;   /* stiffness.h */
  IPTerms       *terms;   /* terms.h: norm terms */
  IPKKT         *kkt;     /* kkt.h: residuals of the optimality conditions */
  IPCondensed   *cond;    /* condensed.h: the condensed matrix */
  IPLinear      *lin;     /* linear.h: linear solves */
  IPDirect      *direct;  /* factors.h: the condensed matrix factored, */
  IPAugmented   *aug;     /*            the system with equality constraints, */
  IPProximal    *prox;    /*            and condensed equality constraints */
  IPBarrier     *bar;     /* barrier.h: choice of mu, */
  IPShift       *shift;   /*            and the multiple of M_u added to the Hessian */
  IPFilterSet   *filter;  /* search.h: the filter, */
  IPSearch      *search;  /*           the line search, */
  IPWatchdog    *watch;   /*           and its watchdog */
  IPRelaxation  *relax;   /* relaxation.h: constraints without an interior, */
  IPRestoration *restore; /*               and feasibility restoration */
  IPMethod      *method;  /* method.h: alternative to the interior point method */
  IPRecord      *rec;     /* record.h: record of this solve */
};

#endif
