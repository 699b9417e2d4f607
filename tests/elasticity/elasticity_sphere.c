static char help[] = "Thick sphere under internal pressure, an octant of it: displacement and stress against Lame's "
                     "solution on three meshes.\n\n";

#include "../lib/elasticity_problem.h"

#define LEVELS 3

static const PetscReal inner = 1, outer = 2, pressure = 0.01, young = 1;

/* u_r = c ((1 - 2 nu) r + (1 + nu) b^3/(2 r^2))/E, s_r = c (1 - b^3/r^3), s_t = c (1 + b^3/(2 r^3)), c = p a^3/(b^3 -
   a^3) */
typedef struct {
  PetscReal c, b3, poisson;
} Lame;

static Lame LameSolution(PetscReal poisson)
{
  const PetscReal a3 = inner * inner * inner, b3 = outer * outer * outer;

  return (Lame){pressure * a3 / (b3 - a3), b3, poisson};
}

static PetscReal Radius(const PetscReal x[3])
{
  return PetscSqrtReal(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

static void LameDisplacement(const Lame *lame, const PetscReal x[3], PetscReal u[3])
{
  const PetscReal r = Radius(x);

  for (PetscInt d = 0; d < 3; ++d)
    u[d] = lame->c / young * ((1 - 2 * lame->poisson) * r + (1 + lame->poisson) * lame->b3 / (2 * r * r)) * x[d] / r;
}

/* xx yy zz xy yz zx */
static void LameStress(const Lame *lame, const PetscReal x[3], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  const PetscReal  r = Radius(x), r3 = r * r * r, radial = lame->c * (1 - lame->b3 / r3),
                  hoop = lame->c * (1 + lame->b3 / (2 * r3));

  for (PetscInt k = 0; k < 6; ++k)
    sigma[k] = (radial - hoop) * x[row[k]] * x[column[k]] / (r * r) + (row[k] == column[k] ? hoop : 0);
}

/* Adds the squared errors of stress at the cells' centroids, and of displacement at their vertices, and the squares
   of the exact ones */
static PetscErrorCode AddSquares(DM dm, const Lame *lame, const PetscScalar x[], const PetscScalar u[],
  const PetscReal stress[], PetscReal squares[4])
{
  PetscSection section;
  PetscInt     start, end;

  PetscFunctionBeginUser;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt  vertices[8], offset;
    PetscReal center[3] = {0, 0, 0}, exact[6];

    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) {
      PetscReal place[3];

      PetscCall(PetscSectionGetOffset(section, vertices[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) {
        place[d] = PetscRealPart(x[offset + d]);
        center[d] += place[d] / 8;
      }
      LameDisplacement(lame, place, exact);
      for (PetscInt d = 0; d < 3; ++d) {
        squares[0] += PetscSqr(PetscRealPart(u[offset + d]) - exact[d]);
        squares[1] += PetscSqr(exact[d]);
      }
    }
    LameStress(lame, center, exact);
    for (PetscInt k = 0; k < 6; ++k) {
      squares[2] += PetscSqr(stress[7 * (c - start) + k] - exact[k]);
      squares[3] += PetscSqr(exact[k]);
    }
  }
  PetscFunctionReturn(0);
}

/* Relative errors of displacement and stress in the root mean square */
static PetscErrorCode Errors(DM dm, Elasticity e, const Lame *lame, Vec u, PetscReal errors[2])
{
  Vec                coordinates, local;
  const PetscScalar *x, *l;
  PetscReal         *stress, squares[4] = {0, 0, 0, 0};

  PetscFunctionBeginUser;
  PetscCall(ElasticityCellStress(e, u, &stress));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArrayRead(local, &l));
  PetscCall(AddSquares(dm, lame, x, l, stress, squares));
  PetscCall(VecRestoreArrayRead(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCall(PetscFree(stress));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, squares, 4, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  errors[0] = PetscSqrtReal(squares[0] / squares[1]);
  errors[1] = PetscSqrtReal(squares[2] / squares[3]);
  PetscFunctionReturn(0);
}

/* Every plane of symmetry keeps its normal displacement */
static PetscErrorCode SymmetryRows(DM dm, IS *rows)
{
  IS parts[3];

  PetscFunctionBeginUser;
  PetscCall(MeshGetFaceDofs(dm, "shell.x0", 0, &parts[0]));
  PetscCall(MeshGetFaceDofs(dm, "shell.y0", 1, &parts[1]));
  PetscCall(MeshGetFaceDofs(dm, "shell.z0", 2, &parts[2]));
  PetscCall(ISConcatenate(PETSC_COMM_WORLD, 3, parts, rows));
  for (PetscInt d = 0; d < 3; ++d) PetscCall(ISDestroy(&parts[d]));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(PetscInt level, ElementType element, PetscReal poisson, PetscReal errors[2])
{
  static char    name[]   = "shell";
  const Material material = {.type = MATERIAL_LINEAR, .young = young, .poisson = poisson};
  const Lame     lame     = LameSolution(poisson);
  SceneBody      shell    = {0};
  DM             dm;
  IS             rows;
  ProblemBody    body;

  PetscFunctionBeginUser;
  shell.name                = name;
  shell.shape               = SHAPE_SPHERE_SHELL;
  shell.curved              = PETSC_TRUE;
  shell.layers              = 2;
  shell.octant.inner.radius = inner;
  shell.octant.outer.radius = outer;
  for (PetscInt d = 0; d < 3; ++d) shell.cells[d] = 2;
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &shell, level, &dm));
  PetscCall(SymmetryRows(dm, &rows));
  PetscCall(ProblemBodyCreate(dm, &material, element, rows, &body));
  PetscCall(ElasticityAddPressure(body.e, "shell.inner", pressure, NULL, NULL, body.load));
  PetscCall(ProblemNewton(body.e, rows, body.load, body.K, body.u));
  PetscCall(Errors(dm, body.e, &lame, body.u, errors));
  PetscCall(ProblemBodyDestroy(&body));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  MaterialType    type     = MATERIAL_LINEAR;
  ElementType     element  = ELEMENT_FULL;
  const PetscReal limit[2] = {0.01, 0.012};
  const PetscReal least    = 1.8;
  PetscReal       poisson  = 0.3, errors[LEVELS][2];

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &element));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-poisson", &poisson, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, Poisson's ratio %g\n", ElementTypes[element], (double)poisson));
  for (PetscInt level = 0; level < LEVELS; ++level) {
    PetscCall(Solve(level, element, poisson, errors[level]));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
      "level %" PetscInt_FMT ": error of the displacement %.2g %%, of the stress %.2g %%\n", level,
      (double)(100 * errors[level][0]), (double)(100 * errors[level][1])));
  }
  for (PetscInt k = 0; k < 2; ++k) {
    const PetscReal order = PetscLog2Real(errors[LEVELS - 2][k] / errors[LEVELS - 1][k]);

    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s %g %%, order %s %g\n", k ? "stress" : "displacement",
      errors[LEVELS - 1][k] < limit[k] ? "below" : "above", (double)(100 * limit[k]), order > least ? "above" : "below",
      (double)least));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      args: -elasticity_mat_type aij -ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps
      nsize: {{1 3}}
      test:
         suffix: full
      test:
         suffix: bbar
         args: -element bbar
      test:
         suffix: full_incompressible
         args: -poisson 0.4999
      test:
         suffix: bbar_incompressible
         args: -element bbar -poisson 0.4999

TEST*/
