/*
   Loads on the bodies: dead loads, temperatures, springs. Files are in the order in which they depend on each other.
*/
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
  Vec          mass; /* lumped mass for unit density; also gives the layout of the unknowns [length^3] */
} Bodies;

/* loads.c: dead loads by ramp, at factor 1; NULL for ramps without load, and if there is no load at all */
typedef struct {
  Scene scene;
  Vec  *force; /* nramps [force] */
} DeadLoads;

PETSC_INTERN PetscErrorCode DeadLoadsCreate(Scene, DM, Elasticity, DeadLoads *);
PETSC_INTERN PetscErrorCode DeadLoadsGet(const DeadLoads *, PetscReal time, Vec *force);
PETSC_INTERN PetscErrorCode DeadLoadsDestroy(DeadLoads *);

/* temperatures.c: temperatures by ramp at factor 1, as linear functions in the cells; now: at the present time,
   NULL: none */
typedef struct {
  MPI_Comm    comm;
  Scene       scene;
  Elasticity  elasticity; /* borrowed */
  PetscInt    n;
  PetscReal **fits; /* nramps; NULL for ramps without temperature */
  PetscReal  *now;
} Temperatures;

PETSC_INTERN PetscErrorCode TemperaturesCreate(Scene, Elasticity, MPI_Comm, Temperatures *);
PETSC_INTERN PetscErrorCode TemperaturesApply(Temperatures *, PetscReal time);
PETSC_INTERN PetscErrorCode TemperaturesGetLargest(const Temperatures *, PetscReal *size);
PETSC_INTERN PetscErrorCode TemperaturesDestroy(Temperatures *);

/* connectors.c: springs between points. Nodes of the cells of both points, known on all ranks, with the values of their
   shape functions */
typedef struct {
  PetscInt  n[2], node[2][MESH_MAX_NODES]; /* global */
  PetscReal N[2][MESH_MAX_NODES];
  PetscReal k[3][3]; /* force by offset [force/length] */
} Connector;

/* springs.c: stiffness per row; NULL: none */
typedef struct {
  Vec        stiffness, weak; /* of all springs to the ground; of the weak springs alone [force/length] */
  Mat        between;         /* of springs between faces; NULL: none */
  Connector *connectors;      /* one for each of the scene */
  PetscInt   nweak;           /* number of bodies with weak springs */
} Springs;

/* springs.c */
PETSC_INTERN PetscErrorCode SpringsMeasureVolumes(const Bodies *, PetscReal volume[]);
PETSC_INTERN PetscErrorCode SpringsMeasureStiffness(const Bodies *, PetscReal *largest);
PETSC_INTERN PetscErrorCode SpringsOfSize(const Bodies *, PetscReal share, Vec stiffness);
PETSC_INTERN PetscErrorCode SpringsCreate(const Bodies *, Springs *);
PETSC_INTERN PetscErrorCode SpringsMeasure(const Bodies *, const Springs *, Vec u, PetscReal force[], PetscReal *weak);
PETSC_INTERN PetscErrorCode SpringsDestroy(Springs *);

/* bolts.c: pretension of bolts. Forces and shortenings at the last state of equilibrium, and now */
typedef struct {
  PetscInt   n;
  PetscReal *force, *shortening; /* at the last state [force], [length] */
  PetscReal *target, *now;       /* of the present load step: force that is given [force]; shortening [length] */
  PetscBool *driven;             /* the force is given, and the shortening follows from it */
  PetscReal *compliance;         /* n x n: derivative of the shortenings by the forces [length/force] */
  PetscReal *most;               /* limit of the shortenings [length] */
  PetscReal *tried[2];           /* shortenings and forces of the solve before in this problem */
  PetscInt   nsolves;            /* in the present problem, so far */
  PetscInt   nslopes;            /* compliances that were measured so far */
} Bolts;

PETSC_INTERN PetscErrorCode BoltsCreate(const Bodies *, Bolts *);
PETSC_INTERN PetscErrorCode BoltsBegin(const Bodies *, Bolts *, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode BoltsAdvance(const Bodies *, Bolts *, PetscReal tolerance, Vec u, PetscBool *again,
  const char **failed);
PETSC_INTERN PetscErrorCode BoltsSettle(const Bodies *, Bolts *, Vec u, PetscReal *work);
PETSC_INTERN PetscErrorCode BoltsRestore(const Bodies *, Bolts *, Vec u);
PETSC_INTERN PetscErrorCode BoltsDestroy(Bolts *);

/* couplings.c */
PETSC_INTERN PetscErrorCode CouplingsReserve(const Bodies *, Mat nodes, Mat *);
PETSC_INTERN PetscErrorCode CouplingsCreate(const Bodies *, Mat *stiffness);
PETSC_INTERN PetscErrorCode CouplingsAddStiffness(const Springs *, Mat C, Mat stiffness);

/* connectors.c */
PETSC_INTERN PetscErrorCode ConnectorsCreate(const Bodies *, Springs *);
PETSC_INTERN PetscErrorCode ConnectorMeasure(const Bodies *, const Springs *, PetscInt c, Vec u, PetscReal offset[3],
  PetscReal force[3]);

/* centred.c */
PETSC_INTERN PetscErrorCode CentredAdd(PetscReal sign, Mat A, Vec diagonal, Vec centre, Vec x, PetscReal *energy,
  Vec force);

#endif
