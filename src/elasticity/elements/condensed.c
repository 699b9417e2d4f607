/*
   Incompatible modes of a law with a history: E = min over a of int W(H + sum_m a_m M_m), with convex W. Newton's
   method in the cell finds a, for which the forces int P:M_m on the modes vanish. The derivative of E is therefore that
   of the energy at fixed a, and
     K = K_uu - K_ua K_aa^(-1) K_au.
   A cell that remains elastic needs one Newton step.
*/
#include "elementsimpl.h"

#define MODES INCOMPATIBLE_MODES

typedef struct {
  PetscInt  npoints;
  PetscReal w[CELL_MAX_POINTS], G[CELL_MAX_POINTS][3][CELL_MAX_NODES], M[CELL_MAX_POINTS][MODES][9];
  PetscReal h[CELL_MAX_POINTS][9], H[CELL_MAX_POINTS][9]; /* displacement gradients without and with the modes */
  PetscReal a[MODES];
  PetscReal energy, force[MODES], L[MODES][MODES]; /* at H: energy; forces int P:M on the modes; Cholesky factor of
                                                      K_aa */
} Condensed;

static void CondensedSetPoints(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES],
  Condensed *c)
{
  PetscReal cofactor[3][3];

  c->npoints = basis->npoints;
  IncompatibleCentre(X, cofactor);
  for (PetscInt q = 0; q < c->npoints; ++q) {
    c->w[q] = CellGradients(8, basis, q, X, c->G[q]);
    CellDisplacementGradient(8, U, c->G[q], c->h[q]);
    IncompatibleModes(basis, q, c->w[q], cofactor, c->M[q]);
  }
}

static void CondensedMove(Condensed *c)
{
  for (PetscInt q = 0; q < c->npoints; ++q) {
    for (int j = 0; j < 9; ++j) {
      c->H[q][j] = c->h[q][j];
      for (int k = 0; k < MODES; ++k) c->H[q][j] += c->a[k] * c->M[q][k][j];
    }
  }
}

static PetscReal CondensedSum(const BodyMaterial *m, const Condensed *c)
{
  PetscReal      sum = 0;
  MaterialModuli own;

  for (PetscInt q = 0; q < c->npoints; ++q) sum += c->w[q] * m->law->energy(CellModuli(&m->moduli, q, &own), c->H[q]);
  return sum;
}

/*
   Computes the energy, the forces on the modes, and the factor of their stiffness K_aa. A small multiple of its
   diagonal is added, since without hardening K_aa may be singular.
*/
static void CondensedEvaluate(const BodyMaterial *m, Condensed *c)
{
  const PetscReal small = 1e-10;

  c->energy = CondensedSum(m, c);
  for (int k = 0; k < MODES; ++k) {
    c->force[k] = 0;
    for (int l = 0; l <= k; ++l) c->L[k][l] = 0;
  }
  for (PetscInt q = 0; q < c->npoints; ++q) {
    PetscReal             P[9], A[81];
    MaterialModuli        own;
    const MaterialModuli *moduli = CellModuli(&m->moduli, q, &own);

    (void)m->law->stress(moduli, c->H[q], P);
    (void)m->law->tangent(moduli, c->H[q], A);
    for (int k = 0; k < MODES; ++k) {
      PetscReal AM[9];

      for (int i = 0; i < 9; ++i) {
        AM[i] = 0;
        for (int j = 0; j < 9; ++j) AM[i] += A[9 * i + j] * c->M[q][k][j];
        c->force[k] += c->w[q] * P[i] * c->M[q][k][i];
      }
      for (int l = 0; l <= k; ++l) {
        for (int i = 0; i < 9; ++i) c->L[k][l] += c->w[q] * AM[i] * c->M[q][l][i];
      }
    }
  }
  for (int k = 0; k < MODES; ++k) c->L[k][k] *= 1 + small;
  IncompatibleFactor(c->L);
}

/* CondensedForward() computes x = L^(-1) x, and CondensedBackward() computes x = L^(-T) x */
static void CondensedForward(const Condensed *c, PetscReal x[MODES])
{
  for (int k = 0; k < MODES; ++k) {
    for (int l = 0; l < k; ++l) x[k] -= c->L[k][l] * x[l];
    x[k] /= c->L[k][k];
  }
}

static void CondensedBackward(const Condensed *c, PetscReal x[MODES])
{
  for (int k = MODES - 1; k >= 0; --k) {
    for (int l = k + 1; l < MODES; ++l) x[k] -= c->L[l][k] * x[l];
    x[k] /= c->L[k][k];
  }
}

/*
   Finds a by Newton's method with a line search on the energy. It ends with a step that is predicted to reduce the
   energy by less than rounding errors, or by about as little as the step before: metal that flows may have large
   rounding errors. This step is taken, too: without it small changes of U would leave `a` as it is, and the forces of
   the cell would change as if it had no modes.
*/
static void CondensedSolve(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], Condensed *c)
{
  const PetscReal negligible = 1e-26, little = PETSC_SQRT_MACHINE_EPSILON, progress = 0.25, fraction = 1e-4;
  PetscReal       predicted = PETSC_INFINITY;
  BodyMaterial    exact     = *m;
  PetscBool       last      = PETSC_FALSE;

  exact.moduli.secant = 0;
  CondensedSetPoints(basis, X, U, c);
  for (int k = 0; k < MODES; ++k) c->a[k] = 0;
  CondensedMove(c);
  for (int it = 0; it < 50 && !last; ++it) {
    PetscReal step[MODES], promised = 0, t = 1, before[MODES];

    CondensedEvaluate(&exact, c);
    for (int k = 0; k < MODES; ++k) {
      step[k]   = -c->force[k];
      before[k] = c->a[k];
    }
    CondensedForward(c, step);
    for (int k = 0; k < MODES; ++k) promised += step[k] * step[k];
    CondensedBackward(c, step);
    last      = (PetscBool)(!(promised > negligible * c->energy) ||
                       (promised < little * c->energy && promised > progress * predicted));
    predicted = promised;
    for (;; t *= 0.5) {
      for (int k = 0; k < MODES; ++k) c->a[k] = before[k] + t * step[k];
      CondensedMove(c);
      if (last || promised < little * c->energy || t < 1e-6) break;
      if (CondensedSum(m, c) <= c->energy - fraction * t * promised) break;
    }
  }
}

PetscReal CondensedEnergy(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES])
{
  Condensed c;

  CondensedSolve(basis, m, X, U, &c);
  return c.energy;
}

PetscBool CondensedForce(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Condensed      c;
  PetscReal      P[9];
  MaterialModuli own;

  CondensedSolve(basis, m, X, U, &c);
  for (int i = 0; i < 3; ++i) {
    for (int b = 0; b < 8; ++b) F[i][b] = 0;
  }
  for (PetscInt q = 0; q < c.npoints; ++q) {
    (void)m->law->stress(CellModuli(&m->moduli, q, &own), c.H[q], P);
    CellForceAdd(8, c.w[q], c.G[q], P, F);
  }
  return PETSC_TRUE;
}

PetscBool CondensedStiffness(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  PetscReal B[MODES][3][CELL_MAX_NODES] = {{{0}}}, A[81], AM[9];
  Condensed c;
  CellSums  S;

  CondensedSolve(basis, m, X, U, &c);
  CellSumsClear(8, &S);
  for (PetscInt q = 0; q < c.npoints; ++q) {
    MaterialModuli own;

    (void)m->law->tangent(CellModuli(&m->moduli, q, &own), c.H[q], A);
    CellStiffnessAdd(basis, c.w[q], c.G[q], A, &S);
    for (int k = 0; k < MODES; ++k) {
      for (int i = 0; i < 9; ++i) {
        AM[i] = 0;
        for (int j = 0; j < 9; ++j) AM[i] += A[9 * i + j] * c.M[q][k][j];
      }
      CellForceAdd(8, c.w[q], c.G[q], AM, B[k]);
    }
  }
  CellStiffnessFinish(basis, &S, K);
  for (int r = 0; r < 24; ++r) {
    PetscReal x[MODES];

    for (int k = 0; k < MODES; ++k) x[k] = B[k][r % 3][r / 3];
    CondensedForward(&c, x);
    for (int k = 0; k < MODES; ++k) B[k][r % 3][r / 3] = x[k];
  }
  for (int k = 0; k < MODES; ++k) {
    for (int r = 0; r < 24; ++r) {
      for (int s = 0; s < 24; ++s) K[24 * r + s] -= B[k][r % 3][r / 3] * B[k][s % 3][s / 3];
    }
  }
  return PETSC_TRUE;
}

PetscBool CondensedCauchy(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  PetscReal      volume = 0, s[6];
  Condensed      c;
  MaterialModuli own;

  CondensedSolve(basis, m, X, U, &c);
  for (int k = 0; k < 6; ++k) sigma[k] = 0;
  for (PetscInt q = 0; q < c.npoints; ++q) {
    (void)m->law->cauchy(CellModuli(&m->moduli, q, &own), c.H[q], s);
    for (int k = 0; k < 6; ++k) sigma[k] += c.w[q] * s[k];
    volume += c.w[q];
  }
  for (int k = 0; k < 6; ++k) sigma[k] /= volume;
  return PETSC_TRUE;
}

void CondensedStrains(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  PetscReal C[9];
  Condensed c;

  CondensedSolve(basis, m, X, U, &c);
  for (PetscInt q = 0; q < c.npoints; ++q) {
    w[q] = c.w[q];
    for (int j = 0; j < 9; ++j) H[q][j] = c.H[q][j];
    H[q][9] = m->law->dilatation(H[q], C);
  }
}
