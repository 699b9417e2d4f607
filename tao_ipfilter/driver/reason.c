/* Stores the reason why the solver stopped, with a sentence that explains it */
#include "driverimpl.h"
#include "tao_ipfilter/solver/record.h"
#include <stdarg.h>

PetscErrorCode IPSetReason(Tao tao, TaoConvergedReason reason, const char format[], ...)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  va_list       args;

  PetscFunctionBegin;
  tao->reason = reason;
  va_start(args, format);
  PetscCall(PetscVSNPrintf(ip->rec->reason, sizeof(ip->rec->reason), format, NULL, args));
  va_end(args);
  PetscCall(PetscInfo(tao, "%s\n", ip->rec->reason));
  PetscFunctionReturn(0);
}
