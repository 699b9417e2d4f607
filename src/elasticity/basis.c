/* Shape functions of hexahedra at tensor Gauss points */
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

PetscErrorCode CellBasisCreate(PetscInt order, PetscInt n, CellBasis *basis)
{
  const PetscInt width = order + 1;
  PetscReal      x[3], w[3];

  PetscFunctionBegin;
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
