/*
   Names of a sparse Cholesky factorization on one rank (cholesky/README.md): in double precision, and with factors that
   are rounded to single precision, for preconditioners
*/
#ifndef AMGF_CHOLESKY_H
#define AMGF_CHOLESKY_H

#define MATSOLVERAMGF       "amgf"
#define MATSOLVERAMGFSINGLE "amgf_single"

#endif
