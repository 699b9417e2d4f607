/* Loads on the bodies: dead loads, temperatures, springs, pretension. The files are in the order in which they depend
   on each other. */
#ifndef LOADSIMPL_H
#define LOADSIMPL_H

#include <model.h>
#include <elasticity.h>
#include <contact.h>
#include "src/mesh/query/queryimpl.h"
#include <petsccompat.h>

/* The bodies and their discretization */
typedef struct {
  MPI_Comm     comm;
  Scene        scene;
  DM           dm;
  Elasticity   elasticity;
  VertexPlaces places;
  Vec          mass; /* lumped mass for unit density [length^3]; it also gives the layout of the unknowns */
} Bodies;

/* points.c: a point of a body, known on all ranks: number of nodes of its cell, their global numbers, and the values of
   their shape functions. BodyPointsLocate() is collective and passes over the mesh once; what, entry: named in
   messages. */
typedef struct {
  PetscInt  n, node[MESH_MAX_NODES];
  PetscReal N[MESH_MAX_NODES];
} BodyPoint;
PETSC_INTERN PetscErrorCode BodyPointsLocate(DM, Scene, const char what[], PetscInt n, const SceneEntry *const entry[],
  const PetscInt body[], const PetscReal x[][3], BodyPoint[]);

/* loads.c: dead loads at factor 1 of each ramp. A ramp without loads has NULL; force itself is NULL if there are no
   loads. */
typedef struct {
  Scene scene;
  Vec  *force; /* [nramps] load of each ramp [force] */
} DeadLoads;

PETSC_INTERN PetscErrorCode PressureAt(void *pressure, const PetscReal x[3], PetscReal *value);
PETSC_INTERN PetscErrorCode DeadLoadsCreate(Scene, DM, Elasticity, DeadLoads *);
PETSC_INTERN PetscErrorCode DeadLoadsGet(const DeadLoads *, PetscReal time, Vec *force);
PETSC_INTERN PetscErrorCode DeadLoadsDestroy(DeadLoads *);

/* temperatures.c: temperatures at factor 1 of each ramp, as linear functions in the cells */
typedef struct {
  MPI_Comm    comm;
  Scene       scene;
  Elasticity  elasticity; /* owned by the caller */
  PetscInt    n;          /* number of coefficients: 4 per cell of this rank */
  PetscReal **fits;       /* [nramps] coefficients of each ramp; NULL for a ramp without temperature */
  PetscReal  *now;        /* coefficients at the time that was applied last; NULL if there are no temperatures */
} Temperatures;

PETSC_INTERN PetscErrorCode TemperaturesCreate(Scene, Elasticity, MPI_Comm, Temperatures *);
PETSC_INTERN PetscErrorCode TemperaturesApply(Temperatures *, PetscReal time);
PETSC_INTERN PetscErrorCode TemperaturesGetLargest(const Temperatures *, PetscReal *size);
PETSC_INTERN PetscErrorCode TemperaturesDestroy(Temperatures *);

/* connectors.c: a spring and damper between points */
typedef struct {
  BodyPoint end[2];
  PetscReal k[3][3]; /* stiffness: derivative of the force with respect to the offset [force/length] */
  PetscReal d[3][3]; /* damping: derivative with respect to the rate of the offset [force time/length] */
} Connector;

/* springs.c: springs of the scene, and weak springs */
typedef struct {
  Vec        stiffness, weak; /* stiffness per row of all springs to the ground, and of the weak springs alone
                                 [force/length]; NULL if there are none */
  Mat        between; /* stiffness of springs between faces and of connectors [force/length]; NULL if there are none */
  Connector *connectors;   /* [connectors of the scene] */
  Mat        dampers;      /* damping matrix of connectors [force time/length]; NULL if there are no dampers */
  PetscReal  rate;         /* derivative of the velocity at the end of a time step with respect to the displacement, by
                            which tangents contain the dampers [1/time] */
  PetscInt   nweak;        /* number of bodies with weak springs */
  PetscReal  softness;     /* stiffness of the weak springs as a fraction of the body's */
  Mat        modes;        /* rigid body modes of these bodies, a column each; NULL until a load step needs them */
  MeshRotation *rotations; /* [bodies] rotations that only weak springs resist; NULL if there are no weak springs */
} Springs;

/* springs.c: SpringsMeasureStiffness() computes the largest product of Young's modulus and size of a body
   [force/length]. */
PETSC_INTERN PetscErrorCode SpringsMeasureVolumes(const Bodies *, PetscReal volume[]);
PETSC_INTERN PetscErrorCode SpringsMeasureStiffness(const Bodies *, PetscReal *largest);
PETSC_INTERN PetscErrorCode SpringsDistribute(const Bodies *, const PetscReal modulus[], Vec stiffness);
PETSC_INTERN PetscErrorCode SpringsCreate(const Bodies *, Springs *);
PETSC_INTERN PetscErrorCode SpringsMeasure(const Springs *, Vec u, Vec *force, PetscReal *weak);
PETSC_INTERN PetscErrorCode SpringsDestroy(Springs *);

/* rotations.c: text for the axis of a rotation that nothing resists */
PETSC_INTERN PetscReal      RotationRound(PetscReal x, PetscReal unit);
PETSC_INTERN PetscErrorCode RotationDescribe(const MeshRotation *, size_t size, char text[]);

/* bolts.c: pretension of bolts: forces and shortenings of the sections */
typedef struct {
  PetscInt   n;                  /* number of bolts */
  PetscReal *force, *shortening; /* values at the last state [force], [length] */
  PetscReal *target, *now; /* values of the current load step: force that the scene gives [force], and shortening in
                              the current solve [length] */
  PetscBool *driven;       /* whether the scene gives the force, so that the shortening follows from it */
  PetscReal *compliance;   /* [n x n] derivative of the shortenings with respect to the forces [length/force] */
  PetscReal *most;         /* largest permitted shortenings [length] */
  PetscReal *tried[2];     /* shortenings and forces of the previous solve in this load step */
  PetscInt   nsolves;      /* number of solves with the present linearization of contact so far */
  PetscBool  tries;        /* whether `tried` belongs to a solve of this load step */
  PetscInt   nslopes;      /* number of updates of the compliance so far */
} Bolts;

PETSC_INTERN PetscErrorCode BoltsCreate(const Bodies *, Bolts *);
PETSC_INTERN PetscErrorCode BoltsBegin(const Bodies *, Bolts *, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode BoltsAdvance(const Bodies *, Bolts *, PetscReal tolerance, Vec u, PetscBool *again,
  const char **failed);
PETSC_INTERN PetscErrorCode BoltsSettle(const Bodies *, Bolts *, Vec u, PetscReal *work);
PETSC_INTERN PetscErrorCode BoltsRestore(const Bodies *, Bolts *, Vec u);
PETSC_INTERN PetscErrorCode BoltsDestroy(Bolts *);

/* couplings.c: springs between faces */
PETSC_INTERN PetscErrorCode CouplingsReserve(const Bodies *, Mat nodes, Mat *);
PETSC_INTERN PetscErrorCode CouplingsCreate(const Bodies *, Mat *stiffness);
PETSC_INTERN PetscErrorCode CouplingsAddStiffness(const Springs *, Mat C, Mat stiffness);

/* connectors.c: springs between points */
PETSC_INTERN PetscErrorCode ConnectorsCreate(const Bodies *, Springs *);
PETSC_INTERN PetscErrorCode ConnectorMeasure(const Bodies *, const Springs *, PetscInt c, Vec u, Vec velocity,
  PetscReal offset[3], PetscReal force[3]);

/* centred.c: quadratic terms of the energy */
PETSC_INTERN PetscErrorCode CentredAdd(PetscReal sign, Mat A, Vec diagonal, Vec centre, Vec x, PetscReal *energy,
  Vec force);

#endif
