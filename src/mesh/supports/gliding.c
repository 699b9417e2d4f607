/*
   Motions in which a body glides along the surfaces of its frictionless contact pairs, such as the rotation of a pin
   about its axis. The pairs do not resist them. The normals of the facets deviate from those of the surface, so that
   unstructured meshes seem to resist.
*/
#include "supportsimpl.h"
#include <vector3.h>

#define SUPPORT_MODES 6 /* modes of one body */

/*
   Mean square of the velocity in the restrained directions over the mean square of the velocity on the contact faces,
   below which a motion glides. It is 0.008 for a rotating prism of 12 sides divided into triangles, the coarsest
   surface without sharp edges, and 0.034 for a regular decagon.
*/
static const PetscReal gliding_resistance = 0.015;

/* least variance of the velocity of a rotation, over its mean square; a shallow arc moves almost as in a translation */
static const PetscReal rotation_spread = 0.1;

/* Columns of T: the modes of body a in which all points move as in the modes of body b */
static void SupportTransform(const Support *support, PetscInt a, PetscInt b, PetscReal T[SUPPORT_MODES][SUPPORT_MODES])
{
  PetscReal way[3];

  for (PetscInt d = 0; d < 3; ++d) way[d] = (support->center[a][d] - support->center[b][d]) / support->size[b];
  for (PetscInt i = 0; i < SUPPORT_MODES; ++i) {
    for (PetscInt j = 0; j < SUPPORT_MODES; ++j)
      T[i][j] = i == j ? (i < 3 ? 1 : support->size[a] / support->size[b]) : 0;
  }
  for (PetscInt j = 0; j < 3; ++j) {
    const PetscReal axis[3] = {j == 0, j == 1, j == 2};
    PetscReal       shift[3];

    VectorCross(axis, way, shift);
    for (PetscInt d = 0; d < 3; ++d) T[d][3 + j] = shift[d];
  }
}

/* Replaces A, symmetric, by L^-1 A L^-T, and M, positive definite, by its Cholesky factor L. False if M is singular. */
static PetscBool SupportReduce(PetscReal A[SUPPORT_MODES][SUPPORT_MODES], PetscReal M[SUPPORT_MODES][SUPPORT_MODES])
{
  for (PetscInt j = 0; j < SUPPORT_MODES; ++j) {
    const PetscReal full = M[j][j];

    for (PetscInt k = 0; k < j; ++k) M[j][j] -= PetscSqr(M[j][k]);
    if (!(M[j][j] > 1e-12 * full)) return PETSC_FALSE;
    M[j][j] = PetscSqrtReal(M[j][j]);
    for (PetscInt i = j + 1; i < SUPPORT_MODES; ++i) {
      for (PetscInt k = 0; k < j; ++k) M[i][j] -= M[i][k] * M[j][k];
      M[i][j] /= M[j][j];
    }
  }
  for (int side = 0; side < 2; ++side) { /* A = L^-1 A, transposed, twice */
    PetscReal B[SUPPORT_MODES][SUPPORT_MODES];

    for (PetscInt c = 0; c < SUPPORT_MODES; ++c) {
      for (PetscInt i = 0; i < SUPPORT_MODES; ++i) {
        B[c][i] = A[i][c];
        for (PetscInt k = 0; k < i; ++k) B[c][i] -= M[i][k] * B[c][k];
        B[c][i] /= M[i][i];
      }
    }
    for (PetscInt k = 0; k < SUPPORT_MODES * SUPPORT_MODES; ++k)
      A[k / SUPPORT_MODES][k % SUPPORT_MODES] = B[k / SUPPORT_MODES][k % SUPPORT_MODES];
  }
  return PETSC_TRUE;
}

/* Diagonalizes A, symmetric, by Jacobi's rotations. The columns of V become the eigenvectors. */
static void SupportDiagonalize(PetscReal A[SUPPORT_MODES][SUPPORT_MODES], PetscReal V[SUPPORT_MODES][SUPPORT_MODES])
{
  const PetscInt n = SUPPORT_MODES, sweeps = 30;

  for (PetscInt k = 0; k < n * n; ++k) V[k / n][k % n] = k / n == k % n;
  for (PetscInt s = 0; s < sweeps * n * n; ++s) {
    const PetscInt  p = (s / n) % n, q = s % n;
    const PetscReal twice = 2 * A[p][q], angle = 0.5 * PetscAtan2Real(twice, A[q][q] - A[p][p]);
    const PetscReal c = PetscCosReal(angle), t = PetscSinReal(angle);

    if (p >= q || twice == 0) continue;
    for (PetscInt i = 0; i < n; ++i) {
      const PetscReal a = A[i][p], v = V[i][p];

      A[i][p] = c * a - t * A[i][q];
      A[i][q] = t * a + c * A[i][q];
      V[i][p] = c * v - t * V[i][q];
      V[i][q] = t * v + c * V[i][q];
    }
    for (PetscInt i = 0; i < n; ++i) {
      const PetscReal a = A[p][i];

      A[p][i] = c * a - t * A[q][i];
      A[q][i] = t * a + c * A[q][i];
    }
  }
}

/* Adds the square matrix T^T A T to B */
static void SupportAddTransformed(PetscReal T[SUPPORT_MODES][SUPPORT_MODES], const PetscReal A[], PetscReal B[])
{
  const PetscInt n                                  = SUPPORT_MODES;
  PetscReal      half[SUPPORT_MODES][SUPPORT_MODES] = {{0}};

  for (PetscInt i = 0; i < n; ++i) {
    for (PetscInt j = 0; j < n; ++j) {
      for (PetscInt k = 0; k < n; ++k) half[i][j] += A[i * n + k] * T[k][j];
    }
  }
  for (PetscInt i = 0; i < n; ++i) {
    for (PetscInt j = 0; j < n; ++j) {
      for (PetscInt k = 0; k < n; ++k) B[i * n + j] += T[k][i] * half[k][j];
    }
  }
}

/* Returns the variance of the velocity of a motion over its mean square: 0 for a translation, 1 for the rotation of a
   whole round face about its axis */
static PetscReal SupportGetSpread(const PetscReal motion[], const PetscReal moved[SUPPORT_MODES])
{
  PetscReal momentum[SUPPORT_MODES] = {0}, square = 0;

  for (PetscInt k = 0; k < SUPPORT_MODES * SUPPORT_MODES; ++k)
    momentum[k / SUPPORT_MODES] += motion[k] * moved[k % SUPPORT_MODES];
  for (PetscInt i = 0; i < SUPPORT_MODES; ++i) square += momentum[i] * moved[i];
  return square > 0 ? 1 - VectorDot(momentum, momentum) / (motion[0] * square) : 0;
}

/* Describes the rotation among n gliding motions of body b, which are the rows of y */
static void SupportDescribeRotation(const Support *support, PetscInt b, const PetscReal motion[], PetscInt n,
  PetscReal y[SUPPORT_MODES][SUPPORT_MODES], MeshRotation *rotation)
{
  PetscReal turn[3][3] = {{0}}, moved[SUPPORT_MODES] = {0}, c[SUPPORT_MODES] = {0}, arm[3], size, other = 0;
  PetscInt  most = 0;

  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt i = 0; i < 9; ++i) turn[i / 3][i % 3] += y[k][3 + i / 3] * y[k][3 + i % 3];
  }
  /* the rotation about the axis of `turn` that turns most, by a few steps of the power method */
  for (PetscInt d = 1; d < 3; ++d) most = turn[d][d] > turn[most][most] ? d : most;
  for (PetscInt d = 0; d < 3; ++d) rotation->axis[d] = turn[most][d];
  for (int step = 0; step < 20; ++step) {
    PetscReal next[3];

    (void)VectorScaleToUnit(rotation->axis);
    for (PetscInt d = 0; d < 3; ++d) next[d] = VectorDot(turn[d], rotation->axis);
    for (PetscInt d = 0; d < 3; ++d) rotation->axis[d] = next[d];
  }
  size = VectorScaleToUnit(rotation->axis);
  for (PetscInt d = 0; d < 3; ++d) other += turn[d][d];
  other -= size;
  rotation->any = (PetscBool)(other > 0.1 * size);
  for (PetscInt k = 0; k < n; ++k) c[k] = VectorDot(y[k] + 3, rotation->axis);
  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt i = 0; i < SUPPORT_MODES; ++i) moved[i] += c[k] * y[k][i];
  }
  VectorCross(moved + 3, moved, arm);
  size           = VectorDot(moved + 3, moved + 3);
  rotation->free = (PetscBool)(size > 0 && SupportGetSpread(motion, moved) > rotation_spread);
  rotation->size = support->size[b];
  for (PetscInt d = 0; d < 3 && rotation->free; ++d)
    rotation->point[d] = support->center[b][d] + support->size[b] * arm[d] / size;
}

/* Returns the quadratic form of a 6 x 6 matrix for a translation */
static PetscReal SupportGetResistance(const PetscReal matrix[], const PetscReal t[3])
{
  PetscReal sum = 0;

  for (PetscInt k = 0; k < 9; ++k) sum += t[k / 3] * matrix[SUPPORT_MODES * (k / 3) + k % 3] * t[k % 3];
  return sum;
}

/* Finds the gliding motions of body b. normal, motion: 6 x 6 matrices of its restraints and of its velocities */
static void SupportFindGlidingOf(const Support *support, PetscInt b, const PetscReal normal[], const PetscReal motion[],
  PetscBool *glides, MeshRotation *rotation)
{
  const PetscInt  n       = SUPPORT_MODES;
  const PetscReal regular = 1e-6; /* keeps the matrix of velocities on a point or a line positive definite */
  PetscReal       A[SUPPORT_MODES][SUPPORT_MODES], L[SUPPORT_MODES][SUPPORT_MODES], V[SUPPORT_MODES][SUPPORT_MODES];
  PetscReal       y[SUPPORT_MODES][SUPPORT_MODES];
  PetscInt        nfound = 0;

  for (PetscInt k = 0; k < n * n; ++k) {
    A[k / n][k % n] = normal[k];
    L[k / n][k % n] = motion[k] + (k / n == k % n ? regular * motion[0] : 0);
  }
  if (!SupportReduce(A, L)) return;
  SupportDiagonalize(A, V);
  for (PetscInt k = 0; k < n; ++k) {
    if (A[k][k] >= gliding_resistance) continue;
    for (PetscInt i = n - 1; i >= 0; --i) { /* y = L^-T v */
      y[nfound][i] = V[i][k];
      for (PetscInt j = i + 1; j < n; ++j) y[nfound][i] -= L[j][i] * y[nfound][j];
      y[nfound][i] /= L[i][i];
    }
    ++nfound;
  }
  *glides = (PetscBool)(nfound > 0);
  if (!nfound) return;
  SupportDescribeRotation(support, b, motion, nfound, y, rotation);
  rotation->slides = (PetscBool)(!rotation->any && SupportGetResistance(normal, rotation->axis) <
                                                     gliding_resistance * SupportGetResistance(motion, rotation->axis));
  /* among translations along other directions no rotation stands out */
  if (nfound != (rotation->any ? 3 : (rotation->slides ? 2 : 1))) rotation->free = PETSC_FALSE;
}

/*
   Finds the bodies that can glide if all others are held. glides[b]: whether body b can; rotations[b]: its rotation
   without resistance, if it has one. Call it after the sum over the ranks.
*/
PetscErrorCode SupportFindGliding(const Support *support, PetscBool glides[], MeshRotation rotations[])
{
  const PetscInt n = SUPPORT_MODES;
  PetscReal(*normal)[36], (*motion)[36], T[SUPPORT_MODES][SUPPORT_MODES];

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(support->nbodies, &normal, support->nbodies, &motion));
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    const PetscInt *body = support->links[l].body;

    for (PetscInt end = 0; end < 2 && body[end] >= 0; ++end) {
      for (PetscInt k = 0; k < n * n; ++k)
        normal[body[end]][k] += support->gram[l][(n * end + k / n) * SUPPORT_BLOCK + n * end + k % n];
      SupportTransform(support, body[0], body[end], T);
      SupportAddTransformed(T, support->motion[l], motion[body[end]]);
    }
  }
  for (PetscInt b = 0; b < support->nbodies; ++b) {
    glides[b]    = PETSC_FALSE;
    rotations[b] = (MeshRotation){PETSC_FALSE};
    if (motion[b][0] > 0) SupportFindGlidingOf(support, b, normal[b], motion[b], &glides[b], &rotations[b]);
  }
  PetscCall(PetscFree2(normal, motion));
  PetscFunctionReturn(0);
}
