/*
   Creates an output and writes the results of load steps to it: one file with the mesh, one file per load step, and an
   XDMF file that refers to these files.
*/
#define _POSIX_C_SOURCE 200809L /* for lstat() and opendir() */
#include "outputimpl.h"
#include <dirent.h>
#include <string.h>
#include <sys/stat.h>

/* *exists: true on all ranks if rank 0 can read the file. */
static PetscErrorCode OutputTestFile(MPI_Comm comm, const char file[], PetscBool *exists)
{
  PetscFunctionBegin;
  PetscCall(PetscTestFile(file, 'r', exists));
  PetscCallMPI(MPI_Bcast(exists, 1, MPI_PETSCBOOL, 0, comm));
  PetscFunctionReturn(0);
}

/* Writes the mesh and locks its file. The mesh of an earlier run with this base name is replaced. */
static PetscErrorCode OutputBegin(Output output)
{
  char file[PETSC_MAX_PATH_LEN];
  int  earlier = output->lock;

  PetscFunctionBegin;
  PetscCall(OutputGetMeshFile(output, file, sizeof(file)));
  PetscCall(OutputWriteMesh(output));
  PetscCall(LockFileBegin(output->comm, file, &output->lock));
  LockFileEnd(&earlier);
  PetscCall(OutputWriteXDMF(output));
  output->meshed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*@C
   OutputCreate - Creates the writer of result files for ParaView

   Collective

   Input Parameters:
+  dm        - mesh with 3 displacement components per node, as MeshCreate() makes it
.  nbodies   - number of bodies
.  bodynames - their names
.  surfaces  - for each body NULL, or the rigid surface that its cell stands for, see SceneSurfaceWrite(); or NULL
-  basename  - path of the files without ending

   Output Parameter:
.  output - the output

   Level: intermediate

   Notes:
   <basename>.xmf is the file to open. It refers to the mesh in <basename>.h5 and to one file <basename>_<step>.h5 per
   load step. Times are those of the load program: load step k ends at time k.

   The mesh consists of vertices, cells in VTK's order, and the body number of every cell. A hexahedron of order 2 is
   cut by its nodes into 8, which have the values of the cell. A cell that stands for a rigid surface is not
   written; the dataset `tools` has its body and its nodes. If there are tetrahedra (4 or 10 nodes), the dataset is
   called mixed_cells instead of cells, and XDMF's number of the cell type precedes the nodes of each cell.

   Every file is written under a temporary name and renamed when it is complete, and the .xmf is written last. The
   completed load steps therefore stay readable if the run is killed or the disk is full.

   The results of an earlier run with the same name are kept until the first load step is written. The mesh is then
   written, and the earlier run's files of later steps are removed. Without earlier results the mesh is written at once.

   Errors: PETSC_ERR_FILE_OPEN, on all ranks, if the files cannot be written or another process is writing them;
   PETSC_ERR_FILE_WRITE if the disk is full.

.seealso: `OutputWrite()`, `OutputDestroy()`
@*/
PetscErrorCode OutputCreate(DM dm, PetscInt nbodies, const char *const bodynames[], const char *const surfaces[],
  const char basename[], Output *output)
{
  Output    o;
  PetscBool earlier;
  char      file[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  PetscCall(OutputCheckBase(PetscObjectComm((PetscObject)dm), basename));
  PetscCall(OutputCreateMesh(dm, &o));
  PetscCall(PetscStrallocpy(basename, &o->base));
  o->nbodies = nbodies;
  o->every   = 1;
  PetscCall(PetscMalloc1(nbodies, &o->bodynames));
  PetscCall(PetscCalloc1(nbodies, &o->surfaces));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(PetscStrallocpy(bodynames[b], &o->bodynames[b]));
    PetscCall(PetscStrallocpy(surfaces ? surfaces[b] : NULL, &o->surfaces[b]));
    if (o->surfaces[b]) o->hides = PETSC_TRUE;
  }
  PetscCall(OutputCountPieces(o));
  PetscCall(OutputGetMeshFile(o, file, sizeof(file)));
  PetscCall(OutputCheckWritable(o->comm, file));
  PetscCall(LockFileBegin(o->comm, file, &o->lock));
  PetscCall(OutputTestFile(o->comm, file, &earlier));
  if (!earlier) PetscCall(OutputBegin(o));
  *output = o;
  PetscFunctionReturn(0);
}

/*@C
   OutputSetUnits - Writes the units of a run into its XDMF file

   Not Collective

   Input Parameters:
+  output - the output, before OutputWrite()
-  units  - the scene's text, for example "mm, N, MPa"; NULL: none

   Level: intermediate

.seealso: `OutputCreate()`
@*/
PetscErrorCode OutputSetUnits(Output output, const char units[])
{
  PetscFunctionBegin;
  PetscCall(PetscFree(output->units));
  PetscCall(PetscStrallocpy(units, &output->units));
  PetscFunctionReturn(0);
}

/*@C
   OutputSetEvery - Sets of which load steps the fields are kept

   Not Collective

   Input Parameters:
+  output - the output, before OutputWrite()
-  every  - fields of each load step whose number is a multiple of it are kept, and those of the last load step that
            converged (default 1); 0: those of the last one alone

   Level: intermediate

   Note:
   The history has all load steps.

.seealso: `OutputCreate()`, `OutputWrite()`
@*/
PetscErrorCode OutputSetEvery(Output output, PetscInt every)
{
  PetscFunctionBegin;
  PetscCheck(every >= 0, output->comm, PETSC_ERR_ARG_OUTOFRANGE,
    "fields can be kept of every Nth load step with N at least 0, not %" PetscInt_FMT, every);
  output->every = every;
  PetscFunctionReturn(0);
}

/*
   Determines from the first load step which fields are written in all load steps. If there is only one contact pair, no
   fields of single pairs are written, since they would be equal to the fields of all pairs together.
*/
static PetscErrorCode OutputKeepFields(Output output, const StepState *state)
{
  const StepReport *report = state->report;

  PetscFunctionBegin;
  output->nodes   = (PetscBool)(state->nodal != NULL);
  output->plastic = (PetscBool)(state->plastic != NULL);
  PetscCallMPI(MPI_Allreduce(&state->nquadrature, &output->nquadrature, 1, MPIU_INT, MPI_SUM, output->comm));
  output->moving = (PetscBool)(state->velocity != NULL);
  for (PetscInt p = 0; p < report->npairs; ++p)
    output->friction = (PetscBool)(output->friction || report->pairs[p].frictional);
  if (report->npairs < 2) PetscFunctionReturn(0);
  output->npairs = report->npairs;
  PetscCall(PetscMalloc1(output->npairs, &output->pairnames));
  for (PetscInt p = 0; p < output->npairs; ++p)
    PetscCall(PetscStrallocpy(report->pairs[p].name, &output->pairnames[p]));
  PetscFunctionReturn(0);
}

static PetscErrorCode OutputAddStep(Output output, PetscInt step, PetscReal time)
{
  PetscFunctionBegin;
  if (output->nsteps == output->maxsteps) {
    output->maxsteps = 2 * output->maxsteps + 8;
    PetscCall(PetscRealloc(output->maxsteps * sizeof(*output->steps), &output->steps));
  }
  output->steps[output->nsteps++] = (OutputStep){.step = step, .time = time};
  PetscFunctionReturn(0);
}

/*@C
   OutputContinue - Continues the files of a run that ended before its last load step

   Collective

   Input Parameters:
+  output    - the output, before OutputWrite()
.  step      - number of load steps that the earlier run completed
.  increment - time of a load step: 1, in dynamics the time step
-  same      - whether mesh and layout are those of the earlier run; otherwise <basename>.xmf does not list its fields

   Level: intermediate

   Note:
   The history keeps the lines of those load steps. <basename>.xmf lists their files, if they exist.

.seealso: `OutputCreate()`, `OutputWrite()`, `CheckpointRead()`
@*/
PetscErrorCode OutputContinue(Output output, PetscInt step, PetscReal increment, PetscBool same)
{
  char      file[PETSC_MAX_PATH_LEN];
  PetscBool exists;

  PetscFunctionBegin;
  output->continued = step;
  for (PetscInt s = 1; same && s <= step; ++s) {
    PetscCall(OutputGetStepFile(output, s, file, sizeof(file)));
    PetscCall(OutputTestFile(output->comm, file, &exists));
    if (exists) PetscCall(OutputAddStep(output, s, (PetscReal)s * increment));
  }
  PetscFunctionReturn(0);
}

/* Removes the file of a load step. Links and devices remain, because a user has created them. */
static PetscErrorCode OutputRemoveStep(Output output, PetscInt step)
{
  char        file[PETSC_MAX_PATH_LEN];
  struct stat info;

  PetscFunctionBegin;
  PetscCall(OutputGetStepFile(output, step, file, sizeof(file)));
  if (!lstat(file, &info) && S_ISREG(info.st_mode)) (void)remove(file);
  PetscFunctionReturn(0);
}

/*
   Removes the files that an earlier run with this base name has written for load steps after the present one. Only rank
   0 removes files.
*/
static PetscErrorCode OutputRemoveOlder(Output output)
{
  const PetscInt last = output->steps[output->nsteps - 1].step;
  char           folder[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN];
  char          *slash;
  PetscMPIInt    rank;
  DIR           *entries;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(output->comm, &rank));
  if (rank) PetscFunctionReturn(0);
  PetscCall(PetscStrncpy(folder, output->base, sizeof(folder)));
  slash = strrchr(folder, '/');
  if (slash) slash[1] = '\0';
  entries = opendir(slash ? folder : ".");
  for (struct dirent *entry; entries && (entry = readdir(entries));) {
    const char *number = strrchr(entry->d_name, '_');
    const long  step   = number ? strtol(number + 1, NULL, 10) : 0;

    if (step <= last) continue;
    PetscCall(OutputGetStepFile(output, (PetscInt)step, file, sizeof(file)));
    if (!strcmp(entry->d_name, slash ? file + strlen(folder) : file))
      PetscCall(OutputRemoveStep(output, (PetscInt)step));
  }
  if (entries) closedir(entries);
  PetscFunctionReturn(0);
}

/*
   Removes the load step before the present one from the list if its fields are not to be kept. They are kept until
   those of the present one are on disk, so that the last load step that converged always has fields. *step: number of
   the load step; 0: it stays.
*/
static PetscErrorCode OutputDropStep(Output output, PetscInt *step)
{
  PetscInt before;

  PetscFunctionBegin;
  *step = 0;
  if (output->nsteps < 2) PetscFunctionReturn(0);
  before = output->steps[output->nsteps - 2].step;
  if (output->every && before % output->every == 0) PetscFunctionReturn(0);
  *step                             = before;
  output->steps[output->nsteps - 2] = output->steps[output->nsteps - 1];
  --output->nsteps;
  PetscFunctionReturn(0);
}

/*@C
   OutputWrite - Adds the state at the end of a load step

   Collective

   Input Parameters:
+  output - the output
-  state  - the state; its contact points are at vertices that this rank owns

   Level: intermediate

   Notes:
   share/doc/output.md lists the fields of cells and vertices, with their units, and the columns of the history.

   Fields of contact are on both sides of the pairs. Outside of the contact faces contact_gap and contact_status are
   NaN, which ParaView shows in its NaN colour, and the other fields of contact are 0. At a vertex of several pairs, the
   fields without a pair's name have the mean pressure, the smallest gap, and the sums of areas and forces.

   The history <basename>.csv gets a line with every number of the report of the load step. The points of each line of
   the scene's probes are added to <basename>_<line>.csv.

.seealso: `OutputCreate()`, `OutputDestroy()`
@*/
PetscErrorCode OutputWrite(Output output, const StepState *state)
{
  PetscMPIInt rank;
  PetscInt    dropped;

  PetscFunctionBegin;
  if (!output->begun) PetscCall(OutputKeepFields(output, state));
  if (!output->meshed) PetscCall(OutputBegin(output));
  PetscCall(OutputWriteFields(output, state));
  PetscCall(OutputAddStep(output, state->report->step, state->report->time));
  PetscCall(OutputDropStep(output, &dropped));
  PetscCall(OutputWriteXDMF(output));
  PetscCallMPI(MPI_Comm_rank(output->comm, &rank));
  if (dropped && rank == 0) PetscCall(OutputRemoveStep(output, dropped));
  PetscCall(OutputWriteHistory(output, state->report));
  if (!output->begun) PetscCall(OutputRemoveOlder(output));
  output->begun = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*@C
   OutputDestroy - Frees an output; its files are complete after every call and stay

   Collective

   Input Parameter:
.  output - the output, set to NULL; may point to NULL

   Level: intermediate

.seealso: `OutputCreate()`
@*/
PetscErrorCode OutputDestroy(Output *output)
{
  Output o = *output;

  PetscFunctionBegin;
  if (!o) PetscFunctionReturn(0);
  LockFileEnd(&o->lock);
  for (PetscInt b = 0; b < o->nbodies; ++b) {
    PetscCall(PetscFree(o->bodynames[b]));
    PetscCall(PetscFree(o->surfaces[b]));
  }
  PetscCall(PetscFree(o->bodynames));
  PetscCall(PetscFree(o->surfaces));
  for (PetscInt p = 0; p < o->npairs; ++p) PetscCall(PetscFree(o->pairnames[p]));
  PetscCall(PetscFree(o->pairnames));
  PetscCall(PetscFree(o->units));
  PetscCall(PetscFree(o->base));
  PetscCall(PetscFree(o->steps));
  PetscCall(DMDestroy(&o->dm));
  PetscCall(PetscFree(*output));
  PetscFunctionReturn(0);
}
