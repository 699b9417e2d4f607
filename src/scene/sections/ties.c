/* ties and cyclic: checks the pairs of faces that are tied, and those at which a sector of cyclic symmetry is cut
   out. */
#include "sectionsimpl.h"
#include <string.h>
#include <vector3.h>

static PetscErrorCode SceneValidateCyclic(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < scene->ncyclic; ++k) {
    const SceneCyclic *cut  = &scene->cyclic[k];
    const char        *face = NULL;
    PetscInt           body;

    PetscCall(SceneValidateFace(comm, scene, "cyclic symmetry", cut, cut->from));
    PetscCall(SceneValidateFace(comm, scene, "cyclic symmetry", cut, cut->to));
    body = SceneFindBody(scene, cut->from, &face);
    SceneRequire(body == SceneFindBody(scene, cut->to, &face) && strcmp(cut->from, cut->to), cut,
      "cyclic symmetry \"%s\" has the faces \"%s\" and \"%s\": they must be two faces of one body", cut->name,
      cut->from, cut->to);
    SceneRequire(scene->bodies[body].material.type != MATERIAL_RIGID, cut,
      "cyclic symmetry \"%s\": its body \"%s\" is rigid; model all of it", cut->name, scene->bodies[body].name);
    SceneRequire(VectorNorm(cut->axis) > 0.0, cut,
      "cyclic symmetry \"%s\": the axis is (0, 0, 0), which is no direction", cut->name);
    for (PetscInt other = 0; other < k; ++other) {
      const SceneCyclic *before = &scene->cyclic[other];

      SceneRequire(strcmp(cut->from, before->from) && strcmp(cut->from, before->to) && strcmp(cut->to, before->from) &&
                     strcmp(cut->to, before->to),
        before, "cyclic symmetries \"%s\" and \"%s\" have a common face", before->name, cut->name);
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateTies(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->nties; ++t) {
    const SceneTie *tie  = &scene->ties[t];
    const char     *face = NULL;
    PetscInt        mortar, nonmortar;

    PetscCall(SceneValidateFace(comm, scene, "tie", tie, tie->mortar));
    PetscCall(SceneValidateFace(comm, scene, "tie", tie, tie->nonmortar));
    mortar    = SceneFindBody(scene, tie->mortar, &face);
    nonmortar = SceneFindBody(scene, tie->nonmortar, &face);
    SceneRequire(strcmp(tie->mortar, tie->nonmortar), tie, "tie \"%s\" has the same face \"%s\" on both sides",
      tie->name, tie->mortar);
    SceneRequire(scene->bodies[nonmortar].material.type != MATERIAL_RIGID, tie,
      "tie \"%s\" has a face of the rigid body \"%s\" as its nonmortar face; swap the two", tie->name,
      scene->bodies[nonmortar].name);
    SceneRequire(!SceneBodyIsSurface(&scene->bodies[mortar]), tie,
      "tie \"%s\" has the rigid surface \"%s\" as its mortar face: a rigid surface is only for contact", tie->name,
      scene->bodies[mortar].name);
  }
  PetscCall(SceneValidateCyclic(comm, scene));
  PetscFunctionReturn(0);
}
