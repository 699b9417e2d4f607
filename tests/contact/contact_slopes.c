static char help[] = "Derivatives of gap and cover over an overlap against central differences, where mesh lines cross "
                     "and where they pass through vertices, and for curved patches that move as rigid bodies.\n";

#include "src/contact/contactimpl.h"
#include "contact_report.h"

static ContactRule rule;

static const ContactOverlapLimits limits = {-0.174, 1e-12, 1e30, 1e30};

/* Both facets' vertices and normals, the nonmortar one's first, and the derivatives of the sums over their overlap by
   all vertices. Patches without normals are flat. */
typedef struct {
  PetscReal x[2][12], normal[2][12];
} Facets;
typedef struct {
  PetscReal gap[4], cover[4], by_gap[4][24], by_cover[4][24];
} Sums;

static PetscBool SumsFind(const Facets *f, Sums *sums)
{
  ContactOverlap o;
  ContactPatch   patch[2];
  ContactSlopes  nonmortar = {.rigid = {{0}}}, mortar;

  if (!ContactOverlapFind(f->x[0], f->x[1], &limits, &rule, &o)) return PETSC_FALSE;
  for (PetscInt side = 0; side < 2; ++side) ContactPatchCreate(f->x[side], f->normal[side], &patch[side]);
  ContactOverlapSlopes(&o, &rule, f->x[0], f->x[1], &patch[0], &patch[1], sums->gap, sums->cover, &nonmortar, &mortar);
  for (PetscInt a = 0; a < 4; ++a) {
    for (PetscInt i = 0; i < 24; ++i) {
      sums->by_gap[a][i]   = i < 12 ? nonmortar.rigid[a][i] : mortar.rigid[a][i - 12];
      sums->by_cover[a][i] = i < 12 ? nonmortar.cover[a][i] : mortar.cover[a][i - 12];
    }
  }
  return PETSC_TRUE;
}

/* A unit square at height 0, seen by the mortar facet q at height 0.1 + slope x, counterclockwise from above */
static Facets FacetsOver(const PetscReal q[4][2], PetscInt first, PetscReal slope)
{
  static const PetscReal square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Facets                 f            = {.x = {{0}}};

  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal *p = square[(a + first) % 4], *r = q[3 - a];
    const PetscReal  x[2][3] = {{p[0], p[1], 0.0}, {r[0], r[1], 0.1 + slope * r[0]}};

    for (PetscInt i = 0; i < 6; ++i) f.x[i / 3][3 * a + i % 3] = x[i / 3][i % 3];
  }
  return f;
}

static PetscErrorCode TestDifferences(const char name[], const PetscReal q[4][2])
{
  const PetscReal step  = 1e-5;
  PetscReal       error = 0.0;

  PetscFunctionBeginUser;
  for (PetscInt first = 0; first < 4; ++first) {
    Facets f = FacetsOver(q, first, 0.3);
    Sums   at, beside[2];

    if (!SumsFind(&f, &at)) error = PETSC_MAX_REAL;
    for (PetscInt i = 0; i < 24; ++i) {
      PetscReal *x = &f.x[i / 12][i % 12], middle = *x;

      for (PetscInt k = 0; k < 2; ++k) {
        *x = middle + (k ? step : -step);
        if (!SumsFind(&f, &beside[k])) error = PETSC_MAX_REAL;
      }
      *x = middle;
      for (PetscInt a = 0; a < 4; ++a) {
        error = PetscMax(error, PetscAbsReal(at.by_gap[a][i] - (beside[1].gap[a] - beside[0].gap[a]) / (2.0 * step)));
        error =
          PetscMax(error, PetscAbsReal(at.by_cover[a][i] - (beside[1].cover[a] - beside[0].cover[a]) / (2.0 * step)));
      }
    }
  }
  PetscCall(Report(name, error, 1e-4));
  PetscFunctionReturn(0);
}

/* Moves the facet of one side along an axis (motion 0 to 2), or turns it with its normals about one (3 to 5), by
   `size` [length or rad] */
static void Move(Facets *f, PetscInt side, PetscInt motion, PetscReal size)
{
  const PetscInt  d = (motion + 1) % 3, e = (motion + 2) % 3;
  const PetscReal c = PetscCosReal(size), s = PetscSinReal(size);

  for (PetscInt a = 0; a < 4; ++a) {
    PetscReal *turned[2] = {&f->x[side][3 * a], &f->normal[side][3 * a]};

    if (motion < 3) turned[0][motion] += size;
    for (PetscInt k = 0; motion >= 3 && k < 2; ++k) {
      const PetscReal p = turned[k][d], q = turned[k][e];

      turned[k][d] = c * p - s * q;
      turned[k][e] = s * p + c * q;
    }
  }
}

/* Curved patches, each of which is moved as a rigid body: the derivative for patches that keep their shape is exact */
static PetscErrorCode TestRigidMotions(const PetscReal q[4][2])
{
  const PetscReal step  = 1e-5;
  PetscReal       error = 0.0;
  Facets          f     = FacetsOver(q, 1, 0.3);
  Sums            at, beside[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 24; i += 3) {
    const PetscReal *x = &f.x[i / 12][i % 12], up = i < 12 ? 1.0 : -1.0,
                    tilt[2] = {0.2 * x[0] - 0.1, 0.3 * x[1] + 0.05},
                    size    = PetscSqrtReal(1.0 + tilt[0] * tilt[0] + tilt[1] * tilt[1]);
    PetscReal *n            = &f.normal[i / 12][i % 12];

    n[0] = tilt[0] / size;
    n[1] = tilt[1] / size;
    n[2] = up / size;
  }
  if (!SumsFind(&f, &at)) error = PETSC_MAX_REAL;
  for (PetscInt m = 0; m < 12; ++m) {
    Facets rate;

    for (PetscInt k = 0; k < 2; ++k) {
      Facets moved = f;

      Move(&moved, m / 6, m % 6, k ? step : -step);
      if (!SumsFind(&moved, &beside[k])) error = PETSC_MAX_REAL;
      for (PetscInt i = 0; i < 24; ++i)
        rate.x[i / 12][i % 12] =
          k ? (moved.x[i / 12][i % 12] - rate.x[i / 12][i % 12]) / (2.0 * step) : moved.x[i / 12][i % 12];
    }
    for (PetscInt a = 0; a < 4; ++a) {
      PetscReal change = 0.0;

      for (PetscInt i = 0; i < 24; ++i) change += at.by_gap[a][i] * rate.x[i / 12][i % 12];
      error = PetscMax(error, PetscAbsReal(change - (beside[1].gap[a] - beside[0].gap[a]) / (2.0 * step)));
    }
  }
  PetscCall(Report("curved patches that move as rigid bodies", error, 1e-6));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static const struct {
    const char *name;
    PetscReal   q[4][2];
  } cases[] = {
    {"lines that cross", {{-0.3, -1}, {0.55, 2}, {-2, 2}, {-2, -1}}},
    {"a line through a vertex", {{-0.25, -1}, {0.5, 2}, {-2, 2}, {-2, -1}}},
    {"a line through two vertices", {{-1, -1}, {2, 2}, {-2, 2}, {-2, -1}}},
    {"a vertex on an edge", {{0, 0.5}, {0.75, -0.25}, {0.75, 1.5}, {0.25, 1.25}}},
    {"two lines through a vertex", {{0, 0}, {0.5, 2}, {-2, 2}, {-2, 0.5}}},
  };

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ContactRuleCreate(4, &rule));
  for (size_t c = 0; c < PETSC_STATIC_ARRAY_LENGTH(cases); ++c) PetscCall(TestDifferences(cases[c].name, cases[c].q));
  PetscCall(TestRigidMotions(cases[0].q));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

  test:

TEST*/
