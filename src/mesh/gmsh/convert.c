/* Converts mesh files of other formats, and mesh files with a scale, into temporary Gmsh files by
   share/python/contact_mesh.py */
#define _POSIX_C_SOURCE 200809L /* mkdtemp() */
#include "gmshimpl.h"
#include "src/files/filesimpl.h"
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* Returns whether the mesh file of a body must be converted, by the ending of its name or because it has a scale. A
   file with an unknown ending must be a Gmsh file. */
static PetscBool GmshMustConvert(const SceneBody *body)
{
  static const char *const endings[] = {".inp", ".med", ".e", ".exo", ".ex2", ".vtu", ".vtk"};
  const char              *dot       = body->gmsh.file ? strrchr(body->gmsh.file, '.') : NULL;

  if (body->shape != SHAPE_GMSH || !body->gmsh.file) return PETSC_FALSE;
  if (body->gmsh.scale != 0 && body->gmsh.scale != 1) return PETSC_TRUE;
  for (size_t i = 0; dot && i < PETSC_STATIC_ARRAY_LENGTH(endings); ++i) {
    if (!strcasecmp(dot, endings[i])) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Runs the converter, which writes the Gmsh file `path` */
static PetscErrorCode GmshRunConverter(const SceneBody *body, const char path[])
{
  char        script[PETSC_MAX_PATH_LEN], sentence[512], scale[32];
  const char *words[] = {CONTACT_PYTHON, "-B", script, body->gmsh.file, path, "-quiet", "-scale", scale, NULL};
  const char *text;

  PetscFunctionBegin;
  (void)snprintf(scale, sizeof(scale), "%.17g", body->gmsh.scale != 0 ? (double)body->gmsh.scale : 1.0);
  PetscCheck(ScriptFind("python/contact_mesh.py", script, sizeof(script), sentence, sizeof(sentence)), PETSC_COMM_SELF,
    PETSC_ERR_USER_INPUT, "%s", sentence);
  if (!ScriptRun(words, sentence, sizeof(sentence))) PetscFunctionReturn(0);
  text = strstr(sentence, "error: ");
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "%s", text ? text + strlen("error: ") : sentence);
}

/* Converts the mesh file of a body, on rank 0. path: name of the file by its open descriptor. The file itself is
   removed as soon as it is open, so that no run leaves it behind. */
static PetscErrorCode GmshConvertFile(SceneBody *body, size_t length, char path[])
{
  const char    *tmp = getenv("TMPDIR");
  char           folder[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN];
  PetscErrorCode ierr;

  PetscFunctionBegin;
  PetscCheck(body->gmsh.scale >= 0 && !PetscIsInfOrNanReal(body->gmsh.scale), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "the key scale must be positive, but is %g", (double)body->gmsh.scale);
  PetscCall(PetscSNPrintf(folder, sizeof(folder), "%s/contact-XXXXXX", tmp && tmp[0] ? tmp : "/tmp"));
  PetscCheck(mkdtemp(folder), PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "cannot create the folder %s", folder);
  PetscCall(PetscSNPrintf(file, sizeof(file), "%.1000s/mesh.msh", folder));
  ierr                  = GmshRunConverter(body, file);
  body->gmsh.descriptor = ierr ? 0 : PetscMax(0, open(file, O_RDONLY | O_CLOEXEC));
  (void)unlink(file);
  (void)rmdir(folder);
  PetscCall(ierr);
  PetscCheck(body->gmsh.descriptor, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "cannot read the converted file %s", file);
  PetscCall(PetscSNPrintf(path, length, "/proc/self/fd/%d", body->gmsh.descriptor));
  PetscFunctionReturn(0);
}

/* Returns the number of an earlier body with the same file and scale, or b if there is none. Body b has a file. */
static PetscInt GmshFindSame(const SceneBody bodies[], PetscInt b)
{
  for (PetscInt a = 0; a < b; ++a) {
    if (bodies[a].gmsh.converted && bodies[a].gmsh.scale == bodies[b].gmsh.scale &&
        !strcmp(bodies[a].gmsh.file, bodies[b].gmsh.file))
      return a;
  }
  return b;
}

PetscErrorCode GmshConvert(MPI_Comm comm, PetscInt nbodies, SceneBody bodies[])
{
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscInt       same;
    char           path[PETSC_MAX_PATH_LEN] = "";
    RankError      error;
    PetscErrorCode ierr = 0;

    if (!GmshMustConvert(&bodies[b])) continue;
    same = GmshFindSame(bodies, b);
    if (same < b) {
      PetscCall(PetscStrallocpy(bodies[same].gmsh.converted, &bodies[b].gmsh.converted));
      continue;
    }
    PetscCall(RankErrorBegin(&error));
    if (rank == 0) ierr = GmshConvertFile(&bodies[b], sizeof(path), path);
    PetscCall(RankErrorEnd(comm, ierr, &error));
    SceneCheck(!error.code, comm, PETSC_ERR_USER_INPUT, &bodies[b], "Body \"%s\": %s", bodies[b].name, error.message);
    PetscCallMPI(MPI_Bcast(path, sizeof(path), MPI_CHAR, 0, comm));
    PetscCall(PetscStrallocpy(path, &bodies[b].gmsh.converted));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode GmshRemoveConverted(SceneBody *body)
{
  PetscFunctionBegin;
  if (body->gmsh.descriptor) (void)close(body->gmsh.descriptor);
  body->gmsh.descriptor = 0;
  PetscCall(PetscFree(body->gmsh.converted));
  PetscFunctionReturn(0);
}
