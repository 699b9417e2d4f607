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

/* How many bodies, contact pairs and symmetry planes use an effect */
typedef struct {
  PetscInt finite, plastic, rigid, mean, modes, second; /* bodies */
  PetscInt friction;                                    /* contact pairs */
  PetscInt planes;                                      /* symmetry planes */
} EffectCounts;

static PetscErrorCode EffectsCount(Model model, EffectCounts *n)
{
  Scene        scene = model->scene;
  PetscInt    *nnodes;
  ElementType *elements;

  PetscFunctionBegin;
  *n = (EffectCounts){.finite = 0};
  PetscCall(PetscMalloc2(scene->nbodies, &nnodes, scene->nbodies, &elements));
  PetscCall(MeshGetBodyNodes(model->dm, scene->nbodies, nnodes));
  PetscCall(SceneChooseElements(scene, model->dm, elements, NULL));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    n->finite += MaterialIsFinite(&scene->bodies[b].material);
    n->plastic += MaterialYields(&scene->bodies[b].material);
    n->rigid += scene->bodies[b].material.type == MATERIAL_RIGID;
    n->mean += elements[b] == ELEMENT_BBAR;
    n->modes += elements[b] == ELEMENT_INCOMPATIBLE;
    n->second += MeshOrder(nnodes[b]) > 1;
  }
  PetscCall(PetscFree2(nnodes, elements));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) n->planes += scene->displacements[d].inclined;
  for (PetscInt p = 0; p < scene->npairs; ++p) n->friction += SceneContactPairHasFriction(&scene->pairs[p]);
  PetscFunctionReturn(0);
}

/* Sets an effect that is on if there are n > 0 of the things that `what` names */
static PetscErrorCode EffectSetCount(RunReport *report, const char name[], PetscInt n, const char what[])
{
  PetscFunctionBegin;
  PetscCall(EffectSet(report, name, (PetscBool)(n > 0), "%" PetscInt_FMT " %s", n, what));
  PetscFunctionReturn(0);
}

static PetscErrorCode EffectsSetBodies(Scene scene, PetscBool quadratic, const EffectCounts *n, RunReport *report)
{
  const struct {
    const char *name;
    PetscInt    n;
    const char *what, *more;
  } effects[] = {
    {"finite strain", n->finite, "with a law of finite strain",
      !n->finite  ? ""
      : quadratic ? ", one tangent per load step"
                  : ", true energy"},
    {"plasticity", n->plastic, "with a law of plasticity", ""},
    {"rigid bodies", n->rigid, "of material rigid", ""},
    {"mean dilatation", n->mean, "with element bbar", ""},
    {"incompatible modes", n->modes, "with element incompatible", ""},
    {"order 2", n->second, "of order 2", ""},
  };

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(effects); ++k)
    PetscCall(EffectSet(report, effects[k].name, (PetscBool)(effects[k].n > 0),
      "%" PetscInt_FMT " of %" PetscInt_FMT " bodies %s%s", effects[k].n, scene->nbodies, effects[k].what,
      effects[k].more));
  PetscFunctionReturn(0);
}

static PetscErrorCode EffectsSetLoads(Model model, const EffectCounts *n, RunReport *report)
{
  Scene scene = model->scene;

  PetscFunctionBegin;
  PetscCall(EffectSetCount(report, "pressure", scene->npressures, "pressures"));
  PetscCall(EffectSetCount(report, "traction", scene->ntractions, "tractions and forces on faces"));
  PetscCall(EffectSetCount(report, "body force", scene->nforces, "body forces"));
  if (SceneIsDynamic(scene))
    PetscCall(
      EffectSet(report, "inertia", PETSC_TRUE, "%" PetscInt_FMT " time steps of %g, scheme %s, mass %s", scene->nsteps,
        (double)scene->dynamics.time_step, DynamicsSchemes[scene->dynamics.scheme], MassTypes[scene->dynamics.mass]));
  else PetscCall(EffectSet(report, "inertia", PETSC_FALSE, "no dynamics: a static analysis"));
  PetscCall(EffectSet(report, "springs", (PetscBool)(scene->nsprings + scene->nconnectors > 0),
    "%" PetscInt_FMT " springs on faces, %" PetscInt_FMT " between points", scene->nsprings, scene->nconnectors));
  PetscCall(EffectSetCount(report, "pretension", scene->nbolts, "bolts"));
  PetscCall(EffectSet(report, "weak springs", (PetscBool)(model->springs.weak != NULL),
    model->springs.weak ? "they hold %" PetscInt_FMT " bodies without supports" : "weak_springs is not set",
    model->springs.nweak));
  PetscCall(EffectSetCount(report, "thermal strain", scene->ntemperatures, "temperatures"));
  PetscCall(EffectSet(report, "ties", (PetscBool)(scene->nties + scene->ncyclic > 0),
    "%" PetscInt_FMT " ties, %" PetscInt_FMT " cyclic symmetries", scene->nties, scene->ncyclic));
  PetscCall(EffectSetCount(report, "inclined symmetry", n->planes, "symmetry planes that are not normal to an axis"));
  if (scene->displacement_bounds)
    PetscCall(EffectSet(report, "displacement bounds", PETSC_TRUE, "from load step %" PetscInt_FMT,
      scene->displacement_bounds));
  else PetscCall(EffectSet(report, "displacement bounds", PETSC_FALSE, "displacement_bounds is not set"));
  PetscFunctionReturn(0);
}

/* Lists the effects of a scene. Their times are set at the end of the run. */
PetscErrorCode EffectsCreate(Model model, Results *results, RunReport *report)
{
  Scene        scene = model->scene;
  EffectCounts n;

  PetscFunctionBegin;
  PetscCall(EffectsCount(model, &n));
  PetscCall(PetscCalloc1(EFFECTS_MAX, &report->effects));
  PetscCall(EffectSetCount(report, "contact", scene->npairs, "contact pairs"));
  PetscCall(EffectSet(report, "contact updates", (PetscBool)(scene->npairs && scene->contact_updates > 1),
    "contact_updates is %" PetscInt_FMT, scene->contact_updates));
  PetscCall(EffectSetCount(report, "friction", n.friction, "contact pairs with friction, shear_limit or stick"));
  PetscCall(EffectSet(report, "AMG filter", (PetscBool)(scene->npairs > 0),
    scene->npairs ? "contact constraints are stiff" : "no contact, nothing to filter"));
  PetscCall(EffectsSetBodies(model->scene, model->quadratic, &n, report));
  PetscCall(EffectsSetLoads(model, &n, report));
  PetscCall(EffectSet(report, "error estimate", results->estimate,
    results->estimate ? "stress recovery at the end of every load step" : "-error_estimate is 0"));
  PetscCall(EffectSet(report, "probes and fields", (PetscBool)(results->probes.n || results->nodes || results->points),
    "%" PetscInt_FMT " points of probes; %sstress at nodes, %sat quadrature points", results->probes.n,
    results->nodes ? "" : "no ", results->points ? "" : "not "));
  PetscFunctionReturn(0);
}

/* Sets the times of the effects. Whether the filter was used is known only after the solve. */
PetscErrorCode EffectsSetTimes(Model model, RunReport *report)
{
  PetscInt systems = 0, filtered = 0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    systems += report->steps[s].systems;
    filtered += report->steps[s].filtered_systems;
  }
  if (model->contact && !systems && report->nsteps)
    PetscCall(EffectSet(report, "AMG filter", PETSC_FALSE,
      "not needed: the subspace method solves the contact constraints separately"));
  if (model->contact && systems)
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
