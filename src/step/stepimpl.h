#ifndef STEPIMPL_H
#define STEPIMPL_H

#include <step.h>
#include <mesh.h>
#include <elasticity.h>
#include <gap.h>
#include <petscamgf.h>

/* Prescribed displacements of the whole scene: owned global rows, ascending, and their values at load factor 1 */
typedef struct {
  PetscInt   n;
  PetscInt  *rows;
  PetscReal *values; /* [length] */
} Prescribed;

/*
   min E(u) s.t. g + J (u - base) >= 0 about the state `base`, which holds the prescribed displacements of the step:
   E(u) = energy + force^T w + 1/2 w^T K w, w = u - base. w vanishes on prescribed rows.
*/
typedef struct {
  Mat       K;
  Vec       base;
  Vec       force; /* dE/du at base, zero on prescribed rows [force] */
  PetscReal energy;
  Mat       J; /* NULL without contact; columns of prescribed rows are zero */
  Vec       g;
  Vec       w, Kw;
} QuadraticModel;

/* Pressure and slack of the last step by nonmortar vertex, for the next step's warm start */
typedef struct {
  PetscInt   npairs, vstart, vend;
  PetscReal *pressure, *slack; /* npairs x (vend - vstart); pressure 0 where no row was */
} ContactMemory;

/* The state at the end of the last two load steps */
typedef struct {
  PetscReal load, previous_load;
  Vec       u, previous_u;
} LoadPath;

struct _n_Simulation {
  MPI_Comm             comm;
  Scene                scene;
  DM                   dm;
  Elasticity           elasticity;
  Contact              contact; /* NULL when the scene names no pair */
  Prescribed           prescribed;
  Mat                  K;
  Vec                  mass;
  LoadPath             path;
  ContactMemory        memory;
  ContactLinearization linearization; /* of the last step */
  PetscReal           *pressure, *gap, *stress;
  PetscBool            warm; /* later load steps start from the path and pressures of the last */
  RunReport            report;
  PetscLogDouble       start;
};

/* What a solved step left behind, beside the displacement */
typedef struct {
  Vec pressure; /* one a row */
  Vec gap;      /* linearized, one a row */
} ContactSolution;

PETSC_INTERN PetscLogEvent SIM_Mesh, SIM_Assembly, SIM_Contact, SIM_Solve;

PETSC_INTERN PetscErrorCode PrescribedCreate(DM, PetscInt, const SceneDisplacement[], Prescribed *);
PETSC_INTERN PetscErrorCode PrescribedApply(const Prescribed *, PetscReal load, Vec u);
PETSC_INTERN PetscErrorCode PrescribedZero(const Prescribed *, Vec);
PETSC_INTERN PetscErrorCode PrescribedSum(const Prescribed *, Vec, PetscReal sum[3]);
PETSC_INTERN PetscErrorCode PrescribedDestroy(Prescribed *);

PETSC_INTERN PetscErrorCode QuadraticCreate(Simulation, PetscReal load, QuadraticModel *);
PETSC_INTERN PetscErrorCode QuadraticSetContact(QuadraticModel *, const Prescribed *, ContactLinearization, Vec u_linearized);
PETSC_INTERN PetscErrorCode QuadraticDestroy(QuadraticModel *);
PETSC_INTERN PetscErrorCode QuadraticSolveFree(QuadraticModel *, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode QuadraticSolveContact(Simulation, QuadraticModel *, Vec u, StepReport *, ContactSolution *);

PETSC_INTERN PetscErrorCode ContactMemoryCreate(DM, PetscInt npairs, ContactMemory *);
PETSC_INTERN PetscErrorCode ContactMemoryStore(ContactMemory *, ContactLinearization, const ContactSolution *, Vec slack);
PETSC_INTERN PetscErrorCode ContactMemoryRecall(const ContactMemory *, ContactLinearization, PetscReal scale, Vec slack, Vec pressure, PetscBool *any);
PETSC_INTERN PetscErrorCode ContactMemoryDestroy(ContactMemory *);

PETSC_INTERN PetscErrorCode ReportStepForces(Simulation, const QuadraticModel *, Vec u, const ContactSolution *, StepReport *);
PETSC_INTERN PetscErrorCode ReportPreconditioner(KSP, StepReport *);
PETSC_INTERN PetscErrorCode ReportTimes(Simulation, RunReport *);

#endif
