/* Effects of a scene: which are active, why, and what they cost */
#include "runimpl.h"
#include <math.h>
#include "src/state/results.h"

/* The largest number of effects */
#define EFFECTS_MAX 32

static PetscErrorCode EffectSet(RunReport *, const char name[], PetscBool on, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);

/* Returns the effect of a name; if there is none, the place behind the last effect */
static RunEffect *EffectFind(RunReport *report, const char name[])
{
  PetscInt i = 0;

  while (i < report->neffects && strcmp(report->effects[i].name, name)) ++i;
  return &report->effects[i];
}

/* Sets an effect, which is added if it is new. format: text of the reason. */
static PetscErrorCode EffectSet(RunReport *report, const char name[], PetscBool on, const char format[], ...)
{
  RunEffect *effect = EffectFind(report, name);
  va_list    args;

  PetscFunctionBegin;
  if (effect == report->effects + report->neffects) ++report->neffects;
  effect->name = name;
  effect->on   = on;
  effect->time = NAN;
  va_start(args, format);
  PetscCall(PetscVSNPrintf(effect->why, sizeof(effect->why), format, NULL, args));
  va_end(args);
  PetscFunctionReturn(0);
}

PetscErrorCode EffectsCreate(Simulation sim, RunReport *report)
{
  Scene        scene  = sim->scene;
  PetscInt     finite = 0, planes = 0, rubbing = 0, plastic = 0, rigid = 0, mean = 0, modes = 0, second = 0, *nnodes;
  ElementType *elements;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &nnodes, scene->nbodies, &elements));
  PetscCall(MeshGetBodyNodes(sim->dm, scene->nbodies, nnodes));
  PetscCall(SceneChooseElements(scene, sim->dm, elements, NULL));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (MaterialIsFinite(&scene->bodies[b].material)) ++finite;
    if (MaterialYields(&scene->bodies[b].material)) ++plastic;
    if (scene->bodies[b].material.type == MATERIAL_RIGID) ++rigid;
    if (elements[b] == ELEMENT_BBAR) ++mean;
    if (elements[b] == ELEMENT_INCOMPATIBLE) ++modes;
    if (MeshOrder(nnodes[b]) > 1) ++second;
  }
  PetscCall(PetscFree2(nnodes, elements));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) planes += scene->displacements[d].inclined;
  PetscCall(PetscCalloc1(EFFECTS_MAX, &report->effects));
  for (PetscInt p = 0; p < scene->npairs; ++p) rubbing += SceneContactPairHasFriction(&scene->pairs[p]);
  PetscCall(
    EffectSet(report, "contact", (PetscBool)(scene->npairs > 0), "%" PetscInt_FMT " contact pairs", scene->npairs));
  PetscCall(EffectSet(report, "contact updates", (PetscBool)(scene->npairs && scene->contact_updates > 1),
    "contact_updates is %" PetscInt_FMT, scene->contact_updates));
  PetscCall(EffectSet(report, "friction", (PetscBool)(rubbing > 0),
    "%" PetscInt_FMT " contact pairs with friction, shear_limit or stick", rubbing));
  PetscCall(EffectSet(report, "AMG filter", (PetscBool)(scene->npairs > 0),
    scene->npairs ? "contact constraints are stiff" : "no contact, nothing to filter"));
  PetscCall(EffectSet(report, "finite strain", (PetscBool)(finite > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies with a law of finite strain%s", finite, scene->nbodies,
    !finite          ? ""
    : sim->quadratic ? ", one tangent per load step"
                     : ", true energy"));
  PetscCall(EffectSet(report, "plasticity", (PetscBool)(plastic > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies with a law of plasticity", plastic, scene->nbodies));
  PetscCall(EffectSet(report, "rigid bodies", (PetscBool)(rigid > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies of material rigid", rigid, scene->nbodies));
  PetscCall(EffectSet(report, "mean dilatation", (PetscBool)(mean > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies with element bbar", mean, scene->nbodies));
  PetscCall(EffectSet(report, "incompatible modes", (PetscBool)(modes > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies with element incompatible", modes, scene->nbodies));
  PetscCall(EffectSet(report, "order 2", (PetscBool)(second > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies of order 2", second, scene->nbodies));
  PetscCall(EffectSet(report, "pressure", (PetscBool)(scene->npressures > 0), "%" PetscInt_FMT " pressures",
    scene->npressures));
  PetscCall(EffectSet(report, "traction", (PetscBool)(scene->ntractions > 0),
    "%" PetscInt_FMT " tractions and forces on faces", scene->ntractions));
  PetscCall(
    EffectSet(report, "body force", (PetscBool)(scene->nforces > 0), "%" PetscInt_FMT " body forces", scene->nforces));
  if (SceneIsDynamic(scene))
    PetscCall(
      EffectSet(report, "inertia", PETSC_TRUE, "%" PetscInt_FMT " time steps of %g, scheme %s, mass %s", scene->nsteps,
        (double)scene->dynamics.time_step, DynamicsSchemes[scene->dynamics.scheme], MassTypes[scene->dynamics.mass]));
  else PetscCall(EffectSet(report, "inertia", PETSC_FALSE, "no dynamics: a static analysis"));
  PetscCall(EffectSet(report, "springs", (PetscBool)(scene->nsprings + scene->nconnectors > 0),
    "%" PetscInt_FMT " springs on faces, %" PetscInt_FMT " between points", scene->nsprings, scene->nconnectors));
  PetscCall(EffectSet(report, "pretension", (PetscBool)(scene->nbolts > 0), "%" PetscInt_FMT " bolts", scene->nbolts));
  PetscCall(EffectSet(report, "weak springs", (PetscBool)(scene->weak_springs > 0.0),
    scene->weak_springs ? "they hold %" PetscInt_FMT " bodies without supports" : "weak_springs is not set",
    sim->springs.nweak));
  PetscCall(EffectSet(report, "thermal strain", (PetscBool)(scene->ntemperatures > 0), "%" PetscInt_FMT " temperatures",
    scene->ntemperatures));
  PetscCall(EffectSet(report, "ties", (PetscBool)(scene->nties + scene->ncyclic > 0),
    "%" PetscInt_FMT " ties, %" PetscInt_FMT " cyclic symmetries", scene->nties, scene->ncyclic));
  PetscCall(EffectSet(report, "inclined symmetry", (PetscBool)(planes > 0),
    "%" PetscInt_FMT " symmetry planes that are not normal to an axis", planes));
  if (scene->displacement_bounds)
    PetscCall(EffectSet(report, "displacement bounds", PETSC_TRUE, "from load step %" PetscInt_FMT,
      scene->displacement_bounds));
  else PetscCall(EffectSet(report, "displacement bounds", PETSC_FALSE, "displacement_bounds is not set"));
  PetscCall(EffectSet(report, "error estimate", sim->results->estimate,
    sim->results->estimate ? "stress recovery at the end of every load step" : "-error_estimate is 0"));
  PetscCall(EffectSet(report, "probes and fields",
    (PetscBool)(sim->results->probes.n || sim->results->nodes || sim->results->points),
    "%" PetscInt_FMT " points of probes; %sstress at nodes, %sat quadrature points", sim->results->probes.n,
    sim->results->nodes ? "" : "no ", sim->results->points ? "" : "not "));
  PetscFunctionReturn(0);
}

/* Sets the times of the effects. Whether the filter was used is known only after the solve. */
PetscErrorCode EffectsSetTimes(Simulation sim, RunReport *report)
{
  PetscInt systems = 0, filtered = 0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    systems += report->steps[s].systems;
    filtered += report->steps[s].filtered_systems;
  }
  if (sim->contact && !systems && report->nsteps)
    PetscCall(EffectSet(report, "AMG filter", PETSC_FALSE,
      "not needed: the subspace method solves the contact constraints separately"));
  if (sim->contact && systems)
    PetscCall(EffectSet(report, "AMG filter", (PetscBool)(filtered > 0),
      "constraints stiff enough in %" PetscInt_FMT " of %" PetscInt_FMT " systems", filtered, systems));
  EffectFind(report, "contact")->time           = report->time.contact;
  EffectFind(report, "AMG filter")->time        = report->time.filter_setup + report->time.filter_apply;
  EffectFind(report, "error estimate")->time    = report->time.error_estimate;
  EffectFind(report, "probes and fields")->time = report->time.results;
  if (EffectFind(report, "plasticity")->on) EffectFind(report, "plasticity")->time = report->time.assembly;
  if (EffectFind(report, "finite strain")->on) EffectFind(report, "finite strain")->time = report->time.assembly;
  PetscFunctionReturn(0);
}
