/*
   Thermal strain for laws of small strain. The law is evaluated with the displacement gradient minus A T, where A is
   the thermal expansion tensor and T the temperature above the stress-free one.
   In each cell T is approximated by a linear function T_c + g.y of the position y relative to the centre, by least
   squares over the nodes. The thermal strain is then compatible: a free cell would have the displacement u = A y (T_c +
   g.y) - (y.A y)/2 g, whose symmetric gradient is A (T_c + g.y). Each cell is evaluated at its displacement minus this
   one, by any element. A free body in a linear temperature field is therefore free of stress, also in bending. The
   tangent is not affected.
*/
#include "elementsimpl.h"
#include <vector3.h>
#include <mesh.h>

static void ThermalCentre(PetscInt n, PetscReal X[3][CELL_MAX_NODES], PetscReal centre[3])
{
  for (int d = 0; d < 3; ++d) {
    centre[d] = 0;
    for (PetscInt a = 0; a < n; ++a) centre[d] += X[d][a] / (PetscReal)n;
  }
}

/* Computes fit = (T_c, g) from the nodal temperatures T */
static void ThermalFit(PetscInt n, PetscReal X[3][CELL_MAX_NODES], const PetscReal T[], PetscReal fit[4])
{
  PetscReal centre[3], M[3][3] = {{0}}, b[3] = {0};

  ThermalCentre(n, X, centre);
  fit[0] = 0;
  for (PetscInt a = 0; a < n; ++a) {
    const PetscReal y[3] = {X[0][a] - centre[0], X[1][a] - centre[1], X[2][a] - centre[2]};

    fit[0] += T[a] / (PetscReal)n;
    for (int i = 0; i < 3; ++i) {
      b[i] += y[i] * T[a];
      for (int j = 0; j < 3; ++j) M[i][j] += y[i] * y[j];
    }
  }
  (void)MatrixSolve(M, b, fit + 1);
}

/* Subtracts the free thermal displacement from a cell's displacement. fit: T_c and g of the cell. */
void ThermalSubtract(const PetscReal fit[4], CellState *cell)
{
  const PetscReal *A = cell->body->expansion;
  PetscReal        centre[3];

  ThermalCentre(cell->n, cell->X, centre);
  for (PetscInt a = 0; a < cell->n; ++a) {
    const PetscReal y[3] = {cell->X[0][a] - centre[0], cell->X[1][a] - centre[1], cell->X[2][a] - centre[2]};
    PetscReal       Ay[3], T = fit[0], yAy = 0;

    for (int i = 0; i < 3; ++i) {
      Ay[i] = A[3 * i] * y[0] + A[3 * i + 1] * y[1] + A[3 * i + 2] * y[2];
      T += fit[1 + i] * y[i];
      yAy += y[i] * Ay[i];
    }
    for (int i = 0; i < 3; ++i) cell->U[i][a] -= Ay[i] * T - 0.5 * yAy * fit[1 + i];
  }
}

/*@C
  ElasticityFitTemperature - Fits the temperature of a body by a linear function of the position in each cell

  Not Collective

  Input Parameters:
+ e           - the context
. body        - the body, from 0; `PETSC_DECIDE` for every body with thermal expansion
. temperature - function that gives the temperature at a position in the undeformed body
- ctx         - its context

  Output Parameter:
. fits - 4 values per local cell: temperature at the cell's centre, and its gradient; the fit is added to them
         [temperature, temperature/length]

  Level: intermediate

.seealso: `ElasticitySetTemperature()`
@*/
PetscErrorCode ElasticityFitTemperature(Elasticity e, PetscInt                            body,
  PetscErrorCode (*temperature)(void *ctx, const PetscReal x[3], PetscReal *value), void *ctx, PetscReal fits[])
{
  Vec                coordinates;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(MeshGetNodeCoordinates(e->dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt b = e->cellbody[c], n = e->cellstart[c + 1] - e->cellstart[c];
    PetscReal      X[3][CELL_MAX_NODES], T[CELL_MAX_NODES], fit[4];

    if (!e->bodies[b].expands || (body != PETSC_DECIDE && body != b)) continue;
    CellGather(n, e->cellnodes + e->cellstart[c], x, X);
    for (PetscInt a = 0; a < n; ++a) PetscCall(temperature(ctx, (PetscReal[3]){X[0][a], X[1][a], X[2][a]}, &T[a]));
    ThermalFit(n, X, T, fit);
    for (int k = 0; k < 4; ++k) fits[4 * c + k] += fit[k];
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

/*@
  ElasticitySetTemperature - Sets the temperature relative to the stress-free temperature

  Not Collective

  Input Parameters:
+ e    - the context
- fits - 4 values per local cell, from `ElasticityFitTemperature()`, copied; `NULL`: no temperature. Values of bodies
         without thermal expansion must be 0

  Level: intermediate

  Notes:
  Energy, force, stress and the error estimate are then computed from the elastic strain. Only laws of small strain have
  thermal expansion, and their tangent does not depend on the temperature.

.seealso: `ElasticityFitTemperature()`
@*/
PetscErrorCode ElasticitySetTemperature(Elasticity e, const PetscReal fits[])
{
  PetscFunctionBegin;
  if (!fits) {
    PetscCall(PetscFree(e->temperature));
    PetscFunctionReturn(0);
  }
  if (!e->temperature) PetscCall(PetscMalloc1(4 * e->ncells, &e->temperature));
  PetscCall(PetscArraycpy(e->temperature, fits, 4 * e->ncells));
  PetscFunctionReturn(0);
}

/* Gets the number of cells of this rank */
PetscErrorCode ElasticityGetCellCount(Elasticity e, PetscInt *ncells)
{
  PetscFunctionBegin;
  *ncells = e->ncells;
  PetscFunctionReturn(0);
}
