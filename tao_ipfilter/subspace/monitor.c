/* Prints one line per iteration of the subspace method */
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/record.h"

/* Prints a line per reduced problem: iteration, objective, infeasibilities, ||d||, applications of the preconditioner
   so far, directions, active sets tried, active constraints. Newton's method prints the columns of the driver. */
PetscErrorCode IPSubspaceMonitor(Tao tao, PetscBool *monitored)
{
  TAO_IPFILTER     *ip   = (TAO_IPFILTER *)tao->data;
  const IPSubspace *f    = IPSubspaceOf(tao);
  MPI_Comm          comm = PetscObjectComm((PetscObject)tao);
  IPRecycle        *recycle;

  PetscFunctionBegin;
  *monitored = (PetscBool)!f->newton;
  if (!*monitored) PetscFunctionReturn(0);
  PetscCall(IPRecycleGet(tao, &recycle));
  if (tao->niter % 20 == 0)
    PetscCall(
      PetscPrintf(comm, "iter     objective     inf_pr   inf_du   ||d||   applied directions sets active   kkt\n"));
  PetscCall(PetscPrintf(comm,
    "%4" PetscInt_FMT " %15.8e %8.2e %8.2e %8.2e %8" PetscInt_FMT " %10" PetscInt_FMT " %4" PetscInt_FMT
    " %6" PetscInt_FMT "  %8.2e\n",
    tao->niter, (double)ip->at.f, (double)ip->kkt->inf_pr, (double)ip->kkt->inf_du, (double)ip->dir.norm,
    ip->rec->napplications, recycle->basis.n, f->laws ? (PetscInt)1 : f->reduced->nsteps,
    f->laws ? f->nclosed : f->reduced->nactive, (double)ip->kkt->error));
  PetscFunctionReturn(0);
}
