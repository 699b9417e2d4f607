/*
   The iteration for the laws of all contacts: Newton's method from the present state or, if that makes no progress, the
   interior point method from a cold start, and Newton's method from its end. Contacts that stick while they are closed
   are held or released each time the other laws are solved.
*/
#include "frictionimpl.h"

/* Copies the state of contacts and bodies to a second place, or from there if `back` */
static PetscErrorCode IterationKeep(ContactIteration *it, PetscBool back)
{
  const Contacts *c = it->contacts;
  const size_t    n = 3 * (size_t)c->n;

  PetscFunctionBegin;
  PetscCall(PetscArraycpy(back ? c->f : it->kept, back ? it->kept : c->f, n));
  PetscCall(PetscArraycpy(back ? c->u : it->kept + n, back ? it->kept + n : c->u, n));
  PetscCall(it->bodies.keep(it->bodies.data, back));
  PetscFunctionReturn(0);
}

/* Enters Newton's method, before or after the interior point method */
static PetscErrorCode IterationEnterNewton(ContactIteration *it, ContactPhase phase)
{
  PetscFunctionBegin;
  it->phase  = phase;
  it->nsteps = it->nfutile = 0;
  it->best                 = PETSC_INFINITY;
  ContactsGuessStates(it->contacts, (PetscBool)(phase == CONTACT_LAST));
  PetscCall(IterationKeep(it, PETSC_FALSE));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactIterationEnd(ContactIteration *it)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(it->kept));
  PetscCall(StickEnd(&it->stick));
  PetscCall(ConesDestroy(&it->cones));
  PetscCall(PetscMemzero(it, sizeof(*it)));
  PetscFunctionReturn(0);
}

/* Updates which contacts are held. If this changes the laws, Newton's method starts again. */
static PetscErrorCode IterationUpdateHeld(ContactIteration *it)
{
  PetscInt released, held;

  PetscFunctionBegin;
  PetscCall(StickUpdate(it->contacts, &released, &held));
  if (!released && !held) PetscFunctionReturn(0);
  PetscCall(ConesDestroy(&it->cones));
  it->violation = PETSC_INFINITY;
  PetscCall(IterationEnterNewton(it, CONTACT_WARM));
  PetscFunctionReturn(0);
}

/* Solves the laws of the normal components once while contacts that stick are held. A violation that does not fall is a
   rounding error. */
static PetscErrorCode IterationStick(ContactIteration *it, PetscBool *done)
{
  const PetscInt most = 1000;
  Contacts      *c    = it->contacts;
  PetscReal      before, change = 0.0, violation;
  PetscBool      settled;

  PetscFunctionBegin;
  PetscCall(ContactsViolation(c, c->f, c->u, &before));
  PetscCall(StickIterate(&it->stick, &settled, done));
  if (*done) PetscCall(ContactsNorm(c, it->stick.du, &change));
  it->size      = PetscMax(it->size, PetscMax(before, change));
  it->violation = PETSC_INFINITY;
  if (settled) {
    PetscCall(ContactsViolation(c, c->f, c->u, &violation));
    it->violation = violation > 0.0 && violation <= 0.5 * it->best ? violation / it->size : 0.0;
    it->best      = violation;
  }
  it->nsteps = settled ? 0 : it->nsteps + 1;
  if (it->nsteps > most) *done = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Chooses among the forces of equilibrium where they are not determined, the first time that the laws are solved.
   Newton's method then solves the laws again, which the chosen forces fulfil almost.
*/
static PetscErrorCode IterationChoose(ContactIteration *it)
{
  PetscFunctionBegin;
  if (it->chosen) {
    it->keeps = PETSC_FALSE;
    PetscFunctionReturn(0);
  }
  it->chosen = PETSC_TRUE;
  PetscCall(IterationKeep(it, PETSC_FALSE));
  PetscCall(ContactsChoose(it->contacts, &it->bodies, &it->keeps));
  if (it->keeps) it->violation = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/*
   Takes one Newton step. *done: false if three steps in a row did not reduce the merit to 0.7 of the smallest one, or
   after twelve steps, although the violation of the laws is more than rounding errors. If forces were chosen that do
   not become a solution, the ones before are taken.
*/
static PetscErrorCode IterationNewton(ContactIteration *it, PetscBool *done)
{
  const PetscInt  patience = 3, most = 12;
  const PetscReal exact = 1e-9, /* violation that counts as none, relative to its size at the start */
    known               = 1e-6; /* violation at which forces are chosen */
  PetscReal before, violation, change, merit;

  PetscFunctionBegin;
  PetscCall(ContactsViolation(it->contacts, it->contacts->f, it->contacts->u, &before));
  PetscCall(ContactsNewtonStep(it->contacts, &it->bodies, &merit, &change, done));
  if (!*done) PetscFunctionReturn(0);
  if (it->size == 0.0) it->size = PetscMax(before, change);
  PetscCall(ContactsViolation(it->contacts, it->contacts->f, it->contacts->u, &violation));
  PetscCall(PetscInfo(NULL, "Newton: merit %g, violation %g, size %g, change %g\n", (double)merit, (double)violation,
    (double)it->size, (double)change));
  it->violation = violation > 0.0 ? violation / it->size : 0.0;
  if (violation <= (it->chosen || it->sticks ? exact : known) * it->size) {
    it->nsteps = it->nfutile = 0;
    it->best                 = PETSC_INFINITY; /* a next step is for a smaller residual of the bodies */
    if (it->sticks) PetscCall(IterationUpdateHeld(it));
    else PetscCall(IterationChoose(it));
    PetscFunctionReturn(0);
  }
  it->nfutile = merit <= 0.7 * it->best ? 0 : it->nfutile + 1;
  it->best    = PetscMin(it->best, merit);
  *done       = (PetscBool)(!PetscIsInfOrNanReal(merit) && it->nfutile < patience && ++it->nsteps < most);
  if (!*done && it->keeps) {
    PetscCall(IterationKeep(it, PETSC_TRUE));
    it->keeps     = PETSC_FALSE;
    it->violation = 0.0;
    *done         = PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}

/* Sets the size of the problem to that of the change of motions since the cold start */
static PetscErrorCode IterationMeasure(ContactIteration *it)
{
  const Contacts  *c     = it->contacts;
  const PetscReal *start = it->kept + 3 * (size_t)c->n;
  PetscReal       *change;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(3 * c->n, &change));
  for (PetscInt r = 0; r < 3 * c->n; r++) change[r] = c->u[r] - start[r];
  PetscCall(ContactsNorm(c, change, &it->size));
  PetscCall(PetscFree(change));
  PetscFunctionReturn(0);
}

/*
   Takes one step of the interior point method, or of Newton's method if the error is below it->known, or if it is small
   and the cones leave no room for a step
*/
static PetscErrorCode IterationCones(ContactIteration *it, PetscBool *done)
{
  const PetscInt  most = 60;
  const PetscReal near = 1e-2;
  PetscReal       error;

  PetscFunctionBegin;
  PetscCall(ConesIterate(it->cones, it->known, &error, done));
  it->violation = PETSC_INFINITY;              /* iterates inside the cones belong to no state of a contact */
  if (!*done && error < near) it->known = 0.0; /* the last attempt */
  else if (!*done || !(error < it->known)) {
    if (++it->nsteps > most) *done = PETSC_FALSE;
    PetscFunctionReturn(0);
  }
  if (it->size == 0.0) PetscCall(IterationMeasure(it));
  PetscCall(IterationEnterNewton(it, CONTACT_LAST));
  PetscCall(IterationNewton(it, done));
  PetscFunctionReturn(0);
}

/* Returns from Newton's method to the interior point method, since the states of some contacts were not known yet */
static PetscErrorCode IterationReturn(ContactIteration *it, PetscBool *done)
{
  const PetscReal closer = 0.1,
                  last   = 1e-6; /* error: by which factor it is reduced; below it, rounding errors decide */

  PetscFunctionBegin;
  PetscCall(IterationKeep(it, PETSC_TRUE));
  it->known *= closer;
  it->phase  = CONTACT_CONES;
  it->nsteps = 0;
  *done      = (PetscBool)(it->known >= last);
  if (*done) PetscCall(IterationCones(it, done));
  PetscFunctionReturn(0);
}

/* Enters the interior point method at the state before Newton's method */
static PetscErrorCode IterationEnterCones(ContactIteration *it, PetscBool *done)
{
  PetscFunctionBegin;
  PetscCall(IterationKeep(it, PETSC_TRUE));
  it->phase  = CONTACT_CONES;
  it->nsteps = 0;
  it->known  = 1e-4; /* most states are known then; IterationReturn() is for the others */
  PetscCall(ConesCreate(it->contacts, &it->bodies, &it->cones));
  PetscCall(ConesStart(it->cones, done));
  if (*done) PetscCall(IterationCones(it, done));
  PetscFunctionReturn(0);
}

/*
   Takes the first step from a cold start: that of Newton's method with all contacts open, if bodies without contact
   have an equilibrium; or, if this is not the solution, one of the interior point method
*/
static PetscErrorCode IterationStart(ContactIteration *it, PetscBool *done)
{
  PetscFunctionBegin;
  it->cold = PETSC_FALSE;
  *done    = it->bodies.definite;
  if (*done) PetscCall(IterationNewton(it, done));
  if (!*done || it->violation > 0.0) PetscCall(IterationEnterCones(it, done));
  PetscFunctionReturn(0);
}

/* Begins the iteration at the present state of contacts and bodies. Without any force it is a cold start. linear:
   whether the bodies are linear in the whole solve, and not in one model of Newton's method */
PetscErrorCode ContactIterationBegin(Contacts *c, ContactBodies bodies, PetscBool linear, ContactIteration *it)
{
  PetscReal largest = 0.0;
  PetscBool exact;

  PetscFunctionBegin;
  PetscCall(ContactIterationEnd(it));
  it->contacts = c;
  it->bodies   = bodies;
  PetscCall(PetscMalloc1(6 * c->n, &it->kept));
  PetscCall(IterationEnterNewton(it, CONTACT_WARM));
  for (PetscInt r = 0; r < 3 * c->n; r++) largest = PetscMax(largest, PetscAbsReal(c->f[r]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, c->comm));
  it->cold = (PetscBool)(largest == 0.0);
  PetscCall(ContactsHaveHeld(c, &it->sticks, &exact));
  if (!it->sticks) PetscFunctionReturn(0);
  PetscCall(StickBegin(c, &it->bodies, linear, &it->stick));
  if (exact) it->phase = CONTACT_HELD;
  PetscFunctionReturn(0);
}

/*
   Takes one step. it->violation: by how much the laws are violated, relative to the first step. *done: false if no
   method makes progress. The state is then the best that was reached.
*/
PetscErrorCode ContactIterate(ContactIteration *it, PetscBool *done)
{
  PetscFunctionBegin;
  PetscCall(it->bodies.interrupted(it->bodies.data, done));
  *done = (PetscBool) !*done;
  if (!*done) PetscFunctionReturn(0);
  if (it->phase == CONTACT_HELD) PetscCall(IterationStick(it, done));
  else if (it->phase == CONTACT_CONES) PetscCall(IterationCones(it, done));
  else if (it->cold) PetscCall(IterationStart(it, done));
  else {
    PetscCall(IterationNewton(it, done));
    if (!*done && it->phase == CONTACT_WARM) PetscCall(IterationEnterCones(it, done));
    else if (!*done) PetscCall(IterationReturn(it, done));
  }
  PetscFunctionReturn(0);
}
