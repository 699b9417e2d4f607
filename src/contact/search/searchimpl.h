/* Search: facets of two faces that are near each other, on all ranks. */
#ifndef SEARCHIMPL_H
#define SEARCHIMPL_H

#include "src/contact/surface/surfaceimpl.h"
#include <mesh.h>

/* Facets n1 and n2 face each other only if the cosine of the angle between their normals is at most this. */
#define CONTACT_NORMAL_COSINE -0.174
/* default search distance of a contact pair, divided by the square root of the area of its smaller face */
#define CONTACT_SEARCH_FRACTION 0.25

/* exchange.c: the mortar facets of all ranks that may face this rank's part of the nonmortar face */
#define CONTACT_SELF_REALS 14
typedef struct {
  /* number of facets */
  PetscInt   n;
  PetscInt  *node;   /* [4 n] global numbers of the vertices */
  PetscInt  *border; /* [n] as in ContactSurface; NULL unless the surface's border is known */
  PetscReal *x;      /* [12 n] coordinates of the deformed vertices [length] */
  PetscReal *patch;  /* [12 n] unit normals of the smooth surface; NULL unless the surface is smooth */
  PetscReal *self;   /* [CONTACT_SELF_REALS n] of a surface in contact with itself: undeformed vertices, rank, and
                           depth below, as in ContactSurface; else not allocated */
} ContactCandidates;
PETSC_INTERN PetscErrorCode ContactExchange(MPI_Comm, const PetscReal box[6], const ContactSurface *,
  ContactCandidates *);
PETSC_INTERN PetscErrorCode ContactCandidatesDestroy(ContactCandidates *);

/* tree.c: a static tree of the facets' bounding boxes, stored depth first: the first child of node k is node k + 1 */
/* the largest depth of the tree: below this for any number of facets, because the tree splits at medians */
#define CONTACT_TREE_DEPTH 128
typedef struct {
  PetscReal box[6];      /* lower corner and upper corner of the box that contains the node's facets */
  PetscInt  first, last; /* the node's facets are order[first] to order[last - 1] */
  PetscInt  second;      /* number of the second child; 0 if the node is a leaf */
} ContactTreeNode;
typedef struct {
  PetscInt         nnodes;
  ContactTreeNode *node;
  /* [n] numbers of the facets in the order of the leaves */
  PetscInt      *order;
  PetscReal     *box;  /* [6 n] boxes of the facets */
  PetscLogDouble work; /* number of comparisons that building the tree took */
} ContactTree;
PETSC_INTERN PetscErrorCode ContactTreeCreate(const ContactCandidates *, ContactTree *);
PETSC_INTERN PetscErrorCode ContactTreeDestroy(ContactTree *);

/* nearest.c: the nearest facet that faces a vertex */
typedef struct {
  PetscInt  facet; /* number among the candidates; -1: none */
  PetscReal xi[2]; /* parameters of the facet's closest point */
  /* coordinates of the closest point [length] */
  PetscReal y[3];
} ContactNearest;
/* Returns whether the point xi of a facet is accepted as the nearest point; context: data that the function needs */
typedef PetscBool (
  *ContactNearestTest)(const void *context, const ContactCandidates *, PetscInt facet, const PetscReal xi[2]);
PETSC_INTERN void ContactFindNearest(const ContactTree *, const ContactCandidates *, PetscReal cosine, PetscReal reach,
  const PetscReal x[3], const PetscReal normal[3], ContactNearestTest, const void *context, ContactNearest *);

/* search.c: the candidates of nonmortar facet f are facet[offset[f]] to facet[offset[f + 1] - 1] */
typedef struct {
  PetscInt *offset, *facet;
} ContactNear;
PETSC_INTERN PetscErrorCode ContactSearch(const ContactSurface *nonmortar, PetscReal distance, PetscReal depth,
  const ContactCandidates *, ContactNear *);
PETSC_INTERN PetscErrorCode ContactNearDestroy(ContactNear *);

#endif
