/*
   Measures how a contact linearization differs from the one at its solution, apart from the gap: by the rotation of the
   normals, the change of the slip, and the lever arms of the forces on rigid surfaces.
*/
#include "contact_updateimpl.h"
#include <vector3.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   weight of the rotation of the normals in the error; the error of the displacements is proportional to the rotation,
   whereas the error of the gap is of second order. The weight is smaller with friction, where Newton's method is not
   available and the updates would otherwise be twice as many.
*/
static const PetscReal askew = 1.0, askew_friction = 1e-2;

/*
   allowed error of the lever arms of forces on rigid surfaces, as a fraction of the size of the contact area. If a tool
   slides, the forces act at the positions of the last contact update.
*/
static const PetscReal misplaced = 1e-3;

/*
   weight of the error of free rotations, which is large because this error strains the elastic faces that are tied to
   the body
*/
static const PetscReal tied = 1e4;

/*
   Measures the rotation of the normals from the last contact update to at_u. *turn: the maximum over all pairs of sum_r
   p_r m_r |n'_r - n_r| / sum_r p_r m_r, with pressure p, slack mass m, and normals n of the last update and n' of at_u.
   row[r]: row of at_u that corresponds to row r of the last update; negative: none.
*/
static PetscErrorCode ContactUpdateErrorMeasureTurn(Model model, State state, const ContactSolution *sol,
  ContactLinearization at_u, const PetscInt row[], PetscReal *turn)
{
  ContactLinearization solved = state->solved->linearization;
  const PetscInt       npairs = model->scene->npairs;
  const PetscScalar   *mass, *z;
  PetscReal           *sums;

  PetscFunctionBegin;
  *turn = 0.0;
  PetscCall(PetscCalloc1(2 * npairs, &sums));
  PetscCall(VecGetArrayRead(solved->mass, &mass));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  for (PetscInt r = 0; r < solved->nlocal; ++r) {
    const PetscReal force  = PetscRealPart(z[r]) * PetscRealPart(mass[r]);
    PetscReal       square = 0.0;

    if (row[r] < 0) continue;
    for (PetscInt c = 0; c < 3; ++c) square += PetscSqr(at_u->normal[3 * row[r] + c] - solved->normal[3 * r + c]);
    sums[2 * solved->pair[r]] += force * PetscSqrtReal(square);
    sums[2 * solved->pair[r] + 1] += force;
  }
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscCall(VecRestoreArrayRead(solved->mass, &mass));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * npairs), MPIU_REAL, MPIU_SUM, model->comm));
  for (PetscInt p = 0; p < npairs; ++p) {
    if (sums[2 * p + 1] > 0.0) *turn = PetscMax(*turn, sums[2 * p] / sums[2 * p + 1]);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/*
   Measures the change of the slip. *change: largest difference over the rows between the slip along the tangents at u
   and the slip of the solution [length]. Both slips are measured from the last equilibrium state. row[]: see
   ContactUpdateErrorMeasureTurn().
*/
static PetscErrorCode ContactUpdateErrorMeasureSlip(Model model, State state, Vec u, const ContactSolution *sol,
  ContactLinearization at_u, const PetscInt row[], PetscReal *change)
{
  ContactLinearization solved = state->solved->linearization;
  const Bodies         bodies = ModelBodies(model);
  const PetscScalar   *s, *a;
  PetscReal            worst = 0.0;
  PetscBool            turned;
  Vec                  increment, slip;

  PetscFunctionBegin;
  *change = 0.0;
  if (!sol->slip) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(ArcsGetExcess(&bodies, state->path->u, u, increment, &turned));
  if (!turned) PetscCall(VecZeroEntries(increment));
  PetscCall(VecAXPBYPCZ(increment, 1.0, -1.0, 1.0, u, state->path->u));
  PetscCall(MatCreateVecs(at_u->slip, NULL, &slip));
  PetscCall(MatMult(at_u->slip, increment, slip));
  PetscCall(VecGetArrayRead(slip, &s));
  PetscCall(VecGetArrayRead(sol->slip, &a));
  for (PetscInt r = 0; r < solved->nlocal; ++r) {
    const PetscReal *t0     = &solved->tangent[6 * r], *t1;
    PetscReal        square = 0.0;

    if (row[r] < 0) continue;
    t1 = &at_u->tangent[6 * row[r]];
    for (PetscInt c = 0; c < 3; ++c)
      square += PetscSqr(PetscRealPart(
        s[2 * row[r]] * t1[c] + s[2 * row[r] + 1] * t1[3 + c] - a[2 * r] * t0[c] - a[2 * r + 1] * t0[3 + c]));
    worst = PetscMax(worst, PetscSqrtReal(square));
  }
  PetscCall(VecRestoreArrayRead(sol->slip, &a));
  PetscCall(VecRestoreArrayRead(slip, &s));
  PetscCall(VecDestroy(&slip));
  PetscCall(VecDestroy(&increment));
  PetscCallMPI(MPI_Allreduce(&worst, change, 1, MPIU_REAL, MPIU_MAX, model->comm));
  PetscFunctionReturn(0);
}

/*
   Adds to sums[pair] the sums over the rows of a pair. sums[pair][axis]: moment about the axis by which the forces on
   the rigid surface with the linearization at_u exceed those of the solve [force length]; sums[pair][3]: normal forces
   [force]; sums[pair][4]: slack masses, which are areas [length^2]. The last two are added only for axis 0.
*/
static PetscErrorCode ContactUpdateErrorSumMoments(State state, const ContactSolution *sol, ContactLinearization at_u,
  const PetscInt row[], Vec rotation, PetscInt axis, PetscReal sums[][5])
{
  ContactLinearization solved = state->solved->linearization;
  const PetscScalar   *mass, *z, *a, *b;
  Vec                  before, after;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(solved->g, &before));
  PetscCall(VecDuplicate(at_u->g, &after));
  PetscCall(MatMult(solved->J, rotation, before));
  PetscCall(MatMult(at_u->J, rotation, after));
  PetscCall(VecGetArrayRead(solved->mass, &mass));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(before, &a));
  PetscCall(VecGetArrayRead(after, &b));
  for (PetscInt r = 0; r < solved->nlocal; ++r) {
    PetscReal *sum = sums[solved->pair[r]];

    if (row[r] < 0) continue;
    sum[axis] += PetscRealPart(z[r] * mass[r] * (b[row[r]] - a[r]));
    if (!axis) sum[3] += PetscRealPart(z[r] * mass[r]);
    if (!axis) sum[4] += PetscRealPart(mass[r]);
  }
  PetscCall(VecRestoreArrayRead(after, &b));
  PetscCall(VecRestoreArrayRead(before, &a));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscCall(VecRestoreArrayRead(solved->mass, &mass));
  PetscCall(VecDestroy(&after));
  PetscCall(VecDestroy(&before));
  PetscFunctionReturn(0);
}

/*
   Measures the error of the lever arms of the normal forces on rigid surfaces. *arm: largest error of a pair, or 0 if
   all errors are small compared with the size of the contact area [length].
*/
static PetscErrorCode ContactUpdateErrorMeasureArms(Model model, State state, Vec u, const ContactSolution *sol,
  ContactLinearization at_u, const PetscInt row[], PetscReal *arm)
{
  const Bodies bodies = ModelBodies(model);
  Scene        scene  = model->scene;
  PetscBool    any    = PETSC_FALSE;
  BodyPose    *poses;
  BodyMotion  *turns; /* unit rotations of the rigid surfaces about an axis through their centres */
  Vec          rotation;
  PetscReal(*sums)[5];

  PetscFunctionBegin;
  *arm = 0.0;
  for (PetscInt p = 0; p < scene->npairs; ++p)
    any = (PetscBool)(any || SceneBodyIsSurface(SceneFaceBody(scene, scene->pairs[p].mortar)));
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscCalloc3(scene->nbodies, &poses, scene->nbodies, &turns, scene->npairs, &sums));
  PetscCall(PosesFind(&bodies, NULL, u, poses));
  PetscCall(VecDuplicate(u, &rotation));
  for (PetscInt axis = 0; axis < 3; ++axis) {
    for (PetscInt b = 0; b < scene->nbodies; ++b) {
      turns[b]         = (BodyMotion){.center = {poses[b].to[0], poses[b].to[1], poses[b].to[2]}};
      turns[b].w[axis] = SceneBodyIsSurface(&scene->bodies[b]) ? 1.0 : 0.0;
    }
    PetscCall(VertexPlacesMove(&model->places, u, turns, rotation));
    PetscCall(ContactUpdateErrorSumMoments(state, sol, at_u, row, rotation, axis, sums));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(5 * scene->npairs), MPIU_REAL, MPIU_SUM, model->comm));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const PetscReal wrong = sums[p][3] > 0.0 ? VectorNorm(sums[p]) / sums[p][3] : 0.0;

    if (wrong > misplaced * PetscSqrtReal(sums[p][4])) *arm = PetscMax(*arm, wrong);
  }
  PetscCall(VecDestroy(&rotation));
  PetscCall(PetscFree3(poses, turns, sums));
  PetscFunctionReturn(0);
}

/*
   Measures the error of a contact update. at_u: linearization at the state u, which was computed with
   state->solved->linearization; report->gap_change must be set. Sets report->normals_turn, report->slip_change and
   report->update_error, the largest of five errors: those of gap, slip, normals, lever arms and free rotations, each as
   an equivalent change of the gap [length].
*/
PetscErrorCode ContactUpdateMeasureError(Model model, State state, Vec u, const ContactSolution *sol,
  ContactLinearization at_u, StepReport *report)
{
  const PetscReal weight = state->solved->linearization->slip ? askew_friction : askew;
  PetscReal       size, arm, extent;
  PetscInt       *row;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(model->places.x, NORM_INFINITY, &extent));
  PetscCall(ContactHistoryFollowRows(state->history, state->solved->linearization, at_u, &row));
  PetscCall(ContactUpdateErrorMeasureTurn(model, state, sol, at_u, row, &report->normals_turn));
  PetscCall(ContactUpdateErrorMeasureSlip(model, state, u, sol, at_u, row, &report->slip_change));
  PetscCall(ContactUpdateErrorMeasureArms(model, state, u, sol, at_u, row, &arm));
  PetscCall(PetscFree(row));
  report->update_error =
    PetscMax(PetscMax(report->gap_change, report->slip_change), weight * report->normals_turn * size);
  report->update_error = PetscMax(report->update_error, arm);
  if (report->straightened > STEP_PLACE_ROUNDING * extent)
    report->update_error = PetscMax(report->update_error, tied * report->straightened);
  PetscFunctionReturn(0);
}
