/* Stamps of matrices, which tell whether data computed from a matrix can be reused */
#include "amgfimpl.h"

PetscErrorCode MatGetStamp_AMGF(Mat A, AMGFStamp *stamp)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectGetId((PetscObject)A, &stamp->id));
  PetscCall(PetscObjectStateGet((PetscObject)A, &stamp->state));
  PetscCall(MatGetNonzeroState(A, &stamp->pattern));
  PetscFunctionReturn(0);
}

PetscBool AMGFStampSamePattern(const AMGFStamp *a, const AMGFStamp *b)
{
  return (PetscBool)(a->id == b->id && a->pattern == b->pattern);
}

PetscBool AMGFStampSameValues(const AMGFStamp *a, const AMGFStamp *b)
{
  return (PetscBool)(AMGFStampSamePattern(a, b) && a->state == b->state);
}
