/* Points of isoparametric hexahedra of 8 and 27 nodes and of tetrahedra of 4 and 10, from nothing of the library but
   its mesh */
#ifndef ELASTICITY_POINT_H
#define ELASTICITY_POINT_H

#include <mesh.h>
#include <petscdt.h>

#define POINTS 4 /* along each axis */

typedef struct {
  PetscInt  n, offset[MESH_MAX_NODES]; /* of the nodes' values in local vectors */
  PetscReal X[MESH_MAX_NODES][3];
} PointCell;

/* Place, weight with the determinant, shape functions and their gradients */
typedef struct {
  PetscReal x[3], weight, N[MESH_MAX_NODES], G[MESH_MAX_NODES][3];
} Point;

static inline PetscErrorCode PointCellGet(DM dm, PetscInt cell, const PetscScalar places[], PointCell *c)
{
  PetscSection section;
  PetscInt     nodes[MESH_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetCellNodes(dm, cell, &c->n, nodes));
  for (PetscInt a = 0; a < c->n; ++a) {
    PetscCall(PetscSectionGetOffset(section, nodes[a], &c->offset[a]));
    for (PetscInt d = 0; d < 3; ++d) c->X[a][d] = PetscRealPart(places[c->offset[a] + d]);
  }
  PetscFunctionReturn(0);
}

/* Lagrange's polynomial of node i of n equally spaced ones on [0, 1], and its slope */
static inline void PointLagrange(PetscInt n, PetscInt i, PetscReal t, PetscReal *value, PetscReal *slope)
{
  *value = 1;
  *slope = 0;
  for (PetscInt k = 0; k < n; ++k) {
    const PetscReal at = (PetscReal)k / (PetscReal)(n - 1), from = (PetscReal)(i - k) / (PetscReal)(n - 1);

    if (k == i) continue;
    *slope = *slope * (t - at) / from + *value / from;
    *value *= (t - at) / from;
  }
}

/* Of a hexahedron at a place of [0, 1]^3: shape functions and their slopes */
static inline void PointHexahedron(PetscInt n, const PetscReal place[3], PetscReal N[], PetscReal D[][3])
{
  const PetscInt width = n == 8 ? 2 : 3;

  for (PetscInt a = 0; a < n; ++a) {
    const PetscInt at[3] = {a % width, a / width % width, a / (width * width)};
    PetscReal      L[3], s[3];

    for (PetscInt d = 0; d < 3; ++d) PointLagrange(width, at[d], place[d], &L[d], &s[d]);
    N[a] = L[0] * L[1] * L[2];
    for (PetscInt d = 0; d < 3; ++d) D[a][d] = s[d] * L[(d + 1) % 3] * L[(d + 2) % 3];
  }
}

/* Of a tetrahedron, between the origin and the ends of the unit vectors; after the corners, the edges 01, 12, 02, 03,
   13 and 23 */
static inline void PointTetrahedron(PetscInt n, const PetscReal x[3], PetscReal N[], PetscReal D[][3])
{
  static const PetscReal dl[4][3]    = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  static const PetscInt  edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  const PetscReal        l[4]        = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};

  for (PetscInt a = 0; a < 4; ++a) {
    N[a] = n == 4 ? l[a] : (2 * l[a] - 1) * l[a];
    for (PetscInt d = 0; d < 3; ++d) D[a][d] = (n == 4 ? 1 : 4 * l[a] - 1) * dl[a][d];
  }
  for (PetscInt e = 0; e < n - 4; ++e) {
    const PetscInt a = edges[e][0], b = edges[e][1];

    N[4 + e] = 4 * l[a] * l[b];
    for (PetscInt d = 0; d < 3; ++d) D[4 + e][d] = 4 * (l[a] * dl[b][d] + l[b] * dl[a][d]);
  }
}

/* Point q of POINTS^3 Gauss points, of a tetrahedron those of a cube whose far sides are shrunk. Gradients solve J^T
   g = dN by Cramer's rule */
static inline PetscErrorCode PointGet(const PointCell *c, PetscInt q, Point *p)
{
  const PetscInt index[3] = {q % POINTS, q / POINTS % POINTS, q / (POINTS * POINTS)};
  PetscReal      gauss[POINTS], weight[POINTS], place[3], D[MESH_MAX_NODES][3], J[3][3] = {{0}}, C[3][3], det = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscDTGaussQuadrature(POINTS, 0, 1, gauss, weight));
  *p = (Point){.weight = weight[index[0]] * weight[index[1]] * weight[index[2]]};
  for (PetscInt d = 0; d < 3; ++d) place[d] = gauss[index[d]];
  if (MeshIsTetrahedron(c->n)) {
    p->weight *= (1 - place[0]) * (1 - place[0]) * (1 - place[1]);
    place[1] *= 1 - place[0];
    place[2] *= 1 - place[0] - place[1];
    PointTetrahedron(c->n, place, p->N, D);
  } else PointHexahedron(c->n, place, p->N, D);
  for (PetscInt a = 0; a < c->n; ++a) {
    for (PetscInt d = 0; d < 3; ++d) p->x[d] += p->N[a] * c->X[a][d];
    for (PetscInt i = 0; i < 9; ++i) J[i / 3][i % 3] += D[a][i / 3] * c->X[a][i % 3];
  }
  for (PetscInt i = 0; i < 9; ++i)
    C[i / 3][i % 3] = J[(i / 3 + 1) % 3][(i + 1) % 3] * J[(i / 3 + 2) % 3][(i + 2) % 3] -
                      J[(i / 3 + 1) % 3][(i + 2) % 3] * J[(i / 3 + 2) % 3][(i + 1) % 3];
  for (PetscInt i = 0; i < 3; ++i) det += J[0][i] * C[0][i];
  p->weight *= det;
  for (PetscInt a = 0; a < c->n; ++a) {
    for (PetscInt i = 0; i < 9; ++i) p->G[a][i % 3] += C[i / 3][i % 3] * D[a][i / 3] / det;
  }
  PetscFunctionReturn(0);
}

#endif
