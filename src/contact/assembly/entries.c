/*
   Assembles a matrix from entries in any order, for rows on any rank. Entries are added in blocks of one row and
   `width` successive columns. A block is added once for each overlap of two facets. Blocks with equal row and column
   are summed here, before PETSc sorts the entries. Otherwise sorting would take most of the time.
*/
#include "assemblyimpl.h"

/* Appends n blocks of a row */
PetscErrorCode ContactEntriesAdd(ContactEntries *entries, PetscInt row, PetscInt n, const PetscInt block[],
  const PetscReal value[])
{
  const PetscInt width = entries->width;

  PetscFunctionBegin;
  if (entries->n + n > entries->size) {
    entries->size = 2 * entries->size + n + 512;
    PetscCall(PetscRealloc(entries->size * sizeof(PetscInt), &entries->row));
    PetscCall(PetscRealloc(entries->size * sizeof(PetscInt), &entries->block));
    PetscCall(PetscRealloc(width * entries->size * sizeof(PetscScalar), &entries->value));
  }
  for (PetscInt i = 0; i < n; ++i) {
    entries->row[entries->n + i]   = row;
    entries->block[entries->n + i] = block[i];
  }
  for (PetscInt i = 0; i < width * n; ++i) entries->value[width * entries->n + i] = value[i];
  entries->n += n;
  PetscFunctionReturn(0);
}

/* Sorts the blocks by rows. The blocks of the k-th of *nrows successive rows are (*order)[(*first)[k]] to
   (*order)[(*first)[k + 1] - 1]. */
static PetscErrorCode EntriesOrder(const ContactEntries *entries, PetscInt *nrows, PetscInt **first, PetscInt **order)
{
  PetscInt least = entries->n ? entries->row[0] : 0, most = entries->n ? least : -1;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < entries->n; ++i) {
    least = PetscMin(least, entries->row[i]);
    most  = PetscMax(most, entries->row[i]);
  }
  *nrows = most - least + 1;
  PetscCall(PetscCalloc1(*nrows + 2, first));
  PetscCall(PetscMalloc1(entries->n, order));
  for (PetscInt i = 0; i < entries->n; ++i) ++(*first)[entries->row[i] - least + 2];
  for (PetscInt k = 2; k < *nrows + 2; ++k) (*first)[k] += (*first)[k - 1];
  for (PetscInt i = 0; i < entries->n; ++i) (*order)[(*first)[entries->row[i] - least + 1]++] = i;
  PetscFunctionReturn(0);
}

/* Appends the blocks of one row to `merged`, and sums those with equal columns. slot: hash table of `size` block
   numbers, which are all negative before and after the call. The size is a power of two and at least 2 n. */
static PetscErrorCode EntriesMergeRow(const ContactEntries *entries, PetscInt n, const PetscInt order[], PetscInt size,
  PetscInt slot[], ContactEntries *merged)
{
  const PetscInt width = entries->width, start = merged->n;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt     block = entries->block[order[i]];
    const PetscScalar *value = &entries->value[width * order[i]];
    PetscInt           place = block & (size - 1);

    while (slot[place] >= 0 && merged->block[slot[place]] != block) place = (place + 1) & (size - 1);
    if (slot[place] < 0) {
      slot[place]              = merged->n;
      merged->row[merged->n]   = entries->row[order[i]];
      merged->block[merged->n] = block;
      for (PetscInt c = 0; c < width; ++c) merged->value[width * merged->n + c] = 0.0;
      ++merged->n;
    }
    for (PetscInt c = 0; c < width; ++c) merged->value[width * slot[place] + c] += value[c];
  }
  for (PetscInt i = start; i < merged->n; ++i) {
    PetscInt place = merged->block[i] & (size - 1);

    for (; slot[place] >= 0; place = (place + 1) & (size - 1)) slot[place] = -1;
  }
  PetscFunctionReturn(0);
}

/* Sums the blocks of this rank that have equal row and column */
static PetscErrorCode EntriesMerge(ContactEntries *entries)
{
  PetscInt       nrows, *first, *order, *slot, longest = 0, size = 2;
  ContactEntries merged = {.size = entries->n, .width = entries->width};

  PetscFunctionBegin;
  PetscCall(EntriesOrder(entries, &nrows, &first, &order));
  for (PetscInt k = 0; k < nrows; ++k) longest = PetscMax(longest, first[k + 1] - first[k]);
  while (size < 2 * longest) size *= 2;
  PetscCall(PetscMalloc1(size, &slot));
  for (PetscInt k = 0; k < size; ++k) slot[k] = -1;
  PetscCall(PetscMalloc1(merged.size, &merged.row));
  PetscCall(PetscMalloc1(merged.size, &merged.block));
  PetscCall(PetscMalloc1(merged.width * merged.size, &merged.value));
  for (PetscInt k = 0; k < nrows; ++k)
    PetscCall(EntriesMergeRow(entries, first[k + 1] - first[k], order + first[k], size, slot, &merged));
  PetscCall(PetscFree(slot));
  PetscCall(PetscFree(order));
  PetscCall(PetscFree(first));
  PetscCall(ContactEntriesDestroy(entries));
  *entries = merged;
  PetscFunctionReturn(0);
}

/* Collective. Creates a matrix from the entries of all ranks. m and n are the local numbers of rows and columns. */
PetscErrorCode ContactEntriesCreateMatrix(MPI_Comm comm, PetscInt m, PetscInt n, ContactEntries *entries, Mat *mat)
{
  const PetscInt width = entries->width;
  PetscInt      *row, *column;

  PetscFunctionBegin;
  PetscCall(EntriesMerge(entries));
  PetscCall(PetscMalloc2(width * entries->n, &row, width * entries->n, &column));
  for (PetscInt i = 0; i < width * entries->n; ++i) {
    row[i]    = entries->row[i / width];
    column[i] = width * entries->block[i / width] + i % width;
  }
  PetscCall(MatCreate(comm, mat));
  PetscCall(MatSetSizes(*mat, m, n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*mat, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*mat, width * entries->n, row, column));
  PetscCall(MatSetValuesCOO(*mat, entries->value, INSERT_VALUES));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactEntriesDestroy(ContactEntries *entries)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(entries->row));
  PetscCall(PetscFree(entries->block));
  PetscCall(PetscFree(entries->value));
  entries->n = entries->size = 0;
  PetscFunctionReturn(0);
}
