/* Log events of a run, and the times of its phases, which are computed from them */
#include "events.h"
#include <petsctime.h>

PetscLogEvent MESH_Create, ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error, CONTACT_Linearize, CONTACT_Search,
  CONTACT_Integrate, SIM_Mesh, SIM_SetUp, SIM_Assembly, SIM_Energy, SIM_Solve, SIM_Forces, SIM_Results, SIM_Comparison;
PetscLogStage SIM_ComparisonStage;

#define NO_PHASE (-1)

/*
   All events. event: NULL if PCAMGF or TAOIPFILTER registers it; time: the phase to which its time belongs; within: the
   phase of which the event is a part, and whose time does not include that of the event.
*/
static const struct {
  PetscLogEvent *event;
  const char    *name;
  PetscInt       time, within;
} events[] = {
  {&MESH_Create, "MeshCreate", NO_PHASE, NO_PHASE},
  {&ELASTICITY_Tangent, "ElastTangent", NO_PHASE, NO_PHASE},
  {&ELASTICITY_Force, "ElastForce", NO_PHASE, NO_PHASE},
  {&ELASTICITY_Error, "ElastError", offsetof(RunTimes, error_estimate), NO_PHASE},
  {&CONTACT_Linearize, "ContactLinear", offsetof(RunTimes, contact), NO_PHASE},
  {&CONTACT_Search, "ContactSearch", offsetof(RunTimes, contact_search), offsetof(RunTimes, contact)},
  {&CONTACT_Integrate, "ContactIntegr", offsetof(RunTimes, contact_integrals), offsetof(RunTimes, contact)},
  {&SIM_Mesh, "SimMesh", offsetof(RunTimes, mesh), NO_PHASE},
  {&SIM_SetUp, "SimSetUp", offsetof(RunTimes, setup), NO_PHASE},
  {&SIM_Assembly, "SimAssembly", offsetof(RunTimes, assembly), NO_PHASE},
  {&SIM_Energy, "SimEnergy", offsetof(RunTimes, assembly), offsetof(RunTimes, optimizer)},
  {&SIM_Solve, "SimSolve", offsetof(RunTimes, optimizer), NO_PHASE},
  {&SIM_Forces, "SimForces", offsetof(RunTimes, measures), NO_PHASE},
  {&SIM_Results, "SimResults", offsetof(RunTimes, results), NO_PHASE},
  {&SIM_Comparison, "SimComparison", offsetof(RunTimes, comparison), NO_PHASE},
  {NULL, "PCAMGFAMGSetUp", offsetof(RunTimes, amg_setup), offsetof(RunTimes, optimizer)},
  {NULL, "PCAMGFAMGApply", offsetof(RunTimes, amg_apply), offsetof(RunTimes, optimizer)},
  {NULL, "PCAMGFFltSetUp", offsetof(RunTimes, filter_setup), offsetof(RunTimes, optimizer)},
  {NULL, "PCAMGFFltApply", offsetof(RunTimes, filter_apply), offsetof(RunTimes, optimizer)},
  {NULL, "TaoIPFltDirect", offsetof(RunTimes, directions), offsetof(RunTimes, optimizer)},
  {NULL, "TaoIPFltReduced", offsetof(RunTimes, reduced), offsetof(RunTimes, optimizer)},
  {NULL, "TaoIPFltFactor", offsetof(RunTimes, reduced_factor), offsetof(RunTimes, reduced)},
};

static PetscLogDouble *EventsTime(RunTimes *times, PetscInt offset)
{
  return (PetscLogDouble *)((char *)times + offset);
}

/* Registers the events; further calls do nothing */
PetscErrorCode EventsRegister(void)
{
  static PetscBool registered = PETSC_FALSE;
  PetscClassId     classid;

  PetscFunctionBegin;
  if (registered) PetscFunctionReturn(0);
  registered = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Simulation", &classid));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(events); ++i) {
    if (events[i].event) PetscCall(PetscLogEventRegister(events[i].name, classid, events[i].event));
  }
  PetscCall(PetscLogStageRegister("Without contact", &SIM_ComparisonStage));
  PetscFunctionReturn(0);
}

/*
   Reads the clock (total) and the time of each phase since PETSc's start, on this rank. The times of phases are 0
   without PETSc's logging.
*/
PetscErrorCode EventsRead(RunTimes *times)
{
  PetscBool logs;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(times, sizeof(*times)));
  PetscCall(PetscLogIsActive(&logs));
  for (size_t i = 0; logs && i < PETSC_STATIC_ARRAY_LENGTH(events); ++i) {
    PetscLogEvent      event;
    PetscEventPerfInfo info;

    PetscCall(PetscLogEventGetId(events[i].name, &event));
    if (event < 0 || events[i].time == NO_PHASE) continue;
    PetscCall(PetscLogEventGetPerfInfo(0, event, &info));
    *EventsTime(times, events[i].time) += info.time;
    if (events[i].within != NO_PHASE) *EventsTime(times, events[i].within) -= info.time;
  }
  PetscCall(PetscTime(&times->total));
  PetscFunctionReturn(0);
}

/*
   Computes the times since `start`, the largest over the ranks. "other" is the part of the total that belongs to no
   phase.
*/
PetscErrorCode EventsGetTimes(MPI_Comm comm, const RunTimes *start, RunTimes *times)
{
  const PetscInt        n   = sizeof(*times) / sizeof(PetscLogDouble);
  const PetscLogDouble *was = (const PetscLogDouble *)start;
  PetscLogDouble       *now = (PetscLogDouble *)times, sum = 0.0;

  PetscFunctionBegin;
  PetscCall(EventsRead(times));
  for (PetscInt i = 0; i < n; ++i) {
    now[i] = PetscMax(now[i] - was[i], 0.0);
    sum += now[i];
  }
  times->other = PetscMax(0.0, 2.0 * times->total - sum); /* sum includes the total */
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, times, (PetscMPIInt)(sizeof(*times) / sizeof(PetscLogDouble)), MPI_DOUBLE,
    MPI_MAX, comm));
  PetscFunctionReturn(0);
}
