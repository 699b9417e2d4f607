/*
   The whole condensed matrix by MUMPS, where Krylov methods fail: L D L^T, whose inertia tells for certain whether the matrix is
   positive definite. MUMPS's analysis estimates the memory before anything large is allocated.
*/
#include "ipfilterimpl.h"
#include "../pc_amgf/mumps.h"

PetscErrorCode IPDirectDestroy(IPDirect *direct)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&direct->F));
  PetscCall(MatDestroy(&direct->A));
  direct->system = 0;
  PetscFunctionReturn(0);
}

/* A as MUMPS takes a symmetric matrix, AIJ or SBAIJ; NULL where PETSc has no MUMPS for it */
static PetscErrorCode DirectTakeMatrix(Mat A, Mat *taken)
{
  PetscBool baij, mumps;
  MatType   type;

  PetscFunctionBegin;
  *taken = NULL;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  if (baij) PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, taken));
  else {
    PetscCall(PetscObjectReference((PetscObject)A));
    *taken = A;
  }
  PetscCall(MatGetType(*taken, &type));
  PetscCall(AMGFMumpsFactors(type, MAT_FACTOR_CHOLESKY, &mumps));
  if (!mumps) PetscCall(MatDestroy(taken));
  else PetscCall(MatSetOption(*taken, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Analysis, with the given percentage of memory beyond its estimate; *memory: what the factors will take, in 1e6 bytes over all ranks,
   negative where the analysis failed */
static PetscErrorCode DirectAnalyse(Tao tao, PetscInt relaxation, PetscReal *memory)
{
  TAO_IPFILTER  *ip     = (TAO_IPFILTER *)tao->data;
  IPDirect      *direct = &ip->direct;
  MatFactorError error;
  MatFactorInfo  info;
  const char    *prefix;
  char           own[PETSC_MAX_PATH_LEN];
  PetscInt       estimate;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&direct->F));
  PetscCall(MatGetFactor(direct->A, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &direct->F));
  PetscCall(TaoGetOptionsPrefix(tao, &prefix));
  PetscCall(PetscSNPrintf(own, sizeof(own), "%stao_ipfilter_direct_", prefix ? prefix : ""));
  PetscCall(MatSetOptionsPrefix(direct->F, own));
  PetscCall(AMGFMumpsSetIcntl(direct->F, 13, 1)); /* ScaLAPACK would keep the inertia of the root to itself */
  PetscCall(AMGFMumpsSetIcntl(direct->F, 14, relaxation));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatCholeskyFactorSymbolic(direct->F, direct->A, NULL, &info));
  PetscCall(MatFactorGetError(direct->F, &error));
  *memory = -1.0;
  if (error != MAT_FACTOR_NOERROR) PetscFunctionReturn(0);
  PetscCall(AMGFMumpsGetInfog(direct->F, 17, &estimate));
  *memory = (PetscReal)estimate;
  PetscFunctionReturn(0);
}

/* What the matrix itself takes, which the factors exceed, in 1e6 bytes: too much of that needs no analysis */
static PetscErrorCode DirectLeastMemory(Mat A, PetscReal *memory)
{
  MatInfo info;

  PetscFunctionBegin;
  PetscCall(MatGetInfo(A, MAT_GLOBAL_SUM, &info));
  *memory = 0.5 * info.nz_used * sizeof(PetscScalar) / 1e6;
  PetscFunctionReturn(0);
}

/* Factors the present matrix unless it is; *factored is false where it cannot be, for which the record then has a reason */
static PetscErrorCode DirectFactor(Tao tao, PetscBool *factored, PetscBool *singular)
{
  TAO_IPFILTER  *ip     = (TAO_IPFILTER *)tao->data;
  IPDirect      *direct = &ip->direct;
  const PetscInt first = 20, limit = 320; /* per cent of work space beyond the estimate */
  PetscReal      memory = 0.0;
  MatFactorError error  = MAT_FACTOR_OUTMEMORY;
  MatFactorInfo  info;

  PetscFunctionBegin;
  *factored = *singular = PETSC_FALSE;
  PetscCall(IPDirectDestroy(direct));
  PetscCall(MatFactorInfoInitialize(&info));
  if (ip->hess.products) {
    PetscCall(PetscStrncpy(ip->lin.why, "a Hessian that gives products alone leaves MUMPS nothing to factor", sizeof(ip->lin.why)));
    PetscFunctionReturn(0);
  }
  PetscCall(DirectLeastMemory(ip->cond.A, &memory));
  if (memory <= ip->opt.direct_memory) PetscCall(DirectTakeMatrix(ip->cond.A, &direct->A));
  if (memory <= ip->opt.direct_memory && !direct->A) {
    PetscCall(PetscStrncpy(ip->lin.why, "no MUMPS to factor the whole matrix", sizeof(ip->lin.why)));
    PetscFunctionReturn(0);
  }
  /* more work space each time that MUMPS finds its own estimate too small; the next matrix begins with what this one came to */
  if (!direct->relaxation) direct->relaxation = first;
  for (PetscBool again = PETSC_FALSE; error == MAT_FACTOR_OUTMEMORY && (!again || direct->relaxation < limit); again = PETSC_TRUE) {
    if (again) direct->relaxation *= 2;
    if (memory <= ip->opt.direct_memory) PetscCall(DirectAnalyse(tao, direct->relaxation, &memory));
    if (memory > ip->opt.direct_memory) {
      PetscCall(PetscSNPrintf(ip->lin.why, sizeof(ip->lin.why), "the whole matrix by MUMPS takes %g MB, allowed are %g", (double)memory, (double)ip->opt.direct_memory));
      break;
    }
    error = MAT_FACTOR_OTHER;
    if (memory < 0.0) break;
    PetscCall(MatCholeskyFactorNumeric(direct->F, direct->A, &info));
    PetscCall(MatFactorGetError(direct->F, &error));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)tao)));
    PetscCall(PetscInfo(tao, "MUMPS on the whole matrix, %g MB: error %d\n", (double)memory, (int)error));
  }
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  *singular = (PetscBool)(error == MAT_FACTOR_NUMERIC_ZEROPIVOT || error == MAT_FACTOR_STRUCT_ZEROPIVOT);
  if (*factored) direct->system = ip->rec.nsystems;
  else {
    PetscCall(IPDirectDestroy(direct));
    if (memory <= ip->opt.direct_memory) PetscCall(PetscStrncpy(ip->lin.why, "MUMPS failed on the whole matrix", sizeof(ip->lin.why)));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode DirectApply(Tao tao, Vec r, Vec e)
{
  PetscFunctionBegin;
  PetscCall(MatSolve(((TAO_IPFILTER *)tao->data)->direct.F, r, e));
  PetscFunctionReturn(0);
}

/* A d = b by L D L^T, refined to rounding; failed where that takes more memory than allowed or MUMPS fails */
PetscErrorCode IPDirectSolve(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER *ip       = (TAO_IPFILTER *)tao->data;
  IPDirect     *direct   = &ip->direct;
  PetscBool     factored = PETSC_TRUE, singular = PETSC_FALSE;

  PetscFunctionBegin;
  *verdict = IP_LINEAR_FAILED;
  if (ip->qn.npairs) {
    PetscCall(PetscStrncpy(ip->lin.why, "the Hessian is a limited-memory approximation, which MUMPS does not take", sizeof(ip->lin.why)));
    PetscFunctionReturn(0);
  }
  if (!direct->F || direct->system != ip->rec.nsystems) {
    PetscCall(DirectFactor(tao, &factored, &singular));
    if (factored) PetscCall(MatGetInertia(direct->F, &direct->negative, NULL, NULL));
  }
  if (singular || (factored && direct->negative)) *verdict = IP_LINEAR_INDEFINITE;
  if (!factored || direct->negative) PetscFunctionReturn(0);
  PetscCall(DirectApply(tao, b, d));
  PetscCall(IPResidualMeasure(tao, b, d));
  PetscCall(IPResidualRefine(tao, b, d, PETSC_TRUE, DirectApply, KSP_CONVERGED_ITS));
  if (IPResidualReached(ip, KSP_CONVERGED_ITS)) *verdict = IP_LINEAR_SOLVED;
  else PetscCall(PetscSNPrintf(ip->lin.why, sizeof(ip->lin.why), "MUMPS on the whole matrix leaves a backward error of %g", (double)ip->lin.backward_error));
  PetscFunctionReturn(0);
}
