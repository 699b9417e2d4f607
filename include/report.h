/* The state of a run and what it reports about itself: filled by src/run and src/measure, written by src/output. */
#ifndef REPORT_H
#define REPORT_H

#include <petscamgf.h>

/* Moments are about the origin, with forces at the deformed positions */

/* A contact pair: the forces on both sides, each summed over the rows of this pair alone */
typedef struct {
  const char *name;
  PetscReal   force[3];         /* on the nonmortar side [force] */
  PetscReal   moment[3];        /* [force length] */
  PetscReal   mortar_force[3];  /* on the mortar side [force] */
  PetscReal   mortar_moment[3]; /* [force length] */
  PetscReal   normal_force;     /* sum of the magnitudes of the rows' forces = integral of the pressure [force] */
  PetscReal   area;             /* covered area about the vertices in contact [length^2] */
  PetscReal   pressure;         /* largest value of the contact pressure field [force/length^2] */
  PetscReal   penetration;      /* depth of the deepest vertex of either face below the other face [length] */
  PetscReal   coarseness;       /* size of the nonmortar facets / size of the mortar facets in contact; 0: no contact */
  PetscBool   narrow;           /* the contact zone is only one nonmortar facet wide */
  PetscReal   penetration_rounding; /* accuracy of penetration on curved faces [length] */
  PetscBool   frictional;           /* has friction */
  PetscReal   shear_force;          /* sum of the magnitudes of the friction forces of all rows [force] */
  PetscReal   stick_area;           /* covered area about the vertices that stick [length^2]; 0 without friction */
  PetscReal   slip_area;            /* covered area about the vertices that slip [length^2]; 0 without friction */
  PetscReal   dissipated; /* work of friction since the start, by the trapezoidal rule over all solves [force length] */
} PairReport;

/* A face with prescribed displacements, or a symmetry plane. If several faces prescribe one row, they share its
   reaction equally */
typedef struct {
  const char *name;
  PetscReal   reaction[3]; /* on the body [force] */
  PetscReal   moment[3];   /* [force length] */
} FaceReport;

/* A rigid body: where the centre of its rotation is, or its middle where the scene has none, and the rotation vector
   since the start, whole turns included */
typedef struct {
  const char *name;
  PetscReal   position[3]; /* [length] */
  PetscReal   rotation[3]; /* [degrees] */
} RigidReport;

/* A spring between two points */
typedef struct {
  const char *name;
  PetscReal   force[3];  /* on the first body [force] */
  PetscReal   offset[3]; /* displacement of the second point relative to the first [length] */
} ConnectorReport;

/* Pretension of a bolt */
typedef struct {
  const char *name;
  PetscReal   force;      /* in the section, positive: tension [force] */
  PetscReal   shortening; /* [length] */
} BoltReport;

/* A load program at the end of a load step */
typedef struct {
  const char *name;
  PetscReal   factor;
} RampReport;

/* A point of a probe. Its stress is interpolated from nodal stresses */
typedef struct {
  const char *name;
  PetscReal   arc;             /* arc length from the start of its line; 0 for a point [length] */
  PetscReal   place[3];        /* undeformed [length] */
  PetscReal   displacement[3]; /* [length] */
  PetscReal   stress_xx, stress_yy, stress_zz, stress_xy, stress_yz, stress_zx, von_mises, principal_1, principal_2,
    principal_3; /* [force/length^2] */
  PetscReal contact_pressure, contact_gap,
    contact_status; /* [force/length^2], [length], 1 closed 0 open; NaN: not on a face of a contact pair */
} ProbeReport;

/* All forces on a body: of its contact pairs, its faces, and the dead loads */
typedef struct {
  const char *name;
  PetscReal   contact[3], reaction[3], springs[3], ties[3], load[3]; /* [force] */
  PetscReal   residual[3];                                           /* their sum [force] */
  PetscReal   balance;        /* |residual| / sum of the magnitudes of all these forces */
  PetscReal   plastic_strain; /* largest equivalent plastic strain at any quadrature point */
} BodyReport;

/* Dynamics. Work since the start by the trapezoidal rule over all solves */
typedef struct {
  const char *name;
  PetscReal   kinetic_energy;        /* [force length] */
  PetscReal   total_energy;          /* kinetic and elastic [force length] */
  PetscReal   damping_work;          /* taken up by damping [force length] */
  PetscReal   numerical_dissipation; /* work of the loads and kinetic energy at the start that is neither in the total
                                        energy nor taken up by the contacts or by damping [force length] */
  PetscInt    rejected_steps;        /* controlled time steps: taken back in this load step because of their error */
  PetscReal   shortest_step;         /* of this load step; all are of one length unless they are controlled [time] */
  PetscReal   time_error;            /* controlled time steps: the largest error of this load step; else 0 */
  PetscReal   momentum[3];           /* of all bodies [force time] */
  PetscReal   angular_momentum[3];   /* about the origin, at the deformed places [force length time] */
} MotionReport;

typedef struct {
  PetscInt  step;
  PetscReal time; /* load step k ends at time k, in dynamics at k times the time step */
  PetscReal load;
  PetscInt  constraints;
  PetscInt  filter_dofs;
  PetscInt  ip_iterations;
  PetscInt *ksp_iterations; /* nksp values, one per Newton system */
  PetscInt  nksp;
  PetscInt  amg_applications, amg_setups;
  PetscInt  substeps, cuts;  /* converged solves in this load step; number of cuts */
  PetscInt  contact_updates; /* contact updates in the last solve */
  PetscInt  regularizations; /* Newton systems whose matrix was not positive definite */
  PetscBool factored;        /* a factorization by MUMPS was used; amg counts are its solves */
  PetscInt  systems,
    filtered_systems;          /* condensed systems; those solved with the filter (for the others the AMG alone was
                                  sufficient) */
  TaoIPFilterFallbacks linear; /* linear solves for which the Krylov method alone was not sufficient */
  PetscReal            energy; /* strain energy, elastic [force length] */
  PetscReal            plastic_work;   /* work of the stresses on the plastic strains since the start [force length] */
  PetscReal            plastic_strain; /* largest equivalent plastic strain of all bodies */
  PetscReal   work; /* work of the dead loads and of the reactions on driven faces since the start, by the trapezoidal
                     rule over all solves [force length] */
  PetscReal   contact_work; /* work taken up by the contacts since the start, by the same rule: friction and normal
                             forces; 0 if no pair has friction [force length] */
  PetscReal   normal_work;  /* the part of contact_work that is not friction: gaps that close within a step, and the
                             error of the linearized contact [force length] */
  PetscReal   imbalance; /* energy balance of this load step: work that is neither stored nor taken up by the contacts,
                          over the largest of the three. NaN: no pair has friction, or bodies expand by heat */
  PetscReal   potential; /* minimized function: strain energy - work of dead loads, or its quadratic model [force
                          length] */
  PetscReal   equilibrium; /* norm of (internal + contact - dead forces) on free rows / norm of all internal forces */
  PetscReal   kkt_error;   /* scaled, dimensionless */
  PetscReal   kkt_error_unscaled;
  PetscReal   gap_min;      /* smallest linearized gap, negative: penetration [length]; NaN: no contact rows */
  PetscReal   gap_true;     /* smallest gap of the deformed bodies [length]; NaN: no faces within the search distance */
  PetscReal   gap_change;   /* largest difference between these two gaps, where there is pressure or penetration
                             [length] */
  PetscReal   normals_turn; /* rotation of the normals since the last contact update, weighted with the pressures; of
                             the worst pair */
  PetscReal   slip_change;  /* largest difference between the linearized slip and the slip at the state, where there is
                             pressure [length] */
  PetscReal   straightened; /* correction of the last linearized rotations of rigid bodies [length] */
  PetscReal   update_error; /* largest of gap_change, slip_change and the length equivalent of normals_turn [length] */
  PetscBool   gap_unconverged;  /* update_error exceeds the tolerance: contact_updates was reached first */
  PetscInt    gap_damped;       /* contact updates that were damped because they did not converge */
  PetscReal   complementarity;  /* max s z [force/length] */
  PetscReal   algebraic_error;  /* relative error in energy from the solver: products of gap and pressure, force
                                 residual, inconsistent gap */
  PetscReal   gap_error;        /* the part of algebraic_error due to the inconsistent gap */
  PetscReal   action_reaction;  /* |sum of the contact forces of both sides| / sum of the magnitudes of the vertices'
                                 forces */
  PetscReal   error_estimate;   /* discretization error in the energy norm / sqrt(2 energy). Its square is the relative
                                 error in energy. NaN: not estimated */
  PetscReal   motion;           /* largest component of the displacement; 0 without contact [length] */
  PetscReal  *body_errors;      /* error_estimate by bodies; their squares add up to its square. NULL: not estimated */
  PetscReal   contact_force[3]; /* vector sum of the pairs' forces on their nonmortar sides [force] */
  PetscReal   reaction[3];      /* sum of the reactions on driven rows (non-zero prescribed displacement); on all
                                 prescribed rows if none is driven [force] */
  PetscInt    nramps;           /* number of the scene's ramps; the load is the first */
  RampReport *ramps;
  PetscInt    npairs; /* number of the scene's contact pairs, in its order; 0 before the first converged solve */
  PairReport *pairs;
  PetscInt    nfaces; /* number of faces with prescribed displacements, in the order of their first mention in the
                            scene */
  FaceReport *faces;
  PetscInt    nbodies;
  BodyReport *bodies;
  PetscInt    nconnectors; /* number of the scene's connectors */
  ConnectorReport *connectors;
  PetscInt         nbolts; /* number of the scene's bolts */
  BoltReport      *bolts;
  PetscInt         nrigid_bodies; /* number of the scene's rigid bodies */
  RigidReport     *rigid_bodies;
  PetscInt         nmotions; /* 1 in dynamics, else 0 */
  MotionReport    *motions;
  PetscReal        dissipated;        /* work of friction of all pairs since the start [force length] */
  PetscReal        balance;           /* largest balance of all bodies */
  PetscReal        weak_spring_force; /* sum of the magnitudes of the weak springs' nodal forces [force] */
  PetscInt         nprobes;           /* number of the scene's point probes */
  ProbeReport     *probes;
  PetscInt         nlines; /* number of points of all line probes */
  ProbeReport     *lines;
  PetscLogDouble   solve_time; /* time of the optimizer, including its linear solves [s] */
  PetscLogDouble   step_time;  /* time of the load step without its output [s] */
  PetscBool        converged;
  const char      *reason;
} StepReport;

/*
   A vertex on either side of a contact pair. Over one side pressure x area adds up to the pair's normal_force, and
   force to its force on that side. If a vertex is covered much less than its neighbours, its pressure is counted with
   theirs; its own area and pressure are zero.
*/
typedef struct {
  PetscInt  pair, vertex; /* pair: number in the scene; vertex: local DMPlex point owned by this rank */
  PetscReal pressure;     /* [force/length^2] */
  PetscReal area;         /* covered area to which the pressure belongs [length^2] */
  PetscReal gap;          /* mean linearized gap over the covered part [length] */
  PetscReal force[3];     /* contact force on the vertex [force] */
  PetscReal shear[3];     /* friction stress on the vertex's side [force/length^2] */
  PetscReal slip[3];      /* slip of the other side relative to it since the last solve [length] */
  PetscReal slip_path;    /* length of the slip path since the start [length] */
  PetscBool closed, slips;
  PetscBool presses; /* most of its area belongs to rows with pressure; contact that the mortar side cannot resolve
                        counts as open */
} ContactPoint;

/* Number of values of a stress: xx yy zz xy yz zx, von Mises, principal values (largest first) */
#define STRESS_VALUES 10

/* The state at the end of a load step; valid until the next one. Fields that SimulationSetFields() did not request
   are NULL */
typedef struct {
  const StepReport   *report;
  Vec                 velocity;          /* in dynamics, else NULL [length/time] */
  Vec                 displacement;      /* global vector, 3 components per node [length] */
  const PetscReal    *stress;            /* 7 values per local cell, see ElasticityCellStress() */
  const PetscReal    *nodal;             /* STRESS_VALUES per owned vertex, in the order of global vectors */
  const PetscReal    *plastic;           /* 7 values per local cell, see ElasticityCellPlastic(); NULL: no law yields */
  const PetscReal    *density;           /* strain energy per undeformed volume, one per local cell [force/length^2] */
  PetscInt            nquadrature;       /* number of quadrature points on this rank */
  const PetscReal    *quadrature;        /* 3 undeformed coordinates per point [length] */
  const PetscReal    *quadrature_stress; /* 6 stress components per point [force/length^2] */
  PetscInt            npoints;           /* number of contact points on this rank */
  const ContactPoint *points;            /* contact points, pair by pair */
} StepState;

/* An effect that a scene may use. An unused effect is neither allocated nor assembled nor solved */
typedef struct {
  const char    *name;
  PetscBool      on;
  char           why[160];
  PetscLogDouble time; /* time [s]; NaN: part of another phase, not measured separately */
} RunEffect;

/* Accuracy of the results on one mesh; values of all load steps in turn */
typedef struct {
  PetscInt       refine, dofs;
  PetscInt       mesh;      /* number of the mesh, from 0 */
  PetscBool      raised;    /* the same mesh as before with a higher element order */
  PetscReal     *energy;    /* [force length] */
  PetscReal     *force;     /* magnitude of each pair's force, and sum of the magnitudes of its rows' forces [force] */
  PetscReal     *pressure;  /* largest pressure of each pair [force/length^2] */
  PetscReal     *displaced; /* displacement of each probe point, 3 components [length] */
  PetscReal      recovery;  /* largest estimated relative error in energy over the load steps, by stress recovery */
  PetscReal      change;    /* relative change of the energy or of any pair's force from the coarser mesh, largest
                               over the load steps; NaN: no coarser mesh */
  PetscReal      growth;    /* number of unknowns / that of the coarser mesh; NaN: no coarser mesh */
  PetscReal      error;     /* estimated relative error of the mesh in energy and contact force: from `change`, or
                           without a coarser mesh from `recovery` */
  PetscBool      unseen;    /* the change is larger than `recovery` explains */
  PetscReal      algebraic; /* relative error of the solver in energy */
  PetscInt       amg_applications;
  PetscLogDouble time; /* [s] */
} AccuracyLevel;

typedef struct {
  MPI_Comm  comm;
  PetscReal target;   /* requested relative error in energy and contact force; 0: none requested */
  PetscReal share;    /* fraction of the target that the solver error may use */
  PetscInt  max_dofs; /* limit of unknowns of a mesh */
  PetscBool contact;  /* the scene has contact pairs */
  PetscReal
    tolerance; /* tolerance of the optimizer with contact, of the linear solver without; after a run the one it used */
  PetscBool      given;            /* the tolerance was set by the user and is kept */
  PetscReal      update_tolerance; /* tolerance of contact updates, relative to the largest displacement */
  PetscInt       updates;          /* limit of contact updates per load step */
  PetscInt       of;               /* which results must be accurate: AccuracyTargets */
  PetscBool      adaptive;         /* refine locally where the error is large */
  PetscInt       order;            /* element order of the bodies from the second mesh on; 0: as in the scene */
  PetscInt       mesh;             /* number of the next run's mesh, from 0 */
  PetscReal      growth;           /* estimated number of unknowns of the next mesh */
  PetscInt       nlevels;
  AccuracyLevel *levels;
  PetscBool      reached;
  char           end[160]; /* why no further mesh was computed */
} Accuracy;

/* For comparison: one PCG solve without contact, with AMG only, to the tolerance of the publication; iterations = 0:
   not requested */
typedef struct {
  PetscInt       iterations;
  PetscReal      condition;  /* beta: condition number of the preconditioned matrix, from the Lanczos process of CG */
  PetscReal      bound;      /* bound of the PCG iterations with amgf: sqrt(2 (beta+3)/beta) x iterations (for an l1
                                smoother) */
  PetscLogDouble solve_time; /* AMG set-up and PCG [s] */
} RunContactFree;

/* Resident memory after each phase, summed over ranks [bytes]. The rest of the peak belongs to the solvers */
typedef struct {
  PetscLogDouble start, mesh, assembly;
} RunMemory;

/* Times [s], largest over the ranks; `other` is the time outside of all phases */
typedef struct {
  PetscLogDouble total, mesh, setup, assembly, contact_search, contact_integrals, contact, amg_setup, amg_apply,
    filter_setup, filter_apply, directions, reduced_factor, reduced, optimizer, measures, error_estimate, results,
    comparison, other;
} RunTimes;

/* How a run ended: the exit code of the program */
typedef enum {
  RUN_CONVERGED       = 0,
  RUN_REFUSED         = 1, /* bad input: the scene, an option, a file */
  RUN_FAILED          = 2, /* a load step did not converge */
  RUN_GAP_UNCONVERGED = 3, /* a load step ended with an inconsistent contact gap */
  RUN_ACCURACY_MISSED = 4, /* the requested accuracy was not reached */
  RUN_INTERRUPTED     = 5, /* ended by a signal */
  RUN_OUTPUT_LOST     = 6, /* results could not be written */
  RUN_BROKEN          = 7  /* no memory, or a fault of the program or of a library */
} RunEnd;

typedef struct {
  const char     *problem;
  const char     *units; /* "": the scene gives no units */
  PetscInt        ranks, dofs, refine;
  PetscBool       converged;
  const char     *reason;
  PetscInt        exit_code; /* a RunEnd */
  PetscInt        nwarnings;
  const char    **warnings;
  PetscInt        nsteps;
  StepReport     *steps;
  PetscInt        nbodies;
  const char    **bodies;
  PetscInt       *assemblies; /* how often each body's tangent was assembled */
  const Accuracy *accuracy;   /* choices and results of -accuracy; NULL: not requested */
  PetscInt        neffects;
  RunEffect      *effects;
  RunTimes        time;
  RunContactFree  contact_free;
  PetscLogDouble  peak_memory_bytes; /* peak resident memory, sum over ranks */
  RunMemory       memory;
} RunReport;

#endif
