/* The HTML page of a run: share/report/report.py writes it from the files and the summary of the run. */
#define _POSIX_C_SOURCE 200809L /* posix_spawn(), readlink() */
#include "src/output/outputimpl.h"
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#if !defined(CONTACT_PYTHON)
  #define CONTACT_PYTHON "python3" /* the makefile sets the interpreter that it found */
#endif

extern char **environ;

/* Finds the script beside the program: in the sources, or where `make install` put it */
static PetscBool PageFindScript(char script[], size_t length)
{
  static const char *const places[] = {"/../share/amgf/report/report.py", "/../share/report/report.py"};
  char                     program[PETSC_MAX_PATH_LEN];
  const ssize_t            n = readlink("/proc/self/exe", program, sizeof(program) - 1);

  if (n <= 0) return PETSC_FALSE;
  program[n] = '\0';
  if (strrchr(program, '/')) *strrchr(program, '/') = '\0';
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(places); ++i) {
    const int size = snprintf(script, length, "%s%s", program, places[i]);

    if (size > 0 && (size_t)size < length && !access(script, R_OK)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Runs the script; returns 0 if it succeeded. The last line of its error output is copied to the sentence */
static int PageRun(const char *const words[], char sentence[], size_t length)
{
  posix_spawn_file_actions_t actions;
  pid_t                      child;
  int                        ends[2], status = -1, error;
  size_t                     got = 0;
  ssize_t                    n;
  char                       rest[256];

  sentence[0] = '\0';
  if (pipe(ends)) return -1;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  error = posix_spawnp(&child, words[0], &actions, NULL, (char *const *)words, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  while (!error && (n = got + 1 < length ? read(ends[0], sentence + got, length - 1 - got)
                                         : read(ends[0], rest, sizeof(rest))) > 0) {
    if (got + 1 < length) got += (size_t)n;
  }
  close(ends[0]);
  sentence[got] = '\0';
  while (got && sentence[got - 1] == '\n') sentence[--got] = '\0';
  if (strrchr(sentence, '\n')) memmove(sentence, strrchr(sentence, '\n') + 1, strlen(strrchr(sentence, '\n')));
  if (error) (void)snprintf(sentence, length, "%s: %s", words[0], strerror(error));
  else if (waitpid(child, &status, 0) < 0) status = -1;
  return error ? error : status;
}

/*@C
   ReportPageCheck - Finds out before long work whether a page of the run can be made, and says in one sentence why not

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
    if (PageFindScript(script, sizeof(script))) {
      const char *const words[] = {CONTACT_PYTHON, "-B", script, "--check", NULL};

      status = PageRun(words, sentence, sizeof(sentence));
    } else {
      status = -1;
      PetscCall(
        PetscStrncpy(sentence, "share/report/report.py is missing; it belongs beside the program", sizeof(sentence)));
    }
  }
  PetscCallMPI(MPI_Bcast(&status, 1, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(sentence, sizeof(sentence), MPI_CHAR, 0, comm));
  PetscCheck(!status, comm, PETSC_ERR_USER_INPUT, "-report %s: %s", file, sentence);
  PetscFunctionReturn(0);
}

/*@C
   ReportPageMake - Makes the page of a run that has ended

   Not collective, one rank calls it; also after PetscFinalize()

   Input Parameter:
.  page - its file, and what it is made from

   Output Parameters:
+  sentence - why there is no page
-  length   - of the sentence

   Returns:
   0, or what is not 0 where there is no page

   Level: intermediate

.seealso: `ReportPageCheck()`, `ReportWriteJSON()`
@*/
int ReportPageMake(const ReportPage *page, char sentence[], size_t length)
{
  char              script[PETSC_MAX_PATH_LEN];
  const char *const words[] = {CONTACT_PYTHON, "-B", script, page->file, page->base, page->summary, page->scene,
    page->command, page->versions, NULL};

  if (PageFindScript(script, sizeof(script))) return PageRun(words, sentence, length);
  (void)snprintf(sentence, length, "share/report/report.py is missing; it belongs beside the program");
  return -1;
}
