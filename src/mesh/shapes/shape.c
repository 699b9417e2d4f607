/* The table of shapes, and their names in scenes */
#include "shapesimpl.h"

#define SHAPE_NAME(name, shape, text) text,
const char *const BodyShapes[] = {BODY_SHAPES(SHAPE_NAME) "gmsh", "BodyShape", "SHAPE_", NULL};

#define SHAPE_ENTRY(name, shape, text) &Shape##shape,
static const Shape *const shapes[] = {BODY_SHAPES(SHAPE_ENTRY) NULL};

PetscErrorCode ShapeGet(MPI_Comm comm, const SceneBody *body, const Shape **shape)
{
  PetscFunctionBegin;
  SceneCheck(body->shape >= 0 && body->shape <= SHAPE_GMSH, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\" has the unknown shape number %d", body->name, (int)body->shape);
  *shape = shapes[body->shape];
  PetscFunctionReturn(0);
}
