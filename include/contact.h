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
  Vec g;     /* gap at u_ref, divided by the lumped mass [length] */
  Vec doubt; /* uncertainty of the gap between smooth surfaces: they may be as much higher than the true ones
                [length] */
  Mat J; /* m x n AIJ, derivative of the gap, dimensionless; columns are the DM's global rows. Patches of smooth pairs
                keep their shape */
  PetscBool gaps_only; /* whether derivatives of smooth pairs are left out, so that J is the derivative for their
                          facets */
  Mat       cover;     /* like J, but for the facets instead of smooth surfaces or order 2; used to distribute areas to
                      vertices. NULL, for J itself, if no pair is smooth or of order 2 */
  /* the parts of J, cover (or J) and slip that belong to the mortar side, in rows of pairs in contact with themselves,
     whose sides have the same vertices; NULL if there are no such pairs */
  Mat        mortar, mortar_cover, mortar_slip;
  Vec        mass;    /* lumped nonmortar mass m_A = int phi_A [length^2] */
  Mat        slip;    /* 2m x n AIJ, dimensionless: displacement of the mortar side relative to the nonmortar side along
                     the two tangents of each row. Rows without friction are empty. NULL if no pair has friction */
  PetscReal *tangent; /* [6 nlocal] the two unit tangents of each row */
  PetscReal *covered; /* [nlocal] int phi_A over the covered part [length^2]; 0 for pairs without friction. NULL if
                         no pair has friction */
  PetscReal *area;    /* [nlocal] lumped area of the nonmortar face around each row's vertex, with which the row was
                         computed [length^2]. NULL if no nonmortar body has a law of finite strain */
  PetscReal *mortar_sum; /* [6 nlocal] sums over the mortar face's nodes of the vectors of J, and of those of
                            `cover`, in the directions at the row's vertex; NULL if no body is a sector of cyclic
                            symmetry */
  PetscReal *normal;     /* [3 nlocal] unit normal of each row, outward from the nonmortar side */
  PetscInt   nlocal;     /* number of rows of this rank */
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
/* The pairs with mortar gaps that use dual shape functions in addition to those of GAP_DUAL: none, those that the scene
   leaves open (GAP_AUTO), or all */
typedef enum { CONTACT_DUAL_NONE, CONTACT_DUAL_AUTO, CONTACT_DUAL_ALL } ContactDualPairs;
PETSC_EXTERN PetscErrorCode ContactSetDual(Contact, ContactDualPairs, PetscBool *changed);
PETSC_EXTERN PetscErrorCode ContactGetDual(Contact, ContactDualPairs *);
/* What ContactLinearize() computes for smooth pairs: only the gap, or also J and lin->cover. For other pairs everything
   is always computed. */
typedef enum { CONTACT_GAPS, CONTACT_FORCES } ContactParts;
/* Collective. Searches, clips and integrates at the global displacement u */
PETSC_EXTERN PetscErrorCode ContactLinearize(Contact, Vec u, ContactParts, ContactLinearization *);
/* Collective. Computes by how much the nonmortar faces have grown at u since a linearization, around each row's vertex.
   Call this function only if lin->area is not NULL. */
PETSC_EXTERN PetscErrorCode ContactGetStretch(Contact, Vec u, ContactLinearization lin, PetscReal stretch[]);
/* Finds whether a body of a pair ends inside the other one, through faces that are not the pair's */
PETSC_EXTERN PetscErrorCode ContactGetEntered(Contact, PetscInt pair, Vec u, PetscReal margin, PetscBool *entered,
  PetscReal place[3]);
/* Collective. Determines whether the faces of a pair look away from each other everywhere. turns: whether bodies may
   rotate by large angles */
PETSC_EXTERN PetscErrorCode ContactLooksAway(Contact, PetscInt pair, PetscBool turns, PetscBool *away);
/* Determines whether a face of a pair is curved before it deforms */
PETSC_EXTERN PetscErrorCode ContactIsCurved(Contact, PetscInt pair, PetscBool *);
/* Collective. Whether a node (its number in global vectors) is on the edge of a pair's nonmortar face */
PETSC_EXTERN PetscErrorCode ContactIsAtEdge(Contact, PetscInt pair, PetscInt node, PetscBool *);
/* Counts the nodes of a pair's nonmortar face on which no friction acts although the faces slide, after a contact
   update, and all nodes of that face */
PETSC_EXTERN PetscErrorCode ContactGetFrictionless(Contact, PetscInt pair, PetscInt *nfrictionless, PetscInt *nnodes);
/* Collective. Computes, for each pair, the largest penetration of a vertex of either face at a displacement, and the
   uncertainty of this depth [length]. within: pairs for which points in the facets count, too */
PETSC_EXTERN PetscErrorCode ContactGetPenetration(Contact, Vec u, const PetscBool within[], PetscReal depth[],
  PetscReal rounding[]);
/* Collective. Computes the largest depth of vertices of a pair that passed through the other face between u0 and u1,
   and the search depth of the pair [length]. turned: whether a facet rotated by more than 90 degrees */
PETSC_EXTERN PetscErrorCode ContactGetPassage(Contact, PetscInt pair, PetscReal moved, Vec u0, Vec u1, PetscReal *depth,
  PetscReal *reach, PetscBool *turned);
/* Collective. It is an error if undeformed bodies overlap by more than the search depth. */
PETSC_EXTERN PetscErrorCode ContactCheckDepth(Contact);
PETSC_EXTERN PetscErrorCode ContactLinearizationDestroy(ContactLinearization *);
/* Computes, for each node of a nonmortar face, the weights of the nodes of the mortar face to which it is tied */
PETSC_EXTERN PetscErrorCode ContactTieCreate(DM, const char what[], const SceneTie *, Mat *rows);
PETSC_EXTERN PetscErrorCode ContactDestroy(Contact *);

#endif
