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
   results since the coarser mesh, from which the error of the mesh is extrapolated; where it is `beyond recovery` the two disagree, and
   the change stands for the error.

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
  PetscCall(TableViewHead(report, TABLE_LEVELS, &SchemaLevels, 0, viewer));
  PetscCall(TableViewRows(report, TABLE_LEVELS, &SchemaLevels, acc->nlevels, acc->levels, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  %s\n", acc->end));
  PetscFunctionReturn(0);
}
