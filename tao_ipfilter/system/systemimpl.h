/*
   tao_ipfilter/system: the condensed matrix A = H + Sigma + J^T D J + delta M_u and its filter. The files are listed
   such that each depends only on those before it and on the folders above this one in ipfilterimpl.h.
*/
#ifndef IPFILTER_SYSTEMIMPL_H
#define IPFILTER_SYSTEMIMPL_H

#include "tao_ipfilter/residuals/residualsimpl.h"

/* rows.c */
PETSC_INTERN PetscErrorCode IPRowsTake(Tao);
PETSC_INTERN PetscErrorCode IPRowsUpdate(Tao, Vec);
PETSC_INTERN PetscErrorCode IPRowsDestroy(IPRows *);

/* operator.c */
PETSC_INTERN PetscErrorCode IPOperatorUpdate(Tao);

/* assemble.c */
PETSC_INTERN PetscErrorCode IPCondensedWriteHessian(Tao, PetscBool pattern, PetscBool values);
PETSC_INTERN PetscErrorCode IPCondensedAddProduct(IPCondensed *);

/* constrained.c */
PETSC_INTERN PetscErrorCode IPConstrainedOf(Mat, IS *);
PETSC_INTERN PetscErrorCode IPConstrainedUpdate(Tao);
PETSC_INTERN PetscErrorCode IPConstrainedSwitch(Tao);
PETSC_INTERN PetscErrorCode IPConstrainedGrow(Tao, Mat, IS, IS *);

/* condense.c */
PETSC_INTERN PetscErrorCode IPCondenseMatrix(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondenseRHS(Tao, Vec, Vec);
PETSC_INTERN PetscErrorCode IPBackSubstitute(Tao, Vec);
PETSC_INTERN PetscErrorCode IPCondensedDestroy(IPCondensed *);

#endif
