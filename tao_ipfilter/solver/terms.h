#ifndef IPFILTER_TERMS_H
#define IPFILTER_TERMS_H

#include "tao_ipfilter/solver/solverimpl.h"

/*
   terms.c: norm terms sum_i b_i |T_i x + t_i| of the objective, with b_i = min(limit_i, coefficient_i x force of
   inequality constraint i)
*/
struct _n_IPTerms {
  PetscInt n;                  /* number of terms on all ranks; 0: none in this solve */
  Mat      given, T;           /* given: the caller's matrix, two rows per term; T: that matrix with zero columns for
                                  fixed variables */
  IPStamp  stamp;              /* stamp of T */
  Vec      t;                  /* the offsets t_i, two entries per term */
  Vec      limit, coefficient; /* one entry per term; limit NULL: no limits; coefficient NULL: only the limits act */
  Vec      force, best, last,
    warm;    /* tangential forces tau, two entries per term: at the present point, at the best one, at the last one,
               and the initial ones; warm NULL: zero */
  Vec rho;   /* stiffness against which each term moves (resistance.c) */
  Vec rigid; /* two entries per term: unit vector along which the term cannot move, so that its component of v counts
               as zero; zeros: the term moves in both directions */
};

#endif
