/*
   Computes the stiffness that resists the motion of each norm term, and directions in which a term cannot move. Without
   these directions friction_ironing cuts seven load steps, and friction_cost takes 332 solves for 125.
*/
#include "residualsimpl.h"
#include "tao_ipfilter/solver/terms.h"

/* Creates the matrix whose rows are the sums of the two rows of each term */
static PetscErrorCode ResistanceCreateSums(const IPTerms *terms, Mat *sums)
{
  PetscInt rstart, rend, first, m, n, *counts;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(terms->T, &m, &n));
  PetscCall(MatGetOwnershipRange(terms->T, &rstart, &rend));
  PetscCall(PetscCalloc1(m / 2, &counts));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(IPMatrixCreate(PetscObjectComm((PetscObject)terms->T), m / 2, n, counts, sums));
      PetscCall(MatGetOwnershipRange(*sums, &first, NULL));
    }
    for (PetscInt r = rstart; r < rend; r++) {
      const PetscInt     i = (r - rstart) / 2;
      const PetscInt    *columns;
      const PetscScalar *values;
      PetscInt           nc, row;

      PetscCall(MatGetRow(terms->T, r, &nc, &columns, &values));
      row = pass ? first + i : i;
      if (pass) PetscCall(MatSetValues(*sums, 1, &row, nc, columns, values, ADD_VALUES));
      else counts[i] += nc;
      PetscCall(MatRestoreRow(terms->T, r, &nc, &columns, &values));
    }
  }
  PetscCall(PetscFree(counts));
  PetscCall(MatAssemblyBegin(*sums, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*sums, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/*
   Computes rigid, the unit direction in which a term has almost no compliance; zeros if there is none. It is the
   eigenvector of the smallest eigenvalue of the 2 x 2 matrix of compliances. first, second: diagonal entries of that
   matrix, the compliances of the term's two rows; both: the compliance of the sum of the rows.
*/
static void ResistanceFindRigidDirection(PetscReal first, PetscReal second, PetscReal both, PetscScalar rigid[2])
{
  const PetscReal next_to_nothing = 1e-9, mixed = 0.5 * (both - first - second), mean = 0.5 * (first + second),
                  half   = 0.5 * (first - second);
  const PetscReal radius = PetscSqrtReal(half * half + mixed * mixed), angle = 0.5 * PetscAtan2Real(mixed, half);
  const PetscBool none = (PetscBool)(mean - radius > next_to_nothing * mean || mean == 0.0);

  rigid[0] = none ? 0.0 : -PetscSinReal(angle);
  rigid[1] = none ? 0.0 : PetscCosReal(angle);
}

/*
   Computes terms->rho, the stiffness that resists each term (0 if its compliance is zero or a rounding error), and
   terms->rigid, a direction with almost no compliance and almost no motion v, e.g. across a symmetry plane. In that
   direction v does not depend on x and counts as zero.
*/
PetscErrorCode IPTermsResistance(Tao tao)
{
  IPTerms        *terms   = ((TAO_IPFILTER *)tao->data)->terms;
  const PetscReal unmoved = 1e-6,  /* largest motion along `rigid`, relative to the largest motion of all */
    rounding              = 1e-14; /* compliance of rounding errors, relative to the largest one */
  const PetscScalar *c, *b, *v;
  PetscScalar       *rho, *rigid;
  PetscReal          sizes[2], largest;
  PetscInt           n;
  Vec                compliance, both, value;
  Mat                sums;

  PetscFunctionBegin;
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(terms->t, &compliance));
  PetscCall(VecDuplicate(terms->t, &value));
  PetscCall(VecDuplicate(terms->rho, &both));
  PetscCall(ResistanceCreateSums(terms, &sums));
  PetscCall(IPCompliances(tao, terms->T, compliance));
  PetscCall(IPCompliances(tao, sums, both));
  PetscCall(VecNorm(compliance, NORM_INFINITY, &largest));
  PetscCall(MatDestroy(&sums));
  PetscCall(IPTermsValue(tao, tao->solution, value));
  PetscCall(VecNorm(value, NORM_INFINITY, &sizes[0]));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &sizes[1]));
  PetscCall(VecGetLocalSize(terms->rho, &n));
  PetscCall(VecGetArrayRead(compliance, &c));
  PetscCall(VecGetArrayRead(both, &b));
  PetscCall(VecGetArrayRead(value, &v));
  PetscCall(VecGetArrayWrite(terms->rho, &rho));
  PetscCall(VecGetArrayWrite(terms->rigid, &rigid));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal larger = PetscMax(PetscRealPart(c[2 * i]), PetscRealPart(c[2 * i + 1]));
    PetscScalar    *d      = &rigid[2 * i];

    rho[i] = larger > rounding * largest ? 1.0 / larger : 0.0;
    ResistanceFindRigidDirection(PetscRealPart(c[2 * i]), PetscRealPart(c[2 * i + 1]), PetscRealPart(b[i]), d);
    if (PetscAbsScalar(d[0] * v[2 * i] + d[1] * v[2 * i + 1]) > unmoved * PetscMax(sizes[0], sizes[1]))
      d[0] = d[1] = 0.0;
  }
  PetscCall(VecRestoreArrayWrite(terms->rigid, &rigid));
  PetscCall(VecRestoreArrayWrite(terms->rho, &rho));
  PetscCall(VecRestoreArrayRead(value, &v));
  PetscCall(VecRestoreArrayRead(both, &b));
  PetscCall(VecRestoreArrayRead(compliance, &c));
  PetscCall(VecDestroy(&both));
  PetscCall(VecDestroy(&value));
  PetscCall(VecDestroy(&compliance));
  PetscFunctionReturn(0);
}
