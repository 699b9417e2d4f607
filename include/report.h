/* What a run reports about itself: filled by src/step, written by src/output. */
#ifndef REPORT_H
#define REPORT_H

#include <petscsys.h>

typedef struct {
  PetscInt    step;
  PetscReal   load;
  PetscInt    constraints;
  PetscInt    filter_dofs;
  PetscInt    ip_iterations;
  PetscInt   *ksp_iterations; /* one a Newton system, nksp values */
  PetscInt    nksp;
  PetscInt    amg_applications, amg_setups;
  PetscInt    substeps, cuts;         /* solves of equilibrium in this load step; how often it was cut */
  PetscInt    contact_updates;        /* linearizations of the gap in the last solve */
  PetscInt    regularizations;        /* Newton systems whose matrix was not positive definite */
  PetscInt    systems, filtered_systems; /* condensed systems; those solved with the filter, the others needed the AMG alone */
  PetscReal   energy;                 /* elastic, from the elements [force length] */
  PetscReal   potential;              /* what was minimized: energy - work of dead loads; of the quadratic model if there is one [force length] */
  PetscReal   equilibrium;            /* norm of internal + contact - dead forces on the free rows over that of all internal forces */
  PetscReal   kkt_error;              /* scaled, dimensionless */
  PetscReal   kkt_error_unscaled;
  PetscReal   gap_min;                /* smallest linearized gap [length]; negative is penetration */
  PetscReal   gap_true;               /* smallest gap of the deformed bodies [length] */
  PetscReal   gap_change;             /* largest difference of the two where there is pressure, or penetration [length] */
  PetscBool   gap_untrue;             /* the limit on linearizations came before the gap was true */
  PetscReal   complementarity;        /* max s z [force/length] */
  PetscReal   action_reaction;        /* |sum of the contact forces on both sides| over the sum of the sizes of the vertices' */
  PetscReal   error_estimate;         /* discretization error in the energy norm over sqrt(2 energy); its square is the relative error in energy */
  PetscReal  *body_errors;            /* parts of the bodies, whose squares sum to its square; NULL: no estimate was made */
  PetscReal   contact_force[3];       /* on the nonmortar side [force] */
  PetscReal   reaction[3];            /* on the driven rows, whose prescribed displacement is not zero; on all prescribed rows if none is [force] */
  PetscLogDouble solve_time;          /* optimizer alone, its linear solves included [s] */
  PetscBool   converged;
  const char *reason;
} StepReport;

/* What a scene may call for. An effect that is off was neither allocated nor assembled nor solved */
typedef struct {
  const char    *name;
  PetscBool      on;
  char           why[160];
  PetscLogDouble time; /* [s]; negative: part of another phase, not measured apart */
} RunEffect;

typedef struct {
  const char *problem;
  PetscMPIInt ranks;
  PetscInt    dofs, refine;
  PetscBool   converged;
  const char *reason;
  PetscInt    nsteps;
  StepReport *steps;
  PetscInt    nbodies;
  const char **bodies;
  PetscInt   *assemblies; /* of each body's tangent */
  PetscInt    neffects;
  RunEffect  *effects;
  struct {
    PetscLogDouble total, mesh, assembly, contact, amg_setup, amg_apply, filter_setup, filter_apply, error_estimate, other; /* [s], max over ranks */
  } time;
  struct { /* one contact-free PCG solve with the AMG alone, to the same tolerance as published; iterations = 0: not asked for */
    PetscInt       iterations;
    PetscReal      condition; /* beta, condition number of the preconditioned matrix from CG's Lanczos process */
    PetscReal      bound;     /* sqrt(2 (beta+3)/beta) iterations: PCG iterations amgf may need (l1 smoother) */
    PetscLogDouble solve_time; /* AMG set-up and PCG [s] */
  } contact_free;
  PetscLogDouble peak_memory_bytes; /* sum over ranks of the resident set's high-water mark */
  struct { /* resident set when the phase ended, summed over ranks [bytes]; what is left to the peak is the solvers' */
    PetscLogDouble start, mesh, assembly;
  } memory;
} RunReport;

#endif
