/* ties: checks pairs of faces that are tied. */
#include "sectionsimpl.h"
#include <string.h>

PetscErrorCode SceneValidateTies(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->nties; ++t) {
    const SceneTie *tie  = &scene->ties[t];
    const char     *face = NULL;
    PetscInt        mortar, nonmortar;

    PetscCall(SceneValidateFace(comm, file, scene, "tie", tie->name, tie->mortar));
    PetscCall(SceneValidateFace(comm, file, scene, "tie", tie->name, tie->nonmortar));
    mortar    = SceneFindBody(scene, tie->mortar, &face);
    nonmortar = SceneFindBody(scene, tie->nonmortar, &face);
    PetscCheck(strcmp(tie->mortar, tie->nonmortar), comm, PETSC_ERR_USER_INPUT,
      "%s: tie \"%s\" has the same face \"%s\" on both sides", file, tie->name, tie->mortar);
    PetscCheck(scene->bodies[nonmortar].material.type != MATERIAL_RIGID, comm, PETSC_ERR_USER_INPUT,
      "%s: tie \"%s\" has a face of the rigid body \"%s\" as its nonmortar face; swap the two", file, tie->name,
      scene->bodies[nonmortar].name);
    PetscCheck(!SceneBodyIsSurface(&scene->bodies[mortar]), comm, PETSC_ERR_USER_INPUT,
      "%s: tie \"%s\" has the rigid surface \"%s\" as its mortar face: a rigid surface is only for contact", file,
      tie->name, scene->bodies[mortar].name);
  }
  PetscFunctionReturn(0);
}
