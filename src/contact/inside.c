/*
   Points of the boundary of one body that are inside another body: overlaps at the start that are deeper than the
   search, and bodies that have passed into each other through faces that are not the pair's. A point of a facet is
   inside by a depth if the other body contains the point, and the points behind it, against the normal of the facet,
   up to this depth.
*/
#include "contactimpl.h"
#include "src/mesh/query/queryimpl.h"

#define INSIDE_MOST  500 /* largest number of points of a face and a rank that are tested; it bounds the time */
#define INSIDE_PARTS 5   /* number of points of a depth that are tested */
#define INSIDE_EDGE  0.1 /* distance of points from the corners of their facets, relative to that of the center */

/* A point of a facet. All fields are real, so that points can be sent as one array. */
typedef struct {
  PetscReal from[3], x[3], normal[3]; /* coordinates at the start and at present [length]; unit normal of the facet */
  PetscReal inside;                   /* 1: it may be inside the other body; 0: it is not */
} InsidePoint;
#define INSIDE_REALS ((PetscInt)(sizeof(InsidePoint) / sizeof(PetscReal)))

/* Collects points near the corners, and the centers, of n facets that are in a box. At the corners themselves, bodies
   may touch beside the facets, and a point in the plane of a facet is neither inside nor outside. body: the bodies of
   the facets, of which those of the body `own` count; NULL: all count. x0, x: [12 n] coordinates at the start and at
   present [length]. point: [INSIDE_MOST], a sample of them. */
static void InsideCollect(PetscInt n, const PetscInt body[], PetscInt own, const PetscReal x0[], const PetscReal x[],
  const PetscReal box[6], PetscInt *npoints, InsidePoint point[])
{
  PetscInt found = 0, every = 1;

  for (PetscInt pass = 0; pass < 2; ++pass) {
    every    = PetscMax(1, (found + INSIDE_MOST - 1) / INSIDE_MOST);
    found    = 0;
    *npoints = 0;
    for (PetscInt i = 0; i < 5 * n; ++i) {
      const PetscInt f  = i / 5;
      InsidePoint    at = {.inside = 1.0};

      if ((body && body[f] != own) || !ContactFacetNormal(&x[12 * f], at.normal)) continue;
      for (PetscInt k = 0; k < 12; ++k) {
        const PetscReal center = i % 5 == 4 ? 1.0 : INSIDE_EDGE;
        const PetscReal weight = 0.25 * center + (1.0 - center) * (PetscReal)(k / 3 == i % 5);

        at.from[k % 3] += weight * x0[12 * f + k];
        at.x[k % 3] += weight * x[12 * f + k];
      }
      for (PetscInt c = 0; c < 3; ++c) at.inside *= (PetscReal)(at.x[c] > box[c] && at.x[c] < box[3 + c]);
      if (at.inside > 0.0 && found++ % every == 0 && pass) point[(*npoints)++] = at;
    }
  }
}

/* Collective. Computes which of the points, moved by depth[k] against the normal, are in the body, and calls the others
   not inside; depth = NULL: at the start, and those in the body are not inside */
static PetscErrorCode InsideTest(const ContactBoundary *b, PetscInt body, PetscInt n, InsidePoint point[],
  const PetscReal depth[])
{
  PetscReal *angle;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(n, &angle));
  for (PetscInt k = 0; k < n; ++k) {
    PetscReal x[3];

    for (PetscInt c = 0; c < 3; ++c) x[c] = depth ? point[k].x[c] - depth[k] * point[k].normal[c] : point[k].from[c];
    if (point[k].inside > 0.0) angle[k] = ContactBoundarySolidAngle(b, body, x);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, angle, (PetscMPIInt)n, MPIU_REAL, MPIU_SUM, b->comm));
  for (PetscInt k = 0; k < n; ++k) {
    /* most of the whole angle 4 pi; half of it, on the boundary, is outside */
    if (depth ? angle[k] < 0.9 * 4.0 * PETSC_PI : angle[k] > 0.6 * 4.0 * PETSC_PI) point[k].inside = 0.0;
  }
  PetscCall(PetscFree(angle));
  PetscFunctionReturn(0);
}

/* Collective. Leaves only the points that are in the body by at least a depth [length]. *any: whether there are any */
static PetscErrorCode InsideKeep(const ContactBoundary *b, PetscInt body, PetscReal depth, PetscInt n,
  InsidePoint point[], PetscBool *any)
{
  PetscReal *at;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &at));
  *any = (PetscBool)(n > 0);
  for (PetscInt j = 0; j < INSIDE_PARTS && *any; ++j) {
    for (PetscInt k = 0; k < n; ++k) at[k] = depth * (PetscReal)j / (INSIDE_PARTS - 1);
    PetscCall(InsideTest(b, body, n, point, at));
    *any = PETSC_FALSE;
    for (PetscInt k = 0; k < n; ++k) *any = (PetscBool)(*any || point[k].inside > 0.0);
  }
  PetscCall(PetscFree(at));
  PetscFunctionReturn(0);
}

/* Collective. Increases *deepest to the largest depth of the points, which are inside by `least` [length] */
static PetscErrorCode InsideMeasure(const ContactBoundary *b, PetscInt body, PetscReal least, PetscInt n,
  InsidePoint point[], PetscReal *deepest)
{
  PetscReal low = least, high = PETSC_INFINITY;
  PetscBool any;

  PetscFunctionBegin;
  while (high - low > 1e-7 * low) {
    const PetscReal at = high < PETSC_INFINITY ? 0.5 * (low + high) : 2.0 * low;
    InsidePoint    *deeper;

    PetscCall(PetscMalloc1(n, &deeper));
    PetscCall(PetscArraycpy(deeper, point, n));
    PetscCall(InsideKeep(b, body, at, n, deeper, &any));
    if (any) PetscCall(PetscArraycpy(point, deeper, n));
    if (any) low = at;
    else high = at;
    PetscCall(PetscFree(deeper));
  }
  *deepest = PetscMax(*deepest, high);
  PetscFunctionReturn(0);
}

/*@
  ContactCheckDepth - Checks that no undeformed bodies overlap by more than the search depth

  Collective

  Input Parameter:
. contact - the contact

  Level: intermediate

  Note:
  Such bodies would have no contact rows and would penetrate each other. The error message names the pair, the depth,
  and the option that increases the search depth. Points of the pairs' faces are tested if they are in the bounding box
  of the other body.

.seealso: `ContactLinearize()`, `ContactGetReach()`
@*/
PetscErrorCode ContactCheckDepth(Contact contact)
{
  const ContactPairData *pair = NULL;
  ContactBoundary        boundary;
  PetscReal             *box, depth = 0.0;

  PetscFunctionBegin;
  PetscCall(ContactBoundaryCreate(contact->dm, &boundary));
  PetscCall(PetscMalloc1(6 * boundary.nbodies, &box));
  PetscCall(MeshGetBodyBoxes(contact->dm, NULL, boundary.nbodies, box));
  for (PetscInt p = 0; p < contact->npairs && depth == 0.0; ++p) {
    pair = &contact->pairs[p];
    for (PetscInt s = 0; s < 2 && !pair->formula && pair->mortar.body != pair->nonmortar.body; ++s) {
      const ContactSurface *side  = s ? &pair->mortar : &pair->nonmortar;
      const PetscInt        other = s ? pair->nonmortar.body : pair->mortar.body;
      InsidePoint          *point;
      PetscInt              n;
      PetscBool             any;

      PetscCall(PetscMalloc1(INSIDE_MOST, &point));
      InsideCollect(side->nfacets, NULL, 0, side->reference, side->reference, &box[6 * other], &n, point);
      PetscCall(RecordsGather(contact->comm, INSIDE_REALS, &n, &point));
      PetscCall(InsideKeep(&boundary, other, pair->depth, n, point, &any));
      if (any) PetscCall(InsideMeasure(&boundary, other, pair->depth, n, point, &depth));
      PetscCall(PetscFree(point));
    }
  }
  PetscCall(PetscFree(box));
  PetscCall(ContactBoundaryDestroy(&boundary));
  SceneCheck(depth == 0.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, pair,
    "The bodies of contact pair \"%s\", mortar %s and nonmortar %s, overlap at the start by %g, which exceeds the "
    "search depth %g: move the bodies apart, or use -contact_search_depth %.2g",
    pair->name, pair->mortar.name, pair->nonmortar.name, (double)depth, (double)pair->depth, 1.1 * (double)depth);
  PetscFunctionReturn(0);
}

/*
   Collective. Finds whether one of the bodies of pair p, which were apart at the start, is inside the other one at the
   global displacement u.

   - margin: depth that does not count [length]
   - entered: whether a point of the boundary is deeper
   - place: where this point was at the start [length]

   It is meant for pairs without contact, and tests a sample of the points.
*/
PetscErrorCode ContactGetEntered(Contact contact, PetscInt p, Vec u, PetscReal margin, PetscBool *entered,
  PetscReal place[3])
{
  const ContactPairData *pair    = &contact->pairs[p];
  const PetscInt         body[2] = {pair->mortar.body, pair->nonmortar.body};
  ContactBoundary        start, now;
  PetscReal             *box;

  PetscFunctionBegin;
  *entered = PETSC_FALSE;
  if (pair->formula || body[0] == body[1]) PetscFunctionReturn(0);
  PetscCall(ContactBoundaryCreate(contact->dm, &start));
  PetscCall(ContactBoundaryCreate(contact->dm, &now));
  PetscCall(ContactBoundaryDeform(contact->dm, u, &now));
  PetscCall(PetscMalloc1(6 * now.nbodies, &box));
  PetscCall(MeshGetBodyBoxes(contact->dm, u, now.nbodies, box));
  for (PetscInt s = 0; s < 2 && !*entered; ++s) {
    const PetscInt other = body[1 - s];
    InsidePoint   *point;
    PetscInt       n;

    PetscCall(PetscMalloc1(INSIDE_MOST, &point));
    InsideCollect(now.n, now.body, body[s], start.x, now.x, &box[6 * other], &n, point);
    PetscCall(RecordsGather(contact->comm, INSIDE_REALS, &n, &point));
    PetscCall(InsideTest(&start, other, n, point, NULL));
    PetscCall(InsideKeep(&now, other, margin, n, point, entered));
    for (PetscInt k = n - 1; k >= 0; --k) {
      if (point[k].inside > 0.0) PetscCall(PetscArraycpy(place, point[k].from, 3));
    }
    PetscCall(PetscFree(point));
  }
  PetscCall(PetscFree(box));
  PetscCall(ContactBoundaryDestroy(&start));
  PetscCall(ContactBoundaryDestroy(&now));
  PetscFunctionReturn(0);
}
