/* The state of a simulation that a restart needs: displacements and contact history */
#include "checkpointimpl.h"
#include "src/measure/measureimpl.h"
#include "src/state/contact_history.h"
#include "src/state/control.h"
#include "src/state/path.h"

/* Adds a field with the values of a global vector; NULL: zeros */
static PetscErrorCode CheckpointAddVec(Checkpoint checkpoint, const char name[], PetscInt nvertices, Vec v)
{
  const PetscScalar *a;
  PetscReal         *values;

  PetscFunctionBegin;
  PetscCall(CheckpointAddField(checkpoint, name, 3, nvertices, &values));
  if (!v) PetscFunctionReturn(0);
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < 3 * nvertices; ++i) values[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckpointGetVec(Checkpoint checkpoint, const char name[], Vec v)
{
  const PetscReal *values;
  PetscScalar     *a;
  PetscInt         n;

  PetscFunctionBegin;
  PetscCall(CheckpointGetField(checkpoint, name, &values));
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayWrite(v, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = values[i];
  PetscCall(VecRestoreArrayWrite(v, &a));
  PetscFunctionReturn(0);
}

/* Replaces *force by a new vector with the layout of u, and reads its values */
static PetscErrorCode CheckpointGetForce(Checkpoint checkpoint, const char name[], Vec u, Vec *force)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(force));
  PetscCall(VecDuplicate(u, force));
  PetscCall(CheckpointGetVec(checkpoint, name, *force));
  PetscFunctionReturn(0);
}

/*
   Restores velocities and accelerations, and computes the forces at rest. path.u, path.time, path.contact and the
   plastic strains must have been restored, since these forces depend on them and on the temperatures at that time.
*/
static PetscErrorCode CheckpointGetMotion(Model model, State state, Checkpoint checkpoint)
{
  const Constraints constraints = ModelConstraints(model);
  Dynamics         *d           = &model->dynamics;

  PetscFunctionBegin;
  d->damped  = checkpoint->damping_work;
  d->fastest = checkpoint->largest_speed;
  PetscCall(CheckpointGetVec(checkpoint, "velocity", d->velocity));
  PetscCall(CheckpointGetVec(checkpoint, "acceleration", d->acceleration));
  PetscCall(CheckpointGetVec(checkpoint, "auxiliary_acceleration", d->auxiliary));
  PetscCall(TemperaturesApply(&model->temperatures, state->path->time));
  PetscCall(DynamicsSetRest(&constraints, &model->loads, state->path->time, state->path->u, d));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckpointCopyContact(Model model, State state, Checkpoint checkpoint, PetscBool back)
{
  const PetscInt   nvertices                      = state->history->nowned;
  PetscReal *const memory[CHECKPOINT_PAIR_FIELDS] = {
    [CHECKPOINT_PRESSURE]   = state->history->pressure,
    [CHECKPOINT_SLACK]      = state->history->slack,
    [CHECKPOINT_SHEAR]      = state->history->settled,
    [CHECKPOINT_FRICTION]   = state->history->friction,
    [CHECKPOINT_BOUND]      = state->history->bound,
    [CHECKPOINT_SLIP_PATH]  = state->history->slip_path,
    [CHECKPOINT_DISSIPATED] = state->history->dissipated,
  };

  PetscFunctionBegin;
  for (PetscInt p = 0; model->contact && p < model->scene->npairs; ++p) {
    for (int k = 0; k < CHECKPOINT_PAIR_FIELDS; ++k) {
      const PetscInt components = CheckpointPairFields[k].components;
      char           name[128];
      PetscBool      kept;
      PetscReal     *values;

      PetscCall(CheckpointNamePairField(&model->scene->pairs[p], (CheckpointPairKind)k, sizeof(name), name, &kept));
      if (!kept) continue;
      if (back) PetscCall(CheckpointGetField(checkpoint, name, (const PetscReal **)&values));
      else PetscCall(CheckpointAddField(checkpoint, name, components, nvertices, &values));
      if (back) PetscCall(PetscArraycpy(memory[k] + components * p * nvertices, values, components * nvertices));
      else PetscCall(PetscArraycpy(values, memory[k] + components * p * nvertices, components * nvertices));
    }
  }
  PetscFunctionReturn(0);
}

/* Copies which pairs use dual functions to the checkpoint, or from there if `back` */
static PetscErrorCode CheckpointCopyDualGaps(Contact contact, Checkpoint checkpoint, PetscBool back)
{
  ContactDualPairs dual;
  PetscBool        changed;

  PetscFunctionBegin;
  if (!contact) PetscFunctionReturn(0);
  PetscCall(ContactGetDual(contact, &dual));
  if (!back) checkpoint->dual_gaps = dual == CONTACT_DUAL_AUTO;
  else if (checkpoint->dual_gaps > 0.0) PetscCall(ContactSetDual(contact, CONTACT_DUAL_AUTO, &changed));
  PetscFunctionReturn(0);
}

/*@C
   SimulationGetCheckpoint - Gets the state of a simulation, after a load step or after an interruption

   Collective

   Input Parameter:
.  sim - the simulation

   Output Parameter:
.  checkpoint - the state; free with CheckpointDestroy()

   Level: intermediate

   Note:
   It does not contain the directions that the optimizer keeps: the first load step after a restart computes them again.

.seealso: `SimulationSetCheckpoint()`, `CheckpointWriterWrite()`
@*/
PetscErrorCode SimulationGetCheckpoint(Simulation sim, Checkpoint *checkpoint)
{
  const LoadPath *path = sim->state->path;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(PetscNew(checkpoint));
  (*checkpoint)->step              = (PetscInt)PetscFloorReal(path->time);
  (*checkpoint)->time              = path->time;
  (*checkpoint)->previous_time     = path->previous_time;
  (*checkpoint)->increment         = sim->state->control->increment;
  (*checkpoint)->largest_increment = path->largest_increment;
  (*checkpoint)->work              = path->work;
  (*checkpoint)->contact_work      = path->contact_work;
  PetscCall(CheckpointCopyDualGaps(sim->model->contact, *checkpoint, PETSC_FALSE));
  PetscCall(PetscMalloc1(sim->model->bolts.n, &(*checkpoint)->shortening));
  PetscCall(PetscArraycpy((*checkpoint)->shortening, sim->model->bolts.shortening, sim->model->bolts.n));
  PetscCall(VecGetLocalSize(path->u, &n));
  PetscCall(CheckpointAddVec(*checkpoint, "displacement", n / 3, path->u));
  PetscCall(CheckpointAddVec(*checkpoint, "previous_displacement", n / 3, path->previous_u));
  PetscCall(CheckpointAddVec(*checkpoint, "outside_force", n / 3, path->outside));
  if (sim->state->history->frictional || (sim->model->contact && ModelIsDynamic(sim->model)))
    PetscCall(CheckpointAddVec(*checkpoint, "contact_force", n / 3, path->contact));
  if (ModelIsDynamic(sim->model)) {
    (*checkpoint)->damping_work  = sim->model->dynamics.damped;
    (*checkpoint)->largest_speed = sim->model->dynamics.fastest;
    PetscCall(CheckpointAddVec(*checkpoint, "velocity", n / 3, sim->model->dynamics.velocity));
    PetscCall(CheckpointAddVec(*checkpoint, "acceleration", n / 3, sim->model->dynamics.acceleration));
    PetscCall(CheckpointAddVec(*checkpoint, "auxiliary_acceleration", n / 3, sim->model->dynamics.auxiliary));
  }
  PetscCall(CheckpointCopyContact(sim->model, sim->state, *checkpoint, PETSC_FALSE));
  PetscCall(CheckpointAddPlastic(sim->model->scene, sim->model->elasticity, *checkpoint));
  PetscFunctionReturn(0);
}

/*@C
   SimulationSetCheckpoint - Sets the state of a simulation from a checkpoint; load steps continue from it

   Collective

   Input Parameters:
+  sim        - the simulation, after SimulationSetUp() and before any load step
-  checkpoint - the state, of this simulation's mesh

   Output Parameter:
.  step - number of the next load step, from 0

   Level: intermediate

   Note:
   If the checkpoint is of another mesh, external forces at its state, and their work in the first solve, are
   interpolated from that mesh.

.seealso: `SimulationGetCheckpoint()`, `CheckpointRead()`
@*/
PetscErrorCode SimulationSetCheckpoint(Simulation sim, Checkpoint checkpoint, PetscInt *step)
{
  const Bodies    bodies = ModelBodies(sim->model);
  LoadPath       *path   = sim->state->path;
  const PetscReal unit   = SceneTimeStep(sim->model->scene);

  PetscFunctionBegin;
  PetscCall(CheckpointCheck(sim->model->comm, checkpoint));
  PetscCheck(checkpoint->time < (PetscReal)sim->model->scene->nsteps, sim->model->comm, PETSC_ERR_USER_INPUT,
    "the checkpoint is at time %g and the load program ends at time %g: the analysis is "
    "already complete",
    (double)(unit * checkpoint->time), (double)(unit * (PetscReal)sim->model->scene->nsteps));
  *step = sim->state->control->first_step = checkpoint->step;
  sim->state->control->increment          = checkpoint->increment;
  path->time                              = checkpoint->time;
  path->previous_time                     = checkpoint->previous_time;
  path->largest_increment                 = checkpoint->largest_increment;
  path->work                              = checkpoint->work;
  path->contact_work                      = checkpoint->contact_work;
  PetscCall(CheckpointCopyDualGaps(sim->model->contact, checkpoint, PETSC_TRUE));
  PetscCall(CheckpointGetVec(checkpoint, "displacement", path->u));
  PetscCall(CheckpointGetVec(checkpoint, "previous_displacement", path->previous_u));
  PetscCall(PetscArraycpy(sim->model->bolts.shortening, checkpoint->shortening, sim->model->bolts.n));
  PetscCall(BoltsRestore(&bodies, &sim->model->bolts, path->u));
  PetscCall(CheckpointGetForce(checkpoint, "outside_force", path->u, &path->outside));
  if (sim->state->history->frictional || (sim->model->contact && ModelIsDynamic(sim->model)))
    PetscCall(CheckpointGetForce(checkpoint, "contact_force", path->u, &path->contact));
  PetscCall(CheckpointCopyContact(sim->model, sim->state, checkpoint, PETSC_TRUE));
  PetscCall(CheckpointGetPlastic(sim->model->scene, sim->model->comm, sim->model->elasticity, checkpoint));
  if (ModelIsDynamic(sim->model)) PetscCall(CheckpointGetMotion(sim->model, sim->state, checkpoint));
  PetscCall(ElasticityEnergy(sim->model->elasticity, path->u, &path->energy));
  PetscCall(FrictionRecall(sim->state->history));
  PetscFunctionReturn(0);
}
