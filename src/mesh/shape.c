/* The table of shapes */
#include "shape.h"

PetscErrorCode ShapeGet(MPI_Comm comm, const SceneBody *body, const Shape **shape)
{
  PetscFunctionBegin;
  switch (body->shape) {
  case SHAPE_BOX:
    *shape = &ShapeBox;
    break;
  default:
    SETERRQ(comm, PETSC_ERR_ARG_OUTOFRANGE, "Body \"%s\" has the unknown shape number %d", body->name, (int)body->shape);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeGridDestroy(ShapeGrid *grid)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(grid->cells));
  PetscCall(PetscFree(grid->coordinates));
  PetscCall(PetscFree(grid->facets));
  PetscCall(PetscFree(grid->facetface));
  PetscFunctionReturn(0);
}
