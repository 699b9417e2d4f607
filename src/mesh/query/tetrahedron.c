/* Tetrahedra with 4 and with 10 nodes: the corners, then the middles of the edges, in the order of VTK */
#include "queryimpl.h"

/* the two corners between which each node is the middle; a corner is listed twice */
const PetscInt MeshTetrahedronEnds[10][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3},
  {2, 3}};

/* Computes the position of a node in the reference tetrahedron, whose corners are the origin and the ends of the unit
   vectors */
void MeshTetrahedronPlace(PetscInt node, PetscReal xi[3])
{
  for (PetscInt d = 0; d < 3; ++d)
    xi[d] = 0.5 * ((MeshTetrahedronEnds[node][0] == d + 1 ? 1 : 0) + (MeshTetrahedronEnds[node][1] == d + 1 ? 1 : 0));
}

/*
   Evaluates the n shape functions N of a tetrahedron with n nodes, 4 or 10, at the position xi in the reference
   tetrahedron, and their derivatives dN with respect to the three parameters. With barycentric coordinates l, the
   functions of 4 nodes are l_a. The functions of 10 nodes are l_a (2 l_a - 1) at the corners, and 4 l_a l_b at the
   middle of the edge from a to b.
*/
void MeshTetrahedronShape(PetscInt n, const PetscReal xi[3], PetscReal N[], PetscReal dN[3][MESH_MAX_NODES])
{
  const PetscReal l[4] = {1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};

  for (PetscInt a = 0; a < n; ++a) {
    const PetscInt  p = MeshTetrahedronEnds[a][0], q = MeshTetrahedronEnds[a][1];
    const PetscReal slope = n == 4 ? 1 : 4 * l[p] - 1;

    N[a] = n == 4 ? l[p] : p == q ? l[p] * (2 * l[p] - 1) : 4 * l[p] * l[q];
    for (PetscInt d = 0; d < 3; ++d) {
      const PetscReal dp = p ? (p == d + 1 ? 1 : 0) : -1, dq = q ? (q == d + 1 ? 1 : 0) : -1;

      dN[d][a] = p == q ? slope * dp : 4 * (dp * l[q] + l[p] * dq);
    }
  }
}

/* Quadrature points whose barycentric coordinates are permutations of each other */
typedef struct {
  PetscInt  n;
  PetscReal place, weight; /* a barycentric coordinate that all points of the orbit have at least twice; weight of
                              each point relative to the volume */
} TetrahedronOrbit;

/* Computes point i of an orbit of n points. In an orbit of 4, three coordinates are `place` and one is 1 - 3 place. In
   an orbit of 6, two are `place` and two are 1/2 - place. */
static void TetrahedronOrbitPoint(const TetrahedronOrbit *orbit, PetscInt i, PetscReal xi[3])
{
  const PetscReal other = orbit->n == 4 ? 1 - 3 * orbit->place : 0.5 - orbit->place;
  const PetscInt  p     = orbit->n == 4 ? i : MeshTetrahedronEnds[4 + i][0],
                 q      = orbit->n == 4 ? i : MeshTetrahedronEnds[4 + i][1];

  for (PetscInt d = 0; d < 3; ++d) xi[d] = p == d + 1 || q == d + 1 ? other : orbit->place;
}

/*
   Gets the quadrature rule for a tetrahedron with 4 or 10 nodes. npoints: number of points, 4 or 14; xi: their
   positions in the reference tetrahedron; weight: their weights, whose sum is the volume 1/6. The rule is exact to
   degree 2 for 4 nodes, and to degree 5 for 10 nodes. Reference: N. J. Walkington, Quadrature on simplices of arbitrary
   dimension, 2000.
*/
void MeshTetrahedronRule(PetscInt nnodes, PetscInt *npoints, PetscReal xi[][3], PetscReal weight[])
{
  static const TetrahedronOrbit second[1] = {{4, 0.13819660112501051518, 0.25}};
  static const TetrahedronOrbit fifth[3]  = {{4, 0.31088591926330060980, 0.11268792571801585080},
     {4, 0.09273525031089122640, 0.073493043116361949544}, {6, 0.04550370412564964949, 0.042546020777081466438}};
  const TetrahedronOrbit       *orbits    = nnodes == 4 ? second : fifth;

  *npoints = 0;
  for (PetscInt k = 0; k < (nnodes == 4 ? 1 : 3); ++k) {
    for (PetscInt i = 0; i < orbits[k].n; ++i, ++*npoints) {
      TetrahedronOrbitPoint(&orbits[k], i, xi[*npoints]);
      weight[*npoints] = orbits[k].weight / 6;
    }
  }
}
