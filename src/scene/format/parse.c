/*
   Converts the text of values to numbers, lists and names. If a value cannot be converted, an error is recorded and the
   variable is unchanged.
*/
#include "formatimpl.h"
#include <errno.h>
#include <stdlib.h>
#include <ctype.h>
#include <string.h>
#include <strings.h>

static PetscBool SceneParseAtEnd(const char *s)
{
  while (isspace((unsigned char)*s)) ++s;
  return *s ? PETSC_FALSE : PETSC_TRUE;
}

/* Parses a decimal number or a fraction such as -5/7. */
PetscErrorCode SceneParseReal(SceneKeys keys, const char key[], const char text[], PetscReal *value)
{
  char  *end;
  double number = strtod(text, &end), divisor = 1.0;

  PetscFunctionBegin;
  if (end != text && *end == '/') {
    const char *start = end + 1;

    divisor = strtod(start, &end);
    if (end == start) end = (char *)text;
  }
  if (end == text || !SceneParseAtEnd(end))
    PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is not a number%s", text,
      strchr(text, ',') ? ": decimals have a point" : ""));
  else if (PetscIsInfOrNanReal(number) || PetscIsInfOrNanReal(divisor) || PetscIsInfOrNanReal(number / divisor))
    PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is not a finite number", text));
  else *value = (PetscReal)(number / divisor);
  PetscFunctionReturn(0);
}

PetscErrorCode SceneParseInt(SceneKeys keys, const char key[], const char text[], PetscInt *value)
{
  char     *end;
  long long number;

  PetscFunctionBegin;
  errno  = 0;
  number = strtoll(text, &end, 10);
  if (end == text || !SceneParseAtEnd(end))
    PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is not a whole number", text));
  else if (errno == ERANGE || number > PETSC_MAX_INT || number < PETSC_MIN_INT)
    PetscCall(SceneKeysError(keys, key, NULL, "is %s, which PETSc's integer type cannot hold", text));
  else *value = (PetscInt)number;
  PetscFunctionReturn(0);
}

/*
   Parses an enumeration. names: as in PETSc, the names of the values, then the name of the type, its prefix and NULL.
*/
PetscErrorCode SceneParseEnum(SceneKeys keys, const char key[], const char text[], const char *const names[],
  PetscInt *value)
{
  char      choices[SCENE_KEY_LENGTH] = "";
  PetscBool same;

  PetscFunctionBegin;
  for (PetscInt i = 0; names[i + 2]; ++i) {
    PetscCall(PetscStrcasecmp(text, names[i], &same));
    if (same) {
      *value = i;
      PetscFunctionReturn(0);
    }
    if (i) PetscCall(PetscStrlcat(choices, ", ", sizeof(choices)));
    PetscCall(PetscStrlcat(choices, names[i], sizeof(choices)));
  }
  PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\"; it can be: %s", text, choices));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneParseAnswer(SceneKeys keys, const char key[], const char text[], PetscBool *value)
{
  static const char *const answers[] = {"false", "true", "Answer", "", NULL};
  PetscInt                 answer    = *value;

  PetscFunctionBegin;
  PetscCall(SceneParseEnum(keys, key, text, answers, &answer));
  *value = answer ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Splits a list. *n: required number of entries on entry, or PETSC_DECIDE; number of entries on exit. *words: the
   entries, freed with PetscStrToArrayDestroy(); NULL if their number is wrong.
*/
PetscErrorCode SceneParseList(SceneKeys keys, const char key[], const char text[], PetscInt *n, char ***words)
{
  int count;

  PetscFunctionBegin;
  PetscCall(PetscStrToArray(text, ',', &count, words));
  if (*n != PETSC_DECIDE && *n != count) {
    PetscCall(
      SceneKeysError(keys, key, NULL, "has %d value%s, it needs %" PetscInt_FMT, count, count == 1 ? "" : "s", *n));
    PetscCall(PetscStrToArrayDestroy(count, *words));
    *words = NULL;
    count  = 0;
  }
  *n = count;
  PetscFunctionReturn(0);
}

/* Parses a list of n numbers. infinite: true if the numbers may be infinite, in any common spelling. */
static PetscErrorCode ParseReals(SceneKeys keys, const char key[], const char text[], PetscInt n, PetscBool infinite,
  PetscReal values[])
{
  char **words;

  PetscFunctionBegin;
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt i = 0; i < n; ++i) {
    const char *word = words[i] + (words[i][0] == '-');

    if (infinite && !strcasecmp(word + (word[0] == '.'), "inf"))
      values[i] = word == words[i] ? PETSC_INFINITY : PETSC_NINFINITY;
    else PetscCall(SceneParseReal(keys, key, words[i], &values[i]));
  }
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneParseReals(SceneKeys keys, const char key[], const char text[], PetscInt n, PetscReal values[])
{
  PetscFunctionBegin;
  PetscCall(ParseReals(keys, key, text, n, PETSC_FALSE, values));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneParseBounds(SceneKeys keys, const char key[], const char text[], PetscInt n, PetscReal values[])
{
  PetscFunctionBegin;
  PetscCall(ParseReals(keys, key, text, n, PETSC_TRUE, values));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneParseInts(SceneKeys keys, const char key[], const char text[], PetscInt n, PetscInt values[])
{
  char **words;

  PetscFunctionBegin;
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt i = 0; i < n; ++i) PetscCall(SceneParseInt(keys, key, words[i], &values[i]));
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

/* Gets the number of a body by its name; PETSC_DECIDE if there is no such body. */
PetscErrorCode SceneParseBody(SceneKeys keys, Scene scene, const char key[], const char text[], PetscInt *body)
{
  *body = PETSC_DECIDE;
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (!strcmp(text, scene->bodies[b].name)) *body = b;
  }
  if (*body < 0) PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is no body of the scene", text));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneParseRamp(SceneKeys keys, Scene scene, const char key[], const char text[], PetscInt *ramp)
{
  char      choices[SCENE_KEY_LENGTH] = "";
  PetscBool same;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nramps; ++r) {
    PetscCall(PetscStrcasecmp(text, scene->ramps[r].name, &same));
    if (same) {
      *ramp = r;
      PetscFunctionReturn(0);
    }
    if (r) PetscCall(PetscStrlcat(choices, ", ", sizeof(choices)));
    PetscCall(PetscStrlcat(choices, scene->ramps[r].name, sizeof(choices)));
  }
  PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\"; it can be: %s", text, choices));
  PetscFunctionReturn(0);
}

PetscBool SceneIsName(const char name[])
{
  if (!isalpha((unsigned char)name[0])) return PETSC_FALSE;
  for (const char *c = name; *c; ++c)
    if (!isalnum((unsigned char)*c) && *c != '_' && *c != '-') return PETSC_FALSE;
  return PETSC_TRUE;
}

/*
   Gets the names of the entries of a list, each of which is allocated. Names are part of keys; therefore names that
   differ only in upper and lower case are equal.
*/
PetscErrorCode SceneGetNames(SceneKeys keys, const char key[], PetscBool required, PetscInt *n, char ***names)
{
  const char *text;
  char      **words;
  PetscBool   same;

  PetscFunctionBegin;
  *n     = 0;
  *names = NULL;
  PetscCall(SceneKeysGet(keys, required, &text, "%s", key));
  if (!text) PetscFunctionReturn(0);
  *n = PETSC_DECIDE;
  PetscCall(SceneParseList(keys, key, text, n, &words));
  PetscCall(PetscMalloc1(*n, names));
  for (PetscInt i = 0; i < *n; ++i) {
    PetscCall(PetscStrallocpy(words[i], &(*names)[i]));
    if (!SceneIsName(words[i]))
      PetscCall(SceneKeysError(keys, key, words[i], "has no valid name: a letter, then letters, digits, _ or -"));
    for (PetscInt j = 0; j < i; ++j) {
      PetscCall(PetscStrcasecmp(words[i], words[j], &same));
      if (same) PetscCall(SceneKeysError(keys, key, words[i], "occurs twice; each name in a list must be unique"));
    }
  }
  if (required && !*n) PetscCall(SceneKeysError(keys, key, NULL, "is empty"));
  PetscCall(PetscStrToArrayDestroy((int)*n, words));
  PetscFunctionReturn(0);
}
