/*
   The smooth surface that facets stand for: patches, normals and what they change with.
*/
#ifndef SMOOTHIMPL_H
#define SMOOTHIMPL_H

#include "src/contact/search/searchimpl.h"

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

/* ring.c: the facets about those of this rank, two deep, and who is next to whom. Corner 4 f + a is vertex a of facet
   f */
typedef struct {
  PetscInt of,
    plane[3]; /* number of the real node, and real nodes on the mirror planes in which it is an image; negative: none */
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
#define CONTACT_FLAT_CORNER 1e-4 /* squared sine of a facet's angle below which the corner counts as straight */
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
  PetscScalar *value; /* [9 n] derivatives of the three components by the node's three coordinates; to be added where
                         nodes repeat */
} ContactNormalSlopes;
PETSC_INTERN void ContactRingNormalSlopes(const ContactRing *, PetscInt corner, ContactNormalSlopes *);

/* overlap_slopes.c: the weighted gap of two smooth surfaces over an overlap, and its derivatives */
typedef struct {
  PetscReal x[4][12],
    normal[4][12];        /* of int phi_A gap, for the four A: by a facet's vertices, and by the unit normals there */
  PetscReal rigid[4][12]; /* by its vertices, with patches of fixed shape that turn with their facets */
  PetscReal cover[4][12]; /* of int phi_A, by its vertices */
} ContactSlopes;
PETSC_INTERN void ContactOverlapSlopes(const ContactOverlap *, const ContactRule *, const PetscReal x1[12],
  const PetscReal x2[12], const ContactPatch *, const ContactPatch *, PetscReal gap[4], PetscReal cover[4],
  ContactSlopes *nonmortar, ContactSlopes *mortar);

#endif
