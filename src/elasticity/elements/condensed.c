/*
   Incompatible modes of a law with a history: E = min over a of int W(H + sum_m a_m M_m), with convex W. Newton's
   method in the cell finds a, for which the forces int P:M_m on the modes vanish. The derivative of E is therefore that
   of the energy at fixed a, and
     K = K_uu - K_ua K_aa^(-1) K_au.
   A cell that remains elastic needs one step, with the elastic K_aa.
*/
#include "elementsimpl.h"

#define MODES INCOMPATIBLE_MODES

typedef struct {
  const CellBasis *basis;
  CellPack         points[CELL_PACKS];                        /* without the modes */
  Lanes            M[CELL_PACKS][MODES][9], H[CELL_PACKS][9]; /* the modes; displacement gradients with the modes */
  PetscReal        a[MODES];
  PetscReal        energy, force[MODES], L[MODES][MODES]; /* at H: energy; forces int P:M on the modes; Cholesky factor
                                                             of K_aa */
} Condensed;

static const PetscReal singular = 1e-10; /* multiple of the diagonal of K_aa that is added to it */

AMGF_CLONES static void CondensedSetPoints(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], Condensed *c)
{
  PetscReal cofactor[3][3], M[MODES][9];

  c->basis = basis;
  IncompatibleCentre(X, cofactor);
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    CellPackSet(8, basis, pack, X, U, &c->points[pack]);
    memset(c->M[pack], 0, sizeof(c->M[pack]));
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    IncompatibleModes(basis, q, LANE(c->points[q / LANES].w, q % LANES), cofactor, M);
    for (int i = 0; i < 9 * MODES; ++i) LANE(c->M[q / LANES][i / 9][i % 9], q % LANES) = M[i / 9][i % 9];
  }
}

AMGF_CLONES static void CondensedMove(Condensed *c)
{
  for (PetscInt pack = 0; pack < c->basis->npacks; ++pack) {
    for (int j = 0; j < 9; ++j) {
      c->H[pack][j] = c->points[pack].H[j];
      for (int k = 0; k < MODES; ++k) c->H[pack][j] += c->a[k] * c->M[pack][k][j];
    }
  }
}

AMGF_CLONES static PetscReal CondensedSum(const BodyMaterial *m, const Condensed *c)
{
  Lanes sum = {0}, W;

  for (PetscInt pack = 0; pack < c->basis->npacks; ++pack) {
    (void)PointsEnergy(m->law, &m->moduli, pack, c->basis->npoints, c->H[pack], &W);
    sum += c->points[pack].w * W;
  }
  return LanesSum(&sum);
}

/* Computes the forces on the modes */
AMGF_CLONES static void CondensedForces(const BodyMaterial *m, Condensed *c)
{
  Lanes force[MODES] = {}, P[9];

  for (PetscInt pack = 0; pack < c->basis->npacks; ++pack) {
    (void)PointsStress(m->law, &m->moduli, pack, c->basis->npoints, c->H[pack], P);
    for (int i = 0; i < 9; ++i) P[i] *= c->points[pack].w;
    for (int k = 0; k < MODES; ++k) {
      for (int i = 0; i < 9; ++i) force[k] += P[i] * c->M[pack][k][i];
    }
  }
  for (int k = 0; k < MODES; ++k) c->force[k] = LanesSum(&force[k]);
}

/* Computes the stresses AM = A M of a mode M */
LANES_INLINE void CondensedModeStress(const Lanes A[81], const Lanes M[9], Lanes AM[9])
{
  for (int i = 0; i < 9; ++i) {
    Lanes sum = {0};

    for (int j = 0; j < 9; ++j) sum += A[9 * i + j] * M[j];
    AM[i] = sum;
  }
}

/* Adds int AM:M_l over the points of a pack to row k of K_aa. AM: stresses of mode k, times the points' volumes */
LANES_INLINE void CondensedAddRow(PetscInt pack, int k, const Lanes AM[9], Condensed *c)
{
  for (int l = 0; l <= k; ++l) {
    Lanes sum = {0};

    for (int i = 0; i < 9; ++i) sum += AM[i] * c->M[pack][l][i];
    c->L[k][l] += LanesSum(&sum);
  }
}

/* Replaces K_aa by its factor. A small multiple of its diagonal is added: without hardening K_aa may be singular. */
static void CondensedFactor(Condensed *c)
{
  for (int k = 0; k < MODES; ++k) c->L[k][k] *= 1 + singular;
  IncompatibleFactor(c->L);
}

/* Computes the factor of the stiffness K_aa of the modes */
AMGF_CLONES static void CondensedSetFactor(const BodyMaterial *m, Condensed *c)
{
  memset(c->L, 0, sizeof(c->L));
  for (PetscInt pack = 0; pack < c->basis->npacks; ++pack) {
    Lanes A[81], AM[9];

    (void)PointsTangent(m->law, &m->moduli, pack, c->basis->npoints, c->H[pack], A);
    for (int i = 0; i < 81; ++i) A[i] *= c->points[pack].w;
    for (int k = 0; k < MODES; ++k) {
      CondensedModeStress(A, c->M[pack][k], AM);
      CondensedAddRow(pack, k, AM, c);
    }
  }
  CondensedFactor(c);
}

/* Computes the factor of K_aa without yielding */
AMGF_CLONES static void CondensedSetElasticFactor(const MaterialModuli *moduli, Condensed *c)
{
  memset(c->L, 0, sizeof(c->L));
  for (PetscInt pack = 0; pack < c->basis->npacks; ++pack) {
    const Lanes lambda = moduli->lambda * c->points[pack].w, mu = moduli->mu * c->points[pack].w;

    for (int k = 0; k < MODES; ++k) {
      const Lanes *M = c->M[pack][k], trace = M[0] + M[4] + M[8];
      Lanes        AM[9];

      for (int i = 0; i < 9; ++i) {
        AM[i] = mu * (M[i] + M[3 * (i % 3) + i / 3]);
        if (i % 4 == 0) AM[i] += lambda * trace;
      }
      CondensedAddRow(pack, k, AM, c);
    }
  }
  CondensedFactor(c);
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

/* Computes Newton's step from the forces on the modes. Returns the square of its norm in the stiffness K_aa, which is
   minus the slope of the energy along it. */
static PetscReal CondensedStep(const Condensed *c, PetscReal step[MODES])
{
  PetscReal square = 0;

  for (int k = 0; k < MODES; ++k) step[k] = -c->force[k];
  CondensedForward(c, step);
  for (int k = 0; k < MODES; ++k) square += step[k] * step[k];
  CondensedBackward(c, step);
  return square;
}

static void CondensedMoveBy(Condensed *c, const PetscReal before[MODES], PetscReal t, const PetscReal step[MODES])
{
  for (int k = 0; k < MODES; ++k) c->a[k] = before[k] + t * step[k];
  CondensedMove(c);
}

/*
   Sets `a` to the solution without further yielding. If U is that of the last state, this is the `a` of the last state.
*/
static void CondensedStart(const BodyMaterial *m, Condensed *c)
{
  const MaterialHardening never       = {.yield = PetscSqrtReal(PETSC_MAX_REAL)};
  const PetscReal         none[MODES] = {0};
  BodyMaterial            elastic     = *m;
  PetscReal               step[MODES];

  elastic.moduli.hardening = &never;
  CondensedMoveBy(c, none, 0, none);
  CondensedForces(&elastic, c);
  CondensedSetElasticFactor(&m->moduli, c);
  (void)CondensedStep(c, step);
  CondensedMoveBy(c, none, 1, step);
}

/*
   Moves the modes along Newton's step to where the slope of the convex energy is at most half as steep, and computes
   the forces there. Unlike differences of energies, slopes have no cancellation. square: minus the slope at the start
*/
static void CondensedSearch(const BodyMaterial *m, const PetscReal step[MODES], PetscReal square, Condensed *c)
{
  const PetscReal flatter = 0.5, least = 0.1;
  PetscReal       before[MODES], low = 0, high = 1, t = 1, slopes[2] = {-square, 0};

  for (int k = 0; k < MODES; ++k) before[k] = c->a[k];
  for (int it = 0; it < 50; ++it) {
    PetscReal slope = 0;

    CondensedMoveBy(c, before, t, step);
    CondensedForces(m, c);
    for (int k = 0; k < MODES; ++k) slope += c->force[k] * step[k];
    if (PetscAbsReal(slope) <= flatter * square || (slope < 0 && t == 1)) break;
    if (slope < 0) low = t;
    else high = t;
    slopes[slope > 0] = slope;
    t                 = low + (high - low) * PetscMin(PetscMax(slopes[0] / (slopes[0] - slopes[1]), least), 1 - least);
  }
}

/* Square of a step that is no longer taken into account, divided by the energy */
static const PetscReal negligible = 1e-26;

/*
   Moves `a` by Newton's method until a step is negligible or, below the rounding errors of the forces in K_aa, no
   longer falls: metal that flows without hardening has a K_aa that is almost singular. This step is the result.
*/
static void CondensedNewton(const BodyMaterial *m, Condensed *c, PetscReal step[MODES])
{
  const PetscReal rounding = PETSC_MACHINE_EPSILON * PETSC_MACHINE_EPSILON / singular, progress = 0.25;
  PetscReal       predicted = PETSC_INFINITY;

  for (int it = 0; it < 50; ++it) {
    PetscReal square;

    c->energy = CondensedSum(m, c);
    CondensedSetFactor(m, c);
    square = CondensedStep(c, step);
    if (!(square > negligible * c->energy)) break;
    if (square < rounding * c->energy && square > progress * predicted) break;
    predicted = square;
    CondensedSearch(m, step, square, c);
  }
}

/*
   Finds a. Without further yielding it is the start. The last step is taken, too: without it small changes of U would
   leave `a` as it is, and the forces of the cell would change as if it had no modes.
*/
static void CondensedSolve(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], Condensed *c)
{
  PetscReal step[MODES];

  CondensedSetPoints(basis, X, U, c);
  CondensedStart(m, c);
  CondensedForces(m, c);
  c->energy = CondensedSum(m, c);
  if (CondensedStep(c, step) > negligible * c->energy) CondensedNewton(m, c, step);
  CondensedMoveBy(c, c->a, 1, step);
}

PetscReal CondensedEnergy(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES])
{
  Condensed c;

  CondensedSolve(basis, m, X, U, &c);
  return c.energy;
}

/* Adds int P_ij dN_b/dX_j over the points of a pack to F. P: stress times the volumes of the points */
LANES_INLINE void CondensedAddForce(const Lanes P[9], const Lanes G[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  for (int i = 0; i < 3; ++i) {
    for (int b = 0; b < 8; ++b) {
      const Lanes f = P[3 * i] * G[0][b] + P[3 * i + 1] * G[1][b] + P[3 * i + 2] * G[2][b];

      F[i][b] += LanesSum(&f);
    }
  }
}

AMGF_CLONES PetscBool CondensedForce(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Condensed c;
  Lanes     P[9];

  CondensedSolve(basis, m, X, U, &c);
  for (int i = 0; i < 3; ++i) {
    for (int b = 0; b < 8; ++b) F[i][b] = 0;
  }
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    (void)PointsStress(m->law, &m->moduli, pack, basis->npoints, c.H[pack], P);
    for (int i = 0; i < 9; ++i) P[i] *= c.points[pack].w;
    CondensedAddForce(P, c.points[pack].G, F);
  }
  return PETSC_TRUE;
}

AMGF_CLONES PetscBool CondensedStiffness(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  PetscReal    B[MODES][3][CELL_MAX_NODES] = {{{0}}}, row[MODES][24];
  Lanes        AM[9];
  Condensed    c;
  CellTangents t;

  CondensedSolve(basis, m, X, U, &c);
  memset(c.L, 0, sizeof(c.L));
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    (void)PointsTangent(m->law, &m->moduli, pack, basis->npoints, c.H[pack], t.A[pack]);
    for (int i = 0; i < 81; ++i) t.A[pack][i] *= c.points[pack].w;
    CellTangentsSetGradients(8, basis, pack, c.points[pack].G, &t);
    for (int k = 0; k < MODES; ++k) {
      CondensedModeStress(t.A[pack], c.M[pack][k], AM);
      CondensedAddForce(AM, c.points[pack].G, B[k]);
      CondensedAddRow(pack, k, AM, &c);
    }
  }
  CondensedFactor(&c);
  CellStiffness(basis, &t, K);
  for (int r = 0; r < 24; ++r) {
    PetscReal x[MODES];

    for (int k = 0; k < MODES; ++k) x[k] = B[k][r % 3][r / 3];
    CondensedForward(&c, x);
    for (int k = 0; k < MODES; ++k) row[k][r] = x[k];
  }
  for (int r = 0; r < 24; ++r) {
    for (int k = 0; k < MODES; ++k) {
      for (int s = 0; s < 24; ++s) K[24 * r + s] -= row[k][r] * row[k][s];
    }
  }
  return PETSC_TRUE;
}

/* Copies the displacement gradient at point q. Returns the volume of the point. */
static PetscReal CondensedPoint(const Condensed *c, PetscInt q, PetscReal H[9])
{
  for (int i = 0; i < 9; ++i) H[i] = LANE(c->H[q / LANES][i], q % LANES);
  return LANE(c->points[q / LANES].w, q % LANES);
}

PetscBool CondensedCauchy(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  PetscReal      volume = 0, s[6], H[9];
  Condensed      c;
  MaterialModuli own;

  CondensedSolve(basis, m, X, U, &c);
  for (int k = 0; k < 6; ++k) sigma[k] = 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CondensedPoint(&c, q, H);

    (void)m->law->cauchy(CellModuli(&m->moduli, q, &own), H, s);
    for (int k = 0; k < 6; ++k) sigma[k] += w * s[k];
    volume += w;
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
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    w[q]    = CondensedPoint(&c, q, H[q]);
    H[q][9] = m->law->dilatation(H[q], C);
  }
}
