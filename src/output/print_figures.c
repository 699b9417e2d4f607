/* Prints the largest values of a run: a table of the bodies, and one of the pairs, faces and bolts */
#include "outputimpl.h"
#include "src/report/reportimpl.h"

#define CELL           96   /* longest text of a cell, with its end */
#define FIGURE_SAME    1e-5 /* relative difference of forces that are printed as one */
#define FIGURE_ROWS    8    /* largest number of rows of a table, and of symmetry reactions */
#define FIGURE_COLUMNS 32   /* more than any table has */

/* A table of texts. The first row is the heading, the first column has the names. values: the numbers
   in the cells */
typedef struct {
  PetscInt nrows, ncolumns;
  char (*cells)[CELL];
  PetscReal *values;
} FigureTable;

static const char place_heading[] = "at", components_heading[] = "components";
static const char stress_column[] = "von Mises stress", safety_column[] = "safety";

static char *FigureTableCell(const FigureTable *table, PetscInt row, PetscInt column)
{
  return table->cells[row * table->ncolumns + column];
}

/* Writes a place or the components of a force. Components below 1e-9 of the largest one are written as 0. */
static void FigureWriteVector(const PetscReal v[3], char text[CELL])
{
  const PetscReal tiny = REPORT_ZERO * PetscMax(PetscAbsReal(v[0]), PetscMax(PetscAbsReal(v[1]), PetscAbsReal(v[2])));
  double          clean[3];

  for (PetscInt d = 0; d < 3; ++d) clean[d] = PetscAbsReal(v[d]) <= tiny ? 0.0 : (double)v[d];
  (void)snprintf(text, CELL, "(%.5g, %.5g, %.5g)", clean[0], clean[1], clean[2]);
}

/* Returns the length of the name of a body, pair or face; that of a rigid body as a whole, BODY.*, without the end */
static int FigureNameLength(const char name[])
{
  const char *end = strstr(name, ".*");

  return (int)(end ? (size_t)(end - name) : strlen(name));
}

/* Returns the figure of a pair's force or of a face's reaction that comes next after number f; NULL: none. name: of the
   pair or face; NULL: of any. */
static const RunFigure *FigureNextForce(const RunReport *report, FigureOwner owner, const char name[], PetscInt *f)
{
  while (*f < report->nfigures) {
    const RunFigure *figure = &report->figures[(*f)++];

    if (figure->owner == owner && !PetscIsNanReal(figure->components[0]) && (!name || !strcmp(figure->name, name)))
      return figure;
  }
  return NULL;
}

static const PairReport *FigureFindPair(const RunReport *report, const RunFigure *figure)
{
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    for (PetscInt p = 0; p < report->steps[s].npairs && report->steps[s].step == figure->step; ++p) {
      if (!strcmp(report->steps[s].pairs[p].name, figure->name)) return &report->steps[s].pairs[p];
    }
  }
  return NULL;
}

/* Returns whether a rigid body transmits nothing but the force of a pair, so that one row has both. Both are figures
   with components. */
static PetscBool FigureIsTool(const RunReport *report, const RunFigure *force, const RunFigure *reaction)
{
  const int         length = FigureNameLength(reaction->name);
  const PairReport *pair;

  if (!reaction->name[length] || force->step != reaction->step) return PETSC_FALSE;
  for (PetscInt d = 0; d < 3; ++d) {
    if (PetscAbsReal(force->components[d] - reaction->components[d]) > FIGURE_SAME * force->value) return PETSC_FALSE;
  }
  pair = FigureFindPair(report, force);
  return (PetscBool)(pair && pair->mortar && pair->mortar[length] == '.' &&
                     !strncmp(pair->mortar, reaction->name, (size_t)length));
}

/* Writes the name of a row: that of a body, pair, face or bolt, or "pair, tool" */
static void FigureWriteName(const RunReport *report, const RunFigure *figure, char text[CELL])
{
  const char *pair   = figure->owner == FIGURE_OF_PAIR ? figure->name : NULL,
             *face   = figure->owner == FIGURE_OF_FACE ? figure->name : NULL;
  PetscInt         f = 0, g;
  const RunFigure *force, *reaction;

  (void)snprintf(text, CELL, "%.*s", FigureNameLength(figure->name), figure->name);
  if (!pair && !face) return;
  while ((force = FigureNextForce(report, FIGURE_OF_PAIR, pair, &f))) {
    g = 0;
    while ((reaction = FigureNextForce(report, FIGURE_OF_FACE, face, &g))) {
      if (!FigureIsTool(report, force, reaction)) continue;
      (void)snprintf(text, CELL, "%s, %.*s", force->name, FigureNameLength(reaction->name), reaction->name);
      return;
    }
  }
}

/* Returns the number of the text in the heading or among the names, of which there are n - 1, or n if there is none */
static PetscInt FigureTableFind(const FigureTable *table, PetscBool row, const char text[], PetscInt n)
{
  PetscInt i = 1;

  while (i < n && strcmp(row ? FigureTableCell(table, 0, i) : FigureTableCell(table, i, 0), text)) ++i;
  return i;
}

/* Returns whether a figure is a contact area that is only one facet wide */
static PetscBool FigureIsNarrow(const RunReport *report, const RunFigure *figure)
{
  const PairReport *pair = strcmp(figure->quantity, "contact area") ? NULL : FigureFindPair(report, figure);

  return (PetscBool)(pair && figure->value > 0.0 && pair->narrow);
}

/* Writes a figure to its row and columns: its value, place or components, and load step if there are several */
static PetscErrorCode FigureTableAdd(FigureTable *table, const RunReport *report, const RunFigure *figure,
  PetscBool steps, PetscInt *nrows, PetscInt *ncolumns)
{
  const PetscReal *vector = PetscIsNanReal(figure->place[0]) ? figure->components : figure->place;
  char             heading[CELL], name[CELL];
  PetscInt         row, column;

  PetscFunctionBegin;
  (void)snprintf(heading, CELL, figure->unit[0] ? "%s [%s]" : "%s", figure->column, figure->unit);
  FigureWriteName(report, figure, name);
  column = FigureTableFind(table, PETSC_TRUE, heading, *ncolumns);
  row    = FigureTableFind(table, PETSC_FALSE, name, *nrows);
  (void)snprintf(FigureTableCell(table, 0, column), CELL, "%s", heading);
  (void)snprintf(FigureTableCell(table, row, 0), CELL, "%s", name);
  (void)snprintf(FigureTableCell(table, row, column), CELL, "%.5g%s", (double)figure->value,
    FigureIsNarrow(report, figure) ? " (one facet wide)" : "");
  table->values[row * table->ncolumns + column] = figure->value;
  *nrows                                        = PetscMax(*nrows, row + 1);
  *ncolumns                                     = PetscMax(*ncolumns, column + 1);
  if (PetscIsNanReal(vector[0])) PetscFunctionReturn(0);
  (void)snprintf(FigureTableCell(table, 0, column + 1), CELL, "%s",
    vector == figure->place ? place_heading : components_heading);
  FigureWriteVector(vector, FigureTableCell(table, row, column + 1));
  if (steps) {
    (void)snprintf(FigureTableCell(table, 0, column + 2), CELL, "step");
    (void)snprintf(FigureTableCell(table, row, column + 2), CELL, "%" PetscInt_FMT, figure->step);
  }
  *ncolumns = PetscMax(*ncolumns, column + (steps ? 3 : 2));
  if (strcmp(figure->column, stress_column)) PetscFunctionReturn(0);
  /* The column is there for all bodies with stresses: "-" says that the material has no yield stress */
  column = FigureTableFind(table, PETSC_TRUE, safety_column, *ncolumns);
  (void)snprintf(FigureTableCell(table, 0, column), CELL, "%s", safety_column);
  *ncolumns = PetscMax(*ncolumns, column + 1);
  PetscFunctionReturn(0);
}

/* Returns true if a column has names, places or components, which are aligned to the left */
static PetscBool FigureTableIsLeft(const FigureTable *table, PetscInt column)
{
  const char *heading = FigureTableCell(table, 0, column);

  return (PetscBool)(!column || !strcmp(heading, place_heading) || !strcmp(heading, components_heading));
}

/* Returns the row with the largest value of a column, or the smallest safety factor; 0: none */
static PetscInt FigureTableFindLargest(const FigureTable *table, PetscInt nrows, PetscInt column)
{
  const PetscReal sign    = strcmp(FigureTableCell(table, 0, column), safety_column) ? 1.0 : -1.0;
  PetscInt        best    = 0;
  PetscReal       largest = 0.0;

  for (PetscInt row = 1; row < nrows; ++row) {
    const PetscReal value = sign * table->values[row * table->ncolumns + column];

    if (!FigureTableCell(table, row, column)[0] || (best && value <= largest)) continue;
    best    = row;
    largest = value;
  }
  return best;
}

/* Moves the rows that are printed to the beginning, if there are too many: those with the largest values, and the first
   of the others. All keep their order. Returns the number of rows that remain. */
static PetscErrorCode FigureTableShorten(FigureTable *table, PetscInt ncolumns, PetscInt *nrows)
{
  PetscBool *shown;
  PetscInt   n = 0, at = 0;

  PetscFunctionBegin;
  if (*nrows <= FIGURE_ROWS + 1) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(*nrows, &shown));
  for (PetscInt column = 0; column < ncolumns; ++column) {
    if (FigureTableIsLeft(table, column) || !strcmp(FigureTableCell(table, 0, column), "step")) continue;
    shown[FigureTableFindLargest(table, *nrows, column)] = PETSC_TRUE;
  }
  shown[0] = PETSC_TRUE;
  for (PetscInt row = 0; row < *nrows; ++row) n += shown[row];
  for (PetscInt row = 1; row < *nrows && n <= FIGURE_ROWS; ++row) {
    n += !shown[row];
    shown[row] = PETSC_TRUE;
  }
  for (PetscInt row = 0; row < *nrows; ++row) {
    if (shown[row])
      PetscCall(PetscArraymove(FigureTableCell(table, at++, 0), FigureTableCell(table, row, 0), ncolumns * CELL));
  }
  *nrows = n;
  PetscCall(PetscFree(shown));
  PetscFunctionReturn(0);
}

/* Prints a table whose columns are as wide as their texts */
static PetscErrorCode FigureTableView(FigureTable *table, PetscInt nrows, PetscInt ncolumns, PetscViewer viewer)
{
  const PetscInt all = nrows;

  PetscFunctionBegin;
  PetscCall(FigureTableShorten(table, ncolumns, &nrows));
  for (PetscInt row = 0; row < nrows; ++row) {
    for (PetscInt column = 0; column < ncolumns; ++column) {
      const char     *text  = FigureTableCell(table, row, column);
      const PetscBool left  = FigureTableIsLeft(table, column);
      int             width = 0;

      for (PetscInt i = 0; i < nrows; ++i) width = PetscMax(width, (int)strlen(FigureTableCell(table, i, column)));
      if (left && column == ncolumns - 1) width = 0;
      PetscCall(PetscViewerASCIIPrintf(viewer, "  %*s", left ? -width : width, text[0] ? text : "-"));
    }
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  }
  if (nrows < all)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  and %" PetscInt_FMT " others, none with a larger value: -summary FILE.json and -report FILE.html have all\n",
      all - nrows));
  PetscFunctionReturn(0);
}

/* Prints the figures of some owners as a table; nothing if there are none. names: what the owners are; NULL: those of
   another table. */
static PetscErrorCode FiguresViewTable(const RunReport *report, const char *const names[], PetscBool steps,
  PetscViewer viewer)
{
  FigureTable table = {.nrows = 1, .ncolumns = FIGURE_COLUMNS};
  PetscInt    nrows = 1, ncolumns = 1;
  char        heading[CELL] = "";

  PetscFunctionBegin;
  for (PetscInt f = 0; f < report->nfigures; ++f) {
    const char *name = names[report->figures[f].owner];

    if (!name) continue;
    ++table.nrows;
    if (strstr(heading, name)) continue;
    if (heading[0]) PetscCall(PetscStrlcat(heading, ", ", CELL));
    PetscCall(PetscStrlcat(heading, name, CELL));
  }
  if (table.nrows == 1) PetscFunctionReturn(0);
  PetscCall(PetscCalloc2(table.nrows * table.ncolumns, &table.cells, table.nrows * table.ncolumns, &table.values));
  (void)snprintf(FigureTableCell(&table, 0, 0), CELL, "%s", heading);
  for (PetscInt f = 0; f < report->nfigures; ++f) {
    if (names[report->figures[f].owner])
      PetscCall(FigureTableAdd(&table, report, &report->figures[f], steps, &nrows, &ncolumns));
  }
  PetscCall(FigureTableView(&table, nrows, ncolumns, viewer));
  PetscCall(PetscFree2(table.cells, table.values));
  PetscFunctionReturn(0);
}

/* Prints the reactions of the symmetry planes in one line. The name of a body stands before those of its planes. */
static PetscErrorCode FiguresViewPlanes(const RunReport *report, PetscViewer viewer)
{
  const RunFigure *before  = NULL;
  PetscInt         nplanes = 0;

  PetscFunctionBegin;
  for (PetscInt f = 0; f < report->nfigures; ++f) {
    const RunFigure *figure = &report->figures[f];
    const size_t     n      = strcspn(figure->name, ".") + 1; /* the body's name and the point */
    char             value[32];

    if (figure->owner != FIGURE_OF_PLANE || ++nplanes > FIGURE_ROWS) continue;
    if (!before) PetscCall(PetscViewerASCIIPrintf(viewer, "  symmetry reactions"));
    if (!before || strncmp(before->name, figure->name, n))
      PetscCall(PetscViewerASCIIPrintf(viewer, "%s %.*s:", before ? ";" : "", (int)n - 1, figure->name));
    else PetscCall(PetscViewerASCIIPrintf(viewer, ","));
    (void)snprintf(value, sizeof(value), "%.5g", (double)figure->value);
    PetscCall(PetscViewerASCIIPrintf(viewer, " %s %s", figure->name + n, value));
    before = figure;
  }
  if (nplanes > FIGURE_ROWS)
    PetscCall(PetscViewerASCIIPrintf(viewer, "; and %" PetscInt_FMT " others;", nplanes - FIGURE_ROWS));
  if (before) PetscCall(PetscViewerASCIIPrintf(viewer, "%s%s\n", before->unit[0] ? " " : "", before->unit));
  PetscFunctionReturn(0);
}

/* Prints the largest values of the load steps that converged, and begins the last line with the error */
PetscErrorCode ReportViewFigures(const RunReport *report, PetscViewer viewer)
{
  const char *const bodies[FIGURE_OWNERS] = {[FIGURE_OF_BODY] = "body"},
                    *forces[FIGURE_OWNERS] =
                      {[FIGURE_OF_PAIR] = "pair", [FIGURE_OF_FACE] = "face", [FIGURE_OF_BOLT] = "bolt"};
  PetscInt  n = 0;
  PetscBool steps;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) n += report->steps[s].converged;
  steps = (PetscBool)(n > 1);
  PetscCall(FiguresViewTable(report, bodies, steps, viewer));
  PetscCall(FiguresViewTable(report, forces, steps, viewer));
  PetscCall(FiguresViewPlanes(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  "));
  for (PetscInt f = 0; f < report->nfigures; ++f) {
    const RunFigure *figure = &report->figures[f];

    if (figure->owner != FIGURE_OF_STRESSED_MODEL) continue;
    PetscCall(PetscViewerASCIIPrintf(viewer, "%s: %.3g %s", figure->quantity, (double)figure->value, figure->unit));
    if (steps) PetscCall(PetscViewerASCIIPrintf(viewer, " in load step %" PetscInt_FMT, figure->step));
    PetscCall(PetscViewerASCIIPrintf(viewer, "; "));
  }
  PetscFunctionReturn(0);
}
