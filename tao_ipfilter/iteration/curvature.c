/*
   Looks for directions of negative curvature by conjugate gradients. With equality constraints all directions lie in
   the null space of their Jacobian (Gould, Hribar and Nocedal, On the solution of equality constrained quadratic
   programming problems arising in optimization, 2001).
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Computes the vector b of a test solve, which has a component along every eigenvector of A, whatever the units are:
   b_j = sqrt(sizes_j) times the sine of an irregular angle, with sizes_j = |A_jj|, but at least a small fraction of the
   largest entry
*/
static PetscErrorCode CurvatureProbe(Mat A, Vec sizes, Vec b)
{
  const PetscReal trace = 1e-12;
  PetscScalar    *v, *d;
  PetscReal       largest;
  PetscInt        rstart, rend;

  PetscFunctionBegin;
  PetscCall(MatGetDiagonal(A, sizes));
  PetscCall(VecAbs(sizes));
  PetscCall(VecMax(sizes, NULL, &largest));
  PetscCall(VecGetOwnershipRange(b, &rstart, &rend));
  PetscCall(VecGetArray(sizes, &d));
  PetscCall(VecGetArrayWrite(b, &v));
  for (PetscInt j = 0; j < rend - rstart; j++) {
    d[j] = PetscMax(PetscRealPart(d[j]), largest > 0.0 ? trace * largest : 1.0);
    v[j] = PetscSqrtReal(PetscRealPart(d[j])) * PetscSinReal(1.0 + 1.7 * (PetscReal)(rstart + j));
  }
  PetscCall(VecRestoreArrayWrite(b, &v));
  PetscCall(VecRestoreArray(sizes, &d));
  PetscFunctionReturn(0);
}

/* The diagonal scaling M and, with equality constraints, the projection on the null space of J_E */
typedef struct {
  Vec M, root; /* M and its square root */
  Mat forces;  /* M^-1/2 J_E^T; NULL: no equality constraints */
  KSP ksp;     /* least squares with this matrix */
  Vec y;
} CurvatureScale;

static PetscErrorCode CurvatureScaleDestroy(CurvatureScale *s)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&s->forces));
  PetscCall(KSPDestroy(&s->ksp));
  PetscCall(VecDestroy(&s->y));
  PetscCall(VecDestroy(&s->root));
  PetscFunctionReturn(0);
}

/* M: the diagonal of the scaling, which remains the caller's */
static PetscErrorCode CurvatureScaleCreate(Tao tao, Vec M, CurvatureScale *s)
{
  TAO_IPFILTER   *ip         = (TAO_IPFILTER *)tao->data;
  const PetscReal accuracy   = 1e-12;
  const PetscInt  iterations = 1000;
  Vec             inverse;
  PC              pc;

  PetscFunctionBegin;
  *s = (CurvatureScale){.M = M};
  PetscCall(VecDuplicate(M, &s->root));
  PetscCall(VecCopy(M, s->root));
  PetscCall(VecSqrtAbs(s->root));
  if (!ip->me) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(M, &inverse));
  PetscCall(VecCopy(s->root, inverse));
  PetscCall(VecReciprocal(inverse));
  PetscCall(IPFixedZero(tao, inverse));
  PetscCall(MatTranspose(ip->jac->equality, MAT_INITIAL_MATRIX, &s->forces));
  PetscCall(MatDiagonalScale(s->forces, inverse, NULL));
  PetscCall(VecDestroy(&inverse));
  PetscCall(VecDuplicate(ip->at.y, &s->y));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)tao), &s->ksp));
  PetscCall(KSPSetType(s->ksp, KSPLSQR));
  PetscCall(KSPSetOperators(s->ksp, s->forces, s->forces));
  PetscCall(KSPGetPC(s->ksp, &pc));
  PetscCall(PCSetType(pc, PCNONE));
  PetscCall(KSPSetTolerances(s->ksp, accuracy, 0.0, PETSC_DEFAULT, iterations));
  PetscFunctionReturn(0);
}

/* Projects r such that M^-1 r is in the null space of J_E, and computes z = M^-1 r */
static PetscErrorCode CurvatureScaleApply(CurvatureScale *s, Vec r, Vec z)
{
  PetscFunctionBegin;
  if (s->forces) {
    PetscCall(VecQuotient_AMGF(r, r, s->root));
    PetscCall(KSPSolve(s->ksp, r, s->y));
    PetscCall(VecScale(s->y, -1.0));
    PetscCall(MatMultAdd(s->forces, s->y, r, r));
    PetscCall(VecPointwiseMult(r, r, s->root));
  }
  PetscCall(VecQuotient_AMGF(z, r, s->M));
  PetscFunctionReturn(0);
}

/*
   Looks for a direction p of negative curvature, p^T A p < 0, and stores it in dir.x. J_E p = 0 with equality
   constraints.
*/
PetscErrorCode IPNegativeCurvature(Tao tao, PetscBool *found)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt  most     = 200;
  const PetscReal rounding = 1e-10;
  Vec             p        = ip->dir.x, v[4]; /* v: residual r, M^-1 r, A p, diagonal of M */
  PetscScalar     rz, before, pAp, pMp;
  PetscReal       first, norm;
  CurvatureScale  scale;

  PetscFunctionBegin;
  *found           = PETSC_FALSE;
  ip->shift->delta = 0.0;
  PetscCall(IPHessianEvaluate(tao));
  PetscCall(IPDirectionAssemble(tao));
  for (PetscInt k = 0; k < 4; k++) PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v[k]));
  PetscCall(CurvatureProbe(ip->cond->A, v[3], v[0]));
  PetscCall(IPFixedZero(tao, v[0]));
  PetscCall(CurvatureScaleCreate(tao, v[3], &scale));
  PetscCall(VecNorm(v[0], NORM_2, &first));
  PetscCall(CurvatureScaleApply(&scale, v[0], v[1]));
  PetscCall(VecCopy(v[1], p));
  PetscCall(VecDot(v[0], v[1], &rz));
  PetscCall(VecNorm(v[0], NORM_2, &norm));
  for (PetscInt k = 0; k < most && norm > rounding * first && !*found; k++) {
    PetscCall(MatMult(ip->cond->A, p, v[2]));
    PetscCall(VecDot(p, v[2], &pAp));
    PetscCall(VecPointwiseMult(v[1], v[3], p));
    PetscCall(VecDot(p, v[1], &pMp));
    *found = (PetscBool)(PetscRealPart(pAp) < -rounding * PetscRealPart(pMp));
    if (PetscRealPart(pAp) <= 0.0) break;
    PetscCall(IPFixedZero(tao, v[2]));
    PetscCall(VecAXPY(v[0], -rz / pAp, v[2]));
    PetscCall(CurvatureScaleApply(&scale, v[0], v[1]));
    before = rz;
    PetscCall(VecDot(v[0], v[1], &rz));
    PetscCall(VecAYPX(p, rz / before, v[1]));
    PetscCall(VecNorm(v[0], NORM_2, &norm));
  }
  PetscCall(CurvatureScaleDestroy(&scale));
  for (PetscInt k = 3; k >= 0; k--) PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v[k]));
  PetscFunctionReturn(0);
}
