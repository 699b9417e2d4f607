/*
   Preconditioner of the systems of system.c, for bodies that contact and friction alone hold, and for many rows. It
   solves a system in which the laws of each constraint and its term are made symmetric and slightly soft:
     M f + B_v v = r_f,   M = B_f + B_v / p,   p = 1000 / compliance,
   so that the forces can be eliminated. The motions are v = R w - RZ_d y_d, where w are the displacements of W, and the
   companions y_c follow them. What remains is a symmetric matrix of the size of W, which is positive definite:
     (K_WW - G_c / (1 + hold) + R^T D R) w = R^T M^-1 (r_f + B_v RZ_d y_d) + r_c / (1 + hold),   D ~ M^-1 B_v.
   It is factored by Cholesky's method. Its pattern, and with it the analysis, is kept as long as the coupled rows stay
   within those seen before.
*/
#include "frictionimpl.h"
#include "pc_amgf/solver_types.h"
#include "pc_amgf/mumps.h"
#include <petscblaslapack.h>
#include <vector3.h>

PetscErrorCode IPTermCholeskyDestroy(IPTermCholesky *c)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->A));
  PetscCall(MatDestroy(&c->F));
  PetscCall(PetscFree3(c->inverse, c->D, c->coupled));
  PetscCall(PetscFree4(c->force, c->companion, c->H, c->pivots));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/* Gets the rows of block i, its constraint and its term. Returns their number. */
static PetscInt CholeskyRowsOf(const IPTermSystem *t, PetscInt i, PetscInt rows[3])
{
  PetscInt n = 0;

  if (i < t->nconstraints) rows[n++] = i;
  for (PetscInt a = 0; i < t->nterms && a < 2; a++) rows[n++] = t->nconstraints + 2 * i + a;
  return n;
}

/*
   Computes M^-1 and D of block i. D is the symmetric part of M^-1 B_v, without the influence of the constraint on its
   term. *coupled: whether B_v is not zero.
*/
static PetscErrorCode CholeskyMakeBlock(IPTermSystem *t, PetscInt i, PetscReal inverse[9], PetscReal D[9],
  PetscBool *coupled, PetscBool *singular)
{
  const PetscReal    softness = 1e-3;
  PetscInt           rows[3], n = CholeskyRowsOf(t, i, rows);
  PetscReal          V[3][3] = {{0.0}};
  const PetscScalar *values;

  PetscFunctionBegin;
  *coupled = PETSC_FALSE;
  for (PetscInt a = 0; a < n; a++) {
    PetscCall(MatGetRow(t->Bv, rows[a], NULL, NULL, &values)); /* the columns are those of the block, in order */
    for (PetscInt b = 0; b < n; b++) V[a][b] = PetscRealPart(values[b]);
    PetscCall(MatRestoreRow(t->Bv, rows[a], NULL, NULL, &values));
    PetscCall(MatGetRow(t->Bf, rows[a], NULL, NULL, &values));
    for (PetscInt b = 0; b < n; b++)
      inverse[3 * a + b] = PetscRealPart(values[b]) + softness * t->compliance[rows[b]] * V[a][b];
    PetscCall(MatRestoreRow(t->Bf, rows[a], NULL, NULL, &values));
    for (PetscInt b = 0; b < n; b++) *coupled = (PetscBool)(*coupled || V[a][b] != 0.0);
  }
  *singular = (PetscBool)!MatrixInvertInPlace(n, 3, inverse);
  for (PetscInt a = 0; a < n; a++)
    for (PetscInt b = 0; b < n; b++) {
      const PetscBool apart = (PetscBool)((rows[a] < t->nconstraints) != (rows[b] < t->nconstraints));

      for (PetscInt k = 0; k < n && !apart; k++) {
        D[3 * a + b] += 0.5 * inverse[3 * a + k] * V[k][b];
        D[3 * b + a] += 0.5 * inverse[3 * a + k] * V[k][b];
      }
    }
  PetscFunctionReturn(0);
}

/* Computes the blocks of all constraints and terms. *more: whether a block is coupled that was not so before */
static PetscErrorCode CholeskyMakeBlocks(IPTermSystem *t, PetscBool *more, PetscBool *singular)
{
  IPTermCholesky *c = &t->cholesky;
  const PetscInt  n = PetscMax(t->nconstraints, t->nterms);

  PetscFunctionBegin;
  *more = *singular = PETSC_FALSE;
  if (!c->coupled) PetscCall(PetscCalloc3(9 * n, &c->inverse, 9 * n, &c->D, n, &c->coupled));
  PetscCall(PetscArrayzero(c->D, 9 * n));
  for (PetscInt i = 0; i < n && !*singular; i++) {
    PetscBool coupled;

    PetscCall(CholeskyMakeBlock(t, i, c->inverse + 9 * i, c->D + 9 * i, &coupled, singular));
    *more         = (PetscBool)(*more || (coupled && !c->coupled[i]));
    c->coupled[i] = (PetscBool)(c->coupled[i] || coupled);
  }
  PetscFunctionReturn(0);
}

/* Creates a matrix with the pattern of K_WW and of R^T D R for the coupled blocks */
static PetscErrorCode CholeskyMakePattern(IPTermSystem *t)
{
  IPTermCholesky *c = &t->cholesky;
  Mat             B, product;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->A));
  PetscCall(MatDestroy(&c->F));
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, t->m, t->m, 3, NULL, &B));
  for (PetscInt i = 0; i < PetscMax(t->nconstraints, t->nterms); i++) {
    const PetscScalar zeros[9] = {0.0};
    PetscInt          rows[3], n = CholeskyRowsOf(t, i, rows);

    if (c->coupled[i]) PetscCall(MatSetValues(B, n, rows, n, rows, zeros, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(B, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(B, MAT_FINAL_ASSEMBLY));
  PetscCall(MatPtAP(B, t->R, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatDestroy(&B));
  PetscCall(MatDuplicate(t->K, MAT_COPY_VALUES, &c->A));
  PetscCall(MatAXPY(c->A, 1.0, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&product));
  PetscFunctionReturn(0);
}

/* Adds a row, with its n columns in ascending order, to a row of a matrix that has these columns. With MatSetValues()
   the run of the test friction_bricks takes 1.4 times as long. */
static void CholeskyAddToRow(PetscInt n, const PetscInt columns[], const PetscReal x[], const PetscInt ja[],
  PetscScalar a[])
{
  for (PetscInt k = 0, at = 0; k < n; k++) {
    while (ja[at] < columns[k]) at++;
    a[at] += x[k];
  }
}

/* Adds K_WW less what the companions take up */
static PetscErrorCode CholeskyAddBodies(IPTermSystem *t, const IPReducedSystem *s, PetscReal follow,
  const PetscInt ia[], const PetscInt ja[], PetscScalar a[])
{
  PetscInt nw;

  PetscFunctionBegin;
  PetscCall(MatGetSize(t->K, &nw, NULL));
  for (PetscInt i = 0; i < nw; i++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           n;

    PetscCall(MatGetRow(t->K, i, &n, &columns, &values));
    CholeskyAddToRow(n, columns, values, ja + ia[i], a + ia[i]);
    PetscCall(MatRestoreRow(t->K, i, &n, &columns, &values));
  }
  for (PetscInt k = 0; k < s->ncompanions; k++) {
    const PetscInt  i     = s->companion[k];
    const PetscReal minus = -follow * s->G[k];

    CholeskyAddToRow(1, &i, &minus, ja + ia[i], a + ia[i]);
  }
  PetscFunctionReturn(0);
}

/*
   Gathers the rows of R of a block in the columns in which one of them has an entry. Returns the number of columns. R:
   three rows of length `most`.
*/
static PetscInt CholeskyGather(PetscInt n, const PetscInt rows[], const PetscInt ri[], const PetscInt rj[],
  const PetscScalar r[], PetscInt most, PetscInt columns[], PetscReal R[])
{
  PetscInt at[3], nc = 0;

  for (PetscInt p = 0; p < n; p++) at[p] = ri[rows[p]];
  for (;; nc++) {
    PetscInt next = PETSC_MAX_INT;

    for (PetscInt p = 0; p < n; p++)
      if (at[p] < ri[rows[p] + 1]) next = PetscMin(next, rj[at[p]]);
    if (next == PETSC_MAX_INT) return nc;
    columns[nc] = next;
    for (PetscInt p = 0; p < n; p++) {
      const PetscBool here = (PetscBool)(at[p] < ri[rows[p] + 1] && rj[at[p]] == next);

      R[p * most + nc] = here ? PetscRealPart(r[at[p]]) : 0.0;
      at[p] += here;
    }
  }
}

/* Adds R^T D R of one block */
static PetscErrorCode CholeskyAddBlock(IPTermSystem *t, PetscInt i, const PetscInt ri[], const PetscInt rj[],
  const PetscScalar r[], const PetscInt ia[], const PetscInt ja[], PetscScalar a[])
{
  const PetscReal *D = t->cholesky.D + 9 * i;
  PetscInt         rows[3], *columns, nc, most = 0;
  const PetscInt   n = CholeskyRowsOf(t, i, rows);
  PetscReal       *R, *x, DR[3];

  PetscFunctionBegin;
  for (PetscInt p = 0; p < n; p++) most += ri[rows[p] + 1] - ri[rows[p]];
  PetscCall(PetscMalloc3(most, &columns, 3 * most, &R, most, &x));
  nc = CholeskyGather(n, rows, ri, rj, r, most, columns, R);
  for (PetscInt e = 0; e < nc; e++) {
    for (PetscInt p = 0; p < n; p++) {
      DR[p] = 0.0;
      for (PetscInt q = 0; q < n; q++) DR[p] += D[3 * p + q] * R[q * most + e];
    }
    for (PetscInt k = 0; k < nc; k++) {
      x[k] = 0.0;
      for (PetscInt p = 0; p < n; p++) x[k] += DR[p] * R[p * most + k];
    }
    CholeskyAddToRow(nc, columns, x, ja + ia[columns[e]], a + ia[columns[e]]);
  }
  PetscCall(PetscFree3(columns, R, x));
  PetscFunctionReturn(0);
}

static PetscErrorCode CholeskyAssemble(IPTermSystem *t, const IPReducedSystem *s, PetscReal follow)
{
  IPTermCholesky    *c = &t->cholesky;
  const PetscInt    *ia, *ja, *ri, *rj;
  const PetscScalar *r;
  PetscScalar       *a;
  PetscInt           nw, m;
  PetscBool          done;

  PetscFunctionBegin;
  PetscCall(MatZeroEntries(c->A));
  PetscCall(MatGetRowIJ(c->A, 0, PETSC_FALSE, PETSC_FALSE, &nw, &ia, &ja, &done));
  PetscCall(MatGetRowIJ(t->R, 0, PETSC_FALSE, PETSC_FALSE, &m, &ri, &rj, &done));
  PetscCall(MatSeqAIJGetArray(c->A, &a));
  PetscCall(MatSeqAIJGetArrayRead(t->R, &r));
  PetscCall(CholeskyAddBodies(t, s, follow, ia, ja, a));
  for (PetscInt i = 0; i < PetscMax(t->nconstraints, t->nterms); i++)
    if (c->coupled[i]) PetscCall(CholeskyAddBlock(t, i, ri, rj, r, ia, ja, a));
  PetscCall(MatSeqAIJRestoreArrayRead(t->R, &r));
  PetscCall(MatSeqAIJRestoreArray(c->A, &a));
  PetscCall(MatRestoreRowIJ(t->R, 0, PETSC_FALSE, PETSC_FALSE, &m, &ri, &rj, &done));
  PetscCall(MatRestoreRowIJ(c->A, 0, PETSC_FALSE, PETSC_FALSE, &nw, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

/* Factors the assembled matrix. *factored: false if it is not positive definite. */
static PetscErrorCode CholeskyFactor(IPTermCholesky *c, PetscBool *factored)
{
  MatFactorInfo  info;
  MatFactorError error;
  PetscBool      mumps;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_CHOLESKY, &mumps));
  if (!c->F) {
    PetscCall(MatSetOption(c->A, MAT_SPD, PETSC_TRUE));
    PetscCall(MatGetFactor(c->A, mumps ? MATSOLVERMUMPS : MATSOLVERAMGF, MAT_FACTOR_CHOLESKY, &c->F));
    PetscCall(MatCholeskyFactorSymbolic(c->F, c->A, NULL, &info));
  }
  PetscCall(MatCholeskyFactorNumeric(c->F, c->A, &info));
  PetscCall(MatFactorGetError(c->F, &error));
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  PetscFunctionReturn(0);
}

/* Multiplies the blocks M^-1 with an array that has an entry per row */
static void CholeskyDivide(const IPTermSystem *t, PetscReal f[])
{
  for (PetscInt i = 0; i < PetscMax(t->nconstraints, t->nterms); i++) {
    const PetscReal *inverse = t->cholesky.inverse + 9 * i;
    PetscInt         rows[3];
    const PetscInt   n    = CholeskyRowsOf(t, i, rows);
    PetscReal        x[3] = {0.0};

    for (PetscInt a = 0; a < n; a++)
      for (PetscInt b = 0; b < n; b++) x[a] += inverse[3 * a + b] * f[rows[b]];
    for (PetscInt a = 0; a < n; a++) f[rows[a]] = x[a];
  }
}

/* Solves for forces and companions with y_d = 0. f: r_f on entry; yc: r_c on entry. Uses t->w, t->Kw and t->v. */
static PetscErrorCode CholeskySolveInner(IPTermSystem *t, const IPReducedSystem *s, PetscReal f[], PetscReal yc[])
{
  const PetscReal follow = t->cholesky.follow;
  PetscScalar    *w;

  PetscFunctionBegin;
  CholeskyDivide(t, f);
  PetscCall(VecPlaceArray(t->r, f));
  PetscCall(MatMultTranspose(t->R, t->r, t->w));
  PetscCall(VecResetArray(t->r));
  PetscCall(VecGetArray(t->w, &w));
  for (PetscInt a = 0; a < s->ncompanions; a++) w[s->companion[a]] += follow * yc[a];
  PetscCall(VecRestoreArray(t->w, &w));
  PetscCall(MatSolve(t->cholesky.F, t->w, t->Kw));
  PetscCall(VecGetArray(t->Kw, &w));
  for (PetscInt a = 0; a < s->ncompanions; a++) yc[a] = follow * (yc[a] / s->G[a] + PetscRealPart(w[s->companion[a]]));
  PetscCall(VecRestoreArray(t->Kw, &w));
  PetscCall(MatMult(t->R, t->Kw, t->r));
  PetscCall(MatMult(t->Bv, t->r, t->z));
  PetscCall(VecGetArray(t->z, &w));
  for (PetscInt i = 0; i < t->m; i++) t->v[i] = PetscRealPart(w[i]);
  PetscCall(VecRestoreArray(t->z, &w));
  CholeskyDivide(t, t->v);
  for (PetscInt i = 0; i < t->m; i++) f[i] -= t->v[i];
  PetscFunctionReturn(0);
}

/* Adds the equations T y + RZ^T f of the directions y_d to b, times a factor */
static void CholeskyAddBorder(const IPTermSystem *t, const IPReducedSystem *s, PetscReal factor, const PetscReal f[],
  const PetscReal yc[], PetscReal b[])
{
  const PetscInt nc = s->ncompanions;

  for (PetscInt e = 0; e < s->k - nc; e++) {
    const PetscReal *JZ  = s->JZ + (size_t)(nc + e) * (size_t)t->m;
    PetscReal        sum = 0.0;

    for (PetscInt a = 0; a < nc; a++) sum += s->T[nc + e + a * s->kmax] * yc[a];
    for (PetscInt r = 0; r < t->m; r++) sum += JZ[r] * f[r];
    b[e] += factor * sum;
  }
}

/* Computes the solutions for unit coordinates y_d, and factors the Schur complement of y_d */
static PetscErrorCode CholeskyEliminate(IPTermSystem *t, const IPReducedSystem *s, PetscBool *factored)
{
  IPTermCholesky *c  = &t->cholesky;
  const PetscInt  nc = s->ncompanions, nd = s->k - nc;
  PetscBLASInt    n, info                 = 0;

  PetscFunctionBegin;
  PetscCall(PetscFree4(c->force, c->companion, c->H, c->pivots));
  PetscCall(PetscMalloc4((size_t)t->m * (size_t)nd, &c->force, nc * nd, &c->companion, nd * nd, &c->H, nd, &c->pivots));
  for (PetscInt d = 0; d < nd; d++) {
    PetscReal *f = c->force + (size_t)d * (size_t)t->m, *yc = c->companion + nc * d, *h = c->H + nd * d;

    PetscCall(VecPlaceArray(t->r, s->JZ + (size_t)(nc + d) * (size_t)t->m));
    PetscCall(VecPlaceArray(t->z, f));
    PetscCall(MatMult(t->Bv, t->r, t->z));
    PetscCall(VecResetArray(t->z));
    PetscCall(VecResetArray(t->r));
    for (PetscInt a = 0; a < nc; a++) yc[a] = -s->T[a + (nc + d) * s->kmax];
    PetscCall(CholeskySolveInner(t, s, f, yc));
    for (PetscInt e = 0; e < nd; e++) h[e] = s->T[nc + e + (nc + d) * s->kmax];
    h[d] += t->hold * s->G[nc + d];
    CholeskyAddBorder(t, s, 1.0, f, yc, h);
  }
  PetscCall(PetscBLASIntCast(nd, &n));
  if (nd) PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&n, &n, c->H, &n, c->pivots, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/* Prepares the preconditioner for the present B_v and B_f. *ready: false if a matrix is singular or not definite. */
PetscErrorCode IPTermCholeskyPrepare(IPTermSystem *t, const IPReducedSystem *s, PetscBool *ready)
{
  const PetscReal least = 1e-6; /* rounding errors limit smaller values, see convex.c */
  PetscBool       more, singular;

  PetscFunctionBegin;
  t->cholesky.follow = 1.0 / (1.0 + PetscMax(t->hold, least));
  PetscCall(CholeskyMakeBlocks(t, &more, &singular));
  *ready = (PetscBool)!singular;
  if (!*ready) PetscFunctionReturn(0);
  if (more || !t->cholesky.A) PetscCall(CholeskyMakePattern(t));
  PetscCall(CholeskyAssemble(t, s, t->cholesky.follow));
  PetscCall(CholeskyFactor(&t->cholesky, ready));
  if (*ready) PetscCall(CholeskyEliminate(t, s, ready));
  PetscFunctionReturn(0);
}

/* Overwrites f = r_f and y = r_y with the preconditioner's solution */
PetscErrorCode IPTermCholeskyApply(IPTermSystem *t, const IPReducedSystem *s, PetscReal f[], PetscReal y[])
{
  IPTermCholesky *c  = &t->cholesky;
  const PetscInt  nc = s->ncompanions, nd = s->k - nc;
  PetscBLASInt    n, one                  = 1, info;

  PetscFunctionBegin;
  PetscCall(CholeskySolveInner(t, s, f, y));
  CholeskyAddBorder(t, s, -1.0, f, y, y + nc);
  PetscCall(PetscBLASIntCast(nd, &n));
  if (nd) PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &n, &one, c->H, &n, c->pivots, y + nc, &n, &info));
  for (PetscInt d = 0; d < nd; d++) {
    for (PetscInt i = 0; i < t->m; i++) f[i] += y[nc + d] * c->force[i + (size_t)d * (size_t)t->m];
    for (PetscInt a = 0; a < nc; a++) y[a] += y[nc + d] * c->companion[a + nc * d];
  }
  PetscFunctionReturn(0);
}
