/*
   Sparse factors of symmetric matrices with real scalars. On one rank CHOLMOD takes half the time of MUMPS, but for
   positive definite matrices only. MUMPS counts negative pivots, and works on several ranks.
*/
#include "sparse_factors.h"
#include "mumps.h"

/* Sets options that the user has not given, or clears those that were set */
static PetscErrorCode FactorsSetOptions(const char prefix[], PetscInt n, const AMGFSetting settings[], PetscBool clear,
  PetscBool set[])
{
  char name[PETSC_MAX_OPTION_NAME];

  PetscFunctionBegin;
  for (PetscInt k = 0; k < n; k++) {
    PetscCall(PetscSNPrintf(name, sizeof(name), "-%s%s", prefix ? prefix : "", settings[k].name));
    if (!clear) {
      PetscCall(PetscOptionsHasName(NULL, NULL, name, &set[k]));
      set[k] = (PetscBool)!set[k];
      if (set[k]) PetscCall(PetscOptionsSetValue(NULL, name, settings[k].value));
    } else if (set[k]) PetscCall(PetscOptionsClearValue(NULL, name));
  }
  PetscFunctionReturn(0);
}

/*
   Creates factors of A's pattern. Some settings can be passed to PETSc 3.18 in the options database only. settings: end
   with an entry without a name
*/
static PetscErrorCode FactorsAnalyse(Mat A, MatSolverType type, const char prefix[], const AMGFSetting settings[],
  PetscInt relaxation, Mat *F, MatFactorError *error)
{
  PetscBool     set[8];
  PetscInt      n = 0;
  MatFactorInfo info;

  PetscFunctionBegin;
  while (settings[n].name) n++;
  PetscCheck(n <= (PetscInt)PETSC_STATIC_ARRAY_LENGTH(set), PetscObjectComm((PetscObject)A), PETSC_ERR_PLIB,
    "%" PetscInt_FMT " settings", n);
  PetscCall(MatGetFactor(A, type, MAT_FACTOR_CHOLESKY, F));
  PetscCall(MatSetOptionsPrefix(*F, prefix));
  if (relaxation) PetscCall(AMGFMumpsSetIcntl(*F, 14, relaxation));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(FactorsSetOptions(prefix, n, settings, PETSC_FALSE, set));
  PetscCall(MatCholeskyFactorSymbolic(*F, A, NULL, &info));
  PetscCall(FactorsSetOptions(prefix, n, settings, PETSC_TRUE, set));
  PetscCall(MatFactorGetError(*F, error));
  PetscFunctionReturn(0);
}

/*
   Increases MUMPS's work space beyond its own estimate. relaxation: that of the next attempt [per cent], 0 before the
   first failure. *more: false if it already is 16 times that of the first attempt
*/
static PetscErrorCode FactorsMoreSpace(Mat F, PetscInt *relaxation, PetscInt *first, PetscBool *more)
{
  const PetscInt most = 16;

  PetscFunctionBegin;
  if (!*relaxation) {
    PetscCall(AMGFMumpsGetIcntl(F, 14, first));
    *relaxation = *first;
  }
  *more = (PetscBool)(*relaxation < most * *first);
  *relaxation *= 2;
  PetscFunctionReturn(0);
}

/*
   AMGFMumpsFactor - factors a symmetric matrix as L D L^T by MUMPS, again with more work space while its estimate of it
   is too small

   Collective

   Input Parameters:
   + A        - matrix of type AIJ or SBAIJ
   . prefix   - options prefix of the factors
   - settings - options of MUMPS; ends with an entry without a name

   Input/Output Parameters:
   + memory - the largest memory allowed [1e6 bytes]; MUMPS's estimate on return. NULL: any
   - F      - NULL, or factors that this function gave for the same nonzero pattern, whose analysis is used again; NULL
              on return if the factorization failed

   Output Parameter:
   . error - the same on all ranks; MAT_FACTOR_OUTMEMORY also if the memory is not allowed
*/
PetscErrorCode AMGFMumpsFactor(Mat A, const char prefix[], const AMGFSetting settings[], PetscReal *memory, Mat *F,
  MatFactorError *error)
{
  const PetscReal allowed    = memory ? *memory : PETSC_INFINITY;
  PetscInt        relaxation = 0, first = 0, estimate;
  PetscBool       again;
  MatFactorInfo   info;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  do {
    again  = PETSC_FALSE;
    *error = MAT_FACTOR_NOERROR;
    if (!*F) PetscCall(FactorsAnalyse(A, MATSOLVERMUMPS, prefix, settings, relaxation, F, error));
    PetscCall(AMGFMumpsGetInfog(*F, 17, &estimate));
    if (memory) *memory = (PetscReal)estimate;
    if (!*error && (PetscReal)estimate > allowed) *error = MAT_FACTOR_OUTMEMORY;
    else if (!*error) {
      PetscCall(MatCholeskyFactorNumeric(*F, A, &info));
      PetscCall(MatFactorGetError(*F, error));
      PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)A)));
      if (*error == MAT_FACTOR_OUTMEMORY) PetscCall(FactorsMoreSpace(*F, &relaxation, &first, &again));
    }
    if (*error) PetscCall(MatDestroy(F)); /* MUMPS does not factor again after it has failed */
  } while (again);
  PetscFunctionReturn(0);
}

/* Upper triangle of a sequential matrix: a matrix of type SBAIJ with block size 1, and its arrays if it is a copy */
typedef struct {
  PetscInt    *i, *j;
  PetscScalar *a;
  Mat          U;
} FactorsUpper;

/*
   Gets the upper triangle with block size 1, which is a copy if A has another format. This is the format of CHOLMOD.
   PETSc 3.18 would copy a matrix of type AIJ itself, and would not free the copy if the factorization fails.
*/
static PetscErrorCode FactorsGetUpper(Mat A, FactorsUpper *upper)
{
  PetscInt           n, nc, size, nz = 0;
  const PetscInt    *columns;
  const PetscScalar *v;
  PetscBool          half;
  MatInfo            info;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompare((PetscObject)A, MATSEQSBAIJ, &half));
  PetscCall(MatGetBlockSize(A, &size));
  if (half && size == 1) {
    PetscCall(PetscObjectReference((PetscObject)A));
    *upper = (FactorsUpper){.U = A};
    PetscFunctionReturn(0);
  }
  if (half) PetscCall(MatGetRowUpperTriangular(A));
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCall(MatGetInfo(A, MAT_LOCAL, &info));
  PetscCall(PetscMalloc3(n + 1, &upper->i, (size_t)info.nz_used, &upper->j, (size_t)info.nz_used, &upper->a));
  upper->i[0] = 0;
  for (PetscInt row = 0; row < n; row++) {
    PetscCall(MatGetRow(A, row, &nc, &columns, &v));
    for (PetscInt k = 0; k < nc; k++) {
      if (columns[k] < row) continue;
      upper->j[nz]   = columns[k];
      upper->a[nz++] = v[k];
    }
    PetscCall(MatRestoreRow(A, row, &nc, &columns, &v));
    upper->i[row + 1] = nz;
  }
  if (half) PetscCall(MatRestoreRowUpperTriangular(A));
  PetscCall(MatCreateSeqSBAIJWithArrays(PETSC_COMM_SELF, 1, n, n, upper->i, upper->j, upper->a, &upper->U));
  PetscFunctionReturn(0);
}

static PetscErrorCode FactorsDestroyUpper(FactorsUpper *upper)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&upper->U));
  PetscCall(PetscFree3(upper->i, upper->j, upper->a));
  PetscFunctionReturn(0);
}

/* Only a supernodal factorization of CHOLMOD stops at a pivot that is not positive. It prints a message about it. */
static const AMGFSetting cholmod_settings[] = {{"mat_cholmod_factor", "supernodal"}, {"mat_cholmod_print", "0"},
  {NULL, NULL}};

/*
   Sets how deep OpenMP's threads nest, and gets the present depth. CHOLMOD divides small loops among four threads,
   which wait for each other: a run with 5,041 contacts takes 46.7 s of processor time, and 33.8 s with the depth 0,
   which leaves one thread. Without OpenMP in the process nothing happens.
*/
static PetscErrorCode FactorsSetThreadDepth(int depth, int *present)
{
  int (*get)(void) = NULL;
  void (*set)(int) = NULL;

  PetscFunctionBegin;
  PetscCall(PetscDLSym(NULL, "omp_get_max_active_levels", (void **)&get));
  PetscCall(PetscDLSym(NULL, "omp_set_max_active_levels", (void **)&set));
  if (get && present) *present = get();
  if (set) set(depth);
  PetscFunctionReturn(0);
}

/*
   Computes L L^T by CHOLMOD. *F: NULL, or factors for the same pattern. *definite: false if a pivot is not positive;
   the factors cannot solve then, but serve for another matrix.
*/
static PetscErrorCode FactorsByCholmod(Mat A, const char prefix[], Mat *F, PetscBool *definite)
{
  FactorsUpper   upper;
  PetscErrorCode code;
  MatFactorInfo  info;
  MatFactorError error;
  PetscLogEvent  event;
  int            depth = 1;

  PetscFunctionBegin;
  PetscCall(FactorsGetUpper(A, &upper));
  PetscCall(FactorsSetThreadDepth(0, &depth));
  if (!*F) PetscCall(FactorsAnalyse(upper.U, MATSOLVERCHOLMOD, prefix, cholmod_settings, 0, F, &error));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  code = MatCholeskyFactorNumeric(*F, upper.U, &info);
  PetscCall(PetscPopErrorHandler());
  PetscCall(FactorsSetThreadDepth(depth, NULL));
  if (code) { /* PETSc has not ended its event */
    PetscCall(PetscLogEventGetId("MatCholFctrNum", &event));
    PetscCall(PetscLogEventEnd(event, A, *F, NULL, NULL));
  }
  *definite = (PetscBool)!code;
  PetscCall(FactorsDestroyUpper(&upper));
  PetscFunctionReturn(0);
}

/* Computes L D L^T by MUMPS; see AMGFSymmetricFactor() */
static PetscErrorCode FactorsByMumps(Mat A, const char prefix[], Mat *F, PetscInt *negative, MatFactorError *error)
{
  static const AMGFSetting settings[] = {AMGF_COUNT_ALL_PIVOTS, {NULL, NULL}};
  PetscBool                baij;
  Mat                      copy = A;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  if (baij) PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, &copy)); /* for BAIJ it has LU only */
  PetscCall(AMGFMumpsFactor(copy, prefix, settings, NULL, F, error));
  if (baij) PetscCall(MatDestroy(&copy));
  if (*F) PetscCall(AMGFMumpsGetInfog(*F, 12, negative));
  PetscFunctionReturn(0);
}

/* Finds whether CHOLMOD and MUMPS can factor A */
static PetscErrorCode FactorsFindSolvers(Mat A, PetscBool *cholmod, PetscBool *mumps)
{
  PetscBool seq, mpi;

  PetscFunctionBegin;
  *cholmod = *mumps = PETSC_FALSE;
  if (PetscDefined(USE_COMPLEX)) PetscFunctionReturn(0);
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &seq, MATSEQAIJ, MATSEQBAIJ, MATSEQSBAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &mpi, MATMPIAIJ, MATMPIBAIJ, MATMPISBAIJ, ""));
  if (seq) PetscCall(MatSolverTypeGet(MATSOLVERCHOLMOD, MATSEQSBAIJ, MAT_FACTOR_CHOLESKY, NULL, cholmod, NULL));
  if (seq || mpi) PetscCall(AMGFMumpsFactors(seq ? MATSEQAIJ : MATMPIAIJ, MAT_FACTOR_CHOLESKY, mumps));
  PetscFunctionReturn(0);
}

/*
   AMGFSymmetricFill - analyses a symmetric matrix on one rank

   Collective

   Input Parameters:
   + A      - matrix of type SEQAIJ, SEQBAIJ or SEQSBAIJ
   - prefix - options prefix of the factors, or NULL

   Output Parameters:
   + F    - the analysis, for AMGFSymmetricFactor(); NULL without CHOLMOD
   - fill - number of entries of the factor divided by that of A's upper triangle; infinite without CHOLMOD, and on
            several ranks
*/
PetscErrorCode AMGFSymmetricFill(Mat A, const char prefix[], Mat *F, PetscReal *fill)
{
  PetscBool      cholmod, mumps;
  FactorsUpper   upper;
  MatFactorError error;
  MatInfo        matrix, factor;

  PetscFunctionBegin;
  *F    = NULL;
  *fill = PETSC_INFINITY;
  PetscCall(FactorsFindSolvers(A, &cholmod, &mumps));
  if (!cholmod) PetscFunctionReturn(0);
  PetscCall(FactorsGetUpper(A, &upper));
  PetscCall(FactorsAnalyse(upper.U, MATSOLVERCHOLMOD, prefix, cholmod_settings, 0, F, &error));
  PetscCall(MatGetInfo(upper.U, MAT_LOCAL, &matrix));
  PetscCall(MatGetInfo(*F, MAT_LOCAL, &factor));
  *fill = factor.nz_used / matrix.nz_used;
  PetscCall(FactorsDestroyUpper(&upper));
  PetscFunctionReturn(0);
}

/*
   AMGFSymmetricFactor - factors a symmetric matrix: by CHOLMOD if it is positive definite and on one rank, otherwise by
   MUMPS

   Collective

   Input Parameters:
   + A      - matrix of type AIJ, BAIJ or SBAIJ
   - prefix - options prefix of the factors, or NULL

   Input/Output Parameter:
   . F - NULL, or factors that this function gave for the same nonzero pattern, whose analysis is used again

   Output Parameters:
   + negative - number of negative pivots, which is the number of negative eigenvalues; NULL if the caller needs a
                positive definite matrix
   - error    - MAT_FACTOR_NUMERIC_ZEROPIVOT if A is not positive definite and `negative` is NULL or PETSc has no MUMPS;
                MAT_FACTOR_OTHER also if PETSc has neither of the two for A
*/
PetscErrorCode AMGFSymmetricFactor(Mat A, const char prefix[], Mat *F, PetscInt *negative, MatFactorError *error)
{
  PetscBool     cholmod, mumps, definite = PETSC_FALSE;
  PetscInt      n;
  MatSolverType type;

  PetscFunctionBegin;
  *error = MAT_FACTOR_OTHER;
  PetscCall(FactorsFindSolvers(A, &cholmod, &mumps));
  if (*F) {
    PetscCall(MatFactorGetSolverType(*F, &type));
    PetscCall(PetscStrcmp(type, MATSOLVERCHOLMOD, &cholmod));
  }
  if (cholmod) {
    PetscCall(FactorsByCholmod(A, prefix, F, &definite));
    *error = definite ? MAT_FACTOR_NOERROR : MAT_FACTOR_NUMERIC_ZEROPIVOT;
    if (negative) *negative = 0;
    if (definite || !negative || !mumps) PetscFunctionReturn(0);
    PetscCall(MatDestroy(F));
  }
  if (mumps) PetscCall(FactorsByMumps(A, prefix, F, negative ? negative : &n, error));
  if (!negative && !*error && n) *error = MAT_FACTOR_NUMERIC_ZEROPIVOT;
  PetscFunctionReturn(0);
}
