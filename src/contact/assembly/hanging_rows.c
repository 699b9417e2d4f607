/*
   The rows of hanging vertices. On the nonmortar face the displacement of a hanging vertex is the mean of the
   displacements of 2 or 4 other vertices, and its multiplier is the mean of theirs. The sums of its row, in which phi_A
   is its bilinear function, are added to the rows of those vertices with weights 1/2 or 1/4. Its own row becomes empty.
   So does that of the node in the middle of a serendipity facet, whose multiplier is the mean of those in the middle of
   the four edges.
*/
#include <mesh.h>
#include "assemblyimpl.h"

/* Sets `number` to 1 + the row of pair p at each node that has a row, and to 0 at other nodes */
static PetscErrorCode HangingRowsNumberRows(Contact contact, PetscInt p, Vec number)
{
  const ContactRows *rows = &contact->rows;
  PetscSection       global;
  PetscInt           rstart;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(number));
  PetscCall(VecGetOwnershipRange(rows->mass, &rstart, NULL));
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(global, rows->vertex[i], &offset));
    PetscCall(VecSetValue(number, offset / 3, (PetscScalar)(rstart + i + 1), INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(number));
  PetscCall(VecAssemblyEnd(number));
  PetscFunctionReturn(0);
}

/* Counts the nodes on which the hanging nodes of this rank depend, and lists their columns in order unless columns is
   NULL */
static PetscErrorCode HangingRowsListMeans(Mat means, PetscInt *n, PetscInt columns[])
{
  PetscInt start, end;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  for (PetscInt i = start; i < end; ++i) {
    PetscInt        length;
    const PetscInt *node;

    PetscCall(MatGetRow(means, i, &length, &node, NULL));
    if (columns) PetscCall(PetscArraycpy(&columns[*n], node, length));
    *n += length;
    PetscCall(MatRestoreRow(means, i, &length, &node, NULL));
  }
  PetscFunctionReturn(0);
}

/* Creates a sequential vector with the values of `number` at the nodes on which hanging nodes depend, in the order of
   HangingRowsListMeans() */
static PetscErrorCode HangingRowsGather(Mat means, Vec number, Vec *gathered)
{
  PetscInt n, *columns;
  IS       from;

  PetscFunctionBegin;
  PetscCall(HangingRowsListMeans(means, &n, NULL));
  PetscCall(PetscMalloc1(n, &columns));
  PetscCall(HangingRowsListMeans(means, &n, columns));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, columns, PETSC_OWN_POINTER, &from));
  PetscCall(ContactGatherEntries(number, from, gathered));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(0);
}

/* Fills the matrix that distributes the rows of a pair. An ordinary row has the entry 1 on the diagonal. The row of a
   hanging vertex has the weights of the vertices on which it depends, if all of these have a row. Negative weights
   count as 0, and the others are scaled to the sum 1. */
static PetscErrorCode HangingRowsFill(Mat means, Vec number, Vec gathered, Mat share)
{
  PetscInt           start, end, k = 0;
  const PetscScalar *own, *to;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  PetscCall(VecGetArrayRead(number, &own));
  PetscCall(VecGetArrayRead(gathered, &to));
  for (PetscInt i = start; i < end; ++i) {
    const PetscInt     row = (PetscInt)PetscRealPart(own[i - start]) - 1;
    PetscInt           n;
    const PetscScalar *weight;
    PetscReal          sum = 0.0;
    PetscBool          all = PETSC_TRUE;

    PetscCall(MatGetRow(means, i, &n, NULL, &weight));
    for (PetscInt j = 0; j < n; ++j) {
      if (PetscRealPart(weight[j]) < 0.0) continue;
      all = (PetscBool)(all && PetscRealPart(to[k + j]) > 0.0);
      sum += PetscRealPart(weight[j]);
    }
    if (row >= 0 && !(n && all)) PetscCall(MatSetValue(share, row, row, 1.0, INSERT_VALUES));
    for (PetscInt j = 0; row >= 0 && all && j < n; ++j) {
      if (PetscRealPart(weight[j]) < 0.0) continue;
      PetscCall(MatSetValue(share, row, (PetscInt)PetscRealPart(to[k + j]) - 1, weight[j] / sum, INSERT_VALUES));
    }
    k += n;
    PetscCall(MatRestoreRow(means, i, &n, NULL, &weight));
  }
  PetscCall(VecRestoreArrayRead(gathered, &to));
  PetscCall(VecRestoreArrayRead(number, &own));
  PetscFunctionReturn(0);
}

/* Collective. Computes rows->weight, the masses after their distribution by rows->hanging */
PetscErrorCode ContactHangingRowsWeigh(ContactRows *rows)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&rows->weight));
  PetscCall(VecDuplicate(rows->mass, &rows->weight));
  PetscCall(MatMultTranspose(rows->hanging, rows->mass, rows->weight));
  PetscFunctionReturn(0);
}

/* Collective. Creates rows->hanging, which is NULL if no vertex of the mesh hangs, and rows->weight, the masses after
   their distribution */
PetscErrorCode ContactHangingRowsCreate(Contact contact)
{
  ContactRows *rows = &contact->rows;
  Mat          means;
  Vec          number, gathered;

  PetscFunctionBegin;
  PetscCall(MeshGetDependent(contact->dm, &means));
  PetscCall(PetscObjectReference((PetscObject)rows->mass));
  rows->weight = rows->mass;
  if (!means) PetscFunctionReturn(0);
  PetscCall(MatCreateAIJ(contact->comm, rows->nlocal, rows->nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 4, NULL,
    &rows->hanging));
  PetscCall(MatCreateVecs(means, &number, NULL));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    PetscCall(HangingRowsNumberRows(contact, p, number));
    PetscCall(HangingRowsGather(means, number, &gathered));
    PetscCall(HangingRowsFill(means, number, gathered, rows->hanging));
    PetscCall(VecDestroy(&gathered));
  }
  PetscCall(VecDestroy(&number));
  PetscCall(MatAssemblyBegin(rows->hanging, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(rows->hanging, MAT_FINAL_ASSEMBLY));
  PetscCall(ContactHangingRowsWeigh(rows));
  PetscFunctionReturn(0);
}

/* Distributes the values of hanging vertices' rows, in a vector with one value per row, to the rows of other
   vertices */
PetscErrorCode ContactHangingRowsVector(Contact contact, Vec sums)
{
  Vec own;

  PetscFunctionBegin;
  if (!contact->rows.hanging) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(sums, &own));
  PetscCall(VecCopy(sums, own));
  PetscCall(MatMultTranspose(contact->rows.hanging, own, sums));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(0);
}

/* Collective. Distributes the rows of hanging vertices in a matrix with one row per contact row, by replacing *sums */
PetscErrorCode ContactHangingRowsMatrix(Contact contact, Mat *sums)
{
  Mat shared;

  PetscFunctionBegin;
  if (!contact->rows.hanging) PetscFunctionReturn(0);
  PetscCall(MatTransposeMatMult(contact->rows.hanging, *sums, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &shared));
  PetscCall(MatDestroy(sums));
  *sums = shared;
  PetscFunctionReturn(0);
}
