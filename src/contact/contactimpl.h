/*
   Contact, private: the map of src/contact. From one facet to the object, every file builds on those before it.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include <contact.h>
#include <petsccompat.h>

/* events.c: PETSc's log events of this folder */
PETSC_INTERN PetscLogEvent  CONTACT_Search, CONTACT_Integrate;
PETSC_INTERN PetscErrorCode ContactEventsRegister(void);

/* quadrature.c: a rule for triangles */
#define CONTACT_RULE_DEGREE 8 /* at most */
#define CONTACT_RULE_POINTS 16
typedef struct {
  PetscInt  degree, n;
  PetscReal barycentric[CONTACT_RULE_POINTS][3], weight[CONTACT_RULE_POINTS];
} ContactRule;
PETSC_INTERN PetscErrorCode ContactRuleCreate(PetscInt degree, ContactRule *);

/* vector.c: products of vectors */
PETSC_INTERN PetscReal ContactDot(const PetscReal a[3], const PetscReal b[3]);
PETSC_INTERN void      ContactCross(const PetscReal a[3], const PetscReal b[3], PetscReal c[3]);
PETSC_INTERN PetscReal ContactScaleToUnit(PetscReal n[3]);

/*
   facet.c: bilinear facets. A triangle has its last vertex twice: the bilinear functions of the two add up to the
   linear one there, and those of the others are linear
*/
PETSC_INTERN PetscBool ContactFacetIsTriangle(const PetscReal x[12]);
PETSC_INTERN void      ContactShape(const PetscReal xi[2], PetscReal phi[4]);
PETSC_INTERN void      ContactShapeSlopes(const PetscReal xi[2], PetscReal dphi[4][2]);
PETSC_INTERN void      ContactFacetAreaVector(const PetscReal x[12], PetscReal a[3]);
PETSC_INTERN void      ContactFacetTurn(const PetscReal x[12], const PetscReal moment[3], PetscReal by_x[12]);
PETSC_INTERN void ContactFacetTangents(const PetscReal x[12], const PetscReal xi[2], PetscReal t1[3], PetscReal t2[3]);
PETSC_INTERN PetscReal ContactFacetMass(const PetscReal x[12], PetscReal mass[4]);
PETSC_INTERN void      ContactInverseMap(const PetscReal q[4][2], const PetscReal y[2], PetscReal xi[2]);

/* patch.c: the smooth surface a facet stands for */
typedef struct {
  PetscReal slope[4][2],
    direction[4][3];    /* of the edge from vertex e to the next, at both ends [length]; what it is bent along */
  PetscReal normal[12]; /* unit, at the vertices */
  PetscBool triangle;
} ContactPatch;
PETSC_INTERN void      ContactPatchCreate(const PetscReal x[12], const PetscReal normal[12], ContactPatch *);
PETSC_INTERN PetscBool ContactPatchIsBent(const ContactPatch *, PetscInt edge);
PETSC_INTERN PetscReal ContactPatchBulge(const ContactPatch *);
PETSC_INTERN void      ContactPatchEvaluate(const ContactPatch *, const PetscReal xi[2], PetscReal offset[3],
       PetscReal normal[3]);

/* patch_slopes.c: derivatives of what is made of a patch's points. by: the derivative by each number of the patch, at
   its place */
PETSC_INTERN void ContactPatchDifferentiate(const ContactPatch *, const PetscReal xi[2], const PetscReal by_offset[3],
  const PetscReal by_normal[3], PetscReal by_xi[2], ContactPatch *by);
PETSC_INTERN PetscReal ContactPatchHeight(const ContactPatch *, const PetscReal xi[2], const PetscReal direction[3],
  PetscReal by_xi[2], ContactPatch *by);
PETSC_INTERN void      ContactPatchChain(const PetscReal x[12], const ContactPatch *, const ContactPatch *by,
       PetscReal by_x[12], PetscReal by_normal[12]);
PETSC_INTERN void      ContactPatchMoment(const ContactPatch *, const ContactPatch *by, PetscReal moment[3]);

/* frame.c: the plane a nonmortar facet is projected to */
typedef struct {
  PetscReal origin[3], axis[3][3];
} ContactFrame;
PETSC_INTERN PetscBool ContactFacetNormal(const PetscReal x[12], PetscReal n[3]);
PETSC_INTERN PetscBool ContactFrameCreate(const PetscReal x[12], ContactFrame *);
PETSC_INTERN void      ContactFrameProject(const ContactFrame *, const PetscReal x[12], PetscReal p[4][2],
       PetscReal height[4]);

/* clip.c: convex polygons in the plane, vertices counterclockwise */
#define CONTACT_MAX_POLYGON 32
PETSC_INTERN PetscReal ContactPolygonArea(PetscInt n, const PetscReal p[][2]);
PETSC_INTERN PetscInt  ContactClip(PetscInt nsubject, const PetscReal subject[][2], PetscInt nclip,
   const PetscReal clip[][2], PetscReal out[][2], PetscInt edge[][2]);

/* overlap.c: where a nonmortar and a mortar facet face each other. With these points, weights and the nodal normals
   frozen, the weighted gap is linear in the coordinates. */
#define CONTACT_MAX_CORNERS (2 * CONTACT_MAX_POLYGON)
#define CONTACT_MAX_POINTS  (CONTACT_MAX_POLYGON * CONTACT_RULE_POINTS)
typedef struct {
  PetscReal y[2];
  PetscInt  line[2][2]; /* the two lines that meet there, each through two vertices: 0 to 3 of the nonmortar facet, 4 to
                           7 of the mortar one */
} ContactCorner;
typedef struct {
  PetscInt  corner[3];
  PetscReal sign;
} ContactTriangle;
typedef struct {
  PetscInt        ncorners, ntriangles;
  ContactCorner   corner[CONTACT_MAX_CORNERS];
  ContactTriangle triangle[CONTACT_MAX_CORNERS]; /* each with as many points as the rule, in this order */

  PetscInt  n;
  PetscReal area;                       /* of the overlap in the nonmortar facet's plane [length^2] */
  PetscReal weight[CONTACT_MAX_POINTS]; /* [length^2] */
  PetscReal xi1[CONTACT_MAX_POINTS][2]; /* on the nonmortar facet */
  PetscReal xi2[CONTACT_MAX_POINTS][2]; /* on the mortar facet */
} ContactOverlap;
typedef struct {
  PetscReal cosine, overlap_drop, distance, depth;
} ContactOverlapLimits;
PETSC_INTERN PetscBool ContactOverlapFind(const PetscReal x1[12], const PetscReal x2[12], const ContactOverlapLimits *,
  const ContactRule *, ContactOverlap *);

/* overlap_slopes.c: the weighted gap of two smooth surfaces over an overlap, and all that it changes with */
typedef struct {
  PetscReal x[4][12],
    normal[4][12];        /* of int phi_A gap, for the four A: by a facet's vertices, and by the unit normals there */
  PetscReal rigid[4][12]; /* by its vertices, the patches keeping their shape and turning with their facets */
  PetscReal cover[4][12]; /* of int phi_A, by its vertices */
} ContactSlopes;
PETSC_INTERN void ContactOverlapSlopes(const ContactOverlap *, const ContactRule *, const PetscReal x1[12],
  const PetscReal x2[12], const ContactPatch *, const ContactPatch *, PetscReal gap[4], PetscReal cover[4],
  ContactSlopes *nonmortar, ContactSlopes *mortar);

/* closest.c: the point of a facet closest to another point */
PETSC_INTERN PetscReal ContactClosestPoint(const PetscReal x[12], const PetscReal p[3], PetscReal xi[2],
  PetscReal y[3]);

/* box.c: boxes along the coordinate axes, about facets and what they sweep */
PETSC_INTERN void      ContactFacetBox(const PetscReal x[12], PetscReal box[6]);
PETSC_INTERN void      ContactSweptBox(const PetscReal x[12], PetscReal distance, PetscReal depth, PetscReal box[6]);
PETSC_INTERN PetscBool ContactBoxesMeet(const PetscReal a[6], const PetscReal b[6]);

/* boundary.c: the facets on this rank that bound the bodies, undeformed */
typedef struct {
  MPI_Comm   comm;
  PetscInt   nbodies, n, *body;
  PetscReal *x; /* [12 n] corners, counterclockwise seen from outside [length] */
} ContactBoundary;
PETSC_INTERN PetscErrorCode ContactBoundaryCreate(DM, ContactBoundary *);
PETSC_INTERN PetscErrorCode ContactBoundaryDestroy(ContactBoundary *);
PETSC_INTERN PetscErrorCode ContactBoundaryThickness(const ContactBoundary *, PetscReal thickness[]);
PETSC_INTERN PetscErrorCode ContactBoundaryBoxes(const ContactBoundary *, PetscReal box[]);
PETSC_INTERN PetscReal      ContactBoundarySolidAngle(const ContactBoundary *, PetscInt body, const PetscReal from[3]);

/* surface.c: the facets of a named face that this rank owns */
typedef struct {
  char     *name;
  PetscInt  nfacets;
  PetscInt *vertex; /* [4 nfacets] local DMPlex points that carry nodes, counterclockwise seen from outside; the last of
                       a triangle twice */
  PetscInt *node;   /* [4 nfacets] global numbers of the vertices: a third of their first global row */
  PetscReal *reference; /* [12 nfacets] coordinates of the undeformed vertices [length] */
  PetscReal *x;         /* [12 nfacets] coordinates of the deformed vertices [length] */
  PetscReal *patch;     /* [12 nfacets] unit normals of the smooth deformed surface at the vertices */
  PetscInt  *bend;      /* [4 nfacets] their global numbers */
  PetscBool  patched;   /* whether there are those; the same on all ranks */
  PetscBool  cut;       /* whether the facets are pieces of the mesh's, of order 2; the same on all ranks */
  PetscInt
    *held; /* [nfacets] bits 3 a + c: vertex a is on a face of the mesh whose displacement along axis c is prescribed */
  PetscInt *border; /* [nfacets] bit a: the edge from vertex a to the next is on the face's border; bit 4 + a: vertex a
                       is; of a triangle bit 2: its last vertex */
  PetscBool bordered;  /* whether border has been asked for; the same on all ranks */
  PetscReal area;      /* of the whole undeformed face, all ranks [length^2] */
  PetscInt  body;      /* behind the face */
  PetscReal thickness; /* mean thickness of that body [length] */
} ContactSurface;
PETSC_INTERN PetscErrorCode ContactSurfaceCreate(DM, const char[], const PetscReal thickness[], ContactSurface *);
PETSC_INTERN PetscErrorCode ContactVerticesDeform(DM, Vec ulocal, PetscInt n, const PetscInt vertex[], PetscReal x[]);
PETSC_INTERN PetscErrorCode ContactSurfaceDeform(DM, Vec ulocal, ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceNormals(DM, const ContactSurface *, PetscReal normal[], PetscInt n,
  const PetscInt vertex[], PetscReal vertexnormal[]);
PETSC_INTERN PetscErrorCode ContactSurfaceDestroy(ContactSurface *);

/* trace.c: what the displacement of the surfaces' vertices differs from that of the mesh's nodes; NULL: nothing */
typedef enum {
  CONTACT_TRACE_FORWARD,
  CONTACT_TRACE_INVERSE
} ContactTraceType;
PETSC_INTERN PetscErrorCode ContactTraceCreate(DM, PetscInt nsurfaces, const ContactSurface *const surface[],
  ContactTraceType, PetscInt components, Mat *correction);
PETSC_INTERN PetscErrorCode ContactTraceApply(DM, Mat correction, Vec u, Vec local);
PETSC_INTERN PetscErrorCode ContactTraceDifferentiate(Mat correction, Vec which, Mat jacobian);
PETSC_INTERN PetscErrorCode ContactTraceRecover(Mat correction, Mat rows);

/* border.c: fills in a surface's border; where it is held */
#define CONTACT_FREE    -2 /* no displacement is prescribed */
#define CONTACT_AT_REST -1 /* it is, as 0 */
PETSC_INTERN PetscErrorCode ContactSurfaceFindBorder(DM, ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceFindHeld(DM, PetscInt n, const SceneDisplacement[], ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceFindMotions(DM, PetscInt n, const SceneDisplacement[], PetscInt axis,
  const ContactSurface *, PetscInt motion[]);
PETSC_INTERN PetscErrorCode ContactSurfaceFindPlanes(DM, PetscInt n, const SceneDisplacement[], const ContactSurface *,
  PetscInt plane[]);

/* exchange.c: mortar facets that may face this rank's part of the nonmortar face, whoever owns them */
typedef struct {
  PetscInt   n;
  PetscInt  *node;   /* [4 n] */
  PetscInt  *border; /* [n] where the surface is bordered */
  PetscReal *x;      /* [12 n] */
  PetscReal *patch;  /* [12 n] where the surface is patched */
  PetscInt  *bend;   /* [4 n] there, too */
} ContactCandidates;
PETSC_INTERN PetscErrorCode ContactExchange(MPI_Comm, const PetscReal box[6], const ContactSurface *,
  ContactCandidates *);
PETSC_INTERN PetscErrorCode ContactCandidatesDestroy(ContactCandidates *);

/* ring.c: the facets about those of this rank, two deep, and who is next to whom. Corner 4 f + a is vertex a of facet
   f */
typedef struct {
  PetscInt of,
    plane[3]; /* a real node; and real nodes on the planes across the axes that it is seen in, negative: in none */
} ContactImage;
typedef struct {
  PetscInt   nfacets, own;  /* the surface's own facets are the nfacets of it from number own on */
  PetscInt   nnodes, *node; /* [4 nfacets] number from 0 of the node at a corner */
  PetscInt  *twin;  /* [4 nfacets] corner whose edge to the next vertex is the same, seen from the other side; negative:
                       sharp, or on the border */
  PetscInt   nreal; /* the nodes from here on are images of those before, in planes that the surface ends on */
  PetscInt  *global;   /* [nreal] global numbers of the nodes */
  PetscInt  *held;     /* [nnodes] bits of the axes along which the face is held */
  PetscInt   nnormals; /* that the surface's own corners have on this rank: corners share one as far as nothing sharp is
                         between them */
  PetscInt  *normal, *at;   /* [4 own facets] which a corner has; [nnormals] a corner that has it */
  PetscReal *reference, *x; /* [3 nreal], [3 nnodes] coordinates of the nodes, undeformed and deformed [length] */
  Vec        u;             /* displacements of the nodes */
  VecScatter scatter;

  ContactImage *image; /* [nnodes - nreal] */
} ContactRing;
PETSC_INTERN PetscInt       ContactCornerAfter(const ContactRing *, PetscInt corner);
PETSC_INTERN PetscInt       ContactCornerBefore(const ContactRing *, PetscInt corner);
PETSC_INTERN PetscBool      ContactCornerIsNone(const ContactRing *, PetscInt corner);
PETSC_INTERN void           ContactRingReflect(ContactRing *, PetscInt node);
PETSC_INTERN PetscErrorCode ContactRingDeform(Vec u, ContactRing *);
PETSC_INTERN PetscBool      ContactRingFan(const ContactRing *, PetscInt corner, PetscInt *first, PetscInt *last);
PETSC_INTERN void ContactRingEdges(const ContactRing *, PetscInt corner, PetscReal after[3], PetscReal before[3]);
PETSC_INTERN PetscErrorCode ContactRingDestroy(ContactRing *);

/* corner_normals.c: normals of the smooth surface, from the facets' corners */
#define CONTACT_FLAT_CORNER \
  1e-4 /* squared sine of the angle of a facet's corner, below which it is as good as straight */
PETSC_INTERN PetscReal ContactRingFanNormal(const ContactRing *, PetscInt first, PetscInt last, PetscReal normal[3]);
PETSC_INTERN void      ContactRingMeanNormal(const ContactRing *, PetscInt corner, PetscReal normal[3]);
PETSC_INTERN void      ContactRingMend(const ContactRing *, PetscInt first, PetscInt last, PetscReal normal[3]);
PETSC_INTERN void      ContactRingNormal(const ContactRing *, PetscInt corner, PetscReal normal[3]);

/* mirror.c: a ring's images in the planes that the surface ends on */
PETSC_INTERN PetscErrorCode ContactRingAddImages(MPI_Comm, PetscReal length, PetscInt nown, ContactRing *);

/* ring_create.c: makes a ring */
PETSC_INTERN PetscErrorCode ContactRingCreate(MPI_Comm, Vec u, PetscReal cosine, const ContactSurface *, ContactRing *);

/* corner_normal_slopes.c: what the normals change with the nodes */
typedef struct {
  PetscInt     n;     /* blocks so far */
  PetscInt    *node;  /* of the ring; NULL: blocks are counted only */
  PetscScalar *value; /* [9 n] derivatives of the three components by the node's three coordinates; they add up where
                         nodes repeat */
} ContactNormalSlopes;
PETSC_INTERN void ContactRingNormalSlopes(const ContactRing *, PetscInt corner, ContactNormalSlopes *);

/* tree.c: a static tree of facets' bounding boxes. Depth-first: the first child of a node follows it */
#define CONTACT_TREE_DEPTH 128 /* of a median split of any number of facets PetscInt can hold */
typedef struct {
  PetscReal box[6];      /* lower corner, upper corner */
  PetscInt  first, last; /* facets of a leaf: order[first] to order[last - 1] */
  PetscInt  second;      /* the second child; 0 in a leaf */
} ContactTreeNode;
typedef struct {
  PetscInt         nnodes;
  ContactTreeNode *node;
  PetscInt        *order;
  PetscReal       *box; /* [6 n] of the facets */
} ContactTree;
PETSC_INTERN PetscErrorCode ContactTreeCreate(const ContactCandidates *, ContactTree *);
PETSC_INTERN PetscErrorCode ContactTreeDestroy(ContactTree *);

/* nearest.c: the facet nearest to a vertex, among those that face it */
typedef struct {
  PetscInt  facet; /* of the candidates; negative: none */
  PetscReal xi[2]; /* closest point on it */
  PetscReal y[3];
} ContactNearest;
PETSC_INTERN void ContactFindNearest(const ContactTree *, const ContactCandidates *, PetscReal cosine, PetscReal reach,
  const PetscReal x[3], const PetscReal normal[3], ContactNearest *);

/* search.c: of each of this rank's nonmortar facets f, the candidates facet[offset[f]] to facet[offset[f + 1] - 1]
   along its normal */
typedef struct {
  PetscInt *offset, *facet;
} ContactNear;
PETSC_INTERN PetscErrorCode ContactSearch(const ContactSurface *nonmortar, PetscReal distance, PetscReal depth,
  const ContactCandidates *, ContactNear *);
PETSC_INTERN PetscErrorCode ContactNearDestroy(ContactNear *);

/* The object */
typedef struct {
  char          *name; /* of the pair, for messages */
  ContactSurface mortar, nonmortar;
  ContactRing    mortar_ring, nonmortar_ring; /* where the surfaces are patched */
  GapType        gap;
  PetscBool      rubs;     /* whether the pair's slip is asked for */
  PetscBool      sticks;   /* whether none is allowed */
  PetscInt  nfrictionless; /* rows, on all ranks, where friction cannot act though the faces slide: known once there are
                             rows of slip */
  PetscBool smooth;        /* whether the gap is to be that of the smooth surfaces */
  PetscReal bulge;   /* these stand off the undeformed facets of the two faces by no more than this together [length] */
  PetscReal given;   /* the pair's own search distance; 0: from the size of the faces [length] */
  PetscInt *row;     /* [4 nonmortar facets] global row of each of the facets' vertices */
  PetscReal *normal; /* [12 nonmortar facets] averaged unit normals at the facets' vertices */
  PetscReal  distance; /* facets farther apart than this do not pair [length] */
  PetscReal  depth;    /* nor do facets that penetrate more than this: they look through a body [length] */
  PetscInt   nfacing;  /* of the last linearization, on this rank: facets that overlap, or vertices that face a facet */
} ContactPairData;

/* Whether its patches follow what faces of order 2 bend between their nodes; else their vertices move with the mean
   of it */
static inline PetscBool ContactPairFollows(const ContactPairData *pair)
{
  return (PetscBool)(pair->smooth && pair->gap == GAP_MORTAR);
}

/* All rows there may be, before any is dropped: for each pair in turn, the nonmortar vertices this rank owns */
typedef struct {
  PetscInt   nlocal, *first; /* rows first[p] to first[p + 1] - 1 of this rank belong to pair p */
  PetscInt  *vertex;         /* [nlocal] local DMPlex points */
  PetscInt  *held; /* [nlocal] bits of the axes along which there is no slip, and 8 times 1 + the number of an inclined
                     plane across which there is none; NULL: not yet asked for */
  PetscReal *normal;  /* [3 nlocal] averaged unit normals */
  PetscReal *x;       /* [3 nlocal] coordinates of the deformed vertices [length] */
  Vec        mass;    /* int phi_A over the whole undeformed nonmortar face [length^2] */
  Vec        weight;  /* the same, with that of hanging vertices at those they hang between */
  Mat        hanging; /* which rows what is added up for a row goes to; NULL: no vertex hangs, and it stays */
} ContactRows;

/* What the normals of all smooth surfaces change with a displacement; a rank has those of its own facets' corners */
typedef struct {
  PetscInt            nlocal; /* normals */
  ContactNormalSlopes blocks; /* the same nodes in the same order at every displacement */
  Mat                 slopes; /* three rows a normal, columns are the DM's global rows; NULL where no pair is smooth */
} ContactSmoothNormals;

/* Along what a mortar gap is measured */
typedef enum {
  CONTACT_NORMALS_NODAL, /* the averaged normal of the row's vertex */
  CONTACT_NORMALS_FACET  /* the normal of each nonmortar facet */
} ContactNormals;

struct _n_Contact {
  DM                       dm;
  MPI_Comm                 comm;
  PetscInt                 npairs;
  ContactPairData         *pairs;
  PetscBool                rubs; /* whether any of them does */
  ContactRows              rows;
  ContactNormals           normals;
  PetscReal                feature_angle; /* edges sharper than this stay sharp [degrees] */
  PetscInt                 ndisplacements;
  const SceneDisplacement *displacements; /* that the faces of the bodies are held by; the caller's */
  PetscBool                smoothed;      /* whether it has been looked which pairs are curved */
  ContactSmoothNormals     bends;
  Mat trace; /* what is added to the mesh's displacement at vertices of the surfaces; NULL: no face has order 2 */
  ContactRule rule;  /* of the triangles that overlaps are cut into */
  PetscReal   reach; /* distance that pairs without one of their own look for at least [length] */
  PetscReal
    reach_depth; /* depth that every pair looks for at least, whatever the angle of the normals; 0: as usual [length] */
  PetscReal depth;        /* 0: from the thickness of the bodies */
  PetscReal cosine;       /* facets pair when n1.n2 is at most this */
  PetscReal overlap_drop; /* relative to the smaller facet's area */
  PetscReal row_drop;     /* relative to the largest row's 1-norm */
  PetscInt  nrows;        /* of the last linearization, on all ranks */
};

/* rows.c: the rows there may be */
PETSC_INTERN PetscErrorCode ContactRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactRowsDestroy(Contact);

/* hanging_rows.c: rows of hanging vertices */
PETSC_INTERN PetscErrorCode ContactHangingRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactHangingRowsVector(Contact, Vec sums);
PETSC_INTERN PetscErrorCode ContactHangingRowsMatrix(Contact, Mat *sums);

/* surface_normals.c: numbers the normals of the pairs that are patched, and has their derivatives at the rings'
   displacement */
PETSC_INTERN PetscErrorCode ContactSmoothNormalsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactSmoothNormalsUpdate(Contact);
PETSC_INTERN PetscErrorCode ContactSmoothNormalsDestroy(Contact);

/* smooth.c: which pairs are curved, and their smooth surfaces */
PETSC_INTERN PetscErrorCode ContactSmoothDeform(Contact, Vec u);
PETSC_INTERN PetscErrorCode ContactSmoothReset(Contact);

/* entries.c: entries of a matrix, as they come; added up where they repeat */
typedef struct {
  PetscInt     n, size; /* in use, and space for them */
  PetscInt    *row, *column;
  PetscScalar *value;
} ContactEntries;
PETSC_INTERN PetscErrorCode ContactEntriesAdd(ContactEntries *, PetscInt row, PetscInt n, const PetscInt block[],
  const PetscReal value[]);
PETSC_INTERN PetscErrorCode ContactEntriesCreateMatrix(MPI_Comm, PetscInt m, PetscInt n, ContactEntries *, Mat *);
PETSC_INTERN PetscErrorCode ContactEntriesDestroy(ContactEntries *);

/* held.c: rows->held, once: along what the rows of pairs that rub have no slip */
PETSC_INTERN PetscErrorCode ContactFindHeld(Contact);

/* slip.c: the rows of slip that go with those of the gap */
PETSC_INTERN PetscErrorCode ContactSlipCreate(Contact, Mat couplings, const PetscInt kept[], ContactLinearization);

/* assemble.c: one linearization under construction. entries: (row, node, value), added up where they repeat */
typedef struct {
  Vec       gap;        /* int phi_A gap [length^3] */
  Vec       cover;      /* int phi_A over what smooth mortar pairs cover [length^2] */
  PetscInt  n, size;    /* entries in use, and space for them */
  PetscInt *row, *node; /* global row, global number of the vertex */
  PetscInt  dim;        /* 1: one value an entry, for all have the row's normal; 3: a vector */
  PetscScalar
    *value[3]; /* int phi_A (N2 - N1) [length^2]: times the normal, what the vertex's displacement adds to the gap */

  ContactEntries rigid, by_cover, by_node,
    by_bend; /* of smooth pairs, as in ContactSlopes: three columns a vertex or a normal */
} ContactAssembly;
PETSC_INTERN PetscErrorCode ContactAssemblyCreate(Contact, ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyAdd(ContactAssembly *, PetscInt row, PetscInt n, const PetscInt node[],
  const PetscReal value[], const PetscReal normal[3]);
PETSC_INTERN PetscErrorCode ContactAssemblyAddSlopes(ContactAssembly *, const PetscInt row[4], const PetscInt node[4],
  const PetscInt bend[4], const ContactSlopes *);
PETSC_INTERN PetscErrorCode ContactAssemblyDestroy(ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyFinish(Contact, ContactAssembly *, ContactLinearization *);

/*
   mortar.c, node.c: formulations of the gap.

   A new formulation is one file with a ContactGapOps, one line in linearize.c, and its name in src/model/formulation.c.
*/
typedef struct {
  /* Grows box to hold all that may face this rank's part of pair p */
  PetscErrorCode (*box)(Contact, PetscInt p, PetscReal box[6]);
  /* Adds pair p's gap and coupling to the assembly, and counts pair->nfacing */
  PetscErrorCode (*add)(Contact, PetscInt p, const ContactCandidates *, ContactAssembly *);
} ContactGapOps;
PETSC_INTERN const ContactGapOps ContactGapMortar, ContactGapNode;

typedef struct {
  PetscReal gap[4];  /* int phi_A (x2 - x1).n_A [length^3] */
  PetscReal D[4][4]; /* int phi_A N1_B [length^2]; its rows sum to int phi_A */
  PetscReal M[4][4]; /* int phi_A N2_B [length^2] */
} ContactIntegrals;
PETSC_INTERN void ContactIntegrate(const ContactOverlap *, const PetscReal x1[12], const PetscReal x2[12],
  const PetscReal normals[12], ContactIntegrals *);

/* contact.c, linearize.c, initial_overlap.c: the object's life, its gap, and the error where bodies overlap deeper
   than it looks, public */

#endif
