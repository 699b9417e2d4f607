/*
   Contacts that stick while they are closed. They may have several states of equilibrium; the one that continues the
   last state is chosen. A contact that is closed at the begin is held at its place: it has no slip. The laws of the
   normal components are solved exactly while these contacts are held, as without friction. Held contacts that have
   opened are then released: they slide freely if they close again. Open contacts that have closed are held where they
   would have closed if all forces grew in proportion. This is repeated until nothing changes. It ends, since a contact
   is held once.

   If contacts are released, the load grows in parts from that of the begin, and what is closed is held again at the end
   of each part. Until the whole load acts, all contacts bear a tension that is small, but larger than rounding errors,
   so that these do not decide what is held where forces almost vanish.
*/
#include "frictionimpl.h"
#include "tao_ipfilter/solver/constants.h"

static PetscBool ContactSticks(const Contacts *c, PetscInt i)
{
  return (PetscBool)(c->law[i] == CONTACT_STICKS && c->coefficient[i] > 0.0);
}

/*
   Finds whether contacts stick while they are closed, and whether their normal laws can be solved exactly: all others
   are without friction, and no dense matrix of the contacts is large
*/
PetscErrorCode ContactsHaveHeld(const Contacts *c, PetscBool *some, PetscBool *exact)
{
  PetscBool both[2] = {PETSC_FALSE, PETSC_FALSE};
  PetscInt  n       = c->n;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) {
    if (ContactSticks(c, i)) both[0] = PETSC_TRUE;
    if (c->law[i] != CONTACT_STICKS && c->law[i] != CONTACT_SMOOTH) both[1] = PETSC_TRUE;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_PETSCBOOL, MPI_LOR, c->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPIU_INT, MPI_SUM, c->comm));
  *some  = both[0];
  *exact = (PetscBool)(!both[1] && n <= IP_DENSE_ROWS);
  PetscFunctionReturn(0);
}

/* Moves the place from which a contact's slip is measured to the given slip */
static void StickRefer(Contacts *c, PetscInt i, const PetscReal slip[2])
{
  const PetscReal move[2] = {slip[0], slip[1]};

  for (PetscInt a = 0; a < 2; a++) {
    c->shift[2 * i + a] += move[a];
    c->place[2 * i + a] -= move[a];
    c->u[3 * i + 1 + a] -= move[a];
  }
}

/* Closes the contacts with a force f or without a gap in the motions u */
static PetscErrorCode StickClose(Contacts *c, const PetscReal f[], const PetscReal u[])
{
  const PetscReal touch   = 1e-9; /* gap without meaning, relative to the largest one */
  PetscReal       largest = 0.0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) largest = PetscMax(largest, PetscAbsReal(u[3 * i]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, c->comm));
  for (PetscInt i = 0; i < c->n; i++)
    c->closed[i] = (PetscBool)(c->normal[i] && (f[3 * i] > 0.0 || u[3 * i] <= PetscMax(touch * largest, c->rounding)));
  PetscFunctionReturn(0);
}

/* Holds the contacts that are closed in the motions u, which a part of the load begins with */
static PetscErrorCode StickHold(ContactStick *s, const PetscReal u[])
{
  Contacts *c = s->contacts;

  PetscFunctionBegin;
  PetscCall(PetscArraycpy(s->from, u, 3 * c->n));
  s->predicted = PETSC_FALSE;
  for (PetscInt i = 0; i < c->n; i++) {
    if (!ContactSticks(c, i)) continue;
    c->held[i]     = c->closed[i];
    c->released[i] = PETSC_FALSE;
    for (PetscInt a = 0; a < 2; a++) c->place[2 * i + a] = u[3 * i + 1 + a];
  }
  PetscFunctionReturn(0);
}

/*
   Releases held contacts that are open, and holds closed ones that were not released. The slip of the others is
   measured from where they are. released, held: their numbers on all ranks
*/
PetscErrorCode StickUpdate(Contacts *c, PetscInt *released, PetscInt *held)
{
  PetscInt n[2] = {0, 0};

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) {
    if (!ContactSticks(c, i)) continue;
    if (c->held[i] && !c->closed[i]) {
      c->held[i]     = PETSC_FALSE;
      c->released[i] = PETSC_TRUE;
      n[0]++;
    } else if (!c->held[i] && c->closed[i] && !c->released[i]) {
      StickRefer(c, i, &c->place[2 * i]);
      c->held[i] = PETSC_TRUE;
      n[1]++;
    }
    if (!c->held[i]) StickRefer(c, i, &c->u[3 * i + 1]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 2, MPIU_INT, MPI_SUM, c->comm));
  PetscCall(PetscInfo(NULL, "Contacts that stick: %" PetscInt_FMT " released, %" PetscInt_FMT " held\n", n[0], n[1]));
  *released = n[0];
  *held     = n[1];
  PetscFunctionReturn(0);
}

/* Begins at the present state. The contacts are held that were closed when the solve began. */
PetscErrorCode StickBegin(Contacts *c, const ContactBodies *bodies, PetscBool linear, ContactStick *s)
{
  const size_t n = 3 * (size_t)c->n;

  PetscFunctionBegin;
  *s = (ContactStick){.contacts = c, .bodies = bodies, .nparts = 1, .divides = linear};
  PetscCall(PetscCalloc4(n, &s->du, n, &s->df, 2 * n, &s->first, n, &s->from));
  PetscCall(PetscArraycpy(s->first, c->u, n));
  PetscCall(PetscArraycpy(s->first + n, c->f, n));
  PetscCall(bodies->keep(bodies->data, PETSC_FALSE));
  PetscCall(StickClose(c, c->f_start, c->u_start));
  PetscCall(StickHold(s, c->u_start));
  PetscFunctionReturn(0);
}

PetscErrorCode StickEnd(ContactStick *s)
{
  PetscFunctionBegin;
  PetscCall(PetscFree4(s->du, s->df, s->first, s->from));
  PetscFunctionReturn(0);
}

/* Finds where open contacts would close, if no other contact opened or closed */
static PetscErrorCode StickPredict(ContactStick *s)
{
  const PetscReal accuracy = 1e-3; /* of the places */
  Contacts       *c        = s->contacts;
  PetscBool       needed   = PETSC_FALSE, solved;

  PetscFunctionBegin;
  s->predicted = PETSC_TRUE;
  for (PetscInt i = 0; i < c->n; i++) {
    needed = (PetscBool)(needed || (ContactSticks(c, i) && !c->closed[i]));
    ContactsLinearize(c, i);
    ContactsFinishLaw(c, i);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &needed, 1, MPI_PETSCBOOL, MPI_LOR, c->comm));
  if (!needed) PetscFunctionReturn(0);
  PetscCall(s->bodies->residual(s->bodies->data, c->f, NULL));
  PetscCall(s->bodies->prepare(s->bodies->data, c->D, c->S, &solved));
  if (solved) PetscCall(ContactsStep(c, s->bodies, accuracy, 0.0, s->du, s->df, &solved));
  for (PetscInt i = 0; i < c->n && solved; i++) {
    const PetscReal *u = &c->u[3 * i], *du = &s->du[3 * i], *from = &s->from[3 * i], closes = from[0] - u[0] - du[0];

    for (PetscInt a = 1; a < 3 && !c->closed[i] && closes > 0.0; a++)
      c->place[2 * i + a - 1] = from[a] + PetscClipInterval(from[0] / closes, 0.0, 1.0) * (u[a] + du[a] - from[a]);
  }
  PetscFunctionReturn(0);
}

/* Solves the laws of the normal components */
static PetscErrorCode StickSolve(ContactStick *s, PetscBool *solved)
{
  Contacts *c = s->contacts;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) {
    PetscCall(PetscArrayzero(&c->D[9 * i], 9));
    c->s[3 * i] = c->normal[i] ? -s->tension : 0.0;
    for (PetscInt a = 1; a < 3; a++) c->s[3 * i + a] = -c->f[3 * i + a];
    if (c->held[i]) ContactsSetNoSlip(c, i);
    ContactsFinishLaw(c, i);
  }
  PetscCall(s->bodies->residual(s->bodies->data, c->f, NULL));
  PetscCall(s->bodies->solve_normal(s->bodies->data, c->own, c->D, c->s, c->f, c->u, s->du, s->df, solved));
  if (!*solved) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < c->n; i++) {
    c->closed[i] = (PetscBool)(s->df[3 * i] > c->s[3 * i] - c->f[3 * i]);
    ContactsRemoveRigid(c, i, &s->du[3 * i]);
    for (PetscInt r = 3 * i; r < 3 * i + 3; r++) {
      c->u[r] += s->du[r];
      c->f[r] += s->df[r];
    }
    if (!c->closed[i]) c->f[3 * i] = c->s[3 * i];
  }
  PetscCall(s->bodies->advance(s->bodies->data, 1.0));
  PetscFunctionReturn(0);
}

/* Returns to the begin, and lets the load grow in parts */
static PetscErrorCode StickDivide(ContactStick *s)
{
  const PetscInt  parts = 8; /* three leaves: energy 3 % from that of 12 load steps; 11 % with 4 parts; 50 % without */
  const PetscReal small = 1e-6;
  Contacts       *c     = s->contacts;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) s->tension = PetscMax(s->tension, small * c->f[3 * i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &s->tension, 1, MPIU_REAL, MPIU_MAX, c->comm));
  PetscCall(PetscArraycpy(c->u, s->first, 3 * c->n));
  PetscCall(PetscArraycpy(c->f, s->first + 3 * c->n, 3 * c->n));
  PetscCall(PetscArrayzero(c->shift, 2 * c->n));
  PetscCall(s->bodies->keep(s->bodies->data, PETSC_TRUE));
  PetscCall(s->bodies->residual(s->bodies->data, c->f, NULL));
  PetscCall(StickClose(c, c->f, c->u));
  s->nparts = parts;
  PetscFunctionReturn(0);
}

/*
   Solves the laws of the normal components once, and updates what is held. *settled: whether nothing changed at the
   whole load; *solved: false if the laws were not solved
*/
PetscErrorCode StickIterate(ContactStick *s, PetscBool *settled, PetscBool *solved)
{
  PetscInt released, held;

  PetscFunctionBegin;
  *settled = PETSC_FALSE;
  if (!s->predicted) PetscCall(StickPredict(s));
  PetscCall(StickSolve(s, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(StickUpdate(s->contacts, &released, &held));
  if (released && s->nparts == 1 && s->divides) PetscCall(StickDivide(s));
  else if (released || held) PetscFunctionReturn(0);
  else if (s->part + 1 >= s->nparts) {
    *settled = (PetscBool)(s->whole || s->tension == 0.0);
    if (!s->whole) s->tension *= 1e-4;
    s->whole = PETSC_TRUE;
    PetscFunctionReturn(0);
  } else s->part++;
  PetscCall(s->bodies->load(s->bodies->data, (s->part + 1.0) / s->nparts));
  PetscCall(StickHold(s, s->contacts->u));
  PetscFunctionReturn(0);
}
