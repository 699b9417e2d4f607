/*
   Smooth surfaces through facets: patches, normals and their derivatives.
*/
#ifndef SMOOTHIMPL_H
#define SMOOTHIMPL_H

#include "src/contact/search/searchimpl.h"

/* patch.c: the smooth surface through a facet */
typedef struct {
  PetscReal slope[4][2],
    direction[4][3]; /* edge from vertex e to the next is a cubic curve: its slopes at both ends [length] along the unit
                           vector `direction` */
  PetscReal normal[12]; /* unit, at the vertices */
  PetscBool triangle;
} ContactPatch;
PETSC_INTERN void      ContactPatchCreate(const PetscReal x[12], const PetscReal normal[12], ContactPatch *);
PETSC_INTERN PetscBool ContactPatchIsBent(const ContactPatch *, PetscInt edge);
PETSC_INTERN PetscReal ContactPatchBulge(const ContactPatch *);
PETSC_INTERN void      ContactPatchEvaluate(const ContactPatch *, const PetscReal xi[2], PetscReal offset[3],
       PetscReal normal[3]);

/* patch_slopes.c: derivatives of quantities at a patch's points. `by` is a patch that holds the derivative by each
   of its coefficients */
PETSC_INTERN void ContactPatchDifferentiate(const ContactPatch *, const PetscReal xi[2], const PetscReal by_offset[3],
  const PetscReal by_normal[3], PetscReal by_xi[2], ContactPatch *by);
PETSC_INTERN PetscReal ContactPatchHeight(const ContactPatch *, const PetscReal xi[2], const PetscReal direction[3],
  PetscReal by_xi[2], ContactPatch *by);
PETSC_INTERN void      ContactPatchChain(const PetscReal x[12], const ContactPatch *, const ContactPatch *by,
       PetscReal by_x[12], PetscReal by_normal[12]);
PETSC_INTERN void      ContactPatchMoment(const ContactPatch *, const ContactPatch *by, PetscReal moment[3]);

/* ring.c: this rank's facets, two layers around them, and their neighbours. Corner 4 f + a is vertex a of facet f */
typedef struct {
  PetscInt of, plane[3]; /* number of the real node, and of one real node on each mirror plane in which it is an image;
                 negative: none */
} ContactImage;
typedef struct {
  PetscInt   nfacets, own;  /* the surface's own facets are numbers own, own + 1, ... */
  PetscInt   nnodes, *node; /* nnodes; node[4 nfacets]: number of the node at a corner */
  PetscInt  *twin;          /* [4 nfacets] corner with the same edge in the neighbouring facet; negative: sharp edge or
                       border */
  PetscInt   nreal;         /* nodes from this number on are mirror images of earlier ones */
  PetscInt  *global;        /* [nreal] global numbers of the nodes */
  PetscInt  *held;          /* [nnodes] bits of the axes along which the face is held */
  PetscInt   nnormals;      /* number of normals at the surface's own corners on this rank; corners share one unless a
                          sharp edge separates them */
  PetscInt  *normal, *at;   /* normal[4 own facets]: number of the normal at a corner; at[nnormals]: a corner with
                               that normal */
  PetscReal *reference, *x; /* reference[3 nreal], x[3 nnodes]: undeformed and deformed coordinates of the nodes
                               [length] */
  Vec        u;             /* displacements of the nodes */
  VecScatter scatter;

  ContactImage *image; /* [nnodes - nreal] the mirror images */
} ContactRing;
PETSC_INTERN PetscInt       ContactCornerAfter(const ContactRing *, PetscInt corner);
PETSC_INTERN PetscInt       ContactCornerBefore(const ContactRing *, PetscInt corner);
PETSC_INTERN PetscBool      ContactCornerIsNone(const ContactRing *, PetscInt corner);
PETSC_INTERN void           ContactRingReflect(ContactRing *, PetscInt node);
PETSC_INTERN PetscErrorCode ContactRingDeform(Vec u, ContactRing *);
PETSC_INTERN PetscBool      ContactRingFan(const ContactRing *, PetscInt corner, PetscInt *first, PetscInt *last);
PETSC_INTERN void ContactRingEdges(const ContactRing *, PetscInt corner, PetscReal after[3], PetscReal before[3]);
PETSC_INTERN PetscErrorCode ContactRingDestroy(ContactRing *);

/* corner_normals.c: normals of the smooth surface at the facets' corners */
#define CONTACT_FLAT_CORNER \
  1e-4 /* a facet's corner counts as straight if the squared sine of its angle is below
                                    this */
PETSC_INTERN PetscReal ContactRingFanNormal(const ContactRing *, PetscInt first, PetscInt last, PetscReal normal[3]);
PETSC_INTERN void      ContactRingMeanNormal(const ContactRing *, PetscInt corner, PetscReal normal[3]);
PETSC_INTERN void      ContactRingMend(const ContactRing *, PetscInt first, PetscInt last, PetscReal normal[3]);
PETSC_INTERN void      ContactRingNormal(const ContactRing *, PetscInt corner, PetscReal normal[3]);

/* mirror.c: mirror images of a ring in planes on which the surface ends */
PETSC_INTERN PetscErrorCode ContactRingAddImages(MPI_Comm, PetscReal length, PetscInt nown, ContactRing *);

/* ring_create.c: creates a ring */
PETSC_INTERN PetscErrorCode ContactRingCreate(MPI_Comm, Vec u, PetscReal cosine, const ContactSurface *, ContactRing *);

/* corner_normal_slopes.c: derivatives of the normals by the nodes */
typedef struct {
  PetscInt     n;     /* number of blocks */
  PetscInt    *node;  /* [n] node of the ring; NULL: blocks are only counted */
  PetscScalar *value; /* [9 n] derivatives of the three components by the node's three coordinates; repeated nodes
                         are to be added */
} ContactNormalSlopes;
PETSC_INTERN void ContactRingNormalSlopes(const ContactRing *, PetscInt corner, ContactNormalSlopes *);

/* overlap_slopes.c: the weighted gap of two smooth surfaces over an overlap, and its derivatives */
typedef struct {
  PetscReal x[4][12],
    normal[4][12];        /* derivatives of int phi_A gap for the four A: by a facet's vertices, and by the unit
                             normals there */
  PetscReal rigid[4][12]; /* by its vertices, with patches that keep their shape and turn with their facets */
  PetscReal cover[4][12]; /* derivatives of int phi_A by its vertices */
} ContactSlopes;
PETSC_INTERN void ContactOverlapSlopes(const ContactOverlap *, const ContactRule *, const PetscReal x1[12],
  const PetscReal x2[12], const ContactPatch *, const ContactPatch *, PetscReal gap[4], PetscReal cover[4],
  ContactSlopes *nonmortar, ContactSlopes *mortar);

#endif
