/* Checks a scene beyond its syntax. Every rank has the same scene, so that every rank finds the same error. */
#include "sceneimpl.h"
#include <mesh.h>

/* Checks a key that belongs to no entry */
#define SceneRequireKey(cond, key, message, ...) \
  PetscCheck(cond, comm, PETSC_ERR_USER_INPUT, "%s" message, SceneGetPlace(&scene->places, key), __VA_ARGS__)

static PetscErrorCode SceneValidateBodies(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];

    for (PetscInt i = 0; i < 3 && body->shape == SHAPE_BOX; ++i) {
      SceneRequire(body->lower[i] < body->upper[i], body,
        "body \"%s\" is a negative box: lower %c = %g is not below upper %c = %g", body->name, "xyz"[i],
        (double)body -> lower[i], "xyz"[i], (double)body -> upper[i]);
      SceneRequire(body->cells[i] >= 1, body, "body \"%s\" has %" PetscInt_FMT " cells along %c, it needs at least 1",
        body->name, body->cells[i], "xyz"[i]);
    }
    PetscCall(MeshCheckBody(comm, body));
    PetscCall(SceneValidateConstants(comm, body));
    SceneRequire(body->order >= 0 && body->order <= 2, body,
      "body \"%s\" has order = %" PetscInt_FMT ", which must be 1 or 2", body->name, body->order);
    SceneRequire(body->element != ELEMENT_INCOMPATIBLE || body->order < 2, body,
      "body \"%s\" has element incompatible with order 2; incompatible modes are only for cells of order 1; use "
      "element full or bbar",
      body->name);
    SceneRequire(body->element != ELEMENT_INCOMPATIBLE || !MaterialIsFinite(&body->material), body,
      "body \"%s\" has element incompatible with material %s; at finite strain incompatible modes are unstable "
      "under compression; use element full or bbar",
      body->name, MaterialTypes[body->material.type]);
    SceneRequire(scene->model != MODEL_QUADRATIC || !MaterialYields(&body->material), body,
      "body \"%s\" has material %s with model quadratic, whose single tangent does not follow the yield surface; "
      "use model energy",
      body->name, MaterialTypes[body->material.type]);
    SceneRequire(body->element != ELEMENT_BBAR || body->material.type != MATERIAL_SAINT_VENANT, body,
      "body \"%s\" has element bbar with material saint_venant, whose dilatation tr E is not the change of volume "
      "that bbar averages; use material neohookean near incompressibility, or element full",
      body->name);
  }
  PetscFunctionReturn(0);
}

/*
   Checks the mass of a rigid body. In a dynamic analysis a rigid body needs mass if some of its motions are not
   prescribed.
*/
static PetscErrorCode SceneValidateRigidMass(MPI_Comm comm, Scene scene, const SceneDisplacement *d)
{
  const char *face;
  PetscInt    b;

  PetscFunctionBegin;
  if (!SceneIsDynamic(scene) || !SceneFreesMotion(d)) PetscFunctionReturn(0);
  b = SceneFindBody(scene, d->face, &face);
  SceneRequire(!SceneBodyIsSurface(&scene->bodies[b]) || scene->bodies[b].own[SURFACE_MASS] > 0, d,
    "displacement \"%s\" leaves motions of the body \"%s\" free, which is a rigid surface and needs the key mass "
    "in dynamics",
    d->name, scene->bodies[b].name);
  SceneRequire(SceneBodyIsSurface(&scene->bodies[b]) || scene->bodies[b].material.density > 0, d,
    "displacement \"%s\" leaves motions of the rigid body \"%s\" free, which needs a density in dynamics", d->name,
    scene->bodies[b].name);
  PetscFunctionReturn(0);
}

/* Returns the name that the scene gives to a displacement: that of the face if a symmetry plane has no name */
static char *DisplacementName(const SceneDisplacement *d)
{
  return d->unnamed ? d->face : d->name;
}

/* Checks one displacement */
static PetscErrorCode SceneValidateDisplacement(MPI_Comm comm, Scene scene, const SceneDisplacement *d)
{
  const char      *what = d->symmetry ? "symmetry plane" : "displacement";
  const SceneEntry said = {.name = DisplacementName(d), .place = d->place};

  PetscFunctionBegin;
  if (!SceneIsWholeBody(d->face) && d->at == DISPLACEMENT_FACE)
    PetscCall(SceneValidateFace(comm, scene, what, &said, d->face));
  SceneRequire(d->inclined || SceneIsWholeBody(d->face) || d->fixed[0] || d->fixed[1] || d->fixed[2], d,
    "%s \"%s\" prescribes nothing on the face \"%s\"; if the name of a symmetry face does not determine its normal, "
    "write - cut: {face: %s, normal: x}",
    what, said.name, d->face, d->face);
  PetscCall(SceneValidateRigidMass(comm, scene, d));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateDisplacements(MPI_Comm comm, Scene scene)
{
  PetscBool same;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *here = &scene->displacements[d];

    PetscCall(SceneValidateDisplacement(comm, scene, here));
    for (PetscInt e = 0; e < d; ++e) {
      const SceneDisplacement *other = &scene->displacements[e];

      PetscCall(PetscStrcmp(here->face, other->face, &same));
      if (same && (here->moves || other->moves)) PetscCall(SceneValidateMotions(comm, other, here));
      else
        for (PetscInt i = 0; i < 3; ++i)
          SceneRequire(!same || !here->fixed[i] || !other->fixed[i], other,
            "displacements \"%s\" and \"%s\" both prescribe %c on the face \"%s\"", DisplacementName(other),
            DisplacementName(here), "xyz"[i], here -> face);
    }
  }
  PetscFunctionReturn(0);
}

/* A rigid surface has no volume; the cells that show it have one */
static PetscErrorCode SceneValidateBodyForces(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt f = 0; f < scene->nforces; ++f) {
    const SceneBodyForce *force = &scene->forces[f];

    SceneRequire(force->body < 0 || !SceneBodyIsSurface(&scene->bodies[force->body]), force,
      "body force \"%s\" acts on the body \"%s\", which is a rigid surface and has no volume: list its weight "
      "under forces",
      force->name, scene->bodies[force->body].name);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidatePressures(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npressures; ++p) {
    const ScenePressure *pressure = &scene->pressures[p];
    const char          *face     = NULL;

    PetscCall(SceneValidateFace(comm, scene, "pressure", pressure, pressure->face));
    SceneRequire(!pressure->follows ||
                   MaterialIsFinite(&scene->bodies[SceneFindBody(scene, pressure->face, &face)].material),
      pressure,
      "pressure \"%s\" follows the face \"%s\" of a body of small strain, whose normals do not turn: use a law of "
      "finite strain, for example neohookean, or a pressure that does not follow",
      pressure->name, pressure->face);
    SceneRequire(!pressure->follows || scene->model == MODEL_ENERGY, pressure,
      "pressure \"%s\" follows its face, which model quadratic does not support; use model energy", pressure->name);
    SceneRequire(!pressure->follows || !SceneIsDynamic(scene) || scene->dynamics.scheme != SCHEME_IMPACT, pressure,
      "pressure \"%s\" follows its face, which scheme impact of dynamics does not support; use generalized_alpha",
      pressure->name);
  }
  for (PetscInt t = 0; t < scene->ntractions; ++t) {
    if (scene->tractions[t].body < 0)
      PetscCall(SceneValidateFace(comm, scene, scene->tractions[t].resultant ? "force" : "traction",
        &scene->tractions[t], scene->tractions[t].face));
  }
  PetscFunctionReturn(0);
}

/*
   Checks that a contact pair, or a rule for contact pairs, is not combined with other features of the scene that do not
   support it.
*/
static PetscErrorCode SceneValidatePairEffects(MPI_Comm comm, Scene scene, const SceneContactPair *here)
{
  PetscFunctionBegin;
  SceneRequire(!SceneContactPairHasFriction(here) || !scene->displacement_bounds, here,
    "contact pair \"%s\" has friction, which cannot be combined with displacement_bounds: remove them", here->name);
  SceneRequire(!(here->exponential[1] > 0.0) || here->stiffness == 0.0, here,
    "contact pair \"%s\" has both contact_exponential and contact_stiffness", here->name);
  SceneRequire(!(here->exponential[1] > 0.0) || scene->contact_updates > 1, here,
    "contact pair \"%s\" has contact_exponential, whose pressure needs more than one contact update", here->name);
  for (PetscInt q = 0; q < scene->npressures; ++q)
    SceneRequire(!SceneContactPairHasFriction(here) || !scene->pressures[q].follows, here,
      "contact pair \"%s\" has friction, and pressure \"%s\" follows its face: the repeated solves that find the "
      "load of such a pressure do not always converge with friction; use a pressure that does not follow, or no "
      "friction",
      here->name, scene->pressures[q].name);
  SceneRequire(!SceneIsDynamic(scene) || scene->dynamics.scheme != SCHEME_GENERALIZED_ALPHA ||
                 SceneContactPairIsSoft(here) ||
                 (scene->dynamics.mass == MASS_REDISTRIBUTED && !SceneContactPairHasFriction(here)),
    here,
    "contact pair \"%s\" has nodes with mass (mass lumped or consistent, or friction), for which scheme "
    "generalized_alpha of dynamics adds energy at an impact; use scheme impact",
    here->name);
  PetscFunctionReturn(0);
}

/*
   Checks that damping by stiffness is used only if the stiffness is constant, since the damping matrix is a multiple of
   it, and that damping of connectors is used only in dynamics.
*/
static PetscErrorCode SceneValidateDamping(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < scene->nconnectors; ++c)
    SceneRequire(scene->connectors[c].damping == 0.0 || SceneIsDynamic(scene), &scene->connectors[c],
      "connector \"%s\" has damping, but the scene has no dynamics, so that there are no velocities",
      scene->connectors[c].name);
  if (scene->dynamics.damping_stiffness == 0.0) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const MaterialLaw *law;

    PetscCall(MaterialGetLaw(&scene->bodies[b].material, &law));
    SceneRequireKey(law->constant || scene->bodies[b].material.type == MATERIAL_RIGID, "dynamics_damping_stiffness",
      "dynamics has damping_stiffness = %g, and body \"%s\" is of law %s: it requires law linear or orthotropic; "
      "use damping_mass",
      (double)scene->dynamics.damping_stiffness, scene->bodies[b].name, MaterialTypes[scene->bodies[b].material.type]);
  }
  SceneRequireKey(!scene->nsprings && !scene->nconnectors && scene->weak_springs == 0.0 && !scene->ntemperatures,
    "dynamics_damping_stiffness",
    "dynamics has damping_stiffness = %g, which cannot be combined with springs, connectors, weak_springs or "
    "temperatures; use damping_mass",
    (double)scene->dynamics.damping_stiffness);
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateContact(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *here = &scene->pairs[p];
    PetscBool               same, straight[2], crossed[2];

    if (here->self) PetscCall(SceneValidateSelf(comm, scene, here));
    else {
      PetscCall(SceneValidateFace(comm, scene, "contact pair", here, here->mortar));
      PetscCall(SceneValidateFace(comm, scene, "contact pair", here, here->nonmortar));
    }
    PetscCall(SceneValidatePairEffects(comm, scene, here));
    PetscCall(PetscStrcmp(here->mortar, here->nonmortar, &same));
    SceneRequire(!same || here->self, here,
      "contact pair \"%s\" has the same face \"%s\" on both sides: contact of a face with itself is written "
      "self: %s",
      here->name, here->mortar, here->mortar);
    for (PetscInt q = 0; q < p; ++q) {
      const SceneContactPair *other = &scene->pairs[q];

      PetscCall(PetscStrcmp(here->mortar, other->mortar, &straight[0]));
      PetscCall(PetscStrcmp(here->nonmortar, other->nonmortar, &straight[1]));
      PetscCall(PetscStrcmp(here->mortar, other->nonmortar, &crossed[0]));
      PetscCall(PetscStrcmp(here->nonmortar, other->mortar, &crossed[1]));
      SceneRequire(!(straight[0] && straight[1]) && !(crossed[0] && crossed[1]), other,
        "contact pairs \"%s\" and \"%s\" join the same two faces", other->name, here->name);
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidate(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  SceneRequireKey(scene->refine >= 0, "refine", "refine = %" PetscInt_FMT ", which must be at least 0", scene->refine);
  SceneRequireKey(!scene->displacement_bounds ||
                    (scene->displacement_bounds >= 2 && scene->displacement_bounds <= scene->nsteps),
    "displacement_bounds",
    "displacement_bounds = %" PetscInt_FMT "; it is 0 for none, or the first bounded load step, at least 2 (the "
    "largest increment before it is the bound) and at most the last, %" PetscInt_FMT,
    scene->displacement_bounds, scene->nsteps);
  SceneRequireKey(scene->contact_updates >= 1, "contact_updates",
    "contact_updates = %" PetscInt_FMT ", which must be at least 1", scene->contact_updates);
  PetscCall(SceneValidateBodies(comm, scene));
  PetscCall(SceneValidateDisplacements(comm, scene));
  PetscCall(SceneValidateRigid(comm, scene));
  PetscCall(SceneValidateBodyForces(comm, scene));
  PetscCall(SceneValidatePressures(comm, scene));
  PetscCall(SceneValidateSprings(comm, scene));
  PetscCall(SceneValidateEquations(comm, scene));
  PetscCall(SceneValidateBolts(comm, scene));
  PetscCall(SceneValidateTemperatures(comm, scene));
  PetscCall(SceneValidateDamping(comm, scene));
  PetscCall(SceneValidateContact(comm, scene));
  PetscCall(SceneValidateRules(comm, scene));
  for (PetscInt r = 0; r < scene->nrules; ++r) PetscCall(SceneValidatePairEffects(comm, scene, &scene->rules[r]));
  PetscCall(SceneValidateTies(comm, scene));
  PetscCall(SceneValidateRefinements(comm, scene));
  PetscFunctionReturn(0);
}
