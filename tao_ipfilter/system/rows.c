/*
   Rows that are condensed into A as J^T D J. On each rank J consists of the Jacobian of c_I, followed by that of
   condensed equality constraints or by the rows of norm terms. Either part may be missing. The rows of norm terms are
   included since the filter must cover them, and since they may be the only support of a body.
   For condensed equality constraints D_i = 1 / (proximal sum_j J_ij^2 / |H_jj|), many times the stiffness that resists
   them. In a restoration step D = 1/delta, which is equivalent to the augmented system.
*/
#include "systemimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/terms.h"

PetscErrorCode IPRowsDestroy(IPRows *rows)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&rows->J));
  PetscCall(VecDestroy(&rows->D));
  PetscCall(VecDestroy(&rows->inequality));
  PetscCall(VecDestroy(&rows->below));
  PetscCall(PetscMemzero(rows, sizeof(*rows)));
  PetscFunctionReturn(0);
}

static PetscBool RowsSameValues(const IPStamp *a, const IPStamp *b)
{
  return (PetscBool)(a->value_id == b->value_id && a->value_state == b->value_state);
}

static PetscBool RowsSamePattern(const IPStamp *a, const IPStamp *b)
{
  return (PetscBool)(a->pattern_id == b->pattern_id && a->pattern_state == b->pattern_state);
}

/*
   Computes rows->J, the Jacobian of c_I followed by `lower`. The matrix is created anew only if a pattern has changed.
   stamp: that of `lower`.
*/
static PetscErrorCode RowsStack(Tao tao, Mat lower, const IPStamp *stamp)
{
  TAO_IPFILTER     *ip   = (TAO_IPFILTER *)tao->data;
  IPRows           *rows = &ip->cond->rows;
  const IPJacobian *jac  = ip->jac;
  PetscBool         same;

  PetscFunctionBegin;
  if (rows->J && RowsSameValues(&rows->source[0], &jac->inequality_stamp) && RowsSameValues(&rows->source[1], stamp))
    PetscFunctionReturn(0);
  same = (PetscBool)(rows->J && RowsSamePattern(&rows->source[0], &jac->inequality_stamp) &&
                     RowsSamePattern(&rows->source[1], stamp));
  if (!same) PetscCall(MatDestroy(&rows->J));
  PetscCall(IPMatrixStack(jac->inequality, lower, same ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX, &rows->J));
  rows->source[0]      = jac->inequality_stamp;
  rows->source[1]      = *stamp;
  rows->stamp.value_id = rows->stamp.pattern_id = ((PetscObject)rows->J)->id;
  PetscCall(PetscObjectStateGet((PetscObject)rows->J, &rows->stamp.value_state));
  PetscCall(MatGetNonzeroState(rows->J, &rows->stamp.pattern_state));
  PetscFunctionReturn(0);
}

/* Sets rows->J to a reference to a single Jacobian; J may be NULL */
static PetscErrorCode RowsTakeOne(Mat J, const IPStamp *stamp, IPRows *rows)
{
  PetscFunctionBegin;
  if (J) PetscCall(PetscObjectReference((PetscObject)J));
  PetscCall(MatDestroy(&rows->J));
  rows->J     = J;
  rows->stamp = *stamp;
  PetscCall(PetscMemzero(rows->source, sizeof(rows->source)));
  PetscFunctionReturn(0);
}

/*
   Returns the matrix that follows the rows of c_I: that of condensed equality constraints or of norm terms; NULL if
   there is none
*/
static Mat RowsBelow(TAO_IPFILTER *ip, const IPStamp **stamp)
{
  if (ip->me && ip->prox->condensed) {
    *stamp = &ip->jac->equality_stamp;
    return ip->jac->equality;
  }
  *stamp = &ip->terms->stamp;
  return ip->terms->n ? ip->terms->T : NULL;
}

/*
   Computes the weights D of the rows that follow those of c_I, if they are not given. The weight of a row with very
   small entries is limited to 100 times the mean weight.
*/
static PetscErrorCode RowsWeigh(Tao tao, Mat J, Vec weights)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal multiple = ip->terms->n ? 1.0 : ip->opt->proximal;
  PetscScalar    *w, sum;
  PetscReal       mean;
  PetscInt        n;

  PetscFunctionBegin;
  if (ip->cond->rows.given) PetscCall(VecCopy(ip->cond->rows.given, weights));
  else if (ip->aug->delta > 0.0) PetscCall(VecSet(weights, 1.0 / ip->aug->delta));
  if (ip->cond->rows.given || ip->aug->delta > 0.0) PetscFunctionReturn(0);
  PetscCall(IPCompliances(tao, J, weights));
  PetscCall(VecSum(weights, &sum));
  PetscCall(VecGetSize(weights, &n));
  mean = PetscRealPart(sum) / n;
  PetscCall(VecGetLocalSize(weights, &n));
  PetscCall(VecGetArray(weights, &w));
  for (PetscInt i = 0; i < n; i++)
    w[i] = mean > 0.0 ? 1.0 / (multiple * PetscMax(PetscRealPart(w[i]), 1e-2 * mean)) : 1.0;
  PetscCall(VecRestoreArray(weights, &w));
  PetscFunctionReturn(0);
}

/* Copies the local part of v into the vector of all weights, starting at local entry `first` */
static PetscErrorCode RowsPlaceWeights(Vec v, Vec all, PetscInt first)
{
  const PetscScalar *from;
  PetscScalar       *to;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &from));
  PetscCall(VecGetArray(all, &to));
  PetscCall(PetscArraycpy(to + first, from, n));
  PetscCall(VecRestoreArray(all, &to));
  PetscCall(VecRestoreArrayRead(v, &from));
  PetscFunctionReturn(0);
}

/* Copies v to *copy, which is created at the first call */
static PetscErrorCode RowsKeep(Vec v, Vec *copy)
{
  PetscFunctionBegin;
  if (!*copy) PetscCall(VecDuplicate(v, copy));
  PetscCall(VecCopy(v, *copy));
  PetscFunctionReturn(0);
}

/* Joins the weights of c_I and of the rows that follow in one vector, rows->D */
static PetscErrorCode RowsJoinWeights(Tao tao, PetscBool below)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPRows       *rows  = &ip->cond->rows;
  PetscInt      first = 0;

  PetscFunctionBegin;
  PetscCall(VecDestroy(&rows->D));
  PetscCall(MatCreateVecs(rows->J, NULL, &rows->D));
  if (ip->mi) {
    PetscCall(VecGetLocalSize(rows->inequality, &first));
    PetscCall(RowsPlaceWeights(rows->inequality, rows->D, 0));
  }
  if (below) PetscCall(RowsPlaceWeights(rows->below, rows->D, first));
  PetscFunctionReturn(0);
}

/* Sets rows->J for the present point, but not the weights */
PetscErrorCode IPRowsTake(Tao tao)
{
  TAO_IPFILTER  *ip   = (TAO_IPFILTER *)tao->data;
  IPRows        *rows = &ip->cond->rows;
  const IPStamp *stamp;
  const Mat      below = RowsBelow(ip, &stamp);

  PetscFunctionBegin;
  if (ip->mi && below) PetscCall(RowsStack(tao, below, stamp));
  else if (below) PetscCall(RowsTakeOne(below, stamp, rows));
  else PetscCall(RowsTakeOne(ip->mi ? ip->jac->inequality : NULL, &ip->jac->inequality_stamp, rows));
  PetscFunctionReturn(0);
}

/* Updates rows and weights. D: weights of the inequality constraints; not used if there are none. */
PetscErrorCode IPRowsUpdate(Tao tao, Vec D)
{
  TAO_IPFILTER  *ip   = (TAO_IPFILTER *)tao->data;
  IPRows        *rows = &ip->cond->rows;
  const IPStamp *stamp;
  const Mat      below = RowsBelow(ip, &stamp);

  PetscFunctionBegin;
  PetscCall(IPRowsTake(tao));
  if (ip->mi) PetscCall(RowsKeep(D, &rows->inequality));
  if (below) {
    PetscCall(VecDestroy(&rows->below));
    PetscCall(MatCreateVecs(below, NULL, &rows->below));
    PetscCall(RowsWeigh(tao, below, rows->below));
  }
  if (rows->J) PetscCall(RowsJoinWeights(tao, (PetscBool)(below != NULL)));
  PetscFunctionReturn(0);
}
