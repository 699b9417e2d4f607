/* Applies inertia in a dynamic analysis, in which each load step is a time step. */
#include "stateimpl.h"
#include "src/state/path.h"

static PetscReal InertiaStep(Scene scene, LoadPath *path, PetscReal time)
{
  return (time - path->time) * SceneTimeStep(scene);
}

/* Returns the length of the previous time step; 0 in the first time step [time] */
static PetscReal InertiaPreviousStep(Scene scene, LoadPath *path)
{
  return (path->time - path->previous_time) * SceneTimeStep(scene);
}

/*
   Sets the inertia term for the time step that ends at `time`. *changed: true if the tangent of the term differs from
   that of the previous time step.
*/
PetscErrorCode InertiaBegin(Model model, State state, PetscReal time, PetscBool *changed)
{
  const Constraints constraints = ModelConstraints(model);
  Dynamics         *d           = &model->dynamics;

  PetscFunctionBegin;
  PetscCall(SchemeBegin(&model->scene->dynamics, InertiaStep(model->scene, state->path, time), state->path->u, d));
  PetscCall(DriveBegin(&constraints, time, InertiaStep(model->scene, state->path, time),
    InertiaPreviousStep(model->scene, state->path), state->path->u, state->path->previous_u, d));
  PetscCall(ElasticitySetInertia(model->elasticity, d->inertia, d->viscosity, changed));
  PetscFunctionReturn(0);
}

/*
   Finds whether the inertia forces are small compared with rounding errors of elastic forces. *small: true if the
   rounding error of K u is as large as the error that a solver may leave in the inertia forces c M u, with c M the
   inertia term. Always false in a static analysis.
*/
PetscErrorCode InertiaIsSmall(Model model, PetscBool *small)
{
  const PetscReal left = 1e-11; /* relative error that a solver may leave, with a safety factor of 100 */
  PetscReal       mass;
  Vec             diagonal;

  PetscFunctionBegin;
  *small = PETSC_FALSE;
  if (!ModelIsDynamic(model)) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(model->dynamics.inert, &diagonal));
  PetscCall(MatGetDiagonal(model->dynamics.mass, diagonal));
  PetscCall(VecPointwiseMult(diagonal, diagonal, model->dynamics.inert));
  PetscCall(VecMax(diagonal, NULL, &mass));
  PetscCall(VecDestroy(&diagonal));
  *small = (PetscBool)(PETSC_MACHINE_EPSILON * model->stiffness > left * model->dynamics.inertia * mass);
  PetscFunctionReturn(0);
}

/*
   Sets d->excess to twice the difference that makes the internal force of the step from path->u to u the mean force,
   which conserves energy (mean_force.c).
*/
PetscErrorCode InertiaSetExcess(Model model, State state, Vec u)
{
  Dynamics *d = &model->dynamics;
  PetscBool valid;

  PetscFunctionBegin;
  if (!d->excess) PetscCall(VecDuplicate(u, &d->excess));
  PetscCall(ElasticityExcess(model->elasticity, state->path->u, u, d->excess, &valid));
  PetscCall(VecScale(d->excess, 2.0));
  PetscFunctionReturn(0);
}

/*
   Computes the forces of inertia and damping at u in a new vector; *force is NULL in a static analysis. In the impact
   scheme the multipliers are only a share of the contact forces (SchemeShare()); the rest is not part of *force.
*/
PetscErrorCode InertiaGetForce(Model model, Vec u, Vec *force)
{
  PetscReal energy = 0.0;

  PetscFunctionBegin;
  *force = NULL;
  if (!ModelIsDynamic(model)) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, force));
  PetscCall(VecZeroEntries(*force));
  PetscCall(SchemeAddForce(&model->dynamics, u, &energy, *force));
  PetscCall(VecScale(*force, -1.0));
  PetscFunctionReturn(0);
}

/*
   Measures how much the excess of the mean force changes if it is evaluated for the step to u. *change: 2-norm of this
   change on the rows that are not prescribed, divided by the larger of the 2-norms of the internal forces at the start
   and at the end of the step; 0 if the norm of the change is below `rounding` [force].
*/
PetscErrorCode InertiaMeasureExcess(Model model, State state, Vec u, PetscReal rounding, PetscReal *change)
{
  Dynamics *d = &model->dynamics;
  PetscReal before, after;
  Vec       force, last;

  PetscFunctionBegin;
  PetscCall(InertiaGetForce(model, u, &force));
  PetscCall(VecNorm(force, NORM_2, &after));
  PetscCall(VecNorm(d->residual, NORM_2, &before));
  last      = d->excess;
  d->excess = force;
  PetscCall(InertiaSetExcess(model, state, u));
  PetscCall(VecAXPY(d->excess, -1.0, last));
  PetscCall(PrescribedSet(&model->prescribed, 0.0, d->excess));
  PetscCall(VecNorm(d->excess, NORM_2, change));
  *change = *change > rounding ? *change / PetscMax(rounding, PetscMax(before, after)) : 0.0;
  PetscCall(VecDestroy(&d->excess));
  d->excess = last;
  PetscFunctionReturn(0);
}

/*
   Advances the dynamic state to the displacement u at `time`. Call this before PathAdvance(), because path->u must
   still be the old displacement.
*/
PetscErrorCode InertiaAdvance(Model model, State state, PetscReal time, Vec u)
{
  const Constraints constraints = ModelConstraints(model);

  PetscFunctionBegin;
  if (!ModelIsDynamic(model)) PetscFunctionReturn(0);
  PetscCall(SchemeAdvance(&model->scene->dynamics, InertiaStep(model->scene, state->path, time), state->path->u, u,
    &model->dynamics));
  PetscCall(DynamicsSetRest(&constraints, &model->loads, time, u, &model->dynamics));
  PetscFunctionReturn(0);
}

/* Estimates the error of a time step to u by SchemeEstimate(). smooth: true if contact neither closes nor opens in
   this time step */
PetscErrorCode InertiaEstimate(Model model, State state, PetscReal time, PetscBool smooth, Vec u, PetscReal *error)
{
  PetscFunctionBegin;
  PetscCall(SchemeEstimate(&model->scene->dynamics, InertiaStep(model->scene, state->path, time),
    InertiaPreviousStep(model->scene, state->path), smooth, state->path->u, u, &model->dynamics, error));
  PetscFunctionReturn(0);
}
