/* All possible rows, one per nonmortar vertex and pair, and their lumped masses. They do not change as long as the mesh
   does not change. */
#include <petscsf.h>
#include "assemblyimpl.h"

/* Collective. Creates a sequential vector with the entries `from` of v, which other ranks may own */
PetscErrorCode ContactGatherEntries(Vec v, IS from, Vec *gathered)
{
  VecScatter scatter;
  PetscInt   n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(from, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, gathered));
  PetscCall(VecScatterCreate(v, from, *gathered, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, v, *gathered, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, v, *gathered, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterDestroy(&scatter));
  PetscFunctionReturn(0);
}

/* Sets marked[v] to 1 for the vertices of this rank's facets and for vertices that this rank owns of other ranks'
   facets, and to 0 for other points */
static PetscErrorCode RowsMarkVertices(PetscSF sf, PetscBool parallel, const ContactSurface *s, PetscInt npoints,
  PetscInt marked[])
{
  PetscFunctionBegin;
  PetscCall(PetscArrayzero(marked, npoints));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) marked[s->vertex[i]] = 1;
  if (parallel) {
    PetscCall(PetscSFReduceBegin(sf, MPIU_INT, marked, marked, MPI_MAX));
    PetscCall(PetscSFReduceEnd(sf, MPIU_INT, marked, marked, MPI_MAX));
  }
  PetscFunctionReturn(0);
}

/* Appends the marked vertices that this rank owns to rows->vertex, which has space for *size of them */
static PetscErrorCode RowsAppend(PetscSection global, PetscInt npoints, const PetscInt marked[], ContactRows *rows,
  PetscInt *size)
{
  PetscFunctionBegin;
  for (PetscInt v = 0; v < npoints; ++v) {
    PetscInt offset;

    if (!marked[v]) continue;
    PetscCall(PetscSectionGetOffset(global, v, &offset));
    if (offset < 0) continue;
    if (rows->nlocal == *size) {
      *size = 2 * (*size) + 64;
      PetscCall(PetscRealloc(*size * sizeof(PetscInt), &rows->vertex));
    }
    rows->vertex[rows->nlocal++] = v;
  }
  PetscFunctionReturn(0);
}

/* Numbers the rows of pair p on all ranks, and sets the global row of each vertex of the pair's facets. number: work
   array */
static PetscErrorCode RowsShare(PetscSF sf, PetscBool parallel, PetscInt rstart, ContactRows *rows, PetscInt p,
  ContactPairData *pair, PetscInt npoints, PetscInt number[])
{
  PetscFunctionBegin;
  PetscCall(PetscArrayzero(number, npoints));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) number[rows->vertex[i]] = rstart + i;
  if (parallel) {
    PetscCall(PetscSFBcastBegin(sf, MPIU_INT, number, number, MPI_REPLACE));
    PetscCall(PetscSFBcastEnd(sf, MPIU_INT, number, number, MPI_REPLACE));
  }
  PetscCall(PetscMalloc2(4 * pair->nonmortar.nfacets, &pair->row, 12 * pair->nonmortar.nfacets, &pair->normal));
  for (PetscInt i = 0; i < 4 * pair->nonmortar.nfacets; ++i) pair->row[i] = number[pair->nonmortar.vertex[i]];
  PetscFunctionReturn(0);
}

/* Collective. Computes rows->mass, the lumped mass int phi_A of the undeformed nonmortar faces [length^2] */
static PetscErrorCode RowsCreateMass(Contact contact)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  PetscCall(VecCreate(contact->comm, &rows->mass));
  PetscCall(VecSetSizes(rows->mass, rows->nlocal, PETSC_DECIDE));
  PetscCall(VecSetType(rows->mass, VECSTANDARD));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];

    for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
      PetscReal   m[4];
      PetscScalar mass[4];

      (void)ContactFacetMass(&pair->nonmortar.reference[12 * f], m);
      for (PetscInt a = 0; a < 4; ++a) mass[a] = m[a];
      PetscCall(VecSetValues(rows->mass, 4, &pair->row[4 * f], mass, ADD_VALUES));
    }
  }
  PetscCall(VecAssemblyBegin(rows->mass));
  PetscCall(VecAssemblyEnd(rows->mass));
  PetscFunctionReturn(0);
}

/* Collective. Creates all rows, and their masses */
PetscErrorCode ContactRowsCreate(Contact contact)
{
  ContactRows *rows = &contact->rows;
  PetscInt     npoints, nroots, size = 0, rstart, *number;
  PetscSection global;
  PetscSF      sf;
  PetscBool    parallel;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(contact->dm, NULL, &npoints));
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  PetscCall(DMGetPointSF(contact->dm, &sf));
  PetscCall(PetscSFGetGraph(sf, &nroots, NULL, NULL, NULL));
  parallel = (PetscBool)(nroots >= 0);
  PetscCall(PetscMalloc1(npoints, &number));
  PetscCall(PetscCalloc1(contact->npairs + 1, &rows->first));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    PetscCall(RowsMarkVertices(sf, parallel, &contact->pairs[p].nonmortar, npoints, number));
    PetscCall(RowsAppend(global, npoints, number, rows, &size));
    rows->first[p + 1] = rows->nlocal;
  }
  PetscCallMPI(MPI_Scan(&rows->nlocal, &rstart, 1, MPIU_INT, MPI_SUM, contact->comm));
  rstart -= rows->nlocal;
  for (PetscInt p = 0; p < contact->npairs; ++p)
    PetscCall(RowsShare(sf, parallel, rstart, rows, p, &contact->pairs[p], npoints, number));
  PetscCall(PetscFree(number));
  PetscCall(PetscMalloc2(3 * rows->nlocal, &rows->normal, 3 * rows->nlocal, &rows->x));
  PetscCall(PetscCalloc1(rows->nlocal, &rows->at_corner));
  PetscCall(RowsCreateMass(contact));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactRowsDestroy(Contact contact)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) PetscCall(PetscFree2(contact->pairs[p].row, contact->pairs[p].normal));
  PetscCall(PetscFree(rows->first));
  PetscCall(PetscFree(rows->vertex));
  PetscCall(PetscFree(rows->no_slip));
  PetscCall(PetscFree2(rows->normal, rows->x));
  PetscCall(PetscFree(rows->at_corner));
  PetscCall(VecDestroy(&rows->mass));
  PetscCall(VecDestroy(&rows->weight));
  PetscCall(MatDestroy(&rows->hanging));
  PetscFunctionReturn(0);
}
