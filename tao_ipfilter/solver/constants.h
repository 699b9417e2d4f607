#ifndef IPFILTER_CONSTANTS_H
#define IPFILTER_CONSTANTS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Constants. Names follow Waechter and Biegler (2006); most values are IPOPT's */
#define IP_ACCEPTABLE_TOL   1e-6  /* KKT error that is acceptable if no further progress is made, */
#define IP_ACCEPTABLE_IT    15    /* after this many consecutive acceptable iterates */
#define IP_UNBOUNDED_FACTOR 1e10  /* decrease of the objective relative to its first size that counts as unbounded */
#define IP_ROW_RATIO        100.0 /* row scaling: largest gradient at the start, relative to the smallest */
#define IP_GRADIENT_MAX     100.0 /* scaling by gradients: largest entry of all gradients at the start */
#define IP_BOUND_PUSH       1e-2  /* distance of the start from its bounds, relative to their size or distance */
#define IP_PREDICT_MU       0.3   /* predicted start: mu relative to mean length x mean pressure */
#define IP_PREDICT_FORCING  0.1   /* residual of its linear solve, relative to the forces that the rows transmit */
#define IP_WARM_MU          3e-2  /* warm start: smallest mu relative to mean length x mean pressure */
#define IP_KAPPA_EPSILON    10.0  /* monotone: mu falls when the barrier error is below this multiple of mu, */
#define IP_KAPPA_DUAL       0.1   /* and (relative measure) the stationarity error below this; */
#define IP_KAPPA_MU         0.2   /* mu is multiplied by this factor, */
#define IP_THETA_MU         1.5   /* or raised to this power, */
#define IP_MU_REDUCTIONS    1     /* at most this often per iteration after the first */
#define IP_KAPPA_PROGRESS \
  0.9999                          /* Mehrotra: the KKT error must fall below this fraction of the worst of four,
                                      else mu becomes monotone */
#define IP_TAU_MIN          0.99  /* smallest fraction of the step to the boundary */
#define IP_KAPPA_SIGMA      1e10  /* multipliers are kept within this factor of mu / s */
#define IP_GAMMA_THETA      1e-5  /* filter: sufficient reduction of the violation theta */
#define IP_DELTA_SWITCH     1.0   /* switching condition: constant, */
#define IP_S_THETA          1.1   /* exponent of the violation, */
#define IP_S_PHI            2.3   /* exponent of the slope */
#define IP_GAMMA_ALPHA      0.05  /* safety factor for the smallest step */
#define IP_THETA_MIN_FACT   1e-4  /* Armijo's condition is used below this violation, relative to the first */
#define IP_THETA_MAX_FACT   1e4   /* largest accepted violation, relative to the first */
#define IP_OBJ_MAX_INC      1e5   /* largest rise of the barrier function for less violation, relative to its size */
#define IP_KAPPA_SOC        0.99  /* a correction must reduce the violation by this factor to be continued */
#define IP_KAPPA_CURVATURE  1e-11 /* curvature d^T W d required of a direction, relative to d^T d */
#define IP_DELTA_FIRST      1e-4  /* first delta (multiple of M_u), in its unit, */
#define IP_DELTA_GROW_FIRST 100.0 /* its growth until one has worked, */
#define IP_DELTA_GROW       8.0   /* its growth later, */
#define IP_DELTA_SHRINK     (1.0 / 3.0) /* and its decrease from step to step */
#define IP_DELTA_EQUALITY   1e-8 /* regularization of dependent equality constraints, in units of J_E H^-1 J_E^T */
#define IP_FORCING_MAX \
  0.1                         /* adaptive forcing: linear residual while mu falls, relative to the forces in
                                     balance, */
#define IP_FORCING_REDUCE 0.7 /* relative to the last stationarity residual, */
#define IP_FORCING_LAST   0.5 /* and relative to the tolerance in the step that would finish */
#define IP_FILTER_THRESHOLD \
  1e-12 /* columns of J belong to the filter if they have an entry above this fraction of
                                     the largest */
#define IP_TINY_STEP (10.0 * PETSC_MACHINE_EPSILON) /* relative to x: smaller steps are rounding */
#define IP_LEAST_SLACK \
  1e-14 /* relative to the constraints' size: smaller slacks lose accuracy and indicate that there is no interior */
#define IP_CLOSE 1e-6 /* relative to ||b||: below this residual rounding may stop a Krylov method */
#define IP_MANY_ITERATIONS \
  500 /* iterations of a Krylov method that count as failure if other systems of the problem took few */

#endif
