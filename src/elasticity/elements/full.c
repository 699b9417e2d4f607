/* Element with full integration: E = int W(H) */
#include "elementsimpl.h"

static inline PetscReal FullEnergy(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  PetscReal      G[3][CELL_MAX_NODES], H[9], sum = 0;
  MaterialModuli own;

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(n, basis, q, X, G);
    PetscReal       density;

    CellDisplacementGradient(n, U, G, H);
    density = m->law->energy(CellModuli(&m->moduli, q, &own), H);
    if (density >= PETSC_INFINITY) return PETSC_INFINITY;
    sum += w * density;
  }
  return sum;
}

static PetscReal ElementEnergy_Full(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES])
{
  return CELL_CALL(FullEnergy, basis, m, X, U);
}

static inline PetscBool FullForce(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  PetscReal      G[3][CELL_MAX_NODES], H[9], P[9];
  MaterialModuli own;

  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < n; ++a) F[i][a] = 0;
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(n, basis, q, X, G);

    CellDisplacementGradient(n, U, G, H);
    if (!m->law->stress(CellModuli(&m->moduli, q, &own), H, P)) return PETSC_FALSE;
    CellForceAdd(n, w, G, P, F);
  }
  return PETSC_TRUE;
}

static PetscBool ElementForce_Full(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  return CELL_CALL(FullForce, basis, m, X, U, F);
}

/* Computes K_ia,kb = int dN_a/dX_j dP_ij/dH_kl dN_b/dX_l */
static inline PetscBool FullStiffness(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  PetscReal      G[3][CELL_MAX_NODES], H[9], A[81];
  CellSums       S;
  MaterialModuli own;

  CellSumsClear(n, &S);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(n, basis, q, X, G);

    CellDisplacementGradient(n, U, G, H);
    if (!m->law->tangent(CellModuli(&m->moduli, q, &own), H, A)) return PETSC_FALSE;
    CellStiffnessAdd(basis, w, G, A, &S);
  }
  CellStiffnessFinish(basis, &S, K);
  return PETSC_TRUE;
}

static PetscBool ElementStiffness_Full(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  if (!m->law->constant) return CELL_CALL(FullStiffness, basis, m, X, U, K);
  CellStiffnessConstant(basis, m->law, &m->moduli, X, K);
  return PETSC_TRUE;
}

static inline PetscBool FullCauchy(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  PetscReal      G[3][CELL_MAX_NODES], H[9], s[6], volume = 0;
  MaterialModuli own;

  for (int k = 0; k < 6; ++k) sigma[k] = 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(n, basis, q, X, G);

    CellDisplacementGradient(n, U, G, H);
    if (!m->law->cauchy(CellModuli(&m->moduli, q, &own), H, s)) return PETSC_FALSE;
    for (int k = 0; k < 6; ++k) sigma[k] += w * s[k];
    volume += w;
  }
  for (int k = 0; k < 6; ++k) sigma[k] /= volume;
  return PETSC_TRUE;
}

static PetscBool ElementCauchy_Full(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  return CELL_CALL(FullCauchy, basis, m, X, U, sigma);
}

static inline void FullStrains(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  PetscReal G[3][CELL_MAX_NODES], C[9];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    w[q] = CellGradients(n, basis, q, X, G);
    CellDisplacementGradient(n, U, G, H[q]);
    H[q][9] = m->law->dilatation(H[q], C);
  }
}

static void ElementStrains_Full(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  CELL_CALL(FullStrains, basis, m, X, U, w, H);
}

const Element ElementFull = {
  .energy    = ElementEnergy_Full,
  .force     = ElementForce_Full,
  .stiffness = ElementStiffness_Full,
  .cauchy    = ElementCauchy_Full,
  .strains   = ElementStrains_Full,
};
