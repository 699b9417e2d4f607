/*
   Velocities and accelerations in rows with prescribed displacements. Those at the end of a time step follow from the
   mean rates of this and the previous step, which belong to the middle of the steps: they are continued linearly to the
   end of the step. The error is of second order in the time step. Newmark's formulas would instead keep any error of
   the velocity, with alternating sign.
*/
#include "dynamicsimpl.h"

/* Copies the prescribed rows */
static PetscErrorCode DriveCopy(const Prescribed *p, Vec from, Vec to)
{
  const PetscScalar *a;
  PetscScalar       *b;
  PetscInt           first;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(to, &first, NULL));
  PetscCall(VecGetArrayRead(from, &a));
  PetscCall(VecGetArray(to, &b));
  for (PetscInt k = 0; k < p->n; ++k) b[p->rows[k] - first] = a[p->rows[k] - first];
  PetscCall(VecRestoreArray(to, &b));
  PetscCall(VecRestoreArrayRead(from, &a));
  PetscFunctionReturn(0);
}

/*
   Sets the prescribed rows of `rate` to the derivative of order 1 or 2 of the displacement at time 0, from those at the
   ends of the first two load steps. Controlled time steps are shorter than a load step, in which ramps are linear.
*/
PetscErrorCode DriveStart(const Constraints *c, PetscInt order, Vec rate)
{
  static const PetscReal weights[2][2][3] = {{{-1, 1, 0}, {0, 0, 0}}, {{-1.5, 2, -0.5}, {1, -2, 1}}};
  Scene                  scene            = c->bodies.scene;
  const int              curved           = scene->dynamics.tolerance == 0.0 && scene->nsteps > 1;
  Vec                    u, sum;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rate, &u));
  PetscCall(VecDuplicate(rate, &sum));
  PetscCall(VecZeroEntries(u));
  PetscCall(VecZeroEntries(sum));
  for (int k = 0; k < 3; ++k) {
    PetscCall(PrescribedApply(c->prescribed, (PetscReal)k, u));
    PetscCall(VecAXPY(sum, weights[curved][order - 1][k] / PetscPowRealInt(scene->dynamics.time_step, order), u));
  }
  PetscCall(DriveCopy(c->prescribed, sum, rate));
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

/* Sets the prescribed rows of `rate` to (to - from)/dt, continued linearly to the end of the time step of length dt if
   `mean` has the mean rates of the previous time step of length `before`. In the first time step, in which `before` is
   0, `mean` has the rates at its start. */
static PetscErrorCode DriveContinue(PetscReal dt, PetscReal before, Vec from, Vec to, Vec mean, Vec rate)
{
  const PetscReal part = dt / (dt + before);

  PetscFunctionBegin;
  PetscCall(VecWAXPY(rate, -1.0, from, to));
  PetscCall(VecScale(rate, (1.0 + part) / dt));
  PetscCall(VecAXPY(rate, -part, mean));
  PetscFunctionReturn(0);
}

/*
   Sets the prescribed rows of d->driven to the velocity at the end of the time step from u to `time` (in load steps),
   and those of d->centre and d->viscous so that the forces of inertia and damping belong to this velocity. dt, before:
   lengths of this and the previous time step; `before` is 0 in the first one. previous: displacement at the start of
   the previous time step
*/
PetscErrorCode DriveBegin(const Constraints *c, PetscReal time, PetscReal dt, PetscReal before, Vec u, Vec previous,
  Dynamics *d)
{
  const SceneDynamics *scene = &c->bodies.scene->dynamics;
  Vec                  end, mean, force;

  PetscFunctionBegin;
  if (!d->driven) PetscCall(VecDuplicate(u, &d->driven));
  PetscCall(VecDuplicate(u, &end));
  PetscCall(VecDuplicate(u, &mean));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecCopy(u, end));
  PetscCall(PrescribedApply(c->prescribed, time, end));
  if (before > 0.0) PetscCall(VecWAXPY(mean, -1.0, previous, u));
  if (before > 0.0) PetscCall(VecScale(mean, 1.0 / before));
  else PetscCall(VecCopy(d->velocity, mean));
  PetscCall(DriveContinue(dt, before, u, end, mean, d->driven));
  /* twice the mean acceleration in the impact scheme, else the acceleration at the end */
  PetscCall(VecWAXPY(force, -1.0, d->velocity, d->driven));
  PetscCall(VecScale(force, 2.0 / dt));
  if (!d->residual) PetscCall(DriveContinue(dt, before, d->velocity, d->driven, d->acceleration, force));
  PetscCall(VecAXPY(force, scene->damping_mass, d->driven));
  PetscCall(VecAYPX(force, -1.0 / d->inertia, end));
  PetscCall(DriveCopy(c->prescribed, force, d->centre));
  if (d->viscous) {
    PetscCall(VecWAXPY(force, -1.0 / d->springs->rate, d->driven, end));
    PetscCall(DriveCopy(c->prescribed, force, d->viscous));
  }
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&mean));
  PetscCall(VecDestroy(&end));
  PetscFunctionReturn(0);
}

/* Sets the prescribed rows of the velocity at the end of the time step */
PetscErrorCode DriveEnd(const Dynamics *d, Vec velocity)
{
  PetscFunctionBegin;
  if (d->driven) PetscCall(DriveCopy(d->prescribed, d->driven, velocity));
  PetscFunctionReturn(0);
}
