/*
   State of a simulation: its objects, and the data carried from one load step to the next.
*/
#ifndef STATEIMPL_H
#define STATEIMPL_H

#include <step.h>
#include "src/dynamics/dynamicsimpl.h"

/* Parts of the simulation; the headers of this folder that the simulation names declare them */
typedef struct _n_LoadPath        LoadPath;
typedef struct _n_ContactHistory  ContactHistory;
typedef struct _n_ContactState    ContactState;
typedef struct _n_ContactSolution ContactSolution;
typedef struct _n_Probes          Probes;
typedef struct _n_Progress        Progress;
typedef struct _n_Results         Results;
typedef struct _n_StepControl     StepControl;
typedef struct _n_RunState        RunState;

/* The simulation: the bodies and all that acts on them, and the parts that change */
struct _n_Simulation {
  MPI_Comm        comm;
  Scene           scene;
  DM              dm;
  Elasticity      elasticity;
  Contact         contact; /* NULL if the scene has no contact pair */
  Prescribed      prescribed;
  DeadLoads       loads;
  Temperatures    temperatures;
  Springs         springs;
  Bolts           bolts;
  RigidBodies     rigid;
  Ties            ties;
  Dynamics        dynamics;
  Mat             follows; /* derivative of the follower loads (followers.c); NULL until needed [force/length] */
  VertexPlaces    places;
  PetscBool       quadratic; /* load steps are quadratic programs: every body is linear, or the scene asks for it */
  Mat             K;
  Vec             mass;
  PetscReal       stiffness; /* largest of all bodies: Young's modulus times length [force/length] */
  LoadPath       *path;      /* path.h: the last states of equilibrium */
  ContactHistory *history;   /* contact_history.h: contact results by vertex, for the next start */
  ContactState   *solved;    /* contact_state.h: the contact rows of the last solve, and their results */
  Results        *results;   /* results.h: requested results, and their values */
  StepControl    *control;   /* control.h: how load steps are solved */
  RunState       *run;       /* run.h: progress, and cells to refine */
  RunReport       report;
};

/* Parts of the simulation that loads and constraints work on */
static inline Bodies SimulationBodies(Simulation sim)
{
  return (Bodies){sim->comm, sim->scene, sim->dm, sim->elasticity, sim->places, sim->mass};
}

static inline Constraints SimulationConstraints(Simulation sim)
{
  return (Constraints){SimulationBodies(sim), &sim->prescribed, &sim->springs, &sim->rigid, &sim->ties, &sim->follows};
}

static inline PetscBool SimulationIsDynamic(Simulation sim)
{
  return (PetscBool)(sim->dynamics.mass != NULL);
}

/* inertia.c: of a load step that ends at this time */
PETSC_INTERN PetscErrorCode InertiaBegin(Simulation, PetscReal time, PetscBool *changed);
PETSC_INTERN PetscErrorCode InertiaIsSmall(Simulation, PetscBool *);
PETSC_INTERN PetscErrorCode InertiaSetExcess(Simulation, Vec u);
PETSC_INTERN PetscErrorCode InertiaMeasureExcess(Simulation, Vec u, PetscReal rounding, PetscReal *change);
PETSC_INTERN PetscErrorCode InertiaGetForce(Simulation, Vec u, Vec *force);
PETSC_INTERN PetscErrorCode InertiaAdvance(Simulation, PetscReal time, Vec u);

#endif
