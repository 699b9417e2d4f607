/* Stores the last two equilibrium states of the path, and extrapolates the path from them. */
#include "stateimpl.h"
#include "src/state/path.h"

/*
   Computes the next increment of the path as a multiple of the last one. *ratio: projection of the change of all ramps
   on their last change. If a load program changes its direction (for example from pressing to sliding), the ratio is
   thus small. It is 0 instead of negative if metal has yielded: the bodies then unload elastically, so the path back
   differs from the path on which they yielded.
*/
static PetscErrorCode PathRatio(Model model, State state, PetscReal time, PetscReal *ratio)
{
  const LoadPath *path    = state->path;
  PetscReal       product = 0.0, square = 0.0;
  PetscBool       yielded = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < model->scene->nramps; ++r) {
    PetscReal before, now, next;

    PetscCall(SceneGetFactor(model->scene, r, path->previous_time, &before));
    PetscCall(SceneGetFactor(model->scene, r, path->time, &now));
    PetscCall(SceneGetFactor(model->scene, r, time, &next));
    product += (next - now) * (now - before);
    square += (now - before) * (now - before);
  }
  *ratio = square > 0.0 ? product / square : 0.0;
  if (*ratio < 0.0) PetscCall(ElasticityHasYielded(model->elasticity, &yielded));
  if (yielded) *ratio = 0.0;
  PetscFunctionReturn(0);
}

/*
   Extrapolates the path to `time`. u: extrapolated displacement, with the prescribed displacements of this time. A
   dynamic analysis extrapolates with velocities and accelerations.
*/
PetscErrorCode PathContinue(Model model, State state, PetscReal time, Vec u)
{
  PetscReal ratio = 0.0;

  PetscFunctionBegin;
  if (ModelIsDynamic(model)) {
    PetscCall(
      SchemePredict(&model->dynamics, (time - state->path->time) * SceneTimeStep(model->scene), state->path->u, u));
  } else {
    PetscCall(PathRatio(model, state, time, &ratio));
    PetscCall(VecCopy(state->path->u, u));
    PetscCall(VecAXPY(u, ratio, state->path->u));
    PetscCall(VecAXPY(u, -ratio, state->path->previous_u));
  }
  PetscCall(PrescribedApply(&model->prescribed, time, u));
  PetscCall(TiesFollow(&model->ties, u));
  PetscFunctionReturn(0);
}

/*
   Finds whether the state at `time` continues the path: prescribed displacements are those of the extrapolated path, up
   to a fraction of the increment
*/
PetscErrorCode PathIsSmooth(Model model, State state, PetscReal time, PetscBool *smooth)
{
  const PetscReal fraction = 0.3;
  PetscReal       ratio    = 0.0, increment, off;
  Vec             step, u;

  PetscFunctionBegin;
  PetscCall(PathRatio(model, state, time, &ratio));
  PetscCall(VecDuplicate(state->path->u, &step));
  PetscCall(VecDuplicate(state->path->u, &u));
  PetscCall(VecWAXPY(step, -1.0, state->path->previous_u, state->path->u));
  PetscCall(VecScale(step, ratio));
  PetscCall(VecNorm(step, NORM_INFINITY, &increment));
  PetscCall(VecAXPY(step, 1.0, state->path->u));
  PetscCall(VecCopy(step, u));
  PetscCall(PrescribedApply(&model->prescribed, time, u));
  PetscCall(VecAXPY(u, -1.0, step));
  PetscCall(VecNorm(u, NORM_INFINITY, &off));
  *smooth = (PetscBool)(increment > 0.0 && off <= fraction * increment);
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&step));
  PetscFunctionReturn(0);
}

/*
   Computes the factor for the stored pressures at the start of a load step. *scale: ratio of the ramp factors at `time`
   and at the last state if there is only one ramp, because pressures are then about proportional to it; otherwise 1.
*/
PetscErrorCode PathPressureScale(Model model, State state, PetscReal time, PetscReal *scale)
{
  PetscReal now, next;

  PetscFunctionBegin;
  *scale = 1.0;
  if (model->scene->nramps > 1 || ModelIsDynamic(model)) PetscFunctionReturn(0);
  PetscCall(SceneGetFactor(model->scene, 0, state->path->time, &now));
  PetscCall(SceneGetFactor(model->scene, 0, time, &next));
  if (now != 0.0 && next / now > 0.0) *scale = next / now;
  PetscFunctionReturn(0);
}

/* Advances the path to the state u. On exit *u is the vector of the oldest state, whose memory is reused. */
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
