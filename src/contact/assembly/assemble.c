/* Computes the linearized gap from the integrals over facet pairs: sums them over ranks, divides them by the masses,
   and removes small rows */
#include "assemblyimpl.h"

/* Entries smaller than this fraction of the row's largest entry are exact zeros with rounding errors. */
#define ENTRY_DROP 1e-14
/* The corresponding fraction for a row of a smooth pair, whose entries are sums of more terms. */
#define SLOPE_DROP 1e-12

static void AssemblyStart(ContactParts parts, ContactAssembly *as)
{
  as->parts          = parts;
  as->coupling.width = 1;
  as->rigid.width = as->by_cover.width = 3;
}

PetscErrorCode ContactAssemblyCreate(Contact contact, ContactParts parts, ContactAssembly *as)
{
  PetscFunctionBegin;
  PetscCall(PetscMemzero(as, sizeof(*as)));
  AssemblyStart(parts, as);
  if (contact->self) {
    PetscCall(PetscNew(&as->mortar));
    AssemblyStart(parts, as->mortar);
  }
  PetscCall(VecDuplicate(contact->rows.mass, &as->gap));
  PetscCall(VecZeroEntries(as->gap));
  PetscCall(VecDuplicate(as->gap, &as->cover));
  PetscCall(VecZeroEntries(as->cover));
  PetscCall(VecDuplicate(as->gap, &as->doubt));
  PetscCall(VecZeroEntries(as->doubt));
  PetscFunctionReturn(0);
}

/* Adds the derivatives of the weighted gaps of one facet's four rows with respect to the coordinates of the facet's
   vertices (smooth pairs) */
PetscErrorCode ContactAssemblyAddSlopes(ContactAssembly *as, const PetscInt row[4], const PetscInt node[4],
  const ContactSlopes *slopes)
{
  PetscFunctionBegin;
  for (PetscInt a = 0; a < 4; ++a) {
    PetscCall(ContactEntriesAdd(&as->rigid, row[a], 4, node, slopes->rigid[a]));
    PetscCall(ContactEntriesAdd(&as->by_cover, row[a], 4, node, slopes->cover[a]));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ContactAssemblyDestroy(ContactAssembly *as)
{
  PetscFunctionBegin;
  if (as->mortar) PetscCall(ContactAssemblyDestroy(as->mortar));
  PetscCall(PetscFree(as->mortar));
  PetscCall(ContactEntriesDestroy(&as->rigid));
  PetscCall(ContactEntriesDestroy(&as->by_cover));
  PetscCall(ContactEntriesDestroy(&as->coupling));
  PetscCall(VecDestroy(&as->cover));
  PetscCall(VecDestroy(&as->doubt));
  PetscCall(VecDestroy(&as->gap));
  PetscFunctionReturn(0);
}

/* Counts the unknowns of this rank */
static PetscErrorCode AssemblyCountUnknowns(Contact contact, PetscInt *n)
{
  Vec u;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(contact->dm, &u));
  PetscCall(VecGetLocalSize(u, n));
  PetscCall(DMRestoreGlobalVector(contact->dm, &u));
  PetscFunctionReturn(0);
}

/* Collective. Sums the assembly's couplings over facets and ranks, and distributes the rows of hanging vertices */
static PetscErrorCode CouplingCreate(Contact contact, ContactAssembly *as, Mat *coupling)
{
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(AssemblyCountUnknowns(contact, &n));
  PetscCall(ContactEntriesCreateMatrix(contact->comm, contact->rows.nlocal, n / 3, &as->coupling, coupling));
  PetscCall(ContactHangingRowsMatrix(contact, coupling));
  PetscFunctionReturn(0);
}

/* Lists in `kept` the local numbers of the rows that remain: their 1-norm, after division by the mass, is at least
   CONTACT_ROW_DROP times the largest 1-norm on all ranks */
static PetscErrorCode CouplingKeepRows(Contact contact, Mat coupling, PetscInt *nkept, PetscInt kept[])
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass;
  PetscInt           rstart;
  PetscReal         *norm, largest = 0.0;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(coupling, &rstart, NULL));
  PetscCall(PetscCalloc1(rows->nlocal, &norm));
  PetscCall(VecGetArrayRead(rows->weight, &mass));
  for (PetscInt i = 0; i < rows->nlocal; ++i) {
    const PetscScalar *value;
    PetscInt           n;

    PetscCall(MatGetRow(coupling, rstart + i, &n, NULL, &value));
    for (PetscInt c = 0; c < 3; ++c) {
      const PetscReal factor = rows->normal[3 * i + c] / PetscRealPart(mass[i]);

      for (PetscInt k = 0; k < n; ++k) norm[i] += PetscAbsScalar(value[k] * factor);
    }
    PetscCall(MatRestoreRow(coupling, rstart + i, &n, NULL, &value));
    largest = PetscMax(largest, norm[i]);
  }
  PetscCall(VecRestoreArrayRead(rows->weight, &mass));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, contact->comm));
  *nkept = 0;
  for (PetscInt i = 0; i < rows->nlocal; ++i) {
    if (norm[i] > 0.0 && norm[i] >= CONTACT_ROW_DROP * largest) kept[(*nkept)++] = i;
  }
  PetscCall(PetscFree(norm));
  PetscFunctionReturn(0);
}

/* Computes the columns and entries of one row of J, the couplings times the normal over the mass, without entries that
   are zero up to rounding */
static PetscErrorCode CouplingExpandRow(Mat coupling, PetscInt row, const PetscReal normal[3], PetscReal mass,
  PetscInt *n, PetscInt column[], PetscScalar entry[])
{
  const PetscReal    factor[3] = {normal[0] / mass, normal[1] / mass, normal[2] / mass};
  PetscReal          largest   = 0.0;
  PetscInt           nnodes;
  const PetscInt    *node;
  const PetscScalar *value;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(MatGetRow(coupling, row, &nnodes, &node, &value));
  for (PetscInt i = 0; i < 3 * nnodes; ++i) largest = PetscMax(largest, PetscAbsScalar(value[i / 3] * factor[i % 3]));
  for (PetscInt i = 0; i < 3 * nnodes; ++i) {
    if (PetscAbsScalar(value[i / 3] * factor[i % 3]) <= ENTRY_DROP * largest) continue;
    column[*n] = 3 * node[i / 3] + i % 3;
    entry[*n]  = value[i / 3] * factor[i % 3];
    ++*n;
  }
  PetscCall(MatRestoreRow(coupling, row, &nnodes, &node, &value));
  PetscFunctionReturn(0);
}

/* Computes the length of a matrix's longest row on this rank */
static PetscErrorCode CouplingLongestRow(Mat coupling, PetscInt *longest)
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

/* Collective. Assembles the entries into a matrix with a column per unknown, and distributes the rows of hanging
   vertices */
static PetscErrorCode SlopesCreateMatrix(Contact contact, ContactEntries *entries, Mat *mat)
{
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(AssemblyCountUnknowns(contact, &n));
  PetscCall(ContactEntriesCreateMatrix(contact->comm, contact->rows.nlocal, n, entries, mat));
  PetscCall(ContactHangingRowsMatrix(contact, mat));
  PetscFunctionReturn(0);
}

/*
   Subtracts from `slopes`, the derivative of int phi_A gap, the part that is due to the change of the covered area:
   (mean gap) times the derivative of int phi_A. A shrinking covered area would otherwise count as a shrinking gap.
   Under pressure the mean gap is zero, and nothing is subtracted.
*/
static PetscErrorCode SlopesHoldCover(Contact contact, ContactAssembly *as, ContactEntries *entries, Mat slopes)
{
  PetscInt           n;
  PetscScalar       *m;
  const PetscScalar *cover;
  Vec                mean;
  Mat                by_cover;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(as->gap, &mean));
  PetscCall(VecCopy(as->gap, mean));
  PetscCall(VecGetLocalSize(mean, &n));
  PetscCall(VecGetArray(mean, &m));
  PetscCall(VecGetArrayRead(as->cover, &cover));
  for (PetscInt i = 0; i < n; ++i) m[i] = PetscRealPart(cover[i]) > 0.0 ? m[i] / cover[i] : 0.0;
  PetscCall(VecRestoreArrayRead(as->cover, &cover));
  PetscCall(VecRestoreArray(mean, &m));
  PetscCall(SlopesCreateMatrix(contact, entries, &by_cover));
  PetscCall(MatDiagonalScale(by_cover, mean, NULL));
  PetscCall(MatAXPY(slopes, -1.0, by_cover, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&by_cover));
  PetscCall(VecDestroy(&mean));
  PetscFunctionReturn(0);
}

/* Collective. Computes the derivatives of the weighted gaps of smooth pairs [length^2], not yet divided by the masses,
   with patches that keep their shape. Rows of other pairs are empty. as: gaps and covered areas; part: the assembly
   itself, or its part of the mortar side */
static PetscErrorCode SlopesCreateRigid(Contact contact, ContactAssembly *as, ContactAssembly *part, Mat *rigid)
{
  PetscFunctionBegin;
  PetscCall(SlopesCreateMatrix(contact, &part->rigid, rigid));
  PetscCall(SlopesHoldCover(contact, as, &part->by_cover, *rigid));
  PetscFunctionReturn(0);
}

/* Computes the columns and entries of one row of J of a smooth pair, divided by the mass, without entries that are zero
   up to rounding */
static PetscErrorCode SlopesGetRow(Mat slopes, PetscInt row, PetscReal mass, PetscInt *n, PetscInt column[],
  PetscScalar entry[])
{
  PetscInt           ncols;
  const PetscInt    *cols;
  const PetscScalar *values;
  PetscReal          largest = 0.0;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(MatGetRow(slopes, row, &ncols, &cols, &values));
  for (PetscInt k = 0; k < ncols; ++k) largest = PetscMax(largest, PetscAbsScalar(values[k]));
  for (PetscInt k = 0; k < ncols; ++k) {
    if (PetscAbsScalar(values[k]) <= SLOPE_DROP * largest) continue;
    column[*n] = cols[k];
    entry[*n]  = values[k] / mass;
    ++*n;
  }
  PetscCall(MatRestoreRow(slopes, row, &ncols, &cols, &values));
  PetscFunctionReturn(0);
}

/* Computes the length of work arrays that hold the longest row of J */
static PetscErrorCode CouplingRowSpace(Mat coupling, Mat slopes, PetscInt *space)
{
  PetscInt longest = 0;

  PetscFunctionBegin;
  PetscCall(CouplingLongestRow(coupling, space));
  if (slopes) PetscCall(CouplingLongestRow(slopes, &longest));
  *space = PetscMax(3 * *space, longest);
  PetscFunctionReturn(0);
}

/* Collective. Assembles J for the rows that remain: first counts the entries of each row, then inserts them. slopes:
   derivatives of smooth pairs; NULL if there are none */
static PetscErrorCode CouplingCreateJacobian(Contact contact, Mat coupling, Mat slopes, PetscInt nkept,
  const PetscInt kept[], Mat *J)
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass;
  PetscInt           rstart, jstart = 0, nlocal, cstart, cend, space, *column, *diagonal, *offdiagonal;
  PetscScalar       *entry;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(coupling, &rstart, NULL));
  PetscCall(MatGetOwnershipRangeColumn(coupling, &cstart, &cend));
  nlocal = 3 * (cend - cstart);
  PetscCall(CouplingRowSpace(coupling, slopes, &space));
  PetscCall(PetscMalloc4(space, &column, space, &entry, nkept, &diagonal, nkept, &offdiagonal));
  PetscCall(VecGetArrayRead(rows->weight, &mass));
  PetscCall(MatCreate(contact->comm, J));
  PetscCall(MatSetSizes(*J, nkept, nlocal, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*J, MATAIJ));
  for (PetscInt pass = 0; pass < 2; ++pass) {
    PetscInt pair = 0;

    if (pass) {
      PetscCall(MatXAIJSetPreallocation(*J, 1, diagonal, offdiagonal, NULL, NULL));
      PetscCall(MatGetOwnershipRange(*J, &jstart, NULL));
    }
    for (PetscInt k = 0; k < nkept; ++k) {
      const PetscInt i = kept[k], row = jstart + k;
      PetscInt       n;

      while (i >= rows->first[pair + 1]) ++pair;
      if (slopes && contact->pairs[pair].mortar.patched)
        PetscCall(SlopesGetRow(slopes, rstart + i, PetscRealPart(mass[i]), &n, column, entry));
      else
        PetscCall(
          CouplingExpandRow(coupling, rstart + i, &rows->normal[3 * i], PetscRealPart(mass[i]), &n, column, entry));
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
  PetscCall(VecRestoreArrayRead(rows->weight, &mass));
  PetscCall(PetscFree4(column, entry, diagonal, offdiagonal));
  PetscFunctionReturn(0);
}

/* Fills gap, mass, vertex, pair and normal of the rows that remain */
static PetscErrorCode ContactAssemblyFillRows(Contact contact, const ContactAssembly *as, const PetscInt kept[],
  ContactLinearization lin)
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass, *gap, *doubt;
  PetscScalar       *m, *g, *d;
  PetscInt           pair = 0;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(lin->J, NULL, &lin->g));
  PetscCall(VecDuplicate(lin->g, &lin->mass));
  PetscCall(VecDuplicate(lin->g, &lin->doubt));
  PetscCall(PetscMalloc1(lin->nlocal, &lin->vertex));
  PetscCall(PetscMalloc1(lin->nlocal, &lin->pair));
  PetscCall(PetscMalloc1(3 * lin->nlocal, &lin->normal));
  PetscCall(VecGetArrayRead(rows->weight, &mass));
  PetscCall(VecGetArrayRead(as->gap, &gap));
  PetscCall(VecGetArrayRead(as->doubt, &doubt));
  PetscCall(VecGetArray(lin->doubt, &d));
  PetscCall(VecGetArray(lin->mass, &m));
  PetscCall(VecGetArray(lin->g, &g));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    const PetscInt i = kept[k];

    while (i >= rows->first[pair + 1]) ++pair;
    m[k]           = mass[i];
    g[k]           = gap[i] / mass[i];
    d[k]           = doubt[i] / mass[i];
    lin->vertex[k] = rows->vertex[i];
    lin->pair[k]   = pair;
    PetscCall(PetscArraycpy(&lin->normal[3 * k], &rows->normal[3 * i], 3));
  }
  PetscCall(VecRestoreArray(lin->g, &g));
  PetscCall(VecRestoreArray(lin->mass, &m));
  PetscCall(VecRestoreArray(lin->doubt, &d));
  PetscCall(VecRestoreArrayRead(as->doubt, &doubt));
  PetscCall(VecRestoreArrayRead(as->gap, &gap));
  PetscCall(VecRestoreArrayRead(rows->weight, &mass));
  PetscFunctionReturn(0);
}

/* Collective. If there are smooth pairs, creates J and lin->cover */
static PetscErrorCode LinearizationSetSmooth(Contact contact, ContactAssembly *as, Mat coupling, const PetscInt kept[],
  ContactLinearization lin)
{
  Mat rigid;

  PetscFunctionBegin;
  PetscCall(SlopesCreateRigid(contact, as, as, &rigid));
  PetscCall(CouplingCreateJacobian(contact, coupling, rigid, lin->nlocal, kept, &lin->J));
  PetscCall(CouplingCreateJacobian(contact, coupling, NULL, lin->nlocal, kept, &lin->cover));
  PetscCall(MatDestroy(&rigid));
  PetscFunctionReturn(0);
}

/* Sets the parts of J, cover and slip by the mortar side */
static PetscErrorCode LinearizationSetMortar(Contact contact, ContactAssembly *as, const PetscInt kept[],
  ContactLinearization lin)
{
  const PetscBool smooth = (PetscBool)(contact->smooth && as->parts != CONTACT_GAPS);
  Mat             coupling, rigid = NULL;

  PetscFunctionBegin;
  PetscCall(CouplingCreate(contact, as->mortar, &coupling));
  if (smooth) PetscCall(SlopesCreateRigid(contact, as, as->mortar, &rigid));
  PetscCall(CouplingCreateJacobian(contact, coupling, rigid, lin->nlocal, kept, &lin->mortar));
  if (smooth) PetscCall(CouplingCreateJacobian(contact, coupling, NULL, lin->nlocal, kept, &lin->mortar_cover));
  else PetscCall(MatDuplicate(lin->mortar, MAT_COPY_VALUES, &lin->mortar_cover));
  if (contact->frictional) PetscCall(ContactSlipCreateMortar(contact, coupling, kept, lin));
  PetscCall(MatDestroy(&rigid));
  PetscCall(MatDestroy(&coupling));
  PetscFunctionReturn(0);
}

/* Multiplies J and the other matrices by T (trace.c), so that forces on the facets' vertices become forces on the nodes
   of order 2. The mass and the covered area of a row remain those of the facets. */
static PetscErrorCode LinearizationSetTrace(Contact contact, ContactLinearization lin)
{
  PetscFunctionBegin;
  if (!lin->cover) PetscCall(MatDuplicate(lin->J, MAT_COPY_VALUES, &lin->cover));
  PetscCall(ContactTraceDifferentiate(contact->trace, lin->J));
  if (lin->slip) PetscCall(ContactTraceDifferentiate(contact->trace, lin->slip));
  if (lin->mortar) PetscCall(ContactTraceDifferentiate(contact->trace, lin->mortar));
  if (lin->mortar_slip) PetscCall(ContactTraceDifferentiate(contact->trace, lin->mortar_slip));
  PetscFunctionReturn(0);
}

/* Collective. Creates the linearization from the assembly */
PetscErrorCode ContactAssemblyFinish(Contact contact, ContactAssembly *as, ContactLinearization *lin)
{
  Mat       coupling;
  PetscInt *kept;

  PetscFunctionBegin;
  PetscCall(VecAssemblyBegin(as->gap));
  PetscCall(VecAssemblyEnd(as->gap));
  PetscCall(VecAssemblyBegin(as->cover));
  PetscCall(VecAssemblyEnd(as->cover));
  PetscCall(VecAssemblyBegin(as->doubt));
  PetscCall(VecAssemblyEnd(as->doubt));
  PetscCall(ContactHangingRowsVector(contact, as->gap));
  PetscCall(ContactHangingRowsVector(contact, as->cover));
  PetscCall(ContactHangingRowsVector(contact, as->doubt));
  PetscCall(CouplingCreate(contact, as, &coupling));
  PetscCall(PetscNew(lin));
  PetscCall(PetscMalloc1(contact->rows.nlocal, &kept));
  PetscCall(CouplingKeepRows(contact, coupling, &(*lin)->nlocal, kept));
  if (contact->smooth && as->parts != CONTACT_GAPS)
    PetscCall(LinearizationSetSmooth(contact, as, coupling, kept, *lin));
  else PetscCall(CouplingCreateJacobian(contact, coupling, NULL, (*lin)->nlocal, kept, &(*lin)->J));
  PetscCall(ContactAssemblyFillRows(contact, as, kept, *lin));
  if (contact->frictional) PetscCall(ContactSlipCreate(contact, coupling, kept, *lin));
  if (as->mortar) PetscCall(LinearizationSetMortar(contact, as, kept, *lin));
  if (contact->trace) PetscCall(LinearizationSetTrace(contact, *lin));
  PetscCall(ContactCyclicMerge(contact, *lin));
  (*lin)->gaps_only = (PetscBool)(as->parts == CONTACT_GAPS && contact->smooth);
  PetscCall(PetscFree(kept));
  PetscCall(MatDestroy(&coupling));
  PetscFunctionReturn(0);
}
