/*
   Rigid bodies with finite free rotations, in the impact scheme. The solver balances moments with the arms x' at the
   end of a time step. The forces that keep the body rigid then do work, and energy is lost in proportion to the time
   step. With the mean arms of both ends of the step they do no work, because x' - x is perpendicular to them; energy
   and angular momentum are then conserved. Therefore nodal forces are added whose moment is the difference of both
   moments, and whose resultant is zero. They are computed at the last iterate.
*/
#include "dynamicsimpl.h"
#include <vector3.h>

/*
   A rotating body: its centre of rotation before and after the time step [length]; the moment that is missing; the sum
   of m r r^T over the arms r of the nodes about their mean position, where m is the node's mass
*/
typedef struct {
  PetscBool turns;
  PetscReal before[3], after[3], moment[3], arms[6];
} TurnBody;

/* Finds the bodies that rotate, and their centres of rotation before and after the step */
static void TurnFind(const Constraints *c, const BodyPose poses[], TurnBody bodies[])
{
  for (PetscInt r = 0; r < c->rigid->n; ++r) {
    const RigidBody *rigid = &c->rigid->bodies[r];
    const BodyPose  *pose  = &poses[rigid->body];
    TurnBody        *body  = &bodies[rigid->body];

    body->turns = rigid->turns;
    for (int i = 0; i < 3; ++i) {
      body->after[i]  = rigid->place[i];
      body->before[i] = pose->from[i];
      for (int j = 0; j < 3; ++j) body->before[i] += pose->Q[j][i] * (rigid->place[j] - pose->to[j]);
    }
  }
}

/* Gets the positions of the node with first row i before and after the step, and its part f of a vector */
static void TurnGetNode(const PetscScalar *arrays[4], PetscInt i, PetscReal before[3], PetscReal after[3],
  PetscReal f[3])
{
  for (int k = 0; k < 3; ++k) {
    before[k] = PetscRealPart(arrays[0][i + k] + arrays[1][i + k]);
    after[k]  = PetscRealPart(arrays[0][i + k] + arrays[2][i + k]);
    f[k]      = PetscRealPart(arrays[3][i + k]);
  }
}

/* Adds to the missing moment of each body: -1/2 (displacement of each node relative to the centre) x force. Adds to the
   sums of the arms. */
static PetscErrorCode TurnSum(const Constraints *c, Vec before, Vec u, Vec force, const BodyPose poses[],
  TurnBody bodies[])
{
  static const int   row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  Vec                vectors[4] = {c->bodies.places.x, before, u, force};
  const PetscScalar *arrays[4], *m;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(u, &n));
  for (int k = 0; k < 4; ++k) PetscCall(VecGetArrayRead(vectors[k], &arrays[k]));
  PetscCall(VecGetArrayRead(c->bodies.mass, &m));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscInt b    = c->bodies.places.body[i / 3];
    TurnBody      *body = &bodies[b];
    PetscReal      x[3], y[3], f[3], moment[3];

    if (!body->turns) continue;
    TurnGetNode(arrays, i, x, y, f);
    for (int k = 0; k < 3; ++k) x[k] = (y[k] - body->after[k]) - (x[k] - body->before[k]);
    VectorCross(x, f, moment);
    for (int k = 0; k < 3; ++k) body->moment[k] -= 0.5 * moment[k];
    for (int k = 0; k < 6; ++k)
      body->arms[k] +=
        PetscRealPart(m[i]) * (y[row[k]] - poses[b].to[row[k]]) * (y[column[k]] - poses[b].to[column[k]]);
  }
  PetscCall(VecRestoreArrayRead(c->bodies.mass, &m));
  for (int k = 0; k < 4; ++k) PetscCall(VecRestoreArrayRead(vectors[k], &arrays[k]));
  PetscFunctionReturn(0);
}

/* Collective. Sets d->turn for a time step from the displacement `before` to u, with the rigid bodies at their
   positions in u. load: dead loads at the end of the step; contact: contact forces. NULL if there are none */
PetscErrorCode TurnSetForce(const Constraints *c, Vec before, Vec u, Vec load, Vec contact, Dynamics *d)
{
  const PetscInt nbodies = c->bodies.scene->nbodies;
  PetscReal      energy  = 0.0, *sums, inertia[3][3];
  BodyPose      *poses;
  TurnBody      *bodies;
  BodyMotion    *motions; /* displacements that, multiplied with the nodes' masses, are the additional forces */
  Vec            force;

  PetscFunctionBegin;
  if (!d->residual || !c->rigid->turns) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&d->turn));
  PetscCall(PetscMalloc2(nbodies, &poses, 9 * nbodies, &sums));
  PetscCall(PetscCalloc2(nbodies, &bodies, nbodies, &motions));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecZeroEntries(force));
  PetscCall(SchemeAddForce(d, u, &energy, force));
  if (load) PetscCall(VecAXPY(force, -1.0, load));
  if (contact) PetscCall(VecAXPY(force, -1.0 / SchemeShare(&c->bodies.scene->dynamics), contact));
  PetscCall(PosesFind(&c->bodies, before, u, poses));
  TurnFind(c, poses, bodies);
  PetscCall(TurnSum(c, before, u, force, poses, bodies));
  for (PetscInt i = 0; i < 9 * nbodies; ++i)
    sums[i] = i % 9 < 3 ? bodies[i / 9].moment[i % 9] : bodies[i / 9].arms[i % 9 - 3];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(9 * nbodies), MPIU_REAL, MPIU_SUM, c->bodies.comm));
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (int k = 0; k < 3; ++k) bodies[b].moment[k] = sums[9 * b + k];
    for (int k = 0; k < 6; ++k) bodies[b].arms[k] = sums[9 * b + 3 + k];
    if (!bodies[b].turns) continue;
    MatrixSetInertia(bodies[b].arms, inertia);
    (void)MatrixSolve(inertia, bodies[b].moment, motions[b].w);
    PetscCall(PetscArraycpy(motions[b].center, poses[b].to, 3));
  }
  PetscCall(VertexPlacesMove(&c->bodies.places, u, motions, force));
  PetscCall(VecPointwiseMult(force, force, c->bodies.mass));
  d->turn = force;
  PetscCall(PetscFree2(bodies, motions));
  PetscCall(PetscFree2(poses, sums));
  PetscFunctionReturn(0);
}
