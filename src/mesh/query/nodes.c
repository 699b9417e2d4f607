/*
   Nodes are the points of the mesh that carry a displacement. In a body of order 1 these are the vertices. In a body of
   order 2, hexahedra have 27 nodes, on vertices, edges, facets and the cell; tetrahedra have 10 nodes, on vertices and
   edges. Node i + 3 j + 9 k of a hexahedron is at the position (i, j, k)/2 of the reference cube; its vertex i + 2 j +
   4 k is at (i, j, k).
*/
#include "queryimpl.h"

/* key under which the nodes' coordinates are composed with the mesh, if not all nodes are vertices */
#define MESH_PLACES "nodes"

/* Returns whether any body has order 2 */
static PetscBool NodesIsSecond(PetscInt nbodies, const PetscInt orders[])
{
  PetscBool any = PETSC_FALSE;

  for (PetscInt b = 0; b < nbodies; ++b) any = (PetscBool)(any || orders[b] > 1);
  return any;
}

/* Creates the section: three components at every vertex; in bodies of order 2 also at every other point of hexahedra,
   and at every edge of tetrahedra. No component is constrained. */
PetscErrorCode MeshSetSection(DM dm, PetscInt nbodies, const PetscInt orders[])
{
  PetscSection section;
  PetscInt     pstart, pend, cstart, cend, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldComponents(section, 0, 3));
  if (!NodesIsSecond(nbodies, orders)) { /* a section of the vertices alone takes an eighth of the memory */
    pstart = vstart;
    pend   = vend;
  }
  PetscCall(PetscSectionSetChart(section, pstart, pend));
  for (PetscInt v = vstart; v < vend; ++v) PetscCall(PetscSectionSetDof(section, v, 3));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt b, nfacets, npoints, *closure = NULL;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    if (orders[b] < 2) continue;
    PetscCall(DMPlexGetConeSize(dm, c, &nfacets));
    PetscCall(DMPlexGetTransitiveClosure(dm, c, PETSC_TRUE, &npoints, &closure));
    for (PetscInt p = nfacets == 4 ? 1 + nfacets : 0; p < npoints; ++p)
      PetscCall(PetscSectionSetDof(section, closure[2 * p], 3));
    PetscCall(DMPlexRestoreTransitiveClosure(dm, c, PETSC_TRUE, &npoints, &closure));
  }
  for (PetscInt p = pstart; p < pend; ++p) {
    PetscInt n;

    PetscCall(PetscSectionGetDof(section, p, &n));
    if (n) PetscCall(PetscSectionSetFieldDof(section, p, 0, n));
  }
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscFunctionReturn(0);
}

/* Returns the index of a vertex among n vertices, or n if it is not among them */
static PetscInt NodesFind(PetscInt n, const PetscInt vertices[], PetscInt vertex)
{
  PetscInt a = 0;

  while (a < n && vertices[a] != vertex) ++a;
  return a;
}

/* Computes the number of the node on an edge, a facet or the cell, from the mean position of the vertices of that
   point. In a tetrahedron *place is -1 for points with more than two vertices, which carry no node. */
static PetscErrorCode NodesFindPlace(DM dm, PetscInt ncorners, const PetscInt vertices[8], PetscInt point,
  PetscInt *place)
{
  PetscInt npoints, n = 0, sum[3] = {0, 0, 0}, ends[2] = {4, -1}, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(DMPlexGetTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints; ++p) {
    const PetscInt a = NodesFind(ncorners, vertices, closure[2 * p]);

    if (a == ncorners) continue;
    for (PetscInt d = 0; d < 3; ++d) sum[d] += 2 * (a >> d & 1);
    ends[0] = PetscMin(ends[0], a);
    ends[1] = PetscMax(ends[1], a);
    ++n;
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  *place = sum[0] / n + 3 * (sum[1] / n) + 9 * (sum[2] / n);
  if (ncorners == 8) PetscFunctionReturn(0);
  for (*place = n > 2 ? -1 : 9;
       *place >= 0 && (MeshTetrahedronEnds[*place][0] != ends[0] || MeshTetrahedronEnds[*place][1] != ends[1]);)
    --*place;
  PetscFunctionReturn(0);
}

/* Determines whether the edges of a facet have values in a section */
static PetscErrorCode NodesHasEdges(DM dm, PetscSection section, PetscInt facet, PetscBool *has)
{
  const PetscInt *edges;
  PetscInt        first, last, n = 0;

  PetscFunctionBegin;
  PetscCall(DMPlexGetCone(dm, facet, &edges));
  PetscCall(PetscSectionGetChart(section, &first, &last));
  if (edges[0] >= first && edges[0] < last) PetscCall(PetscSectionGetDof(section, edges[0], &n));
  *has = (PetscBool)(n > 0);
  PetscFunctionReturn(0);
}

/* Gets the points of a cell that have values in a section: the vertices, or all nodes of order 2 */
PetscErrorCode MeshGetCellPoints(DM dm, PetscSection section, PetscInt cell, PetscInt *n,
  PetscInt points[MESH_MAX_NODES])
{
  PetscInt        vertices[8], ncorners, npoints, *closure = NULL;
  const PetscInt *facets;
  PetscBool       second;

  PetscFunctionBegin;
  PetscCall(DMPlexGetCone(dm, cell, &facets));
  PetscCall(NodesHasEdges(dm, section, facets[0], &second));
  if (!second) {
    PetscCall(MeshGetCellCorners(dm, cell, n, points));
    PetscFunctionReturn(0);
  }
  PetscCall(MeshGetCellCorners(dm, cell, &ncorners, vertices));
  *n = ncorners == 8 ? 27 : 10;
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints; ++p) {
    PetscInt place = 0;

    PetscCall(NodesFindPlace(dm, ncorners, vertices, closure[2 * p], &place));
    if (place >= 0) points[place] = closure[2 * p];
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &npoints, &closure));
  PetscFunctionReturn(0);
}

/*
   Gets the points of a cell that carry a displacement. cell: a local DMPlex point; n: number of nodes; nodes: local
   DMPlex points, at most MESH_MAX_NODES.

   - hexahedron of order 1: 8 vertices; number i + 2 j + 4 k is at the corner (i, j, k) of the reference cube
   - hexahedron of order 2: 27 vertices, edges, facets and the cell; number i + 3 j + 9 k is at (i, j, k)/2
   - tetrahedron of order 1: 4 vertices
   - tetrahedron of order 2: 10 points, the vertices and then the edges 01, 12, 02, 03, 13 and 23
*/
PetscErrorCode MeshGetCellNodes(DM dm, PetscInt cell, PetscInt *n, PetscInt nodes[MESH_MAX_NODES])
{
  PetscSection section;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetCellPoints(dm, section, cell, n, nodes));
  PetscFunctionReturn(0);
}

/*
   Gets the points of a boundary facet that carry a displacement. facet: a local DMPlex point with one cell; n: number
   of nodes; nodes: local DMPlex points, at most MESH_MAX_FACET_NODES. The vertices come first, counterclockwise seen
   from outside the body: 4, or 3 of a triangle. In a body of order 2 the edges follow, edge e from vertex e to the
   next, and then the facet itself unless it is a triangle: 9 nodes, or 6 of a triangle.
*/
PetscErrorCode MeshGetFacetNodes(DM dm, PetscInt facet, PetscInt *n, PetscInt nodes[MESH_MAX_FACET_NODES])
{
  PetscSection    section;
  const PetscInt *edges, *ends;
  PetscInt        nedges;
  PetscBool       second;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(NodesHasEdges(dm, section, facet, &second));
  PetscCall(DMPlexGetConeSize(dm, facet, &nedges));
  PetscCall(MeshGetFacetVertices(dm, facet, nodes));
  *n = nedges;
  if (!second) PetscFunctionReturn(0);
  *n = nedges == 4 ? 9 : 6;
  PetscCall(DMPlexGetCone(dm, facet, &edges));
  for (PetscInt e = 0; e < nedges; ++e) {
    PetscInt a, b;

    PetscCall(DMPlexGetCone(dm, edges[e], &ends));
    a                                               = NodesFind(nedges, nodes, ends[0]);
    b                                               = NodesFind(nedges, nodes, ends[1]);
    nodes[nedges + ((a + 1) % nedges == b ? a : b)] = edges[e];
  }
  if (nedges == 4) nodes[8] = facet;
  PetscFunctionReturn(0);
}

/*
   Gets the facets into which the nodes of a boundary facet divide it. facet: a local DMPlex point with one cell; n:
   number of pieces: 1, the facet itself, or 4 in a body of order 2; pieces: the four nodes of each piece, local DMPlex
   points, counterclockwise seen from outside the body. A piece of a quadrilateral of order 2 consists of vertex, edge,
   facet and edge. A triangular piece has its last node twice. A triangle of order 2 is divided into three pieces of
   vertex, edge and edge, and one piece of the three edges.
*/
PetscErrorCode MeshGetFacetPieces(DM dm, PetscInt facet, PetscInt *n, PetscInt pieces[MESH_MAX_FACET_PIECES][4])
{
  PetscInt nnodes, nodes[MESH_MAX_FACET_NODES];

  PetscFunctionBegin;
  PetscCall(MeshGetFacetNodes(dm, facet, &nnodes, nodes));
  *n = nnodes > 4 ? 4 : 1;
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscInt quarter[4]  = {nodes[a], nodes[4 + a], nodes[8], nodes[4 + (a + 3) % 4]};
    const PetscInt triangle[4] = {nodes[a < 3 ? a : 3], nodes[a < 3 ? 3 + a : 4], nodes[3 + (a + 2) % 3],
      nodes[3 + (a + 2) % 3]};

    if (nnodes <= 4) pieces[0][a] = nodes[a];
    else PetscCall(PetscArraycpy(pieces[a], nnodes == 9 ? quarter : triangle, 4));
  }
  PetscFunctionReturn(0);
}

/*
   Gets the undeformed coordinates of all nodes of this rank. places: a local vector with the layout of displacements, 3
   coordinates per node [length], owned by the mesh. If no body has order 2, it is the coordinate vector of the DMPlex.
*/
PetscErrorCode MeshGetNodeCoordinates(DM dm, Vec *places)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)dm, MESH_PLACES, (PetscObject *)places));
  if (!*places) PetscCall(DMGetCoordinatesLocal(dm, places));
  PetscFunctionReturn(0);
}

/*@
  MeshGetBodyNodes - Gets the number of nodes of a cell of every body

  Collective

  Input Parameters:
+ dm      - mesh from `MeshCreate()`
- nbodies - number of bodies

  Output Parameter:
. nnodes - number of nodes of each cell of a body, equal on all ranks: 8 or 27 for hexahedra of order 1 or 2, 4 or 10
           for tetrahedra

  Level: intermediate

.seealso: `MeshCreate()`
@*/
PetscErrorCode MeshGetBodyNodes(DM dm, PetscInt nbodies, PetscInt nnodes[])
{
  PetscInt cstart, cend, unknown = nbodies;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(nnodes, nbodies));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend && unknown; ++c) {
    PetscInt b, n, nodes[MESH_MAX_NODES];

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    if (b < 0 || b >= nbodies || nnodes[b]) continue;
    PetscCall(MeshGetCellNodes(dm, c, &n, nodes));
    nnodes[b] = n;
    --unknown;
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, nnodes, (PetscMPIInt)nbodies, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Gets the coordinates and the section of all nodes (`nodes` is true), or of the vertices only */
PetscErrorCode MeshGetPlaces(DM dm, PetscBool nodes, MeshPlaces *places)
{
  PetscFunctionBegin;
  if (nodes) {
    PetscCall(DMGetLocalSection(dm, &places->section));
    PetscCall(MeshGetNodeCoordinates(dm, &places->x));
  } else {
    PetscCall(DMGetCoordinateSection(dm, &places->section));
    PetscCall(DMGetCoordinatesLocal(dm, &places->x));
  }
  PetscFunctionReturn(0);
}

/* Computes the nodes of a straight cell of order 2 from its corners: 27 by trilinear interpolation, or 10 for a
   tetrahedron */
void MeshPlacesSetStraight(PetscInt ncorners, const PetscReal corners[][3], PetscReal places[MESH_MAX_NODES][3])
{
  for (PetscInt i = 0; ncorners == 4 && i < 30; ++i)
    places[i / 3][i % 3] =
      0.5 * (corners[MeshTetrahedronEnds[i / 3][0]][i % 3] + corners[MeshTetrahedronEnds[i / 3][1]][i % 3]);
  for (PetscInt i = 0; ncorners == 8 && i < 27; ++i) {
    const PetscReal at[3] = {0.5 * (PetscReal)(i % 3), 0.5 * (PetscReal)(i / 3 % 3), 0.5 * (PetscReal)(i / 9)};

    places[i][0] = places[i][1] = places[i][2] = 0;
    for (PetscInt a = 0; a < 8; ++a) {
      PetscReal weight = 1;

      for (PetscInt d = 0; d < 3; ++d) weight *= a >> d & 1 ? at[d] : 1 - at[d];
      for (PetscInt d = 0; d < 3; ++d) places[i][d] += weight * corners[a][d];
    }
  }
}

/* Computes the coordinates of all nodes from the vertices of their straight cells */
static PetscErrorCode NodesFillCells(DM dm, PetscScalar x[])
{
  PetscSection section;
  PetscInt     cstart, cend;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt  n, ncorners, nodes[MESH_MAX_NODES], vertices[8];
    PetscReal corners[8][3], places[MESH_MAX_NODES][3];

    PetscCall(MeshGetCellNodes(dm, c, &n, nodes));
    PetscCall(MeshGetCellCorners(dm, c, &ncorners, vertices));
    PetscCall(MeshGetVertexCoordinates(dm, ncorners, vertices, corners));
    if (n > ncorners) MeshPlacesSetStraight(ncorners, (const PetscReal(*)[3])corners, places);
    for (PetscInt a = 0; a < n; ++a) {
      const PetscReal *place = n > ncorners ? places[a] : corners[a];
      PetscInt         offset;

      PetscCall(PetscSectionGetOffset(section, nodes[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscFunctionReturn(0);
}

/* Creates the coordinate vector of the nodes, if any body has order 2 */
PetscErrorCode MeshCreateNodes(DM dm, PetscInt nbodies, const PetscInt orders[])
{
  PetscSection section;
  Vec          places;
  PetscScalar *x;
  PetscInt     n;

  PetscFunctionBegin;
  if (!NodesIsSecond(nbodies, orders)) PetscFunctionReturn(0);
  /* This is a plain vector, because a vector of the mesh would hold a reference to the mesh with which it is
     composed. */
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(PetscSectionGetStorageSize(section, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &places));
  PetscCall(VecSetBlockSize(places, 3));
  PetscCall(VecGetArray(places, &x));
  PetscCall(NodesFillCells(dm, x));
  PetscCall(VecRestoreArray(places, &x));
  PetscCall(PetscObjectCompose((PetscObject)dm, MESH_PLACES, (PetscObject)places));
  PetscCall(VecDestroy(&places));
  PetscFunctionReturn(0);
}

/* Copies the coordinates of the vertices from those of the nodes to the DMPlex, after the nodes were moved */
PetscErrorCode MeshUpdateVertices(DM dm)
{
  MeshPlaces         from, to;
  const PetscScalar *x;
  PetscScalar       *y;
  PetscInt           vstart, vend;

  PetscFunctionBegin;
  PetscCall(MeshGetPlaces(dm, PETSC_TRUE, &from));
  PetscCall(MeshGetPlaces(dm, PETSC_FALSE, &to));
  if (from.x != to.x) {
    PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
    PetscCall(VecGetArrayRead(from.x, &x));
    PetscCall(VecGetArray(to.x, &y));
    for (PetscInt v = vstart; v < vend; ++v) {
      PetscInt i, j;

      PetscCall(PetscSectionGetOffset(from.section, v, &i));
      PetscCall(PetscSectionGetOffset(to.section, v, &j));
      for (PetscInt d = 0; d < 3; ++d) y[j + d] = x[i + d];
    }
    PetscCall(VecRestoreArray(to.x, &y));
    PetscCall(VecRestoreArrayRead(from.x, &x));
  }
  /* This discards the global coordinates, which are out of date. */
  PetscCall(DMSetCoordinatesLocal(dm, to.x));
  PetscFunctionReturn(0);
}
