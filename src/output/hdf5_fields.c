/*
   Writes mesh and fields as HDF5 datasets. Nodes have the order of the DM's global vectors. The cells of rank 0 come
   first, then those of rank 1, and so on.
*/
#include "outputimpl.h"
#include <mesh.h>
#include <rankerror.h>
#include <math.h>

/* Finds the global number of the node at a mesh point. */
static PetscErrorCode FieldsGetVertex(PetscSection global, PetscInt point, PetscInt *number)
{
  PetscInt offset;

  PetscFunctionBegin;
  PetscCall(PetscSectionGetOffset(global, point, &offset));
  *number = (offset < 0 ? -(offset + 1) : offset) / 3;
  PetscFunctionReturn(0);
}

/* Finds the number of the body to which each node of this rank belongs. body: [output->nowned]. */
static PetscErrorCode FieldsGetBodies(Output output, PetscInt body[])
{
  PetscSection global;
  DMLabel      label;
  PetscInt     cstart, cend, n, nodes[MESH_MAX_NODES], number = 0, b;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(output->dm, &global));
  PetscCall(DMGetLabel(output->dm, MESH_BODY_LABEL, &label));
  PetscCall(DMPlexGetHeightStratum(output->dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscCall(DMLabelGetValue(label, c, &b));
    PetscCall(MeshGetCellNodes(output->dm, c, &n, nodes));
    for (PetscInt i = 0; i < n; ++i) {
      PetscCall(FieldsGetVertex(global, nodes[i], &number));
      if (number >= output->first && number < output->first + output->nowned) body[number - output->first] = b;
    }
  }
  PetscFunctionReturn(0);
}

/*
   field: undeformed coordinates of this rank's nodes [length]; body: number of the body of each of these nodes; NULL:
   not needed
*/
PetscErrorCode FieldsGetVertices(Output output, Vec *field, PetscInt body[])
{
  Vec coordinates, global;

  PetscFunctionBegin;
  PetscCall(MeshGetNodeCoordinates(output->dm, &coordinates));
  PetscCall(DMGetGlobalVector(output->dm, &global));
  PetscCall(DMLocalToGlobal(output->dm, coordinates, INSERT_VALUES, global));
  PetscCall(DatasetCreate(output->comm, "vertices", output->nowned, 3, field));
  PetscCall(VecCopy(global, *field));
  PetscCall(DMRestoreGlobalVector(output->dm, &global));
  if (body) PetscCall(FieldsGetBodies(output, body));
  PetscFunctionReturn(0);
}

/* Writes the coordinates of the nodes. The dataset is attached to the DM, so that the next file reuses it. */
static PetscErrorCode FieldsWriteVertices(Output output, PetscViewer viewer)
{
  Vec field;

  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)output->dm, "vertices", (PetscObject *)&field));
  if (field) PetscCall(PetscObjectReference((PetscObject)field));
  else {
    PetscCall(FieldsGetVertices(output, &field, NULL));
    PetscCall(PetscObjectCompose((PetscObject)output->dm, "vertices", (PetscObject)field));
  }
  PetscCall(DatasetWrite(&field, viewer));
  PetscFunctionReturn(0);
}

/* Name under which indices are attached to the DM. A checkpoint of the same DM has the cells of all bodies. */
static PetscErrorCode FieldsGetIndices(Output output, const char name[], IS *is, char key[64])
{
  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, 64, "%s%s", output->hides ? "shown_" : "", name));
  PetscCall(PetscObjectQuery((PetscObject)output->dm, key, (PetscObject *)is));
  PetscFunctionReturn(0);
}

/*
   Attaches indices to the DM, so that the next file reuses them. The number of columns of the dataset is the block size
   of the layout. ISSetBlockSize() cannot be used, because it requires blocks of consecutive indices.
*/
static PetscErrorCode FieldsKeepIndices(Output output, const char name[], PetscInt n, PetscInt components,
  PetscInt *indices)
{
  IS          is;
  PetscLayout layout;
  char        key[64];

  PetscFunctionBegin;
  PetscCall(FieldsGetIndices(output, name, &is, key));
  PetscCall(ISCreateGeneral(output->comm, n, indices, PETSC_OWN_POINTER, &is));
  PetscCall(ISGetLayout(is, &layout));
  PetscCall(PetscLayoutSetBlockSize(layout, components));
  PetscCall(PetscObjectSetName((PetscObject)is, name));
  PetscCall(PetscObjectCompose((PetscObject)output->dm, key, (PetscObject)is));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

static PetscErrorCode FieldsNumberCells(Output output)
{
  PetscSection global;
  DMLabel      label;
  PetscInt     cstart, cend, *cells, *bodies, at = 0, piece = 0;
  OutputPieces pieces;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(output->dm, &global));
  PetscCall(DMGetLabel(output->dm, MESH_BODY_LABEL, &label));
  PetscCall(DMPlexGetHeightStratum(output->dm, 0, &cstart, &cend));
  PetscCall(PetscMalloc1(output->nindiceslocal, &cells));
  PetscCall(PetscMalloc1(output->ncellslocal, &bodies));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscCall(OutputGetPieces(output, c, &pieces));
    for (PetscInt p = 0; p < pieces.n; ++p, ++piece) {
      if (output->mixed) cells[at++] = OutputPieceKind(pieces.nnodes);
      for (PetscInt i = 0; i < pieces.nnodes; ++i, ++at)
        PetscCall(FieldsGetVertex(global, pieces.nodes[p][i], &cells[at]));
      PetscCall(DMLabelGetValue(label, c, &bodies[piece]));
    }
  }
  PetscCall(FieldsKeepIndices(output, OutputCellsName(output), output->nindiceslocal, output->mixed ? 1 : 8, cells));
  PetscCall(FieldsKeepIndices(output, "body", output->ncellslocal, 1, bodies));
  PetscFunctionReturn(0);
}

/* Bodies and nodes of the cells that stand for rigid surfaces, and are not among the written cells */
static PetscErrorCode FieldsNumberTools(Output output)
{
  PetscSection global;
  PetscInt     cstart, cend, *tools, n = 0, nnodes, nodes[MESH_MAX_NODES], body;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(output->dm, &global));
  PetscCall(DMPlexGetHeightStratum(output->dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscCall(OutputGetTool(output, c, &body));
    if (body >= 0) ++n;
  }
  PetscCall(PetscMalloc1(9 * n, &tools));
  for (PetscInt c = cstart, at = 0; c < cend; ++c) {
    PetscCall(OutputGetTool(output, c, &body));
    if (body < 0) continue;
    PetscCall(MeshGetCellNodes(output->dm, c, &nnodes, nodes));
    tools[at++] = body;
    for (PetscInt i = 0; i < 8; ++i) PetscCall(FieldsGetVertex(global, nodes[i], &tools[at++]));
  }
  PetscCall(FieldsKeepIndices(output, "tools", 9 * n, 9, tools));
  PetscFunctionReturn(0);
}

static PetscErrorCode FieldsWriteCells(Output output, PetscViewer viewer)
{
  const char *const names[] = {OutputCellsName(output), "body", "tools"};
  IS                is;
  char              key[64];

  PetscFunctionBegin;
  PetscCall(FieldsGetIndices(output, names[0], &is, key));
  if (!is) PetscCall(FieldsNumberCells(output));
  if (!is && output->hides) PetscCall(FieldsNumberTools(output));
  for (int i = 0; i < (output->hides ? 3 : 2); ++i) {
    PetscCall(FieldsGetIndices(output, names[i], &is, key));
    PetscCall(DatasetWriteIndices(is, viewer));
  }
  PetscFunctionReturn(0);
}

/* Writes nodes and cells of the mesh to an open HDF5 file. ctx: the Output. */
PetscErrorCode FieldsWriteMesh(PetscViewer viewer, void *ctx)
{
  PetscFunctionBegin;
  PetscCall(FieldsWriteVertices((Output)ctx, viewer));
  PetscCall(FieldsWriteCells((Output)ctx, viewer));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputWriteMesh(Output output)
{
  char file[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  PetscCall(OutputGetMeshFile(output, file, sizeof(file)));
  PetscCall(FileWriteHDF5(output->comm, file, FieldsWriteMesh, output, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode FieldsWriteGlobal(Output output, const char name[], Vec values, PetscViewer viewer)
{
  Vec field;

  PetscFunctionBegin;
  /* The field is copied to a plain vector, since PETSc writes vectors of a DMPlex in a layout of its own. */
  PetscCall(DatasetCreate(output->comm, name, output->nowned, 3, &field));
  PetscCall(VecCopy(values, field));
  PetscCall(DatasetWrite(&field, viewer));
  PetscFunctionReturn(0);
}

/*
   Contact fields at the nodes of this rank, either of all pairs together or of one pair, and the arrays of these
   vectors.
*/
typedef struct {
  Vec          pressure, gap, area, status, force;
  PetscScalar *p, *g, *a, *s, *f;
  Vec          shear, slip, path; /* friction force, slip and length of the slip path; NULL without friction */
  PetscScalar *t, *d, *l;
} FieldsContact;

static PetscErrorCode FieldsCreateContact(Output output, const char name[], const char suffix[], PetscInt components,
  PetscReal value, Vec *field, PetscScalar **values)
{
  char full[256];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(full, sizeof(full), "%s%s%s", name, suffix ? "_" : "", suffix ? suffix : ""));
  PetscCall(DatasetCreate(output->comm, full, output->nowned, components, field));
  PetscCall(VecGetArray(*field, values));
  for (PetscInt i = 0; i < output->nowned * components; ++i) (*values)[i] = value;
  PetscFunctionReturn(0);
}

/*
   Adds the values of a contact point to the fields at node v. If the node already has a point of another pair, the
   pressure becomes the mean weighted by the areas, and the gap becomes the smaller of the two gaps.
*/
static void FieldsAddPoint(FieldsContact *fields, PetscInt v, const ContactPoint *point)
{
  const PetscReal area = PetscRealPart(fields->a[v]) + point->area;

  if (area > 0.0) fields->p[v] = (fields->p[v] * fields->a[v] + point->pressure * point->area) / area;
  fields->a[v] = area;
  if (!(PetscRealPart(fields->g[v]) <= point->gap)) fields->g[v] = point->gap;
  if (!(PetscRealPart(fields->s[v]) > 0.0)) fields->s[v] = point->slips ? 2.0 : point->closed ? 1.0 : 0.0;
  for (PetscInt c = 0; c < 3; ++c) fields->f[3 * v + c] += point->force[c];
  if (!fields->shear) return;
  for (PetscInt c = 0; c < 3; ++c) {
    fields->t[3 * v + c] += point->shear[c];
    fields->d[3 * v + c] = point->slip[c];
  }
  fields->l[v] = point->slip_path;
}

/*
   Fills the fields at this rank's nodes with the contact points of a pair. pair: number of the pair; negative: all
   pairs.
*/
static PetscErrorCode FieldsFillPair(Output output, const StepState *state, PetscInt pair, FieldsContact *fields)
{
  PetscSection global;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(output->dm, &global));
  for (PetscInt k = 0; k < state->npoints; ++k) {
    PetscInt v = 0;

    if (pair >= 0 && state->points[k].pair != pair) continue;
    PetscCall(FieldsGetVertex(global, state->points[k].vertex, &v));
    v -= output->first;
    PetscCheck(v >= 0 && v < output->nowned, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
      "Contact point %" PetscInt_FMT " is at a vertex of another rank", k);
    FieldsAddPoint(fields, v, &state->points[k]);
  }
  PetscFunctionReturn(0);
}

/* Creates the fields that are written only if any pair has friction. */
static PetscErrorCode FieldsCreateFriction(Output output, const char suffix[], FieldsContact *fields)
{
  PetscFunctionBegin;
  PetscCall(FieldsCreateContact(output, "contact_shear", suffix, 3, 0.0, &fields->shear, &fields->t));
  PetscCall(FieldsCreateContact(output, "contact_slip", suffix, 3, 0.0, &fields->slip, &fields->d));
  PetscCall(FieldsCreateContact(output, "contact_slip_path", suffix, 1, 0.0, &fields->path, &fields->l));
  PetscFunctionReturn(0);
}

static PetscErrorCode FieldsWriteFriction(FieldsContact *fields, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(VecRestoreArray(fields->shear, &fields->t));
  PetscCall(VecRestoreArray(fields->slip, &fields->d));
  PetscCall(VecRestoreArray(fields->path, &fields->l));
  PetscCall(DatasetWrite(&fields->shear, viewer));
  PetscCall(DatasetWrite(&fields->slip, viewer));
  PetscCall(DatasetWrite(&fields->path, viewer));
  PetscFunctionReturn(0);
}

/*
   Writes the fields of a pair, or those of all pairs together. pair: number of the pair; negative: all pairs. suffix:
   name of the pair, which is appended to the names of its fields; NULL for all pairs.
*/
static PetscErrorCode FieldsWritePair(Output output, const StepState *state, PetscInt pair, const char suffix[],
  PetscViewer viewer)
{
  FieldsContact fields = {.shear = NULL};

  PetscFunctionBegin;
  PetscCall(FieldsCreateContact(output, "contact_pressure", suffix, 1, 0.0, &fields.pressure, &fields.p));
  PetscCall(FieldsCreateContact(output, "contact_gap", suffix, 1, NAN, &fields.gap, &fields.g));
  PetscCall(FieldsCreateContact(output, "contact_area", suffix, 1, 0.0, &fields.area, &fields.a));
  PetscCall(FieldsCreateContact(output, "contact_status", suffix, 1, NAN, &fields.status, &fields.s));
  PetscCall(FieldsCreateContact(output, "contact_force", suffix, 3, 0.0, &fields.force, &fields.f));
  if (output->friction) PetscCall(FieldsCreateFriction(output, suffix, &fields));
  RankCall(output->comm, PETSC_TRUE, FieldsFillPair(output, state, pair, &fields));
  PetscCall(VecRestoreArray(fields.pressure, &fields.p));
  PetscCall(VecRestoreArray(fields.gap, &fields.g));
  PetscCall(VecRestoreArray(fields.area, &fields.a));
  PetscCall(VecRestoreArray(fields.status, &fields.s));
  PetscCall(VecRestoreArray(fields.force, &fields.f));
  PetscCall(DatasetWrite(&fields.pressure, viewer));
  PetscCall(DatasetWrite(&fields.gap, viewer));
  PetscCall(DatasetWrite(&fields.area, viewer));
  PetscCall(DatasetWrite(&fields.status, viewer));
  PetscCall(DatasetWrite(&fields.force, viewer));
  if (fields.shear) PetscCall(FieldsWriteFriction(&fields, viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode FieldsWriteContact(Output output, const StepState *state, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(FieldsWritePair(output, state, -1, NULL, viewer));
  for (PetscInt p = 0; p < output->npairs; ++p)
    PetscCall(FieldsWritePair(output, state, p, output->pairnames[p], viewer));
  PetscFunctionReturn(0);
}

typedef struct {
  Output           output;
  const StepState *state;
} FieldsState;

static PetscErrorCode FieldsWriteState(PetscViewer viewer, void *ctx)
{
  Output           output = ((FieldsState *)ctx)->output;
  const StepState *state  = ((FieldsState *)ctx)->state;
  const PetscReal  time   = state->report->time;

  PetscFunctionBegin;
  PetscCall(PetscViewerSetFromOptions(viewer));
  PetscCall(FieldsWriteGlobal(output, "displacement", state->displacement, viewer));
  if (state->velocity) PetscCall(FieldsWriteGlobal(output, "velocity", state->velocity, viewer));
  if (state->reaction) PetscCall(FieldsWriteGlobal(output, "reaction", state->reaction, viewer));
  PetscCall(StressWriteCells(output, state, viewer));
  PetscCall(StressWriteNodes(output, state, viewer));
  PetscCall(StressWriteQuadrature(output, state, viewer));
  PetscCall(FieldsWriteContact(output, state, viewer));
  PetscCall(PetscViewerHDF5WriteAttribute(viewer, NULL, "time", PETSC_REAL, &time));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputWriteFields(Output output, const StepState *state)
{
  char        file[PETSC_MAX_PATH_LEN];
  FieldsState what = {output, state};

  PetscFunctionBegin;
  PetscCall(OutputGetStepFile(output, state->report->step, file, sizeof(file)));
  PetscCall(FileWriteHDF5(output->comm, file, FieldsWriteState, &what, NULL));
  PetscFunctionReturn(0);
}
