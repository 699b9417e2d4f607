/*
   Laws of constraints and norm terms, e.g. friction, in the subspace. After elimination of w the forces f = (lambda,
   tau) and motions v of all rows satisfy
     v = C (f - base) - RZ y - h,  T y + RZ^T (f - base) = t,
     lambda >= 0,  v_n >= 0,  lambda v_n = 0,  tau = P(tau - rho v_t).
   P is the projection onto |tau| <= b(lambda), R = [J; T], C = R K_WW^-1 R^T, RZ = R K_WW^-1 Q_W. This file finds the
   active rows, computes the motions, and measures the violation of the laws.
*/
#include "frictionimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPTermLawsDestroy(IPTermSet *set)
{
  PetscFunctionBegin;
  PetscCall(PetscFree5(set->limit, set->coefficient, set->rho, set->slope, set->shift));
  PetscCall(PetscFree3(set->closed, set->slips, set->active));
  PetscCall(PetscFree5(set->theta, set->direction, set->rigid, set->F, set->Fy));
  PetscCall(IPTermSystemDestroy(&set->system));
  PetscCall(PetscMemzero(set, sizeof(*set)));
  PetscFunctionReturn(0);
}

/*
   Creates the state of m constraints, all open, and n terms, all sticking. R has the rows of both; K is K_WW, with
   its factors. *definite: false if K_WW is not positive definite.
*/
PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat factors, Mat R, IPTermSet *set,
  PetscBool *definite)
{
  const PetscInt all = m + 2 * n;

  PetscFunctionBegin;
  PetscCall(IPTermLawsDestroy(set));
  set->m = m;
  set->n = n;
  PetscCall(PetscCalloc5(n, &set->limit, n, &set->coefficient, n, &set->rho, n, &set->slope, 2 * n, &set->shift));
  PetscCall(PetscCalloc3(m, &set->closed, n, &set->slips, all, &set->active));
  PetscCall(PetscCalloc5(n, &set->theta, 2 * n, &set->direction, 2 * n, &set->rigid, all, &set->F, kmax, &set->Fy));
  PetscCall(IPTermSystemSetUp(&set->system, m, n, kmax, K, factors, R, definite));
  PetscFunctionReturn(0);
}

PetscInt IPTermLawsRow(const IPTermSet *set, PetscInt term)
{
  return set->m + 2 * term;
}

/* Returns whether term i can carry a force with its present bound */
static PetscBool TermLawsTakePart(const IPTermSet *set, PetscInt i)
{
  if (set->limit[i] == 0.0 || set->coefficient[i] == 0.0) return PETSC_FALSE;
  return (PetscBool)(set->coefficient[i] < 0.0 || set->closed[i]);
}

PetscReal IPTermLawsBound(const IPTermSet *set, const IPReducedSystem *s, PetscInt i)
{
  return IPTermBound(set->limit[i], set->coefficient[i], set->coefficient[i] < 0.0 ? 0.0 : s->lambda[i]);
}

static PetscReal TermLawsLargest(PetscInt n, const PetscReal a[])
{
  PetscReal largest = 0.0;

  for (PetscInt i = 0; i < n; i++) largest = PetscMax(largest, PetscAbsReal(a[i]));
  return largest;
}

/*
   Computes s->gap = v = C (f - base) - RZ y - h, and set->length, the size of its terms. With springs D in K_WW the sum
   e = f - base + D (v - start) of the present f and v is kept, and v = C e - RZ y - h, from which f follows.
*/
PetscErrorCode IPTermLawsMove(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  for (PetscInt i = 0; i < s->m; i++) set->system.f[i] = IPReducedForce(s, i);
  for (PetscInt i = 0; i < s->m && s->spring; i++) s->lambda[i] += s->spring[i] * s->gap[i];
  PetscCall(IPTermSystemApplyCompliance(&set->system, set->system.f, s->gap));
  for (PetscInt i = 0; i < s->m; i++) set->system.v[i] = -s->h[i];
  if (k && m)
    PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &minus, s->JZ, &m, s->y, &inc, &one, set->system.v, &inc));
  set->length = PetscMax(s->length, TermLawsLargest(s->m, set->system.v));
  for (PetscInt i = 0; i < s->m; i++) s->gap[i] += set->system.v[i];
  for (PetscInt i = 0; i < s->m && s->spring; i++) s->lambda[i] -= s->spring[i] * s->gap[i];
  PetscFunctionReturn(0);
}

/* Removes the components of the terms' forces along directions that cannot move */
void IPTermLawsRelieve(const IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->n; i++) IPTermRemoveRigid(&set->rigid[2 * i], &s->lambda[IPTermLawsRow(set, i)]);
}

/* Returns the compliance of a row [length/force]; for either row of a term it is the larger one of both */
PetscReal IPTermLawsCompliance(const IPTermSet *set, PetscInt row)
{
  const PetscReal *compliance = set->system.compliance;
  const PetscInt   first      = row < set->m ? row : set->m + 2 * ((row - set->m) / 2);

  return PetscMax(compliance[first], row < set->m ? 0.0 : compliance[first + 1]);
}

/*
   Returns the compliance up to which neither row of a term can move. Tangents along held directions have a compliance
   of the size of rounding errors.
*/
static PetscReal TermLawsHeld(const IPTermSet *set)
{
  const PetscReal rounding = 1e-14;

  return rounding * TermLawsLargest(set->system.m, set->system.compliance);
}

/* Lists the active rows: closed constraints, and terms that can carry a force. Rows without compliance are left out. */
void IPTermLawsList(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal held = TermLawsHeld(set);

  set->na = 0;
  for (PetscInt r = 0; r < s->m; r++) {
    const PetscBool wanted = r < set->m ? set->closed[r] : TermLawsTakePart(set, (r - set->m) / 2);

    set->active[r] = (PetscBool)(wanted && IPTermLawsCompliance(set, r) > (r < set->m ? 0.0 : held));
    set->na += set->active[r];
  }
  set->listed = PETSC_TRUE;
}

/* Sets rho of each term to the inverse of its compliance [force/length] */
void IPTermLawsResist(IPTermSet *set)
{
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal compliance = IPTermLawsCompliance(set, IPTermLawsRow(set, i));

    set->rho[i] = compliance > 0.0 ? 1.0 / compliance : 1.0;
  }
}

/* Gets the motion of a term's two rows, without the component along the direction that cannot move */
void IPTermLawsMotion(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal v[2])
{
  for (PetscInt a = 0; a < 2; a++) v[a] = s->gap[IPTermLawsRow(set, i) + a];
  IPTermRemoveRigid(&set->rigid[2 * i], v);
}

/* Computes b = tau - rho v of term i. Returns |b|. */
PetscReal IPTermLawsTrial(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal b[2])
{
  PetscReal v[2];

  IPTermLawsMotion(set, s, i, v);
  for (PetscInt a = 0; a < 2; a++) b[a] = s->lambda[IPTermLawsRow(set, i) + a] - set->rho[i] * v[a];
  return PetscSqrtReal(b[0] * b[0] + b[1] * b[1]);
}

/*
   Returns the term to which a row of the system belongs, and its component (0 or 1); -1 if the row is that of a
   constraint
*/
PetscInt IPTermLawsOfRow(const IPTermSet *set, PetscInt row, PetscInt *component)
{
  if (row < set->m) return -1;
  *component = (row - set->m) % 2;
  return (row - set->m) / 2;
}

/* Computes the residual of the directions' equations, Fy = T y + RZ^T (f - base) - t */
PetscErrorCode IPTermLawsResidualOfDirections(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, kmax, inc = 1;

  PetscFunctionBegin;
  if (!s->k) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(s->kmax, &kmax));
  PetscCall(PetscArraycpy(set->Fy, s->t, s->k));
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &k, &k, &one, s->T, &kmax, s->y, &inc, &minus, set->Fy, &inc));
  for (PetscInt i = 0; i < s->m; i++) set->system.f[i] = IPReducedForce(s, i);
  PetscCallBLAS("BLASgemv", BLASgemv_("T", &m, &k, &one, s->JZ, &m, set->system.f, &inc, &one, set->Fy, &inc));
  PetscFunctionReturn(0);
}

/*
   Returns the violation of the laws [energy]: the sum of rho r^2 over all rows, with r = min(lambda / rho, v) for
   constraints and r = |tau - P(tau - rho v)| / rho for terms. Rows without compliance are left out: no force changes
   their motion.
*/
PetscReal IPTermLawsMerit(const IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal held  = TermLawsHeld(set);
  PetscReal       merit = 0.0;

  for (PetscInt i = 0; i < set->m; i++) {
    const PetscReal compliance = set->system.compliance[i];

    if (compliance > 0.0) merit += PetscSqr(PetscMin(s->lambda[i] * compliance, s->gap[i])) / compliance;
  }
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal v[2];

    if (!(IPTermLawsCompliance(set, IPTermLawsRow(set, i)) > held)) continue;
    IPTermLawsMotion(set, s, i, v);
    merit += set->rho[i] *
             PetscSqr(IPTermViolation(&s->lambda[IPTermLawsRow(set, i)], v, set->rho[i], IPTermLawsBound(set, s, i)));
  }
  return merit;
}

/*
   Returns the residual that rounding errors cause: of forces that are large compared with their changes, and of gaps
   [square root of energy]
*/
PetscReal IPTermLawsRounding(const IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal exact = 1e-13;
  PetscReal       sum   = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    const PetscReal compliance = IPTermLawsCompliance(set, r);

    sum += PetscSqr(exact * s->lambda[r]) * compliance;
    if (compliance > 0.0 && set->active[r]) sum += PetscSqr(s->rounding) / compliance;
  }
  return PetscSqrtReal(sum);
}

/* Updates the list of active rows, sets the forces of all other rows to zero, and computes v */
PetscErrorCode IPTermLawsRenew(IPTermSet *set, const IPReducedSystem *s)
{
  PetscFunctionBegin;
  IPTermLawsList(set, s);
  for (PetscInt r = 0; r < s->m; r++) s->lambda[r] = set->active[r] ? s->lambda[r] : 0.0;
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}
