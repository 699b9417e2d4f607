/* Gathers lists of all ranks on every rank */
#include "queryimpl.h"

/*
   Collective. Replaces the records of this rank by those of all ranks, in the order of the ranks. reals: number of real
   numbers in a record, which consists of nothing else; n: number of records; records: address of their array
*/
PetscErrorCode RecordsGather(MPI_Comm comm, PetscInt reals, PetscInt *n, void *records)
{
  PetscReal **list  = records, *all;
  PetscInt    total = 0;
  PetscMPIInt size, mine, *count, *start;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(size, &count, size, &start));
  PetscCall(PetscMPIIntCast(reals * *n, &mine));
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, count, 1, MPI_INT, comm));
  for (PetscMPIInt r = 0; r < size; ++r) {
    PetscCall(PetscMPIIntCast(total, &start[r]));
    total += count[r];
  }
  PetscCall(PetscMalloc1(total, &all));
  PetscCallMPI(MPI_Allgatherv(*list, mine, MPIU_REAL, all, count, start, MPIU_REAL, comm));
  PetscCall(PetscFree(*list));
  PetscCall(PetscFree2(count, start));
  *n    = total / reals;
  *list = all;
  PetscFunctionReturn(0);
}
