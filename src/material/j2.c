/*
   Plasticity of von Mises at small strain, with isotropic hardening sigma_y(a) of the equivalent plastic strain a and
   linear kinematic hardening of modulus K. A point's history is its plastic strain p, xx yy zz xy yz zx, and a.

   The law is the minimum over the plastic strain of what a step stores and dissipates (Ortiz and Stainier, The
   variational formulation of viscoplastic constitutive updates, 1999):

     W(e) = kappa/2 (tr e)^2 + mu |dev e - p|^2 + K/3 |p|^2 + int_0^a sigma_y,   p = p_n + da sqrt(3/2) n, a = a_n + da

   n is the direction of xi = 2 mu (dev e - p_n) - 2/3 K p_n, q = sqrt(3/2) |xi|, and da >= 0 solves the scalar equation
   of radial return, q - (3 mu + K) da = sigma_y(a_n + da), unless q <= sigma_y(a_n) (Simo and Hughes, Computational
   Inelasticity, 1998). W is convex and once differentiable; its gradient is the stress, its second derivative the
   consistent tangent.
*/
#include "materialimpl.h"

/* Result of a step. If the trial stress exceeds the yield stress by rounding error only, the step is elastic. */
typedef struct {
  PetscReal strain[6], alpha; /* at the end of the step: plastic strain p; equivalent plastic strain a */
  PetscReal n[6], increment;  /* flow direction n; increment da of a, 0 for an elastic step */
  PetscReal q, slope;         /* trial stress q [force/length^2]; dsigma_y/da at the end of the step */
} J2State;

static const PetscReal rounding = 1e-13;

/* Returns the integral of a table's yield stress from 0 to a, and gets its value and its slope at a */
static PetscReal J2Table(const MaterialHardening *h, PetscReal alpha, PetscReal *stress, PetscReal *slope)
{
  PetscReal integral = 0;
  PetscInt  i        = 0;

  for (; i + 1 < h->strains.n && alpha > h->strains.value[i + 1]; ++i)
    integral +=
      0.5 * (h->stresses.value[i] + h->stresses.value[i + 1]) * (h->strains.value[i + 1] - h->strains.value[i]);
  *slope  = i + 1 < h->strains.n
              ? (h->stresses.value[i + 1] - h->stresses.value[i]) / (h->strains.value[i + 1] - h->strains.value[i])
              : 0;
  *stress = h->stresses.value[i] + *slope * (alpha - h->strains.value[i]);
  return integral + 0.5 * (h->stresses.value[i] + *stress) * (alpha - h->strains.value[i]);
}

/* Returns the integral of the yield stress sigma_y from 0 to a, and gets its value and its slope at a */
static PetscReal J2YieldStress(const MaterialHardening *h, PetscReal alpha, PetscReal *stress, PetscReal *slope)
{
  PetscReal integral = h->yield * alpha;

  *stress = h->yield;
  *slope  = 0;
  if (h->strains.n) integral = J2Table(h, alpha, stress, slope);
  *stress += h->modulus * alpha;
  *slope += h->modulus;
  integral += 0.5 * h->modulus * alpha * alpha;
  if (h->rate > 0) {
    const PetscReal rise = h->saturation - h->yield, part = -expm1(-h->rate * alpha);

    *stress += rise * part;
    *slope += rise * h->rate * (1 - part);
    integral += rise * (alpha - part / h->rate);
  }
  return integral;
}

/*
   Returns da that solves q - stiffness da - sigma_y(a_n + da) = 0, by Newton's method within a bracket. The function
   decreases but, with a table, is neither convex nor concave. *slope: dsigma_y/da at the solution.
*/
static PetscReal J2Increment(const MaterialHardening *h, PetscReal alpha, PetscReal q, PetscReal stiffness,
  PetscReal *slope)
{
  PetscReal low = 0, high, stress, x = 0;

  (void)J2YieldStress(h, alpha, &stress, slope);
  high = (q - stress) / stiffness;
  for (int it = 0; it < 100; ++it) {
    PetscReal residual;

    (void)J2YieldStress(h, alpha + x, &stress, slope);
    residual = q - stiffness * x - stress;
    if (PetscAbsReal(residual) <= rounding * q) break;
    if (residual > 0) low = x;
    else high = x;
    x += residual / (stiffness + *slope);
    if (x <= low || x >= high) x = 0.5 * (low + high);
  }
  return x;
}

static PetscReal J2Square(const PetscReal s[6])
{
  return s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

static void J2Deviator(const PetscReal H[9], PetscReal e[6])
{
  const PetscReal mean = (H[0] + H[4] + H[8]) / 3;

  e[0] = H[0] - mean;
  e[1] = H[4] - mean;
  e[2] = H[8] - mean;
  e[3] = 0.5 * (H[1] + H[3]);
  e[4] = 0.5 * (H[5] + H[7]);
  e[5] = 0.5 * (H[2] + H[6]);
}

/* Computes the deviator e of the strain of a displacement gradient, and the radial return from the history */
static void J2Return(const MaterialModuli *m, const PetscReal H[9], PetscReal e[6], J2State *s)
{
  const MaterialHardening *h = m->hardening;
  PetscReal                stress;

  J2Deviator(H, e);
  *s = (J2State){.alpha = 0};
  if (!m->history) return;
  for (int k = 0; k < 6; ++k) {
    s->strain[k] = m->history[k];
    s->n[k]      = 2 * m->mu * (e[k] - s->strain[k]) - 2. / 3 * h->kinematic * s->strain[k];
  }
  s->alpha = m->history[6];
  s->q     = PetscSqrtReal(1.5 * J2Square(s->n));
  (void)J2YieldStress(h, s->alpha, &stress, &s->slope);
  if (!(s->q > (1 + rounding) * stress)) return;
  s->increment = J2Increment(h, s->alpha, s->q, 3 * m->mu + h->kinematic, &s->slope);
  for (int k = 0; k < 6; ++k) {
    s->n[k] *= PetscSqrtReal(1.5) / s->q;
    s->strain[k] += PetscSqrtReal(1.5) * s->increment * s->n[k];
  }
  s->alpha += s->increment;
}

PetscReal MaterialWork_J2(const MaterialModuli *m, const PetscReal history[MATERIAL_HISTORY])
{
  PetscReal stress, slope;

  return J2YieldStress(m->hardening, history[6], &stress, &slope) + m->hardening->kinematic / 3 * J2Square(history);
}

static PetscReal MaterialEnergy_J2(const MaterialModuli *m, const PetscReal H[9])
{
  const PetscReal trace = H[0] + H[4] + H[8];
  PetscReal       e[6], history[MATERIAL_HISTORY], energy = 0.5 * m->bulk * trace * trace;
  J2State         s;

  J2Return(m, H, e, &s);
  for (int k = 0; k < 6; ++k) {
    e[k] -= s.strain[k];
    history[k] = s.strain[k];
  }
  history[6] = s.alpha;
  energy += m->mu * J2Square(e);
  return s.alpha > 0 ? energy + MaterialWork_J2(m, history) : energy;
}

static PetscBool MaterialCauchy_J2(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  const PetscReal pressure = m->bulk * (H[0] + H[4] + H[8]);
  PetscReal       e[6];
  J2State         s;

  J2Return(m, H, e, &s);
  for (int k = 0; k < 6; ++k) sigma[k] = (k < 3 ? pressure : 0) + 2 * m->mu * (e[k] - s.strain[k]);
  return PETSC_TRUE;
}

static PetscBool MaterialStress_J2(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  PetscReal s[6];

  (void)MaterialCauchy_J2(m, H, s);
  MaterialStressMatrix(s, P);
  return PETSC_TRUE;
}

/*
   Computes A, the elastic tangent minus 2 mu (b I_dev + c n (x) n), with b = 3 mu da/q, c = 3 mu/(3 mu + K + sigma_y')
   - b
*/
static PetscBool MaterialTangent_J2(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  static const int at[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  PetscReal        e[6], b, c, mu;
  J2State          s;

  J2Return(m, H, e, &s);
  b  = s.increment > 0 ? 3 * m->mu * s.increment / s.q : 0;
  c  = s.increment > 0 ? 3 * m->mu / (3 * m->mu + m->hardening->kinematic + s.slope) - b : 0;
  mu = (1 - b) * m->mu;
  for (int p = 0; p < 9; ++p) {
    for (int q = 0; q < 9; ++q) A[9 * p + q] = -2 * m->mu * c * s.n[at[p]] * s.n[at[q]];
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      A[9 * (3 * i + i) + 3 * j + j] += m->bulk - 2 * mu / 3;
      A[9 * (3 * i + j) + 3 * i + j] += mu;
      A[9 * (3 * i + j) + 3 * j + i] += mu;
    }
  }
  return PETSC_TRUE;
}

static PetscBool MaterialAdvance_J2(const MaterialModuli *m, const PetscReal H[9], PetscReal history[MATERIAL_HISTORY])
{
  PetscReal e[6];
  J2State   s;

  J2Return(m, H, e, &s);
  for (int k = 0; k < 6; ++k) history[k] = s.strain[k];
  history[6] = s.alpha;
  return (PetscBool)(s.increment > 0);
}

static void MaterialElastic_J2(const PetscReal history[MATERIAL_HISTORY], PetscReal H[9])
{
  static const int at[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};

  for (int i = 0; i < 9; ++i) H[i] -= history[at[i]];
}

static PetscBool J2CheckTable(const MaterialHardening *h, const char **key, char why[], size_t length)
{
  *key = "plastic_strains";
  if (h->strains.n != h->stresses.n) {
    (void)snprintf(why, length, "must be as many numbers as yield_stresses, but they are %d and %d", (int)h->strains.n,
      (int)h->stresses.n);
    return PETSC_FALSE;
  }
  if (h->strains.n && h->strains.value[0] != 0) {
    (void)snprintf(why, length, "must begin with 0, not with %g", (double)h->strains.value[0]);
    return PETSC_FALSE;
  }
  for (PetscInt i = 1; i < h->strains.n; ++i) {
    if (!(h->strains.value[i] > h->strains.value[i - 1])) {
      (void)snprintf(why, length, "must ascend: %g follows %g", (double)h->strains.value[i],
        (double)h->strains.value[i - 1]);
      return PETSC_FALSE;
    }
    if (!(h->stresses.value[i] >= h->stresses.value[i - 1])) {
      *key = "yield_stresses";
      (void)snprintf(why, length, "must not decrease: %g follows %g, and a law with softening has no unique solution",
        (double)h->stresses.value[i], (double)h->stresses.value[i - 1]);
      return PETSC_FALSE;
    }
  }
  return PETSC_TRUE;
}

/*
   Checks that hardening constants are valid. hardening: the constants; with a table, `yield` is its first stress;
   length: size of `why`; key: name in scenes of the constant that is wrong; why: explanation, the part of a sentence
   that follows the key. Returns false if a constant is wrong.
*/
PetscBool MaterialCheckHardening(const MaterialHardening *h, const char **key, char why[], size_t length)
{
  const struct {
    const char *key;
    PetscReal   value;
  } positive[] = {{"hardening", h->modulus}, {"kinematic", h->kinematic}, {"saturation_rate", h->rate}};

  if (!J2CheckTable(h, key, why, length)) return PETSC_FALSE;
  *key = h->stresses.n ? "yield_stresses" : "yield";
  (void)snprintf(why, length, "is %g, which must be above 0", (double)h->yield);
  if (!(h->yield > 0)) return PETSC_FALSE;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(positive); ++i) {
    *key = positive[i].key;
    (void)snprintf(why, length, "is %g, which must not be below 0%s", (double)positive[i].value,
      i < 2 ? ": a law with softening has no unique solution" : "");
    if (!(positive[i].value >= 0)) return PETSC_FALSE;
  }
  (void)snprintf(why, length, "is %g, which needs a saturation", (double)h->rate);
  if (h->rate > 0 && h->saturation == 0) return PETSC_FALSE;
  *key = "saturation";
  (void)snprintf(why, length,
    "is %g, which must not be below the yield stress %g: a law with softening has no unique solution",
    (double)h->saturation, (double)h->yield);
  if (h->rate > 0 && !(h->saturation >= h->yield)) return PETSC_FALSE;
  (void)snprintf(why, length, "is %g, which needs a saturation_rate", (double)h->saturation);
  return (PetscBool) !(h->saturation != 0 && h->rate == 0);
}

PetscBool MaterialCollapses(const Material *material)
{
  return (
    PetscBool)(material->type == MATERIAL_J2 && material->hardening.modulus == 0 && material->hardening.kinematic == 0);
}

PetscErrorCode MaterialModuli_J2(const Material *material, MaterialModuli *moduli)
{
  const char *key;
  char        why[128];

  PetscFunctionBegin;
  PetscCall(MaterialModuliIsotropic(material, moduli));
  PetscCheck(MaterialCheckHardening(&material->hardening, &key, why, sizeof(why)), PETSC_COMM_SELF,
    PETSC_ERR_ARG_OUTOFRANGE, "A law of plasticity has %s %s", key, why);
  moduli->hardening = &material->hardening;
  PetscFunctionReturn(0);
}

static const MaterialConstant constants[] = {
  MATERIAL_YOUNG,
  MATERIAL_POISSON,
  {"expansion", 1, offsetof(Material, expansion), PETSC_FALSE, NULL, NULL, 0, 0},
  MATERIAL_HARDENING,
  MATERIAL_DENSITY,
  {NULL},
};

const MaterialLaw MaterialLawJ2 = {
  .constant   = PETSC_FALSE,
  .energy     = MaterialEnergy_J2,
  .stress     = MaterialStress_J2,
  .tangent    = MaterialTangent_J2,
  .cauchy     = MaterialCauchy_J2,
  .dilatation = MaterialDilatation_Linear,
  .advance    = MaterialAdvance_J2,
  .elastic    = MaterialElastic_J2,
  .work       = MaterialWork_J2,
  .constants  = constants,
  .moduli     = MaterialModuli_J2,
};
