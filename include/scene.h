/* The file format of scenes: reads a YAML file into the structs of model.h, checks it and prints it. No other part
   of the program knows the format. */
#ifndef SCENE_H
#define SCENE_H

#include <petscdm.h>
#include "model.h"

PETSC_EXTERN PetscErrorCode SceneLoad(MPI_Comm, const char file[], Scene *);
PETSC_EXTERN PetscErrorCode SceneView(Scene, PetscViewer);
/* Prints the keys of the format as Markdown tables */
PETSC_EXTERN PetscErrorCode SceneViewKeys(PetscViewer);
/* Gets the text of a scene as SceneView() prints it. Compares a scene with such a text; load program, mesh
   refinement and solver may differ. */
PETSC_EXTERN PetscErrorCode SceneGetText(Scene, char **text);
PETSC_EXTERN PetscErrorCode SceneCompare(Scene, const char text[], char difference[], size_t length);
/* Chooses the element of every body on the mesh dm: the one that the scene names or, for `auto`, the one that suits
   law and cells. reasons[b]: why it was chosen; NULL if the scene names it. reasons itself may be NULL. */
PETSC_EXTERN PetscErrorCode SceneChooseElements(Scene, DM dm, ElementType elements[], const char *reasons[]);
/* Prints what will be simulated on the mesh dm */
PETSC_EXTERN PetscErrorCode SceneDescribe(Scene, DM dm, PetscViewer);
PETSC_EXTERN PetscErrorCode SceneCheckOptions(MPI_Comm, Scene);
PETSC_EXTERN PetscErrorCode SceneReportUnusedOptions(MPI_Comm, Scene);
PETSC_EXTERN PetscErrorCode SceneDestroy(Scene *);

#endif
