/* Prints how `-accuracy` divided the requested accuracy between mesh and solver, and the errors that were reached. */
#include "outputimpl.h"

/*@C
   ReportViewAccuracy - Prints the choices of -accuracy and the errors of each mesh

   Collective on the viewer

   Input Parameters:
+  report - the report of the last run, of a run with -accuracy
-  viewer - an ASCII viewer

   Level: intermediate

   Note:
   Errors are relative, in energy and contact force. `recovery` is the error in energy by stress recovery; `change` is
   the change of the results since the coarser mesh, from which the error of the mesh is extrapolated. `beyond recovery`
   means that the change is larger than recovery explains; then the change is taken as the error.

.seealso: `ReportView()`
@*/
PetscErrorCode ReportViewAccuracy(const RunReport *report, PetscViewer viewer)
{
  const Accuracy *acc = report->accuracy;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\nRequested accuracy %g; the solver may leave an error of %g\n",
    (double)acc->target, (double)(acc->share * acc->target)));
  if (acc->contact)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  optimizer's tolerance %g, at most %" PetscInt_FMT " contact updates, until the gap changes by less than %g of "
      "the largest displacement\n",
      (double)acc->tolerance, acc->updates, (double)acc->update_tolerance));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "  linear solver's tolerance %g\n", (double)acc->tolerance));
  PetscCall(TableViewHead(report, TABLE_LEVELS, &SchemaLevels, 0, viewer));
  PetscCall(TableViewRows(report, TABLE_LEVELS, &SchemaLevels, acc->nlevels, acc->levels, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "  errors are relative to the energy, or to the force of a pair if that error is larger\n"));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  %s\n", acc->end));
  PetscFunctionReturn(0);
}

/*
   Prints one line about the last mesh: its number of unknowns, its discretization error, the error of the solver, the
   time so far and what is done next. how: text after the error that says how it was estimated.
*/
static PetscErrorCode AccuracyViewAdapted(const Accuracy *acc, const char how[], PetscViewer viewer)
{
  const AccuracyLevel *now  = &acc->levels[acc->nlevels - 1];
  const PetscReal      next = acc->growth * (PetscReal)now->dofs;
  PetscLogDouble       all  = 0.0;

  PetscFunctionBegin;
  for (PetscInt l = 0; l < acc->nlevels; ++l) all += acc->levels[l].time;
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "Accuracy %g: a mesh of %" PetscInt_FMT " unknowns has an error of %g%s, the solver %g, after %.1f s; ",
    (double)acc->target, now->dofs, (double)now->error, how, (double)now->algebraic, (double)all));
  if (acc->mesh > now->mesh)
    PetscCall(PetscViewerASCIIPrintf(viewer, "the next mesh has about %" PetscInt_FMT " unknowns\n", (PetscInt)next));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "next: a smaller tolerance\n"));
  PetscFunctionReturn(0);
}

/*@C
   ReportViewNextMesh - Prints the errors of the last mesh and the next refinement

   Collective on the viewer

   Input Parameters:
+  acc    - the record of the runs, at least one of which has been assessed
.  refine - number of uniform refinements of the next run
-  viewer - an ASCII viewer

   Level: intermediate

.seealso: `ReportViewAccuracy()`
@*/
PetscErrorCode ReportViewNextMesh(const Accuracy *acc, PetscInt refine, PetscViewer viewer)
{
  const AccuracyLevel *now = &acc->levels[acc->nlevels - 1];
  const char          *how = now->unseen                   ? ", larger than stress recovery can detect"
                             : PetscIsNanReal(now->change) ? " by stress recovery alone"
                                                           : "";

  PetscFunctionBegin;
  if (acc->adaptive) PetscCall(AccuracyViewAdapted(acc, how, viewer));
  else if (acc->order && !now->mesh && acc->mesh)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "Accuracy %g: error of the mesh %g%s, of the solver %g; next: order %" PetscInt_FMT "\n", (double)acc->target,
      (double)now->error, how, (double)now->algebraic, acc->order));
  else
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "Accuracy %g: error of the mesh %g%s, of the solver %g; next: refinement %" PetscInt_FMT "\n",
      (double)acc->target, (double)now->error, how, (double)now->algebraic, refine));
  PetscFunctionReturn(0);
}
