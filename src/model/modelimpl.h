/* Private header of model: expressions, which the scene reader evaluates, and STL files. */
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

/* stl_file.c: the facets of an STL file, on one rank */
typedef struct {
  PetscInt   n;
  PetscReal *x;    /* [9 n] corners, counterclockwise seen from outside [length] */
  PetscInt  *line; /* [n] line of the file at which the facet begins; 0 in a binary file */
} StlFacets;
PETSC_INTERN PetscErrorCode StlRead(const char file[], StlFacets *);

/* stl.c: distance of a point, negative inside [length], and its gradient */
PETSC_INTERN PetscReal StlDistance(const struct _n_SceneStl *, const PetscReal x[3], PetscReal gradient[3]);

#endif
