/* Assembles a matrix from entries in any order, for rows on any rank */
#include "assemblyimpl.h"

/* Adds a row's entries for n blocks of three columns each */
PetscErrorCode ContactEntriesAdd(ContactEntries *entries, PetscInt row, PetscInt n, const PetscInt block[],
  const PetscReal value[])
{
  PetscFunctionBegin;
  if (entries->n + 3 * n > entries->size) {
    entries->size = 2 * entries->size + 3 * n + 1024;
    PetscCall(PetscRealloc(entries->size * sizeof(PetscInt), &entries->row));
    PetscCall(PetscRealloc(entries->size * sizeof(PetscInt), &entries->column));
    PetscCall(PetscRealloc(entries->size * sizeof(PetscScalar), &entries->value));
  }
  for (PetscInt i = 0; i < 3 * n; ++i) {
    entries->row[entries->n]    = row;
    entries->column[entries->n] = 3 * block[i / 3] + i % 3;
    entries->value[entries->n]  = value[i];
    ++entries->n;
  }
  PetscFunctionReturn(0);
}

/* Collective. Assembles a matrix from the entries of all ranks; m, n: local sizes. Destroys the entries' indices */
PetscErrorCode ContactEntriesCreateMatrix(MPI_Comm comm, PetscInt m, PetscInt n, ContactEntries *entries, Mat *mat)
{
  PetscFunctionBegin;
  PetscCall(MatCreate(comm, mat));
  PetscCall(MatSetSizes(*mat, m, n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*mat, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*mat, entries->n, entries->row, entries->column));
  PetscCall(MatSetValuesCOO(*mat, entries->value, INSERT_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactEntriesDestroy(ContactEntries *entries)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(entries->row));
  PetscCall(PetscFree(entries->column));
  PetscCall(PetscFree(entries->value));
  entries->n = entries->size = 0;
  PetscFunctionReturn(0);
}
