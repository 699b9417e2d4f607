/*
   Private header of mesh/supports. Each body has six rigid body modes: a translation t and a rotation r, which move the
   point x by t + r x (x - center)/size. Links between the bodies restrain them. A mode outside the span of the
   restraints is free, and the stiffness is singular for it.
*/
#ifndef SUPPORTSIMPL_H
#define SUPPORTSIMPL_H

#include "src/mesh/meshimpl.h"

#define SUPPORT_BLOCK 12 /* number of modes of the two bodies of a link */

/* A link: the restraints, as rows of a matrix, of one displacement, spring, connector, contact pair or tie */
typedef struct {
  PetscInt body[2]; /* The second body is -1 if the link is between the first body and the ground. */
} SupportLink;

typedef struct {
  DM       dm;
  PetscInt nbodies;              /* number of bodies, each with 6 modes */
  PetscReal (*center)[3], *size; /* centre, and half of the largest side, of each body's bounding box [length] */
  PetscInt     nlinks;
  SupportLink *links;
  PetscReal (*gram)[SUPPORT_BLOCK * SUPPORT_BLOCK]; /* for each link, the sum of the outer products of its rows */
  PetscReal (*motion)[2][36];   /* for each frictionless contact pair and each of its bodies: the matrix whose quadratic
                                 form is the mean square velocity of the body's modes on the nonmortar face; 0 for other
                                 links */
  PetscBool centres;            /* whether curved contact pairs have rows at centres of facets */
  PetscBool pair;               /* whether the last link is a frictionless contact pair */
  PetscReal row[SUPPORT_BLOCK]; /* row of the last link that is being computed */
} Support;

/* links.c: sizes of the bodies (collective), and rows of the last link */
PETSC_INTERN PetscErrorCode SupportMeasureBodies(Support *);
PETSC_INTERN void           SupportBeginLink(Support *, PetscInt a, PetscInt b);
PETSC_INTERN void           SupportAddMotion(Support *, PetscInt b, const PetscReal direction[3], const PetscReal x[3],
            PetscReal sign);
PETSC_INTERN void           SupportMeasureMotion(Support *, const PetscReal x[3], PetscReal weight);
PETSC_INTERN PetscErrorCode SupportAddRow(Support *, PetscReal weight);

/* A face: its facets on this rank, its body, and the number of its facets on all ranks. The weights of its rows are
   divided by this number, so that every face has equal weight. */
typedef struct {
  IS       facets;
  PetscInt body, total;
} SupportFace;

/*
   facets.c: rows at the facets of a face. SupportGetFace() is collective; SupportDestroyFace() frees the face.
   SupportAddFacets() restrains the motion of the face's body relative to the body `other`, or to the ground if `other`
   is negative. along: the axes of the restrained components; NULL: the component along `normal`, or along the normal of
   each facet if `normal` is NULL. centres: at the centres of the facets instead of their vertices, as
   round bodies need it: the normals at the centres meet the axis.
*/
PETSC_INTERN PetscErrorCode SupportGetFace(Support *, const char face[], SupportFace *);
PETSC_INTERN PetscErrorCode SupportDestroyFace(SupportFace *);
PETSC_INTERN PetscErrorCode SupportAddFacets(Support *, const SupportFace *, PetscInt other, const PetscBool along[3],
  const PetscReal normal[3], PetscBool centres);

/* restraints.c: the links of everything in the scene that holds bodies, summed over the ranks. Collective. */
PETSC_INTERN PetscErrorCode SupportAddScene(Support *, Scene);

/* free_modes.c */
PETSC_INTERN PetscErrorCode SupportFindNull(PetscInt n, PetscReal matrix[], PetscInt *nfree);
PETSC_INTERN PetscErrorCode SupportGetFree(const Support *, PetscReal outside[]);

/* gliding.c: bodies that glide along their contact faces if all others are held */
PETSC_INTERN PetscErrorCode SupportFindGliding(const Support *, PetscBool glides[], MeshRotation rotations[]);

#endif
