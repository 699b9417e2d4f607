/* Finds the pairs of surfaces that face each other at some time of the load program */
#include "detectimpl.h"
#include "src/mesh/query/queryimpl.h"
#include <stdlib.h>

/* What the rays between two surfaces have found. The fields, also the numbers of surfaces and the counts, are real, so
   that records can be sent as one array. */
typedef struct {
  /* surface numbers; smallest distance [length]; sum of areas [length^2], number of facets that face the other surface,
     and number of tied facets, for each surface */
  PetscReal surface[2], apart, area[2], count[2], tied[2];
} FacingRecord;
#define FACING_REALS ((PetscInt)(sizeof(FacingRecord) / sizeof(PetscReal)))

typedef struct {
  PetscInt      n, max;
  FacingRecord *record;
} FacingList;

static int FacingCompare(const void *a, const void *b)
{
  const FacingRecord *x = (const FacingRecord *)a, *y = (const FacingRecord *)b;

  for (int i = 0; i < 2; ++i) {
    if (x->surface[i] != y->surface[i]) return x->surface[i] < y->surface[i] ? -1 : 1;
  }
  return 0;
}

/* Sorts the records and merges those of the same two surfaces: minimum of the distances, sums of areas and counts */
static void FacingMerge(FacingList *list)
{
  PetscInt n = 0;

  if (list->n) qsort(list->record, (size_t)list->n, sizeof(*list->record), FacingCompare);
  for (PetscInt i = 0; i < list->n; ++i) {
    const FacingRecord *from = &list->record[i];
    FacingRecord       *to   = n ? &list->record[n - 1] : NULL;

    if (!to || FacingCompare(from, to)) {
      list->record[n++] = *from;
      continue;
    }
    to->apart = PetscMin(to->apart, from->apart);
    for (PetscInt side = 0; side < 2; ++side) {
      to->area[side] += from->area[side];
      to->count[side] += from->count[side];
      to->tied[side] += from->tied[side];
    }
  }
  list->n = n;
}

/* Appends a record. Merges the list before it is enlarged. */
static PetscErrorCode FacingAppend(const FacingRecord *record, FacingList *list)
{
  PetscFunctionBegin;
  if (list->n == list->max) {
    FacingMerge(list);
    if (2 * list->n >= list->max) list->max = 2 * list->max + 1024;
    PetscCall(PetscRealloc(sizeof(*list->record) * list->max, &list->record));
  }
  list->record[list->n++] = *record;
  PetscFunctionReturn(0);
}

/* What limits a search */
typedef struct {
  Scene scene;
  /* largest prescribed motion, and length of all rays [length] */
  PetscReal        extent, reach;
  const PetscBool *prescribed; /* [bodies] whether all displacement components of the body are prescribed somewhere */
} FacingLimits;

/* Returns the largest distance [length] at which surfaces i and j count as facing each other under this rule. If the
   motion of one body is not prescribed completely, the largest prescribed motion is added. */
static PetscReal FacingReach(const DetectModel *model, const FacingLimits *limits, const SceneContactPair *rule,
  PetscInt i, PetscInt j)
{
  const PetscInt *body = model->surfaces.body;
  const PetscReal own  = CONTACT_SEARCH_FRACTION * PetscSqrtReal(PetscMin(model->area[i], model->area[j]));

  return (rule->distance > 0.0 ? rule->distance : own) +
         (limits->prescribed[body[i]] && limits->prescribed[body[j]] ? 0.0 : limits->extent);
}

/* Returns whether the curved surfaces at a hit are within the distance for ties, with a margin for their heights above
   the facets, which are estimates */
static PetscBool FacingIsTied(const DetectState *state, PetscReal tie, PetscInt ray, const DetectHit *hit)
{
  const DetectModel *model = state->model;
  const PetscReal   *x = &state->facets.x[12 * hit->from], *other = &state->facets.x[12 * hit->to], estimate = 0.1;
  PetscReal          xi[2], phi[4], place[3] = {0, 0, 0}, nearest[3], normal[3], height[2];

  if (PetscAbsReal(hit->distance) <= tie) return PETSC_TRUE;
  if (!ContactFacetNormal(x, normal)) return PETSC_FALSE;
  DetectGetStart(ray, xi);
  ContactShape(xi, phi);
  for (PetscInt i = 0; i < 12; ++i) place[i % 3] += phi[i / 3] * (x[i] + hit->distance * normal[i % 3]);
  height[0] = DetectBulge(x, &model->normal[12 * hit->from], xi);
  xi[0] = xi[1] = 0.0;
  (void)ContactClosestPoint(other, place, xi, nearest);
  height[1] = DetectBulge(other, &model->normal[12 * hit->to], xi);
  return (PetscBool)(PetscAbsReal(hit->distance - height[0] - height[1]) <=
                     tie + estimate * (PetscAbsReal(height[0]) + PetscAbsReal(height[1])));
}

/* Returns whether two facets face each other only because bodies in free flight have moved through each other: in the
   undeformed state the second facet is deep behind the first one */
static PetscBool FacingHasPassed(const DetectState *state, const DetectHit *hit)
{
  const MeshSurfaces *s    = &state->model->surfaces;
  const PetscInt      from = s->body[s->surface[hit->from]], to = s->body[s->surface[hit->to]];
  const PetscReal    *x = &s->x[12 * hit->from], *y = &s->x[12 * hit->to];
  PetscReal           normal[3], way[3]             = {0, 0, 0};

  if (!state->moves[from].falls && !state->moves[to].falls) return PETSC_FALSE;
  if (SceneBodyIsSurface(&state->model->bodies[to]) || !ContactFacetNormal(x, normal)) return PETSC_FALSE;
  for (PetscInt i = 0; i < 12; ++i) way[i % 3] += 0.25 * (y[i] - x[i]);
  return (PetscBool)(VectorDot(way, normal) < -PetscMin(state->model->thickness[from], state->model->thickness[to]));
}

/* Sends the rays of facet f, and appends a record for each surface that it faces. start: whether the bodies are
   undeformed; only then distances and ties are measured */
static PetscErrorCode FacingShootFacet(const DetectState *state, const FacingLimits *limits, PetscInt f,
  PetscBool start, FacingList *list)
{
  const DetectModel  *model = state->model;
  const MeshSurfaces *s     = &model->surfaces;
  const PetscInt      mine  = s->surface[f];
  FacingRecord        found[DETECT_RAYS * DETECT_HITS];
  PetscInt            n = 0;
  PetscReal           mass[4];

  PetscFunctionBegin;
  for (PetscInt ray = 0; ray < DETECT_RAYS; ++ray) {
    DetectHit      hits[DETECT_HITS];
    const PetscInt nhits = DetectShoot(state, f, ray, limits->reach, hits);

    for (PetscInt h = 0; h < nhits; ++h) {
      const PetscInt          its = s->surface[hits[h].to], side = mine < its ? 0 : 1;
      const SceneContactPair *rule = DetectFindRule(model, limits->scene, mine, its);
      PetscInt                k;

      if (!rule || hits[h].distance > FacingReach(model, limits, rule, mine, its)) continue;
      if (FacingHasPassed(state, &hits[h])) continue;
      for (k = 0; k < n && found[k].surface[1 - side] != (PetscReal)its;) ++k;
      if (k == n) {
        found[n]                   = (FacingRecord){.apart = PETSC_MAX_REAL};
        found[n].surface[side]     = (PetscReal)mine;
        found[n].surface[1 - side] = (PetscReal)its;
        found[n].area[side]        = model->fine[s->body[mine]] * ContactFacetMass(&s->x[12 * f], mass);
        found[n++].count[side]     = 1.0;
      }
      if (start) found[k].apart = PetscMin(found[k].apart, hits[h].distance);
      if (start && rule->tie > 0.0 && FacingIsTied(state, rule->tie, ray, &hits[h])) found[k].tied[side] += 1.0;
    }
  }
  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt side = 0; side < 2; ++side) found[k].tied[side] = found[k].tied[side] >= DETECT_RAYS ? 1.0 : 0.0;
    PetscCall(FacingAppend(&found[k], list));
  }
  PetscFunctionReturn(0);
}

/* Computes the bounding boxes of the bodies at this time, enlarged by the margin [length] */
static void FacingBoxes(const DetectState *state, PetscInt nbodies, PetscReal margin, PetscReal box[])
{
  const MeshSurfaces *s = &state->model->surfaces;

  for (PetscInt i = 0; i < 6 * nbodies; ++i) box[i] = i % 6 < 3 ? PETSC_MAX_REAL : PETSC_MIN_REAL;
  for (PetscInt f = 0; f < s->n; ++f) {
    PetscReal *of = &box[6 * s->body[s->surface[f]]];

    for (PetscInt c = 0; c < 3; ++c) {
      of[c]     = PetscMin(of[c], state->tree.box[6 * f + c] - margin);
      of[3 + c] = PetscMax(of[3 + c], state->tree.box[6 * f + 3 + c] + margin);
    }
  }
}

/* Sends the rays of this rank's share of the facets. After the start, a facet is skipped if neither its body nor a body
   near it moves. */
static PetscErrorCode FacingShoot(const DetectState *state, const FacingLimits *limits, const DetectMove moves[],
  PetscBool start, FacingList *list)
{
  const MeshSurfaces *s       = &state->model->surfaces;
  const PetscInt      nbodies = limits->scene->nbodies;
  PetscReal          *box;
  PetscMPIInt         rank, size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(state->model->comm, &rank));
  PetscCallMPI(MPI_Comm_size(state->model->comm, &size));
  PetscCall(PetscMalloc1(6 * nbodies, &box));
  FacingBoxes(state, nbodies, limits->reach, box);
  for (PetscInt f = rank; f < s->n; f += size) {
    const PetscInt body = s->body[s->surface[f]];
    PetscBool      may  = (PetscBool)(start || moves[body].moves);

    for (PetscInt b = 0; b < nbodies && !may; ++b)
      may = (PetscBool)(moves[b].moves && (SceneBodyIsSurface(&state->model->bodies[b]) ||
                                            ContactBoxesMeet(&state->tree.box[6 * f], &box[6 * b])));
    if (may) PetscCall(FacingShootFacet(state, limits, f, start, list));
  }
  PetscCall(PetscFree(box));
  PetscFunctionReturn(0);
}

/* Finds the bodies all of whose displacement components are prescribed, on any of their faces */
static PetscErrorCode FacingFindPrescribed(Scene scene, PetscBool prescribed[])
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    PetscBool all[3] = {PETSC_FALSE, PETSC_FALSE, PETSC_FALSE};
    size_t    length;

    PetscCall(PetscStrlen(scene->bodies[b].name, &length));
    for (PetscInt i = 0; i < scene->ndisplacements; ++i) {
      const SceneDisplacement *d    = &scene->displacements[i];
      PetscBool                same = (PetscBool)(d->at != DISPLACEMENT_FACE && d->body == b);

      if (d->at == DISPLACEMENT_FACE) {
        PetscCall(PetscStrncmp(d->face, scene->bodies[b].name, length, &same));
        same = (PetscBool)(same && d->face[length] == '.');
      }
      for (PetscInt c = 0; c < 3; ++c) all[c] = (PetscBool)(all[c] || (same && d->fixed[c]));
    }
    prescribed[b] = (PetscBool)(all[0] && all[1] && all[2]);
  }
  PetscFunctionReturn(0);
}

/* Collective. Collects the records of all ranks on every rank */
static PetscErrorCode FacingGather(MPI_Comm comm, FacingList *list)
{
  PetscFunctionBegin;
  FacingMerge(list);
  PetscCall(RecordsGather(comm, FACING_REALS, &list->n, &list->record));
  FacingMerge(list);
  PetscFunctionReturn(0);
}

/* Returns the length of all rays: the largest distance of any rule plus the largest prescribed motion [length] */
static PetscReal FacingLargestReach(const DetectModel *model, Scene scene, PetscReal extent)
{
  PetscReal reach = 0.0, largest = 0.0;

  for (PetscInt i = 0; i < model->surfaces.nsurfaces; ++i) {
    if (model->area[i] < PETSC_MAX_REAL) largest = PetscMax(largest, model->area[i]);
  }
  for (PetscInt r = 0; r < scene->nrules; ++r)
    reach = PetscMax(reach,
      scene->rules[r].distance > 0.0 ? scene->rules[r].distance : CONTACT_SEARCH_FRACTION * PetscSqrtReal(largest));
  return reach + extent;
}

/* Collective. Finds the pairs of surfaces that face each other and to which a rule applies, sorted by their surface
   numbers */
PetscErrorCode DetectFacing(const DetectModel *model, Scene scene, PetscInt *n, DetectPair **pairs)
{
  FacingLimits limits  = {.scene = scene};
  FacingList   list    = {0, 0, NULL};
  PetscInt     nstates = 0;
  PetscReal    time[DETECT_STATES];
  PetscBool   *prescribed;
  DetectMove  *moves;

  PetscFunctionBegin;
  PetscCall(DetectChooseTimes(model, scene, &limits.extent, &nstates, time));
  PetscCall(PetscMalloc2(scene->nbodies, &moves, scene->nbodies, &prescribed));
  PetscCall(FacingFindPrescribed(scene, prescribed));
  limits.prescribed = prescribed;
  limits.reach      = FacingLargestReach(model, scene, limits.extent);
  for (PetscInt k = 0; k <= nstates; ++k) {
    DetectState state;

    if (k) PetscCall(DetectMoves(model, scene, time[k - 1], moves));
    else PetscCall(PetscArrayzero(moves, scene->nbodies));
    PetscCall(DetectStateCreate(model, moves, &state));
    PetscCall(FacingShoot(&state, &limits, moves, (PetscBool)!k, &list));
    PetscCall(DetectStateDestroy(&state));
  }
  PetscCall(PetscFree2(moves, prescribed));
  PetscCall(FacingGather(model->comm, &list));
  *n = list.n;
  PetscCall(PetscCalloc1(list.n, pairs));
  for (PetscInt i = 0; i < list.n; ++i) {
    (*pairs)[i].apart = list.record[i].apart;
    for (PetscInt side = 0; side < 2; ++side) {
      const PetscReal count = list.record[i].count[side];

      (*pairs)[i].surface[side] = (PetscInt)list.record[i].surface[side];
      (*pairs)[i].facet[side]   = count > 0.0 ? list.record[i].area[side] / count : 0.0;
      (*pairs)[i].tied[side]    = (PetscInt)list.record[i].tied[side];
    }
  }
  PetscCall(PetscFree(list.record));
  PetscFunctionReturn(0);
}
