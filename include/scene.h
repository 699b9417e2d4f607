/*
   The file format of scenes: reads a YAML options file into the structs of model.h, checks it and shows it. Nothing
   else knows the format.
*/
#ifndef SCENE_H
#define SCENE_H

#include <petscdm.h>
#include "model.h"

PETSC_EXTERN PetscErrorCode SceneLoad(MPI_Comm, const char file[], Scene *);
PETSC_EXTERN PetscErrorCode SceneView(Scene, PetscViewer);
/* The keys of the format, in tables */
PETSC_EXTERN PetscErrorCode SceneViewKeys(PetscViewer);
/* The text of a scene as it is viewed; what sets another one apart from such a text, but for how the load goes on,
   mesh and solver */
PETSC_EXTERN PetscErrorCode SceneGetText(Scene, char **text);
PETSC_EXTERN PetscErrorCode SceneCompare(Scene, const char text[], char difference[], size_t length);
/* What will be simulated, in words; dm: the scene's mesh */
PETSC_EXTERN PetscErrorCode SceneDescribe(Scene, DM dm, PetscViewer);
PETSC_EXTERN PetscErrorCode SceneReportUnusedOptions(MPI_Comm, Scene);
PETSC_EXTERN PetscErrorCode SceneDestroy(Scene *);

#endif
