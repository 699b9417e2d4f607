/*
   Public interface of the petscamgf plugin: PCAMGF and TAOIPFILTER.

   With complex scalars, the plugin is PCAMGF alone.

   Every call dispatches by name (PetscTryMethod/PetscUseMethod). A program need not include this header: -pc_type amgf,
   -tao_type ipfilter, and an IS or Mat composed on the Pmat under "amgf_filter" are sufficient.
*/
#ifndef PETSCAMGF_H
#define PETSCAMGF_H

#include <petscksp.h>
#include <petsctao.h>

/* The release of this header; PetscAMGFGetVersion() gives that of the library */
#define PETSCAMGF_VERSION_MAJOR    0
#define PETSCAMGF_VERSION_MINOR    1
#define PETSCAMGF_VERSION_SUBMINOR 0
#define PETSCAMGF_VERSION_LT(major, minor, subminor) \
  (PETSCAMGF_VERSION_MAJOR < (major) || \
    (PETSCAMGF_VERSION_MAJOR == (major) && \
      (PETSCAMGF_VERSION_MINOR < (minor) || \
        (PETSCAMGF_VERSION_MINOR == (minor) && PETSCAMGF_VERSION_SUBMINOR < (subminor)))))
#define PETSCAMGF_VERSION_GE(major, minor, subminor) (!PETSCAMGF_VERSION_LT(major, minor, subminor))

#define PCAMGF      "amgf"
#define PCBLOCKAMG  "blockamg"
#define TAOIPFILTER "ipfilter"

/* The key under which an IS (filtered unknowns) or a Mat (filter interpolation) is composed on the Pmat */
#define PCAMGF_FILTER_KEY "amgf_filter"

/*E
  PCAMGFCycle - order in which the AMG application B and the filter Q = P (P^T A P)^-1 P^T are combined

  Values:
+ PC_AMGF_BFB      - (I-BA)(I-QA)(I-BA): two B, one Q, two products with A; SPD when A < 2 B^-1
. PC_AMGF_FBF      - (I-QA)(I-BA)(I-QA): one B, two Q, no full product with A; SPD for any SPD B
- PC_AMGF_ADDITIVE - B + Q: one B, one Q; always SPD

  Level: intermediate
E*/
typedef enum { PC_AMGF_BFB, PC_AMGF_FBF, PC_AMGF_ADDITIVE } PCAMGFCycle;
PETSC_EXTERN const char *const PCAMGFCycles[];

/*E
  PCAMGFFactorUse - whether a factorization of the operator replaces the AMG

  Values:
+ PC_AMGF_FACTOR_FALSE - never
. PC_AMGF_FACTOR_TRUE  - always
- PC_AMGF_FACTOR_AUTO  - if the operator is small

  Level: intermediate
E*/
typedef enum { PC_AMGF_FACTOR_FALSE, PC_AMGF_FACTOR_TRUE, PC_AMGF_FACTOR_AUTO } PCAMGFFactorUse;
PETSC_EXTERN const char *const PCAMGFFactorUses[];

/* What a PCAMGF has done since it was created; PCReset() keeps the counts */
typedef struct {
  PetscInt amg_setups;     /* set-ups of the AMG, or factorizations that replace it */
  PetscInt amg_applies;    /* applications of the AMG, or solves with the factors */
  PetscInt filter_setups;  /* numerical factorizations of the matrix on the filtered subspace */
  PetscInt filter_applies; /* solves with the matrix on the filtered subspace */
} PCAMGFCounts;

/* Counts of the remedies for Newton systems that the Krylov method alone did not solve, in one TaoSolve() */
typedef struct {
  PetscInt  refinements;    /* solves continued from the iterate reached, because its true residual was too large */
  PetscInt  amg_rebuilds;   /* rebuilds of an AMG of an older matrix */
  PetscInt  filters;        /* filters switched on, or extended to the neighbours of the constraints' unknowns */
  PetscInt  direct;         /* systems solved by MUMPS on the whole matrix */
  PetscInt  failures;       /* systems that no remedy solved */
  PetscReal backward_error; /* largest backward error of a direction that was used: ||b - A d|| / (||diag(A) d|| +
                               ||b||) */
  PetscInt  subspaces;      /* changes from the subspace method to the interior point method */
} TaoIPFilterFallbacks;

PETSC_EXTERN PetscErrorCode PetscAMGFInitializePackage(void);
PETSC_EXTERN PetscErrorCode PetscAMGFFinalizePackage(void);
PETSC_EXTERN PetscErrorCode PetscAMGFGetVersion(char[], size_t);

PETSC_EXTERN PetscErrorCode PCAMGFSetCycle(PC, PCAMGFCycle);
PETSC_EXTERN PetscErrorCode PCAMGFSetFilterIS(PC, IS);
PETSC_EXTERN PetscErrorCode PCAMGFSetFilterInterpolation(PC, Mat);
PETSC_EXTERN PetscErrorCode PCAMGFGetFilterSize(PC, PetscInt *);
PETSC_EXTERN PetscErrorCode PCAMGFSetFilterActive(PC, PetscBool);
PETSC_EXTERN PetscErrorCode PCAMGFSetFilterOptional(PC, PetscBool);
PETSC_EXTERN PetscErrorCode PCAMGFSetAMGLag(PC, PetscInt);
PETSC_EXTERN PetscErrorCode PCAMGFGetAMGAge(PC, PetscInt *);
PETSC_EXTERN PetscErrorCode PCAMGFGetAMGPC(PC, PC *);
PETSC_EXTERN PetscErrorCode PCAMGFGetFilterKSP(PC, KSP *);
PETSC_EXTERN PetscErrorCode PCAMGFGetFilterPivots(PC, PetscInt *);
PETSC_EXTERN PetscErrorCode PCAMGFGetCounts(PC, PCAMGFCounts *);
PETSC_EXTERN PetscErrorCode PCAMGFSetFactor(PC, PCAMGFFactorUse);
PETSC_EXTERN PetscErrorCode PCAMGFGetFactored(PC, PetscBool *);
PETSC_EXTERN PetscErrorCode PCAMGFReconsiderFactor(PC, PetscBool *);
PETSC_EXTERN PetscErrorCode PCAMGFApplyProduct(PC, Vec r, Vec z, Vec product);

PETSC_EXTERN PetscErrorCode TaoIPFilterSetSlackMass(Tao, Vec);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetCompliance(Tao, Vec);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetPrimalMass(Tao, Vec);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetWarmStart(Tao, Vec, Vec);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetSlack(Tao, Vec *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetMultiplier(Tao, Vec *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetKSPIterations(Tao, PetscInt *, const PetscInt *[]);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetKKTError(Tao, PetscReal *, PetscReal *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetFilterUse(Tao, PetscInt *, PetscInt *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetRegularizations(Tao, PetscInt *, PetscInt *, PetscReal *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetFallbacks(Tao, TaoIPFilterFallbacks *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetReason(Tao, const char *[]);
PETSC_EXTERN PetscErrorCode TaoIPFilterDefaultConvergenceTest(Tao, void *);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetNormTerms(Tao, Mat, Vec, Vec, Vec);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetNormTermForces(Tao, Vec);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetNormTermForces(Tao, Vec *);
PETSC_EXTERN PetscErrorCode TaoIPFilterGetSubspace(Tao, PetscContainer *);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetSubspace(Tao, PetscContainer);
PETSC_EXTERN PetscErrorCode TaoIPFilterSolveActive(PetscContainer, Vec, Vec, PetscInt, PetscReal, Vec, Vec, PetscInt *,
  PetscBool *);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetRounding(Tao, PetscReal);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetDefinite(Tao, PetscBool);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetModes(Tao, Mat);
PETSC_EXTERN PetscErrorCode TaoIPFilterSetInterrupt(Tao, PetscErrorCode (*)(void *, PetscBool *), void *);

#endif
