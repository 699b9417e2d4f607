/*
   Files that appear complete or not at all, locks, and HDF5 datasets.
*/
#ifndef FILESIMPL_H
#define FILESIMPL_H

#include <petsccompat.h>
#include <rankerror.h>
#include <petscvec.h>
#include <petscviewerhdf5.h>

/* silence_output.c: suppresses standard output and error between the two calls */
typedef struct {
  int kept[2]; /* saved descriptors; negative: none was available, and the stream is not suppressed */
} SilencedOutput;

PETSC_INTERN void SilenceOutputBegin(SilencedOutput *);
PETSC_INTERN void SilenceOutputEnd(SilencedOutput *);

/* commit.c: renames a file once it is on disk, in the background; the end reports errors with the file's name */
typedef struct _n_FileCommit *FileCommit;

PETSC_INTERN PetscErrorCode FileRaise(MPI_Comm, const char file[], PetscErrorCode code, int error);
PETSC_INTERN PetscErrorCode FileCommitBegin(MPI_Comm, const char part[], const char file[], FileCommit *);
PETSC_INTERN PetscErrorCode FileCommitEnd(FileCommit *);

/*
   file.c: files that appear complete or not at all: written as <file>.<pid>.part and renamed. Collective; errors name
   the file
*/
/* Every rank writes to the open viewer. commit: NULL, or receives the commit that syncs and renames the file, to be
   ended by the caller */
PETSC_INTERN PetscErrorCode FileWriteHDF5(MPI_Comm, const char file[], PetscErrorCode (*write)(PetscViewer, void *),
  void *ctx, FileCommit *commit);
/* fill() writes to the stream on the first rank; the others wait for the result */
PETSC_INTERN PetscErrorCode FileWriteText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx);
/* The same, appended to the file; if the disk is full the file is unchanged */
PETSC_INTERN PetscErrorCode FileAppendText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx);

/* lock_file.c: collective; error if another run has locked the file. The lock lasts until the first rank's
   descriptor is closed. A file that does not exist is not locked */
PETSC_INTERN PetscErrorCode LockFileBegin(MPI_Comm, const char file[], int *descriptor);
PETSC_INTERN void           LockFileEnd(int *descriptor);

/* dataset.c: n records of this rank; Write also destroys them */
PETSC_INTERN PetscErrorCode DatasetCreate(MPI_Comm, const char name[], PetscInt n, PetscInt components, Vec *);
PETSC_INTERN PetscErrorCode DatasetWrite(Vec *, PetscViewer);
PETSC_INTERN PetscErrorCode DatasetWriteIndices(IS, PetscViewer);

/* script.c: the program's own Python scripts, on one rank. Run returns 0 if the script ended well; the last line that
   it prints on the error stream is the sentence */
#if !defined(CONTACT_PYTHON)
  #define CONTACT_PYTHON "python3" /* the makefile sets the one that it found */
#endif
PETSC_INTERN PetscBool ScriptFind(const char name[], char script[], size_t length, char sentence[], size_t room);
PETSC_INTERN int       ScriptRun(const char *const words[], char sentence[], size_t length);

#endif
