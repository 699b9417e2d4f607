#ifndef IPFILTER_QUASINEWTON_H
#define IPFILTER_QUASINEWTON_H

#include "tao_ipfilter/solver/solverimpl.h"

/* quasinewton.c: the limited-memory approximation B of the Hessian */
struct _n_IPQuasiNewton {
  Mat              B;                    /* NULL: the Hessian comes from the caller or from differences */
  Mat              A;                    /* shell matrix of the condensed matrix with B in place of sigma I */
  PetscReal        sigma;                /* B is sigma I plus a matrix of low rank */
  PetscInt         npairs;               /* number of steps of this solve that are stored in B */
  PetscBool        begun;                /* whether B was initialized in this solve */
  Vec              x, gradient;          /* the last point; the objective's gradient there */
  Mat              inequality, equality; /* copies of the caller's Jacobians at the last point */
  PetscObjectState inequality_state, equality_state;
  Vec              sum; /* sum of all damped changes of the gradient, see QuasiNewtonHessian() */
};

#endif
