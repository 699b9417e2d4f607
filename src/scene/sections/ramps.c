/* load and ramps: factors of the load in each load step, and of quantities that have their own ramp. */
#include "sectionsimpl.h"

/* Sets a linear increase from 0 to 1. */
static PetscErrorCode SceneSetUniformLoad(SceneRamp *ramp, PetscInt nsteps)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc1(PetscMax(0, nsteps), &ramp->factor));
  for (PetscInt i = 0; i < nsteps; ++i) ramp->factor[i] = (PetscReal)(i + 1) / (PetscReal)nsteps;
  PetscFunctionReturn(0);
}

/*
   Finds the number of load steps if the scene does not state it. *nsteps: number of factors of the first ramp that has
   factors, or 1.
*/
static PetscErrorCode SceneCountFactors(SceneKeys keys, PetscInt nramps, char *const ramps[], PetscInt *nsteps)
{
  PetscFunctionBegin;
  *nsteps = 1;
  for (PetscInt r = 0; r < nramps; ++r) {
    char        key[SCENE_KEY_LENGTH];
    const char *text;
    char      **words;

    PetscCall(PetscSNPrintf(key, sizeof(key), "ramps_%s_factors", ramps[r]));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
    if (!text) continue;
    *nsteps = PETSC_DECIDE;
    PetscCall(SceneParseList(keys, key, text, nsteps, &words));
    PetscCall(PetscStrToArrayDestroy((int)*nsteps, words));
    break;
  }
  PetscFunctionReturn(0);
}

/* Reads the load, which is ramp 0 and determines the number of load steps. ramps: names of the other ramps. */
static PetscErrorCode SceneReadLoad(SceneKeys keys, Scene scene, PetscInt nramps, char *const ramps[], SceneRamp *ramp)
{
  const char *steps, *factors;
  char      **words;
  PetscBool   program;

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(SCENE_LOAD_RAMP, &ramp->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &steps, "load_steps"));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &factors, "load_factors"));
  if (steps && factors) PetscCall(SceneKeysError(keys, "load_steps", NULL, "and factors of load exclude each other"));
  if ((steps || factors) && SceneIsDynamic(scene))
    PetscCall(SceneKeysError(keys, steps ? "load_steps" : "load_factors", NULL,
      "and dynamics exclude each other: time_step and end_time set the load steps"));
  if (SceneIsDynamic(scene)) {
    PetscCall(PetscMalloc1(scene->nsteps, &ramp->factor));
    for (PetscInt i = 0; i < scene->nsteps; ++i) ramp->factor[i] = 1.0;
    ramp->start = 1.0;
    PetscCall(SceneReadProgram(keys, "load", scene, ramp, &program));
  } else if (factors) {
    scene->nsteps = PETSC_DECIDE;
    PetscCall(SceneParseList(keys, "load_factors", factors, &scene->nsteps, &words));
    PetscCall(PetscStrToArrayDestroy((int)scene->nsteps, words));
    PetscCall(PetscCalloc1(scene->nsteps, &ramp->factor));
    PetscCall(SceneParseReals(keys, "load_factors", factors, scene->nsteps, ramp->factor));
  } else {
    PetscCall(SceneCountFactors(keys, nramps, ramps, &scene->nsteps));
    if (steps) PetscCall(SceneParseInt(keys, "load_steps", steps, &scene->nsteps));
    if (scene->nsteps > SCENE_MAX_STEPS) {
      PetscCall(SceneKeysError(keys, "load_steps", NULL, "is %" PetscInt_FMT ", which must be at most %d",
        scene->nsteps, SCENE_MAX_STEPS));
      scene->nsteps = SCENE_MAX_STEPS;
    }
    PetscCall(SceneSetUniformLoad(ramp, scene->nsteps));
    PetscCall(SceneReadProgram(keys, "load", scene, ramp, &program));
  }
  if (scene->nsteps < 1)
    PetscCall(
      SceneKeysError(keys, "load_steps", NULL, "is %" PetscInt_FMT ", which must be at least 1", scene->nsteps));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadRamp(SceneKeys keys, Scene scene, SceneRamp *ramp)
{
  const PetscInt nsteps = scene->nsteps;
  char           key[SCENE_KEY_LENGTH], owner[SCENE_KEY_LENGTH];
  const char    *text;
  PetscBool      reserved, program;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(owner, sizeof(owner), "ramps_%s", ramp->name));
  ramp->place = SceneGetPlace(&keys->places, owner);
  PetscCall(PetscStrcasecmp(ramp->name, SCENE_LOAD_RAMP, &reserved));
  if (reserved)
    PetscCall(SceneKeysError(keys, owner, NULL,
      ": this name is reserved for the load program, whose factors are in load: {factors: [...]}"));
  PetscCall(PetscSNPrintf(key, sizeof(key), "ramps_%s_factors", ramp->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  PetscCall(PetscCalloc1(PetscMax(0, nsteps), &ramp->factor));
  PetscCall(SceneReadProgram(keys, owner, scene, ramp, &program));
  if (!text && !program)
    PetscCall(SceneKeysError(keys, owner, NULL, "has neither factors nor an expression nor times and values"));
  if (text && program)
    PetscCall(SceneKeysError(keys, owner, NULL, "has factors and another program; give only one of the two"));
  if (text && nsteps > 0) PetscCall(SceneParseReals(keys, key, text, nsteps, ramp->factor));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadRamps(SceneKeys keys, Scene scene)
{
  PetscInt n;
  char   **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "ramps", PETSC_FALSE, &n, &names));
  scene->nramps = 1 + n;
  PetscCall(PetscCalloc1(scene->nramps, &scene->ramps));
  PetscCall(SceneReadLoad(keys, scene, n, names, &scene->ramps[0]));
  for (PetscInt r = 0; r < n; ++r) {
    scene->ramps[1 + r].name = names[r];
    PetscCall(SceneReadRamp(keys, scene, &scene->ramps[1 + r]));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/*
   Resamples all ramps at nsteps equal time steps. Bounds of displacements do not start at an earlier time than before.
*/
PetscErrorCode SceneResample(Scene scene, PetscInt nsteps)
{
  const PetscReal stretch = (PetscReal)nsteps / (PetscReal)scene->nsteps;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nramps; ++r) {
    PetscReal *factor;

    PetscCall(PetscMalloc1(nsteps, &factor));
    for (PetscInt i = 0; i < nsteps; ++i)
      PetscCall(
        SceneGetFactor(scene, r, (PetscReal)(i + 1) * (PetscReal)scene->nsteps / (PetscReal)nsteps, &factor[i]));
    PetscCall(PetscFree(scene->ramps[r].factor));
    scene->ramps[r].factor = factor;
  }
  if (scene->displacement_bounds)
    scene->displacement_bounds = 1 + (PetscInt)PetscCeilReal((PetscReal)(scene->displacement_bounds - 1) * stretch);
  for (PetscInt b = 0; b < scene->nbolts; ++b)
    scene->bolts[b].lock = (PetscInt)PetscCeilReal((PetscReal)scene->bolts[b].lock * stretch);
  scene->dynamics.time_step /= stretch;
  scene->nsteps = nsteps;
  PetscFunctionReturn(0);
}
