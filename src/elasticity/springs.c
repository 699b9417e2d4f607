/* Springs between the bodies and the ground: a stiffness of each unknown, E = sum k u^2/2 */
#include "elasticityimpl.h"

/*@
  ElasticitySetSprings - Sets the stiffness of springs that hold the unknowns to the ground

  Collective

  Input Parameters:
+ elasticity - the context
- stiffness  - one a row, not negative, referenced; `NULL`: no springs [force/length]

  Level: intermediate

  Notes:
  They are part of energy, force and tangent. The next tangent is assembled completely.

.seealso: `ElasticityAddFaceField()`, `ElasticityEnergy()`
@*/
PetscErrorCode ElasticitySetSprings(Elasticity e, Vec stiffness)
{
  PetscFunctionBegin;
  if (stiffness) PetscCall(PetscObjectReference((PetscObject)stiffness));
  PetscCall(VecDestroy(&e->springs));
  e->springs      = stiffness;
  e->assembled.id = 0;
  PetscFunctionReturn(0);
}

/* Part of this rank, added to a sum over the ranks to come */
PetscErrorCode SpringsAddEnergy(Elasticity e, Vec u, PetscReal *energy)
{
  const PetscScalar *k, *v;
  PetscInt           n;

  PetscFunctionBegin;
  if (!e->springs || !u) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecGetArrayRead(e->springs, &k));
  PetscCall(VecGetArrayRead(u, &v));
  for (PetscInt i = 0; i < n; ++i) *energy += 0.5 * PetscRealPart(k[i] * v[i] * v[i]);
  PetscCall(VecRestoreArrayRead(u, &v));
  PetscCall(VecRestoreArrayRead(e->springs, &k));
  PetscFunctionReturn(0);
}

PetscErrorCode SpringsAddForce(Elasticity e, Vec u, Vec force)
{
  Vec product;

  PetscFunctionBegin;
  if (!e->springs || !u) PetscFunctionReturn(0);
  PetscCall(DMGetGlobalVector(e->dm, &product));
  PetscCall(VecPointwiseMult(product, e->springs, u));
  PetscCall(VecAXPY(force, 1.0, product));
  PetscCall(DMRestoreGlobalVector(e->dm, &product));
  PetscFunctionReturn(0);
}

/* To the diagonal blocks of nodes that this rank owns, of all bodies or of those that are not kept. Where an unknown is prescribed its diagonal is arbitrary */
PetscErrorCode SpringsAddTangent(Elasticity e, PetscBool all, const PetscInt global[], Mat tangent)
{
  const PetscScalar *k;
  PetscBool         *seen;
  PetscInt           first, last;

  PetscFunctionBegin;
  if (!e->springs) PetscFunctionReturn(0);
  PetscCall(VecGetOwnershipRange(e->springs, &first, &last));
  PetscCall(PetscCalloc1(e->nnodes, &seen));
  PetscCall(VecGetArrayRead(e->springs, &k));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    if (!all && e->bodies[e->cellbody[c]].kept) continue;
    for (PetscInt i = e->cellstart[c]; i < e->cellstart[c + 1]; ++i) {
      const PetscInt node = e->cellnodes[i], row = 3 * global[node];
      PetscScalar    block[9] = {0};

      if (seen[node] || row < first || row >= last) continue;
      seen[node] = PETSC_TRUE;
      for (PetscInt d = 0; d < 3; ++d) block[4 * d] = k[row - first + d];
      PetscCall(MatSetValuesBlocked(tangent, 1, &global[node], 1, &global[node], block, ADD_VALUES));
    }
  }
  PetscCall(VecRestoreArrayRead(e->springs, &k));
  PetscCall(PetscFree(seen));
  PetscFunctionReturn(0);
}
