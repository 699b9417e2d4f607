static char help[] = "Gap of surfaces in awkward places: curved, sliding, off an edge, in several pairs, looking away, "
                     "overlapping, touching, never meeting.\n";

#include "../lib/contact_problem.h"

/* Motion of every body: rotation about y through a point of the body, then a shift */
typedef struct {
  PetscReal angle[3], centre[3][3], shift[3][3];
} Motion;

static void MotionField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  const Motion   *m = (const Motion *)ctx;
  const PetscReal c = PetscCosReal(m->angle[body]), s = PetscSinReal(m->angle[body]), dx = x[0] - m->centre[body][0],
                  dz = x[2] - m->centre[body][2];

  u[0] = c * dx + s * dz - dx + m->shift[body][0];
  u[1] = m->shift[body][1];
  u[2] = -s * dx + c * dz - dz + m->shift[body][2];
}

static PetscErrorCode LinearizeAt(DM dm, PetscInt npairs, const SceneContactPair pairs[], Field field, const void *ctx,
  ContactLinearization *lin)
{
  Contact contact;
  Vec     u;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(SetField(dm, field, ctx, u));
  PetscCall(ContactCreate(dm, npairs, pairs, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

/* A slab, a block above its middle, and a thin plate beside it, all of height 0 where they may meet */
static PetscErrorCode CreateBodies(DM *dm)
{
  Box box[3] = {
    {"slab", {0, 0, -1}, {8, 2, 0}, {16, 4, 2}},
    {"block", {3.1, 0.3, 0}, {4.3, 1.5, 1}, {3, 3, 2}},
    {"plate", {5.15, 0.3, 0}, {6.35, 1.5, 0.1}, {5, 4, 1}},
  };

  PetscFunctionBeginUser;
  PetscCall(CreateBoxes(PETSC_COMM_WORLD, 3, box, 0, dm));
  PetscFunctionReturn(0);
}

/* Part of each row's vertex that is covered: J times a unit motion of the nonmortar body along its outward normal,
   negated */
static PetscErrorCode GetCover(DM dm, ContactLinearization lin, const Motion *outward, Vec *cover)
{
  Vec v;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, &v));
  PetscCall(SetField(dm, MotionField, outward, v));
  PetscCall(VecDuplicate(lin->g, cover));
  PetscCall(MatMult(lin->J, v, *cover));
  PetscCall(VecScale(*cover, -1.0));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(0);
}

/* The block slides along the slab over many facets, wherever it is the gap is the same and every vertex has its row */
static PetscErrorCode TestSliding(DM dm)
{
  const SceneContactPair pair   = {.name = "pair", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR};
  const Motion           down   = {.shift = {{0}, {0, 0, -1}, {0}}};
  Motion                 motion = {.shift = {{0}, {0, 0, 0.1}, {0}}};
  ContactLinearization   lin;
  Vec                    cover;
  PetscReal              gap = 0.0, rows = 0.0;
  PetscInt               m, wrong        = 0;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k <= 12; ++k) {
    motion.shift[1][0] =
      -3.1 + 0.4 * (PetscReal)k + (k % 3 == 1 ? 1e-12 : 0.0); /* aligned with the slab's facets at times, or almost */
    PetscCall(LinearizeAt(dm, 1, &pair, MotionField, &motion, &lin));
    PetscCall(MatGetSize(lin->J, &m, NULL));
    wrong += m != 16;
    PetscCall(Deviation(lin, lin->g, -1, 0.1, &gap));
    PetscCall(GetCover(dm, lin, &down, &cover));
    PetscCall(Deviation(lin, cover, -1, 1.0, &rows));
    PetscCall(VecDestroy(&cover));
    PetscCall(ContactLinearizationDestroy(&lin));
  }
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "sliding over many facets: %" PetscInt_FMT " wrong numbers of rows\n", wrong));
  PetscCall(Report("  gap", gap, 1e-12));
  PetscCall(Report("  rows", rows, 1e-11)); /* slivers are left out */
  PetscFunctionReturn(0);
}

/* The block hangs over the slab's end by so much: rows and gaps stay in proportion to what is covered */
static PetscErrorCode TestEdge(DM dm, PetscReal hang)
{
  const SceneContactPair pair = {.name = "pair", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR};
  const Motion         down = {.shift = {{0}, {0, 0, -1}, {0}}}, motion = {.shift = {{0}, {3.7 + hang, 0, -0.05}, {0}}};
  ContactLinearization lin;
  Vec                  cover;
  PetscReal            gap = 0.0, least, most;
  PetscInt             m;

  PetscFunctionBeginUser;
  PetscCall(LinearizeAt(dm, 1, &pair, MotionField, &motion, &lin));
  PetscCall(MatGetSize(lin->J, &m, NULL));
  PetscCall(GetCover(dm, lin, &down, &cover));
  PetscCall(VecMin(cover, NULL, &least));
  PetscCall(VecMax(cover, NULL, &most));
  PetscCall(VecAXPY(lin->g, 0.05, cover));
  PetscCall(Deviation(lin, lin->g, -1, 0.0, &gap));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "hanging over the edge by %.10g: %" PetscInt_FMT " rows\n", (double)hang, m));
  if (m) {
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  cover between %.4g and %.4g\n", (double)least, (double)most));
    PetscCall(Report("  gap by cover", gap / least, 1e-9));
  }
  PetscCall(VecDestroy(&cover));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/* Rows of a pair and its gap, which is constant */
static PetscErrorCode PrintPair(ContactLinearization lin, PetscInt pair, PetscReal gap, const char what[])
{
  PetscInt  n;
  PetscReal error = 0.0;

  PetscFunctionBeginUser;
  PetscCall(CountPairRows(lin, pair, &n));
  PetscCall(Deviation(lin, lin->g, pair, gap, &error));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %" PetscInt_FMT " rows, gap %g: %s\n", what, n, (double)gap,
    error <= 1e-12 ? "exact" : "WRONG"));
  PetscFunctionReturn(0);
}

/* One body in three pairs, two faces in two of them each, as mortar and as nonmortar; each pair as it is alone */
static PetscErrorCode TestSeveral(DM dm)
{
  const SceneContactPair pairs[4] = {
    {.name = "block in slab", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR},
    {.name = "plate on slab", .mortar = "slab.zmax", .nonmortar = "plate.zmin", .gap = GAP_NODE},
    {.name = "beside", .mortar = "block.xmax", .nonmortar = "plate.xmin", .gap = GAP_MORTAR, .distance = 2.0},
    {.name = "plate on slab", .mortar = "plate.zmin", .nonmortar = "slab.zmax", .gap = GAP_MORTAR},
  };
  const Motion         motion = {.shift = {{0}, {0, 0, -0.03}, {0, 0, -0.02}}};
  ContactLinearization all, one;
  PetscInt             wrong = 0;

  PetscFunctionBeginUser;
  PetscCall(LinearizeAt(dm, 4, pairs, MotionField, &motion, &all));
  PetscCall(PrintPair(all, 0, -0.03, "block in slab"));
  PetscCall(PrintPair(all, 1, -0.02, "plate in slab"));
  for (PetscInt p = 0; p < 4; ++p) {
    PetscInt    n, m;
    PetscScalar sum[2] = {0, 0};

    PetscCall(LinearizeAt(dm, 1, &pairs[p], MotionField, &motion, &one));
    PetscCall(CountPairRows(all, p, &n));
    PetscCall(MatGetSize(one->J, &m, NULL));
    for (PetscInt k = 0; k < 2; ++k) {
      const ContactLinearization lin = k ? one : all;
      const PetscScalar         *g, *mass;

      PetscCall(VecGetArrayRead(lin->g, &g));
      PetscCall(VecGetArrayRead(lin->mass, &mass));
      for (PetscInt i = 0; i < lin->nlocal; ++i) sum[k] += k || lin->pair[i] == p ? mass[i] * g[i] : 0.0;
      PetscCall(VecRestoreArrayRead(lin->mass, &mass));
      PetscCall(VecRestoreArrayRead(lin->g, &g));
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_SCALAR, MPIU_SUM, PETSC_COMM_WORLD));
    wrong += n != m || PetscAbsScalar(sum[0] - sum[1]) > 1e-13;
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  pair %" PetscInt_FMT ": %" PetscInt_FMT " rows\n", p, n));
    PetscCall(ContactLinearizationDestroy(&one));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "pairs that differ from the pair alone: %" PetscInt_FMT "\n", wrong));
  PetscCall(ContactLinearizationDestroy(&all));
  PetscFunctionReturn(0);
}

/* Rows of a pair at a motion, on every rank: as many as expected? */
static PetscErrorCode CountRows(DM dm, const SceneContactPair *pair, const Motion *motion, const char what[])
{
  ContactLinearization lin;
  PetscInt             m, n, N;
  Vec                  x, y;

  PetscFunctionBeginUser;
  PetscCall(LinearizeAt(dm, 1, pair, MotionField, motion, &lin));
  PetscCall(MatGetSize(lin->J, &m, &n));
  PetscCall(MatCreateVecs(lin->J, &x, &y));
  PetscCall(VecSet(x, 1.0));
  PetscCall(MatMultTranspose(lin->J, y, x));
  PetscCall(MatMult(lin->J, x, y));
  PetscCall(VecGetSize(lin->g, &N));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %" PetscInt_FMT " rows%s\n", what, m,
    N == m ? "" : ", but another number of gaps"));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/* Faces that do not look at one another, or are too far, never pair; neither do those that see one another through a
   body */
static PetscErrorCode TestAway(DM dm)
{
  const SceneContactPair
    opposite = {.name = "pair", .mortar = "plate.zmin", .nonmortar = "plate.zmax", .gap = GAP_MORTAR, .distance = 1.0},
    same     = {.name = "pair", .mortar = "slab.zmax", .nonmortar = "plate.zmax", .gap = GAP_MORTAR},
    through  = {.name = "pair", .mortar = "slab.zmin", .nonmortar = "block.zmax", .gap = GAP_MORTAR, .distance = 3.0},
    on       = {.name = "pair", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR};
  SceneContactPair near   = on;
  Motion           motion = {.centre = {{0}, {3.7, 0, 0}, {0}}};

  PetscFunctionBeginUser;
  PetscCall(CountRows(dm, &opposite, &motion, "opposite sides of a plate"));
  PetscCall(CountRows(dm, &same, &motion, "faces that look the same way"));
  PetscCall(CountRows(dm, &through, &motion, "a face seen through a body"));
  motion.angle[1] = 79.0 * PETSC_PI / 180.0;
  PetscCall(CountRows(dm, &on, &motion, "turned by 79 degrees"));
  motion.angle[1] = 81.0 * PETSC_PI / 180.0;
  PetscCall(CountRows(dm, &on, &motion, "turned by 81 degrees"));
  motion.angle[1]    = 0.0;
  motion.shift[1][2] = 0.2;
  PetscCall(CountRows(dm, &on, &motion, "gap 0.2"));
  near.distance = 0.19;
  PetscCall(CountRows(dm, &near, &motion, "gap 0.2, distance 0.19"));
  motion.shift[1][2] = 2.0;
  PetscCall(CountRows(dm, &on, &motion, "gap 2"));
  near.distance = 2.1;
  PetscCall(CountRows(dm, &near, &motion, "gap 2, distance 2.1"));
  motion.shift[1][2] = 1e6;
  PetscCall(CountRows(dm, &on, &motion, "gap 1e6"));
  motion.shift[1][0] = 20.0;
  motion.shift[1][2] = 0.0;
  PetscCall(CountRows(dm, &on, &motion, "beside the slab"));
  PetscFunctionReturn(0);
}

/* From one element deep to exact touch and a gap of rounding */
static PetscErrorCode TestOverlap(DM dm)
{
  static const PetscReal gaps[] = {-0.45, -0.25, -0.05, -1e-14, 0.0, 1e-14};
  SceneContactPair       pair   = {.name = "pair", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR};
  Motion                 motion = {.angle = {0}};
  ContactLinearization   lin;

  PetscFunctionBeginUser;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(gaps); ++k) {
    char what[32];

    motion.shift[1][2] = gaps[k];
    PetscCall(PetscSNPrintf(what, sizeof(what), "overlap %g", (double)(0.0 - gaps[k])));
    PetscCall(LinearizeAt(dm, 1, &pair, MotionField, &motion, &lin));
    PetscCall(PrintPair(lin, 0, gaps[k], what));
    PetscCall(ContactLinearizationDestroy(&lin));
  }
  motion.shift[1][2] = -0.9;
  PetscCall(CountRows(dm, &pair, &motion, "deeper than the body is thick"));
  motion.shift[1][2] = -0.45;
  pair.distance      = 0.5;
  PetscCall(CountRows(dm, &pair, &motion, "overlap 0.45, distance 0.5"));
  motion.shift[1][2] = -0.9;
  pair.distance      = 3.0;
  PetscCall(CountRows(dm, &pair, &motion, "overlap 0.9, distance 3"));
  PetscFunctionReturn(0);
}

/* Boxes about z = 0 bent around a cylinder or a sphere of this radius; body 1 lies outside, lifted by the gap and
   turned */
typedef struct {
  PetscReal radius, gap, turn;
  PetscBool sphere;
} Bend;

static void BendField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal y[3])
{
  const Bend     *b = (const Bend *)ctx;
  const PetscReal r = b->radius + x[2] + (body ? b->gap : 0.0), s = PetscTanReal(x[0] + (body ? b->turn : 0.0)),
                  t = b->sphere ? PetscTanReal(x[1]) : 0.0, length = PetscSqrtReal(1.0 + s * s + t * t);

  y[0] = r * s / length;
  y[1] = b->sphere ? r * t / length : x[1];
  y[2] = r / length;
}

/* Largest error of the gap, away from the outline of the nonmortar face if there is one */
static PetscErrorCode BentError(Bend *bend, PetscInt refine, PetscReal *error, PetscInt *m)
{
  const SceneContactPair pair = {.name = "pair", .mortar = "inner.zmax", .nonmortar = "outer.zmin", .gap = GAP_MORTAR};
  const Motion           rest = {.angle = {0}};
  Box                    box[2] = {
                       {"inner", {-0.6, -0.6, -0.3}, {0.6, 0.6, 0.0}, {6, 5, 1}},
                       {"outer", {-0.3, -0.3, 0.0}, {0.3, 0.3, 0.3}, {4, 4, 1}},
  };
  DM                   dm;
  ContactLinearization lin;

  PetscFunctionBeginUser;
  *error = 0.0;
  PetscCall(CreateBoxes(PETSC_COMM_WORLD, 2, box, refine, &dm));
  PetscCall(SetPlaces(dm, BendField, bend));
  PetscCall(LinearizeAt(dm, 1, &pair, MotionField, &rest, &lin));
  PetscCall(MatGetSize(lin->J, m, NULL));
  PetscCall(Deviation(lin, lin->g, -1, bend->gap, error));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* Curved surfaces that do not match: the gap converges to the one between the surfaces, with the square of the mesh
   size */
static PetscErrorCode TestBent(PetscBool sphere, PetscReal gap)
{
  Bend      bend     = {.radius = 2.0, .gap = gap, .sphere = sphere};
  PetscReal worst[3] = {0, 0, 0};
  PetscInt  wrong    = 0;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; ++k) {
    bend.turn = k ? 0.07 : -0.12;
    for (PetscInt refine = 0; refine < 3; ++refine) {
      const PetscInt n = 4 * (1 << refine) + 1;
      PetscReal      error;
      PetscInt       m;

      PetscCall(BentError(&bend, refine, &error, &m));
      worst[refine] = PetscMax(worst[refine], error);
      wrong += m != n * n;
    }
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, gap %g: %" PetscInt_FMT " wrong numbers of rows, order of the gap %s\n",
    sphere ? "spheres" : "cylinders", (double)gap, wrong,
    worst[1] < 0.35 * worst[0] && worst[2] < 0.35 * worst[1] ? "at least 1.5" : "TOO SMALL"));
  if (wrong || worst[2] > 0.005)
    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "  errors %g %g %g\n", (double)worst[0], (double)worst[1], (double)worst[2]));
  PetscFunctionReturn(0);
}

/* A smooth deformation that bends, twists and slides everything, the bodies differently */
static void WavyField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  const PetscReal a = *(const PetscReal *)ctx;

  u[0] = a * PetscSinReal(1.3 * x[0] + 2.0 * x[1] + (body ? 1.0 : 0.0));
  u[1] = a * PetscCosReal(0.5 * x[1] * x[0] + x[2]);
  u[2] = a * PetscSinReal(0.9 * x[0] + x[1] * x[1] + (body ? 0.3 : 0.0));
}

/* Touching bodies: g(u + t v) - g(u) - t J v falls with the square of t where J is the derivative */
static PetscErrorCode TestTaylor(DM dm, PetscInt npairs, const SceneContactPair pairs[], const char what[])
{
  const PetscReal      none = 0.0, one = 1.0;
  PetscReal            remainder[3], norm;
  ContactLinearization lin, moved;
  Vec                  v, Jv;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, &v));
  PetscCall(SetField(dm, WavyField, &one, v));
  PetscCall(LinearizeAt(dm, npairs, pairs, WavyField, &none, &lin));
  PetscCall(VecDuplicate(lin->g, &Jv));
  for (PetscInt k = 0; k < 3; ++k) {
    const PetscReal t = PetscPowRealInt(10.0, -(int)k - 2);

    PetscCall(LinearizeAt(dm, npairs, pairs, WavyField, &t, &moved));
    PetscCall(MatMult(lin->J, v, Jv));
    PetscCall(VecNorm(Jv, NORM_INFINITY, &norm));
    PetscCall(VecAYPX(Jv, -t, moved->g));
    PetscCall(VecAXPY(Jv, -1.0, lin->g));
    PetscCall(VecNorm(Jv, NORM_INFINITY, &remainder[k]));
    PetscCall(ContactLinearizationDestroy(&moved));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "remainder of the linearized gap, %s:", what));
  for (PetscInt k = 0; k < 2; ++k) {
    const PetscReal order = PetscLog10Real(remainder[k] / remainder[k + 1]);

    PetscCall(PetscPrintf(PETSC_COMM_WORLD, " order %s", order > 1.9 ? "2" : order > 0.9 ? "1" : "0"));
  }
  PetscCall(PetscInfo(NULL, "remainders %g %g %g beside %g\n", (double)remainder[0], (double)remainder[1],
    (double)remainder[2], (double)norm));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "\n"));
  PetscCall(VecDestroy(&Jv));
  PetscCall(VecDestroy(&v));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscFunctionReturn(0);
}

/* On planes, and on curved faces of the same vertices */
static PetscErrorCode TestTaylorAll(DM dm)
{
  const SceneContactPair pairs[2] =
    {{.name = "pair", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR},
      {.name = "pair", .mortar = "slab.zmax", .nonmortar = "plate.zmin", .gap = GAP_MORTAR}},
                         bent = {.name = "pair", .mortar = "inner.zmax", .nonmortar = "outer.zmin", .gap = GAP_MORTAR};
  Bend bend                   = {.radius = 2.0};
  Box  box[2]                 = {
                     {"inner", {-0.6, -0.6, -0.3}, {0.6, 0.6, 0.0}, {12, 4, 1}},
                     {"outer", {-0.3, -0.6, 0.0}, {0.3, 0.6, 0.3}, {6, 4, 1}},
  };
  DM curved;

  PetscFunctionBeginUser;
  PetscCall(TestTaylor(dm, 2, pairs, "planes"));
  PetscCall(CreateBoxes(PETSC_COMM_WORLD, 2, box, 0, &curved));
  PetscCall(SetPlaces(curved, BendField, &bend));
  PetscCall(TestTaylor(curved, 1, &bent, "curved matching faces"));
  PetscCall(DMDestroy(&curved));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static const PetscReal hang[] = {0.2, 0.6, 1.0, 1.19, 1.1999, 1.2 - 1e-9, 1.2, 1.3};
  DM                     dm;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(CreateBodies(&dm));
  PetscCall(TestSliding(dm));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(hang); ++k) PetscCall(TestEdge(dm, hang[k]));
  PetscCall(TestSeveral(dm));
  PetscCall(TestAway(dm));
  PetscCall(TestOverlap(dm));
  PetscCall(TestTaylorAll(dm));
  PetscCall(DMDestroy(&dm));
  PetscCall(TestBent(PETSC_FALSE, 0.0));
  PetscCall(TestBent(PETSC_TRUE, 0.1));
  PetscCall(TestBent(PETSC_TRUE, -0.05));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: mortar
      nsize: {{1 2 3}}
      args: -contact_gap mortar
      output_file: output/contact_surfaces_mortar.out

   test:
      suffix: node
      nsize: {{1 2 3}}
      args: -contact_gap node
      output_file: output/contact_surfaces_node.out

TEST*/
