/* Finds files that a run would write twice, before anything is written */
#include "outputimpl.h"
#include <string.h>
#include <sys/stat.h>

/* Splits the name of a file into its folder and the rest */
static PetscErrorCode FileSplit(const char file[], char folder[PETSC_MAX_PATH_LEN], const char **rest)
{
  const char *slash = strrchr(file, '/');

  PetscFunctionBegin;
  *rest = slash ? slash + 1 : file;
  PetscCall(PetscStrncpy(folder, slash ? file : ".", PETSC_MAX_PATH_LEN));
  if (slash) folder[slash == file ? 1 : slash - file] = 0;
  PetscFunctionReturn(0);
}

static PetscBool FileIsSame(const char a[], const char b[])
{
  struct stat x, y;

  return (PetscBool)(!stat(a, &x) && !stat(b, &y) && x.st_dev == y.st_dev && x.st_ino == y.st_ino);
}

/* Whether two names stand for one file, which need not exist */
static PetscErrorCode FileCompare(const char a[], const char b[], PetscBool *same)
{
  char        folder[2][PETSC_MAX_PATH_LEN];
  const char *rest[2];

  PetscFunctionBegin;
  PetscCall(FileSplit(a, folder[0], &rest[0]));
  PetscCall(FileSplit(b, folder[1], &rest[1]));
  *same = (PetscBool)(FileIsSame(a, b) || (!strcmp(rest[0], rest[1]) && FileIsSame(folder[0], folder[1])));
  PetscFunctionReturn(0);
}

/* Whether `rest`, the part of a file's name after the base name of an output, makes it a file of this output */
static PetscBool FileEndsLikeOutput(const char rest[])
{
  static const char *const ends[] = {".h5", ".xmf", ".csv", "_gauss.xmf"};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(ends); ++i) {
    if (!strcmp(rest, ends[i])) return PETSC_TRUE;
  }
  return (PetscBool)(rest[0] == '_' && strspn(rest + 1, "0123456789") >= 4 &&
                     !strcmp(rest + 1 + strspn(rest + 1, "0123456789"), ".h5"));
}

/* Whether a file is one that an output with this base name writes */
static PetscErrorCode FileBelongsToOutput(const char file[], const char base[], PetscBool *belongs)
{
  char        folder[2][PETSC_MAX_PATH_LEN];
  const char *rest[2];
  size_t      n;

  PetscFunctionBegin;
  PetscCall(FileSplit(file, folder[0], &rest[0]));
  PetscCall(FileSplit(base, folder[1], &rest[1]));
  n = strlen(rest[1]);
  *belongs =
    (PetscBool)(!strncmp(rest[0], rest[1], n) && FileEndsLikeOutput(rest[0] + n) && FileIsSame(folder[0], folder[1]));
  PetscFunctionReturn(0);
}

/* Finds two files of the list that are the same (clash[1] >= 0), or one that the output writes (clash[1] < 0) */
static PetscErrorCode FileFindClash(PetscInt n, const OutputFile files[], const char base[], PetscInt clash[2])
{
  PetscBool same;

  PetscFunctionBegin;
  clash[0] = clash[1] = PETSC_DECIDE;
  for (PetscInt i = 0; i < n; ++i) {
    if (!files[i].name) continue;
    for (PetscInt j = 0; j < i; ++j) {
      if (!files[j].name || (!files[i].written && !files[j].written)) continue;
      PetscCall(FileCompare(files[i].name, files[j].name, &same));
      if (!same) continue;
      clash[0] = i;
      clash[1] = j;
      PetscFunctionReturn(0);
    }
    if (!base) continue;
    PetscCall(FileBelongsToOutput(files[i].name, base, &same));
    if (!same) continue;
    clash[0] = i;
    PetscFunctionReturn(0);
  }
  PetscFunctionReturn(0);
}

/*@C
   OutputCheckDistinct - Checks before a run that it does not write two files of the same name, or over its input;
   raises an error with one sentence if it does

   Collective

   Input Parameters:
+  comm  - the communicator; its first rank looks at the folders
.  n     - number of files
.  files - the files that are read and written beside the output; an entry without a name is skipped
-  base  - base name of the output, as for `OutputCreate()`, or NULL

   Level: intermediate

   Errors: PETSC_ERR_USER_INPUT, on all ranks.

.seealso: `OutputCheckWritable()`, `OutputCreate()`
@*/
PetscErrorCode OutputCheckDistinct(MPI_Comm comm, PetscInt n, const OutputFile files[], const char base[])
{
  PetscInt    clash[2];
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) PetscCall(FileFindClash(n, files, base, clash));
  PetscCallMPI(MPI_Bcast(clash, 2, MPIU_INT, 0, comm));
  PetscCheck(clash[1] < 0, comm, PETSC_ERR_USER_INPUT, "%s and %s are the same file, \"%s\": give them different names",
    files[clash[1] < 0 ? 0 : clash[1]].role, files[clash[0] < 0 ? 0 : clash[0]].role,
    files[clash[0] < 0 ? 0 : clash[0]].name);
  PetscCheck(clash[0] < 0, comm, PETSC_ERR_USER_INPUT,
    "%s names \"%s\", a file in which -output %s stores results: give it another name",
    files[clash[0] < 0 ? 0 : clash[0]].role, files[clash[0] < 0 ? 0 : clash[0]].name, base);
  PetscFunctionReturn(0);
}
