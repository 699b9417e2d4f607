/*
   A limited-memory approximation B of the Hessian of the Lagrangian. It is used if the caller gives no Hessian and
   differences would be too expensive. B = sigma I + a matrix of low rank is computed by damped BFGS updates (Powell
   1978) in a MATLMVMBFGS.
   The condensed matrix is assembled and preconditioned with sigma I only. Products add the low-rank part, whose rank is
   twice the length of the history; a Krylov method then takes a few more iterations.
*/
#include "problemimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/quasinewton.h"
#include "tao_ipfilter/solver/rows.h"

PetscErrorCode IPQuasiNewtonDestroy(IPQuasiNewton *qn)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&qn->B));
  PetscCall(MatDestroy(&qn->A));
  PetscCall(MatDestroy(&qn->inequality));
  PetscCall(MatDestroy(&qn->equality));
  PetscCall(VecDestroy(&qn->x));
  PetscCall(VecDestroy(&qn->gradient));
  PetscCall(VecDestroy(&qn->sum));
  PetscCall(PetscMemzero(qn, sizeof(*qn)));
  PetscFunctionReturn(0);
}

/* Adds (B - sigma I) x to y, for the variables that are not fixed. Does nothing if the caller gives a Hessian. */
PetscErrorCode IPQuasiNewtonAdd(Tao tao, Vec x, Vec y)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           free, Bx;

  PetscFunctionBegin;
  if (!ip->qn->npairs) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &free));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Bx));
  PetscCall(VecCopy(x, free));
  PetscCall(IPFixedZero(tao, free));
  PetscCall(MatMult(ip->qn->B, free, Bx));
  PetscCall(VecAXPY(Bx, -ip->qn->sigma, free));
  PetscCall(IPFixedZero(tao, Bx));
  PetscCall(VecAXPY(y, 1.0, Bx));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Bx));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &free));
  PetscFunctionReturn(0);
}

/* Multiplies x by the condensed matrix with B in place of sigma I */
static PetscErrorCode QuasiNewtonMult(Mat A, Vec x, Vec y)
{
  Tao tao;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(A, &tao));
  PetscCall(MatMult(((TAO_IPFILTER *)tao->data)->cond->A, x, y));
  PetscCall(IPQuasiNewtonAdd(tao, x, y));
  PetscFunctionReturn(0);
}

/* Returns the operator of the Krylov method: the condensed matrix, or the shell that adds the low-rank part of B */
Mat IPQuasiNewtonOperator(const TAO_IPFILTER *ip)
{
  return ip->qn->npairs ? ip->qn->A : ip->cond->A;
}

/* Computes g = g + sign J^T force */
static PetscErrorCode AddTransposed(Mat J, Vec force, PetscReal sign, Vec g)
{
  Vec product;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(g, &product));
  PetscCall(MatMultTranspose(J, force, product));
  PetscCall(VecAXPY(g, sign, product));
  PetscCall(VecDestroy(&product));
  PetscFunctionReturn(0);
}

/*
   Adds sign (J - J_old)^T force to g, where J is a Jacobian of the caller and J_old its value at the last call. g may
   be NULL. *old and *state store J for the next call.
*/
static PetscErrorCode AddJacobianChange(Mat J, PetscReal sign, Vec force, Mat *old, PetscObjectState *state, Vec g)
{
  PetscObjectState now;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)J, &now));
  if (*old && now != *state && g) {
    PetscCall(AddTransposed(J, force, sign, g));
    PetscCall(AddTransposed(*old, force, -sign, g));
  }
  if (!*old || now != *state) {
    PetscCall(MatDestroy(old));
    PetscCall(MatDuplicate(J, MAT_COPY_VALUES, old));
  }
  *state = now;
  PetscFunctionReturn(0);
}

/*
   Computes the changes since the last call: s of x, and y of the gradient of f + DE^T c_E - DI^T c_I for the present
   multipliers. Either may be NULL. Stores the present point and Jacobians for the next call.
*/
static PetscErrorCode QuasiNewtonChanges(Tao tao, Vec s, Vec y)
{
  TAO_IPFILTER  *ip = (TAO_IPFILTER *)tao->data;
  IPQuasiNewton *qn = ip->qn;

  PetscFunctionBegin;
  if (s) PetscCall(VecWAXPY(s, -1.0, qn->x, tao->solution));
  if (y) PetscCall(VecWAXPY(y, -1.0, qn->gradient, tao->gradient));
  if (ip->mi)
    PetscCall(AddJacobianChange(tao->jacobian_inequality, -1.0, tao->DI, &qn->inequality, &qn->inequality_state, y));
  if (ip->me > ip->sides->nall)
    PetscCall(AddJacobianChange(tao->jacobian_equality, 1.0, tao->DE, &qn->equality, &qn->equality_state, y));
  if (y) PetscCall(IPFixedZero(tao, y));
  PetscCall(VecCopy(tao->solution, qn->x));
  PetscCall(VecCopy(tao->gradient, qn->gradient));
  PetscFunctionReturn(0);
}

/* Sets the multiple sigma of the identity in B and in H */
static PetscErrorCode QuasiNewtonSetScale(Tao tao, Mat H, PetscReal sigma)
{
  IPQuasiNewton *qn = ((TAO_IPFILTER *)tao->data)->qn;

  PetscFunctionBegin;
  qn->sigma = sigma;
  PetscCall(MatLMVMSetJ0Scale(qn->B, sigma));
  PetscCall(MatZeroEntries(H));
  PetscCall(MatShift(H, sigma));
  PetscFunctionReturn(0);
}

/*
   Starts B with sigma = the curvature of the objective along its gradient, by a difference of gradients; 1 if the
   curvature is not positive
*/
static PetscErrorCode QuasiNewtonBegin(Tao tao, Vec x, Mat H)
{
  IPQuasiNewton *qn = ((TAO_IPFILTER *)tao->data)->qn;
  PetscReal      size, norm, step;
  PetscScalar    curvature = 0.0;
  Vec            near, g;

  PetscFunctionBegin;
  PetscCall(MatLMVMReset(qn->B, PETSC_FALSE));
  PetscCall(QuasiNewtonChanges(tao, NULL, NULL));
  PetscCall(VecSet(qn->sum, 0.0));
  PetscCall(MatLMVMUpdate(qn->B, x, qn->sum));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &near));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &g));
  PetscCall(VecNorm(x, NORM_2, &size));
  PetscCall(VecNorm(tao->gradient, NORM_2, &norm));
  step = norm > 0.0 ? PETSC_SQRT_MACHINE_EPSILON * (size > 0.0 ? size : 1.0) / norm : 0.0;
  if (step > 0.0) {
    PetscCall(VecWAXPY(near, -step, tao->gradient, x));
    PetscCall(TaoComputeGradient(tao, near, g));
    PetscCall(IPFixedZero(tao, g));
    PetscCall(VecAYPX(g, -1.0, tao->gradient));
    PetscCall(VecDot(g, tao->gradient, &curvature));
    curvature /= step * norm * norm;
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &g));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &near));
  PetscCall(QuasiNewtonSetScale(tao, H,
    PetscRealPart(curvature) > 0.0 && !PetscIsInfOrNanScalar(curvature) ? PetscRealPart(curvature) : 1.0));
  qn->begun = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*
   Replaces y by a weighted mean of y and B s such that s^T y >= 0.2 s^T B s, which keeps B positive definite. *sy: the
   new s^T y.
*/
static PetscErrorCode QuasiNewtonDamp(Mat B, Vec s, Vec y, PetscReal *sy)
{
  const PetscReal least = 0.2;
  PetscScalar     sBs, product;
  Vec             Bs;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(s, &Bs));
  PetscCall(MatMult(B, s, Bs));
  PetscCall(VecDot(s, Bs, &sBs));
  PetscCall(VecDot(s, y, &product));
  *sy = PetscRealPart(product);
  if (*sy < least * PetscRealPart(sBs)) {
    const PetscReal theta = (1.0 - least) * PetscRealPart(sBs) / (PetscRealPart(sBs) - *sy);

    PetscCall(VecAXPBY(y, 1.0 - theta, theta, Bs));
    *sy = least * PetscRealPart(sBs);
  }
  PetscCall(VecDestroy(&Bs));
  PetscFunctionReturn(0);
}

/* Computes the Hessian for TaoComputeHessian(): updates B with the step since the last call, and sets H = sigma I */
static PetscErrorCode QuasiNewtonHessian(Tao tao, Vec x, Mat H, Mat Hpre, void *ctx)
{
  IPQuasiNewton *qn = ((TAO_IPFILTER *)tao->data)->qn;
  PetscReal      step, sy = 0.0;
  Vec            s, y;

  PetscFunctionBegin;
  (void)Hpre;
  (void)ctx;
  if (!qn->begun) {
    PetscCall(QuasiNewtonBegin(tao, x, H));
    PetscFunctionReturn(0);
  }
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &s));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &y));
  PetscCall(QuasiNewtonChanges(tao, s, y));
  PetscCall(VecNorm(s, NORM_2, &step));
  if (step > 0.0) {
    PetscCall(QuasiNewtonDamp(qn->B, s, y, &sy));
    PetscCall(VecAXPY(qn->sum, 1.0, y));
    PetscCall(MatLMVMUpdate(qn->B, x, qn->sum)); /* since PETSc 3.22 the update also rescales B by a rule of its own;
                                                    QuasiNewtonSetScale() replaces that scale */
    if (sy > 0.0) PetscCall(QuasiNewtonSetScale(tao, H, sy / (step * step)));
    qn->npairs++;
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &y));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &s));
  PetscFunctionReturn(0);
}

/* Discards the steps stored in B, so that the next solve starts anew */
void IPQuasiNewtonReset(IPQuasiNewton *qn)
{
  qn->begun  = PETSC_FALSE;
  qn->npairs = 0;
}

/* Tells whether the Hessian is B */
PetscErrorCode IPQuasiNewtonInUse(Tao tao, PetscBool *used)
{
  PetscErrorCode (*hessian)(Tao, Vec, Mat, Mat, void *);

  PetscFunctionBegin;
  PetscCall(TaoGetHessian(tao, NULL, NULL, &hessian, NULL));
  *used = (PetscBool)(hessian == QuasiNewtonHessian);
  PetscFunctionReturn(0);
}

/*
   Makes the Tao use B, if TaoSetHessian() was not called and the problem is large. tao->hessian becomes a diagonal
   matrix that holds sigma I.
*/
PetscErrorCode IPQuasiNewtonSetUp(Tao tao)
{
  IPQuasiNewton *qn   = ((TAO_IPFILTER *)tao->data)->qn;
  MPI_Comm       comm = PetscObjectComm((PetscObject)tao);
  Vec            x    = tao->solution;
  PetscInt       n, N, rstart, rend;
  Mat            H;

  PetscFunctionBegin;
  PetscCall(IPQuasiNewtonDestroy(qn));
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetSize(x, &N));
  PetscCall(MatCreateAIJ(comm, n, n, N, N, 1, NULL, 0, NULL, &H));
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(MatSetValue(H, i, i, 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscCall(TaoSetHessian(tao, H, H, QuasiNewtonHessian, NULL));
  PetscCall(MatDestroy(&H));
  PetscCall(MatCreateLMVMBFGS(comm, n, N, &qn->B));
  PetscCall(MatSetOptionsPrefix(qn->B, ((PetscObject)tao)->prefix));
  PetscCall(MatAppendOptionsPrefix(qn->B, "tao_ipfilter_"));
  PetscCall(MatSetFromOptions(qn->B));
  PetscCall(MatLMVMAllocate(qn->B, x, x));
  PetscCall(MatCreateShell(comm, n, n, N, N, tao, &qn->A));
  PetscCall(MatShellSetOperation(qn->A, MATOP_MULT, (AMGFOperation *)QuasiNewtonMult));
  PetscCall(MatSetOption(qn->A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(VecDuplicate(x, &qn->x));
  PetscCall(VecDuplicate(x, &qn->gradient));
  PetscCall(VecDuplicate(x, &qn->sum));
  PetscFunctionReturn(0);
}
