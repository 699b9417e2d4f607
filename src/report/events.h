/* Log events of the mechanics library, and the times of the phases of a run, which are computed from them */
#ifndef EVENTS_H
#define EVENTS_H

#include <report.h>

PETSC_INTERN PetscLogEvent MESH_Create, ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error, CONTACT_Linearize,
  CONTACT_Search, CONTACT_Integrate, SIM_Mesh, SIM_SetUp, SIM_Assembly, SIM_Energy, SIM_Solve, SIM_Forces, SIM_Results,
  SIM_Comparison;

/* The solve without contact: its AMG counts to no other phase */
PETSC_INTERN PetscLogStage  SIM_ComparisonStage;
PETSC_INTERN PetscErrorCode EventsRegister(void);
PETSC_INTERN PetscErrorCode EventsRead(RunTimes *);
PETSC_INTERN PetscErrorCode EventsGetTimes(MPI_Comm, const RunTimes *start, RunTimes *);

#endif
