/* Output fields: stress at nodes and quadrature points, strain energy of cells */
#include "recoveryimpl.h"

/*
   Computes the Cauchy stress from a displacement gradient (9 values) and a separate dilatation theta, which determines
   the pressure kappa theta. Returns false, with infinite values, if the point is inverted.
*/
static PetscBool FieldsStress(const BodyMaterial *m, const PetscReal strain[ELEMENT_STRAINS], PetscReal stress[6])
{
  const PetscBool valid = m->law->cauchy(&m->isochoric, strain, stress);

  for (int k = 0; k < 6; ++k) stress[k] = valid ? stress[k] + (k < 3 ? m->moduli.bulk * strain[9] : 0) : PETSC_INFINITY;
  return valid;
}

/* Sums of the stresses at the nodes, 6 values per node, and number of contributions per node */
typedef struct {
  PetscReal *stress, *n;
} FieldsSums;

/* Adds the stresses at the selected bodies' nodes */
static PetscErrorCode FieldsAddNodes(Elasticity e, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const RecoveredNode recovered[], void *ctx)
{
  const FieldsSums *sums = (const FieldsSums *)ctx;
  PetscInt         *body;

  PetscFunctionBegin;
  (void)x, (void)u;
  PetscCall(PetscMalloc1(e->nnodes, &body));
  for (PetscInt v = 0; v < e->nnodes; ++v) body[v] = PETSC_DECIDE;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    for (PetscInt i = e->cellstart[c]; selected[e->cellbody[c]] && i < e->cellstart[c + 1]; ++i)
      body[e->cellnodes[i]] = e->cellbody[c];
  }
  for (PetscInt v = 0; v < e->nnodes; ++v) {
    PetscReal s[6];

    if (body[v] < 0) continue;
    (void)FieldsStress(&e->bodies[body[v]].material, recovered[v].value, s);
    for (int k = 0; k < 6; ++k) sums->stress[6 * v + k] += s[k];
    sums->n[v] += 1;
  }
  PetscCall(PetscFree(body));
  PetscFunctionReturn(0);
}

/*@
  ElasticityNodalStress - Computes the Cauchy stress at the nodes, recovered from the cells around each node

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per vertex [length]

  Output Parameter:
. stress - 6 values per node, in the order of the local section: xx yy zz xy yz zx [force/length^2]; free with
           `PetscFree()`

  Level: intermediate

  Notes:
  Displacement gradient and dilatation are recovered by superconvergent patches, body by body, as for the error
  estimate. The law gives the stress from them. It converges with second order up to the surface; the stress of the
  cells is of first order. A node of several bodies gets the mean of their values. A node at which the material is
  inverted gets `PETSC_INFINITY`.

.seealso: `ElasticityCellStress()`, `ElasticityPointStress()`, `ElasticityEstimateError()`, `ElasticityPrincipal()`
@*/
PetscErrorCode ElasticityNodalStress(Elasticity e, Vec u, PetscReal *stress[])
{
  FieldsSums sums;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(6 * e->nnodes, &sums.stress));
  PetscCall(PetscCalloc1(e->nnodes, &sums.n));
  PetscCall(ElasticityRecoverBodies(e, u, FieldsAddNodes, &sums));
  for (PetscInt i = 0; i < 6 * e->nnodes; ++i) sums.stress[i] /= PetscMax(1, sums.n[i / 6]);
  PetscCall(PetscFree(sums.n));
  *stress = sums.stress;
  PetscFunctionReturn(0);
}

/*@
  ElasticityPointStress - Computes the Cauchy stress at the quadrature points of the cells

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per vertex [length]

  Output Parameters:
+ npoints - number of quadrature points of all local cells
. places  - 3 undeformed coordinates per point, cell by cell [length]; free with `PetscFree()`
- stress  - 6 values per point: xx yy zz xy yz zx [force/length^2]; free with `PetscFree()`

  Level: intermediate

  Notes:
  The stress is the one that is conjugate to the element's strain. `ElasticityCellStress()` is its mean over a cell. An
  inverted point has `PETSC_INFINITY`.

.seealso: `ElasticityCellStress()`, `ElasticityNodalStress()`
@*/
PetscErrorCode ElasticityPointStress(Elasticity e, Vec u, PetscInt *npoints, PetscReal *places[], PetscReal *stress[])
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  *npoints = 0;
  for (PetscInt c = 0; c < e->ncells; ++c) *npoints += e->bodies[e->cellbody[c]].basis->npoints;
  PetscCall(PetscCalloc1(3 * *npoints, places));
  PetscCall(PetscMalloc1(6 * *npoints, stress));
  for (PetscInt c = 0, k = 0; c < e->ncells; ++c) {
    CellState        cell;
    const CellBasis *basis;
    PetscReal        w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS];

    ElasticityGetCell(e, c, x, ul, &cell);
    basis = cell.body->basis;
    cell.body->element->strains(basis, cell.material, cell.X, cell.U, w, H);
    for (PetscInt q = 0; q < basis->npoints; ++q, ++k) {
      CellElastic(cell.material, q, H[q]);
      (void)FieldsStress(&cell.body->material, H[q], *stress + 6 * k);
      for (int a = 0; a < basis->nnodes; ++a) {
        for (int d = 0; d < 3; ++d) (*places)[3 * k + d] += basis->N[q][a] * cell.X[d][a];
      }
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCellEnergy - Computes the strain energy of each cell per undeformed volume

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per vertex [length]

  Output Parameter:
. density - mean over each local cell, in the order of the mesh's cells [force/length^2]; free with `PetscFree()`

  Level: intermediate

  Notes:
  The sum of density times volume is `ElasticityEnergy()` minus the plastic work. An inverted cell has `PETSC_INFINITY`.

.seealso: `ElasticityEnergy()`, `ElasticityCellStress()`
@*/
PetscErrorCode ElasticityCellEnergy(Elasticity e, Vec u, PetscReal *density[])
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(PetscMalloc1(e->ncells + 1, density));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState        cell;
    const CellBasis *basis;
    PetscReal        G[3][CELL_MAX_NODES], volume = 0, energy;

    ElasticityGetCell(e, c, x, ul, &cell);
    basis = cell.body->basis;
    for (PetscInt q = 0; q < basis->npoints; ++q) volume += CELL_CALL(CellGradients, basis, q, cell.X, G);
    energy = cell.body->element->energy(basis, cell.material, cell.X, cell.U);
    for (PetscInt q = 0; cell.material->moduli.history && q < basis->npoints; ++q)
      energy -= CELL_CALL(CellGradients, basis, q, cell.X, G) *
                cell.material->law->work(&cell.material->moduli, cell.material->moduli.history + MATERIAL_HISTORY * q);
    (*density)[c] = energy < PETSC_INFINITY ? energy / volume : PETSC_INFINITY;
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}
