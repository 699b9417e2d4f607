/*
   Estimates the discretization error: the difference between the elements' strains and the recovered ones, in the
   energy norm
*/
#include "recoveryimpl.h"
#include "src/report/events.h"

/*
   Returns the second derivative of the law's energy W = W_iso + kappa/2 theta^2 in the direction of a strain error;
   error[9], the error of the dilatation, is used for kappa. H: displacement gradient. The curvature of theta is
   omitted, since its integral vanishes under uniform pressure. At finite strain the isochoric tangent may be
   indefinite; negative values are replaced by zero.
*/
static PetscReal EstimateNormSquared(const BodyMaterial *m, const PetscReal H[9],
  const PetscReal error[ELEMENT_STRAINS])
{
  const PetscReal volumetric = m->moduli.bulk * error[9] * error[9];
  PetscReal       A[81], isochoric = 0;

  if (m->law->constant || !m->law->finite) return 2 * m->law->energy(&m->isochoric, error) + volumetric;
  if (!m->law->tangent(&m->isochoric, H, A)) return PETSC_INFINITY;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) isochoric += error[i] * A[9 * i + j] * error[j];
  }
  return PetscMax(isochoric, 0) + volumetric;
}

static PetscReal EstimateCellSquared(CellState *cell, const RecoveredNode recovered[])
{
  const CellBasis *basis = cell->body->basis;
  PetscReal        w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], sum = 0;

  cell->body->element->strains(basis, cell->material, cell->X, cell->U, w, H);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    PetscReal error[ELEMENT_STRAINS];

    CellElastic(cell->material, q, H[q]);
    for (int k = 0; k < ELEMENT_STRAINS; ++k) error[k] = -H[q][k];
    for (PetscInt a = 0; a < cell->n; ++a) {
      for (int k = 0; k < ELEMENT_STRAINS; ++k) error[k] += basis->N[q][a] * recovered[cell->nodes[a]].value[k];
    }
    sum += w[q] * EstimateNormSquared(&cell->body->material, H[q], error);
  }
  return sum;
}

/* Squared errors of the bodies, and of the cells unless this is NULL */
typedef struct {
  PetscReal *bodies, *cells;
} EstimateSquares;

/* Adds the squared errors of the selected bodies' cells */
static PetscErrorCode EstimateAdd(Elasticity e, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const RecoveredNode recovered[], void *ctx)
{
  EstimateSquares *squares = (EstimateSquares *)ctx;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt b = e->cellbody[c];
    CellState      cell;
    PetscReal      error;

    if (!selected[b]) continue;
    ElasticityGetCell(e, c, x, u, &cell);
    error = EstimateCellSquared(&cell, recovered);
    squares->bodies[b] += error;
    if (squares->cells) squares->cells[c] = error;
  }
  PetscFunctionReturn(0);
}

/*@
  ElasticityEstimateError - Estimates the discretization error of a displacement in the energy norm

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per vertex [length]

  Output Parameters:
+ bodies - squared energy norm of the error of each body, nbodies values, the same on every rank [force length]
- cells  - the part of each local cell, in the order of the mesh's cells [force length]; free with `PetscFree()`.
           `NULL` if not wanted

  Level: intermediate

  Notes:
  For linear bodies the norm is |e|^2 = int (s - s_h) : C^(-1) : (s - s_h) with the true stress s and the elements' own
  stress s_h, and |e|^2/(2 E) is the relative error of the energy E. At finite strain it is the norm of the energy's
  second derivative at u. The true stress is replaced by one recovered from the cells around each vertex, never across
  the border of a body.

  For smooth solutions (manufactured ones, and Lame's sphere) with at least 8 cells across the body, the ratio of
  estimate to true norm is 0.9 to 1.3, and tends to 1 as the mesh is refined. An element that locks has a too small
  energy E; |e|/sqrt(2 E) shows its error even though |e| misses a part of it. Errors of the solver, of the loads and of
  the geometry are not included. In bodies with one layer of cells the estimate is rough.

  If a cell is inverted, the estimate is infinite.

  References:
  Zienkiewicz and Zhu, The superconvergent patch recovery and a posteriori error estimates, parts 1 and 2, 1992.

.seealso: `ElasticityEnergy()`, `ElasticityCellStress()`
@*/
PetscErrorCode ElasticityEstimateError(Elasticity e, Vec u, PetscReal bodies[], PetscReal *cells[])
{
  EstimateSquares squares = {bodies, NULL};

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(ELASTICITY_Error, u, 0, 0, 0));
  if (cells) {
    PetscCall(PetscMalloc1(e->ncells, cells));
    squares.cells = *cells;
  }
  for (PetscInt b = 0; b < e->nbodies; ++b) bodies[b] = 0;
  PetscCall(ElasticityRecoverBodies(e, u, EstimateAdd, &squares));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bodies, (PetscMPIInt)e->nbodies, MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)e->dm)));
  PetscCall(PetscLogEventEnd(ELASTICITY_Error, u, 0, 0, 0));
  PetscFunctionReturn(0);
}
