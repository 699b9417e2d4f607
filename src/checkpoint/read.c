/* Restores a checkpoint on the mesh for which it was written, or on another mesh of the same bodies. */
#include "checkpointimpl.h"
#include <mesh.h>
#include <petsclayouthdf5.h>
#include <stdio.h>
#include <string.h>

/* Numbers of a checkpoint, stored as attributes of its file */
const CheckpointNumberField CheckpointNumbers[] = {
  {"time", offsetof(struct _n_Checkpoint, time)},
  {"previous_time", offsetof(struct _n_Checkpoint, previous_time)},
  {"increment", offsetof(struct _n_Checkpoint, increment)},
  {"largest_increment", offsetof(struct _n_Checkpoint, largest_increment)},
  {"work", offsetof(struct _n_Checkpoint, work)},
  {"contact_work", offsetof(struct _n_Checkpoint, contact_work)},
  {"dual_gaps", offsetof(struct _n_Checkpoint, dual_gaps)},
  {"damping_work", offsetof(struct _n_Checkpoint, damping_work)},
  {"largest_speed", offsetof(struct _n_Checkpoint, largest_speed)},
  {NULL, 0},
};

PetscReal *CheckpointNumber(Checkpoint checkpoint, size_t i)
{
  return (PetscReal *)((char *)checkpoint + CheckpointNumbers[i].offset);
}

/* The mesh of the file, complete on every rank */
typedef struct {
  PetscInt           ncells, nvertices;
  Vec                vertices;
  IS                 cells, body;
  const PetscScalar *x;
  const PetscInt    *c, *b;
  PetscInt          *first, *nnodes; /* per cell: index of its first node in c; number of its nodes */
} RestartMesh;

/* State of the reading of a checkpoint */
typedef struct {
  MPI_Comm     comm;
  const char  *file;
  PetscViewer  viewer;
  Scene        scene;
  Output       output; /* the mesh of the continued run */
  RestartMesh  mesh;
  MeshLocator  locator; /* finds the file's cell that contains each vertex of this rank; NULL: the vertices are those
                           of the file in the same order */
  PetscScalar *x;       /* coordinates of the vertices of this rank [length] */
  PetscInt    *body;
} Restart;

/* Loads a dataset. nlocal: number of rows on this rank, or PETSC_DECIDE. */
static PetscErrorCode RestartLoad(Restart *r, const char name[], PetscInt nlocal, PetscInt components, Vec *v)
{
  PetscFunctionBegin;
  PetscCall(VecCreate(r->comm, v));
  if (nlocal != PETSC_DECIDE) PetscCall(VecSetSizes(*v, nlocal * components, PETSC_DECIDE));
  PetscCall(VecSetBlockSize(*v, components));
  PetscCall(VecSetType(*v, VECSTANDARD));
  PetscCall(PetscObjectSetName((PetscObject)*v, name));
  PetscCall(VecLoad(*v, r->viewer));
  PetscFunctionReturn(0);
}

/* Loads a dataset completely on every rank */
static PetscErrorCode RestartLoadAll(Restart *r, const char name[], PetscInt components, Vec *all)
{
  Vec        v;
  VecScatter scatter;

  PetscFunctionBegin;
  PetscCall(RestartLoad(r, name, PETSC_DECIDE, components, &v));
  PetscCall(VecScatterCreateToAll(v, &scatter, all));
  PetscCall(VecScatterBegin(scatter, v, *all, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, v, *all, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(0);
}

/* Checks that all values are finite. Collective. */
static PetscErrorCode RestartCheckNumbers(Restart *r, const char name[], Vec v)
{
  PetscReal sum;

  PetscFunctionBegin;
  PetscCall(VecNorm(v, NORM_1, &sum));
  PetscCheck(!PetscIsInfOrNanReal(sum), r->comm, PETSC_ERR_FILE_UNEXPECTED,
    "it is damaged: its %s has values that are not numbers", name);
  PetscFunctionReturn(0);
}

static PetscErrorCode RestartLoadIndices(Restart *r, const char name[], IS *all)
{
  IS is;

  PetscFunctionBegin;
  PetscCall(ISCreate(r->comm, &is));
  PetscCall(ISSetType(is, ISGENERAL));
  PetscCall(PetscObjectSetName((PetscObject)is, name));
  PetscCall(ISLoad(is, r->viewer));
  PetscCall(ISAllGather(is, all));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Compares the scene's text with that in the file, and raises an error with the first difference */
static PetscErrorCode RestartCompare(Restart *r)
{
  IS              is;
  const PetscInt *letters;
  PetscInt        n;
  char           *text, difference[512];

  PetscFunctionBegin;
  PetscCall(RestartLoadIndices(r, "scene", &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &letters));
  PetscCall(PetscCalloc1(n + 1, &text));
  for (PetscInt i = 0; i < n; ++i) text[i] = (char)letters[i];
  PetscCall(ISRestoreIndices(is, &letters));
  PetscCall(ISDestroy(&is));
  PetscCall(SceneCompare(r->scene, text, difference, sizeof(difference)));
  PetscCall(PetscFree(text));
  PetscCheck(!difference[0], r->comm, PETSC_ERR_USER_INPUT, "it belongs to another scene: %s", difference);
  PetscFunctionReturn(0);
}

/* Reads the numbers, and checks that the load factors at the checkpoint's time are the same in the scene */
static PetscErrorCode RestartReadNumbers(Restart *r, Checkpoint checkpoint)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerHDF5ReadAttribute(r->viewer, NULL, "step", PETSC_INT, NULL, &checkpoint->step));
  for (size_t i = 0; CheckpointNumbers[i].name; ++i) {
    const char *name = CheckpointNumbers[i].name;
    PetscBool   has;

    PetscCall(PetscViewerHDF5HasAttribute(r->viewer, NULL, name, &has));
    PetscCheck(has, r->comm, PETSC_ERR_FILE_UNEXPECTED,
      "it has no \"%s\", since an earlier version of the program wrote it; start without -restart", name);
    PetscCall(PetscViewerHDF5ReadAttribute(r->viewer, NULL, name, PETSC_REAL, NULL, CheckpointNumber(checkpoint, i)));
  }
  PetscCall(PetscCalloc1(r->scene->nbolts, &checkpoint->shortening));
  for (PetscInt b = 0; b < r->scene->nbolts; ++b) {
    char name[256];

    PetscCall(PetscSNPrintf(name, sizeof(name), "bolt_%s", r->scene->bolts[b].name));
    PetscCall(PetscViewerHDF5ReadAttribute(r->viewer, NULL, name, PETSC_REAL, NULL, &checkpoint->shortening[b]));
  }
  PetscCall(CheckpointCheck(r->comm, checkpoint));
  for (PetscInt k = 0; k < r->scene->nramps; ++k) {
    const char *ramp = r->scene->ramps[k].name;
    char        name[256];
    PetscBool   has;
    PetscReal   then, now;

    PetscCall(PetscSNPrintf(name, sizeof(name), "ramp_%s", ramp));
    PetscCall(PetscViewerHDF5HasAttribute(r->viewer, NULL, name, &has));
    if (!has) continue;
    PetscCall(PetscViewerHDF5ReadAttribute(r->viewer, NULL, name, PETSC_REAL, NULL, &then));
    PetscCall(SceneGetFactor(r->scene, k, checkpoint->time, &now));
    PetscCheck(PetscAbsReal(now - then) <= 1e-9 * PetscMax(1, PetscAbsReal(then)), r->comm, PETSC_ERR_USER_INPUT,
      "at time %g the factor of ramp \"%s\" is %g in the checkpoint, but %g in the scene: keep the ramp as it was up "
      "to this time",
      (double)checkpoint->time, ramp, (double)then, (double)now);
  }
  PetscFunctionReturn(0);
}

/* Finds whether every rank's vertices are those of the file at the same positions */
static PetscErrorCode RestartIsSame(Restart *r, PetscBool *same)
{
  const PetscInt     n = r->output->nowned;
  Vec                stored;
  const PetscScalar *s;

  PetscFunctionBegin;
  PetscCall(PetscViewerHDF5ReadSizes(r->viewer, "vertices", NULL, &r->mesh.nvertices));
  r->mesh.nvertices /= 3;
  *same = (PetscBool)(r->mesh.nvertices == r->output->nvertices);
  if (!*same) PetscFunctionReturn(0);
  PetscCall(RestartLoad(r, "vertices", n, 3, &stored));
  PetscCall(VecGetArrayRead(stored, &s));
  for (PetscInt i = 0; i < 3 * n; ++i) *same = (PetscBool)(*same && s[i] == r->x[i]);
  PetscCall(VecRestoreArrayRead(stored, &s));
  PetscCall(VecDestroy(&stored));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, same, 1, MPI_PETSCBOOL, MPI_LAND, r->comm));
  PetscFunctionReturn(0);
}

/* Returns node `a` of a cell. Nodes of hexahedra are numbered in tensor order; the file has the order of VTK. */
static PetscInt RestartCellNode(const RestartMesh *mesh, PetscInt cell, PetscInt a)
{
  static const PetscInt vtk[8] = {0, 1, 3, 2, 4, 5, 7, 6};

  return mesh->c[mesh->first[cell] + (mesh->nnodes[cell] == 8 ? vtk[a] : a)];
}

/*
   Finds the first node and the number of nodes of each cell: 8, or, in files with several kinds of cells, the number
   that follows from the kind stored before the nodes. Raises an error if a cell is incomplete or a node is not a vertex
   of the file.
*/
static PetscErrorCode RestartFindCells(Restart *r, PetscBool mixed, PetscInt nindices)
{
  RestartMesh *mesh = &r->mesh;
  PetscInt     at   = 0;
  PetscBool    sound;

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(mesh->ncells, &mesh->first, mesh->ncells, &mesh->nnodes));
  for (PetscInt c = 0; c < mesh->ncells && at < nindices; ++c) {
    const PetscInt n = mixed ? OutputKindNodes(mesh->c[at++]) : 8;

    if (!n || n > nindices - at) break;
    mesh->nnodes[c] = n;
    mesh->first[c]  = at;
    for (PetscInt i = at; i < at + n; ++i) {
      PetscCheck(mesh->c[i] >= 0 && mesh->c[i] < mesh->nvertices, r->comm, PETSC_ERR_FILE_UNEXPECTED,
        "it is damaged: cell %" PetscInt_FMT " has the vertex %" PetscInt_FMT ", but there are only %" PetscInt_FMT, c,
        mesh->c[i], mesh->nvertices);
    }
    at += n;
  }
  sound = (PetscBool)(at == nindices && (!mesh->ncells || mesh->nnodes[mesh->ncells - 1]));
  PetscCheck(sound, r->comm, PETSC_ERR_FILE_UNEXPECTED,
    "it is damaged: its %" PetscInt_FMT " cells do not match the numbers of their nodes", mesh->ncells);
  PetscFunctionReturn(0);
}

static PetscErrorCode RestartLoadMesh(Restart *r)
{
  RestartMesh *mesh = &r->mesh;
  PetscInt     nindices;
  PetscBool    mixed;

  PetscFunctionBegin;
  PetscCall(RestartLoadAll(r, "vertices", 3, &mesh->vertices));
  PetscCall(RestartCheckNumbers(r, "vertices", mesh->vertices));
  PetscCall(PetscViewerHDF5HasDataset(r->viewer, "mixed_cells", &mixed));
  PetscCall(RestartLoadIndices(r, mixed ? "mixed_cells" : "cells", &mesh->cells));
  PetscCall(RestartLoadIndices(r, "body", &mesh->body));
  PetscCall(ISGetLocalSize(mesh->body, &mesh->ncells));
  PetscCall(VecGetArrayRead(mesh->vertices, &mesh->x));
  PetscCall(ISGetIndices(mesh->cells, &mesh->c));
  PetscCall(ISGetIndices(mesh->body, &mesh->b));
  PetscCall(ISGetLocalSize(mesh->cells, &nindices));
  PetscCall(RestartFindCells(r, mixed, nindices));
  PetscFunctionReturn(0);
}

/* Finds for each vertex of this rank the file's cell of the same body that contains it */
static PetscErrorCode RestartLocate(Restart *r)
{
  const MeshPlace *places;
  PetscInt         lost = 0;

  PetscFunctionBegin;
  PetscCall(RestartLoadMesh(r));
  PetscCall(MeshLocatorCreate(r->output->nowned, (const PetscReal(*)[3])r->x, r->body, &r->locator));
  for (PetscInt c = 0; c < r->mesh.ncells; ++c) {
    PetscReal X[MESH_MAX_NODES][3];

    for (PetscInt a = 0; a < r->mesh.nnodes[c]; ++a) {
      for (PetscInt d = 0; d < 3; ++d) X[a][d] = PetscRealPart(r->mesh.x[3 * RestartCellNode(&r->mesh, c, a) + d]);
    }
    PetscCall(MeshLocatorAddCell(r->locator, c, r->mesh.b[c], r->mesh.nnodes[c], X));
  }
  PetscCall(MeshLocatorGetPlaces(r->locator, &places));
  for (PetscInt i = 0; i < r->output->nowned; ++i) lost += places[i].cell < 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &lost, 1, MPIU_INT, MPI_SUM, r->comm));
  PetscCheck(!lost, r->comm, PETSC_ERR_USER_INPUT, "%" PetscInt_FMT " vertices of the mesh are in none of its cells",
    lost);
  PetscFunctionReturn(0);
}

/*
   Returns the interpolation weight of node `a`. A field of forces is not interpolated, since that would change the sum
   of the forces: only the force of a node at the same position is taken.
*/
static PetscReal RestartWeight(const MeshPlace *place, PetscInt a, PetscBool force)
{
  if (!force) return place->N[a];
  return place->N[a] > 1 - PETSC_SQRT_MACHINE_EPSILON ? 1 : 0;
}

/* Reads a field. On another mesh it is interpolated in the file's cells. */
static PetscErrorCode RestartReadField(Restart *r, const char name[], PetscInt components, PetscBool force,
  Checkpoint checkpoint)
{
  Vec                stored;
  const PetscScalar *s;
  const MeshPlace   *places;
  PetscReal         *values;
  PetscInt           size;

  PetscFunctionBegin;
  PetscCall(CheckpointAddField(checkpoint, name, components, r->output->nowned, &values));
  PetscCall(PetscViewerHDF5ReadSizes(r->viewer, name, NULL, &size));
  PetscCheck(size == components * r->mesh.nvertices, r->comm, PETSC_ERR_FILE_UNEXPECTED,
    "it is damaged: its %s has %" PetscInt_FMT " values for %" PetscInt_FMT " vertices", name, size, r->mesh.nvertices);
  if (r->locator) PetscCall(RestartLoadAll(r, name, components, &stored));
  else PetscCall(RestartLoad(r, name, r->output->nowned, components, &stored));
  PetscCall(RestartCheckNumbers(r, name, stored));
  PetscCall(VecGetArrayRead(stored, &s));
  if (r->locator) {
    PetscCall(MeshLocatorGetPlaces(r->locator, &places));
    for (PetscInt i = 0; i < r->output->nowned * components; ++i) {
      const MeshPlace *place = &places[i / components];

      for (PetscInt a = 0; a < place->n; ++a)
        values[i] += RestartWeight(place, a, force) *
                     PetscRealPart(s[components * RestartCellNode(&r->mesh, place->cell, a) + i % components]);
    }
  } else {
    for (PetscInt i = 0; i < r->output->nowned * components; ++i) values[i] = PetscRealPart(s[i]);
  }
  PetscCall(VecRestoreArrayRead(stored, &s));
  PetscCall(VecDestroy(&stored));
  PetscFunctionReturn(0);
}

/* Reads a field of records that are not vertices. Each rank gets a part of them. */
static PetscErrorCode RestartReadRecords(Restart *r, const char name[], PetscInt components, Checkpoint checkpoint)
{
  Vec                stored;
  const PetscScalar *s;
  PetscReal         *values;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(RestartLoad(r, name, PETSC_DECIDE, components, &stored));
  PetscCall(RestartCheckNumbers(r, name, stored));
  PetscCall(VecGetLocalSize(stored, &n));
  PetscCall(CheckpointAddField(checkpoint, name, components, n / components, &values));
  PetscCall(VecGetArrayRead(stored, &s));
  for (PetscInt i = 0; i < n; ++i) values[i] = PetscRealPart(s[i]);
  PetscCall(VecRestoreArrayRead(stored, &s));
  PetscCall(VecDestroy(&stored));
  PetscFunctionReturn(0);
}

static PetscErrorCode RestartReadFields(Restart *r, Checkpoint checkpoint)
{
  const int plastic    = CheckpointPlasticParts(r->scene);
  PetscBool frictional = PETSC_FALSE;

  PetscFunctionBegin;
  if (plastic) PetscCall(RestartReadRecords(r, CHECKPOINT_PLASTIC_PLACES, 4, checkpoint));
  if (plastic) PetscCall(RestartReadRecords(r, CHECKPOINT_PLASTIC, MATERIAL_PLASTIC, checkpoint));
  if (plastic > 1) PetscCall(RestartReadRecords(r, CHECKPOINT_PLASTIC_DEFORMATION, MATERIAL_DEFORMATION, checkpoint));
  for (PetscInt p = 0; p < r->scene->npairs; ++p)
    frictional = (PetscBool)(frictional || SceneContactPairHasFriction(&r->scene->pairs[p]));
  PetscCall(RestartReadField(r, "displacement", 3, PETSC_FALSE, checkpoint));
  PetscCall(RestartReadField(r, "previous_displacement", 3, PETSC_FALSE, checkpoint));
  PetscCall(RestartReadField(r, "outside_force", 3, PETSC_TRUE, checkpoint));
  if (frictional || (r->scene->npairs && SceneIsDynamic(r->scene)))
    PetscCall(RestartReadField(r, "contact_force", 3, PETSC_TRUE, checkpoint));
  if (SceneIsDynamic(r->scene)) {
    PetscCall(RestartReadField(r, "velocity", 3, PETSC_FALSE, checkpoint));
    PetscCall(RestartReadField(r, "acceleration", 3, PETSC_FALSE, checkpoint));
    PetscCall(RestartReadField(r, "auxiliary_acceleration", 3, PETSC_FALSE, checkpoint));
  }
  for (PetscInt p = 0; p < r->scene->npairs; ++p) {
    for (int k = 0; k < CHECKPOINT_PAIR_FIELDS; ++k) {
      char      name[128];
      PetscBool kept;

      PetscCall(CheckpointNamePairField(&r->scene->pairs[p], (CheckpointPairKind)k, sizeof(name), name, &kept));
      if (kept)
        PetscCall(
          RestartReadField(r, name, CheckpointPairFields[k].components, CheckpointPairFields[k].sum, checkpoint));
    }
  }
  PetscFunctionReturn(0);
}

/*
   Checks on the first rank that the file is complete HDF5, since the HDF5 library would print a page of errors. The
   length of the file is stored at byte 40 of a version 0 superblock.
*/
static PetscErrorCode RestartCheckFile(const Restart *r)
{
  unsigned char head[48]  = {0};
  PetscInt64    length[2] = {0, 0}; /* actual length of the file, negative if it is not HDF5; length that the file
                                       should have */
  PetscMPIInt   rank;
  FILE         *stream = NULL;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(r->comm, &rank));
  if (rank == 0) stream = fopen(r->file, "rb");
  if (stream) {
    const size_t n = fread(head, 1, sizeof(head), stream);

    for (int i = 47; i >= 40 && !head[8]; --i) length[1] = 256 * length[1] + head[i];
    if (!fseek(stream, 0, SEEK_END)) length[0] = ftell(stream);
    if (n < sizeof(head) || memcmp(head, "\211HDF\r\n\032\n", 8)) length[0] = -1;
    (void)fclose(stream);
  }
  PetscCallMPI(MPI_Bcast(length, 2, MPIU_INT64, 0, r->comm));
  PetscCheck(length[0] >= 0, r->comm, PETSC_ERR_FILE_READ, "it is not an HDF5 file");
  PetscCheck(length[0] >= length[1], r->comm, PETSC_ERR_FILE_READ,
    "it is incomplete: it has %" PetscInt64_FMT " bytes instead of %" PetscInt64_FMT, length[0], length[1]);
  PetscFunctionReturn(0);
}

static PetscErrorCode RestartReadFile(Restart *r, Checkpoint checkpoint, PetscBool *same)
{
  PetscBool has;

  PetscFunctionBegin;
  PetscCall(RestartCheckFile(r));
  PetscCall(PetscViewerHDF5Open(r->comm, r->file, FILE_MODE_READ, &r->viewer));
  PetscCall(PetscViewerHDF5HasAttribute(r->viewer, NULL, "largest_increment", &has));
  PetscCheck(has, r->comm, PETSC_ERR_FILE_UNEXPECTED, "it is not a checkpoint");
  PetscCall(RestartCompare(r));
  PetscCall(RestartReadNumbers(r, checkpoint));
  PetscCall(RestartIsSame(r, same));
  if (!*same) PetscCall(RestartLocate(r));
  PetscCall(RestartReadFields(r, checkpoint));
  PetscFunctionReturn(0);
}

/* Gets the vertices of this rank and their bodies */
static PetscErrorCode RestartCreate(DM dm, Restart *r)
{
  Vec                vertices;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(OutputCreateMesh(dm, &r->output));
  r->comm = r->output->comm;
  PetscCall(PetscMalloc2(3 * r->output->nowned, &r->x, r->output->nowned, &r->body));
  PetscCall(FieldsGetVertices(r->output, &vertices, r->body));
  PetscCall(VecGetArrayRead(vertices, &x));
  PetscCall(PetscArraycpy(r->x, x, 3 * r->output->nowned));
  PetscCall(VecRestoreArrayRead(vertices, &x));
  PetscCall(VecDestroy(&vertices));
  PetscFunctionReturn(0);
}

static PetscErrorCode RestartDestroy(Restart *r)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerDestroy(&r->viewer));
  if (r->locator) {
    PetscCall(MeshLocatorDestroy(&r->locator));
    PetscCall(VecRestoreArrayRead(r->mesh.vertices, &r->mesh.x));
    PetscCall(ISRestoreIndices(r->mesh.cells, &r->mesh.c));
    PetscCall(ISRestoreIndices(r->mesh.body, &r->mesh.b));
    PetscCall(VecDestroy(&r->mesh.vertices));
    PetscCall(ISDestroy(&r->mesh.cells));
    PetscCall(PetscFree2(r->mesh.first, r->mesh.nnodes));
    PetscCall(ISDestroy(&r->mesh.body));
  }
  PetscCall(PetscFree2(r->x, r->body));
  PetscCall(OutputDestroy(&r->output));
  PetscFunctionReturn(0);
}

/*@C
   CheckpointRead - Reads a checkpoint, from which a run can continue

   Collective

   Input Parameters:
+  scene - the scene; its later load program and its refinement may differ from those of the checkpoint
.  dm    - its mesh
-  file  - the HDF5 file

   Output Parameters:
+  checkpoint - the state on this mesh; free with CheckpointDestroy()
-  same       - true: the mesh has the vertices of the file in the same order; false: the fields were interpolated

   Level: intermediate

   Notes:
   Vertices that both meshes contain keep their values to rounding, on any number of ranks. If the meshes differ, every
   rank temporarily holds all vertices of the file.

   Errors: PETSC_ERR_FILE_OPEN if the file cannot be read; PETSC_ERR_USER_INPUT if it belongs to another scene or is not
   a checkpoint.

.seealso: `CheckpointWriterWrite()`, `SimulationSetCheckpoint()`
@*/
PetscErrorCode CheckpointRead(Scene scene, DM dm, const char file[], Checkpoint *checkpoint, PetscBool *same)
{
  Restart        r = {.file = file, .scene = scene};
  RankError      error;
  PetscErrorCode ierr;
  PetscBool      exists, library;
  SilencedOutput mute;
  H5E_auto2_t    print;
  void          *stream;

  PetscFunctionBegin;
  PetscCall(PetscTestFile(file, 'r', &exists));
  PetscCheck(exists, PetscObjectComm((PetscObject)dm), PETSC_ERR_FILE_OPEN, "there is no checkpoint \"%s\"", file);
  PetscCall(PetscNew(checkpoint));
  PetscCall(RestartCreate(dm, &r));
  PetscCall(RankErrorBegin(&error));
  (void)H5Eget_auto2(H5E_DEFAULT, &print, &stream);
  (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* HDF5 prints a page for each error, and one at the end */
  SilenceOutputBegin(&mute);
  ierr = RestartReadFile(&r, *checkpoint, same);
  SilenceOutputEnd(&mute);
  if (!ierr) (void)H5Eset_auto2(H5E_DEFAULT, print, stream);
  PetscCall(RankErrorEnd(r.comm, ierr, &error));
  library = (PetscBool) !!strstr(error.message, "HDF5 call");
  PetscCheck(!error.code, r.comm, PETSC_ERR_USER_INPUT, "the run cannot continue from the checkpoint \"%s\": %s%s",
    file, library ? "it is damaged: " : "", error.message);
  PetscCall(RestartDestroy(&r));
  PetscFunctionReturn(0);
}
