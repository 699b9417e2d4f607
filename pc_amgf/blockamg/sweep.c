/*
   Arithmetic of the cycle on this rank, in single precision: interpolation, and sweeps. A sweep also computes L^T x for
   the residual, so that each row of L is read from memory once.
*/
#include "blockamgimpl.h"
#include "vec4.h"

/* Adds the entries of stiff unknowns to the product of block row i with x */
static Vec4 RowAddContrast(const BlockLevel *l, int i, const float x[], Vec4 product)
{
  float y[4];

  Vec4Store(y, product);
  BlockContrastMultiplyRow_Private(&l->contrast, i, x, y);
  return Vec4Load(y);
}

/*
   Returns sum_j L_ij x_j for block row i. A row of L is a row of integers times its unit. step: 1 to read the blocks
   upwards, -1 downwards
*/
VEC4_INLINE Vec4 RowMultiply(const BlockLevel *l, int i, const float x[], const int B, const int step)
{
  const int            k0 = l->ptr[i], k1 = l->ptr[i + 1], first = step > 0 ? k0 : k1 - 1, end = step > 0 ? k1 : k0 - 1;
  const int16_t *const L    = l->L;
  const int *const     col  = l->col;
  const Vec4           zero = Vec4Same(0.0f);
  Vec4                 a[4] = {zero, zero, zero, zero};
  Vec8                 a02 = Vec8Join(zero, zero), a13 = a02;

  for (int k = first; k != end; k += step) {
    const Vec4 xj = Vec4Load(x + col[k]);
    Vec8       v02, v13;

    Vec8LoadShorts(L + 4 * B * (size_t)k, &v02, &v13);
    a02 = Vec8MultiplyAdd(a02, v02, Vec8Join(xj, xj));
    if (B == 4) a13 = Vec8MultiplyAdd(a13, v13, Vec8Join(xj, xj));
    else a[1] = Vec4MultiplyAdd(a[1], Vec8Low(v13), xj);
  }
  a[0] = Vec8Low(a02);
  a[2] = Vec8High(a02);
  if (B == 4) {
    a[1] = Vec8Low(a13);
    a[3] = Vec8High(a13);
  }
  a[0] = Vec4Multiply(Vec4Load(l->unit + 4 * (size_t)i), Vec4Sums(a));
  return l->contrast.ptr ? RowAddContrast(l, i, x, a[0]) : a[0];
}

/*
   Processes block row i of a sweep: x_i = W^T W (f - sum_j L_ij x_j), and then t_j += L_ij^T x_i. f: right-hand side of
   the row. step: 1 for a forward, -1 for a backward sweep. Blocks are read in this direction, since processors prefetch
   memory that is read in one direction. For B = 3 the fourth entry of x_i is zero and the fourth entry of t_j is
   unused.
*/
VEC4_INLINE void SweepRow(const BlockLevel *l, int i, Vec4 f, const int B, const int step)
{
  const int            k0 = l->ptr[i], k1 = l->ptr[i + 1];
  const float *const   W   = l->W + 4 * B * (size_t)i;
  const int16_t *const L   = l->L;
  const int *const     col = l->col;
  float *const x = l->x, *const t = l->t;
  const Vec4 zero = Vec4Same(0.0f);
  Vec4       a[4] = {zero, zero, zero, zero}, y = zero, xi;
  Vec8       x02, x13;

  f = Vec4Subtract(f, RowMultiply(l, i, x, B, step));
  for (int c = 0; c < B; c++) y = Vec4MultiplyAdd(y, Vec4Load(W + 4 * c), Vec4Same(Vec4Get(f, c)));
  for (int c = 0; c < B; c++) a[c] = Vec4Multiply(Vec4Load(W + 4 * c), y);
  xi = Vec4Sums(a);
  Vec4Store(x + 4 * (size_t)i, xi);
  xi  = Vec4Multiply(Vec4Load(l->unit + 4 * (size_t)i), xi);
  x02 = Vec8Join(Vec4Same(Vec4Get(xi, 0)), Vec4Same(Vec4Get(xi, 2)));
  x13 = Vec8Join(Vec4Same(Vec4Get(xi, 1)), Vec4Same(Vec4Get(xi, 3)));
  for (int k = k0; k < k1; k++) { /* the second pass reads the row from the cache */
    Vec8 v02, v13;
    Vec4 tj = Vec4Load(t + col[k]);

    Vec8LoadShorts(L + 4 * B * (size_t)k, &v02, &v13);
    v02 = Vec8Multiply(v02, x02);
    if (B == 4) v02 = Vec8MultiplyAdd(v02, v13, x13);
    else tj = Vec4MultiplyAdd(tj, Vec8Low(v13), Vec8Low(x13));
    Vec4Store(t + col[k], Vec4Add(tj, Vec4Add(Vec8Low(v02), Vec8High(v02))));
  }
  if (l->contrast.ptr) BlockContrastTransposeRow_Private(&l->contrast, i, x, t);
}

AMGF_CLONES static void SweepDown3(const BlockLevel *l)
{
  for (int i = 0; i < l->nb; i++) SweepRow(l, i, Vec4Load(l->b + 4 * (size_t)i), 3, 1);
}

AMGF_CLONES static void SweepDown4(const BlockLevel *l)
{
  for (int i = 0; i < l->nb; i++) SweepRow(l, i, Vec4Load(l->b + 4 * (size_t)i), 4, 1);
}

AMGF_CLONES static void SweepUp3(const BlockLevel *l)
{
  for (int i = l->nb - 1; i >= 0; i--)
    SweepRow(l, i, Vec4Subtract(Vec4Load(l->b + 4 * (size_t)i), Vec4Load(l->t + 4 * (size_t)i)), 3, -1);
}

AMGF_CLONES static void SweepUp4(const BlockLevel *l)
{
  for (int i = l->nb - 1; i >= 0; i--)
    SweepRow(l, i, Vec4Subtract(Vec4Load(l->b + 4 * (size_t)i), Vec4Load(l->t + 4 * (size_t)i)), 4, -1);
}

/* BlockSweepDown_Private - computes x = (L + D)^-1 b and t = L^T x */
void BlockSweepDown_Private(const BlockLevel *l)
{
  if (l->nb) memset(l->t, 0, 4 * sizeof(float) * (size_t)l->nb);
  if (l->B == 3) SweepDown3(l);
  else SweepDown4(l);
}

/* BlockSweepUp_Private - computes x = (D + L^T)^-1 (b - L x) */
void BlockSweepUp_Private(const BlockLevel *l)
{
  if (l->nb) memset(l->t, 0, 4 * sizeof(float) * (size_t)l->nb);
  if (l->B == 3) SweepUp3(l);
  else SweepUp4(l);
}

AMGF_CLONES static void MultiplyLower3(const BlockLevel *l, const float v[], float y[])
{
  for (int i = 0; i < l->nb; i++)
    Vec4Store(y + 4 * (size_t)i, Vec4Add(Vec4Load(y + 4 * (size_t)i), RowMultiply(l, i, v, 3, 1)));
}

AMGF_CLONES static void MultiplyLower4(const BlockLevel *l, const float v[], float y[])
{
  for (int i = 0; i < l->nb; i++)
    Vec4Store(y + 4 * (size_t)i, Vec4Add(Vec4Load(y + 4 * (size_t)i), RowMultiply(l, i, v, 4, 1)));
}

/* BlockMultiplyLower_Private - computes y += L v */
void BlockMultiplyLower_Private(const BlockLevel *l, const float v[], float y[])
{
  if (l->B == 3) MultiplyLower3(l, v, y);
  else MultiplyLower4(l, v, y);
}

/* BlockRestrict_Private - subtracts P^T t from coarse, including the ghosts of coarse */
AMGF_CLONES void BlockRestrict_Private(const BlockLevel *l, float coarse[])
{
  const BlockInterpolation *P = &l->P;

  for (int i = 0; i < 4 * l->nb; i++) {
    const float t = l->t[i];

    for (int k = P->ptr[i]; k < P->ptr[i + 1]; k++) coarse[P->col[k]] -= P->val[k] * t;
  }
}

/* BlockInterpolateAdd_Private - adds P coarse to x; the ghosts of coarse must be up to date */
AMGF_CLONES void BlockInterpolateAdd_Private(const BlockLevel *l, const float coarse[])
{
  const BlockInterpolation *P = &l->P;

  for (int i = 0; i < 4 * l->nb; i++) {
    float s = 0.0f;

    for (int k = P->ptr[i]; k < P->ptr[i + 1]; k++) s += P->val[k] * coarse[P->col[k]];
    l->x[i] += s;
  }
}

/* BlockDenseMultiply_Private - computes entries first, ..., first + n - 1 of the product W^T W b, where W is N x N */
AMGF_CLONES void BlockDenseMultiply_Private(int N, const float W[], const float b[], int first, int n, float x[])
{
  for (int i = 0; i < n; i++) x[i] = 0.0f;
  for (int k = 0; k < N; k++) {
    const float *row = W + (size_t)N * k, *own = row + first;
    Vec4         s[4] = {Vec4Same(0.0f), Vec4Same(0.0f), Vec4Same(0.0f), Vec4Same(0.0f)};
    float        y    = 0.0f;
    int          j    = 0;

    for (; j + 16 <= N; j += 16) {
      for (int m = 0; m < 4; m++) s[m] = Vec4MultiplyAdd(s[m], Vec4Load(row + j + 4 * m), Vec4Load(b + j + 4 * m));
    }
    for (; j < N; j++) y += row[j] * b[j];
    s[0] = Vec4Sums(s);
    for (int m = 0; m < 4; m++) y += Vec4Get(s[0], m);
    for (int i = 0; i < n; i++) x[i] += y * own[i];
  }
}
