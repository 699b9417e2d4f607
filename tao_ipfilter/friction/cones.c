/*
   Contact with Coulomb's friction by an interior point method on second-order cones, from a cold start.

   With the gap u_n, the slip u_t and the coefficient m, Coulomb's law is that y = (u_n + m |u_t|, m u_t) and f =
   (r_n, r_t / m) are in the cone {(a, b): |b| <= a} and y^T f = 0 (De Saxce and Feng, The bipotential method, 1998).
   For a fixed m |u_t| this is a convex problem (Acary, Cadoux, Lemarechal and Malick, A formulation of the linear
   discrete Coulomb friction problem via convex optimization, 2011). The method takes m |u_t| and its derivative from
   the iterate (Acary, Armand and Nguyen, High-accuracy computation of rolling friction contact problems, 2023).

   A contact without friction has the cone y >= 0, f >= 0. A limit L of the tangential force adds a slider in series:
   its slip z_t and the force (L, r_t) are in a cone of their own, whose first component is constant.

   Each cone has a Nesterov-Todd scaling, so that a contact's linearized laws are df = s - D du with a 3 x 3 block D.
   Steps are those of Mehrotra's predictor and corrector. Motions are multiplied by the square root of the contact's
   stiffness, and forces divided by it, so that units do not matter.
*/
#include "frictionimpl.h"

/* One contact in scaled components */
typedef struct {
  PetscInt  n;        /* dimension of the cone of y and f: 3, 1 without friction or with a limit alone, 0 */
  PetscBool limited;  /* whether there is a cone of z and (limit, f_t) */
  PetscReal scale[2]; /* scaled by unscaled motions: normal and tangential */
  PetscReal y[3], f[3], z[3], limit;
  PetscReal W[9], Wi[9], V[9]; /* scalings of y and f, with the inverse; and of z and (limit, f_t) */
  PetscReal ry[3], rz[2];      /* residuals of the equations of motions */
  PetscReal e[2];              /* derivative of |slip| */
  PetscReal p[3], pz[3];       /* right-hand sides of the scaled complementarity conditions */
  PetscReal dy[3], df[3], dz[3];
} Cone;

/* The iterate */
struct _p_Cones {
  Contacts            *c;
  const ContactBodies *bodies;
  Cone                *cone;
  PetscReal           *du, *df;       /* changes of unscaled motions and forces */
  PetscReal            length, force; /* sizes of scaled motions and forces [square root of energy] */
  PetscReal            count;         /* number of cones on all ranks */
};

static PetscErrorCode ConesSum(const Cones s, PetscReal *sum)
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 1, MPIU_REAL, MPIU_SUM, s->c->comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConesMax(const Cones s, PetscReal *largest)
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPIU_MAX, s->c->comm));
  PetscFunctionReturn(0);
}

/* Sets the kinds and scales of a contact's cones */
static void ConeSetKind(const Contacts *c, PetscInt i, Cone *k)
{
  const PetscReal  most       = 10.0; /* coefficient that stands for larger ones, whose scales differ too much */
  const PetscReal *compliance = &c->compliance[2 * i];
  const ContactLaw law        = c->law[i];
  const PetscBool  coulomb    = (PetscBool)(law == CONTACT_COULOMB || law == CONTACT_LIMITED);

  k->n        = coulomb ? 3 : c->normal[i] ? 1 : 0;
  k->limited  = (PetscBool)(law == CONTACT_LIMITED || law == CONTACT_TRESCA);
  k->scale[0] = c->normal[i] ? 1.0 / PetscSqrtReal(compliance[0]) : 0.0;
  k->scale[1] = coulomb                    ? PetscMin(c->coefficient[i], most) * k->scale[0]
                : k->limited || c->held[i] ? 1.0 / PetscSqrtReal(compliance[1])
                                           : 0.0;
  k->limit    = k->limited ? c->limit[i] / k->scale[1] : 0.0;
}

/* Gets the scaled motions of a contact from the unscaled ones */
static void ConeScale(const Cone *k, const PetscReal u[3], PetscReal scaled[3])
{
  for (PetscInt r = 0; r < 3; r++) scaled[r] = k->scale[r > 0] * u[r];
}

static PetscReal ConeLength(const PetscReal t[2])
{
  return PetscSqrtReal(t[0] * t[0] + t[1] * t[1]);
}

/*
   Computes the residuals of the equations of motions, y = (u_n + |slip|, slip) and slip + z_t = u_t, and the derivative
   of |slip|. Returns the sum of squares of the residuals.
*/
static PetscReal ConeResidual(Cone *k, const PetscReal motion[3])
{
  PetscReal u[3], sum, slip;

  ConeScale(k, motion, u);
  slip     = k->n == 3 ? ConeLength(k->limited ? k->y + 1 : u + 1) : 0.0;
  k->ry[0] = k->n ? k->y[0] - u[0] - slip : 0.0;
  sum      = PetscSqr(k->ry[0]);
  for (PetscInt a = 0; a < 2; a++) {
    k->e[a]      = slip > 0.0 ? (k->limited ? k->y[1 + a] : u[1 + a]) / slip : 0.0;
    k->ry[1 + a] = k->n == 3 && !k->limited ? k->y[1 + a] - u[1 + a] : 0.0;
    k->rz[a]     = k->limited ? k->z[1 + a] + (k->n == 3 ? k->y[1 + a] : 0.0) - u[1 + a] : 0.0;
    sum += PetscSqr(k->ry[1 + a]) + PetscSqr(k->rz[a]);
  }
  return sum;
}

/* Returns the sum of y^T f over the cones of a contact after a step of length t */
static PetscReal ConeGap(const Cone *k, PetscReal t)
{
  PetscReal sum = 0.0;

  for (PetscInt r = 0; r < k->n; r++) sum += (k->y[r] + t * k->dy[r]) * (k->f[r] + t * k->df[r]);
  if (!k->limited) return sum;
  sum += (k->z[0] + t * k->dz[0]) * k->limit;
  for (PetscInt r = 1; r < 3; r++) sum += (k->z[r] + t * k->dz[r]) * (k->f[r] + t * k->df[r]);
  return sum;
}

/* Returns the largest step inside the cones of a contact */
static PetscReal ConeStep(const Cone *k)
{
  const PetscReal f[3] = {k->limit, k->f[1], k->f[2]}, df[3] = {0.0, k->df[1], k->df[2]};
  PetscReal       t = PETSC_INFINITY;

  if (k->n == 3) t = PetscMin(ConeLongestStep(k->y, k->dy), ConeLongestStep(k->f, k->df));
  if (k->n == 1 && k->dy[0] < 0.0) t = -k->y[0] / k->dy[0];
  if (k->n == 1 && k->df[0] < 0.0) t = PetscMin(t, -k->f[0] / k->df[0]);
  if (k->limited) t = PetscMin(t, PetscMin(ConeLongestStep(k->z, k->dz), ConeLongestStep(f, df)));
  return t;
}

/* Computes the scalings at the iterate */
static void ConeSetScalings(Cone *k)
{
  const PetscReal f[3] = {k->limit, k->f[1], k->f[2]};
  PetscReal       unused[9];

  if (k->n == 3) ConeScaling(k->y, k->f, k->W, k->Wi);
  if (k->limited) ConeScaling(k->z, f, k->V, unused);
}

/*
   Computes the right-hand sides p of the scaled complementarity conditions W^-1 dy + W df = p: target on the central
   path, and whether the second-order term of the predictor is subtracted
*/
static void ConeSetTarget(Cone *k, PetscReal target, PetscBool corrector)
{
  PetscReal point[3], r[3], a[3], b[3];

  if (k->n == 1) k->p[0] = target - k->y[0] * k->f[0] - (corrector ? k->dy[0] * k->df[0] : 0.0);
  for (PetscInt cone = 0; cone < 2; cone++) {
    const PetscReal f[3]     = {cone ? k->limit : k->f[0], k->f[1], k->f[2]},
                    df[3]    = {cone ? 0.0 : k->df[0], k->df[1], k->df[2]};
    const PetscReal *scaling = cone ? k->V : k->W;

    if (cone ? !k->limited : k->n != 3) continue;
    ConeMultiply(scaling, f, point);
    ConeProduct(point, point, r);
    for (PetscInt c = 0; c < 3; c++) r[c] = -r[c];
    r[0] += target;
    if (corrector) {
      PetscReal inverse[9], second[3];

      ConeInvert(3, scaling, inverse);
      ConeMultiply(inverse, cone ? k->dz : k->dy, a);
      ConeMultiply(scaling, df, b);
      ConeProduct(a, b, second);
      for (PetscInt c = 0; c < 3; c++) r[c] -= second[c];
    }
    ConeDivide(point, r, cone ? k->pz : k->p);
  }
}

/* Computes the linearized law of a Coulomb cone without limit, df = s - D du, from B du + W^2 df = W p + ry with
   B = [1 e; 0 I] */
static void ConeCoulombLaw(const Cone *k, PetscReal D[9], PetscReal S[9], PetscReal s[3])
{
  PetscReal a[3], b[3];

  ConeSquare(k->Wi, S);
  ConeMultiply(k->Wi, k->p, a);
  ConeMultiply(S, k->ry, b);
  for (PetscInt r = 0; r < 3; r++) {
    s[r] = a[r] + b[r];
    for (PetscInt c = 0; c < 3; c++) D[3 * r + c] = S[3 * r + c] + (c ? S[3 * r] * k->e[c - 1] : 0.0);
  }
}

/*
   Computes the linearized law with a limit. du + C df = q is the sum of the compliances of the sliders. Without a
   Coulomb cone, only the tangential components take part. Returns whether C is regular.
*/
static PetscBool ConeLimitedLaw(const Cone *k, PetscReal D[9], PetscReal S[9], PetscReal s[3])
{
  const PetscInt n    = k->n == 3 ? 3 : 2;
  PetscReal      C[9] = {0.0}, symmetric[9], q[3], square[9], a[3] = {0.0, 0.0, 0.0}, b[3];

  if (n == 3) {
    ConeSquare(k->W, C);
    ConeMultiply(k->W, k->p, a);
    q[0] = a[0] - k->e[0] * a[1] - k->e[1] * a[2] + k->ry[0];
  } else q[0] = 0.0;
  ConeSquare(k->V, square);
  ConeMultiply(k->V, k->pz, b);
  for (PetscInt r = 1; r < 3; r++) q[r] = a[r] + b[r] + k->rz[r - 1];
  for (PetscInt r = 0; r < 9; r++) symmetric[r] = C[r] + (r > 3 && r % 3 ? square[r] : 0.0);
  for (PetscInt c = 0; c < 3 && n == 3; c++) C[c] -= k->e[0] * C[3 + c] + k->e[1] * C[6 + c];
  for (PetscInt r = 4; r < 9; r++) C[r] += r % 3 ? square[r] : 0.0;
  if (!ConeInvert(n, C, D) || !ConeInvert(n, symmetric, S)) return PETSC_FALSE;
  ConeMultiply(D, q, s);
  return PETSC_TRUE;
}

/* Computes the linearized law of a contact in unscaled components. Returns whether it exists. */
static PetscBool ConeLaw(const Cone *k, PetscReal D[9], PetscReal S[9], PetscReal s[3])
{
  for (PetscInt r = 0; r < 9; r++) D[r] = S[r] = s[r % 3] = 0.0;
  if (k->limited && !ConeLimitedLaw(k, D, S, s)) return PETSC_FALSE;
  if (k->n == 3 && !k->limited) ConeCoulombLaw(k, D, S, s);
  if (k->n == 1) {
    D[0] = S[0] = k->f[0] / k->y[0];
    s[0]        = k->p[0] / k->y[0] + D[0] * k->ry[0];
  }
  for (PetscInt r = 0; r < 3; r++) {
    s[r] *= k->scale[r > 0];
    for (PetscInt c = 0; c < 3; c++) {
      D[3 * r + c] *= k->scale[r > 0] * k->scale[c > 0];
      S[3 * r + c] *= k->scale[r > 0] * k->scale[c > 0];
    }
  }
  return PETSC_TRUE;
}

/* Computes the changes of y, z and f from those of the unscaled motions and forces */
static void ConeSetChange(Cone *k, const PetscReal motion[3], const PetscReal force[3])
{
  PetscReal du[3], square[9], a[3], b[3];

  ConeScale(k, motion, du);
  for (PetscInt r = 0; r < 3; r++) k->df[r] = k->scale[r > 0] > 0.0 ? force[r] / k->scale[r > 0] : 0.0;
  k->dy[1] = k->dy[2] = 0.0;
  if (k->n == 3 && k->limited) {
    ConeSquare(k->W, square);
    ConeMultiply(square, k->df, a);
    ConeMultiply(k->W, k->p, b);
    for (PetscInt r = 1; r < 3; r++) k->dy[r] = b[r] - a[r];
  } else if (k->n == 3)
    for (PetscInt r = 1; r < 3; r++) k->dy[r] = du[r] - k->ry[r];
  if (k->n == 3 && !k->limited) k->dy[0] = du[0] + k->e[0] * du[1] + k->e[1] * du[2] - k->ry[0];
  else k->dy[0] = k->n ? du[0] + k->e[0] * k->dy[1] + k->e[1] * k->dy[2] - k->ry[0] : 0.0;
  if (!k->limited) return;
  ConeSquare(k->V, square);
  ConeMultiply(k->V, k->pz, b);
  k->dz[0] = b[0] - square[1] * k->df[1] - square[2] * k->df[2];
  for (PetscInt r = 1; r < 3; r++) k->dz[r] = du[r] - k->dy[r] - k->rz[r - 1];
}

PetscErrorCode ConesCreate(Contacts *c, const ContactBodies *bodies, Cones *cones)
{
  Cones s;

  PetscFunctionBegin;
  PetscCall(PetscNew(cones));
  s         = *cones;
  s->c      = c;
  s->bodies = bodies;
  PetscCall(PetscCalloc3(c->n, &s->cone, 3 * c->n, &s->du, 3 * c->n, &s->df));
  for (PetscInt i = 0; i < c->n; i++) {
    ConeSetKind(c, i, &s->cone[i]);
    s->count += (s->cone[i].n > 0) + s->cone[i].limited;
  }
  PetscCall(ConesSum(s, &s->count));
  PetscFunctionReturn(0);
}

PetscErrorCode ConesDestroy(Cones *cones)
{
  PetscFunctionBegin;
  if (*cones) PetscCall(PetscFree3((*cones)->cone, (*cones)->du, (*cones)->df));
  PetscCall(PetscFree(*cones));
  PetscFunctionReturn(0);
}

/* Sets D and s of all contacts, and the matrix of the bodies if `matrix` */
static PetscErrorCode ConesSetLaws(Cones s, PetscBool matrix, PetscBool *ready)
{
  PetscFunctionBegin;
  *ready = PETSC_TRUE;
  for (PetscInt i = 0; i < s->c->n; i++) {
    *ready = (PetscBool)(ConeLaw(&s->cone[i], &s->c->D[9 * i], &s->c->S[9 * i], &s->c->s[3 * i]) && *ready);
    if (s->c->held[i]) ContactsSetNoSlip(s->c, i);
    ContactsFinishLaw(s->c, i);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ready, 1, MPI_PETSCBOOL, MPI_LAND, s->c->comm));
  if (matrix && *ready) PetscCall(s->bodies->prepare(s->bodies->data, s->c->D, s->c->S, ready));
  PetscFunctionReturn(0);
}

/*
   Finds the sizes of forces and motions at which the iteration starts. Motions are those of the equilibrium with a
   spring as stiff as the bodies in the place of each contact.
*/
static PetscErrorCode ConesFindSizes(Cones s, PetscBool *found)
{
  Contacts *c     = s->c;
  PetscReal least = PETSC_SQRT_MACHINE_EPSILON;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < c->n; i++) ContactsSetForce(c, i, 0.0);
  PetscCall(PetscArrayzero(c->f, 3 * c->n));
  for (PetscInt i = 0; i < c->n; i++) {
    PetscCall(PetscArrayzero(&c->D[9 * i], 9));
    PetscCall(PetscArrayzero(&c->S[9 * i], 9));
    for (PetscInt r = 0; r < 3; r++) {
      c->D[9 * i + 4 * r] = c->S[9 * i + 4 * r] = PetscSqr(s->cone[i].scale[r > 0]);
      c->s[3 * i + r]                           = -c->D[9 * i + 4 * r] * c->u[3 * i + r];
    }
    ContactsFinishLaw(c, i);
  }
  PetscCall(s->bodies->residual(s->bodies->data, c->f, &s->force));
  PetscCall(s->bodies->prepare(s->bodies->data, c->D, c->S, found));
  if (*found) PetscCall(ContactsStep(c, s->bodies, 0.01, 0.0, s->du, s->df, found));
  if (!*found) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < c->n; i++) {
    for (PetscInt r = 0; r < 3; r++) {
      const PetscReal scale = s->cone[i].scale[r > 0], u = c->u[3 * i + r];

      s->length = PetscMax(s->length, scale * PetscMax(PetscAbsReal(u + s->du[3 * i + r]), PetscAbsReal(u)));
    }
  }
  PetscCall(ConesMax(s, &s->length));
  s->length = PetscMax(s->length, least * s->force);
  s->force  = PetscMax(s->force, 1e-3 * s->length);
  *found    = (PetscBool)(s->length > 0.0);
  PetscFunctionReturn(0);
}

/* Copies the scaled forces to the unscaled ones */
static void ConesSetForces(Cones s)
{
  for (PetscInt i = 0; i < s->c->n; i++)
    for (PetscInt r = 0; r < 3; r++) s->c->f[3 * i + r] = s->cone[i].scale[r > 0] * s->cone[i].f[r];
}

/* Starts at the centre of all cones. *started: false if there is no load */
PetscErrorCode ConesStart(Cones s, PetscBool *started)
{
  PetscFunctionBegin;
  PetscCall(ConesFindSizes(s, started));
  for (PetscInt i = 0; i < s->c->n; i++) {
    Cone *k = &s->cone[i];

    for (PetscInt r = 0; r < 3; r++) k->y[r] = k->f[r] = k->z[r] = 0.0;
    if (k->n) k->y[0] = s->length;
    if (k->n) k->f[0] = s->force;
    if (k->limited) k->z[0] = s->length * PetscMax(1.0, s->force / k->limit);
  }
  for (PetscInt i = 0; i < s->c->n; i++) ContactsSetForce(s->c, i, s->cone[i].scale[0] * s->cone[i].f[0]);
  ConesSetForces(s);
  PetscFunctionReturn(0);
}

/*
   Computes the residuals at the iterate. gap: the mean of y^T f over the cones; error: the norm by which the laws are
   violated, relative to that of the forces, or of the load if that is larger. Both norms are square roots of energies.
*/
static PetscErrorCode ConesAssess(Cones s, PetscReal *gap, PetscReal *error)
{
  PetscReal sums[3] = {0.0, 0.0, 0.0}; /* sums of y^T f, of squares of residuals of motions, and of forces */

  PetscFunctionBegin;
  for (PetscInt i = 0; i < s->c->n; i++) {
    Cone *k = &s->cone[i];

    sums[0] += ConeGap(k, 0.0);
    sums[1] += ConeResidual(k, &s->c->u[3 * i]);
    for (PetscInt r = 0; r < 3; r++) sums[2] += PetscSqr(k->f[r]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPIU_REAL, MPIU_SUM, s->c->comm));
  PetscCall(s->bodies->residual(s->bodies->data, s->c->f, NULL));
  *gap   = sums[0] / s->count;
  *error = PetscSqrtReal((sums[0] + sums[1]) / PetscMax(sums[2], PetscSqr(s->force)));
  PetscCall(PetscInfo(NULL, "Cones: error %g, gap %g\n", (double)*error, (double)*gap));
  PetscFunctionReturn(0);
}

/*
   Computes a direction. t: its largest step inside the cones; after: the mean of y^T f after this step, of at most the
   whole direction. Where there are several solutions, the path decides which one is found: it must not depend on the
   directions that the bodies have.
*/
static PetscErrorCode ConesDirection(Cones s, PetscReal target, PetscBool corrector, PetscReal *t, PetscReal *after,
  PetscBool *solved)
{
  const PetscReal accuracy = 1e-2; /* loose bricks on 1, 2, 3 ranks: energies to 1e-13; with 0.1: 1e-8; 1: 0.03 */

  PetscFunctionBegin;
  for (PetscInt i = 0; i < s->c->n; i++) ConeSetTarget(&s->cone[i], target, corrector);
  PetscCall(ConesSetLaws(s, (PetscBool)!corrector, solved));
  if (*solved) PetscCall(ContactsStep(s->c, s->bodies, accuracy, 0.0, s->du, s->df, solved));
  if (!*solved) PetscFunctionReturn(0);
  *t = PETSC_INFINITY;
  for (PetscInt i = 0; i < s->c->n; i++) {
    ConeSetChange(&s->cone[i], &s->du[3 * i], &s->df[3 * i]);
    *t = PetscMin(*t, ConeStep(&s->cone[i]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, t, 1, MPIU_REAL, MPIU_MIN, s->c->comm));
  *after = 0.0;
  for (PetscInt i = 0; i < s->c->n; i++) *after += ConeGap(&s->cone[i], PetscMin(1.0, *t)) / s->count;
  PetscCall(ConesSum(s, after));
  *solved = (PetscBool)!PetscIsInfOrNanReal(*after);
  PetscFunctionReturn(0);
}

/* Takes the step t along the last direction */
static PetscErrorCode ConesAdvance(Cones s, PetscReal t)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < s->c->n; i++) {
    Cone *k = &s->cone[i];

    for (PetscInt r = 0; r < 3; r++) {
      k->y[r] += t * k->dy[r];
      k->f[r] += t * k->df[r];
      k->z[r] += t * k->dz[r];
      s->c->u[3 * i + r] += t * s->du[3 * i + r];
    }
  }
  ConesSetForces(s);
  PetscCall(s->bodies->advance(s->bodies->data, t));
  PetscFunctionReturn(0);
}

/*
   Takes one step of predictor and corrector. *error: that of the laws at the iterate before the step. No step is taken
   if it is below the tolerance. *solved: false if a system was not solved, or the cones leave no room for a step
*/
PetscErrorCode ConesIterate(Cones s, PetscReal tolerance, PetscReal *error, PetscBool *solved)
{
  const PetscReal inside = 0.99, /* fraction of the longest step */
    least                = 1e-6, /* of the centring: below it, rounding errors decide */
    room                 = 1e-3; /* shortest step */
  PetscReal t = 0.0, gap, after = 0.0, fraction;

  PetscFunctionBegin;
  *solved = PETSC_TRUE;
  PetscCall(ConesAssess(s, &gap, error));
  if (*error < tolerance) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < s->c->n; i++) ConeSetScalings(&s->cone[i]);
  PetscCall(ConesDirection(s, 0.0, PETSC_FALSE, &t, &after, solved));
  if (!*solved) PetscFunctionReturn(0);
  fraction = PetscClipInterval(after / gap, 0.0, 1.0);
  PetscCall(ConesDirection(s, PetscMax(least, fraction * fraction * fraction) * gap, PETSC_TRUE, &t, &after, solved));
  *solved = (PetscBool)(*solved && t > room);
  if (*solved) PetscCall(ConesAdvance(s, PetscMin(1.0, inside * t)));
  PetscFunctionReturn(0);
}
