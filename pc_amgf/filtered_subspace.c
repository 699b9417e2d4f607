/* Finds the source of the subspace, and the rows of the subspace on this rank */
#include "amgfimpl.h"

static PetscErrorCode SubspaceLoadFile(PC pc)
{
  PC_AMGF    *amgf = (PC_AMGF *)pc->data;
  MPI_Comm    comm;
  PetscMPIInt rank;
  PetscBool   exists = PETSC_FALSE;
  PetscViewer viewer;

  PetscFunctionBegin;
  if (amgf->file_is) PetscFunctionReturn(0);
  PetscCall(PetscObjectGetComm((PetscObject)pc, &comm));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) PetscCall(PetscTestFile(amgf->file, 'r', &exists));
  PetscCallMPI(MPI_Bcast(&exists, 1, MPI_PETSCBOOL, 0, comm));
  PetscCheck(exists, comm, PETSC_ERR_FILE_OPEN, "-pc_amgf_filter_file: cannot read file %s", amgf->file);
  PetscCall(PetscViewerBinaryOpen(comm, amgf->file, FILE_MODE_READ, &viewer));
  PetscCall(ISCreate(comm, &amgf->file_is));
  PetscCall(ISLoad(amgf->file_is, viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode SubspaceGetComposed(PC pc, PetscObject *composed, PetscObjectId *id, PetscObjectState *state)
{
  PetscFunctionBegin;
  *id    = 0;
  *state = 0;
  PetscCall(PetscObjectQuery((PetscObject)pc->pmat, PCAMGF_FILTER_KEY, composed));
  if (*composed) {
    PetscCall(PetscObjectGetId(*composed, id));
    PetscCall(PetscObjectStateGet(*composed, state));
  }
  PetscFunctionReturn(0);
}

/*
   PCAMGFSubspaceIsStale_Private - finds whether the interpolation of the subspace, or the object composed on the
   operator, was replaced or changed since the last set-up. PETSc does not repeat the set-up while the operator is
   unchanged.
*/
PetscErrorCode PCAMGFSubspaceIsStale_Private(PC pc, PetscBool *stale)
{
  PC_AMGF            *amgf = (PC_AMGF *)pc->data;
  const AMGFSubspace *sub  = &amgf->sub;
  PetscObject         composed;
  PetscObjectId       id;
  PetscObjectState    state;
  AMGFStamp           now;
  PetscBool           reuse;

  PetscFunctionBegin;
  *stale = PETSC_FALSE;
  PetscCall(PCGetReusePreconditioner(pc, &reuse));
  if (!amgf->active || amgf->set_is || reuse) PetscFunctionReturn(0);
  if (amgf->set_P) {
    PetscCall(MatGetStamp_AMGF(amgf->set_P, &now));
    *stale = (PetscBool)!AMGFStampSameValues(&now, &sub->stamp);
    PetscFunctionReturn(0);
  }
  PetscCall(SubspaceGetComposed(pc, &composed, &id, &state));
  *stale = (PetscBool)(id != sub->composed_id || state != sub->composed_state);
  PetscFunctionReturn(0);
}

/* Finds the first source that is given. *is and *P are borrowed references; at most one of them is not NULL. */
static PetscErrorCode SubspaceFindSource(PC pc, AMGFSource *source, IS *is, Mat *P)
{
  PC_AMGF    *amgf = (PC_AMGF *)pc->data;
  PetscObject composed;

  PetscFunctionBegin;
  *source = AMGF_SOURCE_NONE;
  *is     = NULL;
  *P      = NULL;
  PetscCall(PetscObjectQuery((PetscObject)pc->pmat, PCAMGF_FILTER_KEY, &composed));
  if (amgf->set_is || amgf->set_P) {
    *source = AMGF_SOURCE_CALL;
    *is     = amgf->set_is;
    *P      = amgf->set_P;
  } else if (composed) {
    PetscClassId id;

    PetscCall(PetscObjectGetClassId(composed, &id));
    PetscCheck(id == IS_CLASSID || id == MAT_CLASSID, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_WRONG,
      "The object composed on the operator under \"%s\" must be an IS or a Mat, not a %s", PCAMGF_FILTER_KEY,
      composed->class_name);
    *source = AMGF_SOURCE_COMPOSED;
    if (id == IS_CLASSID) *is = (IS)composed;
    else *P = (Mat)composed;
  } else if (amgf->file) {
    PetscCall(SubspaceLoadFile(pc));
    *source = AMGF_SOURCE_FILE;
    *is     = amgf->file_is;
  } else if (amgf->detect > 0.0) {
    *source = AMGF_SOURCE_DETECT;
    PetscCall(ISDestroy(&amgf->detected_is));
    PetscCall(PCAMGFDetectRows_Private(pc->pmat, amgf->detect, &amgf->detected_is));
    *is = amgf->detected_is;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SubspaceCheckRange(PC pc, PetscInt n, const PetscInt idx[])
{
  PetscInt N, extreme[2] = {-1, -1}; /* -1 minus the smallest row number; the largest row number */

  PetscFunctionBegin;
  PetscCall(MatGetSize(pc->pmat, &N, NULL));
  for (PetscInt i = 0; i < n; i++) {
    extreme[0] = PetscMax(extreme[0], -1 - idx[i]);
    extreme[1] = PetscMax(extreme[1], idx[i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, extreme, 2, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)pc)));
  PetscCheck(extreme[0] < 0, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE,
    "Filter row %" PetscInt_FMT " is negative", -1 - extreme[0]);
  PetscCheck(extreme[1] < N, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE,
    "Filter row %" PetscInt_FMT " is not among the %" PetscInt_FMT " rows of the operator", extreme[1], N);
  PetscFunctionReturn(0);
}

/*
   Computes the rows that the index sets of all ranks name, each on the rank that owns it, sorted, without repetition.
   The rows are marked in a Vec, whose assembly moves the marks to the owners.
*/
static PetscErrorCode SubspaceOwnedRows(PC pc, IS is, IS *rows)
{
  Vec                marks;
  PetscInt           n, nrows = 0, start, *owned;
  const PetscInt    *idx;
  const PetscScalar *m;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &idx));
  PetscCall(SubspaceCheckRange(pc, n, idx));
  PetscCall(MatCreateVecs(pc->pmat, &marks, NULL));
  for (PetscInt i = 0; i < n; i++) PetscCall(VecSetValue(marks, idx[i], 1.0, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(marks));
  PetscCall(VecAssemblyEnd(marks));
  PetscCall(ISRestoreIndices(is, &idx));
  PetscCall(VecGetOwnershipRange(marks, &start, NULL));
  PetscCall(VecGetLocalSize(marks, &n));
  PetscCall(VecGetArrayRead(marks, &m));
  for (PetscInt i = 0; i < n; i++) nrows += (m[i] != 0.0);
  PetscCall(PetscMalloc1(nrows, &owned));
  for (PetscInt i = 0, k = 0; i < n; i++) {
    if (m[i] != 0.0) owned[k++] = start + i;
  }
  PetscCall(VecRestoreArrayRead(marks, &m));
  PetscCall(VecDestroy(&marks));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)pc), nrows, owned, PETSC_OWN_POINTER, rows));
  PetscFunctionReturn(0);
}

/* Creates the index set of the owned rows in which P is nonzero */
static PetscErrorCode SubspaceNonzeroRows(Mat P, IS *rows)
{
  PetscInt start, end, k = 0, *owned;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(P, &start, &end));
  PetscCall(PetscMalloc1(end - start, &owned));
  for (PetscInt i = start; i < end; i++) {
    PetscInt ncols;

    PetscCall(MatGetRow(P, i, &ncols, NULL, NULL));
    if (ncols) owned[k++] = i;
    PetscCall(MatRestoreRow(P, i, &ncols, NULL, NULL));
  }
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)P), k, owned, PETSC_COPY_VALUES, rows));
  PetscCall(PetscFree(owned));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFResetSubspace_Private(PC_AMGF *amgf)
{
  PetscFunctionBegin;
  PetscCall(ISDestroy(&amgf->sub.rows));
  PetscCall(MatDestroy(&amgf->sub.P));
  PetscCall(PetscMemzero(&amgf->sub, sizeof(amgf->sub)));
  PetscFunctionReturn(0);
}

static PetscErrorCode SubspaceFromIS(PC pc, IS is, PetscBool *same)
{
  AMGFSubspace *sub = &((PC_AMGF *)pc->data)->sub;
  IS            rows;

  PetscFunctionBegin;
  PetscCall(SubspaceOwnedRows(pc, is, &rows));
  if (sub->rows && !sub->P) PetscCall(ISEqual(rows, sub->rows, same));
  if (*same) PetscCall(ISDestroy(&rows));
  else {
    PetscCall(MatDestroy(&sub->P));
    PetscCall(ISDestroy(&sub->rows));
    sub->rows = rows;
    PetscCall(ISGetLocalSize(rows, &sub->nlocal));
    PetscCall(ISGetSize(rows, &sub->n));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SubspaceFromInterpolation(PC pc, Mat P, PetscBool *same)
{
  AMGFSubspace *sub = &((PC_AMGF *)pc->data)->sub;
  PetscInt      m, n, M, N;
  PetscBool     aij;
  AMGFStamp     stamp;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(P, &m, NULL));
  PetscCall(MatGetLocalSize(pc->pmat, &n, NULL));
  PetscCall(MatGetSize(P, &M, NULL));
  PetscCall(MatGetSize(pc->pmat, &N, NULL));
  *same = (PetscBool)(m == n && M == N);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, same, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)pc)));
  PetscCheck(*same, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_SIZ,
    "The filter interpolation has %" PetscInt_FMT " rows, the operator %" PetscInt_FMT
    ", or they are distributed differently",
    M, N);
  PetscCall(MatGetStamp_AMGF(P, &stamp));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)P, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  *same      = (PetscBool)(sub->P &&
                      (AMGFStampSameValues(&stamp, &sub->stamp) || (aij && AMGFStampSamePattern(&stamp, &sub->stamp))));
  sub->stamp = stamp;
  if (*same) PetscFunctionReturn(0);
  PetscCall(ISDestroy(&sub->rows));
  PetscCall(MatDestroy(&sub->P));
  if (aij) {
    PetscCall(PetscObjectReference((PetscObject)P));
    sub->P = P;
  } else PetscCall(MatConvert(P, MATAIJ, MAT_INITIAL_MATRIX, &sub->P));
  PetscCall(SubspaceNonzeroRows(sub->P, &sub->rows));
  PetscCall(MatGetLocalSize(sub->P, NULL, &sub->nlocal));
  PetscCall(MatGetSize(sub->P, NULL, &sub->n));
  PetscFunctionReturn(0);
}

/*
   PCAMGFUpdateSubspace_Private - finds the subspace of the current operator

   Output Parameter:
   . same - the subspace is the same as before, so that the matrices built from it need new values only
*/
PetscErrorCode PCAMGFUpdateSubspace_Private(PC pc, PetscBool *same)
{
  PC_AMGF    *amgf = (PC_AMGF *)pc->data;
  AMGFSource  source;
  PetscObject composed;
  IS          is;
  Mat         P;

  PetscFunctionBegin;
  *same = PETSC_FALSE;
  PetscCall(SubspaceFindSource(pc, &source, &is, &P));
  if (is) PetscCall(SubspaceFromIS(pc, is, same));
  else if (P) PetscCall(SubspaceFromInterpolation(pc, P, same));
  else PetscCall(PCAMGFResetSubspace_Private(amgf));
  amgf->sub.source = source;
  PetscCall(SubspaceGetComposed(pc, &composed, &amgf->sub.composed_id, &amgf->sub.composed_state));
  PetscFunctionReturn(0);
}
