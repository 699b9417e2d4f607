#ifndef IPFILTER_LINEAR_H
#define IPFILTER_LINEAR_H

#include "tao_ipfilter/solver/solverimpl.h"

/* The current linear system A d = b and its last solve */
struct _n_IPLinear {
  KSP                flexible;       /* flexible CG for corrections; NULL until needed */
  Vec                residual;       /* b - A d */
  PetscReal          target, rhs;    /* requested ||b - A d||, and ||b|| */
  PetscReal          norm;           /* ||b - A d|| */
  PetscReal          backward_error; /* `norm` relative to the norm of the terms of b - A d */
  PetscInt           its, limit;     /* number of Krylov iterations; the largest number allowed */
  PetscInt           longest;        /* largest number of iterations in a successful solve */
  KSPConvergedReason reason;
  PetscBool          failed;        /* no solver gave a direction, although the inertia of the matrix is correct */
  char               why[128];      /* why the last fallback failed; empty if it did not */
  PetscInt           ndirect;       /* number of consecutive solves in which only MUMPS succeeded */
  PetscBool          filtered;      /* whether the preconditioner used the filter */
  PetscBool          filter_forced; /* whether the filter is used in all further solves */
};

#endif
