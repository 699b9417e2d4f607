/*
   The slip of rotating bodies, measured along arcs. A displacement increment is the chord of the path of a node. For a
   wheel that rolls by an angle t, the chord differs from the arc by R t^3/6 at the contact. In place of the chord the
   rigid motion at the end of the increment is used:

     d = c1 - c0 + t x (x1 - c1) + Q e,   e = c0 + Q^T (x1 - c1) - x0.

   Here x0 and x1 are the positions of the node, c0 and c1 those of the centre of rotation, Q is the rotation, t its
   rotation vector, and e the deformation. Bodies with a law of small strain move along chords: their displacements are
   proportional to the loads.
*/
#include "constraintsimpl.h"
#include <vector3.h>

/* For smaller rotations the arc is replaced by the chord, which differs by 1e-6 of the length [rad]. */
static const PetscReal least_angle = PETSC_PI / 180.0;

typedef struct {
  PetscBool turns, centred;         /* whether the body rotates by more than least_angle; whether its centre is known */
  PetscReal c0[3], c1[3], angle[3]; /* centre of rotation before and after [length]; rotation vector [rad] */
} BodyArc;

/* Returns the number of the body that a face belongs to */
static PetscInt ArcFindBody(Scene scene, const char face[])
{
  const Material *material = &SceneFaceBody(scene, face)->material;
  PetscInt        body     = 0;

  while (material != &scene->bodies[body].material) ++body;
  return body;
}

/* If two touching bodies have equal rotations, and only one has a centre of rotation, the other one gets that centre
   too */
static void ArcsShareCenter(BodyArc *one, BodyArc *other)
{
  PetscReal apart = 0.0;

  for (PetscInt i = 0; i < 3; ++i) apart += PetscSqr(one->angle[i] - other->angle[i]);
  if (one->centred == other->centred || apart > PetscSqr(least_angle)) return;
  for (PetscInt i = 0; i < 3; ++i) {
    if (one->centred) other->c0[i] = one->c0[i], other->c1[i] = one->c1[i];
    else one->c0[i] = other->c0[i], one->c1[i] = other->c1[i];
  }
  one->centred = other->centred = PETSC_TRUE;
}

/*
   Determines the centre of rotation of each body. The scene gives the centre of a rigid body. Any other body gets the
   centre of a body that it is tied to or in contact with, as a tyre gets the centre of its hub. If there is none, the
   centre is the mean position of its nodes.
*/
static PetscErrorCode ArcsFindCenters(const Bodies *b, Vec u0, const BodyPose poses[], BodyArc arcs[])
{
  Scene     scene = b->scene;
  BodyPose *before;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &before));
  PetscCall(PosesFind(b, NULL, u0, before));
  for (PetscInt body = 0; body < scene->nbodies; ++body) {
    const PetscReal *center = PoseFindCenter(scene, body);

    arcs[body].centred = (PetscBool)(center != NULL);
    if (center) PosePlace(&before[body], center, arcs[body].c0);
    else PetscCall(PetscArraycpy(arcs[body].c0, poses[body].from, 3));
    PosePlace(&poses[body], arcs[body].c0, arcs[body].c1);
  }
  PetscCall(PetscFree(before));
  for (PetscInt k = 0; k < scene->nbodies; ++k) {
    for (PetscInt t = 0; t < scene->nties; ++t)
      ArcsShareCenter(&arcs[ArcFindBody(scene, scene->ties[t].mortar)],
        &arcs[ArcFindBody(scene, scene->ties[t].nonmortar)]);
    for (PetscInt p = 0; p < scene->npairs; ++p)
      ArcsShareCenter(&arcs[ArcFindBody(scene, scene->pairs[p].mortar)],
        &arcs[ArcFindBody(scene, scene->pairs[p].nonmortar)]);
  }
  PetscFunctionReturn(0);
}

/* Determines the arcs of all bodies from the displacement u0 to their rigid motions `poses`. *any: whether any body
   rotates */
static PetscErrorCode ArcsFind(const Bodies *b, Vec u0, const BodyPose poses[], BodyArc arcs[], PetscBool *any)
{
  PetscFunctionBegin;
  *any = PETSC_FALSE;
  for (PetscInt body = 0; body < b->scene->nbodies; ++body) {
    const Material *material = &b->scene->bodies[body].material;
    BodyArc        *arc      = &arcs[body];

    PoseGetVector((const PetscReal(*)[3])poses[body].Q, arc->angle);
    arc->turns = (PetscBool)((MaterialIsFinite(material) || material->type == MATERIAL_RIGID) &&
                             VectorNorm(arc->angle) > least_angle);
    *any       = (PetscBool)(*any || arc->turns);
  }
  if (*any) PetscCall(ArcsFindCenters(b, u0, poses, arcs));
  PetscFunctionReturn(0);
}

/* Computes d - (x1 - x0) of a node [length] */
static void ArcGetExcess(const BodyArc *arc, const PetscReal Q[3][3], const PetscReal x0[3], const PetscReal x1[3],
  PetscReal excess[3])
{
  PetscReal r[3], e[3];

  for (PetscInt i = 0; i < 3; ++i) r[i] = x1[i] - arc->c1[i];
  for (PetscInt i = 0; i < 3; ++i) {
    e[i] = arc->c0[i] - x0[i];
    for (PetscInt k = 0; k < 3; ++k) e[i] += Q[k][i] * r[k];
  }
  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt j = (i + 1) % 3, k = (i + 2) % 3;

    excess[i] = arc->c1[i] - arc->c0[i] + arc->angle[j] * r[k] - arc->angle[k] * r[j] - (x1[i] - x0[i]);
    for (PetscInt l = 0; l < 3; ++l) excess[i] += Q[i][l] * e[l];
  }
}

/* Computes the difference between the path along arcs from displacement u0 to u1 and the chord [length]; NULL if not
   wanted. *any: whether any body rotates. If none does, the difference is zero and the vector is not set. */
PetscErrorCode ArcsGetExcess(const Bodies *b, Vec u0, Vec u1, Vec excess, PetscBool *any)
{
  BodyPose          *poses;
  BodyArc           *arcs;
  const PetscScalar *x, *a0, *a1;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(b->scene->nbodies, &poses, b->scene->nbodies, &arcs));
  PetscCall(PosesFind(b, u0, u1, poses));
  PetscCall(ArcsFind(b, u0, poses, arcs, any));
  if (*any && excess) {
    PetscCall(VecGetLocalSize(excess, &n));
    PetscCall(VecGetArrayRead(b->places.x, &x));
    PetscCall(VecGetArrayRead(u0, &a0));
    PetscCall(VecGetArrayRead(u1, &a1));
    PetscCall(VecGetArrayWrite(excess, &a));
    for (PetscInt i = 0; i < n; i += 3) {
      const PetscInt body = b->places.body[i / 3];
      PetscReal      x0[3], x1[3], d[3] = {0.0, 0.0, 0.0};

      for (PetscInt k = 0; k < 3; ++k) {
        x0[k] = PetscRealPart(x[i + k] + a0[i + k]);
        x1[k] = PetscRealPart(x[i + k] + a1[i + k]);
      }
      if (arcs[body].turns) ArcGetExcess(&arcs[body], (const PetscReal(*)[3])poses[body].Q, x0, x1, d);
      for (PetscInt k = 0; k < 3; ++k) a[i + k] = d[k];
    }
    PetscCall(VecRestoreArrayWrite(excess, &a));
    PetscCall(VecRestoreArrayRead(u1, &a1));
    PetscCall(VecRestoreArrayRead(u0, &a0));
    PetscCall(VecRestoreArrayRead(b->places.x, &x));
  }
  PetscCall(PetscFree2(poses, arcs));
  PetscFunctionReturn(0);
}

/*
   Computes the increments from displacement u0 to u1 that are multiplied by forces to compute work [length]:
   increment[0] for forces at u0, increment[1] for forces at u1. They are chords, or arcs if bodies rotate. Forces in
   balance then do no work on a body that rotates rigidly.
*/
PetscErrorCode ArcsGetIncrements(const Bodies *b, Vec u0, Vec u1, Vec increment[2])
{
  PetscBool any;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u0, &increment[0]));
  PetscCall(VecDuplicate(u0, &increment[1]));
  PetscCall(ArcsGetExcess(b, u0, u1, increment[1], &any));
  if (any) PetscCall(ArcsGetExcess(b, u1, u0, increment[0], &any));
  for (int k = 0; k < 2; ++k) {
    if (!any) PetscCall(VecZeroEntries(increment[k]));
    if (k == 0) PetscCall(VecScale(increment[k], -1.0));
    PetscCall(VecAXPY(increment[k], 1.0, u1));
    PetscCall(VecAXPY(increment[k], -1.0, u0));
  }
  PetscFunctionReturn(0);
}
