/*
   TAOIPFILTER: primal-dual interior point with a filter line search.

   The problem is min f(x) subject to c_E(x) = 0, c_I(x) >= 0, x_l <= x <= x_u. With slacks s for c_I and lumped weights
   M = diag(m_i) the Lagrangian is
     L = f(x) + y^T c_E(x) - lambda^T M (c_I(x) - s) - z^T M s - bound terms.
   Thus c_I may be a length, z a pressure and m_i an area. The barrier function is f - mu sum_i m_i log s_i.

   Every inequality, slack or bound, is a complementarity pair (t, z) with t z = mu, where t is s, x - x_l or x_u - x. A
   row with two bounds, 0 <= c_I(x) <= range, has one slack with two pairs: t is s in one and range - s in the other.

   Each of the following folders calls only the folders above it in this list. This folder calls all of them.
     problem   the problem that the iteration solves: pairs, iterates, bounds, row sides, row scales, Jacobians, Hessian
     measure   sizes and residuals: stiffness, scales, norm terms, error bound of a residual, KKT error
     system    the condensed matrix A = H + Sigma + J^T D J + delta M_u and the filter of its preconditioner
     linear    linear systems: Krylov methods, MUMPS, equality constraints
     step      one step: filter, barrier, direction, line search, restoration
     driver    the iteration: set-up, solve, convergence, reasons
     subspace  the subspace method: directions, the reduced problem, its active sets
     friction  the friction laws of the norm terms in the subspace
   The driver calls subspace, and subspace calls friction, only through tables of functions, which register.c stores in
   the solver. The rest compiles without these two folders if their lines in register.c are removed.
*/
#ifndef IPFILTERIMPL_H
#define IPFILTERIMPL_H

#include "tao_ipfilter/driver/driverimpl.h"

/* opts.c */
PETSC_INTERN const char *const IPStarts[], *const IPBarrierRules[], *const IPKKTMeasures[], *const IPForcings[];
PETSC_INTERN PetscErrorCode IPOptionsInitialize(IPOptions *);
PETSC_INTERN PetscErrorCode IPOptionsSetPrefix(Tao);
PETSC_INTERN PetscErrorCode TaoSetFromOptions_IPFilter(Tao, AMGFOptionItems);

/* register.c */
PETSC_INTERN PetscErrorCode IPRegisterMethods(TAO_IPFILTER *);

/* view.c */
PETSC_INTERN PetscErrorCode TaoView_IPFilter(Tao, PetscViewer);

/* api.c */
PETSC_INTERN PetscErrorCode TaoIPFilterComposeFunctions(Tao, PetscBool);

#endif
