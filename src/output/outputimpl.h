#ifndef OUTPUTIMPL_H
#define OUTPUTIMPL_H

#include <output.h>
#include <petscviewerhdf5.h>

/* A step that has been written */
typedef struct {
  PetscInt  step;
  PetscReal time;
} OutputStep;

struct _n_Output {
  MPI_Comm    comm;
  DM          dm;
  char       *base; /* of the file names */
  PetscInt    nbodies;
  char      **bodynames;
  PetscInt    nvertices, ncells;          /* global */
  PetscInt    nowned, ncellslocal, first; /* vertices and cells of this rank; number of its first vertex */
  PetscInt    nsteps, maxsteps;
  OutputStep *steps;
};

/*
   A file appears whole or not at all: it is written under another name, <file>.part, and renamed. Collective; the error
   names the file.
*/
/* Every rank writes into the open viewer */
PETSC_INTERN PetscErrorCode FileWriteHDF5(MPI_Comm, const char file[], PetscErrorCode (*write)(PetscViewer, void *), void *ctx);
/* On the first rank fill() writes the stream; the others wait for the outcome */
PETSC_INTERN PetscErrorCode FileWriteText(MPI_Comm, const char file[], PetscErrorCode (*fill)(FILE *, const void *), const void *ctx);

PETSC_INTERN PetscErrorCode OutputGetMeshFile(Output, char file[], size_t length);
PETSC_INTERN PetscErrorCode OutputGetStepFile(Output, PetscInt step, char file[], size_t length);
PETSC_INTERN PetscErrorCode OutputWriteMesh(Output);
PETSC_INTERN PetscErrorCode OutputWriteFields(Output, const StepState *);
PETSC_INTERN PetscErrorCode OutputWriteXDMF(Output);

#endif
