/* Reads load programs that are given by expressions, or by tables of times and values. */
#include "formatimpl.h"

static PetscErrorCode TableReadColumn(SceneKeys keys, const char owner[], const char column[], const char text[],
  PetscInt *n, PetscReal **values)
{
  char   key[SCENE_KEY_LENGTH];
  char **words;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s_%s", owner, column));
  PetscCall(SceneParseList(keys, key, text, n, &words));
  PetscCall(PetscCalloc1(*n, values));
  for (PetscInt i = 0; i < *n; ++i) PetscCall(SceneParseReal(keys, key, words[i], &(*values)[i]));
  if (words) PetscCall(PetscStrToArrayDestroy((int)*n, words));
  PetscFunctionReturn(0);
}

/* Interpolates a table linearly. The value is constant before the first and after the last time. */
static PetscReal TableInterpolate(PetscInt n, const PetscReal times[], const PetscReal values[], PetscReal time)
{
  PetscInt i = 0;

  while (i < n && times[i] < time) ++i;
  if (!i) return values[0];
  if (i == n) return values[n - 1];
  return values[i - 1] + (values[i] - values[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1]);
}

static PetscErrorCode TableRead(SceneKeys keys, const char owner[], const char times[], const char values[],
  Scene scene, SceneRamp *ramp)
{
  const PetscReal increment = SceneTimeStep(scene);
  PetscInt        n         = PETSC_DECIDE;
  PetscReal      *time, *value;

  PetscFunctionBegin;
  PetscCall(TableReadColumn(keys, owner, "times", times, &n, &time));
  PetscCall(TableReadColumn(keys, owner, "values", values, &n, &value));
  if (!n) PetscCall(SceneKeysError(keys, owner, "times", "is empty, or the numbers of times and values differ"));
  for (PetscInt i = 1; i < n; ++i) {
    if (!(time[i] > time[i - 1]))
      PetscCall(SceneKeysError(keys, owner, "times", "must ascend, but %g comes after %g", (double)time[i],
        (double)time[i - 1]));
  }
  if (n && SceneIsDynamic(scene)) ramp->start = TableInterpolate(n, time, value, 0.0);
  for (PetscInt k = 0; n && k < scene->nsteps; ++k)
    ramp->factor[k] = TableInterpolate(n, time, value, (PetscReal)(k + 1) * increment);
  PetscCall(PetscFree(time));
  PetscCall(PetscFree(value));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadProgram(SceneKeys keys, const char owner[], Scene scene, SceneRamp *ramp, PetscBool *found)
{
  const PetscReal increment = SceneTimeStep(scene), end = (PetscReal)scene->nsteps * increment;
  const char     *expression, *times, *values;
  char            key[SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s_expression", owner));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &expression, "%s", key));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &times, "%s_times", owner));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &values, "%s_values", owner));
  *found = (PetscBool)(expression || times || values);
  if (expression && (times || values))
    PetscCall(SceneKeysError(keys, owner, NULL, "has an expression and a table; give only one of the two"));
  else if (!times != !values)
    PetscCall(
      SceneKeysError(keys, owner, NULL, "has %s and no %s", times ? "times" : "values", times ? "values" : "times"));
  else if (times) PetscCall(TableRead(keys, owner, times, values, scene, ramp));
  if (expression && SceneIsDynamic(scene)) PetscCall(SceneEvaluate(keys, key, expression, 0.0, end, &ramp->start));
  for (PetscInt k = 0; expression && k < scene->nsteps; ++k)
    PetscCall(SceneEvaluate(keys, key, expression, (PetscReal)(k + 1) * increment, end, &ramp->factor[k]));
  PetscFunctionReturn(0);
}
