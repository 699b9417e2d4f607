/* load: so many equal steps to load factor 1, or the factor at the end of each */
#include "sceneimpl.h"

static PetscErrorCode SceneCreateLoadRamp(Scene scene, PetscInt nsteps)
{
  PetscFunctionBegin;
  if (!scene->ramps) {
    PetscCall(PetscCalloc1(1, &scene->ramps));
    PetscCall(PetscStrallocpy("load", &scene->ramps[0].name));
    scene->nramps = 1;
  }
  scene->nsteps = nsteps;
  PetscCall(PetscFree(scene->ramps[0].factor));
  PetscCall(PetscCalloc1(PetscMax(0, nsteps), &scene->ramps[0].factor));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneSetUniformLoad(Scene scene, PetscInt nsteps)
{
  PetscFunctionBegin;
  PetscCall(SceneCreateLoadRamp(scene, nsteps));
  for (PetscInt i = 0; i < nsteps; ++i) scene->ramps[0].factor[i] = (PetscReal)(i + 1) / (PetscReal)nsteps;
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadFactors(SceneKeys keys, Scene scene, const char text[])
{
  char   **words;
  PetscInt n = PETSC_DECIDE;

  PetscFunctionBegin;
  PetscCall(SceneParseList(keys, "load_factors", text, &n, &words));
  PetscCall(SceneCreateLoadRamp(scene, n));
  for (PetscInt i = 0; i < scene->nsteps; ++i) PetscCall(SceneParseReal(keys, "load_factors", words[i], &scene->ramps[0].factor[i]));
  PetscCall(PetscStrToArrayDestroy((int)scene->nsteps, words));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadLoad(SceneKeys keys, Scene scene)
{
  const char *steps, *factors;
  PetscInt    nsteps = 1;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &steps, "load_steps"));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &factors, "load_factors"));
  if (steps && factors) PetscCall(SceneKeysComplain(keys, "load_steps and load_factors exclude each other"));
  if (factors) PetscCall(SceneReadFactors(keys, scene, factors));
  else {
    if (steps) PetscCall(SceneParseInt(keys, "load_steps", steps, &nsteps));
    PetscCall(SceneSetUniformLoad(scene, nsteps));
  }
  PetscFunctionReturn(0);
}

/*@C
   SceneGetFactor - Factor of a ramp at a time

   Not Collective

   Input Parameters:
+  scene - the scene
.  ramp  - index of the ramp; 0 is the load itself
-  time  - load step k, counted from 1, ends at time k; 0 is the start

   Output Parameter:
.  factor - linear between the ends of the load steps, 0 at time 0

   Level: intermediate

.seealso: `SceneLoad()`
@*/
PetscErrorCode SceneGetFactor(Scene scene, PetscInt ramp, PetscReal time, PetscReal *factor)
{
  const PetscReal *end  = scene->ramps[ramp].factor;
  const PetscInt   step = PetscMin(scene->nsteps - 1, (PetscInt)PetscFloorReal(time)); /* before this end */

  PetscFunctionBegin;
  if (time >= (PetscReal)scene->nsteps) *factor = end[scene->nsteps - 1];
  else {
    const PetscReal from = step ? end[step - 1] : 0.0;

    *factor = from + (time - (PetscReal)step) * (end[step] - from);
  }
  PetscFunctionReturn(0);
}
