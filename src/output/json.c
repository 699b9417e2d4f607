/* Writes the report of a run as JSON, with the fields that schema.c lists. */
#include "outputimpl.h"
#include <math.h>

static void JSONString(FILE *stream, const char text[])
{
  fputc('"', stream);
  for (const unsigned char *c = (const unsigned char *)(text ? text : ""); *c; ++c) {
    if (*c == '"' || *c == '\\') fprintf(stream, "\\%c", *c);
    else if (*c < 0x20) fprintf(stream, "\\u%04x", (unsigned)*c);
    else fputc(*c, stream);
  }
  fputc('"', stream);
}

/* Writes a number; NaN and infinity, which JSON does not have, are written as null. */
static void JSONNumber(FILE *stream, double value)
{
  if (PetscIsInfOrNanReal((PetscReal)value)) fputs("null", stream);
  else fprintf(stream, "%.17g", value);
}

static void JSONVector(FILE *stream, const PetscReal value[3])
{
  for (PetscInt i = 0; i < 3; ++i) {
    fputs(i ? ", " : "[", stream);
    JSONNumber(stream, (double)value[i]);
  }
  fputc(']', stream);
}

static void JSONInts(FILE *stream, PetscInt n, const PetscInt value[])
{
  fputc('[', stream);
  for (PetscInt i = 0; i < n; ++i) fprintf(stream, "%s%" PetscInt_FMT, i ? ", " : "", value[i]);
  fputc(']', stream);
}

static void JSONTexts(FILE *stream, PetscInt n, const char *const text[])
{
  fputc('[', stream);
  for (PetscInt i = 0; i < n; ++i) {
    if (i) fputs(", ", stream);
    JSONString(stream, text[i]);
  }
  fputc(']', stream);
}

/*
   Writes an object with one value per body, whose keys are the names of the bodies. ints: the values; NULL: `reals` are
   written. reals: the values; NULL: they are not known and written as null.
*/
static void JSONBodies(FILE *stream, const RunReport *run, const PetscInt ints[], const PetscReal reals[])
{
  fputc('{', stream);
  for (PetscInt b = 0; b < run->nbodies; ++b) {
    if (b) fputs(", ", stream);
    JSONString(stream, run->bodies[b]);
    fputs(": ", stream);
    if (ints) fprintf(stream, "%" PetscInt_FMT, ints[b]);
    else JSONNumber(stream, reals ? (double)reals[b] : NAN);
  }
  fputc('}', stream);
}

static void JSONRecord(FILE *, const RunReport *, const ReportRecord *, const void *record, int indent);

static void JSONList(FILE *stream, const RunReport *run, const ReportRecord *type, PetscInt n, const char *records,
  int indent)
{
  fputc('[', stream);
  for (PetscInt i = 0; i < n; ++i) {
    fprintf(stream, "%s\n%*s", i ? "," : "", indent + 2, "");
    JSONRecord(stream, run, type, records + (size_t)i * type->size, indent + 2);
  }
  fprintf(stream, "\n%*s]", indent, "");
}

static void JSONValue(FILE *stream, const RunReport *run, const ReportField *field, const void *record, int indent)
{
  const void *value = SchemaAt(field, record);

  switch (field->type) {
  case FIELD_INT: fprintf(stream, "%" PetscInt_FMT, *(const PetscInt *)value); break;
  case FIELD_REAL:
  case FIELD_DOUBLE: JSONNumber(stream, SchemaNumber(field, record)); break;
  case FIELD_BOOL: fputs(*(const PetscBool *)value ? "true" : "false", stream); break;
  case FIELD_TEXT:
  case FIELD_CHARS: JSONString(stream, SchemaText(field, record)); break;
  case FIELD_TEXTS: JSONTexts(stream, SchemaCount(field, record), *(const char *const *const *)value); break;
  case FIELD_VECTOR: JSONVector(stream, (const PetscReal *)value); break;
  case FIELD_INTS: JSONInts(stream, SchemaCount(field, record), *(const PetscInt *const *)value); break;
  case FIELD_BODY_INTS: JSONBodies(stream, run, *(const PetscInt *const *)value, NULL); break;
  case FIELD_BODY_REALS: JSONBodies(stream, run, NULL, *(const PetscReal *const *)value); break;
  case FIELD_LIST:
    JSONList(stream, run, field->record, SchemaCount(field, record), *(const char *const *)value, indent);
    break;
  case FIELD_RECORD: JSONRecord(stream, run, field->record, value, indent); break;
  case FIELD_POINTER: JSONRecord(stream, run, field->record, *(const void *const *)value, indent); break;
  }
}

/*
   Writes a record as an object, on one line if type->one_line is true, otherwise with one line per field. A
   FIELD_POINTER that is NULL is omitted together with its key. indent: number of blanks before the closing brace.
*/
static void JSONRecord(FILE *stream, const RunReport *run, const ReportRecord *type, const void *record, int indent)
{
  PetscBool first = PETSC_TRUE;

  fputc('{', stream);
  for (const ReportField *field = type->fields; field->name; ++field) {
    if (field->type == FIELD_POINTER && !*(const void *const *)SchemaAt(field, record)) continue;
    if (!first) fputs(type->one_line ? ", " : ",", stream);
    if (!type->one_line) fprintf(stream, "\n%*s", indent + 2, "");
    fprintf(stream, "\"%s\": ", field->name);
    JSONValue(stream, run, field, record, indent + 2);
    first = PETSC_FALSE;
  }
  if (!type->one_line) fprintf(stream, "\n%*s", indent, "");
  fputc('}', stream);
}

static PetscErrorCode JSONReport(FILE *stream, const void *ctx)
{
  PetscFunctionBegin;
  JSONRecord(stream, (const RunReport *)ctx, &SchemaRun, ctx, 0);
  fputc('\n', stream);
  PetscFunctionReturn(0);
}

/*@C
   ReportWriteJSON - Writes the report of a run for programs

   Collective

   Input Parameters:
+  comm   - the communicator; its first rank writes
.  report - the report, the same on every rank
-  file   - the file; an older one is replaced when the new one is complete

   Level: intermediate

   Note:
   The keys are the members of RunReport, StepReport and the structures in them, listed in src/output/schema.c. Numbers
   have full precision; NaN and infinity become null.

   Errors: PETSC_ERR_FILE_OPEN, on all ranks, where the file cannot be written.

.seealso: `ReportView()`
@*/
PetscErrorCode ReportWriteJSON(MPI_Comm comm, const RunReport *report, const char file[])
{
  PetscFunctionBegin;
  PetscCall(FileWriteText(comm, file, JSONReport, report));
  PetscFunctionReturn(0);
}
