/*
   Plasticity of von Mises at finite strain: F = Fe Fp, det Fp = 1, with an energy of the elastic logarithmic strain
   Ee = 1/2 ln Fe^T Fe. In a step from the history Fp_n, p_n, a_n the trial strain is that of Fe* = F Fp_n^(-1), and

     W(F) = W_j2(dev E* + p_n) + kappa/2 (det F - 1)^2, W_j2: the energy of j2 with the history p_n, a_n

   so that radial return, hardening and plastic work are those of j2.c. At the end Fe = R* exp(Ee), with the rotation R*
   of Fe* and Ee = E* - (p - p_n), hence Fp^(-1) = Fp_n^(-1) exp(-E*) exp(Ee). Without kinematic hardening E* and Ee
   have common axes, and this is the exponential map (Simo, Algorithms for static and dynamic multiplicative plasticity
   that preserve the classical return mapping schemes, 1992); with it that of Eterovic and Bathe, A hyperelastic-based
   large strain elasto-plastic constitutive formulation with combined isotropic-kinematic hardening, 1990: plastic
   spin is zero. The history is p, the integral of the plastic strain rate, and a as of j2, and Fp^(-1) - I.
*/
#include "materialimpl.h"

#define J2_INVERSE 7 /* index in the history at which Fp^(-1) - I begins */

/* Returns Fp_n^(-1) - I; zero if there is no history */
static const PetscReal *J2Inverse(const MaterialModuli *m)
{
  static const PetscReal zero[9] = {0};

  return m->history ? m->history + J2_INVERSE : zero;
}

/* Computes M (I + N) + N, which is (I + M)(I + N) - I. If `transposed`, computes M (I + N)^T. */
static void J2Multiply(const PetscReal M[9], const PetscReal N[9], PetscBool transposed, PetscReal product[9])
{
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      PetscReal sum = M[3 * i + j] + (transposed ? 0 : N[3 * i + j]);

      for (int k = 0; k < 3; ++k) sum += M[3 * i + k] * (transposed ? N[3 * j + k] : N[3 * k + j]);
      product[3 * i + j] = sum;
    }
  }
}

/*
   The elastic trial state of a step: H = Fe* - I; theta = det F - 1 and its derivative C by Fe*; the logarithmic strain
   E*; strain = dev E* + p_n
*/
typedef struct {
  PetscReal   H[9], theta, C[9], strain[9];
  Logarithmic log;
} J2Trial;

/* Computes the trial state. Returns false if the material is inverted. */
static PetscBool J2SetTrial(const MaterialModuli *m, const PetscReal H[9], J2Trial *t)
{
  static const int at[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  PetscReal        mean;

  J2Multiply(H, J2Inverse(m), PETSC_FALSE, t->H);
  t->theta = MaterialLawNeoHookean.dilatation(t->H, t->C);
  if (!(t->theta > -1) || !LogarithmicStrain(t->H, &t->log)) return PETSC_FALSE;
  mean = (t->log.E[0] + t->log.E[4] + t->log.E[8]) / 3;
  for (int i = 0; i < 9; ++i) t->strain[i] = t->log.E[i] - (i % 4 ? 0 : mean) + (m->history ? m->history[at[i]] : 0);
  return PETSC_TRUE;
}

static PetscReal MaterialEnergy_J2Finite(const MaterialModuli *m, const PetscReal H[9])
{
  J2Trial t;

  return J2SetTrial(m, H, &t) ? MaterialLawJ2.energy(m, t.strain) + 0.5 * m->bulk * t.theta * t.theta : PETSC_INFINITY;
}

/* Computes P = dW/dFe* */
static void J2TrialStress(const MaterialModuli *m, J2Trial *t, PetscReal P[9])
{
  PetscReal T[9];

  (void)MaterialLawJ2.stress(m, t->strain, T);
  LogarithmicStress(&t->log, t->H, T, P);
  for (int i = 0; i < 9; ++i) P[i] += m->bulk * t->theta * t->C[i];
}

/* Computes P = dW/dFe* Fp_n^(-T) */
static PetscBool MaterialStress_J2Finite(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  PetscReal trial[9];
  J2Trial   t;

  if (!J2SetTrial(m, H, &t)) return PETSC_FALSE;
  J2TrialStress(m, &t, trial);
  J2Multiply(trial, J2Inverse(m), PETSC_TRUE, P);
  return PETSC_TRUE;
}

/* Computes A = d2W/dFe* dFe* */
static void J2TrialTangent(const MaterialModuli *m, J2Trial *t, PetscReal A[81])
{
  PetscReal T[9], D[81];

  (void)MaterialLawJ2.stress(m, t->strain, T);
  (void)MaterialLawJ2.tangent(m, t->strain, D);
  /* Subtract the bulk modulus: the energy of j2 is that of the deviator only. */
  for (int i = 0; i < 9; ++i) D[36 * (i / 3) + 4 * (i % 3)] -= m->bulk;
  LogarithmicTangent(&t->log, t->H, T, D, A);
  for (int i = 0; i < 81; ++i) A[i] += m->bulk * t->C[i / 9] * t->C[i % 9];
  MaterialLawNeoHookean.curvature(m->bulk * t->theta, t->H, A);
}

/*
   Computes A_ijkl = A*_iakb Fp_n^(-1)_ja Fp_n^(-1)_lb from A* of the trial state: first for the rows, then for the
   columns of A*
*/
static PetscBool MaterialTangent_J2Finite(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  const PetscReal *inverse = J2Inverse(m);
  PetscReal        trial[81];
  J2Trial          t;

  if (!J2SetTrial(m, H, &t)) return PETSC_FALSE;
  J2TrialTangent(m, &t, A);
  for (int p = 0; p < 9; ++p) J2Multiply(A + 9 * p, inverse, PETSC_TRUE, trial + 9 * p);
  for (int q = 0; q < 9; ++q) {
    PetscReal column[9], transformed[9];

    for (int p = 0; p < 9; ++p) column[p] = trial[9 * p + q];
    J2Multiply(column, inverse, PETSC_TRUE, transformed);
    for (int p = 0; p < 9; ++p) A[9 * p + q] = transformed[p];
  }
  return PETSC_TRUE;
}

/* Computes the Cauchy stress dW/dFe* Fe*^T/J, since det Fp_n = 1 */
static PetscBool MaterialCauchy_J2Finite(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  PetscReal        P[9];
  J2Trial          t;

  if (!J2SetTrial(m, H, &t)) return PETSC_FALSE;
  J2TrialStress(m, &t, P);
  for (int k = 0; k < 6; ++k) {
    const PetscReal *p = P + 3 * row[k], *h = t.H + 3 * column[k];

    sigma[k] = (p[column[k]] + p[0] * h[0] + p[1] * h[1] + p[2] * h[2]) / (1 + t.theta);
  }
  return PETSC_TRUE;
}

/* Computes exp(-E*) exp(Ee) - I */
static void J2Change(Logarithmic *s, const PetscReal Ee[9], PetscReal change[9])
{
  PetscReal c[3], V[3][3], less[9], more[9];

  LogarithmicEigen(Ee, c, V);
  for (int a = 0; a < 3; ++a) c[a] = expm1(c[a]);
  LogarithmicCompose(c, V, more);
  for (int a = 0; a < 3; ++a) c[a] = expm1(-0.5 * log1p(s->c[a]));
  LogarithmicCompose(c, s->V, less);
  J2Multiply(less, more, PETSC_FALSE, change);
}

/* Computes the history at the end of the step. `history` may be the history that the moduli refer to. */
static PetscBool MaterialAdvance_J2Finite(const MaterialModuli *m, const PetscReal H[9],
  PetscReal history[MATERIAL_HISTORY])
{
  static const int at[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  PetscReal        before[9], change[9], strain[9];
  J2Trial          t;

  for (int k = 0; k < 9; ++k) before[k] = history[J2_INVERSE + k] = J2Inverse(m)[k];
  if (!J2SetTrial(m, H, &t)) return PETSC_FALSE;
  for (int i = 0; i < 9; ++i) strain[i] = t.log.E[i] + (m->history ? m->history[at[i]] : 0);
  if (!MaterialLawJ2.advance(m, t.strain, history)) return PETSC_FALSE;
  for (int i = 0; i < 9; ++i) strain[i] -= history[at[i]];
  J2Change(&t.log, strain, change);
  J2Multiply(before, change, PETSC_FALSE, history + J2_INVERSE);
  return PETSC_TRUE;
}

/* Replaces H by Fe - I */
static void MaterialElastic_J2Finite(const PetscReal history[MATERIAL_HISTORY], PetscReal H[9])
{
  PetscReal elastic[9];

  J2Multiply(H, history + J2_INVERSE, PETSC_FALSE, elastic);
  for (int i = 0; i < 9; ++i) H[i] = elastic[i];
}

static const MaterialConstant constants[] = {MATERIAL_YOUNG, MATERIAL_POISSON, MATERIAL_HARDENING, MATERIAL_DENSITY,
  {NULL}};

const MaterialLaw MaterialLawJ2Finite = {
  .constant    = PETSC_FALSE,
  .energy      = MaterialEnergy_J2Finite,
  .stress      = MaterialStress_J2Finite,
  .tangent     = MaterialTangent_J2Finite,
  .cauchy      = MaterialCauchy_J2Finite,
  .dilatation  = MaterialDilatation_NeoHookean,
  .dilatations = MaterialDilatations_NeoHookean,
  .curvature   = MaterialCurvature_NeoHookean,
  .advance     = MaterialAdvance_J2Finite,
  .elastic     = MaterialElastic_J2Finite,
  .work        = MaterialWork_J2,
  .finite      = PETSC_TRUE,
  .constants   = constants,
  .moduli      = MaterialModuli_J2,
};
