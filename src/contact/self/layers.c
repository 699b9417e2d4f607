/*
   Selects the overlaps of a facet with facets of its own surface. A line along the normal of a facet may cross the
   surface several times. In front of the facet it crosses the surface that the facet touches, and other layers beyond
   it. Behind the facet it crosses the opposite side of the facet's own wall, and other layers beyond that. Only the
   nearest layer in front is kept.
*/
#include "selfimpl.h"

/* Data of the overlap of a facet with another facet of the same surface */
typedef struct {
  PetscReal centre[2]; /* centroid of the overlap, in the plane of the facet */
  PetscBool wall;      /* the other facet is on the opposite side of the facet's own wall */
  PetscBool below;     /* the other facet is on that side or behind it */
  PetscBool hidden;    /* the overlap is not used: the other facet is below, or in front but not in the nearest layer */
} SelfOverlap;

static void LayerCentre(const ContactOverlap *o, PetscReal centre[2])
{
  PetscReal area = 0.0;

  centre[0] = centre[1] = 0.0;
  for (PetscInt t = 0; t < o->ntriangles; ++t) {
    PetscReal x[3][2], part;

    for (PetscInt v = 0; v < 3; ++v) {
      for (PetscInt d = 0; d < 2; ++d) x[v][d] = o->corner[o->triangle[t].corner[v]].y[d];
    }
    part = PetscAbsReal(ContactPolygonArea(3, (const PetscReal(*)[2])x));
    area += part;
    for (PetscInt d = 0; d < 2; ++d) centre[d] += part * (x[0][d] + x[1][d] + x[2][d]) / 3.0;
  }
  for (PetscInt d = 0; d < 2 && area > 0.0; ++d) centre[d] /= area;
}

/* Returns whether a point of the facet's plane is inside the overlap */
static PetscBool LayerHolds(const ContactOverlap *o, const PetscReal y[2])
{
  for (PetscInt t = 0; t < o->ntriangles; ++t) {
    PetscInt left = 0, right = 0;

    for (PetscInt v = 0; v < 3; ++v) {
      const PetscReal *a = o->corner[o->triangle[t].corner[v]].y, *b = o->corner[o->triangle[t].corner[(v + 1) % 3]].y;
      const PetscReal  side = (b[0] - a[0]) * (y[1] - a[1]) - (b[1] - a[1]) * (y[0] - a[0]);

      left += side >= 0.0;
      right += side <= 0.0;
    }
    if (left == 3 || right == 3) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Computes the mean position of the overlap's quadrature points on one of the facets, in the undeformed state */
static void LayerPlace(const ContactOverlap *o, const PetscReal xi[][2], const PetscReal reference[12], PetscReal x[3])
{
  x[0] = x[1] = x[2] = 0.0;
  for (PetscInt q = 0; q < o->n; ++q) {
    PetscReal phi[4];

    ContactShape(xi[q], phi);
    for (PetscInt i = 0; i < 12; ++i) x[i % 3] += o->weight[q] / o->area * phi[i / 3] * reference[i];
  }
}

/* Sets `below` and `hidden` of all overlaps of a facet */
static void LayersHide(PetscInt n, const ContactOverlap overlap[], SelfOverlap known[])
{
  for (PetscInt j = 0; j < n; ++j) {
    known[j].hidden = known[j].wall;
    for (PetscInt i = 0; i < n && !known[j].hidden; ++i)
      known[j].hidden =
        (PetscBool)(known[i].wall && overlap[i].gap > overlap[j].gap && LayerHolds(&overlap[i], known[j].centre));
    known[j].below = known[j].hidden;
  }
  for (PetscInt j = 0; j < n; ++j) {
    for (PetscInt i = 0; i < n && !known[j].hidden; ++i)
      known[j].hidden =
        (PetscBool)(!known[i].below && overlap[i].gap < overlap[j].gap && LayerHolds(&overlap[i], known[j].centre));
  }
}

/* Selects from the n overlaps of a facet those that are not hidden and in which the facet is the nonmortar one.
   mortar: numbers of the other facets among the candidates */
PetscErrorCode ContactSelfSelect(const ContactSelfFacet *facet, const ContactCandidates *facets, PetscInt *n,
  PetscInt mortar[], ContactOverlap overlap[])
{
  SelfOverlap *known;
  PetscInt     kept = 0;

  PetscFunctionBegin;
  if (!*n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(*n, &known));
  for (PetscInt k = 0; k < *n; ++k) {
    const ContactSelfFacet other = ContactSelfCandidate(facets, mortar[k]);
    PetscReal              x1[3], x2[3];

    LayerPlace(&overlap[k], (const PetscReal(*)[2])overlap[k].xi1, facet->reference, x1);
    LayerPlace(&overlap[k], (const PetscReal(*)[2])overlap[k].xi2, other.reference, x2);
    LayerCentre(&overlap[k], known[k].centre);
    known[k].wall = ContactSelfIsWall(facet, x1, &other, x2);
  }
  LayersHide(*n, overlap, known);
  for (PetscInt k = 0; k < *n; ++k) {
    if (known[k].hidden || ContactSelfCandidate(facets, mortar[k]).rank <= facet->rank) continue;
    if (kept < k) {
      mortar[kept] = mortar[k];
      PetscCall(PetscMemcpy(&overlap[kept], &overlap[k], sizeof(*overlap)));
    }
    ++kept;
  }
  *n = kept;
  PetscCall(PetscFree(known));
  PetscFunctionReturn(0);
}
