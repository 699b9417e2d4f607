/* The keys of a scene file: reading it, asking for keys, and what to say of those nobody asked for. */
#include "sceneimpl.h"
#include <options.h>
#include <stdarg.h>

static char yaml_complaint[256];

/* PETSc's YAML reader raises from deep inside; the sentence is kept for ours */
static PetscErrorCode KeepComplaint(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n, PetscErrorType type, const char *message, void *ctx)
{
  (void)comm, (void)line, (void)function, (void)file, (void)ctx;
  if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy(yaml_complaint, message, sizeof(yaml_complaint));
  return n;
}

PetscErrorCode SceneKeysCreate(MPI_Comm comm, const char file[], SceneKeys *keys)
{
  SceneKeys      k;
  PetscMPIInt    rank;
  PetscBool      exists = PETSC_FALSE;
  PetscErrorCode ierr;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) PetscCall(PetscTestFile(file, 'r', &exists));
  PetscCallMPI(MPI_Bcast(&exists, 1, MPIU_BOOL, 0, comm));
  PetscCheck(exists, comm, PETSC_ERR_FILE_OPEN, "there is no readable scene file \"%s\"", file);
  if (rank == 0) PetscCall(SceneCheckYAML(file, sizeof(yaml_complaint), yaml_complaint));
  PetscCallMPI(MPI_Bcast(yaml_complaint, sizeof(yaml_complaint), MPI_CHAR, 0, comm));
  PetscCheck(!yaml_complaint[0], comm, PETSC_ERR_FILE_READ, "%s is not a YAML scene (see its brackets, colons and indentation): %s", file, yaml_complaint);
  PetscCall(PetscNew(&k));
  k->comm = comm;
  k->file = file;
  PetscCall(PetscOptionsCreate(&k->options));
  yaml_complaint[0] = 0;
  PetscCall(PetscPushErrorHandler(KeepComplaint, NULL));
  ierr = PetscOptionsInsertFileYAML(comm, k->options, file, PETSC_TRUE);
  PetscCall(PetscPopErrorHandler());
  PetscCheck(!ierr, comm, PETSC_ERR_FILE_READ, "%s is not a YAML scene (see its brackets, colons and indentation): %s", file, yaml_complaint);
  *keys = k;
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysComplain(SceneKeys keys, const char format[], ...)
{
  va_list args;

  PetscFunctionBegin;
  if (keys->complaint[0]) PetscFunctionReturn(0);
  va_start(args, format);
  PetscCall(PetscVSNPrintf(keys->complaint, sizeof(keys->complaint), format, NULL, args));
  va_end(args);
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneKeysRemember(SceneKeys keys, const char key[])
{
  PetscFunctionBegin;
  if (keys->nasked == keys->maxasked) {
    keys->maxasked = 2 * keys->maxasked + 16;
    PetscCall(PetscRealloc(keys->maxasked * sizeof(*keys->asked), &keys->asked));
  }
  PetscCall(PetscStrallocpy(key, &keys->asked[keys->nasked++]));
  PetscFunctionReturn(0);
}

/* The text of a key, borrowed; NULL if the file has not got it */
PetscErrorCode SceneKeysGet(SceneKeys keys, PetscBool required, const char **value, const char format[], ...)
{
  char      option[SCENE_KEY_LENGTH] = "-";
  PetscBool set;
  va_list   args;

  PetscFunctionBegin;
  va_start(args, format);
  PetscCall(PetscVSNPrintf(option + 1, sizeof(option) - 1, format, NULL, args));
  va_end(args);
  PetscCall(SceneKeysRemember(keys, option + 1));
  PetscCall(PetscOptionsFindPair(keys->options, NULL, option, value, &set));
  if (set && !*value) *value = "";
  if (!set) {
    *value = NULL;
    if (required) PetscCall(SceneKeysComplain(keys, "the key \"%s\" is missing", option + 1));
  }
  PetscFunctionReturn(0);
}

/* Raises what is wrong with the file, if anything: a key nobody asked for, else the first complaint */
PetscErrorCode SceneKeysCheck(SceneKeys keys)
{
  PetscInt    n;
  char      **names, **values;
  const char *nearest, *unknown = NULL;
  size_t      shortest = 0, length;

  PetscFunctionBegin;
  PetscCall(PetscOptionsLeftGet(keys->options, &n, &names, &values));
  /* The shortest is the outermost: below a misspelt list every key is unknown */
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(PetscStrlen(names[i], &length));
    if (!unknown || length < shortest) {
      unknown  = names[i];
      shortest = length;
    }
  }
  if (unknown) {
    PetscCall(OptionsNearest(keys->nasked, (const char *const *)keys->asked, unknown, &nearest));
    SETERRQ(keys->comm, PETSC_ERR_USER_INPUT, "%s: unknown key \"%s\"; the nearest valid key is \"%s\"", keys->file, unknown, nearest);
  }
  PetscCall(PetscOptionsLeftRestore(keys->options, &n, &names, &values));
  PetscCheck(!keys->complaint[0], keys->comm, PETSC_ERR_USER_INPUT, "%s: %s", keys->file, keys->complaint);
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysDestroy(SceneKeys *keys)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < (*keys)->nasked; ++i) PetscCall(PetscFree((*keys)->asked[i]));
  PetscCall(PetscFree((*keys)->asked));
  PetscCall(PetscOptionsDestroy(&(*keys)->options));
  PetscCall(PetscFree(*keys));
  PetscFunctionReturn(0);
}
