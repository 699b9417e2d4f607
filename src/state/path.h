#ifndef PATH_H
#define PATH_H

#include "src/state/stateimpl.h"

/* path.c: the last two equilibrium states. Load step k ends at time k. */
struct _n_LoadPath {
  PetscReal time, previous_time;
  Vec       u, previous_u;
  PetscReal largest_increment;    /* largest increment of any displacement component in any load step so far [length] */
  Vec       outside;              /* external forces at u [force]; NULL at the start, where they are zero */
  PetscReal work;                 /* work of the external forces since the start [force length] */
  Vec       contact;              /* contact forces at u [force]; computed only with friction; NULL: zero */
  PetscReal contact_work;         /* work of the contact forces since the start [force length] */
  PetscReal energy;               /* strain energy of the bodies at u plus the plastic work [force length] */
  PetscReal unbalanced, turnover; /* `unbalanced`: work in the present load step that is neither stored as energy nor
                                     taken up by contact [force length]; `turnover`: sum over the solves of this load
                                     step of the largest of external work, energy and contact work [force length] */
  PetscBool presses;              /* whether a pair with friction has contact forces at u */
  PetscBool pressed;              /* whether one had such forces in the present load step, also at its begin */
  PetscReal told; /* imbalance of the last warning, or part of the energy that contact gives (step.c); 0: none */
};

/* path.c */
PETSC_INTERN PetscErrorCode PathContinue(Model, State, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode PathIsSmooth(Model, State, PetscReal time, PetscBool *smooth);
PETSC_INTERN PetscErrorCode PathPressureScale(Model, State, PetscReal time, PetscReal *scale);
PETSC_INTERN PetscErrorCode PathAdvance(LoadPath *, PetscReal time, Vec *u);

#endif
