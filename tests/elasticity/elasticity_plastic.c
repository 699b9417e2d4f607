static char help[] =
  "Bodies that yield, vertices moved off the grid: force and tangent against differences in a first "
  "and in a second step, the end of a step, work and the largest plastic strain, on any element.\n\n";

#include "../lib/elasticity_problem.h"

static void First(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.02 * PetscSinReal(2 * x[0] + x[1]) + 0.01 * x[2] * x[2];
  u[1] = 0.02 * x[0] * x[2];
  u[2] = 0.016 * PetscCosReal(x[1] - 2 * x[2]);
}

static void Second(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.01 * PetscSinReal(2 * x[0] - x[1]) + 0.03 * x[1] * x[2];
  u[1] = -0.01 * x[0] * x[2];
  u[2] = 0.02 * PetscCosReal(x[1] + 2 * x[2]);
}

static void Direction(const PetscReal x[3], PetscReal u[3])
{
  u[0] = PetscCosReal(5 * x[1] + x[2]);
  u[1] = PetscSinReal(4 * x[0] - x[2]);
  u[2] = PetscCosReal(3 * x[0] * x[1]) - 0.5;
}

/* Along d by central differences; some points change over from elastic to plastic within them */
static PetscErrorCode CheckDifferences(Elasticity e, Vec u, Vec d, Mat K)
{
  Vec         product;
  PetscScalar dKu, uKd;

  PetscFunctionBeginUser;
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(ProblemCheckDifferences(e, u, d, K, 1e-7, 1e-6, 1e-5));
  PetscCall(VecDuplicate(u, &product));
  PetscCall(MatMult(K, u, product));
  PetscCall(VecDot(product, d, &dKu));
  PetscCall(MatMult(K, d, product));
  PetscCall(VecDot(product, u, &uKd));
  PetscCall(
    ProblemReport("asymmetry of the tangent, relative", PetscAbsScalar(dKu - uKd) / PetscAbsScalar(uKd), 1e-12));
  PetscCall(VecDestroy(&product));
  PetscFunctionReturn(0);
}

/* Energy, force and stress stay, and all energy is elastic or plastic work. At finite strain kinematic hardening
   changes forces by the square of the plastic strain of the step */
static PetscErrorCode CheckCommit(Elasticity e, Vec u, PetscReal change)
{
  Vec       f, g;
  PetscReal before, after, norm, scale, work, largest[2];
  PetscBool yielded;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &f));
  PetscCall(VecDuplicate(u, &g));
  PetscCall(ElasticityEnergy(e, u, &before));
  PetscCall(ElasticityForce(e, u, f));
  PetscCall(ElasticityCommit(e, u));
  PetscCall(ElasticityEnergy(e, u, &after));
  PetscCall(ElasticityForce(e, u, g));
  PetscCall(VecNorm(f, NORM_2, &scale));
  PetscCall(VecAXPY(f, -1, g));
  PetscCall(VecNorm(f, NORM_2, &norm));
  PetscCall(ElasticityHasYielded(e, &yielded));
  PetscCall(ElasticityPlasticWork(e, &work, largest));
  PetscCall(ProblemReport("energy over the end of a step, relative", PetscAbsReal(after - before) / before, 1e-12));
  PetscCall(ProblemReport("force over the end of a step, relative", norm / scale, change));
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "yielded %d, plastic work %s, %.3g of the body that yields, %g of the other\n",
      yielded, work > 0 && work < after ? "a part of the energy" : "WRONG", (double)largest[0], (double)largest[1]));
  PetscCall(VecDestroy(&g));
  PetscCall(VecDestroy(&f));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM           dm;
  Elasticity   e;
  Mat          K;
  Vec          u, v, d;
  SceneBody    bodies[2];
  Material     materials[2];
  MaterialType type = MATERIAL_LINEAR, yields = MATERIAL_J2;
  ElementType  elements[2] = {ELEMENT_FULL, ELEMENT_FULL};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&yields, &elements[0]));
  elements[1] = elements[0];
  PetscCall(ProblemBodies(type, bodies));
  PetscCall(ProblemSetOrder(2, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, &dm));
  PetscCall(ProblemMoveNodes(dm, 0.02));
  materials[1]           = bodies[1].material;
  materials[0]           = bodies[0].material;
  materials[0].type      = yields;
  materials[0].hardening = (MaterialHardening){.yield = 0.01, .modulus = 0.1, .kinematic = 0.1};
  PetscCall(ElasticityCreate(dm, 2, materials, elements, &e));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(ProblemInterpolate(dm, First, &u));
  PetscCall(ProblemInterpolate(dm, Second, &v));
  PetscCall(ProblemInterpolate(dm, Direction, &d));
  PetscCall(CheckDifferences(e, u, d, K));
  PetscCall(CheckCommit(e, u, yields == MATERIAL_J2_FINITE ? 1e-5 : 1e-10));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "second step\n"));
  PetscCall(CheckDifferences(e, v, d, K));
  PetscCall(CheckCommit(e, v, yields == MATERIAL_J2_FINITE ? 1e-5 : 1e-10));
  PetscCall(VecDestroy(&d));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCall(MatDestroy(&K));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: full
      nsize: 2

   test:
      suffix: bbar
      args: -element bbar
      output_file: output/elasticity_plastic_full.out

   test:
      suffix: incompatible
      nsize: 2
      args: -element incompatible

   test:
      suffix: order2
      args: -element {{full bbar}} -order 2

   test:
      suffix: tetrahedra
      nsize: 3
      args: -tetrahedra -order {{1 2}separate output}

   test:
      suffix: finite
      nsize: 2
      args: -material j2_finite -element {{full bbar}}

   test:
      suffix: finite_order2
      args: -material j2_finite -element {{full bbar}} -order 2

   test:
      suffix: finite_tetrahedra
      args: -material j2_finite -tetrahedra -order {{1 2}separate output}

TEST*/
