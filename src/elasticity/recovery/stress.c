/* Computes the stress of the cells */
#include "recoveryimpl.h"

PetscReal StressVonMises(const PetscReal s[6])
{
  return PetscSqrtReal(0.5 * (PetscSqr(s[0] - s[1]) + PetscSqr(s[1] - s[2]) + PetscSqr(s[2] - s[0])) +
                       3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/*@
  ElasticityCellStress - Computes the Cauchy stress averaged over each cell, and the von Mises stress of that average

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per node [length]

  Output Parameter:
. stress - 7 values per local cell, in the order of the mesh's cells: xx yy zz xy yz zx, von Mises [force/length^2];
           free with `PetscFree()`

  Level: intermediate

  Notes:
  The stress is conjugate to the strain of the element: in a cell of `ELEMENT_BBAR` the pressure is that of the mean
  dilatation. An inverted cell has the value `PETSC_INFINITY`.

.seealso: `ElasticityForce()`, `ElasticityCreate()`
@*/
PetscErrorCode ElasticityCellStress(Elasticity e, Vec u, PetscReal *stress[])
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(PetscMalloc1(7 * e->ncells, stress));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal *s = *stress + 7 * c;
    CellState  cell;

    ElasticityGetCell(e, c, x, ul, &cell);
    if (cell.body->element->cauchy(cell.body->basis, cell.material, cell.X, cell.U, s)) s[6] = StressVonMises(s);
    else {
      for (int k = 0; k < 7; ++k) s[k] = PETSC_INFINITY;
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}
