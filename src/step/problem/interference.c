/*
   Initial overlaps that follow a ramp. The gap of a pair is increased by the part of its overlap that the ramp has not
   yet applied, (1 - ramp factor) x overlap. If the factor is 0, faces with an overlap of exactly the given size touch
   without pressure. The increase acts along the normal of each row.
*/
#include "problemimpl.h"
#include "src/state/path.h"

/*
   Computes by how much a unit translation of the mortar face along the normal of each row changes the gap of the pair's
   rows: the part of the row's area that the mortar face covers. size: [nlocal], set in the rows of this pair
*/
PetscErrorCode InterferenceGetCover(Model model, Vec like, PetscInt pair, ContactLinearization lin, PetscReal size[])
{
  const SceneContactPair *here = &model->scene->pairs[pair];
  const PetscScalar      *v;
  Vec                     mark, moved;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(like, &mark));
  PetscCall(VecDuplicate(lin->g, &moved));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecZeroEntries(mark));
    PetscCall(MeshFaceSet(model->dm, here->mortar, c, 1.0, mark));
    PetscCall(MatMult(here->self ? lin->mortar : lin->J, mark, moved));
    PetscCall(VecGetArrayRead(moved, &v));
    for (PetscInt r = 0; r < lin->nlocal; ++r) {
      if (lin->pair[r] != pair) continue;
      size[r] = PetscSqrtReal((c ? PetscSqr(size[r]) : 0.0) + PetscSqr(PetscRealPart(v[r])));
    }
    PetscCall(VecRestoreArrayRead(moved, &v));
  }
  PetscCall(VecDestroy(&moved));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

/*
   Increases the gap in the pair's rows as a rigid translation of the mortar face by `distance` along the normal of each
   row would.
*/
static PetscErrorCode InterferenceStandOff(Model model, State state, PetscInt pair, PetscReal distance,
  ContactLinearization lin)
{
  PetscScalar *g;
  PetscReal   *size;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(lin->nlocal, &size));
  PetscCall(InterferenceGetCover(model, state->path->u, pair, lin, size));
  PetscCall(VecGetArray(lin->g, &g));
  for (PetscInt r = 0; r < lin->nlocal; ++r)
    if (lin->pair[r] == pair) g[r] += distance * size[r];
  PetscCall(VecRestoreArray(lin->g, &g));
  PetscCall(PetscFree(size));
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
