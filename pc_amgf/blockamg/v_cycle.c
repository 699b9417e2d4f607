/*
   One V-cycle of PCBLOCKAMG, and its application to a vector in double precision.

   On each rank A = L + D + L^T + E. E are the entries in columns of other ranks. S is added to the diagonal of rows
   with such entries, see LevelShiftDiagonal(). The sweeps are
     down, from zero: x = (L + D + S)^-1 b, which leaves the residual b - A x = S x - L^T x - E x
     up:              x = (D + S + L^T)^-1 (b - L x + S x - E x)
   Let x be the iterate before the sweep up on the finest level, and z the iterate after it. Then
     A z = b + (L - S + E) (z - x),
   which costs half a sweep. These terms are small, so that A z has few rounding errors.
*/
#include "pc_amgf/amgfimpl.h"
#include "blockamgimpl.h"
#include <float.h>
#if defined(__SSE__)
  #include <xmmintrin.h>
#endif

/*
   Makes the processor set denormal numbers to zero until CycleRestoreTiny(), since arithmetic with them is a hundred
   times slower on many processors. Returns the previous mode.
*/
static unsigned CycleFlushTiny(void)
{
#if defined(__SSE__)
  const unsigned mode = _mm_getcsr();

  _mm_setcsr(mode | 0x8040);
  return mode;
#else
  return 0;
#endif
}

static void CycleRestoreTiny(unsigned mode)
{
#if defined(__SSE__)
  _mm_setcsr(mode);
#else
  (void)mode;
#endif
}

/* Adds sign (E x - S x) to y, in rows with entries in columns of other ranks. The ghosts of l->x must be up to date. */
static void CycleAddBorder(const BlockLevel *l, float sign, float y[])
{
  const BlockBorder *border = &l->border;
  const float       *ghosts = l->x + 4 * (size_t)l->nb;

  for (int i = 0; i < border->n; i++) {
    const int p = border->position[i];
    float     s = -border->shift[i] * l->x[p];

    for (int k = border->ptr[i]; k < border->ptr[i + 1]; k++) s += border->val[k] * ghosts[border->col[k]];
    y[p] += sign * s;
  }
}

/*
   Applies the downward half of the cycle on one level: computes l->x from l->b, and the restricted residual next->b.
   next: the next coarser level, or NULL.
*/
static PetscErrorCode CycleDown(const BlockLevel *l, const BlockLevel *next)
{
  PetscFunctionBegin;
  BlockSweepDown_Private(l);
  if (!next) PetscFunctionReturn(0);
  PetscCall(BlockHaloFetch_Private(&l->halo, l, l->x));
  CycleAddBorder(l, 1.0f, l->t);
  PetscCall(PetscArrayzero(next->b, next->nslots));
  BlockRestrict_Private(l, next->b);
  PetscCall(BlockHaloAdd_Private(&l->P.halo, next, next->b));
  PetscFunctionReturn(0);
}

/*
   Applies the upward half of the cycle on one level: computes l->x from the next level. before: receives the
   iterate before the sweep; may be NULL
*/
static PetscErrorCode CycleUp(const BlockLevel *l, const BlockLevel *next, float *before)
{
  PetscFunctionBegin;
  if (next) {
    PetscCall(BlockHaloFetch_Private(&l->P.halo, next, next->x));
    BlockInterpolateAdd_Private(l, next->x);
  }
  PetscCall(BlockHaloFetch_Private(&l->halo, l, l->x));
  CycleAddBorder(l, -1.0f, l->b);
  if (before) PetscCall(PetscArraycpy(before, l->x, 4 * l->nb));
  BlockSweepUp_Private(l);
  PetscFunctionReturn(0);
}

static const BlockLevel *CycleNext(const BlockHierarchy *h, int i)
{
  if (i + 1 < h->nlevels) return &h->levels[i + 1];
  return h->dense.N ? &h->bottom : NULL;
}

/* Applies one V-cycle: computes x of the finest level from its b. before: see CycleUp(), for the finest level */
static PetscErrorCode BlockCycle(BlockHierarchy *h, float *before)
{
  PetscFunctionBegin;
  for (int i = 0; i < h->nlevels; i++) PetscCall(CycleDown(&h->levels[i], CycleNext(h, i)));
  if (h->dense.N) PetscCall(BlockDenseSolve_Private(h));
  for (int i = h->nlevels - 1; i >= 0; i--) PetscCall(CycleUp(&h->levels[i], CycleNext(h, i), i ? NULL : before));
  PetscFunctionReturn(0);
}

/* Replaces b of a level, after CycleUp(), by A x. before: the iterate before the sweep, which is overwritten */
static PetscErrorCode CycleMultiply(const BlockLevel *l, float *before)
{
  PetscFunctionBegin;
  for (int p = 0; p < 4 * l->nb; p++) before[p] = l->x[p] - before[p];
  BlockMultiplyLower_Private(l, before, l->b);
  PetscCall(BlockHaloFetch_Private(&l->halo, l, l->x));
  CycleAddBorder(l, 1.0f, l->b);
  PetscFunctionReturn(0);
}

/*
   Computes the power of 2 above the largest absolute entry of r on all ranks. *scale is 1 if all entries are zero, and
   infinite if an entry is not finite.
*/
static PetscErrorCode ApplyFindScale(const BlockHierarchy *h, PetscInt n, const PetscScalar r[], double *scale)
{
  double largest = 0.0, nan = 0.0;
  int    exponent;

  PetscFunctionBegin;
  for (PetscInt u = 0; u < n; u++) {
    const double value = PetscAbsReal(PetscRealPart(r[u]));

    largest = PetscMax(largest, value);
    nan += 0.0 * value;
  }
  if (nan != 0.0) largest = PETSC_INFINITY;
  if (h->size > 1) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, h->comm));
  if (!(largest <= DBL_MAX)) *scale = PETSC_INFINITY;
  else if (largest == 0.0) *scale = 1.0;
  else {
    (void)frexp(largest, &exponent);
    *scale = ldexp(1.0, PetscMax(exponent, -1000));
  }
  PetscFunctionReturn(0);
}

/* Sets b of the finest level to r, divided by *scale */
static PetscErrorCode ApplyLoad(const BlockHierarchy *h, const BlockLevel *fine, Vec r, double *scale)
{
  const PetscScalar *from;
  double             inverse;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(ApplyFindScale(h, fine->n, from, scale));
  inverse = 1.0 / *scale;
  for (int u = 0; u < fine->n; u++) {
    const int p = fine->position[u];

    fine->b[p] = (float)(inverse * fine->scale[p] * PetscRealPart(from[u]));
  }
  PetscCall(VecRestoreArrayRead(r, &from));
  PetscFunctionReturn(0);
}

/* Computes z = B r, and the product A z unless it is NULL. The hierarchy has a smoothed level if it is not. */
static PetscErrorCode ApplyCycle(BlockHierarchy *h, Vec r, Vec z, Vec product)
{
  const BlockLevel *fine   = h->nlevels ? &h->levels[0] : &h->bottom;
  float            *before = product ? h->before : NULL;
  const unsigned    mode   = CycleFlushTiny();
  PetscScalar      *to;
  double            scale = 1.0, unit;

  PetscFunctionBegin;
  PetscCall(ApplyLoad(h, fine, r, &scale));
  PetscCall(BlockCycle(h, before));
  if (product) PetscCall(CycleMultiply(fine, before));
  CycleRestoreTiny(mode);
  unit = scale / h->scale;
  PetscCall(VecGetArrayWrite(z, &to));
  for (int u = 0; u < fine->n; u++) {
    const int p = fine->position[u];

    to[u] = unit * fine->scale[p] * fine->x[p];
  }
  PetscCall(VecRestoreArrayWrite(z, &to));
  if (!product) PetscFunctionReturn(0);
  PetscCall(VecGetArrayWrite(product, &to));
  for (int u = 0; u < fine->n; u++) {
    const int p = fine->position[u];

    to[u] = scale * fine->b[p] / fine->scale[p];
  }
  PetscCall(VecRestoreArrayWrite(product, &to));
  PetscFunctionReturn(0);
}

PetscErrorCode PCApply_BlockAMG(PC pc, Vec r, Vec z)
{
  PC              hypre = ((PC_BlockAMG *)pc->data)->hypre;
  BlockHierarchy *h     = ((PC_BlockAMG *)pc->data)->h;

  PetscFunctionBegin;
  if (hypre) {
    PetscCall(PCApply(hypre, r, z));
    PetscFunctionReturn(0);
  }
  if (!h) { /* the set-up failed: report this to the KSP */
    PetscCall(VecSet(z, 0.0));
    PetscCall(VecFlag(z, 1));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscLogEventBegin(PC_BLOCKAMG_Apply, pc, r, z, 0));
  PetscCall(ApplyCycle(h, r, z, NULL));
  PetscCall(PetscLogEventEnd(PC_BLOCKAMG_Apply, pc, r, z, 0));
  PetscFunctionReturn(0);
}

PetscErrorCode PCApplyTranspose_BlockAMG(PC pc, Vec r, Vec z)
{
  PC hypre = ((PC_BlockAMG *)pc->data)->hypre;

  PetscFunctionBegin;
  if (hypre) PetscCall(PCApplyTranspose(hypre, r, z));
  else PetscCall(PCApply_BlockAMG(pc, r, z));
  PetscFunctionReturn(0);
}

/* Computes z = B r and the product A z with the 16-bit entries of A, which costs a quarter of a product with A */
PetscErrorCode PCBlockAMGApplyProduct_BlockAMG(PC pc, Vec r, Vec z, Vec product)
{
  BlockHierarchy *h = ((PC_BlockAMG *)pc->data)->h;

  PetscFunctionBegin;
  if (!h || !h->nlevels) {
    PetscCall(PCApply(pc, r, z));
    PetscCall(MatMult(pc->pmat, z, product));
    PetscFunctionReturn(0);
  }
  if (!h->before) PetscCall(PetscMalloc1(4 * h->levels[0].nb, &h->before));
  PetscCall(PetscLogEventBegin(PC_BLOCKAMG_Apply, pc, r, z, 0));
  PetscCall(ApplyCycle(h, r, z, product));
  PetscCall(PetscLogEventEnd(PC_BLOCKAMG_Apply, pc, r, z, 0));
  PetscFunctionReturn(0);
}
