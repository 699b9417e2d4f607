/*
   The map of tao_ipfilter/friction: the laws of norm terms, which are friction, on the filtered subspace.
   Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_FRICTIONIMPL_H
#define IPFILTER_FRICTIONIMPL_H

#include "tao_ipfilter/subspace/subspaceimpl.h"

/* system.c */
PETSC_INTERN PetscErrorCode IPTermSystemSetUp(IPTermSystem *, PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R);
PETSC_INTERN PetscErrorCode IPTermSystemDestroy(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemSetRow(IPTermSystem *, PetscInt row, PetscInt n, const PetscInt columns[],
  const PetscReal by_v[], const PetscReal by_f[], PetscReal scale);
PETSC_INTERN PetscErrorCode IPTermSystemAssemble(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemApplyCompliance(IPTermSystem *, const PetscReal f[], PetscReal v[]);

/* factor.c */
PETSC_INTERN PetscErrorCode IPTermFactorPrepare(IPTermSystem *, const IPReducedSystem *, PetscBool *ready);
PETSC_INTERN PetscErrorCode IPTermFactorApply(IPTermSystem *, const PetscReal r[], PetscReal z[]);

/* dense.c */
PETSC_INTERN PetscBool      IPTermDenseFits(const IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermDenseSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rf[], PetscReal ry[],
  PetscBool *solved);

/* solve.c */
PETSC_INTERN PetscErrorCode IPTermSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rtol, PetscReal rf[],
  PetscReal ry[], PetscBool *solved);

/* laws.c */
PETSC_INTERN PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPTermSet *);
PETSC_INTERN PetscErrorCode IPTermLawsDestroy(IPTermSet *);
PETSC_INTERN PetscInt       IPTermLawsRow(const IPTermSet *, PetscInt term);
PETSC_INTERN PetscReal      IPTermLawsBound(const IPTermSet *, const IPReducedSystem *, PetscInt term);
PETSC_INTERN PetscErrorCode IPTermLawsMove(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN void           IPTermLawsRelieve(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsGiveWay(const IPTermSet *, PetscInt row);
PETSC_INTERN void           IPTermLawsResist(IPTermSet *);
PETSC_INTERN void           IPTermLawsMotion(const IPTermSet *, const IPReducedSystem *, PetscInt term, PetscReal v[2]);
PETSC_INTERN PetscReal      IPTermLawsTrial(const IPTermSet *, const IPReducedSystem *, PetscInt term, PetscReal b[2]);
PETSC_INTERN PetscInt       IPTermLawsOfRow(const IPTermSet *, PetscInt row, PetscInt *component);
PETSC_INTERN PetscErrorCode IPTermLawsResidualOfDirections(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsMerit(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscErrorCode IPTermLawsRenew(IPTermSet *, const IPReducedSystem *);

/* path.c */
PETSC_INTERN PetscErrorCode IPTermPathFollow(IPTermSet *, const IPReducedSystem *, PetscInt *steps,
  PetscBool *followed);

/* set.c */
PETSC_INTERN PetscErrorCode IPTermSetSolve(IPTermSet *, const IPReducedSystem *, PetscInt *steps, PetscBool *solved);

#endif
