/*
   Contact of a surface with itself.
*/
#ifndef SELFIMPL_H
#define SELFIMPL_H

#include "src/contact/search/searchimpl.h"

/* A facet of a surface in contact with itself: one of this rank, or one of the candidates that were received */
typedef struct {
  const PetscInt  *node;      /* [4] */
  const PetscReal *reference; /* [12] undeformed vertices [length] */
  PetscReal        rank, below;
} ContactSelfFacet;

/* rank.c */
PETSC_INTERN PetscErrorCode   ContactSelfCreate(DM, ContactSurface *);
PETSC_INTERN ContactSelfFacet ContactSelfOwn(const ContactSurface *, PetscInt f);
PETSC_INTERN ContactSelfFacet ContactSelfCandidate(const ContactCandidates *, PetscInt k);

/* wall.c */
PETSC_INTERN PetscBool ContactSelfIsWall(const ContactSelfFacet *, const PetscReal x1[3], const ContactSelfFacet *,
  const PetscReal x2[3]);

/* layers.c */
PETSC_INTERN PetscErrorCode ContactSelfSelect(const ContactSelfFacet *, const ContactCandidates *, PetscInt *n,
  PetscInt mortar[], ContactOverlap overlap[]);

#endif
