#ifndef CONTACT_HISTORY_H
#define CONTACT_HISTORY_H

#include "src/state/stateimpl.h"
#include "src/state/solution.h"

/* contact_history.c: data of the last solve by nonmortar vertex, for the next start */
struct _n_ContactHistory {
  PetscSection global;           /* the mesh's */
  PetscInt     npairs, nowned;   /* number of pairs; of nodes that this rank owns */
  PetscInt     first;            /* first global row of the owned nodes */
  PetscReal   *pressure, *slack; /* [npairs x nowned]; pressure 0 where there was no row */
  PetscBool   *open;             /* the gap is open and the pressure only the barrier's */
  PetscReal   *shear;            /* [3 npairs x nowned] friction force in global coordinates [force]; NULL: no
                                    friction */
  PetscReal   *settled;          /* friction force at the last state of equilibrium [force] */
  PetscReal   *friction;         /* friction forces on the vertices of both sides at that state [force] */
  PetscReal   *slip_path;        /* [npairs x nowned] length of all slip up to that state [length] */
  PetscReal   *dissipated;       /* work of friction up to that state [force length] */
};

PETSC_INTERN PetscErrorCode ContactHistoryCreate(DM, Scene, ContactHistory *);
PETSC_INTERN PetscInt       ContactHistoryIndex(const ContactHistory *, ContactLinearization, PetscInt row);
PETSC_INTERN PetscErrorCode ContactHistoryStore(ContactHistory *, ContactLinearization, const ContactSolution *,
  Vec slack, PetscReal stiffness);
PETSC_INTERN PetscErrorCode ContactHistoryRecall(const ContactHistory *, ContactLinearization, PetscReal scale,
  Vec slack, Vec pressure, PetscBool *any);
PETSC_INTERN PetscErrorCode ContactHistoryChange(const ContactHistory *, ContactLinearization, PetscReal *change);
PETSC_INTERN PetscErrorCode ContactHistoryFollowRows(const ContactHistory *, ContactLinearization solved,
  ContactLinearization, PetscInt                                                                **row);
PETSC_INTERN PetscErrorCode ContactHistoryFindClosed(const ContactHistory *, ContactLinearization, Vec closed);
PETSC_INTERN PetscErrorCode ContactHistoryFindLostRows(const ContactHistory *, ContactLinearization, PetscBool **lost,
  PetscInt *nlost);
PETSC_INTERN PetscErrorCode ContactHistoryLeastGap(const ContactHistory *, const PetscBool lost[], ContactLinearization,
  PetscReal *least);
PETSC_INTERN PetscErrorCode ContactHistoryDestroy(ContactHistory *);

#endif
