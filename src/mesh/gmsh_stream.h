/* Reading a Gmsh file with suspicion. What is false has left a sentence behind; the first stays */
#ifndef GMSH_STREAM_H
#define GMSH_STREAM_H

#include <petscsys.h>
#include <stdio.h>

#define GMSH_WORD 256

typedef struct {
  FILE      *file;
  PetscInt64 size; /* of the file [bytes]: no count in it can be larger */
  int        version, width;
  PetscBool  binary, swapped;
  char      *sentence;
  size_t     length;
} GmshStream;

PETSC_INTERN void GmshComplain(GmshStream *, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
#define GmshWrong(...) (GmshComplain(__VA_ARGS__), PETSC_FALSE)

/* A word and the one blank after it; the name of the next section, past comments */
PETSC_INTERN PetscBool GmshGetWord(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshGetSection(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshExpect(GmshStream *, const char section[], const char word[]);
PETSC_INTERN PetscBool GmshExpectNext(GmshStream *, const char section[]);
PETSC_INTERN PetscBool GmshGetBytes(GmshStream *, size_t n, void *value);
/* n whole numbers of 4 or 8 bytes; n finite reals; n counts; a count that format 2 writes as a word, also in binary files */
PETSC_INTERN PetscBool GmshGetNumbers(GmshStream *, int width, PetscInt64 n, PetscInt64 values[]);
PETSC_INTERN PetscBool GmshGetReals(GmshStream *, PetscInt64 n);
PETSC_INTERN PetscBool GmshGetCounts(GmshStream *, const char what[], PetscInt64 n, PetscInt64 counts[]);
PETSC_INTERN PetscBool GmshGetCountWord(GmshStream *, const char what[], PetscInt64 *count);

#endif
