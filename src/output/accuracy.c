/* What -accuracy chose and attained, as a table for people */
#include "outputimpl.h"

/*@C
   ReportViewAccuracy - Prints what -accuracy chose, and what each mesh attained

   Collective on the viewer

   Input Parameters:
+  report - the report of the last run
-  viewer - an ASCII viewer

   Level: intermediate

   Note:
   Errors are relative, in energy and contact force. `recovery` is the error in energy by stress recovery; `change` that of the
   results since the coarser mesh, from which the error of the mesh is extrapolated.

.seealso: `AccuracyAssess()`, `ReportView()`
@*/
PetscErrorCode ReportViewAccuracy(const RunReport *report, PetscViewer viewer)
{
  const Accuracy *acc = report->accuracy;

  PetscFunctionBegin;
  if (!acc) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "\nNo accuracy asked for: -accuracy <target>\n"));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "\nAccuracy %g asked for, of which the solver may leave %g\n", (double)acc->target, (double)(acc->share * acc->target)));
  if (acc->contact) PetscCall(PetscViewerASCIIPrintf(viewer, "  optimizer's tolerance %g, at most %" PetscInt_FMT " linearizations of the gap, until it changes by less than %g\n", (double)acc->tolerance, acc->updates, (double)acc->update_tolerance));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "  linear solver's tolerance %g\n", (double)acc->tolerance));
  PetscCall(PetscViewerASCIIPrintf(viewer, "%8s %10s %10s %10s %12s %12s %10s\n", "refine", "unknowns", "recovery", "change", "mesh error", "solver error", "time [s]"));
  for (PetscInt l = 0; l < acc->nlevels; ++l) {
    const AccuracyLevel *level = &acc->levels[l];
    char                 change[16];

    PetscCall(PetscSNPrintf(change, sizeof(change), level->coarser ? "%.2e" : "-", (double)level->change));
    PetscCall(PetscViewerASCIIPrintf(viewer, "%8" PetscInt_FMT " %10" PetscInt_FMT " %10.2e %10s %12.2e %12.2e %10.3f\n", level->refine, level->dofs, (double)level->recovery, change, (double)level->error, (double)level->algebraic, level->time));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "  %s\n", acc->end));
  PetscFunctionReturn(0);
}
