/*
   Forces and moments on rigid bodies with finite free rotations. A force keeps its direction and acts at the current
   position of its point. A moment keeps its axis. The dead loads at the nodes have the moment of the undeformed body,
   m0 = moment + arm x force. This file replaces it by the current moment, m = moment + (Q arm) x force. For this
   purpose the nodal forces f(m0) are replaced by forces that rotate with the body, Q f(Q^T m).
*/
#include "constraintsimpl.h"
#include <vector3.h>

/* Collective. Computes the vector from the centroid of the undeformed body's surface to the point at which a force acts
   [length]; zero if the scene gives no point */
static PetscErrorCode RigidLoadGetArm(const Constraints *c, const SceneTraction *load, PetscReal arm[3])
{
  const PetscReal    unit[3] = {1.0, 0.0, 0.0}, none[3] = {0.0, 0.0, 0.0};
  const PetscScalar *x, *w;
  PetscInt           n;
  Vec                weights;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(arm, 3));
  if (!load->placed) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(c->bodies.mass, &weights));
  PetscCall(VecZeroEntries(weights));
  PetscCall(ElasticityAddForce(c->bodies.elasticity, load->face, unit, none, NULL, weights));
  PetscCall(VecGetLocalSize(weights, &n));
  PetscCall(VecGetArrayRead(weights, &w));
  PetscCall(VecGetArrayRead(c->bodies.places.x, &x));
  for (PetscInt i = 0; i < n; ++i) arm[i % 3] -= PetscRealPart(w[i - i % 3]) * PetscRealPart(x[i]);
  PetscCall(VecRestoreArrayRead(c->bodies.places.x, &x));
  PetscCall(VecRestoreArrayRead(weights, &w));
  PetscCall(VecDestroy(&weights));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, arm, 3, MPIU_REAL, MPIU_SUM, c->bodies.comm));
  for (int i = 0; i < 3; ++i) arm[i] += load->point[i];
  PetscFunctionReturn(0);
}

/* Collective. Adds to `total`: factor times the difference between the current nodal forces of one load and those for
   the undeformed body */
static PetscErrorCode RigidLoadTurn(const Constraints *c, const SceneTraction *load, const PetscReal Q[3][3],
  PetscReal factor, Vec total)
{
  const PetscReal none[3] = {0.0, 0.0, 0.0};
  PetscReal       arm[3], turned[3] = {0.0, 0.0, 0.0}, undeformed[3], now[3], back[3] = {0.0, 0.0, 0.0};
  PetscScalar    *a, *b;
  PetscInt        n;
  Vec             old, new;

  PetscFunctionBegin;
  PetscCall(RigidLoadGetArm(c, load, arm));
  for (int i = 0; i < 9; ++i) turned[i / 3] += Q[i / 3][i % 3] * arm[i % 3];
  PetscCall(PetscArraycpy(undeformed, load->moment, 3));
  PetscCall(PetscArraycpy(now, load->moment, 3));
  VectorAddCross(arm, load->value, undeformed);
  VectorAddCross(turned, load->value, now);
  for (int i = 0; i < 9; ++i) back[i % 3] += Q[i / 3][i % 3] * now[i / 3];
  PetscCall(VecDuplicate(total, &old));
  PetscCall(VecDuplicate(total, &new));
  PetscCall(VecZeroEntries(old));
  PetscCall(VecZeroEntries(new));
  PetscCall(ElasticityAddForce(c->bodies.elasticity, load->face, none, undeformed, NULL, old));
  PetscCall(ElasticityAddForce(c->bodies.elasticity, load->face, none, back, NULL, new));
  PetscCall(VecGetLocalSize(total, &n));
  PetscCall(VecGetArray(old, &a));
  PetscCall(VecGetArray(new, &b));
  for (PetscInt i = 0; i < n; i += 3) {
    for (int d = 0; d < 3; ++d) a[i + d] = Q[d][0] * b[i] + Q[d][1] * b[i + 1] + Q[d][2] * b[i + 2] - a[i + d];
  }
  PetscCall(VecRestoreArray(new, &b));
  PetscCall(VecRestoreArray(old, &a));
  PetscCall(VecAXPY(total, factor, old));
  PetscCall(VecDestroy(&new));
  PetscCall(VecDestroy(&old));
  PetscFunctionReturn(0);
}

/* Collective. Adds to the dead load `load` at a time, multiplied by `sign`, the change of the loads on rotating rigid
   bodies, at the positions about which the bodies are linearized. load may be NULL, if the scene has no loads. */
PetscErrorCode RigidTurnLoads(const Constraints *c, PetscReal sign, PetscReal time, Vec load)
{
  Scene     scene = c->bodies.scene;
  PetscReal factor, Q[3][3];

  PetscFunctionBegin;
  for (PetscInt b = 0; load && b < c->rigid->n; ++b) {
    const RigidBody *body = &c->rigid->bodies[b];

    if (!body->turns) continue;
    RigidGetRotation(body, Q);
    for (PetscInt t = 0; t < scene->ntractions; ++t) {
      const SceneTraction *traction = &scene->tractions[t];

      if (!traction->resultant || traction->body != body->body) continue;
      PetscCall(SceneGetFactor(scene, traction->ramp, time, &factor));
      PetscCall(RigidLoadTurn(c, traction, (const PetscReal(*)[3])Q, sign * factor, load));
    }
  }
  PetscFunctionReturn(0);
}
