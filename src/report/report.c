/* Adds the results of a solve to the report of its load step */
#include "reportimpl.h"
#include <stdarg.h>

/*
   Collective. Prints a warning on stderr, and stores it for the summary. place: place of the entry of the scene that
   the warning is about; NULL: it is about no entry, or about one that does not come from a file.
*/
PetscErrorCode ReportWarn(MPI_Comm comm, RunReport *report, const char place[], const char format[], ...)
{
  char    sentence[1024];
  size_t  length;
  va_list args;

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(sentence, place ? place : "", sizeof(sentence)));
  PetscCall(PetscStrlen(sentence, &length));
  va_start(args, format);
  PetscCall(PetscVSNPrintf(sentence + length, sizeof(sentence) - length, format, NULL, args));
  va_end(args);
  PetscCall(PetscFPrintf(comm, stderr, "contact: warning: %s\n", sentence));
  PetscCall(PetscRealloc((size_t)(report->nwarnings + 1) * sizeof(*report->warnings), &report->warnings));
  PetscCall(PetscStrallocpy(sentence, (char **)&report->warnings[report->nwarnings++]));
  PetscFunctionReturn(0);
}

/* Sets whether the load step converged, and the reason, of which the former one may be a part. The values of the last
   solve remain. */
PetscErrorCode ReportReason(StepReport *report, PetscBool converged, const char format[], ...)
{
  char    reason[1024];
  va_list args;

  PetscFunctionBegin;
  va_start(args, format);
  PetscCall(PetscVSNPrintf(reason, sizeof(reason), format, NULL, args));
  va_end(args);
  report->converged = converged;
  PetscCall(PetscFree(*(char **)&report->reason));
  PetscCall(PetscStrallocpy(reason, (char **)&report->reason));
  PetscFunctionReturn(0);
}

/* Fails the run for the reason for which a load step that was already accepted has failed */
void ReportFailRun(RunReport *run, StepReport *report, RunEnd end)
{
  if (end == RUN_GAP_UNCONVERGED) report->gap_unconverged = PETSC_TRUE;
  run->converged = PETSC_FALSE;
  run->reason    = report->reason;
  run->exit_code = end;
}

/* Appends the numbers of Krylov iterations of n linear solves */
PetscErrorCode ReportIterations(StepReport *report, PetscInt n, const PetscInt iterations[])
{
  PetscFunctionBegin;
  PetscCall(PetscRealloc((report->nksp + n) * sizeof(PetscInt), &report->ksp_iterations));
  PetscCall(PetscArraycpy(report->ksp_iterations + report->nksp, iterations, n));
  report->nksp += n;
  PetscFunctionReturn(0);
}

/* Gets what the preconditioner has counted so far; zeros if it is not a PCAMGF */
PetscErrorCode ReportGetCounts(KSP ksp, PCAMGFCounts *counts)
{
  PC        pc;
  PetscBool isamgf;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(counts, sizeof(*counts)));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &isamgf));
  if (isamgf) PetscCall(PCAMGFGetCounts(pc, counts));
  PetscFunctionReturn(0);
}

/*
   Adds what the preconditioner did since `before`. A PCAMGF counts its applications; any other PC is applied once per
   iteration.
*/
PetscErrorCode ReportPreconditioner(KSP ksp, const PCAMGFCounts *before, StepReport *report)
{
  PC           pc;
  PetscBool    isamgf;
  PCAMGFCounts counts;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &isamgf));
  if (isamgf) {
    PetscCall(PCAMGFGetCounts(pc, &counts));
    PetscCall(PCAMGFGetFilterSize(pc, &report->filter_dofs));
    report->amg_applications += counts.amg_applies - before->amg_applies;
    report->amg_setups += counts.amg_setups - before->amg_setups;
    PetscCall(PCAMGFGetFactored(pc, &report->factored));
  } else {
    report->amg_applications = 0;
    for (PetscInt i = 0; i < report->nksp; ++i) report->amg_applications += report->ksp_iterations[i];
    report->amg_setups = report->nksp;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ReportFallbacks(StepReport *report, const TaoIPFilterFallbacks *solve)
{
  TaoIPFilterFallbacks *sum = &report->linear;

  PetscFunctionBegin;
  sum->refinements += solve->refinements;
  sum->amg_rebuilds += solve->amg_rebuilds;
  sum->filters += solve->filters;
  sum->direct += solve->direct;
  sum->failures += solve->failures;
  sum->subspaces += solve->subspaces;
  sum->backward_error = PetscMax(sum->backward_error, solve->backward_error);
  PetscFunctionReturn(0);
}
