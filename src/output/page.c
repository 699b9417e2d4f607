/*
   Creates the HTML page of a run. The script share/report/report.py writes the page from the files and the summary of
   the run.
*/
#include "src/output/outputimpl.h"

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
  char        script[PETSC_MAX_PATH_LEN], sentence[512] = "";
  PetscMPIInt rank;
  int         status = 0;

  PetscFunctionBegin;
  PetscCall(OutputCheckWritable(comm, file));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    const char *const words[] = {CONTACT_PYTHON, "-B", script, "--check", NULL};

    status = -1;
    if (ScriptFind("report/report.py", script, sizeof(script), sentence, sizeof(sentence)))
      status = ScriptRun(words, sentence, sizeof(sentence));
  }
  PetscCallMPI(MPI_Bcast(&status, 1, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(sentence, sizeof(sentence), MPI_CHAR, 0, comm));
  PetscCheck(!status, comm, PETSC_ERR_USER_INPUT, "-report %s: %s", file, sentence);
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
