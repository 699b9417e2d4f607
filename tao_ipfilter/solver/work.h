#ifndef IPFILTER_WORK_H
#define IPFILTER_WORK_H

#include "tao_ipfilter/solver/solverimpl.h"

/* Work vectors. A function that gets one must restore it. */
#define IP_MAX_WORK 8
struct _n_IPWork {
  Vec       v[IP_NSPACES][IP_MAX_WORK]; /* created at the first use */
  PetscBool lent[IP_NSPACES][IP_MAX_WORK];
};

#endif
