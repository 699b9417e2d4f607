#ifndef IPFILTER_METHOD_H
#define IPFILTER_METHOD_H

#include "tao_ipfilter/solver/solverimpl.h"

/*
   Interface of an alternative to the interior point method, with its data. The driver calls the alternative only
   through this table; register.c stores the implementation.
*/
struct _n_IPMethodOps {
  const char *name;
  PetscErrorCode (*create)(Tao);
  PetscErrorCode (*compose)(Tao, PetscBool attach);     /* composes the method's public functions with the Tao, or
                                                           removes them */
  PetscErrorCode (*applies)(Tao, PetscBool *);          /* whether the method can solve the problem; called at the
                                                           starting point */
  PetscErrorCode (*begin)(Tao, PetscBool *begun);       /* moves to the first point of the method */
  PetscErrorCode (*step)(Tao, PetscBool *done);         /* makes one step; *done is false if the method makes no more
                                                           progress */
  PetscErrorCode (*end)(Tao);                           /* ends a solve, but keeps data that later solves reuse */
  PetscErrorCode (*forget)(Tao);                        /* frees the data that later solves would reuse */
  PetscErrorCode (*monitor)(Tao, PetscBool *monitored); /* prints a line of an iteration in the method's own columns */
  PetscErrorCode (*destroy)(Tao);
};

struct _n_IPMethod {
  const IPMethodOps *ops; /* NULL: there is no alternative method */
  void              *data;
  PetscBool          on;
  PetscBool          linear;      /* true if the constraints are linear, which is found from the caller's Jacobian
                                     routine leaving its matrix unchanged */
  PetscBool          constant;    /* true if the problem is a quadratic program: the constraints are linear, and the
                                     Hessian routine left its matrix unchanged */
  PetscBool          multipliers; /* true if this method computed the present multipliers */
};

#endif
