/* Full integration: E = int W(H) */
#include "elasticityimpl.h"

static PetscReal ElementEnergy_Full(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8])
{
  PetscReal G[3][8], H[9], sum = 0;

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);
    PetscReal       density;

    HexDisplacementGradient(U, G, H);
    density = m->law->energy(m->lambda, m->mu, H);
    if (density >= PETSC_INFINITY) return PETSC_INFINITY;
    sum += w * density;
  }
  return sum;
}

static PetscBool ElementForce_Full(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscReal F[3][8])
{
  PetscReal G[3][8], H[9], P[9];

  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) F[i][a] = 0;
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);

    HexDisplacementGradient(U, G, H);
    if (!m->law->stress(m->lambda, m->mu, H, P)) return PETSC_FALSE;
    HexForceAdd(w, G, P, F);
  }
  return PETSC_TRUE;
}

/* K_ia,kb = int dN_a/dX_j dP_ij/dH_kl dN_b/dX_l */
static PetscBool ElementStiffnessPoints_Full(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscScalar K[24][24])
{
  PetscReal S[3][3][8][8] = {{{{0}}}}, G[3][8], H[9], A[81];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);

    HexDisplacementGradient(U, G, H);
    if (!m->law->tangent(m->lambda, m->mu, H, A)) return PETSC_FALSE;
    HexStiffnessAdd(w, G, A, S);
  }
  HexStiffnessFinish(S, K);
  return PETSC_TRUE;
}

static PetscBool ElementStiffness_Full(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscScalar K[24][24])
{
  if (!m->law->constant) return ElementStiffnessPoints_Full(basis, m, X, U, K);
  HexStiffnessIsotropic(basis, X, m->lambda, m->mu, K);
  return PETSC_TRUE;
}

static PetscBool ElementCauchy_Full(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscReal sigma[6])
{
  PetscReal G[3][8], H[9], s[6], volume = 0;

  for (int k = 0; k < 6; ++k) sigma[k] = 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);

    HexDisplacementGradient(U, G, H);
    if (!m->law->cauchy(m->lambda, m->mu, H, s)) return PETSC_FALSE;
    for (int k = 0; k < 6; ++k) sigma[k] += w * s[k];
    volume += w;
  }
  for (int k = 0; k < 6; ++k) sigma[k] /= volume;
  return PETSC_TRUE;
}

static void ElementStrains_Full(const HexBasis *basis, const BodyMaterial *m, PetscReal X[3][8], PetscReal U[3][8], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  PetscReal G[3][8], C[9];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    w[q] = HexGradients(basis, q, X, G);
    HexDisplacementGradient(U, G, H[q]);
    H[q][9] = m->law->dilatation(H[q], C);
  }
}

const Element ElementFull = {ElementEnergy_Full, ElementForce_Full, ElementStiffness_Full, ElementCauchy_Full, ElementStrains_Full};
