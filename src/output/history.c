/*
   Writes the history of a run: a CSV table with one row per load step and one column for each number of the step's
   report.
*/
#define _POSIX_C_SOURCE 200809L /* for getline() */
#include "outputimpl.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
   Context with which a row is written. The row contains the names of the columns if `heading` is true, otherwise the
   values of a load step.
*/
typedef struct {
  Output             output;
  const StepReport  *report;
  FILE              *stream;
  PetscBool          heading;
  PetscBool          first;   /* true while nothing has been written to the row */
  PetscInt           npoints; /* number of points of a line probe */
  const ProbeReport *points;
} HistoryLine;

/* Table of an earlier run, and the last load step whose row is copied from it. */
typedef struct {
  const char *file;
  PetscInt    step;
} HistoryOlder;

/*
   Writes the name of a column, in quotes if the name of the owner contains a comma, a quote or a line break, which is
   possible for names from Gmsh files.
*/
static void HistoryPutName(HistoryLine *line, const char owner[], const char name[], const char component[])
{
  const char *const pieces[] = {owner, owner[0] ? "." : "", name, component[0] ? "_" : "", component};
  const PetscBool   quoted   = (PetscBool)(strpbrk(owner, ",\"\n") != NULL);

  if (quoted) fputc('"', line->stream);
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(pieces); ++i) {
    for (const char *c = pieces[i]; *c; ++c) {
      if (*c == '"') fputc('"', line->stream);
      fputc(*c, line->stream);
    }
  }
  if (quoted) fputc('"', line->stream);
}

static void HistoryPut(HistoryLine *line, const char owner[], const char name[], const char component[], double value)
{
  if (!line->first) fputc(',', line->stream);
  line->first = PETSC_FALSE;
  if (line->heading) HistoryPutName(line, owner, name, component);
  else if (PetscIsNanReal((PetscReal)value)) fputs("nan", line->stream);
  else fprintf(line->stream, "%.15g", value);
}

static double HistorySum(PetscInt n, const PetscInt values[])
{
  double sum = 0;

  for (PetscInt i = 0; i < n; ++i) sum += (double)values[i];
  return sum;
}

static void HistoryPutRecord(HistoryLine *, const ReportRecord *, const void *record, const char owner[]);

/*
   Writes one column for a scalar field and several columns for a vector or a list. owner: name of the pair, face or
   body to which the value belongs; "" if it belongs to the load step.
*/
static void HistoryPutField(HistoryLine *line, const ReportField *field, const void *record, const char owner[])
{
  const void *value = SchemaAt(field, record);

  switch (field->type) {
  case FIELD_INT:
  case FIELD_REAL:
  case FIELD_DOUBLE:
  case FIELD_BOOL: HistoryPut(line, owner, field->name, "", SchemaNumber(field, record)); break;
  case FIELD_VECTOR:
    for (int d = 0; d < 3; ++d)
      HistoryPut(line, owner, field->name, (const char *[]){"x", "y", "z"}[d], (double)((const PetscReal *)value)[d]);
    break;
  case FIELD_INTS:
    HistoryPut(line, owner, field->name, "", HistorySum(SchemaCount(field, record), *(const PetscInt *const *)value));
    break;
  case FIELD_BODY_REALS:
    for (PetscInt b = 0; b < line->output->nbodies; ++b)
      HistoryPut(line, line->output->bodynames[b], field->name, "",
        *(const PetscReal *const *)value ? (double)(*(const PetscReal *const *)value)[b] : NAN);
    break;
  case FIELD_LIST:
    if (field->record == &SchemaLines) break; /* the values of line probes are written to files of their own */
    for (PetscInt i = 0; i < SchemaCount(field, record); ++i) {
      const char *item = *(const char *const *)value + (size_t)i * field->record->size;

      HistoryPutRecord(line, field->record, item, SchemaText(field->record->fields, item));
    }
    break;
  case FIELD_RECORD: HistoryPutRecord(line, field->record, value, field->name); break;
  default: /* texts are not written, since the table has only numbers */ break;
  }
}

/*
   Writes all fields of a record. owner: name of the pair, face or body, which precedes the names of the columns; "" for
   the load step.
*/
static void HistoryPutRecord(HistoryLine *line, const ReportRecord *type, const void *record, const char owner[])
{
  for (const ReportField *field = type->fields; field->name; ++field) HistoryPutField(line, field, record, owner);
}

static PetscErrorCode HistoryWriteLine(FILE *stream, const HistoryLine *ctx, PetscBool heading)
{
  HistoryLine line = *ctx;

  PetscFunctionBegin;
  line.stream  = stream;
  line.heading = heading;
  line.first   = PETSC_TRUE;
  HistoryPutRecord(&line, &SchemaSteps, line.report, "");
  fputc('\n', stream);
  PetscFunctionReturn(0);
}

static PetscErrorCode HistoryAppend(FILE *stream, const void *ctx)
{
  PetscFunctionBegin;
  PetscCall(HistoryWriteLine(stream, (const HistoryLine *)ctx, PETSC_FALSE));
  PetscFunctionReturn(0);
}

static PetscErrorCode HistoryBegin(FILE *stream, const void *ctx)
{
  PetscFunctionBegin;
  PetscCall(HistoryWriteLine(stream, (const HistoryLine *)ctx, PETSC_TRUE));
  PetscCall(HistoryWriteLine(stream, (const HistoryLine *)ctx, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/* Writes the row of one point of a line probe: the load step, its time and all values at the point. */
static void HistoryPutPoint(HistoryLine *line, const ProbeReport *point)
{
  line->first = PETSC_TRUE;
  HistoryPut(line, "", "step", "", (double)line->report->step);
  HistoryPut(line, "", "time", "", (double)line->report->time);
  HistoryPutRecord(line, &SchemaLines, point, "");
  fputc('\n', line->stream);
}

static PetscErrorCode HistoryAppendLine(FILE *stream, const void *ctx)
{
  HistoryLine line = *(const HistoryLine *)ctx;

  PetscFunctionBegin;
  line.stream = stream;
  for (PetscInt k = 0; k < line.npoints; ++k) HistoryPutPoint(&line, &line.points[k]);
  PetscFunctionReturn(0);
}

static PetscErrorCode HistoryBeginLine(FILE *stream, const void *ctx)
{
  HistoryLine line = *(const HistoryLine *)ctx;

  PetscFunctionBegin;
  line.stream  = stream;
  line.heading = PETSC_TRUE;
  HistoryPutPoint(&line, line.points);
  PetscCall(HistoryAppendLine(stream, ctx));
  PetscFunctionReturn(0);
}

/*
   Copies the heading of an earlier table and the rows of all load steps up to older->step. FileWriteText() calls this
   function on rank 0 only.
*/
static PetscErrorCode HistoryCopyOlder(FILE *to, const void *ctx)
{
  const HistoryOlder *older   = (const HistoryOlder *)ctx;
  FILE               *from    = fopen(older->file, "r");
  char               *text    = NULL;
  size_t              size    = 0;
  PetscBool           heading = PETSC_TRUE;

  PetscFunctionBegin;
  while (from && getline(&text, &size, from) > 0) {
    if (heading || strtod(text, NULL) <= (double)older->step) fputs(text, to);
    heading = PETSC_FALSE;
  }
  free(text);
  if (from) (void)fclose(from);
  PetscFunctionReturn(0);
}

/*
   Finds whether rows are appended to an existing table, and removes the rows of later load steps from the table of an
   earlier run. *goes_on: true if rows are appended; false if a new table is begun.
*/
static PetscErrorCode HistoryContinue(Output output, const char file[], PetscBool *goes_on)
{
  const HistoryOlder older = {.file = file, .step = output->continued};

  PetscFunctionBegin;
  *goes_on = output->begun;
  if (output->begun || !output->continued) PetscFunctionReturn(0);
  PetscCall(PetscTestFile(file, 'r', goes_on));
  PetscCallMPI(MPI_Bcast(goes_on, 1, MPI_PETSCBOOL, 0, output->comm));
  if (*goes_on) PetscCall(FileWriteText(output->comm, file, HistoryCopyOlder, &older));
  PetscFunctionReturn(0);
}

/*
   Writes rows to a table. The first load step of an output begins a new table unless the run continues an earlier one.
   begin: writes the heading and the first rows; append: writes the rows.
*/
static PetscErrorCode HistoryWriteFile(const HistoryLine *line, const char name[],
  PetscErrorCode (*begin)(FILE *, const void *), PetscErrorCode (*append)(FILE *, const void *))
{
  char      file[PETSC_MAX_PATH_LEN];
  PetscBool goes_on;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(file, sizeof(file), "%s%s%s.csv", line->output->base, name[0] ? "_" : "", name));
  PetscCall(HistoryContinue(line->output, file, &goes_on));
  if (!goes_on) PetscCall(FileWriteText(line->output->comm, file, begin, line));
  else PetscCall(FileAppendText(line->output->comm, file, append, line));
  PetscFunctionReturn(0);
}

/*
   Writes a row to the table of load steps, and rows to the tables of line probes. The points of a line probe are
   consecutive in report->lines[].
*/
PetscErrorCode OutputWriteHistory(Output output, const StepReport *report)
{
  HistoryLine line = {.output = output, .report = report};

  PetscFunctionBegin;
  PetscCall(HistoryWriteFile(&line, "", HistoryBegin, HistoryAppend));
  for (PetscInt k = 0; k < report->nlines; k += line.npoints) {
    line.points  = &report->lines[k];
    line.npoints = 1;
    while (k + line.npoints < report->nlines && !strcmp(report->lines[k].name, report->lines[k + line.npoints].name))
      ++line.npoints;
    PetscCall(HistoryWriteFile(&line, report->lines[k].name, HistoryBeginLine, HistoryAppendLine));
  }
  PetscFunctionReturn(0);
}
