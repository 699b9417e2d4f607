/* Output of -tao_view. */
#include "ipfilterimpl.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"

/* Prints the constraint violation, and the tolerances catol and crtol if they are set */
static PetscErrorCode ViewConstraints(Tao tao, PetscViewer viewer)
{
  TAO_IPFILTER *ip        = (TAO_IPFILTER *)tao->data;
  char          catol[32] = "", crtol[32] = "";

  PetscFunctionBegin;
  if (!ip->mi && !ip->me) PetscFunctionReturn(0);
  if (tao->catol < PETSC_INFINITY && tao->catol > 0.0)
    PetscCall(PetscSNPrintf(catol, sizeof(catol), " (catol %g)", (double)tao->catol));
  if (tao->crtol < PETSC_INFINITY && tao->crtol > 0.0)
    PetscCall(PetscSNPrintf(crtol, sizeof(crtol), " (crtol %g)", (double)tao->crtol));
  PetscCall(PetscViewerASCIIPrintf(viewer, "constraints: largest violation %g%s, relative %g%s\n",
    (double)ip->kkt->inf_pr, catol, (double)ip->kkt->primal, crtol));
  PetscFunctionReturn(0);
}

/* Prints how the linear systems were solved: applications of preconditioners, fallbacks, shifts of the Hessian */
static PetscErrorCode ViewLinearSolves(const TAO_IPFILTER *ip, PetscViewer viewer)
{
  const TaoIPFilterFallbacks *f = &ip->rec->fallbacks;

  PetscFunctionBegin;
  if (ip->rec->nreduced)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "subspace%s: preconditioner applied %" PetscInt_FMT " times, reduced problems %" PetscInt_FMT
      ", active sets %" PetscInt_FMT "\n",
      f->subspaces ? ", then interior point" : "", ip->rec->napplications, ip->rec->nreduced, ip->rec->npivots));
  PetscCall(
    PetscViewerASCIIPrintf(viewer, "condensed systems %" PetscInt_FMT ", of these with the filter %" PetscInt_FMT "\n",
      ip->rec->nsystems, ip->rec->nfiltered));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "linear solves: largest backward error %g; refined %" PetscInt_FMT ", AMG rebuilt %" PetscInt_FMT
    ", larger filter %" PetscInt_FMT ", whole matrix by MUMPS %" PetscInt_FMT ", failed %" PetscInt_FMT "\n",
    (double)f->backward_error, f->refinements, f->amg_rebuilds, f->filters, f->direct, f->failures));
  PetscCall(PetscViewerASCIIPrintf(viewer, "feasibility restorations %" PetscInt_FMT "\n", ip->rec->nrestored));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "steps with a shifted Hessian %" PetscInt_FMT ", largest shift %g, systems solved to find the shifts %" PetscInt_FMT
    "\n",
    ip->rec->nregularized, (double)ip->rec->delta_largest, ip->rec->nretried));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoView_IPFilter(Tao tao, PetscViewer viewer)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     ascii;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(
    PetscViewerASCIIPrintf(viewer, "start %s, barrier %s, forcing %s, KKT measure %s\n", IPStarts[ip->opt->start],
      IPBarrierRules[ip->opt->barrier], IPForcings[ip->opt->forcing], IPKKTMeasures[ip->opt->measure]));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "inequalities %" PetscInt_FMT ", lower bounds %" PetscInt_FMT ", upper bounds %" PetscInt_FMT "\n", ip->mi,
    ip->pair[IP_LOWER].n, ip->pair[IP_UPPER].n));
  if (ip->me && ip->prox->condensed)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "equalities %" PetscInt_FMT ", condensed, with %" PetscInt_FMT " proximal updates\n", ip->me,
      ip->prox->nupdates));
  else if (ip->me)
    PetscCall(PetscViewerASCIIPrintf(viewer, "equalities %" PetscInt_FMT ", in the augmented system\n", ip->me));
  PetscCall(
    PetscViewerASCIIPrintf(viewer, "KKT error %g (%s), compared with gatol %g; in the problem's units %g; mu %g\n",
      (double)ip->kkt->error, ip->opt->measure == IP_KKT_MASS ? "mass-weighted" : "relative to the terms that balance",
      (double)tao->gatol, (double)ip->kkt->unscaled, (double)ip->mu));
  PetscCall(ViewConstraints(tao, viewer));
  PetscCall(ViewLinearSolves(ip, viewer));
  if (ip->rec->reason[0]) PetscCall(PetscViewerASCIIPrintf(viewer, "%s\n", ip->rec->reason));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}
