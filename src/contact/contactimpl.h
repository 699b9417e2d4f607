/*
   Contact, private: the map of src/contact. From one facet to the object, every file builds on those before it.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include <contact.h>

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

/* facet.c: bilinear facets */
PETSC_INTERN void      ContactShape(const PetscReal xi[2], PetscReal phi[4]);
PETSC_INTERN void      ContactFacetAreaVector(const PetscReal x[12], PetscReal a[3]);
PETSC_INTERN void      ContactFacetTangents(const PetscReal x[12], const PetscReal xi[2], PetscReal t1[3], PetscReal t2[3]);
PETSC_INTERN PetscReal ContactFacetMass(const PetscReal x[12], PetscReal mass[4]);
PETSC_INTERN void      ContactInverseMap(const PetscReal q[4][2], const PetscReal y[2], PetscReal xi[2]);

/* patch.c: the smooth surface a facet stands for */
typedef struct {
  PetscReal slope[4][2], direction[4][3]; /* of the edge from vertex e to the next, at both ends [length]; what it is bent along */
  PetscReal normal[12];                   /* unit, at the vertices */
} ContactPatch;
PETSC_INTERN void      ContactPatchCreate(const PetscReal x[12], const PetscReal normal[12], ContactPatch *);
PETSC_INTERN PetscReal ContactPatchBulge(const ContactPatch *);
PETSC_INTERN void      ContactPatchEvaluate(const ContactPatch *, const PetscReal xi[2], PetscReal offset[3], PetscReal normal[3]);
PETSC_INTERN PetscReal ContactPatchDistance(const PetscReal r[3], const PetscReal n[3], const PetscReal direction[3]);

/* frame.c: the plane a nonmortar facet is projected to */
typedef struct {
  PetscReal origin[3], axis[3][3];
} ContactFrame;
PETSC_INTERN PetscBool ContactFacetNormal(const PetscReal x[12], PetscReal n[3]);
PETSC_INTERN PetscBool ContactFrameCreate(const PetscReal x[12], ContactFrame *);
PETSC_INTERN void      ContactFrameProject(const ContactFrame *, const PetscReal x[12], PetscReal p[4][2], PetscReal height[4]);

/* clip.c: convex polygons in the plane, vertices counterclockwise */
#define CONTACT_MAX_POLYGON 32
PETSC_INTERN PetscReal ContactPolygonArea(PetscInt n, const PetscReal p[][2]);
PETSC_INTERN PetscInt  ContactClip(PetscInt n, const PetscReal subject[][2], PetscInt nclip, const PetscReal clip[][2], PetscReal out[][2]);

/* overlap.c: where a nonmortar and a mortar facet face each other. With these points, weights and the nodal normals
   frozen, the weighted gap is linear in the coordinates. */
#define CONTACT_MAX_POINTS (CONTACT_MAX_POLYGON * CONTACT_RULE_POINTS)
typedef struct {
  PetscInt  n;
  PetscReal area;                       /* of the overlap in the nonmortar facet's plane [length^2] */
  PetscReal weight[CONTACT_MAX_POINTS]; /* [length^2] */
  PetscReal xi1[CONTACT_MAX_POINTS][2]; /* on the nonmortar facet */
  PetscReal xi2[CONTACT_MAX_POINTS][2]; /* on the mortar facet */
} ContactOverlap;
typedef struct {
  PetscReal cosine, overlap_drop, distance, depth;
} ContactOverlapLimits;
PETSC_INTERN PetscBool ContactOverlapFind(const PetscReal x1[12], const PetscReal x2[12], const ContactOverlapLimits *, const ContactRule *, ContactOverlap *);

/* closest.c: the point of a facet closest to another point */
PETSC_INTERN PetscReal ContactClosestPoint(const PetscReal x[12], const PetscReal p[3], PetscReal xi[2], PetscReal y[3]);

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
  char      *name;
  PetscInt   nfacets;
  PetscInt  *vertex;    /* [4 nfacets] local DMPlex points, counterclockwise seen from outside */
  PetscInt  *node;      /* [4 nfacets] global numbers of the vertices: a third of their first global row */
  PetscReal *reference; /* [12 nfacets] coordinates of the undeformed vertices [length] */
  PetscReal *x;         /* [12 nfacets] coordinates of the deformed vertices [length] */
  PetscReal *patch;     /* [12 nfacets] unit normals of the smooth deformed surface at the vertices */
  PetscBool  patched;   /* whether there are those; the same on all ranks */
  PetscInt  *border;    /* [nfacets] bit a: the edge from vertex a to the next is on the face's border; bit 4 + a: vertex a is */
  PetscBool  bordered;  /* whether border has been asked for; the same on all ranks */
  PetscReal  area;      /* of the whole undeformed face, all ranks [length^2] */
  PetscInt   body;      /* behind the face */
  PetscReal  thickness; /* mean thickness of that body [length] */
} ContactSurface;
PETSC_INTERN PetscErrorCode ContactSurfaceCreate(DM, const char[], const PetscReal thickness[], ContactSurface *);
PETSC_INTERN PetscErrorCode ContactVerticesDeform(DM, Vec ulocal, PetscInt n, const PetscInt vertex[], PetscReal x[]);
PETSC_INTERN PetscErrorCode ContactSurfaceDeform(DM, Vec ulocal, ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceNormals(DM, const ContactSurface *, PetscReal normal[], PetscInt n, const PetscInt vertex[], PetscReal vertexnormal[]);
PETSC_INTERN PetscErrorCode ContactSurfaceDestroy(ContactSurface *);

/* border.c: fills in a surface's border */
PETSC_INTERN PetscErrorCode ContactSurfaceFindBorder(DM, ContactSurface *);

/* exchange.c: mortar facets that may face this rank's part of the nonmortar face, whoever owns them */
typedef struct {
  PetscInt   n;
  PetscInt  *node;   /* [4 n] */
  PetscInt  *border; /* [n] where the surface is bordered */
  PetscReal *x;      /* [12 n] */
  PetscReal *patch;  /* [12 n] where the surface is patched */
} ContactCandidates;
PETSC_INTERN PetscErrorCode ContactExchange(MPI_Comm, const PetscReal box[6], const ContactSurface *, ContactCandidates *);
PETSC_INTERN PetscErrorCode ContactCandidatesDestroy(ContactCandidates *);

/* ring.c: the facets about those of this rank, two deep, and who is next to whom. Corner 4 f + a is vertex a of facet f */
typedef struct {
  PetscInt   nfacets, own;  /* the surface's own facets are the nfacets of it from number own on */
  PetscInt   nnodes, *node; /* [4 nfacets] number from 0 of the node at a corner */
  PetscInt  *twin;          /* [4 nfacets] corner whose edge to the next vertex is the same, seen from the other side; negative: sharp, or on the border */
  PetscReal *reference, *x; /* [3 nnodes] coordinates of the nodes, undeformed and deformed [length] */
  Vec        u;             /* displacements of the nodes */
  VecScatter scatter;
} ContactRing;
PETSC_INTERN PetscInt       ContactCornerAfter(PetscInt corner);
PETSC_INTERN PetscInt       ContactCornerBefore(PetscInt corner);
PETSC_INTERN PetscErrorCode ContactRingCreate(MPI_Comm, Vec u, PetscReal cosine, const ContactSurface *, ContactRing *);
PETSC_INTERN PetscErrorCode ContactRingDeform(Vec u, ContactRing *);
PETSC_INTERN PetscBool      ContactRingFan(const ContactRing *, PetscInt corner, PetscInt *first, PetscInt *last);
PETSC_INTERN void           ContactRingEdges(const ContactRing *, PetscInt corner, PetscReal after[3], PetscReal before[3]);
PETSC_INTERN PetscErrorCode ContactRingDestroy(ContactRing *);

/* bend.c: normals of the smooth surface, from the facets' corners */
PETSC_INTERN void ContactRingNormal(const ContactRing *, PetscInt corner, PetscReal normal[3]);

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
PETSC_INTERN void ContactFindNearest(const ContactTree *, const ContactCandidates *, PetscReal cosine, PetscReal reach, const PetscReal x[3], const PetscReal normal[3], ContactNearest *);

/* search.c: of each of this rank's nonmortar facets f, the candidates facet[offset[f]] to facet[offset[f + 1] - 1] along its normal */
typedef struct {
  PetscInt *offset, *facet;
} ContactNear;
PETSC_INTERN PetscErrorCode ContactSearch(const ContactSurface *nonmortar, PetscReal distance, PetscReal depth, const ContactCandidates *, ContactNear *);
PETSC_INTERN PetscErrorCode ContactNearDestroy(ContactNear *);

/* The object */
typedef struct {
  ContactSurface mortar, nonmortar;
  ContactRing    mortar_ring, nonmortar_ring; /* where the surfaces are patched */
  GapType        gap;
  PetscBool      smooth;   /* whether the gap is to be that of the smooth surfaces */
  PetscReal      bulge;    /* these stand off the undeformed facets of the two faces by no more than this together [length] */
  PetscReal      given;    /* the pair's own search distance; 0: from the size of the faces [length] */
  PetscInt      *row;      /* [4 nonmortar facets] global row of each of the facets' vertices */
  PetscReal     *normal;   /* [12 nonmortar facets] averaged unit normals at the facets' vertices */
  PetscReal      distance; /* facets farther apart than this do not pair [length] */
  PetscReal      depth;    /* nor do facets that penetrate more than this: they look through a body [length] */
  PetscInt       nfacing;  /* of the last linearization, on this rank: facets that overlap, or vertices that face a facet */
} ContactPairData;

/* All rows there may be, before any is dropped: for each pair in turn, the nonmortar vertices this rank owns */
typedef struct {
  PetscInt   nlocal, *first; /* rows first[p] to first[p + 1] - 1 of this rank belong to pair p */
  PetscInt  *vertex;         /* [nlocal] local DMPlex points */
  PetscReal *normal;         /* [3 nlocal] averaged unit normals */
  PetscReal *x;              /* [3 nlocal] coordinates of the deformed vertices [length] */
  Vec        mass;           /* int phi_A over the whole undeformed nonmortar face [length^2] */
} ContactRows;

/* Along what a mortar gap is measured */
typedef enum {
  CONTACT_NORMALS_NODAL, /* the averaged normal of the row's vertex */
  CONTACT_NORMALS_FACET  /* the normal of each nonmortar facet */
} ContactNormals;

struct _n_Contact {
  DM               dm;
  MPI_Comm         comm;
  PetscInt         npairs;
  ContactPairData *pairs;
  ContactRows      rows;
  ContactNormals   normals;
  PetscReal        feature_angle; /* edges sharper than this stay sharp [degrees] */
  PetscBool        smoothed;      /* whether it has been looked which pairs are curved */
  ContactRule      rule;          /* of the triangles that overlaps are cut into */
  PetscReal        reach;         /* distance that pairs without one of their own look for at least [length] */
  PetscReal        reach_depth;   /* depth that every pair looks for at least, whatever the angle of the normals; 0: as usual [length] */
  PetscReal        depth;         /* 0: from the thickness of the bodies */
  PetscReal        cosine;        /* facets pair when n1.n2 is at most this */
  PetscReal        overlap_drop;  /* relative to the smaller facet's area */
  PetscReal        row_drop;      /* relative to the largest row's 1-norm */
  PetscInt         nrows;         /* of the last linearization, on all ranks */
};

/* rows.c: the rows there may be */
PETSC_INTERN PetscErrorCode ContactRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactRowsDestroy(Contact);

/* smooth.c: which pairs are curved, and their smooth surfaces */
PETSC_INTERN PetscErrorCode ContactSmoothDeform(Contact, Vec u);
PETSC_INTERN PetscErrorCode ContactSmoothReset(Contact);

/* assemble.c: one linearization under construction. entries: (row, node, value), added up where they repeat */
typedef struct {
  Vec          gap;        /* int phi_A gap [length^3] */
  PetscInt     n, size;    /* entries in use, and space for them */
  PetscInt    *row, *node; /* global row, global number of the vertex */
  PetscInt     dim;        /* 1: one value an entry, for all have the row's normal; 3: a vector */
  PetscScalar *value[3];   /* int phi_A (N2 - N1) [length^2]: times the normal, what the vertex's displacement adds to the gap */
} ContactAssembly;
PETSC_INTERN PetscErrorCode ContactAssemblyCreate(Contact, ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyAdd(ContactAssembly *, PetscInt row, PetscInt n, const PetscInt node[], const PetscReal value[], const PetscReal normal[3]);
PETSC_INTERN PetscErrorCode ContactAssemblyDestroy(ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyFinish(Contact, ContactAssembly *, ContactLinearization *);

/*
   mortar.c, node.c: formulations of the gap.

   A new formulation is one file with a ContactGapOps, one line in linearize.c, and its name in src/scene/formulation.c.
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
PETSC_INTERN void ContactIntegrate(const ContactOverlap *, const PetscReal x1[12], const PetscReal x2[12], const PetscReal normals[12], ContactIntegrals *);
PETSC_INTERN void ContactIntegratePatches(const ContactOverlap *, const PetscReal x1[12], const ContactPatch *, const ContactPatch *, const PetscReal normals[12], PetscReal gap[4]);

/* contact.c, linearize.c, deep.c: the object's life, its gap, and the error where bodies overlap deeper than it looks, public */

#endif
