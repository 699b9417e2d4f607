/*
   Private header of a sparse Cholesky factorization K = L L^T on one rank. Columns of L with the same rows are stored
   together as a dense block, a "supernode". Its first rows are its own columns.
*/
#ifndef AMGF_CHOLESKYIMPL_H
#define AMGF_CHOLESKYIMPL_H

#include <petsccompat.h>
#include <petscmat.h>

/* Graph of a matrix: the neighbours of each node, without the node itself. A node is a block of unknowns. */
typedef struct {
  PetscInt n, block, *start, *neighbour;
} CholeskyGraph;

typedef struct {
  PetscInt   n;       /* number of unknowns */
  PetscInt  *perm;    /* perm[i]: unknown that column i of L belongs to */
  PetscInt  *place;   /* place[k]: column of L that unknown k belongs to */
  PetscInt   nsuper;  /* number of supernodes */
  PetscInt  *first;   /* first column of each supernode, and n */
  PetscInt  *parent;  /* supernode of the first row below the own columns; nsuper: there is none */
  size_t    *start;   /* start of each supernode in `row`, and the length of `row` */
  PetscInt  *row;     /* rows of the supernodes, in ascending order */
  size_t    *entry;   /* start of each supernode in L, and the length of L */
  PetscBool  single;  /* L is rounded to single precision */
  PetscReal *L;       /* the supernodes, one column after the other; NULL: not factored, or rounded */
  float     *rounded; /* the same in single precision; NULL: not factored, or not rounded */
  PetscInt   tallest; /* largest number of rows of a supernode */
  PetscReal  flops;   /* operations of a factorization */
  PetscInt   failed;  /* row of the pivot that was not positive in the last factorization */
  PetscReal  pivot;   /* that pivot */
} Cholesky;

static inline PetscInt CholeskyColumns(const Cholesky *c, PetscInt s)
{
  return c->first[s + 1] - c->first[s];
}

static inline PetscInt CholeskyRows(const Cholesky *c, PetscInt s)
{
  return (PetscInt)(c->start[s + 1] - c->start[s]);
}

/* graph.c */
PETSC_INTERN PetscErrorCode CholeskyGraphCreate(Mat A, CholeskyGraph *);
PETSC_INTERN PetscErrorCode CholeskyGraphOrder(const CholeskyGraph *, PetscInt perm[]);
PETSC_INTERN PetscErrorCode CholeskyGraphDestroy(CholeskyGraph *);

/* dissect.c */
PETSC_INTERN PetscErrorCode CholeskyDissect(const CholeskyGraph *, const PetscScalar coordinates[], PetscInt perm[]);

/* tree.c */
PETSC_INTERN PetscErrorCode CholeskyTree(const CholeskyGraph *, PetscInt perm[], PetscInt parent[]);

/* symbolic.c */
PETSC_INTERN PetscErrorCode CholeskySymbolic(Mat A, Cholesky *);
PETSC_INTERN PetscErrorCode CholeskyDestroy(Cholesky *);

/* numeric.c */
PETSC_INTERN PetscErrorCode CholeskyNumeric(Mat A, Cholesky *, PetscBool *positive);

/* substitute.c */
PETSC_INTERN PetscErrorCode CholeskyForward(const Cholesky *, PetscInt k, PetscReal x[], PetscReal work[]);
PETSC_INTERN PetscErrorCode CholeskyBackward(const Cholesky *, PetscInt k, PetscReal x[], PetscReal work[]);

/* single.c */
PETSC_INTERN void CholeskySolveOne(const Cholesky *, PetscReal x[], PetscReal work[]);

#endif
