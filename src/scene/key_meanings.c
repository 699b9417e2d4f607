/* Prints tables of the keys of shapes and of the constants of materials. The shapes and laws define these keys. */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <string.h>

/*
   Meaning of a key, which is the same in all shapes or laws that have the key. A new key that is missing in the
   following tables is printed without a meaning.
*/
typedef struct {
  const char *name, *unit, *help, *otherwise; /* otherwise: default of a key that is not required */
} KeyMeaning;

static const KeyMeaning shape_meanings[] = {
  {"across", "", "direction of the first coordinate of the points, normal to `direction`", ""},
  {"angles", " [degrees]",
    "first and last angle about the axis, measured from the next axis in the order x, y, z, x; a difference of 360 "
    "gives a whole tube",
    ""},
  {"axis", "",
    "axis along which the body is a prism; for a cone or a holed box: axis of the cone or of the hole; `x`, `y`, `z`",
    ""},
  {"cap_center", " [L]", "centre of the third sphere", "`center`"},
  {"cap_radius", " [L]", "radius of a third sphere, which cuts the outer one", "no cut"},
  {"cells", "",
    "number of cells along x, y, z; for a tube: across the wall, around and along the axis; for a cylinder or cone: "
    "across the square core, from the core to the surface, and along the axis; for a holed box: from the hole to the "
    "sides, along an eighth of the hole, and along the axis of the hole",
    ""},
  {"center", " [L]",
    "centre; for a tube, cylinder, cone, hole or half ellipse: a point on the axis; for an octant: its corner", "0"},
  {"corners", " [L]",
    "the three corners of the triangle, two coordinates each, in the order y, z or z, x or x, y for the axis x, y or z",
    ""},
  {"depth", "", "direction from the flat side to the crown: `x`, `-x`, ...", ""},
  {"direction", "", "direction of the axis; for a cone: from the tip into the cone", ""},
  {"even", "", "number of cells of equal size at the fine end of a graded direction", "1"},
  {"extent", " [L]", "first and last coordinate along the axis", ""},
  {"grading", "", "size of the last cell divided by that of the first, for each number of `cells` or `patches`", "1"},
  {"half", "", "direction from the plane of symmetry to the modelled half", "both halves"},
  {"half_angle", " [degrees]", "angle between the axis and the surface, below 90", ""},
  {"inner_center", " [L]", "centre of the inner sphere", "`center`"},
  {"inner_radius", " [L]", "radius of the inner sphere", ""},
  {"inner_semi_axes", " [L]", "semi-axes of the inner ellipsoid along x, y, z", ""},
  {"layer_even", "", "number of layers of equal thickness at the fine end", "1"},
  {"layer_grading", "", "thickness of the last layer divided by that of the first", "1"},
  {"layers", "",
    "number of cells across the shell; for a ball: from the core to the surface; for a half ellipse: along its axis",
    ""},
  {"length_cells", "", "number of cells along the axis", ""},
  {"lower", " [L]", "lower corner", ""},
  {"mass", " [M]",
    "mass of a rigid surface, with the moments of inertia of a uniform ball, or of a cube in its place; "
    "required in `dynamics` if some of its motions are free",
    "0"},
  {"mesh", "", "the mesh or STL file, relative to the folder of the scene", ""},
  {"normal", "", "direction away from the rigid side", ""},
  {"octant", "",
    "signs of x, y, z in the octant, for example [1, 1, -1]; 2 means both signs, so that [2, 2, 2] is a whole ball and "
    "[2, 2, 1] a half ball",
    "[1, 1, 1]"},
  {"outer_center", " [L]", "centre of the outer sphere", "`center`"},
  {"outer_radius", " [L]", "radius of the outer sphere", ""},
  {"outer_semi_axes", " [L]", "semi-axes of the outer ellipsoid along x, y, z", ""},
  {"patches", "",
    "number of cells along x, y, z; for a half ellipse: in the core along its depth, in the core across one half, and "
    "across the ring around the core",
    ""},
  {"outside", " [L]", "distance of the surface from the line through the points, on the outside; it rounds the corners",
    "0"},
  {"point", " [L]", "a point of the plane", ""},
  {"points", " [L]",
    "the profile, two coordinates per point, with the solid on the left; for a revolved surface: distance from the "
    "axis and position along it; for an extruded one: positions along `across` and along the cross product of "
    "`direction` and `across`",
    ""},
  {"radii", " [L]", "inner and outer radius; for a cone: radii at the start and the end of its extent", ""},
  {"radius", " [L]", "radius; for a torus: of the circle in the middle of the ring; for a holed box: of the hole", ""},
  {"scale", "", "factor by which all coordinates of the file are multiplied", "1"},
  {"section_radius", " [L]", "radius of the cross-section of the ring", ""},
  {"semi_axes", " [L]", "semi-axes along `depth` and perpendicular to it", ""},
  {"side_cells", "", "number of cells along half of a side", ""},
  {"size", " [L]", "edge length of the cube whose moments of inertia the surface has in `dynamics`", "1"},
  {"tip", " [L]", "the tip", ""},
  {"upper", " [L]", "upper corner", ""},
  {"volume", "", "name of the volume in the file", ""},
  {0},
};

static const KeyMeaning constant_meanings[] = {
  {"bulk", " [F/L²]", "bulk modulus", ""},
  {"c01", " [F/L²]", "second constant of Mooney and Rivlin", ""},
  {"c10", " [F/L²]", "first constant of Mooney and Rivlin", ""},
  {"density", " [M/L³]", "mass per undeformed volume; required in `dynamics` for bodies that move", "0"},
  {"expansion", " [1/temperature]", "coefficient of thermal expansion; for `orthotropic`: along the three axes", "0"},
  {"first_axis", "", "direction of the first material axis", "x"},
  {"hardening", " [F/L²]", "isotropic hardening: stress per equivalent plastic strain", "0"},
  {"kinematic", " [F/L²]", "kinematic hardening: stress per equivalent plastic strain", "0"},
  {"plastic_strains", "", "equivalent plastic strains of a table, ascending from 0", "none"},
  {"poisson", "", "Poisson's ratio; for `orthotropic`: ν12, ν23, ν13", ""},
  {"saturation", " [F/L²]", "final yield stress of hardening that saturates (Voce); at least the yield stress", "0"},
  {"saturation_rate", "", "rate of the saturation per equivalent plastic strain", "0"},
  {"second_axis", "", "direction of the second material axis", "y"},
  {"shear", " [F/L²]", "shear moduli G12, G23, G13", ""},
  {"yield", " [F/L²]",
    "yield stress; `j2` and `j2_finite` need it or `yield_stresses`. Elastic bodies get a safety factor from it",
    "none"},
  {"yield_stresses", " [F/L²]", "yield stresses of the table", "none"},
  {"young", " [F/L²]", "Young's modulus; for `orthotropic`: along the three axes", ""},
  {0},
};

static const KeyMeaning *MeaningFind(const KeyMeaning meanings[], const char name[])
{
  static const KeyMeaning none = {"", "", "", ""};

  for (const KeyMeaning *m = meanings; m->name; ++m) {
    if (!strcmp(m->name, name)) return m;
  }
  return &none;
}

/* Row of a table. of: names of the shapes or laws that have the key. */
typedef struct {
  const char *name, *type;
  PetscBool   required;
  char        of[256];
} MeaningRow;

/*
   Adds a shape or law (`of`) to the row of a key with the same name and type, or adds a row. rows: must have room for
   one more row.
*/
static PetscErrorCode RowsAdd(const char name[], const char of[], const char type[], PetscBool required, PetscInt *n,
  MeaningRow rows[])
{
  PetscInt i;

  PetscFunctionBegin;
  for (i = 0; i < *n; ++i) {
    if (!strcmp(rows[i].name, name) && !strcmp(rows[i].type, type) && rows[i].required == required) break;
  }
  if (i == *n) rows[(*n)++] = (MeaningRow){.name = name, .type = type, .required = required};
  else PetscCall(PetscStrlcat(rows[i].of, ", ", sizeof(rows[i].of)));
  PetscCall(PetscStrlcat(rows[i].of, of, sizeof(rows[i].of)));
  PetscFunctionReturn(0);
}

static PetscErrorCode RowsView(PetscViewer viewer, const char title[], const KeyMeaning meanings[], PetscInt n,
  const MeaningRow rows[])
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "\n### Keys: %s\n\n| key | of | type | meaning | default |\n| --- | --- | --- | --- | --- |\n", title));
  for (PetscInt i = 0; i < n; ++i) {
    const KeyMeaning *m = MeaningFind(meanings, rows[i].name);

    PetscCall(PetscViewerASCIIPrintf(viewer, "| `%s` | %s | %s%s | %s | %s |\n", rows[i].name, rows[i].of, rows[i].type,
      m->unit, m->help,
      rows[i].required ? "required"
      : m->otherwise   ? m->otherwise
                       : ""));
  }
  PetscFunctionReturn(0);
}

#define MEANING_ROWS 128

PetscErrorCode SceneViewShapeKeys(PetscViewer viewer)
{
  static const char *const numbers[] = {"", "a number", "two numbers", "three numbers", "four numbers", "five numbers",
    "six numbers"};
  static const char *const whole[]   = {"", "a whole number", "two whole numbers", "three whole numbers"};
  MeaningRow              *rows;
  PetscInt                 n = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(MEANING_ROWS, &rows));
  for (PetscInt i = 0; BodyShapes[i + 2]; ++i) {
    const SceneBody body = {.shape = (BodyShape)i};
    const ShapeKey *keys = NULL;

    PetscCall(SceneGetShapeKeys(&body, &keys));
    for (const ShapeKey *k = keys; k->name && n < MEANING_ROWS; ++k) {
      const char *type = k->type == KEY_REALS  ? numbers[k->n]
                         : k->type == KEY_INTS ? whole[k->n]
                         : k->type == KEY_AXIS ? "an axis"
                         : k->type == KEY_LIST ? "list of numbers"
                         : k->type == KEY_TEXT ? "a text"
                                               : "a direction";

      PetscCall(RowsAdd(k->name, BodyShapes[i], type, k->required, &n, rows));
    }
  }
  PetscCall(RowsView(viewer, "shapes of a body", shape_meanings, n, rows));
  PetscCall(PetscFree(rows));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewConstantKeys(PetscViewer viewer)
{
  MeaningRow *rows;
  PetscInt    n = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(MEANING_ROWS, &rows));
  for (PetscInt t = 0; MaterialTypes[t + 2]; ++t) {
    const Material     material = {.type = (MaterialType)t};
    const MaterialLaw *law;

    PetscCall(MaterialGetLaw(&material, &law));
    for (const MaterialConstant *c = law->constants; c && c->name && n < MEANING_ROWS; ++c)
      PetscCall(RowsAdd(c->name, MaterialTypes[t],
        !c->n       ? "numbers"
        : c->n == 1 ? "a number"
                    : "three numbers",
        c->required, &n, rows));
  }
  PetscCall(RowsView(viewer, "constants of a material", constant_meanings, n, rows));
  PetscCall(PetscFree(rows));
  PetscFunctionReturn(0);
}
