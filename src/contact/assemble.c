/* From integrals of facet pairs to the linearized gap: sums over ranks, weights, dropped rows */
#include "contactimpl.h"

/* Entries of a row that are this small beside its largest are rounding of exact zeros */
#define ENTRY_DROP 1e-14

PetscErrorCode ContactAssemblyCreate(Contact contact, ContactAssembly *as)
{
  PetscFunctionBegin;
  PetscCall(PetscMemzero(as, sizeof(*as)));
  PetscCall(VecDuplicate(contact->rows.mass, &as->gap));
  PetscCall(VecZeroEntries(as->gap));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactAssemblyAdd(ContactAssembly *as, PetscInt row, PetscInt n, const PetscInt node[], const PetscReal value[])
{
  PetscFunctionBegin;
  if (as->n + n > as->size) {
    as->size = 2 * as->size + 1024;
    PetscCall(PetscRealloc(as->size * sizeof(PetscInt), &as->row));
    PetscCall(PetscRealloc(as->size * sizeof(PetscInt), &as->node));
    PetscCall(PetscRealloc(as->size * sizeof(PetscScalar), &as->value));
  }
  for (PetscInt b = 0; b < n; ++b) {
    as->row[as->n]     = row;
    as->node[as->n]    = node[b];
    as->value[as->n++] = value[b];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ContactAssemblyDestroy(ContactAssembly *as)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(as->row));
  PetscCall(PetscFree(as->node));
  PetscCall(PetscFree(as->value));
  PetscCall(VecDestroy(&as->gap));
  PetscFunctionReturn(0);
}

/* The coupling of all rows with vertices; the sums over facets and ranks are made here */
static PetscErrorCode CouplingCreate(Contact contact, ContactAssembly *as, Mat *coupling)
{
  Vec      u;
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(contact->dm, &u));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(DMRestoreGlobalVector(contact->dm, &u));
  PetscCall(MatCreate(contact->comm, coupling));
  PetscCall(MatSetSizes(*coupling, contact->rows.nlocal, n / 3, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*coupling, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*coupling, as->n, as->row, as->node));
  PetscCall(MatSetValuesCOO(*coupling, as->value, INSERT_VALUES));
  PetscFunctionReturn(0);
}

/* kept[k]: local rows whose 1-norm, divided by the mass, is not below row_drop of the largest of all ranks */
static PetscErrorCode KeepRows(Contact contact, Mat coupling, PetscInt *nkept, PetscInt kept[])
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass;
  PetscInt           rstart;
  PetscReal         *norm, largest = 0.0;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(coupling, &rstart, NULL));
  PetscCall(PetscCalloc1(rows->nlocal, &norm));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  for (PetscInt i = 0; i < rows->nlocal; ++i) {
    const PetscReal   *n = &rows->normal[3 * i];
    const PetscScalar *value;
    PetscInt           ncols;

    PetscCall(MatGetRow(coupling, rstart + i, &ncols, NULL, &value));
    for (PetscInt k = 0; k < ncols; ++k) norm[i] += PetscAbsScalar(value[k]);
    PetscCall(MatRestoreRow(coupling, rstart + i, &ncols, NULL, &value));
    norm[i] *= (PetscAbsReal(n[0]) + PetscAbsReal(n[1]) + PetscAbsReal(n[2])) / PetscRealPart(mass[i]);
    largest = PetscMax(largest, norm[i]);
  }
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, contact->comm));
  *nkept = 0;
  for (PetscInt i = 0; i < rows->nlocal; ++i) {
    if (norm[i] > 0.0 && norm[i] >= contact->row_drop * largest) kept[(*nkept)++] = i;
  }
  PetscCall(PetscFree(norm));
  PetscFunctionReturn(0);
}

/* One row of J: the coupling's row times the normal by the mass; entries that are zero but for rounding are left out */
static PetscErrorCode ExpandRow(PetscInt ncols, const PetscInt node[], const PetscScalar value[], const PetscReal normal[3], PetscReal mass, PetscInt *n, PetscInt column[], PetscScalar entry[])
{
  PetscReal largest = 0.0, component = 0.0;

  PetscFunctionBegin;
  *n = 0;
  for (PetscInt k = 0; k < ncols; ++k) largest = PetscMax(largest, PetscAbsScalar(value[k]));
  for (PetscInt c = 0; c < 3; ++c) component = PetscMax(component, PetscAbsReal(normal[c]));
  for (PetscInt k = 0; k < ncols; ++k) {
    for (PetscInt c = 0; c < 3; ++c) {
      if (PetscAbsScalar(value[k] * normal[c]) <= ENTRY_DROP * largest * component) continue;
      column[*n]  = 3 * node[k] + c;
      entry[*n] = value[k] * normal[c] / mass;
      ++*n;
    }
  }
  PetscFunctionReturn(0);
}

/* Longest row of the coupling */
static PetscErrorCode LongestRow(Mat coupling, PetscInt *longest)
{
  PetscInt rstart, rend;

  PetscFunctionBegin;
  *longest = 0;
  PetscCall(MatGetOwnershipRange(coupling, &rstart, &rend));
  for (PetscInt i = rstart; i < rend; ++i) {
    PetscInt ncols;

    PetscCall(MatGetRow(coupling, i, &ncols, NULL, NULL));
    *longest = PetscMax(*longest, ncols);
    PetscCall(MatRestoreRow(coupling, i, &ncols, NULL, NULL));
  }
  PetscFunctionReturn(0);
}

/* J of the kept rows: counts the entries of each row first, then puts them in */
static PetscErrorCode CreateJacobian(Contact contact, Mat coupling, PetscInt nkept, const PetscInt kept[], Mat *J)
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass;
  PetscInt           rstart, jstart, nlocal, cstart, cend, longest, *column, *diagonal, *offdiagonal;
  PetscScalar       *entry;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(coupling, &rstart, NULL));
  PetscCall(MatGetOwnershipRangeColumn(coupling, &cstart, &cend));
  nlocal = 3 * (cend - cstart);
  PetscCall(LongestRow(coupling, &longest));
  PetscCall(PetscMalloc4(3 * longest, &column, 3 * longest, &entry, nkept, &diagonal, nkept, &offdiagonal));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  PetscCall(MatCreate(contact->comm, J));
  PetscCall(MatSetSizes(*J, nkept, nlocal, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*J, MATAIJ));
  for (PetscInt pass = 0; pass < 2; ++pass) {
    if (pass) {
      PetscCall(MatXAIJSetPreallocation(*J, 1, diagonal, offdiagonal, NULL, NULL));
      PetscCall(MatGetOwnershipRange(*J, &jstart, NULL));
    }
    for (PetscInt k = 0; k < nkept; ++k) {
      const PetscInt     i = kept[k], row = pass ? jstart + k : 0;
      const PetscInt    *node;
      const PetscScalar *value;
      PetscInt           ncols, n;

      PetscCall(MatGetRow(coupling, rstart + i, &ncols, &node, &value));
      PetscCall(ExpandRow(ncols, node, value, &rows->normal[3 * i], PetscRealPart(mass[i]), &n, column, entry));
      PetscCall(MatRestoreRow(coupling, rstart + i, &ncols, &node, &value));
      if (pass) PetscCall(MatSetValues(*J, 1, &row, n, column, entry, INSERT_VALUES));
      else {
        diagonal[k] = 0;
        for (PetscInt e = 0; e < n; ++e) diagonal[k] += column[e] >= 3 * cstart && column[e] < 3 * cend;
        offdiagonal[k] = n - diagonal[k];
      }
    }
  }
  PetscCall(MatAssemblyBegin(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscCall(PetscFree4(column, entry, diagonal, offdiagonal));
  PetscFunctionReturn(0);
}

/* Gap and mass of the kept rows, and where they stand */
static PetscErrorCode FillRows(Contact contact, const ContactAssembly *as, const PetscInt kept[], ContactLinearization lin)
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass, *gap;
  PetscScalar       *m, *g;
  PetscInt           pair = 0;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(lin->J, NULL, &lin->g));
  PetscCall(VecDuplicate(lin->g, &lin->mass));
  PetscCall(PetscMalloc1(lin->nlocal, &lin->vertex));
  PetscCall(PetscMalloc1(lin->nlocal, &lin->pair));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  PetscCall(VecGetArrayRead(as->gap, &gap));
  PetscCall(VecGetArray(lin->mass, &m));
  PetscCall(VecGetArray(lin->g, &g));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    const PetscInt i = kept[k];

    while (i >= rows->first[pair + 1]) ++pair;
    m[k]           = mass[i];
    g[k]           = gap[i] / mass[i];
    lin->vertex[k] = rows->vertex[i];
    lin->pair[k]   = pair;
  }
  PetscCall(VecRestoreArray(lin->g, &g));
  PetscCall(VecRestoreArray(lin->mass, &m));
  PetscCall(VecRestoreArrayRead(as->gap, &gap));
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscFunctionReturn(0);
}

/* Collective */
PetscErrorCode ContactAssemblyFinish(Contact contact, ContactAssembly *as, ContactLinearization *lin)
{
  Mat       coupling;
  PetscInt *kept;

  PetscFunctionBegin;
  PetscCall(VecAssemblyBegin(as->gap));
  PetscCall(VecAssemblyEnd(as->gap));
  PetscCall(CouplingCreate(contact, as, &coupling));
  PetscCall(PetscNew(lin));
  PetscCall(PetscMalloc1(contact->rows.nlocal, &kept));
  PetscCall(KeepRows(contact, coupling, &(*lin)->nlocal, kept));
  PetscCall(CreateJacobian(contact, coupling, (*lin)->nlocal, kept, &(*lin)->J));
  PetscCall(FillRows(contact, as, kept, *lin));
  PetscCall(MatGetSize((*lin)->J, &contact->nrows, NULL));
  PetscCall(PetscFree(kept));
  PetscCall(MatDestroy(&coupling));
  PetscFunctionReturn(0);
}
