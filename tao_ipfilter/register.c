/* Registers the methods besides the interior point method, and the laws of norm terms. Their folders are named only
   here, in two lines each. */
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
