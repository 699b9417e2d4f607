/*
   Formulations of the gap.
*/
#ifndef GAPSIMPL_H
#define GAPSIMPL_H

#include "src/contact/assembly/assemblyimpl.h"

/*
   mortar.c, node.c: formulations of the gap.

   A new formulation is one file with a ContactGapOps, one line in linearize.c, and its name in
   src/model/formulation_names.c.
*/
typedef struct {
  /* Enlarges the box to contain everything that may face this rank's part of pair p */
  PetscErrorCode (*box)(Contact, PetscInt p, PetscReal box[6]);
  /* Adds pair p's gap and coupling to the assembly, and counts pair->nfacing */
  PetscErrorCode (*add)(Contact, PetscInt p, const ContactCandidates *, ContactAssembly *);
} ContactGapOps;
PETSC_INTERN const ContactGapOps ContactGapMortar, ContactGapNode, ContactGapRigidSurface;

typedef struct {
  PetscReal gap[4];  /* int phi_A (x2 - x1).n_A [length^3] */
  PetscReal D[4][4]; /* int phi_A N1_B [length^2]; row sums are int phi_A */
  PetscReal M[4][4]; /* int phi_A N2_B [length^2] */
} ContactIntegrals;
/* dual: coefficients of the functions that replace phi_A; NULL: phi_A itself */
PETSC_INTERN void ContactIntegrate(const ContactOverlap *, const PetscReal x1[12], const PetscReal x2[12],
  const PetscReal normals[12], PetscReal (*dual)[4], ContactIntegrals *);

/* dual.c: dual functions of a facet, from its undeformed vertices */
PETSC_INTERN void ContactDualFunctions(const PetscReal x[12], PetscReal dual[4][4]);
PETSC_INTERN void ContactDualTransform(PetscReal (*dual)[4], PetscInt n, PetscReal values[]);
PETSC_INTERN void ContactDualTransformSlopes(PetscReal (*dual)[4], ContactSlopes *);

/* rigid_surface.c: pairs whose mortar side is a rigid surface. Place: call after its face was deformed */
PETSC_INTERN PetscErrorCode ContactSurfacePlace(MPI_Comm, ContactPairData *);
PETSC_INTERN PetscReal      ContactSurfaceDistance(const ContactPairData *, const PetscReal x[3], PetscReal gradient[3],
       PetscReal weight[4]);
PETSC_INTERN PetscErrorCode ContactSurfaceSetNormals(const ContactPairData *, PetscInt n, const PetscReal x[],
  PetscReal normal[]);

#endif
