#ifndef IPFILTER_SEARCH_H
#define IPFILTER_SEARCH_H

#include "tao_ipfilter/solver/solverimpl.h"

/* The filter: pairs (theta, phi) that later iterates must improve on */
struct _n_IPFilterSet {
  PetscInt   n, max;
  PetscReal *theta, *phi;
};

/* Line search: measures of the present iterate, their units, and the last step */
struct _n_IPSearch {
  PetscReal theta, phi;
  PetscReal theta0;             /* theta at the first iterate; negative: none yet */
  PetscReal theta_ref, phi_ref; /* units */
  PetscReal equality_weight;    /* converts c_E to the units of theta */
  PetscReal rounding;           /* rounding error of phi, */
  PetscReal theta_rounding;     /* and of theta */
  PetscReal alpha, alpha_dual;
  PetscReal before; /* norm of the direction before the last one */
  PetscInt  ntrials;
  PetscBool blocked;              /* the last rejected trial point was rejected by the filter alone */
  PetscInt  ncut;                 /* consecutive steps that were cut to a small part */
  PetscInt  nblocked, nunblocked; /* consecutive steps shortened by the filter; number of times it was cleared for
                                     that */
  char      tag; /* how the step was accepted: f, h, F, H (second-order correction), R (restoration), w (watchdog) */
};

/* watchdog.c: steps without test, and the iterate to return to */
struct _n_IPWatchdog {
  IPIterate from;
  PetscReal mu, theta, phi, slope; /* there */
  PetscReal alpha;                 /* length of the first step from there */
  PetscInt  left;                  /* steps without test that are left; 0: none are taken */
  PetscInt  nshort, patience;      /* consecutive shortened steps, and how many it takes */
};

#endif
