#ifndef IPFILTER_BARRIER_H
#define IPFILTER_BARRIER_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Choice of mu */
struct _n_IPBarrier {
  PetscBool free;          /* mehrotra: mu from the affine step; otherwise Fiacco and McCormick's rule */
  PetscReal corrector_max; /* mehrotra: limit of the second-order term */
  PetscReal first;         /* mean product t z at the start */
  PetscReal errors[4];     /* recent KKT errors, which the free mode must improve on */
  PetscInt  nerrors;
  PetscBool curved; /* a step has shown nonlinear constraints or an objective that is not convex */
  PetscInt  hold;   /* mehrotra: iterations left in the monotone mode after a failed line search */
};

/* The multiple delta of M_u added to the Hessian */
struct _n_IPShift {
  PetscReal delta, last; /* delta: present; last: of the last step that needed one */
};

#endif
