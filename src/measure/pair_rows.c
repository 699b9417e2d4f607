/* Rows of one contact pair: area, normal, pressure, gap, friction and status */
#include "pair_rows.h"
#include <vector3.h>
#include "src/state/contact_state.h"
#include "src/state/path.h"

/* Computes for each row A the vector mass_A x sum of A_AB over the vertices B of the mortar side. at: position of these
   sums in those of the linearization, if it has them */
static PetscErrorCode PairRowsSum(Simulation sim, PetscInt pair, Mat A, PetscInt at, PetscInt n, PetscReal vector[])
{
  ContactLinearization lin = sim->solved->linearization;
  Vec                  mark, sum;
  const PetscScalar   *s;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path->u, &mark));
  PetscCall(VecDuplicate(lin->mass, &sum));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecZeroEntries(mark));
    PetscCall(PairMarkFace(sim->dm, sim->scene->pairs[pair].mortar, c, 1, mark));
    PetscCall(MatMult(A, mark, sum));
    PetscCall(VecPointwiseMult(sum, sum, lin->mass));
    PetscCall(VecGetArrayRead(sum, &s));
    for (PetscInt r = 0; r < n; ++r) vector[3 * r + c] = lin->pair[r] == pair ? PetscRealPart(s[r]) : 0.0;
    PetscCall(VecRestoreArrayRead(sum, &s));
  }
  PetscCall(VecGetArrayRead(lin->mass, &s));
  for (PetscInt i = 0; lin->mortar_sum && i < 3 * n; ++i) {
    if (lin->pair[i / 3] == pair) vector[i] = PetscRealPart(s[i / 3]) * lin->mortar_sum[6 * (i / 3) + at + i % 3];
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &s));
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

/*
   Returns whether a row is in contact: the strain that corresponds to the pressure (pressure/young) exceeds that of the
   gap (gap/length). With an interior point method the product of the two is equal in all rows and tends to zero.
*/
PetscBool PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length)
{
  return (PetscBool)(pressure / young > gap / length);
}

/* Sets friction stress and slip. A row slips if its slip exceeds the rounding error of displacements. */
static PetscErrorCode PairRowsSetFriction(Simulation sim, PetscInt pair, const PetscScalar mass[], PairRows *rows)
{
  const PetscReal      rounding = 1e-9;
  ContactLinearization lin      = sim->solved->linearization;
  PetscReal            size;

  PetscFunctionBegin;
  PetscCall(VecNorm(sim->path->u, NORM_INFINITY, &size));
  PetscCall(PetscCalloc3(rows->n, &rows->slips, 3 * rows->n, &rows->shear, 3 * rows->n, &rows->slid));
  for (PetscInt r = 0; r < rows->n; ++r) {
    const PetscReal *s = &sim->solved->slip[2 * r], *f = &sim->solved->shear[2 * r], *t = &lin->tangent[6 * r];

    if (lin->pair[r] != pair || !(rows->area[r] > 0.0)) continue;
    rows->slips[r] = rows->closed[r] > 0.0 && PetscSqr(s[0]) + PetscSqr(s[1]) > PetscSqr(rounding * size) ? 1.0 : 0.0;
    for (PetscInt c = 0; c < 3; ++c) {
      rows->shear[c * rows->n + r] = (f[0] * t[c] + f[1] * t[3 + c]) / PetscRealPart(mass[r]);
      rows->slid[c * rows->n + r] =
        (s[0] * t[c] + s[1] * t[3 + c]) * PetscRealPart(mass[r]) * rows->covered[r] / rows->area[r];
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PairRowsCreate(Simulation sim, PetscInt pair, PairRows *rows)
{
  const SceneContactPair *faces = &sim->scene->pairs[pair];
  ContactLinearization    lin   = sim->solved->linearization;
  const PetscInt          n     = lin->nlocal;
  const PetscScalar      *mass;
  PetscReal              *force;

  PetscFunctionBegin;
  *rows       = (PairRows){.n = n,
          .self               = (PetscBool)(faces->self != NULL),
          .frictional         = (PetscBool)(sim->solved->linearization->slip && SceneContactPairHasFriction(faces))};
  rows->young = PetscMin(SceneFaceBody(sim->scene, faces->mortar)->material.young,
    SceneFaceBody(sim->scene, faces->nonmortar)->material.young);
  PetscCall(PetscCalloc7(n, &rows->area, n, &rows->covered, 3 * n, &rows->normal, n, &rows->pressure, n, &rows->gap, n,
    &rows->closed, n, &rows->length));
  PetscCall(PetscCalloc3(n, &rows->own, n, &rows->facing, n, &rows->presses));
  PetscCall(PetscMalloc1(3 * n, &force));
  PetscCall(PairRowsSum(sim, pair, rows->self ? lin->mortar_cover : PairCover(lin), 3, n, rows->normal));
  PetscCall(PairRowsSum(sim, pair, rows->self ? lin->mortar : lin->J, 0, n, force));
  PetscCall(VecGetArrayRead(sim->solved->linearization->mass, &mass));
  for (PetscInt r = 0; r < n; ++r) {
    PetscReal *normal = &rows->normal[3 * r], size = VectorNorm(normal);

    if (!(size > 0.0)) continue;
    rows->area[r]     = VectorNorm(&force[3 * r]);
    rows->covered[r]  = rows->area[r] / size;
    rows->pressure[r] = sim->solved->pressure[r];
    rows->length[r] = rows->own[r] = PetscSqrtReal(PetscRealPart(mass[r]));
    rows->gap[r]                   = sim->solved->gap[r] * PetscRealPart(mass[r]) / size;
    for (PetscInt c = 0; c < 3; ++c) normal[c] /= size;
    if (rows->area[r] > 0.0 && PairIsClosed(rows->pressure[r], rows->gap[r], rows->young, rows->length[r]))
      rows->closed[r] = rows->presses[r] = 1.0;
  }
  PetscCall(PetscFree(force));
  if (rows->frictional) PetscCall(PairRowsSetFriction(sim, pair, mass, rows));
  PetscCall(VecRestoreArrayRead(sim->solved->linearization->mass, &mass));
  PetscFunctionReturn(0);
}

PetscErrorCode PairRowsDestroy(PairRows *rows)
{
  PetscFunctionBegin;
  if (rows->frictional) PetscCall(PetscFree3(rows->slips, rows->shear, rows->slid));
  PetscCall(PetscFree3(rows->own, rows->facing, rows->presses));
  PetscCall(PetscFree7(rows->area, rows->covered, rows->normal, rows->pressure, rows->gap, rows->closed, rows->length));
  PetscFunctionReturn(0);
}
