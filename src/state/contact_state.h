#ifndef CONTACT_STATE_H
#define CONTACT_STATE_H

#include "src/state/solution.h"

/* Contact rows of the last solve, and the results at these rows. */
struct _n_ContactState {
  PetscContainer       subspace;      /* subspace, which the optimizer reuses in later load steps; NULL before the
                                         first solve */
  ContactLinearization linearization; /* linearization with which the last solve was done */
  ContactLinearization upcoming;      /* linearization at path->u for the next load step, in which initial overlaps
                                         are applied fully; NULL: not computed */
  ContactSolution      solution;      /* solution at the rows of `linearization`; NULL before the first solve */
  PetscInt             npoints;
  ContactPoint        *points;
};

#endif
