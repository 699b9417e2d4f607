/* Sections of a scene file. Each file of this folder reads, prints and describes one section. */
#ifndef SECTIONSIMPL_H
#define SECTIONSIMPL_H

#include "src/mesh/shapes/shapesimpl.h"
#include "src/scene/format/formatimpl.h"

/* Checks an entry of the scene. Every rank of `comm` has the same scene, so that every rank finds the same error */
#define SceneRequire(cond, entry, ...) SceneCheck(cond, comm, PETSC_ERR_USER_INPUT, entry, __VA_ARGS__)

/* keytable.c: all lists of keys, beginning with the top level */
PETSC_INTERN const SceneList  SceneLists[]; /* the first list is the top level; the last one has the name NULL */
PETSC_INTERN const SceneList *SceneFindList(const char name[]);

/* ramps.c: factors of the load and of the other ramps, and their resampling */
#define SCENE_LOAD_RAMP "load" /* name of ramp 0, the load itself */
#define SCENE_MAX_STEPS 1000000
PETSC_INTERN PetscErrorCode SceneReadRamps(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneResample(Scene, PetscInt nsteps);

/* dynamics.c: time steps, which are read before the ramps; and properties of bodies that time steps require */
PETSC_INTERN PetscErrorCode SceneReadDynamics(SceneKeys, Scene, const SceneList *);
PETSC_INTERN PetscErrorCode SceneFinishInertia(SceneKeys, Scene, const char owner[], const SceneBody *);

/* constants.c: constants of a material's law, with the keys <owner>_<constant> */
PETSC_INTERN PetscErrorCode SceneReadConstants(SceneKeys, const char owner[], PetscBool listed, Material *);
PETSC_INTERN PetscErrorCode SceneViewConstants(const Material *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneDescribeConstants(const Material *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneValidateConstants(MPI_Comm, const SceneBody *);

/* materials.c: named materials; SceneFindMaterial() finds the material of a body, and whether its name is in a list */
PETSC_INTERN PetscErrorCode SceneReadMaterials(SceneKeys, Scene, const SceneList *);
PETSC_INTERN PetscErrorCode SceneFinishMaterial(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneFindMaterial(SceneKeys, const char key[], const char name[], PetscBool *listed,
  Material *);

/* shapes.c: shape, mesh of level 0 and mesh file of a body */
PETSC_INTERN PetscErrorCode SceneReadShape(SceneKeys, const char owner[], SceneBody *);
PETSC_INTERN PetscErrorCode SceneViewShape(const SceneBody *, PetscViewer);
PETSC_INTERN PetscErrorCode SceneGetShapeKeys(const SceneBody *, const ShapeKey **);

/* bodies.c: shape, material and element of each body */
PETSC_INTERN PetscErrorCode SceneFinishBody(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneScaleRigid(Scene);
PETSC_INTERN PetscErrorCode SceneViewBodies(Scene, PetscViewer, const SceneList *);

/*
   faces.c: SceneFindBody() returns body and face of a name <body>.<face>, or PETSC_DECIDE if there is no such body; the
   other functions read and print the list of parts of faces
*/
PETSC_INTERN PetscInt       SceneFindBody(Scene, const char name[], const char **face);
PETSC_INTERN PetscErrorCode SceneReadFaces(SceneKeys, Scene, const SceneList *);
PETSC_INTERN PetscErrorCode SceneViewFaces(Scene, PetscViewer, const SceneList *);
/* Collective. what, owner: kind and struct of the entry that refers to the face, as in displacement "bottom" */
PETSC_INTERN PetscErrorCode SceneValidateFace(MPI_Comm, Scene, const char what[], const void *owner, const char name[]);

/* displacements.c: displacements of faces, at points and along edges, and rigid motions */
PETSC_INTERN const SceneOwn SceneOwnComponents, SceneOwnRotation;
PETSC_INTERN PetscBool      SceneRotates(const SceneDisplacement *);
PETSC_INTERN PetscBool      SceneTurnsFreely(const SceneDisplacement *);
PETSC_INTERN PetscBool      SceneIsWholeBody(const char face[]);
PETSC_INTERN PetscErrorCode SceneSetWholeBody(SceneKeys, Scene, const char owner[], const char why[], PetscInt body,
  char **face);
PETSC_INTERN PetscBool      SceneDisplacementIsPlane(const void *entry);
PETSC_INTERN PetscBool      SceneDisplacementIsListed(const void *entry);
PETSC_INTERN PetscBool      SceneDisplacementHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishDisplacement(SceneKeys, Scene, const char owner[], void *entry);

/* motions.c: checks of rigid motions */
PETSC_INTERN PetscErrorCode SceneJoinMotions(Scene);
PETSC_INTERN PetscErrorCode SceneValidateMotions(MPI_Comm, const SceneDisplacement *, const SceneDisplacement *);
PETSC_INTERN PetscErrorCode SceneValidateRigid(MPI_Comm, Scene);

/* symmetry.c: symmetry planes, which are read after bodies and displacements */
PETSC_INTERN PetscErrorCode SceneReadSymmetry(SceneKeys, Scene);

/* loads.c: forces, tractions and temperatures */
PETSC_INTERN PetscBool      SceneTractionIsForce(const void *entry);
PETSC_INTERN PetscBool      SceneTractionIsNone(const void *entry);
PETSC_INTERN PetscBool      SceneForceHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishForce(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneValidateTemperatures(MPI_Comm, Scene);

/* connectors.c: keys of connectors and equations that depend on one another */
PETSC_INTERN PetscBool      SceneConnectorHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishConnector(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscBool      SceneEquationHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishEquation(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneValidateEquations(MPI_Comm, Scene);

/* bolts.c: keys of bolts that depend on one another */
PETSC_INTERN PetscBool      SceneBoltHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishBolt(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneValidateBolts(MPI_Comm, Scene);

/* springs.c: springs and weak springs */
PETSC_INTERN const SceneOwn SceneOwnWeakSprings;
PETSC_INTERN PetscErrorCode SceneFinishSpring(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneValidateSprings(MPI_Comm, Scene);

/* contact.c, ties.c, refinements.c, probes.c: keys that are not single values */
PETSC_INTERN const SceneOwn SceneOwnInterference, SceneOwnStick, SceneOwnExcept, SceneOwnNear;
PETSC_INTERN PetscBool      ScenePairHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishPair(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneSplitRules(Scene);
PETSC_INTERN PetscErrorCode SceneViewPairs(Scene, PetscViewer, const SceneList *);
PETSC_INTERN PetscErrorCode SceneValidateRules(MPI_Comm, Scene);
PETSC_INTERN PetscErrorCode SceneValidateSelf(MPI_Comm, Scene, const SceneContactPair *);
PETSC_INTERN PetscErrorCode SceneValidateTies(MPI_Comm, Scene);
PETSC_INTERN PetscBool      SceneRefinementHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishRefinement(SceneKeys, Scene, const char owner[], void *entry);
PETSC_INTERN PetscErrorCode SceneValidateRefinements(MPI_Comm, Scene);
PETSC_INTERN PetscBool      SceneProbeHides(const void *entry, const char key[]);
PETSC_INTERN PetscErrorCode SceneFinishProbe(SceneKeys, Scene, const char owner[], void *entry);

/* solver.c: PETSc options of the scene, which are in the options database while the scene exists */
PETSC_INTERN PetscErrorCode SceneReadSolver(SceneKeys, Scene);
PETSC_INTERN PetscErrorCode SceneSetOptions(Scene);
PETSC_INTERN PetscErrorCode SceneDestroyOptions(Scene);

#endif
