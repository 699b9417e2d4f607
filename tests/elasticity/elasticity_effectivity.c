static char help[] =
  "Effectivity of the error estimate: manufactured solution on a cube, Lame's sphere, clamped beam.\n\
  -problem <cube|sphere|beam>, -material, -element, -poisson, -effectivity_view\n\n";

#include "elasticity_truth.h"

#define LEVELS 3

static const char *const Problems[] = {"cube", "sphere", "beam", "Problem", "PROBLEM_", NULL};
typedef enum { PROBLEM_CUBE, PROBLEM_SPHERE, PROBLEM_BEAM } Problem;

typedef struct {
  Problem     problem;
  Material    material;
  ElementType element;
} Context;

/* Cube: u = amplitude sin(pi x) sin(pi y) sin(pi z) + linear x, which the elements meet exactly on the surface */
static const PetscReal amplitude[3] = {0.2, -0.1, 0.14}, linear[3][3] = {{0, 0.1, 0}, {-0.1, 0, 0.2}, {0.3, 0, 0}};

static void CubeDerivatives(const PetscReal x[3], PetscReal H[3][3], PetscReal second[3][3])
{
  PetscReal s[3], c[3];

  for (PetscInt i = 0; i < 3; ++i) {
    s[i] = PetscSinReal(PETSC_PI * x[i]);
    c[i] = PETSC_PI * PetscCosReal(PETSC_PI * x[i]);
  }
  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt j = (i + 1) % 3, k = (i + 2) % 3;

    second[i][i] = -PETSC_PI * PETSC_PI * s[0] * s[1] * s[2];
    second[i][j] = second[j][i] = c[i] * c[j] * s[k];
    for (PetscInt l = 0; l < 3; ++l) H[l][i] = amplitude[l] * c[i] * s[j] * s[k] + linear[l][i];
  }
}

static void CubeGradient(const PetscReal x[3], PetscReal H[3][3])
{
  PetscReal second[3][3];

  CubeDerivatives(x, H, second);
}

static void CubeDisplacement(const PetscReal x[3], PetscReal u[3])
{
  for (PetscInt i = 0; i < 3; ++i)
    u[i] =
      amplitude[i] * PetscSinReal(PETSC_PI * x[0]) * PetscSinReal(PETSC_PI * x[1]) * PetscSinReal(PETSC_PI * x[2]) +
      linear[i][0] * x[0] + linear[i][1] * x[1] + linear[i][2] * x[2];
}

static void CubeStress(const void *ctx, const PetscReal x[3], PetscReal sigma[6])
{
  const MaterialLaw *law;
  const Context     *context = (const Context *)ctx;
  MaterialModuli     moduli;
  PetscReal          H[3][3], second[3][3];

  PetscCallAbort(PETSC_COMM_SELF, MaterialGetLaw(&context->material, &law));
  PetscCallAbort(PETSC_COMM_SELF, MaterialGetModuli(&context->material, &moduli, NULL));
  CubeDerivatives(x, H, second);
  law->cauchy(&moduli, &H[0][0], sigma);
}

/* The load f = -div P of a cell, and its part of the exact potential int W - f u */
static PetscErrorCode CubeCell(const Material *material, PetscReal X[8][3], const PetscInt offsets[8],
  PetscScalar load[], PetscReal *potential)
{
  const MaterialLaw *law;
  MaterialModuli     moduli;

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(MaterialGetModuli(material, &moduli, NULL));
  for (PetscInt q = 0; q < 27; ++q) {
    CellPoint p;
    PetscReal H[3][3], second[3][3], A[81], u[3], f[3] = {0, 0, 0};

    CellPointGet(X, q, &p);
    CubeDerivatives(p.x, H, second);
    CubeDisplacement(p.x, u);
    PetscCheck(law->tangent(&moduli, &H[0][0], A), PETSC_COMM_SELF, PETSC_ERR_PLIB,
      "The exact solution is turned inside out");
    for (PetscInt n = 0; n < 81; ++n) f[n / 27] -= A[n] * amplitude[n / 3 % 3] * second[n / 9 % 3][n % 3];
    *potential += p.weight * (law->energy(&moduli, &H[0][0]) - f[0] * u[0] - f[1] * u[1] - f[2] * u[2]);
    for (PetscInt a = 0; a < 8; ++a) {
      for (PetscInt d = 0; d < 3; ++d) load[offsets[a] + d] += p.weight * p.N[a] * f[d];
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CubeLoad(DM dm, const Material *material, Vec load, PetscReal *potential)
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *l;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  *potential = 0;
  for (PetscInt c = start; c < end; ++c) {
    PetscReal X[8][3], U[8][3];
    PetscInt  offsets[8];

    PetscCall(CellGather(dm, c, x, l, X, U, offsets));
    PetscCall(CubeCell(material, X, offsets, l, potential));
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMLocalToGlobal(dm, local, ADD_VALUES, load));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, potential, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* Sphere of radii 1 and 2 under internal pressure p: s_r = c (1 - b^3/r^3), s_t = c (1 + b^3/(2 r^3)), c = p a^3/(b^3
   - a^3) */
static const PetscReal pressure = 0.01;

static void SphereStress(const void *ctx, const PetscReal x[3], PetscReal sigma[6])
{
  static const PetscInt row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  const PetscReal r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2], ratio = 8 / (r2 * PetscSqrtReal(r2)), c = pressure / 7;
  const PetscReal radial = c * (1 - ratio), hoop = c * (1 + ratio / 2);

  (void)ctx;
  for (PetscInt k = 0; k < 6; ++k)
    sigma[k] = (radial - hoop) * x[row[k]] * x[column[k]] / r2 + (row[k] == column[k] ? hoop : 0);
}

static void MakeBody(const Context *context, SceneBody *body)
{
  static char     name[]   = "body";
  const PetscReal lower[3] = {0, 0, 0}, upper[2][3] = {{1, 1, 1}, {4, 1, 1}};
  const PetscInt  cells[2][3] = {{4, 4, 4}, {8, 2, 2}};
  const PetscBool beam        = (PetscBool)(context->problem == PROBLEM_BEAM);

  ProblemBox(name, lower, upper[beam], cells[beam], body);
  if (context->problem != PROBLEM_SPHERE) return;
  body->shape               = SHAPE_SPHERE_SHELL;
  body->curved              = PETSC_TRUE;
  body->layers              = 2;
  body->octant.inner.radius = 1;
  body->octant.outer.radius = 2;
  for (PetscInt d = 0; d < 3; ++d) body->cells[d] = 2;
}

static PetscErrorCode PrescribedRows(const Context *context, DM dm, IS *rows)
{
  static const char *const faces[] = {"body.xmin", "body.xmax", "body.ymin", "body.ymax", "body.zmin", "body.zmax"},
                           *const planes[] = {"body.x0", "body.y0", "body.z0"};
  const PetscInt                  n = context->problem == PROBLEM_CUBE ? 6 : context->problem == PROBLEM_SPHERE ? 3 : 1;
  IS                              parts[6];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < n; ++i) {
    if (context->problem == PROBLEM_SPHERE) PetscCall(MeshGetFaceDofs(dm, planes[i], i, &parts[i]));
    else PetscCall(ProblemFixFace(dm, faces[i], &parts[i]));
  }
  PetscCall(ISConcatenate(PETSC_COMM_WORLD, n, parts, rows));
  for (PetscInt i = 0; i < n; ++i) PetscCall(ISDestroy(&parts[i]));
  PetscFunctionReturn(0);
}

/*
   Squared energy norm of the error: from the stresses of an exact solution; or twice the surplus of the potential
   over the exact one, for the beam, which has it from Richardson's extrapolation, and for full integration at finite
   strain
*/
static PetscErrorCode Truth(const Context *context, DM dm, Elasticity e, Vec u, Vec load, PetscReal potential,
  PetscReal *truth)
{
  const ExactSolution exact = {context->material, context->element,
    context->problem == PROBLEM_SPHERE ? SphereStress : CubeStress, CubeGradient, context};
  const PetscBool     surplus =
    (PetscBool)(context->problem == PROBLEM_BEAM ||
                (context->material.type == MATERIAL_NEOHOOKEAN && context->element == ELEMENT_FULL));
  PetscReal   energy;
  PetscScalar work;

  PetscFunctionBeginUser;
  if (surplus) {
    PetscCall(ElasticityEnergy(e, u, &energy));
    PetscCall(VecDot(load, u, &work));
    *truth = 2 * (energy - PetscRealPart(work) - potential);
  } else PetscCall(TrueError(dm, &exact, u, truth));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(const Context *context, PetscInt level)
{
  const PetscReal weight[3] = {0, 0, -0.001};
  PetscReal       potential =
    -3.319e-4; /* the beam's, within 1e-7: extrapolated with both elements, up to 64 x 16 x 16 cells */
  PetscReal   estimate, truth;
  SceneBody   shape;
  DM          dm;
  IS          rows;
  ProblemBody body;

  PetscFunctionBeginUser;
  MakeBody(context, &shape);
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &shape, level, &dm));
  PetscCall(PrescribedRows(context, dm, &rows));
  PetscCall(ProblemBodyCreate(dm, &context->material, context->element, rows, &body));
  if (context->problem == PROBLEM_CUBE) {
    PetscCall(VecDestroy(&body.u));
    PetscCall(ProblemInterpolate(dm, CubeDisplacement, &body.u));
    PetscCall(CubeLoad(dm, &context->material, body.load, &potential));
  } else if (context->problem == PROBLEM_SPHERE)
    PetscCall(ElasticityAddPressure(body.e, "body.inner", pressure, NULL, NULL, body.load));
  else PetscCall(ElasticityAddBodyForce(body.e, 0, weight, body.load));
  PetscCall(ProblemNewton(body.e, rows, body.load, body.K, body.u));
  PetscCall(ElasticityRecoverStress(body.e, body.u, NULL, NULL, &estimate, NULL));
  PetscCall(Truth(context, dm, body.e, body.u, body.load, potential, &truth));
  PetscCall(ReportEffectivity(level, estimate, truth, level < LEVELS - 1 ? 2 : 1.2));
  PetscCall(ProblemBodyDestroy(&body));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Context   context = {PROBLEM_CUBE, {.type = MATERIAL_LINEAR, .young = 1, .poisson = 0.3}, ELEMENT_FULL};
  PetscEnum problem = (PetscEnum)PROBLEM_CUBE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&context.material.type, &context.element));
  PetscCall(PetscOptionsGetEnum(NULL, NULL, "-problem", Problems, &problem, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-poisson", &context.material.poisson, NULL));
  context.problem = (Problem)problem;
  for (PetscInt level = 0; level < LEVELS; ++level) PetscCall(Run(&context, level));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_effectivity.out
      test:
         suffix: cube
         args: -pc_type pbjacobi -material {{linear neohookean}} -element {{full bbar}}
      test:
         suffix: sphere
         args: -problem sphere -element {{full bbar}} -elasticity_mat_type aij -ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps
      test:
         suffix: incompressible
         nsize: 2
         args: -problem sphere -element bbar -poisson 0.4999 -elasticity_mat_type aij -ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps
      test:
         suffix: beam
         args: -problem beam -pc_type hypre

TEST*/
