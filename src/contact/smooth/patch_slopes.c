/* Derivatives of quantities at a patch's points with respect to the parameters and to rotations of the patch */
#include "smoothimpl.h"

/* Squared cosine of 60 degrees. If a direction makes a larger angle with the patch's normal, heights along it are not
   measured with the tangent plane. */
#define STEEPEST_SQUARED_COSINE 0.25

/* Returns the derivative of the height of edge e with respect to its position eta in [0, 1], multiplied by `blend`, and
   computes the height itself [length] */
static PetscReal EdgeSlope(const ContactPatch *p, PetscInt e, PetscReal eta, PetscReal blend, PetscReal *height)
{
  const PetscReal a0 = p->slope[e][0], a1 = p->slope[e][1], bump = eta * (1.0 - eta),
                  tilt = a0 * (1.0 - eta) - a1 * eta;

  *height = bump * tilt;
  return blend * ((1.0 - 2.0 * eta) * tilt - bump * (a0 + a1));
}

/*
   Converts derivatives with respect to offset and normal, as computed by ContactPatchEvaluate() at xi, into derivatives
   by_xi with respect to xi, and into those with respect to a rotation `turn` [rad] of the patch about each axis
*/
void ContactPatchDifferentiate(const ContactPatch *p, const PetscReal xi[2], const PetscReal offset[3],
  const PetscReal patch_normal[3], const PetscReal by_offset[3], const PetscReal by_normal[3], PetscReal by_xi[2],
  PetscReal turn[3])
{
  const PetscReal s = 0.5 * (1.0 + xi[0]), t = 0.5 * (1.0 + xi[1]), along[4] = {s, t, 1.0 - s, 1.0 - t},
                  blend[4] = {p->triangle ? (1.0 - t) * (1.0 - t) : 1.0 - t, s, t, 1.0 - s};
  PetscReal dphi[4][2], k[3];

  ContactShapeSlopes(xi, dphi);
  by_xi[0] = by_xi[1] = 0.0;
  for (PetscInt e = 0; e < 4; ++e) {
    const PetscReal direction = VectorDot(p->direction[e], by_offset), normal = VectorDot(&p->normal[3 * e], by_normal),
                    forward = e < 2 ? 0.5 : -0.5, outward = e == 1 || e == 2 ? 0.5 : -0.5;
    PetscReal height;

    by_xi[e % 2] += forward * EdgeSlope(p, e, along[e], blend[e], &height) * direction;
    by_xi[1 - e % 2] += (p->triangle && !e ? 2.0 * (1.0 - t) : 1.0) * outward * height * direction;
    for (PetscInt d = 0; d < 2; ++d) by_xi[d] += dphi[e][d] * normal;
  }
  VectorCross(offset, by_offset, turn);
  VectorCross(patch_normal, by_normal, k);
  for (PetscInt c = 0; c < 3; ++c) turn[c] += k[c];
}

/* Returns the height of the patch above its facet's point xi along a unit direction [length], measured to the tangent
   plane at the patch's point. Computes the derivatives of the height with respect to xi and to a rotation `turn` [rad]
   of the patch about each axis, unless by_xi and turn are NULL. */
PetscReal ContactPatchHeight(const ContactPatch *p, const PetscReal xi[2], const PetscReal direction[3],
  PetscReal by_xi[2], PetscReal turn[3])
{
  PetscReal offset[3], normal[3], by_offset[3], by_normal[3], height, cosine;

  ContactPatchEvaluate(p, xi, offset, normal);
  cosine = VectorDot(normal, direction);
  if (PetscSqr(cosine) < STEEPEST_SQUARED_COSINE * VectorDot(normal, normal)) {
    height = VectorDot(offset, direction);
    for (PetscInt c = 0; c < 3; ++c) {
      by_offset[c] = direction[c];
      by_normal[c] = 0.0;
    }
  } else {
    /* If there is no normal, the offset is zero. */
    height = cosine != 0.0 ? VectorDot(offset, normal) / cosine : 0.0;
    for (PetscInt c = 0; c < 3; ++c) {
      by_offset[c] = cosine != 0.0 ? normal[c] / cosine : 0.0;
      by_normal[c] = cosine != 0.0 ? (offset[c] - height * direction[c]) / cosine : 0.0;
    }
  }
  if (!by_xi) return height;
  ContactPatchDifferentiate(p, xi, offset, normal, by_offset, by_normal, by_xi, turn);
  return height;
}
