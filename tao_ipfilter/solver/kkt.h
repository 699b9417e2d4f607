#ifndef IPFILTER_KKT_H
#define IPFILTER_KKT_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Residuals of the optimality conditions at the current iterate */
struct _n_IPKKT {
  PetscReal dual, primal, complementarity; /* residuals for mu = 0, relative to the scales */
  PetscReal centrality;                    /* complementarity residual for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity); convergence is decided from `error`
                                              and `work` */
  PetscReal work;                          /* bound of the error in the objective that the residuals cause, relative
                                              to the allowed error */
  PetscReal work_dual;                     /* contribution of the stationarity residual to `work` */
  PetscReal bound;                         /* the same bound, in the unit of the objective */
  PetscReal own; /* largest violation relative to the terms of its own constraint (row_violation.c); computed only near
                          convergence */
  PetscReal violation; /* violation of the constraints, without their slacks, relative to its first size */
  PetscReal unscaled;  /* largest absolute value of all residuals for mu = 0 */
  PetscReal dual_norm; /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du, inf_compl; /* largest absolute values of primal residual, dual residual, and t z */
};

#endif
