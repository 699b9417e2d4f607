/*
   symmetry: a list of plane faces with zero normal displacement. An entry is only the name of a face if a built-in
   shape determines its normal (xmin, y0, lmax). Other faces have a name and a normal, which is an axis or a vector:
   cut: {face: bracket.cut, normal: y}. Symmetry planes become prescribed displacements, after those of the list
   `displacements`.
*/
#include "sectionsimpl.h"
#include <vector3.h>
#include <string.h>

static const char *const axes[] = {"x", "y", "z", "Axis", "", NULL};

static PetscBool SymmetryIsOneOf(const char name[], const char a[], const char b[])
{
  return !strcmp(name, a) || !strcmp(name, b) ? PETSC_TRUE : PETSC_FALSE;
}

/* Returns the axis that is normal to a face named xmin, xmax, x0, ymin, and so on; PETSC_DECIDE for other names. */
static PetscInt SymmetryAxisOfBox(const char face[])
{
  if (face[0] < 'x' || face[0] > 'z') return PETSC_DECIDE;
  return SymmetryIsOneOf(face + 1, "min", "max") || !strcmp(face + 1, "0") ? face[0] - 'x' : PETSC_DECIDE;
}

static PetscInt SymmetryAxisOfTubeArc(const SceneTubeArc *tube, const char face[])
{
  PetscReal quarters;

  if (SymmetryIsOneOf(face, "lmin", "lmax")) return tube->axis;
  if (!SymmetryIsOneOf(face, "amin", "amax")) return PETSC_DECIDE;
  quarters = tube->angles[!strcmp(face, "amax")] / 90;
  if (quarters != PetscFloorReal(quarters)) return PETSC_DECIDE;
  return (tube->axis + (PetscFmodReal(quarters, 2) == 0 ? 2 : 1)) % 3;
}

static PetscInt SymmetryAxisOfHalfEllipse(const SceneHalfEllipse *ellipse, const char face[])
{
  if (SymmetryIsOneOf(face, "lmin", "lmax")) return ellipse->axis;
  if (!strcmp(face, "flat")) return ellipse->depth % 3;
  return !strcmp(face, "symmetry") && ellipse->half >= 0 ? ellipse->half % 3 : PETSC_DECIDE;
}

/* Computes the normal of the start or end face of a tube arc at any angle. normal: 0 for another face. */
static void SymmetryNormalOfTubeArc(Scene scene, const char face[], PetscReal normal[3])
{
  const char         *name = NULL;
  const PetscInt      b    = SceneFindBody(scene, face, &name);
  const SceneTubeArc *tube = b >= 0 ? &scene->bodies[b].tube : NULL;
  PetscReal           angle;

  normal[0] = normal[1] = normal[2] = 0;
  if (!tube || scene->bodies[b].shape != SHAPE_TUBE_ARC || !SymmetryIsOneOf(name, "amin", "amax")) return;
  angle                        = tube->angles[!strcmp(name, "amax")] * PETSC_PI / 180;
  normal[(tube->axis + 1) % 3] = -PetscSinReal(angle);
  normal[(tube->axis + 2) % 3] = PetscCosReal(angle);
}

/*
   Sets the normal of a symmetry plane. If the normal is along an axis, one component is prescribed; otherwise the
   displacement is inclined.
*/
static void SymmetrySetNormal(const PetscReal normal[3], SceneDisplacement *displacement)
{
  const PetscReal length = VectorNorm(normal);
  PetscInt        axis   = -1;

  if (!(length > 0)) return;
  for (PetscInt i = 0; i < 3; ++i) {
    displacement->normal[i] = normal[i];
    if (PetscAbsReal(normal[i]) == length) axis = i;
  }
  if (axis >= 0) displacement->fixed[axis] = PETSC_TRUE;
  else displacement->inclined = PETSC_TRUE;
}

/*
   Returns the axis normal to a plane face of a built-in shape; PETSC_DECIDE if the name of the face does not determine
   the axis.
*/
static PetscInt SymmetryAxisOfFace(Scene scene, const char face[])
{
  const char      *name;
  const PetscInt   b = SceneFindBody(scene, face, &name);
  const SceneBody *body;

  if (b < 0) return PETSC_DECIDE;
  body = &scene->bodies[b];
  if (body->shape == SHAPE_CYLINDER || body->shape == SHAPE_CONE || body->shape == SHAPE_WEDGE)
    return SymmetryIsOneOf(name, "lmin", "lmax") ? body->tube.axis : PETSC_DECIDE;
  if (body->shape == SHAPE_TUBE_ARC) return SymmetryAxisOfTubeArc(&body->tube, name);
  if (body->shape == SHAPE_HALF_ELLIPSE) return SymmetryAxisOfHalfEllipse(&body->ellipse, name);
  return body->shape == SHAPE_GMSH ? PETSC_DECIDE : SymmetryAxisOfBox(name);
}

/*
   Reads an entry that is only a face; the displacement is named after the face. If the normal is not known, nothing is
   prescribed, and SceneValidate() raises an error.
*/
static PetscErrorCode SceneReadSymmetryFace(Scene scene, const char face[], SceneDisplacement *displacement)
{
  const PetscInt axis = SymmetryAxisOfFace(scene, face);
  char           name[SCENE_KEY_LENGTH];
  PetscReal      normal[3];

  PetscFunctionBegin;
  if (axis >= 0) displacement->fixed[axis] = PETSC_TRUE;
  else {
    SymmetryNormalOfTubeArc(scene, face, normal);
    SymmetrySetNormal(normal, displacement);
  }
  PetscCall(PetscSNPrintf(name, sizeof(name), "symmetry_%s", face));
  *strchr(name, '.') = '_';
  PetscCall(PetscStrallocpy(name, &displacement->name));
  PetscCall(PetscStrallocpy(face, &displacement->face));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadSymmetryNamed(SceneKeys keys, const char name[], SceneDisplacement *displacement)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    axis      = 0;
  PetscReal   normal[3] = {0, 0, 0};

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(name, &displacement->name));
  if (!SceneIsName(name))
    PetscCall(SceneKeysError(keys, "symmetry", name, "is neither a face, <body>.<face>, nor a name"));
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "symmetry_%s_face", name));
  PetscCall(PetscStrallocpy(text ? text : "", &displacement->face));
  PetscCall(PetscSNPrintf(key, sizeof(key), "symmetry_%s_normal", name));
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
  if (text && strchr(text, ',')) {
    PetscCall(SceneParseReals(keys, key, text, 3, normal));
    if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0)
      PetscCall(SceneKeysError(keys, key, NULL, "is zero; it is x, y, z or a vector"));
    SymmetrySetNormal(normal, displacement);
  } else {
    if (text) PetscCall(SceneParseEnum(keys, key, text, axes, &axis));
    displacement->fixed[axis] = PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}

/* Reads the list. Call this function after bodies and displacements have been read. */
PetscErrorCode SceneReadSymmetry(SceneKeys keys, Scene scene)
{
  const char *text;
  char      **words;
  PetscInt    n     = PETSC_DECIDE;
  size_t      given = (size_t)scene->ndisplacements;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "symmetry"));
  if (!text) PetscFunctionReturn(0);
  PetscCall(SceneParseList(keys, "symmetry", text, &n, &words));
  if (n) {
    PetscCall(PetscRealloc((given + (size_t)n) * sizeof(*scene->displacements), &scene->displacements));
    PetscCall(PetscArrayzero(scene->displacements + given, n));
  }
  for (PetscInt i = 0; i < n; ++i) {
    SceneDisplacement *displacement = &scene->displacements[scene->ndisplacements++];
    PetscBool          same;

    displacement->body     = PETSC_DECIDE;
    displacement->place    = SceneGetPlace(&keys->places, "symmetry");
    displacement->symmetry = PETSC_TRUE;
    displacement->unnamed  = (PetscBool)(strchr(words[i], '.') != NULL);
    if (displacement->unnamed) PetscCall(SceneReadSymmetryFace(scene, words[i], displacement));
    else PetscCall(SceneReadSymmetryNamed(keys, words[i], displacement));
    for (PetscInt d = 0; d < scene->ndisplacements - 1; ++d) {
      PetscCall(PetscStrcasecmp(scene->displacements[d].name, displacement->name, &same));
      if (same)
        PetscCall(
          SceneKeysError(keys, "symmetry", words[i], "is also the name of another displacement or symmetry plane"));
    }
  }
  PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}
