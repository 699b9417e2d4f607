/*
   Solution of one load step. A load step is attempted (attempt.c): its optimization problem is solved, with contact
   updates, the state is measured, and accepted; or the load step is cut (step.c).
*/
#ifndef STEPIMPL_H
#define STEPIMPL_H

#include "src/step/contact_update/contact_updateimpl.h"

/* attempt.c: attempts to solve up to a given time. STEP_SHORTEST: length of the shortest controlled time steps, as a
   fraction of a load step */
#define STEP_SHORTEST (1.0 / 1024.0)
PETSC_INTERN PetscErrorCode SimulationAttempt(Simulation, PetscReal time, StepReport *);

/* dual_gaps.c: repeats a failed attempt with dual shape functions */
PETSC_INTERN PetscErrorCode DualGapsTry(Model, State, StepReport *, PetscBool *again);
PETSC_INTERN PetscErrorCode DualGapsAccept(Simulation, const StepReport *);

/* lost_contact.c: places bodies that have lost contact */
PETSC_INTERN PetscErrorCode LostContactSettle(const StepProblem *, ContactLinearization last, Vec u, ContactSolution *,
  ContactLinearization *at_u, StepReport *);

/* step.c: its functions are declared in step.h */

#endif
