/*
   State of a simulation: its objects, and the data carried from one load step to the next.
*/
#ifndef STATEIMPL_H
#define STATEIMPL_H

#include <step.h>
#include "src/dynamics/dynamicsimpl.h"

/* solution.c: the solution at the contact rows of one solve */
typedef struct {
  Vec pressure; /* one per row [force/length^2] */
  Vec gap;      /* linearized gap, one per row [length] */
  Vec shear;    /* friction forces along the two tangents of each row [force]; NULL: no friction */
  Vec slip;     /* slip since the last state along the two tangents of each row [length] */
} ContactSolution;

PETSC_INTERN PetscErrorCode ContactSolutionCreate(Vec rows, ContactSolution *);
PETSC_INTERN PetscErrorCode ContactSolutionDestroy(ContactSolution *);

/* contact_history.c: data of the last solve by nonmortar vertex, for the next start */
typedef struct {
  PetscSection global;           /* the mesh's */
  PetscInt     npairs, nowned;   /* number of pairs; of nodes that this rank owns */
  PetscInt     first;            /* first global row of the owned nodes */
  PetscReal   *pressure, *slack; /* [npairs x nowned]; pressure 0 where there was no row */
  PetscBool   *open;             /* the gap is open and the pressure only the barrier's */
  PetscReal   *shear;            /* [3 npairs x nowned] friction force in global coordinates [force]; NULL: no
                                    friction */
  PetscReal   *settled;          /* friction force at the last state of equilibrium [force] */
  PetscReal   *friction;         /* friction forces on the vertices of both sides at that state [force] */
  PetscReal   *slip_path;        /* [npairs x nowned] length of all slip up to that state [length] */
  PetscReal   *dissipated;       /* work of friction up to that state [force length] */
} ContactHistory;

PETSC_INTERN PetscErrorCode ContactHistoryCreate(DM, Scene, ContactHistory *);
PETSC_INTERN PetscInt       ContactHistoryIndex(const ContactHistory *, ContactLinearization, PetscInt row);
PETSC_INTERN PetscErrorCode ContactHistoryStore(ContactHistory *, ContactLinearization, const ContactSolution *,
  Vec slack, PetscReal stiffness);
PETSC_INTERN PetscErrorCode ContactHistoryRecall(const ContactHistory *, ContactLinearization, PetscReal scale,
  Vec slack, Vec pressure, PetscBool *any);
PETSC_INTERN PetscErrorCode ContactHistoryChange(const ContactHistory *, ContactLinearization, PetscReal *change);
PETSC_INTERN PetscErrorCode ContactHistoryFollowRows(const ContactHistory *, ContactLinearization solved,
  ContactLinearization, PetscInt                                                                **row);
PETSC_INTERN PetscErrorCode ContactHistoryFindClosed(const ContactHistory *, ContactLinearization, Vec closed);
PETSC_INTERN PetscErrorCode ContactHistoryFindLostRows(const ContactHistory *, ContactLinearization, PetscBool **lost,
  PetscInt *nlost);
PETSC_INTERN PetscErrorCode ContactHistoryLeastGap(const ContactHistory *, const PetscBool lost[], ContactLinearization,
  PetscReal *least);
PETSC_INTERN PetscErrorCode ContactHistoryDestroy(ContactHistory *);

/* path.c: the last two states of equilibrium. Load step k ends at time k. */
typedef struct {
  PetscReal time, previous_time;
  Vec       u, previous_u;
  PetscReal largest_increment;    /* of any displacement component in any step so far [length] */
  Vec       outside;              /* external forces at u [force]; NULL at the start: zero */
  PetscReal work;                 /* work of the external forces [force length] */
  Vec       contact;              /* contact forces at u, with friction only; NULL: zero [force] */
  PetscReal contact_work;         /* work of the contact forces [force length] */
  PetscReal energy;               /* of the bodies at u, with the plastic work [force length] */
  PetscReal unbalanced, turnover; /* in the present load step: work that is neither stored as energy nor taken up by
                                     contact; and the sum over solves of the largest of these three [force length] */
  PetscBool warned;               /* the imbalance has been warned of */
} LoadPath;

/* Requested result fields, and their values at the end of the last load step */
typedef struct {
  PetscBool  nodes, points; /* requested: at nodes and cells; at quadrature points */
  PetscReal *recovered;     /* recovered stress, 6 values per local node */
  PetscReal *plastic;       /* plastic strain, 7 values a local cell; NULL: no law yields */
  PetscReal *nodal, *density, *places, *point_stress;
  PetscInt   npoints;
} Results;

/* Positions of the scene's probes */
typedef struct {
  PetscInt n;
  PetscReal (*points)[3];
  MeshPlace *places;
} Probes;

/* Progress report of a run: when it last printed, and what the estimate uses; times are wall clock [s] */
typedef struct {
  PetscReal      every;    /* 0: never */
  PetscReal      residual; /* first residual of the current linear solve */
  PetscInt       nsteps;   /* whole load steps finished so far */
  PetscBool      whole;    /* the current load step was started in this run (not restarted within it) */
  PetscLogDouble begun, said;
  PetscLogDouble last[4]; /* durations of the last whole load steps (ring buffer) */
} Progress;

/* adapt.c, for runs whose next mesh may be refined: squared errors of this rank's cells, summed over load steps, and
   the cells to refine */
typedef struct {
  PetscReal *errors;
  PetscBool *marked;
} Adapt;

/* forecast.c: states at the end of load steps on another mesh, interpolated to this one; empty if there is no
   forecast */
typedef struct {
  StepForecast *found; /* given by the caller; NULL: none */
  StepForecast  here;
  PetscBool     used, failed; /* used by the last attempt; failed in any attempt */
} Forecast;

/* Callbacks while a load step is solved (run/progress.c); any may be NULL */
typedef struct {
  PetscErrorCode (*begin)(Simulation); /* called before a load step */
  PetscErrorCode (*reach)(Simulation); /* called after each converged attempt */
  PetscErrorCode (*optimizer)(Tao, void *);
  PetscErrorCode (*linear)(KSP, PetscInt, PetscReal, void *);
} StepObserver;

/* The simulation object, used by state, measure, step and run */
struct _n_Simulation {
  MPI_Comm     comm;
  Scene        scene;
  DM           dm;
  Elasticity   elasticity;
  Contact      contact; /* NULL if the scene has no contact pair */
  Prescribed   prescribed;
  DeadLoads    loads;
  Temperatures temperatures;
  Springs      springs;
  RigidBodies  rigid;
  Ties         ties;
  Dynamics     dynamics;
  Mat          follows; /* derivative of the follower loads (followers.c); NULL until needed [force/length] */
  VertexPlaces places;
  PetscBool    quadratic; /* load steps are quadratic programs: every body is linear, or the scene asks for it */
  Mat          K;
  Vec          mass;
  PetscReal    stiffness;  /* largest of all bodies: Young's modulus times length [force/length] */
  KSP          ksp;        /* for quadratic steps without contact */
  PetscInt     first_step; /* first load step of this run; not 0 after a restart */
  PetscReal    increment; /* time increment of the next attempt within the current load step; 0: the rest of the step */
  LoadPath     path;
  ContactHistory       history;
  PetscContainer       subspace;      /* kept by the optimizer from one load step to the next; NULL before the first */
  ContactLinearization linearization; /* the contact linearization of the last solve */
  ContactLinearization upcoming;      /* the linearization at path.u, without ramps of initial overlaps */
  PetscReal           *pressure, *gap, *stress;
  PetscReal           *shear, *slip; /* two per contact row; NULL without friction */
  PetscInt             npoints;
  ContactPoint        *points;
  Results              results;
  Probes               probes;
  StepTolerances       tolerances; /* updated with the solvers' options once these have been read */
  PetscBool            warm;       /* start load steps from the path and pressures of the last ones */
  PetscBool            monitor;    /* print cuts of load steps and contact updates */
  PetscBool           *beyond;     /* bodies that strain.c has warned of; NULL before the first load step */
  PetscBool            estimate;   /* estimate the discretization error at the end of every load step */
  PetscInt             maxcuts;    /* limit of cuts in one load step */
  const MeshMarks     *marks;      /* NULL: cells are not marked for refinement */
  Adapt                adapt;
  Forecast             forecast;
  Progress             progress;
  StepObserver         observer;
  PetscInt             unheld;      /* consecutive attempts at this load step that contact could not hold */
  char                *cause;       /* reason of the first of these; NULL: none */
  int                  interrupted; /* the signal that was caught; 0: none */
  PetscReal            penalty;     /* -contact_penalty: contact stiffness relative to that of the bodies; 0:
                                       constraints instead */
  RunReport            report;
  RunTimes             start; /* clock and PETSc's event times at the start of the run */
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
PETSC_INTERN PetscErrorCode InertiaGetForce(Simulation, Vec u, Vec *force);
PETSC_INTERN PetscErrorCode InertiaAdvance(Simulation, PetscReal time, Vec u);

/* path.c */
PETSC_INTERN PetscErrorCode PathContinue(Simulation, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode PathPressureScale(Simulation, PetscReal time, PetscReal *scale);
PETSC_INTERN PetscErrorCode PathSolvesToCome(Simulation, PetscInt *);
PETSC_INTERN PetscErrorCode PathAdvance(LoadPath *, PetscReal time, Vec *u);

#endif
