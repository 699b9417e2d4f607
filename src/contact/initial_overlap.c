/* Reports bodies that overlap initially by more than the search depth. Such bodies would get no contact rows. */
#include "contactimpl.h"
#include "src/mesh/query/queryimpl.h"

/* A row that only a search with a larger depth finds. All fields are real, so that rows can be sent as one array. */
typedef struct {
  PetscReal pair, depth, x[3], y[3]; /* number of the pair, penetration [length], coordinates of the nonmortar vertex
                                        and of its point on the mortar face [length] */
} InitialOverlapRow;
#define OVERLAP_REALS   ((PetscInt)(sizeof(InitialOverlapRow) / sizeof(PetscReal)))
#define OVERLAP_POINTS  6   /* points between a vertex and the mortar face that must be inside the nonmortar body */
#define OVERLAP_CENTERS 200 /* largest number of mortar facets of a rank that are tested */

/* Returns whether the point x is inside a box */
static PetscBool InitialOverlapBoxHolds(const PetscReal box[6], const PetscReal x[3])
{
  for (PetscInt c = 0; c < 3; ++c) {
    if (x[c] < box[c] || x[c] > box[3 + c]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Returns the diagonal of the box around all bodies [length] if the boxes of the two bodies of any pair overlap in a
   volume; else 0 */
static PetscReal InitialOverlapFarthestApart(Contact contact, PetscInt nbodies, const PetscReal box[])
{
  PetscReal low[3]  = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL},
            high[3] = {PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL}, diagonal = 0.0;
  PetscBool any = PETSC_FALSE;

  for (PetscInt k = 0; k < nbodies; ++k) {
    for (PetscInt c = 0; c < 3; ++c) {
      low[c]  = PetscMin(low[c], box[6 * k + c]);
      high[c] = PetscMax(high[c], box[6 * k + 3 + c]);
    }
  }
  for (PetscInt c = 0; c < 3; ++c) diagonal += PetscSqr(high[c] - low[c]);
  diagonal = PetscSqrtReal(diagonal);
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const PetscInt   i = contact->pairs[p].mortar.body, j = contact->pairs[p].nonmortar.body;
    const PetscReal *a = &box[6 * i], *b = &box[6 * j];
    PetscBool        overlap = (PetscBool)(i != j);

    for (PetscInt c = 0; c < 3; ++c)
      overlap = (PetscBool)(overlap && PetscMin(a[3 + c], b[3 + c]) - PetscMax(a[c], b[c]) >
                                         PETSC_SQRT_MACHINE_EPSILON * diagonal);
    any = (PetscBool)(any || overlap);
  }
  return any ? diagonal : 0.0;
}

/* Finds the rows of `wide` that `usual` does not contain, that penetrate, and whose vertex
   or point is inside the other body's box. The caller frees *deep. */
static PetscErrorCode InitialOverlapFindRows(Contact contact, const PetscReal box[], ContactLinearization usual,
  ContactLinearization wide, PetscInt *n, InitialOverlapRow **deep)
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *g;
  PetscInt           k = 0, i = 0; /* number of the row in `usual`, and among all possible rows; both lists have
                                      equal order */

  PetscFunctionBegin;
  *n = 0;
  PetscCall(PetscMalloc1(wide->nlocal, deep));
  PetscCall(VecGetArrayRead(wide->g, &g));
  for (PetscInt w = 0; w < wide->nlocal; ++w) {
    const PetscInt         p = wide->pair[w], v = wide->vertex[w];
    const ContactPairData *pair = &contact->pairs[p];
    const PetscReal        gap  = PetscRealPart(g[w]);
    InitialOverlapRow      row  = {.pair = (PetscReal)p, .depth = -gap};

    while (k < usual->nlocal && (usual->pair[k] < p || (usual->pair[k] == p && usual->vertex[k] < v))) ++k;
    i = PetscMax(i, rows->first[p]);
    while (rows->vertex[i] != v) ++i;
    if (k < usual->nlocal && usual->pair[k] == p && usual->vertex[k] == v) continue;
    if (pair->formula || gap >= 0.0 || pair->mortar.body == pair->nonmortar.body) continue;
    for (PetscInt c = 0; c < 3; ++c) {
      row.x[c] = rows->x[3 * i + c];
      row.y[c] = row.x[c] + gap * rows->normal[3 * i + c];
    }
    if (InitialOverlapBoxHolds(&box[6 * pair->mortar.body], row.x) ||
        InitialOverlapBoxHolds(&box[6 * pair->nonmortar.body], row.y))
      (*deep)[(*n)++] = row;
  }
  PetscCall(VecRestoreArrayRead(wide->g, &g));
  PetscFunctionReturn(0);
}

/*
   Collective. Selects the deepest row at which the bodies overlap. deepest->depth stays 0 if there is none. They
   overlap if the point behind the vertex, at the search depth, is inside the mortar body; or if the point of the mortar
   face is inside the nonmortar body, the mortar body is in front of it, and the line from there to the vertex does not
   leave the nonmortar body. The gap alone does not show an overlap: it is a mean that also counts facets on the far
   side of round bodies that touch, or across the hole of a ring.
*/
static PetscErrorCode InitialOverlapPickDeepest(Contact contact, const ContactBoundary *boundary, PetscInt n,
  const InitialOverlapRow deep[], InitialOverlapRow *deepest)
{
  const PetscReal inside = 0.9 * 4.0 * PETSC_PI, ahead[OVERLAP_POINTS] = {0.0, 0.1, 0.3, 0.5, 0.7, 0.9};
  const PetscInt  m = 2 + OVERLAP_POINTS;
  PetscReal      *angle;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(m * n, &angle));
  for (PetscInt k = 0; k < n; ++k) {
    const ContactPairData   *pair = &contact->pairs[(PetscInt)deep[k].pair];
    const InitialOverlapRow *row  = &deep[k];
    PetscReal                x[3];

    for (PetscInt j = 0; j < m; ++j) angle[m * k + j] = 0.0;
    if (row->depth <= pair->depth) continue;
    for (PetscInt c = 0; c < 3; ++c) x[c] = row->x[c] + pair->depth / row->depth * (row->y[c] - row->x[c]);
    angle[m * k] = ContactBoundarySolidAngle(boundary, pair->mortar.body, x);
    for (PetscInt j = 0; j < OVERLAP_POINTS; ++j) {
      for (PetscInt c = 0; c < 3; ++c) x[c] = row->y[c] + ahead[j] * (row->x[c] - row->y[c]);
      if (j == 1) angle[m * k + 1] = ContactBoundarySolidAngle(boundary, pair->mortar.body, x);
      angle[m * k + 2 + j] = ContactBoundarySolidAngle(boundary, pair->nonmortar.body, x);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, angle, (PetscMPIInt)(m * n), MPIU_REAL, MPIU_SUM, contact->comm));
  for (PetscInt k = 0; k < n; ++k) {
    PetscReal along = angle[m * k + 1];

    for (PetscInt j = 0; j < OVERLAP_POINTS; ++j) along = PetscMin(along, angle[m * k + 2 + j]);
    if (PetscMax(angle[m * k], along) > inside && deep[k].depth > deepest->depth) *deepest = deep[k];
  }
  PetscCall(PetscFree(angle));
  PetscFunctionReturn(0);
}

/* Lists points of the pair's mortar face, on this rank, at which a mortar body may lie between the nonmortar vertices:
   the centers x of facets in the box of the nonmortar body, and the points y behind them at the search depth */
static void InitialOverlapListCenters(Contact contact, PetscInt p, const PetscReal box[], PetscInt *n,
  InitialOverlapRow centers[])
{
  const ContactPairData *pair  = &contact->pairs[p];
  const PetscInt         every = 1 + pair->mortar.nfacets / OVERLAP_CENTERS;

  for (PetscInt f = 0; f < pair->mortar.nfacets; f += every) {
    const PetscReal  *x  = &pair->mortar.reference[12 * f];
    InitialOverlapRow at = {.pair = (PetscReal)p};
    PetscReal         normal[3];

    if (!ContactFacetNormal(x, normal)) continue;
    for (PetscInt i = 0; i < 12; ++i) at.x[i % 3] += 0.25 * x[i];
    for (PetscInt c = 0; c < 3; ++c) at.y[c] = at.x[c] - pair->depth * normal[c];
    if (InitialOverlapBoxHolds(&box[6 * pair->nonmortar.body], at.y)) centers[(*n)++] = at;
  }
}

/* Collective. Returns in *depth how far the body reaches behind the point x, against the normal of x [length] */
static PetscErrorCode InitialOverlapMeasure(const ContactBoundary *boundary, PetscInt body, const PetscReal x[3],
  const PetscReal behind[3], PetscReal reach, PetscReal *depth)
{
  PetscReal low = 1.0, high = 2.0; /* relative to the distance of `behind`, which is inside */
  PetscBool bounded = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 30; ++k) {
    const PetscReal at = bounded ? 0.5 * (low + high) : high;
    PetscReal       y[3], angle;

    for (PetscInt c = 0; c < 3; ++c) y[c] = x[c] + at * (behind[c] - x[c]);
    angle = ContactBoundarySolidAngle(boundary, body, y);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &angle, 1, MPIU_REAL, MPIU_SUM, boundary->comm));
    if (angle < 2.0 * PETSC_PI) {
      bounded = PETSC_TRUE;
      high    = at;
    } else {
      low = at;
      if (!bounded) high *= 2.0;
    }
  }
  *depth = high * reach;
  PetscFunctionReturn(0);
}

/* Collective. Selects a row whose pair has a mortar facet deeper than the search depth in the nonmortar body, away from
   the vertices. It is called if no vertex shows an overlap. */
static PetscErrorCode InitialOverlapPickCenters(Contact contact, const ContactBoundary *boundary, const PetscReal box[],
  PetscInt n, const InitialOverlapRow deep[], InitialOverlapRow *deepest)
{
  const PetscReal inside = 0.9 * 4.0 * PETSC_PI;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs && deepest->depth == 0.0; ++p) {
    const PetscInt    body = contact->pairs[p].nonmortar.body;
    InitialOverlapRow row  = {0}, *centers;
    PetscInt          m    = 0;
    PetscReal        *angle;

    for (PetscInt k = 0; k < n; ++k)
      if ((PetscInt)deep[k].pair == p && deep[k].depth > row.depth) row = deep[k];
    if (row.depth == 0.0) continue;
    PetscCall(PetscMalloc1(OVERLAP_CENTERS, &centers));
    InitialOverlapListCenters(contact, p, box, &m, centers);
    PetscCall(RecordsGather(contact->comm, OVERLAP_REALS, &m, &centers));
    PetscCall(PetscMalloc1(2 * m, &angle));
    for (PetscInt k = 0; k < m; ++k) {
      angle[2 * k]     = ContactBoundarySolidAngle(boundary, body, centers[k].x);
      angle[2 * k + 1] = ContactBoundarySolidAngle(boundary, body, centers[k].y);
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, angle, (PetscMPIInt)(2 * m), MPIU_REAL, MPIU_SUM, contact->comm));
    for (PetscInt k = 0; k < m; ++k)
      if (PetscMin(angle[2 * k], angle[2 * k + 1]) > inside && deepest->depth == 0.0) {
        *deepest = row;
        PetscCall(
          InitialOverlapMeasure(boundary, body, centers[k].x, centers[k].y, contact->pairs[p].depth, &deepest->depth));
      }
    PetscCall(PetscFree(angle));
    PetscCall(PetscFree(centers));
  }
  PetscFunctionReturn(0);
}

/* Collective. Finds the deepest row that is found only if the search depth is increased to `distance` [length] */
static PetscErrorCode InitialOverlapSearch(Contact contact, const ContactBoundary *boundary, const PetscReal box[],
  PetscReal distance, ContactLinearization usual, InitialOverlapRow *deepest)
{
  ContactLinearization wide;
  InitialOverlapRow   *deep;
  PetscInt             n;
  Vec                  zero;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(contact->dm, &zero));
  PetscCall(VecSet(zero, 0.0));
  PetscCall(ContactSetReach(contact, 0.0, distance));
  PetscCall(ContactLinearize(contact, zero, &wide));
  PetscCall(ContactSetReach(contact, 0.0, 0.0));
  PetscCall(DMRestoreGlobalVector(contact->dm, &zero));
  PetscCall(InitialOverlapFindRows(contact, box, usual, wide, &n, &deep));
  PetscCall(ContactLinearizationDestroy(&wide));
  PetscCall(RecordsGather(contact->comm, OVERLAP_REALS, &n, &deep));
  PetscCall(InitialOverlapPickDeepest(contact, boundary, n, deep, deepest));
  if (deepest->depth == 0.0) PetscCall(InitialOverlapPickCenters(contact, boundary, box, n, deep, deepest));
  PetscCall(PetscFree(deep));
  PetscFunctionReturn(0);
}

/*@
  ContactCheckDepth - Checks that no undeformed bodies overlap by more than the search depth

  Collective

  Input Parameters:
+ contact - the contact
- usual - the gap linearized at zero displacement, with the default search depth

  Level: intermediate

  Note:
  Such bodies would have no contact rows and would penetrate each other. The error message names the pair, the depth,
  and the option that increases the search depth. The check costs one more search if the bounding boxes of the bodies of
  a pair overlap, and nothing otherwise.

.seealso: `ContactLinearize()`, `ContactGetReach()`
@*/
PetscErrorCode ContactCheckDepth(Contact contact, ContactLinearization usual)
{
  ContactBoundary        boundary;
  InitialOverlapRow      deepest = {0};
  PetscReal             *box, distance;
  const ContactPairData *pair;

  PetscFunctionBegin;
  PetscCall(ContactBoundaryCreate(contact->dm, &boundary));
  PetscCall(PetscMalloc1(6 * boundary.nbodies, &box));
  PetscCall(ContactBoundaryBoxes(&boundary, box));
  distance = InitialOverlapFarthestApart(contact, boundary.nbodies, box);
  if (distance > 0.0) PetscCall(InitialOverlapSearch(contact, &boundary, box, distance, usual, &deepest));
  PetscCall(PetscFree(box));
  PetscCall(ContactBoundaryDestroy(&boundary));
  pair = &contact->pairs[(PetscInt)deepest.pair];
  SceneCheck(deepest.depth == 0.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, pair,
    "The bodies of contact pair \"%s\", mortar %s and nonmortar %s, overlap at the start by %g, which exceeds the "
    "search depth %g: move the bodies apart, or use -contact_search_depth %.2g",
    pair->name, pair->mortar.name, pair->nonmortar.name, (double)deepest.depth, (double)pair->depth,
    1.1 * (double)deepest.depth);
  PetscFunctionReturn(0);
}
