/*
   The symmetric matrix A = K_WW + R^T S R of the unknowns W that contacts touch. It is stored by its upper triangle, as
   factorizations need it. Each rank computes its own rows, from copies of the rows of R that have entries there.
*/
#include "subspace_bodies.h"

/* The arrays of a sequential matrix in compressed row format */
typedef struct {
  const PetscInt    *start, *column;
  const PetscScalar *value;
} InterfaceRows;

struct _p_InterfaceMatrix {
  Mat           A, K;
  Mat           R, T;     /* sequential: three rows for each contact that has entries in rows of this rank; R^T */
  InterfaceRows r, t;     /* the arrays of both */
  Vec           own, S;   /* nine entries per contact: of this rank; of R's rows */
  VecScatter    to_S;     /* from the former to the latter */
  PetscInt      first, n; /* first row of A on this rank, and number of its rows here */
  PetscInt     *columns;  /* columns of A's entries by row */
  PetscInt     *counts;   /* number of entries of each row */
  PetscScalar  *sum;      /* work array with an entry for each column */
};

static PetscErrorCode InterfaceGetRows(Mat A, InterfaceRows *rows)
{
  PetscInt  n;
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &rows->start, &rows->column, &done));
  PetscCall(MatSeqAIJGetArrayRead(A, &rows->value));
  PetscFunctionReturn(0);
}

static PetscErrorCode InterfaceRestoreRows(Mat A, InterfaceRows *rows)
{
  PetscInt  n;
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatSeqAIJRestoreArrayRead(A, &rows->value));
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &rows->start, &rows->column, &done));
  PetscFunctionReturn(0);
}

/* Finds the contacts that have entries in columns of R on this rank, whose three rows are neighbours */
static PetscErrorCode InterfaceFindContacts(Mat R, IS *contacts)
{
  PetscInt        start, end, n, m, *place, *found;
  size_t          count;
  const PetscInt *rows;
  PetscSegBuffer  buffer;
  Mat             T;

  PetscFunctionBegin;
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 1000, &buffer));
  PetscCall(MatTranspose(R, MAT_INITIAL_MATRIX, &T));
  PetscCall(MatGetOwnershipRange(T, &start, &end));
  for (PetscInt i = start; i < end; i++) {
    PetscCall(MatGetRow(T, i, &n, &rows, NULL));
    PetscCall(PetscSegBufferGetInts(buffer, n, &place));
    for (PetscInt k = 0; k < n; k++) place[k] = rows[k] / 3;
    PetscCall(MatRestoreRow(T, i, &n, &rows, NULL));
  }
  PetscCall(PetscSegBufferGetSize(buffer, &count));
  PetscCall(PetscSegBufferExtractInPlace(buffer, &found));
  m = (PetscInt)count;
  PetscCall(PetscSortRemoveDupsInt(&m, found));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, m, found, PETSC_COPY_VALUES, contacts));
  PetscCall(PetscSegBufferDestroy(&buffer));
  PetscCall(MatDestroy(&T));
  PetscFunctionReturn(0);
}

/* Copies the rows of contacts from all ranks. R: of all ranks; *rows: a sequential matrix with all columns */
static PetscErrorCode InterfaceCopyRows(Mat R, IS contacts, Mat *rows)
{
  PetscInt        n, columns;
  const PetscInt *contact;
  IS              three, all;
  Mat            *copies;

  PetscFunctionBegin;
  PetscCall(MatGetSize(R, NULL, &columns));
  PetscCall(ISGetLocalSize(contacts, &n));
  PetscCall(ISGetIndices(contacts, &contact));
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, 3, n, contact, PETSC_COPY_VALUES, &three));
  PetscCall(ISRestoreIndices(contacts, &contact));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, columns, 0, 1, &all));
  PetscCall(MatCreateSubMatrices(R, 1, &three, &all, MAT_INITIAL_MATRIX, &copies));
  PetscCall(PetscObjectReference((PetscObject)copies[0]));
  *rows = copies[0];
  PetscCall(MatDestroySubMatrices(1, &copies));
  PetscCall(ISDestroy(&three));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

/* Takes the rows of R that this rank needs, and prepares the exchange of S */
static PetscErrorCode InterfaceTakeRows(InterfaceMatrix m, Mat R)
{
  PetscInt        n, needed;
  const PetscInt *contact;
  PetscMPIInt     size;
  IS              contacts, blocks;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)R), &size));
  PetscCall(MatGetLocalSize(R, &n, NULL));
  if (size > 1) {
    PetscCall(InterfaceFindContacts(R, &contacts));
    PetscCall(InterfaceCopyRows(R, contacts, &m->R));
  } else {
    PetscCall(ISCreateStride(PETSC_COMM_SELF, n / 3, 0, 1, &contacts));
    PetscCall(PetscObjectReference((PetscObject)R));
    m->R = R;
  }
  PetscCall(MatTranspose(m->R, MAT_INITIAL_MATRIX, &m->T));
  PetscCall(ISGetLocalSize(contacts, &needed));
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)R), 3 * n, PETSC_DETERMINE, &m->own));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 9 * needed, &m->S));
  PetscCall(ISGetIndices(contacts, &contact));
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, 9, needed, contact, PETSC_COPY_VALUES, &blocks));
  PetscCall(ISRestoreIndices(contacts, &contact));
  PetscCall(VecScatterCreate(m->own, blocks, m->S, NULL, &m->to_S));
  PetscCall(ISDestroy(&blocks));
  PetscCall(ISDestroy(&contacts));
  PetscFunctionReturn(0);
}

/* Appends the columns from `row` on that are not marked by `row` yet */
static void InterfaceMark(PetscInt row, PetscInt n, const PetscInt columns[], PetscInt mark[], PetscInt list[],
  PetscInt *count)
{
  for (PetscInt k = n - 1; k >= 0 && columns[k] >= row; k--) {
    if (mark[columns[k]] == row) continue;
    mark[columns[k]] = row;
    list[(*count)++] = columns[k];
  }
}

/* Finds the columns of a row of A, sorted */
static PetscErrorCode InterfaceFindColumns(InterfaceMatrix m, PetscInt row, PetscInt mark[], PetscInt list[],
  PetscInt *count)
{
  const InterfaceRows *r = &m->r, *t = &m->t;
  PetscInt             n, last       = -1;
  const PetscInt      *columns;

  PetscFunctionBegin;
  *count = 0;
  PetscCall(MatGetRow(m->K, row, &n, &columns, NULL));
  InterfaceMark(row, n, columns, mark, list, count);
  PetscCall(MatRestoreRow(m->K, row, &n, &columns, NULL));
  for (PetscInt k = t->start[row]; k < t->start[row + 1]; k++) {
    const PetscInt contact = t->column[k] / 3;

    for (PetscInt i = 3 * contact; i < 3 * contact + 3 && contact != last; i++)
      InterfaceMark(row, r->start[i + 1] - r->start[i], r->column + r->start[i], mark, list, count);
    last = contact;
  }
  PetscCall(PetscSortInt(*count, list));
  PetscFunctionReturn(0);
}

/* Finds the columns of all rows of A on this rank, and creates A */
static PetscErrorCode InterfaceCreatePattern(InterfaceMatrix m, PetscInt N)
{
  PetscInt      *mark, *list, *place, *here, *off;
  PetscSegBuffer columns;

  PetscFunctionBegin;
  PetscCall(PetscMalloc4(N, &mark, N, &list, m->n, &here, m->n, &off));
  PetscCall(PetscMalloc2(m->n, &m->counts, N, &m->sum));
  PetscCall(PetscArrayzero(m->sum, N));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 1000, &columns));
  for (PetscInt i = 0; i < N; i++) mark[i] = -1;
  for (PetscInt i = 0; i < m->n; i++) {
    PetscCall(InterfaceFindColumns(m, m->first + i, mark, list, &m->counts[i]));
    PetscCall(PetscSegBufferGetInts(columns, m->counts[i], &place));
    PetscCall(PetscArraycpy(place, list, m->counts[i]));
    for (here[i] = 0; here[i] < m->counts[i] && list[here[i]] < m->first + m->n;) here[i]++;
    off[i] = m->counts[i] - here[i];
  }
  PetscCall(PetscSegBufferExtractAlloc(columns, &m->columns));
  PetscCall(PetscSegBufferDestroy(&columns));
  PetscCall(MatCreateSBAIJ(PetscObjectComm((PetscObject)m->K), 1, m->n, m->n, N, N, 0, here, 0, off, &m->A));
  PetscCall(PetscFree4(mark, list, here, off));
  PetscFunctionReturn(0);
}

/* R: three rows for each contact of this rank; K: K_WW with all entries. A has no values yet. */
PetscErrorCode InterfaceMatrixCreate(Mat R, Mat K, InterfaceMatrix *matrix)
{
  PetscInt        end, N;
  InterfaceMatrix m;

  PetscFunctionBegin;
  PetscCall(PetscNew(matrix));
  m = *matrix;
  PetscCall(PetscObjectReference((PetscObject)K));
  m->K = K;
  PetscCall(MatGetOwnershipRange(K, &m->first, &end));
  PetscCall(MatGetSize(K, &N, NULL));
  m->n = end - m->first;
  PetscCall(InterfaceTakeRows(m, R));
  PetscCall(InterfaceGetRows(m->R, &m->r));
  PetscCall(InterfaceGetRows(m->T, &m->t));
  PetscCall(InterfaceCreatePattern(m, N));
  PetscFunctionReturn(0);
}

PetscErrorCode InterfaceMatrixDestroy(InterfaceMatrix *matrix)
{
  InterfaceMatrix m = *matrix;

  PetscFunctionBegin;
  if (!m) PetscFunctionReturn(0);
  PetscCall(InterfaceRestoreRows(m->R, &m->r));
  PetscCall(InterfaceRestoreRows(m->T, &m->t));
  PetscCall(MatDestroy(&m->R));
  PetscCall(MatDestroy(&m->T));
  PetscCall(MatDestroy(&m->K));
  PetscCall(MatDestroy(&m->A));
  PetscCall(VecDestroy(&m->own));
  PetscCall(VecDestroy(&m->S));
  PetscCall(VecScatterDestroy(&m->to_S));
  PetscCall(PetscFree2(m->counts, m->sum));
  PetscCall(PetscFree(m->columns));
  PetscCall(PetscFree(*matrix));
  PetscFunctionReturn(0);
}

Mat InterfaceMatrixGet(InterfaceMatrix m)
{
  return m->A;
}

/* Adds a row of K_WW + R^T S R, from its diagonal on, to m->sum. S: blocks of the contacts of m->R */
static PetscErrorCode InterfaceAddRow(InterfaceMatrix m, PetscInt row, const PetscScalar S[])
{
  const InterfaceRows *r = &m->r, *t = &m->t;
  PetscInt             n;
  const PetscInt      *columns;
  const PetscScalar   *values;

  PetscFunctionBegin;
  PetscCall(MatGetRow(m->K, row, &n, &columns, &values));
  for (PetscInt k = n - 1; k >= 0 && columns[k] >= row; k--) m->sum[columns[k]] += values[k];
  PetscCall(MatRestoreRow(m->K, row, &n, &columns, &values));
  for (PetscInt k = t->start[row]; k < t->start[row + 1];) {
    const PetscInt contact = t->column[k] / 3;
    PetscScalar    s[3]    = {0.0, 0.0, 0.0};

    for (; k < t->start[row + 1] && t->column[k] / 3 == contact; k++)
      for (PetscInt a = 0; a < 3; a++) s[a] += S[9 * contact + 3 * (t->column[k] % 3) + a] * t->value[k];
    for (PetscInt a = 0; a < 3; a++) {
      const PetscInt i = 3 * contact + a;

      for (PetscInt p = r->start[i + 1] - 1; s[a] != 0.0 && p >= r->start[i] && r->column[p] >= row; p--)
        m->sum[r->column[p]] += s[a] * r->value[p];
    }
  }
  PetscFunctionReturn(0);
}

/* Computes A for the symmetric blocks S of this rank's contacts */
PetscErrorCode InterfaceMatrixAssemble(InterfaceMatrix m, const PetscReal blocks[])
{
  PetscInt           n, widest = 0;
  PetscScalar       *own, *values;
  const PetscScalar *S;
  const PetscInt    *columns = m->columns;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(m->own, &n));
  PetscCall(VecGetArrayWrite(m->own, &own));
  for (PetscInt k = 0; k < n; k++) own[k] = blocks[k];
  PetscCall(VecRestoreArrayWrite(m->own, &own));
  PetscCall(VecScatterBegin(m->to_S, m->own, m->S, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(m->to_S, m->own, m->S, INSERT_VALUES, SCATTER_FORWARD));
  for (PetscInt i = 0; i < m->n; i++) widest = PetscMax(widest, m->counts[i]);
  PetscCall(PetscMalloc1(widest, &values));
  PetscCall(VecGetArrayRead(m->S, &S));
  for (PetscInt i = 0; i < m->n; columns += m->counts[i++]) {
    const PetscInt row = m->first + i;

    PetscCall(InterfaceAddRow(m, row, S));
    for (PetscInt k = 0; k < m->counts[i]; k++) {
      values[k]          = m->sum[columns[k]];
      m->sum[columns[k]] = 0.0;
    }
    PetscCall(MatSetValues(m->A, 1, &row, m->counts[i], columns, values, INSERT_VALUES));
  }
  PetscCall(VecRestoreArrayRead(m->S, &S));
  PetscCall(PetscFree(values));
  PetscCall(MatAssemblyBegin(m->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(m->A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}
