/*
   The path of contacts that stick while they are closed. Such contacts may have several states of equilibrium. The load
   decides which of them is reached: it grows from that of the begin, whose forces and motions are known, to the present
   one, and contacts open and close on the way.

   Along a step each contact keeps its state, so that forces and motions are linear in the load. The step ends where the
   first contact would be pulled or would penetrate. All contacts that change in the next small part of the load change
   together. A contact that closes sticks where it has closed. A contact that opens may still have a tangential force.
   This force vanishes at constant load, and the contact sticks where it is then, if it is closed.
*/
#include "frictionimpl.h"

/* Values of this size, relative to the largest force or motion, are rounding errors */
static const PetscReal rounding = 1e-10;

/* Sets the laws of a step. load: fraction of the distances to the laws that the step moves: 1, or 0 at constant load */
static void PathSetLaws(const ContactPath *p, PetscReal load)
{
  Contacts *c = p->contacts;

  for (PetscInt i = 0; i < c->n; i++) {
    PetscReal *D = &c->D[9 * i], *s = &c->s[3 * i];

    ContactsLinearize(c, i);
    if (c->closed[i]) s[0] *= load;
    if (c->law[i] == CONTACT_STICKS && p->slides[i]) {
      for (PetscInt k = 3; k < 9; k++) D[k] = 0.0;
      for (PetscInt a = 1; a < 3; a++) s[a] = -c->f[3 * i + a];
    } else
      for (PetscInt a = 1; a < 3; a++) s[a] *= load;
    ContactsHold(c, i);
  }
}

/* Returns the fraction of a step at which a contact is no longer pressed, or no longer open. Infinity: at no one */
static PetscReal PathEvent(const ContactPath *p, PetscInt i)
{
  const PetscInt   r     = 3 * i;
  const PetscBool  force = p->contacts->closed[i];
  const PetscReal *value = force ? p->contacts->f : p->contacts->u, *change = force ? p->df : p->du;

  if (!p->contacts->normal[i] || change[r] >= -rounding * p->size[!force]) return PETSC_INFINITY;
  return PetscMax(value[r], 0.0) / -change[r];
}

/* Measures forces and motions for tolerances */
static PetscErrorCode PathMeasure(ContactPath *p)
{
  const Contacts *c = p->contacts;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscInt r = 3 * i;

    if (!c->normal[i]) continue;
    p->size[0] = PetscMax(p->size[0], PetscAbsReal(c->f[r]) + PetscAbsReal(p->df[r]));
    p->size[1] = PetscMax(p->size[1], PetscAbsReal(c->u[r]) + PetscAbsReal(p->du[r]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, p->size, 2, MPIU_REAL, MPIU_MAX, c->comm));
  PetscFunctionReturn(0);
}

/* Moves the place from which a contact's slip is measured to where the contact is */
static void PathRefer(ContactPath *p, PetscInt i, const PetscReal place[2])
{
  for (PetscInt a = 0; a < 2; a++) {
    p->contacts->shift[2 * i + a] += place[a];
    p->contacts->u[3 * i + 1 + a] -= place[a];
  }
}

/* Changes the state of a contact at the end of a step of the given length. at: where on the step its event was */
static void PathChange(ContactPath *p, PetscInt i, PetscReal at, PetscReal length)
{
  Contacts        *c      = p->contacts;
  const PetscReal *u      = &c->u[3 * i], *f = &c->f[3 * i], *du = &p->du[3 * i], back = length - PetscMin(at, length),
                  place[2] = {u[1] - back * du[1], u[2] - back * du[2]};

  c->closed[i] = (PetscBool)!c->closed[i];
  if (c->law[i] != CONTACT_STICKS || c->coefficient[i] < 0.0) return;
  if (!c->closed[i]) p->slides[i] = (PetscBool)(PetscAbsReal(f[1]) + PetscAbsReal(f[2]) > rounding * p->size[0]);
  else if (!p->slides[i]) PathRefer(p, i, place);
}

/* Ends the step at constant load: what slid has no tangential force, and sticks where it is if it is closed */
static void PathSettle(ContactPath *p)
{
  Contacts *c = p->contacts;

  for (PetscInt i = 0; i < c->n; i++) {
    if (!p->slides[i]) continue;
    c->f[3 * i + 1] = c->f[3 * i + 2] = 0.0;
    if (c->closed[i]) PathRefer(p, i, &c->u[3 * i + 1]);
    p->slides[i] = PETSC_FALSE;
  }
}

/* Begins at the present forces and motions. Contacts with a force are closed, and those that touch. */
PetscErrorCode ContactPathBegin(Contacts *c, const ContactBodies *bodies, ContactPath *p)
{
  PetscFunctionBegin;
  *p = (ContactPath){.contacts = c, .bodies = bodies, .left = 1.0};
  PetscCall(PetscCalloc4(c->n, &p->slides, c->n, &p->event, 3 * c->n, &p->du, 3 * c->n, &p->df));
  for (PetscInt i = 0; i < c->n; i++)
    c->closed[i] = (PetscBool)(c->normal[i] && (c->f[3 * i] > 0.0 || c->u[3 * i] <= c->rounding));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactPathEnd(ContactPath *p)
{
  PetscFunctionBegin;
  PetscCall(PetscFree4(p->slides, p->event, p->du, p->df));
  PetscFunctionReturn(0);
}

/* Finds the event of each contact, and the length of the step: the fraction of its change that is taken */
static PetscErrorCode PathFindLength(ContactPath *p, PetscBool relaxes, PetscReal *length)
{
  const PetscReal together = 0.02; /* part of the load in which changes happen together: it bounds the number of steps */
  PetscReal       first    = PETSC_INFINITY;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < p->contacts->n; i++) {
    p->event[i] = PathEvent(p, i);
    first       = PetscMin(first, p->event[i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPIU_REAL, MPIU_MIN, p->contacts->comm));
  if (first <= rounding) *length = 0.0;
  else *length = PetscMin(1.0, relaxes ? first : PetscMax(first, together / p->left));
  PetscFunctionReturn(0);
}

/* Finds the first rank on which a contact changes */
static PetscErrorCode PathFirstRank(const ContactPath *p, PetscReal length, PetscMPIInt *first)
{
  PetscMPIInt rank, size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(p->contacts->comm, &rank));
  PetscCallMPI(MPI_Comm_size(p->contacts->comm, &size));
  *first = size;
  for (PetscInt i = 0; i < p->contacts->n; i++)
    if (p->event[i] <= length + rounding) *first = rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, first, 1, MPI_INT, MPI_MIN, p->contacts->comm));
  if (*first != rank) *first = -1;
  PetscFunctionReturn(0);
}

/*
   Changes the contacts whose events are on the step: all of them or, if the load has not grown in many steps, one of
   them. *n: their number on all ranks
*/
static PetscErrorCode PathChangeAll(ContactPath *p, PetscReal length, PetscInt *n)
{
  const PetscInt patience = 10;
  PetscMPIInt    mine     = 0;

  PetscFunctionBegin;
  *n = 0;
  if (p->nstill > patience) PetscCall(PathFirstRank(p, length, &mine));
  for (PetscInt i = 0; i < p->contacts->n && mine >= 0; i++) {
    if (p->event[i] > length + rounding) continue;
    PathChange(p, i, p->event[i], length);
    ++*n;
    if (p->nstill > patience) break;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 1, MPIU_INT, MPI_SUM, p->contacts->comm));
  PetscFunctionReturn(0);
}

/* Takes the fraction `length` of the step */
static PetscErrorCode PathAdvance(ContactPath *p, PetscBool relaxes, PetscReal length)
{
  Contacts *c = p->contacts;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < 3 * c->n; r++) {
    c->u[r] += length * p->du[r];
    c->f[r] += length * p->df[r];
  }
  PetscCall(p->bodies->advance(p->bodies->data, length));
  if (!relaxes) p->left *= 1.0 - length;
  p->nstill = length > 0.0 ? 0 : p->nstill + 1;
  PetscFunctionReturn(0);
}

/* Takes one step. *reached: whether the load has reached its end; *solved: false if the system was not solved */
PetscErrorCode ContactPathStep(ContactPath *p, PetscBool *reached, PetscBool *solved)
{
  const PetscReal accuracy = 1e-3; /* what the system leaves counts as load in the next step */
  PetscBool       relaxes  = PETSC_FALSE;
  PetscReal       sizes[2], length, load;
  PetscInt        n;

  PetscFunctionBegin;
  *reached = PETSC_FALSE;
  for (PetscInt i = 0; i < p->contacts->n; i++) relaxes = (PetscBool)(relaxes || p->slides[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &relaxes, 1, MPI_PETSCBOOL, MPI_LOR, p->contacts->comm));
  load = relaxes ? 0.0 : 1.0;
  PathSetLaws(p, load);
  PetscCall(p->bodies->residual(p->bodies->data, p->contacts->f, sizes));
  PetscCall(p->bodies->prepare(p->bodies->data, p->contacts->D, solved));
  if (*solved)
    PetscCall(ContactsStep(p->contacts, p->bodies, load, accuracy, 0.0, p->du, p->df, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(PathMeasure(p));
  PetscCall(PathFindLength(p, relaxes, &length));
  PetscCall(PathAdvance(p, relaxes, length));
  PetscCall(PathChangeAll(p, length, &n));
  PetscCall(PetscInfo(NULL, "Path of the load: %s, length %g, load left %g, contacts changed %" PetscInt_FMT "\n",
    relaxes ? "constant load" : "load grows", (double)length, (double)p->left, n));
  if (length == 1.0 && relaxes) PathSettle(p);
  *reached = (PetscBool)(length == 1.0 && !relaxes && !n);
  PetscFunctionReturn(0);
}
