/*
   src/output: files in the order in which they depend on each other, with what they offer. Fields of bodies and
   surfaces are written to HDF5 (output.c); the report is written to JSON and printed (json.c, view.c).
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
  char    *base; /* base name of the files */
  int      lock; /* descriptor of the lock on the mesh's file */
  PetscInt nbodies;
  char   **bodynames;
  char    *units;  /* units of the scene; NULL: none */
  PetscInt npairs; /* number of contact pairs with fields of their own */
  char   **pairnames;
  PetscInt nvertices, ncells; /* global */
  PetscInt nowned, ncellslocal,
    first;         /* nodes and cells of this rank (a hexahedron of order 2 counts as 8), and its first node */
  PetscBool mixed; /* there are other cells than hexahedra */
  PetscInt  nindices,
    nindiceslocal;         /* number of integers that describe the cells: 8 nodes each, or in mixed files a kind and its
                      nodes */
  PetscBool   moving;      /* the velocity is written */
  PetscBool   friction;    /* friction stress and slip are written */
  PetscBool   plastic;     /* plastic strain is written */
  PetscBool   nodes;       /* nodal stress and strain energy are written */
  PetscInt    nquadrature; /* quadrature points on all ranks, in steps with stress there */
  PetscBool   meshed;      /* the mesh has been written */
  PetscBool   begun;       /* a load step has been written */
  PetscInt    continued;   /* load steps of the earlier run that is continued; 0: none */
  PetscInt    nsteps, maxsteps;
  OutputStep *steps;
};

/* names.c */
PETSC_INTERN PetscErrorCode OutputCheckBase(MPI_Comm, const char base[]);
PETSC_INTERN PetscErrorCode OutputGetMeshFile(Output, char file[], size_t length);
PETSC_INTERN PetscErrorCode OutputGetStepFile(Output, PetscInt step, char file[], size_t length);

/* cells.c: a cell as pieces for VTK: a hexahedron with 8 nodes, or those into which nodes of order 2 divide it; or a
   tetrahedron with 4 or 10 nodes */
typedef struct {
  PetscInt n, nnodes, nodes[8][10];
} OutputPieces;
PETSC_INTERN PetscErrorCode OutputCountPieces(Output);
PETSC_INTERN PetscErrorCode OutputGetPieces(Output, PetscInt cell, OutputPieces *);
PETSC_INTERN const char    *OutputCellsName(Output);
PETSC_INTERN PetscInt       OutputPieceKind(PetscInt nnodes);
PETSC_INTERN PetscInt       OutputKindNodes(PetscInt kind);

/* stress.c: fields that the state does not have are not written */
PETSC_INTERN PetscErrorCode StressWriteCells(Output, const StepState *, PetscViewer);
PETSC_INTERN PetscErrorCode StressWriteNodes(Output, const StepState *, PetscViewer);
PETSC_INTERN PetscErrorCode StressWriteQuadrature(Output, const StepState *, PetscViewer);

/* layout.c: creates an output that only has its mesh */
PETSC_INTERN PetscErrorCode OutputCreateMesh(DM, Output *);

/* fields.c: writes the mesh and the fields of a step; gets the nodes on this rank and their bodies */
PETSC_INTERN PetscErrorCode FieldsGetVertices(Output, Vec *vertices, PetscInt body[]);
PETSC_INTERN PetscErrorCode FieldsWriteMesh(PetscViewer, void *output);
PETSC_INTERN PetscErrorCode OutputWriteMesh(Output);
PETSC_INTERN PetscErrorCode OutputWriteFields(Output, const StepState *);

/* xdmf.c */
PETSC_INTERN PetscErrorCode OutputWriteXDMF(Output);

/* history.c: <base>.csv, a row per load step */
PETSC_INTERN PetscErrorCode OutputWriteHistory(Output, const StepReport *);

/* output.c: only public functions */

/* schema.c */

/* Type of a report's member */
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
  FIELD_BODY_REALS, /* PetscReal *, one per body; NULL: unknown */
  FIELD_LIST,       /* an array of records, counted */
  FIELD_RECORD,
  FIELD_POINTER, /* pointer to a record; NULL: none */
} ReportType;

/* The printed tables. TABLE_EVERY: all tables of load steps; the fallbacks form a sentence, the phases a row each */
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
  SHOWN_SHARE /* percentage of the total time */
} ReportShown;

typedef struct {
  ReportTable table;
  const char *head[2]; /* heading, two lines */
  int         width;   /* in characters; negative: left-aligned; 0: as wide as its text */
  int         blanks;  /* extra blanks before it, in addition to the one before every column */
  const char *format;  /* format of a double, NULL: default of its type; for a FIELD_BOOL the word printed if true */
  ReportShown shown;
  PetscBool   with_unit; /* unit in the heading */
  PetscBool   behind;    /* printed after the other columns of its table */
} ReportColumn;

typedef struct _n_ReportRecord ReportRecord;

typedef struct {
  const char         *name; /* its key; NULL ends a list of fields */
  const char         *unit; /* in the scene's units of force and length, seconds, bytes; "": dimensionless */
  ReportType          type;
  size_t              offset, count;
  const ReportRecord *record;     /* record type of a list or record */
  const char         *absent;     /* text in tables for NaN or false; "": empty; NULL: the number */
  ReportColumn        columns[2]; /* columns in the tables; the summary has every field */
} ReportField;

struct _n_ReportRecord {
  size_t             size;
  PetscBool          one_line; /* of the summary: on one line */
  const ReportField *fields;
};

PETSC_INTERN const ReportRecord SchemaRun, SchemaSteps, SchemaPairs, SchemaFaces, SchemaRigid, SchemaBolts,
  SchemaConnectors, SchemaFallbacks, SchemaTimes, SchemaLevels, SchemaEffects, SchemaLines;
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

/* json.c, accuracy.c, view.c: only public functions */

#endif
