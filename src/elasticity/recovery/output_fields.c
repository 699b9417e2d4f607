/* Output fields: stress at nodes and quadrature points, strain energy of cells */
#include "recoveryimpl.h"
#include "src/report/events.h"

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

/* What is computed from the recovered strains; what is not wanted is NULL */
typedef struct {
  PetscReal      *stress, *n; /* sums of the stresses at the nodes, 6 values per node; number of summands per node */
  LargestValue   *von_mises, *displacement; /* of each body */
  EstimateSquares squares;
} FieldsRecovered;

/* Finds the largest von Mises stress and displacement of the bodies. stress: 6 values per node; body: of each node */
static PetscErrorCode FieldsFindLargest(Elasticity e, const PetscInt body[], const PetscReal stress[],
  const PetscScalar x[], const PetscScalar u[], const FieldsRecovered *fields)
{
  LargestSample *samples;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(e->nnodes, &samples));
  for (PetscInt pass = 0; pass < 2; ++pass) {
    PetscInt n = 0;

    for (PetscInt v = 0; v < e->nnodes; ++v) {
      PetscReal moved[3];

      if (body[v] < 0) continue;
      for (PetscInt d = 0; d < 3; ++d) {
        samples[n].place[d] = PetscRealPart(x[3 * v + d]);
        moved[d]            = PetscRealPart(u[3 * v + d]);
      }
      samples[n].of      = body[v];
      samples[n++].value = pass ? VectorNorm(moved) : StressVonMises(stress + 6 * v);
    }
    PetscCall(LargestFind(PetscObjectComm((PetscObject)e->dm), n, samples, e->nbodies,
      pass ? fields->displacement : fields->von_mises));
  }
  PetscCall(PetscFree(samples));
  PetscFunctionReturn(0);
}

/* Adds the stresses at the selected bodies' nodes, and finds the largest ones */
static PetscErrorCode FieldsAddNodes(Elasticity e, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const RecoveredNode recovered[], const FieldsRecovered *fields)
{
  PetscInt  *body;
  PetscReal *stress;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(e->nnodes, &body, 6 * e->nnodes, &stress));
  for (PetscInt v = 0; v < e->nnodes; ++v) body[v] = PETSC_DECIDE;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    for (PetscInt i = e->cellstart[c]; selected[e->cellbody[c]] && i < e->cellstart[c + 1]; ++i)
      body[e->cellnodes[i]] = e->cellbody[c];
  }
  for (PetscInt v = 0; v < e->nnodes; ++v) {
    const BodyMaterial *m = body[v] < 0 ? NULL : &e->bodies[body[v]].material;
    PetscReal           strain[ELEMENT_STRAINS];

    if (!m) continue;
    StretchGetStrain(m, &recovered[v], strain);
    (void)FieldsStress(m, strain, stress + 6 * v);
    for (int k = 0; k < 6 && fields->stress; ++k) fields->stress[6 * v + k] += stress[6 * v + k];
    if (fields->stress) fields->n[v] += 1;
  }
  if (fields->von_mises) PetscCall(FieldsFindLargest(e, body, stress, x, u, fields));
  PetscCall(PetscFree2(body, stress));
  PetscFunctionReturn(0);
}

static PetscErrorCode FieldsAdd(Elasticity e, const PetscBool selected[], const PetscScalar x[], const PetscScalar u[],
  const RecoveredNode recovered[], void *ctx)
{
  const FieldsRecovered *fields = (const FieldsRecovered *)ctx;

  PetscFunctionBegin;
  if (fields->stress || fields->von_mises) PetscCall(FieldsAddNodes(e, selected, x, u, recovered, fields));
  if (fields->squares.bodies) PetscCall(EstimateAdd(e, selected, x, u, recovered, &fields->squares));
  PetscFunctionReturn(0);
}

/*@
  ElasticityRecoverStress - Recovers the Cauchy stress at the nodes from the cells around each node, finds its largest
  values, and estimates the discretization error in the energy norm

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per vertex [length]

  Output Parameters:
+ stress  - 6 values per node, in the order of the local section: xx yy zz xy yz zx [force/length^2]; free with
            `PetscFree()`. `NULL` if not wanted
. largest - largest von Mises stress and largest displacement of each body, with their undeformed places, the same on
            every rank. `NULL` if not wanted
. errors  - squared energy norm of the error of each body, nbodies values, the same on every rank [force length].
            `NULL` if not wanted
- cells   - the part of `errors` of each local cell, in the order of the mesh's cells [force length]; free with
            `PetscFree()`. `NULL` if not wanted

  Level: intermediate

  Notes:
  Displacement gradient and dilatation are recovered by superconvergent patches, body by body. The law gives the stress
  from them. It converges with second order up to the surface; the stress of the cells is of first order. In `stress` a
  node of several bodies has the mean of their values. A node at which the material is inverted gets `PETSC_INFINITY`.

  For linear bodies the norm is |e|^2 = int (s - s_h) : C^(-1) : (s - s_h) with the true stress s and the elements' own
  stress s_h, and |e|^2/(2 E) is the relative error of the energy E. At finite strain it is the norm of the energy's
  second derivative at u. The true stress is replaced by the recovered one.

  For smooth solutions (manufactured ones, and Lame's sphere) with at least 8 cells across the body, the ratio of
  estimate to true norm is 0.9 to 1.3, and tends to 1 as the mesh is refined. An element that locks has a too small
  energy E; |e|/sqrt(2 E) shows its error even though |e| misses a part of it. Errors of the solver, of the loads and of
  the geometry are not included. In bodies with one layer of cells the estimate is rough.

  If a cell is inverted, the estimate is infinite.

  References:
  Zienkiewicz and Zhu, The superconvergent patch recovery and a posteriori error estimates, parts 1 and 2, 1992.

.seealso: `ElasticityCellStress()`, `ElasticityPointStress()`, `ElasticityEnergy()`, `ElasticityPrincipal()`
@*/
PetscErrorCode ElasticityRecoverStress(Elasticity e, Vec u, PetscReal *stress[], LargestOfBody largest[],
  PetscReal errors[], PetscReal *cells[])
{
  FieldsRecovered fields = {.squares = {.bodies = errors}};

  PetscFunctionBegin;
  if (errors) PetscCall(PetscLogEventBegin(ELASTICITY_Error, u, 0, 0, 0));
  if (stress) {
    PetscCall(PetscCalloc1(6 * e->nnodes + 1, &fields.stress)); /* not NULL on ranks without nodes */
    PetscCall(PetscCalloc1(e->nnodes, &fields.n));
  }
  if (largest) PetscCall(PetscCalloc2(e->nbodies, &fields.von_mises, e->nbodies, &fields.displacement));
  if (cells) PetscCall(PetscMalloc1(e->ncells, cells));
  if (cells) fields.squares.cells = *cells;
  if (errors) PetscCall(PetscArrayzero(errors, e->nbodies));
  PetscCall(ElasticityRecoverBodies(e, u, FieldsAdd, &fields));
  for (PetscInt i = 0; stress && i < 6 * e->nnodes; ++i) fields.stress[i] /= PetscMax(1, fields.n[i / 6]);
  for (PetscInt b = 0; largest && b < e->nbodies; ++b)
    largest[b] = (LargestOfBody){fields.von_mises[b], fields.displacement[b]};
  if (errors)
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, errors, (PetscMPIInt)e->nbodies, MPIU_REAL, MPIU_SUM,
      PetscObjectComm((PetscObject)e->dm)));
  PetscCall(PetscFree2(fields.von_mises, fields.displacement));
  if (stress) *stress = fields.stress;
  PetscCall(PetscFree(fields.n));
  if (errors) PetscCall(PetscLogEventEnd(ELASTICITY_Error, u, 0, 0, 0));
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

.seealso: `ElasticityCellStress()`, `ElasticityRecoverStress()`
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
