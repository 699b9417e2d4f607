/*
   Products of a matrix with as many directions as there are lanes: LANES values an unknown, side by side. Matrices of
   blocks of 3 x 3 on one rank are then read once for all these directions; those of other types are multiplied by one
   direction after the other. MatMatMult() of PETSc 3.18 is wrong for SBAIJ.
*/
#include "subspaceimpl.h"
#include <lanes.h>

#define PRODUCTS_CHUNK 256 /* unknowns whose values stay in the cache while directions are read */

/* Adds the block v, stored column by column, times x to y */
LANES_INLINE void ProductsAdd(const PetscScalar v[9], const Lanes x[3], Lanes y[3])
{
  for (int i = 0; i < 3; i++) y[i] += v[i] * x[0] + v[3 + i] * x[1] + v[6 + i] * x[2];
}

LANES_INLINE void ProductsLoad(const PetscReal *a, Lanes x[3])
{
  for (int i = 0; i < 3; i++) x[i] = LANES_OF(a + LANES * i);
}

/* Computes Y = K X for n block rows of K. half: only the upper triangle is stored */
AMGF_CLONES static void ProductsOfBlocks(PetscInt n, const PetscInt ia[], const PetscInt ja[], const PetscScalar a[],
  PetscBool half, const PetscReal *X, PetscReal *Y)
{
  for (size_t i = 0; i < (size_t)n * 3 * LANES; i++) Y[i] = 0.0;
  for (PetscInt r = 0; r < n; r++) {
    PetscReal *own = Y + (size_t)r * 3 * LANES;
    Lanes      x[3], y[3], to[3], z[3];

    ProductsLoad(X + (size_t)r * 3 * LANES, z);
    ProductsLoad(own, y);
    for (PetscInt k = ia[r]; k < ia[r + 1]; k++) {
      const PetscScalar *v     = a + 9 * (size_t)k;
      PetscReal         *other = Y + (size_t)ja[k] * 3 * LANES;

      ProductsLoad(X + (size_t)ja[k] * 3 * LANES, x);
      ProductsAdd(v, x, y);
      if (!half || ja[k] == r) continue;
      ProductsLoad(other, to);
      for (int i = 0; i < 3; i++)
        LANES_OF(other + LANES * i) = to[i] + v[3 * i] * z[0] + v[3 * i + 1] * z[1] + v[3 * i + 2] * z[2];
    }
    for (int i = 0; i < 3; i++) LANES_OF(own + LANES * i) = y[i];
  }
}

/* Computes Y = K X for a matrix of blocks of 3 x 3 on one rank. *done: false for other matrices */
static PetscErrorCode ProductsByBlocks(Mat K, const PetscReal *X, PetscReal *Y, PetscBool *done)
{
  const PetscInt *ia, *ja;
  PetscScalar    *a;
  PetscInt        n, bs;
  PetscBool       half, whole;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)K, MATSEQSBAIJ, &half));
  PetscCall(PetscObjectTypeCompare((PetscObject)K, MATSEQBAIJ, &whole));
  PetscCall(MatGetBlockSize(K, &bs));
  *done = (PetscBool)((half || whole) && bs == 3);
  if (!*done) PetscFunctionReturn(0);
  PetscCall(MatGetRowIJ(K, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, done));
  if (!*done) PetscFunctionReturn(0);
  if (half) PetscCall(MatSeqSBAIJGetArray(K, &a));
  else PetscCall(MatSeqBAIJGetArray(K, &a));
  ProductsOfBlocks(n, ia, ja, a, half, X, Y);
  if (half) PetscCall(MatSeqSBAIJRestoreArray(K, &a));
  else PetscCall(MatSeqBAIJRestoreArray(K, &a));
  PetscCall(MatRestoreRowIJ(K, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, done));
  PetscFunctionReturn(0);
}

/* Computes Y = K X. Collective. x, y: work vectors */
PetscErrorCode IPProductsMultiply(Mat K, const PetscReal *X, Vec x, Vec y, PetscReal *Y)
{
  const PetscScalar *from;
  PetscScalar       *to;
  PetscInt           n;
  PetscBool          done;

  PetscFunctionBegin;
  PetscCall(ProductsByBlocks(K, X, Y, &done));
  PetscCall(VecGetLocalSize(x, &n));
  for (PetscInt l = 0; l < LANES && !done; l++) {
    PetscCall(VecGetArrayWrite(x, &to));
    for (PetscInt i = 0; i < n; i++) to[i] = X[(size_t)i * LANES + l];
    PetscCall(VecRestoreArrayWrite(x, &to));
    PetscCall(MatMult(K, x, y));
    PetscCall(VecGetArrayRead(y, &from));
    for (PetscInt i = 0; i < n; i++) Y[(size_t)i * LANES + l] = from[i];
    PetscCall(VecRestoreArrayRead(y, &from));
  }
  PetscFunctionReturn(0);
}

/* Copies k directions of n entries to X, times their sizes. Lanes beyond them are zero. */
AMGF_CLONES void IPProductsSpread(PetscInt n, PetscInt k, float *const p[], const PetscReal size[], PetscReal *X)
{
  for (PetscInt l = 0; l < LANES; l++) {
    for (PetscInt i = 0; i < n; i++) X[(size_t)i * LANES + l] = l < k ? size[l] * p[l][i] : 0.0;
  }
}

/* Computes s[LANES j + l], the dot product of direction j, of k, with the values in lane l of Y, for n entries */
AMGF_CLONES void IPProductsDots(PetscInt n, PetscInt k, float *const p[], const PetscReal *Y, PetscReal s[])
{
  for (PetscInt j = 0; j < LANES * k; j++) s[j] = 0.0;
  for (PetscInt start = 0; start < n; start += PRODUCTS_CHUNK) {
    const PetscInt rows = PetscMin(PRODUCTS_CHUNK, n - start);

    for (PetscInt j = 0; j < k; j++) {
      const float     *d   = p[j] + start;
      const PetscReal *y   = Y + (size_t)start * LANES;
      Lanes            sum = LANES_OF(s + LANES * j), odd = {0};
      PetscInt         i = 0;

      for (; i + 1 < rows; i += 2) {
        sum += (PetscReal)d[i] * LANES_OF(y + LANES * i);
        odd += (PetscReal)d[i + 1] * LANES_OF(y + LANES * (i + 1));
      }
      for (; i < rows; i++) sum += (PetscReal)d[i] * LANES_OF(y + LANES * i);
      LANES_OF(s + LANES * j) = sum + odd;
    }
  }
}
