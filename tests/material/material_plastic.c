static char help[] =
  "Plasticity of von Mises at a point: derivatives against differences, the energy over a step's end, "
  "bars in closed form, convexity, bad parameters.\n\n";

#include "material_differences.h"

static const Material materials[] = {
  {.hardening = {.yield = 0.1}},
  {.hardening = {.yield = 0.1, .modulus = 0.4}},
  {.hardening = {.yield = 0.1, .kinematic = 0.3}},
  {.hardening = {.yield = 0.1, .saturation = 0.16, .rate = 5, .kinematic = 0.1}},
  {.hardening =
      {.yield = 0.1, .modulus = 0.05, .strains = {4, {0, 0.02, 0.1, 0.25}}, .stresses = {4, {0.1, 0.13, 0.13, 0.2}}}},
};
static const char *const names[] = {"perfect", "linear", "kinematic", "Voce and kinematic", "table and linear"};

/* The yield stress by its definition, and its integral by Simpson's rule between the points of a table */
static PetscReal YieldStress(const MaterialHardening *h, PetscReal a)
{
  PetscReal stress = h->yield;

  for (PetscInt i = 1; i < h->strains.n; ++i) {
    const PetscReal part = (a - h->strains.value[i - 1]) / (h->strains.value[i] - h->strains.value[i - 1]);

    stress += PetscMin(PetscMax(part, 0), 1) * (h->stresses.value[i] - h->stresses.value[i - 1]);
  }
  return stress + h->modulus * a + (h->rate > 0 ? (h->saturation - h->yield) * (1 - PetscExpReal(-h->rate * a)) : 0);
}

/* Stress and tangent at rough strains, from rough histories, against differences; a step from its own end is elastic */
static PetscErrorCode CheckDerivatives(const MaterialLaw *law, MaterialModuli *m)
{
  const PetscReal h         = 1e-6;
  PetscReal       errors[4] = {0};
  PetscInt        nplastic  = 0;

  PetscFunctionBeginUser;
  for (PetscInt sample = 0; sample < 20; ++sample) {
    PetscReal H[9], P[9], Q[9], A[81], before[MATERIAL_HISTORY] = {0}, after[MATERIAL_HISTORY], W;

    for (PetscInt i = 0; i < 9; ++i) H[i] = 0.1 * Rough(9 * sample + i);
    m->history = before;
    if (sample % 3) {
      law->advance(m, H, after);
      PetscCall(PetscArraycpy(before, after, MATERIAL_HISTORY));
      for (PetscInt i = 0; i < 9; ++i) H[i] += 0.1 * Rough(1000 + 9 * sample + i);
    }
    W = law->energy(m, H);
    law->stress(m, H, P);
    law->tangent(m, H, A);
    RaiseDerivativeErrors(law, m, h, H, P, A, errors);
    nplastic += law->advance(m, H, after);
    m->history = after;
    law->stress(m, H, Q);
    errors[3] = PetscMax(errors[3], PetscAbsReal(law->energy(m, H) - W));
    for (PetscInt i = 0; i < 9; ++i) errors[3] = PetscMax(errors[3], PetscAbsReal(Q[i] - P[i]));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  samples that yield: %s\n", nplastic > 10 ? "most" : "FEW"));
  PetscCall(Report("stress against differences of the energy", errors[0], 1e-8));
  PetscCall(Report("tangent against differences of the stress", errors[1], 1e-7));
  PetscCall(Report("asymmetry of the tangent", errors[2], 1e-14));
  PetscCall(Report("energy and stress over the end of a step", errors[3], 1e-13));
  PetscFunctionReturn(0);
}

/* The isochoric part, elasticity without history, and v.A v >= 0 */
static PetscErrorCode CheckParts(const MaterialLaw *law, const MaterialModuli *moduli, const MaterialModuli *isochoric)
{
  const MaterialLaw *hooke;
  const Material     linear = {.type = MATERIAL_LINEAR};
  MaterialModuli     m = *moduli, iso = *isochoric;
  PetscReal          history[MATERIAL_HISTORY] = {0}, parts = 0, elastic = 0, least = 1;

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(&linear, &hooke));
  for (PetscInt sample = 0; sample < 20; ++sample) {
    PetscReal H[9], C[9], A[81], theta, vAv = 0, vv = 0;

    for (PetscInt i = 0; i < 9; ++i) H[i] = 0.15 * Rough(9 * sample + i);
    theta     = law->dilatation(H, C);
    elastic   = PetscMax(elastic, PetscAbsReal(law->energy(moduli, H) - hooke->energy(moduli, H)));
    m.history = iso.history = history;
    parts = PetscMax(parts, PetscAbsReal(law->energy(&m, H) - law->energy(&iso, H) - 0.5 * m.bulk * theta * theta));
    law->tangent(&m, H, A);
    for (PetscInt i = 0; i < 9; ++i) {
      const PetscReal v = Rough(500 + 9 * sample + i / 3 + i % 3) + Rough(700 + i / 3 * (i % 3));

      vv += v * v;
      for (PetscInt j = 0; j < 9; ++j)
        vAv += v * A[9 * i + j] * (Rough(500 + 9 * sample + j / 3 + j % 3) + Rough(700 + j / 3 * (j % 3)));
    }
    least = PetscMin(least, vAv / vv);
  }
  PetscCall(Report("energy less its isochoric and volumetric parts", parts, 1e-14));
  PetscCall(Report("without history: energy less Hooke's", elastic, 1e-15));
  PetscCall(Report("how far the tangent is from having no negative energy", -least, 1e-14));
  PetscFunctionReturn(0);
}

/* Strain of a bar under a stress along x with the plastic strain p along it */
static void Bar(PetscReal stress, PetscReal p, PetscReal H[9])
{
  for (int i = 0; i < 9; ++i) H[i] = i % 4 ? 0 : i ? -POISSON * stress / YOUNG - 0.5 * p : stress / YOUNG + p;
}

/*
   A bar that is pulled, pushed and pulled: each half cycle is elastic up to twice the yield stress around the back
   stress K p, whereupon it yields by dp: the stress is K p +- sigma_y(a) then. Each to its end in one step
*/
static PetscErrorCode CheckBar(const MaterialLaw *law, MaterialModuli *m, const MaterialHardening *h)
{
  const PetscReal to[]                      = {0.05, -0.03, 0.08};
  PetscReal       history[MATERIAL_HISTORY] = {0}, p = 0, alpha = 0, work = 0, error = 0;

  PetscFunctionBeginUser;
  for (int k = 0; k < 3; ++k) {
    const PetscReal sign = to[k] > p ? 1 : -1, begin = alpha;
    PetscReal       H[9], P[9], after[MATERIAL_HISTORY], stress;
    const PetscInt  n = 20000;

    alpha += PetscAbsReal(to[k] - p);
    for (PetscInt i = 0; i < n; ++i)
      work +=
        (alpha - begin) / (PetscReal)n * YieldStress(h, begin + ((PetscReal)i + 0.5) / (PetscReal)n * (alpha - begin));
    p      = to[k];
    stress = h->kinematic * p + sign * YieldStress(h, alpha);
    Bar(stress, p, H);
    m->history = history;
    law->stress(m, H, P);
    law->advance(m, H, after);
    error = PetscMax(error, PetscMax(PetscAbsReal(P[0] - stress), PetscMax(PetscAbsReal(P[4]), PetscAbsReal(P[8]))));
    error = PetscMax(error, PetscMax(PetscAbsReal(after[0] - p), PetscAbsReal(after[6] - alpha)));
    PetscCall(PetscArraycpy(history, after, MATERIAL_HISTORY));
    Bar(stress - sign * 1.99 * YieldStress(h, alpha), p, H); /* Bauschinger: elastic up to here */
    if (law->advance(m, H, after)) error = PETSC_INFINITY;
  }
  PetscCall(Report("a bar pulled, pushed and pulled against its closed form", error, 1e-13));
  PetscCall(Report("its plastic work", PetscAbsReal(law->work(m, history) - work - 0.5 * h->kinematic * p * p), 1e-9));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckRefused(MaterialHardening hardening)
{
  const char *key;
  char        why[128];

  PetscFunctionBeginUser;
  if (MaterialCheckHardening(&hardening, &key, why, sizeof(why)))
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "ACCEPTED\n"));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s %s\n", key, why));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (size_t t = 0; t < PETSC_STATIC_ARRAY_LENGTH(materials); ++t) {
    Material           material = materials[t];
    const MaterialLaw *law;
    MaterialModuli     m, isochoric;

    PetscCall(BeginPlastic(names[t], MATERIAL_J2, &material, &law, &m, &isochoric));
    PetscCall(CheckParts(law, &m, &isochoric));
    PetscCall(CheckDerivatives(law, &m));
    PetscCall(CheckBar(law, &m, &material.hardening));
  }
  PetscCall(CheckRefused((MaterialHardening){.yield = 0}));
  PetscCall(CheckRefused((MaterialHardening){.yield = -1}));
  PetscCall(CheckRefused((MaterialHardening){.yield = (PetscReal)NAN}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .modulus = -1}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .kinematic = -1}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .saturation = 0.5, .rate = 1}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .saturation = 2}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .saturation = 2, .rate = -1}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .strains = {2, {0, 1}}, .stresses = {1, {1}}}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .strains = {2, {0.1, 1}}, .stresses = {2, {1, 2}}}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .strains = {3, {0, 1, 1}}, .stresses = {3, {1, 2, 3}}}));
  PetscCall(CheckRefused((MaterialHardening){.yield = 1, .strains = {3, {0, 1, 2}}, .stresses = {3, {1, 2, 1.5}}}));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
