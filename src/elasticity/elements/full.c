/* Elements whose energy is integrated at the points of the basis: E = int W(H) */
#include "elementsimpl.h"

LANES_INLINE PetscReal FullEnergy(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  Lanes    sum = {0}, W;
  CellPack c;

  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    CellPackSet(n, basis, pack, X, U, &c);
    if (!PointsEnergy(m->law, &m->moduli, pack, basis->npoints, c.H, &W)) return PETSC_INFINITY;
    sum += c.w * W;
  }
  return LanesSum(&sum);
}

AMGF_CLONES static PetscReal ElementEnergy_Full(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  return CELL_CALL(FullEnergy, basis, m, X, U);
}

/* Computes F_ia = int P_ij dN_a/dX_j */
LANES_INLINE PetscBool FullForce(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Lanes    P[9];
  CellPack c;

  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < n; ++a) F[i][a] = 0;
  }
  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    CellPackSet(n, basis, pack, X, U, &c);
    if (!PointsStress(m->law, &m->moduli, pack, basis->npoints, c.H, P)) return PETSC_FALSE;
    CellPackForceAdd(n, &c, P, F);
  }
  return PETSC_TRUE;
}

AMGF_CLONES static PetscBool ElementForce_Full(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  return CELL_CALL(FullForce, basis, m, X, U, F);
}

/* Computes gradients, and dP_ij/dH_kl times the volumes of the points */
LANES_INLINE PetscBool FullTangents(const int n, const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], CellTangents *t)
{
  CellPack c;

  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    CellPackSet(n, basis, pack, X, U, &c);
    if (!PointsTangent(m->law, &m->moduli, pack, basis->npoints, c.H, t->A[pack])) return PETSC_FALSE;
    CellTangentsSetGradients(n, basis, pack, c.G, t);
    for (int i = 0; i < 81; ++i) t->A[pack][i] *= c.w;
  }
  return PETSC_TRUE;
}

AMGF_CLONES static PetscBool FullStiffness(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  CellTangents t;

  if (!CELL_CALL(FullTangents, basis, m, X, U, &t)) return PETSC_FALSE;
  CellStiffness(basis, &t, K);
  return PETSC_TRUE;
}

static PetscBool ElementStiffness_Full(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], PetscScalar K[])
{
  (void)before;
  if (!m->law->constant) return FullStiffness(basis, m, X, U, K);
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

const Element ElementReduced = {
  .nnodes    = 27,
  .energy    = ElementEnergy_Full,
  .force     = ElementForce_Full,
  .stiffness = ElementStiffness_Full,
  .cauchy    = ElementCauchy_Full,
  .strains   = ElementStrains_Full,
};
