/*
   Rigid surfaces: plane, sphere, cylinder, cone, torus, profiles that are extruded or revolved, and STL files. Contact
   uses the formula of the surface, or the facets of the file. The mesh of the body is a cube of one cell, which carries
   the rigid body motion. The only face of the cube represents the surface.
*/
#include "shapesimpl.h"

static const char *const faces[] = {"surface", NULL};

static PetscErrorCode RigidSurfaceCheckProfile(MPI_Comm comm, const SceneBody *body)
{
  const PetscInt   n = (PetscInt)body->own[SURFACE_PROFILE];
  const PetscReal *p = &body->own[SURFACE_PROFILE + 1], *a = &body->own[SURFACE_AXIS], *b = &body->own[SURFACE_ACROSS];
  PetscReal        cross = 0.0;

  PetscFunctionBegin;
  SceneCheck(n % 2 == 0 && n >= 4, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the key points has %" PetscInt_FMT " numbers, but needs two numbers for each of at least two points",
    body->name, n);
  for (PetscInt k = 0; k < n; k += 2) {
    SceneCheck(k + 2 >= n || p[k] != p[k + 2] || p[k + 1] != p[k + 3], comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the key points has the point (%g, %g) twice", body->name, (double)p[k], (double)p[k + 1]);
    SceneCheck(body->shape != SHAPE_RIGID_REVOLVED || p[k] >= 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the key points has the point (%g, %g), but its first number is a distance from the axis and must "
      "not be negative",
      body->name, (double)p[k], (double)p[k + 1]);
  }
  for (PetscInt c = 0; c < 3; ++c) cross += PetscSqr(a[c] * b[(c + 1) % 3] - a[(c + 1) % 3] * b[c]);
  SceneCheck(body->shape != SHAPE_RIGID_EXTRUDED || cross > 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the vectors of the keys across and direction are parallel, but must be perpendicular", body->name);
  SceneCheck(body->own[SURFACE_OUTSIDE] >= 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the key outside is %g, but must be 0 or positive", body->name, (double)body->own[SURFACE_OUTSIDE]);
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeSize_RigidSurface(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const PetscReal *own  = body->own;
  const PetscBool  line = (PetscBool)(body->shape == SHAPE_RIGID_EXTRUDED || body->shape == SHAPE_RIGID_REVOLVED);
  const PetscBool  stl  = (PetscBool)(body->shape == SHAPE_RIGID_STL);
  const PetscBool  round =
    (PetscBool)(body->shape != SHAPE_RIGID_PLANE && body->shape != SHAPE_RIGID_CONE && !line && !stl);
  PetscReal square = 0.0;

  PetscFunctionBegin;
  SceneCheck(body->material.type == MATERIAL_RIGID, comm, PETSC_ERR_ARG_WRONG, body,
    "Body \"%s\": its shape is a rigid surface, which needs the material rigid, but its material is %s", body->name,
    MaterialTypes[body->material.type]);
  for (PetscInt c = 0; c < 3; ++c) square += PetscSqr(own[SURFACE_AXIS + c]);
  SceneCheck(body->shape == SHAPE_RIGID_SPHERE || stl || square > 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the vector of its axis or normal has the length 0", body->name);
  SceneCheck(!round || own[SURFACE_RADIUS] > 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the key radius is %g, but must be positive", body->name, (double)own[SURFACE_RADIUS]);
  SceneCheck(body->shape != SHAPE_RIGID_TORUS ||
               (own[SURFACE_SECTION] > 0.0 && own[SURFACE_SECTION] < own[SURFACE_RADIUS]),
    comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the key section_radius is %g, but must lie between 0 and the radius %g", body->name,
    (double)own[SURFACE_SECTION], (double)own[SURFACE_RADIUS]);
  SceneCheck(body->shape != SHAPE_RIGID_CONE || (own[SURFACE_ANGLE] > 0.0 && own[SURFACE_ANGLE] < 90.0), comm,
    PETSC_ERR_ARG_OUTOFRANGE, body, "Body \"%s\": the key half_angle is %g, but must lie between 0 and 90 degrees",
    body->name, (double)own[SURFACE_ANGLE]);
  SceneCheck(own[SURFACE_SIZE] >= 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the key size is %g, but must be positive", body->name, (double)own[SURFACE_SIZE]);
  SceneCheck(own[SURFACE_MASS] >= 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the key mass is %g, but must be 0 or positive", body->name, (double)own[SURFACE_MASS]);
  if (line) PetscCall(RigidSurfaceCheckProfile(comm, body));
  *ncells    = 1;
  *nvertices = 8;
  PetscFunctionReturn(0);
}

static PetscInt RigidSurfaceVertex(PETSC_UNUSED const SceneBody *body, const void *context, PetscInt i, PetscInt j,
  PetscInt k, PetscReal x[3])
{
  const SceneSurfaceCube *cube = context;

  for (PetscInt c = 0; x && c < 3; ++c)
    x[c] = cube->corner[c] + i * cube->size * cube->edge[0][c] + j * cube->size * cube->edge[1][c] +
           k * cube->size * cube->edge[2][c];
  return i + 2 * j + 4 * k;
}

static PetscErrorCode ShapeCreate_RigidSurface(const SceneBody *body, ShapeGrid *grid)
{
  SceneSurfaceCube cube;
  const ShapeBlock block = {{1, 1, 1}, {0, 0, 0, 0, 0, 0}, &cube, RigidSurfaceVertex};

  PetscFunctionBegin;
  SceneSurfaceGetCube(body, &cube);
  PetscCall(ShapeGridCreate(body, 1, &block, 8, PETSC_FALSE, grid));
  PetscFunctionReturn(0);
}

#define SURFACE_KEY(name, n, at, required) SHAPE_KEY(name, KEY_REALS, n, own[at], required)
/* The last keys of every rigid surface */
#define SURFACE_END \
  SURFACE_KEY("mass", 1, SURFACE_MASS, PETSC_FALSE), \
  { \
    NULL, KEY_REALS, 0, 0, PETSC_FALSE \
  }

static const ShapeKey plane_keys[] = {
  SURFACE_KEY("point", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("normal", 3, SURFACE_AXIS, PETSC_TRUE),
  SURFACE_KEY("size", 1, SURFACE_SIZE, PETSC_FALSE),
  SURFACE_END,
};
static const ShapeKey sphere_keys[] = {
  SURFACE_KEY("center", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("radius", 1, SURFACE_RADIUS, PETSC_TRUE),
  SURFACE_END,
};
static const ShapeKey cylinder_keys[] = {
  SURFACE_KEY("center", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("direction", 3, SURFACE_AXIS, PETSC_TRUE),
  SURFACE_KEY("radius", 1, SURFACE_RADIUS, PETSC_TRUE),
  SURFACE_END,
};
static const ShapeKey cone_keys[] = {
  SURFACE_KEY("tip", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("direction", 3, SURFACE_AXIS, PETSC_TRUE),
  SURFACE_KEY("half_angle", 1, SURFACE_ANGLE, PETSC_TRUE),
  SURFACE_KEY("size", 1, SURFACE_SIZE, PETSC_FALSE),
  SURFACE_END,
};
static const ShapeKey torus_keys[] = {
  SURFACE_KEY("center", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("direction", 3, SURFACE_AXIS, PETSC_TRUE),
  SURFACE_KEY("radius", 1, SURFACE_RADIUS, PETSC_TRUE),
  SURFACE_KEY("section_radius", 1, SURFACE_SECTION, PETSC_TRUE),
  SURFACE_END,
};

#define PROFILE_KEYS \
  {"points", KEY_LIST, SURFACE_MAX_PROFILE, offsetof(SceneBody, own[SURFACE_PROFILE]), PETSC_TRUE}, \
    SURFACE_KEY("outside", 1, SURFACE_OUTSIDE, PETSC_FALSE), SURFACE_KEY("size", 1, SURFACE_SIZE, PETSC_FALSE)
static const ShapeKey extruded_keys[] = {
  SURFACE_KEY("center", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("direction", 3, SURFACE_AXIS, PETSC_TRUE),
  SURFACE_KEY("across", 3, SURFACE_ACROSS, PETSC_TRUE),
  PROFILE_KEYS,
  SURFACE_END,
};
static const ShapeKey revolved_keys[] = {
  SURFACE_KEY("center", 3, SURFACE_POINT, PETSC_TRUE),
  SURFACE_KEY("direction", 3, SURFACE_AXIS, PETSC_TRUE),
  PROFILE_KEYS,
  SURFACE_END,
};

static const ShapeKey stl_keys[] = {
  SHAPE_KEY("mesh", KEY_TEXT, 1, gmsh.file, PETSC_TRUE),
  SHAPE_KEY("scale", KEY_REALS, 1, gmsh.scale, PETSC_FALSE),
  SURFACE_END,
};

#define SURFACE_SHAPE(keys) \
  { \
    NULL, ShapeSize_RigidSurface, ShapeCreate_RigidSurface, NULL, keys, faces \
  }
const Shape ShapeRigidPlane    = SURFACE_SHAPE(plane_keys);
const Shape ShapeRigidSphere   = SURFACE_SHAPE(sphere_keys);
const Shape ShapeRigidCylinder = SURFACE_SHAPE(cylinder_keys);
const Shape ShapeRigidCone     = SURFACE_SHAPE(cone_keys);
const Shape ShapeRigidTorus    = SURFACE_SHAPE(torus_keys);
const Shape ShapeRigidExtruded = SURFACE_SHAPE(extruded_keys);
const Shape ShapeRigidRevolved = SURFACE_SHAPE(revolved_keys);
const Shape ShapeRigidStl      = SURFACE_SHAPE(stl_keys);
