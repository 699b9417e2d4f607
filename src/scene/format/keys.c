/* Reads a scene file, looks up its keys, and reports keys that were not used. */
#include "formatimpl.h"
#include "src/files/filesimpl.h"
#include <options.h>
#include <stdarg.h>
#include <string.h>
#include <strings.h>

/* Reads the whole file and appends a zero byte. Call this function on rank 0. */
static PetscErrorCode SceneKeysReadText(const char file[], PetscInt64 *length, char **text)
{
  FILE     *stream;
  PetscBool exists;

  PetscFunctionBegin;
  PetscCall(PetscTestFile(file, 'r', &exists));
  stream = exists ? fopen(file, "r") : NULL;
  PetscCheck(stream, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "there is no readable scene file \"%s\"", file);
  PetscCheck(!fseek(stream, 0, SEEK_END), PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "the scene file \"%s\" cannot be read",
    file);
  *length = (PetscInt64)ftell(stream);
  rewind(stream);
  PetscCheck(*length >= 0 && *length < PETSC_MPI_INT_MAX, PETSC_COMM_SELF, PETSC_ERR_FILE_READ,
    "the scene file \"%s\" has %" PetscInt64_FMT " bytes, more than %d", file, *length, PETSC_MPI_INT_MAX);
  PetscCall(PetscCalloc1(*length + 1, text));
  PetscCheck(fread(*text, 1, (size_t)*length, stream) == (size_t)*length, PETSC_COMM_SELF, PETSC_ERR_FILE_READ,
    "the scene file \"%s\" cannot be read", file);
  (void)fclose(stream);
  PetscFunctionReturn(0);
}

/* Gets the text of the file on all ranks. *text: freed by the caller. */
static PetscErrorCode SceneKeysGetText(MPI_Comm comm, const char file[], PetscInt64 *length, char **text)
{
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  RankCall(comm, rank == 0, SceneKeysReadText(file, length, text));
  PetscCall(FileBroadcastText(comm, length, text));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysCreate(MPI_Comm comm, const char file[], SceneKeys *keys)
{
  SceneKeys      k;
  PetscInt64     length;
  char          *text;
  RankError      error;
  PetscErrorCode ierr;

  PetscFunctionBegin;
  PetscCall(SceneKeysGetText(comm, file, &length, &text));
  PetscCall(PetscNew(&k));
  k->comm = comm;
  k->file = file;
  PetscCall(RankErrorBegin(&error));
  ierr = SceneCheckYAML(file, (size_t)length, text, &k->places);
  if (!ierr) ierr = SceneValuesRead(text, &k->values);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(error.code != PETSC_ERR_USER_INPUT, comm, PETSC_ERR_USER_INPUT, "%s: %s", file, error.message);
  PetscCheck(!error.code, comm, PETSC_ERR_FILE_READ, "%s: %s", file, error.message);
  PetscCall(PetscFree(text));
  *keys = k;
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysError(SceneKeys keys, const char owner[], const char key[], const char format[], ...)
{
  char    full[SCENE_KEY_LENGTH], name[3 * SCENE_KEY_LENGTH], text[1024];
  va_list args;

  PetscFunctionBegin;
  if (keys->error[0]) PetscFunctionReturn(0);
  va_start(args, format);
  PetscCall(PetscVSNPrintf(text, sizeof(text), format, NULL, args));
  va_end(args);
  PetscCall(PetscSNPrintf(full, sizeof(full), "%s%s%s", owner, key ? "_" : "", key ? key : ""));
  SceneKeysSay(keys, full, PETSC_TRUE, sizeof(name), name);
  PetscCall(PetscSNPrintf(keys->error, sizeof(keys->error), "%s%s%s%s", SceneGetPlace(&keys->places, full), name,
    strchr(",:", text[0]) ? "" : " ", text));
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

/* Gets the text of a key. *value: owned by `keys`; NULL if the file does not have the key. */
PetscErrorCode SceneKeysGet(SceneKeys keys, PetscBool required, const char **value, const char format[], ...)
{
  char    key[SCENE_KEY_LENGTH], name[3 * SCENE_KEY_LENGTH];
  va_list args;

  PetscFunctionBegin;
  va_start(args, format);
  PetscCall(PetscVSNPrintf(key, sizeof(key), format, NULL, args));
  va_end(args);
  PetscCall(SceneKeysRemember(keys, key));
  *value = SceneValuesUse(&keys->values, key);
  if (*value || !required || keys->error[0]) PetscFunctionReturn(0);
  SceneKeysSay(keys, key, PETSC_FALSE, sizeof(name), name);
  PetscCall(
    PetscSNPrintf(keys->error, sizeof(keys->error), "%sthe %s is missing", SceneGetPlace(&keys->places, key), name));
  PetscFunctionReturn(0);
}

/* Returns whether the last part of a key is a number. YAML finds such a key, 3, in {poisson: 0,3}. */
static PetscBool SceneKeyIsNumber(const char key[])
{
  const char *last = strrchr(key, '_');

  return (PetscBool)(last && last[1] && strspn(last + 1, "0123456789.") == strlen(last + 1));
}

/* Names by which other programs or users call a key, and its name in a scene. */
static const char *const synonyms[][2] = {
  {"e", "young"},
  {"modulus", "young"},
  {"youngs_modulus", "young"},
  {"young_modulus", "young"},
  {"nu", "poisson"},
  {"yield_stress", "yield"},
  {"plastic_strain", "plastic_strains"},
  {"hardening_modulus", "hardening"},
  {"poissons_ratio", "poisson"},
  {"poisson_ratio", "poisson"},
  {"alpha", "expansion"},
  {"slave", "nonmortar"},
  {"secondary", "nonmortar"},
  {"contact", "nonmortar"},
  {"master", "mortar"},
  {"primary", "mortar"},
  {"target", "mortar"},
  {"mu", "friction"},
  {"coefficient", "friction"},
  {"friction_coefficient", "friction"},
  {"tied", "ties"},
  {"tie", "ties"},
  {"law", "material"},
  {"size", "upper"},
  {"min", "lower"},
  {"max", "upper"},
  {"elements", "cells"},
  {"divisions", "cells"},
  {"file", "mesh"},
  {"surface", "face"},
  {"set", "face"},
  {"amplitude", "ramp"},
  {"parts", "bodies"},
  {"interactions", "contact"},
  {"contacts", "contact"},
  {"boundary_conditions", "displacements"},
  {"boundary", "displacements"},
  {"dirichlet", "displacements"},
  {"gravity", "body_forces"},
  {"neumann", "tractions"},
  {"increments", "steps"},
  {"rho", "density"},
  {"dt", "time_step"},
  {"step", "time_step"},
  {"duration", "end_time"},
  {"velocity", "initial_velocity"},
};

/*
   Gets the valid keys in the entry or list that contains an unknown key. *below: number of its letters that name its
   list and entry; names: valid continuations after these letters, or the rows of the table at the top level (*below =
   0).
*/
static PetscErrorCode SceneKeysGetValid(SceneKeys keys, const char unknown[], size_t *below, PetscInt *n,
  const char ***names)
{
  PetscFunctionBegin;
  *below = 0;
  for (PetscInt i = 0; i < keys->nasked; ++i) {
    for (size_t c = 0; unknown[c] && keys->asked[i][c] == unknown[c]; ++c) {
      if (unknown[c] == '_') *below = PetscMax(*below, c + 1);
    }
  }
  *n = 0;
  PetscCall(PetscMalloc1(keys->nasked + 64, names));
  for (PetscInt i = 0; *below && i < keys->nasked; ++i) {
    PetscBool here, twice = PETSC_FALSE;

    PetscCall(PetscStrncmp(keys->asked[i], unknown, *below, &here));
    for (PetscInt k = 0; here && k < *n && !twice; ++k)
      PetscCall(PetscStrcmp((*names)[k], keys->asked[i] + *below, &twice));
    if (here && !twice) (*names)[(*n)++] = keys->asked[i] + *below;
  }
  for (PetscInt i = 0; !keys->top && !*below && i < keys->nasked; ++i) {
    if (!strchr(keys->asked[i], '_')) (*names)[(*n)++] = keys->asked[i];
  }
  for (const SceneKey *row = keys->top; row && !*below && row->name && *n < 64; ++row) (*names)[(*n)++] = row->name;
  PetscFunctionReturn(0);
}

/* Suggests which key was meant by an unknown key: a synonym, the nearest name, or a list of the valid keys. */
static PetscErrorCode SceneKeysExplain(SceneKeys keys, const char unknown[], char meant[], size_t length)
{
  const char **names, *nearest, *suffix;
  char         full[SCENE_KEY_LENGTH];
  size_t       below, distance, letters;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(SceneKeysGetValid(keys, unknown, &below, &n, &names));
  suffix = unknown + below;
  for (size_t s = 0; s < PETSC_STATIC_ARRAY_LENGTH(synonyms); ++s) {
    PetscBool same, valid = PETSC_FALSE;

    PetscCall(PetscStrcasecmp(suffix, synonyms[s][0], &same));
    for (PetscInt k = 0; same && k < n && !valid; ++k) PetscCall(PetscStrcmp(names[k], synonyms[s][1], &valid));
    if (!same || !valid) continue;
    PetscCall(PetscSNPrintf(meant, length, "it is called \"%s\" here", synonyms[s][1]));
    PetscCall(PetscFree(names));
    PetscFunctionReturn(0);
  }
  PetscCall(OptionsNearest(n, names, suffix, &nearest));
  PetscCall(OptionsDistance(suffix, nearest, &distance));
  PetscCall(PetscStrlen(suffix, &letters));
  if (2 * distance < PetscMax(letters, 3)) {
    PetscCall(PetscSNPrintf(full, sizeof(full), "%.*s%s", (int)below, unknown, nearest));
    PetscCall(PetscSNPrintf(meant, length, "the nearest valid key is \"%s\"", SceneKeyOf(keys, full)));
  } else {
    PetscCall(PetscStrncpy(meant, "valid keys are", length));
    for (PetscInt k = 0; k < n; ++k) {
      PetscCall(PetscStrlcat(meant, k ? ", " : " ", length));
      PetscCall(PetscStrlcat(meant, names[k], length));
    }
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/*
   Raises an error if the entries of a list have no dashes. In this case the file has the key of the list, but its value
   is a mapping instead of a list.
*/
static PetscErrorCode SceneKeysRaiseDashes(SceneKeys keys, const char unknown[], const char place[])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < keys->nasked; ++i) {
    const char  *asked  = keys->asked[i];
    const size_t length = strlen(asked);

    PetscCheck(strncasecmp(asked, unknown, length) || unknown[length] != '_' || !SceneFindPlace(&keys->places, asked) ||
                 SceneValuesUse(&keys->values, asked),
      keys->comm, PETSC_ERR_USER_INPUT,
      "%s%s is a list: each entry begins with a dash and its name, as in - name: {key: value, ...}", place, asked);
  }
  PetscFunctionReturn(0);
}

/* Raises an error if a key that must have keys below it has a value. */
static PetscErrorCode SceneKeysRaiseNested(SceneKeys keys, const char unknown[], const char place[])
{
  const size_t length     = strlen(unknown);
  char         below[512] = "", name[3 * SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < keys->nasked; ++i) {
    PetscBool before = PETSC_FALSE; /* a key may have been asked for more than once */

    if (strncasecmp(keys->asked[i], unknown, length) || keys->asked[i][length] != '_') continue;
    for (PetscInt j = 0; j < i; ++j) before = (PetscBool)(before || !strcasecmp(keys->asked[i], keys->asked[j]));
    if (before) continue;
    PetscCall(PetscStrlcat(below, below[0] ? ", " : "", sizeof(below)));
    PetscCall(PetscStrlcat(below, keys->asked[i] + length + 1, sizeof(below)));
  }
  SceneKeysSay(keys, unknown, PETSC_TRUE, sizeof(name), name);
  PetscCheck(!below[0], keys->comm, PETSC_ERR_USER_INPUT, "%s%s takes no value, but keys below it: %s", place, name,
    below);
  PetscFunctionReturn(0);
}

/* Raises an error for an unknown key. */
static PetscErrorCode SceneKeysRaiseUnknown(SceneKeys keys, const char unknown[])
{
  const char *found = SceneFindPlace(&keys->places, unknown), *place = found ? found : keys->places.file;
  char        name[3 * SCENE_KEY_LENGTH], meant[1024];

  PetscFunctionBegin;
  PetscCheck(!strchr(unknown, ','), keys->comm, PETSC_ERR_USER_INPUT,
    "%sthe key \"%s\" contains a comma: a name is a letter, then letters, digits, _ or -", place, unknown);
  SceneKeysSay(keys, unknown, PETSC_FALSE, sizeof(name), name);
  PetscCheck(!SceneKeyIsNumber(unknown), keys->comm, PETSC_ERR_USER_INPUT,
    "%sthe %s is a number: write decimals with a point (0.3), and several values in brackets ([1, 2])", place, name);
  PetscCall(SceneKeysRaiseDashes(keys, unknown, place));
  PetscCall(SceneKeysRaiseNested(keys, unknown, place));
  PetscCall(SceneKeysExplain(keys, unknown, meant, sizeof(meant)));
  SETERRQ(keys->comm, PETSC_ERR_USER_INPUT, "%sunknown %s; %s", place, name, meant);
}

/* Raises the first error of the file: an unknown key, or otherwise the first wrong value. */
PetscErrorCode SceneKeysCheck(SceneKeys keys)
{
  const char *unknown  = NULL;
  size_t      shortest = 0, length;

  PetscFunctionBegin;
  PetscCheck(!keys->decides, keys->comm, PETSC_ERR_USER_INPUT, "%s", keys->error);
  /* the shortest unknown key is the outermost one, since below a misspelt list every key is unknown */
  for (PetscInt i = 0; i < keys->values.n; ++i) {
    if (keys->values.values[i].used) continue;
    PetscCall(PetscStrlen(keys->values.values[i].key, &length));
    if (!unknown || length < shortest) {
      unknown  = keys->values.values[i].key;
      shortest = length;
    }
  }
  if (unknown) PetscCall(SceneKeysRaiseUnknown(keys, unknown));
  PetscCheck(!keys->error[0], keys->comm, PETSC_ERR_USER_INPUT, "%s", keys->error);
  PetscFunctionReturn(0);
}

/* Makes a file name relative to the folder of the scene. */
PetscErrorCode SceneResolveFile(const char scene[], char **file)
{
  const char *slash = strrchr(scene, '/');
  char        path[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  if (!*file || (*file)[0] == '/' || !slash) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(path, sizeof(path), "%.*s/%s", (int)(slash - scene), scene, *file));
  PetscCall(PetscFree(*file));
  PetscCall(PetscStrallocpy(path, file));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysDestroy(SceneKeys *keys)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < (*keys)->nasked; ++i) PetscCall(PetscFree((*keys)->asked[i]));
  PetscCall(PetscFree((*keys)->asked));
  PetscCall(SceneDestroyPlaces(&(*keys)->places));
  for (PetscInt i = 0; i < (*keys)->nmaterials; ++i) PetscCall(PetscFree((*keys)->materials[i].name));
  PetscCall(PetscFree((*keys)->materials));
  PetscCall(SceneValuesDestroy(&(*keys)->values));
  PetscCall(PetscFree(*keys));
  PetscFunctionReturn(0);
}
