/*
   Treats the bounds of TaoSetInequalityBounds(). The iteration sees 0 <= c, or 0 <= c <= range:

     caller's row              seen by the iteration
     l <= c_I, l <= c_I <= u   c = c_I - l
     c_I <= u                  c = u - c_I
     l = u                     an equality constraint c_I - l = 0, after the caller's own ones of this rank
     no bound below 1e19       nothing

   Rows of the last two kinds remain in c as a positive constant with zero gradient, so that c has the caller's layout.
*/
#include "problemimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/rows.h"

PetscErrorCode IPSidesDestroy(IPSides *sides)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&sides->sign));
  PetscCall(VecDestroy(&sides->base));
  PetscCall(VecDestroy(&sides->range));
  PetscCall(VecDestroy(&sides->width));
  PetscCall(VecDestroy(&sides->compliance));
  PetscCall(PetscFree(sides->equal));
  PetscCall(PetscMemzero(sides, sizeof(*sides)));
  PetscFunctionReturn(0);
}

/*
   Returns whether c is measured from the lower bound l. If l is finite but a million times as large as u, the upper
   bound is used instead, since c_I - l would lose digits.
*/
static inline PetscBool FromLower(PetscReal l, PetscReal u)
{
  const PetscReal far = 1e6;

  return (PetscBool)(IPBoundIsFinite(l) && !(IPBoundIsFinite(u) && PetscAbsReal(l) > far * PetscAbsReal(u)));
}

/*
   Classifies one row by its bounds l and u. *sign: 1, -1, or 0 if the row is no inequality; *base: the bound from which
   c is measured; *range: u - l, or PETSC_INFINITY; *equal: the bounds are equal up to rounding.
*/
static void ClassifyRow(PetscReal l, PetscReal u, PetscScalar *sign, PetscScalar *base, PetscScalar *range,
  PetscBool *equal)
{
  *equal = (PetscBool)(IPBoundIsFinite(l) && IPBoundIsFinite(u) &&
                       u - l <= IP_TINY_STEP * PetscMax(PetscAbsReal(l), PetscAbsReal(u)));
  *sign  = *equal ? 0.0 : (FromLower(l, u) ? 1.0 : (IPBoundIsFinite(u) ? -1.0 : 0.0));
  *base  = FromLower(l, u) ? l : (IPBoundIsFinite(u) ? u : 0.0);
  *range = IPBoundIsFinite(l) && IPBoundIsFinite(u) && !*equal ? u - l : PETSC_INFINITY;
}

/* Raises an error on all ranks, with row and values, if a lower bound exceeds its upper bound */
static PetscErrorCode CheckRows(Tao tao, const PetscScalar l[], const PetscScalar u[], PetscInt n)
{
  MPI_Comm  comm      = PetscObjectComm((PetscObject)tao);
  PetscInt  first     = PETSC_MAX_INT, worst, rstart;
  PetscReal bounds[2] = {PETSC_NINFINITY, PETSC_NINFINITY};

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(tao->constraints_inequality, &rstart, NULL));
  for (PetscInt i = n - 1; i >= 0; i--)
    if (!(PetscRealPart(l[i]) <= PetscRealPart(u[i]))) first = rstart + i;
  PetscCallMPI(MPI_Allreduce(&first, &worst, 1, MPIU_INT, MPI_MIN, comm));
  if (worst == PETSC_MAX_INT) PetscFunctionReturn(0);
  if (first == worst) {
    bounds[0] = PetscRealPart(l[worst - rstart]);
    bounds[1] = PetscRealPart(u[worst - rstart]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 2, MPIU_REAL, MPI_MAX, comm));
  SETERRQ(comm, PETSC_ERR_ARG_OUTOFRANGE,
    "Inequality constraint %" PetscInt_FMT " has lower bound %g above upper bound %g", worst, (double)bounds[0],
    (double)bounds[1]);
}

/*
   Sets sign, base and range of all rows, and lists the rows with equal bounds. counts: number of rows that are measured
   from an upper bound or are no inequality; number with two bounds; number with equal bounds; over all ranks.
*/
static PetscErrorCode ClassifyRows(Tao tao, IPSides *sides, PetscInt counts[3])
{
  const PetscScalar *l, *u;
  PetscScalar       *sign, *base, *range;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(sides->sign, &n));
  PetscCall(PetscMalloc1(n, &sides->equal));
  PetscCall(VecGetArrayRead(tao->IL, &l));
  PetscCall(VecGetArrayRead(tao->IU, &u));
  PetscCall(CheckRows(tao, l, u, n));
  PetscCall(VecGetArrayWrite(sides->sign, &sign));
  PetscCall(VecGetArrayWrite(sides->base, &base));
  PetscCall(VecGetArrayWrite(sides->range, &range));
  for (PetscInt i = 0; i < n; i++) {
    PetscBool equal;

    ClassifyRow(PetscRealPart(l[i]), PetscRealPart(u[i]), &sign[i], &base[i], &range[i], &equal);
    if (equal) sides->equal[sides->nequal++] = i;
    counts[0] += PetscRealPart(sign[i]) != 1.0;
    counts[1] += IPBoundIsFinite(PetscRealPart(range[i]));
  }
  PetscCall(VecRestoreArrayWrite(sides->range, &range));
  PetscCall(VecRestoreArrayWrite(sides->base, &base));
  PetscCall(VecRestoreArrayWrite(sides->sign, &sign));
  PetscCall(VecRestoreArrayRead(tao->IU, &u));
  PetscCall(VecRestoreArrayRead(tao->IL, &l));
  counts[2] = sides->nequal;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 3, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/* Classifies all rows by the bounds that the caller has set */
PetscErrorCode IPSidesSetUp(Tao tao)
{
  IPSides *sides     = ((TAO_IPFILTER *)tao->data)->sides;
  PetscInt counts[3] = {0, 0, 0};
  Vec      c         = tao->constraints_inequality;

  PetscFunctionBegin;
  PetscCall(IPSidesDestroy(sides));
  if (!tao->ineq_constrained || !tao->IL || !tao->IU) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(c, &sides->sign));
  PetscCall(VecDuplicate(c, &sides->base));
  PetscCall(VecDuplicate(c, &sides->range));
  PetscCall(ClassifyRows(tao, sides, counts));
  sides->nall = counts[2];
  if (!counts[0]) PetscCall(VecDestroy(&sides->sign));
  if (!counts[1]) PetscCall(VecDestroy(&sides->range));
  PetscFunctionReturn(0);
}

/* Sets up the pairs of the upper sides of rows with two bounds. Their weights are those of the rows' slacks. */
PetscErrorCode IPSidesSetUpPairs(Tao tao)
{
  TAO_IPFILTER      *ip      = (TAO_IPFILTER *)tao->data;
  IPPair            *ceiling = &ip->pair[IP_CEILING];
  const PetscScalar *range, *w;
  PetscReal          sum[2] = {0.0, 0.0}; /* number of these rows; sum of their weights */
  PetscInt           n;

  PetscFunctionBegin;
  if (!ip->sides->range) PetscCall(IPPairDestroy(ceiling));
  if (!ip->sides->range) PetscFunctionReturn(0);
  if (!ceiling->t) PetscCall(IPPairCreate(tao->constraints_inequality, ip->given->slack_mass, -1.0, ceiling));
  else PetscCall(IPPairSetWeights(ip->given->slack_mass, ceiling));
  PetscCall(VecGetLocalSize(ceiling->t, &n));
  PetscCall(VecGetArrayRead(ip->sides->range, &range));
  PetscCall(VecGetArrayRead(ceiling->w, &w));
  for (PetscInt i = 0; i < n; i++) {
    if (!IPBoundIsFinite(PetscRealPart(range[i]))) continue;
    sum[0] += 1.0;
    sum[1] += PetscRealPart(w[i]);
  }
  PetscCall(VecRestoreArrayRead(ceiling->w, &w));
  PetscCall(VecRestoreArrayRead(ip->sides->range, &range));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  ceiling->n      = (PetscInt)sum[0];
  ceiling->weight = sum[1];
  PetscFunctionReturn(0);
}

/*
   Updates the widths of rows with two bounds: the range, scaled like the row, plus the relaxation of both bounds. Must
   be called when a scale or the relaxation has changed.
*/
PetscErrorCode IPSidesUpdateWidth(Tao tao)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  IPSides           *sides = ip->sides;
  const PetscScalar *range;
  PetscScalar       *width;
  PetscInt           n;

  PetscFunctionBegin;
  if (!sides->range) PetscFunctionReturn(0);
  if (!sides->width) PetscCall(VecDuplicate(sides->range, &sides->width));
  if (ip->rows->inequality) PetscCall(VecPointwiseMult(sides->width, sides->range, ip->rows->inequality));
  else PetscCall(VecCopy(sides->range, sides->width));
  PetscCall(VecGetLocalSize(sides->range, &n));
  PetscCall(VecGetArrayRead(sides->range, &range));
  PetscCall(VecGetArray(sides->width, &width));
  for (PetscInt i = 0; i < n; i++)
    width[i] = IPBoundIsFinite(PetscRealPart(range[i])) ? width[i] + 2.0 * ip->relax->by : PETSC_INFINITY;
  PetscCall(VecRestoreArray(sides->width, &width));
  PetscCall(VecRestoreArrayRead(sides->range, &range));
  PetscFunctionReturn(0);
}

/* Stores c_I - l of the rows with equal bounds in the last entries of this rank's ce */
static PetscErrorCode TakeEqualRows(const IPSides *sides, Vec c, Vec ce)
{
  const PetscScalar *v, *base;
  PetscScalar       *e;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(ce, &n));
  PetscCall(VecGetArrayRead(c, &v));
  PetscCall(VecGetArrayRead(sides->base, &base));
  PetscCall(VecGetArray(ce, &e));
  for (PetscInt k = 0; k < sides->nequal; k++) e[n - sides->nequal + k] = v[sides->equal[k]] - base[sides->equal[k]];
  PetscCall(VecRestoreArray(ce, &e));
  PetscCall(VecRestoreArrayRead(sides->base, &base));
  PetscCall(VecRestoreArrayRead(c, &v));
  PetscFunctionReturn(0);
}

/*
   Sets rows that are no inequality to a constant, so that no computed size depends on them: the largest absolute value
   of the other rows at the start
*/
static PetscErrorCode FillVoidRows(IPSides *sides, Vec c)
{
  const PetscScalar *sign;
  PetscScalar       *v;
  PetscInt           n;

  PetscFunctionBegin;
  if (sides->constant == 0.0) PetscCall(VecNorm(c, NORM_INFINITY, &sides->constant));
  if (!(sides->constant > 0.0 && sides->constant < PETSC_INFINITY)) sides->constant = 1.0;
  PetscCall(VecGetLocalSize(c, &n));
  PetscCall(VecGetArrayRead(sides->sign, &sign));
  PetscCall(VecGetArray(c, &v));
  for (PetscInt i = 0; i < n; i++)
    if (PetscRealPart(sign[i]) == 0.0) v[i] = sides->constant;
  PetscCall(VecRestoreArray(c, &v));
  PetscCall(VecRestoreArrayRead(sides->sign, &sign));
  PetscFunctionReturn(0);
}

/*
   Converts the caller's c_I to the form used by the iteration. ce: all equality constraints, of which those from rows
   with equal bounds are set; may be NULL if there are none.
*/
PetscErrorCode IPSidesConstraints(Tao tao, Vec c, Vec ce)
{
  IPSides *sides = ((TAO_IPFILTER *)tao->data)->sides;

  PetscFunctionBegin;
  if (!sides->base) {
    if (tao->IL) PetscCall(VecAXPY(c, -1.0, tao->IL));
    PetscFunctionReturn(0);
  }
  if (sides->nall) PetscCall(TakeEqualRows(sides, c, ce));
  PetscCall(VecAXPY(c, -1.0, sides->base));
  if (!sides->sign) PetscFunctionReturn(0);
  PetscCall(VecPointwiseMult(c, c, sides->sign));
  PetscCall(FillVoidRows(sides, c));
  PetscFunctionReturn(0);
}

/*
   Copies the caller's own equality constraints to the first entries of each rank's vector `all`, or from there if
   `back`
*/
PetscErrorCode IPSidesEquality(Vec own, Vec all, PetscBool back)
{
  PetscScalar *o, *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(own, &n));
  PetscCall(VecGetArray(own, &o));
  PetscCall(VecGetArray(all, &a));
  PetscCall(PetscArraycpy(back ? o : a, back ? a : o, n));
  PetscCall(VecRestoreArray(all, &a));
  PetscCall(VecRestoreArray(own, &o));
  PetscFunctionReturn(0);
}

/*
   Converts DI, the multipliers of the rows as used by the iteration, to the caller's signs and units. y: multipliers of
   all equality constraints, from which rows with equal bounds get theirs.
*/
PetscErrorCode IPSidesMultipliers(Tao tao, Vec y, Vec DI)
{
  const IPSides     *sides = ((TAO_IPFILTER *)tao->data)->sides;
  const PetscScalar *e;
  PetscScalar       *d;
  PetscInt           n;

  PetscFunctionBegin;
  if (!sides->sign) PetscFunctionReturn(0);
  PetscCall(VecPointwiseMult(DI, DI, sides->sign));
  if (!sides->nall) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(y, &n));
  PetscCall(VecGetArrayRead(y, &e));
  PetscCall(VecGetArray(DI, &d));
  for (PetscInt k = 0; k < sides->nequal; k++) d[sides->equal[k]] = -e[n - sides->nequal + k];
  PetscCall(VecRestoreArray(DI, &d));
  PetscCall(VecRestoreArrayRead(y, &e));
  PetscFunctionReturn(0);
}

/*
   Distributes the caller's slacks and multipliers, which are negative for an active upper bound, to the pairs of both
   sides. A side with zero multiplier gets the mean product t z of the other sides.
*/
PetscErrorCode IPSidesTakePairs(Tao tao)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  const IPSides     *sides = ip->sides;
  IPPair            *slack = &ip->pair[IP_SLACK], *ceiling = &ip->pair[IP_CEILING];
  PetscReal          sum[2] = {0.0, 0.0}, mu;
  const PetscScalar *sign   = NULL, *w;
  PetscScalar       *s, *z, *upper = NULL, *t = NULL;
  PetscInt           n;

  PetscFunctionBegin;
  if (!sides->sign && !ceiling->n) PetscFunctionReturn(0);
  PetscCall(IPSlackDistance(tao, slack->t, PETSC_FALSE));
  PetscCall(VecGetLocalSize(slack->t, &n));
  PetscCall(VecGetArrayRead(slack->w, &w));
  PetscCall(VecGetArray(slack->t, &s));
  PetscCall(VecGetArray(slack->z, &z));
  if (sides->sign) PetscCall(VecGetArrayRead(sides->sign, &sign));
  if (ceiling->n) PetscCall(VecGetArray(ceiling->t, &t));
  if (ceiling->n) PetscCall(VecGetArray(ceiling->z, &upper));
  for (PetscInt i = 0; i < n; i++) {
    if (sign) z[i] *= sign[i];
    if (sign && PetscRealPart(sign[i]) == 0.0) s[i] = sides->constant;
    if (upper) upper[i] = IPBoundIsFinite(PetscRealPart(t[i])) ? PetscMax(-PetscRealPart(z[i]), 0.0) : 0.0;
    if (upper && PetscRealPart(upper[i]) > 0.0) z[i] = 0.0;
    sum[0] += PetscRealPart(
      w[i] *
      (PetscRealPart(z[i]) > 0.0 ? s[i] * z[i] : (upper && PetscRealPart(upper[i]) > 0.0 ? t[i] * upper[i] : 0.0)));
    sum[1] += PetscRealPart(z[i]) > 0.0 || (upper && PetscRealPart(upper[i]) > 0.0) ? PetscRealPart(w[i]) : 0.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  mu = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(z[i]) == 0.0 && PetscRealPart(s[i]) > 0.0) z[i] = mu / s[i];
    if (upper && PetscRealPart(upper[i]) == 0.0 && IPBoundIsFinite(PetscRealPart(t[i]))) upper[i] = mu / t[i];
  }
  if (ceiling->n) PetscCall(VecRestoreArray(ceiling->z, &upper));
  if (ceiling->n) PetscCall(VecRestoreArray(ceiling->t, &t));
  if (sides->sign) PetscCall(VecRestoreArrayRead(sides->sign, &sign));
  PetscCall(VecRestoreArray(slack->z, &z));
  PetscCall(VecRestoreArray(slack->t, &s));
  PetscCall(VecRestoreArrayRead(slack->w, &w));
  PetscFunctionReturn(0);
}

/*
   Sets the slacks and multipliers that are returned to the caller, from tao->DI. The multiplier of an active upper
   bound is negative. A row that is no inequality gets a zero slack.
*/
PetscErrorCode IPSidesReturnPairs(Tao tao)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  const IPSides     *sides = ip->sides;
  const PetscScalar *sign = NULL, *range = NULL, *DI, *w;
  PetscScalar       *s, *z;
  PetscInt           n;

  PetscFunctionBegin;
  if (!sides->sign && !sides->range) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(ip->at.s, &n));
  PetscCall(VecGetArrayRead(tao->DI, &DI));
  PetscCall(VecGetArrayRead(ip->pair[IP_SLACK].w, &w));
  if (sides->sign) PetscCall(VecGetArrayRead(sides->sign, &sign));
  if (sides->range) PetscCall(VecGetArrayRead(sides->range, &range));
  PetscCall(VecGetArray(ip->at.s, &s));
  PetscCall(VecGetArray(ip->at.z[IP_SLACK], &z));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal side = sign ? PetscRealPart(sign[i]) : 1.0;

    if (side != 1.0 || (range && IPBoundIsFinite(PetscRealPart(range[i])))) z[i] = DI[i] / w[i];
    if (side == 0.0) s[i] = 0.0;
  }
  PetscCall(VecRestoreArray(ip->at.z[IP_SLACK], &z));
  PetscCall(VecRestoreArray(ip->at.s, &s));
  if (sides->range) PetscCall(VecRestoreArrayRead(sides->range, &range));
  if (sides->sign) PetscCall(VecRestoreArrayRead(sides->sign, &sign));
  PetscCall(VecRestoreArrayRead(ip->pair[IP_SLACK].w, &w));
  PetscCall(VecRestoreArrayRead(tao->DI, &DI));
  PetscFunctionReturn(0);
}
