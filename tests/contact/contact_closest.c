static char help[] = "Closest point of a bilinear facet, and the nearest of many facets, against exhaustive search.\n";

#include "src/contact/contactimpl.h"
#include "contact_report.h"

static void Point(const PetscReal x[12], PetscReal xi, PetscReal eta, PetscReal y[3])
{
  PetscReal phi[4];

  ContactShape((const PetscReal[2]){xi, eta}, phi);
  for (PetscInt c = 0; c < 3; ++c) y[c] = phi[0] * x[c] + phi[1] * x[3 + c] + phi[2] * x[6 + c] + phi[3] * x[9 + c];
}

static PetscReal Distance(const PetscReal a[3], const PetscReal b[3])
{
  return PetscSqrtReal(PetscSqr(a[0] - b[0]) + PetscSqr(a[1] - b[1]) + PetscSqr(a[2] - b[2]));
}

/* Grids, each about the best point of the last: what is found is never closer than the closest point */
static PetscReal Exhaustive(const PetscReal x[12], const PetscReal p[3])
{
  PetscReal centre[2] = {0, 0}, half = 1.0, best = PETSC_MAX_REAL;

  for (PetscInt level = 0; level < 8; ++level) {
    const PetscReal middle[2] = {centre[0], centre[1]};

    for (PetscInt i = 0; i <= 20; ++i) {
      for (PetscInt j = 0; j <= 20; ++j) {
        const PetscReal xi  = PetscClipInterval(middle[0] + half * (0.1 * (PetscReal)i - 1.0), -1.0, 1.0),
                        eta = PetscClipInterval(middle[1] + half * (0.1 * (PetscReal)j - 1.0), -1.0, 1.0);
        PetscReal y[3], d;

        Point(x, xi, eta, y);
        d = Distance(y, p);
        if (d < best) {
          best      = d;
          centre[0] = xi;
          centre[1] = eta;
        }
      }
    }
    half *= 0.15;
  }
  return best;
}

/* A unit square, sheared, stretched and warped, any way round; some collapsed to a triangle, a line or a point */
static void RandomFacet(PetscRandom r, PetscReal warp, PetscInt kind, PetscReal x[12])
{
  static const PetscReal square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  PetscReal              A[3][2];

  for (PetscInt i = 0; i < 6; ++i) A[i / 2][i % 2] = Random(r, -1, 1);
  for (PetscInt i = 0; i < 12; ++i)
    x[i] =
      A[i % 3][0] * square[i / 3][0] + A[i % 3][1] * square[i / 3][1] + Random(r, -0.1, 0.1) + warp * Random(r, -1, 1);
  for (PetscInt a = 0; a < kind; ++a) {
    for (PetscInt c = 0; c < 3; ++c) x[3 * (a + 1) + c] = x[c];
  }
}

/* No point of the facet is closer, the parameters give the point, the point the distance */
static PetscErrorCode TestClosest(PetscRandom r, PetscReal warp, PetscReal height, PetscInt kind, const char what[])
{
  PetscReal farther = 0.0, inconsistent = 0.0;

  PetscFunctionBeginUser;
  for (PetscInt trial = 0; trial < 1000; ++trial) {
    PetscReal       x[12], p[3], xi[2], y[3], z[3], d;
    const PetscReal s = Random(r, -1.5, 1.5), t = Random(r, -1.5, 1.5), shift = trial % 2 ? 1000.0 : 0.0;

    RandomFacet(r, warp, kind, x);
    Point(x, s, t, p);
    for (PetscInt c = 0; c < 3; ++c) p[c] += height * Random(r, -1, 1) + shift;
    for (PetscInt i = 0; i < 12; ++i) x[i] += shift;
    d            = ContactClosestPoint(x, p, xi, y);
    farther      = PetscMax(farther, d - Exhaustive(x, p));
    inconsistent = PetscMax(inconsistent, PetscAbsReal(d - Distance(y, p)));
    Point(x, xi[0], xi[1], z);
    inconsistent = PetscMax(inconsistent, Distance(y, z));
    if (PetscMax(PetscAbsReal(xi[0]), PetscAbsReal(xi[1])) > 1.0 || PetscIsInfOrNanReal(d))
      inconsistent = PETSC_MAX_REAL;
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", what));
  PetscCall(Report("  a closer point", farther, 1e-9));
  PetscCall(Report("  point, parameters and distance", inconsistent, 1e-11));
  PetscFunctionReturn(0);
}

/* Points on a facet, its edges and vertices included, are their own closest points */
static PetscErrorCode TestOnFacet(PetscRandom r)
{
  PetscReal error = 0.0, parameters = 0.0;

  PetscFunctionBeginUser;
  for (PetscInt trial = 0; trial < 2000; ++trial) {
    PetscReal x[12], p[3], xi[2], y[3], st[2];

    RandomFacet(r, 0.05, 0, x);
    for (PetscInt d = 0; d < 2; ++d) st[d] = trial % 4 ? Random(r, -1, 1) : (PetscReal)(trial / 4 % 3 - 1);
    if (trial % 8 == 5) st[0] = -1.0;
    if (trial % 8 == 6) st[1] = 1.0;
    Point(x, st[0], st[1], p);
    error = PetscMax(error, ContactClosestPoint(x, p, xi, y));
    Point(x, xi[0], xi[1], y);
    parameters = PetscMax(parameters, Distance(p, y));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "points on the facet\n"));
  PetscCall(Report("  distance", error, 1e-12));
  PetscCall(Report("  parameters", parameters, 1e-12));
  PetscFunctionReturn(0);
}

/* A wavy surface of n x n facets that look up */
static PetscErrorCode CreateWavy(PetscInt n, ContactCandidates *facets)
{
  static const PetscInt corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

  PetscFunctionBeginUser;
  facets->n      = n * n;
  facets->node   = NULL;
  facets->border = NULL;
  PetscCall(PetscMalloc1(12 * facets->n, &facets->x));
  for (PetscInt f = 0; f < n * n; ++f) {
    for (PetscInt a = 0; a < 4; ++a) {
      const PetscReal s = (PetscReal)(f % n + corner[a][0]) / (PetscReal)n,
                      t = (PetscReal)(f / n + corner[a][1]) / (PetscReal)n;
      PetscReal *x      = &facets->x[12 * f + 3 * a];

      x[0] = s;
      x[1] = t;
      x[2] = 0.1 * PetscSinReal(7.0 * s) * PetscCosReal(5.0 * t);
    }
  }
  PetscFunctionReturn(0);
}

/* The nearest facet that faces the vertex, among all; none beyond reach */
static PetscErrorCode TestNearest(PetscRandom r)
{
  const PetscReal   cosine = -0.174, reach = 0.2;
  ContactCandidates facets;
  ContactTree       tree;
  PetscReal         error = 0.0;
  PetscInt          wrong = 0, nfound = 0;

  PetscFunctionBeginUser;
  PetscCall(CreateWavy(40, &facets));
  PetscCall(ContactTreeCreate(&facets, &tree));
  for (PetscInt trial = 0; trial < 400; ++trial) {
    const PetscReal x[3] = {Random(r, -0.2, 1.2), Random(r, -0.2, 1.2), Random(r, -0.3, 0.3)};
    PetscReal       n[3] = {Random(r, -1, 1), Random(r, -1, 1), Random(r, -2, 0.5)}, best = PETSC_MAX_REAL,
              length = PetscSqrtReal(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    ContactNearest nearest;

    for (PetscInt c = 0; c < 3; ++c) n[c] /= length;
    for (PetscInt f = 0; f < facets.n; ++f) {
      PetscReal m[3], xi[2], y[3];

      PetscCheck(ContactFacetNormal(&facets.x[12 * f], m), PETSC_COMM_SELF, PETSC_ERR_PLIB, "A facet has no normal");
      if (m[0] * n[0] + m[1] * n[1] + m[2] * n[2] > cosine) continue;
      best = PetscMin(best, ContactClosestPoint(&facets.x[12 * f], x, xi, y));
    }
    ContactFindNearest(&tree, &facets, cosine, reach, x, n, NULL, NULL, &nearest);
    wrong += (nearest.facet >= 0) != (best <= reach);
    if (nearest.facet < 0) continue;
    ++nfound;
    error = PetscMax(error, PetscAbsReal(Distance(nearest.y, x) - best));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "nearest of many facets: %s found, %" PetscInt_FMT " wrong\n",
    nfound > 100 ? "more than 100" : "too few", wrong));
  PetscCall(Report("  distance", error, 1e-14));
  PetscCall(ContactTreeDestroy(&tree));
  PetscCall(PetscFree(facets.x));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscRandom r;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscRandomCreate(PETSC_COMM_SELF, &r));
  PetscCall(TestClosest(r, 0.0, 0.3, 0, "nearly plane facets"));
  PetscCall(TestClosest(r, 0.3, 0.3, 0, "warped facets"));
  PetscCall(TestClosest(r, 1.0, 3.0, 0, "badly warped facets, points far away"));
  PetscCall(TestClosest(r, 0.1, 0.3, 1, "triangles"));
  PetscCall(TestClosest(r, 0.1, 0.3, 2, "lines"));
  PetscCall(TestClosest(r, 0.1, 0.3, 3, "single points"));
  PetscCall(TestOnFacet(r));
  PetscCall(TestNearest(r));
  PetscCall(PetscRandomDestroy(&r));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:

TEST*/
