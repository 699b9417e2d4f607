static char help[] =
  "Contacts on springs, whose forces with friction are known, by the interior point method alone and by "
  "Newton's method from its end. The algebra of second-order cones against its definitions.\n\n";

#include "../../tao_ipfilter/friction/cone.c"
#include "../../tao_ipfilter/friction/contacts.c"
#include "../../tao_ipfilter/friction/cones.c"
#include "../../tao_ipfilter/friction/newton.c"
#include "../../tao_ipfilter/friction/stick.c"
#include "../../tao_ipfilter/friction/choice.c"
#include "../../tao_ipfilter/friction/iteration.c"

/* What contacts.c needs of the optimizer */
PetscReal IPTermBound(PetscReal limit, PetscReal coefficient, PetscReal force)
{
  if (coefficient < 0.0) return limit;
  return force > 0.0 ? PetscMin(limit, coefficient * force) : 0.0;
}

void IPTermRemoveRigid(const PetscScalar rigid[2], PetscScalar v[2])
{
  const PetscScalar along = rigid[0] * v[0] + rigid[1] * v[1];

  for (PetscInt a = 0; a < 2; a++) v[a] -= along * rigid[a];
}

PetscReal IPTermViolation(const PetscScalar tau[2], const PetscScalar v[2], PetscReal rho, PetscReal bound)
{
  const PetscReal b[2] = {tau[0] - rho * v[0], tau[1] - rho * v[1]}, size = PetscSqrtReal(b[0] * b[0] + b[1] * b[1]),
                  part = size > bound ? bound / size : 1.0;

  return PetscSqrtReal(PetscSqr(tau[0] - part * b[0]) + PetscSqr(tau[1] - part * b[1])) / rho;
}

enum { N = 6 };

/* Blocks on springs of stiffness k: k x + g = f, with the gap and the slip x. Three numbers per block. */
typedef struct {
  PetscReal k, g[3 * N], x[3 * N], dx[3 * N], r[3 * N], D[9 * N], kept[3 * N];
} Springs;

static PetscErrorCode SpringsResidual(void *data, const PetscReal f[], PetscReal *size)
{
  Springs *s = (Springs *)data;

  PetscFunctionBeginUser;
  if (size) *size = 0.0;
  for (PetscInt i = 0; i < 3 * N; i++) {
    s->r[i] = s->k * s->x[i] + s->g[i] - f[i];
    if (size) *size = PetscMax(*size, PetscAbsReal(s->r[i]) / PetscSqrtReal(s->k));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SpringsPrepare(void *data, const PetscReal D[], const PetscReal S[], PetscBool *prepared)
{
  PetscFunctionBeginUser;
  *prepared = PETSC_TRUE;
  for (PetscInt i = 0; i < N; i++)
    for (PetscInt r = 0; r < 3; r++)
      for (PetscInt c = 0; c < 3; c++) {
        const PetscReal *block = &S[9 * i], size = PetscSqrtReal(PetscAbsReal(block[4 * r] * block[4 * c]));

        PetscCheck(PetscAbsReal(block[3 * r + c] - block[3 * c + r]) <= 1e-10 * size, PETSC_COMM_SELF, PETSC_ERR_PLIB,
          "entry %" PetscInt_FMT ", %" PetscInt_FMT " of S is %g, the opposite one %g", r, c, (double)block[3 * r + c],
          (double)block[3 * c + r]);
        PetscCheck(PetscAbsReal(block[3 * r + c]) <= (1.0 + 1e-10) * size, PETSC_COMM_SELF, PETSC_ERR_PLIB,
          "entry %" PetscInt_FMT ", %" PetscInt_FMT " of S is %g, more than a positive block has", r, c,
          (double)block[3 * r + c]);
      }
  PetscCall(PetscArraycpy(((Springs *)data)->D, D, 9 * N));
  PetscFunctionReturn(0);
}

static PetscErrorCode SpringsSolve(void *data, const PetscReal load[], PetscReal fraction, PetscReal target,
  PetscReal du[], PetscBool *solved)
{
  Springs *s = (Springs *)data;

  PetscFunctionBeginUser;
  (void)fraction;
  (void)target;
  *solved = PETSC_TRUE;
  for (PetscInt i = 0; i < N; i++) {
    PetscReal A[9], inverse[9], b[3];

    for (PetscInt c = 0; c < 9; c++) A[c] = s->D[9 * i + c] + (c % 4 ? 0.0 : s->k);
    for (PetscInt r = 0; r < 3; r++) b[r] = load[3 * i + r] - s->r[3 * i + r];
    PetscCheck(ConeInvert(3, A, inverse), PETSC_COMM_SELF, PETSC_ERR_FP, "singular system");
    ConeMultiply(inverse, b, &s->dx[3 * i]);
  }
  PetscCall(PetscArraycpy(du, s->dx, 3 * N));
  PetscFunctionReturn(0);
}

static PetscErrorCode SpringsWork(void *data, PetscReal *work)
{
  const Springs *s = (Springs *)data;

  PetscFunctionBeginUser;
  *work = 0.0;
  for (PetscInt i = 0; i < 3 * N; i++) *work += s->r[i] * s->dx[i];
  PetscFunctionReturn(0);
}

static PetscErrorCode SpringsAdvance(void *data, PetscReal fraction)
{
  Springs *s = (Springs *)data;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3 * N; i++) s->x[i] += fraction * s->dx[i];
  PetscFunctionReturn(0);
}

static PetscErrorCode SpringsKeep(void *data, PetscBool back)
{
  Springs *s = (Springs *)data;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(back ? s->x : s->kept, back ? s->kept : s->x, 3 * N));
  PetscFunctionReturn(0);
}

static PetscErrorCode SpringsInterrupted(void *data, PetscBool *stop)
{
  PetscFunctionBeginUser;
  (void)data;
  *stop = PETSC_FALSE;
  PetscFunctionReturn(0);
}

static ContactBodies SpringsBodies(Springs *s)
{
  const ContactBodies bodies = {
    .data        = s,
    .residual    = SpringsResidual,
    .prepare     = SpringsPrepare,
    .solve       = SpringsSolve,
    .work        = SpringsWork,
    .advance     = SpringsAdvance,
    .keep        = SpringsKeep,
    .interrupted = SpringsInterrupted,
  };

  return bodies;
}

/* Creates N contacts as compliant as the springs */
static PetscErrorCode CreateContacts(const Springs *s, const PetscReal limit[], const PetscReal coefficient[],
  Contacts *c)
{
  PetscFunctionBeginUser;
  PetscCall(ContactsCreate(PETSC_COMM_SELF, N, c));
  for (PetscInt i = 0; i < N; i++) {
    c->normal[i]         = PETSC_TRUE;
    c->compliance[2 * i] = c->compliance[2 * i + 1] = 1.0 / s->k;
    ContactsSetLaw(c, i, limit ? limit[i] : PETSC_INFINITY, coefficient ? coefficient[i] : 0.5);
  }
  PetscFunctionReturn(0);
}

/* Compares the algebra of two points inside the cone with its definitions. Returns the largest difference. */
static PetscReal AlgebraError(const PetscReal y[3], const PetscReal f[3])
{
  PetscReal W[9], Wi[9], a[3], b[3], q[3], worst = 0.0, da[3] = {-1.0, 0.3, -0.4}, t, end[3];

  ConeScaling(y, f, W, Wi);
  ConeMultiply(W, f, a);
  ConeMultiply(Wi, y, b);
  for (PetscInt r = 0; r < 3; r++) worst = PetscMax(worst, PetscAbsReal(a[r] - b[r])); /* W f = W^-1 y */
  ConeMultiply(W, b, a);
  for (PetscInt r = 0; r < 3; r++) worst = PetscMax(worst, PetscAbsReal(a[r] - y[r])); /* W W^-1 y = y */
  ConeDivide(y, f, q);
  ConeProduct(y, q, a);
  for (PetscInt r = 0; r < 3; r++) worst = PetscMax(worst, PetscAbsReal(a[r] - f[r]));
  t = ConeLongestStep(y, da);
  for (PetscInt r = 0; r < 3; r++) end[r] = y[r] + t * da[r];
  return PetscMax(worst, PetscAbsReal(end[0] - PetscSqrtReal(end[1] * end[1] + end[2] * end[2]))); /* on the boundary */
}

static PetscErrorCode TestAlgebra(void)
{
  const PetscReal y[3][3] = {{1.0, 0.2, 0.1}, {5.0, -3.0, 3.9}, {1.0, 0.0, 0.0}},
                  f[3][3] = {{2.0, -1.0, 0.5}, {0.3, 0.2, -0.1}, {7.0, 6.0, -3.0}};
  PetscReal worst         = 0.0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3; i++)
    for (PetscInt j = 0; j < 3; j++) worst = PetscMax(worst, AlgebraError(y[i], f[j]));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "the algebra of cones is %s\n", worst < 1e-11 ? "exact" : "WRONG"));
  PetscFunctionReturn(0);
}

/*
   Block i is pressed by a normal force and pushed by a tangential one: it sticks, slips, opens, slips at its limit, has
   no friction, and slips at a limit that does not depend on the normal force. A spring of stiffness k carries what
   friction does not.
*/
static PetscErrorCode TestBlocks(PetscReal k, PetscReal unit)
{
  const PetscReal press[N]       = {10.0, 10.0, -5.0, 10.0, 10.0, 10.0},
                  push[N][2]     = {{1.0, 2.0}, {6.0, 8.0}, {1.0, 0.0}, {0.0, 5.0}, {1.0, 1.0}, {3.0, 0.0}},
                  coefficient[N] = {0.3, 0.3, 0.3, 0.3, 0.0, -1.0},
                  limit[N] = {PETSC_INFINITY, PETSC_INFINITY, PETSC_INFINITY, 2.0 * unit, PETSC_INFINITY, 1.0 * unit},
                  friction[N][2] = {{-1.0, -2.0}, {-1.8, -2.4}, {0.0, 0.0}, {0.0, -2.0}, {0.0, 0.0}, {-1.0, 0.0}};
  Springs          s             = {.k = k};
  ContactIteration it            = {0};
  ContactBodies    bodies        = SpringsBodies(&s);
  Contacts         c;
  PetscReal        worst   = 0.0;
  PetscInt         systems = 0;
  PetscBool        done    = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(CreateContacts(&s, limit, coefficient, &c));
  for (PetscInt i = 0; i < N; i++) {
    s.g[3 * i] = press[i] * unit; /* downwards: towards negative gaps */
    for (PetscInt a = 0; a < 2; a++) s.g[3 * i + 1 + a] = -push[i][a] * unit;
  }
  PetscCall(ContactIterationBegin(&c, bodies, PETSC_TRUE, &it));
  do {
    PetscCall(ContactIterate(&it, &done));
    systems++;
  } while (done && !(it.violation < 1e-10) && systems < 60);
  for (PetscInt i = 0; i < N; i++) {
    worst = PetscMax(worst, PetscAbsReal(c.f[3 * i] / unit - PetscMax(press[i], 0.0)));
    for (PetscInt a = 0; a < 2; a++) worst = PetscMax(worst, PetscAbsReal(c.f[3 * i + 1 + a] / unit - friction[i][a]));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "blocks that stick, slip, open and reach their limits: %s, %s\n",
    worst < 1e-7 ? "the known forces" : "WRONG forces", systems <= 20 ? "at most 20 systems" : "TOO MANY systems"));
  PetscCall(ContactIterationEnd(&it));
  PetscCall(ContactsDestroy(&c));
  PetscFunctionReturn(0);
}

/* Cones that start again inside an iteration: the components of the last iterate must not remain */
static PetscErrorCode TestRestart(void)
{
  Springs       s      = {.k = 10.0};
  ContactBodies bodies = SpringsBodies(&s);
  Contacts      c;
  Cones         cones;
  PetscReal     error  = 0.0;
  PetscBool     solved = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(CreateContacts(&s, NULL, NULL, &c));
  for (PetscInt i = 0; i < N; i++) s.g[3 * i] = s.g[3 * i + 1] = 1e3;
  PetscCall(ConesCreate(&c, &bodies, &cones));
  for (PetscInt round = 0; round < 3 && solved; round++) {
    PetscCall(ConesStart(cones, &solved));
    for (PetscInt k = 0; k < 4 && solved; k++) PetscCall(ConesIterate(cones, 1e-12, &error, &solved));
    for (PetscInt i = 0; i < 3 * N; i++) s.g[i] = 1e-3 - s.k * s.x[i]; /* the next start is at much smaller forces */
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "cones that start again: %s\n",
    solved && PetscIsNormalReal(error) ? "inside" : "OUTSIDE"));
  PetscCall(ConesDestroy(&cones));
  PetscCall(ContactsDestroy(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(TestAlgebra());
  PetscCall(TestBlocks(100.0, 1.0));
  PetscCall(TestBlocks(2.1e11, 1e3));
  PetscCall(TestBlocks(1e-3, 1e-6));
  PetscCall(TestRestart());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
