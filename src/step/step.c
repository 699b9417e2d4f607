/* Solves a load step: first as a whole, then in smaller increments if that fails. */
#include "stepimpl.h"
#include <math.h>
#include <petsctime.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/interrupt.h"
#include "src/state/path.h"
#include "src/state/results.h"

/* Fills the part of the report that is known before the load step is solved. */
static PetscErrorCode SimulationBeginReport(Simulation sim, PetscInt step, StepReport *report)
{
  Scene scene = sim->model->scene;

  PetscFunctionBegin;
  PetscCall(ResultsFree(sim->results)); /* they are those of the load step before */
  report->step    = step + 1;
  report->time    = (PetscReal)(step + 1) * SceneTimeStep(scene);
  report->gap_min = report->gap_true = report->error_estimate = report->imbalance = NAN;

  report->load   = scene->ramps[0].factor[step];
  report->nramps = scene->nramps;
  PetscCall(PetscMalloc1(scene->nramps, &report->ramps));
  for (PetscInt r = 0; r < scene->nramps; ++r)
    report->ramps[r] = (RampReport){scene->ramps[r].name, scene->ramps[r].factor[step]};
  sim->report.nsteps           = step + 1 - sim->state->control->first_step;
  sim->state->path->unbalanced = sim->state->path->turnover = 0.0;
  sim->state->path->pressed                                 = sim->state->path->presses;
  sim->state->control->unsupported                          = 0;
  PetscCall(PetscFree(sim->state->control->cause));
  sim->state->control->time_step = (TimeStepControl){.shortest = 1.0};
  if (sim->model->contact && scene->dynamics.tolerance > 0.0)
    PetscCall(ContactHistoryCountClosed(sim->state->history, sim->model->comm, &sim->state->control->time_step.closed));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationGetState(Simulation sim, StepReport *report, StepState *state)
{
  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(PetscFree(sim->results->stress));
  PetscCall(ElasticityCellStress(sim->model->elasticity, sim->state->path->u, &sim->results->stress));
  PetscCall(ContactPointsMeasure(sim->model, sim->state, report));
  if (sim->model->contact) PetscCall(PenetrationMeasure(sim->model, sim->state, report));
  if (sim->model->contact && report->converged) PetscCall(PenetrationTest(sim, report));
  if (report->converged) PetscCall(StrainTest(sim, report));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(ResultsMeasure(sim, report));
  PetscCall(RigidPlacesMeasure(sim, report));
  PetscCall(TorquesMeasure(sim->model->scene, report));
  PetscCall(ProbesMeasure(sim->model, sim->state, sim->results, report));
  *state = (StepState){
    .report            = report,
    .displacement      = sim->state->path->u,
    .velocity          = sim->model->dynamics.velocity,
    .stress            = sim->results->stress,
    .nodal             = sim->results->nodal,
    .reaction          = sim->results->reaction,
    .plastic           = sim->results->plastic,
    .density           = sim->results->density,
    .nquadrature       = sim->results->npoints,
    .quadrature        = sim->results->places,
    .quadrature_stress = sim->results->point_stress,
    .npoints           = sim->state->solved->npoints,
    .points            = sim->state->solved->points,
  };
  PetscFunctionReturn(0);
}

/* Checks that `step` is the next load step: the time of the last state is its start, or a time within it after a
   failed attempt. */
static PetscErrorCode SimulationCheckStep(Model model, State state, RunReport *report, PetscInt step)
{
  const PetscInt next = (PetscInt)PetscFloorReal(state->path->time);

  PetscFunctionBegin;
  PetscCheck(report->steps, model->comm, PETSC_ERR_ORDER, "call SimulationSetUp() before SimulationStep()");
  PetscCheck(step >= 0 && step < model->scene->nsteps, model->comm, PETSC_ERR_ARG_OUTOFRANGE,
    "load step %" PetscInt_FMT " is not one of 0 to %" PetscInt_FMT, step, model->scene->nsteps - 1);
  PetscCheck(step == next, model->comm, PETSC_ERR_ORDER,
    "load step %" PetscInt_FMT " is not the next one, which is %" PetscInt_FMT, step, next);
  PetscFunctionReturn(0);
}

/* Halves the time increment after a failed attempt. *again: false if no further cut is allowed. */
static PetscErrorCode SimulationCut(Model model, State state, StepReport *report, PetscReal *increment,
  PetscBool *again)
{
  /* if the problem is linear, smaller increments cannot help */
  const PetscBool linear = (PetscBool)(model->quadratic && !model->contact);

  PetscFunctionBegin;
  *again = (PetscBool)(!linear && !state->control->interrupted && report->cuts < state->control->maxcuts &&
                       state->control->unsupported < 2);
  if (!*again) PetscFunctionReturn(0);
  ++report->cuts;
  *increment *= 0.5;
  if (state->control->monitor)
    PetscCall(PetscPrintf(model->comm, "Load step %" PetscInt_FMT " cut to time %g: %s\n", report->step,
      (double)(state->path->time + *increment), report->reason));
  PetscFunctionReturn(0);
}

/* Shortens a controlled time step whose error was too large. A step of half the length has a quarter of the error. */
static PetscErrorCode SimulationShorten(Model model, State state, const StepReport *report, PetscReal *increment)
{
  TimeStepControl *c = &state->control->time_step;
  PetscReal        left;

  PetscFunctionBegin;
  ++c->rejected;
  for (left = c->error; left > model->scene->dynamics.tolerance && *increment > STEP_SHORTEST; left *= 0.25)
    *increment *= 0.5;
  if (state->control->monitor)
    PetscCall(PetscPrintf(model->comm, "Load step %" PetscInt_FMT " repeated from time %g with time steps of %g: %s\n",
      report->step, (double)(state->path->time * SceneTimeStep(model->scene)),
      (double)(*increment * SceneTimeStep(model->scene)), report->reason));
  PetscFunctionReturn(0);
}

/* Returns the time increment after a successful attempt: twice the last one. The increment is not doubled if a
   controlled time step has too large an error, or if longer steps would not end at the ends of load steps. */
static PetscReal SimulationLengthen(Model model, State state, PetscReal increment)
{
  const PetscReal tolerance = model->scene->dynamics.tolerance, safe = 0.125;
  const PetscReal longer = 2.0 * increment, steps = state->path->time / longer;

  if (tolerance > 0.0 && (state->control->time_step.error > safe * tolerance || longer > 1.0 ||
                           PetscAbsReal(steps - PetscFloorReal(steps + 0.5)) > PETSC_SQRT_MACHINE_EPSILON))
    return increment;
  return longer;
}

/*
   Collective. Takes one increment towards the end of the step, and chooses the next one. *again: set to false if the
   increment cannot be cut further
*/
static PetscErrorCode SimulationAdvance(Simulation sim, PetscReal end, StepReport *report, PetscReal *increment,
  PetscBool *again)
{
  const PetscReal left = end - sim->state->path->time;
  PetscBool       repeated;

  PetscFunctionBegin;
  if (*increment > left * (1.0 - PETSC_SQRT_MACHINE_EPSILON)) *increment = left;
  PetscCall(SimulationAttempt(sim, *increment == left ? end : sim->state->path->time + *increment, report));
  if (report->converged) {
    ++report->substeps;
    PetscCall(DualGapsAccept(sim, report));
    if (sim->state->control->observer.reach) PetscCall(sim->state->control->observer.reach(sim));
    *increment = SimulationLengthen(sim->model, sim->state, *increment);
  }
  if (sim->state->control->time_step.too_long) PetscCall(SimulationShorten(sim->model, sim->state, report, increment));
  else if (!report->converged) {
    PetscCall(DualGapsTry(sim->model, sim->state, report, &repeated));
    if (!repeated) PetscCall(SimulationCut(sim->model, sim->state, report, increment, again));
  }
  sim->state->control->increment = *increment;
  PetscFunctionReturn(0);
}

/* If rounding errors of the stiffest body's forces may be what ended the step, says so; other reasons are unreliable
   then, but for a proof that contact cannot hold the loads, in which no stiffness enters */
static PetscErrorCode SimulationReportRounding(Simulation sim, StepReport *report)
{
  const SceneBody *soft, *hard;
  const PetscReal  ratio = SceneRatioBeyondRounding(sim->model->scene, &soft, &hard);

  PetscFunctionBegin;
  if (ratio == 0.0 || report->converged || sim->state->control->interrupted || sim->state->control->unsupported)
    PetscFunctionReturn(0);
  PetscCall(ReportReason(report, PETSC_FALSE,
    "no equilibrium was found: body \"%s\" is %.1g times as stiff as body \"%s\", so that rounding errors of its "
    "forces "
    "exceed the forces between them; use material: rigid",
    hard->name, (double)ratio, soft->name));
  PetscFunctionReturn(0);
}

/* Writes the outcome of the step into the report of the run */
static PetscErrorCode SimulationReportStep(Simulation sim, StepReport *report)
{
  PetscFunctionBegin;
  /* the reason of the first of the failed attempts is reported, not that of a later one with a smaller increment */
  if (!report->converged && sim->state->control->cause && !sim->state->control->interrupted)
    PetscCall(ReportReason(report, PETSC_FALSE, "%s", sim->state->control->cause));
  PetscCall(SimulationReportRounding(sim, report));
  if (!report->converged || report->gap_unconverged) sim->report.reason = report->reason;
  if (report->converged) PetscFunctionReturn(0);
  sim->report.converged = PETSC_FALSE;
  sim->report.exit_code = sim->state->control->interrupted ? RUN_INTERRUPTED
                          : report->gap_unconverged        ? RUN_GAP_UNCONVERGED
                                                           : RUN_FAILED;
  PetscFunctionReturn(0);
}

/*
   Collective. Warns in a dynamic analysis without interference if the normal forces of contact have given or taken more
   than 1 % of the energy that the bodies have or that the loads have given, and again if it is twice as much. They give
   some if a curved gap changes much in a time step, and take some where nodes with mass hit a face. Two rigid bodies
   were named at the start (StartWarnOfRigid()).
*/
static PetscErrorCode SimulationWarnOfGain(Simulation sim, const StepReport *report)
{
  const PetscReal allowed = PetscMax(1e-2, 2.0 * sim->state->path->told),
                  taken   = report->contact_work - report->dissipated - report->contact_energy;
  PetscReal energy;
  PetscBool intended = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < sim->model->scene->npairs; ++p) {
    const SceneContactPair *pair = &sim->model->scene->pairs[p];

    intended = (PetscBool)(intended || pair->interference > 0.0 || SceneContactPairIsRigid(sim->model->scene, pair));
  }
  if (!report->converged || !report->nmotions || intended) PetscFunctionReturn(0);
  energy = PetscMax(sim->model->dynamics.kinetic,
    PetscMax(PetscAbsReal(report->work), PetscAbsReal(report->motions->total_energy)));
  if (!(PetscAbsReal(taken) > allowed * energy)) PetscFunctionReturn(0);
  sim->state->path->told = PetscAbsReal(taken) / energy;
  PetscCall(ReportWarn(sim->model->comm, &sim->report, NULL,
    "load step %" PetscInt_FMT ": the normal forces of contact have %s %.2g %% of the energy (%g of %g), which is an "
    "error of the time steps: use shorter time steps or smaller cells at the contact",
    report->step, taken > 0.0 ? "taken" : "given", 100.0 * (double)sim->state->path->told, (double)PetscAbsReal(taken),
    (double)energy));
  PetscFunctionReturn(0);
}

/* Collective. Warns of what the whole run shows, after its last step */
static PetscErrorCode SimulationWarn(Simulation sim, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(StartWarnOfUnmet(sim, report));
  PetscCall(PenetrationWarn(sim));
  PetscCall(PairMeshWarn(sim));
  PetscFunctionReturn(0);
}

/*@C
   SimulationStep - Solves the next load step

   Collective

   Input Parameters:
+  sim  - the simulation
-  step - number of the step, from 0; steps are taken in order, each once

   Output Parameter:
.  state - the state at the end of the step, owned by the simulation, valid until the next step. Check
           state->report->converged: if it is false, the displacement is that of the last converged solve

   Level: beginner

   Notes:
   The gap is linearized at the state before the step: deformed mesh, search, mortar integrals. If contact_updates
   allows more than one linearization, the first is at the state extrapolated from the last two, except in the first
   step, after a cut and with friction. Contact updates linearize the gap again at the solution, up to contact_updates
   times, until the linearized and the actual gap agree within `-contact_gap_tol`. If they do not, the step has not
   converged, unless contact_updates is 1.

   With linear bodies, or `model: quadratic` in the scene, the step is a quadratic program; otherwise the true energy is
   minimized. A quadratic step without contact pairs is one PCG solve (options prefix -elasticity_).

   A step with friction that fails is attempted again with dual shape functions, if contact pairs have gap: auto. A step
   that fails is halved, and repeated from the last converged state. After each success the step size is doubled.
   With a tolerance in `dynamics` a step is divided into time steps whose error is below the tolerance.

   Errors: PETSC_ERR_ORDER before SimulationSetUp(), or for a step that is not the next one; PETSC_ERR_ARG_OUTOFRANGE
   for one that the scene does not have.

.seealso: `SimulationCreate()`, `SimulationGetReport()`, `TAOIPFILTER`
@*/
PetscErrorCode SimulationStep(Simulation sim, PetscInt step, StepState *state)
{
  const PetscReal end = (PetscReal)(step + 1);
  PetscReal       increment =
    sim->state->control->increment > 0.0 ? sim->state->control->increment : end - sim->state->path->time;
  PetscBool      again = PETSC_TRUE, stop;
  StepReport    *report;
  PetscLogDouble t0, t1;

  PetscFunctionBegin;
  PetscCall(SimulationCheckStep(sim->model, sim->state, &sim->report, step));
  report = &sim->report.steps[step - sim->state->control->first_step];
  PetscCall(PetscTime(&t0));
  PetscCall(SimulationBeginReport(sim, step, report));
  if (sim->state->control->observer.begin) PetscCall(sim->state->control->observer.begin(sim));
  while (again && sim->state->path->time < end) {
    PetscCall(InterruptTest(sim->model, sim->state, &stop));
    if (stop) {
      PetscCall(InterruptReport(sim->state, report));
      break;
    }
    PetscCall(SimulationAdvance(sim, end, report, &increment, &again));
  }
  if (sim->state->path->time >= end) {
    if (sim->model->scene->dynamics.tolerance == 0.0) sim->state->control->increment = 0.0;
    PetscCall(WorkWarn(sim, report));
    PetscCall(SimulationWarnOfGain(sim, report));
  }
  PetscCall(SimulationReportStep(sim, report));
  PetscCall(SimulationGetState(sim, report, state));
  PetscCall(PetscTime(&t1));
  report->step_time = t1 - t0;
  PetscCall(DisplacementWarn(sim, report));
  if (report->converged && step + 1 == sim->model->scene->nsteps) PetscCall(SimulationWarn(sim, report));
  PetscFunctionReturn(0);
}
