/*
   Private header of model: expressions, for the scene reader.
*/
#ifndef MODELIMPL_H
#define MODELIMPL_H

#include <model.h>

/* expression.c: numbers as expressions of time or position */
typedef struct {
  const char *at;
  const char *names; /* the variables, one letter each */
  PetscReal   values[3];
  PetscInt    depth;
  const char *wrong; /* position of the first error; NULL: none so far */
} Expression;

PETSC_INTERN PetscReal ExpressionEvaluate(Expression *);

#endif
