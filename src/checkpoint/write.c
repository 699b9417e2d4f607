/* Writes the state of a run to disk. The file is replaced only when the new one is complete. */
#include "checkpointimpl.h"
#include <string.h>

struct _n_CheckpointWriter {
  Scene      scene;
  DM         dm;
  char      *file;
  Output     mesh; /* mesh of the output; NULL before the first state */
  FileCommit commit;
};

/* Contents of the file: a state, its scene and its mesh */
typedef struct {
  Checkpoint checkpoint;
  Scene      scene;
  Output     mesh;
} CheckpointContents;

/* Writes a text as a dataset with one number per character, on the first rank; an attribute could not be that long */
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
  PetscCall(DatasetWriteIndices(is, viewer));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Writes the scene and the options with which the run was started, as text for the user */
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
  for (size_t i = 0; CheckpointNumbers[i].name; ++i)
    PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, CheckpointNumbers[i].name, PETSC_REAL,
      CheckpointNumber(contents->checkpoint, i)));
  for (PetscInt r = 0; r < contents->scene->nramps; ++r) {
    char      name[256];
    PetscReal factor;

    PetscCall(PetscSNPrintf(name, sizeof(name), "ramp_%s", contents->scene->ramps[r].name));
    PetscCall(SceneGetFactor(contents->scene, r, contents->checkpoint->time, &factor));
    PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, name, PETSC_REAL, &factor));
  }
  for (PetscInt b = 0; b < contents->scene->nbolts; ++b) {
    char name[256];

    PetscCall(PetscSNPrintf(name, sizeof(name), "bolt_%s", contents->scene->bolts[b].name));
    PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, name, PETSC_REAL, &contents->checkpoint->shortening[b]));
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
    const PetscInt         n     = field->components * field->n;
    Vec                    data;
    PetscScalar           *a;

    PetscCall(DatasetCreate(contents->mesh->comm, field->name, field->n, field->components, &data));
    PetscCall(VecGetArrayWrite(data, &a));
    for (PetscInt i = 0; i < n; ++i) a[i] = field->values[i];
    PetscCall(VecRestoreArrayWrite(data, &a));
    PetscCall(DatasetWrite(&data, viewer));
  }
  PetscCall(CheckpointWriteNumbers(contents, viewer));
  PetscFunctionReturn(0);
}

/*@C
   CheckpointWriterCreate - Creates a writer of checkpoints

   Collective

   Input Parameters:
+  scene - the scene that is simulated; must outlive the writer
.  dm    - its mesh
-  file  - the HDF5 file; it is not changed before the first checkpoint is written

   Output Parameter:
.  writer - the writer

   Level: intermediate

.seealso: `CheckpointWriterWrite()`, `CheckpointWriterDestroy()`, `CheckpointRead()`
@*/
PetscErrorCode CheckpointWriterCreate(Scene scene, DM dm, const char file[], CheckpointWriter *writer)
{
  PetscFunctionBegin;
  PetscCall(PetscNew(writer));
  PetscCall(PetscObjectReference((PetscObject)dm));
  (*writer)->scene = scene;
  (*writer)->dm    = dm;
  PetscCall(PetscStrallocpy(file, &(*writer)->file));
  PetscFunctionReturn(0);
}

/*@C
   CheckpointWriterWrite - Writes a checkpoint, which replaces the previous one

   Collective

   Input Parameters:
+  writer     - the writer
-  checkpoint - the state; the caller may free it after the call

   Level: intermediate

   Notes:
   The state is written to a temporary file. A thread of the first rank then flushes it to disk and renames it, while
   the caller continues. The previous checkpoint is kept until the rename. The next call, or CheckpointWriterDestroy(),
   waits for the thread.

   Errors: PETSC_ERR_FILE_WRITE if this checkpoint or the previous one could not be written, for example because the
   disk is full.

.seealso: `CheckpointWriterCreate()`, `CheckpointWriterDestroy()`, `SimulationGetCheckpoint()`
@*/
PetscErrorCode CheckpointWriterWrite(CheckpointWriter writer, Checkpoint checkpoint)
{
  CheckpointContents contents = {.checkpoint = checkpoint, .scene = writer->scene};

  PetscFunctionBegin;
  PetscCall(FileCommitEnd(&writer->commit));
  if (!writer->mesh) PetscCall(OutputCreateMesh(writer->dm, &writer->mesh));
  contents.mesh = writer->mesh;
  PetscCall(FileWriteHDF5(writer->mesh->comm, writer->file, CheckpointWriteContents, &contents, &writer->commit));
  PetscFunctionReturn(0);
}

/*@C
   CheckpointWriterDestroy - Waits until the last state is on the disk, and frees the writer

   Collective

   Input Parameter:
.  writer - the writer, set to NULL; may point to NULL

   Level: intermediate

   Note:
   Errors: PETSC_ERR_FILE_WRITE if the last checkpoint could not be written to disk.

.seealso: `CheckpointWriterCreate()`, `CheckpointWriterWrite()`
@*/
PetscErrorCode CheckpointWriterDestroy(CheckpointWriter *writer)
{
  PetscFunctionBegin;
  if (!*writer) PetscFunctionReturn(0);
  PetscCall(FileCommitEnd(&(*writer)->commit));
  PetscCall(OutputDestroy(&(*writer)->mesh));
  PetscCall(DMDestroy(&(*writer)->dm));
  PetscCall(PetscFree((*writer)->file));
  PetscCall(PetscFree(*writer));
  PetscFunctionReturn(0);
}
