#ifndef IPFILTER_ROWS_H
#define IPFILTER_ROWS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* sides.c: rows of c_I classified by TaoSetInequalityBounds() */
struct _n_IPSides {
  Vec       sign;         /* +1; -1: upper bound only; 0: no inequality; NULL: all +1 */
  Vec       base;         /* the bound that c is measured from; NULL: the lower bound, or 0 */
  Vec       range;        /* upper minus lower bound, or PETSC_INFINITY; NULL: no row has two bounds */
  Vec       width;        /* range, scaled and relaxed */
  PetscReal constant;     /* value of c in rows that are no inequality; 0: not set yet */
  PetscInt  nequal, nall; /* rows with equal bounds, on this rank and on all */
  PetscInt *equal;        /* these rows, numbered from this rank's first */
};

/* Row scales of c_I and c_E; NULL: 1 */
struct _n_IPRowScale {
  Vec inequality, equality;
};

#endif
