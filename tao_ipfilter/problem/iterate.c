/* Creates, copies and destroys iterates and directions */
#include "problemimpl.h"

static PetscErrorCode DuplicateUnlessNull(Vec layout, Vec *v)
{
  PetscFunctionBegin;
  if (!layout) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(layout, v));
  PetscCall(VecSet(*v, 0.0));
  PetscFunctionReturn(0);
}

/*
   Creates the point and the constraint values of an iterate, with the layouts x, c and ce. A vector whose layout is
   NULL is not created. The caller creates slacks and multipliers.
*/
PetscErrorCode IPIterateCreate(Vec x, Vec c, Vec ce, IPIterate *it)
{
  PetscFunctionBegin;
  PetscCall(DuplicateUnlessNull(x, &it->x));
  PetscCall(DuplicateUnlessNull(c, &it->c));
  PetscCall(DuplicateUnlessNull(ce, &it->ce));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReferenceInto(Vec from, Vec *to)
{
  PetscFunctionBegin;
  if (from) PetscCall(PetscObjectReference((PetscObject)from));
  PetscCall(VecDestroy(to));
  *to = from;
  PetscFunctionReturn(0);
}

/*
   Makes the current iterate refer to the caller's solution vector and to the pairs' vectors of slacks and multipliers.
   Must be called whenever one of these may have been created anew. The best iterate gets the same set of vectors.
*/
PetscErrorCode IPIterateBind(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPIterate    *best = &ip->best;

  PetscFunctionBegin;
  PetscCall(ReferenceInto(tao->solution, &ip->at.x));
  PetscCall(ReferenceInto(ip->pair[IP_SLACK].t, &ip->at.s));
  PetscCall(ReferenceInto(ip->pair[IP_SLACK].trial, &ip->trial.s));
  if (!best->s) PetscCall(DuplicateUnlessNull(ip->at.s, &best->s));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscCall(ReferenceInto(ip->pair[b].z, &ip->at.z[b]));
    if (!ip->at.z[b]) PetscCall(VecDestroy(&best->z[b]));
    else if (!best->z[b]) PetscCall(DuplicateUnlessNull(ip->at.z[b], &best->z[b]));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyUnlessNull(Vec from, Vec to)
{
  PetscFunctionBegin;
  if (from && to) PetscCall(VecCopy(from, to));
  PetscFunctionReturn(0);
}

/* Copies the point and the function values there */
PetscErrorCode IPIterateCopyPoint(const IPIterate *from, IPIterate *to)
{
  PetscFunctionBegin;
  PetscCall(CopyUnlessNull(from->x, to->x));
  PetscCall(CopyUnlessNull(from->c, to->c));
  PetscCall(CopyUnlessNull(from->ce, to->ce));
  to->f = from->f;
  PetscFunctionReturn(0);
}

/* Copies all vectors that both iterates have */
PetscErrorCode IPIterateCopy(const IPIterate *from, IPIterate *to)
{
  PetscFunctionBegin;
  PetscCall(IPIterateCopyPoint(from, to));
  PetscCall(CopyUnlessNull(from->s, to->s));
  PetscCall(CopyUnlessNull(from->lambda, to->lambda));
  PetscCall(CopyUnlessNull(from->y, to->y));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(CopyUnlessNull(from->z[b], to->z[b]));
  PetscFunctionReturn(0);
}

PetscErrorCode IPIterateDestroy(IPIterate *it)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&it->x));
  PetscCall(VecDestroy(&it->c));
  PetscCall(VecDestroy(&it->ce));
  PetscCall(VecDestroy(&it->s));
  PetscCall(VecDestroy(&it->lambda));
  PetscCall(VecDestroy(&it->y));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(VecDestroy(&it->z[b]));
  PetscFunctionReturn(0);
}

PetscErrorCode IPDirectionCreate(Vec x, Vec c, Vec ce, IPDirection *d)
{
  PetscFunctionBegin;
  PetscCall(DuplicateUnlessNull(x, &d->x));
  PetscCall(DuplicateUnlessNull(c, &d->lambda));
  PetscCall(DuplicateUnlessNull(ce, &d->y));
  PetscFunctionReturn(0);
}

/* Copies all vectors that both directions have */
PetscErrorCode IPDirectionCopy(const IPDirection *from, IPDirection *to)
{
  PetscFunctionBegin;
  PetscCall(CopyUnlessNull(from->x, to->x));
  PetscCall(CopyUnlessNull(from->lambda, to->lambda));
  PetscCall(CopyUnlessNull(from->y, to->y));
  to->norm = from->norm;
  PetscFunctionReturn(0);
}

PetscErrorCode IPDirectionDestroy(IPDirection *d)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&d->x));
  PetscCall(VecDestroy(&d->lambda));
  PetscCall(VecDestroy(&d->y));
  PetscFunctionReturn(0);
}
