#ifndef IPFILTER_KKT_H
#define IPFILTER_KKT_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Residuals of the optimality conditions at the current iterate */
struct _n_IPKKT {
  PetscReal dual, primal, complementarity; /* relative to the scales, for mu = 0 */
  PetscReal centrality;                    /* complementarity error for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity): decides convergence together with
                                              work */
  PetscReal work;                          /* error bound in the objective, relative to its allowed size */
  PetscReal work_dual;                     /* part of the stationarity residual in work */
  PetscReal own;       /* largest violation relative to the constraint's own terms (own.c); computed near convergence
                          only */
  PetscReal violation; /* violation of the constraints without slacks, relative to their first size */
  PetscReal unscaled;  /* largest absolute entry of all residuals, for mu = 0 */
  PetscReal dual_norm; /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du, inf_compl; /* largest absolute entries of primal residual, dual residual, and t z */
};

#endif
