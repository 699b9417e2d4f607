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

/* Whether rounding of elastic forces is as large as what a solver may leave of the forces of inertia by the same
   displacements */
PetscErrorCode InertiaIsSmall(Simulation sim, PetscBool *small)
{
  const PetscReal left = 1e-11; /* relative, with a margin of a hundred */
  PetscReal       mass;
  Vec             diagonal;

  PetscFunctionBegin;
  *small = PETSC_FALSE;
  if (!SimulationIsDynamic(sim)) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(sim->dynamics.inert, &diagonal));
  PetscCall(MatGetDiagonal(sim->dynamics.mass, diagonal));
  PetscCall(VecPointwiseMult(diagonal, diagonal, sim->dynamics.inert));
  PetscCall(VecMax(diagonal, NULL, &mass));
  PetscCall(VecDestroy(&diagonal));
  *small = (PetscBool)(PETSC_MACHINE_EPSILON * sim->stiffness > left * sim->dynamics.inertia * mass);
  PetscFunctionReturn(0);
}

/* Sets the excess of the mean internal force to that of a step to u */
PetscErrorCode InertiaSetExcess(Simulation sim, Vec u)
{
  Dynamics *d = &sim->dynamics;
  PetscBool valid;

  PetscFunctionBegin;
  if (!d->excess) PetscCall(VecDuplicate(u, &d->excess));
  PetscCall(ElasticityExcess(sim->elasticity, sim->path->u, u, d->excess, &valid));
  PetscCall(VecScale(d->excess, 2.0));
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

/* change: of the excess, on free rows, to that of a step to u, relative to the larger of the internal forces at both
   ends; 0 where it is below their rounding */
PetscErrorCode InertiaMeasureExcess(Simulation sim, Vec u, PetscReal rounding, PetscReal *change)
{
  Dynamics *d = &sim->dynamics;
  PetscReal before, after;
  Vec       force, last;

  PetscFunctionBegin;
  PetscCall(InertiaGetForce(sim, u, &force));
  PetscCall(VecNorm(force, NORM_2, &after));
  PetscCall(VecNorm(d->rest, NORM_2, &before));
  last      = d->excess;
  d->excess = force;
  PetscCall(InertiaSetExcess(sim, u));
  PetscCall(VecAXPY(d->excess, -1.0, last));
  PetscCall(PrescribedSet(&sim->prescribed, 0.0, d->excess));
  PetscCall(VecNorm(d->excess, NORM_2, change));
  *change = *change > rounding ? *change / PetscMax(rounding, PetscMax(before, after)) : 0.0;
  PetscCall(VecDestroy(&d->excess));
  d->excess = last;
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
