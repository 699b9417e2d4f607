/* What friction dissipates, where it holds and where it slips. */
#include "src/step/stepimpl.h"

/* Work on the slip of a row, by the mean of the forces before and after */
static PetscReal FrictionRowWork(const ContactHistory *m, ContactLinearization lin, PetscInt row,
  const PetscScalar force[2], const PetscScalar slip[2])
{
  const PetscReal *before = &m->settled[3 * ContactHistoryIndex(m, lin, row)];
  PetscReal        work   = 0.0;

  for (PetscInt a = 0; a < 2; ++a) {
    const PetscReal *t = &lin->tangent[6 * row + 3 * a];

    work -=
      0.5 * (t[0] * before[0] + t[1] * before[1] + t[2] * before[2] + PetscRealPart(force[a])) * PetscRealPart(slip[a]);
  }
  return work;
}

/* Of every pair: the work since the start, if `sol` stands, and the sum of the sizes of the forces: of a row that is
   covered in part, that part */
PetscErrorCode FrictionMeasure(Simulation sim, const ContactSolution *sol, StepReport *report)
{
  ContactLinearization  lin = sim->linearization;
  const ContactHistory *m   = &sim->history;
  const PetscScalar    *f, *s, *mass;
  PetscReal            *sums;

  PetscFunctionBegin;
  report->dissipated = 0.0;
  if (!sol->shear) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(2 * m->npairs, &sums));
  for (PetscInt p = 0; p < m->npairs; ++p) {
    for (PetscInt v = 0; v < m->nowned; ++v) sums[2 * p] += m->dissipated[p * m->nowned + v];
  }
  PetscCall(VecGetArrayRead(sol->shear, &f));
  PetscCall(VecGetArrayRead(sol->slip, &s));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    sums[2 * lin->pair[r]] += FrictionRowWork(m, lin, r, f + 2 * r, s + 2 * r);
    sums[2 * lin->pair[r] + 1] +=
      PetscSqrtReal(PetscSqr(PetscRealPart(f[2 * r])) + PetscSqr(PetscRealPart(f[2 * r + 1]))) * lin->covered[r] /
      PetscRealPart(mass[r]);
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecRestoreArrayRead(sol->slip, &s));
  PetscCall(VecRestoreArrayRead(sol->shear, &f));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * m->npairs), MPIU_REAL, MPIU_SUM, sim->comm));
  for (PetscInt p = 0; p < m->npairs; ++p) {
    report->pairs[p].dissipated  = sums[2 * p];
    report->pairs[p].shear_force = sums[2 * p + 1];
    report->dissipated += sums[2 * p];
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/* The solution is the new state of equilibrium: what was dissipated and slipped on the way to it counts, and the next
   slip begins there */
PetscErrorCode FrictionSettle(Simulation sim, const ContactSolution *sol)
{
  ContactLinearization lin = sim->linearization;
  ContactHistory      *m   = &sim->history;
  const PetscScalar   *f, *s;

  PetscFunctionBegin;
  PetscCall(PetscFree2(sim->shear, sim->slip));
  if (!sol->shear) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(2 * lin->nlocal, &sim->shear, 2 * lin->nlocal, &sim->slip));
  PetscCall(VecGetArrayRead(sol->shear, &f));
  PetscCall(VecGetArrayRead(sol->slip, &s));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    m->dissipated[ContactHistoryIndex(m, lin, r)] += FrictionRowWork(m, lin, r, f + 2 * r, s + 2 * r);
    if (sim->pressure[r] > 0.0)
      m->slip_path[ContactHistoryIndex(m, lin, r)] +=
        PetscSqrtReal(PetscSqr(PetscRealPart(s[2 * r])) + PetscSqr(PetscRealPart(s[2 * r + 1])));
    for (PetscInt a = 0; a < 2; ++a) {
      sim->shear[2 * r + a] = PetscRealPart(f[2 * r + a]);
      sim->slip[2 * r + a]  = PetscRealPart(s[2 * r + a]);
    }
  }
  PetscCall(VecRestoreArrayRead(sol->slip, &s));
  PetscCall(VecRestoreArrayRead(sol->shear, &f));
  PetscCall(PetscArraycpy(m->settled, m->shear, 3 * m->npairs * m->nowned));
  PetscFunctionReturn(0);
}

/* After the state has been put back: the forces of the last solve are those of the state */
PetscErrorCode FrictionRecall(Simulation sim)
{
  ContactHistory *m = &sim->history;

  PetscFunctionBegin;
  if (m->settled) PetscCall(PetscArraycpy(m->shear, m->settled, 3 * m->npairs * m->nowned));
  PetscFunctionReturn(0);
}
