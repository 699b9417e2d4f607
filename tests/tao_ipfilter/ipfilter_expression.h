/* Shared by the tests of TAOIPFILTER on small problems: formulas in x1, x2, ... with their gradient and Hessian */
#ifndef IPFILTER_EXPRESSION_H
#define IPFILTER_EXPRESSION_H

#include <petscsys.h>
#include <petscmath.h>
#include <ctype.h>

/* Unknowns */
#ifndef EXPRESSION_MAX
  #define EXPRESSION_MAX 10
#endif

/* A value with its first and second derivatives; those by unknowns from n on are zero and not set */
typedef struct {
  PetscInt  n;
  PetscReal v, g[EXPRESSION_MAX], h[EXPRESSION_MAX][EXPRESSION_MAX];
} Jet;

/* Where the text is read, and the point */
typedef struct {
  const char      *s;
  const PetscReal *x;
} ExpressionReader;

static inline void JetConstant(PetscReal v, Jet *c)
{
  c->n = 0;
  c->v = v;
}

/* Sets the derivatives by the unknowns before n */
static inline void JetWiden(Jet *a, PetscInt n)
{
  for (; a->n < n; a->n++) {
    a->g[a->n] = 0.0;
    for (PetscInt i = 0; i <= a->n; i++) a->h[i][a->n] = a->h[a->n][i] = 0.0;
  }
}

/* x_i */
static inline void JetUnknown(PetscReal v, PetscInt i, Jet *c)
{
  JetConstant(v, c);
  JetWiden(c, i + 1);
  c->g[i] = 1.0;
}

/* a += factor b */
static inline void JetAdd(Jet *a, PetscReal factor, const Jet *b)
{
  JetWiden(a, b->n);
  a->v += factor * b->v;
  for (PetscInt i = 0; i < b->n; i++) {
    a->g[i] += factor * b->g[i];
    for (PetscInt j = 0; j < b->n; j++) a->h[i][j] += factor * b->h[i][j];
  }
}

/* a = phi(a) from phi and its derivatives at a */
static inline void JetChain(Jet *a, PetscReal phi, PetscReal first, PetscReal second)
{
  a->v = phi;
  for (PetscInt i = 0; i < a->n; i++) {
    for (PetscInt j = 0; j < a->n; j++) a->h[i][j] = first * a->h[i][j] + second * a->g[i] * a->g[j];
  }
  for (PetscInt i = 0; i < a->n; i++) a->g[i] *= first;
}

/* a *= b */
static inline void JetMultiply(Jet *a, Jet *b)
{
  if (!b->n) {
    JetChain(a, a->v * b->v, b->v, 0.0);
    return;
  }
  JetWiden(a, b->n);
  JetWiden(b, a->n);
  for (PetscInt i = 0; i < a->n; i++) {
    for (PetscInt j = 0; j < a->n; j++)
      a->h[i][j] = a->h[i][j] * b->v + a->g[i] * b->g[j] + b->g[i] * a->g[j] + a->v * b->h[i][j];
  }
  for (PetscInt i = 0; i < a->n; i++) a->g[i] = a->g[i] * b->v + a->v * b->g[i];
  a->v *= b->v;
}

/* a = a^p */
static inline void JetPower(Jet *a, PetscReal p)
{
  const PetscReal v = a->v;

  JetChain(a, PetscPowReal(v, p), p == 0.0 ? 0.0 : p * PetscPowReal(v, p - 1.0),
    p * (p - 1.0) == 0.0 ? 0.0 : p * (p - 1.0) * PetscPowReal(v, p - 2.0));
}

/* a = e^a, log a */
static inline void JetExp(Jet *a)
{
  JetChain(a, PetscExpReal(a->v), PetscExpReal(a->v), PetscExpReal(a->v));
}

static inline void JetLog(Jet *a)
{
  JetChain(a, PetscLogReal(a->v), 1.0 / a->v, -1.0 / PetscSqr(a->v));
}

static inline void ExpressionSkip(ExpressionReader *r)
{
  while (isspace((unsigned char)*r->s)) r->s++;
}

static inline PetscBool ExpressionAccept(ExpressionReader *r, char c)
{
  ExpressionSkip(r);
  if (*r->s != c) return PETSC_FALSE;
  r->s++;
  return PETSC_TRUE;
}

static inline void ExpressionSum(ExpressionReader *r, Jet *a);

static inline PetscReal ExpressionNumber(ExpressionReader *r)
{
  char     *end;
  PetscReal v = strtod(r->s, &end);

  r->s = end;
  return v;
}

/* exp, erf, log, sqrt, sin, cos, cosh, atan, tanh of what stands in parentheses; another name makes no number */
static inline void ExpressionFunction(ExpressionReader *r, Jet *a)
{
  const char  *name   = r->s;
  const size_t length = strcspn(name, "( ;");
  PetscReal    v;

  r->s += length;
  ExpressionAccept(r, '(');
  ExpressionSum(r, a);
  ExpressionAccept(r, ')');
  v = a->v;
#define IS(f) (length == sizeof(f) - 1 && !strncmp(name, f, sizeof(f) - 1))
  if (IS("exp")) JetExp(a);
  else if (IS("log")) JetLog(a);
  else if (IS("sqrt")) JetPower(a, 0.5);
  else if (IS("sin")) JetChain(a, PetscSinReal(v), PetscCosReal(v), -PetscSinReal(v));
  else if (IS("cos")) JetChain(a, PetscCosReal(v), -PetscSinReal(v), -PetscCosReal(v));
  else if (IS("cosh")) JetChain(a, PetscCoshReal(v), PetscSinhReal(v), PetscCoshReal(v));
  else if (IS("atan")) JetChain(a, PetscAtanReal(v), 1.0 / (1.0 + v * v), -2.0 * v / PetscSqr(1.0 + v * v));
  else if (IS("tanh"))
    JetChain(a, PetscTanhReal(v), 1.0 - PetscSqr(PetscTanhReal(v)),
      -2.0 * PetscTanhReal(v) * (1.0 - PetscSqr(PetscTanhReal(v))));
  else if (IS("erf"))
    JetChain(a, erf(v), 2.0 / PetscSqrtReal(PETSC_PI) * PetscExpReal(-v * v),
      -4.0 * v / PetscSqrtReal(PETSC_PI) * PetscExpReal(-v * v));
  else JetConstant(NAN, a);
#undef IS
}

static inline void ExpressionExponent(ExpressionReader *r, Jet *a);

static inline void ExpressionPrimary(ExpressionReader *r, Jet *a)
{
  if (ExpressionAccept(r, '(')) {
    ExpressionSum(r, a);
    ExpressionAccept(r, ')');
  } else if (*r->s == 'x') {
    PetscInt i = (PetscInt)strtol(r->s + 1, (char **)&r->s, 10) - 1;

    JetUnknown(r->x[i], i, a);
  } else if (isalpha((unsigned char)*r->s)) ExpressionFunction(r, a);
  else JetConstant(ExpressionNumber(r), a);
  if (ExpressionAccept(r, '^')) ExpressionExponent(r, a);
}

/* a to the power that follows: a number, signed or not; or what stands in parentheses, or an unknown */
static inline void ExpressionExponent(ExpressionReader *r, Jet *a)
{
  Jet p;

  if (*r->s != '(' && *r->s != 'x') {
    JetPower(a, ExpressionNumber(r));
    return;
  }
  ExpressionPrimary(r, &p);
  if (!p.n) JetPower(a, p.v);
  else {
    JetLog(a);
    JetMultiply(a, &p);
    JetExp(a);
  }
}

static inline void ExpressionProduct(ExpressionReader *r, Jet *a)
{
  ExpressionPrimary(r, a);
  for (;;) {
    Jet       b;
    PetscBool divide = PETSC_FALSE;

    if (!ExpressionAccept(r, '*') && !(divide = ExpressionAccept(r, '/'))) return;
    ExpressionPrimary(r, &b);
    if (divide) JetPower(&b, -1.0);
    JetMultiply(a, &b);
  }
}

static inline void ExpressionSum(ExpressionReader *r, Jet *a)
{
  Jet       b;
  PetscReal sign = ExpressionAccept(r, '-') ? -1.0 : 1.0;

  JetConstant(0.0, a);
  for (;;) {
    ExpressionProduct(r, &b);
    JetAdd(a, sign, &b);
    if (ExpressionAccept(r, '-')) sign = -1.0;
    else if (ExpressionAccept(r, '+')) sign = 1.0;
    else return;
  }
}

/* The formula that starts at text, at x; *end is where it stops: at a semicolon or the end */
static inline void ExpressionEvaluate(const char *text, const PetscReal x[], const char **end, Jet *a)
{
  ExpressionReader r = {text, x};

  ExpressionSum(&r, a);
  ExpressionSkip(&r);
  JetWiden(a, EXPRESSION_MAX);
  if (end) *end = r.s;
}

#endif
