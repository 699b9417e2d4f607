/*
   Extracts matrices on W. Gathers data of the reduced problem on the first rank, which solves it, and distributes
   results: rows of matrices, restricted to the columns of W, entries of vectors, and errors
*/
#include "subspaceimpl.h"

/*
   Selection of rows of a matrix A that are gathered on the first rank, restricted to the columns of W. half: A stores
   its upper triangle only.
*/
typedef struct {
  PetscInt        nrows, M;
  const PetscInt *rows, *place; /* local rows of A, and the numbers of these rows in the result, which has M rows */
  PetscInt        nw;
  const PetscInt *w;
  PetscBool       half;
  PetscBool       symmetric; /* zeros are stored as well: ordering codes need a symmetric pattern, and one of two
                                transposed entries may be zero */
} Gather;

/*
   Inserts the entries of one row into S, or, if S is NULL, counts them in the rows of S. If A stores its upper triangle
   only, the transposed entries are inserted too; diagonal blocks are stored completely.
*/
static PetscErrorCode GatherRow(Mat A, const Gather *g, PetscInt r, PetscInt column[], PetscScalar entry[],
  PetscInt counts[], Mat S)
{
  const PetscInt    *columns, row = g->place[r];
  const PetscScalar *values;
  PetscInt           nc, place, next = 0, n = 0, nmirror = 0;

  PetscFunctionBegin;
  PetscCall(MatGetRow(A, g->rows[r], &nc, &columns, &values));
  for (PetscInt k = 0; k < nc; k++) {
    place = next;
    if (place >= g->nw || g->w[place] != columns[k]) PetscCall(PetscFindInt(columns[k], g->nw, g->w, &place));
    if (place >= 0) next = place + 1; /* where the next column is if it, too, is the next one in W */
    if (place < 0 || (values[k] == 0.0 && !g->symmetric) || (g->half && columns[k] < g->rows[r])) continue;
    if (S) {
      column[n] = place;
      entry[n]  = values[k];
    } else if (g->half && place != row) counts[place]++;
    n++;
  }
  PetscCall(MatRestoreRow(A, g->rows[r], &nc, &columns, &values));
  if (S) {
    nmirror = g->half && n && column[0] == row;
    PetscCall(MatSetValues(S, 1, &row, n, column, entry, INSERT_VALUES));
    if (g->half) PetscCall(MatSetValues(S, n - nmirror, column + nmirror, 1, &row, entry + nmirror, INSERT_VALUES));
  } else counts[row] += n;
  PetscFunctionReturn(0);
}

/* Creates the matrix of the selected rows. rows, columns: its sizes on this rank */
static PetscErrorCode GatherMatrix(Mat A, const Gather *g, PetscInt rows, PetscInt columns, Mat *S)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)A);
  PetscInt      *counts, *column, start;
  PetscMPIInt    nrows;
  PetscScalar   *entry;

  PetscFunctionBegin;
  PetscCall(PetscCalloc3(g->M, &counts, g->nw, &column, g->nw, &entry));
  if (g->half) PetscCall(MatGetRowUpperTriangular(A));
  for (PetscInt r = 0; r < g->nrows; r++) PetscCall(GatherRow(A, g, r, column, entry, counts, NULL));
  PetscCall(PetscMPIIntCast(g->M, &nrows));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, nrows, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Scan(&rows, &start, 1, MPIU_INT, MPI_SUM, comm));
  PetscCall(IPMatrixCreate(comm, rows, columns, counts + start - rows, S));
  for (PetscInt r = 0; r < g->nrows; r++) PetscCall(GatherRow(A, g, r, column, entry, counts, *S));
  if (g->half) PetscCall(MatRestoreRowUpperTriangular(A));
  PetscCall(MatAssemblyBegin(*S, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*S, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree3(counts, column, entry));
  PetscFunctionReturn(0);
}

/* Gathers the selected rows on the first rank. S: NULL on the other ranks */
static PetscErrorCode GatherOnFirst(Mat A, const Gather *g, PetscBool first, Mat *S)
{
  Mat all, diagonal;

  PetscFunctionBegin;
  PetscCall(GatherMatrix(A, g, first ? g->M : 0, first ? g->nw : 0, &all));
  PetscCall(MatGetDiagonalBlock(all, &diagonal));
  *S = NULL;
  if (first) {
    PetscCall(PetscObjectReference((PetscObject)diagonal));
    *S = diagonal;
  }
  PetscCall(MatDestroy(&all));
  PetscFunctionReturn(0);
}

/* Extracts K_WW. own: the rows of K that belong to W; gather: whether the first rank gets it all, in a sequential
   matrix, and the other ranks NULL */
PetscErrorCode IPGatherStiffness(Mat K, IS own, PetscBool gather, Mat *S)
{
  Gather      g = {.symmetric = PETSC_TRUE};
  PetscInt   *place, start;
  PetscMPIInt rank;
  IS          all;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompareAny((PetscObject)K, &g.half, MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(ISAllGather(own, &all));
  PetscCall(ISGetSize(all, &g.nw));
  PetscCall(ISGetIndices(all, &g.w));
  g.M = g.nw;
  PetscCall(ISGetLocalSize(own, &g.nrows));
  PetscCall(ISGetIndices(own, &g.rows));
  PetscCall(PetscMalloc1(g.nrows, &place));
  PetscCallMPI(MPI_Scan(&g.nrows, &start, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)K)));
  for (PetscInt r = 0; r < g.nrows; r++) place[r] = start - g.nrows + r;
  g.place = place;
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)K), &rank));
  if (gather) PetscCall(GatherOnFirst(K, &g, (PetscBool)!rank, S));
  else PetscCall(GatherMatrix(K, &g, g.nrows, g.nrows, S));
  PetscCall(PetscFree(place));
  PetscCall(ISRestoreIndices(own, &g.rows));
  PetscCall(ISRestoreIndices(all, &g.w));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

/* Gathers the rows of J, restricted to the columns w */
PetscErrorCode IPGatherRows(Mat J, PetscInt nw, const PetscInt w[], PetscBool first, Mat *S)
{
  Gather    g = {.nw = nw, .w = w};
  PetscInt *rows, start, end;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(J, &start, &end));
  PetscCall(MatGetSize(J, &g.M, NULL));
  g.nrows = end - start;
  PetscCall(PetscMalloc1(g.nrows, &rows));
  for (PetscInt r = 0; r < g.nrows; r++) rows[r] = start + r;
  g.rows = g.place = rows;
  PetscCall(GatherOnFirst(J, &g, first, S));
  PetscCall(PetscFree(rows));
  PetscFunctionReturn(0);
}

/* Broadcasts the first rank's verdict. An error on the first rank is raised on all ranks. */
PetscErrorCode IPReducedBroadcast(const IPReduced *r, PetscErrorCode error, PetscBool *verdict)
{
  PetscMPIInt said[2] = {(PetscMPIInt)error, (PetscMPIInt)*verdict};

  PetscFunctionBegin;
  PetscCallMPI(MPI_Bcast(said, 2, MPI_INT, 0, PetscObjectComm((PetscObject)r->on_W)));
  PetscCall(error);
  PetscCheck(!said[0], PETSC_COMM_SELF, (PetscErrorCode)said[0],
    "The reduced problem of the subspace failed on the first rank, with error %d", said[0]);
  *verdict = (PetscBool)said[1];
  PetscFunctionReturn(0);
}

/* Raises an error of the first rank on all ranks. error: what a function returned that only the first rank needs */
PetscErrorCode IPReducedAgree(const IPReduced *r, PetscErrorCode error)
{
  PetscBool none = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPReducedBroadcast(r, error, &none));
  PetscFunctionReturn(0);
}

/* Gathers the entries of v in the array a of length n on the first rank */
PetscErrorCode IPReducedFetch(VecScatter scatter, Vec v, Vec on_first, PetscInt n, PetscReal a[])
{
  const PetscScalar *values;

  PetscFunctionBegin;
  PetscCall(VecScatterBegin(scatter, v, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, v, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(on_first, &values));
  PetscCall(PetscArraycpy(a, values, n));
  PetscCall(VecRestoreArrayRead(on_first, &values));
  PetscFunctionReturn(0);
}

/* Distributes the array a of the first rank to the entries of v; other entries of v are unchanged */
PetscErrorCode IPReducedSpread(VecScatter scatter, PetscInt n, const PetscReal a[], Vec on_first, Vec v)
{
  PetscScalar *values;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(on_first, &values));
  PetscCall(PetscArraycpy(values, a, n));
  PetscCall(VecRestoreArrayWrite(on_first, &values));
  PetscCall(VecScatterBegin(scatter, on_first, v, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(scatter, on_first, v, INSERT_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(0);
}
