/*
   Registers the filtered subspace method and the friction laws of norm terms. Only this file names their folders, by an
   include and an assignment each.
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
