/* load: so many equal steps to load factor 1, or the factor at the end of each */
#include "sceneimpl.h"

PetscErrorCode SceneSetUniformLoad(Scene scene, PetscInt nsteps)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(scene->load));
  scene->nsteps = nsteps;
  if (nsteps < 1) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(nsteps, &scene->load));
  for (PetscInt i = 0; i < nsteps; ++i) scene->load[i] = (PetscReal)(i + 1) / (PetscReal)nsteps;
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadFactors(SceneKeys keys, Scene scene, const char text[])
{
  char **words;

  PetscFunctionBegin;
  scene->nsteps = PETSC_DECIDE;
  PetscCall(SceneParseList(keys, "load_factors", text, &scene->nsteps, &words));
  PetscCall(PetscCalloc1(scene->nsteps, &scene->load));
  for (PetscInt i = 0; i < scene->nsteps; ++i) PetscCall(SceneParseReal(keys, "load_factors", words[i], &scene->load[i]));
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
