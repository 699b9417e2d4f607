#ifndef IPFILTER_SEARCH_H
#define IPFILTER_SEARCH_H

#include "tao_ipfilter/solver/solverimpl.h"

/* The filter: pairs (theta, phi). A later iterate must improve on each of them in theta or in phi. */
struct _n_IPFilterSet {
  PetscInt   n, max;
  PetscReal *theta, *phi;
};

/* Line search: violation theta and barrier function phi of the present iterate, and data of the last step */
struct _n_IPSearch {
  PetscReal theta, phi;
  PetscReal theta0;             /* theta at the first iterate; negative: not yet computed */
  PetscReal theta_ref, phi_ref; /* divisors that make theta and phi dimensionless */
  PetscReal equality_weight;    /* factor that converts c_E to the unit of theta */
  PetscReal rounding;           /* rounding error of phi */
  PetscReal theta_rounding;     /* rounding error of theta */
  PetscReal alpha, alpha_dual;
  PetscInt  ntrials, ndefined; /* number of trial points of the last search; of those with finite values, also in the
                                  restoration after it */
  PetscInt  ncut;              /* number of consecutive steps that were shortened to a small fraction */
  char      tag;               /* how the step was accepted: f, h, F or H (second-order correction), R (restoration) */
};

#endif
