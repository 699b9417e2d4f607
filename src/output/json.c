/* The report of a run as JSON */
#include "outputimpl.h"
#include <math.h>

static void WriteString(FILE *stream, const char key[], const char text[], const char end[])
{
  fprintf(stream, "\"%s\": \"", key);
  for (const unsigned char *c = (const unsigned char *)(text ? text : ""); *c; ++c) {
    if (*c == '"' || *c == '\\') fprintf(stream, "\\%c", *c);
    else if (*c < 0x20) fprintf(stream, "\\u%04x", (unsigned)*c);
    else fputc(*c, stream);
  }
  fprintf(stream, "\"%s", end);
}

/* JSON knows neither NaN nor infinity */
static void WriteNumber(FILE *stream, double value)
{
  if (PetscIsInfOrNanReal((PetscReal)value)) fputs("null", stream);
  else fprintf(stream, "%.17g", value);
}

static void WriteReal(FILE *stream, const char key[], double value, const char end[])
{
  fprintf(stream, "\"%s\": ", key);
  WriteNumber(stream, value);
  fputs(end, stream);
}

static void WriteInt(FILE *stream, const char key[], PetscInt value, const char end[])
{
  fprintf(stream, "\"%s\": %" PetscInt_FMT "%s", key, value, end);
}

static void WriteVector(FILE *stream, const char key[], const PetscReal value[3], const char end[])
{
  fprintf(stream, "\"%s\": [", key);
  for (PetscInt i = 0; i < 3; ++i) {
    if (i) fputs(", ", stream);
    WriteNumber(stream, (double)value[i]);
  }
  fprintf(stream, "]%s", end);
}

static void WriteErrors(FILE *stream, const RunReport *report, const StepReport *step, const char end[])
{
  WriteReal(stream, "error_estimate", step->body_errors ? (double)step->error_estimate : NAN, end);
  fputs("\"body_errors\": {", stream);
  for (PetscInt b = 0; b < report->nbodies; ++b) WriteReal(stream, report->bodies[b], step->body_errors ? (double)step->body_errors[b] : NAN, b + 1 < report->nbodies ? ", " : "");
  fprintf(stream, "}%s", end);
}

static void WriteStep(FILE *stream, const RunReport *report, const StepReport *step)
{
  const char *next = ",\n      ";

  fputs("    {\n      ", stream);
  WriteInt(stream, "step", step->step, next);
  WriteReal(stream, "load", (double)step->load, next);
  WriteInt(stream, "constraints", step->constraints, next);
  WriteInt(stream, "filter_dofs", step->filter_dofs, next);
  WriteInt(stream, "ip_iterations", step->ip_iterations, next);
  fputs("\"ksp_iterations\": [", stream);
  for (PetscInt i = 0; i < step->nksp; ++i) fprintf(stream, "%s%" PetscInt_FMT, i ? ", " : "", step->ksp_iterations[i]);
  fprintf(stream, "]%s", next);
  WriteInt(stream, "amg_applications", step->amg_applications, next);
  WriteInt(stream, "amg_setups", step->amg_setups, next);
  WriteInt(stream, "substeps", step->substeps, next);
  WriteInt(stream, "cuts", step->cuts, next);
  WriteInt(stream, "contact_updates", step->contact_updates, next);
  WriteInt(stream, "regularizations", step->regularizations, next);
  WriteInt(stream, "systems", step->systems, next);
  WriteInt(stream, "filtered_systems", step->filtered_systems, next);
  fputs("\"linear\": {", stream);
  WriteInt(stream, "refinements", step->linear.refinements, ", ");
  WriteInt(stream, "amg_rebuilds", step->linear.amg_rebuilds, ", ");
  WriteInt(stream, "filters", step->linear.filters, ", ");
  WriteInt(stream, "direct", step->linear.direct, ", ");
  WriteInt(stream, "failures", step->linear.failures, ", ");
  WriteReal(stream, "backward_error", (double)step->linear.backward_error, "}");
  fputs(next, stream);
  WriteReal(stream, "energy", (double)step->energy, next);
  WriteReal(stream, "potential", (double)step->potential, next);
  WriteReal(stream, "equilibrium", (double)step->equilibrium, next);
  WriteReal(stream, "kkt_error", (double)step->kkt_error, next);
  WriteReal(stream, "kkt_error_unscaled", (double)step->kkt_error_unscaled, next);
  WriteReal(stream, "gap_min", (double)step->gap_min, next);
  WriteReal(stream, "gap_true", (double)step->gap_true, next);
  WriteReal(stream, "gap_change", (double)step->gap_change, next);
  fprintf(stream, "\"gap_untrue\": %s%s", step->gap_untrue ? "true" : "false", next);
  WriteReal(stream, "complementarity", (double)step->complementarity, next);
  WriteReal(stream, "action_reaction", (double)step->action_reaction, next);
  WriteReal(stream, "algebraic_error", (double)step->algebraic_error, next);
  WriteErrors(stream, report, step, next);
  WriteVector(stream, "contact_force", step->contact_force, next);
  WriteVector(stream, "reaction", step->reaction, next);
  WriteReal(stream, "solve_time", (double)step->solve_time, next);
  fprintf(stream, "\"converged\": %s%s", step->converged ? "true" : "false", next);
  WriteString(stream, "reason", step->reason, "\n    }");
}

static void WriteAssemblies(FILE *stream, const RunReport *report)
{
  fputs("\"assemblies\": {", stream);
  for (PetscInt b = 0; b < report->nbodies; ++b) WriteInt(stream, report->bodies[b], report->assemblies[b], b + 1 < report->nbodies ? ", " : "");
  fputs("},\n  ", stream);
}

static void WriteEffects(FILE *stream, const RunReport *report)
{
  fputs("\"effects\": [", stream);
  for (PetscInt e = 0; e < report->neffects; ++e) {
    const RunEffect *effect = &report->effects[e];

    fputs(e ? ",\n    {" : "\n    {", stream);
    WriteString(stream, "name", effect->name, ", ");
    fprintf(stream, "\"on\": %s, ", effect->on ? "true" : "false");
    WriteString(stream, "why", effect->why, ", ");
    WriteReal(stream, "time", effect->time < 0 ? NAN : effect->time, "}");
  }
  fputs("\n  ],\n  ", stream);
}

static void WriteAccuracy(FILE *stream, const Accuracy *acc)
{
  if (!acc) return;
  fputs("\"accuracy\": {\n    ", stream);
  WriteReal(stream, "target", (double)acc->target, ",\n    ");
  WriteReal(stream, "share", (double)acc->share, ",\n    ");
  WriteReal(stream, "tolerance", (double)acc->tolerance, ",\n    ");
  fprintf(stream, "\"reached\": %s,\n    ", acc->reached ? "true" : "false");
  WriteString(stream, "end", acc->end, ",\n    \"levels\": [");
  for (PetscInt l = 0; l < acc->nlevels; ++l) {
    const AccuracyLevel *level = &acc->levels[l];

    fputs(l ? ",\n      {" : "\n      {", stream);
    WriteInt(stream, "refine", level->refine, ", ");
    WriteInt(stream, "dofs", level->dofs, ", ");
    WriteReal(stream, "recovery", (double)level->recovery, ", ");
    WriteReal(stream, "change", level->coarser ? (double)level->change : NAN, ", ");
    WriteReal(stream, "error", (double)level->error, ", ");
    WriteReal(stream, "algebraic", (double)level->algebraic, ", ");
    WriteReal(stream, "time", level->time, "}");
  }
  fputs("\n    ]\n  },\n  ", stream);
}

static PetscErrorCode WriteReport(FILE *stream, const void *ctx)
{
  const RunReport *report = (const RunReport *)ctx;

  PetscFunctionBegin;
  fputs("{\n  ", stream);
  WriteString(stream, "problem", report->problem, ",\n  ");
  WriteInt(stream, "ranks", report->ranks, ",\n  ");
  WriteInt(stream, "dofs", report->dofs, ",\n  ");
  WriteInt(stream, "refine", report->refine, ",\n  ");
  fprintf(stream, "\"converged\": %s,\n  ", report->converged ? "true" : "false");
  WriteString(stream, "reason", report->reason, ",\n  \"steps\": [\n");
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    WriteStep(stream, report, &report->steps[s]);
    fputs(s + 1 < report->nsteps ? ",\n" : "\n", stream);
  }
  fputs("  ],\n  \"time\": {\n    ", stream);
  WriteReal(stream, "total", report->time.total, ",\n    ");
  WriteReal(stream, "mesh", report->time.mesh, ",\n    ");
  WriteReal(stream, "assembly", report->time.assembly, ",\n    ");
  WriteReal(stream, "contact", report->time.contact, ",\n    ");
  WriteReal(stream, "amg_setup", report->time.amg_setup, ",\n    ");
  WriteReal(stream, "amg_apply", report->time.amg_apply, ",\n    ");
  WriteReal(stream, "filter_setup", report->time.filter_setup, ",\n    ");
  WriteReal(stream, "filter_apply", report->time.filter_apply, ",\n    ");
  WriteReal(stream, "error_estimate", report->time.error_estimate, ",\n    ");
  WriteReal(stream, "other", report->time.other, "\n  },\n  ");
  WriteAssemblies(stream, report);
  WriteAccuracy(stream, report->accuracy);
  WriteEffects(stream, report);
  fputs("\"contact_free\": {\n    ", stream);
  WriteInt(stream, "iterations", report->contact_free.iterations, ",\n    ");
  WriteReal(stream, "condition", (double)report->contact_free.condition, ",\n    ");
  WriteReal(stream, "bound", (double)report->contact_free.bound, ",\n    ");
  WriteReal(stream, "solve_time", report->contact_free.solve_time, "\n  },\n  ");
  fputs("\"memory\": {\n    ", stream);
  WriteReal(stream, "start", report->memory.start, ",\n    ");
  WriteReal(stream, "mesh", report->memory.mesh, ",\n    ");
  WriteReal(stream, "assembly", report->memory.assembly, "\n  },\n  ");
  WriteReal(stream, "peak_memory_bytes", report->peak_memory_bytes, "\n}\n");
  PetscFunctionReturn(0);
}

/*@C
   ReportWriteJSON - Writes the report of a run for programs

   Collective

   Input Parameters:
+  comm   - the communicator; its first rank writes
.  report - the report, the same on every rank
-  file   - the file; an older one is replaced when the new one is whole

   Level: intermediate

   Note:
   The keys are the members of RunReport and StepReport. Numbers have full precision; NaN and infinity become null.

   Errors: PETSC_ERR_FILE_OPEN, on all ranks, where the file cannot be written.

.seealso: `ReportView()`
@*/
PetscErrorCode ReportWriteJSON(MPI_Comm comm, const RunReport *report, const char file[])
{
  PetscFunctionBegin;
  PetscCall(FileWriteText(comm, file, WriteReport, report));
  PetscFunctionReturn(0);
}
