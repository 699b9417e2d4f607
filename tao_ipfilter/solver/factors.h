#ifndef IPFILTER_FACTORS_H
#define IPFILTER_FACTORS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* direct.c: the factorization of the condensed matrix by MUMPS */
struct _n_IPDirect {
  Mat              A, F;          /* the matrix in MUMPS's format; its factors */
  PetscBool        converted;     /* whether A is a converted copy of the condensed matrix */
  PetscObjectId    pattern_id;    /* object id of the matrix that MUMPS analysed */
  PetscObjectState pattern_state; /* state of its nonzero pattern */
  PetscInt         system;        /* number of the factored system, a value of rec.nsystems; 0: none */
  PetscInt         negative;      /* number of negative pivots */
};

/* augmented.c: the symmetric system [A J_E^T; J_E -delta] for equality constraints, and its factorization */
struct _n_IPAugmented {
  Mat       K, F;     /* the system; its factors */
  Mat       shift;    /* the diagonal matrix -delta I */
  PetscReal delta;    /* diagonal value delta: that of a restoration step, or the regularization of dependent
                           constraints; 0: none */
  PetscBool centered; /* whether the regularization acts on the change of the multipliers; otherwise it acts on the
                           multipliers */
  PetscBool safe;     /* whether the relative pivot threshold is the large one */
  Vec       rhs, sol, residual, correction;
};

/*
   proximal.c: condensation of equality constraints that involve few unknowns, with proximal updates of their
   multipliers
*/
struct _n_IPProximal {
  PetscBool condensed; /* whether this solve condenses the equality constraints; reset if that fails */
  PetscInt  nupdates;  /* number of updates of the multipliers in each linear solve after the first update */
};

#endif
