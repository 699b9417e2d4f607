/*
   tao_ipfilter/driver: the iteration, with set-up, solve, convergence test and reasons. The files are listed such that
   each depends only on those before it and on the folders above this one in ipfilterimpl.h.
*/
#ifndef IPFILTER_DRIVERIMPL_H
#define IPFILTER_DRIVERIMPL_H

#include "tao_ipfilter/iteration/iterationimpl.h"

/* reason.c */
PETSC_INTERN PetscErrorCode IPSetReason(Tao, TaoConvergedReason, const char[], ...) PETSC_ATTRIBUTE_FORMAT(3, 4);

/* degenerate.c */
PETSC_INTERN PetscReal      IPDegenerateObjective(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPDegenerateFritzJohn(Tao, PetscBool *holds);

/* saddle.c */
PETSC_INTERN PetscErrorCode IPLeaveSaddle(Tao, PetscBool *left);

/* unbounded.c */
PETSC_INTERN PetscErrorCode IPTestUnbounded(Tao, PetscReal *, PetscBool *);
PETSC_INTERN PetscErrorCode IPTestUnboundedRays(Tao, PetscReal *f, PetscBool *unbounded);
PETSC_INTERN PetscErrorCode IPSetUnbounded(Tao, PetscReal lowest);

/* convergence.c */
PETSC_INTERN PetscErrorCode IPTestFirstPoint(Tao);
PETSC_INTERN PetscErrorCode IPTestNumbers(Tao);
PETSC_INTERN PetscBool      IPConstraintsMet(Tao);
PETSC_INTERN PetscErrorCode IPTestConvergence(Tao);
PETSC_INTERN PetscErrorCode IPConvergeRefined(Tao);
PETSC_INTERN PetscErrorCode IPObserveStep(Tao);
PETSC_INTERN PetscErrorCode IPTestLimits(Tao);
PETSC_INTERN PetscBool      IPRefines(TAO_IPFILTER *);
PETSC_INTERN PetscBool      IPAcceptable(const TAO_IPFILTER *);

/* monitor.c */
PETSC_INTERN PetscErrorCode IPMonitor(Tao);

/* setup.c */
PETSC_INTERN PetscErrorCode TaoSetUp_IPFilter(Tao);
PETSC_INTERN PetscErrorCode IPSetUpSizes(Tao);
PETSC_INTERN PetscErrorCode IPSetUpIteration(Tao);
PETSC_INTERN PetscErrorCode TaoDestroy_IPFilter(Tao);

/* first_point.c */
PETSC_INTERN PetscErrorCode IPForgetSystem(Tao);
PETSC_INTERN PetscErrorCode IPFirstPoint(Tao, PetscBool *finite);

/* solve.c */
PETSC_INTERN PetscErrorCode TaoSolve_IPFilter(Tao);

#endif
