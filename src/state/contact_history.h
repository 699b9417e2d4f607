#ifndef CONTACT_HISTORY_H
#define CONTACT_HISTORY_H

#include "src/state/stateimpl.h"
#include "src/state/solution.h"

/* contact_history.c: results of the last solve by nonmortar vertex, from which the next solve starts. */
struct _n_ContactHistory {
  PetscSection global;           /* global section of the DM, which numbers the vertices */
  PetscInt     npairs, nowned;   /* number of contact pairs, and of nodes that this rank owns */
  PetscInt     first;            /* first global row of the displacement on this rank */
  PetscReal   *pressure, *slack; /* [npairs x nowned] pressure [force/length^2] and slack [length]; the pressure is 0
                                    if there was no row */
  PetscReal   *yield;      /* [npairs x nowned] depth by which soft pairs yield; the gap is slack - yield [length] */
  PetscBool   *open;       /* [npairs x nowned] true if the gap is open, so that the pressure comes from the
                                    barrier term only */
  PetscBool   *released;   /* [npairs x nowned] true if a vertex that must stick has opened in this load step, so
                                    that it is free until the end of the step */
  PetscBool    frictional; /* true if a pair has friction; also on a rank that owns no nodes */
  PetscReal   *shear;      /* [3 npairs x nowned] friction force in global coordinates [force]; NULL without
                                    friction */
  PetscReal   *shift;      /* [3 npairs x nowned] slip of a vertex that must stick before it has stuck at another
                                    place in this load step [length]; NULL without friction */
  PetscReal   *settled;    /* [3 npairs x nowned] friction force at the last state of equilibrium [force]; NULL
                                    without friction */
  PetscReal   *friction;   /* friction forces on the vertices of both faces at this state [force]; NULL without
                                    friction */
  PetscReal   *bound;      /* [npairs x nowned] largest friction force that the pressure allowed at the last state
                                    of equilibrium [force]; NULL without friction */
  PetscReal   *slip_path;  /* [npairs x nowned] length of the path along which the vertex slipped until this
                                    state [length]; NULL without friction */
  PetscReal   *dissipated; /* [npairs x nowned] work of the friction forces until this state [force length];
                                    NULL without friction */
};

PETSC_INTERN PetscErrorCode ContactHistoryCountClosed(const ContactHistory *, MPI_Comm, PetscInt *n);
PETSC_INTERN PetscErrorCode ContactHistoryCreate(DM, Scene, ContactHistory *);
PETSC_INTERN PetscInt       ContactHistoryIndex(const ContactHistory *, ContactLinearization, PetscInt row);
PETSC_INTERN PetscErrorCode ContactHistoryStore(ContactHistory *, ContactLinearization, const ContactSolution *,
  Vec slack, PetscReal stiffness);
PETSC_INTERN PetscErrorCode ContactHistoryRecall(const ContactHistory *, ContactLinearization, PetscReal scale,
  Vec slack, Vec pressure, PetscBool *any);
PETSC_INTERN PetscErrorCode ContactHistoryChange(const ContactHistory *, ContactLinearization, PetscReal *change);
PETSC_INTERN PetscErrorCode ContactHistoryFollowRows(const ContactHistory *, ContactLinearization solved,
  ContactLinearization, PetscInt                                                                **row);
PETSC_INTERN PetscErrorCode ContactHistoryFindLostRows(const ContactHistory *, ContactLinearization, PetscBool **lost,
  PetscInt *nlost);
PETSC_INTERN PetscErrorCode ContactHistoryLeastGap(const ContactHistory *, const PetscBool lost[], ContactLinearization,
  PetscReal *least);
PETSC_INTERN PetscErrorCode ContactHistoryDestroy(ContactHistory *);

#endif
