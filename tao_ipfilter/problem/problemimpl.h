/*
   The map of tao_ipfilter/problem: the problem as the iteration sees it: pairs, iterates, bounds, sides, scales of
   rows, Jacobians, Hessian. Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_PROBLEMIMPL_H
#define IPFILTER_PROBLEMIMPL_H

#include <petsc/private/taoimpl.h>
#include <petsccompat.h>
#include <petscamgf.h>

#if defined(PETSC_USE_COMPLEX)
  #error "ipfilter needs a PETSc with real scalars: inequalities order numbers"
#endif

typedef struct _n_TAO_IPFILTER TAO_IPFILTER; /* the solver: ipfilterimpl.h */

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

/* log.c */
PETSC_INTERN PetscLogEvent TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve, TAO_IPFilterApply,
  TAO_IPFilterAppend, TAO_IPFilterReduced;
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
PETSC_INTERN PetscErrorCode IPFractionToBoundary(Tao, PetscInt first, PetscReal tau, PetscReal *primal,
  PetscReal *dual);

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

#endif
