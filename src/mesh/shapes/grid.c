/* Functions that all shapes use: level 0 grids of graded blocks of cells, and limits of their numbers */
#include "shapesimpl.h"

/* Adds the facets of both sides of a block that are perpendicular to direction d */
static void ShapeBlockFacets(const SceneBody *body, const ShapeBlock *block, PetscInt d, ShapeGrid *grid)
{
  const PetscInt s = (d + 1) % 3, t = (d + 2) % 3;

  for (PetscInt end = 0; end < 2; ++end) {
    if (block->faces[2 * d + end] < 0) continue;
    for (PetscInt j = 0; j < block->n[t]; ++j) {
      for (PetscInt i = 0; i < block->n[s]; ++i) {
        static const PetscInt around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

        for (PetscInt a = 0; a < 4; ++a) {
          PetscInt at[3];

          at[d]                               = end ? block->n[d] : 0;
          at[s]                               = i + around[a][0];
          at[t]                               = j + around[a][1];
          grid->facets[4 * grid->nfacets + a] = block->vertex(body, block->context, at[0], at[1], at[2], NULL);
        }
        grid->facetface[grid->nfacets++] = block->faces[2 * d + end];
      }
    }
  }
}

/* Adds the cells of a block. flip: 1 if the cells' first direction is reversed, so that they are right-handed in space;
   else 0 */
static void ShapeBlockCells(const SceneBody *body, const ShapeBlock *block, PetscInt flip, ShapeGrid *grid)
{
  for (PetscInt k = 0; k < block->n[2]; ++k) {
    for (PetscInt j = 0; j < block->n[1]; ++j) {
      for (PetscInt i = 0; i < block->n[0]; ++i, ++grid->ncells) {
        for (PetscInt a = 0; a < 8; ++a)
          grid->cells[8 * grid->ncells + (a ^ flip)] =
            block->vertex(body, block->context, i + (a & 1), j + (a >> 1 & 1), k + (a >> 2), NULL);
      }
    }
  }
}

/* Sets the parameters of the vertices of a block */
static void ShapeBlockVertices(const SceneBody *body, const ShapeBlock *block, ShapeGrid *grid)
{
  for (PetscInt k = 0; k <= block->n[2]; ++k) {
    for (PetscInt j = 0; j <= block->n[1]; ++j) {
      for (PetscInt i = 0; i <= block->n[0]; ++i) {
        PetscReal      p[3];
        const PetscInt vertex = block->vertex(body, block->context, i, j, k, p);

        for (PetscInt d = 0; d < 3; ++d) grid->coordinates[3 * vertex + d] = p[d];
      }
    }
  }
}

PetscErrorCode ShapeGridCreate(const SceneBody *body, PetscInt nblocks, const ShapeBlock blocks[], PetscInt nvertices,
  PetscBool mirrored, ShapeGrid *grid)
{
  PetscInt ncells = 0, nfacets = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nblocks; ++b) {
    const PetscInt *n = blocks[b].n;

    ncells += n[0] * n[1] * n[2];
    for (PetscInt side = 0; side < 6; ++side)
      nfacets += blocks[b].faces[side] < 0 ? 0 : n[(side / 2 + 1) % 3] * n[(side / 2 + 2) % 3];
  }
  PetscCall(PetscMalloc1(8 * ncells, &grid->cells));
  PetscCall(PetscMalloc1(3 * nvertices, &grid->coordinates));
  PetscCall(PetscMalloc1(4 * nfacets, &grid->facets));
  PetscCall(PetscMalloc1(nfacets, &grid->facetface));
  grid->ncorners  = 8;
  grid->nvertices = nvertices;
  grid->ncells    = 0;
  grid->nfacets   = 0;
  for (PetscInt b = 0; b < nblocks; ++b) {
    ShapeBlockCells(body, &blocks[b], mirrored ? 1 : 0, grid);
    for (PetscInt d = 0; d < 3; ++d) ShapeBlockFacets(body, &blocks[b], d, grid);
    ShapeBlockVertices(body, &blocks[b], grid);
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
  PetscCall(PetscFree(grid->curve));
  PetscFunctionReturn(0);
}

/* Returns the length of the first i cells: `even` cells have length 1, and the next ones grow by the ratio */
static PetscReal ShapeGradedLength(PetscReal ratio, PetscInt even, PetscInt i)
{
  if (i <= even) return (PetscReal)i;
  return (PetscReal)even + ratio * (PetscPowReal(ratio, (PetscReal)(i - even)) - 1) / (ratio - 1);
}

PetscReal ShapeGraded(PetscReal grading, PetscInt even, PetscInt n, PetscInt i)
{
  PetscReal ratio;

  even = PetscMax(even, 1);
  if (grading == 0 || grading == 1 || n <= even || i == 0 || i == n) return (PetscReal)i / (PetscReal)n;
  if (grading < 1) return 1 - ShapeGraded(1 / grading, even, n, n - i);
  ratio = PetscPowReal(grading, 1 / (PetscReal)(n - even));
  return ShapeGradedLength(ratio, even, i) / ShapeGradedLength(ratio, even, n);
}

PetscReal ShapeBetween(const SceneBody *body, PetscInt d, PetscInt i, PetscReal from, PetscReal to)
{
  const PetscReal t = ShapeGraded(body->grading[d], body->even[d], body->cells[d], i);

  return (1 - t) * from + t * to;
}

void ShapeCircle(const PetscReal q[2], PetscReal x[2])
{
  const PetscBool steep = (PetscBool)(PetscAbsReal(q[1]) > PetscAbsReal(q[0]));
  const PetscReal big = q[steep ? 1 : 0], angle = (q[steep ? 0 : 1] / PetscAbsReal(big)) * PETSC_PI / 4;

  x[steep ? 1 : 0] = big > 0 ? PetscCosReal(angle) : -PetscCosReal(angle);
  x[steep ? 0 : 1] = PetscSinReal(angle);
}

PetscErrorCode ShapeCheckCount(MPI_Comm comm, const SceneBody *body, const char what[], PetscInt count)
{
  PetscFunctionBegin;
  SceneCheck(count > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\" must have at least one cell %s, but has %" PetscInt_FMT, body->name, what, count);
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeCheckTotal(MPI_Comm comm, const SceneBody *body, PetscReal nvertices)
{
  PetscFunctionBegin;
  SceneCheck(nvertices < (PetscReal)PETSC_MAX_INT / 16, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\" has too many level 0 vertices for PETSc's integer type: %g", body->name, (double)nvertices);
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeCheckGrading(MPI_Comm comm, const SceneBody *body, PetscReal grading, PetscInt even, PetscInt n)
{
  PetscFunctionBegin;
  SceneCheck(even >= 0 && even <= n, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the number of even cells of a grading must be between 0 and the number of cells, %" PetscInt_FMT
    ", but is %" PetscInt_FMT,
    body->name, n, even);
  SceneCheck(grading >= 0 && grading <= 1e6 && (grading == 0 || grading >= 1e-6), comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": a grading is the size of the last cell over that of the first, which must lie between 1e-6 and 1e6, "
    "but is %g",
    body->name, (double)grading);
  PetscFunctionReturn(0);
}

/* Computes the number of each body's first cell in the mesh of all of this rank's grids. Tetrahedra come before
   hexahedra. */
PetscErrorCode MeshGetFirstCells(PetscInt nbodies, const MeshBody meshes[], PetscInt first[])
{
  PetscInt cell = 0;

  PetscFunctionBegin;
  for (PetscInt ncorners = 4; ncorners <= 8; ncorners += 4) {
    for (PetscInt b = 0; b < nbodies; ++b) {
      if (meshes[b].ncorners != ncorners) continue;
      first[b] = cell;
      cell += meshes[b].grid.ncells;
    }
  }
  PetscFunctionReturn(0);
}
