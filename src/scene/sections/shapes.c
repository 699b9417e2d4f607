/* Reads and prints the keys of all shapes. A key with an underscore may be nested, for example outer: {radius: 1}. */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

static const char *const Axes[]       = {"x", "y", "z", "Axis", "AXIS_", NULL};
static const char *const Directions[] = {"x", "y", "z", "-x", "-y", "-z", "Direction", "DIRECTION_", NULL};

static const ShapeKey gmsh_keys[] = {
  SHAPE_KEY("mesh", KEY_TEXT, 1, gmsh.file, PETSC_TRUE),
  SHAPE_KEY("volume", KEY_TEXT, 1, gmsh.volume, PETSC_TRUE),
  SHAPE_KEY("scale", KEY_REALS, 1, gmsh.scale, PETSC_FALSE),
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

PetscErrorCode SceneGetShapeKeys(const SceneBody *body, const ShapeKey **keys)
{
  const Shape *shape;

  PetscFunctionBegin;
  PetscCall(ShapeGet(PETSC_COMM_SELF, body, &shape));
  *keys = shape ? shape->keys : gmsh_keys;
  PetscFunctionReturn(0);
}

/* Reads a list of at most n numbers. values[0] becomes their count; the numbers follow. */
static PetscErrorCode SceneReadNumbers(SceneKeys keys, const char name[], const char text[], PetscInt n,
  PetscReal values[])
{
  PetscInt count = PETSC_DECIDE;
  char   **words;

  PetscFunctionBegin;
  PetscCall(SceneParseList(keys, name, text, &count, &words));
  if (count > n)
    PetscCall(SceneKeysError(keys, name, NULL, "has %" PetscInt_FMT " values, and may have %" PetscInt_FMT, count, n));
  values[0] = (PetscReal)PetscMin(count, n);
  for (PetscInt i = 0; i < PetscMin(count, n); ++i) PetscCall(SceneParseReal(keys, name, words[i], &values[1 + i]));
  PetscCall(PetscStrToArrayDestroy((int)count, words));
  PetscFunctionReturn(0);
}

/* Rejects a zero in values that must be above 0. The zero of these keys means that the scene does not have them. Other
   wrong values are found with the rest of the shape. */
static PetscErrorCode SceneCheckAboveZero(SceneKeys keys, const char name[], const ShapeKey *key,
  const PetscReal values[])
{
  static const char *const above[] = {"grading", "layer_grading", "scale", "size"};

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(above); ++k) {
    for (PetscInt i = 0; !strcmp(key->name, above[k]) && i < key->n; ++i)
      if (values[i] == 0) PetscCall(SceneKeysError(keys, name, NULL, "is 0, which must be above 0"));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadShapeKey(SceneKeys keys, const char owner[], const ShapeKey *key, SceneBody *body)
{
  char        name[SCENE_KEY_LENGTH];
  const char *text;
  void       *value = (char *)body + key->offset;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(name, sizeof(name), "%s_%s", owner, key->name));
  PetscCall(SceneKeysGet(keys, key->required, &text, "%s", name));
  if (!text) PetscFunctionReturn(0);
  switch (key->type) {
  case KEY_REALS:
    PetscCall(SceneParseReals(keys, name, text, key->n, (PetscReal *)value));
    PetscCall(SceneCheckAboveZero(keys, name, key, (const PetscReal *)value));
    break;
  case KEY_INTS: PetscCall(SceneParseInts(keys, name, text, key->n, (PetscInt *)value)); break;
  case KEY_AXIS: PetscCall(SceneParseEnum(keys, name, text, Axes, (PetscInt *)value)); break;
  case KEY_DIRECTION: PetscCall(SceneParseEnum(keys, name, text, Directions, (PetscInt *)value)); break;
  case KEY_LIST: PetscCall(SceneReadNumbers(keys, name, text, key->n, (PetscReal *)value)); break;
  case KEY_TEXT: PetscCall(PetscStrallocpy(text, (char **)value)); break;
  }
  PetscFunctionReturn(0);
}

/* Reads the name of the shape. If it is missing and the key `mesh` exists, the shape is gmsh. */
static PetscErrorCode SceneReadShapeName(SceneKeys keys, const char owner[], SceneBody *body)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    shape = PETSC_DECIDE;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s_shape", owner));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseEnum(keys, key, text, BodyShapes, &shape));
  else {
    PetscCall(PetscSNPrintf(key, sizeof(key), "%s_mesh", owner));
    if (SceneValuesUse(&keys->values, key)) shape = SHAPE_GMSH;
  }
  if (shape < 0) { /* the shape is unknown; this error is reported first, since the valid keys depend on the shape */
    if (text) keys->decides = PETSC_TRUE;
    shape = SHAPE_BOX;
  }
  body->shape = (BodyShape)shape;
  PetscFunctionReturn(0);
}

/* Reads the file of a rigid surface, and sets its point and the size of its cube from the facets */
static PetscErrorCode SceneReadStl(SceneKeys keys, const char owner[], SceneBody *body)
{
  const PetscReal scale = body->gmsh.scale != 0 ? body->gmsh.scale : 1.0;

  PetscFunctionBegin;
  if (scale <= 0 || PetscIsInfOrNanReal(scale))
    PetscCall(SceneKeysError(keys, owner, "scale", "is %g, which must be above 0", (double)scale));
  else
    PetscCall(SceneStlCreate(keys->comm, ScenePlace(body), body->gmsh.file, scale, &body->stl,
      &body->own[SURFACE_POINT], &body->own[SURFACE_SIZE]));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadShape(SceneKeys keys, const char owner[], SceneBody *body)
{
  char            key[SCENE_KEY_LENGTH];
  const char     *text;
  SceneOctant    *octant     = &body->octant;
  SceneSphere    *spheres[]  = {&octant->inner, &octant->outer, &octant->cap};
  const ShapeKey *shape_keys = NULL;

  PetscFunctionBegin;
  PetscCall(SceneReadShapeName(keys, owner, body));
  body->curved       = PETSC_TRUE;
  body->ellipse.half = PETSC_DECIDE;
  octant->layer_even = 1;
  for (PetscInt d = 0; d < 3; ++d) octant->signs[d] = body->even[d] = 1;
  PetscCall(SceneGetShapeKeys(body, &shape_keys));
  for (const ShapeKey *k = shape_keys; k->name; ++k) {
    PetscCall(SceneReadShapeKey(keys, owner, k, body));
    /* The centre of each sphere is the corner of the body unless the sphere has its own centre, whose key comes
       later in the table. */
    if (k->offset == offsetof(SceneBody, octant.corner)) {
      for (PetscInt s = 0; s < 3; ++s) PetscCall(PetscArraycpy(spheres[s]->center, octant->corner, 3));
    }
  }
  if (body->gmsh.file) PetscCall(SceneResolveFile(keys->file, &body->gmsh.file));
  if (body->shape == SHAPE_RIGID_STL && body->gmsh.file) PetscCall(SceneReadStl(keys, owner, body));
  if (body->shape != SHAPE_BOX) {
    PetscCall(PetscSNPrintf(key, sizeof(key), "%s_curved", owner));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
    if (text) PetscCall(SceneParseAnswer(keys, key, text, &body->curved));
  }
  PetscFunctionReturn(0);
}

/*
   Returns whether an optional key has its default value, so that it is not printed. The default is a negative number
   for directions, 0 for reals and 1 for integers.
*/
static PetscBool SceneShapeKeyIsDefault(const ShapeKey *key, const SceneBody *body)
{
  const void *value = (const char *)body + key->offset;

  if (key->required) return PETSC_FALSE;
  if (key->type == KEY_DIRECTION) return *(const PetscInt *)value < 0 ? PETSC_TRUE : PETSC_FALSE;
  for (PetscInt i = 0; i < key->n; ++i) {
    if (key->type == KEY_REALS && ((const PetscReal *)value)[i] != 0) return PETSC_FALSE;
    if (key->type == KEY_INTS && ((const PetscInt *)value)[i] != 1) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscErrorCode SceneViewShape(const SceneBody *body, PetscViewer viewer)
{
  const ShapeKey *shape_keys = NULL;

  PetscFunctionBegin;
  PetscCall(SceneGetShapeKeys(body, &shape_keys));
  PetscCall(PetscViewerASCIIPrintf(viewer, "shape: %s\n", BodyShapes[body->shape]));
  for (const ShapeKey *k = shape_keys; k->name; ++k) {
    const void     *value = (const char *)body + k->offset;
    const PetscInt *n     = (const PetscInt *)value;

    if (SceneShapeKeyIsDefault(k, body)) continue;
    if (k->type == KEY_REALS && k->n > 1) PetscCall(SceneViewReals(viewer, k->name, k->n, (const PetscReal *)value));
    else if (k->type == KEY_LIST)
      PetscCall(SceneViewReals(viewer, k->name, (PetscInt) * (const PetscReal *)value, (const PetscReal *)value + 1));
    else {
      PetscCall(PetscViewerASCIIPrintf(viewer, "%s: ", k->name));
      PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
      if (k->type == KEY_REALS) PetscCall(SceneViewReal(viewer, *(const PetscReal *)value));
      else if (k->type == KEY_AXIS) PetscCall(PetscViewerASCIIPrintf(viewer, "%s", Axes[*n]));
      else if (k->type == KEY_DIRECTION) PetscCall(PetscViewerASCIIPrintf(viewer, "%s", Directions[*n]));
      else if (k->type == KEY_TEXT) PetscCall(PetscViewerASCIIPrintf(viewer, "%s", *(char *const *)value));
      else if (k->n == 1) PetscCall(PetscViewerASCIIPrintf(viewer, "%" PetscInt_FMT, *n));
      else
        PetscCall(PetscViewerASCIIPrintf(viewer, "[%" PetscInt_FMT ", %" PetscInt_FMT ", %" PetscInt_FMT "]", n[0],
          n[1], n[2]));
      PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
      PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
    }
  }
  if (!body->curved && body->shape != SHAPE_BOX) PetscCall(PetscViewerASCIIPrintf(viewer, "curved: false\n"));
  PetscFunctionReturn(0);
}
