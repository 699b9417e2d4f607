/*
   Mesh, private: the map of src/mesh. From the shapes to the mesh, every file builds on those before it.
*/
#ifndef MESHIMPL_H
#define MESHIMPL_H

#include <mesh.h>
#include <petsccompat.h>
#include <rankerror.h>
#include <stdio.h>

/*
   grid.c: level 0 meshes of single bodies, made on one rank: hexahedra, or tetrahedra where a file has them.

   The vertices of a mesh are refined in a shape's parameters, where its cells are straight, and mapped to space at
   the end: so refinement follows curved surfaces on every level without any communication. A body whose facets are to
   stay is mapped at level 0.
*/
typedef struct {
  PetscInt   ncells, nvertices, nfacets;
  PetscInt   ncorners; /* of a cell: 8 of hexahedra, 4 of tetrahedra */
  PetscInt  *cells; /* ncorners vertices a cell, of hexahedra in tensor order: vertex i + 2 j + 4 k lies at the corner
                         (i, j, k) */
  PetscReal *coordinates; /* 3 parameters a vertex; for a shape without a map, its place [length] */
  PetscInt  *facets;      /* 4 vertices a facet, the last of a triangle's twice */
  PetscInt  *facetface;   /* index of each facet's face in the names that MeshGetFaceNames() gives */
  PetscReal *curve; /* 27 places a cell, tensor order, or 10, of the quadratic cell that refinement follows; NULL: it
                       has straight edges */
} ShapeGrid;

PETSC_INTERN PetscErrorCode ShapeGridDestroy(ShapeGrid *);

/* A block of n[0] x n[1] x n[2] cells. faces: of the sides at the begin and the end of each direction, or
   PETSC_DECIDE inside the body */
typedef struct {
  PetscInt    n[3], faces[6];
  const void *context;
  PetscInt (*vertex)(const void *context, PetscInt i, PetscInt j, PetscInt k);
} ShapeBlock;

/* Allocates a grid of blocks and fills all but its coordinates; mirrored: the map turns right-handed cells
   left-handed */
PETSC_INTERN PetscErrorCode ShapeGridCreate(PetscInt nblocks, const ShapeBlock[], PetscInt nvertices,
  PetscBool mirrored, ShapeGrid *);
/* Place in [0, 1] of vertex i of n cells, the last `grading` times as large as the first (0: 1): `even` (0: 1) equal
   ones at the fine end, from there on growing geometrically */
PETSC_INTERN PetscReal ShapeGraded(PetscReal grading, PetscInt even, PetscInt n, PetscInt i);
/* Errors: a count that is not positive; a count or total too large; a grading that is not positive, or has more even
   cells than there are */
PETSC_INTERN PetscErrorCode ShapeCheckCount(MPI_Comm, const SceneBody *, const char what[], PetscInt count);
PETSC_INTERN PetscErrorCode ShapeCheckTotal(MPI_Comm, const SceneBody *, PetscReal nvertices);
PETSC_INTERN PetscErrorCode ShapeCheckGrading(MPI_Comm, const SceneBody *, PetscReal grading, PetscInt even,
  PetscInt n);

/*
   box.c, tube_arc.c, half_ellipse.c, sphere_shell.c, spheroid_shell.c, ball.c: the shapes.

   A new shape is one file with a Shape, one line in shape.c, and its keys in src/scene/sections/shapes.c.
*/
typedef struct {
  /* Names of the faces, NULL-terminated */
  const char *const *(*faces)(const SceneBody *);
  /* Collective error if the body's parameters are not valid; number of level 0 cells and vertices */
  PetscErrorCode (*size)(MPI_Comm, const SceneBody *, PetscInt64 *ncells, PetscInt64 *nvertices);
  /* Not collective; fills the grid, whose arrays are the caller's to free with ShapeGridDestroy() */
  PetscErrorCode (*create)(const SceneBody *, ShapeGrid *);
  /* From parameters to places in space; NULL if they are the same. x and the parameters may be one array */
  PetscErrorCode (*map)(const SceneBody *, const PetscReal parameters[3], PetscReal x[3]);
} Shape;

PETSC_INTERN const Shape ShapeBox, ShapeTubeArc, ShapeHalfEllipse, ShapeSphereShell, ShapeSpheroidShell, ShapeBall;

/*
   octant.c: octants of shells and balls as O-grids.

   Parameters: a cube [0, 1]^3 with a corner at the octant's corner, whose three far sides (the patches) are extruded
   to the cube [0, 2]^3: there, with m the largest component, the point q = p/m of a far side gives a direction and s
   = m - 1 the place across the shell, 0 at its inner and 1 at its outer surface. Shells have no cells in [0, 1]^3, a
   ball has its core there.
*/
PETSC_INTERN const char *const *OctantFaces(const SceneBody *);
PETSC_INTERN PetscErrorCode     OctantSize(MPI_Comm, const SceneBody *, PetscBool core, PetscInt64 *ncells,
      PetscInt64 *nvertices);
PETSC_INTERN PetscErrorCode     OctantCreate(const SceneBody *, PetscBool core, ShapeGrid *);
/* q on the far sides of the unit cube and s, from parameters outside of the core */
PETSC_INTERN void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s);
/* Unit vector of a point of the far sides, all components >= 0; equal steps along the cube's edges are equal angles */
PETSC_INTERN void OctantDirection(const PetscReal q[3], PetscReal direction[3]);
/* Place of a point given relative to the corner, all components >= 0 */
PETSC_INTERN void OctantPlace(const SceneBody *, const PetscReal relative[3], PetscReal x[3]);

/* shape.c: the shape of a body; NULL for a body from a file */
PETSC_INTERN PetscErrorCode ShapeGet(MPI_Comm, const SceneBody *, const Shape **);

/* names.c: lists of names; joined with commas, or the word none, cut off at size */
PETSC_INTERN PetscErrorCode NamesDestroy(PetscInt *n, char ***names);
PETSC_INTERN PetscErrorCode NamesJoin(PetscInt n, char *const names[], size_t size, char text[]);

/* tetrahedron.c: the place of a node on the reference tetrahedron; and what is public */
PETSC_INTERN void MeshTetrahedronPlace(PetscInt node, PetscReal xi[3]);

/* query.c: number within DMPlex's cell of so many corners of the vertex at each corner; the corners of a cell; and
   what is public */
PETSC_INTERN const PetscInt *MeshPlexCorners(PetscInt ncorners);
PETSC_INTERN PetscErrorCode  MeshGetCellCorners(DM, PetscInt cell, PetscInt *n, PetscInt vertices[8]);

/* stream.c: reading a Gmsh file with suspicion. What is false has left a sentence behind; the first stays */
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

/* faces.c: name of the label of a body's face */
PETSC_INTERN PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[]);

/* subfaces.c: whether those that the body names are of its faces; their labels at level 0, not collective, of this
   rank's part of the body, first: the first vertex; collective: an error if one has no facets on any rank */
PETSC_INTERN PetscErrorCode MeshCheckSubfaces(MPI_Comm, const SceneBody *);
PETSC_INTERN PetscErrorCode MeshLabelSubfaces(DM, const SceneBody *, const ShapeGrid *, PetscInt first);
PETSC_INTERN PetscErrorCode MeshCheckSubfacesFilled(DM, const SceneBody *);

/* point_labels.c: labels of the nodes at the scene's points and edges, as faces have them */
PETSC_INTERN PetscErrorCode MeshLabelPoints(DM, Scene);

/* rigid_labels.c: a label of all that moves with a rigid body, after the last refinement */
PETSC_INTERN PetscErrorCode MeshLabelRigid(DM, PetscInt nbodies, const SceneBody[]);

/* body.c: one body at level 0, sizes and faces on all ranks, the grid on rank 0 */
typedef struct {
  PetscInt64 ncells, nvertices;
  PetscInt   ncorners, order; /* of its cells; what it asks for, or what suits them */
  PetscInt   nfaces;
  char     **faces;
  PetscBool  quadratic; /* its grid has a curve */
  ShapeGrid  grid;
} MeshBody;
PETSC_INTERN PetscErrorCode MeshCreateBodies(MPI_Comm, PetscInt nbodies, const SceneBody[], MeshBody[]);
PETSC_INTERN PetscErrorCode MeshDestroyBodies(PetscInt nbodies, MeshBody[]);

/*
   nodes.c: the points that carry displacements. Their places begin straight between the vertices in a shape's
   parameters, and are mapped and bent as the vertices are; MeshUpdateVertices() then gives the vertices' places back
   to DMPlex.
*/
typedef struct {
  PetscSection section;
  Vec          x; /* [length], or a shape's parameters */
} MeshPlaces;
PETSC_INTERN PetscErrorCode MeshSetSection(DM, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshCreateNodes(DM, PetscInt nbodies, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshGetPlaces(DM, PetscBool nodes, MeshPlaces *);
PETSC_INTERN PetscErrorCode MeshGetCellPoints(DM, PetscSection, PetscInt cell, PetscInt *n,
  PetscInt points[MESH_MAX_NODES]);
PETSC_INTERN void           MeshPlacesSetStraight(PetscInt ncorners, const PetscReal corners[][3],
            PetscReal places[MESH_MAX_NODES][3]);
PETSC_INTERN PetscErrorCode MeshUpdateVertices(DM);

/* map.c: from the shapes' parameters to space: the nodes of bodies with curved refinement, or at level 0 the vertices
   of those without */
PETSC_INTERN PetscErrorCode MeshMapNodes(DM, PetscInt nbodies, const SceneBody[], PetscBool curved);

/* quality.c: the slopes of a cell's shape functions at its nodes, which come first, and at the integration points of
   order 2; the smallest of the Jacobian's determinants there. Collective error if a cell is inverted or flat at one
   of its corners; mapped: at one of these places, also in bodies that are mapped after refinement */
#define MESH_QUALITY_PLACES (2 * MESH_MAX_NODES)
typedef struct {
  PetscInt  nnodes, nplaces;
  PetscReal dN[MESH_QUALITY_PLACES][3][MESH_MAX_NODES];
} MeshQualityTable;
PETSC_INTERN PetscErrorCode MeshQualityTableCreate(PetscInt nnodes, MeshQualityTable *);
PETSC_INTERN PetscReal      MeshCellQuality(const MeshQualityTable *, PetscReal x[][3]);
PETSC_INTERN PetscErrorCode MeshCheckCells(DM, PetscInt nbodies, const SceneBody[], PetscBool mapped);

/* refine_uniform.c: so many uniform refinements of a mesh in place */
PETSC_INTERN PetscErrorCode MeshRefine(DM *, PetscInt levels);

/* hexahedra.c: hexahedra on one rank, some refined more often than others; of a mesh whose cells are their roots */
typedef struct {
  PetscInt  ncells, *vertex; /* 8 a cell, in tensor order */
  PetscInt *root, *place;    /* 4 numbers a cell: where in its root the lower corner is, in cells of its size, and how
                                often the root was refined */
  PetscInt  nvertices, maxvertices,
    *parent;                /* 4 a vertex: those that it was made amid, on an edge or a side; the others are negative */
  PetscReal             *x; /* 3 a vertex, as the mesh has them */
  PetscInt               nplaced; /* the first so many vertices have been placed: refine_inverted.c */
  PetscReal             *placed;  /* 3 a vertex, where they are with all vertices on the curves */
  struct _n_MeshMiddles *middles;
} MeshHexes;
PETSC_INTERN PetscErrorCode MeshHexesCreate(DM, MeshHexes *);
PETSC_INTERN PetscErrorCode MeshHexesRefine(MeshHexes *, PetscBool marked[]);
PETSC_INTERN PetscErrorCode MeshHexesMarkHolders(const MeshHexes *, PetscBool marked[], PetscBool *any);
PETSC_INTERN PetscErrorCode MeshHexesFindHanging(const MeshHexes *, PetscBool hangs[]);
PETSC_INTERN PetscErrorCode MeshHexesDestroy(MeshHexes *);

/* refine_zones.c: what the scene refines */
PETSC_INTERN PetscErrorCode MeshHexesRefineZones(DM, const SceneBody[], PetscInt n, const SceneRefinement[],
  MeshHexes *);

/* curves.c: the quadratic cells of a mesh: [81 or 30 a cell of a quadratic body, 0 of others], carried along as it is
   distributed */
typedef struct {
  PetscSection section; /* NULL: no body has any */
  Vec          places;
} MeshCurves;
PETSC_INTERN PetscInt       MeshCurveSize(PetscInt ncorners);
PETSC_INTERN PetscErrorCode MeshCurvesCreate(DM level0, PetscInt nbodies, const MeshBody[], MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDistribute(PetscSF, DM distributed, MeshCurves *);
/* fine: the mesh that the curves belong to, refined. Moves its vertices onto them, or all its nodes; replaces them by
   those of its cells */
PETSC_INTERN PetscErrorCode MeshCurvesApply(const MeshCurves *, PetscInt levels, DM fine, PetscBool nodes);
PETSC_INTERN PetscErrorCode MeshCurvesRefine(PetscInt levels, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesPlacePart(const MeshCurves *, const MeshHexes *, PetscInt cell,
  PetscReal places[8][3]);
PETSC_INTERN PetscErrorCode MeshCurvesCutOut(const MeshHexes *, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDestroy(MeshCurves *);

/* refine_inverted.c: fine cells stay the right side out */
PETSC_INTERN PetscErrorCode MeshHexesRefineInverted(DM, const SceneBody[], const MeshCurves *, MeshHexes *);

/* hanging.c: vertices amid an edge or a side of a cell; what is carried along as the mesh is distributed, and what
   becomes of it */
typedef struct {
  PetscSection section; /* NULL: there was no local refinement */
  PetscInt    *numbers;
} MeshHanging;
PETSC_INTERN PetscErrorCode MeshHangingCreate(const MeshHexes *, DM, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingDistribute(PetscSF, DM before, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingFinish(DM, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingPlace(DM);
PETSC_INTERN PetscErrorCode MeshHangingDestroy(MeshHanging *);

/* refine_marked.c: marked cells */
PETSC_INTERN PetscErrorCode MeshNumberCells(DM, const MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHexesRefineMarks(const MeshMarks *, DM, const SceneBody[], const MeshCurves *,
  MeshHexes *);

/* refine_local.c: local refinement, in place; the mesh is that of the first rank, with its curves */
#define MESH_INNER_LABEL "inner" /* of facets inside a body that have one cell */
typedef struct {
  PetscInt               nzones;
  const SceneRefinement *zones;
  const MeshMarks       *marks; /* NULL: there will be none */
} MeshLocalRefinement;
PETSC_INTERN PetscErrorCode MeshRefineLocally(const MeshLocalRefinement *, const SceneBody[], DM *, MeshCurves *,
  MeshHanging *);

/* metis.c: METIS on a whole graph, part[v] in [0, nparts); and the partitioner, public */
PETSC_INTERN PetscErrorCode MetisPartitionGraph(PetscInt nparts, PetscInt nv, const PetscInt start[],
  const PetscInt adjacency[], const PetscInt weights[], PetscInt part[]);

/* distribute_level0.c: collective; the grids on rank 0 become those of all ranks, each a part. Which rank owns each
   vertex here, as which point of a mesh of cells and vertices */
typedef struct {
  PetscBool    distributed; /* else all is on rank 0 */
  PetscInt     n;
  PetscSFNode *points;
} MeshOwners;
PETSC_INTERN PetscErrorCode MeshDistributeGrids(MPI_Comm, PetscInt nbodies, MeshBody[], MeshOwners *);
PETSC_INTERN PetscErrorCode MeshOwnersDestroy(MeshOwners *);

/* level0.c: all bodies at level 0 with their labels, on rank 0 or distributed; the first cell of each, tetrahedra
   before hexahedra as DMPlex wants them */
PETSC_INTERN PetscErrorCode MeshGetFirstCells(PetscInt nbodies, const MeshBody[], PetscInt first[]);
PETSC_INTERN PetscErrorCode MeshCreateLevel0(MPI_Comm, PetscInt nbodies, const SceneBody[], const MeshBody[],
  const MeshOwners *, DM *);

/* boundary.c, create.c, check_supports.c: MeshCreate(), and whether the scene holds its bodies, public */

#endif
