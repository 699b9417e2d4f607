/*
   Free motions: the rigid motions of the bodies, and of groups that ties and springs hold together, that no prescribed
   displacement, spring or tie resists. Weak springs do not count. Only contact can resist these motions. They serve the
   search for an equilibrium, the optimizer's search space, and the position of bodies that have lost contact.
*/
#include "measureimpl.h"
#include "src/mesh/supports/supportsimpl.h"

/* Computes rows of Z: the displacements of the nodes of this rank at the positions x in the free motions, which are
   combinations of the bodies' modes */
static PetscErrorCode FreeMotionsSetRows(const Support *support, const PetscInt body[], Vec places, Mat combinations,
  Mat Z)
{
  const PetscScalar *x, *values;
  const PetscInt    *columns;
  PetscInt           n, ncolumns, first;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(places, &n));
  PetscCall(VecGetOwnershipRange(places, &first, NULL));
  PetscCall(VecGetArrayRead(places, &x));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt  b = body[i / 3], c = i % 3, row = first + i;
    const PetscReal at[3]    = {PetscRealPart(x[i - c]), PetscRealPart(x[i - c + 1]), PetscRealPart(x[i - c + 2])};
    const PetscReal axis[3]  = {c == 0, c == 1, c == 2};
    PetscReal       moved[6] = {0.0};

    SupportSetRow(support, b, axis, at, 1.0, moved);
    for (PetscInt m = 0; m < 6; ++m) {
      if (moved[m] == 0.0) continue;
      PetscCall(MatGetRow(combinations, 6 * b + m, &ncolumns, &columns, &values));
      for (PetscInt k = 0; k < ncolumns; ++k)
        PetscCall(MatSetValue(Z, row, columns[k], moved[m] * values[k], ADD_VALUES));
      PetscCall(MatRestoreRow(combinations, 6 * b + m, &ncolumns, &columns, &values));
    }
  }
  PetscCall(VecRestoreArrayRead(places, &x));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes the free motions at the last state. Bodies at small strain are at their undeformed positions, as
   in the energy, unless rigid bodies turn.
*/
PetscErrorCode FreeMotionsCreate(Model model, State state, FreeMotions *m)
{
  PetscBool linear, moved;
  PetscInt  n;
  Support   support;
  Mat       combinations;
  Vec       places;

  PetscFunctionBegin;
  PetscCall(ElasticityIsLinear(model->elasticity, &linear));
  moved = (PetscBool)(!linear || model->rigid.turns);
  PetscCall(SupportCreate(model->dm, model->scene, moved ? state->path->u : NULL, SUPPORT_FIXED, &support));
  PetscCall(SupportFindFree(&support, &m->n, &combinations));
  PetscCall(VecDuplicate(model->places.x, &places));
  PetscCall(VecCopy(model->places.x, places));
  if (moved) PetscCall(VecAXPY(places, 1.0, state->path->u));
  PetscCall(VecGetLocalSize(places, &n));
  PetscCall(MatCreateAIJ(model->comm, n, PETSC_DECIDE, PETSC_DETERMINE, m->n, 6, NULL, 6, NULL, &m->Z));
  PetscCall(MatSetOption(m->Z, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(FreeMotionsSetRows(&support, model->places.body, places, combinations, m->Z));
  PetscCall(MatAssemblyBegin(m->Z, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(m->Z, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(m->Z, &m->each, NULL));
  PetscCall(VecScatterCreateToAll(m->each, &m->all, NULL));
  PetscCall(VecDestroy(&places));
  PetscCall(MatDestroy(&combinations));
  PetscCall(SupportDestroy(&support));
  PetscFunctionReturn(0);
}

/* Computes the product of a matrix, whose columns are free motions, with a vector `motion` that each rank has */
PetscErrorCode FreeMotionsMultiply(const FreeMotions *m, Mat A, Vec motion, Vec product)
{
  PetscFunctionBegin;
  PetscCall(VecScatterBegin(m->all, motion, m->each, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(m->all, motion, m->each, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(MatMult(A, m->each, product));
  PetscFunctionReturn(0);
}

/* Computes the work on the free motions of the forces of the rows of a matrix, on each rank */
PetscErrorCode FreeMotionsSum(const FreeMotions *m, Mat A, Vec force, Vec work)
{
  PetscFunctionBegin;
  PetscCall(MatMultTranspose(A, force, m->each));
  PetscCall(VecScatterBegin(m->all, m->each, work, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(m->all, m->each, work, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}

PetscErrorCode FreeMotionsDestroy(FreeMotions *m)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&m->Z));
  PetscCall(VecDestroy(&m->each));
  PetscCall(VecScatterDestroy(&m->all));
  PetscFunctionReturn(0);
}
