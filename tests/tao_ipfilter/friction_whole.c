static char help[] =
  "Coulomb's law on the contact of two blocks whose meshes do not match, on a wavy face: TAOIPFILTER against a\n\
semi-smooth Newton method on the whole system, displacements,\n\
normal forces and friction at once, by a direct solver.\n\
  -friction <0.3> : coefficient\n\n";

#include <mesh.h>
#include <contact.h>
#include <elasticity.h>
#include "ipfilter_problem.h"

typedef struct {
  QuadraticProgram q;
  Mat              T;
  Vec              t, limit, coefficient;
  PetscReal        friction;
} Blocks;

/* The whole system's unknowns in turn: n displacements, m normal forces, 2 m of friction; rho weighs gap and slip
   against forces */
typedef struct {
  Blocks   *blocks;
  Mat       A;
  Vec       z, r;
  PetscInt  n, m;
  PetscReal rho;
} Whole;

static PetscErrorCode CreateMesh(DM *dm, Material materials[2])
{
  static char     ground[] = "ground", block[] = "block";
  const PetscReal lower[2][3] = {{-0.5, -0.5, -0.5}, {0, 0, 0}}, upper[2][3] = {{2.5, 1.5, 0}, {2, 1, 0.7}};
  const PetscInt  cells[2][3] = {{6, 4, 2}, {7, 4, 3}};
  SceneBody       bodies[2];

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < 2; ++b) {
    bodies[b] = (SceneBody){.name = b ? block : ground, .shape = SHAPE_BOX, .order = 1};
    for (PetscInt d = 0; d < 3; ++d) {
      bodies[b].lower[d] = lower[b][d];
      bodies[b].upper[d] = upper[b][d];
      bodies[b].cells[d] = cells[b][d];
    }
    materials[b] = (Material){.type = MATERIAL_LINEAR, .young = b ? 3 : 1, .poisson = 0.3};
  }
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, dm));
  PetscFunctionReturn(0);
}

/* All rows of vertices at the ground's bottom and the block's top; a displacement that bends both faces alike, in
   `bent` */
static PetscErrorCode HoldEnds(DM dm, Vec bent, IS *held)
{
  const PetscReal    bottom = -0.5 + 1e-9, top = 0.7 - 1e-9, amount = 0.02;
  Vec                places;
  PetscScalar       *u;
  const PetscScalar *x;
  PetscInt           n, count = 0, *rows;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinates(dm, &places));
  PetscCall(VecGetLocalSize(places, &n));
  PetscCall(PetscMalloc1(n, &rows));
  PetscCall(VecGetArrayRead(places, &x));
  PetscCall(VecGetArrayWrite(bent, &u));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal at[3] = {PetscRealPart(x[i]), PetscRealPart(x[i + 1]), PetscRealPart(x[i + 2])};

    u[i] = u[i + 1] = 0.0;
    u[i + 2]        = amount * PetscSinReal(3.0 * at[0] + 2.0 * at[1]);
    for (PetscInt d = 0; d < 3 && (at[2] < bottom || at[2] > top); ++d) rows[count++] = i + d;
  }
  PetscCall(VecRestoreArrayWrite(bent, &u));
  PetscCall(VecRestoreArrayRead(places, &x));
  PetscCall(ISCreateGeneral(PETSC_COMM_WORLD, count, rows, PETSC_OWN_POINTER, held));
  PetscFunctionReturn(0);
}

/* The gap less an overlap that varies, the slip with a part that has been; no columns of what is held */
static PetscErrorCode AssembleContact(DM dm, Vec bent, IS held, Blocks *b)
{
  const SceneContactPair pair    = {.name = "joint",
       .mortar                            = "ground.zmax",
       .nonmortar                         = "block.zmin",
       .gap                               = GAP_MORTAR,
       .friction                          = b->friction,
       .shear_limit                       = PETSC_INFINITY};
  const PetscReal        overlap = 0.02, slipped = 4e-3;
  Contact                contact;
  ContactLinearization   lin;
  Vec                    mask;
  PetscInt               m;

  PetscFunctionBeginUser;
  PetscCall(ContactCreate(dm, 1, &pair, &contact));
  PetscCall(ContactLinearize(contact, bent, CONTACT_FORCES, &lin));
  PetscCall(VecDuplicate(bent, &mask));
  PetscCall(VecSet(mask, 1.0));
  PetscCall(VecISSet(mask, held, 0.0));
  PetscCall(MatDuplicate(lin->J, MAT_COPY_VALUES, &b->q.J));
  PetscCall(MatDuplicate(lin->slip, MAT_COPY_VALUES, &b->T));
  PetscCall(MatDiagonalScale(b->q.J, NULL, mask));
  PetscCall(MatDiagonalScale(b->T, NULL, mask));
  PetscCall(VecDuplicate(lin->g, &b->q.g));
  PetscCall(MatCreateVecs(b->T, NULL, &b->t));
  PetscCall(VecGetSize(b->q.g, &m));
  for (PetscInt i = 0; i < m; ++i) {
    PetscCall(VecSetValue(b->q.g, i, overlap * (0.7 + PetscCosReal(0.9 * i)), INSERT_VALUES));
    for (PetscInt a = 0; a < 2; ++a)
      PetscCall(VecSetValue(b->t, 2 * i + a, slipped * PetscSinReal(1.3 * i + a), INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(b->q.g));
  PetscCall(VecAssemblyEnd(b->q.g));
  PetscCall(VecAssemblyBegin(b->t));
  PetscCall(VecAssemblyEnd(b->t));
  PetscCall(VecAXPY(b->q.g, -1.0, lin->g));
  PetscCall(VecDuplicate(b->q.g, &b->limit));
  PetscCall(VecSet(b->limit, PETSC_INFINITY));
  PetscCall(VecDuplicate(b->q.g, &b->coefficient));
  PetscCall(VecSet(b->coefficient, b->friction));
  PetscCall(VecDestroy(&mask));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscFunctionReturn(0);
}

static PetscErrorCode BlocksCreate(Blocks *b)
{
  const PetscReal push[3] = {0.002, 0.001, -0.002};
  DM              dm;
  Material        materials[2];
  Elasticity      elasticity;
  Vec             bent;
  IS              held;

  PetscFunctionBeginUser;
  PetscCall(CreateMesh(&dm, materials));
  PetscCall(DMCreateGlobalVector(dm, &bent));
  PetscCall(HoldEnds(dm, bent, &held));
  PetscCall(ElasticityCreate(dm, 2, materials, NULL, &elasticity));
  PetscCall(ElasticitySetPrescribed(elasticity, held));
  PetscCall(ElasticitySetMatType(elasticity, MATAIJ));
  PetscCall(ElasticityCreateTangent(elasticity, &b->q.H));
  PetscCall(ElasticityTangent(elasticity, bent, b->q.H));
  PetscCall(VecDuplicate(bent, &b->q.b));
  PetscCall(VecZeroEntries(b->q.b));
  PetscCall(ElasticityAddBodyForce(elasticity, 1, push, b->q.b));
  PetscCall(VecISSet(b->q.b, held, 0.0));
  PetscCall(AssembleContact(dm, bent, held, b));
  PetscCall(ISDestroy(&held));
  PetscCall(VecDestroy(&bent));
  PetscCall(ElasticityDestroy(&elasticity));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

static PetscErrorCode BlocksDestroy(Blocks *b)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&b->q));
  PetscCall(MatDestroy(&b->T));
  PetscCall(VecDestroy(&b->t));
  PetscCall(VecDestroy(&b->limit));
  PetscCall(VecDestroy(&b->coefficient));
  PetscFunctionReturn(0);
}

/* Row `to` of A += scale x row `from` of B */
static PetscErrorCode AddRow(Mat B, PetscInt from, PetscReal scale, PetscInt to, Mat A)
{
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(B, from, &n, &columns, &values));
  for (PetscInt k = 0; k < n; ++k)
    PetscCall(MatSetValue(A, to, columns[k], scale * PetscRealPart(values[k]), ADD_VALUES));
  PetscCall(MatRestoreRow(B, from, &n, &columns, &values));
  PetscFunctionReturn(0);
}

/* Columns first... of A += scale x the transpose of B */
static PetscErrorCode AddTranspose(Mat B, PetscReal scale, PetscInt first, Mat A)
{
  PetscInt rows;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(B, &rows, NULL));
  for (PetscInt r = 0; r < rows; ++r) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           n;

    PetscCall(MatGetRow(B, r, &n, &columns, &values));
    for (PetscInt k = 0; k < n; ++k)
      PetscCall(MatSetValue(A, columns[k], first + r, scale * PetscRealPart(values[k]), ADD_VALUES));
    PetscCall(MatRestoreRow(B, r, &n, &columns, &values));
  }
  PetscFunctionReturn(0);
}

/* Of one row, p = y - rho c and s = tau - rho v: y - max(0, p) and tau - P(s), P onto |tau| <= friction max(0, p),
   and their derivatives */
static PetscErrorCode WholeAddLaws(Whole *w, PetscInt i, PetscReal c, const PetscReal v[2], PetscScalar z[],
  PetscScalar r[])
{
  Blocks         *b   = w->blocks;
  const PetscInt  row = w->n + i, tau = w->n + w->m + 2 * i;
  const PetscReal p    = PetscRealPart(z[row]) - w->rho * c,
                  s[2] = {PetscRealPart(z[tau]) - w->rho * v[0], PetscRealPart(z[tau + 1]) - w->rho * v[1]},
                  size = hypot(s[0], s[1]), bound = b->friction * PetscMax(0.0, p);
  const PetscBool slips = (PetscBool)(size > bound);

  PetscFunctionBeginUser;
  r[row] = z[row] - PetscMax(0.0, p);
  if (p > 0.0) PetscCall(AddRow(b->q.J, i, w->rho, row, w->A));
  else PetscCall(MatSetValue(w->A, row, row, 1.0, ADD_VALUES));
  for (PetscInt a = 0; a < 2; ++a) {
    r[tau + a] = z[tau + a] - (slips ? bound * s[a] / size : s[a]);
    PetscCall(MatSetValue(w->A, tau + a, tau + a, 1.0, ADD_VALUES));
    for (PetscInt d = 0; d < 2; ++d) {
      const PetscReal slope = slips ? bound / size * ((a == d) - s[a] * s[d] / (size * size)) : (a == d);

      PetscCall(MatSetValue(w->A, tau + a, tau + d, -slope, ADD_VALUES));
      PetscCall(AddRow(b->T, 2 * i + d, w->rho * slope, tau + a, w->A));
    }
    if (!slips || p <= 0.0) continue;
    PetscCall(MatSetValue(w->A, tau + a, row, -b->friction * s[a] / size, ADD_VALUES));
    PetscCall(AddRow(b->q.J, i, b->friction * w->rho * s[a] / size, tau + a, w->A));
  }
  PetscFunctionReturn(0);
}

/* Residual and derivative at z */
static PetscErrorCode WholeAssemble(Whole *w)
{
  Blocks            *b = w->blocks;
  const PetscScalar *c, *v;
  PetscScalar       *z, *r;
  Vec                x, force, y, tau, gap, slip;

  PetscFunctionBeginUser;
  PetscCall(MatZeroEntries(w->A));
  PetscCall(VecDuplicate(b->q.g, &gap));
  PetscCall(VecDuplicate(b->t, &slip));
  PetscCall(VecDuplicate(b->q.b, &force));
  PetscCall(VecGetArray(w->z, &z));
  PetscCall(VecGetArray(w->r, &r));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, w->n, z, &x));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, w->m, z + w->n, &y));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, 2 * w->m, z + w->n + w->m, &tau));
  PetscCall(MatMult(b->q.J, x, gap));
  PetscCall(VecAXPY(gap, -1.0, b->q.g));
  PetscCall(MatMultAdd(b->T, x, b->t, slip));
  PetscCall(MatMultTranspose(b->q.J, y, force));
  PetscCall(MatMultTransposeAdd(b->T, tau, force, force));
  PetscCall(VecAXPY(force, 1.0, b->q.b));
  PetscCall(VecScale(force, -1.0));
  PetscCall(MatMultAdd(b->q.H, x, force, force));
  PetscCall(VecGetArrayRead(force, &c));
  PetscCall(PetscArraycpy(r, c, w->n));
  PetscCall(VecRestoreArrayRead(force, &c));
  for (PetscInt i = 0; i < w->n; ++i) PetscCall(AddRow(b->q.H, i, 1.0, i, w->A));
  PetscCall(AddTranspose(b->q.J, -1.0, w->n, w->A));
  PetscCall(AddTranspose(b->T, -1.0, w->n + w->m, w->A));
  PetscCall(VecGetArrayRead(gap, &c));
  PetscCall(VecGetArrayRead(slip, &v));
  for (PetscInt i = 0; i < w->m; ++i)
    PetscCall(WholeAddLaws(w, i, PetscRealPart(c[i]),
      (PetscReal[2]){PetscRealPart(v[2 * i]), PetscRealPart(v[2 * i + 1])}, z, r));
  PetscCall(VecRestoreArrayRead(slip, &v));
  PetscCall(VecRestoreArrayRead(gap, &c));
  PetscCall(MatAssemblyBegin(w->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(w->A, MAT_FINAL_ASSEMBLY));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&tau));
  PetscCall(VecRestoreArray(w->z, &z));
  PetscCall(VecRestoreArray(w->r, &r));
  PetscCall(VecDestroy(&gap));
  PetscCall(VecDestroy(&slip));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

static PetscErrorCode WholeCreate(Blocks *b, Whole *w)
{
  const PetscReal fraction = 0.1;
  Vec             diagonal;

  PetscFunctionBeginUser;
  w->blocks = b;
  PetscCall(VecGetSize(b->q.b, &w->n));
  PetscCall(VecGetSize(b->q.g, &w->m));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, w->n + 3 * w->m, &w->z));
  PetscCall(VecDuplicate(w->z, &w->r));
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, w->n + 3 * w->m, w->n + 3 * w->m, 300, NULL, &w->A));
  PetscCall(MatSetOption(w->A, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(VecDuplicate(b->q.b, &diagonal));
  PetscCall(MatGetDiagonal(b->q.H, diagonal));
  PetscCall(VecMax(diagonal, NULL, &w->rho));
  w->rho *= fraction;
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(0);
}

static PetscErrorCode WholeSolve(Whole *w)
{
  const PetscInt  most  = 60;
  const PetscReal small = 1e-14;
  KSP             ksp;
  PC              pc;
  Vec             step;
  PetscReal       norm = 1.0, first = 0.0;
  PetscInt        its;
  PetscBool       mumps;

  PetscFunctionBeginUser;
  PetscCall(PetscHasExternalPackage("mumps", &mumps));
  PetscCall(KSPCreate(PETSC_COMM_SELF, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCLU));
  if (mumps) PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(VecDuplicate(w->z, &step));
  PetscCall(VecZeroEntries(w->z));
  for (its = 0; its < most; ++its) {
    PetscCall(WholeAssemble(w));
    PetscCall(VecNorm(w->r, NORM_2, &norm));
    PetscCall(PetscInfo(NULL, "%" PetscInt_FMT ": %g\n", its, (double)norm));
    if (!its) first = norm;
    if (norm <= small * first) break;
    PetscCall(KSPSetOperators(ksp, w->A, w->A));
    PetscCall(KSPSolve(ksp, w->r, step));
    PetscCall(VecAXPY(w->z, -1.0, step));
  }
  PetscCall(
    PetscPrintf(PETSC_COMM_SELF, "%s\n", its < most ? "the whole system: solved" : "the whole system: NOT solved"));
  PetscCall(VecDestroy(&step));
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

static PetscErrorCode WholeDestroy(Whole *w)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&w->A));
  PetscCall(VecDestroy(&w->z));
  PetscCall(VecDestroy(&w->r));
  PetscFunctionReturn(0);
}

/* Against `size`, the largest of them or of what they are bounded by */
static PetscErrorCode Compare(const char what[], Vec found, const PetscScalar exact[], PetscReal size)
{
  const PetscScalar *a;
  PetscReal          most = 0.0;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(found, &n));
  PetscCall(VecGetArrayRead(found, &a));
  for (PetscInt i = 0; i < n; ++i) most = PetscMax(most, PetscAbsScalar(a[i] - exact[i]));
  PetscCall(VecRestoreArrayRead(found, &a));
  PetscCall(ProblemVerdict(what, most / size, 1e-8));
  PetscFunctionReturn(0);
}

/* Coulomb's law at every row of the answer: gap and force, the cone, friction against slip; and how many rows are
   open, stick, slip */
static PetscErrorCode CheckLaws(Blocks *b, Vec x, Vec y, Vec tau)
{
  const PetscScalar *f, *q, *c, *v;
  PetscReal          errors[3] = {0.0, 0.0, 0.0}, largest, slid;
  PetscInt           counts[3] = {0, 0, 0}, m;
  Vec                gap, slip;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(b->q.g, &gap));
  PetscCall(VecDuplicate(b->t, &slip));
  PetscCall(MatMult(b->q.J, x, gap));
  PetscCall(VecAXPY(gap, -1.0, b->q.g));
  PetscCall(MatMultAdd(b->T, x, b->t, slip));
  PetscCall(VecNorm(y, NORM_INFINITY, &largest));
  PetscCall(VecNorm(slip, NORM_INFINITY, &slid));
  PetscCall(VecGetLocalSize(y, &m));
  PetscCall(VecGetArrayRead(gap, &c));
  PetscCall(VecGetArrayRead(slip, &v));
  PetscCall(VecGetArrayRead(y, &f));
  PetscCall(VecGetArrayRead(tau, &q));
  for (PetscInt i = 0; i < m; ++i) {
    const PetscReal p = PetscRealPart(f[i]), g = PetscRealPart(c[i]),
                    size = hypot(PetscRealPart(q[2 * i]), PetscRealPart(q[2 * i + 1])),
                    way  = hypot(PetscRealPart(v[2 * i]), PetscRealPart(v[2 * i + 1]));
    const PetscInt open = p <= 1e-9 * largest, sticks = !open && way <= 1e-9 * slid;

    ++counts[open ? 0 : sticks ? 1 : 2];
    errors[0] = PetscMax(errors[0], PetscMax(PetscMax(-p / largest, -g / slid), PetscAbsReal(p * g) / largest / slid));
    errors[1] = PetscMax(errors[1], (size - b->friction * p) / largest);
    for (PetscInt a = 0; a < 2; ++a)
      errors[2] = PetscMax(errors[2],
        PetscAbsReal(way * PetscRealPart(q[2 * i + a]) + b->friction * p * PetscRealPart(v[2 * i + a])) / largest /
          slid);
  }
  PetscCall(VecRestoreArrayRead(tau, &q));
  PetscCall(VecRestoreArrayRead(y, &f));
  PetscCall(VecRestoreArrayRead(slip, &v));
  PetscCall(VecRestoreArrayRead(gap, &c));
  PetscCall(PetscPrintf(PETSC_COMM_SELF,
    "%" PetscInt_FMT " rows open, %" PetscInt_FMT " stick, %" PetscInt_FMT " slip\n", counts[0], counts[1], counts[2]));
  PetscCall(ProblemVerdict("gap, force, and either 0", errors[0], 1e-8));
  PetscCall(ProblemVerdict("friction beyond its bound", errors[1], 1e-8));
  PetscCall(ProblemVerdict("friction against slip", errors[2], 1e-8));
  PetscCall(VecDestroy(&gap));
  PetscCall(VecDestroy(&slip));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Blocks             blocks = {.friction = 0.3};
  Whole              whole;
  Vec                x, y, tau;
  Tao                tao;
  const PetscScalar *z;
  PetscReal          far, largest;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-friction", &blocks.friction, NULL));
  PetscCall(BlocksCreate(&blocks));
  PetscCall(VecDuplicate(blocks.q.b, &x));
  PetscCall(ProblemCreateSolver(&blocks.q, x, &tao));
  PetscCall(TaoSetTolerances(tao, 1e-14, 0.0, 0.0));
  PetscCall(TaoIPFilterSetNormTerms(tao, blocks.T, blocks.t, blocks.limit, blocks.coefficient));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetDualVariables(tao, NULL, &y));
  PetscCall(TaoIPFilterGetNormTermForces(tao, &tau));

  PetscCall(WholeCreate(&blocks, &whole));
  PetscCall(WholeSolve(&whole));
  PetscCall(VecGetArrayRead(whole.z, &z));
  PetscCall(VecNorm(x, NORM_INFINITY, &far));
  PetscCall(VecNorm(y, NORM_INFINITY, &largest));
  PetscCall(Compare("displacements", x, z, far));
  PetscCall(Compare("normal forces", y, z + whole.n, largest));
  PetscCall(Compare("friction", tau, z + whole.n + whole.m, largest));
  PetscCall(VecRestoreArrayRead(whole.z, &z));
  PetscCall(CheckLaws(&blocks, x, y, tau));

  PetscCall(WholeDestroy(&whole));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(BlocksDestroy(&blocks));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      args: -friction {{0.3 1}separate output} -tao_ipfilter_pc_amgf_factor {{true false}}

TEST*/
