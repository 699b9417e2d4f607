/*
   Private header of src/scene, which converts the keys of a file to a scene. The files are listed such that each
   depends only on those before it.
*/
#ifndef SCENEIMPL_H
#define SCENEIMPL_H

#include <scene.h>
#include "src/scene/sections/sectionsimpl.h"

/* validate.c: Collective. Checks a scene beyond its syntax */
PETSC_INTERN PetscErrorCode SceneValidate(MPI_Comm, Scene);

/* key_meanings.c: prints the keys of shapes and the constants of materials as Markdown tables */
PETSC_INTERN PetscErrorCode SceneViewShapeKeys(PetscViewer), SceneViewConstantKeys(PetscViewer);

/* describe_loads.c: prints the loads of a scene */
PETSC_INTERN PetscErrorCode SceneDescribeLoads(Scene, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDescribeVelocity(const SceneBody *, PetscViewer);

/* print_scene.c, describe.c, scene.c: their functions are declared in the public header */

#endif
