/* Memory of the program: present resident set size, and its peak */
#include "runimpl.h"
#include <sys/resource.h>

/* Gets the present resident set size, summed over the ranks [bytes] */
PetscErrorCode MemoryUsageGet(MPI_Comm comm, PetscLogDouble *bytes)
{
  PetscFunctionBegin;
  PetscCall(PetscMemoryGetCurrentUsage(bytes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/*
   Gets the peak resident set size of this process [bytes]. On Linux it is read as VmHWM; elsewhere getrusage() is used,
   which may give the peak of the parent process.
*/
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

/* Gets the peak resident set size, summed over the ranks [bytes] */
PetscErrorCode MemoryUsageGetPeak(MPI_Comm comm, PetscLogDouble *bytes)
{
  PetscFunctionBegin;
  PetscCall(MemoryUsagePeakOfRank(bytes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}
