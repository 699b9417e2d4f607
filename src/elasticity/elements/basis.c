/* Shape functions of hexahedra at tensor Gauss points, and of tetrahedra at their quadrature points */
#include "elementsimpl.h"
#include <petscdt.h>

/* Copies weights and derivatives to the packs */
static void BasisSetPacks(CellBasis *basis)
{
  basis->npacks = (basis->npoints + LANES - 1) / LANES;
  for (PetscInt p = 0; p < LANES * basis->npacks; ++p) {
    const PetscInt q = PetscMin(p, basis->npoints - 1);

    basis->packweight[p / LANES][p % LANES] = p == q ? basis->weight[q] : 0;
    for (PetscInt a = 0; a < basis->nnodes; ++a) {
      for (PetscInt k = 0; k < 3; ++k) basis->packdN[p / LANES][a][k][p % LANES] = basis->dN[q][k][a];
    }
  }
}

PetscErrorCode CellBasisCreate(PetscInt nnodes, PetscInt n, CellBasis *basis)
{
  PetscReal x[3], w[3];

  PetscFunctionBegin;
  basis->nnodes = nnodes;
  if (MeshIsTetrahedron(nnodes)) MeshTetrahedronRule(nnodes, &basis->npoints, basis->xi, basis->weight);
  else {
    PetscCheck(n == 2 || n == 3, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "A hexahedron is integrated with 2 or 3 Gauss points per axis, not %" PetscInt_FMT, n);
    PetscCall(PetscDTGaussQuadrature(n, -1, 1, x, w));
    basis->npoints = n * n * n;
    for (PetscInt q = 0; q < basis->npoints; ++q) {
      const PetscInt p[3] = {q % n, q / n % n, q / (n * n)};

      basis->weight[q] = w[p[0]] * w[p[1]] * w[p[2]];
      for (PetscInt d = 0; d < 3; ++d) basis->xi[q][d] = x[p[d]];
    }
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) MeshCellShape(nnodes, basis->xi[q], basis->N[q], basis->dN[q]);
  BasisSetPacks(basis);
  PetscFunctionReturn(0);
}
