/* What a run leaves, its state and what it reports about itself: filled by src/step, written by src/output. */
#ifndef REPORT_H
#define REPORT_H

#include <petscamgf.h>

/* Moments are about the origin, forces taken at the deformed places */

/* A contact pair: the action on one side and the reaction on the other, each summed over the rows of this pair alone */
typedef struct {
  const char *name;
  PetscReal   force[3];         /* on the nonmortar side [force] */
  PetscReal   moment[3];        /* [force length] */
  PetscReal   mortar_force[3];  /* on the mortar side [force] */
  PetscReal   mortar_moment[3]; /* [force length] */
  PetscReal   normal_force; /* sum of the sizes of the rows' forces: the integral of the pressure, the size of the force
                               where the face is plane [force] */
  PetscReal   area;         /* covered area about the vertices in contact [length^2] */
  PetscReal   pressure;     /* largest of the contact pressure's field [force/length^2] */
  PetscReal   penetration;  /* of the deepest vertex of either face in the other body [length] */
  PetscReal   coarseness;   /* size of the nonmortar side's facets over the mortar side's; 0: there is no contact */
  PetscBool   narrow;       /* the contact, if any, is one facet of the nonmortar side wide */
  PetscReal   penetration_rounding; /* what it is known to where faces are curved [length] */
  PetscBool   rubs;                 /* has friction */
  PetscReal   shear_force;          /* sum of the sizes of the rows' forces of friction [force] */
  PetscReal   stick_area;           /* covered area about the vertices in contact that friction holds, */
  PetscReal   slip_area;            /* and about those that slip against it [length^2]; both 0 without friction */
  PetscReal   dissipated; /* work of friction since the start, by the trapezoidal rule over all solves [force length] */
} PairReport;

/* A face with prescribed displacements, symmetry planes too. Where several prescribe one row they share its reaction
   evenly */
typedef struct {
  const char *name;
  PetscReal   reaction[3]; /* on the body [force] */
  PetscReal   moment[3];   /* [force length] */
} FaceReport;

/* A load program at the end of a load step */
typedef struct {
  const char *name;
  PetscReal   factor;
} RampReport;

/* A point of a probe. Stress is interpolated from the nodes' */
typedef struct {
  const char *name;
  PetscReal   arc;             /* from the beginning of its line; 0 of a point [length] */
  PetscReal   place[3];        /* undeformed [length] */
  PetscReal   displacement[3]; /* [length] */
  PetscReal   stress_xx, stress_yy, stress_zz, stress_xy, stress_yz, stress_zx, von_mises, principal_1, principal_2,
    principal_3; /* [force/length^2] */
  PetscReal contact_pressure, contact_gap,
    contact_status; /* [force/length^2], [length], 1 closed 0 open; NaN: on no face of a pair */
} ProbeReport;

/* All forces on a body: from its sides of the pairs, its faces, and the dead loads */
typedef struct {
  const char *name;
  PetscReal   contact[3], reaction[3], springs[3], ties[3], load[3]; /* [force] */
  PetscReal   residual[3];                                           /* their sum [force] */
  PetscReal   balance; /* its size over the sum of the sizes of each pair's, face's and the loads' force */
} BodyReport;

typedef struct {
  PetscInt  step;
  PetscReal time; /* load step k ends at time k */
  PetscReal load;
  PetscInt  constraints;
  PetscInt  filter_dofs;
  PetscInt  ip_iterations;
  PetscInt *ksp_iterations; /* one a Newton system, nksp values */
  PetscInt  nksp;
  PetscInt  amg_applications, amg_setups;
  PetscInt  substeps, cuts;  /* solves of equilibrium in this load step; how often it was cut */
  PetscInt  contact_updates; /* linearizations of the gap in the last solve */
  PetscInt  regularizations; /* Newton systems whose matrix was not positive definite */
  PetscBool factored;        /* MUMPS has taken the place of AMG: its applications are solves with the factors */
  PetscInt  systems,
    filtered_systems;          /* condensed systems; those solved with the filter, the others needed the AMG alone */
  TaoIPFilterFallbacks linear; /* linear solves that took more than the Krylov method by itself */
  PetscReal            energy; /* elastic, from the elements [force length] */
  PetscReal work; /* of the dead loads and of the reactions on driven faces since the start, by the trapezoidal rule
                     over all solves [force length] */
  PetscReal contact_work; /* what the contacts took up since the start, by the same rule: that of friction, and what
                             normal forces do; 0 where no pair rubs [force length] */
  PetscReal normal_work;  /* what of it is no friction: of gaps that close in a step, and of what the linearized contact
                             leaves [force length] */
  PetscReal imbalance; /* of this load step: work that is neither stored nor taken up by the contacts, over the largest
                             of the three; NaN: no pair rubs, or bodies expand by heat */
  PetscReal potential; /* what was minimized: energy - work of dead loads; of the quadratic model if there is one [force
                          length] */
  PetscReal
    equilibrium;       /* norm of internal + contact - dead forces on the free rows over that of all internal forces */
  PetscReal kkt_error; /* scaled, dimensionless */
  PetscReal kkt_error_unscaled;
  PetscReal gap_min;      /* smallest linearized gap [length]; negative is penetration, NaN no contact rows */
  PetscReal gap_true;     /* smallest gap of the deformed bodies [length]; NaN: no faces within reach of each other */
  PetscReal gap_change;   /* largest difference of the two where there is pressure, or penetration [length] */
  PetscReal normals_turn; /* what the contact forces stand askew by, over their sizes: the normals of the last
                             linearization against those of the state; of the pair where it is largest */
  PetscReal slip_change;  /* largest difference of the linearized slip and that of the state where there is pressure
                             [length] */
  PetscReal untruth;      /* largest of gap_change, of slip_change, and of what the turning counts for [length] */
  PetscBool gap_untrue;   /* that is more than the tolerance: the limit on linearizations came first */
  PetscInt  gap_damped;   /* linearizations made short of where they would be, because the solutions got no truer */
  PetscReal complementarity; /* max s z [force/length] */
  PetscReal algebraic_error; /* in the energy, relative: what products of gap and pressure, forces out of balance and an
                                untrue gap are worth */
  PetscReal gap_error;       /* what of it is the untrue gap's */
  PetscReal action_reaction; /* |sum of the contact forces on both sides| over the sum of the sizes of the vertices' */
  PetscReal error_estimate;  /* discretization error in the energy norm over sqrt(2 energy); its square is the relative
                                error in energy; NaN: no estimate was made */
  PetscReal motion;          /* largest component of the displacement; 0 without contact [length] */
  PetscReal   *body_errors;  /* parts of the bodies, whose squares sum to its square; NULL: none was made */
  PetscReal    contact_force[3]; /* on the nonmortar side, the vector sum of the pairs' [force] */
  PetscReal    reaction[3]; /* on the driven rows, whose prescribed displacement is not zero; on all prescribed rows if
                             none is [force] */
  PetscInt     nramps;      /* of the scene, the load itself first */
  RampReport  *ramps;
  PetscInt     npairs; /* of the scene, in its order; 0 before the first solve that converged */
  PairReport  *pairs;
  PetscInt     nfaces; /* with prescribed displacements, in the order in which the scene names them first */
  FaceReport  *faces;
  PetscInt     nbodies;
  BodyReport  *bodies;
  PetscReal    dissipated;        /* by friction, all pairs since the start [force length] */
  PetscReal    balance;           /* largest of the bodies' */
  PetscReal    weak_spring_force; /* sum of the sizes of the forces at the vertices [force] */
  PetscInt     nprobes;           /* of the scene: points */
  ProbeReport *probes;
  PetscInt     nlines; /* points of all lines in turn */
  ProbeReport *lines;
  PetscLogDouble solve_time; /* optimizer alone, its linear solves included [s] */
  PetscLogDouble step_time;  /* all of the load step but what is written of it [s] */
  PetscBool      converged;
  const char    *reason;
} StepReport;

/*
   A vertex on either side of a contact pair. Over a side, the sum of pressure x area is the pair's normal_force, that
   of force its force on that side. The pressure of a vertex that is covered much less than its neighbours is counted
   with theirs: its own area and pressure are zero.
*/
typedef struct {
  PetscInt  pair, vertex; /* of the scene; a local DMPlex point that this rank owns */
  PetscReal pressure;     /* [force/length^2] */
  PetscReal area;         /* of the other side's cover that the pressure stands for [length^2] */
  PetscReal gap;          /* mean over the cover, linearized [length] */
  PetscReal force[3];     /* on the vertex [force] */
  PetscReal shear[3];     /* of friction, on the vertex's side [force/length^2] */
  PetscReal slip[3];      /* of the other side since the last solve [length] */
  PetscReal slip_path;    /* length of its way since the start [length] */
  PetscBool closed, slips;
  PetscBool presses; /* most of its area is of constraints that press: what the mortar side does not resolve is open */
} ContactPoint;

/* Of a stress: xx yy zz xy yz zx, von Mises, the principal values with the largest first */
#define STRESS_VALUES 10

/* The state at the end of a load step; borrowed, valid until the next one. What SimulationSetFields() did not ask for
   is NULL */
typedef struct {
  const StepReport   *report;
  Vec                 displacement; /* global, 3 a vertex [length] */
  const PetscReal    *stress;       /* 7 values a local cell, see ElasticityCellStress() */
  const PetscReal    *nodal;        /* STRESS_VALUES a vertex that this rank owns, in the order of global vectors */
  const PetscReal    *density;      /* strain energy per undeformed volume, one a local cell [force/length^2] */
  PetscInt            nquadrature;  /* quadrature points of this rank */
  const PetscReal    *quadrature;   /* 3 coordinates each, undeformed [length] */
  const PetscReal    *quadrature_stress; /* 6 values each [force/length^2] */
  PetscInt            npoints;           /* of contact, of this rank */
  const ContactPoint *points;            /* pair by pair */
} StepState;

/* What a scene may call for. An effect that is off was neither allocated nor assembled nor solved */
typedef struct {
  const char    *name;
  PetscBool      on;
  char           why[160];
  PetscLogDouble time; /* [s]; NaN: part of another phase, not measured apart */
} RunEffect;

/* What a mesh attained. Values are those of all load steps in turn */
typedef struct {
  PetscInt   refine, dofs;
  PetscInt   mesh;      /* number of the mesh, from 0 */
  PetscBool  raised;    /* it is the one before with a higher order */
  PetscReal *energy;    /* [force length] */
  PetscReal *force;     /* of each pair its size, and the sum of the sizes of its rows' [force] */
  PetscReal *pressure;  /* of each pair the largest [force/length^2] */
  PetscReal *displaced; /* of each point of the scene's probes, 3 components [length] */
  PetscReal  recovery;  /* relative error in energy by stress recovery, largest of the load steps */
  PetscReal  change;    /* relative change of energy or of any pair's force since the coarser mesh, largest of the load
                           steps; NaN: there was none */
  PetscReal  growth;    /* unknowns over those of the coarser mesh; NaN as well */
  PetscReal  error;  /* of the mesh, relative, in energy and contact force: from the change, without a coarser mesh from
                      recovery */
  PetscBool  unseen; /* it changed by more than recovery accounts for */
  PetscReal  algebraic; /* of the solver, relative, in energy */
  PetscInt   amg_applications;
  PetscLogDouble time; /* [s] */
} AccuracyLevel;

typedef struct {
  MPI_Comm  comm;
  PetscReal target;   /* relative error in energy and contact force; 0: accuracy is not asked for */
  PetscReal share;    /* of it that the solver may leave */
  PetscInt  max_dofs; /* of a mesh */
  PetscBool contact;  /* the scene has contact pairs */
  PetscReal
    tolerance; /* of the optimizer with contact, of the linear solver without; after a run the one that it had */
  PetscBool      given;            /* by the user: it stays */
  PetscReal      update_tolerance; /* of the gap, relative to the largest displacement */
  PetscInt       updates;          /* linearizations of the gap a load step may take */
  PetscInt       of;               /* what is to be accurate: AccuracyTargets */
  PetscBool      adaptive;         /* cells are refined where the error is */
  PetscInt       order;            /* of the bodies from the second mesh on; 0: as the scene has it */
  PetscInt       mesh;             /* number of the next run's mesh, from 0 */
  PetscReal      growth;           /* unknowns of the next mesh, by those of this one */
  PetscInt       nlevels;
  AccuracyLevel *levels;
  PetscBool      reached;
  char           end[160]; /* why the last mesh is the last */
} Accuracy;

/* One contact-free PCG solve with the AMG alone, to the same tolerance as published; iterations = 0: not asked for */
typedef struct {
  PetscInt       iterations;
  PetscReal      condition;  /* beta, condition number of the preconditioned matrix from CG's Lanczos process */
  PetscReal      bound;      /* sqrt(2 (beta+3)/beta) iterations: PCG iterations amgf may need (l1 smoother) */
  PetscLogDouble solve_time; /* AMG set-up and PCG [s] */
} RunContactFree;

/* Resident set when the phase ended, summed over ranks [bytes]; what is left to the peak is the solvers' */
typedef struct {
  PetscLogDouble start, mesh, assembly;
} RunMemory;

/* [s], the largest over the ranks; what is not in a phase is in other */
typedef struct {
  PetscLogDouble total, mesh, assembly, contact, amg_setup, amg_apply, filter_setup, filter_apply, error_estimate,
    results, other;
} RunTimes;

/* How a run ended: the exit code of a program. After the run what the operating system made of it may come first */
typedef enum {
  RUN_CONVERGED       = 0,
  RUN_REFUSED         = 1, /* bad input: the scene, an option, a file */
  RUN_FAILED          = 2, /* a load step did not converge */
  RUN_GAP_UNTRUE      = 3, /* a load step converged to a gap that is not true */
  RUN_ACCURACY_MISSED = 4, /* the accuracy asked for was not reached */
  RUN_INTERRUPTED     = 5, /* by a signal */
  RUN_OUTPUT_LOST     = 6, /* results could not be written */
  RUN_BROKEN          = 7  /* no memory, or a fault of the program or of a library */
} RunEnd;

typedef struct {
  const char     *problem;
  const char     *units; /* "" where the scene does not say them */
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
  PetscInt       *assemblies; /* of each body's tangent */
  const Accuracy *accuracy;   /* what -accuracy chose and attained; NULL: not asked for */
  PetscInt        neffects;
  RunEffect      *effects;
  RunTimes        time;
  RunContactFree  contact_free;
  PetscLogDouble  peak_memory_bytes; /* sum over ranks of the resident set's high-water mark */
  RunMemory       memory;
} RunReport;

#endif
