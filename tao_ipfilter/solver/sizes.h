#ifndef IPFILTER_SIZES_H
#define IPFILTER_SIZES_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Sizes at the starting point */
struct _n_IPFirst {
  PetscReal f, gradient;      /* objective, and norm of its gradient */
  PetscReal unit;             /* scale of the objective with scaling by gradients; else 1 */
  PetscReal length, equality; /* sizes of c_I (without rows out of reach) and of c_E */
  PetscReal x;
  PetscReal reach;             /* expected change of the unknowns (reach.c); 0: unknown */
  PetscReal jacobian;          /* largest row sum of |J|, */
  PetscReal equality_jacobian; /* and of |J_E| */
  PetscReal energy;            /* magnitude of the objective's terms */
  PetscReal pressure;          /* equal multiplier of all rows that balances the gradient; 0: unknown */
};

/* Scales of residuals; all 1 in the published measure */
struct _n_IPScale {
  PetscReal dual;           /* forces that cancel in the stationarity condition */
  PetscReal length;         /* size of c_I */
  PetscReal equality;       /* size of c_E */
  PetscReal equality_terms; /* terms that cancel in c_E at the present point */
  PetscReal pressure;       /* multipliers, */
  PetscReal balance;        /* terms of an active constraint that balances the objective's gradient; 0: unknown */
  PetscReal product;        /* length x pressure: scale of complementarity and mu */
  PetscReal energy;         /* size of the objective; PETSC_INFINITY if not used by the measure */
};

#endif
