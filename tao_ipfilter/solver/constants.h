#ifndef IPFILTER_CONSTANTS_H
#define IPFILTER_CONSTANTS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Constants. Their names follow Waechter and Biegler (2006). Most values are those of IPOPT. */
#define IP_ACCEPTABLE_TOL 1e-6  /* KKT error that is accepted if the iteration makes no further progress */
#define IP_ACCEPTABLE_IT  15    /* number of consecutive iterates below IP_ACCEPTABLE_TOL that ends the iteration */
#define IP_SMALL          500   /* number of unknowns up to which matrices are factored without a choice */
#define IP_WHOLE          15000 /* number of unknowns up to which W may have all of them; PCAMGF then factors K, too */
#define IP_UNBOUNDED_FACTOR \
  1e8 /* the problem counts as unbounded if the objective falls by this multiple of its
                                     first size; rounding errors of x end the fall at about 1e10 */
#define IP_ROW_RATIO \
  100.0 /* row scaling: largest allowed ratio of a row's gradient to the smallest one, at
                                     the start */
#define IP_BOUND_PUSH \
  1e-2                    /* distance by which the start is moved away from its bounds, relative to their
                                     size or distance */
#define IP_PREDICT_MU 0.3 /* predicted start: mu relative to mean length x mean pressure of the pairs */
#define IP_PREDICT_FORCING \
  0.1                   /* predicted start: residual of its linear solve, relative to the forces that the
                                     rows transmit */
#define IP_WARM_MU 3e-2 /* warm start: smallest mu, relative to mean length x mean pressure of the pairs */
#define IP_KAPPA_EPSILON \
  10.0                       /* monotone rule: mu is reduced if the barrier problem's error is below this
                                     multiple of mu ... */
#define IP_KAPPA_DUAL    0.1 /* ... and, with the relative measure, the stationarity error is below this value */
#define IP_KAPPA_MU      0.2 /* monotone rule: the new mu is the smaller one of mu times this factor ... */
#define IP_THETA_MU      1.5 /* ... and mu to this power */
#define IP_MU_REDUCTIONS 1   /* monotone rule: largest number of reductions per iteration after the first */
#define IP_KAPPA_PROGRESS \
  0.9999                     /* Mehrotra's rule: the KKT error must fall below this fraction of the largest of
                                     the last four errors; otherwise mu becomes monotone */
#define IP_TAU_MIN      0.99 /* smallest fraction of the step to the boundary */
#define IP_KAPPA_SIGMA  1e10 /* each multiplier is kept within this factor of mu / s */
#define IP_GAMMA_THETA  1e-5 /* filter: relative reduction of the violation theta that is sufficient */
#define IP_DELTA_SWITCH 1.0  /* switching condition: factor of theta^IP_S_THETA */
#define IP_S_THETA      1.1  /* switching condition: exponent of the violation theta */
#define IP_S_PHI        2.3  /* switching condition: exponent of the slope of the barrier function */
#define IP_GAMMA_ALPHA  0.05 /* safety factor of the smallest step length */
#define IP_THETA_MIN_FACT \
  1e-4                        /* violation below which Armijo's condition is used, relative to the first
                                     violation */
#define IP_THETA_MAX_FACT 1e4 /* largest accepted violation, relative to the first one */
#define IP_KAPPA_SOC \
  0.99                           /* second-order corrections continue only if each reduces the violation to this
                                     fraction */
#define IP_KAPPA_CURVATURE 1e-11 /* smallest curvature d^T W d of a direction d, relative to d^T d */
#define IP_DELTA_FIRST \
  1e-4 /* regularization: first value of delta, the multiple of M_u that is added to the matrix, divided by the unit
          of delta */
#define IP_DELTA_GROW_FIRST \
  100.0                   /* regularization: growth of delta per trial until the first successful
                                     factorization */
#define IP_DELTA_GROW 8.0 /* regularization: growth of delta per trial after a successful one */
#define IP_DELTA_SHRINK \
  (1.0 / 3.0) /* regularization: factor from the delta of the last step to the first trial
                                           of the next */
#define IP_DELTA_EQUALITY \
  1e-8 /* regularization of dependent equality constraints, relative to a diagonal entry of
                                    J_E H^-1 J_E^T */
#define IP_FORCING_MAX \
  0.1 /* adaptive forcing: largest residual of a linear solve while mu falls, relative to the
                                 forces in balance */
#define IP_FORCING_REDUCE \
  0.7 /* adaptive forcing: largest residual of a linear solve, relative to the last
                                 stationarity residual */
#define IP_FORCING_LAST \
  0.5 /* adaptive forcing: residual of the last linear solve before convergence, relative to
                                 the tolerance */
#define IP_FILTER_THRESHOLD \
  1e-12 /* an unknown belongs to the filter if its column of J has an entry above this fraction of the largest entry */
#define IP_TINY_STEP (10.0 * PETSC_MACHINE_EPSILON) /* step length relative to x below which a step is rounding error */
#define IP_LEAST_SLACK \
  1e-14 /* slack relative to the size of the constraints below which accuracy is lost. Such a slack indicates that
           the feasible set has no interior. */
#define IP_CLOSE 1e-6 /* residual relative to ||b|| below which rounding errors may stop a Krylov method */
#define IP_MANY_ITERATIONS \
  500 /* number of Krylov iterations that counts as failure if other systems of the problem took few */
#define IP_DENSE_ROWS \
  5792 /* constraints whose dense matrix has 256 MB; with more, no dense matrix of all constraints is used */

#endif
