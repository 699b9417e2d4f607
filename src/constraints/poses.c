/*
   The rigid motion that is nearest to the motion of each body, x1 = c1 + Q (x0 - c0), from the positions of its nodes
   before and after. c0 and c1 are the mean positions, weighted with the mass. Q is the rotation in the polar
   decomposition of the mean deformation gradient.
*/
#include "constraintsimpl.h"
#include <vector3.h>
#include <string.h>

/* Computes the rotation Q in the polar decomposition of F by Newton's method: Q = (Q + Q^-T) / 2 */
static void PoseGetRotation(const PetscReal F[3][3], PetscReal Q[3][3])
{
  const int most = 30;
  PetscReal inverse[3][3], change = 1.0;

  for (int i = 0; i < 9; ++i) Q[i / 3][i % 3] = F[i / 3][i % 3];
  for (int k = 0; k < most && change > PETSC_MACHINE_EPSILON; ++k) {
    change = 0.0;
    (void)MatrixInvert(Q, inverse);
    for (int i = 0; i < 9; ++i) {
      const PetscReal next = 0.5 * (Q[i / 3][i % 3] + inverse[i % 3][i / 3]);

      change          = PetscMax(change, PetscSqr(next - Q[i / 3][i % 3]));
      Q[i / 3][i % 3] = next;
    }
  }
}

/* Computes the rotation vector r [rad] of Q, of length at most pi, from the quaternion */
void PoseGetVector(const PetscReal Q[3][3], PetscReal r[3])
{
  const PetscReal trace = Q[0][0] + Q[1][1] + Q[2][2];
  PetscReal       q[4] = {1.0 + trace, Q[2][1] - Q[1][2], Q[0][2] - Q[2][0], Q[1][0] - Q[0][1]}, sine = 0.0, angle;
  int             i = 0;

  for (int k = 1; k < 3; ++k) i = Q[k][k] > Q[i][i] ? k : i;
  if (Q[i][i] > trace) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;

    q[0]     = Q[k][j] - Q[j][k];
    q[1 + i] = 1.0 + Q[i][i] - Q[j][j] - Q[k][k];
    q[1 + j] = Q[j][i] + Q[i][j];
    q[1 + k] = Q[k][i] + Q[i][k];
  }
  for (int k = 1; k < 4; ++k) sine += PetscSqr(q[k]);
  sine  = PetscSqrtReal(sine);
  angle = 2.0 * PetscAtan2Real(q[0] < 0.0 ? -sine : sine, PetscAbsReal(q[0]));
  for (int k = 0; k < 3; ++k) r[k] = sine > 0.0 ? angle * q[1 + k] / sine : 0.0;
}

/* Sums over the nodes of each body. If poses is NULL, the sums are m x0, m x1 and m; otherwise they are m dx1 dx0^T and
   m dx0 dx0^T about the mean positions. u0 = NULL stands for zero. */
static PetscErrorCode PosesSum(const Bodies *b, Vec u0, Vec u1, const BodyPose poses[], PetscReal sums[][18])
{
  const PetscScalar *x, *m, *a0 = NULL, *a1;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(sums, b->scene->nbodies));
  PetscCall(VecGetLocalSize(b->mass, &n));
  PetscCall(VecGetArrayRead(b->places.x, &x));
  PetscCall(VecGetArrayRead(b->mass, &m));
  if (u0) PetscCall(VecGetArrayRead(u0, &a0));
  PetscCall(VecGetArrayRead(u1, &a1));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscInt  body = b->places.body[i / 3];
    const PetscReal mass = PetscRealPart(m[i]);
    PetscReal       x0[3], x1[3], *sum = sums[body];

    for (int d = 0; d < 3; ++d) {
      x0[d] = PetscRealPart(x[i + d]) + (a0 ? PetscRealPart(a0[i + d]) : 0.0) - (poses ? poses[body].from[d] : 0.0);
      x1[d] = PetscRealPart(x[i + d]) + PetscRealPart(a1[i + d]) - (poses ? poses[body].to[d] : 0.0);
    }
    if (!poses) sum[6] += mass;
    for (int k = 0; !poses && k < 6; ++k) sum[k] += mass * (k < 3 ? x0[k] : x1[k - 3]);
    for (int k = 0; poses && k < 18; ++k) sum[k] += mass * (k < 9 ? x1[k / 3] : x0[(k - 9) / 3]) * x0[k % 3];
  }
  PetscCall(VecRestoreArrayRead(u1, &a1));
  if (u0) PetscCall(VecRestoreArrayRead(u0, &a0));
  PetscCall(VecRestoreArrayRead(b->mass, &m));
  PetscCall(VecRestoreArrayRead(b->places.x, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(18 * b->scene->nbodies), MPIU_REAL, MPIU_SUM, b->comm));
  PetscFunctionReturn(0);
}

/* Collective. Computes the rigid motions of all bodies from displacement u0 (NULL: undeformed) to u1 */
PetscErrorCode PosesFind(const Bodies *b, Vec u0, Vec u1, BodyPose poses[])
{
  PetscReal(*sums)[18];

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(b->scene->nbodies, &sums));
  PetscCall(PosesSum(b, u0, u1, NULL, sums));
  for (PetscInt body = 0; body < b->scene->nbodies; ++body) {
    for (int d = 0; d < 3; ++d) {
      poses[body].from[d] = sums[body][d] / sums[body][6];
      poses[body].to[d]   = sums[body][3 + d] / sums[body][6];
    }
  }
  PetscCall(PosesSum(b, u0, u1, poses, sums));
  for (PetscInt body = 0; body < b->scene->nbodies; ++body) {
    PetscReal inverse[3][3], F[3][3] = {{0.0}};

    (void)MatrixInvert((PetscReal(*)[3])(sums[body] + 9), inverse);
    for (int i = 0; i < 27; ++i) F[i / 9][i / 3 % 3] += sums[body][3 * (i / 9) + i % 3] * inverse[i % 3][i / 3 % 3];
    PoseGetRotation((const PetscReal(*)[3])F, poses[body].Q);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/* Computes the position x1 of the point x0 after the rigid motion [length] */
void PosePlace(const BodyPose *pose, const PetscReal x0[3], PetscReal x1[3])
{
  for (int i = 0; i < 3; ++i) {
    x1[i] = pose->to[i];
    for (int j = 0; j < 3; ++j) x1[i] += pose->Q[i][j] * (x0[j] - pose->from[j]);
  }
}

/* Returns the centre of rotation that the scene gives for a rigid body, or NULL if the scene does not let the body
   rotate */
const PetscReal *PoseFindCenter(Scene scene, PetscInt body)
{
  const size_t     n      = strlen(scene->bodies[body].name);
  const PetscReal *center = NULL;

  for (PetscInt i = 0; i < scene->ndisplacements; ++i) {
    const SceneDisplacement *d = &scene->displacements[i];

    if (strncmp(d->face, scene->bodies[body].name, n) || strcmp(d->face + n, SCENE_WHOLE_BODY)) continue;
    for (PetscInt k = 0; k < 3; ++k) center = d->rotation[k] != 0.0 || d->released[3 + k] ? d->center : center;
  }
  return center;
}
