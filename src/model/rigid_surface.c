/* Rigid surfaces without cells: the distance of a point, corners of profiles,
   and the cube that represents the surface in the mesh */
#include "modelimpl.h"
#include <vector3.h>

/*
   Returns the distance of the point x from a profile [length], and computes its gradient `slope`. A profile is a line
   through points in a plane, with the solid on its left. The first and the last segment extend to infinity.
*/
static PetscReal ProfileDistance(const SceneBody *body, const PetscReal x[2], PetscReal slope[2])
{
  const PetscInt   n     = (PetscInt)body->own[SURFACE_PROFILE] / 2;
  const PetscReal *p     = &body->own[SURFACE_PROFILE + 1];
  PetscReal        least = PETSC_MAX_REAL, distance = 0.0;

  slope[0] = slope[1] = 0.0;
  for (PetscInt k = 0; k + 1 < n; ++k) {
    const PetscReal d[2]      = {p[2 * k + 2] - p[2 * k], p[2 * k + 3] - p[2 * k + 1]};
    const PetscReal length    = PetscSqrtReal(PetscSqr(d[0]) + PetscSqr(d[1])),
                    normal[2] = {d[1] / length, -d[0] / length};
    const PetscReal part      = ((x[0] - p[2 * k]) * d[0] + (x[1] - p[2 * k + 1]) * d[1]) / PetscSqr(length);
    const PetscBool before = (PetscBool)(part < 0.0 && k > 0), after = (PetscBool)(part > 1.0 && k + 2 < n);
    const PetscInt  at   = after ? k + 1 : k;
    const PetscReal r[2] = {x[0] - p[2 * at], x[1] - p[2 * at + 1]}, off = r[0] * normal[0] + r[1] * normal[1];
    const PetscReal away = before || after ? PetscSqrtReal(PetscSqr(r[0]) + PetscSqr(r[1])) : PetscAbsReal(off);

    if (away >= least) continue;
    least = away;
    if (before ||
        after) { /* the corner is the nearest point; the solid has a convex corner if it is seen from outside */
      const PetscInt  other   = after ? k + 1 : k - 1;
      const PetscReal e[2]    = {p[2 * other + 2] - p[2 * other], p[2 * other + 3] - p[2 * other + 1]};
      const PetscReal size    = PetscSqrtReal(PetscSqr(e[0]) + PetscSqr(e[1]));
      const PetscReal outside = off + (r[0] * e[1] - r[1] * e[0]) / size;

      distance = outside < 0.0 ? -away : away;
      for (int c = 0; c < 2; ++c) slope[c] = away > 0.0 ? r[c] / distance : normal[c];
    } else {
      distance = off;
      for (int c = 0; c < 2; ++c) slope[c] = normal[c];
    }
  }
  return distance - body->own[SURFACE_OUTSIDE];
}

/* Computes three unit vectors perpendicular to each other, the last one along the axis of the surface */
static void SurfaceFrame(const SceneBody *body, PetscReal frame[3][3])
{
  PetscInt  least = 0;
  PetscReal first[3];

  for (PetscInt c = 0; c < 3; ++c) frame[2][c] = body->own[SURFACE_AXIS + c];
  if (!(VectorScaleToUnit(frame[2]) > 0.0)) frame[2][2] = 1.0;
  for (PetscInt c = 1; c < 3; ++c) {
    if (PetscAbsReal(frame[2][c]) < PetscAbsReal(frame[2][least])) least = c;
  }
  for (PetscInt c = 0; c < 3; ++c)
    first[c] = body->shape == SHAPE_RIGID_EXTRUDED ? body->own[SURFACE_ACROSS + c] : (c == least ? 1.0 : 0.0);
  for (PetscInt c = 0; c < 3; ++c) frame[0][c] = first[c] - VectorDot(first, frame[2]) * frame[2][c];
  (void)VectorScaleToUnit(frame[0]);
  VectorCross(frame[2], frame[0], frame[1]);
}

/* Computes the cube that represents the surface in the mesh. That of a ball has its moments of inertia, 2/5 m r^2. */
void SceneSurfaceGetCube(const SceneBody *body, SceneSurfaceCube *cube)
{
  const PetscReal radius = body->own[SURFACE_RADIUS], given = body->own[SURFACE_SIZE];
  PetscReal       middle = 0.0; /* position of the cube's centre along the axis [length] */

  SurfaceFrame(body, cube->edge);
  cube->size = given > 0.0 ? given : 1.0;
  if (body->shape == SHAPE_RIGID_SPHERE) cube->size = radius * PetscSqrtReal(2.4);
  if (body->shape == SHAPE_RIGID_CYLINDER) cube->size = PetscSqrtReal(2.0) * radius;
  if (body->shape == SHAPE_RIGID_TORUS) cube->size = body->own[SURFACE_SECTION];
  if (body->shape == SHAPE_RIGID_PLANE) middle = -0.5 * cube->size;
  if (body->shape == SHAPE_RIGID_CONE) middle = 1.5 * cube->size;
  for (PetscInt c = 0; c < 3; ++c) {
    cube->corner[c] = body->own[SURFACE_POINT + c] + middle * cube->edge[2][c];
    for (PetscInt i = 0; i < 3; ++i) cube->corner[c] -= 0.5 * cube->size * cube->edge[i][c];
  }
}

/*
   Writes a rigid surface as words separated by blanks, for programs that draw it. The first word is the shape. The
   numbers own[] follow, in the order of the indices SURFACE_POINT, SURFACE_AXIS and so on. For an STL file the scale
   and the file's name follow instead.
*/
PetscErrorCode SceneSurfaceWrite(const SceneBody *body, const char shape[], char text[], size_t length)
{
  const PetscInt n = SURFACE_PROFILE + 1 + (PetscInt)body->own[SURFACE_PROFILE];
  char           word[64];

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(text, shape, length));
  for (PetscInt i = 0; i < n && body->shape != SHAPE_RIGID_STL; ++i) {
    (void)snprintf(word, sizeof(word), " %.17g", (double)body->own[i]);
    PetscCall(PetscStrlcat(text, word, length));
  }
  if (body->shape != SHAPE_RIGID_STL) PetscFunctionReturn(0);
  (void)snprintf(word, sizeof(word), " %.17g ", (double)(body->gmsh.scale > 0.0 ? body->gmsh.scale : 1.0));
  PetscCall(PetscStrlcat(text, word, length));
  PetscCall(PetscStrlcat(text, body->gmsh.file, length));
  PetscFunctionReturn(0);
}

/* Returns the distance of a point from the surface in the half plane through the axis and the point [length]. across,
   along: coordinates of the point [length]; slope: derivatives with respect to them */
static PetscReal SurfaceProfile(const SceneBody *body, PetscReal across, PetscReal along, PetscReal slope[2])
{
  const PetscReal radius = body->own[SURFACE_RADIUS], angle = body->own[SURFACE_ANGLE] * PETSC_PI / 180.0;
  PetscReal       from = 0.0, length, less = 0.0; /* The distance is that from the point (from, 0), minus `less`. */

  slope[0] = slope[1] = 0.0;
  switch (body->shape) {
  case SHAPE_RIGID_PLANE: slope[1] = 1.0; return along;
  case SHAPE_RIGID_CYLINDER: slope[0] = 1.0; return across - radius;
  case SHAPE_RIGID_REVOLVED: {
    const PetscReal x[2] = {across, along};

    return ProfileDistance(body, x, slope);
  }
  case SHAPE_RIGID_SPHERE: less = radius; break;
  case SHAPE_RIGID_TORUS:
    from = radius;
    less = body->own[SURFACE_SECTION];
    break;
  default: /* a cone; if its tip is the nearest point, the distance is that from the tip */
    if (along * PetscCosReal(angle) + across * PetscSinReal(angle) < 0.0) break;
    slope[0] = PetscCosReal(angle);
    slope[1] = -PetscSinReal(angle);
    return across * slope[0] + along * slope[1];
  }
  length = PetscSqrtReal(PetscSqr(across - from) + PetscSqr(along));
  if (length > 0.0) {
    slope[0] = (across - from) / length;
    slope[1] = along / length;
  }
  return length - less;
}

/* Returns the distance of the point x from the surface, positive outside [length], and computes its gradient */
PetscReal SceneSurfaceDistance(const SceneBody *body, const PetscReal x[3], PetscReal gradient[3])
{
  PetscReal frame[3][3], r[3], slope[2], distance, across, along;

  if (body->shape == SHAPE_RIGID_STL) return StlDistance(body->stl, x, gradient);
  SurfaceFrame(body, frame);
  for (PetscInt c = 0; c < 3; ++c) r[c] = x[c] - body->own[SURFACE_POINT + c];
  if (body->shape == SHAPE_RIGID_EXTRUDED) {
    const PetscReal place[2] = {VectorDot(r, frame[0]), VectorDot(r, frame[1])};

    distance = ProfileDistance(body, place, slope);
    for (PetscInt c = 0; c < 3; ++c) gradient[c] = slope[0] * frame[0][c] + slope[1] * frame[1][c];
    return distance;
  }
  along = VectorDot(r, frame[2]);
  for (PetscInt c = 0; c < 3; ++c) r[c] -= along * frame[2][c];
  across = VectorNorm(r);
  if (across <= PETSC_SQRT_MACHINE_EPSILON * PetscAbsReal(along)) across = 0.0;
  distance = SurfaceProfile(body, across, along, slope);
  for (PetscInt c = 0; c < 3; ++c)
    gradient[c] = slope[1] * frame[2][c] + (across > 0.0 ? slope[0] * r[c] / across : 0.0);
  return distance;
}

/* Computes the coordinates of the point x in the plane of the body's profile [length], and the unit vectors along
   them */
static void ProfilePlace(const SceneBody *body, const PetscReal x[3], PetscReal place[2], PetscReal unit[2][3])
{
  PetscReal frame[3][3], r[3], along;

  SurfaceFrame(body, frame);
  for (PetscInt c = 0; c < 3; ++c) r[c] = x[c] - body->own[SURFACE_POINT + c];
  along = VectorDot(r, frame[2]);
  for (PetscInt c = 0; c < 3; ++c) {
    const PetscBool extruded = (PetscBool)(body->shape == SHAPE_RIGID_EXTRUDED);

    unit[0][c] = extruded ? frame[0][c] : r[c] - along * frame[2][c];
    unit[1][c] = frame[extruded ? 1 : 2][c];
  }
  (void)VectorScaleToUnit(unit[0]);
  for (PetscInt k = 0; k < 2; ++k) place[k] = VectorDot(r, unit[k]);
}

/* Returns the angle by which a profile turns to the left at its point k, and computes its normal there */
static PetscReal ProfileTurn(const PetscReal p[], PetscInt k, PetscReal normal[2])
{
  const PetscReal a[2] = {p[2 * k] - p[2 * k - 2], p[2 * k + 1] - p[2 * k - 1]};
  const PetscReal b[2] = {p[2 * k + 2] - p[2 * k], p[2 * k + 3] - p[2 * k + 1]};
  const PetscReal la   = PetscSqrtReal(PetscSqr(a[0]) + PetscSqr(a[1])),
                  lb   = PetscSqrtReal(PetscSqr(b[0]) + PetscSqr(b[1]));

  normal[0] = a[1] / la + b[1] / lb;
  normal[1] = -a[0] / la - b[0] / lb;
  return PetscAtan2Real(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/*
   Computes where corner k of the profile is nearest to the edge. Returns false if that is not within the edge, or if
   the edge's face looks away from the corner. from, to: the edge's ends in the plane of the profile
*/
static PetscBool ProfileMeetsEdge(const SceneBody *body, PetscInt k, const PetscReal ends[6],
  const PetscReal normals[6], const PetscReal from[2], const PetscReal to[2], SceneSurfaceCorner *corner)
{
  const PetscReal *p = &body->own[SURFACE_PROFILE + 1];
  PetscReal        unit[2][3], x[3], place[2], outward[2], turn, size, across = 0.0, facing = 0.0;

  size = PetscSqrtReal(PetscSqr(to[0] - from[0]) + PetscSqr(to[1] - from[1]));
  turn = ProfileTurn(p, k, outward);
  if (!(turn > 0.0) || body->own[SURFACE_OUTSIDE] * turn >= size) return PETSC_FALSE;
  for (PetscInt i = 0; i < 2; ++i) across += (p[2 * k + i] - from[i]) * (to[i] - from[i]);
  corner->share = across / PetscSqr(size);
  if (!(corner->share > 0.0 && corner->share < 1.0)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) {
    x[c]              = (1.0 - corner->share) * ends[c] + corner->share * ends[3 + c];
    corner->normal[c] = (1.0 - corner->share) * normals[c] + corner->share * normals[3 + c];
  }
  (void)VectorScaleToUnit(corner->normal);
  ProfilePlace(body, x, place, unit);
  corner->gap = -body->own[SURFACE_OUTSIDE];
  for (PetscInt i = 0; i < 2; ++i) {
    facing += outward[i] * VectorDot(unit[i], corner->normal);
    corner->gap += (p[2 * k + i] - place[i]) * VectorDot(unit[i], corner->normal);
  }
  return (PetscBool)(facing < 0.0);
}

/*
   Finds the convex corners of a profile, at most two, that are deepest below an edge of another body's face, and orders
   them along the edge. Returns their number. ends: the edge's ends [length]; normals: the face's unit normals there. A
   corner that `outside` rounds counts only if it is shorter than the edge: the nodes touch a longer one.
*/
PetscInt SceneSurfaceFindCorners(const SceneBody *body, const PetscReal ends[6], const PetscReal normals[6],
  SceneSurfaceCorner deepest[2])
{
  const PetscInt n     = SceneSurfaceHasProfile(body) ? (PetscInt)body->own[SURFACE_PROFILE] / 2 : 0;
  PetscInt       found = 0;
  PetscReal      from[2], to[2], unit[2][3];

  ProfilePlace(body, ends, from, unit);
  ProfilePlace(body, ends + 3, to, unit);
  for (PetscInt k = 1; k + 1 < n; ++k) {
    SceneSurfaceCorner corner;

    if (!ProfileMeetsEdge(body, k, ends, normals, from, to, &corner)) continue;
    if (found < 2) deepest[found++] = corner;
    else {
      const PetscInt higher = deepest[0].gap > deepest[1].gap ? 0 : 1;

      if (corner.gap < deepest[higher].gap) deepest[higher] = corner;
    }
  }
  if (found == 2 && deepest[0].share > deepest[1].share) {
    const SceneSurfaceCorner first = deepest[1];

    deepest[1] = deepest[0];
    deepest[0] = first;
  }
  return found;
}

PetscReal SceneSurfaceRadius(const SceneBody *body)
{
  switch (body->shape) {
  case SHAPE_RIGID_CYLINDER:
  case SHAPE_RIGID_SPHERE: return body->own[SURFACE_RADIUS];
  case SHAPE_RIGID_TORUS: return body->own[SURFACE_SECTION];
  default: return PETSC_INFINITY;
  }
}
