static char help[] = "Every error of a scene: one sentence, the same on every rank.\n";

#include <mesh.h>
#include <scene.h>
#include <petscviewer.h>
#include "../lib/attempt.h"

typedef struct {
  const char *name;
  const char *change; /* of the sound scene below: text that is replaced */
  const char *by;
} Mistake;

static const char sound[] =
  "problem: press\n"
  "bodies:\n"
  "  - slab: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [4, 4, 2], young: 1, poisson: 0.3}\n"
  "  - block: {lower: [1, 1, 1], upper: [2, 2, 2], cells: [2, 2, 2], young: 10, poisson: 0.0}\n"
  "displacements:\n"
  "  - bottom: {face: slab.zmin, value: [0, 0, 0]}\n"
  "  - top: {face: block.zmax, value: [0, 0, -1/10]}\n"
  "contact:\n"
  "  - pair: {mortar: slab.zmax, nonmortar: block.zmin}\n"
  "load: {steps: 2}\n"
  "refine: 0\n";

static const Mistake mistakes[] = {
  {"sound", "press", "press"},
  {"malformed: bracket", "[0, 0, 0], upper", "[0, 0, 0, upper"},
  {"malformed: no mapping", sound, "just a sentence\n"},
  {"malformed: tab", "  - slab", "\t- slab"},
  {"malformed: alias of nothing", "value: [0, 0, 0]", "value: *zero"},
  {"malformed: no UTF-8", "press", "pr\xffss"},
  {"sound: a mark of UTF-8", "problem", "\xef\xbb\xbfproblem"},
  {"sound: keys of two entries alike", "top: {face", "bottom_face: {face"},
  {"key twice", "young: 1,", "young: 1, Young: 2,"},
  {"key twice: joined", "refine: 0", "load_steps: 3"},
  {"section twice", "refine: 0", "load: {steps: 3}"},
  {"decimal comma", "poisson: 0.3", "poisson: 0,3"},
  {"name that is none", "slab: {", "\xe4\xb8\x8b: {"},
  {"empty", sound, ""},
  {"misspelt key of a body", "young: 1,", "yuong: 1,"},
  {"misspelt list", "displacements", "displacments"},
  {"misspelt top key", "refine", "refin"},
  {"misspelt nested key", "{steps: 2}", "{step: 2}"},
  {"unknown key among good ones", "refine: 0", "refine: 0\ncolour: red"},
  {"missing key", "young: 1,", ""},
  {"no value", "young: 1,", "young: ,"},
  {"not a number", "young: 1,", "young: stiff,"},
  {"trailing letters", "young: 1,", "young: 1GPa,"},
  {"half a fraction", "-1/10", "-1/"},
  {"division by zero", "-1/10", "-1/0"},
  {"NaN", "young: 1,", "young: nan,"},
  {"infinity", "upper: [4, 4, 1]", "upper: [4, 4, inf]"},
  {"overflow", "upper: [4, 4, 1]", "upper: [4, 4, 1e999]"},
  {"NaN in a displacement", "[0, 0, -1/10]", "[0, 0, NaN]"},
  {"short list", "cells: [4, 4, 2]", "cells: [4, 4]"},
  {"long list", "lower: [0, 0, 0]", "lower: [0, 0, 0, 0]"},
  {"broken cell", "cells: [4, 4, 2]", "cells: [4, 4.5, 2]"},
  {"huge count", "cells: [4, 4, 2]", "cells: [4, 99999999999999999999, 2]"},
  {"no cells", "cells: [4, 4, 2]", "cells: [4, 0, 2]"},
  {"negative box", "upper: [4, 4, 1]", "upper: [4, -4, 1]"},
  {"flat box", "upper: [4, 4, 1]", "upper: [4, 4, 0]"},
  {"grading of zero", "cells: [4, 4, 2]", "cells: [4, 4, 2], grading: [0, 1, 1]"},
  {"surface of no size", "displacements:",
    "  - wall: {shape: rigid_plane, point: [0, 0, 9], normal: [0, 0, 1], size: 0}\ndisplacements:"},
  {"mesh scaled to nothing", "displacements:",
    "  - lump: {mesh: lump.msh, volume: lump, scale: 0, young: 1, poisson: 0}\ndisplacements:"},
  {"unknown shape", "slab: {", "slab: {shape: sphere, "},
  {"expansion of a law that has none", "young: 1,", "young: 1, material: neohookean, expansion: 1e-5,"},
  {"shape of another program", "slab: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [4, 4, 2]",
    "slab: {shape: brick, radius: 1, height: 2"},
  {"key of another program: E", "young: 1,", "E: 1,"},
  {"key of another program: nu", "poisson: 0.3", "nu: 0.3"},
  {"key of another program: slave", "nonmortar: block.zmin", "slave: block.zmin"},
  {"key of another program: master", "mortar: slab.zmax", "master: slab.zmax"},
  {"key of another program: parts", "bodies:", "parts:"},
  {"pair without a name", "- pair: {mortar: slab.zmax, nonmortar: block.zmin}",
    "- {mortar: slab.zmax, nonmortar: block.zmin}"},
  {"pair without a name, in lines", "- pair: {mortar: slab.zmax, nonmortar: block.zmin}",
    "- mortar: slab.zmax\n    nonmortar: block.zmin"},
  {"face of another body", "slab.zmin", "slab.outer"},
  {"unknown material", "slab: {", "slab: {material: rubber, "},
  {"library that is not there", "refine: 0", "library: nowhere.yaml"},
  {"material without constants", "refine: 0", "materials: [soft: {young: 1}]"},
  {"material named as a law", "refine: 0", "materials: [linear: {young: 1, poisson: 0}]"},
  {"material of no law", "refine: 0", "materials: [soft: {law: jelly, young: 1, poisson: 0}]"},
  {"rigid material", "refine: 0", "materials: [hard: {law: rigid, young: 1, poisson: 0}]"},
  {"misspelt key of a material", "refine: 0", "materials: [soft: {yuong: 1, poisson: 0}]"},
  {"E zero", "young: 1,", "young: 0,"},
  {"E negative", "young: 1,", "young: -1,"},
  {"nu one half", "poisson: 0.3", "poisson: 0.5"},
  {"nu minus one", "poisson: 0.3", "poisson: -1"},
  {"refine negative", "refine: 0", "refine: -1"},
  {"zero load steps", "steps: 2", "steps: 0"},
  {"no load factors", "steps: 2", "factors: []"},
  {"steps and factors", "steps: 2", "steps: 2, factors: [1]"},
  {"no bodies", sound, "bodies: []\n"},
  {"two bodies of one name", "- block: {", "- Slab: {"},
  {"bad name", "- bottom:", "- 2nd:"},
  {"face does not exist", "slab.zmin", "slab.bottom"},
  {"face of no body", "face: slab.zmin", "face: zmin"},
  {"displacement of an unknown body", "face: slab.zmin", "face: slob.zmin"},
  {"pair with an unknown body", "mortar: slab.zmax", "mortar: table.zmax"},
  {"pair with an unknown face", "nonmortar: block.zmin", "nonmortar: block.under"},
  {"pair of one face", "nonmortar: block.zmin", "nonmortar: slab.zmax"},
  {"pair given twice", "load:", "  - again: {mortar: block.zmin, nonmortar: slab.zmax}\nload:"},
  {"component prescribed twice", "contact:", "  - more: {face: slab.zmin, value: [free, free, 1]}\ncontact:"},
  {"wrong word for free", "[0, 0, -1/10]", "[loose, 0, 0]"},
  {"body held by nothing",
    "  - top: {face: block.zmax, value: [0, 0, -1/10]}\ncontact:\n  - pair: {mortar: slab.zmax, nonmortar: "
    "block.zmin}\n",
    ""},
  {"body held by contact alone", "  - top: {face: block.zmax, value: [0, 0, -1/10]}\n", ""},
  {"no displacement at all",
    "displacements:\n  - bottom: {face: slab.zmin, value: [0, 0, 0]}\n  - top: {face: block.zmax, value: [0, 0, "
    "-1/10]}\n",
    ""},
  {"normal motion held by contact", "value: [0, 0, -1/10]", "value: [0, 0, free]"},
  {"unknown element", "slab: {", "slab: {element: hybrid, "},
  {"incompatible modes at finite strain", "slab: {", "slab: {material: neohookean, element: incompatible, "},
  {"mean of what is no dilatation", "slab: {", "slab: {material: saint_venant, element: bbar, "},
  {"order 3", "slab: {", "slab: {order: 3, "},
  {"order 0", "slab: {", "slab: {order: 0, "},
  {"incompatible modes of order 2", "slab: {", "slab: {order: 2, element: incompatible, "},
  {"unknown model", "refine: 0", "model: exact"},
  {"no linearization of the gap", "refine: 0", "contact_updates: 0"},
  {"bounds from the first step", "refine: 0", "displacement_bounds: 1"},
  {"bounds after the last step", "refine: 0", "displacement_bounds: 3"},
  {"unknown gap", "mortar: slab.zmax, ", "mortar: slab.zmax, gap: penalty, "},
  {"negative distance", "mortar: slab.zmax, ", "mortar: slab.zmax, distance: -1, "},
  {"misspelt key of a pair", "mortar: slab.zmax, ", "mortar: slab.zmax, distnace: 1, "},
  {"ramp of the wrong length", "refine: 0", "ramps: [slow: {factors: [1]}]"},
  {"ramp without factors", "refine: 0", "ramps: [slow: {factor: [1, 1]}]"},
  {"ramp by a broken expression", "refine: 0", "ramps: [slow: {expression: sin(t}]"},
  {"ramp by an unknown function", "refine: 0", "ramps: [slow: {expression: 2*step(t)}]"},
  {"ramp that is not finite", "refine: 0", "ramps: [slow: {expression: 1/(t-1)}]"},
  {"ramp of factors and an expression", "refine: 0", "ramps: [slow: {factors: [1, 1], expression: t}]"},
  {"ramp of times alone", "refine: 0", "ramps: [slow: {times: [0, 1]}]"},
  {"ramp of times that go back", "refine: 0", "ramps: [slow: {times: [0, 1, 1], values: [0, 1, 2]}]"},
  {"ramp of more times than values", "refine: 0", "ramps: [slow: {times: [0, 1, 2], values: [0, 1]}]"},
  {"ramp named load", "refine: 0", "ramps: [Load: {factors: [1, 1]}]"},
  {"unknown ramp", "value: [0, 0, 0]}", "value: [0, 0, 0], ramp: slow}"},
  {"pressure on no face", "refine: 0", "pressures: [wind: {value: 1, face: slab.top}]"},
  {"pressure without a value", "refine: 0", "pressures: [wind: {face: slab.zmax}]"},
  {"NaN pressure", "refine: 0", "pressures: [wind: {face: slab.zmax, value: nan}]"},
  {"misspelt key of a pressure", "refine: 0", "pressures: [wind: {face: slab.zmax, vlaue: 1}]"},
  {"body force on no body", "refine: 0", "body_forces: [g: {body: table, value: [0, 0, 1]}]"},
  {"body force along z", "refine: 0", "body_forces: [g: {value: 1}]"},
  {"symmetry of no face", "refine: 0", "symmetry: [slab.left]"},
  {"symmetry of no body", "refine: 0", "symmetry: [table.xmin]"},
  {"symmetry of a word", "refine: 0", "symmetry: [left]"},
  {"symmetry without a normal", "refine: 0", "symmetry: [left: {face: slab.xmin}]"},
  {"symmetry of no axis", "refine: 0", "symmetry: [left: {face: slab.xmin, normal: w}]"},
  {"symmetry of no normal", "refine: 0", "symmetry: [left: {face: slab.xmin, normal: [0, 0, 0]}]"},
  {"symmetry of a normal in a plane", "refine: 0", "symmetry: [left: {face: slab.xmin, normal: [1, 2]}]"},
  {"symmetry of a plane along no axis", "bodies:\n",
    "symmetry: [arc.amax]\nbodies:\n  - arc: {shape: tube_arc, axis: x, radii: [1, 2], angles: [0, 80], extent: [0, "
    "1], cells: [1, 2, 1], young: 1, poisson: 0}\n"},
  {"symmetry of a plane held already", "refine: 0", "symmetry: [slab.zmin]"},
  {"symmetry of a displacement's name", "refine: 0", "symmetry: [top: {face: slab.xmin, normal: x}]"},
  {"traction on no face", "refine: 0", "tractions: [wind: {value: [1, 0, 0], face: slab.top}]"},
  {"traction of one number", "refine: 0", "tractions: [wind: {face: slab.zmax, value: 1}]"},
  {"force without a value", "refine: 0", "forces: [bolt: {face: slab.zmax, point: [0, 0, 1]}]"},
  {"moment of a traction", "refine: 0", "tractions: [wind: {face: slab.zmax, value: [1, 0, 0], moment: [0, 0, 1]}]"},
  {"springs that push", "refine: 0", "springs: [soil: {face: slab.zmin, value: [0, 0, -1]}]"},
  {"springs of no stiffness", "refine: 0", "springs: [soil: {face: slab.zmin, value: [0, 0, 0]}]"},
  {"weak springs of a number", "refine: 0", "weak_springs: 2"},
  {"rigid body that nothing moves", "bodies:\n",
    "bodies:\n  - tool: {material: rigid, lower: [5, 5, 5], upper: [6, 6, 6], cells: [1, 1, 1]}\n"},
  {"rigid body of which a face is displaced", "displacements:\n",
    "  - tool: {material: rigid, lower: [5, 5, 5], upper: [6, 6, 6], cells: [1, 1, 1]}\ndisplacements:\n  - push: "
    "{face: tool.zmin, value: [0, 0, 0]}\n"},
  {"rigid body with a stiffness", "bodies:\n",
    "bodies:\n  - tool: {material: rigid, lower: [5, 5, 5], upper: [6, 6, 6], cells: [1, 1, 1], young: 1}\n"},
  {"elastic body moved as a whole", "contact:", "  - more: {body: slab, value: [0, 0, 1]}\ncontact:"},
  {"displacement at a point of no body", "face: slab.zmin, value", "point: [0, 0, 0], value"},
  {"displacement at a point and an edge", "face: slab.zmin, value",
    "body: slab, point: [0, 0, 0], to: [1, 0, 0], value"},
  {"displacement along half an edge", "face: slab.zmin, value", "body: slab, from: [0, 0, 0], value"},
  {"displacement at a place of two numbers", "face: slab.zmin, value", "body: slab, point: [0, 0], value"},
  {"displacement where no vertex is", "face: slab.zmin, value", "body: slab, point: [0.1, 0.2, 0.3], value"},
  {"displacement of a face and a body", "face: slab.zmin, value", "face: slab.zmin, body: slab, value"},
  {"displacement of nothing", "face: slab.zmin, value", "value"},
  {"rotation about nothing", "value: [0, 0, -1/10]", "value: [0, 0, -1/10], rotation: [0, 0, 5]"},
  {"center of no rotation", "value: [0, 0, -1/10]", "value: [0, 0, -1/10], center: [0, 0, 5]"},
  {"rotation of one number", "value: [0, 0, -1/10]", "value: [0, 0, -1/10], rotation: 5, center: [0, 0, 0]"},
  {"rotation with a free component", "value: [0, 0, -1/10]",
    "value: [0, 0, free], rotation: [0, 0, 5], center: [0, 0, 0]"},
  {"rotation of a face displaced already",
    "contact:", "  - turn: {face: slab.zmin, value: [0, 0, 0], rotation: [0, 0, 5], center: [0, 0, 0]}\ncontact:"},
  {"rotations about two centers", "value: [0, 0, 0]}",
    "value: [0, 0, 0], rotation: [0, 0, 5], center: [0, 0, 0]}\n  - turn: {face: slab.zmin, value: [0, 0, 0], "
    "rotation: [0, 0, 5], center: [0, 1, 0]}"},
  {"tie without a side", "refine: 0", "ties: [glue: {mortar: slab.zmax}]"},
  {"tie to no body", "refine: 0", "ties: [glue: {mortar: slab.zmax, nonmortar: block}]"},
  {"misspelt key of a tie", "refine: 0", "ties: [glue: {mortar: slab.zmax, nonmortar: block.zmin, distnace: 1}]"},
  {"probe that is nothing", "refine: 0", "probes: [tip: {body: slab}]"},
  {"probe that is both", "refine: 0", "probes: [tip: {point: [0, 0, 0], points: 3}]"},
  {"probe without an end", "refine: 0", "probes: [cut: {from: [0, 0, 0], points: 3}]"},
  {"line of one point", "refine: 0", "probes: [cut: {from: [0, 0, 0], to: [1, 1, 1], points: 1}]"},
  {"probe in a plane", "refine: 0", "probes: [tip: {point: [0, 0]}]"},
  {"probe of no body", "refine: 0", "probes: [tip: {point: [0, 0, 0], body: table}]"},
  {"misspelt key of a probe", "refine: 0", "probes: [tip: {pont: [0, 0, 0]}]"},
  {"solver without options", "refine: 0", "solver: fast"},
  {"two keys in an item", "- bottom: {face: slab.zmin, value: [0, 0, 0]}",
    "- bottom: {face: slab.zmin}\n    value: [0, 0, 0]"},
  {"free along y", "value: [0, 0, -1/10]", "value: [0, free, -1/10]"},
  {"a line indented too little", "  - top:", " - top:"},
  {"entries without dashes", "  - pair:", "  pair:"},
  {"body without dashes, indented", sound,
    "bodies:\n  slab:\n    lower: [0, 0, 0]\n    upper: [1, 1, 1]\n    cells: [1, 1, 1]\n"},
  {"load of a number", "load: {steps: 2}", "load: 2"},
  {"key without a value", "young: 1,", "young: ,"},
  {"quotation that is not closed", "refine: 0", "problem: \"press"},
  {"no blank behind a colon", "refine: 0", "refine:0"},
  {"two colons", "refine: 0", "refine: refine: 0"},
  {"mesh file that is not there", "slab: {",
    "slab: {shape: gmsh, mesh: nowhere.msh, volume: slab, young: 1, poisson: 0}\n  - more: {"},
  {"list in a list", sound, "bodies:\n  - [a, b]\n"},
};

static PetscErrorCode WriteScene(const char file[], const Mistake *mistake)
{
  char       *text, *where;
  size_t      length, nchange;
  PetscMPIInt rank;
  FILE       *stream;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) {
    PetscCall(PetscStrlen(mistake->by, &length));
    PetscCall(PetscStrlen(mistake->change, &nchange));
    PetscCall(PetscMalloc1(sizeof(sound) + length, &text));
    PetscCall(PetscStrstr(sound, mistake->change, &where));
    PetscCheck(where, PETSC_COMM_SELF, PETSC_ERR_PLIB, "The sound scene does not hold \"%s\"", mistake->change);
    (void)snprintf(text, sizeof(sound) + length, "%.*s%s%s", (int)(where - sound), sound, mistake->by, where + nchange);
    PetscCall(PetscFOpen(PETSC_COMM_SELF, file, "w", &stream));
    PetscCall(PetscFPrintf(PETSC_COMM_SELF, stream, "%s", text));
    PetscCall(PetscFClose(PETSC_COMM_SELF, stream));
    PetscCall(PetscFree(text));
  }
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* Whether the bodies are held is seen on their mesh */
static PetscErrorCode LoadAndMesh(const char file[])
{
  Scene scene;
  DM    dm;

  PetscFunctionBeginUser;
  PetscCall(SceneLoad(PETSC_COMM_WORLD, file, &scene));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, scene->nbodies, scene->bodies, 0, &dm));
  PetscCall(MeshCheckScene(dm, scene));
  PetscCall(DMDestroy(&dm));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(0);
}

/* Loads and says what came of it */
static PetscErrorCode TryScene(const char name[], const char file[])
{
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(AttemptBegin());
  ierr = LoadAndMesh(file);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks(name, ierr));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", name, ierr ? attempt_sentence : "loads"));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(TryScene("no such file", "nowhere.yaml"));
  PetscCall(TryScene("a folder", "."));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(mistakes); ++i) {
    PetscCall(WriteScene("scene.yaml", &mistakes[i]));
    PetscCall(TryScene(mistakes[i].name, "scene.yaml"));
  }
  PetscCall(WriteScene("scene.yaml", &mistakes[0]));
  PetscCall(PetscOptionsSetValue(NULL, "-refine", "-1"));
  PetscCall(TryScene("refine -1 on the command line", "scene.yaml"));
  PetscCall(PetscOptionsClearValue(NULL, "-refine"));
  PetscCall(PetscOptionsSetValue(NULL, "-load_steps", "0"));
  PetscCall(TryScene("load_steps 0 on the command line", "scene.yaml"));
  PetscCall(PetscOptionsClearValue(NULL, "-load_steps"));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

  test:
    suffix: 1
    nsize: {{1 3}}
    args: -malloc_dump 0
    output_file: output/scene_errors_1.out

TEST*/
