/* The files of a run */
#include "appsimpl.h"

PetscErrorCode AppGetCheckpointFile(const AppOptions *app, Scene scene, char file[PETSC_MAX_PATH_LEN])
{
  PetscFunctionBeginUser;
  if (app->checkpoint[0]) PetscCall(PetscStrncpy(file, app->checkpoint, PETSC_MAX_PATH_LEN));
  else PetscCall(PetscSNPrintf(file, PETSC_MAX_PATH_LEN, "%s_checkpoint.h5", app->write ? app->output : scene->name));
  PetscFunctionReturn(0);
}

/* Checks that no file is written twice, or over one that is read. A run may replace the checkpoint that it reads. */
static PetscErrorCode AppCheckNames(const AppOptions *app, const char checkpoint[])
{
  const char *const base = app->write ? app->output : NULL;
  char              vtk[PETSC_MAX_PATH_LEN + 4];
  OutputFile        files[] = {
           {"the scene", app->scene, PETSC_FALSE},
           {"-summary", app->summarize ? app->summary : NULL, PETSC_TRUE},
           {"-output", app->vtk ? vtk : NULL, PETSC_TRUE},
           {"-report", app->page ? app->report : NULL, PETSC_TRUE},
           {"-checkpoint", checkpoint, PETSC_TRUE},
  };

  PetscFunctionBeginUser;
  (void)snprintf(vtk, sizeof(vtk), "%s.pvd", app->output);
  PetscCall(OutputCheckDistinct(PETSC_COMM_WORLD, PETSC_STATIC_ARRAY_LENGTH(files), files, base));
  if (!app->restarts) PetscFunctionReturn(0);
  files[4] = (OutputFile){"-restart", app->restart, PETSC_FALSE};
  PetscCall(OutputCheckDistinct(PETSC_COMM_WORLD, PETSC_STATIC_ARRAY_LENGTH(files), files, base));
  PetscFunctionReturn(0);
}

PetscErrorCode AppCheckFiles(const AppOptions *app, Scene scene)
{
  char file[PETSC_MAX_PATH_LEN], vtk[PETSC_MAX_PATH_LEN + 4];

  PetscFunctionBeginUser;
  PetscCall(AppGetCheckpointFile(app, scene, file));
  PetscCall(AppCheckNames(app, file));
  if (app->summarize) PetscCall(OutputCheckWritable(PETSC_COMM_WORLD, app->summary));
  (void)snprintf(vtk, sizeof(vtk), "%s.pvd", app->output);
  if (app->vtk) PetscCall(OutputCheckVTK(PETSC_COMM_WORLD, vtk));
  if (app->page) PetscCall(ReportPageCheck(PETSC_COMM_WORLD, app->report));
  if (app->checkpoint_every) PetscCall(OutputCheckWritable(PETSC_COMM_WORLD, file));
  PetscFunctionReturn(0);
}
