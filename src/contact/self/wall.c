/*
   Finds whether two facets of a surface are the two sides of a wall, or two parts of the surface in contact. In both
   cases the facets face opposite directions. The search along the normal of a facet finds the far side of a thin wall
   behind the facet, like a part of the surface that penetrates it. The undeformed body shows the difference: there,
   only the far side of the wall is straight behind the facet.
*/
#include "selfimpl.h"

#define WALL_DEPTH \
  0.5 /* a wall has at least this thickness, as a fraction of the cell's depth; points closer than
                            this are in contact */
#define WALL_LATERAL \
  2.0 /* opposite points of a wall's two sides are shifted along it by less than this times its
                            thickness */

/* Returns whether two facets have a common vertex */
static PetscBool WallSharesVertex(const ContactSelfFacet *one, const ContactSelfFacet *two)
{
  for (PetscInt a = 0; a < 4; ++a) {
    for (PetscInt b = 0; b < 4; ++b) {
      if (one->node[a] == two->node[b]) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/* Returns whether the body lies between two points of the undeformed surface: x1 on facet one, x2 on facet two */
PetscBool ContactSelfIsWall(const ContactSelfFacet *one, const PetscReal x1[3], const ContactSelfFacet *two,
  const PetscReal x2[3])
{
  const PetscReal least = WallSharesVertex(one, two) ? PETSC_SQRT_MACHINE_EPSILON * ContactFacetDiameter(one->reference)
                                                     : WALL_DEPTH * PetscMin(one->below, two->below);
  const PetscReal apart[3] = {x2[0] - x1[0], x2[1] - x1[1], x2[2] - x1[2]};
  PetscReal       n1[3], n2[3], thickness;

  if (!ContactFacetNormal(one->reference, n1) || !ContactFacetNormal(two->reference, n2)) return PETSC_FALSE;
  thickness = -VectorDot(apart, n1);
  if (!(thickness > least && VectorDot(apart, n2) > least)) return PETSC_FALSE;
  return (PetscBool)(VectorDot(apart, apart) <= (1.0 + WALL_LATERAL * WALL_LATERAL) * thickness * thickness);
}
