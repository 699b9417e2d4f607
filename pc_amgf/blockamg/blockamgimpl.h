/*
   Private header of PCBLOCKAMG: one V-cycle in single precision on dense blocks of the matrices that hypre's BoomerAMG
   sets up
*/
#ifndef BLOCKAMG_H
#define BLOCKAMG_H

#include <petsccompat.h>
#include <petsc/private/pcimpl.h>
#include <petscsf.h>
#include <petscamgf.h>

/* largest level (unknowns on all ranks) that is solved by a dense inverse */
#define BLOCKAMG_DENSE 256

/*
   The rows of a matrix that this rank owns. Columns of this rank have local numbers; columns of other ranks have
   numbers of ghosts, and ghosts[] has their global numbers.
*/
typedef struct {
  PetscInt           n, nghosts;
  const PetscInt    *ia, *ja, *oia, *oja, *ghosts;
  const PetscScalar *a, *oa;
  PetscLayout        columns;
  Mat                held, diag, off;
} BlockRows;

/* Exchange of values of other ranks' unknowns */
typedef struct {
  int     nghosts;
  PetscSF sf; /* NULL on one rank */
} BlockHalo;

/* Rows with columns of other ranks: their entries outside the blocks, and the additions to their diagonal */
typedef struct {
  int    n;
  int   *place, *ptr, *col; /* place of the row; row pointer; number of the ghost */
  float *val, *shift;
} BlockBorder;

/* Interpolation from the next level: rows by place; columns are places of the next level, then ghosts */
typedef struct {
  int      *ptr, *col;
  float    *val;
  BlockHalo halo;
} BlockInterpolation;

/*
   A level on this rank. A vector has 4 places per block row, then its ghosts; position[] has the place of each unknown.
   L, the strictly lower triangle without columns of other ranks, is stored by rows in blocks of B x B floats. The
   inverses of the diagonal blocks are stored as W with D^-1 = W^T W, B columns of 4 floats per block. Unused places
   hold zeros.
*/
typedef struct {
  int                n, nb, B; /* unknowns, block rows, block size 3 or 4 */
  int               *position;
  int               *ptr, *col; /* blocks of L by rows; col: the first place of the block's columns */
  float             *L, *W;
  BlockBorder        border;
  BlockHalo          halo;
  BlockInterpolation P;
  int                nslots;    /* length of a vector */
  float             *x, *b, *t; /* iterate, right-hand side, L^T x */

  PetscLogDouble unknowns, entries, blocks, bytes; /* all ranks: unknowns; matrix entries; floats of L and D; memory */
} BlockLevel;

/* The last level, solved by its inverse W^T W */
typedef struct {
  int          first, N;        /* first unknown of this rank; number of unknowns on all ranks */
  float       *W, *b;           /* inverse factor and right-hand side of all ranks */
  PetscMPIInt *counts, *starts; /* unknowns of each rank, and their first */
} BlockDense;

typedef struct {
  MPI_Comm    comm;
  PetscMPIInt size;
  int         nlevels; /* number of smoothed levels */
  BlockLevel *levels;
  BlockLevel  bottom; /* vectors and places of the dense level */
  BlockDense  dense;  /* N = 0: no dense level; the last level is only smoothed */
  double      scale;  /* power of 2 by which matrices are divided */
} BlockHierarchy;

typedef struct {
  PC              hypre; /* used to set up the hierarchy; empty between set-ups */
  BlockHierarchy *h;
  char            why[200]; /* reason if there is no hierarchy */
} PC_BlockAMG;

/* Functions of blockamg; files in the order in which they depend on each other */

/* rows.c */
PETSC_INTERN PetscErrorCode BlockConvertToAIJ_Private(Mat, Mat *);
PETSC_INTERN PetscErrorCode BlockRowsGet_Private(Mat, BlockRows *);
PETSC_INTERN PetscErrorCode BlockRowsRestore_Private(BlockRows *);
/* order.c */
PETSC_INTERN PetscErrorCode BlockOrderNodes_Private(const BlockRows *, PetscInt bs, int position[]);
PETSC_INTERN PetscErrorCode BlockOrderGroups_Private(const BlockRows *, int position[]);
/* invert.c */
PETSC_INTERN PetscErrorCode BlockInvertRoot_Private(PetscInt n, const PetscScalar a[], PetscScalar W[]);
/* halo.c */
PETSC_INTERN PetscErrorCode BlockHaloCreate_Private(PetscLayout, PetscInt nghosts, const PetscInt ghosts[],
  const BlockLevel *, BlockHalo *);
PETSC_INTERN PetscErrorCode BlockHaloFetch_Private(const BlockHalo *, const BlockLevel *, float x[]);
PETSC_INTERN PetscErrorCode BlockHaloAdd_Private(const BlockHalo *, const BlockLevel *, float x[]);
PETSC_INTERN PetscErrorCode BlockHaloDestroy_Private(BlockHalo *);
/* level.c */
PETSC_INTERN PetscErrorCode BlockLevelSetMatrix_Private(BlockLevel *, const BlockRows *, PetscInt bs, double scale);
PETSC_INTERN PetscErrorCode BlockLevelCreateVectors_Private(BlockLevel *);
PETSC_INTERN PetscErrorCode BlockLevelDestroy_Private(BlockLevel *);
/* interpolation.c */
PETSC_INTERN PetscErrorCode BlockInterpolationCreate_Private(BlockLevel *, const BlockRows *, BlockLevel *);
PETSC_INTERN PetscErrorCode BlockInterpolationDestroy_Private(BlockInterpolation *);
/* sweep.c */
PETSC_INTERN void BlockSweepDown_Private(const BlockLevel *);
PETSC_INTERN void BlockSweepUp_Private(const BlockLevel *);
PETSC_INTERN void BlockRestrict_Private(const BlockLevel *, float coarse[]);
PETSC_INTERN void BlockInterpolateAdd_Private(const BlockLevel *, const float coarse[]);
PETSC_INTERN void BlockDenseMultiply_Private(int N, const float W[], const float b[], int first, int n, float x[]);
/* dense.c */
PETSC_INTERN PetscErrorCode BlockDenseCreate_Private(BlockHierarchy *, const BlockRows *);
PETSC_INTERN PetscErrorCode BlockDenseSolve_Private(BlockHierarchy *);
PETSC_INTERN PetscErrorCode BlockDenseDestroy_Private(BlockDense *);
/* hierarchy.c */
PETSC_INTERN PetscErrorCode BlockHierarchyCreate_Private(Mat, PetscInt nlevels, Mat coarse[], Mat interpolations[],
  BlockHierarchy **);
PETSC_INTERN PetscErrorCode BlockHierarchyIsFinite_Private(const BlockHierarchy *, PetscBool *);
PETSC_INTERN PetscErrorCode BlockHierarchyDestroy_Private(BlockHierarchy **);
/* cycle.c */
PETSC_INTERN PetscErrorCode BlockCycle_Private(BlockHierarchy *);
PETSC_INTERN PetscErrorCode PCApply_BlockAMG(PC, Vec, Vec);
/* setup.c */
PETSC_INTERN PetscErrorCode PCSetUp_BlockAMG(PC);
/* view.c */
PETSC_INTERN PetscErrorCode PCView_BlockAMG(PC, PetscViewer);
/* blockamg.c */
PETSC_EXTERN PetscErrorCode PCCreate_BlockAMG(PC);

#endif
