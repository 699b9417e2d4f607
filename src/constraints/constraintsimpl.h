/*
   Constraints, i.e. everything that eliminates unknowns: prescribed displacements, symmetry planes, ties, hanging
   nodes, rigid bodies. Files are in the order in which they depend on each other.
*/
#ifndef CONSTRAINTSIMPL_H
#define CONSTRAINTSIMPL_H

#include "src/loads/loadsimpl.h"
#include "src/report/reportimpl.h"

/* motions.c: rigid motions of faces and bodies at given factors of the ramps. The scene's first displacement of a
   face or body is its leader */
typedef struct {
  PetscReal t[3], center[3]; /* [length] */
  PetscReal turn[3][3];      /* rotation matrix minus identity */
} RigidMotion;

PETSC_INTERN PetscInt  MotionFindLeader(Scene, PetscInt displacement);
PETSC_INTERN void      MotionGet(Scene, PetscInt leader, const PetscReal factor[], RigidMotion *);
PETSC_INTERN PetscReal MotionDisplace(const RigidMotion *, const PetscScalar x[3], PetscInt component);

/* prescribed.c: prescribed displacements of the whole scene: owned global rows, ascending, their values at factor 1,
   and their ramps */
typedef struct {
  PetscReal value;  /* displacement at factor 1 [length]; for rigid motions 1 if the row is driven, else 0 */
  PetscInt  ramp;   /* for rigid motions 0 */
  PetscInt  motion; /* leading displacement of the rigid motion; PETSC_DECIDE: none */
} PrescribedValue;

typedef struct {
  Scene            scene;
  Vec              x; /* coordinates of the nodes, borrowed */
  PetscInt         n;
  PetscInt        *rows;
  PrescribedValue *values;
} Prescribed;

PETSC_INTERN PetscErrorCode PrescribedCreate(DM, Scene, const VertexPlaces *, Prescribed *);
PETSC_INTERN PetscErrorCode PrescribedApply(const Prescribed *, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode PrescribedSet(const Prescribed *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode PrescribedSum(const Prescribed *, Vec, PetscReal sum[3]);
PETSC_INTERN PetscErrorCode PrescribedDestroy(Prescribed *);

/* rigid.c: a rigid body with free motions */
typedef struct {
  PetscInt  leader;        /* number of its displacement in the scene */
  PetscInt  n, motion[6];  /* free motions: translations along, and rotations about, the axes */
  PetscInt  row[6];        /* global rows whose displacements carry the motions */
  PetscReal inverse[6][6]; /* motions in terms of the displacements of these rows; rotations are angle x body size */
  PetscReal size;          /* [length] */
} RigidBody;

typedef struct {
  PetscInt   n;
  RigidBody *bodies;
  Mat        R;       /* displacements of dependent rows in terms of the carrying rows; NULL: no motion is free */
  Vec        elastic; /* 0 in the rows of these bodies, 1 elsewhere */
  Vec        given;   /* displacement of their rows by prescribed motions, except in rows that are prescribed themselves
                [length] */
  Vec        held;    /* stiffness of the carrying rows for the proximal term (proximal.c), else 0 [force/length] */
} RigidBodies;

/* ties.c: displacements of dependent rows in terms of the others; C NULL: no dependent rows */
typedef struct {
  Mat      C, K;    /* C: u = C x + o; K: stiffness of the bodies, while the simulation's is C^T K C */
  Mat      hanging; /* the part of C for hanging vertices; NULL: none */
  Mat      joined;  /* C = joined R if forces drive rigid bodies; NULL: C = R */
  Mat      elastic; /* C without the rows of such bodies, which have no stiffness; NULL: no such bodies */
  Vec      o;       /* o [length]; NULL: 0 */
  PetscInt n, *rows;
  Vec      work;
} Ties;

/* Arguments of the functions from here on: the bodies, and their constraints */
typedef struct {
  Bodies         bodies;
  Prescribed    *prescribed;
  const Springs *springs;
  RigidBodies   *rigid;
  Ties          *ties;
  const Mat     *follows; /* derivative of follower loads; points to NULL: none [force/length] */
} Constraints;

/* planes.c */
PETSC_INTERN PetscErrorCode PlanesCreate(const Constraints *, const PetscBool prescribed[], Mat *C,
  PetscBool follows[]);

/* rigid.c */
PETSC_INTERN PetscErrorCode RigidCreate(const Constraints *, const PetscBool prescribed[], PetscBool follows[]);
PETSC_INTERN PetscErrorCode RigidMove(const Constraints *, PetscReal time, Vec o);
PETSC_INTERN PetscErrorCode RigidAddStiffness(const Constraints *, Mat C, Vec diagonal, Mat stiffness);
PETSC_INTERN PetscErrorCode RigidTest(const Constraints *, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode RigidDestroy(RigidBodies *);

/* joints.c */
PETSC_INTERN PetscErrorCode JointsExpand(const Constraints *, Mat all, const PetscInt tied[],
  const PetscBool prescribed[], Mat *C, PetscBool follows[]);
PETSC_INTERN PetscErrorCode JointsCreate(const Constraints *, const PetscBool prescribed[], Mat *C,
  PetscBool follows[]);

/* ties.c */
PETSC_INTERN PetscErrorCode TiesCreate(const Constraints *);
PETSC_INTERN PetscErrorCode TiesMove(const Constraints *, PetscReal time);
PETSC_INTERN PetscErrorCode TiesCreateTangent(const Constraints *, Mat *);
PETSC_INTERN PetscErrorCode TiesTangent(const Constraints *, Vec u, Mat);
PETSC_INTERN PetscErrorCode TiesFollow(const Ties *, Vec u);
PETSC_INTERN PetscErrorCode TiesGather(const Ties *, Vec force);
PETSC_INTERN PetscErrorCode TiesSet(const Ties *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode TiesGetForces(const Constraints *, Vec force, Vec *ties, Vec *rigid);
PETSC_INTERN PetscErrorCode TiesMeasure(const Constraints *, Vec forces, PetscReal bodies[]);
PETSC_INTERN PetscErrorCode TiesDestroy(Ties *);

#endif
