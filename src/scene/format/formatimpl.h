/*
   The format of scene files: text to keys, keys to values. Nothing here knows what a scene is made of.
*/
#ifndef FORMATIMPL_H
#define FORMATIMPL_H

#include <model.h>
#include <rankerror.h>

/* yaml.c. Not collective: an error if the text is no YAML that PETSc can read */
PETSC_INTERN PetscErrorCode SceneCheckYAML(size_t length, const char text[]);

/* keys.c: the keys and values of a scene file. Every reader asks for a full key (nested keys joined with _); what
   nobody asked for is misspelt. A bad or missing value is stored, not raised, because a misspelt key explains it
   better. */
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

#endif
