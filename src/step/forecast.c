/*
   Starts load steps from results on another mesh of the same bodies, such as the coarser mesh of a run with -accuracy.
   Displacements and pressures at the end of each load step are interpolated to the present mesh. The gap is linearized
   at the interpolated displacement, so that fewer contact updates are needed.
*/
#include "stepimpl.h"
#include "src/state/contact_history.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   Collective. Makes load steps start from their final states on another mesh, and records their final states on the
   present mesh. sim: the simulation, before SimulationSetUp(); forecast: on entry the states on the other mesh, or
   zeros; it is filled with the states on the present mesh at the end of each load step, and must exist until the
   simulation is destroyed.

     A forecast changes only the starting point: results agree with those without a forecast up to the tolerances of the
     solvers, and a load step that fails with a forecast is repeated without it. The forecast is not used if only one
     linearization of the gap is allowed (which must be at the last state), or if displacements are bounded by the last
     increments.
*/
PetscErrorCode SimulationSetForecast(Simulation sim, StepForecast *forecast)
{
  PetscFunctionBegin;
  sim->state->control->forecast.found = forecast;
  PetscFunctionReturn(0);
}

/* Collective. Frees the contents of a forecast and sets the forecast to zeros. */
PetscErrorCode StepForecastDestroy(StepForecast *forecast)
{
  PetscFunctionBegin;
  for (PetscInt f = 0; f < forecast->nsteps * forecast->nfields; ++f) PetscCall(VecDestroy(&forecast->fields[f]));
  PetscCall(PetscFree(forecast->fields));
  PetscCall(DMDestroy(&forecast->dm));
  forecast->nsteps = 0;
  PetscFunctionReturn(0);
}

/*
   Interpolates the fields of another mesh to the nodes of the present mesh. *here remains empty if nodes of the present
   mesh are too far outside of the other mesh.
*/
static PetscErrorCode ForecastTransfer(Model model, State state, const StepForecast *found, StepForecast *here)
{
  const PetscInt     n = found->nsteps * found->nfields;
  PetscInt           nlocal, missing;
  PetscReal         *values;
  const PetscScalar *x;

  PetscFunctionBegin;
  if (!n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(model->places.x, &nlocal));
  PetscCall(PetscMalloc1(n * nlocal, &values));
  PetscCall(VecGetArrayRead(model->places.x, &x));
  PetscCall(MeshEvaluate(found->dm, n, found->fields, nlocal / 3, (const PetscReal(*)[3])x, model->places.body, values,
    &missing));
  PetscCall(VecRestoreArrayRead(model->places.x, &x));
  if (!missing) {
    here->nsteps  = found->nsteps;
    here->nfields = found->nfields;
    PetscCall(PetscMalloc1(n, &here->fields));
  }
  for (PetscInt f = 0; f < n && !missing; ++f) {
    PetscScalar *a;

    PetscCall(VecDuplicate(state->path->u, &here->fields[f]));
    PetscCall(VecGetArrayWrite(here->fields[f], &a));
    for (PetscInt i = 0; i < nlocal; ++i) a[i] = values[3 * (n * (i / 3) + f) + i % 3];
    PetscCall(VecRestoreArrayWrite(here->fields[f], &a));
  }
  PetscCall(PetscFree(values));
  PetscFunctionReturn(0);
}

/*
   Interpolates the caller's forecast to the present mesh and empties it, so that it then collects the states on the
   present mesh. Call this function when mesh and contact exist.
*/
PetscErrorCode ForecastSetUp(Model model, State state)
{
  StepForecast *found = state->control->forecast.found;

  PetscFunctionBegin;
  if (!found) PetscFunctionReturn(0);
  if (state->control->warm && !model->scene->displacement_bounds &&
      (!model->contact || model->scene->contact_updates > 1))
    PetscCall(ForecastTransfer(model, state, found, &state->control->forecast.here));
  PetscCall(StepForecastDestroy(found));
  found->nfields = 1 + (model->contact ? model->scene->npairs : 0);
  found->dm      = model->dm;
  PetscCall(PetscObjectReference((PetscObject)model->dm));
  PetscFunctionReturn(0);
}

/*
   Copies the stored pressures of a pair to the first component of a nodal field; if `back`, copies the first component
   of the field to the stored pressures.
*/
static PetscErrorCode ForecastCopyPressures(ContactHistory *m, PetscInt pair, Vec field, PetscBool back)
{
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArray(field, &a));
  for (PetscInt i = 0; i < m->nowned; ++i) {
    const PetscInt k = pair * m->nowned + i;

    if (!back) a[3 * i] = m->pressure[k];
    else {
      m->pressure[k] = PetscMax(PetscRealPart(a[3 * i]), 0.0);
      m->slack[k]    = 0.0;
      m->open[k]     = PETSC_FALSE;
    }
  }
  PetscCall(VecRestoreArray(field, &a));
  PetscFunctionReturn(0);
}

/* Appends the state at the end of a converged load step to the caller's forecast. */
PetscErrorCode ForecastRecord(State state)
{
  StepForecast *found = state->control->forecast.found;
  Vec          *fields;

  PetscFunctionBegin;
  if (!found) PetscFunctionReturn(0);
  PetscCall(PetscRealloc((size_t)((found->nsteps + 1) * found->nfields) * sizeof(*fields), &found->fields));
  fields = &found->fields[found->nsteps++ * found->nfields];
  for (PetscInt f = 0; f < found->nfields; ++f) {
    PetscCall(VecDuplicate(state->path->u, &fields[f]));
    PetscCall(VecZeroEntries(fields[f]));
    if (f) PetscCall(ForecastCopyPressures(state->history, f - 1, fields[f], PETSC_FALSE));
  }
  PetscCall(VecCopy(state->path->u, fields[0]));
  PetscFunctionReturn(0);
}

/*
   Sets u and the stored pressures to the forecast for the time p->time. *foreseen: true if a forecast for this time
   exists and its energy is finite; otherwise the pressures are unchanged.
*/
PetscErrorCode ForecastGet(const StepProblem *p, Vec u, PetscBool *foreseen)
{
  StepForecast   *here   = &p->state->control->forecast.here;
  const PetscInt  step   = (PetscInt)p->time - p->state->control->first_step;
  const PetscBool has    = (PetscBool)(p->time == PetscFloorReal(p->time) && step >= 1 && step <= here->nsteps);
  PetscReal       energy = 0.0;
  Vec            *fields = has ? &here->fields[(step - 1) * here->nfields] : NULL;

  PetscFunctionBegin;
  *foreseen = PETSC_FALSE;
  if (!has) PetscFunctionReturn(0);
  PetscCall(VecCopy(fields[0], u));
  PetscCall(PrescribedApply(&p->model->prescribed, p->time, u));
  PetscCall(TiesFollow(&p->model->ties, u));
  if (!p->model->quadratic) PetscCall(ElasticityEnergy(p->model->elasticity, u, &energy));
  *foreseen = p->state->control->forecast.used = EnergyIsFinite(energy);
  for (PetscInt f = 1; *foreseen && f < here->nfields; ++f)
    PetscCall(ForecastCopyPressures(p->state->history, f - 1, fields[f], PETSC_TRUE));
  PetscFunctionReturn(0);
}

/*
   Examines an attempt that has ended. If the attempt started from a forecast and failed, the forecast is not used in
   the rest of the run, and *again is true.
*/
PetscErrorCode ForecastAssess(Model model, State state, PetscBool converged, PetscBool *again)
{
  PetscFunctionBegin;
  *again                        = (PetscBool)(state->control->forecast.used && !converged);
  state->control->forecast.used = PETSC_FALSE;
  if (!*again) PetscFunctionReturn(0);
  state->control->forecast.failed = PETSC_TRUE;
  PetscCall(StepForecastDestroy(&state->control->forecast.here));
  if (model->contact)
    PetscCall(PetscArrayzero(state->history->pressure, state->history->npairs * state->history->nowned));
  PetscFunctionReturn(0);
}
