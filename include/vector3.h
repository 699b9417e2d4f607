/* Vectors and matrices of three components, and the inverse of small matrices. */
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

/* Adds a x b to c */
static inline void VectorAddCross(const PetscReal a[3], const PetscReal b[3], PetscReal c[3])
{
  c[0] += a[1] * b[2] - a[2] * b[1];
  c[1] += a[2] * b[0] - a[0] * b[2];
  c[2] += a[0] * b[1] - a[1] * b[0];
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

/* Computes the inverse of J, and returns the determinant. If it is zero, the inverse is set to zero. */
static inline PetscReal MatrixInvert(PetscReal J[3][3], PetscReal inverse[3][3])
{
  PetscReal       C[3][3];
  const PetscReal det = MatrixCofactors(J, C);

  for (int i = 0; i < 9; ++i) inverse[i / 3][i % 3] = det == 0.0 ? 0.0 : C[i % 3][i / 3] / det;
  return det;
}

/* Solves J x = b by Cramer's rule, and returns the determinant. If it is zero, x is set to zero. */
static inline PetscReal MatrixSolve(PetscReal J[3][3], const PetscReal b[3], PetscReal x[3])
{
  PetscReal       C[3][3];
  const PetscReal det = MatrixCofactors(J, C);

  for (int k = 0; k < 3; ++k) x[k] = det == 0.0 ? 0.0 : (C[0][k] * b[0] + C[1][k] * b[1] + C[2][k] * b[2]) / det;
  return det;
}

/* Computes the inertia tr(S) I - S from S = sum of m r r^T (xx yy zz xy yz zx): sum of m r x (w x r) = inertia w */
static inline void MatrixSetInertia(const PetscReal s[6], PetscReal inertia[3][3])
{
  for (int i = 0; i < 3; ++i) inertia[i][i] = s[(i + 1) % 3] + s[(i + 2) % 3];
  inertia[0][1] = inertia[1][0] = -s[3];
  inertia[1][2] = inertia[2][1] = -s[4];
  inertia[2][0] = inertia[0][2] = -s[5];
}

  #define MATRIX_MAX_ORDER 6 /* largest order of a matrix that MatrixInvertInPlace() inverts */

/*
   Inverts an n x n matrix in place by Gauss-Jordan elimination with row pivoting. Row i begins at a[stride i]. Returns
   false if the matrix is singular.
*/
static inline PetscBool MatrixInvertInPlace(PetscInt n, PetscInt stride, PetscReal a[])
{
  PetscInt pivot[MATRIX_MAX_ORDER];

  for (PetscInt k = 0; k < n; ++k) {
    PetscInt  p = k;
    PetscReal scale;

    for (PetscInt i = k + 1; i < n; ++i) p = PetscAbsReal(a[stride * i + k]) > PetscAbsReal(a[stride * p + k]) ? i : p;
    pivot[k] = p;
    scale    = a[stride * p + k];
    if (!(PetscAbsReal(scale) > 0.0)) return PETSC_FALSE;
    a[stride * p + k] = 1.0;
    for (PetscInt j = 0; j < n; ++j) {
      const PetscReal entry = a[stride * p + j] / scale;

      a[stride * p + j] = a[stride * k + j];
      a[stride * k + j] = entry;
    }
    for (PetscInt i = 0; i < n; ++i) {
      const PetscReal factor = a[stride * i + k];

      if (i == k) continue;
      a[stride * i + k] = 0.0;
      for (PetscInt j = 0; j < n; ++j) a[stride * i + j] -= factor * a[stride * k + j];
    }
  }
  for (PetscInt k = n - 1; k >= 0; --k) {
    for (PetscInt i = 0; pivot[k] != k && i < n; ++i) {
      const PetscReal swap = a[stride * i + k];

      a[stride * i + k]        = a[stride * i + pivot[k]];
      a[stride * i + pivot[k]] = swap;
    }
  }
  return PETSC_TRUE;
}

#endif
