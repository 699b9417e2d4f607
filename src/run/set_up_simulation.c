/* Sets up the simulation of a scene: mesh, elasticity, loads, contact, report */
#include "runimpl.h"
#include "src/state/contact_history.h"
#include "src/state/control.h"
#include "src/state/path.h"
#include "src/state/results.h"
#include "src/state/run.h"

static PetscErrorCode SimulationSetUpElasticity(Simulation sim)
{
  Scene        scene = sim->scene;
  Material    *materials;
  ElementType *elements;
  PetscBool    linear;
  IS           rows;
  Bodies       bodies;
  Constraints  constraints;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &materials, scene->nbodies, &elements));
  for (PetscInt b = 0; b < scene->nbodies; ++b) materials[b] = scene->bodies[b].material;
  PetscCall(SceneChooseElements(scene, sim->dm, elements, NULL));
  PetscCall(ElasticityCreate(sim->dm, scene->nbodies, materials, elements, &sim->elasticity));
  PetscCall(PetscFree2(materials, elements));
  PetscCall(ElasticityIsLinear(sim->elasticity, &linear));
  sim->quadratic = (PetscBool)(linear || scene->model == MODEL_QUADRATIC);
  PetscCheck(sim->control->penalty == 0.0 || SchemeShare(&scene->dynamics) == 1.0, sim->comm, PETSC_ERR_SUP,
    "-contact_penalty does not support scheme impact of dynamics: omit the option, or use generalized_alpha");
  PetscCheck(sim->control->penalty == 0.0 || (sim->quadratic && !scene->displacement_bounds), sim->comm, PETSC_ERR_SUP,
    "-contact_penalty needs load steps that are quadratic and without displacement bounds: linear bodies, or model "
    "quadratic");
  PetscCall(VertexPlacesCreate(sim->dm, &sim->places));
  PetscCall(PrescribedCreate(sim->dm, scene, &sim->places, &sim->prescribed));
  PetscCall(ISCreateGeneral(sim->comm, sim->prescribed.n, sim->prescribed.rows, PETSC_USE_POINTER, &rows));
  PetscCall(ElasticitySetPrescribed(sim->elasticity, rows));
  PetscCall(ISDestroy(&rows));
  PetscCall(DeadLoadsCreate(scene, sim->dm, sim->elasticity, &sim->loads));
  PetscCall(TemperaturesCreate(scene, sim->elasticity, sim->comm, &sim->temperatures));
  PetscCall(ElasticityLumpedMass(sim->elasticity, &sim->mass));
  bodies = SimulationBodies(sim);
  PetscCall(SpringsMeasureStiffness(&bodies, &sim->stiffness));
  PetscCall(SpringsCreate(&bodies, &sim->springs));
  PetscCall(BoltsCreate(&bodies, &sim->bolts));
  PetscCall(StiffnessSetType(sim));
  constraints = SimulationConstraints(sim);
  PetscCall(TiesCreate(&constraints));
  PetscCall(DynamicsCreate(&constraints, &sim->loads, &sim->springs, &sim->dynamics));
  if (SimulationIsDynamic(sim)) PetscCall(DeadLoadsGet(&sim->loads, 0.0, &sim->path->outside));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetUpTangent(Simulation sim)
{
  const Constraints constraints = SimulationConstraints(sim);
  PetscBool         linear;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityIsLinear(sim->elasticity, &linear));
  PetscCall(TiesCreateTangent(&constraints, &sim->K));
  if (linear || sim->ties.C) PetscCall(TiesTangent(&constraints, sim->path->u, sim->K));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetUpContact(Simulation sim)
{
  Scene scene = sim->scene;

  PetscFunctionBegin;
  if (!scene->npairs) PetscFunctionReturn(0);
  PetscCall(ContactCreate(sim->dm, scene->npairs, scene->pairs, &sim->contact));
  PetscCall(ContactSetBodies(sim->contact, scene->bodies));
  PetscCall(ContactSetFromOptions(sim->contact));
  PetscCall(ContactSetDisplacements(sim->contact, scene->ndisplacements, scene->displacements));
  PetscCall(ContactSetCyclic(sim->contact, scene->ncyclic, scene->cyclic));
  for (PetscInt p = 0; p < scene->npairs; ++p)
    PetscCheck(sim->control->penalty == 0.0 || !SceneContactPairHasFriction(&scene->pairs[p]), sim->comm, PETSC_ERR_SUP,
      "-contact_penalty does not support friction, but contact pair \"%s\" has friction", scene->pairs[p].name);
  PetscCall(ContactHistoryCreate(sim->dm, scene, sim->history));
  PetscFunctionReturn(0);
}

static PetscErrorCode SimulationSetUpReport(Simulation sim)
{
  RunReport  *report = &sim->report;
  Scene       scene  = sim->scene;
  PetscMPIInt size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(sim->comm, &size));
  report->ranks = size;
  PetscCall(VecGetSize(sim->path->u, &report->dofs));
  report->problem   = scene->name;
  report->units     = scene->units ? scene->units : "";
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

/* Warns of the bodies that can rotate freely although the scene has no weak springs. With weak_springs it is a note. */
static PetscErrorCode SimulationReportRotations(Simulation sim)
{
  Scene scene = sim->scene;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies && sim->springs.rotations; ++b) {
    char axis[160];

    if (!sim->springs.rotations[b].free) continue;
    PetscCall(RotationDescribe(&sim->springs.rotations[b], sizeof(axis), axis));
    if (!scene->weak_springs)
      PetscCall(ReportWarn(sim->comm, &sim->report, scene->bodies[b].place,
        "body \"%s\" can turn %s: no contact or support resists; weak springs of %g of its stiffness hold it",
        scene->bodies[b].name, axis, (double)sim->springs.softness));
    else if (sim->control->monitor)
      PetscCall(
        PetscPrintf(sim->comm, "Body \"%s\" can turn %s: only weak springs resist\n", scene->bodies[b].name, axis));
  }
  PetscFunctionReturn(0);
}

/* Creates mesh, elastic bodies, dead loads, ties and contact pairs, and refuses what is wrong with them */
static PetscErrorCode SimulationSetUpMesh(Simulation sim)
{
  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(PlausibleTest(sim));
  PetscCall(MeshCreateScene(sim->comm, sim->scene, sim->run->marks, &sim->dm));
  PetscCall(MeshCheckScene(sim->dm, sim->scene));
  PetscCall(ProbesCreate(sim->dm, sim->scene, &sim->results->probes));
  PetscCall(PetscLogEventEnd(SIM_Mesh, NULL, NULL, NULL, NULL));
  PetscCall(MemoryUsageGet(sim->comm, &sim->report.memory.mesh));
  PetscCall(PetscLogEventBegin(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscCall(DMCreateGlobalVector(sim->dm, &sim->path->u));
  PetscCall(VecSet(sim->path->u, 0.0));
  PetscCall(VecDuplicate(sim->path->u, &sim->path->previous_u));
  PetscCall(VecSet(sim->path->previous_u, 0.0));
  PetscCall(SimulationSetUpElasticity(sim));
  PetscCall(SimulationSetUpContact(sim));
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
  PetscCall(MemoryUsageGet(sim->comm, &sim->report.memory.start));
  PetscCall(SimulationSetUpMesh(sim));
  PetscCall(SimulationSetUpTangent(sim));
  PetscCall(MemoryUsageGet(sim->comm, &sim->report.memory.assembly));
  PetscCall(PetscLogEventBegin(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscCall(ForecastSetUp(sim));
  PetscCall(SimulationSetUpReport(sim));
  PetscCall(SimulationReportRotations(sim));
  PetscCall(PetscLogEventEnd(SIM_SetUp, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
