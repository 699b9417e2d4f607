#ifndef PATH_H
#define PATH_H

#include "src/state/stateimpl.h"

/* path.c: the last two states of equilibrium. Load step k ends at time k. */
struct _n_LoadPath {
  PetscReal time, previous_time;
  Vec       u, previous_u;
  PetscReal largest_increment;    /* of any displacement component in any step so far [length] */
  Vec       outside;              /* external forces at u [force]; NULL at the start: zero */
  PetscReal work;                 /* work of the external forces [force length] */
  Vec       contact;              /* contact forces at u, with friction only; NULL: zero [force] */
  PetscReal contact_work;         /* work of the contact forces [force length] */
  PetscReal energy;               /* of the bodies at u, with the plastic work [force length] */
  PetscReal unbalanced, turnover; /* in the present load step: work that is neither stored as energy nor taken up by
                                     contact; and the sum over solves of the largest of these three [force length] */
  PetscBool warned;               /* the imbalance has been warned of */
};

/* path.c */
PETSC_INTERN PetscErrorCode PathContinue(Simulation, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode PathPressureScale(Simulation, PetscReal time, PetscReal *scale);
PETSC_INTERN PetscErrorCode PathSolvesToCome(Simulation, PetscInt *);
PETSC_INTERN PetscErrorCode PathAdvance(LoadPath *, PetscReal time, Vec *u);

#endif
