/* The work of the forces from outside: dead loads, and the reactions where displacements are prescribed. */
#include "stepimpl.h"

/* Of the way from the last state to u. unbalanced: internal less contact and dead forces, the reactions on the prescribed rows; rigid: what moves rigid bodies that forces drive, NULL: none */
PetscErrorCode WorkAdd(const StepProblem *p, Vec u, Vec unbalanced, Vec rigid, StepReport *report)
{
  LoadPath   *path = &p->sim->path;
  PetscScalar work[2];
  Vec         outside, reaction, way = p->w;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &outside));
  PetscCall(VecDuplicate(u, &reaction));
  PetscCall(VecCopy(unbalanced, outside));
  PetscCall(PrescribedSet(&p->sim->prescribed, 0.0, outside));
  PetscCall(VecWAXPY(reaction, -1.0, outside, unbalanced));
  if (p->load) PetscCall(VecWAXPY(outside, 1.0, p->load, reaction));
  else PetscCall(VecCopy(reaction, outside));
  if (rigid) PetscCall(VecAXPY(outside, 1.0, rigid));
  PetscCall(VecWAXPY(way, -1.0, path->u, u));
  PetscCall(VecDot(outside, way, &work[0]));
  work[1] = 0.0;
  if (path->outside) PetscCall(VecDot(path->outside, way, &work[1]));
  path->work += 0.5 * PetscRealPart(work[0] + work[1]);
  report->work = path->work;
  PetscCall(VecDestroy(&path->outside));
  PetscCall(VecDestroy(&reaction));
  path->outside = outside;
  PetscFunctionReturn(0);
}
