/*
   An overlap that follows a ramp: the faces of its pair count as farther apart than they are by what the ramp has yet
   to bring, so that an overlap as large as is meant closes from nothing. The gap of a row grows as if its mortar face
   stood off along the row's normal.
*/
#include "stepimpl.h"

/* 1 at the rows of a component of the pair's mortar face */
static PetscErrorCode InterferenceMark(Simulation sim, PetscInt pair, PetscInt component, Vec mark)
{
  IS              is;
  const PetscInt *rows;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(mark));
  PetscCall(MeshGetFaceDofs(sim->dm, sim->scene->pairs[pair].mortar, component, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &rows));
  for (PetscInt k = 0; k < n; ++k) PetscCall(VecSetValue(mark, rows[k], 1.0, INSERT_VALUES));
  PetscCall(ISRestoreIndices(is, &rows));
  PetscCall(ISDestroy(&is));
  PetscCall(VecAssemblyBegin(mark));
  PetscCall(VecAssemblyEnd(mark));
  PetscFunctionReturn(0);
}

/* Adds to the gap of the pair's rows what moving its mortar face off by a distance does */
static PetscErrorCode InterferenceStandOff(Simulation sim, PetscInt pair, PetscReal distance, ContactLinearization lin)
{
  PetscScalar       *g;
  const PetscScalar *v;
  PetscReal         *size;
  Vec                mark, moved;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path.u, &mark));
  PetscCall(VecDuplicate(lin->g, &moved));
  PetscCall(PetscCalloc1(lin->nlocal, &size));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(InterferenceMark(sim, pair, c, mark));
    PetscCall(MatMult(lin->J, mark, moved));
    PetscCall(VecGetArrayRead(moved, &v));
    for (PetscInt r = 0; r < lin->nlocal; ++r) size[r] += PetscSqr(PetscRealPart(v[r]));
    PetscCall(VecRestoreArrayRead(moved, &v));
  }
  PetscCall(VecGetArray(lin->g, &g));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    if (lin->pair[r] == pair) g[r] += distance * PetscSqrtReal(size[r]);
  }
  PetscCall(VecRestoreArray(lin->g, &g));
  PetscCall(PetscFree(size));
  PetscCall(VecDestroy(&moved));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

/* What the ramps leave of the overlaps at a time, so many times */
PetscErrorCode InterferenceAdd(Simulation sim, PetscReal time, PetscReal times, ContactLinearization lin)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < sim->scene->npairs; ++p) {
    const SceneContactPair *pair   = &sim->scene->pairs[p];
    PetscReal               factor = 1.0;

    if (pair->interference_ramp >= 0 && pair->interference > 0.0 && pair->interference < PETSC_INFINITY)
      PetscCall(SceneGetFactor(sim->scene, pair->interference_ramp, time, &factor));
    if (factor != 1.0) PetscCall(InterferenceStandOff(sim, p, times * (1.0 - factor) * pair->interference, lin));
  }
  PetscFunctionReturn(0);
}
