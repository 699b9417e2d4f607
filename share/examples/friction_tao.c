/*
   Coulomb friction in a TAO program: masses in a row on a floor, joined by springs, and pulled at the last one. The
   floor's friction holds the first ones, the others slip until their friction balances the pull.

      minimize 1/2 u'K u - f'u   subject to   gap = J u >= 0,   and with friction against the slip T u

      friction_tao -tao_ipfilter_monitor

   Output:
      converged: TRUE
      masses that slip: 20 of 40
      the last one moves by sum_k (PULL - k MU) / SPRING, k = 1 to 20, to 1e-9: TRUE
*/
#include <petscamgf.h>

#define MASSES 40
#define WEIGHT 1.0
#define SPRING 100.0
#define MU     0.5
#define PULL   10.25

typedef struct {
  Mat K, J, T; /* the springs; gap and slip of each mass as functions of (height, along, across) of all masses */
  Vec f;
} Row;

/* Creates the matrices. A mass has three unknowns. The first one is joined to a wall. */
static PetscErrorCode CreateRow(Row *row)
{
  PetscInt n = PETSC_DECIDE, N = MASSES, start, end;

  PetscFunctionBeginUser;
  PetscCall(PetscSplitOwnership(PETSC_COMM_WORLD, &n, &N));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, 3 * n, 3 * n, 3 * N, 3 * N, 3, NULL, 1, NULL, &row->K));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, n, 3 * n, N, 3 * N, 1, NULL, 0, NULL, &row->J));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, 2 * n, 3 * n, 2 * N, 3 * N, 1, NULL, 0, NULL, &row->T));
  PetscCall(MatCreateVecs(row->K, &row->f, NULL));
  PetscCall(MatGetOwnershipRange(row->J, &start, &end));
  for (PetscInt i = start; i < end; i++) {
    PetscCall(MatSetValue(row->J, i, 3 * i, 1.0, INSERT_VALUES));
    PetscCall(VecSetValue(row->f, 3 * i, -WEIGHT, INSERT_VALUES));
    for (PetscInt a = 1; a < 3; a++) PetscCall(MatSetValue(row->T, 2 * i + a - 1, 3 * i + a, 1.0, INSERT_VALUES));
    for (PetscInt a = 0; a < 3; a++) {
      PetscCall(MatSetValue(row->K, 3 * i + a, 3 * i + a, (i + 1 < N ? 2.0 : 1.0) * SPRING, INSERT_VALUES));
      if (i > 0) PetscCall(MatSetValue(row->K, 3 * i + a, 3 * i + a - 3, -SPRING, INSERT_VALUES));
      if (i + 1 < N) PetscCall(MatSetValue(row->K, 3 * i + a, 3 * i + a + 3, -SPRING, INSERT_VALUES));
    }
  }
  if (end == N) PetscCall(VecSetValue(row->f, 3 * N - 2, PULL, INSERT_VALUES));
  for (PetscInt k = 0; k < 3; k++) {
    PetscCall(MatAssemblyBegin(k == 0 ? row->K : k == 1 ? row->J : row->T, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(k == 0 ? row->K : k == 1 ? row->J : row->T, MAT_FINAL_ASSEMBLY));
  }
  PetscCall(VecAssemblyBegin(row->f));
  PetscCall(VecAssemblyEnd(row->f));
  PetscFunctionReturn(0);
}

static PetscErrorCode EvaluateEnergy(Tao tao, Vec u, PetscReal *energy, Vec gradient, void *ctx)
{
  const Row  *row = (const Row *)ctx;
  PetscScalar stored, work;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(row->K, u, gradient));
  PetscCall(VecDot(gradient, u, &stored));
  PetscCall(VecDot(row->f, u, &work));
  PetscCall(VecAXPY(gradient, -1.0, row->f));
  *energy = PetscRealPart(0.5 * stored - work);
  PetscFunctionReturn(0);
}

static PetscErrorCode EvaluateGaps(Tao tao, Vec u, Vec gaps, void *ctx)
{
  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(((const Row *)ctx)->J, u, gaps));
  PetscFunctionReturn(0);
}

/* Hessian and Jacobian are constant */
static PetscErrorCode Keep(Tao tao, Vec u, Mat A, Mat B, void *ctx)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)u;
  (void)A;
  (void)B;
  (void)ctx;
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const PetscInt     most = (PetscInt)(PULL / MU); /* number of masses whose friction does not balance the pull */
  const PetscReal    far  = most * (PULL - 0.5 * (most + 1) * MU) / SPRING;
  Tao                tao;
  Row                row;
  Vec                u, gaps, slips, coefficients;
  const PetscScalar *slip;
  PetscInt           n, nslip = 0;
  PetscReal          largest;
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(CreateRow(&row));
  PetscCall(MatCreateVecs(row.J, &u, &gaps));
  PetscCall(MatCreateVecs(row.T, NULL, &slips));
  PetscCall(VecDuplicate(gaps, &coefficients));
  PetscCall(VecSet(coefficients, MU));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, EvaluateEnergy, &row));
  PetscCall(TaoSetHessian(tao, row.K, row.K, Keep, NULL));
  PetscCall(TaoSetInequalityConstraintsRoutine(tao, gaps, EvaluateGaps, &row));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, row.J, row.J, Keep, NULL));
  PetscCall(TaoSetSolution(tao, u));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoIPFilterSetNormTerms(tao, row.T, slips, NULL, coefficients)); /* slips: zero at the start */
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(MatMult(row.T, u, slips));
  PetscCall(VecNorm(slips, NORM_INFINITY, &largest));
  PetscCall(VecGetLocalSize(slips, &n));
  PetscCall(VecGetArrayRead(slips, &slip));
  for (PetscInt i = 0; i < n; i += 2) nslip += PetscAbsScalar(slip[i]) > 1e-6 * far;
  PetscCall(VecRestoreArrayRead(slips, &slip));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &nslip, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "converged: %s\nmasses that slip: %" PetscInt_FMT " of %d\n",
    PetscBools[reason > 0], nslip, MASSES));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
    "the last one moves by sum_k (PULL - k MU) / SPRING, k = 1 to 20, to 1e-9: %s\n",
    PetscBools[PetscAbsReal(largest / far - 1.0) < 1e-9]));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&coefficients));
  PetscCall(VecDestroy(&slips));
  PetscCall(VecDestroy(&gaps));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&row.f));
  PetscCall(MatDestroy(&row.T));
  PetscCall(MatDestroy(&row.J));
  PetscCall(MatDestroy(&row.K));
  PetscCall(PetscFinalize());
  return 0;
}
