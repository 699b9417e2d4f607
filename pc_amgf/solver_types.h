/*
   Names of a sparse Cholesky factorization on one rank (cholesky/README.md): in double precision, and with factors that
   are rounded to single precision, for preconditioners
*/
#ifndef AMGF_SOLVER_TYPES_H
#define AMGF_SOLVER_TYPES_H

#define MATSOLVERAMGF       "amgf"
#define MATSOLVERAMGFSINGLE "amgf_single"

/* Functions that are composed with the factors, see cholesky/solver.c */
#define AMGF_CHOLESKY_SET_SINGLE "AMGFCholeskySetSingle_C"
#define AMGF_CHOLESKY_GET_COSTS  "AMGFCholeskyGetCosts_C"

#endif
