/*
   Estimates the discretization error: the difference between the elements' strains and the recovered ones, in the
   energy norm
*/
#include "recoveryimpl.h"

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
  const CellBasis *basis  = cell->body->basis;
  const PetscBool  finite = cell->body->material.law->finite;
  PetscReal        w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], sum = 0;

  cell->body->element->strains(basis, cell->material, cell->X, cell->U, w, H);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    RecoveredNode here = {0};
    PetscReal     error[ELEMENT_STRAINS];

    CellElastic(cell->material, q, H[q]);
    for (PetscInt a = 0; a < cell->n; ++a) {
      for (int k = 0; k < RECOVERED_VALUES; ++k) here.value[k] += basis->N[q][a] * recovered[cell->nodes[a]].value[k];
    }
    for (int k = 0; k < ELEMENT_STRAINS; ++k) error[k] = here.value[k] - H[q][k];
    if (finite) StretchGetDirection(H[q], &here, error);
    sum += w[q] * EstimateNormSquared(&cell->body->material, H[q], error);
  }
  return sum;
}

/* Adds the squared errors of the selected bodies' cells */
PetscErrorCode EstimateAdd(Elasticity e, const PetscBool selected[], const PetscScalar x[], const PetscScalar u[],
  const RecoveredNode recovered[], const EstimateSquares *squares)
{
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
