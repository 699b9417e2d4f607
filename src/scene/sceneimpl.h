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
PETSC_INTERN PetscErrorCode SceneGetNames(SceneKeys, const char key[], PetscBool required, PetscInt *n, char ***names);

PETSC_INTERN PetscErrorCode SceneReadBodies(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadDisplacements(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadContact(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneReadLoad(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneSetUniformLoad(Scene, PetscInt nsteps);

/* A face of a box: the side of one axis */
typedef struct {
  PetscInt body;
  PetscInt axis;  /* 0, 1, 2 */
  PetscInt upper; /* 0 at lower[axis], 1 at upper[axis] */
} SceneFace;

/* found is false when the body, or the face of it, does not exist; body is PETSC_DECIDE in the first case */
PETSC_INTERN PetscErrorCode SceneFindFace(Scene, const char name[], SceneFace *, PetscBool *found);
PETSC_INTERN PetscErrorCode SceneFaceCorners(Scene, SceneFace, PetscReal corners[4][3]);

PETSC_INTERN PetscErrorCode SceneValidate(MPI_Comm, const char file[], Scene);
PETSC_INTERN PetscErrorCode SceneCheckSupport(MPI_Comm, const char file[], Scene);

#endif
