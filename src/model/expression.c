/*
   Expressions of time or position. They consist of + - * / ^, brackets, functions, pi, and variables: t (time in load
   steps) and s (time from 0 to 1 over the whole load program), or x, y, z. The precedence is the usual one: -a^2 is
   -(a^2), and a^b^c is a^(b^c).
*/
#include "modelimpl.h"
#include <ctype.h>
#include <math.h>
#include <string.h>

#define EXPRESSION_DEPTH 100 /* largest depth of nested brackets and signs */

static PetscReal ExpressionSum(Expression *);

/* Stores the position of the first error */
static void ExpressionFail(Expression *e)
{
  if (!e->wrong) e->wrong = e->at;
}

/* Reads the character c if it is the next one */
static PetscBool ExpressionTake(Expression *e, char c)
{
  while (isspace((unsigned char)*e->at)) ++e->at;
  if (*e->at != c || e->wrong) return PETSC_FALSE;
  ++e->at;
  return PETSC_TRUE;
}

/* Applies a function to its arguments */
static PetscReal ExpressionApply(const char name[], PetscReal x, PetscReal y)
{
  if (!strcmp(name, "sin")) return PetscSinReal(x);
  if (!strcmp(name, "cos")) return PetscCosReal(x);
  if (!strcmp(name, "tan")) return PetscTanReal(x);
  if (!strcmp(name, "tanh")) return PetscTanhReal(x);
  if (!strcmp(name, "exp")) return PetscExpReal(x);
  if (!strcmp(name, "log")) return PetscLogReal(x);
  if (!strcmp(name, "sqrt")) return PetscSqrtReal(x);
  if (!strcmp(name, "abs")) return PetscAbsReal(x);
  if (!strcmp(name, "min")) return PetscMin(x, y);
  return PetscMax(x, y);
}

/* Evaluates a variable, pi, or a function with its arguments */
static PetscReal ExpressionWord(Expression *e)
{
  static const char *const functions[] = {"min", "max", "sin", "cos", "tan", "tanh", "exp", "log", "sqrt",
    "abs"}; /* the first two take two arguments */
  char                     word[8]     = "";
  const char              *begin       = e->at;
  size_t                   n           = 0;

  while (isalpha((unsigned char)*e->at) && n + 1 < sizeof(word)) word[n++] = (char)tolower((unsigned char)*e->at++);
  for (size_t v = 0; n == 1 && e->names[v]; ++v) {
    if (word[0] == e->names[v]) return e->values[v];
  }
  if (!strcmp(word, "pi")) return PETSC_PI;
  for (size_t f = 0; f < PETSC_STATIC_ARRAY_LENGTH(functions); ++f) {
    PetscReal x, y = 0;

    if (strcmp(word, functions[f])) continue;
    if (!ExpressionTake(e, '(')) ExpressionFail(e);
    x = ExpressionSum(e);
    if (f < 2 && !ExpressionTake(e, ',')) ExpressionFail(e);
    if (f < 2) y = ExpressionSum(e);
    if (!ExpressionTake(e, ')')) ExpressionFail(e);
    return ExpressionApply(word, x, y);
  }
  e->at = begin;
  ExpressionFail(e);
  return 0;
}

static PetscReal ExpressionValue(Expression *e)
{
  PetscReal value = 0;
  char     *end;

  if (ExpressionTake(e, '(')) {
    value = ExpressionSum(e);
    if (!ExpressionTake(e, ')')) ExpressionFail(e);
    return value;
  }
  if (isalpha((unsigned char)*e->at)) return ExpressionWord(e);
  if (!isdigit((unsigned char)*e->at) && *e->at != '.') ExpressionFail(e);
  if (e->wrong) return 0;
  value = (PetscReal)strtod(e->at, &end);
  if (end == e->at) ExpressionFail(e);
  e->at = end;
  return value;
}

static PetscReal ExpressionPower(Expression *e)
{
  PetscReal value = 0;

  if (++e->depth > EXPRESSION_DEPTH) ExpressionFail(e);
  if (e->wrong) return 0;
  if (ExpressionTake(e, '-')) {
    if (*e->at == '-') ExpressionFail(e); /* two signs are a slip */
    value = -ExpressionPower(e);
  } else {
    value = ExpressionValue(e);
    if (ExpressionTake(e, '^')) value = PetscPowReal(value, ExpressionPower(e));
  }
  --e->depth;
  return value;
}

static PetscReal ExpressionProduct(Expression *e)
{
  PetscReal value = ExpressionPower(e);

  while (!e->wrong) {
    if (ExpressionTake(e, '*')) value *= ExpressionPower(e);
    else if (ExpressionTake(e, '/')) value /= ExpressionPower(e);
    else break;
  }
  return value;
}

static PetscReal ExpressionSum(Expression *e)
{
  PetscReal value = ExpressionProduct(e);

  while (!e->wrong) {
    if (ExpressionTake(e, '+')) value += ExpressionProduct(e);
    else if (ExpressionTake(e, '-')) value -= ExpressionProduct(e);
    else break;
  }
  return value;
}

/* Evaluates the whole text. e->wrong points to the first error, or is NULL. */
PetscReal ExpressionEvaluate(Expression *e)
{
  const PetscReal value = ExpressionSum(e);

  while (!e->wrong && isspace((unsigned char)*e->at)) ++e->at;
  if (!e->wrong && *e->at) ExpressionFail(e);
  return value;
}

PetscErrorCode SceneEvaluatePlace(const void *entry, const char what[], const char expression[], const PetscReal x[3],
  PetscReal *value)
{
  const SceneEntry *here = (const SceneEntry *)entry;
  Expression        e    = {.at = expression, .names = "xyz", .values = {x[0], x[1], x[2]}};

  PetscFunctionBegin;
  *value = ExpressionEvaluate(&e);
  PetscCheck(!e.wrong, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG, "The expression \"%s\" cannot be evaluated", expression);
  SceneCheck(!PetscIsInfOrNanReal(*value), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, here,
    "%s \"%s\": its value \"%s\" is not finite at (%g, %g, %g)", what, here->name, expression, (double)x[0],
    (double)x[1], (double)x[2]);
  PetscFunctionReturn(0);
}
