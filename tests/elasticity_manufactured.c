static char help[] = "Manufactured solution on a cube: order of convergence in displacement and gradient.\n\n";

#include "elasticity_problem.h"

static const Material  materials[]  = {{MATERIAL_LINEAR, 2, 0.3}, {MATERIAL_NEOHOOKEAN, 2, 0.3}};
static const PetscReal amplitude[3] = {0.2, -0.1, 0.14};

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

/* f = -div P = -A : grad grad u, with the law's tangent A at the exact gradient */
static PetscErrorCode BodyForce(const Material *material, const PetscReal x[3], PetscReal f[3])
{
  const MaterialLaw *law;
  PetscReal          lambda, mu, d1[3], d2[3][3], H[3][3], A[81];

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(MaterialGetLame(material, &lambda, &mu));
  SineDerivatives(x, d1, d2);
  ExactGradient(x, H);
  PetscCheck(law->tangent(lambda, mu, &H[0][0], A), PETSC_COMM_SELF, PETSC_ERR_PLIB, "The exact solution is turned inside out");
  for (PetscInt i = 0; i < 3; ++i) {
    f[i] = 0;
    for (PetscInt j = 0; j < 3; ++j) {
      for (PetscInt k = 0; k < 3; ++k) {
        for (PetscInt l = 0; l < 3; ++l) f[i] -= A[9 * (3 * i + j) + 3 * k + l] * amplitude[k] * d2[j][l];
      }
    }
  }
  PetscFunctionReturn(0);
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
static PetscErrorCode CubeLoad(const Material *material, const PetscReal corner[3], PetscReal size, const PetscInt offset[8], PetscScalar load[])
{
  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < 27; ++q) {
    Point     p;
    PetscReal f[3];

    CubePoint(corner, size, q, &p);
    PetscCall(BodyForce(material, p.x, f));
    for (PetscInt a = 0; a < 8; ++a) {
      for (PetscInt d = 0; d < 3; ++d) load[offset[a] + d] += p.weight * p.N[a] * f[d];
    }
  }
  PetscFunctionReturn(0);
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

/* Over all cells: the load vector of a material where load is given, the L2 and H1-seminorm errors of u where that is */
static PetscErrorCode Integrate(DM dm, const Material *material, Vec load, Vec u, PetscReal errors[2])
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
    else PetscCall(CubeLoad(material, corner, PetscRealPart(x[offset[1]]) - corner[0], offset, l));
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

/* Solves with the exact displacement prescribed on the surface; u is new. Newton's method starts from the exact values at the vertices */
static PetscErrorCode Solve(DM dm, Elasticity e, const Material *material, Vec *u)
{
  IS  surface;
  Mat K;
  Vec load;

  PetscFunctionBeginUser;
  PetscCall(SurfaceRows(dm, &surface));
  PetscCall(ElasticitySetPrescribed(e, surface));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(ProblemInterpolate(dm, Exact, u));
  PetscCall(VecDuplicate(*u, &load));
  PetscCall(VecZeroEntries(load));
  PetscCall(Integrate(dm, material, load, NULL, NULL));
  PetscCall(ProblemNewton(e, surface, load, K, *u));
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
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  const PetscInt  cells[3] = {2, 2, 2};
  SceneBody       cube;
  MaterialType    type    = MATERIAL_LINEAR;
  ElementType     element = ELEMENT_FULL;
  PetscReal       values[3], gradients[3];

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &element));
  ProblemBox(name, lower, upper, cells, &cube);
  for (PetscInt level = 0; level < 3; ++level) {
    DM         dm;
    Elasticity e;
    Vec        u;
    PetscReal  errors[2] = {0, 0};

    PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &cube, level + 1, &dm));
    PetscCall(ElasticityCreate(dm, 1, &materials[type], &element, &e));
    PetscCall(Solve(dm, e, &materials[type], &u));
    PetscCall(Integrate(dm, NULL, NULL, u, errors));
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
      test:
         suffix: linear
         args: -element {{bbar incompatible}} -pc_type pbjacobi
      test:
         suffix: neohookean
         nsize: {{1 3}}
         args: -material neohookean -element {{full bbar}} -pc_type pbjacobi

TEST*/
