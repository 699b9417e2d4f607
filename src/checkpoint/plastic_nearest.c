/*
   Plastic strains on another mesh: a quadrature point takes those of the nearest point of the file in the same body.
   The points of the file are sorted into a grid of boxes. The boxes are searched in rings around the point.
*/
#include "checkpointimpl.h"

/* Finds the box that contains `place`, or the nearest one */
static void PlasticGridGetBox(const PlasticGrid *grid, const PetscReal place[3], PetscInt box[3])
{
  for (int d = 0; d < 3; ++d)
    box[d] = (PetscInt)PetscClipInterval(PetscFloorReal((place[d] - grid->lower[d]) / grid->size), 0, grid->n[d] - 1);
}

static PetscInt PlasticGridIndex(const PlasticGrid *grid, const PetscInt box[3])
{
  return (box[2] * grid->n[1] + box[1]) * grid->n[0] + box[0];
}

/*
   Chooses a grid with about as many boxes as records. A side that is shorter than the fraction `flat` of the longest
   one is replaced by that fraction.
*/
static void PlasticGridSetSize(PetscInt n, const PetscReal places[], PlasticGrid *grid)
{
  const PetscReal flat    = 1e-3;
  PetscReal       side[3] = {0, 0, 0}, longest = 0, volume = 1;

  for (int d = 0; d < 3; ++d) {
    PetscReal upper = places[d];

    grid->lower[d] = places[d];
    for (PetscInt i = 1; i < n; ++i) {
      grid->lower[d] = PetscMin(grid->lower[d], places[4 * i + d]);
      upper          = PetscMax(upper, places[4 * i + d]);
    }
    side[d] = upper - grid->lower[d];
    longest = PetscMax(longest, side[d]);
  }
  for (int d = 0; d < 3; ++d) volume *= PetscMax(side[d], flat * longest);
  grid->size = longest > 0 ? PetscCbrtReal(volume / n) : 1;
  for (int d = 0; d < 3; ++d) grid->n[d] = 1 + (PetscInt)PetscFloorReal(side[d] / grid->size);
}

/* Not collective. places: coordinates and body of n > 0 records, borrowed until PlasticGridDestroy() */
PetscErrorCode PlasticGridCreate(PetscInt n, const PetscReal places[], PlasticGrid *grid)
{
  PetscInt nboxes;

  PetscFunctionBegin;
  PlasticGridSetSize(n, places, grid);
  grid->places = places;
  nboxes       = grid->n[0] * grid->n[1] * grid->n[2];
  PetscCall(PetscCalloc2(nboxes + 2, &grid->first, n, &grid->records));
  for (int pass = 0; pass < 2; ++pass) {
    for (PetscInt i = 0; i < n; ++i) {
      PetscInt box[3], *next;

      PlasticGridGetBox(grid, places + 4 * i, box);
      next = &grid->first[PlasticGridIndex(grid, box) + (pass ? 1 : 2)];
      if (pass) grid->records[*next] = i;
      ++*next;
    }
    for (PetscInt b = 2; !pass && b < nboxes + 2; ++b) grid->first[b] += grid->first[b - 1];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PlasticGridDestroy(PlasticGrid *grid)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(grid->first, grid->records));
  PetscFunctionReturn(0);
}

/* Searches one box. square: squared distance of the nearest record so far [length^2] */
static void PlasticGridSearchBox(const PlasticGrid *grid, PetscInt box, const PetscReal place[4], PetscReal *square,
  PetscInt *nearest)
{
  for (PetscInt k = grid->first[box]; k < grid->first[box + 1]; ++k) {
    const PetscReal *other    = grid->places + 4 * grid->records[k];
    PetscReal        distance = 0;

    for (int d = 0; d < 3; ++d) distance += PetscSqr(other[d] - place[d]);
    if (other[3] != place[3] || distance >= *square) continue;
    *square  = distance;
    *nearest = grid->records[k];
  }
}

/*
   Returns the record of the body of `place` that is nearest to it and nearer than *square, which becomes its squared
   distance [length^2]; PETSC_DECIDE if there is none.
*/
PetscInt PlasticGridFind(const PlasticGrid *grid, const PetscReal place[4], PetscReal *square)
{
  const PetscInt most    = PetscMax(grid->n[0], PetscMax(grid->n[1], grid->n[2]));
  PetscInt       nearest = PETSC_DECIDE, middle[3], box[3];

  PlasticGridGetBox(grid, place, middle);
  for (PetscInt ring = 0; ring < most && (ring < 2 || PetscSqr((ring - 1) * grid->size) < *square); ++ring) {
    for (box[2] = PetscMax(0, middle[2] - ring); box[2] <= PetscMin(grid->n[2] - 1, middle[2] + ring); ++box[2]) {
      for (box[1] = PetscMax(0, middle[1] - ring); box[1] <= PetscMin(grid->n[1] - 1, middle[1] + ring); ++box[1]) {
        const PetscBool edge =
          (PetscBool)(PetscMax(PetscAbsInt(box[2] - middle[2]), PetscAbsInt(box[1] - middle[1])) == ring);

        for (box[0] = middle[0] - ring; box[0] <= middle[0] + ring; box[0] += edge || !ring ? 1 : 2 * ring) {
          if (box[0] >= 0 && box[0] < grid->n[0])
            PlasticGridSearchBox(grid, PlasticGridIndex(grid, box), place, square, &nearest);
        }
      }
    }
  }
  return nearest;
}
