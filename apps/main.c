/* The program contact: reads a scene, and runs it */
#define _POSIX_C_SOURCE 200809L /* declares dup() */
#include "appsimpl.h"
#include <options.h>
#include <mesh.h>
#include <contact.h>
#include <step.h>
#include <errno.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

/* Sets the option that prints one line per Newton step, unless the user has set it. There is no function for this. */
static PetscErrorCode AppShowProgress(void)
{
  PetscBool given;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsHasName(NULL, NULL, "-tao_ipfilter_monitor", &given));
  if (!given) PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_monitor", NULL));
  PetscFunctionReturn(0);
}

/* Refuses what a run refuses before its first load step, and prints what would be simulated */
static PetscErrorCode AppCheckScene(Scene scene)
{
  Simulation sim;
  DM         dm;

  PetscFunctionBeginUser;
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, &sim));
  PetscCall(SimulationSetFromOptions(sim));
  PetscCall(SimulationCheck(sim));
  PetscCall(SimulationGetDM(sim, &dm));
  PetscCall(SceneDescribe(scene, dm, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(StepDescribeContact(scene, dm, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(SimulationDestroy(&sim));
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

/* Collects what the scripts need that make the HTML page and the files of VTK, while MPI is still available. The first
   rank runs them. */
static PetscErrorCode AppDescribePage(const AppOptions *app, int argc, char **argv, ReportPage *page)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!(app->page || app->vtk) || rank > 0) PetscFunctionReturn(0);
  if (app->page) PetscCall(PetscStrncpy(page->file, app->report, sizeof(page->file)));
  if (app->vtk) PetscCall(PetscSNPrintf(page->vtk, sizeof(page->vtk), "%s.pvd", app->output));
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

/* Makes the files of VTK and the HTML page after the run. If that fails, a message says why; the exit code of the run
   is unchanged. */
static void AppMakePage(const ReportPage *page)
{
  char sentence[512];

  if (page->vtk[0] && OutputMakeVTK(page, sentence, sizeof(sentence)))
    fprintf(stderr, "contact: cannot write %s: %s\n", page->vtk, sentence);
  if (page->file[0] && ReportPageMake(page, sentence, sizeof(sentence)))
    fprintf(stderr, "contact: cannot write the page %s: %s\n", page->file, sentence);
}

static PetscErrorCode AppRunScene(const AppOptions *app, RunEnd *end)
{
  Scene scene;

  PetscFunctionBeginUser;
  if (!app->quiet) PetscCall(AppShowProgress());
  PetscCall(SceneLoad(PETSC_COMM_WORLD, app->scene, &scene));
  PetscCall(SceneCheckOptions(PETSC_COMM_WORLD, scene));
  PetscCall(OptionsCheck(PETSC_COMM_WORLD));
  PetscCall(AppLeaveUnusedOptions());
  if (app->check) PetscCall(AppCheckScene(scene));
  else {
    PetscCall(AppSolve(app, scene, end));
    PetscCall(SceneReportUnusedOptions(PETSC_COMM_WORLD, scene));
  }
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(0);
}

static PetscErrorCode AppRun(int argc, char **argv, AppError *error, ReportPage *page, RunEnd *end)
{
  AppOptions app;

  PetscFunctionBeginUser;
  PetscCall(OptionsCheckValues(PETSC_COMM_WORLD));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-traceback", &error->traceback, NULL));
  PetscCall(AppGetOptions(argc, argv, &app));
  PetscCall(AppCheckWords(argc, argv));
  if (app.scene[0]) {
    PetscCall(AppTranslateDeck(&app));
    PetscCall(AppRunScene(&app, end));
  }
  if (app.scene[0] && !app.check) PetscCall(AppDescribePage(&app, argc, argv, page));
  PetscFunctionReturn(0);
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
  PetscCall(PetscInitialize(argc, argv, NULL, AppHelp));
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
  ierr = PetscPushErrorHandler(AppHandleError, &error); /* also for errors in files of options */
  if (!ierr) ierr = AppInitialize(&argc, &argv);
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
