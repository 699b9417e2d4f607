/*
   Registers the subspace method and the friction laws of norm terms. No other file refers to their folders.
*/
#include "ipfilterimpl.h"
#include "tao_ipfilter/subspace/subspaceimpl.h"
#include "tao_ipfilter/friction/frictionimpl.h"
#include "tao_ipfilter/solver/method.h"

PetscErrorCode IPRegisterMethods(TAO_IPFILTER *ip)
{
  PetscFunctionBegin;
  ip->method->ops = &IPMethodSubspace;
  ip->laws        = &IPLawsFriction;
  PetscFunctionReturn(0);
}
