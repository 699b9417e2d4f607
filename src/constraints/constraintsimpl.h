/*
   Constraints, i.e. everything that eliminates unknowns: prescribed displacements, symmetry planes, ties, hanging
   nodes, rigid bodies. Files are in the order in which they depend on each other.
*/
#ifndef CONSTRAINTSIMPL_H
#define CONSTRAINTSIMPL_H

#include "src/loads/loadsimpl.h"
#include "src/report/reportimpl.h"

/* motions.c: rigid motions of faces and bodies for given factors of the ramps. The leader of a face or body is the
   scene's first displacement for it */
typedef struct {
  PetscReal t[3], center[3]; /* [length] */
  PetscReal turn[3][3];      /* rotation matrix minus identity */
} RigidMotion;

PETSC_INTERN PetscInt  MotionFindLeader(Scene, PetscInt displacement);
PETSC_INTERN void      MotionGet(Scene, PetscInt leader, const PetscReal factor[], RigidMotion *);
PETSC_INTERN PetscReal MotionDisplace(const RigidMotion *, const PetscScalar x[3], PetscInt component);
PETSC_INTERN void      MotionRotate(const PetscReal r[3], PetscReal turn[3][3]);

/* poses.c: the rigid motion nearest to that of a body */
typedef struct {
  PetscReal from[3], to[3]; /* means of the places before and after [length] */
  PetscReal Q[3][3];        /* rotation */
} BodyPose;

PETSC_INTERN void             PoseGetVector(const PetscReal Q[3][3], PetscReal r[3]);
PETSC_INTERN const PetscReal *PoseFindCenter(Scene, PetscInt body);
PETSC_INTERN void             PosePlace(const BodyPose *, const PetscReal x0[3], PetscReal x1[3]);
PETSC_INTERN PetscErrorCode   PosesFind(const Bodies *, Vec u0, Vec u1, BodyPose poses[]);

/* arcs.c */
PETSC_INTERN PetscErrorCode ArcsGetExcess(const Bodies *, Vec u0, Vec u1, Vec excess, PetscBool *any);
PETSC_INTERN PetscErrorCode ArcsGetIncrements(const Bodies *, Vec u0, Vec u1, Vec increment[2]);

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

/* rigid.c: a rigid body with free motions. Free rotations are finite. The positions of its nodes are linearized about
   a place and an angle, which is counted from the last state: x = place + exp(angle) last (X - center) */
typedef struct {
  PetscInt  leader;        /* displacement of the scene */
  PetscInt  body;          /* of the scene */
  PetscBool turns;         /* free rotations are finite: no body of small strain is tied to it */
  PetscReal place[3];      /* of the center [length] */
  PetscReal angle[3];      /* rotation vector since the last state [rad] */
  PetscReal last[3][3];    /* rotation up to there */
  PetscReal axis[3][3];    /* derivative of the rotation by an angle about each axis */
  PetscInt  n, motion[6];  /* those that are free: along, and about, the axes */
  PetscInt  row[6];        /* global rows whose displacements carry them */
  PetscReal inverse[6][6]; /* the motions as functions of the displacements of these rows; angles times size */
  PetscReal size;          /* [length] */
} RigidBody;

typedef struct {
  PetscInt   n;
  RigidBody *bodies;
  PetscBool  turns;   /* any of them */
  Vec        x;       /* positions about which the bodies are linearized; undeformed for elastic bodies [length] */
  Mat        R;       /* displacements of the dependent rows as functions of the carrying rows; NULL: no motion is
                         free */
  Vec        elastic; /* 0 in the rows of these bodies, else 1 */
  Vec        given; /* displacements of the rows due to prescribed motions, except those that are prescribed row by row
                [length] */
  Vec        held;  /* stiffness of the carrying rows for the proximal term (proximal.c), else 0 [force/length] */
} RigidBodies;

/* ties.c: displacements of dependent rows in terms of the others; C NULL: no dependent rows */
typedef struct {
  Mat      C, K;    /* C: u = C x + o; K: stiffness of the bodies, while the simulation's is C^T K C */
  Mat      hanging; /* the part of C for hanging vertices; NULL: none */
  Mat      joined;  /* C = joined R if forces drive rigid bodies; NULL: C = R */
  Mat      elastic; /* C without the rows of rigid bodies, which have no stiffness; NULL: there are none */
  Vec      o;       /* o [length]; NULL: 0 */
  PetscInt n, *rows;
  Vec      work;
} Ties;

/* Arguments of the functions below: the bodies, and their constraints */
typedef struct {
  Bodies         bodies;
  Prescribed    *prescribed;
  const Springs *springs;
  RigidBodies   *rigid;
  Ties          *ties;
  const Mat     *follows; /* derivative of follower loads; points to NULL: none [force/length] */
} Constraints;

/* cyclic.c */
PETSC_INTERN PetscErrorCode CyclicCreate(const Constraints *, const PetscBool prescribed[], Mat *Y,
  PetscBool follows[]);
PETSC_INTERN PetscErrorCode CyclicGetAxisNodes(const Constraints *, const SceneCyclic *, PetscInt *n, PetscInt **nodes,
  PetscReal normals[2][3]);

/* planes.c */
PETSC_INTERN PetscErrorCode PlanesCreate(const Constraints *, const PetscBool prescribed[], Mat *C,
  PetscBool follows[]);

/* rigid.c */
PETSC_INTERN PetscErrorCode RigidCreate(const Constraints *, const PetscBool prescribed[], PetscBool follows[]);
PETSC_INTERN PetscErrorCode RigidMakeRows(const Constraints *, const PetscBool prescribed[], PetscBool follows[],
  PetscBool *anew);
PETSC_INTERN void           RigidGetRotation(const RigidBody *, PetscReal Q[3][3]);
PETSC_INTERN PetscErrorCode RigidTurn(const Constraints *, PetscReal time, Vec u_last, Vec u);
PETSC_INTERN PetscErrorCode RigidStraighten(const Constraints *, Vec u, PetscReal *change);
PETSC_INTERN PetscErrorCode RigidMove(const Constraints *, PetscReal time, Vec o);
PETSC_INTERN PetscErrorCode RigidAddStiffness(const Constraints *, Mat C, Vec diagonal, Mat stiffness);
PETSC_INTERN PetscErrorCode RigidTest(const Constraints *, PetscBool finite, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode RigidDestroy(RigidBodies *);

/* rigid_loads.c */
PETSC_INTERN PetscErrorCode RigidTurnLoads(const Constraints *, PetscReal sign, PetscReal time, Vec load);

/* joints.c */
PETSC_INTERN PetscErrorCode JointsExpand(const Constraints *, Mat all, const PetscInt tied[],
  const PetscBool prescribed[], Mat *C, PetscBool follows[]);
PETSC_INTERN PetscErrorCode JointsCreate(const Constraints *, const PetscBool prescribed[], Mat *C,
  PetscBool follows[]);

/* ties.c */
PETSC_INTERN PetscErrorCode TiesCreate(const Constraints *);
PETSC_INTERN PetscErrorCode TiesMove(const Constraints *, PetscReal time);
PETSC_INTERN PetscErrorCode TiesTurn(const Constraints *, PetscReal time, Vec u_last, Vec u, PetscBool *anew);
PETSC_INTERN PetscErrorCode TiesStraighten(const Constraints *, Vec u, PetscReal *change);
PETSC_INTERN PetscErrorCode TiesCreateTangent(const Constraints *, Mat *);
PETSC_INTERN PetscErrorCode TiesTangent(const Constraints *, Vec u, Mat);
PETSC_INTERN PetscErrorCode TiesFollow(const Ties *, Vec u);
PETSC_INTERN PetscErrorCode TiesGather(const Ties *, Vec force);
PETSC_INTERN PetscErrorCode TiesSet(const Ties *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode TiesGetForces(const Constraints *, Vec force, Vec *ties, Vec *rigid);
PETSC_INTERN PetscErrorCode TiesMeasure(const Constraints *, Vec forces, PetscReal bodies[]);
PETSC_INTERN PetscErrorCode TiesDestroy(Ties *);

#endif
