/*
   Bodies with the equations K x + g = R^T f, whose systems with A = K + R^T D R are solved in a subspace: the
   unknowns W that contacts touch, and the directions P, which are zero on W. With x = w + P y and Q = K_WP
     [A_WW Q; Q^T P^T K P] (dw, dy) = (R^T s - r)
   is solved by a factorization and a dense Schur complement. The residual that is left is zero on W. A direction is
   added for it until it is small. With a fixed D this is CG with the cycle `fbf` of PCAMGF. Later systems, with other
   D, use the directions again.

   Only the symmetric matrix A_WW = K_WW + R_W^T S R_W is factored. The rest D - S couples slip and normal force. Its
   forces e = (D - S) R dx are found by GMRES, whose vectors have the size of R's rows.
*/
#include "frictionimpl.h"
#include "pc_amgf/sparse_factors.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"
#include <petscblaslapack.h>

struct _p_SubspaceBodies {
  Tao             tao;
  IPRecycle      *recycle; /* the preconditioner of K, and the directions */
  Mat             K;
  IS              W;
  Mat             R, RW;                /* rows of the contacts: three for each contact of this rank; columns W of R */
  InterfaceMatrix A;                    /* A_WW */
  Mat             F;                    /* its factors */
  KSP             coupling;             /* GMRES for the forces e of D - S */
  Vec             e, off;               /* e, scaled (BodiesScale), and what is missing to it */
  PetscBool       coupled;              /* whether D differs from S */
  Vec             x, dx, r, Kx, Kdx, g; /* K x is kept beside x, K dx beside dx */
  Vec             kept_x, kept_Kx;
  Vec             first;     /* the residual of which a part is left out; NULL: none */
  PetscReal       lacks;     /* that part */
  PetscReal       load_norm; /* largest residual [2-norm] of the normal laws since the begin */
  IPReduced       normal;    /* the problem of the normal laws, whose unknowns are those in W */
  Mat             JW;        /* normal rows of R_W */
  IS              places;    /* all unknowns of W by their number in W */
  Vec             base, rhs; /* dx = base + what the subspace adds, for the right-hand side rhs of the latter */
  Vec             on_W, dw0, load, rows;    /* work vectors on W; one with the entries of contacts */
  PetscReal      *factored, *rest;          /* S of the factors F, and D - S */
  PetscReal      *X, *schur, *factors, *dy; /* A_WW^-1 Q: columns on W; Schur complement in columns of length max; its
                                          factors */
  PetscReal      *loads;                    /* loads of the first nloads directions in this solve */
  PetscInt        nloads;
  PetscInt        nX, generation; /* number of columns of X; generation of the directions that it belongs to */
  PetscReal       enough;         /* residual [2-norm] that any solve may leave */
  PetscBLASInt   *pivots;
};

/* Copies a row of J or T to row 3 i + a of R, or counts its entries */
static PetscErrorCode BodiesCopyRow(Mat from, PetscInt row, Mat R, PetscInt to, PetscInt *count)
{
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MatGetRow(from, row, &n, &columns, &values));
  *count = n;
  if (R) PetscCall(MatSetValues(R, 1, &to, n, columns, values, INSERT_VALUES));
  PetscCall(MatRestoreRow(from, row, &n, &columns, &values));
  PetscFunctionReturn(0);
}

/*
   Creates a matrix with m rows on this rank, which are rows of two matrices with the same columns. source[i]: number of
   row i among the rows of `first` on this rank, then those of `second`; negative: the row is empty
*/
static PetscErrorCode BodiesCombineRows(Mat first, Mat second, PetscInt m, const PetscInt source[], Mat *combined)
{
  PetscInt nfirst, columns, start[2], to = 0, *counts;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(first, &nfirst, &columns));
  PetscCall(MatGetOwnershipRange(first, &start[0], NULL));
  PetscCall(MatGetOwnershipRange(second, &start[1], NULL));
  PetscCall(PetscCalloc1(m, &counts));
  *combined = NULL;
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(IPMatrixCreate(PetscObjectComm((PetscObject)first), m, columns, counts, combined));
      PetscCall(MatGetOwnershipRange(*combined, &to, NULL));
    }
    for (PetscInt i = 0; i < m; i++) {
      const PetscBool in_first = (PetscBool)(source[i] < nfirst);
      const PetscInt  row      = in_first ? start[0] + source[i] : start[1] + source[i] - nfirst;

      if (source[i] >= 0) PetscCall(BodiesCopyRow(in_first ? first : second, row, *combined, to + i, &counts[i]));
    }
  }
  PetscCall(MatAssemblyBegin(*combined, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*combined, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(0);
}

/* Creates R from the rows of constraints J and of norm terms T. n: number of contacts on this rank */
static PetscErrorCode BodiesCreateRows(Mat J, Mat T, PetscInt n, Mat *R)
{
  PetscInt mJ, mT, *source;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(J, &mJ, NULL));
  PetscCall(MatGetLocalSize(T, &mT, NULL));
  PetscCall(PetscMalloc1(3 * n, &source));
  for (PetscInt i = 0; i < n; i++) {
    source[3 * i] = i < mJ ? i : -1;
    for (PetscInt a = 0; a < 2; a++) source[3 * i + 1 + a] = 2 * i < mT ? mJ + 2 * i + a : -1;
  }
  PetscCall(BodiesCombineRows(J, T, 3 * n, source, R));
  PetscCall(PetscFree(source));
  PetscFunctionReturn(0);
}

/* Extracts R_W and K_WW, and creates A_WW */
static PetscErrorCode BodiesCreateMatrices(SubspaceBodies b)
{
  PetscInt start, end;
  IS       all;
  Mat      KWW;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(b->R, &start, &end));
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)b->R), end - start, start, 1, &all));
  PetscCall(MatCreateSubMatrix(b->R, all, b->W, MAT_INITIAL_MATRIX, &b->RW));
  PetscCall(ISDestroy(&all));
  PetscCall(IPGatherStiffness(b->K, b->W, PETSC_FALSE, &KWW));
  PetscCall(InterfaceMatrixCreate(b->RW, KWW, &b->A));
  PetscCall(MatDestroy(&KWW));
  PetscFunctionReturn(0);
}

/* Destroys what depends on W */
static PetscErrorCode BodiesDestroySpace(SubspaceBodies b)
{
  Mat *const matrices[] = {&b->RW, &b->F, &b->JW};
  Vec *const vectors[]  = {&b->on_W, &b->dw0, &b->load, &b->rows, &b->e, &b->off};

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(matrices); k++) PetscCall(MatDestroy(matrices[k]));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(vectors); k++) PetscCall(VecDestroy(vectors[k]));
  PetscCall(InterfaceMatrixDestroy(&b->A));
  PetscCall(ISDestroy(&b->W));
  PetscCall(ISDestroy(&b->places));
  PetscCall(IPReducedDestroy(&b->normal));
  PetscCall(KSPDestroy(&b->coupling));
  PetscCall(PetscFree6(b->X, b->schur, b->factors, b->dy, b->loads, b->pivots));
  PetscFunctionReturn(0);
}

/* Returns the product of two arrays with an entry per unknown of W on this rank */
static PetscReal BodiesDot(PetscInt n, const PetscScalar a[], const PetscScalar b[])
{
  PetscReal sum = 0.0;

  for (PetscInt i = 0; i < n; i++) sum += PetscRealPart(a[i] * b[i]);
  return sum;
}

/* Adds the sum of the columns of an array on W, each times its factor, to v */
static PetscErrorCode BodiesAddColumns(PetscInt k, const PetscReal factors[], const PetscScalar X[], Vec v)
{
  PetscScalar *a;
  PetscInt     m;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &m));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt j = 0; j < k; j++)
    for (PetscInt i = 0; i < m; i++) a[i] += factors[j] * X[i + (size_t)j * (size_t)m];
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Solves for the directions: C dy = dy with the Schur complement C, w -= A_WW^-1 Q dy */
static PetscErrorCode BodiesSolveSchur(SubspaceBodies b, PetscReal dy[], Vec w)
{
  const PetscInt k = b->recycle->basis.n;
  PetscReal     *minus;
  PetscBLASInt   nk, ld, one = 1, info;

  PetscFunctionBegin;
  if (!k) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(k, &nk));
  PetscCall(PetscBLASIntCast(b->recycle->basis.max, &ld));
  PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &nk, &one, b->factors, &ld, b->pivots, dy, &nk, &info));
  PetscCall(PetscMalloc1(k, &minus));
  for (PetscInt j = 0; j < k; j++) minus[j] = -dy[j];
  PetscCall(BodiesAddColumns(k, minus, b->X, w));
  PetscCall(PetscFree(minus));
  PetscFunctionReturn(0);
}

/* Returns the square root of the stiffness of a contact in the factors, by which its forces are scaled */
static PetscReal BodiesScale(const SubspaceBodies b, PetscInt i)
{
  const PetscReal *S = &b->factored[9 * i];

  return PetscSqrtReal(PetscMax(S[0], PetscMax(S[4], S[8])));
}

/* Divides the forces of contacts by their scales, or multiplies them */
static PetscErrorCode BodiesScaleForces(SubspaceBodies b, PetscBool divide, Vec v)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt r = 0; r < n; r++) {
    const PetscReal scale = BodiesScale(b, r / 3);

    a[r] = divide ? (scale > 0.0 ? a[r] / scale : 0.0) : a[r] * scale;
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Computes v = (D - S) v for a vector with the entries of contacts */
static PetscErrorCode BodiesMultiplyRest(SubspaceBodies b, Vec v)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal u[3] = {PetscRealPart(a[i]), PetscRealPart(a[i + 1]), PetscRealPart(a[i + 2])};
    PetscReal       f[3];

    ConeMultiply(&b->rest[3 * i], u, f);
    for (PetscInt r = 0; r < 3; r++) a[i + r] = f[r];
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Computes w = A_WW^-1 R_W^T forces */
static PetscErrorCode BodiesRespondOnW(SubspaceBodies b, Vec forces, Vec w)
{
  PetscFunctionBegin;
  PetscCall(MatMultTranspose(b->RW, forces, b->load));
  PetscCall(MatSolve(b->F, b->load, w));
  PetscFunctionReturn(0);
}

/* Computes the motion of W due to forces of contacts, by the symmetric matrix in the subspace */
static PetscErrorCode BodiesRespond(SubspaceBodies b, Vec forces, Vec w)
{
  const IPBasis     *basis = &b->recycle->basis;
  const PetscScalar *a;
  PetscReal         *dy;
  PetscInt           m;

  PetscFunctionBegin;
  PetscCall(BodiesRespondOnW(b, forces, w));
  PetscCall(PetscCalloc1(basis->n, &dy));
  PetscCall(VecGetLocalSize(w, &m));
  PetscCall(VecGetArrayRead(w, &a));
  for (PetscInt j = 0; j < basis->n; j++) dy[j] = -BodiesDot(m, basis->q[j], a);
  PetscCall(VecRestoreArrayRead(w, &a));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, dy, (PetscMPIInt)basis->n, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)w)));
  PetscCall(BodiesSolveSchur(b, dy, w));
  PetscCall(PetscFree(dy));
  PetscFunctionReturn(0);
}

/* Multiplies by the matrix of GMRES: y = e + (D - S) R w, where the forces e move W by w. Both e and y are scaled. */
static PetscErrorCode BodiesCoupling(Mat matrix, Vec e, Vec y)
{
  SubspaceBodies b;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(matrix, &b));
  PetscCall(VecCopy(e, y));
  PetscCall(BodiesScaleForces(b, PETSC_FALSE, y));
  PetscCall(BodiesRespond(b, y, b->on_W));
  PetscCall(MatMult(b->RW, b->on_W, y));
  PetscCall(BodiesMultiplyRest(b, y));
  PetscCall(BodiesScaleForces(b, PETSC_TRUE, y));
  PetscCall(VecAXPY(y, 1.0, e));
  PetscFunctionReturn(0);
}

/* Creates GMRES for the forces e */
static PetscErrorCode BodiesCreateCoupling(SubspaceBodies b)
{
  const PetscInt most = 60; /* iterations */
  Mat            matrix;
  PC             none;
  PetscInt       n;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(b->rows, &b->e));
  PetscCall(VecDuplicate(b->rows, &b->off));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)b->rows), n, n, PETSC_DETERMINE, PETSC_DETERMINE, b, &matrix));
  PetscCall(MatShellSetOperation(matrix, MATOP_MULT, (void (*)(void))BodiesCoupling));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)b->rows), &b->coupling));
  PetscCall(KSPSetType(b->coupling, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(b->coupling, most));
  PetscCall(KSPSetTolerances(b->coupling, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most));
  PetscCall(KSPGetPC(b->coupling, &none));
  PetscCall(PCSetType(none, PCNONE));
  PetscCall(KSPSetOperators(b->coupling, matrix, matrix));
  PetscCall(MatDestroy(&matrix));
  PetscFunctionReturn(0);
}

/* Creates what depends on W, the unknowns of the n contacts of this rank and perhaps others */
static PetscErrorCode BodiesCreateSpace(SubspaceBodies b, IS W)
{
  const PetscInt max = b->recycle->basis.max;
  PetscInt       nw;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)W));
  b->W = W;
  PetscCall(BodiesCreateMatrices(b));
  PetscCall(MatCreateVecs(b->RW, &b->on_W, &b->rows));
  PetscCall(VecDuplicate(b->on_W, &b->dw0));
  PetscCall(VecDuplicate(b->on_W, &b->load));
  PetscCall(VecGetLocalSize(b->on_W, &nw));
  PetscCall(BodiesCreateCoupling(b));
  PetscCall(PetscMalloc6((size_t)nw * (size_t)max, &b->X, max * max, &b->schur, max * max, &b->factors, max, &b->dy,
    max, &b->loads, max, &b->pivots));
  PetscFunctionReturn(0);
}

/* Destroys the vectors with an entry for each unknown */
static PetscErrorCode BodiesDestroyVectors(SubspaceBodies b)
{
  Vec *const vectors[] = {&b->x, &b->dx, &b->r, &b->Kx, &b->Kdx, &b->g, &b->kept_x, &b->kept_Kx, &b->base, &b->rhs,
    &b->first};

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(vectors); k++) PetscCall(VecDestroy(vectors[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode SubspaceBodiesDestroy(SubspaceBodies *bodies)
{
  SubspaceBodies b = *bodies;

  PetscFunctionBegin;
  if (!b) PetscFunctionReturn(0);
  PetscCall(BodiesDestroyVectors(b));
  PetscCall(BodiesDestroySpace(b));
  PetscCall(MatDestroy(&b->R));
  PetscCall(PetscFree2(b->factored, b->rest));
  PetscCall(PetscFree(*bodies));
  PetscFunctionReturn(0);
}

/*
   Creates the bodies for the present Hessian and constraints of the optimizer, with n contacts on this rank. W has the
   unknowns of the contacts.
*/
PetscErrorCode SubspaceBodiesCreate(Tao tao, IPRecycle *recycle, IS W, PetscInt n, SubspaceBodies *bodies)
{
  TAO_IPFILTER  *ip = (TAO_IPFILTER *)tao->data;
  SubspaceBodies b;
  Vec           *like_x[9];

  PetscFunctionBegin;
  PetscCall(PetscNew(bodies));
  b          = *bodies;
  b->tao     = tao;
  b->recycle = recycle;
  b->K       = ip->hess->H;
  PetscCall(BodiesCreateRows(ip->jac->inequality, ip->terms->T, n, &b->R));
  PetscCall(BodiesCreateSpace(b, W));
  PetscCall(PetscMalloc2(9 * n, &b->factored, 9 * n, &b->rest));
  PetscCall(PetscArraycpy(like_x,
    ((Vec *[]){&b->x, &b->dx, &b->r, &b->Kx, &b->Kdx, &b->kept_x, &b->kept_Kx, &b->base, &b->rhs}), 9));
  for (PetscInt k = 0; k < 9; k++) PetscCall(VecDuplicate(tao->solution, like_x[k]));
  PetscFunctionReturn(0);
}

/* Sets the origin x = 0: a point with the gradient g */
PetscErrorCode SubspaceBodiesCentre(SubspaceBodies b, Vec g)
{
  PetscFunctionBegin;
  if (!b->g) PetscCall(VecDuplicate(g, &b->g));
  PetscCall(VecCopy(g, b->g));
  PetscCall(VecZeroEntries(b->x));
  PetscCall(VecZeroEntries(b->Kx));
  PetscCall(VecDestroy(&b->first));
  b->load_norm = 0.0;
  PetscFunctionReturn(0);
}

/* Sets the residual [2-norm] that any solve may leave */
void SubspaceBodiesSetEnough(SubspaceBodies b, PetscReal enough)
{
  b->enough = enough;
}

/* Gets x, which is relative to the origin */
Vec SubspaceBodiesGet(SubspaceBodies b)
{
  return b->x;
}

/* Computes the compliance of each contact's normal component, and the larger one of its tangential components, as if no
   unknown moved any other [length/force] */
PetscErrorCode SubspaceBodiesGetCompliance(SubspaceBodies b, PetscInt n, PetscReal compliance[])
{
  PetscInt           start;
  const PetscScalar *k;
  PetscReal          sum[3];
  Mat                squares;
  Vec                inverse;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(b->on_W, &inverse));
  PetscCall(VecISCopy(((TAO_IPFILTER *)b->tao->data)->stiff->hdiag, b->W, SCATTER_REVERSE, inverse));
  PetscCall(VecReciprocal(inverse));
  PetscCall(MatDuplicate(b->RW, MAT_COPY_VALUES, &squares));
  PetscCall(MatGetOwnershipRange(squares, &start, NULL));
  for (PetscInt part = 0; part < 2; part++) {
    Mat          local = NULL;
    PetscScalar *values;
    MatInfo      info;
    PetscMPIInt  size;

    PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)squares), &size));
    if (size == 1) local = part ? NULL : squares;
    else PetscCall(MatMPIAIJGetSeqAIJ(squares, part ? NULL : &local, part ? &local : NULL, NULL));
    if (!local) continue;
    PetscCall(MatGetInfo(local, MAT_LOCAL, &info));
    PetscCall(MatSeqAIJGetArray(local, &values));
    for (PetscInt j = 0; j < (PetscInt)info.nz_used; j++) values[j] *= values[j];
    PetscCall(MatSeqAIJRestoreArray(local, &values));
  }
  PetscCall(MatMult(squares, inverse, b->rows));
  PetscCall(VecGetArrayRead(b->rows, &k));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt a = 0; a < 3; a++) sum[a] = PetscRealPart(k[3 * i + a]);
    compliance[2 * i]     = sum[0];
    compliance[2 * i + 1] = PetscMax(sum[1], sum[2]);
  }
  PetscCall(VecRestoreArrayRead(b->rows, &k));
  PetscCall(MatDestroy(&squares));
  PetscCall(VecDestroy(&inverse));
  PetscFunctionReturn(0);
}

/* Computes y = R^T f, or y += R^T f */
static PetscErrorCode BodiesSpread(SubspaceBodies b, const PetscReal f[], PetscBool add, Vec y)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(VecGetArrayWrite(b->rows, &a));
  PetscCall(PetscArraycpy(a, f, n));
  PetscCall(VecRestoreArrayWrite(b->rows, &a));
  if (add) PetscCall(MatMultTransposeAdd(b->R, b->rows, y, y));
  else PetscCall(MatMultTranspose(b->R, b->rows, y));
  PetscFunctionReturn(0);
}

/* Returns the largest entry of v, where each is divided by the square root of K's diagonal entry */
static PetscErrorCode BodiesSize(SubspaceBodies b, Vec v, PetscReal *size)
{
  const PetscScalar *a, *d;
  PetscInt           n;
  PetscReal          largest  = 0.0;
  const Vec          diagonal = ((TAO_IPFILTER *)b->tao->data)->stiff->hdiag;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &a));
  PetscCall(VecGetArrayRead(diagonal, &d));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(d[i]) > 0.0) largest = PetscMax(largest, PetscSqr(PetscAbsScalar(a[i])) / PetscAbsScalar(d[i]));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(&largest, size, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)v)));
  *size = PetscSqrtReal(*size);
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesResidual(void *data, const PetscReal f[], PetscReal *size)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  PetscCall(BodiesSpread(b, f, PETSC_FALSE, b->r));
  PetscCall(VecAYPX(b->r, -1.0, b->g));
  PetscCall(VecAXPY(b->r, 1.0, b->Kx));
  if (b->first) PetscCall(VecAXPY(b->r, -b->lacks, b->first));
  PetscCall(IPFixedZero(b->tao, b->r));
  if (size) PetscCall(BodiesSize(b, b->r, size));
  PetscFunctionReturn(0);
}

/* Finds whether the factors are those of an S that differs from the given one by a small fraction in each contact */
static PetscErrorCode BodiesAreFactored(const SubspaceBodies b, const PetscReal S[], PetscBool *factored)
{
  const PetscReal small = 1e-2; /* GMRES corrects the difference */
  PetscInt        n;

  PetscFunctionBegin;
  *factored = (PetscBool)(b->F != NULL);
  PetscCall(VecGetLocalSize(b->rows, &n));
  for (PetscInt k = 0; k < n && *factored; k++) { /* column k % 3 of the contact k / 3, whose columns differ in size */
    PetscReal change = 0.0, size = 0.0;

    for (PetscInt j = 9 * (k / 3) + k % 3; j < 9 * (k / 3) + 9; j += 3) {
      change = PetscMax(change, PetscAbsReal(S[j] - b->factored[j]));
      size   = PetscMax(size, PetscAbsReal(b->factored[j]));
    }
    *factored = (PetscBool)(change <= small * size);
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, factored, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)b->rows)));
  PetscFunctionReturn(0);
}

/* Factors A_WW */
static PetscErrorCode BodiesFactor(SubspaceBodies b, const PetscReal S[], PetscBool *factored)
{
  MatFactorError error;
  PetscInt       n, negative;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
  PetscCall(InterfaceMatrixAssemble(b->A, S));
  PetscCall(AMGFSymmetricFactor(InterfaceMatrixGet(b->A), NULL, &b->F, &negative, &error));
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  if (!*factored) PetscCall(MatDestroy(&b->F));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(PetscArraycpy(b->factored, S, 3 * n));
  b->nX = 0;
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Sets D, and factors A_WW unless its factors are almost the present ones */
static PetscErrorCode BodiesPrepare(void *data, const PetscReal D[], const PetscReal S[], PetscBool *prepared)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  PetscInt             n;

  PetscFunctionBegin;
  PetscCall(BodiesAreFactored(b, S, prepared));
  if (!*prepared) PetscCall(BodiesFactor(b, S, prepared));
  PetscCall(VecGetLocalSize(b->rows, &n));
  b->coupled = PETSC_FALSE;
  for (PetscInt j = 0; j < 3 * n; j++) {
    b->rest[j] = D[j] - b->factored[j];
    b->coupled = (PetscBool)(b->coupled || b->rest[j] != 0.0);
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, &b->coupled, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)b->rows)));
  PetscFunctionReturn(0);
}

/* Creates a dense matrix of n columns on W. columns: their local entries */
static PetscErrorCode BodiesDense(SubspaceBodies b, PetscInt n, PetscScalar columns[], Mat *dense)
{
  PetscInt m, M;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->on_W, &m));
  PetscCall(VecGetSize(b->on_W, &M));
  PetscCall(MatCreateDense(PetscObjectComm((PetscObject)b->on_W), m, PETSC_DECIDE, M, n, columns, dense));
  PetscFunctionReturn(0);
}

/* Computes the columns of A_WW^-1 Q that are missing */
static PetscErrorCode BodiesSolveDirections(SubspaceBodies b)
{
  const IPBasis *basis = &b->recycle->basis;
  PetscInt       m, n;
  PetscScalar   *Q;
  Mat            dense[2];

  PetscFunctionBegin;
  if (b->generation != basis->generation) b->nX = 0;
  b->generation = basis->generation;
  n             = basis->n - b->nX;
  if (!n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(b->on_W, &m));
  PetscCall(PetscMalloc1((size_t)m * (size_t)n, &Q));
  for (PetscInt j = 0; j < n; j++) PetscCall(PetscArraycpy(Q + j * m, basis->q[b->nX + j], m));
  PetscCall(BodiesDense(b, n, Q, &dense[0]));
  PetscCall(BodiesDense(b, n, b->X + (size_t)m * (size_t)b->nX, &dense[1]));
  PetscCall(MatMatSolve(b->F, dense[0], dense[1]));
  PetscCall(MatDestroy(&dense[0]));
  PetscCall(MatDestroy(&dense[1]));
  PetscCall(PetscFree(Q));
  PetscFunctionReturn(0);
}

/* Computes the missing rows and columns of the Schur complement C = P^T K P - Q^T A_WW^-1 Q, and its factors */
static PetscErrorCode BodiesFactorDirections(SubspaceBodies b, PetscBool *factored)
{
  const IPBasis *basis = &b->recycle->basis;
  const PetscInt k = basis->n, old = b->generation == basis->generation ? b->nX : 0;
  PetscInt       m, count          = 0;
  PetscReal     *sums;
  PetscBLASInt   nk, ld, info = 0;

  PetscFunctionBegin;
  *factored = PETSC_TRUE;
  PetscCall(BodiesSolveDirections(b));
  PetscCall(VecGetLocalSize(b->on_W, &m));
  PetscCall(PetscMalloc1(k * k - old * old, &sums));
  for (PetscInt j = 0; j < k; j++)
    for (PetscInt i = j < old ? old : 0; i < k; i++)
      sums[count++] = BodiesDot(m, basis->q[i], b->X + (size_t)j * (size_t)m);
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)count, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)b->on_W)));
  count = 0;
  for (PetscInt j = 0; j < k; j++)
    for (PetscInt i = j < old ? old : 0; i < k; i++)
      b->schur[i + j * basis->max] = basis->gram[i + j * basis->max] - sums[count++];
  PetscCall(PetscFree(sums));
  b->nX = k;
  if (!k) PetscFunctionReturn(0);
  for (PetscInt j = 0; j < k; j++) PetscCall(PetscArraycpy(b->factors + j * basis->max, b->schur + j * basis->max, k));
  PetscCall(PetscBLASIntCast(k, &nk));
  PetscCall(PetscBLASIntCast(basis->max, &ld));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&nk, &nk, b->factors, &ld, b->pivots, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/* Computes the loads P^T rhs - Q^T dw0 of the directions that are new in this solve */
static PetscErrorCode BodiesLoadDirections(SubspaceBodies b)
{
  const IPBasis     *basis = &b->recycle->basis;
  const PetscInt     first = b->nloads, n = basis->n - first;
  const PetscScalar *w;
  PetscInt           m;
  PetscReal         *sums;

  PetscFunctionBegin;
  if (n <= 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(n, &sums));
  PetscCall(VecGetLocalSize(b->dw0, &m));
  PetscCall(VecGetArrayRead(b->dw0, &w));
  for (PetscInt j = 0; j < n; j++) sums[j] = BodiesDot(m, basis->q[first + j], w);
  PetscCall(VecRestoreArrayRead(b->dw0, &w));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)n, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)b->dx)));
  PetscCall(IPBasisDots(basis, first, n, b->rhs, b->loads + first));
  for (PetscInt j = 0; j < n; j++) b->loads[first + j] -= sums[j];
  PetscCall(PetscFree(sums));
  b->nloads = basis->n;
  PetscFunctionReturn(0);
}

/*
   Computes dx = base + (dw, dy) with dw0 = A_WW^-1 rhs_W, C dy = P^T rhs - Q^T dw0, dw = dw0 - A_WW^-1 Q dy
*/
static PetscErrorCode BodiesSolveInSubspace(SubspaceBodies b)
{
  const IPBasis *basis = &b->recycle->basis;

  PetscFunctionBegin;
  PetscCall(VecCopy(b->dw0, b->load));
  PetscCall(VecCopy(b->base, b->dx));
  PetscCall(BodiesLoadDirections(b));
  PetscCall(PetscArraycpy(b->dy, b->loads, basis->n));
  PetscCall(BodiesSolveSchur(b, b->dy, b->load));
  PetscCall(IPBasisAdd(basis, b->dy, b->dx));
  PetscCall(VecISAXPY(b->dx, b->W, 1.0, b->load));
  PetscFunctionReturn(0);
}

/*
   Solves in the subspace. With the forces e, dx is that of the symmetric matrix for the load without R^T e. Then e is
   corrected until it is (D - S) R dx.
*/
static PetscErrorCode BodiesSolveCoupled(SubspaceBodies b, PetscBool *solved)
{
  const PetscReal exact = 1e-3 * CONTACT_WEAK, /* of e, which contains the forces of weak springs */
    enough              = 1e-2; /* after many iterations: Newton's method and the cones correct what is left */
  PetscReal size, off;

  PetscFunctionBegin;
  PetscCall(BodiesSolveInSubspace(b));
  if (!b->coupled) PetscFunctionReturn(0);
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(BodiesMultiplyRest(b, b->rows));
  PetscCall(BodiesScaleForces(b, PETSC_TRUE, b->rows));
  PetscCall(VecNorm(b->rows, NORM_2, &size));
  PetscCall(VecAXPY(b->rows, -1.0, b->e));
  PetscCall(VecNorm(b->rows, NORM_2, &off));
  *solved = (PetscBool)!PetscIsInfOrNanReal(off);
  if (!*solved || off <= exact * size) PetscFunctionReturn(0);
  PetscCall(KSPSetTolerances(b->coupling, PETSC_SMALL, exact * size, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSolve(b->coupling, b->rows, b->off));
  PetscCall(KSPGetResidualNorm(b->coupling, &off));
  *solved = (PetscBool)(off <= enough * size);
  PetscCall(VecAXPY(b->e, 1.0, b->off));
  PetscCall(BodiesScaleForces(b, PETSC_FALSE, b->off));
  PetscCall(BodiesRespondOnW(b, b->off, b->on_W));
  PetscCall(VecAXPY(b->dw0, -1.0, b->on_W));
  b->nloads = 0;
  PetscCall(BodiesSolveInSubspace(b));
  PetscFunctionReturn(0);
}

/* Computes K dx, and the residual that dx leaves in v, which is zero on W, and its 2-norm */
static PetscErrorCode BodiesLeft(SubspaceBodies b, Vec v, PetscReal *norm)
{
  PetscFunctionBegin;
  PetscCall(MatMult(b->K, b->dx, b->Kdx));
  PetscCall(VecWAXPY(v, 1.0, b->r, b->Kdx));
  PetscCall(VecScale(v, -1.0));
  PetscCall(IPFixedZero(b->tao, v));
  PetscCall(VecISSet(v, b->W, 0.0));
  PetscCall(VecNorm(v, NORM_2, norm));
  PetscFunctionReturn(0);
}

/* Reduces the number of directions, and keeps those combinations that are coupled to W most. The next solution in the
   subspace adds to dx, which the directions that are left do not contain. left: the residual of dx */
static PetscErrorCode BodiesMakeRoom(SubspaceBodies b, Vec left)
{
  IPBasis       *basis = &b->recycle->basis;
  const PetscInt max   = basis->max;
  PetscReal     *E;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(max * max, &E));
  for (PetscInt j = 0; j < basis->n; j++)
    for (PetscInt i = 0; i < basis->n; i++)
      E[i + j * max] = basis->gram[i + j * max] - 0.5 * (b->schur[i + j * max] + b->schur[j + i * max]);
  PetscCall(IPSubspaceCompress(b->tao, basis, E));
  PetscCall(PetscFree(E));
  PetscCall(VecCopy(b->dx, b->base));
  PetscCall(VecCopy(left, b->rhs));
  PetscCall(VecZeroEntries(b->dw0));
  b->nloads = 0;
  PetscFunctionReturn(0);
}

/* Adds a direction for the residual `left`. *added: false if K is not positive along it, or it depends on the others */
static PetscErrorCode BodiesExtend(SubspaceBodies b, Vec left, PetscBool *added)
{
  Vec d;

  PetscFunctionBegin;
  PetscCall(IPSubspaceAllows(b->tao, added));
  if (!*added) PetscFunctionReturn(0);
  if (b->recycle->basis.n == b->recycle->basis.max) PetscCall(BodiesMakeRoom(b, left));
  PetscCall(IPGetWork(b->tao, IP_UNKNOWNS, &d));
  PetscCall(IPSubspacePrecondition(b->tao, b->recycle, left, d, added));
  PetscCall(VecISSet(d, b->W, 0.0));
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, b->tao, d, NULL, NULL));
  if (*added) PetscCall(IPBasisAppend(&b->recycle->basis, b->K, d, added));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, b->tao, d, NULL, NULL));
  PetscCall(IPRestoreWork(b->tao, IP_UNKNOWNS, &d));
  if (*added) ((TAO_IPFILTER *)b->tao->data)->rec->ndirections++;
  PetscFunctionReturn(0);
}

/*
   Finds whether directions cost more than factors of the whole matrix: many were added for one system of a small
   problem. This happens if bodies are slender.
*/
static PetscErrorCode BodiesAreSlow(SubspaceBodies b, PetscInt nadded, PetscBool *slow)
{
  const PetscInt many = 30;
  PetscInt       n, nw;

  PetscFunctionBegin;
  PetscCall(VecGetSize(b->x, &n));
  PetscCall(ISGetSize(b->W, &nw));
  *slow = (PetscBool)(nadded > many && n <= IP_WHOLE && nw < n);
  PetscFunctionReturn(0);
}

/* Extends W to all unknowns, in this solve and in later ones, and factors the matrix again */
static PetscErrorCode BodiesWiden(SubspaceBodies b, PetscBool *prepared)
{
  IPSubspace *f = IPSubspaceOf(b->tao);
  PetscInt    n;
  PetscReal  *S;

  PetscFunctionBegin;
  PetscCall(PetscInfo(b->tao, "W is extended to all unknowns, since directions are slow\n"));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(IPSubspaceTakeAll(b->tao));
  b->recycle->whole = PETSC_TRUE;
  PetscCall(IPBasisDropOldest(&b->recycle->basis, b->recycle->basis.n));
  PetscCall(IPBasisUpdate(&b->recycle->basis, b->K, PETSC_FALSE, ((TAO_IPFILTER *)b->tao->data)->fixed, f->W));
  PetscCall(BodiesDestroySpace(b));
  PetscCall(BodiesCreateSpace(b, f->W));
  PetscCall(PetscMalloc1(3 * n, &S));
  PetscCall(PetscArraycpy(S, b->factored, 3 * n));
  PetscCall(BodiesFactor(b, S, prepared));
  PetscCall(PetscFree(S));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesSolve(void *data, const PetscReal s[], PetscReal fraction, PetscReal target, PetscReal du[],
  PetscBool *solved)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  const PetscScalar   *u;
  PetscReal            norm, size, first = PETSC_INFINITY;
  PetscBool            added = PETSC_TRUE, slow = PETSC_FALSE;
  PetscInt             n;
  Vec                  left;

  PetscFunctionBegin;
  PetscCall(IPGetWork(b->tao, IP_UNKNOWNS, &left));
  PetscCall(BodiesSpread(b, s, PETSC_FALSE, b->rhs));
  PetscCall(VecAXPY(b->rhs, -1.0, b->r));
  PetscCall(VecZeroEntries(b->base));
  PetscCall(VecISCopy(b->rhs, b->W, SCATTER_REVERSE, b->load));
  PetscCall(MatSolve(b->F, b->load, b->dw0));
  b->nloads = 0;
  PetscCall(VecZeroEntries(b->e));
  for (PetscInt k = 0;; k++) {
    PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    PetscCall(BodiesFactorDirections(b, solved));
    if (*solved) PetscCall(BodiesSolveCoupled(b, solved));
    PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    if (!*solved) break;
    PetscCall(BodiesLeft(b, left, &norm));
    PetscCall(BodiesSize(b, left, &size));
    *solved = (PetscBool)!PetscIsInfOrNanReal(size);
    if (!k) first = size;
    if (!*solved || size <= PetscMax(fraction * first, target) || (fraction > 0.0 && norm <= b->enough)) break;
    PetscCall(BodiesAreSlow(b, k, &slow));
    if (slow) break;
    PetscCall(BodiesExtend(b, left, &added));
    if (!added) break;
  }
  PetscCall(IPRestoreWork(b->tao, IP_UNKNOWNS, &left));
  if (slow) {
    PetscCall(BodiesWiden(b, solved));
    if (*solved) PetscCall(BodiesSolve(data, s, fraction, target, du, solved));
    PetscFunctionReturn(0);
  }
  *solved = (PetscBool)(*solved && (added || size < first));
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(VecGetArrayRead(b->rows, &u));
  for (PetscInt i = 0; i < n; i++) du[i] = PetscRealPart(u[i]);
  PetscCall(VecRestoreArrayRead(b->rows, &u));
  PetscFunctionReturn(0);
}

/* Sets up the problem of the normal laws for the matrix A_WW. gaps: the normal components of motions; own: compliance
   of contacts */
static PetscErrorCode BodiesSetUpNormal(SubspaceBodies b, const PetscReal own[], Vec gaps, PetscBool *definite)
{
  PetscInt start, end;
  Vec      compliance;

  PetscFunctionBegin;
  if (!b->JW) {
    IS rows, columns;

    PetscCall(MatGetOwnershipRange(b->RW, &start, &end));
    PetscCall(ISCreateStride(PetscObjectComm((PetscObject)b->RW), (end - start) / 3, start, 3, &rows));
    PetscCall(VecGetOwnershipRange(b->on_W, &start, &end));
    PetscCall(ISCreateStride(PetscObjectComm((PetscObject)b->RW), end - start, start, 1, &columns));
    PetscCall(MatCreateSubMatrix(b->RW, rows, columns, MAT_INITIAL_MATRIX, &b->JW));
    PetscCall(ISDestroy(&rows));
    b->places = columns;
  }
  PetscCall(VecGetLocalSize(gaps, &end));
  PetscCall(VecCreateMPIWithArray(PetscObjectComm((PetscObject)gaps), 1, end, PETSC_DETERMINE, own, &compliance));
  PetscCall(IPReducedSetUp(&b->normal, InterfaceMatrixGet(b->A), b->JW, compliance, b->places, b->W, b->x, gaps,
    &b->recycle->basis, definite));
  PetscCall(VecDestroy(&compliance));
  PetscFunctionReturn(0);
}

/* Centres the problem of the normal laws at the present point. b->rhs: the gradient without normal forces */
static PetscErrorCode BodiesCentreNormal(SubspaceBodies b, Vec gaps)
{
  const IPBasis *basis = &b->recycle->basis;

  PetscFunctionBegin;
  PetscCall(IPBasisDots(basis, 0, basis->n, b->rhs, b->dy));
  PetscCall(IPReducedCenter(&b->normal, b->rhs, gaps, b->dy));
  PetscCall(IPReducedAppend(&b->normal, basis, b->dy));
  PetscFunctionReturn(0);
}

/* Solves the normal laws in the subspace: b->dx, and the normal forces */
static PetscErrorCode BodiesSolveReducedNormal(SubspaceBodies b, Vec force, PetscBool *solved)
{
  PetscFunctionBegin;
  b->normal.system.rounding =
    ((TAO_IPFILTER *)b->tao->data)->first->jacobian * ((TAO_IPFILTER *)b->tao->data)->given->rounding;
  b->normal.system.soft = b->recycle->basis.has_modes;
  PetscCall(VecCopy(b->base, b->dx));
  PetscCall(VecISSet(b->dx, b->W, 0.0));
  PetscCall(IPReducedSolve(&b->normal, b->dy, b->dx, force, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(IPBasisAdd(&b->recycle->basis, b->dy, b->dx));
  PetscCall(VecISCopy(b->base, b->W, SCATTER_REVERSE, b->load));
  PetscCall(VecISAXPY(b->dx, b->W, 1.0, b->load));
  PetscFunctionReturn(0);
}

/*
   Reduces the number of directions. The problem of the normal laws is then centred at dx, which the directions that are
   left do not contain: its gradient b->rhs and the gaps grow by what dx changes.
*/
static PetscErrorCode BodiesMakeRoomNormal(SubspaceBodies b, const PetscReal D[], Vec gaps)
{
  IPBasis           *basis = &b->recycle->basis;
  const PetscScalar *u;
  PetscScalar       *g;
  PetscReal         *E, *springs;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(basis->max * basis->max, &E));
  PetscCall(IPReducedCoupling(&b->normal, basis, E));
  PetscCall(IPSubspaceCompress(b->tao, basis, E));
  PetscCall(PetscFree(E));
  PetscCall(IPReducedForget(&b->normal, basis));
  PetscCall(VecGetLocalSize(gaps, &n));
  PetscCall(PetscMalloc1(3 * n, &springs));
  PetscCall(VecAXPY(b->dx, -1.0, b->base)); /* what this centre adds */
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(VecGetArrayRead(b->rows, &u));
  PetscCall(VecGetArray(gaps, &g));
  for (PetscInt i = 0; i < n; i++) {
    g[i] += u[3 * i];
    ConeMultiply(&D[9 * i], &u[3 * i], &springs[3 * i]);
  }
  PetscCall(VecRestoreArray(gaps, &g));
  PetscCall(VecRestoreArrayRead(b->rows, &u));
  PetscCall(BodiesSpread(b, springs, PETSC_TRUE, b->rhs));
  PetscCall(MatMultAdd(b->K, b->dx, b->rhs, b->rhs));
  PetscCall(IPFixedZero(b->tao, b->rhs));
  PetscCall(VecAXPY(b->base, 1.0, b->dx));
  PetscCall(PetscFree(springs));
  PetscFunctionReturn(0);
}

/* Finds dx and the normal forces to the accuracy that the choice of held contacts needs */
static PetscErrorCode BodiesIterateNormal(SubspaceBodies b, const PetscReal D[], Vec gaps, Vec force, PetscBool *solved)
{
  const PetscReal exact = 1e-11; /* residual that may be left, relative to the largest one: more would decide which
                                   contacts are held */
  PetscReal       norm;
  PetscBool       added;
  Vec             left;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(b->base));
  PetscCall(IPGetWork(b->tao, IP_UNKNOWNS, &left));
  do {
    added = PETSC_FALSE;
    PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    PetscCall(BodiesCentreNormal(b, gaps));
    PetscCall(BodiesSolveReducedNormal(b, force, solved));
    PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    if (!*solved) break;
    PetscCall(BodiesLeft(b, left, &norm));
    *solved      = (PetscBool)!PetscIsInfOrNanReal(norm);
    b->load_norm = PetscMax(b->load_norm, norm);
    if (!*solved || norm <= PetscMin(exact * b->load_norm, b->enough)) break;
    if (b->recycle->basis.n == b->recycle->basis.max) PetscCall(BodiesMakeRoomNormal(b, D, gaps));
    PetscCall(BodiesExtend(b, left, &added));
  } while (added);
  PetscCall(IPRestoreWork(b->tao, IP_UNKNOWNS, &left));
  PetscFunctionReturn(0);
}

/* Computes du = R dx, and the changes of the forces */
static PetscErrorCode BodiesGetChanges(SubspaceBodies b, const PetscReal own[], const PetscReal D[],
  const PetscReal s[], const PetscReal f[], Vec force, PetscReal du[], PetscReal df[])
{
  const PetscScalar *a, *normal;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(force, &n));
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(VecGetArrayRead(b->rows, &a));
  PetscCall(VecGetArrayRead(force, &normal));
  for (PetscInt i = 0; i < n; i++) {
    PetscReal change[3];

    for (PetscInt r = 3 * i; r < 3 * i + 3; r++) du[r] = PetscRealPart(a[r]);
    ConeMultiply(&D[9 * i], &du[3 * i], change);
    for (PetscInt c = 0; c < 3; c++) df[3 * i + c] = s[3 * i + c] - change[c];
    df[3 * i] = PetscRealPart(normal[i]) + s[3 * i] - f[3 * i];
    du[3 * i] += own[i] * df[3 * i];
  }
  PetscCall(VecRestoreArrayRead(force, &normal));
  PetscCall(VecRestoreArrayRead(b->rows, &a));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesSolveNormal(void *data, const PetscReal own[], const PetscReal D[], const PetscReal s[],
  const PetscReal f[], const PetscReal u[], PetscReal du[], PetscReal df[], PetscBool *solved)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  PetscScalar         *g;
  PetscInt             n;
  Vec                  gaps, force;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->rows, &n));
  n /= 3;
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)b->rows), n, PETSC_DETERMINE, &gaps));
  PetscCall(VecDuplicate(gaps, &force));
  PetscCall(VecGetArrayWrite(gaps, &g));
  for (PetscInt i = 0; i < n; i++) {
    g[i] = u[3 * i] + own[i] * (s[3 * i] - f[3 * i]); /* with the force s */
    for (PetscInt c = 0; c < 3; c++) df[3 * i + c] = s[3 * i + c] - (c ? 0.0 : f[3 * i]);
  }
  PetscCall(VecRestoreArrayWrite(gaps, &g));
  PetscCall(BodiesSpread(b, df, PETSC_FALSE, b->rhs));
  PetscCall(VecAYPX(b->rhs, -1.0, b->r));
  PetscCall(IPFixedZero(b->tao, b->rhs));
  PetscCall(InterfaceMatrixAssemble(b->A, D));
  PetscCall(BodiesSetUpNormal(b, own, gaps, solved));
  if (*solved) PetscCall(BodiesIterateNormal(b, D, gaps, force, solved));
  if (*solved) PetscCall(BodiesGetChanges(b, own, D, s, f, force, du, df));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&gaps));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesWork(void *data, PetscReal *work)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  PetscScalar          dot;

  PetscFunctionBegin;
  PetscCall(VecDot(b->r, b->dx, &dot));
  *work = PetscRealPart(dot);
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesLoad(void *data, PetscReal fraction)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  if (!b->first) {
    PetscCall(VecDuplicate(b->r, &b->first));
    PetscCall(VecCopy(b->r, b->first));
  }
  b->lacks = 1.0 - fraction;
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesAdvance(void *data, PetscReal fraction)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  PetscCall(VecAXPY(b->x, fraction, b->dx));
  PetscCall(VecAXPY(b->Kx, fraction, b->Kdx));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesKeep(void *data, PetscBool back)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  PetscCall(VecCopy(back ? b->kept_x : b->x, back ? b->x : b->kept_x));
  PetscCall(VecCopy(back ? b->kept_Kx : b->Kx, back ? b->Kx : b->kept_Kx));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesInterrupted(void *data, PetscBool *stop)
{
  const IPGiven *given = ((TAO_IPFILTER *)((SubspaceBodies)data)->tao->data)->given;

  PetscFunctionBegin;
  *stop = PETSC_FALSE;
  if (given->interrupt) PetscCall(given->interrupt(given->interrupt_ctx, stop));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, stop, 1, MPI_PETSCBOOL, MPI_LOR,
    PetscObjectComm((PetscObject)((SubspaceBodies)data)->x)));
  PetscFunctionReturn(0);
}

/* Gets the interface of the bodies that the laws of contacts use */
ContactBodies SubspaceBodiesInterface(SubspaceBodies b)
{
  const ContactBodies bodies = {
    .data         = b,
    .definite     = ((TAO_IPFILTER *)b->tao->data)->given->definite,
    .residual     = BodiesResidual,
    .prepare      = BodiesPrepare,
    .solve        = BodiesSolve,
    .solve_normal = BodiesSolveNormal,
    .work         = BodiesWork,
    .load         = BodiesLoad,
    .advance      = BodiesAdvance,
    .keep         = BodiesKeep,
    .interrupted  = BodiesInterrupted,
  };

  return bodies;
}
