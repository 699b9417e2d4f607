/* Rays from a facet along its normal, and the facets that they hit */
#include "detectimpl.h"

#define RAY_INSIDE 0.8 /* facet parameter, instead of 1, at which the rays near the corners start */

PetscErrorCode DetectStateCreate(const DetectModel *model, const DetectMove moves[], DetectState *state)
{
  const MeshSurfaces *s = &model->surfaces;

  PetscFunctionBegin;
  state->model  = model;
  state->moves  = moves;
  state->facets = (ContactCandidates){.n = s->n};
  PetscCall(PetscMalloc1(12 * s->n, &state->facets.x));
  for (PetscInt f = 0; f < s->n; ++f)
    DetectMovePoints(&moves[s->body[s->surface[f]]], 4, &s->x[12 * f], &state->facets.x[12 * f]);
  PetscCall(ContactTreeCreate(&state->facets, &state->tree));
  PetscFunctionReturn(0);
}

PetscErrorCode DetectStateDestroy(DetectState *state)
{
  PetscFunctionBegin;
  PetscCall(ContactTreeDestroy(&state->tree));
  PetscCall(PetscFree(state->facets.x));
  PetscFunctionReturn(0);
}

/* Returns whether the line origin + t direction meets a box for some t in [low, high] */
static PetscBool RayMeetsBox(const PetscReal box[6], const PetscReal origin[3], const PetscReal direction[3],
  PetscReal low, PetscReal high)
{
  for (PetscInt c = 0; c < 3; ++c) {
    if (PetscAbsReal(direction[c]) < PETSC_MACHINE_EPSILON) {
      if (origin[c] < box[c] || origin[c] > box[3 + c]) return PETSC_FALSE;
    } else {
      const PetscReal t1 = (box[c] - origin[c]) / direction[c], t2 = (box[3 + c] - origin[c]) / direction[c];

      low  = PetscMax(low, PetscMin(t1, t2));
      high = PetscMin(high, PetscMax(t1, t2));
    }
  }
  return (PetscBool)(low <= high);
}

/* Intersects the line origin + t direction with the triangle a, b, c (Moeller and Trumbore 1997). The triangle is
   enlarged by a margin so that no ray passes between two triangles. Returns whether they meet, and at which t. */
static PetscBool RayMeetsTriangle(const PetscReal a[3], const PetscReal b[3], const PetscReal c[3],
  const PetscReal origin[3], const PetscReal direction[3], PetscReal *t)
{
  PetscReal e1[3], e2[3], r[3], p[3], q[3], det, u, v;

  for (PetscInt k = 0; k < 3; ++k) {
    e1[k] = b[k] - a[k];
    e2[k] = c[k] - a[k];
    r[k]  = origin[k] - a[k];
  }
  VectorCross(direction, e2, p);
  det = VectorDot(e1, p);
  if (!(PetscAbsReal(det) > 1e-12 * VectorNorm(e1) * VectorNorm(e2))) return PETSC_FALSE;
  u = VectorDot(r, p) / det;
  VectorCross(r, e1, q);
  v  = VectorDot(direction, q) / det;
  *t = VectorDot(e2, q) / det;
  return (PetscBool)(u >= -1e-6 && v >= -1e-6 && u + v <= 1.0 + 1e-6);
}

/* Intersects the line origin + t direction with a facet, and returns whether they meet. A facet whose normal does not
   oppose the direction is ignored. */
static PetscBool RayMeetsFacet(const PetscReal x[12], const PetscReal origin[3], const PetscReal direction[3],
  PetscReal *t)
{
  PetscReal n[3];

  if (!ContactFacetNormal(x, n) || VectorDot(n, direction) > CONTACT_NORMAL_COSINE) return PETSC_FALSE;
  if (RayMeetsTriangle(x, x + 3, x + 6, origin, direction, t)) return PETSC_TRUE;
  return (PetscBool)(!ContactFacetIsTriangle(x) && RayMeetsTriangle(x, x + 6, x + 9, origin, direction, t));
}

/* Adds a hit to the list. Hits in front of the start, farther than `touching`, share one entry, hits[*front], which is
   replaced if the new hit is nearer. Hits at or behind the start are all kept, up to DETECT_HITS. */
static void RayAdd(const DetectHit *hit, PetscReal touching, PetscInt *n, PetscInt *front, DetectHit hits[])
{
  if (hit->distance > touching) {
    if (*front >= 0 && hits[*front].distance <= hit->distance) return;
    if (*front < 0) *front = (*n)++;
    hits[*front] = *hit;
  } else if (*n < DETECT_HITS - (*front < 0)) hits[(*n)++] = *hit;
}

/* Adds the rigid surfaces without facets that the start of a ray faces. limit: distance of the nearest hit in front; a
   nearer hit reduces it */
static void RayAddRigidSurfaces(const DetectState *state, PetscInt facet, const PetscReal origin[3],
  const PetscReal normal[3], PetscReal touching, PetscReal *limit, PetscInt *n, PetscInt *front, DetectHit hits[])
{
  const DetectModel *model = state->model;
  const PetscReal    depth = 0.5 * model->thickness[model->surfaces.body[model->surfaces.surface[facet]]];

  for (PetscInt t = 0; t < model->ntools; ++t) {
    DetectHit hit = {.from = facet, .to = model->tool[t]};

    if (!DetectFacesRigidSurface(state, t, origin, normal, &hit.distance)) continue;
    if (hit.distance > *limit || hit.distance < -depth) continue;
    RayAdd(&hit, touching, n, front, hits);
    if (*front >= 0) *limit = PetscMin(*limit, hits[*front].distance);
  }
}

/* Gets the parameters of the point of a facet at which a ray starts */
void DetectGetStart(PetscInt ray, PetscReal xi[2])
{
  static const PetscReal parameter[DETECT_RAYS][2] = {{0, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

  for (PetscInt d = 0; d < 2; ++d) xi[d] = RAY_INSIDE * parameter[ray][d];
}

/*
   Sends one ray and returns the number of its hits. Ray 0 starts at the centre of the facet, the others start near its
   corners. A body, also the facet's own body, hides what is behind it. A body that touches or overlaps the facet hides
   everything in front of the facet.
*/
PetscInt DetectShoot(const DetectState *state, PetscInt facet, PetscInt ray, PetscReal reach,
  DetectHit hits[DETECT_HITS])
{
  const MeshSurfaces *s = &state->model->surfaces;
  const PetscReal    *x = &state->facets.x[12 * facet], *thickness = state->model->thickness;
  const PetscInt      body = s->body[s->surface[facet]];
  PetscReal           xi[2], phi[4], origin[3] = {0, 0, 0}, normal[3], limit = reach, touching;
  PetscInt            stack[CONTACT_TREE_DEPTH], depth = 0, n = 0, front = -1, kept = 0;

  if (!ContactFacetNormal(x, normal)) return 0;
  DetectGetStart(ray, xi);
  ContactShape(xi, phi);
  for (PetscInt i = 0; i < 12; ++i) origin[i % 3] += phi[i / 3] * x[i];
  touching = 1e-6 * thickness[body];
  RayAddRigidSurfaces(state, facet, origin, normal, touching, &limit, &n, &front, hits);
  if (state->tree.nnodes) stack[depth++] = 0;
  while (depth) {
    const PetscInt         self = stack[--depth];
    const ContactTreeNode *node = &state->tree.node[self];

    if (!RayMeetsBox(node->box, origin, normal, -0.5 * thickness[body], limit)) continue;
    if (node->second) {
      stack[depth++] = node->second;
      stack[depth++] = self + 1;
      continue;
    }
    for (PetscInt i = node->first; i < node->last; ++i) {
      const PetscInt other = state->tree.order[i], its = s->body[s->surface[other]];
      DetectHit      hit = {.from = facet, .to = other};

      if (other == facet || SceneBodyIsSurface(&state->model->bodies[its])) continue;
      if (!RayMeetsFacet(&state->facets.x[12 * other], origin, normal, &hit.distance)) continue;
      if (hit.distance > limit || (its == body && hit.distance <= touching)) continue;
      if (hit.distance < -0.5 * PetscMin(thickness[body], thickness[its])) continue;
      RayAdd(&hit, touching, &n, &front, hits);
      if (front >= 0) limit = PetscMin(limit, hits[front].distance);
    }
  }
  for (PetscInt i = 0; i < n; ++i) {
    if (s->body[s->surface[hits[i].to]] != body && (i != front || n == 1)) hits[kept++] = hits[i];
  }
  return kept;
}
