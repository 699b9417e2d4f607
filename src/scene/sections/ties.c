/* ties and cyclic: checks the pairs of faces that are tied, and those at which a sector of cyclic symmetry is cut
   out. */
#include "sectionsimpl.h"
#include <string.h>
#include <vector3.h>

static PetscErrorCode SceneValidateCyclic(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < scene->ncyclic; ++k) {
    const SceneCyclic *cut  = &scene->cyclic[k];
    const char        *face = NULL;
    PetscInt           body;

    PetscCall(SceneValidateFace(comm, file, scene, "cyclic symmetry", cut->name, cut->from));
    PetscCall(SceneValidateFace(comm, file, scene, "cyclic symmetry", cut->name, cut->to));
    body = SceneFindBody(scene, cut->from, &face);
    PetscCheck(body == SceneFindBody(scene, cut->to, &face) && strcmp(cut->from, cut->to), comm, PETSC_ERR_USER_INPUT,
      "%s: cyclic symmetry \"%s\" has the faces \"%s\" and \"%s\": they must be two faces of one body", file, cut->name,
      cut->from, cut->to);
    PetscCheck(scene->bodies[body].material.type != MATERIAL_RIGID, comm, PETSC_ERR_USER_INPUT,
      "%s: cyclic symmetry \"%s\": its body \"%s\" is rigid; model all of it", file, cut->name,
      scene->bodies[body].name);
    PetscCheck(VectorNorm(cut->axis) > 0.0, comm, PETSC_ERR_USER_INPUT,
      "%s: cyclic symmetry \"%s\": the axis is (0, 0, 0), which is no direction", file, cut->name);
    for (PetscInt other = 0; other < k; ++other) {
      const SceneCyclic *before = &scene->cyclic[other];

      PetscCheck(strcmp(cut->from, before->from) && strcmp(cut->from, before->to) && strcmp(cut->to, before->from) &&
                   strcmp(cut->to, before->to),
        comm, PETSC_ERR_USER_INPUT, "%s: cyclic symmetries \"%s\" and \"%s\" have a common face", file, before->name,
        cut->name);
    }
  }
  PetscFunctionReturn(0);
}

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
  PetscCall(SceneValidateCyclic(comm, file, scene));
  PetscFunctionReturn(0);
}
