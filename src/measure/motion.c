/* Energies and momentum in dynamics. */
#include "measureimpl.h"

/*
   Called when the velocity at u and the work up to u are known. The energy balance: the work of the loads plus the
   first kinetic energy, minus kinetic energy, stored energy, work of contact and of damping, is what the time
   integration has lost
*/
PetscErrorCode MotionMeasure(Simulation sim, Vec u, StepReport *report)
{
  const Constraints constraints = SimulationConstraints(sim);
  const Dynamics   *d           = &sim->dynamics;
  MotionReport     *motion;

  PetscFunctionBegin;
  if (!report->motions) PetscCall(PetscCalloc1(1, &report->motions));
  report->nmotions = 1;
  motion           = report->motions;
  motion->name     = "dynamics";
  PetscCall(MassMeasure(&constraints, d, u, &motion->kinetic_energy, motion->momentum, motion->angular_momentum));
  motion->total_energy          = motion->kinetic_energy + report->energy;
  motion->damping_work          = d->damped;
  motion->numerical_dissipation = d->kinetic + report->work - motion->total_energy - report->contact_work -
                                  motion->damping_work - report->plastic_work;
  PetscFunctionReturn(0);
}
