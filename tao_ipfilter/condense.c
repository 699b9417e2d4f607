/*
   The condensed system. Eliminating slacks and multipliers from Newton's system leaves

     A d = b,   A = H + Sigma + J^T D J + delta M_u,   D = M_s z/s,
     b = -grad f + J^T (M_s target/s - D (c - s)) + bound terms.

   A has H's type, except that it is BAIJ where one process has an SBAIJ H, unless the preconditioner factors SBAIJ: H then
   takes half the memory, while products with A and hypre work on whole rows. A's pattern is the union of H's and J^T J's and is
   preallocated; while H is unchanged only the rows that J^T D J touches are written again, so a constant H is copied once.
*/
#include "ipfilterimpl.h"

PetscErrorCode IPCondensedDestroy(IPCondensed *c)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->A));
  PetscCall(MatDestroy(&c->J));
  PetscCall(MatDestroy(&c->DJ));
  PetscCall(MatDestroy(&c->JtDJ));
  PetscCall(VecDestroy(&c->shift));
  PetscCall(VecDestroy(&c->hdiag));
  PetscCall(ISDestroy(&c->filter));
  PetscCall(PetscFree(c->rows));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/* Takes over the inequality Jacobian: an AIJ view of it, scaled and without fixed variables, and the filter's unknowns. Keeps the IS while its entries stay. */
PetscErrorCode IPCondenseJacobian(Tao tao)
{
  TAO_IPFILTER    *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed     *cond = &ip->cond;
  Mat              user = tao->jacobian_inequality;
  PetscObjectState state;
  PetscBool        aij;
  Mat              J;
  IS               filter;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)user, &state));
  if (cond->J && state == cond->J_state && cond->J_id == ((PetscObject)user)->id) PetscFunctionReturn(0);
  cond->J_state = state;
  cond->J_id    = ((PetscObject)user)->id;
  PetscCall(MatGetNonzeroState(user, &cond->J_nonzero));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)user, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  PetscCall(MatDestroy(&cond->J));
  if (aij) {
    PetscCall(PetscObjectReference((PetscObject)user));
    J = user;
  } else PetscCall(MatConvert(user, MATAIJ, MAT_INITIAL_MATRIX, &J));
  PetscCall(IPScalingJacobian(tao, J, ip->cscale, &cond->J));
  PetscCall(MatDestroy(&J));
  PetscCall(IPSubspaceFind(tao, &filter));
  if (cond->filter) {
    PetscBool same;

    PetscCall(ISEqual(filter, cond->filter, &same));
    if (same) {
      PetscCall(ISDestroy(&filter));
      PetscFunctionReturn(0);
    }
    PetscCall(ISDestroy(&cond->filter));
  }
  cond->filter = filter;
  PetscFunctionReturn(0);
}

/* J^T D J and the rows of this rank it touches; *changed tells that its pattern is new */
static PetscErrorCode UpdateProduct(Tao tao, Vec D, PetscBool *changed)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed  *cond = &ip->cond;
  PetscInt      rstart, rend;

  PetscFunctionBegin;
  *changed = (PetscBool)(!cond->JtDJ || cond->JtDJ_nonzero != cond->J_nonzero || cond->JtDJ_id != cond->J_id);
  if (*changed) {
    PetscCall(MatDestroy(&cond->DJ));
    PetscCall(MatDestroy(&cond->JtDJ));
    PetscCall(MatDuplicate(cond->J, MAT_COPY_VALUES, &cond->DJ));
    cond->JtDJ_nonzero = cond->J_nonzero;
    cond->JtDJ_id      = cond->J_id;
  } else PetscCall(MatCopy(cond->J, cond->DJ, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(cond->DJ, D, NULL));
  PetscCall(MatTransposeMatMult(cond->J, cond->DJ, *changed ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX, PETSC_DEFAULT, &cond->JtDJ));
  if (!*changed) PetscFunctionReturn(0);
  PetscCall(PetscFree(cond->rows));
  PetscCall(MatGetOwnershipRange(cond->JtDJ, &rstart, &rend));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc1(cond->nrows, &cond->rows));
    cond->nrows = 0;
    for (PetscInt i = rstart; i < rend; i++) {
      PetscInt nc;

      PetscCall(MatGetRow(cond->JtDJ, i, &nc, NULL, NULL));
      if (nc) {
        if (pass) cond->rows[cond->nrows] = i;
        cond->nrows++;
      }
      PetscCall(MatRestoreRow(cond->JtDJ, i, &nc, NULL, NULL));
    }
  }
  PetscFunctionReturn(0);
}

/* Sorted union of the block columns of block row ib in H and in J^T D J and the diagonal; upper: from the diagonal on */
static PetscErrorCode BlockRowPattern(Mat H, Mat C, PetscInt ib, PetscInt bs, PetscBool upper, PetscInt *n, PetscInt cols[])
{
  PetscFunctionBegin;
  *n           = 0;
  cols[(*n)++] = ib;
  for (PetscInt k = 0; k < bs; k++) {
    for (PetscInt m = 0; m < 2; m++) {
      Mat             B = m ? C : H;
      const PetscInt *c;
      PetscInt        nc, last = -1;

      if (!B) continue;
      PetscCall(MatGetRow(B, ib * bs + k, &nc, &c, NULL));
      for (PetscInt j = 0; j < nc; j++) {
        const PetscInt block = c[j] / bs;

        if (block == last || (upper && block < ib)) continue;
        cols[(*n)++] = last = block;
      }
      PetscCall(MatRestoreRow(B, ib * bs + k, &nc, &c, NULL));
    }
  }
  PetscCall(PetscSortRemoveDupsInt(n, cols));
  PetscFunctionReturn(0);
}

/* Longest row of H plus that of J^T D J times the block size bounds a block row's pattern */
static PetscErrorCode LongestRow(Mat H, Mat C, PetscInt bs, PetscInt *longest)
{
  PetscInt rstart, rend, h = 0, c = 0;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  for (PetscInt i = rstart; i < rend; i++) {
    PetscInt nc;

    PetscCall(MatGetRow(H, i, &nc, NULL, NULL));
    h = PetscMax(h, nc);
    PetscCall(MatRestoreRow(H, i, &nc, NULL, NULL));
    if (!C) continue;
    PetscCall(MatGetRow(C, i, &nc, NULL, NULL));
    c = PetscMax(c, nc);
    PetscCall(MatRestoreRow(C, i, &nc, NULL, NULL));
  }
  *longest = bs * (h + c) + 1;
  PetscFunctionReturn(0);
}

/* A new A of H's type, preallocated for the union pattern */
static PetscErrorCode CreateCondensed(Mat H, Mat C, Mat *A)
{
  PetscInt     bs = 1, hbs, rstart, rend, m, n, M, N, *cols, *dnz, *onz, longest = 0;
  PetscBool    baij, sbaij;
  MatType      type;
  MatNullSpace near;

  PetscFunctionBegin;
  PetscCall(MatGetType(H, &type));
  PetscCall(MatGetBlockSize(H, &hbs));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (baij || sbaij) bs = hbs;
  PetscCall(MatGetLocalSize(H, &m, &n));
  PetscCall(MatGetSize(H, &M, &N));
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  if (sbaij) PetscCall(MatGetRowUpperTriangular(H));
  PetscCall(LongestRow(H, C, bs, &longest));
  PetscCall(PetscMalloc3(longest, &cols, m / bs, &dnz, m / bs, &onz));
  for (PetscInt ib = rstart / bs; ib < rend / bs; ib++) {
    PetscInt nb;

    PetscCall(BlockRowPattern(H, C, ib, bs, sbaij, &nb, cols));
    dnz[ib - rstart / bs] = onz[ib - rstart / bs] = 0;
    for (PetscInt j = 0; j < nb; j++) {
      if (cols[j] >= rstart / bs && cols[j] < rend / bs) dnz[ib - rstart / bs]++;
      else onz[ib - rstart / bs]++;
    }
  }
  if (sbaij) PetscCall(MatRestoreRowUpperTriangular(H));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)H), A));
  PetscCall(MatSetSizes(*A, m, n, M, N));
  PetscCall(MatSetType(*A, type));
  if (hbs > 1) PetscCall(MatSetBlockSize(*A, hbs));
  if (sbaij) PetscCall(MatXAIJSetPreallocation(*A, bs, NULL, NULL, dnz, onz));
  else if (baij) PetscCall(MatXAIJSetPreallocation(*A, bs, dnz, onz, NULL, NULL));
  else {
    PetscCall(MatSeqAIJSetPreallocation(*A, 0, dnz));
    PetscCall(MatMPIAIJSetPreallocation(*A, 0, dnz, 0, onz));
  }
  PetscCall(PetscFree3(cols, dnz, onz));
  if (sbaij) PetscCall(MatSetOption(*A, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  PetscCall(MatSetOption(*A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetOption(*A, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  PetscCall(MatGetNearNullSpace(H, &near));
  if (near) PetscCall(MatSetNearNullSpace(*A, near));
  PetscFunctionReturn(0);
}

/* Zeroes in A the pattern of C; A's other entries stay */
static PetscErrorCode ZeroTouched(Mat A, Mat C, PetscInt nrows, const PetscInt rows[])
{
  PetscScalar *zeros = NULL;
  PetscInt     nz    = 0;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < nrows; r++) {
    const PetscInt *c;
    PetscInt        nc;

    PetscCall(MatGetRow(C, rows[r], &nc, &c, NULL));
    if (nc > nz) {
      nz = 2 * nc;
      PetscCall(PetscFree(zeros));
      PetscCall(PetscCalloc1(nz, &zeros));
    }
    PetscCall(MatSetValues(A, 1, &rows[r], nc, c, zeros, INSERT_VALUES));
    PetscCall(MatRestoreRow(C, rows[r], &nc, &c, NULL));
  }
  PetscCall(PetscFree(zeros));
  PetscFunctionReturn(0);
}

/* Whether H has its upper triangle only, and A is to have whole rows */
static PetscErrorCode Unfolds(Tao tao, Mat H, PetscBool *unfolds)
{
  PC        pc;
  PetscBool half, factored;

  PetscFunctionBegin;
  *unfolds = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare((PetscObject)H, MATSEQSBAIJ, &half));
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)pc, &factored, PCCHOLESKY, PCICC, ""));
  *unfolds = (PetscBool)(half && !factored);
  PetscFunctionReturn(0);
}

/* A_r = H_r or A_r += H_r for one row */
static PetscErrorCode SetRow(Mat A, Mat H, PetscInt row, InsertMode mode)
{
  const PetscInt    *c;
  const PetscScalar *v;
  PetscInt           nc;

  PetscFunctionBegin;
  PetscCall(MatGetRow(H, row, &nc, &c, &v));
  PetscCall(MatSetValues(A, 1, &row, nc, c, v, mode));
  PetscCall(MatRestoreRow(H, row, &nc, &c, &v));
  PetscFunctionReturn(0);
}

/* One row of an upper triangle and its mirror image; entries with c < row come with row c, if that is written too */
static PetscErrorCode SetRowMirrored(Mat A, Mat H, PetscInt row)
{
  const PetscInt    *c;
  const PetscScalar *v;
  PetscInt           nc;

  PetscFunctionBegin;
  PetscCall(MatGetRow(H, row, &nc, &c, &v));
  PetscCall(MatSetValues(A, 1, &row, nc, c, v, INSERT_VALUES));
  PetscCall(MatSetValues(A, nc, c, 1, &row, v, INSERT_VALUES));
  PetscCall(MatRestoreRow(H, row, &nc, &c, &v));
  PetscFunctionReturn(0);
}

/* Copies all of a BAIJ matrix block row by block row: its scalar rows stacked are what MatSetValuesBlocked() takes */
static PetscErrorCode CopyBlocked(Mat A, Mat H, PetscInt bs)
{
  PetscScalar *values = NULL;
  PetscInt    *blocks = NULL;
  PetscInt     rstart, rend, max = 0;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  for (PetscInt row = rstart; row < rend; row++) {
    const PetscInt    *c;
    const PetscScalar *v;
    PetscInt           nc;

    PetscCall(MatGetRow(H, row, &nc, &c, &v));
    if (nc > max) {
      PetscCheck(row % bs == 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Rows of one block row differ in length");
      max = 2 * nc;
      PetscCall(PetscFree2(values, blocks));
      PetscCall(PetscMalloc2(bs * max, &values, max / bs + 1, &blocks));
    }
    PetscCall(PetscArraycpy(values + (row % bs) * nc, v, nc));
    const PetscInt nb = nc / bs, ib = row / bs;
    for (PetscInt j = 0; j < nb; j++) blocks[j] = c[j * bs] / bs;
    PetscCall(MatRestoreRow(H, row, &nc, &c, &v));
    if (row % bs == bs - 1) PetscCall(MatSetValuesBlocked(A, 1, &ib, nb, blocks, values, INSERT_VALUES));
  }
  PetscCall(PetscFree2(values, blocks));
  PetscFunctionReturn(0);
}

/* Writes all of H into A */
static PetscErrorCode WriteHessian(Mat A, Mat H)
{
  PetscInt  rstart, rend, bs;
  PetscBool baij, sbaij;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  if (baij) {
    PetscCall(MatGetBlockSize(H, &bs));
    PetscCall(CopyBlocked(A, H, bs));
    PetscFunctionReturn(0);
  }
  if (sbaij) PetscCall(MatGetRowUpperTriangular(H));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(SetRow(A, H, i, INSERT_VALUES));
  if (sbaij) PetscCall(MatRestoreRowUpperTriangular(H));
  PetscFunctionReturn(0);
}

/* Writes the rows of H into A that J^T D J touches */
static PetscErrorCode RestoreTouched(IPCondensed *cond, Mat H, PetscBool unfolds)
{
  PetscBool sbaij;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (sbaij) PetscCall(MatGetRowUpperTriangular(H));
  for (PetscInt r = 0; r < cond->nrows; r++) {
    if (unfolds) PetscCall(SetRowMirrored(cond->A, H, cond->rows[r]));
    else PetscCall(SetRow(cond->A, H, cond->rows[r], INSERT_VALUES));
  }
  if (sbaij) PetscCall(MatRestoreRowUpperTriangular(H));
  PetscFunctionReturn(0);
}

/* A = H for a new A or a new H; nothing but the entries that J^T D J has changed where both are the last system's */
static PetscErrorCode WriteMatrix(Tao tao, PetscBool pattern, PetscBool values)
{
  IPCondensed *cond = &((TAO_IPFILTER *)tao->data)->cond;
  Mat          H    = tao->hessian;
  MatNullSpace near;
  PetscBool    unfolds = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(Unfolds(tao, H, &unfolds));
  if (unfolds && values) {
    PetscCall(MatConvert(tao->hessian, MATSEQBAIJ, MAT_INITIAL_MATRIX, &H));
    PetscCall(MatGetNearNullSpace(tao->hessian, &near));
    if (near) PetscCall(MatSetNearNullSpace(H, near));
  } else PetscCall(PetscObjectReference((PetscObject)H));
  if (pattern) {
    PetscCall(MatDestroy(&cond->A));
    PetscCall(CreateCondensed(H, cond->JtDJ, &cond->A));
    cond->shifted = PETSC_FALSE;
  }
  if (cond->JtDJ) PetscCall(ZeroTouched(cond->A, cond->JtDJ, cond->nrows, cond->rows));
  if (values) PetscCall(WriteHessian(cond->A, H));
  else PetscCall(RestoreTouched(cond, H, unfolds));
  PetscCall(MatDestroy(&H));
  PetscFunctionReturn(0);
}

/* Diagonal of A: that of H plus Sigma of the bounds plus delta M_u. A second shift of zero restores H's diagonal. */
static PetscErrorCode WriteDiagonal(Tao tao)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed       *cond = &ip->cond;
  const PetscScalar *d;
  PetscInt           rstart, rend;
  PetscBool          shifted = (PetscBool)(ip->delta > 0.0);

  PetscFunctionBegin;
  PetscCall(VecSet(cond->shift, 0.0));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(IPPairGetSigma(&ip->pair[b], ip->xwork));
    PetscCall(VecAXPY(cond->shift, 1.0, ip->xwork));
    shifted = PETSC_TRUE;
  }
  if (ip->delta > 0.0 && ip->primal_mass) PetscCall(VecAXPY(cond->shift, ip->delta, ip->primal_mass));
  else if (ip->delta > 0.0) PetscCall(VecShift(cond->shift, ip->delta));
  if (!shifted && !cond->shifted) PetscFunctionReturn(0);
  cond->shifted = shifted;
  PetscCall(MatGetDiagonal(tao->hessian, cond->hdiag));
  PetscCall(VecAXPY(cond->hdiag, 1.0, cond->shift));
  PetscCall(MatGetOwnershipRange(cond->A, &rstart, &rend));
  PetscCall(VecGetArrayRead(cond->hdiag, &d));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(MatSetValue(cond->A, i, i, d[i - rstart], INSERT_VALUES));
  PetscCall(VecRestoreArrayRead(cond->hdiag, &d));
  PetscFunctionReturn(0);
}

/* Whether nothing is ever added to H */
static PetscBool Unconstrained(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!ip->mi && !ip->fixed && !ip->pair[IP_LOWER].n && !ip->pair[IP_UPPER].n && ip->delta == 0.0);
}

/* Assembles A = H + Sigma + J^T D J + delta M_u for the given D */
PetscErrorCode IPCondenseMatrix(Tao tao, Vec D)
{
  TAO_IPFILTER    *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed     *cond = &ip->cond;
  Mat              H    = tao->hessian;
  PetscObjectState state, nonzero;
  PetscBool        pattern = PETSC_FALSE, all;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterCondense, tao, H, NULL, NULL));
  ip->nsystems++;
  PetscCall(PetscObjectStateGet((PetscObject)H, &state));
  PetscCall(MatGetNonzeroState(H, &nonzero));
  if (Unconstrained(ip)) {
    PetscCall(PetscObjectReference((PetscObject)H));
    PetscCall(MatDestroy(&cond->A));
    cond->A       = H;
    cond->H_state = 0;
    PetscCall(PetscLogEventEnd(TAO_IPFilterCondense, tao, H, NULL, NULL));
    PetscFunctionReturn(0);
  }
  if (ip->mi) {
    PetscCall(UpdateProduct(tao, D, &pattern));
    PetscCall(IPSubspaceSwitch(tao));
  }
  pattern = (PetscBool)(pattern || !cond->A || cond->A == H || nonzero != cond->H_nonzero || cond->H_id != ((PetscObject)H)->id);
  all     = (PetscBool)(pattern || state != cond->H_state);
  if (!cond->shift) {
    PetscCall(VecDuplicate(tao->solution, &cond->shift));
    PetscCall(VecDuplicate(tao->solution, &cond->hdiag));
  }
  cond->H_state   = state;
  cond->H_nonzero = nonzero;
  cond->H_id      = ((PetscObject)H)->id;
  PetscCall(WriteMatrix(tao, pattern, all));
  PetscCall(WriteDiagonal(tao));
  if (cond->JtDJ) {
    PetscCall(MatAssemblyBegin(cond->A, MAT_FLUSH_ASSEMBLY));
    PetscCall(MatAssemblyEnd(cond->A, MAT_FLUSH_ASSEMBLY));
    for (PetscInt r = 0; r < cond->nrows; r++) PetscCall(SetRow(cond->A, cond->JtDJ, cond->rows[r], ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(cond->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(cond->A, MAT_FINAL_ASSEMBLY));
  PetscCall(IPFixedMatrix(tao, cond->A));
  if (cond->filter) PetscCall(PetscObjectCompose((PetscObject)cond->A, PCAMGF_FILTER_KEY, (PetscObject)cond->filter));
  PetscCall(PetscLogEventEnd(TAO_IPFilterCondense, tao, H, NULL, NULL));
  PetscFunctionReturn(0);
}

/* b for the primal residual rc (c - s, or that of a second-order correction) and the pairs' targets */
PetscErrorCode IPCondenseRHS(Tao tao, Vec rc, Vec b)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->gradient, b));
  PetscCall(VecScale(b, -1.0));
  if (ip->mi) {
    PetscCall(IPPairGetSigma(&ip->pair[IP_SLACK], ip->cwork));
    PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, rc));
    PetscCall(IPPairGetForce(&ip->pair[IP_SLACK], ip->cwork2));
    PetscCall(VecAYPX(ip->cwork, -1.0, ip->cwork2));
    PetscCall(MatMultTransposeAdd(ip->cond.J, ip->cwork, b, b));
  }
  for (PetscInt k = IP_LOWER; k <= IP_UPPER; k++) {
    if (!ip->pair[k].n) continue;
    PetscCall(IPPairGetForce(&ip->pair[k], ip->xwork));
    PetscCall(VecAXPY(b, k == IP_LOWER ? 1.0 : -1.0, ip->xwork));
  }
  PetscFunctionReturn(0);
}

/* Slack, multiplier and bound directions from dx: ds = J dx + rc, lambda + dlambda = target/s - (z/s) ds */
PetscErrorCode IPBackSubstitute(Tao tao, Vec rc)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    IPPair *slack = &ip->pair[IP_SLACK];

    PetscCall(MatMultAdd(ip->cond.J, ip->dx, rc, slack->dt));
    PetscCall(IPPairDualDirection(slack));
    PetscCall(VecWAXPY(ip->dlambda, 1.0, slack->z, slack->dz));
    PetscCall(VecAXPY(ip->dlambda, -1.0, ip->lambda));
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecCopy(ip->dx, p->dt));
    if (b == IP_UPPER) PetscCall(VecScale(p->dt, -1.0));
    PetscCall(IPPairDualDirection(p));
  }
  PetscFunctionReturn(0);
}
