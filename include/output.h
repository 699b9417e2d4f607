/* Results on disk: HDF5 + XDMF time series for ParaView, and the machine-readable summary. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <petscdmplex.h>
#include "report.h"

typedef struct _n_Output *Output;

PETSC_EXTERN PetscErrorCode OutputCreate(DM, PetscInt nbodies, const char *const bodynames[],
  const char *const surfaces[], const char basename[], Output *);
PETSC_EXTERN PetscErrorCode OutputSetUnits(Output, const char units[]);
PETSC_EXTERN PetscErrorCode OutputSetEvery(Output, PetscInt every);
PETSC_EXTERN PetscErrorCode OutputContinue(Output, PetscInt step, PetscReal increment, PetscBool same);
PETSC_EXTERN PetscErrorCode OutputWrite(Output, const StepState *);
PETSC_EXTERN PetscErrorCode OutputDestroy(Output *);
PETSC_EXTERN PetscErrorCode OutputCheckWritable(MPI_Comm, const char file[]);

/* A file that a run reads or writes in addition to the results that OutputCreate() creates */
typedef struct {
  const char *role; /* what the file is for, or the option that names it; used in messages */
  const char *name; /* NULL: the run has no such file */
  PetscBool   written;
} OutputFile;

PETSC_EXTERN PetscErrorCode OutputCheckDistinct(MPI_Comm, PetscInt n, const OutputFile[], const char base[]);

/* Data for the HTML page of a run, and for its files for programs that do not read XDMF */
typedef struct {
  char file[PETSC_MAX_PATH_LEN]; /* the page; "": none */
  char vtk[PETSC_MAX_PATH_LEN];  /* the list of the files of VTK; "": none */
  char base[PETSC_MAX_PATH_LEN]; /* base name of the fields' files */
  char summary[PETSC_MAX_PATH_LEN], scene[PETSC_MAX_PATH_LEN];
  char command[4096], versions[512];
} ReportPage;

PETSC_EXTERN PetscErrorCode ReportPageCheck(MPI_Comm, const char file[]);
PETSC_EXTERN PetscErrorCode OutputCheckVTK(MPI_Comm, const char file[]);
PETSC_EXTERN int            ReportPageMake(const ReportPage *, char sentence[], size_t length);
PETSC_EXTERN int            OutputMakeVTK(const ReportPage *, char sentence[], size_t length);
PETSC_EXTERN PetscErrorCode ReportWriteJSON(MPI_Comm, const RunReport *, const char file[]);
PETSC_EXTERN PetscErrorCode ReportView(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewTables(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewAccuracy(const RunReport *, PetscViewer);
PETSC_EXTERN PetscErrorCode ReportViewNextMesh(const Accuracy *, PetscInt refine, PetscViewer);

#endif
