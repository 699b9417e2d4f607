#define _POSIX_C_SOURCE 200809L /* scandir() */

static char help[] = "The inputs of the fuzzers, as an ordinary test: each ends with a mesh or with a sentence.\n\n";

#include "../fuzz/targets.h"
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

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
  PetscCall(PetscSNPrintf(folder, sizeof(folder), "%s/tests/fuzz/corpus/%s",
    getenv("AMGF_DIR") ? getenv("AMGF_DIR") : ".", kind));
  n = scandir(folder, &entries, IsInput, NameOrder);
  PetscCheck(n > 0, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "No inputs in %s", folder);
  for (int i = 0; i < n; ++i) {
    PetscBool sound = PETSC_FALSE;

    PetscCall(PetscSNPrintf(file, sizeof(file), "%s/%s", folder, entries[i]->d_name));
    PetscCall(FuzzRun(target, file, &sound));
    PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s %s: %s\n", kind, entries[i]->d_name,
      sound     ? "sound"
      : verbose ? attempt_sentence
                : "refused"));
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
  PetscCall(RunFolder("scene", FuzzMeshScene, verbose));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      args: -malloc_dump 0

TEST*/
