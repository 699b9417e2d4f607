/*
   Smooth surfaces through facets: patches, normals and their derivatives.
*/
#ifndef SMOOTHIMPL_H
#define SMOOTHIMPL_H

#include "src/contact/search/searchimpl.h"
#include "src/mesh/query/queryimpl.h"

/* patch.c: the smooth surface over a facet */
typedef struct {
  /* Edge e, from vertex e to the next, is a cubic curve whose height over the chord is measured along the unit vector
     direction[e]. slope[e]: derivatives of the height with respect to the position eta in [0, 1], at both ends
     [length] */
  PetscReal slope[4][2], direction[4][3];
  PetscReal normal[12]; /* unit normals at the vertices */
  PetscBool triangle;
} ContactPatch;
PETSC_INTERN void      ContactPatchCreate(const PetscReal x[12], const PetscReal normal[12], ContactPatch *);
PETSC_INTERN PetscReal ContactPatchBulge(const ContactPatch *);
PETSC_INTERN PetscReal ContactPatchDoubt(const ContactPatch *);
PETSC_INTERN void      ContactPatchEvaluate(const ContactPatch *, const PetscReal xi[2], PetscReal offset[3],
       PetscReal normal[3]);

/* patch_slopes.c: derivatives with respect to the parameters and to rotations of a patch */
PETSC_INTERN void      ContactPatchDifferentiate(const ContactPatch *, const PetscReal xi[2], const PetscReal offset[3],
       const PetscReal normal[3], const PetscReal by_offset[3], const PetscReal by_normal[3], PetscReal by_xi[2],
       PetscReal turn[3]);
PETSC_INTERN PetscReal ContactPatchHeight(const ContactPatch *, const PetscReal xi[2], const PetscReal direction[3],
  PetscReal by_xi[2], PetscReal turn[3]);

/* ring.c: this rank's facets, two layers of facets around them, and their neighbours. Corner 4 f + a is vertex a of
   facet f. */
typedef struct {
  PetscInt of, plane[3]; /* number of the real node of a mirror image; for each axis, a real node on the mirror plane
                            perpendicular to it, or -1 if the image is not mirrored along that axis */
} ContactImage;
typedef struct {
  PetscInt   nfacets, own; /* number of facets; the facets that this rank owns are numbers own, own + 1, ... */
  PetscInt   nnodes;
  MeshFacets s;           /* the facets and the deformed coordinates of the nodes */
  PetscInt   nreal;       /* number of nodes of the mesh; nodes with numbers from nreal on are mirror images of these */
  PetscInt  *prescribed;  /* [nnodes] bit c is set if the face is held along axis c */
  PetscInt   nnormals;    /* number of normals at the corners of the facets that this rank owns. Corners of a node share
                          one normal unless a sharp edge separates them. */
  PetscInt  *normal, *at; /* [4 own facets] number of the normal at each corner; [nnormals] a corner that has the
                             normal */
  PetscReal *reference;   /* [3 nreal] undeformed coordinates of the nodes [length] */
  Vec        u;           /* [3 nreal] displacements of the nodes [length] */
  VecScatter scatter;     /* gathers u from the displacement of the mesh */

  ContactImage *image; /* [nnodes - nreal] the mirror images */
} ContactRing;
PETSC_INTERN void           ContactRingReflect(ContactRing *, PetscInt node);
PETSC_INTERN PetscErrorCode ContactRingDeform(Vec u, ContactRing *);
PETSC_INTERN PetscErrorCode ContactRingDestroy(ContactRing *);

/* mirror.c: adds the mirror images of a ring in the symmetry planes on which the surface ends */
PETSC_INTERN PetscErrorCode ContactRingAddImages(MPI_Comm, PetscReal length, PetscInt nown, ContactRing *);

/* ring_create.c: creates a ring */
PETSC_INTERN PetscErrorCode ContactRingCreate(MPI_Comm, Vec u, PetscReal cosine, const ContactSurface *, ContactRing *);

/* overlap_slopes.c: the weighted gap between two smooth surfaces over an overlap, and its derivatives with respect to
   the vertices of one facet */
typedef struct {
  PetscReal rigid[4][12]; /* derivatives of int phi_A gap, for the four A, with respect to the facet's vertices, if the
                             patches keep their shape and rotate with their facets [length^2] */
  PetscReal cover[4][12]; /* derivatives of int phi_A with respect to the vertices [length] */
} ContactSlopes;
PETSC_INTERN void ContactOverlapSlopes(const ContactOverlap *, const ContactRule *, const PetscReal x1[12],
  const PetscReal x2[12], const ContactPatch *, const ContactPatch *, PetscReal gap[4], PetscReal cover[4],
  ContactSlopes *nonmortar, ContactSlopes *mortar);

#endif
