/* The life of a simulation: from the scene to the parts, then one load step after another. */
#include "stepimpl.h"
#include <petsctime.h>

PetscLogEvent SIM_Mesh, SIM_Assembly, SIM_Contact, SIM_Solve;

static PetscErrorCode SimulationRegisterEvents(void)
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
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationCreateElasticity(Simulation sim)
{
  Scene     scene = sim->scene;
  Material *materials;
  IS        rows;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &materials));
  for (PetscInt b = 0; b < scene->nbodies; ++b) materials[b] = scene->bodies[b].material;
  PetscCall(ElasticityCreate(sim->dm, scene->nbodies, materials, NULL, &sim->elasticity));
  PetscCall(PetscFree(materials));
  PetscCall(PrescribedCreate(sim->dm, scene->ndisplacements, scene->displacements, &sim->prescribed));
  PetscCall(ISCreateGeneral(sim->comm, sim->prescribed.n, sim->prescribed.rows, PETSC_USE_POINTER, &rows));
  PetscCall(ElasticitySetPrescribed(sim->elasticity, rows));
  PetscCall(ISDestroy(&rows));
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityCreateTangent(sim->elasticity, &sim->K));
  PetscCall(ElasticityTangent(sim->elasticity, sim->path.u, sim->K));
  PetscCall(ElasticityLumpedMass(sim->elasticity, &sim->mass));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationCreateContact(Simulation sim)
{
  Scene        scene = sim->scene;
  ContactPair *pairs;

  PetscFunctionBegin;
  if (!scene->npairs) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(scene->npairs, &pairs));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    pairs[p].mortar    = scene->pairs[p].mortar;
    pairs[p].nonmortar = scene->pairs[p].nonmortar;
  }
  PetscCall(ContactCreate(sim->dm, scene->npairs, pairs, &sim->contact));
  PetscCall(PetscFree(pairs));
  PetscCall(ContactSetFromOptions(sim->contact));
  PetscCall(ContactMemoryCreate(sim->dm, scene->npairs, &sim->memory));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetFromOptions(Simulation sim)
{
  PetscFunctionBegin;
  sim->warm = PETSC_TRUE;
  PetscOptionsBegin(sim->comm, NULL, "Load steps", NULL);
  PetscCall(PetscOptionsBool("-load_warm_start", "Start a load step from the path and the pressures of the last", "SimulationStep", sim->warm, &sim->warm, NULL));
  PetscOptionsEnd();
  PetscFunctionReturn(0);
}

/*@C
   SimulationCreate - Builds what a scene calls for: mesh, elastic bodies and their tangent, and the contact pairs if
   it names any.

   Collective

   Input Parameters:
+  comm  - the communicator
-  scene - the scene; must outlive the simulation

   Output Parameter:
.  sim - the simulation, at load 0 with zero displacement

   Options Database Key:
.  -load_warm_start <bool> - start a load step from the path and the pressures of the last one; default true

   Level: beginner

.seealso: `SimulationStep()`, `SimulationDestroy()`, `SceneLoad()`
@*/
PetscErrorCode SimulationCreate(MPI_Comm comm, Scene scene, Simulation *sim)
{
  Simulation s;

  PetscFunctionBegin;
  PetscCall(SimulationRegisterEvents());
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscNew(&s));
  s->comm  = comm;
  s->scene = scene;
  PetscCall(SimulationSetFromOptions(s));
  PetscCall(PetscTime(&s->start));
  PetscCall(PetscLogEventBegin(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(MeshCreate(comm, scene->nbodies, scene->bodies, scene->refine, &s->dm));
  PetscCall(PetscLogEventEnd(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(DMCreateGlobalVector(s->dm, &s->path.u));
  PetscCall(VecSet(s->path.u, 0.0));
  PetscCall(VecDuplicate(s->path.u, &s->path.previous_u));
  PetscCall(VecSet(s->path.previous_u, 0.0));
  PetscCall(SimulationCreateElasticity(s));
  PetscCall(SimulationCreateContact(s));
  PetscCallMPI(MPI_Comm_size(comm, &s->report.ranks));
  PetscCall(VecGetSize(s->path.u, &s->report.dofs));
  s->report.problem   = scene->name;
  s->report.refine    = scene->refine;
  s->report.converged = PETSC_TRUE;
  s->report.reason    = "all load steps converged";
  PetscCall(PetscCalloc1(scene->nsteps, &s->report.steps));
  *sim = s;
  PetscFunctionReturn(0);
}

/*@C
   SimulationGetDM - The mesh of all bodies, borrowed.

   Not Collective

   Level: intermediate
@*/
PetscErrorCode SimulationGetDM(Simulation sim, DM *dm)
{
  PetscFunctionBegin;
  *dm = sim->dm;
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationLinearizeContact(Simulation sim)
{
  PetscFunctionBegin;
  PetscCall(ContactLinearizationDestroy(&sim->linearization));
  if (!sim->contact) PetscFunctionReturn(0);
  PetscCall(PetscLogEventBegin(SIM_Contact, NULL, NULL, NULL, NULL));
  PetscCall(ContactLinearize(sim->contact, sim->path.u, &sim->linearization));
  PetscCall(PetscLogEventEnd(SIM_Contact, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* The step's displacement becomes the state; it is refused when the solve failed, so the last good state stays */
static PetscErrorCode SimulationAdvance(Simulation sim, PetscReal load, Vec *u)
{
  Vec oldest = sim->path.previous_u;

  PetscFunctionBegin;
  sim->path.previous_u    = sim->path.u;
  sim->path.previous_load = sim->path.load;
  sim->path.u             = *u;
  sim->path.load          = load;
  *u                      = oldest;
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationKeepSurface(Simulation sim, const ContactSolution *sol)
{
  const PetscInt     n = sim->linearization ? sim->linearization->nlocal : 0;
  const PetscScalar *z, *g;

  PetscFunctionBegin;
  PetscCall(PetscFree2(sim->pressure, sim->gap));
  if (!sol->pressure) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(n, &sim->pressure, n, &sim->gap));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  for (PetscInt i = 0; i < n; ++i) {
    sim->pressure[i] = PetscRealPart(z[i]);
    sim->gap[i]      = PetscRealPart(g[i]);
  }
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationGetState(Simulation sim, const StepReport *report, StepState *state)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(sim->stress));
  PetscCall(ElasticityCellStress(sim->elasticity, sim->path.u, &sim->stress));
  state->report       = report;
  state->displacement = sim->path.u;
  state->stress       = sim->stress;
  state->nrows        = sim->linearization ? sim->linearization->nlocal : 0;
  state->row_vertex   = sim->linearization ? sim->linearization->vertex : NULL;
  state->pressure     = sim->pressure;
  state->gap          = sim->gap;
  PetscFunctionReturn(0);
}

/*@C
   SimulationStep - Solves the next load step.

   Collective

   Input Parameters:
+  sim  - the simulation
-  step - number of the step, from 0; steps are taken in order

   Output Parameter:
.  state - what the step left, borrowed until the next step. Look at state->report->converged: where it is false the
           displacement is that of the last converged step

   Level: beginner

   Notes:
   The gap is linearized at the state before the step: deformed mesh, search, mortar integrals. A scene without contact
   pairs costs one PCG solve (options prefix -elasticity_) and neither search nor optimizer.

.seealso: `SimulationCreate()`, `SimulationGetReport()`, `TAOIPFILTER`
@*/
PetscErrorCode SimulationStep(Simulation sim, PetscInt step, StepState *state)
{
  StepReport     *report = &sim->report.steps[step];
  QuadraticModel  model;
  ContactSolution solution = {NULL, NULL};
  Vec             u;

  PetscFunctionBegin;
  report->step = step + 1;
  report->load = sim->scene->ramps[0].factor[step];
  PetscCall(SimulationLinearizeContact(sim));
  PetscCall(QuadraticCreate(sim, report->load, &model));
  PetscCall(VecDuplicate(sim->path.u, &u));
  PetscCall(PetscLogEventBegin(SIM_Solve, NULL, NULL, NULL, NULL));
  if (sim->linearization) {
    PetscCall(QuadraticSetContact(&model, &sim->prescribed, sim->linearization, sim->path.u));
    PetscCall(QuadraticSolveContact(sim, &model, u, report, &solution));
  } else PetscCall(QuadraticSolveFree(&model, u, report));
  PetscCall(PetscLogEventEnd(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscCall(ReportStepForces(sim, &model, u, &solution, report));
  PetscCall(SimulationKeepSurface(sim, &solution));
  sim->report.nsteps = step + 1;
  if (report->converged) PetscCall(SimulationAdvance(sim, report->load, &u));
  else {
    sim->report.converged = PETSC_FALSE;
    sim->report.reason    = report->reason;
  }
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&solution.pressure));
  PetscCall(VecDestroy(&solution.gap));
  PetscCall(QuadraticDestroy(&model));
  PetscCall(SimulationGetState(sim, report, state));
  PetscFunctionReturn(0);
}

/*@C
   SimulationDestroy - Frees a simulation and its report.

   Collective

   Level: beginner
@*/
PetscErrorCode SimulationDestroy(Simulation *sim)
{
  Simulation s = *sim;

  PetscFunctionBegin;
  if (!s) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < s->report.nsteps; ++i) {
    PetscCall(PetscFree(s->report.steps[i].ksp_iterations));
    PetscCall(PetscFree(*(char **)&s->report.steps[i].reason));
  }
  PetscCall(PetscFree(s->report.steps));
  PetscCall(PetscFree2(s->pressure, s->gap));
  PetscCall(PetscFree(s->stress));
  PetscCall(ContactLinearizationDestroy(&s->linearization));
  PetscCall(ContactMemoryDestroy(&s->memory));
  PetscCall(ContactDestroy(&s->contact));
  PetscCall(PrescribedDestroy(&s->prescribed));
  PetscCall(ElasticityDestroy(&s->elasticity));
  PetscCall(MatDestroy(&s->K));
  PetscCall(VecDestroy(&s->mass));
  PetscCall(VecDestroy(&s->path.u));
  PetscCall(VecDestroy(&s->path.previous_u));
  PetscCall(DMDestroy(&s->dm));
  PetscCall(PetscFree(*sim));
  PetscFunctionReturn(0);
}
