/* Reduces the values of points that ranks share, and gathers lists of all ranks, on every rank or on the first one */
#include "queryimpl.h"
#include <petscsf.h>
#include <rankerror.h>

/* Collective. Reduces the values of each shared point by `op`, and sets the result on all ranks that share it. sf: on
   one rank without a graph */
PetscErrorCode ValuesReduce(PetscSF sf, MPI_Datatype type, MPI_Op op, void *values)
{
  PetscInt nroots;

  PetscFunctionBegin;
  PetscCall(PetscSFGetGraph(sf, &nroots, NULL, NULL, NULL));
  if (nroots < 0) PetscFunctionReturn(0);
  PetscCall(PetscSFReduceBegin(sf, type, values, values, op));
  PetscCall(PetscSFReduceEnd(sf, type, values, values, op));
  PetscCall(PetscSFBcastBegin(sf, type, values, values, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, type, values, values, MPI_REPLACE));
  PetscFunctionReturn(0);
}

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

/*
   Collective. Gathers the n integers of each rank on the first rank, in the order of the ranks. what: their name in an
   error message; counts, displs: those of MPI_Gatherv(), one value per rank; *total: number of all integers;
   *all: the integers, NULL on other ranks
*/
PetscErrorCode IntegersGather(MPI_Comm comm, const char what[], PetscInt n, const PetscInt local[],
  PetscMPIInt counts[], PetscMPIInt displs[], PetscInt *total, PetscInt **all)
{
  PetscMPIInt rank, size, count;
  PetscInt    sum = n;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMPIIntCast(n, &count));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Gather(&count, 1, MPI_INT, counts, 1, MPI_INT, 0, comm));
  displs[0] = 0;
  for (PetscMPIInt r = 1; !rank && r < size; ++r) displs[r] = displs[r - 1] + counts[r - 1];
  *total = sum;
  *all   = NULL;
  RankCallFor(comm, !rank, PetscMalloc1(*total, all),
    "The first rank cannot gather %" PetscInt_FMT " entries of %s: ", sum, what);
  PetscCallMPI(MPI_Gatherv(local, count, MPIU_INT, *all, counts, displs, MPIU_INT, 0, comm));
  PetscFunctionReturn(0);
}
