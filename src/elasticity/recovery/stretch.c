/*
   Separates rotation and stretch, for laws of finite strain. Means of displacement gradients of cells that turn
   differently have a strain that no cell has: 1 - cos(a) for rotations by a and -a. Means of stretches do not.
*/
#include "recoveryimpl.h"

#define STRETCH_ITERATIONS 20 /* Newton's iteration converges quadratically; strains below 10 need less than ten */

static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};

/*
   Computes the rotation R of the deformation gradient F = R U by Newton's iteration R <- (R + R^-T)/2. R is the
   identity if F is inverted.
*/
static void StretchRotation(const PetscReal H[9], PetscReal R[3][3])
{
  PetscReal change = PETSC_INFINITY;

  for (int i = 0; i < 9; ++i) R[i / 3][i % 3] = H[i] + (i % 4 ? 0.0 : 1.0);
  for (int n = 0; n < STRETCH_ITERATIONS && change > PETSC_SMALL; ++n) {
    PetscReal       C[3][3];
    const PetscReal det = MatrixCofactors(R, C);

    change = 0.0;
    for (int i = 0; i < 9; ++i) {
      const PetscReal next = det > 0.0 ? 0.5 * (R[i / 3][i % 3] + C[i / 3][i % 3] / det) : (i % 4 ? 0.0 : 1.0);

      change          = PetscMax(change, PetscAbsReal(next - R[i / 3][i % 3]));
      R[i / 3][i % 3] = next;
    }
  }
}

/* Computes the rotation R and U - 1 (xx yy zz xy yz zx) of the deformation gradient 1 + H = R U */
static void StretchFind(const PetscReal H[9], PetscReal R[3][3], PetscReal stretch[6])
{
  StretchRotation(H, R);
  for (int k = 0; k < 6; ++k) {
    const int i = row[k], j = column[k];

    stretch[k] = R[j][i] - (k < 3 ? 1.0 : 0.0);
    for (int l = 0; l < 3; ++l) stretch[k] += R[l][i] * H[3 * l + j];
  }
}

/* Replaces the strains in s by their elastic part at point q of a cell. For laws of finite strain, sets the stretch. */
void CellRecovered(const CellState *cell, PetscInt q, PetscReal s[RECOVERED_VALUES])
{
  PetscReal R[3][3];

  CellElastic(cell->material, q, s);
  if (cell->body->material.law->finite) StretchFind(s, R, s + ELEMENT_STRAINS);
}

/* Adds R E to a displacement gradient; E is symmetric (xx yy zz xy yz zx) */
static void StretchAddTurned(PetscReal R[3][3], const PetscReal E[6], PetscReal H[9])
{
  for (int k = 0; k < 6; ++k) {
    for (int i = 0; i < 3; ++i) {
      H[3 * i + column[k]] += R[i][row[k]] * E[k];
      if (k > 2) H[3 * i + row[k]] += R[i][column[k]] * E[k];
    }
  }
}

/*
   Computes the direction in which the deformation gradient F = 1 + H = R U changes on the way to the recovered values,
   R (U' - U) + S F, with the recovered stretch U', the recovered rotation Q and S = (Q R^T - R Q^T)/2. To first order
   it is the difference of the deformation gradients.
*/
void StretchGetDirection(const PetscReal H[9], const RecoveredNode *recovered, PetscReal direction[9])
{
  PetscReal R[3][3], Q[3][3], E[6], S[3][3];

  StretchFind(H, R, E);
  StretchRotation(recovered->value, Q);
  for (int k = 0; k < 6; ++k) E[k] = recovered->value[ELEMENT_STRAINS + k] - E[k];
  for (int i = 0; i < 9; ++i) S[i / 3][i % 3] = 0.5 * (VectorDot(Q[i / 3], R[i % 3]) - VectorDot(R[i / 3], Q[i % 3]));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      direction[3 * i + j] = S[i][j] + S[i][0] * H[j] + S[i][1] * H[3 + j] + S[i][2] * H[6 + j];
  }
  StretchAddTurned(R, E, direction);
}

/* Computes displacement gradient and dilatation from recovered values. The rotation is that of the recovered gradient;
   the stretch is the recovered one. */
void StretchGetStrain(const BodyMaterial *m, const RecoveredNode *node, PetscReal strain[ELEMENT_STRAINS])
{
  PetscReal R[3][3];

  for (int k = 0; k < ELEMENT_STRAINS; ++k) strain[k] = node->value[k];
  if (!m->law->finite) return;
  StretchRotation(node->value, R);
  for (int i = 0; i < 9; ++i) strain[i] = R[i / 3][i % 3] - (i % 4 ? 0.0 : 1.0);
  StretchAddTurned(R, node->value + ELEMENT_STRAINS, strain);
}
