/* Shared by the tests that load a scene of their own text */
#ifndef SCENE_TEXT_H
#define SCENE_TEXT_H

#include <scene.h>

/* Writes the text to a file on the first rank, and loads it on all */
static inline PetscErrorCode SceneLoadText(const char file[], const char text[], Scene *scene)
{
  PetscMPIInt rank;
  FILE       *stream;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) {
    stream = fopen(file, "w");
    PetscCheck(stream, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "cannot write %s", file);
    fputs(text, stream);
    fclose(stream);
  }
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscCall(SceneLoad(PETSC_COMM_WORLD, file, scene));
  PetscFunctionReturn(0);
}

#endif
