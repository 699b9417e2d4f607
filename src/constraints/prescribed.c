/* Prescribed displacements: converts the faces and components of the scene into owned global rows and their values */
#include "constraintsimpl.h"

/* Returns the prescribed value of a row of displacement d. For a rigid motion it refers to the leader. */
static PrescribedValue PrescribedGetValue(Scene scene, PetscInt d, PetscInt component)
{
  const SceneDisplacement *entry  = &scene->displacements[d];
  PetscReal                drives = 0.0;

  if (!entry->moves)
    return (
      PrescribedValue){entry->value[component], entry->value[component] != 0.0 ? entry->ramp : 0, PETSC_DECIDE, d};
  for (PetscInt e = d; e < scene->ndisplacements; ++e) {
    const SceneDisplacement *other = &scene->displacements[e];

    if (MotionFindLeader(scene, e) != d) continue;
    for (PetscInt i = 0; i < 3; ++i) drives = other->value[i] != 0.0 || other->rotation[i] != 0.0 ? 1.0 : drives;
  }
  return (PrescribedValue){drives, 0, d, d};
}

/* Lists the prescribed rows of this rank and their values, with repetitions. If rows is NULL, only counts them. */
static PetscErrorCode PrescribedCollect(DM dm, Scene scene, PetscInt *count, PetscInt *rows, PrescribedValue *values)
{
  const SceneDisplacement *d = scene->displacements;

  PetscFunctionBegin;
  *count = 0;
  for (PetscInt i = 0; i < scene->ndisplacements; ++i) {
    for (PetscInt c = 0; c < 3; ++c) {
      IS              is;
      const PetscInt *idx;
      PetscInt        nloc;

      if (!d[i].fixed[c] || (d[i].moves && MotionFindLeader(scene, i) < i)) continue;
      PetscCall(MeshGetFaceDofs(dm, d[i].face, c, &is));
      PetscCall(ISGetLocalSize(is, &nloc));
      if (rows) {
        PetscCall(ISGetIndices(is, &idx));
        for (PetscInt k = 0; k < nloc; ++k) {
          rows[*count + k]   = idx[k];
          values[*count + k] = PrescribedGetValue(scene, i, c);
        }
        PetscCall(ISRestoreIndices(is, &idx));
      }
      *count += nloc;
      PetscCall(ISDestroy(&is));
    }
  }
  PetscFunctionReturn(0);
}

/* Computes the displacements u of all prescribed rows [length]. factor: factor of each ramp */
static PetscErrorCode PrescribedEvaluate(const Prescribed *p, const PetscReal factor[], PetscReal u[])
{
  const PetscScalar *x;
  PetscInt           rstart, last = PETSC_DECIDE;
  RigidMotion        motion;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(p->x, &rstart, NULL));
  PetscCall(VecGetArrayRead(p->x, &x));
  for (PetscInt k = 0; k < p->n; ++k) {
    const PrescribedValue *v = &p->values[k];
    const PetscInt         i = p->rows[k] - rstart;

    if (v->motion >= 0 && v->motion != last) MotionGet(p->scene, last = v->motion, factor, &motion);
    u[k] = v->motion < 0 ? factor[v->ramp] * v->value : MotionDisplace(&motion, &x[i - i % 3], i % 3);
  }
  PetscCall(VecRestoreArrayRead(p->x, &x));
  PetscFunctionReturn(0);
}

/* Returns one number for the displacements of the scene that prescribe the values j and k */
static PetscInt PrescribedEntries(const Prescribed *p, PetscInt j, PetscInt k)
{
  const PetscInt a = p->values[j].entry, b = p->values[k].entry;

  return PetscMin(a, b) * p->scene->ndisplacements + PetscMax(a, b);
}

/* Increases *worst to the largest difference between two values that are prescribed for one row, if all ramps have the
   factor `all` [length]. entries: the two displacements of this row, see PrescribedEntries(). Values of rigid motions
   may differ by rounding. */
static PetscErrorCode PrescribedDiffer(const Prescribed *p, PetscReal all, PetscReal *worst, PetscInt *entries)
{
  PetscReal *u, *factor, size = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(p->n, &u, p->scene->nramps, &factor));
  for (PetscInt r = 0; r < p->scene->nramps; ++r) factor[r] = all;
  PetscCall(PrescribedEvaluate(p, factor, u));
  for (PetscInt k = 0; k < p->n; ++k) size = PetscMax(size, PetscAbsReal(u[k]));
  for (PetscInt k = 1; k < p->n; ++k) {
    const PetscReal difference = PetscAbsReal(u[k] - u[k - 1]);
    const PetscReal rounding   = p->values[k].motion < 0 && p->values[k - 1].motion < 0 ? 0.0 : 1e-12 * size;

    if (p->rows[k] != p->rows[k - 1] || !(difference > rounding) || !(difference > *worst)) continue;
    *worst   = difference;
    *entries = PrescribedEntries(p, k - 1, k);
  }
  PetscCall(PetscFree2(u, factor));
  PetscFunctionReturn(0);
}

/* Collective. It is an error if a row has two different values. worst, entries: see PrescribedMerge() */
static PetscErrorCode PrescribedCheck(MPI_Comm comm, Scene scene, const PetscReal worst[2], PetscInt entries[2])
{
  const SceneDisplacement *d[2][2] = {{NULL, NULL}, {NULL, NULL}};
  PetscReal                all[2];

  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(worst, all, 2, MPIU_REAL, MPIU_MAX, comm));
  if (all[0] == 0.0 && all[1] == 0.0) PetscFunctionReturn(0);
  for (int i = 0; i < 2; ++i) entries[i] = worst[i] > 0.0 && worst[i] >= all[i] ? entries[i] : 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, entries, 2, MPIU_INT, MPI_MAX, comm));
  for (int i = 0; i < 2; ++i) {
    d[i][0] = &scene->displacements[entries[i] / scene->ndisplacements];
    d[i][1] = &scene->displacements[entries[i] % scene->ndisplacements];
  }
  SceneCheck(all[0] == 0.0, comm, PETSC_ERR_USER_INPUT, d[0][1],
    "the faces %s and %s have prescribed displacements that differ by %g on the vertices they share: prescribe the "
    "same values there, or different components",
    d[0][0]->face, d[0][1]->face, (double)all[0]);
  SceneCheck(all[1] == 0.0, comm, PETSC_ERR_USER_INPUT, d[1][1],
    "the faces %s and %s have the same prescribed displacement by different ramps on the vertices they share: use one "
    "ramp for both",
    d[1][0]->face, d[1][1]->face);
  PetscFunctionReturn(0);
}

/* Collective. Removes repeated rows, which arise where faces share edges. It is an error if a row has two different
   values. */
static PetscErrorCode PrescribedMerge(MPI_Comm comm, Prescribed *p)
{
  Scene           scene  = p->scene;
  PetscInt        unique = 0, entries[2] = {0, 0};
  PetscReal       worst[2] = {0.0, 0.0}; /* the largest difference of two values of a row [length]; 1 if two values
                                            of a row are equal but have different ramps. entries: their
                                            displacements */
  PrescribedValue work;

  PetscFunctionBegin;
  PetscCall(PetscSortIntWithDataArray(p->n, p->rows, p->values, sizeof(PrescribedValue), &work));
  PetscCall(PrescribedDiffer(p, 1.0, &worst[0], &entries[0]));
  PetscCall(PrescribedDiffer(p, 0.37, &worst[0],
    &entries[0])); /* A second factor detects motions that end where they started. */
  for (PetscInt k = 0; k < p->n; ++k) {
    if (unique && p->rows[unique - 1] == p->rows[k]) {
      if (p->values[unique - 1].ramp == p->values[k].ramp) continue;
      worst[1]   = 1.0;
      entries[1] = PrescribedEntries(p, unique - 1, k);
      continue;
    }
    p->rows[unique]     = p->rows[k];
    p->values[unique++] = p->values[k];
  }
  p->n = unique;
  PetscCall(PrescribedCheck(comm, scene, worst, entries));
  PetscFunctionReturn(0);
}

PetscErrorCode PrescribedCreate(DM dm, Scene scene, const VertexPlaces *places, Prescribed *p)
{
  PetscFunctionBegin;
  p->scene = scene;
  p->x     = places->x;
  PetscCall(PrescribedCollect(dm, scene, &p->n, NULL, NULL));
  PetscCall(PetscMalloc2(p->n, &p->rows, p->n, &p->values));
  PetscCall(PrescribedCollect(dm, scene, &p->n, p->rows, p->values));
  PetscCall(PrescribedMerge(PetscObjectComm((PetscObject)dm), p));
  PetscFunctionReturn(0);
}

/* Sets the prescribed rows of u to their values at a time. Other rows are unchanged. */
PetscErrorCode PrescribedApply(const Prescribed *p, PetscReal time, Vec u)
{
  PetscScalar *a;
  PetscInt     rstart;
  PetscReal   *factor, *values;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(p->scene->nramps, &factor, p->n, &values));
  for (PetscInt r = 0; r < p->scene->nramps; ++r) PetscCall(SceneGetFactor(p->scene, r, time, &factor[r]));
  PetscCall(PrescribedEvaluate(p, factor, values));
  PetscCall(VecGetOwnershipRange(u, &rstart, NULL));
  PetscCall(VecGetArray(u, &a));
  for (PetscInt k = 0; k < p->n; ++k) a[p->rows[k] - rstart] = values[k];
  PetscCall(VecRestoreArray(u, &a));
  PetscCall(PetscFree2(factor, values));
  PetscFunctionReturn(0);
}

/* Sets the given rows of v, which this rank owns, to one value */
PetscErrorCode RowsSet(PetscInt n, const PetscInt rows[], PetscReal value, Vec v)
{
  PetscScalar *a;
  PetscInt     rstart;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(v, &rstart, NULL));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt k = 0; k < n; ++k) a[rows[k] - rstart] = value;
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Sets all prescribed rows of v to one value */
PetscErrorCode PrescribedSet(const Prescribed *p, PetscReal value, Vec v)
{
  PetscFunctionBegin;
  PetscCall(RowsSet(p->n, p->rows, value, v));
  PetscFunctionReturn(0);
}

/* Sums each component of the reaction over driven rows, which have a prescribed value that is not zero. If no row is
   driven, sums over all prescribed rows. In equilibrium the sum over all rows would be zero. */
PetscErrorCode PrescribedSum(const Prescribed *p, Vec v, PetscReal sum[3])
{
  const PetscScalar *a;
  PetscInt           rstart;
  PetscReal          driven[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  PetscBool          any       = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(v, &rstart, NULL));
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt k = 0; k < p->n; ++k) {
    const PetscReal r = PetscRealPart(a[p->rows[k] - rstart]);

    driven[3 + p->rows[k] % 3] += r;
    if (p->values[k].value == 0.0) continue;
    driven[p->rows[k] % 3] += r;
    any = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, driven, 6, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)v)));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)v)));
  PetscCall(PetscArraycpy(sum, any ? driven : driven + 3, 3));
  PetscFunctionReturn(0);
}

PetscErrorCode PrescribedDestroy(Prescribed *p)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(p->rows, p->values));
  p->n = 0;
  PetscFunctionReturn(0);
}
