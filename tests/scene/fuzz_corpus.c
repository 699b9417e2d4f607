#define _POSIX_C_SOURCE 200809L /* scandir() */

static char help[] = "The inputs of the fuzzers, as an ordinary test: each ends with a mesh or with a sentence.\n\n";

#include "../fuzz/targets.h"
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

/* Damaged Gmsh files: the text `old` of the file sound-FORMAT.msh is replaced */
static const struct {
  const char *name, *format, *old, *replacement;
} damages[] = {
  {"binary-that-is-text", "2.2", "2.2 0 8", "2.2 1 8"},
  {"collapsed", "2.2", "7 1 1 1", "7 1 1 0"},
  {"comments", "2.2", "$MeshFormat", "$Comments\nmade by hand $Nodes\n$EndComments\n$MeshFormat"},
  {"facets-that-cross", "2.2", "4 5 2 1 1 2 9 10 3 6 11 12 7", "4 5 2 1 1 2 9 10 6 3 11 12 7"},
  {"fewer-nodes", "2.2", "12", "13"},
  {"format-9", "2.2", "2.2 0 8", "9.9 0 8"},
  {"huge-count", "2.2", "12", "2000000000"},
  {"infinite", "2.2", "7 1 1 1", "7 1e999 1 1"},
  {"many-tags", "2.2", "3 5 2 1 1 1 2 3 4 5 6 7 8", "3 5 2000 1 1 1 2 3 4 5 6 7 8"},
  {"missing-entity-4.1", "4.1", "2 9 10 12 11\n3 1 5 2", "2 9 10 12 11\n3 9 5 2"},
  {"missing-entity-dimension-4.1", "4.1", "2 9 10 12 11\n3 1 5 2", "2 9 10 12 11\n7 1 5 2"},
  {"missing-entity-of-nodes-4.1", "4.1", "1 12 1 12\n3 1 0 12", "1 12 1 12\n3 4 0 12"},
  {"missing-node-4.1", "4.1", "4 2 9 10 3 6 11 12 7", "4 2 9 10 3 6 11 13 7"},
  {"missing-node-huge", "2.2", "4 5 2 1 1 2 9 10 3 6 11 12 7", "4 5 2 1 1 2 9 10 3 6 11 2000000000 7"},
  {"missing-node-negative", "2.2", "4 5 2 1 1 2 9 10 3 6 11 12 7", "4 5 2 1 1 2 9 10 3 6 11 -12 7"},
  {"missing-node", "2.2", "4 5 2 1 1 2 9 10 3 6 11 12 7", "4 5 2 1 1 2 9 10 3 6 11 99 7"},
  {"more-nodes", "2.2", "12", "11"},
  {"name-without-quotes", "2.2", "2 2 \"left\"", "2 2 left"},
  {"nan", "2.2", "7 1 1 1", "7 nan 1 1"},
  {"negative-count", "2.2", "$Elements\n", "$Elements\n-"},
  {"negative-tags", "2.2", "3 5 2 1 1 1 2 3 4 5 6 7 8", "3 5 -3 1 1 1 2 3 4 5 6 7 8"},
  {"node-twice-in-element", "2.2", "4 5 2 1 1 2 9 10 3 6 11 12 7", "4 5 2 1 1 2 9 10 3 6 11 11 7"},
  {"periodic", "2.2", "$EndElements\n", "$EndElements\n$Periodic\n1\n2 2 1\n2\n9 1\n99 2\n$EndPeriodic\n"},
  {"type-7", "2.2", "2.2 0 8", "2.2 7 8"},
  {"unknown-type", "2.2", "3 5 2 1 1 1 2 3 4 5 6 7 8", "3 140 2 1 1 1 2 3 4 5 6 7 8"},
  {"wide-range-4.1", "4.1", "1 12 1 12", "1 12 1 2000000000"},
  {"wrong-range-4.1", "4.1", "1 12 1 12", "1 12 5 6"},
};

/* Gmsh files that end too early */
static const struct {
  const char *format;
  int         bytes;
} cuts[] = {
  {"2.2", 20},
  {"2.2", 60},
  {"2.2", 130},
  {"2.2", 200},
  {"2.2", 252},
  {"2.2", 300},
  {"4.1-binary", 40},
  {"4.1-binary", 200},
  {"4.1-binary", 400},
  {"4.1-binary", 700},
  {"4.1-binary", 1162},
};

static PetscErrorCode CorpusPath(const char kind[], const char name[], size_t length, char path[])
{
  const char *top = getenv("AMGF_DIR");

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(path, length, "%s/tests/fuzz/corpus/%s/%s", top ? top : ".", kind, name));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(const char kind[], PetscErrorCode (*target)(const char[]), const char name[],
  const char file[], PetscBool verbose)
{
  PetscBool sound = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(FuzzRun(target, file, &sound));
  PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s %s: %s\n", kind, name,
    sound     ? "sound"
    : verbose ? attempt_sentence
              : "refused"));
  PetscFunctionReturn(0);
}

/* Runs a copy of the first `bytes` bytes of a sound file, in which a text is replaced; old = NULL: none is */
static PetscErrorCode RunDamaged(const char name[], const char format[], size_t bytes, const char old[],
  const char replacement[], PetscBool verbose)
{
  char        path[PETSC_MAX_PATH_LEN], base[64], copy[] = "fuzz_damaged.msh", text[4096];
  const char *at;
  FILE       *file;
  size_t      n, length;

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(base, sizeof(base), "sound-%s.msh", format));
  PetscCall(CorpusPath("gmsh", base, sizeof(path), path));
  file = fopen(path, "r");
  PetscCheck(file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "Cannot read %s", path);
  n = fread(text, 1, sizeof(text) - 1, file);
  fclose(file);
  text[n] = '\0';
  length  = PetscMin(n, bytes);
  at      = old ? strstr(text, old) : text + length;
  PetscCheck(at, PETSC_COMM_SELF, PETSC_ERR_PLIB, "%s has no text \"%s\"", path, old);
  file = fopen(copy, "w");
  PetscCheck(file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "Cannot write %s", copy);
  fwrite(text, 1, (size_t)(at - text), file);
  if (old) {
    fputs(replacement, file);
    at += strlen(old);
    fwrite(at, 1, (size_t)(text + length - at), file);
  }
  fclose(file);
  PetscCall(Run("gmsh", FuzzMeshGmsh, name, copy, verbose));
  remove(copy);
  PetscFunctionReturn(0);
}

static int NameOrder(const struct dirent **a, const struct dirent **b)
{
  return strcmp((*a)->d_name, (*b)->d_name);
}

static int IsInput(const struct dirent *entry)
{
  return entry->d_name[0] != '.';
}

static PetscErrorCode RunFolder(const char kind[], PetscErrorCode (*target)(const char[]), PetscBool verbose)
{
  char            folder[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN];
  struct dirent **entries;
  int             n;

  PetscFunctionBeginUser;
  PetscCall(CorpusPath(kind, "", sizeof(folder), folder));
  n = scandir(folder, &entries, IsInput, NameOrder);
  PetscCheck(n > 0, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "No inputs in %s", folder);
  for (int i = 0; i < n; ++i) {
    PetscCall(CorpusPath(kind, entries[i]->d_name, sizeof(file), file));
    PetscCall(Run(kind, target, entries[i]->d_name, file, verbose));
    free(entries[i]);
  }
  free(entries);
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscBool verbose = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-sentences", &verbose, NULL));
  PetscCall(RunFolder("gmsh", FuzzMeshGmsh, verbose));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(damages); ++k)
    PetscCall(
      RunDamaged(damages[k].name, damages[k].format, PETSC_MAX_INT, damages[k].old, damages[k].replacement, verbose));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(cuts); ++k) {
    char name[64];

    PetscCall(PetscSNPrintf(name, sizeof(name), "cut-%s-%d", cuts[k].format, cuts[k].bytes));
    PetscCall(RunDamaged(name, cuts[k].format, (size_t)cuts[k].bytes, NULL, NULL, verbose));
  }
  PetscCall(RunFolder("scene", FuzzMeshScene, verbose));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      args: -malloc_dump 0

TEST*/
