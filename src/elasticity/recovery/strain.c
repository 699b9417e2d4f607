/* Measures strain and rotation of bodies with a law of small strain */
#include "recoveryimpl.h"

/*
   Computes the smallest and the largest eigenvalue of a symmetric matrix (xx yy zz xy yz zx) by the trigonometric
   formula, up to the square root of the rounding error. Jacobi's method takes ten times as long.
*/
static void StrainExtremes(const PetscReal e[6], PetscReal *least, PetscReal *most)
{
  const PetscReal mean = (e[0] + e[1] + e[2]) / 3.0, x = e[0] - mean, y = e[1] - mean, z = e[2] - mean;
  const PetscReal size = PetscSqrtReal(
    (PetscSqr(x) + PetscSqr(y) + PetscSqr(z) + 2.0 * (PetscSqr(e[3]) + PetscSqr(e[4]) + PetscSqr(e[5]))) / 6.0);
  PetscReal det, angle;

  *least = *most = mean;
  if (!(size > 0.0)) return;
  det   = x * (y * z - PetscSqr(e[4])) - e[3] * (e[3] * z - e[4] * e[5]) + e[5] * (e[3] * e[4] - y * e[5]);
  angle = PetscAcosReal(PetscClipInterval(0.5 * det / (size * size * size), -1.0, 1.0)) / 3.0;
  *most += 2.0 * size * PetscCosReal(angle);
  *least += 2.0 * size * PetscCosReal(angle + 2.0 * PETSC_PI / 3.0);
}

/*
   Computes the largest absolute principal strain, the angle of the infinitesimal rotation [rad], and whether a
   direction is compressed to a length of zero or less, from a displacement gradient
*/
static void StrainMeasure(const PetscReal H[9], PetscReal *strain, PetscReal *rotation, PetscBool *inverted)
{
  const PetscReal e[6] = {H[0], H[4], H[8], 0.5 * (H[1] + H[3]), 0.5 * (H[5] + H[7]), 0.5 * (H[2] + H[6])};
  PetscReal       least, most;

  StrainExtremes(e, &least, &most);
  *strain   = PetscMax(PetscAbsReal(least), PetscAbsReal(most));
  *inverted = (PetscBool)(least <= -1.0);
  *rotation = 0.5 * PetscSqrtReal(PetscSqr(H[7] - H[5]) + PetscSqr(H[2] - H[6]) + PetscSqr(H[3] - H[1]));
}

/* Computes the volume of a cell and the part of it that is inverted [length^3], and the means over the cell of the
   principal strain and of the rotation angle */
static PetscErrorCode StrainMeasureCell(const CellState *cell, PetscReal *volume, PetscReal *inverted,
  PetscReal *strain, PetscReal *rotation)
{
  const CellBasis *basis = cell->body->basis;
  PetscReal        w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], X[3][CELL_MAX_NODES], U[3][CELL_MAX_NODES];

  PetscFunctionBegin;
  PetscCall(PetscArraycpy(&X[0][0], &cell->X[0][0], 3 * CELL_MAX_NODES));
  PetscCall(PetscArraycpy(&U[0][0], &cell->U[0][0], 3 * CELL_MAX_NODES));
  cell->body->element->strains(basis, cell->material, X, U, w, H);
  *volume = *inverted = *strain = *rotation = 0.0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    PetscReal s = 0.0, r = 0.0;
    PetscBool turned = PETSC_FALSE;

    StrainMeasure(H[q], &s, &r, &turned);
    *volume += w[q];
    if (turned) *inverted += w[q];
    *strain += w[q] * s;
    *rotation += w[q] * r;
  }
  *strain /= *volume;
  *rotation /= *volume;
  PetscFunctionReturn(0);
}

/*
   Collective. Measures strain and rotation of bodies with a law of small strain. u: global displacement, 3 components
   per node [length]. Each body gets three values, which are 0 for other laws:

   - values[0]: mean of the largest absolute principal strain, weighted with the strain energy
   - values[1]: mean of the rotation angle, weighted with the volume [rad]
   - values[2]: fraction of the volume in which a direction is compressed to a length of zero or less

   With these weights unloaded parts have no influence on the strain, and the few cells at a singular edge have little.
*/
PetscErrorCode ElasticityMeasureStrain(Elasticity e, Vec u, PetscReal values[][3])
{
  Vec                local;
  const PetscScalar *ul, *x;
  PetscReal         *sums; /* per body: energy, energy x strain, volume, volume x rotation, inverted volume */

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(PetscCalloc1(5 * e->nbodies, &sums));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal *sum = sums + 5 * e->cellbody[c], volume, inverted, strain, rotation, energy;
    CellState  cell;

    ElasticityGetCell(e, c, x, ul, &cell);
    if (cell.body->material.law->finite) continue;
    PetscCall(StrainMeasureCell(&cell, &volume, &inverted, &strain, &rotation));
    energy = cell.body->element->energy(cell.body->basis, cell.material, cell.X, cell.U);
    sum[0] += energy;
    sum[1] += energy * strain;
    sum[2] += volume;
    sum[3] += volume * rotation;
    sum[4] += inverted;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(5 * e->nbodies), MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)u)));
  for (PetscInt b = 0; b < e->nbodies; ++b) {
    const PetscReal *sum = sums + 5 * b;

    values[b][0] = sum[0] > 0.0 ? sum[1] / sum[0] : 0.0;
    values[b][1] = sum[2] > 0.0 ? sum[3] / sum[2] : 0.0;
    values[b][2] = sum[2] > 0.0 ? sum[4] / sum[2] : 0.0;
  }
  PetscCall(PetscFree(sums));
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes bounds of what ElasticityMeasureStrain() computes, in a quarter of its time: the largest
   Frobenius norm of the strain at a quadrature point of each body, and the largest angle of rotation there [rad].
*/
PetscErrorCode ElasticityBoundStrain(Elasticity e, Vec u, PetscReal bounds[][2])
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  for (PetscInt b = 0; b < e->nbodies; ++b) bounds[b][0] = bounds[b][1] = 0.0;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal *bound = bounds[e->cellbody[c]], w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS];
    CellState  cell;

    ElasticityGetCell(e, c, x, ul, &cell);
    if (cell.body->material.law->finite) continue;
    cell.body->element->strains(cell.body->basis, cell.material, cell.X, cell.U, w, H);
    for (PetscInt q = 0; q < cell.body->basis->npoints; ++q) {
      const PetscReal *h       = H[q];
      const PetscReal  normal  = PetscSqr(h[0]) + PetscSqr(h[4]) + PetscSqr(h[8]),
                      shear    = PetscSqr(h[1] + h[3]) + PetscSqr(h[2] + h[6]) + PetscSqr(h[5] + h[7]),
                      rotation = PetscSqr(h[7] - h[5]) + PetscSqr(h[2] - h[6]) + PetscSqr(h[3] - h[1]);

      bound[0] = PetscMax(bound[0], normal + 0.5 * shear);
      bound[1] = PetscMax(bound[1], 0.25 * rotation);
    }
  }
  for (PetscInt i = 0; i < 2 * e->nbodies; ++i) (&bounds[0][0])[i] = PetscSqrtReal((&bounds[0][0])[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, (PetscMPIInt)(2 * e->nbodies), MPIU_REAL, MPIU_MAX,
    PetscObjectComm((PetscObject)u)));
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}
