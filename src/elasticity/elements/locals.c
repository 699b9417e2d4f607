/* Displacements and coordinates of the cells of this rank */
#include "elementsimpl.h"
#include <mesh.h>

PetscErrorCode ElasticityGetLocals(Elasticity e, Vec u, Vec *local, const PetscScalar **ul, const PetscScalar **x)
{
  Vec coordinates;

  PetscFunctionBegin;
  PetscCall(MeshGetNodeCoordinates(e->dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, x));
  PetscCall(DMGetLocalVector(e->dm, local));
  if (u) PetscCall(DMGlobalToLocal(e->dm, u, INSERT_VALUES, *local));
  else PetscCall(VecZeroEntries(*local));
  PetscCall(VecGetArrayRead(*local, ul));
  PetscFunctionReturn(0);
}

PetscErrorCode ElasticityRestoreLocals(Elasticity e, Vec *local, const PetscScalar **ul, const PetscScalar **x)
{
  Vec coordinates;

  PetscFunctionBegin;
  PetscCall(VecRestoreArrayRead(*local, ul));
  PetscCall(DMRestoreLocalVector(e->dm, local));
  PetscCall(MeshGetNodeCoordinates(e->dm, &coordinates));
  PetscCall(VecRestoreArrayRead(coordinates, x));
  PetscFunctionReturn(0);
}

void CellGather(PetscInt n, const PetscInt nodes[], const PetscScalar local[], PetscReal values[3][CELL_MAX_NODES])
{
  for (PetscInt a = 0; a < n; ++a) {
    for (PetscInt d = 0; d < 3; ++d) values[d][a] = PetscRealPart(local[3 * nodes[a] + d]);
  }
}
