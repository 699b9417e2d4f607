#ifndef IPFILTER_RECORD_H
#define IPFILTER_RECORD_H

#include "tao_ipfilter/solver/solverimpl.h"

/* What happened in one TaoSolve() */
struct _n_IPRecord {
  PetscInt             nksp, max_nksp, *ksp_iterations; /* number of linear solves; largest number of Krylov
                                                           iterations in one; Krylov iterations of each */
  PetscInt             nsystems, nfiltered; /* number of condensed matrices; number of those whose preconditioner
                                               used the filter */
  TaoIPFilterFallbacks fallbacks;
  PetscInt             nregularized, nretried; /* number of steps with a shifted Hessian; number of systems solved to
                                                  find these shifts */
  PetscReal            delta_largest;          /* largest shift delta in a step that was taken */
  PetscInt             nrestored;              /* number of restorations */
  PetscInt             nsaddles;               /* number of stationary points that were not minima */
  PetscInt             ntiny;                  /* number of consecutive steps as small as rounding errors */
  PetscReal            last_error;             /* KKT error at the last convergence test */
  PetscInt             nrefined;               /* number of iterations that refined an iterate that had converged */
  PetscReal            last_bound;             /* error bound before the next of these iterations */
  PetscReal            before, lowest;         /* objective of the iterate before the present one; lowest one of the
                                                  iterates that nidle counts */
  PetscBool            falls;                  /* whether the objective may still fall noticeably, though the error is
                                                  negligible relative to a first value (convergence.c) */
  PetscInt             nidle;                  /* convergence.c: number of consecutive steps that did not lower the
                                                  objective, but do not show that it cannot fall */
  PetscInt             nacceptable;            /* number of consecutive acceptable iterates */
  PetscInt             napplications;          /* subspace method: number of applications of the preconditioner */
  PetscInt             nreduced, npivots;      /* subspace method: number of reduced problems; number of active
                                             sets tried in them */
  PetscInt             ndirections;            /* subspace method: number of iterations that added a direction,
                                             without Newton steps */
  PetscReal            best_error;             /* KKT error of the best iterate */
  PetscReal            best_violation;         /* constraint violation of the best iterate */
  PetscBool            best_falls;             /* `falls` of the best iterate */
  char                 reason[256];
};

#endif
