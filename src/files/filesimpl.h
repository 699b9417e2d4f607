/*
   Files that appear whole or not at all, locks, and datasets of HDF5.
*/
#ifndef FILESIMPL_H
#define FILESIMPL_H

#include <petsccompat.h>
#include <rankerror.h>
#include <petscvec.h>
#include <petscviewerhdf5.h>

/* silence_output.c: standard output and error lead nowhere between the two */
typedef struct {
  int kept[2]; /* descriptors; negative: none was free, and the stream stays as it is */
} SilencedOutput;

PETSC_INTERN void SilenceOutputBegin(SilencedOutput *);
PETSC_INTERN void SilenceOutputEnd(SilencedOutput *);

/* commit.c: a file takes its name once it is on the disk, while the run goes on; the end tells what went wrong, and
   names the file */
typedef struct _n_FileCommit *FileCommit;

PETSC_INTERN PetscErrorCode FileRaise(MPI_Comm, const char file[], PetscErrorCode code, int error);
PETSC_INTERN PetscErrorCode FileCommitBegin(MPI_Comm, const char part[], const char file[], FileCommit *);
PETSC_INTERN PetscErrorCode FileCommitEnd(FileCommit *);

/*
   file.c: a file appears whole or not at all: it is written under another name, <file>.<pid>.part, and renamed.
   Collective; the error names the file.
*/
/* Every rank writes into the open viewer; commit: NULL, or, to be ended, what brings it to the disk before it takes
   its name */
PETSC_INTERN PetscErrorCode FileWriteHDF5(MPI_Comm, const char file[], PetscErrorCode (*write)(PetscViewer, void *),
  void *ctx, FileCommit *commit);
/* On the first rank fill() writes the stream; the others wait for the outcome */
PETSC_INTERN PetscErrorCode FileWriteText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx);
/* The same behind what the file holds; it stays as it was where there is no room for all of it */
PETSC_INTERN PetscErrorCode FileAppendText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx);

/* lock_file.c: collective; an error where another run holds the file. It is kept until the descriptor, of the first
   rank, is closed. A file that does not exist is not kept */
PETSC_INTERN PetscErrorCode LockFileBegin(MPI_Comm, const char file[], int *descriptor);
PETSC_INTERN void           LockFileEnd(int *descriptor);

/* dataset.c: n records of this rank; written and destroyed */
PETSC_INTERN PetscErrorCode DatasetCreate(MPI_Comm, const char name[], PetscInt n, PetscInt components, Vec *);
PETSC_INTERN PetscErrorCode DatasetWrite(Vec *, PetscViewer);
PETSC_INTERN PetscErrorCode DatasetWriteIndices(IS, PetscViewer);

#endif
