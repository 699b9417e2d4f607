/* Creates the tangent matrix and its near null space */
#include "elasticityimpl.h"
#include <mesh.h>

/* Computes a vector with 1 in free rows and 0 in prescribed ones */
static PetscErrorCode ElasticityFreeRows(Elasticity e, Vec rows)
{
  Vec          local;
  PetscScalar *l;

  PetscFunctionBegin;
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt i = 0; i < 3 * e->nnodes; ++i) l[i] = (e->prescribed[i / 3] >> i % 3 & 1) ? 0 : 1;
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(DMLocalToGlobal(e->dm, local, INSERT_VALUES, rows));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*
   Sets the rigid modes to zero in prescribed rows and makes them orthonormal again; modes that depend on others are
   dropped. With such modes an AMG needs fewer iterations, the more so the closer Poisson's ratio is to 1/2.
*/
static PetscErrorCode ElasticityRestrictModes(Elasticity e, MatNullSpace all, MatNullSpace *restricted)
{
  const PetscReal dependent = 1e-6;
  PetscInt        nall, n = 0;
  const Vec      *modes;
  Vec             kept[6], rows;
  PetscScalar     dots[6];

  PetscFunctionBegin;
  PetscCall(MatNullSpaceGetVecs(all, NULL, &nall, &modes));
  PetscCall(VecDuplicate(modes[0], &rows));
  PetscCall(ElasticityFreeRows(e, rows));
  for (PetscInt i = 0; i < nall; ++i) {
    PetscReal before, after;

    PetscCall(VecDuplicate(rows, &kept[n]));
    PetscCall(VecPointwiseMult(kept[n], modes[i], rows));
    PetscCall(VecNorm(kept[n], NORM_2, &before));
    for (PetscInt pass = 0; pass < 2; ++pass) { /* two passes give orthogonality up to rounding */
      PetscCall(VecMDot(kept[n], n, kept, dots));
      for (PetscInt j = 0; j < n; ++j) dots[j] = -dots[j];
      PetscCall(VecMAXPY(kept[n], n, dots, kept));
    }
    PetscCall(VecNormalize(kept[n], &after));
    if (after > dependent * before) ++n;
    else PetscCall(VecDestroy(&kept[n]));
  }
  PetscCall(MatNullSpaceCreate(PetscObjectComm((PetscObject)rows), PETSC_FALSE, n, kept, restricted));
  for (PetscInt i = 0; i < n; ++i) PetscCall(VecDestroy(&kept[i]));
  PetscCall(VecDestroy(&rows));
  PetscFunctionReturn(0);
}

/* Collective. Sets the type of tangents to be created: MATBAIJ, MATAIJ or MATSBAIJ. The option -elasticity_mat_type
   takes precedence. */
PetscErrorCode ElasticitySetMatType(Elasticity e, MatType type)
{
  PetscFunctionBegin;
  if (!e->mattype_given) PetscCall(PetscStrncpy(e->mattype, type, sizeof(e->mattype)));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCreateTangent - Creates the tangent matrix, all its entries allocated and zero

  Collective

  Input Parameter:
. e - the context

  Output Parameter:
. tangent - n x n matrix of block size 3, laid out as the mesh's global vectors

  Options Database Key:
. -elasticity_mat_type <baij> - baij, aij or sbaij

  Level: beginner

  Notes:
  The matrix is marked as symmetric. `ElasticitySetNearNullSpace()` attaches a near null space.

.seealso: `ElasticityTangent()`, `ElasticitySetNearNullSpace()`
@*/
PetscErrorCode ElasticityCreateTangent(Elasticity e, Mat *tangent)
{
  Vec      global;
  Mat      A;
  PetscInt n, N;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(e->dm, &global));
  PetscCall(VecGetLocalSize(global, &n));
  PetscCall(VecGetSize(global, &N));
  PetscCall(DMRestoreGlobalVector(e->dm, &global));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)e->dm), &A));
  PetscCall(MatSetSizes(A, n, n, N, N));
  PetscCall(MatSetBlockSize(A, 3));
  PetscCall(MatSetType(A, e->mattype));
  PetscCall(ElasticityPreallocate(e, A));
  PetscCall(MatSetOption(A, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  PetscCall(MatSetOption(A, MAT_KEEP_NONZERO_PATTERN, PETSC_TRUE)); /* rows of bodies are set to zero when these are
                                                               assembled again */
  PetscCall(MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetOption(A, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  *tangent = A;
  PetscFunctionReturn(0);
}

/*@
  ElasticitySetNearNullSpace - Attaches the rigid body modes of the reference geometry to a tangent, for smoothed
  aggregation and nodal AMG

  Collective

  Input Parameters:
+ e - the elasticity
- A - tangent, or another matrix laid out like it

  Level: beginner

  Notes:
  There are at most six modes, orthonormal, and zero on the rows that are prescribed when this function is called. They
  take as much memory as six solutions. `PCHYPRE` copies them even if it does not use them.

.seealso: `ElasticityCreateTangent()`, `ElasticitySetPrescribed()`, `MatSetNearNullSpace()`
@*/
PetscErrorCode ElasticitySetNearNullSpace(Elasticity e, Mat A)
{
  Vec          local, coordinates;
  MatNullSpace modes, restricted;

  PetscFunctionBegin;
  PetscCall(MeshGetNodeCoordinates(e->dm, &local));
  PetscCall(DMCreateGlobalVector(e->dm, &coordinates));
  PetscCall(DMLocalToGlobal(e->dm, local, INSERT_VALUES, coordinates));
  PetscCall(MatNullSpaceCreateRigidBody(coordinates, &modes));
  PetscCall(VecDestroy(&coordinates));
  if (e->prescribed) {
    PetscCall(ElasticityRestrictModes(e, modes, &restricted));
    PetscCall(MatNullSpaceDestroy(&modes));
    modes = restricted;
  }
  PetscCall(MatSetNearNullSpace(A, modes));
  PetscCall(MatNullSpaceDestroy(&modes));
  PetscFunctionReturn(0);
}
