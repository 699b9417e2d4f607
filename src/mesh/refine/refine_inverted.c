/*
   Refines coarse cells beside thin cells along curved surfaces. A hanging vertex is on the straight edge of the coarser
   cell, not on the curve, which may invert a fine cell. The coarser cell is then refined too, until no fine cell loses
   more than a fraction of its quality.
*/
#include "refineimpl.h"

/* smallest quality of a cell (MeshCellQuality) relative to the same cell with all its vertices on the curve */
#define LEAST_QUALITY 0.25

/* Computes the positions of a cell's vertices if hanging vertices are placed on the curve too */
static PetscErrorCode RefineInvertedPlaceCell(DM dm, const SceneBody bodies[], const MeshCurves *curves,
  const MeshHexes *hexes, PetscInt cell, PetscReal places[8][3])
{
  const Shape *shape;
  PetscInt     body;

  PetscFunctionBegin;
  PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, hexes->root[cell], &body));
  PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[body], &shape));
  for (PetscInt a = 0; a < 8; ++a) {
    PetscCall(PetscArraycpy(places[a], &hexes->x[3 * hexes->vertex[8 * cell + a]], 3));
    if (shape && shape->map && bodies[body].curved) PetscCall(shape->map(&bodies[body], places[a], places[a]));
  }
  PetscCall(MeshCurvesPlacePart(curves, hexes, cell, places));
  PetscFunctionReturn(0);
}

/* Computes the positions on the curves of vertices that are new. Positions of earlier vertices are kept, because a
   shape's map may be expensive. */
static PetscErrorCode RefineInvertedPlace(DM dm, const SceneBody bodies[], const MeshCurves *curves, MeshHexes *hexes)
{
  PetscReal places[8][3];

  PetscFunctionBegin;
  PetscCall(PetscRealloc(3 * hexes->nvertices * sizeof(*hexes->placed), &hexes->placed));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    const PetscInt *vertex = &hexes->vertex[8 * c];
    PetscBool       is_new = PETSC_FALSE;

    for (PetscInt a = 0; a < 8; ++a) is_new = (PetscBool)(is_new || vertex[a] >= hexes->nplaced);
    if (is_new) PetscCall(RefineInvertedPlaceCell(dm, bodies, curves, hexes, c, places));
    for (PetscInt a = 0; is_new && a < 8; ++a) {
      if (vertex[a] >= hexes->nplaced) PetscCall(PetscArraycpy(&hexes->placed[3 * vertex[a]], places[a], 3));
    }
  }
  hexes->nplaced = hexes->nvertices;
  PetscFunctionReturn(0);
}

/* Returns the quality of a cell. Vertices that hang are placed at the mean of the vertices on which they depend. If
   hangs is NULL, all vertices are on the curve. */
static PetscReal RefineInvertedQuality(const MeshHexes *hexes, const MeshQualityTable *table, PetscInt cell,
  const PetscBool hangs[])
{
  const PetscReal *x = hexes->placed;
  PetscReal        corners[8][3];

  for (PetscInt a = 0; a < 8; ++a) {
    const PetscInt v = hexes->vertex[8 * cell + a], *parent = &hexes->parent[4 * v], n = parent[2] < 0 ? 2 : 4;

    for (PetscInt d = 0; d < 3; ++d) {
      corners[a][d] = hangs && hangs[v] ? 0 : x[3 * v + d];
      for (PetscInt i = 0; hangs && hangs[v] && i < n; ++i) corners[a][d] += x[3 * parent[i] + d] / (PetscReal)n;
    }
  }
  return MeshCellQuality(table, corners);
}

/* Refines cells until the quality of all cells is sufficient. Not collective: it must be called on the rank that has
   the cells. */
PetscErrorCode MeshHexesRefineInverted(DM dm, const SceneBody bodies[], const MeshCurves *curves, MeshHexes *hexes)
{
  PetscBool        more = PETSC_TRUE;
  MeshQualityTable table;

  PetscFunctionBegin;
  PetscCall(MeshQualityTableCreate(8, &table));
  while (more) {
    PetscBool *hangs, *marked;

    PetscCall(PetscMalloc2(hexes->nvertices, &hangs, hexes->ncells, &marked));
    PetscCall(RefineInvertedPlace(dm, bodies, curves, hexes));
    PetscCall(MeshHexesFindHanging(hexes, hangs));
    for (PetscInt c = 0; c < hexes->ncells; ++c)
      marked[c] = (PetscBool)(RefineInvertedQuality(hexes, &table, c, hangs) <
                              LEAST_QUALITY * RefineInvertedQuality(hexes, &table, c, NULL));
    PetscCall(MeshHexesMarkHolders(hexes, marked, &more));
    if (more) PetscCall(MeshHexesRefine(hexes, marked));
    PetscCall(PetscFree2(hangs, marked));
  }
  PetscFunctionReturn(0);
}
