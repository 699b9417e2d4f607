/* Rigid motions of faces and bodies: u = t + (R - 1) (X - c). The translation t and the rotation vector of R are sums
   over the scene's displacements for the face or body, each multiplied by the factor of its ramp. */
#include "constraintsimpl.h"
#include <vector3.h>
#include <string.h>

/* Returns the leader of displacement d: the first displacement of the scene for the same face or body */
PetscInt MotionFindLeader(Scene scene, PetscInt d)
{
  PetscInt leader = 0;

  while (strcmp(scene->displacements[leader].face, scene->displacements[d].face)) ++leader;
  return leader;
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
  MatrixSetTurn(r, motion->turn);
}

/* Returns component i of the displacement of the point x by a rigid motion [length] */
PetscReal MotionDisplace(const RigidMotion *motion, const PetscScalar x[3], PetscInt i)
{
  PetscReal u = motion->t[i];

  for (PetscInt j = 0; j < 3; ++j) u += motion->turn[i][j] * (PetscRealPart(x[j]) - motion->center[j]);
  return u;
}
