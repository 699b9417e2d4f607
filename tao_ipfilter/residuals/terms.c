/*
   Norm terms: sum_i b_i |v_i| is added to the objective, where v_i = T_i x + t_i has two components. With a given b_i
   this is a minimization. If b_i depends on the force of an inequality constraint, it is friction. The optimality
   conditions are
     grad f - J^T M lambda - T^T tau = 0,  |tau_i| <= b_i,  tau_i = -b_i v_i / |v_i| where v_i is not zero.
   Equivalently, tau_i is the projection of tau_i - rho_i v_i onto the disc of radius b_i, for any rho_i > 0.
*/
#include "residualsimpl.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/terms.h"

#define IP_HARD \
  1e3 /* stiffness of a term whose bound is infinite, as a multiple of the stiffness that resists the
                       term */

PetscErrorCode IPTermsDestroy(IPTerms *terms)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&terms->given));
  PetscCall(MatDestroy(&terms->T));
  PetscCall(VecDestroy(&terms->t));
  PetscCall(VecDestroy(&terms->limit));
  PetscCall(VecDestroy(&terms->coefficient));
  PetscCall(VecDestroy(&terms->warm));
  PetscCall(VecDestroy(&terms->force));
  PetscCall(VecDestroy(&terms->best));
  PetscCall(VecDestroy(&terms->last));
  PetscCall(VecDestroy(&terms->rho));
  PetscCall(VecDestroy(&terms->rigid));
  PetscCall(PetscMemzero(terms, sizeof(*terms)));
  PetscFunctionReturn(0);
}

/*
   Sets terms->T to a copy of the caller's matrix with zero columns for fixed variables, or to a reference to it if no
   variable is fixed
*/
static PetscErrorCode TermsTakeMatrix(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPTerms      *terms = ip->terms;
  Vec           mask;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&terms->T));
  if (ip->fixed) {
    PetscCall(MatDuplicate(terms->given, MAT_COPY_VALUES, &terms->T));
    PetscCall(IPGetWork(tao, IP_UNKNOWNS, &mask));
    PetscCall(VecSet(mask, 1.0));
    PetscCall(IPFixedZero(tao, mask));
    PetscCall(MatDiagonalScale(terms->T, NULL, mask));
    PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &mask));
  } else {
    PetscCall(PetscObjectReference((PetscObject)terms->given));
    terms->T = terms->given;
  }
  terms->stamp.value_id = terms->stamp.pattern_id = ((PetscObject)terms->T)->id;
  PetscCall(PetscObjectStateGet((PetscObject)terms->T, &terms->stamp.value_state));
  PetscCall(MatGetNonzeroState(terms->T, &terms->stamp.pattern_state));
  PetscFunctionReturn(0);
}

static PetscErrorCode TermsCheckSizes(Tao tao)
{
  const IPTerms *terms = ((TAO_IPFILTER *)tao->data)->terms;
  MPI_Comm       comm  = PetscObjectComm((PetscObject)tao);
  PetscInt       n, nt, columns, rows, constraints = 0;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(terms->given, &rows, &columns));
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(VecGetLocalSize(terms->t, &nt));
  PetscCheck(columns == n && nt == rows && rows % 2 == 0, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ,
    "T of the norm terms has %" PetscInt_FMT " rows and %" PetscInt_FMT " columns here, t %" PetscInt_FMT
    " entries; two rows per term are required, and as many columns as the solution has entries, %" PetscInt_FMT,
    rows, columns, nt, n);
  if (terms->limit) {
    PetscCall(VecGetLocalSize(terms->limit, &nt));
    PetscCheck(2 * nt == rows, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ,
      "There must be one limit per norm term, but there are %" PetscInt_FMT " terms and %" PetscInt_FMT " limits",
      rows / 2, nt);
  }
  if (terms->coefficient) {
    PetscCall(VecGetLocalSize(terms->coefficient, &nt));
    if (tao->ineq_constrained) PetscCall(VecGetLocalSize(tao->constraints_inequality, &constraints));
    PetscCheck(2 * nt == rows && nt == constraints, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ,
      "Norm terms with coefficients need one coefficient and one term per inequality constraint, but there are "
      "%" PetscInt_FMT " coefficients, %" PetscInt_FMT " terms and %" PetscInt_FMT " constraints",
      nt, rows / 2, constraints);
  }
  PetscCheck(terms->limit || terms->coefficient, comm, PETSC_ERR_ARG_WRONG,
    "Norm terms need limits, coefficients, or both");
  PetscFunctionReturn(0);
}

/* Checks that no weight is negative. weights: may be NULL; kind: "limit" or "coefficient". */
static PetscErrorCode TermsCheckWeights(Tao tao, Vec weights, const char kind[])
{
  PetscReal least;
  PetscInt  term;

  PetscFunctionBegin;
  if (!weights) PetscFunctionReturn(0);
  PetscCall(VecMin(weights, &term, &least));
  PetscCheck(least >= 0.0, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "The %s of norm term %" PetscInt_FMT " must not be negative, but is %g", kind, term, (double)least);
  PetscFunctionReturn(0);
}

/* Removes the component of v along `rigid`, which is a unit vector or zero */
void IPTermRemoveRigid(const PetscScalar rigid[2], PetscScalar v[2])
{
  const PetscScalar along = rigid[0] * v[0] + rigid[1] * v[1];

  for (PetscInt a = 0; a < 2; a++) v[a] -= along * rigid[a];
}

/* Computes v = T x + t without the components in directions in which terms cannot move */
PetscErrorCode IPTermsValue(Tao tao, Vec x, Vec v)
{
  IPTerms           *terms = ((TAO_IPFILTER *)tao->data)->terms;
  const PetscScalar *rigid;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MatMultAdd(terms->given, x, terms->t, v));
  PetscCall(VecGetLocalSize(terms->rho, &n));
  PetscCall(VecGetArrayRead(terms->rigid, &rigid));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < n; i++) IPTermRemoveRigid(rigid + 2 * i, a + 2 * i);
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(VecRestoreArrayRead(terms->rigid, &rigid));
  PetscFunctionReturn(0);
}

/* Returns whether only the alternative to the interior point method can solve the problem */
PetscBool IPNeedsMethod(const TAO_IPFILTER *ip)
{
  return (PetscBool)(ip->terms->n > 0 || ip->sides->compliance);
}

/* Sets up the terms for a solve, except for their resistances */
PetscErrorCode IPTermsSetUp(Tao tao)
{
  IPTerms *terms = ((TAO_IPFILTER *)tao->data)->terms;
  PetscInt n;

  PetscFunctionBegin;
  terms->n = 0;
  if (!terms->given) PetscFunctionReturn(0);
  PetscCall(TermsCheckSizes(tao));
  PetscCall(TermsCheckWeights(tao, terms->limit, "limit"));
  PetscCall(TermsCheckWeights(tao, terms->coefficient, "coefficient"));
  PetscCall(MatGetSize(terms->given, &terms->n, NULL));
  terms->n /= 2;
  PetscCall(TermsTakeMatrix(tao));
  if (!terms->force) {
    PetscCall(VecDuplicate(terms->t, &terms->force));
    PetscCall(VecDuplicate(terms->t, &terms->best));
    PetscCall(VecDuplicate(terms->t, &terms->last));
    PetscCall(VecDuplicate(terms->t, &terms->rigid));
    PetscCall(VecGetLocalSize(terms->t, &n));
    PetscCall(VecCreate(PetscObjectComm((PetscObject)tao), &terms->rho));
    PetscCall(VecSetSizes(terms->rho, n / 2, PETSC_DETERMINE));
    PetscCall(VecSetType(terms->rho, VECSTANDARD));
  }
  if (terms->warm) PetscCall(VecCopy(terms->warm, terms->force));
  else PetscCall(VecSet(terms->force, 0.0));
  PetscCall(VecZeroEntries(terms->rigid));
  PetscFunctionReturn(0);
}

/* Sets up no terms, as matrix and vectors without rows, unless there are terms */
PetscErrorCode IPTermsSetNone(Tao tao)
{
  IPTerms *terms = ((TAO_IPFILTER *)tao->data)->terms;
  MPI_Comm comm  = PetscObjectComm((PetscObject)tao);
  PetscInt n;

  PetscFunctionBegin;
  if (terms->given) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(MatCreateAIJ(comm, 0, n, 0, PETSC_DETERMINE, 0, NULL, 0, NULL, &terms->given));
  PetscCall(MatAssemblyBegin(terms->given, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(terms->given, MAT_FINAL_ASSEMBLY));
  PetscCall(VecCreate(comm, &terms->t));
  PetscCall(VecSetSizes(terms->t, 0, 0));
  PetscCall(VecSetType(terms->t, VECSTANDARD));
  PetscCall(VecDuplicate(terms->t, &terms->limit));
  PetscCall(IPTermsSetUp(tao));
  PetscFunctionReturn(0);
}

/* Subtracts T^T tau from r */
PetscErrorCode IPTermsSubtractForces(Tao tao, Vec r)
{
  IPTerms *terms = ((TAO_IPFILTER *)tao->data)->terms;
  Vec      force;

  PetscFunctionBegin;
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
  PetscCall(MatMultTranspose(terms->T, terms->force, force));
  PetscCall(VecAXPY(r, -1.0, force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &force));
  PetscFunctionReturn(0);
}

PetscReal IPTermBound(PetscReal limit, PetscReal coefficient, PetscReal force)
{
  if (coefficient < 0.0) return limit; /* a negative coefficient means that the bound does not depend on a constraint */
  if (!(force > 0.0) || coefficient == 0.0) return 0.0;
  return coefficient >= PETSC_INFINITY ? limit : PetscMin(limit, coefficient * force);
}

/* Returns |tau - P(tau - rho v)| / rho for one term, where P projects onto the disc of radius `bound` */
PetscReal IPTermViolation(const PetscScalar tau[2], const PetscScalar v[2], PetscReal rho, PetscReal bound)
{
  PetscReal b[2], size, square = 0.0;

  for (PetscInt a = 0; a < 2; a++) b[a] = PetscRealPart(tau[a] - rho * v[a]);
  size = PetscSqrtReal(b[0] * b[0] + b[1] * b[1]);
  for (PetscInt a = 0; a < 2; a++)
    square += PetscSqr(PetscRealPart(tau[a]) - (size > bound ? bound * b[a] / size : b[a]));
  return PetscSqrtReal(square) / rho;
}

/* Computes the bounds b of all terms. force: forces M lambda of the constraints. */
static PetscErrorCode TermsGetBounds(Tao tao, Vec force, Vec bounds)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  IPTerms           *terms = ip->terms;
  const PetscScalar *limit = NULL, *coefficient = NULL, *scale = NULL, *f;
  PetscScalar       *b;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(bounds, &n));
  PetscCall(VecGetArrayWrite(bounds, &b));
  PetscCall(VecGetArrayRead(force, &f));
  if (terms->limit) PetscCall(VecGetArrayRead(terms->limit, &limit));
  if (terms->coefficient) PetscCall(VecGetArrayRead(terms->coefficient, &coefficient));
  if (ip->rows->inequality) PetscCall(VecGetArrayRead(ip->rows->inequality, &scale));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal most = limit ? PetscRealPart(limit[i]) : PETSC_INFINITY;

    b[i] = coefficient ? IPTermBound(most, PetscRealPart(coefficient[i]),
                           PetscRealPart(f[i]) * (scale ? PetscRealPart(scale[i]) : 1.0))
                       : most;
  }
  if (ip->rows->inequality) PetscCall(VecRestoreArrayRead(ip->rows->inequality, &scale));
  if (terms->coefficient) PetscCall(VecRestoreArrayRead(terms->coefficient, &coefficient));
  if (terms->limit) PetscCall(VecRestoreArrayRead(terms->limit, &limit));
  PetscCall(VecRestoreArrayRead(force, &f));
  PetscCall(VecRestoreArrayWrite(bounds, &b));
  PetscFunctionReturn(0);
}

/*
   Computes sum_i b_i |v_i(x)|, with b for the forces M lambda of the constraints. Terms that cannot move are left out,
   since they are constant.
*/
PetscErrorCode IPTermsSum(Tao tao, Vec x, Vec force, PetscReal *sum)
{
  IPTerms           *terms = ((TAO_IPFILTER *)tao->data)->terms;
  const PetscScalar *b, *v, *rho;
  PetscInt           n;
  Vec                bounds, value;

  PetscFunctionBegin;
  *sum = 0.0;
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(terms->rho, &bounds));
  PetscCall(VecDuplicate(terms->t, &value));
  PetscCall(TermsGetBounds(tao, force, bounds));
  PetscCall(IPTermsValue(tao, x, value));
  PetscCall(VecGetLocalSize(bounds, &n));
  PetscCall(VecGetArrayRead(bounds, &b));
  PetscCall(VecGetArrayRead(value, &v));
  PetscCall(VecGetArrayRead(terms->rho, &rho));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal size = PetscSqrtReal(PetscSqr(PetscAbsScalar(v[2 * i])) + PetscSqr(PetscAbsScalar(v[2 * i + 1])));

    if (size > 0.0 && PetscRealPart(rho[i]) > 0.0)
      *sum +=
        size * (PetscRealPart(b[i]) < PETSC_INFINITY ? PetscRealPart(b[i]) : IP_HARD * PetscRealPart(rho[i]) * size);
  }
  PetscCall(VecRestoreArrayRead(terms->rho, &rho));
  PetscCall(VecRestoreArrayRead(value, &v));
  PetscCall(VecRestoreArrayRead(bounds, &b));
  PetscCall(VecDestroy(&value));
  PetscCall(VecDestroy(&bounds));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/* Creates the values of the terms at the present point, and the bounds of their forces there */
static PetscErrorCode TermsEvaluate(Tao tao, Vec *value, Vec *bounds)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(ip->terms->t, value));
  PetscCall(VecDuplicate(ip->terms->rho, bounds));
  PetscCall(IPTermsValue(tao, tao->solution, *value));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(VecPointwiseMult(force, ip->at.lambda, ip->pair[IP_SLACK].w));
  PetscCall(TermsGetBounds(tao, force, *bounds));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscFunctionReturn(0);
}

/*
   Computes the largest violation of a term's law, as a length: slip that the term's force does not oppose, or the
   excess of the force over its bound divided by rho
*/
PetscErrorCode IPTermsViolation(Tao tao, PetscReal *largest)
{
  IPTerms           *terms = ((TAO_IPFILTER *)tao->data)->terms;
  const PetscScalar *tau, *value, *rho, *b;
  PetscReal          local = 0.0;
  PetscInt           n;
  Vec                v, bounds;

  PetscFunctionBegin;
  *largest = 0.0;
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(TermsEvaluate(tao, &v, &bounds));
  PetscCall(VecGetLocalSize(terms->rho, &n));
  PetscCall(VecGetArrayRead(v, &value));
  PetscCall(VecGetArrayRead(bounds, &b));
  PetscCall(VecGetArrayRead(terms->force, &tau));
  PetscCall(VecGetArrayRead(terms->rho, &rho));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(rho[i]) > 0.0)
      local = PetscMax(local, IPTermViolation(tau + 2 * i, value + 2 * i, PetscRealPart(rho[i]), PetscRealPart(b[i])));
  }
  PetscCall(VecRestoreArrayRead(terms->rho, &rho));
  PetscCall(VecRestoreArrayRead(terms->force, &tau));
  PetscCall(VecRestoreArrayRead(bounds, &b));
  PetscCall(VecRestoreArrayRead(v, &value));
  PetscCall(VecDestroy(&bounds));
  PetscCall(VecDestroy(&v));
  PetscCallMPI(MPI_Allreduce(&local, largest, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/*
   Sets the forces of terms that no unknown moves, such as friction of a vertex that is driven over a rigid body:
   tau = -b v / |v|, with their constant v. They are no forces on x, so that the method leaves them out.
*/
PetscErrorCode IPTermsSetUnmoved(Tao tao)
{
  IPTerms           *terms   = ((TAO_IPFILTER *)tao->data)->terms;
  const PetscReal    unmoved = 1e-6; /* smallest motion that counts, relative to the largest motion of all */
  const PetscScalar *v, *rho, *b;
  PetscScalar       *tau;
  PetscReal          sizes[2];
  PetscInt           n;
  Vec                value, bounds;

  PetscFunctionBegin;
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(TermsEvaluate(tao, &value, &bounds));
  PetscCall(VecNorm(value, NORM_INFINITY, &sizes[0]));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &sizes[1]));
  PetscCall(VecGetLocalSize(terms->rho, &n));
  PetscCall(VecGetArrayRead(value, &v));
  PetscCall(VecGetArrayRead(bounds, &b));
  PetscCall(VecGetArrayRead(terms->rho, &rho));
  PetscCall(VecGetArray(terms->force, &tau));
  for (PetscInt i = 0; i < n; i++) {
    const PetscScalar *at     = &v[2 * i];
    const PetscReal    size   = PetscSqrtReal(PetscSqr(PetscAbsScalar(at[0])) + PetscSqr(PetscAbsScalar(at[1])));
    const PetscBool    slides = (PetscBool)(size > unmoved * PetscMax(sizes[0], sizes[1]));

    if (PetscRealPart(rho[i]) > 0.0 || PetscRealPart(b[i]) >= PETSC_INFINITY) continue;
    for (PetscInt a = 0; a < 2; a++) tau[2 * i + a] = slides ? -b[i] * at[a] / size : 0.0;
  }
  PetscCall(VecRestoreArray(terms->force, &tau));
  PetscCall(VecRestoreArrayRead(terms->rho, &rho));
  PetscCall(VecRestoreArrayRead(bounds, &b));
  PetscCall(VecRestoreArrayRead(value, &v));
  PetscCall(VecDestroy(&bounds));
  PetscCall(VecDestroy(&value));
  PetscFunctionReturn(0);
}

static PetscErrorCode TermsReference(Vec given, Vec *own)
{
  PetscFunctionBegin;
  if (given) PetscCall(PetscObjectReference((PetscObject)given));
  *own = given;
  PetscFunctionReturn(0);
}

PetscErrorCode TaoIPFilterSetNormTerms_IPFilter(Tao tao, Mat T, Vec t, Vec limit, Vec coefficient)
{
  IPTerms *terms = ((TAO_IPFILTER *)tao->data)->terms;

  PetscFunctionBegin;
  if (T) PetscCall(PetscObjectReference((PetscObject)T));
  PetscCall(IPTermsDestroy(terms));
  terms->given = T;
  if (!T) PetscFunctionReturn(0);
  PetscCall(TermsReference(t, &terms->t));
  PetscCall(TermsReference(limit, &terms->limit));
  PetscCall(TermsReference(coefficient, &terms->coefficient));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoIPFilterSetNormTermForces_IPFilter(Tao tao, Vec force)
{
  IPTerms *terms = ((TAO_IPFILTER *)tao->data)->terms;

  PetscFunctionBegin;
  if (!terms->warm) PetscCall(VecDuplicate(force, &terms->warm));
  PetscCall(VecCopy(force, terms->warm));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoIPFilterGetNormTermForces_IPFilter(Tao tao, Vec *force)
{
  PetscFunctionBegin;
  *force = ((TAO_IPFILTER *)tao->data)->terms->force;
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetNormTerms - Adds terms sum_i b_i |T_i x + t_i| to the objective, with weights that may depend on the
  multipliers of inequality constraints (friction)

  Collective

  Input Parameters:
+ tao         - the `TAOIPFILTER`
. T           - matrix of type `MATAIJ`, two rows per term, columns laid out as the solution; NULL removes the terms
. t           - two entries per term, laid out as the rows of T; ignored if T is NULL
. limit       - largest weight of each term, not negative; NULL: no limit
- coefficient - coefficient of each term, not negative: its weight is the coefficient times the force of the inequality
                constraint with the same local number on this rank, at most the limit; NULL: the weights are the limits

  Level: intermediate

  Notes:
  b_i = min(limit_i, coefficient_i y_i), where y_i is the multiplier of inequality constraint i as
  `TaoGetDualVariables()` returns it. A limit of `PETSC_INFINITY` means no limit. A coefficient of `PETSC_INFINITY`
  means an unlimited weight (stick), whatever the force of the constraint. With coefficients there must be as many terms
  as constraints.

  With limits only, this is a minimization (group lasso, Tresca's friction). With coefficients it is Coulomb's friction,
  which is not a minimization: the solution x, y, tau satisfies grad f = J^T y + T^T tau, |tau_i| <= b_i, and tau_i =
  -b_i v_i / |v_i| where v_i = T_i x + t_i is not zero. For large coefficients there may be no solution, or several.
  Terms with a coefficient above 100 and without a limit stick while their constraints are closed.

  Norm terms require that all constraints are linear inequalities. The solve begins with a semismooth Newton method from
  the given forces. If that makes no progress, or there are no forces, an interior point method on second-order cones
  follows, and Newton's method from its end. Both know the objective only by systems with K + R^T D R, where R has the
  rows of the constraints and of T, and D a block of 3 x 3 entries for each constraint with its term. The systems are
  solved in the subspace of the unknowns of R and of directions. A nonquadratic objective is minimized by
  Newton's method with such problems. The KKT error includes the residuals of the laws: the largest distance of tau_i
  from its projection to |tau_i| <= b_i, divided by the stiffness of the unknowns in T_i.

  Matrix and vectors are referenced: they must not change during `TaoSolve()`.

  Errors if sizes do not match, or a limit or coefficient is negative. The solve ends with `TAO_DIVERGED_USER` if the
  problem is of another kind, or no solution of the laws is found.

  References:
+ * - P. Alart and A. Curnier, A mixed formulation for frictional contact problems prone to Newton like solution
      methods, Comput. Methods Appl. Mech. Engrg. 92 (1991)
. * - V. Acary, F. Cadoux, C. Lemarechal and J. Malick, A formulation of the linear discrete Coulomb friction problem
      via convex optimization, Z. Angew. Math. Mech. 91 (2011)
. * - V. Acary, P. Armand and H. M. Nguyen, High-accuracy computation of rolling friction contact problems, Optim. Eng.
      24 (2023)
. * - G. De Saxce and Z.-Q. Feng, The bipotential method: a constructive approach to design the complete contact law
      with friction and improved numerical algorithms, Math. Comput. Modelling 28 (1998)
- * - M. Yuan and Y. Lin, Model selection and estimation in regression with grouped variables, J. R. Statist. Soc. B
      68 (2006)

.seealso: `TAOIPFILTER`, `TaoIPFilterGetNormTermForces()`, `TaoIPFilterSetNormTermForces()`, `TaoIPFilterSetSubspace()`
@*/
PetscErrorCode TaoIPFilterSetNormTerms(Tao tao, Mat T, Vec t, Vec limit, Vec coefficient)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  if (T) PetscValidHeaderSpecific(T, MAT_CLASSID, 2);
  if (T) PetscValidHeaderSpecific(t, VEC_CLASSID, 3);
  if (limit) PetscValidHeaderSpecific(limit, VEC_CLASSID, 4);
  if (coefficient) PetscValidHeaderSpecific(coefficient, VEC_CLASSID, 5);
  PetscTryMethod(tao, "TaoIPFilterSetNormTerms_C", (Tao, Mat, Vec, Vec, Vec), (tao, T, t, limit, coefficient));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetNormTermForces - Sets the initial forces of norm terms

  Logically Collective

  Input Parameters:
+ tao   - the `TAOIPFILTER`, after `TaoIPFilterSetNormTerms()`
- force - two entries per term, laid out as the rows of T; copied

  Level: intermediate

.seealso: `TAOIPFILTER`, `TaoIPFilterSetNormTerms()`, `TaoIPFilterGetNormTermForces()`, `TaoIPFilterSetWarmStart()`
@*/
PetscErrorCode TaoIPFilterSetNormTermForces(Tao tao, Vec force)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscValidHeaderSpecific(force, VEC_CLASSID, 2);
  PetscTryMethod(tao, "TaoIPFilterSetNormTermForces_C", (Tao, Vec), (tao, force));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterGetNormTermForces - Gets the forces tau of the norm terms, with grad f = J^T y + T^T tau

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. force - two entries per term, laid out as the rows of T; owned by `tao`; NULL before a solve with norm terms

  Level: intermediate

.seealso: `TAOIPFILTER`, `TaoIPFilterSetNormTerms()`, `TaoIPFilterSetNormTermForces()`
@*/
PetscErrorCode TaoIPFilterGetNormTermForces(Tao tao, Vec *force)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscAssertPointer(force, 2);
  PetscUseMethod(tao, "TaoIPFilterGetNormTermForces_C", (Tao, Vec *), (tao, force));
  PetscFunctionReturn(0);
}
