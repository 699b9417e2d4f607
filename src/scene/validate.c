/* Checks a scene beyond its syntax. Every rank has the same scene, so that every rank finds the same error. */
#include "sceneimpl.h"
#include <mesh.h>

#define SceneRequire(cond, ...) PetscCheck(cond, comm, PETSC_ERR_USER_INPUT, __VA_ARGS__)

static PetscErrorCode SceneValidateBodies(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];

    for (PetscInt i = 0; i < 3 && body->shape == SHAPE_BOX; ++i) {
      SceneRequire(body->lower[i] < body->upper[i],
        "%s: body \"%s\" is a negative box: lower %c = %g is not below upper %c = %g", file, body->name, "xyz"[i],
        (double)body -> lower[i], "xyz"[i], (double)body -> upper[i]);
      SceneRequire(body->cells[i] >= 1, "%s: body \"%s\" has %" PetscInt_FMT " cells along %c, it needs at least 1",
        file, body->name, body->cells[i], "xyz"[i]);
    }
    PetscCall(MeshCheckBody(comm, body));
    PetscCall(SceneValidateConstants(comm, file, body));
    SceneRequire(body->order >= 0 && body->order <= 2,
      "%s: body \"%s\" has order = %" PetscInt_FMT ", which must be 1 or 2", file, body->name, body->order);
    SceneRequire(body->element != ELEMENT_INCOMPATIBLE || body->order < 2,
      "%s: body \"%s\" has element incompatible with order 2; incompatible modes are only for cells of order 1; use "
      "element full or bbar",
      file, body->name);
    SceneRequire(body->element != ELEMENT_INCOMPATIBLE || !MaterialIsFinite(&body->material),
      "%s: body \"%s\" has element incompatible with material %s; at finite strain incompatible modes are unstable "
      "under compression; use element full or bbar",
      file, body->name, MaterialTypes[body->material.type]);
    SceneRequire(scene->model != MODEL_QUADRATIC || !MaterialYields(&body->material),
      "%s: body \"%s\" has material %s with model quadratic, whose single tangent does not follow the yield surface; "
      "use model energy",
      file, body->name, MaterialTypes[body->material.type]);
    SceneRequire(body->element != ELEMENT_BBAR || body->material.type != MATERIAL_SAINT_VENANT,
      "%s: body \"%s\" has element bbar with material saint_venant, whose dilatation tr E is not the change of volume "
      "that bbar averages; use material neohookean near incompressibility, or element full",
      file, body->name);
  }
  PetscFunctionReturn(0);
}

/*
   Checks the mass of a rigid body. In a dynamic analysis a rigid body needs mass if some of its motions are not
   prescribed.
*/
static PetscErrorCode SceneValidateRigidMass(MPI_Comm comm, const char file[], Scene scene, const SceneDisplacement *d)
{
  const char *face;
  PetscInt    b;

  PetscFunctionBegin;
  if (!SceneIsDynamic(scene) || !SceneFreesMotion(d)) PetscFunctionReturn(0);
  b = SceneFindBody(scene, d->face, &face);
  SceneRequire(!SceneBodyIsSurface(&scene->bodies[b]) || scene->bodies[b].own[SURFACE_MASS] > 0,
    "%s: displacement \"%s\" leaves motions of the body \"%s\" free, which is a rigid surface and needs the key mass "
    "in dynamics",
    file, d->name, scene->bodies[b].name);
  SceneRequire(SceneBodyIsSurface(&scene->bodies[b]) || scene->bodies[b].material.density > 0,
    "%s: displacement \"%s\" leaves motions of the rigid body \"%s\" free, which needs a density in dynamics", file,
    d->name, scene->bodies[b].name);
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateDisplacements(MPI_Comm comm, const char file[], Scene scene)
{
  PetscBool same;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *here = &scene->displacements[d];

    if (!SceneIsWholeBody(here->face) && here->at == DISPLACEMENT_FACE)
      PetscCall(SceneValidateFace(comm, file, scene, "displacement", here->name, here->face));
    SceneRequire(here->inclined || SceneIsWholeBody(here->face) || here->fixed[0] || here->fixed[1] || here->fixed[2],
      "%s: displacement \"%s\" prescribes nothing on the face \"%s\"; if the name of a symmetry face does not "
      "determine its normal, write - cut: {face: %s, normal: x}",
      file, here->name, here->face, here->face);
    PetscCall(SceneValidateRigidMass(comm, file, scene, here));
    for (PetscInt e = 0; e < d; ++e) {
      const SceneDisplacement *other = &scene->displacements[e];

      PetscCall(PetscStrcmp(here->face, other->face, &same));
      if (same && (here->moves || other->moves)) PetscCall(SceneValidateMotions(comm, file, other, here));
      else
        for (PetscInt i = 0; i < 3; ++i)
          SceneRequire(!same || !here->fixed[i] || !other->fixed[i],
            "%s: displacements \"%s\" and \"%s\" both prescribe %c on the face \"%s\"", file, other->name, here->name,
            "xyz"[i], here -> face);
    }
  }
  PetscFunctionReturn(0);
}

/* A rigid surface has no volume; the cells that show it have one */
static PetscErrorCode SceneValidateBodyForces(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt f = 0; f < scene->nforces; ++f) {
    const SceneBodyForce *force = &scene->forces[f];

    SceneRequire(force->body < 0 || !SceneBodyIsSurface(&scene->bodies[force->body]),
      "%s: body force \"%s\" acts on the body \"%s\", which is a rigid surface and has no volume: list its weight "
      "under forces",
      file, force->name, scene->bodies[force->body].name);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidatePressures(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npressures; ++p) {
    const ScenePressure *pressure = &scene->pressures[p];
    const char          *face     = NULL;

    PetscCall(SceneValidateFace(comm, file, scene, "pressure", pressure->name, pressure->face));
    SceneRequire(!pressure->follows ||
                   MaterialIsFinite(&scene->bodies[SceneFindBody(scene, pressure->face, &face)].material),
      "%s: pressure \"%s\" follows the face \"%s\" of a body of small strain, whose normals do not turn: use a law of "
      "finite strain, for example neohookean, or a pressure that does not follow",
      file, pressure->name, pressure->face);
    SceneRequire(!pressure->follows || scene->model == MODEL_ENERGY,
      "%s: pressure \"%s\" follows its face, which model quadratic does not support; use model energy", file,
      pressure->name);
    SceneRequire(!pressure->follows || !SceneIsDynamic(scene) || scene->dynamics.scheme != SCHEME_IMPACT,
      "%s: pressure \"%s\" follows its face, which scheme impact of dynamics does not support; use generalized_alpha",
      file, pressure->name);
  }
  for (PetscInt t = 0; t < scene->ntractions; ++t) {
    if (!SceneIsWholeBody(scene->tractions[t].face))
      PetscCall(SceneValidateFace(comm, file, scene, scene->tractions[t].resultant ? "force" : "traction",
        scene->tractions[t].name, scene->tractions[t].face));
  }
  PetscFunctionReturn(0);
}

/*
   Checks that a contact pair, or a rule for contact pairs, is not combined with other features of the scene that do not
   support it.
*/
static PetscErrorCode SceneValidatePairEffects(MPI_Comm comm, const char file[], Scene scene,
  const SceneContactPair *here)
{
  PetscFunctionBegin;
  SceneRequire(!SceneContactPairHasFriction(here) || !scene->displacement_bounds,
    "%s: contact pair \"%s\" has friction, which cannot be combined with displacement_bounds: remove them", file,
    here->name);
  for (PetscInt q = 0; q < scene->npressures; ++q)
    SceneRequire(!SceneContactPairHasFriction(here) || !scene->pressures[q].follows,
      "%s: contact pair \"%s\" has friction, and pressure \"%s\" follows its face: the repeated solves that find the "
      "load of such a pressure do not always converge with friction; use a pressure that does not follow, or no "
      "friction",
      file, here->name, scene->pressures[q].name);
  SceneRequire(!SceneIsDynamic(scene) || scene->dynamics.scheme != SCHEME_GENERALIZED_ALPHA ||
                 (scene->dynamics.mass == MASS_REDISTRIBUTED && !SceneContactPairHasFriction(here)),
    "%s: contact pair \"%s\" has nodes with mass (mass lumped or consistent, or friction), for which scheme "
    "generalized_alpha of dynamics adds energy at an impact; use scheme impact",
    file, here->name);
  PetscFunctionReturn(0);
}

/*
   Checks that damping by stiffness is used only if the stiffness is constant, since the damping matrix is a multiple of
   it, and that damping of connectors is used only in dynamics.
*/
static PetscErrorCode SceneValidateDamping(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < scene->nconnectors; ++c)
    SceneRequire(scene->connectors[c].damping == 0.0 || SceneIsDynamic(scene),
      "%s: connector \"%s\" has damping, but the scene has no dynamics, so that there are no velocities", file,
      scene->connectors[c].name);
  if (scene->dynamics.damping_stiffness == 0.0) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const MaterialLaw *law;

    PetscCall(MaterialGetLaw(&scene->bodies[b].material, &law));
    SceneRequire(law->constant || scene->bodies[b].material.type == MATERIAL_RIGID,
      "%s: dynamics has damping_stiffness = %g, and body \"%s\" is of law %s: it requires law linear or orthotropic; "
      "use damping_mass",
      file, (double)scene->dynamics.damping_stiffness, scene->bodies[b].name,
      MaterialTypes[scene->bodies[b].material.type]);
  }
  SceneRequire(!scene->nsprings && !scene->nconnectors && scene->weak_springs == 0.0 && !scene->ntemperatures,
    "%s: dynamics has damping_stiffness = %g, which cannot be combined with springs, connectors, weak_springs or "
    "temperatures; use damping_mass",
    file, (double)scene->dynamics.damping_stiffness);
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateContact(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *here = &scene->pairs[p];
    PetscBool               same, straight[2], crossed[2];

    if (here->self) PetscCall(SceneValidateSelf(comm, file, scene, here));
    else {
      PetscCall(SceneValidateFace(comm, file, scene, "contact pair", here->name, here->mortar));
      PetscCall(SceneValidateFace(comm, file, scene, "contact pair", here->name, here->nonmortar));
    }
    PetscCall(SceneValidatePairEffects(comm, file, scene, here));
    PetscCall(PetscStrcmp(here->mortar, here->nonmortar, &same));
    SceneRequire(!same || here->self,
      "%s: contact pair \"%s\" has the same face \"%s\" on both sides: contact of a face with itself is written "
      "self: %s",
      file, here->name, here->mortar, here->mortar);
    for (PetscInt q = 0; q < p; ++q) {
      const SceneContactPair *other = &scene->pairs[q];

      PetscCall(PetscStrcmp(here->mortar, other->mortar, &straight[0]));
      PetscCall(PetscStrcmp(here->nonmortar, other->nonmortar, &straight[1]));
      PetscCall(PetscStrcmp(here->mortar, other->nonmortar, &crossed[0]));
      PetscCall(PetscStrcmp(here->nonmortar, other->mortar, &crossed[1]));
      SceneRequire(!(straight[0] && straight[1]) && !(crossed[0] && crossed[1]),
        "%s: contact pairs \"%s\" and \"%s\" join the same two faces", file, other->name, here->name);
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidate(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  SceneRequire(scene->refine >= 0, "%s: refine = %" PetscInt_FMT ", which must be at least 0", file, scene->refine);
  SceneRequire(!scene->displacement_bounds ||
                 (scene->displacement_bounds >= 2 && scene->displacement_bounds <= scene->nsteps),
    "%s: displacement_bounds = %" PetscInt_FMT "; it is 0 for none, or the first bounded load step, at least 2 (the "
    "largest increment before it is the bound) and at most the last, %" PetscInt_FMT,
    file, scene->displacement_bounds, scene->nsteps);
  SceneRequire(scene->contact_updates >= 1, "%s: contact_updates = %" PetscInt_FMT ", which must be at least 1", file,
    scene->contact_updates);
  PetscCall(SceneValidateBodies(comm, file, scene));
  PetscCall(SceneValidateDisplacements(comm, file, scene));
  PetscCall(SceneValidateRigid(comm, file, scene));
  PetscCall(SceneValidateBodyForces(comm, file, scene));
  PetscCall(SceneValidatePressures(comm, file, scene));
  PetscCall(SceneValidateSprings(comm, file, scene));
  PetscCall(SceneValidateBolts(comm, file, scene));
  PetscCall(SceneValidateTemperatures(comm, file, scene));
  PetscCall(SceneValidateDamping(comm, file, scene));
  PetscCall(SceneValidateContact(comm, file, scene));
  PetscCall(SceneValidateRules(comm, file, scene));
  for (PetscInt r = 0; r < scene->nrules; ++r) PetscCall(SceneValidatePairEffects(comm, file, scene, &scene->rules[r]));
  PetscCall(SceneValidateTies(comm, file, scene));
  PetscCall(SceneValidateRefinements(comm, file, scene));
  PetscFunctionReturn(0);
}
