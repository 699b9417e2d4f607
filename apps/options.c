/* The options of the program; those of the run are read by its parts */
#include "appsimpl.h"
#include <string.h>

/* Reads whether -output has the ending .pvd, which asks for VTK files, and removes this ending */
static PetscErrorCode AppCompleteOutput(AppOptions *app)
{
  PetscFunctionBeginUser;
  PetscCall(PetscStrendswith(app->output, ".pvd", &app->vtk));
  if (app->vtk) app->output[strlen(app->output) - strlen(".pvd")] = '\0';
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
PetscErrorCode AppGetOptions(int argc, char **argv, AppOptions *app)
{
  PetscBool helped, last = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(app, sizeof(*app)));
  PetscOptionsBegin(PETSC_COMM_WORLD, NULL, "Contact", NULL);
  PetscCall(PetscOptionsString("-output", "Base name of the HDF5, XDMF and CSV files; BASE.pvd: also of files of VTK",
    NULL, app->output, app->output, sizeof(app->output), &app->write));
  PetscCall(PetscOptionsBool("-output_gauss", "Also write the stress at the quadrature points", NULL, app->gauss,
    &app->gauss, NULL));
  app->every = 1;
  PetscCall(PetscOptionsInt("-output_every", "Keep the fields of every Nth load step and of the last one", NULL,
    app->every, &app->every, NULL));
  PetscCheck(app->every > 0, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "-output_every must be at least 1, not %" PetscInt_FMT, app->every);
  PetscCall(PetscOptionsBool("-output_last", "Keep the fields of the last load step only", NULL, last, &last, NULL));
  if (last) app->every = 0;
  PetscCall(PetscOptionsInt("-checkpoint_every", "Number of load steps between two checkpoints; 0: none", NULL,
    app->checkpoint_every, &app->checkpoint_every, NULL));
  PetscCheck(app->checkpoint_every >= 0, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "-checkpoint_every must be at least 0, not %" PetscInt_FMT, app->checkpoint_every);
  PetscCall(PetscOptionsString("-checkpoint", "Name of the checkpoint file", NULL, app->checkpoint, app->checkpoint,
    sizeof(app->checkpoint), NULL));
  PetscCall(PetscOptionsString("-restart", "Checkpoint from which the run continues", NULL, app->restart, app->restart,
    sizeof(app->restart), &app->restarts));
  PetscCall(PetscOptionsString("-summary", "Name of the JSON file with all numbers of the run", NULL, app->summary,
    app->summary, sizeof(app->summary), &app->summarize));
  PetscCall(PetscOptionsString("-report", "Name of the HTML page of the run", NULL, app->report, app->report,
    sizeof(app->report), &app->page));
  PetscCall(PetscOptionsBool("-contact_free", "Also solve the first load step without contact, for comparison", NULL,
    app->contact_free, &app->contact_free, NULL));
  PetscCall(
    PetscOptionsBool("-tables_view", "Print tables of load steps, solver, forces, energy, errors, times, memory", NULL,
      app->tables, &app->tables, NULL));
  PetscCall(PetscOptionsBool("-scene_check", "Check the scene, build its mesh, print what would be simulated, and stop",
    NULL, app->check, &app->check, NULL));
  PetscCall(PetscOptionsBool("-quiet", "Print neither iterations nor tables", NULL, app->quiet, &app->quiet, NULL));
  PetscOptionsEnd();
  if (argc > 1 && argv[1][0] != '-') PetscCall(PetscStrncpy(app->scene, argv[1], sizeof(app->scene)));
  PetscCall(PetscOptionsHasHelp(NULL, &helped));
  PetscCheck(app->scene[0] || helped, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "no scene given; usage: contact SCENE.yaml [options], see contact -help");
  PetscCall(AppCompleteOutput(app));
  PetscCall(AppCompleteReport(app));
  PetscFunctionReturn(0);
}

/* Rejects words that are neither an option nor the value of an option; PETSc would ignore them */
PetscErrorCode AppCheckWords(int argc, char **argv)
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
