static char help[] = "Buckling of a slender neo-Hookean column, clamped below and free above: load at which the "
                     "tangent loses definiteness, against Euler's.\n\n";

#include "../lib/elasticity_problem.h"

static const PetscReal young = 1000, width = 1, height = 12;

/* Number of negative eigenvalues, from the inertia of a factorization */
static PetscErrorCode CountNegative(Mat K, PetscInt *negative)
{
  Mat           factor;
  MatFactorInfo info;
  IS            rows, columns;

  PetscFunctionBeginUser;
  PetscCall(MatGetFactor(K, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
  PetscCall(MatGetOrdering(K, MATORDERINGEXTERNAL, &rows, &columns));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatCholeskyFactorSymbolic(factor, K, rows, &info));
  PetscCall(MatCholeskyFactorNumeric(factor, K, &info));
  PetscCall(MatGetInertia(factor, negative, NULL, NULL));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscCall(MatDestroy(&factor));
  PetscFunctionReturn(0);
}

/* Negative eigenvalues of the tangent at the straight column's equilibrium under a dead load; u is where Newton's
   method starts, and the equilibrium on exit */
static PetscErrorCode Definiteness(Elasticity e, IS rows, PetscReal load, Mat K, Vec u, PetscInt *negative)
{
  Vec force;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecZeroEntries(force));
  PetscCall(ElasticityAddPressure(e, "column.zmax", load / (width * width), NULL, NULL, force));
  PetscCall(ProblemNewton(e, rows, force, K, u));
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(CountNegative(K, negative));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static char     name[]   = "column";
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {width, width, height};
  const PetscReal area = width * width, inertia = area * area / 12,
                  euler = PETSC_PI * PETSC_PI * young * inertia / (4 * height * height);
  Material     material = {.type = MATERIAL_NEOHOOKEAN, .young = young, .poisson = 0};
  MaterialType type     = MATERIAL_NEOHOOKEAN;
  ElementType  element  = ELEMENT_FULL;
  PetscReal    stable = 0.9 * euler, buckled = 1.1 * euler, critical, engesser;
  PetscInt     below, above, cells[3] = {4, 4, 96};
  SceneBody    column;
  DM           dm;
  Elasticity   e;
  Mat          K;
  IS           rows;
  Vec          u;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &element));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-across", &cells[0], NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-poisson", &material.poisson, NULL));
  cells[1] = cells[0];
  engesser = euler / (1 + euler / (5. / 6. * area * young / (2 * (1 + material.poisson))));
  ProblemBox(name, lower, upper, cells, &column);
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &column, 0, &dm));
  PetscCall(ElasticityCreate(dm, 1, &material, &element, &e));
  PetscCall(ProblemFixFace(dm, "column.zmin", &rows));
  PetscCall(ElasticitySetPrescribed(e, rows));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecZeroEntries(u));
  PetscCall(Definiteness(e, rows, stable, K, u, &below));
  PetscCall(Definiteness(e, rows, buckled, K, u, &above));
  /* a square section buckles in two planes at once */
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
    "%s, Poisson's ratio %g: negative eigenvalues at 0.9 of Euler's load: %" PetscInt_FMT ", at 1.1: %" PetscInt_FMT
    "\n",
    ElementTypes[element], (double)material.poisson, below, above));
  while (buckled - stable > 1e-3 * euler) {
    const PetscReal middle = 0.5 * (stable + buckled);
    PetscInt        negative;

    PetscCall(Definiteness(e, rows, middle, K, u, &negative));
    if (negative) buckled = middle;
    else stable = middle;
  }
  critical = 0.5 * (stable + buckled);
  PetscCall(ProblemReport("buckling load against Euler's, relative", PetscAbsReal(critical / euler - 1), 0.02));
  PetscCall(ProblemReport("buckling load against Engesser's, with shear, relative",
    PetscAbsReal(critical / engesser - 1), 0.02));
  PetscCall(VecDestroy(&u));
  PetscCall(MatDestroy(&K));
  PetscCall(ISDestroy(&rows));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      args: -elasticity_mat_type aij -ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps -mat_mumps_icntl_13 1
      test:
         suffix: full
         args: -across 2
      test:
         suffix: bbar
         args: -element bbar -poisson 0.3
      test:
         suffix: bbar_incompressible
         args: -element bbar -poisson 0.49

TEST*/
