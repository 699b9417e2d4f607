/*
   Contact: the linearized gap between pairs of faces, c(u) = g + J (u - u_ref), one row a nonmortar vertex.
*/
#ifndef CONTACT_H
#define CONTACT_H

#include <petscdmplex.h>
#include <petscmat.h>
#include "model.h"

typedef struct _n_Contact *Contact;

/* The constraints of one linearization. Rows are distributed as their nonmortar vertices are. */
typedef struct {
  Vec g;          /* gap at u_ref, weighted and divided by the lumped mass: a length */
  Mat J;          /* m x n AIJ, dimensionless; columns are the DM's global rows */
  Mat derivative; /* of the gap, the normals' turning included; J is that with the patches of smooth pairs keeping their
                     shape. NULL where no pair is smooth */
  Mat cover; /* J of the facets, in whose proportions an area is shared among vertices. NULL where no pair is smooth or
                of order 2: it is J */
  Vec mass;  /* lumped nonmortar mass m_A = int phi_A [length^2] */
  Mat slip; /* 2m x n AIJ, dimensionless: along both tangents of a row, what the mortar side moves along the other. Rows
               of pairs that do not rub are empty; NULL: none does */
  PetscReal *tangent; /* [6 nlocal] of each row, and */
  PetscReal *covered; /* [nlocal] int phi_A over what the mortar side covers [length^2]; 0 where the pair does not rub.
                         NULL where there is no slip */
  PetscReal *normal;  /* [3 nlocal] unit normal of each row, out of the nonmortar side */
  PetscInt   nlocal;  /* rows of this rank */
  PetscInt  *vertex;  /* nonmortar vertex (local DMPlex point) of each local row */
  PetscInt  *pair;    /* contact pair of each local row */
} * ContactLinearization;

PETSC_EXTERN PetscErrorCode ContactCreate(DM, PetscInt npairs, const SceneContactPair[], Contact *);
PETSC_EXTERN PetscErrorCode ContactSetFromOptions(Contact);
PETSC_EXTERN PetscErrorCode ContactSetDisplacements(Contact, PetscInt n, const SceneDisplacement[]);
PETSC_EXTERN PetscErrorCode ContactGetReach(Contact, PetscReal *distance, PetscReal *depth);
PETSC_EXTERN PetscErrorCode ContactSetReach(Contact, PetscReal distance, PetscReal depth);
/* Collective. u: global displacement that deforms the reference coordinates; search, clip, integrate at that state */
PETSC_EXTERN PetscErrorCode ContactLinearize(Contact, Vec u, ContactLinearization *);
/* Nodes of a pair's nonmortar face where friction cannot act though the faces slide, once the gap has been
   linearized; of how many */
PETSC_EXTERN PetscErrorCode ContactGetFrictionless(Contact, PetscInt pair, PetscInt *nfrictionless, PetscInt *nnodes);
/* Collective. How deep vertices of either face of each pair are in the other body at a displacement,
   and what that is known to [length] */
PETSC_EXTERN PetscErrorCode ContactGetPenetration(Contact, Vec u, PetscReal depth[], PetscReal rounding[]);
/* Collective. An error where bodies overlap, undeformed, deeper than contact looks; the linearization is that at zero
   displacement */
PETSC_EXTERN PetscErrorCode ContactCheckDepth(Contact, ContactLinearization);
PETSC_EXTERN PetscErrorCode ContactLinearizationDestroy(ContactLinearization *);
/* Of each node of a nonmortar face the weights of those of the mortar face that it is tied to */
PETSC_EXTERN PetscErrorCode ContactTieCreate(DM, const char what[], const SceneTie *, Mat *rows);
PETSC_EXTERN PetscErrorCode ContactView(Contact, PetscViewer);
PETSC_EXTERN PetscErrorCode ContactDestroy(Contact *);

#endif
