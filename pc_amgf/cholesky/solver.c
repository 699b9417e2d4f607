/* The factorization as two of PETSc's MatSolverType, for sequential matrices of types AIJ, BAIJ and SBAIJ */
#include "choleskyimpl.h"
#include "solver.h"
#include "pc_amgf/solver_types.h"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <petsc/private/matimpl.h>
#pragma GCC diagnostic pop

typedef struct {
  Cholesky   c;
  PetscReal *x, *work; /* right-hand sides in the order of L; work array of the substitutions */
  PetscInt   capacity; /* number of right-hand sides for which there is room */
} CholeskyFactors;

static PetscErrorCode FactorsMakeRoom(CholeskyFactors *f, PetscInt k)
{
  PetscFunctionBegin;
  if (k <= f->capacity) PetscFunctionReturn(0);
  PetscCall(PetscFree2(f->x, f->work));
  PetscCall(PetscMalloc2((size_t)f->c.n * (size_t)k, &f->x, (size_t)f->c.tallest * (size_t)k, &f->work));
  f->capacity = k;
  PetscFunctionReturn(0);
}

/* Solves K x = b for k right-hand sides, with columns of length n */
static PetscErrorCode FactorsSolve(CholeskyFactors *f, PetscInt k, const PetscScalar b[], PetscScalar x[])
{
  const Cholesky *c = &f->c;

  PetscFunctionBegin;
  PetscCall(FactorsMakeRoom(f, k));
  for (PetscInt v = 0; v < k; v++)
    for (PetscInt i = 0; i < c->n; i++)
      f->x[i + (size_t)v * (size_t)c->n] = PetscRealPart(b[c->perm[i] + (size_t)v * (size_t)c->n]);
  if (c->single || k == 1) {
    for (PetscInt v = 0; v < k; v++) CholeskySolveOne(c, f->x + (size_t)v * (size_t)c->n, f->work);
  } else {
    PetscCall(CholeskyForward(c, k, f->x, f->work));
    PetscCall(CholeskyBackward(c, k, f->x, f->work));
  }
  for (PetscInt v = 0; v < k; v++)
    for (PetscInt i = 0; i < c->n; i++) x[c->perm[i] + (size_t)v * (size_t)c->n] = f->x[i + (size_t)v * (size_t)c->n];
  PetscFunctionReturn(0);
}

static PetscErrorCode MatSolve_AMGF(Mat F, Vec b, Vec x)
{
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(b, &from));
  PetscCall(VecGetArrayWrite(x, &to));
  PetscCall(FactorsSolve((CholeskyFactors *)F->data, 1, from, to));
  PetscCall(VecRestoreArrayWrite(x, &to));
  PetscCall(VecRestoreArrayRead(b, &from));
  PetscFunctionReturn(0);
}

static PetscErrorCode MatMatSolve_AMGF(Mat F, Mat B, Mat X)
{
  const PetscScalar *from;
  PetscScalar       *to;
  PetscInt           k;

  PetscFunctionBegin;
  PetscCall(MatGetSize(B, NULL, &k));
  PetscCall(MatDenseGetArrayRead(B, &from));
  PetscCall(MatDenseGetArrayWrite(X, &to));
  PetscCall(FactorsSolve((CholeskyFactors *)F->data, k, from, to));
  PetscCall(MatDenseRestoreArrayWrite(X, &to));
  PetscCall(MatDenseRestoreArrayRead(B, &from));
  PetscFunctionReturn(0);
}

static PetscErrorCode MatCholeskyFactorNumeric_AMGF(Mat F, Mat A, const MatFactorInfo *info)
{
  CholeskyFactors *f = (CholeskyFactors *)F->data;
  PetscBool        positive, is;
  Mat              rows = A;

  PetscFunctionBegin;
  (void)info;
  PetscCall(PetscObjectBaseTypeCompare((PetscObject)A, MATSEQAIJ, &is));
  if (!is) PetscCall(MatConvert(A, MATSEQAIJ, MAT_INITIAL_MATRIX, &rows));
  PetscCall(CholeskyNumeric(rows, &f->c, &positive));
  if (!is) PetscCall(MatDestroy(&rows));
  PetscCall(PetscLogFlops(f->c.flops));
  F->factorerrortype             = positive ? MAT_FACTOR_NOERROR : MAT_FACTOR_NUMERIC_ZEROPIVOT;
  F->factorerror_zeropivot_value = f->c.pivot;
  F->factorerror_zeropivot_row   = f->c.failed;
  F->assembled                   = PETSC_TRUE;
  F->ops->solve                  = MatSolve_AMGF;
  F->ops->matsolve               = MatMatSolve_AMGF;
  PetscFunctionReturn(0);
}

static PetscErrorCode MatCholeskyFactorSymbolic_AMGF(Mat F, Mat A, IS order, const MatFactorInfo *info)
{
  CholeskyFactors *f      = (CholeskyFactors *)F->data;
  const PetscBool  single = f->c.single;

  PetscFunctionBegin;
  (void)order; /* the factorization chooses its own order */
  (void)info;
  PetscCall(PetscFree2(f->x, f->work));
  f->capacity = 0;
  PetscCall(CholeskySymbolic(A, &f->c));
  f->c.single                   = single;
  F->ops->choleskyfactornumeric = MatCholeskyFactorNumeric_AMGF;
  PetscFunctionReturn(0);
}

static PetscErrorCode MatDestroy_AMGF(Mat F)
{
  CholeskyFactors *f = (CholeskyFactors *)F->data;

  PetscFunctionBegin;
  PetscCall(CholeskyDestroy(&f->c));
  PetscCall(PetscFree2(f->x, f->work));
  PetscCall(PetscObjectComposeFunction((PetscObject)F, "MatFactorGetSolverType_C", NULL));
  PetscCall(PetscObjectComposeFunction((PetscObject)F, AMGF_CHOLESKY_SET_SINGLE, NULL));
  PetscCall(PetscObjectComposeFunction((PetscObject)F, AMGF_CHOLESKY_GET_COSTS, NULL));
  PetscCall(PetscFree(F->data));
  PetscFunctionReturn(0);
}

static PetscErrorCode MatFactorGetSolverType_AMGF(Mat F, MatSolverType *type)
{
  PetscFunctionBegin;
  *type = ((CholeskyFactors *)F->data)->c.single ? MATSOLVERAMGFSINGLE : MATSOLVERAMGF;
  PetscFunctionReturn(0);
}

/* Sets whether later numerical factorizations are rounded to single precision */
static PetscErrorCode AMGFCholeskySetSingle_AMGF(Mat F, PetscBool single)
{
  PetscFunctionBegin;
  ((CholeskyFactors *)F->data)->c.single = single;
  PetscCall(PetscFree(F->solvertype));
  PetscCall(PetscStrallocpy(single ? MATSOLVERAMGFSINGLE : MATSOLVERAMGF, &F->solvertype));
  PetscFunctionReturn(0);
}

/* Gets the costs of a factorization after its symbolic part: operations, entries of the factors, and the memory of the
   largest fronts beside the factors [bytes] */
static PetscErrorCode AMGFCholeskyGetCosts_AMGF(Mat F, PetscReal *flops, PetscReal *entries, PetscReal *fronts)
{
  const Cholesky *c = &((CholeskyFactors *)F->data)->c;

  PetscFunctionBegin;
  *flops   = c->flops;
  *entries = (PetscReal)c->entry[c->nsuper];
  *fronts  = 3.0 * sizeof(PetscReal) * PetscSqr((PetscReal)c->tallest);
  PetscFunctionReturn(0);
}

static PetscErrorCode MatGetFactor_AMGF(Mat A, MatFactorType type, Mat *F)
{
  CholeskyFactors *f;
  PetscInt         n;

  PetscFunctionBegin;
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(PetscNew(&f));
  PetscCall(MatCreate(PETSC_COMM_SELF, F));
  PetscCall(MatSetSizes(*F, n, n, n, n));
  PetscCall(PetscStrallocpy("amgf", &((PetscObject)*F)->type_name));
  PetscCall(MatSetUp(*F));
  (*F)->data                        = f;
  (*F)->factortype                  = type;
  (*F)->ops->destroy                = MatDestroy_AMGF;
  (*F)->ops->choleskyfactorsymbolic = MatCholeskyFactorSymbolic_AMGF;
  PetscCall(PetscObjectComposeFunction((PetscObject)*F, "MatFactorGetSolverType_C", MatFactorGetSolverType_AMGF));
  PetscCall(PetscObjectComposeFunction((PetscObject)*F, AMGF_CHOLESKY_SET_SINGLE, AMGFCholeskySetSingle_AMGF));
  PetscCall(PetscObjectComposeFunction((PetscObject)*F, AMGF_CHOLESKY_GET_COSTS, AMGFCholeskyGetCosts_AMGF));
  PetscCall(PetscFree((*F)->solvertype));
  PetscCall(PetscStrallocpy(MATSOLVERAMGF, &(*F)->solvertype));
  PetscFunctionReturn(0);
}

static PetscErrorCode MatGetFactor_AMGFSingle(Mat A, MatFactorType type, Mat *F)
{
  PetscFunctionBegin;
  PetscCall(MatGetFactor_AMGF(A, type, F));
  PetscCall(AMGFCholeskySetSingle_AMGF(*F, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Registers the factorization with PETSc */
PetscErrorCode AMGFCholeskyRegister(void)
{
  const MatType types[] = {MATSEQAIJ, MATSEQBAIJ, MATSEQSBAIJ};

  PetscFunctionBegin;
  PetscCall(MatInitializePackage()); /* PETSc 3.18 would forget the types that it registers after the first one */
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(types); i++) {
    PetscCall(MatSolverTypeRegister(MATSOLVERAMGF, types[i], MAT_FACTOR_CHOLESKY, MatGetFactor_AMGF));
    PetscCall(MatSolverTypeRegister(MATSOLVERAMGFSINGLE, types[i], MAT_FACTOR_CHOLESKY, MatGetFactor_AMGFSingle));
  }
  PetscFunctionReturn(0);
}
