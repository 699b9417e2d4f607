static char help[] =
  "Linearized gap of meshes: exact gaps, translations, forces and moments, derivative, any number of ranks.\n\
  -cells <n>  : cells of the slab along x at level 0\n\
  -idle_ranks : some rank must own no row, or the test is not what it says\n";

#include "../lib/contact_problem.h"

/* A slab under a block under a plate: non-matching meshes, closed at z = 0 and z = 1, times a length */
static PetscErrorCode CreateMesh(MPI_Comm comm, PetscReal length, PetscInt cells, DM *dm)
{
  Box body[3] = {
    {"slab", {-2.0, -1.5, -1.0}, {2.0, 1.5, 0.0}, {cells, 4, 2}},
    {"block", {-1.1, -0.8, 0.0}, {0.9, 0.7, 1.0}, {3, 3, 2}},
    {"plate", {-1.5, -1.5, 1.0}, {1.5, 1.5, 1.2}, {4, 3, 1}},
  };

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < 3; ++b) {
    for (PetscInt c = 0; c < 3; ++c) {
      body[b].lower[c] *= length;
      body[b].upper[c] *= length;
    }
  }
  PetscCall(CreateBoxes(comm, 3, body, 1, dm));
  PetscFunctionReturn(0);
}

/* Rotation of everything, and the upper bodies lifted by gap before that; then a shift of the lower or the upper
   bodies */
typedef struct {
  PetscReal R[3][3], gap, shift[2][3];
} Rigid;

/* a product of rotations by 0.7 about x and 1.1 about y */
static void SetRotation(Rigid *r)
{
  const PetscReal c = PetscCosReal(0.7), s = PetscSinReal(0.7), C = PetscCosReal(1.1), S = PetscSinReal(1.1);
  const PetscReal R[3][3] = {{C, S * s, S * c}, {0, c, -s}, {-S, C * s, C * c}};

  for (PetscInt i = 0; i < 9; ++i) r->R[i / 3][i % 3] = R[i / 3][i % 3];
}

static void RigidField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  const Rigid    *r    = (const Rigid *)ctx;
  const PetscReal y[3] = {x[0], x[1], x[2] + (body ? r->gap : 0.0)};

  for (PetscInt i = 0; i < 3; ++i)
    u[i] = r->R[i][0] * y[0] + r->R[i][1] * y[1] + r->R[i][2] * y[2] - x[i] + r->shift[body > 0][i];
}

/* The same shift of the lower bodies, of the upper bodies */
static void ShiftField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  (void)x;
  for (PetscInt i = 0; i < 3; ++i) u[i] = ((const Rigid *)ctx)->shift[body > 0][i];
}

/* A field that bends and twists everything; smooth, so that it does not depend on how vertices are numbered */
static void WavyField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal u[3])
{
  const PetscReal a = *(const PetscReal *)ctx;

  u[0] = a * PetscSinReal(3.0 * x[0] + 2.0 * x[1] + (body ? 1.0 : 0.0));
  u[1] = a * PetscCosReal(2.0 * x[1] * x[0] + x[2]);
  u[2] = a * PetscSinReal(2.0 * x[0] + x[1] * x[1] + (body ? 0.3 : 0.0));
}

static const SceneContactPair pairs[2] = {
  {.name = "on slab", .mortar = "slab.zmax", .nonmortar = "block.zmin", .gap = GAP_MORTAR},
  {.name = "on block", .mortar = "block.zmax", .nonmortar = "plate.zmin", .gap = GAP_MORTAR},
};

/* Parallel planes, turned in space: constant gap, rows that add up to the normal, no row for what looks through a
   body */
static PetscErrorCode TestPlanes(DM dm, PetscReal length, PetscReal gap, const char what[])
{
  Rigid                  rigid = {.gap = gap * length}, shift = {.gap = 0.0};
  const SceneContactPair pair = pairs[0];
  Contact                contact;
  ContactLinearization   lin;
  Vec                    u, v, Jv;
  PetscInt               m;
  PetscReal              n[3], error = 0.0, rigidity = 0.0, sum = 0.0;
  char                   name[128];

  PetscFunctionBeginUser;
  SetRotation(&rigid);
  PetscCall(ContactCreate(dm, 1, &pair, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(SetField(dm, RigidField, &rigid, u));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(MatGetSize(lin->J, &m, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %" PetscInt_FMT " rows\n", what, m));
  PetscCall(Deviation(lin, lin->g, -1, rigid.gap, &error));
  PetscCall(PetscSNPrintf(name, sizeof(name), "%s, gap", what));
  PetscCall(Report(name, error / length, 1e-12));
  PetscCall(VecDuplicate(lin->g, &Jv));
  for (PetscInt side = 0; side < 3; ++side) {
    PetscReal expected = 0.0;

    for (PetscInt i = 0; i < 3; ++i) {
      n[i]              = -rigid.R[i][2]; /* outward of the block's underside */
      shift.shift[0][i] = side != 1 ? 0.3 * (PetscReal)(i + 1) : 0.0;
      shift.shift[1][i] = side != 0 ? 0.3 * (PetscReal)(i + 1) : 0.0;
      expected += n[i] * (shift.shift[0][i] - shift.shift[1][i]);
    }
    PetscCall(SetField(dm, ShiftField, &shift, v));
    PetscCall(MatMult(lin->J, v, Jv));
    PetscCall(Deviation(lin, Jv, -1, expected, side == 2 ? &rigidity : &sum));
  }
  PetscCall(PetscSNPrintf(name, sizeof(name), "%s, rows add up to the normal", what));
  PetscCall(Report(name, sum, 1e-12));
  PetscCall(PetscSNPrintf(name, sizeof(name), "%s, common translation", what));
  PetscCall(Report(name, rigidity, 1e-12));
  PetscCall(VecDestroy(&Jv));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscFunctionReturn(0);
}

/* Rows of a pair of faces, none where they look away from each other or through a body */
static PetscErrorCode CountRows(DM dm, char mortar[], char nonmortar[])
{
  const SceneContactPair pair = {.name = "pair", .mortar = mortar, .nonmortar = nonmortar, .gap = GAP_MORTAR};
  Contact                contact;
  ContactLinearization   lin;
  Vec                    u;
  PetscInt               m;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(ContactCreate(dm, 1, &pair, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(MatGetSize(lin->J, &m, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "mortar %s, nonmortar %s: %" PetscInt_FMT " rows\n", mortar, nonmortar, m));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

/* On planes along the axes the normals are exactly the axis: J has no entries for other directions, and none that are
   zero */
static PetscErrorCode CountEntries(ContactLinearization lin)
{
  PetscInt start, end, n[2] = {0, 0};

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(lin->J, &start, &end));
  for (PetscInt i = start; i < end; ++i) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           ncols;

    PetscCall(MatGetRow(lin->J, i, &ncols, &columns, &values));
    for (PetscInt k = 0; k < ncols; ++k) n[columns[k] % 3 != 2 || values[k] == 0.0] += 1;
    PetscCall(MatRestoreRow(lin->J, i, &ncols, &columns, &values));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 2, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "entries along the normal %" PetscInt_FMT ", others %" PetscInt_FMT "\n",
    n[0], n[1]));
  PetscFunctionReturn(0);
}

/* Where the faces touch, the frozen geometry multiplies a gap of zero: J is the derivative of the true gap */
static PetscErrorCode TestDerivative(DM dm)
{
  const PetscReal      one = 1.0, eps = 1e-6;
  Contact              contact;
  ContactLinearization lin, moved;
  Vec                  u, v, Jv, difference;
  PetscReal            error, norm, distance, depth;

  PetscFunctionBeginUser;
  PetscCall(ContactCreate(dm, 2, pairs, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(ContactGetReach(contact, &distance, &depth));
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "least search distance %g, largest depth %g\n", (double)distance, (double)depth));
  PetscCall(CountEntries(lin));
  PetscCall(SetField(dm, WavyField, &one, v));
  PetscCall(VecDuplicate(lin->g, &Jv));
  PetscCall(VecDuplicate(lin->g, &difference));
  PetscCall(MatMult(lin->J, v, Jv));
  for (PetscInt side = 0; side < 2; ++side) {
    PetscCall(VecCopy(v, u));
    PetscCall(VecScale(u, side ? -eps : eps));
    PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &moved));
    PetscCall(VecAXPY(difference, (side ? -0.5 : 0.5) / eps, moved->g));
    PetscCall(ContactLinearizationDestroy(&moved));
  }
  PetscCall(VecAXPY(difference, -1.0, Jv));
  PetscCall(VecNorm(difference, NORM_INFINITY, &error));
  PetscCall(VecNorm(Jv, NORM_INFINITY, &norm));
  PetscCall(Report("derivative of the true gap where closed", error / norm, 1e-5));
  PetscCall(VecDestroy(&difference));
  PetscCall(VecDestroy(&Jv));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscFunctionReturn(0);
}

/* Virtual displacements to weigh forces with: of the slab along the turned z times a power of x or y; of all, a
   rotation */
typedef struct {
  const Rigid *rigid;
  PetscInt     what;
} Virtual;

static void VirtualField(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal v[3])
{
  const Virtual  *w         = (const Virtual *)ctx;
  const PetscReal moment[3] = {1.0, x[0], x[1]};
  PetscReal       u[3];

  if (w->what < 3) {
    for (PetscInt i = 0; i < 3; ++i) v[i] = body ? 0.0 : moment[w->what] * w->rigid->R[i][2];
  } else {
    const PetscInt i = w->what - 3, j = (i + 1) % 3, k = (i + 2) % 3;

    RigidField(x, body, w->rigid, u);
    v[i] = 0.0;
    v[j] = -(x[k] + u[k]);
    v[k] = x[j] + u[j];
  }
}

/* int of x^i y^j over the block's underside */
static PetscReal Moment(PetscInt i, PetscInt j)
{
  const PetscReal x = (PetscPowRealInt(0.9, (int)i + 1) - PetscPowRealInt(-1.1, (int)i + 1)) / (PetscReal)(i + 1);
  const PetscReal y = (PetscPowRealInt(0.7, (int)j + 1) - PetscPowRealInt(-0.8, (int)j + 1)) / (PetscReal)(j + 1);

  return x * y;
}

/* A linear contact pressure: its resultant and (mortar) first moments reach the slab; action is reaction, in force
   and moment */
static PetscErrorCode TestForces(DM dm, PetscBool moments)
{
  const PetscReal      c[3]  = {1.0, 0.5, -0.25}; /* p = c0 + c1 x + c2 y */
  Rigid                rigid = {.gap = 0.0};
  Virtual              w     = {.rigid = &rigid};
  Contact              contact;
  ContactLinearization lin;
  Vec                  u, v, f, p, coordinates;
  const PetscScalar   *x, *mass;
  PetscScalar         *a, work;
  PetscSection         section;
  PetscReal            error = 0.0;

  PetscFunctionBeginUser;
  SetRotation(&rigid);
  PetscCall(ContactCreate(dm, 1, pairs, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(VecDuplicate(u, &f));
  PetscCall(SetField(dm, RigidField, &rigid, u));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(VecDuplicate(lin->g, &p));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  PetscCall(VecGetArray(p, &a));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(section, lin->vertex[i], &offset));
    a[i] = mass[i] * (c[0] + c[1] * x[offset] + c[2] * x[offset + 1]);
  }
  PetscCall(VecRestoreArray(p, &a));
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(MatMultTranspose(lin->J, p, f));
  for (w.what = 0; w.what < 6; ++w.what) {
    const PetscInt  i = w.what == 1, j = w.what == 2;
    const PetscReal expected =
      w.what < 3 ? -(c[0] * Moment(i, j) + c[1] * Moment(i + 1, j) + c[2] * Moment(i, j + 1)) : 0.0;

    if (w.what == 3) {
      PetscCall(
        Report(moments ? "force and moments of a linear pressure" : "force of a linear pressure", error, 1e-12));
      error = 0.0;
    }
    if (!moments && (i || j)) continue;
    PetscCall(SetField(dm, VirtualField, &w, v));
    PetscCall(VecDot(f, v, &work));
    error = PetscMax(error, PetscAbsScalar(work - expected));
  }
  PetscCall(Report("moment of action and reaction where closed", error, 1e-12));
  for (PetscInt d = 0; d < 3; ++d) {
    PetscCall(VecStrideNorm(f, d, NORM_1, &error));
    PetscCall(VecStrideSum(f, d, &work));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "action and reaction along %c: %s\n", 'x' + (int)d,
      PetscAbsScalar(work) <= 1e-13 * error ? "balanced" : "not balanced"));
  }
  PetscCall(VecDestroy(&p));
  PetscCall(VecDestroy(&f));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscFunctionReturn(0);
}

/* What a linearization amounts to, whatever the numbering */
#define NSUMS 7
static PetscErrorCode Sums(MPI_Comm comm, PetscInt cells, PetscReal amplitude, PetscReal sums[NSUMS])
{
  const PetscReal      one = 1.0;
  DM                   dm;
  Contact              contact;
  ContactLinearization lin;
  Vec                  u, v, Jv, Jtg;
  PetscInt             m;
  MatInfo              info;
  PetscScalar          s;

  PetscFunctionBeginUser;
  PetscCall(CreateMesh(comm, 1.0, cells, &dm));
  PetscCall(ContactCreate(dm, 2, pairs, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(VecDuplicate(u, &Jtg));
  PetscCall(SetField(dm, WavyField, &amplitude, u));
  PetscCall(SetField(dm, WavyField, &one, v));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(VecDuplicate(lin->g, &Jv));
  PetscCall(MatMult(lin->J, v, Jv));
  PetscCall(MatMultTranspose(lin->J, lin->g, Jtg));
  PetscCall(MatGetSize(lin->J, &m, NULL));
  PetscCall(MatGetInfo(lin->J, MAT_GLOBAL_SUM, &info));
  sums[0] = (PetscReal)m;
  sums[1] = info.nz_used;
  PetscCall(VecNorm(lin->g, NORM_2, &sums[2]));
  PetscCall(MatNorm(lin->J, NORM_FROBENIUS, &sums[3]));
  PetscCall(VecNorm(Jv, NORM_2, &sums[4]));
  PetscCall(VecNorm(Jtg, NORM_2, &sums[5]));
  PetscCall(VecDot(lin->mass, lin->g, &s));
  sums[6] = PetscRealPart(s);
  PetscCall(VecDestroy(&Jv));
  PetscCall(VecDestroy(&Jtg));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* Whether a rank owns no row of the deformed bodies */
static PetscErrorCode CheckIdleRanks(DM dm)
{
  Contact              contact;
  ContactLinearization lin;
  Vec                  u;
  PetscInt             fewest;
  PetscBool            idle = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-idle_ranks", &idle, NULL));
  if (!idle) PetscFunctionReturn(0);
  PetscCall(ContactCreate(dm, 2, pairs, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCallMPI(MPI_Allreduce(&lin->nlocal, &fewest, 1, MPIU_INT, MPI_MIN, PETSC_COMM_WORLD));
  PetscCheck(fewest == 0, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "Every rank owns a contact row, at least %" PetscInt_FMT,
    fewest);
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

/* Contact without any pair has no rows */
static PetscErrorCode TestNoPairs(DM dm)
{
  Contact              contact;
  ContactLinearization lin;
  Vec                  u;
  PetscInt             m, n, N;

  PetscFunctionBeginUser;
  PetscCall(ContactCreate(dm, 0, NULL, &contact));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecGetSize(u, &N));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(MatGetSize(lin->J, &m, &n));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "no pairs: %" PetscInt_FMT " rows, %s\n", m,
    n == N ? "a column an unknown" : "wrong number of columns"));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestRanks(PetscInt cells)
{
  PetscReal here[NSUMS], alone[NSUMS], error = 0.0;

  PetscFunctionBeginUser;
  PetscCall(Sums(PETSC_COMM_WORLD, cells, 0.04, here));
  PetscCall(Sums(PETSC_COMM_SELF, cells, 0.04, alone));
  for (PetscInt k = 0; k < NSUMS; ++k) error = PetscMax(error, PetscAbsReal(here[k] / alone[k] - 1.0));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "deformed bodies: %" PetscInt_FMT " rows\n", (PetscInt)here[0]));
  PetscCall(Report("all ranks against one", error, 1e-12));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM       dm;
  PetscInt cells = 7;
  GapType  gap   = GAP_MORTAR;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-cells", &cells, NULL));
  PetscCall(PetscOptionsGetEnum(NULL, NULL, "-contact_gap", GapTypes, (PetscEnum *)&gap, NULL));
  PetscCall(CreateMesh(PETSC_COMM_WORLD, 1.0, cells, &dm));
  PetscCall(TestPlanes(dm, 1.0, 0.0, "closed"));
  PetscCall(TestPlanes(dm, 1.0, 0.2, "open"));
  PetscCall(TestPlanes(dm, 1.0, -0.2, "penetrating"));
  PetscCall(CountRows(dm, "block.zmax", "plate.zmin"));
  PetscCall(CountRows(dm, "slab.zmin", "block.zmax"));
  PetscCall(CountRows(dm, "slab.zmax", "block.zmax"));
  PetscCall(CountRows(dm, "slab.xmin", "plate.xmax"));
  PetscCall(TestDerivative(dm));
  PetscCall(TestForces(dm, (PetscBool)(gap == GAP_MORTAR)));
  PetscCall(TestNoPairs(dm));
  PetscCall(CheckIdleRanks(dm));
  PetscCall(DMDestroy(&dm));
  PetscCall(CreateMesh(PETSC_COMM_WORLD, 1e-6, cells, &dm));
  PetscCall(TestPlanes(dm, 1e-6, 0.2, "a millionth of the length"));
  PetscCall(DMDestroy(&dm));
  PetscCall(TestRanks(cells));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 5 2 3}}
      output_file: output/contact_gap_1.out

   test:
      suffix: node
      nsize: {{1 5 2 3}}
      args: -contact_gap node
      output_file: output/contact_gap_node.out

   test:
      suffix: idle
      nsize: 5
      args: -cells 41 -idle_ranks

TEST*/
