/* Computes the principal values of a stress */
#include "recoveryimpl.h"

/* Makes the entry (p, q) zero by a Jacobi rotation */
static void PrincipalRotate(PetscReal A[3][3], int p, int q)
{
  const int       r    = 3 - p - q;
  const PetscReal half = (A[q][q] - A[p][p]) / 2, off = A[p][q];
  /* without this scaling, squares of tiny numbers would underflow */
  const PetscReal size = PetscMax(PetscAbsReal(half), PetscAbsReal(off));
  PetscReal       t, c, s, pr = A[p][r], qr = A[q][r];

  if (off == 0) return;
  t = off / (half + (half >= 0 ? 1 : -1) * size * PetscSqrtReal(PetscSqr(half / size) + PetscSqr(off / size)));
  c = 1 / PetscSqrtReal(1 + t * t);
  s = t * c;
  A[p][p] -= t * off;
  A[q][q] += t * off;
  A[p][q] = A[q][p] = 0;
  A[p][r] = A[r][p] = c * pr - s * qr;
  A[q][r] = A[r][q] = s * pr + c * qr;
}

/*@
  ElasticityPrincipal - Computes the principal values of a stress

  Not Collective

  Input Parameter:
. stress - xx yy zz xy yz zx

  Output Parameter:
. principal - the three values, the largest first

  Level: intermediate

  Notes:
  Uses Jacobi's method, which is as accurate for equal values as for distinct ones.

.seealso: `ElasticityCellStress()`, `ElasticityNodalStress()`
@*/
PetscErrorCode ElasticityPrincipal(const PetscReal stress[6], PetscReal principal[3])
{
  PetscReal A[3][3] = {{stress[0], stress[3], stress[5]}, {stress[3], stress[1], stress[4]},
    {stress[5], stress[4], stress[2]}};

  PetscFunctionBegin;
  for (int sweep = 0; sweep < 12; ++sweep) {
    PrincipalRotate(A, 0, 1);
    PrincipalRotate(A, 1, 2);
    PrincipalRotate(A, 0, 2);
  }
  for (int i = 0; i < 3; ++i) principal[i] = -A[i][i];
  PetscCall(PetscSortReal(3, principal));
  for (int i = 0; i < 3; ++i) principal[i] = -principal[i];
  PetscFunctionReturn(0);
}
