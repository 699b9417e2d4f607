#ifndef IPFILTER_STIFFNESS_H
#define IPFILTER_STIFFNESS_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Stiffness of the objective at the starting point, from the diagonal of H */
struct _n_IPStiffness {
  Vec       rho;           /* per row of c_I: pressure that changes the row's constraint by one unit of length */
  Vec       reach;         /* per row of c_I: expected change of the constraint (far_rows.c); NULL: unknown */
  Vec       equality_rows; /* per row of c_E: largest entry of |J_E| at the start */
  PetscReal mean;          /* weighted harmonic mean of rho */
  Vec       hdiag;         /* absolute values of the present diagonal of H */
  PetscReal hscale;        /* mean of hdiag at the starting point */
  PetscBool flat;          /* no constraint is resisted by any stiffness of the objective */
};

#endif
