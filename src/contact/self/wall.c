/*
   Tells the two sides of a wall from two parts of a surface in contact. Where a body is thin, its opposite sides face
   away from each other, and the search along a normal finds the far side behind the near one, like a surface that has
   penetrated. The undeformed body tells the difference: only the far side of the wall is straight behind the near one
   there.
*/
#include "selfimpl.h"

#define WALL_DEPTH   0.5 /* a wall is at least this fraction of a cell deep; points less far behind touch */
#define WALL_LATERAL 2.0 /* points of a wall's two sides are displaced along it by less than this times its thickness */

/* Whether two facets have a common vertex */
static PetscBool WallSharesVertex(const ContactSelfFacet *one, const ContactSelfFacet *two)
{
  for (PetscInt a = 0; a < 4; ++a) {
    for (PetscInt b = 0; b < 4; ++b) {
      if (one->node[a] == two->node[b]) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/* Whether the body is between two points of the undeformed surface: x1 on facet one, x2 on facet two */
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
