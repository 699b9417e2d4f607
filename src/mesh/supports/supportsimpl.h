/*
   Private header of mesh/supports. Each body has six rigid body modes: a translation t and a rotation r, which move the
   point x by t + r x (x - center)/size. Links between the bodies restrain them. A mode outside the span of the
   restraints is free, and the stiffness is singular for it. Weak springs are no restraints.
*/
#ifndef SUPPORTSIMPL_H
#define SUPPORTSIMPL_H

#include "src/mesh/meshimpl.h"

#define SUPPORT_BLOCK 12 /* number of modes of the two bodies of a link */

/* Kinds of links. Displacements, springs, connectors, equations, ties and cyclic symmetry are fixed; contact pairs have
   friction or slide. */
typedef enum { SUPPORT_FIXED, SUPPORT_FRICTION, SUPPORT_SLIDING } SupportKind;

/* A link: the restraints, as rows of a matrix, of one displacement, spring, connector, equation, contact pair or tie */
typedef struct {
  PetscInt    body[2]; /* The second body is -1 if the link is between the first body and the ground. */
  SupportKind kind;
} SupportLink;

/* The faces of a body in frictionless contact pairs: matrices whose quadratic forms are the mean square velocities of
   the body's modes on these faces, along their normals and in all directions */
typedef struct {
  PetscReal normal[36], motion[36];
} SupportContact;

typedef struct {
  DM       dm;
  Vec      u;                    /* displacements of the nodes of this rank [length]; NULL: none */
  PetscInt nbodies;              /* number of bodies, each with 6 modes */
  PetscReal (*center)[3], *size; /* centre, and half of the largest side, of each body's bounding box [length] */
  PetscInt     nlinks;
  SupportLink *links;
  PetscReal (*gram)[SUPPORT_BLOCK * SUPPORT_BLOCK]; /* for each link, the sum of the outer products of its rows */
  SupportContact *contact;                          /* [nbodies] */
  PetscReal (*outside)[6]; /* free part of each mode of each body: the square of its projection onto the free motions */
  PetscReal once;          /* weight of a row that all ranks know: 1 on the first rank, 0 on the others */
  PetscReal row[SUPPORT_BLOCK]; /* row of the last link that is being computed */
} Support;

/* links.c: positions of vertices; sizes of the bodies (collective); restraints as rows, which are added to the link
   that was begun last */
PETSC_INTERN PetscErrorCode SupportGetPlaces(const Support *, PetscInt n, const PetscInt vertices[], PetscReal x[][3]);
PETSC_INTERN PetscErrorCode SupportMeasureBodies(Support *, Vec u);
PETSC_INTERN void           SupportBeginLink(Support *, PetscInt a, PetscInt b, SupportKind);
PETSC_INTERN void SupportSetRow(const Support *, PetscInt b, const PetscReal direction[3], const PetscReal x[3],
  PetscReal sign, PetscReal row[6]);
PETSC_INTERN void SupportAddMotion(Support *, PetscInt b, const PetscReal direction[3], const PetscReal x[3],
  PetscReal sign);
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
   each facet if `normal` is NULL. SupportMeasureFace() adds a face of a frictionless pair to `contact` of its body.
*/
PETSC_INTERN PetscErrorCode SupportGetFace(Support *, const char face[], SupportFace *);
PETSC_INTERN PetscErrorCode SupportDestroyFace(SupportFace *);
PETSC_INTERN PetscErrorCode SupportAddFacets(Support *, const SupportFace *, PetscInt other, const PetscBool along[3],
  const PetscReal normal[3]);
PETSC_INTERN PetscErrorCode SupportMeasureFace(Support *, const SupportFace *);

/*
   restraints.c: SupportCreate() creates the links of everything in the scene that holds bodies at the displacement u, a
   global vector or NULL. most: the last kind of links. Free with SupportDestroy(). Collective.
*/
PETSC_INTERN PetscErrorCode SupportCreate(DM, Scene, Vec u, SupportKind most, Support *);
PETSC_INTERN PetscErrorCode SupportDestroy(Support *);

/* free_modes.c: the motions that no link prevents */
PETSC_INTERN void           SupportAddBlock(const Support *, PetscInt link, PetscInt end, PetscReal block[36]);
PETSC_INTERN PetscErrorCode SupportFindNull(PetscInt n, PetscReal matrix[], PetscInt *nfree);
PETSC_INTERN PetscErrorCode SupportFindFree(Support *, PetscInt *n, Mat *motions);

/* gliding.c: bodies that glide along their contact faces if all others are held */
PETSC_INTERN PetscErrorCode SupportFindGliding(const Support *, PetscBool glides[], MeshRotation rotations[]);

#endif
