/* Runs one of the program's own Python scripts */
#define _POSIX_C_SOURCE 200809L /* declares posix_spawn() and readlink() */
#include "filesimpl.h"
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/*
   Finds a script of share/ relative to the program, in the sources or where `make install` has put it. If it is not
   found, returns false, and `sentence` explains it.
*/
PetscBool ScriptFind(const char name[], char script[], size_t length, char sentence[], size_t size)
{
  static const char *const places[] = {"/../share/amgf/", "/../share/"};
  char                     program[PETSC_MAX_PATH_LEN];
  const ssize_t            n = readlink("/proc/self/exe", program, sizeof(program) - 1);

  (void)snprintf(sentence, size, "share/%s is missing: it must be installed next to the program", name);
  if (n <= 0) return PETSC_FALSE;
  program[n] = '\0';
  if (strrchr(program, '/')) *strrchr(program, '/') = '\0';
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(places); ++i) {
    const int size = snprintf(script, length, "%s%s%s", program, places[i], name);

    if (size > 0 && (size_t)size < length && !access(script, R_OK)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Keeps only the last line that is not blank, without ANSI colour codes (ESC [ ... m) */
static void ScriptTakeLine(char text[])
{
  size_t n = 0;

  for (const char *c = text; *c; ++c) {
    if (*c != '\033') text[n++] = *c;
    else
      while (*c != 'm' && c[1]) ++c;
  }
  while (n && strchr(" \r\n", text[n - 1])) --n;
  text[n] = '\0';
  if (strrchr(text, '\n')) memmove(text, strrchr(text, '\n') + 1, strlen(strrchr(text, '\n')));
}

/*
   Runs the script and returns 0 if it ended without error. `sentence` gets the last line that the script prints on the
   error stream, as far as there is room.
*/
int ScriptRun(const char *const words[], char sentence[], size_t length)
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
  ScriptTakeLine(sentence);
  if (error) (void)snprintf(sentence, length, "%s: %s", words[0], strerror(error));
  else if (waitpid(child, &status, 0) < 0) status = -1;
  return error ? error : status;
}
