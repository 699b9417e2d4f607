/*
   Solves the systems of system.c by a sparse LU factorization of MUMPS, for systems of many rows. The motions are v = R
   w - RZ_d y_d, and the matrix for w, f and the companions y_c is
     K w + Q_c y_c - R^T f = 0,   B_v R w + B_f f = r_f,   G_c y_c + Q_c^T w = r_c,
   in which each companion is eliminated, since Q_c has one entry per column. The columns T_cd and B_v RZ_d of the other
   directions y_d border this matrix. Rows that are open or have no friction are left out, as in dense.c.
*/
#include "frictionimpl.h"
#include "pc_amgf/mumps.h"
#include <petscblaslapack.h>

/* The matrix for w and the forces of n rows, and its solutions for the right-hand side and each column of the border */
typedef struct {
  IPTermSystem          *t;
  const IPReducedSystem *s;
  PetscInt               nw, n, nd; /* numbers of unknowns w, rows, and directions of the border */
  PetscInt              *place;     /* position of each of the system's rows among the n, or negative */
  const PetscInt        *rows;
  PetscReal             *size; /* scale of each unknown w */
  PetscScalar           *x;    /* nd + 1 columns of nw + n entries */
} TermSparse;

static PetscErrorCode TermSparseScale(TermSparse *p)
{
  const PetscScalar *d;

  PetscFunctionBegin;
  PetscCall(MatGetDiagonal(p->t->K, p->t->w));
  PetscCall(VecGetArrayRead(p->t->w, &d));
  for (PetscInt i = 0; i < p->nw; i++) p->size[i] = 1.0 / PetscSqrtReal(PetscRealPart(d[i]));
  PetscCall(VecRestoreArrayRead(p->t->w, &d));
  PetscFunctionReturn(0);
}

/* Counts the entries of each row of the matrix. V = B_v R. */
static PetscErrorCode TermSparseCount(const TermSparse *p, Mat V, PetscInt counts[])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < p->nw; i++) {
    PetscCall(MatGetRow(p->t->K, i, &counts[i], NULL, NULL));
    PetscCall(MatRestoreRow(p->t->K, i, NULL, NULL, NULL));
  }
  for (PetscInt q = 0; q < p->n; q++) {
    const PetscInt *columns;
    PetscInt        nc, nb;

    PetscCall(MatGetRow(p->t->R, p->rows[q], &nc, &columns, NULL));
    for (PetscInt c = 0; c < nc; c++) counts[columns[c]]++;
    PetscCall(MatRestoreRow(p->t->R, p->rows[q], &nc, &columns, NULL));
    PetscCall(MatGetRow(V, p->rows[q], &nc, NULL, NULL));
    PetscCall(MatRestoreRow(V, p->rows[q], NULL, NULL, NULL));
    PetscCall(MatGetRow(p->t->Bf, p->rows[q], &nb, NULL, NULL));
    PetscCall(MatRestoreRow(p->t->Bf, p->rows[q], NULL, NULL, NULL));
    counts[p->nw + q] = nc + nb;
  }
  PetscFunctionReturn(0);
}

/* Inserts K, and -R^T of the n rows */
static PetscErrorCode TermSparseInsertBodies(const TermSparse *p, Mat A)
{
  const PetscReal follow = 1.0 / (1.0 + p->t->hold);

  PetscFunctionBegin;
  for (PetscInt i = 0; i < p->nw; i++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(p->t->K, i, &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++)
      PetscCall(MatSetValue(A, i, columns[c], values[c] * p->size[i] * p->size[columns[c]], ADD_VALUES));
    PetscCall(MatRestoreRow(p->t->K, i, &nc, &columns, &values));
  }
  for (PetscInt a = 0; a < p->s->ncompanions; a++) {
    const PetscInt i = p->s->companion[a];

    PetscCall(MatSetValue(A, i, i, -p->s->G[a] * follow * PetscSqr(p->size[i]), ADD_VALUES));
  }
  for (PetscInt q = 0; q < p->n; q++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(p->t->R, p->rows[q], &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++)
      PetscCall(
        MatSetValue(A, columns[c], p->nw + q, -values[c] * p->size[columns[c]] * p->t->scale[p->rows[q]], ADD_VALUES));
    PetscCall(MatRestoreRow(p->t->R, p->rows[q], &nc, &columns, &values));
  }
  PetscFunctionReturn(0);
}

/* Inserts V = B_v R and B_f of the n rows */
static PetscErrorCode TermSparseInsertLaws(const TermSparse *p, Mat V, Mat A)
{
  PetscFunctionBegin;
  for (PetscInt q = 0; q < p->n; q++) {
    const PetscInt     row   = p->rows[q];
    const PetscReal    scale = p->t->scale[row];
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(V, row, &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++)
      PetscCall(MatSetValue(A, p->nw + q, columns[c], scale * values[c] * p->size[columns[c]], ADD_VALUES));
    PetscCall(MatRestoreRow(V, row, &nc, &columns, &values));
    PetscCall(MatGetRow(p->t->Bf, row, &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++)
      if (p->place[columns[c]] >= 0)
        PetscCall(MatSetValue(A, p->nw + q, p->nw + p->place[columns[c]], scale * values[c] * p->t->scale[columns[c]],
          ADD_VALUES));
    PetscCall(MatRestoreRow(p->t->Bf, row, &nc, &columns, &values));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode TermSparseAssemble(const TermSparse *p, Mat *A)
{
  const PetscInt all = p->nw + p->n;
  PetscInt      *counts;
  Mat            V;

  PetscFunctionBegin;
  PetscCall(MatMatMult(p->t->Bv, p->t->R, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &V));
  PetscCall(PetscMalloc1(all, &counts));
  PetscCall(TermSparseCount(p, V, counts));
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, all, all, 0, counts, A));
  PetscCall(PetscFree(counts));
  PetscCall(TermSparseInsertBodies(p, *A));
  PetscCall(TermSparseInsertLaws(p, V, *A));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDestroy(&V));
  PetscFunctionReturn(0);
}

/* Sets the right-hand sides: that of the system, and those of unit coordinates y_d */
static PetscErrorCode TermSparseSetSides(const TermSparse *p, const PetscReal rf[], const PetscReal ry[])
{
  const IPReducedSystem *s      = p->s;
  const PetscReal        follow = 1.0 / (1.0 + p->t->hold);
  const size_t           all    = (size_t)(p->nw + p->n);

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(p->x, all * (size_t)(p->nd + 1)));
  for (PetscInt q = 0; q < p->n; q++) p->x[p->nw + q] = p->t->scale[p->rows[q]] * rf[p->rows[q]];
  for (PetscInt d = 0; d <= p->nd; d++) {
    const PetscInt j = s->ncompanions + d - 1;
    PetscScalar   *x = p->x + (size_t)d * all;

    for (PetscInt a = 0; a < s->ncompanions; a++) {
      const PetscInt i = s->companion[a];

      x[i] += p->size[i] * follow * (d ? -s->T[a + j * s->kmax] : ry[a]);
    }
    if (!d) continue;
    PetscCall(PetscArraycpy(p->t->v, s->JZ + (size_t)j * (size_t)s->m, s->m));
    PetscCall(IPTermSystemMultiplyMotions(p->t, p->t->v));
    for (PetscInt q = 0; q < p->n; q++) x[p->nw + q] = p->t->v[p->rows[q]];
  }
  PetscFunctionReturn(0);
}

/* Overwrites p->x with the solutions of A x = p->x. *solved: false if A is singular. */
static PetscErrorCode TermSparseFactor(const TermSparse *p, Mat A, PetscBool *solved)
{
  PetscInt       relaxation = AMGF_MUMPS_RELAXATION;
  MatFactorError error;
  Mat            F = NULL, B, X;

  PetscFunctionBegin;
  PetscCall(AMGFMumpsFactorLU(A, &relaxation, &F, &error));
  *solved = (PetscBool)(error == MAT_FACTOR_NOERROR);
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, p->nw + p->n, p->nd + 1, p->x, &B));
  PetscCall(MatDuplicate(B, MAT_COPY_VALUES, &X));
  PetscCall(MatMatSolve(F, X, B));
  PetscCall(MatDestroy(&X));
  PetscCall(MatDestroy(&B));
  PetscCall(MatDestroy(&F));
  PetscFunctionReturn(0);
}

/*
   Computes the displacements of the companions and the forces of all rows from column d of p->x. Column 0 belongs to
   the right-hand side of the system.
*/
static void TermSparseTake(const TermSparse *p, PetscInt d, const PetscReal ry[], PetscReal yc[], PetscReal f[])
{
  const IPReducedSystem *s      = p->s;
  const PetscReal        follow = 1.0 / (1.0 + p->t->hold);
  const PetscScalar     *x      = p->x + (size_t)d * (size_t)(p->nw + p->n);

  for (PetscInt a = 0; a < s->ncompanions; a++) {
    const PetscInt  i    = s->companion[a];
    const PetscReal load = d ? -s->T[a + (s->ncompanions + d - 1) * s->kmax] : ry[a];

    yc[a] = follow * (load / s->G[a] + p->size[i] * PetscRealPart(x[i]));
  }
  for (PetscInt r = 0; r < s->m; r++)
    f[r] = p->place[r] < 0 ? 0.0 : p->t->scale[r] * PetscRealPart(x[p->nw + p->place[r]]);
}

/* Computes the equations T y + RZ^T f of the directions y_d, for y_d = 0 */
static void TermSparseApplyBorder(const TermSparse *p, const PetscReal yc[], const PetscReal f[], PetscReal b[])
{
  const IPReducedSystem *s = p->s;

  for (PetscInt e = 0; e < p->nd; e++) {
    const PetscInt i = s->ncompanions + e;

    b[e] = 0.0;
    for (PetscInt a = 0; a < s->ncompanions; a++) b[e] += s->T[i + a * s->kmax] * yc[a];
    for (PetscInt r = 0; r < s->m; r++) b[e] += s->JZ[r + (size_t)i * (size_t)s->m] * f[r];
  }
}

/* Solves for y_d, and sets r_f and r_y to the solution */
static PetscErrorCode TermSparseFinish(const TermSparse *p, PetscReal rf[], PetscReal ry[], PetscBool *solved)
{
  const IPReducedSystem *s  = p->s;
  const PetscInt         nc = s->ncompanions;
  PetscReal             *yc, *f, *b, *H;
  PetscBLASInt           nd, one = 1, info = 0, *pivots;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(p->nd, &nd));
  PetscCall(PetscMalloc5(nc, &yc, s->m, &f, p->nd, &b, p->nd * p->nd, &H, p->nd, &pivots));
  for (PetscInt d = 1; d <= p->nd; d++) {
    PetscReal *h = H + (d - 1) * p->nd;

    TermSparseTake(p, d, ry, yc, f);
    TermSparseApplyBorder(p, yc, f, h);
    for (PetscInt e = 0; e < p->nd; e++) h[e] += s->T[nc + e + (nc + d - 1) * s->kmax];
    h[d - 1] += p->t->hold * s->G[nc + d - 1];
  }
  TermSparseTake(p, 0, ry, yc, f);
  TermSparseApplyBorder(p, yc, f, b);
  for (PetscInt e = 0; e < p->nd; e++) b[e] = ry[nc + e] - b[e];
  if (nd) PetscCallBLAS("LAPACKgesv", LAPACKgesv_(&nd, &one, H, &nd, pivots, b, &nd, &info));
  *solved = (PetscBool)!info;
  for (PetscInt d = 1; d <= p->nd; d++) {
    const size_t all = (size_t)(p->nw + p->n);

    for (size_t i = 0; i < all; i++) p->x[i] += b[d - 1] * p->x[i + (size_t)d * all];
  }
  for (PetscInt a = 0; a < nc; a++)
    for (PetscInt d = 0; d < p->nd; d++) ry[a] -= s->T[a + (nc + d) * s->kmax] * b[d];
  TermSparseTake(p, 0, ry, ry, rf);
  PetscCall(PetscArraycpy(ry + nc, b, p->nd));
  PetscCall(PetscFree5(yc, f, b, H, pivots));
  PetscFunctionReturn(0);
}

/* Overwrites r_f and r_y with the solution. *solved: false if the matrix is singular, or MUMPS is not available. */
PetscErrorCode IPTermSparseSolve(IPTermSystem *t, const IPReducedSystem *s, PetscReal rf[], PetscReal ry[],
  PetscBool *solved)
{
  TermSparse p = {.t = t, .s = s, .nd = s->k - s->ncompanions};
  PetscReal *known;
  PetscInt  *rows;
  Mat        A;

  PetscFunctionBegin;
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_LU, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(MatGetSize(t->K, &p.nw, NULL));
  PetscCall(PetscMalloc4(t->m, &rows, t->m, &known, t->m, &p.place, p.nw, &p.size));
  PetscCall(IPTermSystemFindCoupled(t, rf, &p.n, rows, known));
  p.rows = rows;
  for (PetscInt i = 0; i < t->m; i++) p.place[i] = -1;
  for (PetscInt i = 0; i < p.n; i++) p.place[rows[i]] = i;
  PetscCall(IPTermSystemSubtract(t, s, known, rf, ry));
  PetscCall(PetscMalloc1((size_t)(p.nw + p.n) * (size_t)(p.nd + 1), &p.x));
  PetscCall(TermSparseScale(&p));
  PetscCall(TermSparseAssemble(&p, &A));
  PetscCall(TermSparseSetSides(&p, rf, ry));
  PetscCall(TermSparseFactor(&p, A, solved));
  if (*solved) PetscCall(TermSparseFinish(&p, rf, ry, solved));
  for (PetscInt i = 0; i < t->m && *solved; i++) rf[i] += known[i];
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFree(p.x));
  PetscCall(PetscFree4(rows, known, p.place, p.size));
  PetscFunctionReturn(0);
}
