/*
   Search: facets of two faces that are near each other, on any rank.
*/
#ifndef SEARCHIMPL_H
#define SEARCHIMPL_H

#include "src/contact/surface/surfaceimpl.h"

/* exchange.c: mortar facets of all ranks that may face this rank's part of the nonmortar face */
typedef struct {
  PetscInt   n;
  PetscInt  *node;      /* [4 n] */
  PetscInt  *border;    /* [n] NULL unless the surface's border is known */
  PetscReal *x;         /* [12 n] */
  PetscReal *patch;     /* [12 n] NULL unless the surface is smooth */
  PetscInt  *normal_id; /* [4 n] global numbers of the normals, with patch */
} ContactCandidates;
PETSC_INTERN PetscErrorCode ContactExchange(MPI_Comm, const PetscReal box[6], const ContactSurface *,
  ContactCandidates *);
PETSC_INTERN PetscErrorCode ContactCandidatesDestroy(ContactCandidates *);

/* tree.c: a static tree of facets' bounding boxes, stored depth first: a node's first child follows it */
#define CONTACT_TREE_DEPTH 128 /* depth of a tree of median splits is below this for any PetscInt number of facets */
typedef struct {
  PetscReal box[6];      /* lower corner, upper corner of the node's box */
  PetscInt  first, last; /* facets of a leaf: order[first] to order[last - 1] */
  PetscInt  second;      /* index of the second child; 0 in a leaf */
} ContactTreeNode;
typedef struct {
  PetscInt         nnodes;
  ContactTreeNode *node;
  PetscInt        *order;
  PetscReal       *box; /* [6 n] boxes of the facets */
} ContactTree;
PETSC_INTERN PetscErrorCode ContactTreeCreate(const ContactCandidates *, ContactTree *);
PETSC_INTERN PetscErrorCode ContactTreeDestroy(ContactTree *);

/* nearest.c: the nearest facet that faces a vertex */
typedef struct {
  PetscInt  facet; /* index among the candidates; negative: none */
  PetscReal xi[2]; /* parameters of its closest point */
  PetscReal y[3];
} ContactNearest;
PETSC_INTERN void ContactFindNearest(const ContactTree *, const ContactCandidates *, PetscReal cosine, PetscReal reach,
  const PetscReal x[3], const PetscReal normal[3], ContactNearest *);

/* search.c: nonmortar facet f has the candidates facet[offset[f]] to facet[offset[f + 1] - 1] */
typedef struct {
  PetscInt *offset, *facet;
} ContactNear;
PETSC_INTERN PetscErrorCode ContactSearch(const ContactSurface *nonmortar, PetscReal distance, PetscReal depth,
  const ContactCandidates *, ContactNear *);
PETSC_INTERN PetscErrorCode ContactNearDestroy(ContactNear *);

#endif
