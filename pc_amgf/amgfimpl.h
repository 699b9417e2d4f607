/* Private header of PCAMGF */
#ifndef AMGFIMPL_H
#define AMGFIMPL_H

#include <petsccompat.h>
#include <petsc/private/pcimpl.h>
#include <petscamgf.h>

/* Source of the subspace, in order of precedence after NONE */
typedef enum {
  AMGF_SOURCE_NONE,
  AMGF_SOURCE_CALL,
  AMGF_SOURCE_COMPOSED,
  AMGF_SOURCE_FILE,
  AMGF_SOURCE_DETECT
} AMGFSource;

/* Identifies a matrix and its state: object, values, nonzero pattern */
typedef struct {
  PetscObjectId    id;
  PetscObjectState state, pattern;
} AMGFStamp;

/* Special values of PCAMGFSetAMGLag(); unset: default of the cycle */
#define AMGF_LAG_AUTO  0
#define AMGF_LAG_NEVER (-1)
#define AMGF_LAG_UNSET (-2)

/* Automatic lag: the AMG is rebuilt if costs, or a diagonal entry outside the subspace, grow by this factor */
#define AMGF_LAG_RATIO 1.5

/* Rule for rebuilding the AMG */
typedef struct {
  PetscInt  every; /* as PCAMGFSetAMGLag() */
  PetscBool built;
  PetscInt  age;      /* number of changed operators since the last rebuild */
  AMGFStamp seen;     /* operator at the last set-up */
  Vec       diagonal; /* diagonal of the operator from which the AMG was built; automatic lag only */
  PetscBool overdue;  /* the last solve was too expensive */
  PetscInt  its;      /* reference: iterations, */
  PetscReal digits;   /* and its digits of residual reduction */
  PetscInt  history;  /* length of the residual history when the solve began */
} AMGFLag;

/* A factorization of the operator that replaces the AMG as B */
typedef struct {
  PCAMGFFactorUse use;
  PetscBool       on;     /* B is the factorization */
  PetscBool       failed; /* the last factorization failed */
  PetscReal       share;  /* automatic choice: limit of the factors' memory, as a fraction of the machine's memory */
  Mat             F;
  AMGFStamp       analysed;               /* the operator analysed by MUMPS, and the estimates of the analysis: */
  PetscReal       flops, entries, memory; /* operations, entries and memory [bytes] of the factors */
  char            why[160];               /* explanation of the last choice */
} AMGFFactor;

/* Solver of the filtered system on the first few ranks */
typedef struct {
  PetscInt    wanted; /* as PCAMGFSetFilterRanks() */
  PetscMPIInt nranks; /* number of ranks that solve; 0: not set up */
  PetscBool   solves; /* whether this rank is one of them */
  AMGFStamp   stamp;  /* of A_w */
  MPI_Comm    comm;   /* communicators of the ranks that solve, and of the others */
  PC          pc;     /* on the solving ranks, like A, b and x */
  Mat         moved, rows, A;
  Vec         at, b, x; /* at: vector scatter to the solving ranks; NULL: all ranks solve, with the matrix itself */
  VecScatter  scatter;
} AMGFFewRanks;

/* Estimates [s] */
typedef struct {
  PetscReal factor, solve; /* by factorization */
  PetscReal setup, apply;  /* by AMG */
} AMGFCosts;

/* The subspace range(P): either unknowns (rows) or a general interpolation P */
typedef struct {
  AMGFSource source;
  IS         rows; /* owned rows of A that are needed for R, sorted, unique; the filtered unknowns if P is NULL */
  Mat        P;
  AMGFStamp  stamp; /* state of the Mat from which P was taken */

  PetscObjectId    composed_id; /* object composed on the operator when the subspace was looked up, and its state; 0:
                                   none */
  PetscObjectState composed_state;
  PetscInt         nlocal, n;
} AMGFSubspace;

typedef struct {
  PCAMGFCycle  cycle;
  PC           amg;
  KSP          filter;
  PetscBool    configured; /* the inner solvers have read their options */
  PetscBool    bydefault;  /* the AMG has its default type: PCBLOCKAMG, or BoomerAMG where single precision is not
                              sufficient */
  PetscBool    active;     /* the subspace is used; otherwise the AMG alone */
  PetscBool    optional;   /* a missing subspace is intended: no warning */
  PetscBool    warned;
  PCAMGFCounts counts;

  /* set by the user: */
  IS        set_is;
  Mat       set_P;
  char     *file;
  IS        file_is;
  PetscReal detect; /* 0: off */
  IS        detected_is;

  AMGFSubspace sub;
  AMGFStamp    galerkin;   /* the operator from which R and Aw were computed */
  Mat          rowsA;      /* rows of A where P is nonzero; with a general P only */
  Mat          rowsP;      /* the same rows of P */
  Mat          R;          /* P^H A, thin: n_c x n */
  Mat          Aw;         /* P^H A P */
  Vec          rc, ec, wc; /* n_c */
  Vec          w[2];       /* n */

  AMGFLag      lag;
  AMGFFactor   factor;
  AMGFFewRanks few;
} PC_AMGF;

/* Functions of this folder; files in the order in which they depend on each other */

/* log.c */
PETSC_INTERN PetscLogEvent PC_AMGF_AMGSetUp, PC_AMGF_AMGApply, PC_AMGF_FltSetUp, PC_AMGF_FltApply, PC_BLOCKAMG_SetUp,
  PC_BLOCKAMG_Convert, PC_BLOCKAMG_Apply;
PETSC_INTERN PetscErrorCode PCAMGFLogRegister_Private(void);
/* stamp.c */
PETSC_INTERN PetscErrorCode MatGetStamp_AMGF(Mat, AMGFStamp *);
PETSC_INTERN PetscBool      AMGFStampSamePattern(const AMGFStamp *, const AMGFStamp *);
PETSC_INTERN PetscBool      AMGFStampSameValues(const AMGFStamp *, const AMGFStamp *);
/* detect.c */
PETSC_INTERN PetscErrorCode PCAMGFDetectRows_Private(Mat, PetscReal, IS *);
PETSC_INTERN PetscErrorCode PCAMGFFindContrast_Private(Mat, PetscBool, PetscReal *);
/* subspace.c */
PETSC_INTERN PetscErrorCode PCAMGFUpdateSubspace_Private(PC, PetscBool *);
PETSC_INTERN PetscErrorCode PCAMGFResetSubspace_Private(PC_AMGF *);
PETSC_INTERN PetscErrorCode PCAMGFSubspaceIsStale_Private(PC, PetscBool *);
/* rows.c */
PETSC_INTERN PetscErrorCode MatGetThinRows_AMGF(Mat, IS, PetscBool, Mat *);
/* galerkin.c */
PETSC_INTERN PetscErrorCode PCAMGFUpdateGalerkin_Private(PC, PetscBool);
PETSC_INTERN PetscErrorCode PCAMGFResetGalerkin_Private(PC_AMGF *);
/* direct.c */
PETSC_INTERN PetscErrorCode PCAMGFSetDirectSolver_Private(PC, PetscBool *);
/* fewranks.c */
PETSC_INTERN PetscErrorCode PCAMGFFewRanksBegin_Private(PC, AMGFFewRanks *);
PETSC_INTERN PetscErrorCode PCAMGFFewRanksReset_Private(AMGFFewRanks *);
PETSC_INTERN PetscErrorCode PCAMGFSetFilterRanks_AMGF(PC, PetscInt);
PETSC_INTERN PetscErrorCode PCAMGFGetFilterPivots_AMGF(PC, PetscInt *);
/* boomeramg.c */
PETSC_INTERN PetscErrorCode PCAMGFConfigureBoomerAMG_Private(PC, PetscInt);
/* inner.c */
PETSC_INTERN PetscErrorCode PCAMGFPrefixInner_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFConfigureInner_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFSetBlockAMG_Private(PC, PetscBool);
/* lag.c */
PETSC_INTERN PetscInt       PCAMGFLagEvery_Private(const PC_AMGF *);
PETSC_INTERN PetscErrorCode PCAMGFLagDecide_Private(PC, PetscBool *);
PETSC_INTERN PetscErrorCode PCAMGFLagRebuilt_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFLagReset_Private(AMGFLag *);
PETSC_INTERN PetscErrorCode PCPreSolve_AMGF(PC, KSP, Vec, Vec);
PETSC_INTERN PetscErrorCode PCPostSolve_AMGF(PC, KSP, Vec, Vec);
/* memory.c */
PETSC_INTERN PetscErrorCode PCAMGFSumMemory_Private(MPI_Comm, PetscReal, PetscReal *);
PETSC_INTERN PetscErrorCode PCAMGFGetMemory_Private(MPI_Comm, PetscReal *);
/* factor.c */
PETSC_INTERN PetscErrorCode PCAMGFFactorReset_Private(AMGFFactor *);
PETSC_INTERN PetscErrorCode PCAMGFFactorSetUp_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFSetFactor_AMGF(PC, PCAMGFFactorUse);
PETSC_INTERN PetscErrorCode PCAMGFExpect_AMGF(PC, PetscReal, PetscReal);
PETSC_INTERN PetscErrorCode PCAMGFGetFactored_AMGF(PC, PetscBool *, const char *[]);
/* setup.c */
PETSC_INTERN PetscErrorCode PCSetUp_AMGF(PC);
/* cycle.c */
PETSC_INTERN PetscErrorCode PCApply_AMGF(PC, Vec, Vec);
PETSC_INTERN PetscErrorCode PCApplyTranspose_AMGF(PC, Vec, Vec);
/* api.c, in addition to the public functions */
PETSC_INTERN PetscErrorCode PCAMGFComposeFunctions_Private(PC);
PETSC_INTERN PetscErrorCode PCAMGFRemoveFunctions_Private(PC);
/* opts.c */
PETSC_INTERN PetscErrorCode PCSetFromOptions_AMGF(PC, AMGFOptionItems);
/* view.c */
PETSC_INTERN PetscErrorCode PCView_AMGF(PC, PetscViewer);
/* amgf.c */
PETSC_EXTERN PetscErrorCode PCCreate_AMGF(PC);
/* library.c */
PETSC_INTERN PetscErrorCode PCAMGFCheckLibrary_Private(void);
/* version.c: only a public function */
/* register.c: only public functions, called when the plugin is loaded and finalized */

#endif
