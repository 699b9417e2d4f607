#ifndef IPFILTER_SIZES_H
#define IPFILTER_SIZES_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Sizes at the starting point, from which scales are derived */
struct _n_IPFirst {
  PetscReal f, gradient;      /* objective; norm of its gradient */
  PetscReal length, equality; /* size of c_I, without rows out of reach; size of c_E */
  PetscReal x;
  PetscReal reach;             /* expected change of the unknowns during the solve (far_rows.c); 0: unknown */
  PetscReal jacobian;          /* largest row sum of |J| */
  PetscReal equality_jacobian; /* largest row sum of |J_E| */
  PetscReal energy;            /* sum of the magnitudes of the objective's terms */
  PetscReal pressure;          /* the multiplier that, equal in all rows, balances the objective's gradient; 0:
                                  unknown */
};

/* Scales of residuals. In the published measure (-tao_ipfilter_kkt mass) all are 1. */
struct _n_IPScale {
  PetscReal dual;           /* size of the forces that cancel in the stationarity condition */
  PetscReal length;         /* size of c_I */
  PetscReal equality;       /* size of c_E */
  PetscReal equality_terms; /* size of the terms that cancel in c_E at the present point */
  PetscReal pressure;       /* size of the multipliers */
  PetscReal balance;        /* size of the terms of an active constraint that balances the objective's gradient; 0:
                               unknown */
  PetscReal product;        /* length x pressure, the scale of complementarity and mu */
  PetscReal energy;         /* size of the objective; PETSC_INFINITY if the measure does not use it */
  PetscReal present;        /* the same, however large the objective was at the start */
  PetscReal terms;          /* sum of the magnitudes of the objective's terms at the present point */
};

#endif
