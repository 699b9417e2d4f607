/*
   The sections of a scene file: each reads, views and describes one.
*/
#ifndef SECTIONSIMPL_H
#define SECTIONSIMPL_H

#include "src/scene/format/formatimpl.h"

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

#endif
