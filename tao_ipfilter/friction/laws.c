/*
   The laws of constraints and norm terms on the subspace, friction among them. With w eliminated and f = (lambda,
   tau), v the motion of all rows,

     v = C f - RZ y - h,   T y + RZ^T f = t,   lambda >= 0, v_n >= 0, lambda v_n = 0,   tau = P(tau - rho v_t), P the
     projection to |tau| <= b(lambda),

   where R = [J; T], C = R K_WW^-1 R^T and RZ = R K_WW^-1 Q_W: which rows take part, how they move, and how far they
   are from their laws.
*/
#include "frictionimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPTermLawsDestroy(IPTermSet *set)
{
  PetscFunctionBegin;
  PetscCall(PetscFree4(set->limit, set->coefficient, set->rho, set->slope));
  PetscCall(PetscFree3(set->closed, set->slips, set->takes));
  PetscCall(PetscFree5(set->theta, set->way, set->dead, set->F, set->Fy));
  PetscCall(IPTermSystemDestroy(&set->system));
  PetscCall(PetscMemzero(set, sizeof(*set)));
  PetscFunctionReturn(0);
}

/* m constraints, all open, and n terms, all sticking, of rows R; K: K_WW, *definite is false where it is not positive
   definite */
PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPTermSet *set,
  PetscBool *definite)
{
  const PetscInt all = m + 2 * n;

  PetscFunctionBegin;
  PetscCall(IPTermLawsDestroy(set));
  set->m = m;
  set->n = n;
  PetscCall(PetscCalloc4(n, &set->limit, n, &set->coefficient, n, &set->rho, n, &set->slope));
  PetscCall(PetscCalloc3(m, &set->closed, n, &set->slips, all, &set->takes));
  PetscCall(PetscCalloc5(n, &set->theta, 2 * n, &set->way, 2 * n, &set->dead, all, &set->F, kmax, &set->Fy));
  PetscCall(IPTermSystemSetUp(&set->system, m, n, kmax, K, R, definite));
  PetscFunctionReturn(0);
}

PetscInt IPTermLawsRow(const IPTermSet *set, PetscInt term)
{
  return set->m + 2 * term;
}

/* Whether a term can have a force now */
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

/* v = C f - RZ y - h, into s->gap, and the size of its terms */
PetscErrorCode IPTermLawsMove(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(IPTermSystemApplyCompliance(&set->system, s->lambda, s->gap));
  for (PetscInt i = 0; i < s->m; i++) set->system.v[i] = -s->h[i];
  if (k && m)
    PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &minus, s->JZ, &m, s->y, &inc, &one, set->system.v, &inc));
  set->length = PetscMax(s->length, TermLawsLargest(s->m, set->system.v));
  for (PetscInt i = 0; i < s->m; i++) s->gap[i] += set->system.v[i];
  PetscFunctionReturn(0);
}

/* There are no forces along dead directions */
void IPTermLawsRelieve(const IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->n; i++) IPTermRemoveDead(&set->dead[2 * i], &s->lambda[IPTermLawsRow(set, i)]);
}

/* What gives way to a row, or most to the two of a term */
PetscReal IPTermLawsGiveWay(const IPTermSet *set, PetscInt row)
{
  const PetscReal *gives = set->system.gives;
  const PetscInt   first = row < set->m ? row : set->m + 2 * ((row - set->m) / 2);

  return PetscMax(gives[first], row < set->m ? 0.0 : gives[first + 1]);
}

/* The rows that take part, as far as anything gives way to them: closed constraints, and the terms that can have a
   force. The others have none. */
static void TermLawsList(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal rounding = 1e-14; /* of what gives way most: tangents have that of directions that are held */
  PetscReal       largest  = TermLawsLargest(s->m, set->system.gives);

  set->na = 0;
  for (PetscInt r = 0; r < s->m; r++) {
    const PetscBool wanted = r < set->m ? set->closed[r] : TermLawsTakePart(set, (r - set->m) / 2);

    set->takes[r] = (PetscBool)(wanted && IPTermLawsGiveWay(set, r) > (r < set->m ? 0.0 : rounding * largest));
    set->na += set->takes[r];
    if (!set->takes[r]) s->lambda[r] = 0.0;
  }
}

/* Force per length of the rows of a term, from what they give way by themselves */
void IPTermLawsResist(IPTermSet *set)
{
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal gives = IPTermLawsGiveWay(set, IPTermLawsRow(set, i));

    set->rho[i] = gives > 0.0 ? 1.0 / gives : 1.0;
  }
}

/* The motion of a term's two rows, without that along a dead direction */
void IPTermLawsMotion(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal v[2])
{
  for (PetscInt a = 0; a < 2; a++) v[a] = s->gap[IPTermLawsRow(set, i) + a];
  IPTermRemoveDead(&set->dead[2 * i], v);
}

/* b = tau - rho v of a term; its size */
PetscReal IPTermLawsTrial(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal b[2])
{
  PetscReal v[2];

  IPTermLawsMotion(set, s, i, v);
  for (PetscInt a = 0; a < 2; a++) b[a] = s->lambda[IPTermLawsRow(set, i) + a] - set->rho[i] * v[a];
  return PetscSqrtReal(b[0] * b[0] + b[1] * b[1]);
}

/* The term of a row, and which of its two it is; negative: a constraint's row */
PetscInt IPTermLawsOfRow(const IPTermSet *set, PetscInt row, PetscInt *component)
{
  if (row < set->m) return -1;
  *component = (row - set->m) % 2;
  return (row - set->m) / 2;
}

/* T y + RZ^T f - t */
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
  PetscCallBLAS("BLASgemv", BLASgemv_("T", &m, &k, &one, s->JZ, &m, s->lambda, &inc, &one, set->Fy, &inc));
  PetscFunctionReturn(0);
}

/* How far f and v are from the laws, an energy: the sum over all rows, constraints by min(lambda / rho, v), terms by
   |tau - P(tau - rho v)| / rho, squared times rho */
PetscReal IPTermLawsMerit(const IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal merit = 0.0;

  for (PetscInt i = 0; i < set->m; i++) {
    const PetscReal gives = set->system.gives[i],
                    off   = set->takes[i] ? PetscMin(s->lambda[i] * gives, s->gap[i]) : PetscMin(0.0, s->gap[i]);

    if (gives > 0.0) merit += PetscSqr(off) / gives;
  }
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal v[2];

    if (!set->takes[IPTermLawsRow(set, i)]) continue;
    IPTermLawsMotion(set, s, i, v);
    merit += set->rho[i] *
             PetscSqr(IPTermViolation(&s->lambda[IPTermLawsRow(set, i)], v, set->rho[i], IPTermLawsBound(set, s, i)));
  }
  return merit;
}

/* The rows that take part at f and y, and their v */
PetscErrorCode IPTermLawsRenew(IPTermSet *set, const IPReducedSystem *s)
{
  PetscFunctionBegin;
  TermLawsList(set, s);
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  set->listed = PETSC_TRUE;
  PetscFunctionReturn(0);
}
