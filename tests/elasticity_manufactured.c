static char help[] = "Manufactured solution on a cube: order of convergence in displacement and gradient.\n\n";

#include "elasticity_problem.h"
#include <petscksp.h>

static const PetscReal young = 2, poisson = 0.3;
static const PetscReal amplitude[3] = {1, -0.5, 0.7};

/* u = amplitude sin(pi x) sin(pi y) sin(pi z) + (0.1 y, 0.2 z - 0.1 x, 0.3 x) */
static void Exact(const PetscReal x[3], PetscReal u[3])
{
  const PetscReal s = PetscSinReal(PETSC_PI * x[0]) * PetscSinReal(PETSC_PI * x[1]) * PetscSinReal(PETSC_PI * x[2]);

  u[0] = amplitude[0] * s + 0.1 * x[1];
  u[1] = amplitude[1] * s + 0.2 * x[2] - 0.1 * x[0];
  u[2] = amplitude[2] * s + 0.3 * x[0];
}

/* First and second derivatives of sin sin sin */
static void SineDerivatives(const PetscReal x[3], PetscReal d1[3], PetscReal d2[3][3])
{
  PetscReal s[3], c[3];

  for (PetscInt i = 0; i < 3; ++i) {
    s[i] = PetscSinReal(PETSC_PI * x[i]);
    c[i] = PETSC_PI * PetscCosReal(PETSC_PI * x[i]);
  }
  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt j = (i + 1) % 3, k = (i + 2) % 3;

    d1[i]    = c[i] * s[j] * s[k];
    d2[i][i] = -PETSC_PI * PETSC_PI * s[0] * s[1] * s[2];
    d2[i][j] = d2[j][i] = c[i] * c[j] * s[k];
  }
}

static void ExactGradient(const PetscReal x[3], PetscReal H[3][3])
{
  static const PetscReal linear[3][3] = {{0, 0.1, 0}, {-0.1, 0, 0.2}, {0.3, 0, 0}};
  PetscReal              d1[3], d2[3][3];

  SineDerivatives(x, d1, d2);
  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt j = 0; j < 3; ++j) H[i][j] = amplitude[i] * d1[j] + linear[i][j];
  }
}

/* f = -(lambda + mu) grad div u - mu laplacian u */
static void BodyForce(const PetscReal x[3], PetscReal f[3])
{
  const PetscReal lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = 0.5 * young / (1 + poisson);
  PetscReal       d1[3], d2[3][3];

  SineDerivatives(x, d1, d2);
  for (PetscInt i = 0; i < 3; ++i) {
    f[i] = -mu * amplitude[i] * (d2[0][0] + d2[1][1] + d2[2][2]);
    for (PetscInt k = 0; k < 3; ++k) f[i] -= (lambda + mu) * amplitude[k] * d2[i][k];
  }
}

/* One Gauss point of a cell that is an axis-aligned cube: place, weight, shape functions, gradients */
typedef struct {
  PetscReal x[3], weight, N[8], G[8][3];
} Point;

static void CubePoint(const PetscReal corner[3], PetscReal size, PetscInt q, Point *p)
{
  const PetscReal gauss[3] = {0.5 - PetscSqrtReal(0.15), 0.5, 0.5 + PetscSqrtReal(0.15)}, weight[3] = {5. / 18, 8. / 18, 5. / 18};
  const PetscInt  index[3] = {q % 3, q / 3 % 3, q / 9};

  p->weight = size * size * size;
  for (PetscInt d = 0; d < 3; ++d) {
    p->x[d] = corner[d] + size * gauss[index[d]];
    p->weight *= weight[index[d]];
  }
  for (PetscInt a = 0; a < 8; ++a) {
    PetscReal L[3], D[3];

    for (PetscInt d = 0; d < 3; ++d) {
      L[d] = (a >> d & 1) ? gauss[index[d]] : 1 - gauss[index[d]];
      D[d] = (a >> d & 1) ? 1 / size : -1 / size;
    }
    p->N[a] = L[0] * L[1] * L[2];
    for (PetscInt d = 0; d < 3; ++d) p->G[a][d] = D[d] * L[(d + 1) % 3] * L[(d + 2) % 3];
  }
}

/* Adds the load of a cube, or its squared errors against the exact solution */
static void CubeLoad(const PetscReal corner[3], PetscReal size, const PetscInt offset[8], PetscScalar load[])
{
  for (PetscInt q = 0; q < 27; ++q) {
    Point     p;
    PetscReal f[3];

    CubePoint(corner, size, q, &p);
    BodyForce(p.x, f);
    for (PetscInt a = 0; a < 8; ++a) {
      for (PetscInt d = 0; d < 3; ++d) load[offset[a] + d] += p.weight * p.N[a] * f[d];
    }
  }
}

static void CubeErrors(const PetscReal corner[3], PetscReal size, const PetscInt offset[8], const PetscScalar u[], PetscReal errors[2])
{
  for (PetscInt q = 0; q < 27; ++q) {
    Point     p;
    PetscReal value[3], H[3][3];

    CubePoint(corner, size, q, &p);
    Exact(p.x, value);
    ExactGradient(p.x, H);
    for (PetscInt a = 0; a < 8; ++a) {
      for (PetscInt i = 0; i < 3; ++i) {
        value[i] -= p.N[a] * PetscRealPart(u[offset[a] + i]);
        for (PetscInt j = 0; j < 3; ++j) H[i][j] -= p.G[a][j] * PetscRealPart(u[offset[a] + i]);
      }
    }
    for (PetscInt i = 0; i < 3; ++i) {
      errors[0] += p.weight * value[i] * value[i];
      for (PetscInt j = 0; j < 3; ++j) errors[1] += p.weight * H[i][j] * H[i][j];
    }
  }
}

/* Over all cells: the load vector where load is given, the L2 and H1-seminorm errors of u where that is */
static PetscErrorCode Integrate(DM dm, Vec load, Vec u, PetscReal errors[2])
{
  Vec                coordinates, local;
  PetscSection       section;
  const PetscScalar *x;
  PetscScalar       *l;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(DMGetLocalVector(dm, &local));
  if (u) PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  else PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt  vertices[8], offset[8];
    PetscReal corner[3];

    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) PetscCall(PetscSectionGetOffset(section, vertices[a], &offset[a]));
    for (PetscInt d = 0; d < 3; ++d) corner[d] = PetscRealPart(x[offset[0] + d]);
    if (u) CubeErrors(corner, PetscRealPart(x[offset[1]]) - corner[0], offset, l, errors);
    else CubeLoad(corner, PetscRealPart(x[offset[1]]) - corner[0], offset, l);
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  if (u) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, errors, 2, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  else PetscCall(DMLocalToGlobal(dm, local, ADD_VALUES, load));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscFunctionReturn(0);
}

/* All displacements on the surface */
static PetscErrorCode SurfaceRows(DM dm, IS *rows)
{
  static const char *const faces[] = {"cube.xmin", "cube.xmax", "cube.ymin", "cube.ymax", "cube.zmin", "cube.zmax"};
  IS                       face[6];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 6; ++i) PetscCall(ProblemFixFace(dm, faces[i], &face[i]));
  PetscCall(ISConcatenate(PETSC_COMM_WORLD, 6, face, rows));
  for (PetscInt i = 0; i < 6; ++i) PetscCall(ISDestroy(&face[i]));
  PetscFunctionReturn(0);
}

/* Solves with the exact displacement prescribed on the surface; u is new */
static PetscErrorCode Solve(DM dm, Elasticity e, Vec *u)
{
  IS  surface;
  Mat K;
  Vec load, force, free, exact;
  KSP ksp;

  PetscFunctionBeginUser;
  PetscCall(SurfaceRows(dm, &surface));
  PetscCall(ElasticitySetPrescribed(e, surface));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(ElasticityTangent(e, NULL, K));
  PetscCall(ProblemInterpolate(dm, Exact, &exact));
  PetscCall(VecDuplicate(exact, &load));
  PetscCall(VecDuplicate(exact, &force));
  PetscCall(VecDuplicate(exact, &free));
  PetscCall(VecDuplicate(exact, u));
  PetscCall(VecZeroEntries(load));
  PetscCall(VecSet(free, 1));
  PetscCall(VecISSet(free, surface, 0));
  PetscCall(VecPointwiseMult(*u, free, exact));
  PetscCall(VecAYPX(*u, -1, exact));
  PetscCall(Integrate(dm, load, NULL, NULL));
  PetscCall(ElasticityForce(e, *u, force));
  PetscCall(VecAXPY(load, -1, force));
  PetscCall(VecPointwiseMult(load, free, load));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &ksp));
  PetscCall(KSPSetOperators(ksp, K, K));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetTolerances(ksp, 1e-9, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetErrorIfNotConverged(ksp, PETSC_TRUE));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(KSPSolve(ksp, load, force));
  PetscCall(VecAXPY(*u, 1, force));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&exact));
  PetscCall(VecDestroy(&free));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&load));
  PetscCall(MatDestroy(&K));
  PetscCall(ISDestroy(&surface));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReportOrder(const char name[], const PetscReal errors[], PetscReal expected)
{
  const PetscReal order = PetscLog2Real(errors[1] / errors[2]);

  PetscFunctionBeginUser;
  if (PetscAbsReal(order - expected) < 0.1) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "order of the %s: %g\n", name, (double)expected));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "order of the %s: %g, NOT %g; errors %g %g %g\n", name, (double)order, (double)expected, (double)errors[0], (double)errors[1], (double)errors[2]));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static char     name[]   = "cube";
  const SceneBody cube     = {name, SHAPE_BOX, {0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {MATERIAL_LINEAR, 0, 0}};
  const Material  material = {MATERIAL_LINEAR, young, poisson};
  PetscReal       values[3], gradients[3];

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (PetscInt level = 0; level < 3; ++level) {
    DM         dm;
    Elasticity e;
    Vec        u;
    PetscReal  errors[2] = {0, 0};

    PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &cube, level + 1, &dm));
    PetscCall(ElasticityCreate(dm, 1, &material, NULL, &e));
    PetscCall(Solve(dm, e, &u));
    PetscCall(Integrate(dm, NULL, u, errors));
    values[level]    = PetscSqrtReal(errors[0]);
    gradients[level] = PetscSqrtReal(errors[1]);
    PetscCall(VecDestroy(&u));
    PetscCall(ElasticityDestroy(&e));
    PetscCall(DMDestroy(&dm));
  }
  PetscCall(ReportOrder("displacement", values, 2));
  PetscCall(ReportOrder("gradient", gradients, 1));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_manufactured.out
      test:
         suffix: baij
         nsize: {{1 3}}
         args: -pc_type {{pbjacobi hypre}}
      test:
         suffix: aij
         nsize: {{1 3}}
         args: -elasticity_mat_type aij -pc_type gamg
      test:
         suffix: sbaij
         nsize: {{1 3}}
         args: -elasticity_mat_type sbaij -pc_type bjacobi -sub_pc_type icc

TEST*/
