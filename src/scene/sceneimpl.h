/*
   Scene, private: the map of src/scene. From the file's keys to the scene, every file builds on those before it.
*/
#ifndef SCENEIMPL_H
#define SCENEIMPL_H

#include <scene.h>
#include "src/scene/sections/sectionsimpl.h"

/* validate.c. Collective: what a scene must satisfy beyond its grammar */
PETSC_INTERN PetscErrorCode SceneValidate(MPI_Comm, const char file[], Scene);

/* view.c, describe.c, scene.c: what a scene says, what it will simulate, and its life, public */

#endif
