/* Private header of files: files that appear complete or not at all, locks, and HDF5 datasets */
#ifndef FILESIMPL_H
#define FILESIMPL_H

#include <petsccompat.h>
#include <rankerror.h>
#include <petscvec.h>
#include <petscviewerhdf5.h>

/*
   silence_output.c: suppresses standard output and standard error between SilenceOutputBegin() and SilenceOutputEnd()
*/
typedef struct {
  int kept[2]; /* copies of the two descriptors; negative: no copy could be made, and the stream is not suppressed */
} SilencedOutput;

PETSC_INTERN void SilenceOutputBegin(SilencedOutput *);
PETSC_INTERN void SilenceOutputEnd(SilencedOutput *);

/*
   commit.c: renames a file once it is on disk, in the background. FileCommitEnd() waits and reports errors with the
   file's name.
*/
typedef struct _n_FileCommit *FileCommit;

PETSC_INTERN PetscErrorCode FileRaise(MPI_Comm, const char file[], PetscErrorCode code, int error);
PETSC_INTERN PetscErrorCode FileCommitBegin(MPI_Comm, const char part[], const char file[], FileCommit *);
PETSC_INTERN PetscErrorCode FileCommitEnd(FileCommit *);

/*
   file.c: files that appear complete or not at all, since they are written as <file>.<pid>.part and then renamed.
   Collective. Errors name the file.
*/
/*
   Calls write() with an open viewer on every rank. commit: NULL, or receives the commit that syncs and renames the
   file, which the caller must end.
*/
PETSC_INTERN PetscErrorCode FileWriteHDF5(MPI_Comm, const char file[], PetscErrorCode (*write)(PetscViewer, void *),
  void *ctx, FileCommit *commit);
/* Calls fill() with an open stream on the first rank; the other ranks wait for the result */
PETSC_INTERN PetscErrorCode FileWriteText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx);
/* Appends what fill() writes to the file, on the first rank. If the disk is full, the file is unchanged. */
PETSC_INTERN PetscErrorCode FileAppendText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx);
/* Sends a text of the first rank, such as the contents of a file, to the others */
PETSC_INTERN PetscErrorCode FileBroadcastText(MPI_Comm, PetscInt64 *length, char **text);

/*
   lock_file.c: locks an existing file. Collective. Raises an error if another run has locked it. The lock lasts until
   the first rank's descriptor is closed. A file that does not exist is not locked.
*/
PETSC_INTERN PetscErrorCode LockFileBegin(MPI_Comm, const char file[], int *descriptor);
PETSC_INTERN void           LockFileEnd(int *descriptor);

/* dataset.c: DatasetCreate() creates a field with n records on this rank; DatasetWrite() writes and destroys it */
PETSC_INTERN PetscErrorCode DatasetCreate(MPI_Comm, const char name[], PetscInt n, PetscInt components, Vec *);
PETSC_INTERN PetscErrorCode DatasetWrite(Vec *, PetscViewer);
PETSC_INTERN PetscErrorCode DatasetWriteIndices(IS, PetscViewer);

/*
   script.c: runs the program's own Python scripts, on one rank. ScriptRun() returns 0 if the script ended without
   error; `sentence` gets the last line that it prints on the error stream.
*/
#if !defined(CONTACT_PYTHON)
  #define CONTACT_PYTHON "python3" /* default; the makefile defines the interpreter that it found */
#endif
PETSC_INTERN PetscBool ScriptFind(const char name[], char script[], size_t length, char sentence[], size_t size);
PETSC_INTERN int       ScriptRun(const char *const words[], char sentence[], size_t length);

#endif
