/*
   tao_ipfilter/problem: the problem that the iteration solves, with pairs, iterates, bounds, row sides, row scales,
   Jacobians and Hessian. The files are listed such that each depends only on those before it.
*/
#ifndef IPFILTER_PROBLEMIMPL_H
#define IPFILTER_PROBLEMIMPL_H

#include "tao_ipfilter/solver/solverimpl.h"

/* log.c */
PETSC_INTERN PetscLogEvent TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve, TAO_IPFilterApply,
  TAO_IPFilterDirections, TAO_IPFilterReduced, TAO_IPFilterFactor;
PETSC_INTERN PetscErrorCode IPLogRegister(void);

/* work.c */
PETSC_INTERN PetscErrorCode IPGetWork(Tao, IPSpace, Vec *);
PETSC_INTERN PetscErrorCode IPRestoreWork(Tao, IPSpace, Vec *);
PETSC_INTERN PetscErrorCode IPWorkTrim(IPWork *);
PETSC_INTERN PetscErrorCode IPWorkDestroy(IPWork *);

/* layouts.c */
PETSC_INTERN PetscErrorCode IPGivenCheck(Tao);

/* pairs.c */
PETSC_INTERN PetscErrorCode IPPairCreate(Vec, Vec, PetscReal sign, IPPair *);
PETSC_INTERN PetscErrorCode IPPairSetWeights(Vec, IPPair *);
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

/* bounds.c; bounds of at least IP_NO_BOUND count as infinite, like IPOPT's nlp_lower_bound_inf and
   nlp_upper_bound_inf */
#define IP_NO_BOUND 1e19

static inline PetscBool IPBoundIsFinite(PetscReal bound)
{
  return (PetscBool)(PetscAbsReal(bound) < IP_NO_BOUND);
}

PETSC_INTERN PetscErrorCode IPBoundsSetUp(Tao);
PETSC_INTERN PetscErrorCode IPBoundsPush(Tao);
PETSC_INTERN PetscErrorCode IPBoundsDistance(Tao, Vec, PetscBool trial);
PETSC_INTERN PetscErrorCode IPBoundsReturn(Tao);
PETSC_INTERN PetscErrorCode IPBoundsDirection(Tao);
PETSC_INTERN PetscErrorCode IPBoundsAddForces(Tao, Vec);
PETSC_INTERN PetscErrorCode IPBoundsCenter(Tao);
PETSC_INTERN PetscErrorCode IPBoundsMultipliers(Tao, Vec, Vec);

/* constraint_bounds.c */
PETSC_INTERN PetscErrorCode IPSidesSetUp(Tao);
PETSC_INTERN PetscErrorCode IPSidesSetUpPairs(Tao);
PETSC_INTERN PetscErrorCode IPSidesUpdateWidth(Tao);
PETSC_INTERN PetscErrorCode IPSidesConstraints(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSidesEquality(Vec own, Vec all, PetscBool back);
PETSC_INTERN PetscErrorCode IPSidesMultipliers(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPSidesTakePairs(Tao);
PETSC_INTERN PetscErrorCode IPSidesReturnPairs(Tao);
PETSC_INTERN PetscErrorCode IPSidesDestroy(IPSides *);

/* slack.c */
PETSC_INTERN PetscErrorCode IPSlackSigma(Tao, Vec);
PETSC_INTERN PetscErrorCode IPSlackForce(Tao, Vec);
PETSC_INTERN PetscErrorCode IPSlackPressure(Tao, Vec);
PETSC_INTERN PetscErrorCode IPSlackDirection(Tao);
PETSC_INTERN PetscErrorCode IPSlackDistance(Tao, Vec, PetscBool trial);
PETSC_INTERN PetscErrorCode IPSlackSetCompliance(Tao);
PETSC_INTERN PetscErrorCode IPSlackYield(Tao, Vec, Vec);
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
/* Creates the matrix of type AIJ with the rows of `top` above those of `bottom` on each rank, or with
   MAT_REUSE_MATRIX computes its values anew. Both have the same columns. */
PETSC_INTERN PetscErrorCode IPMatrixStack(Mat top, Mat bottom, MatReuse, Mat *stack);
PETSC_INTERN PetscErrorCode IPMatrixCreate(MPI_Comm, PetscInt rows, PetscInt columns, const PetscInt counts[], Mat *);
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
PETSC_INTERN PetscErrorCode IPDifferenceInUse(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPDifferenceHessian(Tao);

#endif
