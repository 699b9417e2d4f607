/* Reads the facets of an STL file, text or binary, on one rank */
#include "modelimpl.h"
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STL_HEADER 84 /* bytes of a binary file before its facets */
#define STL_FACET  50 /* bytes of a facet */

/* A text file while it is read */
typedef struct {
  const char *file, *at, *end;
  PetscInt    line;
  char        word[64];
} StlText;

/* Reads the whole file */
static PetscErrorCode StlGetBytes(const char file[], size_t *length, char **bytes)
{
  FILE *stream = fopen(file, "rb");
  long  size   = 0;

  PetscFunctionBegin;
  PetscCheck(stream, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "there is no readable STL file \"%s\"", file);
  if (!fseek(stream, 0, SEEK_END)) size = ftell(stream);
  if (size < 0 || fseek(stream, 0, SEEK_SET)) size = 0;
  *length = (size_t)size;
  PetscCall(PetscMalloc1(*length + 1, bytes));
  *length           = fread(*bytes, 1, *length, stream);
  (*bytes)[*length] = 0;
  (void)fclose(stream);
  PetscFunctionReturn(0);
}

/* Reads the next word; it is empty at the end of the file */
static void StlNext(StlText *t)
{
  size_t n = 0;

  while (t->at < t->end && isspace((unsigned char)*t->at)) t->line += *t->at++ == '\n';
  while (t->at < t->end && !isspace((unsigned char)*t->at)) {
    if (n + 1 < sizeof(t->word)) t->word[n++] = *t->at;
    ++t->at;
  }
  t->word[n] = 0;
}

static PetscErrorCode StlExpect(StlText *t, const char word[])
{
  PetscFunctionBegin;
  StlNext(t);
  PetscCheck(!strcmp(t->word, word), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "%s: line %" PetscInt_FMT ": \"%s\" is expected instead of %s%s%s", t->file, t->line, word, t->word[0] ? "\"" : "",
    t->word[0] ? t->word : "the end of the file", t->word[0] ? "\"" : "");
  PetscFunctionReturn(0);
}

static PetscErrorCode StlGetNumber(StlText *t, PetscReal *value)
{
  char  *end;
  double number;

  PetscFunctionBegin;
  StlNext(t);
  number = strtod(t->word, &end);
  PetscCheck(t->word[0] && !*end && !PetscIsInfOrNanReal(number), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "%s: line %" PetscInt_FMT ": a number is expected instead of \"%s\"", t->file, t->line, t->word);
  *value = number;
  PetscFunctionReturn(0);
}

/* Reads the rest of a facet, whose first word has been read */
static PetscErrorCode StlGetFacet(StlText *t, PetscReal x[9])
{
  PetscReal normal;

  PetscFunctionBegin;
  PetscCall(StlExpect(t, "normal"));
  for (PetscInt c = 0; c < 3; ++c) PetscCall(StlGetNumber(t, &normal));
  PetscCall(StlExpect(t, "outer"));
  PetscCall(StlExpect(t, "loop"));
  for (PetscInt i = 0; i < 9; ++i) {
    if (i % 3 == 0) PetscCall(StlExpect(t, "vertex"));
    PetscCall(StlGetNumber(t, &x[i]));
  }
  PetscCall(StlExpect(t, "endloop"));
  PetscCall(StlExpect(t, "endfacet"));
  PetscFunctionReturn(0);
}

/* Skips the rest of the line, which is a name */
static void StlSkipLine(StlText *t)
{
  while (t->at < t->end && *t->at != '\n') ++t->at;
}

static PetscErrorCode StlReadText(const char file[], size_t length, const char bytes[], StlFacets *facets)
{
  StlText  t   = {.file = file, .at = bytes, .end = bytes + length, .line = 1};
  PetscInt max = 0;

  PetscFunctionBegin;
  PetscCall(StlExpect(&t, "solid"));
  StlSkipLine(&t);
  for (StlNext(&t); t.word[0]; StlNext(&t)) {
    if (!strcmp(t.word, "endsolid") || !strcmp(t.word, "solid")) {
      StlSkipLine(&t);
      continue;
    }
    PetscCheck(!strcmp(t.word, "facet"), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
      "%s: line %" PetscInt_FMT ": \"facet\" or \"endsolid\" is expected instead of \"%s\"", file, t.line, t.word);
    if (facets->n == max) {
      max = 2 * max + 256;
      PetscCall(PetscRealloc(sizeof(PetscReal) * 9 * (size_t)max, &facets->x));
      PetscCall(PetscRealloc(sizeof(PetscInt) * (size_t)max, &facets->line));
    }
    facets->line[facets->n] = t.line;
    PetscCall(StlGetFacet(&t, &facets->x[9 * facets->n++]));
  }
  PetscFunctionReturn(0);
}

/* Returns a whole number of four bytes, the lowest first */
static unsigned long StlWhole(const char bytes[])
{
  const unsigned char *b = (const unsigned char *)bytes;

  return (unsigned long)b[0] | (unsigned long)b[1] << 8 | (unsigned long)b[2] << 16 | (unsigned long)b[3] << 24;
}

static PetscErrorCode StlReadBinary(const char file[], PetscInt n, const char bytes[], StlFacets *facets)
{
  PetscFunctionBegin;
  facets->n = n;
  PetscCall(PetscMalloc1(9 * (size_t)n, &facets->x));
  PetscCall(PetscCalloc1(n, &facets->line));
  for (PetscInt i = 0; i < 9 * n; ++i) {
    const uint32_t whole = (uint32_t)StlWhole(bytes + STL_HEADER + STL_FACET * (size_t)(i / 9) + 12 + 4 * (i % 9));
    float          value;

    memcpy(&value, &whole, sizeof(value));
    PetscCheck(!PetscIsInfOrNanReal((PetscReal)value), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
      "%s: facet %" PetscInt_FMT ": a coordinate is not a number", file, i / 9 + 1);
    facets->x[i] = (PetscReal)value;
  }
  PetscFunctionReturn(0);
}

/* Reads all facets. A file is binary if its length agrees with its number of facets. */
PetscErrorCode StlRead(const char file[], StlFacets *facets)
{
  size_t length;
  char  *bytes;

  PetscFunctionBegin;
  PetscCall(StlGetBytes(file, &length, &bytes));
  if (length >= STL_HEADER && length == STL_HEADER + STL_FACET * (size_t)StlWhole(bytes + STL_HEADER - 4)) {
    PetscCall(StlReadBinary(file, (PetscInt)StlWhole(bytes + STL_HEADER - 4), bytes, facets));
  } else {
    PetscCheck(length >= 5 && !memchr(bytes, 0, length), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
      "%s has %zu bytes: it is neither an STL text, nor a binary STL file with the number of facets that its header "
      "gives",
      file, length);
    PetscCall(StlReadText(file, length, bytes, facets));
  }
  PetscCall(PetscFree(bytes));
  PetscCheck(facets->n, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "%s has no facets", file);
  PetscFunctionReturn(0);
}
