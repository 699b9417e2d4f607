/*
   The contacts of this rank and their laws: bounds of the tangential forces, and by how much forces and motions violate
   the laws
*/
#include "frictionimpl.h"
#include "tao_ipfilter/residuals/residualsimpl.h"

PetscErrorCode ContactsDestroy(Contacts *c)
{
  PetscFunctionBegin;
  PetscCall(PetscFree5(c->law, c->normal, c->closed, c->held, c->released));
  PetscCall(PetscFree5(c->coefficient, c->limit, c->rigid, c->f_start, c->u_start));
  PetscCall(PetscFree7(c->compliance, c->f, c->u, c->shift, c->place, c->D, c->s));
  PetscCall(PetscFree2(c->own, c->S));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/* Creates n contacts without friction and without forces */
PetscErrorCode ContactsCreate(MPI_Comm comm, PetscInt n, Contacts *c)
{
  PetscFunctionBegin;
  c->comm = comm;
  c->n    = n;
  PetscCall(PetscCalloc5(n, &c->law, n, &c->normal, n, &c->closed, n, &c->held, n, &c->released));
  PetscCall(PetscCalloc5(n, &c->coefficient, n, &c->limit, 2 * n, &c->rigid, 3 * n, &c->f_start, 3 * n, &c->u_start));
  PetscCall(PetscCalloc7(2 * n, &c->compliance, 3 * n, &c->f, 3 * n, &c->u, 2 * n, &c->shift, 2 * n, &c->place, 9 * n,
    &c->D, 3 * n, &c->s));
  PetscCall(PetscCalloc2(n, &c->own, 9 * n, &c->S));
  PetscFunctionReturn(0);
}

/*
   Sets the law of a contact's tangential force. coefficient: negative if the bound is the limit alone; infinite if the
   contact sticks while it is closed. Compliances must be set before.
*/
void ContactsSetLaw(Contacts *c, PetscInt i, PetscReal limit, PetscReal coefficient)
{
  const PetscBool limited = (PetscBool)(limit < PETSC_INFINITY);

  c->limit[i]       = limit;
  c->coefficient[i] = coefficient;
  if (limit == 0.0 || coefficient == 0.0 || !(c->compliance[2 * i + 1] > 0.0)) c->law[i] = CONTACT_SMOOTH;
  else if (coefficient < 0.0) c->law[i] = limited ? CONTACT_TRESCA : CONTACT_STICKS;
  else if (!c->normal[i]) c->law[i] = CONTACT_SMOOTH;
  else if (coefficient >= PETSC_INFINITY && !limited) c->law[i] = CONTACT_STICKS;
  else c->law[i] = limited ? CONTACT_LIMITED : CONTACT_COULOMB;
  c->held[i] = (PetscBool)(c->law[i] == CONTACT_STICKS && coefficient < 0.0);
}

/* Returns the largest tangential force of a contact for a normal force */
PetscReal ContactsBound(const Contacts *c, PetscInt i, PetscReal normal_force)
{
  if (c->law[i] == CONTACT_SMOOTH) return 0.0;
  if (c->law[i] == CONTACT_STICKS) return c->held[i] ? PETSC_INFINITY : 0.0;
  return IPTermBound(c->limit[i], c->coefficient[i], normal_force);
}

/* Removes the components of a contact's motion along the direction in which it cannot slip */
void ContactsRemoveRigid(const Contacts *c, PetscInt i, PetscReal u[3])
{
  IPTermRemoveRigid(&c->rigid[2 * i], u + 1);
}

/* Sets the linearized law of tangential components without slip: v = 0, by springs */
void ContactsSetNoSlip(const Contacts *c, PetscInt i)
{
  PetscReal *D = &c->D[9 * i], *S = &c->S[9 * i];

  for (PetscInt a = 1; a < 3; a++) {
    for (PetscInt b = 0; b < 3; b++) D[3 * a + b] = S[3 * a + b] = S[3 * b + a] = 0.0;
    D[4 * a] = S[4 * a] = 1.0 / (CONTACT_WEAK * c->compliance[2 * i + 1]);
    c->s[3 * i + a]     = -c->u[3 * i + a] * D[4 * a];
  }
}

/* Sets the normal force of a contact in its present position */
void ContactsSetForce(const Contacts *c, PetscInt i, PetscReal normal_force)
{
  c->u[3 * i] += c->own[i] * (normal_force - c->f[3 * i]);
  c->f[3 * i] = normal_force;
}

/* Projects the matrix of a contact's law such that it leaves out the direction in which the contact cannot slip */
static void ContactsProject(const Contacts *c, PetscInt i, PetscReal D[9])
{
  const PetscReal *rigid = &c->rigid[2 * i];

  if (rigid[0] == 0.0 && rigid[1] == 0.0) return;
  for (PetscInt r = 0; r < 3; r++) ContactsRemoveRigid(c, i, D + 3 * r);
  for (PetscInt k = 0; k < 3; k++) {
    PetscReal column[3] = {D[k], D[3 + k], D[6 + k]};

    ContactsRemoveRigid(c, i, column);
    for (PetscInt r = 0; r < 3; r++) D[3 * r + k] = column[r];
  }
}

/*
   Finishes the linearized law df = s - D du of a contact. The components of D and s in the direction in which the
   contact cannot slip are removed. D and s then become those of the law in series with the compliance of the contact
   itself, so that du is replaced by the motion R dx of the bodies. With du = R dx + own df_n e_n the law is
   df = (I + own D e_n e_n^T)^-1 (s - D R dx).
*/
void ContactsFinishLaw(const Contacts *c, PetscInt i)
{
  PetscReal *const matrices[] = {&c->D[9 * i], &c->S[9 * i]};
  PetscReal       *s = &c->s[3 * i], normal[3], force = s[0];

  ContactsRemoveRigid(c, i, s);
  for (PetscInt m = 0; m < 2; m++) {
    PetscReal *D = matrices[m];

    ContactsProject(c, i, D);
    for (PetscInt k = 0; k < 3; k++) normal[k] = D[k];
    for (PetscInt r = 0; r < 3 && c->own[i] > 0.0; r++) {
      const PetscReal part = c->own[i] * D[3 * r] / (1.0 + c->own[i] * normal[0]);

      for (PetscInt k = 0; k < 3; k++) D[3 * r + k] -= part * normal[k];
      if (!m) s[r] -= part * force;
    }
  }
}

/* Returns by how much a violation [length] exceeds the rounding errors of a gap and of a force */
static PetscReal ContactsExcess(const Contacts *c, PetscReal violation, PetscReal force, PetscReal compliance)
{
  const PetscReal exact = 1e-13; /* rounding errors of forces that are much larger than their changes */

  return PetscMax(PetscAbsReal(violation) - exact * PetscAbsReal(force) * compliance - c->rounding, 0.0);
}

/*
   Computes the violation of the laws by forces and motions [square root of energy]: rho r^2 is summed over all
   contacts, with the stiffness rho, r = min(f / rho, u) for the normal component and r = |tau - P(tau - rho v)| /
   rho for the tangential ones, where P projects onto |tau| <= b. From each r its rounding errors are subtracted: the
   KKT error has the largest one of all contacts, which a sum of theirs would not limit.
*/
PetscErrorCode ContactsViolation(const Contacts *c, const PetscReal force[], const PetscReal motion[],
  PetscReal *violation)
{
  PetscFunctionBegin;
  *violation = 0.0;
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscReal *f = &force[3 * i], *u = &motion[3 * i], *compliance = &c->compliance[2 * i];

    if (c->normal[i])
      *violation +=
        PetscSqr(ContactsExcess(c, PetscMin(f[0] * compliance[0], u[0]), f[0], compliance[0])) / compliance[0];
    if (c->law[i] != CONTACT_SMOOTH) {
      const PetscReal rho = 1.0 / compliance[1];

      *violation += rho * PetscSqr(ContactsExcess(c, IPTermViolation(f + 1, u + 1, rho, ContactsBound(c, i, f[0])),
                            PetscSqrtReal(f[1] * f[1] + f[2] * f[2]), compliance[1]));
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, violation, 1, MPIU_REAL, MPIU_SUM, c->comm));
  *violation = PetscSqrtReal(*violation);
  PetscFunctionReturn(0);
}

/* Returns the square root of the sum of squares of motions, each divided by its compliance [square root of energy] */
PetscErrorCode ContactsNorm(const Contacts *c, const PetscReal du[], PetscReal *norm)
{
  PetscFunctionBegin;
  *norm = 0.0;
  for (PetscInt i = 0; i < c->n; i++) {
    const PetscReal *d = &du[3 * i], *compliance = &c->compliance[2 * i];

    if (c->normal[i]) *norm += d[0] * d[0] / compliance[0];
    if (c->law[i] != CONTACT_SMOOTH) *norm += (d[1] * d[1] + d[2] * d[2]) / compliance[1];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, norm, 1, MPIU_REAL, MPIU_SUM, c->comm));
  *norm = PetscSqrtReal(*norm);
  PetscFunctionReturn(0);
}

/*
   Solves the bodies' equations with the linearized laws df = s - D du in place of the laws. du, df: changes of motions
   and forces; fraction, target: accuracy of the solve, see ContactBodies
*/
PetscErrorCode ContactsStep(Contacts *c, const ContactBodies *bodies, PetscReal fraction, PetscReal target,
  PetscReal du[], PetscReal df[], PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(bodies->solve(bodies->data, c->s, fraction, target, du, solved));
  if (!*solved) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < c->n; i++) {
    ContactsRemoveRigid(c, i, &du[3 * i]);
    ConeMultiply(&c->D[9 * i], &du[3 * i], &df[3 * i]);
    for (PetscInt r = 3 * i; r < 3 * i + 3; r++) df[r] = c->s[r] - df[r];
    du[3 * i] += c->own[i] * df[3 * i];
  }
  PetscFunctionReturn(0);
}
