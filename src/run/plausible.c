/* Asks whether the constants of materials are in the units that the scene states */
#include "runimpl.h"
#include "src/report/reportimpl.h"

/* Ranges of solid materials, in Pa and kg/m^3: from gels to diamond, and from foams to osmium */
#define SOFTEST  1e3
#define STIFFEST 1.3e12
#define LIGHTEST 5.0
#define HEAVIEST 2.3e4

/* Young's moduli of metals, and Poisson's ratios of metals and other stiff solids. A modulus a thousand times too small
   is that of a soft polymer, but such polymers have larger ratios. */
#define METALS_FROM  4e10
#define METALS_TO    4.5e11
#define METALS_RATIO 0.38

/* Warns with a question about a constant, and a sentence about it */
static PetscErrorCode PlausibleAsk(Model model, RunReport *report, const SceneBody *body, const char constant[],
  PetscReal value, const char unit[], const char sentence[])
{
  char text[512];

  PetscFunctionBegin;
  (void)snprintf(text, sizeof(text), "body \"%s\": is %s = %g in %s? %s", body->name, constant, (double)value, unit,
    sentence);
  PetscCall(ReportWarn(model->comm, report, body->place, "%s", text));
  PetscFunctionReturn(0);
}

/* Asks about a Young's modulus. si: unit of stress [Pa] */
static PetscErrorCode PlausibleModulus(Model model, RunReport *report, const SceneBody *body, PetscReal si)
{
  const char     *unit      = UnitsFind(model->scene->units, UNIT_STRESS, NULL);
  const Material *m         = &body->material;
  const PetscReal E         = m->young * si;
  char            text[256] = ""; /* snprintf() is used because PETSc's formatting would print 210. for 210 */

  PetscFunctionBegin;
  if (E >= METALS_FROM / 1e3 && E <= METALS_TO / 1e3 && m->poisson < METALS_RATIO)
    (void)snprintf(text, sizeof(text), "With Poisson's ratio %g it would be a metal if it were %g %s",
      (double)m->poisson, 1e3 * (double)m->young, unit);
  else if (E < SOFTEST || E > STIFFEST)
    (void)snprintf(text, sizeof(text), "This would be %s; steel has %g %s",
      E < SOFTEST ? "softer than a gel" : "stiffer than diamond", 2.1e11 / (double)si, unit);
  if (!text[0]) PetscFunctionReturn(0);
  PetscCall(PlausibleAsk(model, report, body, "Young's modulus young", m->young, unit, text));
  PetscFunctionReturn(0);
}

/* Asks about a density. si: unit of mass per volume [kg/m^3] */
static PetscErrorCode PlausibleDensity(Model model, RunReport *report, const SceneBody *body, PetscReal si)
{
  const PetscReal density = body->material.density * si;
  char            text[256], unit[96];

  PetscFunctionBegin;
  if (density == 0.0 || (density >= LIGHTEST && density <= HEAVIEST)) PetscFunctionReturn(0);
  (void)snprintf(unit, sizeof(unit), "the units \"%s\"", model->scene->units);
  (void)snprintf(text, sizeof(text), "This would be %.3g kg/m^3; steel has %g in these units", (double)density,
    7850.0 / (double)si);
  PetscCall(PlausibleAsk(model, report, body, "density", body->material.density, unit, text));
  PetscFunctionReturn(0);
}

/* Warns of bodies whose stiffnesses differ so much that contact forces are lost in rounding errors of the stiffer */
static PetscErrorCode PlausibleRatio(Model model, RunReport *report)
{
  const SceneBody *soft, *hard;
  const PetscReal  ratio = SceneRatioBeyondRounding(model->scene, &soft, &hard);

  PetscFunctionBegin;
  if (ratio == 0.0) PetscFunctionReturn(0);
  PetscCall(ReportWarn(model->comm, report, hard->place,
    "body \"%s\" is %.1g times as stiff as body \"%s\", so that rounding errors of its forces may exceed the forces "
    "between them: use material: rigid",
    hard->name, (double)ratio, soft->name));
  PetscFunctionReturn(0);
}

/* Warns of constants of elastic bodies that no solid has in the scene's units, without which nothing is known */
PetscErrorCode PlausibleTest(Model model, RunReport *report)
{
  Scene     scene = model->scene;
  PetscReal length, force, stress, time;

  PetscFunctionBegin;
  (void)UnitsFind(scene->units, UNIT_LENGTH, &length);
  (void)UnitsFind(scene->units, UNIT_FORCE, &force);
  (void)UnitsFind(scene->units, UNIT_STRESS, &stress);
  (void)UnitsFind(scene->units, UNIT_TIME, &time);
  if (time == 0.0) time = 1.0;
  PetscCall(PlausibleRatio(model, report));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];

    if (length > 0.0 && force > 0.0)
      PetscCall(PlausibleDensity(model, report, body, force * PetscSqr(time) / PetscSqr(PetscSqr(length))));
    if (body->material.type == MATERIAL_RIGID) continue;
    if (stress > 0.0) PetscCall(PlausibleModulus(model, report, body, stress));
    if (body->material.poisson < 0.0)
      PetscCall(ReportWarn(model->comm, report, body->place,
        "body \"%s\" has Poisson's ratio poisson = %g: only auxetic foams and lattices have one below 0", body->name,
        (double)body->material.poisson));
  }
  PetscFunctionReturn(0);
}
