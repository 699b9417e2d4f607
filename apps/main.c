static char help[] = "Contact of deformable bodies: contact SCENE.yaml [options]. SCENE.yaml describes the model.\n\
  -refine N            number of uniform refinements of the mesh\n\
  -load_steps N        number of load steps of equal size\n\
  -contact_updates N   largest number of contact updates per load step (20); with 1 the gap is not checked\n\
  -accuracy ERROR      choose mesh and tolerances for this relative error of energy and contact force\n\
  -accuracy_adaptive   refine only where the error is large\n\
  -accuracy_order 2    use elements of order 2 on the first mesh before the mesh is refined\n\
  -accuracy_of WHAT    quantities of -accuracy, all with the energy: energy; force (default): force of each pair;\n\
                       pressure: also the largest pressure of each pair; displacement: that of the probes\n\
Results\n\
  -output BASE         write fields for ParaView, BASE.xmf with BASE.h5 and BASE_0001.h5, ..., and a table with a\n\
                       line per load step, BASE.csv\n\
  -output_gauss        also write the stress at quadrature points, BASE_gauss.xmf\n\
  -summary FILE.json   write all numbers of the run\n\
  -report FILE.html    write a page with scene, pictures, curves, forces, accuracy and time. It also writes\n\
                       -output FILE and -summary FILE.json unless these are given\n\
  -checkpoint_every N  write a checkpoint after every N load steps. A run that is ended by a signal always does\n\
  -checkpoint FILE     name of the checkpoint; default BASE_checkpoint.h5, or <problem>_checkpoint.h5 without -output\n\
  -restart FILE        continue from a checkpoint; ranks, -refine and the later load program may differ\n\
What is printed\n\
  -accuracy_view       the meshes that -accuracy chose and their errors, also with -quiet\n\
  -effects_view        which effects the scene uses, why, and their share of the time\n\
  -contact_free        a comparison with the first load step without contact\n\
  -quiet               no line per iteration and no tables\n\
  -traceback           PETSc's traceback after an error\n\
Without a run\n\
  -scene_check         check the scene, build its mesh, print what would be simulated\n\
  -scene_keys          all keys of scene files with type, unit, meaning and default\n\
  -version, --help     the version; this text\n\
  -help                this text and all options of PETSc\n\
Exit code\n\
  0  all load steps converged, and a requested accuracy was reached\n\
  1  invalid scene, option or file; the message begins with \"contact: error:\"\n\
  2  a load step did not converge\n\
  3  a load step ended with an inconsistent contact gap\n\
  4  the requested accuracy was not reached\n\
  5  ended by SIGINT, SIGTERM or SIGUSR1\n\
  6  results could not be written\n\
  7  out of memory, or an error in the program or in a library\n\n";

#define _POSIX_C_SOURCE 200809L /* declares dup() and dprintf() */
#include <petscamgf.h>
#include <options.h>
#include <scene.h>
#include <mesh.h>
#include <contact.h>
#include <step.h>
#include <accuracy.h>
#include <checkpoint.h>
#include <output.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if defined(__GLIBC__)
  #include <malloc.h>
#endif

typedef struct {
  char scene[PETSC_MAX_PATH_LEN], output[PETSC_MAX_PATH_LEN], summary[PETSC_MAX_PATH_LEN],
    checkpoint[PETSC_MAX_PATH_LEN], restart[PETSC_MAX_PATH_LEN], report[PETSC_MAX_PATH_LEN];
  PetscInt  checkpoint_every; /* number of load steps from one checkpoint to the next; 0: a checkpoint is written
                                 only if a signal ends the run */
  PetscBool write, gauss, restarts, summarize, contact_free, effects, accuracy, check, quiet, page;
} AppOptions;

/* State of main() for the handling of errors */
typedef struct {
  MPI_Comm  meeting;   /* communicator on which ranks with an error wait for one another */
  int       said;      /* file descriptor for messages; stderr may be silenced while output is written */
  PetscBool traceback; /* the user asked for PETSc's traceback */
  PetscBool silent;    /* another rank prints the message */
  int       end;       /* exit code of the program */
  Scene     scene;     /* the scene that is simulated; NULL: it has not been read yet */
  PetscBool alone;     /* the error occurred on this rank only, and no other rank knows of it */
  char      sentence[512];
} AppError;

/*
   Returns the kind of end of a run to which a PETSc error code belongs. Most errors are caused by the input. The codes
   listed here are caused by the machine or by the program.
*/
static RunEnd AppClassifyError(PetscErrorCode n)
{
  static const PetscErrorCode faults[] = {PETSC_ERR_MEM, PETSC_ERR_PLIB, PETSC_ERR_LIB, PETSC_ERR_SIG, PETSC_ERR_MEMC,
    PETSC_ERR_ARG_CORRUPT, PETSC_ERR_ARG_NULL, PETSC_ERR_POINTER, PETSC_ERR_ORDER, PETSC_ERR_MPI, PETSC_ERR_SYS};

  if (n == PETSC_ERR_FILE_WRITE) return RUN_OUTPUT_LOST;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(faults); ++i) {
    if (n == faults[i]) return RUN_BROKEN;
  }
  return RUN_REFUSED;
}

/*
   Handles an error of PETSc. A collective error returns through all callers on every rank and is printed once, as one
   sentence or as PETSc's traceback. An error that occurs on one rank only ends the other ranks.
*/
static PetscErrorCode AppHandleError(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n,
  PetscErrorType type, const char *message, void *ctx)
{
  AppError   *error = (AppError *)ctx;
  const char *text  = message;
  PetscMPIInt rank, size, world;

  if (type == PETSC_ERROR_INITIAL) {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    MPI_Comm_size(PETSC_COMM_WORLD, &world);
    error->silent = (PetscBool)(rank > 0);
    error->alone  = (PetscBool)(size < world);
    error->end    = (int)AppClassifyError(n);
    if (!message || !message[0]) PetscErrorMessage(n, &text, NULL);
    (void)PetscStrncpy(error->sentence, text ? text : "unknown", sizeof(error->sentence));
    if (error->scene && error->end == RUN_REFUSED)
      SceneAddPlace(error->scene, sizeof(error->sentence), error->sentence);
    if (!error->silent && !error->traceback) fprintf(stderr, "contact: error: %s\n", error->sentence);
    fflush(stderr);
    if (error->alone && !error->traceback) MPI_Abort(PETSC_COMM_WORLD, error->end);
  }
  return error->traceback && !error->silent
           ? PetscTraceBackErrorHandler(comm, line, function, file, n, type, message, NULL)
           : n;
}

/*
   Silences HDF5 while MPI ends. HDF5 then closes its files; if it could not write one, it prints pages of errors and
   crashes. The exit code of the program remains `end`.
*/
static int app_end;

static void AppLeaveAtOnce(int sig)
{
  (void)sig;
  _Exit(app_end);
}

static void AppLeaveFiles(int end)
{
  fflush(NULL);
  app_end = end;
  signal(SIGSEGV, AppLeaveAtOnce);
  signal(SIGABRT, AppLeaveAtOnce);
  if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) _Exit(end);
}

/*
   Ends the program after an error has returned through all callers. With a collective error every rank comes here. If a
   rank waits in vain for the others for ten seconds, they may never come; it then ends them, as PETSc's traceback does.
   Objects are not destroyed. MPI_Finalize() is called in place of PetscFinalize(), which would complain about them.
*/
static void AppLeave(const AppError *error)
{
  const double start = MPI_Wtime(), patience = error->alone ? 0.0 : 10.0; /* time to wait for other ranks [s] */
  MPI_Request  request;
  PetscMPIInt  rank;
  int          all = 0;

  MPI_Ibarrier(error->meeting, &request);
  do {
    MPI_Test(&request, &all, MPI_STATUS_IGNORE);
    if (!all) (void)PetscSleep(0.01);
  } while (!all && MPI_Wtime() - start < patience);
  if (!all) {
    MPI_Comm_rank(error->meeting, &rank);
    fprintf(stderr, "contact: error on rank %d only: %s\n", rank, error->sentence);
    fflush(NULL);
    MPI_Abort(PETSC_COMM_WORLD, error->end);
  }
  if (error->end == RUN_OUTPUT_LOST) AppLeaveFiles(error->end);
  MPI_Finalize();
  fflush(NULL);
  _Exit(error->end);
}

/* Returns whether the command is contact --help, -version or -scene_keys, which print a text and do not run a scene */
static PetscBool AppAsksForText(int argc, char **argv)
{
  return (PetscBool)(argc == 2 && (!strcmp(argv[1], "--help") || !strcmp(argv[1], "--version") ||
                                    !strcmp(argv[1], "-version") || !strcmp(argv[1], "-scene_keys")));
}

static PetscErrorCode AppGetVersions(char text[], size_t length)
{
  char plugin[256], petsc[256];

  PetscFunctionBeginUser;
  PetscCall(PetscAMGFGetVersion(plugin, sizeof(plugin)));
  PetscCall(PetscGetVersion(petsc, sizeof(petsc)));
  PetscCall(PetscSNPrintf(text, length, "contact %d.%d.%d\n%s\nrunning %s\n", PETSCAMGF_VERSION_MAJOR,
    PETSCAMGF_VERSION_MINOR, PETSCAMGF_VERSION_SUBMINOR, plugin, petsc));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppSayText(const char word[])
{
  char versions[512];

  PetscFunctionBeginUser;
  if (!strcmp(word, "-scene_keys")) {
    PetscCall(SceneViewKeys(PETSC_VIEWER_STDOUT_WORLD));
    PetscFunctionReturn(0);
  }
  PetscCall(AppGetVersions(versions, sizeof(versions)));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s", !strcmp(word, "--help") ? help : versions));
  PetscFunctionReturn(0);
}

/*
   Completes the options for -report. An HTML page needs fields and a summary. If the user has not named files for them,
   their names are derived from that of the page.
*/
static PetscErrorCode AppCompleteReport(AppOptions *app)
{
  char  base[PETSC_MAX_PATH_LEN];
  char *ending;

  PetscFunctionBeginUser;
  if (!app->page) PetscFunctionReturn(0);
  PetscCall(PetscStrncpy(base, app->report, sizeof(base)));
  PetscCall(PetscStrendswith(base, ".html", &app->page));
  PetscCheck(app->page, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT, "-report takes the name of an HTML file, not \"%s\"",
    app->report);
  ending  = base + strlen(base) - strlen(".html");
  *ending = '\0';
  if (!app->write) PetscCall(PetscStrncpy(app->output, base, sizeof(app->output)));
  if (!app->summarize) PetscCall(PetscSNPrintf(app->summary, sizeof(app->summary), "%s.json", base));
  app->write = app->summarize = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* Reads the program's options. With -help and without a scene, the help has been printed already. */
static PetscErrorCode AppGetOptions(int argc, char **argv, AppOptions *app)
{
  PetscBool helped;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(app, sizeof(*app)));
  PetscOptionsBegin(PETSC_COMM_WORLD, NULL, "Contact", NULL);
  PetscCall(PetscOptionsString("-output", "Base name of the HDF5 and XDMF files", NULL, app->output, app->output,
    sizeof(app->output), &app->write));
  PetscCall(PetscOptionsBool("-output_gauss", "Also write the stress at the quadrature points", NULL, app->gauss,
    &app->gauss, NULL));
  PetscCall(PetscOptionsInt("-checkpoint_every", "Load steps between two checkpoints", NULL, app->checkpoint_every,
    &app->checkpoint_every, NULL));
  PetscCheck(app->checkpoint_every >= 0, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "-checkpoint_every must be at least 0, not %" PetscInt_FMT, app->checkpoint_every);
  PetscCall(PetscOptionsString("-checkpoint", "File of the checkpoint", NULL, app->checkpoint, app->checkpoint,
    sizeof(app->checkpoint), NULL));
  PetscCall(PetscOptionsString("-restart", "Checkpoint to restart from", NULL, app->restart, app->restart,
    sizeof(app->restart), &app->restarts));
  PetscCall(PetscOptionsString("-summary", "JSON report", NULL, app->summary, app->summary, sizeof(app->summary),
    &app->summarize));
  PetscCall(PetscOptionsString("-report", "HTML page of the run", NULL, app->report, app->report, sizeof(app->report),
    &app->page));
  PetscCall(PetscOptionsBool("-contact_free", "Also solve the first step without contact", NULL, app->contact_free,
    &app->contact_free, NULL));
  PetscCall(PetscOptionsBool("-accuracy_view", "Print what -accuracy chose and reached", NULL, app->accuracy,
    &app->accuracy, NULL));
  PetscCall(
    PetscOptionsBool("-effects_view", "Print the effects of the scene", NULL, app->effects, &app->effects, NULL));
  PetscCall(
    PetscOptionsBool("-scene_check", "Print what would be simulated, and stop", NULL, app->check, &app->check, NULL));
  PetscCall(PetscOptionsBool("-quiet", "Print nothing", NULL, app->quiet, &app->quiet, NULL));
  PetscOptionsEnd();
  if (argc > 1 && argv[1][0] != '-') PetscCall(PetscStrncpy(app->scene, argv[1], sizeof(app->scene)));
  PetscCall(PetscOptionsHasHelp(NULL, &helped));
  PetscCheck(app->scene[0] || helped, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "no scene given; usage: contact SCENE.yaml [options], see contact -help");
  PetscCall(AppCompleteReport(app));
  PetscFunctionReturn(0);
}

/* Rejects words that are neither an option nor the value of an option; PETSc would ignore them */
static PetscErrorCode AppCheckWords(int argc, char **argv)
{
  PetscFunctionBeginUser;
  for (int i = 2; i < argc; ++i) {
    PetscBool option, after;

    PetscCall(PetscOptionsValidKey(argv[i], &option));
    PetscCall(PetscOptionsValidKey(argv[i - 1], &after));
    PetscCheck(option || (after && i > 2), PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
      "\"%s\" is neither an option nor the value of one; usage: contact SCENE.yaml [options], see contact -help",
      argv[i]);
  }
  PetscFunctionReturn(0);
}

/* Sets the option that prints one line per Newton step, unless the user has set it. There is no function for this. */
static PetscErrorCode AppShowProgress(void)
{
  PetscBool given;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsHasName(NULL, NULL, "-tao_ipfilter_monitor", &given));
  if (!given) PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_monitor", NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppCreateSimulation(const AppOptions *app, Scene scene, Accuracy *accuracy,
  const MeshMarks *marks, StepForecast *forecast, Simulation *sim)
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
  if (accuracy->target > 0.0) PetscCall(SimulationSetForecast(*sim, forecast));
  PetscCall(SimulationSetUp(*sim));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppCreateOutput(const AppOptions *app, Scene scene, Simulation sim, Output *output)
{
  const char **names;
  DM           dm;

  PetscFunctionBeginUser;
  *output = NULL;
  if (!app->write) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(scene->nbodies, &names));
  for (PetscInt b = 0; b < scene->nbodies; ++b) names[b] = scene->bodies[b].name;
  PetscCall(SimulationGetDM(sim, &dm));
  PetscCall(OutputCreate(dm, scene->nbodies, names, app->output, output));
  PetscCall(OutputSetUnits(*output, scene->units));
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppReport(const AppOptions *app, const RunReport *report)
{
  PetscFunctionBeginUser;
  if (!app->quiet) PetscCall(ReportView(report, PETSC_VIEWER_STDOUT_WORLD));
  if (app->accuracy && (app->quiet || !report->accuracy))
    PetscCall(ReportViewAccuracy(report, PETSC_VIEWER_STDOUT_WORLD));
  if (app->effects) PetscCall(ReportViewEffects(report, PETSC_VIEWER_STDOUT_WORLD));
  if (app->summarize) PetscCall(ReportWriteJSON(PETSC_COMM_WORLD, report, app->summary));
  if (!report->converged)
    PetscCall(PetscFPrintf(PETSC_COMM_WORLD, stderr, "contact: load step %" PetscInt_FMT " failed: %s\n",
      report->nsteps, report->reason));
  else if (report->exit_code == RUN_ACCURACY_MISSED)
    PetscCall(PetscFPrintf(PETSC_COMM_WORLD, stderr, "contact: accuracy %g: %s\n", (double)report->accuracy->target,
      report->accuracy->end));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppGetCheckpointFile(const AppOptions *app, Scene scene, char file[PETSC_MAX_PATH_LEN])
{
  PetscFunctionBeginUser;
  if (app->checkpoint[0]) PetscCall(PetscStrncpy(file, app->checkpoint, PETSC_MAX_PATH_LEN));
  else PetscCall(PetscSNPrintf(file, PETSC_MAX_PATH_LEN, "%s_checkpoint.h5", app->write ? app->output : scene->name));
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
static PetscErrorCode AppSimulate(const AppOptions *app, Scene scene, Accuracy *accuracy, MeshMarks *marks,
  StepForecast *forecast, RunEnd *end, PetscBool *again)
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
  PetscCall(AppCreateSimulation(app, scene, accuracy, marks, forecast, &sim));
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
  if (!*again) PetscCall(AppReport(app, &report));
  PetscCall(OutputDestroy(&output));
  PetscCall(SimulationDestroy(&sim));
  PetscFunctionReturn(0);
}

/* Checks that no file is written twice, or over one that is read. A run may replace the checkpoint that it reads. */
static PetscErrorCode AppCheckNames(const AppOptions *app, const char checkpoint[])
{
  const char *const base    = app->write ? app->output : NULL;
  OutputFile        files[] = {
           {"the scene", app->scene, PETSC_FALSE},
           {"-summary", app->summarize ? app->summary : NULL, PETSC_TRUE},
           {"-report", app->page ? app->report : NULL, PETSC_TRUE},
           {"-checkpoint", checkpoint, PETSC_TRUE},
  };

  PetscFunctionBeginUser;
  PetscCall(OutputCheckDistinct(PETSC_COMM_WORLD, PETSC_STATIC_ARRAY_LENGTH(files), files, base));
  if (!app->restarts) PetscFunctionReturn(0);
  files[3] = (OutputFile){"-restart", app->restart, PETSC_FALSE};
  PetscCall(OutputCheckDistinct(PETSC_COMM_WORLD, PETSC_STATIC_ARRAY_LENGTH(files), files, base));
  PetscFunctionReturn(0);
}

/* Checks that all files can be written, before the run begins */
static PetscErrorCode AppCheckFiles(const AppOptions *app, Scene scene)
{
  char file[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(AppGetCheckpointFile(app, scene, file));
  PetscCall(AppCheckNames(app, file));
  if (app->summarize) PetscCall(OutputCheckWritable(PETSC_COMM_WORLD, app->summary));
  if (app->page) PetscCall(ReportPageCheck(PETSC_COMM_WORLD, app->report));
  if (app->checkpoint_every) PetscCall(OutputCheckWritable(PETSC_COMM_WORLD, file));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppSolve(const AppOptions *app, Scene scene, RunEnd *end)
{
  Accuracy     accuracy;
  MeshMarks    marks    = {0, NULL, NULL};
  StepForecast forecast = {.dm = NULL};
  PetscBool    again;

  PetscFunctionBeginUser;
  PetscCall(AppCheckFiles(app, scene));
  PetscCall(AccuracySetFromOptions(PETSC_COMM_WORLD, &accuracy));
  PetscCheck(!accuracy.target || (!app->restarts && !app->checkpoint_every), PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "-accuracy solves the scene on several meshes: it cannot be combined with -checkpoint_every or -restart");
  PetscCall(SimulationCatchSignals());
  do {
    PetscCall(AppSimulate(app, scene, &accuracy, &marks, &forecast, end, &again));
    if (again && !app->quiet) PetscCall(ReportViewNextMesh(&accuracy, scene->refine, PETSC_VIEWER_STDOUT_WORLD));
  } while (again);
  PetscCall(AccuracyDestroy(&accuracy));
  PetscCall(MeshMarksDestroy(&marks));
  PetscCall(StepForecastDestroy(&forecast));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppCheckScene(Scene scene)
{
  DM dm;

  PetscFunctionBeginUser;
  PetscCall(MeshCreateScene(PETSC_COMM_WORLD, scene, NULL, &dm));
  PetscCall(MeshCheckScene(dm, scene));
  PetscCall(SceneDescribe(scene, dm, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(StepDescribeContact(scene, dm, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/*
   Switches off PETSc's report of unused options. This program reports misspelt options and unused keys of a scene
   itself. PETSc since 3.19 would warn of every option that this run did not need.
*/
static PetscErrorCode AppLeaveUnusedOptions(void)
{
  PetscBool given;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsHasName(NULL, NULL, "-options_left", &given));
  if (!given) PetscCall(PetscOptionsSetValue(NULL, "-options_left", "0"));
  PetscFunctionReturn(0);
}

/* Collects what the HTML page needs while MPI is still available. Only the first rank makes the page. */
static PetscErrorCode AppDescribePage(const AppOptions *app, int argc, char **argv, ReportPage *page)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!app->page || rank > 0) PetscFunctionReturn(0);
  PetscCall(PetscStrncpy(page->file, app->report, sizeof(page->file)));
  PetscCall(PetscStrncpy(page->base, app->output, sizeof(page->base)));
  PetscCall(PetscStrncpy(page->summary, app->summary, sizeof(page->summary)));
  PetscCall(PetscStrncpy(page->scene, app->scene, sizeof(page->scene)));
  for (int i = 0; i < argc; ++i) {
    if (i) PetscCall(PetscStrlcat(page->command, " ", sizeof(page->command)));
    PetscCall(PetscStrlcat(page->command, argv[i], sizeof(page->command)));
  }
  PetscCall(AppGetVersions(page->versions, sizeof(page->versions)));
  PetscFunctionReturn(0);
}

/* Makes the HTML page after the run. If that fails, a message says why; the exit code of the run is unchanged. */
static void AppMakePage(const ReportPage *page)
{
  char sentence[512];

  if (page->file[0] && ReportPageMake(page, sentence, sizeof(sentence)))
    fprintf(stderr, "contact: cannot write the page %s: %s\n", page->file, sentence);
}

static PetscErrorCode AppRunScene(const AppOptions *app, AppError *error, RunEnd *end)
{
  Scene scene;

  PetscFunctionBeginUser;
  if (!app->quiet) PetscCall(AppShowProgress());
  PetscCall(SceneLoad(PETSC_COMM_WORLD, app->scene, &scene));
  error->scene = scene;
  PetscCall(OptionsCheck(PETSC_COMM_WORLD));
  PetscCall(ContactDetect(PETSC_COMM_WORLD, scene));
  PetscCall(AppLeaveUnusedOptions());
  if (app->check) PetscCall(AppCheckScene(scene));
  else {
    PetscCall(AppSolve(app, scene, end));
    PetscCall(SceneReportUnusedOptions(PETSC_COMM_WORLD, scene));
  }
  error->scene = NULL;
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppRun(int argc, char **argv, AppError *error, ReportPage *page, RunEnd *end)
{
  AppOptions app;

  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(AppHandleError, error));
  PetscCall(OptionsCheckValues(PETSC_COMM_WORLD));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-traceback", &error->traceback, NULL));
  PetscCall(AppGetOptions(argc, argv, &app));
  PetscCall(AppCheckWords(argc, argv));
  if (app.scene[0]) PetscCall(AppRunScene(&app, error, end));
  if (app.scene[0] && !app.check) PetscCall(AppDescribePage(&app, argc, argv, page));
  PetscCall(PetscPopErrorHandler());
  PetscFunctionReturn(0);
}

/*
   Limits the fragmentation of the heap. Large arrays of the AMG and of matrices are freed and allocated again; in a
   heap they would leave holes. (two_block on mesh 2 would need 4.9 kB per unknown instead of 4.0.) Large arrays are
   therefore mapped, and free memory at the end of the heap is returned to the system. SuperLU_DIST, which PETSc may
   link, switches mapping and returning off when it is loaded, by mallopt(M_MMAP_MAX, 0) and
   mallopt(M_TRIM_THRESHOLD, -1).
*/
static void AppLimitHeap(void)
{
#if defined(__GLIBC__)
  (void)mallopt(M_MMAP_MAX, 1 << 16);
  (void)mallopt(M_MMAP_THRESHOLD, 1 << 20);
  (void)mallopt(M_TRIM_THRESHOLD, 1 << 24);
#endif
}

/*
   Handles a crash of the program or of a library: prints one sentence and ends the other ranks. PETSc's handler would
   print a page, and use its own exit code.
*/
static PetscErrorCode AppCrash(int sig, void *ctx)
{
  const PetscBool fault =
    (PetscBool)(sig == SIGSEGV || sig == SIGBUS || sig == SIGFPE || sig == SIGILL || sig == SIGABRT);
  PetscMPIInt size;

  if (!fault || ((AppError *)ctx)->traceback) return PetscSignalHandlerDefault(sig, NULL);
  dprintf(((AppError *)ctx)->said,
    "contact: error: the program crashed (signal %d), because of an error in the program or in a library: please "
    "report it with the scene; -traceback prints details\n",
    sig);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (size > 1) MPI_Abort(PETSC_COMM_WORLD, RUN_BROKEN);
  _Exit(RUN_BROKEN);
}

/*
   Initializes PETSc without its signal handler. If the reader of a pipe stops reading (contact -help | head), the
   program then ends silently; PETSc's handler would print a page.
*/
static PetscErrorCode AppInitialize(int *argc, char ***argv)
{
  static const char option[] = "-no_signal_handler";

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, option, "true"));
  PetscCall(PetscInitialize(argc, argv, NULL, help));
  PetscCall(PetscOptionsClearValue(NULL, option));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static ReportPage page; /* all members are zero, so that no page is written */

  RunEnd   end   = RUN_CONVERGED;
  AppError error = {.traceback = PETSC_FALSE, .end = RUN_BROKEN};
  /* PETSc would take this argument for one of its own options */
  const char    *word = AppAsksForText(argc, argv) ? argv[1] : NULL;
  PetscErrorCode ierr;

  AppLimitHeap();
  if (word) argc = 1;
  ierr = AppInitialize(&argc, &argv);
  if (ierr) return RUN_REFUSED;
  error.said = dup(STDERR_FILENO);
  ierr       = PetscPushSignalHandler(AppCrash, &error);
  if (ierr) return RUN_BROKEN;
  signal(SIGPIPE, SIG_DFL);
  MPI_Comm_dup(PETSC_COMM_WORLD, &error.meeting);
  ierr = PetscLogDefaultBegin();
  if (!ierr) ierr = word ? AppSayText(word) : AppRun(argc, argv, &error, &page, &end);
  if (ierr) AppLeave(&error);
  MPI_Comm_free(&error.meeting);
  if (fflush(stdout) || ferror(stdout)) {
    fprintf(stderr, "contact: error: cannot print: %s\n", strerror(errno));
    end = RUN_OUTPUT_LOST;
  }
  ierr = PetscFinalize();
  AppMakePage(&page);
  return ierr ? RUN_BROKEN : (int)end;
}
