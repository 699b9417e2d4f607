#ifndef SOLUTION_H
#define SOLUTION_H

#include "src/state/stateimpl.h"

/* solution.c: solution at the contact rows of one solve. */
struct _n_ContactSolution {
  Vec pressure; /* contact pressure of each row [force/length^2] */
  Vec gap;      /* linearized gap of each row [length] */
  Vec yield;  /* depth by which soft pairs yield [length]; NULL if no pair is soft. No row has a negative gap + yield */
  Vec stored; /* energy that soft pairs store per force [length]; NULL if no pair is soft */
  Vec shear;  /* friction forces along the two tangents of each row [force]; NULL without friction */
  Vec slip;   /* slip since the last equilibrium state along the two tangents of each row [length]; NULL without
                   friction */
};

PETSC_INTERN PetscErrorCode ContactSolutionCreate(Vec rows, ContactSolution *);
PETSC_INTERN PetscErrorCode ContactSolutionDestroy(ContactSolution *);

#endif
