/*
   The map of tao_ipfilter/linear: linear systems: Krylov methods, MUMPS, equality constraints.
   Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_LINEARIMPL_H
#define IPFILTER_LINEARIMPL_H

#include "tao_ipfilter/system/systemimpl.h"

/* What came of a linear solve */
typedef enum {
  IP_LINEAR_SOLVED,
  IP_LINEAR_INDEFINITE, /* the matrix is not positive definite */
  IP_LINEAR_FAILED      /* the solver has failed, which says nothing about the matrix */
} IPLinearVerdict;

/* The present linear system and its last solve */
typedef struct {
  KSP                flexible;       /* for corrections; NULL until one is needed */
  Vec                residual;       /* b - A d */
  PetscReal          target, rhs;    /* ||b - A d|| asked for, and ||b|| */
  PetscReal          norm;           /* ||b - A d||, */
  PetscReal          backward_error; /* and over the terms it is the difference of */
  PetscInt           its, limit;     /* Krylov iterations, and their limit */
  PetscInt           longest;        /* largest number of them in a solve that gave a direction */
  KSPConvergedReason reason;
  PetscBool          failed;        /* no solver gave a direction, for reasons other than the matrix's inertia */
  char               why[128];      /* why the last remedy did not help */
  PetscInt           ndirect;       /* solves in a row that only MUMPS could do */
  PetscBool          filtered;      /* preconditioned with the filter */
  PetscBool          filter_forced; /* the filter stays on */
} IPLinear;

/* The condensed matrix factored by MUMPS, where the Krylov method fails */
typedef struct {
  Mat              A, F;          /* the matrix as MUMPS takes it, and its factors */
  PetscBool        converted;     /* A is a copy */
  PetscObjectId    pattern_id;    /* which matrix it analysed, */
  PetscObjectState pattern_state; /* with which pattern, */
  PetscReal        memory;        /* and what the factors take by that, in 1e6 bytes over all ranks */
  PetscInt         system;        /* which condensed matrix was factored, by rec.nsystems */
  PetscInt
    relaxation; /* per cent of work space beyond MUMPS's estimate: what the last factorization came to; 0: none yet */
  PetscInt negative; /* its negative pivots */
} IPDirect;

/* The symmetric system [A J_E^T; J_E -delta] that equality constraints lead to, and its factorization */
typedef struct {
  KSP       ksp;
  Mat       K;
  Mat       shift;      /* -delta I */
  PetscReal delta;      /* of restoration steps, or regularization of dependent constraints: */
  PetscBool centered;   /* about the present multipliers, instead of zero */
  PetscInt  relaxation; /* per cent of work space beyond MUMPS's estimate, and */
  PetscReal pivot;      /* relative threshold of its pivots: what the last factorization came to; 0: none yet */
  Vec       rhs, sol, residual, correction;
} IPAugmented;

/* Equality constraints whose rows touch few unknowns: condensed with the others, their multipliers found by proximal
   updates */
typedef struct {
  PetscBool condensed; /* in this solve, until they turn out not to be fit for it */
  PetscInt  nupdates;  /* of the multipliers beyond the first of each solve */
} IPProximal;

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
