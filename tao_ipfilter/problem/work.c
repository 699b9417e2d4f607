/* Work vectors, which are created at their first use. A function gets one and restores it before it returns. */
#include "problemimpl.h"
#include "tao_ipfilter/solver/work.h"

static Vec WorkLayout(const TAO_IPFILTER *ip, IPSpace space)
{
  return space == IP_UNKNOWNS ? ip->rx : (space == IP_INEQUALITIES ? ip->at.c : ip->at.ce);
}

/*
   Gets a work vector of the given layout, with arbitrary entries; NULL if the problem has no constraints of that kind
*/
PetscErrorCode IPGetWork(Tao tao, IPSpace space, Vec *v)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  IPWork       *work   = ip->work;
  Vec           layout = WorkLayout(ip, space);
  PetscInt      k      = 0;

  PetscFunctionBegin;
  *v = NULL;
  if (!layout) PetscFunctionReturn(0);
  while (k < IP_MAX_WORK && work->lent[space][k]) k++;
  PetscCheck(k < IP_MAX_WORK, PetscObjectComm((PetscObject)tao), PETSC_ERR_PLIB, "All %d work vectors are in use",
    IP_MAX_WORK);
  if (!work->v[space][k]) PetscCall(VecDuplicate(layout, &work->v[space][k]));
  work->lent[space][k] = PETSC_TRUE;
  *v                   = work->v[space][k];
  PetscFunctionReturn(0);
}

PetscErrorCode IPRestoreWork(Tao tao, IPSpace space, Vec *v)
{
  IPWork  *work = ((TAO_IPFILTER *)tao->data)->work;
  PetscInt k    = 0;

  PetscFunctionBegin;
  if (!*v) PetscFunctionReturn(0);
  while (k < IP_MAX_WORK && work->v[space][k] != *v) k++;
  PetscCheck(k < IP_MAX_WORK && work->lent[space][k], PetscObjectComm((PetscObject)tao), PETSC_ERR_PLIB,
    "The vector is not a work vector in use");
  work->lent[space][k] = PETSC_FALSE;
  *v                   = NULL;
  PetscFunctionReturn(0);
}

/* Frees the work vectors that are not in use */
PetscErrorCode IPWorkTrim(IPWork *work)
{
  PetscFunctionBegin;
  for (PetscInt space = 0; space < IP_NSPACES; space++) {
    for (PetscInt k = 0; k < IP_MAX_WORK; k++) {
      if (!work->lent[space][k]) PetscCall(VecDestroy(&work->v[space][k]));
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode IPWorkDestroy(IPWork *work)
{
  PetscFunctionBegin;
  for (PetscInt space = 0; space < IP_NSPACES; space++) PetscCall(PetscArrayzero(work->lent[space], IP_MAX_WORK));
  PetscCall(IPWorkTrim(work));
  PetscFunctionReturn(0);
}
