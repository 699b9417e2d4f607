/*
   Treats the caller's matrices according to their type. AIJ matrices, and Hessians of type BAIJ, SBAIJ or dense, are
   used directly. Types that MatConvert() can convert to AIJ are converted at every evaluation. A Hessian that only has
   products can be used with solvers that need no entries. A small matrix of this kind is converted column by column.
*/
#include "problemimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/rows.h"

#define IP_COLUMNS_MAX \
  1000 /* Largest number of unknowns for which a matrix that only has products is converted, by products with unit
          vectors */

/* Types that give no rows, but that MatConvert() converts to AIJ */
static const char *const converted_types[] = {MATNEST, MATIS, MATHYPRE, MATTRANSPOSEVIRTUAL, NULL};

/*
   Preconditioners that read the entries of their matrix. A type that is not listed may be the caller's own and is
   assumed not to read entries.
*/
static const char *const reading_pcs[] = {PCAMGF, PCHYPRE, PCGAMG, PCML, PCMG, PCHMG, PCBJACOBI, PCASM, PCGASM, PCSOR,
  PCEISENSTAT, PCLU, PCILU, PCCHOLESKY, PCICC, PCQR, PCSVD, PCREDUNDANT, PCTELESCOPE, PCPBJACOBI, PCVPBJACOBI,
  PCKACZMARZ, PCSPAI, PCBDDC, PCNN, PCFIELDSPLIT, PCTFS, PCDEFLATION, PCCP, NULL};

static PetscErrorCode MatrixIsOneOf(PetscObject object, const char *const types[], PetscBool *is)
{
  PetscFunctionBegin;
  *is = PETSC_FALSE;
  for (PetscInt k = 0; types[k] && !*is; k++) PetscCall(PetscObjectTypeCompare(object, types[k], is));
  PetscFunctionReturn(0);
}

static PetscErrorCode MatrixHasRows(Mat A, PetscBool *has)
{
  PetscBool half;

  PetscFunctionBegin;
  PetscCall(MatHasOperation(A, MATOP_GET_ROW, has));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &half, MATSEQSBAIJ, MATMPISBAIJ, ""));
  *has = (PetscBool)(*has || half);
  PetscFunctionReturn(0);
}

static PetscErrorCode MatrixHasEntries(Mat, PetscBool *);

/* Finds whether every block of a nested matrix has entries */
static PetscErrorCode NestHasEntries(Mat A, PetscBool *has)
{
  PetscInt m, n;
  Mat    **blocks;

  PetscFunctionBegin;
  PetscCall(MatNestGetSubMats(A, &m, &n, &blocks));
  for (PetscInt k = 0; k < m * n && *has; k++)
    if (blocks[k / n][k % n]) PetscCall(MatrixHasEntries(blocks[k / n][k % n], has));
  PetscFunctionReturn(0);
}

/* Finds whether the entries of a matrix can be read, directly or after conversion */
static PetscErrorCode MatrixHasEntries(Mat A, PetscBool *has)
{
  PetscBool nest;

  PetscFunctionBegin;
  PetscCall(MatrixHasRows(A, has));
  if (*has) PetscFunctionReturn(0);
  PetscCall(MatrixIsOneOf((PetscObject)A, converted_types, has));
  PetscCall(PetscObjectTypeCompare((PetscObject)A, MATNEST, &nest));
  if (nest) PetscCall(NestHasEntries(A, has));
  PetscFunctionReturn(0);
}

/* Finds whether two matrices of the same layout have the same nonzero pattern, on all ranks */
PetscErrorCode IPMatrixSamePattern(Mat A, Mat B, PetscBool *same)
{
  PetscInt rstart, rend;

  PetscFunctionBegin;
  *same = PETSC_TRUE;
  PetscCall(MatGetOwnershipRange(A, &rstart, &rend));
  for (PetscInt i = rstart; i < rend && *same; i++) {
    PetscInt        na, nb;
    const PetscInt *a, *b;

    PetscCall(MatGetRow(A, i, &na, &a, NULL));
    PetscCall(MatGetRow(B, i, &nb, &b, NULL));
    *same = (PetscBool)(na == nb);
    if (*same) PetscCall(PetscArraycmp(a, b, na, same));
    PetscCall(MatRestoreRow(B, i, &nb, &b, NULL));
    PetscCall(MatRestoreRow(A, i, &na, &a, NULL));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, same, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)A)));
  PetscFunctionReturn(0);
}

/*
   Replaces *kept by the new matrix *fresh. If the patterns are equal, only the values are copied, so that data derived
   from the pattern can be reused.
*/
PetscErrorCode IPMatrixKeep(Mat *fresh, Mat *kept)
{
  PetscBool same = PETSC_FALSE;

  PetscFunctionBegin;
  if (*kept) PetscCall(IPMatrixSamePattern(*kept, *fresh, &same));
  if (same) {
    PetscCall(MatCopy(*fresh, *kept, SAME_NONZERO_PATTERN));
    PetscCall(MatDestroy(fresh));
  } else {
    PetscCall(MatDestroy(kept));
    *kept = *fresh;
  }
  *fresh = NULL;
  PetscFunctionReturn(0);
}

/* Converts A to AIJ, into *kept; see IPMatrixKeep() */
PetscErrorCode IPMatrixConvert(Mat A, Mat *kept)
{
  PetscBool has;
  Mat       fresh;

  PetscFunctionBegin;
  PetscCall(MatrixHasEntries(A, &has));
  if (has) PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, &fresh));
  else PetscCall(MatComputeOperator(A, MATAIJ, &fresh));
  PetscCall(IPMatrixKeep(&fresh, kept));
  PetscFunctionReturn(0);
}

/*
   Finds whether the entries of the Hessian are needed (*needed), by which solver or option (*reader), and which option
   would avoid that (*instead, a part of a message)
*/
static PetscErrorCode HessianReader(Tao tao, PetscBool *needed, const char *reader[], const char *instead[])
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PC            pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PCGetType(pc, reader));
  *instead = ", or choose -tao_ipfilter_pc_type none, jacobi, shell or a type of your own";
  PetscCall(MatrixIsOneOf((PetscObject)pc, reading_pcs, needed));
  if (ip->opt->direct_always || (ip->me && ip->opt->equality != IP_EQUALITY_CONDENSED)) {
    *needed  = PETSC_TRUE;
    *reader  = ip->opt->direct_always ? "-tao_ipfilter_direct" : "the augmented system of equality constraints";
    *instead = "";
  }
  PetscFunctionReturn(0);
}

/* Checks that the Jacobian's rows can be read, which every solver needs. kind: "inequality" or "equality". */
static PetscErrorCode CheckJacobian(Tao tao, Mat J, const char kind[])
{
  MPI_Comm  comm = PetscObjectComm((PetscObject)tao);
  PetscBool has;
  PetscInt  n;
  MatType   type;

  PetscFunctionBegin;
  PetscCall(MatrixHasEntries(J, &has));
  PetscCall(MatGetSize(J, NULL, &n));
  PetscCall(MatGetType(J, &type));
  PetscCheck(has || n <= IP_COLUMNS_MAX, comm, PETSC_ERR_SUP,
    "The Jacobian of the %s constraints, of type %s, supports only products. TAOIPFILTER needs its entries, which it "
    "computes from products for at most %d unknowns, but there are %" PetscInt_FMT ": provide an AIJ matrix",
    kind, type, IP_COLUMNS_MAX, n);
  PetscFunctionReturn(0);
}

/*
   Rejects matrices that cannot be used, and sets hess->products, whether only products with the Hessian are used.
   *changed: this differs from the last solve.
*/
PetscErrorCode IPMatricesCheck(Tao tao, PetscBool *changed)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  MPI_Comm      comm = PetscObjectComm((PetscObject)tao);
  PetscBool     has, needed;
  const char   *reader, *instead;
  MatType       type;
  PetscBool     nest;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->solution, VECNEST, &nest));
  PetscCheck(!nest, comm, PETSC_ERR_SUP,
    "TAOIPFILTER does not accept a solution of type nest, as MatCreateVecs() makes it for a MATNEST: use a plain "
    "vector "
    "of the same layout");
  if (ip->mi) PetscCall(CheckJacobian(tao, tao->jacobian_inequality, "inequality"));
  if (ip->me > ip->sides->nall) PetscCall(CheckJacobian(tao, tao->jacobian_equality, "equality"));
  PetscCall(MatrixHasEntries(tao->hessian, &has));
  PetscCall(HessianReader(tao, &needed, &reader, &instead));
  PetscCall(MatGetSize(tao->hessian, &n, NULL));
  PetscCall(MatGetType(tao->hessian, &type));
  PetscCheck(has || !needed || n <= IP_COLUMNS_MAX, comm, PETSC_ERR_SUP,
    "The Hessian, of type %s, supports only products. Its entries, which %s needs, are computed from products for at "
    "most %d unknowns, but there are %" PetscInt_FMT ": provide an AIJ matrix%s",
    type, reader, IP_COLUMNS_MAX, n, instead);
  *changed           = (PetscBool)(ip->hess->products != (PetscBool)(!has && !needed));
  ip->hess->products = (PetscBool)(!has && !needed);
  PetscFunctionReturn(0);
}

/* Creates a matrix with room for counts[i] entries in row i of this rank, whichever ranks own their columns. rows,
   columns: sizes on this rank */
PetscErrorCode IPMatrixCreate(MPI_Comm comm, PetscInt rows, PetscInt columns, const PetscInt counts[], Mat *A)
{
  PetscInt *own, *others, N;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(&columns, &N, 1, MPIU_INT, MPI_SUM, comm));
  PetscCall(PetscMalloc2(rows, &own, rows, &others));
  for (PetscInt r = 0; r < rows; r++) {
    own[r]    = PetscMin(counts[r], columns);
    others[r] = PetscMin(counts[r], N - columns);
  }
  PetscCall(MatCreateAIJ(comm, rows, columns, PETSC_DETERMINE, N, 0, own, 0, others, A));
  PetscCall(PetscFree2(own, others));
  PetscFunctionReturn(0);
}

PetscErrorCode IPMatrixStack(Mat top, Mat bottom, MatReuse reuse, Mat *stack)
{
  Mat blocks[2] = {top, bottom}, nest;

  PetscFunctionBegin;
  PetscCall(MatCreateNest(PetscObjectComm((PetscObject)top), 2, NULL, 1, NULL, blocks, &nest));
  PetscCall(MatConvert(nest, MATAIJ, reuse, stack));
  PetscCall(MatDestroy(&nest));
  PetscFunctionReturn(0);
}
