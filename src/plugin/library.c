/*
   Checks that the running PETSc matches the one that the plugin was compiled with. The loader does not check this: a
   plugin with 64-bit integers in a program with 32-bit integers finds every function and computes wrong numbers. The
   size of a number in the running library is determined by letting the library store a zero and counting the bytes that
   it overwrites.
*/
#include "pc_amgf/amgfimpl.h"

/* Space for a number of any PETSc. The largest type is complex in quadruple precision. */
typedef union {
  PetscInt    integer;
  PetscReal   real;
  PetscScalar scalar;
  _Alignas(32) unsigned char bytes[64];
} LibraryNumber;

/* Sets all bytes of the number to a value that no byte of a zero has */
static void LibraryMark(LibraryNumber *number)
{
  for (size_t i = 0; i < sizeof(number->bytes); i++) number->bytes[i] = 0xff;
}

/*
   Raises an error if a type has another size in the running PETSc than in the compiled plugin. The running PETSc has
   stored a zero in the marked number: the bytes that are zero are its size. type: name of the type; compiled: its size
   in the plugin.
*/
static PetscErrorCode LibraryCheckSize(const char type[], size_t compiled, const LibraryNumber *number)
{
  size_t running = 0;

  PetscFunctionBegin;
  while (running < sizeof(number->bytes) && number->bytes[running] == 0) running++;
  PetscCheck(running == compiled, PETSC_COMM_SELF, PETSC_ERR_LIB,
    "libpetscamgf was compiled with a PETSc whose %s has %d bytes, but runs in one whose %s has %d: build it with the "
    "program's PETSc",
    type, (int)compiled, type, (int)running);
  PetscFunctionReturn(0);
}

/*
   PCAMGFCheckLibrary_Private - raises an error unless the running PETSc has the integers, precision, scalars and
   release that the plugin was compiled with
*/
PetscErrorCode PCAMGFCheckLibrary_Private(void)
{
  LibraryNumber number;
  PetscInt      major, minor, subminor, release;

  PetscFunctionBegin;
  LibraryMark(&number);
  PetscCall(PetscOptionsStringToInt("0", &number.integer));
  PetscCall(LibraryCheckSize("PetscInt", sizeof(PetscInt), &number));
  LibraryMark(&number);
  PetscCall(PetscOptionsStringToReal("0", &number.real));
  PetscCall(LibraryCheckSize("PetscReal", sizeof(PetscReal), &number));
  LibraryMark(&number);
  PetscCall(PetscOptionsStringToScalar("0", &number.scalar));
  PetscCall(LibraryCheckSize("PetscScalar", sizeof(PetscScalar), &number));
  PetscCall(PetscGetVersionNumber(&major, &minor, &subminor, &release));
  PetscCheck(major == PETSC_VERSION_MAJOR && minor == PETSC_VERSION_MINOR, PETSC_COMM_SELF, PETSC_ERR_LIB,
    "libpetscamgf was compiled with PETSc %d.%d, but runs in PETSc %" PetscInt_FMT ".%" PetscInt_FMT
    ": build it with the program's PETSc",
    PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, major, minor);
  PetscFunctionReturn(0);
}
