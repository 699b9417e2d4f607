/* Output of -ksp_view for PCAMGF */
#include "amgfimpl.h"

static PetscErrorCode ViewLag(PC_AMGF *amgf, PetscViewer viewer)
{
  const PetscInt every = PCAMGFLagEvery_Private(amgf), age = amgf->lag.age;

  PetscFunctionBegin;
  if (every > 0)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  AMG rebuilt after %" PetscInt_FMT " changes of the operator; changes since the last rebuild: %" PetscInt_FMT
      "\n",
      every, age));
  else if (every == AMGF_LAG_NEVER)
    PetscCall(
      PetscViewerASCIIPrintf(viewer, "  AMG never rebuilt; changes of the operator so far: %" PetscInt_FMT "\n", age));
  else
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  AMG rebuilt when the cost has grown by a factor of %g; changes of the operator since the last rebuild: "
      "%" PetscInt_FMT "\n",
      AMGF_LAG_RATIO, age));
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewFilter(PC pc, PetscViewer viewer)
{
  static const char *const sources[] = {"none given", "set by call", "composed on the operator", "from a file",
    "detected"};
  PC_AMGF                 *amgf      = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (!pc->setupcalled) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  filter: not yet set up\n"));
    PetscFunctionReturn(0);
  }
  if (!amgf->active)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  filter: switched off, only the AMG is used; last dimension %" PetscInt_FMT "\n", amgf->sub.n));
  else
    PetscCall(PetscViewerASCIIPrintf(viewer, "  filter: %s, dimension %" PetscInt_FMT "%s\n", sources[amgf->sub.source],
      amgf->sub.n, amgf->sub.n || amgf->factor.on ? "" : ", only the AMG is used"));
  if (amgf->sub.source == AMGF_SOURCE_FILE)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  filter file: %s\n", amgf->file));
  if (amgf->sub.source == AMGF_SOURCE_DETECT)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  detection: diagonal entries above %g times the median\n",
      (double)amgf->detect));
  PetscFunctionReturn(0);
}

PetscErrorCode PCView_AMGF(PC pc, PetscViewer viewer)
{
  PC_AMGF            *amgf   = (PC_AMGF *)pc->data;
  const PCAMGFCounts *counts = &amgf->counts;
  PetscBool           ascii;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "  cycle: %s\n", PCAMGFCycles[amgf->cycle]));
  PetscCall(ViewFilter(pc, viewer));
  PetscCall(ViewLag(amgf, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "  so far: %" PetscInt_FMT " AMG set-ups, %" PetscInt_FMT " AMG applications, %" PetscInt_FMT
    " filter set-ups, %" PetscInt_FMT " filter solves\n",
    counts->amg_setups, counts->amg_applies, counts->filter_setups, counts->filter_applies));
  PetscCall(
    PetscViewerASCIIPrintf(viewer, amgf->factor.on ? "  a factorization is used instead of the AMG:\n" : "  AMG:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  if (!amgf->factor.on) PetscCall(PCView(amgf->amg, viewer));
  else if (amgf->factor.F) {
    PetscCall(PetscViewerPushFormat(viewer, PETSC_VIEWER_ASCII_INFO)); /* matrices of factors have no other format */
    PetscCall(MatView(amgf->factor.F, viewer));
    PetscCall(PetscViewerPopFormat(viewer));
  }
  PetscCall(PetscViewerASCIIPopTab(viewer));
  if (amgf->active && amgf->sub.n) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  filter solver:\n"));
    PetscCall(PetscViewerASCIIPushTab(viewer));
    PetscCall(KSPView(amgf->filter, viewer));
    PetscCall(PetscViewerASCIIPopTab(viewer));
  }
  PetscFunctionReturn(0);
}
