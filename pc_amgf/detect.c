/* Detection of stiff rows by their diagonal entries */
#include "amgfimpl.h"

/* An entry that has a logarithm */
static PetscBool DetectCounts(PetscScalar d)
{
  return (PetscBool)(PetscRealPart(d) > 0.0 && PetscRealPart(d) <= PETSC_MAX_REAL);
}

/*
  Median of the positive finite diagonal entries, to 0.1 %, by bisection on the exponent. Counts decide, so that every
  partition gives the same value.
*/
static PetscErrorCode DetectMedian(MPI_Comm comm, PetscInt n, const PetscScalar d[], PetscReal *median)
{
  PetscReal range[2] = {PETSC_MIN_REAL, PETSC_MIN_REAL}; /* -log min, log max */
  PetscInt  count    = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; i++) {
    if (!DetectCounts(d[i])) continue;
    range[0] = PetscMax(range[0], -PetscLogReal(PetscRealPart(d[i])));
    range[1] = PetscMax(range[1], PetscLogReal(PetscRealPart(d[i])));
    count++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPIU_REAL, MPIU_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, comm));
  PetscReal low = -range[0], high = range[1];
  while (count && high - low > 1e-3) {
    const PetscReal middle = 0.5 * (low + high), value = PetscExpReal(middle);
    PetscInt        below = 0;

    for (PetscInt i = 0; i < n; i++) below += (DetectCounts(d[i]) && PetscRealPart(d[i]) <= value);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &below, 1, MPIU_INT, MPI_SUM, comm));
    if (below >= count - count / 2) high = middle;
    else low = middle;
  }
  *median = count ? PetscExpReal(high) : PETSC_MAX_REAL;
  PetscFunctionReturn(0);
}

/*
  PCAMGFDetectRows_Private - owned rows of A whose diagonal entry exceeds ratio times the median of the positive
  diagonal entries
*/
PetscErrorCode PCAMGFDetectRows_Private(Mat A, PetscReal ratio, IS *rows)
{
  MPI_Comm           comm;
  Vec                diagonal;
  PetscInt           n, start, k = 0, *idx;
  PetscReal          median;
  const PetscScalar *d;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetComm((PetscObject)A, &comm));
  PetscCall(MatCreateVecs(A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(A, diagonal));
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetOwnershipRange(diagonal, &start, NULL));
  PetscCall(VecGetArrayRead(diagonal, &d));
  PetscCall(DetectMedian(comm, n, d, &median));
  PetscCall(PetscMalloc1(n, &idx));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(d[i]) > ratio * median) idx[k++] = start + i;
  }
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(ISCreateGeneral(comm, k, idx, PETSC_COPY_VALUES, rows));
  PetscCall(PetscFree(idx));
  PetscFunctionReturn(0);
}
