/* Results on disk: HDF5 + XDMF time series for ParaView, and the machine-readable summary. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <petscdmplex.h>
#include <report.h>

/* The state at the end of one load step. Nodal surface fields are DM-ordered with 1 component a vertex. */
typedef struct {
  PetscInt         step;
  PetscReal        time;
  Vec              displacement; /* global, 3 a vertex [length] */
  const PetscReal *stress;       /* 7 values a local cell, ElasticityCellStress() */
  PetscInt         nrows;        /* contact rows of this rank */
  const PetscInt  *row_vertex;   /* their vertices (local DMPlex points) */
  const PetscReal *pressure;     /* contact pressure a row [force/length^2] */
  const PetscReal *gap;          /* gap a row [length] */
} OutputState;

typedef struct _n_Output *Output;

PETSC_EXTERN PetscErrorCode OutputCreate(DM, PetscInt nbodies, const char *const bodynames[], const char basename[], Output *);
PETSC_EXTERN PetscErrorCode OutputWrite(Output, const OutputState *);
PETSC_EXTERN PetscErrorCode OutputDestroy(Output *);
PETSC_EXTERN PetscErrorCode OutputCheckWritable(MPI_Comm, const char file[]);

PETSC_EXTERN PetscErrorCode ReportWriteJSON(MPI_Comm, const RunReport *, const char file[]);
PETSC_EXTERN PetscErrorCode ReportView(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewAccuracy(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewEffects(const RunReport *, PetscViewer);

#endif
