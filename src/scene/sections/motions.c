/* Checks rigid motions. Several rigid motions of a face or body are added, and every rigid body needs one. */
#include "sectionsimpl.h"
#include <vector3.h>

/*
   Marks the displacements of a face as rigid motions (moves) if several of them prescribe all components, so that they
   are added. A displacement is also added to rotations of the face, unless it holds the face in place.
*/
PetscErrorCode SceneJoinMotions(Scene scene)
{
  PetscBool same;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    SceneDisplacement *here = &scene->displacements[d];

    for (PetscInt e = 0; e < scene->ndisplacements; ++e) {
      SceneDisplacement *other = &scene->displacements[e];

      PetscCall(PetscStrcmp(here->face, other->face, &same));
      for (PetscInt i = 0; i < 3; ++i) same = (PetscBool)(same && here->fixed[i] && other->fixed[i]);
      same = (PetscBool)(same && e != d && here->at == DISPLACEMENT_FACE);
      if (same && !SceneRotates(here) && (!SceneRotates(other) || VectorNorm(here->value) > 0.0))
        here->moves = PETSC_TRUE;
    }
  }
  PetscFunctionReturn(0);
}

/* Checks two displacements of the same face or body. Both must be rigid motions about the same center. */
PetscErrorCode SceneValidateMotions(MPI_Comm comm, const SceneDisplacement *a, const SceneDisplacement *b)
{
  PetscFunctionBegin;
  SceneRequire(a->moves && b->moves, a->moves ? a : b,
    "displacement \"%s\" is a rigid motion of %s, but \"%s\" displaces the same face: remove one of them",
    a->moves ? a->name : b->name, a->face, a->moves ? b->name : a->name);
  for (PetscInt i = 0; i < 6; ++i)
    SceneRequire(a->released[i] == b->released[i], a,
      "displacements \"%s\" and \"%s\" add up to one rigid motion, but only \"%s\" has a free %s %c: make it free "
      "in both or in neither",
      a->name, b->name, a->released[i] ? a->name : b->name, i < 3 ? "translation along" : "rotation about",
      "xyz"[i % 3]);
  for (PetscInt i = 0; i < 3; ++i)
    SceneRequire((!SceneTurnsFreely(a) && !(SceneRotates(a) && SceneRotates(b))) || a->center[i] == b->center[i], a,
      "displacements \"%s\" and \"%s\" add up to one rigid motion, but rotate about different centers: give both "
      "the same center",
      a->name, b->name);
  PetscFunctionReturn(0);
}

/* Checks that there is something to compute: an elastic body, or a free motion of a rigid one. */
static PetscErrorCode SceneValidateUnknowns(MPI_Comm comm, Scene scene)
{
  PetscBool some = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b)
    some = (PetscBool)(some || scene->bodies[b].material.type != MATERIAL_RIGID);
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    some = (PetscBool)(some || SceneFreesMotion(&scene->displacements[d]));
  PetscCheck(some, comm, PETSC_ERR_USER_INPUT,
    "%severy body is rigid, and no motion of any of them is free: there is nothing to compute", scene->places.file);
  PetscFunctionReturn(0);
}

/* Checks that every rigid body is moved as a whole, and that no other displacement applies to its faces. */
PetscErrorCode SceneValidateRigid(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body  = &scene->bodies[b];
    PetscBool        moved = PETSC_FALSE;

    if (body->material.type != MATERIAL_RIGID) continue;
    for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
      const char *face = NULL;

      if (SceneFindBody(scene, scene->displacements[d].face, &face) != b) continue;
      moved = PETSC_TRUE;
      SceneRequire(SceneIsWholeBody(scene->displacements[d].face), &scene->displacements[d],
        "displacement \"%s\" names the face \"%s\" of a rigid body; a rigid body moves as a whole: - %s: {body: "
        "%s, value: [0, 0, 0]}",
        scene->displacements[d].name, scene->displacements[d].face, scene->displacements[d].name, body->name);
    }
    SceneRequire(moved, body,
      "no displacement says how the rigid body \"%s\" moves; add for example displacements: - %s: {body: %s, "
      "value: [0, 0, 0]}",
      body->name, body->name, body->name);
  }
  PetscCall(SceneValidateUnknowns(comm, scene));
  PetscFunctionReturn(0);
}
