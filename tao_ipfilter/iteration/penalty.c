/*
   Computes a step of the penalized problem f + 1/2 sum m rho v^2 with violations v. Slacks and multipliers are
   predicted from it.
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Computes the pressures z = -rho v of a penalty with the constraints' stiffness rho. c: constraint values. */
PetscErrorCode IPPenaltyPressure(Tao tao, Vec c, Vec z)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPSlackViolation(tao, c, z));
  PetscCall(VecPointwiseMult(z, z, ip->stiff->rho));
  PetscCall(VecScale(z, -1.0));
  PetscFunctionReturn(0);
}

/* Computes the forces m z of these pressures */
static PetscErrorCode PenaltyPairForce(Tao tao, Vec c, Vec force)
{
  PetscFunctionBegin;
  PetscCall(IPPenaltyPressure(tao, c, force));
  PetscCall(VecPointwiseMult(force, force, ((TAO_IPFILTER *)tao->data)->pair[IP_SLACK].w));
  PetscFunctionReturn(0);
}

/* Computes the norm of the forces that the constraints exert on the unknowns after the step dx, by the linear model */
static PetscErrorCode PenaltyTransmitted(Tao tao, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           c, force, transmitted;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &c));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &transmitted));
  PetscCall(MatMultAdd(ip->jac->inequality, ip->dir.x, ip->at.c, c));
  PetscCall(PenaltyPairForce(tao, c, force));
  PetscCall(MatMultTranspose(ip->jac->inequality, force, transmitted));
  PetscCall(VecNorm(transmitted, NORM_2, norm));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &transmitted));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &c));
  PetscFunctionReturn(0);
}

/*
   Finds whether the penalized problem is convex: its curvature along dx is positive, and available factors have no
   negative pivots
*/
static PetscErrorCode PenaltyConvex(Tao tao, PetscBool *convex)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   curvature;
  PetscReal     size;
  PetscBool     indefinite;
  Vec           Ad;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Ad));
  PetscCall(MatMult(ip->cond->A, ip->dir.x, Ad));
  PetscCall(VecDot(ip->dir.x, Ad, &curvature));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Ad));
  PetscCall(VecNorm(ip->dir.x, NORM_2, &size));
  PetscCall(IPKrylovIndefinite(tao, &indefinite));
  *convex = (PetscBool)(PetscRealPart(curvature) > 1e-8 * ip->stiff->hscale * PetscSqr(size) && !indefinite);
  PetscFunctionReturn(0);
}

/* Assembles the matrix and the right-hand side of the penalized problem's Newton step */
static PetscErrorCode PenaltyAssemble(Tao tao, Vec rhs)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           v;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &v));
  PetscCall(VecPointwiseMult(v, ip->stiff->rho, ip->pair[IP_SLACK].w));
  PetscCall(IPCondenseMatrix(tao, v));
  PetscCall(PenaltyPairForce(tao, ip->at.c, v));
  PetscCall(VecAXPBY(rhs, -1.0, 0.0, tao->gradient));
  PetscCall(MatMultTransposeAdd(ip->jac->inequality, v, rhs, rhs));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &v));
  PetscFunctionReturn(0);
}

/*
   Solves for dx until the residual of the forces is a fraction of the forces that the constraints exert. *usable: false
   if the problem is not convex along dx.
*/
static PetscErrorCode PenaltyMinimize(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     target;
  Vec           rhs;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &rhs));
  PetscCall(PenaltyAssemble(tao, rhs));
  PetscCall(VecNorm(rhs, NORM_2, &target));
  PetscCall(VecSet(ip->dir.x, 0.0));
  *usable = (PetscBool)(target > 0.0);
  for (PetscInt pass = 0; pass < 3 && *usable; pass++) {
    PetscReal force;

    target *= IP_PREDICT_FORCING;
    PetscCall(IPLinearSolve(tao, rhs, ip->dir.x, target, usable));
    PetscCall(PenaltyTransmitted(tao, &force));
    if (ip->lin->norm <= IP_PREDICT_FORCING * force || force == 0.0) break;
    target = force;
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
  if (*usable) PetscCall(PenaltyConvex(tao, usable));
  PetscFunctionReturn(0);
}

/* Computes the penalized objective at x. it: gets the objective and the constraint values. */
static PetscErrorCode PenaltyObjective(Tao tao, Vec x, IPIterate *it, PetscReal *value)
{
  PetscScalar penalty;
  Vec         force, violation;

  PetscFunctionBegin;
  PetscCall(TaoComputeObjective(tao, x, &it->f));
  *value = it->f;
  if (IPUndefined(*value)) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, x, it->c, it->ce));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &violation));
  PetscCall(PenaltyPairForce(tao, it->c, force));
  PetscCall(IPSlackViolation(tao, it->c, violation));
  PetscCall(VecDot(force, violation, &penalty));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &violation));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  *value -= 0.5 * PetscRealPart(penalty);
  PetscFunctionReturn(0);
}

/*
   Finds whether the models at x (quadratic for the objective, linear for the constraints) agree with the true values at
   x + alpha dx. They always do for a quadratic program.
*/
static PetscErrorCode PenaltyModelsHold(Tao tao, PetscReal alpha, PetscBool *hold)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal tolerance = 0.1;
  PetscScalar     gd, dHd;
  PetscReal       change, error, f;
  Vec             Hd, r;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Hd));
  PetscCall(MatMult(ip->hess->H, ip->dir.x, Hd));
  PetscCall(VecDot(Hd, ip->dir.x, &dHd));
  PetscCall(VecDot(tao->gradient, ip->dir.x, &gd));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Hd));
  f = alpha * (PetscRealPart(gd) + 0.5 * alpha * PetscRealPart(dHd));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &r));
  PetscCall(MatMult(ip->jac->inequality, ip->dir.x, r));
  PetscCall(VecScale(r, alpha));
  PetscCall(VecNorm(r, NORM_2, &change));
  PetscCall(VecAXPY(r, 1.0, ip->at.c));
  PetscCall(VecAXPY(r, -1.0, ip->trial.c));
  PetscCall(VecNorm(r, NORM_2, &error));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &r));
  *hold = (PetscBool)(error <= tolerance * change &&
                      PetscAbsReal(ip->at.f + f - ip->trial.f) <=
                        tolerance * (alpha * PetscAbsScalar(gd) + alpha * alpha * PetscAbsScalar(dHd)));
  PetscFunctionReturn(0);
}

/*
   Moves x towards the solution of the penalized problem. The step is limited by the bounds, and halved until the
   penalized objective falls. *moved: false if it does not fall, if the models do not hold at that distance, or if there
   are equality constraints.
*/
PetscErrorCode IPPenaltyStep(Tao tao, PetscBool *moved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     before, after, alpha = 1.0;
  PetscBool     usable = PETSC_FALSE;

  PetscFunctionBegin;
  *moved = PETSC_FALSE;
  if (ip->me) PetscFunctionReturn(0);
  PetscCall(PenaltyMinimize(tao, &usable));
  if (!usable) PetscFunctionReturn(0);
  PetscCall(IPBoundsDirection(tao));
  PetscCall(IPFractionToBoundary(tao, IP_LOWER, 0.9, &alpha, NULL));
  PetscCall(PenaltyObjective(tao, tao->solution, &ip->trial, &before));
  for (PetscInt k = 0; k < 4 && !*moved; k++, alpha *= 0.5) {
    PetscCall(VecWAXPY(ip->trial.x, alpha, ip->dir.x, tao->solution));
    PetscCall(PenaltyObjective(tao, ip->trial.x, &ip->trial, &after));
    *moved = (PetscBool)(!IPUndefined(after) && after <= before);
    if (*moved) PetscCall(PenaltyModelsHold(tao, alpha, moved));
  }
  if (!*moved) PetscFunctionReturn(0);
  PetscCall(IPIterateCopyPoint(&ip->trial, &ip->at));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}
