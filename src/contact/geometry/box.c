/* Axis-aligned boxes: box[0..2] is the lower corner, box[3..5] the upper corner */
#include "geometryimpl.h"

void ContactFacetBox(const PetscReal x[12], PetscReal box[6])
{
  for (PetscInt c = 0; c < 3; ++c) {
    box[c]     = PetscMin(PetscMin(x[c], x[3 + c]), PetscMin(x[6 + c], x[9 + c]));
    box[3 + c] = PetscMax(PetscMax(x[c], x[3 + c]), PetscMax(x[6 + c], x[9 + c]));
  }
}

/* Computes the box around the prism that the facet x sweeps if it is moved along its normal by -depth to distance
   [length]. A facet without area has no normal; its box is that of the facet itself. */
void ContactSweptBox(const PetscReal x[12], PetscReal distance, PetscReal depth, PetscReal box[6])
{
  PetscReal n[3];

  ContactFacetBox(x, box);
  if (!ContactFacetNormal(x, n)) return;
  for (PetscInt c = 0; c < 3; ++c) {
    box[c] += PetscMin(n[c] * distance, -n[c] * depth);
    box[3 + c] += PetscMax(n[c] * distance, -n[c] * depth);
  }
}

PetscBool ContactBoxesMeet(const PetscReal a[6], const PetscReal b[6])
{
  for (PetscInt c = 0; c < 3; ++c) {
    if (a[c] > b[3 + c] || b[c] > a[3 + c]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}
