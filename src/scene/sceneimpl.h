/*
   Scene, private: the map of src/scene. From the file's keys to the scene, every file builds on those before it.
*/
#ifndef SCENEIMPL_H
#define SCENEIMPL_H

#include <scene.h>
#include <rankerror.h>

/* formulation.c: the names that formulation.h declares */

/* yaml.c. Not collective: an error if the text is no YAML that PETSc can read */
PETSC_INTERN PetscErrorCode SceneCheckYAML(size_t length, const char text[]);

/*
   keys.c: the keys and values of a scene file. Every reader asks by full key (nested keys joined with _), so that
   what is left over is misspelt. A bad or missing value is kept, not raised: a misspelt key is the better explanation
   of it.
*/
typedef struct {
  char    *name;
  Material material;
} SceneMaterial;

typedef struct {
  MPI_Comm     comm;
  const char  *file;
  PetscOptions options;
  PetscInt     nasked, maxasked;
  char       **asked;
  char         complaint[1024]; /* the first; empty if none */

  PetscInt       nmaterials; /* that have names, once they are read */
  SceneMaterial *materials;
} * SceneKeys;

#define SCENE_KEY_LENGTH 256

PETSC_INTERN PetscErrorCode SceneKeysCreate(MPI_Comm, const char file[], SceneKeys *);
PETSC_INTERN PetscErrorCode SceneKeysGet(SceneKeys, PetscBool required, const char **value, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
PETSC_INTERN PetscErrorCode SceneKeysComplain(SceneKeys, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
PETSC_INTERN PetscErrorCode SceneKeysCheck(SceneKeys);
PETSC_INTERN PetscErrorCode SceneKeysDestroy(SceneKeys *);

/* parse.c: values; key is for the complaint. A list has exactly n entries, or any number where *n is PETSC_DECIDE on
   entry */
PETSC_INTERN PetscErrorCode SceneParseReal(SceneKeys, const char key[], const char text[], PetscReal *);
PETSC_INTERN PetscErrorCode SceneParseInt(SceneKeys, const char key[], const char text[], PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseEnum(SceneKeys, const char key[], const char text[], const char *const names[],
  PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseAnswer(SceneKeys, const char key[], const char text[], PetscBool *);
PETSC_INTERN PetscErrorCode SceneParseList(SceneKeys, const char key[], const char text[], PetscInt *n, char ***words);
PETSC_INTERN PetscErrorCode SceneParseReals(SceneKeys, const char key[], const char text[], PetscInt n, PetscReal[]);
PETSC_INTERN PetscErrorCode SceneParseInts(SceneKeys, const char key[], const char text[], PetscInt n, PetscInt[]);
PETSC_INTERN PetscBool      SceneIsName(const char[]);
PETSC_INTERN PetscErrorCode SceneGetNames(SceneKeys, const char key[], PetscBool required, PetscInt *n, char ***names);

/* numbers.c: a number such that it reads back the same; [values]; name: [values] */
PETSC_INTERN PetscErrorCode SceneViewReal(PetscViewer, PetscReal);
PETSC_INTERN PetscErrorCode SceneViewList(PetscViewer, PetscInt n, const PetscReal[]);
PETSC_INTERN PetscErrorCode SceneViewReals(PetscViewer, const char name[], PetscInt n, const PetscReal[]);

/* expression.c: a number that follows time; whether one that follows the place, which SceneEvaluatePlace() evaluates,
   makes sense */
PETSC_INTERN PetscErrorCode SceneEvaluate(SceneKeys, const char key[], const char text[], PetscReal time,
  PetscInt nsteps, PetscReal *);
PETSC_INTERN PetscErrorCode SceneCheckExpression(SceneKeys, const char key[], const char text[]);

/* table.c: factors at the ends of load steps, from an expression or a table of times and values; found: there is one
   or the other below the key */
PETSC_INTERN PetscErrorCode SceneReadProgram(SceneKeys, const char key[], PetscInt nsteps, PetscReal factor[],
  PetscBool *found);

/* ramps.c: the load and the other ramps; which one follows a list's entry; all of them in another number of steps */
#define SCENE_LOAD_RAMP "load" /* ramp 0: the load itself */
#define SCENE_MAX_STEPS 1000000
PETSC_INTERN PetscErrorCode SceneReadRamps(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadRampName(SceneKeys, Scene, const char list[], const char name[], PetscInt *ramp);
PETSC_INTERN PetscErrorCode SceneResample(Scene, PetscInt nsteps);

/* shapes.c: shape, level 0 and mesh file of a body; a file's name, relative to the folder of the scene */
PETSC_INTERN PetscErrorCode SceneResolveFile(const char scene[], char **file);
PETSC_INTERN PetscErrorCode SceneReadShape(SceneKeys, SceneBody *);
PETSC_INTERN PetscErrorCode SceneViewShape(const SceneBody *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDestroyShape(SceneBody *);

/* constants.c: those of a material's law, below <owner>_: read, viewed, in words within a line, and checked */
PETSC_INTERN PetscErrorCode SceneReadConstants(SceneKeys, const char owner[], PetscBool listed, Material *);
PETSC_INTERN PetscErrorCode SceneViewConstants(const Material *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDescribeConstants(const Material *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneValidateConstants(MPI_Comm, const char file[], const SceneBody *);

/* materials.c: units, materials by name; that of a body, and whether it is one of them rather than a law */
PETSC_INTERN PetscErrorCode SceneReadMaterials(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneFindMaterial(SceneKeys, const char key[], const char name[], PetscBool *listed,
  Material *);

/* bodies.c: the bodies; the one that an entry of a list names */
PETSC_INTERN PetscErrorCode SceneReadBodies(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadBodyName(SceneKeys, Scene, const char list[], const char name[], PetscInt *body);

/* faces.c: the body of a name <body>.<face>, PETSC_DECIDE if there is none, and the face; the faces cut out of others
 */
PETSC_INTERN PetscInt       SceneFindBody(Scene, const char name[], const char **face);
PETSC_INTERN PetscErrorCode SceneReadFaces(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneViewFaces(Scene, PetscViewer);
/* Collective; what and owner name the thing that refers to the face, as in: displacement "bottom" */
PETSC_INTERN PetscErrorCode SceneValidateFace(MPI_Comm, const char file[], Scene, const char what[], const char owner[],
  const char name[]);

/* point_displacements.c: displacements at points and along edges */
PETSC_INTERN PetscErrorCode SceneReadPoint(SceneKeys, Scene, PetscInt body, SceneDisplacement *);
PETSC_INTERN PetscErrorCode SceneViewPoint(Scene, PetscViewer, const SceneDisplacement *);

/* motions.c: rigid motions of faces and of rigid bodies */
PETSC_INTERN PetscBool      SceneRotates(const SceneDisplacement *);
PETSC_INTERN PetscBool      SceneTurnsFreely(const SceneDisplacement *);
PETSC_INTERN PetscBool      SceneIsWholeBody(const char face[]);
PETSC_INTERN PetscErrorCode SceneReadTarget(SceneKeys, Scene, SceneDisplacement *);
PETSC_INTERN PetscErrorCode SceneReadRotation(SceneKeys, SceneDisplacement *);
PETSC_INTERN PetscErrorCode SceneViewTarget(PetscViewer, const char face[]);
PETSC_INTERN PetscErrorCode SceneViewComponents(PetscViewer, const PetscReal value[3], const PetscBool free[3]);
PETSC_INTERN PetscErrorCode SceneViewMotion(PetscViewer, const SceneDisplacement *);
PETSC_INTERN PetscErrorCode SceneValidateMotions(MPI_Comm, const char file[], const SceneDisplacement *,
  const SceneDisplacement *);
PETSC_INTERN PetscErrorCode SceneValidateRigid(MPI_Comm, const char file[], Scene);

/* displacements.c */
PETSC_INTERN PetscErrorCode SceneReadDisplacements(SceneKeys, Scene);

/* symmetry.c: after bodies and displacements */
PETSC_INTERN PetscErrorCode SceneReadSymmetry(SceneKeys, Scene);

/* loads.c */
PETSC_INTERN PetscErrorCode SceneReadPressures(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadBodyForces(SceneKeys, Scene);

/* temperatures.c */
PETSC_INTERN PetscErrorCode SceneReadTemperatures(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneValidateTemperatures(MPI_Comm, const char file[], Scene);
PETSC_INTERN PetscErrorCode SceneViewTemperatures(Scene, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDestroyTemperatures(Scene);

/* tractions.c: dead loads on faces; what an entry of a list has of three numbers, and a face with a value */
PETSC_INTERN PetscErrorCode SceneReadTriple(SceneKeys, const char list[], const char name[], const char what[],
  PetscReal value[3], PetscBool *given);
PETSC_INTERN PetscErrorCode SceneReadOnFace(SceneKeys, const char list[], const char name[], char **face,
  PetscReal value[3]);
PETSC_INTERN PetscErrorCode SceneReadTractions(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneViewTractions(Scene, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDestroyTractions(Scene);

/* springs.c */
#define SCENE_WEAK_SPRINGS 1e-7 /* weak_springs: true */
PETSC_INTERN PetscErrorCode SceneReadSprings(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneValidateSprings(MPI_Comm, const char file[], Scene);
PETSC_INTERN PetscErrorCode SceneViewSprings(Scene, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDestroySprings(Scene);

/* contact.c */
PETSC_INTERN PetscErrorCode SceneReadContact(SceneKeys, Scene);

/* ties.c */
PETSC_INTERN PetscErrorCode SceneReadTies(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneViewTie(Scene, PetscViewer, PetscInt tie);
PETSC_INTERN PetscErrorCode SceneValidateTies(MPI_Comm, const char file[], Scene);
PETSC_INTERN PetscErrorCode SceneDestroyTies(Scene);

/* refinements.c */
PETSC_INTERN PetscErrorCode SceneReadRefinements(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneViewRefinement(Scene, PetscViewer, PetscInt refinement);
PETSC_INTERN PetscErrorCode SceneValidateRefinements(MPI_Comm, const char file[], Scene);
PETSC_INTERN PetscErrorCode SceneDestroyRefinements(Scene);

/* probes.c */
PETSC_INTERN PetscErrorCode SceneReadProbes(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneViewProbe(Scene, PetscViewer, PetscInt probe);
PETSC_INTERN PetscErrorCode SceneDestroyProbes(Scene);

/* solver.c: the scene's PETSc options, in the options database while it lives */
PETSC_INTERN PetscErrorCode SceneReadSolver(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneSetOptions(Scene);
PETSC_INTERN PetscErrorCode SceneDestroyOptions(Scene);

/* validate.c. Collective: what a scene must satisfy beyond its grammar */
PETSC_INTERN PetscErrorCode SceneValidate(MPI_Comm, const char file[], Scene);

/* view.c, describe.c, scene.c: what a scene says, what it will simulate, and its life, public */

#endif
