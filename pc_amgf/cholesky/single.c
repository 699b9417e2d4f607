/*
   Forward and backward substitution for one right-hand side, with factors in double or single precision, and sums in
   double precision. Memory traffic determines the time.
*/
#include "choleskyimpl.h"
#include "pc_amgf/clones.h"

#define GROUP_LANES 8 /* partial sums of a dot product, one per lane of a vector register */

#define ENTRY      float
#define NAME(name) name##Float
#include "groups.h"
#undef ENTRY
#undef NAME
#define ENTRY      PetscReal
#define NAME(name) name##Real
#include "groups.h"

/* Solves L L^T x = b; x is b on entry, in the order of L. work: largest number of rows of a supernode */
void CholeskySolveOne(const Cholesky *c, PetscReal x[], PetscReal work[])
{
  for (PetscInt s = 0; s < c->nsuper; s++) {
    const PetscInt  columns = CholeskyColumns(c, s), m = CholeskyRows(c, s);
    const PetscInt *row = c->row + c->start[s];
    PetscReal      *own = x + c->first[s];

    for (PetscInt i = 0; i < columns; i++) work[i] = own[i];
    for (PetscInt i = columns; i < m; i++) work[i] = 0.0;
    if (c->rounded) GroupForwardFloat(m, columns, c->rounded + c->entry[s], work);
    else GroupForwardReal(m, columns, c->L + c->entry[s], work);
    for (PetscInt i = 0; i < columns; i++) own[i] = work[i];
    for (PetscInt i = columns; i < m; i++) x[row[i]] += work[i];
  }
  for (PetscInt s = c->nsuper - 1; s >= 0; s--) {
    const PetscInt  columns = CholeskyColumns(c, s), m = CholeskyRows(c, s);
    const PetscInt *row = c->row + c->start[s];
    PetscReal      *own = x + c->first[s];

    for (PetscInt i = 0; i < m; i++) work[i] = x[row[i]];
    if (c->rounded) GroupBackwardFloat(m, columns, c->rounded + c->entry[s], work);
    else GroupBackwardReal(m, columns, c->L + c->entry[s], work);
    for (PetscInt i = 0; i < columns; i++) own[i] = work[i];
  }
}
