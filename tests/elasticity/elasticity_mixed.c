static char help[] =
  "Linear and neo-Hookean bodies in one mesh: how often each is assembled, and cells turned inside out.\n\n";

#include "../lib/elasticity_problem.h"
#include <petsc/private/petscimpl.h> /* PetscObjectStateSet() */

#define NBODIES 4

static void Smooth(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.1 * PetscSinReal(2 * x[0] + x[1]) + 0.05 * x[2] * x[2];
  u[1] = 0.1 * x[0] * x[2];
  u[2] = 0.08 * PetscCosReal(x[1] - 2 * x[2]);
}

static void Smoother(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.04 * PetscCosReal(x[0] - x[2]);
  u[1] = 0.07 * x[1] * x[2];
  u[2] = 0.05 * PetscSinReal(2 * x[1]);
}

/* Turns the cells at the end x = 3 of the chain inside out, and moves nothing else */
static void InsideOut(const PetscReal x[3], PetscReal u[3])
{
  u[0] = x[0] > 2.9 && x[1] < 2 ? -1 : 0;
  u[1] = u[2] = 0;
}

/*
   A chain of three unit cubes of 2 x 2 x 2 cells, bodies 0, 1 and 2, glued together at x = 1 and x = 2, and a fourth
   cube apart.
*/
static PetscErrorCode CreateMesh(DM *dm)
{
  static char        chain[] = "chain", single[] = "single";
  const PetscReal    lower[2][3] = {{0, 0, 0}, {0, 2, 0}}, upper[2][3] = {{3, 1, 1}, {1, 3, 1}};
  const PetscInt     cells[2][3] = {{6, 2, 2}, {2, 2, 2}};
  SceneBody          bodies[2];
  DMLabel            label;
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *x;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  ProblemBox(chain, lower[0], upper[0], cells[0], &bodies[0]);
  ProblemBox(single, lower[1], upper[1], cells[1], &bodies[1]);
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, dm));
  PetscCall(DMGetLabel(*dm, MESH_BODY_LABEL, &label));
  PetscCall(DMGetCoordinateSection(*dm, &section));
  PetscCall(DMGetCoordinatesLocal(*dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(DMPlexGetHeightStratum(*dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt  vertices[8], offset, body;
    PetscReal center[2] = {0, 0};

    PetscCall(MeshGetCellVertices(*dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) {
      PetscCall(PetscSectionGetOffset(section, vertices[a], &offset));
      center[0] += PetscRealPart(x[offset]) / 8;
      center[1] += PetscRealPart(x[offset + 1]) / 8;
    }
    PetscCall(DMLabelGetValue(label, c, &body));
    PetscCall(DMLabelClearValue(label, c, body));
    PetscCall(DMLabelSetValue(label, c, center[1] > 1.5 ? 3 : (PetscInt)center[0]));
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateElasticity(DM dm, const MaterialType types[NBODIES], Elasticity *e)
{
  const ElementType elements[NBODIES] = {ELEMENT_FULL, ELEMENT_BBAR, ELEMENT_BBAR, ELEMENT_FULL};
  Material          materials[NBODIES];
  IS                rows;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < NBODIES; ++b) {
    materials[b] = (Material){.type = types[b], .young = b + 1, .poisson = 0.3};
  }
  PetscCall(ElasticityCreate(dm, NBODIES, materials, elements, e));
  PetscCall(ProblemFixFace(dm, "chain.zmin", &rows));
  PetscCall(ElasticitySetPrescribed(*e, rows));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppendAssemblies(char line[512], const char when[], Elasticity e)
{
  char text[16];

  PetscFunctionBeginUser;
  PetscCall(PetscStrlcat(line, "; ", 512));
  PetscCall(PetscStrlcat(line, when, 512));
  for (PetscInt b = 0; b < NBODIES; ++b) {
    PetscInt n;

    PetscCall(ElasticityGetAssemblies(e, b, &n));
    PetscCall(PetscSNPrintf(text, sizeof(text), " %" PetscInt_FMT, n));
    PetscCall(PetscStrlcat(line, text, 512));
  }
  PetscFunctionReturn(0);
}

/* Largest difference from a tangent that another context assembles from scratch */
static PetscErrorCode CheckAgainstFresh(DM dm, const MaterialType types[NBODIES], Vec u, Mat K)
{
  Elasticity e;
  Mat        fresh;
  Vec        x, y, z;
  PetscReal  norm, scale;

  PetscFunctionBeginUser;
  PetscCall(CreateElasticity(dm, types, &e));
  PetscCall(ElasticityCreateTangent(e, &fresh));
  PetscCall(ElasticityTangent(e, u, fresh));
  PetscCall(ProblemInterpolate(dm, Smooth, &x));
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecDuplicate(x, &z));
  PetscCall(MatMult(K, x, y));
  PetscCall(MatMult(fresh, x, z));
  PetscCall(VecNorm(z, NORM_INFINITY, &scale));
  PetscCall(VecAXPY(z, -1, y));
  PetscCall(VecNorm(z, NORM_INFINITY, &norm));
  PetscCall(ProblemReport("  difference from a fresh tangent, relative", norm / scale, 1e-14));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&z));
  PetscCall(MatDestroy(&fresh));
  PetscCall(ElasticityDestroy(&e));
  PetscFunctionReturn(0);
}

/* Assemblies into one matrix, after a change of it, and into another */
static PetscErrorCode CheckAssemblies(DM dm, const char name[], const MaterialType types[NBODIES])
{
  Elasticity       e;
  Mat              K, other;
  Vec              u, v;
  PetscBool        linear;
  char             line[512];
  PetscObjectState state;

  PetscFunctionBeginUser;
  PetscCall(ProblemInterpolate(dm, Smooth, &u));
  PetscCall(ProblemInterpolate(dm, Smoother, &v));
  PetscCall(CreateElasticity(dm, types, &e));
  PetscCall(ElasticityIsLinear(e, &linear));
  PetscCall(PetscSNPrintf(line, sizeof(line), "%s%s", name, linear ? ", linear" : ""));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(AppendAssemblies(line, "first", e));
  PetscCall(ElasticityTangent(e, v, K));
  PetscCall(AppendAssemblies(line, "second", e));
  PetscCall(CheckAgainstFresh(dm, types, v, K));
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(AppendAssemblies(line, "third", e));
  PetscCall(CheckAgainstFresh(dm, types, u, K));
  PetscCall(MatShift(K, 1));
  PetscCall(ElasticityTangent(e, v, K));
  PetscCall(AppendAssemblies(line, "changed by someone else", e));
  PetscCall(CheckAgainstFresh(dm, types, v, K));
  PetscCall(ElasticityCreateTangent(e, &other));
  PetscCall(PetscObjectStateGet((PetscObject)K, &state));
  PetscCall(PetscObjectStateSet((PetscObject)other, state));
  PetscCall(ElasticityTangent(e, v, other));
  PetscCall(AppendAssemblies(line, "another matrix", e));
  PetscCall(CheckAgainstFresh(dm, types, v, other));
  PetscCall(ElasticitySetPrescribed(e, NULL));
  PetscCall(ElasticityTangent(e, v, other));
  PetscCall(AppendAssemblies(line, "other prescribed rows", e));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", line));
  PetscCall(MatDestroy(&other));
  PetscCall(MatDestroy(&K));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCall(ElasticityDestroy(&e));
  PetscFunctionReturn(0);
}

/* What every function gives where cells of one body are inside out; ranks without such a cell must agree */
static PetscErrorCode CheckInsideOut(DM dm, const char name[], const MaterialType types[NBODIES])
{
  Elasticity e;
  Mat        K;
  Vec        u, force;
  PetscReal  energy, lowest, norm, entries, *stress;
  PetscInt   start, end, infinite = 0;

  PetscFunctionBeginUser;
  PetscCall(CreateElasticity(dm, types, &e));
  PetscCall(ProblemInterpolate(dm, InsideOut, &u));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(ElasticityEnergy(e, u, &energy));
  PetscCallMPI(MPI_Allreduce(&energy, &lowest, 1, MPIU_REAL, MPIU_MIN, PETSC_COMM_WORLD));
  PetscCall(ElasticityForce(e, u, force));
  PetscCall(VecNorm(force, NORM_2, &norm));
  PetscCall(ElasticityCreateTangent(e, &K));
  PetscCall(ElasticityTangent(e, u, K));
  PetscCall(MatNorm(K, NORM_FROBENIUS, &entries));
  PetscCall(ElasticityCellStress(e, u, &stress));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = 0; c < end - start; ++c) {
    if (stress[7 * c] >= PETSC_INFINITY && stress[7 * c + 6] >= PETSC_INFINITY) ++infinite;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &infinite, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
    "%s: energy %s, norm of the force %s, tangent %s, cells with infinite stress %" PetscInt_FMT "\n", name,
    lowest >= PETSC_INFINITY ? "infinite" : "finite", norm >= PETSC_INFINITY ? "infinite" : "finite",
    entries < PETSC_INFINITY ? "finite" : "NOT FINITE", infinite));
  PetscCall(PetscFree(stress));
  PetscCall(MatDestroy(&K));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&u));
  PetscCall(ElasticityDestroy(&e));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const MaterialType l = MATERIAL_LINEAR, n = MATERIAL_NEOHOOKEAN;
  const MaterialType linear[] = {l, l, l, l}, apart[] = {l, l, l, n}, glued[] = {n, l, l, l}, all[] = {n, n, n, n},
                     full[] = {n, l, n, l}, tip[] = {l, l, n, l};
  DM dm;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(CreateMesh(&dm));
  PetscCall(CheckAssemblies(dm, "all linear", linear));
  PetscCall(CheckAssemblies(dm, "neo-Hookean body apart", apart));
  PetscCall(CheckAssemblies(dm, "neo-Hookean body at the chain's end", glued));
  PetscCall(CheckAssemblies(dm, "neo-Hookean bodies at both ends", full));
  PetscCall(CheckAssemblies(dm, "all neo-Hookean", all));
  PetscCall(CheckInsideOut(dm, "linear inside out", linear));
  PetscCall(CheckInsideOut(dm, "neo-Hookean bbar inside out", tip));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_mixed.out
      test:
         suffix: baij
         nsize: {{1 5 2 3}}
      test:
         suffix: aij
         nsize: {{1 3}}
         args: -elasticity_mat_type aij

   test:
      suffix: sbaij
      nsize: {{1 3}}
      args: -elasticity_mat_type sbaij

TEST*/
