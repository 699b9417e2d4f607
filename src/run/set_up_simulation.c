/* Sets up the simulation of a scene: mesh, elasticity, loads, contact, report */
#include "runimpl.h"
#include "src/state/contact_history.h"
#include "src/state/control.h"
#include "src/state/path.h"
#include "src/state/results.h"
#include "src/state/run.h"

static PetscErrorCode SimulationSetUpElasticity(Simulation sim)
{
  Scene        scene = sim->model->scene;
  Material    *materials;
  ElementType *elements;
  PetscBool    linear;
  IS           rows;
  Bodies       bodies;
  Constraints  constraints;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &materials, scene->nbodies, &elements));
  for (PetscInt b = 0; b < scene->nbodies; ++b) materials[b] = scene->bodies[b].material;
  PetscCall(SceneChooseElements(scene, sim->model->dm, elements, NULL));
  PetscCall(ElasticityCreate(sim->model->dm, scene->nbodies, materials, elements, &sim->model->elasticity));
  PetscCall(PetscFree2(materials, elements));
  PetscCall(ElasticityIsLinear(sim->model->elasticity, &linear));
  sim->model->quadratic = (PetscBool)(linear || scene->model == MODEL_QUADRATIC);
  PetscCall(VertexPlacesCreate(sim->model->dm, &sim->model->places));
  PetscCall(PrescribedCreate(sim->model->dm, scene, &sim->model->places, &sim->model->prescribed));
  PetscCall(
    ISCreateGeneral(sim->model->comm, sim->model->prescribed.n, sim->model->prescribed.rows, PETSC_USE_POINTER, &rows));
  PetscCall(ElasticitySetPrescribed(sim->model->elasticity, rows));
  PetscCall(ISDestroy(&rows));
  PetscCall(DeadLoadsCreate(scene, sim->model->dm, sim->model->elasticity, &sim->model->loads));
  PetscCall(TemperaturesCreate(scene, sim->model->elasticity, sim->model->comm, &sim->model->temperatures));
  PetscCall(ElasticityLumpedMass(sim->model->elasticity, &sim->model->mass));
  bodies = ModelBodies(sim->model);
  PetscCall(SpringsMeasureStiffness(&bodies, &sim->model->stiffness));
  PetscCall(SpringsCreate(&bodies, &sim->model->springs));
  PetscCall(BoltsCreate(&bodies, &sim->model->bolts));
  PetscCall(StiffnessSetType(sim->model));
  constraints = ModelConstraints(sim->model);
  PetscCall(TiesCreate(&constraints));
  PetscCall(DynamicsCreate(&constraints, &sim->model->loads, &sim->model->springs, &sim->model->dynamics));
  if (ModelIsDynamic(sim->model)) PetscCall(DeadLoadsGet(&sim->model->loads, 0.0, &sim->state->path->outside));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetUpTangent(Model model, State state)
{
  const Constraints constraints = ModelConstraints(model);
  PetscBool         linear;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityIsLinear(model->elasticity, &linear));
  PetscCall(TiesCreateTangent(&constraints, &model->K));
  if (linear || model->ties.C) PetscCall(TiesTangent(&constraints, state->path->u, model->K));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetUpContact(Model model, State state)
{
  Scene scene = model->scene;

  PetscFunctionBegin;
  if (!scene->npairs) PetscFunctionReturn(0);
  PetscCall(ContactCreate(model->dm, scene->npairs, scene->pairs, &model->contact));
  PetscCall(ContactSetBodies(model->contact, scene->bodies));
  PetscCall(ContactSetFromOptions(model->contact));
  PetscCall(ContactSetDisplacements(model->contact, scene->ndisplacements, scene->displacements));
  PetscCall(ContactSetCyclic(model->contact, scene->ncyclic, scene->cyclic));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *pair = &scene->pairs[p];

    SceneCheck(!SceneContactPairIsSoft(pair) || (!SchemeIsImpact(&scene->dynamics) && !scene->displacement_bounds),
      model->comm, PETSC_ERR_SUP, pair,
      "contact pair \"%s\" has %s, which cannot be combined with displacement_bounds or the scheme impact of dynamics; "
      "use the scheme generalized_alpha",
      pair->name, pair->stiffness > 0.0 ? "contact_stiffness" : "contact_exponential");
  }
  PetscCall(ContactHistoryCreate(model->dm, scene, state->history));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetUpReport(Simulation sim)
{
  RunReport  *report = &sim->report;
  Scene       scene  = sim->model->scene;
  PetscMPIInt size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(sim->model->comm, &size));
  report->ranks = size;
  PetscCall(VecGetSize(sim->state->path->u, &report->dofs));
  report->problem   = scene->name;
  report->units     = scene->units ? scene->units : "";
  report->refine    = scene->refine;
  report->converged = PETSC_TRUE;
  report->reason    = "all load steps converged";
  report->nbodies   = scene->nbodies;
  PetscCall(PetscCalloc1(scene->nsteps, &report->steps));
  PetscCall(PetscMalloc2(scene->nbodies, &report->bodies, scene->nbodies, &report->assemblies));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    report->bodies[b]     = scene->bodies[b].name;
    report->finite_strain = (PetscBool)(report->finite_strain || MaterialIsFinite(&scene->bodies[b].material));
  }
  PetscFunctionReturn(0);
}

/* Warns of the bodies that can rotate freely although the scene has no weak springs. With weak_springs it is a note. */
static PetscErrorCode SimulationReportRotations(Model model, State state, RunReport *report)
{
  Scene scene = model->scene;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies && model->springs.rotations; ++b) {
    char axis[160];

    if (!model->springs.rotations[b].free) continue;
    PetscCall(RotationDescribe(&model->springs.rotations[b], sizeof(axis), axis));
    if (!scene->weak_springs)
      PetscCall(ReportWarn(model->comm, report, scene->bodies[b].place,
        "body \"%s\" can turn %s: no contact or support resists; weak springs of %g of its stiffness hold it",
        scene->bodies[b].name, axis, (double)model->springs.softness));
    else if (state->control->monitor)
      PetscCall(
        PetscPrintf(model->comm, "Body \"%s\" can turn %s: only weak springs resist\n", scene->bodies[b].name, axis));
  }
  PetscFunctionReturn(0);
}

/* Creates mesh, elastic bodies, dead loads, ties and contact pairs, and refuses what is wrong with them */
static PetscErrorCode SimulationSetUpMesh(Simulation sim)
{
  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(PlausibleTest(sim->model, &sim->report));
  PetscCall(MeshCreateScene(sim->model->comm, sim->model->scene, sim->run->marks, &sim->model->dm));
  PetscCall(MeshCheckScene(sim->model->dm, sim->model->scene));
  PetscCall(ProbesCreate(sim->model->dm, sim->model->scene, &sim->results->probes));
  PetscCall(PetscLogEventEnd(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(MemoryUsageGet(sim->model->comm, &sim->report.memory.mesh));
  PetscCall(PetscLogEventBegin(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscCall(DMCreateGlobalVector(sim->model->dm, &sim->state->path->u));
  PetscCall(VecSet(sim->state->path->u, 0.0));
  PetscCall(VecDuplicate(sim->state->path->u, &sim->state->path->previous_u));
  PetscCall(VecSet(sim->state->path->previous_u, 0.0));
  PetscCall(SimulationSetUpElasticity(sim));
  PetscCall(SimulationSetUpContact(sim->model, sim->state));
  PetscCall(PetscLogEventEnd(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*@C
   SimulationCheck - Refuses what SimulationSetUp() refuses, without the cost of a tangent

   Collective

   Input Parameter:
.  sim - the simulation. Afterwards only its mesh may be used

   Level: intermediate

.seealso: `SimulationSetUp()`, `SimulationGetDM()`
@*/
PetscErrorCode SimulationCheck(Simulation sim)
{
  PetscFunctionBegin;
  PetscCall(SimulationSetUpMesh(sim));
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetUp - Creates the mesh, the elastic bodies and their tangent, dead loads and contact pairs of the scene,
   at time 0 with zero displacement

   Collective

   Input Parameter:
.  sim - the simulation

   Level: beginner

.seealso: `SimulationCreate()`, `SimulationStep()`
@*/
PetscErrorCode SimulationSetUp(Simulation sim)
{
  PetscFunctionBegin;
  PetscCall(EventsRead(&sim->run->start));
  PetscCall(MemoryUsageGet(sim->model->comm, &sim->report.memory.start));
  PetscCall(SimulationSetUpMesh(sim));
  PetscCall(SimulationSetUpTangent(sim->model, sim->state));
  PetscCall(MemoryUsageGet(sim->model->comm, &sim->report.memory.assembly));
  PetscCall(PetscLogEventBegin(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscCall(SimulationSetUpReport(sim));
  PetscCall(SimulationReportRotations(sim->model, sim->state, &sim->report));
  PetscCall(PetscLogEventEnd(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
