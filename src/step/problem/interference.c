/*
   Initial overlaps that follow a ramp. The gap of a pair is increased by the part of its overlap that the ramp has not
   yet applied, (1 - ramp factor) x overlap. If the factor is 0, faces with an overlap of exactly the given size touch
   without pressure. The increase acts along the normal of each row.
*/
#include "problemimpl.h"
#include "src/state/path.h"

/*
   Increases the gap in the pair's rows as a rigid translation of the mortar face by `distance` along the normal of each
   row would.
*/
static PetscErrorCode InterferenceStandOff(Model model, State state, PetscInt pair, PetscReal distance,
  ContactLinearization lin)
{
  PetscScalar       *g;
  const PetscScalar *v;
  PetscReal         *size;
  Vec                mark, moved;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(state->path->u, &mark));
  PetscCall(VecDuplicate(lin->g, &moved));
  PetscCall(PetscCalloc1(lin->nlocal, &size));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecZeroEntries(mark));
    PetscCall(MeshFaceSet(model->dm, model->scene->pairs[pair].mortar, c, 1.0, mark));
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

/*
   Adds to the gaps of lin `times` the part of the initial overlaps that their ramps have not yet applied at `time`.
   times: 1, or -1 to subtract this part again.
*/
PetscErrorCode InterferenceAdd(Model model, State state, PetscReal time, PetscReal times, ContactLinearization lin)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < model->scene->npairs; ++p) {
    const SceneContactPair *pair   = &model->scene->pairs[p];
    PetscReal               factor = 1.0;

    if (pair->interference_ramp >= 0 && pair->interference > 0.0 && pair->interference < PETSC_INFINITY)
      PetscCall(SceneGetFactor(model->scene, pair->interference_ramp, time, &factor));
    if (factor != 1.0)
      PetscCall(InterferenceStandOff(model, state, p, times * (1.0 - factor) * pair->interference, lin));
  }
  PetscFunctionReturn(0);
}
