/* The path of equilibrium states, and its extrapolation. */
#include "stateimpl.h"
#include "src/state/path.h"

/*
   ratio: the next increment as a multiple of the last one. It is the projection of the change of all ramps on their
   last change, so that a load program that turns (press, then slide) is not continued in its old direction. A path on
   which metal yielded is not gone back: the bodies unload elastically.
*/
static PetscErrorCode PathRatio(Simulation sim, PetscReal time, PetscReal *ratio)
{
  const LoadPath *path    = sim->path;
  PetscReal       product = 0.0, square = 0.0;
  PetscBool       yielded = PETSC_FALSE;

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
  if (*ratio < 0.0) PetscCall(ElasticityHasYielded(sim->elasticity, &yielded));
  if (yielded) *ratio = 0.0;
  PetscFunctionReturn(0);
}

/* u: the path extrapolated to a time (in dynamics by velocities and accelerations), with the prescribed displacements
   of that time */
PetscErrorCode PathContinue(Simulation sim, PetscReal time, Vec u)
{
  PetscReal ratio = 0.0;

  PetscFunctionBegin;
  if (SimulationIsDynamic(sim)) {
    PetscCall(SchemePredict(&sim->dynamics, (time - sim->path->time) * SceneTimeStep(sim->scene), sim->path->u, u));
  } else {
    PetscCall(PathRatio(sim, time, &ratio));
    PetscCall(VecCopy(sim->path->u, u));
    PetscCall(VecAXPY(u, ratio, sim->path->u));
    PetscCall(VecAXPY(u, -ratio, sim->path->previous_u));
  }
  PetscCall(PrescribedApply(&sim->prescribed, time, u));
  PetscCall(TiesFollow(&sim->ties, u));
  PetscFunctionReturn(0);
}

/* scale: factor for stored pressures. With a single ramp pressures are proportional to it; with several they are not
   scaled. */
PetscErrorCode PathPressureScale(Simulation sim, PetscReal time, PetscReal *scale)
{
  PetscReal now, next;

  PetscFunctionBegin;
  *scale = 1.0;
  if (sim->scene->nramps > 1 || SimulationIsDynamic(sim)) PetscFunctionReturn(0);
  PetscCall(SceneGetFactor(sim->scene, 0, sim->path->time, &now));
  PetscCall(SceneGetFactor(sim->scene, 0, time, &next));
  if (now != 0.0 && next / now > 0.0) *scale = next / now;
  PetscFunctionReturn(0);
}

/* Advances the path to the state u; *u becomes the vector of the oldest state, for reuse */
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

/* n: solves with the present stiffness until the end of the load program, including this one; with contact updates
   at least one per load step is assumed */
PetscErrorCode PathSolvesToCome(Simulation sim, PetscInt *n)
{
  const PetscReal updates = sim->scene->npairs && sim->scene->contact_updates > 1 ? 2.0 : 1.0;
  PetscReal       steps   = PetscMax((PetscReal)sim->scene->nsteps - sim->path->time, 1.0);
  PetscBool       linear;

  PetscFunctionBegin;
  PetscCall(ElasticityIsLinear(sim->elasticity, &linear));
  if (!linear) steps = 1.0;
  *n = (PetscInt)(updates * steps);
  PetscFunctionReturn(0);
}
