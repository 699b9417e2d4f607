/* Effects of a scene: which are active, why, and what they cost */
#include "runimpl.h"
#include <math.h>
#include "src/state/results.h"

typedef enum {
  EFFECT_CONTACT,
  EFFECT_UPDATES,
  EFFECT_FRICTION,
  EFFECT_FILTER,
  EFFECT_FINITE_STRAIN,
  EFFECT_PLASTICITY,
  EFFECT_RIGID,
  EFFECT_BBAR,
  EFFECT_INCOMPATIBLE,
  EFFECT_ORDER2,
  EFFECT_PRESSURE,
  EFFECT_TRACTION,
  EFFECT_BODY_FORCE,
  EFFECT_INERTIA,
  EFFECT_SPRINGS,
  EFFECT_BOLTS,
  EFFECT_WEAK_SPRINGS,
  EFFECT_TEMPERATURE,
  EFFECT_TIES,
  EFFECT_PLANES,
  EFFECT_BOUNDS,
  EFFECT_ESTIMATE,
  EFFECT_RESULTS,
  EFFECT_COUNT
} EffectType;

static const char *const EffectNames[] = {
  [EFFECT_CONTACT]       = "contact",
  [EFFECT_UPDATES]       = "contact updates",
  [EFFECT_FRICTION]      = "friction",
  [EFFECT_FILTER]        = "AMG filter",
  [EFFECT_FINITE_STRAIN] = "finite strain",
  [EFFECT_PLASTICITY]    = "plasticity",
  [EFFECT_RIGID]         = "rigid bodies",
  [EFFECT_BBAR]          = "mean dilatation",
  [EFFECT_INCOMPATIBLE]  = "incompatible modes",
  [EFFECT_ORDER2]        = "order 2",
  [EFFECT_PRESSURE]      = "pressure",
  [EFFECT_TRACTION]      = "traction",
  [EFFECT_BODY_FORCE]    = "body force",
  [EFFECT_INERTIA]       = "inertia",
  [EFFECT_SPRINGS]       = "springs",
  [EFFECT_BOLTS]         = "pretension",
  [EFFECT_WEAK_SPRINGS]  = "weak springs",
  [EFFECT_TEMPERATURE]   = "thermal strain",
  [EFFECT_TIES]          = "ties",
  [EFFECT_PLANES]        = "inclined symmetry",
  [EFFECT_BOUNDS]        = "displacement bounds",
  [EFFECT_ESTIMATE]      = "error estimate",
  [EFFECT_RESULTS]       = "probes and fields",
};

static PetscErrorCode EffectSet(RunReport *report, EffectType type, PetscBool on, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);

static PetscErrorCode EffectSet(RunReport *report, EffectType type, PetscBool on, const char format[], ...)
{
  RunEffect *effect = &report->effects[type];
  va_list    args;

  PetscFunctionBegin;
  effect->name = EffectNames[type];
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
  report->neffects = EFFECT_COUNT;
  PetscCall(PetscCalloc1(EFFECT_COUNT, &report->effects));
  PetscCall(EffectSet(report, EFFECT_CONTACT, (PetscBool)(scene->npairs > 0), "%" PetscInt_FMT " contact pairs",
    scene->npairs));
  for (PetscInt p = 0; p < scene->npairs; ++p) rubbing += SceneContactPairHasFriction(&scene->pairs[p]);
  PetscCall(EffectSet(report, EFFECT_FRICTION, (PetscBool)(rubbing > 0),
    "%" PetscInt_FMT " contact pairs with friction, shear_limit or stick", rubbing));
  PetscCall(EffectSet(report, EFFECT_UPDATES, (PetscBool)(scene->npairs && scene->contact_updates > 1),
    "contact_updates is %" PetscInt_FMT, scene->contact_updates));
  PetscCall(EffectSet(report, EFFECT_FILTER, (PetscBool)(scene->npairs > 0),
    scene->npairs ? "contact makes stiff rows" : "no contact, nothing to filter"));
  PetscCall(EffectSet(report, EFFECT_FINITE_STRAIN, (PetscBool)(finite > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies of a law of finite strain%s", finite, scene->nbodies,
    !finite          ? ""
    : sim->quadratic ? ", one tangent a load step"
                     : ", true energy"));
  PetscCall(EffectSet(report, EFFECT_PLASTICITY, (PetscBool)(plastic > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies of a law that yields", plastic, scene->nbodies));
  PetscCall(EffectSet(report, EFFECT_RIGID, (PetscBool)(rigid > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies of material rigid", rigid, scene->nbodies));
  PetscCall(EffectSet(report, EFFECT_BBAR, (PetscBool)(mean > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies with element bbar", mean, scene->nbodies));
  PetscCall(EffectSet(report, EFFECT_INCOMPATIBLE, (PetscBool)(modes > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies with element incompatible", modes, scene->nbodies));
  PetscCall(EffectSet(report, EFFECT_ORDER2, (PetscBool)(second > 0),
    "%" PetscInt_FMT " of %" PetscInt_FMT " bodies of order 2", second, scene->nbodies));
  PetscCall(EffectSet(report, EFFECT_PRESSURE, (PetscBool)(scene->npressures > 0), "%" PetscInt_FMT " pressures",
    scene->npressures));
  PetscCall(EffectSet(report, EFFECT_TRACTION, (PetscBool)(scene->ntractions > 0),
    "%" PetscInt_FMT " tractions and forces on faces", scene->ntractions));
  PetscCall(EffectSet(report, EFFECT_SPRINGS, (PetscBool)(scene->nsprings + scene->nconnectors > 0),
    "%" PetscInt_FMT " springs on faces, %" PetscInt_FMT " between points", scene->nsprings, scene->nconnectors));
  PetscCall(EffectSet(report, EFFECT_BOLTS, (PetscBool)(scene->nbolts > 0), "%" PetscInt_FMT " bolts", scene->nbolts));
  PetscCall(EffectSet(report, EFFECT_WEAK_SPRINGS, (PetscBool)(scene->weak_springs > 0.0),
    scene->weak_springs ? "they hold %" PetscInt_FMT " bodies that move freely" : "weak_springs is not set",
    sim->springs.nweak));
  PetscCall(EffectSet(report, EFFECT_TEMPERATURE, (PetscBool)(scene->ntemperatures > 0),
    "%" PetscInt_FMT " temperatures", scene->ntemperatures));
  PetscCall(EffectSet(report, EFFECT_TIES, (PetscBool)(scene->nties + scene->ncyclic > 0),
    "%" PetscInt_FMT " ties, %" PetscInt_FMT " cuts of sectors", scene->nties, scene->ncyclic));
  PetscCall(EffectSet(report, EFFECT_PLANES, (PetscBool)(planes > 0), "%" PetscInt_FMT " symmetry planes along no axis",
    planes));
  PetscCall(EffectSet(report, EFFECT_BODY_FORCE, (PetscBool)(scene->nforces > 0), "%" PetscInt_FMT " body forces",
    scene->nforces));
  if (SceneIsDynamic(scene))
    PetscCall(EffectSet(report, EFFECT_INERTIA, PETSC_TRUE, "%" PetscInt_FMT " time steps of %g, scheme %s, mass %s",
      scene->nsteps, (double)scene->dynamics.time_step, DynamicsSchemes[scene->dynamics.scheme],
      MassTypes[scene->dynamics.mass]));
  else PetscCall(EffectSet(report, EFFECT_INERTIA, PETSC_FALSE, "no dynamics: a static analysis"));
  if (scene->displacement_bounds)
    PetscCall(
      EffectSet(report, EFFECT_BOUNDS, PETSC_TRUE, "from load step %" PetscInt_FMT, scene->displacement_bounds));
  else PetscCall(EffectSet(report, EFFECT_BOUNDS, PETSC_FALSE, "displacement_bounds is not set"));
  PetscCall(EffectSet(report, EFFECT_RESULTS,
    (PetscBool)(sim->results->probes.n || sim->results->nodes || sim->results->points),
    "%" PetscInt_FMT " points of probes; %sstress at nodes, %sat quadrature points", sim->results->probes.n,
    sim->results->nodes ? "" : "no ", sim->results->points ? "" : "not "));
  PetscCall(EffectSet(report, EFFECT_ESTIMATE, sim->results->estimate,
    sim->results->estimate ? "stress recovery at the end of every load step" : "-error_estimate is 0"));
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
    PetscCall(EffectSet(report, EFFECT_FILTER, PETSC_FALSE, "no system holds constraints: they are solved beside it"));
  if (sim->contact && systems)
    PetscCall(EffectSet(report, EFFECT_FILTER, (PetscBool)(filtered > 0),
      "constraints stiff enough in %" PetscInt_FMT " of %" PetscInt_FMT " systems", filtered, systems));
  report->effects[EFFECT_CONTACT].time  = report->time.contact;
  report->effects[EFFECT_FILTER].time   = report->time.filter_setup + report->time.filter_apply;
  report->effects[EFFECT_ESTIMATE].time = report->time.error_estimate;
  report->effects[EFFECT_RESULTS].time  = report->time.results;
  if (report->effects[EFFECT_PLASTICITY].on) report->effects[EFFECT_PLASTICITY].time = report->time.assembly;
  if (report->effects[EFFECT_FINITE_STRAIN].on) report->effects[EFFECT_FINITE_STRAIN].time = report->time.assembly;
  PetscFunctionReturn(0);
}
