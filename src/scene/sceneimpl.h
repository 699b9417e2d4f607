#ifndef SCENEIMPL_H
#define SCENEIMPL_H

#include <scene.h>

/*
   The keys and values of a scene file. Every reader asks by full key (nested keys joined with _), so that what is left
   over is misspelt. A bad or missing value is kept, not raised: a misspelt key is the better explanation of it.
*/
typedef struct {
  MPI_Comm     comm;
  const char  *file;
  PetscOptions options;
  PetscInt     nasked, maxasked;
  char       **asked;
  char         complaint[1024]; /* the first; empty if none */
} *SceneKeys;

#define SCENE_KEY_LENGTH 256
#define SCENE_LOAD_RAMP  "load" /* ramp 0: the load itself */
#define SCENE_MAX_STEPS  1000000

/* Not collective: what is wrong with a YAML file, in a sentence of so many characters, or "" */
PETSC_INTERN PetscErrorCode SceneCheckYAML(const char file[], size_t length, char sentence[]);

PETSC_INTERN PetscErrorCode SceneKeysCreate(MPI_Comm, const char file[], SceneKeys *);
PETSC_INTERN PetscErrorCode SceneKeysGet(SceneKeys, PetscBool required, const char **value, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(4, 5);
PETSC_INTERN PetscErrorCode SceneKeysComplain(SceneKeys, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
PETSC_INTERN PetscErrorCode SceneKeysCheck(SceneKeys);
PETSC_INTERN PetscErrorCode SceneKeysDestroy(SceneKeys *);

/* Values; key is for the complaint. A list has exactly n entries, or any number where *n is PETSC_DECIDE on entry */
PETSC_INTERN PetscErrorCode SceneParseReal(SceneKeys, const char key[], const char text[], PetscReal *);
PETSC_INTERN PetscErrorCode SceneParseInt(SceneKeys, const char key[], const char text[], PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseEnum(SceneKeys, const char key[], const char text[], const char *const names[], PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseList(SceneKeys, const char key[], const char text[], PetscInt *n, char ***words);
PETSC_INTERN PetscErrorCode SceneParseReals(SceneKeys, const char key[], const char text[], PetscInt n, PetscReal[]);
PETSC_INTERN PetscErrorCode SceneParseInts(SceneKeys, const char key[], const char text[], PetscInt n, PetscInt[]);
PETSC_INTERN PetscBool      SceneIsName(const char[]);
PETSC_INTERN PetscErrorCode SceneGetNames(SceneKeys, const char key[], PetscBool required, PetscInt *n, char ***names);

PETSC_INTERN PetscErrorCode SceneReadBodies(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadDisplacements(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadSymmetry(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadPressures(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadBodyForces(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadContact(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadRamps(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadRampName(SceneKeys, Scene, const char list[], const char name[], PetscInt *ramp);
PETSC_INTERN PetscErrorCode SceneResample(Scene, PetscInt nsteps);
PETSC_INTERN PetscErrorCode SceneReadSolver(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneSetOptions(Scene);
PETSC_INTERN PetscErrorCode SceneDestroyOptions(Scene);

/* Shape, level 0 and mesh file of a body, and how they are shown; a body's parts of faces */
PETSC_INTERN PetscErrorCode SceneReadShape(SceneKeys, SceneBody *);
PETSC_INTERN PetscErrorCode SceneViewShape(const SceneBody *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDestroyShape(SceneBody *);
PETSC_INTERN PetscErrorCode SceneReadFaces(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneViewFaces(Scene, PetscViewer);
/* name: [values], and one value, every number such that it reads back the same */
PETSC_INTERN PetscErrorCode SceneViewReals(PetscViewer, const char name[], PetscInt n, const PetscReal[]);
PETSC_INTERN PetscErrorCode SceneViewReal(PetscViewer, PetscReal);

/* Collective; what and owner name the thing that refers to the face, as in: displacement "bottom" */
PETSC_INTERN PetscErrorCode SceneValidateFace(MPI_Comm, const char file[], Scene, const char what[], const char owner[], const char name[]);
PETSC_INTERN PetscErrorCode SceneValidate(MPI_Comm, const char file[], Scene);

#endif
