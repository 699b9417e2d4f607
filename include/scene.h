/*
   A scene: what is to be simulated, as plain data. src/scene reads it from a YAML options file and validates it;
   nothing else knows the file format. Lengths, forces and pressures are in any consistent set of units.
*/
#ifndef SCENE_H
#define SCENE_H

#include <petscsys.h>
#include <material.h>

typedef enum {
  SHAPE_BOX
} BodyShape;
PETSC_EXTERN const char *const BodyShapes[];

typedef struct {
  char     *name;
  BodyShape shape;
  PetscReal lower[3], upper[3]; /* box corners [length] */
  PetscInt  cells[3];           /* hexahedra along each axis at refinement level 0 */
  Material  material;
} SceneBody;

typedef struct {
  char     *name;
  char     *face;     /* "<body>.<face>", the name of a facet label of the mesh */
  PetscBool fixed[3]; /* which components are prescribed */
  PetscReal value[3]; /* prescribed displacement at load factor 1 [length] */
} SceneDisplacement;

typedef struct {
  char *name;
  char *mortar;    /* "<body>.<face>" */
  char *nonmortar; /* "<body>.<face>": carries the constraints */
} SceneContactPair;

typedef struct {
  char              *name;
  PetscInt           nbodies;
  SceneBody         *bodies;
  PetscInt           ndisplacements;
  SceneDisplacement *displacements;
  PetscInt           npairs;
  SceneContactPair  *pairs;
  PetscInt           nsteps;     /* load steps, at least 1 */
  PetscReal         *load;       /* load factor at the end of each step, nsteps values */
  PetscInt           refine;     /* uniform refinements of level 0 */
} *Scene;

PETSC_EXTERN PetscErrorCode SceneLoad(MPI_Comm, const char file[], Scene *);
PETSC_EXTERN PetscErrorCode SceneView(Scene, PetscViewer);
PETSC_EXTERN PetscErrorCode SceneDestroy(Scene *);

#endif
