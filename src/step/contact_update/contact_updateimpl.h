/*
   Contact updates. The files are listed such that each depends only on those before it. contact_updates.c has the loop:
   it solves with one linearization of the gap, measures the error, and linearizes the gap at another displacement.
*/
#ifndef CONTACT_UPDATEIMPL_H
#define CONTACT_UPDATEIMPL_H

#include "src/step/problem/problemimpl.h"

/* linearization_error.c: error of a contact update */
PETSC_INTERN PetscErrorCode ContactUpdateMeasureError(Model, State, Vec u, const ContactSolution *,
  ContactLinearization at_u, StepReport *);

/* stuck_vertices.c: names vertices at which contact updates fail */
PETSC_INTERN PetscErrorCode ContactUpdateNamePlace(Model, State, const ContactSolution *, ContactLinearization at_u,
  PetscBool slid, size_t length, char sentence[]);
PETSC_INTERN PetscErrorCode ContactUpdateReportDriven(const StepProblem *, StepReport *);

/* newton.c: Newton's method for contact updates */
PETSC_INTERN PetscErrorCode ContactUpdateNewton(StepProblem *, const ContactSolution *, ContactLinearization at_u,
  Vec x, Vec u, Vec next, StepReport *, PetscBool *found);

/* linearization.c: the displacements at which the gap is linearized */
PETSC_INTERN PetscErrorCode ContactUpdateGetGaps(Model, State, PetscReal time, Vec u, ContactLinearization *);
PETSC_INTERN PetscErrorCode ContactUpdateLinearize(Model, State, PetscReal time, Vec u, ContactLinearization *);
PETSC_INTERN PetscErrorCode ContactUpdateBegin(StepProblem *, Vec u, const StepReport *, Vec *u_linearized);
PETSC_INTERN PetscErrorCode ContactUpdateNext(StepProblem *, Anderson *, const ContactSolution *, Vec u,
  Vec u_linearized, StepReport *, ContactLinearization *at_u);

/* mean_direction.c: directions of the contact forces in time steps */
PETSC_INTERN PetscErrorCode ContactUpdateKeepDirections(StepProblem *);
PETSC_INTERN PetscErrorCode ContactUpdateSetDirections(StepProblem *);
PETSC_INTERN PetscErrorCode ContactUpdateKeepForces(StepProblem *, const ContactSolution *);

/* tolerance.c: tolerances of the solves */
PETSC_INTERN PetscErrorCode ContactUpdateSetTolerance(StepProblem *, PetscBool again, PetscBool end, Vec u,
  const StepReport *);
PETSC_INTERN PetscErrorCode ContactUpdateEndedEarly(const StepProblem *, PetscBool end, Vec u, const StepReport *,
  PetscBool *again);

/* missed_contact.c: contact that the search missed */
PETSC_INTERN PetscErrorCode MissedFind(const StepProblem *, Vec u_linearized, Vec u, Vec own, PetscReal *reach,
  PetscBool *missed);
PETSC_INTERN PetscErrorCode MissedFindLostRows(const StepProblem *, Vec u_linearized, Vec u, ContactLinearization at_u,
  StepReport *, PetscBool *slid);
PETSC_INTERN PetscErrorCode MissedFindPassed(Model, State, PetscReal time, Vec u, StepReport *);

/* contact_updates.c: solves the problem of a load step with contact */
PETSC_INTERN PetscErrorCode ContactUpdatesSolve(StepProblem *, Vec u, StepReport *, ContactSolution *,
  ContactLinearization *at_u);

#endif
