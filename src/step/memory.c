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

PetscErrorCode ContactMemoryDestroy(ContactMemory *m)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(m->pressure, m->slack));
  PetscFunctionReturn(0);
}
