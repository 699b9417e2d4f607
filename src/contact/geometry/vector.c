/* Products of vectors */
#include "geometryimpl.h"

PetscReal ContactDot(const PetscReal a[3], const PetscReal b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void ContactCross(const PetscReal a[3], const PetscReal b[3], PetscReal c[3])
{
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Scales n to length 1 and returns its former length; a zero vector stays zero */
PetscReal ContactScaleToUnit(PetscReal n[3])
{
  const PetscReal length = PetscSqrtReal(ContactDot(n, n));

  for (PetscInt c = 0; c < 3; ++c) n[c] = length > 0.0 ? n[c] / length : 0.0;
  return length;
}
