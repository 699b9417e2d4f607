/* Files that appear whole or not at all */
#define _POSIX_C_SOURCE 200809L /* lstat(), truncate() */
#include "src/output/outputimpl.h"
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The file that is written and then renamed: another one, but for links and devices, whose place no file may take */
static PetscErrorCode FileGetPartName(const char file[], char part[], size_t length, PetscBool *renamed)
{
  struct stat status;

  PetscFunctionBegin;
  *renamed = lstat(file, &status) || S_ISREG(status.st_mode) ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(PetscSNPrintf(part, length, "%s%s", file, *renamed ? ".part" : ""));
  PetscFunctionReturn(0);
}

static PetscErrorCode FileTry(MPI_Comm comm, const char file[], PetscErrorCode code)
{
  char        part[PETSC_MAX_PATH_LEN];
  PetscMPIInt rank;
  PetscBool   renamed;
  int         error = 0;

  PetscFunctionBegin;
  PetscCall(FileGetPartName(file, part, sizeof(part), &renamed));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    FILE *stream = fopen(part, renamed ? "wb" : "ab"); /* what a link leads to stays as it is */

    if (!stream) error = errno;
    else if (fclose(stream) || (renamed && remove(part))) error = errno;
  }
  PetscCall(FileRaise(comm, file, code, error));
  PetscFunctionReturn(0);
}

/*@C
   OutputCheckWritable - Finds out before long work whether a file will be writable, and says so in one sentence if not

   Collective

   Input Parameters:
+  comm - the communicator; its first rank writes
-  file - the file; it is not touched, a neighbour FILE.part is made and removed, unless it is a link or a device

   Level: intermediate

   Errors: PETSC_ERR_FILE_OPEN, on all ranks.

.seealso: `OutputCreate()`, `ReportWriteJSON()`
@*/
PetscErrorCode OutputCheckWritable(MPI_Comm comm, const char file[])
{
  PetscFunctionBegin;
  PetscCall(FileTry(comm, file, PETSC_ERR_FILE_OPEN));
  PetscFunctionReturn(0);
}

static PetscErrorCode FileRename(MPI_Comm comm, const char file[])
{
  char        part[PETSC_MAX_PATH_LEN];
  PetscMPIInt rank;
  PetscBool   renamed;
  int         error = 0;

  PetscFunctionBegin;
  PetscCall(FileGetPartName(file, part, sizeof(part), &renamed));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0 && renamed && rename(part, file)) error = errno;
  PetscCall(FileRaise(comm, file, PETSC_ERR_FILE_WRITE, error));
  PetscFunctionReturn(0);
}

#define FILE_COMPLAINT_LENGTH 256

static PetscErrorCode FileKeepComplaint(MPI_Comm comm, int line, const char *function, const char *file,
  PetscErrorCode n, PetscErrorType type, const char *message, void *ctx)
{
  (void)comm, (void)line, (void)function, (void)file;
  if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy((char *)ctx, message, FILE_COMPLAINT_LENGTH);
  return n;
}

PetscErrorCode FileWriteHDF5(MPI_Comm comm, const char file[], PetscErrorCode (*write)(PetscViewer, void *), void *ctx,
  FileCommit *commit)
{
  char           part[PETSC_MAX_PATH_LEN], complaint[FILE_COMPLAINT_LENGTH] = "";
  PetscViewer    viewer;
  PetscBool      renamed;
  PetscErrorCode ierr;
  SilencedOutput mute;

  PetscFunctionBegin;
  PetscCall(FileTry(comm, file, PETSC_ERR_FILE_WRITE));
  PetscCall(FileGetPartName(file, part, sizeof(part), &renamed));
  PetscCall(PetscPushErrorHandler(FileKeepComplaint, complaint));
  SilenceOutputBegin(&mute);
  ierr = PetscViewerHDF5Open(comm, part, FILE_MODE_WRITE, &viewer);
  if (!ierr) ierr = write(viewer, ctx);
  if (!ierr) ierr = PetscViewerDestroy(&viewer);
  SilenceOutputEnd(&mute);
  PetscCall(PetscPopErrorHandler());
  /* A full disk may strike one rank in the middle of a collective write: it must not wait for the others */
  if (ierr && renamed) (void)remove(part);
  PetscCheck(!ierr, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "cannot write \"%s\", is the disk full? %s", file,
    complaint);
  if (commit && renamed) PetscCall(FileCommitBegin(comm, part, file, commit));
  else PetscCall(FileRename(comm, file));
  PetscFunctionReturn(0);
}

/* The stream's text, and errno of what went wrong with it */
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
  char        part[PETSC_MAX_PATH_LEN];
  PetscMPIInt rank;
  PetscBool   renamed;
  int         error = 0;

  PetscFunctionBegin;
  PetscCall(FileGetPartName(file, part, sizeof(part), &renamed));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    FILE *stream = fopen(part, "w");

    if (!stream) error = errno;
    else {
      PetscCall(FileFill(stream, fill, ctx, &error));
      if (error && renamed) (void)remove(part);
    }
  }
  PetscCall(FileRaise(comm, file, PETSC_ERR_FILE_WRITE, error));
  PetscCall(FileRename(comm, file));
  PetscFunctionReturn(0);
}
