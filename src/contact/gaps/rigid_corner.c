/*
   Convex corners of a rigid profile between the vertices of the nonmortar face. No vertex touches such a corner, but an
   edge between two vertices does. The row of a vertex of that edge then has the gap between the corner and the edge.
   With one corner it is the vertex that is farther from the surface, because that one touches nothing itself; with two
   corners each vertex has the one on its side. A row with several such edges has their mean.
*/
#include "gapsimpl.h"

/* A corner nearer to the other vertex than this fraction of the edge is left to that vertex, whose row would otherwise
   be almost the same. */
#define CORNER_MARGIN 0.05

/* Appends the corner to the pair's list, for the row of vertex a of a facet, if the vertex is not nearer to the
   surface */
static void CornerAppend(ContactPairData *pair, PetscInt a, PetscReal distance, const SceneSurfaceCorner *found,
  PetscReal phi, const ContactProfileCorner *at)
{
  ContactProfileCorner *corner = &pair->corners[pair->ncorners];

  if (phi < CORNER_MARGIN || found->gap >= distance || found->gap > pair->distance) return;
  *corner        = *at;
  corner->row    = pair->row[a];
  corner->vertex = pair->nonmortar.vertex[a];
  corner->phi[0] = 1.0 - found->share;
  corner->phi[1] = found->share;
  corner->gap    = found->gap;
  for (PetscInt c = 0; c < 3; ++c) corner->normal[c] = found->normal[c];
  ++pair->ncorners;
}

/* Finds the corners opposite the edge between the vertices a[0] and a[1] of a facet, and appends them to the list */
static void CornersOfEdge(ContactPairData *pair, const PetscInt a[2])
{
  const ContactSurface *s = &pair->nonmortar;
  PetscReal             ends[6], normals[6], distance[2], gradient[3], w[4], weight[2][4];
  SceneSurfaceCorner    found[2];
  ContactProfileCorner  at;
  PetscInt              n;

  for (PetscInt k = 0; k < 6; ++k) {
    ends[k]    = s->x[3 * a[k / 3] + k % 3];
    normals[k] = pair->normal[3 * a[k / 3] + k % 3];
  }
  n = ContactSurfaceFindCorners(pair, ends, normals, found, weight);
  for (PetscInt k = 0; n && k < 2; ++k) {
    distance[k] = ContactSurfaceDistance(pair, &ends[3 * k], gradient, w);
    at.node[k]  = s->node[a[k]];
  }
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt k = n == 2 ? i : (PetscInt)(distance[1] > distance[0]);

    for (PetscInt c = 0; c < 4; ++c) at.weight[c] = weight[i][c];
    CornerAppend(pair, a[k], distance[k], &found[i], k ? found[i].share : 1.0 - found[i].share, &at);
  }
}

/* Finds the corners opposite all edges of this rank's facets of the pair */
static PetscErrorCode CornersFindLocal(ContactPairData *pair)
{
  const ContactSurface *s = &pair->nonmortar;

  PetscFunctionBegin;
  pair->ncorners = 0;
  PetscCall(PetscFree(pair->corners));
  PetscCall(PetscMalloc1(8 * s->nfacets, &pair->corners));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    const PetscInt next = i % 4 == 3 ? i - 3 : i + 1;
    /* Both facets of an edge compute the same numbers */
    const PetscInt edge[2] = {s->node[i] < s->node[next] ? i : next, s->node[i] < s->node[next] ? next : i};

    CornersOfEdge(pair, edge);
  }
  PetscFunctionReturn(0);
}

/* Collective. Sums three values of each corner over the corners of a vertex. The global vector gets the sums. */
static PetscErrorCode CornersSum(DM dm, const ContactPairData *pair, PetscBool normals, Vec local, Vec global)
{
  PetscSection section;
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecZeroEntries(global));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt i = 0; i < pair->ncorners; ++i) {
    const ContactProfileCorner *corner = &pair->corners[i];
    PetscInt                    offset;

    PetscCall(PetscSectionGetOffset(section, corner->vertex, &offset));
    for (PetscInt c = 0; c < 3; ++c) a[offset + c] += normals ? corner->normal[c] : (PetscReal)(c == 0);
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(DMLocalToGlobal(dm, local, ADD_VALUES, global));
  PetscFunctionReturn(0);
}

/* Sets the normals of the rows that have corners. global: sums of the corners' normals */
static PetscErrorCode CornersSetNormals(Contact contact, PetscInt p, Vec global)
{
  ContactRows       *rows = &contact->rows;
  const PetscScalar *a;
  PetscSection       section;
  PetscInt           start;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(contact->dm, &section));
  PetscCall(VecGetOwnershipRange(global, &start, NULL));
  PetscCall(VecGetArrayRead(global, &a));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    PetscInt  offset;
    PetscReal normal[3];

    PetscCall(PetscSectionGetOffset(section, rows->vertex[i], &offset));
    for (PetscInt c = 0; c < 3; ++c) normal[c] = PetscRealPart(a[offset - start + c]);
    rows->at_corner[i] = (PetscBool)(VectorScaleToUnit(normal) > 0.0);
    if (rows->at_corner[i]) PetscCall(PetscArraycpy(&rows->normal[3 * i], normal, 3));
  }
  PetscCall(VecRestoreArrayRead(global, &a));
  PetscFunctionReturn(0);
}

/* Collective. Computes the share of each corner in its row: the row's mass, divided by the number of its corners.
   global: these numbers */
static PetscErrorCode CornersSetShares(Contact contact, PetscInt p, Vec local, Vec global)
{
  ContactPairData   *pair = &contact->pairs[p];
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass;
  PetscScalar       *a;
  PetscSection       section;
  PetscInt           start;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(contact->dm, &section));
  PetscCall(VecGetOwnershipRange(global, &start, NULL));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  PetscCall(VecGetArray(global, &a));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(section, rows->vertex[i], &offset));
    if (rows->at_corner[i]) a[offset - start] = mass[i] / a[offset - start];
  }
  PetscCall(VecRestoreArray(global, &a));
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscCall(DMGlobalToLocal(contact->dm, global, INSERT_VALUES, local));
  PetscCall(DMGetLocalSection(contact->dm, &section));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt i = 0; i < pair->ncorners; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(section, pair->corners[i].vertex, &offset));
    pair->corners[i].share = PetscRealPart(a[offset]);
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscFunctionReturn(0);
}

/* Collective. Finds the corners between the vertices of pair p, and sets the normals of their rows. The surfaces must
   have been deformed. */
PetscErrorCode ContactCornersFind(Contact contact, PetscInt p)
{
  ContactPairData *pair = &contact->pairs[p];
  Vec              local, global;

  PetscFunctionBegin;
  if (!SceneSurfaceHasProfile(pair->formula)) PetscFunctionReturn(0);
  PetscCall(CornersFindLocal(pair));
  PetscCall(DMGetLocalVector(contact->dm, &local));
  PetscCall(DMGetGlobalVector(contact->dm, &global));
  PetscCall(CornersSum(contact->dm, pair, PETSC_TRUE, local, global));
  PetscCall(CornersSetNormals(contact, p, global));
  PetscCall(CornersSum(contact->dm, pair, PETSC_FALSE, local, global));
  PetscCall(CornersSetShares(contact, p, local, global));
  PetscCall(DMRestoreGlobalVector(contact->dm, &global));
  PetscCall(DMRestoreLocalVector(contact->dm, &local));
  PetscFunctionReturn(0);
}

/* Adds the gaps at the pair's corners to the assembly */
PetscErrorCode ContactCornersAdd(ContactPairData *pair, ContactAssembly *assembly)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < pair->ncorners; ++i) {
    const ContactProfileCorner *corner = &pair->corners[i];
    PetscReal                   value[4];

    for (PetscInt k = 0; k < 4; ++k) value[k] = corner->share * corner->weight[k];
    PetscCall(ContactEntriesAdd(&assembly->coupling, corner->row, 4, pair->corner, value));
    for (PetscInt k = 0; k < 2; ++k) value[k] = -corner->share * corner->phi[k];
    PetscCall(ContactEntriesAdd(&assembly->coupling, corner->row, 2, corner->node, value));
    PetscCall(VecSetValue(assembly->gap, corner->row, corner->share * corner->gap, ADD_VALUES));
  }
  PetscFunctionReturn(0);
}
