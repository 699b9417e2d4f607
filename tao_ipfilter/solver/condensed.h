#ifndef IPFILTER_CONDENSED_H
#define IPFILTER_CONDENSED_H

#include "tao_ipfilter/solver/solverimpl.h"

/* rows.c: rows that are condensed: those of c_I, and on each rank below them those of condensed equality constraints
   or of norm terms */
struct _n_IPRows {
  Mat     J; /* NULL: none */
  Vec     D; /* their weights */
  IPStamp stamp;
  IPStamp source[2];         /* stamps of the matrices that J was made from */
  Vec     inequality, below; /* weights of the upper and lower rows */
};

/* condense.c: the condensed matrix A = H + Sigma + J^T D J + delta M_u, and data to reuse its assembly */
struct _n_IPCondensed {
  IPRows           rows;
  Mat              A;
  Mat              DJ, JtDJ;           /* D J, J^T D J */
  Vec              shift;              /* the diagonal Sigma + delta M_u that is added to H */
  Vec              hdiag;              /* diagonal of H, while a shift is added to it */
  PetscBool        shifted;            /* A's diagonal contains a shift */
  PetscObjectId    H_id;               /* the H from which A was assembled, */
  PetscObjectState H_state, H_nonzero; /* with which values and pattern */
  PetscObjectId    J_id;               /* the Jacobian of the product's pattern, */
  PetscObjectState J_nonzero;          /* with which pattern */
  PetscObjectId    filter_id;          /* the Jacobian of the filter, */
  PetscObjectState filter_state;       /* with which values */
  PetscInt         ntouched;           /* local rows with entries of J^T D J */
  PetscInt        *touched;
  IS               filter; /* composed on A under PCAMGF_FILTER_KEY */
};

#endif
