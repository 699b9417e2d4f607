#ifndef CONTACT_STATE_H
#define CONTACT_STATE_H

#include "src/state/stateimpl.h"

/* Contact rows of the last solve, and the results at these rows. */
struct _n_ContactState {
  PetscContainer       subspace;      /* subspace, which the optimizer reuses in later load steps; NULL before the
                                         first solve */
  ContactLinearization linearization; /* linearization with which the last solve was done */
  ContactLinearization upcoming;      /* linearization at path->u for the next load step, in which initial overlaps
                                         are applied fully; NULL: not computed */
  PetscReal           *pressure, *gap;
  PetscReal           *shear, *slip; /* two components per contact row, along its tangents; NULL without friction */
  PetscInt             npoints;
  ContactPoint        *points;
};

#endif
