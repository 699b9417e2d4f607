#ifndef IPFILTER_MATRICES_H
#define IPFILTER_MATRICES_H

#include "tao_ipfilter/solver/solverimpl.h"

/* jacobian.c: the constraints' Jacobians used by the iteration: rows scaled, columns of fixed variables zeroed */
struct _n_IPJacobian {
  Mat     inequality, equality;             /* AIJ */
  IPStamp inequality_stamp, equality_stamp; /* stamps of the caller's matrices */
  Mat     converted[2];                     /* conversions to AIJ */
};

/* The Hessian used by the iteration */
struct _n_IPHessian {
  Mat       H;
  Mat       converted; /* conversion to AIJ, for types that cannot be used directly */
  PetscBool products;  /* only products are available, also of the condensed matrix */
};

#endif
