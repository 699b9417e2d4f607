/* Boxes of hexahedra, aligned with the axes, with equal or graded cells along each axis */
#include "shapesimpl.h"

static const char *const faces[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", NULL};

static PetscErrorCode ShapeSize_Box(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells, PetscInt64 *nvertices)
{
  PetscFunctionBegin;
  *ncells    = 1;
  *nvertices = 1;
  for (PetscInt d = 0; d < 3; ++d) {
    SceneCheck(body->lower[d] < body->upper[d] && !PetscIsInfOrNanReal(body->upper[d] - body->lower[d]), comm,
      PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the box must have lower < upper along each axis, but along %c they are %g and %g", body->name,
      "xyz"[d], (double)body -> lower[d], (double)body -> upper[d]);
    SceneCheck(body->cells[d] > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the box must have at least one cell along each axis, but has %" PetscInt_FMT " along %c",
      body->name, body->cells[d], "xyz"[d]);
    SceneCheck(body->cells[d] < PETSC_MAX_INT / (8 * (*nvertices)), comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\" has too many level 0 cells for PETSc's integer type: %" PetscInt_FMT " x %" PetscInt_FMT
      " x %" PetscInt_FMT,
      body->name, body->cells[0], body->cells[1], body->cells[2]);
    PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], body->cells[d]));
    *ncells *= body->cells[d];
    *nvertices *= body->cells[d] + 1;
  }
  PetscFunctionReturn(0);
}

static PetscInt BoxVertex(const SceneBody *body, PETSC_UNUSED const void *context, PetscInt i, PetscInt j, PetscInt k,
  PetscReal x[3])
{
  const PetscInt *n = body->cells, index[3] = {i, j, k};

  for (PetscInt d = 0; x && d < 3; ++d) x[d] = ShapeBetween(body, d, index[d], body->lower[d], body->upper[d]);
  return i + (n[0] + 1) * (j + (n[1] + 1) * k);
}

static PetscErrorCode ShapeCreate_Box(const SceneBody *body, ShapeGrid *grid)
{
  const PetscInt  *n     = body->cells;
  const ShapeBlock block = {{n[0], n[1], n[2]}, {0, 1, 2, 3, 4, 5}, NULL, BoxVertex};

  PetscFunctionBegin;
  PetscCall(ShapeGridCreate(body, 1, &block, (n[0] + 1) * (n[1] + 1) * (n[2] + 1), PETSC_FALSE, grid));
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  SHAPE_KEY("lower", KEY_REALS, 3, lower, PETSC_TRUE),
  SHAPE_KEY("upper", KEY_REALS, 3, upper, PETSC_TRUE),
  SHAPE_KEY("cells", KEY_INTS, 3, cells, PETSC_TRUE),
  SHAPE_KEY("grading", KEY_REALS, 3, grading, PETSC_FALSE),
  SHAPE_KEY("even", KEY_INTS, 3, even, PETSC_FALSE),
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeBox = {NULL, ShapeSize_Box, ShapeCreate_Box, NULL, keys, faces};
