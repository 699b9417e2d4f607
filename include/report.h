/* Results of a load step and of a run. src/run and src/measure compute them; src/output writes and prints them. */
#ifndef REPORT_H
#define REPORT_H

#include <petscamgf.h>

/* Moments are about the origin. The forces act at the deformed positions of the nodes. */

/* Results of a contact pair. Forces are summed over the rows of this pair only. */
typedef struct {
  const char *name;
  const char *mortar;            /* "<body>.<face>" of the mortar side */
  PetscReal   force[3];          /* on the nonmortar side [force] */
  PetscReal   moment[3];         /* [force length] */
  PetscReal   mortar_force[3];   /* on the mortar side [force] */
  PetscReal   mortar_moment[3];  /* [force length] */
  PetscReal   size;              /* sum of the magnitudes of the components of the nodal forces [force] */
  PetscReal   normal_force;      /* sum of the magnitudes of the rows' forces, which is the integral of the pressure
                                   [force] */
  PetscReal   area;              /* area around the vertices in contact that the other side covers [length^2] */
  PetscReal   pressure;          /* largest value of the contact pressure field [force/length^2] */
  PetscReal   pressure_place[3]; /* the undeformed vertex with this pressure [length]; NaN: no contact */
  PetscReal   penetration;       /* depth of the deepest vertex of either face below the other face [length]; after the
                                   last load step, of pairs without force, also of points in the facets */
  PetscReal   coarseness;        /* mean size of the nonmortar facets in contact divided by that of the mortar facets;
                                   0: no contact */
  PetscBool   narrow;            /* the contact area is only one nonmortar facet wide */
  PetscReal   facet;             /* mean size of the nonmortar facets in contact [length]; 0: no contact */
  PetscReal   penetration_rounding; /* uncertainty of `penetration` on curved faces [length] */
  PetscBool   frictional;           /* has friction */
  PetscReal   shear_force;          /* sum of the magnitudes of the friction forces of all rows [force] */
  PetscReal   stick_area;           /* area around the vertices that stick [length^2]; 0 without friction */
  PetscReal   slip_area;            /* area around the vertices that slip [length^2]; 0 without friction */
  PetscReal   dissipated; /* work of friction since the start, from the mean of the largest friction forces at the ends
                             of each solve [force length] */
} PairReport;

/* Reaction on a face with prescribed displacements, or on a symmetry plane. If several faces prescribe the same row,
   each gets an equal part of its reaction. */
typedef struct {
  const char *name;
  PetscReal   reaction[3]; /* on the body [force] */
  PetscReal   moment[3];   /* [force length] */
  PetscReal   torque;      /* part of the moment about the centre of the face's rotation, as it has moved, along the
                              axis of the first rotation that the scene gives; NaN: none [force length] */
  PetscReal   size;        /* sum of the magnitudes of the components of the nodal forces [force] */
  PetscBool   driven;      /* false if the face is nothing but a symmetry plane */
} FaceReport;

/* Position of a rigid body: that of its centre of rotation if the scene gives one, otherwise that of its middle. The
   rotation vector counts from the start and includes whole turns. */
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

/* Factor of a ramp at the end of a load step */
typedef struct {
  const char *name;
  PetscReal   factor;
} RampReport;

/* Results at a point of a probe. The stress is interpolated from the nodal stresses. */
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

/* Sums of the forces on a body: from its contact pairs, its faces, its springs and ties, and its loads */
typedef struct {
  const char *name;
  PetscReal   contact[3], reaction[3], springs[3], ties[3], load[3]; /* [force] */
  PetscReal   residual[3];                                           /* their sum [force] */
  PetscReal   balance; /* magnitude of `residual` divided by the sum of the magnitudes of all forces; of contact and
                          reactions those at the nodes, whose sum may vanish, as in a press fit */
  PetscReal   plastic_strain;                      /* largest equivalent plastic strain at any quadrature point */
  PetscReal   displacement, displacement_place[3]; /* length of the largest displacement, and its undeformed place; of a
                                                      rigid surface the displacement of its reference point [length] */
  PetscReal   von_mises, von_mises_place[3];       /* largest von Mises stress at any node, and its undeformed place
                                                [force/length^2], [length]; NaN: rigid */
  PetscReal   safety; /* yield stress of the material divided by `von_mises`, at most 1 if the body has yielded; NaN: no
                         yield stress is given, or no stress */
} BodyReport;

/* Results of a dynamic analysis. Works are summed since the start by the trapezoidal rule. */
typedef struct {
  const char *name;
  PetscReal   kinetic_energy;        /* [force length] */
  PetscReal   total_energy;          /* kinetic and elastic, also of soft contact pairs [force length] */
  PetscReal   damping_work;          /* energy that damping has dissipated [force length] */
  PetscReal   numerical_dissipation; /* energy that the time integration has lost, also in the normal forces of contact:
                                        work of the loads plus initial kinetic energy, minus total energy, minus the
                                        energy taken up by friction, damping and plasticity [force length] */
  PetscInt    rejected_steps;        /* number of time steps that were repeated in this load step because their error
                                        was too large; only with controlled time steps */
  PetscReal   shortest_step;         /* length of the shortest time step in this load step [time] */
  PetscReal   time_error;            /* largest error of a time step in this load step; 0 unless time steps are
                                        controlled */
  PetscReal   momentum[3];           /* momentum of all bodies [force time] */
  PetscReal   angular_momentum[3];   /* angular momentum of all bodies about the origin, at the deformed positions
                                        [force length time] */
} MotionReport;

typedef struct {
  PetscInt  step;
  PetscReal time; /* time at the end: load step k ends at time k; in dynamics at k times the time step */
  PetscReal load;
  PetscInt  constraints;
  PetscInt  filter_dofs;
  PetscInt  ip_iterations;
  PetscInt *ksp_iterations; /* number of Krylov iterations of each Newton system, nksp values */
  PetscInt  nksp;
  PetscInt  amg_applications, amg_setups;
  PetscInt  substeps, cuts;  /* number of converged solves in this load step; number of cuts */
  PetscInt  contact_updates; /* number of contact updates in the last solve */
  PetscInt  regularizations; /* number of Newton systems whose matrix was not positive definite */
  PetscBool factored;        /* MUMPS has replaced the AMG: the AMG counts are then those of factorizations and
                                solves */
  PetscInt  systems,
    filtered_systems;          /* number of condensed systems; number of those solved with the filter. The AMG alone
                                  was sufficient for the others. */
  TaoIPFilterFallbacks linear; /* counts of the linear solves for which the Krylov method alone was not sufficient */
  PetscReal            energy; /* strain energy, elastic [force length] */
  PetscReal            contact_energy; /* elastic energy of soft contact pairs [force length] */
  PetscReal            plastic_work;   /* work of the stresses in the plastic strains since the start [force length] */
  PetscReal            plastic_strain; /* largest equivalent plastic strain of all bodies */
  PetscReal   work; /* work of the dead loads and of the reactions at prescribed displacements since the start, by
                       the trapezoidal rule [force length] */
  PetscReal   contact_work; /* energy taken up by contact since the start, by friction and by normal forces; 0 if no
                               pair has friction [force length] */
  PetscReal   normal_work;  /* the part of contact_work that is not due to friction but to gaps that close within a
                               step, or to the error of the linearized contact [force length] */
  PetscReal   imbalance;    /* work in this load step that is neither stored as energy nor taken up by contact, divided
                            by the largest of the three. NaN: no pair has friction, or temperatures change the energy */
  PetscReal   potential;    /* the minimized function: strain energy minus the work of dead loads, or its quadratic
                            model [force length] */
  PetscReal   equilibrium;  /* norm of internal + contact - dead forces in free rows, divided by the norm of all
                              internal forces */
  PetscReal   kkt_error;    /* scaled, dimensionless */
  PetscReal   kkt_error_unscaled;
  PetscReal   gap_min;         /* smallest linearized gap; negative: penetration [length]. NaN: there are no contact
                               rows */
  PetscReal   gap_true;        /* smallest gap of the deformed bodies [length]. NaN: no faces are within the search
                               distance */
  PetscReal   gap_change;      /* largest difference between linearized gap and gap of the deformed bodies, in rows with
                               pressure or penetration [length] */
  PetscReal   normals_turn;    /* mean rotation of the normals since the last contact update, weighted with the
                               pressures; the largest value of all pairs */
  PetscReal   slip_change;     /* largest difference between the linearized slip and the slip of the deformed bodies, in
                               rows with pressure [length] */
  PetscReal   straightened;    /* largest correction of displacements due to linearized rotations of rigid bodies
                               [length] */
  PetscReal   update_error;    /* error of the last contact update: the largest of gap_change, slip_change and the
                               equivalents of the other errors [length] */
  PetscBool   gap_unconverged; /* update_error exceeds its tolerance, because contact_updates was reached */
  PetscInt    gap_damped;      /* number of contact updates that were damped because they did not converge */
  PetscReal   complementarity; /* max s z [force/length] */
  PetscReal   algebraic_error; /* relative error in energy that the solver leaves, from products of gap and
                                   pressure, residual forces, and the inconsistent gap */
  PetscReal   gap_error;       /* the part of algebraic_error that is due to the inconsistent gap */
  PetscReal   action_reaction; /* magnitude of the sum of the contact forces on both sides, divided by the sum of
                                   the magnitudes of the nodal contact forces */
  PetscReal   error_estimate;  /* discretization error in the energy norm divided by sqrt(2 energy). Its square is
                                   the relative error in energy. NaN: not estimated */
  PetscReal   motion;          /* length of the largest displacement; 0 without contact [length] */
  PetscReal  *body_errors;     /* the contribution of each body to error_estimate; the squares of the contributions
                                   add up to its square. NULL: not estimated */
  PetscReal   contact_force[3]; /* vector sum of the pairs' forces on their nonmortar sides [force] */
  PetscReal   reaction[3];      /* sum of the reactions at displacements that are prescribed and not zero; if there
                                   are none, at all prescribed displacements [force] */
  PetscInt    nramps;           /* number of ramps; the first ramp is the load */
  RampReport *ramps;
  PetscInt    npairs; /* number of contact pairs, in the order of the scene; 0 before the first converged solve */
  PairReport *pairs;
  PetscInt    nfaces; /* number of faces with prescribed displacements, in the order in which the scene first
                         mentions them */
  FaceReport *faces;
  PetscInt    nbodies;
  BodyReport *bodies;
  PetscInt    nconnectors; /* number of connectors */
  ConnectorReport *connectors;
  PetscInt         nbolts; /* number of bolts */
  BoltReport      *bolts;
  PetscInt         nrigid_bodies; /* number of rigid bodies */
  RigidReport     *rigid_bodies;
  PetscInt         nmotions; /* 1 in dynamics, else 0 */
  MotionReport    *motions;
  PetscReal        dissipated;        /* work of friction in all pairs since the start [force length] */
  PetscReal        balance;           /* the largest `balance` of any body */
  PetscReal        weak_spring_force; /* sum of the magnitudes of the nodal forces of the weak springs [force] */
  PetscInt         nprobes;           /* number of probes that are points */
  ProbeReport     *probes;
  PetscInt         nlines; /* number of points of all line probes */
  ProbeReport     *lines;
  PetscLogDouble   solve_time; /* time of the optimizer with its linear solves [s] */
  PetscLogDouble   step_time;  /* time of the load step, without the time to write its results [s] */
  PetscBool        converged;
  const char      *reason;
  PetscReal        force_rounding; /* rounding error of forces on bodies without stress [force] */
} StepReport;

/*
   Results at a vertex of a contact pair, on either side. Over the vertices of one side, pressure x area adds up to the
   pair's normal_force, and `force` to the force on that side. The pressure of a vertex with a much smaller covered area
   than its neighbours is counted with theirs; the pressure and area reported for the vertex itself are then zero.
*/
typedef struct {
  PetscInt  pair, vertex; /* number of the pair in the scene; local DMPlex point of the vertex, which this rank owns */
  PetscReal pressure;     /* [force/length^2] */
  PetscReal area;         /* covered area for which the pressure is given [length^2] */
  PetscReal gap;          /* mean linearized gap over the covered area [length] */
  PetscReal force[3];     /* contact force on the vertex [force] */
  PetscReal shear[3];     /* friction stress on the side of the vertex [force/length^2] */
  PetscReal slip[3];      /* slip of the other side relative to the vertex since the last solve [length] */
  PetscReal slip_path;    /* length of the path along which the vertex has slipped since the start [length] */
  PetscBool closed, slips;
  PetscBool presses; /* more than half of the vertex's area belongs to rows with pressure. Contact that is too fine
                        for the mortar side to resolve counts as open. */
} ContactPoint;

/* Number of values of a stress: xx yy zz xy yz zx, von Mises, principal values (largest first) */
#define STRESS_VALUES 10

/* The state at the end of a load step, which is valid until the next one. Fields that SimulationSetFields() did not
   request are NULL; those that it did request are not, also on a rank that owns nothing. */
typedef struct {
  const StepReport   *report;
  Vec                 velocity;          /* only in dynamics; otherwise NULL [length/time] */
  Vec                 displacement;      /* global vector, 3 components per node [length] */
  Vec                 reaction;          /* forces of prescribed displacements and symmetry planes [force] */
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

/* What a figure belongs to. FIGURE_OF_STRESSED_MODEL: the model in the load step with the largest von Mises stress */
typedef enum {
  FIGURE_OF_STRESSED_MODEL,
  FIGURE_OF_BODY,
  FIGURE_OF_PAIR,
  FIGURE_OF_FACE,
  FIGURE_OF_PLANE, /* symmetry plane */
  FIGURE_OF_BOLT,
  FIGURE_OWNERS /* their number */
} FigureOwner;

/* A figure that a reader of the results looks for first: the largest value of a quantity over the load steps that
   converged */
typedef struct {
  FigureOwner owner;
  const char *quantity;
  const char *column; /* heading of its column in the printed table of its owners; NULL: it is in no table */
  const char *name;   /* of the body, pair or face to which the figure belongs; "" for the whole model */
  PetscReal   value;
  char        unit[32];      /* in the words of the scene's units; "" if these are unknown, or the figure has no unit */
  PetscReal   place[3];      /* undeformed place [length]; NaN: none */
  PetscReal   components[3]; /* of a force at the end of the load step; NaN: none */
  PetscInt    step;          /* load step */
} RunFigure;

/* Accuracy of the results on one mesh. Arrays have the values of all load steps one after the other. */
typedef struct {
  PetscInt       refine, dofs;
  PetscInt       mesh;      /* number of the mesh, from 0 */
  PetscBool      raised;    /* the mesh is that of the run before, with a higher element order */
  PetscReal     *energy;    /* [force length] */
  PetscReal     *force;     /* two values per pair: magnitude of its force, and sum of the magnitudes of its rows'
                               forces [force] */
  PetscReal     *pressure;  /* largest pressure of each pair [force/length^2] */
  PetscReal     *displaced; /* displacement at each probe point, 3 components [length] */
  PetscReal      recovery;  /* estimated relative error in energy by stress recovery, largest over the load steps */
  PetscReal      change;    /* relative difference of the energy, or of a pair's force, from that on the coarser
                               mesh, largest over the load steps; NaN: no coarser mesh */
  PetscReal      growth;    /* number of unknowns divided by that of the coarser mesh; NaN: no coarser mesh */
  PetscReal      error;     /* estimated relative error of the mesh in energy and contact force, computed from
                               `change`; without a coarser mesh from `recovery` */
  PetscBool      unseen;    /* the results have changed by more than `recovery` explains */
  PetscReal      algebraic; /* relative error in energy that the solver leaves */
  PetscInt       amg_applications;
  PetscLogDouble time; /* [s] */
} AccuracyLevel;

typedef struct {
  MPI_Comm  comm;
  PetscReal target;   /* requested relative error in energy and contact force; 0: no accuracy is requested */
  PetscReal share;    /* fraction of the target that the solver's error may take */
  PetscInt  max_dofs; /* largest number of unknowns of a mesh */
  PetscBool contact;  /* the scene has contact pairs */
  PetscReal
    tolerance; /* tolerance of the optimizer or, without contact, of the linear solver; after a run the tolerance
                  that was used */
  PetscBool      given;            /* the user has set the tolerance, so that it is not changed */
  PetscReal      update_tolerance; /* tolerance of contact updates, relative to the largest displacement */
  PetscInt       updates;          /* largest number of contact updates per load step */
  PetscInt       of;               /* number of the entry of AccuracyTargets: which results must be accurate */
  PetscBool      adaptive;         /* refine locally where the error is large */
  PetscInt       order;            /* element order of the bodies from the second mesh on; 0: that of the scene */
  PetscInt       mesh;             /* number of the next run's mesh, from 0 */
  PetscReal      growth;           /* estimated number of unknowns of the next mesh */
  PetscInt       nlevels;
  AccuracyLevel *levels;
  PetscBool      reached;
  char           end[160]; /* reason why no further mesh was computed */
} Accuracy;

/* For comparison: one PCG solve without contact, with the AMG alone, to the tolerance of the publication. iterations
   is 0 if this was not requested. */
typedef struct {
  PetscInt       iterations;
  PetscReal      condition;  /* beta: condition number of the preconditioned matrix, from the Lanczos process of CG */
  PetscReal      bound;      /* bound of the PCG iterations with PCAMGF: sqrt(2 (beta+3)/beta) times `iterations`,
                                for l1 smoothers */
  PetscLogDouble solve_time; /* AMG set-up and PCG [s] */
} RunContactFree;

/* Resident memory after each phase, summed over the ranks [bytes]. The solvers need the rest of the peak. */
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
  RUN_REFUSED         = 1, /* rejected input: the scene, an option or a file */
  RUN_FAILED          = 2, /* a load step did not converge */
  RUN_GAP_UNCONVERGED = 3, /* a load step ended with an inconsistent contact gap */
  RUN_ACCURACY_MISSED = 4, /* the requested accuracy was not reached */
  RUN_INTERRUPTED     = 5, /* ended by a signal */
  RUN_OUTPUT_LOST     = 6, /* results could not be written */
  RUN_BROKEN          = 7  /* out of memory, or an error in the program or in a library */
} RunEnd;

typedef struct {
  const char     *problem;
  const char     *units; /* "" if the scene states no units */
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
  PetscInt        nfigures;
  RunFigure      *figures;
  const char     *files;         /* names of the files that the run has written, each after a blank; NULL: none */
  PetscInt       *assemblies;    /* number of times that each body's tangent was assembled */
  PetscBool       finite_strain; /* whether any body has a law of finite strain */
  const Accuracy *accuracy;      /* choices and results of -accuracy; NULL: not requested */
  RunTimes        time;
  RunContactFree  contact_free;
  PetscLogDouble  peak_memory_bytes; /* largest resident memory, summed over the ranks */
  RunMemory       memory;
} RunReport;

#endif
