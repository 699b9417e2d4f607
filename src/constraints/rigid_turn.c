/* Finite rotations of rigid bodies: see rigid.c */
#include "constraintsimpl.h"
#include <vector3.h>

/* largest rotation between two states [degrees]. If the gap is linearized only once per load step, rotations are
   linearized only once too; the error is then at most 6e-4 of the distance from the centre */
static const PetscReal largest_angle = 45.0, largest_linearized = 2.0; /* [degrees] */

/* Computes (d exp(angle) / d angle) exp(-angle) by columns: the rotation axis that belongs to a change of each
   component of the rotation vector r */
static void RigidGetAxes(const PetscReal r[3], PetscReal axis[3][3])
{
  const PetscReal square = VectorDot(r, r), angle = PetscSqrtReal(square), small = 1e-3;
  const PetscReal first = angle > small ? (1.0 - PetscCosReal(angle)) / square : 0.5 - square / 24.0;
  const PetscReal second =
    angle > small ? (angle - PetscSinReal(angle)) / (square * angle) : 1.0 / 6.0 - square / 120.0;

  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt j = (i + 1) % 3, k = (i + 2) % 3;

    axis[i][i] = 1.0 - second * (r[j] * r[j] + r[k] * r[k]);
    axis[i][j] = first * r[k] + second * r[i] * r[j];
    axis[i][k] = -first * r[j] + second * r[i] * r[k];
  }
}

/* Computes the rotation Q = exp(angle) last */
void RigidGetRotation(const RigidBody *body, PetscReal Q[3][3])
{
  PetscReal turn[3][3];

  MatrixSetTurn(body->angle, turn);
  for (PetscInt i = 0; i < 9; ++i) {
    Q[i / 3][i % 3] = body->last[i / 3][i % 3];
    for (PetscInt k = 0; k < 3; ++k) Q[i / 3][i % 3] += turn[i / 3][k] * body->last[k][i % 3];
  }
}

/* Sets the displacement u of the body's nodes to the rigid motion with the body's `place` (centre) and `angle`
   (rotation vector) */
static PetscErrorCode RigidPlace(const Constraints *c, const RigidBody *body, Vec u)
{
  const PetscReal   *center = c->bodies.scene->displacements[body->leader].center;
  const PetscScalar *x;
  PetscScalar       *a;
  PetscInt           n, rstart;
  PetscReal          Q[3][3];
  const PetscInt    *nodes;
  IS                 is;

  PetscFunctionBegin;
  RigidGetRotation(body, Q);
  PetscCall(RigidGetNodes(c, body, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &nodes));
  PetscCall(VecGetOwnershipRange(u, &rstart, NULL));
  PetscCall(VecGetArrayRead(c->bodies.places.x, &x));
  PetscCall(VecGetArray(u, &a));
  for (PetscInt i = 0; i < 3 * n; ++i) {
    const PetscInt node = nodes[i / 3] - rstart, d = i % 3;
    PetscReal      moved = body->place[d] - center[d];

    for (PetscInt k = 0; k < 3; ++k)
      moved += (Q[d][k] - (d == k ? 1.0 : 0.0)) * (PetscRealPart(x[node + k]) - center[k]);
    a[node + d] = moved;
  }
  PetscCall(VecRestoreArray(u, &a));
  PetscCall(VecRestoreArrayRead(c->bodies.places.x, &x));
  PetscCall(ISRestoreIndices(is, &nodes));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Sets `place` (centre) and `angle` (rotation vector) of a body. Free components are those of the nodes; other
   components have the prescribed values. */
static void RigidLocate(const SceneDisplacement *d, const RigidMotion *given, const BodyPose *last, const BodyPose *now,
  RigidBody *body)
{
  PetscReal turn[3][3];

  PosePlace(now, d->center, body->place);
  for (PetscInt i = 0; i < 9; ++i) {
    body->last[i / 3][i % 3] = last->Q[i / 3][i % 3];
    turn[i / 3][i % 3]       = 0.0;
    for (PetscInt k = 0; k < 3; ++k) turn[i / 3][i % 3] += now->Q[i / 3][k] * last->Q[i % 3][k];
  }
  PoseGetVector((const PetscReal(*)[3])turn, body->angle);
  for (PetscInt m = 0; m < 3; ++m) {
    if (!d->released[m]) body->place[m] = d->center[m] + given->t[m];
    if (!d->released[3 + m]) body->angle[m] = 0.0;
  }
  RigidGetAxes(body->angle, body->axis);
}

/* Collective. Linearizes free rotations about the displacement u and the prescribed values at a time. u_last:
   displacement at the last state. Sets rigid->given and rigid->x. */
PetscErrorCode RigidTurn(const Constraints *c, PetscReal time, Vec u_last, Vec u)
{
  RigidBodies *rigid = c->rigid;
  Scene        scene = c->bodies.scene;
  BodyPose    *last, *now;
  PetscReal   *factor;
  RigidMotion  given;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(scene->nbodies, &last, scene->nbodies, &now, scene->nramps, &factor));
  for (PetscInt r = 0; r < scene->nramps; ++r) PetscCall(SceneGetFactor(scene, r, time, &factor[r]));
  PetscCall(PosesFind(&c->bodies, NULL, u_last, last));
  PetscCall(PosesFind(&c->bodies, NULL, u, now));
  PetscCall(VecZeroEntries(rigid->given));
  for (PetscInt b = 0; b < rigid->n; ++b) {
    RigidBody *body = &rigid->bodies[b];

    if (!body->turns) continue;
    MotionGet(scene, body->leader, factor, &given);
    RigidLocate(&scene->displacements[body->leader], &given, &last[body->body], &now[body->body], body);
    PetscCall(RigidPlace(c, body, rigid->given));
  }
  PetscCall(VecWAXPY(rigid->x, 1.0, c->bodies.places.x, rigid->given));
  PetscCall(PetscFree3(last, now, factor));
  PetscFunctionReturn(0);
}

/* Collective. Computes the free motions of a body in a displacement u, relative to the position about which it is
   linearized. Rotations are multiplied by the body's size. */
static PetscErrorCode RigidGetMotion(const Constraints *c, const RigidBody *body, Vec u, PetscReal motion[6])
{
  PetscReal          moved[6] = {0.0};
  const PetscScalar *a, *given;
  PetscInt           first, end;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(u, &first, &end));
  PetscCall(VecGetArrayRead(u, &a));
  PetscCall(VecGetArrayRead(c->rigid->given, &given));
  for (PetscInt k = 0; k < body->n; ++k) {
    if (body->row[k] >= first && body->row[k] < end)
      moved[k] = PetscRealPart(a[body->row[k] - first] - given[body->row[k] - first]);
  }
  PetscCall(VecRestoreArrayRead(c->rigid->given, &given));
  PetscCall(VecRestoreArrayRead(u, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, moved, 6, MPIU_REAL, MPIU_SUM, c->bodies.comm));
  for (PetscInt k = 0; k < body->n; ++k) {
    motion[k] = 0.0;
    for (PetscInt m = 0; m < body->n; ++m) motion[k] += body->inverse[k][m] * moved[m];
  }
  PetscFunctionReturn(0);
}

/* Collective. Replaces the linearized motions of bodies with finite rotations in u by the finite motions. *change: the
   largest change of the displacement [length] */
PetscErrorCode RigidStraighten(const Constraints *c, Vec u, PetscReal *change)
{
  RigidBodies *rigid = c->rigid;
  Vec          before;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &before));
  PetscCall(VecCopy(u, before));
  for (PetscInt b = 0; b < rigid->n; ++b) {
    RigidBody *body = &rigid->bodies[b], moved = *body;
    PetscReal  motion[6];

    if (!body->turns) continue;
    PetscCall(RigidGetMotion(c, body, before, motion));
    for (PetscInt k = 0; k < body->n; ++k) {
      if (body->motion[k] < 3) moved.place[body->motion[k]] += motion[k];
      else moved.angle[body->motion[k] - 3] += motion[k] / body->size;
    }
    PetscCall(RigidPlace(c, &moved, u));
  }
  PetscCall(VecAXPY(before, -1.0, u));
  PetscCall(VecNorm(before, NORM_INFINITY, change));
  PetscCall(VecDestroy(&before));
  PetscFunctionReturn(0);
}

/* Collective. Reports that a solve has not converged if a free rotation is larger than its linearization allows.
   finite: whether rotations are linearized repeatedly until they agree with the solution */
PetscErrorCode RigidTest(const Constraints *c, PetscBool finite, Vec u, StepReport *report)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < c->rigid->n && report->converged; ++b) {
    const RigidBody *body = &c->rigid->bodies[b];
    const PetscReal  most = finite && body->turns ? largest_angle : largest_linearized;
    PetscReal        motion[6], angle[3], degrees;

    PetscCall(RigidGetMotion(c, body, u, motion));
    PetscCall(PetscArraycpy(angle, body->angle, 3));
    for (PetscInt k = 0; k < body->n; ++k) {
      if (body->motion[k] >= 3) angle[body->motion[k] - 3] += motion[k] / body->size;
    }
    degrees = VectorNorm(angle) * 180.0 / PETSC_PI;
    if (degrees <= most) continue;
    PetscCall(ReportReason(report, PETSC_FALSE, "displacement \"%s\": the rigid body turns by %.3g degrees%s",
      c->bodies.scene->displacements[body->leader].name, (double)degrees,
      !body->turns ? ", but a free rotation may be at most 2 degrees where a body of small strain is tied to it: use "
                     "neohookean or saint_venant, prescribe the rotation, or add supports"
      : !finite    ? " in one load step, but with contact_updates: 1 a free rotation may be at most 2 degrees"
                   : " in one load step: use smaller load steps, prescribe the rotation, or add supports"));
  }
  PetscFunctionReturn(0);
}
