/* Differences between a contact linearization and the one at its solution, apart from the gap: rotation of the
   normals and change of the slip. */
#include "stepimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/path.h"

/* Weight of the rotation of the normals. The error of the displacements is proportional to it, that of the gap is of
   second order. Updates with friction, which have no Newton's method, would take twice as many for it */
static const PetscReal askew = 1.0, askew_friction = 1e-2;

/* Weight of the error of free rotations: elastic faces that are tied to the body would be strained by it */
static const PetscReal tied = 1e4;

/*
   Rotation of the normals between the last contact update and at_u: over all pairs the largest
   sum_r p_r m_r |n' - n| / sum_r p_r m_r. row[r]: the row of at_u that corresponds to row r of the last update, or
   negative
*/
static PetscErrorCode ContactUpdateErrorMeasureTurn(Simulation sim, const ContactSolution *sol,
  ContactLinearization at_u, const PetscInt row[], PetscReal *turn)
{
  ContactLinearization solved = sim->solved->linearization;
  const PetscInt       npairs = sim->scene->npairs;
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
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * npairs), MPIU_REAL, MPIU_SUM, sim->comm));
  for (PetscInt p = 0; p < npairs; ++p) {
    if (sums[2 * p + 1] > 0.0) *turn = PetscMax(*turn, sums[2 * p] / sums[2 * p + 1]);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/* Largest difference over the rows between the slip measured along the tangents at u and the slip of the solution
   [length]. Both are counted from the last state of equilibrium. */
static PetscErrorCode ContactUpdateErrorMeasureSlip(Simulation sim, Vec u, const ContactSolution *sol,
  ContactLinearization at_u, const PetscInt row[], PetscReal *change)
{
  ContactLinearization solved = sim->solved->linearization;
  const Bodies         bodies = SimulationBodies(sim);
  const PetscScalar   *s, *a;
  PetscReal            worst = 0.0;
  PetscBool            turned;
  Vec                  increment, slip;

  PetscFunctionBegin;
  *change = 0.0;
  if (!sol->slip) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(ArcsGetExcess(&bodies, sim->path->u, u, increment, &turned));
  if (!turned) PetscCall(VecZeroEntries(increment));
  PetscCall(VecAXPBYPCZ(increment, 1.0, -1.0, 1.0, u, sim->path->u));
  PetscCall(MatCreateVecs(at_u->slip, NULL, &slip));
  PetscCall(MatMult(at_u->slip, increment, slip));
  PetscCall(VecGetArrayRead(slip, &s));
  PetscCall(VecGetArrayRead(sol->slip, &a));
  for (PetscInt r = 0; r < solved->nlocal; ++r) {
    const PetscReal *t0 = &solved->tangent[6 * r], *t1 = &at_u->tangent[6 * row[r]];
    PetscReal        square = 0.0;

    if (row[r] < 0) continue;
    for (PetscInt c = 0; c < 3; ++c)
      square += PetscSqr(PetscRealPart(
        s[2 * row[r]] * t1[c] + s[2 * row[r] + 1] * t1[3 + c] - a[2 * r] * t0[c] - a[2 * r + 1] * t0[3 + c]));
    worst = PetscMax(worst, PetscSqrtReal(square));
  }
  PetscCall(VecRestoreArrayRead(sol->slip, &a));
  PetscCall(VecRestoreArrayRead(slip, &s));
  PetscCall(VecDestroy(&slip));
  PetscCall(VecDestroy(&increment));
  PetscCallMPI(MPI_Allreduce(&worst, change, 1, MPIU_REAL, MPIU_MAX, sim->comm));
  PetscFunctionReturn(0);
}

/* at_u: at the state u, which was found with sim->solved->linearization; report->gap_change is set. Sets the rotation
   of the normals, the change of the slip, and update_error: the largest of the three and of the correction of free
   rotations, each as an equivalent change of the gap [length] */
PetscErrorCode ContactUpdateMeasureError(Simulation sim, Vec u, const ContactSolution *sol, ContactLinearization at_u,
  StepReport *report)
{
  const PetscReal weight = sim->solved->linearization->slip ? askew_friction : askew;
  PetscReal       size;
  PetscInt       *row;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(ContactHistoryFollowRows(sim->history, sim->solved->linearization, at_u, &row));
  PetscCall(ContactUpdateErrorMeasureTurn(sim, sol, at_u, row, &report->normals_turn));
  PetscCall(ContactUpdateErrorMeasureSlip(sim, u, sol, at_u, row, &report->slip_change));
  PetscCall(PetscFree(row));
  report->update_error =
    PetscMax(PetscMax(report->gap_change, report->slip_change), weight * report->normals_turn * size);
  report->update_error = PetscMax(report->update_error, tied * report->straightened);
  PetscFunctionReturn(0);
}
