/* Computes the principal values of a stress */
#include "recoveryimpl.h"
#include "src/material/materialimpl.h"

/*@
  ElasticityPrincipal - Computes the principal values of a stress

  Not Collective

  Input Parameter:
. stress - the components xx yy zz xy yz zx, in any unit

  Output Parameter:
. principal - the three principal values, the largest first, in the same unit

  Level: intermediate

  Notes:
  Uses Jacobi's method, which is as accurate for equal values as for distinct ones.

.seealso: `ElasticityCellStress()`, `ElasticityRecoverStress()`
@*/
PetscErrorCode ElasticityPrincipal(const PetscReal stress[6], PetscReal principal[3])
{
  const PetscReal S[9] = {stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4],
    stress[2]};
  PetscReal       axes[3][3];

  PetscFunctionBegin;
  LogarithmicEigen(S, principal, axes);
  for (int i = 0; i < 3; ++i) principal[i] = -principal[i];
  PetscCall(PetscSortReal(3, principal));
  for (int i = 0; i < 3; ++i) principal[i] = -principal[i];
  PetscFunctionReturn(0);
}
