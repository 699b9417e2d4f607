/* The report of a run as a table for people */
#include "outputimpl.h"

/* A gap in ten characters, or that there is none */
static const char *GapText(PetscReal gap, char text[16])
{
  if (PetscIsNanReal(gap)) return "no contact";
  (void)snprintf(text, 16, "%10.2e", (double)gap);
  return text;
}

static PetscErrorCode ViewSteps(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%5s %8s %8s %8s %4s %6s %6s %6s %7s  %15s %9s %10s %9s\n", "step", "load", "contact", "filter", "ip", "pcg", "pcg/ip", "amg", "amg", "energy", "KKT", "smallest", "complem."));
  PetscCall(PetscViewerASCIIPrintf(viewer, "%5s %8s %8s %8s %4s %6s %6s %6s %7s  %15s %9s %10s %9s\n", "", "factor", "rows", "dofs", "its", "its", "", "applic", "set-ups", "", "error", "gap", "error"));
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const StepReport *step = &report->steps[s];
    PetscInt          pcg  = 0;
    char              gap[16];

    for (PetscInt i = 0; i < step->nksp; ++i) pcg += step->ksp_iterations[i];
    PetscCall(PetscViewerASCIIPrintf(viewer, "%5" PetscInt_FMT " %8.4f %8" PetscInt_FMT " %8" PetscInt_FMT " %4" PetscInt_FMT " %6" PetscInt_FMT " %6.1f %6" PetscInt_FMT " %7" PetscInt_FMT "  %15.8e %9.2e %10s %9.2e%s\n", step->step, (double)step->load, step->constraints, step->filter_dofs, step->ip_iterations, pcg, step->nksp ? (double)pcg / (double)step->nksp : 0.0, step->amg_applications, step->amg_setups, (double)step->energy, (double)step->kkt_error, GapText(step->gap_min, gap), (double)step->complementarity, step->converged ? "" : "  not converged"));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewForces(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%5s  %-41s  %-41s\n", "step", "contact force on the nonmortar side", "reaction on the driven faces"));
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const PetscReal *f = report->steps[s].contact_force, *r = report->steps[s].reaction;

    PetscCall(PetscViewerASCIIPrintf(viewer, "%5" PetscInt_FMT "  %13.6e %13.6e %13.6e  %13.6e %13.6e %13.6e\n", report->steps[s].step, (double)f[0], (double)f[1], (double)f[2], (double)r[0], (double)r[1], (double)r[2]));
  }
  PetscFunctionReturn(0);
}

/* How far the step is from the truth of its own discretization, beside the optimizer's scaled KKT error */
static PetscErrorCode ViewAccuracy(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%5s %6s %5s %8s %8s  %15s %11s %9s %10s %10s %10s\n", "step", "solves", "cuts", "gap", "indef.", "potential", "equilibrium", "action =", "unscaled", "true", "gap"));
  PetscCall(PetscViewerASCIIPrintf(viewer, "%5s %6s %5s %8s %8s  %15s %11s %9s %10s %10s %10s\n", "", "", "", "updates", "systems", "", "residual", "reaction", "KKT error", "gap", "change"));
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const StepReport *step = &report->steps[s];
    char              gap[16];

    PetscCall(PetscViewerASCIIPrintf(viewer, "%5" PetscInt_FMT " %6" PetscInt_FMT " %5" PetscInt_FMT " %8" PetscInt_FMT " %8" PetscInt_FMT "  %15.8e %11.2e %9.2e %10.2e %10s %10.2e\n", step->step, step->substeps, step->cuts, step->contact_updates, step->regularizations, (double)step->potential, (double)step->equilibrium, (double)step->action_reaction, (double)step->kkt_error_unscaled, GapText(step->gap_true, gap), (double)step->gap_change));
  }
  PetscFunctionReturn(0);
}

/* Nothing is said of load steps whose linear systems the Krylov method solved by itself */
static PetscErrorCode ViewFallbacks(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const StepReport *step = &report->steps[s];

    if (!step->linear.refinements && !step->linear.amg_rebuilds && !step->linear.filters && !step->linear.direct && !step->linear.failures) continue;
    PetscCall(PetscViewerASCIIPrintf(viewer, "%5" PetscInt_FMT "  linear solves: %" PetscInt_FMT " refined, %" PetscInt_FMT " with the AMG rebuilt, %" PetscInt_FMT " with more filter, %" PetscInt_FMT " by MUMPS, %" PetscInt_FMT " failed; backward error at most %.1e\n", step->step, step->linear.refinements, step->linear.amg_rebuilds, step->linear.filters, step->linear.direct, step->linear.failures, (double)step->linear.backward_error));
  }
  PetscFunctionReturn(0);
}

/* How wrong the energy is, by the solver's doing and by the mesh's */
static PetscErrorCode ViewErrors(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n%5s  %-27s  %s\n%5s  %13s %13s  %10s", "step", "relative error in energy", "discretization error in the energy norm, and the bodies' parts of it", "", "of the solver", "of the mesh", "all"));
  for (PetscInt b = 0; b < report->nbodies; ++b) PetscCall(PetscViewerASCIIPrintf(viewer, " %10s", report->bodies[b]));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const StepReport *step = &report->steps[s];

    PetscCall(PetscViewerASCIIPrintf(viewer, "%5" PetscInt_FMT "  %13.2e", step->step, (double)step->algebraic_error));
    if (step->body_errors) {
      PetscCall(PetscViewerASCIIPrintf(viewer, " %13.2e  %8.3f %%", (double)PetscSqr(step->error_estimate), (double)(100 * step->error_estimate)));
      for (PetscInt b = 0; b < report->nbodies; ++b) PetscCall(PetscViewerASCIIPrintf(viewer, " %*.3f %%", (int)PetscMax(10, strlen(report->bodies[b])) - 2, (double)(100 * step->body_errors[b])));
    }
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewTimes(const RunReport *report, PetscViewer viewer)
{
  const struct {
    const char    *name;
    PetscLogDouble time;
  } phases[] = {
    {"mesh",         report->time.mesh        },
    {"assembly",     report->time.assembly    },
    {"contact",      report->time.contact     },
    {"AMG set-up",   report->time.amg_setup   },
    {"AMG apply",    report->time.amg_apply   },
    {"filter set-up", report->time.filter_setup},
    {"filter apply", report->time.filter_apply},
    {"error estimate", report->time.error_estimate},
    {"other",        report->time.other       },
    {"total",        report->time.total       },
  };

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%-15s %10s %6s\n", "phase", "time [s]", "share"));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(phases); ++i) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "%-15s %10.3f %5.1f%%\n", phases[i].name, phases[i].time, report->time.total > 0 ? 100 * phases[i].time / report->time.total : 0.0));
  }
  PetscFunctionReturn(0);
}

/* The yardstick beside the largest count of any Newton system */
static PetscErrorCode ViewContactFree(const RunReport *report, PetscViewer viewer)
{
  PetscInt  most = 0;
  PetscReal mean = 0.0;

  PetscFunctionBegin;
  if (!report->contact_free.iterations) PetscFunctionReturn(0);
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    for (PetscInt i = 0; i < report->steps[s].nksp; ++i) most = PetscMax(most, report->steps[s].ksp_iterations[i]);
    mean += report->steps[s].solve_time / report->nsteps;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "\nWithout contact: %" PetscInt_FMT " PCG iterations to 1e-10, condition number %.4g, %.3f s\n", report->contact_free.iterations, (double)report->contact_free.condition, report->contact_free.solve_time));
  PetscCall(PetscViewerASCIIPrintf(viewer, "With contact: at most %" PetscInt_FMT " PCG iterations a Newton system, bound %.0f; a load step costs %.2f solves without contact\n", most, (double)report->contact_free.bound, mean / report->contact_free.solve_time));
  PetscFunctionReturn(0);
}

/* Where the peak comes from: the growth of the resident set in each phase, per unknown */
static PetscErrorCode ViewMemory(const RunReport *report, PetscViewer viewer)
{
  const double n = report->dofs ? 1e3 * (double)report->dofs : 1.0;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\nPeak memory %.1f MB, %.2f kB an unknown: program %.2f, mesh %.2f, stiffness %.2f, solvers %.2f\n", report->peak_memory_bytes / 1e6, report->peak_memory_bytes / n, report->memory.start / n, (report->memory.mesh - report->memory.start) / n, (report->memory.assembly - report->memory.mesh) / n, (report->peak_memory_bytes - report->memory.assembly) / n));
  PetscFunctionReturn(0);
}

/*@C
   ReportViewEffects - Prints what the scene called for and what it did not, why, and the share of the time

   Collective on the viewer

   Input Parameters:
+  report - the report
-  viewer - an ASCII viewer

   Level: intermediate

   Note:
   An effect without a share is part of the phases it works in (an element's formulation, say, of the assembly).

.seealso: `ReportView()`
@*/
PetscErrorCode ReportViewEffects(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n%-20s %-4s %10s %6s  %s\n", "effect", "", "time [s]", "share", "why"));
  for (PetscInt i = 0; i < report->neffects; ++i) {
    const RunEffect *effect = &report->effects[i];

    if (effect->time < 0) PetscCall(PetscViewerASCIIPrintf(viewer, "%-20s %-4s %10s %6s  %s\n", effect->name, effect->on ? "on" : "off", "-", "-", effect->why));
    else PetscCall(PetscViewerASCIIPrintf(viewer, "%-20s %-4s %10.3f %5.1f%%  %s\n", effect->name, effect->on ? "on" : "off", effect->time, report->time.total > 0 ? 100 * effect->time / report->time.total : 0.0, effect->why));
  }
  PetscFunctionReturn(0);
}

/*@C
   ReportView - Prints the report of a run: steps, forces, times, memory

   Collective on the viewer

   Input Parameters:
+  report - the report
-  viewer - an ASCII viewer

   Level: beginner

.seealso: `ReportWriteJSON()`
@*/
PetscErrorCode ReportView(const RunReport *report, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "\nProblem %s: %" PetscInt_FMT " unknowns, refinement %" PetscInt_FMT ", %d rank%s: %s\n\n", report->problem, report->dofs, report->refine, report->ranks, report->ranks == 1 ? "" : "s", report->reason));
  PetscCall(ViewSteps(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewForces(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewAccuracy(report, viewer));
  PetscCall(ViewFallbacks(report, viewer));
  PetscCall(ViewErrors(report, viewer));
  if (report->accuracy) PetscCall(ReportViewAccuracy(report, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(ViewTimes(report, viewer));
  PetscCall(ViewContactFree(report, viewer));
  PetscCall(ViewMemory(report, viewer));
  PetscFunctionReturn(0);
}
