#ifndef IPFILTER_RELAXATION_H
#define IPFILTER_RELAXATION_H

#include "tao_ipfilter/solver/solverimpl.h"

/* relax.c: relaxation of constraints whose feasible set has no interior */
struct _n_IPRelaxation {
  PetscReal by;          /* amount that is added to c_I */
  PetscReal size;        /* size of the constraints, of which `by` is a fraction */
  PetscReal unknowns;    /* amount by which the bounds of variables are moved outward */
  PetscReal told;        /* amount of relaxation for messages, in the caller's units: the larger one of `by` and
                            `unknowns` */
  PetscInt  times;       /* number of relaxations */
  PetscReal least_slack; /* smallest slack after the last step */
  PetscReal least_bound; /* smallest distance from a bound after the last step */
  PetscInt  nvanished;   /* number of consecutive iterates with a vanishing slack */
};

/* Feasibility restoration */
struct _n_IPRestoration {
  PetscReal zeta; /* restore.c: weight of the distance from the last point relative to that of the violation */
  Vec       D;    /* weights m/zeta of the violated rows */
};

#endif
