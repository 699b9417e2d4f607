/*
   Companion unknowns make K_WW definite. K_WW is singular if W contains a whole body that is not held, or a mechanism.
   Each unknown with a vanishing pivot then gets a companion: an additional unknown that is connected to it by a spring
   and to nothing else. The springs make the matrix definite. They exert no forces, since the companions are free to
   follow their unknowns. The displacements s of the companions are treated as coordinates y of directions:
     1/2 v^T K v = min over s of 1/2 w^T (K_WW + E D E^T) w - s^T D E^T w + 1/2 s^T D s + terms of the directions,
   so that Q_W = -E D and P^T K P = D for them.
*/
#include "subspaceimpl.h"

PetscErrorCode IPCompanionsDestroy(IPCompanions *c)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(c->row, c->spring));
  c->n = 0;
  PetscFunctionReturn(0);
}

/*
   Finds whether K is singular up to rounding, from one solve with its factors: the energy of a load on all unknowns is
   compared with the energies of loads on single unknowns
*/
PetscErrorCode IPCompanionsAreNeeded(Mat K, IPCompliance *compliance, PetscBool *needed)
{
  const PetscReal most = 1e7;
  PetscReal       work = 0.0, alone = 0.0, *x;
  PetscScalar    *b;
  PetscRandom     random;
  Vec             load;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(K, &load, NULL));
  PetscCall(MatGetDiagonal(K, load));
  PetscCall(PetscRandomCreate(PETSC_COMM_SELF, &random));
  PetscCall(PetscMalloc1(compliance->n, &x));
  PetscCall(VecGetArray(load, &b));
  for (PetscInt i = 0; i < compliance->n; i++) {
    PetscReal r;

    PetscCall(PetscRandomGetValueReal(random, &r));
    b[i] = (r - 0.5) * PetscSqrtReal(PetscAbsScalar(b[i]));
    alone += PetscSqr(r - 0.5);
  }
  PetscCall(IPComplianceSolve(compliance, 1, b, x));
  for (PetscInt i = 0; i < compliance->n; i++) work += PetscRealPart(b[i]) * x[i];
  PetscCall(VecRestoreArray(load, &b));
  PetscCall(PetscFree(x));
  PetscCall(PetscRandomDestroy(&random));
  PetscCall(VecDestroy(&load));
  *needed = (PetscBool) !(work >= 0.0 && work <= most * alone);
  PetscFunctionReturn(0);
}

/*
   Computes the pivots of K scaled to a unit diagonal, in the order of K's rows. Pivots that almost vanish are increased
   by `raise`.
*/
static PetscErrorCode CompanionsPivots(Mat K, Vec scale, PetscReal raise, Vec pivots)
{
  const PetscReal nothing = 1e-6;
  MatFactorInfo   info;
  IS              rows, columns;
  Mat             S, F;
  Vec             ordered;
  VecScatter      back;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  info.shifttype   = (PetscReal)MAT_SHIFT_INBLOCKS;
  info.shiftamount = raise;
  info.zeropivot   = nothing;
  PetscCall(MatDuplicate(K, MAT_COPY_VALUES, &S));
  PetscCall(MatDiagonalScale(S, scale, scale));
  PetscCall(MatGetFactor(S, MATSOLVERPETSC, MAT_FACTOR_LU, &F));
  PetscCall(MatGetOrdering(S, MATORDERINGND, &rows, &columns));
  PetscCall(MatLUFactorSymbolic(F, S, rows, columns, &info));
  PetscCall(MatLUFactorNumeric(F, S, &info));
  PetscCall(VecDuplicate(pivots, &ordered));
  PetscCall(MatGetDiagonal(F, ordered));
  PetscCall(VecScatterCreate(ordered, NULL, pivots, rows, &back));
  PetscCall(VecScatterBegin(back, ordered, pivots, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(back, ordered, pivots, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterDestroy(&back));
  PetscCall(VecDestroy(&ordered));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscCall(MatDestroy(&F));
  PetscCall(MatDestroy(&S));
  PetscFunctionReturn(0);
}

/*
   Chooses companions from K's pivots, and adds their springs to K. Each spring is as stiff as the diagonal entry of its
   unknown. There are no companions if a diagonal entry is not positive.
*/
PetscErrorCode IPCompanionsTake(Mat K, IPCompanions *c)
{
  const PetscReal    raise = 2.0; /* larger than any pivot of the scaled matrix, which is at most 1 */
  Vec                scale, pivots;
  const PetscScalar *p, *s;
  PetscReal          least;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(IPCompanionsDestroy(c));
  PetscCall(MatCreateVecs(K, &scale, &pivots));
  PetscCall(MatGetDiagonal(K, scale));
  PetscCall(VecMin(scale, NULL, &least));
  if (!(least > 0.0)) {
    PetscCall(VecDestroy(&pivots));
    PetscCall(VecDestroy(&scale));
    PetscFunctionReturn(0);
  }
  PetscCall(VecSqrtAbs(scale));
  PetscCall(VecReciprocal(scale));
  PetscCall(CompanionsPivots(K, scale, raise, pivots));
  PetscCall(VecGetLocalSize(pivots, &n));
  PetscCall(PetscMalloc2(n, &c->row, n, &c->spring));
  PetscCall(VecGetArrayRead(pivots, &p));
  PetscCall(VecGetArrayRead(scale, &s));
  for (PetscInt i = 0; i < n; i++) {
    if (!(PetscAbsReal(PetscRealPart(p[i]) - raise) < 0.25 * raise)) continue;
    c->row[c->n]      = i;
    c->spring[c->n++] = raise / PetscSqr(PetscRealPart(s[i]));
  }
  PetscCall(VecRestoreArrayRead(scale, &s));
  PetscCall(VecRestoreArrayRead(pivots, &p));
  PetscCall(VecDestroy(&pivots));
  PetscCall(VecDestroy(&scale));
  for (PetscInt a = 0; a < c->n; a++) PetscCall(MatSetValue(K, c->row[a], c->row[a], c->spring[a], ADD_VALUES));
  PetscCall(MatAssemblyBegin(K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(K, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}
