/* Prints the report of a run as tables with sentences between them. */
#include "outputimpl.h"
#include "src/report/reportimpl.h"

/* Prints a table with one row per load step. lines: number of lines of the heading, 1 or 2. */
static PetscErrorCode ViewSteps(const RunReport *report, ReportTable table, PetscInt lines, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (PetscInt line = 0; line < lines; ++line) PetscCall(TableViewHead(report, table, &SchemaSteps, line, viewer));
  PetscCall(TableViewRows(report, table, &SchemaSteps, report->nsteps, report->steps, viewer));
  PetscFunctionReturn(0);
}

/* Prints an empty line and a table with n rows; nothing if there are no rows */
static PetscErrorCode ViewList(const RunReport *report, ReportTable table, const ReportRecord *type, PetscInt n,
  const void *rows, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(TableViewHead(report, table, type, 0, viewer));
  PetscCall(TableViewRows(report, table, type, n, rows, viewer));
  PetscFunctionReturn(0);
}

/*
   Prints the forces of each load step, and tables of the forces at the end of the last load step: on each contact pair,
   face with prescribed displacements, connector and bolt.
*/
static PetscErrorCode ViewForces(const RunReport *report, PetscViewer viewer)
{
  const StepReport *last = report->nsteps ? &report->steps[report->nsteps - 1] : NULL;

  PetscFunctionBegin;
  PetscCall(ViewSteps(report, TABLE_FORCES, 1, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "balance: resultant of all forces on a body, divided by the sum of their "
                                           "magnitudes; largest value of all bodies\n"));
  if (!last) PetscFunctionReturn(0);
  PetscCall(ViewList(report, TABLE_PAIRS, &SchemaPairs, last->npairs, last->pairs, viewer));
  PetscCall(ViewList(report, TABLE_FACES, &SchemaFaces, last->nfaces, last->faces, viewer));
  PetscCall(ViewList(report, TABLE_CONNECTORS, &SchemaConnectors, last->nconnectors, last->connectors, viewer));
  PetscCall(ViewList(report, TABLE_BOLTS, &SchemaBolts, last->nbolts, last->bolts, viewer));
  PetscCall(ViewList(report, TABLE_RIGID, &SchemaRigid, last->nrigid_bodies, last->rigid_bodies, viewer));
  PetscFunctionReturn(0);
}

/*
   Prints for each load step the work of the loads since the start, the energy stored and dissipated, and the imbalance
   between them. Nothing is printed if no pair has friction.
*/
static PetscErrorCode ViewBalance(const RunReport *report, PetscViewer viewer)
{
  const StepReport *last       = report->nsteps ? &report->steps[report->nsteps - 1] : NULL;
  PetscBool         frictional = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt p = 0; last && p < last->npairs; ++p) frictional = (PetscBool)(frictional || last->pairs[p].frictional);
  if (!frictional) PetscFunctionReturn(0);
  PetscCall(ViewSteps(report, TABLE_BALANCE, 1, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscFunctionReturn(0);
}

/* Prints the plastic strains of each load step if any body has yielded at the end of the last one. */
static PetscErrorCode ViewPlasticity(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (!report->nsteps || !(report->steps[report->nsteps - 1].plastic_strain > 0.0)) PetscFunctionReturn(0);
  PetscCall(ViewSteps(report, TABLE_PLASTICITY, 2, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscFunctionReturn(0);
}

/* Prints the number of controlled time steps, the shortest one, the largest error, and how many were repeated. */
static PetscErrorCode ViewTimeSteps(const RunReport *report, PetscViewer viewer)
{
  PetscInt  n = 0, rejected = 0;
  PetscReal shortest = PETSC_INFINITY, error = 0.0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const MotionReport *motion = report->steps[s].motions;

    if (!motion) continue;
    n += report->steps[s].substeps;
    rejected += motion->rejected_steps;
    shortest = PetscMin(shortest, motion->shortest_step);
    error    = PetscMax(error, motion->time_error);
  }
  if (error > 0.0)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "time steps: %" PetscInt_FMT ", the shortest %.4g, the largest error %.3g; %" PetscInt_FMT " were repeated\n\n",
      n, (double)shortest, (double)error, rejected));
  PetscFunctionReturn(0);
}

/* Prints the load steps in which linear systems needed fallbacks after the Krylov method, and these fallbacks. */
static PetscErrorCode ViewFallbacks(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const TaoIPFilterFallbacks *linear = &report->steps[s].linear;
    const char                 *before = "linear solves: ";
    char                        text[64];

    if (!linear->refinements && !linear->amg_rebuilds && !linear->filters && !linear->direct && !linear->failures &&
        !linear->subspaces)
      continue;
    PetscCall(PetscViewerASCIIPrintf(viewer, "%5" PetscInt_FMT "  ", report->steps[s].step));
    for (const ReportField *field = SchemaFallbacks.fields; field->name; ++field) {
      const char *said = TableGetText(TABLE_FALLBACKS, field, linear, text, sizeof(text));

      if (!said) continue;
      PetscCall(PetscViewerASCIIPrintf(viewer, "%s%s", field->type == FIELD_INT ? before : "; ", said));
      before = ", ";
    }
    if (linear->subspaces)
      PetscCall(PetscViewerASCIIPrintf(viewer,
        "; the subspace method failed %" PetscInt_FMT " times; the interior point method replaced it",
        linear->subspaces));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  }
  PetscFunctionReturn(0);
}

/*
   Prints from which load step on a factorization replaced the AMG. From this step on the columns of AMG set-ups and
   applications count factorizations and solves with the factors.
*/
static PetscErrorCode ViewFactored(const RunReport *report, PetscViewer viewer)
{
  PetscInt n = 0, first = 0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    if (report->steps[s].factored && !n++) first = report->steps[s].step;
  }
  if (n)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "A factorization replaced the AMG from load step %" PetscInt_FMT " on: \"amg set-ups\" counts factorizations, "
      "\"amg applic\" counts solves with the factors\n",
      first));
  PetscFunctionReturn(0);
}

/* Prints the relative errors in energy that the solver and the mesh cause. */
static PetscErrorCode ViewErrors(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n%5s  %-27s  %s\n", "step", "relative error in energy",
    "relative error in the energy norm, and the contribution of each body"));
  PetscCall(TableViewHead(report, TABLE_ERRORS, &SchemaSteps, 1, viewer));
  PetscCall(TableViewRows(report, TABLE_ERRORS, &SchemaSteps, report->nsteps, report->steps, viewer));
  PetscFunctionReturn(0);
}

/* Prints the times with one row per phase; the last row is the total time. */
static PetscErrorCode ViewTimes(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%-15s %10s %6s\n", "phase", "time [s]", "share"));
  for (int behind = 0; behind < 2; ++behind) {
    for (const ReportField *field = SchemaTimes.fields; field->name; ++field) {
      const double time = SchemaNumber(field, &report->time);

      if (field->columns[0].behind != (PetscBool)behind) continue;
      PetscCall(PetscViewerASCIIPrintf(viewer, "%-15s %10.3f %5.1f%%\n", field->columns[0].head[0], time,
        report->time.total > 0 ? 100 * time / report->time.total : 0.0));
    }
  }
  PetscFunctionReturn(0);
}

/*
   Prints the cost of the problem without contact next to the cost with contact. The number of PCG iterations is
   compared with the largest number of any Newton system, the solve time with the mean solve time of a load step.
*/
static PetscErrorCode ViewContactFree(const RunReport *report, PetscViewer viewer)
{
  PetscInt  largest = 0;
  PetscReal mean    = 0.0;

  PetscFunctionBegin;
  if (!report->contact_free.iterations) PetscFunctionReturn(0);
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    for (PetscInt i = 0; i < report->steps[s].nksp; ++i)
      largest = PetscMax(largest, report->steps[s].ksp_iterations[i]);
    mean += report->steps[s].solve_time / report->nsteps;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "\nWithout contact: %" PetscInt_FMT " PCG iterations to 1e-10, condition number %.4g, %.3f s\n",
    report->contact_free.iterations, (double)report->contact_free.condition, report->contact_free.solve_time));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "With contact: at most %" PetscInt_FMT " PCG iterations per Newton system (upper bound in theory: %.0f); a load "
    "step takes as long as %.2f solves without contact\n",
    largest, (double)report->contact_free.bound, mean / report->contact_free.solve_time));
  PetscFunctionReturn(0);
}

/* Prints the growth of resident memory in each phase, divided by the number of unknowns. */
static PetscErrorCode ViewMemory(const RunReport *report, PetscViewer viewer)
{
  const double n = report->dofs ? 1e3 * (double)report->dofs : 1.0;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "\nPeak memory %.1f MB, %.2f kB per unknown: program %.2f, mesh %.2f, stiffness %.2f, solvers %.2f\n",
    report->peak_memory_bytes / 1e6, report->peak_memory_bytes / n, report->memory.start / n,
    (report->memory.mesh - report->memory.start) / n, (report->memory.assembly - report->memory.mesh) / n,
    (report->peak_memory_bytes - report->memory.assembly) / n));
  PetscFunctionReturn(0);
}

/*@C
   ReportView - Prints the largest values of a run: displacement, stress, plastic strain and safety factor of each body,
   force, pressure and area of each contact pair, reactions, the estimated error, time and memory

   Collective on the viewer

   Input Parameters:
+  report - the report
-  viewer - an ASCII viewer

   Level: beginner

   Note:
   The values are those of the load steps that converged, at their ends. Places are undeformed.

.seealso: `ReportViewTables()`, `ReportWriteJSON()`
@*/
PetscErrorCode ReportView(const RunReport *report, PetscViewer viewer)
{
  const char *units = report->units && report->units[0] ? report->units : NULL;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\nProblem %s: %s%s%s%s\n", report->problem, report->reason,
    units ? " (" : "", units ? units : "", units ? ")" : ""));
  if (report->nsteps && report->steps[0].step > 1)
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  largest values since the restart at the end of load step %" PetscInt_FMT "\n", report->steps[0].step - 1));
  PetscCall(ReportViewFigures(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "%.3g s, %.0f MB, %" PetscInt_FMT " unknowns, %" PetscInt_FMT " load step%s, %" PetscInt_FMT " rank%s%s%s\n",
    (double)report->time.total, report->peak_memory_bytes / 1e6, report->dofs, report->nsteps,
    report->nsteps == 1 ? "" : "s", report->ranks, report->ranks == 1 ? "" : "s", report->files ? "; files:" : "",
    report->files ? report->files : ""));
  PetscCall(ViewContactFree(report, viewer));
  PetscFunctionReturn(0);
}

/*@C
   ReportViewTables - Prints tables of a run: load steps, solver, forces, energy, errors, times, memory

   Collective on the viewer

   Input Parameters:
+  report - the report
-  viewer - an ASCII viewer

   Level: intermediate

.seealso: `ReportView()`, `ReportWriteJSON()`
@*/
PetscErrorCode ReportViewTables(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "\nProblem %s: %" PetscInt_FMT " unknowns, refinement %" PetscInt_FMT ", %" PetscInt_FMT " rank%s: %s\n",
    report->problem, report->dofs, report->refine, report->ranks, report->ranks == 1 ? "" : "s", report->reason));
  if (report->units && report->units[0]) PetscCall(PetscViewerASCIIPrintf(viewer, "Units: %s\n", report->units));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewSteps(report, TABLE_WORK, 2, viewer));
  PetscCall(ViewFactored(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewForces(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewBalance(report, viewer));
  PetscCall(ViewPlasticity(report, viewer));
  PetscCall(ViewTimeSteps(report, viewer));
  PetscCall(ViewSteps(report, TABLE_TRUTH, 2, viewer));
  PetscCall(ViewFallbacks(report, viewer));
  PetscCall(ViewErrors(report, viewer));
  if (report->accuracy) PetscCall(ReportViewAccuracy(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewTimes(report, viewer));
  PetscCall(ViewMemory(report, viewer));
  PetscFunctionReturn(0);
}
