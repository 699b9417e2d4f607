#ifndef IPFILTER_RECORD_H
#define IPFILTER_RECORD_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Record of a TaoSolve() */
struct _n_IPRecord {
  PetscInt             nksp, max_nksp, *ksp_iterations; /* Krylov iterations of every linear solve */
  PetscInt             nsystems, nfiltered; /* condensed matrices, and those preconditioned with the filter */
  TaoIPFilterFallbacks fallbacks;
  PetscInt             nregularized, nretried; /* steps with a shifted Hessian; systems solved to find the shifts */
  PetscReal            delta_largest;          /* largest shift in a step taken */
  PetscInt             nrestored;              /* restorations */
  PetscInt             nsaddles;               /* stationary points that were not minima */
  PetscInt             ntiny;                  /* consecutive steps as small as rounding */
  PetscInt             nacceptable;            /* consecutive acceptable iterates */
  PetscInt             nstraight;     /* consecutive full steps with a shift along which the objective fell linearly, */
  PetscReal            last_f;        /* objective before the next of these */
  PetscInt             napplications; /* filtered subspace method: applications of the preconditioner, */
  PetscInt             nreduced, npivots; /* reduced problems, and active sets tried in them */
  PetscInt             ndirections;       /* iterations that added a direction, not Newton steps */
  PetscReal            best_error;        /* KKT error of the best iterate, */
  PetscReal            best_violation;    /* and its violation */
  char                 reason[256];
};

#endif
