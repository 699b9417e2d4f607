/* Decks of Abaqus and CalculiX: share/python/contact_mesh.py translates them into scenes */
#include "appsimpl.h"
#include "src/files/filesimpl.h"
#include <string.h>
#include <strings.h>

/* Runs the translator, which writes the scene and its mesh; on the first rank */
static PetscErrorCode DeckTranslate(const AppOptions *app, const char scene[])
{
  char        script[PETSC_MAX_PATH_LEN], sentence[512];
  const char *words[] = {CONTACT_PYTHON, "-B", script, app->scene, "-scene", scene, app->quiet ? "-quiet" : NULL, NULL};
  const char *text;

  PetscFunctionBeginUser;
  PetscCheck(ScriptFind("python/contact_mesh.py", script, sizeof(script), sentence, sizeof(sentence)), PETSC_COMM_SELF,
    PETSC_ERR_USER_INPUT, "%s", sentence);
  if (!ScriptRun(words, sentence, sizeof(sentence))) PetscFunctionReturn(0);
  text = strstr(sentence, "error: ");
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "%s", text ? text + strlen("error: ") : sentence);
}

/* If the scene is a deck NAME.inp, writes its translation NAME_deck.yaml into the current folder, which then is the
   scene */
PetscErrorCode AppTranslateDeck(AppOptions *app)
{
  const char    *dot = strrchr(app->scene, '.'), *slash = strrchr(app->scene, '/');
  const char    *name = slash ? slash + 1 : app->scene;
  char           scene[PETSC_MAX_PATH_LEN];
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscMPIInt    rank;

  PetscFunctionBeginUser;
  if (!dot || strcasecmp(dot, ".inp")) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(scene, sizeof(scene), "%.*s_deck.yaml", (int)(dot - name), name));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(RankErrorBegin(&error));
  if (rank == 0) ierr = DeckTranslate(app, scene);
  PetscCall(RankErrorEnd(PETSC_COMM_WORLD, ierr, &error));
  PetscCheck(!error.code, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT, "%s", error.message);
  PetscCall(PetscStrncpy(app->scene, scene, sizeof(app->scene)));
  PetscFunctionReturn(0);
}
