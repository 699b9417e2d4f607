static char help[] =
  "Constitutive laws: stress and tangent against differences, small and rigid motions, bad parameters.\n\n";

#include "material_differences.h"

/* Largest errors of P against differences of W, of A against differences of P, and of A's symmetry */
static PetscErrorCode CheckDerivatives(const MaterialLaw *law, const MaterialModuli *m)
{
  const PetscReal h         = 1e-5;
  PetscReal       errors[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  for (PetscInt sample = 0; sample < 10; ++sample) {
    PetscReal H[9], P[9], A[81];

    for (PetscInt i = 0; i < 9; ++i) H[i] = 0.25 * Rough(9 * sample + i);
    law->stress(m, H, P);
    law->tangent(m, H, A);
    RaiseDerivativeErrors(law, m, h, H, P, A, errors);
  }
  PetscCall(Report("stress against differences of the energy", errors[0], 1e-8));
  PetscCall(Report("tangent against differences of the stress", errors[1], 1e-8));
  PetscCall(Report("asymmetry of the tangent", errors[2], 1e-13));
  PetscFunctionReturn(0);
}

/* W = W_iso + kappa/2 theta^2, and theta's derivatives against differences */
static PetscErrorCode CheckDilatationPart(const MaterialLaw *law, const MaterialModuli *m,
  const MaterialModuli *isochoric)
{
  const PetscReal h = 1e-5, kappa = m->bulk;
  PetscReal       errors[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  for (PetscInt sample = 0; sample < 10; ++sample) {
    PetscReal H[9], C[9], A[81], theta;

    for (PetscInt i = 0; i < 9; ++i) H[i] = 0.25 * Rough(9 * sample + i);
    theta = law->dilatation(H, C);
    PetscCall(PetscArrayzero(A, 81));
    if (law->curvature) law->curvature(kappa, H, A);
    errors[0] =
      PetscMax(errors[0], PetscAbsReal(law->energy(m, H) - law->energy(isochoric, H) - 0.5 * kappa * theta * theta));
    for (PetscInt j = 0; j < 9; ++j) {
      const PetscReal keep = H[j];
      PetscReal       forward, backward, Cf[9], Cb[9];

      H[j]      = keep + h;
      forward   = law->dilatation(H, Cf);
      H[j]      = keep - h;
      backward  = law->dilatation(H, Cb);
      H[j]      = keep;
      errors[1] = PetscMax(errors[1], PetscAbsReal((forward - backward) / (2 * h) - C[j]));
      for (PetscInt i = 0; i < 9; ++i)
        errors[2] = PetscMax(errors[2], PetscAbsReal(kappa * (Cf[i] - Cb[i]) / (2 * h) - A[9 * i + j]));
    }
  }
  PetscCall(Report("energy less its isochoric and volumetric parts", errors[0], 1e-14));
  PetscCall(Report("dilatation's derivative against differences", errors[1], 1e-9));
  PetscCall(Report("dilatation's second derivative against differences", errors[2], 1e-9));
  PetscFunctionReturn(0);
}

/* Strains far below the square root of the rounding error: Hooke's stress and energy to many digits */
static PetscErrorCode CheckSmallStrains(const MaterialLaw *law, const MaterialModuli *m)
{
  const MaterialLaw *hooke;
  const Material     linear = {.type = MATERIAL_LINEAR, .young = 1, .poisson = 0};
  PetscReal          H[9], P[9], Q[9], difference = 0, scale = 0, W;

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(&linear, &hooke));
  for (PetscInt i = 0; i < 9; ++i) H[i] = 1e-10 * Rough(7 + i);
  law->stress(m, H, P);
  hooke->stress(m, H, Q);
  for (PetscInt i = 0; i < 9; ++i) {
    difference = PetscMax(difference, PetscAbsReal(P[i] - Q[i]));
    scale      = PetscMax(scale, PetscAbsReal(Q[i]));
  }
  W = hooke->energy(m, H);
  PetscCall(Report("stress of strains of 1e-10 against Hooke's, relative", difference / scale, 1e-8));
  PetscCall(
    Report("energy of strains of 1e-10 against Hooke's, relative", PetscAbsReal(law->energy(m, H) - W) / W, 1e-8));
  PetscFunctionReturn(0);
}

/* At rest a law is without energy and stress, and its tangent is Hooke's; uniaxial strain e stresses it by (lambda +
   2 mu) e and lambda e */
static PetscErrorCode CheckRest(const MaterialLaw *law, const MaterialModuli *m)
{
  const PetscReal small = 1e-7, H[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0}, strain[9] = {small, 0, 0, 0, 0, 0, 0, 0, 0};
  PetscReal       P[9], A[81], sigma[6], stress = 0, difference = 0;

  PetscFunctionBeginUser;
  law->stress(m, H, P);
  law->tangent(m, H, A);
  for (PetscInt p = 0; p < 9; ++p) {
    const PetscInt i = p / 3, j = p % 3;

    stress = PetscMax(stress, PetscAbsReal(P[p]));
    for (PetscInt q = 0; q < 9; ++q) {
      const PetscInt  k = q / 3, l = q % 3;
      const PetscReal hooke = m->lambda * (i == j) * (k == l) + m->mu * ((i == k) * (j == l) + (i == l) * (j == k));

      difference = PetscMax(difference, PetscAbsReal(A[9 * p + q] - hooke));
    }
  }
  law->cauchy(m, strain, sigma);
  PetscCall(Report("energy at rest", PetscAbsReal(law->energy(m, H)), 1e-14));
  PetscCall(Report("stress at rest", stress, 1e-14));
  PetscCall(Report("tangent at rest less Hooke's", difference, 1e-13));
  PetscCall(Report("axial stress of a small strain", PetscAbsReal(sigma[0] / small - (m->lambda + 2 * m->mu)), 1e-5));
  PetscCall(Report("lateral stress of a small strain",
    PetscMax(PetscAbsReal(sigma[1] / small - m->lambda), PetscAbsReal(sigma[2] / small - m->lambda)), 1e-5));
  PetscFunctionReturn(0);
}

/* F -> R F changes no energy, and turns the Cauchy stress with it; only for finite strain */
static PetscErrorCode CheckRotation(const MaterialLaw *law, const MaterialModuli *m)
{
  const PetscReal c = PetscCosReal(0.8), s = PetscSinReal(0.8), R[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  PetscReal       H[9], RH[9], sigma[6], turned[6];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 9; ++i) H[i] = 0.2 * Rough(100 + i);
  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt j = 0; j < 3; ++j) {
      RH[3 * i + j] = -(i == j);
      for (PetscInt k = 0; k < 3; ++k) RH[3 * i + j] += R[i][k] * (H[3 * k + j] + (k == j));
    }
  }
  law->cauchy(m, H, sigma);
  law->cauchy(m, RH, turned);
  PetscCall(Report("energy changed by a rotation", PetscAbsReal(law->energy(m, H) - law->energy(m, RH)), 1e-14));
  PetscCall(Report("turned normal stress",
    PetscAbsReal(turned[0] - (c * c * sigma[0] + s * s * sigma[1] - 2 * s * c * sigma[3])), 1e-13));
  PetscCall(Report("turned shear stress", PetscAbsReal(turned[5] - (c * sigma[5] - s * sigma[4])), 1e-13));
  PetscFunctionReturn(0);
}

/* Pressure of a uniform dilation F = a I */
static PetscReal PressureNeoHookean(PetscReal kappa, PetscReal a)
{
  return kappa * (a * a * a - 1);
}

static PetscReal PressureSaintVenant(PetscReal kappa, PetscReal a)
{
  return 1.5 * kappa * (a * a - 1) / a;
}

static PetscErrorCode CheckDilation(const MaterialLaw *law, const MaterialModuli *m,
  PetscReal (*pressure)(PetscReal, PetscReal))
{
  const PetscReal a = 1.3, kappa = m->bulk, H[9] = {a - 1, 0, 0, 0, a - 1, 0, 0, 0, a - 1},
                  inside[9] = {-1.1, 0, 0, 0, 0, 0, 0, 0, 0};
  PetscReal sigma[6], P[9], A[81], error = 0;
  PetscBool refused;

  PetscFunctionBeginUser;
  law->cauchy(m, H, sigma);
  for (PetscInt k = 0; k < 6; ++k) error = PetscMax(error, PetscAbsReal(sigma[k] - (k < 3 ? pressure(kappa, a) : 0)));
  PetscCall(Report("pressure of a dilation", error, 1e-13));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  turned inside out: %s\n",
    law->energy(m, inside) > 1e300 ? "unbounded energy" : "BOUNDED ENERGY"));
  refused = (PetscBool)(!law->stress(m, inside, P) && !law->tangent(m, inside, A) && !law->cauchy(m, inside, sigma));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  turned inside out: %s\n",
    refused ? "no stress, no tangent" : "STRESS OR TANGENT"));
  PetscFunctionReturn(0);
}

/* A pull along one of the axes strains it by 1/E and the others by Poisson's ratios; a shear in a plane of two by
   1/(2 G) */
static PetscErrorCode CheckOrthotropic(const Material *material, const PetscReal axes[3][3])
{
  const PetscReal   *E = material->youngs, *nu = material->poissons;
  const PetscReal    S[3][3] = {{1 / E[0], -nu[0] / E[0], -nu[2] / E[0]}, {-nu[0] / E[0], 1 / E[1], -nu[1] / E[1]},
       {-nu[2] / E[0], -nu[1] / E[1], 1 / E[2]}};
  const MaterialLaw *law;
  MaterialModuli     m;
  PetscReal          pull = 0, shear = 0;

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(MaterialGetModuli(material, &m, NULL));
  for (PetscInt a = 0; a < 3; ++a) {
    const PetscInt  b    = (a + 1) % 3;
    const PetscReal G    = material->shears[a];
    PetscReal       H[9] = {0}, D[9], P[9], Q[9];

    for (PetscInt i = 0; i < 9; ++i) {
      for (PetscInt k = 0; k < 3; ++k) H[i] += S[k][a] * axes[k][i / 3] * axes[k][i % 3];
      D[i] = (axes[a][i / 3] * axes[b][i % 3] + axes[b][i / 3] * axes[a][i % 3]) / (2 * G);
    }
    law->stress(&m, H, P);
    law->stress(&m, D, Q);
    for (PetscInt i = 0; i < 9; ++i) {
      pull  = PetscMax(pull, PetscAbsReal(P[i] - axes[a][i / 3] * axes[a][i % 3]));
      shear = PetscMax(shear, PetscAbsReal(Q[i] - axes[a][i / 3] * axes[b][i % 3] - axes[b][i / 3] * axes[a][i % 3]));
    }
  }
  PetscCall(Report("stress of a pull along each axis", pull, 1e-13));
  PetscCall(Report("stress of a shear in each plane", shear, 1e-13));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckRefused(const char name[], const Material *material)
{
  MaterialModuli m;
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  ierr = MaterialGetModuli(material, &m, NULL);
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", name, ierr ? "refused" : "ACCEPTED"));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckParameters(PetscReal young, PetscReal poisson)
{
  const Material material = {.type = MATERIAL_LINEAR, .young = young, .poisson = poisson};
  PetscReal      lambda, mu;
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  ierr = MaterialGetLame(&material, &lambda, &mu);
  PetscCall(PetscPopErrorHandler());
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "E %g, nu %g: %s\n", (double)young, (double)poisson, ierr ? "refused" : "accepted"));
  if (!ierr) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  lambda %g, mu %g\n", (double)lambda, (double)mu));
  PetscFunctionReturn(0);
}

/* The fifth is isotropic in constants of an orthotropic law along other axes, E = 2.6, nu = 0.3 like the first ones */
static const Material materials[] = {
  {.type = MATERIAL_LINEAR, .young = 2.6, .poisson = 0.3},
  {.type = MATERIAL_NEOHOOKEAN, .young = 2.6, .poisson = 0.3},
  {.type = MATERIAL_SAINT_VENANT, .young = 2.6, .poisson = 0.3},
  {.type = MATERIAL_MOONEY_RIVLIN, .c10 = 0.3, .c01 = 0.2, .bulk = 13. / 6},
  {.type      = MATERIAL_ORTHOTROPIC,
    .youngs   = {2.6, 2.6, 2.6},
    .poissons = {0.3, 0.3, 0.3},
    .shears   = {1, 1, 1},
    .axes     = {{1, 2, 2}, {-2, 0.5, 3}}},
  {.type      = MATERIAL_ORTHOTROPIC,
    .youngs   = {12, 1.1, 0.7},
    .poissons = {0.35, 0.4, 0.3},
    .shears   = {0.8, 0.1, 0.6},
    .axes     = {{1, 2, 2}, {2, 1, -2}}},
};
static const PetscReal turned[3][3] = {{1. / 3, 2. / 3, 2. / 3}, {2. / 3, 1. / 3, -2. / 3}, {-2. / 3, 2. / 3, -1. / 3}};

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (PetscInt t = 0; t < 6; ++t) {
    const Material    *material = &materials[t];
    const MaterialLaw *law;
    MaterialModuli     m, isochoric;

    PetscCall(MaterialGetModuli(material, &m, &isochoric));
    PetscCall(MaterialGetLaw(material, &law));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s%s\n", MaterialTypes[material->type],
      law->constant ? ", constant tangent" : ""));
    PetscCall(CheckDerivatives(law, &m));
    PetscCall(CheckDilatationPart(law, &m, &isochoric));
    if (t == 5) break;
    if (t == 4) m.mu = 1, m.lambda = 1.5; /* which it does not have: Hooke's, with which it is compared */
    PetscCall(CheckRest(law, &m));
    PetscCall(CheckSmallStrains(law, &m));
    if (!law->constant) {
      PetscCall(CheckRotation(law, &m));
      PetscCall(
        CheckDilation(law, &m, material->type == MATERIAL_SAINT_VENANT ? PressureSaintVenant : PressureNeoHookean));
    }
  }
  PetscCall(CheckOrthotropic(&materials[5], turned));
  PetscCall(
    CheckRefused("c01 below 0", &(Material){.type = MATERIAL_MOONEY_RIVLIN, .c10 = 1, .c01 = -0.1, .bulk = 10}));
  PetscCall(CheckRefused("no bulk modulus", &(Material){.type = MATERIAL_MOONEY_RIVLIN, .c10 = 1, .c01 = 0.1}));
  PetscCall(CheckRefused("Poisson's ratio above (E1/E2)^(1/2)",
    &(Material){.type = MATERIAL_ORTHOTROPIC, .youngs = {1, 4, 1}, .poissons = {0.51, 0, 0}, .shears = {1, 1, 1}}));
  PetscCall(CheckRefused("axes along one line", &(Material){.type = MATERIAL_ORTHOTROPIC,
                                                  .youngs         = {1, 1, 1},
                                                  .shears         = {1, 1, 1},
                                                  .axes           = {{1, 2, 0}, {-2, -4, 0}}}));
  PetscCall(CheckParameters(2.6, 0.3));
  PetscCall(CheckParameters(1, 0));
  PetscCall(CheckParameters(1, 0.499));
  PetscCall(CheckParameters(1, 0.5));
  PetscCall(CheckParameters(1, -1));
  PetscCall(CheckParameters(0, 0.3));
  PetscCall(CheckParameters(-1, 0.3));
  PetscCall(CheckParameters((PetscReal)NAN, 0.3));
  PetscCall(CheckParameters(1, (PetscReal)NAN));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
