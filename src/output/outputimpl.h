/*
   The map of src/output: its files in the order in which they build on one another, each with what it offers to those
   below it. The fields of bodies and surfaces go to HDF5 (output.c), the report of a run to JSON and to the terminal
   (json.c, view.c).
*/
#ifndef OUTPUTIMPL_H
#define OUTPUTIMPL_H

#include <output.h>
#include <petsccompat.h>
#include "src/files/filesimpl.h"

/* A step that has been written */
typedef struct {
  PetscInt  step;
  PetscReal time;
} OutputStep;

struct _n_Output {
  MPI_Comm comm;
  DM       dm;
  char    *base; /* of the file names */
  int      lock; /* descriptor of the lock on the mesh's file */
  PetscInt nbodies;
  char   **bodynames;
  char    *units;  /* the scene's note; NULL: none */
  PetscInt npairs; /* of contact, that have fields of their own; of the steps written */
  char   **pairnames;
  PetscInt nvertices, ncells; /* global */
  PetscInt nowned, ncellslocal,
    first;         /* nodes and cells of this rank; number of its first node. A hexahedron of order 2 counts as 8 */
  PetscBool mixed; /* not all cells are hexahedra */
  PetscInt  nindices,
    nindiceslocal; /* numbers that describe the cells: 8 nodes each, or where they are mixed the kind and its nodes */
  PetscBool   friction;    /* the steps have shear and slip */
  PetscBool   nodes;       /* the steps have stress at nodes and strain energy */
  PetscInt    nquadrature; /* quadrature points of all ranks, of the steps that have stress there */
  PetscBool   meshed;      /* the mesh has been written */
  PetscBool   begun;       /* a step has been written */
  PetscInt    continued;   /* load steps of the run that this one goes on with; 0: none */
  PetscInt    nsteps, maxsteps;
  OutputStep *steps;
};

/* names.c */
PETSC_INTERN PetscErrorCode OutputCheckBase(MPI_Comm, const char base[]);
PETSC_INTERN PetscErrorCode OutputGetMeshFile(Output, char file[], size_t length);
PETSC_INTERN PetscErrorCode OutputGetStepFile(Output, PetscInt step, char file[], size_t length);

/* cells.c: a cell of the mesh as a hexahedron of 8 nodes, or those that the nodes of order 2 cut it into; or as a
   tetrahedron of 4 or 10 */
typedef struct {
  PetscInt n, nnodes, nodes[8][10];
} OutputPieces;
PETSC_INTERN PetscErrorCode OutputCountPieces(Output);
PETSC_INTERN PetscErrorCode OutputGetPieces(Output, PetscInt cell, OutputPieces *);
PETSC_INTERN const char    *OutputCellsName(Output);
PETSC_INTERN PetscInt       OutputPieceKind(PetscInt nnodes);
PETSC_INTERN PetscInt       OutputKindNodes(PetscInt kind);

/* stress.c: of what a state does not have nothing is written */
PETSC_INTERN PetscErrorCode StressWriteCells(Output, const StepState *, PetscViewer);
PETSC_INTERN PetscErrorCode StressWriteNodes(Output, const StepState *, PetscViewer);
PETSC_INTERN PetscErrorCode StressWriteQuadrature(Output, const StepState *, PetscViewer);

/* layout.c: an output that only knows its mesh */
PETSC_INTERN PetscErrorCode OutputCreateMesh(DM, Output *);

/* fields.c: the mesh of an output into an open file, its nodes on this rank with their bodies; its files */
PETSC_INTERN PetscErrorCode FieldsGetVertices(Output, Vec *vertices, PetscInt body[]);
PETSC_INTERN PetscErrorCode FieldsWriteMesh(PetscViewer, void *output);
PETSC_INTERN PetscErrorCode OutputWriteMesh(Output);
PETSC_INTERN PetscErrorCode OutputWriteFields(Output, const StepState *);

/* xdmf.c */
PETSC_INTERN PetscErrorCode OutputWriteXDMF(Output);

/* history.c: <base>.csv, one line a load step */
PETSC_INTERN PetscErrorCode OutputWriteHistory(Output, const StepReport *);

/* output.c, on top of these, has no more than what output.h offers */

/* schema.c */

/* How a member of a report is stored */
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
  FIELD_BODY_INTS,  /* PetscInt *, one a body */
  FIELD_BODY_REALS, /* PetscReal *, one a body; NULL: not known */
  FIELD_LIST,       /* an array of records, counted */
  FIELD_RECORD,
  FIELD_POINTER, /* to a record; NULL: there is none */
} ReportType;

/* The tables for people. TABLE_EVERY: all those of load steps; the fallbacks make a sentence, the phases a row each */
typedef enum {
  TABLE_NONE,
  TABLE_EVERY,
  TABLE_WORK,
  TABLE_FORCES,
  TABLE_PAIRS,
  TABLE_FACES,
  TABLE_RIGID,
  TABLE_BALANCE,
  TABLE_TRUTH,
  TABLE_FALLBACKS,
  TABLE_ERRORS,
  TABLE_LEVELS,
  TABLE_PHASES,
  TABLE_EFFECTS
} ReportTable;

/* What a column shows of its field */
typedef enum {
  SHOWN_VALUE,
  SHOWN_SUM, /* of FIELD_INTS */
  SHOWN_MEAN,
  SHOWN_SQUARE,
  SHOWN_PERCENT,
  SHOWN_SHARE /* of the total time, in per cent */
} ReportShown;

typedef struct {
  ReportTable table;
  const char *head[2]; /* one above the other */
  int         width;   /* in characters; negative: to the left; 0: as wide as what it says */
  int         blanks;  /* before it, beyond the one that every column has */
  const char *format;  /* of a double, NULL: that of its type; of a FIELD_BOOL the word that says it is true */
  ReportShown shown;
  PetscBool   with_unit; /* in the heading */
  PetscBool   behind;    /* printed behind the other columns of its table */
} ReportColumn;

typedef struct _n_ReportRecord ReportRecord;

typedef struct {
  const char         *name; /* its key; NULL ends a list of fields */
  const char         *unit; /* in the scene's own units of force and length, seconds, bytes; "": a number */
  ReportType          type;
  size_t              offset, count;
  const ReportRecord *record;     /* of a list or a record */
  const char         *absent;     /* what a table says for NaN, or for false; "": nothing at all; NULL: the number */
  ReportColumn        columns[2]; /* in the tables; the summary has every field */
} ReportField;

struct _n_ReportRecord {
  size_t             size;
  PetscBool          one_line; /* of the summary */
  const ReportField *fields;
};

PETSC_INTERN const ReportRecord SchemaRun, SchemaSteps, SchemaPairs, SchemaFaces, SchemaRigid, SchemaFallbacks,
  SchemaTimes, SchemaLevels, SchemaEffects, SchemaLines;
PETSC_INTERN const void *SchemaAt(const ReportField *, const void *record);
PETSC_INTERN double      SchemaNumber(const ReportField *, const void *record);
PETSC_INTERN const char *SchemaText(const ReportField *, const void *record);
PETSC_INTERN PetscInt    SchemaCount(const ReportField *, const void *record);

/* table.c */
PETSC_INTERN PetscErrorCode TableViewHead(const RunReport *, ReportTable, const ReportRecord *, PetscInt line,
  PetscViewer);
PETSC_INTERN PetscErrorCode TableViewRows(const RunReport *, ReportTable, const ReportRecord *, PetscInt n,
  const void *records, PetscViewer);
PETSC_INTERN const char    *TableGetText(const RunReport *, ReportTable, const ReportField *, const void *record,
     char text[], size_t length);

/* json.c, accuracy.c, view.c have no more than what output.h offers */

#endif
