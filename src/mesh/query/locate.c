/*
   Finds the cell that contains a point. The points are sorted into the bins of a grid, which is finer where the points
   are denser. For each cell the points in nearby bins are tested. The parameters of a point in the cell are computed by
   inverting the cell's linear or quadratic map, and limited to the cell. The point is assigned to the nearest cell over
   all ranks.
*/
#include "queryimpl.h"
#include <vector3.h>

/* largest distance of a point from its cell, relative to the cell's size. Curved surfaces may lie outside of the
   facets. */
static const PetscReal locate_margin = 0.25;

/* Points sorted into bins. Bin b contains the points order[start[b]] to order[start[b + 1] - 1]. Bin i along axis d
   begins at the coordinate first[d][i] [length]. */
typedef struct {
  PetscInt   n[3], *start, *order;
  PetscReal *first[3];
} LocateBins;

/* Returns the last bin along axis d that begins at or below the coordinate x, or the first bin if there is none */
static PetscInt LocateBin(const LocateBins *bins, PetscInt d, PetscReal x)
{
  PetscInt low = 0, high = bins->n[d];

  while (high - low > 1) {
    const PetscInt middle = (low + high) / 2;

    if (bins->first[d][middle] <= x) low = middle;
    else high = middle;
  }
  return low;
}

/* Returns the number of the bin that contains the point x */
static PetscInt LocateBinOfPoint(const LocateBins *bins, const PetscReal x[3])
{
  return (LocateBin(bins, 2, x[2]) * bins->n[1] + LocateBin(bins, 1, x[1])) * bins->n[0] + LocateBin(bins, 0, x[0]);
}

/* Divides axis d into at most nbins bins with equal numbers of points, so that bins are narrow where a mesh is
   graded */
static PetscErrorCode LocateBinsPart(PetscInt npoints, const PetscReal points[][3], PetscInt nbins, PetscInt d,
  LocateBins *bins)
{
  PetscReal *sorted;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(npoints, &sorted));
  PetscCall(PetscCalloc1(nbins, &bins->first[d]));
  for (PetscInt i = 0; i < npoints; ++i) sorted[i] = points[i][d];
  PetscCall(PetscSortReal(npoints, sorted));
  bins->n[d] = 1;
  for (PetscInt b = 1; b < nbins; ++b) {
    const PetscReal first = sorted[(PetscInt)((PetscInt64)b * npoints / nbins)];

    if (first > sorted[0] && (bins->n[d] == 1 || first > bins->first[d][bins->n[d] - 1]))
      bins->first[d][bins->n[d]++] = first;
  }
  PetscCall(PetscFree(sorted));
  PetscFunctionReturn(0);
}

/* Creates bins with about one point per bin */
static PetscErrorCode LocateBinsCreate(PetscInt npoints, const PetscReal points[][3], LocateBins *bins)
{
  const PetscInt side = 1 + (PetscInt)PetscCbrtReal((PetscReal)npoints);
  PetscInt       nbins;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) PetscCall(LocateBinsPart(npoints, points, npoints ? side : 1, d, bins));
  nbins = bins->n[0] * bins->n[1] * bins->n[2];
  PetscCall(PetscCalloc1(nbins + 1, &bins->start));
  PetscCall(PetscMalloc1(npoints, &bins->order));
  for (PetscInt i = 0; i < npoints; ++i) ++bins->start[LocateBinOfPoint(bins, points[i])];
  for (PetscInt b = 0, sum = 0; b <= nbins; ++b) {
    sum += bins->start[b];
    bins->start[b] = sum;
  }
  for (PetscInt i = npoints - 1; i >= 0; --i) bins->order[--bins->start[LocateBinOfPoint(bins, points[i])]] = i;
  PetscFunctionReturn(0);
}

static PetscErrorCode LocateBinsDestroy(LocateBins *bins)
{
  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) PetscCall(PetscFree(bins->first[d]));
  PetscCall(PetscFree(bins->start));
  PetscCall(PetscFree(bins->order));
  PetscFunctionReturn(0);
}

/* Computes the shape functions L of a line on [-1, 1] with 2 or 3 nodes (width), and their derivatives s */
static void LocateLine(PetscInt width, PetscReal xi, PetscReal L[3], PetscReal s[3])
{
  L[0]         = width == 2 ? 0.5 - 0.5 * xi : 0.5 * xi * (xi - 1);
  L[1]         = (1 - xi) * (1 + xi);
  L[width - 1] = width == 2 ? 0.5 + 0.5 * xi : 0.5 * xi * (xi + 1);
  s[0]         = width == 2 ? -0.5 : xi - 0.5;
  s[1]         = -2 * xi;
  s[width - 1] = width == 2 ? 0.5 : xi + 0.5;
}

/* Computes the shape functions N of a cell with n nodes at the point xi of the reference cube or tetrahedron, and their
   derivatives dN */
void MeshCellShape(PetscInt n, const PetscReal xi[3], PetscReal N[], PetscReal dN[3][MESH_MAX_NODES])
{
  const PetscInt width = n == 8 ? 2 : 3;
  PetscReal      L[3][3], s[3][3];

  if (MeshIsTetrahedron(n)) {
    MeshTetrahedronShape(n, xi, N, dN);
    return;
  }
  for (PetscInt d = 0; d < 3; ++d) LocateLine(width, xi[d], L[d], s[d]);
  for (PetscInt a = 0; a < n; ++a) {
    const PetscInt i = a % width, j = a / width % width, k = a / (width * width);

    N[a]     = L[0][i] * L[1][j] * L[2][k];
    dN[0][a] = s[0][i] * L[1][j] * L[2][k];
    dN[1][a] = L[0][i] * s[1][j] * L[2][k];
    dN[2][a] = L[0][i] * L[1][j] * s[2][k];
  }
}

/* Computes r, the vector from X(xi) to the point [length], and the Jacobian matrix J[d][k] = dX_d/dxi_k */
static void LocateDifference(PetscInt n, PetscReal X[][3], const PetscReal point[3], const PetscReal xi[3],
  PetscReal N[], PetscReal r[3], PetscReal J[3][3])
{
  PetscReal dN[3][MESH_MAX_NODES];

  MeshCellShape(n, xi, N, dN);
  for (PetscInt d = 0; d < 3; ++d) {
    r[d] = point[d];
    for (PetscInt k = 0; k < 3; ++k) J[d][k] = 0;
    for (PetscInt a = 0; a < n; ++a) {
      r[d] -= N[a] * X[a][d];
      for (PetscInt k = 0; k < 3; ++k) J[d][k] += dN[k][a] * X[a][d];
    }
  }
}

/* Limits the parameters to the reference tetrahedron: none is negative, and their sum is at most 1 */
static void LocateClampTetrahedron(PetscReal xi[3])
{
  PetscReal sum = 0;

  for (PetscInt k = 0; k < 3; ++k) sum += xi[k] = PetscMax(xi[k], 0.0);
  for (PetscInt k = 0; sum > 1 && k < 3; ++k) xi[k] /= sum;
}

/*
   Inverts the cell's map by Newton's method. The iterates are limited to a cube somewhat larger than the cell, and the
   result is limited to the cell. Returns the distance of the point from the cell [length]. N: shape functions at the
   result
*/
static PetscReal LocateInCell(PetscInt n, PetscReal X[][3], const PetscReal point[3], PetscReal N[])
{
  const PetscBool tetrahedron = MeshIsTetrahedron(n);
  const PetscReal middle      = tetrahedron ? 0.25 : 0.0;
  PetscReal       xi[3]       = {middle, middle, middle}, r[3], J[3][3], step[3];

  for (PetscInt it = 0; it < 30; ++it) {
    PetscReal change = 0;

    LocateDifference(n, X, point, xi, N, r, J);
    (void)MatrixSolve(J, r, step);
    for (PetscInt k = 0; k < 3; ++k) {
      const PetscReal next = PetscMax(-2.0, PetscMin(2.0, xi[k] + step[k]));

      change = PetscMax(change, PetscAbsReal(next - xi[k]));
      xi[k]  = next;
    }
    if (!(change > 8 * PETSC_MACHINE_EPSILON)) break;
  }
  if (tetrahedron) LocateClampTetrahedron(xi);
  for (PetscInt k = 0; k < 3; ++k) xi[k] = PetscMax(-1.0, PetscMin(1.0, xi[k]));
  LocateDifference(n, X, point, xi, N, r, J);
  return VectorNorm(r);
}

/* Computes the bounding box of a cell's nodes, enlarged by a margin. Returns the diagonal of the box without the margin
   [length]. */
static PetscReal LocateBox(PetscInt n, PetscReal X[][3], PetscReal lower[3], PetscReal upper[3])
{
  PetscReal diagonal[3], size;

  for (PetscInt d = 0; d < 3; ++d) {
    lower[d] = upper[d] = X[0][d];
    for (PetscInt a = 1; a < n; ++a) {
      lower[d] = PetscMin(lower[d], X[a][d]);
      upper[d] = PetscMax(upper[d], X[a][d]);
    }
    diagonal[d] = upper[d] - lower[d];
  }
  size = VectorNorm(diagonal);
  for (PetscInt d = 0; d < 3; ++d) {
    lower[d] -= locate_margin * size;
    upper[d] += locate_margin * size;
  }
  return size;
}

struct _n_MeshLocator {
  PetscInt n;
  const PetscReal (*points)[3];
  const PetscInt *body;
  LocateBins      bins;
  MeshPlace      *places;
};

/*
   Creates a locator, which finds the cells that contain n given points. points: their coordinates [length], used until
   the locator is destroyed; body: the body in which each point is searched for, PETSC_DECIDE for any body, also used
   until then
*/
PetscErrorCode MeshLocatorCreate(PetscInt n, const PetscReal points[][3], const PetscInt body[], MeshLocator *locator)
{
  PetscFunctionBegin;
  PetscCall(PetscNew(locator));
  (*locator)->n      = n;
  (*locator)->points = points;
  (*locator)->body   = body;
  PetscCall(LocateBinsCreate(n, points, &(*locator)->bins));
  PetscCall(PetscMalloc1(n, &(*locator)->places));
  for (PetscInt i = 0; i < n; ++i) (*locator)->places[i] = (MeshPlace){.distance = PETSC_MAX_REAL, .cell = -1};
  PetscFunctionReturn(0);
}

/* Stores the position of point i in a cell if the cell is nearer than all earlier cells. If two distances are equal up
   to rounding, the body with the smaller number is preferred. */
static void LocatorTry(MeshLocator locator, PetscInt i, MeshPlace place, PetscReal X[][3])
{
  MeshPlace      *nearest = &locator->places[i];
  const PetscReal rounding =
    MODEL_ROUNDING * place.size * (PetscReal)((place.body < nearest->body) - (place.body > nearest->body));

  /* The point is inside an earlier cell already. */
  if (nearest->distance <= 1e-14 * place.size && nearest->body <= place.body) return;
  place.distance = LocateInCell(place.n, X, locator->points[i], place.N);
  if (place.distance < nearest->distance + rounding) *nearest = place;
}

/*
   Tests which points are in a cell or near it. cell: number of the cell; body: its body; n: number of its nodes (8 or
   27 for a hexahedron, 4 or 10 for a tetrahedron); X: their coordinates, in the order of MeshGetCellNodes() [length]. A
   point is assigned to the nearest cell. Among equally near cells, the body with the smallest number is preferred, then
   the first cell that was added. Cells farther away than a quarter of their size are ignored.
*/
PetscErrorCode MeshLocatorAddCell(MeshLocator locator, PetscInt cell, PetscInt body, PetscInt n, PetscReal X[][3])
{
  const LocateBins *bins = &locator->bins;
  PetscReal         lower[3], upper[3];
  const PetscReal   size = LocateBox(n, X, lower, upper);
  PetscInt          from[3], to[3];

  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) {
    from[d] = LocateBin(bins, d, lower[d]);
    to[d]   = LocateBin(bins, d, upper[d]);
  }
  for (PetscInt k = from[2]; k <= to[2]; ++k) {
    for (PetscInt j = from[1]; j <= to[1]; ++j) {
      const PetscInt row = (k * bins->n[1] + j) * bins->n[0];

      for (PetscInt o = bins->start[row + from[0]]; o < bins->start[row + to[0] + 1]; ++o) {
        const PetscInt   i     = bins->order[o];
        const PetscReal *point = locator->points[i];
        PetscBool        near  = (PetscBool)(locator->body[i] == PETSC_DECIDE || locator->body[i] == body);

        for (PetscInt d = 0; d < 3; ++d) near = (PetscBool)(near && point[d] >= lower[d] && point[d] <= upper[d]);
        if (near) LocatorTry(locator, i, (MeshPlace){.cell = cell, .body = body, .size = size, .n = n}, X);
      }
    }
  }
  PetscFunctionReturn(0);
}

/* Gets the position of each point in the cells added so far. places: one entry per point, owned by the locator. The
   number of its cell is negative if no cell is near. */
PetscErrorCode MeshLocatorGetPlaces(MeshLocator locator, const MeshPlace **places)
{
  PetscFunctionBegin;
  *places = locator->places;
  PetscFunctionReturn(0);
}

PetscErrorCode MeshLocatorDestroy(MeshLocator *locator)
{
  PetscFunctionBegin;
  PetscCall(LocateBinsDestroy(&(*locator)->bins));
  PetscCall(PetscFree((*locator)->places));
  PetscCall(PetscFree(*locator));
  PetscFunctionReturn(0);
}

/* Collective. Selects for each point the rank with the nearest position. Among equal distances, the body with the
   smallest number is preferred, then the first rank. */
static PetscErrorCode LocateChooseRank(MPI_Comm comm, PetscInt n, MeshPlace places[])
{
  PetscMPIInt rank;
  double     *distance;
  struct {
    double body;
    int    rank;
  } * first;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscMalloc2(n, &distance, n, &first));
  for (PetscInt i = 0; i < n; ++i) distance[i] = (double)places[i].distance;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, distance, (PetscMPIInt)n, MPI_DOUBLE, MPI_MIN, comm));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscBool nearest =
      (PetscBool)(places[i].cell >= 0 &&
                  (double)places[i].distance <= distance[i] + MODEL_ROUNDING * (double)places[i].size);

    first[i].body = nearest ? (double)places[i].body : PETSC_MAX_REAL;
    first[i].rank = rank;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, first, (PetscMPIInt)n, MPI_DOUBLE_INT, MPI_MINLOC, comm));
  for (PetscInt i = 0; i < n; ++i) {
    places[i].distance = (PetscReal)distance[i];
    if (first[i].rank != rank) places[i].cell = -1;
  }
  PetscCall(PetscFree2(distance, first));
  PetscFunctionReturn(0);
}

/*
   Collective. Finds the cells that contain points of the undeformed bodies.

   - points: the n points, equal on all ranks [length]
   - body: the body in which each point is searched for; PETSC_DECIDE: any body
   - places: one entry per point. Its cell is a local DMPlex point on one rank and negative on the other ranks. Its
     distance from the cell is equal on all ranks, and PETSC_MAX_REAL if no cell is near.

   A point on a curved surface may lie outside the facets. It gets the nearest position in a neighbouring cell.
*/
PetscErrorCode MeshLocate(DM dm, PetscInt n, const PetscReal points[][3], const PetscInt body[], MeshPlace places[])
{
  MeshLocator        locator;
  const MeshPlace   *found;
  DMLabel            label;
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *x;
  PetscInt           cstart, cend;

  PetscFunctionBegin;
  PetscCall(MeshLocatorCreate(n, points, body, &locator));
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &label));
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt  b, nnodes, nodes[MESH_MAX_NODES];
    PetscReal X[MESH_MAX_NODES][3];

    PetscCall(DMLabelGetValue(label, c, &b));
    PetscCall(MeshGetCellNodes(dm, c, &nnodes, nodes));
    for (PetscInt a = 0; a < nnodes; ++a) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(section, nodes[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) X[a][d] = PetscRealPart(x[offset + d]);
    }
    PetscCall(MeshLocatorAddCell(locator, c, b, nnodes, X));
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(MeshLocatorGetPlaces(locator, &found));
  PetscCall(PetscArraycpy(places, found, n));
  PetscCall(MeshLocatorDestroy(&locator));
  PetscCall(LocateChooseRank(PetscObjectComm((PetscObject)dm), n, places));
  PetscFunctionReturn(0);
}
