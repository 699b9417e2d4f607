/*
   Stores a matrix of the hierarchy: blocks of the strictly lower triangle in integers of 16 bits; entries of stiff
   unknowns, inverses of the diagonal blocks and entries in columns of other ranks in single precision
*/
#include "blockamgimpl.h"
#include <clones.h>
#include <math.h>

/* Blocks of L in the block rows processed so far; capacity: number of allocated blocks */
typedef struct {
  int      n, capacity, row_capacity;
  int     *col;
  int16_t *val;
  float   *row; /* the blocks of the current block row before they are rounded and sorted, 4 floats for each row */
} LevelBlocks;

/* Reserves memory for `more` blocks of another block row */
static PetscErrorCode BlocksReserve(LevelBlocks *blocks, int B, int more)
{
  PetscFunctionBegin;
  if (more > blocks->row_capacity) {
    blocks->row_capacity = 2 * more;
    PetscCall(PetscFree(blocks->row));
    PetscCall(PetscMalloc1(4 * (size_t)B * blocks->row_capacity, &blocks->row));
  }
  if (blocks->n + more <= blocks->capacity) PetscFunctionReturn(0);
  blocks->capacity = blocks->n + more + blocks->n / 4;
  PetscCall(PetscRealloc((size_t)blocks->capacity * sizeof(*blocks->col), &blocks->col));
  PetscCall(PetscRealloc(((size_t)blocks->capacity * 4 * B + 4) * sizeof(*blocks->val), &blocks->val));
  PetscFunctionReturn(0);
}

/* Creates the map from positions in a block vector to unknowns: the number of the unknown at each position, or -1 if
   the position is unused */
static PetscErrorCode LevelGetUnknowns(const BlockLevel *level, int **unknown)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc1(4 * level->nb, unknown));
  for (int i = 0; i < 4 * level->nb; i++) (*unknown)[i] = -1;
  for (int u = 0; u < level->n; u++) (*unknown)[level->position[u]] = u;
  PetscFunctionReturn(0);
}

/* Sorts a short list that is almost sorted, by insertion */
static void LevelSort(int n, int a[])
{
  for (int i = 1; i < n; i++) {
    const int key = a[i];
    int       j   = i;

    for (; j > 0 && a[j - 1] > key; j--) a[j] = a[j - 1];
    a[j] = key;
  }
}

/*
   Collects the blocks of block row i of L in blocks->row, scaled, and their columns in blocks->col, both in the order
   in which they are found. D becomes the diagonal block, not scaled. slot[j]: number of the block in block column j.
*/
static PetscErrorCode LevelCollectBlocks(const BlockLevel *level, const BlockRows *rows, const int unknown[], int i,
  double inverse_scale, LevelBlocks *blocks, int slot[], PetscScalar D[16])
{
  const int B = level->B, first = blocks->n;
  PetscInt  most = 0;

  PetscFunctionBegin;
  for (int r = 0; r < B; r++) {
    const int u = unknown[4 * i + r];

    if (u >= 0) most += rows->ia[u + 1] - rows->ia[u];
  }
  PetscCall(BlocksReserve(blocks, B, (int)PetscMin(most, i)));
  for (int k = 0; k < B * B; k++) D[k] = 0.0;
  for (int r = 0; r < B; r++) {
    const int    u    = unknown[4 * i + r];
    const double left = inverse_scale * level->scale[4 * i + r];

    if (u < 0) continue;
    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) {
      const int p = level->position[rows->ja[k]], j = p / 4;

      if (j == i) D[B * r + p % 4] = inverse_scale * rows->a[k];
      if (j >= i || BlockHasContrast(level, 4 * i + r, p)) continue;
      if (slot[j] < first) {
        for (int m = 0; m < 4 * B; m++) blocks->row[4 * B * (blocks->n - first) + m] = 0.0f;
        slot[j]                  = blocks->n;
        blocks->col[blocks->n++] = 4 * j;
      }
      blocks->row[4 * (B * (slot[j] - first) + r) + p % 4] =
        (float)(left * level->scale[p] * PetscRealPart(rows->a[k]));
    }
  }
  PetscFunctionReturn(0);
}

/*
   Sorts the blocks of block row i of L by their columns and rounds them to integers, with a unit for each row. first:
   number of the row's first block. slot: see LevelCollectBlocks().
*/
AMGF_CLONES static void LevelRound(BlockLevel *level, int i, int first, LevelBlocks *blocks, const int slot[])
{
  const int B = level->B, n = blocks->n - first;
  float     largest[16] = {0.0f}, factor[16];

  for (int k = 0; k < n; k++) {
    for (int m = 0; m < 4 * B; m++) {
      const float v = fabsf(blocks->row[4 * B * k + m]);

      largest[m] = v <= largest[m] ? largest[m] : v; /* NaN if v is NaN */
    }
  }
  for (int r = 0; r < B; r++) {
    float unit = largest[4 * r];

    for (int c = 1; c < 4; c++) unit = largest[4 * r + c] <= unit ? unit : largest[4 * r + c];
    unit /= BLOCKAMG_LARGEST;
    for (int c = 0; c < 4; c++) factor[4 * r + c] = BlockInverseUnit(unit);
    level->unit[4 * (size_t)i + r] = unit / 65536.0f; /* Vec8LoadShorts() multiplies by 65536 */
  }
  LevelSort(n, blocks->col + first);
  for (int k = first; k < blocks->n; k++) {
    const float *from = blocks->row + 4 * B * (slot[blocks->col[k] / 4] - first);
    int16_t     *to   = blocks->val + 4 * (size_t)B * k;

    for (int m = 0; m < 4 * B; m++) to[m] = BlockRound(factor[m] * from[m]);
  }
}

/*
   Adds S to the diagonal block D of block row i, in rows with entries in columns of other ranks. Let l be the sum of
   the absolute values of a row's entries in those columns, and g the excess of its diagonal entry over the absolute
   values of the other entries in the diagonal block. S is the larger of (l - 0.9 g)/2 and l/4. The first value makes
   the sweeps of all ranks together converge and the cycle positive definite; the second smooths stiff couplings between
   ranks. S and D are not yet scaled by the scales of the unknowns.
   *next: first row of the border not yet processed.
*/
static void LevelShiftDiagonal(BlockLevel *level, int *next, int i, PetscScalar D[16])
{
  BlockBorder *border = &level->border;
  const int    B      = level->B;
  double       excess[4];

  if (*next >= border->n || border->position[*next] >= 4 * (i + 1)) return;
  for (int r = 0; r < B; r++) {
    excess[r] = 2.0 * PetscAbsScalar(D[(B + 1) * r]);
    for (int c = 0; c < B; c++) excess[r] -= PetscAbsScalar(D[B * r + c]);
  }
  for (; *next < border->n && border->position[*next] < 4 * (i + 1); ++*next) {
    const int r = border->position[*next] % 4;

    border->shift[*next] *= (float)PetscMax(0.5, 1.0 - 0.45 * PetscMax(excess[r], 0.0) / border->shift[*next]);
    D[(B + 1) * r] += border->shift[*next];
  }
}

/* BlockLevelInvert_Private - scales the diagonal block D of block row i, and stores W with D^-1 = W^T W */
PetscErrorCode BlockLevelInvert_Private(BlockLevel *level, int i, PetscScalar D[16])
{
  const int    B     = level->B;
  const float *scale = level->scale + 4 * (size_t)i;
  PetscScalar  W[16];

  PetscFunctionBegin;
  for (int r = 0; r < B; r++) {
    for (int c = 0; c < B; c++) D[B * r + c] *= (double)scale[r] * scale[c];
  }
  PetscCall(BlockInvertRoot_Private(B, D, W));
  for (int r = 0; r < B; r++) {
    for (int c = 0; c < B; c++) level->W[4 * ((size_t)B * i + c) + r] = (float)PetscRealPart(W[B * r + c]);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode LevelSetBlocks(BlockLevel *level, const BlockRows *rows, double scale)
{
  const int   B      = level->B;
  LevelBlocks blocks = {0, 0, 0, NULL, NULL, NULL};
  int        *unknown, *slot, border = 0;
  PetscScalar D[16];

  PetscFunctionBegin;
  PetscCall(LevelGetUnknowns(level, &unknown));
  PetscCall(PetscMalloc1(level->nb, &slot));
  for (int i = 0; i < level->nb; i++) slot[i] = -1;
  PetscCall(PetscMalloc1(level->nb + 1, &level->ptr));
  PetscCall(PetscCalloc1(4 * (size_t)B * level->nb, &level->W));
  PetscCall(PetscCalloc1(4 * (size_t)level->nb, &level->unit));
  for (int i = 0; i < level->nb; i++) {
    level->ptr[i] = blocks.n;
    PetscCall(LevelCollectBlocks(level, rows, unknown, i, 1.0 / scale, &blocks, slot, D));
    LevelRound(level, i, level->ptr[i], &blocks, slot);
    LevelShiftDiagonal(level, &border, i, D);
    PetscCall(BlockLevelInvert_Private(level, i, D));
  }
  for (int b = 0; b < level->border.n; b++)
    level->border.shift[b] *= level->scale[level->border.position[b]] * level->scale[level->border.position[b]];
  level->ptr[level->nb] = blocks.n;
  PetscCall(PetscRealloc((size_t)blocks.n * sizeof(*blocks.col), &blocks.col));
  PetscCall(PetscRealloc(((size_t)blocks.n * 4 * B + 4) * sizeof(*blocks.val), &blocks.val));
  if (blocks.val)
    /* Sweeps read 16 numbers of each block. Blocks of 3 x 3 have 12, so 4 more than the last block must exist. */
    PetscCall(PetscArrayzero(blocks.val + (size_t)blocks.n * 4 * B, 4));
  level->col = blocks.col;
  level->L   = blocks.val;
  PetscCall(PetscFree(blocks.row));
  PetscCall(PetscFree(slot));
  PetscCall(PetscFree(unknown));
  PetscFunctionReturn(0);
}

/*
   Stores the entries in columns of other ranks, row by row in the order of the positions. border->shift becomes half
   the sum of a row's absolute values, not scaled.
*/
static PetscErrorCode LevelSetBorder(BlockLevel *level, const BlockRows *rows, double scale)
{
  BlockBorder *border = &level->border;
  const float *ghosts = level->scale + 4 * (size_t)level->nb;
  int         *unknown, n = 0;

  PetscFunctionBegin;
  border->n = 0;
  if (!rows->oia || !rows->n) PetscFunctionReturn(0);
  for (PetscInt u = 0; u < rows->n; u++) border->n += rows->oia[u + 1] > rows->oia[u];
  PetscCall(LevelGetUnknowns(level, &unknown));
  PetscCall(PetscMalloc1(border->n, &border->position));
  PetscCall(PetscMalloc1(border->n, &border->shift));
  PetscCall(PetscMalloc1(border->n + 1, &border->ptr));
  PetscCall(PetscMalloc1(rows->oia[rows->n], &border->col));
  PetscCall(PetscMalloc1(rows->oia[rows->n], &border->val));
  border->ptr[0] = 0;
  for (int i = 0; i < 4 * level->nb; i++) {
    const int u = unknown[i];
    int       k = border->ptr[n];
    double    s = 0.0, left = level->scale[i] / scale;

    if (u < 0 || rows->oia[u + 1] == rows->oia[u]) continue;
    for (PetscInt m = rows->oia[u]; m < rows->oia[u + 1]; m++, k++) {
      border->col[k] = (int)rows->oja[m];
      border->val[k] = (float)(left * ghosts[rows->oja[m]] * PetscRealPart(rows->oa[m]));
      s += PetscAbsScalar(rows->oa[m]) / scale;
    }
    border->position[n] = i;
    border->shift[n]    = (float)(0.5 * s);
    border->ptr[n + 1]  = k;
    n++;
  }
  PetscCall(PetscFree(unknown));
  PetscFunctionReturn(0);
}

/* BlockLevelCount_Private - computes the sums over all ranks that PCView() prints. entries: those of this rank. */
PetscErrorCode BlockLevelCount_Private(BlockLevel *level, MPI_Comm comm, double entries)
{
  const int    B      = level->B;
  const double border = level->border.n ? level->border.ptr[level->border.n] : 0;
  double       sums[4];

  PetscFunctionBegin;
  sums[0] = level->n;
  sums[1] = entries;
  sums[2] = (double)B * B * (2.0 * level->ptr[level->nb] + level->nb) + border;
  sums[3] = (8.0 * B + 4.0) * level->ptr[level->nb] + (16.0 * B + 36.0) * level->nb + 4.0 * level->n + 8.0 * border +
            12.0 * level->border.n;
  if (level->contrast.ptr) sums[3] += 4.0 * level->nb + (double)sizeof(BlockEntry) * level->contrast.ptr[level->nb];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, comm));
  level->unknowns = sums[0];
  level->entries  = sums[1];
  level->blocks   = sums[2];
  level->bytes    = sums[3];
  PetscFunctionReturn(0);
}

/* Sets the scales of the unknowns and of the ghosts of the matrix. Unused positions, and zero diagonals, have 1. */
static PetscErrorCode LevelSetScale(BlockLevel *level, const BlockRows *rows, double scale)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc1(level->nslots, &level->scale));
  for (int p = 0; p < level->nslots; p++) level->scale[p] = 1.0f;
  for (PetscInt u = 0; u < rows->n; u++) {
    PetscInt k = rows->ia[u];

    while (k < rows->ia[u + 1] && rows->ja[k] < u) k++; /* columns are sorted */
    if (k < rows->ia[u + 1] && rows->ja[k] == u && rows->a[k] != 0.0)
      level->scale[level->position[u]] = (float)(1.0 / PetscSqrtReal(PetscAbsScalar(rows->a[k]) / scale));
  }
  PetscCall(BlockHaloFetch_Private(&level->halo, level, level->scale));
  PetscFunctionReturn(0);
}

/* BlockLevelCheckSize_Private - checks that positions of n unknowns, or of as many ghosts, are integers of 32 bits */
PetscErrorCode BlockLevelCheckSize_Private(PetscInt n)
{
  const PetscInt largest = PETSC_MAX_INT < 2147483647 ? PETSC_MAX_INT : 2147483647;

  PetscFunctionBegin;
  PetscCheck(n <= largest / 8, PETSC_COMM_SELF, PETSC_ERR_SUP,
    "PCBLOCKAMG supports at most %" PetscInt_FMT " unknowns per rank, not %" PetscInt_FMT ": use more ranks",
    largest / 8, n);
  PetscFunctionReturn(0);
}

/*
   BlockLevelSetMatrix_Private - chooses the positions of the level's unknowns, and stores the matrix divided by `scale`

   Input Parameters:
   + level - the level
   . rows  - rows of its matrix on this rank
   . bs    - number of consecutive unknowns per node; 1 if that is not known
   - scale - divisor of the matrix
*/
PetscErrorCode BlockLevelSetMatrix_Private(BlockLevel *level, const BlockRows *rows, PetscInt bs, double scale)
{
  PetscFunctionBegin;
  PetscCall(BlockLevelCheckSize_Private(PetscMax(rows->n, rows->nghosts)));
  level->n = (int)rows->n;
  level->B = bs % 3 == 0 ? 3 : 4;
  PetscCall(PetscMalloc1(level->n, &level->position));
  if (bs % level->B == 0) PetscCall(BlockOrderNodes_Private(rows, level->B, level->position));
  else PetscCall(BlockOrderGroups_Private(rows, level->position));
  level->nb = 0;
  for (int u = 0; u < level->n; u++) level->nb = PetscMax(level->nb, level->position[u] / 4 + 1);
  PetscCall(BlockHaloCreate_Private(rows->columns, rows->nghosts, rows->ghosts, level, &level->halo));
  level->nslots = 4 * level->nb + level->halo.nghosts;
  PetscCall(LevelSetScale(level, rows, scale));
  PetscCall(LevelSetBorder(level, rows, scale));
  PetscCall(BlockContrastSet_Private(level, rows, scale));
  PetscCall(LevelSetBlocks(level, rows, scale));
  PetscCall(PetscFree(level->contrast.stiff));
  PetscCall(BlockLevelCount_Private(level, rows->columns->comm,
    rows->n ? (double)rows->ia[rows->n] + (rows->oia ? (double)rows->oia[rows->n] : 0.0) : 0.0));
  PetscFunctionReturn(0);
}

/*
   BlockLevelCreateVectors_Private - creates the level's vectors. Their length must include the ghosts of the
   interpolation from this level to the finer one.
*/
PetscErrorCode BlockLevelCreateVectors_Private(BlockLevel *level)
{
  PetscFunctionBegin;
  PetscCall(PetscCalloc1(level->nslots, &level->x));
  PetscCall(PetscCalloc1(level->nslots, &level->b));
  PetscCall(PetscCalloc1(4 * level->nb, &level->t));
  level->bytes += 4.0 * (2.0 * level->nslots + 4.0 * level->nb);
  PetscFunctionReturn(0);
}

PetscErrorCode BlockLevelDestroy_Private(BlockLevel *level)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(level->position));
  PetscCall(PetscFree(level->ptr));
  PetscCall(PetscFree(level->col));
  PetscCall(PetscFree(level->L));
  PetscCall(PetscFree(level->unit));
  PetscCall(PetscFree(level->W));
  PetscCall(PetscFree(level->scale));
  PetscCall(BlockContrastDestroy_Private(&level->contrast));
  PetscCall(PetscFree(level->border.position));
  PetscCall(PetscFree(level->border.ptr));
  PetscCall(PetscFree(level->border.col));
  PetscCall(PetscFree(level->border.val));
  PetscCall(PetscFree(level->border.shift));
  PetscCall(PetscSFDestroy(&level->halo.sf));
  PetscCall(BlockInterpolationDestroy_Private(&level->P));
  PetscCall(PetscFree(level->x));
  PetscCall(PetscFree(level->b));
  PetscCall(PetscFree(level->t));
  PetscFunctionReturn(0);
}
