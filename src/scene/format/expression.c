/* Evaluates and checks expressions of a scene file, and reports their errors. */
#include "formatimpl.h"
#include "src/model/modelimpl.h"

static PetscErrorCode ExpressionError(SceneKeys keys, const char key[], const char text[], const char variables[],
  const Expression *e)
{
  PetscFunctionBegin;
  PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is not a valid expression%s%s%s%s%s", text,
    *e->wrong ? " from \"" : " at its end", e->wrong, *e->wrong ? "\" on: numbers, " : "", *e->wrong ? variables : "",
    *e->wrong ? ", pi, + - * / ^, brackets, sin, cos, tan, tanh, exp, log, sqrt, abs, min, max" : ""));
  PetscFunctionReturn(0);
}

/*
   Evaluates an expression at a time of a load program that ends at the time `end`. Records an error if the result is
   not a finite number.
*/
PetscErrorCode SceneEvaluate(SceneKeys keys, const char key[], const char text[], PetscReal time, PetscReal end,
  PetscReal *value)
{
  Expression e = {.at = text, .names = "ts", .values = {time, time / end}};

  PetscFunctionBegin;
  *value = ExpressionEvaluate(&e);
  if (e.wrong) PetscCall(ExpressionError(keys, key, text, "t, s", &e));
  else if (PetscIsInfOrNanReal(*value))
    PetscCall(SceneKeysError(keys, key, NULL, ", \"%s\", is not finite at time %g", text, (double)time));
  PetscFunctionReturn(0);
}

/* Records an error if the expression has a syntax error. Whether its values are finite is checked when it is used. */
PetscErrorCode SceneCheckExpression(SceneKeys keys, const char key[], const char text[])
{
  Expression e = {.at = text, .names = "xyz"};

  PetscFunctionBegin;
  (void)ExpressionEvaluate(&e);
  if (e.wrong) PetscCall(ExpressionError(keys, key, text, "x, y, z", &e));
  PetscFunctionReturn(0);
}
