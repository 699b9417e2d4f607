/*
   Creates the HTML page of a run, and its files for programs that do not read XDMF. The scripts share/report/report.py
   and share/python/contact_mesh.py write them from the files and the summary of the run.
*/
#include "src/output/outputimpl.h"

/* Collective. Checks before a long run that a script and its modules are there, and that its file can be written. word:
   an argument with which the script only loads its modules */
static PetscErrorCode OutputCheckScript(MPI_Comm comm, const char option[], const char file[], const char name[],
  const char word[])
{
  char        script[PETSC_MAX_PATH_LEN], sentence[512] = "";
  PetscMPIInt rank;
  int         status = 0;

  PetscFunctionBegin;
  PetscCall(OutputCheckWritable(comm, file));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    const char *const words[] = {CONTACT_PYTHON, "-B", script, word, NULL};

    status = -1;
    if (ScriptFind(name, script, sizeof(script), sentence, sizeof(sentence)))
      status = ScriptRun(words, sentence, sizeof(sentence));
  }
  PetscCallMPI(MPI_Bcast(&status, 1, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(sentence, sizeof(sentence), MPI_CHAR, 0, comm));
  PetscCheck(!status, comm, PETSC_ERR_USER_INPUT, "%s %s: %s", option, file, sentence);
  PetscFunctionReturn(0);
}

static const char converter[] = "python/contact_mesh.py";

/* Collective. Checks before a long run that the files of VTK can be made */
PetscErrorCode OutputCheckVTK(MPI_Comm comm, const char file[])
{
  PetscFunctionBegin;
  PetscCall(OutputCheckScript(comm, "-output", file, converter, "--modules"));
  PetscFunctionReturn(0);
}

/* Makes the files of VTK of a completed run, which have the surfaces of rigid bodies, too. Returns 0; nonzero if they
   were not made, for the reason in `sentence` */
int OutputMakeVTK(const ReportPage *page, char sentence[], size_t length)
{
  char              script[PETSC_MAX_PATH_LEN], fields[PETSC_MAX_PATH_LEN + 4];
  const char *const words[] = {CONTACT_PYTHON, "-B", script, fields, page->vtk, NULL};

  (void)snprintf(fields, sizeof(fields), "%s.xmf", page->base);
  return ScriptFind(converter, script, sizeof(script), sentence, length) ? ScriptRun(words, sentence, length) : -1;
}

/*@C
   ReportPageCheck - Checks before a long run that the HTML page of the run can be made; raises an error with one
   sentence if not

   Collective

   Input Parameters:
+  comm - the communicator; its first rank makes the page
-  file - the page

   Level: intermediate

   Errors: PETSC_ERR_USER_INPUT where the script, Python or a module is missing; PETSC_ERR_FILE_OPEN where the page
   cannot be written.

.seealso: `ReportPageMake()`
@*/
PetscErrorCode ReportPageCheck(MPI_Comm comm, const char file[])
{
  PetscFunctionBegin;
  PetscCall(OutputCheckScript(comm, "-report", file, "report/report.py", "--check"));
  PetscFunctionReturn(0);
}

/*@C
   ReportPageMake - Makes the HTML page of a completed run

   Not Collective; one rank calls it, also after PetscFinalize()

   Input Parameters:
+  page   - file of the page, and its input files
-  length - length of `sentence`

   Output Parameter:
.  sentence - the reason, if the page was not made

   Returns:
   0; nonzero if the page was not made

   Level: intermediate

.seealso: `ReportPageCheck()`, `ReportWriteJSON()`
@*/
int ReportPageMake(const ReportPage *page, char sentence[], size_t length)
{
  char              script[PETSC_MAX_PATH_LEN];
  const char *const words[] = {CONTACT_PYTHON, "-B", script, page->file, page->base, page->summary, page->scene,
    page->command, page->versions, NULL};

  return ScriptFind("report/report.py", script, sizeof(script), sentence, length) ? ScriptRun(words, sentence, length)
                                                                                  : -1;
}
