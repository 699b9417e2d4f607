#ifndef IPFILTER_RELAXATION_H
#define IPFILTER_RELAXATION_H

#include "tao_ipfilter/solver/solverimpl.h"

/* relax.c: relaxation of constraints without an interior */
struct _n_IPRelaxation {
  PetscReal by;          /* amount added to c_I */
  PetscReal size;        /* size of the constraints; `by` is a fraction of it */
  PetscReal unknowns;    /* amount by which bounds are moved */
  PetscReal told;        /* larger one of `by` and `unknowns`, in the caller's units */
  PetscInt  times;       /* number of relaxations */
  PetscReal least_slack; /* smallest slack after the last step */
  PetscReal least_bound; /* smallest distance from a bound after the last step */
  PetscInt  nvanished;   /* consecutive iterates with a vanishing slack */
};

/* Feasibility restoration */
struct _n_IPRestoration {
  PetscReal zeta; /* restore.c: weight of the distance from the last point relative to the violation */
  Vec       D;    /* m/zeta in the violated rows */
};

#endif
