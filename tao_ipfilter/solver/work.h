#ifndef IPFILTER_WORK_H
#define IPFILTER_WORK_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Work vectors; a function that takes one must return it */
#define IP_MAX_WORK 8
struct _n_IPWork {
  Vec       v[IP_NSPACES][IP_MAX_WORK]; /* created on demand */
  PetscBool lent[IP_NSPACES][IP_MAX_WORK];
};

#endif
