/*
   TAOIPFILTER: primal-dual interior point with a filter line search.

   The problem is min f(x) subject to c_E(x) = 0, c_I(x) >= 0, x_l <= x <= x_u. With slacks s for c_I and lumped weights
   M = diag(m_i) the Lagrangian is

     L = f(x) + y^T c_E(x) - lambda^T M (c_I(x) - s) - z^T M s - bound terms,

   so that c_I may be a length, z a pressure and m_i an area. The barrier function is f - mu sum_i m_i log s_i.

   Every inequality, slack or bound, is a complementarity pair (t, z) with t z = mu: t is s, x - x_l or x_u - x. A row
   with two bounds, 0 <= c_I(x) <= range, has one slack with two pairs: t is s and range - s.

   Of the folders none calls one that stands below it in this list; what is on top of them, the type, is in this one.

     problem  the problem as the iteration sees it: pairs, iterates, bounds, sides, scales of rows, Jacobians, Hessian
     measure  sizes and residuals: stiffness, scales, norm terms, what residuals are worth, the KKT error
     system   the condensed matrix A = H + Sigma + J^T D J + delta M_u and its filter
     linear   linear systems: Krylov methods, MUMPS, equality constraints
     step      a step: filter, barrier, direction, line search, restoration
     driver    the iteration: set up, solve, convergence, reasons
     subspace  the filtered subspace method, beside the steps: directions, the reduced problem, its active sets
     friction  the laws of norm terms on the subspace

   The driver reaches subspace, and subspace reaches friction, through tables of functions that register.c puts into the
   solver: without either folder, and its lines there, the rest is as it was.
*/
#ifndef IPFILTERIMPL_H
#define IPFILTERIMPL_H

#include "tao_ipfilter/driver/driverimpl.h"

/* opts.c */
PETSC_INTERN const char *const IPStarts[], *const IPBarrierRules[], *const IPKKTMeasures[],
                                                                      *const IPForcings[], *const IPSubspaceUses[],
                                                                                             *const IPEqualityMethods[];
PETSC_INTERN PetscErrorCode IPOptionsInitialize(IPOptions *);
PETSC_INTERN PetscErrorCode TaoSetFromOptions_IPFilter(Tao, AMGFOptionItems);

/* register.c */
PETSC_INTERN PetscErrorCode IPRegisterMethods(TAO_IPFILTER *);

/* view.c */
PETSC_INTERN PetscErrorCode TaoView_IPFilter(Tao, PetscViewer);

/* api.c */
PETSC_INTERN PetscErrorCode TaoIPFilterComposeFunctions(Tao, PetscBool);

#endif
