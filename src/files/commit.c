/*
   Renames a file that was written under another name. If the file must be on disk first, this is done in a thread of
   the first rank, since writing to disk may take longer than a small load step. The thread uses neither MPI nor PETSc.
*/
#define _POSIX_C_SOURCE 200809L /* declares fsync() and pthread_sigmask() */
#include "filesimpl.h"
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

struct _n_FileCommit {
  MPI_Comm  comm;
  char      part[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN], folder[PETSC_MAX_PATH_LEN];
  pthread_t thread;
  PetscBool begun; /* whether the thread was started; first rank only */
  int       error; /* errno of a failure; 0: none */
};

/*
   Raises an error on all ranks if writing a file failed. error: errno on the first rank, 0 for success; code:
   PETSC_ERR_FILE_OPEN if nothing has been written, otherwise PETSC_ERR_FILE_WRITE.
*/
PetscErrorCode FileRaise(MPI_Comm comm, const char file[], PetscErrorCode code, int error)
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Bcast(&error, 1, MPI_INT, 0, comm));
  PetscCheck(!error, comm, code, "cannot write \"%s\": %s", file, strerror(error));
  PetscFunctionReturn(0);
}

/* Waits until a file, or the list of files in a folder, is on disk. Returns errno. */
static int CommitSync(const char file[])
{
  const int descriptor = open(file, O_RDONLY);
  int       error      = 0;

  if (descriptor < 0) return errno;
  if (fsync(descriptor)) error = errno;
  (void)close(descriptor);
  return error;
}

static void *CommitSafely(void *ctx)
{
  FileCommit commit = (FileCommit)ctx;

  commit->error = CommitSync(commit->part);
  if (!commit->error && rename(commit->part, commit->file)) commit->error = errno;
  if (!commit->error) commit->error = CommitSync(commit->folder);
  return NULL;
}

/* Starts the thread, with signals blocked in it. If no thread can be started, its work is done at once. */
static void CommitBeginThread(FileCommit commit)
{
  sigset_t all, kept;

  (void)sigfillset(&all);
  (void)pthread_sigmask(SIG_SETMASK, &all, &kept);
  commit->begun = pthread_create(&commit->thread, NULL, CommitSafely, commit) ? PETSC_FALSE : PETSC_TRUE;
  (void)pthread_sigmask(SIG_SETMASK, &kept, NULL);
  if (!commit->begun) (void)CommitSafely(commit);
}

PetscErrorCode FileCommitBegin(MPI_Comm comm, const char part[], const char file[], FileCommit *commit)
{
  PetscMPIInt rank;
  char       *slash;

  PetscFunctionBegin;
  PetscCall(PetscNew(commit));
  (*commit)->comm = comm;
  PetscCall(PetscStrncpy((*commit)->part, part, sizeof((*commit)->part)));
  PetscCall(PetscStrncpy((*commit)->file, file, sizeof((*commit)->file)));
  PetscCall(PetscStrncpy((*commit)->folder, file, sizeof((*commit)->folder)));
  slash = strrchr((*commit)->folder, '/');
  if (slash) slash[slash == (*commit)->folder] = 0;
  else PetscCall(PetscStrncpy((*commit)->folder, ".", sizeof((*commit)->folder)));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) CommitBeginThread(*commit);
  PetscFunctionReturn(0);
}

/* Waits for the end of a commit; NULL: it has ended already */
PetscErrorCode FileCommitEnd(FileCommit *commit)
{
  FileCommit ended = *commit;

  PetscFunctionBegin;
  if (!ended) PetscFunctionReturn(0);
  if (ended->begun) (void)pthread_join(ended->thread, NULL);
  ended->begun = PETSC_FALSE;
  PetscCall(FileRaise(ended->comm, ended->file, PETSC_ERR_FILE_WRITE, ended->error));
  PetscCall(PetscFree(*commit));
  PetscFunctionReturn(0);
}
