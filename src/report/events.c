/* PETSc's log events of a run, and times of its phases from them. */
#include "reportimpl.h"
#include <petsctime.h>

PetscLogEvent SIM_Mesh, SIM_Assembly, SIM_Contact, SIM_Solve, SIM_Forces, SIM_Results;

/* Events of the phases: ours, the preconditioner's, the error estimator's */
static const struct {
  const char *event;
  size_t      time;
} phases[] = {
  {"SimMesh", offsetof(RunTimes, mesh)},
  {"SimAssembly", offsetof(RunTimes, assembly)},
  {"SimContact", offsetof(RunTimes, contact)},
  {"PCAMGFAMGSetUp", offsetof(RunTimes, amg_setup)},
  {"PCAMGFAMGApply", offsetof(RunTimes, amg_apply)},
  {"PCAMGFFltSetUp", offsetof(RunTimes, filter_setup)},
  {"PCAMGFFltApply", offsetof(RunTimes, filter_apply)},
  {"ElastError", offsetof(RunTimes, error_estimate)},
  {"SimResults", offsetof(RunTimes, results)},
};

PetscErrorCode StepEventsRegister(void)
{
  static PetscBool registered = PETSC_FALSE;
  PetscClassId     classid;

  PetscFunctionBegin;
  if (registered) PetscFunctionReturn(0);
  registered = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Simulation", &classid));
  PetscCall(PetscLogEventRegister("SimMesh", classid, &SIM_Mesh));
  PetscCall(PetscLogEventRegister("SimAssembly", classid, &SIM_Assembly));
  PetscCall(PetscLogEventRegister("SimContact", classid, &SIM_Contact));
  PetscCall(PetscLogEventRegister("SimSolve", classid, &SIM_Solve));
  PetscCall(PetscLogEventRegister("SimForces", classid, &SIM_Forces));
  PetscCall(PetscLogEventRegister("SimResults", classid, &SIM_Results));
  PetscFunctionReturn(0);
}

/* Reads the clock (total), and the time of each phase since PETSc's start, on this rank; 0 without PETSc's logging */
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
    *(PetscLogDouble *)((char *)times + phases[i].time) = info.time;
  }
  PetscCall(PetscTime(&times->total));
  PetscFunctionReturn(0);
}

/* Times since `start`, largest over the ranks; "other" is the rest of the total */
PetscErrorCode StepEventsGetTimes(MPI_Comm comm, const RunTimes *start, RunTimes *times)
{
  PetscLogDouble sum = 0.0;

  PetscFunctionBegin;
  PetscCall(StepEventsRead(times));
  times->total -= start->total;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(phases); ++i) {
    PetscLogDouble *time = (PetscLogDouble *)((char *)times + phases[i].time);

    *time -= *(const PetscLogDouble *)((const char *)start + phases[i].time);
    sum += *time;
  }
  times->other = PetscMax(0.0, times->total - sum);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, times, (PetscMPIInt)(sizeof(*times) / sizeof(PetscLogDouble)), MPI_DOUBLE,
    MPI_MAX, comm));
  PetscFunctionReturn(0);
}
