/* Refines the zones of the scene: cells near a face, near both faces of a contact pair, or in a box, until they have
   the requested level */
#include "refineimpl.h"

/* The geometry of a zone: up to two faces, or a box if nfaces is 0 */
typedef struct {
  PetscInt         nfaces, n[2]; /* number of faces, and number of facets of each face */
  const SceneBody *surface[2];   /* the rigid surface that a face belongs to; NULL: it has facets */
  PetscReal        all[2][6];    /* box around each whole face, or the box of the zone [length] */
  PetscReal       *facets[2];    /* boxes around the facets of each face, 6 numbers per box [length] */
} Zone;

static void ZoneBoxClear(PetscReal box[6])
{
  for (PetscInt d = 0; d < 3; ++d) {
    box[d]     = PETSC_MAX_REAL;
    box[3 + d] = PETSC_MIN_REAL;
  }
}

static void ZoneBoxAdd(PetscReal box[6], const PetscReal x[3])
{
  for (PetscInt d = 0; d < 3; ++d) {
    box[d]     = PetscMin(box[d], x[d]);
    box[3 + d] = PetscMax(box[3 + d], x[d]);
  }
}

/* Returns whether the distance of two boxes is at most `distance` [length], up to rounding */
static PetscBool ZoneBoxesMeet(const PetscReal a[6], const PetscReal b[6], PetscReal distance)
{
  PetscReal square = 0, size = 0;

  for (PetscInt d = 0; d < 3; ++d) {
    square += PetscSqr(PetscMax(0, PetscMax(a[d] - b[3 + d], b[d] - a[3 + d])));
    size += a[3 + d] - a[d];
  }
  return (PetscBool)(PetscSqrtReal(square) <= distance + 1e-9 * size);
}

/* Returns whether a box is within the distance of a rigid surface. The point of the box that is nearest to the surface
   is found by steps to the surface and back into the box. */
static PetscBool ZoneSurfaceMeets(const SceneBody *surface, const PetscReal box[6], PetscReal distance)
{
  const PetscInt steps = 20; /* a plane needs two */
  PetscReal      x[3], slope[3], size = 0.0, away;

  for (PetscInt d = 0; d < 3; ++d) {
    x[d] = 0.5 * (box[d] + box[3 + d]);
    size += box[3 + d] - box[d];
  }
  away = SceneSurfaceDistance(surface, x, slope);
  for (PetscInt k = 0; k < steps && away > distance; ++k) {
    for (PetscInt d = 0; d < 3; ++d) x[d] = PetscClipInterval(x[d] - away * slope[d], box[d], box[3 + d]);
    away = SceneSurfaceDistance(surface, x, slope);
  }
  return (PetscBool)(away <= distance + 1e-9 * size);
}

/* Computes the position of a vertex of a body. The coordinates of curved shapes are still parameters here. */
static PetscErrorCode ZonePlaceVertex(const SceneBody *body, const PetscReal parameters[3], PetscReal x[3])
{
  const Shape *shape;

  PetscFunctionBegin;
  PetscCall(ShapeGet(PETSC_COMM_SELF, body, &shape));
  if (shape && shape->map && body->curved) PetscCall(shape->map(body, parameters, x));
  else PetscCall(PetscArraycpy(x, parameters, 3));
  PetscFunctionReturn(0);
}

static PetscErrorCode ZoneAddFace(DM dm, const SceneBody bodies[], const char face[], Zone *zone)
{
  const PetscInt  k = zone->nfaces++;
  IS              facets;
  const PetscInt *f;

  PetscFunctionBegin;
  ZoneBoxClear(zone->all[k]);
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &zone->n[k]));
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(PetscMalloc1(6 * zone->n[k], &zone->facets[k]));
  for (PetscInt i = 0; i < zone->n[k]; ++i) {
    const PetscInt *cells;
    PetscInt        vertices[4], body;
    PetscReal       x[4][3];

    PetscCall(MeshGetFacetVertices(dm, f[i], vertices));
    PetscCall(MeshGetVertexCoordinates(dm, 4, vertices, x));
    PetscCall(DMPlexGetSupport(dm, f[i], &cells));
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, cells[0], &body));
    if (SceneBodyIsSurface(&bodies[body])) zone->surface[k] = &bodies[body];
    ZoneBoxClear(&zone->facets[k][6 * i]);
    for (PetscInt a = 0; a < 4; ++a) {
      PetscCall(ZonePlaceVertex(&bodies[body], x[a], x[a]));
      ZoneBoxAdd(&zone->facets[k][6 * i], x[a]);
      ZoneBoxAdd(zone->all[k], x[a]);
    }
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

static PetscErrorCode ZoneCreate(DM dm, const SceneBody bodies[], const SceneRefinement *refinement, Zone *zone)
{
  PetscFunctionBegin;
  PetscCall(PetscMemzero(zone, sizeof(*zone)));
  for (PetscInt k = 0; k < 2 && refinement->face[k]; ++k) PetscCall(ZoneAddFace(dm, bodies, refinement->face[k], zone));
  for (PetscInt d = 0; d < 3 && !zone->nfaces; ++d) {
    zone->all[0][d]     = refinement->lower[d];
    zone->all[0][3 + d] = refinement->upper[d];
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ZoneDestroy(Zone *zone)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) PetscCall(PetscFree(zone->facets[k]));
  PetscFunctionReturn(0);
}

/* Returns whether a box is within the distance of a facet of each face, or of the zone's box */
static PetscBool ZoneHolds(const Zone *zone, PetscReal distance, const PetscReal box[6])
{
  if (!zone->nfaces) return ZoneBoxesMeet(zone->all[0], box, distance);
  for (PetscInt k = 0; k < zone->nfaces; ++k) {
    PetscInt i = ZoneBoxesMeet(zone->all[k], box, distance) ? 0 : zone->n[k];

    if (zone->surface[k]) {
      if (!ZoneSurfaceMeets(zone->surface[k], box, distance)) return PETSC_FALSE;
      continue;
    }
    while (i < zone->n[k] && !ZoneBoxesMeet(&zone->facets[k][6 * i], box, distance)) ++i;
    if (i == zone->n[k]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Computes the body of each cell, and the box around it, 6 numbers per cell */
static PetscErrorCode ZonesGetBoxes(DM dm, const SceneBody bodies[], const MeshHexes *hexes, PetscInt body[],
  PetscReal box[])
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, hexes->root[c], &body[c]));
    ZoneBoxClear(&box[6 * c]);
    for (PetscInt a = 0; a < 8; ++a) {
      PetscReal x[3];

      PetscCall(ZonePlaceVertex(&bodies[body[c]], &hexes->x[3 * hexes->vertex[8 * c + a]], x));
      ZoneBoxAdd(&box[6 * c], x);
    }
  }
  PetscFunctionReturn(0);
}

/* Reports that no cell is near both faces, or in the box */
static PetscErrorCode ZoneError(const SceneBody bodies[], const SceneRefinement *refinement)
{
  const PetscReal  *a = refinement->lower, *b = refinement->upper;
  const char *const body = refinement->body >= 0 ? bodies[refinement->body].name : "";

  PetscFunctionBegin;
  SceneCheck(!refinement->face[1], PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, refinement,
    "refinement \"%s\": no cell is within the distance %g of both faces, \"%s\" and \"%s\": increase the distance",
    refinement->name, (double)refinement->distance, refinement->face[0], refinement->face[1]);
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "%s"
    "refinement \"%s\": its box, lower: [%g, %g, %g] and upper: [%g, %g, %g], contains no cell of %s%s%s",
    ScenePlace(refinement), refinement->name, (double)a[0], (double)a[1], (double)a[2], (double)b[0], (double)b[1],
    (double)b[2], *body ? "body \"" : "any body", body, *body ? "\"" : "");
}

/* Marks the cells of a zone that have not reached its level. It is an error if the zone contains no cell. */
static PetscErrorCode ZoneMark(const SceneBody bodies[], const SceneRefinement *refinement, const Zone *zone,
  const MeshHexes *hexes, const PetscInt body[], const PetscReal box[], PetscBool marked[], PetscBool *more)
{
  PetscInt n = 0;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    if (refinement->body >= 0 && body[c] != refinement->body) continue;
    if (SceneBodyIsSurface(&bodies[body[c]])) continue; /* its cell is only for pictures */
    if (!ZoneHolds(zone, refinement->distance, &box[6 * c])) continue;
    ++n;
    if (hexes->place[4 * c + 3] >= refinement->levels) continue;
    SceneCheck(bodies[body[c]].order < 2, PETSC_COMM_SELF, PETSC_ERR_SUP, refinement,
      "refinement \"%s\": body \"%s\" has order %" PetscInt_FMT ", but only hexahedra of order 1 are refined locally",
      refinement->name, bodies[body[c]].name, bodies[body[c]].order);
    marked[c] = PETSC_TRUE;
    *more     = PETSC_TRUE;
  }
  if (!n) PetscCall(ZoneError(bodies, refinement));
  PetscFunctionReturn(0);
}

/* Refines the zones until their cells have the requested level. Not collective. dm: the mesh before local refinement */
PetscErrorCode MeshHexesRefineZones(DM dm, const SceneBody bodies[], PetscInt n, const SceneRefinement refinements[],
  MeshHexes *hexes)
{
  PetscBool more = (PetscBool)(n > 0);
  Zone     *zones;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &zones));
  for (PetscInt z = 0; z < n; ++z) PetscCall(ZoneCreate(dm, bodies, &refinements[z], &zones[z]));
  while (more) {
    PetscBool *marked;
    PetscInt  *body;
    PetscReal *box;

    more = PETSC_FALSE;
    PetscCall(PetscCalloc1(hexes->ncells, &marked));
    PetscCall(PetscMalloc2(hexes->ncells, &body, 6 * hexes->ncells, &box));
    PetscCall(ZonesGetBoxes(dm, bodies, hexes, body, box));
    for (PetscInt z = 0; z < n; ++z)
      PetscCall(ZoneMark(bodies, &refinements[z], &zones[z], hexes, body, box, marked, &more));
    PetscCall(PetscFree2(body, box));
    if (more) PetscCall(MeshHexesRefine(hexes, marked));
    PetscCall(PetscFree(marked));
  }
  for (PetscInt z = 0; z < n; ++z) PetscCall(ZoneDestroy(&zones[z]));
  PetscCall(PetscFree(zones));
  PetscFunctionReturn(0);
}
