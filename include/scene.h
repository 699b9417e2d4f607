/*
   A scene: what is to be simulated, as plain data. src/scene reads it from a YAML options file and validates it;
   nothing else knows the file format. Lengths, forces and pressures are in any consistent set of units.
*/
#ifndef SCENE_H
#define SCENE_H

#include <petscsys.h>
#include <material.h>
#include <formulation.h>

typedef enum {
  SHAPE_BOX
} BodyShape;
PETSC_EXTERN const char *const BodyShapes[];

typedef struct {
  char       *name;
  BodyShape   shape;
  PetscReal   lower[3], upper[3]; /* box corners [length] */
  PetscInt    cells[3];           /* hexahedra along each axis at refinement level 0 */
  Material    material;
  ElementType element;
} SceneBody;

/* A load program: the factor at the end of each load step, linear in between, 0 before the first */
typedef struct {
  char      *name;
  PetscReal *factor; /* nsteps values */
} SceneRamp;

typedef struct {
  char     *name;
  char     *face;     /* "<body>.<face>", the name of a facet label of the mesh */
  PetscBool fixed[3]; /* which components are prescribed */
  PetscReal value[3]; /* prescribed displacement at factor 1 [length] */
  PetscInt  ramp;
} SceneDisplacement;

/* Dead load: -value x normal of the reference face */
typedef struct {
  char     *name;
  char     *face;
  PetscReal value; /* at factor 1, positive pushes on the body [force/length^2] */
  PetscInt  ramp;
} ScenePressure;

typedef struct {
  char     *name;
  PetscInt  body;     /* index, or PETSC_DECIDE: every body */
  PetscReal value[3]; /* at factor 1, per reference volume [force/length^3] */
  PetscInt  ramp;
} SceneBodyForce;

typedef struct {
  char     *name;
  char     *mortar;    /* "<body>.<face>" */
  char     *nonmortar; /* "<body>.<face>": carries the constraints */
  GapType   gap;
  PetscReal distance;  /* facets further apart never pair [length]; 0: chosen from the size of the faces */
} SceneContactPair;

typedef struct {
  char              *name;
  PetscInt           nbodies;
  SceneBody         *bodies;
  PetscInt           ndisplacements;
  SceneDisplacement *displacements;
  PetscInt           npressures;
  ScenePressure     *pressures;
  PetscInt           nforces;
  SceneBodyForce    *forces;
  PetscInt           npairs;
  SceneContactPair  *pairs;
  PetscInt           nsteps; /* load steps, at least 1 */
  PetscInt           nramps; /* at least 1: ramp 0 is the load itself, for whatever names no ramp */
  SceneRamp         *ramps;
  PetscInt           refine; /* uniform refinements of level 0 */
  StepModel          model;
  PetscInt           contact_updates;     /* linearizations of the gap a load step, at least 1 */
  PetscInt           displacement_bounds; /* first load step (from 1) bounded by the largest increment so far; 0: none */
} *Scene;

PETSC_EXTERN PetscErrorCode SceneLoad(MPI_Comm, const char file[], Scene *);
/* Factor of a ramp at a time: load step k ends at time k, from 1 */
PETSC_EXTERN PetscErrorCode SceneGetFactor(Scene, PetscInt ramp, PetscReal time, PetscReal *factor);
PETSC_EXTERN PetscErrorCode SceneView(Scene, PetscViewer);
PETSC_EXTERN PetscErrorCode SceneDestroy(Scene *);

#endif
