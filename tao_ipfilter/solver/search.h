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
  PetscReal before;            /* norm of the previous search direction; that of the last one is dir.norm */
  PetscBool slows;             /* whether the last step of a length above zero was one of linear convergence */
  Vec       slow;              /* its direction then */
  PetscInt  ntrials, ndefined; /* number of trial points of the last search; of those with finite values, also in the
                                  restoration after it */
  PetscInt  ncut;              /* number of consecutive steps that were shortened to a small fraction */
  char      tag; /* how the step was accepted: f, h, F or H (second-order correction), R (restoration), w (watchdog) */
};

/* watchdog.c: steps taken without a test, and the iterate to return to if they fail */
struct _n_IPWatchdog {
  IPIterate from;
  PetscReal mu, theta, phi, slope; /* values at the iterate `from` */
  PetscReal alpha;                 /* length of the first step from there */
  PetscInt  left;                  /* number of steps without a test that may still be taken; 0: the watchdog is off */
  PetscInt  nshort, patience;      /* number of consecutive shortened steps; number that starts the watchdog */
};

#endif
