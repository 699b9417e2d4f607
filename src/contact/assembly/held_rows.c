/*
   The rows of vertices at which both faces are held along the normal by the same displacement, such as the common clamp
   of two leaves. If the cells beside the clamp do not match, such a row measures how differently the two faces are
   interpolated there. Its multiplier is not bounded by the loads. Therefore the sums of the row are added to the rows
   of the free neighbours along the edges of the facets, in equal parts. Neighbours that match a vertex of the mortar
   face get nothing. The test functions of the remaining rows still sum to 1. If the gap is measured at nodes, the row
   is removed.
*/
#include "assemblyimpl.h"
#include "src/mesh/query/queryimpl.h"

static const PetscReal held_component = 0.1; /* an axis counts as normal to a facet if the unit normal has a larger
                                                component along it */
static const PetscReal held_match = 1e-3; /* tolerance for vertices that match, relative to the diameter of the facet */

/* A vertex of a facet with vertices that are held along its normal. All fields are real, so that an array of these
   structs can be sent as an array of reals. */
typedef struct {
  PetscReal x[3], normal[3]; /* undeformed coordinates [length], unit normal of the facet */
  PetscReal size;            /* diameter of the facet [length] */
  PetscReal motion[3];       /* what prescribes its displacement along each axis, from ContactSurfaceFindMotions() */
  PetscReal held;            /* 1 if the vertex itself is held along the normal; 0 if not */
} HeldVertex;
#define HELD_REALS (PetscInt)(sizeof(HeldVertex) / sizeof(PetscReal))

/* What prescribes the displacement of the vertices of a surface's facets, along each axis */
typedef struct {
  PetscInt *along[3];
} HeldMotions;

/* Collective */
static PetscErrorCode HeldMotionsCreate(Contact contact, const ContactSurface *s, HeldMotions *m)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc3(4 * s->nfacets, &m->along[0], 4 * s->nfacets, &m->along[1], 4 * s->nfacets, &m->along[2]));
  for (PetscInt c = 0; c < 3; ++c)
    PetscCall(
      ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, c, s, m->along[c]));
  PetscFunctionReturn(0);
}

static PetscErrorCode HeldMotionsDestroy(HeldMotions *m)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(m->along[0], m->along[1], m->along[2]));
  PetscFunctionReturn(0);
}

/* Gets vertex i of the surface's facets. Returns whether it is held along the normal. */
static PetscBool HeldVertexGet(const ContactSurface *s, const HeldMotions *m, PetscInt i, HeldVertex *vertex)
{
  const PetscReal *x = &s->reference[12 * (i / 4)];
  PetscBool        held;

  held         = ContactFacetNormal(x, vertex->normal);
  vertex->size = ContactFacetDiameter(x);
  for (PetscInt c = 0; c < 3; ++c) {
    vertex->x[c]      = s->reference[3 * i + c];
    vertex->motion[c] = (PetscReal)m->along[c][i];
    if (PetscAbsReal(vertex->normal[c]) > held_component && m->along[c][i] == CONTACT_FREE) held = PETSC_FALSE;
  }
  vertex->held = held ? 1.0 : 0.0;
  return held;
}

/* Returns the distance of two vertices along the facet of a; PETSC_INFINITY if their facets do not face each other */
static PetscReal HeldVertexDistance(const HeldVertex *a, const HeldVertex *b)
{
  PetscReal d[3], along;

  if (VectorDot(a->normal, b->normal) > CONTACT_NORMAL_COSINE) return PETSC_INFINITY;
  for (PetscInt c = 0; c < 3; ++c) d[c] = b->x[c] - a->x[c];
  along = VectorDot(d, a->normal);
  for (PetscInt c = 0; c < 3; ++c) d[c] -= along * a->normal[c];
  return VectorNorm(d);
}

/* Returns whether the same displacements hold two vertices along the normal of a */
static PetscBool HeldVertexIsAlike(const HeldVertex *a, const HeldVertex *b)
{
  if (b->held == 0.0) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c)
    if (PetscAbsReal(a->normal[c]) > held_component && a->motion[c] != b->motion[c]) return PETSC_FALSE;
  return PETSC_TRUE;
}

/* Collective. Lists the vertices of all facets of the mortar face that have held vertices, from all ranks */
static PetscErrorCode HeldVerticesGather(Contact contact, const ContactSurface *s, PetscInt *n, HeldVertex **list)
{
  HeldMotions m;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(HeldMotionsCreate(contact, s, &m));
  PetscCall(PetscMalloc1(4 * s->nfacets, list));
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    PetscBool any = PETSC_FALSE;

    for (PetscInt a = 0; a < 4; ++a) {
      const PetscBool held = HeldVertexGet(s, &m, 4 * f + a, &(*list)[*n + a]);

      any = (PetscBool)(any || held);
    }
    if (any) *n += 4;
  }
  PetscCall(HeldMotionsDestroy(&m));
  PetscCall(RecordsGather(contact->comm, HELD_REALS, n, list));
  PetscFunctionReturn(0);
}

/* Collective. Sets `free` above zero on the pair's rows whose vertices are not held, or are not held like one of the n
   mortar vertices that is closer than a facet, and to zero on other rows */
static PetscErrorCode HeldRowsMarkFree(const ContactPairData *pair, const HeldMotions *m, PetscInt n,
  const HeldVertex list[], Vec free)
{
  PetscFunctionBegin;
  PetscCall(VecZeroEntries(free));
  for (PetscInt i = 0; i < 4 * pair->nonmortar.nfacets; ++i) {
    HeldVertex vertex;
    PetscBool  held = PETSC_FALSE;

    if (HeldVertexGet(&pair->nonmortar, m, i, &vertex)) {
      for (PetscInt k = 0; k < n && !held; ++k)
        held = (PetscBool)(HeldVertexIsAlike(&vertex, &list[k]) &&
                           HeldVertexDistance(&vertex, &list[k]) <= PetscMax(vertex.size, list[k].size));
    }
    if (!held) PetscCall(VecSetValue(free, pair->row[i], 1.0, ADD_VALUES));
  }
  PetscCall(VecAssemblyBegin(free));
  PetscCall(VecAssemblyEnd(free));
  PetscFunctionReturn(0);
}

/* Collective. Creates a sequential vector with the values of `rows` at the vertices of the pair's facets */
static PetscErrorCode HeldRowsGather(const ContactPairData *pair, Vec rows, Vec *gathered)
{
  IS from;

  PetscFunctionBegin;
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, 4 * pair->nonmortar.nfacets, pair->row, PETSC_USE_POINTER, &from));
  PetscCall(ContactGatherEntries(rows, from, gathered));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(0);
}

/* Returns whether vertex i of the nonmortar facets matches one of the n mortar vertices */
static PetscBool HeldRowsMatch(const ContactPairData *pair, const HeldMotions *m, PetscInt i, PetscInt n,
  const HeldVertex list[])
{
  HeldVertex vertex;

  (void)HeldVertexGet(&pair->nonmortar, m, i, &vertex);
  for (PetscInt k = 0; k < n; ++k)
    if (HeldVertexDistance(&vertex, &list[k]) <= held_match * vertex.size) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Collective. Adds to `share` the entries of held rows at their free neighbours, and their number to `neighbours` */
static PetscErrorCode HeldRowsShare(Contact contact, const ContactPairData *pair, PetscInt n, const HeldVertex list[],
  Vec free, Vec neighbours, Mat share)
{
  Vec                gathered;
  HeldMotions        m;
  const PetscScalar *at;

  PetscFunctionBegin;
  PetscCall(HeldMotionsCreate(contact, &pair->nonmortar, &m));
  PetscCall(HeldRowsMarkFree(pair, &m, n, list, free));
  PetscCall(HeldRowsGather(pair, free, &gathered));
  PetscCall(VecGetArrayRead(gathered, &at));
  for (PetscInt i = 0; i < 4 * pair->nonmortar.nfacets; ++i) {
    const PetscInt edge[2] = {4 * (i / 4) + (i + 1) % 4, 4 * (i / 4) + (i + 3) % 4};

    for (PetscInt e = 0; e < 2 && PetscRealPart(at[i]) == 0.0; ++e) {
      if (PetscRealPart(at[edge[e]]) == 0.0 || HeldRowsMatch(pair, &m, edge[e], n, list)) continue;
      PetscCall(MatSetValue(share, pair->row[i], pair->row[edge[e]], 1.0, ADD_VALUES));
      PetscCall(VecSetValue(neighbours, pair->row[i], 1.0, ADD_VALUES));
    }
  }
  PetscCall(VecRestoreArrayRead(gathered, &at));
  PetscCall(VecDestroy(&gathered));
  PetscCall(HeldMotionsDestroy(&m));
  PetscFunctionReturn(0);
}

/* Collective. Completes `share`: rows without entries keep their own sums, and the others are divided by the number of
   their entries, or emptied if the gap of the pair is measured at nodes */
static PetscErrorCode HeldRowsFinish(Contact contact, Vec neighbours, Mat share)
{
  const ContactRows *rows = &contact->rows;
  PetscInt           rstart;
  PetscScalar       *n;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(neighbours, &rstart, NULL));
  PetscCall(VecGetArray(neighbours, &n));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
      const PetscReal count = PetscRealPart(n[i]);

      if (count == 0.0) PetscCall(MatSetValue(share, rstart + i, rstart + i, 1.0, ADD_VALUES));
      n[i] = count == 0.0 ? 1.0 : contact->pairs[p].gap == GAP_NODE ? 0.0 : 1.0 / count;
    }
  }
  PetscCall(VecRestoreArray(neighbours, &n));
  PetscCall(MatAssemblyBegin(share, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(share, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDiagonalScale(share, neighbours, NULL));
  PetscFunctionReturn(0);
}

/* Collective. Combines `share` with rows->hanging, and distributes the masses again */
static PetscErrorCode HeldRowsCombine(Contact contact, Mat share)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  if (rows->hanging) {
    Mat both;

    PetscCall(MatMatMult(rows->hanging, share, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &both));
    PetscCall(MatDestroy(&rows->hanging));
    rows->hanging = both;
  } else {
    PetscCall(PetscObjectReference((PetscObject)share));
    rows->hanging = share;
  }
  PetscCall(VecDestroy(&rows->weight));
  PetscCall(VecDuplicate(rows->mass, &rows->weight));
  PetscCall(MatMultTranspose(rows->hanging, rows->mass, rows->weight));
  PetscFunctionReturn(0);
}

/* Collective. Distributes the rows that both faces hold, unless this is done already */
PetscErrorCode ContactHeldRowsDistribute(Contact contact)
{
  ContactRows *rows = &contact->rows;
  Vec          free, neighbours;
  Mat          share;
  PetscReal    any;

  PetscFunctionBegin;
  if (rows->distributed || !contact->ndisplacements) PetscFunctionReturn(0);
  rows->distributed = PETSC_TRUE;
  PetscCall(VecDuplicate(rows->mass, &free));
  PetscCall(VecDuplicate(rows->mass, &neighbours));
  PetscCall(VecZeroEntries(neighbours));
  PetscCall(MatCreateAIJ(contact->comm, rows->nlocal, rows->nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 4, NULL,
    &share));
  PetscCall(MatSetOption(share, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];
    HeldVertex            *list;
    PetscInt               n;

    if (pair->formula || pair->nonmortar.self) continue;
    PetscCall(HeldVerticesGather(contact, &pair->mortar, &n, &list));
    if (n) PetscCall(HeldRowsShare(contact, pair, n, list, free, neighbours, share));
    PetscCall(PetscFree(list));
  }
  PetscCall(VecAssemblyBegin(neighbours));
  PetscCall(VecAssemblyEnd(neighbours));
  PetscCall(VecNorm(neighbours, NORM_INFINITY, &any));
  if (any > 0.0) {
    PetscCall(HeldRowsFinish(contact, neighbours, share));
    PetscCall(HeldRowsCombine(contact, share));
  }
  PetscCall(MatDestroy(&share));
  PetscCall(VecDestroy(&neighbours));
  PetscCall(VecDestroy(&free));
  PetscFunctionReturn(0);
}

/* Collective. Undoes ContactHeldRowsDistribute(), because the prescribed displacements change */
PetscErrorCode ContactHeldRowsReset(Contact contact)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  if (!rows->distributed) PetscFunctionReturn(0);
  rows->distributed = PETSC_FALSE;
  PetscCall(MatDestroy(&rows->hanging));
  PetscCall(VecDestroy(&rows->weight));
  PetscCall(ContactHangingRowsCreate(contact));
  PetscFunctionReturn(0);
}
