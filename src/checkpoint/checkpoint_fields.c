/* The fields of a checkpoint */
#include "checkpointimpl.h"
#include <string.h>

const CheckpointPairField CheckpointPairFields[CHECKPOINT_PAIR_FIELDS] = {
  [CHECKPOINT_PRESSURE]   = {"pressure", 1, PETSC_FALSE, PETSC_FALSE},
  [CHECKPOINT_SLACK]      = {"slack", 1, PETSC_FALSE, PETSC_FALSE},
  [CHECKPOINT_SHEAR]      = {"shear", 3, PETSC_TRUE, PETSC_TRUE},
  [CHECKPOINT_FRICTION]   = {"friction", 3, PETSC_TRUE, PETSC_TRUE},
  [CHECKPOINT_BOUND]      = {"friction_bound", 1, PETSC_FALSE, PETSC_TRUE},
  [CHECKPOINT_SLIP_PATH]  = {"slip_path", 1, PETSC_FALSE, PETSC_TRUE},
  [CHECKPOINT_DISSIPATED] = {"dissipated", 1, PETSC_TRUE, PETSC_TRUE},
};

/*
   Gets the name of a field of a contact pair in a checkpoint. kind: one of CheckpointPairFields; length: size of
   `name`; name: name of the field; kept: whether checkpoints contain this field for this pair.
*/
PetscErrorCode CheckpointNamePairField(const SceneContactPair *pair, CheckpointPairKind kind, size_t length,
  char name[], PetscBool *kept)
{
  const CheckpointPairField *field = &CheckpointPairFields[kind];

  PetscFunctionBegin;
  *kept = (PetscBool)(!field->friction || SceneContactPairHasFriction(pair));
  PetscCall(PetscSNPrintf(name, length, "%s_%s", field->name, pair->name));
  PetscFunctionReturn(0);
}

/*
   Adds a field to a checkpoint, with zeros as values. name: name of the field; components: values per vertex;
   nvertices: number of vertices that this rank owns, or of other records; values: array of the field's values, to be
   filled by the caller, owned by the checkpoint.
*/
PetscErrorCode CheckpointAddField(Checkpoint checkpoint, const char name[], PetscInt components, PetscInt nvertices,
  PetscReal **values)
{
  CheckpointField *field;

  PetscFunctionBegin;
  PetscCall(PetscRealloc((size_t)(checkpoint->nfields + 1) * sizeof(*checkpoint->fields), &checkpoint->fields));
  field             = &checkpoint->fields[checkpoint->nfields++];
  field->n          = nvertices;
  field->components = components;
  PetscCall(PetscStrncpy(field->name, name, sizeof(field->name)));
  PetscCall(PetscCalloc1(components * nvertices, &field->values));
  *values = field->values;
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointFindField(Checkpoint checkpoint, const char name[], const CheckpointField **field)
{
  PetscFunctionBegin;
  *field = NULL;
  for (PetscInt f = 0; f < checkpoint->nfields; ++f) {
    if (!strcmp(checkpoint->fields[f].name, name)) *field = &checkpoint->fields[f];
  }
  PetscCheck(*field, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED, "the checkpoint has no field \"%s\"", name);
  PetscFunctionReturn(0);
}

/* Gets the values of a field of a checkpoint. name: name of the field, which must exist; values: borrowed. */
PetscErrorCode CheckpointGetField(Checkpoint checkpoint, const char name[], const PetscReal **values)
{
  const CheckpointField *found;

  PetscFunctionBegin;
  PetscCall(CheckpointFindField(checkpoint, name, &found));
  *values = found->values;
  PetscFunctionReturn(0);
}

/*
   Checks that the numbers of a checkpoint are consistent and finite. comm: communicator on which the error is raised;
   every rank has the same numbers. Error: PETSC_ERR_FILE_UNEXPECTED.
*/
PetscErrorCode CheckpointCheck(MPI_Comm comm, Checkpoint checkpoint)
{
  const struct {
    const char *name;
    PetscReal   value, least;
  } numbers[] = {
    {"time", checkpoint->time, 0},
    {"previous_time", checkpoint->previous_time, 0},
    {"increment", checkpoint->increment, 0},
    {"largest_increment", checkpoint->largest_increment, 0},
    {"work", checkpoint->work, PETSC_NINFINITY},
    {"contact_work", checkpoint->contact_work, PETSC_NINFINITY},
    {"dual_gaps", checkpoint->dual_gaps, 0},
    {"damping_work", checkpoint->damping_work, PETSC_NINFINITY},
    {"largest_speed", checkpoint->largest_speed, 0},
  };

  PetscFunctionBegin;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(numbers); ++i)
    PetscCheck(!PetscIsInfOrNanReal(numbers[i].value) && numbers[i].value >= numbers[i].least, comm,
      PETSC_ERR_FILE_UNEXPECTED, "the checkpoint is damaged: its %s is %g", numbers[i].name, (double)numbers[i].value);
  PetscCheck(checkpoint->previous_time <= checkpoint->time, comm, PETSC_ERR_FILE_UNEXPECTED,
    "the checkpoint is damaged: its previous_time %g is later than its time %g", (double)checkpoint->previous_time,
    (double)checkpoint->time);
  PetscCheck((PetscReal)checkpoint->step == PetscFloorReal(checkpoint->time), comm, PETSC_ERR_FILE_UNEXPECTED,
    "the checkpoint is damaged: its step %" PetscInt_FMT " does not match its time %g", checkpoint->step,
    (double)checkpoint->time);
  PetscFunctionReturn(0);
}

/*@C
   CheckpointDestroy - Frees a checkpoint

   Not Collective

   Input Parameter:
.  checkpoint - the checkpoint

   Level: intermediate

.seealso: `CheckpointRead()`, `SimulationGetCheckpoint()`
@*/
PetscErrorCode CheckpointDestroy(Checkpoint *checkpoint)
{
  PetscFunctionBegin;
  if (!*checkpoint) PetscFunctionReturn(0);
  for (PetscInt f = 0; f < (*checkpoint)->nfields; ++f) PetscCall(PetscFree((*checkpoint)->fields[f].values));
  PetscCall(PetscFree((*checkpoint)->fields));
  PetscCall(PetscFree((*checkpoint)->shortening));
  PetscCall(PetscFree(*checkpoint));
  PetscFunctionReturn(0);
}
