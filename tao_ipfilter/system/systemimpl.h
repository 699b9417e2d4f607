/*
   The map of tao_ipfilter/system: the condensed matrix A = H + Sigma + J^T D J + delta M_u and its filter.
   Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_SYSTEMIMPL_H
#define IPFILTER_SYSTEMIMPL_H

#include "tao_ipfilter/measure/measureimpl.h"

/* The rows that are condensed: those of c_I, and below them on each rank those of c_E where these are condensed, too,
   or of norm terms */
typedef struct {
  Mat     J; /* NULL: none */
  Vec     D; /* their weights */
  IPStamp stamp;
  IPStamp source[2];         /* of the matrices that one of both was made from */
  Vec     inequality, below; /* weights of either kind */
} IPRows;

/* The condensed matrix A = H + Sigma + J^T D J + delta M_u and what its assembly reuses */
typedef struct {
  IPRows           rows;
  Mat              A;
  Mat              DJ, JtDJ;           /* D J, J^T D J */
  Vec              shift;              /* Sigma + delta M_u, the diagonal added to H */
  Vec              hdiag;              /* diagonal of H, kept while a shift is added to it */
  PetscBool        shifted;            /* A's diagonal holds a shift */
  PetscObjectId    H_id;               /* which H A was assembled from, */
  PetscObjectState H_state, H_nonzero; /* with which values and pattern */
  PetscObjectId    J_id;               /* which Jacobian the product's pattern came from, */
  PetscObjectState J_nonzero;          /* with which pattern */
  PetscObjectId    filter_id;          /* which Jacobian the filter came from, */
  PetscObjectState filter_state;       /* with which values */
  PetscInt         ntouched;           /* rows of this rank touched by J^T D J */
  PetscInt        *touched;
  IS               filter; /* composed on A under PCAMGF_FILTER_KEY */
} IPCondensed;

/* rows.c */
PETSC_INTERN PetscErrorCode IPRowsTake(Tao);
PETSC_INTERN PetscErrorCode IPRowsUpdate(Tao, Vec);
PETSC_INTERN PetscErrorCode IPRowsDestroy(IPRows *);

/* operator.c */
PETSC_INTERN PetscErrorCode IPOperatorUpdate(Tao);

/* assemble.c */
PETSC_INTERN PetscErrorCode IPCondensedWriteHessian(Tao, PetscBool pattern, PetscBool values);
PETSC_INTERN PetscErrorCode IPCondensedAddProduct(IPCondensed *);

/* subspace.c */
PETSC_INTERN PetscErrorCode IPSubspaceOf(Tao, Mat, IS *);
PETSC_INTERN PetscErrorCode IPSubspaceUpdate(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceSwitch(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceGrow(Tao, Mat, IS, IS *);

/* condense.c */
PETSC_INTERN PetscErrorCode IPCondenseMatrix(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondenseRHS(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPBackSubstitute(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondensedDestroy(IPCondensed *);

#endif
