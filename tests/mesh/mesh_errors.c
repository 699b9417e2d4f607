static char help[] = "Bad input to the mesh gives one sentence, the same error on every rank, and no hang.\n\n";

#include "../lib/elasticity_problem.h"
#include "../lib/attempt.h"

/* Prints the error of a call */
#define EXPECT(name, call) \
  do { \
    PetscErrorCode expected; \
    PetscCall(AttemptBegin()); \
    expected = call; \
    PetscCall(AttemptEnd()); \
    PetscCall(AttemptCompareRanks(name, expected)); \
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", name, expected ? attempt_sentence : "NO ERROR")); \
  } while (0)

static PetscErrorCode BadBodies(void)
{
  SceneBody bodies[2], bad[2];
  DM        dm;

  PetscFunctionBeginUser;
  PetscCall(ProblemBodies(MATERIAL_LINEAR, bodies));
  EXPECT("no bodies", MeshCreate(PETSC_COMM_WORLD, 0, bodies, 0, &dm));
  EXPECT("refine -1", MeshCreate(PETSC_COMM_WORLD, 2, bodies, -1, &dm));
  EXPECT("refine 40", MeshCreate(PETSC_COMM_WORLD, 2, bodies, 40, &dm));
  PetscCall(PetscArraycpy(bad, bodies, 2));
  bad[1].upper[2] = bad[1].lower[2] - 1;
  EXPECT("negative box", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  bad[1].upper[2] = (PetscReal)NAN;
  EXPECT("NaN in a corner", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  PetscCall(PetscArraycpy(bad, bodies, 2));
  bad[0].cells[1] = 0;
  EXPECT("no cells", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  bad[0].cells[1] = PETSC_MAX_INT;
  EXPECT("too many cells", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  PetscCall(PetscArraycpy(bad, bodies, 2));
  bad[1].name = bad[0].name;
  EXPECT("one name twice", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  PetscFunctionReturn(0);
}

static PetscErrorCode BadQueries(void)
{
  SceneBody  bodies[2];
  Material   materials[2] = {{.type = MATERIAL_LINEAR, .young = 1, .poisson = 0.3},
      {.type = MATERIAL_LINEAR, .young = 1, .poisson = 0.5}};
  DM         dm;
  IS         is;
  Elasticity e;

  PetscFunctionBeginUser;
  PetscCall(ProblemBodies(MATERIAL_LINEAR, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, &dm));
  EXPECT("unknown face", MeshGetFacets(dm, "slab.top", &is));
  EXPECT("unknown body", MeshGetFaceVertices(dm, "slat.zmax", &is));
  EXPECT("component 3", MeshGetFaceDofs(dm, "slab.zmax", 3, &is));
  EXPECT("Poisson's ratio 0.5", ElasticityCreate(dm, 2, materials, NULL, &e));
  materials[1].poisson = 0.3;
  materials[1].young   = 0;
  EXPECT("Young's modulus 0", ElasticityCreate(dm, 2, materials, NULL, &e));
  EXPECT("fewer materials than bodies", ElasticityCreate(dm, 1, materials, NULL, &e));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

typedef struct {
  const char *name;
  SceneBody   body;
} BadShape;

#define SHELL(...) \
  { \
    .name = shell, .shape = SHAPE_SPHERE_SHELL, .curved = PETSC_TRUE, .cells = {2, 2, 2}, .layers = 1, __VA_ARGS__ \
  }
#define TUBE(...) \
  { \
    .name = tube, .shape = SHAPE_TUBE_ARC, .curved = PETSC_TRUE, __VA_ARGS__ \
  }
#define PRISM(...) \
  { \
    .name = prism, .shape = SHAPE_HALF_ELLIPSE, .curved = PETSC_TRUE, __VA_ARGS__ \
  }

static PetscErrorCode BadShapes(void)
{
  static char shell[] = "shell", tube[] = "tube", prism[] = "prism", egg[] = "egg", ball[] = "ball", box[] = "box",
              file[]   = "file";
  const BadShape bad[] = {
    {"box graded by -1", {.name = box, .upper = {1, 1, 1}, .cells = {1, 2, 1}, .grading = {1, -1, 1}}},
    {"box graded by NaN", {.name = box, .upper = {1, 1, 1}, .cells = {1, 2, 1}, .grading = {1, (PetscReal)NAN, 1}}},
    {"too many even cells",
      {.name = box, .upper = {1, 1, 1}, .cells = {1, 2, 1}, .grading = {1, 4, 1}, .even = {1, 3, 1}}},
    {"radii swapped", TUBE(.cells = {1, 2, 1}, .tube = {.radii = {2, 1}, .angles = {0, 90}, .extent = {0, 1}})},
    {"inner radius 0", TUBE(.cells = {1, 2, 1}, .tube = {.radii = {0, 1}, .angles = {0, 90}, .extent = {0, 1}})},
    {"angle 0", TUBE(.cells = {1, 2, 1}, .tube = {.radii = {1, 2}, .angles = {90, 90}, .extent = {0, 1}})},
    {"more than a ring", TUBE(.cells = {1, 8, 1}, .tube = {.radii = {1, 2}, .angles = {0, 361}, .extent = {0, 1}})},
    {"extent backwards", TUBE(.cells = {1, 2, 1}, .tube = {.radii = {1, 2}, .angles = {0, 90}, .extent = {1, 0}})},
    {"-3 cells around", TUBE(.cells = {1, -3, 1}, .tube = {.radii = {1, 2}, .angles = {0, 90}, .extent = {0, 1}})},
    {"too few cells around", TUBE(.cells = {1, 1, 1}, .tube = {.radii = {1, 2}, .angles = {0, 180}, .extent = {0, 1}})},
    {"tube graded by -1",
      TUBE(.cells = {1, 2, 1}, .grading = {-1, 1, 1}, .tube = {.radii = {1, 2}, .angles = {0, 90}, .extent = {0, 1}})},
    {"huge tube",
      TUBE(.cells = {1000000, 1000000, 1000000}, .tube = {.radii = {1, 2}, .angles = {0, 90}, .extent = {0, 1}})},
    {"depth along the axis", PRISM(.cells = {2, 2, 1}, .layers = 1,
                               .ellipse = {.axis = 2, .depth = 5, .half = -1, .semi_axes = {1, 1}, .extent = {0, 1}})},
    {"half along the depth", PRISM(.cells = {2, 2, 1}, .layers = 1,
                               .ellipse = {.axis = 2, .depth = 0, .half = 3, .semi_axes = {1, 1}, .extent = {0, 1}})},
    {"semi-axis 0", PRISM(.cells = {2, 2, 1}, .layers = 1,
                      .ellipse = {.axis = 2, .depth = 0, .half = 4, .semi_axes = {1, 0}, .extent = {0, 1}})},
    {"no layers", PRISM(.cells = {2, 2, 1}, .layers = 0,
                    .ellipse = {.axis = 2, .depth = 0, .half = 4, .semi_axes = {1, 1}, .extent = {0, 1}})},
    {"no ring", PRISM(.cells = {2, 2, 0}, .layers = 1,
                  .ellipse = {.axis = 2, .depth = 0, .half = 4, .semi_axes = {1, 1}, .extent = {0, 1}})},
    {"spheres swapped", SHELL(.octant = {.inner = {.radius = 2}, .outer = {.radius = 1}})},
    {"spheres that cross", SHELL(.octant = {.inner = {.radius = 1}, .outer = {.radius = 1.1, .center = {-0.5, 0, 0}}})},
    {"cap within the inner sphere",
      SHELL(.octant = {.inner = {.radius = 1}, .outer = {.radius = 2}, .cap = {.radius = 0.5}})},
    {"corner outside", SHELL(.octant = {.inner = {.radius = 1}, .outer = {.radius = 2, .center = {3, 0, 0}}})},
    {"radius 0", SHELL(.octant = {.inner = {.radius = 0}, .outer = {.radius = 1}})},
    {"sign 3", SHELL(.octant = {.signs = {1, 3, 1}, .inner = {.radius = 1}, .outer = {.radius = 2}})},
    {"layers graded by 1e9", SHELL(.octant = {.inner = {.radius = 1}, .outer = {.radius = 2}, .layer_grading = 1e9})},
    {"semi-axes that cross", {.name    = egg,
                               .shape  = SHAPE_SPHEROID_SHELL,
                               .cells  = {2, 2, 2},
                               .layers = 1,
                               .octant = {.inner_axes = {1, 1, 1}, .outer_axes = {2, 0.9, 2}}}},
    {"ball of radius -1",
      {.name = ball, .shape = SHAPE_BALL, .cells = {2, 2, 2}, .layers = 1, .octant = {.outer = {.radius = -1}}}},
    {"ball without a core",
      {.name = ball, .shape = SHAPE_BALL, .cells = {2, 0, 2}, .layers = 1, .octant = {.outer = {.radius = 1}}}},
    {"no mesh file", {.name = file, .shape = SHAPE_GMSH}},
    {"unknown shape", {.name = file, .shape = (BodyShape)77}},
  };
  DM dm;

  PetscFunctionBeginUser;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(bad); ++i)
    EXPECT(bad[i].name, MeshCreate(PETSC_COMM_WORLD, 1, &bad[i].body, 0, &dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(BadBodies());
  PetscCall(BadShapes());
  PetscCall(BadQueries());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{2 3}}
      args: -malloc_dump 0
      filter: sed -e "s/9223372036854775807/2147483647/"
      output_file: output/mesh_errors_1.out

TEST*/
