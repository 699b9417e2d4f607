/*
   Logarithmic strain E = 1/2 ln C with C = F^T F, and the stress and the tangent of an energy that is a function of E.
   The eigenvalues of C are 1 + c_a. In the basis of its eigenvectors, with the divided differences f[] of f(c) =
   1/2 ln(1 + c):
     dE_ab = f[a,b] dC_ab,   d2E_ab(X, Y) = sum_k f[a,k,b] (X_ak Y_kb + Y_ak X_kb)
   (Miehe, Comparison of two algorithms for the computation of fourth-order isotropic tensor functions, 1998).
   Divided differences are continuous where eigenvalues coincide, so that this needs no special case.
*/
#include "materialimpl.h"

/* Makes the entry (p, q) of A zero by a Jacobi rotation, unless it is far below a rounding error. The columns of V
   become the eigenvectors. */
static void LogarithmicRotate(PetscReal A[3][3], PetscReal V[3][3], int p, int q)
{
  const int       r    = 3 - p - q;
  const PetscReal half = (A[q][q] - A[p][p]) / 2, off = A[p][q], small = 1e-18;
  PetscReal       t, c, s;

  A[p][q] = A[q][p] = 0;
  if (off * off <= PetscSqr(small * (PetscAbsReal(A[p][p]) + PetscAbsReal(A[q][q])))) return;
  t = off / (half + (half >= 0 ? 1 : -1) * PetscSqrtReal(half * half + off * off));
  c = 1 / PetscSqrtReal(1 + t * t);
  s = t * c;
  A[p][p] -= t * off;
  A[q][q] += t * off;
  for (int k = 0; k < 3; ++k) {
    const PetscReal x = V[k][p], y = V[k][q];

    V[k][p] = c * x - s * y;
    V[k][q] = s * x + c * y;
  }
  t       = A[r][p];
  A[p][r] = A[r][p] = c * t - s * A[r][q];
  A[q][r] = A[r][q] = s * t + c * A[r][q];
}

void LogarithmicEigen(const PetscReal M[9], PetscReal c[3], PetscReal V[3][3])
{
  PetscReal A[3][3];

  for (int i = 0; i < 9; ++i) {
    A[i / 3][i % 3] = M[i];
    V[i / 3][i % 3] = i % 4 ? 0 : 1;
  }
  for (int sweep = 0; sweep < 12 && (A[0][1] != 0 || A[1][2] != 0 || A[0][2] != 0); ++sweep) {
    LogarithmicRotate(A, V, 0, 1);
    LogarithmicRotate(A, V, 1, 2);
    LogarithmicRotate(A, V, 0, 2);
  }
  for (int a = 0; a < 3; ++a) c[a] = A[a][a];
}

void LogarithmicCompose(const PetscReal value[3], PetscReal V[3][3], PetscReal M[9])
{
  for (int i = 0; i < 9; ++i) {
    M[i] = 0;
    for (int a = 0; a < 3; ++a) M[i] += value[a] * V[i / 3][a] * V[i % 3][a];
  }
}

PetscBool LogarithmicStrain(const PetscReal H[9], Logarithmic *s)
{
  PetscReal M[9], logs[3];

  for (int i = 0; i < 9; ++i) {
    const int p = i / 3, q = i % 3;

    M[i] = H[3 * p + q] + H[3 * q + p] + H[p] * H[q] + H[3 + p] * H[3 + q] + H[6 + p] * H[6 + q];
  }
  LogarithmicEigen(M, s->c, s->V);
  for (int a = 0; a < 3; ++a) {
    if (!(s->c[a] > -1)) return PETSC_FALSE; /* this may happen by rounding if F is almost singular */
    logs[a] = 0.5 * log1p(s->c[a]);
  }
  LogarithmicCompose(logs, s->V, s->E);
  return PETSC_TRUE;
}

/* Computes the divided differences f[a,b] of the eigenvalues */
static void LogarithmicFirst(const PetscReal c[3], PetscReal f[3][3])
{
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      const PetscReal t = (c[b] - c[a]) / (1 + c[a]);

      f[a][b] = f[b][a] = 0.5 * (t == 0 ? 1 : log1p(t) / t) / (1 + c[a]);
    }
  }
}

/* Returns the divided difference f[c1,c2,c3] of eigenvalues that are close to one another, by a Taylor series about
   their mean */
static PetscReal LogarithmicSeries(PetscReal c1, PetscReal c2, PetscReal c3)
{
  const PetscReal mean = (c1 + c2 + c3) / 3, x = c1 - mean, y = c2 - mean, z = c3 - mean, scale = -1 / (1 + mean);
  const PetscReal pairs = x * y + y * z + z * x, product = x * y * z;
  PetscReal       h[3] = {1, 0, 0}, sum = 0, power = -0.5 * scale * scale;

  for (int k = 2; k < 18; ++k) { /* h[0]: sum of all products of k - 2 distances from the mean */
    const PetscReal next = product * h[2] - pairs * h[1];

    sum += power / k * h[0];
    power *= scale;
    h[2] = h[1];
    h[1] = h[0];
    h[0] = next;
  }
  return sum;
}

/* Returns the divided difference f[a,b,d] of three eigenvalues, by their numbers; f: divided differences of two */
static PetscReal LogarithmicSecond(const PetscReal c[3], PetscReal f[3][3], int a, int b, int d)
{
  const PetscReal close    = 0.1;
  int             order[3] = {a, b, d};

  for (int i = 0; i < 3; ++i) { /* sorts */
    const int k = i == 1 ? 1 : 0, low = order[k], high = order[k + 1];

    order[k]     = c[low] <= c[high] ? low : high;
    order[k + 1] = c[low] <= c[high] ? high : low;
  }
  if (c[order[2]] - c[order[0]] <= close * (1 + c[order[0]])) return LogarithmicSeries(c[a], c[b], c[d]);
  return (f[order[1]][order[2]] - f[order[0]][order[1]]) / (c[order[2]] - c[order[0]]);
}

/* Transforms index 0, 1, 2 or 3 of R by the rows of M: R_..j.. = sum_a M_aj R_..a.. */
static void TensorTransform(PetscReal R[81], int index, PetscReal (*M)[3])
{
  static const int strides[4] = {27, 9, 3, 1};
  const int        stride     = strides[index];

  for (PetscReal *block = R; block < R + 81; block += 3 * stride) {
    for (PetscReal *r = block; r < block + stride; ++r) {
      const PetscReal x = r[0], y = r[stride], z = r[2 * stride];

      for (int j = 0; j < 3; ++j) r[j * stride] = M[0][j] * x + M[1][j] * y + M[2][j] * z;
    }
  }
}

/*
   Computes T in the basis of eigenvectors of C (turned), and from it half of the second Piola-Kirchhoff stress S in
   that basis. f: divided differences
*/
static void LogarithmicTurnStress(Logarithmic *s, const PetscReal T[9], PetscReal f[3][3], PetscReal turned[3][3],
  PetscReal half[3][3])
{
  LogarithmicFirst(s->c, f);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      turned[a][b] = 0;
      for (int k = 0; k < 9; ++k) turned[a][b] += s->V[k / 3][a] * T[k] * s->V[k % 3][b];
      half[a][b] = f[a][b] * turned[a][b];
    }
  }
}

/* Computes S = dW/dE : 2 dE/dC in global axes, from half of S in eigenvectors */
static void LogarithmicSecondStress(Logarithmic *s, PetscReal half[3][3], PetscReal S[3][3])
{
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      S[i][j] = 0;
      for (int k = 0; k < 9; ++k) S[i][j] += 2 * s->V[i][k / 3] * half[k / 3][k % 3] * s->V[j][k % 3];
    }
  }
}

void LogarithmicStress(Logarithmic *s, const PetscReal H[9], const PetscReal T[9], PetscReal P[9])
{
  PetscReal f[3][3], turned[3][3], half[3][3], S[3][3];

  LogarithmicTurnStress(s, T, f, turned, half);
  LogarithmicSecondStress(s, half, S);
  for (int i = 0; i < 9; ++i) {
    P[i] = S[i / 3][i % 3];
    for (int k = 0; k < 3; ++k) P[i] += H[3 * (i / 3) + k] * S[k][i % 3];
  }
}

/* Replaces D = d2W/dE dE by d2W/dC dC in the basis of eigenvectors of C */
static void LogarithmicCurvature(Logarithmic *s, PetscReal f[3][3], PetscReal turned[3][3], PetscReal D[81])
{
  for (int index = 0; index < 4; ++index) TensorTransform(D, index, s->V);
  for (int p = 0; p < 9; ++p) {
    for (int q = 0; q < 9; ++q) D[9 * p + q] *= f[p / 3][p % 3] * f[q / 3][q % 3];
  }
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        const PetscReal second = 0.5 * LogarithmicSecond(s->c, f, i, k, j);

        for (int mirror = 0; mirror < (i == j ? 1 : 2); ++mirror) {
          const int       a = mirror ? j : i, b = mirror ? i : j;
          const PetscReal term = turned[a][b] * second;

          D[9 * (3 * a + k) + 3 * k + b] += term;
          D[9 * (3 * k + a) + 3 * k + b] += term;
          D[9 * (3 * a + k) + 3 * b + k] += term;
          D[9 * (3 * k + a) + 3 * b + k] += term;
        }
      }
    }
  }
}

void LogarithmicTangent(Logarithmic *s, const PetscReal H[9], const PetscReal T[9], PetscReal D[81], PetscReal A[81])
{
  PetscReal f[3][3], turned[3][3], half[3][3], S[3][3], along[3][3], back[3][3];

  LogarithmicTurnStress(s, T, f, turned, half);
  LogarithmicSecondStress(s, half, S);
  LogarithmicCurvature(s, f, turned, D);
  for (int a = 0; a < 3; ++a) {
    for (int i = 0; i < 3; ++i) {
      along[a][i] = s->V[i][a];
      for (int k = 0; k < 3; ++k) along[a][i] += H[3 * i + k] * s->V[k][a];
      back[a][i] = s->V[i][a];
    }
  }
  for (int index = 0; index < 4; ++index) TensorTransform(D, index, index % 2 ? along : back);
  for (int p = 0; p < 9; ++p) { /* p = i j and q = k l are indices of A; D has the indices j i and l k */
    for (int q = 0; q < 9; ++q)
      A[9 * p + q] = 4 * D[9 * (3 * (p % 3) + p / 3) + 3 * (q % 3) + q / 3] + (p / 3 == q / 3 ? S[p % 3][q % 3] : 0);
  }
}
