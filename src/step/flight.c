/* A body that nothing stops lets the energy fall without end: which one it is. */
#include "stepimpl.h"

/* largest[body]: displacement of any of its nodes, by components */
static PetscErrorCode FlightMeasure(Simulation sim, Vec u, PetscReal largest[])
{
  DMLabel            label;
  PetscSection       section;
  PetscInt           cstart, cend, n, nodes[MESH_MAX_NODES], body, offset;
  Vec                local;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(largest, sim->scene->nbodies));
  PetscCall(DMGetLabel(sim->dm, MESH_BODY_LABEL, &label));
  PetscCall(DMGetLocalSection(sim->dm, &section));
  PetscCall(DMGetLocalVector(sim->dm, &local));
  PetscCall(DMGlobalToLocal(sim->dm, u, INSERT_VALUES, local));
  PetscCall(VecGetArrayRead(local, &x));
  PetscCall(DMPlexGetHeightStratum(sim->dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscCall(DMLabelGetValue(label, c, &body));
    PetscCall(MeshGetCellNodes(sim->dm, c, &n, nodes));
    for (PetscInt a = 0; a < n; ++a) {
      PetscCall(PetscSectionGetOffset(section, nodes[a], &offset));
      for (PetscInt i = 0; i < 3; ++i) largest[body] = PetscMax(largest[body], PetscAbsScalar(x[offset + i]));
    }
  }
  PetscCall(VecRestoreArrayRead(local, &x));
  PetscCall(DMRestoreLocalVector(sim->dm, &local));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, (PetscMPIInt)sim->scene->nbodies, MPIU_REAL, MPIU_MAX, sim->comm));
  PetscFunctionReturn(0);
}

/* Collective. Adds to the reason of a step that failed so the body that moves the farthest at u */
PetscErrorCode FlightReport(Simulation sim, Vec u, StepReport *report)
{
  PetscReal *largest;
  PetscInt   farthest = 0;
  char       reason[512];

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(sim->scene->nbodies, &largest));
  PetscCall(FlightMeasure(sim, u, largest));
  for (PetscInt b = 1; b < sim->scene->nbodies; ++b) {
    if (largest[b] > largest[farthest]) farthest = b;
  }
  PetscCall(PetscSNPrintf(reason, sizeof(reason), "%s; body \"%s\" moves the farthest, by %g: nothing stops it", report->reason, sim->scene->bodies[farthest].name, (double)largest[farthest]));
  PetscCall(PetscFree(largest));
  PetscCall(ReportReason(report, PETSC_FALSE, reason));
  PetscFunctionReturn(0);
}
