static char help[] = "Cook's membrane in plane strain, nearly incompressible: displacement of the corner against "
                     "published values, with all elements.\n\n";

#include "../lib/elasticity_problem.h"

/*
   Quadrilateral (0,0) (48,44) (48,60) (0,44), clamped at x = 0, a dead shear force of 100 spread over x = 48 upward,
   E = 240.565; one cell of thickness 1 without displacement along z. The figure is the vertical displacement of the
   corner (48,60).

   Elguedj, Bazilevs, Calo and Hughes, B-bar and F-bar projection methods for nearly incompressible linear and
   non-linear elasticity and plasticity using higher-order NURBS elements, 2008, set the problem. OpenGeoSys 6
   publishes figures of quadrilaterals on the same n x n meshes: fully integrated, with B-bar, and with the F-bar of
   de Souza Neto et al., which is another one than ours. Its B-bar figures are given to 2 % only; a plane strain
   program of this project's, which shares nothing with it, gave 7.7281869 and 7.9347247. Incompatible modes and cells
   of order 2 are held against the finest meshes.
*/
static const PetscInt meshes[2] = {10, 20};

typedef struct {
  PetscReal poisson;
  PetscInt  loadsteps;
  PetscReal fine;         /* displacement that the finest published meshes approach */
  PetscReal value[3][2];  /* of each element, on each mesh */
  PetscReal tolerance[3]; /* of each element */
} Published;

static const Published published[] = {
  {0.4999, 1, 8.00, {{2.2603330, 2.5197256}, {7.7281869, 7.9347247}, {8.00, 8.00}}, {1e-4, 1e-7, 0.04}}, /* linear */
  {0.499, 10, 6.89, {{2.8406922, 3.8811997}, {6.7462840, 6.8589365}, {0, 0}}, {1e-4, 1e-2, 0}} /* neo-Hookean */
};

static void Map(const PetscReal s[3], PetscReal x[3])
{
  x[0] = 48 * s[0];
  x[1] = 44 * s[0] + s[1] * (44 - 28 * s[0]);
  x[2] = s[2];
}

/* Clamped at x = 0, no displacement along z */
static PetscErrorCode PrescribedRows(DM dm, IS *rows)
{
  IS parts[3];

  PetscFunctionBeginUser;
  PetscCall(ProblemFixFace(dm, "panel.xmin", &parts[0]));
  PetscCall(MeshGetFaceDofs(dm, "panel.zmin", 2, &parts[1]));
  PetscCall(MeshGetFaceDofs(dm, "panel.zmax", 2, &parts[2]));
  PetscCall(ISConcatenate(PETSC_COMM_WORLD, 3, parts, rows));
  for (PetscInt i = 0; i < 3; ++i) PetscCall(ISDestroy(&parts[i]));
  PetscFunctionReturn(0);
}

/* The load of a pull along x over the face x = 48, turned upward */
static PetscErrorCode ShearLoad(Elasticity e, PetscReal traction, Vec load)
{
  Vec      x, component;
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(load, &n));
  PetscCall(VecDuplicate(load, &x));
  PetscCall(VecZeroEntries(x));
  PetscCall(ElasticityAddPressure(e, "panel.xmax", -traction, NULL, NULL, x));
  PetscCall(VecZeroEntries(load));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, n / 3, PETSC_DETERMINE, &component));
  PetscCall(VecStrideGather(x, 0, component, INSERT_VALUES));
  PetscCall(VecStrideScatter(component, 1, load, INSERT_VALUES));
  PetscCall(VecDestroy(&component));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

static PetscErrorCode CornerDisplacement(DM dm, Vec u, PetscReal *value)
{
  Vec                coordinates, local;
  const PetscScalar *x, *l;
  PetscInt           n;

  PetscFunctionBeginUser;
  *value = PETSC_MIN_REAL;
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  PetscCall(VecGetLocalSize(coordinates, &n));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArrayRead(local, &l));
  for (PetscInt i = 0; i < n; i += 3) {
    if (PetscRealPart(x[i]) > 48 - 1e-6 && PetscRealPart(x[i + 1]) > 60 - 1e-6) *value = PetscRealPart(l[i + 1]);
  }
  PetscCall(VecRestoreArrayRead(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* Vertical displacement of the corner on an n x n mesh */
static PetscErrorCode Solve(MaterialType type, ElementType element, PetscInt n, PetscReal *value)
{
  static char     name[]   = "panel";
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  const PetscInt  cells[3] = {n, n, 1};
  const Material  material = {.type = type, .young = 240.565, .poisson = published[type].poisson};
  SceneBody       panel;
  DM              dm;
  IS              rows;
  ProblemBody     body;

  PetscFunctionBeginUser;
  ProblemBox(name, lower, upper, cells, &panel);
  PetscCall(ProblemSetOrder(1, &panel));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &panel, 0, &dm));
  PetscCall(ProblemMapNodes(dm, Map));
  PetscCall(PrescribedRows(dm, &rows));
  PetscCall(ProblemBodyCreate(dm, &material, element, rows, &body));
  for (PetscInt step = 1; step <= published[type].loadsteps; ++step) {
    PetscCall(ShearLoad(body.e, 6.25 * step / published[type].loadsteps, body.load));
    PetscCall(ProblemNewton(body.e, rows, body.load, body.K, body.u));
  }
  PetscCall(CornerDisplacement(dm, body.u, value));
  PetscCall(ProblemBodyDestroy(&body));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  MaterialType     type    = MATERIAL_LINEAR;
  ElementType      element = ELEMENT_FULL;
  PetscInt         order = 1, nmeshes = 2;
  const Published *known;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &element));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-order", &order, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-meshes", &nmeshes, NULL));
  known = &published[type];
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, Poisson's ratio %g, %s\n", MaterialTypes[type], (double)known->poisson,
    ElementTypes[element]));
  for (PetscInt k = 0; k < nmeshes; ++k) {
    PetscReal value;

    PetscCall(Solve(type, element, meshes[k], &value));
    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " x %" PetscInt_FMT " cells: corner moves %.3f, %.0f %% of %g\n",
        meshes[k], meshes[k], (double)value, (double)(100 * value / known->fine), (double)known->fine));
    if (order == 1)
      PetscCall(ProblemReport("  difference from the known value of this mesh, relative",
        PetscAbsReal(value / known->value[element][k] - 1), known->tolerance[element]));
    else
      PetscCall(
        ProblemReport("  difference from the finest meshes, relative", PetscAbsReal(value / known->fine - 1), 0.01));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      args: -elasticity_mat_type aij -ksp_type preonly -pc_type lu -pc_factor_mat_solver_type mumps
      test:
         suffix: linear_full
      test:
         suffix: linear_bbar
         args: -element bbar
      test:
         suffix: linear_incompatible
         args: -element incompatible
      test:
         suffix: neohookean_full
         args: -material neohookean
      test:
         suffix: neohookean_bbar
         args: -material neohookean -element bbar
      test:
         suffix: order2
         args: -order 2 -element bbar -meshes 1 -material {{linear neohookean}separate output}
      test:
         suffix: order2_long
         args: -order 2 -element bbar -material {{linear neohookean}separate output}
      test:
         suffix: tetrahedra
         args: -tetrahedra -order 2 -element bbar -meshes 1 -material {{linear neohookean}separate output}
      test:
         suffix: tetrahedra_long
         args: -tetrahedra -order 2 -element bbar -material {{linear neohookean}separate output}

TEST*/
