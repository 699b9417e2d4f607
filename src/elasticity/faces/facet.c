/* Facets of the bodies' faces: their nodes and shape functions */
#include "facesimpl.h"

/*
   Computes the shape functions of a triangle with 3 or 6 nodes (corners, then edges) and their derivatives. The sides
   are s = 0, t = 0 and s + t = 1.
*/
static void FacetTriangleShape(PetscInt n, PetscReal s, PetscReal t, PetscReal N[], PetscReal Ns[], PetscReal Nt[])
{
  static const PetscReal by_s[3] = {-1, 1, 0}, by_t[3] = {-1, 0, 1};
  const PetscReal        l[3] = {1 - s - t, s, t};

  for (PetscInt a = 0; a < n; ++a) {
    const PetscInt  p = a % 3, q = (a + 1) % 3;
    const PetscReal slope = n == 3 ? 1 : 4 * l[p] - 1;

    N[a]  = n == 3 ? l[p] : a < 3 ? l[p] * (2 * l[p] - 1) : 4 * l[p] * l[q];
    Ns[a] = a < 3 ? slope * by_s[p] : 4 * (by_s[p] * l[q] + l[p] * by_s[q]);
    Nt[a] = a < 3 ? slope * by_t[p] : 4 * (by_t[p] * l[q] + l[p] * by_t[q]);
  }
}

/*
   Returns the weight and gets the parameters of a Gauss point of the square. For a triangle, the points lie on rays
   from its second corner, and the rule is exact to degree 2 or 4.
*/
PetscReal FacetQuadrature(PetscInt n, PetscInt gausspoints, PetscInt q, PetscReal *s, PetscReal *t)
{
  static const PetscReal weight[2][3] = {{0.5, 0.5, 0}, {5. / 18, 8. / 18, 5. / 18}};
  const PetscReal        off          = gausspoints == 2 ? PetscSqrtReal(3) / 6 : PetscSqrtReal(0.15);
  const PetscInt         i = q % gausspoints, j = q / gausspoints, last = gausspoints - 1;
  const PetscReal        w = weight[gausspoints - 2][i] * weight[gausspoints - 2][j];

  *s = 0.5 + off * (PetscReal)(2 * i - last) / (PetscReal)last;
  *t = 0.5 + off * (PetscReal)(2 * j - last) / (PetscReal)last;
  if (n == 4 || n == 9) return w;
  *t *= 1 - *s;
  return w * (1 - *s);
}

/*
   Computes the shape functions of a facet on [0,1]^2 and their derivatives. A facet with 4 nodes has them around its
   boundary; with 9 nodes those on the edges and the one in the middle follow.
*/
void FacetShape(PetscInt n, PetscReal s, PetscReal t, PetscReal N[], PetscReal Ns[], PetscReal Nt[])
{
  static const PetscInt place[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
  const PetscReal       at[2]       = {s, t};
  PetscReal             L[2][3], D[2][3];

  if (n == 3 || n == 6) {
    FacetTriangleShape(n, s, t, N, Ns, Nt);
    return;
  }
  for (PetscInt d = 0; d < 2; ++d) {
    const PetscReal x = at[d];

    L[d][0] = n == 4 ? 1 - x : (1 - x) * (1 - 2 * x);
    L[d][1] = 4 * x * (1 - x);
    L[d][2] = n == 4 ? x : x * (2 * x - 1);
    D[d][0] = n == 4 ? -1 : 4 * x - 3;
    D[d][1] = 4 - 8 * x;
    D[d][2] = n == 4 ? 1 : 4 * x - 1;
  }
  for (PetscInt a = 0; a < n; ++a) {
    N[a]  = L[0][place[a][0]] * L[1][place[a][1]];
    Ns[a] = D[0][place[a][0]] * L[1][place[a][1]];
    Nt[a] = L[0][place[a][0]] * D[1][place[a][1]];
  }
}

/*
   Computes F[a][d] = int N_a P n dA with n dA = dX/ds x dX/dt. P: values at the nodes, interpolated between them; NULL:
   1. With 4 or 9 nodes the integrand for P = 1 has degree 2 or 5 in s and in t, for which 2 x 2 or 3 x 3 Gauss points
   are exact. On triangles with 3 or 6 nodes the degree is 1 or 4.
*/
void FacetNormals(PetscInt n, PetscReal X[][3], const PetscReal P[], PetscReal F[][3])
{
  const PetscInt npoints = n <= 4 ? 2 : 3;

  for (PetscInt a = 0; a < n; ++a) F[a][0] = F[a][1] = F[a][2] = 0;
  for (PetscInt q = 0; q < npoints * npoints; ++q) {
    PetscReal N[FACET_MAX_NODES], Ns[FACET_MAX_NODES], Nt[FACET_MAX_NODES], xs[3] = {0, 0, 0}, xt[3] = {0, 0, 0},
                                                                            normal[3], s, t;
    const PetscReal weight = FacetQuadrature(n, npoints, q, &s, &t);
    PetscReal       p      = P ? 0 : 1;

    FacetShape(n, s, t, N, Ns, Nt);
    for (PetscInt a = 0; a < n; ++a) {
      if (P) p += N[a] * P[a];
      for (int d = 0; d < 3; ++d) {
        xs[d] += Ns[a] * X[a][d];
        xt[d] += Nt[a] * X[a][d];
      }
    }
    VectorCross(xs, xt, normal);
    for (PetscInt a = 0; a < n; ++a) {
      for (int d = 0; d < 3; ++d) F[a][d] += weight * p * N[a] * normal[d];
    }
  }
}

/* Gets a facet of this rank. x: local coordinates of the nodes. */
PetscErrorCode FacetGet(Elasticity e, PetscInt point, const PetscScalar x[], Facet *facet)
{
  PetscSection section;
  PetscInt     nodes[FACET_MAX_NODES];

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(e->dm, &section));
  PetscCall(MeshGetFacetNodes(e->dm, point, &facet->n, nodes));
  for (PetscInt a = 0; a < facet->n; ++a) {
    PetscCall(PetscSectionGetOffset(section, nodes[a], &facet->offset[a]));
    for (PetscInt d = 0; d < 3; ++d) facet->X[a][d] = PetscRealPart(x[facet->offset[a] + d]);
  }
  PetscFunctionReturn(0);
}

/* Computes factor times a pressure at the nodes of a facet. at: the pressure at a position; NULL: 1 */
PetscErrorCode FacetPressures(const Facet *facet, PetscReal factor, ElasticityPressure at, void *ctx, PetscReal P[])
{
  PetscFunctionBegin;
  for (PetscInt a = 0; a < facet->n; ++a) {
    P[a] = 1;
    if (at) PetscCall(at(ctx, facet->X[a], &P[a]));
    P[a] *= factor;
  }
  PetscFunctionReturn(0);
}
