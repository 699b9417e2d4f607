/*
   Computes the work dissipated by friction, as the work of the friction forces at the vertices. Forces at vertices are
   used, since covered areas and rows change between load steps.
*/
#include "measureimpl.h"
#include <vector3.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"

/*
   Gets the friction coefficient of a pair at a time: 0 without friction, PETSC_INFINITY if the pressure does not limit
   the friction
*/
PetscErrorCode FrictionGetCoefficient(Scene scene, PetscReal time, PetscInt which, PetscReal *coefficient)
{
  const SceneContactPair *pair   = &scene->pairs[which];
  PetscReal               factor = 1.0;

  PetscFunctionBegin;
  if (pair->friction_ramp >= 0) PetscCall(SceneGetFactor(scene, pair->friction_ramp, time, &factor));
  SceneCheck(factor >= 0.0, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, pair,
    "the coefficient of friction of contact pair \"%s\" follows a ramp to %g times its value at time %g, and must "
    "not be negative",
    pair->name, (double)factor, (double)time);
  if (!SceneContactPairHasFriction(pair)) *coefficient = 0.0;
  else *coefficient = pair->friction < PETSC_INFINITY ? factor * pair->friction : PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/*
   Computes the present friction forces of one pair at the owned vertices of both sides (force), and the energy that
   they have dissipated since the last state (work). The latter is minus the work of the mean of the forces at the last
   and the present state; in the impact scheme, minus that of the present forces, which act during the whole step.
*/
static PetscErrorCode FrictionPairWork(const Measured *at, Vec increment[2], const ContactSolution *sol, PetscInt pair,
  Vec force, PetscReal work[])
{
  const ContactHistory *m      = at->history;
  const PetscReal      *before = &m->friction[3 * pair * m->nowned];
  const PetscReal       part   = SchemeIsImpact(&at->scene->dynamics) ? 1.0 : 0.5; /* as in WorkAdd() */
  const PetscScalar    *now, *a, *b;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(force));
  PetscCall(RowsAddForces(at->solved->linearization, at->solved->linearization->slip, sol->shear, pair, force));
  PetscCall(VecGetArrayRead(force, &now));
  PetscCall(VecGetArrayRead(increment[0], &a));
  PetscCall(VecGetArrayRead(increment[1], &b));
  for (PetscInt v = 0; v < m->nowned; ++v) {
    work[v] = 0.0;
    for (PetscInt i = 3 * v; i < 3 * v + 3; ++i)
      work[v] -= (1.0 - part) * before[i] * PetscRealPart(a[i]) + part * PetscRealPart(now[i]) * PetscRealPart(b[i]);
  }
  PetscCall(VecRestoreArrayRead(increment[1], &b));
  PetscCall(VecRestoreArrayRead(increment[0], &a));
  PetscCall(VecRestoreArrayRead(force, &now));
  PetscFunctionReturn(0);
}

/*
   Adds the magnitudes of the rows' friction forces to sums[2 pair + 1], in proportion to the covered part of each row
*/
static PetscErrorCode FrictionAddSizes(ContactLinearization lin, const ContactSolution *sol, PetscReal sums[])
{
  const PetscScalar *f, *mass;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(sol->shear, &f));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt r = 0; r < lin->nlocal; ++r)
    sums[2 * lin->pair[r] + 1] +=
      PetscSqrtReal(PetscSqr(PetscRealPart(f[2 * r])) + PetscSqr(PetscRealPart(f[2 * r + 1]))) * lin->covered[r] /
      PetscRealPart(mass[r]);
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecRestoreArrayRead(sol->shear, &f));
  PetscFunctionReturn(0);
}

/* Computes the largest friction force that the pressure of a row allows [force] */
static PetscErrorCode FrictionGetBound(const Measured *at, PetscReal time, PetscInt row, PetscReal mass,
  PetscReal pressure, PetscReal *bound)
{
  const PetscInt          which = at->solved->linearization->pair[row];
  const SceneContactPair *pair  = &at->scene->pairs[which];
  PetscReal               coefficient;

  PetscFunctionBegin;
  PetscCall(FrictionGetCoefficient(at->scene, time, which, &coefficient));
  *bound = PETSC_INFINITY;
  if (!(pressure > 0.0) || coefficient == 0.0) *bound = 0.0;
  else if (coefficient < PETSC_INFINITY) *bound = coefficient * pressure * mass;
  if (pair->shear_limit < PETSC_INFINITY) *bound = PetscMin(*bound, pair->shear_limit * mass);
  PetscFunctionReturn(0);
}

/*
   Returns the work of friction in a row that slips, in addition to that of the mean of the forces at the two states. A
   row slips only while its force is at the bound. Its work is therefore the mean of the two bounds times the slip, also
   if the row stuck at the last state, with a force below the bound. before, now: the bounds; old: friction force at the
   last state, in global coordinates [force]; tangent: the row's tangents; f, s: its friction force and its slip, which
   is zero if it sticks.
*/
static PetscReal FrictionLateWork(PetscReal before, PetscReal now, const PetscReal old[3], const PetscReal tangent[6],
  const PetscScalar f[2], const PetscScalar s[2])
{
  const PetscReal slip[2]  = {PetscRealPart(s[0]), PetscRealPart(s[1])},
                  force[2] = {PetscRealPart(f[0]), PetscRealPart(f[1])};
  PetscReal bound =
    0.5 * (PetscMax(before, VectorNorm(old)) + PetscMin(now, PetscSqrtReal(force[0] * force[0] + force[1] * force[1])));
  PetscReal work = bound * PetscSqrtReal(slip[0] * slip[0] + slip[1] * slip[1]);

  for (int a = 0; a < 2; ++a) work += 0.5 * slip[a] * (VectorDot(&tangent[3 * a], old) + force[a]);
  return PetscMax(work, 0.0);
}

/*
   Returns the fraction of FrictionLateWork() that is added. It is 1 for a closed row. A row that opened is assumed to
   have slipped before, if it moved farther along the face than away from it. Its work is then limited by `ratio`, the
   sum of the bounds of the pair divided by that at the last state: other rows of the pair must carry the lost force.
*/
static PetscReal FrictionLatePart(PetscReal now, PetscReal gap, const PetscScalar s[2], PetscReal ratio)
{
  const PetscReal square = PetscSqr(PetscRealPart(s[0])) + PetscSqr(PetscRealPart(s[1]));

  if (now > 0.0) return 1.0;
  return gap * gap < square ? PetscMin(ratio, 1.0) : 0.0;
}

/* Computes the bounds of all rows [force], and for each pair their sum over that at the last state */
static PetscErrorCode FrictionGetBounds(const Measured *at, PetscReal time, const ContactSolution *sol,
  PetscReal bound[], PetscReal ratio[])
{
  ContactLinearization  lin = at->solved->linearization;
  const ContactHistory *m   = at->history;
  const PetscScalar    *z, *mass;
  PetscReal            *sums;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(2 * m->npairs, &sums));
  PetscCall(PetscArrayzero(bound, m->npairs * m->nowned));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    PetscReal now = 0.0;

    PetscCall(FrictionGetBound(at, time, r, PetscRealPart(mass[r]), PetscRealPart(z[r]), &now));
    if (now < PETSC_INFINITY) bound[ContactHistoryIndex(m, lin, r)] = now;
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  for (PetscInt k = 0; k < m->npairs * m->nowned; ++k) {
    sums[2 * (k / m->nowned)] += bound[k];
    sums[2 * (k / m->nowned) + 1] += m->bound[k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * m->npairs), MPIU_REAL, MPIU_SUM, at->comm));
  for (PetscInt p = 0; p < m->npairs; ++p) ratio[p] = sums[2 * p + 1] > 0.0 ? sums[2 * p] / sums[2 * p + 1] : 0.0;
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/*
   Returns the work that the mean of the friction forces at the two states would do along `shift`, the motion of a
   vertex that lost contact and sticks again at another place. This is not friction work, because no friction force
   acted while the vertex moved.
*/
static PetscReal FrictionShiftWork(const PetscReal shift[3], const PetscReal old[3], const PetscReal tangent[6],
  const PetscScalar f[2])
{
  PetscReal work = 0.5 * VectorDot(shift, old);

  for (int a = 0; a < 2; ++a) work += 0.5 * VectorDot(&tangent[3 * a], shift) * PetscRealPart(f[a]);
  return work;
}

/*
   Computes the parts of FrictionLateWork() that count, and the bounds of the friction forces. late, bound: [npairs x
   nowned] by vertex. Time integration has its own balance of energy: there `late` is zero.
*/
static PetscErrorCode FrictionGetLateWork(Model model, State state, PetscReal time, const ContactSolution *sol,
  PetscReal late[], PetscReal bound[])
{
  const Measured        at  = MeasuredAt(model, state, NULL);
  ContactLinearization  lin = state->solved->linearization;
  const ContactHistory *m   = state->history;
  const PetscScalar    *f, *s, *g;
  PetscReal            *ratio;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(m->npairs, &ratio));
  PetscCall(FrictionGetBounds(&at, time, sol, bound, ratio));
  PetscCall(PetscArrayzero(late, m->npairs * m->nowned));
  PetscCall(VecGetArrayRead(sol->shear, &f));
  PetscCall(VecGetArrayRead(sol->slip, &s));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  for (PetscInt r = 0; r < lin->nlocal && !ModelIsDynamic(model); ++r) {
    const PetscInt   k       = ContactHistoryIndex(m, lin, r);
    const PetscReal *tangent = &lin->tangent[6 * r], *old = &m->settled[3 * k];

    late[k] = FrictionLatePart(bound[k], PetscRealPart(g[r]), &s[2 * r], ratio[lin->pair[r]]) *
              FrictionLateWork(m->bound[k], bound[k], old, tangent, &f[2 * r], &s[2 * r]);
    late[k] += FrictionShiftWork(&m->shift[3 * k], old, tangent, &f[2 * r]);
  }
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(sol->slip, &s));
  PetscCall(VecRestoreArrayRead(sol->shear, &f));
  PetscCall(PetscFree(ratio));
  PetscFunctionReturn(0);
}

/*
   Computes for every pair and vertex the work of friction since the last state (work, [npairs x nowned]), and the
   bounds of the friction forces at u. Friction never gains energy. If the computed work of a pair is negative, it is
   set to zero. Causes are rounding errors, and rows that opened: the mean of the forces assumes that their forces act
   until the end. sums: [npairs] work of each pair on all ranks; *late: the part of the work that the mean of the forces
   at the two states omits, on all ranks; friction: [3 npairs x nowned] friction forces at u, or NULL.
*/
static PetscErrorCode FrictionGetWork(Model model, State state, PetscReal time, Vec u, const ContactSolution *sol,
  PetscReal work[], PetscReal bound[], PetscReal sums[], PetscReal friction[], PetscReal *late)
{
  const Measured        at     = MeasuredAt(model, state, NULL);
  const Bodies          bodies = ModelBodies(model);
  const ContactHistory *m      = state->history;
  const PetscScalar    *now;
  PetscReal            *mean, *all;
  Vec                   force, increment[2];

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &force));
  PetscCall(ArcsGetIncrements(&bodies, state->path->u, u, increment));
  PetscCall(PetscCalloc1(m->npairs + 1, &all));
  PetscCall(PetscMalloc1(m->nowned, &mean));
  PetscCall(FrictionGetLateWork(model, state, time, sol, work, bound));
  for (PetscInt p = 0; p < m->npairs; ++p) {
    PetscReal *of = &work[p * m->nowned];

    if (!SceneContactPairHasFriction(&model->scene->pairs[p])) {
      PetscCall(PetscArrayzero(of, m->nowned));
      continue;
    }
    PetscCall(FrictionPairWork(&at, increment, sol, p, force, mean));
    for (PetscInt v = 0; v < m->nowned; ++v) {
      all[m->npairs] += of[v];
      of[v] += mean[v];
      all[p] += of[v];
    }
    if (!friction) continue;
    PetscCall(VecGetArrayRead(force, &now));
    for (PetscInt i = 0; i < 3 * m->nowned; ++i) friction[3 * p * m->nowned + i] = PetscRealPart(now[i]);
    PetscCall(VecRestoreArrayRead(force, &now));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all, (PetscMPIInt)(m->npairs + 1), MPIU_REAL, MPIU_SUM, model->comm));
  *late = all[m->npairs];
  for (PetscInt p = 0; p < m->npairs; ++p) {
    sums[p] = all[p];
    if (all[p] >= 0.0 || ModelIsDynamic(model)) continue;
    sums[p] = 0.0;
    *late -= all[p];
    PetscCall(PetscArrayzero(&work[p * m->nowned], m->nowned));
  }
  PetscCall(PetscFree(mean));
  PetscCall(PetscFree(all));
  for (int k = 0; k < 2; ++k) PetscCall(VecDestroy(&increment[k]));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/*
   Computes for every pair the work of friction from the start to the solution `sol` at u, and the sum of the magnitudes
   of the friction forces. *late: see FrictionGetWork().
*/
PetscErrorCode FrictionMeasure(Model model, State state, PetscReal time, Vec u, const ContactSolution *sol,
  StepReport *report, PetscReal *late)
{
  const ContactHistory *m = state->history;
  PetscReal            *sums, *since, *work, *bound;

  PetscFunctionBegin;
  report->dissipated = *late = 0.0;
  if (!sol->shear) PetscFunctionReturn(0);
  PetscCall(PetscCalloc2(2 * m->npairs, &sums, m->npairs, &since));
  PetscCall(PetscMalloc2(m->npairs * m->nowned, &work, m->npairs * m->nowned, &bound));
  PetscCall(FrictionGetWork(model, state, time, u, sol, work, bound, since, NULL, late));
  for (PetscInt k = 0; k < m->npairs * m->nowned; ++k) sums[2 * (k / m->nowned)] += m->dissipated[k];
  PetscCall(FrictionAddSizes(state->solved->linearization, sol, sums));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * m->npairs), MPIU_REAL, MPIU_SUM, model->comm));
  for (PetscInt p = 0; p < m->npairs; ++p) {
    report->pairs[p].dissipated  = sums[2 * p] + since[p];
    report->pairs[p].shear_force = sums[2 * p + 1];
    report->dissipated += report->pairs[p].dissipated;
  }
  PetscCall(PetscFree2(work, bound));
  PetscCall(PetscFree2(sums, since));
  PetscFunctionReturn(0);
}

/* Adds the dissipation up to u to the history, and stores the friction forces and their bounds at u */
static PetscErrorCode FrictionSettleForces(Model model, State state, PetscReal time, Vec u, const ContactSolution *sol)
{
  ContactHistory *m = state->history;
  PetscReal      *sums, *work, *bound, late;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(m->npairs, &sums));
  PetscCall(PetscMalloc2(m->npairs * m->nowned, &work, m->npairs * m->nowned, &bound));
  PetscCall(FrictionGetWork(model, state, time, u, sol, work, bound, sums, m->friction, &late));
  PetscCall(PetscArraycpy(m->bound, bound, m->npairs * m->nowned));
  for (PetscInt k = 0; k < m->npairs * m->nowned; ++k) m->dissipated[k] += work[k];
  PetscCall(PetscFree2(work, bound));
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/*
   Makes the solution at u the new state of equilibrium: adds its dissipation and slip to the history. Later slip is
   relative to this state.
*/
PetscErrorCode FrictionSettle(Model model, State state, PetscReal time, Vec u, const ContactSolution *sol)
{
  ContactLinearization lin = state->solved->linearization;
  ContactHistory      *m   = state->history;
  const PetscScalar   *z, *s;

  PetscFunctionBegin;
  if (!sol->shear) PetscFunctionReturn(0);
  PetscCall(FrictionSettleForces(model, state, time, u, sol));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->slip, &s));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    if (PetscRealPart(z[r]) > 0.0)
      m->slip_path[ContactHistoryIndex(m, lin, r)] +=
        PetscSqrtReal(PetscSqr(PetscRealPart(s[2 * r])) + PetscSqr(PetscRealPart(s[2 * r + 1])));
  }
  PetscCall(VecRestoreArrayRead(sol->slip, &s));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscCall(PetscArraycpy(m->settled, m->shear, 3 * m->npairs * m->nowned));
  PetscFunctionReturn(0);
}

/* After a restart, sets the friction forces of the last solve to those of the checkpoint */
PetscErrorCode FrictionRecall(ContactHistory *history)
{
  ContactHistory *m = history;

  PetscFunctionBegin;
  if (m->settled) PetscCall(PetscArraycpy(m->shear, m->settled, 3 * m->npairs * m->nowned));
  PetscFunctionReturn(0);
}

/*
   Adds A^T rows, the forces at the vertices of the rows of a pair, to `force`. A: a matrix of the linearization, with
   one or two rows per contact row; rows: forces, NULL if there are none; pair: PETSC_DECIDE for all pairs
*/
PetscErrorCode RowsAddForces(ContactLinearization lin, Mat A, Vec rows, PetscInt pair, Vec force)
{
  PetscScalar *f;
  PetscInt     n, each;
  Vec          own;

  PetscFunctionBegin;
  if (!rows) PetscFunctionReturn(0);
  if (pair == PETSC_DECIDE) {
    PetscCall(MatMultTransposeAdd(A, rows, force, force));
    PetscFunctionReturn(0);
  }
  PetscCall(VecDuplicate(rows, &own));
  PetscCall(VecCopy(rows, own));
  PetscCall(VecGetLocalSize(own, &n));
  PetscCall(VecGetArray(own, &f));
  each = n / PetscMax(1, lin->nlocal);
  for (PetscInt i = 0; i < n; ++i) {
    if (lin->pair[i / each] != pair) f[i] = 0.0;
  }
  PetscCall(VecRestoreArray(own, &f));
  PetscCall(MatMultTransposeAdd(A, own, force, force));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(0);
}

/* Computes the contact forces of a solution: weighted = mass x pressure of the rows, and force = J^T weighted plus
   friction at the vertices */
PetscErrorCode RowsGetForces(ContactLinearization lin, const ContactSolution *sol, Vec weighted, Vec force)
{
  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(weighted, sol->pressure, lin->mass));
  PetscCall(MatMultTranspose(lin->J, weighted, force));
  PetscCall(RowsAddForces(lin, lin->slip, sol->shear, PETSC_DECIDE, force));
  PetscFunctionReturn(0);
}
