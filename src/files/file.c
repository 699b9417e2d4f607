/* Writes files such that they appear complete or not at all */
#define _POSIX_C_SOURCE 200809L /* declares lstat(), truncate() and getpid() */
#include "filesimpl.h"
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Name under which a file is written, determined on the first rank */
typedef struct {
  char      name[PETSC_MAX_PATH_LEN];
  PetscBool renamed; /* whether the name is changed to that of the file when the file is complete */
} FilePart;

/*
   Gets the name under which a file is written. It contains the process id, since another process may write the same
   file. Links and devices are written directly, because a new file must not replace them.
*/
static PetscErrorCode FileGetPart(MPI_Comm comm, const char file[], FilePart *part)
{
  struct stat status;

  PetscFunctionBegin;
  *part = (FilePart){.renamed = lstat(file, &status) || S_ISREG(status.st_mode) ? PETSC_TRUE : PETSC_FALSE};
  if (part->renamed) PetscCall(PetscSNPrintf(part->name, sizeof(part->name), "%s.%ld.part", file, (long)getpid()));
  else PetscCall(PetscStrncpy(part->name, file, sizeof(part->name)));
  PetscCallMPI(MPI_Bcast(part, sizeof(*part), MPI_BYTE, 0, comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode FileTry(MPI_Comm comm, const char file[], const FilePart *part, PetscErrorCode code)
{
  PetscMPIInt rank;
  int         error = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    FILE *stream = fopen(part->name, part->renamed ? "wb" : "ab"); /* the target of a link is not changed */

    if (!stream) error = errno;
    else if (fclose(stream) || (part->renamed && remove(part->name))) error = errno;
  }
  PetscCall(FileRaise(comm, file, code, error));
  PetscFunctionReturn(0);
}

/*@C
   OutputCheckWritable - Checks before a long run that a file can be written; raises an error with one sentence if not

   Collective

   Input Parameters:
+  comm - the communicator; its first rank writes
-  file - the file; it is not changed. A test file FILE.PID.part is created beside it and removed, unless FILE is a link
          or a device

   Level: intermediate

   Errors: PETSC_ERR_FILE_OPEN, on all ranks.

.seealso: `OutputCreate()`, `ReportWriteJSON()`
@*/
PetscErrorCode OutputCheckWritable(MPI_Comm comm, const char file[])
{
  FilePart part;

  PetscFunctionBegin;
  PetscCall(FileGetPart(comm, file, &part));
  PetscCall(FileTry(comm, file, &part, PETSC_ERR_FILE_OPEN));
  PetscFunctionReturn(0);
}

static PetscErrorCode FileRename(MPI_Comm comm, const FilePart *part, const char file[])
{
  PetscMPIInt rank;
  int         error = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0 && part->renamed && rename(part->name, file)) error = errno;
  PetscCall(FileRaise(comm, file, PETSC_ERR_FILE_WRITE, error));
  PetscFunctionReturn(0);
}

#define FILE_MESSAGE_LENGTH 256

static PetscErrorCode FileKeepMessage(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n,
  PetscErrorType type, const char *message, void *ctx)
{
  (void)comm, (void)line, (void)function, (void)file;
  if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy((char *)ctx, message, FILE_MESSAGE_LENGTH);
  return n;
}

PetscErrorCode FileWriteHDF5(MPI_Comm comm, const char file[], PetscErrorCode (*write)(PetscViewer, void *), void *ctx,
  FileCommit *commit)
{
  char           message[FILE_MESSAGE_LENGTH] = "";
  FilePart       part;
  PetscViewer    viewer;
  PetscErrorCode ierr;
  SilencedOutput mute;

  PetscFunctionBegin;
  PetscCall(FileGetPart(comm, file, &part));
  PetscCall(FileTry(comm, file, &part, PETSC_ERR_FILE_WRITE));
  PetscCall(PetscPushErrorHandler(FileKeepMessage, message));
  SilenceOutputBegin(&mute);
  ierr = PetscViewerHDF5Open(comm, part.name, FILE_MODE_WRITE, &viewer);
  if (!ierr) ierr = PetscViewerHDF5SetSPOutput(viewer, PETSC_FALSE); /* meshes and checkpoints have all digits */
  if (!ierr) ierr = write(viewer, ctx);
  if (!ierr) ierr = PetscViewerDestroy(&viewer);
  SilenceOutputEnd(&mute);
  PetscCall(PetscPopErrorHandler());
  /* If the disk is full, a rank may fail in the middle of a collective write. It must not wait for the other ranks. */
  if (ierr && part.renamed) (void)remove(part.name);
  PetscCheck(!ierr, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "cannot write \"%s\" (is the disk full?): %s", file,
    message);
  if (commit && part.renamed) PetscCall(FileCommitBegin(comm, part.name, file, commit));
  else PetscCall(FileRename(comm, &part, file));
  PetscFunctionReturn(0);
}

/* Fills and closes the stream. *error: errno of a failure, unchanged otherwise. */
static PetscErrorCode FileFill(FILE *stream, PetscErrorCode (*fill)(FILE *, const void *), const void *ctx, int *error)
{
  PetscFunctionBegin;
  errno = 0;
  PetscCall(fill(stream, ctx));
  if (fflush(stream) || ferror(stream)) *error = errno ? errno : EIO;
  if (fclose(stream) && !*error) *error = errno;
  PetscFunctionReturn(0);
}

PetscErrorCode FileAppendText(MPI_Comm comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx)
{
  PetscMPIInt rank;
  int         error = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    FILE      *stream = fopen(file, "a");
    const long length = stream ? ftell(stream) : 0;

    if (!stream) error = errno;
    else {
      PetscCall(FileFill(stream, fill, ctx, &error));
      if (error && truncate(file, length)) error = errno;
    }
  }
  PetscCall(FileRaise(comm, file, PETSC_ERR_FILE_WRITE, error));
  PetscFunctionReturn(0);
}

PetscErrorCode FileWriteText(MPI_Comm comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *),
  const void *ctx)
{
  FilePart    part;
  PetscMPIInt rank;
  int         error = 0;

  PetscFunctionBegin;
  PetscCall(FileGetPart(comm, file, &part));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    FILE *stream = fopen(part.name, "w");

    if (!stream) error = errno;
    else {
      PetscCall(FileFill(stream, fill, ctx, &error));
      if (error && part.renamed) (void)remove(part.name);
    }
  }
  PetscCall(FileRaise(comm, file, PETSC_ERR_FILE_WRITE, error));
  PetscCall(FileRename(comm, &part, file));
  PetscFunctionReturn(0);
}

/*
   Collective. Sends a text of the first rank to the others. *length: its length, without the zero byte at its end;
   *text: allocated on the other ranks, and freed by the caller everywhere
*/
PetscErrorCode FileBroadcastText(MPI_Comm comm, PetscInt64 *length, char **text)
{
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Bcast(length, 1, MPIU_INT64, 0, comm));
  PetscCheck(*length < PETSC_MPI_INT_MAX, comm, PETSC_ERR_SUP,
    "A text of %" PetscInt64_FMT " bytes is too long: at most %d are read", *length, PETSC_MPI_INT_MAX);
  if (rank) PetscCall(PetscCalloc1(*length + 1, text));
  PetscCallMPI(MPI_Bcast(*text, (PetscMPIInt)*length, MPI_CHAR, 0, comm));
  PetscFunctionReturn(0);
}
