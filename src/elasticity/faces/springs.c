/*
   Springs. A spring to the ground has a stiffness k per unknown, E = sum k u^2/2. Springs between bodies have a matrix
   S, E = u^T S u/2.
*/
#include "facesimpl.h"

/*@
  ElasticitySetSprings - Sets the stiffness of springs from the unknowns to the ground and between unknowns

  Collective

  Input Parameters:
+ e         - the context
. stiffness - stiffness of the springs to the ground, one value per row, not negative, referenced; `NULL`: no such
              springs [force/length]
- between   - stiffness matrix of springs between unknowns, symmetric positive semidefinite, referenced; `NULL`: no such
              springs [force/length]

  Level: intermediate

  Notes:
  Energy and force include all springs. The tangent includes only springs to the ground: its nonzero pattern has no
  entries for the others. The next tangent is assembled completely.

.seealso: `ElasticityAddFaceField()`, `ElasticityEnergy()`
@*/
PetscErrorCode ElasticitySetSprings(Elasticity e, Vec stiffness, Mat between)
{
  PetscFunctionBegin;
  if (between) PetscCall(PetscObjectReference((PetscObject)between));
  PetscCall(MatDestroy(&e->between));
  e->between = between;
  if (stiffness) PetscCall(PetscObjectReference((PetscObject)stiffness));
  PetscCall(VecDestroy(&e->springs));
  e->springs      = stiffness;
  e->assembled.id = 0;
  PetscFunctionReturn(0);
}

/* Computes product = k u + S u */
static PetscErrorCode SpringsMultiply(Elasticity e, Vec u, Vec product)
{
  PetscFunctionBegin;
  if (e->springs) PetscCall(VecPointwiseMult(product, e->springs, u));
  else PetscCall(VecZeroEntries(product));
  if (e->between) PetscCall(MatMultAdd(e->between, u, product, product));
  PetscFunctionReturn(0);
}

/* Adds this rank's contribution to the energy. The caller sums over the ranks. */
PetscErrorCode SpringsAddEnergy(Elasticity e, Vec u, PetscReal *energy)
{
  const PetscScalar *f, *v;
  PetscInt           n;
  Vec                product;

  PetscFunctionBegin;
  if (!(e->springs || e->between) || !u) PetscFunctionReturn(0);
  PetscCall(DMGetGlobalVector(e->dm, &product));
  PetscCall(SpringsMultiply(e, u, product));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecGetArrayRead(product, &f));
  PetscCall(VecGetArrayRead(u, &v));
  for (PetscInt i = 0; i < n; ++i) *energy += 0.5 * PetscRealPart(f[i] * v[i]);
  PetscCall(VecRestoreArrayRead(u, &v));
  PetscCall(VecRestoreArrayRead(product, &f));
  PetscCall(DMRestoreGlobalVector(e->dm, &product));
  PetscFunctionReturn(0);
}

PetscErrorCode SpringsAddForce(Elasticity e, Vec u, Vec force)
{
  Vec product;

  PetscFunctionBegin;
  if (!(e->springs || e->between) || !u) PetscFunctionReturn(0);
  PetscCall(DMGetGlobalVector(e->dm, &product));
  PetscCall(SpringsMultiply(e, u, product));
  PetscCall(VecAXPY(force, 1.0, product));
  PetscCall(DMRestoreGlobalVector(e->dm, &product));
  PetscFunctionReturn(0);
}

/*
   Adds the stiffness of springs to the ground to the diagonal blocks of owned nodes: of all bodies if `all`, otherwise
   of those that are assembled again. The diagonal entries of prescribed unknowns may have any value.
*/
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
