/* Rigid motions of faces and bodies: u = t + (R - 1) (X - c). The translation t and the rotation vector of R are sums
   over the scene's displacements for the face or body, each multiplied by the factor of its ramp. */
#include "constraintsimpl.h"
#include <string.h>

/* Returns the first displacement of the scene for the face or body of displacement d. It represents all of them. */
PetscInt MotionFindLeader(Scene scene, PetscInt d)
{
  PetscInt leader = 0;

  while (strcmp(scene->displacements[leader].face, scene->displacements[d].face)) ++leader;
  return leader;
}

/* Computes turn = R - 1 from the rotation vector r = |r| n [rad] by Rodrigues' formula: sin|r| [n] + (1 - cos|r|)
   [n]^2. This form has no cancellation for small angles. */
void MotionRotate(const PetscReal r[3], PetscReal turn[3][3])
{
  PetscReal angle = 0.0, sine, versine;

  for (PetscInt i = 0; i < 3; ++i) angle += r[i] * r[i];
  angle   = PetscSqrtReal(angle);
  sine    = angle > 0.0 ? PetscSinReal(angle) / angle : 1.0;
  versine = angle > 0.0 ? 2.0 * PetscSqr(PetscSinReal(0.5 * angle) / angle) : 0.5;
  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt j = (i + 1) % 3, k = (i + 2) % 3;

    turn[i][i] = -versine * (r[j] * r[j] + r[k] * r[k]);
    turn[i][j] = versine * r[i] * r[j] - sine * r[k];
    turn[i][k] = versine * r[i] * r[k] + sine * r[j];
  }
}

/* Computes the rigid motion of a leader. factor: factor of each ramp */
void MotionGet(Scene scene, PetscInt leader, const PetscReal factor[], RigidMotion *motion)
{
  PetscReal r[3] = {0.0, 0.0, 0.0};

  *motion = (RigidMotion){.t = {0.0, 0.0, 0.0}};
  for (PetscInt d = leader; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *entry = &scene->displacements[d];

    if (strcmp(entry->face, scene->displacements[leader].face)) continue;
    for (PetscInt i = 0; i < 3; ++i) {
      motion->t[i] += factor[entry->ramp] * entry->value[i];
      r[i] += factor[entry->ramp] * entry->rotation[i];
      if (entry->rotation[0] != 0.0 || entry->rotation[1] != 0.0 || entry->rotation[2] != 0.0)
        motion->center[i] = entry->center[i];
    }
  }
  for (PetscInt i = 0; i < 3; ++i) r[i] *= PETSC_PI / 180.0;
  MotionRotate(r, motion->turn);
}

/* Returns component i of the displacement of the point x by a rigid motion [length] */
PetscReal MotionDisplace(const RigidMotion *motion, const PetscScalar x[3], PetscInt i)
{
  PetscReal u = motion->t[i];

  for (PetscInt j = 0; j < 3; ++j) u += motion->turn[i][j] * (PetscRealPart(x[j]) - motion->center[j]);
  return u;
}
