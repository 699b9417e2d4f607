/* libFuzzer calls FUZZ_TARGET with one input after another; `make fuzz` builds and runs it */
#include "targets.h"
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static char fuzz_file[64];

static PetscErrorCode FuzzWriteFile(const char file[], const void *bytes, size_t n)
{
  FILE *stream;

  PetscFunctionBeginUser;
  PetscCall(PetscFOpen(PETSC_COMM_SELF, file, "w", &stream));
  PetscCheck(fwrite(bytes, 1, n, stream) == n, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "Cannot write %s", file);
  PetscCall(PetscFClose(PETSC_COMM_SELF, stream));
  PetscFunctionReturn(0);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
  (void)argc, (void)argv;
  (void)snprintf(fuzz_file, sizeof(fuzz_file), "/dev/shm/amgf-fuzz-%ld", (long)getpid());
  return PetscInitializeNoArguments() ? EXIT_FAILURE : 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
  PetscBool sound;

  if (FuzzWriteFile(fuzz_file, bytes, n) || FuzzRun(FUZZ_TARGET, fuzz_file, &sound)) abort();
  return 0;
}
