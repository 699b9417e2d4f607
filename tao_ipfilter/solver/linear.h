#ifndef IPFILTER_LINEAR_H
#define IPFILTER_LINEAR_H

#include "tao_ipfilter/solver/solverimpl.h"

/* The current linear system and its last solve */
struct _n_IPLinear {
  KSP                flexible;       /* flexible CG for corrections; NULL until needed */
  Vec                residual;       /* b - A d */
  PetscReal          target, rhs;    /* requested ||b - A d||; ||b|| */
  PetscReal          norm;           /* ||b - A d||, */
  PetscReal          backward_error; /* and relative to the norm of its terms */
  PetscInt           its, limit;     /* Krylov iterations, and their limit */
  PetscInt           longest;        /* largest number of iterations in a successful solve */
  KSPConvergedReason reason;
  PetscBool          failed;        /* no solver gave a direction, for other reasons than the matrix's inertia */
  char               why[128];      /* why the last remedy failed */
  PetscInt           ndirect;       /* consecutive solves in which only MUMPS succeeded */
  PetscBool          filtered;      /* the filter was used */
  PetscBool          filter_forced; /* the filter stays on */
};

#endif
