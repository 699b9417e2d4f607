/* Vectors and matrices of three components. */
#if !defined(VECTOR3_H)
  #define VECTOR3_H

  #include <petscsys.h>

static inline PetscReal VectorDot(const PetscReal a[3], const PetscReal b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline PetscReal VectorNorm(const PetscReal a[3])
{
  return PetscSqrtReal(VectorDot(a, a));
}

static inline void VectorCross(const PetscReal a[3], const PetscReal b[3], PetscReal c[3])
{
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Scales n to length 1 and returns its former length. A zero vector is not changed. */
static inline PetscReal VectorScaleToUnit(PetscReal n[3])
{
  const PetscReal length = VectorNorm(n);

  for (int c = 0; c < 3; ++c) n[c] = length > 0.0 ? n[c] / length : 0.0;
  return length;
}

/* Computes turn = R - 1 from the rotation vector r = |r| n [rad] by Rodrigues' formula: sin|r| [n] + (1 - cos|r|)
   [n]^2. This form has no cancellation for small angles. */
static inline void MatrixSetTurn(const PetscReal r[3], PetscReal turn[3][3])
{
  const PetscReal angle = VectorNorm(r), sine = angle > 0.0 ? PetscSinReal(angle) / angle : 1.0,
                  versine = angle > 0.0 ? 2.0 * PetscSqr(PetscSinReal(0.5 * angle) / angle) : 0.5;

  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;

    turn[i][i] = -versine * (r[j] * r[j] + r[k] * r[k]);
    turn[i][j] = versine * r[i] * r[j] - sine * r[k];
    turn[i][k] = versine * r[i] * r[k] + sine * r[j];
  }
}

/* Computes the cofactors C of J, and returns the determinant. The inverse of J is the transpose of C divided by the
   determinant. */
static inline PetscReal MatrixCofactors(PetscReal J[3][3], PetscReal C[3][3])
{
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

      C[i][k] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1];
    }
  }
  return VectorDot(J[0], C[0]);
}

#endif
