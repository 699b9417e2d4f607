/*
   Directions of the contact forces in the impact scheme. Forces q along the derivatives J' of the gaps at the end of a
   time step do the work q^T J' (u' - u). On a face of radius R, over which a contact moves by d, it is N d^2/(2R).
   Along the mean of J' and of the derivatives J at the start they do the work q^T (g' - g), up to terms of third order.
   Hence twice the difference, (J' - J)^T q, is a constant force of each solve, with q of the solve before it. On rigid
   bodies that turn these forces have the mean arms of the step (src/dynamics/turn.c).
*/
#include "contact_updateimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/path.h"

/* Keeps the derivatives of the gaps at the last state, and where they are; state->solved->upcoming is set */
PetscErrorCode ContactUpdateKeepDirections(StepProblem *p)
{
  const ContactHistory *h = p->state->history;
  ContactLinearization  start;
  PetscInt              rstart;

  PetscFunctionBegin;
  PetscCall(VecDestroy(&p->model->dynamics.turned));
  PetscCall(MatDestroy(&p->directions));
  PetscCall(PetscFree(p->direction));
  PetscCall(VecDestroy(&p->pressed));
  if (!SchemeIsImpact(&p->model->scene->dynamics)) PetscFunctionReturn(0);
  if (p->model->rigid.turns && p->state->path->contact) {
    PetscCall(VecDuplicate(p->base, &p->pressed));
    PetscCall(VecAXPY(p->pressed, -1.0, p->state->path->contact));
  }
  if (!p->state->solved->upcoming)
    PetscCall(ContactLinearize(p->model->contact, p->state->path->u, CONTACT_FORCES, &p->state->solved->upcoming));
  start = p->state->solved->upcoming;
  PetscCall(PetscObjectReference((PetscObject)start->J));
  p->directions = start->J;
  PetscCall(MatGetOwnershipRange(start->J, &rstart, NULL));
  PetscCall(PetscMalloc1(h->npairs * h->nowned, &p->direction));
  for (PetscInt k = 0; k < h->npairs * h->nowned; ++k) p->direction[k] = PETSC_DECIDE;
  for (PetscInt r = 0; r < start->nlocal; ++r) p->direction[ContactHistoryIndex(h, start, r)] = rstart + r;
  PetscFunctionReturn(0);
}

/* Sets the constant force for the forces of the last solve, in the rows that exist at both ends of the time step */
PetscErrorCode ContactUpdateSetDirections(StepProblem *p)
{
  const ContactLinearization lin = p->state->solved->linearization;
  Dynamics                  *d   = &p->model->dynamics;
  PetscScalar               *q;
  PetscBool                  any;
  Vec                        slack, forces, first, before;

  PetscFunctionBegin;
  if (!p->directions) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(lin->mass, &slack));
  PetscCall(VecDuplicate(lin->mass, &forces));
  PetscCall(ContactHistoryRecall(p->state->history, lin, 1.0, slack, forces, &any));
  PetscCall(VecPointwiseMult(forces, forces, lin->mass));
  PetscCall(MatCreateVecs(p->directions, &before, &first));
  PetscCall(VecGetArray(forces, &q));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    const PetscInt row = p->direction[ContactHistoryIndex(p->state->history, lin, r)];

    if (row < 0) q[r] = 0.0;
    else PetscCall(VecSetValue(first, row, q[r], INSERT_VALUES));
  }
  PetscCall(VecRestoreArray(forces, &q));
  PetscCall(VecAssemblyBegin(first));
  PetscCall(VecAssemblyEnd(first));
  if (!d->turned) PetscCall(VecDuplicate(p->base, &d->turned));
  PetscCall(MatMultTranspose(lin->J, forces, d->turned));
  PetscCall(MatMultTranspose(p->directions, first, before));
  PetscCall(VecAXPY(d->turned, -1.0, before));
  if (p->model->quadratic) PetscCall(StepProblemSetQuadratic(p, PETSC_FALSE));
  PetscCall(VecDestroy(&slack));
  PetscCall(VecDestroy(&forces));
  PetscCall(VecDestroy(&first));
  PetscCall(VecDestroy(&before));
  PetscFunctionReturn(0);
}

/* After a solve: keeps the contact forces, if rigid bodies turn */
PetscErrorCode ContactUpdateKeepForces(StepProblem *p, const ContactSolution *sol)
{
  Vec weighted;

  PetscFunctionBegin;
  if (!p->directions || !p->model->rigid.turns) PetscFunctionReturn(0);
  if (!p->pressed) PetscCall(VecDuplicate(p->base, &p->pressed));
  PetscCall(VecDuplicate(sol->pressure, &weighted));
  PetscCall(RowsGetForces(p->state->solved->linearization, sol, weighted, p->pressed));
  PetscCall(VecDestroy(&weighted));
  PetscFunctionReturn(0);
}
