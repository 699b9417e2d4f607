/* Private header of model: expressions, which the scene reader evaluates. */
#ifndef MODELIMPL_H
#define MODELIMPL_H

#include <model.h>

/* expression.c: an expression of time or position while it is evaluated */
typedef struct {
  const char *at;    /* next character */
  const char *names; /* names of the variables, one letter each, in the order of `values` */
  PetscReal   values[3];
  PetscInt    depth; /* depth of nested brackets and signs */
  const char *wrong; /* position of the first error; NULL if there was none so far */
} Expression;

PETSC_INTERN PetscReal ExpressionEvaluate(Expression *);

#endif
