static char help[] = "The gap of smooth surfaces: patches on cylinders and spheres, curved faces that do not match, "
                     "planes, rigid motions, forces, finite differences.\n";

#include "../lib/contact_problem.h"
#include "src/contact/contactimpl.h"

typedef enum { TUBES, BALLS, NSHAPES } Bodies;
static const char *const shape_names[] = {"tubes", "balls"};

/* A point of the unit cylinder along z or of the unit sphere, and its normal */
static void Curved(PetscBool sphere, PetscReal s, PetscReal t, PetscReal x[3], PetscReal n[3])
{
  n[0] = PetscCosReal(s) * (sphere ? PetscCosReal(t) : 1.0);
  n[1] = PetscSinReal(s) * (sphere ? PetscCosReal(t) : 1.0);
  n[2] = sphere ? PetscSinReal(t) : 0.0;
  for (PetscInt c = 0; c < 3; ++c) x[c] = n[c];
  if (!sphere) x[2] = t;
}

/* Largest distance of one facet of size h, and of its patch, from the surface it stands for */
static void PatchError(PetscBool sphere, PetscReal h, PetscReal *facet, PetscReal *smooth)
{
  static const PetscReal corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  PetscReal              x[12], n[12];
  ContactPatch           patch;

  for (PetscInt a = 0; a < 4; ++a) Curved(sphere, 0.3 + h * corner[a][0], 0.2 + h * corner[a][1], &x[3 * a], &n[3 * a]);
  ContactPatchCreate(x, n, &patch);
  *facet = *smooth = 0.0;
  for (PetscInt q = 0; q < 81; ++q) {
    const PetscReal xi[2] = {0.25 * (PetscReal)(q % 9) - 1.0, 0.25 * (PetscReal)(q / 9) - 1.0};
    PetscReal       phi[4], y[3] = {0, 0, 0}, offset[3], normal[3];

    ContactShape(xi, phi);
    for (PetscInt i = 0; i < 12; ++i) y[i % 3] += phi[i / 3] * x[i];
    ContactPatchEvaluate(&patch, xi, offset, normal);
    *facet =
      PetscMax(*facet, PetscAbsReal(PetscSqrtReal(y[0] * y[0] + y[1] * y[1] + (sphere ? y[2] * y[2] : 0.0)) - 1.0));
    for (PetscInt c = 0; c < 3; ++c) y[c] += offset[c];
    *smooth =
      PetscMax(*smooth, PetscAbsReal(PetscSqrtReal(y[0] * y[0] + y[1] * y[1] + (sphere ? y[2] * y[2] : 0.0)) - 1.0));
  }
}

static PetscErrorCode TestPatch(PetscBool sphere)
{
  PetscReal coarse[2], fine[2];

  PetscFunctionBeginUser;
  PatchError(sphere, 0.2, &coarse[0], &coarse[1]);
  PatchError(sphere, 0.1, &fine[0], &fine[1]);
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "patch of a %s\n", sphere ? "sphere" : "cylinder"));
  PetscCall(Report("  facet, order 2", PetscAbsReal(PetscLog2Real(coarse[0] / fine[0]) - 2.0), 0.1));
  PetscCall(Report("  patch, order 4", PetscAbsReal(PetscLog2Real(coarse[1] / fine[1]) - 4.0), 0.1));
  PetscCall(Report("  patch against facet, facets of 0.2", coarse[1] / coarse[0], 0.01));
  PetscFunctionReturn(0);
}

/* Two tubes that touch at radius 1, with so many cells around each and along both */
static PetscErrorCode CreateTubes(PetscInt inner, PetscInt outer, PetscInt along, DM *dm)
{
  const SceneBody tubes[2] = {
    {.name    = (char *)"inner",
      .shape  = SHAPE_TUBE_ARC,
      .cells  = {1, inner, along},
      .curved = PETSC_TRUE,
      .tube   = {2, {0, 0, 0}, {0.5, 1}, {0, 90}, {0, 0.7}}},
    {.name    = (char *)"outer",
      .shape  = SHAPE_TUBE_ARC,
      .cells  = {1, outer, along},
      .curved = PETSC_TRUE,
      .tube   = {2, {0, 0, 0}, {1, 1.5}, {-5, 97}, {-0.1, 1}}},
  };

  PetscFunctionBeginUser;
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, tubes, 0, dm));
  PetscFunctionReturn(0);
}

/* Two bodies whose faces are the same cylinder, or sphere, of radius 1, in n facets and in more */
static PetscErrorCode CreateCurved(Bodies shape, PetscInt n, DM *dm)
{
  const SceneBody balls[2] = {
    {.name    = (char *)"inner",
      .shape  = SHAPE_BALL,
      .cells  = {2 * n, 2 * n, 2 * n},
      .layers = 1,
      .curved = PETSC_TRUE,
      .octant = {.outer = {.radius = 1}}},
    {.name    = (char *)"outer",
      .shape  = SHAPE_SPHERE_SHELL,
      .cells  = {3 * n, 3 * n, 3 * n},
      .layers = 1,
      .curved = PETSC_TRUE,
      .octant = {.inner = {.radius = 1}, .outer = {.radius = 1.5}}},
  };

  PetscFunctionBeginUser;
  if (shape == TUBES) PetscCall(CreateTubes(3 * n, 4 * n, n, dm));
  else PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, balls, 0, dm));
  PetscFunctionReturn(0);
}

static SceneContactPair CurvedPair(Bodies shape, PetscBool swap, GapType gap, PetscBool smooth)
{
  static char inner[2][16] = {"inner.outer", "inner.surface"}, outer[] = "outer.inner";

  return (SceneContactPair){.name = (char *)"pair",
    .mortar                       = swap ? inner[shape] : outer,
    .nonmortar                    = swap ? outer : inner[shape],
    .gap                          = gap,
    .interference_ramp            = PETSC_DECIDE,
    .smooth                       = smooth};
}

/* Both bodies turn and shift together */
static void RigidField(const PetscReal x[3], PETSC_UNUSED PetscInt body, PETSC_UNUSED const void *ctx, PetscReal u[3])
{
  u[0] = -x[0] + 0.6 * x[0] - 0.8 * x[1] + 3.0;
  u[1] = -x[1] + 0.8 * x[0] + 0.6 * x[1] - 2.0;
  u[2] = 1.0;
}

/* The surface becomes another smooth one, the same for both bodies */
static void StretchField(const PetscReal x[3], PETSC_UNUSED PetscInt body, PETSC_UNUSED const void *ctx, PetscReal u[3])
{
  u[0] = 0.3 * x[0];
  u[1] = 0.1 * x[0] * x[1];
  u[2] = 0.1 * x[2] * x[1];
}

/* Another motion for each body, of this size */
static void PartingField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  const PetscReal size = *(const PetscReal *)ctx;

  u[0] = size * (body ? x[0] * x[1] : 1.0 - 0.5 * x[1]);
  u[1] = size * (body ? 0.5 * x[1] * x[1] : x[0]);
  u[2] = size * (body ? x[1] : x[0] * x[2]);
}

static PetscErrorCode LinearizeCurved(DM dm, SceneContactPair pair, Field field, const void *ctx,
  ContactLinearization *lin)
{
  Contact contact;
  Vec     u;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, &u));
  if (field) PetscCall(SetField(dm, field, ctx, u));
  PetscCall(ContactCreate(dm, 1, &pair, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

/* Largest gap of surfaces that are one */
static PetscErrorCode GapError(Bodies shape, PetscInt n, PetscBool swap, GapType gap, PetscBool smooth, Field field,
  PetscReal *error)
{
  DM                   dm;
  ContactLinearization lin;

  PetscFunctionBeginUser;
  PetscCall(CreateCurved(shape, n, &dm));
  PetscCall(LinearizeCurved(dm, CurvedPair(shape, swap, gap, smooth), field, NULL, &lin));
  PetscCall(VecNorm(lin->g, NORM_INFINITY, error));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* Surfaces that stay one: order from n = 4 to 8, and what is left of the facets' error there */
static PetscErrorCode TestGap(Bodies shape, PetscBool swap, GapType gap, const char state[], Field field,
  PetscReal order, PetscReal least)
{
  PetscReal facets, error[2];

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s, %s body nonmortar, %s\n", shape_names[shape], GapTypes[gap],
    swap ? "outer" : "inner", state));
  PetscCall(GapError(shape, 8, swap, gap, PETSC_FALSE, field, &facets));
  for (PetscInt k = 0; k < 2; ++k) PetscCall(GapError(shape, 4 << k, swap, gap, PETSC_TRUE, field, &error[k]));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  order of the gap"));
  PetscCall(Report(", too low", PetscMax(order - PetscLog2Real(error[0] / error[1]), 0.0), 0.0));
  PetscCall(Report("  smooth against facets", error[1] / facets, least));
  PetscFunctionReturn(0);
}

/* |a - b| relative to |b| */
static PetscErrorCode Difference(Vec a, Vec b, PetscReal *difference)
{
  Vec       d;
  PetscReal norm;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(a, &d));
  PetscCall(VecWAXPY(d, -1.0, b, a));
  PetscCall(VecNorm(d, NORM_2, difference));
  PetscCall(VecNorm(b, NORM_2, &norm));
  *difference /= norm;
  PetscCall(VecDestroy(&d));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestRigid(Bodies shape, GapType gap)
{
  DM                   dm;
  ContactLinearization at_rest, moved;
  PetscReal            error;
  const PetscReal      size = 0.01;

  PetscFunctionBeginUser;
  PetscCall(CreateCurved(shape, 3, &dm));
  PetscCall(LinearizeCurved(dm, CurvedPair(shape, PETSC_FALSE, gap, PETSC_TRUE), NULL, &size, &at_rest));
  PetscCall(LinearizeCurved(dm, CurvedPair(shape, PETSC_FALSE, gap, PETSC_TRUE), RigidField, NULL, &moved));
  PetscCall(VecAXPY(moved->g, -1.0, at_rest->g));
  PetscCall(VecNorm(moved->g, NORM_INFINITY, &error));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s\n", shape_names[shape], GapTypes[gap]));
  PetscCall(Report("  gap after a rigid motion", error, 1e-10));
  PetscCall(ContactLinearizationDestroy(&at_rest));
  PetscCall(ContactLinearizationDestroy(&moved));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* Each vertex another way, so that normals turn as well as shift */
static void RoughField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  const PetscReal size = *(const PetscReal *)ctx;

  for (PetscInt c = 0; c < 3; ++c)
    u[c] = size * PetscSinReal(37.0 * x[0] + 53.0 * x[1] + 71.0 * x[2] + 5.0 * (PetscReal)(c + 3 * body));
}

/* The inner body turned about the axis and shifted along it, beyond the border of the other, and the two a little
   apart */
static void SlideField(const PetscReal x[3], PetscInt body, PETSC_UNUSED const void *ctx, PetscReal u[3])
{
  const PetscReal angle = body ? 0.0 : 0.37, size = 0.02;

  PartingField(x, body, &size, u);
  u[0] += (PetscCosReal(angle) - 1.0) * x[0] - PetscSinReal(angle) * x[1];
  u[1] += (PetscCosReal(angle) - 1.0) * x[1] + PetscSinReal(angle) * x[0];
  u[2] += body ? 0.0 : 0.13;
}

/* A curved sheet with an edge of 45 degrees at x = 1 */
static void KinkedPlace(const PetscReal x[3], PETSC_UNUSED PetscInt body, PETSC_UNUSED const void *ctx, PetscReal y[3])
{
  y[0] = x[0];
  y[1] = x[1];
  y[2] = x[2] + 0.1 * x[0] * x[0] + 0.05 * x[0] * x[1] - PetscMax(x[0] - 1.0, 0.0);
}

static PetscErrorCode CreateKinked(PetscInt ntetrahedra, DM *dm)
{
  Box box[2] = {
    {"inner", {0, 0, -1}, {2, 1, 0}, {6, 4, 1}},
    {"outer", {0.25, 0.1, 0}, {1.85, 0.9, 1}, {8, 3, 1}},
  };

  PetscFunctionBeginUser;
  PetscCall(CreateMixedBoxes(PETSC_COMM_WORLD, 2, box, ntetrahedra, 0, dm));
  PetscCall(SetPlaces(*dm, KinkedPlace, NULL));
  PetscFunctionReturn(0);
}

/* A state about which J is tested: a displacement, and a pair */
typedef struct {
  const char      *name;
  Field            field;
  PetscReal        size;
  SceneContactPair pair;
} State;

/* The gap at the state displaced further by epsilon times the rough field */
static PetscErrorCode LinearizeBeside(DM dm, const State *state, PetscReal epsilon, Vec *v, ContactLinearization *lin)
{
  const PetscReal one = 1.0;
  Contact         contact;
  Vec             u;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecDuplicate(u, v));
  PetscCall(SetField(dm, state->field, &state->size, u));
  PetscCall(SetField(dm, RoughField, &one, *v));
  PetscCall(VecAXPY(u, epsilon, *v));
  PetscCall(ContactCreate(dm, 1, &state->pair, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

static void Place(const PetscReal x[3], PETSC_UNUSED PetscInt body, PETSC_UNUSED const void *ctx, PetscReal y[3])
{
  for (PetscInt c = 0; c < 3; ++c) y[c] = x[c];
}

/* Force and moment about the origin that J transmits of a pressure of 1 on all rows, on both bodies together, by the
   sum of their sizes */
static PetscErrorCode ReportBalance(Mat J, Vec mass, Vec x)
{
  Vec                f;
  const PetscScalar *a, *y;
  PetscInt           n;
  PetscReal          sum[7] = {0};

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &f));
  PetscCall(MatMultTranspose(J, mass, f));
  PetscCall(VecGetLocalSize(f, &n));
  PetscCall(VecGetArrayRead(f, &a));
  PetscCall(VecGetArrayRead(x, &y));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt c = i % 3, d = (c + 1) % 3, e = (c + 2) % 3, node = i - c;

    sum[c] += PetscRealPart(a[i]);
    sum[3 + c] += PetscRealPart(y[node + d] * a[node + e] - y[node + e] * a[node + d]);
    sum[6] += PetscAbsScalar(a[i]);
  }
  PetscCall(VecRestoreArrayRead(f, &a));
  PetscCall(VecRestoreArrayRead(x, &y));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 7, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  for (PetscInt k = 0; k < 6; ++k) sum[k] = PetscAbsReal(sum[k]) / sum[6];
  PetscCall(Report("  J, force", PetscMax(PetscMax(sum[0], sum[1]), sum[2]), 1e-12));
  PetscCall(Report("  J, moment", PetscMax(PetscMax(sum[3], sum[4]), sum[5]), 1e-12));
  PetscCall(VecDestroy(&f));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestBalance(DM dm, const State *state)
{
  ContactLinearization lin;
  Vec                  x, v;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s, %s nonmortar\n", state->name, GapTypes[state->pair.gap],
    state->pair.nonmortar));
  PetscCall(LinearizeBeside(dm, state, 0.0, &v, &lin));
  PetscCall(SetField(dm, state->field, &state->size, v));
  PetscCall(VecDuplicate(v, &x));
  PetscCall(SetField(dm, Place, NULL, x));
  PetscCall(VecAXPY(x, 1.0, v));
  PetscCall(ReportBalance(lin->J, lin->mass, x));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&v));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/* Along a displacement that varies over the whole face, J is the derivative but for the bending of its patches: central
   differences of the gap. A part of the difference is left with fourfold facets. */
static PetscErrorCode TestRigidPatches(Bodies shape, GapType gap)
{
  PetscReal error[2];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; ++k) {
    const SceneContactPair pair    = CurvedPair(shape, PETSC_FALSE, gap, PETSC_TRUE);
    const PetscReal        size[2] = {1e-6, -1e-6}, one = 1.0;
    DM                     dm;
    ContactLinearization   lin, moved[2];
    Vec                    v, a;

    PetscCall(CreateCurved(shape, 2 << k, &dm));
    PetscCall(LinearizeCurved(dm, pair, NULL, NULL, &lin));
    for (PetscInt i = 0; i < 2; ++i) PetscCall(LinearizeCurved(dm, pair, PartingField, &size[i], &moved[i]));
    PetscCall(DMCreateGlobalVector(dm, &v));
    PetscCall(SetField(dm, PartingField, &one, v));
    PetscCall(VecDuplicate(lin->g, &a));
    PetscCall(MatMult(lin->J, v, a));
    PetscCall(VecAXPY(moved[0]->g, -1.0, moved[1]->g));
    PetscCall(VecScale(moved[0]->g, 0.5 / size[0]));
    PetscCall(Difference(a, moved[0]->g, &error[k]));
    PetscCall(VecDestroy(&a));
    PetscCall(VecDestroy(&v));
    PetscCall(ContactLinearizationDestroy(&lin));
    for (PetscInt i = 0; i < 2; ++i) PetscCall(ContactLinearizationDestroy(&moved[i]));
    PetscCall(DMDestroy(&dm));
  }
  PetscCall(Report("  J against differences of the gap, facets by 2", error[0], 0.1));
  PetscCall(Report("  and by 4, part left", error[1] / error[0], 0.5));
  PetscFunctionReturn(0);
}

/* The forces that J transmits, bent, slid off one another, and across a sharp edge */
static PetscErrorCode TestJacobian(GapType gap)
{
  const SceneContactPair kinked = {.name = (char *)"pair",
    .mortar                              = (char *)"inner.zmax",
    .nonmortar                           = (char *)"outer.zmin",
    .gap                                 = gap,
    .interference_ramp                   = PETSC_DECIDE,
    .smooth                              = PETSC_TRUE};
  State                  state;
  DM                     dm;

  PetscFunctionBeginUser;
  for (PetscInt s = TUBES; s < NSHAPES; ++s) {
    PetscCall(CreateCurved((Bodies)s, 2, &dm));
    for (PetscInt swap = 0; swap < 2; ++swap) {
      const SceneContactPair pair = CurvedPair((Bodies)s, (PetscBool)swap, gap, PETSC_TRUE);

      state = (State){s ? "balls, bent" : "tubes, bent", PartingField, 0.02, pair};
      PetscCall(TestBalance(dm, &state));
      state = (State){s ? "balls, slid" : "tubes, slid", SlideField, 0.0, pair};
      PetscCall(TestBalance(dm, &state));
    }
    PetscCall(DMDestroy(&dm));
  }
  for (PetscInt tetrahedra = 0; tetrahedra < 3; ++tetrahedra) {
    static const char *const names[] = {"sheets with a sharp edge", "sheets, one of tetrahedra",
      "sheets of tetrahedra"};

    PetscCall(CreateKinked(tetrahedra, &dm));
    state = (State){names[tetrahedra], PartingField, 0.02, kinked};
    PetscCall(TestBalance(dm, &state));
    PetscCall(DMDestroy(&dm));
  }
  PetscFunctionReturn(0);
}

/* With and without smooth surfaces the gap of bodies that are bent is the same to the last bit, or it is not */
static PetscErrorCode Compare(DM dm, const char what[], const char mortar[], const char nonmortar[], GapType gap,
  PetscBool same)
{
  ContactLinearization lin[2];
  const PetscReal      size = 0.02;
  PetscReal            difference;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; ++k)
    PetscCall(LinearizeCurved(dm,
      (SceneContactPair){.name = (char *)"pair",
        .mortar                = (char *)mortar,
        .nonmortar             = (char *)nonmortar,
        .gap                   = gap,
        .interference_ramp     = PETSC_DECIDE,
        .smooth                = (PetscBool)k},
      PartingField, &size, &lin[k]));
  PetscCall(VecAXPY(lin[0]->g, -1.0, lin[1]->g));
  PetscCall(VecNorm(lin[0]->g, NORM_INFINITY, &difference));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s: smooth and facets %s\n", what, GapTypes[gap],
    (difference == 0.0) == same ? (same ? "are the same" : "differ") : (same ? "DIFFER" : "ARE THE SAME")));
  for (PetscInt k = 0; k < 2; ++k) PetscCall(ContactLinearizationDestroy(&lin[k]));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestSharp(GapType gap)
{
  Box box[2] = {
    {"lower", {0, 0, -1}, {4, 2, 0}, {7, 4, 1}},
    {"upper", {1, 0.5, 0}, {3, 1.5, 1}, {5, 3, 1}},
  };
  DM dm;

  PetscFunctionBeginUser;
  PetscCall(CreateBoxes(PETSC_COMM_WORLD, 2, box, 0, &dm));
  PetscCall(Compare(dm, "planes", "lower.zmax", "upper.zmin", gap, PETSC_TRUE));
  PetscCall(DMDestroy(&dm));
  PetscCall(CreateTubes(2, 2, 1, &dm));
  PetscCall(Compare(dm, "edges of 45 degrees and more", "outer.inner", "inner.outer", gap, PETSC_TRUE));
  PetscCall(DMDestroy(&dm));
  PetscCall(CreateTubes(3, 3, 1, &dm));
  PetscCall(Compare(dm, "edges of 30 and 34 degrees", "outer.inner", "inner.outer", gap, PETSC_FALSE));
  PetscCall(PetscOptionsSetValue(NULL, "-contact_smooth", "false"));
  PetscCall(Compare(dm, "the same, smooth switched off", "outer.inner", "inner.outer", gap, PETSC_TRUE));
  PetscCall(PetscOptionsClearValue(NULL, "-contact_smooth"));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (PetscInt sphere = 0; sphere < 2; ++sphere) PetscCall(TestPatch((PetscBool)sphere));
  for (GapType gap = GAP_MORTAR; gap <= GAP_NODE; ++gap) {
    for (PetscInt s = TUBES; s < NSHAPES; ++s) {
      for (PetscInt swap = 0; swap < 2; ++swap) {
        PetscCall(TestGap((Bodies)s, (PetscBool)swap, gap, "undeformed", NULL, 3.7, 0.002));
        /* not fourth order: normals at vertices of three facets, and at the border, are extrapolated to first order
           on what is no sphere */
        PetscCall(TestGap((Bodies)s, (PetscBool)swap, gap, "stretched", StretchField, s == TUBES ? 2.5 : 1.8, 0.06));
      }
      PetscCall(TestRigid((Bodies)s, gap));
      PetscCall(TestRigidPatches((Bodies)s, gap));
    }
    PetscCall(TestJacobian(gap));
    PetscCall(TestSharp(gap));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 3 2}}
      output_file: output/contact_smooth_1.out

TEST*/
