/*
   The forces of contacts where equilibrium does not determine them, for example at a node of two pairs with rigid
   bodies: the smallest ones within their bounds, in the norm of the compliances. They depend on neither the number of
   ranks nor the path on which the laws were solved.
*/
#include "frictionimpl.h"

/* Returns sum c v^2 over the components of a contact, with its compliances c */
static PetscReal ChoiceSquare(const Contacts *c, PetscInt i, const PetscReal v[3])
{
  return c->compliance[2 * i] * v[0] * v[0] + c->compliance[2 * i + 1] * (v[1] * v[1] + v[2] * v[2]);
}

/*
   Computes the nearest forces to f with the same effect on the bodies as those of equilibrium. The solution remains:
   only the residual of f acts on the bodies, with springs D in the places of the contacts, whose forces answer it.
*/
static PetscErrorCode ChoiceBalance(Contacts *c, const ContactBodies *bodies, PetscReal du[], PetscReal df[],
  PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(PetscArrayzero(c->s, 3 * c->n));
  PetscCall(bodies->residual(bodies->data, c->f, NULL));
  PetscCall(ContactsStep(c, bodies, 1.0, 0.0, du, df, solved));
  for (PetscInt i = 0; i < c->n && *solved; i++) {
    ContactsSetForce(c, i, c->f[3 * i] + df[3 * i]);
    for (PetscInt a = 1; a < 3; a++) c->f[3 * i + a] += df[3 * i + a];
  }
  PetscFunctionReturn(0);
}

/* Removes the force of a contact, except a normal force that the contact's own compliance determines */
static void ChoiceRemove(const Contacts *c, PetscInt i)
{
  for (PetscInt a = c->own[i] > 0.0; a < 3; a++) c->f[3 * i + a] = 0.0;
}

/* Sets the forces f */
static void ChoiceReturn(const Contacts *c, const PetscReal f[])
{
  for (PetscInt i = 0; i < c->n; i++) {
    ContactsSetForce(c, i, f[3 * i]);
    for (PetscInt a = 1; a < 3; a++) c->f[3 * i + a] = f[3 * i + a];
  }
}

/* Moves the force f of a contact to the nearest one within its bounds. A contact with a compliance of its own keeps its
   normal force. */
static void ChoiceBound(const Contacts *c, PetscInt i, PetscReal f[3])
{
  const PetscReal  stretch = PetscSqrtReal(c->compliance[2 * i + 1] / c->compliance[2 * i]);
  const PetscReal  m = c->coefficient[i] * stretch, size = PetscSqrtReal(f[1] * f[1] + f[2] * f[2]);
  const ContactLaw law = c->law[i];
  PetscReal        most;

  if (c->own[i] > 0.0) f[0] = c->f[3 * i];
  else if ((law == CONTACT_COULOMB || law == CONTACT_LIMITED) && stretch * size > m * f[0])
    f[0] = (f[0] + m * stretch * size) / (1.0 + m * m);
  f[0] = PetscMax(f[0], 0.0);
  most = ContactsBound(c, i, f[0]);
  for (PetscInt a = 1; a < 3 && size > most; a++) f[a] *= most / size;
}

/*
   Finds the smallest forces within the bounds by alternating projections (Dykstra 1983), in which the bounds have a
   memory p. free[i]: whether contact i is closed and does not slip
*/
static PetscErrorCode ChoiceIterate(Contacts *c, const ContactBodies *bodies, const PetscBool free[], PetscReal du[],
  PetscReal df[], PetscReal p[], PetscBool *solved)
{
  const PetscInt  most    = 300;
  const PetscReal small   = 1e-6; /* change of the forces that ends the iteration, relative to the forces */
  PetscReal       sums[2] = {0.0, 1.0};
  PetscInt        k;

  PetscFunctionBegin;
  for (k = 0; k < most; k++) {
    PetscCall(ChoiceBalance(c, bodies, du, df, solved));
    if (!*solved) break;
    sums[0] = sums[1] = 0.0;
    for (PetscInt i = 0; i < c->n; i++) {
      PetscReal bounded[3], off[3];

      if (!free[i]) continue;
      for (PetscInt a = 0; a < 3; a++) bounded[a] = c->f[3 * i + a] + p[3 * i + a];
      ChoiceBound(c, i, bounded);
      for (PetscInt a = 0; a < 3; a++) {
        off[a] = c->f[3 * i + a] - bounded[a];
        p[3 * i + a] += off[a];
      }
      sums[0] += ChoiceSquare(c, i, off);
      sums[1] += ChoiceSquare(c, i, bounded);
      if (k + 1 < most) PetscCall(PetscArraycpy(&c->f[3 * i], bounded, 3));
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, c->comm));
    if (sums[0] <= PetscSqr(small) * sums[1]) break;
  }
  PetscCall(PetscInfo(NULL, "Forces chosen by %" PetscInt_FMT " projections, off their bounds by %g of their size\n", k,
    (double)PetscSqrtReal(sums[0] / sums[1])));
  PetscFunctionReturn(0);
}

/* Sets springs of the compliances in the places of closed contacts that do not slip. free[i]: whether contact i has
   them */
static void ChoiceSetSprings(Contacts *c, PetscBool free[])
{
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscReal *u = &c->u[3 * i], *compliance = &c->compliance[2 * i];
    const PetscReal  bound = ContactsBound(c, i, c->f[3 * i]), slip = PetscSqrtReal(u[1] * u[1] + u[2] * u[2]);

    free[i] =
      (PetscBool)(c->closed[i] && (c->law[i] == CONTACT_SMOOTH || slip <= CONTACT_WEAK * compliance[1] * bound));
    for (PetscInt k = 0; k < 9; k++) c->D[9 * i + k] = c->S[9 * i + k] = 0.0;
    for (PetscInt a = 0; a < 3 && free[i]; a++)
      if (!a || c->law[i] != CONTACT_SMOOTH)
        c->D[9 * i + 4 * a] = c->S[9 * i + 4 * a] = 1.0 / (CONTACT_WEAK * compliance[a > 0]);
    ContactsFinishLaw(c, i);
  }
}

/* Finds whether the forces differ from f by more than rounding errors */
static PetscErrorCode ChoiceDiffers(const Contacts *c, const PetscReal f[], PetscBool *differs)
{
  const PetscReal small   = 1e-10; /* square of the difference, relative to that of the forces */
  PetscReal       sums[2] = {0.0, 0.0};

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) {
    PetscReal off[3];

    for (PetscInt a = 0; a < 3; a++) off[a] = c->f[3 * i + a] - f[3 * i + a];
    sums[0] += ChoiceSquare(c, i, off);
    sums[1] += ChoiceSquare(c, i, &f[3 * i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, c->comm));
  *differs = (PetscBool)(sums[0] > small * sums[1]);
  PetscFunctionReturn(0);
}

/*
   Finds whether equilibrium determines the forces f, at a solution: without these, springs of the last linearization
   must give the same ones
*/
static PetscErrorCode ChoiceIsNeeded(Contacts *c, const ContactBodies *bodies, const PetscReal f[], PetscReal du[],
  PetscReal df[], PetscBool *needed)
{
  const PetscInt most = 4; /* each balance leaves a part that depends on the springs, CONTACT_WEAK or more */
  PetscBool      solved;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscBool sticks = ContactsLinearize(c, i);

    if (c->closed[i] && (sticks || c->law[i] == CONTACT_SMOOTH)) ChoiceRemove(c, i);
    ContactsFinishLaw(c, i);
  }
  PetscCall(bodies->prepare(bodies->data, c->D, c->S, &solved));
  for (PetscInt k = 0; k < most && solved; k++) PetscCall(ChoiceBalance(c, bodies, du, df, &solved));
  PetscCall(ChoiceDiffers(c, f, needed));
  *needed = (PetscBool)(*needed && solved);
  PetscFunctionReturn(0);
}

/* Chooses forces at a solution if equilibrium does not determine them. *chosen: whether others were chosen */
PetscErrorCode ContactsChoose(Contacts *c, const ContactBodies *bodies, PetscBool *chosen)
{
  const PetscInt n = 3 * c->n;
  PetscReal     *du, *df, *f, *p;
  PetscBool     *free;

  PetscFunctionBegin;
  PetscCall(PetscCalloc5(n, &du, n, &df, n, &f, n, &p, c->n, &free));
  PetscCall(PetscArraycpy(f, c->f, n));
  PetscCall(ChoiceIsNeeded(c, bodies, f, du, df, chosen));
  ChoiceReturn(c, f);
  if (*chosen) {
    ChoiceSetSprings(c, free);
    PetscCall(bodies->prepare(bodies->data, c->D, c->S, chosen));
  }
  for (PetscInt i = 0; i < c->n && *chosen; i++)
    if (free[i]) ChoiceRemove(c, i);
  if (*chosen) PetscCall(ChoiceIterate(c, bodies, free, du, df, p, chosen));
  if (*chosen) PetscCall(ChoiceDiffers(c, f, chosen));
  if (!*chosen) ChoiceReturn(c, f);
  PetscCall(PetscFree5(du, df, f, p, free));
  PetscFunctionReturn(0);
}
