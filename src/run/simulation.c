/* Creates and destroys a simulation, and sets its parameters */
#include "runimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"
#include "src/state/results.h"
#include "src/state/run.h"

/* The simulation and its parts, in one block of memory */
typedef struct {
  struct _n_Simulation simulation;
  struct _n_Model      model;
  struct _n_State      state;
  LoadPath             path;
  ContactHistory       history;
  ContactState         solved;
  Results              results;
  StepControl          control;
  RunState             run;
} SimulationMemory;

/*@C
   SimulationCreate - Prepares to simulate a scene

   Collective

   Input Parameters:
+  comm  - the communicator
-  scene - the scene; must outlive the simulation

   Output Parameter:
.  sim - the simulation

   Level: beginner

.seealso: `SimulationSetTolerances()`, `SimulationSetMonitor()`, `SimulationSetFromOptions()`, `SimulationSetUp()`,
          `SimulationDestroy()`, `SceneLoad()`
@*/
PetscErrorCode SimulationCreate(MPI_Comm comm, Scene scene, Simulation *sim)
{
  SimulationMemory *memory;

  PetscFunctionBegin;
  PetscCall(EventsRegister());
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(ContactDetect(comm, scene));
  PetscCall(PetscNew(&memory));
  *sim                  = &memory->simulation;
  (*sim)->model         = &memory->model;
  (*sim)->state         = &memory->state;
  (*sim)->results       = &memory->results;
  (*sim)->run           = &memory->run;
  memory->model.comm    = comm;
  memory->model.scene   = scene;
  memory->state.path    = &memory->path;
  memory->state.history = &memory->history;
  memory->state.solved  = &memory->solved;
  memory->state.control = &memory->control;
  /* default values */
  memory->results.estimate = PETSC_TRUE;
  memory->control.warm     = PETSC_TRUE;
  memory->control.maxcuts  = 5;
  memory->control.tolerances =
    (StepTolerances){.optimizer = PETSC_DEFAULT, .linear = 1e-10, .gap_change = 1e-6, .gap_unconverged = 1e-5};
  PetscCall(ProgressObserve(*sim));
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetTolerances - Sets the tolerances of a simulation's solvers, unless options set them

   Logically Collective

   Input Parameters:
+  sim        - the simulation, before SimulationSetFromOptions()
-  tolerances - the tolerances

   Level: intermediate

   Note:
   These options take precedence: `-tao_gatol` and `-tao_ipfilter_tol` for the optimizer, `-elasticity_ksp_rtol` for the
   linear solver, `-contact_update_tol` and `-contact_gap_tol` for the gap.

.seealso: `SimulationGetTolerances()`
@*/
PetscErrorCode SimulationSetTolerances(Simulation sim, const StepTolerances *tolerances)
{
  PetscFunctionBegin;
  sim->state->control->tolerances = *tolerances;
  PetscFunctionReturn(0);
}

/*@C
   SimulationGetTolerances - Gets the tolerances of a simulation's solvers

   Not Collective

   Input Parameter:
.  sim - the simulation

   Output Parameter:
.  tolerances - the tolerances; after a load step those used, options included

   Level: intermediate

.seealso: `SimulationSetTolerances()`
@*/
PetscErrorCode SimulationGetTolerances(Simulation sim, StepTolerances *tolerances)
{
  PetscFunctionBegin;
  *tolerances = sim->state->control->tolerances;
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetMonitor - Sets whether a run prints why a load step is cut, and how the gap changes in each contact
   update

   Logically Collective

   Input Parameters:
+  sim     - the simulation, before SimulationSetFromOptions()
-  monitor - whether to print

   Level: intermediate

.seealso: `SimulationSetFromOptions()`
@*/
PetscErrorCode SimulationSetMonitor(Simulation sim, PetscBool monitor)
{
  PetscFunctionBegin;
  sim->state->control->monitor = monitor;
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetMeshFollows - Says that a run on a finer mesh may follow, so that progress messages do not estimate the
   remaining time

   Logically Collective

   Input Parameter:
.  sim - the simulation, before SimulationSetUp()

   Level: developer

.seealso: `SimulationSetMonitor()`
@*/
PetscErrorCode SimulationSetMeshFollows(Simulation sim)
{
  PetscFunctionBegin;
  sim->run->progress.follows = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetFields - Sets which fields the states of load steps have besides displacement, contact and mean stress
   of the cells

   Logically Collective

   Input Parameters:
+  sim    - the simulation, before SimulationSetUp()
.  nodes  - stress at the nodes with its principal values, strain energy of the cells; default false
-  points - stress at the quadrature points; default false

   Level: intermediate

.seealso: `SimulationStep()`, `OutputWrite()`
@*/
PetscErrorCode SimulationSetFields(Simulation sim, PetscBool nodes, PetscBool points)
{
  PetscFunctionBegin;
  sim->results->nodes  = nodes;
  sim->results->points = points;
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetFromOptions - Sets a simulation's parameters from the options

   Collective

   Input Parameter:
.  sim - the simulation, before SimulationSetUp()

   Options Database Keys:
+  -load_warm_start <bool>    - start a load step from an extrapolation of the last one and its pressures, or from the
                                final state on a coarser mesh; default true
.  -load_max_cuts <5>         - how often a failed load step is halved
.  -progress_every <10>       - interval of progress messages of a monitored run [s]; 0: none
.  -error_estimate <bool>     - estimate the discretization error at the end of every load step; default true
.  -contact_update_tol <1e-6> - contact updates end when the gap changes by less than this, relative to the largest
                                displacement
-  -contact_gap_tol <1e-5>    - a load step has not converged if the last change of the gap is larger than this,
                                relative to the largest displacement, unless the scene allows only one linearization

   Level: beginner

.seealso: `SimulationCreate()`, `SimulationSetUp()`
@*/
PetscErrorCode SimulationSetFromOptions(Simulation sim)
{
  PetscFunctionBegin;
  PetscOptionsBegin(sim->model->comm, NULL, "Load steps", NULL);
  PetscCall(PetscOptionsBool("-load_warm_start",
    "Start each load step from extrapolated displacements and the pressures of the previous step", "SimulationStep",
    sim->state->control->warm, &sim->state->control->warm, NULL));
  PetscCall(PetscOptionsInt("-load_max_cuts", "Number of times that a failed load step may be halved", "SimulationStep",
    sim->state->control->maxcuts, &sim->state->control->maxcuts, NULL));
  PetscCheck(sim->state->control->maxcuts >= 0, sim->model->comm, PETSC_ERR_USER_INPUT,
    "-load_max_cuts must be at least 0, not %" PetscInt_FMT, sim->state->control->maxcuts);
  PetscCall(PetscOptionsReal("-progress_every", "Seconds between two progress reports; 0: none", "SimulationStep",
    sim->run->progress.every, &sim->run->progress.every, NULL));
  PetscCall(PetscOptionsBool("-error_estimate", "Estimate the discretization error at the end of every load step",
    "SimulationStep", sim->results->estimate, &sim->results->estimate, NULL));
  PetscCall(PetscOptionsReal("-contact_update_tol",
    "Change of the gap, relative to the largest displacement, that ends the contact updates", "SimulationStep",
    sim->state->control->tolerances.gap_change, &sim->state->control->tolerances.gap_change, NULL));
  PetscCall(PetscOptionsReal("-contact_gap_tol",
    "Change of the gap, relative to the largest displacement, beyond which a load step has not converged",
    "SimulationStep", sim->state->control->tolerances.gap_unconverged, &sim->state->control->tolerances.gap_unconverged,
    NULL));
  PetscOptionsEnd();
  PetscCheck(sim->run->progress.every >= 0.0 && !PetscIsInfOrNanReal(sim->run->progress.every), sim->model->comm,
    PETSC_ERR_ARG_OUTOFRANGE, "-progress_every is a number of seconds, not negative, but is %g",
    (double)sim->run->progress.every);
  PetscFunctionReturn(0);
}

/*@C
   SimulationGetDM - Gets the mesh of all bodies

   Not Collective

   Input Parameter:
.  sim - the simulation, after SimulationSetUp()

   Output Parameter:
.  dm - the mesh, owned by the simulation

   Level: intermediate

.seealso: `SimulationSetUp()`, `MeshCreateScene()`
@*/
PetscErrorCode SimulationGetDM(Simulation sim, DM *dm)
{
  PetscFunctionBegin;
  *dm = sim->model->dm;
  PetscFunctionReturn(0);
}

/*@C
   SimulationGetReport - Gets the report of the run so far: one entry per load step, times of the phases, memory

   Collective

   Input Parameter:
.  sim - the simulation

   Output Parameter:
.  report - the report; its arrays and strings are owned by the simulation

   Level: intermediate

   Note:
   Phase times come from PETSc's events, so PetscLogDefaultBegin() (or -log_view) must have been called before the
   simulation was created; otherwise only the total is known.

.seealso: `ReportView()`, `ReportWriteJSON()`
@*/
PetscErrorCode SimulationGetReport(Simulation sim, RunReport *report)
{
  PetscFunctionBegin;
  PetscCall(EventsGetTimes(sim->model->comm, &sim->run->start, &sim->report.time));
  for (PetscInt b = 0; b < sim->report.nbodies; ++b)
    PetscCall(ElasticityGetAssemblies(sim->model->elasticity, b, &sim->report.assemblies[b]));
  PetscCall(FiguresCollect(&sim->report));
  PetscCall(MemoryUsageGetPeak(sim->model->comm, &sim->report.peak_memory_bytes));
  *report = sim->report;
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationFreeReport(RunReport *report)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < report->nsteps; ++i) {
    StepReport *step = &report->steps[i];

    PetscCall(PetscFree(step->ksp_iterations));
    PetscCall(PetscFree(step->body_errors));
    PetscCall(PetscFree(step->ramps));
    PetscCall(PetscFree(step->motions));
    PetscCall(PetscFree(step->probes));
    PetscCall(PetscFree(step->lines));
    PetscCall(ForcesFree(step));
    PetscCall(PetscFree(step->rigid_bodies));
    PetscCall(PetscFree(step->bolts));
    PetscCall(PetscFree(step->connectors));
    PetscCall(PetscFree(*(char **)&step->reason));
  }
  PetscCall(PetscFree(report->steps));
  PetscCall(PetscFree2(report->bodies, report->assemblies));
  PetscCall(PetscFree(report->figures));
  for (PetscInt i = 0; i < report->nwarnings; ++i) PetscCall(PetscFree(*(char **)&report->warnings[i]));
  PetscCall(PetscFree(report->warnings));
  PetscFunctionReturn(0);
}

/*@C
   SimulationDestroy - Frees a simulation and its report

   Collective

   Input Parameter:
.  sim - the simulation, set to NULL

   Level: beginner

.seealso: `SimulationCreate()`
@*/
PetscErrorCode SimulationDestroy(Simulation *sim)
{
  Simulation s = *sim;

  PetscFunctionBegin;
  if (!s) PetscFunctionReturn(0);
  PetscCall(SimulationFreeReport(&s->report));
  PetscCall(ContactSolutionDestroy(&s->state->solved->solution));
  PetscCall(PetscFree(s->state->control->cause));
  PetscCall(PetscFree(s->state->control->failure.reason));
  PetscCall(PetscFree(s->results->stress));
  PetscCall(PetscFree(s->state->solved->points));
  PetscCall(PetscFree(s->results->beyond));
  PetscCall(ResultsFree(s->results));
  PetscCall(PetscFree2(s->run->adapt.errors, s->run->adapt.marked));
  PetscCall(ProbesDestroy(&s->results->probes));
  PetscCall(ContactLinearizationDestroy(&s->state->solved->linearization));
  PetscCall(ContactLinearizationDestroy(&s->state->solved->upcoming));
  PetscCall(ContactHistoryDestroy(s->state->history));
  PetscCall(ContactDestroy(&s->model->contact));
  PetscCall(PrescribedDestroy(&s->model->prescribed));
  PetscCall(DeadLoadsDestroy(&s->model->loads));
  PetscCall(TemperaturesDestroy(&s->model->temperatures));
  PetscCall(SpringsDestroy(&s->model->springs));
  PetscCall(BoltsDestroy(&s->model->bolts));
  PetscCall(TiesDestroy(&s->model->ties));
  PetscCall(DynamicsDestroy(&s->model->dynamics));
  PetscCall(MatDestroy(&s->model->follows));
  PetscCall(RigidDestroy(&s->model->rigid));
  PetscCall(VertexPlacesDestroy(&s->model->places));
  PetscCall(KSPDestroy(&s->state->control->ksp));
  PetscCall(PetscContainerDestroy(&s->state->solved->subspace));
  PetscCall(ElasticityDestroy(&s->model->elasticity));
  PetscCall(MatDestroy(&s->model->K));
  PetscCall(VecDestroy(&s->model->mass));
  PetscCall(VecDestroy(&s->state->path->u));
  PetscCall(VecDestroy(&s->state->path->previous_u));
  PetscCall(VecDestroy(&s->state->path->outside));
  PetscCall(VecDestroy(&s->state->path->contact));
  PetscCall(DMDestroy(&s->model->dm));
  PetscCall(PetscFree(*sim));
  PetscFunctionReturn(0);
}
