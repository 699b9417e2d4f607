/*
   Plastic strains at quadrature points. They are found by their places: each rank looks for its points among those of
   the file, whichever rank wrote or has read them. On another mesh the points are others, and no strain is carried
   over.
*/
#include "checkpointimpl.h"
#include <stdlib.h>

/* A place in steps so small that no two points of a mesh share one, and the body */
typedef struct {
  PetscInt64 at[4];
  PetscInt   point;
} PlasticKey;

/* The points of this rank */
typedef struct {
  PetscInt    n;
  PlasticKey *keys; /* ascending */
  PetscReal   step; /* [length] */
  PetscBool  *found;
} PlasticIndex;

static int PlasticCompare(const void *a, const void *b)
{
  const PetscInt64 *x = ((const PlasticKey *)a)->at, *y = ((const PlasticKey *)b)->at;

  for (int d = 0; d < 4; ++d) {
    if (x[d] != y[d]) return x[d] < y[d] ? -1 : 1;
  }
  return 0;
}

/* shift: bits say along which axes the place is rounded from a quarter of a step above, or from below */
static void PlasticSetKey(const PetscReal place[4], PetscReal step, int shift, PetscReal quarter, PlasticKey *key)
{
  for (int d = 0; d < 3; ++d)
    key->at[d] = (PetscInt64)PetscFloorReal(place[d] / step + 0.5 + (shift >> d & 1 ? quarter : -quarter));
  key->at[3] = (PetscInt64)place[3];
}

PetscErrorCode CheckpointAddPlastic(Elasticity elasticity, Checkpoint checkpoint)
{
  PetscInt   n;
  PetscReal *places, *history, *values;
  PetscFunctionBegin;
  PetscCall(ElasticityGetHistory(elasticity, &n, &places, &history));
  if (!places) PetscFunctionReturn(0);
  PetscCall(CheckpointAddField(checkpoint, CHECKPOINT_PLASTIC_PLACES, 4, n, &values));
  PetscCall(PetscArraycpy(values, places, 4 * n));
  PetscCall(CheckpointAddField(checkpoint, CHECKPOINT_PLASTIC, MATERIAL_HISTORY, n, &values));
  PetscCall(PetscArraycpy(values, history, MATERIAL_HISTORY * n));
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
  PetscCall(PetscCalloc1(n, &index->found));
  for (PetscInt i = 0; i < n; ++i) {
    PlasticSetKey(places + 4 * i, index->step, 0, 0, &index->keys[i]);
    index->keys[i].point = i;
  }
  if (n) qsort(index->keys, (size_t)n, sizeof(*index->keys), PlasticCompare);
  PetscFunctionReturn(0);
}

/* Takes what is of this rank's points from records of the file, which it marks as found */
static void PlasticTake(PlasticIndex *index, PetscInt n, const PetscReal places[], const PetscReal from[],
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
    for (int k = 0; k < MATERIAL_HISTORY; ++k)
      history[MATERIAL_HISTORY * own->point + k] = from[MATERIAL_HISTORY * i + k];
  }
}

/* The records of each rank in turn to all */
static PetscErrorCode PlasticTakeAll(MPI_Comm comm, const CheckpointField *places, const CheckpointField *field,
  PlasticIndex *index, PetscReal history[])
{
  PetscMPIInt size, rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscMPIInt r = 0; r < size; ++r) {
    PetscInt   n = places->n;
    PetscReal *at, *from;

    PetscCallMPI(MPI_Bcast(&n, 1, MPIU_INT, r, comm));
    PetscCall(PetscMalloc2(4 * n, &at, MATERIAL_HISTORY * n, &from));
    if (r == rank) {
      PetscCall(PetscArraycpy(at, places->values, 4 * n));
      PetscCall(PetscArraycpy(from, field->values, MATERIAL_HISTORY * n));
    }
    PetscCallMPI(MPI_Bcast(at, (PetscMPIInt)(4 * n), MPIU_REAL, r, comm));
    PetscCallMPI(MPI_Bcast(from, (PetscMPIInt)(MATERIAL_HISTORY * n), MPIU_REAL, r, comm));
    PlasticTake(index, n, at, from, history);
    PetscCall(PetscFree2(at, from));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointGetPlastic(MPI_Comm comm, Elasticity elasticity, Checkpoint checkpoint)
{
  const CheckpointField *at, *field;
  PlasticIndex           index;
  PetscInt               n, counts[2] = {0, 0};
  PetscReal             *places, *history;

  PetscFunctionBegin;
  PetscCall(ElasticityGetHistory(elasticity, &n, &places, &history));
  if (!places) PetscFunctionReturn(0);
  PetscCall(CheckpointFindField(checkpoint, CHECKPOINT_PLASTIC_PLACES, &at));
  PetscCall(CheckpointFindField(checkpoint, CHECKPOINT_PLASTIC, &field));
  PetscCall(PlasticIndexCreate(comm, n, places, &index));
  PetscCall(PlasticTakeAll(comm, at, field, &index, history));
  for (PetscInt i = 0; i < n; ++i) counts[0] += !index.found[i];
  counts[1] = n;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPIU_INT, MPI_SUM, comm));
  PetscCall(PetscFree(index.keys));
  PetscCall(PetscFree(index.found));
  PetscCall(PetscFree(places));
  PetscCheck(!counts[0], comm, PETSC_ERR_USER_INPUT,
    "the run cannot continue from the checkpoint: plastic strains cannot be transferred to another mesh, and "
    "%" PetscInt_FMT " of the %" PetscInt_FMT
    " quadrature points are not in the checkpoint; use the mesh of the checkpoint",
    counts[0], counts[1]);
  PetscFunctionReturn(0);
}
