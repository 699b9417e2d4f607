/*
   Preloaded into an MPI program, it delays MPI_Iprobe() and MPI_Test() on rank 0 at random, by up to 3 ms, so that
   messages arrive in another order. AMGF_DELAY_SEED: seed of the random numbers
*/
#define _GNU_SOURCE
#include <mpi.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>

static void Delay(void)
{
  static unsigned state;
  static int      rank = -1;

  if (rank < 0) {
    const char *seed = getenv("AMGF_DELAY_SEED");

    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    state = (unsigned)atoi(seed ? seed : "1");
  }
  if (!rank) usleep((useconds_t)(rand_r(&state) % 3000));
}

int MPI_Iprobe(int source, int tag, MPI_Comm comm, int *flag, MPI_Status *status)
{
  Delay();
  return PMPI_Iprobe(source, tag, comm, flag, status);
}

int MPI_Test(MPI_Request *request, int *flag, MPI_Status *status)
{
  Delay();
  return PMPI_Test(request, flag, status);
}

/* MUMPS calls the functions of Fortran */
void mpi_iprobe_(MPI_Fint *source, MPI_Fint *tag, MPI_Fint *comm, void *flag, MPI_Fint *status, MPI_Fint *error)
{
  static void (*next)(MPI_Fint *, MPI_Fint *, MPI_Fint *, void *, MPI_Fint *, MPI_Fint *);

  if (!next) *(void **)&next = dlsym(RTLD_NEXT, "mpi_iprobe_");
  Delay();
  next(source, tag, comm, flag, status, error);
}

void mpi_test_(MPI_Fint *request, void *flag, MPI_Fint *status, MPI_Fint *error)
{
  static void (*next)(MPI_Fint *, void *, MPI_Fint *, MPI_Fint *);

  if (!next) *(void **)&next = dlsym(RTLD_NEXT, "mpi_test_");
  Delay();
  next(request, flag, status, error);
}
