/* Sparse factors of symmetric matrices with real scalars: by CHOLMOD on one rank, otherwise by MUMPS */
#ifndef AMGF_SPARSE_FACTORS_H
#define AMGF_SPARSE_FACTORS_H

#include <petscmat.h>

/* An option of the factors and its value, which is used unless the user gives another. The name has no prefix. */
typedef struct {
  const char *name, *value;
} AMGFSetting;

/* With ScaLAPACK, MUMPS would not count the negative pivots of the root node */
#define AMGF_COUNT_ALL_PIVOTS \
  { \
    "mat_mumps_icntl_13", "1" \
  }

PETSC_INTERN PetscErrorCode AMGFSymmetricFactor(Mat, const char prefix[], Mat *F, PetscInt *negative, MatFactorError *);
PETSC_INTERN PetscErrorCode AMGFSymmetricFill(Mat, const char prefix[], Mat *F, PetscReal *fill);
PETSC_INTERN PetscErrorCode AMGFMumpsFactor(Mat, const char prefix[], const AMGFSetting[], PetscReal *memory, Mat *F,
  MatFactorError *);

#endif
