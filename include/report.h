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
  PetscReal   energy;                 /* [force length] */
  PetscReal   kkt_error;              /* scaled, dimensionless */
  PetscReal   kkt_error_unscaled;
  PetscReal   gap_min;                /* smallest linearized gap [length]; negative is penetration */
  PetscReal   complementarity;        /* max s z [force/length] */
  PetscReal   contact_force[3];       /* on the nonmortar side [force] */
  PetscReal   reaction[3];            /* on the driven rows, whose prescribed displacement is not zero; on all prescribed rows if none is [force] */
  PetscLogDouble solve_time;          /* optimizer alone, its linear solves included [s] */
  PetscBool   converged;
  const char *reason;
} StepReport;

typedef struct {
  const char *problem;
  PetscMPIInt ranks;
  PetscInt    dofs, refine;
  PetscBool   converged;
  const char *reason;
  PetscInt    nsteps;
  StepReport *steps;
  struct {
    PetscLogDouble total, mesh, assembly, contact, amg_setup, amg_apply, filter_setup, filter_apply, other; /* [s], max over ranks */
  } time;
  struct { /* one contact-free PCG solve with the AMG alone, to the same tolerance as published; iterations = 0: not asked for */
    PetscInt       iterations;
    PetscReal      condition; /* beta, condition number of the preconditioned matrix from CG's Lanczos process */
    PetscReal      bound;     /* sqrt(2 (beta+3)/beta) iterations: PCG iterations amgf may need (l1 smoother) */
    PetscLogDouble solve_time; /* AMG set-up and PCG [s] */
  } contact_free;
  PetscLogDouble peak_memory_bytes; /* sum over ranks of the resident set's high-water mark */
} RunReport;

#endif
