/* Log events of a run, and the times of its phases, which are computed from them */
#include "reportimpl.h"
#include <petsctime.h>

PetscLogEvent SIM_Mesh, SIM_SetUp, SIM_Assembly, SIM_Energy, SIM_Solve, SIM_Forces, SIM_Results, SIM_Comparison;
PetscLogStage SIM_ComparisonStage;

#define NO_PHASE (-1)

/*
   The events of the phases. within: the phase of which an event is a part, and whose time does not include that of the
   event.
*/
static const struct {
  const char *event;
  PetscInt    time, within;
} phases[] = {
  {"SimMesh", offsetof(RunTimes, mesh), NO_PHASE},
  {"SimSetUp", offsetof(RunTimes, setup), NO_PHASE},
  {"SimAssembly", offsetof(RunTimes, assembly), NO_PHASE},
  {"SimEnergy", offsetof(RunTimes, assembly), offsetof(RunTimes, optimizer)},
  {"ContactLinear", offsetof(RunTimes, contact), NO_PHASE},
  {"ContactSearch", offsetof(RunTimes, contact_search), offsetof(RunTimes, contact)},
  {"ContactIntegr", offsetof(RunTimes, contact_integrals), offsetof(RunTimes, contact)},
  {"PCAMGFAMGSetUp", offsetof(RunTimes, amg_setup), offsetof(RunTimes, optimizer)},
  {"PCAMGFAMGApply", offsetof(RunTimes, amg_apply), offsetof(RunTimes, optimizer)},
  {"PCAMGFFltSetUp", offsetof(RunTimes, filter_setup), offsetof(RunTimes, optimizer)},
  {"PCAMGFFltApply", offsetof(RunTimes, filter_apply), offsetof(RunTimes, optimizer)},
  {"TaoIPFltDirect", offsetof(RunTimes, directions), offsetof(RunTimes, optimizer)},
  {"TaoIPFltReduced", offsetof(RunTimes, reduced), offsetof(RunTimes, optimizer)},
  {"TaoIPFltFactor", offsetof(RunTimes, reduced_factor), offsetof(RunTimes, reduced)},
  {"SimSolve", offsetof(RunTimes, optimizer), NO_PHASE},
  {"SimForces", offsetof(RunTimes, measures), NO_PHASE},
  {"ElastError", offsetof(RunTimes, error_estimate), NO_PHASE},
  {"SimResults", offsetof(RunTimes, results), NO_PHASE},
  {"SimComparison", offsetof(RunTimes, comparison), NO_PHASE},
};

static PetscLogDouble *EventsTime(RunTimes *times, PetscInt offset)
{
  return (PetscLogDouble *)((char *)times + offset);
}

PetscErrorCode StepEventsRegister(void)
{
  static PetscBool registered = PETSC_FALSE;
  PetscClassId     classid;

  PetscFunctionBegin;
  if (registered) PetscFunctionReturn(0);
  registered = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Simulation", &classid));
  PetscCall(PetscLogEventRegister("SimMesh", classid, &SIM_Mesh));
  PetscCall(PetscLogEventRegister("SimSetUp", classid, &SIM_SetUp));
  PetscCall(PetscLogEventRegister("SimAssembly", classid, &SIM_Assembly));
  PetscCall(PetscLogEventRegister("SimEnergy", classid, &SIM_Energy));
  PetscCall(PetscLogEventRegister("SimSolve", classid, &SIM_Solve));
  PetscCall(PetscLogEventRegister("SimForces", classid, &SIM_Forces));
  PetscCall(PetscLogEventRegister("SimResults", classid, &SIM_Results));
  PetscCall(PetscLogEventRegister("SimComparison", classid, &SIM_Comparison));
  PetscCall(PetscLogStageRegister("Without contact", &SIM_ComparisonStage));
  PetscFunctionReturn(0);
}

/*
   Reads the clock (total) and the time of each phase since PETSc's start, on this rank. The times of phases are 0
   without PETSc's logging.
*/
PetscErrorCode StepEventsRead(RunTimes *times)
{
  PetscBool logs;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(times, sizeof(*times)));
  PetscCall(PetscLogIsActive(&logs));
  for (size_t i = 0; logs && i < PETSC_STATIC_ARRAY_LENGTH(phases); ++i) {
    PetscLogEvent      event;
    PetscEventPerfInfo info;

    PetscCall(PetscLogEventGetId(phases[i].event, &event));
    if (event < 0) continue;
    PetscCall(PetscLogEventGetPerfInfo(0, event, &info));
    *EventsTime(times, phases[i].time) += info.time;
    if (phases[i].within != NO_PHASE) *EventsTime(times, phases[i].within) -= info.time;
  }
  PetscCall(PetscTime(&times->total));
  PetscFunctionReturn(0);
}

/*
   Computes the times since `start`, the largest over the ranks. "other" is the part of the total that belongs to no
   phase.
*/
PetscErrorCode StepEventsGetTimes(MPI_Comm comm, const RunTimes *start, RunTimes *times)
{
  const PetscInt        n   = sizeof(*times) / sizeof(PetscLogDouble);
  const PetscLogDouble *was = (const PetscLogDouble *)start;
  PetscLogDouble       *now = (PetscLogDouble *)times, sum = 0.0;

  PetscFunctionBegin;
  PetscCall(StepEventsRead(times));
  for (PetscInt i = 0; i < n; ++i) {
    now[i] = PetscMax(now[i] - was[i], 0.0);
    sum += now[i];
  }
  times->other = PetscMax(0.0, 2.0 * times->total - sum); /* sum includes the total */
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, times, (PetscMPIInt)(sizeof(*times) / sizeof(PetscLogDouble)), MPI_DOUBLE,
    MPI_MAX, comm));
  PetscFunctionReturn(0);
}
