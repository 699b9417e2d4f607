/*
   Chooses how equality constraints enter the Newton system. If their rows involve few unknowns they are condensed, with
   proximal updates of the multipliers. Otherwise the augmented system is factored by MUMPS. If proximal updates do not
   satisfy the constraints, the rest of the solve uses the augmented system.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "pc_amgf/mumps.h"

/*
   Finds whether the equality constraints can be condensed: the preconditioner is PCAMGF, which handles stiff rows, the
   constraints involve few unknowns, and the problem is not small
*/
static PetscErrorCode EqualityFitsFilter(Tao tao, PetscBool *fits)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal fraction = 0.1;
  const PetscInt  many     = 1000;
  PetscInt        n, ntouched;
  PC              pc;
  IS              touched;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, fits));
  PetscCall(VecGetSize(tao->solution, &n));
  *fits = (PetscBool)(*fits && !ip->opt->direct_always && n >= many);
  if (!*fits) PetscFunctionReturn(0);
  PetscCall(IPConstrainedOf(ip->jac->equality, &touched));
  PetscCall(ISGetSize(touched, &ntouched));
  PetscCall(ISDestroy(&touched));
  *fits = (PetscBool)(ntouched <= fraction * n);
  PetscFunctionReturn(0);
}

/* Chooses the method for this solve, from Jacobian and Hessian at the start */
PetscErrorCode IPEqualityChoose(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *ip->prox = (IPProximal){.condensed = PETSC_FALSE};
  if (!ip->me) PetscFunctionReturn(0);
  if (ip->opt->equality == IP_EQUALITY_AUTO) PetscCall(EqualityFitsFilter(tao, &ip->prox->condensed));
  else ip->prox->condensed = (PetscBool)(ip->opt->equality == IP_EQUALITY_CONDENSED);
  PetscFunctionReturn(0);
}

/*
   Ends the use of proximal updates: assembles the condensed matrix without the rows of the equality constraints.
   *possible is false if MUMPS may not factor the augmented system.
*/
static PetscErrorCode EqualityGiveUpProximal(Tao tao, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_CHOLESKY, possible));
  *possible = (PetscBool)(*possible && ip->opt->direct_memory > 0.0 && !ip->hess->products &&
                          ip->lin->reason != KSP_DIVERGED_NANORINF);
  if (!*possible) PetscFunctionReturn(0);
  ip->prox->condensed = PETSC_FALSE;
  ip->rec->fallbacks.direct++;
  PetscCall(PetscInfo(tao,
    "Proximal updates do not meet the equality constraints: the augmented system is used from now on\n"));
  PetscCall(IPCondenseMatrix(tao, ip->cond->rows.inequality));
  PetscFunctionReturn(0);
}

/*
   Solves for dx and for the direction dir.y of the multipliers with the matrix cond->A; both hold an initial guess. ce:
   residual of the equality constraints; target: largest allowed residual norm of the forces; matrix: whether A is new
   since the last call.
*/
PetscErrorCode IPEqualitySolve(Tao tao, Vec b, Vec ce, Vec dx, PetscBool matrix, PetscReal target, PetscBool *usable)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscBool     exact = PETSC_FALSE, possible = PETSC_TRUE;

  PetscFunctionBegin;
  if (ip->prox->condensed) {
    PetscCall(IPProximalSolve(tao, b, ce, dx, target, usable, &exact));
    if (exact || (!*usable && !ip->lin->failed)) PetscFunctionReturn(0);
    PetscCall(EqualityGiveUpProximal(tao, &possible));
    if (!possible) PetscFunctionReturn(0);
    matrix = PETSC_TRUE;
  }
  PetscCall(IPAugmentedSolve(tao, b, ce, dx, matrix, usable));
  PetscFunctionReturn(0);
}

/* Solves for dx of a feasibility restoration step */
PetscErrorCode IPEqualityRestore(Tao tao, Vec b, Vec ce, Vec dx, PetscBool *usable)
{
  PetscFunctionBegin;
  if (((TAO_IPFILTER *)tao->data)->prox->condensed) PetscCall(IPProximalRestore(tao, b, ce, dx, usable));
  else PetscCall(IPAugmentedSolve(tao, b, ce, dx, PETSC_TRUE, usable));
  PetscFunctionReturn(0);
}

/* Estimates the multipliers y by least squares of the stationarity residual with LSQR, to a few digits */
static PetscErrorCode EqualityMultipliersByLSQR(Tao tao)
{
  TAO_IPFILTER   *ip         = (TAO_IPFILTER *)tao->data;
  const PetscReal accuracy   = 1e-6;
  const PetscInt  iterations = 100;
  KSP             ksp;
  PC              pc;
  Mat             forces;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->at.y, 0.0));
  PetscCall(IPStationarity(tao, ip->at.lambda, ip->rx));
  PetscCall(VecScale(ip->rx, -1.0));
  PetscCall(MatCreateTranspose(ip->jac->equality, &forces));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)tao), &ksp));
  PetscCall(KSPSetType(ksp, KSPLSQR));
  PetscCall(KSPSetOperators(ksp, forces, forces));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCNONE));
  PetscCall(KSPSetTolerances(ksp, accuracy, PETSC_DEFAULT, PETSC_DEFAULT, iterations));
  PetscCall(KSPSolve(ksp, ip->rx, ip->at.y));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&forces));
  PetscFunctionReturn(0);
}

/*
   Estimates the multipliers of the equality constraints at the present point; small problems use a factorization. If
   the multipliers are huge, because the gradients of the constraints are almost dependent, they are set to zero
   (Waechter and Biegler 2006, section 3.6).
*/
PetscErrorCode IPEqualityMultipliers(Tao tao)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal huge = 1e3; /* relative to the gradient of the objective */
  const PetscInt  few  = 10000;
  PetscReal       y, g, j;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(VecGetSize(tao->solution, &n));
  if (ip->prox->condensed || n + ip->me > few) PetscCall(EqualityMultipliersByLSQR(tao));
  else PetscCall(IPAugmentedMultipliers(tao));
  PetscCall(VecNorm(ip->at.y, NORM_INFINITY, &y));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &g));
  PetscCall(MatNorm(ip->jac->equality, NORM_INFINITY, &j));
  if (!(y * j <= huge * g)) PetscCall(VecSet(ip->at.y, 0.0));
  PetscFunctionReturn(0);
}
