/* The table of shapes */
#include "shapesimpl.h"

PetscErrorCode ShapeGet(MPI_Comm comm, const SceneBody *body, const Shape **shape)
{
  PetscFunctionBegin;
  switch (body->shape) {
  case SHAPE_BOX: *shape = &ShapeBox; break;
  case SHAPE_TUBE_ARC: *shape = &ShapeTubeArc; break;
  case SHAPE_HALF_ELLIPSE: *shape = &ShapeHalfEllipse; break;
  case SHAPE_SPHERE_SHELL: *shape = &ShapeSphereShell; break;
  case SHAPE_SPHEROID_SHELL: *shape = &ShapeSpheroidShell; break;
  case SHAPE_BALL: *shape = &ShapeBall; break;
  case SHAPE_GMSH: *shape = NULL; break;
  default:
    SETERRQ(comm, PETSC_ERR_ARG_OUTOFRANGE, "Body \"%s\" has the unknown shape number %d", body->name,
      (int)body->shape);
  }
  PetscFunctionReturn(0);
}
