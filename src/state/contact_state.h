#ifndef CONTACT_STATE_H
#define CONTACT_STATE_H

#include "src/state/stateimpl.h"

/* The contact rows of the last solve, and their results */
struct _n_ContactState {
  PetscContainer       subspace;      /* kept by the optimizer from one load step to the next; NULL before the first */
  ContactLinearization linearization; /* the contact linearization of the last solve */
  ContactLinearization upcoming;      /* the linearization at path->u, without ramps of initial overlaps */
  PetscReal           *pressure, *gap;
  PetscReal           *shear, *slip; /* two per contact row; NULL without friction */
  PetscInt             npoints;
  ContactPoint        *points;
};

#endif
