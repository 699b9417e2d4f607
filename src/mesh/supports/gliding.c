/*
   Motions in which a body glides along its own contact faces, such as the rotation of a pin about its axis. Its
   frictionless pairs do not resist them. The normals of facets deviate from those of the surface, so that unstructured
   meshes seem to resist. Displacements, springs, ties and friction resist however small their lever is: only motions
   that these leave free can glide.
*/
#include "supportsimpl.h"
#include <vector3.h>
#include <petscblaslapack.h>

#define SUPPORT_MODES 6 /* modes of one body */

/*
   Mean square of the velocity along the normals over the mean square of the velocity on the contact faces, below which
   a motion glides. It is 0.008 for a rotating prism of 12 sides divided into triangles, the coarsest surface without
   sharp edges, and 0.034 for a regular decagon.
*/
static const PetscReal gliding_resistance = 0.015;

/* least variance of the velocity of a rotation, over its mean square; a shallow arc moves almost as in a translation */
static const PetscReal rotation_spread = 0.1;

/* Computes v^T A w for a 6 x 6 matrix A */
static PetscReal SupportMultiply(const PetscReal A[36], const PetscReal v[], const PetscReal w[])
{
  PetscReal sum = 0;

  for (PetscInt k = 0; k < 36; ++k) sum += v[k / 6] * A[k] * w[k % 6];
  return sum;
}

/* Returns the variance of the velocity of a motion over its mean square: 0 for a translation, 1 for the rotation of a
   whole round face about its axis */
static PetscReal SupportGetSpread(const PetscReal motion[], const PetscReal moved[SUPPORT_MODES])
{
  const PetscReal square  = SupportMultiply(motion, moved, moved);
  PetscReal       mean[3] = {0};

  for (PetscInt k = 0; k < 18; ++k) mean[k / 6] += motion[k] * moved[k % 6];
  return square > 0 ? 1 - VectorDot(mean, mean) / (motion[0] * square) : 0;
}

/* Describes the rotation among n gliding motions of body b, which are the rows of y */
static PetscErrorCode SupportDescribeRotation(const Support *support, PetscInt b, const PetscReal motion[], PetscInt n,
  PetscReal y[SUPPORT_MODES][SUPPORT_MODES], MeshRotation *rotation)
{
  const PetscBLASInt three = 3, lwork = 102;
  PetscBLASInt       info;
  PetscReal          turn[3][3] = {{0}}, value[3], work[102], moved[SUPPORT_MODES] = {0}, arm[3], size;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt i = 0; i < 9; ++i) turn[i / 3][i % 3] += y[k][3 + i / 3] * y[k][3 + i % 3];
  }
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "L", &three, &turn[0][0], &three, value, work, &lwork, &info));
  for (PetscInt d = 0; d < 3; ++d) rotation->axis[d] = turn[2][d]; /* the axis about which it turns most */
  rotation->any = (PetscBool)(value[0] + value[1] > 0.1 * value[2]);
  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt i = 0; i < SUPPORT_MODES; ++i) moved[i] += VectorDot(y[k] + 3, rotation->axis) * y[k][i];
  }
  VectorCross(moved + 3, moved, arm);
  size           = VectorDot(moved + 3, moved + 3);
  rotation->free = (PetscBool)(size > 0 && SupportGetSpread(motion, moved) > rotation_spread);
  rotation->size = support->size[b];
  for (PetscInt d = 0; d < 3 && rotation->free; ++d)
    rotation->point[d] = support->center[b][d] + support->size[b] * arm[d] / size;
  PetscFunctionReturn(0);
}

/* Computes the motions y[0], ..., y[*n - 1] that glide among those that the restraints `held` leave free */
static PetscErrorCode SupportSolveGliding(const PetscReal held[36], const SupportContact *body,
  PetscReal y[SUPPORT_MODES][SUPPORT_MODES], PetscInt *n)
{
  const PetscReal    regular = 1e-6; /* keeps the matrix of velocities on a point or a line positive definite */
  const PetscBLASInt type = 1, lwork = 34 * SUPPORT_MODES;
  PetscReal          Z[36], A[36], M[36], value[SUPPORT_MODES], work[34 * SUPPORT_MODES];
  PetscBLASInt       size, info;
  PetscInt           nfree;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(PetscArraycpy(Z, held, 36));
  PetscCall(SupportFindNull(SUPPORT_MODES, Z, &nfree));
  if (!nfree) PetscFunctionReturn(0);
  for (PetscInt k = 0; k < nfree * nfree; ++k) {
    const PetscReal *v = &Z[SUPPORT_MODES * (k / nfree)], *w = &Z[SUPPORT_MODES * (k % nfree)];

    A[k] = SupportMultiply(body->normal, v, w);
    M[k] = SupportMultiply(body->motion, v, w) + (k / nfree == k % nfree ? regular * body->motion[0] : 0);
  }
  PetscCall(PetscBLASIntCast(nfree, &size));
  PetscCallBLAS("LAPACKsygv", LAPACKsygv_(&type, "V", "L", &size, A, &size, M, &size, value, work, &lwork, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKsygv fails with code %" PetscBLASInt_FMT, info);
  for (; *n < nfree && value[*n] < gliding_resistance; ++*n) {
    for (PetscInt i = 0; i < SUPPORT_MODES; ++i) {
      y[*n][i] = 0;
      for (PetscInt k = 0; k < nfree; ++k) y[*n][i] += A[*n * nfree + k] * Z[SUPPORT_MODES * k + i];
    }
  }
  PetscFunctionReturn(0);
}

/* Finds the gliding motions of body b. held: restraints by displacements, springs, ties and friction */
static PetscErrorCode SupportFindGlidingOf(const Support *support, PetscInt b, const PetscReal held[36],
  PetscBool *glides, MeshRotation *rotation)
{
  const SupportContact *body = &support->contact[b];
  PetscReal             y[SUPPORT_MODES][SUPPORT_MODES], along[SUPPORT_MODES] = {0};
  PetscInt              n;

  PetscFunctionBegin;
  PetscCall(SupportSolveGliding(held, body, y, &n));
  *glides = (PetscBool)(n > 0);
  if (!n) PetscFunctionReturn(0);
  PetscCall(SupportDescribeRotation(support, b, body->motion, n, y, rotation));
  for (PetscInt d = 0; d < 3; ++d) along[d] = rotation->axis[d];
  rotation->slides =
    (PetscBool)(!rotation->any && SupportMultiply(held, along, along) + SupportMultiply(body->normal, along, along) <
                                    gliding_resistance * SupportMultiply(body->motion, along, along));
  /* among translations along other directions no rotation stands out */
  if (n != (rotation->any ? 3 : (rotation->slides ? 2 : 1))) rotation->free = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Finds the bodies that can glide if all others are held. glides[b]: whether body b can; rotations[b]: its rotation
   without resistance, if it has one
*/
PetscErrorCode SupportFindGliding(const Support *support, PetscBool glides[], MeshRotation rotations[])
{
  PetscReal(*held)[36];

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(support->nbodies, &held));
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    const PetscInt *body = support->links[l].body;

    for (PetscInt end = 0; end < 2 && support->links[l].kind != SUPPORT_SLIDING; ++end)
      if (body[end] >= 0) SupportAddBlock(support, l, end, held[body[end]]);
  }
  for (PetscInt b = 0; b < support->nbodies; ++b) {
    glides[b]    = PETSC_FALSE;
    rotations[b] = (MeshRotation){PETSC_FALSE};
    if (support->contact[b].motion[0] > 0)
      PetscCall(SupportFindGlidingOf(support, b, held[b], &glides[b], &rotations[b]));
  }
  PetscCall(PetscFree(held));
  PetscFunctionReturn(0);
}
