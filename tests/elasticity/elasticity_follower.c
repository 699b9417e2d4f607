static char help[] = "The slope of pressures that follow their faces against differences of their load: its symmetric "
                     "part over some faces, all of it over a closed surface.\n\n";

#include "../lib/elasticity_problem.h"

static void Smooth(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.1 * PetscSinReal(2 * x[0] + x[1]) + 0.05 * x[2] * x[2];
  u[1] = 0.1 * x[0] * x[2];
  u[2] = 0.08 * PetscCosReal(x[1] - 2 * x[2]);
}

static void Direction(const PetscReal x[3], PetscReal u[3])
{
  u[0] = PetscCosReal(5 * x[1] + x[2]);
  u[1] = PetscSinReal(4 * x[0] - x[2]);
  u[2] = PetscCosReal(3 * x[0] * x[1]) - 0.5;
}

static void Other(const PetscReal x[3], PetscReal u[3])
{
  u[0] = PetscSinReal(3 * x[1] - x[2]);
  u[1] = PetscCosReal(2 * x[0] + 3 * x[2]);
  u[2] = PetscSinReal(x[0] + 4 * x[1]);
}

static const char *const all[] = {"slab.xmin", "slab.xmax", "slab.ymin", "slab.ymax", "slab.zmin", "slab.zmax"};

/* Load of the first n faces, each with another pressure unless the surface is closed; slope may be NULL */
static PetscErrorCode GetLoad(Elasticity e, PetscInt n, Vec u, Vec load, Mat slope)
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(load));
  if (slope) PetscCall(MatZeroEntries(slope));
  for (PetscInt f = 0; f < n; ++f)
    PetscCall(ElasticityAddFollower(e, all[f], n == 6 ? 0.7 : 0.3 + f, NULL, NULL, u, load, slope));
  if (!slope) PetscFunctionReturn(0);
  PetscCall(MatAssemblyBegin(slope, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(slope, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Of the load along d, by central differences: but for rounding exact, for the load is quadratic */
static PetscErrorCode GetDifference(Elasticity e, PetscInt n, Vec u, Vec d, Vec difference)
{
  const PetscReal h = 0.1;
  Vec             place, load;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &place));
  PetscCall(VecDuplicate(u, &load));
  PetscCall(VecWAXPY(place, h, d, u));
  PetscCall(GetLoad(e, n, place, difference, NULL));
  PetscCall(VecWAXPY(place, -h, d, u));
  PetscCall(GetLoad(e, n, place, load, NULL));
  PetscCall(VecAXPY(difference, -1, load));
  PetscCall(VecScale(difference, 1 / (2 * h)));
  PetscCall(VecDestroy(&load));
  PetscCall(VecDestroy(&place));
  PetscFunctionReturn(0);
}

/* b.S a is the mean of b.F'a and a.F'b; whole: S a is F'a */
static PetscErrorCode CheckSlope(Elasticity e, PetscInt n, Vec u, Vec a, Vec b, PetscBool whole, Mat S)
{
  Vec         load, Fa, Fb, Sa;
  PetscScalar ab, ba, slope;
  PetscReal   off, size;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &load));
  PetscCall(VecDuplicate(u, &Fa));
  PetscCall(VecDuplicate(u, &Fb));
  PetscCall(VecDuplicate(u, &Sa));
  PetscCall(GetLoad(e, n, u, load, S));
  PetscCall(GetDifference(e, n, u, a, Fa));
  PetscCall(GetDifference(e, n, u, b, Fb));
  PetscCall(MatMult(S, a, Sa));
  PetscCall(VecDot(Fa, b, &ba));
  PetscCall(VecDot(Fb, a, &ab));
  PetscCall(VecDot(Sa, b, &slope));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " faces, load's derivative %s\n", n,
    PetscAbsScalar(ab - ba) < 1e-12 ? "symmetric" : "not symmetric"));
  PetscCall(ProblemReport("slope less the derivative's symmetric part", PetscAbsScalar(slope - (ab + ba) / 2), 1e-12));
  PetscCall(VecNorm(Fa, NORM_2, &size));
  PetscCall(VecAXPY(Sa, -1, Fa));
  PetscCall(VecNorm(Sa, NORM_2, &off));
  if (whole) PetscCall(ProblemReport("slope less the derivative, relative", off / size, 1e-12));
  PetscCall(VecDestroy(&Sa));
  PetscCall(VecDestroy(&Fb));
  PetscCall(VecDestroy(&Fa));
  PetscCall(VecDestroy(&load));
  PetscFunctionReturn(0);
}

/* What has a prescribed row or column is left out of the slope, and nothing of the load */
static PetscErrorCode CheckPrescribed(Elasticity e, DM dm, Vec u, Vec d, Mat S)
{
  IS        rows;
  Vec       free, masked, load, before, product, there;
  PetscReal off, size;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &free));
  PetscCall(VecDuplicate(u, &masked));
  PetscCall(VecDuplicate(u, &load));
  PetscCall(VecDuplicate(u, &before));
  PetscCall(VecDuplicate(u, &product));
  PetscCall(VecDuplicate(u, &there));
  PetscCall(ProblemFixFace(dm, "slab.zmin", &rows));
  PetscCall(VecSet(free, 1));
  PetscCall(VecISSet(free, rows, 0));
  PetscCall(VecPointwiseMult(masked, free, d));
  PetscCall(GetLoad(e, 6, u, before, S));
  PetscCall(MatMult(S, masked, product));
  PetscCall(VecPointwiseMult(product, free, product));
  PetscCall(VecNorm(product, NORM_2, &size));
  PetscCall(ElasticitySetPrescribed(e, rows));
  PetscCall(GetLoad(e, 6, u, load, S));
  PetscCall(ElasticitySetPrescribed(e, NULL));
  PetscCall(MatMult(S, d, there));
  PetscCall(VecAXPY(there, -1, product));
  PetscCall(VecNorm(there, NORM_2, &off));
  PetscCall(ProblemReport("slope with prescribed rows less the projected one, relative", off / size, 1e-13));
  PetscCall(VecAXPY(load, -1, before));
  PetscCall(VecNorm(load, NORM_2, &off));
  PetscCall(ProblemReport("change of the load by them", off, 0));
  PetscCall(VecDestroy(&there));
  PetscCall(VecDestroy(&product));
  PetscCall(VecDestroy(&before));
  PetscCall(VecDestroy(&load));
  PetscCall(VecDestroy(&masked));
  PetscCall(VecDestroy(&free));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM          dm;
  Elasticity  e;
  Mat         S;
  Vec         u, a, b;
  SceneBody   bodies[2];
  Material    materials[2];
  ElementType elements[2] = {ELEMENT_FULL, ELEMENT_FULL};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemBodies(MATERIAL_NEOHOOKEAN, bodies));
  PetscCall(ProblemSetOrder(2, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, &dm));
  PetscCall(ProblemMoveNodes(dm, 0.02));
  for (PetscInt i = 0; i < 2; ++i) materials[i] = bodies[i].material;
  PetscCall(ElasticityCreate(dm, 2, materials, elements, &e));
  PetscCall(ElasticityCreateTangent(e, &S));
  PetscCall(ProblemInterpolate(dm, Smooth, &u));
  PetscCall(ProblemInterpolate(dm, Direction, &a));
  PetscCall(ProblemInterpolate(dm, Other, &b));
  PetscCall(CheckSlope(e, 3, u, a, b, PETSC_FALSE, S));
  PetscCall(CheckSlope(e, 6, u, a, b, PETSC_TRUE, S));
  PetscCall(CheckPrescribed(e, dm, u, a, S));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&a));
  PetscCall(VecDestroy(&u));
  PetscCall(MatDestroy(&S));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_follower.out
      test:
         suffix: order1
         nsize: {{1 3}}
      test:
         suffix: order2
         args: -order 2
      test:
         suffix: tetrahedra
         args: -tetrahedra -order {{1 2}}

TEST*/
