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

/* The model: the bodies, and the loads and constraints that act on them */
typedef struct _n_Model {
  MPI_Comm     comm;
  Scene        scene;
  DM           dm;
  Elasticity   elasticity;
  Contact      contact; /* NULL if the scene has no contact pair */
  Prescribed   prescribed;
  DeadLoads    loads;
  Temperatures temperatures;
  Springs      springs;
  Bolts        bolts;
  RigidBodies  rigid;
  Ties         ties;
  Dynamics     dynamics;
  Mat          follows; /* derivative of the follower loads (followers.c); NULL until it is needed [force/length] */
  VertexPlaces places;
  PetscBool    quadratic; /* true if load steps are quadratic programs: every body is linear, or the scene
                             has model: quadratic */
  Mat          K;
  Vec          mass;
  PetscReal    stiffness; /* largest stiffness of all bodies, estimated as Young's modulus times length
                             [force/length] */
} * Model;

/* The state: the data that a load step takes from the one before, and the settings of load steps */
typedef struct _n_State {
  LoadPath       *path;    /* last two equilibrium states (path.h) */
  ContactHistory *history; /* contact results by vertex, from which the next solve starts (contact_history.h) */
  ContactState   *solved;  /* contact rows of the last solve, and the results there (contact_state.h) */
  StepControl    *control; /* settings for the solution of load steps (control.h) */
} * State;

/* The simulation: its model, its state, and its results */
struct _n_Simulation {
  Model     model;
  State     state;
  Results  *results; /* requested results and their values (results.h) */
  RunState *run;     /* progress, and cells to refine (run.h) */
  RunReport report;
};

/* Return the parts of the model that the functions for loads and constraints need. */
static inline Bodies ModelBodies(Model model)
{
  return (Bodies){model->comm, model->scene, model->dm, model->elasticity, model->places, model->mass};
}

static inline Constraints ModelConstraints(Model model)
{
  return (
    Constraints){ModelBodies(model), &model->prescribed, &model->springs, &model->rigid, &model->ties, &model->follows};
}

static inline PetscBool ModelIsDynamic(Model model)
{
  return (PetscBool)(model->dynamics.mass != NULL);
}

/* inertia.c: inertia forces of the load step that ends at `time` */
PETSC_INTERN PetscErrorCode InertiaBegin(Model, State, PetscReal time, PetscBool *changed);
PETSC_INTERN PetscErrorCode InertiaIsSmall(Model, PetscBool *);
PETSC_INTERN PetscErrorCode InertiaSetExcess(Model, State, Vec u);
PETSC_INTERN PetscErrorCode InertiaMeasureExcess(Model, State, Vec u, PetscReal rounding, PetscReal *change);
PETSC_INTERN PetscErrorCode InertiaGetForce(Model, Vec u, Vec *force);
PETSC_INTERN PetscErrorCode InertiaEstimate(Model, State, PetscReal time, PetscBool smooth, Vec u, PetscReal *error);
PETSC_INTERN PetscErrorCode InertiaAdvance(Model, State, PetscReal time, Vec u);

#endif
