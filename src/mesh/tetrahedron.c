/* Tetrahedra of 4 and of 10 nodes: the corners, then the middles of the edges, as VTK has them */
#include "meshimpl.h"

const PetscInt MeshTetrahedronEnds[10][2] = {
  {0, 0},
  {1, 1},
  {2, 2},
  {3, 3},
  {0, 1},
  {1, 2},
  {0, 2},
  {0, 3},
  {1, 3},
  {2, 3}};

/* Place of a node on the reference tetrahedron, whose corners are the origin and the ends of the unit vectors */
void MeshTetrahedronPlace(PetscInt node, PetscReal xi[3])
{
  for (PetscInt d = 0; d < 3; ++d) xi[d] = 0.5 * ((MeshTetrahedronEnds[node][0] == d + 1 ? 1 : 0) + (MeshTetrahedronEnds[node][1] == d + 1 ? 1 : 0));
}

/*@
  MeshTetrahedronShape - Evaluates the shape functions of a tetrahedron

  Not Collective

  Input Parameters:
+ n  - its nodes: 4, or 10
- xi - a place on the reference tetrahedron, whose corners are the origin and the ends of the unit vectors

  Output Parameters:
+ N  - values of the n shape functions
- dN - their derivatives by the three parameters

  Level: developer

  Notes:
  With barycentric coordinates l, they are l_a at the corners of 4 nodes; of 10, l_a (2 l_a - 1) there, and 4 l_a l_b at the middle of the edge from a to b.

.seealso: `MeshGetCellNodes()`
@*/
void MeshTetrahedronShape(PetscInt n, const PetscReal xi[3], PetscReal N[], PetscReal dN[3][MESH_MAX_NODES])
{
  const PetscReal l[4] = {1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};

  for (PetscInt a = 0; a < n; ++a) {
    const PetscInt  p = MeshTetrahedronEnds[a][0], q = MeshTetrahedronEnds[a][1];
    const PetscReal slope = n == 4 ? 1 : 4 * l[p] - 1;

    N[a] = n == 4 ? l[p] : p == q ? l[p] * (2 * l[p] - 1)
                                  : 4 * l[p] * l[q];
    for (PetscInt d = 0; d < 3; ++d) {
      const PetscReal dp = p ? (p == d + 1 ? 1 : 0) : -1, dq = q ? (q == d + 1 ? 1 : 0) : -1;

      dN[d][a] = p == q ? slope * dp : 4 * (dp * l[q] + l[p] * dq);
    }
  }
}
