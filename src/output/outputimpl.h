/*
   Declarations that the files of src/output share. The files are listed such that each depends only on those before it.
   Fields of bodies and surfaces are written to HDF5 (output.c). The report is written as JSON (json.c) and printed
   (print_report.c).
*/
#ifndef OUTPUTIMPL_H
#define OUTPUTIMPL_H

#include <output.h>
#include <petsccompat.h>
#include "src/files/filesimpl.h"

/* Load step whose results have been written. */
typedef struct {
  PetscInt  step;
  PetscReal time;
} OutputStep;

struct _n_Output {
  MPI_Comm  comm;
  DM        dm;
  char     *base; /* folder and first part of the names of all files */
  int       lock; /* descriptor of the lock on the mesh file, see LockFileBegin() */
  PetscInt  nbodies;
  char    **bodynames;
  char    **surfaces; /* of each body: the rigid surface that its cell stands for; NULL: none */
  PetscBool hides;    /* true if any body is a rigid surface, whose cell is not among the written ones */
  char     *units;    /* units of the scene; NULL if the scene does not state them */
  PetscInt  npairs;   /* number of contact pairs that have fields of their own; 0 if there are fewer than two pairs */
  char    **pairnames;
  PetscInt  nvertices, ncells; /* number of nodes and of cells on all ranks */
  PetscInt  nowned, ncellslocal,
    first;         /* number of nodes and of cells on this rank, and global number of its first node; a hexahedron of
                      order 2 counts as 8 cells */
  PetscBool mixed; /* true if any rank has other cells than hexahedra */
  PetscInt  nindices,
    nindiceslocal;         /* number of integers that describe the cells on all ranks and on this rank: the 8 nodes
                              of each cell, or in a mixed mesh the kind and the nodes of each cell */
  PetscBool   moving;      /* true if the velocity is written */
  PetscBool   friction;    /* true if friction force and slip are written */
  PetscBool   plastic;     /* true if plastic strain is written */
  PetscBool   nodes;       /* true if stress and strain energy at nodes are written */
  PetscInt    nquadrature; /* number of quadrature points on all ranks; 0 if no stress is written at quadrature
                              points */
  PetscBool   meshed;      /* true after the mesh has been written */
  PetscBool   begun;       /* true after a load step has been written */
  PetscInt    continued;   /* number of load steps of the earlier run that this run continues; 0 if there is no
                              earlier run */
  PetscInt    every;       /* fields are kept of each load step whose number is a multiple of it, and of the last one;
                              0: of the last one */
  PetscInt    nsteps, maxsteps;
  OutputStep *steps;
};

/* names.c: determines the names of the files */
PETSC_INTERN PetscErrorCode OutputCheckBase(MPI_Comm, const char base[]);
PETSC_INTERN PetscErrorCode OutputGetMeshFile(Output, char file[], size_t length);
PETSC_INTERN PetscErrorCode OutputGetStepFile(Output, PetscInt step, char file[], size_t length);

/*
   cells.c: divides cells into pieces that VTK can draw. A piece is a tetrahedron with 4 or 10 nodes or a hexahedron
   with 8 nodes; a hexahedron of order 2 has 8 such pieces.
*/
typedef struct {
  PetscInt n, nnodes, nodes[8][10];
} OutputPieces;
PETSC_INTERN PetscErrorCode OutputCountPieces(Output);
PETSC_INTERN PetscErrorCode OutputGetTool(Output, PetscInt cell, PetscInt *body);
PETSC_INTERN PetscErrorCode OutputGetPieces(Output, PetscInt cell, OutputPieces *);
PETSC_INTERN const char    *OutputCellsName(Output);
PETSC_INTERN PetscInt       OutputPieceKind(PetscInt nnodes);
PETSC_INTERN PetscInt       OutputKindNodes(PetscInt kind);

/* stress.c: writes the stress fields of a load step; a field that the StepState does not have is omitted */
PETSC_INTERN PetscErrorCode StressWriteCells(Output, const StepState *, PetscViewer);
PETSC_INTERN PetscErrorCode StressWriteNodes(Output, const StepState *, PetscViewer);
PETSC_INTERN PetscErrorCode StressWriteQuadrature(Output, const StepState *, PetscViewer);

/* layout.c: creates an output that has only its mesh */
PETSC_INTERN PetscErrorCode OutputCreateMesh(DM, Output *);

/*
   hdf5_fields.c: writes the mesh and the fields of a load step; FieldsGetVertices() returns the nodes of this rank and
   their bodies
*/
PETSC_INTERN PetscErrorCode FieldsGetVertices(Output, Vec *vertices, PetscInt body[]);
PETSC_INTERN PetscErrorCode FieldsWriteMesh(PetscViewer, void *output);
PETSC_INTERN PetscErrorCode OutputWriteMesh(Output);
PETSC_INTERN PetscErrorCode OutputWriteFields(Output, const StepState *);

/* xdmf.c: writes the file that ParaView opens */
PETSC_INTERN PetscErrorCode OutputWriteXDMF(Output);

/* history.c: writes <base>.csv with one row per load step */
PETSC_INTERN PetscErrorCode OutputWriteHistory(Output, const StepReport *);

/* output.c: its functions are declared in the public header */

/* schema.c: lists the fields of the reports */

/*
   Type of a member of a report. "Counted" means that another member contains the number of values (see
   ReportField.count).
*/
typedef enum {
  FIELD_INT,        /* PetscInt */
  FIELD_REAL,       /* PetscReal */
  FIELD_DOUBLE,     /* PetscLogDouble */
  FIELD_BOOL,       /* PetscBool */
  FIELD_TEXT,       /* const char * */
  FIELD_CHARS,      /* char[] */
  FIELD_TEXTS,      /* const char **, counted */
  FIELD_VECTOR,     /* PetscReal[3] */
  FIELD_INTS,       /* PetscInt *, counted */
  FIELD_BODY_INTS,  /* PetscInt *, one value per body */
  FIELD_BODY_REALS, /* PetscReal *, one value per body; NULL if they are not known */
  FIELD_LIST,       /* an array of records, counted */
  FIELD_RECORD,
  FIELD_POINTER, /* pointer to a record; NULL if there is none */
} ReportType;

/*
   Tables that are printed. A column in TABLE_EVERY appears in all tables of load steps. TABLE_FALLBACKS is printed as a
   sentence. TABLE_PHASES has one row per phase.
*/
typedef enum {
  TABLE_NONE,
  TABLE_EVERY,
  TABLE_WORK,
  TABLE_FORCES,
  TABLE_PAIRS,
  TABLE_FACES,
  TABLE_RIGID,
  TABLE_BOLTS,
  TABLE_CONNECTORS,
  TABLE_BALANCE,
  TABLE_PLASTICITY,
  TABLE_TRUTH,
  TABLE_FALLBACKS,
  TABLE_ERRORS,
  TABLE_LEVELS,
  TABLE_PHASES
} ReportTable;

/* Number that a column shows for the value of its field. */
typedef enum {
  SHOWN_VALUE,
  SHOWN_SUM, /* sum of the values of a FIELD_INTS; SHOWN_MEAN: their mean */
  SHOWN_MEAN,
  SHOWN_SQUARE,
  SHOWN_PERCENT
} ReportShown;

typedef struct {
  ReportTable table;
  const char *head[2]; /* the two lines of the heading */
  int         width;   /* width in characters; negative: left-aligned; 0: as wide as the text */
  int         blanks;  /* number of blanks before the column, in addition to the one before every column */
  const char *format;  /* format of a double; NULL: default format of the field's type. For a FIELD_BOOL: the word
                          that is printed if the value is true */
  ReportShown shown;
  PetscBool   with_unit; /* true if the unit is printed in the heading */
  PetscBool   behind;    /* true if the column is printed after the other columns of its table */
} ReportColumn;

typedef struct _n_ReportRecord ReportRecord;

typedef struct {
  const char         *name; /* key in the summary; NULL ends a list of fields */
  const char         *unit; /* unit, composed of the scene's units of force and length, seconds and bytes; "":
                               dimensionless */
  ReportType          type;
  size_t              offset, count;
  const ReportRecord *record;     /* type of the records of a list or record; NULL for other fields */
  const char         *absent;     /* text that a table shows for NaN or false; "": empty cell; NULL: the number */
  ReportColumn        columns[2]; /* columns in which tables show the field; the summary contains every field, even
                                     without columns */
} ReportField;

struct _n_ReportRecord {
  size_t             size;
  PetscBool          one_line; /* true if the summary has the record on one line */
  const ReportField *fields;
};

PETSC_INTERN const ReportRecord SchemaRun, SchemaSteps, SchemaPairs, SchemaFaces, SchemaRigid, SchemaBolts,
  SchemaConnectors, SchemaFallbacks, SchemaTimes, SchemaLevels, SchemaLines;
PETSC_INTERN const void *SchemaAt(const ReportField *, const void *record);
PETSC_INTERN double      SchemaNumber(const ReportField *, const void *record);
PETSC_INTERN const char *SchemaText(const ReportField *, const void *record);
PETSC_INTERN PetscInt    SchemaCount(const ReportField *, const void *record);

/* table.c: prints tables with the columns of schema.c */
PETSC_INTERN PetscErrorCode TableViewHead(const RunReport *, ReportTable, const ReportRecord *, PetscInt line,
  PetscViewer);
PETSC_INTERN PetscErrorCode TableViewRows(const RunReport *, ReportTable, const ReportRecord *, PetscInt n,
  const void *records, PetscViewer);
PETSC_INTERN const char *TableGetText(ReportTable, const ReportField *, const void *record, char text[], size_t length);

/* print_figures.c: prints the largest values of a run */
PETSC_INTERN PetscErrorCode ReportViewFigures(const RunReport *, PetscViewer);

/* json.c, accuracy.c, print_report.c: their functions are declared in the public header */

#endif
