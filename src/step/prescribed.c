/* Prescribed displacements: from faces and components of the scene to owned global rows and values. */
#include "stepimpl.h"

static PetscErrorCode PrescribedCollect(DM dm, PetscInt n, const SceneDisplacement d[], PetscInt *count, PetscInt *rows, PrescribedValue *values)
{
  PetscFunctionBegin;
  *count = 0;
  for (PetscInt i = 0; i < n; ++i) {
    for (PetscInt c = 0; c < 3; ++c) {
      IS              is;
      const PetscInt *idx;
      PetscInt        nloc;

      if (!d[i].fixed[c]) continue;
      PetscCall(MeshGetFaceDofs(dm, d[i].face, c, &is));
      PetscCall(ISGetLocalSize(is, &nloc));
      if (rows) {
        PetscCall(ISGetIndices(is, &idx));
        for (PetscInt k = 0; k < nloc; ++k) {
          rows[*count + k]   = idx[k];
          values[*count + k] = (PrescribedValue){d[i].value[c], d[i].value[c] != 0.0 ? d[i].ramp : 0};
        }
        PetscCall(ISRestoreIndices(is, &idx));
      }
      *count += nloc;
      PetscCall(ISDestroy(&is));
    }
  }
  PetscFunctionReturn(0);
}

/* Faces share edges: one value a row remains, and two that differ are an error on every rank */
static PetscErrorCode PrescribedMerge(MPI_Comm comm, Prescribed *p)
{
  PetscInt        unique   = 0;
  PetscReal       worst[2] = {0.0, 0.0}; /* difference of two values; 1 if only their ramps differ */
  PrescribedValue work;

  PetscFunctionBegin;
  PetscCall(PetscSortIntWithDataArray(p->n, p->rows, p->values, sizeof(PrescribedValue), &work));
  for (PetscInt k = 0; k < p->n; ++k) {
    if (unique && p->rows[unique - 1] == p->rows[k]) {
      worst[0] = PetscMax(worst[0], PetscAbsReal(p->values[unique - 1].value - p->values[k].value));
      if (p->values[unique - 1].ramp != p->values[k].ramp) worst[1] = 1.0;
      continue;
    }
    p->rows[unique]     = p->rows[k];
    p->values[unique++] = p->values[k];
  }
  p->n = unique;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, worst, 2, MPIU_REAL, MPIU_MAX, comm));
  PetscCheck(worst[0] == 0.0, comm, PETSC_ERR_USER_INPUT, "displacements: two faces prescribe values that differ by %g on the vertices they share", (double)worst[0]);
  PetscCheck(worst[1] == 0.0, comm, PETSC_ERR_USER_INPUT, "displacements: two faces prescribe the same value by different ramps on the vertices they share");
  PetscFunctionReturn(0);
}

PetscErrorCode PrescribedCreate(DM dm, Scene scene, Prescribed *p)
{
  PetscFunctionBegin;
  p->scene = scene;
  PetscCall(PrescribedCollect(dm, scene->ndisplacements, scene->displacements, &p->n, NULL, NULL));
  PetscCall(PetscMalloc2(p->n, &p->rows, p->n, &p->values));
  PetscCall(PrescribedCollect(dm, scene->ndisplacements, scene->displacements, &p->n, p->rows, p->values));
  PetscCall(PrescribedMerge(PetscObjectComm((PetscObject)dm), p));
  PetscFunctionReturn(0);
}

/* u = factor x value on the prescribed rows; the other rows stay */
PetscErrorCode PrescribedApply(const Prescribed *p, PetscReal time, Vec u)
{
  PetscScalar *a;
  PetscInt     rstart;
  PetscReal   *factor;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(p->scene->nramps, &factor));
  for (PetscInt r = 0; r < p->scene->nramps; ++r) PetscCall(SceneGetFactor(p->scene, r, time, &factor[r]));
  PetscCall(VecGetOwnershipRange(u, &rstart, NULL));
  PetscCall(VecGetArray(u, &a));
  for (PetscInt k = 0; k < p->n; ++k) a[p->rows[k] - rstart] = factor[p->values[k].ramp] * p->values[k].value;
  PetscCall(VecRestoreArray(u, &a));
  PetscCall(PetscFree(factor));
  PetscFunctionReturn(0);
}

/* One value on all prescribed rows */
PetscErrorCode PrescribedSet(const Prescribed *p, PetscReal value, Vec v)
{
  PetscScalar *a;
  PetscInt     rstart;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(v, &rstart, NULL));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt k = 0; k < p->n; ++k) a[p->rows[k] - rstart] = value;
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/*
   Sum of each component over the driven rows, those whose prescribed value is not zero; over all prescribed rows where
   none is driven. The sum over all rows would only say that the bodies are in equilibrium.
*/
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
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)v)));
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
