/*
   Contact with friction by a semismooth Newton method (Alart and Curnier, A mixed formulation for frictional contact
   problems prone to Newton like solution methods, 1991; Hueeber, Stadler and Wohlmuth, A primal-dual active set
   algorithm for three-dimensional contact problems with Coulomb friction, 2008). Near a solution it ends in a few
   steps, since it knows which contacts are open, stick and slip.
*/
#include "frictionimpl.h"
#include "tao_ipfilter/residuals/residualsimpl.h"

/*
   Returns the largest tangential force of a closed contact at its present normal force. A limit alone does not
   depend on that force.
*/
static PetscReal NewtonBound(const Contacts *c, PetscInt i)
{
  const PetscBool constant = (PetscBool)(c->coefficient[i] < 0.0 || c->coefficient[i] >= PETSC_INFINITY);

  return constant ? c->limit[i] : ContactsBound(c, i, c->f[3 * i]);
}

/*
   Guesses which contacts are closed. interior: forces and motions are those of the interior point method, which are
   both positive; the larger one, in units of force, tells the state. Otherwise contacts with a force are closed.
*/
void ContactsGuessStates(Contacts *c, PetscBool interior)
{
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscReal f = c->f[3 * i], u = c->u[3 * i], compliance = c->compliance[2 * i];

    c->closed[i] = (PetscBool)(c->normal[i] && (interior ? f * compliance > u : f > c->least));
  }
}

/*
   Opens closed contacts under tension, and closes open ones with penetration after a step of length `fraction`. Stores
   the slip at which the latter had no gap.
*/
static void NewtonExchange(Contacts *c, const PetscReal du[], PetscReal fraction)
{
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscReal *u = &c->u[3 * i], *d = &du[3 * i];

    if (!c->normal[i]) continue;
    if (!c->closed[i] && u[0] < -c->rounding) {
      const PetscReal back = d[0] < 0.0 ? PetscMin(u[0] / d[0], fraction) : 0.0;

      for (PetscInt a = 0; a < 2; a++) c->place[2 * i + a] = u[1 + a] - back * d[1 + a];
    }
    c->closed[i] = (PetscBool)(c->closed[i] ? c->f[3 * i] >= 0.0 : u[0] < -c->rounding);
  }
}

/* Sets the linearized law of the normal component: u = 0 if it is closed, otherwise f = 0 */
static void NewtonNormalLaw(const Contacts *c, PetscInt i, PetscReal D[9], PetscReal s[3])
{
  const PetscReal f = c->f[3 * i], u = c->u[3 * i], compliance = c->compliance[2 * i];

  D[0] = c->closed[i] ? 1.0 / (CONTACT_WEAK * compliance) : 0.0;
  s[0] = c->closed[i] ? -u / (CONTACT_WEAK * compliance) : -f;
}

/*
   Sets the linearized law of the tangential components of a contact that slips: tau = b d with d = t / |t|,
   t = tau - rho v, b = min(limit, coefficient x f_n)
*/
static void NewtonSlipLaw(const Contacts *c, PetscInt i, const PetscReal t[2], PetscReal size, PetscReal D[9],
  PetscReal s[3])
{
  const PetscReal *f = &c->f[3 * i], rho = 1.0 / c->compliance[2 * i + 1];
  const PetscReal  bound = NewtonBound(c, i), theta = PetscMin(bound / size, 1.0),
                  slope = c->coefficient[i] < 0.0 || bound >= c->limit[i] ? 0.0 : c->coefficient[i],
                  d[2] = {t[0] / size, t[1] / size}, stiff = rho * PetscMin(theta / (1.0 - theta), 1.0 / CONTACT_WEAK);
  PetscReal off[2], along;

  for (PetscInt a = 0; a < 2; a++) off[a] = f[1 + a] - bound * d[a];
  along = d[0] * off[0] + d[1] * off[1];
  for (PetscInt a = 0; a < 2; a++) {
    const PetscReal across = off[a] - along * d[a];

    /* across d, (1 - theta) dtau + theta rho dv = -off; the stiffness says what that is if theta is almost 1 */
    s[1 + a] = slope * d[a] * s[0] - along * d[a] -
               (theta < 1.0 ? across * PetscMin(1.0 / (1.0 - theta), 1.0 / CONTACT_WEAK) : 0.0);
    D[3 * (1 + a)] = slope * d[a] * D[0];
    for (PetscInt b = 0; b < 2; b++) D[3 * (1 + a) + 1 + b] = stiff * ((a == b ? 1.0 : 0.0) - d[a] * d[b]);
  }
}

/*
   Sets the linearized law of a contact. It slips if tau - rho v is outside of the bound, at the normal force that a
   step from f_n - rho u_n would have. Returns whether it sticks.
*/
PetscBool ContactsLinearize(const Contacts *c, PetscInt i)
{
  const PetscReal *f = &c->f[3 * i], *u = &c->u[3 * i], compliance = c->compliance[2 * i + 1];
  PetscReal       *D = &c->D[9 * i], *S = &c->S[9 * i], *s = &c->s[3 * i], t[2], size;

  for (PetscInt k = 0; k < 9; k++) D[k] = S[k] = 0.0;
  NewtonNormalLaw(c, i, D, s);
  S[0] = D[0];
  for (PetscInt a = 1; a < 3; a++) s[a] = -f[a];
  if (c->law[i] == CONTACT_STICKS) {
    if (c->held[i]) ContactsSetNoSlip(c, i);
    return c->held[i];
  }
  if (c->law[i] == CONTACT_SMOOTH || (!c->closed[i] && c->coefficient[i] >= 0.0)) return PETSC_FALSE;
  for (PetscInt a = 0; a < 2; a++) t[a] = f[1 + a] - u[1 + a] / compliance;
  size = PetscSqrtReal(t[0] * t[0] + t[1] * t[1]);
  if (size > ContactsBound(c, i, f[0] - u[0] / c->compliance[2 * i])) {
    NewtonSlipLaw(c, i, t, size, D, s);
    for (PetscInt k = 4; k < 9; k++) S[k] = k % 3 ? D[k] : 0.0;
    return PETSC_FALSE;
  }
  ContactsSetNoSlip(c, i);
  return PETSC_TRUE;
}

/*
   Finds the fraction of a step with the smallest merit, by halving it. The merit is the violation of the laws together
   with the residual of the bodies, which falls in proportion to the step. If no fraction is better than the start, it
   is the whole step, since many short steps would make no progress. residual: of the bodies at the start, in the norm
   of the energy, like the violation [square root of energy]; merit: that of the fraction
*/
static PetscErrorCode NewtonChooseFraction(const Contacts *c, const PetscReal du[], const PetscReal df[],
  PetscReal residual, PetscReal *fraction, PetscReal *merit)
{
  const PetscInt halvings = 8;
  PetscReal      violation, *f, *u, whole = 0.0, start;

  PetscFunctionBegin;
  *fraction = 1.0;
  PetscCall(ContactsViolation(c, c->f, c->u, &violation));
  start = *merit = PetscSqrtReal(PetscSqr(violation) + PetscSqr(residual));
  PetscCall(PetscMalloc2(3 * c->n, &f, 3 * c->n, &u));
  for (PetscReal alpha = 1.0; alpha >= PetscPowRealInt(0.5, halvings); alpha *= 0.5) {
    for (PetscInt r = 0; r < 3 * c->n; r++) {
      f[r] = c->f[r] + alpha * df[r];
      u[r] = c->u[r] + alpha * du[r];
    }
    PetscCall(ContactsViolation(c, f, u, &violation));
    violation = PetscSqrtReal(PetscSqr(violation) + PetscSqr((1.0 - alpha) * residual));
    if (alpha == 1.0) whole = violation;
    if (!(violation < *merit)) continue;
    *merit    = violation;
    *fraction = alpha;
  }
  if (*merit == start) *merit = whole;
  PetscCall(PetscFree2(f, u));
  PetscFunctionReturn(0);
}

/* Takes one Newton step. merit: see NewtonChooseFraction(); change: norm of the change of motions. Both are square
   roots of energies. */
PetscErrorCode ContactsNewtonStep(Contacts *c, const ContactBodies *bodies, PetscReal *merit, PetscReal *change,
  PetscBool *solved)
{
  const PetscReal forcing = 1e-2; /* residual of a system, relative to that with the directions there are: factors cost
                                    more than directions */
  PetscReal       fraction, work, *du, *df;

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(3 * c->n, &du, 3 * c->n, &df));
  for (PetscInt i = 0; i < c->n; i++) {
    ContactsLinearize(c, i);
    ContactsFinishLaw(c, i);
  }
  PetscCall(bodies->residual(bodies->data, c->f, NULL));
  PetscCall(bodies->prepare(bodies->data, c->D, c->S, solved));
  if (*solved) PetscCall(ContactsStep(c, bodies, forcing, 0.0, du, df, solved));
  if (*solved) {
    PetscCall(bodies->work(bodies->data, &work));
    PetscCall(NewtonChooseFraction(c, du, df, PetscSqrtReal(PetscAbsReal(work)), &fraction, merit));
    for (PetscInt r = 0; r < 3 * c->n; r++) {
      c->u[r] += fraction * du[r];
      c->f[r] += fraction * df[r];
    }
    PetscCall(bodies->advance(bodies->data, fraction));
    PetscCall(ContactsNorm(c, du, change));
    NewtonExchange(c, du, fraction);
  }
  PetscCall(PetscFree2(du, df));
  PetscFunctionReturn(0);
}
