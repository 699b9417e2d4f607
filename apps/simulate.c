/* The run of a scene: load steps, results, checkpoints, and the meshes of -accuracy */
#include "appsimpl.h"
#include <step.h>
#include <accuracy.h>
#include <checkpoint.h>

static PetscErrorCode AppCreateSimulation(const AppOptions *app, Scene scene, Accuracy *accuracy,
  const MeshMarks *marks, Simulation *sim)
{
  StepTolerances tolerances;

  PetscFunctionBeginUser;
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, sim));
  PetscCall(SimulationGetTolerances(*sim, &tolerances));
  PetscCall(AccuracyPlan(accuracy, scene, &tolerances));
  PetscCall(SimulationSetTolerances(*sim, &tolerances));
  PetscCall(SimulationSetMonitor(*sim, (PetscBool)!app->quiet));
  PetscCall(SimulationSetFields(*sim, app->write, (PetscBool)(app->write && app->gauss)));
  PetscCall(SimulationSetFromOptions(*sim));
  if (accuracy->adaptive) PetscCall(SimulationSetMarks(*sim, marks));
  if (accuracy->target > 0.0) PetscCall(SimulationSetMeshFollows(*sim));
  PetscCall(SimulationSetUp(*sim));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppCreateOutput(const AppOptions *app, Scene scene, Simulation sim, Output *output)
{
  const char **names;
  char       **surfaces;
  DM           dm;

  PetscFunctionBeginUser;
  *output = NULL;
  if (!app->write) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(scene->nbodies, &names));
  PetscCall(PetscCalloc1(scene->nbodies, &surfaces));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    names[b] = scene->bodies[b].name;
    if (!SceneBodyIsSurface(&scene->bodies[b])) continue;
    PetscCall(PetscMalloc1(PETSC_MAX_PATH_LEN, &surfaces[b]));
    PetscCall(
      SceneSurfaceWrite(&scene->bodies[b], BodyShapes[scene->bodies[b].shape], surfaces[b], PETSC_MAX_PATH_LEN));
  }
  PetscCall(SimulationGetDM(sim, &dm));
  PetscCall(OutputCreate(dm, scene->nbodies, names, (const char *const *)surfaces, app->output, output));
  PetscCall(OutputSetUnits(*output, scene->units));
  PetscCall(OutputSetEvery(*output, app->every));
  for (PetscInt b = 0; b < scene->nbodies; ++b) PetscCall(PetscFree(surfaces[b]));
  PetscCall(PetscFree(surfaces));
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/* Prints the largest values, and the names of the files that the run has written */
static PetscErrorCode AppViewReport(const AppOptions *app, Scene scene, const RunReport *report)
{
  const char *const names[]                     = {app->output, app->output, app->output, app->summary, app->report},
                    *ends[]                     = {".xmf", ".csv", ".pvd", "", ""};
  const PetscBool writes[]                      = {app->write, app->write, app->vtk, app->summarize, app->page};
  RunReport       named                         = *report;
  char            files[5 * PETSC_MAX_PATH_LEN] = "";

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->nbodies && !app->vtk; ++b)
    if (SceneBodyIsSurface(&scene->bodies[b])) ends[0] = ".xmf (without the rigid surfaces: -output NAME.pvd has them)";
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(names); ++k) {
    size_t n = strlen(files);

    if (writes[k]) (void)snprintf(files + n, sizeof(files) - n, " %s%s", names[k], ends[k]);
  }
  named.files = files[0] ? files : NULL;
  PetscCall(ReportView(&named, PETSC_VIEWER_STDOUT_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppReport(const AppOptions *app, Scene scene, const RunReport *report)
{
  PetscFunctionBeginUser;
  if (app->tables) PetscCall(ReportViewTables(report, PETSC_VIEWER_STDOUT_WORLD));
  else if (report->accuracy && !app->quiet) PetscCall(ReportViewAccuracy(report, PETSC_VIEWER_STDOUT_WORLD));
  if (!app->quiet) PetscCall(AppViewReport(app, scene, report));
  if (app->summarize) PetscCall(ReportWriteJSON(PETSC_COMM_WORLD, report, app->summary));
  if (!report->converged)
    PetscCall(PetscFPrintf(PETSC_COMM_WORLD, stderr, "contact: load step %" PetscInt_FMT " failed: %s\n",
      report->steps[report->nsteps - 1].step, report->reason));
  else if (report->exit_code == RUN_ACCURACY_MISSED)
    PetscCall(PetscFPrintf(PETSC_COMM_WORLD, stderr, "contact: accuracy %g: %s\n", (double)report->accuracy->target,
      report->accuracy->end));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppCreateWriter(const AppOptions *app, Scene scene, Simulation sim, CheckpointWriter *writer)
{
  DM   dm;
  char file[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(AppGetCheckpointFile(app, scene, file));
  PetscCall(SimulationGetDM(sim, &dm));
  PetscCall(CheckpointWriterCreate(scene, dm, file, writer));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppWriteCheckpoint(const AppOptions *app, Scene scene, Simulation sim, CheckpointWriter writer)
{
  Checkpoint checkpoint;
  char       file[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(AppGetCheckpointFile(app, scene, file));
  PetscCall(SimulationGetCheckpoint(sim, &checkpoint));
  PetscCall(CheckpointWriterWrite(writer, checkpoint));
  if (!app->quiet) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "Checkpoint %s: time %g\n", file, (double)checkpoint->time));
  PetscCall(CheckpointDestroy(&checkpoint));
  PetscFunctionReturn(0);
}

/*
   Reads the checkpoint of a restarted run. *step: first load step to solve, 0 without restart; *same: whether the mesh
   is that of the checkpoint.
*/
static PetscErrorCode AppRestart(const AppOptions *app, Scene scene, Simulation sim, PetscInt *step, PetscBool *same)
{
  Checkpoint checkpoint;
  DM         dm;

  PetscFunctionBeginUser;
  *step = 0;
  *same = PETSC_TRUE;
  if (!app->restarts) PetscFunctionReturn(0);
  PetscCall(SimulationGetDM(sim, &dm));
  PetscCall(CheckpointRead(scene, dm, app->restart, &checkpoint, same));
  PetscCall(SimulationSetCheckpoint(sim, checkpoint, step));
  if (!app->quiet)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "Continuing from %s at time %g%s\n", app->restart, (double)checkpoint->time,
      *same ? "" : ", interpolated to this mesh and these ranks"));
  PetscCall(CheckpointDestroy(&checkpoint));
  PetscFunctionReturn(0);
}

/* Solves load steps until one fails. *converged: none failed. */
static PetscErrorCode AppSimulateSteps(const AppOptions *app, Scene scene, Simulation sim, PetscInt first,
  Output output, CheckpointWriter writer, PetscBool *converged)
{
  StepState state;

  PetscFunctionBeginUser;
  *converged = PETSC_TRUE;
  for (PetscInt step = first; step < scene->nsteps && *converged; ++step) {
    if (!app->quiet)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "Load step %" PetscInt_FMT " of %" PetscInt_FMT ", load factor %g\n",
        step + 1, scene->nsteps, (double)scene->ramps[0].factor[step]));
    PetscCall(SimulationStep(sim, step, &state));
    *converged = state.report->converged;
    if (output && *converged) PetscCall(OutputWrite(output, &state));
    if (*converged && app->checkpoint_every && (step + 1) % app->checkpoint_every == 0)
      PetscCall(AppWriteCheckpoint(app, scene, sim, writer));
  }
  PetscFunctionReturn(0);
}

/* Solves all load steps on one mesh. *again: -accuracy needs another run, with the settings that it has changed. */
static PetscErrorCode AppSimulate(const AppOptions *app, Scene scene, Accuracy *accuracy, MeshMarks *marks, RunEnd *end,
  PetscBool *again)
{
  Simulation       sim;
  Output           output;
  CheckpointWriter writer;
  StepTolerances   tolerances;
  RunReport        report;
  PetscBool        same, converged;
  PetscInt         first;
  const PetscInt   mesh = accuracy->mesh;

  PetscFunctionBeginUser;
  *again = PETSC_FALSE;
  PetscCall(AppCreateSimulation(app, scene, accuracy, marks, &sim));
  PetscCall(AppRestart(app, scene, sim, &first, &same));
  PetscCall(AppCreateOutput(app, scene, sim, &output));
  if (output && first) PetscCall(OutputContinue(output, first, SceneTimeStep(scene), same));
  if (app->contact_free) PetscCall(SimulationContactFree(sim));
  PetscCall(AppCreateWriter(app, scene, sim, &writer));
  PetscCall(AppSimulateSteps(app, scene, sim, first, output, writer, &converged));
  PetscCall(SimulationGetReport(sim, &report));
  PetscCall(SimulationGetTolerances(sim, &tolerances));
  if (converged && accuracy->adaptive) PetscCall(SimulationPropose(sim, &accuracy->growth));
  if (converged) PetscCall(AccuracyAssess(accuracy, &tolerances, &report, scene, again));
  if (accuracy->adaptive && accuracy->mesh > mesh) PetscCall(SimulationMark(sim, marks));
  if (accuracy->nlevels) report.accuracy = accuracy;
  if (converged && report.accuracy && !accuracy->reached) report.exit_code = RUN_ACCURACY_MISSED;
  if (report.exit_code == RUN_INTERRUPTED) PetscCall(AppWriteCheckpoint(app, scene, sim, writer));
  PetscCall(CheckpointWriterDestroy(&writer));
  *end = (RunEnd)report.exit_code;
  if (!*again) PetscCall(AppReport(app, scene, &report));
  PetscCall(OutputDestroy(&output));
  PetscCall(SimulationDestroy(&sim));
  PetscFunctionReturn(0);
}

PetscErrorCode AppSolve(const AppOptions *app, Scene scene, RunEnd *end)
{
  Accuracy  accuracy;
  MeshMarks marks = {0, NULL, NULL};
  PetscBool again;

  PetscFunctionBeginUser;
  PetscCall(AppCheckFiles(app, scene));
  PetscCall(AccuracySetFromOptions(PETSC_COMM_WORLD, &accuracy));
  PetscCheck(!accuracy.target || (!app->restarts && !app->checkpoint_every), PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "-accuracy solves the scene on several meshes: it cannot be combined with -checkpoint_every or -restart");
  PetscCall(SimulationCatchSignals());
  do {
    PetscCall(AppSimulate(app, scene, &accuracy, &marks, end, &again));
    if (again && !app->quiet) PetscCall(ReportViewNextMesh(&accuracy, scene->refine, PETSC_VIEWER_STDOUT_WORLD));
  } while (again);
  PetscCall(AccuracyDestroy(&accuracy));
  PetscCall(MeshMarksDestroy(&marks));
  PetscFunctionReturn(0);
}
