#ifndef IPFILTER_MATRICES_H
#define IPFILTER_MATRICES_H

#include "tao_ipfilter/solver/solverimpl.h"

/* jacobian.c: the Jacobians used by the iteration. Rows are scaled, and columns of fixed variables are zero. */
struct _n_IPJacobian {
  Mat     inequality, equality;             /* of type AIJ */
  IPStamp inequality_stamp, equality_stamp; /* stamps of the caller's matrices */
  Mat     converted[2];                     /* caller's Jacobians converted to AIJ: inequality, equality; NULL if the
                                               caller's are AIJ */
};

/* The Hessian used by the iteration */
struct _n_IPHessian {
  Mat       H;
  Mat       converted; /* H converted to AIJ, for types that cannot be used directly; otherwise NULL */
  Vec       gradient;  /* gradient of the objective at x = 0, if H is constant; NULL: not known */
  PetscBool products;  /* the Hessian, and therefore the condensed matrix, only has products, no entries */
};

#endif
