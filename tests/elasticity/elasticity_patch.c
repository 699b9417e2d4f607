static char help[] =
  "Patch test: an affine displacement of vertices moved off the grid has constant stress and no force inside.\n\n";

#include "../lib/elasticity_problem.h"

static const char *const faces[] = {"slab.xmin", "slab.xmax", "slab.ymin", "slab.ymax", "slab.zmin", "slab.zmax",
  "block.xmin", "block.xmax", "block.ymin", "block.ymax", "block.zmin", "block.zmax"};

static const PetscReal gradient[9] = {0.02, 0.05, -0.01, 0.03, -0.04, 0.02, 0.06, 0.01, 0.03};

static void Affine(const PetscReal x[3], PetscReal u[3])
{
  for (PetscInt i = 0; i < 3; ++i)
    u[i] = 0.1 * (i + 1) + gradient[3 * i] * x[0] + gradient[3 * i + 1] * x[1] + gradient[3 * i + 2] * x[2];
}

/* Hooke's stress of the gradient, xx yy zz xy yz zx, and the von Mises stress from its deviator */
static void HookeStress(const Material *m, PetscReal sigma[7])
{
  const PetscReal lambda = m->young * m->poisson / ((1 + m->poisson) * (1 - 2 * m->poisson)),
                  mu     = 0.5 * m->young / (1 + m->poisson);
  const PetscReal trace  = gradient[0] + gradient[4] + gradient[8];
  PetscReal       mean, square = 0;

  for (PetscInt k = 0; k < 3; ++k) sigma[k] = lambda * trace + 2 * mu * gradient[4 * k];
  sigma[3] = mu * (gradient[1] + gradient[3]);
  sigma[4] = mu * (gradient[5] + gradient[7]);
  sigma[5] = mu * (gradient[2] + gradient[6]);
  mean     = (sigma[0] + sigma[1] + sigma[2]) / 3;
  for (PetscInt k = 0; k < 3; ++k) square += PetscSqr(sigma[k] - mean) + 2 * PetscSqr(sigma[3 + k]);
  sigma[6] = PetscSqrtReal(1.5 * square);
}

/* Cell stress against Hooke's, or against that of the first cell of its body */
static PetscErrorCode CheckStress(Elasticity e, DM dm, Vec u, const Material materials[])
{
  PetscReal *stress, error = 0;
  PetscInt   start, end;

  PetscFunctionBeginUser;
  PetscCall(ElasticityCellStress(e, u, &stress));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt  body;
    PetscReal expected[7];

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    if (materials[body].type == MATERIAL_LINEAR) HookeStress(&materials[body], expected);
    else {
      const MaterialLaw *law;
      MaterialModuli     moduli;

      PetscCall(MaterialGetLaw(&materials[body], &law));
      PetscCall(MaterialGetModuli(&materials[body], &moduli, NULL));
      law->cauchy(&moduli, gradient, expected);
      expected[6] = stress[7 * (c - start) + 6];
    }
    for (PetscInt k = 0; k < 7; ++k) error = PetscMax(error, PetscAbsReal(stress[7 * (c - start) + k] - expected[k]));
  }
  PetscCall(PetscFree(stress));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCall(ProblemReport("error of the cell stress", error, 1e-13));
  PetscFunctionReturn(0);
}

static void Smooth(const PetscReal x[3], PetscReal u[3])
{
  u[0] = 0.1 * PetscSinReal(2 * x[0] + x[1]) + 0.05 * x[2] * x[2];
  u[1] = 0.1 * x[0] * x[2];
  u[2] = 0.08 * PetscCosReal(x[1] - 2 * x[2]);
}

/* Averaged over a cell, the pressure kappa theta of full integration is that of the mean dilatation: both elements
   have the same cell stress */
static PetscErrorCode CheckElements(DM dm, const Material materials[])
{
  const ElementType elements[2] = {ELEMENT_BBAR, ELEMENT_BBAR};
  Elasticity        full, bbar;
  Vec               u;
  PetscReal        *sigma, *tau, error = 0, largest = 0;
  PetscInt          start, end;

  PetscFunctionBeginUser;
  PetscCall(ElasticityCreate(dm, 2, materials, NULL, &full));
  PetscCall(ElasticityCreate(dm, 2, materials, elements, &bbar));
  PetscCall(ProblemInterpolate(dm, Smooth, &u));
  PetscCall(ElasticityCellStress(full, u, &sigma));
  PetscCall(ElasticityCellStress(bbar, u, &tau));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt i = 0; i < 7 * (end - start); ++i) {
    error   = PetscMax(error, PetscAbsReal(sigma[i] - tau[i]));
    largest = PetscMax(largest, PetscAbsReal(sigma[i]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "stress of a smooth displacement: %s\n", largest > 0.1 ? "some" : "NONE"));
  PetscCall(ProblemReport("difference of the two elements' cell stress", error, 1e-13));
  PetscCall(PetscFree(sigma));
  PetscCall(PetscFree(tau));
  PetscCall(VecDestroy(&u));
  PetscCall(ElasticityDestroy(&bbar));
  PetscCall(ElasticityDestroy(&full));
  PetscFunctionReturn(0);
}

/* Largest force away from the faces, and the sum of all forces */
static PetscErrorCode CheckForce(Elasticity e, DM dm, Vec u)
{
  Vec         f;
  PetscReal   norm, surface;
  PetscScalar sum;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &f));
  PetscCall(ElasticityForce(e, u, f));
  PetscCall(VecNorm(f, NORM_INFINITY, &surface));
  PetscCall(VecSum(f, &sum));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(faces); ++i) {
    IS rows;

    PetscCall(ProblemFixFace(dm, faces[i], &rows));
    PetscCall(VecISSet(f, rows, 0));
    PetscCall(ISDestroy(&rows));
  }
  PetscCall(VecNorm(f, NORM_INFINITY, &norm));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "force on the surface: %s\n", surface > 1e-3 ? "some" : "NONE"));
  PetscCall(ProblemReport("force inside", norm, 1e-14));
  PetscCall(ProblemReport("sum of the forces", PetscAbsScalar(sum), 1e-13));
  PetscCall(VecDestroy(&f));
  PetscFunctionReturn(0);
}

/* By the divergence theorem from the vertices of bilinear facets, of this rank */
static PetscErrorCode FacetVolume(DM dm, PetscReal *volume)
{
  const PetscReal    gauss[2] = {0.5 - PetscSqrtReal(3) / 6, 0.5 + PetscSqrtReal(3) / 6};
  Vec                coordinates;
  PetscSection       section;
  const PetscScalar *x;

  PetscFunctionBeginUser;
  *volume = 0;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(faces); ++i) {
    IS              facets;
    const PetscInt *f;
    PetscInt        n;

    PetscCall(MeshGetFacets(dm, faces[i], &facets));
    PetscCall(ISGetLocalSize(facets, &n));
    PetscCall(ISGetIndices(facets, &f));
    for (PetscInt q = 0; q < 4 * n; ++q) { /* int x_z n_z dA at 4 points of each bilinear facet */
      const PetscReal s = gauss[q & 1], t = gauss[q >> 1 & 1];
      const PetscReal N[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}, Ns[4] = {t - 1, 1 - t, t, -t},
                      Nt[4] = {s - 1, -s, s, 1 - s};
      PetscInt  v[4];
      PetscReal p[3] = {0, 0, 0}, ps[3] = {0, 0, 0}, pt[3] = {0, 0, 0};

      PetscCall(MeshGetFacetVertices(dm, f[q / 4], v));
      for (PetscInt a = 0; a < 4; ++a) {
        PetscInt offset;

        PetscCall(PetscSectionGetOffset(section, v[a], &offset));
        for (PetscInt d = 0; d < 3; ++d) {
          p[d] += N[a] * PetscRealPart(x[offset + d]);
          ps[d] += Ns[a] * PetscRealPart(x[offset + d]);
          pt[d] += Nt[a] * PetscRealPart(x[offset + d]);
        }
      }
      *volume += 0.25 * p[2] * (ps[0] * pt[1] - ps[1] * pt[0]);
    }
    PetscCall(ISRestoreIndices(facets, &f));
    PetscCall(ISDestroy(&facets));
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* By the same theorem from the loads of a unit tension on facets of any order: x = sum N_a x_a, so the volume is sum
   x_a . int N_a n dA / 3 */
static PetscErrorCode LoadVolume(Elasticity e, DM dm, PetscReal *volume)
{
  Vec         coordinates, places, load;
  PetscScalar sum;

  PetscFunctionBeginUser;
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMCreateGlobalVector(dm, &places));
  PetscCall(VecDuplicate(places, &load));
  PetscCall(DMLocalToGlobal(dm, coordinates, INSERT_VALUES, places));
  PetscCall(VecZeroEntries(load));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(faces); ++i)
    PetscCall(ElasticityAddPressure(e, faces[i], -1, NULL, NULL, load));
  PetscCall(VecDot(load, places, &sum));
  *volume = PetscRealPart(sum) / 3;
  PetscCall(VecDestroy(&load));
  PetscCall(VecDestroy(&places));
  PetscFunctionReturn(0);
}

/* Lumped mass adds up to the volume */
static PetscErrorCode CheckMass(Elasticity e, DM dm, PetscBool bilinear)
{
  Vec         mass;
  PetscScalar sum;
  PetscReal   volume = 0, smallest;

  PetscFunctionBeginUser;
  PetscCall(ElasticityLumpedMass(e, &mass));
  PetscCall(VecSum(mass, &sum));
  PetscCall(VecMin(mass, NULL, &smallest));
  PetscCall(VecDestroy(&mass));
  if (bilinear) PetscCall(FacetVolume(dm, &volume));
  else PetscCall(LoadVolume(e, dm, &volume));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume %.9f, lumped masses: %s\n", (double)volume,
    smallest > 0 ? "positive" : "NOT POSITIVE"));
  PetscCall(
    ProblemReport("sum of the lumped mass less the volume", PetscAbsReal(PetscRealPart(sum) / 3 - volume), 1e-13));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM           dm;
  Elasticity   e;
  Vec          u;
  SceneBody    bodies[2];
  Material     materials[2];
  MaterialType type        = MATERIAL_LINEAR;
  ElementType  elements[2] = {ELEMENT_FULL, ELEMENT_FULL};

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
  PetscCall(ProblemInterpolate(dm, Affine, &u));
  PetscCall(CheckStress(e, dm, u, materials));
  PetscCall(CheckForce(e, dm, u));
  PetscCall(CheckMass(e, dm, (PetscBool)(bodies[0].order == 1)));
  PetscCall(CheckElements(dm, materials));
  PetscCall(VecDestroy(&u));
  PetscCall(ElasticityDestroy(&e));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/elasticity_patch.out
      test:
         suffix: linear
         nsize: {{1 2 3 5}}
      test:
         suffix: points
         args: -elasticity_quadrature 3
      test:
         suffix: finite
         nsize: {{1 3}}
         args: -material neohookean
      test:
         suffix: incompatible
         args: -element incompatible -elasticity_quadrature {{2 3}}
      test:
         suffix: bbar
         args: -element bbar -material {{linear neohookean}}
      test:
         suffix: bbar_points
         args: -element bbar -material {{linear neohookean}} -elasticity_quadrature 3
      test:
         suffix: order2
         nsize: {{1 5 2 3}}
         args: -order 2
      test:
         suffix: order2_elements
         args: -order 2 -element {{full bbar}} -material {{linear neohookean}}
      test:
         suffix: tetrahedra
         args: -tetrahedra -order {{1 2}} -material {{linear neohookean}} -element {{full bbar}}
      test:
         suffix: tetrahedra_ranks
         nsize: 3
         args: -tetrahedra -order {{1 2}}

TEST*/
