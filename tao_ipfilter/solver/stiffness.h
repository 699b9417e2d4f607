#ifndef IPFILTER_STIFFNESS_H
#define IPFILTER_STIFFNESS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Stiffness of the objective at the start, from the diagonal of H */
struct _n_IPStiffness {
  Vec       rho;    /* rho: pressure that changes each constraint by a unit length */
  Vec       reach;  /* expected change of each constraint (reach.c); NULL: unknown */
  PetscReal mean;   /* weighted harmonic mean of rho */
  Vec       hdiag;  /* |diagonal of H|, up to date */
  PetscReal hscale; /* mean of hdiag at the start */
  PetscBool flat;   /* no constraint is resisted by any stiffness */
};

#endif
