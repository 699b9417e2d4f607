#ifndef IPFILTER_TERMS_H
#define IPFILTER_TERMS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* terms.c: norm terms sum_i b_i |T_i x + t_i|, b_i = min(limit_i, coefficient_i x force of inequality constraint i) */
struct _n_IPTerms {
  PetscInt n;                  /* number of terms on all ranks; 0: none in this solve */
  Mat      given, T;           /* two rows per term; T: without the columns of fixed variables */
  IPStamp  stamp;              /* of T */
  Vec      t;                  /* two entries per term */
  Vec      limit, coefficient; /* one per term; limit NULL: no limits; coefficient NULL: limits only */
  Vec      force, best, last,
    warm;   /* tau at the present point, the best one, the last one; warm: initial tau, NULL: 0. Two entries per term */
  Vec rho;  /* stiffness that resists each term (resistance.c) */
  Vec dead; /* two entries per term: unit vector along which the term cannot move, so that v counts as zero; zeros:
               none */
};

#endif
