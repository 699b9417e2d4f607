/*
   Chooses the unknowns that PCAMGF filters, namely those that the constraints involve, and decides whether the
   constraints are stiff enough to need the filter
*/
#include "systemimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"

/* Creates the index set of the unknowns j with |J_ij| > IP_FILTER_THRESHOLD max|J| for some row i */
PetscErrorCode IPConstrainedOf(Mat J, IS *is)
{
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
        else if (PetscAbsScalar(v[k]) > IP_FILTER_THRESHOLD * largest)
          PetscCall(VecSetValue(mark, cols[k], 1.0, INSERT_VALUES));
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

/*
   Updates the filter for the present Jacobian. If its entries are unchanged the same IS object is used, so that PCAMGF
   recognizes it.
*/
PetscErrorCode IPConstrainedUpdate(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed  *cond = ip->cond;
  const IPRows *rows = &cond->rows;
  PetscBool     same = PETSC_FALSE;
  IS            filter;

  PetscFunctionBegin;
  if (cond->constrained && cond->constrained_id == rows->stamp.value_id &&
      cond->constrained_state == rows->stamp.value_state)
    PetscFunctionReturn(0);
  PetscCall(IPConstrainedOf(rows->J, &filter));
  cond->constrained_id    = rows->stamp.value_id;
  cond->constrained_state = rows->stamp.value_state;
  if (cond->constrained) PetscCall(ISEqual(filter, cond->constrained, &same));
  if (!same) {
    PetscCall(ISDestroy(&cond->constrained));
    cond->constrained = filter;
  } else PetscCall(ISDestroy(&filter));
  PetscFunctionReturn(0);
}

/*
   Sets v to irregular positive numbers in the unknowns of a set, and to zero elsewhere, so that couplings to the set do
   not cancel in A v. Numbers that are linear in the index would be cancelled by a difference operator; the numbers are
   therefore computed from its square.
*/
static PetscErrorCode SubspaceMark(IS set, Vec v)
{
  const PetscInt *rows;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(VecSet(v, 0.0));
  PetscCall(ISGetLocalSize(set, &n));
  PetscCall(ISGetIndices(set, &rows));
  for (PetscInt i = 0; i < n; i++)
    PetscCall(VecSetValue(v, rows[i], 1.0 + fmod(PETSC_PHI * rows[i] * rows[i], 1.0), INSERT_VALUES));
  PetscCall(ISRestoreIndices(set, &rows));
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscFunctionReturn(0);
}

/* Creates the index set of the unknowns of a set and those coupled to them by A */
PetscErrorCode IPConstrainedGrow(Tao tao, Mat A, IS set, IS *is)
{
  const PetscReal    weak = 1e-8;
  Vec                marked, coupled;
  const PetscScalar *coupling, *a;
  PetscInt           rstart, n, count = 0, *idx;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &marked));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &coupled));
  PetscCall(SubspaceMark(set, marked));
  PetscCall(MatMult(A, marked, coupled));
  PetscCall(VecISSet(coupled, set, PETSC_MAX_REAL)); /* the set itself is always included */
  PetscCall(MatGetDiagonal(A, marked));
  PetscCall(VecGetOwnershipRange(marked, &rstart, NULL));
  PetscCall(VecGetLocalSize(marked, &n));
  PetscCall(PetscMalloc1(n, &idx));
  PetscCall(VecGetArrayRead(coupled, &coupling));
  PetscCall(VecGetArrayRead(marked, &a));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(coupling[i]) > weak * PetscAbsScalar(a[i])) idx[count++] = rstart + i;
  PetscCall(VecRestoreArrayRead(marked, &a));
  PetscCall(VecRestoreArrayRead(coupled, &coupling));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &coupled));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &marked));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)tao), count, idx, PETSC_COPY_VALUES, is));
  PetscCall(PetscFree(idx));
  PetscFunctionReturn(0);
}

/*
   Computes the largest (J^T D J)_ii / H_ii, the factor by which the constraints stiffen an unknown. Infinite if H_ii is
   not positive.
*/
static PetscErrorCode Stiffening(Tao tao, PetscReal *ratio)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed       *cond = ip->cond;
  const PetscScalar *h, *c;
  PetscReal          local = 0.0;
  PetscInt           rstart;
  Vec                hessian, product;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &hessian));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &product));
  PetscCall(MatGetDiagonal(ip->hess->H, hessian));
  PetscCall(MatGetDiagonal(cond->JtDJ, product));
  PetscCall(VecGetOwnershipRange(hessian, &rstart, NULL));
  PetscCall(VecGetArrayRead(hessian, &h));
  PetscCall(VecGetArrayRead(product, &c));
  for (PetscInt r = 0; r < cond->ntouched; r++) {
    const PetscReal hii = PetscRealPart(h[cond->touched[r] - rstart]),
                    cii = PetscRealPart(c[cond->touched[r] - rstart]);

    if (cii > 0.0) local = PetscMax(local, hii > 0.0 ? cii / hii : PETSC_INFINITY);
  }
  PetscCall(VecRestoreArrayRead(product, &c));
  PetscCall(VecRestoreArrayRead(hessian, &h));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &product));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &hessian));
  PetscCallMPI(MPI_Allreduce(&local, ratio, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/*
   Switches the filter of PCAMGF on if J^T D J is stiff relative to H, and off otherwise. Counts the systems with
   filter.
*/
PetscErrorCode IPConstrainedSwitch(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     ratio = PETSC_INFINITY;
  PetscBool     amgf;
  PC            pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (!amgf || (ip->me && !ip->prox->condensed)) PetscFunctionReturn(0);
  if (ip->opt->filter_switch > 0.0) PetscCall(Stiffening(tao, &ratio));
  ip->lin->filtered = (PetscBool)(ip->lin->filter_forced || ratio > ip->opt->filter_switch);
  ip->rec->nfiltered += ip->lin->filtered;
  PetscCall(PCAMGFSetFilterActive(pc, ip->lin->filtered));
  PetscCall(PetscInfo(tao, "Constraints stiffen an unknown by up to %g times the Hessian: filter %s\n", (double)ratio,
    ip->lin->filtered ? "on" : "off"));
  PetscFunctionReturn(0);
}
