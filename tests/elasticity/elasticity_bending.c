static char help[] = "A cantilever 100 times as long as high, one to four cells through its height: deflection of the "
                     "tip against beam theory.\n\n";

#include "../lib/elasticity_problem.h"

#define LENGTH 100.0 /* height and width 1 */

static const Material material = {.type = MATERIAL_LINEAR, .young = 1e6, .poisson = 0.3};

/* Euler and Bernoulli under a weight of q a length: q L^4/(8 E I), of which shear would add 1e-4 */
static PetscReal BeamDeflection(PetscReal q)
{
  return q * PetscPowReal(LENGTH, 4) / (8 * material.young / 12);
}

/* Mean of the displacements along y on the face at the tip */
static PetscErrorCode TipDeflection(DM dm, Vec u, PetscReal *value)
{
  IS  rows;
  Vec tip;

  PetscFunctionBeginUser;
  PetscCall(MeshGetFaceDofs(dm, "beam.xmax", 1, &rows));
  PetscCall(VecGetSubVector(u, rows, &tip));
  PetscCall(VecMean(tip, value));
  PetscCall(VecRestoreSubVector(u, rows, &tip));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(0);
}

/* Deflection over that of beam theory */
static PetscErrorCode Solve(ElementType element, PetscInt layers, PetscReal *ratio)
{
  static char     name[]   = "beam";
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {LENGTH, 1, 1}, density[3] = {0, 0.01, 0};
  const PetscInt  cells[3] = {50, layers, 1};
  SceneBody       beam;
  DM              dm;
  IS              rows;
  ProblemBody     body;

  PetscFunctionBeginUser;
  ProblemBox(name, lower, upper, cells, &beam);
  PetscCall(ProblemSetOrder(1, &beam));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &beam, 0, &dm));
  PetscCall(ProblemFixFace(dm, "beam.xmin", &rows));
  PetscCall(ProblemBodyCreate(dm, &material, element, rows, &body));
  PetscCall(ElasticityAddBodyForce(body.e, 0, density, body.load));
  PetscCall(ProblemNewton(body.e, rows, body.load, body.K, body.u));
  PetscCall(TipDeflection(dm, body.u, ratio));
  *ratio /= BeamDeflection(density[1]);
  PetscCall(ProblemBodyDestroy(&body));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  MaterialType type      = MATERIAL_LINEAR;
  ElementType  element   = ELEMENT_FULL;
  PetscReal    tolerance = 0.02;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &element));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-tolerance", &tolerance, NULL));
  for (PetscInt layers = 1; layers <= 4; ++layers) {
    PetscReal ratio;
    char      text[64];

    PetscCall(Solve(element, layers, &ratio));
    PetscCall(
      PetscSNPrintf(text, sizeof(text), "%" PetscInt_FMT " through the height: error of the deflection", layers));
    PetscCall(ProblemReport(text, PetscAbsReal(ratio - 1), tolerance));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      args: -elasticity_mat_type aij -ksp_type preonly -pc_type lu -pc_factor_mat_solver_type mumps
      test:
         suffix: incompatible
         nsize: {{1 3}}
         args: -element incompatible
      test:
         suffix: order2
         args: -order 2 -element {{full bbar}} -tolerance 0.01

TEST*/
