/*
   tao_ipfilter/iteration: one step, with filter, barrier, direction, line search, and restoration. The files are listed
   such that each depends only on those before it and on the folders above this one in ipfilterimpl.h.
*/
#ifndef IPFILTER_ITERATIONIMPL_H
#define IPFILTER_ITERATIONIMPL_H

#include "tao_ipfilter/linear/linearimpl.h"

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
PETSC_INTERN PetscErrorCode IPRegularize(Tao, PetscReal, PetscErrorCode (*)(Tao), PetscErrorCode (*)(Tao, PetscBool *),
  PetscBool *);

/* direction.c */
PETSC_INTERN PetscErrorCode IPComputeDirection(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPCorrectDirection(Tao, Vec, Vec, PetscBool *);
PETSC_INTERN PetscErrorCode IPDirectionAssemble(Tao);

/* curvature.c */
PETSC_INTERN PetscErrorCode IPNegativeCurvature(Tao, PetscBool *found);

/* watchdog.c */
PETSC_INTERN PetscErrorCode IPWatchdogBegin(Tao, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode IPWatchdogReturn(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPWatchdogEnd(IPWatchdog *);

/* linesearch.c */
PETSC_INTERN PetscErrorCode IPLineSearch(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPSearchTrial(Tao, PetscReal, PetscReal *, PetscReal *, PetscBool *);
PETSC_INTERN PetscErrorCode IPSearchTakeStep(Tao, PetscReal, PetscReal);
PETSC_INTERN PetscBool      IPSearchIsLinear(const TAO_IPFILTER *);

/* leave.c */
PETSC_INTERN PetscErrorCode IPLeaveStationary(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPLeaveInflection(Tao, PetscBool *);

/* penalty.c */
PETSC_INTERN PetscErrorCode IPPenaltyPressure(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPPenaltyStep(Tao, PetscBool *);

/* start.c */
PETSC_INTERN PetscErrorCode IPStartPoint(Tao);

/* relax.c */
PETSC_INTERN PetscBool      IPRelaxApplies(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPRelax(Tao);

/* restore.c */
PETSC_INTERN PetscErrorCode IPRestore(Tao, PetscBool *, PetscBool *);

#endif
