/*
   Model, private: what the reader of scenes needs of expressions besides.
*/
#ifndef MODELIMPL_H
#define MODELIMPL_H

#include <model.h>

/* expression.c: numbers that follow time or the place */
typedef struct {
  const char *at;
  const char *names; /* of the variables, a letter each */
  PetscReal   values[3];
  PetscInt    depth;
  const char *wrong; /* where it stops making sense; NULL: nowhere so far */
} Expression;

PETSC_INTERN PetscReal ExpressionEvaluate(Expression *);

#endif
