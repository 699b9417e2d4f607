/* Registration of the factorization */
#ifndef AMGF_CHOLESKY_SOLVER_H
#define AMGF_CHOLESKY_SOLVER_H

#include <petscmat.h>

PETSC_INTERN PetscErrorCode AMGFCholeskyRegister(void);

#endif
