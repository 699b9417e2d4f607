/* Shared by the tests of TAOIPFILTER on small problems: formulas in x1, x2, ... with their gradient and Hessian */
#ifndef IPFILTER_EXPRESSION_H
#define IPFILTER_EXPRESSION_H

#include <petscsys.h>
#include <ctype.h>

#define EXPRESSION_MAX 10 /* unknowns */

/* A value with its first and second derivatives */
typedef struct {
  PetscReal v, g[EXPRESSION_MAX], h[EXPRESSION_MAX][EXPRESSION_MAX];
} Jet;

/* Where the text is read, and the point */
typedef struct {
  const char      *s;
  const PetscReal *x;
} ExpressionReader;

static inline Jet JetConstant(PetscReal v)
{
  Jet c = {0};

  c.v = v;
  return c;
}

static inline Jet JetAdd(const Jet *a, PetscReal factor, const Jet *b)
{
  Jet c;

  c.v = a->v + factor * b->v;
  for (PetscInt i = 0; i < EXPRESSION_MAX; i++) {
    c.g[i] = a->g[i] + factor * b->g[i];
    for (PetscInt j = 0; j < EXPRESSION_MAX; j++) c.h[i][j] = a->h[i][j] + factor * b->h[i][j];
  }
  return c;
}

static inline Jet JetMultiply(const Jet *a, const Jet *b)
{
  Jet c;

  c.v = a->v * b->v;
  for (PetscInt i = 0; i < EXPRESSION_MAX; i++) {
    c.g[i] = a->g[i] * b->v + a->v * b->g[i];
    for (PetscInt j = 0; j < EXPRESSION_MAX; j++) c.h[i][j] = a->h[i][j] * b->v + a->g[i] * b->g[j] + b->g[i] * a->g[j] + a->v * b->h[i][j];
  }
  return c;
}

/* phi(a) from phi and its derivatives at a */
static inline Jet JetChain(const Jet *a, PetscReal phi, PetscReal first, PetscReal second)
{
  Jet c;

  c.v = phi;
  for (PetscInt i = 0; i < EXPRESSION_MAX; i++) {
    c.g[i] = first * a->g[i];
    for (PetscInt j = 0; j < EXPRESSION_MAX; j++) c.h[i][j] = first * a->h[i][j] + second * a->g[i] * a->g[j];
  }
  return c;
}

static inline Jet JetPower(const Jet *a, PetscReal p)
{
  return JetChain(a, PetscPowReal(a->v, p), p == 0.0 ? 0.0 : p * PetscPowReal(a->v, p - 1.0), p * (p - 1.0) == 0.0 ? 0.0 : p * (p - 1.0) * PetscPowReal(a->v, p - 2.0));
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

static inline Jet ExpressionSum(ExpressionReader *r);

static inline PetscReal ExpressionNumber(ExpressionReader *r)
{
  char     *end;
  PetscReal v = strtod(r->s, &end);

  r->s = end;
  return v;
}

/* exp, log, sqrt, sin, cos of what stands in parentheses */
static inline Jet ExpressionFunction(ExpressionReader *r)
{
  const char *name = r->s;
  Jet         a;

  while (isalpha((unsigned char)*r->s)) r->s++;
  ExpressionAccept(r, '(');
  a = ExpressionSum(r);
  ExpressionAccept(r, ')');
  switch (name[0] == 's' ? name[1] : name[0]) {
  case 'e':
    return JetChain(&a, PetscExpReal(a.v), PetscExpReal(a.v), PetscExpReal(a.v));
  case 'l':
    return JetChain(&a, PetscLogReal(a.v), 1.0 / a.v, -1.0 / PetscSqr(a.v));
  case 'i':
    return JetChain(&a, PetscSinReal(a.v), PetscCosReal(a.v), -PetscSinReal(a.v));
  case 'c':
    return JetChain(&a, PetscCosReal(a.v), -PetscSinReal(a.v), -PetscCosReal(a.v));
  default:
    return JetPower(&a, 0.5);
  }
}

static inline Jet ExpressionPrimary(ExpressionReader *r)
{
  Jet a;

  if (ExpressionAccept(r, '(')) {
    a = ExpressionSum(r);
    ExpressionAccept(r, ')');
  } else if (*r->s == 'x') {
    PetscInt i;

    r->s++;
    i      = (PetscInt)strtol(r->s, (char **)&r->s, 10) - 1;
    a      = JetConstant(r->x[i]);
    a.g[i] = 1.0;
  } else if (isalpha((unsigned char)*r->s)) a = ExpressionFunction(r);
  else a = JetConstant(ExpressionNumber(r));
  /* a constant exponent, signed or not */
  if (ExpressionAccept(r, '^')) a = JetPower(&a, ExpressionNumber(r));
  return a;
}

static inline Jet ExpressionProduct(ExpressionReader *r)
{
  Jet a = ExpressionPrimary(r);

  for (;;) {
    Jet       b;
    PetscBool divide = PETSC_FALSE;

    if (!ExpressionAccept(r, '*') && !(divide = ExpressionAccept(r, '/'))) return a;
    b = ExpressionPrimary(r);
    if (divide) b = JetPower(&b, -1.0);
    a = JetMultiply(&a, &b);
  }
}

static inline Jet ExpressionSum(ExpressionReader *r)
{
  Jet a = JetConstant(0.0), b;

  if (!ExpressionAccept(r, '-')) a = ExpressionProduct(r);
  else {
    b = ExpressionProduct(r);
    a = JetAdd(&a, -1.0, &b);
  }
  for (;;) {
    PetscReal sign = 1.0;

    if (ExpressionAccept(r, '-')) sign = -1.0;
    else if (!ExpressionAccept(r, '+')) return a;
    b = ExpressionProduct(r);
    a = JetAdd(&a, sign, &b);
  }
}

/* The formula that starts at text, at x; *end is where it stops: at a semicolon or the end */
static inline Jet ExpressionEvaluate(const char *text, const PetscReal x[], const char **end)
{
  ExpressionReader r = {text, x};
  Jet              a = ExpressionSum(&r);

  ExpressionSkip(&r);
  if (end) *end = r.s;
  return a;
}

#endif
