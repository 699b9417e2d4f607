/* What a scene must satisfy beyond its grammar. Every rank holds the same scene, so every rank finds the same error. */
#include "sceneimpl.h"

#define SceneRequire(cond, ...) PetscCheck(cond, comm, PETSC_ERR_USER_INPUT, __VA_ARGS__)

static PetscErrorCode ValidateBodies(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];
    const PetscReal  E = body->material.young, nu = body->material.poisson;

    for (PetscInt i = 0; i < 3; ++i) {
      SceneRequire(body->lower[i] < body->upper[i], "%s: body \"%s\" is a negative box: lower %c = %g is not below upper %c = %g", file, body->name, "xyz"[i], (double)body->lower[i], "xyz"[i], (double)body->upper[i]);
      SceneRequire(body->cells[i] >= 1, "%s: body \"%s\" has %" PetscInt_FMT " cells along %c, it needs at least 1", file, body->name, body->cells[i], "xyz"[i]);
    }
    SceneRequire(E > 0, "%s: body \"%s\" has Young's modulus young = %g, which must be above 0", file, body->name, (double)E);
    SceneRequire(nu > -1 && nu < 0.5, "%s: body \"%s\" has Poisson's ratio poisson = %g, which must lie between -1 and 0.5, both excluded", file, body->name, (double)nu);
  }
  PetscFunctionReturn(0);
}

/* what and owner name the thing that refers to the face, as in: displacement "bottom" */
static PetscErrorCode ValidateFace(MPI_Comm comm, const char file[], Scene scene, const char what[], const char owner[], const char name[], SceneFace *face)
{
  PetscBool found;

  PetscFunctionBegin;
  PetscCall(SceneFindFace(scene, name, face, &found));
  SceneRequire(face->body >= 0, "%s: %s \"%s\" names the face \"%s\" of an unknown body; faces are written <body>.<face>", file, what, owner, name);
  SceneRequire(found, "%s: %s \"%s\" names the face \"%s\", which does not exist; a box has xmin, xmax, ymin, ymax, zmin and zmax", file, what, owner, name);
  PetscFunctionReturn(0);
}

static PetscErrorCode ValidateDisplacements(MPI_Comm comm, const char file[], Scene scene)
{
  SceneFace face;
  PetscBool same;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *here = &scene->displacements[d];

    PetscCall(ValidateFace(comm, file, scene, "displacement", here->name, here->face, &face));
    for (PetscInt e = 0; e < d; ++e) {
      const SceneDisplacement *other = &scene->displacements[e];

      PetscCall(PetscStrcmp(here->face, other->face, &same));
      for (PetscInt i = 0; i < 3; ++i) SceneRequire(!same || !here->fixed[i] || !other->fixed[i], "%s: displacements \"%s\" and \"%s\" both prescribe %c on the face \"%s\"", file, other->name, here->name, "xyz"[i], here->face);
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ValidateContact(MPI_Comm comm, const char file[], Scene scene)
{
  SceneFace face;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *here = &scene->pairs[p];
    PetscBool               same, straight[2], crossed[2];

    PetscCall(ValidateFace(comm, file, scene, "contact pair", here->name, here->mortar, &face));
    PetscCall(ValidateFace(comm, file, scene, "contact pair", here->name, here->nonmortar, &face));
    PetscCall(PetscStrcmp(here->mortar, here->nonmortar, &same));
    SceneRequire(!same, "%s: contact pair \"%s\" has the same face \"%s\" on both sides", file, here->name, here->mortar);
    for (PetscInt q = 0; q < p; ++q) {
      const SceneContactPair *other = &scene->pairs[q];

      PetscCall(PetscStrcmp(here->mortar, other->mortar, &straight[0]));
      PetscCall(PetscStrcmp(here->nonmortar, other->nonmortar, &straight[1]));
      PetscCall(PetscStrcmp(here->mortar, other->nonmortar, &crossed[0]));
      PetscCall(PetscStrcmp(here->nonmortar, other->mortar, &crossed[1]));
      SceneRequire(!(straight[0] && straight[1]) && !(crossed[0] && crossed[1]), "%s: contact pairs \"%s\" and \"%s\" join the same two faces", file, other->name, here->name);
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidate(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  SceneRequire(scene->refine >= 0, "%s: refine = %" PetscInt_FMT ", which must be at least 0", file, scene->refine);
  SceneRequire(scene->nsteps >= 1, "%s: %" PetscInt_FMT " load steps, which must be at least 1", file, scene->nsteps);
  PetscCall(ValidateBodies(comm, file, scene));
  PetscCall(ValidateDisplacements(comm, file, scene));
  PetscCall(ValidateContact(comm, file, scene));
  PetscCall(SceneCheckSupport(comm, file, scene));
  PetscFunctionReturn(0);
}
