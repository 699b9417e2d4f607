/* The methods beside the interior point method, and the laws of norm terms: two lines each are all that
   names their folders. */
#include "ipfilterimpl.h"
#include "tao_ipfilter/subspace/subspaceimpl.h"
#include "tao_ipfilter/friction/frictionimpl.h"

PetscErrorCode IPRegisterMethods(TAO_IPFILTER *ip)
{
  PetscFunctionBegin;
  ip->method.ops = &IPMethodSubspace;
  ip->laws       = &IPLawsFriction;
  PetscFunctionReturn(0);
}
