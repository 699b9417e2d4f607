static char help[] =
  "Contact geometry: overlaps of facets against independent areas and integrals, degenerate facets, frozen\n\
derivatives.\n\
  -pairs <n> : adversarial pairs of facets, on all ranks together\n";

#include "src/contact/contactimpl.h"
#include "contact_report.h"

static ContactRule rule;

static const ContactOverlapLimits limits = {-0.174, 1e-8, 1e30, 1e30};

/* A random rotation and shift */
typedef struct {
  PetscReal R[3][3], shift[3];
} Motion;

static void RandomMotion(PetscRandom r, Motion *m)
{
  PetscReal q[4], s = 0.0;

  for (PetscInt i = 0; i < 4; ++i) {
    q[i] = Random(r, -1, 1);
    s += q[i] * q[i];
  }
  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt j = 0; j < 3; ++j) {
      const PetscInt  k    = 3 - i - j;
      const PetscReal sign = (j - i + 3) % 3 == 1 ? -1.0 : 1.0;

      m->R[i][j] = i == j ? 1.0 - 2.0 * (1.0 - (q[0] * q[0] + q[1 + i] * q[1 + i]) / s)
                          : 2.0 * (q[1 + i] * q[1 + j] + sign * q[0] * q[1 + k]) / s;
    }
    m->shift[i] = Random(r, -1, 1);
  }
}

static void Move(const Motion *m, PetscReal x[12])
{
  for (PetscInt a = 0; a < 4; ++a) {
    PetscReal y[3];

    for (PetscInt i = 0; i < 3; ++i)
      y[i] = m->shift[i] + m->R[i][0] * x[3 * a] + m->R[i][1] * x[3 * a + 1] + m->R[i][2] * x[3 * a + 2];
    for (PetscInt i = 0; i < 3; ++i) x[3 * a + i] = y[i];
  }
}

/* Facet at height z; facing up, or down for a mortar facet */
static void Facet(const PetscReal p[4][2], PetscReal z, PetscBool up, PetscReal x[12])
{
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscInt b = up ? a : 3 - a;

    x[3 * a]     = p[b][0];
    x[3 * a + 1] = p[b][1];
    x[3 * a + 2] = z;
  }
}

static void RandomConvex(PetscRandom r, PetscReal p[4][2])
{
  const PetscReal cx = Random(r, -1, 1), cy = Random(r, -1, 1), a = Random(r, 0.2, 2), b = Random(r, 0.2, 2),
                  tilt = Random(r, 0, 7);

  for (PetscInt i = 0; i < 4; ++i) { /* on an ellipse */
    const PetscReal t = 0.5 * PETSC_PI * (PetscReal)i + Random(r, -0.7, 0.7), u = a * PetscCosReal(t),
                    v = b * PetscSinReal(t);

    p[i][0] = cx + PetscCosReal(tilt) * u - PetscSinReal(tilt) * v;
    p[i][1] = cy + PetscSinReal(tilt) * u + PetscCosReal(tilt) * v;
  }
}

/* int phi_A over the overlap */
static PetscReal Weight(const ContactIntegrals *m, PetscInt a)
{
  return m->D[a][0] + m->D[a][1] + m->D[a][2] + m->D[a][3];
}

/* Convex facets in parallel planes: gaps along the normal, and none across it */
static PetscErrorCode TestParallelPlanes(PetscRandom r)
{
  PetscReal gaperror = 0.0, slip = 0.0;
  PetscInt  noverlap = 0;

  PetscFunctionBeginUser;
  for (PetscInt trial = 0; trial < 20000; ++trial) {
    PetscReal        p[4][2], q[4][2], x1[12], x2[12], normals[12], size;
    const PetscReal  h = Random(r, -0.3, 0.3);
    Motion           motion;
    ContactOverlap   o;
    ContactIntegrals m;

    RandomConvex(r, p);
    RandomConvex(r, q);
    size = PetscMin(ContactPolygonArea(4, (const PetscReal(*)[2])p), ContactPolygonArea(4, (const PetscReal(*)[2])q));
    Facet((const PetscReal(*)[2])p, 0.0, PETSC_TRUE, x1);
    Facet((const PetscReal(*)[2])q, h, PETSC_FALSE, x2);
    RandomMotion(r, &motion);
    Move(&motion, x1);
    Move(&motion, x2);
    for (PetscInt i = 0; i < 12; ++i) normals[i] = motion.R[i % 3][2];
    if (!ContactOverlapFind(x1, x2, &limits, &rule, &o)) continue;
    ++noverlap;
    ContactIntegrate(&o, x1, x2, normals, NULL, &m);
    for (PetscInt a = 0; a < 4; ++a) gaperror = PetscMax(gaperror, PetscAbsReal(m.gap[a] - h * Weight(&m, a)) / size);
    for (PetscInt i = 0; i < 12; ++i) normals[i] = motion.R[i % 3][0];
    ContactIntegrate(&o, x1, x2, normals, NULL, &m);
    for (PetscInt a = 0; a < 4; ++a) slip = PetscMax(slip, PetscAbsReal(m.gap[a]) / size);
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "random convex facets: %s\n",
    noverlap > 5000 ? "more than 5000 overlaps" : "too few overlaps"));
  PetscCall(Report("gap of parallel planes", gaperror, 1e-12));
  PetscCall(Report("mortar point straight above the nonmortar point", slip, 1e-12));
  PetscFunctionReturn(0);
}

/* int over [lo, hi] of the hat functions a on [p0, p1] and b on [q0, q1], by 2 Gauss points */
static PetscReal Hats(PetscReal lo, PetscReal hi, PetscReal p0, PetscReal p1, PetscInt a, PetscReal q0, PetscReal q1,
  PetscInt b)
{
  PetscReal sum = 0.0;

  for (PetscInt k = 0; k < 2; ++k) {
    const PetscReal x = 0.5 * (lo + hi) + (k ? 0.5 : -0.5) * (hi - lo) / PetscSqrtReal(3.0);
    const PetscReal s = (x - p0) / (p1 - p0), t = (x - q0) / (q1 - q0);

    sum += 0.5 * (hi - lo) * (a ? s : 1.0 - s) * (b ? t : 1.0 - t);
  }
  return sum;
}

/* Rectangles, sheared to parallelograms: products of bilinear functions are integrated exactly */
static PetscErrorCode TestParallelograms(PetscRandom r)
{
  static const PetscInt corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  PetscReal             error        = 0.0;

  PetscFunctionBeginUser;
  for (PetscInt trial = 0; trial < 2000; ++trial) {
    PetscReal        lo[2][2], hi[2][2], p[2][4][2], from[2], to[2], x1[12], x2[12], normals[12] = {0}, size;
    const PetscReal  shear = Random(r, -0.5, 0.5);
    Motion           motion;
    ContactOverlap   o;
    ContactIntegrals m;

    for (PetscInt d = 0; d < 2; ++d) {
      for (PetscInt s = 0; s < 2; ++s) {
        lo[s][d] = Random(r, -1, 0);
        hi[s][d] = Random(r, 0.1, 1);
        for (PetscInt a = 0; a < 4; ++a) p[s][a][d] = corner[a][d] ? hi[s][d] : lo[s][d];
      }
      from[d] = PetscMax(lo[0][d], lo[1][d]);
      to[d]   = PetscMin(hi[0][d], hi[1][d]);
    }
    for (PetscInt s = 0; s < 2; ++s) {
      for (PetscInt a = 0; a < 4; ++a) p[s][a][0] += shear * p[s][a][1];
    }
    RandomMotion(r, &motion);
    Facet((const PetscReal(*)[2])p[0], 0.0, PETSC_TRUE, x1);
    Facet((const PetscReal(*)[2])p[1], 0.0, PETSC_FALSE, x2);
    Move(&motion, x1);
    Move(&motion, x2);
    PetscCheck(ContactOverlapFind(x1, x2, &limits, &rule, &o), PETSC_COMM_SELF, PETSC_ERR_PLIB,
      "Overlapping parallelograms were not found");
    ContactIntegrate(&o, x1, x2, normals, NULL, &m);
    size = (to[0] - from[0]) * (to[1] - from[1]);
    for (PetscInt a = 0; a < 4; ++a) {
      for (PetscInt b = 0; b < 4; ++b) {
        PetscReal D = 1.0, M = 1.0;

        for (PetscInt d = 0; d < 2; ++d) {
          D *= Hats(from[d], to[d], lo[0][d], hi[0][d], corner[a][d], lo[0][d], hi[0][d], corner[b][d]);
          M *= Hats(from[d], to[d], lo[0][d], hi[0][d], corner[a][d], lo[1][d], hi[1][d], corner[3 - b][d]);
        }
        error = PetscMax(error, PetscMax(PetscAbsReal(m.D[a][b] - D), PetscAbsReal(m.M[a][b] - M)) / size);
      }
    }
  }
  PetscCall(Report("mortar integrals on parallelograms", error, 1e-12));
  PetscFunctionReturn(0);
}

/* Warped facets, also far too warped and steep: finite, within the facets, weights add up, derivative of the frozen
   gap */
static PetscErrorCode TestWarped(PetscRandom r)
{
  PetscReal unity = 0.0, outside = 0.0, derivative = 0.0, reference = 0.0;
  PetscInt  noverlap = 0;

  PetscFunctionBeginUser;
  for (PetscInt trial = 0; trial < 20000; ++trial) {
    const PetscReal  warp = PetscPowReal(10.0, Random(r, -14, 0));
    PetscReal        p[4][2], q[4][2], x1[12], x2[12], y1[12], y2[12], normals[12], d1[12], d2[12], sum = 0.0;
    const PetscReal  eps = 1e-3;
    Motion           motion;
    ContactOverlap   o;
    ContactIntegrals m, plus, minus;

    RandomConvex(r, p);
    RandomConvex(r, q);
    Facet((const PetscReal(*)[2])p, 0.0, PETSC_TRUE, x1);
    Facet((const PetscReal(*)[2])q, 0.1, PETSC_FALSE, x2);
    RandomMotion(r, &motion);
    Move(&motion, x1);
    Move(&motion, x2);
    for (PetscInt i = 0; i < 12; ++i) {
      x1[i] += warp * Random(r, -1, 1);
      x2[i] += warp * Random(r, -1, 1);
      normals[i] = Random(r, -1, 1);
      d1[i]      = Random(r, -1, 1);
      d2[i]      = Random(r, -1, 1);
    }
    if (!ContactOverlapFind(x1, x2, &limits, &rule, &o)) continue;
    ++noverlap;
    ContactIntegrate(&o, x1, x2, normals, NULL, &m);
    for (PetscInt a = 0; a < 4; ++a) sum += Weight(&m, a);
    unity = PetscMax(unity, PetscAbsReal(sum - o.area) / o.area);
    for (PetscInt k = 0; k < o.n; ++k) {
      for (PetscInt d = 0; d < 2; ++d) {
        const PetscReal xi = PetscMax(PetscAbsReal(o.xi1[k][d]), PetscAbsReal(o.xi2[k][d]));

        outside = PetscIsInfOrNanReal(xi) ? PETSC_MAX_REAL : PetscMax(outside, xi - 1.0);
      }
    }
    for (PetscInt i = 0; i < 12; ++i) {
      y1[i] = x1[i] - eps * d1[i];
      y2[i] = x2[i] - eps * d2[i];
      x1[i] += eps * d1[i];
      x2[i] += eps * d2[i];
    }
    ContactIntegrate(&o, x1, x2, normals, NULL, &plus);
    ContactIntegrate(&o, y1, y2, normals, NULL, &minus);
    for (PetscInt a = 0; a < 4; ++a) {
      PetscReal J = 0.0;

      for (PetscInt b = 0; b < 4; ++b) {
        for (PetscInt c = 0; c < 3; ++c)
          J += (m.M[a][b] * d2[3 * b + c] - m.D[a][b] * d1[3 * b + c]) * normals[3 * a + c];
      }
      derivative = PetscMax(derivative, PetscAbsReal(J - (plus.gap[a] - minus.gap[a]) / (2.0 * eps)) / o.area);
      reference  = PetscMax(reference, PetscAbsReal(J) / o.area);
    }
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "warped facets: %s\n",
    noverlap > 5000 ? "more than 5000 overlaps" : "too few overlaps"));
  PetscCall(Report("sum of the weights of the rows, warped", unity, 1e-12));
  PetscCall(Report("points outside the facets", outside, 0.0));
  PetscCall(Report("frozen gap differentiated", derivative / reference, 1e-10));
  PetscFunctionReturn(0);
}

/* Facets that look away from each other, are too far or too deep */
static PetscErrorCode TestLimits(void)
{
  static const PetscReal     square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const ContactOverlapLimits near         = {-0.174, 1e-8, 0.5, 0.2};
  static const struct {
    PetscReal z;
    PetscBool up, pairs;
  } cases[] = {
    {0.4, PETSC_FALSE, PETSC_TRUE},
    {0.6, PETSC_FALSE, PETSC_FALSE},
    {-0.1, PETSC_FALSE, PETSC_TRUE},
    {-0.3, PETSC_FALSE, PETSC_FALSE},
    {0.0, PETSC_TRUE, PETSC_FALSE},
  };
  static const PetscReal steep[2] = {0.1, 0.3}; /* minus the cosine between the normals */
  PetscInt               wrong    = 0;

  PetscFunctionBeginUser;
  for (size_t c = 0; c < PETSC_STATIC_ARRAY_LENGTH(cases); ++c) {
    PetscReal      x1[12], x2[12];
    ContactOverlap o;

    Facet(square, 0.0, PETSC_TRUE, x1);
    Facet(square, cases[c].z, cases[c].up, x2);
    wrong += ContactOverlapFind(x1, x2, &near, &rule, &o) != cases[c].pairs;
  }
  for (PetscInt k = 0; k < 2; ++k) { /* the mortar facet turned about the line x = 0.5 */
    const PetscReal c = steep[k], s = PetscSqrtReal(1.0 - c * c);
    PetscReal       x1[12], x2[12];
    ContactOverlap  o;

    Facet(square, 0.0, PETSC_TRUE, x1);
    Facet(square, 0.0, PETSC_FALSE, x2);
    for (PetscInt a = 0; a < 4; ++a) {
      x2[3 * a + 2] = s * (x2[3 * a] - 0.5);
      x2[3 * a]     = 0.5 + c * (x2[3 * a] - 0.5);
    }
    wrong += ContactOverlapFind(x1, x2, &near, &rule, &o) != (k == 1);
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "search limits: %" PetscInt_FMT " wrong\n", wrong));
  PetscFunctionReturn(0);
}

/*
  Exact overlaps in extended precision, by an algorithm of another kind: slabs between all places where an edge
  begins, ends or crosses another one. Between them the height that two triangles share is linear.
*/
typedef long double Extended;

static int CompareExtended(const void *a, const void *b)
{
  const Extended d = *(const Extended *)a - *(const Extended *)b;

  return d < 0 ? -1 : d > 0;
}

/* Where the vertical line at x leaves the triangle: false where it does not meet it */
static PetscBool Chord(Extended t[3][2], Extended x, Extended *low, Extended *high)
{
  PetscBool meets = PETSC_FALSE;

  for (PetscInt e = 0; e < 3; ++e) {
    const Extended *a = t[e], *b = t[(e + 1) % 3];
    Extended        y;

    if ((a[0] < x) == (b[0] < x)) continue;
    y     = a[1] + (b[1] - a[1]) * ((x - a[0]) / (b[0] - a[0]));
    *low  = meets && *low < y ? *low : y;
    *high = meets && *high > y ? *high : y;
    meets = PETSC_TRUE;
  }
  return meets;
}

static Extended TriangleOverlap(Extended s[3][2], Extended t[3][2])
{
  Extended x[15], area = 0;
  PetscInt n = 0;

  for (PetscInt v = 0; v < 3; ++v) {
    x[n++] = s[v][0];
    x[n++] = t[v][0];
  }
  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt j = 0; j < 3; ++j) {
      const Extended d[2] = {s[(i + 1) % 3][0] - s[i][0], s[(i + 1) % 3][1] - s[i][1]},
                     e[2] = {t[(j + 1) % 3][0] - t[j][0], t[(j + 1) % 3][1] - t[j][1]};
      const Extended det  = d[0] * e[1] - d[1] * e[0],
                     u    = ((t[j][0] - s[i][0]) * e[1] - (t[j][1] - s[i][1]) * e[0]) / det;

      if (det != 0 && u > 0 && u < 1) x[n++] = s[i][0] + u * d[0];
    }
  }
  qsort(x, n, sizeof(Extended), CompareExtended);
  for (PetscInt k = 0; k + 1 < n; ++k) {
    const Extended middle = 0.5L * (x[k] + x[k + 1]);
    Extended       low[2], high[2], height;

    if (!Chord(s, middle, &low[0], &high[0]) || !Chord(t, middle, &low[1], &high[1])) continue;
    height = (high[0] < high[1] ? high[0] : high[1]) - (low[0] > low[1] ? low[0] : low[1]);
    if (height > 0) area += height * (x[k + 1] - x[k]);
  }
  return area;
}

static Extended Signed(Extended t[3][2])
{
  return (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1]);
}

/* Any quadrilaterals: each is the sum of two triangles with signs */
static Extended QuadOverlap(Extended p[4][2], Extended q[4][2])
{
  Extended area = 0;

  for (PetscInt i = 0; i < 2; ++i) {
    for (PetscInt j = 0; j < 2; ++j) {
      Extended s[3][2], t[3][2], a, b;

      for (PetscInt v = 0; v < 3; ++v) {
        for (PetscInt d = 0; d < 2; ++d) {
          s[v][d] = p[v ? v + i : 0][d];
          t[v][d] = q[v ? v + j : 0][d];
        }
      }
      a = Signed(s);
      b = Signed(t);
      area += (a < 0 ? -1 : a > 0) * (b < 0 ? -1 : b > 0) * TriangleOverlap(s, t);
    }
  }
  return area;
}

/* Vertices of both facets in the plane of the first */
static void ProjectExtended(const PetscReal x1[12], const PetscReal x2[12], Extended p[4][2], Extended q[4][2])
{
  Extended d[2][3], n[3], s[3], tt = 0, ss = 0;

  for (PetscInt c = 0; c < 3; ++c) {
    d[0][c] = (Extended)x1[6 + c] - x1[c];
    d[1][c] = (Extended)x1[9 + c] - x1[3 + c];
  }
  for (PetscInt c = 0; c < 3; ++c) n[c] = d[0][(c + 1) % 3] * d[1][(c + 2) % 3] - d[0][(c + 2) % 3] * d[1][(c + 1) % 3];
  for (PetscInt c = 0; c < 3; ++c) s[c] = n[(c + 1) % 3] * d[0][(c + 2) % 3] - n[(c + 2) % 3] * d[0][(c + 1) % 3];
  for (PetscInt c = 0; c < 3; ++c) {
    tt += d[0][c] * d[0][c];
    ss += s[c] * s[c];
  }
  for (PetscInt a = 0; a < 4; ++a) {
    p[a][0] = p[a][1] = q[a][0] = q[a][1] = 0;
    for (PetscInt c = 0; c < 3; ++c) {
      const Extended y1 = (Extended)x1[3 * a + c] - x1[c], y2 = (Extended)x2[3 * (3 - a) + c] - x1[c];

      p[a][0] += y1 * d[0][c] / sqrtl(tt);
      p[a][1] += y1 * s[c] / sqrtl(ss);
      q[a][0] += y2 * d[0][c] / sqrtl(tt);
      q[a][1] += y2 * s[c] / sqrtl(ss);
    }
  }
}

/* What pairs may do to one another. p: the nonmortar facet, q: the mortar facet, both counterclockwise; noise is
   often exactly 0 */
enum {
  PAIR_RANDOM,
  PAIR_COLLINEAR, /* an edge of q on the line of one of p */
  PAIR_VERTEX,    /* a vertex of q on a vertex or an edge of p */
  PAIR_PARALLEL,  /* q is p, hardly turned and shifted */
  PAIR_SLIVER,    /* one or both are squeezed, in directions of their own */
  PAIR_TRIANGLE,  /* two vertices coincide, in one or both */
  PAIR_REFLEX,    /* one or both have a reflex corner, or nearly a straight one */
  PAIR_FOLDED,    /* an edge crosses the one opposite: the fold's area is negative */
  PAIR_WARPED,    /* out of plane, from rounding to much */
  PAIR_KINDS
};

static PetscReal Power(PetscRandom r, PetscReal low, PetscReal high)
{
  return PetscPowReal(10.0, Random(r, low, high));
}

static PetscReal Noise(PetscRandom r)
{
  return Random(r, 0, 1) < 0.4 ? 0.0 : Random(r, -1, 1) * Power(r, -17, -6);
}

static void Squeeze(PetscRandom r, PetscReal p[4][2])
{
  const PetscReal angle = Random(r, 0, 7), c = PetscCosReal(angle), s = PetscSinReal(angle),
                  factor = 1.0 - Power(r, -9, -1);

  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal along = c * p[a][0] + s * p[a][1];

    p[a][0] -= factor * along * c;
    p[a][1] -= factor * along * s;
  }
}

static void Dent(PetscRandom r, PetscReal p[4][2])
{
  const PetscInt  a     = (PetscInt)Random(r, 0, 3.999);
  const PetscReal t     = Random(r, 0, 1) < 0.5 ? 0.5 : Random(r, 0.2, 0.8),
                  depth = Random(r, 0, 1) < 0.5 ? Noise(r) : Random(r, 0, 0.3);

  for (PetscInt d = 0; d < 2; ++d) {
    const PetscReal straight = (1 - t) * p[(a + 3) % 4][d] + t * p[(a + 1) % 4][d];

    p[a][d] = straight + depth * (p[(a + 2) % 4][d] - straight);
  }
}

static void AdversarialPair(PetscRandom r, PetscInt kind, PetscReal p[4][2], PetscReal q[4][2])
{
  const PetscInt a = (PetscInt)Random(r, 0, 3.999), b = (PetscInt)Random(r, 0, 3.999),
                 which = (PetscInt)Random(r, 1, 3.999);
  const PetscReal t = Random(r, 0, 1) < 0.3 ? 0.0 : Random(r, 0, 1), u = Random(r, -0.5, 1.5);

  RandomConvex(r, p);
  RandomConvex(r, q);
  if (kind == PAIR_COLLINEAR) {
    const PetscReal angle = PetscAtan2Real(p[(a + 1) % 4][1] - p[a][1], p[(a + 1) % 4][0] - p[a][0]) -
                            PetscAtan2Real(q[(b + 1) % 4][1] - q[b][1], q[(b + 1) % 4][0] - q[b][0]) +
                            (which == 1 ? PETSC_PI : 0.0) + Noise(r);
    const PetscReal c = PetscCosReal(angle), s = PetscSinReal(angle), from[2] = {q[b][0], q[b][1]};

    for (PetscInt v = 0; v < 4; ++v) {
      const PetscReal dx = q[v][0] - from[0], dy = q[v][1] - from[1];

      q[v][0] = p[a][0] + u * (p[(a + 1) % 4][0] - p[a][0]) + c * dx - s * dy;
      q[v][1] = p[a][1] + u * (p[(a + 1) % 4][1] - p[a][1]) + s * dx + c * dy;
    }
  }
  if (kind == PAIR_VERTEX) {
    const PetscReal from[2] = {q[b][0], q[b][1]};

    for (PetscInt v = 0; v < 4; ++v) {
      for (PetscInt d = 0; d < 2; ++d) q[v][d] += p[a][d] + t * (p[(a + 1) % 4][d] - p[a][d]) - from[d];
    }
  }
  if (kind == PAIR_PARALLEL) {
    const PetscReal angle = Noise(r), dx = Noise(r), dy = Noise(r), scale = 1.0 + Noise(r);

    for (PetscInt v = 0; v < 4; ++v) {
      const PetscReal *w = p[(v + a) % 4];

      q[v][0] = scale * (w[0] - angle * w[1]) + dx;
      q[v][1] = scale * (w[1] + angle * w[0]) + dy;
    }
  }
  for (PetscInt side = 0; side < 2; ++side) {
    PetscReal(*x)[2] = side ? q : p;

    if (!(which >> side & 1)) continue;
    if (kind == PAIR_SLIVER) Squeeze(r, x);
    if (kind == PAIR_REFLEX) Dent(r, x);
    if (kind == PAIR_TRIANGLE || kind == PAIR_FOLDED) {
      const PetscReal part = kind == PAIR_FOLDED ? -Random(r, 0, 0.3) : PetscAbsReal(Noise(r));

      for (PetscInt d = 0; d < 2; ++d) x[a][d] = x[(a + 1) % 4][d] + part * (x[a][d] - x[(a + 1) % 4][d]);
    }
  }
}

/* Length by which the area of a facet's overlaps may change with the rounding of its vertices: the longest diagonal
   or edge */
static PetscReal Diameter(const PetscReal x[12])
{
  PetscReal longest = 0.0;

  for (PetscInt a = 0; a < 4; ++a) {
    for (PetscInt b = 0; b < a; ++b)
      longest = PetscMax(longest,
        PetscSqr(x[3 * a] - x[3 * b]) + PetscSqr(x[3 * a + 1] - x[3 * b + 1]) + PetscSqr(x[3 * a + 2] - x[3 * b + 2]));
  }
  return PetscSqrtReal(longest);
}

/* Adds one pair's errors: area, partition of unity of the rows, of the mortar shape functions; infinite where
   something is not finite */
static void CheckPair(const PetscReal x1[12], const PetscReal x2[12], PetscReal error[3], PetscInt *noverlaps)
{
  const ContactOverlapLimits all         = {-1e-3, 0.0, 1e30, 1e30};
  const PetscReal            normals[12] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  PetscReal                  n1[3], n2[3], exact, size, weights = 0.0, sum[2] = {0, 0};
  Extended                   p[4][2], q[4][2];
  ContactOverlap             o;
  ContactIntegrals           m;

  if (!ContactFacetNormal(x1, n1) || !ContactFacetNormal(x2, n2)) return;
  if (n1[0] * n2[0] + n1[1] * n2[1] + n1[2] * n2[2] > -2e-3) return;
  ProjectExtended(x1, x2, p, q);
  exact = (PetscReal)QuadOverlap(p, q);
  size  = PetscSqr(PetscMin(Diameter(x1), Diameter(x2)));
  if (!ContactOverlapFind(x1, x2, &all, &rule, &o)) {
    error[0] = PetscMax(error[0], exact / size);
    return;
  }
  ++*noverlaps;
  ContactIntegrate(&o, x1, x2, normals, NULL, &m);
  for (PetscInt i = 0; i < 16; ++i) {
    sum[0] += m.D[i / 4][i % 4];
    sum[1] += m.M[i / 4][i % 4];
  }
  error[0] = PetscMax(error[0], PetscAbsReal(o.area - exact) / size);
  for (PetscInt k = 0; k < o.n; ++k) weights += PetscAbsReal(o.weight[k]);
  for (PetscInt k = 0; k < 2; ++k) error[1 + k] = PetscMax(error[1 + k], PetscAbsReal(sum[k] - o.area) / weights);
  for (PetscInt k = 0; k < 4; ++k) sum[0] += m.gap[k];
  if (PetscIsInfOrNanReal(sum[0] + sum[1] + exact)) error[0] = PETSC_MAX_REAL;
}

/* Pairs of every kind, turned in space or not; split over the ranks */
static PetscErrorCode TestAdversarial(PetscRandom r, PetscInt npairs)
{
  static const char *const names[PAIR_KINDS] = {"random", "collinear edges", "touching vertices", "nearly the same",
    "slivers", "triangles", "reflex corners", "folded", "warped"};
  PetscMPIInt              rank, size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(PetscRandomSetSeed(r, 1000 + rank));
  PetscCall(PetscRandomSeed(r));
  for (PetscInt kind = 0; kind < PAIR_KINDS; ++kind) {
    const PetscInt n         = npairs / PAIR_KINDS;
    PetscReal      error[3]  = {0, 0, 0};
    PetscInt       noverlaps = 0;

    for (PetscInt trial = rank; trial < n; trial += size) {
      PetscReal p[4][2], q[4][2], x1[12], x2[12];

      AdversarialPair(r, kind, p, q);
      Facet((const PetscReal(*)[2])p, 0.0, PETSC_TRUE, x1);
      Facet((const PetscReal(*)[2])q, Random(r, -0.3, 0.3), PETSC_FALSE, x2);
      if (kind == PAIR_WARPED) {
        const PetscReal warp = Power(r, -16, 0);

        for (PetscInt a = 0; a < 4; ++a) {
          x1[3 * a + 2] += warp * Random(r, -1, 1);
          x2[3 * a + 2] += warp * Random(r, -1, 1);
        }
      }
      if (trial % 3) {
        Motion motion;

        RandomMotion(r, &motion);
        Move(&motion, x1);
        Move(&motion, x2);
      }
      CheckPair(x1, x2, error, &noverlaps);
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 3, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &noverlaps, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "adversarial facets, %s: %s\n", names[kind],
      noverlaps > n / 10 ? "more than a tenth overlap" : "too few overlaps"));
    PetscCall(Report("  area", error[0], 1e-12));
    PetscCall(Report("  weights of the rows", error[1], 1e-12));
    PetscCall(Report("  weights of the mortar vertices", error[2], 1e-12));
  }
  PetscFunctionReturn(0);
}

/* Means of monomials of the barycentric coordinates over a triangle: 2 i! j! k!/(i + j + k + 2)! */
static PetscErrorCode TestRules(void)
{
  const PetscReal factorial[] = {1, 1, 2, 6, 24, 120, 720, 5040, 40320, 362880, 3628800};
  PetscReal       error       = 0.0;

  PetscFunctionBeginUser;
  for (PetscInt degree = 1; degree <= CONTACT_RULE_DEGREE; ++degree) {
    ContactRule r;

    PetscCall(ContactRuleCreate(degree, &r));
    for (PetscInt i = 0; i <= degree; ++i) {
      for (PetscInt j = 0; i + j <= degree; ++j) {
        for (PetscInt k = 0; i + j + k <= degree; ++k) {
          PetscReal mean = 0.0;

          for (PetscInt q = 0; q < r.n; ++q)
            mean += r.weight[q] * PetscPowRealInt(r.barycentric[q][0], i) * PetscPowRealInt(r.barycentric[q][1], j) *
                    PetscPowRealInt(r.barycentric[q][2], k);
          error = PetscMax(error,
            PetscAbsReal(mean - 2.0 * factorial[i] * factorial[j] * factorial[k] / factorial[i + j + k + 2]));
        }
      }
    }
  }
  PetscCall(Report("rules for triangles", error, 1e-14));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscRandom r;
  PetscInt    npairs = 20000;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ContactRuleCreate(5, &rule));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-pairs", &npairs, NULL));
  PetscCall(PetscRandomCreate(PETSC_COMM_SELF, &r));
  PetscCall(TestRules());
  PetscCall(TestParallelPlanes(r));
  PetscCall(TestParallelograms(r));
  PetscCall(TestWarped(r));
  PetscCall(TestLimits());
  PetscCall(TestAdversarial(r, npairs));
  PetscCall(PetscRandomDestroy(&r));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 3}}
      output_file: output/contact_clip_1.out

TEST*/
