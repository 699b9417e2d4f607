#ifndef IPFILTER_QUASINEWTON_H
#define IPFILTER_QUASINEWTON_H

#include "tao_ipfilter/solver/solverimpl.h"

/* quasinewton.c: the limited-memory approximation B of the Hessian */
struct _n_IPQuasiNewton {
  Mat              B;                    /* NULL: the Hessian is the caller's or differenced */
  Mat              A;                    /* shell of the condensed matrix with all of B */
  PetscReal        sigma;                /* B = sigma I + a matrix of low rank */
  PetscInt         npairs;               /* number of steps of this solve in B */
  PetscBool        begun;                /* whether B was initialized in this solve */
  Vec              x, gradient;          /* last point, and the objective's gradient there */
  Mat              inequality, equality; /* copies of the caller's Jacobians at the last point */
  PetscObjectState inequality_state, equality_state;
  Vec              sum; /* sum of all damped gradient changes */
};

#endif
