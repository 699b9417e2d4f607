static char help[] =
  "Cells with incompatible modes, of metal without hardening that has flowed far and flows on by small "
  "steps: the force against differences of the energy.\n\n";

#include "src/elasticity/elements/elementsimpl.h"
#include <stdlib.h>

static PetscReal history[CELL_MAX_POINTS][MATERIAL_HISTORY];

/* Returns a number between -1 and 1 */
static PetscReal Random(void)
{
  return 2.0 * rand() / RAND_MAX - 1.0;
}

/* Moves the nodes of a cube with edges of 1 by up to 0.15, and displaces them by up to 1 */
static void Deform(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  for (PetscInt d = 0; d < 3; ++d) {
    for (PetscInt node = 0; node < 8; ++node) {
      X[d][node] = (basis->dN[0][d][node] > 0 ? 1.0 : 0.0) + 0.15 * Random();
      U[d][node] = Random();
    }
  }
}

/* Ends a load step at U, and begins another, with increments of up to `size` */
static void Advance(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal size)
{
  PetscReal w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], now[MATERIAL_HISTORY];

  CondensedStrains(basis, m, X, U, w, H);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    MaterialModuli own;

    (void)m->law->advance(CellModuli(&m->moduli, q, &own), H[q], now);
    for (PetscInt k = 0; k < MATERIAL_HISTORY; ++k) history[q][k] = now[k];
  }
  for (PetscInt d = 0; d < 3; ++d) {
    for (PetscInt node = 0; node < 8; ++node) U[d][node] += size * Random();
  }
}

/* Returns the difference between the slope of the energy and the force along a random direction, relative to the force
 */
static PetscReal Compare(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES])
{
  const PetscReal h = 1e-6;
  PetscReal       F[3][CELL_MAX_NODES], more[3][CELL_MAX_NODES], less[3][CELL_MAX_NODES], slope = 0, square = 0;

  (void)CondensedForce(basis, m, X, U, F);
  for (PetscInt d = 0; d < 3; ++d) {
    for (PetscInt node = 0; node < 8; ++node) {
      const PetscReal way = Random();

      more[d][node] = U[d][node] + h * way;
      less[d][node] = U[d][node] - h * way;
      slope += way * F[d][node];
      square += PetscSqr(F[d][node]);
    }
  }
  slope -= (CondensedEnergy(basis, m, X, more) - CondensedEnergy(basis, m, X, less)) / (2 * h);
  return PetscAbsReal(slope) / PetscSqrtReal(square);
}

int main(int argc, char **argv)
{
  const MaterialHardening hardening = {.yield = 1.0};
  const PetscReal         shear = 300.0, bulk = 650.0, tolerance = 1e-3;
  Material                material = {.type = MATERIAL_J2};
  BodyMaterial            m        = {.moduli = {.mu = shear, .bulk = bulk, .lambda = bulk - 2. / 3 * shear}};
  CellBasis               basis;
  PetscReal               X[3][CELL_MAX_NODES], U[3][CELL_MAX_NODES];
  PetscInt                wrong = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(CellBasisCreate(8, 2, &basis));
  PetscCall(MaterialGetLaw(&material, &m.law));
  m.moduli.hardening = &hardening;
  m.moduli.history   = (const PetscReal *)history;
  for (PetscInt n = 0; n < 500; ++n) {
    PetscCall(PetscMemzero(history, sizeof(history)));
    Deform(&basis, X, U);
    for (PetscInt k = 0; k < 3; ++k) Advance(&basis, &m, X, U, 1e-3);
    wrong += !(Compare(&basis, &m, X, U) < tolerance);
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " of 500 cells have another force\n", wrong));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
