/*
   The table of keys lists everything that a scene file may contain. It is used to read, check, print and free single
   values, to print the keys (-scene_keys), and to write the tables in share/scenes/README.md. Conditions between
   several values are checked in the other files of this folder and in validate.c.
*/
#include "sectionsimpl.h"
#include <stddef.h>
#include <string.h>

#define REALS(name, of, n, struct, member, need, range, unit, otherwise, help) \
  { \
    name, of, SCENE_REALS, n, offsetof(struct, member), SCENE_##need, SCENE_##range, NULL, NULL, unit, otherwise, help \
  }
#define INTS(name, of, n, struct, member, need, otherwise, help) \
  { \
    name, of, SCENE_INTS, n, offsetof(struct, member), SCENE_##need, SCENE_ANY, NULL, NULL, "", otherwise, help \
  }
#define ONE(name, of, type, struct, member, need, names, own, unit, otherwise, help) \
  { \
    name, of, SCENE_##type, 1, offsetof(struct, member), SCENE_##need, SCENE_ANY, names, own, unit, otherwise, help \
  }
#define ANSWER(name, of, struct, member, otherwise, help) \
  ONE(name, of, ANSWER, struct, member, OPTIONAL, NULL, NULL, "", otherwise, help)
#define NAMED(name, of, type, struct, member, need, names, otherwise, help) \
  ONE(name, of, type, struct, member, need, names, NULL, "", otherwise, help)
#define TEXT(name, of, struct, member, need, otherwise, help) \
  ONE(name, of, TEXT, struct, member, need, NULL, NULL, "", otherwise, help)
#define NUMBER_OF(name, type, struct, member, otherwise, help) \
  ONE(name, NULL, type, struct, member, OPTIONAL, NULL, NULL, "", otherwise, help)
#define OWN(name, of, struct, member, need, own, unit, otherwise, help) \
  ONE(name, of, OWN, struct, member, need, NULL, &own, unit, otherwise, help)
#define SECTION(name, otherwise, help) \
  { \
    name, NULL, SCENE_SECTION, 0, 0, SCENE_OPTIONAL, SCENE_ANY, NULL, NULL, "", otherwise, help \
  }

static const SceneKey top_rows[] = {
  TEXT("problem", NULL, struct _n_Scene, name, OPTIONAL, "the file's name", "name of the scene, in reports"),
  TEXT("units", NULL, struct _n_Scene, units, OPTIONAL, "none",
    "units of the scene, for example `mm, N, MPa`; printed in tables and summary, not used in computations"),
  SECTION("library", "none",
    "name of a file with a list of materials, see [materials](../doc/modelling.md#named-materials-and-libraries)"),
  SECTION("materials", "none", "list of materials by name"), SECTION("bodies", "required", "list of bodies"),
  SECTION("faces", "none", "list of named parts of faces"),
  SECTION("displacements", "none", "list of prescribed displacements"),
  SECTION("symmetry", "none", "list of plane faces whose normal displacement is 0"),
  SECTION("pressures", "none", "list of pressures, with fixed direction or following the deformed face"),
  SECTION("tractions", "none", "list of loads per undeformed area on faces, with fixed direction"),
  SECTION("forces", "none", "list of resultant forces and moments on faces and rigid bodies, with fixed direction"),
  SECTION("springs", "none", "list of springs between faces and the ground, or other faces"),
  SECTION("connectors", "none", "list of springs and dampers between points of bodies, or points and the ground"),
  SECTION("equations", "none", "list of linear equations between displacements of one or two points"),
  SECTION("bolts", "none", "list of bolts with pretension"),
  OWN("weak_springs", NULL, struct _n_Scene, weak_springs, OPTIONAL, SceneOwnWeakSprings, "", "`false`",
    "whether weak springs restrain bodies that have free rigid body motions: `true`, or the stiffness of the "
    "springs as a fraction of the softest body's stiffness, above 0 and at most 0.01"),
  SECTION("temperatures", "none", "list of temperatures of bodies with thermal expansion"),
  SECTION("body_forces", "none", "list of forces per undeformed volume, with fixed direction"),
  SECTION("contact", "none: no search, no optimizer", "list of contact pairs, or `auto`"),
  SECTION("ties", "none", "list of pairs of faces joined without sliding or opening"),
  SECTION("cyclic", "none",
    "list of cyclic symmetries: for each, the two faces at which a sector of a body is cut out"),
  SECTION("refinements", "none", "list of zones in which cells are refined further than by `refine`"),
  SECTION("probes", "none", "list of points and lines at which results are written"),
  SECTION("load", "one step", "the load program, see [load program](#load-program)"),
  SECTION("ramps", "none", "list of further load programs"),
  SECTION("dynamics", "none: a static analysis",
    "inertia and time steps, see [dynamics](../doc/modelling.md#bodies-that-move-and-hit-one-another)"),
  INTS("refine", NULL, 1, struct _n_Scene, refine, SHOWN, "0", "uniform refinements of level 0"),
  NAMED("model", NULL, CHOICE, struct _n_Scene, model, SHOWN, StepModels, "`energy`",
    "objective of a load step. `energy`: the exact energy. `quadratic`: its quadratic model at the state before "
    "the step, with one tangent per load step"),
  INTS("contact_updates", NULL, 1, struct _n_Scene, contact_updates, SHOWN, "20",
    "largest number of contact updates (linearizations of the gap) per load step. They end when the gap changes by "
    "less than 1e-6 of the largest displacement. With 1 the gap is not checked"),
  INTS("displacement_bounds", NULL, 1, struct _n_Scene, displacement_bounds, OPTIONAL, "0: none",
    "number (2 or more) of the first load step in which no displacement may change by more than the largest "
    "earlier increment"),
  SECTION("solver", "none", "PETSc options, see [solver options](#solver-options)"), {NULL}};

static const SceneKey body_rows[] = {
  SECTION("shape", "`gmsh` if `mesh` is given, else `box`", "the shape; see its keys below"),
  SECTION("curved", "`true`",
    "whether refinement puts new vertices on the curved surface; `false`: on the facets of level 0. Not for `box`"),
  SECTION("material", "`linear`",
    "a law: `linear` (small strain), `neohookean` (finite strain), `saint_venant` (large rotations at moderate "
    "strain), `mooney_rivlin`, `orthotropic` (small strain), `j2` (small strain, plasticity), `j2_finite` (finite "
    "strain, plasticity), `rigid`; or the name of a material. For its constants see below"),
  NAMED("element", "elastic", CHOICE, SceneBody, element, SHOWN, ElementTypes, "`auto`",
    "`full` (full integration), `bbar` (mean dilatation: does not lock as Poisson's ratio nears 1/2), `incompatible` "
    "(modes for bending), `reduced` (8 points in cells with `serendipity`, as C3D20R of decks) or `auto`: the best of "
    "the others for material and cells, see [which "
    "element](../doc/modelling.md#which-element)"),
  INTS("order", "elastic", 1, SceneBody, order, OPTIONAL, "1 for hexahedra, 2 for tetrahedra",
    "polynomial order of the displacements in a cell, 1 or 2. Hexahedra of order 2 have 27 nodes, tetrahedra 10; they "
    "are curved as the surface is"),
  ANSWER("serendipity", "elastic", SceneBody, serendipity, "`false`",
    "`true`: hexahedra of order 2 have 20 nodes, as those of decks, in place of 27. They are less accurate"),
  REALS("initial_velocity", NULL, 3, SceneBody, velocity, OPTIONAL, ANY, "L/T", "0",
    "velocity at time 0, only in `dynamics`"),
  REALS("initial_spin", NULL, 3, SceneBody, spin, OPTIONAL, ANY, "1/T", "0",
    "in `dynamics`: angular velocity at time 0 about the centre of mass [radians/T], added to `initial_velocity`"),
  {NULL}};

static const SceneKey material_rows[] = {NAMED("law", NULL, CHOICE, SceneMaterial, material.type, OPTIONAL,
                                           MaterialTypes, "`linear`", "the law; its constants are keys, as in a body"),
  {NULL}};

static const SceneKey face_rows[] = {
  TEXT("of", NULL, SceneSubface, of, REQUIRED, "", "a face, or a part listed before"),
  REALS("lower", NULL, 3, SceneSubface, lower, OPTIONAL, UNBOUNDED, "L", "no bound",
    "lower corner of the box that contains the centroids of the facets; `-inf`: no bound"),
  REALS("upper", NULL, 3, SceneSubface, upper, OPTIONAL, UNBOUNDED, "L", "no bound",
    "upper corner of that box; `inf`: no bound"),
  {NULL}};

static const SceneKey displacement_rows[] = {
  NUMBER_OF("body", BODY, SceneDisplacement, body, "", "a rigid body, or the body of `point` or of `from` and `to`"),
  TEXT("face", NULL, SceneDisplacement, face, OPTIONAL, "", "a face; required without `body`"),
  REALS("point", NULL, 3, SceneDisplacement, from, SHOWN, ANY, "L", "", "a vertex of `body`, which is displaced"),
  REALS("from", NULL, 3, SceneDisplacement, from, SHOWN, ANY, "L", "",
    "one end of an edge of `body`, whose vertices are displaced"),
  REALS("to", NULL, 3, SceneDisplacement, to, SHOWN, ANY, "L", "", "the other end"),
  OWN("value", NULL, SceneDisplacement, value, REQUIRED, SceneOwnComponents, "L", "",
    "displacements along x, y, z at load factor 1; each is a number or `free`"),
  OWN("rotation", NULL, SceneDisplacement, rotation, OPTIONAL, SceneOwnRotation, "degrees", "none",
    "rotation vector at load factor 1: its direction is the axis, its length the angle. For a rigid body each "
    "number may be `free`"),
  REALS("center", NULL, 3, SceneDisplacement, center, SHOWN, ANY, "L", "required with `rotation`",
    "a point on the axis, which moves by `value`"),
  NUMBER_OF("ramp", RAMP, SceneDisplacement, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey symmetry_rows[] = {
  TEXT("face", NULL, SceneDisplacement, face, SHOWN, "",
    "a plane face. An entry is only the face's name if the name implies the normal, as `body.xmin`"),
  REALS("normal", NULL, 3, SceneDisplacement, normal, SHOWN, ANY, "", "", "`x`, `y`, `z` or a vector"), {NULL}};

static const SceneKey pressure_rows[] = {TEXT("face", NULL, ScenePressure, face, REQUIRED, "", "a face"),
  ONE("value", NULL, EXPRESSION, ScenePressure, value, REQUIRED, NULL, NULL, "F/L²", "",
    "pressure at load factor 1 along the normal of the undeformed face; positive: towards the body; a number, or an "
    "expression of the undeformed coordinates `x`, `y`, `z`"),
  ANSWER("follows", NULL, ScenePressure, follows, "`false`",
    "whether the pressure acts on the deformed area along the deformed normal; only for bodies with a law of "
    "finite strain"),
  NUMBER_OF("ramp", RAMP, ScenePressure, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey traction_rows[] = {TEXT("face", NULL, SceneTraction, face, REQUIRED, "", "a face"),
  REALS("value", NULL, 3, SceneTraction, value, REQUIRED, ANY, "F/L²", "",
    "force per undeformed area at load factor 1"),
  NUMBER_OF("ramp", RAMP, SceneTraction, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey force_rows[] = {NUMBER_OF("body", BODY, SceneTraction, body, "",
                                        "a rigid body; or an elastic body, on which the force acts at `point`"),
  TEXT("face", NULL, SceneTraction, face, OPTIONAL, "", "a face; required without `body`"),
  REALS("value", NULL, 3, SceneTraction, value, SHOWN, ANY, "F", "0 with `moment`", "resultant force at load factor 1"),
  REALS("point", NULL, 3, SceneTraction, point, SHOWN, ANY, "L", "the face's centroid",
    "point of action; of a rigid body or a face also outside of the body, of an elastic body usually a node"),
  REALS("moment", NULL, 3, SceneTraction, moment, OPTIONAL, ANY, "F L", "0",
    "moment about that point at load factor 1"),
  NUMBER_OF("ramp", RAMP, SceneTraction, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey spring_rows[] = {TEXT("face", NULL, SceneSpring, face, REQUIRED, "", "a face"),
  TEXT("to", NULL, SceneSpring, to, OPTIONAL, "the ground",
    "face at the other end of the springs; it must cover the whole first face"),
  REALS("distance", NULL, 1, SceneSpring, distance, OPTIONAL, ABOVE_0, "L", "half the size of a facet",
    "largest distance of facets that springs with `to` join"),
  REALS("value", NULL, 3, SceneSpring, value, REQUIRED, ANY, "F/L³", "",
    "stiffness along x, y, z per undeformed area, not negative"),
  {NULL}};

static const SceneKey connector_rows[] = {
  NUMBER_OF("body", BODY, SceneConnector, body, "required", "the body at one end"),
  REALS("point", NULL, 3, SceneConnector, point[0], REQUIRED, ANY, "L", "",
    "a point of `body`, in undeformed coordinates"),
  NUMBER_OF("to", BODY, SceneConnector, to, "the ground", "the body at the other end"),
  REALS("to_point", NULL, 3, SceneConnector, point[1], SHOWN, ANY, "L", "`point`",
    "a point of that body, or of the ground"),
  REALS("stiffness", NULL, 1, SceneConnector, stiffness, SHOWN, ABOVE_0, "F/L", "",
    "stiffness along the undeformed line between the points. Required without `value`"),
  REALS("value", NULL, 3, SceneConnector, value, SHOWN, FROM_0, "F/L", "",
    "stiffness along x, y, z, instead of `stiffness`"),
  REALS("damping", NULL, 1, SceneConnector, damping, OPTIONAL, FROM_0, "F T/L", "0",
    "in `dynamics`: force per relative velocity of the points, along the line between them; with `value`: in every "
    "direction"),
  {NULL}};

static const SceneKey equation_rows[] = {NUMBER_OF("body", BODY, SceneEquation, body, "required", "a body"),
  REALS("point", NULL, 3, SceneEquation, point[0], REQUIRED, ANY, "L", "",
    "a point of `body`, in undeformed coordinates"),
  REALS("direction", NULL, 3, SceneEquation, direction[0], REQUIRED, ANY, "", "",
    "factors of the displacements of `point` along x, y, z"),
  NUMBER_OF("to", BODY, SceneEquation, to, "one point only", "the body of a second point"),
  REALS("to_point", NULL, 3, SceneEquation, point[1], SHOWN, ANY, "L", "", "a point of that body"),
  REALS("to_direction", NULL, 3, SceneEquation, direction[1], SHOWN, ANY, "", "",
    "factors of the displacements of `to_point`"),
  REALS("value", NULL, 1, SceneEquation, value, OPTIONAL, ANY, "L", "0",
    "the sum of all factors times their displacements, at load factor 1"),
  NUMBER_OF("ramp", RAMP, SceneEquation, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey bolt_rows[] = {NUMBER_OF("body", BODY, SceneBolt, body, "required", "the body that is cut"),
  REALS("point", NULL, 3, SceneBolt, point, REQUIRED, ANY, "L", "",
    "a point of the plane of the section, in undeformed coordinates; the plane cuts the whole body"),
  REALS("axis", NULL, 3, SceneBolt, axis, REQUIRED, ANY, "", "", "direction of the bolt, normal to that plane"),
  REALS("force", NULL, 1, SceneBolt, force, SHOWN, ANY, "F", "",
    "force in the section at load factor 1; positive: tension. Required without `shortening`"),
  REALS("shortening", NULL, 1, SceneBolt, shortening, SHOWN, ANY, "L", "",
    "length by which the bolt is shortened at the section at load factor 1, instead of `force`"),
  INTS("lock", NULL, 1, SceneBolt, lock, OPTIONAL, "0: never",
    "load step after which the shortening is constant and the force is no longer prescribed"),
  NUMBER_OF("ramp", RAMP, SceneBolt, ramp, "`load`", "a ramp that force or shortening follows"), {NULL}};

static const SceneKey body_force_rows[] = {NUMBER_OF("body", BODY, SceneBodyForce, body, "every body", "a body"),
  REALS("value", NULL, 3, SceneBodyForce, value, REQUIRED, ANY, "F/L³", "",
    "force per undeformed volume at load factor 1"),
  NUMBER_OF("ramp", RAMP, SceneBodyForce, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey temperature_rows[] = {NUMBER_OF("body", BODY, SceneTemperature, body,
                                              "all bodies with thermal expansion",
                                              "a body whose material has an `expansion`"),
  ONE("value", NULL, EXPRESSION, SceneTemperature, value, REQUIRED, NULL, NULL, "temperature", "",
    "difference from the temperature without stress, at load factor 1: a number, or an expression of the undeformed "
    "coordinates `x`, `y`, `z`"),
  NUMBER_OF("ramp", RAMP, SceneTemperature, ramp, "`load`", "a ramp that the value follows"), {NULL}};

static const SceneKey contact_rows[] = {TEXT("mortar", NULL, SceneContactPair, mortar, OPTIONAL,
                                          "required, except in `auto`",
                                          "the mortar (master) face, preferably the larger one; or a body, see "
                                          "[contact: auto](../doc/modelling.md#contact-auto)"),
  TEXT("nonmortar", NULL, SceneContactPair, nonmortar, OPTIONAL, "required, except in `auto`",
    "the nonmortar (secondary) face, which carries the constraints; preferably the finer or softer one; or a body"),
  TEXT("self", NULL, SceneContactPair, self, OPTIONAL, "none",
    "instead of `mortar` and `nonmortar`: name of a face, or of a body (its whole surface), that comes into contact "
    "with itself, see [Self contact](../doc/modelling.md#self-contact). In `auto`: `true`, all bodies of finite "
    "strain"),
  NAMED("gap", NULL, CHOICE, SceneContactPair, gap, SHOWN, GapTypes, "`auto`",
    "`auto`: `mortar`, and `dual` from the first load step on for which `mortar` finds no equilibrium; "
    "`mortar`: integrated over the overlap of the faces; `node`: from nonmortar vertex to the closest point of the "
    "mortar face; `dual`: as `mortar`, with dual shape functions, whose forces act at the nonmortar vertices, see "
    "[contact surfaces](../doc/modelling.md#contact-surfaces-and-updates)"),
  REALS("distance", NULL, 1, SceneContactPair, distance, OPTIONAL, FROM_0, "L", "chosen from the size of the faces",
    "largest distance of facets that can come into contact; facets further apart are not searched"),
  OWN("interference", NULL, SceneContactPair, interference, OPTIONAL, SceneOwnInterference, "L", "`false`",
    "whether the faces overlap at the start on purpose, as in a press fit: `true`, or the largest such overlap"),
  NUMBER_OF("ramp", RAMP, SceneContactPair, interference_ramp, "the whole overlap is closed in the first load step",
    "a ramp, or `load`, that an `interference` given as a length follows. The gap is increased by `interference` "
    "times (1 - factor)"),
  REALS("contact_stiffness", NULL, 1, SceneContactPair, stiffness, OPTIONAL, ABOVE_0, "F/L³",
    "none: faces do not "
    "penetrate",
    "soft contact: the pressure is this stiffness times the depth by which the faces penetrate, as if one of them had "
    "a thin elastic layer"),
  REALS("contact_exponential", NULL, 2, SceneContactPair, exponential, OPTIONAL, ABOVE_0, "L, F/L²",
    "none: faces do not penetrate",
    "soft contact: [c, p] gives the pressure p at no gap, p/100 at the gap c, and grows by the same factor for each "
    "further depth c"),
  REALS("friction", NULL, 1, SceneContactPair, friction, OPTIONAL, FROM_0, "", "0: none",
    "Coulomb's coefficient of friction"),
  NUMBER_OF("friction_ramp", RAMP, SceneContactPair, friction_ramp, "constant", "a ramp that the coefficient follows"),
  REALS("shear_limit", NULL, 1, SceneContactPair, shear_limit, OPTIONAL, FROM_0, "F/L²", "none",
    "largest friction stress. With `friction` it limits Coulomb's law; alone it is Tresca's law where the faces touch"),
  OWN("stick", NULL, SceneContactPair, friction, OPTIONAL, SceneOwnStick, "", "`false`",
    "`true`: faces that touch do not slip while the shear force is below 1,000 times the normal force; without "
    "`friction` and `shear_limit`. A node that closes within a load step sticks where it closes. A node that opens and "
    "closes again within a load step may slip in between"),
  ANSWER("smooth", NULL, SceneContactPair, smooth, "`true`",
    "`true`: the gap is measured between smooth surfaces through the facets of curved faces; edges of more than "
    "35 degrees stay sharp. `false`: between the facets"),
  REALS("tie", NULL, 1, SceneContactPair, tie, OPTIONAL, FROM_0, "L", "none",
    "only for `auto` and pairs of bodies: surfaces that are nearer than this are tied"),
  OWN("except", NULL, SceneContactPair, except, OPTIONAL, SceneOwnExcept, "", "none",
    "only for `auto`: bodies and faces that get no contact, or two of them as `a/b`"),
  {NULL}};

static const SceneKey tie_rows[] = {TEXT("mortar", NULL, SceneTie, mortar, REQUIRED, "", "a face"),
  TEXT("nonmortar", NULL, SceneTie, nonmortar, REQUIRED, "",
    "a face, whose displacements are weighted means of those of the mortar face; preferably the finer or softer one"),
  REALS("distance", NULL, 1, SceneTie, distance, OPTIONAL, ABOVE_0, "L", "half the size of a nonmortar facet",
    "facets further apart are not joined"),
  {NULL}};

static const SceneKey cyclic_rows[] = {TEXT("from", NULL, SceneCyclic, from, REQUIRED, "", "a face"),
  TEXT("to", NULL, SceneCyclic, to, REQUIRED, "",
    "a face of the same body, onto which a rotation about the axis moves the first one, node by node"),
  REALS("axis", NULL, 3, SceneCyclic, axis, REQUIRED, ANY, "", "", "direction of the axis"),
  REALS("center", NULL, 3, SceneCyclic, center, OPTIONAL, ANY, "L", "[0, 0, 0]", "a point on the axis"), {NULL}};

static const SceneKey refinement_rows[] = {
  OWN("near", NULL, SceneRefinement, face, OPTIONAL, SceneOwnNear, "", "none: `lower` and `upper` are required",
    "a contact pair, to refine cells near both of its undeformed faces; or a face, to refine cells of its"
    " body near it"),
  REALS("lower", NULL, 3, SceneRefinement, lower, SHOWN, ANY, "L", "required without `near`",
    "lower corner of the box in which cells are refined"),
  REALS("upper", NULL, 3, SceneRefinement, upper, SHOWN, ANY, "L", "required without `near`",
    "upper corner of the box"),
  NUMBER_OF("body", BODY, SceneRefinement, body, "any body", "the body whose cells in the box are refined"),
  INTS("levels", NULL, 1, SceneRefinement, levels, SHOWN, "1",
    "how often each of these cells is divided into eight, after the uniform refinements; where zones overlap the "
    "larger number applies"),
  REALS("distance", NULL, 1, SceneRefinement, distance, SHOWN, FROM_0, "L", "0: cells that touch it",
    "cells are refined if their bounding box is within this distance of the face or the box"),
  {NULL}};

static const SceneKey probe_rows[] = {REALS("point", NULL, 3, SceneProbe, from, SHOWN, ANY, "L",
                                        "required for a single point", "a point of the undeformed body"),
  REALS("from", NULL, 3, SceneProbe, from, SHOWN, ANY, "L", "required for a line", "one end of a line"),
  REALS("to", NULL, 3, SceneProbe, to, SHOWN, ANY, "L", "required for a line", "the other end"),
  INTS("points", NULL, 1, SceneProbe, n, SHOWN, "required for a line",
    "number of points of the line, both ends included"),
  NUMBER_OF("body", BODY, SceneProbe, body, "the first of them", "the body, if the point is on several"), {NULL}};

static const SceneKey load_rows[] = {SECTION("steps", "the number of factors of the first ramp with `factors`, or 1",
                                       "number of load steps; the load factor grows linearly from 0 to 1"),
  SECTION("factors", "", "load factor at the end of each load step, instead of `steps`"),
  SECTION("expression", "",
    "load factor as an expression of the time `t` and of `s` = t / number of steps; requires `steps`"),
  SECTION("times", "", "ascending times of a table (load step k ends at time k); requires `steps`"),
  SECTION("values", "", "factors at these times; between them the factor is linear"), {NULL}};

static const SceneKey ramp_rows[] = {
  SECTION("factors", "", "factor at the end of each load step. It is 0 at the start and linear within a load step"),
  SECTION("expression", "", "factor as an expression of the time `t` and of `s` = t / number of load steps"),
  SECTION("times", "", "ascending times of a table (load step k ends at time k)"),
  SECTION("values", "", "factors at these times; between them the factor is linear"), {NULL}};

static const SceneKey dynamics_rows[] = {
  REALS("time_step", NULL, 1, SceneDynamics, time_step, REQUIRED, ANY, "T", "",
    "length of the time steps, above 0. It is reduced if `end_time` is not a multiple of it"),
  REALS("end_time", NULL, 1, SceneDynamics, end_time, REQUIRED, ANY, "T", "", "at least `time_step`"),
  REALS("tolerance", NULL, 1, SceneDynamics, tolerance, OPTIONAL, ANY, "", "",
    "allowed error of the displacement in a time step, divided by the length of the step times the largest speed so "
    "far; for example 1e-3. The program then chooses the lengths of the time steps, at most `time_step`, and writes "
    "results at the multiples of `time_step`. Without `tolerance` all time steps have the length `time_step`"),
  NAMED("scheme", NULL, CHOICE, SceneDynamics, scheme, SHOWN, DynamicsSchemes, "`impact`",
    "`impact`: trapezoidal rule with implicit contact forces, which never add energy. `generalized_alpha`: dissipates "
    "high frequencies; `spectral_radius` sets how much"),
  REALS("spectral_radius", NULL, 1, SceneDynamics, spectral_radius, OPTIONAL, ANY, "", "0.8",
    "for `generalized_alpha`: fraction of the highest frequencies that remains after a time step, from 0 to 1; 1: "
    "nothing is dissipated"),
  NAMED("mass", NULL, CHOICE, SceneDynamics, mass, SHOWN, MassTypes, "`redistributed`",
    "mass matrix. `redistributed`: lumped, but the mass of nodes on contact faces without friction is moved to the "
    "other nodes of their cells; `lumped`; `consistent`"),
  REALS("damping_mass", NULL, 1, SceneDynamics, damping_mass, OPTIONAL, ANY, "1/T", "0",
    "Rayleigh damping: the force is this factor times mass times velocity"),
  REALS("damping_stiffness", NULL, 1, SceneDynamics, damping_stiffness, OPTIONAL, ANY, "T", "0",
    "Rayleigh damping: the force is this factor times stiffness times velocity; only for bodies with linear laws"),
  {NULL}};

static const SceneBody         body_initial         = {.element = ELEMENT_AUTO};
static const SceneDisplacement displacement_initial = {.body = PETSC_DECIDE};
static const SceneTraction     traction_initial     = {.body = PETSC_DECIDE};
static const SceneTraction     force_initial        = {.body = PETSC_DECIDE, .resultant = PETSC_TRUE};
static const SceneConnector    connector_initial    = {.body = PETSC_DECIDE, .to = PETSC_DECIDE};
static const SceneEquation     equation_initial     = {.body = PETSC_DECIDE, .to = PETSC_DECIDE};
static const SceneBolt         bolt_initial         = {.body = PETSC_DECIDE};
static const SceneBodyForce    body_force_initial   = {.body = PETSC_DECIDE};
static const SceneTemperature  temperature_initial  = {.body = PETSC_DECIDE};
static const SceneContactPair  contact_initial      = {.interference_ramp = PETSC_DECIDE,
        .friction_ramp                                                    = PETSC_DECIDE,
        .shear_limit                                                      = PETSC_INFINITY,
        .smooth                                                           = PETSC_TRUE};
static const SceneRefinement   refinement_initial   = {.body = PETSC_DECIDE, .levels = 1};
static const SceneProbe        probe_initial        = {.body = PETSC_DECIDE, .n = 1};
static const SceneDynamics     dynamics_initial     = {.scheme = SCHEME_IMPACT, .spectral_radius = 0.8};
static const SceneSubface      face_initial         = {.lower = {PETSC_NINFINITY, PETSC_NINFINITY, PETSC_NINFINITY},
               .upper                                         = {PETSC_INFINITY, PETSC_INFINITY, PETSC_INFINITY}};

#define OF_SCENE(n, list) .count = offsetof(struct _n_Scene, n), .entries = offsetof(struct _n_Scene, list)

/*
   Lists in the order in which they are printed. A list that shares its entries with another list comes after the list
   that owns them.
*/
const SceneList SceneLists[] = {
  {.name = "", .rows = top_rows},
  {"bodies", body_rows, sizeof(SceneBody), OF_SCENE(nbodies, bodies), .required = PETSC_TRUE, .initial = &body_initial,
    .finish = SceneFinishBody},
  {"faces", face_rows, sizeof(SceneSubface), .initial = &face_initial},
  {"displacements", displacement_rows, sizeof(SceneDisplacement), OF_SCENE(ndisplacements, displacements),
    .initial = &displacement_initial, .finish = SceneFinishDisplacement, .holds = SceneDisplacementIsListed,
    .hides = SceneDisplacementHides},
  {"symmetry", symmetry_rows, sizeof(SceneDisplacement), OF_SCENE(ndisplacements, displacements),
    .holds = SceneDisplacementIsPlane, .shared = PETSC_TRUE},
  {"pressures", pressure_rows, sizeof(ScenePressure), OF_SCENE(npressures, pressures)},
  {"tractions", traction_rows, sizeof(SceneTraction), OF_SCENE(ntractions, tractions), .initial = &traction_initial,
    .holds = SceneTractionIsNone},
  {"forces", force_rows, sizeof(SceneTraction), OF_SCENE(ntractions, tractions), .initial = &force_initial,
    .finish = SceneFinishForce, .holds = SceneTractionIsForce, .hides = SceneForceHides, .shared = PETSC_TRUE},
  {"springs", spring_rows, sizeof(SceneSpring), OF_SCENE(nsprings, springs), .finish = SceneFinishSpring},
  {"connectors", connector_rows, sizeof(SceneConnector), OF_SCENE(nconnectors, connectors),
    .initial = &connector_initial, .finish = SceneFinishConnector, .hides = SceneConnectorHides},
  {"equations", equation_rows, sizeof(SceneEquation), OF_SCENE(nequations, equations), .initial = &equation_initial,
    .finish = SceneFinishEquation, .hides = SceneEquationHides},
  {"bolts", bolt_rows, sizeof(SceneBolt), OF_SCENE(nbolts, bolts), .initial = &bolt_initial, .finish = SceneFinishBolt,
    .hides = SceneBoltHides},
  {"temperatures", temperature_rows, sizeof(SceneTemperature), OF_SCENE(ntemperatures, temperatures),
    .initial = &temperature_initial},
  {"body_forces", body_force_rows, sizeof(SceneBodyForce), OF_SCENE(nforces, forces), .initial = &body_force_initial},
  {"contact", contact_rows, sizeof(SceneContactPair), OF_SCENE(npairs, pairs), .initial = &contact_initial,
    .finish = SceneFinishPair, .hides = ScenePairHides},
  {"ties", tie_rows, sizeof(SceneTie), OF_SCENE(nties, ties)},
  {"cyclic", cyclic_rows, sizeof(SceneCyclic), OF_SCENE(ncyclic, cyclic)},
  {"refinements", refinement_rows, sizeof(SceneRefinement), OF_SCENE(nrefinements, refinements),
    .initial = &refinement_initial, .finish = SceneFinishRefinement, .hides = SceneRefinementHides},
  {"probes", probe_rows, sizeof(SceneProbe), OF_SCENE(nprobes, probes), .initial = &probe_initial,
    .finish = SceneFinishProbe, .hides = SceneProbeHides},
  {"materials", material_rows, sizeof(SceneMaterial), .finish = SceneFinishMaterial},
  {.name = "load", .rows = load_rows},
  {.name = "ramps", .rows = ramp_rows},
  {.name = "dynamics", .rows = dynamics_rows, .initial = &dynamics_initial},
  {.name = NULL},
};

/* Finds a list by its name. Returns NULL if there is none. */
const SceneList *SceneFindList(const char name[])
{
  const SceneList *list = SceneLists;

  while (list->name && strcmp(list->name, name)) ++list;
  return list->name ? list : NULL;
}
