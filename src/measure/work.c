/* The work of the forces from outside, dead loads and the reactions where displacements are prescribed, and of those
   in the contacts. */
#include "src/step/stepimpl.h"

/* Adds the mean of a force before and now, NULL: none, times the way between; what is now will have been before */
static PetscErrorCode WorkAddForce(Vec way, Vec *before, Vec *now, PetscReal *work)
{
  Vec         forces[2] = {*before, *now};
  PetscScalar product;

  PetscFunctionBegin;
  for (int k = 0; k < 2; ++k) {
    if (!forces[k]) continue;
    PetscCall(VecDot(forces[k], way, &product));
    *work += 0.5 * PetscRealPart(product);
  }
  PetscCall(VecDestroy(before));
  *before = *now;
  *now    = NULL;
  PetscFunctionReturn(0);
}

/*
   Of the way from the last state to u. unbalanced: internal less contact and dead forces, the reactions on the
   prescribed rows; rigid: what moves rigid bodies that forces drive, NULL: none; contact: the forces in the contacts
   where pairs rub, which end in WorkAdd(), NULL: none
*/
PetscErrorCode WorkAdd(const StepProblem *p, Vec u, Vec unbalanced, Vec rigid, Vec *contact, StepReport *report)
{
  LoadPath *path = &p->sim->path;
  Vec       outside, reaction, way = p->w;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &outside));
  PetscCall(VecDuplicate(u, &reaction));
  PetscCall(VecCopy(unbalanced, outside));
  PetscCall(PrescribedSet(&p->sim->prescribed, 0.0, outside));
  PetscCall(VecWAXPY(reaction, -1.0, outside, unbalanced));
  if (p->load) PetscCall(VecWAXPY(outside, 1.0, p->load, reaction));
  else PetscCall(VecCopy(reaction, outside));
  if (rigid) PetscCall(VecAXPY(outside, 1.0, rigid));
  PetscCall(VecDestroy(&reaction));
  PetscCall(VecWAXPY(way, -1.0, path->u, u));
  PetscCall(WorkAddForce(way, &path->outside, &outside, &path->work));
  if (*contact) PetscCall(VecScale(*contact, -1.0)); /* on the contacts, not on the bodies */
  PetscCall(WorkAddForce(way, &path->contact, contact, &path->contact_work));
  report->work         = path->work;
  report->contact_work = path->contact_work;
  PetscFunctionReturn(0);
}
