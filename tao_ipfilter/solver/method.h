#ifndef IPFILTER_METHOD_H
#define IPFILTER_METHOD_H

#include "tao_ipfilter/solver/solverimpl.h"

/*
   Interface of an alternative to the interior point method, for problems that it applies to, and its data. The driver
   knows nothing else about it; register.c names the implementation.
*/
struct _n_IPMethodOps {
  const char *name;
  PetscErrorCode (*create)(Tao);
  PetscErrorCode (*compose)(Tao, PetscBool attach);     /* composes its public functions with the Tao */
  PetscErrorCode (*applies)(Tao, PetscBool *);          /* whether it applies to the problem at the first point */
  PetscErrorCode (*begin)(Tao, PetscBool *begun);       /* moves to its first point */
  PetscErrorCode (*step)(Tao, PetscBool *done);         /* done: false if it makes no more progress */
  PetscErrorCode (*end)(Tao);                           /* ends a solve; data for later solves are kept */
  PetscErrorCode (*forget)(Tao);                        /* that, too */
  PetscErrorCode (*monitor)(Tao, PetscBool *monitored); /* prints an iteration in its own columns */
  PetscErrorCode (*destroy)(Tao);
};

struct _n_IPMethod {
  const IPMethodOps *ops; /* NULL: no alternative method */
  void              *data;
  PetscBool          on;
  PetscBool          linear;      /* the caller's Jacobian routine left its matrix unchanged: constraints are linear, */
  PetscBool          constant;    /* and so did the Hessian routine: a quadratic program */
  PetscBool          multipliers; /* the present multipliers were computed by the method */
};

#endif
