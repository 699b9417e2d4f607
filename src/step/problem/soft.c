/*
   Laws of soft contact pairs: the pressure as a function of the depth of penetration.
     linear:       p = K y for y >= 0
     exponential:  p = p0 exp(b y), b = ln(100) / c0, for pressures of at least p1 = p0 / 100; smaller pressures follow
                   the tangent at p1, which is zero at the depth -(c0 + 1 / b)
   A solve has the tangent of the law at a pressure q of each row. Each contact update moves q: if the last solve found
   the row under pressure, q is this pressure; otherwise it follows from the gap.
   A row of which the mortar face covers a share a has the gap of this part times a, and its force on the bodies is a
   times its multiplier. So the depth of the row is a y.
*/
#include "problemimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include <math.h>

static PetscReal SoftRate(const SceneContactPair *pair)
{
  return log(100.0) / pair->exponential[0];
}

static PetscReal SoftLeast(const SceneContactPair *pair)
{
  return pair->exponential[1] / 100.0;
}

/* Returns the depth at a pressure of the exponential law */
static PetscReal SoftDepth(const SceneContactPair *pair, PetscReal p)
{
  const PetscReal b = SoftRate(pair), least = SoftLeast(pair);

  return p > least ? log(p / pair->exponential[1]) / b : (p / least - 1.0) / b - pair->exponential[0];
}

/* Returns the pressure at a depth, but at most `largest` */
static PetscReal SoftPressure(const SceneContactPair *pair, PetscReal y, PetscReal largest)
{
  const PetscReal least = SoftLeast(pair), tail = least * (1.0 + SoftRate(pair) * (y + pair->exponential[0]));

  if (y <= -pair->exponential[0]) return PetscMax(tail, 0.0);
  return y < SoftDepth(pair, largest) ? pair->exponential[1] * exp(SoftRate(pair) * y) : largest;
}

/* Returns the pressure at which the law of a row is linearized */
static PetscReal SoftGetPoint(const ContactHistory *m, const SceneContactPair *pair, PetscInt k, PetscReal cover)
{
  const PetscReal least = SoftLeast(pair), pressure = m->open[k] ? 0.0 : m->pressure[k];

  if (pressure > 0.0 || !(cover > 0.0)) return PetscMax(pressure, least);
  return PetscMax(SoftPressure(pair, (m->yield[k] - m->slack[k]) / cover, PETSC_INFINITY), least);
}

/*
   Sets compliance and depth of the rows of a pair: depth + compliance x pressure is the tangent of its law. cover:
   share of each row that the mortar face covers
*/
static PetscErrorCode SoftSetRows(StepProblem *p, ContactLinearization lin, PetscInt k, const PetscReal cover[])
{
  const SceneContactPair *pair = &p->model->scene->pairs[k];
  const ContactHistory   *m    = p->state->history;
  PetscScalar            *a, *y, *covered;

  PetscFunctionBegin;
  PetscCall(VecGetArray(p->soft.compliance, &a));
  PetscCall(VecGetArray(p->soft.depth, &y));
  PetscCall(VecGetArray(p->soft.cover, &covered));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    if (lin->pair[r] != k) continue;
    covered[r] = cover[r];
    if (pair->stiffness > 0.0) a[r] = cover[r] / pair->stiffness;
    else {
      const PetscReal q = SoftGetPoint(m, pair, ContactHistoryIndex(m, lin, r), cover[r]);

      a[r] = cover[r] / (SoftRate(pair) * q);
      y[r] = cover[r] * (SoftDepth(pair, q) - 1.0 / SoftRate(pair));
    }
  }
  PetscCall(VecRestoreArray(p->soft.cover, &covered));
  PetscCall(VecRestoreArray(p->soft.depth, &y));
  PetscCall(VecRestoreArray(p->soft.compliance, &a));
  PetscFunctionReturn(0);
}

/* Sets p->soft for the rows of a linearization */
PetscErrorCode SoftSetUp(StepProblem *p, ContactLinearization lin)
{
  PetscReal *cover;

  PetscFunctionBegin;
  PetscCall(SoftDestroy(&p->soft));
  PetscCall(PetscMalloc1(lin->nlocal, &cover));
  for (PetscInt k = 0; k < p->model->scene->npairs; ++k) {
    if (!SceneContactPairIsSoft(&p->model->scene->pairs[k])) continue;
    if (!p->soft.compliance) {
      PetscCall(VecDuplicate(lin->g, &p->soft.compliance));
      PetscCall(VecZeroEntries(p->soft.compliance));
      PetscCall(VecDuplicate(p->soft.compliance, &p->soft.depth));
      PetscCall(VecZeroEntries(p->soft.depth));
      PetscCall(VecDuplicate(p->soft.compliance, &p->soft.cover));
      PetscCall(VecZeroEntries(p->soft.cover));
    }
    PetscCall(InterferenceGetCover(p->model, p->base, k, lin, cover));
    PetscCall(SoftSetRows(p, lin, k, cover));
  }
  PetscCall(PetscFree(cover));
  PetscFunctionReturn(0);
}

/* Returns the energy that a row stores per force [length], for its pressure and the depth by which it yields */
static PetscReal SoftEnergy(const SceneContactPair *pair, PetscReal pressure, PetscReal yield, PetscReal cover)
{
  const PetscReal least = SoftLeast(pair);

  if (pair->stiffness > 0.0) return 0.5 * yield;
  return cover / SoftRate(pair) * (pressure > least ? 1.0 - 0.5 * least / pressure : 0.5 * pressure / least);
}

/*
   Sets the depth by which the rows of a solution yield, and the energy that they store. On entry sol->gap contains the
   depth of the tangents, on exit it is the gap.
*/
PetscErrorCode SoftKeep(StepProblem *p, ContactLinearization lin, ContactSolution *sol)
{
  const PetscScalar *z, *y, *cover;
  PetscScalar       *stored;

  PetscFunctionBegin;
  if (!p->soft.compliance) PetscFunctionReturn(0);
  PetscCall(VecAXPY(sol->gap, -1.0, p->soft.depth));
  PetscCall(VecDuplicate(sol->pressure, &sol->yield));
  PetscCall(VecPointwiseMult(sol->yield, sol->pressure, p->soft.compliance));
  PetscCall(VecAXPY(sol->yield, 1.0, p->soft.depth));
  PetscCall(VecDuplicate(sol->pressure, &sol->stored));
  PetscCall(VecZeroEntries(sol->stored));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->yield, &y));
  PetscCall(VecGetArrayRead(p->soft.cover, &cover));
  PetscCall(VecGetArray(sol->stored, &stored));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    const SceneContactPair *pair = &p->model->scene->pairs[lin->pair[r]];

    if (SceneContactPairIsSoft(pair))
      stored[r] = SoftEnergy(pair, PetscRealPart(z[r]), PetscRealPart(y[r]), PetscRealPart(cover[r]));
  }
  PetscCall(VecRestoreArray(sol->stored, &stored));
  PetscCall(VecRestoreArrayRead(p->soft.cover, &cover));
  PetscCall(VecRestoreArrayRead(sol->yield, &y));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscFunctionReturn(0);
}

/*
   Measures how far the tangents are from the exponential laws at the solution. *error: largest difference between the
   depth of a row and that of its pressure, weighted by the pressure relative to the largest one [length]
*/
PetscErrorCode SoftMeasureError(StepProblem *p, ContactLinearization lin, const ContactSolution *sol, PetscReal *error)
{
  const PetscScalar *z, *g, *cover;
  PetscReal          largest = 0.0, worst = 0.0;

  PetscFunctionBegin;
  *error = 0.0;
  if (!p->soft.compliance) PetscFunctionReturn(0);
  PetscCall(VecMax(sol->pressure, NULL, &largest));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  PetscCall(VecGetArrayRead(p->soft.cover, &cover));
  for (PetscInt r = 0; largest > 0.0 && r < lin->nlocal; ++r) {
    const SceneContactPair *pair     = &p->model->scene->pairs[lin->pair[r]];
    const PetscReal         pressure = PetscRealPart(z[r]), share = PetscRealPart(cover[r]);
    PetscReal               depth, law;

    if (!(pair->exponential[1] > 0.0) || !(share > 0.0)) continue;
    depth = PetscMax(-PetscRealPart(g[r]) / share, SoftDepth(pair, 0.0));
    law   = SoftPressure(pair, depth, largest);
    worst = PetscMax(worst,
      share * PetscAbsReal(depth - SoftDepth(pair, PetscMax(pressure, 0.0))) * PetscMax(law, pressure) / largest);
  }
  PetscCall(VecRestoreArrayRead(p->soft.cover, &cover));
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscCallMPI(MPI_Allreduce(&worst, error, 1, MPIU_REAL, MPIU_MAX, p->model->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SoftDestroy(SoftRows *soft)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&soft->compliance));
  PetscCall(VecDestroy(&soft->depth));
  PetscCall(VecDestroy(&soft->cover));
  PetscFunctionReturn(0);
}
