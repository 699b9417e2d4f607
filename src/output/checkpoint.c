/* A run's state on disk: a file that is whole or not there. */
#include "outputimpl.h"
#include <checkpoint.h>
#include <string.h>

/* What is written: a state, of which scene, on which mesh */
typedef struct {
  Checkpoint checkpoint;
  Scene      scene;
  Output     mesh;
} CheckpointContents;

/* One number a character, on the first rank: an attribute could not be as long */
static PetscErrorCode CheckpointWriteText(MPI_Comm comm, const char name[], const char text[], PetscViewer viewer)
{
  IS          is;
  PetscInt   *letters, n;
  size_t      length;
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscStrlen(text, &length));
  n = rank ? 0 : (PetscInt)length;
  PetscCall(PetscMalloc1(n, &letters));
  for (PetscInt i = 0; i < n; ++i) letters[i] = (unsigned char)text[i];
  PetscCall(ISCreateGeneral(comm, n, letters, PETSC_OWN_POINTER, &is));
  PetscCall(PetscObjectSetName((PetscObject)is, name));
  PetscCall(ISView(is, viewer));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* How the run was asked for, for people to read */
static PetscErrorCode CheckpointWriteWords(const CheckpointContents *contents, PetscViewer viewer)
{
  char *scene, *options;

  PetscFunctionBegin;
  PetscCall(SceneGetText(contents->scene, &scene));
  PetscCall(CheckpointWriteText(contents->mesh->comm, "scene", scene, viewer));
  PetscCall(PetscFree(scene));
  PetscCall(PetscOptionsGetAll(NULL, &options));
  PetscCall(CheckpointWriteText(contents->mesh->comm, "options", options[0] ? options : " ", viewer));
  PetscCall(PetscFree(options));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckpointWriteNumbers(const CheckpointContents *contents, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, "step", PETSC_INT, &contents->checkpoint->step));
  for (size_t i = 0; CheckpointNumbers[i].name; ++i) PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, CheckpointNumbers[i].name, PETSC_REAL, CheckpointNumber(contents->checkpoint, i)));
  for (PetscInt r = 0; r < contents->scene->nramps; ++r) {
    char      name[256];
    PetscReal factor;

    PetscCall(PetscSNPrintf(name, sizeof(name), "ramp_%s", contents->scene->ramps[r].name));
    PetscCall(SceneGetFactor(contents->scene, r, contents->checkpoint->time, &factor));
    PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, name, PETSC_REAL, &factor));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckpointWriteContents(PetscViewer viewer, void *ctx)
{
  const CheckpointContents *contents = (const CheckpointContents *)ctx;

  PetscFunctionBegin;
  PetscCall(CheckpointWriteWords(contents, viewer));
  PetscCall(FieldsWriteMesh(viewer, contents->mesh));
  for (PetscInt f = 0; f < contents->checkpoint->nfields; ++f) {
    const CheckpointField *field = &contents->checkpoint->fields[f];
    const PetscInt         n     = field->components * contents->mesh->nowned;
    Vec                    data;
    PetscScalar           *a;

    PetscCall(DatasetCreate(contents->mesh->comm, field->name, contents->mesh->nowned, field->components, &data));
    PetscCall(VecGetArrayWrite(data, &a));
    for (PetscInt i = 0; i < n; ++i) a[i] = field->values[i];
    PetscCall(VecRestoreArrayWrite(data, &a));
    PetscCall(DatasetWrite(&data, viewer));
  }
  PetscCall(CheckpointWriteNumbers(contents, viewer));
  PetscFunctionReturn(0);
}

/*@C
   CheckpointWrite - Writes a state from which a run can go on

   Collective

   Input Parameters:
+  checkpoint - the state
.  scene      - the scene that is simulated
.  dm         - its mesh
-  file       - the HDF5 file

   Level: intermediate

   Notes:
   The file is written under another name, brought to the disk, and renamed: one that was there before stays until then, whatever happens.

   Errors: PETSC_ERR_FILE_WRITE where there is no room.

.seealso: `CheckpointRead()`, `SimulationGetCheckpoint()`
@*/
PetscErrorCode CheckpointWrite(Checkpoint checkpoint, Scene scene, DM dm, const char file[])
{
  CheckpointContents contents = {.checkpoint = checkpoint, .scene = scene};

  PetscFunctionBegin;
  PetscCall(OutputCreateMesh(dm, &contents.mesh));
  PetscCall(FileWriteHDF5(contents.mesh->comm, file, PETSC_TRUE, CheckpointWriteContents, &contents));
  PetscCall(OutputDestroy(&contents.mesh));
  PetscFunctionReturn(0);
}
