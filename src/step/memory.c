/* Contact pressure and slack by nonmortar vertex, carried from one load step to the next. */
#include "stepimpl.h"

PetscErrorCode ContactMemoryCreate(DM dm, PetscInt npairs, ContactMemory *m)
{
  PetscFunctionBegin;
  m->npairs = npairs;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &m->vstart, &m->vend));
  PetscCall(PetscCalloc2(npairs * (m->vend - m->vstart), &m->pressure, npairs * (m->vend - m->vstart), &m->slack));
  PetscFunctionReturn(0);
}

static PetscInt ContactMemoryIndex(const ContactMemory *m, ContactLinearization lin, PetscInt row)
{
  return lin->pair[row] * (m->vend - m->vstart) + lin->vertex[row] - m->vstart;
}

PetscErrorCode ContactMemoryStore(ContactMemory *m, ContactLinearization lin, const ContactSolution *sol, Vec slack)
{
  const PetscScalar *z, *s;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(m->pressure, m->npairs * (m->vend - m->vstart)));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(slack, &s));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    m->pressure[ContactMemoryIndex(m, lin, i)] = PetscRealPart(z[i]);
    m->slack[ContactMemoryIndex(m, lin, i)]    = PetscRealPart(s[i]);
  }
  PetscCall(VecRestoreArrayRead(slack, &s));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscFunctionReturn(0);
}

/*
   Start values for the rows of a new linearization: pressures scaled by the growth of the load. A vertex that had no
   row gets zeros, which the optimizer moves off the boundary. `any` is false when nothing is remembered on any rank.
*/
PetscErrorCode ContactMemoryRecall(const ContactMemory *m, ContactLinearization lin, PetscReal scale, Vec slack, Vec pressure, PetscBool *any)
{
  PetscScalar *z, *s;
  PetscBool    found = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(pressure, &z));
  PetscCall(VecGetArrayWrite(slack, &s));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    const PetscInt k = ContactMemoryIndex(m, lin, i);

    z[i] = scale * m->pressure[k];
    s[i] = m->pressure[k] > 0.0 ? m->slack[k] : 0.0;
    if (m->pressure[k] > 0.0) found = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayWrite(slack, &s));
  PetscCall(VecRestoreArrayWrite(pressure, &z));
  PetscCall(MPIU_Allreduce(&found, any, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)pressure)));
  PetscFunctionReturn(0);
}

/*
   How far the gap of a new linearization is from the slack remembered at the same vertex: over the rows under pressure, and
   as penetration over the others, whose open gap does not matter.
*/
PetscErrorCode ContactMemoryChange(const ContactMemory *m, ContactLinearization lin, PetscReal *change)
{
  const PetscReal    negligible = 1e-3; /* of the largest pressure */
  const PetscScalar *g;
  PetscReal          largest = 0.0, worst = 0.0;
  MPI_Comm           comm = PetscObjectComm((PetscObject)lin->g);

  PetscFunctionBegin;
  for (PetscInt i = 0; i < lin->nlocal; ++i) largest = PetscMax(largest, m->pressure[ContactMemoryIndex(m, lin, i)]);
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscCall(VecGetArrayRead(lin->g, &g));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    const PetscInt  k   = ContactMemoryIndex(m, lin, i);
    const PetscReal gap = PetscRealPart(g[i]);

    worst = PetscMax(worst, m->pressure[k] > negligible * largest ? PetscAbsReal(gap - m->slack[k]) : -gap);
  }
  PetscCall(VecRestoreArrayRead(lin->g, &g));
  PetscCall(MPIU_Allreduce(&worst, change, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactMemoryDestroy(ContactMemory *m)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(m->pressure, m->slack));
  PetscFunctionReturn(0);
}
