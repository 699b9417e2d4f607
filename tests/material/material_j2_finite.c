static char help[] =
  "Plasticity of von Mises at finite strain at a point: derivatives against differences also where principal stretches "
  "coalesce, objectivity, the end of a step, a bar in closed form, simple shear against a differential equation, the "
  "limit of small strain.\n\n";

#include "material_differences.h"

#define MU 1.0

static const Material materials[] = {
  {.hardening = {.yield = 0.1}},
  {.hardening = {.yield = 0.1, .modulus = 0.4}},
  {.hardening = {.yield = 0.1, .saturation = 0.16, .rate = 5, .kinematic = 0.1}},
};
static const char *const names[] = {"perfect", "linear", "Voce and kinematic"};

static PetscReal YieldStress(const MaterialHardening *h, PetscReal a)
{
  return h->yield + h->modulus * a + (h->rate > 0 ? (h->saturation - h->yield) * (1 - PetscExpReal(-h->rate * a)) : 0);
}

static void Multiply(const PetscReal A[9], const PetscReal B[9], PetscReal C[9])
{
  for (int i = 0; i < 9; ++i) {
    C[i] = 0;
    for (int k = 0; k < 3; ++k) C[i] += A[3 * (i / 3) + k] * B[3 * k + i % 3];
  }
}

/* A rotation by Rodrigues' formula */
static void Rotation(PetscInt seed, PetscReal Q[9])
{
  PetscReal w[3], W[9] = {0}, WW[9], angle;

  for (int i = 0; i < 3; ++i) w[i] = 2 * Rough(seed + i);
  angle = PetscSqrtReal(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  W[1]  = -w[2];
  W[2]  = w[1];
  W[5]  = -w[0];
  W[3]  = w[2];
  W[6]  = -w[1];
  W[7]  = w[0];
  Multiply(W, W, WW);
  for (int i = 0; i < 9; ++i)
    Q[i] = (i % 4 ? 0 : 1) + PetscSinReal(angle) / angle * W[i] + (1 - PetscCosReal(angle)) / (angle * angle) * WW[i];
}

/* Displacement gradients: rough ones; then equal, nearly equal and distant principal stretches, turned */
static void Gradient(PetscInt sample, PetscReal H[9])
{
  const PetscReal apart[] = {0, 1e-12, 1e-8, 1e-4, 1e-2, 0.06, 0.2};
  const PetscInt  n       = PETSC_STATIC_ARRAY_LENGTH(apart);
  PetscReal       Q[9], R[9], U[9] = {0}, V[9];

  if (sample < n || sample >= 3 * n) {
    for (PetscInt i = 0; i < 9; ++i) H[i] = 0.3 * Rough(9 * sample + i);
    return;
  }
  Rotation(sample, Q);
  Rotation(sample + 100, R);
  U[0] = sample < 2 * n ? 1.2 : 0.8;
  U[4] = U[0] + apart[sample % n];
  U[8] = sample < 2 * n ? U[0] - 0.7 * apart[sample % n] : 1.5;
  Multiply(Q, U, V);
  for (int i = 0; i < 9; ++i) U[i] = Q[3 * (i % 3) + i / 3];
  Multiply(V, U, H);
  Multiply(R, H, V);
  for (int i = 0; i < 9; ++i) H[i] = V[i] - (i % 4 ? 0 : 1);
}

#define RAISE(error, value) error = PetscMax(error, PetscAbsReal(value))

static PetscErrorCode CheckPoint(const MaterialLaw *law, MaterialModuli *m, const MaterialModuli *isochoric)
{
  PetscReal errors[3] = {0}, end = 0, stress = 0, turned = 0, parts = 0, volume = 0, cauchy = 0;
  PetscInt  nplastic = 0;

  PetscFunctionBeginUser;
  for (PetscInt sample = 0; sample < 28; ++sample) {
    PetscReal H[9], F[9], Q[9], P[9], R[9], A[81], C[9], G[9], before[MATERIAL_HISTORY] = {0}, after[MATERIAL_HISTORY];
    PetscReal W, theta, sigma[6], elastic[9];
    MaterialModuli iso = *isochoric, none;

    m->history = before;
    Gradient(sample + 31, H);
    if (sample % 2 && law->advance(m, H, after)) PetscCall(PetscArraycpy(before, after, MATERIAL_HISTORY));
    Gradient(sample, H);
    W           = law->energy(m, H);
    theta       = law->dilatation(H, C);
    iso.history = before;
    RAISE(parts, W - law->energy(&iso, H) - 0.5 * m->bulk * theta * theta);
    law->stress(m, H, P);
    law->tangent(m, H, A);
    RaiseDerivativeErrors(law, m, 1e-6, H, P, A, errors);
    Rotation(sample + 50, Q);
    for (int i = 0; i < 9; ++i) F[i] = H[i] + (i % 4 ? 0 : 1);
    Multiply(Q, F, R);
    for (int i = 0; i < 9; ++i) R[i] -= i % 4 ? 0 : 1;
    RAISE(turned, law->energy(m, R) - W);
    law->stress(m, R, F);
    Multiply(Q, P, R);
    for (int i = 0; i < 9; ++i) RAISE(turned, F[i] - R[i]);
    nplastic += law->advance(m, H, after);
    law->cauchy(m, H, sigma);
    m->history = after;
    RAISE(end, law->energy(m, H) - W);
    law->stress(m, H, R);
    for (int i = 0; i < 9; ++i) RAISE(stress, R[i] - P[i]);
    for (int i = 0; i < 9; ++i) G[i] = after[MATERIAL_PLASTIC + i];
    RAISE(volume, law->dilatation(G, C));
    none         = *m;
    none.history = NULL;
    PetscCall(PetscArraycpy(elastic, H, 9));
    law->elastic(after, elastic);
    law->cauchy(&none, elastic, R);
    for (int i = 0; i < 6; ++i) RAISE(cauchy, R[i] - sigma[i]);
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  samples that yield: %s\n", nplastic > 20 ? "most" : "FEW"));
  PetscCall(Report("energy less its isochoric and volumetric parts", parts, 1e-14));
  PetscCall(Report("stress against differences of the energy", errors[0], 1e-8));
  PetscCall(Report("tangent against differences of the stress", errors[1], 1e-7));
  PetscCall(Report("asymmetry of the tangent", errors[2], 1e-13));
  PetscCall(Report("turned bodies: energy and stress", turned, 1e-13));
  PetscCall(Report("energy over the end of a step", end, 1e-13));
  /* with kinematic hardening flow and elastic strain have other axes: of second order in the strain of the step */
  PetscCall(Report("stress over the end of a step", stress, m->hardening->kinematic > 0 ? 2e-3 : 1e-12));
  PetscCall(Report("change of volume by plastic strain", volume, 1e-13));
  PetscCall(Report("Cauchy stress from the elastic part alone", cauchy, m->hardening->kinematic > 0 ? 2e-3 : 1e-12));
  PetscFunctionReturn(0);
}

/* Stretches of a bar whose Kirchhoff stress is tau after the plastic strain p along it: kappa (J - 1) J = tau/3 */
static PetscReal Bar(const MaterialModuli *m, PetscReal tau, PetscReal p, PetscReal H[9])
{
  const PetscReal J = 0.5 + PetscSqrtReal(0.25 + tau / (3 * m->bulk)), mean = PetscLogReal(J) / 3;

  for (int i = 0; i < 9; ++i) H[i] = i % 4 ? 0 : PetscExpReal(mean + (i ? -0.5 : 1) * (p + tau / (3 * m->mu))) - 1;
  return tau / (1 + H[0]);
}

/* Pulled, pushed and pulled, each to its end in one step: the stress is K p +- sigma_y(a) */
static PetscErrorCode CheckBar(const MaterialLaw *law, MaterialModuli *m, const MaterialHardening *h)
{
  const PetscReal to[]                      = {0.5, -0.4, 0.8};
  PetscReal       history[MATERIAL_HISTORY] = {0}, p = 0, alpha = 0, error = 0;

  PetscFunctionBeginUser;
  for (int k = 0; k < 3; ++k) {
    const PetscReal sign = to[k] > p ? 1 : -1;
    PetscReal       H[9], P[9], stress;

    alpha += PetscAbsReal(to[k] - p);
    p          = to[k];
    stress     = Bar(m, h->kinematic * p + sign * YieldStress(h, alpha), p, H);
    m->history = history;
    law->stress(m, H, P);
    law->advance(m, H, history);
    for (int i = 0; i < 9; ++i) RAISE(error, P[i] - (i ? 0 : stress));
    RAISE(error, history[0] - p);
    RAISE(error, history[MATERIAL_PLASTIC - 1] - alpha);
  }
  PetscCall(Report("a bar of logarithmic strain 0.5, -0.4 and 0.8 against its closed form", error, 1e-12));
  PetscFunctionReturn(0);
}

/* Eigenvalues 1 + c of b = [x z 0; z y 0; 0 0 w], their logarithms' deviator, and the angle of the first axis */
static void Logarithms(const PetscReal b[4], PetscReal dev[3], PetscReal *angle)
{
  const PetscReal half = (b[0] - b[1]) / 2, r = PetscSqrtReal(half * half + b[2] * b[2]), mean = (b[0] + b[1]) / 2;
  const PetscReal e[3] = {0.5 * PetscLogReal(mean + r), 0.5 * PetscLogReal(mean - r), 0.5 * PetscLogReal(b[3])};

  for (int i = 0; i < 3; ++i) dev[i] = e[i] - (e[0] + e[1] + e[2]) / 3;
  *angle = 0.5 * PetscAtan2Real(b[2], half);
}

/* db/dgamma of simple shear: b' = L b + b L^T - 2 p n b, p = n:D/(1 + sigma_y'/(3 mu)), where it yields */
static void ShearRate(const PetscReal b[4], PetscReal slope, PetscReal rate[4], PetscReal *plastic)
{
  PetscReal dev[3], angle, norm, n[4], p;

  Logarithms(b, dev, &angle);
  norm     = PetscSqrtReal(dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]);
  n[0]     = 0.5 * (dev[0] + dev[1] + (dev[0] - dev[1]) * PetscCosReal(2 * angle)) / norm;
  n[1]     = 0.5 * (dev[0] + dev[1] - (dev[0] - dev[1]) * PetscCosReal(2 * angle)) / norm;
  n[2]     = 0.5 * (dev[0] - dev[1]) * PetscSinReal(2 * angle) / norm;
  n[3]     = dev[2] / norm;
  p        = n[2] / (1 + slope / (3 * MU));
  rate[0]  = 2 * b[2] - 2 * p * (n[0] * b[0] + n[2] * b[2]);
  rate[1]  = -2 * p * (n[2] * b[2] + n[1] * b[1]);
  rate[2]  = b[1] - p * (n[0] * b[2] + n[2] * b[1] + n[2] * b[0] + n[1] * b[2]);
  rate[3]  = -2 * p * n[3] * b[3];
  *plastic = PetscSqrtReal(2. / 3) * p;
}

/* Kirchhoff shear stress and equivalent plastic strain at a shear, by Runge and Kutta's method */
static void ShearExact(const MaterialHardening *h, PetscReal gamma, PetscReal *tau, PetscReal *alpha)
{
  const PetscInt n   = 20000;
  PetscReal      low = 0, high = 1, b[4] = {0, 1, 0, 1}, dev[3], angle, step;

  for (int k = 0; k < 100; ++k) { /* where it begins to yield */
    const PetscReal g = 0.5 * (low + high), at[4] = {1 + g * g, 1, g, 1};

    Logarithms(at, dev, &angle);
    if (2 * MU * PetscSqrtReal(1.5 * (dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2])) < h->yield) low = g;
    else high = g;
  }
  b[0]   = 1 + low * low;
  b[2]   = low;
  step   = (gamma - low) / (PetscReal)n;
  *alpha = 0;
  for (PetscInt i = 0; i < n; ++i) {
    const PetscReal part[4] = {0, 0.5, 0.5, 1}, weight[4] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
    PetscReal       rate[4] = {0}, begin[4], plastic = 0, from = *alpha;

    PetscCallVoid(PetscArraycpy(begin, b, 4));
    for (int k = 0; k < 4; ++k) {
      PetscReal       at[4];
      const PetscReal a = from + part[k] * step * plastic;

      for (int c = 0; c < 4; ++c) at[c] = begin[c] + part[k] * step * rate[c];
      ShearRate(at, h->modulus + h->rate * (h->saturation - h->yield) * PetscExpReal(-h->rate * a), rate, &plastic);
      for (int c = 0; c < 4; ++c) b[c] += weight[k] * step * rate[c];
      *alpha += weight[k] * step * plastic;
    }
  }
  Logarithms(b, dev, &angle);
  *tau = MU * (dev[0] - dev[1]) * PetscSinReal(2 * angle);
}

static void Shear(const MaterialLaw *law, MaterialModuli m, PetscReal gamma, PetscInt n, PetscReal *tau,
  PetscReal *alpha)
{
  PetscReal H[9] = {0}, P[9], history[MATERIAL_HISTORY] = {0};

  m.history = history;
  for (PetscInt i = 1; i <= n; ++i) {
    H[1] = gamma * (PetscReal)i / (PetscReal)n;
    law->stress(&m, H, P);
    law->advance(&m, H, history);
  }
  *tau   = P[1]; /* P F^T, F = I + gamma e1 e2 */
  *alpha = history[MATERIAL_PLASTIC - 1];
}

static PetscErrorCode CheckShear(const MaterialLaw *law, MaterialModuli *m, const MaterialHardening *h)
{
  const PetscReal gamma = 3;
  PetscReal       tau, alpha, coarse, fine, strain[2];

  PetscFunctionBeginUser;
  if (h->kinematic > 0) PetscFunctionReturn(0);
  ShearExact(h, gamma, &tau, &alpha);
  Shear(law, *m, gamma, 500, &coarse, &strain[0]);
  Shear(law, *m, gamma, 1000, &fine, &strain[1]);
  PetscCall(Report("simple shear of 3 in 1000 steps: stress", PetscAbsReal(fine / tau - 1), 5e-3));
  PetscCall(Report("  extrapolated", PetscAbsReal((2 * fine - coarse) / tau - 1), 2e-5));
  PetscCall(Report("  equivalent plastic strain", PetscAbsReal((2 * strain[1] - strain[0]) / alpha - 1), 2e-5));
  PetscFunctionReturn(0);
}

/* Differences to j2 fall in proportion to the strain */
static PetscErrorCode CheckSmall(const MaterialLaw *law, const Material *material)
{
  const Material     small = {.type = MATERIAL_J2};
  const MaterialLaw *j2;
  PetscReal          worst[2] = {0};

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(&small, &j2));
  for (int k = 0; k < 2; ++k) {
    const PetscReal scale  = k ? 1e-5 : 1e-4;
    Material        scaled = *material;
    MaterialModuli  m;

    scaled.hardening.yield *= scale;
    scaled.hardening.saturation *= scale;
    scaled.hardening.rate /= scale;
    PetscCall(MaterialGetModuli(&scaled, &m, NULL));
    for (PetscInt sample = 0; sample < 10; ++sample) {
      PetscReal H[9], P[9], R[9], finite[MATERIAL_HISTORY] = {0}, history[MATERIAL_HISTORY] = {0};

      for (int step = 0; step < 2; ++step) {
        for (PetscInt i = 0; i < 9; ++i) H[i] = scale * Rough(9 * sample + i + 100 * step);
        m.history = finite;
        law->stress(&m, H, P);
        law->advance(&m, H, finite);
        m.history = history;
        j2->stress(&m, H, R);
        j2->advance(&m, H, history);
        for (int i = 0; i < 9; ++i) RAISE(worst[k], (P[i] - R[i]) / scale);
      }
    }
  }
  PetscCall(Report("difference to j2 at strains of 1e-5", worst[1], 2e-4));
  PetscCall(Report("  over that at 1e-4", worst[1] / worst[0], 0.11));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscReal inverted[9] = {-2, 0, 0, 0, 0, 0, 0, 0, 0}, P[9];

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (size_t t = 0; t < PETSC_STATIC_ARRAY_LENGTH(materials); ++t) {
    Material           material = materials[t];
    const MaterialLaw *law;
    MaterialModuli     m, isochoric;

    PetscCall(BeginPlastic(names[t], MATERIAL_J2_FINITE, &material, &law, &m, &isochoric));
    PetscCall(CheckPoint(law, &m, &isochoric));
    PetscCall(CheckBar(law, &m, &material.hardening));
    PetscCall(CheckShear(law, &m, &material.hardening));
    PetscCall(CheckSmall(law, &material));
    m.history = NULL; /* the checks have left the address of their own */
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  inverted: %s\n",
      law->energy(&m, inverted) >= PETSC_INFINITY && !law->stress(&m, inverted, P) ? "refused" : "ACCEPTED"));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
