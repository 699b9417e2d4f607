/* Private header of the program contact */
#ifndef APPSIMPL_H
#define APPSIMPL_H

#include <petscamgf.h>
#include <scene.h>
#include <output.h>

typedef struct {
  char scene[PETSC_MAX_PATH_LEN], output[PETSC_MAX_PATH_LEN], summary[PETSC_MAX_PATH_LEN],
    checkpoint[PETSC_MAX_PATH_LEN], restart[PETSC_MAX_PATH_LEN], report[PETSC_MAX_PATH_LEN];
  PetscInt  checkpoint_every; /* number of load steps from one checkpoint to the next; 0: a checkpoint is written
                                 only if a signal ends the run */
  PetscInt  every;            /* fields are kept of every Nth load step, and of the last one; 0: of the last one */
  PetscBool write, gauss, restarts, summarize, contact_free, tables, check, quiet, page,
    vtk; /* the fields are also written as files of VTK */
} AppOptions;

/* State of main() for the handling of errors */
typedef struct {
  MPI_Comm  meeting;   /* communicator on which ranks with an error wait for one another */
  int       said;      /* file descriptor for messages; stderr may be silenced while output is written */
  PetscBool traceback; /* the user asked for PETSc's traceback */
  PetscBool silent;    /* another rank prints the message */
  int       end;       /* exit code of the program */
  PetscBool alone;     /* the error occurred on this rank only, and no other rank knows of it */
  char      sentence[1536];
} AppError;

/*
   errors.c: AppHandleError() is a handler of PETSc's errors and AppCrash() one of signals; the context of both is an
   AppError. AppLeave() ends the program after an error has returned through all callers.
*/
PETSC_INTERN PetscErrorCode AppHandleError(MPI_Comm, int line, const char *function, const char *file, PetscErrorCode,
  PetscErrorType, const char *message, void *ctx);
PETSC_INTERN PetscErrorCode AppCrash(int sig, void *ctx);
PETSC_INTERN void           AppLeave(const AppError *);

/* heap.c */
PETSC_INTERN void AppLimitHeap(void);

/* help.c: the help, and the texts of commands that run no scene, see AppAsksForText() */
PETSC_INTERN const char     AppHelp[];
PETSC_INTERN PetscBool      AppAsksForText(int argc, char **argv);
PETSC_INTERN PetscErrorCode AppSayText(const char word[]);
PETSC_INTERN PetscErrorCode AppGetVersions(char text[], size_t length);

/* options.c */
PETSC_INTERN PetscErrorCode AppGetOptions(int argc, char **argv, AppOptions *);
PETSC_INTERN PetscErrorCode AppCheckWords(int argc, char **argv);

/* deck.c */
PETSC_INTERN PetscErrorCode AppTranslateDeck(AppOptions *);

/* files.c: checks the names of all files, and that they can be written, before the run begins */
PETSC_INTERN PetscErrorCode AppGetCheckpointFile(const AppOptions *, Scene, char file[PETSC_MAX_PATH_LEN]);
PETSC_INTERN PetscErrorCode AppCheckFiles(const AppOptions *, Scene);

/* simulate.c: solves the scene on one mesh, or on the meshes of -accuracy, and writes the results */
PETSC_INTERN PetscErrorCode AppSolve(const AppOptions *, Scene, RunEnd *);

#endif
