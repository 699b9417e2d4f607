/*
   Bodies from Gmsh files.
*/
#ifndef GMSHIMPL_H
#define GMSHIMPL_H

#include "src/mesh/query/queryimpl.h"
#include <stdio.h>

/* stream.c: reads a Gmsh file and checks it. The first error found leaves a message */
#define GMSH_WORD 256

typedef struct {
  FILE      *file;
  PetscInt64 size; /* of the file [bytes]: no count in it can be larger */
  int        version, width;
  PetscBool  binary, swapped;
  char      *sentence;
  size_t     length;
} GmshStream;

PETSC_INTERN void GmshComplain(GmshStream *, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
#define GmshWrong(...) (GmshComplain(__VA_ARGS__), PETSC_FALSE)

/* A word and the one blank after it; the name of the next section, past comments */
PETSC_INTERN PetscBool GmshGetWord(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshGetSection(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshExpect(GmshStream *, const char section[], const char word[]);
PETSC_INTERN PetscBool GmshExpectNext(GmshStream *, const char section[]);
PETSC_INTERN PetscBool GmshGetBytes(GmshStream *, size_t n, void *value);
/* n whole numbers of 4 or 8 bytes; n finite reals; n counts; a count that format 2 writes as a word, also in binary
   files */
PETSC_INTERN PetscBool GmshGetNumbers(GmshStream *, int width, PetscInt64 n, PetscInt64 values[]);
PETSC_INTERN PetscBool GmshGetReals(GmshStream *, PetscInt64 n, PetscReal values[]);
PETSC_INTERN PetscBool GmshGetCounts(GmshStream *, const char what[], PetscInt64 n, PetscInt64 counts[]);
PETSC_INTERN PetscBool GmshGetCountWord(GmshStream *, const char what[], PetscInt64 *count);

/* types.c: what an element is, by Gmsh's number of its type */
#define GMSH_MAX_NODES 27

typedef struct {
  const char *name;
  PetscInt64  dim, nnodes, ncorners; /* the corners are the first of its nodes */
} GmshType;

PETSC_INTERN const GmshType *GmshGetType(PetscInt64 type);

/* facets.c: quadrilaterals of cells: the corners in ascending order, and the one across from the first;
   triangles of tetrahedra: first -1, and none across */
typedef struct {
  PetscInt   nodes[4], across;
  PetscInt64 element;
} GmshFacet;

/* Those whose least node falls to one slice of several: all at once they would take more memory than the mesh they
   are of */
typedef struct {
  PetscInt   slice, nslices;
  PetscInt64 n, max;
  GmshFacet *list;
} GmshFacets;

/* None yet, of the first slice, of a mesh of so many elements; of the next slice, if there is one */
PETSC_INTERN void      GmshFacetsBegin(GmshFacets *, PetscInt nelements);
PETSC_INTERN PetscBool GmshFacetsNext(GmshFacets *);

PETSC_INTERN PetscErrorCode GmshFacetsAdd(const GmshType *, PetscInt64 element, const PetscInt64 nodes[], GmshFacets *);
PETSC_INTERN void           GmshFacetsSort(GmshFacets *);
PETSC_INTERN PetscBool      GmshFacetsAgree(const GmshFacets *, GmshStream *);
PETSC_INTERN PetscBool      GmshFacetsBound(const GmshFacets *, PetscInt ncorners, const PetscInt64 corners[]);
PETSC_INTERN PetscErrorCode GmshFacetsDestroy(GmshFacets *);

/* read.c: the mesh of a file. Not collective; what is wrong with its form and numbers, in a sentence of so many
   characters, or "" */
typedef struct {
  const GmshType *type;
  PetscInt label, first; /* its number of physical tags and they follow one another from tags[label] on; its nodes from
                            nodes[first] */
  PetscInt64 number;     /* in the file */
} GmshElement;

typedef struct {
  PetscInt     dim;                     /* the largest of its elements */
  PetscInt     nnodes, *number, *place; /* numbers of the nodes, ascending, and which of the coordinates are theirs */
  PetscReal   *x;
  PetscInt     nelements, *tags, *nodes;
  GmshElement *elements;
} GmshMesh;

PETSC_INTERN PetscErrorCode GmshMeshRead(const char file[], GmshMesh *, size_t length, char sentence[]);
PETSC_INTERN PetscErrorCode GmshMeshDestroy(GmshMesh *);
PETSC_INTERN PetscBool      GmshMeshHasTag(const GmshMesh *, const GmshElement *, PetscInt tag);
PETSC_INTERN PetscErrorCode GmshMeshFindNode(const GmshMesh *, PetscInt number, PetscInt *place);

/* names.c, collective. Names are in the order of the file, as MeshGetFaceNames() gives those of surfaces; tags
   may be NULL */
PETSC_INTERN PetscErrorCode GmshGetPhysicalNames(MPI_Comm, const SceneBody *, PetscInt dim, PetscInt *n, char ***names,
  PetscInt **tags);
/* Error if the file has no physical volume of the body's name */
PETSC_INTERN PetscErrorCode GmshGetVolumeTag(MPI_Comm, const SceneBody *, PetscInt *tag);

/* order2.c: the 27 places of a hexahedron, or 10 of a tetrahedron, from as many nodes as it has; the largest
   distance from the straight cell of its corners [length] */
PETSC_INTERN const PetscInt GmshHexahedronEnds[20][2];
PETSC_INTERN PetscReal      GmshGetCurve(PetscInt nnodes, const PetscReal x[][3], PetscReal curve[]);

/* curved_edges.c: a curve for a grid of straight cells whose surface stands for a curved one */
PETSC_INTERN PetscErrorCode ShapeGridBend(ShapeGrid *);

/* file.c: a Gmsh file, read on rank 0; bodies that come from one file one after another share it */
typedef struct {
  const char *name;
  GmshMesh    mesh; /* without elements on the other ranks */
} GmshFile;
PETSC_INTERN PetscErrorCode GmshFileOpen(MPI_Comm, const SceneBody *, GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileClose(GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileGetGrid(MPI_Comm, GmshFile *, const SceneBody *, ShapeGrid *);

#endif
