/*
   The map of tao_ipfilter/step: a step: filter, barrier, direction, line search, restoration.
   Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_STEPIMPL_H
#define IPFILTER_STEPIMPL_H

#include "tao_ipfilter/linear/linearimpl.h"

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

/* linesearch.c */
PETSC_INTERN PetscErrorCode IPLineSearch(Tao, PetscBool *);

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

#endif
