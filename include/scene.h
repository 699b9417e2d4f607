/* The file format of scenes: reads a YAML file into the structs of model.h, checks it and shows it. Nothing else knows
   the format. */
#ifndef SCENE_H
#define SCENE_H

#include <petscdm.h>
#include "model.h"

PETSC_EXTERN PetscErrorCode SceneLoad(MPI_Comm, const char file[], Scene *);
PETSC_EXTERN PetscErrorCode SceneView(Scene, PetscViewer);
/* Prints the keys of the format as tables */
PETSC_EXTERN PetscErrorCode SceneViewKeys(PetscViewer);
/* The text of a scene as it is viewed. Compares two such texts; load program, mesh and solver may differ */
PETSC_EXTERN PetscErrorCode SceneGetText(Scene, char **text);
PETSC_EXTERN PetscErrorCode SceneCompare(Scene, const char text[], char difference[], size_t length);
/* Describes what will be simulated; dm: the scene's mesh */
PETSC_EXTERN PetscErrorCode SceneDescribe(Scene, DM dm, PetscViewer);
PETSC_EXTERN PetscErrorCode SceneReportUnusedOptions(MPI_Comm, Scene);
PETSC_EXTERN PetscErrorCode SceneDestroy(Scene *);

#endif
