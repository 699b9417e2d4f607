/* Prints one line per iteration, in the columns of IPOPT */
#include "driverimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/search.h"

/*
   Prints iteration, objective, primal and dual infeasibility, lg(mu), ||d||, lg of the regularization, step lengths,
   number of trial points, Krylov iterations (f: with the filter), and KKT error
*/
PetscErrorCode IPMonitor(Tao tao)
{
  TAO_IPFILTER *ip        = (TAO_IPFILTER *)tao->data;
  MPI_Comm      comm      = PetscObjectComm((PetscObject)tao);
  PetscBool     monitored = PETSC_FALSE;
  char          rg[16];

  PetscFunctionBegin;
  if (!ip->opt->monitor) PetscFunctionReturn(0);
  if (ip->method->on) PetscCall(ip->method->ops->monitor(tao, &monitored));
  if (monitored) PetscFunctionReturn(0);
  if (tao->niter % 20 == 0)
    PetscCall(PetscPrintf(comm,
      "iter     objective     inf_pr   inf_du lg(mu)  ||d||  lg(rg) alpha_du alpha_pr  ls ksp   kkt\n"));
  if (tao->niter && ip->shift->delta > 0.0)
    PetscCall(PetscSNPrintf(rg, sizeof(rg), "%5.1f", (double)PetscLog10Real(ip->shift->delta)));
  else PetscCall(PetscStrncpy(rg, "    -", sizeof(rg)));
  PetscCall(PetscPrintf(comm,
    "%4" PetscInt_FMT " %15.8e %8.2e %8.2e %6.1f %8.2e %s %8.2e %8.2e%c %2" PetscInt_FMT " %3" PetscInt_FMT
    "%c  %8.2e\n",
    tao->niter, (double)ip->at.f, (double)ip->kkt->inf_pr, (double)ip->kkt->inf_du,
    ip->mu > 0.0 ? (double)PetscLog10Real(ip->mu) : 0.0, (double)ip->dir.norm, rg, (double)ip->search->alpha_dual,
    (double)ip->search->alpha, ip->search->tag, ip->search->ntrials, tao->ksp_its, ip->lin->filtered ? 'f' : ' ',
    (double)ip->kkt->error));
  PetscFunctionReturn(0);
}
