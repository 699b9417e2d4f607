/*
   tao_ipfilter/linear: solvers of linear systems, namely Krylov methods, MUMPS, and methods for equality constraints.
   The files are listed such that each depends only on those before it and on the folders above this one in
   ipfilterimpl.h.
*/
#ifndef IPFILTER_LINEARIMPL_H
#define IPFILTER_LINEARIMPL_H

#include "tao_ipfilter/system/systemimpl.h"

/* residual.c */
PETSC_INTERN PetscErrorCode IPResidualMeasure(Tao, Vec, Vec);
PETSC_INTERN PetscBool      IPResidualReached(const TAO_IPFILTER *, KSPConvergedReason);
PETSC_INTERN PetscErrorCode IPResidualRefine(Tao, Vec, Vec, PetscBool, PetscErrorCode (*)(Tao, Vec, Vec),
  KSPConvergedReason);
PETSC_INTERN PetscErrorCode IPResidualNotANumber(Tao);

/* guard.c */
PETSC_INTERN PetscErrorCode IPGuardedSolve(Tao, KSP, Vec b, Vec x, PetscBool *failed);

/* kspreset.c */
PETSC_INTERN PetscErrorCode IPKSPReset(KSP);

/* krylov.c */
PETSC_INTERN PetscErrorCode IPKrylovRecord(Tao, PetscInt its);
PETSC_INTERN PetscErrorCode IPKrylovIndefinite(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPKrylovSolve(Tao, Vec, Vec, IPLinearVerdict *);

/* direct.c */
PETSC_INTERN PetscErrorCode IPDirectSolve(Tao, Vec, Vec, IPLinearVerdict *);
PETSC_INTERN PetscErrorCode IPDirectDestroy(IPDirect *);

/* linsolve.c */
PETSC_INTERN PetscErrorCode IPLinearSolve(Tao, Vec, Vec, PetscReal target, PetscBool *usable);

/* augmented.c */
PETSC_INTERN PetscErrorCode IPAugmentedSolve(Tao, Vec, Vec, Vec, PetscBool matrix, PetscBool *usable);
PETSC_INTERN PetscErrorCode IPAugmentedMultipliers(Tao);
PETSC_INTERN PetscErrorCode IPAugmentedDestroy(IPAugmented *);

/* proximal.c */
PETSC_INTERN PetscErrorCode IPProximalSolve(Tao, Vec, Vec, Vec, PetscReal target, PetscBool *usable, PetscBool *exact);
PETSC_INTERN PetscErrorCode IPProximalRestore(Tao, Vec, Vec, Vec, PetscBool *usable);

/* equality.c */
PETSC_INTERN PetscErrorCode IPEqualityChoose(Tao);
PETSC_INTERN PetscErrorCode IPEqualitySolve(Tao, Vec, Vec, Vec, PetscBool matrix, PetscReal target, PetscBool *usable);
PETSC_INTERN PetscErrorCode IPEqualityRestore(Tao, Vec, Vec, Vec, PetscBool *usable);
PETSC_INTERN PetscErrorCode IPEqualityMultipliers(Tao);

#endif
