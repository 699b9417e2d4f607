/*
   Formulations of the gap.
*/
#ifndef GAPSIMPL_H
#define GAPSIMPL_H

#include "src/contact/assembly/assemblyimpl.h"
#include "src/report/events.h"

/*
   mortar.c, node.c, rigid_surface.c: the formulations of the gap.

   A new formulation is one file with a ContactGapOps, one line in linearize.c, its name in
   src/model/formulation_names.c and its type in include/formulation.h.
*/
typedef struct {
  /* Enlarges the box to contain every mortar facet that may face this rank's part of the nonmortar face of pair p */
  PetscErrorCode (*box)(Contact, PetscInt p, PetscReal box[6]);
  /* Adds the gap of pair p and its couplings to the assembly */
  PetscErrorCode (*add)(Contact, PetscInt p, const ContactCandidates *, ContactAssembly *);
} ContactGapOps;
PETSC_INTERN const ContactGapOps ContactGapMortar, ContactGapNode, ContactGapRigidSurface;

/* Integrals over an overlap. phi_A are the test functions, N1_B and N2_B the shape functions of the nonmortar and of
   the mortar facet. */
typedef struct {
  PetscReal gap[4];  /* int phi_A (x2 - x1).n_A [length^3] */
  PetscReal D[4][4]; /* int phi_A N1_B [length^2]; row sums are int phi_A */
  PetscReal M[4][4]; /* int phi_A N2_B [length^2] */
} ContactIntegrals;
/* Computes the integrals over an overlap. dual: coefficients of the dual functions that replace phi_A; NULL: phi_A =
   N1_A */
PETSC_INTERN void ContactIntegrate(const ContactOverlap *, const PetscReal x1[12], const PetscReal x2[12],
  const PetscReal normals[12], PetscReal (*dual)[4], ContactIntegrals *);

/* dual.c: the coefficients of a facet's dual functions, from the coordinates of its undeformed vertices */
PETSC_INTERN void ContactDualFunctions(const PetscReal x[12], PetscReal dual[4][4]);
PETSC_INTERN void ContactDualTransform(PetscReal (*dual)[4], PetscInt n, PetscReal values[]);
PETSC_INTERN void ContactDualTransformSlopes(PetscReal (*dual)[4], ContactSlopes *);

/* rigid_surface.c: pairs whose mortar side is a rigid surface without facets. ContactSurfacePlace() must be called
   after every motion of the rigid body. */
PETSC_INTERN PetscErrorCode ContactSurfacePlace(MPI_Comm, ContactPairData *);
PETSC_INTERN PetscReal      ContactSurfaceDistance(const ContactPairData *, const PetscReal x[3], PetscReal gradient[3],
       PetscReal weight[4]);
PETSC_INTERN PetscInt       ContactSurfaceFindCorners(const ContactPairData *, const PetscReal ends[6],
        const PetscReal normals[6], SceneSurfaceCorner[2], PetscReal weight[2][4]);
PETSC_INTERN PetscErrorCode ContactSurfaceSetNormals(const ContactPairData *, PetscInt n, const PetscReal x[],
  PetscReal normal[]);

/* rigid_corner.c: corners of rigid profiles between the vertices of the nonmortar face */
PETSC_INTERN PetscErrorCode ContactCornersFind(Contact, PetscInt p);
PETSC_INTERN PetscErrorCode ContactCornersAdd(ContactPairData *, ContactAssembly *);

#endif
