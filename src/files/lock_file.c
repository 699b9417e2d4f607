/*
   Ensures that only one run at a time writes the files of a base name: its first rank locks the mesh file while it
   runs. The lock is a record lock, which HDF5 and readers ignore. On file systems without locks nothing is locked.
*/
#define _POSIX_C_SOURCE 200809L /* declares fcntl() */
#include "filesimpl.h"
#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

/*
   Locks an existing file. *descriptor is negative if the file does not exist. Returns 1 if another process has locked
   it.
*/
static int LockFileOpen(const char file[], int *descriptor)
{
  struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};

  *descriptor = open(file, O_RDWR | O_CLOEXEC);
  return *descriptor >= 0 && fcntl(*descriptor, F_SETLK, &lock) && (errno == EACCES || errno == EAGAIN);
}

void LockFileEnd(int *descriptor)
{
  if (*descriptor >= 0) (void)close(*descriptor);
  *descriptor = -1;
}

/* Locks the file. On ranks other than the first the descriptor is negative. */
PetscErrorCode LockFileBegin(MPI_Comm comm, const char file[], int *descriptor)
{
  PetscMPIInt rank;
  int         taken = 0;

  PetscFunctionBegin;
  *descriptor = -1;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) taken = LockFileOpen(file, descriptor);
  if (taken) LockFileEnd(descriptor);
  PetscCallMPI(MPI_Bcast(&taken, 1, MPI_INT, 0, comm));
  PetscCheck(!taken, comm, PETSC_ERR_FILE_OPEN,
    "another run is writing \"%s\": wait for it to end, or give -output another name", file);
  PetscFunctionReturn(0);
}
