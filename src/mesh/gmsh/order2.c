/* Converts Gmsh's hexahedra with 8, 20 or 27 nodes into quadratic cells with 27 nodes, and tetrahedra with 4 or 10
   nodes into quadratic cells with 10 nodes */
#include "gmshimpl.h"

/* The position i + 3 j + 9 k of each of Gmsh's nodes: corners, edge middles, facet middles, centre */
static const PetscInt place_of[GMSH_MAX_NODES] = {0, 2, 8, 6, 18, 20, 26, 24, 1, 3, 9, 5, 11, 7, 17, 15, 19, 21, 23, 25,
  4, 10, 12, 14, 16, 22, 13};

/* For each of the first 20 nodes, the corners i + 2 j + 4 k at the ends of its edge. A corner is listed twice. */
const PetscInt GmshHexahedronEnds[20][2] = {{0, 0}, {1, 1}, {3, 3}, {2, 2}, {4, 4}, {5, 5}, {7, 7}, {6, 6}, {0, 1},
  {0, 2}, {0, 4}, {1, 3}, {1, 5}, {3, 2}, {3, 7}, {2, 6}, {4, 5}, {4, 6}, {5, 7}, {7, 6}};

/* Returns whether a node is in the middle of the cell in direction d */
static PetscBool OrderIsMiddle(PetscInt place, PetscInt d)
{
  static const PetscInt step[3] = {1, 3, 9};

  return place / step[d] % 3 == 1 ? PETSC_TRUE : PETSC_FALSE;
}

/*
   Sums the coordinates of some other nodes of a cell with 27 nodes. A node is at place 0, 1 or 2 in each of three
   directions; 1 is the middle. The sum is over the nodes that differ from the given node in exactly `ends` directions,
   if the node is in the middle in these directions and the others are at 0 or 2.
*/
static void OrderSum(const PetscReal curve[81], PetscInt place, PetscInt ends, PetscReal sum[3])
{
  sum[0] = sum[1] = sum[2] = 0;
  for (PetscInt other = 0; other < 27; ++other) {
    PetscInt  n    = 0;
    PetscBool same = PETSC_TRUE;

    for (PetscInt d = 0, step = 1; d < 3; ++d, step *= 3) {
      if (!OrderIsMiddle(place, d)) same = (PetscBool)(same && other / step % 3 == place / step % 3);
      else if (!OrderIsMiddle(other, d)) ++n;
    }
    if (!same || n != ends) continue;
    for (PetscInt d = 0; d < 3; ++d) sum[d] += curve[3 * other + d];
  }
}

/* Computes the position of a node in a straight cell: the mean of the corners around it */
static void OrderSetStraight(PetscReal curve[81], PetscInt place, PetscReal straight[3])
{
  PetscInt n = 0;

  for (PetscInt d = 0; d < 3; ++d) n += OrderIsMiddle(place, d);
  OrderSum(curve, place, n, straight);
  for (PetscInt d = 0; d < 3; ++d) straight[d] /= (PetscReal)(1 << n);
}

/* Computes a node in the middle of a facet or of the cell, which cells with 20 nodes do not have. The shape functions
   there are -1/4 at the corners, and 1/2 (facet) or 1/4 (cell) at the edge middles. */
static void OrderSetMiddle(PetscReal curve[81], PetscInt place)
{
  const PetscBool cell = (PetscBool)(place == 13);
  PetscReal       corners[3], edges[3];

  OrderSum(curve, place, cell ? 3 : 2, corners);
  OrderSum(curve, place, cell ? 2 : 1, edges);
  for (PetscInt d = 0; d < 3; ++d) curve[3 * place + d] = (cell ? 0.25 : 0.5) * edges[d] - 0.25 * corners[d];
}

/* Computes the nodes of a tetrahedron: the corners, then the edge middles. Gmsh lists the last two edge middles in the
   opposite order. */
static PetscReal OrderGetTetrahedron(PetscInt nnodes, const PetscReal x[][3], PetscReal curve[])
{
  static const PetscInt of_gmsh[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  PetscReal             straight[MESH_MAX_NODES][3], bulge = 0;

  MeshPlacesSetStraight(4, x, straight);
  for (PetscInt a = 0; a < 10; ++a) {
    const PetscReal *place    = nnodes == 10 ? x[of_gmsh[a]] : straight[a];
    PetscReal        distance = 0;

    for (PetscInt d = 0; d < 3; ++d) {
      curve[3 * a + d] = place[d];
      distance += PetscSqr(place[d] - straight[a][d]);
    }
    bulge = PetscMax(bulge, PetscSqrtReal(distance));
  }
  return bulge;
}

PetscReal GmshGetCurve(PetscInt nnodes, const PetscReal x[][3], PetscReal curve[])
{
  PetscReal bulge = 0;

  if (MeshIsTetrahedron(nnodes)) return OrderGetTetrahedron(nnodes, x, curve);
  for (PetscInt a = 0; a < nnodes; ++a) {
    for (PetscInt d = 0; d < 3; ++d) curve[3 * place_of[a] + d] = x[a][d];
  }
  for (PetscInt a = 8; a < GMSH_MAX_NODES; ++a) {
    PetscReal straight[3], distance = 0;

    OrderSetStraight(curve, place_of[a], straight);
    if (a >= nnodes && nnodes > 8) OrderSetMiddle(curve, place_of[a]);
    for (PetscInt d = 0; d < 3; ++d) {
      if (nnodes == 8) curve[3 * place_of[a] + d] = straight[d];
      distance += PetscSqr(curve[3 * place_of[a] + d] - straight[d]);
    }
    bulge = PetscMax(bulge, PetscSqrtReal(distance));
  }
  return bulge;
}
