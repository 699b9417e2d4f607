/*
   Algebra of the second-order cone {(a, b): |b| <= a} of three dimensions: its Jordan product, the scaling of Nesterov
   and Todd, and the longest step inside it (Nesterov and Todd, Self-scaled barriers and interior-point methods for
   convex programming, 1997; Vandenberghe, The CVXOPT linear and quadratic cone program solvers, 2010)
*/
#include "conesimpl.h"

/* Returns a_0^2 - a_1^2 - a_2^2, without the cancellation of its terms */
static PetscReal ConeDeterminant(const PetscReal a[3])
{
  const PetscReal b = PetscSqrtReal(a[1] * a[1] + a[2] * a[2]);

  return (a[0] - b) * (a[0] + b);
}

static PetscReal ConePositive(PetscReal a)
{
  return PetscMax(a, 1e-300);
}

/* Computes y = A x for a matrix in rows */
void ConeMultiply(const PetscReal A[9], const PetscReal x[3], PetscReal y[3])
{
  for (PetscInt r = 0; r < 3; r++) y[r] = A[3 * r] * x[0] + A[3 * r + 1] * x[1] + A[3 * r + 2] * x[2];
}

/* Computes the Jordan product (a^T b, a_0 b_1 + b_0 a_1, a_0 b_2 + b_0 a_2) */
void ConeProduct(const PetscReal a[3], const PetscReal b[3], PetscReal product[3])
{
  const PetscReal first = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

  for (PetscInt r = 1; r < 3; r++) product[r] = a[0] * b[r] + b[0] * a[r];
  product[0] = first;
}

/* Computes the quotient with ConeProduct(a, quotient) = b */
void ConeDivide(const PetscReal a[3], const PetscReal b[3], PetscReal quotient[3])
{
  const PetscReal d = ConePositive(ConeDeterminant(a)), dot = a[1] * b[1] + a[2] * b[2];

  for (PetscInt r = 1; r < 3; r++) quotient[r] = (-a[r] * b[0] + (d * b[r] + a[r] * dot) / a[0]) / d;
  quotient[0] = (a[0] * b[0] - dot) / d;
}

/* Computes the symmetric scaling W of two points in the cone, with W f = W^-1 y, and its inverse */
void ConeScaling(const PetscReal y[3], const PetscReal f[3], PetscReal W[9], PetscReal inverse[9])
{
  const PetscReal mirror[3] = {1.0, -1.0, -1.0};
  const PetscReal dy        = PetscSqrtReal(ConePositive(ConeDeterminant(y))),
                  df        = PetscSqrtReal(ConePositive(ConeDeterminant(f)));
  PetscReal dot             = 0.0, gamma, beta, v[3], first;

  for (PetscInt r = 0; r < 3; r++) dot += y[r] / dy * f[r] / df;
  gamma = PetscSqrtReal(ConePositive(0.5 * (1.0 + dot)));
  for (PetscInt r = 0; r < 3; r++) v[r] = (y[r] / dy + mirror[r] * f[r] / df) / (2.0 * gamma);
  v[0] += 1.0;
  first = PetscSqrtReal(2.0 * v[0]);
  beta  = PetscSqrtReal(dy / df);
  for (PetscInt r = 0; r < 3; r++) v[r] /= first;
  for (PetscInt r = 0; r < 3; r++) {
    for (PetscInt c = 0; c < 3; c++) {
      const PetscReal diagonal = r == c ? mirror[r] : 0.0;

      W[3 * r + c]       = beta * (2.0 * v[r] * v[c] - diagonal);
      inverse[3 * r + c] = (2.0 * mirror[r] * v[r] * mirror[c] * v[c] - diagonal) / beta;
    }
  }
}

/* Computes W W for a symmetric W */
void ConeSquare(const PetscReal W[9], PetscReal square[9])
{
  for (PetscInt c = 0; c < 3; c++) {
    PetscReal column[3];

    ConeMultiply(W, &W[3 * c], column);
    for (PetscInt r = 0; r < 3; r++) square[3 * r + c] = column[r];
  }
}

/* Inverts the last n rows and columns of a matrix, n = 2 or 3. Returns false if it is singular. */
PetscBool ConeInvert(PetscInt n, const PetscReal A[9], PetscReal inverse[9])
{
  PetscReal cofactor[9], det = 0.0;

  if (n == 2) {
    det = A[4] * A[8] - A[5] * A[7];
    if (det == 0.0 || PetscIsInfOrNanReal(det)) return PETSC_FALSE;
    for (PetscInt r = 0; r < 9; r++) inverse[r] = 0.0;
    inverse[4] = A[8] / det;
    inverse[5] = -A[5] / det;
    inverse[7] = -A[7] / det;
    inverse[8] = A[4] / det;
    return PETSC_TRUE;
  }
  for (PetscInt r = 0; r < 3; r++) {
    for (PetscInt c = 0; c < 3; c++) {
      const PetscInt r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;

      cofactor[3 * r + c] = A[3 * r1 + c1] * A[3 * r2 + c2] - A[3 * r1 + c2] * A[3 * r2 + c1];
    }
  }
  for (PetscInt c = 0; c < 3; c++) det += A[c] * cofactor[c];
  if (det == 0.0 || PetscIsInfOrNanReal(det)) return PETSC_FALSE;
  for (PetscInt r = 0; r < 3; r++) {
    for (PetscInt c = 0; c < 3; c++) inverse[3 * r + c] = cofactor[3 * c + r] / det;
  }
  return PETSC_TRUE;
}

/* Returns the largest t for which a + t da is in the cone, where a is; infinity if there is none */
PetscReal ConeLongestStep(const PetscReal a[3], const PetscReal da[3])
{
  const PetscReal A = ConeDeterminant(da), B = a[0] * da[0] - a[1] * da[1] - a[2] * da[2], C = ConeDeterminant(a),
                  square = B * B - A * C;
  PetscReal t            = PETSC_INFINITY;

  if (da[0] < 0.0) t = -a[0] / da[0];
  if (square >= 0.0) {
    const PetscReal root = PetscSqrtReal(square);

    for (PetscInt k = -1; k <= 1; k += 2) {
      const PetscReal below = -B + k * root, end = below != 0.0 ? C / below : -1.0;

      if (end > 0.0) t = PetscMin(t, end);
    }
  }
  return t;
}
