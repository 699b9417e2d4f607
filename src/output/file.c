/* Files that appear whole or not at all */
#define _POSIX_C_SOURCE 200809L /* lstat(), truncate(), fsync() */
#include "outputimpl.h"
#include <errno.h>
#include <fcntl.h>
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

/* error is the first rank's errno; code: PETSC_ERR_FILE_OPEN before there is anything to write, then PETSC_ERR_FILE_WRITE */
static PetscErrorCode FileRaise(MPI_Comm comm, const char file[], PetscErrorCode code, int error)
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Bcast(&error, 1, MPI_INT, 0, comm));
  PetscCheck(!error, comm, code, "cannot write \"%s\": %s", file, strerror(error));
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

/* What was written of a file, or the names in its folder, is on the disk */
static int FileSync(const char file[])
{
  const int descriptor = open(file, O_RDONLY);
  int       error      = 0;

  if (descriptor < 0) return errno;
  if (fsync(descriptor)) error = errno;
  (void)close(descriptor);
  return error;
}

static PetscErrorCode FileSyncFolder(const char file[], int *error)
{
  char  folder[PETSC_MAX_PATH_LEN];
  char *slash;

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(folder, file, sizeof(folder)));
  slash = strrchr(folder, '/');
  if (slash) slash[slash == folder] = 0;
  *error = FileSync(slash ? folder : ".");
  PetscFunctionReturn(0);
}

static PetscErrorCode FileCommit(MPI_Comm comm, const char file[], PetscBool safe)
{
  char        part[PETSC_MAX_PATH_LEN];
  PetscMPIInt rank;
  PetscBool   renamed;
  int         error = 0;

  PetscFunctionBegin;
  PetscCall(FileGetPartName(file, part, sizeof(part), &renamed));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0 && renamed) {
    if (safe) error = FileSync(part);
    if (!error && rename(part, file)) error = errno;
    if (!error && safe) PetscCall(FileSyncFolder(file, &error));
  }
  PetscCall(FileRaise(comm, file, PETSC_ERR_FILE_WRITE, error));
  PetscFunctionReturn(0);
}

#define FILE_COMPLAINT_LENGTH 256

static PetscErrorCode FileKeepComplaint(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n, PetscErrorType type, const char *message, void *ctx)
{
  (void)comm, (void)line, (void)function, (void)file;
  if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy((char *)ctx, message, FILE_COMPLAINT_LENGTH);
  return n;
}

PetscErrorCode FileWriteHDF5(MPI_Comm comm, const char file[], PetscBool safe, PetscErrorCode (*write)(PetscViewer, void *), void *ctx)
{
  char           part[PETSC_MAX_PATH_LEN], complaint[FILE_COMPLAINT_LENGTH] = "";
  PetscViewer    viewer;
  PetscBool      renamed;
  PetscErrorCode ierr;
  Mute           mute;

  PetscFunctionBegin;
  PetscCall(FileTry(comm, file, PETSC_ERR_FILE_WRITE));
  PetscCall(FileGetPartName(file, part, sizeof(part), &renamed));
  PetscCall(PetscPushErrorHandler(FileKeepComplaint, complaint));
  MuteBegin(&mute);
  ierr = PetscViewerHDF5Open(comm, part, FILE_MODE_WRITE, &viewer);
  if (!ierr) ierr = write(viewer, ctx);
  if (!ierr) ierr = PetscViewerDestroy(&viewer);
  MuteEnd(&mute);
  PetscCall(PetscPopErrorHandler());
  /* A full disk may strike one rank in the middle of a collective write: it must not wait for the others */
  if (ierr && renamed) (void)remove(part);
  PetscCheck(!ierr, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "cannot write \"%s\", is the disk full? %s", file, complaint);
  PetscCall(FileCommit(comm, file, safe));
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

PetscErrorCode FileAppendText(MPI_Comm comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *), const void *ctx)
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

PetscErrorCode FileWriteText(MPI_Comm comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *), const void *ctx)
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
  PetscCall(FileCommit(comm, file, PETSC_FALSE));
  PetscFunctionReturn(0);
}
