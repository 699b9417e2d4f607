static char help[] =
  "The error estimate where it must be exact: fields linear in each body, and quadratic fields on uniform meshes.\n\n";

#include "../lib/elasticity_problem.h"
#include "elasticity_stresses.h"

static const Material linear = {.type = MATERIAL_LINEAR, .young = 2, .poisson = 0.3};

/* Continuous, and linear in each third of the chain */
static void Kinked(const PetscReal x[3], PetscReal u[3])
{
  const PetscReal kinks = 0.2 * PetscMax(0, x[0] - 1) - 0.3 * PetscMax(0, x[0] - 2);

  u[0] = 0.1 * x[0] + kinks + 0.05 * x[2];
  u[1] = 0.1 * x[1] - 2 * kinks;
  u[2] = 0.02 * x[0] + 0.07 * x[1];
}

static void Skew(const PetscReal x[3], PetscReal image[3])
{
  image[0] = x[0];
  image[1] = x[1] + 0.1 * PetscSinReal(2 * x[0] + 3 * x[2]);
  image[2] = x[2] + 0.08 * PetscSinReal(5 * x[1]);
}

static void Quadratic(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.1 * x[0] * x[0] + 0.2 * x[1] * x[2] - 0.1 * x[2] * x[2];
  u[1] = 0.3 * x[0] * x[1] + 0.1 * x[0];
  u[2] = 0.1 * x[1] * x[1] - 0.2 * x[2] * x[2] + 0.1 * x[0] * x[2];
}

static void QuadraticGradient(const PetscReal x[3], PetscReal H[3][3])
{
  const PetscReal gradient[3][3] = {{0.2 * x[0], 0.2 * x[2], 0.2 * x[1] - 0.2 * x[2]},
    {0.3 * x[1] + 0.1, 0.3 * x[0], 0}, {0.1 * x[2], 0.2 * x[1], -0.4 * x[2] + 0.1 * x[0]}};

  for (PetscInt k = 0; k < 9; ++k) H[k / 3][k % 3] = gradient[k / 3][k % 3];
}

/* A box of 3 x 1 x 1, cut into three bodies at x = 1 and x = 2 unless it is to be one */
static PetscErrorCode CreateMesh(PetscInt nx, PetscInt ny, PetscBool cut, Field map, DM *dm)
{
  static char        chain[]  = "chain";
  const PetscReal    lower[3] = {0, 0, 0}, upper[3] = {3, 1, 1};
  const PetscInt     cells[3] = {nx, ny, 2};
  SceneBody          body;
  DMLabel            label;
  Vec                coordinates;
  const PetscScalar *x;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  ProblemBox(chain, lower, upper, cells, &body);
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &body, 0, dm));
  if (map) PetscCall(ProblemMapNodes(*dm, map));
  if (!cut) PetscFunctionReturn(0);
  PetscCall(DMGetLabel(*dm, MESH_BODY_LABEL, &label));
  PetscCall(DMGetCoordinatesLocal(*dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(DMPlexGetHeightStratum(*dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PointCell cell;
    PetscReal center = 0;

    PetscCall(PointCellGet(*dm, c, x, &cell));
    for (PetscInt a = 0; a < 8; ++a) center += cell.X[a][0] / 8;
    PetscCall(DMLabelClearValue(label, c, 0));
    PetscCall(DMLabelSetValue(label, c, (PetscInt)center));
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

/* The estimate of each body, checked to be the sum over the cells; energy is that of all, at scale times the field */
static PetscErrorCode Estimate(DM dm, MaterialType type, ElementType element, Field field, PetscReal scale,
  PetscReal bodies[3], PetscReal *energy)
{
  const Material    materials[3] = {{.type = type, .young = 2, .poisson = 0.3},
       {.type = type, .young = 50, .poisson = 0.1}, {.type = type, .young = 3, .poisson = 0.4}};
  const ElementType elements[3]  = {element, element, element};
  Elasticity        e;
  Vec               u;
  PetscReal        *cells, sum = 0;
  PetscInt          start, end;

  PetscFunctionBeginUser;
  PetscCall(ElasticityCreate(dm, 3, materials, elements, &e));
  PetscCall(ProblemInterpolate(dm, field, &u));
  PetscCall(VecScale(u, scale));
  PetscCall(ElasticityEnergy(e, u, energy));
  PetscCall(ElasticityRecoverStress(e, u, NULL, NULL, bodies, &cells));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = 0; c < end - start; ++c) sum += cells[c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscCall(ProblemReport("  sum over cells against bodies",
    PetscAbsReal(sum - bodies[0] - bodies[1] - bodies[2]) / (sum + *energy), 1e-13));
  PetscCall(PetscFree(cells));
  PetscCall(VecDestroy(&u));
  PetscCall(ElasticityDestroy(&e));
  PetscFunctionReturn(0);
}

/* Nothing is smoothed across the borders of bodies that share vertices */
static PetscErrorCode CheckKinked(MaterialType type, ElementType element)
{
  DM        dm;
  PetscReal bodies[3], energy;

  PetscFunctionBeginUser;
  PetscCall(CreateMesh(6, 3, PETSC_TRUE, Skew, &dm));
  PetscCall(Estimate(dm, type, element, Kinked, 1, bodies, &energy));
  PetscCall(ProblemReport("  linear in each of three glued bodies: error over energy",
    (bodies[0] + bodies[1] + bodies[2]) / energy, 1e-24));
  PetscCall(DMDestroy(&dm));
  PetscCall(CreateMesh(6, 3, PETSC_FALSE, Skew, &dm));
  PetscCall(Estimate(dm, type, element, Kinked, 1, bodies, &energy));
  PetscCall(ProblemReport("  the same in one body: energy over error", energy / bodies[0], 100));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* At the cells' centroids the strains of the interpolant of a quadratic field are exact, and the field's are linear */
static PetscErrorCode CheckQuadratic(MaterialType type, ElementType element)
{
  const PetscReal scale = type == MATERIAL_LINEAR ? 1 : 1e-7;
  Elasticity      e;
  DM              dm;
  Vec             u;
  PetscReal       bodies[3], energy, truth;

  PetscFunctionBeginUser;
  PetscCall(CreateMesh(7, 4, PETSC_FALSE, NULL, &dm));
  PetscCall(ProblemInterpolate(dm, Quadratic, &u));
  PetscCall(ElasticityCreate(dm, 1, &linear, &element, &e));
  PetscCall(StressesError(dm, e, &linear, QuadraticGradient, u, &truth));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(Estimate(dm, type, element, Quadratic, scale, bodies, &energy));
  PetscCall(ProblemReport("  quadratic: relative distance from the true error",
    PetscAbsReal(bodies[0] / (scale * scale * truth) - 1), type == MATERIAL_LINEAR ? 1e-12 : 1e-6));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* No interior vertex: the recovered strain is that of the mean of the cells */
static PetscErrorCode CheckOneLayer(MaterialType type, ElementType element)
{
  DM        dm;
  PetscReal bodies[3], energy;

  PetscFunctionBeginUser;
  PetscCall(CreateMesh(9, 1, PETSC_FALSE, NULL, &dm));
  PetscCall(Estimate(dm, type, element, Quadratic, 1, bodies, &energy));
  PetscCall(ProblemReport("  one layer: error over energy", bodies[0] / energy, 1));
  PetscCall(ProblemReport("  one layer: energy over error", energy / bodies[0], 1000));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* The same figures on any number of ranks */
static PetscErrorCode CheckRanks(MaterialType type, ElementType element)
{
  DM        dm;
  PetscReal bodies[3], energy;

  PetscFunctionBeginUser;
  PetscCall(CreateMesh(9, 5, PETSC_TRUE, Skew, &dm));
  PetscCall(Estimate(dm, type, element, Skew, 0.5, bodies, &energy));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  smooth: error over energy %.4e %.4e %.4e\n", (double)(bodies[0] / energy),
    (double)(bodies[1] / energy), (double)(bodies[2] / energy)));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (PetscInt i = 0; i < 4; ++i) {
    const MaterialType type    = i / 2 ? MATERIAL_NEOHOOKEAN : MATERIAL_LINEAR;
    const ElementType  element = i % 2 ? ELEMENT_BBAR : ELEMENT_FULL;

    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s\n", MaterialTypes[type], ElementTypes[element]));
    PetscCall(CheckKinked(type, element));
    PetscCall(CheckQuadratic(type, element));
    PetscCall(CheckOneLayer(type, element));
    PetscCall(CheckRanks(type, element));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 5 2 3}}

TEST*/
