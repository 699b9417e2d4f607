/* Results on disk: HDF5 + XDMF time series for ParaView, and the machine-readable summary. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <petscdmplex.h>
#include "report.h"

typedef struct _n_Output *Output;

PETSC_EXTERN PetscErrorCode OutputCreate(DM, PetscInt nbodies, const char *const bodynames[], const char basename[],
  Output *);
PETSC_EXTERN PetscErrorCode OutputContinue(Output, PetscInt step, PetscBool same);
PETSC_EXTERN PetscErrorCode OutputWrite(Output, const StepState *);
PETSC_EXTERN PetscErrorCode OutputDestroy(Output *);
PETSC_EXTERN PetscErrorCode OutputCheckWritable(MPI_Comm, const char file[]);

PETSC_EXTERN PetscErrorCode ReportWriteJSON(MPI_Comm, const RunReport *, const char file[]);
PETSC_EXTERN PetscErrorCode ReportView(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewAccuracy(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewNextMesh(const Accuracy *, PetscInt refine, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewEffects(const RunReport *, PetscViewer);

#endif
