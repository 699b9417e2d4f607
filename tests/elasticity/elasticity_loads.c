static char help[] = "Dead loads on two bodies with vertices moved off the grid: pressure against the force of a "
                     "uniform stress, body force against the mass.\n\n";

#include "../lib/elasticity_problem.h"

static const char *const faces[] = {"slab.xmin", "slab.xmax", "slab.ymin", "slab.ymax", "slab.zmin", "slab.zmax",
  "block.xmin", "block.xmax", "block.ymin", "block.ymax", "block.zmin", "block.zmax"};

static const PetscReal strain = 0.01;

static void Dilation(const PetscReal x[3], PetscReal u[3])
{
  for (PetscInt i = 0; i < 3; ++i) u[i] = strain * x[i];
}

/* The stress 3 kappa strain of a dilation is in equilibrium with a pressure of minus that on the whole surface, at
   every vertex */
static PetscErrorCode CheckPressure(DM dm, const Material materials[], ElementType element)
{
  const ElementType elements[2] = {element, element};
  Elasticity        e;
  Vec               u, force;
  PetscReal         largest, left;

  PetscFunctionBeginUser;
  PetscCall(ElasticityCreate(dm, 2, materials, elements, &e));
  PetscCall(ProblemInterpolate(dm, Dilation, &u));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(ElasticityForce(e, u, force));
  PetscCall(VecNorm(force, NORM_INFINITY, &largest));
  PetscCall(VecScale(force, -1));
  for (PetscInt f = 0; f < 12; ++f) {
    const Material *m = &materials[f / 6];

    PetscCall(
      ElasticityAddPressure(e, faces[f], -3 * strain * m->young / (3 * (1 - 2 * m->poisson)), NULL, NULL, force));
  }
  PetscCall(VecNorm(force, NORM_INFINITY, &left));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", ElementTypes[element]));
  PetscCall(ProblemReport("  pressure less the force of the uniform stress, relative", left / largest, 1e-12));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&u));
  PetscCall(ElasticityDestroy(&e));
  PetscFunctionReturn(0);
}

/* Density times lumped mass on both bodies, one after the other or at once, and nothing on the other body */
static PetscErrorCode CheckBodyForce(DM dm, const Material materials[])
{
  const PetscReal density[3] = {2, -3, 5};
  Elasticity      e;
  Vec             mass, both, one;
  PetscReal       norm, sums[3], volume;

  PetscFunctionBeginUser;
  PetscCall(ElasticityCreate(dm, 2, materials, NULL, &e));
  PetscCall(ElasticityLumpedMass(e, &mass));
  PetscCall(VecDuplicate(mass, &both));
  PetscCall(VecDuplicate(mass, &one));
  PetscCall(VecZeroEntries(both));
  PetscCall(VecZeroEntries(one));
  PetscCall(ElasticityAddBodyForce(e, PETSC_DECIDE, density, both));
  for (PetscInt d = 0; d < 3; ++d) {
    PetscCall(VecStrideNorm(both, d, NORM_1, &sums[d]));
    PetscCall(VecStrideNorm(mass, d, NORM_1, &volume));
    sums[d] = PetscAbsReal(sums[d] - volume * PetscAbsReal(density[d]));
  }
  PetscCall(ProblemReport("sum of the body force less density times volume",
    PetscMax(PetscMax(sums[0], sums[1]), sums[2]), 1e-12));
  PetscCall(ElasticityAddBodyForce(e, 1, density, one));
  PetscCall(VecStrideNorm(one, 0, NORM_1, &volume));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume of the block %.9f\n", (double)(volume / density[0])));
  PetscCall(ElasticityAddBodyForce(e, 0, density, one));
  PetscCall(VecAXPY(one, -1, both));
  PetscCall(VecNorm(one, NORM_INFINITY, &norm));
  PetscCall(ProblemReport("body force on one body after the other less that on both", norm, 1e-15));
  PetscCall(VecDestroy(&one));
  PetscCall(VecDestroy(&both));
  PetscCall(VecDestroy(&mass));
  PetscCall(ElasticityDestroy(&e));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM             dm;
  Elasticity     e;
  Vec            force;
  SceneBody      bodies[2];
  Material       materials[2];
  PetscErrorCode noface, nobody;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemBodies(MATERIAL_LINEAR, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 1, &dm));
  PetscCall(ProblemMoveNodes(dm, 0.02));
  for (PetscInt b = 0; b < 2; ++b) materials[b] = bodies[b].material;
  PetscCall(CheckPressure(dm, materials, ELEMENT_FULL));
  PetscCall(CheckPressure(dm, materials, ELEMENT_BBAR));
  PetscCall(CheckBodyForce(dm, materials));
  PetscCall(ElasticityCreate(dm, 2, materials, NULL, &e));
  PetscCall(DMCreateGlobalVector(dm, &force));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  noface = ElasticityAddPressure(e, "slab.top", 1, NULL, NULL, force);
  nobody = ElasticityAddBodyForce(e, 2, (PetscReal[3]){0, 0, 1}, force);
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "a face and a body that are not there: %s\n",
    noface && nobody ? "refused" : "ACCEPTED"));
  PetscCall(VecDestroy(&force));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 5 2 3}}
      output_file: output/elasticity_loads.out

TEST*/
