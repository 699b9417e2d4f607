#ifndef IPFILTER_ROWS_H
#define IPFILTER_ROWS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* constraint_bounds.c: kinds of the rows of c_I, by the bounds of TaoSetInequalityBounds() */
struct _n_IPSides {
  Vec       sign;         /* per row: +1; -1: only an upper bound; 0: the row is no inequality. NULL: all rows have
                             +1. */
  Vec       base;         /* per row: the bound from which c is measured. NULL: the lower bound, or 0. */
  Vec       range;        /* per row: upper minus lower bound, or PETSC_INFINITY. NULL: no row has two bounds. */
  Vec       width;        /* `range`, scaled and relaxed */
  Vec       compliance;   /* per row: the condition is c + compliance x force >= 0, for the scaled row; NULL: c >= 0 */
  PetscReal constant;     /* value of c in rows that are no inequality; 0: not chosen yet */
  PetscInt  nequal, nall; /* number of rows with equal bounds on this rank; the number on all ranks */
  PetscInt *equal;        /* rows with equal bounds on this rank, numbered from the rank's first row */
};

/* Factors by which the rows of c_I and c_E are multiplied; NULL: all are 1 */
struct _n_IPRowScale {
  Vec inequality, equality;
};

#endif
