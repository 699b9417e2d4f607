/* Constraints: everything that eliminates unknowns, such as prescribed displacements, symmetry planes, ties, hanging
   vertices and rigid bodies. The files are in the order in which they depend on each other. */
#ifndef CONSTRAINTSIMPL_H
#define CONSTRAINTSIMPL_H

#include "src/loads/loadsimpl.h"
#include "src/report/reportimpl.h"

/* motions.c: rigid motions of faces and bodies for given factors of the ramps. If several displacements of the scene
   apply to one face or body, the first of them represents all; it is called the leader. */
typedef struct {
  PetscReal t[3], center[3]; /* translation, and centre of rotation [length] */
  PetscReal turn[3][3];      /* rotation matrix minus the identity */
} RigidMotion;

PETSC_INTERN PetscInt  MotionFindLeader(Scene, PetscInt displacement);
PETSC_INTERN void      MotionGet(Scene, PetscInt leader, const PetscReal factor[], RigidMotion *);
PETSC_INTERN PetscReal MotionDisplace(const RigidMotion *, const PetscScalar x[3], PetscInt component);

/* poses.c: the rigid motion that is nearest to the motion of a body */
typedef struct {
  PetscReal from[3], to[3]; /* mean positions of the nodes before and after [length] */
  PetscReal Q[3][3];        /* rotation matrix */
} BodyPose;

PETSC_INTERN void             PoseGetVector(const PetscReal Q[3][3], PetscReal r[3]);
PETSC_INTERN const PetscReal *PoseFindCenter(Scene, PetscInt body);
PETSC_INTERN void             PosePlace(const BodyPose *, const PetscReal x0[3], PetscReal x1[3]);
PETSC_INTERN PetscErrorCode   PosesFind(const Bodies *, Vec u0, Vec u1, BodyPose poses[]);

/* arcs.c: increments of displacement along arcs */
PETSC_INTERN PetscErrorCode ArcsGetExcess(const Bodies *, Vec u0, Vec u1, Vec excess, PetscBool *any);
PETSC_INTERN PetscErrorCode ArcsGetIncrements(const Bodies *, Vec u0, Vec u1, Vec increment[2]);

/* prescribed.c: the prescribed displacements of the whole scene. The global rows that this rank owns are in ascending
   order. */
typedef struct {
  PetscReal value;  /* displacement at factor 1 [length]; for a row of a rigid motion 1 if the motion is not zero,
                      else 0 */
  PetscInt  ramp;   /* number of the ramp; 0 for rigid motions */
  PetscInt  motion; /* leader of the rigid motion; PETSC_DECIDE if the row belongs to none */
  PetscInt  entry;  /* number of the displacement in the scene */
} PrescribedValue;

typedef struct {
  Scene            scene;
  Vec              x; /* undeformed coordinates of the nodes, owned by the caller [length] */
  PetscInt         n; /* number of prescribed rows of this rank */
  PetscInt        *rows;
  PrescribedValue *values;
} Prescribed;

PETSC_INTERN PetscErrorCode PrescribedCreate(DM, Scene, const VertexPlaces *, Prescribed *);
PETSC_INTERN PetscErrorCode PrescribedApply(const Prescribed *, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode RowsSet(PetscInt n, const PetscInt rows[], PetscReal value, Vec);
PETSC_INTERN PetscErrorCode PrescribedSet(const Prescribed *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode PrescribedSum(const Prescribed *, Vec, PetscReal sum[3]);
PETSC_INTERN PetscErrorCode PrescribedDestroy(Prescribed *);

/*
   rigid.c: a rigid body some of whose motions are free. Free rotations are finite. The positions of its nodes are x =
   place + exp(angle) last (X - center). They are linearized about `place` and `angle`, which is counted from the last
   state.
*/
typedef struct {
  PetscInt  leader; /* number of the displacement of the scene */
  PetscInt  body;   /* number of the body in the scene */
  PetscBool turns;  /* whether free rotations are finite; they are not if a body of small strain is tied to this one */
  PetscReal place[3];      /* position of the centre [length] */
  PetscReal angle[3];      /* rotation vector since the last state [rad] */
  PetscReal last[3][3];    /* rotation matrix at the last state */
  PetscReal axis[3][3];    /* the rotation axes that belong to a change of each component of `angle`, by columns */
  PetscInt  n, motion[6];  /* number of free motions, and their numbers: 0 to 2 are translations along the axes, 3 to
                             5 rotations about them */
  PetscInt  row[6];        /* global rows whose displacements determine the free motions (carrying rows) */
  PetscReal inverse[6][6]; /* the free motions as functions of the displacements of the carrying rows; rotations are
                              multiplied by `size` */
  PetscReal size;          /* largest distance of a node from the centre along an axis [length] */
} RigidBody;

typedef struct {
  PetscInt   n;
  RigidBody *bodies;
  PetscBool  turns; /* whether any body has finite free rotations */
  Vec        x; /* positions about which the bodies are linearized; undeformed positions for elastic bodies [length] */
  Mat        R; /* displacements of dependent rows as functions of the carrying rows; NULL if no motion is free */
  Vec        elastic;   /* 0 in the rows of these bodies, else 1 */
  Vec        given;     /* displacements of these bodies' rows due to prescribed motions, with 0 in rows that are
                       prescribed themselves [length] */
  Vec        restraint; /* stiffness of the carrying rows for the proximal term (proximal.c), else 0 [force/length] */
} RigidBodies;

/* ties.c: displacements of dependent rows as functions of the others. C is NULL if there are no dependent rows. */
typedef struct {
  Mat      C, K;    /* C: u = C x + o; K: stiffness of the bodies, where the stiffness of the simulation is C^T K C */
  Mat      hanging; /* the part of C for hanging vertices; NULL if there are none */
  Mat      joined;  /* the part of C other than rigid bodies if some of these have free motions: C = joined R; NULL if
                      there is no such part (C = R), or if no rigid body has free motions */
  Mat      elastic; /* C with zero rows for rigid bodies, which have no stiffness; NULL if there are no such bodies */
  Vec      o;       /* displacement due to prescribed motions of rigid bodies and to equations [length]; NULL: zero */
  PetscInt nramps;
  Vec     *given;    /* [nramps] displacements due to the values of equations at factor 1 [length]; NULL: none */
  PetscInt n, *rows; /* number and global rows of the dependent rows of this rank */
  Vec      work;
} Ties;

/* The arguments of most functions in this folder: the bodies, and their constraints */
typedef struct {
  Bodies         bodies;
  Prescribed    *prescribed;
  const Springs *springs;
  RigidBodies   *rigid;
  Ties          *ties;
  const Mat     *follows; /* derivative of follower loads [force/length]; points to NULL if there are none */
} Constraints;

/* cyclic.c: cyclic symmetry */
PETSC_INTERN PetscErrorCode CyclicCreate(const Constraints *, const PetscBool prescribed[], Mat *Y,
  PetscBool follows[]);
PETSC_INTERN PetscErrorCode CyclicGetAxisNodes(const Constraints *, const SceneCyclic *, PetscInt *n, PetscInt **nodes,
  PetscReal normals[2][3]);

/* planes.c: inclined symmetry planes */
PETSC_INTERN PetscErrorCode PlanesCreate(const Constraints *, const PetscBool prescribed[], Mat *C,
  PetscBool follows[]);

/* rigid.c: rigid bodies with free motions */
PETSC_INTERN PetscErrorCode RigidGetNodes(const Constraints *, const RigidBody *, IS *nodes);
PETSC_INTERN PetscErrorCode RigidCreate(const Constraints *, const PetscBool prescribed[], PetscBool follows[]);
PETSC_INTERN PetscErrorCode RigidMakeRows(const Constraints *, const PetscBool prescribed[], PetscBool follows[],
  PetscBool *anew);
PETSC_INTERN PetscErrorCode RigidMove(const Constraints *, PetscReal time, Vec o);
PETSC_INTERN PetscErrorCode RigidAddStiffness(const Constraints *, Mat C, Vec diagonal, Mat stiffness);
PETSC_INTERN PetscErrorCode RigidDestroy(RigidBodies *);

/* rigid_turn.c: their finite rotations */
PETSC_INTERN void           RigidGetRotation(const RigidBody *, PetscReal Q[3][3]);
PETSC_INTERN PetscErrorCode RigidTurn(const Constraints *, PetscReal time, Vec u_last, Vec u);
PETSC_INTERN PetscErrorCode RigidStraighten(const Constraints *, Vec u, PetscReal *change);
PETSC_INTERN PetscErrorCode RigidTest(const Constraints *, PetscBool finite, Vec u, StepReport *);

/* rigid_loads.c: forces and moments on such bodies */
PETSC_INTERN PetscErrorCode RigidTurnLoads(const Constraints *, PetscReal sign, PetscReal time, Vec load);

/* joints.c: ties between faces */
PETSC_INTERN PetscErrorCode JointsExpand(const Constraints *, Mat all, const PetscInt tied[],
  const PetscBool prescribed[], Mat *C, PetscBool follows[]);
PETSC_INTERN PetscErrorCode JointsCreate(const Constraints *, const PetscBool prescribed[], Mat *C,
  PetscBool follows[]);

/* equations.c: linear equations between displacements */
PETSC_INTERN PetscErrorCode EquationsCreate(const Constraints *, Mat D, const PetscBool prescribed[], Mat *C,
  Vec given[], PetscBool follows[]);

/* ties.c: all dependent displacements together */
PETSC_INTERN PetscErrorCode TiesCreate(const Constraints *);
PETSC_INTERN PetscErrorCode TiesTurn(const Constraints *, PetscReal time, Vec u_last, Vec u, PetscBool *anew);
PETSC_INTERN PetscErrorCode TiesStraighten(const Constraints *, PetscReal time, Vec u, PetscReal *change);
PETSC_INTERN PetscErrorCode TiesCreateTangent(const Constraints *, Mat *);
PETSC_INTERN PetscErrorCode TiesMultiply(Mat C, Mat K, Mat *tied);
PETSC_INTERN PetscErrorCode TiesTangent(const Constraints *, Vec u, Mat);
PETSC_INTERN PetscErrorCode TiesFollow(const Ties *, Vec u);
PETSC_INTERN PetscErrorCode TiesGather(const Ties *, Vec force);
PETSC_INTERN PetscErrorCode TiesSet(const Ties *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode TiesGetForces(const Constraints *, Vec force, Vec *ties, Vec *rigid);
PETSC_INTERN PetscErrorCode TiesDestroy(Ties *);

/* face_forces.c: how the reaction at a node is divided among the faces of the node */
PETSC_INTERN PetscErrorCode FaceForcesDivide(const Constraints *, Vec reaction, Vec ties, Vec *m);

#endif
