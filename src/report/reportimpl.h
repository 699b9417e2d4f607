/* Private header of the report: functions that add to it */
#ifndef REPORTIMPL_H
#define REPORTIMPL_H

#include "src/report/events.h"
#include <petscamgf.h>
#include <petsccompat.h>

/* report.c */
PETSC_INTERN PetscErrorCode ReportWarn(MPI_Comm, RunReport *, const char place[], const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
PETSC_INTERN PetscErrorCode ReportReason(StepReport *, PetscBool converged, const char reason[]);
PETSC_INTERN PetscErrorCode ReportIterations(StepReport *, PetscInt n, const PetscInt iterations[]);
PETSC_INTERN PetscErrorCode ReportFallbacks(StepReport *, const TaoIPFilterFallbacks *);
PETSC_INTERN PetscErrorCode ReportGetCounts(KSP, PCAMGFCounts *);
PETSC_INTERN PetscErrorCode ReportPreconditioner(KSP, const PCAMGFCounts *before, StepReport *);

#endif
