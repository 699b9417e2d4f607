/* Decides which of two surfaces is nonmortar. Rules are tried in turn until the surfaces differ in one. */
#include "detectimpl.h"

/* The smallest ratios of two surfaces at which a rule decides: */
#define SIDES_FINER  2.25 /* of the mean areas of the facets; edge lengths then differ by 1.5 */
#define SIDES_SOFTER 2.0  /* of Young's moduli */
#define SIDES_LARGER 1.25 /* of the areas of the surfaces */

/* Returns the mean area of the facets of one side that face the other surface [length^2], or of all its facets if none
   do. A facet of order 2 counts as four. */
static PetscReal SidesFacet(const DetectModel *model, const DetectPair *pair, PetscInt side)
{
  const PetscInt s = pair->surface[side];

  if (pair->facet[side] > 0.0) return pair->facet[side];
  return model->fine[model->surfaces.body[s]] * model->area[s] / (PetscReal)model->nfacets[s];
}

/* Returns the side with the smaller value, or PETSC_DECIDE if the two values differ by less than the ratio */
static PetscInt SidesSmaller(PetscReal first, PetscReal second, PetscReal ratio)
{
  if (first * ratio <= second) return 0;
  return second * ratio <= first ? 1 : PETSC_DECIDE;
}

PetscInt DetectNonmortar(const DetectModel *model, Scene scene, const DetectPair *pair, const char **why)
{
  const SceneBody *body[2];
  PetscInt         side;

  for (side = 0; side < 2; ++side) body[side] = &scene->bodies[model->surfaces.body[pair->surface[side]]];
  *why = "the other body is rigid";
  for (side = 0; side < 2; ++side) {
    if (SceneBodyIsSurface(body[1 - side])) return side;
  }
  for (side = 0; side < 2; ++side) {
    if (body[1 - side]->material.type == MATERIAL_RIGID && body[side]->material.type != MATERIAL_RIGID) return side;
  }
  *why = "its facets are finer";
  side = SidesSmaller(SidesFacet(model, pair, 0), SidesFacet(model, pair, 1), SIDES_FINER);
  if (side >= 0) return side;
  *why = "it is the smaller surface";
  side = SidesSmaller(model->area[pair->surface[0]], model->area[pair->surface[1]], SIDES_LARGER);
  if (side >= 0) return side;
  *why = "its body is softer";
  side = SidesSmaller(body[0]->material.young, body[1]->material.young, SIDES_SOFTER);
  if (side >= 0) return side;
  *why = "its body is listed later";
  return 1;
}
