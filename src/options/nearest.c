/* Finds the known name that is most similar to a misspelt one */
#include "optionsimpl.h"

/* Computes the Levenshtein distance of two names: the number of letters to insert, delete or replace */
PetscErrorCode OptionsDistance(const char a[], const char b[], size_t *distance)
{
  size_t na, nb, *row;

  PetscFunctionBegin;
  PetscCall(PetscStrlen(a, &na));
  PetscCall(PetscStrlen(b, &nb));
  PetscCall(PetscMalloc1(nb + 1, &row));
  for (size_t j = 0; j <= nb; ++j) row[j] = j;
  for (size_t i = 1; i <= na; ++i) {
    size_t diagonal = row[0];

    row[0] = i;
    for (size_t j = 1; j <= nb; ++j) {
      const size_t above = row[j];

      row[j]   = PetscMin(PetscMin(above, row[j - 1]) + 1, diagonal + (a[i - 1] != b[j - 1]));
      diagonal = above;
    }
  }
  *distance = row[nb];
  PetscCall(PetscFree(row));
  PetscFunctionReturn(0);
}

/*
   Finds the known name with the smallest Levenshtein distance from another name. n: number of known names; nearest: one
   of the known names, or "" if there are none.
*/
PetscErrorCode OptionsNearest(PetscInt n, const char *const known[], const char name[], const char **nearest)
{
  size_t best = PETSC_MAX_OPTION_NAME, distance = 0;

  PetscFunctionBegin;
  *nearest = "";
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(OptionsDistance(name, known[i], &distance));
    if (distance < best) {
      best     = distance;
      *nearest = known[i];
    }
  }
  PetscFunctionReturn(0);
}
