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
static PetscErrorCode CheckpointGetMotion(Simulation sim, Checkpoint checkpoint)
{
  const Constraints constraints = SimulationConstraints(sim);
  Dynamics         *d           = &sim->dynamics;

  PetscFunctionBegin;
  d->damped  = checkpoint->damping_work;
  d->fastest = checkpoint->largest_speed;
  PetscCall(CheckpointGetVec(checkpoint, "velocity", d->velocity));
  PetscCall(CheckpointGetVec(checkpoint, "acceleration", d->acceleration));
  PetscCall(CheckpointGetVec(checkpoint, "auxiliary_acceleration", d->auxiliary));
  PetscCall(TemperaturesApply(&sim->temperatures, sim->path->time));
  PetscCall(DynamicsSetRest(&constraints, &sim->loads, sim->path->time, sim->path->u, d));
  PetscCall(SchemeRelease(sim->path->contact, d));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckpointCopyContact(Simulation sim, Checkpoint checkpoint, PetscBool back)
{
  const PetscInt   nvertices                      = sim->history->nowned;
  PetscReal *const memory[CHECKPOINT_PAIR_FIELDS] = {
    [CHECKPOINT_PRESSURE]   = sim->history->pressure,
    [CHECKPOINT_SLACK]      = sim->history->slack,
    [CHECKPOINT_SHEAR]      = sim->history->settled,
    [CHECKPOINT_FRICTION]   = sim->history->friction,
    [CHECKPOINT_BOUND]      = sim->history->bound,
    [CHECKPOINT_SLIP_PATH]  = sim->history->slip_path,
    [CHECKPOINT_DISSIPATED] = sim->history->dissipated,
  };

  PetscFunctionBegin;
  for (PetscInt p = 0; sim->contact && p < sim->scene->npairs; ++p) {
    for (int k = 0; k < CHECKPOINT_PAIR_FIELDS; ++k) {
      const PetscInt components = CheckpointPairFields[k].components;
      char           name[128];
      PetscBool      kept;
      PetscReal     *values;

      PetscCall(CheckpointNamePairField(&sim->scene->pairs[p], (CheckpointPairKind)k, sizeof(name), name, &kept));
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
  const LoadPath *path = sim->path;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(PetscNew(checkpoint));
  (*checkpoint)->step              = (PetscInt)PetscFloorReal(path->time);
  (*checkpoint)->time              = path->time;
  (*checkpoint)->previous_time     = path->previous_time;
  (*checkpoint)->increment         = sim->control->increment;
  (*checkpoint)->largest_increment = path->largest_increment;
  (*checkpoint)->work              = path->work;
  (*checkpoint)->contact_work      = path->contact_work;
  PetscCall(CheckpointCopyDualGaps(sim->contact, *checkpoint, PETSC_FALSE));
  PetscCall(PetscMalloc1(sim->bolts.n, &(*checkpoint)->shortening));
  PetscCall(PetscArraycpy((*checkpoint)->shortening, sim->bolts.shortening, sim->bolts.n));
  PetscCall(VecGetLocalSize(path->u, &n));
  PetscCall(CheckpointAddVec(*checkpoint, "displacement", n / 3, path->u));
  PetscCall(CheckpointAddVec(*checkpoint, "previous_displacement", n / 3, path->previous_u));
  PetscCall(CheckpointAddVec(*checkpoint, "outside_force", n / 3, path->outside));
  if (sim->history->frictional || (sim->contact && SimulationIsDynamic(sim)))
    PetscCall(CheckpointAddVec(*checkpoint, "contact_force", n / 3, path->contact));
  if (SimulationIsDynamic(sim)) {
    (*checkpoint)->damping_work  = sim->dynamics.damped;
    (*checkpoint)->largest_speed = sim->dynamics.fastest;
    PetscCall(CheckpointAddVec(*checkpoint, "velocity", n / 3, sim->dynamics.velocity));
    PetscCall(CheckpointAddVec(*checkpoint, "acceleration", n / 3, sim->dynamics.acceleration));
    PetscCall(CheckpointAddVec(*checkpoint, "auxiliary_acceleration", n / 3, sim->dynamics.auxiliary));
  }
  PetscCall(CheckpointCopyContact(sim, *checkpoint, PETSC_FALSE));
  PetscCall(CheckpointAddPlastic(sim->scene, sim->elasticity, *checkpoint));
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
  const Bodies    bodies = SimulationBodies(sim);
  LoadPath       *path   = sim->path;
  const PetscReal unit   = SceneTimeStep(sim->scene);

  PetscFunctionBegin;
  PetscCall(CheckpointCheck(sim->comm, checkpoint));
  PetscCheck(checkpoint->time < (PetscReal)sim->scene->nsteps, sim->comm, PETSC_ERR_USER_INPUT,
    "the checkpoint is at time %g and the load program ends at time %g: the analysis is "
    "already complete",
    (double)(unit * checkpoint->time), (double)(unit * (PetscReal)sim->scene->nsteps));
  *step = sim->control->first_step = checkpoint->step;
  sim->control->increment          = checkpoint->increment;
  path->time                       = checkpoint->time;
  path->previous_time              = checkpoint->previous_time;
  path->largest_increment          = checkpoint->largest_increment;
  path->work                       = checkpoint->work;
  path->contact_work               = checkpoint->contact_work;
  PetscCall(CheckpointCopyDualGaps(sim->contact, checkpoint, PETSC_TRUE));
  PetscCall(CheckpointGetVec(checkpoint, "displacement", path->u));
  PetscCall(CheckpointGetVec(checkpoint, "previous_displacement", path->previous_u));
  PetscCall(PetscArraycpy(sim->bolts.shortening, checkpoint->shortening, sim->bolts.n));
  PetscCall(BoltsRestore(&bodies, &sim->bolts, path->u));
  PetscCall(CheckpointGetForce(checkpoint, "outside_force", path->u, &path->outside));
  if (sim->history->frictional || (sim->contact && SimulationIsDynamic(sim)))
    PetscCall(CheckpointGetForce(checkpoint, "contact_force", path->u, &path->contact));
  PetscCall(CheckpointCopyContact(sim, checkpoint, PETSC_TRUE));
  PetscCall(CheckpointGetPlastic(sim->scene, sim->comm, sim->elasticity, checkpoint));
  if (SimulationIsDynamic(sim)) PetscCall(CheckpointGetMotion(sim, checkpoint));
  PetscCall(ElasticityEnergy(sim->elasticity, path->u, &path->energy));
  PetscCall(FrictionRecall(sim->history));
  PetscFunctionReturn(0);
}
