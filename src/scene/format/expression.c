/* Expressions of a scene file: evaluated, checked, and complained of. */
#include "formatimpl.h"
#include "src/model/modelimpl.h"

static PetscErrorCode ExpressionComplain(SceneKeys keys, const char key[], const char text[], const char variables[],
  const Expression *e)
{
  PetscFunctionBegin;
  PetscCall(SceneKeysComplain(keys, "%s is \"%s\", which makes no sense%s%s%s%s%s", key, text,
    *e->wrong ? " from \"" : " at its end", e->wrong, *e->wrong ? "\" on: numbers, " : "", *e->wrong ? variables : "",
    *e->wrong ? ", pi, + - * / ^, brackets, sin, cos, tan, tanh, exp, log, sqrt, abs, min, max" : ""));
  PetscFunctionReturn(0);
}

/* Of this time in a program that ends at `end`; what is no number is complained of */
PetscErrorCode SceneEvaluate(SceneKeys keys, const char key[], const char text[], PetscReal time, PetscReal end,
  PetscReal *value)
{
  Expression e = {.at = text, .names = "ts", .values = {time, time / end}};

  PetscFunctionBegin;
  *value = ExpressionEvaluate(&e);
  if (e.wrong) PetscCall(ExpressionComplain(keys, key, text, "t, s", &e));
  else if (PetscIsInfOrNanReal(*value))
    PetscCall(SceneKeysComplain(keys, "%s, \"%s\", is not finite at time %g", key, text, (double)time));
  PetscFunctionReturn(0);
}

/* Complains of what makes no sense; whether it is finite is known where it is used */
PetscErrorCode SceneCheckExpression(SceneKeys keys, const char key[], const char text[])
{
  Expression e = {.at = text, .names = "xyz"};

  PetscFunctionBegin;
  (void)ExpressionEvaluate(&e);
  if (e.wrong) PetscCall(ExpressionComplain(keys, key, text, "x, y, z", &e));
  PetscFunctionReturn(0);
}
