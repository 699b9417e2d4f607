#ifndef SOLUTION_H
#define SOLUTION_H

#include "src/state/stateimpl.h"

/* solution.c: the solution at the contact rows of one solve */
struct _n_ContactSolution {
  Vec pressure; /* one per row [force/length^2] */
  Vec gap;      /* linearized gap, one per row [length] */
  Vec shear;    /* friction forces along the two tangents of each row [force]; NULL: no friction */
  Vec slip;     /* slip since the last state along the two tangents of each row [length] */
};

PETSC_INTERN PetscErrorCode ContactSolutionCreate(Vec rows, ContactSolution *);
PETSC_INTERN PetscErrorCode ContactSolutionDestroy(ContactSolution *);

#endif
