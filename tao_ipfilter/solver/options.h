#ifndef IPFILTER_OPTIONS_H
#define IPFILTER_OPTIONS_H

#include "tao_ipfilter/solver/solverimpl.h"

typedef enum { IP_START_COLD, IP_START_PREDICT, IP_START_WARM } IPStart;
typedef enum { IP_BARRIER_MONOTONE, IP_BARRIER_MEHROTRA } IPBarrierRule;
typedef enum { IP_KKT_RELATIVE, IP_KKT_MASS } IPKKTMeasure;
typedef enum { IP_FORCING_ADAPTIVE, IP_FORCING_FIXED } IPForcing;
typedef enum { IP_SCALING_PROBLEM, IP_SCALING_NONE } IPScaling;
typedef enum { IP_EQUALITY_AUTO, IP_EQUALITY_AUGMENTED, IP_EQUALITY_CONDENSED } IPEqualityMethod;

typedef enum { IP_SUBSPACE_FALSE, IP_SUBSPACE_TRUE, IP_SUBSPACE_AUTO } IPConstrainedUse;

/* Parameters that the user may set. opts.c has the options of the same names. */
struct _n_IPOptions {
  IPStart          start;
  IPBarrierRule    barrier;
  IPKKTMeasure     measure;
  IPForcing        forcing;
  IPScaling        scaling;
  PetscBool        monitor;
  PetscReal        mu0, s0, z0;
  PetscInt         max_mu_first, max_soc;
  PetscReal        gamma_phi, eta_phi, delta_max, filter_switch;
  PetscReal        direct_memory;
  PetscBool        direct_always;
  IPConstrainedUse subspace;
  PetscInt         subspace_max;
  IPEqualityMethod equality;
  PetscReal        proximal;
};

/* Data that the caller sets by TaoIPFilterSet...(); NULL: not set */
struct _n_IPGiven {
  Mat       modes;                   /* motions that the Hessian hardly resists; NULL: none */
  Vec       slack_mass, primal_mass; /* weights M_s of the slacks and M_u of the unknowns; NULL: all weights are 1 */
  Vec       compliance;              /* compliance of the rows of c_I; NULL: all rows are rigid */
  Vec       warm_s, warm_z;          /* initial slacks and their multipliers */
  PetscReal rounding;                /* rounding errors of the unknowns; 0: unknown */
  PetscBool definite;                /* the Hessian is known to be positive definite */
  PetscErrorCode (*interrupt)(void *, PetscBool *); /* whether the user wants to end the solve */
  void *interrupt_ctx;
};

#endif
