/* The fields of a checkpoint. */
#include "stepimpl.h"
#include <string.h>

/*@C
   CheckpointAddField - Adds zeros at the vertices that this rank owns

   Not Collective

   Input Parameters:
+  checkpoint - the checkpoint
.  name       - of the field
.  components - values a vertex
-  nvertices  - vertices of this rank

   Output Parameter:
.  values - to be filled, borrowed

   Level: developer

.seealso: `CheckpointGetField()`
@*/
PetscErrorCode CheckpointAddField(Checkpoint checkpoint, const char name[], PetscInt components, PetscInt nvertices, PetscReal **values)
{
  CheckpointField *field;

  PetscFunctionBegin;
  PetscCall(PetscRealloc((size_t)(checkpoint->nfields + 1) * sizeof(*checkpoint->fields), &checkpoint->fields));
  field             = &checkpoint->fields[checkpoint->nfields++];
  field->components = components;
  PetscCall(PetscStrncpy(field->name, name, sizeof(field->name)));
  PetscCall(PetscCalloc1(components * nvertices, &field->values));
  *values = field->values;
  PetscFunctionReturn(0);
}

/*@C
   CheckpointGetField - The values of a field

   Not Collective

   Input Parameters:
+  checkpoint - the checkpoint
-  name       - of the field; one that is not there is an error

   Output Parameter:
.  values - borrowed

   Level: developer

.seealso: `CheckpointAddField()`
@*/
PetscErrorCode CheckpointGetField(Checkpoint checkpoint, const char name[], const PetscReal **values)
{
  PetscFunctionBegin;
  *values = NULL;
  for (PetscInt f = 0; f < checkpoint->nfields; ++f) {
    if (!strcmp(checkpoint->fields[f].name, name)) *values = checkpoint->fields[f].values;
  }
  PetscCheck(*values, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED, "the checkpoint has no field \"%s\"", name);
  PetscFunctionReturn(0);
}

/*@C
   CheckpointDestroy - Frees a checkpoint

   Not Collective

   Level: intermediate
@*/
PetscErrorCode CheckpointDestroy(Checkpoint *checkpoint)
{
  PetscFunctionBegin;
  if (!*checkpoint) PetscFunctionReturn(0);
  for (PetscInt f = 0; f < (*checkpoint)->nfields; ++f) PetscCall(PetscFree((*checkpoint)->fields[f].values));
  PetscCall(PetscFree((*checkpoint)->fields));
  PetscCall(PetscFree(*checkpoint));
  PetscFunctionReturn(0);
}
