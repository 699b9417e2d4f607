/*
   The state of a simulation: what it is made of, and what is carried from one load step to the next.
*/
#ifndef STATEIMPL_H
#define STATEIMPL_H

#include <step.h>
#include "src/dynamics/dynamicsimpl.h"

/* solution.c: what a solve left behind, beside the displacement */
typedef struct {
  Vec pressure; /* one a row */
  Vec gap;      /* linearized, one a row */
  Vec shear;    /* forces of friction along both tangents of a row [force]; NULL: no pair has any */
  Vec slip;     /* since the last state, along both tangents of a row [length] */
} ContactSolution;

PETSC_INTERN PetscErrorCode ContactSolutionCreate(Vec rows, ContactSolution *);
PETSC_INTERN PetscErrorCode ContactSolutionDestroy(ContactSolution *);

/* contact_history.c: pressure and slack of the last solve by nonmortar vertex, for the next one's warm start */
typedef struct {
  PetscSection global;           /* the mesh's */
  PetscInt     npairs, nowned;   /* nodes that this rank owns */
  PetscInt     first;            /* global row of the first */
  PetscReal   *pressure, *slack; /* npairs x nowned; pressure 0 where no row was */
  PetscBool   *open;             /* where the pressure is a barrier's over an open gap */
  PetscReal   *shear;            /* 3 npairs x nowned: force of friction [force]; NULL: no pair has any, */
  PetscReal   *settled;          /* that at the last state of equilibrium, */
  PetscReal   *friction;         /* all of it at the vertices of both sides there [force], */
  PetscReal   *slip_path;        /* and npairs x nowned: the length of all slip up to it [length], */
  PetscReal   *dissipated;       /* and the work of friction [force length] */
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
PETSC_INTERN PetscErrorCode ContactHistoryFindLost(const ContactHistory *, ContactLinearization, PetscBool **lost,
  PetscInt *nlost);
PETSC_INTERN PetscErrorCode ContactHistoryLeastGap(const ContactHistory *, const PetscBool lost[], ContactLinearization,
  PetscReal *least);
PETSC_INTERN PetscErrorCode ContactHistoryDestroy(ContactHistory *);

/* path.c: the last two states of equilibrium; load step k ends at time k */
typedef struct {
  PetscReal time, previous_time;
  Vec       u, previous_u;
  PetscReal largest_increment;    /* of any component in any step so far [length] */
  Vec       outside;              /* forces from outside at u; NULL at the start: none [force] */
  PetscReal work;                 /* of theirs [force length] */
  Vec       contact;              /* forces on the contacts at u, where pairs rub; NULL: none [force] */
  PetscReal contact_work;         /* of theirs [force length] */
  PetscReal energy;               /* of the bodies at u [force length] */
  PetscReal unbalanced, turnover; /* of this load step so far: work that is neither stored nor taken up by the contacts;
                                     the largest of the three, solve by solve [force length] */
  PetscBool warned;               /* that it is too much */
} LoadPath;

/* Fields that are asked for, and what they were at the end of the last load step */
typedef struct {
  PetscBool  nodes, points; /* asked for: at nodes and of cells, at quadrature points */
  PetscReal *recovered;     /* stress, 6 values a local node */
  PetscReal *nodal, *density, *places, *point_stress;
  PetscInt   npoints;
} Results;

/* Where the points of the scene's probes are */
typedef struct {
  PetscInt n;
  PetscReal (*points)[3];
  MeshPlace *places;
} Probes;

/* When a run has said how far it is, and what it knows of that; of the clock [s] */
typedef struct {
  PetscReal      every;    /* 0: never */
  PetscReal      residual; /* the first of a linear solve */
  PetscInt       nsteps;   /* whole load steps so far */
  PetscBool      whole;    /* the load step under way was begun in this run */
  PetscLogDouble begun, said;
  PetscLogDouble last[4]; /* durations of the last whole load steps, in a ring */
} Progress;

/* Of adapt.c, where the next mesh may have cells refined: squared errors of this rank's cells, summed over load
   steps, and which are to be refined */
typedef struct {
  PetscReal *errors;
  PetscBool *marked;
} Adapt;

/* Of forecast.c: what load steps ended with on another mesh, interpolated to this one; none where nothing is foreseen
 */
typedef struct {
  StepForecast *found; /* the caller's; NULL: none is wanted */
  StepForecast  here;
  PetscBool     used, failed; /* by the last attempt; by any */
} Forecast;

/* Who looks on while a load step is solved: run/progress.c. Members may be NULL */
typedef struct {
  PetscErrorCode (*begin)(Simulation); /* before a load step */
  PetscErrorCode (*reach)(Simulation); /* the state has moved on */
  PetscErrorCode (*optimizer)(Tao, void *);
  PetscErrorCode (*linear)(KSP, PetscInt, PetscReal, void *);
} StepObserver;

/* What the folders from here on work on */
struct _n_Simulation {
  MPI_Comm     comm;
  Scene        scene;
  DM           dm;
  Elasticity   elasticity;
  Contact      contact; /* NULL when the scene names no pair */
  Prescribed   prescribed;
  DeadLoads    loads;
  Temperatures temperatures;
  Springs      springs;
  RigidBodies  rigid;
  Ties         ties;
  Dynamics     dynamics;
  Mat          follows; /* slope of the pressures that follow their faces, of followers.c; NULL before there is one
                           [force/length] */
  VertexPlaces places;
  PetscBool quadratic; /* a load step is a quadratic program: every body is linear, or the scene asks for the model */
  Mat       K;
  Vec       mass;
  PetscReal stiffness;  /* the largest of the bodies', Young's modulus times length [force/length] */
  KSP       ksp;        /* of a quadratic step without contact */
  PetscInt  first_step; /* of this run: 0, or that which it goes on with */
  PetscReal increment;  /* of time, that a load step under way is tried with next; 0: all that is left of it */
  LoadPath  path;
  ContactHistory       history;
  PetscContainer       subspace; /* what the optimizer keeps from one load step to the next; NULL before the first */
  ContactLinearization linearization; /* of the last solve */
  ContactLinearization upcoming;      /* at path.u, of the faces as they are */
  PetscReal           *pressure, *gap, *stress;
  PetscReal           *shear, *slip; /* of the rows, two each; NULL without friction */
  PetscInt             npoints;
  ContactPoint        *points;
  Results              results;
  Probes               probes;
  StepTolerances       tolerances; /* once a solver has read its options: those that it has */
  PetscBool            warm;       /* later load steps start from the path and pressures of the last */
  PetscBool            monitor;    /* say when a step is cut or the gap linearized again */
  PetscBool           *beyond;     /* bodies that strain.c has warned of; NULL before the first load step */
  PetscBool            estimate;   /* of the discretization error, at the end of every load step */
  PetscInt             maxcuts;    /* of one load step */
  const MeshMarks     *marks;      /* NULL: no cells are to be marked */
  Adapt                adapt;
  Forecast             forecast;
  Progress             progress;
  StepObserver         observer;
  PetscInt             unheld;      /* attempts at this load step in a row that contact does not hold */
  char                *cause;       /* of the first of them; NULL: there was none */
  int                  interrupted; /* the signal that asked for an end */
  PetscReal            penalty;     /* stiffness of the contact by that of the bodies; 0: constraints, no penalty */
  RunReport            report;
  RunTimes             start; /* what the clock and PETSc's events said when it began */
};

/* What the files of loads and constraints work on */
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
