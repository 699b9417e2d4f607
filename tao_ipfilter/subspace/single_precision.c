/*
   Arithmetic with the directions, which are stored in single precision. Results are accumulated in double precision.
   Memory traffic determines the time: each function reads the directions once.
*/
#include "subspaceimpl.h"
#include <clones.h>

#define SINGLE_LANES 8    /* partial sums of a dot product, one per lane of a vector register */
#define SINGLE_CHUNK 1024 /* entries of a vector that stay in the cache while all directions are read */
#define SINGLE_GROUP 4 /* directions that are read together, so that each entry of the vector is read once for them */

/* Computes p = v / size in single precision */
AMGF_CLONES void IPSingleRound(PetscInt n, const PetscScalar *v, PetscReal size, float *p)
{
  const PetscReal inverse = 1.0 / size, least = 1e-30; /* smaller numbers become zero: denormal numbers are slow */

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal x = v[i] * inverse;

    p[i] = x > least || x < -least ? (float)x : 0.0f;
  }
}

/* Returns the dot product of p and v */
static inline PetscReal SingleDot(PetscInt n, const float *p, const PetscScalar *v)
{
  PetscReal part[SINGLE_LANES] = {0.0}, sum = 0.0;
  PetscInt  i = 0;

  for (; i + SINGLE_LANES <= n; i += SINGLE_LANES) {
    for (PetscInt l = 0; l < SINGLE_LANES; l++) part[l] += p[i + l] * v[i + l];
  }
  for (; i < n; i++) sum += p[i] * v[i];
  for (PetscInt l = 0; l < SINGLE_LANES; l++) sum += part[l];
  return sum;
}

/* Adds the dot products of SINGLE_GROUP directions with v to s. p: the directions; they are read from `start` on */
static inline void SingleDotGroup(PetscInt n, PetscInt start, float *const p[], const PetscScalar *restrict v,
  PetscReal s[])
{
  const float *restrict p0 = p[0] + start, *restrict p1 = p[1] + start, *restrict p2 = p[2] + start,
                        *restrict p3         = p[3] + start;
  PetscReal part[SINGLE_GROUP][SINGLE_LANES] = {{0.0}};
  PetscInt  i                                = 0;

  for (; i + SINGLE_LANES <= n; i += SINGLE_LANES) {
    for (PetscInt l = 0; l < SINGLE_LANES; l++) {
      part[0][l] += p0[i + l] * v[i + l];
      part[1][l] += p1[i + l] * v[i + l];
      part[2][l] += p2[i + l] * v[i + l];
      part[3][l] += p3[i + l] * v[i + l];
    }
  }
  for (; i < n; i++) {
    part[0][0] += p0[i] * v[i];
    part[1][0] += p1[i] * v[i];
    part[2][0] += p2[i] * v[i];
    part[3][0] += p3[i] * v[i];
  }
  for (PetscInt j = 0; j < SINGLE_GROUP; j++) {
    for (PetscInt l = 0; l < SINGLE_LANES; l++) s[j] += part[j][l];
  }
}

/* Computes s_j = p_j^T v for k directions of n entries */
AMGF_CLONES void IPSingleDots(PetscInt n, PetscInt k, float *const p[], const PetscScalar *v, PetscReal s[])
{
  for (PetscInt j = 0; j < k; j++) s[j] = 0.0;
  for (PetscInt start = 0; start < n; start += SINGLE_CHUNK) {
    const PetscInt rows = PetscMin(SINGLE_CHUNK, n - start);
    PetscInt       j    = 0;

    for (; j + SINGLE_GROUP <= k; j += SINGLE_GROUP) SingleDotGroup(rows, start, p + j, v + start, s + j);
    for (; j < k; j++) s[j] += SingleDot(rows, p[j] + start, v + start);
  }
}

/* Adds the sum of a_j p_j over SINGLE_GROUP directions to v. p: the directions; they are read from `start` on */
static inline void SingleCombineGroup(PetscInt n, PetscInt start, const PetscReal a[], float *const p[],
  PetscScalar *restrict v)
{
  const float *restrict p0 = p[0] + start, *restrict p1 = p[1] + start, *restrict p2 = p[2] + start,
                        *restrict p3 = p[3] + start;
  const PetscReal a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3];

  for (PetscInt i = 0; i < n; i++) v[i] += (a0 * p0[i] + a1 * p1[i]) + (a2 * p2[i] + a3 * p3[i]);
}

/* Adds sum_j a_j p_j to v, for k directions of n entries */
AMGF_CLONES void IPSingleCombine(PetscInt n, PetscInt k, const PetscReal a[], float *const p[], PetscScalar *v)
{
  for (PetscInt start = 0; start < n; start += SINGLE_CHUNK) {
    const PetscInt rows = PetscMin(SINGLE_CHUNK, n - start);
    PetscInt       j    = 0;

    for (; j + SINGLE_GROUP <= k; j += SINGLE_GROUP) SingleCombineGroup(rows, start, a + j, p + j, v + start);
    for (; j < k; j++) {
      for (PetscInt i = 0; i < rows; i++) v[start + i] += a[j] * p[j][start + i];
    }
  }
}
