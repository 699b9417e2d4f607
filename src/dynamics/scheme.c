/*
   Schemes of time integration.

   Generalized-alpha (Chung and Hulbert 1993, in the form of Arnold and Bruels 2007, in which forces are in balance at
   the end of a time step). Primes denote the end of the step, w the acceleration, and a the auxiliary acceleration:

     M w' + dE/du(u') = f' + contact,   (1 - am) a' + am a = (1 - af) w' + af w,
     u' = u + dt v + dt^2 ((1/2 - beta) a + beta a'),   v' = v + dt ((1 - gamma) a + gamma a').

   Hence M w' = c M (u' - centre). Damping in proportion to mass adds to c and changes the centre. Damping in proportion
   to the stiffness K adds K (u' - viscous), because v' = gamma/(beta dt) (u' - viscous).

   Impact (Kane, Repetto, Ortiz and Marsden 1999): the trapezoidal rule for all forces except those of contact, which
   are taken at the end of the step. The work of contact forces is never positive if a gap is linear.

     M (v' - v)/dt + (r + r')/2 = contact,   r = dE/du - f,   u' = u + dt (v + v')/2.

   Twice the first equation is that of generalized-alpha with am = af = 0, beta = 1/4, gamma = 1/2, a = 0 and the
   additional force r. Contact forces are then half the multipliers.
*/
#include "dynamicsimpl.h"

typedef struct {
  PetscReal am, af, beta, gamma;
} SchemeNumbers;

static SchemeNumbers SchemeGetNumbers(const SceneDynamics *scene)
{
  const PetscReal r  = scene->spectral_radius;
  const PetscReal am = (2.0 * r - 1.0) / (r + 1.0), af = r / (r + 1.0);

  if (scene->scheme == SCHEME_IMPACT) return (SchemeNumbers){0.0, 0.0, 0.25, 0.5};
  return (SchemeNumbers){am, af, 0.25 * PetscSqr(1.0 - am + af), 0.5 - am + af};
}

/* Computes continued = u + dt v + dt^2 weight a */
static PetscErrorCode SchemeContinue(PetscReal dt, PetscReal weight, Vec u, Vec v, Vec a, Vec continued)
{
  PetscFunctionBegin;
  PetscCall(VecWAXPY(continued, dt, v, u));
  PetscCall(VecAXPY(continued, dt * dt * weight, a));
  PetscFunctionReturn(0);
}

/* Computes the displacement at the end of a time step if the acceleration remains constant */
PetscErrorCode SchemePredict(const Dynamics *d, PetscReal dt, Vec u, Vec predicted)
{
  PetscFunctionBegin;
  PetscCall(SchemeContinue(dt, 0.5, u, d->velocity, d->acceleration, predicted));
  PetscFunctionReturn(0);
}

/* Sets the factor and the displacement `viscous` of damping in proportion to stiffness. `viscous` is the displacement
   for which v' is zero. */
static PetscErrorCode SchemeSetViscous(const SceneDynamics *scene, SchemeNumbers s, PetscReal dt, Vec u, Dynamics *d)
{
  const PetscReal way = s.beta * dt / s.gamma;

  PetscFunctionBegin;
  if (!d->viscous) PetscFunctionReturn(0);
  d->viscosity     = scene->damping_stiffness / way;
  d->springs->rate = 1.0 / way;
  PetscCall(SchemeContinue(dt, 0.5 - s.beta, u, d->velocity, d->auxiliary, d->viscous));
  PetscCall(VecAXPY(d->viscous, -way, d->velocity));
  PetscCall(VecAXPY(d->viscous, -way * dt * (1.0 - s.gamma), d->auxiliary));
  PetscFunctionReturn(0);
}

/* Sets c and the centre for a time step that begins at u */
PetscErrorCode SchemeBegin(const SceneDynamics *scene, PetscReal dt, Vec u, Dynamics *d)
{
  const SchemeNumbers s      = SchemeGetNumbers(scene);
  const PetscReal     back   = s.beta * dt * dt / (1.0 - s.am);
  const PetscReal     inert  = (1.0 - s.am) / ((1.0 - s.af) * s.beta * dt * dt);
  const PetscReal     damped = scene->damping_mass * s.gamma / (s.beta * dt), factor = s.beta * dt / s.gamma;

  PetscFunctionBegin;
  d->inertia = inert + damped;
  PetscCall(SchemeSetViscous(scene, s, dt, u, d));
  PetscCall(SchemeContinue(dt, 0.5 - s.beta, u, d->velocity, d->auxiliary, d->centre));
  PetscCall(VecAXPY(d->centre, inert / d->inertia * back * s.af, d->acceleration));
  PetscCall(VecAXPY(d->centre, -inert / d->inertia * back * s.am, d->auxiliary));
  PetscCall(VecAXPY(d->centre, -damped / d->inertia * factor, d->velocity));
  PetscCall(VecAXPY(d->centre, -damped / d->inertia * factor * dt * (1.0 - s.gamma), d->auxiliary));
  PetscFunctionReturn(0);
}

/* Adds the terms of damping in proportion to stiffness and of dampers to the energy, and their gradients to `force`,
   which may be NULL */
static PetscErrorCode SchemeAddViscous(const Dynamics *d, Vec u, PetscReal *energy, Vec force)
{
  PetscReal stored;
  Vec       way, product;

  PetscFunctionBegin;
  if (d->springs->dampers)
    PetscCall(CentredAdd(d->springs->rate, d->springs->dampers, NULL, d->viscous, u, energy, force));
  if (d->viscosity == 0.0) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, &way));
  PetscCall(VecWAXPY(way, -1.0, d->viscous, u));
  PetscCall(ElasticityEnergy(d->elasticity, way, &stored));
  *energy += d->viscosity * stored;
  if (force) {
    PetscCall(VecDuplicate(u, &product));
    PetscCall(ElasticityForce(d->elasticity, way, product));
    PetscCall(VecAXPY(force, d->viscosity, product));
    PetscCall(VecDestroy(&product));
  }
  PetscCall(VecDestroy(&way));
  PetscFunctionReturn(0);
}

/* Adds the term of this time step at u to the energy, and its gradient to `force`, which may be NULL */
PetscErrorCode SchemeAddForce(const Dynamics *d, Vec u, PetscReal *energy, Vec force)
{
  const Vec constant[] = {d->residual, d->turn, d->excess, d->turned};

  PetscFunctionBegin;
  if (d->mass) PetscCall(CentredAdd(d->inertia, d->mass, NULL, d->centre, u, energy, force));
  if (d->viscous) PetscCall(SchemeAddViscous(d, u, energy, force));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(constant); ++k) {
    PetscScalar work;

    if (!constant[k]) continue;
    PetscCall(VecDot(constant[k], u, &work));
    *energy += PetscRealPart(work);
    if (force) PetscCall(VecAXPY(force, 1.0, constant[k]));
  }
  PetscFunctionReturn(0);
}

/* Computes rate = (to - from)/dt */
static PetscErrorCode SchemeGetRate(PetscReal dt, Vec from, Vec to, Vec rate)
{
  PetscFunctionBegin;
  PetscCall(VecWAXPY(rate, -1.0, from, to));
  PetscCall(VecScale(rate, 1.0 / dt));
  PetscFunctionReturn(0);
}

/* Replaces x by the mean rate (to - from)/dt in rows without an equation of motion */
static PetscErrorCode SchemeFollow(const Dynamics *d, PetscReal dt, Vec from, Vec to, Vec x)
{
  Vec rate;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(x, &rate));
  PetscCall(SchemeGetRate(dt, from, to, rate));
  PetscCall(VecAXPY(x, -1.0, rate));
  PetscCall(VecPointwiseMult(x, x, d->inert));
  PetscCall(VecAXPY(x, 1.0, rate));
  PetscCall(VecDestroy(&rate));
  PetscFunctionReturn(0);
}

/* Computes the damping force (damping_mass M + damping_stiffness K + D) velocity, with the matrix D of dampers */
PetscErrorCode SchemeGetDamping(const SceneDynamics *scene, const Dynamics *d, Vec velocity, Vec force)
{
  Vec elastic;

  PetscFunctionBegin;
  PetscCall(MatMult(d->mass, velocity, force));
  PetscCall(VecScale(force, scene->damping_mass));
  if (d->springs->dampers) PetscCall(MatMultAdd(d->springs->dampers, velocity, force, force));
  if (scene->damping_stiffness == 0.0) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(force, &elastic));
  PetscCall(ElasticityForce(d->elasticity, velocity, elastic));
  PetscCall(VecAXPY(force, scene->damping_stiffness, elastic));
  PetscCall(VecDestroy(&elastic));
  PetscFunctionReturn(0);
}

/* Adds to d->damped the energy that damping dissipates between the displacements `before` and u, by the trapezoidal
   rule. v: velocity at u */
static PetscErrorCode SchemeAddDamping(const SceneDynamics *scene, Vec before, Vec u, Vec v, Dynamics *d)
{
  PetscScalar product;
  Vec         increment, force;

  PetscFunctionBegin;
  if (scene->damping_mass == 0.0 && !d->viscous) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecWAXPY(increment, 1.0, d->velocity, v));
  PetscCall(SchemeGetDamping(scene, d, increment, force));
  PetscCall(VecWAXPY(increment, -1.0, before, u));
  PetscCall(VecDot(force, increment, &product));
  d->damped += 0.5 * PetscRealPart(product);
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&increment));
  PetscFunctionReturn(0);
}

/*
   Computes the acceleration a and the velocity v at u by Newmark's formulas, for a time step of length dt from the
   displacement `from`
*/
static PetscErrorCode SchemeNewmark(const SceneDynamics *scene, PetscReal dt, Vec from, Vec u, const Dynamics *d, Vec a,
  Vec v)
{
  const SchemeNumbers s = SchemeGetNumbers(scene);

  PetscFunctionBegin;
  PetscCall(SchemeContinue(dt, 0.5 - s.beta, from, d->velocity, d->auxiliary, a));
  PetscCall(VecAYPX(a, -1.0, u));
  PetscCall(VecScale(a, 1.0 / (s.beta * dt * dt)));
  PetscCall(VecWAXPY(v, dt * (1.0 - s.gamma), d->auxiliary, d->velocity));
  PetscCall(VecAXPY(v, dt * s.gamma, a));
  PetscFunctionReturn(0);
}

/* Computes velocity and accelerations at u, the end of a time step that began at `before` */
PetscErrorCode SchemeAdvance(const SceneDynamics *scene, PetscReal dt, Vec before, Vec u, Dynamics *d)
{
  const SchemeNumbers s = SchemeGetNumbers(scene);
  Vec                 a, v;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &a));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(SchemeNewmark(scene, dt, before, u, d, a, v));
  PetscCall(SchemeFollow(d, dt, before, u, v));
  PetscCall(DriveEnd(d, v));
  PetscCall(SchemeFollow(d, dt, d->velocity, v, a));
  if (d->residual) PetscCall(VecZeroEntries(a));
  else {
    PetscCall(VecScale(d->acceleration, -s.af / (1.0 - s.af)));
    PetscCall(VecAXPY(d->acceleration, (1.0 - s.am) / (1.0 - s.af), a));
    PetscCall(VecAXPY(d->acceleration, s.am / (1.0 - s.af), d->auxiliary));
  }
  if (d->residual) PetscCall(SchemeGetRate(dt, d->velocity, v, d->acceleration));
  else PetscCall(SchemeFollow(d, dt, d->velocity, v, d->acceleration));
  PetscCall(SchemeAddDamping(scene, before, u, v, d));
  PetscCall(VecDestroy(&d->velocity));
  PetscCall(VecDestroy(&d->auxiliary));
  d->velocity  = v;
  d->auxiliary = a;
  PetscFunctionReturn(0);
}

/* Computes the norm sqrt(x^T M x) with the mass matrix M */
static PetscErrorCode SchemeNorm(const Dynamics *d, Vec x, PetscReal *norm)
{
  PetscScalar square;
  Vec         product;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(x, &product));
  PetscCall(MatMult(d->mass, x, product));
  PetscCall(VecDot(x, product, &square));
  PetscCall(VecDestroy(&product));
  *norm = PetscSqrtReal(PetscMax(0.0, PetscRealPart(square)));
  PetscFunctionReturn(0);
}

/*
   Estimates the error of a time step from `from` to u over its length and the largest speed so far; both are norms with
   the mass. With Newmark's parameter beta the displacement is off by (beta - 1/6) dt^2 times the change of the
   acceleration (Zienkiewicz and Xie 1991). Where contact closes or opens, the motion is not smooth, the scheme is of
   first order, and the factor is 1. before: length of the previous time step; 0 in the first time step. The impact
   scheme has mean accelerations, which belong to the middle of a time step.
*/
PetscErrorCode SchemeEstimate(const SceneDynamics *scene, PetscReal dt, PetscReal before, PetscBool smooth, Vec from,
  Vec u, Dynamics *d, PetscReal *error)
{
  const SchemeNumbers s      = SchemeGetNumbers(scene);
  const PetscReal     factor = smooth ? PetscAbsReal(s.beta - 1.0 / 6.0) : 1.0;
  PetscReal           speed, change;
  Vec                 a, v;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &a));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(SchemeNewmark(scene, dt, from, u, d, a, v));
  PetscCall(SchemeNorm(d, d->velocity, &speed));
  d->fastest = PetscMax(d->fastest, speed);
  PetscCall(SchemeNorm(d, v, &speed));
  if (d->residual) PetscCall(SchemeGetRate(dt, d->velocity, v, a));
  PetscCall(VecAXPY(a, -1.0, d->residual ? d->acceleration : d->auxiliary));
  PetscCall(SchemeNorm(d, a, &change));
  if (d->residual) change *= 2.0 * dt / (dt + before);
  *error = change > 0.0 ? factor * dt * change / PetscMax(d->fastest, speed) : 0.0;
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&a));
  PetscFunctionReturn(0);
}
