/*
   Stores contact pressure, slack and friction force of each nonmortar vertex from one load step to the next. The start
   of the next solve uses these values.
*/
#include "stateimpl.h"
#include "src/state/contact_history.h"

static const PetscReal negligible_pressure = 1e-3; /* a row is under pressure if its pressure is above this fraction
                                                      of the largest pressure */
static const PetscReal open_share          = 1e-3; /* A row is open if its force is below this fraction of (stiffness
                                                      x slack). Such a force comes from the barrier term alone. */

PetscErrorCode ContactHistoryCreate(DM dm, Scene scene, ContactHistory *m)
{
  const PetscInt npairs = scene->npairs;
  PetscInt       last;
  Vec            u;

  PetscFunctionBegin;
  m->npairs = npairs;
  PetscCall(DMGetGlobalSection(dm, &m->global));
  PetscCall(DMGetGlobalVector(dm, &u));
  PetscCall(VecGetOwnershipRange(u, &m->first, &last));
  PetscCall(DMRestoreGlobalVector(dm, &u));
  m->nowned = (last - m->first) / 3;
  PetscCall(PetscCalloc5(npairs * m->nowned, &m->pressure, npairs * m->nowned, &m->slack, npairs * m->nowned, &m->yield,
    npairs * m->nowned, &m->open, npairs * m->nowned, &m->released));
  for (PetscInt p = 0; p < npairs; ++p)
    m->frictional = (PetscBool)(m->frictional || SceneContactPairHasFriction(&scene->pairs[p]));
  if (m->frictional)
    PetscCall(PetscCalloc7(3 * npairs * m->nowned, &m->shear, 3 * npairs * m->nowned, &m->shift, 3 * npairs * m->nowned,
      &m->settled, 3 * npairs * m->nowned, &m->friction, npairs * m->nowned, &m->bound, npairs * m->nowned,
      &m->slip_path, npairs * m->nowned, &m->dissipated));
  PetscFunctionReturn(0);
}

/* Returns the index at which the history stores the values of a row. This rank owns the vertex of the row. */
PetscInt ContactHistoryIndex(const ContactHistory *m, ContactLinearization lin, PetscInt row)
{
  PetscInt offset = m->first;

  (void)PetscSectionGetOffset(m->global, lin->vertex[row], &offset);
  return lin->pair[row] * m->nowned + (offset - m->first) / 3;
}

/*
   Stores the pressures and slacks of a solve by vertex. slack: slacks of the rows of lin [length]; stiffness: stiffness
   of the bodies [force/length].
*/
PetscErrorCode ContactHistoryStore(ContactHistory *m, ContactLinearization lin, const ContactSolution *sol, Vec slack,
  PetscReal stiffness)
{
  const PetscScalar *z, *s, *mass, *yield = NULL;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(m->pressure, m->npairs * m->nowned));
  PetscCall(PetscArrayzero(m->yield, m->npairs * m->nowned));
  PetscCall(PetscArrayzero(m->open, m->npairs * m->nowned));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(slack, &s));
  if (sol->yield) PetscCall(VecGetArrayRead(sol->yield, &yield));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    const PetscInt k = ContactHistoryIndex(m, lin, i);

    m->pressure[k] = PetscRealPart(z[i]);
    m->slack[k]    = PetscRealPart(s[i]);
    m->yield[k]    = yield ? PetscRealPart(yield[i]) : 0.0;
    m->open[k]     = (PetscBool)(m->pressure[k] * PetscRealPart(mass[i]) <= open_share * stiffness * m->slack[k]);
  }
  if (sol->yield) PetscCall(VecRestoreArrayRead(sol->yield, &yield));
  PetscCall(VecRestoreArrayRead(slack, &s));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscFunctionReturn(0);
}

/*
   Sets start values for the rows of a new linearization: the stored slacks, and the stored pressures times `scale`. A
   vertex without a stored row gets zeros, which the optimizer moves off the boundary. *any: true if a pressure is
   stored on any rank.
*/
PetscErrorCode ContactHistoryRecall(const ContactHistory *m, ContactLinearization lin, PetscReal scale, Vec slack,
  Vec pressure, PetscBool *any)
{
  PetscScalar *z, *s;
  PetscBool    found = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(pressure, &z));
  PetscCall(VecGetArrayWrite(slack, &s));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    const PetscInt k = ContactHistoryIndex(m, lin, i);

    z[i] = scale * m->pressure[k];
    s[i] = m->pressure[k] > 0.0 ? PetscMax(m->slack[k], 0.0) : 0.0;
    if (m->pressure[k] > 0.0) found = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayWrite(slack, &s));
  PetscCall(VecRestoreArrayWrite(pressure, &z));
  PetscCallMPI(MPI_Allreduce(&found, any, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)pressure)));
  PetscFunctionReturn(0);
}

/* Returns the stored pressure at index k; 0 if the row was open. */
static PetscReal ContactHistoryPressure(const ContactHistory *m, PetscInt k)
{
  return m->open[k] ? 0.0 : m->pressure[k];
}

/* Collective. Counts vertices under pressure */
PetscErrorCode ContactHistoryCountClosed(const ContactHistory *m, MPI_Comm comm, PetscInt *n)
{
  PetscFunctionBegin;
  *n = 0;
  for (PetscInt k = 0; k < m->npairs * m->nowned; ++k) *n += ContactHistoryPressure(m, k) > 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 1, MPIU_INT, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactHistoryLargest(const ContactHistory *m, MPI_Comm comm, PetscReal *largest)
{
  PetscFunctionBegin;
  *largest = 0.0;
  for (PetscInt k = 0; k < m->npairs * m->nowned; ++k) *largest = PetscMax(*largest, ContactHistoryPressure(m, k));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscFunctionReturn(0);
}

/*
   Measures how much the gap changed since the last solve. *change: the maximum over the rows of lin on all ranks
   [length]. A row under pressure counts with |gap + yield - slack|, where yield and slack are those of the vertex. Any
   other row counts with -(gap + yield), because open gaps do not matter.
*/
PetscErrorCode ContactHistoryChange(const ContactHistory *m, ContactLinearization lin, PetscReal *change)
{
  const PetscScalar *g;
  PetscReal          largest, worst = 0.0;
  MPI_Comm           comm = PetscObjectComm((PetscObject)lin->g);

  PetscFunctionBegin;
  PetscCall(ContactHistoryLargest(m, comm, &largest));
  PetscCall(VecGetArrayRead(lin->g, &g));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    const PetscInt  k   = ContactHistoryIndex(m, lin, i);
    const PetscReal gap = PetscRealPart(g[i]) + m->yield[k];

    worst = PetscMax(worst,
      ContactHistoryPressure(m, k) > negligible_pressure * largest ? PetscAbsReal(gap - m->slack[k]) : -gap);
  }
  PetscCall(VecRestoreArrayRead(lin->g, &g));
  PetscCallMPI(MPI_Allreduce(&worst, change, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscFunctionReturn(0);
}

/*
   Relates the rows of the last solve to the rows of a new linearization. (*row)[r]: row of lin that belongs to the
   vertex of row r of `solved`; PETSC_DECIDE if row r was not under pressure or lin has no row at this vertex. The
   caller frees *row.
*/
PetscErrorCode ContactHistoryFollowRows(const ContactHistory *m, ContactLinearization solved, ContactLinearization lin,
  PetscInt **row)
{
  PetscReal largest;
  PetscInt *place;

  PetscFunctionBegin;
  PetscCall(ContactHistoryLargest(m, PetscObjectComm((PetscObject)lin->g), &largest));
  PetscCall(PetscCalloc1(m->npairs * m->nowned, &place));
  PetscCall(PetscMalloc1(solved->nlocal, row));
  for (PetscInt r = 0; r < lin->nlocal; ++r) place[ContactHistoryIndex(m, lin, r)] = r + 1;
  for (PetscInt r = 0; r < solved->nlocal; ++r) {
    const PetscInt k = ContactHistoryIndex(m, solved, r);

    (*row)[r] = ContactHistoryPressure(m, k) > negligible_pressure * largest && place[k] ? place[k] - 1 : PETSC_DECIDE;
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

/*
   Finds the vertices that were under pressure in the last solve and have no row in lin. *lost: [npairs x nowned] true
   for these vertices, freed by the caller; *nlost: their number on all ranks.
*/
PetscErrorCode ContactHistoryFindLostRows(const ContactHistory *m, ContactLinearization lin, PetscBool **lost,
  PetscInt *nlost)
{
  const PetscInt n    = m->npairs * m->nowned;
  const MPI_Comm comm = PetscObjectComm((PetscObject)lin->g);
  PetscReal      largest;

  PetscFunctionBegin;
  *nlost = 0;
  PetscCall(ContactHistoryLargest(m, comm, &largest));
  PetscCall(PetscMalloc1(n, lost));
  for (PetscInt k = 0; k < n; ++k)
    (*lost)[k] = (PetscBool)(ContactHistoryPressure(m, k) > negligible_pressure * largest);
  for (PetscInt i = 0; i < lin->nlocal; ++i) (*lost)[ContactHistoryIndex(m, lin, i)] = PETSC_FALSE;
  for (PetscInt k = 0; k < n; ++k) *nlost += (*lost)[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, nlost, 1, MPIU_INT, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/*
   Finds the smallest gap of lost vertices in a linearization with a larger search depth. *least: this gap if it is
   negative, otherwise 0; 0 also if the lost vertices have no row in lin [length].
*/
PetscErrorCode ContactHistoryLeastGap(const ContactHistory *m, const PetscBool lost[], ContactLinearization lin,
  PetscReal *least)
{
  const PetscScalar *g;

  PetscFunctionBegin;
  *least = 0.0;
  PetscCall(VecGetArrayRead(lin->g, &g));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    if (lost[ContactHistoryIndex(m, lin, i)]) *least = PetscMin(*least, PetscRealPart(g[i]));
  }
  PetscCall(VecRestoreArrayRead(lin->g, &g));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, least, 1, MPIU_REAL, MPIU_MIN, PetscObjectComm((PetscObject)lin->g)));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactHistoryDestroy(ContactHistory *m)
{
  PetscFunctionBegin;
  PetscCall(PetscFree5(m->pressure, m->slack, m->yield, m->open, m->released));
  PetscCall(PetscFree7(m->shear, m->shift, m->settled, m->friction, m->bound, m->slip_path, m->dissipated));
  PetscFunctionReturn(0);
}
