/* temperatures: a list of named temperatures of bodies that expand */
#include "sectionsimpl.h"
#include <petscviewer.h>

PetscErrorCode SceneReadTemperatures(SceneKeys keys, Scene scene)
{
  char        key[SCENE_KEY_LENGTH];
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "temperatures", PETSC_FALSE, &scene->ntemperatures, &names));
  PetscCall(PetscCalloc1(scene->ntemperatures, &scene->temperatures));
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    SceneTemperature *here = &scene->temperatures[t];

    here->name = names[t];
    PetscCall(SceneReadBodyName(keys, scene, "temperatures", here->name, &here->body));
    PetscCall(PetscSNPrintf(key, sizeof(key), "temperatures_%s_value", here->name));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
    PetscCall(PetscStrallocpy(text ? text : "0", &here->value));
    if (text) PetscCall(SceneCheckExpression(keys, key, text));
    PetscCall(SceneReadRampName(keys, scene, "temperatures", here->name, &here->ramp));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneBodyExpands(const SceneBody *body, PetscBool *expands)
{
  PetscReal A[9];

  PetscFunctionBegin;
  *expands = PETSC_FALSE;
  PetscCall(MaterialGetExpansion(&body->material, A));
  for (int i = 0; i < 9; ++i) *expands = (PetscBool)(*expands || A[i] != 0);
  PetscFunctionReturn(0);
}

/* What is heated has an expansion */
PetscErrorCode SceneValidateTemperatures(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    const SceneTemperature *here = &scene->temperatures[t];
    PetscBool               any  = PETSC_FALSE;

    for (PetscInt b = 0; b < scene->nbodies && !any; ++b) {
      if (here->body == PETSC_DECIDE || here->body == b) PetscCall(SceneBodyExpands(&scene->bodies[b], &any));
    }
    PetscCheck(any, comm, PETSC_ERR_USER_INPUT,
      "%s: temperature \"%s\" heats %s, whose material has no expansion; give a material of small strain one, as "
      "expansion: 12e-6",
      file, here->name, here->body < 0 ? "every body" : scene->bodies[here->body].name);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewTemperatures(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (scene->ntemperatures) PetscCall(PetscViewerASCIIPrintf(viewer, "temperatures:\n"));
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    const SceneTemperature *here = &scene->temperatures[t];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  - %s: {", here->name));
    if (here->body >= 0) PetscCall(PetscViewerASCIIPrintf(viewer, "body: %s, ", scene->bodies[here->body].name));
    PetscCall(PetscViewerASCIIPrintf(viewer, "value: \"%s\"", here->value));
    if (here->ramp) PetscCall(PetscViewerASCIIPrintf(viewer, ", ramp: %s", scene->ramps[here->ramp].name));
    PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroyTemperatures(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    PetscCall(PetscFree(scene->temperatures[t].name));
    PetscCall(PetscFree(scene->temperatures[t].value));
  }
  PetscCall(PetscFree(scene->temperatures));
  PetscFunctionReturn(0);
}
