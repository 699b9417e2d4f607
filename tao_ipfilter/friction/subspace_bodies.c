/* The interface ContactBodies of the bodies of an optimizer; see subspace_bodies.h */
#include "subspace_bodies.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/* Destroys the vectors with an entry for each unknown */
static PetscErrorCode BodiesDestroyVectors(SubspaceBodies b)
{
  Vec *const vectors[] = {&b->x, &b->dx, &b->r, &b->Kx, &b->Kdx, &b->g, &b->kept_x, &b->kept_Kx, &b->base, &b->rhs,
    &b->first};

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(vectors); k++) PetscCall(VecDestroy(vectors[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode SubspaceBodiesDestroy(SubspaceBodies *bodies)
{
  SubspaceBodies b = *bodies;

  PetscFunctionBegin;
  if (!b) PetscFunctionReturn(0);
  PetscCall(BodiesDestroyVectors(b));
  PetscCall(BodiesDestroySpace(b));
  PetscCall(MatDestroy(&b->R));
  PetscCall(PetscFree2(b->factored, b->rest));
  PetscCall(PetscFree(*bodies));
  PetscFunctionReturn(0);
}

/*
   Creates the bodies for the present Hessian and constraints of the optimizer, with n contacts on this rank. W has the
   unknowns of the contacts.
*/
PetscErrorCode SubspaceBodiesCreate(Tao tao, IPRecycle *recycle, IS W, PetscInt n, SubspaceBodies *bodies)
{
  TAO_IPFILTER  *ip = (TAO_IPFILTER *)tao->data;
  SubspaceBodies b;
  Vec           *like_x[9];

  PetscFunctionBegin;
  PetscCall(PetscNew(bodies));
  b          = *bodies;
  b->tao     = tao;
  b->recycle = recycle;
  b->K       = ip->hess->H;
  PetscCall(BodiesCreateRows(ip->jac->inequality, ip->terms->T, n, &b->R));
  PetscCall(BodiesCreateSpace(b, W));
  PetscCall(PetscMalloc2(9 * n, &b->factored, 9 * n, &b->rest));
  PetscCall(PetscArraycpy(like_x,
    ((Vec *[]){&b->x, &b->dx, &b->r, &b->Kx, &b->Kdx, &b->kept_x, &b->kept_Kx, &b->base, &b->rhs}), 9));
  for (PetscInt k = 0; k < 9; k++) PetscCall(VecDuplicate(tao->solution, like_x[k]));
  PetscFunctionReturn(0);
}

/* Sets the origin x = 0: a point with the gradient g */
PetscErrorCode SubspaceBodiesCentre(SubspaceBodies b, Vec g)
{
  PetscFunctionBegin;
  if (!b->g) PetscCall(VecDuplicate(g, &b->g));
  PetscCall(VecCopy(g, b->g));
  PetscCall(VecZeroEntries(b->x));
  PetscCall(VecZeroEntries(b->Kx));
  PetscCall(VecDestroy(&b->first));
  b->load_norm = 0.0;
  PetscFunctionReturn(0);
}

/* Sets the residual [2-norm] that any solve may leave */
void SubspaceBodiesSetEnough(SubspaceBodies b, PetscReal enough)
{
  b->enough = enough;
}

/* Gets x, which is relative to the origin */
Vec SubspaceBodiesGet(SubspaceBodies b)
{
  return b->x;
}

/* Computes the compliance of each contact's normal component, and the larger one of its tangential components, as if no
   unknown moved any other [length/force] */
PetscErrorCode SubspaceBodiesGetCompliance(SubspaceBodies b, PetscInt n, PetscReal compliance[])
{
  PetscInt           start;
  const PetscScalar *k;
  PetscReal          sum[3];
  Mat                squares;
  Vec                inverse;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(b->on_W, &inverse));
  PetscCall(VecISCopy(((TAO_IPFILTER *)b->tao->data)->stiff->hdiag, b->W, SCATTER_REVERSE, inverse));
  PetscCall(VecReciprocal(inverse));
  PetscCall(MatDuplicate(b->RW, MAT_COPY_VALUES, &squares));
  PetscCall(MatGetOwnershipRange(squares, &start, NULL));
  for (PetscInt part = 0; part < 2; part++) {
    Mat          local = NULL;
    PetscScalar *values;
    MatInfo      info;
    PetscMPIInt  size;

    PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)squares), &size));
    if (size == 1) local = part ? NULL : squares;
    else PetscCall(MatMPIAIJGetSeqAIJ(squares, part ? NULL : &local, part ? &local : NULL, NULL));
    if (!local) continue;
    PetscCall(MatGetInfo(local, MAT_LOCAL, &info));
    PetscCall(MatSeqAIJGetArray(local, &values));
    for (PetscInt j = 0; j < (PetscInt)info.nz_used; j++) values[j] *= values[j];
    PetscCall(MatSeqAIJRestoreArray(local, &values));
  }
  PetscCall(MatMult(squares, inverse, b->rows));
  PetscCall(VecGetArrayRead(b->rows, &k));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt a = 0; a < 3; a++) sum[a] = PetscRealPart(k[3 * i + a]);
    compliance[2 * i]     = sum[0];
    compliance[2 * i + 1] = PetscMax(sum[1], sum[2]);
  }
  PetscCall(VecRestoreArrayRead(b->rows, &k));
  PetscCall(MatDestroy(&squares));
  PetscCall(VecDestroy(&inverse));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesResidual(void *data, const PetscReal f[], PetscReal *size)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  PetscCall(BodiesSpread(b, f, PETSC_FALSE, b->r));
  PetscCall(VecAYPX(b->r, -1.0, b->g));
  PetscCall(VecAXPY(b->r, 1.0, b->Kx));
  if (b->first) PetscCall(VecAXPY(b->r, -b->lacks, b->first));
  PetscCall(IPFixedZero(b->tao, b->r));
  if (size) PetscCall(BodiesSize(b, b->r, size));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesWork(void *data, PetscReal *work)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  PetscScalar          dot;

  PetscFunctionBegin;
  PetscCall(VecDot(b->r, b->dx, &dot));
  *work = PetscRealPart(dot);
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesLoad(void *data, PetscReal fraction)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  if (!b->first) {
    PetscCall(VecDuplicate(b->r, &b->first));
    PetscCall(VecCopy(b->r, b->first));
  }
  b->lacks = 1.0 - fraction;
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesAdvance(void *data, PetscReal fraction)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  PetscCall(VecAXPY(b->x, fraction, b->dx));
  PetscCall(VecAXPY(b->Kx, fraction, b->Kdx));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesKeep(void *data, PetscBool back)
{
  const SubspaceBodies b = (SubspaceBodies)data;

  PetscFunctionBegin;
  PetscCall(VecCopy(back ? b->kept_x : b->x, back ? b->x : b->kept_x));
  PetscCall(VecCopy(back ? b->kept_Kx : b->Kx, back ? b->Kx : b->kept_Kx));
  PetscFunctionReturn(0);
}

static PetscErrorCode BodiesInterrupted(void *data, PetscBool *stop)
{
  PetscFunctionBegin;
  PetscCall(IPSubspaceInterrupted(((SubspaceBodies)data)->tao, stop));
  PetscFunctionReturn(0);
}

/* Gets the interface of the bodies that the laws of contacts use */
ContactBodies SubspaceBodiesInterface(SubspaceBodies b)
{
  const ContactBodies bodies = {
    .data         = b,
    .definite     = ((TAO_IPFILTER *)b->tao->data)->given->definite,
    .residual     = BodiesResidual,
    .prepare      = BodiesPrepare,
    .solve        = BodiesSolve,
    .solve_normal = BodiesSolveNormal,
    .work         = BodiesWork,
    .load         = BodiesLoad,
    .advance      = BodiesAdvance,
    .keep         = BodiesKeep,
    .interrupted  = BodiesInterrupted,
  };

  return bodies;
}
