static char help[] = "Energy, force and tangent of two bodies with vertices moved off the grid: rigid motions, "
                     "differences, symmetry, objectivity, prescribed rows.\n\n";

#include "../lib/elasticity_problem.h"

static void Translation(const PetscReal x[3], PetscReal u[3])
{
  (void)x;
  u[0] = 0.3;
  u[1] = -0.7;
  u[2] = 1.1;
}

/* Infinitesimal rotation about (1, 2, 3) */
static void Spin(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 2 * x[2] - 3 * x[1];
  u[1] = 3 * x[0] - x[2];
  u[2] = x[1] - 2 * x[0];
}

/* Rotation by 0.8 about z */
static void Turn(const PetscReal x[3], PetscReal u[3])
{
  const PetscReal c = PetscCosReal(0.8), s = PetscSinReal(0.8);

  u[0] = (c - 1) * x[0] - s * x[1];
  u[1] = s * x[0] + (c - 1) * x[1];
  u[2] = 0;
}

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

/* Rotation by 2.1 about (1, 2, 2)/3: R = c I + (1 - c) n n^T + s [n] */
static const PetscReal angle = 2.1, axis[3] = {1. / 3, 2. / 3, 2. / 3};

static void Rotate(const PetscReal x[3], PetscReal y[3])
{
  const PetscReal c = PetscCosReal(angle), s = PetscSinReal(angle),
                  along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];

  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt j = (i + 1) % 3, k = (i + 2) % 3;

    y[i] = c * x[i] + (1 - c) * along * axis[i] + s * (axis[j] * x[k] - axis[k] * x[j]);
  }
}

/* The smooth deformation followed by the rotation */
static void SmoothRotated(const PetscReal x[3], PetscReal u[3])
{
  PetscReal y[3];

  Smooth(x, u);
  for (PetscInt i = 0; i < 3; ++i) y[i] = x[i] + u[i];
  Rotate(y, u);
  for (PetscInt i = 0; i < 3; ++i) u[i] -= x[i];
}

/* Force and energy of a rigid motion, beside the force of a unit field */
static PetscErrorCode CheckRigid(Elasticity e, DM dm, const char name[], Field motion)
{
  char      text[64];
  Vec       u, f;
  PetscReal energy, norm;

  PetscFunctionBeginUser;
  PetscCall(ProblemInterpolate(dm, motion, &u));
  PetscCall(VecDuplicate(u, &f));
  PetscCall(ElasticityForce(e, u, f));
  PetscCall(ElasticityEnergy(e, u, &energy));
  PetscCall(VecNorm(f, NORM_INFINITY, &norm));
  PetscCall(PetscSNPrintf(text, sizeof(text), "force of a rigid %s", name));
  PetscCall(ProblemReport(text, norm, 1e-13));
  PetscCall(PetscSNPrintf(text, sizeof(text), "energy of a rigid %s", name));
  PetscCall(ProblemReport(text, PetscAbsReal(energy), 1e-13));
  PetscCall(VecDestroy(&f));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

/* a.K b = b.K a */
static PetscErrorCode CheckSymmetry(Mat K, Vec a, Vec b)
{
  Vec         product;
  PetscScalar ab, ba;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(a, &product));
  PetscCall(MatMult(K, b, product));
  PetscCall(VecDot(product, a, &ab));
  PetscCall(MatMult(K, a, product));
  PetscCall(VecDot(product, b, &ba));
  PetscCall(ProblemReport("asymmetry of the tangent, relative", PetscAbsScalar(ab - ba) / PetscAbsScalar(ab), 1e-13));
  PetscCall(VecDestroy(&product));
  PetscFunctionReturn(0);
}

/* A rotation after the deformation leaves the energy and turns the force; there too force and tangent are derivatives
 */
static PetscErrorCode CheckRotated(Elasticity e, DM dm, Vec u, Vec d, Mat K)
{
  Vec       rotated, f, fr;
  PetscReal energy, turned, error, scale;

  PetscFunctionBeginUser;
  PetscCall(ProblemInterpolate(dm, SmoothRotated, &rotated));
  PetscCall(VecDuplicate(u, &f));
  PetscCall(VecDuplicate(u, &fr));
  PetscCall(ElasticityEnergy(e, u, &energy));
  PetscCall(ElasticityEnergy(e, rotated, &turned));
  PetscCall(ElasticityForce(e, u, f));
  PetscCall(ElasticityForce(e, rotated, fr));
  PetscCall(VecNorm(f, NORM_2, &scale));
  PetscCall(ProblemMapVector(f, Rotate));
  PetscCall(VecAXPY(fr, -1, f));
  PetscCall(VecNorm(fr, NORM_2, &error));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "rotated by %g\n", (double)angle));
  PetscCall(ProblemReport("change of the energy, relative", PetscAbsReal(turned - energy) / energy, 1e-12));
  PetscCall(ProblemReport("force less the rotated one, relative", error / scale, 1e-12));
  PetscCall(ElasticityTangent(e, rotated, K));
  PetscCall(ProblemCheckDifferences(e, rotated, d, K, 1e-5, 1e-7, 1e-7));
  PetscCall(CheckSymmetry(K, u, d));
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(VecDestroy(&fr));
  PetscCall(VecDestroy(&f));
  PetscCall(VecDestroy(&rotated));
  PetscFunctionReturn(0);
}

/* Near null vectors are orthonormal, and zero where free is */
static PetscErrorCode CheckModes(Mat K, Vec free)
{
  MatNullSpace modes;
  const Vec   *mode;
  Vec          masked;
  PetscInt     n;
  PetscReal    norm, outside = 0, skew = 0;

  PetscFunctionBeginUser;
  PetscCall(MatGetNearNullSpace(K, &modes));
  PetscCall(MatNullSpaceGetVecs(modes, NULL, &n, &mode));
  PetscCall(VecDuplicate(free, &masked));
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(VecPointwiseMult(masked, mode[i], free));
    PetscCall(VecAXPY(masked, -1, mode[i]));
    PetscCall(VecNorm(masked, NORM_INFINITY, &norm));
    outside = PetscMax(outside, norm);
    for (PetscInt j = 0; j <= i; ++j) {
      PetscScalar dot;

      PetscCall(VecDot(mode[i], mode[j], &dot));
      skew = PetscMax(skew, PetscAbsScalar(dot - (i == j)));
    }
  }
  PetscCall(VecDestroy(&masked));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " modes with prescribed rows\n", n));
  PetscCall(ProblemReport("their size on those rows", outside, 0));
  PetscCall(ProblemReport("their distance from orthonormal", skew, 1e-13));
  PetscFunctionReturn(0);
}

/* With P the projection on the rows left free, the tangent of prescribed rows is P K P + diagonal */
static PetscErrorCode CheckPrescribed(Elasticity e, DM dm, Vec u, Vec d, Mat K)
{
  IS        rows;
  Mat       Kp;
  Vec       free, diagonal, x, y, z;
  PetscReal norm, scale, smallest;

  PetscFunctionBeginUser;
  PetscCall(ProblemFixFace(dm, "slab.zmin", &rows));
  PetscCall(ElasticitySetPrescribed(e, rows));
  PetscCall(ElasticityCreateTangent(e, &Kp));
  PetscCall(ElasticitySetNearNullSpace(e, Kp));
  PetscCall(ElasticityTangent(e, u, Kp));
  PetscCall(VecDuplicate(u, &free));
  PetscCall(VecDuplicate(u, &diagonal));
  PetscCall(VecDuplicate(u, &x));
  PetscCall(VecDuplicate(u, &y));
  PetscCall(VecDuplicate(u, &z));
  PetscCall(VecSet(free, 1));
  PetscCall(VecISSet(free, rows, 0));
  PetscCall(MatGetDiagonal(K, diagonal));
  PetscCall(VecMin(diagonal, NULL, &smallest));
  PetscCall(VecPointwiseMult(x, free, d));
  PetscCall(MatMult(K, x, y));
  PetscCall(VecPointwiseMult(y, free, y));
  PetscCall(VecAXPY(x, -1, d));
  PetscCall(VecPointwiseMult(x, diagonal, x));
  PetscCall(VecAXPY(y, -1, x));
  PetscCall(MatMult(Kp, d, z));
  PetscCall(VecNorm(z, NORM_2, &scale));
  PetscCall(VecAXPY(y, -1, z));
  PetscCall(VecNorm(y, NORM_2, &norm));
  PetscCall(ProblemReport("tangent with prescribed rows against the projected one, relative", norm / scale, 1e-13));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "diagonal: %s\n", smallest > 0 ? "positive" : "NOT POSITIVE"));
  PetscCall(CheckModes(Kp, free));
  PetscCall(ElasticitySetPrescribed(e, NULL));
  PetscCall(MatDestroy(&Kp));
  PetscCall(VecDestroy(&z));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(VecDestroy(&free));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(0);
}

/* No entry was allocated in vain, and the near null space holds six modes without force */
static PetscErrorCode CheckMatrix(Mat K, MaterialType type)
{
  MatNullSpace modes;
  const Vec   *mode;
  PetscInt     n, bs;
  PetscReal    largest = 0;
  MatInfo      info;

  PetscFunctionBeginUser;
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCall(MatGetInfo(K, MAT_GLOBAL_SUM, &info));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "block size %" PetscInt_FMT ", allocations during assembly %g\n", bs,
    (double)info.mallocs));
  PetscCall(MatGetNearNullSpace(K, &modes));
  PetscCall(MatNullSpaceGetVecs(modes, NULL, &n, &mode));
  if (type == MATERIAL_LINEAR) {
    for (PetscInt i = 0; i < n; ++i) {
      Vec       force;
      PetscReal norm;

      PetscCall(VecDuplicate(mode[i], &force));
      PetscCall(MatMult(K, mode[i], force));
      PetscCall(VecNorm(force, NORM_INFINITY, &norm));
      PetscCall(VecDestroy(&force));
      largest = PetscMax(largest, norm);
    }
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " modes, ", n));
  PetscCall(ProblemReport("their force", largest, 1e-13));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM           dm;
  Elasticity   e;
  Mat          K;
  Vec          u, d;
  SceneBody    bodies[2];
  Material     materials[2];
  MaterialType type        = MATERIAL_LINEAR;
  ElementType  elements[2] = {ELEMENT_FULL, ELEMENT_FULL};
  PetscReal    energy;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(ProblemOptions(&type, &elements[0]));
  elements[1] = elements[0];
  PetscCall(ProblemBodies(type, bodies));
  PetscCall(ProblemSetOrder(2, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, bodies[0].order == 2 ? 0 : 1, &dm));
  PetscCall(ProblemMoveNodes(dm, 0.02));
  for (PetscInt b = 0; b < 2; ++b) materials[b] = bodies[b].material;
  PetscCall(ElasticityCreate(dm, 2, materials, elements, &e));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(ElasticitySetNearNullSpace(e, K));
  PetscCall(ProblemInterpolate(dm, Smooth, &u));
  PetscCall(ProblemInterpolate(dm, Direction, &d));

  PetscCall(CheckRigid(e, dm, "translation", Translation));
  PetscCall(type == MATERIAL_LINEAR ? CheckRigid(e, dm, "rotation", Spin) : CheckRigid(e, dm, "rotation", Turn));
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(ElasticityEnergy(e, u, &energy));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "energy %.9e\n", (double)energy));
  PetscCall(ProblemCheckDifferences(e, u, d, K, 1e-5, 1e-7, 1e-7));
  PetscCall(CheckSymmetry(K, u, d));
  if (type != MATERIAL_LINEAR) PetscCall(CheckRotated(e, dm, u, d, K));
  PetscCall(CheckPrescribed(e, dm, u, d, K));
  PetscCall(CheckMatrix(K, type));

  PetscCall(VecDestroy(&d));
  PetscCall(VecDestroy(&u));
  PetscCall(MatDestroy(&K));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_derivatives_linear.out
      test:
         suffix: linear
         nsize: {{1 5 2 3}}
      test:
         suffix: types
         nsize: 3
         args: -elasticity_mat_type {{aij sbaij}}

   test:
      suffix: linear_bbar
      args: -element bbar

   test:
      suffix: linear_incompatible
      args: -element incompatible

   test:
      suffix: neohookean
      nsize: {{1 3}}
      args: -material neohookean

   test:
      suffix: neohookean_bbar
      args: -material neohookean -element bbar

   testset:
      args: -order 2
      test:
         suffix: order2
         nsize: 3
         args: -elasticity_mat_type {{baij aij sbaij}}
      test:
         suffix: order2_bbar
         args: -element bbar
      test:
         suffix: order2_neohookean
         args: -material neohookean
      test:
         suffix: order2_neohookean_bbar
         args: -material neohookean -element bbar

   testset:
      args: -tetrahedra -order 2
      test:
         suffix: tetrahedra
         nsize: 3
         args: -elasticity_mat_type {{baij aij sbaij}}
      test:
         suffix: tetrahedra_neohookean
         args: -material neohookean
      test:
         suffix: tetrahedra_neohookean_bbar
         args: -material neohookean -element bbar
      test:
         suffix: tetrahedra_order1
         args: -order 1 -material neohookean

   test:
      suffix: saint_venant
      args: -material saint_venant

TEST*/
