/* Private header of the report: functions that add to it */
#ifndef REPORTIMPL_H
#define REPORTIMPL_H

#include "src/report/events.h"
#include <petscamgf.h>
#include <petsccompat.h>

/* Values that differ by less, relative to their size, are equal, and values that are smaller than others by this factor
   are zero: what is printed does not depend on rounding errors. */
#define REPORT_TIE  1e-6
#define REPORT_ZERO 1e-9

/* report.c */
PETSC_INTERN PetscErrorCode ReportWarn(MPI_Comm, RunReport *, const char place[], const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
PETSC_INTERN PetscErrorCode ReportReason(StepReport *, PetscBool converged, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(3, 4);
PETSC_INTERN void           ReportFailRun(RunReport *, StepReport *, RunEnd);
PETSC_INTERN PetscErrorCode ReportIterations(StepReport *, PetscInt n, const PetscInt iterations[]);
PETSC_INTERN PetscErrorCode ReportFallbacks(StepReport *, const TaoIPFilterFallbacks *);
PETSC_INTERN PetscErrorCode ReportGetCounts(KSP, PCAMGFCounts *);
PETSC_INTERN PetscErrorCode ReportPreconditioner(KSP, const PCAMGFCounts *before, StepReport *);

#endif
