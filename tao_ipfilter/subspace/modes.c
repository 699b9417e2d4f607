/*
   Motions that K hardly resists, such as the rigid body modes of bodies on weak springs. Multigrid converges slowly for
   them, since its coarse spaces do not contain rotations. They are therefore added to the search space.
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"

/* Gets the motions that the search space should contain; NULL: none */
static Mat ModesGet(Tao tao)
{
  return IPSubspaceOf(tao)->newton ? NULL : ((TAO_IPFILTER *)tao->data)->given->modes;
}

PetscErrorCode IPModesGetNumber(Tao tao, PetscInt *n)
{
  const Mat modes = ModesGet(tao);

  PetscFunctionBegin;
  *n = 0;
  if (modes) PetscCall(MatGetSize(modes, NULL, n));
  PetscFunctionReturn(0);
}

/* Finds whether the preconditioner is a factorization, for which the motions are not needed */
static PetscErrorCode ModesAreServed(PC pc, PetscBool *served)
{
  PetscBool amgf;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  *served = (PetscBool)!amgf;
  if (amgf) PetscCall(PCAMGFGetFactored(pc, served));
  PetscFunctionReturn(0);
}

/*
   Appends the motions, set to zero on W, to the directions, unless they are already in the span. The oldest directions
   are removed if there is no room.
*/
PetscErrorCode IPModesAppend(Tao tao, IPRecycle *recycle)
{
  const Mat modes = ModesGet(tao);
  IPBasis  *basis = &recycle->basis;
  PetscInt  n;
  PetscBool served, appended;
  Vec       d;

  PetscFunctionBegin;
  if (!modes || basis->has_modes) PetscFunctionReturn(0);
  PetscCall(ModesAreServed(recycle->pc, &served));
  if (served || recycle->held) PetscFunctionReturn(0);
  PetscCall(IPModesGetNumber(tao, &n));
  PetscCall(IPBasisDropOldest(basis, basis->n + n - basis->max));
  PetscCall(VecDuplicate(tao->solution, &d));
  for (PetscInt j = 0; j < n; j++) {
    PetscCall(MatGetColumnVector(modes, d, j));
    PetscCall(VecISSet(d, basis->W, 0.0));
    PetscCall(IPBasisAppend(basis, ((TAO_IPFILTER *)tao->data)->hess->H, d, &appended));
  }
  PetscCall(VecDestroy(&d));
  basis->has_modes = PETSC_TRUE;
  PetscFunctionReturn(0);
}
