/* Private header of the report: functions that add to it, and log events for the times of its phases */
#ifndef REPORTIMPL_H
#define REPORTIMPL_H

#include <report.h>
#include <petscamgf.h>
#include <petsccompat.h>

/* events.c */
PETSC_INTERN PetscLogEvent SIM_Mesh, SIM_SetUp, SIM_Assembly, SIM_Energy, SIM_Solve, SIM_Forces, SIM_Results,
  SIM_Comparison;

/* The solve without contact: its AMG counts to no other phase */
PETSC_INTERN PetscLogStage  SIM_ComparisonStage;
PETSC_INTERN PetscErrorCode StepEventsRegister(void);
PETSC_INTERN PetscErrorCode StepEventsRead(RunTimes *);
PETSC_INTERN PetscErrorCode StepEventsGetTimes(MPI_Comm, const RunTimes *start, RunTimes *);

/* report.c */
PETSC_INTERN PetscErrorCode ReportWarn(MPI_Comm, RunReport *, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(3, 4);
PETSC_INTERN PetscErrorCode ReportReason(StepReport *, PetscBool converged, const char reason[]);
PETSC_INTERN PetscErrorCode ReportIterations(StepReport *, PetscInt n, const PetscInt iterations[]);
PETSC_INTERN PetscErrorCode ReportFallbacks(StepReport *, const TaoIPFilterFallbacks *);
PETSC_INTERN PetscErrorCode ReportGetCounts(KSP, PCAMGFCounts *);
PETSC_INTERN PetscErrorCode ReportPreconditioner(KSP, const PCAMGFCounts *before, StepReport *);

#endif
