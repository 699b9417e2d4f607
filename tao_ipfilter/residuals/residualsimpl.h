/*
   tao_ipfilter/residuals: sizes and residuals, namely stiffness, scales, norm terms, error bound, KKT error. The files
   are listed such that each depends only on those before it and on the folders above this one in ipfilterimpl.h.
*/
#ifndef IPFILTER_RESIDUALSIMPL_H
#define IPFILTER_RESIDUALSIMPL_H

#include "tao_ipfilter/problem/problemimpl.h"

/* stiffness.c */
PETSC_INTERN PetscErrorCode IPCompliances(Tao, Mat, Vec);
PETSC_INTERN PetscErrorCode IPComputeStiffness(Tao);
PETSC_INTERN PetscErrorCode IPStiffnessUpdate(Tao);
PETSC_INTERN PetscErrorCode IPStiffnessTerms(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPStiffnessMeanEnergy(Tao, PetscReal *mean);

/* row_violation.c */
PETSC_INTERN PetscReal      IPConstraintRounding(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPOwnTerms(Mat, Vec x, Vec sums, Vec largest);
PETSC_INTERN PetscErrorCode IPOwnViolation(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPOwnActiveSize(Tao, PetscReal *);

/* far_rows.c */
PETSC_INTERN PetscErrorCode IPMeasureReach(Tao);
PETSC_INTERN PetscReal      IPReachOfUnknowns(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPSizeWithinReach(Tao, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode IPValuesWithinReach(Tao, Vec, Vec);

/* scale.c */
PETSC_INTERN PetscErrorCode IPComputeScale(Tao);

/* terms.c, in addition to its public functions */
PETSC_INTERN PetscErrorCode IPTermsDestroy(IPTerms *);
PETSC_INTERN PetscErrorCode IPTermsSetUp(Tao);
PETSC_INTERN PetscErrorCode IPTermsSetNone(Tao);
PETSC_INTERN PetscErrorCode IPTermsValue(Tao, Vec x, Vec);
PETSC_INTERN void           IPTermRemoveRigid(const PetscScalar rigid[2], PetscScalar v[2]);
PETSC_INTERN PetscErrorCode IPTermsSum(Tao, Vec x, Vec force, PetscReal *);
PETSC_INTERN PetscErrorCode IPTermsSubtractForces(Tao, Vec);
PETSC_INTERN PetscReal      IPTermBound(PetscReal limit, PetscReal coefficient, PetscReal force);
PETSC_INTERN PetscReal      IPTermViolation(const PetscScalar tau[2], const PetscScalar v[2], PetscReal rho,
       PetscReal bound);
PETSC_INTERN PetscErrorCode IPTermsViolation(Tao, PetscReal *largest);
PETSC_INTERN PetscErrorCode IPTermsSetUnmoved(Tao);
PETSC_INTERN PetscBool      IPNeedsMethod(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode TaoIPFilterSetNormTerms_IPFilter(Tao, Mat, Vec, Vec, Vec);
PETSC_INTERN PetscErrorCode TaoIPFilterSetNormTermForces_IPFilter(Tao, Vec);
PETSC_INTERN PetscErrorCode TaoIPFilterGetNormTermForces_IPFilter(Tao, Vec *);

/* resistance.c */
PETSC_INTERN PetscErrorCode IPTermsResistance(Tao);

/* error_bound.c */
PETSC_INTERN PetscErrorCode IPErrorBoundTerms(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPErrorBoundEnergy(Tao, PetscReal *, PetscReal *);
PETSC_INTERN PetscErrorCode IPErrorBoundOfResiduals(Tao);
PETSC_INTERN PetscErrorCode IPErrorBoundOfRelaxation(Tao, PetscReal *);
PETSC_INTERN PetscReal      IPErrorBoundOfWork(const TAO_IPFILTER *, PetscReal work);
PETSC_INTERN PetscBool      IPErrorBoundWithin(const TAO_IPFILTER *, PetscReal gap);
PETSC_INTERN PetscBool      IPErrorBoundRefined(const TAO_IPFILTER *);
PETSC_INTERN PetscBool      IPErrorBoundWithinPresent(const TAO_IPFILTER *, PetscReal tol);
PETSC_INTERN PetscReal      IPErrorBoundForceUnit(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPErrorBoundForceUnitAfter(Tao, Vec, PetscReal *);
PETSC_INTERN PetscReal      IPErrorBoundLeastMu(const TAO_IPFILTER *);

/* kkt.c */
PETSC_INTERN PetscReal      IPBothErrors(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPComputeKKT(Tao);
PETSC_INTERN PetscErrorCode IPStationarity(Tao, Vec, Vec);

/* cancellation.c */
PETSC_INTERN PetscErrorCode IPCancellation(Tao, PetscReal *times);

#endif
