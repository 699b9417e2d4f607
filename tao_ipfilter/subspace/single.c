/*
   Arithmetic with the directions, which are stored in single precision. Results are accumulated in double precision.
   Memory traffic determines the time: each function reads the directions once.
*/
#include "subspaceimpl.h"
#include "pc_amgf/clones.h"

#define SINGLE_LANES 8    /* partial sums of a dot product, one per lane of a vector register */
#define SINGLE_CHUNK 4096 /* entries of a vector that stay in the cache while all directions are read */

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

/* Computes s_j = p_j^T v for k directions of n entries */
AMGF_CLONES void IPSingleDots(PetscInt n, PetscInt k, float *const p[], const PetscScalar *v, PetscReal s[])
{
  for (PetscInt j = 0; j < k; j++) s[j] = 0.0;
  for (PetscInt start = 0; start < n; start += SINGLE_CHUNK) {
    const PetscInt rows = PetscMin(SINGLE_CHUNK, n - start);

    for (PetscInt j = 0; j < k; j++) s[j] += SingleDot(rows, p[j] + start, v + start);
  }
}

/* Adds sum_j a_j p_j to v, for k directions of n entries */
AMGF_CLONES void IPSingleCombine(PetscInt n, PetscInt k, const PetscReal a[], float *const p[], PetscScalar *v)
{
  for (PetscInt start = 0; start < n; start += SINGLE_CHUNK) {
    const PetscInt rows = PetscMin(SINGLE_CHUNK, n - start);

    for (PetscInt j = 0; j < k; j++) {
      for (PetscInt i = 0; i < rows; i++) v[start + i] += a[j] * p[j][start + i];
    }
  }
}
