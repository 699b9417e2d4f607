/* Finds the largest values of samples, and their places */
#include "recoveryimpl.h"
#include "src/report/reportimpl.h"

/* Ranks places of equal values, such that the place that is found does not depend on the number of ranks */
static PetscReal LargestOrder(const PetscReal place[3])
{
  return place[0] + 0.6180339887 * place[1] + 0.4142135624 * place[2];
}

PetscErrorCode LargestFind(MPI_Comm comm, PetscInt n, const LargestSample samples[], PetscInt nclasses,
  LargestValue largest[])
{
  const PetscMPIInt m = (PetscMPIInt)nclasses;
  PetscReal        *value, *order, *first;
  PetscReal(*place)[3];

  PetscFunctionBegin;
  PetscCall(PetscMalloc4(nclasses, &value, nclasses, &order, nclasses, &first, nclasses, &place));
  for (PetscInt k = 0; k < nclasses; ++k) {
    value[k] = PETSC_NINFINITY;
    order[k] = PETSC_INFINITY;
    for (PetscInt d = 0; d < 3; ++d) place[k][d] = PETSC_NINFINITY;
  }
  for (PetscInt i = 0; i < n; ++i) value[samples[i].of] = PetscMax(value[samples[i].of], samples[i].value);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, m, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt k = samples[i].of;

    if (samples[i].value < (1.0 - REPORT_TIE) * value[k] || LargestOrder(samples[i].place) >= order[k]) continue;
    order[k] = LargestOrder(samples[i].place);
    PetscCall(PetscArraycpy(place[k], samples[i].place, 3));
  }
  PetscCallMPI(MPI_Allreduce(order, first, m, MPIU_REAL, MPIU_MIN, comm));
  for (PetscInt k = 0; k < nclasses; ++k) {
    for (PetscInt d = 0; d < 3 && order[k] > first[k]; ++d) place[k][d] = PETSC_NINFINITY;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, place, 3 * m, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt k = 0; k < nclasses; ++k) {
    if (!(value[k] >= 0.0)) continue;
    largest[k].value = value[k];
    PetscCall(PetscArraycpy(largest[k].place, place[k], 3));
  }
  PetscCall(PetscFree4(value, order, first, place));
  PetscFunctionReturn(0);
}
