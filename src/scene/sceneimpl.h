/*
   Private header of src/scene. From the file's keys to the scene; files in the order in which they depend on each
   other.
*/
#ifndef SCENEIMPL_H
#define SCENEIMPL_H

#include <scene.h>
#include "src/scene/sections/sectionsimpl.h"

/* validate.c. Collective: checks a scene beyond its syntax */
PETSC_INTERN PetscErrorCode SceneValidate(MPI_Comm, const char file[], Scene);

/* key_meanings.c: the keys of shapes and the constants of materials as tables of Markdown */
PETSC_INTERN PetscErrorCode SceneViewShapeKeys(PetscViewer), SceneViewConstantKeys(PetscViewer);

/* view.c, describe.c, scene.c: only public functions */

#endif
