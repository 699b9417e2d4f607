/*
   Bodies from Gmsh files.
*/
#ifndef GMSHIMPL_H
#define GMSHIMPL_H

#include "src/mesh/query/queryimpl.h"
#include <stdio.h>

/* stream.c: reads a Gmsh file and checks it. The first error is stored as a message */
#define GMSH_WORD 256

typedef struct {
  FILE      *file;
  PetscInt64 size; /* size of the file [bytes]; no count can be larger */
  int        version, width;
  PetscBool  binary, swapped;
  char      *sentence;
  size_t     length;
} GmshStream;

PETSC_INTERN void GmshError(GmshStream *, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
#define GmshWrong(...) (GmshError(__VA_ARGS__), PETSC_FALSE)

/* Reads a word and one blank after it; the name of the next section, skipping comments */
PETSC_INTERN PetscBool GmshGetWord(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshGetSection(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshExpect(GmshStream *, const char section[], const char word[]);
PETSC_INTERN PetscBool GmshExpectNext(GmshStream *, const char section[]);
PETSC_INTERN PetscBool GmshGetBytes(GmshStream *, size_t n, void *value);
/* Reads n integers of 4 or 8 bytes; n finite reals; n counts; a count that format 2 writes as text even in binary
   files */
PETSC_INTERN PetscBool GmshGetNumbers(GmshStream *, int width, PetscInt64 n, PetscInt64 values[]);
PETSC_INTERN PetscBool GmshGetReals(GmshStream *, PetscInt64 n, PetscReal values[]);
PETSC_INTERN PetscBool GmshGetCounts(GmshStream *, const char what[], PetscInt64 n, PetscInt64 counts[]);
PETSC_INTERN PetscBool GmshGetCountWord(GmshStream *, const char what[], PetscInt64 *count);

/* types.c: properties of an element type, by Gmsh's number */
#define GMSH_MAX_NODES 27

typedef struct {
  const char *name;
  PetscInt64  dim, nnodes, ncorners; /* the corners are the first of its nodes */
} GmshType;

PETSC_INTERN const GmshType *GmshGetType(PetscInt64 type);

/* facets.c: sides of cells: the corners in ascending order, and the one opposite the first; of triangles the first
   node is -1, and there is none opposite */
typedef struct {
  PetscInt   nodes[4], across;
  PetscInt64 element;
} GmshFacet;

/* The sides whose smallest node belongs to one of several slices of the numbers; all at once would need more memory
   than the mesh */
typedef struct {
  PetscInt   slice, nslices;
  PetscInt64 n, max;
  GmshFacet *list;
} GmshFacets;

/* Starts with the first slice, for a mesh with nelements; moves to the next slice, returns whether there is one */
PETSC_INTERN void      GmshFacetsBegin(GmshFacets *, PetscInt nelements);
PETSC_INTERN PetscBool GmshFacetsNext(GmshFacets *);

PETSC_INTERN PetscErrorCode GmshFacetsAdd(const GmshType *, PetscInt64 element, const PetscInt64 nodes[], GmshFacets *);
PETSC_INTERN void           GmshFacetsSort(GmshFacets *);
PETSC_INTERN PetscBool      GmshFacetsAgree(const GmshFacets *, GmshStream *);
PETSC_INTERN PetscBool      GmshFacetsBound(const GmshFacets *, PetscInt ncorners, const PetscInt64 corners[]);
PETSC_INTERN PetscErrorCode GmshFacetsDestroy(GmshFacets *);

/* read.c: the mesh of a file. Not collective; errors of format and numbers are returned as a message, "" if there is
   none */
typedef struct {
  const GmshType *type;
  PetscInt   label, first; /* label: tags[label] is the number of its physical tags, which follow; first: its nodes are
                            nodes[first], ... */
  PetscInt64 number;       /* its number in the file */
} GmshElement;

typedef struct {
  PetscInt     dim;                     /* largest dimension of its elements */
  PetscInt     nnodes, *number, *place; /* numbers of the nodes, ascending, and their positions among the coordinates */
  PetscReal   *x;
  PetscInt     nelements, *tags, *nodes;
  GmshElement *elements;
} GmshMesh;

PETSC_INTERN PetscErrorCode GmshMeshRead(const char file[], GmshMesh *, size_t length, char sentence[]);
PETSC_INTERN PetscErrorCode GmshMeshDestroy(GmshMesh *);
PETSC_INTERN PetscBool      GmshMeshHasTag(const GmshMesh *, const GmshElement *, PetscInt tag);
PETSC_INTERN PetscErrorCode GmshMeshFindNode(const GmshMesh *, PetscInt number, PetscInt *place);

/* convert.c: files of other formats become temporary Gmsh files, which all bodies of a file share. Collective */
PETSC_INTERN PetscErrorCode GmshConvert(MPI_Comm, PetscInt nbodies, SceneBody bodies[]);
PETSC_INTERN PetscErrorCode GmshRemoveConverted(SceneBody *);
/* The Gmsh file that holds a body */
static inline const char *GmshPath(const SceneBody *body)
{
  return body->gmsh.converted ? body->gmsh.converted : body->gmsh.file;
}

/* names.c, collective. Names in the order of the file, like those of surfaces from MeshGetFaceNames(); tags may be
   NULL */
PETSC_INTERN PetscErrorCode GmshGetPhysicalNames(MPI_Comm, const SceneBody *, PetscInt dim, PetscInt *n, char ***names,
  PetscInt **tags);
/* Error if the file has no physical volume of the body's name */
PETSC_INTERN PetscErrorCode GmshGetVolumeTag(MPI_Comm, const SceneBody *, PetscInt *tag);

/* order2.c: the 27 nodes of a hexahedron or the 10 of a tetrahedron from the nodes in the file; returns the largest
   distance from the straight cell [length] */
PETSC_INTERN const PetscInt GmshHexahedronEnds[20][2];
PETSC_INTERN PetscReal      GmshGetCurve(PetscInt nnodes, const PetscReal x[][3], PetscReal curve[]);

/* curved_edges.c: curves for a grid of straight cells on a curved surface */
PETSC_INTERN PetscErrorCode ShapeGridProject(ShapeGrid *);

/* file.c: a Gmsh file, read on rank 0; successive bodies from the same file share it */
typedef struct {
  const char *name;
  GmshMesh    mesh; /* has no elements on other ranks */
} GmshFile;
PETSC_INTERN PetscErrorCode GmshFileOpen(MPI_Comm, const SceneBody *, GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileClose(GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileGetGrid(MPI_Comm, GmshFile *, const SceneBody *, ShapeGrid *);

#endif
