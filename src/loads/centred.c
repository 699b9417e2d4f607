/* Quadratic terms of the energy about a centre */
#include "loadsimpl.h"

/* Adds sign/2 (x - centre)^T A (x - centre) to the energy, and its derivative to `force`, which may be NULL. If A is
   NULL, the matrix is diagonal with the entries `diagonal`. */
PetscErrorCode CentredAdd(PetscReal sign, Mat A, Vec diagonal, Vec centre, Vec x, PetscReal *energy, Vec force)
{
  Vec         way, product;
  PetscScalar twice;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(x, &way));
  PetscCall(VecDuplicate(x, &product));
  PetscCall(VecWAXPY(way, -1.0, centre, x));
  if (A) PetscCall(MatMult(A, way, product));
  else PetscCall(VecPointwiseMult(product, diagonal, way));
  PetscCall(VecDot(product, way, &twice));
  *energy += 0.5 * sign * PetscRealPart(twice);
  if (force) PetscCall(VecAXPY(force, sign, product));
  PetscCall(VecDestroy(&product));
  PetscCall(VecDestroy(&way));
  PetscFunctionReturn(0);
}
