/*
   Plastic strains at quadrature points. A point is identified by its coordinates. Each rank searches for its points
   among all points of the file, whichever ranks wrote and read them. On another mesh the points have other coordinates,
   and take the strains of the nearest points of the file. These are states of yielding metal that exist, whereas
   interpolated ones need not be.
*/
#include "checkpointimpl.h"
#include <stdlib.h>

/*
   Key of a point: its coordinates, as multiples of a step that is so small that no two points of a mesh share a key,
   and its body
*/
typedef struct {
  PetscInt64 at[4];
  PetscInt   point;
} PlasticKey;

/* The quadrature points of this rank */
typedef struct {
  PetscInt    n;
  PlasticKey *keys; /* in ascending order */
  PetscReal   step; /* step to which coordinates are rounded [length] */
  PetscBool  *found;
  PetscReal  *square; /* of points that are not found: squared distance of the nearest point so far [length^2] */
} PlasticIndex;

static int PlasticCompare(const void *a, const void *b)
{
  const PetscInt64 *x = ((const PlasticKey *)a)->at, *y = ((const PlasticKey *)b)->at;

  for (int d = 0; d < 4; ++d) {
    if (x[d] != y[d]) return x[d] < y[d] ? -1 : 1;
  }
  return 0;
}

/*
   Sets the key of a point with these coordinates. Bit d of `shift` says whether coordinate d is rounded after an
   addition (1) or a subtraction (0) of `quarter` steps. With all eight shifts a point is found even if rounding errors
   moved it across a rounding limit.
*/
static void PlasticSetKey(const PetscReal place[4], PetscReal step, int shift, PetscReal quarter, PlasticKey *key)
{
  for (int d = 0; d < 3; ++d)
    key->at[d] = (PetscInt64)PetscFloorReal(place[d] / step + 0.5 + (shift >> d & 1 ? quarter : -quarter));
  key->at[3] = (PetscInt64)place[3];
}

/* The parts of a point's history. The plastic deformation is stored only if a law has one. */
static const struct {
  const char *name;
  PetscInt    at, n;
} parts[] = {
  {CHECKPOINT_PLASTIC, 0, MATERIAL_PLASTIC},
  {CHECKPOINT_PLASTIC_DEFORMATION, MATERIAL_PLASTIC, MATERIAL_DEFORMATION},
};

int CheckpointPlasticParts(Scene scene)
{
  int n = 0;

  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const Material *material = &scene->bodies[b].material;

    if (MaterialYields(material)) n = PetscMax(n, MaterialIsFinite(material) ? 2 : 1);
  }
  return n;
}

PetscErrorCode CheckpointAddPlastic(Scene scene, Elasticity elasticity, Checkpoint checkpoint)
{
  PetscInt   n;
  PetscReal *places, *history, *values;

  PetscFunctionBegin;
  PetscCall(ElasticityGetHistory(elasticity, &n, &places, &history));
  if (!places) PetscFunctionReturn(0);
  PetscCall(CheckpointAddField(checkpoint, CHECKPOINT_PLASTIC_PLACES, 4, n, &values));
  PetscCall(PetscArraycpy(values, places, 4 * n));
  for (int p = 0; p < CheckpointPlasticParts(scene); ++p) {
    PetscCall(CheckpointAddField(checkpoint, parts[p].name, parts[p].n, n, &values));
    for (PetscInt i = 0; i < n; ++i)
      PetscCall(PetscArraycpy(values + parts[p].n * i, history + MATERIAL_HISTORY * i + parts[p].at, parts[p].n));
  }
  PetscCall(PetscFree(places));
  PetscFunctionReturn(0);
}

static PetscErrorCode PlasticIndexCreate(MPI_Comm comm, PetscInt n, const PetscReal places[], PlasticIndex *index)
{
  const PetscReal fine = 1e-8;
  PetscReal       size = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 4 * n; ++i) size = i % 4 < 3 ? PetscMax(size, PetscAbsReal(places[i])) : size;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPIU_REAL, MPIU_MAX, comm));
  index->n    = n;
  index->step = fine * size;
  PetscCall(PetscMalloc1(n, &index->keys));
  PetscCall(PetscCalloc2(n, &index->found, n, &index->square));
  for (PetscInt i = 0; i < n; ++i) {
    PlasticSetKey(places + 4 * i, index->step, 0, 0, &index->keys[i]);
    index->keys[i].point = i;
  }
  if (n) qsort(index->keys, (size_t)n, sizeof(*index->keys), PlasticCompare);
  PetscFunctionReturn(0);
}

/* Copies one part of the history from records of the file to this rank's points, and marks these as found */
static void PlasticTake(PlasticIndex *index, int part, PetscInt n, const PetscReal places[], const PetscReal from[],
  PetscReal history[])
{
  for (PetscInt i = 0; i < n && index->n; ++i) {
    const PlasticKey *own = NULL;

    for (int shift = 0; shift < 8 && !own; ++shift) {
      PlasticKey key;

      PlasticSetKey(places + 4 * i, index->step, shift, 0.25, &key);
      own = (const PlasticKey *)bsearch(&key, index->keys, (size_t)index->n, sizeof(key), PlasticCompare);
    }
    if (!own) continue;
    index->found[own->point] = PETSC_TRUE;
    for (PetscInt k = 0; k < parts[part].n; ++k)
      history[MATERIAL_HISTORY * own->point + parts[part].at + k] = from[parts[part].n * i + k];
  }
}

/*
   Copies one part of the history from the nearest records to the points of this rank that were not found, if these
   records are nearer than those of the calls before. own: places of this rank's points.
*/
static PetscErrorCode PlasticTakeNearest(PlasticIndex *index, int part, PetscInt n, const PetscReal places[],
  const PetscReal from[], const PetscReal own[], PetscReal history[])
{
  PlasticGrid grid;

  PetscFunctionBegin;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PlasticGridCreate(n, places, &grid));
  for (PetscInt i = 0; i < index->n; ++i) {
    PetscInt record = PETSC_DECIDE;

    if (!index->found[i]) record = PlasticGridFind(&grid, own + 4 * i, &index->square[i]);
    if (record >= 0)
      PetscCall(
        PetscArraycpy(history + MATERIAL_HISTORY * i + parts[part].at, from + parts[part].n * record, parts[part].n));
  }
  PetscCall(PlasticGridDestroy(&grid));
  PetscFunctionReturn(0);
}

/*
   Copies one part of the history from all records of the file to the points of all ranks. Each rank in turn broadcasts
   the records that it has read. nearest: NULL to find the points in the file; else places of this rank's points, of
   which those that were not found take the nearest records.
*/
static PetscErrorCode PlasticTakeAll(MPI_Comm comm, int part, Checkpoint checkpoint, const PetscReal nearest[],
  PlasticIndex *index, PetscReal history[])
{
  const CheckpointField *places, *field;
  const PetscInt         width = parts[part].n;
  PetscMPIInt            size, rank;

  PetscFunctionBegin;
  PetscCall(CheckpointFindField(checkpoint, CHECKPOINT_PLASTIC_PLACES, &places));
  PetscCall(CheckpointFindField(checkpoint, parts[part].name, &field));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt i = 0; i < index->n; ++i) index->square[i] = PETSC_INFINITY;
  for (PetscMPIInt r = 0; r < size; ++r) {
    PetscInt    n = places->n;
    PetscMPIInt count[2];
    PetscReal  *at, *from;

    PetscCallMPI(MPI_Bcast(&n, 1, MPIU_INT, r, comm));
    PetscCall(PetscMPIIntCast(4 * n, &count[0]));
    PetscCall(PetscMPIIntCast(width * n, &count[1]));
    PetscCall(PetscMalloc2(4 * n, &at, width * n, &from));
    if (r == rank) {
      PetscCall(PetscArraycpy(at, places->values, 4 * n));
      PetscCall(PetscArraycpy(from, field->values, width * n));
    }
    PetscCallMPI(MPI_Bcast(at, count[0], MPIU_REAL, r, comm));
    PetscCallMPI(MPI_Bcast(from, count[1], MPIU_REAL, r, comm));
    if (nearest) PetscCall(PlasticTakeNearest(index, part, n, at, from, nearest, history));
    else PlasticTake(index, part, n, at, from, history);
    PetscCall(PetscFree2(at, from));
  }
  PetscFunctionReturn(0);
}

/* Collective. Returns the number of points of all ranks that are neither found nor near a record of their body */
static PetscErrorCode PlasticCountMissing(MPI_Comm comm, const PlasticIndex *index, PetscInt *missing)
{
  PetscFunctionBegin;
  *missing = 0;
  for (PetscInt i = 0; i < index->n; ++i) *missing += !index->found[i] && index->square[i] == PETSC_INFINITY;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, missing, 1, MPIU_INT, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointGetPlastic(Scene scene, MPI_Comm comm, Elasticity elasticity, Checkpoint checkpoint)
{
  const int    nparts = CheckpointPlasticParts(scene);
  PlasticIndex index;
  PetscInt     n, missing;
  PetscReal   *places, *history;

  PetscFunctionBegin;
  PetscCall(ElasticityGetHistory(elasticity, &n, &places, &history));
  if (!places) PetscFunctionReturn(0);
  PetscCall(PlasticIndexCreate(comm, n, places, &index));
  for (int p = 0; p < nparts; ++p) PetscCall(PlasticTakeAll(comm, p, checkpoint, NULL, &index, history));
  PetscCall(PlasticCountMissing(comm, &index, &missing));
  for (int p = 0; missing && p < nparts; ++p) PetscCall(PlasticTakeAll(comm, p, checkpoint, places, &index, history));
  PetscCall(PlasticCountMissing(comm, &index, &missing));
  PetscCall(PetscFree(index.keys));
  PetscCall(PetscFree2(index.found, index.square));
  PetscCall(PetscFree(places));
  PetscCheck(!missing, comm, PETSC_ERR_FILE_UNEXPECTED,
    "the run cannot continue from the checkpoint: it lacks the plastic strains of %" PetscInt_FMT " quadrature points",
    missing);
  PetscFunctionReturn(0);
}
