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
  sim->control->forecast.found = forecast;
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
static PetscErrorCode ForecastTransfer(Simulation sim, const StepForecast *found, StepForecast *here)
{
  const PetscInt     n = found->nsteps * found->nfields;
  PetscInt           nlocal, missing;
  PetscReal         *values;
  const PetscScalar *x;

  PetscFunctionBegin;
  if (!n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(sim->places.x, &nlocal));
  PetscCall(PetscMalloc1(n * nlocal, &values));
  PetscCall(VecGetArrayRead(sim->places.x, &x));
  PetscCall(MeshEvaluate(found->dm, n, found->fields, nlocal / 3, (const PetscReal(*)[3])x, sim->places.body, values,
    &missing));
  PetscCall(VecRestoreArrayRead(sim->places.x, &x));
  if (!missing) {
    here->nsteps  = found->nsteps;
    here->nfields = found->nfields;
    PetscCall(PetscMalloc1(n, &here->fields));
  }
  for (PetscInt f = 0; f < n && !missing; ++f) {
    PetscScalar *a;

    PetscCall(VecDuplicate(sim->path->u, &here->fields[f]));
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
PetscErrorCode ForecastSetUp(Simulation sim)
{
  StepForecast *found = sim->control->forecast.found;

  PetscFunctionBegin;
  if (!found) PetscFunctionReturn(0);
  if (sim->control->warm && !sim->scene->displacement_bounds && (!sim->contact || sim->scene->contact_updates > 1))
    PetscCall(ForecastTransfer(sim, found, &sim->control->forecast.here));
  PetscCall(StepForecastDestroy(found));
  found->nfields = 1 + (sim->contact ? sim->scene->npairs : 0);
  found->dm      = sim->dm;
  PetscCall(PetscObjectReference((PetscObject)sim->dm));
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
PetscErrorCode ForecastRecord(Simulation sim)
{
  StepForecast *found = sim->control->forecast.found;
  Vec          *fields;

  PetscFunctionBegin;
  if (!found) PetscFunctionReturn(0);
  PetscCall(PetscRealloc((size_t)((found->nsteps + 1) * found->nfields) * sizeof(*fields), &found->fields));
  fields = &found->fields[found->nsteps++ * found->nfields];
  for (PetscInt f = 0; f < found->nfields; ++f) {
    PetscCall(VecDuplicate(sim->path->u, &fields[f]));
    PetscCall(VecZeroEntries(fields[f]));
    if (f) PetscCall(ForecastCopyPressures(sim->history, f - 1, fields[f], PETSC_FALSE));
  }
  PetscCall(VecCopy(sim->path->u, fields[0]));
  PetscFunctionReturn(0);
}

/*
   Sets u and the stored pressures to the forecast for the time p->time. *foreseen: true if a forecast for this time
   exists and its energy is finite; otherwise the pressures are unchanged.
*/
PetscErrorCode ForecastGet(const StepProblem *p, Vec u, PetscBool *foreseen)
{
  Simulation      sim    = p->sim;
  StepForecast   *here   = &sim->control->forecast.here;
  const PetscInt  step   = (PetscInt)p->time - sim->control->first_step;
  const PetscBool has    = (PetscBool)(p->time == PetscFloorReal(p->time) && step >= 1 && step <= here->nsteps);
  PetscReal       energy = 0.0;
  Vec            *fields = has ? &here->fields[(step - 1) * here->nfields] : NULL;

  PetscFunctionBegin;
  *foreseen = PETSC_FALSE;
  if (!has) PetscFunctionReturn(0);
  PetscCall(VecCopy(fields[0], u));
  PetscCall(PrescribedApply(&sim->prescribed, p->time, u));
  PetscCall(TiesFollow(&sim->ties, u));
  if (!sim->quadratic) PetscCall(ElasticityEnergy(sim->elasticity, u, &energy));
  *foreseen = sim->control->forecast.used = EnergyIsFinite(energy);
  for (PetscInt f = 1; *foreseen && f < here->nfields; ++f)
    PetscCall(ForecastCopyPressures(sim->history, f - 1, fields[f], PETSC_TRUE));
  PetscFunctionReturn(0);
}

/*
   Examines an attempt that has ended. If the attempt started from a forecast and failed, the forecast is not used in
   the rest of the run, and *again is true.
*/
PetscErrorCode ForecastAssess(Simulation sim, PetscBool converged, PetscBool *again)
{
  PetscFunctionBegin;
  *again                      = (PetscBool)(sim->control->forecast.used && !converged);
  sim->control->forecast.used = PETSC_FALSE;
  if (!*again) PetscFunctionReturn(0);
  sim->control->forecast.failed = PETSC_TRUE;
  PetscCall(StepForecastDestroy(&sim->control->forecast.here));
  if (sim->contact) PetscCall(PetscArrayzero(sim->history->pressure, sim->history->npairs * sim->history->nowned));
  PetscFunctionReturn(0);
}
