/*
   Implements the interface IPLawsOps of the subspace method: the contacts of the optimizer's constraints and norm
   terms, and the bodies of its Hessian
*/
#include "frictionimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/terms.h"

struct _p_IPLaws {
  Tao              tao;
  PetscInt         m, nterms; /* numbers of constraints and of norm terms on this rank */
  Contacts         contacts;
  SubspaceBodies   bodies;
  ContactIteration iteration;
};

static PetscErrorCode LawsDestroy(IPLaws *laws)
{
  PetscFunctionBegin;
  if (!*laws) PetscFunctionReturn(0);
  PetscCall(ContactIterationEnd(&(*laws)->iteration));
  PetscCall(ContactsDestroy(&(*laws)->contacts));
  PetscCall(SubspaceBodiesDestroy(&(*laws)->bodies));
  PetscCall(PetscFree(*laws));
  PetscFunctionReturn(0);
}

/* Adds the compliance of the constraints themselves to those of the contacts */
static PetscErrorCode LawsAddCompliance(IPLaws laws)
{
  const Vec          own = ((TAO_IPFILTER *)laws->tao->data)->sides->compliance;
  const PetscScalar *a;

  PetscFunctionBegin;
  if (!own) PetscFunctionReturn(0);
  PetscCall(VecGetArrayRead(own, &a));
  for (PetscInt i = 0; i < laws->m; i++) {
    laws->contacts.own[i] = PetscRealPart(a[i]);
    laws->contacts.compliance[2 * i] += PetscRealPart(a[i]);
  }
  PetscCall(VecRestoreArrayRead(own, &a));
  PetscFunctionReturn(0);
}

/* Finds which components of contacts some unknown moves. The compliance of the others is a rounding error. */
static PetscErrorCode LawsFindMoved(IPLaws laws)
{
  const PetscReal rounding = 1e-14; /* compliance of a component that is held, relative to the largest one */
  Contacts       *c        = &laws->contacts;
  PetscReal       largest  = 0.0;

  PetscFunctionBegin;
  PetscCall(SubspaceBodiesGetCompliance(laws->bodies, c->n, c->compliance));
  for (PetscInt i = 0; i < 2 * c->n; i++) largest = PetscMax(largest, c->compliance[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, c->comm));
  for (PetscInt i = 0; i < 2 * c->n; i++)
    if (c->compliance[i] <= rounding * largest) c->compliance[i] = 0.0;
  PetscCall(LawsAddCompliance(laws));
  for (PetscInt i = 0; i < laws->m; i++) c->normal[i] = (PetscBool)(c->compliance[2 * i] > 0.0);
  PetscFunctionReturn(0);
}

/* Sets the laws of the norm terms. Coefficients are those of unscaled constraints. */
static PetscErrorCode LawsSetTerms(IPLaws laws)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)laws->tao->data;
  const IPTerms     *terms = ip->terms;
  const PetscScalar *limit = NULL, *coefficient = NULL, *scale = NULL, *rigid;

  PetscFunctionBegin;
  if (terms->limit) PetscCall(VecGetArrayRead(terms->limit, &limit));
  if (terms->coefficient) PetscCall(VecGetArrayRead(terms->coefficient, &coefficient));
  if (ip->rows->inequality) PetscCall(VecGetArrayRead(ip->rows->inequality, &scale));
  PetscCall(VecGetArrayRead(terms->rigid, &rigid));
  PetscCall(PetscArraycpy(laws->contacts.rigid, rigid, 2 * laws->nterms));
  for (PetscInt i = 0; i < laws->nterms; i++) {
    const PetscReal factor = scale && coefficient ? PetscRealPart(scale[i]) : 1.0;

    ContactsSetLaw(&laws->contacts, i, limit ? PetscRealPart(limit[i]) : PETSC_INFINITY,
      coefficient ? factor * PetscRealPart(coefficient[i]) : -1.0);
  }
  PetscCall(VecRestoreArrayRead(terms->rigid, &rigid));
  if (ip->rows->inequality) PetscCall(VecRestoreArrayRead(ip->rows->inequality, &scale));
  if (terms->coefficient) PetscCall(VecRestoreArrayRead(terms->coefficient, &coefficient));
  if (terms->limit) PetscCall(VecRestoreArrayRead(terms->limit, &limit));
  PetscFunctionReturn(0);
}

static PetscErrorCode LawsCreate(Tao tao, IPRecycle *recycle, IS W, IPLaws *laws)
{
  const TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscInt            n;

  PetscFunctionBegin;
  PetscCall(PetscNew(laws));
  (*laws)->tao = tao;
  PetscCall(VecGetLocalSize(ip->at.c, &(*laws)->m));
  PetscCall(VecGetLocalSize(ip->terms->rho, &(*laws)->nterms));
  n = PetscMax((*laws)->m, (*laws)->nterms);
  PetscCall(ContactsCreate(PetscObjectComm((PetscObject)tao), n, &(*laws)->contacts));
  PetscCall(SubspaceBodiesCreate(tao, recycle, W, n, &(*laws)->bodies));
  PetscCall(LawsFindMoved(*laws));
  PetscCall(LawsSetTerms(*laws));
  PetscFunctionReturn(0);
}

/* Copies the entries of a vector for constraints and one for norm terms to the components of contacts, or back */
static PetscErrorCode LawsCopy(IPLaws laws, Vec constraints, Vec terms, PetscReal components[], PetscBool back)
{
  PetscScalar *normal, *tangential;

  PetscFunctionBegin;
  PetscCall(VecGetArray(constraints, &normal));
  PetscCall(VecGetArray(terms, &tangential));
  for (PetscInt i = 0; i < laws->contacts.n; i++) {
    for (PetscInt a = 0; a < 3; a++) {
      const PetscBool has   = (PetscBool)(a ? i < laws->nterms : i < laws->m);
      PetscScalar    *entry = a ? &tangential[2 * i + a - 1] : &normal[i];

      if (has && back) *entry = components[3 * i + a];
      else if (!back) components[3 * i + a] = has ? PetscRealPart(*entry) : 0.0;
    }
  }
  PetscCall(VecRestoreArray(terms, &tangential));
  PetscCall(VecRestoreArray(constraints, &normal));
  PetscFunctionReturn(0);
}

/*
   Begins at a point with the gradient g, the constraint values c and the values of norm terms; force, terms: forces of
   both there. Contacts with forces below the accuracy of a solve count as open: friction does not hold them.
*/
static PetscErrorCode LawsBegin(IPLaws laws, Vec g, Vec c, Vec values, Vec force, Vec terms)
{
  const PetscReal     accuracy = 1e-8;
  const TAO_IPFILTER *ip       = (TAO_IPFILTER *)laws->tao->data;
  Contacts           *contacts = &laws->contacts;

  PetscFunctionBegin;
  PetscCall(SubspaceBodiesCentre(laws->bodies, g));
  contacts->rounding = ip->first->jacobian * ip->given->rounding;
  contacts->least    = accuracy * IPErrorBoundForceUnit(ip);
  PetscCall(LawsCopy(laws, c, values, contacts->u, PETSC_FALSE));
  PetscCall(LawsCopy(laws, force, terms, contacts->f, PETSC_FALSE));
  PetscCall(LawsCopy(laws, IPSubspaceOf(laws->tao)->start_c, IPSubspaceOf(laws->tao)->start_values, contacts->u_start,
    PETSC_FALSE));
  PetscCall(LawsCopy(laws, IPSubspaceOf(laws->tao)->start_force, terms, contacts->f_start, PETSC_FALSE));
  for (PetscInt i = 0; i < contacts->n; i++) {
    ContactsRemoveRigid(contacts, i, &contacts->u[3 * i]);
    ContactsRemoveRigid(contacts, i, &contacts->f[3 * i]);
    if (!contacts->normal[i]) contacts->f[3 * i] = 0.0;
    if (contacts->law[i] == CONTACT_SMOOTH) contacts->f[3 * i + 1] = contacts->f[3 * i + 2] = 0.0;
    contacts->u[3 * i] += contacts->own[i] * contacts->f[3 * i];
    contacts->u_start[3 * i] += contacts->own[i] * contacts->f_start[3 * i];
  }
  PetscCall(ContactIterationBegin(contacts, SubspaceBodiesInterface(laws->bodies),
    (PetscBool)!IPSubspaceOf(laws->tao)->newton, &laws->iteration));
  PetscFunctionReturn(0);
}

/* Moves the offsets of norm terms with the places from which the slips of contacts are measured */
static PetscErrorCode LawsMoveOffsets(IPLaws laws)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)laws->tao->data;
  PetscScalar  *t;

  PetscFunctionBegin;
  PetscCall(VecGetArray(ip->terms->t, &t));
  for (PetscInt k = 0; k < 2 * laws->nterms; k++) t[k] -= laws->contacts.shift[k];
  PetscCall(VecRestoreArray(ip->terms->t, &t));
  PetscCall(PetscArrayzero(laws->contacts.shift, 2 * laws->contacts.n));
  PetscFunctionReturn(0);
}

/*
   Takes one step. x: the point, relative to the begin; force, terms: forces there. violation: of the laws, relative
   to the first step; nclosed: number of closed contacts; enough: residual [2-norm] at which directions are no longer
   added. *done: false if no progress is possible
*/
static PetscErrorCode LawsStep(IPLaws laws, PetscReal enough, Vec x, Vec force, Vec terms, PetscReal *violation,
  PetscInt *nclosed, PetscBool *done)
{
  PetscFunctionBegin;
  SubspaceBodiesSetEnough(laws->bodies, enough);
  PetscCall(ContactIterate(&laws->iteration, done));
  *violation = laws->iteration.violation;
  if (*violation < PETSC_INFINITY) {
    PetscCall(VecCopy(SubspaceBodiesGet(laws->bodies), x));
    PetscCall(LawsCopy(laws, force, terms, laws->contacts.f, PETSC_TRUE));
    PetscCall(LawsMoveOffsets(laws));
  }
  *nclosed = 0;
  for (PetscInt i = 0; i < laws->m; i++) *nclosed += laws->contacts.f[3 * i] > 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, nclosed, 1, MPIU_INT, MPI_SUM, laws->contacts.comm));
  PetscFunctionReturn(0);
}

const IPLawsOps IPLawsFriction = {
  .create  = LawsCreate,
  .begin   = LawsBegin,
  .step    = LawsStep,
  .destroy = LawsDestroy,
};
