/* The normal of a facet, and the projection onto its plane */
#include "geometryimpl.h"

/* Computes the mean outward unit normal n of a facet. Returns false if the facet has no area. */
PetscBool ContactFacetNormal(const PetscReal x[12], PetscReal n[3])
{
  ContactFacetAreaVector(x, n);
  return (PetscBool)(VectorScaleToUnit(n) > 0.0);
}

/* Creates the plane through the centre of the facet x, perpendicular to its mean normal. Returns false if the facet has
   no area. */
PetscBool ContactFrameCreate(const PetscReal x[12], ContactFrame *f)
{
  PetscReal *t = f->axis[0], *s = f->axis[1], *n = f->axis[2];

  if (!ContactFacetNormal(x, n)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) {
    f->origin[c] = 0.25 * (x[c] + x[3 + c] + x[6 + c] + x[9 + c]);
    t[c]         = x[6 + c] - x[c]; /* Axis 0 is parallel to a diagonal. The diagonal lies in the plane, because the
                                       normal is the cross product of the diagonals. */
  }
  (void)VectorScaleToUnit(t);
  VectorCross(n, t, s);
  return PETSC_TRUE;
}

/* Computes the plane coordinates p of the vertices of the facet x, and their heights above the plane [length] */
void ContactFrameProject(const ContactFrame *f, const PetscReal x[12], PetscReal p[4][2], PetscReal height[4])
{
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal d[3] = {x[3 * a] - f->origin[0], x[3 * a + 1] - f->origin[1], x[3 * a + 2] - f->origin[2]};

    p[a][0]   = VectorDot(d, f->axis[0]);
    p[a][1]   = VectorDot(d, f->axis[1]);
    height[a] = VectorDot(d, f->axis[2]);
  }
}
