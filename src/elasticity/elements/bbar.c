/*
   Element with mean dilatation: E = int W_iso(H) + kappa/2 int Theta^2. Theta is the projection of the dilatation
   theta(H) onto polynomials on the cell. In cells of order 1 the polynomials are constants, and Theta is the mean of
   theta. In cells of order 2 they are linear functions of the position.
   Theta = sum_k Theta_k p_k with polynomials p_k that are orthogonal on the cell, Theta_k = int p_k theta / int p_k^2,
   and g_k = int p_k dtheta/du. For small strain this is B-bar. For laws with theta = J - 1 it is F-bar: W is evaluated
   at F (1 + Theta)^(1/3)/J^(1/3). Force and stiffness are derivatives of E, so that the stiffness is symmetric.
   In hyperelastic cells of order 2 the rest theta - Theta has the energy m->rest/2 int (theta - Theta)^2, which is
   m->rest/2 (int theta^2 - int Theta^2). Without it a local change of volume has no stiffness, and cells that are
   compressed by some tens of per cent deform into patterns.
   References: Nagtegaal, Parks and Rice, On numerically accurate finite element solutions in the fully plastic range,
   1974. Hughes, Generalization of selective integration procedures to anisotropic and nonlinear media, 1980. Simo,
   Taylor and Pister, Variational and projection methods for the volume constraint in finite deformation
   elasto-plasticity, 1985. Boffi and Gastaldi, On the quadrilateral Q2-P1 element for the Stokes problem, 2002
   (polynomials of the position instead of the cell's parameters).
*/
#include "elementsimpl.h"

#define POLYNOMIALS 4 /* largest number of polynomials */

typedef struct {
  int       npolynomials;
  CellPack  pack[CELL_PACKS];
  Lanes     p[CELL_PACKS][POLYNOMIALS]; /* values of the polynomials at the points; they are orthogonal on the cell, and
                                           the first is 1 */
  PetscReal g[POLYNOMIALS][3][CELL_MAX_NODES];
  PetscReal square[POLYNOMIALS], mean[POLYNOMIALS]; /* int p_k^2; Theta_k */
} Dilatation;

/* Sets p_k = X - X_13 at the points of a pack, with the coordinate X = x, y, z for k = 1, 2, 3 */
static void DilatationSetCoordinates(const CellBasis *basis, PetscInt pack, PetscReal X[3][CELL_MAX_NODES],
  Dilatation *d)
{
  for (int k = 1; k < d->npolynomials; ++k) {
    d->p[pack][k] = (Lanes){0};
    for (PetscInt q = LANES * pack; q < PetscMin(basis->npoints, LANES * (pack + 1)); ++q) {
      for (PetscInt a = 0; a < basis->nnodes; ++a)
        LANE(d->p[pack][k], q % LANES) += basis->N[q][a] * (X[k - 1][a] - X[k - 1][13]);
    }
  }
}

/* Returns int p_k p_l */
LANES_INLINE PetscReal DilatationProduct(const CellBasis *basis, const Dilatation *d, int k, int l)
{
  Lanes sum = {0};

  for (PetscInt pack = 0; pack < basis->npacks; ++pack) sum += d->pack[pack].w * d->p[pack][k] * d->p[pack][l];
  return LanesSum(&sum);
}

/* Makes the polynomials 1 and, in cells of order 2, x, y and z orthogonal on the cell */
LANES_INLINE void DilatationSetPolynomials(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES], Dilatation *d)
{
  d->npolynomials = basis->nnodes == 27 ? POLYNOMIALS : 1;
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    d->p[pack][0] = (Lanes){0} + 1;
    DilatationSetCoordinates(basis, pack, X, d);
  }
  for (int k = 0; k < d->npolynomials; ++k) {
    for (int l = 0; l < k; ++l) {
      const PetscReal part = DilatationProduct(basis, d, k, l) / d->square[l];

      for (PetscInt pack = 0; pack < basis->npacks; ++pack) d->p[pack][k] -= part * d->p[pack][l];
    }
    d->square[k] = DilatationProduct(basis, d, k, k);
  }
}

/* Sets volumes, gradients and displacement gradients at the points, the polynomials, Theta_k and g_k */
LANES_INLINE void ElementDilatation(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], Dilatation *d)
{
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) CellPackSet(n, basis, pack, X, U, &d->pack[pack]);
  DilatationSetPolynomials(basis, X, d);
  for (int k = 0; k < d->npolynomials; ++k) {
    d->mean[k] = 0;
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < n; ++a) d->g[k][i][a] = 0;
    }
  }
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    Lanes C[9], theta;

    PointsDilatation(m->law, pack, basis->npoints, d->pack[pack].H, C, &theta);
    for (int k = 0; k < d->npolynomials; ++k) {
      const Lanes part = d->pack[pack].w * d->p[pack][k] * theta;
      Lanes       D[9];

      for (int i = 0; i < 9; ++i) D[i] = d->p[pack][k] * C[i];
      d->mean[k] += LanesSum(&part) / d->square[k];
      CellPackForceAdd(n, &d->pack[pack], D, d->g[k]);
    }
  }
}

/* Returns the moduli of W_iso, with m->rest as bulk modulus. Laws with a history have no rest. */
static const MaterialModuli *BbarModuli(const BodyMaterial *m, MaterialModuli *own)
{
  if (!(m->rest > 0)) return &m->isochoric;
  *own        = m->isochoric;
  own->bulk   = m->rest;
  own->lambda = m->isochoric.lambda + m->rest;
  return own;
}

LANES_INLINE PetscReal BbarEnergy(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  Dilatation            d;
  MaterialModuli        own;
  const MaterialModuli *moduli = BbarModuli(m, &own);
  Lanes                 sum    = {0}, W;
  PetscReal             mean   = 0;

  ElementDilatation(n, basis, m, X, U, &d);
  for (int k = 0; k < d.npolynomials; ++k)
    mean += 0.5 * (m->moduli.bulk - m->rest) * d.square[k] * d.mean[k] * d.mean[k];
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    if (!PointsEnergy(m->law, moduli, pack, basis->npoints, d.pack[pack].H, &W)) return PETSC_INFINITY;
    sum += d.pack[pack].w * W;
  }
  return mean + LanesSum(&sum);
}

AMGF_CLONES static PetscReal ElementEnergy_Bbar(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  return CELL_CALL(BbarEnergy, basis, m, X, U);
}

/*
   Computes the force F = int dW_iso/du + kappa sum_k Theta_k int p_k^2 d Theta_k/du = int dW_iso/du + kappa sum_k
   Theta_k g_k
*/
LANES_INLINE PetscBool BbarForce(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Dilatation            d;
  MaterialModuli        own;
  const MaterialModuli *moduli = BbarModuli(m, &own);
  Lanes                 P[9];

  ElementDilatation(n, basis, m, X, U, &d);
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < n; ++a) F[i][a] = 0;
    for (int k = 0; k < d.npolynomials; ++k) {
      for (int a = 0; a < n; ++a) F[i][a] += (m->moduli.bulk - m->rest) * d.mean[k] * d.g[k][i][a];
    }
  }
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    if (!PointsStress(m->law, moduli, pack, basis->npoints, d.pack[pack].H, P)) return PETSC_FALSE;
    CellPackForceAdd(n, &d.pack[pack], P, F);
  }
  return PETSC_TRUE;
}

AMGF_CLONES static PetscBool ElementForce_Bbar(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  return CELL_CALL(BbarForce, basis, m, X, U, F);
}

/* Returns Theta at a point. mean: Theta_k */
static PetscReal DilatationAt(const Dilatation *d, const PetscReal mean[POLYNOMIALS], PetscInt q)
{
  PetscReal theta = 0;

  for (int k = 0; k < d->npolynomials; ++k) theta += mean[k] * LANE(d->p[q / LANES][k], q % LANES);
  return theta;
}

/* Copies the displacement gradient at a point */
static void DilatationGetGradient(const Dilatation *d, PetscInt q, PetscReal H[9])
{
  for (int i = 0; i < 9; ++i) H[i] = LANE(d->pack[q / LANES].H[i], q % LANES);
}

/* Adds kappa Theta times the second derivative of the dilatation to the tangents at the points of a pack. mean:
   Theta_k */
static void BbarAddCurvature(const CellBasis *basis, const BodyMaterial *m, const Dilatation *d,
  const PetscReal mean[POLYNOMIALS], PetscInt pack, Lanes A[81])
{
  for (PetscInt q = LANES * pack; m->law->curvature && q < PetscMin(basis->npoints, LANES * (pack + 1)); ++q) {
    PetscReal H[9], B[81] = {0};

    DilatationGetGradient(d, q, H);
    m->law->curvature((m->moduli.bulk - m->rest) * DilatationAt(d, mean, q), H, B);
    for (int i = 0; i < 81; ++i) LANE(A[i], q % LANES) += B[i];
  }
}

/*
   Computes Theta_k of U linearized at `before`. If a step of Newton's method goes from `before` to U, kappa Theta is
   then the pressure that the step was to give. That of U itself is false: the step changes volumes in the second order,
   and kappa is large. Its product with the second derivative of the dilatation would make the stiffness indefinite.
   Reference: Magisano, Leonetti and Garcea, How to improve efficiency and robustness of the Newton method in
   geometrically non-linear structural problem discretized via displacement-based finite elements, 2017.
*/
LANES_INLINE void BbarLinearize(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], Dilatation *d,
  PetscReal mean[POLYNOMIALS])
{
  ElementDilatation(n, basis, m, X, before, d);
  for (int k = 0; k < d->npolynomials; ++k) {
    PetscReal change = 0;

    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < n; ++a) change += d->g[k][i][a] * (U[i][a] - before[i][a]);
    }
    mean[k] = d->mean[k] + change / d->square[k];
  }
}

/*
   Computes the part of the stiffness that is a sum over the quadrature points: the isochoric stiffness, and kappa Theta
   times the second derivative of the dilatation
*/
LANES_INLINE PetscBool BbarTangents(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], Dilatation *d,
  CellTangents *t)
{
  MaterialModuli        own;
  const MaterialModuli *moduli = BbarModuli(m, &own);
  PetscReal             mean[POLYNOMIALS];

  if (before) BbarLinearize(n, basis, m, X, U, before, d, mean);
  ElementDilatation(n, basis, m, X, U, d);
  for (int k = 0; k < d->npolynomials && !before; ++k) mean[k] = d->mean[k];
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    if (!PointsTangent(m->law, moduli, pack, basis->npoints, d->pack[pack].H, t->A[pack])) return PETSC_FALSE;
    BbarAddCurvature(basis, m, d, mean, pack, t->A[pack]);
    CellTangentsSetGradients(n, basis, pack, d->pack[pack].G, t);
    for (int i = 0; i < 81; ++i) t->A[pack][i] *= d->pack[pack].w;
  }
  return PETSC_TRUE;
}

AMGF_CLONES static PetscBool ElementStiffnessPoints_Bbar(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], Dilatation *d,
  PetscScalar K[])
{
  CellTangents t;

  if (!CELL_CALL(BbarTangents, basis, m, X, U, before, d, &t)) return PETSC_FALSE;
  CellStiffness(basis, &t, K);
  return PETSC_TRUE;
}

AMGF_CLONES static void ElementDilatation_Bbar(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], Dilatation *d)
{
  CELL_CALL(ElementDilatation, basis, m, X, U, d);
}

/* Computes the stiffness K = int d2W_iso/du2 + kappa int Theta d2theta/du2 + kappa sum_k g_k g_k^T / int p_k^2 */
static PetscBool ElementStiffness_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], PetscScalar K[])
{
  const PetscInt width = 3 * basis->nnodes;
  Dilatation     d;
  PetscReal      rank1[3 * CELL_MAX_NODES];

  if (m->law->constant) {
    PetscReal undeformed[3][CELL_MAX_NODES] = {{0}};

    ElementDilatation_Bbar(basis, m, X, undeformed, &d);
    CellStiffnessConstant(basis, m->law, &m->isochoric, X, K);
  } else if (!ElementStiffnessPoints_Bbar(basis, m, X, U, before, &d, K)) return PETSC_FALSE;
  for (int k = 0; k < d.npolynomials; ++k) {
    for (PetscInt r = 0; r < width; ++r)
      rank1[r] = PetscSqrtReal((m->moduli.bulk - m->rest) / d.square[k]) * d.g[k][r % 3][r / 3];
    for (PetscInt r = 0; r < width; ++r) {
      for (PetscInt s = 0; s < width; ++s) K[width * r + s] += rank1[r] * rank1[s];
    }
  }
  return PETSC_TRUE;
}

/*
   Computes the mean Cauchy stress sigma = sigma_iso + kappa Theta I. The second term follows from theta's derivative
   cof F, which corresponds to the Cauchy stress cof F F^T / J = I.
*/
static PetscBool ElementCauchy_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  Dilatation     d;
  PetscReal      s[6], H[9];
  MaterialModuli own;

  ElementDilatation_Bbar(basis, m, X, U, &d);
  for (int k = 0; k < 6; ++k) sigma[k] = k < 3 ? m->moduli.bulk * d.mean[0] : 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    DilatationGetGradient(&d, q, H);
    if (!m->law->cauchy(CellModuli(&m->isochoric, q, &own), H, s)) return PETSC_FALSE;
    for (int k = 0; k < 6; ++k) sigma[k] += LANE(d.pack[q / LANES].w, q % LANES) / d.square[0] * s[k];
  }
  return PETSC_TRUE;
}

/* Computes at each quadrature point its volume w[q], and the displacement gradient and the projected dilatation H[q] */
static void ElementStrains_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  Dilatation d;

  ElementDilatation_Bbar(basis, m, X, U, &d);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    w[q] = LANE(d.pack[q / LANES].w, q % LANES);
    DilatationGetGradient(&d, q, H[q]);
    H[q][9] = DilatationAt(&d, d.mean, q);
  }
}

const Element ElementBbar = {
  .energy    = ElementEnergy_Bbar,
  .force     = ElementForce_Bbar,
  .stiffness = ElementStiffness_Bbar,
  .cauchy    = ElementCauchy_Bbar,
  .strains   = ElementStrains_Bbar,
};
