/* Inertia in a load step, which is a time step then. */
#include "stateimpl.h"
#include "src/state/path.h"

static PetscReal InertiaStep(Simulation sim, PetscReal time)
{
  return (time - sim->path->time) * SceneTimeStep(sim->scene);
}

/* Sets the inertia term for this step. changed: its tangent differs from that of the step before */
PetscErrorCode InertiaBegin(Simulation sim, PetscReal time, PetscBool *changed)
{
  Dynamics *d = &sim->dynamics;

  PetscFunctionBegin;
  PetscCall(SchemeBegin(&sim->scene->dynamics, InertiaStep(sim, time), sim->path->u, d));
  PetscCall(ElasticitySetInertia(sim->elasticity, d->inertia, d->viscosity, changed));
  PetscFunctionReturn(0);
}

/* Forces of inertia and damping at u, in a new vector; NULL in a static analysis. In the impact scheme they exclude
   the part of the contact forces that is not in the multipliers */
PetscErrorCode InertiaGetForce(Simulation sim, Vec u, Vec *force)
{
  PetscReal energy = 0.0;

  PetscFunctionBegin;
  *force = NULL;
  if (!SimulationIsDynamic(sim)) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, force));
  PetscCall(VecZeroEntries(*force));
  PetscCall(SchemeAddForce(&sim->dynamics, u, &energy, *force));
  PetscCall(VecScale(*force, -1.0));
  PetscFunctionReturn(0);
}

/* The state moves on to u, where the path does so next */
PetscErrorCode InertiaAdvance(Simulation sim, PetscReal time, Vec u)
{
  const Constraints constraints = SimulationConstraints(sim);

  PetscFunctionBegin;
  if (!SimulationIsDynamic(sim)) PetscFunctionReturn(0);
  PetscCall(SchemeAdvance(&sim->scene->dynamics, InertiaStep(sim, time), sim->path->u, u, &sim->dynamics));
  PetscCall(DynamicsSetRest(&constraints, &sim->loads, time, u, &sim->dynamics));
  PetscFunctionReturn(0);
}
