/* Boxes of equal hexahedra, aligned with the axes */
#include "shape.h"

static const char *const BoxFaces[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", NULL};

static PetscErrorCode ShapeSize_Box(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells, PetscInt64 *nvertices)
{
  PetscFunctionBegin;
  *ncells    = 1;
  *nvertices = 1;
  for (PetscInt d = 0; d < 3; ++d) {
    PetscCheck(body->lower[d] < body->upper[d] && !PetscIsInfOrNanReal(body->upper[d] - body->lower[d]), comm, PETSC_ERR_ARG_OUTOFRANGE,
               "Body \"%s\": the box must have lower < upper along each axis, but along %c they are %g and %g", body->name, "xyz"[d], (double)body->lower[d], (double)body->upper[d]);
    PetscCheck(body->cells[d] > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, "Body \"%s\": the box must have at least one cell along each axis, but has %" PetscInt_FMT " along %c", body->name, body->cells[d], "xyz"[d]);
    PetscCheck(body->cells[d] < PETSC_MAX_INT / (8 * (*nvertices)), comm, PETSC_ERR_ARG_OUTOFRANGE, "Body \"%s\" has too many level 0 cells for this PETSc's integers: %" PetscInt_FMT " x %" PetscInt_FMT " x %" PetscInt_FMT, body->name,
               body->cells[0], body->cells[1], body->cells[2]);
    *ncells *= body->cells[d];
    *nvertices *= body->cells[d] + 1;
  }
  PetscFunctionReturn(0);
}

/* The facets of a face normal to axis d, at the vertex plane `plane` of that axis */
static void BoxFace(const PetscInt n[3], const PetscInt stride[3], PetscInt d, PetscInt plane, PetscInt face, ShapeGrid *grid)
{
  const PetscInt s = (d + 1) % 3, t = (d + 2) % 3;

  for (PetscInt j = 0; j < n[t]; ++j) {
    for (PetscInt i = 0; i < n[s]; ++i) {
      const PetscInt v = plane * stride[d] + i * stride[s] + j * stride[t];
      PetscInt      *f = grid->facets + 4 * grid->nfacets;

      f[0]                              = v;
      f[1]                              = v + stride[s];
      f[2]                              = v + stride[s] + stride[t];
      f[3]                              = v + stride[t];
      grid->facetface[grid->nfacets++] = face;
    }
  }
}

static PetscErrorCode ShapeCreate_Box(const SceneBody *body, ShapeGrid *grid)
{
  const PetscInt *n         = body->cells;
  const PetscInt  stride[3] = {1, n[0] + 1, (n[0] + 1) * (n[1] + 1)};
  const PetscInt  nfacets   = 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]);
  PetscInt       *c;
  PetscReal      *x;

  PetscFunctionBegin;
  grid->ncells    = n[0] * n[1] * n[2];
  grid->nvertices = stride[2] * (n[2] + 1);
  grid->nfacets   = 0;
  PetscCall(PetscMalloc1(8 * grid->ncells, &grid->cells));
  PetscCall(PetscMalloc1(3 * grid->nvertices, &grid->coordinates));
  PetscCall(PetscMalloc1(4 * nfacets, &grid->facets));
  PetscCall(PetscMalloc1(nfacets, &grid->facetface));
  x = grid->coordinates;
  for (PetscInt k = 0; k <= n[2]; ++k) {
    for (PetscInt j = 0; j <= n[1]; ++j) {
      for (PetscInt i = 0; i <= n[0]; ++i, x += 3) {
        const PetscInt index[3] = {i, j, k};

        for (PetscInt d = 0; d < 3; ++d) x[d] = ((n[d] - index[d]) * body->lower[d] + index[d] * body->upper[d]) / n[d];
      }
    }
  }
  c = grid->cells;
  for (PetscInt k = 0; k < n[2]; ++k) {
    for (PetscInt j = 0; j < n[1]; ++j) {
      for (PetscInt i = 0; i < n[0]; ++i, c += 8) {
        for (PetscInt a = 0; a < 8; ++a) c[a] = (i + (a & 1)) * stride[0] + (j + (a >> 1 & 1)) * stride[1] + (k + (a >> 2)) * stride[2];
      }
    }
  }
  for (PetscInt d = 0; d < 3; ++d) {
    BoxFace(n, stride, d, 0, 2 * d, grid);
    BoxFace(n, stride, d, n[d], 2 * d + 1, grid);
  }
  PetscFunctionReturn(0);
}

const Shape ShapeBox = {BoxFaces, ShapeSize_Box, ShapeCreate_Box};
