/* Prints a table with one row per record. schema.c describes the columns. */
#include "outputimpl.h"
#include <math.h>
#include <string.h>

static const char *TableFormat(const ReportField *field, const ReportColumn *column)
{
  if (column->format) return column->format;
  switch (field->type) {
  case FIELD_BOOL: return "";
  case FIELD_INT:
  case FIELD_INTS: return "%.0f";
  case FIELD_DOUBLE: return "%.3f";
  case FIELD_VECTOR: return "%13.6e";
  default: return "%.2e";
  }
}

static double TableShown(ReportShown shown, double value)
{
  switch (shown) {
  case SHOWN_SQUARE: return value * value;
  case SHOWN_PERCENT: return 100 * value;
  default: return value;
  }
}

static double TableSum(const ReportField *field, const void *record, ReportShown shown)
{
  const PetscInt *values = *(const PetscInt *const *)SchemaAt(field, record), n = SchemaCount(field, record);
  double          sum = 0.0;

  for (PetscInt i = 0; i < n; ++i) sum += (double)values[i];
  return shown == SHOWN_MEAN && n ? sum / (double)n : sum;
}

static void TableVector(const char format[], const PetscReal v[3], char text[], size_t length)
{
  char number[3][32];

  for (PetscInt i = 0; i < 3; ++i) (void)snprintf(number[i], sizeof(number[i]), format, (double)v[i]);
  (void)snprintf(text, length, "%s %s %s", number[0], number[1], number[2]);
}

/* Returns the text of a cell of the table; a number is printed to `text`. NULL: the cell is empty. */
static const char *TableText(const ReportField *field, const ReportColumn *column, const void *record, char text[],
  size_t length)
{
  const char  *format = TableFormat(field, column);
  const double value  = SchemaNumber(field, record);

  switch (field->type) {
  case FIELD_TEXT:
  case FIELD_CHARS: return SchemaText(field, record);
  case FIELD_BOOL: return value != 0.0 ? format : field->absent;
  case FIELD_VECTOR: TableVector(format, (const PetscReal *)SchemaAt(field, record), text, length); return text;
  case FIELD_INTS: (void)snprintf(text, length, format, TableSum(field, record, column->shown)); return text;
  default: break;
  }
  if (isnan(value) && field->absent) return field->absent[0] ? field->absent : NULL;
  (void)snprintf(text, length, format, TableShown(column->shown, value));
  return text;
}

/*
   Prints a cell of the table. Nothing is printed, not even blanks, if the text is empty and the column has the width of
   its text (width 0).
*/
static PetscErrorCode TablePut(const ReportColumn *column, PetscBool first, int width, const char text[],
  PetscViewer viewer)
{
  PetscFunctionBegin;
  if (text && (text[0] || width))
    PetscCall(PetscViewerASCIIPrintf(viewer, "%*s%*s", first ? 0 : 1 + column->blanks, "", width, text));
  PetscFunctionReturn(0);
}

/*
   Prints one column per body. record: the record with the values; NULL: the names of the bodies are printed as the
   heading.
*/
static PetscErrorCode TableBodies(const RunReport *run, const ReportField *field, const ReportColumn *column,
  const void *record, PetscViewer viewer)
{
  const PetscReal *values = record ? *(const PetscReal *const *)SchemaAt(field, record) : NULL;
  char             text[64];

  PetscFunctionBegin;
  if (record && !values) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < run->nbodies; ++b) {
    const int width = PetscMax(column->width, (int)strlen(run->bodies[b]));

    if (record)
      (void)snprintf(text, sizeof(text), TableFormat(field, column), TableShown(column->shown, (double)values[b]));
    PetscCall(TablePut(column, PETSC_FALSE, width, record ? text : run->bodies[b], viewer));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode TableHead(const ReportField *field, const ReportColumn *column, PetscInt line, PetscBool first,
  PetscViewer viewer)
{
  char head[64];

  PetscFunctionBegin;
  if (column->with_unit) PetscCall(PetscSNPrintf(head, sizeof(head), "%s [%s]", column->head[line], field->unit));
  PetscCall(TablePut(column, first, column->width, column->with_unit ? head : column->head[line], viewer));
  PetscFunctionReturn(0);
}

/*
   Prints one line of a table. record: the record whose row is printed; NULL: line `line` (0 or 1) of the heading is
   printed.
*/
static PetscErrorCode TableLine(const RunReport *run, ReportTable table, const ReportField fields[], const void *record,
  PetscInt line, PetscViewer viewer)
{
  PetscBool first = PETSC_TRUE;
  char      text[128];

  PetscFunctionBegin;
  for (int behind = 0; behind < 2; ++behind) {
    for (const ReportField *field = fields; field->name; ++field) {
      for (size_t c = 0; c < PETSC_STATIC_ARRAY_LENGTH(field->columns); ++c) {
        const ReportColumn *column = &field->columns[c];

        if ((column->table != table && column->table != TABLE_EVERY) || column->behind != (PetscBool)behind) continue;
        if (field->type == FIELD_BODY_REALS) PetscCall(TableBodies(run, field, column, record, viewer));
        else if (record)
          PetscCall(
            TablePut(column, first, column->width, TableText(field, column, record, text, sizeof(text)), viewer));
        else PetscCall(TableHead(field, column, line, first, viewer));
        first = PETSC_FALSE;
      }
    }
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscFunctionReturn(0);
}

PetscErrorCode TableViewHead(const RunReport *run, ReportTable table, const ReportRecord *type, PetscInt line,
  PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(TableLine(run, table, type->fields, NULL, line, viewer));
  PetscFunctionReturn(0);
}

PetscErrorCode TableViewRows(const RunReport *run, ReportTable table, const ReportRecord *type, PetscInt n,
  const void *records, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i)
    PetscCall(TableLine(run, table, type->fields, (const char *)records + (size_t)i * type->size, 0, viewer));
  PetscFunctionReturn(0);
}

/*
   Returns the text of the first column of a field if this column belongs to `table`. NULL: the column belongs to
   another table, or the cell is empty.
*/
const char *TableGetText(ReportTable table, const ReportField *field, const void *record, char text[], size_t length)
{
  return field->columns[0].table == table ? TableText(field, &field->columns[0], record, text, length) : NULL;
}
