/* The life of a simulation: from the scene to the parts, then one load step after another. */
#include "stepimpl.h"
#include <math.h>
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
  Scene        scene = sim->scene;
  Material    *materials;
  ElementType *elements;
  PetscBool    linear;
  IS           rows;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &materials, scene->nbodies, &elements));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    materials[b] = scene->bodies[b].material;
    elements[b]  = scene->bodies[b].element;
  }
  PetscCall(ElasticityCreate(sim->dm, scene->nbodies, materials, elements, &sim->elasticity));
  PetscCall(PetscFree2(materials, elements));
  PetscCall(ElasticityIsLinear(sim->elasticity, &linear));
  sim->quadratic = (PetscBool)(linear || scene->model == MODEL_QUADRATIC);
  PetscCheck(sim->penalty == 0.0 || (sim->quadratic && !scene->displacement_bounds), sim->comm, PETSC_ERR_SUP, "-contact_penalty needs load steps that are quadratic and without displacement bounds: linear bodies, or model quadratic");
  PetscCall(PrescribedCreate(sim->dm, scene, &sim->prescribed));
  PetscCall(ISCreateGeneral(sim->comm, sim->prescribed.n, sim->prescribed.rows, PETSC_USE_POINTER, &rows));
  PetscCall(ElasticitySetPrescribed(sim->elasticity, rows));
  PetscCall(ISDestroy(&rows));
  PetscCall(DeadLoadsCreate(scene, sim->dm, sim->elasticity, &sim->loads));
  PetscCall(StiffnessSetType(sim));
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityCreateTangent(sim->elasticity, &sim->K));
  if (linear) PetscCall(ElasticityTangent(sim->elasticity, sim->path.u, sim->K));
  PetscCall(ElasticityLumpedMass(sim->elasticity, &sim->mass));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationCreateContact(Simulation sim)
{
  Scene scene = sim->scene;

  PetscFunctionBegin;
  if (!scene->npairs) PetscFunctionReturn(0);
  PetscCall(ContactCreate(sim->dm, scene->npairs, scene->pairs, &sim->contact));
  PetscCall(ContactSetFromOptions(sim->contact));
  PetscCall(ContactMemoryCreate(sim->dm, scene->npairs, &sim->memory));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetFromOptions(Simulation sim)
{
  PetscFunctionBegin;
  sim->warm       = PETSC_TRUE;
  sim->estimate   = PETSC_TRUE;
  sim->maxcuts    = 5;
  sim->update_tol = 1e-6;
  PetscOptionsBegin(sim->comm, NULL, "Load steps", NULL);
  PetscCall(PetscOptionsBool("-load_warm_start", "Start a load step from the path and the pressures of the last", "SimulationStep", sim->warm, &sim->warm, NULL));
  PetscCall(PetscOptionsBoundedInt("-load_max_cuts", "How often a load step that fails is halved", "SimulationStep", sim->maxcuts, &sim->maxcuts, NULL, 0));
  PetscCall(PetscOptionsBool("-load_monitor", "Say why a load step is cut, and how the gap changes when it is linearized again", "SimulationStep", sim->monitor, &sim->monitor, NULL));
  PetscCall(PetscOptionsBool("-error_estimate", "Estimate the discretization error at the end of every load step", "SimulationStep", sim->estimate, &sim->estimate, NULL));
  PetscCall(PetscOptionsReal("-contact_update_tol", "Change of the gap, relative to the largest displacement, that ends its updates", "SimulationStep", sim->update_tol, &sim->update_tol, NULL));
  PetscCall(PetscOptionsReal("-contact_penalty", "Solve by the penalty method: stiffness of the contact by that of the bodies at a row (0: by the interior point method)", "SimulationStep", sim->penalty, &sim->penalty, NULL));
  PetscOptionsEnd();
  PetscCheck(sim->penalty >= 0.0 && !PetscIsInfOrNanReal(sim->penalty), sim->comm, PETSC_ERR_ARG_OUTOFRANGE, "-contact_penalty must not be negative, but is %g", (double)sim->penalty);
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationCreateReport(Simulation sim)
{
  RunReport *report = &sim->report;
  Scene      scene  = sim->scene;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(sim->comm, &report->ranks));
  PetscCall(VecGetSize(sim->path.u, &report->dofs));
  report->problem   = scene->name;
  report->refine    = scene->refine;
  report->converged = PETSC_TRUE;
  report->reason    = "all load steps converged";
  report->nbodies   = scene->nbodies;
  PetscCall(PetscCalloc1(scene->nsteps, &report->steps));
  PetscCall(PetscMalloc2(scene->nbodies, &report->bodies, scene->nbodies, &report->assemblies));
  for (PetscInt b = 0; b < scene->nbodies; ++b) report->bodies[b] = scene->bodies[b].name;
  PetscCall(EffectsCreate(sim, report));
  PetscFunctionReturn(0);
}

/*@C
   SimulationCreate - Builds what a scene calls for: mesh, elastic bodies and their tangent, dead loads, and the contact
   pairs if it names any.

   Collective

   Input Parameters:
+  comm  - the communicator
-  scene - the scene; must outlive the simulation

   Output Parameter:
.  sim - the simulation, at time 0 with zero displacement

   Options Database Keys:
+  -load_warm_start <bool>    - start a load step from the path and the pressures of the last one; default true
.  -load_max_cuts <5>         - how often a load step that fails is halved
.  -load_monitor              - say why a load step is cut, and how the gap changes when it is linearized again
.  -error_estimate <bool>     - estimate the discretization error at the end of every load step; default true
.  -contact_update_tol <1e-6> - change of the gap, relative to the largest displacement, that ends its updates
-  -contact_penalty <0>       - if positive, quadratic load steps are solved by the penalty method instead of TAOIPFILTER: the
                                stiffness of the contact, as a multiple of that of the bodies at a row. Its PETSc solvers have
                                the prefix penalty_. The faces penetrate by about pressure times the bodies' flexibility over this

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
  PetscCall(ReportEventTimes(s->events));
  PetscCall(ReportResident(comm, &s->report.memory.start));
  PetscCall(PetscLogEventBegin(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(MeshCreate(comm, scene->nbodies, scene->bodies, scene->refine, &s->dm));
  PetscCall(MeshCheckScene(s->dm, scene));
  PetscCall(PetscLogEventEnd(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(ReportResident(comm, &s->report.memory.mesh));
  PetscCall(DMCreateGlobalVector(s->dm, &s->path.u));
  PetscCall(VecSet(s->path.u, 0.0));
  PetscCall(VecDuplicate(s->path.u, &s->path.previous_u));
  PetscCall(VecSet(s->path.previous_u, 0.0));
  PetscCall(SimulationCreateElasticity(s));
  PetscCall(ReportResident(comm, &s->report.memory.assembly));
  PetscCall(SimulationCreateContact(s));
  PetscCall(SimulationCreateReport(s));
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

/* Half of what was tried; false when the step has been cut often enough */
static PetscErrorCode SimulationCut(Simulation sim, StepReport *report, PetscReal *increment, PetscBool *again)
{
  const PetscBool nothing = (PetscBool)(sim->quadratic && !sim->contact); /* a linear system does not get easier */

  PetscFunctionBegin;
  *again = (PetscBool)(!nothing && !sim->interrupted && report->cuts < sim->maxcuts);
  if (!*again) PetscFunctionReturn(0);
  ++report->cuts;
  *increment *= 0.5;
  if (sim->monitor) PetscCall(PetscPrintf(sim->comm, "Load step %" PetscInt_FMT " cut to time %g: %s\n", report->step, (double)(sim->path.time + *increment), report->reason));
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
           displacement is that of the last converged solve

   Level: beginner

   Notes:
   The gap is linearized at the state before the step: deformed mesh, search, mortar integrals; and as often again at what
   was found as the scene's contact_updates allow, until it is true. Linear bodies, and the scene's `model quadratic`, make the
   step a quadratic program; else the true energy is minimized. A quadratic step without contact pairs costs one PCG solve
   (options prefix -elasticity_) and neither search nor optimizer.

   A step that fails is halved, tried again from the last good state, and doubled after each success.

.seealso: `SimulationCreate()`, `SimulationGetReport()`, `TAOIPFILTER`
@*/
PetscErrorCode SimulationStep(Simulation sim, PetscInt step, StepState *state)
{
  StepReport     *report    = &sim->report.steps[step];
  const PetscReal end       = (PetscReal)(step + 1);
  PetscReal       increment = end - sim->path.time;
  PetscBool       again     = PETSC_TRUE, stop;

  PetscFunctionBegin;
  report->step       = step + 1;
  report->gap_min    = report->gap_true = NAN;
  report->load       = sim->scene->ramps[0].factor[step];
  sim->report.nsteps = step + 1;
  while (again && sim->path.time < end) {
    const PetscReal left = end - sim->path.time;

    PetscCall(InterruptTest(sim, &stop));
    if (stop) {
      PetscCall(InterruptReport(sim, report));
      break;
    }
    if (increment > left * (1.0 - PETSC_SQRT_MACHINE_EPSILON)) increment = left;
    PetscCall(SimulationAttempt(sim, increment == left ? end : sim->path.time + increment, report));
    if (report->converged) {
      ++report->substeps;
      increment *= 2.0;
    } else PetscCall(SimulationCut(sim, report, &increment, &again));
  }
  if (!report->converged) {
    sim->report.converged = PETSC_FALSE;
    sim->report.reason    = report->reason;
  } else if (report->gap_untrue) sim->report.reason = report->reason;
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
    PetscCall(PetscFree(s->report.steps[i].body_errors));
    PetscCall(PetscFree(*(char **)&s->report.steps[i].reason));
  }
  PetscCall(PetscFree(s->report.steps));
  PetscCall(PetscFree2(s->report.bodies, s->report.assemblies));
  PetscCall(PetscFree(s->report.effects));
  PetscCall(PetscFree2(s->pressure, s->gap));
  PetscCall(PetscFree(s->stress));
  PetscCall(ContactLinearizationDestroy(&s->linearization));
  PetscCall(ContactLinearizationDestroy(&s->upcoming));
  PetscCall(ContactMemoryDestroy(&s->memory));
  PetscCall(ContactDestroy(&s->contact));
  PetscCall(PrescribedDestroy(&s->prescribed));
  PetscCall(DeadLoadsDestroy(&s->loads));
  PetscCall(KSPDestroy(&s->ksp));
  PetscCall(ElasticityDestroy(&s->elasticity));
  PetscCall(MatDestroy(&s->K));
  PetscCall(VecDestroy(&s->mass));
  PetscCall(VecDestroy(&s->path.u));
  PetscCall(VecDestroy(&s->path.previous_u));
  PetscCall(DMDestroy(&s->dm));
  PetscCall(PetscFree(*sim));
  PetscFunctionReturn(0);
}
