/* Energies and momentum in dynamics */
#include "measureimpl.h"
#include "src/state/control.h"

/*
   Computes energies and momentum. Velocities at u and the work up to u must be known. The numerical dissipation is the
   energy that the time integration has lost, also in the normal forces of contact: the work of the loads plus the
   initial kinetic energy, minus kinetic energy, stored energy, and the work of friction, damping and plasticity.
   Overlaps that the scene removes on purpose store energy by the work of normal forces, which is then no loss.
*/
PetscErrorCode MotionMeasure(Model model, State state, Vec u, StepReport *report)
{
  const Constraints constraints = ModelConstraints(model);
  const Dynamics   *d           = &model->dynamics;
  PetscReal         taken       = report->dissipated;
  MotionReport     *motion;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < model->scene->npairs; ++p)
    if (model->scene->pairs[p].interference > 0.0) taken = report->contact_work - report->contact_energy;
  if (!report->motions) PetscCall(PetscCalloc1(1, &report->motions));
  report->nmotions = 1;
  motion           = report->motions;
  motion->name     = "dynamics";
  PetscCall(MassMeasure(&constraints, d, u, &motion->kinetic_energy, motion->momentum, motion->angular_momentum));
  motion->total_energy   = motion->kinetic_energy + report->energy + report->contact_energy;
  motion->damping_work   = d->damped;
  motion->rejected_steps = state->control->time_step.rejected;
  motion->shortest_step  = state->control->time_step.shortest * SceneTimeStep(model->scene);
  motion->time_error     = state->control->time_step.largest;
  motion->numerical_dissipation =
    d->kinetic + report->work - motion->total_energy - taken - motion->damping_work - report->plastic_work;
  PetscFunctionReturn(0);
}
