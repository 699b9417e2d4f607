/*
   Contact rows on the cuts of a sector with cyclic symmetry. A vertex of the second face of a cut and its image on the
   first face are one vertex of the whole body, with one row: the sum of both. The row of the image gets it. Slip is
   summed along the image's tangents, turned by the sector's angle for the other vertex.
*/
#include <mesh.h>
#include "assemblyimpl.h"

/* The vertices of the cut's second face that this rank owns, and their images on the first face */
typedef struct {
  PetscInt  n, *nodes, *images;
  PetscReal turn[3][3]; /* rotation minus 1 */
} CyclicCut;

struct _n_ContactCyclic {
  PetscInt   ncuts;
  CyclicCut *cuts;
};

/*@
  ContactSetCyclic - Sets the cyclic symmetries of the bodies of a contact

  Collective

  Input Parameters:
+ contact - the contact
. n       - number of cyclic symmetries
- cuts    - the cyclic symmetries

  Level: intermediate

  Note:
  Each symmetry has two faces, between which the bodies are cut. The row of a vertex on the second face is added to the
  row of its image on the first face.

.seealso: `ContactCreate()`, `MeshGetCyclicImages()`
@*/
PetscErrorCode ContactSetCyclic(Contact contact, PetscInt n, const SceneCyclic cuts[])
{
  PetscFunctionBegin;
  PetscCall(ContactCyclicDestroy(contact));
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscNew(&contact->cyclic));
  PetscCall(PetscCalloc1(n, &contact->cyclic->cuts));
  for (PetscInt k = 0; k < n; ++k) {
    CyclicCut *cut = &contact->cyclic->cuts[k];

    PetscCall(MeshGetCyclicImages(contact->dm, &cuts[k], cut->turn, &cut->n, &cut->nodes, &cut->images));
    ++contact->cyclic->ncuts;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ContactCyclicDestroy(Contact contact)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; contact->cyclic && k < contact->cyclic->ncuts; ++k) {
    PetscCall(PetscFree(contact->cyclic->cuts[k].nodes));
    PetscCall(PetscFree(contact->cyclic->cuts[k].images));
  }
  if (contact->cyclic) PetscCall(PetscFree(contact->cyclic->cuts));
  PetscCall(PetscFree(contact->cyclic));
  PetscFunctionReturn(0);
}

/* The rows of one pair as nodal fields: 1 + number of the row, and the two tangents of the row; 0 at nodes without a
   row */
typedef struct {
  Vec number, tangent[2];
} CyclicFields;

static PetscErrorCode CyclicFieldsCreate(Contact contact, CyclicFields *fields)
{
  PetscInt n;

  PetscFunctionBegin;
  for (PetscInt a = 0; a < 2; ++a) PetscCall(DMCreateGlobalVector(contact->dm, &fields->tangent[a]));
  PetscCall(VecGetLocalSize(fields->tangent[0], &n));
  PetscCall(VecCreateMPI(contact->comm, n / 3, PETSC_DETERMINE, &fields->number));
  PetscFunctionReturn(0);
}

/* Sets the fields for a pair. row[k]: number of row k of the linearization in the fields; negative: the row is left
   out */
static PetscErrorCode CyclicFieldsSet(Contact contact, const ContactLinearization lin, PetscInt pair,
  const PetscInt row[], CyclicFields *fields)
{
  PetscSection global;
  PetscScalar *number, *t[2];
  PetscInt     rstart;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(fields->number));
  PetscCall(VecGetOwnershipRange(fields->number, &rstart, NULL));
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  PetscCall(VecGetArray(fields->number, &number));
  for (PetscInt a = 0; a < 2; ++a) PetscCall(VecGetArray(fields->tangent[a], &t[a]));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    PetscInt offset;

    if (lin->pair[k] != pair) continue;
    PetscCall(PetscSectionGetOffset(global, lin->vertex[k], &offset));
    number[offset / 3 - rstart] = (PetscScalar)(row[k] + 1);
    for (PetscInt i = 0; lin->tangent && i < 6; ++i) t[i / 3][offset - 3 * rstart + i % 3] = lin->tangent[6 * k + i];
  }
  for (PetscInt a = 0; a < 2; ++a) PetscCall(VecRestoreArray(fields->tangent[a], &t[a]));
  PetscCall(VecRestoreArray(fields->number, &number));
  PetscFunctionReturn(0);
}

static PetscErrorCode CyclicFieldsDestroy(CyclicFields *fields)
{
  PetscFunctionBegin;
  for (PetscInt a = 0; a < 2; ++a) PetscCall(VecDestroy(&fields->tangent[a]));
  PetscCall(VecDestroy(&fields->number));
  PetscFunctionReturn(0);
}

/* Creates a sequential vector with the values of a field at the image nodes, `width` values per node */
static PetscErrorCode CyclicGatherImages(const CyclicCut *cut, PetscInt width, Vec field, Vec *gathered)
{
  IS from;

  PetscFunctionBegin;
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, width, cut->n, cut->images, PETSC_COPY_VALUES, &from));
  PetscCall(ContactGatherEntries(field, from, gathered));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(0);
}

/* Where the sums of a row are added. row: number of the new row; negative: not known yet. along: see CyclicTurn() */
typedef struct {
  PetscInt         row;
  PetscReal        along[2][2];
  const CyclicCut *cut; /* the cut between the vertex and its image; NULL: the vertex has no image */
} CyclicGoal;

/* Computes along[a][b] = (tangent a of the image, turned by the sector's angle) . (tangent b of the vertex) */
static void CyclicTurn(const CyclicCut *cut, const PetscScalar *const images[2], const PetscReal tangent[6],
  CyclicGoal *goal)
{
  for (PetscInt a = 0; a < 2; ++a) {
    PetscReal t[3], turned[3];

    for (PetscInt c = 0; c < 3; ++c) t[c] = PetscRealPart(images[a][c]);
    for (PetscInt c = 0; c < 3; ++c) turned[c] = t[c] + VectorDot(cut->turn[c], t);
    for (PetscInt b = 0; b < 2; ++b) goal->along[a][b] = VectorDot(turned, &tangent[3 * b]);
  }
}

/* Finds where the rows of one pair are added whose vertices have images with rows. rows: as in CyclicFieldsSet() */
static PetscErrorCode CyclicFindGoals(Contact contact, const ContactLinearization lin, PetscInt pair,
  const PetscInt rows[], CyclicFields *fields, CyclicGoal goals[])
{
  PetscInt     n, rstart, *local;
  PetscSection global;

  PetscFunctionBegin;
  PetscCall(CyclicFieldsSet(contact, lin, pair, rows, fields));
  PetscCall(VecGetLocalSize(fields->number, &n));
  PetscCall(VecGetOwnershipRange(fields->number, &rstart, NULL));
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  PetscCall(PetscMalloc1(n, &local));
  for (PetscInt i = 0; i < n; ++i) local[i] = -1;
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(global, lin->vertex[k], &offset));
    if (lin->pair[k] == pair) local[offset / 3 - rstart] = k;
  }
  for (PetscInt c = 0; c < contact->cyclic->ncuts; ++c) {
    const CyclicCut   *cut = &contact->cyclic->cuts[c];
    Vec                gathered[3];
    const PetscScalar *number, *t[2];

    PetscCall(CyclicGatherImages(cut, 1, fields->number, &gathered[2]));
    PetscCall(VecGetArrayRead(gathered[2], &number));
    for (PetscInt a = 0; a < 2; ++a) {
      PetscCall(CyclicGatherImages(cut, 3, fields->tangent[a], &gathered[a]));
      PetscCall(VecGetArrayRead(gathered[a], &t[a]));
    }
    for (PetscInt i = 0; i < cut->n; ++i) {
      const PetscInt     k     = local[cut->nodes[i] - rstart];
      const PetscScalar *at[2] = {&t[0][3 * i], &t[1][3 * i]};

      if (k < 0 || cut->nodes[i] == cut->images[i] || !(PetscRealPart(number[i]) > 0.0)) continue;
      goals[k].row = (PetscInt)PetscRealPart(number[i]) - 1;
      goals[k].cut = cut;
      if (lin->tangent) CyclicTurn(cut, at, &lin->tangent[6 * k], &goals[k]);
    }
    for (PetscInt a = 0; a < 2; ++a) PetscCall(VecRestoreArrayRead(gathered[a], &t[a]));
    PetscCall(VecRestoreArrayRead(gathered[2], &number));
    for (PetscInt a = 0; a < 3; ++a) PetscCall(VecDestroy(&gathered[a]));
  }
  PetscCall(PetscFree(local));
  PetscFunctionReturn(0);
}

/* Finds the goals of all rows. *nkept: number of new rows of this rank; kept[]: the old row from which each new row
   takes its vertex */
static PetscErrorCode CyclicSetGoals(Contact contact, const ContactLinearization lin, CyclicGoal goals[],
  PetscInt *nkept, PetscInt kept[])
{
  CyclicFields fields;
  PetscInt    *rows, first;

  PetscFunctionBegin;
  PetscCall(CyclicFieldsCreate(contact, &fields));
  PetscCall(PetscMalloc1(lin->nlocal, &rows));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    rows[k]  = 0;
    goals[k] = (CyclicGoal){-1, {{1.0, 0.0}, {0.0, 1.0}}, NULL};
  }
  for (PetscInt p = 0; p < contact->npairs; ++p) PetscCall(CyclicFindGoals(contact, lin, p, rows, &fields, goals));
  *nkept = 0;
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    rows[k] = -1;
    if (goals[k].row >= 0) continue;
    rows[k]          = *nkept;
    kept[(*nkept)++] = k;
  }
  PetscCallMPI(MPI_Scan(nkept, &first, 1, MPIU_INT, MPI_SUM, contact->comm));
  first -= *nkept;
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    if (rows[k] >= 0) goals[k].row = rows[k] += first;
  }
  for (PetscInt p = 0; p < contact->npairs; ++p) PetscCall(CyclicFindGoals(contact, lin, p, rows, &fields, goals));
  PetscCall(PetscFree(rows));
  PetscCall(CyclicFieldsDestroy(&fields));
  PetscFunctionReturn(0);
}

/* Creates the matrix that maps values of the new rows to values of the old rows. width: 1, or 2 for the rows of slip */
static PetscErrorCode CyclicCreateMerge(Contact contact, PetscInt width, PetscInt n, const CyclicGoal goals[],
  PetscInt nkept, Mat *merge)
{
  PetscInt start;

  PetscFunctionBegin;
  PetscCall(MatCreateAIJ(contact->comm, width * n, width * nkept, PETSC_DETERMINE, PETSC_DETERMINE, width, NULL, width,
    NULL, merge));
  PetscCall(MatGetOwnershipRange(*merge, &start, NULL));
  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt e = 0; e < width * width; ++e)
      PetscCall(MatSetValue(*merge, start + width * k + e / width, width * goals[k].row + e % width,
        width == 1 ? 1.0 : goals[k].along[e % 2][e / 2], INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*merge, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*merge, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Computes rows = diag(1/mass) merge^T diag(old_mass) rows, which adds rows that are divided by their masses. A
   matrix that is NULL remains NULL. */
static PetscErrorCode CyclicMergeMatrix(Mat merge, Vec old_mass, Vec mass, Mat *rows)
{
  Mat sums;

  PetscFunctionBegin;
  if (!*rows) PetscFunctionReturn(0);
  PetscCall(MatDiagonalScale(*rows, old_mass, NULL));
  PetscCall(MatTransposeMatMult(merge, *rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &sums));
  PetscCall(VecReciprocal(mass));
  PetscCall(MatDiagonalScale(sums, mass, NULL));
  PetscCall(VecReciprocal(mass));
  PetscCall(MatDestroy(rows));
  *rows = sums;
  PetscFunctionReturn(0);
}

/* Creates a vector in which each value of `mass` occurs twice */
static PetscErrorCode CyclicDouble(Vec mass, Vec *twice)
{
  const PetscScalar *m;
  PetscScalar       *t;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(mass, &n));
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)mass), 2 * n, PETSC_DETERMINE, twice));
  PetscCall(VecGetArrayRead(mass, &m));
  PetscCall(VecGetArrayWrite(*twice, &t));
  for (PetscInt i = 0; i < 2 * n; ++i) t[i] = m[i / 2];
  PetscCall(VecRestoreArrayWrite(*twice, &t));
  PetscCall(VecRestoreArrayRead(mass, &m));
  PetscFunctionReturn(0);
}

/* Adds the slip rows, and the covered areas, of each vertex and its image */
static PetscErrorCode CyclicMergeSlip(Contact contact, Mat merge, const CyclicGoal goals[], PetscInt nkept,
  Vec old_mass, Vec mass, ContactLinearization lin)
{
  Mat          pairs;
  Vec          before, after;
  PetscScalar *a;

  PetscFunctionBegin;
  if (!lin->slip) PetscFunctionReturn(0);
  PetscCall(CyclicCreateMerge(contact, 2, lin->nlocal, goals, nkept, &pairs));
  PetscCall(CyclicDouble(old_mass, &before));
  PetscCall(CyclicDouble(mass, &after));
  PetscCall(CyclicMergeMatrix(pairs, before, after, &lin->slip));
  PetscCall(VecDestroy(&after));
  PetscCall(VecDestroy(&before));
  PetscCall(MatDestroy(&pairs));
  PetscCall(VecDuplicate(old_mass, &before));
  PetscCall(VecDuplicate(mass, &after));
  PetscCall(VecGetArrayWrite(before, &a));
  for (PetscInt k = 0; k < lin->nlocal; ++k) a[k] = lin->covered[k];
  PetscCall(VecRestoreArrayWrite(before, &a));
  PetscCall(MatMultTranspose(merge, before, after));
  PetscCall(VecGetArray(after, &a));
  for (PetscInt k = 0; k < nkept; ++k) lin->covered[k] = PetscRealPart(a[k]);
  PetscCall(VecRestoreArray(after, &a));
  PetscCall(VecDestroy(&after));
  PetscCall(VecDestroy(&before));
  PetscFunctionReturn(0);
}

/* Computes for each row the sum of its vectors over the nodes of the mortar faces. rows: matrix whose entries are
   the vectors; first: index, 0 or 3, at which the three components are stored in the six sums of a row */
static PetscErrorCode CyclicSumMortar(Contact contact, const ContactLinearization lin, Mat rows, PetscInt first,
  PetscReal sums[])
{
  Vec                mark, sum;
  const PetscScalar *s;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(rows, &mark, &sum));
  for (PetscInt p = 0; p < 3 * contact->npairs; ++p) {
    const ContactSurface *mortar = &contact->pairs[p / 3].mortar;

    PetscCall(VecZeroEntries(mark));
    for (PetscInt i = 0; i < 4 * mortar->nfacets; ++i)
      PetscCall(VecSetValue(mark, 3 * mortar->node[i] + p % 3, 1.0, INSERT_VALUES));
    PetscCall(VecAssemblyBegin(mark));
    PetscCall(VecAssemblyEnd(mark));
    PetscCall(MatMult(rows, mark, sum));
    PetscCall(VecGetArrayRead(sum, &s));
    for (PetscInt k = 0; k < lin->nlocal; ++k)
      if (lin->pair[k] == p / 3) sums[6 * k + first + p % 3] = PetscRealPart(s[k]);
    PetscCall(VecRestoreArrayRead(sum, &s));
  }
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

/* Computes lin->mortar_sum of the new rows. The vectors of an image's row are turned back to the vertex that has the
   new row. */
static PetscErrorCode CyclicSetSums(Contact contact, const CyclicGoal goals[], PetscInt nkept, Vec mass,
  ContactLinearization lin)
{
  const PetscScalar *m;
  PetscReal         *old;
  PetscScalar       *s;
  Vec                sums;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(6 * lin->nlocal, &old));
  PetscCall(CyclicSumMortar(contact, lin, lin->J, 0, old));
  PetscCall(CyclicSumMortar(contact, lin, lin->cover ? lin->cover : lin->J, 3, old));
  PetscCall(VecCreateMPI(contact->comm, 6 * nkept, PETSC_DETERMINE, &sums));
  PetscCall(VecGetArrayRead(lin->mass, &m));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    const CyclicCut *cut = goals[k].cut;

    for (PetscInt e = 0; e < 6; ++e) {
      const PetscReal *v    = &old[6 * k + e - e % 3];
      PetscReal        back = v[e % 3];

      for (PetscInt c = 0; cut && c < 3; ++c) back += cut->turn[c][e % 3] * v[c];
      PetscCall(VecSetValue(sums, 6 * goals[k].row + e, back * PetscRealPart(m[k]), ADD_VALUES));
    }
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &m));
  PetscCall(VecAssemblyBegin(sums));
  PetscCall(VecAssemblyEnd(sums));
  PetscCall(PetscFree(old));
  PetscCall(PetscMalloc1(6 * nkept + 1, &lin->mortar_sum)); /* must not be NULL on ranks without rows */
  PetscCall(VecGetArrayRead(mass, &m));
  PetscCall(VecGetArray(sums, &s));
  for (PetscInt e = 0; e < 6 * nkept; ++e) lin->mortar_sum[e] = PetscRealPart(s[e] / m[e / 6]);
  PetscCall(VecRestoreArray(sums, &s));
  PetscCall(VecRestoreArrayRead(mass, &m));
  PetscCall(VecDestroy(&sums));
  PetscFunctionReturn(0);
}

/* Moves the data of the remaining rows to the front of the arrays */
static void CyclicMoveRows(PetscInt nkept, const PetscInt kept[], ContactLinearization lin)
{
  for (PetscInt k = 0; k < nkept; ++k) {
    lin->vertex[k] = lin->vertex[kept[k]];
    lin->pair[k]   = lin->pair[kept[k]];
    for (PetscInt c = 0; c < 3; ++c) lin->normal[3 * k + c] = lin->normal[3 * kept[k] + c];
    for (PetscInt c = 0; lin->tangent && c < 6; ++c) lin->tangent[6 * k + c] = lin->tangent[6 * kept[k] + c];
  }
  lin->nlocal = nkept;
}

/* Replaces means of the old rows by those of the merged rows, weighted by the masses */
static PetscErrorCode CyclicMergeMeans(Mat merge, Vec oldmass, Vec mass, Vec *mean)
{
  Vec merged;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(mass, &merged));
  PetscCall(VecPointwiseMult(*mean, *mean, oldmass));
  PetscCall(MatMultTranspose(merge, *mean, merged));
  PetscCall(VecQuotient_AMGF(merged, merged, mass));
  PetscCall(VecDestroy(mean));
  *mean = merged;
  PetscFunctionReturn(0);
}

/* Collective. Replaces the rows of a vertex and of its image by one row */
PetscErrorCode ContactCyclicMerge(Contact contact, ContactLinearization lin)
{
  PetscInt    nkept, *kept;
  CyclicGoal *goals;
  Mat         merge;
  Vec         mass;

  PetscFunctionBegin;
  if (!contact->cyclic) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(lin->nlocal, &goals, lin->nlocal, &kept));
  PetscCall(CyclicSetGoals(contact, lin, goals, &nkept, kept));
  PetscCall(CyclicCreateMerge(contact, 1, lin->nlocal, goals, nkept, &merge));
  PetscCall(MatCreateVecs(merge, &mass, NULL));
  PetscCall(MatMultTranspose(merge, lin->mass, mass));
  PetscCall(CyclicSetSums(contact, goals, nkept, mass, lin));
  PetscCall(CyclicMergeMeans(merge, lin->mass, mass, &lin->g));
  PetscCall(CyclicMergeMeans(merge, lin->mass, mass, &lin->doubt));
  PetscCall(CyclicMergeMatrix(merge, lin->mass, mass, &lin->J));
  PetscCall(CyclicMergeMatrix(merge, lin->mass, mass, &lin->cover));
  PetscCall(CyclicMergeSlip(contact, merge, goals, nkept, lin->mass, mass, lin));
  CyclicMoveRows(nkept, kept, lin);
  PetscCall(VecDestroy(&lin->mass));
  lin->mass = mass;
  PetscCall(MatDestroy(&merge));
  PetscCall(PetscFree2(goals, kept));
  PetscFunctionReturn(0);
}
