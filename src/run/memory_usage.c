/* The memory that the program holds: its resident set now, and at its peak. */
#include "runimpl.h"
#include <sys/resource.h>

/* Now, summed over ranks */
PetscErrorCode MemoryUsageGet(MPI_Comm comm, PetscLogDouble *bytes)
{
  PetscFunctionBegin;
  PetscCall(PetscMemoryGetCurrentUsage(bytes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/* Peak of the resident set of this program. Linux gives it as VmHWM; getrusage() elsewhere may give the peak of the
   process that started this one */
static PetscErrorCode MemoryUsagePeakOfRank(PetscLogDouble *bytes)
{
  FILE         *status = fopen("/proc/self/status", "r");
  char          line[256];
  unsigned long kilobytes = 0;
  struct rusage usage;

  PetscFunctionBegin;
  while (status && !kilobytes && fgets(line, sizeof(line), status)) (void)sscanf(line, "VmHWM: %lu", &kilobytes);
  if (status) fclose(status);
  if (!kilobytes) {
    PetscCheck(!getrusage(RUSAGE_SELF, &usage), PETSC_COMM_SELF, PETSC_ERR_SYS, "getrusage() failed");
    kilobytes = (unsigned long)usage.ru_maxrss;
  }
  *bytes = 1024.0 * (PetscLogDouble)kilobytes;
  PetscFunctionReturn(0);
}

/* At its peak, summed over ranks */
PetscErrorCode MemoryUsageGetPeak(MPI_Comm comm, PetscLogDouble *bytes)
{
  PetscFunctionBegin;
  PetscCall(MemoryUsagePeakOfRank(bytes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}
