/*
   Solves the normal laws of contacts exactly, while the tangential components have linearized laws. The reduced problem
   of frictionless contact is used for the matrix A_WW.
*/
#include "subspace_bodies.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"

/* Sets up the problem of the normal laws for the matrix A_WW. gaps: the normal components of motions; own: compliance
   of contacts */
static PetscErrorCode BodiesSetUpNormal(SubspaceBodies b, const PetscReal own[], Vec gaps, PetscBool *definite)
{
  PetscInt start, end;
  Vec      compliance;

  PetscFunctionBegin;
  if (!b->JW) {
    IS rows, columns;

    PetscCall(MatGetOwnershipRange(b->RW, &start, &end));
    PetscCall(ISCreateStride(PetscObjectComm((PetscObject)b->RW), (end - start) / 3, start, 3, &rows));
    PetscCall(VecGetOwnershipRange(b->on_W, &start, &end));
    PetscCall(ISCreateStride(PetscObjectComm((PetscObject)b->RW), end - start, start, 1, &columns));
    PetscCall(MatCreateSubMatrix(b->RW, rows, columns, MAT_INITIAL_MATRIX, &b->JW));
    PetscCall(ISDestroy(&rows));
    b->places = columns;
  }
  PetscCall(VecGetLocalSize(gaps, &end));
  PetscCall(VecCreateMPIWithArray(PetscObjectComm((PetscObject)gaps), 1, end, PETSC_DETERMINE, own, &compliance));
  PetscCall(IPReducedSetUp(&b->normal, InterfaceMatrixGet(b->A), b->JW, compliance, b->places, b->W, b->x, gaps,
    &b->recycle->basis, definite));
  PetscCall(VecDestroy(&compliance));
  PetscFunctionReturn(0);
}

/* Centres the problem of the normal laws at the present point. b->rhs: the gradient without normal forces */
static PetscErrorCode BodiesCentreNormal(SubspaceBodies b, Vec gaps)
{
  const IPBasis *basis = &b->recycle->basis;

  PetscFunctionBegin;
  PetscCall(IPBasisDots(basis, 0, basis->n, b->rhs, b->dy));
  PetscCall(IPReducedCenter(&b->normal, b->rhs, gaps, b->dy));
  PetscCall(IPReducedAppend(&b->normal, basis, b->dy));
  PetscFunctionReturn(0);
}

/* Solves the normal laws in the subspace: b->dx, and the normal forces */
static PetscErrorCode BodiesSolveReducedNormal(SubspaceBodies b, Vec force, PetscBool *solved)
{
  PetscFunctionBegin;
  b->normal.system.rounding =
    ((TAO_IPFILTER *)b->tao->data)->first->jacobian * ((TAO_IPFILTER *)b->tao->data)->given->rounding;
  b->normal.system.soft = b->recycle->basis.has_modes;
  PetscCall(VecCopy(b->base, b->dx));
  PetscCall(VecISSet(b->dx, b->W, 0.0));
  PetscCall(IPReducedSolve(&b->normal, b->dy, b->dx, force, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(IPBasisAdd(&b->recycle->basis, b->dy, b->dx));
  PetscCall(VecISCopy(b->base, b->W, SCATTER_REVERSE, b->load));
  PetscCall(VecISAXPY(b->dx, b->W, 1.0, b->load));
  PetscFunctionReturn(0);
}

/*
   Reduces the number of directions. The problem of the normal laws is then centred at dx, which the directions that are
   left do not contain: its gradient b->rhs and the gaps grow by what dx changes.
*/
static PetscErrorCode BodiesMakeRoomNormal(SubspaceBodies b, const PetscReal D[], Vec gaps)
{
  IPBasis           *basis = &b->recycle->basis;
  const PetscScalar *u;
  PetscScalar       *g;
  PetscReal         *E, *springs;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(basis->max * basis->max, &E));
  PetscCall(IPReducedCoupling(&b->normal, basis, E));
  PetscCall(IPSubspaceCompress(b->tao, basis, E));
  PetscCall(PetscFree(E));
  PetscCall(IPReducedForget(&b->normal, basis));
  PetscCall(VecGetLocalSize(gaps, &n));
  PetscCall(PetscMalloc1(3 * n, &springs));
  PetscCall(VecAXPY(b->dx, -1.0, b->base)); /* what this centre adds */
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(VecGetArrayRead(b->rows, &u));
  PetscCall(VecGetArray(gaps, &g));
  for (PetscInt i = 0; i < n; i++) {
    g[i] += u[3 * i];
    ConeMultiply(&D[9 * i], &u[3 * i], &springs[3 * i]);
  }
  PetscCall(VecRestoreArray(gaps, &g));
  PetscCall(VecRestoreArrayRead(b->rows, &u));
  PetscCall(BodiesSpread(b, springs, PETSC_TRUE, b->rhs));
  PetscCall(MatMultAdd(b->K, b->dx, b->rhs, b->rhs));
  PetscCall(IPFixedZero(b->tao, b->rhs));
  PetscCall(VecAXPY(b->base, 1.0, b->dx));
  PetscCall(PetscFree(springs));
  PetscFunctionReturn(0);
}

/* Finds dx and the normal forces to the accuracy that the choice of held contacts needs */
static PetscErrorCode BodiesIterateNormal(SubspaceBodies b, const PetscReal D[], Vec gaps, Vec force, PetscBool *solved)
{
  const PetscReal exact = 1e-11; /* residual that may be left, relative to the largest one: more would decide which
                                   contacts are held */
  PetscReal       norm;
  PetscBool       added;
  Vec             left;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(b->base));
  PetscCall(IPGetWork(b->tao, IP_UNKNOWNS, &left));
  do {
    added = PETSC_FALSE;
    PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    PetscCall(BodiesCentreNormal(b, gaps));
    PetscCall(BodiesSolveReducedNormal(b, force, solved));
    PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
    if (!*solved) break;
    PetscCall(BodiesLeft(b, left, &norm));
    *solved      = (PetscBool)!PetscIsInfOrNanReal(norm);
    b->load_norm = PetscMax(b->load_norm, norm);
    if (!*solved || norm <= PetscMin(exact * b->load_norm, b->enough)) break;
    if (b->recycle->basis.n == b->recycle->basis.max) PetscCall(BodiesMakeRoomNormal(b, D, gaps));
    PetscCall(BodiesExtend(b, left, &added));
  } while (added);
  PetscCall(IPRestoreWork(b->tao, IP_UNKNOWNS, &left));
  PetscFunctionReturn(0);
}

/* Computes du = R dx, and the changes of the forces */
static PetscErrorCode BodiesGetChanges(SubspaceBodies b, const PetscReal own[], const PetscReal D[],
  const PetscReal s[], const PetscReal f[], Vec force, PetscReal du[], PetscReal df[])
{
  const PetscScalar *a, *normal;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(force, &n));
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(VecGetArrayRead(b->rows, &a));
  PetscCall(VecGetArrayRead(force, &normal));
  for (PetscInt i = 0; i < n; i++) {
    PetscReal change[3];

    for (PetscInt r = 3 * i; r < 3 * i + 3; r++) du[r] = PetscRealPart(a[r]);
    ConeMultiply(&D[9 * i], &du[3 * i], change);
    for (PetscInt c = 0; c < 3; c++) df[3 * i + c] = s[3 * i + c] - change[c];
    df[3 * i] = PetscRealPart(normal[i]) + s[3 * i] - f[3 * i];
    du[3 * i] += own[i] * df[3 * i];
  }
  PetscCall(VecRestoreArrayRead(force, &normal));
  PetscCall(VecRestoreArrayRead(b->rows, &a));
  PetscFunctionReturn(0);
}

PetscErrorCode BodiesSolveNormal(void *data, const PetscReal own[], const PetscReal D[], const PetscReal s[],
  const PetscReal f[], const PetscReal u[], PetscReal du[], PetscReal df[], PetscBool *solved)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  PetscScalar         *g;
  PetscInt             n;
  Vec                  gaps, force;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->rows, &n));
  n /= 3;
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)b->rows), n, PETSC_DETERMINE, &gaps));
  PetscCall(VecDuplicate(gaps, &force));
  PetscCall(VecGetArrayWrite(gaps, &g));
  for (PetscInt i = 0; i < n; i++) {
    g[i] = u[3 * i] + own[i] * (s[3 * i] - f[3 * i]); /* with the force s */
    for (PetscInt c = 0; c < 3; c++) df[3 * i + c] = s[3 * i + c] - (c ? 0.0 : f[3 * i]);
  }
  PetscCall(VecRestoreArrayWrite(gaps, &g));
  PetscCall(BodiesSpread(b, df, PETSC_FALSE, b->rhs));
  PetscCall(VecAYPX(b->rhs, -1.0, b->r));
  PetscCall(IPFixedZero(b->tao, b->rhs));
  PetscCall(InterfaceMatrixAssemble(b->A, D));
  PetscCall(BodiesSetUpNormal(b, own, gaps, solved));
  if (*solved) PetscCall(BodiesIterateNormal(b, D, gaps, force, solved));
  if (*solved) PetscCall(BodiesGetChanges(b, own, D, s, f, force, du, df));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&gaps));
  PetscFunctionReturn(0);
}
