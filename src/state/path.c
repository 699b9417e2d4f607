/* The path of equilibrium states, and what it says about the next one. */
#include "stateimpl.h"

/*
   The next increment as a multiple of the last: the projection of the change of all ramps on their last change. A load
   program that turns a corner (press, then slide) is not continued along its old direction.
*/
static PetscErrorCode PathRatio(Simulation sim, PetscReal time, PetscReal *ratio)
{
  const LoadPath *path    = &sim->path;
  PetscReal       product = 0.0, square = 0.0;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < sim->scene->nramps; ++r) {
    PetscReal before, now, next;

    PetscCall(SceneGetFactor(sim->scene, r, path->previous_time, &before));
    PetscCall(SceneGetFactor(sim->scene, r, path->time, &now));
    PetscCall(SceneGetFactor(sim->scene, r, time, &next));
    product += (next - now) * (now - before);
    square += (now - before) * (now - before);
  }
  *ratio = square > 0.0 ? product / square : 0.0;
  PetscFunctionReturn(0);
}

/* u = the path continued to a time, in dynamics with the accelerations that there are; prescribed rows as that time has
   them */
PetscErrorCode PathContinue(Simulation sim, PetscReal time, Vec u)
{
  PetscReal ratio = 0.0;

  PetscFunctionBegin;
  if (SimulationIsDynamic(sim)) {
    PetscCall(SchemePredict(&sim->dynamics, (time - sim->path.time) * SceneTimeStep(sim->scene), sim->path.u, u));
  } else {
    PetscCall(PathRatio(sim, time, &ratio));
    PetscCall(VecCopy(sim->path.u, u));
    PetscCall(VecAXPY(u, ratio, sim->path.u));
    PetscCall(VecAXPY(u, -ratio, sim->path.previous_u));
  }
  PetscCall(PrescribedApply(&sim->prescribed, time, u));
  PetscCall(TiesFollow(&sim->ties, u));
  PetscFunctionReturn(0);
}

/* Contact pressures follow a single ramp in proportion; under several they are taken as they were */
PetscErrorCode PathPressureScale(Simulation sim, PetscReal time, PetscReal *scale)
{
  PetscReal now, next;

  PetscFunctionBegin;
  *scale = 1.0;
  if (sim->scene->nramps > 1 || SimulationIsDynamic(sim)) PetscFunctionReturn(0);
  PetscCall(SceneGetFactor(sim->scene, 0, sim->path.time, &now));
  PetscCall(SceneGetFactor(sim->scene, 0, time, &next));
  if (now != 0.0 && next / now > 0.0) *scale = next / now;
  PetscFunctionReturn(0);
}

/* u becomes the state; the oldest state's vector comes back in its place */
PetscErrorCode PathAdvance(LoadPath *path, PetscReal time, Vec *u)
{
  Vec       oldest = path->previous_u;
  PetscReal increment;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(oldest, -1.0, path->u, *u));
  PetscCall(VecNorm(oldest, NORM_INFINITY, &increment));
  path->largest_increment = PetscMax(path->largest_increment, increment);
  path->previous_u        = path->u;
  path->previous_time     = path->time;
  path->u                 = *u;
  path->time              = time;
  *u                      = oldest;
  PetscFunctionReturn(0);
}

/* Solves with the present stiffness until the end of the load program, this one included: where the gap is updated,
   one update a load step at least */
PetscErrorCode PathSolvesToCome(Simulation sim, PetscInt *n)
{
  const PetscReal updates = sim->scene->npairs && sim->scene->contact_updates > 1 ? 2.0 : 1.0;
  PetscReal       steps   = PetscMax((PetscReal)sim->scene->nsteps - sim->path.time, 1.0);
  PetscBool       linear;

  PetscFunctionBegin;
  PetscCall(ElasticityIsLinear(sim->elasticity, &linear));
  if (!linear) steps = 1.0;
  *n = (PetscInt)(updates * steps);
  PetscFunctionReturn(0);
}
