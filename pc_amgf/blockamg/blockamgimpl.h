/*
   Private header of PCBLOCKAMG: one V-cycle in single precision on the hierarchy that hypre's BoomerAMG sets up, with
   matrices stored as dense blocks. "Position" means a position in a block vector, see BlockLevel. A ghost is a value of
   an unknown that another rank owns.
*/
#ifndef BLOCKAMG_H
#define BLOCKAMG_H

#include <petsccompat.h>
#include <petsc/private/pcimpl.h>
#include <petscsf.h>
#include <petscamgf.h>
#include <float.h>
#include <math.h>
#include <stdint.h>

/* Largest number of unknowns, on all ranks, of a level that is solved by a dense inverse */
#define BLOCKAMG_DENSE 256

/* hypre does not get entries up to this times the square roots of the absolute diagonal entries of row and column */
#define BLOCKAMG_TINY 1e-13

/* Largest absolute integer of a rounded row */
#define BLOCKAMG_LARGEST 32767.0f

/*
   Two coupled unknowns have high contrast if the ratio of their scales exceeds this. The error of 16 bits is about 1e-5
   of the stiffer diagonal entry. With high contrast it is at least 4 % of the softer one, which adds CG iterations.
*/
#define BLOCKAMG_CONTRAST 64.0f

/* Returns 1/unit, or 0 if the unit is zero, tiny or not finite */
static inline float BlockInverseUnit(float unit)
{
  return unit > FLT_MIN && unit <= FLT_MAX ? 1.0f / unit : 0.0f;
}

/* Returns the nearest integer, or 0 for what is not in the range of int16_t or not a number; without branches */
static inline int16_t BlockRound(float v)
{
  const float nearest = v + copysignf(0.5f, v);

  return (int16_t)(int)(nearest > -32769.0f && nearest < 32768.0f ? nearest : 0.0f);
}

/*
   The rows of a matrix that this rank owns, in compressed row format: ia, ja, a for columns of this rank, with local
   column numbers, and oia, oja, oa for columns of other ranks, with numbers of ghosts. ghosts[] has the global columns
   of the ghosts.
*/
typedef struct {
  PetscInt           n, nghosts;
  const PetscInt    *ia, *ja, *oia, *oja, *ghosts;
  const PetscScalar *a, *oa;
  PetscLayout        columns;
  Mat                held, diag, off;
} BlockRows;

/* Communication of values of unknowns of other ranks */
typedef struct {
  int     nghosts;
  PetscSF sf; /* NULL on one rank */
} BlockHalo;

/*
   Rows that have entries in columns of other ranks: these entries, and what is added to the diagonal of each row, see
   LevelShiftDiagonal()
*/
typedef struct {
  int    n;
  int   *position, *ptr, *col; /* position of each row in block vectors; start of each row in col and val; number of the
                               ghost of each entry */
  float *val, *shift;
} BlockBorder;

/* An entry of L in single precision, and the positions of its row and its column */
typedef struct {
  int   row, col;
  float value;
} BlockEntry;

/*
   The entries of L in the rows and columns of stiff unknowns. An unknown is stiff if it is coupled with an unknown of
   much smaller diagonal entry, see BLOCKAMG_CONTRAST.
*/
typedef struct {
  char       *stiff; /* marks stiff unknowns and ghosts at their positions; NULL: there are none; destroyed after the
                        set-up of the level */
  int        *ptr;   /* start of each block row in entries; NULL: there are none */
  BlockEntry *entries;
} BlockContrast;

/*
   Interpolation from the next coarser level in compressed row format. Rows are positions in block vectors of this
   level. Columns are positions in block vectors of the next level, followed by the ghosts of that level.
*/
typedef struct {
  int      *ptr, *col;
  float    *val;
  BlockHalo halo;
} BlockInterpolation;

/*
   A level on this rank. A block vector has 4 entries per block row, followed by the ghosts. position[] has the position
   of each unknown in a block vector. The matrix is C A C, where C has the scale 1/sqrt(|a_ii|) of each unknown. L is
   its strictly lower triangle without columns of other ranks, stored block row by block row in blocks of B rows of 4
   integers. An entry is an integer times the unit of its row. Entries of stiff unknowns are in `contrast` instead. The
   inverse of a diagonal block D is stored as W with D^-1 = W^T W, in B columns of 4 floats. Unused entries are zero.
*/
typedef struct {
  int                n, nb, B; /* number of unknowns; number of block rows; block size, 3 or 4 */
  int               *position;
  int               *ptr, *col; /* start of each block row in col; position of the first column of each block */
  int16_t           *L;
  float             *unit, *W;
  float             *scale; /* of each unknown at its position, and of the ghosts of the matrix */
  BlockContrast      contrast;
  BlockBorder        border;
  BlockHalo          halo;
  BlockInterpolation P;
  int                nslots;    /* length of a block vector, including its ghosts */
  float             *x, *b, *t; /* iterate; right-hand side; L^T x */

  PetscLogDouble unknowns, entries, blocks, bytes; /* sums over all ranks: unknowns, matrix entries, floats of L and
                                                      D, memory [bytes] */
} BlockLevel;

/* The coarsest level, solved by its dense inverse W^T W, of which every rank holds a copy */
typedef struct {
  int          first, N;        /* first unknown of this rank; number of unknowns of all ranks */
  float       *W, *b;           /* W, N x N; right-hand side of all ranks, N */
  PetscMPIInt *counts, *starts; /* number of unknowns of each rank; first unknown of each rank */
} BlockDense;

typedef struct {
  MPI_Comm    comm;
  PetscMPIInt size;
  int         nlevels; /* number of smoothed levels, without the dense level */
  BlockLevel *levels;
  BlockLevel  bottom; /* block vectors of the dense level, and positions of its unknowns */
  BlockDense  dense;  /* N = 0: there is no dense level, and the coarsest level is only smoothed */
  float      *before; /* iterate of the finest level before the last sweep; NULL: never needed */
  double      scale;  /* power of 2 by which all matrices are divided, so that floats can represent their diagonals */
} BlockHierarchy;

typedef struct {
  PC              hypre; /* BoomerAMG, which sets up the hierarchy; NULL except during the set-up, or if the operator is
                            not symmetric: then its own cycle is used */
  BlockHierarchy *h;
  char            why[200];  /* why there is no hierarchy; empty if there is one */
  PetscBool       symmetric; /* whether the operator of the last test is symmetric */
  PetscObjectId   tested;    /* this operator; with another one, or another nonzero pattern, the test is repeated */
  PetscObjectState pattern;
} PC_BlockAMG;

/* Returns whether the diagonal entries of the unknowns, or ghosts, at positions p and q differ much */
static inline PetscBool BlockDiffersMuch(const BlockLevel *level, int p, int q)
{
  const float *s = level->scale;

  return (PetscBool)(s[p] > BLOCKAMG_CONTRAST * s[q] || s[q] > BLOCKAMG_CONTRAST * s[p]);
}

/* Returns whether `contrast` holds the coupling of the unknowns at positions p and q */
static inline PetscBool BlockHasContrast(const BlockLevel *level, int p, int q)
{
  const char *stiff = level->contrast.stiff;

  return (PetscBool)(stiff && (stiff[p] || stiff[q]));
}

/* Functions of this folder. The files are listed such that each depends only on those before it. */

/* local_rows.c */
PETSC_INTERN PetscErrorCode BlockConvertToAIJ_Private(Mat, Mat *);
PETSC_INTERN PetscErrorCode BlockRowsGet_Private(Mat, BlockRows *);
PETSC_INTERN PetscErrorCode BlockRowsRestore_Private(BlockRows *);
/* operator.c: converts an AIJ operator to hypre's format without tiny entries, and destroys it */
PETSC_INTERN PetscErrorCode BlockConvertToHypre_Private(Mat *, PetscInt bs, Mat *hypre);
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
/* contrast.c */
PETSC_INTERN PetscErrorCode BlockContrastMark_Private(BlockLevel *, int p, int q);
PETSC_INTERN void           BlockContrastAdd_Private(BlockLevel *, int p, int q, double value, int next[]);
PETSC_INTERN PetscErrorCode BlockContrastReserve_Private(BlockContrast *, int nb, int **next);
PETSC_INTERN PetscErrorCode BlockContrastSet_Private(BlockLevel *, const BlockRows *, double scale);
PETSC_INTERN void           BlockContrastMultiplyRow_Private(const BlockContrast *, int i, const float x[], float y[]);
PETSC_INTERN void           BlockContrastTransposeRow_Private(const BlockContrast *, int i, const float x[], float t[]);
PETSC_INTERN PetscErrorCode BlockContrastDestroy_Private(BlockContrast *);
/* level.c */
PETSC_INTERN PetscErrorCode BlockLevelSetMatrix_Private(BlockLevel *, const BlockRows *, PetscInt bs, double scale);
PETSC_INTERN PetscErrorCode BlockLevelCreateVectors_Private(BlockLevel *);
PETSC_INTERN PetscErrorCode BlockLevelDestroy_Private(BlockLevel *);
PETSC_INTERN PetscErrorCode BlockLevelCheckSize_Private(PetscInt n);
PETSC_INTERN PetscErrorCode BlockLevelInvert_Private(BlockLevel *, int i, PetscScalar D[16]);
PETSC_INTERN PetscErrorCode BlockLevelCount_Private(BlockLevel *, MPI_Comm, double entries);
/* half.c: the same for an SBAIJ operator, which holds its upper triangle, without a copy of both triangles; and the
   finest level of it. BlockHalfSupports_Private() returns whether it takes the matrix. */
PETSC_INTERN PetscErrorCode BlockHalfSupports_Private(Mat, PetscBool *);
PETSC_INTERN PetscErrorCode BlockHalfConvertToHypre_Private(Mat, Mat *hypre);
PETSC_INTERN PetscErrorCode BlockHalfSetLevel_Private(BlockLevel *, Mat, double scale);
/* interpolation.c */
PETSC_INTERN PetscErrorCode BlockInterpolationCreate_Private(BlockLevel *, const BlockRows *, BlockLevel *);
PETSC_INTERN PetscErrorCode BlockInterpolationDestroy_Private(BlockInterpolation *);
/* sweep.c */
PETSC_INTERN void BlockSweepDown_Private(const BlockLevel *);
PETSC_INTERN void BlockSweepUp_Private(const BlockLevel *);
PETSC_INTERN void BlockMultiplyLower_Private(const BlockLevel *, const float v[], float y[]);
PETSC_INTERN void BlockRestrict_Private(const BlockLevel *, float coarse[]);
PETSC_INTERN void BlockInterpolateAdd_Private(const BlockLevel *, const float coarse[]);
PETSC_INTERN void BlockDenseMultiply_Private(int N, const float W[], const float b[], int first, int n, float x[]);
/* dense.c */
PETSC_INTERN PetscErrorCode BlockDenseCreate_Private(BlockHierarchy *, const BlockRows *);
PETSC_INTERN PetscErrorCode BlockDenseSolve_Private(BlockHierarchy *);
PETSC_INTERN PetscErrorCode BlockDenseDestroy_Private(BlockDense *);
/* hierarchy.c */
PETSC_INTERN PetscErrorCode BlockHierarchyCreate_Private(Mat, BlockHierarchy **);
PETSC_INTERN PetscErrorCode BlockHierarchySetFinest_Private(BlockHierarchy *, Mat, PetscInt bs);
PETSC_INTERN PetscErrorCode BlockHierarchyAddLevels_Private(BlockHierarchy *, PetscInt nlevels, Mat coarse[],
  Mat interpolations[]);
PETSC_INTERN PetscErrorCode BlockHierarchyIsFinite_Private(const BlockHierarchy *, PetscBool *);
PETSC_INTERN PetscErrorCode BlockHierarchyDestroy_Private(BlockHierarchy **);
/* v_cycle.c */
PETSC_INTERN PetscErrorCode PCApply_BlockAMG(PC, Vec, Vec);
PETSC_INTERN PetscErrorCode PCApplyTranspose_BlockAMG(PC, Vec, Vec);
PETSC_INTERN PetscErrorCode PCBlockAMGApplyProduct_BlockAMG(PC, Vec r, Vec z, Vec product);
/* symmetry.c */
PETSC_INTERN PetscErrorCode BlockTestSymmetry_Private(PC);
/* take_hierarchy.c */
PETSC_INTERN PetscErrorCode PCSetUp_BlockAMG(PC);
/* view_hierarchy.c */
PETSC_INTERN PetscErrorCode PCView_BlockAMG(PC, PetscViewer);
/* blockamg.c */
PETSC_EXTERN PetscErrorCode PCCreate_BlockAMG(PC);

#endif
