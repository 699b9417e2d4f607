/* Shape functions of hexahedra at tensor Gauss points, and of tetrahedra */
#include "elasticityimpl.h"
#include <petscdt.h>

/* Of a line on [-1,1], of two nodes or three, at a point: values and slopes */
static void BasisLine(PetscInt n, PetscReal xi, PetscReal L[3], PetscReal s[3])
{
  if (n == 2) {
    for (PetscInt i = 0; i < 2; ++i) {
      s[i] = i ? 0.5 : -0.5;
      L[i] = 0.5 + s[i] * xi;
    }
  } else {
    L[0] = 0.5 * xi * (xi - 1);
    L[1] = (1 - xi) * (1 + xi);
    L[2] = 0.5 * xi * (xi + 1);
    s[0] = xi - 0.5;
    s[1] = -2 * xi;
    s[2] = xi + 0.5;
  }
}

/* Places with the same barycentric coordinates in all orders: n of them, the coordinates that differ from the others */
typedef struct {
  PetscInt  n;
  PetscReal place, weight; /* of the whole, each */
} BasisOrbit;

/* Next of n points of an orbit: of 4, one coordinate is 1 - 3 place; of 6, two are 1/2 - place */
static void BasisAddPoint(const BasisOrbit *orbit, PetscInt i, CellBasis *basis)
{
  const PetscReal other = orbit->n == 4 ? 1 - 3 * orbit->place : 0.5 - orbit->place;
  const PetscInt  p = orbit->n == 4 ? i : MeshTetrahedronEnds[4 + i][0], q = orbit->n == 4 ? i : MeshTetrahedronEnds[4 + i][1];

  for (PetscInt d = 0; d < 3; ++d) basis->xi[basis->npoints][d] = p == d + 1 || q == d + 1 ? other : orbit->place;
  basis->weight[basis->npoints++] = orbit->weight / 6;
}

/* Of degree 2 with 4 points, and of degree 5 with 14 (N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000) */
static void BasisSetTetrahedron(PetscInt nnodes, CellBasis *basis)
{
  static const BasisOrbit second[1] = {
    {4, 0.13819660112501051518, 0.25}};
  static const BasisOrbit fifth[3] = {
    {4, 0.31088591926330060980, 0.11268792571801585080},
    {4, 0.09273525031089122640, 0.073493043116361949544},
    {6, 0.04550370412564964949, 0.042546020777081466438}};
  const BasisOrbit *orbits = nnodes == 4 ? second : fifth;

  basis->nnodes  = nnodes;
  basis->npoints = 0;
  for (PetscInt k = 0; k < (nnodes == 4 ? 1 : 3); ++k) {
    for (PetscInt i = 0; i < orbits[k].n; ++i) BasisAddPoint(&orbits[k], i, basis);
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) MeshTetrahedronShape(nnodes, basis->xi[q], basis->N[q], basis->dN[q]);
}

PetscErrorCode CellBasisCreate(PetscInt nnodes, PetscInt n, CellBasis *basis)
{
  const PetscInt width = MeshOrder(nnodes) + 1;
  PetscReal      x[3], w[3];

  PetscFunctionBegin;
  if (MeshIsTetrahedron(nnodes)) {
    BasisSetTetrahedron(nnodes, basis);
    PetscFunctionReturn(0);
  }
  PetscCheck(n == 2 || n == 3, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "A hexahedron is integrated with 2 or 3 Gauss points per axis, not %" PetscInt_FMT, n);
  PetscCall(PetscDTGaussQuadrature(n, -1, 1, x, w));
  basis->nnodes  = width * width * width;
  basis->npoints = n * n * n;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscInt p[3] = {q % n, q / n % n, q / (n * n)};
    PetscReal      L[3][3], s[3][3];

    basis->weight[q] = w[p[0]] * w[p[1]] * w[p[2]];
    for (PetscInt d = 0; d < 3; ++d) {
      basis->xi[q][d] = x[p[d]];
      BasisLine(width, x[p[d]], L[d], s[d]);
    }
    for (PetscInt a = 0; a < basis->nnodes; ++a) {
      const PetscInt i = a % width, j = a / width % width, k = a / (width * width);

      basis->N[q][a]     = L[0][i] * L[1][j] * L[2][k];
      basis->dN[q][0][a] = s[0][i] * L[1][j] * L[2][k];
      basis->dN[q][1][a] = L[0][i] * s[1][j] * L[2][k];
      basis->dN[q][2][a] = L[0][i] * L[1][j] * s[2][k];
    }
  }
  PetscFunctionReturn(0);
}
