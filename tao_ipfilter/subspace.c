/* What PCAMGF is to filter: the unknowns that the constraints touch, and whether the constraints are stiff enough for it. */
#include "ipfilterimpl.h"

/* The unknowns whose columns of J are not negligible: rows of this rank, |J_ij| > threshold max|J| for some i */
PetscErrorCode IPSubspaceFind(Tao tao, IS *is)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  Mat                J  = ip->cond.J;
  Vec                mark;
  const PetscScalar *a;
  PetscReal          local = 0.0, largest;
  PetscInt           rstart, rend, cstart, n, count = 0, *idx;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(J, &rstart, &rend));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCallMPI(MPI_Allreduce(&local, &largest, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)J)));
      PetscCall(MatCreateVecs(J, &mark, NULL));
    }
    for (PetscInt i = rstart; i < rend; i++) {
      const PetscInt    *cols;
      const PetscScalar *v;
      PetscInt           nc;

      PetscCall(MatGetRow(J, i, &nc, &cols, &v));
      for (PetscInt k = 0; k < nc; k++) {
        if (!pass) local = PetscMax(local, PetscAbsScalar(v[k]));
        else if (PetscAbsScalar(v[k]) > ip->filter_threshold * largest) PetscCall(VecSetValue(mark, cols[k], 1.0, INSERT_VALUES));
      }
      PetscCall(MatRestoreRow(J, i, &nc, &cols, &v));
    }
  }
  PetscCall(VecAssemblyBegin(mark));
  PetscCall(VecAssemblyEnd(mark));
  PetscCall(VecGetOwnershipRange(mark, &cstart, NULL));
  PetscCall(VecGetLocalSize(mark, &n));
  PetscCall(VecGetArrayRead(mark, &a));
  for (PetscInt j = 0; j < n; j++) count += PetscRealPart(a[j]) > 0.0;
  PetscCall(PetscMalloc1(count, &idx));
  count = 0;
  for (PetscInt j = 0; j < n; j++)
    if (PetscRealPart(a[j]) > 0.0) idx[count++] = cstart + j;
  PetscCall(VecRestoreArrayRead(mark, &a));
  PetscCall(VecDestroy(&mark));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)J), count, idx, PETSC_OWN_POINTER, is));
  PetscFunctionReturn(0);
}

/* The filter's unknowns with those that A couples to them. Their couplings are weighed irregularly, so that none cancel. */
PetscErrorCode IPSubspaceGrow(Tao tao, IS *is)
{
  TAO_IPFILTER      *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal    weak     = 1e-8, golden = 0.6180339887498949;
  const PetscScalar *coupling, *a;
  const PetscInt    *rows;
  PetscInt           rstart, n, count = 0, *idx;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->xwork, 0.0));
  PetscCall(ISGetLocalSize(ip->cond.filter, &n));
  PetscCall(ISGetIndices(ip->cond.filter, &rows));
  for (PetscInt i = 0; i < n; i++) PetscCall(VecSetValue(ip->xwork, rows[i], 1.0 + fmod(golden * rows[i], 1.0), INSERT_VALUES));
  PetscCall(ISRestoreIndices(ip->cond.filter, &rows));
  PetscCall(VecAssemblyBegin(ip->xwork));
  PetscCall(VecAssemblyEnd(ip->xwork));
  PetscCall(MatMult(ip->cond.A, ip->xwork, ip->xwork2));
  PetscCall(MatGetDiagonal(ip->cond.A, ip->xwork));
  PetscCall(VecGetOwnershipRange(ip->xwork, &rstart, NULL));
  PetscCall(VecGetLocalSize(ip->xwork, &n));
  PetscCall(PetscMalloc1(n, &idx));
  PetscCall(VecGetArrayRead(ip->xwork2, &coupling));
  PetscCall(VecGetArrayRead(ip->xwork, &a));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(coupling[i]) > weak * PetscAbsScalar(a[i])) idx[count++] = rstart + i;
  PetscCall(VecRestoreArrayRead(ip->xwork, &a));
  PetscCall(VecRestoreArrayRead(ip->xwork2, &coupling));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)tao), count, idx, PETSC_COPY_VALUES, is));
  PetscCall(PetscFree(idx));
  PetscFunctionReturn(0);
}

/* Largest (J^T D J)_ii / H_ii: how much stiffer than the Hessian the constraints make an unknown. A row that only the
   constraints hold counts as infinite. */
static PetscErrorCode Stiffening(Tao tao, PetscReal *ratio)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed       *cond = &ip->cond;
  const PetscScalar *h, *c;
  PetscReal          local = 0.0;
  PetscInt           rstart;

  PetscFunctionBegin;
  PetscCall(MatGetDiagonal(tao->hessian, ip->xwork));
  PetscCall(MatGetDiagonal(cond->JtDJ, ip->xwork2));
  PetscCall(VecGetOwnershipRange(ip->xwork, &rstart, NULL));
  PetscCall(VecGetArrayRead(ip->xwork, &h));
  PetscCall(VecGetArrayRead(ip->xwork2, &c));
  for (PetscInt r = 0; r < cond->nrows; r++) {
    const PetscReal hii = PetscRealPart(h[cond->rows[r] - rstart]), cii = PetscRealPart(c[cond->rows[r] - rstart]);

    if (cii > 0.0) local = PetscMax(local, hii > 0.0 ? cii / hii : PETSC_INFINITY);
  }
  PetscCall(VecRestoreArrayRead(ip->xwork2, &c));
  PetscCall(VecRestoreArrayRead(ip->xwork, &h));
  PetscCallMPI(MPI_Allreduce(&local, ratio, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/* Switches the filter of a PCAMGF on where J^T D J has become stiff against H, off where it has not; counts the systems */
PetscErrorCode IPSubspaceSwitch(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     ratio = PETSC_INFINITY;
  PetscBool     amgf;
  PC            pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (!amgf || ip->me) PetscFunctionReturn(0);
  if (ip->filter_switch > 0.0) PetscCall(Stiffening(tao, &ratio));
  ip->filtered = (PetscBool)(ip->filter_forced || ratio > ip->filter_switch);
  ip->nfiltered += ip->filtered;
  PetscCall(PCAMGFSetFilterActive(pc, ip->filtered));
  PetscCall(PetscInfo(tao, "Constraints stiffen an unknown by up to %g times the Hessian: filter %s\n", (double)ratio, ip->filtered ? "on" : "off"));
  PetscFunctionReturn(0);
}
