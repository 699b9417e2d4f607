/* Describes rotations of bodies that nothing resists */
#include "loadsimpl.h"

/* Returns x rounded to a multiple of `unit`, and never -0, so that rounding errors are not printed */
PetscReal RotationRound(PetscReal x, PetscReal unit)
{
  return PetscFloorReal(x / unit + 0.5) * unit + 0.0;
}

/* Writes the axis of a rotation, rounded so that rounding errors and deviations of facets are not printed */
PetscErrorCode RotationDescribe(const MeshRotation *rotation, size_t size, char text[])
{
  const PetscReal unit = PetscPowReal(10.0, PetscFloorReal(PetscLog10Real(rotation->size)) - 1.0);
  PetscReal       axis[3], point[3];
  PetscInt        most = 0;

  PetscFunctionBegin;
  for (PetscInt d = 1; d < 3; ++d) {
    if (PetscAbsReal(rotation->axis[d]) > PetscAbsReal(rotation->axis[most]) + 1e-3) most = d;
  }
  for (PetscInt d = 0; d < 3; ++d) {
    axis[d]  = RotationRound(rotation->axis[d] * (rotation->axis[most] < 0.0 ? -1.0 : 1.0), 0.1);
    point[d] = RotationRound(rotation->point[d], unit);
  }
  if (rotation->any)
    PetscCall(PetscSNPrintf(text, size, "about axes through (%g, %g, %g)", (double)point[0], (double)point[1],
      (double)point[2]));
  else
    PetscCall(PetscSNPrintf(text, size, "about the axis along (%g, %g, %g) through (%g, %g, %g)", (double)axis[0],
      (double)axis[1], (double)axis[2], (double)point[0], (double)point[1], (double)point[2]));
  PetscFunctionReturn(0);
}
