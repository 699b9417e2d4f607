/* Mass of the bodies: a matrix, and its contribution to the tangent in dynamics */
#include "elasticityimpl.h"

/*
   Computes the lumped mass matrix M of a cell of unit density, the row sums of the consistent one. The mass of light
   nodes is moved to the cell's other nodes in proportion to their masses, unless all nodes of the cell are light.
*/
static void CellMassLumped(Elasticity e, const CellState *cell, PetscScalar M[])
{
  const PetscInt n = cell->n, width        = 3 * n;
  PetscReal      mass[CELL_MAX_NODES], all = 0, heavy = 0;

  CellMasses(cell->body->mass, (PetscReal(*)[CELL_MAX_NODES])cell->X, mass);
  for (PetscInt a = 0; a < n; ++a) {
    all += mass[a];
    if (!e->light || !e->light[cell->nodes[a]]) heavy += mass[a];
  }
  for (PetscInt a = 0; a < n; ++a) {
    const PetscReal fraction = heavy == 0 ? 1 : e->light && e->light[cell->nodes[a]] ? 0 : all / heavy;

    for (PetscInt i = 3 * a; i < 3 * a + 3; ++i) M[width * i + i] = fraction * mass[a];
  }
}

/*
   Computes the consistent mass matrix of a cell of unit density, int N_a N_b dV. For a tetrahedron of 4 nodes this is
   V/20 (1 + delta_ab).
*/
static void CellMassConsistent(const CellState *cell, PetscScalar M[])
{
  const CellBasis *basis = cell->body->mass;
  const PetscInt   n = cell->n, width = 3 * n;
  PetscReal        sum[CELL_MAX_NODES * CELL_MAX_NODES] = {0}, G[3][CELL_MAX_NODES];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients((int)n, basis, q, (PetscReal(*)[CELL_MAX_NODES])cell->X, G);

    for (PetscInt k = 0; k < n * n; ++k)
      sum[k] += n == 4 ? w * (k % 5 ? 0.05 : 0.1) : w * basis->N[q][k / n] * basis->N[q][k % n];
  }
  for (PetscInt k = 0; k < n * n; ++k) {
    for (PetscInt i = 0; i < 3; ++i) M[width * (3 * (k / n) + i) + 3 * (k % n) + i] = sum[k];
  }
}

/*
   Returns whether the cell's mass is consistent. Rigid bodies always have a consistent mass, so that their moments of
   inertia are exact. The mass of tetrahedra of 10 nodes is lumped, since their quadrature rule is not exact for
   products of shape functions.
*/
static PetscBool CellMassIsConsistent(Elasticity e, const CellState *cell)
{
  return (PetscBool)((e->consistent || cell->body->rigid) && cell->n != 10);
}

/* Computes the mass matrix of a cell of unit density */
static void CellMass(Elasticity e, const CellState *cell, PetscScalar M[])
{
  for (PetscInt i = 0; i < 9 * cell->n * cell->n; ++i) M[i] = 0;
  if (CellMassIsConsistent(e, cell)) CellMassConsistent(cell, M);
  else CellMassLumped(e, cell, M);
}

/*
   Computes K = (1 + viscosity) K + inertia M. For a rigid body with mass K is replaced by inertia M, since its
   stiffness only sets a scale.
*/
void CellAddInertia(Elasticity e, const CellState *cell, PetscScalar K[])
{
  const Body *body = cell->body;
  PetscScalar M[9 * CELL_MAX_NODES * CELL_MAX_NODES];

  if (e->inertia == 0 || body->density == 0) return;
  CellMass(e, cell, M);
  for (PetscInt i = 0; i < 9 * cell->n * cell->n; ++i)
    K[i] = (body->rigid ? 0 : (1 + e->viscosity) * K[i]) + e->inertia * body->density * M[i];
}

/*@
  ElasticitySetMass - Sets the density and the type of the bodies' mass

  Collective

  Input Parameters:
+ e          - the context
. density    - of each body [mass/length^3]
. consistent - whether the mass is consistent, the integral of products of shape functions, or lumped. That of rigid
               bodies is consistent in both cases
- light      - global vector, positive at the nodes that have no lumped mass. The other nodes of their cells carry it.
               `NULL`: there are no such nodes

  Level: intermediate

  Notes:
  In a cell all of whose nodes are light, no mass is moved. The mass of a body is the same in all cases.

  References:
  Khenous, Laborde and Renard, Mass redistribution method for finite element contact problems in elastodynamics, 2008.

.seealso: `ElasticityCreateMass()`, `ElasticitySetInertia()`
@*/
PetscErrorCode ElasticitySetMass(Elasticity e, const PetscReal density[], PetscBool consistent, Vec light)
{
  Vec                local;
  const PetscScalar *l;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < e->nbodies; ++b) e->bodies[b].density = density[b];
  e->consistent = consistent;
  PetscCall(PetscFree(e->light));
  if (!light) PetscFunctionReturn(0);
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(DMGlobalToLocal(e->dm, light, INSERT_VALUES, local));
  PetscCall(PetscCalloc1(e->nnodes, &e->light));
  PetscCall(VecGetArrayRead(local, &l));
  for (PetscInt v = 0; v < e->nnodes; ++v) e->light[v] = (PetscBool)(PetscRealPart(l[3 * v]) > 0);
  PetscCall(VecRestoreArrayRead(local, &l));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*
   Creates the mass matrix: with the pattern of the tangent if any mass is consistent, otherwise with the 3 x 3 blocks
   on the diagonal, which are sufficient for lumped mass
*/
static PetscErrorCode ElasticityCreateMassMatrix(Elasticity e, Mat *mass)
{
  Vec       global;
  PetscInt  n;
  PetscBool coupled = e->consistent;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < e->nbodies; ++b) coupled = (PetscBool)(coupled || e->bodies[b].rigid);
  if (coupled) {
    PetscCall(ElasticityCreateTangent(e, mass));
    PetscFunctionReturn(0);
  }
  PetscCall(DMGetGlobalVector(e->dm, &global));
  PetscCall(VecGetLocalSize(global, &n));
  PetscCall(DMRestoreGlobalVector(e->dm, &global));
  PetscCall(MatCreateBAIJ(PetscObjectComm((PetscObject)e->dm), 3, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 0,
    NULL, mass));
  PetscCall(MatSetOption(*mass, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCreateMass - Computes the mass matrix of the bodies

  Collective

  Input Parameter:
. e - the context, after `ElasticitySetMass()`

  Output Parameter:
. mass - new matrix, on all rows, the prescribed ones too [mass]

  Level: intermediate

.seealso: `ElasticitySetMass()`, `ElasticityLumpedMass()`
@*/
PetscErrorCode ElasticityCreateMass(Elasticity e, Mat *mass)
{
  ISLocalToGlobalMapping map;
  const PetscInt        *global;
  Vec                    local;
  const PetscScalar     *x, *ul;

  PetscFunctionBegin;
  PetscCall(ElasticityCreateMassMatrix(e, mass));
  PetscCall(DMGetLocalToGlobalMapping(e->dm, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  PetscCall(ElasticityGetLocals(e, NULL, &local, &ul, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState   cell;
    PetscInt    rows[CELL_MAX_NODES];
    PetscScalar M[9 * CELL_MAX_NODES * CELL_MAX_NODES];

    ElasticityGetCell(e, c, x, ul, &cell);
    CellMass(e, &cell, M);
    for (PetscInt i = 0; i < 9 * cell.n * cell.n; ++i) M[i] *= cell.body->density;
    for (PetscInt a = 0; a < cell.n; ++a) rows[a] = global[cell.nodes[a]];
    if (CellMassIsConsistent(e, &cell)) {
      PetscCall(MatSetValuesBlocked(*mass, cell.n, rows, cell.n, rows, M, ADD_VALUES));
      continue;
    }
    for (PetscInt a = 0; a < cell.n; ++a) {
      PetscScalar block[9] = {0};

      for (PetscInt d = 0; d < 3; ++d) block[4 * d] = M[(3 * a + d) * (3 * cell.n + 1)];
      PetscCall(MatSetValuesBlocked(*mass, 1, &rows[a], 1, &rows[a], block, ADD_VALUES));
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  PetscCall(MatAssemblyBegin(*mass, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*mass, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/*@
  ElasticitySetInertia - Adds the mass matrix to later tangents, as time steps require

  Collective

  Input Parameters:
+ e         - the context, after `ElasticitySetMass()`
. inertia   - factor of the mass matrix [1/time^2]
- viscosity - relative increase of the cells' stiffness, for damping

  Output Parameter:
. changed - whether the factors have changed; the next tangent is then assembled completely

  Level: intermediate

.seealso: `ElasticityTangent()`, `ElasticityCreateMass()`
@*/
PetscErrorCode ElasticitySetInertia(Elasticity e, PetscReal inertia, PetscReal viscosity, PetscBool *changed)
{
  PetscFunctionBegin;
  *changed = (PetscBool)(PetscAbsReal(inertia - e->inertia) > 1e-12 * inertia ||
                         PetscAbsReal(viscosity - e->viscosity) > 1e-12 * (1 + viscosity));
  if (!*changed) PetscFunctionReturn(0);
  e->inertia      = inertia;
  e->viscosity    = viscosity;
  e->assembled.id = 0;
  PetscFunctionReturn(0);
}
