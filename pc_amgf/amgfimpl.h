/* Private header of PCAMGF */
#ifndef AMGFIMPL_H
#define AMGFIMPL_H

#include <petsccompat.h>
#include <petsc/private/pcimpl.h>
#include <petscamgf.h>

/* Where the subspace comes from. If several sources are given, the first one after NONE is used. */
typedef enum {
  AMGF_SOURCE_NONE,
  AMGF_SOURCE_CALL,
  AMGF_SOURCE_COMPOSED,
  AMGF_SOURCE_FILE,
  AMGF_SOURCE_DETECT
} AMGFSource;

/* Identifies a state of a matrix: the object's id, the state of its values, and the state of its nonzero pattern */
typedef struct {
  PetscObjectId    id;
  PetscObjectState state, pattern;
} AMGFStamp;

/* Special values of the lag, see PCAMGFSetAMGLag(). UNSET selects the default of the cycle. */
#define AMGF_LAG_AUTO  0
#define AMGF_LAG_NEVER (-1)
#define AMGF_LAG_UNSET (-2)

/*
   With the automatic lag, the AMG is rebuilt if the iterations per digit of residual reduction, or a diagonal entry
   outside the subspace, change by more than this factor.
*/
#define AMGF_LAG_RATIO 1.5

/* The rule for rebuilding the AMG, and what the rule needs to know of the last set-up and solve */
typedef struct {
  PetscInt  every; /* number of changed operators from one rebuild to the next, or AMGF_LAG_*; the argument of
                      PCAMGFSetAMGLag() */
  PetscBool built;
  PetscInt  age;      /* number of operators with changed values since the last rebuild */
  AMGFStamp seen;     /* stamp of the operator at the last set-up */
  Vec       diagonal; /* diagonal of the operator from which the AMG was built; NULL unless the lag is automatic */
  PetscBool overdue;  /* the last solve took too many iterations: rebuild the AMG for the next operator */
  PetscInt  its;      /* iterations of the reference solve, with which later solves are compared; 0: no reference yet */
  PetscReal digits;   /* decimal digits by which the reference solve reduced the residual; 0: unknown */
  PetscInt  history;  /* number of entries of the KSP's residual history before the present solve */
} AMGFLag;

/* A factorization of the operator, which is used instead of the AMG as the preconditioner B */
typedef struct {
  PCAMGFFactorUse use;
  PetscBool       on;      /* whether the last set-up used the factorization */
  PetscBool       failed;  /* the last factorization failed */
  PetscBool       small;   /* whether PCAMGFReconsiderFactor() has found that a factorization costs less */
  PetscInt        applies; /* number of applications of the AMG before the last set-up */
  PetscReal       fill;    /* entries of the factor divided by those of the operator's upper triangle; 0: not known */
  Mat             F;
  PetscInt        negative; /* number of negative pivots */
  AMGFStamp       analysed; /* stamp of the operator that was analysed */
} AMGFFactor;

/* The subspace range(P): either selected unknowns (rows), or the range of a general interpolation P */
typedef struct {
  AMGFSource source;
  IS         rows; /* owned rows of A that are needed for R, sorted, without repetition; if P is NULL, these are the
                      filtered unknowns */
  Mat        P;
  AMGFStamp  stamp; /* state of the Mat from which P was taken */

  PetscObjectId    composed_id; /* id of the object that was composed on the operator when the subspace was looked
                                   up; 0: none */
  PetscObjectState composed_state;
  PetscInt         nlocal, n;
} AMGFSubspace;

typedef struct {
  PCAMGFCycle  cycle;
  PC           amg;
  KSP          filter;
  PetscBool    configured; /* the inner solvers have read their options */
  PetscBool    bydefault;  /* the AMG has its default type: PCBLOCKAMG, or BoomerAMG if single precision is not
                              sufficient */
  PetscBool    active;     /* whether the subspace is used; if false, the AMG is applied alone */
  PetscBool    optional;   /* a missing subspace is intended, so that no warning is printed */
  PetscBool    warned;
  PCAMGFCounts counts;

  /* The next members are set by the user. At most one of set_is and set_P is not NULL. */
  IS        set_is;
  Mat       set_P;
  char     *file;
  IS        file_is;
  PetscReal detect; /* -pc_amgf_detect: ratio to the median above which a diagonal entry is stiff; 0: no detection */
  IS        detected_is;

  AMGFSubspace sub;
  AMGFStamp    galerkin;   /* stamp of the operator from which R and Aw were computed */
  Mat          rowsA;      /* rows of A in which P is nonzero; NULL if P selects unknowns */
  Mat          rowsP;      /* those rows of P; NULL if P selects unknowns */
  Mat          R;          /* P^H A, n_c x n, where n_c is the dimension of the subspace */
  Mat          Aw;         /* P^H A P, n_c x n_c */
  Vec          rc, ec, wc; /* vectors of length n_c: restricted residual, correction, work */
  Vec          w[2];       /* work vectors of length n */

  AMGFLag    lag;
  AMGFFactor factor;
} PC_AMGF;

/* Functions of this folder. The files are listed such that each depends only on those before it. */

/* log_events.c */
PETSC_INTERN PetscLogEvent PC_AMGF_AMGSetUp, PC_AMGF_AMGApply, PC_AMGF_FltSetUp, PC_AMGF_FltApply, PC_BLOCKAMG_SetUp,
  PC_BLOCKAMG_Convert, PC_BLOCKAMG_Apply;
PETSC_INTERN PetscErrorCode PCAMGFLogRegister_Private(void);
/* matrix_stamps.c */
PETSC_INTERN PetscErrorCode MatGetStamp_AMGF(Mat, AMGFStamp *);
PETSC_INTERN PetscBool      AMGFStampSamePattern(const AMGFStamp *, const AMGFStamp *);
PETSC_INTERN PetscBool      AMGFStampSameValues(const AMGFStamp *, const AMGFStamp *);
/* detect_stiff_rows.c */
PETSC_INTERN PetscErrorCode PCAMGFDetectRows_Private(Mat, PetscReal, IS *);
PETSC_INTERN PetscErrorCode PCAMGFFindContrast_Private(Mat, PetscBool, PetscReal *);
/* filtered_subspace.c */
PETSC_INTERN PetscErrorCode PCAMGFUpdateSubspace_Private(PC, PetscBool *);
PETSC_INTERN PetscErrorCode PCAMGFResetSubspace_Private(PC_AMGF *);
PETSC_INTERN PetscErrorCode PCAMGFSubspaceIsStale_Private(PC, PetscBool *);
/* thin_rows.c */
PETSC_INTERN PetscErrorCode MatGetThinRows_AMGF(Mat, IS, PetscBool, Mat *);
/* galerkin.c */
PETSC_INTERN PetscErrorCode PCAMGFUpdateGalerkin_Private(PC, PetscBool);
PETSC_INTERN PetscErrorCode PCAMGFResetGalerkin_Private(PC_AMGF *);
/* filter_solver.c */
PETSC_INTERN PetscErrorCode PCAMGFDirectBegin_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFDirectRenew_Private(KSP);
PETSC_INTERN PetscErrorCode PCAMGFDirectSetUp_Private(KSP, Mat);
PETSC_INTERN PetscErrorCode PCAMGFGetFilterPivots_AMGF(PC, PetscInt *);
/* boomeramg.c */
PETSC_INTERN PetscErrorCode PCAMGFConfigureBoomerAMG_Private(PC, PetscInt, PetscBool own);
/* inner_solvers.c */
PETSC_INTERN PetscErrorCode PCAMGFPrefixInner_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFConfigureInner_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFSetBlockAMG_Private(PC, PetscBool);
/* rebuild_amg.c */
PETSC_INTERN PetscInt       PCAMGFLagEvery_Private(const PC_AMGF *);
PETSC_INTERN PetscErrorCode PCAMGFLagDecide_Private(PC, PetscBool *);
PETSC_INTERN PetscErrorCode PCAMGFLagRebuilt_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFLagReset_Private(AMGFLag *);
PETSC_INTERN PetscErrorCode PCPreSolve_AMGF(PC, KSP, Vec, Vec);
PETSC_INTERN PetscErrorCode PCPostSolve_AMGF(PC, KSP, Vec, Vec);
/* factor_operator.c */
PETSC_INTERN PetscErrorCode PCAMGFFactorReset_Private(AMGFFactor *);
PETSC_INTERN PetscErrorCode PCAMGFFactorIsUsed_Private(PC, PetscBool *);
PETSC_INTERN PetscErrorCode PCAMGFFactorSetUp_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFSetFactor_AMGF(PC, PCAMGFFactorUse);
PETSC_INTERN PetscErrorCode PCAMGFGetFactored_AMGF(PC, PetscBool *);
PETSC_INTERN PetscErrorCode PCAMGFReconsiderFactor_AMGF(PC, PetscBool *);
/* set_up_amgf.c */
PETSC_INTERN PetscErrorCode PCSetUp_AMGF(PC);
/* filter_cycle.c */
PETSC_INTERN PetscErrorCode PCApply_AMGF(PC, Vec, Vec);
PETSC_INTERN PetscErrorCode PCApplyTranspose_AMGF(PC, Vec, Vec);
PETSC_INTERN PetscErrorCode PCAMGFApplyProduct_AMGF(PC, Vec r, Vec z, Vec product);
/* api.c, in addition to the public functions */
PETSC_INTERN PetscErrorCode PCAMGFComposeFunctions_Private(PC, PetscBool attach);
/* amgf_options.c */
PETSC_INTERN PetscErrorCode PCSetFromOptions_AMGF(PC, AMGFOptionItems);
/* view_amgf.c */
PETSC_INTERN PetscErrorCode PCView_AMGF(PC, PetscViewer);
/* amgf.c */
PETSC_EXTERN PetscErrorCode PCCreate_AMGF(PC);
/* library.c */
PETSC_INTERN PetscErrorCode PCAMGFCheckLibrary_Private(void);
/* version.c: only a public function */
/* register.c: only public functions, called when the plugin is loaded and finalized */

#endif
