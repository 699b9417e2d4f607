/* State of a simulation: its objects, and the data that are passed from one load step to the next. */
#ifndef STATEIMPL_H
#define STATEIMPL_H

#include <step.h>
#include "src/dynamics/dynamicsimpl.h"

/* Parts of the simulation. Each is declared in a header of this folder, which the member of the simulation names. */
typedef struct _n_LoadPath        LoadPath;
typedef struct _n_ContactHistory  ContactHistory;
typedef struct _n_ContactState    ContactState;
typedef struct _n_ContactSolution ContactSolution;
typedef struct _n_Probes          Probes;
typedef struct _n_Progress        Progress;
typedef struct _n_Results         Results;
typedef struct _n_StepControl     StepControl;
typedef struct _n_RunState        RunState;

/* The simulation: the bodies, the loads and constraints that act on them, and the parts that change during a run. */
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
  Mat             follows; /* derivative of the follower loads (followers.c); NULL until it is needed [force/length] */
  VertexPlaces    places;
  PetscBool       quadratic; /* true if load steps are quadratic programs: every body is linear, or the scene
                                has model: quadratic */
  Mat             K;
  Vec             mass;
  PetscReal       stiffness; /* largest stiffness of all bodies, estimated as Young's modulus times length
                                [force/length] */
  LoadPath       *path;      /* last two equilibrium states (path.h) */
  ContactHistory *history;   /* contact results by vertex, from which the next solve starts (contact_history.h) */
  ContactState   *solved;    /* contact rows of the last solve, and the results there (contact_state.h) */
  Results        *results;   /* requested results and their values (results.h) */
  StepControl    *control;   /* settings for the solution of load steps (control.h) */
  RunState       *run;       /* progress, and cells to refine (run.h) */
  RunReport       report;
};

/* Return the parts of the simulation that the functions for loads and constraints need. */
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

/* inertia.c: inertia forces of the load step that ends at `time` */
PETSC_INTERN PetscErrorCode InertiaBegin(Simulation, PetscReal time, PetscBool *changed);
PETSC_INTERN PetscErrorCode InertiaIsSmall(Simulation, PetscBool *);
PETSC_INTERN PetscErrorCode InertiaSetExcess(Simulation, Vec u);
PETSC_INTERN PetscErrorCode InertiaMeasureExcess(Simulation, Vec u, PetscReal rounding, PetscReal *change);
PETSC_INTERN PetscErrorCode InertiaGetForce(Simulation, Vec u, Vec *force);
PETSC_INTERN PetscErrorCode InertiaEstimate(Simulation, PetscReal time, PetscBool smooth, Vec u, PetscReal *error);
PETSC_INTERN PetscErrorCode InertiaAdvance(Simulation, PetscReal time, Vec u);

#endif
