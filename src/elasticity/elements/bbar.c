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
  PetscReal w[CELL_MAX_POINTS], G[CELL_MAX_POINTS][3][CELL_MAX_NODES], H[CELL_MAX_POINTS][9];
  PetscReal p[CELL_MAX_POINTS][POLYNOMIALS]; /* values of the polynomials at the points; they are orthogonal on the
                                                cell, and the first is 1 */
  PetscReal g[POLYNOMIALS][3][CELL_MAX_NODES];
  PetscReal square[POLYNOMIALS], mean[POLYNOMIALS]; /* int p_k^2; Theta_k */
} Dilatation;

static inline void DilatationSetPoints(const int n, const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], Dilatation *d)
{
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    d->w[q] = CellGradients(n, basis, q, X, d->G[q]);
    CellDisplacementGradient(n, U, d->G[q], d->H[q]);
  }
}

/* Makes the polynomials 1 and, in cells of order 2, x, y and z orthogonal on the cell */
static void DilatationSetPolynomials(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES], Dilatation *d)
{
  d->npolynomials = basis->nnodes == 27 ? POLYNOMIALS : 1;
  for (int k = 0; k < d->npolynomials; ++k) {
    for (PetscInt q = 0; q < basis->npoints; ++q) {
      d->p[q][k] = k ? 0 : 1;
      for (PetscInt a = 0; k && a < basis->nnodes; ++a) d->p[q][k] += basis->N[q][a] * (X[k - 1][a] - X[k - 1][13]);
    }
    for (int l = 0; l < k; ++l) {
      PetscReal along = 0;

      for (PetscInt q = 0; q < basis->npoints; ++q) along += d->w[q] * d->p[q][k] * d->p[q][l];
      for (PetscInt q = 0; q < basis->npoints; ++q) d->p[q][k] -= along / d->square[l] * d->p[q][l];
    }
    d->square[k] = 0;
    for (PetscInt q = 0; q < basis->npoints; ++q) d->square[k] += d->w[q] * PetscSqr(d->p[q][k]);
  }
}

static inline void DilatationProject(const int n, const CellBasis *basis, const BodyMaterial *m, Dilatation *d)
{
  for (int k = 0; k < d->npolynomials; ++k) {
    d->mean[k] = 0;
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < n; ++a) d->g[k][i][a] = 0;
    }
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    PetscReal       C[9];
    const PetscReal theta = m->law->dilatation(d->H[q], C);

    for (int k = 0; k < d->npolynomials; ++k) {
      d->mean[k] += d->w[q] * d->p[q][k] * theta;
      CellForceAdd(n, d->w[q] * d->p[q][k], d->G[q], C, d->g[k]);
    }
  }
  for (int k = 0; k < d->npolynomials; ++k) d->mean[k] /= d->square[k];
}

static void ElementDilatation(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], Dilatation *d)
{
  CELL_CALL(DilatationSetPoints, basis, X, U, d);
  DilatationSetPolynomials(basis, X, d);
  CELL_CALL(DilatationProject, basis, m, d);
}

/* Returns Theta at a quadrature point */
static PetscReal DilatationAt(const Dilatation *d, PetscInt q)
{
  PetscReal theta = 0;

  for (int k = 0; k < d->npolynomials; ++k) theta += d->mean[k] * d->p[q][k];
  return theta;
}

/* Returns the moduli of W_iso at a point, with m->rest as bulk modulus */
static const MaterialModuli *BbarModuli(const BodyMaterial *m, PetscInt q, MaterialModuli *own)
{
  if (!(m->rest > 0)) return CellModuli(&m->isochoric, q, own);
  *own        = m->isochoric;
  own->bulk   = m->rest;
  own->lambda = m->isochoric.lambda + m->rest;
  return own;
}

static PetscReal ElementEnergy_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES])
{
  Dilatation     d;
  PetscReal      sum = 0;
  MaterialModuli own;

  ElementDilatation(basis, m, X, U, &d);
  for (int k = 0; k < d.npolynomials; ++k)
    sum += 0.5 * (m->moduli.bulk - m->rest) * d.square[k] * d.mean[k] * d.mean[k];
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal density = m->law->energy(BbarModuli(m, q, &own), d.H[q]);

    if (density >= PETSC_INFINITY) return PETSC_INFINITY;
    sum += d.w[q] * density;
  }
  return sum;
}

static inline PetscBool BbarForce(const int n, const CellBasis *basis, const BodyMaterial *m, Dilatation *d,
  PetscReal F[3][CELL_MAX_NODES])
{
  PetscReal      P[9];
  MaterialModuli own;

  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < n; ++a) F[i][a] = 0;
    for (int k = 0; k < d->npolynomials; ++k) {
      for (int a = 0; a < n; ++a) F[i][a] += (m->moduli.bulk - m->rest) * d->mean[k] * d->g[k][i][a];
    }
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (!m->law->stress(BbarModuli(m, q, &own), d->H[q], P)) return PETSC_FALSE;
    CellForceAdd(n, d->w[q], d->G[q], P, F);
  }
  return PETSC_TRUE;
}

/*
   Computes the force F = int dW_iso/du + kappa sum_k Theta_k int p_k^2 d Theta_k/du = int dW_iso/du + kappa sum_k
   Theta_k g_k
*/
static PetscBool ElementForce_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Dilatation d;

  ElementDilatation(basis, m, X, U, &d);
  return CELL_CALL(BbarForce, basis, m, &d, F);
}

/*
   Computes the part of the stiffness that is a sum over the quadrature points: the isochoric stiffness, and kappa Theta
   times the second derivative of the dilatation
*/
static PetscBool ElementStiffnessPoints_Bbar(const CellBasis *basis, const BodyMaterial *m, Dilatation *d,
  PetscScalar K[])
{
  PetscReal      A[81];
  CellTangents   t;
  MaterialModuli own;

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (!m->law->tangent(BbarModuli(m, q, &own), d->H[q], A)) return PETSC_FALSE;
    if (m->law->curvature) m->law->curvature((m->moduli.bulk - m->rest) * DilatationAt(d, q), d->H[q], A);
    CellTangentsSetPoint(basis, q, d->w[q], d->G[q], A, &t);
  }
  CellStiffness(basis, &t, K);
  return PETSC_TRUE;
}

/* Computes the stiffness K = int d2W_iso/du2 + kappa int Theta d2theta/du2 + kappa sum_k g_k g_k^T / int p_k^2 */
static PetscBool ElementStiffness_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  const PetscInt width = 3 * basis->nnodes;
  Dilatation     d;
  PetscReal      rank1[3 * CELL_MAX_NODES];

  if (m->law->constant) {
    PetscReal undeformed[3][CELL_MAX_NODES] = {{0}};

    ElementDilatation(basis, m, X, undeformed, &d);
    CellStiffnessConstant(basis, m->law, &m->isochoric, X, K);
  } else {
    ElementDilatation(basis, m, X, U, &d);
    if (!ElementStiffnessPoints_Bbar(basis, m, &d, K)) return PETSC_FALSE;
  }
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
  PetscReal      s[6];
  MaterialModuli own;

  ElementDilatation(basis, m, X, U, &d);
  for (int k = 0; k < 6; ++k) sigma[k] = k < 3 ? m->moduli.bulk * d.mean[0] : 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (!m->law->cauchy(CellModuli(&m->isochoric, q, &own), d.H[q], s)) return PETSC_FALSE;
    for (int k = 0; k < 6; ++k) sigma[k] += d.w[q] / d.square[0] * s[k];
  }
  return PETSC_TRUE;
}

/* Computes at each quadrature point its volume w[q], and the displacement gradient and the projected dilatation H[q] */
static void ElementStrains_Bbar(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  Dilatation d;

  ElementDilatation(basis, m, X, U, &d);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    w[q] = d.w[q];
    for (int k = 0; k < 9; ++k) H[q][k] = d.H[q][k];
    H[q][9] = DilatationAt(&d, q);
  }
}

const Element ElementBbar = {
  .energy    = ElementEnergy_Bbar,
  .force     = ElementForce_Bbar,
  .stiffness = ElementStiffness_Bbar,
  .cauchy    = ElementCauchy_Bbar,
  .strains   = ElementStrains_Bbar,
};
