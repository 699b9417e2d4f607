/* Shape functions of the trilinear hexahedron at tensor Gauss points */
#include "elasticityimpl.h"
#include <petscdt.h>

PetscErrorCode HexBasisCreate(PetscInt n, HexBasis *basis)
{
  PetscReal x[3], w[3];

  PetscFunctionBegin;
  PetscCheck(n == 2 || n == 3, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "A hexahedron is integrated with 2 or 3 Gauss points per axis, not %" PetscInt_FMT, n);
  PetscCall(PetscDTGaussQuadrature(n, -1, 1, x, w));
  basis->npoints = n * n * n;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscInt  p[3]  = {q % n, q / n % n, q / (n * n)};
    const PetscReal xi[3] = {x[p[0]], x[p[1]], x[p[2]]};

    basis->weight[q] = w[p[0]] * w[p[1]] * w[p[2]];
    for (PetscInt d = 0; d < 3; ++d) basis->xi[q][d] = xi[d];
    for (PetscInt a = 0; a < 8; ++a) {
      PetscReal L[3], s[3];

      for (PetscInt d = 0; d < 3; ++d) {
        s[d] = (a >> d & 1) ? 0.5 : -0.5;
        L[d] = 0.5 + s[d] * xi[d];
      }
      basis->N[q][a]     = L[0] * L[1] * L[2];
      basis->dN[q][0][a] = s[0] * L[1] * L[2];
      basis->dN[q][1][a] = L[0] * s[1] * L[2];
      basis->dN[q][2][a] = L[0] * L[1] * s[2];
    }
  }
  PetscFunctionReturn(0);
}
