/*
   Mean dilatation: E = int W_iso(H) + kappa/2 V Theta^2, where V is the cell's reference volume and Theta = 1/V int theta(H)
   its mean dilatation. For small strain that is B-bar; for laws with theta = J - 1 it is F-bar: W at F (1 + Theta)^(1/3)/J^(1/3).
   Force and stiffness are the derivatives of E, so the stiffness is symmetric; g = int dtheta/du.

   References:
   Nagtegaal, Parks and Rice, On numerically accurate finite element solutions in the fully plastic range, 1974.
   Hughes, Generalization of selective integration procedures to anisotropic and nonlinear media, 1980.
   Simo, Taylor and Pister, Variational and projection methods for the volume constraint in finite deformation elasto-plasticity, 1985.
*/
#include "elasticityimpl.h"

typedef struct {
  PetscReal w[HEX_MAX_POINTS], G[HEX_MAX_POINTS][3][8], H[HEX_MAX_POINTS][9];
  PetscReal g[3][8];
  PetscReal volume, mean; /* V, Theta */
} Dilatation;

static void ElementDilatation(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], Dilatation *d)
{
  PetscReal C[9], sum = 0;

  d->volume = 0;
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) d->g[i][a] = 0;
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    d->w[q] = HexGradients(basis, q, X, d->G[q]);
    HexDisplacementGradient(U, d->G[q], d->H[q]);
    sum += d->w[q] * m->law->dilatation(d->H[q], C);
    d->volume += d->w[q];
    HexForceAdd(d->w[q], d->G[q], C, d->g);
  }
  d->mean = sum / d->volume;
}

static PetscReal ElementEnergy_Bbar(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8])
{
  Dilatation d;
  PetscReal  sum;

  ElementDilatation(basis, m, X, U, &d);
  sum = 0.5 * BulkModulus(m) * d.volume * d.mean * d.mean;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal density = m->law->energy(IsochoricLambda(m), m->mu, d.H[q]);

    if (density >= PETSC_INFINITY) return PETSC_INFINITY;
    sum += d.w[q] * density;
  }
  return sum;
}

/* F = int dW_iso/du + kappa Theta g */
static PetscBool ElementForce_Bbar(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscReal F[3][8])
{
  Dilatation d;
  PetscReal  P[9];

  ElementDilatation(basis, m, X, U, &d);
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) F[i][a] = BulkModulus(m) * d.mean * d.g[i][a];
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (!m->law->stress(IsochoricLambda(m), m->mu, d.H[q], P)) return PETSC_FALSE;
    HexForceAdd(d.w[q], d.G[q], P, F);
  }
  return PETSC_TRUE;
}

/* The isochoric part, and kappa Theta times the dilatation's second derivative */
static PetscBool ElementStiffnessPoints_Bbar(const HexBasis *basis, const BodyMaterial *m, Dilatation *d, PetscScalar K[24][24])
{
  PetscReal S[3][3][8][8] = {{{{0}}}}, A[81];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (!m->law->tangent(IsochoricLambda(m), m->mu, d->H[q], A)) return PETSC_FALSE;
    m->law->curvature(BulkModulus(m) * d->mean, d->H[q], A);
    HexStiffnessAdd(d->w[q], d->G[q], A, S);
  }
  HexStiffnessFinish(S, K);
  return PETSC_TRUE;
}

/* K = int d2W_iso/du2 + kappa Theta int d2theta/du2 + kappa/V g g^T */
static PetscBool ElementStiffness_Bbar(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscScalar K[24][24])
{
  Dilatation d;
  PetscReal  rank1[24];

  if (m->law->constant) {
    PetscReal rest[3][8] = {{0}};

    ElementDilatation(basis, m, X, rest, &d);
    HexStiffnessIsotropic(basis, X, IsochoricLambda(m), m->mu, K);
  } else {
    ElementDilatation(basis, m, X, U, &d);
    if (!ElementStiffnessPoints_Bbar(basis, m, &d, K)) return PETSC_FALSE;
  }
  for (int a = 0; a < 8; ++a) {
    for (int i = 0; i < 3; ++i) rank1[3 * a + i] = PetscSqrtReal(BulkModulus(m) / d.volume) * d.g[i][a];
  }
  for (int r = 0; r < 24; ++r) {
    for (int s = 0; s < 24; ++s) K[r][s] += rank1[r] * rank1[s];
  }
  return PETSC_TRUE;
}

/* sigma = sigma_iso + kappa Theta I, as theta's derivative cof F gives the Cauchy stress cof F F^T / J = I */
static PetscBool ElementCauchy_Bbar(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscReal sigma[6])
{
  Dilatation d;
  PetscReal  s[6];

  ElementDilatation(basis, m, X, U, &d);
  for (int k = 0; k < 6; ++k) sigma[k] = k < 3 ? BulkModulus(m) * d.mean : 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (!m->law->cauchy(IsochoricLambda(m), m->mu, d.H[q], s)) return PETSC_FALSE;
    for (int k = 0; k < 6; ++k) sigma[k] += d.w[q] / d.volume * s[k];
  }
  return PETSC_TRUE;
}

/* The dilatation enters by its mean over the cell */
static void ElementStrains_Bbar(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  Dilatation d;

  ElementDilatation(basis, m, X, U, &d);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    w[q] = d.w[q];
    for (int k = 0; k < 9; ++k) H[q][k] = d.H[q][k];
    H[q][9] = d.mean;
  }
}

const Element ElementBbar = {ElementEnergy_Bbar, ElementForce_Bbar, ElementStiffness_Bbar, ElementCauchy_Bbar, ElementStrains_Bbar};
