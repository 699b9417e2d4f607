#ifndef IPFILTER_FACTORS_H
#define IPFILTER_FACTORS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* direct.c: the condensed matrix factored by MUMPS */
struct _n_IPDirect {
  Mat              A, F;          /* the matrix in MUMPS's format, and its factors */
  PetscBool        converted;     /* A is a converted copy */
  PetscObjectId    pattern_id;    /* the matrix that was analysed, */
  PetscObjectState pattern_state; /* and state of its pattern */
  PetscReal        memory;        /* predicted memory of the factors, all ranks [1e6 bytes] */
  PetscInt         system;        /* the factored matrix, by its number rec.nsystems */
  PetscInt
    relaxation; /* work space beyond MUMPS's estimate in the last successful factorization [per cent]; 0: none yet */
  PetscInt negative; /* number of negative pivots */
};

/* augmented.c: the symmetric system [A J_E^T; J_E -delta] for equality constraints, and its factorization */
struct _n_IPAugmented {
  KSP       ksp;
  Mat       K;
  Mat       shift;      /* -delta I */
  PetscReal delta;      /* of a restoration step, or regularization of dependent constraints: */
  PetscBool centered;   /* the regularization acts on the change of the multipliers, not on the multipliers */
  PetscInt  relaxation; /* work space beyond MUMPS's estimate [per cent], and */
  PetscReal pivot;      /* relative pivot threshold, in the last successful factorization; 0: none yet */
  Vec       rhs, sol, residual, correction;
};

/* proximal.c: equality constraints that involve few unknowns: condensed, with proximal updates of their multipliers */
struct _n_IPProximal {
  PetscBool condensed; /* in this solve, unless it turns out not to work */
  PetscInt  nupdates;  /* updates of the multipliers beyond the first in each solve */
};

#endif
