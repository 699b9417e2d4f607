/* Contact: the linearized gap between pairs of faces, c(u) = g + J (u - u_ref), with one row for each nonmortar
   vertex. */
#ifndef CONTACT_H
#define CONTACT_H

#include <petscdmplex.h>
#include <petscmat.h>
#include "model.h"

typedef struct _n_Contact *Contact;

/* Data of one contact update. Rows are distributed like their nonmortar vertices. */
typedef struct {
  Vec       g;          /* gap at u_ref, divided by the lumped mass [length] */
  Mat       J;          /* m x n AIJ, derivative of the gap, dimensionless; columns are the DM's global rows */
  Mat       derivative; /* derivative of the gap that includes the rotation of the normals; in J patches of smooth pairs
                     keep their shape. NULL if no pair is smooth, or if it was not asked for */
  PetscBool gaps_only;  /* without derivatives of smooth pairs: J is that of their facets */
  Mat       cover; /* like J, but of the facets; used to share areas among vertices. NULL (use J) if no pair is smooth
                     or of order 2 */
  Mat       mortar, mortar_cover, mortar_slip; /* the parts of J, cover (or J) and slip by the mortar side, in rows of
                     pairs in contact with themselves, whose sides have the same vertices; NULL: there are no such pairs */
  Vec       mass;                              /* lumped nonmortar mass m_A = int phi_A [length^2] */
  Mat       slip; /* 2m x n AIJ, dimensionless: displacement of the mortar side relative to the nonmortar side along the
               two tangents of a row. Rows without friction are empty; NULL: no pair has friction */
  PetscReal *tangent;    /* [6 nlocal] the two unit tangents of each row */
  PetscReal *covered;    /* [nlocal] int phi_A over the covered part [length^2]; 0 for pairs without friction. NULL: no
                         pair has friction */
  PetscReal *mortar_sum; /* [6 nlocal] sums of the vectors of J, and of those of cover, over the nodes of the mortar
                            face, as at the row's vertex; NULL: those of the matrices, no body is cut to a sector */
  PetscReal *normal;     /* [3 nlocal] unit normal of each row, outward from the nonmortar side */
  PetscInt   nlocal;     /* rows of this rank */
  PetscInt  *vertex;     /* nonmortar vertex (local DMPlex point) of each local row */
  PetscInt  *pair;       /* contact pair of each local row */
} * ContactLinearization;

/* Collective. Finds the pairs and ties that the scene's rules (contact: auto) leave open, and adds them to the scene */
PETSC_EXTERN PetscErrorCode ContactDetect(MPI_Comm, Scene);
PETSC_EXTERN PetscErrorCode ContactCreate(DM, PetscInt npairs, const SceneContactPair[], Contact *);
PETSC_EXTERN PetscErrorCode ContactSetFromOptions(Contact);
PETSC_EXTERN PetscErrorCode ContactSetDisplacements(Contact, PetscInt n, const SceneDisplacement[]);
PETSC_EXTERN PetscErrorCode ContactSetBodies(Contact, const SceneBody[]);
PETSC_EXTERN PetscErrorCode ContactSetCyclic(Contact, PetscInt n, const SceneCyclic[]);
PETSC_EXTERN PetscErrorCode ContactGetReach(Contact, PetscReal *distance, PetscReal *depth);
PETSC_EXTERN PetscErrorCode ContactSetReach(Contact, PetscReal distance, PetscReal depth);
PETSC_EXTERN PetscErrorCode ContactSetDual(Contact, PetscBool);
/* Collective. Searches, clips and integrates at the global displacement u */
PETSC_EXTERN PetscErrorCode ContactLinearize(Contact, Vec u, ContactLinearization *);
PETSC_EXTERN PetscErrorCode ContactLinearizeForces(Contact, Vec u, ContactLinearization *);
PETSC_EXTERN PetscErrorCode ContactGetGaps(Contact, Vec u, ContactLinearization *);
/* Whether a face of a pair is curved before it deforms */
PETSC_EXTERN PetscErrorCode ContactIsCurved(Contact, PetscInt pair, PetscBool *);
/* Collective. Whether a node (its number in global vectors) is on the edge of a pair's nonmortar face */
PETSC_EXTERN PetscErrorCode ContactIsAtEdge(Contact, PetscInt pair, PetscInt node, PetscBool *);
/* Number of nodes of a pair's nonmortar face where friction cannot act although the faces slide, after a contact
   update; and number of all its nodes */
PETSC_EXTERN PetscErrorCode ContactGetFrictionless(Contact, PetscInt pair, PetscInt *nfrictionless, PetscInt *nnodes);
/* Collective. Largest penetration of vertices of either face of each pair at a displacement, and its accuracy
   [length] */
PETSC_EXTERN PetscErrorCode ContactGetPenetration(Contact, Vec u, PetscReal depth[], PetscReal rounding[]);
/* Collective. How deep vertices of a pair are that went through the other face from u0 to u1, and how deep contact is
   searched for [length]; turned: a facet turned by more than 90 degrees */
PETSC_EXTERN PetscErrorCode ContactGetPassage(Contact, PetscInt pair, PetscReal moved, Vec u0, Vec u1, PetscReal *depth,
  PetscReal *reach, PetscBool *turned);
/* Collective. Contact update at zero displacement. An error if undeformed bodies overlap deeper than the contact
   search reaches */
PETSC_EXTERN PetscErrorCode ContactCheckDepth(Contact, ContactLinearization);
PETSC_EXTERN PetscErrorCode ContactLinearizationDestroy(ContactLinearization *);
/* For each node of a nonmortar face, the weights of the mortar face's nodes that it is tied to */
PETSC_EXTERN PetscErrorCode ContactTieCreate(DM, const char what[], const SceneTie *, Mat *rows);
PETSC_EXTERN PetscErrorCode ContactView(Contact, PetscViewer);
PETSC_EXTERN PetscErrorCode ContactDestroy(Contact *);

#endif
