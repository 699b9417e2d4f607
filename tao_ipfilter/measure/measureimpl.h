/*
   The map of tao_ipfilter/measure: sizes and residuals: stiffness, scales, norm terms, what residuals are worth, the
   KKT error. Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_MEASUREIMPL_H
#define IPFILTER_MEASUREIMPL_H

#include "tao_ipfilter/problem/problemimpl.h"

/* Sizes at the starting point */
typedef struct {
  PetscReal f, gradient; /* objective and norm of its gradient */
  PetscReal unit;        /* of the objective, with scaling by gradients: 1, or what brings them down to the limit */
  PetscReal length, equality; /* of c_I and c_E */
  PetscReal x;
  PetscReal jacobian;          /* largest row sum of |J|, */
  PetscReal equality_jacobian; /* and of |J_E| */
  PetscReal energy;            /* of the terms that make up the objective */
} IPFirst;

/* Stiffness of the objective at the start, from the diagonal of H */
typedef struct {
  Vec       rho;    /* pressure per length that resists each constraint */
  PetscReal mean;   /* harmonic mean of rho, weighted */
  Vec       hdiag;  /* |diagonal of H|, now */
  PetscReal hscale; /* its mean at the start, */
  PetscBool flat;   /* where all of it was zero: nothing resists a constraint */
} IPStiffness;

/* Terms sum_i b_i |T_i x + t_i| beside the objective, b_i = min(limit_i, coefficient_i times the force of inequality
   constraint i): terms.c */
typedef struct {
  PetscInt n;                  /* of all ranks; 0: none in this solve */
  Mat      given, T;           /* two rows a term; without the columns of fixed variables */
  IPStamp  stamp;              /* of T */
  Vec      t;                  /* two entries a term */
  Vec      limit, coefficient; /* one a term; NULL: no limit, or limits alone */
  Vec      force, best, last,
    warm;  /* tau at the present point, at the best one and at the last, two a term; what the first is to be: NULL: 0 */
  Vec rho; /* force per length that resists a term */
  Vec dead; /* of two entries a term: unit vector along which next to nothing gives way, and v counts as none; zeros:
               there is none */
} IPTerms;

/* Magnitudes by which residuals are divided; all 1 in the published measure */
typedef struct {
  PetscReal dual;     /* forces that cancel in the stationarity condition */
  PetscReal length;   /* values of c_I */
  PetscReal equality; /* values of c_E */
  PetscReal pressure; /* multipliers, */
  PetscReal balance;  /* and those of one active constraint that balances the objective's gradient; 0: not known */
  PetscReal product;  /* length x pressure: complementarity and mu */
  PetscReal energy;   /* the objective; PETSC_INFINITY in the measures that do not ask for it */
} IPScale;

/* Residuals of the optimality conditions at the current iterate */
typedef struct {
  PetscReal dual, primal, complementarity; /* divided by the scales, mu = 0 */
  PetscReal centrality;                    /* as complementarity, for the present mu */
  PetscReal error;                         /* max(dual, primal, complementarity): decides convergence, together with */
  PetscReal work;                      /* what the residuals are worth in the objective, over a multiple of its size */
  PetscReal work_dual;                 /* the stationarity residual's share of it */
  PetscReal violation;                 /* of constraints, slacks apart, over their first size */
  PetscReal unscaled;                  /* largest absolute entry of all residuals, mu = 0 */
  PetscReal dual_norm;                 /* 2-norm of the stationarity residual */
  PetscReal inf_pr, inf_du, inf_compl; /* largest absolute entries of the primal and the dual residual, and of t z */
} IPKKT;

/* stiffness.c */
PETSC_INTERN PetscErrorCode IPCompliances(Tao, Mat, Vec);
PETSC_INTERN PetscErrorCode IPComputeStiffness(Tao);
PETSC_INTERN PetscErrorCode IPStiffnessUpdate(Tao);
PETSC_INTERN PetscErrorCode IPStiffnessTerms(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPStiffnessEnergies(Tao, PetscReal *largest, PetscReal *mean);

/* scale.c */
PETSC_INTERN PetscErrorCode IPComputeScale(Tao);
PETSC_INTERN PetscReal      IPAbsoluteTolerance(const TAO_IPFILTER *, PetscReal given, PetscReal by_gradients);

/* terms.c, beside the public functions */
PETSC_INTERN PetscErrorCode IPTermsDestroy(IPTerms *);
PETSC_INTERN PetscErrorCode IPTermsSetUp(Tao);
PETSC_INTERN PetscErrorCode IPTermsValue(Tao, Vec x, Vec);
PETSC_INTERN void           IPTermRemoveDead(const PetscScalar dead[2], PetscScalar v[2]);
PETSC_INTERN PetscErrorCode IPTermsSum(Tao, Vec x, Vec force, PetscReal *);
PETSC_INTERN PetscErrorCode IPTermsSubtractForces(Tao, Vec);
PETSC_INTERN PetscReal      IPTermBound(PetscReal limit, PetscReal coefficient, PetscReal force);
PETSC_INTERN PetscReal      IPTermViolation(const PetscScalar tau[2], const PetscScalar v[2], PetscReal rho,
       PetscReal bound);
PETSC_INTERN PetscErrorCode IPTermsViolation(Tao, PetscReal *largest);
PETSC_INTERN PetscErrorCode TaoIPFilterSetNormTerms_IPFilter(Tao, Mat, Vec, Vec, Vec);
PETSC_INTERN PetscErrorCode TaoIPFilterSetNormTermForces_IPFilter(Tao, Vec);
PETSC_INTERN PetscErrorCode TaoIPFilterGetNormTermForces_IPFilter(Tao, Vec *);

/* resistance.c */
PETSC_INTERN PetscErrorCode IPTermsResistance(Tao);

/* error_bound.c */
PETSC_INTERN PetscErrorCode IPErrorBoundTerms(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPErrorBoundEnergy(Tao, PetscReal *);
PETSC_INTERN PetscErrorCode IPErrorBoundOfResiduals(Tao);
PETSC_INTERN PetscErrorCode IPErrorBoundOfRelaxation(Tao, PetscReal *);
PETSC_INTERN PetscBool      IPErrorBoundWithin(const TAO_IPFILTER *, PetscReal gap);
PETSC_INTERN PetscReal      IPErrorBoundForceUnit(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPErrorBoundForceUnitAfter(Tao, Vec, PetscReal *);
PETSC_INTERN PetscReal      IPErrorBoundLeastMu(const TAO_IPFILTER *);

/* kkt.c */
PETSC_INTERN PetscReal      IPBothErrors(const TAO_IPFILTER *);
PETSC_INTERN PetscErrorCode IPComputeKKT(Tao);
PETSC_INTERN PetscErrorCode IPStationarity(Tao, Vec, Vec);

#endif
