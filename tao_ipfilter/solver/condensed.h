#ifndef IPFILTER_CONDENSED_H
#define IPFILTER_CONDENSED_H

#include "tao_ipfilter/solver/solverimpl.h"

/*
   rows.c: the condensed rows, J^T D J of which is added to the Hessian. On each rank these are the rows of c_I,
   followed by those of condensed equality constraints or of norm terms.
*/
struct _n_IPRows {
  Mat     J; /* Jacobian of the condensed rows; NULL: there are none */
  Vec     D; /* weights of the condensed rows */
  IPStamp stamp;
  IPStamp source[2];         /* stamps of the two matrices from which J was assembled */
  Vec     inequality, below; /* weights of the rows of c_I; weights of the rows that follow */
  Vec     given;             /* weights of the rows that follow, where they are not to be chosen here; NULL: none */
};

/* condense.c: the condensed matrix A = H + Sigma + J^T D J + delta M_u, and what is needed to reuse its assembly */
struct _n_IPCondensed {
  IPRows           rows;
  Mat              A;
  Mat              DJ, JtDJ;           /* the products D J and J^T D J */
  Vec              shift;              /* the diagonal Sigma + delta M_u that is added to H */
  Vec              hdiag;              /* diagonal of H; A's diagonal is computed from it while a shift is added */
  PetscBool        shifted;            /* whether A's diagonal contains a shift */
  PetscObjectId    H_id;               /* object id of the H from which A was assembled */
  PetscObjectState H_state, H_nonzero; /* states of that H: values; nonzero pattern */
  PetscObjectId    J_id;               /* object id of the Jacobian from which the pattern of J^T D J was computed */
  PetscObjectState J_nonzero;          /* state of its nonzero pattern */
  PetscObjectId    constrained_id;     /* object id of the Jacobian from which `constrained` was computed */
  PetscObjectState constrained_state;  /* state of its values */
  PetscInt         ntouched;           /* number of local rows with entries of J^T D J, and these rows */
  PetscInt        *touched;
  IS constrained; /* unknowns that constraints touch, which are attached to A with the key PCAMGF_FILTER_KEY */
};

#endif
