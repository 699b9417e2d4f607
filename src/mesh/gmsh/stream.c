/* Reads words and numbers of a Gmsh file, text or binary. Skips the same blanks as PETSc's reader. */
#include "gmshimpl.h"
#include <ctype.h>
#include <limits.h>
#include <stdarg.h>
#include <string.h>

/* Stores an error message, unless there is one already */
void GmshError(GmshStream *in, const char format[], ...)
{
  va_list args;

  if (in->sentence[0]) return;
  va_start(args, format);
  (void)vsnprintf(in->sentence, in->length, format, args);
  va_end(args);
}

/* Reads a word and one blank after it */
PetscBool GmshGetWord(GmshStream *in, char word[GMSH_WORD])
{
  int    c = getc(in->file);
  size_t n = 0;

  while (c != EOF && (isspace(c) || !c)) c = getc(in->file);
  for (; c != EOF && !isspace(c) && c && n < GMSH_WORD - 1; c = getc(in->file)) word[n++] = (char)c;
  word[n] = 0;
  if (!n) return GmshWrong(in, "it ends too early");
  if (n == GMSH_WORD - 1) return GmshWrong(in, "it has a word of more than %d characters", GMSH_WORD - 2);
  return PETSC_TRUE;
}

/* Reads the name of the next section and skips comments */
PetscBool GmshGetSection(GmshStream *in, char word[GMSH_WORD])
{
  PetscBool comments = PETSC_FALSE;

  do {
    if (!GmshGetWord(in, word)) return PETSC_FALSE;
    if (!strcmp(word, "$Comments")) comments = PETSC_TRUE;
    else if (!comments) return PETSC_TRUE;
    if (!strcmp(word, "$EndComments")) comments = PETSC_FALSE;
  } while (PETSC_TRUE);
}

PetscBool GmshExpect(GmshStream *in, const char section[], const char word[])
{
  return strcmp(word, section) ? GmshWrong(in, "%s is expected instead of \"%s\"", section, word) : PETSC_TRUE;
}

PetscBool GmshExpectNext(GmshStream *in, const char section[])
{
  char word[GMSH_WORD];

  return GmshGetWord(in, word) && GmshExpect(in, section, word);
}

PetscBool GmshGetBytes(GmshStream *in, size_t n, void *value)
{
  char bytes[8];

  if (fread(bytes, 1, n, in->file) != n) return GmshWrong(in, "it ends too early");
  for (size_t i = 0; i < n; ++i) ((char *)value)[i] = bytes[in->swapped ? n - 1 - i : i];
  return PETSC_TRUE;
}

/* Reads n integers of `width` bytes */
PetscBool GmshGetNumbers(GmshStream *in, int width, PetscInt64 n, PetscInt64 values[])
{
  for (PetscInt64 i = 0; i < n; ++i) {
    long long value  = 0;
    int       narrow = 0;

    if (!in->binary) {
      if (fscanf(in->file, "%lld", &value) != 1)
        return GmshWrong(in, feof(in->file) ? "it ends too early" : "an integer is expected instead of other text");
      if (width == 4 && (value > INT_MAX || value < INT_MIN))
        return GmshWrong(in, "the number %lld is too large", value);
      values[i] = (PetscInt64)value;
    } else if (width == 4) {
      if (!GmshGetBytes(in, 4, &narrow)) return PETSC_FALSE;
      values[i] = narrow;
    } else if (!GmshGetBytes(in, 8, &values[i])) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Reads n real numbers, which must be finite. values may be NULL. */
PetscBool GmshGetReals(GmshStream *in, PetscInt64 n, PetscReal values[])
{
  for (PetscInt64 i = 0; i < n; ++i) {
    double value;

    if (in->binary) {
      if (!GmshGetBytes(in, 8, &value)) return PETSC_FALSE;
    } else if (fscanf(in->file, "%le", &value) != 1)
      return GmshWrong(in, feof(in->file) ? "it ends too early" : "a coordinate is expected instead of other text");
    if (PetscIsInfOrNanReal(value)) return GmshWrong(in, "a coordinate is not a finite number");
    if (values) values[i] = (PetscReal)value;
  }
  return PETSC_TRUE;
}

/* Checks that a count is not larger than the file permits */
static PetscBool GmshIsCount(GmshStream *in, const char what[], PetscInt64 count)
{
  if (count >= 0 && count <= in->size && count < PETSC_MAX_INT / 16) return PETSC_TRUE;
  return GmshWrong(in, "its number of %s, %lld, is larger than its size permits", what, (long long)count);
}

PetscBool GmshGetCounts(GmshStream *in, const char what[], PetscInt64 n, PetscInt64 counts[])
{
  if (!GmshGetNumbers(in, in->width, n, counts)) return PETSC_FALSE;
  for (PetscInt64 i = 0; i < n; ++i) {
    if (!GmshIsCount(in, what, counts[i])) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Reads a count that format 2 writes as text even in binary files */
PetscBool GmshGetCountWord(GmshStream *in, const char what[], PetscInt64 *count)
{
  char      word[GMSH_WORD], trailing;
  long long value;

  if (!GmshGetWord(in, word)) return PETSC_FALSE;
  if (sscanf(word, "%lld%c", &value, &trailing) != 1)
    return GmshWrong(in, "the number of %s is expected instead of \"%s\"", what, word);
  *count = (PetscInt64)value;
  return GmshIsCount(in, what, *count);
}
