#ifndef IPFILTER_BARRIER_H
#define IPFILTER_BARRIER_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Choice of the barrier parameter mu */
struct _n_IPBarrier {
  PetscBool free;          /* true: Mehrotra's rule computes mu from the affine step; false: Fiacco and McCormick's
                              monotone rule */
  PetscReal corrector_max; /* Mehrotra's rule: largest absolute value of the second-order term dt dz of a pair */
  PetscReal first;         /* mean of t z over all pairs at the starting point */
  PetscReal errors[4];     /* the last KKT errors, which Mehrotra's rule must reduce; otherwise mu becomes monotone */
  PetscInt  nerrors;
  PetscBool curved; /* a step has shown that the constraints are nonlinear or that the objective is not convex */
  PetscInt  hold;   /* Mehrotra's rule: remaining iterations of the monotone rule after a failed line search */
};

/* The multiple delta of M_u that is added to the Hessian */
struct _n_IPShift {
  PetscReal delta, last; /* delta: present value; last: value in the last step that needed one */
};

#endif
