static char help[] = "Manufactured solution on a cube, of cubes, of distorted or of curved cells: order of convergence "
                     "in displacement and gradient, and\nhow far the error estimate is from the true error.\n\n";

#include "../lib/elasticity_problem.h"
#include "elasticity_stresses.h"

static const Material materials[]  = {{.type = MATERIAL_LINEAR, .young = 2, .poisson = 0.3},
   {.type = MATERIAL_NEOHOOKEAN, .young = 2, .poisson = 0.3},
   {.type = MATERIAL_SAINT_VENANT, .young = 2, .poisson = 0.3}};
static PetscReal      amplitude[3] = {0.2, -0.1, 0.14};

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
  MaterialModuli     moduli;
  PetscReal          d1[3], d2[3][3], H[3][3], A[81];

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(MaterialGetModuli(material, &moduli, NULL));
  SineDerivatives(x, d1, d2);
  ExactGradient(x, H);
  PetscCheck(law->tangent(&moduli, &H[0][0], A), PETSC_COMM_SELF, PETSC_ERR_PLIB,
    "The exact solution is turned inside out");
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

/* Adds the load of a cell */
static PetscErrorCode CellLoad(const Material *material, const PointCell *cell, PetscScalar load[])
{
  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < POINTS * POINTS * POINTS; ++q) {
    Point     p;
    PetscReal f[3];

    PetscCall(PointGet(cell, q, &p));
    PetscCall(BodyForce(material, p.x, f));
    for (PetscInt a = 0; a < cell->n; ++a) {
      for (PetscInt d = 0; d < 3; ++d) load[cell->offset[a] + d] += p.weight * p.N[a] * f[d];
    }
  }
  PetscFunctionReturn(0);
}

/* Adds its squared errors against the exact solution: of the displacement, of its gradient, and in the energy norm of
   full integration */
static PetscErrorCode CellErrors(const Material *material, const PointCell *cell, const PetscScalar u[],
  PetscReal errors[3])
{
  const MaterialLaw *law;
  MaterialModuli     moduli;
  PetscReal          A[81];

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(MaterialGetModuli(material, &moduli, NULL));
  for (PetscInt q = 0; q < POINTS * POINTS * POINTS; ++q) {
    Point     p;
    PetscReal value[3], H[3][3];

    PetscCall(PointGet(cell, q, &p));
    Exact(p.x, value);
    ExactGradient(p.x, H);
    PetscCheck(law->tangent(&moduli, &H[0][0], A), PETSC_COMM_SELF, PETSC_ERR_PLIB,
      "The exact solution is turned inside out");
    for (PetscInt a = 0; a < cell->n; ++a) {
      for (PetscInt i = 0; i < 3; ++i) {
        value[i] -= p.N[a] * PetscRealPart(u[cell->offset[a] + i]);
        for (PetscInt j = 0; j < 3; ++j) H[i][j] -= p.G[a][j] * PetscRealPart(u[cell->offset[a] + i]);
      }
    }
    for (PetscInt i = 0; i < 3; ++i) {
      errors[0] += p.weight * value[i] * value[i];
      for (PetscInt j = 0; j < 3; ++j) errors[1] += p.weight * H[i][j] * H[i][j];
    }
    for (PetscInt k = 0; k < 81; ++k) errors[2] += p.weight * H[k / 27][k / 9 % 3] * A[k] * H[k % 9 / 3][k % 3];
  }
  PetscFunctionReturn(0);
}

/* Over all cells: the load vector of a material where load is given, the squared errors of u where that is */
static PetscErrorCode Integrate(DM dm, const Material *material, Vec load, Vec u, PetscReal errors[3])
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *l;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(DMGetLocalVector(dm, &local));
  if (u) PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  else PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt c = start; c < end; ++c) {
    PointCell cell;

    PetscCall(PointCellGet(dm, c, x, &cell));
    if (u) PetscCall(CellErrors(material, &cell, l, errors));
    else PetscCall(CellLoad(material, &cell, l));
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  if (u) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, errors, 3, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  else PetscCall(DMLocalToGlobal(dm, local, ADD_VALUES, load));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscFunctionReturn(0);
}

/* Curved everywhere, and ever less as the cells are refined */
static void Bend(const PetscReal x[3], PetscReal image[3])
{
  for (PetscInt d = 0; d < 3; ++d)
    image[d] = x[d] + 0.06 * PetscSinReal(3 * x[(d + 1) % 3] + 2 * x[(d + 2) % 3] + (PetscReal)d);
}

/* Moves the vertices by up to so many cells, the same on all ranks; edges stay straight */
static PetscErrorCode Distort(DM dm, PetscReal distance)
{
  Vec                coordinates, before;
  const PetscScalar *b;
  PetscScalar       *x;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(VecDuplicate(coordinates, &before));
  PetscCall(VecCopy(coordinates, before));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(VecGetArrayRead(before, &b));
  PetscCall(VecGetArray(coordinates, &x));
  for (PetscInt c = start; c < end; ++c) {
    PointCell cell;
    PetscInt  width, last;

    PetscCall(PointCellGet(dm, c, b, &cell));
    width = cell.n == 8 ? 2 : 3;
    last  = width - 1;
    for (PetscInt a = 0; a < cell.n; ++a) {
      const PetscReal at[3] = {(PetscReal)(a % width) / (PetscReal)last,
        (PetscReal)(a / width % width) / (PetscReal)last, (PetscReal)(a / (width * width)) / (PetscReal)last};

      for (PetscInt d = 0; d < 3; ++d) x[cell.offset[a] + d] = cell.X[a][d];
      for (PetscInt k = 0; k < 8; ++k) {
        const PetscReal *X    = cell.X[last * ((k & 1) + width * (k >> 1 & 1) + width * width * (k >> 2))];
        const PetscReal  size = cell.X[last][0] - cell.X[0][0], phase = 37.1 * X[0] + 91.7 * X[1] + 53.3 * X[2];
        const PetscReal  weight =
          (k & 1 ? at[0] : 1 - at[0]) * (k >> 1 & 1 ? at[1] : 1 - at[1]) * (k >> 2 ? at[2] : 1 - at[2]);

        for (PetscInt d = 0; d < 3; ++d)
          x[cell.offset[a] + d] += weight * distance * size * PetscSinReal((1 + 0.3 * d) * phase + 2 * d);
      }
    }
  }
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscCall(VecRestoreArrayRead(before, &b));
  PetscCall(VecDestroy(&before));
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

/* Solves with the exact displacement prescribed on the surface; u is new. Newton's method starts from the exact
   values at the nodes */
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

/* below, above: by how much the observed order may be smaller or greater, before it settles */
static PetscErrorCode ReportOrder(const char name[], const PetscReal errors[], PetscReal expected, PetscReal below,
  PetscReal above)
{
  const PetscReal order = PetscLog2Real(errors[1] / errors[2]);

  PetscFunctionBeginUser;
  if (order > expected - below && order < expected + above)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "order of the %s: %g\n", name, (double)expected));
  else
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "order of the %s: %g, NOT %g; errors %g %g %g\n", name, (double)order,
      (double)expected, (double)errors[0], (double)errors[1], (double)errors[2]));
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
  PetscReal       values[3], gradients[3], distance = 0, below = 0.1, above = 0.1, scale = 1, effectivity = 0;
  PetscBool       curved = PETSC_FALSE, stresses = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &element));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-distance", &distance, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-effectivity", &effectivity, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-above", &above, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-below", &below, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-curved", &curved, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-stresses", &stresses, NULL)); /* the true error by the element's own */
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-amplitude", &scale,
    NULL)); /* Saint Venant-Kirchhoff is stable at moderate strain only */
  for (PetscInt i = 0; i < 3; ++i) amplitude[i] *= scale;
  ProblemBox(name, lower, upper, cells, &cube);
  PetscCall(ProblemSetOrder(1, &cube));
  for (PetscInt level = 0; level < 3; ++level) {
    DM         dm;
    Elasticity e;
    Vec        u;
    PetscReal  errors[3] = {0, 0, 0}, estimate;

    PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &cube, level + (cube.order == 2 ? 0 : 1), &dm));
    if (distance > 0) PetscCall(Distort(dm, distance));
    if (curved) PetscCall(ProblemMapNodes(dm, Bend));
    PetscCall(ElasticityCreate(dm, 1, &materials[type], &element, &e));
    PetscCall(Solve(dm, e, &materials[type], &u));
    PetscCall(Integrate(dm, &materials[type], NULL, u, errors));
    values[level]    = PetscSqrtReal(errors[0]);
    gradients[level] = PetscSqrtReal(errors[1]);
    if (effectivity > 0 && level == 2) {
      PetscCall(ElasticityRecoverStress(e, u, NULL, NULL, &estimate, NULL));
      if (stresses) PetscCall(StressesError(dm, e, &materials[type], ExactGradient, u, &errors[2]));
      PetscCall(ProblemReport("effectivity of the estimate: distance from 1",
        PetscAbsReal(PetscSqrtReal(estimate / errors[2]) - 1), effectivity));
    }
    PetscCall(VecDestroy(&u));
    PetscCall(ElasticityDestroy(&e));
    PetscCall(DMDestroy(&dm));
  }
  PetscCall(ReportOrder("displacement", values, cube.order + 1, below, above));
  PetscCall(ReportOrder("gradient", gradients, cube.order, below, above));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_manufactured.out
      test:
         suffix: baij
         nsize: {{1 3}}
         args: -pc_type pbjacobi
      test:
         suffix: aij
         nsize: 3
         args: -elasticity_mat_type aij -pc_type gamg
      test:
         suffix: sbaij
         nsize: 2
         args: -elasticity_mat_type sbaij -pc_type bjacobi -sub_pc_type icc
      test:
         suffix: linear
         args: -element {{bbar incompatible}} -pc_type pbjacobi
      test:
         suffix: neohookean
         args: -material neohookean -element {{full bbar}} -pc_type pbjacobi
      test:
         suffix: distorted
         args: -distance 0.15 -element {{full bbar incompatible}} -above 0.15 -pc_type pbjacobi
      test:
         suffix: curved
         args: -curved -element {{full bbar incompatible}} -pc_type pbjacobi
      test:
         suffix: saint_venant
         args: -material saint_venant -amplitude 0.3 -pc_type pbjacobi

   testset:
      args: -pc_type pbjacobi -effectivity 0.2
      test:
         suffix: estimate
         nsize: {{1 3}}
         args: -curved -material {{linear neohookean}}
      test:
         suffix: estimate_order2
         args: -curved -order 2 -material {{linear neohookean}}
      test:
         suffix: estimate_distorted
         args: -distance 0.15 -order 2
         output_file: output/elasticity_manufactured_estimate_order2.out
      test:
         suffix: estimate_tetrahedra
         args: -tetrahedra -order 1 -below 0.4 -curved
         output_file: output/elasticity_manufactured_estimate.out
      test:
         suffix: estimate_tetrahedra_order2
         args: -tetrahedra -order 2 -below 0.4 -curved
         output_file: output/elasticity_manufactured_estimate_order2.out
      test:
         suffix: estimate_stresses
         args: -stresses -element incompatible
         output_file: output/elasticity_manufactured_estimate.out
      test:
         suffix: estimate_stresses_long
         args: -stresses -element {{full bbar}}
         output_file: output/elasticity_manufactured_estimate.out
      test:
         suffix: estimate_stresses_order2
         args: -stresses -order 2 -element {{full bbar}} -above 0.6
         output_file: output/elasticity_manufactured_estimate_order2.out
      test:
         suffix: estimate_stresses_tetrahedra
         args: -stresses -tetrahedra -order 2 -below 0.4
         output_file: output/elasticity_manufactured_estimate_order2.out
      test:
         suffix: estimate_stresses_tetrahedra_long
         args: -stresses -tetrahedra -order 1 -below 0.4
         output_file: output/elasticity_manufactured_estimate.out
      test:
         suffix: estimate_stresses_tetrahedra_bbar
         args: -stresses -tetrahedra -order 2 -element bbar -below 1.6
         output_file: output/elasticity_manufactured_estimate_order2.out

   testset:
      args: -order 2 -pc_type pbjacobi
      output_file: output/elasticity_manufactured_order2.out
      test:
         suffix: order2
         args: -material {{linear neohookean}}
      test:
         suffix: order2_bbar
         args: -element bbar -material {{linear neohookean}} -above 0.6
      test:
         suffix: order2_distorted
         args: -distance 0.15 -element {{full bbar}} -above 0.6
      test:
         suffix: order2_curved
         args: -curved -element {{full bbar}} -material {{linear neohookean}} -above 0.6
      test:
         suffix: order2_tetrahedra
         args: -tetrahedra -material {{linear neohookean}} -below 0.3
      test:
         suffix: order2_tetrahedra_curved
         args: -tetrahedra -curved -below 0.3

   test:
      suffix: tetrahedra
      args: -tetrahedra -pc_type pbjacobi -below 0.4
      output_file: output/elasticity_manufactured.out

TEST*/
