/*
   Bodies from Gmsh files.
*/
#ifndef GMSHIMPL_H
#define GMSHIMPL_H

#include "src/mesh/query/queryimpl.h"
#include <stdio.h>

/* stream.c: reads words and numbers of a Gmsh file and checks them. The first error is stored as a message. The
   functions return whether they succeeded. */
#define GMSH_WORD 256

typedef struct {
  FILE      *file;
  PetscInt64 size;            /* size of the file [bytes], which is an upper bound of any count in it */
  int        version, width;  /* format times 10; bytes of an integer that is a count or a number of a node */
  PetscBool  binary, swapped; /* whether the file is binary; whether its byte order differs from that of this machine */
  char      *sentence;        /* message of the first error, and its space */
  size_t     length;
} GmshStream;

PETSC_INTERN void GmshError(GmshStream *, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
#define GmshWrong(...) (GmshError(__VA_ARGS__), PETSC_FALSE)

/* GmshGetWord() reads a word and one blank after it. GmshGetSection() reads the name of the next section and skips
   comments. GmshExpect() checks that a word is the expected section. */
PETSC_INTERN PetscBool GmshGetWord(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshGetSection(GmshStream *, char word[GMSH_WORD]);
PETSC_INTERN PetscBool GmshExpect(GmshStream *, const char section[], const char word[]);
PETSC_INTERN PetscBool GmshExpectNext(GmshStream *, const char section[]);
PETSC_INTERN PetscBool GmshGetBytes(GmshStream *, size_t n, void *value);
/* GmshGetNumbers() reads n integers of `width` bytes, GmshGetReals() n finite reals, GmshGetCounts() n counts, and
   GmshGetCountWord() a count that format 2 writes as text even in binary files. */
PETSC_INTERN PetscBool GmshGetNumbers(GmshStream *, int width, PetscInt64 n, PetscInt64 values[]);
PETSC_INTERN PetscBool GmshGetReals(GmshStream *, PetscInt64 n, PetscReal values[]);
PETSC_INTERN PetscBool GmshGetCounts(GmshStream *, const char what[], PetscInt64 n, PetscInt64 counts[]);
PETSC_INTERN PetscBool GmshGetCountWord(GmshStream *, const char what[], PetscInt64 *count);

/* types.c: properties of an element type, by its number in Gmsh */
#define GMSH_MAX_NODES 27

typedef struct {
  const char *name;
  PetscInt64  dim, nnodes, ncorners; /* dimension, number of nodes, and number of corners, which are the first nodes */
} GmshType;

PETSC_INTERN const GmshType *GmshGetType(PetscInt64 type);

/* facets.c: a side of a cell: its corners in ascending order, and the corner opposite the first one. A triangle has -1
   as its first node, and no opposite corner. */
typedef struct {
  PetscInt   nodes[4], across;
  PetscInt64 element; /* number of the element in the file */
} GmshFacet;

/* The sides whose smallest node belongs to one slice of the node numbers. All sides at once would need more memory than
   the mesh. */
typedef struct {
  PetscInt   slice, nslices; /* present slice, and number of slices */
  PetscInt64 n, max;         /* number of sides, and space for sides */
  GmshFacet *list;
} GmshFacets;

/* GmshFacetsBegin() starts with the first slice, for a mesh with nelements elements. GmshFacetsNext() continues with
   the next slice, and returns whether there is one. */
PETSC_INTERN void      GmshFacetsBegin(GmshFacets *, PetscInt nelements);
PETSC_INTERN PetscBool GmshFacetsNext(GmshFacets *);

PETSC_INTERN PetscErrorCode GmshFacetsAdd(const GmshType *, PetscInt64 element, const PetscInt64 nodes[], GmshFacets *);
PETSC_INTERN void           GmshFacetsSort(GmshFacets *);
PETSC_INTERN PetscBool      GmshFacetsAgree(const GmshFacets *, GmshStream *);
PETSC_INTERN PetscBool      GmshFacetsBound(const GmshFacets *, PetscInt ncorners, const PetscInt64 corners[]);
PETSC_INTERN PetscErrorCode GmshFacetsDestroy(GmshFacets *);

/* read.c: the mesh of a file. Not collective. Errors in the file are returned as a message, which is "" if there is
   none. */
typedef struct {
  const GmshType *type;
  PetscInt   label, first; /* tags[label] is the number of the element's physical tags, which follow; nodes[first] is
                              its first node */
  PetscInt64 number;       /* number of the element in the file */
} GmshElement;

typedef struct {
  PetscInt     dim;                      /* largest dimension of the elements */
  PetscInt     nnodes, *number, *place;  /* [nnodes] numbers of the nodes, ascending, and their positions among the
                                           coordinates */
  PetscReal   *x;                        /* [3 nnodes] coordinates [length] */
  PetscInt     nelements, *tags, *nodes; /* number of elements; tags and nodes of all elements */
  GmshElement *elements;
} GmshMesh;

PETSC_INTERN PetscErrorCode GmshMeshRead(const char file[], GmshMesh *, size_t length, char sentence[]);
PETSC_INTERN PetscErrorCode GmshMeshDestroy(GmshMesh *);
PETSC_INTERN PetscBool      GmshMeshHasTag(const GmshMesh *, const GmshElement *, PetscInt tag);
PETSC_INTERN PetscErrorCode GmshMeshFindNode(const GmshMesh *, PetscInt number, PetscInt *place);

/* convert.c: collective. Converts files of other formats into temporary Gmsh files. All bodies from one file share its
   conversion. */
PETSC_INTERN PetscErrorCode GmshConvert(MPI_Comm, PetscInt nbodies, SceneBody bodies[]);
PETSC_INTERN PetscErrorCode GmshRemoveConverted(SceneBody *);
/* Returns the name of the Gmsh file that contains a body */
static inline const char *GmshPath(const SceneBody *body)
{
  return body->gmsh.converted ? body->gmsh.converted : body->gmsh.file;
}

/* names.c: collective. GmshGetPhysicalNames() gets the physical names of one dimension in the order of the file, which
   is also the order of MeshGetFaceNames(). tags may be NULL. */
PETSC_INTERN PetscErrorCode GmshGetPhysicalNames(MPI_Comm, const SceneBody *, PetscInt dim, PetscInt *n, char ***names,
  PetscInt **tags);
/* Gets the tag of the body's volume. It is an error if the file has no physical volume with this name. */
PETSC_INTERN PetscErrorCode GmshGetVolumeTag(MPI_Comm, const SceneBody *, PetscInt *tag);

/* order2.c: computes the 27 nodes of a hexahedron, or the 10 nodes of a tetrahedron, from the nodes in the file.
   Returns the largest distance of a node from the straight cell [length]. */
PETSC_INTERN const PetscInt GmshHexahedronEnds[20][2];
PETSC_INTERN PetscReal      GmshGetCurve(PetscInt nnodes, const PetscReal x[][3], PetscReal curve[]);

/* curved_edges.c: computes curves for a grid of straight cells on a curved surface */
PETSC_INTERN PetscErrorCode ShapeGridProject(ShapeGrid *);

/* file.c: a Gmsh file that was read on rank 0. Successive bodies from one file share it. */
typedef struct {
  const char *name;
  GmshMesh    mesh; /* the mesh; it has no elements on other ranks */
} GmshFile;
PETSC_INTERN PetscErrorCode GmshFileOpen(MPI_Comm, const SceneBody *, GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileClose(GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileGetGrid(MPI_Comm, GmshFile *, const SceneBody *, ShapeGrid *);

#endif
