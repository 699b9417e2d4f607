/*
   Which facets of two faces are near each other, whoever owns them.
*/
#ifndef SEARCHIMPL_H
#define SEARCHIMPL_H

#include "src/contact/surface/surfaceimpl.h"

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

#endif
